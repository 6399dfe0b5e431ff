//! Small motions about a place: the eigenvalues of the stiffness against the mass, and natural periods.

use super::system::{FREEDOMS, State, System};
use nalgebra::{Cholesky, DMatrix, DVector};
use std::f64::consts::TAU;

/// A small motion of the whole system.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Eigenvalue of the symmetric part of the stiffness against the mass (rad2/s2); negative: not stable.
    pub eigenvalue: f64,
    /// Undamped natural period (s), where it is stable.
    pub period: Option<f64>,
    /// The freedom that moves most: body and freedom, as written.
    pub most: (String, &'static str),
    /// Its motion, six a body, largest 1 with rotations times 1 m.
    pub shape: DVector<f64>,
}

/// The modes of the freedoms that move, lowest eigenvalue first. Freedoms of bodies without mass follow the others.
pub fn modes(system: &System, state: &State) -> Vec<Mode> {
    let mass = system.mass_matrix(&state.poses);
    let free = |i: usize| system.nodes.get(i / 6).and_then(|n| n.free.get(i % 6)).copied().unwrap_or(false);
    let rows: Vec<usize> = (0..mass.nrows()).filter(|i| free(*i)).collect();
    let (heavy, light): (Vec<usize>, Vec<usize>) = rows.iter().partition(|i| mass[(**i, **i)] > 0.0);
    if heavy.is_empty() {
        return Vec::new();
    }
    let part = |m: &DMatrix<f64>, r: &[usize], c: &[usize]| m.select_rows(r).select_columns(c);
    let symmetric = (&state.stiffness + state.stiffness.transpose()) * 0.5;
    let mut k = part(&symmetric, &heavy, &heavy);
    let mut follow = DMatrix::zeros(light.len(), heavy.len());
    if !light.is_empty() {
        let across = part(&symmetric, &light, &heavy);
        if let Some(solved) = part(&symmetric, &light, &light).lu().solve(&across) {
            k -= across.transpose() * &solved;
            follow = -solved;
        }
    }
    // weights without radii of gyration make a mass without inertia about some axis
    let mut m = part(&mass, &heavy, &heavy);
    let tiny = m.diagonal().amax() * 1e-12;
    m.iter_mut().step_by(heavy.len() + 1).for_each(|d| *d += tiny);
    let Some(root) = Cholesky::new(m).and_then(|c| c.l().try_inverse()) else { return Vec::new() };
    let eigen = (&root * k * root.transpose()).symmetric_eigen();
    let mut order: Vec<usize> = (0..heavy.len()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let mode = |index: usize| {
        let eigenvalue = eigen.eigenvalues[index];
        let heavy_part = root.transpose() * eigen.eigenvectors.column(index);
        let light_part = &follow * &heavy_part;
        let mut shape = DVector::zeros(mass.nrows());
        for (row, value) in heavy.iter().zip(heavy_part.iter()).chain(light.iter().zip(light_part.iter())) {
            shape[*row] = *value;
        }
        let size = shape.amax();
        if size > 0.0 {
            shape /= size;
        }
        // a translation through the radius of gyration weighs as much as the rotation
        let weigh = |i: usize| shape[i].abs() * mass[(i, i)].max(0.0).sqrt();
        let most = (0..shape.len()).max_by(|a, b| weigh(*a).total_cmp(&weigh(*b))).unwrap_or(0);
        let body = system.nodes.get(most / 6).map_or(String::new(), |n| n.name.clone());
        Mode {
            eigenvalue,
            period: (eigenvalue > 0.0).then(|| TAU / eigenvalue.sqrt()),
            most: (body, FREEDOMS.get(most % 6).copied().unwrap_or_default()),
            shape,
        }
    };
    order.into_iter().map(mode).collect()
}
