//! Liquid in compartments: its level in any attitude, its weight on the body, and the stiffness its free surface takes away.
//!
//! The contents are a constant volume with a level surface. The level is where the part of the compartment below it holds that volume
//! (a safeguarded Newton iteration on the exact integrals of [`super::hull`]; the area of the surface is the derivative). The weight acts at
//! the centroid of that part, so that the moment is exact at any heel, and its tangent is that of a fixed level less what the level takes up
//! when the volume stays: with u the change of volume, of its moment and of the force by a rise of the level, `K - gamma u u^T / A`.
//! A flooded compartment holds sea water up to the waterline: minus the buoyancy of its inside.
//!
//! In time the contents are quasi-static: the surface is level at every instant, and the mass of the liquid is that of a solid of the form it has
//! where the run begins. Sloshing and flow through holes are not computed.

use super::buoyancy::{SolidForm, join_reaches};
use super::hull::SubmergedVolume;
use super::stability::WaterSlabs;
use super::{BodyLoad, Category, Immersed, Load};
use nalgebra::{Matrix3, SVector, Vector2, Vector3};
use windlass_base::dense::{Lu, never};
use windlass_base::geometry::Position;
use windlass_base::pose::{Pose, Six};
use windlass_model::{Body, ClassError, Compartment, FreeSurface, Mass, Model};

/// Most steps of the search for a level; bisection halves the interval where Newton's step leaves it.
const MAX_LEVEL_ITERATIONS: usize = 200;
/// What may be left of the volume, as a share of the capacity.
const VOLUME_TOLERANCE: f64 = 1e-14;
/// Shares of the capacity nearer than this to 0 and 1 are empty and full.
const PRESSED: f64 = 1e-12;

/// A compartment as a space that holds liquid.
#[derive(Debug)]
pub struct Tank {
    /// Its name.
    pub name: String,
    /// Its solids with the share of their volume that liquid fills.
    solids: Vec<(f64, SolidForm)>,
    /// Volume of liquid when it is full (m3).
    pub capacity: f64,
    /// Share of the capacity that is filled.
    fraction: f64,
    /// Share that cannot be pumped out and has no free surface.
    residual: f64,
    maximum: f64,
    /// Density of the liquid (kg/m3).
    density: f64,
    surface: FreeSurface,
    is_flooded: bool,
    /// Height of the sea (m, global) and its density (kg/m3).
    sea: (f64, f64),
    gravity: f64,
}

/// Liquid in a tank in one attitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Liquid {
    /// Height of its surface (m, global).
    pub level: f64,
    /// What is below it.
    pub below: SubmergedVolume,
}

impl Liquid {
    /// Its volume (m3).
    pub fn volume(&self) -> f64 {
        self.below.volume
    }

    /// Its centroid about the origin of the pose, global axes (m); none of none.
    pub fn centroid(&self) -> Option<Vector3<f64>> {
        (self.below.volume > 0.0).then(|| self.below.moment / self.below.volume)
    }

    /// Second moments of its surface about axes through its centroid: about the body's longitudinal and transverse axis (m4).
    pub fn surface_inertia(&self, pose: &Pose) -> [f64; 2] {
        let (wet, area) = (&self.below, self.below.plane_area);
        if area <= 0.0 {
            return [0.0; 2];
        }
        let [sx, sy] = wet.plane_moment;
        let [xx, xy, yy] = wet.plane_second;
        let [xx, xy, yy] = [xx - sx * sx / area, xy - sx * sy / area, yy - sy * sy / area];
        let ahead = pose.axes.column(0);
        let size = ahead[0].hypot(ahead[1]);
        let (c, s) = if size > 1e-9 { (ahead[0] / size, ahead[1] / size) } else { (1.0, 0.0) };
        [s * s * xx - 2.0 * s * c * xy + c * c * yy, c * c * xx + 2.0 * s * c * xy + s * s * yy]
    }
}

impl Tank {
    /// The space of a compartment with what is in it.
    ///
    /// # Errors
    /// A compartment without pieces, or with a surface that is not closed.
    pub fn new(model: &Model, compartment: &Compartment) -> Result<Tank, ClassError> {
        let mut solids = Vec::new();
        for part in model.parts.values() {
            let own = part.pieces.iter().filter(|piece| {
                piece.compartment.as_ref().is_some_and(|name| name.eq_ignore_ascii_case(&compartment.name))
            });
            for piece in own {
                let form = SolidForm::of_piece(part, piece)?;
                solids.push((-piece.permeability, form));
            }
        }
        let capacity: f64 = solids.iter().map(|(share, form)| share * form.volume()).sum();
        if capacity <= 0.0 || !capacity.is_finite() {
            return Err(ClassError::new(format!("compartment {} encloses no volume", compartment.name))
                .with_span(compartment.span)
                .help("PGEN and &DESCRIBE PIECE after &DESCRIBE COMPARTMENT give its surface"));
        }
        let (around, contents) = (model.surroundings(), compartment.contents);
        Ok(Tank {
            name: compartment.name.clone(),
            solids,
            capacity,
            fraction: contents.fraction,
            residual: compartment.residual,
            maximum: compartment.maximum,
            density: contents.density,
            surface: contents.surface,
            is_flooded: contents.is_flooded,
            sea: (around.tide, around.water_density),
            gravity: around.gravity,
        })
    }

    /// The same with another share of its capacity filled.
    #[must_use]
    pub fn with_fraction(self, fraction: f64) -> Tank {
        Tank { fraction, is_flooded: false, ..self }
    }

    /// Density of what is in it (kg/m3).
    pub fn density(&self) -> f64 {
        if self.is_flooded { self.sea.1 } else { self.density }
    }

    /// What of it is below a height (m, global), in a pose.
    pub fn below(&self, pose: &Pose, level: f64) -> SubmergedVolume {
        let mut sum = SubmergedVolume::default();
        for (share, form) in &self.solids {
            sum.add(&form.wet(pose, level), *share);
        }
        sum
    }

    /// Its least and greatest height in a pose (m, global).
    pub fn reach(&self, pose: &Pose) -> [f64; 2] {
        let heights = self.solids.iter().map(|(_, form)| form.reach(pose));
        heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [a, b]| [low.min(a), high.max(b)])
    }

    /// Its liquid in a pose.
    ///
    /// # Errors
    /// A level that is not found.
    pub fn liquid(&self, pose: &Pose) -> Result<Liquid, ClassError> {
        if self.is_flooded {
            let level = self.sea.0;
            return Ok(Liquid { level, below: self.below(pose, level) });
        }
        self.liquid_of(pose, self.fraction * self.capacity)
    }

    /// The level at which it holds a volume (m3).
    ///
    /// # Errors
    /// A level that is not found.
    pub fn liquid_of(&self, pose: &Pose, volume: f64) -> Result<Liquid, ClassError> {
        let [low, high] = self.reach(pose);
        let size = high - low;
        if volume <= PRESSED * self.capacity {
            return Ok(Liquid { level: low, below: SubmergedVolume::default() });
        }
        if volume >= (1.0 - PRESSED) * self.capacity {
            let mut below = self.below(pose, high + size);
            (below.plane_area, below.plane_moment, below.plane_second) = (0.0, [0.0; 2], [0.0; 3]);
            return Ok(Liquid { level: high, below });
        }
        let (mut bottom, mut top) = (low, high);
        let mut level = low + size * volume / self.capacity;
        for _ in 0..MAX_LEVEL_ITERATIONS {
            let below = self.below(pose, level);
            let left = below.volume - volume;
            if left.abs() <= VOLUME_TOLERANCE * self.capacity || top - bottom <= 1e-15 * size {
                return Ok(Liquid { level, below });
            }
            if left > 0.0 {
                top = level;
            } else {
                bottom = level;
            }
            let step = level - left / below.plane_area;
            let middle = 0.5 * (bottom + top);
            let next = if below.plane_area > 0.0 && step > bottom && step < top { step } else { middle };
            if next == level {
                return Ok(Liquid { level, below });
            }
            level = next;
        }
        Err(ClassError::new(format!("compartment {}: no level was found for its contents", self.name)))
    }

    /// Whether its liquid has no free surface of its own.
    fn is_frozen(&self) -> bool {
        self.surface == FreeSurface::Frozen || self.fraction <= self.residual
    }

    /// The pose in which its surface is level: upright for contents that turn with the body, else where the body is.
    pub fn level_pose(&self, pose: &Pose) -> Pose {
        if self.is_frozen() && !self.is_flooded { Pose::default() } else { *pose }
    }

    /// The wrench and stiffness of its contents.
    fn load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let weight = self.density() * self.gravity;
        if self.is_flooded {
            let load = self.below(pose, self.sea.0).load(weight);
            return Ok(Load { wrench: -load.wrench, stiffness: -load.stiffness });
        }
        let down = |volume: f64| Vector3::new(0.0, 0.0, -weight * volume);
        if self.is_frozen() {
            let upright = self.liquid(&Pose::default())?;
            let Some(centroid) = upright.centroid() else { return Ok(Load::none()) };
            return Ok(Load::constant(down(upright.volume()), pose.axes * centroid));
        }
        let liquid = self.liquid(pose)?;
        let Some(centroid) = liquid.centroid() else { return Ok(Load::none()) };
        let below = &liquid.below;
        if below.plane_area <= 0.0 {
            return Ok(Load::constant(down(liquid.volume()), centroid));
        }
        let fixed = below.load(weight);
        let [sx, sy] = below.plane_moment;
        let rise = Six::new(0.0, 0.0, below.plane_area, sy, -sx, 0.0);
        let kept = fixed.stiffness - rise * rise.transpose() * (weight / below.plane_area);
        Ok(Load { wrench: -fixed.wrench, stiffness: -kept })
    }

    /// What of it is below a water surface, slab by slab.
    fn slabs_below(&self, pose: &Pose, water: &WaterSlabs) -> Vec<SubmergedVolume> {
        let mut sums = vec![SubmergedVolume::default(); water.count()];
        self.solids.iter().for_each(|(share, form)| form.add_slabs(pose, water, *share, &mut sums));
        sums
    }

    /// Whether it is open to the sea.
    pub fn is_flooded(&self) -> bool {
        self.is_flooded
    }

    /// Its liquid in a pose, in the slabs of a water surface: that of the sea where it is flooded, else its own level. A liquid that turns
    /// with the body is taken as it lies upright.
    ///
    /// # Errors
    /// A level that is not found.
    pub fn liquid_slabs(&self, pose: &Pose, sea: &WaterSlabs) -> Result<Vec<SubmergedVolume>, ClassError> {
        if self.is_flooded {
            return Ok(self.slabs_below(pose, sea));
        }
        let (x, y) = (sea.ahead.x, sea.ahead.y);
        let upright = Matrix3::new(x, -y, 0.0, y, x, 0.0, 0.0, 0.0, 1.0);
        let lies = if self.is_frozen() { Pose { axes: upright, ..*pose } } else { *pose };
        let level = self.liquid(&lies)?.level;
        let stations = sea.stations.iter().map(|[at, _]| [*at, level]).collect();
        Ok(self.slabs_below(&lies, &WaterSlabs { stations, ..sea.clone() }))
    }

    /// The mass of its contents in the axes of its body, as they lie in a pose.
    ///
    /// # Errors
    /// A level that is not found.
    pub fn mass(&self, pose: &Pose) -> Result<Mass, ClassError> {
        let at = self.level_pose(pose);
        let liquid = self.liquid(&at)?;
        let Some(centroid) = liquid.centroid() else { return Ok(Mass::default()) };
        let density = self.density();
        let mut second = Matrix3::zeros();
        for (share, form) in &self.solids {
            second += form.second_moments(&at, liquid.level) * *share;
        }
        let turned = at.axes.transpose() * second * at.axes * density;
        let inertia = Matrix3::identity() * turned.trace() - turned;
        Ok(Mass { mass: density * liquid.volume(), centre: at.axes.transpose() * centroid, inertia })
    }

    /// How far along its sounding tube its liquid reaches, from the bottom (m); none where the tube lies level.
    pub fn sounding(&self, pose: &Pose, tube: [Position; 2], level: f64) -> Option<f64> {
        let [top, bottom] = tube.map(|at| pose.origin + pose.axes * Vector3::from(at));
        let along = top - bottom;
        let length = along.norm();
        let rise = along.z / length;
        (length > 0.0 && rise.abs() > 1e-9).then(|| (level - bottom.z) / rise)
    }

    /// The volume at a sounding (m3); none where the tube lies level.
    pub fn volume_at(&self, pose: &Pose, tube: [Position; 2], sounding: f64) -> Option<f64> {
        let [top, bottom] = tube.map(|at| pose.origin + pose.axes * Vector3::from(at));
        let along = top - bottom;
        let (length, [low, high]) = (along.norm(), self.reach(pose));
        if length <= 0.0 || along.z.abs() <= 1e-9 * length {
            return None;
        }
        let level = bottom.z + along.z / length * sounding;
        if level >= high {
            return Some(self.capacity);
        }
        Some(self.below(pose, level.max(low)).volume)
    }

    /// The ends of its sounding tube in its body: those given, else on the vertical of the body through the centroid of the full tank, at its
    /// greatest and least height.
    pub fn sounding_tube(&self, model: &Model, compartment: &Compartment) -> [Position; 2] {
        let at = |name: &String| {
            let point = model.points.get(&Model::key(name))?;
            let part = model.parts.get(&Model::key(&point.part))?;
            Some(part.position.apply(point.at))
        };
        let given = compartment.sounding_tube.as_ref().and_then(|[top, bottom]| Some([at(top)?, at(bottom)?]));
        given.unwrap_or_else(|| {
            let upright = Pose::default();
            let [low, high] = self.reach(&upright);
            let centre =
                self.liquid_of(&upright, self.capacity).ok().and_then(|full| full.centroid()).unwrap_or_default();
            [[centre.x, centre.y, high], [centre.x, centre.y, low]]
        })
    }
}

/// The contents of a tank as a load on its body.
#[derive(Debug)]
struct TankLoad(Tank);

impl BodyLoad for TankLoad {
    fn category(&self) -> Category {
        Category::Contents
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        self.0.load(pose)
    }

    fn as_immersed(&self) -> Option<&dyn Immersed> {
        self.0.is_flooded.then_some(self)
    }
}

impl Immersed for TankLoad {
    fn lift(&self) -> f64 {
        -self.0.density() * self.0.gravity
    }

    fn wet(&self, pose: &Pose) -> SubmergedVolume {
        self.0.below(pose, self.0.sea.0)
    }

    fn wet_slabs(&self, pose: &Pose, water: &WaterSlabs) -> Vec<SubmergedVolume> {
        self.0.slabs_below(pose, water)
    }

    fn reach_along(&self, pose: &Pose, ahead: &Vector2<f64>) -> [f64; 2] {
        join_reaches(self.0.solids.iter().map(|(_, form)| form.reach_along(pose, ahead)))
    }
}

/// The compartments of a body.
pub fn compartments_of<'a>(model: &'a Model, body: &'a Body) -> impl Iterator<Item = &'a Compartment> {
    let own = |name: &str| {
        model.parts.get(&Model::key(name)).is_some_and(|part| Model::key(&part.body) == Model::key(&body.name))
    };
    model.compartments.values().filter(move |compartment| own(&compartment.part))
}

/// The tanks of a body that hold something, each as a load.
///
/// # Errors
/// A compartment that is no closed space.
pub fn build_tank_loads(model: &Model, body: &Body) -> Result<Vec<Box<dyn BodyLoad>>, ClassError> {
    let holds = |c: &&Compartment| c.contents.is_flooded || c.contents.fraction > 0.0;
    compartments_of(model, body)
        .filter(holds)
        .map(|compartment| Ok(Box::new(TankLoad(Tank::new(model, compartment)?)) as Box<dyn BodyLoad>))
        .collect()
}

/// The mass of what is in the compartments of a body where it stands.
///
/// # Errors
/// As `build_tank_loads`.
pub fn contents_mass(model: &Model, body: &Body) -> Result<Mass, ClassError> {
    let pose = Pose::from_place(&body.position);
    let holds = |c: &&Compartment| c.contents.is_flooded || c.contents.fraction > 0.0;
    compartments_of(model, body)
        .filter(holds)
        .try_fold(Mass::default(), |sum, compartment| Ok(sum.combine(&Tank::new(model, compartment)?.mass(&pose)?)))
}

/// The mass of a body with what is in its compartments, where it stands.
///
/// # Errors
/// As `build_tank_loads`.
pub fn laden_mass(model: &Model, body: &Body) -> Result<Mass, ClassError> {
    let own = Mass::from_parts(model.parts_of(body), model.defaults.gravity);
    Ok(own.combine(&contents_mass(model, body)?))
}

/// Most steps of the search for ballast.
const MAX_BALLAST_ITERATIONS: usize = 200;
/// What may be left of force and moment, as a share of the weight of all tanks and of it times their size.
const BALLAST_TOLERANCE: f64 = 1e-11;

/// Shares of tanks with which a wrench (force up, moments about x and y; global, about the origin of the pose) is balanced: from the same
/// share of all, by the smallest changes of their weights that balance it.
///
/// # Errors
/// No shares between empty and full that do.
pub fn balance_tanks(tanks: &[Tank], pose: &Pose, rest: &Six) -> Result<Vec<f64>, ClassError> {
    let none = || {
        ClassError::new(
            "no solution to the ballasting problem was found: no contents of these tanks balance the body here",
        )
        .help("choose at least four tanks, to port and starboard, fore and aft, that hold enough")
    };
    let full: Vec<f64> = tanks.iter().map(|t| t.density * t.gravity * t.capacity).collect();
    let whole: f64 = full.iter().sum();
    let arms = tanks.iter().map(|t| t.liquid_of(pose, t.capacity).map(|l| l.centroid().unwrap_or_default().norm()));
    let size = arms.collect::<Result<Vec<_>, _>>()?.into_iter().fold(1e-3, f64::max);
    let wanted = rest[2] / whole;
    if !(-1e-9..=1.0 + 1e-9).contains(&wanted) {
        return Err(none());
    }
    let limits: Vec<[f64; 2]> = tanks.iter().map(|tank| [tank.residual.min(tank.maximum), tank.maximum]).collect();
    let mut shares: Vec<f64> = limits.iter().map(|[least, most]| wanted.clamp(*least, *most)).collect();
    for _ in 0..MAX_BALLAST_ITERATIONS {
        let mut left = SVector::<f64, 3>::new(rest[2], rest[3], rest[4]);
        let mut slopes = Vec::with_capacity(tanks.len());
        for ((tank, share), full) in tanks.iter().zip(&shares).zip(&full) {
            let liquid = tank.liquid_of(pose, share * tank.capacity)?;
            let centroid = liquid.centroid().unwrap_or_default();
            let weight = share * full;
            left -= SVector::<f64, 3>::new(weight, weight * centroid.y, -weight * centroid.x);
            // more liquid comes in at the surface
            let inside = tank.liquid_of(pose, share.clamp(1e-6, 1.0 - 1e-6) * tank.capacity)?.below;
            let (x, y) = match inside.plane_area > 0.0 {
                true => (inside.plane_moment[0] / inside.plane_area, inside.plane_moment[1] / inside.plane_area),
                false => (centroid.x, centroid.y),
            };
            slopes.push(SVector::<f64, 3>::new(*full, full * y, -full * x));
        }
        let scale = SVector::<f64, 3>::new(1.0, 1.0 / size, 1.0 / size);
        if left.component_mul(&scale).amax() <= BALLAST_TOLERANCE * whole {
            return Ok(shares);
        }
        // the smallest change that balances it; tanks that it would overfill or empty are held, and the rest asked again
        let mut held = vec![false; tanks.len()];
        let change = loop {
            let mut matrix = Matrix3::zeros();
            for (slope, _) in slopes.iter().zip(&held).filter(|(_, held)| !**held) {
                let slope = slope.component_mul(&scale) / whole;
                matrix += slope * slope.transpose();
            }
            let asked = left.component_mul(&scale) / whole;
            let Ok(multipliers) = Lu::new(matrix, &never).and_then(|lu| lu.solve(&asked)) else { return Err(none()) };
            let change: Vec<f64> = slopes
                .iter()
                .zip(&held)
                .map(|(slope, held)| if *held { 0.0 } else { (slope.component_mul(&scale) / whole).dot(&multipliers) })
                .collect();
            let mut are_all_within = true;
            for (((share, change), held), [least, most]) in shares.iter().zip(&change).zip(&mut held).zip(&limits) {
                let is_beyond = (share <= least && *change < 0.0) || (share >= most && *change > 0.0);
                are_all_within &= *held || !is_beyond;
                *held |= is_beyond;
            }
            if are_all_within {
                break change;
            }
        };
        for ((share, change), [least, most]) in shares.iter_mut().zip(change).zip(&limits) {
            *share = (*share + change).clamp(*least, *most);
        }
    }
    Err(none())
}
