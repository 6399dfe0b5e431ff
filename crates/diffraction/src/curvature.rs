//! How the normal of a hull turns along its panels, by the panels around.

use crate::mesh::HullMesh;
use crate::rankine::mirrored;
use nalgebra::{Matrix2, Matrix3, Vector3};
use std::collections::BTreeMap;
use std::ops::Range;
use windlass_base::dense::{Cholesky, never};

/// Panels whose normals are apart by more than this cosine (40 degrees) meet at an edge.
pub(crate) const SMOOTH_COSINE: f64 = 0.766;
/// Corners that are nearer than this share of the size of the hulls are one.
pub(crate) const SAME_CORNER_SHARE: f64 = 1e-7;
/// What of the diagonal keeps equations soluble where all panels around stand in a row.
const RIDGE: f64 = 1e-9;

/// Of each panel of the hulls: how much its normal into the water turns by a step along it (1/m), zero of flat faces. Panels beyond an edge, and those of other
/// bodies, have no part in it; images at mirror planes have.
pub(crate) fn normal_slopes(mesh: &HullMesh, bodies: &[Range<usize>]) -> Vec<Matrix3<f64>> {
    let room = SAME_CORNER_SHARE * mesh.size().max(f64::MIN_POSITIVE);
    let key = |at: &Vector3<f64>| [0, 1, 2].map(|axis| (at[axis] / room).round() as i64);
    let mut at_corner: BTreeMap<[i64; 3], Vec<(usize, [f64; 2])>> = BTreeMap::new();
    for image in mesh.mirrors().images() {
        for (index, panel) in mesh.hull().iter().enumerate() {
            for corner in panel.corners() {
                at_corner.entry(key(&mirrored(corner, image))).or_default().push((index, image));
            }
        }
    }
    let body = |panel: usize| bodies.iter().position(|own| own.contains(&panel));
    let of_panel = |(index, panel): (usize, &crate::panel::Panel)| {
        let along = (panel.corners()[1] - panel.corners()[0]).try_normalize(0.0).unwrap_or_else(Vector3::x);
        let along = (along - panel.normal * panel.normal.dot(&along)).try_normalize(0.0).unwrap_or_else(Vector3::x);
        let axes = [along, panel.normal.cross(&along)];
        let (mut steps, mut turns) = (Matrix2::zeros(), [Vector3::zeros(); 2]);
        let around = panel.corners().iter().flat_map(|corner| at_corner.get(&key(corner)).into_iter().flatten());
        for (other, image) in around.filter(|(other, _)| body(*other) == body(index)) {
            let Some(beside) = mesh.hull().get(*other) else { continue };
            let normal = mirrored(&beside.normal, *image);
            if normal.dot(&panel.normal) < SMOOTH_COSINE {
                continue;
            }
            let step = mirrored(&beside.centroid, *image) - panel.centroid;
            let step = [step.dot(&axes[0]), step.dot(&axes[1])];
            steps += Matrix2::from_fn(|i, j| step[i] * step[j]);
            turns.iter_mut().zip(step).for_each(|(turn, step)| *turn += (normal - panel.normal) * step);
        }
        let ridge = RIDGE * steps.trace().max(f64::MIN_POSITIVE);
        let factors = Cholesky::new(steps + Matrix2::identity() * ridge, &never);
        let Ok(inverse) = factors.and_then(|factors| factors.solve(&Matrix2::identity())) else {
            return Matrix3::zeros();
        };
        (0..2)
            .flat_map(|i| (0..2).map(move |j| (i, j)))
            .map(|(i, j)| turns[i] * axes[j].transpose() * inverse[(i, j)])
            .sum()
    };
    mesh.hull().iter().enumerate().map(of_panel).collect()
}
