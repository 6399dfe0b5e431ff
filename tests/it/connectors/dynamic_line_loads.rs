//! What the options of a dynamic line do to its loads, against closed forms: taut lines held at both ends, on which
//! loads add up.

use crate::common;
use crate::common::assert_near;

use nalgebra::Vector3;
use windlass_base::pose::Six;
use windlass_hydro::ambient;
use windlass_model::{ConnectorElement, ConnectorResponse, End, LineNode, Situation, SolverCache, TimeStep};

/// A line of a class between two points in the ground 100 m apart, 50 m below the surface along X or, `dry`, 10 m above it.
struct Held {
    element: Box<dyn ConnectorElement>,
    ends: [End; 2],
    around: windlass_model::Surroundings,
}

fn solve_held_line(class: &str, environment: &str, (z, dynamics): (f64, bool)) -> Held {
    let (mut session, _, _folder) = common::session();
    let text = format!(
        "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 200 {environment}\nMEDIT\n*A 0 0 {z}\n*B 100 0 {z}\n{class}\nCONNECTOR LINE ~LINE *A *B\nEND\n{}",
        if dynamics { "&CONNECTOR LINE -DYNAMICS 20" } else { "" }
    );
    session.open("test", text);
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let model = &session.job.model;
    let connector = model.connectors.values().next().unwrap();
    let element = model.element_in(connector, Some(&ambient(model, None).unwrap())).unwrap();
    let ends = [0.0, 100.0].map(|x| End::at_rest(windlass_base::pose::Pose::from_position([x, 0.0, z])));
    Held { element, ends, around: model.surroundings() }
}

impl Held {
    /// What it answers at rest, or at the beginning of a run.
    fn answer(&self, step: Option<TimeStep>) -> ConnectorResponse {
        let mut state = vec![0.0; self.element.states()];
        let mut out = ConnectorResponse::default();
        let at = Situation { ends: &self.ends, step, surroundings: &self.around };
        let committed = state.clone();
        self.element.evaluate(&at, &committed, &mut state, &mut SolverCache::new(), &mut out).unwrap();
        out
    }

    /// Sum of the forces on both ends (N): all that loads it along.
    fn load(&self) -> Vector3<f64> {
        let out = self.answer(None);
        let sum: Six = out.wrench.iter().sum();
        Vector3::new(sum[0], sum[1], sum[2])
    }

    fn nodes(&self) -> Vec<LineNode> {
        let mut out = Vec::new();
        let at = Situation { ends: &self.ends, step: None, surroundings: &self.around };
        let state = vec![0.0; self.element.states()];
        self.element.as_nodal().unwrap().find_nodes(&at, &state, &mut out).unwrap();
        out
    }

    /// Inertia of the first end at the beginning of a run (kg), along and across.
    fn inertia(&self) -> [f64; 2] {
        let out = self.answer(Some(TimeStep { time: 0.0, dt: 0.0 }));
        [out.inertia[0][(0, 0)], out.inertia[0][(2, 2)]]
    }
}

/// Taut by 1 %: loads turn it by less than a thousandth, and what that does to a sum is less than a millionth of the tension.
const TAUT: &str = "~LINE ROD 200 100 -EI 0 -EA 1E9 -LEN 99 -REFINE 20 -WTPLEN 1000 ";
const CATENARY: &str = "~LINE CATENARY 100 0.04 -EA 1E9 -LEN 99 ";
const LENGTH: f64 = 99.0;
const RHO: f64 = 1025.0;

#[test]
fn current_drag_uses_drag_diameter_and_coefficient() {
    // across: the line bows by a thousandth, which changes the normal velocity by a millionth
    let across = |class: &str| solve_held_line(class, "-CURRENT 1 -90", (-50.0, false)).load().y;
    let want = |cd: f64, d: f64| 0.5 * RHO * cd * d * LENGTH * 1.01;
    let default = across(TAUT);
    assert_near(default, 0.5 * RHO * 0.2 * LENGTH, 0.02);
    assert_near(across(&format!("{TAUT} -CD 1.2")) / default, 1.2, 1e-3);
    assert_near(across(&format!("{TAUT} -DRAGDIA 300")) / default, 1.5, 1e-3);
    // the drag acts on the stretched or the unstretched length: a hundredth
    assert!(default <= want(1.0, 0.2) * 1.001 && default >= want(1.0, 0.2) / 1.011, "{default}");
    // along: 0.5 rho Cx V2 De
    let along = |class: &str| solve_held_line(class, "-CURRENT 1 180", (-50.0, false)).load().x;
    assert_near(along(TAUT), 0.5 * RHO * 0.025 * 0.2 * LENGTH, 0.02);
    assert_near(along(&format!("{TAUT} -CD 1 0.05")), 0.5 * RHO * 0.05 * std::f64::consts::PI * 0.2 * LENGTH, 0.02);
}

#[test]
fn wind_on_dry_line_uses_wind_diameter() {
    let load = |class: &str| solve_held_line(class, "-WIND 20 -90", (10.0, false)).load().y;
    let default = load(TAUT);
    // the speed of -WIND is that at 10 m; the line hangs through by centimetres
    assert_near(default, 0.5 * 1.226 * 1.2 * 0.2 * LENGTH * 400.0 * (0.514_444_f64).powi(2), 0.03);
    assert_near(load(&format!("{TAUT} -WINDDIA 400")) / default, 2.0, 2e-3);
    assert_near(load(&format!("{TAUT} -CD 1 0 0.6")) / default, 0.5, 2e-3);
}

#[test]
fn inertia_uses_mass_and_added_mass_diameter() {
    let half = LENGTH / 20.0 / 2.0;
    let (mass, water) = (1000.0 / 9.806_65, RHO * std::f64::consts::FRAC_PI_4);
    let inertia = |class: &str| solve_held_line(class, "", (-50.0, false)).inertia();
    // the first element is level within a hundredth: what that mixes is its square
    let [along, across] = inertia(TAUT);
    assert_near(along, half * mass, 1e-3);
    assert_near(across, half * (mass + water * 0.04), 1e-3);
    let [_, across] = inertia(&format!("{TAUT} -AMASDIA 400"));
    assert_near(across, half * (mass + water * 0.16), 1e-3);
    let [along, across] = inertia(&format!("{TAUT} -CA 0.5 0.2"));
    assert_near(across, half * (mass + 0.5 * water * 0.04), 1e-3);
    assert_near(along, half * (mass + 0.2 * water * 0.04), 1e-3);
}

#[test]
fn aqwa_catenary_has_added_mass_and_drag_with_cable_dynamics() {
    let half = LENGTH / 20.0 / 2.0;
    let line =
        |more: &str, environment: &str| solve_held_line(&format!("{CATENARY}{more}"), environment, (-50.0, true));
    // rho Ca A, default 1.0
    assert_near(line("", "").inertia()[1], half * (100.0 + RHO * 0.04), 1e-3);
    assert_near(line("-CA 2.5", "").inertia()[1], half * (100.0 + 2.5 * RHO * 0.04), 1e-3);
    // 0.5 rho Cd V2 De, De that of AREA, default 1.0
    let equivalent = (0.04 / std::f64::consts::FRAC_PI_4).sqrt();
    let across = |more: &str| line(more, "-CURRENT 1 -90").load().y;
    assert_near(across(""), 0.5 * RHO * equivalent * LENGTH, 0.02);
    assert_near(across("-CD 1.6") / across(""), 1.6, 1e-3);
    assert_near(across("-DE 0.5"), 0.5 * RHO * 0.5 * LENGTH, 0.02);
    // 0.5 rho Cx V2 De, default 0.025
    let along = |more: &str| line(more, "-CURRENT 1 180").load().x;
    assert_near(along(""), 0.5 * RHO * 0.025 * equivalent * LENGTH, 0.02);
    assert_near(along("-CX 0.1"), 0.5 * RHO * 0.1 * equivalent * LENGTH, 0.02);
}

#[test]
fn aqwa_joint_drag_is_half_density_times_drag_area() {
    let class = |joint: &str| {
        format!("~LINE CATENARY 100 0.04 -EA 1E9 -LEN 49.5 {joint}\n~LINE CATENARY 100 0.04 -EA 1E9 -LEN 49.5")
    };
    let load = |joint: &str| solve_held_line(&class(joint), "-CURRENT 1.5 -90", (-50.0, true)).load().y;
    // FD = 0.5 rho CDA VR |VR|
    assert_near(load("-CLUMP 2000 1000 0 6.5") - load("-CLUMP 2000 1000"), 0.5 * RHO * 6.5 * 1.5 * 1.5, 5e-3);
}

#[test]
fn attachment_drag_uses_its_drag_area() {
    let class = |clump: &str| {
        format!(
            "~LINE ROD 200 100 -EI 0 -EA 1E9 -LEN 49.5 -REFINE 10 -WTPLEN 1000 {clump}\n~LINE ROD 200 100 -EI 0 -EA 1E9 -LEN 49.5 -REFINE 10 -WTPLEN 1000"
        )
    };
    let load = |clump: &str| solve_held_line(&class(clump), "-CURRENT 1.5 -90", (-50.0, false)).load().y;
    for clump in ["-CLUMP 10000", "-CLUMP -10000"] {
        let drag = load(&format!("{clump} -CLUMP_DRAG 6.5")) - load(clump);
        assert_near(drag, 0.5 * RHO * 6.5 * 1.5 * 1.5, 5e-3);
    }
}

#[test]
fn aqwa_joint_oscillates_with_its_added_mass() {
    // a light taut string with a mass in its middle: w2 = 4 T / (l M), and a third of the string goes with the mass
    let frequency = |joint: &str| {
        let class = format!("~LINE CATENARY 1 1E-4 -EA 1E9 -LEN 49.5 {joint}\n~LINE CATENARY 1 1E-4 -EA 1E9 -LEN 49.5");
        let line = solve_held_line(&class, "", (-50.0, true));
        let at = Situation { ends: &line.ends, step: None, surroundings: &line.around };
        let state = vec![0.0; line.element.states()];
        line.element.as_dynamic().unwrap().natural_modes(&at, &state, 1).unwrap()[0].frequency
    };
    let tension = 1e9 / 99.0;
    for (joint, mass) in [("-CLUMP 2000 1000", 2000.0), ("-CLUMP 2000 1000 3000", 5000.0)] {
        let want = (4.0_f64 * tension / 100.0 / (mass + 1.1 * 99.0 / 3.0)).sqrt();
        assert_near(frequency(joint), want, 5e-3);
    }
}

#[test]
fn cable_dynamics_bends_with_ei_and_ignores_maximum_tension() {
    let plain = solve_held_line(&format!("{CATENARY}-TMAX 1E6"), "", (-50.0, true));
    // 1 % of strain of 1E9 N: ten times the maximum that ends the database
    let tension = plain.nodes()[10].effective;
    assert_near(tension, 1e9 / 99.0, 1e-3);
    let bent = solve_held_line(&format!("{CATENARY}-EI 1E6"), "", (-50.0, true)).nodes();
    let curvature = bent[10].curvature;
    assert_near(bent[10].moment, 1e6 * curvature, 1e-9);
    assert!(curvature > 0.0 && plain.nodes()[10].moment == 0.0);
}

#[test]
fn cable_dynamics_requires_an_area() {
    let (mut session, _, _folder) = common::session();
    session.open(
        "test",
        "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 200\nMEDIT\n*A 0 0 -50\n*B 100 0 -50\n~LINE CATENARY 100 -LEN 99\nCONNECTOR LINE ~LINE *A *B\nEND\n&CONNECTOR LINE -DYNAMICS 20".to_string(),
    );
    session.run();
    assert_eq!(session.errors, 1);
    assert!(format!("{:?}", session.reports).contains("cable dynamics needs a section with an area"));
}

#[test]
fn solved_dynamic_line_length_matches_exact_catenary() {
    let length = |class: &str, option: &str| {
        let (mut session, _, _folder) = common::session();
        session.open(
            "test",
            format!(
                "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY B\n*F 0 0 -5\n~LINE {class} -LEN 800 -DEPANCHOR 100\n\
                 CONNECTOR LINE -ANC 0 785 ~LINE *F\nEND\n&CONNECTOR LINE {option}"
            ),
        );
        session.run();
        assert_eq!(session.errors, 0, "{:?}", session.reports);
        session.job.model.connectors.values().next().unwrap().first_length.unwrap()
    };
    for option in ["-L_TENSION 900", "-L_TENSION 400", "-L_HORIZONTAL 700"] {
        let rod = length("ROD 120 60 -EI 0 -REFINE 100", option);
        let exact = length("B_CAT 120 EXACT", option);
        // of 800 m what the mesh moves the force by, 1e-3, is centimetres; the slack line follows its force less
        assert!((rod - exact).abs() < 0.05, "{option}: {rod} {exact}");
    }
}

#[test]
fn dynamic_line_takes_300_and_many_more_elements() {
    for count in [300, 2000] {
        let class = format!("~LINE ROD 200 100 -EI 0 -EA 1E9 -LEN 99 -REFINE {count} -WTPLEN 1000");
        let line = solve_held_line(&class, "", (-50.0, false));
        assert_eq!(line.nodes().len(), count + 1);
        // its weight in water
        let weight = (1000.0 - RHO * 9.806_65 * std::f64::consts::FRAC_PI_4 * 0.04) * LENGTH;
        // statics leaves a node no more than 1e-9 of the tension of 1e7 N
        let left = 0.01 * count as f64;
        assert!((line.load().z + weight).abs() < left, "{} {weight}", line.load().z);
    }
}

#[test]
fn fibre_rope_hangs_by_its_static_stiffness() {
    let slow = solve_held_line(
        "~LINE ROD 200 100 -EI 0 -EA 1E8 -LEN 99 -REFINE 20 -WTPLEN 317 -ROPE 3E8 20 100",
        "",
        (-50.0, false),
    );
    assert_near(slow.nodes()[10].effective, 1e8 / 99.0, 1e-3);
    let out = slow.answer(None);
    // the pull of one end on the other follows the static spring along
    assert_near(out.stiffness[0][(0, 0)], 1e8 / 99.0, 0.01);
}
