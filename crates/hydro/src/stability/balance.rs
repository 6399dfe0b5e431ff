//! A body balanced in heave, roll and trim under weight and buoyancy.
//!
//! Source: [MOSES-REF hstatic, equi_h, rarm]: three degrees of freedom (heave and two angles), connectors left out.

use super::slabs::WaterSlabs;
use super::static_wave::StaticWave;
use crate::hull::SubmergedVolume;
use crate::{BodyLoad, Category, Floating, Load};
use nalgebra::{Matrix3, Rotation3, Vector2, Vector3};
use windlass_base::dense::{Lu, never};
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::units::Dim;
use windlass_model::{Body, ClassError, Model};

/// Most Newton steps of one balance.
const MAX_NEWTON_ITERATIONS: usize = 200;
/// Largest change of an angle in a step (rad).
const MAX_ANGLE_CHANGE_RAD: f64 = 0.1;
/// What may be left of force and moment, as a share of the weight and of the weight times the size.
const RESIDUAL_TOLERANCE: f64 = 1e-10;

/// A waterplane that is none, as a share of the wetted area.
const NO_WATERPLANE: f64 = 1e-12;

/// Where a body stands to the water: rolled about a horizontal axis and trimmed across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attitude {
    /// The origin of the body (m, global).
    pub origin: [f64; 3],
    /// Turn about the roll axis (rad).
    pub roll: f64,
    /// Turn about the level axis across it (rad).
    pub trim: f64,
    /// Heading of the body's x axis when it is upright (rad).
    pub heading: f64,
    /// Angle of the roll axis from the body's x axis (rad).
    pub axis: f64,
}

impl Attitude {
    /// That of a place, with the body's x axis as roll axis.
    pub fn from_place(position: &Place) -> Self {
        let [roll, trim, heading] = position.turn;
        Attitude { origin: position.shift, roll, trim, heading, axis: 0.0 }
    }

    /// The pose of the body.
    pub fn pose(&self) -> Pose {
        let position = Place { shift: self.origin, turn: [self.roll, self.trim, self.heading + self.axis] };
        let mut pose = Pose::from_place(&position);
        if self.axis != 0.0 {
            let skew = Place { shift: [0.0; 3], turn: [0.0, 0.0, -self.axis] };
            pose.axes *= skew.rotation().matrix();
        }
        pose
    }

    /// The place of the body.
    pub fn position(&self) -> Place {
        let [x, y, z] = self.origin;
        let plain = Place::new([x, y, z, self.roll, self.trim, self.heading]);
        if self.axis == 0.0 { plain } else { self.pose().position(&plain) }
    }

    /// The roll axis, and the level axis across it about which the body trims (global).
    pub fn level_axes(&self) -> [Vector3<f64>; 2] {
        let (cos, sin) = windlass_base::geometry::unit_vector(self.heading + self.axis);
        [Vector3::new(cos, sin, 0.0), Vector3::new(-sin, cos, 0.0)]
    }

    /// The horizontal direction of the heading.
    pub fn ahead(&self) -> Vector2<f64> {
        let (cos, sin) = windlass_base::geometry::unit_vector(self.heading);
        Vector2::new(cos, sin)
    }
}

/// When a balance is found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalanceLimits {
    /// Most steps.
    pub most: usize,
    /// What may be left after these: a share of the weight, and the arms of roll and trim (m); none: the closing of the solution.
    pub left: Option<[f64; 3]>,
}

impl Default for BalanceLimits {
    fn default() -> Self {
        BalanceLimits { most: MAX_NEWTON_ITERATIONS, left: None }
    }
}

/// A body that is balanced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalancedBody {
    /// Where it stands.
    pub attitude: Attitude,
    /// The moment about the roll axis through the center of gravity that turns the body back from a positive roll, over the weight (m).
    pub arm: f64,
    /// What it weighs, contents of compartments included (N).
    pub weight: f64,
    /// Newton steps.
    pub steps: usize,
}

/// A body by itself in still water, or under a static wave.
#[derive(Debug)]
pub struct StillBody {
    floating: Floating,
    /// Its name.
    pub name: String,
    wave: Option<StaticWave>,
    /// Mean level of the water (m, global).
    level: f64,
    /// Weights beside its own: each with its center in the body (N, m).
    pub added_weights: Vec<(f64, Vector3<f64>)>,
    /// Multiplies its weight and that of its contents.
    pub weight_factor: f64,
}

/// Whether a category acts on a body in still water and air by itself.
fn is_still(category: Category) -> bool {
    matches!(category, Category::Weight | Category::Contents | Category::Buoyancy)
}

impl StillBody {
    /// That of a body of the model.
    ///
    /// # Errors
    /// Loads that contradict themselves; under a wave, buoyancy that is not that of a hull.
    pub fn new(model: &Model, body: &Body, wave: Option<StaticWave>) -> Result<Self, ClassError> {
        let floating = Floating::at_rest(model, body)?;
        let mut buoyant = floating.loads.iter().filter(|load| load.category() == Category::Buoyancy);
        if wave.is_some() && buoyant.any(|load| load.as_immersed().is_none()) {
            let text = format!(
                "{} has buoyancy that is not of its hull's pieces: none is computed for it under a static wave",
                body.name
            );
            return Err(ClassError::new(text).help(
                "-WAVE acts on pieces; #BUOY, #HYDROSTATIC, growth and junctions have a still surface: leave them out, or end the wave by -WAVE of no height",
            ));
        }
        Ok(StillBody {
            floating,
            name: body.name.clone(),
            wave,
            level: model.surroundings().tide,
            added_weights: Vec::new(),
            weight_factor: 1.0,
        })
    }

    /// Its mass with what is in its compartments.
    pub fn mass(&self) -> &windlass_model::Mass {
        &self.floating.mass
    }

    /// The loads on it, of all categories.
    pub fn loads(&self) -> impl Iterator<Item = &dyn BodyLoad> {
        self.floating.loads.iter().map(AsRef::as_ref)
    }

    /// The wave it is under.
    pub fn wave(&self) -> Option<&StaticWave> {
        self.wave.as_ref()
    }

    /// Mean level of the water (m, global).
    pub fn level(&self) -> f64 {
        self.level
    }

    /// How far its hull reaches along its heading, from its origin (m); none of a body without a hull.
    pub fn reach(&self, attitude: &Attitude) -> Option<[f64; 2]> {
        let (pose, ahead) = (attitude.pose(), attitude.ahead());
        let reaches = self.loads().filter_map(|load| Some(load.as_immersed()?.reach_along(&pose, &ahead)));
        let [low, high] = crate::buoyancy::join_reaches(reaches);
        (low <= high).then_some([low, high])
    }

    /// The surface of the water along it.
    ///
    /// # Errors
    /// A wave too short for the body.
    pub fn water(&self, attitude: &Attitude) -> Result<WaterSlabs, ClassError> {
        match (self.wave, self.reach(attitude)) {
            (Some(wave), Some(reach)) => wave.slabs(attitude.ahead(), reach, self.level),
            _ => Ok(WaterSlabs { ahead: attitude.ahead(), stations: vec![[0.0, self.level]] }),
        }
    }

    /// Height of the water at a point about its origin (m, global).
    pub fn water_at(&self, attitude: &Attitude, arm: &Vector3<f64>) -> f64 {
        let wave = self.wave.map_or(0.0, |wave| wave.elevation(attitude.ahead().dot(&arm.xy())));
        self.level + wave
    }

    /// What its hull, less flooded compartments, has below the water; empty of a body without a hull.
    ///
    /// # Errors
    /// As [`StillBody::water`].
    pub fn wet(&self, attitude: &Attitude) -> Result<SubmergedVolume, ClassError> {
        Ok(self.wet_and_skin(attitude)?.0)
    }

    /// The same, and the wetted area of the hull without that of compartments (m2).
    ///
    /// # Errors
    /// As [`StillBody::water`].
    pub fn wet_and_skin(&self, attitude: &Attitude) -> Result<(SubmergedVolume, f64), ClassError> {
        let (pose, water) = (attitude.pose(), self.wave.map(|_| self.water(attitude)).transpose()?);
        let (mut sum, mut skin) = (SubmergedVolume::default(), 0.0);
        for immersed in self.loads().filter_map(|load| load.as_immersed()) {
            let mut own = SubmergedVolume::default();
            match &water {
                None => own = immersed.wet(&pose),
                Some(water) => immersed.wet_slabs(&pose, water).iter().for_each(|wet| own.add(wet, 1.0)),
            }
            // under a wave the waterplane is a difference of areas: what rounding leaves of none is none
            if own.plane_area.abs() <= NO_WATERPLANE * own.wetted_area {
                (own.plane_area, own.plane_moment, own.plane_second) = (0.0, [0.0; 2], [0.0; 3]);
            }
            sum.add(&own, immersed.lift().signum());
            skin += if immersed.lift() > 0.0 { own.wetted_area } else { 0.0 };
        }
        Ok((sum, skin))
    }

    /// Weight, contents and buoyancy in an attitude, and the weight of it (N).
    ///
    /// The stiffness under a wave is that of its ordinates, without what its slope adds: it leads to the balance, and is no result.
    fn load(&self, attitude: &Attitude) -> Result<(Load, f64), ClassError> {
        let pose = attitude.pose();
        let water = self.wave.map(|_| self.water(attitude)).transpose()?;
        let (mut sum, mut weight) = (Load::none(), 0.0);
        for load in self.loads().filter(|load| is_still(load.category())) {
            let (mut made, heavy) = match (&water, load.as_immersed()) {
                (Some(water), Some(immersed)) => {
                    let mut wet = SubmergedVolume::default();
                    immersed.wet_slabs(&pose, water).iter().for_each(|slab| wet.add(slab, 1.0));
                    (wet.load(immersed.lift()), load.category() != Category::Buoyancy)
                }
                _ => (load.mean_load(&pose)?, load.category() != Category::Buoyancy),
            };
            if heavy {
                made.wrench *= self.weight_factor;
                made.stiffness *= self.weight_factor;
                weight -= made.wrench[2];
            }
            sum.wrench += made.wrench;
            sum.stiffness += made.stiffness;
        }
        for (added, centre) in &self.added_weights {
            let made = Load::constant(Vector3::new(0.0, 0.0, -added), pose.axes * centre);
            sum.wrench += made.wrench;
            sum.stiffness += made.stiffness;
            weight += added;
        }
        Ok((sum, weight))
    }

    /// The stiffness against heave and turns about the roll axis and across it (N/m, N, N m), and the weight (N), in an attitude.
    ///
    /// # Errors
    /// As [`StillBody::balance`].
    pub fn stiffness(&self, attitude: &Attitude) -> Result<(Matrix3<f64>, f64), ClassError> {
        let (load, weight) = self.load(attitude)?;
        let [along, across] = attitude.level_axes();
        Ok((reduce(&load, &along, [along, across]), weight))
    }

    /// The metacentric height about the roll axis in a balance, heave and trim following (m): the slope of the righting arm.
    ///
    /// # Errors
    /// A body that nothing holds in heave or trim.
    pub fn metacentric_height(&self, attitude: &Attitude) -> Result<f64, ClassError> {
        let (matrix, weight) = self.stiffness(attitude)?;
        let rest = nalgebra::Matrix2::new(matrix[(0, 0)], matrix[(0, 2)], matrix[(2, 0)], matrix[(2, 2)]);
        let coupled = Vector2::new(matrix[(0, 1)], matrix[(2, 1)]);
        let back = Vector2::new(matrix[(1, 0)], matrix[(1, 2)]);
        let follow = Lu::new(rest, &never)
            .and_then(|lu| lu.solve(&coupled))
            .map_err(|_| ClassError::new(format!("nothing holds {} in heave and trim", self.name)))?;
        Ok((matrix[(1, 1)] - back.dot(&follow)) / weight)
    }

    /// Balances degrees of freedom (heave, roll, trim) under weight and buoyancy, from an attitude; the others are held.
    ///
    /// Newton's iteration with steps that are limited in length and not searched: the balance is smooth, and without a waterplane the
    /// matrix is singular on the way.
    ///
    /// # Errors
    /// A body without weight, or for which no balance was found.
    pub fn balance(
        &self,
        from: &Attitude,
        free: [bool; 3],
        limits: &BalanceLimits,
    ) -> Result<BalancedBody, ClassError> {
        let mut at = *from;
        let [along, across] = at.level_axes();
        let centre = self.floating.mass.centre;
        let mut closed = false;
        // the last force without a waterplane, and the share of the usual step that is taken there
        let (mut afloat, mut reach) = (0.0, 1.0);
        for steps in 0..=limits.most {
            let pose = at.pose();
            let (total, weight) = self.load(&at)?;
            if weight <= 0.0 {
                return Err(ClassError::new("it has no weight"));
            }
            let arm = pose.axes * centre;
            let (force, turn) =
                (total.wrench.fixed_rows::<3>(0).into_owned(), total.wrench.fixed_rows::<3>(3).into_owned());
            let about = turn - arm.cross(&force);
            // the body rolls about its own axis, which trim tilts
            let tilt = Rotation3::from_axis_angle(&nalgebra::Unit::new_unchecked(across), at.trim);
            let mut matrix = reduce(&total, &(tilt * along), [along, across]);
            let size = (matrix[(2, 2)].abs() / weight).max(arm.norm());
            let left = [force.z, about.dot(&along), about.dot(&across)];
            let scale = [weight, weight * size, weight * size];
            let within = |tolerance: [f64; 3]| (0..3).all(|i| !free[i] || left[i].abs() <= tolerance[i] * scale[i]);
            let found = BalancedBody { attitude: at, arm: -about.dot(&along) / weight, weight, steps };
            if within([RESIDUAL_TOLERANCE; 3]) {
                return Ok(found);
            }
            if let Some([heave, roll, trim]) = limits.left {
                closed = within([heave, roll / size, trim / size]);
            }
            if steps == limits.most && closed {
                return Ok(found);
            }
            let mut right = Vector3::new(force.z, turn.dot(&along), turn.dot(&across));
            for i in (0..3).filter(|i| !free[*i]) {
                matrix.row_mut(i).fill(0.0);
                matrix.column_mut(i).fill(0.0);
                matrix[(i, i)] = scale[i];
                right[i] = 0.0;
            }
            let step = Lu::new(matrix, &never).and_then(|lu| lu.solve(&right));
            // without a waterplane nothing holds it: it rises or sinks by a tenth of what it is, by less where that went too far
            let step = step.unwrap_or_else(|_| {
                if afloat * force.z < 0.0 {
                    reach *= 0.5;
                }
                afloat = force.z;
                Vector3::new(0.1 * size * reach * force.z.signum(), 0.0, 0.0)
            });
            let cut =
                (MAX_ANGLE_CHANGE_RAD / step[1].abs().max(step[2].abs())).min(0.5 * size / step[0].abs()).min(1.0);
            at.origin[2] += cut * step[0];
            at.roll += cut * step[1];
            at.trim += cut * step[2];
        }
        let values = [(at.roll, Dim::Angle), (at.origin[2], Dim::Length), (at.trim, Dim::Angle)];
        Err(ClassError::with_values("no balance was found; the last try was at a roll of {}, z {}, trim {}", &values)
            .help("a body that displaces less than it weighs when it is under water does not float"))
    }
}

/// The stiffness of force upward and moments about two level axes, against heave, a turn about an axis, and one about the second of them.
fn reduce(load: &Load, roll: &Vector3<f64>, [along, across]: [Vector3<f64>; 2]) -> Matrix3<f64> {
    let stiffness = &load.stiffness;
    let columns = [
        stiffness.column(2).into_owned(),
        stiffness.fixed_columns::<3>(3) * roll,
        stiffness.fixed_columns::<3>(3) * across,
    ];
    let rows = columns.map(|c| {
        let turn = c.fixed_rows::<3>(3).into_owned();
        Vector3::new(c[2], turn.dot(&along), turn.dot(&across))
    });
    Matrix3::from_columns(&rows)
}
