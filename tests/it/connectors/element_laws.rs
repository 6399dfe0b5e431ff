//! Laws that the element of every class obeys, whatever its force: a class is under them the day its element exists.

use crate::common;

use nalgebra::{Matrix3, Rotation3, Vector3};
use windlass::session::Session;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_connectors::CLASSES;
use windlass_model::{
    ClassError, Connection, Connector, ConnectorElement, ConnectorResponse, End, Model, Placement, RunRequirement,
    Situation, SolverCache, Surroundings, TimeStep,
};

/// What a force obeys beside being the same for the same.
#[derive(Clone, Copy, PartialEq)]
enum ConnectorKind {
    /// It has an energy.
    Elastic,
    /// It takes energy, never gives any.
    Dissipative,
    /// Neither is promised: the text of the manual makes forces without energy (an LMU of unlike springs, -FRICTION on a spring).
    Other,
}

struct ClassCase {
    class: &'static str,
    records: &'static str,
    connector: &'static str,
    /// Displacement of the second end from the first at definition (m), in the axes of the first.
    defined: [f64; 3],
    /// The same now, and the turn of the second end against the first.
    now: [f64; 6],
    kind: ConnectorKind,
    /// Whether the wrenches of the ends balance: what has no weight, and nobody else bears.
    balanced: bool,
    /// Whether gravity or a fixed direction plays no part.
    free: bool,
}

const fn spring(class: &'static str, records: &'static str, now: [f64; 6], kind: ConnectorKind) -> ClassCase {
    ClassCase { class, records, connector: "", defined: [0.0; 3], now, kind, balanced: true, free: true }
}

const SMALL_MOTION: [f64; 6] = [-0.2, 0.15, -0.1, 0.3, -0.2, 0.4];

fn cases() -> Vec<ClassCase> {
    use ConnectorKind::{Dissipative, Elastic, Other};
    let line = |class, records, connector, now: [f64; 3]| ClassCase {
        class,
        records,
        connector,
        defined: now,
        now: [now[0], now[1], now[2], 0.0, 0.0, 0.0],
        // tests/it/connectors/line_laws.rs has the laws of energy of lines
        kind: Other,
        balanced: false,
        free: false,
    };
    vec![
        spring(
            "FOUNDATION",
            "~C FOUNDATION COMPRESSION X 2E5 1E4 Y 1E5 Z 5E4 RX 3E4 RY 2E4 RZ 1E4",
            SMALL_MOTION,
            Elastic,
        ),
        spring("GSPR", "~C GSPR Z 2E5 RY 3E4 -LEN 1.5", SMALL_MOTION, Elastic),
        ClassCase {
            connector: "-EULER 20 -30 40",
            ..spring("GSPR", "~C GSPR X 2E5 Y 1E5 RX 3E4 -SYMMETRIC", SMALL_MOTION, Elastic)
        },
        spring(
            "GSPR",
            "~C GSPR TENSION X 2E5 Y 1E5 -SYMM -X_PY 1E3 0.1 9E4 0.3 -Y_PY 1E2 0.05 1E4 0.5",
            [0.2, 0.15, -0.1, 0.0, 0.1, 0.0],
            Elastic,
        ),
        spring(
            "GSPR",
            "~C GSPR X 2E5 Y 1E5 Z 1E5 RZ 4E4 -X_DAMPING 5E3 1 -Y_DAMPING 4E3 2 9E2 -Z_DAMPING 3E3 0.5",
            SMALL_MOTION,
            Dissipative,
        ),
        spring("GSPR", "~C GSPR X 2E5 Y 1E5 -SYMM -Y_DAMPING 4E3 1.7", SMALL_MOTION, Dissipative),
        spring("GSPR", "~C GSPR COMPRESSION X 2E5 Y 1E5 Z 7E4 -FRICTION 0.2 -X_DAMPING 5E3 1", SMALL_MOTION, Other),
        spring("GSPR", "~C GSPR COMPRESSION X 2E5 -FRICTION 0.2", SMALL_MOTION, Dissipative),
        spring(
            "GSPR",
            "~C GSPR COMPRESSION X 2E5 Y 1E5 RX 5E4 -CONVOLUTION X SOFT -CONVOLUTION RX SOFT -CONVOLUTION Y SOFT -X_PY 1E3 0.05 9E4 0.2",
            SMALL_MOTION,
            Dissipative,
        ),
        spring(
            "GSPR",
            "~C GSPR X 2E5 Y 1E5 -SYMM -CONVOLUTION Y SOFT -Y_PY 1E3 0.05 9E4 0.3",
            SMALL_MOTION,
            Dissipative,
        ),
        // the side of the cone; the pin is the first end, and the second end is the cone: 0.4 m below its mouth, then 1.3 m
        spring("LMU", "~C LMU 1000 400 800 X 2E5 Y 2E5", [-0.3, 0.25, 0.4, 0.1, 0.05, 0.3], Elastic),
        spring("LMU", "~C LMU 1000 400 800 X 2E5 Y 1E5 RX 3E4", [-0.3, 0.25, 0.4, 0.1, 0.05, 0.3], Other),
        spring(
            "LMU",
            "~C LMU 1000 400 800 X 2E5 Y 1E5 Z 6E4 -X_DAMPING 4E3 1 -SYMM NO",
            [-0.1, 0.05, 1.3, 0.1, 0.05, 0.3],
            Other,
        ),
        spring(
            "ROLLER",
            "~C ROLLER Y 1E5 Z 2E5 -Y_ROLLER 20 30 -Z_ROLLER 10 5000",
            [0.3, 0.3, -0.4, 0.1, 0.2, -0.1],
            Elastic,
        ),
        spring("ROLLER", "~C ROLLER Y 1E5 Z 2E5 -Z_PY 1E3 0.05 9E4 0.3", [0.3, 0.3, -0.4, 0.0, 0.0, 0.0], Elastic),
        // on the falling piece of its curve, the face turned
        spring(
            "FENDER",
            "~C FENDER 1.5 2E4 0.3 1.5E4 0.5 4E4 0.8 -NORMAL 1 0.2 0.1",
            [1.1, 0.15, -0.1, 0.3, -0.2, 0.4],
            Elastic,
        ),
        spring(
            "FENDER",
            "~C FENDER 1.5 2E4 0.3 4E4 0.8 -FRICTION 0.3 -X_DAMPING 5E3 1.2",
            [1.1, 0.15, -0.1, 0.1, -0.2, 0.1],
            Dissipative,
        ),
        spring("SLING", "~C SLING 50 -LEN 5", [1.0, 3.0, -4.0, 0.2, 0.3, 0.1], Elastic),
        spring("DAVIT", "~C DAVIT 50 -LEN 5", [1.0, 3.0, -4.0, 0.2, 0.3, 0.1], Elastic),
        ClassCase {
            defined: [0.5, 1.0, -2.0],
            ..spring("FIX", "~C FIX", [0.51, 1.02, -1.99, 0.02, -0.03, 0.01], Elastic)
        },
        ClassCase {
            defined: [0.5, 1.0, -2.0],
            ..spring("SPR", "~C SPR X 2E5 Z 1E5 RY 3E4", [0.7, 1.2, -1.9, 0.2, -0.3, 0.1], Elastic)
        },
        ClassCase {
            defined: [0.5, 1.0, -2.0],
            ..spring("GAP", "~C GAP 0.3", [0.49, 1.002, -2.001, 0.0, 0.1, 0.0], Dissipative)
        },
        ClassCase {
            defined: [0.5, 1.0, -2.0],
            ..spring("GAP", "~C GAP 0.3", [0.49, 1.02, -2.03, 0.0, 0.1, 0.0], Dissipative)
        },
        ClassCase {
            connector: "-TUG 30 100",
            balanced: false,
            free: false,
            ..spring("TUG_BOAT", "~C TUG_BOAT 5E5", [0.0; 6], Elastic)
        },
        spring("CT_LINE", "~C CT_LINE 5E5", [1.0, 3.0, -4.0, 0.2, 0.3, 0.1], Elastic),
        // its tension rises over 5 mm, which the quadrature of the work does not resolve
        spring("CT_LINE", "~C CT_LINE 5E5 -LENGTH 5.097", [1.0, 3.0, -4.0, 0.2, 0.3, 0.1], Other),
        spring("NLIN", "~C NLIN 5 -POLY 2E5 1E4 3E4 4E3 5E2", [1.0, 3.0, -4.0, 0.2, 0.3, 0.1], Elastic),
        spring("NLIN", "~C NLIN 4 -SWIRE 2E5 0.8", [1.0, 3.0, -4.0, 0.2, 0.3, 0.1], Elastic),
        spring("PULY", "~C PULY 2E5 12 8", [1.0, 3.0, -4.0, 0.2, 0.3, 0.1], Elastic),
        spring("PULY", "~C PULY 2E5 12 8 -RATIO 1.3", [1.0, 3.0, -4.0, 0.2, 0.3, 0.1], Dissipative),
        // the drum winds in; it stands at its maximum
        spring("LNDW", "~C LNDW 2E5 5 3 -0.2 -START 1 -ADDED 2", [1.0, 3.0, -4.0, 0.2, 0.3, 0.1], Other),
        spring("LNDW", "~C LNDW 2E5 5 3 -0.2 3E4", [1.0, 3.0, -4.0, 0.2, 0.3, 0.1], Other),
        line(
            "B_CAT",
            "~C B_CAT 100 EXACT -LEN 1100 -BUOY 0 -WTPL 900 -DEP 200",
            "-ANCHOR 31 1050",
            [900.0, 550.0, -195.0],
        ),
        line("H_CAT", "~C H_CAT 100 EXACT -LEN 320 -WTPL 700", "", [200.0, 180.0, -40.0]),
        line("SL_ELEM", "~C SL_ELEM 100 -LEN 250", "", [200.0, 180.0, -40.0]),
        // TMAX held, TMIN held by a line on the bottom; no piston; TMAX held; the end of the stroke, and too slow a piston
        line(
            "B_CAT",
            "~C B_CAT 100 EXACT -LEN 1100 -BUOY 0 -WTPL 900 -DEP 200 -PISTON MAX 9000 1000 50 50 7E5 -X_DAMPING 2E4 1.5",
            "-ANCHOR 31 1050",
            [900.0, 550.0, -195.0],
        ),
        line(
            "B_CAT",
            "~C B_CAT 100 EXACT -LEN 500 -BUOY 0 -WTPL 900\n~C B_CAT 90 -LEN 600 -BUOY 0 -WTPL 800 -DEP 200 -FRICTION 0.4 \
             -CONVOLUTION SOFT -PISTON MINMAX 9000 4000 50 50 9E5 5E5 -SEND 3E5",
            "-ANCHOR 31 1050",
            [900.0, 550.0, -195.0],
        ),
        line(
            "H_CAT",
            "~C H_CAT 100 EXACT -LEN 320 -WTPL 700 -CONVOLUTION SOFT -X_DAMPING 4E4 0.5 9E4",
            "",
            [200.0, 180.0, -40.0],
        ),
        line(
            "H_CAT",
            "~C H_CAT 100 EXACT -LEN 300 -WTPL 700 -PISTON MAX 20000 1000 50 50 3E5",
            "",
            [200.0, 180.0, -150.0],
        ),
        line(
            "SL_ELEM",
            "~C SL_ELEM 100 -LEN 250 -PISTON MAX 60000 1000 90 50 3E5 -X_DAMPING 2E4 1",
            "",
            [200.0, 180.0, -40.0],
        ),
        line(
            "SL_ELEM",
            "~C SL_ELEM 100 TENSION -LEN 250 -CONVOLUTION SOFT -PISTON MINMAX 3000 1000 0.1 0.1 3E5 1E3",
            "",
            [200.0, 180.0, -40.0],
        ),
        line("CATENARY", "~C CATENARY 170 0.02 -LEN 360 -EA 7E8", "", [300.0, 180.0, -40.0]),
        line("TETHER", "~C TETHER 1.1 0.035 -LEN 250", "-FLUID 1E5 900 -GROUP 3", [20.0, 10.0, -249.4]),
        line("TETHER", "~C TETHER 0.9 0.045 -LEN 250\n~C TETHER 1.1 0.035 -LEN 20", "", [20.0, 10.0, -240.0]),
    ]
}

/// The poses of a case: the first end stands obliquely.
struct ElementBench {
    session: Session,
    connector: Connector,
    ends: [Pose; 2],
}

fn oblique(line: bool) -> Pose {
    let position = if line { [0.0, 0.0, -5.0, 0.0, 0.0, 0.0] } else { [4.0, -3.0, 2.0, 0.7, -0.4, 1.1] };
    Pose::from_place(&Place::new(position))
}

impl ElementBench {
    fn new(case: &ClassCase) -> ElementBench {
        let (mut session, screen, _folder) = common::session();
        let points =
            if ["SLING", "DAVIT", "ROLLER", "TUG_BOAT", "B_CAT"].contains(&case.class) { "*A" } else { "*A *B" };
        session.open(
            "records",
            format!(
                "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 300\n&DATA CONVOLUTION TIME SOFT 0 9E4 1 7E4 3 5E4 8 3E4 20 2E4 -NDOF 3\n\
                 MEDIT\n&DESCRIBE BODY ONE\n*A 0 0 -5\n&DESCRIBE BODY TWO\n*B 0 0 0\n{}\nCONNECTOR IT {} ~C {points}\nEND\n",
                case.records, case.connector
            ),
        );
        session.run();
        assert_eq!(session.errors, 0, "{}: {:?} {}", case.records, session.reports, screen.text());
        let mut connector = session.job.model.connectors.values().next().unwrap().clone();
        let line = !case.free && case.class != "TUG_BOAT";
        let first = oblique(line);
        let second = |[x, y, z, a, b, c]: [f64; 6]| {
            let turn = *Rotation3::new(Vector3::new(a, b, c)).matrix();
            let ground = case.class == "B_CAT";
            let axes = if ground { Matrix3::identity() } else { first.axes * turn };
            Pose { origin: first.point(Vector3::new(x, y, z)), axes }
        };
        let [x, y, z] = case.defined;
        connector.defined = [first, second([x, y, z, 0.0, 0.0, 0.0])];
        let ends = [first, second(case.now)];
        // of an LMU the second end is the cone, and `now` is where the tip stands in it, its third value down
        let ends = if case.class == "LMU" {
            let [x, y, down, a, b, c] = case.now;
            let turn = *Rotation3::new(Vector3::new(a, b, c)).matrix();
            let tip = Pose { origin: first.point(Vector3::new(x, y, -down)), axes: first.axes * turn };
            [tip, first]
        } else {
            ends
        };
        ElementBench { session, connector, ends }
    }

    fn element(&self) -> Result<Box<dyn ConnectorElement>, ClassError> {
        let model = &self.session.job.model;
        let class = model.classes.values().next().unwrap();
        let curve = |name: &str| model.curves.get(&Model::key(name));
        let surroundings = model.surroundings();
        let to_ground = self.connector.points.len() < 2 && class.object.as_line().is_some();
        let [fairlead, other] = self.ends.map(|e| e.origin.into());
        let placement =
            Placement { fairlead, other: Some(other), to_ground, anchored: to_ground, ..Placement::default() };
        class.object.element(&Connection {
            connector: &self.connector,
            ends: self.ends,
            to_ground,
            placement,
            curve: &curve,
            surroundings: &surroundings,
            ambient: None,
            duty: RunRequirement::default(),
            tied: &windlass_model::TiedBodies::default,
        })
    }

    fn surroundings(&self) -> Surroundings {
        self.session.job.model.surroundings()
    }
}

/// Each case whose class has an element, with its name.
fn each(mut check: impl FnMut(&ClassCase, &ElementBench, &dyn ConnectorElement)) {
    for case in cases() {
        let bench = ElementBench::new(&case);
        match bench.element() {
            Ok(element) => check(&case, &bench, element.as_ref()),
            Err(error) => {
                let line = bench.session.job.model.classes.values().next().unwrap().object.as_line().is_some();
                assert!(line, "{}: {error}", case.records);
            }
        }
    }
}

fn ask(
    element: &dyn ConnectorElement,
    surroundings: &Surroundings,
    ends: &[End; 2],
    dt: Option<f64>,
    committed: &[f64],
) -> (ConnectorResponse, Vec<f64>) {
    let mut out = ConnectorResponse::default();
    let mut trial = vec![f64::NAN; committed.len()];
    let step = dt.map(|dt| TimeStep { time: 10.0, dt });
    let at = Situation { ends, step, surroundings };
    element.evaluate(&at, committed, &mut trial, &mut SolverCache::new(), &mut out).unwrap();
    (out, trial)
}

/// Velocities of the two ends, unlike in all directions.
fn moving_ends(ends: [Pose; 2]) -> [End; 2] {
    [
        End { velocity: Six::new(0.4, -0.3, 0.2, 0.1, 0.25, -0.15), ..End::at_rest(ends[0]) },
        End { velocity: Six::new(-0.2, 0.35, 0.5, -0.3, 0.1, 0.2), ..End::at_rest(ends[1]) },
    ]
}

/// A state that a step from nearby has left.
fn state_after_step(element: &dyn ConnectorElement, bench: &ElementBench) -> Vec<f64> {
    let mut start = vec![0.0; element.states()];
    element.start(&mut start);
    let shift = Six::new(0.001, -0.002, 0.0015, 0.01, -0.02, 0.01);
    let before = [bench.ends[0].after_motion(&shift), bench.ends[1]].map(End::at_rest);
    ask(element, &bench.surroundings(), &before, Some(0.3), &start).1
}

#[test]
fn every_class_with_an_element_is_tested() {
    for kind in CLASSES {
        let name = kind.spec.name;
        // the state of a ROD is where it is in space: below are its laws at rest, in crates/line-dynamics/src/tests those of its steps
        if name == "ROD" || cases().iter().any(|c| c.class == name) {
            continue;
        }
        let (mut session, _, _folder) = common::session();
        session.open("records", kind.spec.example.to_string());
        session.run();
        let model = &session.job.model;
        let class = model.classes.values().next_back().unwrap();
        let (mut other, _, _folder) = common::session();
        other.open("records", "MEDIT\n*A 0 0 0\n*B 9 0 0\n~C GSPR X 1\nCONNECTOR IT ~C *A *B\nEND".to_string());
        other.run();
        let connector = other.job.model.connectors.values().next().unwrap();
        let ends = connector.defined;
        let surroundings = model.surroundings();
        let made = class.object.element(&Connection {
            connector,
            ends,
            to_ground: false,
            placement: Placement::default(),
            curve: &|_| None,
            surroundings: &surroundings,
            ambient: None,
            duty: RunRequirement::default(),
            tied: &windlass_model::TiedBodies::default,
        });
        assert!(made.is_err(), "{name} has an element and no case in tests/it/connectors/element_laws.rs");
    }
}

#[test]
fn dynamic_line_stiffness_matches_differences_and_rotates_with_ends() {
    let case = ClassCase {
        class: "ROD",
        records: "~C ROD 200 20 -LEN 60 -REFINE 6 -CLAMP BOTH",
        connector: "",
        defined: [45.0, 30.0, -20.0],
        now: [44.0, 31.0, -20.0, 0.1, -0.05, 0.02],
        kind: ConnectorKind::Other,
        balanced: false,
        free: false,
    };
    let bench = ElementBench::new(&case);
    let (element, surroundings) = (bench.element().unwrap(), bench.surroundings());
    let none = vec![0.0; element.states()];
    let rest = |ends: &[End; 2]| ask(element.as_ref(), &surroundings, ends, None, &none).0;
    let ends = bench.ends.map(End::at_rest);
    let middle = rest(&ends);
    let scale = middle.stiffness.iter().fold(0.0, |m: f64, k| m.max(k.amax()));
    for moved in 0..2 {
        for axis in 0..6 {
            let by = |size: f64| {
                let mut ends = ends;
                let mut motion = Six::zeros();
                motion[axis] = size;
                ends[moved].pose = ends[moved].pose.after_motion(&motion);
                rest(&ends)
            };
            let (plus, minus) = (by(1e-4), by(-1e-4));
            for end in 0..2 {
                let slope = (minus.wrench[end] - plus.wrench[end]) / 2e-4;
                let got = middle.stiffness[2 * end + moved].column(axis).into_owned();
                // a position of rest is found to 1e-9 of the forces in it, which are ten times the stiffness
                assert!((slope - got).amax() <= 1e-4 * scale, "{end} by {axis} of {moved}: {got} {slope}");
            }
        }
    }
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.7);
    let turned = rest(&ends.map(|e| {
        let pose = Pose { origin: turn * e.pose.origin, axes: turn * e.pose.axes };
        End::at_rest(pose)
    }));
    for (a, b) in turned.wrench.iter().zip(&middle.wrench) {
        for part in [0, 3] {
            let back: Vector3<f64> = turn.inverse() * a.fixed_rows::<3>(part).into_owned();
            assert!((back - b.fixed_rows::<3>(part)).amax() <= 1e-6 * b.amax(), "{a} {b}");
        }
    }
}

#[test]
fn stiffness_and_damping_match_wrench_finite_differences() {
    each(|case, bench, element| {
        let surroundings = bench.surroundings();
        let committed = state_after_step(element, bench);
        for dt in [None, Some(0.2)] {
            let ends = moving_ends(bench.ends);
            let (middle, _) = ask(element, &surroundings, &ends, dt, &committed);
            let scale = middle.stiffness.iter().fold(0.0, |m: f64, k| m.max(k.amax()));
            // metres or radians: small beside what bends the law, large beside rounding
            let line = bench.session.job.model.classes.values().all(|c| c.object.as_line().is_some());
            let (h, share) = if line { (1e-4, 1e-5) } else { (1e-6, 2e-6) };
            // an anchor does not move
            let ends_that_move = if line && bench.connector.points.len() < 2 { 0..1 } else { 0..2 };
            for moved in ends_that_move {
                for axis in 0..6 {
                    let by = |size: f64| {
                        let mut ends = ends;
                        let mut motion = Six::zeros();
                        motion[axis] = size;
                        ends[moved].pose = ends[moved].pose.after_motion(&motion);
                        ask(element, &surroundings, &ends, dt, &committed).0
                    };
                    let (plus, minus) = (by(h), by(-h));
                    for end in 0..2 {
                        let slope = (minus.wrench[end] - plus.wrench[end]) / (2.0 * h);
                        let got = middle.stiffness[2 * end + moved].column(axis).into_owned();
                        assert!(
                            (slope - got).amax() <= share * scale,
                            "{} dt {dt:?}: wrench {end} by motion {axis} of end {moved}: {got} is not {slope}",
                            case.records
                        );
                    }
                    let by = |size: f64| {
                        let mut ends = ends;
                        ends[moved].velocity[axis] += size;
                        ask(element, &surroundings, &ends, dt, &committed).0
                    };
                    let (plus, minus) = (by(h), by(-h));
                    let largest = middle.damping.iter().fold(1e-6 * scale, |m: f64, k| m.max(k.amax()));
                    for end in 0..2 {
                        let slope = (minus.wrench[end] - plus.wrench[end]) / (2.0 * h);
                        let got = middle.damping.get(2 * end + moved).map(|b| b.column(axis).into_owned());
                        let got = got.unwrap_or_default();
                        // rounding of the wrench counts where nothing depends on the rate
                        let fine = 2e-6 * largest + 1e-15 * middle.wrench[end].amax() / h;
                        assert!(
                            (slope - got).amax() <= fine,
                            "{} dt {dt:?}: wrench {end} by rate {axis} of end {moved}: {got} is not {slope}",
                            case.records
                        );
                    }
                }
            }
        }
    });
}

#[test]
fn rotated_pose_has_rotated_wrenches() {
    each(|case, bench, element| {
        let surroundings = bench.surroundings();
        let committed = state_after_step(element, bench);
        let axis = if case.free { Vector3::new(0.5, -1.1, 0.8) } else { Vector3::new(0.0, 0.0, 1.3) };
        if case.class == "TUG_BOAT" {
            return;
        }
        let turn = *Rotation3::new(axis).matrix();
        let both = |v: &Six| {
            let (a, b) = (turn * v.fixed_rows::<3>(0), turn * v.fixed_rows::<3>(3));
            Six::new(a.x, a.y, a.z, b.x, b.y, b.z)
        };
        let ends = moving_ends(bench.ends);
        let turned = ends.map(|end| End {
            pose: Pose { origin: turn * end.pose.origin, axes: turn * end.pose.axes },
            velocity: both(&end.velocity),
            acceleration: both(&end.acceleration),
        });
        let (straight, _) = ask(element, &surroundings, &ends, Some(0.2), &committed);
        let (got, _) = ask(element, &surroundings, &turned, Some(0.2), &committed);
        for (a, b) in got.wrench.iter().zip(&straight.wrench) {
            let scale = b.amax().max(1.0);
            assert!(
                (a - both(b)).amax() <= 1e-9 * scale.max(straight.stiffness[0].amax() * 1e-5),
                "{}: {a} {b}",
                case.records
            );
        }
    });
}

#[test]
fn end_wrenches_are_equal_and_opposite() {
    each(|case, bench, element| {
        if !case.balanced {
            return;
        }
        let committed = state_after_step(element, bench);
        let ends = moving_ends(bench.ends);
        for dt in [None, Some(0.2)] {
            let (got, _) = ask(element, &bench.surroundings(), &ends, dt, &committed);
            let part = |six: &Six, from: usize| six.fixed_rows::<3>(from).into_owned();
            let [one, two] = [&got.wrench[0], &got.wrench[1]];
            assert!(one.amax() > 1.0, "{}: no force to judge by", case.records);
            let arm = ends[1].pose.origin - ends[0].pose.origin;
            let (force, moment) = (part(one, 0) + part(two, 0), part(one, 3) + part(two, 3) + arm.cross(&part(two, 0)));
            assert!(force.amax() <= 1e-12 * one.amax(), "{}: {force}", case.records);
            assert!(
                moment.amax() <= 1e-12 * one.amax().max(two.amax()) * arm.norm().max(1.0),
                "{}: {moment}",
                case.records
            );
        }
    });
}

/// Poses and their twists on a closed path: of each end a loop in space and a turn to and fro about an axis.
fn path(ends: [Pose; 2], t: f64, size: f64) -> [End; 2] {
    let w = std::f64::consts::TAU;
    let (s, c) = (w * t).sin_cos();
    let (s2, c2) = (2.0 * w * t).sin_cos();
    let shapes = [([s, 1.0 - c, s2], [1.0 - c, s2, s]), ([1.0 - c, s2, -s], [s2, s, 1.0 - c])];
    let rates = [([c, s, 2.0 * c2], [s, 2.0 * c2, c]), ([s, 2.0 * c2, -c], [2.0 * c2, c, s])];
    let mut made = ends.map(End::at_rest);
    for ((end, (shift, turns)), (speed, spins)) in made.iter_mut().zip(shapes).zip(rates) {
        // one turn about a fixed axis after the other would have a twist that is hard to write; one axis is enough
        let axis = Vector3::new(0.6, -0.48, 0.64);
        let angle = 3.0 * size * (turns[0] + 0.5 * turns[1]);
        let spin = 3.0 * size * w * (spins[0] + 0.5 * spins[1]);
        let motion = Vector3::from(shift) * size;
        let pose = end.pose.after_motion(&Six::new(
            motion.x,
            motion.y,
            motion.z,
            axis.x * angle,
            axis.y * angle,
            axis.z * angle,
        ));
        let speed = Vector3::from(speed) * (size * w);
        let velocity = Six::new(speed.x, speed.y, speed.z, axis.x * spin, axis.y * spin, axis.z * spin);
        *end = End { velocity, ..End::at_rest(pose) };
    }
    made
}

#[test]
fn conservative_element_does_no_work_over_closed_path() {
    each(|case, bench, element| {
        if case.kind != ConnectorKind::Elastic {
            return;
        }
        let committed = vec![0.0; element.states()];
        let size = if case.class == "FIX" { 1e-3 } else { 0.02 };
        const STEPS: usize = 200;
        let (mut work, mut whole) = (0.0, 0.0);
        for i in 0..STEPS {
            let ends = path(bench.ends, i as f64 / STEPS as f64, size);
            let (got, _) = ask(element, &bench.surroundings(), &ends, None, &committed);
            let power: f64 = ends.iter().zip(&got.wrench).map(|(e, w)| e.velocity.dot(w)).sum();
            work += power;
            whole += power.abs();
        }
        // the sum over a smooth closed path converges faster than any power of the step
        assert!(work.abs() <= 1e-9 * whole, "{}: {work} of {whole}", case.records);
    });
}

#[test]
fn dashpots_friction_and_viscous_springs_only_dissipate() {
    each(|case, bench, element| {
        if case.kind == ConnectorKind::Other {
            return;
        }
        let surroundings = bench.surroundings();
        // what depends on the rate opposes it
        let committed = state_after_step(element, bench);
        for scale in [1e-4, 0.1, 1.0, 30.0] {
            let fast = moving_ends(bench.ends).map(|e| End { velocity: e.velocity * scale, ..e });
            let slow = bench.ends.map(End::at_rest);
            let (a, b) = (
                ask(element, &surroundings, &fast, Some(0.1), &committed).0,
                ask(element, &surroundings, &slow, Some(0.1), &committed).0,
            );
            let power: f64 = (0..2).map(|i| fast[i].velocity.dot(&(a.wrench[i] - b.wrench[i]))).sum();
            let size: f64 = (0..2).map(|i| fast[i].velocity.norm() * b.wrench[i].norm()).sum();
            assert!(power <= 1e-12 * size, "{} at {scale}: {power}", case.records);
        }
        if case.kind != ConnectorKind::Dissipative {
            return;
        }
        // over a closed path from rest
        let size = if case.class == "GAP" { 1e-3 } else { 0.02 };
        const STEPS: usize = 2000;
        let start = path(bench.ends, 0.0, size);
        let zero = vec![0.0; element.states()];
        let (_, mut state) = ask(element, &surroundings, &start, None, &zero);
        let mut work = 0.0;
        for i in 1..=2 * STEPS {
            let ends = path(bench.ends, (i as f64 - 0.5) / STEPS as f64, size);
            let slow = ends.map(|e| End { velocity: e.velocity / 10.0, ..e });
            let (got, next) = ask(element, &surroundings, &slow, Some(10.0 / STEPS as f64), &state);
            work += slow.iter().zip(&got.wrench).map(|(e, w)| e.velocity.dot(w)).sum::<f64>() * 10.0 / STEPS as f64;
            state = next;
        }
        assert!(work < 0.0, "{}: it gave {work} J", case.records);
    });
}

#[test]
fn same_committed_state_gives_same_result() {
    each(|case, bench, element| {
        let surroundings = bench.surroundings();
        let committed = state_after_step(element, bench);
        let (ends, away) = (moving_ends(bench.ends), path(moving_ends(bench.ends).map(|e| e.pose), 0.3, 0.1));
        for dt in [None, Some(0.2)] {
            let first = ask(element, &surroundings, &ends, dt, &committed);
            ask(element, &surroundings, &away, dt, &committed);
            let again = ask(element, &surroundings, &ends, dt, &committed);
            assert_eq!(first.1, again.1, "{}", case.records);
            assert_eq!(first.0.wrench, again.0.wrench, "{}", case.records);
            assert!(first.1.iter().all(|v| v.is_finite()), "{}: a state was not written", case.records);
        }
    });
}
