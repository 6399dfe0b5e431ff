//! The loads of wind, current and waves on the parts of a body: those of records, and of wind and current on its pieces.

use super::area::AreaLoad;
use super::coefficients::CoefficientLoad;
use super::database::slow_drift::{DriftCoefficients, SlowDrift};
use super::drag::{LinearDrag, at_origin, rotate_matrix};
use super::drift::{self, DriftLoad, DriftRow};
use super::growth::Growth;
use super::heading::ByHeading;
use super::lump::{self, LumpSurroundings};
use super::plate::PlateLoad;
use super::roll_damping::RollDamping;
use super::sea::Sea;
use super::steady::{Medium, Steady};
use super::stream::{Immersion, LoadPlace};
use super::{
    BodyLoad, BodyStep, Category, DividedLoad, DynamicLoad, InertialLoad, Load, PreparedLoad, StatefulLoad, pieces,
    roll_damping,
};
use nalgebra::{Matrix3, Matrix6, Vector3};
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_model::{Attribute, Body, ClassError, Fluid, LoadKind, Model, Part, PartLoad, Piece};

/// What records have put on a body.
#[derive(Debug)]
pub struct BodyLoads {
    /// Its loads in the environment in force.
    pub loads: Vec<Box<dyn BodyLoad>>,
    /// Added mass about the origin of the body.
    pub added_mass: Matrix6<f64>,
    /// Damping about the origin of the body.
    pub damping: Matrix6<f64>,
}

/// Buoyancy at a point, `#BUOY`.
#[derive(Debug)]
struct PointBuoyancy {
    /// Upward force when it is all under water (N).
    force: f64,
    /// Its place in the body (m).
    at: Vector3<f64>,
    /// The height over which it comes under water (m).
    height: f64,
    /// Height of the water's surface (m, global).
    level: f64,
}

impl BodyLoad for PointBuoyancy {
    fn category(&self) -> Category {
        Category::Buoyancy
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let arm = pose.axes * self.at;
        let depth = self.level - pose.origin.z - arm.z;
        let share = if self.height > 0.0 { depth / self.height + 0.5 } else { f64::from(u8::from(depth >= 0.0)) };
        let wet = share.clamp(0.0, 1.0);
        let mut load = Load::constant(Vector3::new(0.0, 0.0, self.force * wet), arm);
        if self.height > 0.0 && share > 0.0 && share < 1.0 {
            // the force falls as the point rises by d_z + (turn x arm)_z
            let rise = Six::new(0.0, 0.0, 1.0, arm.y, -arm.x, 0.0);
            load.stiffness += rise * rise.transpose() * (self.force / self.height);
        }
        Ok(load)
    }
}

/// A constant force, `#FORCE`.
#[derive(Debug)]
struct ConstantForce {
    /// On the axes of space (N).
    force: Vector3<f64>,
    /// Its place in the body (m).
    at: Vector3<f64>,
}

impl BodyLoad for ConstantForce {
    fn category(&self) -> Category {
        Category::Applied
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        Ok(Load::constant(self.force, pose.axes * self.at))
    }
}

/// A load times its multiplier.
#[derive(Debug)]
struct ScaledLoad {
    load: Box<dyn BodyLoad>,
    factor: f64,
}

impl BodyLoad for ScaledLoad {
    fn category(&self) -> Category {
        self.load.category()
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let load = self.load.mean_load(pose)?;
        Ok(Load { wrench: load.wrench * self.factor, stiffness: load.stiffness * self.factor })
    }

    fn dynamic_load(&self, at: &BodyStep, state: &[f64]) -> Result<DynamicLoad, ClassError> {
        let DynamicLoad { load, damping } = self.load.dynamic_load(at, state)?;
        let load = Load { wrench: load.wrench * self.factor, stiffness: load.stiffness * self.factor };
        Ok(DynamicLoad { load, damping: damping * self.factor })
    }

    /// Its state is that of the load itself.
    fn as_stateful(&self) -> Option<&dyn StatefulLoad> {
        self.load.as_stateful()
    }

    fn as_prepared(&self) -> Option<&dyn PreparedLoad> {
        self.load.as_prepared().map(|_| self as _)
    }

    fn as_inertial(&self) -> Option<&dyn InertialLoad> {
        self.load.as_inertial().map(|_| self as _)
    }

    fn as_divided(&self) -> Option<&dyn DividedLoad> {
        self.load.as_divided().map(|_| self as _)
    }
}

impl PreparedLoad for ScaledLoad {
    fn prepared_wrench(&self, at: &BodyStep, state: &[f64]) -> Six {
        self.load.as_prepared().map_or_else(Six::zeros, |load| load.prepared_wrench(at, state) * self.factor)
    }
}

impl InertialLoad for ScaledLoad {
    fn inertia(&self, state: &[f64]) -> Matrix6<f64> {
        self.load.as_inertial().map_or_else(Matrix6::zeros, |load| load.inertia(state) * self.factor)
    }
}

impl DividedLoad for ScaledLoad {
    fn other_categories(&self) -> &'static [Category] {
        self.load.as_divided().map_or(&[], |load| load.other_categories())
    }

    fn part(&self, category: Category, at: &BodyStep, state: &[f64]) -> Six {
        self.load.as_divided().map_or_else(Six::zeros, |load| load.part(category, at, state) * self.factor)
    }
}

/// A load times its multiplier.
pub fn scale_load(load: Box<dyn BodyLoad>, factor: f64) -> Box<dyn BodyLoad> {
    Box::new(ScaledLoad { load, factor })
}

/// Where a part stands in its body.
struct PartAxes<'a> {
    part: &'a Part,
    axes: Matrix3<f64>,
    /// Height of the water's surface (m, global).
    level: f64,
}

impl PartAxes<'_> {
    fn point(&self, load: &PartLoad) -> Vector3<f64> {
        self.part.position.apply(load.at).into()
    }

    /// Sees that tables by heading make sense in the body.
    fn upright(&self, load: &PartLoad) -> Result<(), ClassError> {
        let [roll, pitch, _] = self.part.position.turn;
        if roll == 0.0 && pitch == 0.0 {
            return Ok(());
        }
        let text =
            format!("{} is a table by heading; its part may not be rolled or pitched in its body", load.kind.name());
        Err(ClassError::new(text).with_span(load.span))
    }

    /// Six values in the axes of the part, in those of the body.
    fn to_body_axes(&self, values: [f64; 6]) -> [f64; 6] {
        let [a, b, c, d, e, f] = values;
        let (force, moment) = (self.axes * Vector3::new(a, b, c), self.axes * Vector3::new(d, e, f));
        [force.x, force.y, force.z, moment.x, moment.y, moment.z]
    }
}

/// Gathers what is on a body. Under way, with the sea there is, it also holds what acts by the body's motion alone, and what varies in time.
///
/// # Errors
/// Loads that make no sense, or an environment that cannot be computed.
pub fn gather_loads(model: &Model, body: &Body, sea: Option<Option<&Arc<Sea>>>) -> Result<BodyLoads, ClassError> {
    let under_way = sea.is_some();
    let mut sum = BodyLoads { loads: Vec::new(), added_mass: Matrix6::zeros(), damping: Matrix6::zeros() };
    let drifts = |l: &PartLoad| matches!(l.kind, LoadKind::Drift { .. });
    let (growth, pose) = (Growth::from_environment(model, &model.environment)?, Pose::from_place(&body.position));
    let mut around: Option<Arc<Steady>> = None;
    for part in model.parts_of(body) {
        let mine: Vec<&PartLoad> =
            model.loads.iter().filter(|l| Model::key(&l.part) == Model::key(&part.name)).collect();
        let bare = |piece: &Piece| piece.cs_wind == [0.0; 3] && piece.cs_current == [0.0; 3];
        if mine.is_empty() && part.pieces.iter().all(|piece| bare(piece) && piece.eddy_damping == 0.0) {
            continue;
        }
        let steady = match &around {
            Some(known) => Arc::clone(known),
            None => {
                // a spectrum that cannot be computed matters only where waves push; under way the sea itself does
                let pushed = !under_way && model.loads.iter().any(drifts);
                let mean = if pushed { Steady::new(model)? } else { Steady::streams(model, &model.environment)? };
                Arc::new(if under_way { mean.under_way(model, &model.environment)? } else { mean })
            }
        };
        around = Some(Arc::clone(&steady));
        let frame = PartAxes { part, axes: *part.position.rotation().matrix(), level: model.surroundings().tide };
        for load in &mine {
            let (before, mass, damping) = (sum.loads.len(), sum.added_mass, sum.damping);
            add_part_load(&mut sum, (model, body), &steady, (&frame, load), sea)?;
            let factor = |attribute| model.load_factor(&part.name, load.group.as_deref(), &load.category, attribute);
            sum.added_mass = mass + (sum.added_mass - mass) * factor(Attribute::AddedMass);
            sum.damping = damping + (sum.damping - damping) * factor(Attribute::Drag);
            let made = sum.loads.split_off(before);
            sum.loads.extend(made.into_iter().map(|made| {
                let of_attribute = match made.category() {
                    // of &APPLY the load groups alone
                    Category::Applied => model.multipliers.group(load.group.as_deref().unwrap_or(&part.name)),
                    Category::Wind => factor(Attribute::Wind),
                    Category::Buoyancy => factor(Attribute::Buoyancy),
                    Category::Wave => factor(Attribute::AddedMass),
                    _ => factor(Attribute::Drag),
                };
                let [wind, drag] = load.shape_coefficients;
                let shape = match made.category() {
                    Category::Wind => wind,
                    Category::ViscousDrag => drag,
                    _ => 1.0,
                };
                let force = model.multipliers.categories.get(made.category().name()).unwrap_or(&1.0);
                let whole = shape * of_attribute * force;
                if whole == 1.0 { made } else { scale_load(made, whole) }
            }));
        }
        let first = sum.loads.len();
        drift(&mut sum, (&steady, sea), &frame, &mine)?;
        if under_way {
            let mass = super::tank::laden_mass(model, body)?;
            for load in &mine {
                let LoadKind::EddyDamping(factor) = load.kind else { continue };
                let factor =
                    factor * model.load_factor(&part.name, load.group.as_deref(), &load.category, Attribute::Drag);
                let made = roll_damping::build(model, (body, &mass), part, part.pieces.iter(), factor)?;
                sum.loads.extend(made.map(|load| Box::new(load) as Box<dyn BodyLoad>));
            }
            for piece in part.pieces.iter().filter(|p| p.eddy_damping != 0.0) {
                let one = std::iter::once(piece);
                let made = roll_damping::build(model, (body, &mass), part, one, piece.eddy_damping)?;
                sum.loads.extend(made.map(|load| Box::new(load) as Box<dyn BodyLoad>));
            }
        }
        let on = growth.as_ref().map(|growth| (growth, &pose));
        for piece in &part.pieces {
            for load in pieces::build_piece_load(&steady, part, piece, under_way, on)? {
                let attribute = if load.category() == Category::Wind { Attribute::Wind } else { Attribute::Drag };
                let factor = model.member_category_factor(piece, attribute);
                let load: Box<dyn BodyLoad> = Box::new(load);
                sum.loads.push(if factor == 1.0 { load } else { scale_load(load, factor) });
            }
        }
        let rest = sum.loads.split_off(first);
        sum.loads.extend(rest.into_iter().map(|load| {
            let factor = model.multipliers.factor(load.category().name(), &part.name);
            if factor == 1.0 { load } else { Box::new(ScaledLoad { load, factor }) }
        }));
    }
    Ok(sum)
}

/// Adds one record but those of drift, of which several make one table.
fn add_part_load(
    sum: &mut BodyLoads,
    (model, body): (&Model, &Body),
    steady: &Arc<Steady>,
    (frame, load): (&PartAxes, &PartLoad),
    sea: Option<Option<&Arc<Sea>>>,
) -> Result<(), ClassError> {
    let under_way = sea.is_some();
    let at = frame.point(load);
    match &load.kind {
        LoadKind::Drag(matrix) => {
            sum.damping += at_origin(matrix, &frame.axes, at);
            if !steady.is_still(Medium::Water) {
                let made = LinearDrag::new(Arc::clone(steady), at, &rotate_matrix(matrix, &frame.axes));
                sum.loads.push(Box::new(made));
            }
        }
        LoadKind::Damping(matrix) => sum.damping += at_origin(matrix, &frame.axes, at),
        LoadKind::RollDamping(given) => {
            let axis = frame.axes.column(0).into_owned();
            let critical = if given.critical > 0.0 && under_way {
                given.critical
                    * roll_damping::critical_damping(model, body, axis).map_err(|e| e.with_span(load.span))?
            } else {
                0.0
            };
            let mut block = sum.damping.fixed_view_mut::<3, 3>(3, 3);
            block += axis * axis.transpose() * (given.linear + critical);
            if given.quadratic > 0.0 && under_way {
                sum.loads.push(Box::new(RollDamping { axis, coefficient: given.quadratic }));
            }
        }
        LoadKind::AddedMass(matrix) => sum.added_mass += at_origin(matrix, &frame.axes, at),
        LoadKind::Drift { .. } | LoadKind::EddyDamping(_) => {}
        LoadKind::Buoyancy { force, size } => {
            sum.loads.push(Box::new(PointBuoyancy { force: *force, at, height: size[2], level: frame.level }));
        }
        LoadKind::Lump(given) => {
            let matrix = lump::added_mass(given, steady.around.water_density);
            sum.added_mass += at_origin(&matrix, &frame.axes, at);
            let around = LumpSurroundings { steady, sea: sea.flatten(), is_under_way: under_way };
            sum.loads.extend(lump::build_lump_loads(given, (at, frame.axes), &around));
        }
        LoadKind::Force(force) => sum.loads.push(Box::new(ConstantForce { force: Vector3::from(*force), at })),
        _ => {
            let media: &[Medium] = match load.fluid {
                Fluid::ByHeight => &[Medium::Air, Medium::Water],
                Fluid::Air => &[Medium::Air],
                Fluid::Water => &[Medium::Water],
            };
            for medium in media.iter().copied().filter(|m| under_way || !steady.is_still(*m)) {
                let by_height = load.fluid == Fluid::ByHeight;
                let immersion = if by_height { Immersion::Passage } else { Immersion::Whole };
                let position = LoadPlace { at, medium, immersion };
                sum.loads.push(in_stream(Arc::clone(steady), frame, position, load)?);
            }
        }
    }
    Ok(())
}

/// The load that a stream makes of a record.
fn in_stream(
    steady: Arc<Steady>,
    frame: &PartAxes,
    position: LoadPlace,
    load: &PartLoad,
) -> Result<Box<dyn BodyLoad>, ClassError> {
    Ok(match &load.kind {
        LoadKind::Area(areas) => Box::new(AreaLoad::new(steady, position, *areas).rotated_to_axes(frame.axes)),
        LoadKind::Plate { area, normal } => {
            Box::new(PlateLoad::new(steady, position, *area, frame.axes * Vector3::from(*normal)))
        }
        LoadKind::Coefficients { rows, symmetric } => {
            frame.upright(load)?;
            let table = by_heading(frame, rows, *symmetric).map_err(|e| e.with_span(load.span))?;
            Box::new(CoefficientLoad::new(steady, position, table))
        }
        _ => return Err(ClassError::new(format!("{} is no load of a stream", load.kind.name())).with_span(load.span)),
    })
}

/// A table of a part as one of its body. The mirror of a symmetric one is that of the part.
fn by_heading(frame: &PartAxes, rows: &[(f64, [f64; 6])], symmetric: bool) -> Result<ByHeading, ClassError> {
    let table = ByHeading::new(rows, symmetric)?;
    let [_, _, yaw] = frame.part.position.turn;
    Ok(if yaw == 0.0 { table } else { table.rotate(yaw, |six| frame.to_body_axes(six.into()).into()) })
}

/// Adds the drift, one table for each point that has records of it: at rest the mean of every sea, under way the slow drift of the sea
/// there is.
fn drift(
    sum: &mut BodyLoads,
    (steady, sea): (&Arc<Steady>, Option<Option<&Arc<Sea>>>),
    frame: &PartAxes,
    mine: &[&PartLoad],
) -> Result<(), ClassError> {
    let mut tables: Vec<(&PartLoad, Vec<DriftRow>, bool)> = Vec::new();
    for load in mine {
        let LoadKind::Drift { heading, rows, symmetric } = &load.kind else { continue };
        match tables.iter_mut().find(|(first, ..)| first.at == load.at) {
            Some((_, table, mirrored)) => {
                table.push((*heading, rows.clone()));
                *mirrored |= symmetric;
            }
            None => tables.push((load, vec![(*heading, rows.clone())], *symmetric)),
        }
    }
    for (load, table, symmetric) in tables {
        frame.upright(load)?;
        let [_, _, yaw] = frame.part.position.turn;
        let turn = |six: Six| frame.to_body_axes(six.into()).into();
        let here = |error: ClassError| error.with_span(load.span);
        if let Some(sea) = sea {
            if let Some(sea) = sea {
                let made = drift::table(sea, &table, symmetric, (yaw, turn)).map_err(here)?;
                let made = DriftCoefficients { table: &made, reference: frame.point(load), by_velocity: None };
                sum.loads.push(Box::new(SlowDrift::newman(made, sea).map_err(here)?));
            }
            continue;
        }
        for (toward, waves) in &steady.waves {
            let made = DriftLoad::new(Arc::clone(steady), frame.point(load), (*toward, waves), &table, symmetric);
            let made = made.map_err(here)?;
            sum.loads.push(Box::new(if yaw == 0.0 { made } else { made.rotate(yaw, turn) }));
        }
    }
    Ok(())
}
