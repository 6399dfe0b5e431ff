//! The potential in the water around the bodies: wave elevation, pressure, and mean drift by the momentum through a control surface
//! [LEE-2007].

use crate::gauss::GaussRule;
use crate::problem::DiffractionProblem;
use crate::rankine::{LevelImage, mirrored};
use crate::wave_solution::WaveSolution;
use crate::wave_system::WaveKernel;
use nalgebra::{Complex, Vector3};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::LazyLock;

type C = Complex<f64>;

/// Points down the side of a control surface, and along the radius of its bottom.
static RULE: LazyLock<GaussRule> = LazyLock::new(|| GaussRule::new(12));
/// Directions around a control surface, beyond four for each wave length of its circumference over pi.
const SPARE_DIRECTIONS: usize = 24;
/// Step of differences of the potential, over the least of radius, depth and 1/k of the control surface: the error of the differences, and
/// that of the tables in them, are some 1e-4.
const DIFFERENCE_SHARE: f64 = 0.01;

/// An upright cylinder in the water around one or more bodies, from the mean level down; no hull may cross it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlCylinder {
    /// x and y of its axis (m).
    pub centre: [f64; 2],
    /// Radius (m).
    pub radius: f64,
    /// Depth of its bottom (m).
    pub depth: f64,
}

/// Mean drift by a control surface, for a wave of amplitude 1 m, of the bodies within it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ControlSurfaceDrift {
    /// Force along x (N/m2).
    pub surge: f64,
    /// Force along y (N/m2).
    pub sway: f64,
    /// Moment about the axis of the cylinder (N m/m2).
    pub yaw: f64,
}

/// Points may lie so far below the bottom, over the depth, as differences at it need; the potential is smooth through it.
const BOTTOM_ROOM: f64 = 0.02;

/// What of the mean momentum flux at a point goes to a body.
struct FluxPoint {
    at: Vector3<f64>,
    outward: Vector3<f64>,
    /// Area (m2), or of the waterline its length (m).
    weight: f64,
}

impl WaveSolution {
    /// The potential (m2/s) at points in the water or at the mean level, for a wave of amplitude 1 m from each of the headings with the motions
    /// of the bodies in it: heading by heading, then point by point. Within a panel's size of a hull it is no better than the panels. None where
    /// the motions are not those of all headings, or a point is above the mean level, below the bottom or not finite.
    pub fn potentials(&self, motions: &[Vec<C>], points: &[Vector3<f64>]) -> Option<Vec<Vec<C>>> {
        let lowest = self.wave.depth.map_or(f64::NEG_INFINITY, |depth| -depth * (1.0 + BOTTOM_ROOM));
        let is_in_water = |at: &Vector3<f64>| at.iter().all(|x| x.is_finite()) && at.z <= 0.0 && at.z >= lowest;
        if motions.len() != self.headings.len() || !points.iter().all(is_in_water) {
            return None;
        }
        let sources: Vec<(Vec<C>, Vec<C>)> =
            motions.iter().enumerate().map(|(i, motions)| self.sent_out(i, motions)).collect::<Option<_>>()?;
        let first = points.first().copied().unwrap_or_default();
        let horizontal = |point: &Vector3<f64>| (point.x - first.x).hypot(point.y - first.y);
        let farthest = |points: &mut dyn Iterator<Item = &Vector3<f64>>| points.map(horizontal).fold(0.0, f64::max);
        let corners = || self.mesh.hull().iter().flat_map(|panel| panel.corners());
        let images = self.mesh.mirrors().images();
        let of_hull = images.iter().fold(0.0, |most: f64, image| {
            most.max(corners().map(|corner| horizontal(&mirrored(corner, *image))).fold(0.0, f64::max))
        });
        let reach = farthest(&mut points.iter()) + of_hull;
        let draught = points.iter().chain(corners()).fold(0.0, |most: f64, point| most.max(-point.z));
        let nu = self.wave.frequency.powi(2) / self.wave.gravity;
        let kernel = WaveKernel::new(nu, self.wave.depth, reach, draught);
        let levels = LevelImage::of_all_frequencies(self.wave.depth);
        let count = self.mesh.hull_count();
        let by_point: Vec<Vec<C>> = points
            .par_iter()
            .map(|point| {
                let mut sums: Vec<C> =
                    self.headings.iter().map(|heading| self.wave.at(point, *heading).0 * (4.0 * PI)).collect();
                for (image, block) in images.iter().zip((0..).step_by(count)) {
                    let from = mirrored(point, *image);
                    for (index, panel) in self.mesh.hull().iter().enumerate() {
                        let (mut source, mut dipole) = kernel.over_panel(&from, panel);
                        for level in &levels {
                            let z = level.sign * from.z + level.shift;
                            let [potential, angle] = panel.rankine(&Vector3::new(from.x, from.y, z));
                            source += level.strength * potential;
                            dipole += level.strength * angle;
                        }
                        for (sum, (potential, by_normal)) in sums.iter_mut().zip(&sources) {
                            // the dipole is along the normal into the water
                            *sum += by_normal[block + index] * source + potential[block + index] * dipole;
                        }
                    }
                }
                sums.into_iter().map(|sum| sum / (4.0 * PI)).collect()
            })
            .collect();
        Some((0..self.headings.len()).map(|i| by_point.iter().map(|of_point| of_point[i]).collect()).collect())
    }

    /// Wave elevations (m/m) at points x, y outside of the hulls, as [`WaveSolution::potentials`].
    pub fn elevations(&self, motions: &[Vec<C>], points: &[[f64; 2]]) -> Option<Vec<Vec<C>>> {
        let points: Vec<_> = points.iter().map(|[x, y]| Vector3::new(*x, *y, 0.0)).collect();
        let factor = C::new(0.0, self.wave.frequency / self.wave.gravity);
        let potentials = self.potentials(motions, &points)?;
        Some(potentials.into_iter().map(|of| of.into_iter().map(|potential| potential * factor).collect()).collect())
    }

    /// Dynamic pressures (Pa/m) at points in the water, as [`WaveSolution::potentials`].
    pub fn pressures(&self, motions: &[Vec<C>], points: &[Vector3<f64>]) -> Option<Vec<Vec<C>>> {
        let factor = C::new(0.0, self.wave.frequency * self.water.density);
        let potentials = self.potentials(motions, points)?;
        Some(potentials.into_iter().map(|of| of.into_iter().map(|potential| potential * factor).collect()).collect())
    }

    /// The mean drift of the bodies within a control surface, heading by heading; `motions` are those of all bodies for each heading (m/m,
    /// rad/m). None where the motions are not those of all headings, or the cylinder is not above the bottom or crosses a hull.
    ///
    /// The mean momentum through the surface is `-(rho g/2) zeta^2 n` on its waterline and `(rho/2) |grad phi|^2 n - rho u u_n` below, with
    /// velocities by differences of the potential.
    pub fn control_surface_drift(
        &self,
        motions: &[Vec<C>],
        cylinder: &ControlCylinder,
    ) -> Option<Vec<ControlSurfaceDrift>> {
        let ControlCylinder { centre, radius, depth } = *cylinder;
        let on_bottom = self.wave.depth.is_some_and(|bottom| (depth / bottom - 1.0).abs() < 1e-9);
        if !(radius > 0.0 && depth > 0.0 && (on_bottom || self.wave.depth.is_none_or(|bottom| depth < bottom)))
            || self.crosses_hull(cylinder)
        {
            return None;
        }
        let k = self.wave.wave_number;
        let turns = SPARE_DIRECTIONS + 4 * (k * radius).ceil() as usize;
        let step = DIFFERENCE_SHARE * radius.min(depth).min(1.0 / k);
        let angle = 2.0 * PI / turns as f64;
        let (mut waterline, mut below) = (Vec::new(), Vec::new());
        for turn in 0..turns {
            let (sine, cosine) = (angle * turn as f64).sin_cos();
            let at = |r: f64, z: f64| Vector3::new(centre[0] + r * cosine, centre[1] + r * sine, z);
            let outward = Vector3::new(cosine, sine, 0.0);
            waterline.push(FluxPoint { at: at(radius, 0.0), outward, weight: radius * angle });
            below.extend(RULE.between(-depth, 0.0).map(|(z, height)| FluxPoint {
                at: at(radius, z),
                outward,
                weight: radius * angle * height,
            }));
            if !on_bottom {
                let down = Vector3::new(0.0, 0.0, -1.0);
                below.extend(RULE.between(0.0, radius).map(|(r, width)| FluxPoint {
                    at: at(r, -depth),
                    outward: down,
                    weight: r * angle * width,
                }));
            }
        }
        // around each point: x, y, and z downward, as the surface is above
        let (along, across, down) =
            (Vector3::new(step, 0.0, 0.0), Vector3::new(0.0, step, 0.0), Vector3::new(0.0, 0.0, -step));
        let arms = [along, -along, across, -across, Vector3::zeros(), down, 2.0 * down];
        let points: Vec<_> = below
            .iter()
            .flat_map(|point| arms.map(|arm| point.at + arm))
            .chain(waterline.iter().map(|point| point.at))
            .collect();
        let potentials = self.potentials(motions, &points)?;
        let density = self.water.density;
        let elevation = self.wave.frequency / self.wave.gravity;
        let mut made = Vec::with_capacity(potentials.len());
        for potentials in potentials {
            let mut drift = ControlSurfaceDrift::default();
            let mut add = |point: &FluxPoint, force: Vector3<f64>| {
                drift.surge += force.x * point.weight;
                drift.sway += force.y * point.weight;
                drift.yaw += ((point.at.x - centre[0]) * force.y - (point.at.y - centre[1]) * force.x) * point.weight;
            };
            let (fields, surface) = potentials.split_at(below.len() * arms.len());
            for (point, field) in below.iter().zip(fields.chunks_exact(arms.len())) {
                let velocity = [
                    (field[0] - field[1]) / (2.0 * step),
                    (field[2] - field[3]) / (2.0 * step),
                    (field[4] * 3.0 - field[5] * 4.0 + field[6]) / (2.0 * step),
                ];
                let through: C = velocity.iter().zip(point.outward.iter()).map(|(v, n)| v * *n).sum();
                let square: f64 = velocity.iter().map(|v| v.norm_sqr()).sum();
                let flux = Vector3::from(velocity.map(|v| (v * through.conj()).re));
                add(point, (point.outward * (0.5 * square) - flux) * (0.5 * density));
            }
            for (point, potential) in waterline.iter().zip(surface) {
                let square = (potential * elevation).norm_sqr();
                add(point, point.outward * (-0.25 * density * self.wave.gravity * square));
            }
            made.push(drift);
        }
        Some(made)
    }

    /// Whether panels lie on both sides of a cylinder, or below it.
    fn crosses_hull(&self, cylinder: &ControlCylinder) -> bool {
        let images = self.mesh.mirrors().images();
        self.mesh.hull().iter().any(|panel| {
            images.iter().any(|image| {
                let corners = panel.corners().map(|corner| mirrored(&corner, *image));
                let distances = corners.map(|at| (at.x - cylinder.centre[0]).hypot(at.y - cylinder.centre[1]));
                let inside = distances.iter().filter(|distance| **distance < cylinder.radius).count();
                let deepest = corners.iter().fold(0.0, |most: f64, at| most.max(-at.z));
                inside > 0 && (inside < corners.len() || deepest > cylinder.depth)
            })
        })
    }
}

impl DiffractionProblem {
    /// A control surface around all bodies, at a distance of a quarter of their extent.
    pub fn control_cylinder(&self) -> ControlCylinder {
        let (centre, radius, draught) = self.extent();
        let gap = 0.25 * radius.max(draught);
        let depth = draught + gap;
        let depth = self.water().depth.map_or(depth, |bottom| if depth > 0.9 * bottom { bottom } else { depth });
        ControlCylinder { centre, radius: radius + gap, depth }
    }
}
