//! A viscoelastic spring: a lasting spring beside Maxwell branches (a Prony series), fitted to a convolution curve.
//!
//! Source: [MOSES-FLEX -CONVOLUTION] and the reading [W-VISCOUS] of `&DATA CONVOLUTION`: the force is the integral of K(s) v(t - s) ds, v the rate of
//! the deflection. With K(s) = K_inf + sum k_i exp(-s / tau_i) each branch has one force as its memory, and the step below is
//! exact for a deflection that runs evenly over it [SIMO-HUGHES-1998 10.3].

use nalgebra::{DMatrix, DVector};
use windlass_base::dense::{Cholesky, never};
use windlass_model::{Curve, CurveKind};

/// One branch: a spring and a dashpot in line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maxwell {
    /// Stiffness of its spring (N/m or N m/rad).
    pub stiffness: f64,
    /// Time in which its force falls to 1/e under a held deflection (s).
    pub time: f64,
}

impl Maxwell {
    /// Share of its force that is left after a step, and the mean of that share over the step, both of `dt` (s).
    fn decay(&self, dt: f64) -> (f64, f64) {
        let h = dt / self.time;
        let mean = if h > 0.0 { -(-h).exp_m1() / h } else { 1.0 };
        ((-h).exp(), mean)
    }
}

/// The law: force against the history of the deflection.
///
/// Its state is the force of each branch (N), then the deflection (m), at the end of the last step.
#[derive(Clone, Debug, PartialEq)]
pub struct ViscoelasticLaw {
    /// Stiffness that lasts (N/m or N m/rad), with which statics works.
    pub long_term: f64,
    /// Branches, the shortest time first.
    pub branches: Vec<Maxwell>,
}

/// A law fitted to a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The law.
    pub law: ViscoelasticLaw,
    /// Largest difference between the law and a point of the curve, over the largest stiffness of the curve.
    pub error: f64,
}

/// Force at the end of a step as a line over the deflection there: `slope * deflection + rest`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// N/m or N m/rad.
    pub slope: f64,
    /// N or N m.
    pub rest: f64,
}

impl ViscoelasticLaw {
    /// The law of a convolution curve; `None` for other curves.
    pub fn fit(curve: &Curve) -> Option<Fit> {
        let long_term = curve.long_term_stiffness()?;
        let by_time = curve.kind == CurveKind::ConvolutionTime;
        let points: Vec<(f64, f64)> = curve.points.iter().map(|(x, k)| (*x, k - long_term)).collect();
        // as many branches as there are points beside the one that gives the lasting stiffness
        let count = curve.exponentials.clamp(1, points.len().saturating_sub(1).max(1));
        let branches = fit_branches(&points, count, by_time);
        let law = ViscoelasticLaw { long_term, branches };
        let most = curve.points.iter().fold(f64::MIN_POSITIVE, |m, p| m.max(p.1.abs()));
        let at = |x: f64| if by_time { law.at_time(x) } else { law.at_frequency(x) };
        let error = curve.points.iter().fold(0.0, |m: f64, (x, k)| m.max((at(*x) - k).abs())) / most;
        Some(Fit { law, error })
    }

    /// The same with all stiffnesses times a factor.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        let branches = self.branches.iter().map(|b| Maxwell { stiffness: b.stiffness * factor, ..*b }).collect();
        ViscoelasticLaw { long_term: self.long_term * factor, branches }
    }

    /// K(t), the force after a deflection of one held for a time (s).
    pub fn at_time(&self, time: f64) -> f64 {
        self.long_term + self.branches.iter().map(|b| b.stiffness * (-time / b.time).exp()).sum::<f64>()
    }

    /// Stiffness in phase with a deflection of a frequency (rad/s): the storage modulus.
    pub fn at_frequency(&self, frequency: f64) -> f64 {
        self.long_term + self.branches.iter().map(|b| b.stiffness * storage(frequency * b.time)).sum::<f64>()
    }

    /// Number of values of its state.
    pub fn states(&self) -> usize {
        self.branches.len() + 1
    }

    /// Force (N, N m) at the end of a step (s; `None`: at rest, in statics) against the deflection there (m, rad).
    pub fn step(&self, dt: Option<f64>, committed: &[f64]) -> Affine {
        let mut line = Affine { slope: self.long_term, rest: 0.0 };
        let (Some(dt), Some(before)) = (dt, committed.get(self.branches.len())) else { return line };
        for (branch, force) in self.branches.iter().zip(committed) {
            let (left, mean) = branch.decay(dt);
            line.slope += branch.stiffness * mean;
            line.rest += left * force - branch.stiffness * mean * before;
        }
        line
    }

    /// Writes the state at the end of a step (s) to a deflection (m, rad).
    pub fn advance(&self, dt: Option<f64>, committed: &[f64], deflection: f64, trial: &mut [f64]) {
        let before = committed.get(self.branches.len()).copied().unwrap_or(0.0);
        for ((branch, old), new) in self.branches.iter().zip(committed).zip(trial.iter_mut()) {
            *new = dt.map_or(0.0, |dt| {
                let (left, mean) = branch.decay(dt);
                left * old + branch.stiffness * mean * (deflection - before)
            });
        }
        if let Some(last) = trial.get_mut(self.branches.len()) {
            *last = deflection;
        }
    }
}

/// (w tau)2 / (1 + (w tau)2).
fn storage(x: f64) -> f64 {
    x * x / (1.0 + x * x)
}

/// Places on each side of the first search for the relaxation times.
const SEARCH_POINTS: usize = 16;
/// Halvings of its spacing after it.
const SEARCH_HALVINGS: usize = 24;

/// Branches whose sum comes nearest to the points, by least squares with no negative stiffness: the relaxation times are spaced evenly
/// on a log scale, between ends that are searched for.
fn fit_branches(points: &[(f64, f64)], count: usize, by_time: bool) -> Vec<Maxwell> {
    let positions: Vec<f64> = points.iter().map(|p| p.0).filter(|x| *x > 0.0).collect();
    let (least, most) = positions.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(*x), b.max(*x)));
    if positions.is_empty() {
        return Vec::new();
    }
    // a curve shows nothing of times far outside of its own
    let (low, high) = if by_time { (least / 5.0, most) } else { (0.2 / most, 5.0 / least) };
    let (low, high) = (low.ln(), high.ln());
    let spacing = (high - low) / SEARCH_POINTS as f64;
    let times = |a: f64, b: f64| -> Vec<f64> {
        let share = |i: usize| if count > 1 { i as f64 / (count - 1) as f64 } else { 0.0 };
        (0..count).map(|i| (a + (b - a) * share(i)).exp()).collect()
    };
    let try_with = |a: f64, b: f64| non_negative(points, &times(a, b), by_time);
    let mut best = (f64::INFINITY, low, high, Vec::new());
    let keep = |a: f64, b: f64, best: &mut (f64, f64, f64, Vec<f64>)| {
        let (a, b) = (a.clamp(low, high), b.clamp(low, high));
        let (left, stiffness) = try_with(a, b);
        let better = left < best.0;
        if better {
            *best = (left, a, b, stiffness);
        }
        better
    };
    for i in 0..=SEARCH_POINTS {
        // one branch has one time
        let ends = if count == 1 { i..=i } else { i + 1..=SEARCH_POINTS };
        for j in ends {
            keep(low + i as f64 * spacing, low + j as f64 * spacing, &mut best);
        }
    }
    let mut step = 0.5 * spacing;
    for _ in 0..SEARCH_HALVINGS {
        let (_, a, b, _) = best;
        let around = [(-step, 0.0), (step, 0.0), (0.0, -step), (0.0, step), (-step, -step), (step, step)];
        let moved = around.map(|(da, db)| a + da <= b + db && keep(a + da, b + db, &mut best));
        if !moved.contains(&true) {
            step *= 0.5;
        }
    }
    let (_, a, b, stiffness) = best;
    let branches = times(a, b).into_iter().zip(stiffness).map(|(time, stiffness)| Maxwell { stiffness, time });
    branches.filter(|b| b.stiffness > 0.0).collect()
}

/// Stiffnesses >= 0 of branches with these times that come nearest to the points, and the sum of squares that is left (Lawson and
/// Hanson's active set, on the normal equations).
fn non_negative(points: &[(f64, f64)], times: &[f64], by_time: bool) -> (f64, Vec<f64>) {
    let shape = |x: f64, time: f64| if by_time { (-x / time).exp() } else { storage(x * time) };
    let column = |time: &f64| DVector::from_iterator(points.len(), points.iter().map(|(x, _)| shape(*x, *time)));
    let matrix = DMatrix::from_columns(&times.iter().map(column).collect::<Vec<_>>());
    let wanted = DVector::from_iterator(points.len(), points.iter().map(|p| p.1));
    let (gram, pull) = (matrix.transpose() * &matrix, matrix.transpose() * &wanted);
    let count = times.len();
    let mut found = DVector::zeros(count);
    let mut free: Vec<usize> = Vec::new();
    let small = 1e-12 * pull.amax();
    for _ in 0..3 * count {
        let slope = &pull - &gram * &found;
        let next = (0..count).filter(|i| !free.contains(i)).max_by(|a, b| slope[*a].total_cmp(&slope[*b]));
        let Some(next) = next.filter(|i| slope[*i] > small) else { break };
        free.push(next);
        while let Some(all) = unbound(&gram, &pull, &free) {
            if all.iter().all(|v| *v > 0.0) {
                found.fill(0.0);
                free.iter().zip(&all).for_each(|(i, v)| found[*i] = *v);
                break;
            }
            // as far toward the free answer as none becomes negative; what reaches zero leaves
            let reach = free.iter().zip(&all).filter(|(_, v)| **v <= 0.0);
            let reach = reach.map(|(i, v)| found[*i] / (found[*i] - v)).fold(1.0, f64::min);
            free.iter().zip(&all).for_each(|(i, v)| found[*i] += reach * (v - found[*i]));
            let stay: Vec<usize> = free.iter().copied().filter(|i| found[*i] > 1e-14 * found.amax()).collect();
            (0..count).filter(|i| !stay.contains(i)).for_each(|i| found[i] = 0.0);
            if stay.is_empty() || stay.len() == free.len() {
                break;
            }
            free = stay;
        }
    }
    let left = (&matrix * &found - &wanted).norm_squared();
    (left, found.iter().copied().collect())
}

/// The least-squares answer of some of the unknowns, signs free.
fn unbound(gram: &DMatrix<f64>, pull: &DVector<f64>, free: &[usize]) -> Option<Vec<f64>> {
    let matrix = gram.select_rows(free).select_columns(free);
    let right = pull.select_rows(free);
    let solved = Cholesky::new(matrix, &never).and_then(|factor| factor.solve(&right)).ok()?;
    Some(solved.iter().copied().collect())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use windlass_base::span::Span;

    fn curve(kind: CurveKind, exponentials: usize, points: Vec<(f64, f64)>) -> Curve {
        Curve { name: "C".into(), kind, points, exponentials, metres: 1.0, span: Span::default() }
    }

    #[test]
    fn single_exponential_fit_is_exact_in_time_and_frequency() {
        let (lasting, stiffness, time) = (2e6, 3e6, 4.0);
        // long enough that the last point is the lasting stiffness to the last digits
        let by_time =
            (0..80).map(|i| 2.0 * f64::from(i)).map(|t| (t, lasting + stiffness * (-t / time).exp())).collect();
        let fit = ViscoelasticLaw::fit(&curve(CurveKind::ConvolutionTime, 1, by_time)).unwrap();
        assert!(fit.error < 1e-6 && (fit.law.branches[0].time - time).abs() < 1e-4, "{fit:?}");
        let by_frequency = (0..60)
            .map(|i| 0.05 * f64::from(i))
            .map(|w| (w, lasting + stiffness * (w * time).powi(2) / (1.0 + (w * time).powi(2))))
            .collect();
        let fit = ViscoelasticLaw::fit(&curve(CurveKind::ConvolutionFrequency, 1, by_frequency)).unwrap();
        assert!(fit.error < 1e-6 && (fit.law.branches[0].time - time).abs() < 1e-4, "{fit:?}");
        assert!((fit.law.branches[0].stiffness - stiffness).abs() < 1e-4 * stiffness);
    }

    #[test]
    fn five_exponentials_fit_power_law_within_percent_without_negatives() {
        let points = (0..40).map(|i| 0.1 * 1.2_f64.powi(i)).map(|t| (t, 1e6 * (1.0 + t).powf(-0.4))).collect();
        let fit = ViscoelasticLaw::fit(&curve(CurveKind::ConvolutionTime, 5, points)).unwrap();
        assert!(fit.error < 0.01, "{fit:?}");
        assert!(fit.law.branches.iter().all(|b| b.stiffness > 0.0));
    }

    #[test]
    fn constant_deflection_follows_relaxation_curve() {
        let law = ViscoelasticLaw {
            long_term: 2.0,
            branches: vec![Maxwell { stiffness: 3.0, time: 4.0 }, Maxwell { stiffness: 1.0, time: 0.5 }],
        };
        // a ramp of rate 2 over 3 s in any number of steps: 2 (2 t + 12 (1 - e^-t/4) + 0.5 (1 - e^-2t))
        let want = |t: f64| 2.0 * (2.0 * t + 12.0 * (1.0 - (-t / 4.0).exp()) + 0.5 * (1.0 - (-2.0 * t).exp()));
        for steps in [1, 3, 50] {
            let dt = 3.0 / f64::from(steps);
            let (mut state, mut force) = (vec![0.0; 3], 0.0);
            for i in 1..=steps {
                let deflection = 2.0 * dt * f64::from(i);
                let line = law.step(Some(dt), &state);
                force = line.slope * deflection + line.rest;
                let before = state.clone();
                law.advance(Some(dt), &before, deflection, &mut state);
            }
            assert!((force - want(3.0)).abs() < 1e-12 * want(3.0), "{steps}: {force}");
        }
        // a deflection of one in no time, then held: K(t)
        let mut state = vec![0.0; 3];
        law.advance(Some(1e-12), &[0.0; 3], 1.0, &mut state);
        let line = law.step(Some(2.5), &state);
        assert!((line.slope + line.rest - law.at_time(2.5)).abs() < 1e-11);
        assert_eq!(law.step(None, &state), Affine { slope: 2.0, rest: 0.0 });
    }
}
