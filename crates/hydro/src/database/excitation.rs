//! First-order wave forces in time: the excitation of a database summed over the waves of a sea.
//!
//! `F(t) = Re sum X(b - yaw, w) a exp(i (k . x - w t + phase))` with the low-frequency place and heading of the body ([`low_frequency`]): in axes
//! of that heading, at the place of the reference point there; between headings X is what [`DatabaseLookup::excitation_at`] says, and has no
//! jump when the body turns. First-order motion, roll and pitch among it, does not change it.
//!
//! [`low_frequency`]: crate::low_frequency

use super::interpolation::{DatabaseLookup, finer_headings};
use super::waves::{WaveGroup, WaveTable, groups};
use crate::body_load::{BodyLoad, BodyStep, DynamicLoad, PreparedLoad, StatefulLoad};
use crate::low_frequency::{LowFrequency, LowFrequencyPosition, dividing_period_of};
use crate::sea::Sea;
use crate::{Category, Load, move_wrench};
use nalgebra::Vector3;
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_model::{ClassError, Database};

/// The excitation of one body in one sea.
#[derive(Clone, Debug)]
pub struct Excitation {
    sea: Arc<Sea>,
    /// The point it is about, in the body (m).
    reference: Vector3<f64>,
    /// Waves of a direction, with amplitude times excitation: six real parts, then six imaginary ones.
    groups: Vec<(WaveGroup, WaveTable<12>)>,
    slow: LowFrequency,
    /// The share of the sea's energy that is at frequencies beyond those of the database.
    pub outside: f64,
}

impl Excitation {
    /// That of a database in a sea, with the dividing period of that sea.
    ///
    /// # Errors
    /// A database without excitation, or too many waves.
    pub fn new(data: &Database, sea: &Arc<Sea>) -> Result<Self, ClassError> {
        // about the reference point and with the phase there: the place of that point is used instead
        let about = Database { reference: Vector3::zeros(), ..data.clone() };
        let headings = finer_headings(&data.headings);
        let mut list = Vec::new();
        for group in groups(sea) {
            let table = WaveTable::build(&group, &headings, |h, w, a| {
                let heading = headings[h];
                let x = about.excitation_at(heading, w)?;
                Ok(std::array::from_fn(|n| if n < 6 { x[n].re * a } else { x[n - 6].im * a }))
            })?;
            list.push((group, table));
        }
        let (first, last) = (data.frequencies.first(), data.frequencies.last());
        let (mut all, mut beyond) = (0.0, 0.0);
        for wave in &sea.components {
            let energy = wave.amplitude * wave.amplitude;
            all += energy;
            if first.is_some_and(|w| wave.frequency < *w) || last.is_some_and(|w| wave.frequency > *w) {
                beyond += energy;
            }
        }
        let outside = if all > 0.0 { beyond / all } else { 0.0 };
        let slow = LowFrequency::new(dividing_period_of(Some(sea)));
        Ok(Excitation { sea: Arc::clone(sea), reference: data.reference, groups: list, slow, outside })
    }

    /// The same with another dividing period (s).
    pub fn with_dividing_period(self, dividing: f64) -> Self {
        Excitation { slow: LowFrequency::new(dividing), ..self }
    }

    /// Force and moment about the reference point at a time (s) and a place of it (m, global), in axes turned by the yaw (rad).
    ///
    /// # Errors
    /// A heading in a gap of the database.
    pub fn force(&self, time: f64, (x, y): (f64, f64), yaw: f64) -> Result<Six, ClassError> {
        let mut sum = Six::zeros();
        for (group, table) in &self.groups {
            sum += Six::from(table.real(group, (time, x, y), group.toward - yaw)?);
        }
        Ok(sum * self.sea.factor(time))
    }

    /// The force on a body at a low-frequency place and heading, at a time (s): about its origin, global axes.
    ///
    /// # Errors
    /// A heading in a gap of the database.
    pub fn force_on_body(&self, slow: &LowFrequencyPosition, time: f64) -> Result<Six, ClassError> {
        let arm = slow.axes() * self.reference;
        let at = slow.origin + arm.xy();
        Ok(move_wrench(&rotate_about_z(&self.force(time, (at.x, at.y), slow.heading)?, slow.heading), arm))
    }
}

/// Six values in axes turned about z by an angle (rad), in global axes.
pub(super) fn rotate_about_z(six: &Six, angle: f64) -> Six {
    let (sin, cos) = angle.sin_cos();
    let [x, y, z, rx, ry, rz] = (*six).into();
    Six::new(cos * x - sin * y, sin * x + cos * y, z, cos * rx - sin * ry, sin * rx + cos * ry, rz)
}

impl BodyLoad for Excitation {
    fn category(&self) -> Category {
        Category::Wave
    }

    /// The mean of first-order forces is nothing.
    fn mean_load(&self, _: &Pose) -> Result<Load, ClassError> {
        Ok(Load::none())
    }

    fn dynamic_load(&self, _: &BodyStep, state: &[f64]) -> Result<DynamicLoad, ClassError> {
        Ok(DynamicLoad::from(kept_force(state)))
    }

    fn add_dynamic_load(&self, _: &BodyStep, state: &[f64], out: &mut DynamicLoad) -> Result<(), ClassError> {
        out.load.wrench += kept_force(state).wrench;
        Ok(())
    }

    fn as_stateful(&self) -> Option<&dyn StatefulLoad> {
        Some(self)
    }

    fn as_prepared(&self) -> Option<&dyn PreparedLoad> {
        Some(self)
    }
}

impl StatefulLoad for Excitation {
    fn states(&self) -> usize {
        LowFrequency::STATES + 6
    }

    /// The force where the body is expected is that of the step.
    fn begin(&self, ahead: &BodyStep, state: &mut [f64]) -> Result<(), ClassError> {
        let (own, state) = state.split_at_mut(LowFrequency::STATES);
        let force = self.force_on_body(&self.slow.predict(ahead, own), ahead.time)?;
        state.iter_mut().zip(force.iter()).for_each(|(s, f)| *s = *f);
        Ok(())
    }

    fn commit(&self, at: &BodyStep, state: &mut [f64]) {
        self.slow.commit(at, &mut state[..LowFrequency::STATES]);
    }
}

impl PreparedLoad for Excitation {
    fn prepared_wrench(&self, _: &BodyStep, state: &[f64]) -> Six {
        kept_force(state).wrench
    }
}

/// The force that a step has kept behind the low-frequency place.
fn kept_force(state: &[f64]) -> Load {
    load_from_state(&state[LowFrequency::STATES..])
}

/// A force that a step has kept, the first six of a state.
pub(super) fn load_from_state(state: &[f64]) -> Load {
    Load { wrench: Six::from_column_slice(&state[..6]), ..Load::none() }
}
