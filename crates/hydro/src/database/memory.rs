//! The memory of radiated waves in time: the convolution of a kernel with the velocities of a body.
//!
//! `F(t) = -int_0^T K(s) v(t - s) ds` by the trapezoidal rule on a grid of lags. Velocities are kept at the times of that grid, straight between
//! the ends of steps, so that steps need not be those of the grid; the part from the end of the last step to that of
//! the present one is straight, too, and its share of the trial's velocity is a matrix of damping. Where the steps are those of the grid
//! it is the plain trapezoidal rule. All is in the body's axes.

use multiversion::multiversion;
use nalgebra::Matrix6;
use windlass_base::pose::Six;

/// The most lags of a kernel.
pub const MOST_LAGS: usize = 20_000;

/// Where the parts of the state stand: whether anything has happened, the end of the last step (s), the time of the newest velocity on
/// the grid (s), its place in the rings; velocity at the end of the last step; force of what is past; damping of the present.
const STARTED: usize = 0;
const TIME: usize = 1;
const GRID: usize = 2;
const HEAD: usize = 3;
const LAST: usize = 4;
const PAST: usize = 10;
const PRESENT: usize = 16;
/// After it the rings: velocities of each direction, newest first, twice over so that every window of them is one slice.
const RINGS: usize = 52;
/// A time this near another, over the step of the grid, is the same.
const SAME: f64 = 1e-6;

/// One pair of directions whose kernel is not nothing.
#[derive(Clone, Debug, PartialEq)]
struct Pair {
    row: usize,
    column: usize,
    /// Kernel times step, by lag.
    weights: Vec<f64>,
}

/// A kernel ready to be convolved.
#[derive(Clone, Debug, PartialEq)]
pub struct Memory {
    /// Lag between values of the kernel (s).
    step: f64,
    /// Values of the kernel.
    lags: usize,
    kernel: Vec<Matrix6<f64>>,
    pairs: Vec<Pair>,
}

impl Memory {
    /// A kernel at 0, step, 2 step .. (N/m, N, N m). Pairs of directions below 1e-9 of their diagonals are nothing: planes of symmetry.
    /// So are those of a direction whose own is below 1e-18 of the largest of the three translations or rotations, as of the yaw of
    /// a round body: radiated power is never negative, so that no pair is above the geometric mean of its diagonals.
    pub fn new(kernel: &[Matrix6<f64>], step: f64) -> Self {
        let size = |i: usize| kernel.iter().map(|k| k[(i, i)].abs()).fold(0.0, f64::max);
        let sizes: [f64; 6] = std::array::from_fn(size);
        let radiates = |i: usize| {
            let kind = if i < 3 { &sizes[..3] } else { &sizes[3..] };
            sizes[i] > 1e-18 * kind.iter().copied().fold(0.0, f64::max)
        };
        let mut pairs = Vec::new();
        for (row, of_row) in sizes.iter().enumerate().filter(|(i, _)| radiates(*i)) {
            for (column, of_column) in sizes.iter().enumerate().filter(|(i, _)| radiates(*i)) {
                let limit = 1e-9 * (of_row * of_column).sqrt();
                if kernel.iter().any(|k| k[(row, column)].abs() > limit) {
                    let weights = kernel.iter().map(|k| k[(row, column)] * step).collect();
                    pairs.push(Pair { row, column, weights });
                }
            }
        }
        Memory { step, lags: kernel.len(), kernel: kernel.to_vec(), pairs }
    }

    /// Number of values it remembers.
    pub fn states(&self) -> usize {
        RINGS + 12 * self.lags
    }

    /// Number of pairs of directions that are convolved.
    pub fn pairs(&self) -> usize {
        self.pairs.len()
    }

    /// The kernel at a lag (s), straight between its values; nothing beyond them.
    fn kernel_at(&self, lag: f64) -> Matrix6<f64> {
        let (index, share) = self.place(lag);
        match (self.kernel.get(index), self.kernel.get(index + 1)) {
            (Some(a), Some(b)) => a + (b - a) * share,
            (Some(a), None) if share == 0.0 => *a,
            _ => Matrix6::zeros(),
        }
    }

    /// The value of the kernel before a lag (s), and the share of the next.
    fn place(&self, lag: f64) -> (usize, f64) {
        let place = lag / self.step;
        let near = place.round();
        if (place - near).abs() < SAME {
            return (near as usize, 0.0);
        }
        (place as usize, place - place.floor())
    }

    /// Prepares a step that ends at a time (s) and is so long (s): what is past is summed once.
    pub fn begin(&self, time: f64, dt: f64, state: &mut [f64]) {
        if state.len() < self.states() {
            return;
        }
        let (head, rings) = state.split_at_mut(RINGS);
        if head[STARTED] == 0.0 {
            (head[TIME], head[GRID]) = (time - dt, time - dt);
        }
        let dt = (time - head[TIME]).max(0.0);
        let last = six(head, LAST);
        let (of_last, of_trial) = self.present(dt);
        let newest = head[HEAD] as usize;
        let since = (head[TIME] - head[GRID]).max(0.0);
        let first = Six::from_fn(|j, _| ring(rings, j, self.lags, newest).first().copied().unwrap_or(0.0));
        // from the newest velocity of the grid to the end of the last step, both ends with half their width
        let far = self.kernel_at(dt + since);
        let mut past = of_last * last + (self.kernel_at(dt) * last + far * first) * (0.5 * since);
        past -= far * first * (0.5 * self.step);
        let (lag, share) = self.place(dt + since);
        for pair in &self.pairs {
            let velocities = ring(rings, pair.column, self.lags, newest);
            let weights = pair.weights.get(lag..).unwrap_or_default();
            let mut sum;
            if share > 0.0 {
                let next;
                [sum, next] = two_dots(weights, velocities);
                sum += share * (next - sum);
            } else {
                sum = dot(weights, velocities);
            }
            past[pair.row] += sum;
        }
        head[PAST..PRESENT].copy_from_slice(past.as_slice());
        head[PRESENT..RINGS].copy_from_slice(of_trial.as_slice());
    }

    /// What a velocity that goes straight over a step (s) from one to another makes: by the first, by the second.
    fn present(&self, dt: f64) -> (Matrix6<f64>, Matrix6<f64>) {
        let (mut of_last, mut of_trial) = (Matrix6::zeros(), Matrix6::zeros());
        let mut from = 0.0;
        for n in 1..=self.lags {
            let end = n as f64 * self.step;
            let to = if end > dt - SAME * self.step { dt } else { end };
            if to <= from {
                break;
            }
            for lag in [from, to] {
                let kernel = self.kernel_at(lag) * (0.5 * (to - from));
                of_last += kernel * (lag / dt);
                of_trial += kernel * (1.0 - lag / dt);
            }
            from = to;
        }
        (of_last, of_trial)
    }

    /// The force at a trial of the end of the step (body axes), and its change with the velocity, -dF/dv.
    pub fn force(&self, velocity: &Six, state: &[f64]) -> (Six, Matrix6<f64>) {
        let damping = Matrix6::from_iterator((PRESENT..RINGS).map(|i| state.get(i).copied().unwrap_or(0.0)));
        (-(six(state, PAST) + damping * velocity), damping)
    }

    /// The step is accepted: it ended at a time (s) with a velocity.
    pub fn commit(&self, time: f64, dt: f64, velocity: &Six, state: &mut [f64]) {
        if state.len() < self.states() {
            return;
        }
        let (head, rings) = state.split_at_mut(RINGS);
        if head[STARTED] == 0.0 {
            (head[STARTED], head[TIME], head[GRID]) = (1.0, time - dt, time - dt);
            if dt == 0.0 {
                self.push(velocity, head, rings);
            }
        }
        let (before, last) = (head[TIME], six(head, LAST));
        // more than the rings hold need not be filled in
        let most = self.lags as f64 * self.step;
        head[GRID] = head[GRID].max(time - most);
        while head[GRID] + self.step < time + SAME * self.step {
            let next = head[GRID] + self.step;
            if (next - time).abs() < SAME * self.step {
                head[GRID] = time;
                self.push(velocity, head, rings);
                break;
            }
            let share = ((next - before) / (time - before)).clamp(0.0, 1.0);
            head[GRID] = next;
            self.push(&(last + (velocity - last) * share), head, rings);
        }
        head[TIME] = time;
        head[LAST..PAST].copy_from_slice(velocity.as_slice());
    }

    /// Puts a velocity before all others.
    fn push(&self, velocity: &Six, head: &mut [f64], rings: &mut [f64]) {
        let place = (head[HEAD] as usize + self.lags - 1) % self.lags;
        head[HEAD] = place as f64;
        for (ring, value) in rings.chunks_exact_mut(2 * self.lags).zip(velocity.iter()) {
            ring[place] = *value;
            ring[place + self.lags] = *value;
        }
    }
}

/// The velocities of a direction, newest first.
fn ring(rings: &[f64], direction: usize, lags: usize, newest: usize) -> &[f64] {
    let from = 2 * lags * direction + newest;
    rings.get(from..from + lags).unwrap_or_default()
}

/// Six values of a state.
fn six(state: &[f64], at: usize) -> Six {
    Six::from_fn(|i, _| state.get(at + i).copied().unwrap_or(0.0))
}

/// The sum of products, in eight sums side by side so that it runs in vectors, the widest of the machine; the order is fixed.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let count = a.len().min(b.len());
    let (a, b) = (&a[..count], &b[..count]);
    let mut sums = [0.0; 8];
    let ((a, rest_of_a), (b, rest_of_b)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    for (a, b) in a.iter().zip(b) {
        for n in 0..8 {
            sums[n] += a[n] * b[n];
        }
    }
    let rest: f64 = rest_of_a.iter().zip(rest_of_b).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

/// The sum of products of weights with values, and of the weights from the second on with the same values.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn two_dots(weights: &[f64], values: &[f64]) -> [f64; 2] {
    let mut sums = [[0.0; 8]; 2];
    let from_second = weights.get(1..).unwrap_or_default();
    let count = from_second.len().min(values.len());
    let (values, behind) = values.split_at(count);
    let (first, second) = (weights.get(..count).unwrap_or_default(), &from_second[..count]);
    let (first, of_first) = first.as_chunks::<8>();
    let (second, of_second) = second.as_chunks::<8>();
    let (values, rest) = values.as_chunks::<8>();
    for ((first, second), values) in first.iter().zip(second).zip(values) {
        for n in 0..8 {
            sums[0][n] += first[n] * values[n];
            sums[1][n] += second[n] * values[n];
        }
    }
    let mut made = sums.map(|sum| sum.iter().sum::<f64>());
    for ((first, second), value) in of_first.iter().zip(of_second).zip(rest) {
        made = [made[0] + first * value, made[1] + second * value];
    }
    if let (Some(weight), Some(value)) = (weights.get(count), behind.first()) {
        made[0] += weight * value;
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;

    /// K(t) = exp(-t), of which the memory of any velocity is known.
    fn exponential(step: f64) -> Memory {
        let kernel: Vec<Matrix6<f64>> =
            (0..(30.0 / step) as usize).map(|n| Matrix6::identity() * (-step * n as f64).exp()).collect();
        Memory::new(&kernel, step)
    }

    /// The force in surge after steps of given lengths, with the velocity of a time.
    fn run(memory: &Memory, steps: &[f64], velocity: fn(f64) -> f64) -> f64 {
        let mut state = vec![0.0; memory.states()];
        let six = |t: f64| Six::new(velocity(t), 0.0, 0.0, 0.0, 0.0, 0.0);
        memory.begin(0.0, 0.0, &mut state);
        memory.commit(0.0, 0.0, &six(0.0), &mut state);
        let mut time = 0.0;
        let mut force = 0.0;
        for dt in steps {
            time += dt;
            memory.begin(time, *dt, &mut state);
            // a step that is given up leaves no trace
            memory.begin(time - 0.3 * dt, 0.7 * dt, &mut state);
            memory.begin(time, *dt, &mut state);
            force = memory.force(&six(time), &state).0[0];
            memory.commit(time, *dt, &six(time), &mut state);
        }
        force
    }

    #[test]
    fn the_memory_of_a_sine_is_that_of_the_integral() {
        // int_0^t exp(-s) sin(t - s) ds = (sin t - cos t + exp(-t)) / 2; the trapezoidal rule errs by h^2/12 of the slopes: 1e-3 for h = 0.1
        let exact = -0.5 * (8.0f64.sin() - 8.0f64.cos() + (-8.0f64).exp());
        let at = |h: f64| run(&exponential(h), &vec![h; (8.0 / h).round() as usize], f64::sin);
        let (coarse, fine) = (at(0.1) - exact, at(0.05) - exact);
        assert!(coarse.abs() < 1e-3, "{coarse}");
        assert!((coarse / fine - 4.0).abs() < 0.1, "{coarse} {fine}");
    }

    #[test]
    fn steps_that_are_not_those_of_the_kernel_give_the_same_memory() {
        let exact = -0.5 * (8.0f64.sin() - 8.0f64.cos() + (-8.0f64).exp());
        let memory = exponential(0.05);
        let uneven: Vec<f64> = [0.03, 0.07, 0.11, 0.04, 0.15].into_iter().cycle().take(100).collect();
        let (finer, coarser) = (vec![0.02; 400], vec![0.2; 40]);
        // straight velocities over steps of up to 0.2 err by 0.2^2/12 = 3e-3
        for steps in [&uneven, &finer, &coarser] {
            let off = run(&memory, steps, f64::sin) - exact;
            assert!(off.abs() < 3e-3, "{off}");
        }
    }

    #[test]
    fn two_sums_at_once_are_those_of_each() {
        let list = |n: usize, rate: f64| (0..n).map(|i| (rate * i as f64).sin()).collect::<Vec<f64>>();
        for (count, values) in [(0, 9), (1, 9), (8, 8), (9, 8), (17, 17), (100, 103), (103, 100)] {
            let (weights, values) = (list(count, 0.7), list(values, 0.3));
            let plain = |from: usize| weights.iter().skip(from).zip(&values).map(|(a, b)| a * b).sum::<f64>();
            let [first, second] = two_dots(&weights, &values);
            // another order of some hundred sums of numbers up to 1
            assert!((first - plain(0)).abs() < 1e-14 && (second - plain(1)).abs() < 1e-14, "{count}");
            assert!((dot(&weights, &values) - plain(0)).abs() < 1e-14, "{count}");
        }
    }

    #[test]
    fn planes_of_symmetry_leave_few_pairs() {
        let mut kernel = Matrix6::from_diagonal_element(1.0);
        (kernel[(0, 4)], kernel[(4, 0)], kernel[(1, 3)], kernel[(3, 1)]) = (0.2, 0.2, -0.2, -0.2);
        kernel[(0, 1)] = 1e-12;
        assert_eq!(Memory::new(&[kernel; 4], 0.1).pairs(), 10);
        // a round body does not radiate by its yaw, whatever rounding has left there
        (kernel[(5, 5)], kernel[(5, 0)], kernel[(0, 5)]) = (1e-27, 1e-14, 1e-14);
        assert_eq!(Memory::new(&[kernel; 4], 0.1).pairs(), 9);
    }
}
