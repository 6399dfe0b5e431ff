//! Slow drift as a spectrum of forces, by Newman's approximation.
//!
//! [PINKSTER-1980 eq. 3.50] with the approximation of [NEWMAN-1974]:
//! `S_F(mu) = 8 int S(w) S(w + mu) D(w + mu/2)2 dw`. Pairs of waves of two directions take the mean of the drift in
//! both, as in time; pairs of forces on one or several bodies have their cross spectra, with the phase of `k(w + mu) - k(w)`
//! between the bodies.

use super::linear::{LinearSystem, Motions};
use super::response::{ResponsePoint, check_memory};
use super::trains::{Trains, bounds, even, refine_near_resonance};
use crate::system::SolveError;
use nalgebra::{Complex, DMatrix};
use windlass_base::dense::SymmetricEigen;
use windlass_base::pose::Six;
use windlass_hydro::database::drift_at;
use windlass_hydro::move_wrench;

/// Even points over the differences of frequency, and over the sea at each.
const EVEN_POINTS: (usize, usize) = (60, 120);
/// Share of the largest part of a spectrum below which another is nothing.
const NEGLIGIBLE_SHARE: f64 = 1e-12;

/// A wave of a band: direction of travel (rad), its share of the energy, density (m2 s).
type Directed = (f64, f64);

/// The motions of slow drift, below the lowest frequency of the waves.
pub(super) fn drift(
    linear: &LinearSystem,
    trains: &Trains,
    resonant: &[(f64, f64)],
) -> Result<Vec<ResponsePoint>, SolveError> {
    let drifting: Vec<usize> = (0..linear.floats.len())
        .filter(|i| linear.floats.get(*i).is_some_and(|f| f.as_ref().is_some_and(|f| f.drift.is_some())))
        .collect();
    let Some(range) = trains.range().filter(|_| !drifting.is_empty()) else { return Ok(Vec::new()) };
    let (differences, waves) = EVEN_POINTS;
    // the first point is nothing: at rest
    let mut own = refine_near_resonance(even([0.0, range[0]], differences), resonant);
    own.retain(|w| *w > 0.0);
    check_memory(own.len(), 6 * drifting.len(), linear)?;
    let edges = bounds(&own, [0.0, range[0]]);
    let mut points = Vec::new();
    for (frequency, edge) in own.iter().zip(edges.windows(2)) {
        let [low, high] = edge else { continue };
        let spectrum = forces(linear, trains, &drifting, (*frequency, range, waves))?;
        let width = high - low;
        let mut list = Vec::new();
        let rows: Vec<usize> = drifting.iter().flat_map(|body| 6 * body..6 * body + 6).collect();
        let eigen = SymmetricEigen::new(spectrum, &|| linear.system.is_interrupted())
            .map_err(|e| linear.system.singular_matrix_error("spectrum of slow drift", &rows, e))?;
        let largest = eigen.values.max();
        for (value, vector) in eigen.values.iter().zip(eigen.vectors.column_iter()) {
            if value.is_nan() || *value <= NEGLIGIBLE_SHARE * largest {
                continue;
            }
            let mut force = Motions::zeros(6 * linear.system.nodes.len());
            for (position, body) in drifting.iter().enumerate() {
                for i in 0..6 {
                    force[6 * body + i] = vector[6 * position + i] * (value * width).sqrt();
                }
            }
            list.push(force);
        }
        let parts = linear.motions_with(*frequency, linear.slow_inertia_and_damping(*frequency), &list)?;
        points.push(ResponsePoint {
            frequency: *frequency,
            width: Some(width),
            energy: 0.0,
            parts,
            encounters: Vec::new(),
        });
    }
    Ok(points)
}

/// The cross spectra of the forces on the bodies that drift, at a difference of frequencies (N2 s, N2 m s, N2 m2 s).
fn forces(
    linear: &LinearSystem,
    trains: &Trains,
    drifting: &[usize],
    (difference, [low, high], count): (f64, [f64; 2], usize),
) -> Result<DMatrix<Complex<f64>>, SolveError> {
    let size = 6 * drifting.len();
    let mut sum = DMatrix::zeros(size, size);
    let points = even([low, high], count);
    let edges = bounds(&points, [low, high]);
    for (w, edge) in points.iter().zip(edges.windows(2)) {
        let [from, to] = edge else { continue };
        let beside = w + difference;
        let (first, second) = (densities(trains, *w), densities(trains, beside));
        let (k, k_beside) = (linear.wave_number(*w)?, linear.wave_number(beside)?);
        let middle = w + 0.5 * difference;
        let here = drifts(linear, drifting, &first, middle)?;
        let there = drifts(linear, drifting, &second, middle)?;
        for ((a, density), one) in first.iter().zip(&here) {
            for ((b, other), two) in second.iter().zip(&there) {
                let weight = 8.0 * density * other * (to - from);
                if weight == 0.0 {
                    continue;
                }
                let mut force = Motions::zeros(size);
                for (position, body) in drifting.iter().enumerate() {
                    let at = linear.poses[*body].origin;
                    let along = |angle: f64| at.x * angle.cos() + at.y * angle.sin();
                    let phase = Complex::from_polar(1.0, k_beside * along(*b) - k * along(*a));
                    let (one, two) = (&one[position], &two[position]);
                    for i in 0..6 {
                        force[6 * position + i] = phase * (0.5 * (one[i] + two[i]));
                    }
                }
                sum += &force * force.adjoint() * Complex::new(weight, 0.0);
            }
        }
    }
    Ok(sum)
}

/// Density of the waves of each direction at a frequency.
fn densities(trains: &Trains, frequency: f64) -> Vec<Directed> {
    let of = |d: &super::trains::Directional| {
        let [low, high] = d.spectrum.range();
        let inside = frequency >= low && frequency <= high;
        let share = if inside { d.spectrum.density(frequency) / d.toward.len().max(1) as f64 } else { 0.0 };
        d.toward.iter().map(|b| (*b, share)).collect::<Vec<_>>()
    };
    trains.irregular.iter().flat_map(of).collect()
}

/// Drift over the square of the amplitude of each direction on each body that drifts, about its origin, global axes.
fn drifts(
    linear: &LinearSystem,
    drifting: &[usize],
    waves: &[Directed],
    frequency: f64,
) -> Result<Vec<Vec<Six>>, SolveError> {
    let one = |body: &usize, toward: f64| -> Result<Six, SolveError> {
        let floats = linear.floats.get(*body).and_then(Option::as_ref);
        let Some((floats, table)) = floats.and_then(|f| Some((f, f.drift.as_ref()?))) else {
            return Ok(Six::zeros());
        };
        let name = linear.system.nodes[*body].name.as_str();
        let still = drift_at(table, toward - floats.yaw, frequency).map_err(SolveError::error_about(name))?;
        let [x, y, z, rx, ry, rz] = match &floats.by_velocity {
            Some(made) => {
                made.in_current(still, (toward, floats.yaw), frequency).map_err(SolveError::error_about(name))?
            }
            None => still,
        };
        let (sin, cos) = floats.yaw.sin_cos();
        let force = Six::new(x * cos - y * sin, x * sin + y * cos, z, rx * cos - ry * sin, rx * sin + ry * cos, rz);
        let axes = linear.poses[*body].axes;
        let [.., factor] = floats.factors;
        Ok(move_wrench(&force, axes * floats.attached.data.reference) * factor)
    };
    waves.iter().map(|(toward, _)| drifting.iter().map(|body| one(body, *toward)).collect()).collect()
}
