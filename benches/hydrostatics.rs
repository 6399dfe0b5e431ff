//! Hydrostatics of one pose: a box of 12 triangles, a sphere of 2,048, and a tube, floating heeled; wind and current on the
//! box and on the prism of the tube.

#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::{Matrix3, Vector3};
use std::hint::black_box;
use std::sync::Arc;
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_hydro::BodyLoad;
use windlass_hydro::current::CurrentField;
use windlass_hydro::hull::{Solid, Surface, TubeHull};
use windlass_hydro::pieces::PieceLoad;
use windlass_hydro::steady::{Medium, Steady};
use windlass_hydro::surface_integrals::Skin;
use windlass_hydro::wind::{WindField, WindProfile};
use windlass_model::Model;

/// A sphere of radius 10 m between `rows` parallels and twice as many meridians.
fn sphere(rows: usize) -> Surface {
    let at = |row: usize, turn: usize| {
        let (a, b) = (row as f64 / rows as f64, turn as f64 / rows as f64);
        let (polar, around) = (a * std::f64::consts::PI, b * std::f64::consts::PI);
        [10.0 * polar.sin() * around.cos(), 10.0 * polar.sin() * around.sin(), -10.0 * polar.cos()]
    };
    let panels: Vec<Vec<[f64; 3]>> = (0..rows)
        .flat_map(|row| (0..2 * rows).map(move |turn| (row, turn)))
        .map(|(row, turn)| vec![at(row, turn), at(row, turn + 1), at(row + 1, turn + 1), at(row + 1, turn)])
        .collect();
    Surface::from_panels(&panels, 1e-6).unwrap()
}

fn benches(c: &mut Criterion) {
    let pose = Pose::from_place(&Place::new([100.0, 50.0, -1.0, 0.2, -0.1, 0.7]));
    let block = Surface::block([-10.0, -4.0, -3.0], [10.0, 4.0, 3.0]);
    let tube = TubeHull { ends: [Vector3::new(-10.0, 0.0, 0.0), Vector3::new(10.0, 0.0, 1.0)], diameter: 4.0 };
    let ball = sphere(23);
    assert!(ball.faces.len() > 2000 && ball.faults().is_empty());
    let mut group = c.benchmark_group("hydrostatics");
    group.bench_function("box", |b| b.iter(|| black_box(&block).wet(black_box(&pose), 0.0).load(1e4)));
    group.bench_function("tube", |b| b.iter(|| black_box(&tube).wet(black_box(&pose), 0.0).load(1e4)));
    let wind = WindField::steady(30.0, 0.4, WindProfile::Power(1.0 / 7.0));
    let steady = Steady {
        around: Model::default().surroundings(),
        wind: Some(wind),
        current: CurrentField::uniform(1.0, 0.7),
        waves: Vec::new(),
        variation: None,
    };
    let steady = Arc::new(steady);
    for (name, surface) in [("box", &block), ("tube", &tube.prism(64).unwrap())] {
        let skin = Arc::new(Skin::new(surface, &Matrix3::identity()));
        for (stream, medium) in [("wind", Medium::Air), ("current", Medium::Water)] {
            let load = PieceLoad::new(Arc::clone(&skin), &steady, medium, Matrix3::identity(), [1.0; 3]);
            group.bench_function(format!("{stream} on the {name}"), |b| {
                b.iter(|| load.mean_load(black_box(&pose)).unwrap())
            });
        }
    }
    group.bench_function("2,024 triangles", |b| b.iter(|| black_box(&ball).wet(black_box(&pose), 0.0).load(1e4)));
    group.bench_function("faults of 2,024 triangles", |b| b.iter(|| black_box(&ball).faults()));
    group.finish();
}

criterion_group!(all, benches);
criterion_main!(all);
