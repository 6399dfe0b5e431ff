//! Slow drift: second-order forces at the differences of frequencies.
//!
//! [NEWMAN-1974], with the arithmetic mean of two mean drifts [FALTINSEN-1990 5]: `F = sum_mn a_m a_n (D_m + D_n)/2 cos(q_m - q_n)`, with
//! `q = k . x - w t + phase`. That double sum is the product of two single ones, `Re(sum a D exp(i q) conj(sum a exp(i q)))`: it holds for drift of either
//! sign, has no sum of frequencies, and its mean is `sum a2 D`. Waves of several directions each take D of their own.
//!
//! Full QTF: `F = Re sum_mn Q(w_m, w_n) c_m conj(c_n)`, `c = a exp(i q)`. Q is straight in both frequencies between those of the table, which makes it
//! `Re sum_pq Q_pq C_p conj(C_q)` over the frequencies of the table, with each wave shared between its two neighbours there. Pairs of waves of
//! different directions take the QTF of the mean direction of the sea.
//!
//! The place and heading are those that the body has, first-order motion included: a force of second order changes with that in the third order
//! only. A heading that lags would take damping from a body that drift turns back.
//!
//! A slow velocity changes the mean drift ([`super::drift_damping`]): the tables hold what the mean current adds, by wave; a force on the velocity of the
//! reference point, and of the current where it varies, is the damping of the whole sea. Between two waves it has the mean of both, as
//! the drift; of a full QTF the current changes the mean alone.

use super::drift_damping::DriftByVelocity;
use super::excitation::{load_from_state, rotate_about_z};
use super::interpolation::drift_at;
use super::interpolation::{bracket_frequency, bracket_heading};
use super::waves::{LANES, WaveGroup, WaveTable, groups};
use crate::body_load::{BodyLoad, BodyStep, DynamicLoad, PreparedLoad, StatefulLoad};
use crate::sea::Sea;
use crate::steady::{Medium, Steady};
use crate::{Category, Load, heading_of, move_wrench, turning};
use nalgebra::{Complex, Matrix2, Matrix3, Matrix6, Rotation2, Vector2, Vector3};
use std::f64::consts::TAU;
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_model::{ClassError, DriftTable, Qtf};

/// How the forces of a sea are found.
#[derive(Clone, Debug)]
enum DriftFormula {
    /// The mean over the sea by heading of the table, for the groups.
    Mean,
    /// Newman's approximation: amplitude times drift, amplitude; the last of the seven.
    Newman(Vec<WaveTable<7>>),
    /// The QTF.
    Full(Box<QtfPairs>),
}

/// A QTF for the waves of a sea.
#[derive(Clone, Debug)]
struct QtfPairs {
    qtf: Arc<Qtf>,
    /// The neighbours of each wave of each group in its frequencies.
    near: Vec<Vec<(usize, usize, f64)>>,
    /// The mean direction of the sea (rad).
    toward: f64,
    /// What the mean current adds to the mean of the pairs.
    by_current: Vec<GroupMeans>,
}

/// The mean drift of a body, and what a velocity changes of it.
#[derive(Clone, Copy, Debug)]
pub struct DriftCoefficients<'a> {
    /// The mean drift.
    pub table: &'a DriftTable,
    /// The point it is about, in the body (m).
    pub reference: Vector3<f64>,
    /// What a velocity changes of it; none where that is left out.
    pub by_velocity: Option<&'a DriftByVelocity>,
}

impl DriftCoefficients<'_> {
    /// The drift at a heading of the table, by its place, of a wave toward a direction (rad, global): with what the mean current makes of it.
    fn at_place(&self, place: usize, toward: f64, frequency: f64) -> Result<Six, ClassError> {
        let heading = self.table.headings.get(place).copied().unwrap_or_default();
        let mut force = Six::from(drift_at(self.table, heading, frequency)?);
        let added = self.by_velocity.map_or_else(Vector2::zeros, |made| made.by_current(place, frequency, toward));
        (force[0], force[1]) = (force[0] + added.x, force[1] + added.y);
        Ok(force)
    }
}

/// Means over the waves of one direction of travel (rad, global), by heading of the table.
#[derive(Clone, Debug)]
struct GroupMeans {
    toward: f64,
    forces: Vec<Six>,
    /// Row the force in surge and sway, column the velocity (N s/m).
    dampings: Vec<Matrix2<f64>>,
}

/// The slow drift of one body in one sea.
#[derive(Clone, Debug)]
pub struct SlowDrift {
    /// The point it is about, in the body (m).
    reference: Vector3<f64>,
    sea: Option<Arc<Sea>>,
    groups: Vec<WaveGroup>,
    means: Vec<GroupMeans>,
    headings: Vec<f64>,
    way: DriftFormula,
    /// Whether velocities are damped.
    is_damped: bool,
    /// The current where it varies in time.
    stream: Option<Arc<Steady>>,
}

/// Where a state of [`SlowDrift`] has the damping of velocities on the plan, after the force: by columns, global axes.
const DAMPING_STATE: usize = 6;

impl SlowDrift {
    /// The mean only, of seas given as directions of travel (rad) and energies: frequency (rad/s), half the square of the amplitude (m2).
    ///
    /// # Errors
    /// A table that has no headings.
    pub fn mean_of(coefficients: DriftCoefficients, seas: &[(f64, &[(f64, f64)])]) -> Result<Self, ClassError> {
        let DriftCoefficients { table, reference, by_velocity } = coefficients;
        let mut means = Vec::new();
        for (toward, energies) in seas {
            let mut made = GroupMeans { toward: *toward, forces: Vec::new(), dampings: Vec::new() };
            for place in 0..table.headings.len() {
                let (mut force, mut damping) = (Six::zeros(), Matrix2::zeros());
                for (w, energy) in *energies {
                    force += coefficients.at_place(place, *toward, *w)? * (2.0 * energy);
                    damping +=
                        by_velocity.map_or_else(Matrix2::zeros, |b| b.damping_at_place(place, *w)) * (2.0 * energy);
                }
                made.forces.push(force);
                made.dampings.push(damping);
            }
            means.push(made);
        }
        Ok(SlowDrift {
            reference,
            sea: None,
            groups: Vec::new(),
            means,
            headings: table.headings.clone(),
            way: DriftFormula::Mean,
            is_damped: by_velocity.is_some(),
            stream: None,
        })
    }

    /// The mean of a sea under way; it grows with the square of the ramp.
    ///
    /// # Errors
    /// As [`SlowDrift::mean_of`].
    pub fn mean(coefficients: DriftCoefficients, sea: &Arc<Sea>) -> Result<Self, ClassError> {
        let groups = groups(sea);
        let energies: Vec<(f64, Vec<(f64, f64)>)> = groups
            .iter()
            .map(|g| (g.toward, g.frequency.iter().zip(&g.amplitude).map(|(w, a)| (*w, 0.5 * a * a)).collect()))
            .collect();
        let seas: Vec<(f64, &[(f64, f64)])> = energies.iter().map(|(b, e)| (*b, e.as_slice())).collect();
        let made = SlowDrift::mean_of(coefficients, &seas)?;
        Ok(SlowDrift { sea: Some(Arc::clone(sea)), groups, ..made })
    }

    /// Newman's approximation.
    ///
    /// # Errors
    /// As [`SlowDrift::mean_of`]; too many waves.
    pub fn newman(coefficients: DriftCoefficients, sea: &Arc<Sea>) -> Result<Self, ClassError> {
        let made = SlowDrift::mean(coefficients, sea)?;
        let lanes = made.groups.iter().map(|group| {
            WaveTable::build(group, &coefficients.table.headings, |place, w, a| {
                let [x, y, z, rx, ry, rz] = (coefficients.at_place(place, group.toward, w)? * a).into();
                Ok([x, y, z, rx, ry, rz, a])
            })
        });
        let lanes = lanes.collect::<Result<Vec<_>, _>>()?;
        Ok(SlowDrift { way: DriftFormula::Newman(lanes), ..made })
    }

    /// The full QTF.
    ///
    /// # Errors
    /// As [`SlowDrift::mean_of`].
    pub fn full(qtf: &Arc<Qtf>, coefficients: DriftCoefficients, sea: &Arc<Sea>) -> Result<Self, ClassError> {
        let made = SlowDrift::mean(coefficients, sea)?;
        let near = |g: &WaveGroup| g.frequency.iter().map(|w| bracket_frequency(&qtf.frequencies, *w)).collect();
        let near: Vec<Vec<(usize, usize, f64)>> = made.groups.iter().map(near).collect();
        // of the mean the pairs have what the current does not add
        let without = SlowDrift::mean(DriftCoefficients { by_velocity: None, ..coefficients }, sea)?;
        let mut by_current = made.means.clone();
        for (own, without) in by_current.iter_mut().zip(&without.means) {
            own.forces.iter_mut().zip(&without.forces).for_each(|(own, without)| *own -= without);
        }
        let (mut x, mut y) = (0.0, 0.0);
        for wave in &sea.components {
            let energy = wave.amplitude * wave.amplitude;
            (x, y) = (x + energy * wave.toward[0], y + energy * wave.toward[1]);
        }
        let pairs = QtfPairs { qtf: Arc::clone(qtf), near, toward: f64::atan2(y, x), by_current };
        Ok(SlowDrift { way: DriftFormula::Full(Box::new(pairs)), ..made })
    }

    /// With a current that varies in time.
    pub fn with_stream(self, stream: Arc<Steady>) -> Self {
        SlowDrift { stream: Some(stream), ..self }
    }

    /// The mean about the reference point in axes turned by the yaw (rad), and its change with the yaw.
    fn mean_at(&self, yaw: f64) -> Result<(Six, Six), ClassError> {
        self.sum_of_means(&self.means, yaw)
    }

    fn sum_of_means(&self, means: &[GroupMeans], yaw: f64) -> Result<(Six, Six), ClassError> {
        let (mut sum, mut change) = (Six::zeros(), Six::zeros());
        for GroupMeans { toward, forces, .. } in means {
            let (a, b, share) = bracket_heading(&self.headings, toward - yaw)?;
            let at = |i: usize| forces[i];
            sum += at(a) + (at(b) - at(a)) * share;
            let turn = |i: usize| self.headings[i];
            let gap = (turn(b) - turn(a)).rem_euclid(TAU);
            if gap > 0.0 {
                change -= (at(b) - at(a)) / gap;
            }
        }
        Ok((sum, change))
    }

    /// The damping of velocities on the plan over the whole sea at a yaw (rad): row the force, column the velocity, global axes (N s/m).
    ///
    /// # Errors
    /// A heading in a gap of the table.
    pub fn damping_on_plan(&self, yaw: f64) -> Result<Matrix2<f64>, ClassError> {
        let mut sum = Matrix2::zeros();
        if !self.is_damped {
            return Ok(sum);
        }
        for GroupMeans { toward, dampings, .. } in &self.means {
            let (a, b, share) = bracket_heading(&self.headings, toward - yaw)?;
            sum += dampings[a] + (dampings[b] - dampings[a]) * share;
        }
        let turn = Rotation2::new(yaw);
        Ok(turn.matrix() * sum * turn.matrix().transpose())
    }

    /// The damping of a body in a pose about its origin, global axes, by that of its reference point on the plan.
    fn damping_of_body(&self, pose: &Pose, on_plan: &Matrix2<f64>) -> Matrix6<f64> {
        let arm = pose.axes * self.reference;
        let mut at_reference = Matrix3::zeros();
        at_reference.fixed_view_mut::<2, 2>(0, 0).copy_from(on_plan);
        // the velocity of the reference point is v + turn x arm
        let cross = arm.cross_matrix();
        let mut made = Matrix6::zeros();
        made.fixed_view_mut::<3, 3>(0, 0).copy_from(&at_reference);
        made.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-at_reference * cross));
        made.fixed_view_mut::<3, 3>(3, 0).copy_from(&(cross * at_reference));
        made.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-cross * at_reference * cross));
        made
    }

    /// The wave drift damping of a body at rest in a pose: about its origin, global axes.
    ///
    /// # Errors
    /// A heading in a gap of the table.
    pub fn damping_on_body(&self, pose: &Pose) -> Result<Matrix6<f64>, ClassError> {
        Ok(self.damping_of_body(pose, &self.damping_on_plan(heading_of(pose))?))
    }

    /// What the damping of a step that was begun makes of a velocity.
    fn damping_force(&self, at: &BodyStep, state: &[f64]) -> Option<(Six, Matrix6<f64>)> {
        let columns = state.get(DAMPING_STATE..DAMPING_STATE + 4)?;
        let damping = self.damping_of_body(at.pose, &Matrix2::from_column_slice(columns));
        Some((-(damping * at.velocity), damping))
    }

    /// Force and moment about the reference point at a time (s) and a place of it (m, global), in axes turned by the yaw (rad).
    ///
    /// # Errors
    /// A heading in a gap of the table.
    pub fn force(&self, time: f64, (x, y): (f64, f64), yaw: f64) -> Result<Six, ClassError> {
        let ramp = self.sea.as_ref().map_or(1.0, |sea| sea.factor(time)).powi(2);
        let at = (time, x, y);
        let force = match &self.way {
            DriftFormula::Mean => self.mean_at(yaw)?.0,
            DriftFormula::Newman(lanes) => self.by_newman(lanes, at, yaw)?,
            DriftFormula::Full(pairs) => self.by_pairs(pairs, at, yaw)? + self.sum_of_means(&pairs.by_current, yaw)?.0,
        };
        Ok(force * ramp)
    }

    fn by_newman(&self, lanes: &[WaveTable<7>], at: (f64, f64, f64), yaw: f64) -> Result<Six, ClassError> {
        let mut sums = [[0.0; 7]; 2];
        for (group, table) in self.groups.iter().zip(lanes) {
            for (sums, parts) in sums.iter_mut().zip(table.whole(group, at, group.toward - yaw)?) {
                sums.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
            }
        }
        let [real, imaginary] = sums;
        Ok(Six::from_fn(|mode, _| real[mode] * real[6] + imaginary[mode] * imaginary[6]))
    }

    fn by_pairs(&self, pairs: &QtfPairs, at: (f64, f64, f64), yaw: f64) -> Result<Six, ClassError> {
        let QtfPairs { qtf, near, toward, .. } = pairs;
        let (a, b, share) = bracket_heading(&qtf.headings, toward - yaw)?;
        let mut gathered = vec![Complex::new(0.0, 0.0); qtf.frequencies.len()];
        for (group, near) in self.groups.iter().zip(near) {
            let waves = group.amplitude.chunks(LANES).zip(near.chunks(LANES));
            for ([cos, sin], (amplitudes, near)) in group.phasors(at).zip(waves) {
                for ((cos, sin), (amplitude, (low, high, part))) in
                    cos.iter().zip(&sin).zip(amplitudes.iter().zip(near))
                {
                    let wave = Complex::new(*cos, *sin) * *amplitude;
                    gathered[*low] += wave * (1.0 - part);
                    gathered[*high] += wave * *part;
                }
            }
        }
        let mut sum = Six::zeros();
        for (index, weight) in [(a, 1.0 - share), (b, share)].into_iter().filter(|t| t.1 != 0.0) {
            let table = &qtf.values[index];
            for (p, (row, first)) in table.iter().zip(&gathered).enumerate() {
                for (q, (six, second)) in row.iter().zip(&gathered).enumerate().take(p + 1) {
                    // the pair and its mirror are conjugate
                    let pair = first * second.conj() * (if p == q { weight } else { 2.0 * weight });
                    for (mode, value) in six.iter().enumerate() {
                        sum[mode] += value.re * pair.re - value.im * pair.im;
                    }
                }
            }
        }
        Ok(sum)
    }

    /// The force on a body in a pose at a time (s): about its origin, global axes.
    ///
    /// # Errors
    /// A heading in a gap of the table.
    pub fn force_on_body(&self, pose: &Pose, time: f64) -> Result<Six, ClassError> {
        let (arm, yaw) = (pose.axes * self.reference, heading_of(pose));
        let at = pose.origin + arm;
        Ok(move_wrench(&rotate_about_z(&self.force(time, (at.x, at.y), yaw)?, yaw), arm))
    }
}

/// The mean drift: each frequency with itself.
pub fn mean_drift(qtf: &Qtf) -> DriftTable {
    let real =
        |table: &Vec<Vec<[Complex<f64>; 6]>>| table.iter().enumerate().map(|(i, row)| row[i].map(|v| v.re)).collect();
    DriftTable {
        frequencies: qtf.frequencies.clone(),
        headings: qtf.headings.clone(),
        values: qtf.values.iter().map(real).collect(),
        method: None,
    }
}

/// `k h` above which Newman's approximation is let pass.
const LEAST_DEPTH_IN_WAVES: f64 = 1.0;

/// What is wrong with Newman's approximation in waves given as energies (m2) with wave numbers (1/m), in water of a depth (m), in words. The product of
/// mean drifts has nothing of the long wave that is bound to a group, the set-down, whose elevation grows as the inverse of the depth: in water that is
/// shallow for the waves it makes most of the force at differences of frequencies [PINKSTER-1980]. One wave alone has none.
pub fn remark_on_depth(waves: impl Iterator<Item = (f64, f64)>, depth: Option<f64>) -> Option<String> {
    let depth = depth?;
    let (mut energies, mut sum, mut range) = (0.0, 0.0, [f64::INFINITY, 0.0_f64]);
    for (energy, number) in waves.filter(|(energy, _)| *energy > 0.0) {
        (energies, sum) = (energies + energy, sum + energy * number);
        range = [range[0].min(number), range[1].max(number)];
    }
    let over = sum / energies * depth;
    (range[0] < range[1] && over < LEAST_DEPTH_IN_WAVES).then(|| {
        format!(
            "Newman's approximation of slow drift lacks the set-down of wave groups, which counts in water as shallow as this: k h is {over:.2} at the mean wave number, \
             and {LEAST_DEPTH_IN_WAVES} is the least that is let pass; a full QTF (DATABASE -DRIFT QTF) has it"
        )
    })
}

impl BodyLoad for SlowDrift {
    fn category(&self) -> Category {
        Category::WaveDrift
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let (arm, yaw) = (pose.axes * self.reference, heading_of(pose));
        let (mean, change) = self.mean_at(yaw)?;
        let force = rotate_about_z(&mean, yaw);
        let [x, y, _, rx, ry, _] = force.into();
        let turn = rotate_about_z(&change, yaw) + Six::new(-y, x, 0.0, -ry, rx, 0.0);
        let mut stiffness = turning(&force, arm);
        let column = stiffness.column(5) - move_wrench(&turn, arm);
        stiffness.set_column(5, &column);
        Ok(Load { wrench: move_wrench(&force, arm), stiffness })
    }

    fn dynamic_load(&self, at: &BodyStep, state: &[f64]) -> Result<DynamicLoad, ClassError> {
        let mut made = DynamicLoad::default();
        self.add_dynamic_load(at, state, &mut made)?;
        Ok(made)
    }

    fn add_dynamic_load(&self, at: &BodyStep, state: &[f64], out: &mut DynamicLoad) -> Result<(), ClassError> {
        out.load.wrench += load_from_state(state).wrench;
        if let Some((force, damping)) = self.damping_force(at, state) {
            out.load.wrench += force;
            out.damping += damping;
        }
        Ok(())
    }

    fn as_stateful(&self) -> Option<&dyn StatefulLoad> {
        Some(self)
    }

    fn as_prepared(&self) -> Option<&dyn PreparedLoad> {
        Some(self)
    }
}

impl StatefulLoad for SlowDrift {
    fn states(&self) -> usize {
        if self.is_damped { DAMPING_STATE + 4 } else { DAMPING_STATE }
    }

    /// The force and the damping where the body is expected are those of the step.
    fn begin(&self, ahead: &BodyStep, state: &mut [f64]) -> Result<(), ClassError> {
        let mut force = self.force_on_body(ahead.pose, ahead.time)?;
        if self.is_damped {
            let ramp = self.sea.as_ref().map_or(1.0, |sea| sea.factor(ahead.time)).powi(2);
            let on_plan = self.damping_on_plan(heading_of(ahead.pose))? * ramp;
            if let Some(stream) = &self.stream {
                let surface = stream.around.tide;
                let [now, mean] = [stream.streams_at_time(ahead.time), stream.mean()]
                    .map(|streams| streams.velocity(Medium::Water, surface).0);
                let more = on_plan * (now - mean).xy();
                force += move_wrench(&Six::new(more.x, more.y, 0.0, 0.0, 0.0, 0.0), ahead.pose.axes * self.reference);
            }
            state.iter_mut().skip(DAMPING_STATE).zip(on_plan.iter()).for_each(|(kept, value)| *kept = *value);
        }
        state.iter_mut().zip(force.iter()).for_each(|(s, f)| *s = *f);
        Ok(())
    }
}

impl PreparedLoad for SlowDrift {
    fn prepared_wrench(&self, at: &BodyStep, state: &[f64]) -> Six {
        let damping = self.damping_force(at, state).map_or_else(Six::zeros, |(force, _)| force);
        load_from_state(state).wrench + damping
    }
}
