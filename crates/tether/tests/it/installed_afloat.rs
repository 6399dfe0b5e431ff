//! Tethers on a body of the model with a hydrodynamic database, against the closed form of an oscillator.

use crate::installed_example as example;

use nalgebra::{Complex, Matrix6, Vector3};
use std::f64::consts::PI;
use std::sync::Arc;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_base::span::Span;
use windlass_hydro::Floating;
use windlass_hydro::database::Database;
use windlass_hydro::sea::{Component, Sea, Water};
use windlass_model::{AttachedDatabase, Body, DriftMethod, LinearHydrostatics, Model, Part, Stretching, Weight};
use windlass_tether::TetherLine;
use windlass_tether::compatibility::Compatibility;
use windlass_tether::installed::{
    EndSprings, Installation, InstalledHistory, InstalledRunSettings, InstalledTether, Keep,
};
use windlass_tether::structure::floating_body::Afloat;
use windlass_tether::structure::flow::{FlowWaves, WaterFlow};

const MASS: f64 = 4e7;
const ADDED: f64 = 2e7;
const EXCITATION: f64 = 3e6;
const SPRING: f64 = 9e6;
/// The centre of gravity in the body.
const CENTRE: [f64; 3] = [1.0, -2.0, 12.0];

/// A body whose buoyancy at rest bears its weight and a pull (N), its centre of gravity at a height (m).
fn model(pull: f64, height: f64) -> Model {
    let mut model = Model::default();
    let gravity = model.defaults.gravity;
    let span = Span::default();
    let mut part = Part::new("B", "B", Place::default(), span);
    part.weights = vec![Weight { at: CENTRE, weight: MASS * gravity, radii: [30.0; 3], span, ..Weight::default() }];
    let mut stiffness = Matrix6::zeros();
    stiffness[(2, 2)] = SPRING;
    let frequencies: Vec<f64> = (1..=60).map(|i| 0.05 * f64::from(i)).collect();
    let headings: Vec<f64> = (0..8).map(|i| f64::from(i) * PI / 4.0).collect();
    let mut heave = [Complex::new(0.0, 0.0); 6];
    heave[2] = Complex::new(EXCITATION, 0.0);
    let added = Matrix6::from_diagonal_element(ADDED);
    let data = Database {
        source: "constants".into(),
        reference: Vector3::from(CENTRE),
        added_mass: vec![added; frequencies.len()],
        damping: vec![Matrix6::zeros(); frequencies.len()],
        infinite: Some(added),
        excitation: vec![vec![heave; frequencies.len()]; headings.len()],
        frequencies,
        headings,
        density: 1025.0,
        gravity,
        ..Database::default()
    };
    let body = Body {
        name: "B".into(),
        position: Place::default(),
        previous: Place::default(),
        ignored: Vec::new(),
        junction: None,
        linear: Some(LinearHydrostatics { at: CENTRE, height, buoyancy: MASS * gravity + pull, stiffness, span }),
        database: Some(AttachedDatabase {
            data: Arc::new(data),
            at: CENTRE,
            memory: None,
            drift: DriftMethod::None,
            drift_damping: None,
            hydrostatics: false,
            span,
        }),
        prescribed: None,
        span,
    };
    model.parts.insert("B".into(), part);
    model.bodies.insert("B".into(), body);
    model
}

#[test]
fn moored_database_body_heaves_as_oscillator() {
    let mut element = example::tethers()[0].line.elements()[0];
    element.length = 50.0;
    let line = TetherLine::with_numbered_nodes(vec![element; 4]).unwrap();
    let (gravity, density) = (Model::default().defaults.gravity, 1025.0);
    let (anchor, stretch, group) = (Vector3::new(0.0, 0.0, -230.0), 0.1, 4.0);
    // the attachment 20 m below the centre of gravity, right over the anchor
    let height = -230.0 + 200.0 + stretch + 20.0;
    let springs = EndSprings { rotation: [0.0; 2], ..EndSprings::default() };
    let tether = InstalledTether {
        anchor_springs: springs,
        vessel_springs: springs,
        group,
        ..InstalledTether::new("T", line, anchor, Vector3::new(0.0, 0.0, -20.0))
    };
    let tube = element.tube();
    let stiffness = 2.15e11 * tube.area() / 200.0;
    let pressed = density * gravity * tube.external_area();
    let wet = (element.density * tube.area() * gravity - pressed) * 200.0;
    let pull = group * (stiffness * stretch + pressed * (230.0 + 29.9) / 2.0 + 0.5 * wet);
    // the pressure on the middle falls by half of a rise
    let spring = SPRING + group * (stiffness - 0.5 * pressed);
    let frequency: f64 = 0.9;
    let amplitude = EXCITATION * 1.5 / (spring - frequency * frequency * (MASS + ADDED));
    let component = Component {
        frequency,
        number: frequency * frequency / gravity,
        amplitude: 1.5,
        toward: [1.0, 0.0],
        phase: 0.0,
    };
    let water = Water { depth: None, level: 0.0, gravity, density };
    let sea = Arc::new(Sea::airy(vec![component], water, 0.0, Stretching::Exponential));
    let model = model(pull, height);
    let floating = Floating::under_way(&model, &model.bodies["B"], Some(&sea)).unwrap();
    let mut structure = Afloat::new(floating).unwrap();
    assert!((structure.centre() - Vector3::from(CENTRE)).norm() < 1e-12);
    // the phase of the excitation is of where the body stands in plan: the reference point over the origin
    let pose = Pose::from_position([0.0, 0.0, height + amplitude]);
    // waves across the tether are another matter: still water for it
    let flow = WaterFlow { waves: FlowWaves::None, ..WaterFlow::still_water(density, gravity).unwrap() };
    let course = InstalledRunSettings { start: 0.0, step: 0.02, states: 1001, pose, velocity: Six::zeros() };
    let mut history = InstalledHistory::new(1, Keep::Always);
    let mut installation = Installation::new(&mut structure, vec![tether], &flow, Compatibility::native()).unwrap();
    installation.run(&course, &mut history).unwrap();
    for (time, z) in history.times().iter().zip(history.motion(0, 2)) {
        let want = height + amplitude * (frequency * time).cos();
        // 3.6 rad/s of its own, which the scheme damps by (w h)^4/24 a step
        assert!((z - want).abs() < 2e-3 * amplitude.abs(), "{time} {z} {want}");
    }
    assert!(amplitude.abs() > 5e-3 && history.motion(0, 0).iter().all(|x| x.abs() < 1e-9));
}
