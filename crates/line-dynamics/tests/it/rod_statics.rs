//! Rods without bending at rest, against the catenary engine and the random lines of tests/data/catenary_2000.csv.

use nalgebra::Vector3;
use windlass_catenary as catenary;
use windlass_line_dynamics::{
    FluidState, LineEnvironment, PlaneBottom, Rod, RodEnd, RodSegment, RodSettings, RodSolver, RodState, SeabedLaw,
    SeabedShape, UniformFluid,
};

const GRAVITY: f64 = 9.80665;
const WATER: f64 = 1000.0;

struct StaticsCase {
    x: f64,
    z: f64,
    length: f64,
    ea: f64,
    weight: f64,
    grounded: bool,
    friction: f64,
}

/// Pull of the rod on its fairlead: toward the anchor, and downward; and the iterations it took. On the bottom it
/// sinks in by a share of its length.
fn rest(case: &StaticsCase, elements: usize, sinks: f64) -> ([f64; 2], usize) {
    let weight = case.weight;
    // the submerged weight as mass and displacement, buoyant or heavy
    let area = weight.abs() / GRAVITY / WATER * if weight < 0.0 { 2.0 } else { 0.1 };
    let mass = weight / GRAVITY + area * WATER;
    let segment = RodSegment {
        displaced: area,
        contact_diameter: 1.0,
        ..RodSegment::line(case.length, elements, mass, case.ea, 1.0)
    };
    let rod = Rod::new("line", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid(FluidState { surface: 1e5, ..UniformFluid::still_water(WATER).0 });
    let bottom = PlaneBottom { height: 0.0, slope: [0.0, 0.0] };
    let ground =
        SeabedLaw { friction_along: case.friction, ..SeabedLaw::elastic(weight.abs() / (sinks * case.length)) };
    let bottom = case.grounded.then_some((&bottom as &dyn SeabedShape, ground));
    let world = LineEnvironment { bottom, ..LineEnvironment::new(&fluid, GRAVITY) };
    let (a, b) = (Vector3::zeros(), Vector3::new(case.x, 0.0, case.z));
    let foot = Vector3::new(0.999 * case.x, 0.0, 0.01 * case.z);
    let start = if case.grounded { vec![a, foot, b] } else { vec![a, b] };
    let mut state = RodState::along_points(&rod, &start).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let made = solver.statics(&rod, &mut state, &world, [RodEnd::pin(a), RodEnd::pin(b)]).unwrap();
    ([-made.force[1].x, -made.force[1].z], made.iterations)
}

fn away(found: [f64; 2], wanted: [f64; 2]) -> f64 {
    (found[0] - wanted[0]).hypot(found[1] - wanted[1]) / wanted[0].hypot(wanted[1])
}

#[test]
fn rod_at_rest_converges_to_catenary_with_second_order() {
    let line =
        |x, z, grounded| StaticsCase { x, z, length: 900.0, ea: 8.54e8, weight: 1695.0, grounded, friction: 0.0 };
    // suspended, taut; with a touchdown; the same slack
    for case in [line(700.0, 500.0, false), line(800.0, 290.0, true), line(700.0, 290.0, true)] {
        let segment = catenary::Segment { length: case.length, weight: case.weight, ea: case.ea };
        let bottom = case.grounded.then_some(catenary::FlatBottom { friction: 0.0 });
        let exact = segment.solve_end_forces(case.x, case.z, bottom).unwrap().fairlead;
        let errors = [50, 100, 200, 400, 800].map(|n| away(rest(&case, n, 1e-8).0, exact));
        assert!(errors[4] < 1e-4, "{errors:?}");
        // a touchdown moves through the mesh, so its error falls by fits: the order is that over four halvings
        let order = (errors[0] / errors[4]).log2() / 4.0;
        assert!(order > 1.8, "{errors:?} order {order}");
    }
}

#[test]
fn rod_dragged_over_rough_bottom_converges_to_friction_catenary() {
    // the anchor holds some; friction takes all of it; nearly slack; taut
    for (x, z, friction) in
        [(800.0, 290.0, 0.3), (800.0, 290.0, 0.9), (850.0, 200.0, 0.5), (750.0, 290.0, 1.0), (879.0, 100.0, 0.8)]
    {
        let case = StaticsCase { x, z, length: 900.0, ea: 8.54e8, weight: 1695.0, grounded: true, friction };
        let segment = catenary::Segment { length: case.length, weight: case.weight, ea: case.ea };
        let wanted = segment.solve_end_forces(case.x, case.z, Some(catenary::FlatBottom { friction })).unwrap();
        let errors = [50, 100, 200, 400, 800].map(|n| away(rest(&case, n, 1e-8).0, wanted.fairlead));
        assert!(errors[4] < 1e-5, "{friction}: {errors:?}");
        let order = (errors[0] / errors[4]).log2() / 4.0;
        assert!(order > 1.5, "{friction}: {errors:?} order {order}");
    }
}

#[test]
fn random_lines_settle_at_their_catenaries() {
    let text = std::fs::read_to_string("../../tests/data/catenary_2000.csv").unwrap();
    let mut solved = 0;
    let mut most = 0;
    for line in text.lines().skip(1).step_by(8) {
        let columns: Vec<&str> = line.split(',').collect();
        let v = |i: usize| columns[i].parse::<f64>().unwrap();
        let case = StaticsCase {
            x: v(2),
            z: v(3),
            length: v(4),
            ea: v(5),
            weight: v(6),
            grounded: columns[8] == "0",
            friction: v(7),
        };
        // a line that lies on the bottom with its fairlead gives it half an element's weight to bear
        if case.grounded && v(3) == 0.0 {
            continue;
        }
        let elements = 60;
        let (found, iterations) = rest(&case, elements, 1e-5);
        solved += 1;
        most = most.max(iterations);
        let error = away(found, [v(9), v(10)]);
        // second order in the share of the suspended part that an element is; but a line that hangs down vertically
        // ends on the bottom somewhere in an element, half of which is its fairlead's to carry or not
        let suspended = (case.length - v(13)) / case.length * elements as f64;
        let allowed = if columns[14] == "fully_slack" { 0.6 / suspended } else { 2e-4 + 4.0 / (suspended * suspended) };
        assert!(error < allowed, "{line}: {error} of {allowed}");
    }
    assert!(solved > 200 && most < 2000, "{solved} {most}");
}
