//! Lines whose fairleads a program moves: against MoorDyn, a taut line's stiffness, and the weight of what hangs.

use crate::moordyn::{self, driven, reference};
use nalgebra::Vector3;
use windlass_line_dynamics::{CoupledLine, CoupledLines, Rod, RodSegment, Surroundings, UniformFluid};

fn vacuum() -> Surroundings {
    Surroundings { water: UniformFluid::vacuum(), ambient: None, bottom: None, gravity: 9.81 }
}

/// A line of 100 m and 1000 kN of stiffness, stretched by 1 m along x, so light that its weight does not show.
fn taut() -> CoupledLines {
    let rod = Rod::new("taut", vec![RodSegment::line(100.0, 10, 0.01, 1e6, 0.01)], vec![]).unwrap();
    let (anchor, fairlead) = (Vector3::zeros(), Vector3::new(101.0, 0.0, 0.0));
    CoupledLines::new(vec![CoupledLine { rod, anchor, fairlead }], vacuum(), 0.5).unwrap()
}

#[test]
fn driven_chain_follows_moordyn_by_positions_and_velocities_alone() {
    let around = Surroundings {
        water: moordyn::water(),
        ambient: None,
        bottom: Some(moordyn::bottom()),
        gravity: moordyn::GRAVITY,
    };
    let [anchor, fairlead] = moordyn::ENDS;
    let rod = moordyn::rod(100);
    let mut lines = CoupledLines::new(vec![CoupledLine { rod, anchor, fairlead }], around, 0.1).unwrap();
    let (rows, range) = reference();
    let mut worst: f64 = 0.0;
    let mut compared = 0;
    for step in 1..=400 {
        let time = 0.1 * f64::from(step);
        let motion = driven(time);
        lines.step(time, &[motion.position], &[motion.velocity]).unwrap();
        if let Some((_, size)) = rows.iter().find(|(t, _)| (t - time).abs() < 1e-6) {
            worst = worst.max((lines.fairlead_forces()[0].norm() - size).abs());
            compared += 1;
        }
    }
    assert!(compared >= 20, "{compared} instants");
    // the mesh is not MoorDyn's, and the step is a hundredth of the period: 2 % of the range
    assert!(worst < 0.02 * range, "{worst:.0} N of a range of {range:.0} N");
}

#[test]
fn taut_line_pulled_slowly_gives_its_stiffness() {
    let mut lines = taut();
    assert!((lines.fairlead_forces()[0].x + 1e4).abs() < 1.0);
    for step in 1..=20 {
        let time = f64::from(step);
        lines.step(time, &[Vector3::new(101.0 + 0.05 * time, 0.0, 0.0)], &[Vector3::new(0.05, 0.0, 0.0)]).unwrap();
    }
    // EA times strain at 102 m, at both ends
    assert!((lines.fairlead_forces()[0].x + 2e4).abs() < 20.0, "{:?}", lines.fairlead_forces());
    assert!((lines.anchor_forces()[0].x - 2e4).abs() < 20.0);
}

#[test]
fn ends_of_hanging_line_carry_its_weight() {
    let rod = Rod::new("chain", vec![RodSegment::line(120.0, 20, 50.0, 1e8, 0.05)], vec![]).unwrap();
    let (anchor, fairlead) = (Vector3::new(0.0, 0.0, -5.0), Vector3::new(0.0, 90.0, 0.0));
    let lines = CoupledLines::new(vec![CoupledLine { rod, anchor, fairlead }], vacuum(), 0.1).unwrap();
    let (a, b) = (lines.fairlead_forces()[0], lines.anchor_forces()[0]);
    assert!((a.z + b.z + 120.0 * 50.0 * 9.81).abs() < 1.0 && (a.y + b.y).abs() < 1.0);
}

#[test]
fn refused_steps_leave_lines_as_they_were() {
    let mut lines = taut();
    let (still, at) = (Vector3::zeros(), Vector3::new(101.5, 0.0, 0.0));
    lines.step(1.0, &[at], &[still]).unwrap();
    let before = (lines.time(), lines.fairlead_forces(), lines.node_positions(0));
    let said = |lines: &mut CoupledLines, time, x: &[Vector3<f64>], v: &[Vector3<f64>]| {
        lines.step(time, x, v).unwrap_err().to_string()
    };
    assert!(said(&mut lines, 0.5, &[at], &[still]).contains("goes nowhere"));
    assert!(said(&mut lines, f64::NAN, &[at], &[still]).contains("goes nowhere"));
    assert!(said(&mut lines, 2.0, &[], &[]).contains("1 fairleads"));
    assert!(said(&mut lines, 2.0, &[Vector3::new(f64::NAN, 0.0, 0.0)], &[still]).contains("fairlead 1 is not finite"));
    assert!(said(&mut lines, 1e9, &[at], &[still]).contains("longest steps"));
    assert_eq!((lines.time(), lines.fairlead_forces(), lines.node_positions(0)), before);
    // the present instant again changes nothing
    lines.step(1.0, &[at], &[still]).unwrap();
    assert_eq!(lines.fairlead_forces(), before.1);
    assert!(CoupledLines::new(Vec::new(), vacuum(), 0.0).is_err());
}

#[test]
fn ends_below_bottom_are_refused_and_an_interrupted_step_changes_nothing() {
    use std::sync::{Arc, atomic::AtomicBool, atomic::Ordering};
    use windlass_line_dynamics::{PlaneBottom, SeabedLaw};
    let rod = || Rod::new("chain", vec![RodSegment::line(120.0, 20, 50.0, 1e8, 0.05)], vec![]).unwrap();
    let bottom = Some((PlaneBottom { height: -50.0, slope: [0.0; 2] }, SeabedLaw::elastic(1e6)));
    let around = || Surroundings { bottom, ..vacuum() };
    let fairlead = Vector3::new(0.0, 90.0, 0.0);
    let line = |z| vec![CoupledLine { rod: rod(), anchor: Vector3::new(0.0, 0.0, z), fairlead }];
    let error = CoupledLines::new(line(-50.1), around(), 0.1).unwrap_err().to_string();
    assert!(error.contains("its anchor at z -50.1 m is below the bottom at -50 m"), "{error}");
    let stop = Arc::new(AtomicBool::new(false));
    let mut lines = CoupledLines::with_interrupt(line(-50.0), around(), 0.1, Arc::clone(&stop)).unwrap();
    let before = (lines.time(), lines.fairlead_forces(), lines.node_positions(0));
    let still = [Vector3::zeros()];
    let error = lines.step(0.1, &[Vector3::new(0.0, 90.0, -60.0)], &still).unwrap_err().to_string();
    assert!(error.contains("its fairlead at z -60 m"), "{error}");
    stop.store(true, Ordering::Relaxed);
    let error = lines.step(10.0, &[fairlead], &still).unwrap_err().to_string();
    assert!(error.contains("interrupted"), "{error}");
    assert_eq!((lines.time(), lines.fairlead_forces(), lines.node_positions(0)), before);
    stop.store(false, Ordering::Relaxed);
    lines.step(0.1, &[fairlead], &still).unwrap();
}
