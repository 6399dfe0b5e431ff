//! Liquid in compartments: a box tank against the closed forms of its heeled liquid, work against potential energy, the tangent against
//! differences, and the inertia of a box.

use nalgebra::Vector3;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_base::span::Span;
use windlass_hydro::{Category, Floating, Tank};
use windlass_model::{Body, Compartment, FreeSurface, Model, Part, Piece, Shape, TankContents, WaveAction, box_panels};

const DENSITY: f64 = 870.0;
const GRAVITY: f64 = 9.80665;

/// A body with a box tank of 20 x 8 x 6 m about its origin, filled to a share.
fn model(fraction: f64) -> Model {
    let mut model = Model::default();
    let (name, span) = ("B".to_string(), Span::default());
    model.bodies.insert(name.clone(), Body { name: name.clone(), ..Body::default() });
    let mut part = Part::new("B", "B", Place::default(), span);
    part.pieces.push(Piece {
        name: "T".into(),
        permeability: -1.0,
        shape: Shape::Panels(box_panels([-10.0, -4.0, -3.0], [10.0, 4.0, 3.0])),
        cs_wind: [0.0; 3],
        cs_current: [0.0; 3],
        member: None,
        element: None,
        category: None,
        waves: WaveAction::ByForm,
        own_panels: false,
        eddy_damping: 0.0,
        drift_damping: None,
        kept: Vec::new(),
        unmodelled: Vec::new(),
        compartment: Some("T".into()),
        span,
    });
    model.parts.insert(name.clone(), part);
    let contents = TankContents { fraction, density: DENSITY, surface: FreeSurface::Level, is_flooded: false };
    model.compartments.insert(
        "T".into(),
        Compartment {
            name: "T".into(),
            part: name,
            description: String::new(),
            sounding_tube: None,
            residual: 0.0,
            maximum: 1.0,
            holes: Vec::new(),
            contents,
            span,
        },
    );
    model.defaults.gravity = GRAVITY;
    model
}

fn pose(shift: [f64; 3], turn: [f64; 3]) -> Pose {
    let ([x, y, z], [a, b, c]) = (shift, turn);
    Pose::from_place(&Place::new([x, y, z, a, b, c]))
}

/// The wrench of the contents in a pose.
fn wrench(model: &Model, pose: &Pose) -> Six {
    let floating = Floating::at_rest(model, &model.bodies["B"]).unwrap();
    let mut contents = floating.loads.iter().filter(|load| load.category() == Category::Contents);
    contents.next().unwrap().mean_load(pose).unwrap().wrench
}

#[test]
fn heeled_liquid_of_box_shifts_as_wall_sided_ship() {
    // half full: h = 3 m over a breadth of 8 m; the surface stays between the walls to atan(3/4)
    let model = model(0.5);
    let tank = Tank::new(&model, &model.compartments["T"]).unwrap();
    assert!((tank.capacity - 960.0).abs() < 1e-9);
    for degrees in [0.5_f64, 5.0, 20.0, 36.0, -20.0] {
        let angle = degrees.to_radians();
        let at = pose([3.0, -2.0, 7.0], [angle, 0.0, 0.0]);
        let liquid = tank.liquid(&at).unwrap();
        let centre = at.axes.transpose() * liquid.centroid().unwrap();
        // toward the low side: a positive roll lifts y > 0
        let dy = -64.0 * angle.tan() / (12.0 * 3.0);
        let dz = 64.0 * angle.tan().powi(2) / (24.0 * 3.0);
        assert!((centre - Vector3::new(0.0, dy, -1.5 + dz)).norm() < 1e-11, "{degrees}: {centre}");
        assert!((liquid.volume() - 480.0).abs() < 1e-9, "{degrees}: {}", liquid.volume());
    }
}

#[test]
fn work_of_heeling_is_potential_energy_of_liquid() {
    // Simpson's rule over the moment, through the angles at which the surface meets the corners
    for (fraction, axis) in [(0.5, 0), (0.2, 0), (0.85, 0), (0.5, 1)] {
        let model = model(fraction);
        let tank = Tank::new(&model, &model.compartments["T"]).unwrap();
        let steps = 2000;
        let most = 80f64.to_radians();
        let at = |n: i32| {
            let mut turn = [0.0; 3];
            turn[axis] = most * f64::from(n) / f64::from(steps);
            pose([0.0; 3], turn)
        };
        let moment = |n: i32| -wrench(&model, &at(n))[3 + axis];
        let mut work = moment(0) + moment(steps);
        for n in 1..steps {
            work += moment(n) * if n % 2 == 1 { 4.0 } else { 2.0 };
        }
        work *= most / f64::from(steps) / 3.0;
        let height = |n: i32| tank.liquid(&at(n)).unwrap().centroid().unwrap().z;
        let weight = DENSITY * GRAVITY * fraction * 960.0;
        let energy = weight * (height(steps) - height(0));
        // the rule errs at the corners of the moment, by the square of the step
        assert!((work - energy).abs() < 2e-6 * weight, "{fraction} {axis}: {work} {energy}");
    }
}

#[test]
fn tangent_of_contents_is_difference_of_their_wrench() {
    for (fraction, turn) in
        [(0.5, [0.0, 0.0, 0.0]), (0.3, [0.4, -0.2, 0.7]), (0.9, [-0.9, 0.3, 0.1]), (1.0, [0.3, 0.2, 0.0])]
    {
        let model = model(fraction);
        let floating = Floating::at_rest(&model, &model.bodies["B"]).unwrap();
        let load = floating.loads.iter().find(|load| load.category() == Category::Contents).unwrap();
        let at = pose([1.0, 2.0, -3.0], turn);
        let tangent = load.mean_load(&at).unwrap().stiffness;
        let step = 1e-5;
        for column in 0..6 {
            let moved = |by: f64| {
                let mut next = at;
                if column < 3 {
                    next.origin[column] += by;
                } else {
                    let mut axis = Vector3::zeros();
                    axis[column - 3] = by;
                    next.axes = nalgebra::Rotation3::from_scaled_axis(axis).matrix() * at.axes;
                }
                load.mean_load(&next).unwrap().wrench
            };
            let difference = (moved(-step) - moved(step)) / (2.0 * step);
            let size = DENSITY * GRAVITY * 960.0 * 10.0;
            let off = (tangent.column(column) - difference).amax();
            assert!(off < 1e-8 * size, "{fraction} column {column}: {off:e} of {size:e}");
        }
    }
}

#[test]
fn contents_have_inertia_of_their_box() {
    // half full, upright: a box of 20 x 8 x 3 m with its centre 1.5 m below the origin; full: 20 x 8 x 6 in any attitude
    for (fraction, turn, [a, b, c], z) in
        [(0.5, [0.0; 3], [20.0, 8.0, 3.0], -1.5), (1.0, [0.4, -0.3, 1.2], [20.0, 8.0, 6.0], 0.0)]
    {
        let model = model(fraction);
        let mass = Tank::new(&model, &model.compartments["T"]).unwrap().mass(&pose([5.0, 6.0, 7.0], turn)).unwrap();
        let m: f64 = DENSITY * a * b * c;
        assert!((mass.mass - m).abs() < 1e-9 * m);
        assert!((mass.centre - Vector3::new(0.0, 0.0, z)).norm() < 1e-11, "{}", mass.centre);
        let own = mass.inertia_about(mass.centre);
        let want = Vector3::new(b * b + c * c, a * a + c * c, a * a + b * b) * (m / 12.0);
        assert!((own.diagonal() - want).amax() < 1e-10 * want.amax(), "{own} {want}");
        assert!((own[(0, 1)].abs() + own[(0, 2)].abs() + own[(1, 2)].abs()) < 1e-10 * want.amax(), "{own}");
    }
}
