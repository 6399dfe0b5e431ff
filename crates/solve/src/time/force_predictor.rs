//! The forces at the end of a step, predicted from those of its start.
//!
//! `F1 = F0 - (K0 + K1)/2 (q1 - q0) - (C0 + C1)/2 (v1 - v0)` by the trapezoidal rule on the straight way between the two states,
//! K1 and C1 continued from the ends of the last three steps by a parabola. What is predicted is a trial's first correction only:
//! the forces of a step are always evaluated.
//!
//! A dynamic line changes its pull without its ends, and by their accelerations: `- (M0 + M1)/2 (a1 - a0)` more, and by how much
//! all this was off in the last steps, continued by a parabola, too.

use super::forces::BodyMotion;
use nalgebra::{DMatrix, DVector};
use windlass_base::pose::Six;

/// A step this near another, over its length, is as long.
const EQUAL_STEPS_SHARE: f64 = 1e-6;

/// A matrix at the ends of the last steps, and the mean of its value now and that expected at the end of the next.
#[derive(Debug, Default)]
struct MatrixHistory {
    mean: DMatrix<f64>,
    last: DMatrix<f64>,
    before: DMatrix<f64>,
}

impl MatrixHistory {
    /// Goes on to its value now, after so many others in a row.
    fn take(&mut self, now: &DMatrix<f64>, count: usize) {
        let [a, b, c] = match count {
            0 => {
                for matrix in [&mut self.mean, &mut self.last, &mut self.before] {
                    matrix.clone_from(now);
                }
                return;
            }
            1 => [1.5, -0.5, 0.0],
            _ => [2.0, -1.5, 0.5],
        };
        let earlier = self.last.iter_mut().zip(&mut self.before);
        for ((mean, now), (last, before)) in self.mean.iter_mut().zip(now).zip(earlier) {
            *mean = a * now + b * *last + c * *before;
            (*before, *last) = (*last, *now);
        }
    }
}

/// What the next step is predicted from.
#[derive(Debug, Default)]
pub(super) struct ForcePredictor {
    /// Steps of one length in a row at the end of which there was balance.
    count: usize,
    /// That length (s).
    step: f64,
    stiffness: MatrixHistory,
    damping: MatrixHistory,
    inertia: MatrixHistory,
    /// By how much the ends of the last steps in a row were off, the latest first (N, N m), and how many of these there are.
    off: [DVector<f64>; 3],
    known: usize,
    /// The forces of the start of a step under way, with what loads hold ready for it.
    start: DVector<f64>,
}

impl ForcePredictor {
    /// Nothing predicts the next step.
    pub(super) fn clear(&mut self) {
        (self.count, self.known) = (0, 0);
    }

    /// A step of a length (s) has ended with these.
    pub(super) fn take(&mut self, dt: f64, stiffness: &DMatrix<f64>, damping: &DMatrix<f64>) {
        if (dt - self.step).abs() > EQUAL_STEPS_SHARE * dt || self.stiffness.last.shape() != stiffness.shape() {
            (self.count, self.known, self.step) = (0, 0, dt);
        }
        self.stiffness.take(stiffness, self.count);
        self.damping.take(damping, self.count);
        self.count += 1;
    }

    /// With that of a step, its -d(sum)/d(acceleration) of dynamic lines: before [`ForcePredictor::take`].
    pub(super) fn take_inertia(&mut self, dt: f64, inertia: &DMatrix<f64>) {
        let again = (dt - self.step).abs() <= EQUAL_STEPS_SHARE * dt && self.inertia.last.shape() == inertia.shape();
        self.inertia.take(inertia, if again { self.count } else { 0 });
    }

    /// Keeps the forces of the start of a step, with what loads hold ready.
    pub(super) fn begin(&mut self, sum: &DVector<f64>) {
        self.start.clone_from(sum);
    }

    /// Adds to the forces of the start of a step what accelerations make of them over it, and by how much the steps before were off.
    /// False without enough of these to go by.
    pub(super) fn add_dynamic(&self, (trial, start): (&[BodyMotion], &[BodyMotion]), sum: &mut DVector<f64>) -> bool {
        let weights = match self.known {
            0 => return false,
            1 => [1.0, 0.0, 0.0],
            2 => [2.0, -1.0, 0.0],
            _ => [3.0, -3.0, 1.0],
        };
        self.add_inertia((trial, start), sum);
        for (off, weight) in self.off.iter().zip(weights).filter(|(_, w)| *w != 0.0) {
            sum.axpy(weight, off, 1.0);
        }
        true
    }

    /// Adds to the forces of the start of a step what accelerations make of them over it.
    pub(super) fn add_inertia(&self, (trial, start): (&[BodyMotion], &[BodyMotion]), sum: &mut DVector<f64>) {
        if self.inertia.mean.nrows() != sum.len() {
            return;
        }
        for (body, (trial, start)) in trial.iter().zip(start).enumerate() {
            let harder = trial.acceleration - start.acceleration;
            sum.gemv(-1.0, &self.inertia.mean.fixed_columns::<6>(6 * body), &harder, 1.0);
        }
    }

    /// Learns from the forces at the end of a step by how much they would have been off.
    pub(super) fn learn(&mut self, dt: f64, motions: (&[BodyMotion], &[BodyMotion], &[Six]), sum: &DVector<f64>) {
        let mut predicted = std::mem::take(&mut self.start);
        if predicted.len() == sum.len() && self.add(dt, motions, &mut predicted) {
            self.add_inertia((motions.0, motions.1), &mut predicted);
            self.off.rotate_right(1);
            let [latest, ..] = &mut self.off;
            latest.clone_from(sum);
            *latest -= &predicted;
            self.known = (self.known + 1).min(3);
        } else {
            self.known = 0;
        }
        self.start = predicted;
    }

    /// Adds to the forces of the start of a step what motion and change of velocity over it make of them. False without a step of
    /// that length to go by.
    pub(super) fn add(
        &self,
        dt: f64,
        (trial, start, over): (&[BodyMotion], &[BodyMotion], &[Six]),
        sum: &mut DVector<f64>,
    ) -> bool {
        if self.count == 0 || (dt - self.step).abs() > EQUAL_STEPS_SHARE * dt {
            return false;
        }
        for (body, ((trial, start), over)) in trial.iter().zip(start).zip(over).enumerate() {
            let faster = trial.velocity - start.velocity;
            sum.gemv(-1.0, &self.stiffness.mean.fixed_columns::<6>(6 * body), over, 1.0);
            sum.gemv(-1.0, &self.damping.mean.fixed_columns::<6>(6 * body), &faster, 1.0);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forces_with_parabolic_stiffness_in_time_are_predicted_exactly() {
        let (stiffness, damping) = (|t: f64| 3.0 + 2.0 * t + 5.0 * t * t, |t: f64| 1.0 - t + 0.5 * t * t);
        let mut made = ForcePredictor::default();
        let whole = |value: f64| DMatrix::from_diagonal_element(6, 6, value);
        for t in [-0.2, -0.1, 0.0] {
            made.take(0.1, &whole(stiffness(t)), &whole(damping(t)));
        }
        let (start, trial) =
            (BodyMotion::default(), BodyMotion { velocity: Six::repeat(0.4), ..BodyMotion::default() });
        let mut sum = DVector::zeros(6);
        let (start, over) = ([start], [Six::repeat(0.3)]);
        assert!(!made.add(0.05, (&[trial], &start, &over), &mut sum));
        assert!(made.add(0.1, (&[trial], &start, &over), &mut sum));
        // the means of the parabolas at 0 and 0.1
        let (k, c) = (3.0 + 0.5 * (0.2 + 0.05), 1.0 + 0.5 * (0.005 - 0.1));
        assert!(sum.iter().all(|f| (f + 0.3 * k + 0.4 * c).abs() < 1e-14), "{sum}");
    }

    #[test]
    fn line_force_is_predicted_from_its_last_steps() {
        // stiffness 3, damping 2, inertia 5, and a pull that is a cubic of time: its changes over the steps are a parabola
        let whole = |value: f64| DMatrix::from_diagonal_element(6, 6, value);
        let own = |t: f64| 7.0 * t * t * t - 4.0 * t * t + t;
        let position = |t: f64| 0.3 * t * t;
        let motion = |t: f64| BodyMotion {
            velocity: Six::repeat(0.6 * t),
            acceleration: Six::repeat(0.6 * (10.0 * t).sin()),
            ..BodyMotion::default()
        };
        let force = |t: f64| {
            let at = motion(t);
            DVector::repeat(6, own(t) - 3.0 * position(t) - 2.0 * at.velocity[0] - 5.0 * at.acceleration[0])
        };
        let mut made = ForcePredictor::default();
        let dt = 0.1;
        for step in 0..5 {
            let t = f64::from(step) * dt;
            let (start, trial, over) = ([motion(t)], [motion(t + dt)], [Six::repeat(position(t + dt) - position(t))]);
            let mut predicted = force(t);
            made.begin(&predicted);
            let ready = made.add(dt, (&trial, &start, &over), &mut predicted)
                && made.add_dynamic((&trial, &start), &mut predicted);
            // three steps to learn from, behind one that gives the matrices
            assert_eq!(ready, step >= 2);
            let off = (&predicted - force(t + dt)).amax();
            // rounding of numbers about one, weighed by three
            assert!(step < 4 || off < 1e-13, "{off}");
            made.learn(dt, (&trial, &start, &over), &force(t + dt));
            made.take_inertia(dt, &whole(5.0));
            made.take(dt, &whole(3.0), &whole(2.0));
        }
    }
}
