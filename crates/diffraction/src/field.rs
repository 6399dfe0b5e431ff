//! The potential in the water around the bodies: wave elevation, pressure, and mean drift by the momentum through a control surface
//! [LEE-2007].

use crate::gauss::GaussRule;
use crate::influence::{FlowRoom, Strengths};
use crate::panel::Panel;
use crate::problem::DiffractionProblem;
use crate::rankine::{LevelImage, mirrored};
use crate::wave_solution::WaveSolution;
use crate::wave_system::WaveKernel;
use nalgebra::{Complex, Vector3};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::LazyLock;

type C = Complex<f64>;

/// Points down the side of a control surface, and along the radius of its bottom.
static RULE: LazyLock<GaussRule> = LazyLock::new(|| GaussRule::new(12));
/// Points of each rule on a box.
static BOX_RULE: LazyLock<GaussRule> = LazyLock::new(|| GaussRule::new(8));
/// Directions around a control surface, beyond four for each wave length of its circumference over pi.
const SPARE_DIRECTIONS: usize = 24;
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

/// An upright box in the water around one of several bodies, from the mean level down; no hull may cross it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlBox {
    /// x and y of its middle (m).
    pub centre: [f64; 2],
    /// Half of its length and half of its width (m).
    pub half: [f64; 2],
    /// Direction of its length (rad).
    pub heading: f64,
    /// Depth of its bottom (m).
    pub depth: f64,
}

/// A surface around bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ControlSurface {
    /// A cylinder.
    Cylinder(ControlCylinder),
    /// A box.
    Box(ControlBox),
}

/// Mean drift by a control surface, for a wave of amplitude 1 m, of the bodies within it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ControlSurfaceDrift {
    /// Force along x (N/m2).
    pub surge: f64,
    /// Force along y (N/m2).
    pub sway: f64,
    /// Moment about the vertical through the middle of the surface (N m/m2).
    pub yaw: f64,
}

/// Distance of a control surface from the bodies over their extent.
const CONTROL_SHARE: f64 = 0.25;
/// Distance of a control box from the hulls over the longest diagonal of the panels of its body, at least: a tenth of the side of a square one. Nearer the
/// flow is that of single panels, and the drift there can be off by several times itself.
const LEAST_GAP_SHARE: f64 = 0.07;
/// Distance from a panel over its diagonal within which a point is on it.
const HAIR: f64 = 1e-6;
/// Directions that a control box is tried in, over a quarter of a turn.
const BOX_DIRECTIONS: usize = 18;
/// Most rules along a side of a control surface.
const MAX_PIECES: usize = 40;

/// Points on the bottom may lie below it by rounding of this share of the depth.
const BOTTOM_ROOM: f64 = 1e-9;

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
        let sources = self.sources(motions, points)?;
        let (kernel, images) = (self.kernel_to(points), self.mesh.mirrors().images());
        let levels = LevelImage::of_all_frequencies(self.wave.depth);
        let count = self.mesh.emitter_count();
        let by_point: Vec<Vec<C>> = points
            .par_iter()
            .map(|point| {
                let point = &self.off_the_hulls(point);
                let mut sums: Vec<C> =
                    self.headings.iter().map(|heading| self.wave.at(point, *heading).0 * (4.0 * PI)).collect();
                for (image, block) in images.iter().zip((0..).step_by(count)) {
                    let from = mirrored(point, *image);
                    let waves = kernel.over_panels(&from, self.mesh.emitters());
                    for (index, (panel, (mut source, mut dipole))) in self.mesh.emitters().iter().zip(waves).enumerate()
                    {
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

    /// A point, by a hair into the water where it is on a panel: on the panel itself half of its jump is left.
    fn off_the_hulls(&self, point: &Vector3<f64>) -> Vector3<f64> {
        for image in self.mesh.mirrors().images() {
            let from = mirrored(point, image);
            for panel in self.mesh.hull() {
                let arm = from - panel.centroid;
                let height = arm.dot(&panel.normal);
                if height.abs() > HAIR * panel.diagonal || arm.norm_squared() > panel.diagonal * panel.diagonal {
                    continue;
                }
                let off = panel.normal * (2.0 * HAIR * panel.diagonal - height);
                // an edge sees a quarter of the sphere, a corner an eighth
                if panel.rankine(&(from + off))[1] > 0.9 * PI / 2.0 {
                    return point + mirrored(&off, image);
                }
            }
        }
        *point
    }

    /// Potentials and their derivatives along the normal on the hulls, heading by heading; none where the motions are not those of all headings, or a
    /// point is not in the water.
    fn sources(&self, motions: &[Vec<C>], points: &[Vector3<f64>]) -> Option<Vec<(Vec<C>, Vec<C>)>> {
        let lowest = self.wave.depth.map_or(f64::NEG_INFINITY, |depth| -depth * (1.0 + BOTTOM_ROOM));
        let is_in_water = |at: &Vector3<f64>| at.iter().all(|x| x.is_finite()) && at.z <= 0.0 && at.z >= lowest;
        if motions.len() != self.headings.len() || !points.iter().all(is_in_water) {
            return None;
        }
        motions.iter().enumerate().map(|(i, motions)| self.sent_out(i, motions)).collect()
    }

    /// The Green function between points and the hulls.
    fn kernel_to(&self, points: &[Vector3<f64>]) -> WaveKernel {
        let first = points.first().copied().unwrap_or_default();
        let horizontal = |point: &Vector3<f64>| (point.x - first.x).hypot(point.y - first.y);
        let farthest = |points: &mut dyn Iterator<Item = &Vector3<f64>>| points.map(horizontal).fold(0.0, f64::max);
        let corners = || self.mesh.emitters().iter().flat_map(|panel| panel.corners());
        let images = self.mesh.mirrors().images();
        let of_hull = images.iter().fold(0.0, |most: f64, image| {
            most.max(corners().map(|corner| horizontal(&mirrored(corner, *image))).fold(0.0, f64::max))
        });
        let reach = farthest(&mut points.iter()) + of_hull;
        let draught = points.iter().chain(corners()).fold(0.0, |most: f64, point| most.max(-point.z));
        let nu = self.wave.frequency.powi(2) / self.wave.gravity;
        WaveKernel::new(nu, self.wave.depth, reach, draught)
    }

    /// The velocities (m/s) at points in the water, below the mean level, as [`WaveSolution::potentials`]: point by point, then heading by heading.
    pub fn velocities(&self, motions: &[Vec<C>], points: &[Vector3<f64>]) -> Option<Vec<Vec<[C; 3]>>> {
        let strengths = Strengths::new(&self.sources(motions, points)?);
        let (kernel, images) = (self.kernel_to(points), self.mesh.mirrors().images());
        let levels = LevelImage::of_all_frequencies(self.wave.depth);
        let count = self.mesh.emitter_count();
        let of_point = |room: &mut FlowRoom, point: &Vector3<f64>| {
            let mut sums = vec![[C::default(); 3]; strengths.headings()];
            for (image, block) in images.iter().zip((0..).step_by(count)) {
                let flows = kernel.flows(&mirrored(point, *image), *image, self.mesh.emitters(), &levels, room);
                strengths.add_velocities(flows, block, &mut sums);
            }
            for (sum, heading) in sums.iter_mut().zip(&self.headings) {
                let (_, incident) = self.wave.at(point, *heading);
                for (value, own) in sum.iter_mut().zip(incident.iter()) {
                    *value = *value / (4.0 * PI) + own;
                }
            }
            sums
        };
        Some(points.par_iter().map_init(FlowRoom::default, of_point).collect())
    }

    /// Wave elevations (m/m) at points x, y outside of the hulls, as [`WaveSolution::potentials`].
    pub fn elevations(&self, motions: &[Vec<C>], points: &[[f64; 2]]) -> Option<Vec<Vec<C>>> {
        let places: Vec<_> = points.iter().map(|[x, y]| Vector3::new(*x, *y, 0.0)).collect();
        // the water rises by its vertical velocity
        let factor = C::new(0.0, self.wave.frequency / self.wave.gravity);
        let factors: Vec<C> = points.iter().map(|at| factor * C::new(1.0, self.damping_at(*at))).collect();
        let potentials = self.potentials(motions, &places)?;
        let of_heading =
            |of: Vec<C>| of.into_iter().zip(&factors).map(|(potential, factor)| potential * factor).collect();
        Some(potentials.into_iter().map(of_heading).collect())
    }

    /// The damping of the patch of the surface at a place; 0 on the free surface.
    pub(crate) fn damping_at(&self, at: [f64; 2]) -> f64 {
        let (panels, damping) = self.mesh.patches();
        let images = self.mesh.mirrors().images();
        let holds = |panel: &Panel| {
            images.iter().any(|image| {
                let [x, y] = [at[0] * image[0], at[1] * image[1]];
                let corners = panel.corners();
                // counter-clockwise as seen from above: the place is to the left of all sides
                (0..corners.len()).all(|i| {
                    let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
                    (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) >= 0.0
                })
            })
        };
        panels.iter().zip(damping).find(|(panel, _)| holds(panel)).map_or(0.0, |(_, epsilon)| *epsilon)
    }

    /// Dynamic pressures (Pa/m) at points in the water, as [`WaveSolution::potentials`].
    pub fn pressures(&self, motions: &[Vec<C>], points: &[Vector3<f64>]) -> Option<Vec<Vec<C>>> {
        let factor = C::new(0.0, self.wave.frequency * self.water.density);
        let potentials = self.potentials(motions, points)?;
        Some(potentials.into_iter().map(|of| of.into_iter().map(|potential| potential * factor).collect()).collect())
    }

    /// The wetted panels of all bodies with their mirror images (m), counter-clockwise as seen from the water, a triangle with a corner twice: in the order
    /// of [`WaveSolution::hull_pressures`].
    pub fn hull_panels(&self) -> Vec<[Vector3<f64>; 4]> {
        let of_image = |image: [f64; 2]| {
            self.mesh.hull().iter().map(move |panel| {
                let mut corners = panel.corners().map(|corner| mirrored(&corner, image));
                if image[0] * image[1] < 0.0 {
                    corners.reverse();
                }
                corners
            })
        };
        self.mesh.mirrors().images().into_iter().flat_map(of_image).collect()
    }

    /// Dynamic pressures on the panels of the hulls (Pa/m), for a wave of amplitude 1 m from each of the headings with the motions of the bodies in it:
    /// heading by heading, then panel by panel. None where the motions are not those of all headings.
    pub fn hull_pressures(&self, motions: &[Vec<C>]) -> Option<Vec<Vec<C>>> {
        let factor = C::new(0.0, self.wave.frequency * self.water.density);
        if motions.len() != self.headings.len() {
            return None;
        }
        let of_heading = |(heading, motions): (usize, &Vec<C>)| {
            let (potential, _) = self.sent_out(heading, motions)?;
            let on_hull = self.surface.iter().zip(potential).filter(|(at, _)| at.panel < self.mesh.hull_count());
            Some(on_hull.map(|(_, potential)| potential * factor).collect())
        };
        motions.iter().enumerate().map(of_heading).collect()
    }

    /// The mean drift of the bodies within a control surface, heading by heading; `motions` are those of all bodies for each heading (m/m,
    /// rad/m). None where the motions are not those of all headings, or the surface is not above the bottom or crosses a hull.
    ///
    /// The mean momentum through the surface is `-(rho g/2) zeta^2 n` on its waterline and `(rho/2) |grad phi|^2 n - rho u u_n` below.
    pub fn control_surface_drift(
        &self,
        motions: &[Vec<C>],
        surface: &ControlSurface,
    ) -> Option<Vec<ControlSurfaceDrift>> {
        let (centre, [width, depth]) = (surface.centre(), surface.size());
        let on_bottom = self.wave.depth.is_some_and(|bottom| (depth / bottom - 1.0).abs() < 1e-9);
        let is_above = on_bottom || self.wave.depth.is_none_or(|bottom| depth < bottom);
        if !(width > 0.0 && depth > 0.0 && is_above) {
            return None;
        }
        let k = self.wave.wave_number;
        let gap = self.distance_to_hull(surface)?;
        let (waterline, below) = match surface {
            ControlSurface::Cylinder(cylinder) => cylinder.points(k, on_bottom),
            ControlSurface::Box(block) => block.points(k, gap, on_bottom),
        };
        let at = |points: &[FluxPoint]| points.iter().map(|point| point.at).collect::<Vec<_>>();
        let at_waterline = self.potentials(motions, &at(&waterline))?;
        let velocities = self.velocities(motions, &at(&below))?;
        let density = self.water.density;
        let elevation = self.wave.frequency / self.wave.gravity;
        let mut made = Vec::with_capacity(at_waterline.len());
        for (heading, at_waterline) in at_waterline.iter().enumerate() {
            let mut drift = ControlSurfaceDrift::default();
            let mut add = |point: &FluxPoint, force: Vector3<f64>| {
                drift.surge += force.x * point.weight;
                drift.sway += force.y * point.weight;
                drift.yaw += ((point.at.x - centre[0]) * force.y - (point.at.y - centre[1]) * force.x) * point.weight;
            };
            for (point, velocities) in below.iter().zip(&velocities) {
                let velocity = velocities[heading];
                let through: C = velocity.iter().zip(point.outward.iter()).map(|(v, n)| v * *n).sum();
                let square: f64 = velocity.iter().map(|v| v.norm_sqr()).sum();
                let flux = Vector3::from(velocity.map(|v| (v * through.conj()).re));
                add(point, (point.outward * (0.5 * square) - flux) * (0.5 * density));
            }
            for (point, potential) in waterline.iter().zip(at_waterline) {
                // in a damped patch the water rises beyond the head of its pressure
                let damping = self.damping_at([point.at.x, point.at.y]);
                let square = (potential * elevation).norm_sqr() * (1.0 - damping * damping);
                add(point, point.outward * (-0.25 * density * self.wave.gravity * square));
            }
            made.push(drift);
        }
        Some(made)
    }

    /// The least distance (m) of the hulls from a surface, on the plan or below it; none where panels lie on both sides of it.
    fn distance_to_hull(&self, surface: &ControlSurface) -> Option<f64> {
        let images = self.mesh.mirrors().images();
        let depth = surface.size()[1];
        let mut least = f64::INFINITY;
        for panel in self.mesh.hull() {
            for image in &images {
                let corners = panel.corners().map(|corner| mirrored(&corner, *image));
                let beyond = corners.map(|at| surface.distance_beyond([at.x, at.y]));
                let below = corners.map(|at| -at.z - depth);
                let is_beside = beyond.iter().all(|distance| *distance >= 0.0);
                let is_below = below.iter().all(|distance| *distance >= 0.0);
                let is_inside = beyond.iter().chain(&below).all(|distance| *distance <= 0.0);
                if !(is_beside || is_below || is_inside) {
                    return None;
                }
                let nearest = |distances: [f64; 4]| distances.iter().fold(f64::INFINITY, |l, d| l.min(d.abs()));
                let on_bottom =
                    is_inside && self.wave.depth.is_some_and(|bottom| depth >= bottom * (1.0 - BOTTOM_ROOM));
                least = match (is_inside, is_beside) {
                    (true, _) if !on_bottom => least.min(nearest(beyond)).min(nearest(below)),
                    (true, _) | (_, true) => least.min(nearest(beyond)),
                    _ => least.min(nearest(below)),
                };
            }
        }
        Some(least)
    }
}

/// Points of the waterline of a control surface, and of what is below it.
type FluxPoints = (Vec<FluxPoint>, Vec<FluxPoint>);

impl ControlSurface {
    /// x and y of its middle (m).
    pub fn centre(&self) -> [f64; 2] {
        match self {
            ControlSurface::Cylinder(cylinder) => cylinder.centre,
            ControlSurface::Box(block) => block.centre,
        }
    }

    /// The least of half its length and width, and its depth (m).
    fn size(&self) -> [f64; 2] {
        match self {
            ControlSurface::Cylinder(cylinder) => [cylinder.radius, cylinder.depth],
            ControlSurface::Box(block) => [block.half[0].min(block.half[1]), block.depth],
        }
    }

    /// How far a point on the plan is outside of it (m); within it less than zero.
    fn distance_beyond(&self, at: [f64; 2]) -> f64 {
        match self {
            ControlSurface::Cylinder(own) => (at[0] - own.centre[0]).hypot(at[1] - own.centre[1]) - own.radius,
            ControlSurface::Box(own) => {
                let [x, y] = own.along_axes(at);
                (x.abs() - own.half[0]).max(y.abs() - own.half[1])
            }
        }
    }
}

impl ControlCylinder {
    fn points(&self, k: f64, on_bottom: bool) -> FluxPoints {
        let ControlCylinder { centre, radius, depth } = *self;
        let turns = SPARE_DIRECTIONS + 4 * (k * radius).ceil() as usize;
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
        (waterline, below)
    }
}

impl ControlBox {
    /// From its middle, along its length and its width (m).
    fn along_axes(&self, at: [f64; 2]) -> [f64; 2] {
        let (sine, cosine) = self.heading.sin_cos();
        let (x, y) = (at[0] - self.centre[0], at[1] - self.centre[1]);
        [x * cosine + y * sine, y * cosine - x * sine]
    }

    /// `gap` is the distance of the hulls (m), over which the field changes.
    fn points(&self, k: f64, gap: f64, on_bottom: bool) -> FluxPoints {
        let (sine, cosine) = self.heading.sin_cos();
        let turned = |x: f64, y: f64, z: f64| Vector3::new(x * cosine - y * sine, x * sine + y * cosine, z);
        let middle = Vector3::new(self.centre[0], self.centre[1], 0.0);
        // a rule of eight points for three radians of the wave and eight distances of the hull
        let pieces =
            |length: f64| ((k * length / 3.0).max(length / (8.0 * gap)).ceil().max(1.0) as usize).min(MAX_PIECES);
        let along = |half: f64| -> Vec<(f64, f64)> {
            let count = pieces(2.0 * half);
            let end = |piece: usize| half * (2.0 * piece as f64 / count as f64 - 1.0);
            (0..count).flat_map(|piece| BOX_RULE.between(end(piece), end(piece + 1)).collect::<Vec<_>>()).collect()
        };
        let [lengths, widths] = self.half.map(along);
        let (mut waterline, mut below) = (Vec::new(), Vec::new());
        for sign in [1.0, -1.0] {
            let long = lengths.iter().map(|(x, share)| ([*x, sign * self.half[1]], [0.0, sign], *share));
            let wide = widths.iter().map(|(y, share)| ([sign * self.half[0], *y], [sign, 0.0], *share));
            for ([x, y], [nx, ny], share) in long.chain(wide) {
                let outward = turned(nx, ny, 0.0);
                waterline.push(FluxPoint { at: middle + turned(x, y, 0.0), outward, weight: share });
                below.extend(BOX_RULE.between(-self.depth, 0.0).map(|(z, height)| FluxPoint {
                    at: middle + turned(x, y, z),
                    outward,
                    weight: share * height,
                }));
            }
        }
        if !on_bottom {
            let outward = Vector3::new(0.0, 0.0, -1.0);
            below.extend(lengths.iter().flat_map(|(x, length)| {
                widths.iter().map(move |(y, width)| FluxPoint {
                    at: middle + turned(*x, *y, -self.depth),
                    outward,
                    weight: length * width,
                })
            }));
        }
        (waterline, below)
    }
}

impl DiffractionProblem {
    /// A control surface around all bodies, at a distance of a quarter of their extent.
    pub fn control_cylinder(&self) -> ControlCylinder {
        let (centre, radius, draught) = self.extent();
        let gap = CONTROL_SHARE * radius.max(draught);
        ControlCylinder { centre, radius: radius + gap, depth: self.control_depth(draught + gap) }
    }

    /// A control surface around one of the bodies, with sides along a heading (rad) and its opposite: at a distance of a quarter of its extent, or
    /// half way to the nearest other body, beside it or beneath its keel. None where another body is within the rectangle of its waterline and no deeper, or
    /// so near that the box would be among the panels.
    pub fn control_box(&self, body: usize, heading: f64) -> Option<ControlBox> {
        self.box_and_gap(body, heading).map(|(made, _)| made)
    }

    /// As [`DiffractionProblem::control_box`], and where none fits along the heading, turned to where it is farthest from the hulls. None where a body is within the
    /// rectangle of another in all directions and no deeper, as one in a dock; the lower of two bodies one above the other has none.
    pub fn turned_control_box(&self, body: usize, heading: f64) -> Option<ControlBox> {
        let turned = || {
            let of = |step: usize| self.box_and_gap(body, heading + step as f64 * FRAC_PI_2 / BOX_DIRECTIONS as f64);
            // the first of equals
            (1..BOX_DIRECTIONS).filter_map(of).reduce(|best, other| if other.1 > best.1 { other } else { best })
        };
        self.box_and_gap(body, heading).or_else(turned).map(|(made, _)| made)
    }

    /// A control box and its distance from the hulls (m).
    fn box_and_gap(&self, body: usize, heading: f64) -> Option<(ControlBox, f64)> {
        let corners = |which: usize| self.body_corners(which);
        let (sine, cosine) = heading.sin_cos();
        let axes = |at: &Vector3<f64>| [at.x * cosine + at.y * sine, at.y * cosine - at.x * sine];
        let own = corners(body)?;
        let limits = [0, 1].map(|axis| {
            own.iter()
                .map(|at| axes(at)[axis])
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
        });
        let draught = own.iter().fold(0.0, |most: f64, at| most.max(-at.z));
        let least = LEAST_GAP_SHARE * self.largest_panel(body);
        let middle = limits.map(|[low, high]| 0.5 * (low + high));
        let half = limits.map(|[low, high]| 0.5 * (high - low));
        let mut gap = CONTROL_SHARE * half[0].max(half[1]).max(draught);
        let mut under = f64::INFINITY;
        for other in (0..).map_while(|which| Some((which, corners(which)?))).filter(|(which, _)| *which != body) {
            let beyond = |at: &Vector3<f64>| {
                let [x, y] = axes(at);
                ((x - middle[0]).abs() - half[0]).max((y - middle[1]).abs() - half[1])
            };
            let beside = other.1.iter().map(beyond).fold(f64::INFINITY, f64::min);
            let below = other.1.iter().map(|at| -at.z - draught).fold(f64::INFINITY, f64::min);
            // one that is beneath the keel is left out below
            if beside <= 0.0 && below > 0.0 {
                under = under.min(0.5 * below);
            } else {
                gap = gap.min(0.5 * beside);
            }
        }
        let centre = [middle[0] * cosine - middle[1] * sine, middle[0] * sine + middle[1] * cosine];
        let clearance = gap.max(CONTROL_SHARE * half[0].min(half[1])).min(under);
        let depth = draught + clearance;
        let depth = if under.is_finite() { depth } else { self.control_depth(depth) };
        (gap > least)
            .then_some((ControlBox { centre, half: half.map(|half| half + gap), heading, depth }, gap.min(under)))
    }

    /// A depth of a control surface (m), on the bottom where that is near.
    fn control_depth(&self, depth: f64) -> f64 {
        self.water().depth.map_or(depth, |bottom| if depth > 0.9 * bottom { bottom } else { depth })
    }
}
