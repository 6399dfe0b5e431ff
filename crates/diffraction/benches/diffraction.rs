//! Radiation and diffraction of a hemisphere in deep water by 400, 1,600 and 6,400 panels: seconds per frequency with six motions and one
//! heading, on one thread and on all; `-- N` takes the mesh of 4 N2 panels alone, of any N. `benches/diffraction.py` runs Capytaine on the same meshes.

#![allow(missing_docs, clippy::print_stdout)]

use nalgebra::Vector3;
use std::error::Error as StdError;
use std::f64::consts::{FRAC_PI_2, PI};
use std::time::Instant;
use windlass_diffraction::{DiffractionBody, DiffractionProblem, HullMesh, MirrorPlanes, Water};

type Error = dyn StdError + Send + Sync;

const GRAVITY: f64 = 9.81;

/// Panels of a hemisphere of radius 1: `m` rows of `4 m` columns, or of `m` between two mirror planes.
fn hemisphere(m: usize, mirrors: MirrorPlanes) -> Result<HullMesh, Box<Error>> {
    let columns = 4 * m / mirrors.images().len();
    let point = |i: usize, j: usize| {
        let (t, p) = (FRAC_PI_2 * i as f64 / m as f64, 2.0 * PI * j as f64 / (4 * m) as f64);
        let clean = |x: f64| if x.abs() < 1e-15 { 0.0 } else { x };
        Vector3::new(clean(t.cos() * p.cos()), clean(t.cos() * p.sin()), -t.sin())
    };
    let quads: Vec<_> = (0..m)
        .flat_map(|i| (0..columns).map(move |j| [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]))
        .collect();
    Ok(HullMesh::new(&quads, mirrors)?)
}

fn measure(m: usize, frequencies: usize, mirrors: MirrorPlanes, threads: usize) -> Result<(), Box<Error>> {
    let body = DiffractionBody { mesh: hemisphere(m, mirrors)?, origin: Vector3::zeros() };
    let water = Water { density: 1000.0, gravity: GRAVITY, depth: None };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    pool.install(|| {
        let start = Instant::now();
        let problem = DiffractionProblem::new(&[body], water)?;
        let prepared = start.elapsed().as_secs_f64();
        let mut uses = 0;
        for i in 0..frequencies {
            // K a from 0.1 to 2
            let k = 0.1 + 1.9 * i as f64 / (frequencies - 1).max(1) as f64;
            uses += problem.solve((k * GRAVITY).sqrt(), &[0.0])?.iterations;
        }
        let total = start.elapsed().as_secs_f64();
        println!(
            "{:6} panels, {} mirror planes, {threads} threads: {frequencies} frequencies {total:.3} s, of which {prepared:.3} s once; \
             {:.4} s per frequency, {uses} products",
            4 * m * m,
            mirrors.images().len().ilog2(),
            (total - prepared) / frequencies as f64,
        );
        Ok(())
    })
}

fn main() -> Result<(), Box<Error>> {
    let only = std::env::args().skip(1).find_map(|word| word.parse::<usize>().ok());
    // the table of the Green function is made once a process
    windlass_diffraction::green::WavePartTable::shared();
    let usual = vec![(10, 20), (20, 20), (40, 3)];
    let meshes = match only {
        None => usual,
        Some(m) => vec![usual.into_iter().find(|(own, _)| *own == m).unwrap_or((m, 2))],
    };
    for (m, frequencies) in meshes {
        for threads in [1, 2] {
            measure(m, frequencies, MirrorPlanes::default(), threads)?;
        }
        measure(m, frequencies, MirrorPlanes { x: true, y: true }, 1)?;
    }
    Ok(())
}
