//! Round members in waves and current, by Morison's formula ([MORISON-1950]; in the form of relative
//! velocity of [DNV-RP-C205 6.2.3]).
//!
//! Of a length of a member, with A = pi D^2/4, u and a the velocity and acceleration of the water without the member on its axis,
//! v and b those of the member, and n and t their parts across and along the axis:
//! - drag: `1/2 rho Cd D |u - v|_n (u - v)_n` and `1/2 rho Cdt pi D |u - v|_t (u - v)_t`; current adds to u;
//! - pressure of the undisturbed waves: the hydrostatic pressure up to the surface where it is at the time, and of the dynamic
//!   pressure p `rho A a_n` across and the difference of `A p` of the ends along the axis. At the surface the dynamic pressure
//!   is what makes the whole pressure zero, so that an upright member bears on it with `A p` of its foot alone;
//! - added mass: `rho Ca A (a - b)_n`, and `rho Caa pi D^3/12 (a - b)_t` at each wet end, with a Caa of its own.
//!
//! A bar has a drag and an added mass of its own along its width and along its depth: with e of the one and the other,
//! `1/2 rho Cd b_e |u - v|_n ((u - v).e) e`, b_e its breadth against a flow along e, and `rho A_e ((a - b).e) e`. At the surface its
//! sections are wet as those of a tube of the same area. Growth on bars is refused.
//!
//! Where the surface cuts sections, drag and friction act on the share of a section's height that is wet, inertia on the share of
//! its area, in water of the middle of what is wet. The acceleration of the water is that at a place; what the water brings along
//! (u . grad u), the slap on sections that enter the water (category SLAM), and drag of flat ends are left out.
//!
//! The body's part of the added mass under the mean level, where the body was when the load was made, is part of its inertia. What the
//! surface and the motion take or give, `A(t) - A` with A(t) of the place expected at the end of the step, is inertia of the step: it acts
//! on the acceleration at the end of the step, so that a run is of the order of its scheme; on the difference of velocities over the step
//! it would be late by half a step. A member whose wet length changes so does no work of its own: the formula has `A(t) b` and not
//! `d(A v)/dt`, whose rest is slamming.
//!
//! Water is asked for once a step, at four Gauss points of each segment (and four more where its sections are cut, or the profile
//! of the current has a point), at the place
//! expected at the step's end. Drag takes the velocity of every trial, hydrostatics its place, both with their exact change.
//!
//! Growth widens D in drag, in inertia and in what waves press on, by the elevations at which the body stands when its loads are made: a
//! member is taken as lengths of one diameter each. The growth's own mass and weight, and its buoyancy under the mean level, are
//! [`growth_loads`]'s. A current with a history drags as it is at the time; how fast it changes is not counted as an acceleration.

mod added;
mod member;
mod member_wave_loads;

use super::growth::Growth;
use super::growth_loads;
use super::hull::TubeHull;
use super::low_frequency::{SlowWrench, dividing_period};
use super::sea::Sea;
use super::steady::{Medium, Steady};
use super::{BodyLoad, BodyStep, Category, DividedLoad, DynamicLoad, InertialLoad, Load, StatefulLoad};
use member::MemberLength;
use member_wave_loads::MemberWaveLoads;
use nalgebra::{Matrix6, Vector3};
use std::f64::consts::PI;
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_model::{Attribute, Body, ClassError, Model, Part, Piece, Shape, WaveAction};

/// Most segments of a member.
const MAX_SEGMENTS: usize = 64;
/// Length of a segment times the mean wave number of the sea. Over it exp(kz) is integrated by four points within 3e-7 of itself.
const MAX_SEGMENT_KL: f64 = 2.0;
/// Where growth tapers: how much of the bare diameter one length differs from the next, and the most lengths. The mean of squares over
/// a length is then within 0.02^2/12 of the square of the mean.
const MAX_TAPER_STEP: f64 = 0.02;
const MAX_TAPER_LENGTHS: f64 = 64.0;

/// The members of a body, and what acts on them.
#[derive(Debug)]
pub struct Members {
    rods: Vec<MemberLength>,
    steady: Arc<Steady>,
    /// Heights at which the current begins to change otherwise (m, global), highest first.
    kinks: Vec<f64>,
    under_way: Option<MemberWaveLoads>,
    slow: SlowWrench,
}

/// The members of a body: their load, where there is any, and their added mass about its origin (kg, kg m, kg m2; body axes) under the mean
/// level where
/// the body stands. `under_way` is `None` of a body at rest, else with the sea there is.
///
/// # Errors
/// An environment that cannot be computed.
pub fn build_members(
    model: &Model,
    body: &Body,
    under_way: Option<Option<&Arc<Sea>>>,
) -> Result<(Option<Members>, Matrix6<f64>), ClassError> {
    let there = |piece: &Piece| piece.member.is_some();
    if !model.parts_of(body).any(|part| part.pieces.iter().any(there)) {
        return Ok((None, Matrix6::zeros()));
    }
    let mean = Steady::streams(model, &model.environment)?;
    let steady = Arc::new(if under_way.is_some() { mean.under_way(model, &model.environment)? } else { mean });
    let sea = under_way.flatten();
    let reach = MAX_SEGMENT_KL / sea.map_or(0.0, |sea| mean_number(sea));
    let (growth, pose) = (Growth::from_environment(model, &model.environment)?, Pose::from_place(&body.position));
    let mut made = Vec::new();
    for part in model.parts_of(body) {
        for piece in &part.pieces {
            if growth.is_some() && piece.member.is_some_and(|member| member.breadths.is_some()) {
                let text = format!("marine growth on the bar {} is not computed: growth is for tubes", piece.name);
                return Err(ClassError::new(text).with_span(piece.span).help("leave -M_GROWTH out of the environment"));
            }
            let on = growth.as_ref().filter(|_| piece.permeability >= 0.0).map(|growth| (growth, &pose));
            made.extend(rods(model, &steady, (part, piece), reach, on));
        }
    }
    let rods = made;
    let added = added::at_rest(&rods, &pose, steady.around.tide);
    let dragged = rods.iter().any(MemberLength::drags) && !steady.is_still(Medium::Water);
    let acts = !rods.is_empty() && (under_way.is_some() || dragged);
    let load = acts.then(|| {
        let kinks = kinks(&steady);
        let under_way = under_way.map(|sea| MemberWaveLoads::new(sea.cloned(), (&rods, &kinks), &steady, &added));
        let slow = SlowWrench::new(dividing_period(model, sea.map(|sea| sea.as_ref())));
        Members { rods, steady, kinks, under_way, slow }
    });
    Ok((load, added))
}

/// The mean wave number of a sea, by energy (1/m).
pub(super) fn mean_number(sea: &Sea) -> f64 {
    let energy = |c: &super::sea::Component| c.amplitude * c.amplitude;
    let all: f64 = sea.components.iter().map(energy).sum();
    let numbers: f64 = sea.components.iter().map(|c| energy(c) * c.number).sum();
    if all > 0.0 { numbers / all } else { 0.0 }
}

/// Heights at which the current begins to change otherwise (m, global), highest first: there the integrals are divided.
fn kinks(steady: &Steady) -> Vec<f64> {
    let mut depths = steady.current.kinks();
    depths.retain(|d| *d >= 0.0 && d.is_finite());
    depths.push(0.0);
    depths.sort_by(f64::total_cmp);
    depths.dedup();
    // one that is the same at every depth has none
    if depths.len() == 1 { Vec::new() } else { depths.iter().map(|d| steady.around.tide - d).collect() }
}

/// A tube as members, one for each length of one diameter; none of what has no force of Morison's formula.
fn rods(
    model: &Model,
    steady: &Steady,
    (part, piece): (&Part, &Piece),
    reach: f64,
    growth: Option<(&Growth, &Pose)>,
) -> Vec<MemberLength> {
    let Some(own) = piece.member else { return Vec::new() };
    let (ends, bare, width) = match piece.shape.with_displacement(&part.position) {
        Shape::Tube { ends, diameter } => (ends.map(Vector3::from), diameter, None),
        Shape::Bar { ends, sides } => {
            let [width, depth] = sides.map(Vector3::from);
            // a tube of the same area stands for it where the surface cuts it
            let diameter = (4.0 / PI * width.norm() * depth.norm()).sqrt();
            (ends.map(Vector3::from), diameter, width.try_normalize(0.0))
        }
        Shape::Panels(_) | Shape::Block { .. } => return Vec::new(),
    };
    let [foot, head] = ends;
    let Some(axis) = (head - foot).try_normalize(0.0) else { return Vec::new() };
    let mut beside = Vector3::zeros();
    beside[axis.iamin()] = 1.0;
    let Some(across) = width.or_else(|| axis.cross(&beside).try_normalize(0.0)) else { return Vec::new() };
    let density = steady.around.water_density;
    let of = |attribute| model.member_factor(&part.name, piece, attribute);
    let force = |category: Category| model.multipliers.categories.get(category.name()).copied().unwrap_or(1.0);
    let (buoyant, moving) = (of(Attribute::Buoyancy), of(Attribute::AddedMass));
    // what a database holds is not counted again
    let own_waves = if piece.waves == WaveAction::Database { 0.0 } else { 1.0 };
    let lengths = growth.map_or_else(
        || vec![TubePart { ends: [0.0, 1.0], diameter: bare }],
        |(growth, pose)| lengths(&growth_loads::stations(growth, pose, ends, bare), bare),
    );
    let last = lengths.len().saturating_sub(1);
    let made = lengths.iter().enumerate().map(|(n, TubePart { ends: [start, end], diameter })| {
        let [from, to] = [*start, *end].map(|at| foot + (head - foot) * at);
        let length = (to - from).norm();
        let (section, core) = (section_area(*diameter), section_area(bare));
        let drags = 0.5 * density * of(Attribute::Drag) * force(Category::ViscousDrag);
        let breadths = own.breadths.map_or([*diameter; 2], |bar| bar.drag);
        let moved = own.breadths.map_or([section_area(*diameter) * own.added; 2], |bar| bar.added);
        let skin = own.breadths.map_or(PI * diameter, |bar| 2.0 * (bar.drag[0] + bar.drag[1]));
        let count = (length / reach).ceil().clamp(1.0, MAX_SEGMENTS as f64) as usize;
        let corner = |n: usize| from + axis * (length * n as f64 / count as f64);
        let half_sphere = density * PI * diameter.powi(3) / 12.0 * own_waves * moving;
        let [first, second] = own.end_added.map(|caa| half_sphere * caa);
        MemberLength {
            from,
            axis,
            first: across,
            length,
            diameter: *diameter,
            across: breadths.map(|breadth| drags * own.drag * breadth),
            along: drags * skin * own.friction,
            section: (core * piece.permeability * buoyant + (section - core)) * own_waves,
            added: moved.map(|area| density * area * own_waves * moving),
            end_added: [if n == 0 { first } else { 0.0 }, if n == last { second } else { 0.0 }],
            factor: force(Category::Wave),
            segments: (0..count).map(|n| TubeHull { ends: [corner(n), corner(n + 1)], diameter: *diameter }).collect(),
        }
    });
    made.collect()
}

/// A length of a tube with one diameter.
struct TubePart {
    /// Where it begins and ends, from 0 at the foot of the tube to 1 at its head.
    ends: [f64; 2],
    /// Its outer diameter, growth with it (m).
    diameter: f64,
}

/// The area of a circle of a diameter (m).
fn section_area(diameter: f64) -> f64 {
    PI * diameter * diameter / 4.0
}

/// The lengths of a tube of a bare diameter (m) with growth on it, by stations between which its diameter is straight.
fn lengths(stations: &[(f64, f64)], bare: f64) -> Vec<TubePart> {
    let mut made: Vec<TubePart> = Vec::new();
    for pair in stations.windows(2) {
        let [(from, first), (to, second)] = pair else { continue };
        if to <= from {
            continue;
        }
        let count = ((second - first).abs() / (MAX_TAPER_STEP * bare)).ceil().clamp(1.0, MAX_TAPER_LENGTHS) as usize;
        for n in 0..count {
            let [start, end, middle] =
                [n as f64, n as f64 + 1.0, n as f64 + 0.5].map(|at| (at / count as f64).clamp(0.0, 1.0));
            let diameter = first + (second - first) * middle;
            let ends = [start, end].map(|at| from + (to - from) * at);
            match made.last_mut().filter(|l| l.diameter == diameter) {
                Some(before) => before.ends[1] = ends[1],
                None => made.push(TubePart { ends, diameter }),
            }
        }
    }
    made
}

impl Members {
    fn check_load(load: DynamicLoad) -> Result<DynamicLoad, ClassError> {
        let DynamicLoad { load: Load { wrench, stiffness }, damping } = &load;
        if wrench.iter().chain(stiffness.iter()).chain(damping.iter()).all(|x| x.is_finite()) {
            Ok(load)
        } else {
            Err(ClassError::new("the force of the water on its members has no value where the body is"))
        }
    }
}

impl BodyLoad for Members {
    fn category(&self) -> Category {
        if self.under_way.is_some() { Category::Wave } else { Category::ViscousDrag }
    }

    /// Drag of the current. The mean of the waves' drag, which stays where they go with or against a current, is not in it.
    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let mut sum = Load::none();
        if !self.steady.is_still(Medium::Water) {
            for load in self.rods.iter().map(|rod| rod.steady(&self.steady, &self.kinks, pose)) {
                sum.wrench += load.wrench;
                sum.stiffness += load.stiffness;
            }
        }
        Members::check_load(DynamicLoad::from(sum)).map(|made| made.load)
    }

    fn dynamic_load(&self, at: &BodyStep, state: &[f64]) -> Result<DynamicLoad, ClassError> {
        match &self.under_way {
            Some(way) => Members::check_load(way.dynamic_load(&self.rods, at, member_states(state))),
            None => self.mean_load(at.pose).map(DynamicLoad::from),
        }
    }

    fn as_stateful(&self) -> Option<&dyn StatefulLoad> {
        self.under_way.as_ref().map(|_| self as _)
    }

    fn as_inertial(&self) -> Option<&dyn InertialLoad> {
        self.under_way.as_ref().map(|_| self as _)
    }

    fn as_divided(&self) -> Option<&dyn DividedLoad> {
        self.under_way.as_ref().map(|_| self as _)
    }
}

impl StatefulLoad for Members {
    fn states(&self) -> usize {
        self.under_way.as_ref().map_or(0, |way| SlowWrench::STATES + way.states())
    }

    fn begin(&self, ahead: &BodyStep, state: &mut [f64]) -> Result<(), ClassError> {
        if let (Some(way), Some(own)) = (&self.under_way, state.get_mut(SlowWrench::STATES..)) {
            way.begin(&self.rods, &self.steady, ahead, own);
        }
        Ok(())
    }

    fn commit(&self, at: &BodyStep, state: &mut [f64]) {
        let Some(way) = self.under_way.as_ref().filter(|way| way.has_waves()) else { return };
        let waves =
            way.dynamic_load(&self.rods, at, member_states(state)).load.wrench - way.drag(at, member_states(state)).0;
        let slow = &mut state[..SlowWrench::STATES];
        self.slow.commit(&waves, at.dt, slow);
    }
}

impl InertialLoad for Members {
    fn inertia(&self, state: &[f64]) -> Matrix6<f64> {
        MemberWaveLoads::inertia(member_states(state))
    }
}

impl DividedLoad for Members {
    fn other_categories(&self) -> &'static [Category] {
        match &self.under_way {
            Some(way) if way.has_waves() => &[Category::ViscousDrag, Category::WaveMean],
            Some(_) => &[Category::ViscousDrag],
            None => &[],
        }
    }

    fn part(&self, category: Category, at: &BodyStep, state: &[f64]) -> Six {
        match (&self.under_way, category) {
            (Some(way), Category::ViscousDrag) => way.drag(at, member_states(state)).0,
            (Some(_), Category::WaveMean) => SlowWrench::low_frequency_part(state),
            _ => Six::zeros(),
        }
    }
}

/// What members remember behind what is slow.
fn member_states(state: &[f64]) -> &[f64] {
    &state[SlowWrench::STATES..]
}

/// The pieces of a body that displace water, and that waves move by no pressure: neither members nor of `-DIFTYPE FK`, nor part of a hydrodynamic database, in
/// whose hull all pieces are that say nothing else where it has wave forces; interiors of tanks are not among them. An engine with waves warns of them.
pub fn pieces_without_wave_load<'a>(model: &'a Model, body: &'a Body) -> impl Iterator<Item = &'a Piece> {
    let has_forces = body.database.as_ref().is_some_and(|attached| !attached.data.excitation.is_empty());
    let is_still = move |waves: WaveAction| match waves {
        WaveAction::Nothing => true,
        WaveAction::ByForm => !has_forces,
        WaveAction::Database | WaveAction::Pressure => false,
    };
    let pieces = model.parts_of(body).flat_map(|part| part.pieces.iter());
    let displaces = |p: &Piece| p.permeability != 0.0 && p.compartment.is_none() && p.member.is_none();
    pieces.filter(move |p| displaces(p) && is_still(p.waves))
}
