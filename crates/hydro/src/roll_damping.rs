//! Damping of roll: `#ROLL_DAMPING`, and that by eddies, `#TANAKA` and `-TANAKA` of pieces.
//!
//! Source: [IKEDA-1993], the eddy component of a sharp-cornered barge of length L, breadth B and draft d that rolls with the amplitude
//! phi and the frequency w about an axis OG below the waterline:
//! `B_E = (2/pi) rho L d^4 (H0^2 + 1 - OG/d) (H0^2 + (1 - OG/d)^2) phi w` with `H0 = B/(2 d)`. It is the equivalent of the quadratic
//! moment `-b |p| p` of a rate of roll p with `B_E = 8/(3 pi) b phi w`, so that `b = 3/4 rho L d^4 (..) (..)`; that moment acts here, times
//! the factor of the record. MOSES names Tanaka's formula, whose coefficients stand in no source at hand; the choice is ours.

use super::database::DatabaseLookup;
use super::{BodyLoad, BodyStep, Category, DynamicLoad, Load, move_stiffness};
use nalgebra::{RowVector3, Vector3};
use windlass_base::pose::{Pose, Six};
use windlass_model::{Body, ClassError, LoadKind, Mass, Model, Part, Piece};

/// A quadratic moment against the roll of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollDamping {
    /// The axis of roll in the body.
    pub axis: Vector3<f64>,
    /// Moment over the square of the rate (N m s2).
    pub coefficient: f64,
}

/// What the formula is asked for: a hull as a barge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BargeSection {
    /// Length (m).
    pub length: f64,
    /// Breadth (m).
    pub breadth: f64,
    /// Draft (m).
    pub draft: f64,
    /// Depth of the axis of roll below the waterline (m).
    pub axis_depth: f64,
}

/// The moment over the square of the rate of roll in water of a density (N m s2).
pub fn eddy_coefficient(hull: &BargeSection, density: f64) -> f64 {
    let BargeSection { length, breadth, draft, axis_depth } = *hull;
    let h0 = breadth / (2.0 * draft);
    let below = 1.0 - axis_depth / draft;
    0.75 * density * length * draft.powi(4) * (h0 * h0 + below) * (h0 * h0 + below * below)
}

/// The damping of pieces of a body where it stands, by the box around them; none where they are dry.
///
/// # Errors
/// A part that is turned in its body.
pub(super) fn build<'a>(
    model: &Model,
    (body, mass): (&Body, &Mass),
    part: &Part,
    pieces: impl Iterator<Item = &'a Piece>,
    factor: f64,
) -> Result<Option<RollDamping>, ClassError> {
    if part.position.turn != [0.0; 3] {
        return Err(ClassError::new(format!(
            "the eddy damping of roll of {} needs a part that is not turned in its body",
            part.name
        ))
        .with_span(part.span));
    }
    let none = [Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY)];
    let hull = pieces.filter(|p| p.permeability > 0.0 && p.compartment.is_none());
    let boxes = hull.filter_map(|p| p.shape.with_displacement(&part.position).extent());
    let [low, high] = boxes.fold(none, |[low, high], [a, b]| [low.inf(&Vector3::from(a)), high.sup(&Vector3::from(b))]);
    let surface = model.surroundings().tide - body.position.shift[2];
    let draft = surface - low.z;
    let size = high - low;
    let is_wet = draft > 0.0 && size.iter().all(|x| x.is_finite() && *x > 0.0);
    let section =
        BargeSection { length: size.x, breadth: size.y, draft: draft.min(size.z), axis_depth: surface - mass.centre.z };
    Ok(is_wet.then(|| RollDamping {
        axis: Vector3::x(),
        coefficient: factor * eddy_coefficient(&section, model.surroundings().water_density),
    }))
}

/// Times the frequency of roll is found with added mass at it.
const MAX_ITERATIONS: usize = 100;
/// Change of a frequency, as its share, that is none.
const FREQUENCY_TOLERANCE: f64 = 1e-12;

/// The critical damping of the roll of a body about an axis of it, `2 sqrt((I + A) C)` (N m s): inertia, added mass at the natural frequency and
/// hydrostatic stiffness of the body where it stands, about its centre of gravity, without connectors and without other motions.
///
/// # Errors
/// A roll that nothing rights; loads that make no sense.
pub fn critical_damping(model: &Model, body: &Body, axis: Vector3<f64>) -> Result<f64, ClassError> {
    let pose = Pose::from_place(&body.position);
    let gravity = model.defaults.gravity;
    let mass = super::tank::laden_mass(model, body)?;
    let mut loads: Vec<Box<dyn BodyLoad>> = Vec::new();
    loads.extend(super::weight::build_weight(&Mass::from_parts(model.parts_of(body), gravity), gravity));
    loads.extend(super::tank::build_tank_loads(model, body)?);
    loads.extend(super::Hull::new(model, body)?.map(|hull| Box::new(hull) as Box<dyn BodyLoad>));
    loads.extend(super::linear::build_linear_buoyancy(body));
    let gathered = super::body_loads::gather_loads(model, body, None)?;
    loads.extend(gathered.loads.into_iter().filter(|load| load.category() == Category::Buoyancy));
    if let Some(attached) = body.database.as_ref().filter(|attached| attached.hydrostatics) {
        loads.push(super::database::attached::hydrostatics_load(model, body, attached)?);
    }
    let mut all = Load::none();
    for load in &loads {
        let made = load.mean_load(&pose)?;
        all = Load { wrench: all.wrench + made.wrench, stiffness: all.stiffness + made.stiffness };
    }
    let about_centre = all.about_point(pose.axes * mass.centre).stiffness;
    let turned = pose.axes * axis;
    let stiffness = turned.dot(&(about_centre.fixed_view::<3, 3>(3, 3) * turned));
    if stiffness <= 0.0 {
        let text = format!("nothing rights the roll of {} where it stands: it has no critical damping", body.name);
        return Err(ClassError::new(text).help("-LINEAR gives the damping itself"));
    }
    let inertia = axis.dot(&(mass.inertia * axis)) - mass.mass * axis.cross(&mass.centre).norm_squared();
    let given = gathered.added_mass + super::growth_loads::build_growth_loads(model, body)?.mass;
    let with_added = |frequency: f64| {
        let of_database = body.database.as_ref().and_then(|attached| attached.data.added_mass_at(frequency));
        let about_origin = given + of_database.unwrap_or_default();
        let about_centre = move_stiffness(&about_origin, -mass.centre, -mass.centre);
        inertia + axis.dot(&(about_centre.fixed_view::<3, 3>(3, 3) * axis))
    };
    let mut frequency = (stiffness / inertia).sqrt();
    for _ in 0..MAX_ITERATIONS {
        let next = (stiffness / with_added(frequency)).sqrt();
        let is_same = (next - frequency).abs() <= FREQUENCY_TOLERANCE * next;
        frequency = next;
        if is_same {
            break;
        }
    }
    let critical = 2.0 * (with_added(frequency) * stiffness).sqrt();
    if critical.is_finite() && critical > 0.0 {
        return Ok(critical);
    }
    Err(ClassError::new(format!("the roll of {} has no inertia: it has no critical damping", body.name)))
}

/// Damping of roll that is given in per cent of the critical one, as the linear damping that it is now, for all bodies of a model.
///
/// # Errors
/// As of [`critical_damping`].
pub fn fix_critical_damping(model: &mut Model) -> Result<(), ClassError> {
    let mut made = Vec::new();
    for (index, load) in model.loads.iter().enumerate() {
        let LoadKind::RollDamping(given) = load.kind else { continue };
        let part = model.parts.get(&Model::key(&load.part));
        let body = part.and_then(|part| Some((part, model.bodies.get(&Model::key(&part.body))?)));
        if let Some((part, body)) = body.filter(|_| given.critical > 0.0) {
            let axis = part.position.rotation().matrix().column(0).into_owned();
            let whole = critical_damping(model, body, axis).map_err(|error| error.with_span(load.span))?;
            made.push((index, given.linear + given.critical * whole));
        }
    }
    for (index, linear) in made {
        if let Some(load) = model.loads.get_mut(index)
            && let LoadKind::RollDamping(given) = &mut load.kind
        {
            (given.linear, given.critical) = (linear, 0.0);
        }
    }
    Ok(())
}

impl BodyLoad for RollDamping {
    fn category(&self) -> Category {
        Category::ViscousDrag
    }

    fn mean_load(&self, _: &Pose) -> Result<Load, ClassError> {
        Ok(Load::none())
    }

    fn dynamic_load(&self, at: &BodyStep, _state: &[f64]) -> Result<DynamicLoad, ClassError> {
        let axis = at.pose.axes * self.axis;
        let spin = at.velocity.fixed_rows::<3>(3).into_owned();
        let rate = axis.dot(&spin);
        let moment = -self.coefficient * rate.abs() * rate;
        let by_rate = 2.0 * self.coefficient * rate.abs();
        let mut made = DynamicLoad::default();
        let turned = axis * moment;
        made.load.wrench = Six::new(0.0, 0.0, 0.0, turned.x, turned.y, turned.z);
        // the axis turns with the body: d(axis) = turn x axis
        let by_turn =
            axis * RowVector3::from_row_slice((axis.cross(&spin) * by_rate).as_slice()) + axis.cross_matrix() * moment;
        made.load.stiffness.fixed_view_mut::<3, 3>(3, 3).copy_from(&by_turn);
        made.damping.fixed_view_mut::<3, 3>(3, 3).copy_from(&(axis * axis.transpose() * by_rate));
        Ok(made)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use windlass_base::geometry::Place;

    /// The published formula for the case below, evaluated in Python (N m s).
    const PUBLISHED: f64 = 223845242.8561198;

    #[test]
    fn moment_is_equivalent_to_published_linear_damping() {
        // L 91.5, B 27.5, d 2.32634 m, OG -2.67366 m, rho 1025: (2/pi) rho L d^4 (H0^2+1-OG/d)(H0^2+(1-OG/d)^2) phi w by hand,
        // phi = 5 degrees, w = 1 rad/s
        let hull = BargeSection { length: 91.5, breadth: 27.5, draft: 2.32634, axis_depth: -2.67366 };
        let (amplitude, frequency) = (5f64.to_radians(), 1.0);
        let equivalent = 8.0 / (3.0 * std::f64::consts::PI) * eddy_coefficient(&hull, 1025.0) * amplitude * frequency;
        assert!((equivalent / PUBLISHED - 1.0).abs() < 1e-9, "{equivalent:e}");
        // the work of the moment over a period of harmonic roll is that of the linear damping: pi B w phi^2
        let load = RollDamping { axis: Vector3::x(), coefficient: eddy_coefficient(&hull, 1025.0) };
        let steps = 4000;
        let mut work = 0.0;
        for n in 0..steps {
            let phase = std::f64::consts::TAU * (f64::from(n) + 0.5) / f64::from(steps);
            let rate = amplitude * frequency * phase.cos();
            let velocity = Six::new(0.0, 0.0, 0.0, rate, 0.0, 0.0);
            let at = BodyStep { time: 0.0, dt: 0.1, pose: &Pose::default(), velocity: &velocity };
            work -= load.dynamic_load(&at, &[]).unwrap().load.wrench[3] * rate;
        }
        work *= std::f64::consts::TAU / frequency / f64::from(steps);
        let linear = std::f64::consts::PI * PUBLISHED * frequency * amplitude * amplitude;
        assert!((work / linear - 1.0).abs() < 1e-6, "{work:e} {linear:e}");
    }

    #[test]
    fn tangent_of_moment_is_its_difference() {
        let load = RollDamping { axis: Vector3::x(), coefficient: 3.0 };
        let pose = Pose::from_place(&Place::new([1.0, 2.0, 3.0, 0.3, -0.2, 0.5]));
        let velocity = Six::new(0.1, 0.2, -0.3, 0.4, -0.7, 0.2);
        let of = |pose: &Pose, velocity: &Six| {
            load.dynamic_load(&BodyStep { time: 0.0, dt: 0.1, pose, velocity }, &[]).unwrap()
        };
        let made = of(&pose, &velocity);
        let step = 1e-6;
        for column in 0..3 {
            let mut axis = Vector3::zeros();
            axis[column] = step;
            let turned = |sign: f64| {
                let turn = nalgebra::Rotation3::from_scaled_axis(axis * sign);
                of(&Pose { axes: turn.matrix() * pose.axes, ..pose }, &velocity).load.wrench
            };
            let mut faster = [velocity, velocity];
            faster[0][3 + column] -= step;
            faster[1][3 + column] += step;
            let by_turn = (turned(-1.0) - turned(1.0)) / (2.0 * step);
            let by_rate = (of(&pose, &faster[0]).load.wrench - of(&pose, &faster[1]).load.wrench) / (2.0 * step);
            assert!((made.load.stiffness.column(3 + column) - by_turn).amax() < 1e-8, "turn {column}");
            assert!((made.damping.column(3 + column) - by_rate).amax() < 1e-8, "rate {column}");
        }
    }
}
