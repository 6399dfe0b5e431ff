//! A line at rest by friction on a slope, with slack on it.

use super::super::*;
use nalgebra::Vector3;

const GRAVITY: f64 = 9.81;
/// Of the chain (kg/m).
const MASS: f64 = 100.0;
const FRICTION: f64 = 0.6;

fn chain(length: f64, elements: usize) -> Rod {
    let segment = RodSegment { axial_damping: 1e6, ..RodSegment::line(length, elements, MASS, 1e10, 0.1) };
    Rod::new("chain", vec![segment], vec![]).unwrap()
}

fn rough() -> SeabedLaw {
    SeabedLaw { damping: 1e5, friction_along: FRICTION, friction_across: FRICTION, ..SeabedLaw::elastic(1e6) }
}

/// Horizontal force (N) of an inextensible chain of weight `unit` (N/m), and points along it, that lies slack on a slope from its anchor at the origin to
/// where it leaves the slope along it, and hangs from there as a catenary to a fairlead at x, z.
pub(super) fn lying(unit: f64, slope: f64, length: f64, [x, z]: [f64; 2]) -> (f64, Vec<Vector3<f64>>) {
    let (steep, leaves) = ((1.0 + slope * slope).sqrt(), slope.asinh());
    let hung = |h: f64| {
        let a = h / unit;
        let rise = |span: f64| a * ((span / a + leaves).cosh() - leaves.cosh()) + slope * (x - span) - z;
        let (mut low, mut high) = (0.0, x);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if rise(middle) < 0.0 { low = middle } else { high = middle }
        }
        let long = a * ((low / a + leaves).sinh() - leaves.sinh()) + (x - low) * steep;
        (long, low)
    };
    let (mut low, mut high) = (1.0f64, 1e7f64);
    for _ in 0..100 {
        let middle = (low * high).sqrt();
        if hung(middle).0 > length { low = middle } else { high = middle }
    }
    let (span, a) = (hung(low).1, low / unit);
    let foot = Vector3::new(x - span, 0.0, slope * (x - span));
    let hanging = (0..=400).map(|i| {
        let s = span * i as f64 / 400.0;
        foot + Vector3::new(s, 0.0, a * ((s / a + leaves).cosh() - leaves.cosh()))
    });
    (low, std::iter::once(Vector3::zeros()).chain(hanging).collect())
}

const FAIRLEAD: [f64; 2] = [400.0, 90.0];

/// A chain at rest on a slope, begun at its shape, with the forces at its ends and the closed form of its horizontal one.
struct SlopeRest {
    rod: Rod,
    state: RodState,
    solver: RodSolver,
    made: RodEndForces,
    exact: f64,
    ends: [RodEnd; 2],
}

fn rest(bottom: &PlaneBottom, length: f64, elements: usize, [x, z]: [f64; 2]) -> SlopeRest {
    let rod = chain(length, elements);
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment { bottom: Some((bottom, rough())), ..LineEnvironment::new(&fluid, GRAVITY) };
    let (exact, points) = lying(MASS * GRAVITY, bottom.slope[0], length, [x, z]);
    let ends = [RodEnd::pin(Vector3::zeros()), RodEnd::pin(Vector3::new(x, 0.0, z))];
    let mut state = RodState::along_points(&rod, &points).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    // once for how softly nodes meet the bottom from then on
    solver.statics(&rod, &mut state, &world, ends).unwrap();
    let made = solver.statics(&rod, &mut state, &world, ends).unwrap();
    assert!(!solver.has_slid_without_friction());
    SlopeRest { rod, state, solver, made, exact, ends }
}

fn sloping(slope: f64) -> PlaneBottom {
    PlaneBottom { height: 0.0, slope: [slope, 0.0] }
}

#[test]
fn slack_chain_on_slope_converges_to_closed_form_with_mesh() {
    for (slope, length) in [(0.1, 440.0), (0.1, 420.0), (0.05, 440.0), (0.02, 430.0)] {
        // 5 m elements at a touchdown whose radius is 8 m; then 9 N, what a chain pulls more that sinks into the bottom by 1 cm
        for (elements, most) in [(44, 7e-2), (88, 1e-2), (176, 1e-2), (352, 1.5e-3)] {
            let SlopeRest { made, exact, .. } = rest(&sloping(slope), length, elements, FAIRLEAD);
            let off = (-made.force[1].x / exact - 1.0).abs();
            // of the friction of a node a hundredth is left at the anchor, to hold the nodes in line
            let left = 0.011 * (FRICTION + slope) * MASS * GRAVITY * length / elements as f64;
            println!("{slope} {length} {elements}: {} {exact} {off:.2e} {}", made.force[1].x, made.force[0].x);
            assert!(made.force[0].xy().norm() < left, "{}", made.force[0]);
            assert!(off < most, "{off}");
        }
    }
}

#[test]
fn slack_chain_on_slope_stays_in_place() {
    for (slope, length) in [(0.1, 440.0), (0.1, 420.0), (0.02, 430.0)] {
        let bottom = sloping(slope);
        let SlopeRest { rod, mut state, mut solver, made, ends, .. } = rest(&bottom, length, 88, FAIRLEAD);
        let fluid = UniformFluid::vacuum();
        let world = LineEnvironment { bottom: Some((&bottom, rough())), ..LineEnvironment::new(&fluid, GRAVITY) };
        let (before, pull) = (state.clone(), made.force[1].norm());
        for i in 1..=300 {
            let made = solver.step(&rod, &mut state, &world, i as f64 * 0.1, ends).unwrap();
            assert!((made.force[1].norm() / pull - 1.0).abs() < 1e-4, "{i}: {} {pull}", made.force[1].norm());
        }
        let moved = state.position.iter().zip(&before.position).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        println!("{slope} {length}: {moved:e}");
        assert!(moved < 1e-3, "{moved}");
    }
}

#[test]
fn chain_moved_on_slope_matches_one_built_at_new_fairlead() {
    let bottom = sloping(0.1);
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment { bottom: Some((&bottom, rough())), ..LineEnvironment::new(&fluid, GRAVITY) };
    for by in [-3.0, -0.5, 0.5, 3.0] {
        let anew = rest(&bottom, 440.0, 88, [FAIRLEAD[0] + by, FAIRLEAD[1]]).made.force[1];
        let SlopeRest { rod, mut state, mut solver, .. } = rest(&bottom, 440.0, 88, FAIRLEAD);
        let ends = [RodEnd::pin(Vector3::zeros()), RodEnd::pin(Vector3::new(FAIRLEAD[0] + by, 0.0, FAIRLEAD[1]))];
        let made = solver.statics(&rod, &mut state, &world, ends).unwrap().force[1];
        println!("{by}: {} {} {}", made.x, anew.x, solver.has_slid_without_friction());
        assert!((made - anew).norm() < 1e-3 * anew.norm(), "{by}: {made} {anew}");
    }
    // aside: it swings round, and lies on the slope without sliding down across it
    let SlopeRest { rod, mut state, mut solver, made, .. } = rest(&bottom, 440.0, 88, FAIRLEAD);
    let (x, y) = (FAIRLEAD[0], 15.0);
    let ends = [RodEnd::pin(Vector3::zeros()), RodEnd::pin(Vector3::new(x, y, FAIRLEAD[1]))];
    let aside = solver.statics(&rod, &mut state, &world, ends).unwrap().force[1];
    let along = (aside.x * x + aside.y * y) / x.hypot(y);
    println!("{along} {} {}", made.force[1].x, (aside.y / aside.x) / (y / x));
    assert!(!solver.has_slid_without_friction());
    assert!((along / made.force[1].x - 1.0).abs() < 0.06, "{along} {}", made.force[1].x);
    assert!(((aside.y / aside.x) / (y / x) - 1.0).abs() < 0.01, "{aside}");
}

#[test]
fn stiffness_on_slope_matches_finite_difference_of_force() {
    let fluid = UniformFluid::vacuum();
    for (slope, length) in [(0.1, 440.0), (0.1, 420.0), (-0.1, 440.0)] {
        let bottom = sloping(slope);
        let world = LineEnvironment { bottom: Some((&bottom, rough())), ..LineEnvironment::new(&fluid, GRAVITY) };
        let SlopeRest { rod, mut state, mut solver, .. } = rest(&bottom, length, 88, FAIRLEAD);
        let mut pull = |by: Vector3<f64>| {
            let far = Vector3::new(FAIRLEAD[0], 0.0, FAIRLEAD[1]) + by;
            let made = solver.statics(&rod, &mut state, &world, [RodEnd::pin(Vector3::zeros()), RodEnd::pin(far)]);
            (made.unwrap().force[1], solver.end_tangent(&rod, &world).unwrap().position)
        };
        let result = pull(Vector3::zeros()).1;
        for axis in 0..3 {
            let mut by = Vector3::zeros();
            by[axis] = 1e-4;
            let [plus, minus] = [by, -by].map(|by| pull(by).0);
            let found = (plus - minus) / 2e-4;
            let column = Vector3::from_column_slice(result.fixed_view::<3, 1>(6, 6 + axis).as_slice());
            println!("{slope} {length} {axis}: {found:?} {column:?}");
            assert!((found - column).norm() < 1e-3 * result.norm(), "{axis}: {found} {column}");
        }
    }
}

#[test]
fn overlong_chain_on_slope_hangs_vertically_over_a_heap() {
    let fluid = UniformFluid::vacuum();
    for (slope, length) in [(0.1, 520.0), (0.1, 480.0), (0.2, 440.0), (0.05, 500.0)] {
        let bottom = sloping(slope);
        let world = LineEnvironment { bottom: Some((&bottom, rough())), ..LineEnvironment::new(&fluid, GRAVITY) };
        let rod = chain(length, 88);
        let far = Vector3::new(FAIRLEAD[0], 0.0, FAIRLEAD[1]);
        let points: Vec<_> = (0..=60)
            .map(|i| {
                let s = f64::from(i) / 60.0;
                let sags = (FAIRLEAD[1] * s - 340.0 * s * (1.0 - s)).max(slope * FAIRLEAD[0] * s);
                Vector3::new(FAIRLEAD[0] * s, 0.0, sags)
            })
            .collect();
        let ends = [RodEnd::pin(Vector3::zeros()), RodEnd::pin(far)];
        let mut state = RodState::along_points(&rod, &points).unwrap();
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        let weight = MASS * GRAVITY * (FAIRLEAD[1] - slope * FAIRLEAD[0]);
        for _ in 0..3 {
            let made = solver.statics(&rod, &mut state, &world, ends).unwrap();
            println!(
                "{slope} {length}: {} {} slid {} its {}",
                made.force[1].x,
                made.force[1].z,
                solver.has_slid_without_friction(),
                made.iterations
            );
            assert!(!solver.has_slid_without_friction());
            // within two elements of what hangs
            let element = MASS * GRAVITY * length / 88.0;
            assert!(made.force[1].x.abs() < 0.02 * weight && (made.force[1].z + weight).abs() < 2.0 * element);
        }
        let before = state.clone();
        for i in 1..=100 {
            solver.step(&rod, &mut state, &world, f64::from(i) * 0.1, ends).unwrap();
        }
        let moved = state.position.iter().zip(&before.position).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
        assert!(moved < 1e-2, "{moved}");
    }
}
