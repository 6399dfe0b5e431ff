//! What of the equations does not depend on the frequency: the integrals of `1/r` and of its images above the mean level and below the
//! bottom.

use crate::mesh::HullMesh;
use crate::symmetry::SymmetryClass;
use nalgebra::Vector3;
use rayon::prelude::*;

/// The Rankine part of one symmetry class.
#[derive(Clone, Debug)]
pub struct RankinePart {
    /// `int d(1/r + ..)/dn dS` over each panel with its images, n out of the water, row by row; over a panel of the lid `int (1/r + ..) dS`.
    pub double_layer: Vec<f32>,
    /// `int (1/r + ..) v dS` over the hull (m3/s, ..), panel by panel and then motion by motion.
    pub single_layer: Vec<f64>,
}

/// An image of a source at the mean level or the bottom: at the height `sign z + shift`, with a strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelImage {
    /// 1, or -1 where it is turned upside down.
    pub sign: f64,
    /// Shift (m).
    pub shift: f64,
    /// Strength over that of the source.
    pub strength: f64,
}

/// Pairs of images above and below in water of finite depth at the infinite frequency, where they alternate; the last pair has half its
/// strength. Sixteen leave 1e-4 of the sum.
const ALTERNATING_PAIRS: i32 = 16;

impl LevelImage {
    fn new(sign: f64, shift: f64, strength: f64) -> Self {
        LevelImage { sign, shift, strength }
    }

    /// The source, its image above the mean level and that below the bottom: the part of every frequency that is not in the wave part.
    pub fn of_all_frequencies(depth: Option<f64>) -> Vec<Self> {
        let above = [LevelImage::new(1.0, 0.0, 1.0), LevelImage::new(-1.0, 0.0, 1.0)];
        above.into_iter().chain(depth.map(|depth| LevelImage::new(-1.0, -2.0 * depth, 1.0))).collect()
    }

    /// Where the potential is zero at the mean level.
    pub fn of_infinite_frequency(depth: Option<f64>) -> Vec<Self> {
        let pairs = if depth.is_some() { ALTERNATING_PAIRS } else { 0 };
        (-pairs..=pairs)
            .flat_map(|n| {
                let shift = 2.0 * f64::from(n) * depth.unwrap_or_default();
                let end = if n.abs() == pairs && pairs > 0 { 0.5 } else { 1.0 };
                let strength = if n % 2 == 0 { end } else { -end };
                [LevelImage::new(1.0, shift, strength), LevelImage::new(-1.0, shift, -strength)]
            })
            .collect()
    }
}

/// Position of an image of a point at the planes x = 0 and y = 0.
pub fn mirrored(point: &Vector3<f64>, image: [f64; 2]) -> Vector3<f64> {
    Vector3::new(point.x * image[0], point.y * image[1], point.z)
}

/// The Rankine parts of the classes. `velocities` has for each class the normal velocities of its motions: panel by panel, then motion by
/// motion.
pub fn rankine_parts(
    panels: &HullMesh,
    classes: &[SymmetryClass],
    velocities: &[Vec<f64>],
    levels: &[LevelImage],
) -> Vec<RankinePart> {
    let count = panels.panels().len();
    let images = panels.mirrors().images();
    let motions: Vec<usize> = velocities.iter().map(|v| v.len() / count).collect();
    // a row of each class
    let rows: Vec<Vec<(Vec<f32>, Vec<f64>)>> = (0..count)
        .into_par_iter()
        .map(|i| {
            let from = panels.panels()[i].centroid;
            let mut rows: Vec<(Vec<f32>, Vec<f64>)> =
                motions.iter().map(|motions| (vec![0.0; count], vec![0.0; *motions])).collect();
            for (j, panel) in panels.panels().iter().enumerate() {
                let seen: Vec<[f64; 2]> = images
                    .iter()
                    .map(|image| {
                        let own = mirrored(&from, *image);
                        levels.iter().fold([0.0; 2], |[potential, angle], level| {
                            let z = level.sign * own.z + level.shift;
                            let [p, a] = panel.rankine(&Vector3::new(own.x, own.y, z));
                            [potential + level.strength * p, angle + level.strength * a]
                        })
                    })
                    .collect();
                for ((class, velocities), (row, single)) in classes.iter().zip(velocities).zip(&mut rows) {
                    let (mut potential, mut angle) = (0.0, 0.0);
                    for (image, [p, a]) in images.iter().zip(&seen) {
                        let factor = class.factor(*image);
                        potential += factor * p;
                        angle += factor * a;
                    }
                    row[j] = if j < panels.hull_count() { -angle as f32 } else { potential as f32 };
                    let motions = single.len();
                    for (sum, velocity) in single.iter_mut().zip(&velocities[j * motions..]) {
                        *sum += potential * velocity;
                    }
                }
            }
            rows
        })
        .collect();
    let mut parts: Vec<RankinePart> = classes
        .iter()
        .map(|_| RankinePart { double_layer: Vec::with_capacity(count * count), single_layer: Vec::new() })
        .collect();
    for of_panel in rows {
        for (part, (row, single)) in parts.iter_mut().zip(of_panel) {
            part.double_layer.extend(row);
            part.single_layer.extend(single);
        }
    }
    parts
}
