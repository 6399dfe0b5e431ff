//! The tangent of the forces and moments at the ends is their difference, and a second trial is the first one's equal.

use super::super::*;
use nalgebra::{Rotation3, SMatrix, SVector, Vector3};

type TangentColumn = SVector<f64, 12>;

/// A motion of the two holders: translation and rotation of each, by position, velocity and acceleration of its end.
type EndChange = [[Vector3<f64>; 4]; 2];

/// One rod with its holders.
struct TangentCase {
    name: &'static str,
    rod: Rod,
    state: RodState,
    ends: [RodEnd; 2],
}

impl TangentCase {
    fn move_ends(&self, change: &EndChange) -> [RodEnd; 2] {
        [0, 1].map(|side| {
            let (end, [x, v, a, angle]) = (self.ends[side], change[side]);
            let turn = Rotation3::new(angle);
            RodEnd {
                motion: end.motion.map(|m| RodEndMotion {
                    position: m.position + x,
                    velocity: m.velocity + v,
                    acceleration: m.acceleration + a,
                }),
                direction: end.direction.map(|d| turn * d),
                side: end.side.map(|s| turn * s),
                ..end
            }
        })
    }
}

fn outputs(made: &RodEndForces) -> TangentColumn {
    let mut all = TangentColumn::zeros();
    for side in 0..2 {
        all.fixed_rows_mut::<3>(6 * side).copy_from(&made.force[side]);
        all.fixed_rows_mut::<3>(6 * side + 3).copy_from(&made.moment[side]);
    }
    all
}

fn cases() -> Vec<TangentCase> {
    let (a, b) = (Vector3::new(0.0, 0.0, -60.0), Vector3::new(35.0, 8.0, -25.0));
    let along = (b - a).normalize();
    let held = |at: Vector3<f64>, v: f64| {
        RodEnd::from_motion(RodEndMotion { velocity: Vector3::new(v, 0.1, 0.2), ..RodEndMotion::at_rest(at) })
    };
    let segment = |length: f64, elements, bending: f64, torsion| RodSegment {
        axial_damping: 1e4,
        compression: bending > 0.0,
        bending,
        torsion,
        drag_normal: 1.2,
        added_normal: 1.0,
        ..RodSegment::line(length, elements, 80.0, 1e6, 0.2)
    };
    let d = [Vector3::new(0.6, 0.3, 0.9), Vector3::new(0.9, -0.1, 0.4)];
    let elastic = RodEnd { rotation: Some(3e3), ..held(b, 0.4).with_clamp(d[1]) };
    let sides = [Vector3::new(0.1, 1.0, 0.0), Vector3::new(0.3, 0.9, 0.4)];
    let mut list = Vec::new();
    let mut add = |name, rod: Rod, points: &[Vector3<f64>], ends| {
        let state = RodState::along_points(&rod, points).unwrap();
        list.push(TangentCase { name, rod, state, ends });
    };
    let one = |length: f64, elements, bending, torsion| {
        Rod::new("line", vec![segment(length, elements, bending, torsion)], vec![]).unwrap()
    };
    for elements in [1, 2, 9] {
        add("pinned chain", one(50.0, elements, 0.0, 0.0), &[a, b], [held(a, 0.2), held(b, 0.4)]);
    }
    for elements in [2, 9] {
        add("pinned beam", one(50.0, elements, 1e4, 0.0), &[a, b], [held(a, 0.2), held(b, 0.4)]);
    }
    for elements in [1, 2, 3, 9] {
        let clamped = [held(a, 0.2).with_clamp(d[0]), held(b, 0.4).with_clamp(d[1])];
        add("clamped beam", one(52.0, elements, 1e4, 0.0), &[a, b], clamped);
        add("elastic hinge", one(52.0, elements, 1e4, 0.0), &[a, b], [held(a, 0.2).with_clamp(d[0]), elastic]);
        let twisted = [clamped[0].with_side(sides[0]), clamped[1].with_side(sides[1])];
        add("twisted", one(52.0, elements, 1e4, 8e3), &[a, b], twisted);
        add("one twist held", one(52.0, elements, 1e4, 8e3), &[a, b], [twisted[0], elastic]);
    }
    let slow = TensionLaw::Polynomial(vec![8e5, 1e6]);
    let rope = ViscoelasticRope { slow, fast: [2e6, 8.0], relaxation: 0.3 };
    let axial = TensionLaw::Viscoelastic(Box::new(rope));
    let rope = Rod::new("rope", vec![RodSegment { axial, ..segment(50.0, 6, 0.0, 0.0) }], vec![]).unwrap();
    add("viscoelastic rope", rope, &[a, b], [held(a, 0.2), held(b, 0.4)]);
    let hung = [a, a + along * 20.0];
    add("cantilever", one(20.0, 7, 2e6, 0.0), &hung, [held(a, 0.2).with_clamp(d[0]), RodEnd::FREE]);
    add("cantilever at B", one(20.0, 7, 2e6, 0.0), &hung, [RodEnd::FREE, held(hung[1], 0.2).with_clamp(d[0])]);
    add(
        "twisted cantilever",
        one(20.0, 7, 2e6, 1e6),
        &hung,
        [held(a, 0.2).with_clamp(d[0]).with_side(sides[0]), RodEnd::FREE],
    );
    add("hanging chain", one(20.0, 7, 0.0, 0.0), &[a, a - Vector3::z() * 20.0], [held(a, 0.2), RodEnd::FREE]);
    // bent when free of load
    let mut bent = one(50.0, 6, 1e5, 8e4);
    let at = |i: usize| Vector3::new(50.0 * (i as f64 / 6.0).sin(), 50.0 * (1.0 - (i as f64 / 6.0).cos()), -40.0);
    let points: Vec<_> = (0..7).map(at).collect();
    let (first, end) = (Vector3::x(), Vector3::new(1f64.cos(), 1f64.sin(), 0.0));
    bent.set_shape(&points, [first, end]).unwrap();
    let [p, q] = bent.sides().unwrap();
    let ends = [
        held(points[0], 0.2).with_clamp(first).with_side(p),
        held(points[6] + Vector3::new(-1.0, 0.5, 2.0), 0.4).with_clamp(end).with_side(q),
    ];
    add("bent", bent, &points, ends);
    list
}

/// Columns of the tangent that are not the differences of the forces and moments: how far off by the largest of its rows.
fn wrong(
    tangent: &SMatrix<f64, 12, 12>,
    kind: usize,
    mut at: impl FnMut(&EndChange) -> TangentColumn,
    (h, least, share): (f64, f64, f64),
) -> Vec<String> {
    let mut found = Vec::new();
    for column in 0..12 {
        let (side, axis) = (column / 6, column % 6);
        let mut by = |h: f64| {
            let mut change: EndChange = [[Vector3::zeros(); 4]; 2];
            change[side][if axis < 3 { kind } else { 3 }][axis % 3] = h;
            at(&change)
        };
        let difference = if axis < 3 || kind == 0 { (by(h) - by(-h)) / (2.0 * h) } else { TangentColumn::zeros() };
        let most = least + share * tangent.amax();
        let away = (difference - tangent.column(column)).amax();
        if away > most {
            found.push(format!("kind {kind} column {column}: {away:.3e} > {most:.3e}"));
        }
    }
    found
}

#[test]
fn end_tangent_matches_end_force_finite_differences() {
    let fluid = UniformFluid::moving(1025.0, Vector3::new(0.5, 0.3, 0.0));
    let world = LineEnvironment::new(&fluid, 9.81);
    for case in cases() {
        let mut state = case.state.clone();
        let mut solver = RodSolver::new(&case.rod, RodSettings { tolerance: 1e-12, ..RodSettings::default() });
        let rest = case.ends.map(|e| RodEnd { motion: e.motion.map(|m| RodEndMotion::at_rest(m.position)), ..e });
        solver.statics(&case.rod, &mut state, &world, rest).unwrap();
        for again in [false, true] {
            let at = |change: &EndChange, solver: &mut RodSolver| {
                // with and without what the trial before has left
                let mut fresh = RodSolver::new(&case.rod, RodSettings { tolerance: 1e-12, ..RodSettings::default() });
                let solver = if again { solver } else { &mut fresh };
                let made = solver.trial(&case.rod, &state, &world, 0.1, case.move_ends(change)).unwrap();
                (outputs(&made), *solver.end_tangent(&case.rod, &world).unwrap())
            };
            let whole = at(&[[Vector3::zeros(); 4]; 2], &mut solver).1;
            for (kind, tangent) in [whole.position, whole.velocity, whole.acceleration].iter().enumerate() {
                // forces of 1e5 N to 1e-13 over 1e-5 m, and the third derivative
                let off = wrong(tangent, kind, |change| at(change, &mut solver).0, (1e-5, 0.02, 1e-7));
                assert!(off.is_empty(), "{} of {}, again {again}: {off:?}", case.name, case.rod.nodes() - 1);
            }
        }
    }
}

#[test]
fn static_end_stiffness_matches_finite_difference_at_rest() {
    let fluid = UniformFluid::moving(1025.0, Vector3::new(0.5, 0.3, 0.0));
    let world = LineEnvironment::new(&fluid, 9.81);
    for case in cases() {
        let mut state = case.state.clone();
        let mut solver = RodSolver::new(&case.rod, RodSettings::default());
        solver.statics(&case.rod, &mut state, &world, case.move_ends(&[[Vector3::zeros(); 4]; 2])).unwrap();
        let whole = *solver.end_tangent(&case.rod, &world).unwrap();
        let at = |change: &EndChange| {
            outputs(&solver.statics(&case.rod, &mut state.clone(), &world, case.move_ends(change)).unwrap())
        };
        assert!(whole.velocity.amax() == 0.0 && whole.acceleration.amax() == 0.0);
        // a residual of 1e-9 of 1e5 N at each node over 1e-3 m, and the third derivative
        let off = wrong(&whole.position, 0, at, (1e-3, 0.5, 1e-5));
        assert!(off.is_empty(), "{} of {}: {off:?}", case.name, case.rod.nodes() - 1);
    }
}
