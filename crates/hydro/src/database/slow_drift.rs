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

use super::excitation::{load_from_state, rotate_about_z, yaw};
use super::interpolation::drift_at;
use super::interpolation::{bracket_frequency, bracket_heading};
use super::waves::{LANES, WaveGroup, WaveTable, groups};
use crate::body_load::{BodyLoad, BodyStep, DynamicLoad, PreparedLoad, StatefulLoad};
use crate::sea::Sea;
use crate::{Category, Load, move_wrench, turning};
use nalgebra::{Complex, Vector3};
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
    /// The QTF, the neighbours of each wave of each group in its frequencies, and the mean direction of the sea (rad).
    Full(Arc<Qtf>, Vec<Vec<(usize, usize, f64)>>, f64),
}

/// The slow drift of one body in one sea.
#[derive(Clone, Debug)]
pub struct SlowDrift {
    /// The point it is about, in the body (m).
    reference: Vector3<f64>,
    sea: Option<Arc<Sea>>,
    groups: Vec<WaveGroup>,
    /// Mean force by heading of the table: direction of travel of the waves (rad), headings, values.
    means: Vec<(f64, Vec<Six>)>,
    headings: Vec<f64>,
    way: DriftFormula,
}

impl SlowDrift {
    /// The mean only, of seas given as directions of travel (rad) and energies: frequency (rad/s), half the square of the amplitude (m2).
    ///
    /// # Errors
    /// A table that has no headings.
    pub fn mean_of(
        table: &DriftTable,
        reference: Vector3<f64>,
        seas: &[(f64, &[(f64, f64)])],
    ) -> Result<Self, ClassError> {
        let mut means = Vec::new();
        for (toward, energies) in seas {
            let mut list = Vec::new();
            for heading in &table.headings {
                let mut sum = Six::zeros();
                for (w, energy) in *energies {
                    sum += Six::from(drift_at(table, *heading, *w)?) * (2.0 * energy);
                }
                list.push(sum);
            }
            means.push((*toward, list));
        }
        let headings = table.headings.clone();
        Ok(SlowDrift { reference, sea: None, groups: Vec::new(), means, headings, way: DriftFormula::Mean })
    }

    /// The mean of a sea under way; it grows with the square of the ramp.
    ///
    /// # Errors
    /// As [`SlowDrift::mean_of`].
    pub fn mean(table: &DriftTable, reference: Vector3<f64>, sea: &Arc<Sea>) -> Result<Self, ClassError> {
        let groups = groups(sea);
        let energies: Vec<(f64, Vec<(f64, f64)>)> = groups
            .iter()
            .map(|g| (g.toward, g.frequency.iter().zip(&g.amplitude).map(|(w, a)| (*w, 0.5 * a * a)).collect()))
            .collect();
        let seas: Vec<(f64, &[(f64, f64)])> = energies.iter().map(|(b, e)| (*b, e.as_slice())).collect();
        let made = SlowDrift::mean_of(table, reference, &seas)?;
        Ok(SlowDrift { sea: Some(Arc::clone(sea)), groups, ..made })
    }

    /// Newman's approximation.
    ///
    /// # Errors
    /// As [`SlowDrift::mean_of`]; too many waves.
    pub fn newman(table: &DriftTable, reference: Vector3<f64>, sea: &Arc<Sea>) -> Result<Self, ClassError> {
        let made = SlowDrift::mean(table, reference, sea)?;
        let lanes = made.groups.iter().map(|group| {
            WaveTable::build(group, &table.headings, |h, w, a| {
                let heading = table.headings[h];
                let [x, y, z, rx, ry, rz] = drift_at(table, heading, w)?.map(|d| d * a);
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
    pub fn full(qtf: &Arc<Qtf>, reference: Vector3<f64>, sea: &Arc<Sea>) -> Result<Self, ClassError> {
        let diagonal = mean_drift(qtf);
        let made = SlowDrift::mean(&diagonal, reference, sea)?;
        let near = |g: &WaveGroup| g.frequency.iter().map(|w| bracket_frequency(&qtf.frequencies, *w)).collect();
        let near: Vec<Vec<(usize, usize, f64)>> = made.groups.iter().map(near).collect();
        let (mut x, mut y) = (0.0, 0.0);
        for wave in &sea.components {
            let energy = wave.amplitude * wave.amplitude;
            (x, y) = (x + energy * wave.toward[0], y + energy * wave.toward[1]);
        }
        Ok(SlowDrift { way: DriftFormula::Full(Arc::clone(qtf), near, f64::atan2(y, x)), ..made })
    }

    /// The mean about the reference point in axes turned by the yaw (rad), and its change with the yaw.
    fn mean_at(&self, yaw: f64) -> Result<(Six, Six), ClassError> {
        let (mut sum, mut change) = (Six::zeros(), Six::zeros());
        for (toward, list) in &self.means {
            let (a, b, share) = bracket_heading(&self.headings, toward - yaw)?;
            let at = |i: usize| list[i];
            sum += at(a) + (at(b) - at(a)) * share;
            let turn = |i: usize| self.headings[i];
            let gap = (turn(b) - turn(a)).rem_euclid(std::f64::consts::TAU);
            if gap > 0.0 {
                change -= (at(b) - at(a)) / gap;
            }
        }
        Ok((sum, change))
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
            DriftFormula::Full(qtf, near, toward) => self.by_pairs(qtf, near, at, toward - yaw)?,
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

    fn by_pairs(
        &self,
        qtf: &Qtf,
        near: &[Vec<(usize, usize, f64)>],
        at: (f64, f64, f64),
        heading: f64,
    ) -> Result<Six, ClassError> {
        let (a, b, share) = bracket_heading(&qtf.headings, heading)?;
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
        let (arm, yaw) = (pose.axes * self.reference, yaw(pose));
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
        let (arm, yaw) = (pose.axes * self.reference, yaw(pose));
        let (mean, change) = self.mean_at(yaw)?;
        let force = rotate_about_z(&mean, yaw);
        let [x, y, _, rx, ry, _] = force.into();
        let turn = rotate_about_z(&change, yaw) + Six::new(-y, x, 0.0, -ry, rx, 0.0);
        let mut stiffness = turning(&force, arm);
        let column = stiffness.column(5) - move_wrench(&turn, arm);
        stiffness.set_column(5, &column);
        Ok(Load { wrench: move_wrench(&force, arm), stiffness })
    }

    fn dynamic_load(&self, _: &BodyStep, state: &[f64]) -> Result<DynamicLoad, ClassError> {
        Ok(DynamicLoad::from(load_from_state(state)))
    }

    fn add_dynamic_load(&self, _: &BodyStep, state: &[f64], out: &mut DynamicLoad) -> Result<(), ClassError> {
        out.load.wrench += load_from_state(state).wrench;
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
        6
    }

    /// The force where the body is expected is that of the step.
    fn begin(&self, ahead: &BodyStep, state: &mut [f64]) -> Result<(), ClassError> {
        let force = self.force_on_body(ahead.pose, ahead.time)?;
        state.iter_mut().zip(force.iter()).for_each(|(s, f)| *s = *f);
        Ok(())
    }
}

impl PreparedLoad for SlowDrift {
    fn prepared_wrench(&self, _: &BodyStep, state: &[f64]) -> Six {
        load_from_state(state).wrench
    }
}
