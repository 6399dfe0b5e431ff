//! Forces on both ends of a line by its one entry, on the fast path of a lone segment and past it, against the inextensible catenary.

use windlass_catenary::{Joint, Line, SeabedModel, Segment};

const WEIGHT: f64 = 1500.0;
const LENGTH: f64 = 600.0;
const DEPTH: f64 = 120.0;

/// A chain that does not stretch, in so many pieces of equal length, on a bottom with friction.
fn chain(pieces: usize, friction: f64) -> Line {
    let segment = Segment { length: LENGTH / pieces as f64, weight: WEIGHT, ea: 1e17 };
    let floor = SeabedModel { elevation: -DEPTH, slope: 0.0, friction };
    let line = Line::new(vec![segment; pieces], vec![Joint::Free; pieces - 1], -DEPTH, 0.0).unwrap();
    line.with_seabed(Some(floor)).unwrap()
}

/// Suspended length (m) and distance of the fairlead from the anchor (m) with a horizontal force (N): [IRVINE-1981 1.4] without stretch,
/// the touchdown at the catenary's lowest point.
fn closed_form(force: f64) -> (f64, f64) {
    let parameter = force / WEIGHT;
    let suspended = (DEPTH * (DEPTH + 2.0 * parameter)).sqrt();
    (suspended, LENGTH - suspended + parameter * (suspended / parameter).asinh())
}

#[test]
fn forces_of_one_and_of_several_segments_match_closed_form() {
    for pieces in [1, 2, 5] {
        for friction in [0.0, 0.6] {
            let line = chain(pieces, friction);
            let mut warm = None;
            // from one force to the next, as a vessel moves: each begins at the one before
            for force in [2.0e5, 2.02e5, 2.1e5, 3.5e5, 3.4e5, 1.0e5] {
                let (suspended, x) = closed_form(force);
                let found = line.solve_forces(x, 0.0, &mut warm).unwrap();
                let anchor = (force - friction * WEIGHT * (LENGTH - suspended)).max(0.0);
                let wanted = [force, WEIGHT * suspended, anchor, 0.0];
                let got = [found.fairlead[0], found.fairlead[1], found.anchor[0], found.anchor[1]];
                for (got, wanted) in got.iter().zip(wanted) {
                    // proven to 1e-9 of the tension; the stretch of EA is 1e-11 of the length, times the stiffness 1e-7 of the force
                    assert!((got - wanted).abs() < 1e-6 * force, "{pieces} {friction} {force}: {got} {wanted}");
                }
                assert_eq!(warm.as_ref().map(|w| w.fairlead()), Some(found.fairlead));
            }
        }
    }
}

#[test]
fn tangents_at_both_ends_match_derivatives_of_closed_form() {
    let (force, step) = (2.5e5, 10.0);
    let x_at = |force: f64| closed_form(force).1;
    let stiffness = 2.0 * step / (x_at(force + step) - x_at(force - step));
    let grounding = (closed_form(force + step).0 - closed_form(force - step).0) / (2.0 * step);
    for pieces in [1, 3] {
        for friction in [0.0, 0.2] {
            let found = chain(pieces, friction).solve_forces(x_at(force), 0.0, &mut None).unwrap();
            // of what the fairlead's force gains, friction takes less as less lies on the bottom
            let at_anchor = stiffness * (1.0 + friction * WEIGHT * grounding);
            assert!(
                (found.stiffness[0][0] / stiffness - 1.0).abs() < 1e-5,
                "{pieces} {friction} {found:?} {stiffness}"
            );
            assert!((found.coupling[0][0] / at_anchor - 1.0).abs() < 1e-5, "{pieces} {friction} {found:?} {at_anchor}");
        }
    }
}

#[test]
fn failed_solution_keeps_warm_start_unchanged() {
    let line = chain(1, 0.0);
    let mut warm = None;
    let (_, x) = closed_form(2e5);
    let found = line.solve_forces(x, 0.0, &mut warm).unwrap();
    assert!(line.solve_forces(x, -DEPTH - 1.0, &mut warm).is_err());
    assert_eq!(warm.map(|w| w.fairlead()), Some(found.fairlead));
}
