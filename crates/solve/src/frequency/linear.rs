//! The linear equations of motion about a place, and the motions of unit waves.

use crate::modes::solve_least_motion;
use crate::system::{DOFS, SolveError, System, SystemState, between_headings, mass_block};
use crate::time::{BodyForces, BodyMotion, LoadMemory, RunRequirements};
use nalgebra::{Complex, DMatrix, DVector, Matrix6};
use std::f64::consts::TAU;
use windlass_base::dense::{DenseError, Lu, SymmetricEigen, never};
use windlass_base::pose::{Pose, Six};
use windlass_base::table::TableNote;
use windlass_base::units::Dim;
use windlass_hydro::database::attached::{VelocityEffect, mean_slow_drift, velocity_effect};
use windlass_hydro::database::drift_damping::DriftByVelocity;
use windlass_hydro::database::interaction::{InteractionRadiation, interaction_radiations, own_radiation};
use windlass_hydro::database::{DatabaseLookup, mean_drift};
use windlass_hydro::roll_damping::fix_critical_damping;
use windlass_hydro::sea::dispersion::wave_number;
use windlass_hydro::{Category, heading_of, in_heading};
use windlass_model::{
    Amplitudes, AttachedDatabase, Body, ClassError, Database, DriftMethod, DriftTable, LoadKind, Model, Part, PartLoad,
    Piece, TimeStep, WaveAction,
};

/// Complex amplitudes of motion, six a body: of its origin (m) and its rotation (rad), global axes.
pub type Motions = DVector<Complex<f64>>;

/// Acceleration left, as a share of gravity, with which a place is not taken for one at rest; and the roll or pitch (rad) that the moment left would give.
const MAX_REST_ACCELERATION_SHARE: f64 = 2e-3;
const MAX_REST_TURN: f64 = 5e-3;
/// Growth of a motion over that of its mass or its stiffness alone that is taken for one without bound.
const UNBOUNDED_RESPONSE_RATIO: f64 = 1e9;
/// Share of the largest motion (m, rad) that is what rounding leaves.
const ROUNDING_SHARE: f64 = 1e-13;
/// Frequency of encounter, as a share of that of the wave, below which waves keep pace with the bodies.
const LEAST_ENCOUNTER_SHARE: f64 = 1e-6;
/// The time over which dashpots in series with springs are taken (s).
const DASHPOT_STEP_S: f64 = 1.0;

/// What waves do to a body by its database.
#[derive(Clone, Debug)]
pub(super) struct Floats {
    pub attached: AttachedDatabase,
    /// Its added mass at infinite frequency, as the system has it.
    infinite: Matrix6<f64>,
    /// Where its x axis points on the plan (rad).
    pub yaw: f64,
    /// Multipliers of WAVE, R_DRAG and W_DRIFT.
    pub factors: [f64; 3],
    /// Mean drift by heading and frequency, where it makes slow drift.
    pub drift: Option<DriftTable>,
    /// What the current changes of it.
    pub by_velocity: Option<Box<DriftByVelocity>>,
}

/// The linear equations about a place, usually that of an equilibrium.
#[derive(Debug)]
pub struct LinearSystem {
    /// The system there.
    pub system: System,
    /// The same without waves and databases, in which velocities are resisted.
    moving: System,
    /// Places of the bodies.
    pub poses: Vec<Pose>,
    /// Stiffness of all that acts there, six a body.
    pub stiffness: DMatrix<f64>,
    /// Mass without that of radiated waves, six a body.
    mass: DMatrix<f64>,
    /// Damping without that of radiated waves: given ones, connectors at rest.
    pub(super) damping: DMatrix<f64>,
    /// What a sea adds to it by linearisation.
    pub(super) linearised: DMatrix<f64>,
    /// Wave drift damping in the sea of the environment, which slow motions have beside it.
    drift_damping: DMatrix<f64>,
    /// Motions of all degrees of freedom by those that have inertia; held ones do not move, massless ones follow.
    follow: DMatrix<f64>,
    /// The degrees of freedom that have inertia.
    heavy: Vec<usize>,
    pub(super) floats: Vec<Option<Floats>>,
    /// Radiated waves of bodies as they act on others.
    interactions: Vec<LinearInteraction>,
    /// Depth with the tide (m).
    pub(super) depth: Option<f64>,
    /// The velocity all bodies sail with (m/s, global plan); zero of bodies that keep their place.
    speed: [f64; 2],
    /// What a user should know.
    pub notes: Vec<TableNote>,
    /// What of the bodies feels no waves here, in a sentence; motions in waves warn of it.
    pub without_waves: Option<String>,
}

/// Radiated waves of a body as they act on another, by their numbers.
#[derive(Clone, Debug)]
struct LinearInteraction {
    on: usize,
    by: usize,
    /// About the origins of both.
    data: Database,
    /// Its added mass at infinite frequency, as the system has it.
    infinite: Matrix6<f64>,
    /// Multiplier of R_DRAG.
    factor: f64,
}

impl LinearInteraction {
    fn all(model: &Model, system: &System) -> Result<Vec<Self>, SolveError> {
        let number = |key: &str| system.nodes.iter().position(|node| node.key == key);
        let mut list = Vec::new();
        for InteractionRadiation { pair, data, radiation, own: _ } in interaction_radiations(model) {
            let (Some(on), Some(by)) = (number(pair.on.0), number(pair.by.0)) else { continue };
            let factor = model.multipliers.factor(Category::RadiationDrag.name(), &pair.on.1.name);
            list.push(LinearInteraction { on, by, data, infinite: radiation.infinite, factor });
        }
        Ok(list)
    }
}

impl Floats {
    fn new(model: &Model, body: &Body, attached: &AttachedDatabase, pose: &Pose) -> Result<Self, ClassError> {
        let name = &body.name;
        let infinite = own_radiation(model, body).map_or_else(Matrix6::zeros, |r| r.infinite);
        let factors = [Category::Wave, Category::RadiationDrag, Category::WaveDrift]
            .map(|category| model.multipliers.factor(category.name(), name));
        let slow = matches!(attached.drift, DriftMethod::Newman | DriftMethod::Full);
        let table = || attached.data.drift.clone().or_else(|| attached.data.qtf.as_ref().map(mean_drift));
        let yaw = heading_of(pose);
        let by_velocity = match velocity_effect(model, body)? {
            VelocityEffect::Acts(made) => Some(made),
            VelocityEffect::LeftOut(_) | VelocityEffect::OffByFactor | VelocityEffect::None => None,
        };
        let drift = slow.then(table).flatten();
        Ok(Floats { attached: attached.clone(), infinite, yaw, factors, drift, by_velocity })
    }
}

impl LinearSystem {
    /// The equations of a model about its present configuration, in the environment in force.
    ///
    /// # Errors
    /// The body or connector that makes no part of the system, or has no answer there.
    pub fn new(model: &Model) -> Result<Self, SolveError> {
        model.check_motions().map_err(SolveError::new)?;
        let system = System::new(model, &[])?;
        let mut state = system.state(model);
        system.evaluate(&mut state)?;
        let (mut floats, mut mass) = (Vec::new(), system.mass_matrix(&state.poses));
        let mut drift_damping = DMatrix::zeros(mass.nrows(), mass.nrows());
        for (index, (node, pose)) in system.nodes.iter().zip(&state.poses).enumerate() {
            if model.bodies.get(&node.key).is_some_and(|b| b.prescribed.is_some()) {
                let text = "its motion is given in time: the frequency domain has none for it";
                return Err(SolveError::error_about(&node.name)(ClassError::new(text)));
            }
            let attached = model.bodies.get(&node.key).and_then(|body| Some((body, body.database.as_ref()?)));
            let made = attached.map(|(body, attached)| Floats::new(model, body, attached, pose)).transpose();
            let made = made.map_err(SolveError::error_about(&node.name))?;
            if let Some(made) = &made {
                let block = mass_block(&node.floating.mass, pose) + node.floating.added_mass(pose)
                    - in_heading(&made.infinite, pose);
                mass.fixed_view_mut::<6, 6>(6 * index, 6 * index).copy_from(&block);
                let body = model.bodies.get(&node.key);
                let damping = body.map(|body| drift_damping_of(model, body, pose)).transpose();
                let [.., factor] = made.factors;
                let damping = damping.map_err(SolveError::error_about(&node.name))?.unwrap_or_default() * factor;
                drift_damping.fixed_view_mut::<6, 6>(6 * index, 6 * index).copy_from(&damping);
            }
            floats.push(made);
        }
        let interactions = LinearInteraction::all(model, &system)?;
        let moving = calm(model)?;
        let still = vec![Six::zeros(); state.poses.len()];
        let damping = damping(&moving, &state.poses, &still, &mut BodyForces::default())?;
        let (heavy, follow) = reduce_to_inertial_dofs(&system, &state)?;
        let around = &system.surroundings;
        let depth = around.depth.map(|d| d + around.tide);
        let linearised = DMatrix::zeros(mass.nrows(), mass.nrows());
        let notes = model.caveats().into_iter().map(Into::into).collect();
        let (poses, stiffness) = (state.poses.clone(), state.stiffness.clone());
        let mut made = LinearSystem {
            system,
            moving,
            poses,
            stiffness,
            mass,
            damping,
            linearised,
            drift_damping,
            follow,
            heavy,
            floats,
            interactions,
            depth,
            speed: [0.0; 2],
            notes,
            without_waves: None,
        };
        made.look(model, &state.residual);
        made.look_at_lines(model);
        Ok(made)
    }

    /// Lets all bodies sail toward -x of the first one on the plan (m/s). Waves then meet them at the encounter frequency
    /// `w - k V cos b`, at which motions, added mass and damping are taken; forces of the waves stay those of their own frequency
    /// without speed. What else speed changes in radiation and excitation is left out.
    pub fn set_speed(&mut self, speed: f64) {
        let yaw = self.poses.first().map_or(0.0, heading_of);
        let (sin, cos) = yaw.sin_cos();
        self.speed = [-speed * cos, -speed * sin];
        if speed != 0.0 {
            let text = "with speed: forces of the waves at their own frequency, motions, added mass and damping at that of encounter; what speed changes in \
                        radiation and excitation itself is left out";
            self.notes.push(text.into());
        }
    }

    /// Whether the bodies sail.
    pub fn sails(&self) -> bool {
        self.speed != [0.0; 2]
    }

    /// The frequency (rad/s) at which the bodies meet waves of a frequency (rad/s) that travel toward a direction (rad); negative
    /// where they overtake the waves.
    ///
    /// # Errors
    /// A frequency without a wave number.
    pub fn encounter(&self, frequency: f64, toward: f64) -> Result<f64, SolveError> {
        if !self.sails() {
            return Ok(frequency);
        }
        let (sin, cos) = toward.sin_cos();
        Ok(frequency - self.wave_number(frequency)? * (self.speed[0] * cos + self.speed[1] * sin))
    }

    /// Remarks on the place and the bodies.
    fn look(&mut self, model: &Model, left: &DVector<f64>) {
        let (mut restless, mut still, mut in_time) = (Vec::new(), Vec::new(), Vec::new());
        for (index, node) in self.system.nodes.iter().enumerate() {
            let mass = node.floating.mass.mass;
            let force = (0..3).filter(|f| node.moves(*f)).map(|f| left[6 * index + f]);
            let force = force.fold(0.0, f64::hypot);
            let would_turn = |dof: usize| {
                let (at, stiffness) = (6 * index + dof, self.stiffness[(6 * index + dof, 6 * index + dof)]);
                node.moves(dof) && stiffness > 0.0 && left[at].abs() > MAX_REST_TURN * stiffness
            };
            let is_pushed = force > MAX_REST_ACCELERATION_SHARE * mass * self.system.gravity;
            if mass > 0.0 && (is_pushed || would_turn(3) || would_turn(4)) {
                restless.push(node.name.clone());
            }
            if !node.junction {
                let has_database = self.floats.get(index).is_some_and(Option::is_some);
                let body = model.bodies.get(&node.key);
                let feels = |piece: &Piece| match piece.waves {
                    WaveAction::Pressure => true,
                    WaveAction::ByForm => piece.member.is_some(),
                    WaveAction::Database | WaveAction::Nothing => false,
                };
                let lumps = |part: &Part| {
                    let own = |load: &&PartLoad| Model::key(&load.part) == Model::key(&part.name);
                    model.loads.iter().filter(own).any(|load| matches!(load.kind, LoadKind::Lump(_)))
                };
                let feels = |part: &Part| part.pieces.iter().any(feels) || lumps(part);
                let feels = body.is_some_and(|b| model.parts_of(b).any(feels));
                if feels {
                    in_time.push(node.name.clone());
                } else if !has_database {
                    still.push(node.name.clone());
                }
            }
        }
        if !restless.is_empty() {
            let text = format!("{} not at rest where the motions are taken about: &EQUI", list(&restless));
            self.notes.push(TableNote::warning(text));
        }
        if !still.is_empty() {
            self.notes.push(format!("no waves act on {}: without a hydrodynamic database", still.join(", ")).into());
        }
        if !in_time.is_empty() {
            let text = format!(
                "waves act on members, lumps and hulls of -DIFTYPE FK of {} in TDOM alone: here they have mass and stiffness, and no force of waves",
                in_time.join(", ")
            );
            self.without_waves = Some(text);
        }
        for (index, node) in self.system.nodes.iter().enumerate() {
            let own = self.damping.fixed_view::<6, 6>(6 * index, 6 * index).into_owned();
            let least = SymmetricEigen::new(own + own.transpose(), &never).map_or(0.0, |e| e.values.min());
            if least < -1e-9 * own.amax() {
                let text = format!("{} has a damping that is negative in some motion", node.name);
                self.notes.push(TableNote::warning(text));
            }
        }
    }

    /// A remark on the lines whose dynamics are left out.
    fn look_at_lines(&mut self, model: &Model) {
        let moves = |name: &&str| model.connectors.get(&Model::key(name)).is_some_and(|c| model.is_dynamic_line(c));
        let moving: Vec<_> = self.connectors().filter(moves).collect();
        if !moving.is_empty() {
            let text = format!(
                "{}: a dynamic line follows the bodies here as at rest, without dynamics of its own",
                moving.join(", ")
            );
            self.notes.push(text.into());
        }
    }

    /// What resists velocities of the bodies, beside radiated waves, six a body: its change with them there.
    ///
    /// # Errors
    /// A connector or load that has no answer.
    pub(super) fn damping_under(
        &self,
        velocities: &[Six],
        forces: &mut BodyForces,
    ) -> Result<DMatrix<f64>, SolveError> {
        damping(&self.moving, &self.poses, velocities, forces)
    }

    /// The connectors that act.
    pub fn connectors(&self) -> impl Iterator<Item = &str> {
        self.system.links.iter().map(|l| l.name.as_str())
    }

    /// Whether waves act on a body.
    pub fn is_excited(&self) -> bool {
        self.floats.iter().flatten().any(|f| !f.attached.data.excitation.is_empty())
    }

    /// What floats by a database of a body, by its name.
    fn floats_of(&self, name: &str) -> Option<&Floats> {
        let index = self.system.nodes.iter().position(|node| node.name == name)?;
        self.floats.get(index)?.as_ref()
    }

    /// Whether a body has a database, by its name.
    pub(super) fn has_database(&self, name: &str) -> bool {
        self.floats_of(name).is_some()
    }

    /// Whether slow drift acts on a body, by its name.
    pub(super) fn drifts(&self, name: &str) -> bool {
        self.floats_of(name).is_some_and(|floats| floats.drift.is_some())
    }

    /// The frequencies of the databases (rad/s), growing.
    pub fn frequencies(&self) -> Vec<f64> {
        let all = self.floats.iter().flatten().flat_map(|f| f.attached.data.frequencies.iter().copied());
        let mut all: Vec<f64> = all.collect();
        all.sort_by(f64::total_cmp);
        all.dedup_by(|a, b| *a - *b <= 1e-9 * *b);
        all
    }

    /// The headings of the first database, as directions the waves come from (rad), growing from 0.
    pub fn headings(&self) -> Vec<f64> {
        let Some(first) = self.floats.iter().flatten().next() else { return Vec::new() };
        let from = |h: &f64| {
            let turned = (h + first.yaw + 0.5 * TAU).rem_euclid(TAU);
            if TAU - turned < 1e-9 { 0.0 } else { turned }
        };
        let mut all: Vec<f64> = first.attached.data.headings.iter().map(from).collect();
        all.sort_by(f64::total_cmp);
        all
    }

    /// Mass with added mass, and damping with that of radiated waves, at a frequency (rad/s), six a body.
    pub fn inertia_and_damping(&self, frequency: f64) -> (DMatrix<f64>, DMatrix<f64>) {
        let (mut mass, mut damping) = (self.mass.clone(), &self.damping + &self.linearised);
        for (index, (floats, pose)) in self.floats.iter().zip(&self.poses).enumerate() {
            let Some(Floats { attached, infinite, factors: [_, radiated, _], .. }) = floats else { continue };
            let data = &attached.data;
            let more = data.added_mass_at(frequency).map_or(*infinite, |a| infinite + (a - infinite) * *radiated);
            let mut block = mass.fixed_view_mut::<6, 6>(6 * index, 6 * index);
            block += in_heading(&more, pose);
            if let Some(own) = data.damping_at(frequency) {
                let mut block = damping.fixed_view_mut::<6, 6>(6 * index, 6 * index);
                block += in_heading(&(own * *radiated), pose);
            }
        }
        for LinearInteraction { on, by, data, infinite, factor } in &self.interactions {
            let (Some(own), Some(other)) = (self.poses.get(*on), self.poses.get(*by)) else { continue };
            if let Some(added) = data.added_mass_at(frequency) {
                let mut block = mass.fixed_view_mut::<6, 6>(6 * on, 6 * by);
                // the system has that of the infinite frequency
                block += between_headings(&((added - infinite) * *factor), own, other);
            }
            if let Some(radiated) = data.damping_at(frequency) {
                let mut block = damping.fixed_view_mut::<6, 6>(6 * on, 6 * by);
                block += between_headings(&(radiated * *factor), own, other);
            }
        }
        (mass, damping)
    }

    /// The same with the wave drift damping in the sea of the environment: for motions that are slow beside its waves.
    pub fn slow_inertia_and_damping(&self, frequency: f64) -> (DMatrix<f64>, DMatrix<f64>) {
        let (mass, damping) = self.inertia_and_damping(frequency);
        (mass, damping + &self.drift_damping)
    }

    /// Whether a body has wave drift damping.
    pub fn has_drift_damping(&self) -> bool {
        self.drift_damping.amax() > 0.0
    }

    /// Forces of a wave of unit amplitude (m) that travels toward a direction (rad) with its crest at the global origin, six a body (N, N m).
    ///
    /// # Errors
    /// A heading in a gap of a database.
    pub fn excitation(&self, frequency: f64, toward: f64) -> Result<Motions, SolveError> {
        let mut all = Motions::zeros(self.mass.nrows());
        let k = self.wave_number(frequency)?;
        let (sin, cos) = toward.sin_cos();
        for (index, ((floats, pose), node)) in self.floats.iter().zip(&self.poses).zip(&self.system.nodes).enumerate() {
            let Some(floats) = floats.as_ref().filter(|f| !f.attached.data.excitation.is_empty()) else { continue };
            let x = floats.attached.data.excitation_at(toward - floats.yaw, frequency);
            let x = rotate_amplitudes(x.map_err(SolveError::error_about(&node.name))?, floats.yaw);
            let [factor, ..] = floats.factors;
            let phase = k * (pose.origin.x * cos + pose.origin.y * sin);
            for (i, value) in x.into_iter().enumerate() {
                all[6 * index + i] = value * Complex::from_polar(factor, phase);
            }
        }
        Ok(all)
    }

    pub(super) fn wave_number(&self, frequency: f64) -> Result<f64, SolveError> {
        wave_number(frequency, self.depth, self.system.gravity).map_err(SolveError::new)
    }

    /// Motions under forces of a frequency (rad/s), negative of waves that are overtaken.
    ///
    /// # Errors
    /// A motion without bound: no damping at its natural period.
    pub fn motions(&self, frequency: f64, forces: &[Motions]) -> Result<Vec<Motions>, SolveError> {
        self.motions_with(frequency, self.inertia_and_damping(frequency.abs()), forces)
    }

    /// The same with given mass with added mass, and damping, six a body.
    ///
    /// # Errors
    /// As [`LinearSystem::motions`].
    pub fn motions_with(
        &self,
        frequency: f64,
        (mass, damping): (DMatrix<f64>, DMatrix<f64>),
        forces: &[Motions],
    ) -> Result<Vec<Motions>, SolveError> {
        let real = &self.stiffness - mass * (frequency * frequency);
        let to = self.follow.transpose();
        let (real, damping) = (&to * real * &self.follow, &to * damping * &self.follow);
        let (inertia, stiffness) = (&to * &self.mass * &self.follow, &to * &self.stiffness * &self.follow);
        let size = real.nrows();
        let scale: Vec<f64> = (0..size)
            .map(|i| (inertia[(i, i)].abs() * frequency * frequency + stiffness[(i, i)].abs()).sqrt().recip())
            .collect();
        let scaled = DMatrix::from_fn(size, size, |i, j| {
            Complex::new(real[(i, j)], -frequency * damping[(i, j)]) * (scale[i] * scale[j])
        });
        let inverse = match Lu::new(scaled, &|| self.system.is_interrupted()).and_then(|lu| lu.inverse()) {
            Ok(inverse) => Some(inverse),
            Err(DenseError::Singular) => None,
            Err(error) => return Err(self.system.singular_matrix_error("dynamic stiffness", &self.heavy, error)),
        };
        let worst = |m: &DMatrix<Complex<f64>>| {
            let largest = |i: usize| m.row(i).iter().fold(0.0, |most: f64, v| most.max(v.norm()));
            (0..size).map(|i| (largest(i), i)).fold((0.0, 0), |a, b| if b.0 > a.0 { b } else { a })
        };
        let bound = inverse.as_ref().map(worst);
        let (Some(inverse), Some((..=UNBOUNDED_RESPONSE_RATIO, _))) = (inverse, bound) else {
            let row = bound.and_then(|(_, i)| self.heavy.get(i)).copied();
            let text = "its motion has no bound at a period of {}: it is a natural period without damping";
            let error =
                ClassError::with_values(text, &[(TAU / frequency.abs(), Dim::Time)]).help("#DAMP gives a body damping");
            let name = |row: usize| {
                let node = self.system.nodes.get(row / 6)?;
                Some(format!("{} in {}", node.name, DOFS.get(row % 6)?))
            };
            return Err(match row.and_then(name) {
                Some(who) => SolveError::new(error.with_subject(who)),
                None => SolveError::new(error),
            });
        };
        let follow = self.follow.map(|v| Complex::new(v, 0.0));
        let one = |force: &Motions| {
            let own = follow.tr_mul(force);
            let own = DVector::from_fn(size, |i, _| own[i] * scale[i]);
            let moved = &inverse * own;
            let mut all = &follow * DVector::from_fn(size, |i, _| moved[i] * scale[i]);
            let least = ROUNDING_SHARE * all.iter().fold(0.0, |most: f64, v| most.max(v.norm()));
            all.iter_mut().filter(|v| v.norm() < least).for_each(|v| *v = Complex::new(0.0, 0.0));
            all
        };
        Ok(forces.iter().map(one).collect())
    }

    /// Motions in waves of unit amplitude (m) of a frequency (rad/s), one for each direction of travel (rad).
    ///
    /// # Errors
    /// As [`LinearSystem::excitation`] and [`LinearSystem::motions`].
    pub fn operators(&self, frequency: f64, toward: &[f64]) -> Result<Vec<Motions>, SolveError> {
        let forces = toward.iter().map(|b| self.excitation(frequency, *b)).collect::<Result<Vec<_>, _>>()?;
        if !self.sails() {
            return self.motions(frequency, &forces);
        }
        let mut all = Vec::new();
        for (force, toward) in forces.into_iter().zip(toward) {
            let met = self.encounter(frequency, *toward)?;
            if met.abs() < LEAST_ENCOUNTER_SHARE * frequency {
                let text = "waves of a period of {} keep pace with the bodies: their frequency of encounter is zero";
                let error = ClassError::with_values(text, &[(TAU / frequency, Dim::Time)]);
                return Err(SolveError::new(error.help("other periods or headings, or another -SPEED")));
            }
            all.extend(self.motions(met, &[force])?);
        }
        Ok(all)
    }
}

/// The wave drift damping of a body in the sea of the environment, about its origin, global axes.
fn drift_damping_of(model: &Model, body: &Body, pose: &Pose) -> Result<Matrix6<f64>, ClassError> {
    mean_slow_drift(model, body)?.map_or(Ok(Matrix6::zeros()), |drift| drift.damping_on_body(pose))
}

/// Several names as the subject of a sentence.
fn list(names: &[String]) -> String {
    format!("{} {}", names.join(", "), if names.len() == 1 { "is" } else { "are" })
}

/// Six amplitudes in axes turned about z by an angle (rad), in global axes.
fn rotate_amplitudes([x, y, z, rx, ry, rz]: Amplitudes, angle: f64) -> Amplitudes {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos, z, rx * cos - ry * sin, rx * sin + ry * cos, rz]
}

/// The bodies under way in calm water, without what databases bring and without gusts.
fn calm(model: &Model) -> Result<System, SolveError> {
    let mut calm = model.clone();
    // with the added mass of the databases
    fix_critical_damping(&mut calm).map_err(SolveError::new)?;
    calm.bodies.values_mut().for_each(|b| b.database = None);
    calm.environment.gusts = None;
    System::under_way(&calm, None, RunRequirements::default())
}

/// What resists velocities, six a body.
fn damping(
    system: &System,
    poses: &[Pose],
    velocities: &[Six],
    forces: &mut BodyForces,
) -> Result<DMatrix<f64>, SolveError> {
    let motion =
        |(pose, velocity): (&Pose, &Six)| BodyMotion { pose: *pose, velocity: *velocity, ..BodyMotion::default() };
    let motions: Vec<BodyMotion> = poses.iter().zip(velocities).map(motion).collect();
    let mut memory = LoadMemory::new(system);
    memory.begin(system, (&motions, &motions), TimeStep { time: 0.0, dt: DASHPOT_STEP_S })?;
    forces.evaluate(system, &memory, &motions, TimeStep { time: 0.0, dt: DASHPOT_STEP_S })?;
    match forces.damping.iter().all(|v| v.is_finite()) {
        true => Ok(forces.damping.clone()),
        false => Err(SolveError::new(ClassError::new("the damping has no value at some velocity of the bodies"))),
    }
}

/// The degrees of freedom that have inertia, and the motions of all degrees of freedom by theirs.
fn reduce_to_inertial_dofs(system: &System, state: &SystemState) -> Result<(Vec<usize>, DMatrix<f64>), SolveError> {
    let mass = system.mass_matrix(&state.poses);
    let moves = |i: &usize| system.nodes.get(i / 6).is_some_and(|n| n.moves(i % 6));
    let (heavy, light): (Vec<usize>, Vec<usize>) = (0..mass.nrows()).filter(moves).partition(|i| mass[(*i, *i)] > 0.0);
    if heavy.is_empty() {
        return Err(SolveError::new(ClassError::new("no body with a mass is free to move")));
    }
    let mut follow = DMatrix::zeros(mass.nrows(), heavy.len());
    for (column, row) in heavy.iter().enumerate() {
        follow[(*row, column)] = 1.0;
    }
    let part = |r: &[usize], c: &[usize]| state.stiffness.select_rows(r).select_columns(c);
    if !light.is_empty() {
        let solved = solve_least_motion(part(&light, &light), &part(&light, &heavy), &|| system.is_interrupted());
        let solved = solved.map_err(|e| system.singular_matrix_error("stiffness", &light, e))?;
        for (from, row) in light.iter().enumerate() {
            follow.row_mut(*row).copy_from(&-solved.row(from));
        }
    }
    Ok((heavy, follow))
}
