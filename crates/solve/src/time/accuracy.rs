//! How well the steps of a run follow what moves in it.
//!
//! A scheme turns an undamped oscillation `x = cos(w t)` into one of another period, with damping of its own. Both are those of the
//! eigenvalues of its amplification matrix at `w h` [CHUNG-HULBERT-1993]. The `w h` of a
//! degree of freedom is measured as the run goes: the square root of `sum h (h a)^2 / sum h (v - mean v)^2`, exact of a sine. It does not
//! follow what is between two instants: a load that comes and goes within a step is not seen.

use super::forces::BodyMotion;
use super::scheme::{Method, TimeScheme};
use crate::system::{DOFS, System, SystemBody, mass_block};
use nalgebra::Matrix3;
use std::f64::consts::TAU;
use windlass_base::dense::{eigenvalues, never};
use windlass_base::pose::Six;
use windlass_nonlinear::bisect;

/// Error of a period, as a share of it, above which a step is too long: that of the trapezoidal rule with eight steps a period.
pub const POOR_PERIOD: f64 = 0.05;
/// Damping of a scheme, as a share of critical, above which a step is too long: it takes a ninth of an amplitude a cycle.
pub const POOR_DAMPING: f64 = 0.02;
/// Share of the largest velocity of its body from which on a degree of freedom is judged (rotations times the radius of gyration): below
/// it has less than a ten-thousandth of the energy.
const MIN_JUDGED_VELOCITY_SHARE: f64 = 1e-2;
/// The same of the largest velocity of all bodies.
const COUNTS_AMONG_ALL: f64 = 1e-3;
/// Velocity below which nothing moves (m/s).
const STANDSTILL_VELOCITY: f64 = 1e-6;
/// Largest angle of a step for which the matrix is evaluated (rad): a step of a hundred and sixty periods.
const MAX_STEP_ANGLE_RAD: f64 = 1e3;
/// A rotation counts in the error of a step with this arm (m), as in `-ADAPTIVE`.
const ROTATION_ARM_M: f64 = 10.0;

/// Halvings of the angle of a step: the longest one to 1e-14.
const STEP_HALVINGS: usize = 50;

/// What a scheme makes of an undamped oscillation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distortion {
    /// Its period over the right one, less 1.
    pub period: f64,
    /// Its damping, as a share of critical.
    pub damping: f64,
}

impl Distortion {
    /// How poor it is: above 1 the step is too long.
    pub fn measure(&self) -> f64 {
        (self.period.abs() / POOR_PERIOD).max(self.damping.abs() / POOR_DAMPING)
    }
}

impl TimeScheme {
    /// What it makes of an oscillation whose phase advances by an angle in a step (rad).
    pub fn distortion(&self, angle: f64) -> Distortion {
        let none = Distortion { period: f64::INFINITY, damping: 1.0 };
        if !angle.is_finite() {
            return none;
        }
        let angle = angle.min(MAX_STEP_ANGLE_RAD);
        if angle < 1e-6 {
            return Distortion { period: 0.0, damping: 0.0 };
        }
        let TimeScheme { alpha_m, alpha_f, beta, gamma } = *self;
        let (square, share, gain) = (angle * angle, 1.0 / (1.0 - alpha_m), self.gain());
        // x, h v and h^2 times the auxiliary acceleration, with a = -w^2 x
        let whole = 1.0 + beta * gain * square;
        let x = [1.0 - beta * alpha_f * square * share, 1.0, 0.5 - beta - beta * alpha_m * share].map(|v| v / whole);
        let held = [-alpha_f * square * share, 0.0, -alpha_m * share];
        let b = [0, 1, 2].map(|i| held[i] - gain * square * x[i]);
        let v = [gamma * b[0], 1.0 + gamma * b[1], 1.0 - gamma + gamma * b[2]];
        let matrix = Matrix3::from_row_iterator([x, v, b].into_iter().flatten());
        let Ok(values) = eigenvalues(matrix, &never) else { return none };
        let Some(root) = values.iter().max_by(|p, q| p.im.total_cmp(&q.im)).filter(|z| z.im > 1e-12) else {
            return none;
        };
        let (turn, decay) = (root.im.atan2(root.re), -root.re.hypot(root.im).ln());
        Distortion { period: angle / turn - 1.0, damping: decay / turn.hypot(decay) }
    }

    /// Error of place of one step over `h^3` and the change of the acceleration with time: what [ZIENKIEWICZ-XIE-1991 eq. 12]
    /// has for Newmark's scheme, `beta - 1/6`, with the auxiliary
    /// acceleration standing `alpha_m - alpha_f` steps behind the acceleration.
    fn error_of_place(&self) -> f64 {
        // linear acceleration has no error of this order, but is not exact: it is judged as the trapezoidal rule
        (self.beta + 0.5 * (self.alpha_m - self.alpha_f) - 1.0 / 6.0).abs().max(1.0 / 12.0)
    }
}

impl Method {
    /// The scheme whose errors it has: that of the corrector is the trapezoidal rule.
    fn errs_as(&self) -> TimeScheme {
        match self {
            Method::Implicit(scheme) => *scheme,
            Method::Corrector => TimeScheme::newmark(0.25, 0.5),
        }
    }

    /// What it makes of an oscillation of a period with a step (s).
    pub fn distortion(&self, period: f64, dt: f64) -> Distortion {
        self.errs_as().distortion(TAU * dt / period)
    }

    /// The longest step that is not too long for a period (s).
    pub fn longest_step(&self, period: f64) -> f64 {
        let scheme = self.errs_as();
        let [short, _] = bisect([0.0, TAU], STEP_HALVINGS, |angle| scheme.distortion(angle).measure() <= 1.0);
        short * period / TAU
    }

    /// The error of place of a step (m) at whose end bodies move so; rotations count with an arm of 10 m.
    pub(super) fn error_of_step<'a>(&self, motions: impl Iterator<Item = &'a BodyMotion>, dt: f64) -> f64 {
        let jerk =
            |m: &BodyMotion| m.jerk.fixed_rows::<3>(0).norm().max(ROTATION_ARM_M * m.jerk.fixed_rows::<3>(3).norm());
        self.errs_as().error_of_place() * dt.powi(3) * motions.map(jerk).fold(0.0, f64::max)
    }
}

/// A degree of freedom and what the steps of a run make of its motion.
#[derive(Clone, Debug, PartialEq)]
pub struct WorstFollowed {
    /// The body, as written.
    pub body: String,
    /// The degree of freedom.
    pub dof: &'static str,
    /// The period of its motion (s).
    pub period: f64,
    /// What the scheme makes of that.
    pub distortion: Distortion,
}

/// What a run has seen of its own steps.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Accuracy {
    /// Largest error of place of a step (m), estimated from the change of the acceleration; when (s) and the number of the body.
    pub largest: (f64, f64, usize),
    time: f64,
    /// Of each degree of freedom: the integrals of v, v^2, a^2 and (h a)^2.
    sums: Vec<[f64; 4]>,
}

impl Accuracy {
    /// Takes a step (s) that was accepted.
    pub(super) fn take(
        &mut self,
        nodes: &[SystemBody],
        motions: &[BodyMotion],
        method: &Method,
        (now, dt): (f64, f64),
    ) {
        self.sums.resize(6 * nodes.len(), [0.0; 4]);
        self.time += dt;
        for (body, ((node, motion), sums)) in nodes.iter().zip(motions).zip(self.sums.chunks_exact_mut(6)).enumerate() {
            if node.prescribed.is_some() {
                continue;
            }
            for (sum, (v, a)) in sums.iter_mut().zip(motion.velocity.iter().zip(motion.acceleration.iter())) {
                let more = [dt * v, dt * v * v, dt * a * a, dt * (dt * a).powi(2)];
                sum.iter_mut().zip(more).for_each(|(s, m)| *s += m);
            }
            let error = method.error_of_step(std::iter::once(motion), dt);
            if error > self.largest.0 {
                self.largest = (error, now, body);
            }
        }
    }

    /// The degree of freedom that its scheme follows worst, of those that move enough to count; none where nothing moves.
    pub(super) fn worst(&self, system: &System, motions: &[BodyMotion], method: &Method) -> Option<WorstFollowed> {
        // integrals of the squares of the velocity without its mean
        let moved = |[v, vv, ..]: &[f64; 4]| if self.time > 0.0 { (vv - v * v / self.time).max(0.0) } else { 0.0 };
        let arms: Vec<Six> = system.nodes.iter().zip(motions).map(|(n, m)| arms(n, m)).collect();
        let speed = |at: usize| arms[at / 6][at % 6] * moved(&self.sums[at]).sqrt();
        let fastest = (0..self.sums.len()).map(speed).fold(0.0, f64::max);
        if fastest <= STANDSTILL_VELOCITY * self.time.sqrt() {
            return None;
        }
        let of = |at: usize| {
            let own = (6 * (at / 6)..6 * (at / 6) + 6).map(speed).fold(0.0, f64::max);
            let (node, [_, _, aa, haha]) = (system.nodes.get(at / 6)?, self.sums.get(at)?);
            if speed(at) < (MIN_JUDGED_VELOCITY_SHARE * own).max(COUNTS_AMONG_ALL * fastest) || *aa <= 0.0 {
                return None;
            }
            let square = moved(self.sums.get(at)?);
            let distortion = method.errs_as().distortion((haha / square).sqrt());
            let dof = DOFS.get(at % 6)?;
            Some(WorstFollowed { body: node.name.clone(), dof, period: TAU * (square / aa).sqrt(), distortion })
        };
        let worse =
            |a: WorstFollowed, b: WorstFollowed| if b.distortion.measure() > a.distortion.measure() { b } else { a };
        (0..self.sums.len()).filter_map(of).reduce(worse)
    }

    /// As numbers, of which [`Accuracy::from_numbers`] makes it again.
    pub(super) fn numbers(&self) -> Vec<f64> {
        let (error, at, body) = self.largest;
        [error, at, body as f64, self.time].into_iter().chain(self.sums.iter().flatten().copied()).collect()
    }

    /// Of its numbers; none of what are not such.
    pub(super) fn from_numbers(numbers: &[f64]) -> Option<Self> {
        let ([error, at, body, time], rest) = numbers.split_first_chunk::<4>()?;
        let (sums, left) = rest.as_chunks::<4>();
        left.is_empty().then(|| Accuracy { largest: (*error, *at, *body as usize), time: *time, sums: sums.to_vec() })
    }
}

/// What makes a velocity of each degree of freedom: 1 of translations, the radii of gyration of rotations (m); 0 where nothing has inertia.
fn arms(node: &SystemBody, motion: &BodyMotion) -> Six {
    let mass = mass_block(&node.floating.mass, &motion.pose) + node.floating.added_mass(&motion.pose);
    let heaviest = (0..3).map(|i| mass[(i, i)]).fold(0.0, f64::max);
    Six::from_fn(|i, _| match mass[(i, i)] {
        own if own <= 0.0 => 0.0,
        _ if i < 3 => 1.0,
        own if heaviest > 0.0 => (own / heaviest).sqrt(),
        _ => 0.0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scheme_period_and_damping_match_amplification_matrix() {
        // eigenvalues by numpy of the matrix of the form of [CHUNG-HULBERT-1993], M a(n+1-am) + K d(n+1-af) = 0 with Newmark's d and v
        for (rho, steps, period, damping) in [
            (0.9, 20.0, 0.008273, 0.000002),
            (0.9, 10.0, 0.032472, 0.000017),
            (0.5, 10.0, 0.046715, 0.003780),
            (0.2, 20.0, 0.023147, 0.003954),
            (0.2, 10.0, 0.080910, 0.022552),
            (0.2, 5.0, 0.247201, 0.083954),
        ] {
            let made = TimeScheme::generalised_alpha(rho).distortion(TAU / steps);
            // they are printed to a millionth
            assert!(
                (made.period - period).abs() < 6e-7 && (made.damping - damping).abs() < 6e-7,
                "{rho} {steps} {made:?}"
            );
        }
        // tan(W h/2) = w h/2 [HUGHES-1987 9.1]
        for angle in [0.01f64, 0.5, 4.0] {
            let made = TimeScheme::newmark(0.25, 0.5).distortion(angle);
            let exact = angle / (2.0 * (0.5 * angle).atan()) - 1.0;
            assert!((made.period - exact).abs() < 1e-9 && made.damping.abs() < 1e-9, "{angle} {made:?}");
        }
    }

    #[test]
    fn accuracy_table_reads_back_from_its_numbers() {
        let made = Accuracy { largest: (0.1, 2.0, 1), time: 3.0, sums: vec![[1.0, 2.0, 3.0, 4.0]; 6] };
        assert_eq!(Accuracy::from_numbers(&made.numbers()), Some(made.clone()));
        assert_eq!(Accuracy::from_numbers(&made.numbers()[..5]), None);
    }
}
