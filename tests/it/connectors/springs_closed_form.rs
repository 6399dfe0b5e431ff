//! Zero-length classes, slings, rollers, restraints and tugs against numbers worked out by hand from [MOSES-FLEX].

use crate::common;

use windlass::session::Session;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_model::{
    ClassRole, Connection, ConnectorCategory, ConnectorElement, ConnectorResponse, ConnectorSummary, End, Model,
    Placement, RunRequirement, Situation, SolverCache, TimeStep,
};

/// A spring between a point of a body and another, or the ground, as records define it.
struct JointBench {
    session: Session,
    element: Box<dyn ConnectorElement>,
    state: Vec<f64>,
}

impl JointBench {
    /// The class `~C` with a connector between *A of body ONE and `second`; an assembly's connectors have their second end given.
    fn new(records: &str, connector: &str) -> JointBench {
        let (mut session, screen, _folder) = common::session();
        let text = format!(
            "&DIMEN -DIMEN METERS N\nMEDIT\n*GROUND 0 0 0\n&DESCRIBE BODY ONE\n*A 0 0 0\n&DESCRIBE BODY TWO\n*B 0 0 0\n\
             {records}\nCONNECTOR IT {connector}\nEND\n"
        );
        session.open("records", text);
        session.run();
        assert_eq!(session.errors, 0, "{records}: {:?} {}", session.reports, screen.text());
        let model = &session.job.model;
        let connector = model.connectors.values().next().unwrap();
        let class = model.classes.values().next().unwrap();
        let curve = |name: &str| model.curves.get(&Model::key(name));
        let ends = model.end_poses(connector);
        let surroundings = model.surroundings();
        let made = Connection {
            connector,
            ends,
            to_ground: false,
            placement: Placement::default(),
            curve: &curve,
            surroundings: &surroundings,
            ambient: None,
            duty: RunRequirement::default(),
            tied: &windlass_model::TiedBodies::default,
        };
        let element = class.object.element(&made).unwrap();
        let state = vec![0.0; element.states()];
        JointBench { session, element, state }
    }

    fn between_bodies(records: &str) -> JointBench {
        JointBench::new(records, "~C *A *B")
    }

    /// The wrench on the first end: the second stands at these places and moves with this velocity.
    fn evaluate_at(
        &self,
        first: [f64; 6],
        second: [f64; 6],
        rate: [f64; 3],
        dt: Option<f64>,
    ) -> (ConnectorResponse, Vec<f64>) {
        let [x, y, z] = rate;
        let ends = [
            End::at_rest(Pose::from_place(&Place::new(first))),
            End { velocity: Six::new(x, y, z, 0.0, 0.0, 0.0), ..End::at_rest(Pose::from_place(&Place::new(second))) },
        ];
        let surroundings = self.session.job.model.surroundings();
        let step = dt.map(|dt| TimeStep { time: dt, dt });
        let (mut out, mut trial) = (ConnectorResponse::default(), vec![0.0; self.state.len()]);
        let at = Situation { ends: &ends, step, surroundings: &surroundings };
        self.element.evaluate(&at, &self.state, &mut trial, &mut SolverCache::new(), &mut out).unwrap();
        (out, trial)
    }

    /// Force and moment on the first end at rest, its body at the origin.
    fn pull(&self, second: [f64; 3]) -> [f64; 6] {
        let [x, y, z] = second;
        self.evaluate_at([0.0; 6], [x, y, z, 0.0, 0.0, 0.0], [0.0; 3], None).0.wrench[0].into()
    }

    /// The force on the first end while the second passes a place with a velocity.
    fn passing(&self, second: [f64; 3], rate: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = second;
        let w = self.evaluate_at([0.0; 6], [x, y, z, 0.0, 0.0, 0.0], rate, Some(0.1)).0.wrench[0];
        [w[0], w[1], w[2]]
    }

    fn summary(&self, first: [f64; 6], second: [f64; 6]) -> ConnectorSummary {
        let ends = [first, second].map(|p| End::at_rest(Pose::from_place(&Place::new(p))));
        let surroundings = self.session.job.model.surroundings();
        self.element.summary(&Situation { ends: &ends, step: None, surroundings: &surroundings }, &self.state).unwrap()
    }
}

fn assert_near(got: &[f64], want: &[f64]) {
    let size = want.iter().fold(1.0, |m: f64, v| m.max(v.abs()));
    assert!(got.iter().zip(want).all(|(a, b)| (a - b).abs() <= 1e-9 * size), "{got:?} is not {want:?}");
}

#[test]
fn gspr_force_uses_spring_values_along_first_body_axes() {
    let joint = JointBench::between_bodies("~C GSPR X 1000 Y 200 Z 300");
    // moment about the first point: d x F = (0.1, 0.2, -0.3) x (100, 40, -90)
    assert_near(&joint.pull([0.1, 0.2, -0.3]), &[100.0, 40.0, -90.0, -6.0, -21.0, -16.0]);
    // a quarter turn of the first body about Z: its X is global Y
    let turned = [0.0, 0.0, 0.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2];
    let (got, _) = joint.evaluate_at(turned, [0.1, 0.2, -0.3, 0.0, 0.0, 0.0], [0.0; 3], None);
    assert_near(
        got.wrench[0].as_slice(),
        &[20.0, 200.0, -90.0, 0.2 * -90.0 + 0.3 * 200.0, -0.3 * 20.0 + 0.1 * 90.0, 20.0 - 4.0],
    );
    assert_near(&got.wrench[1].as_slice()[..3], &[-20.0, -200.0, 90.0]);
    // -EULER by the same angle, the body not turned
    let euler = JointBench::new("~C GSPR X 1000 Y 200 Z 300", "-EULER 0 0 90 ~C *A *B");
    assert_near(&euler.pull([0.1, 0.2, -0.3])[..3], &[20.0, 200.0, -90.0]);
    // the second body may turn: translations do not know
    let (got, _) = joint.evaluate_at([0.0; 6], [0.1, 0.2, -0.3, 0.5, 0.6, 0.7], [0.0; 3], None);
    assert_near(&got.wrench[0].as_slice()[..3], &[100.0, 40.0, -90.0]);
}

#[test]
fn element_axes_are_global_with_first_node_on_ground() {
    let joint = JointBench::new("~C GSPR X 1000", "~C *GROUND *B");
    let (got, _) = joint.evaluate_at([0.0; 6], [0.1, 0.2, 0.0, 0.4, 0.5, 0.6], [0.0; 3], None);
    assert_near(&got.wrench[0].as_slice()[..3], &[100.0, 0.0, 0.0]);
}

#[test]
fn single_node_spring_acts_from_position_at_definition() {
    let (mut session, _, _folder) = common::session();
    let records = "&DIMEN -DIMEN METERS N\nMEDIT\n&DESCRIBE BODY ONE\n*A 1 0 0\n~C GSPR X 1000 Y 1000\nEND\n\
                   &INSTATE -LOCATE ONE 10 20 0 0 0 90\nMEDIT\nCONNECTOR IT ~C *A\nEND\n&INSTATE -MOVE ONE 0.5 0 0";
    session.open("records", records);
    session.run();
    let model = &session.job.model;
    let connector = model.connectors.values().next().unwrap();
    let ends = model.end_poses(connector);
    let surroundings = model.surroundings();
    let made = Connection {
        connector,
        ends,
        to_ground: true,
        placement: Placement::default(),
        curve: &|_| None,
        surroundings: &surroundings,
        ambient: None,
        duty: RunRequirement::default(),
        tied: &windlass_model::TiedBodies::default,
    };
    let element = model.classes.values().next().unwrap().object.element(&made).unwrap();
    let mut out = ConnectorResponse::default();
    let at = Situation { ends: &ends.map(End::at_rest), step: None, surroundings: &surroundings };
    element.evaluate(&at, &[], &mut [], &mut SolverCache::new(), &mut out).unwrap();
    assert_near(out.wrench[0].as_slice(), &[-500.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
}

#[test]
fn rotation_spring_restores_rotation_since_definition() {
    let joint = JointBench::between_bodies("~C GSPR RX 100 RY 100 RZ 100");
    // an isotropic rotation spring: a moment along the rotation vector; here 0.3 rad about Y
    let (got, _) = joint.evaluate_at([0.0; 6], [0.0, 0.0, 0.0, 0.0, 0.3, 0.0], [0.0; 3], None);
    assert_near(got.wrench[0].as_slice(), &[0.0, 0.0, 0.0, 0.0, 30.0, 0.0]);
    assert_near(got.wrench[1].as_slice(), &[0.0, 0.0, 0.0, 0.0, -30.0, 0.0]);
    // both bodies turned alike: nothing
    let turn = [0.0, 0.0, 0.0, 0.4, -0.2, 1.0];
    assert_near(joint.evaluate_at(turn, turn, [0.0; 3], None).0.wrench[0].as_slice(), &[0.0; 6]);
    // one spring about X, the turn (t, 0, t): J^-T (K t, 0, 0) = K t (1, t/2, 0) + c t2-terms: c (K t) (-t2, 0, t2), c(2 t2)
    let joint = JointBench::between_bodies("~C GSPR RX 100");
    let t: f64 = 0.5;
    let angle = 2.0_f64.sqrt() * t;
    let turn = nalgebra::Rotation3::new(nalgebra::Vector3::new(t, 0.0, t));
    let (roll, pitch, yaw) = turn.euler_angles();
    let (got, _) = joint.evaluate_at([0.0; 6], [0.0, 0.0, 0.0, roll, pitch, yaw], [0.0; 3], None);
    let c = (1.0 - 0.5 * angle / (0.5 * angle).tan()) / (angle * angle);
    let (s, q) = (100.0 * t, c * 100.0 * t * t * t);
    assert_near(&got.wrench[0].as_slice()[3..], &[s - q, 0.5 * t * s, q]);
}

#[test]
fn no_degree_of_freedom_is_loaded_against_its_sense() {
    let tension = JointBench::between_bodies("~C GSPR TENSION X 1000 Y 200 RZ 50");
    assert_near(&tension.pull([-0.1, 0.3, 0.0]), &[0.0; 6]);
    assert_near(&tension.pull([0.1, 0.3, 0.0])[..2], &[100.0, 60.0]);
    assert_near(&tension.pull([0.0, 0.3, 0.0])[..2], &[0.0, 60.0]);
    let turned = [-0.1, 0.3, 0.0, 0.0, 0.0, 0.2];
    assert_near(tension.evaluate_at([0.0; 6], turned, [0.0; 3], None).0.wrench[0].as_slice(), &[0.0; 6]);
    let compression = JointBench::between_bodies("~C FOUNDATION COMPRESSION X 1000 Y 200");
    assert_near(&compression.pull([0.1, 0.3, 0.0]), &[0.0; 6]);
    assert_near(&compression.pull([-0.1, 0.3, 0.0])[..2], &[-100.0, 60.0]);
}

#[test]
fn len_offsets_spring_start_along_element_x() {
    let joint = JointBench::between_bodies("~C GSPR X 1000 Y 200 -LEN 2");
    assert_near(&joint.pull([2.1, 0.3, 0.0]), &[100.0, 60.0, 0.0, 0.0, 0.0, 2.1 * 60.0 - 0.3 * 100.0]);
}

#[test]
fn symmetric_spring_has_z_as_y_and_curve_on_resultant() {
    let joint = JointBench::between_bodies("~C GSPR X 1000 Y 200 RY 70 -SYMMETRIC");
    assert_near(&joint.pull([0.0, 0.3, 0.4])[..3], &[0.0, 60.0, 80.0]);
    let (got, _) = joint.evaluate_at([0.0; 6], [0.0, 0.0, 0.0, 0.0, 0.0, 0.2], [0.0; 3], None);
    assert_near(&got.wrench[0].as_slice()[3..], &[0.0, 0.0, 14.0]);
    // 200 N/m in series with 50 N at 0.25 m: at 0.5 m both have 50 N
    let joint = JointBench::between_bodies("~C GSPR X 1000 Y 200 -SYMMETRIC -Y_PY 50 0.25 500 0.5");
    assert_near(&joint.pull([0.0, 0.3, 0.4])[..3], &[0.0, 30.0, 40.0]);
    // not symmetric unless said: Z is free
    assert_near(&JointBench::between_bodies("~C GSPR X 1000 Y 200").pull([0.0, 0.3, 0.4])[..3], &[0.0, 60.0, 0.0]);
}

#[test]
fn p_y_curves_are_in_series_with_basic_stiffness_in_x_y_and_z() {
    // 1000 N/m and a curve through (100, 0.3), (300, 0.5): at 200 N the two deflect 0.2 + 0.4 m, and 500 N/m lie beyond 0.8 m
    for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        let joint = JointBench::between_bodies(&format!("~C GSPR X 1000 Y 1000 Z 1000 -{name}_PY 100 0.3 300 0.5"));
        for (u, f) in [(0.6, 200.0), (-0.6, -200.0), (0.2, 50.0), (1.2, 500.0)] {
            let mut at = [0.0; 3];
            at[axis] = u;
            let mut want = [0.0; 3];
            want[axis] = f;
            assert_near(&joint.pull(at)[..3], &want);
        }
    }
}

#[test]
fn dashpot_has_limited_power_law_force_while_spring_acts() {
    for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        let joint = JointBench::between_bodies(&format!("~C GSPR X 1000 Y 1000 Z 1000 -{name}_DAMPING 5 2 40"));
        for (v, f) in [(2.0, 20.0), (-2.0, -20.0), (4.0, 40.0)] {
            let mut rate = [0.0; 3];
            rate[axis] = v;
            let mut want = [0.0; 3];
            want[axis] = f;
            assert_near(&joint.passing([0.0; 3], rate), &want);
        }
    }
    // without Fo no cap; with SENSE only while the spring has a force
    let joint = JointBench::between_bodies("~C GSPR COMPRESSION X 1000 -X_DAMPING 5 2");
    assert_near(&joint.passing([-0.1, 0.0, 0.0], [-10.0, 0.0, 0.0]), &[-600.0, 0.0, 0.0]);
    assert_near(&joint.passing([0.1, 0.0, 0.0], [-10.0, 0.0, 0.0]), &[0.0; 3]);
    // statics know no rates
    assert_near(&joint.pull([-0.1, 0.0, 0.0])[..3], &[-100.0, 0.0, 0.0]);
}

#[test]
fn friction_limits_resultant_of_lateral_springs() {
    let joint = JointBench::between_bodies("~C GSPR X 1000 Y 200 Z 200 -FRICTION 0.3");
    // Fx 100: at most 30; (60, 80) is cut to (18, 24), (12, 16) is not
    assert_near(&joint.pull([0.1, 0.3, 0.4])[..3], &[100.0, 18.0, 24.0]);
    assert_near(&joint.pull([-0.1, 0.06, 0.08])[..3], &[-100.0, 12.0, 16.0]);
    assert_near(&joint.pull([0.1, 0.0, 0.0])[..3], &[100.0, 0.0, 0.0]);
}

#[test]
fn friction_without_lateral_springs_acts_against_relative_velocity() {
    let joint = JointBench::between_bodies("~C GSPR COMPRESSION X 1000 -FRICTION 0.3");
    // the second end slides with (0, 3, 4) m/s over the first and drags it along with 0.3 x 100 N; v0 = 0.01 m/s takes 2E-6 of it
    let got = joint.passing([-0.1, 0.0, 0.0], [0.0, 3.0, 4.0]);
    assert!((got[1] - 18.0).abs() < 1e-4 && (got[2] - 24.0).abs() < 1e-4, "{got:?}");
    assert_near(&joint.pull([-0.1, 0.5, 0.5])[..3], &[-100.0, 0.0, 0.0]);
    assert_near(&joint.passing([0.1, 0.0, 0.0], [0.0, 3.0, 4.0]), &[0.0; 3]);
}

const VISCOUS: &str =
    "&DATA CONVOLUTION TIME SOFT 0 5000 2 3819.5920 4 3103.6383 8 2406.0059 12 2149.3612 20 2020.2138 60 2000 -NDOF 1";

#[test]
fn viscoelastic_spring_is_in_series_with_own_stiffness_in_time() {
    // K(t) = 2000 + 3000 exp(-t/4) in series with 1000 N/m, a deflection of 0.6 m held: at once 1000 x 5000 / 6000, at last
    // 1000 x 2000 / 3000 of it; between, 1000 (u - w) = Kinf w + branch with the time constant 4 x 6000 / 3000 = 8 s
    let mut joint = JointBench::between_bodies(&format!("{VISCOUS}\n~C GSPR X 1000 -CONVOLUTION X SOFT"));
    assert_near(&joint.pull([0.6, 0.0, 0.0])[..1], &[400.0]);
    let force = |joint: &mut JointBench, dt: f64| {
        let (out, trial) = joint.evaluate_at([0.0; 6], [0.6, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 3], Some(dt));
        joint.state = trial;
        out.wrench[0][0]
    };
    let at_once = force(&mut joint, 1e-9);
    assert!((at_once - 500.0).abs() < 1e-3, "{at_once}");
    let mut last = 0.0;
    for _ in 0..1000 {
        last = force(&mut joint, 0.008);
    }
    // after 8 s: 400 + 100 / e; the curve is given to eight figures, and 1000 steps of second order
    assert!((last - (400.0 + 100.0 / std::f64::consts::E)).abs() < 1e-2, "{last}");
    // in a rotation the same numbers are N m/rad
    let turned = JointBench::between_bodies(&format!("{VISCOUS}\n~C GSPR RX 1000 -CONVOLUTION RX SOFT"));
    let (out, _) = turned.evaluate_at([0.0; 6], [0.0, 0.0, 0.0, 0.6, 0.0, 0.0], [0.0; 3], None);
    assert_near(&out.wrench[0].as_slice()[3..4], &[400.0]);
}

#[test]
fn rotational_curve_in_feet_is_moment_per_radian() {
    let (mut session, _, _folder) = common::session();
    let records = "&DATA CONVOLUTION TIME SOFT 0 5 10 2\nMEDIT\n&DESCRIBE BODY ONE\n*A 0 0 0\n~C GSPR RX 2 -CONVOLUTION RX SOFT\n\
                   CONNECTOR IT ~C *A\nEND";
    session.open("records", records);
    session.run();
    let model = &session.job.model;
    let connector = model.connectors.values().next().unwrap();
    let ends = [Pose::from_place(&Place::new([0.0, 0.0, 0.0, 0.1, 0.0, 0.0])), Pose::default()];
    let surroundings = model.surroundings();
    let curve = |name: &str| model.curves.get(&Model::key(name));
    let made = Connection {
        connector,
        ends,
        to_ground: true,
        placement: Placement::default(),
        curve: &curve,
        surroundings: &surroundings,
        ambient: None,
        duty: RunRequirement::default(),
        tied: &windlass_model::TiedBodies::default,
    };
    let element = model.classes.values().next().unwrap().object.element(&made).unwrap();
    let at = Situation { ends: &ends.map(End::at_rest), step: None, surroundings: &surroundings };
    let summary = element.summary(&at, &vec![0.0; element.states()]).unwrap();
    // 2 kip ft/rad twice in series, turned by 0.1 rad: 0.1 kip ft
    assert_near(&[summary.springs[0].force / (4448.2216152605 * 0.3048)], &[-0.1]);
}

#[test]
fn report_has_deflections_forces_and_largest_utilisation() {
    let joint = JointBench::between_bodies("~C FOUNDATION COMPRESSION X 1000 500 Y 200 50 Z 300 -IG_STIFF");
    let summary = joint.summary([0.0; 6], [-0.1, 0.3, 0.2, 0.0, 0.0, 0.0]);
    assert_eq!(summary.tension, Some(-100.0));
    assert_near(&[summary.ratio.unwrap()], &[1.2]);
    let list: Vec<(&str, f64, f64)> = summary.springs.iter().map(|s| (s.dof.as_str(), s.deflection, s.force)).collect();
    assert_eq!(list.iter().map(|s| s.0).collect::<Vec<_>>(), ["X", "Y", "Z"]);
    assert_near(&[list[1].1, list[1].2], &[0.3, 60.0]);
    assert!(summary.notes[0].without_values().contains("beyond its allowable"));
    assert_eq!(joint.element.category(), ConnectorCategory::Flexible);
    assert!(
        joint
            .session
            .job
            .model
            .classes
            .values()
            .all(|c| c.object.role() == ClassRole::Foundation && c.ignored_stiffness)
    );
}

/// An upright cone of 1 m, mouth 0.8 m, for a pin of 0.4 m: T = 0.2; the pin is the first end, the cone the second.
const LMU: &str = "~C LMU 1000 400 800 X 5000 Y 3000";

fn pin(x: f64, down: f64) -> [f64; 3] {
    let joint = JointBench::between_bodies(LMU);
    let (out, _) = joint.evaluate_at([x, 0.0, -down, 0.0, 0.0, 0.0], [0.0; 6], [0.0; 3], None);
    [out.wrench[0][0], out.wrench[0][1], out.wrench[0][2]]
}

#[test]
fn pin_above_cone_and_centred_unlanded_pin_have_no_force() {
    assert_near(&pin(0.5, -0.01), &[0.0; 3]);
    assert_near(&pin(0.0, 0.0), &[0.0; 3]);
    assert_near(&pin(0.0, 0.999), &[0.0; 3]);
    assert_near(&pin(0.0, 1.1), &[0.0, 0.0, 500.0]);
}

#[test]
fn pin_at_side_of_cone_is_pushed_to_axis_and_up() {
    // D_v 0.4: room 0.2 x 0.6 = 0.12, d = 0.18 - 0.12 = 0.06, c = 0.012
    assert_near(&pin(0.18, 0.4), &[-180.0, 0.0, 60.0]);
    assert_near(&pin(-0.18, 0.4), &[180.0, 0.0, 60.0]);
    assert_near(&pin(0.11, 0.4), &[0.0; 3]);
    // -SYMMETRIC is the default: across too
    let joint = JointBench::between_bodies(LMU);
    let (out, _) = joint.evaluate_at([0.0, 0.18, -0.4, 0.0, 0.0, 0.0], [0.0; 6], [0.0; 3], None);
    assert_near(&out.wrench[0].as_slice()[..3], &[0.0, -180.0, 60.0]);
}

#[test]
fn landed_pin_is_pushed_up_by_bottom_and_by_side() {
    // D_v 1.1, D_h 0.05: d = 0.05, c = 0.1 + 0.01
    assert_near(&pin(0.05, 1.1), &[-150.0, 0.0, 550.0]);
}

#[test]
fn cone_rotates_with_its_body_and_with_euler() {
    // body TWO lies on its side: its z axis along global x (a pitch of 90 degrees); the pin comes from +x
    let joint = JointBench::between_bodies(LMU);
    let lying = [0.0, 0.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2, 0.0];
    let (out, _) = joint.evaluate_at([-1.1, 0.05, 0.0, 0.0, 0.0, 0.0], lying, [0.0; 3], None);
    assert_near(&out.wrench[0].as_slice()[..3], &[550.0, -150.0, 0.0]);
    let euler = JointBench::new(LMU, "-EULER 0 90 0 ~C *A *B");
    let (out, _) = euler.evaluate_at([-1.1, 0.05, 0.0, 0.0, 0.0, 0.0], [0.0; 6], [0.0; 3], None);
    assert_near(&out.wrench[0].as_slice()[..3], &[550.0, -150.0, 0.0]);
}

#[test]
fn pin_entering_beside_cone_mouth_is_warned() {
    let joint = JointBench::between_bodies(LMU);
    assert!(
        joint.summary([0.3, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 6]).notes[0]
            .without_values()
            .contains("outside of the cone's mouth")
    );
    assert!(joint.summary([0.15, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 6]).notes.is_empty());
}

#[test]
fn slings_and_davits_have_ae_over_l_in_tension_only() {
    // 50 mm: A = 1.9634954E-3 m2; E 2E5 MPa: AE/L = 3.9269908E8 / 5; the ends 5.1 m apart along (0.6, 0, -0.8)
    for kind in ["SLING", "DAVIT"] {
        let joint = JointBench::new(&format!("~C {kind} 50 -LEN 5 -EMOD 2E5"), "~C *A");
        let force = std::f64::consts::FRAC_PI_4 * 0.0025 * 2e11 / 5.0 * 0.1;
        assert_near(&joint.pull([3.06, 0.0, -4.08]), &[0.6 * force, 0.0, -0.8 * force, 0.0, 0.0, 0.0]);
        assert_near(&joint.pull([2.9, 0.0, -4.0]), &[0.0; 6]);
        assert_near(&joint.pull([0.0; 3]), &[0.0; 6]);
    }
}

#[test]
fn roller_pushes_beyond_its_gaps_and_frees_pipe_within() {
    let joint = JointBench::new("~C ROLLER Y 1000 Z 2000 -Y_ROLLER 20 30 -Z_ROLLER 0 10000", "~C *A");
    assert_near(&joint.pull([0.0, 0.03, 5.0])[..3], &[0.0; 3]);
    // on the node: pressed down by the pipe 0.1 m below it; beside: 0.05 beyond +30 mm, 0.05 beyond -20 mm
    assert_near(&joint.pull([0.3, 0.08, -0.1])[..3], &[0.0, 50.0, -200.0]);
    assert_near(&joint.pull([0.0, -0.07, 0.1])[..3], &[0.0, -50.0, 0.0]);
    // one pair alone: the other direction is free
    let sides = JointBench::new("~C ROLLER Y 1000 Z 2000 -Y_ROLLER 20 30", "~C *A");
    assert_near(&sides.pull([0.0, 0.08, -0.1])[..3], &[0.0, 50.0, 0.0]);
}

#[test]
fn roller_without_gaps_holds_pipe_by_curves_in_series() {
    let joint = JointBench::new("~C ROLLER X 1", "~C *A");
    assert_near(&joint.pull([0.0, 1e-3, 0.1])[..3], &[0.0, 1e6, 0.0]);
    assert_near(&joint.pull([0.0, 0.0, -1e-3])[..3], &[0.0, 0.0, -1e6]);
    // 1000 N/m and 100 N at 0.1 m: 0.2 m together
    for (name, at, force) in [("Y", [0.0, 0.2, 0.0], [0.0, 100.0, 0.0]), ("Z", [0.0, 0.0, -0.2], [0.0, 0.0, -100.0])] {
        let joint = JointBench::new(&format!("~C ROLLER Y 1000 Z 1000 -{name}_PY 100 0.1"), "~C *A");
        assert_near(&joint.pull(at)[..3], &force);
    }
}

#[test]
fn restraints_have_no_force_at_definition_and_are_rigid_from_there() {
    let records = |class: &str| format!("*AWAY 3 4 5\n{class}");
    let fix = JointBench::new(&records("~C FIX X Z RY"), "~C *A *AWAY");
    assert_near(&fix.pull([3.0, 4.0, 5.0]), &[0.0; 6]);
    let got = fix.pull([3.0 + 1e-9, 7.0, 5.0]);
    assert!((got[0] - 1000.0).abs() < 1.0 && got[1] == 0.0, "{got:?}");
    let all = JointBench::new(&records("~C FIX"), "~C *A *AWAY");
    let (got, _) = all.evaluate_at([0.0; 6], [3.0, 4.0, 5.0, 1e-9, 0.0, 0.0], [0.0; 3], None);
    assert!((got.wrench[0][3] - 1000.0).abs() < 1.0, "{}", got.wrench[0]);
    let spr = JointBench::new(&records("~C SPR X 1000 RZ 50"), "~C *A *AWAY");
    assert_near(&spr.pull([3.1, 4.0, 5.0])[..3], &[100.0, 0.0, 0.0]);
    assert!([fix, spr].iter().all(|joint| joint.element.category() == ConnectorCategory::Rigid));
}

#[test]
fn gap_pushes_sticks_slides_and_releases() {
    let mut gap = JointBench::between_bodies("~C GAP 0.3");
    assert_near(&gap.pull([1e-3, 0.2, 0.0]), &[0.0; 6]);
    // pressed by 1E6 N: sticks up to 3E5 N, 0.3 um; then slides, and the force stays
    assert_near(&gap.pull([-1e-6, 2e-7, 0.0])[..3], &[-1e6, 2e5, 0.0]);
    let slid = [-1e-6, 0.0, 0.5, 0.0, 0.0, 0.0];
    let (out, trial) = gap.evaluate_at([0.0; 6], slid, [0.0; 3], Some(0.1));
    assert_near(&out.wrench[0].as_slice()[..3], &[-1e6, 0.0, 3e5]);
    // from where it slid to, 0.2 um back: 2E5 N less
    gap.state = trial;
    assert_near(&gap.pull([-1e-6, 0.0, 0.5 - 2e-7])[..3], &[-1e6, 0.0, 1e5]);
    let smooth = JointBench::between_bodies("~C GAP");
    assert_near(&smooth.pull([-1e-6, 0.5, 0.0])[..3], &[-1e6, 0.0, 0.0]);
}

#[test]
fn tug_force_is_toward_its_direction() {
    let joint = JointBench::new("~C TUG_BOAT 500", "-TUG 60 100 ~C *A");
    let (out, _) = joint.evaluate_at([1.0, 2.0, 3.0, 0.1, 0.2, 0.3], [0.0; 6], [0.0; 3], None);
    assert_near(out.wrench[0].as_slice(), &[250.0, 500.0 * 0.75_f64.sqrt(), 0.0, 0.0, 0.0, 0.0]);
    assert!(out.stiffness.iter().all(|k| k.amax() == 0.0));
}

#[test]
fn constant_tension_line_stiffness_matches_chord_direction() {
    let joint = JointBench::between_bodies("~C CT_LINE 2600");
    // the chord (3, 4, 12) is 13 m long: 200 N a metre
    let (out, _) = joint.evaluate_at([0.0; 6], [3.0, 4.0, 12.0, 0.0, 0.0, 0.0], [0.0; 3], None);
    assert_near(out.wrench[0].as_slice(), &[600.0, 800.0, 2400.0, 0.0, 0.0, 0.0]);
    assert_near(out.wrench[1].as_slice(), &[-600.0, -800.0, -2400.0, 0.0, 0.0, 0.0]);
    // 2600 / 13 (1 - n n'), n = (3, 4, 12) / 13
    let row = |block: usize, i: usize| [0, 1, 2].map(|j| out.stiffness[block][(i, j)]);
    assert_near(&row(0, 0), &[200.0 * 160.0 / 169.0, -200.0 * 12.0 / 169.0, -200.0 * 36.0 / 169.0]);
    assert_near(&row(1, 2), &[200.0 * 36.0 / 169.0, 200.0 * 48.0 / 169.0, -200.0 * 25.0 / 169.0]);
}

#[test]
fn winch_friction_changes_tension_winding_in_and_paying_out() {
    // 1000 N, friction 0.3 and 0.1: 700 N winding in and 1100 N paying out, the example of the workbench's manual
    let joint = JointBench::between_bodies("~C CT_LINE 1000 -LENGTH 5 -FRICTION 0.3 0.1");
    assert_eq!(joint.pull([6.0, 0.0, 0.0])[0], 700.0);
    assert_eq!(joint.passing([6.0, 0.0, 0.0], [-0.5, 0.0, 0.0])[0], 700.0);
    assert!((joint.passing([6.0, 0.0, 0.0], [0.5, 0.0, 0.0])[0] - 1100.0).abs() < 1e-9);
    // a negative factor of winding in: the tension of paying out at rest
    let joint = JointBench::between_bodies("~C CT_LINE 1000 -LENGTH 5 -FRICTION -0.3 0.1");
    assert!((joint.pull([6.0, 0.0, 0.0])[0] - 1100.0).abs() < 1e-9);
    assert!((joint.passing([6.0, 0.0, 0.0], [-0.5, 0.0, 0.0])[0] - 700.0).abs() < 1e-9);
    // nearer than its length it is slack
    assert_eq!(joint.pull([4.99, 0.0, 0.0])[0], 0.0);
}

#[test]
fn nonlinear_line_follows_polynomial_and_steel_wire_law() {
    // 13 m apart, 1 m beyond 12: 3 + 5 + 7 + 11 + 13 N; 1.5 m beyond 11.5 by numpy.polyval([13, 11, 7, 5, 3, 0], 1.5)
    let poly = |length: &str| {
        JointBench::between_bodies(&format!("~C NLIN {length} -POLY 3 5 7 11 13")).pull([3.0, 4.0, 12.0])
    };
    assert_near(&poly("12")[..3], &[39.0 * 3.0 / 13.0, 12.0, 36.0]);
    assert_near(&poly("11.5")[..3], &[193.78125 * 3.0 / 13.0, 193.78125 * 4.0 / 13.0, 193.78125 * 12.0 / 13.0]);
    // at its length and below it is slack
    assert_eq!((poly("13")[0], poly("14")[0]), (0.0, 0.0));
    // k (e - d tanh(e/d)) with k = 2E5 N/m, d = 0.4 m, e = 0.5 m: 2E5 (0.5 - 0.4 numpy.tanh(1.25)) = 32137.30880
    let wire = JointBench::between_bodies("~C NLIN 12.5 -SWIRE 2E5 0.4").pull([13.0, 0.0, 0.0]);
    assert!((wire[0] - 32_137.308_803).abs() < 1e-3, "{wire:?}");
}

#[test]
fn line_over_pulley_shares_stretch_by_ratio_of_tensions() {
    // 13 m to the pulley and 8 m behind it of 20 m: 1E5 N without friction; running with 1.2, 21E5 / (13 + 8 / 1.2) and 21E5 / (13 + 8 1.2)
    let joint = JointBench::between_bodies("~C PULY 1E5 20 8 -RATIO 1.2");
    let pull = |rate: f64| {
        let [x, y, z] = joint.passing([3.0, 4.0, 12.0], [3.0, 4.0, 12.0].map(|part| rate * part / 13.0));
        x.hypot(y).hypot(z)
    };
    assert_near(&[pull(0.0), pull(0.5), pull(-0.5)], &[1e5, 21e5 / (13.0 + 8.0 / 1.2), 21e5 / (13.0 + 9.6)]);
    assert_eq!(joint.pull([3.0, 4.0, 10.0])[0], 0.0);
}

#[test]
fn drum_winds_in_to_its_last_length_or_largest_tension() {
    // EA = 2E5 N/m times (10 + 2) m; the ends 10.1 m apart
    let drum = |data: &str, dt: f64| {
        let joint = JointBench::between_bodies(&format!("~C LNDW 2E5 10 {data} -ADDED 2"));
        let (out, trial) = joint.evaluate_at([0.0; 6], [10.1, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 3], Some(dt));
        (out.wrench[0][0], trial[0])
    };
    let tension = |free: f64| 2.4e6 / (2.0 + free) * (10.1 - free);
    let meets = |got: (f64, f64), free: f64, force: f64| {
        assert!(
            (got.0 - force).abs() < 1e-6 * force && (got.1 - (free - 10.0)).abs() < 1e-9,
            "{got:?}, {free} {force}"
        );
    };
    meets(drum("9 -0.1", 2.0), 9.8, tension(9.8));
    meets(drum("9.9 -0.1", 2.0), 9.9, tension(9.9));
    // paying out: slack beyond 10.1 m
    meets(drum("10.05 0.1", 2.0), 10.05, tension(10.05));
    // 50 kN at most: EA (10.1 - L) = 5E4 (2 + L)
    let held = (2.4e6 * 10.1 - 5e4 * 2.0) / (2.4e6 + 5e4);
    meets(drum("9 -0.1 5E4", 2.0), held, 5e4);
    // the tension is beyond it at once: the drum stands
    meets(drum("9 -0.1 1E4", 2.0), 10.0, tension(10.0));
    // a final length on the wrong side, and a start that is still to come
    meets(drum("11 -0.1", 2.0), 10.0, tension(10.0));
    meets(drum("9 -0.1 -START 5", 2.0), 10.0, tension(10.0));
    meets(drum("9 -0.1 -START 1.5", 2.0), 9.95, tension(9.95));
}

/// 1.5 m high; 200 kN at 0.3 m, 150 kN at 0.5 m, 300 kN at 0.8 m.
const BUCKLING: &str = "~C FENDER 1.5 2E5 0.3 1.5E5 0.5 3E5 0.8 -RATED 0.6 -NORMAL 0 1 0";

#[test]
fn fender_pushes_by_curve_along_normal_and_never_pulls() {
    let joint = JointBench::between_bodies(BUCKLING);
    // the face at y: deflection 1.5 - y, at 1.3 on the first piece, at 1.1 on the falling one, at 0.6 beyond the last point
    for (y, push) in [(1.6, 0.0), (1.5, 0.0), (1.3, 2e5 * 0.2 / 0.3), (1.1, 1.75e5), (1.0, 1.5e5), (0.6, 3.5e5)] {
        assert_near(&joint.pull([0.4, y, 0.2])[..3], &[0.0, -push, 0.0]);
    }
    // a face that has slid along by (3, 2) m is pushed where the fender stands: a moment about its point
    let (got, _) = joint.evaluate_at([0.0; 6], [3.0, 1.3, 2.0, 0.0, 0.0, 0.0], [0.0; 3], None);
    let push = 2e5 * 0.2 / 0.3;
    assert_near(got.wrench[1].as_slice(), &[0.0, push, 0.0, 2.0 * push, 0.0, -3.0 * push]);
    assert_near(got.wrench[0].as_slice(), &[0.0, -push, 0.0, 0.0, 0.0, 0.0]);
    // a face turned by 30 degrees about z through (0, 1.3, 0): 1.3 cos 30 from the base, and pushed along its own normal
    let turn = std::f64::consts::PI / 6.0;
    let (got, _) = joint.evaluate_at([0.0; 6], [0.0, 1.3, 0.0, 0.0, 0.0, turn], [0.0; 3], None);
    let push = 2e5 + (1.5 - 1.3 * turn.cos() - 0.3) * (1.5e5 - 2e5) / 0.2;
    assert_near(&got.wrench[1].as_slice()[..3], &[-push * turn.sin(), push * turn.cos(), 0.0]);
}

#[test]
fn fender_reports_deflection_and_energy_and_warns_beyond_rating() {
    let joint = JointBench::between_bodies(BUCKLING);
    let summary = joint.summary([0.0; 6], [0.0, 0.85, 0.0, 0.0, 0.0, 0.0]);
    let state = summary.fender.unwrap();
    // to 0.3 m 30 kNm, to 0.5 m (200 + 150) / 2 x 0.2 = 35 kNm, to 0.65 m (150 + 225) / 2 x 0.15 = 28.125 kNm; rated 0.6 m, 200 kN there
    assert_near(
        &[state.deflection, state.reaction, state.energy, state.rated_energy],
        &[0.65, 2.25e5, 93.125e3, 65e3 + 17.5e3],
    );
    assert!(
        summary.notes[0].without_values().contains("warning: deflected to 108 per cent of the rated deflection"),
        "{:?}",
        summary.notes
    );
    let crushed = joint.summary([0.0; 6], [0.0, -0.1, 0.0, 0.0, 0.0, 0.0]);
    assert!(crushed.notes[0].without_values().contains("stands behind the base"), "{:?}", crushed.notes);
    assert!(joint.summary([0.0; 6], [0.0, 0.95, 0.0, 0.0, 0.0, 0.0]).notes.is_empty());
}

#[test]
fn fender_with_dashpot_pushes_more_going_in_and_never_pulls() {
    let joint = JointBench::between_bodies("~C FENDER 1.5 2E5 0.4 -FRICTION 0.25 -X_DAMPING 1E5 1");
    // 0.2 m: 100 kN; 0.5 m/s: 50 kN
    assert_near(&joint.passing([1.3, 0.0, 0.0], [-0.5, 0.0, 0.0]), &[-1.5e5, 0.0, 0.0]);
    assert_near(&joint.passing([1.3, 0.0, 0.0], [0.5, 0.0, 0.0]), &[-0.5e5, 0.0, 0.0]);
    assert_near(&joint.passing([1.3, 0.0, 0.0], [3.0, 0.0, 0.0]), &[0.0; 3]);
    // sliding too: a quarter of 150 kN going in, of 50 kN coming out, nothing where it has come off
    for (speed, normal) in [(-0.5, 1.5e5), (0.5, 0.5e5), (3.0, 0.0)] {
        let got = joint.passing([1.3, 0.0, 0.0], [speed, 3.0, 4.0]);
        assert!((got[1] - 0.15 * normal).abs() < 0.1 && (got[2] - 0.2 * normal).abs() < 0.1, "{got:?}");
    }
    // 25 kN along a face that slides with (0, 3, 4) m/s; v0 = 0.01 m/s takes 2E-6 of it
    let got = joint.passing([1.3, 0.0, 0.0], [0.0, 3.0, 4.0]);
    assert!((got[1] - 15e3).abs() < 0.1 && (got[2] - 20e3).abs() < 0.1, "{got:?}");
}
