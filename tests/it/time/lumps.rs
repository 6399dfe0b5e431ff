//! Small bodies in the water (`#LUMP`), constant forces (`#FORCE`, `JUNCTION -FORCE`) and drag of junctions, against closed forms.

use crate::common;
use crate::common::assert_share;

use windlass_solve::{EquilibriumOptions, System, equilibrium};

const RHO: f64 = 1025.0;
const G: f64 = 9.80665;
const HEAD: &str = "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025 -GRAVITY 9.80665 -DEPTH 500\n";

/// Times and heights of the origin of the body CLUMP over a run.
fn heights(records: &str) -> Vec<(f64, f64)> {
    let (mut session, screen, folder) = common::session();
    session.open(
        "records",
        format!("{HEAD}{records}\nTDOM -SCREEN NO\nPRCPOST\nTRAJECTORY CLUMP\nSTORE path.csv\nEND\nEND\n"),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    let mut reader = csv::Reader::from_path(folder.path().join("job.ans/path.csv")).unwrap();
    let heads: Vec<String> = reader.headers().unwrap().iter().map(str::to_string).collect();
    let column = |name: &str| heads.iter().position(|head| head.split_whitespace().next() == Some(name)).unwrap();
    let (time, z) = (column("Time"), column("Z"));
    let number = |row: &csv::StringRecord, at: usize| row[at].parse::<f64>().unwrap();
    reader.records().map(|row| row.unwrap()).map(|row| (number(&row, time), number(&row, z))).collect()
}

#[test]
fn falling_lump_follows_closed_form_of_drag_and_added_mass() {
    let path = heights(
        "MEDIT\n&DESCRIBE BODY CLUMP\n*CG 0 0 0\n#WEIGHT *CG 50 1 1 1\n#LUMP *CG 2 -DRAG 3 -AMASS 0.5\nEND\n\
         &INSTATE -LOCATE CLUMP 0 0 -100\n&ENV -TIME 12 0.01",
    );
    // M v' = W - c v2: z falls by M/c ln cosh(t sqrt(W c)/M)
    let mass = 50e3 / G + 0.5 * RHO * 2.0;
    let (weight, c) = (50e3 - RHO * G * 2.0, 0.5 * RHO * 3.0);
    assert!(path.len() > 1000);
    for (time, z) in path.iter().filter(|(time, _)| *time > 0.5) {
        let fallen = mass / c * (time * (weight * c).sqrt() / mass).cosh().ln();
        assert_share(-100.0 - z, fallen, 1e-4);
    }
}

#[test]
fn constant_force_lifts_a_body_by_its_excess_over_the_weight() {
    let path = heights(
        "MEDIT\n&DESCRIBE BODY CLUMP\n*CG 0 0 0\n#WEIGHT *CG 40 1 1 1\n#FORCE *CG 0 0 44\nEND\n\
         &INSTATE -LOCATE CLUMP 0 0 -100\n&ENV -TIME 3 0.01",
    );
    for (time, z) in path.iter().filter(|(time, _)| *time > 0.1) {
        assert_share(z + 100.0, 0.5 * (4.0 / 40.0) * G * time * time, 1e-4);
    }
}

#[test]
fn neutral_lump_in_small_waves_moves_with_the_water() {
    // mass and added mass are those of the water and its added mass: it goes as the water does, a exp(k z) about its place
    let weight = RHO * G * 2.0 / 1000.0;
    let path = heights(&format!(
        "MEDIT\n&DESCRIBE BODY CLUMP\n*CG 0 0 0\n#WEIGHT *CG {weight} 1 1 1\n#LUMP *CG 2 -AMASS 0.7 -CONSTANT\nEND\n\
         &INSTATE -LOCATE CLUMP 0 0 -20\n&ENV -WAVES 8 0.02 0 180 -TIME 64 0.02 -RAMP 24"
    ));
    let frequency = std::f64::consts::TAU / 8.0;
    let orbit = 0.02 * (-frequency * frequency / G * 20.0).exp();
    // the amplitude by differences over half a period, which a drift does not touch
    let late: Vec<f64> = path.iter().filter(|(time, _)| *time > 40.0).map(|(_, z)| *z).collect();
    let half = 200;
    let largest = late
        .iter()
        .zip(late.iter().skip(half).zip(late.iter().skip(2 * half)))
        .map(|(before, (now, after))| (now - 0.5 * (before + after)).abs())
        .fold(0.0, f64::max);
    assert_share(0.5 * largest, orbit, 5e-3);
}

/// The place of junction J, which hangs on a line without weight from (0, 0, 0), in equilibrium.
fn hung(options: &str, environment: &str) -> [f64; 3] {
    let (mut session, screen, _folder) = common::session();
    session.open(
        "records",
        format!(
            "{HEAD}MEDIT\n*TOP 0 0 0\nJUNCTION J 1 1 -48 {options}\n~LINE H_CAT 20 EXACT -LEN 50 -WTPLEN 1E-6 -BUOYDIAMETER 0 -EMODULUS 2E8\n\
             CONNECTOR L ~LINE *J *TOP\nEND\n&ENV {environment}\n"
        ),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    let model = session.job.model.clone();
    let system = System::new(&model, &[]).unwrap();
    let mut state = system.state(&model);
    equilibrium(&system, &mut state, &EquilibriumOptions::default()).unwrap();
    state.poses[0].origin.into()
}

#[test]
fn junction_hangs_along_the_sum_of_weight_and_force() {
    let [x, y, z] = hung("-WEIGHT 30 -FORCE 9 -4 6", "");
    for (got, want) in [(x / -z, 9.0 / 24.0), (y / -z, -4.0 / 24.0)] {
        assert_share(got, want, 1e-5);
    }
    assert_share(x.hypot(y).hypot(z), 50.0, 1e-4);
}

#[test]
fn junction_in_a_current_leans_by_drag_over_weight() {
    let [x, y, z] = hung("-WEIGHT 30 -DISPLACEMENT 10 -DRAG 4 -AMASS 1", "-CURRENT 1.5 180");
    assert_share(x / -z, 0.5 * RHO * 4.0 * 1.5 * 1.5 / 20e3, 1e-5);
    assert!(y.abs() < 1e-6);
}

#[test]
fn added_mass_of_a_junction_without_displacement_is_refused() {
    let (text, errors) = common::print_records(&format!("{HEAD}MEDIT\nJUNCTION J 0 0 -50 -WEIGHT 3 -AMASS 1\nEND\n"));
    assert_eq!(errors, 1, "{text}");
    assert!(text.contains("-AMASS without -DISPLACEMENT"), "{text}");
}
