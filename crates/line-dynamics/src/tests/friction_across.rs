//! Friction of the bottom across a line at rest, and against a current along it.

use super::super::statics_friction::seabed_friction;
use super::super::*;
use super::slope::lying;
use nalgebra::Vector3;

const GRAVITY: f64 = 9.81;
/// Of the chain (kg/m), with its diameter (m), and of the water (kg/m3).
const MASS: f64 = 100.0;
const DIAMETER: f64 = 0.1;
const DENSITY: f64 = 1025.0;
const FRICTION: f64 = 0.6;
const FAIRLEAD: [f64; 2] = [400.0, 90.0];

fn rough(along: f64, across: f64) -> SeabedLaw {
    SeabedLaw { damping: 1e5, friction_along: along, friction_across: across, ..SeabedLaw::elastic(1e6) }
}

/// A chain laid on a slope in still water, in a current; at rest, with the forces at its ends.
struct FrictionRest {
    rod: Rod,
    state: RodState,
    solver: RodSolver,
    made: RodEndForces,
    ends: [RodEnd; 2],
}

fn rest(bottom: &PlaneBottom, length: f64, current: Vector3<f64>) -> FrictionRest {
    let segment = RodSegment {
        axial_damping: 1e6,
        drag_normal: 1.2,
        drag_tangential: 0.2,
        ..RodSegment::line(length, 88, MASS, 1e9, DIAMETER)
    };
    let unit = (MASS - DENSITY * segment.displaced) * GRAVITY;
    let rod = Rod::new("chain", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::moving(DENSITY, current);
    let world =
        LineEnvironment { bottom: Some((bottom, rough(FRICTION, FRICTION))), ..LineEnvironment::new(&fluid, GRAVITY) };
    let down = Vector3::z() * bottom.height;
    let points: Vec<_> = lying(unit, bottom.slope[0], length, FAIRLEAD).1.iter().map(|p| p + down).collect();
    let ends = [RodEnd::pin(down), RodEnd::pin(Vector3::new(FAIRLEAD[0], 0.0, FAIRLEAD[1]) + down)];
    let mut state = RodState::along_points(&rod, &points).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    solver.statics(&rod, &mut state, &world, ends).unwrap();
    let made = solver.statics(&rod, &mut state, &world, ends).unwrap();
    FrictionRest { rod, state, solver, made, ends }
}

#[test]
fn cross_current_loads_suspended_part_and_moves_no_grounded_part() {
    for (slope, length) in [(0.0, 440.0), (0.1, 440.0), (0.1, 420.0), (0.02, 430.0)] {
        let bottom = PlaneBottom { height: -100.0, slope: [slope, 0.0] };
        let still = rest(&bottom, length, Vector3::zeros());
        for speed in [0.01, 0.05, 0.5, 1.0] {
            let FrictionRest { rod, mut state, mut solver, made, ends } = rest(&bottom, length, Vector3::y() * speed);
            assert!(!solver.has_slid_without_friction(), "{slope} {length} {speed}");
            // up to two elements before it leaves the bottom
            let over = |x: &Vector3<f64>| x.z - bottom.height(x.x, x.y).0;
            let foot = state.node_positions().iter().rposition(|x| over(x) < 0.0).unwrap().saturating_sub(2);
            let aside = state.node_positions()[..foot].iter().map(|x| x.y.abs()).fold(0.0, f64::max);
            let hangs = (rod.nodes() - 1 - foot) as f64 * length / 88.0;
            let drag = 0.5 * DENSITY * 1.2 * DIAMETER * speed * speed * hangs;
            println!(
                "{slope} {length} {speed}: FX {} {} FY {} {drag} anchor {} aside {aside:.2e}",
                made.force[1].x, still.made.force[1].x, made.force[1].y, made.force[0].x
            );
            // of a node that sticks the share of drag in friction, at most a ninth, of the 5 mm of its travel
            assert!(aside < 1e-3 * speed.max(0.1), "{aside}");
            // the fairlead has about half of the drag on what hangs, which the nodes lifting off and what lies under them share
            assert!((0.3..0.9).contains(&(made.force[1].y.abs() / drag)), "{} {drag}", made.force[1].y);
            // drag across turns the pull aside by drag over pull, which raises it by the square of that
            let turned = (drag / still.made.force[1].x).powi(2);
            assert!((made.force[1].x / still.made.force[1].x - 1.0).abs() < 1e-4 + turned);
            // as it rests it stays
            let fluid = UniformFluid::moving(DENSITY, Vector3::y() * speed);
            let world = LineEnvironment {
                bottom: Some((&bottom, rough(FRICTION, FRICTION))),
                ..LineEnvironment::new(&fluid, GRAVITY)
            };
            let (before, pull) = (state.clone(), made.force[1].norm());
            for i in 1..=100 {
                let made = solver.step(&rod, &mut state, &world, i as f64 * 0.1, ends).unwrap();
                assert!((made.force[1].norm() / pull - 1.0).abs() < 1e-3, "{i}: {} {pull}", made.force[1].norm());
            }
            let moved = state.position.iter().zip(&before.position).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            assert!(moved < 1e-2, "{moved}");
        }
    }
}

#[test]
fn current_along_grounded_line_does_not_push_it() {
    for (slope, length) in [(0.0, 440.0), (0.1, 440.0), (0.1, 420.0)] {
        let bottom = PlaneBottom { height: -100.0, slope: [slope, 0.0] };
        for (speed, angle) in [(0.5, 0.0f64), (0.5, 180.0), (1.0, 180.0), (0.5, 150.0), (0.05, 30.0)] {
            let (sin, cos) = angle.to_radians().sin_cos();
            let FrictionRest { solver, made, .. } = rest(&bottom, length, Vector3::new(cos, sin, 0.0) * speed);
            println!("{slope} {length} {speed} {angle}: {} {}", made.force[1], made.force[0].x);
            assert!(!solver.has_slid_without_friction());
            assert!(made.force[0].xy().norm() < 100.0, "{}", made.force[0]);
        }
    }
}

#[test]
fn static_friction_derivatives_match_finite_differences() {
    for (slope, along, across) in [
        ([0.0, 0.0], 0.6, 0.6),
        ([0.1, 0.2], 0.6, 0.6),
        ([0.1, 0.5], 0.6, 0.3),
        ([0.3, 0.2], 0.2, 0.9),
        ([0.3, 0.3], 0.2, 0.0),
    ] {
        let bottom = PlaneBottom { height: 0.0, slope };
        let fluid = UniformFluid::vacuum();
        let world =
            LineEnvironment { bottom: Some((&bottom, rough(along, across))), ..LineEnvironment::new(&fluid, GRAVITY) };
        let rod = Rod::new("chain", vec![RodSegment::line(10.0, 2, MASS, 1e6, DIAMETER)], vec![]).unwrap();
        for (stretch, aside) in [(1e-3, 0.0), (2e-3, 0.002), (-1e-3, 0.004), (5e-3, -0.03)] {
            for side in [0, 1] {
                let mut solver = RodSolver::new(&rod, RodSettings::default());
                let way = Vector3::new(1.0, 0.1, slope[0] + 0.1 * slope[1]).normalize();
                for (i, x) in solver.trial.x.iter_mut().enumerate() {
                    *x = way * (5.0 * i as f64 * (1.0 + stretch)) - Vector3::z() * 0.01;
                }
                solver.trial.laid_at =
                    solver.trial.x.iter().map(|x| x - Vector3::new(-0.1, 1.0, 0.0) * aside).collect();
                let at = |trial: &super::super::trial::Trial| seabed_friction(&rod, &world, trial, 1, side).unwrap();
                let result = at(&solver.trial);
                assert!(result.held.norm() <= 1.0 + 2e-3, "{}", result.held.norm());
                for (j, node) in [result.node, 3 - result.node].into_iter().enumerate() {
                    for axis in 0..3 {
                        let h = 1e-7;
                        let [plus, minus] = [h, -h].map(|h| {
                            let mut trial = solver.trial.clone();
                            trial.x[node][axis] += h;
                            at(&trial).force
                        });
                        let found = (plus - minus) / (2.0 * h);
                        let column = result.by[j].column(axis);
                        let size = result.by.iter().map(|b| b.norm()).fold(1.0, f64::max);
                        assert!(
                            (found - column).norm() < 1e-5 * size,
                            "{slope:?} {along} {across} {stretch} {aside} {side} {j} {axis}: {found} {column}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn cross_current_does_not_move_fully_grounded_line() {
    let bottom = PlaneBottom { height: -100.0, slope: [0.0, 0.0] };
    let segment = RodSegment { drag_normal: 1.2, ..RodSegment::line(200.0, 100, MASS, 1e9, DIAMETER) };
    let rod = Rod::new("chain", vec![segment], vec![]).unwrap();
    let ends = [0.0, 199.5].map(|x| RodEnd::pin(Vector3::new(x, 0.0, -100.0)));
    let points = [0.0, 199.5].map(|x| Vector3::new(x, 0.0, -100.0));
    let rest = |friction: f64, speed: f64| {
        let fluid = UniformFluid::moving(DENSITY, Vector3::y() * speed);
        let world = LineEnvironment {
            bottom: Some((&bottom, rough(friction, friction))),
            ..LineEnvironment::new(&fluid, GRAVITY)
        };
        let mut state = RodState::along_points(&rod, &points).unwrap();
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        solver.statics(&rod, &mut state, &world, ends).unwrap();
        let made = solver.statics(&rod, &mut state, &world, ends).unwrap();
        let aside = state.node_positions().iter().map(|x| x.y).fold(0.0, f64::max);
        // as it rests it stays
        let before = state.clone();
        for i in 1..=50 {
            solver.step(&rod, &mut state, &world, i as f64 * 0.1, ends).unwrap();
        }
        let moved = state.position.iter().zip(&before.position).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        println!("{friction} {speed}: aside {aside} pull {} moved {moved:e} {}", made.force[1].x, made.iterations);
        // dragged to a stand it is held by all of its friction, and settles by some travels of it more
        assert!(!solver.has_slid_without_friction() && moved < if speed > 1.0 { 3e-2 } else { 1e-3 }, "{moved}");
        (aside, made.force[1].norm())
    };
    // drag 61.5 N/m against friction of 540 N/m
    let (aside, _) = rest(FRICTION, 1.0);
    assert!(aside < 2e-3, "{aside}");
    // and without any it bows, by as much as it is longer than its ends are apart
    let (aside, _) = rest(0.0, 1.0);
    assert!((aside / (0.5 * 200.0 * 199.75f64).sqrt().min(6.12) - 1.0).abs() < 0.05, "{aside}");
    // drag of 984 N/m is more than friction: it bows as well, held back by what friction there is
    let (aside, pull) = rest(FRICTION, 4.0);
    let free = rest(0.0, 4.0).1;
    assert!(aside > 5.0 && pull < free, "{aside} {pull} {free}");
}
