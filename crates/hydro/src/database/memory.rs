//! The memory of radiated waves in time: the convolution of a kernel with the velocities of a body.
//!
//! `F(t) = -int_0^T K(s) v(t - s) ds` is exact for velocities that go straight between the ends of steps: with `K1 = int_0^s K` and
//! `K2 = int_0^s K1` the part between two lags a and b takes of the velocity at a `(K2(b) - K2(a))/(b - a) - K1(a)`, of that at b
//! `K1(b) - (K2(b) - K2(a))/(b - a)` (Filon's idea). What motions much slower than the kernel feel is then `int K`, whatever the step: a sum of
//! samples of the kernel would leave them a damping that grows with the square of the step.
//!
//! Velocities are kept at the times of a grid, so that steps need not be those of the grid; inner velocities of it take the second difference of K2
//! over its step, which is tabulated at multiples of the step and a cubic of four of them between. The part from the end of the last step to that of
//! the present one is straight, too, and its share of the trial's velocity is a matrix of damping.

use multiversion::multiversion;
use nalgebra::Matrix6;
use windlass_base::pose::Six;

/// The most lags of a kernel.
pub const MAX_LAGS: usize = 20_000;

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
const RINGS_START: usize = 52;
/// A time this near another, over the step of the grid, is the same.
const EQUAL_TIMES_SHARE: f64 = 1e-6;

/// One pair of directions whose kernel is not nothing.
#[derive(Clone, Debug, PartialEq)]
struct DirectionPair {
    row: usize,
    column: usize,
    /// What a velocity of the grid takes by its lag in steps, from one step on.
    weights: Vec<f64>,
}

impl DirectionPair {
    /// The weights from a number on; beyond the kernel nothing is left.
    fn weights_from(&self, from: usize) -> &[f64] {
        self.weights.get(from..).unwrap_or_default()
    }
}

/// A kernel and its integrals at a lag.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct KernelIntegrals {
    /// K.
    kernel: Matrix6<f64>,
    /// K1.
    first: Matrix6<f64>,
    /// K2.
    second: Matrix6<f64>,
}

/// The integrals of a kernel over its length, after which it is nothing.
#[derive(Clone, Debug, PartialEq)]
struct Integrals {
    /// Between two of the list (s).
    step: f64,
    list: Vec<KernelIntegrals>,
}

impl Integrals {
    /// By Simpson's rule and the value in the middle of each part.
    fn new(kernel: &dyn Fn(f64) -> Matrix6<f64>, length: f64, step: f64) -> Self {
        let count = (length / step).ceil().clamp(1.0, MAX_LAGS as f64);
        let step = length / count;
        let mut now = KernelIntegrals { kernel: kernel(0.0), ..KernelIntegrals::default() };
        let mut list = vec![now];
        for n in 1..=count as usize {
            let end = n as f64 * step;
            let (middle, last) = (kernel(end - 0.5 * step), kernel(end));
            // int K (end - s) ds, of which the last value has no share
            now.second += now.first * step + (now.kernel + middle * 2.0) * (step * step / 6.0);
            now.first += (now.kernel + middle * 4.0 + last) * (step / 6.0);
            now.kernel = last;
            list.push(now);
        }
        Integrals { step, list }
    }

    /// K1 and K2 at a lag (s): polynomials with the values and slopes of both neighbours.
    fn integrals_at_lag(&self, lag: f64) -> (Matrix6<f64>, Matrix6<f64>) {
        let position = lag / self.step;
        let (Some(a), Some(b)) = (self.list.get(position as usize), self.list.get(position as usize + 1)) else {
            let end = self.list.last().copied().unwrap_or_default();
            let beyond = lag - (self.list.len() - 1) as f64 * self.step;
            return (end.first, end.second + end.first * beyond);
        };
        let (h, x) = (self.step, position - position.floor());
        let (x2, x3) = (x * x, x * x * x);
        let first = a.first
            + (b.first - a.first) * (3.0 * x2 - 2.0 * x3)
            + a.kernel * (h * (x - 2.0 * x2 + x3))
            + b.kernel * (h * (x3 - x2));
        let (x4, x5) = (x2 * x2, x2 * x3);
        let second = a.second
            + (b.second - a.second) * (10.0 * x3 - 15.0 * x4 + 6.0 * x5)
            + a.first * (h * (x - 6.0 * x3 + 8.0 * x4 - 3.0 * x5))
            + b.first * (h * (-4.0 * x3 + 7.0 * x4 - 3.0 * x5))
            + a.kernel * (h * h * 0.5 * (x2 - 3.0 * x3 + 3.0 * x4 - x5))
            + b.kernel * (h * h * 0.5 * (x3 - 2.0 * x4 + x5));
        (first, second)
    }

    /// What a velocity that goes straight between two lags (s) makes: by that at the shorter lag, by that at the longer one.
    fn straight(&self, from: f64, to: f64) -> (Matrix6<f64>, Matrix6<f64>) {
        let ((near, first), (far, second)) = (self.integrals_at_lag(from), self.integrals_at_lag(to));
        let mean = (second - first) / (to - from);
        (mean - near, far - mean)
    }
}

/// A kernel ready to be convolved.
#[derive(Clone, Debug, PartialEq)]
pub struct RetardationMemory {
    /// Between the times of the grid (s).
    step: f64,
    /// Velocities of the grid that it keeps.
    lags: usize,
    integrals: Integrals,
    pairs: Vec<DirectionPair>,
}

impl RetardationMemory {
    /// A kernel (N/m, N, N m) over a length (s) with a grid of a step (s); within `fine` (s) it is as good as a cubic. Pairs of directions below 1e-9
    /// of their diagonals are nothing: planes of symmetry. So are those of a direction whose own is below 1e-18 of the largest of the three
    /// translations or rotations, as of the yaw of a round body: radiated power is never negative, so that no pair is above the geometric mean of
    /// its diagonals.
    pub fn new(kernel: &dyn Fn(f64) -> Matrix6<f64>, (fine, length): (f64, f64), step: f64) -> Self {
        let integrals = Integrals::new(kernel, length, fine);
        let size = |i: usize| integrals.list.iter().map(|m| m.kernel[(i, i)].abs()).fold(0.0, f64::max);
        let sizes: [f64; 6] = std::array::from_fn(size);
        let radiates = |i: usize| {
            let kind = if i < 3 { &sizes[..3] } else { &sizes[3..] };
            sizes[i] > 1e-18 * kind.iter().copied().fold(0.0, f64::max)
        };
        let limit = |row: usize, column: usize| {
            (radiates(row) && radiates(column)).then(|| 1e-9 * (sizes[row] * sizes[column]).sqrt())
        };
        RetardationMemory::of_pairs(integrals, length, step, &limit)
    }

    /// The same of forces on one body by velocities of another, between which every pair of directions may be the largest: pairs below 1e-9 of the
    /// largest of their kind are nothing.
    pub fn between_bodies(kernel: &dyn Fn(f64) -> Matrix6<f64>, (fine, length): (f64, f64), step: f64) -> Self {
        let integrals = Integrals::new(kernel, length, fine);
        let largest = |rows: usize, columns: usize| {
            let blocks = integrals.list.iter().map(|m| m.kernel.fixed_view::<3, 3>(rows, columns).amax());
            blocks.fold(0.0, f64::max)
        };
        let sizes = [[largest(0, 0), largest(0, 3)], [largest(3, 0), largest(3, 3)]];
        let limit = |row: usize, column: usize| Some(1e-9 * sizes[row / 3][column / 3]);
        RetardationMemory::of_pairs(integrals, length, step, &limit)
    }

    /// The pairs of directions whose kernel is above a limit somewhere; none: nothing.
    fn of_pairs(integrals: Integrals, length: f64, step: f64, limit: &dyn Fn(usize, usize) -> Option<f64>) -> Self {
        let lags = (length / step).ceil().clamp(1.0, MAX_LAGS as f64) as usize + 1;
        let seconds: Vec<Matrix6<f64>> =
            (0..=lags + 1).map(|n| integrals.integrals_at_lag(n as f64 * step).1).collect();
        let mut pairs = Vec::new();
        for row in 0..6 {
            for column in 0..6 {
                let Some(limit) = limit(row, column) else { continue };
                let at = (row, column);
                if integrals.list.iter().any(|m| m.kernel[at].abs() > limit) {
                    let of = |w: &[Matrix6<f64>]| match w {
                        [a, b, c] => (a[at] - 2.0 * b[at] + c[at]) / step,
                        _ => 0.0,
                    };
                    pairs.push(DirectionPair { row, column, weights: seconds.windows(3).map(of).collect() });
                }
            }
        }
        RetardationMemory { step, lags, integrals, pairs }
    }

    /// Number of values it remembers.
    pub fn states(&self) -> usize {
        RINGS_START + 12 * self.lags
    }

    /// Number of pairs of directions that are convolved.
    pub fn pairs(&self) -> usize {
        self.pairs.len()
    }

    /// Prepares a step, in a state of [`RetardationMemory::states`] values, that ends at a time (s) and is so long (s): what is past is summed once. Before the first step the velocity has come from
    /// nothing over one step of the grid.
    pub fn begin(&self, time: f64, dt: f64, state: &mut [f64]) {
        let (head, rings) = state.split_at_mut(RINGS_START);
        if head[STARTED] == 0.0 {
            (head[TIME], head[GRID]) = (time - dt, time - dt);
        }
        let dt = (time - head[TIME]).max(0.0);
        let (last, newest) = (six(head, LAST), head[HEAD] as usize);
        let (mut past, mut of_trial) = (Six::zeros(), Matrix6::zeros());
        let same = EQUAL_TIMES_SHARE * self.step;
        if dt > same {
            let of_last;
            (of_trial, of_last) = self.integrals.straight(0.0, dt);
            past += of_last * last;
        }
        // from the end of the last step to the newest velocity of the grid, and from there to the next
        let first = Six::from_fn(|j, _| ring(rings, j, self.lags, newest)[0]);
        let mut near = dt;
        let since = head[TIME] - head[GRID];
        if since > same {
            let (of_last, of_first) = self.integrals.straight(dt, dt + since);
            past += of_last * last + of_first * first;
            near = dt + since;
        }
        past += self.integrals.straight(near, near + self.step).0 * first;
        self.convolve(near, (rings, newest), &mut past);
        head[PAST..PRESENT].copy_from_slice(past.as_slice());
        head[PRESENT..RINGS_START].copy_from_slice(of_trial.as_slice());
    }

    /// Adds what the velocities of the grid make but the newest, whose lag is given (s).
    fn convolve(&self, near: f64, (rings, newest): (&[f64], usize), past: &mut Six) {
        let position = near / self.step;
        let whole = position.round();
        let slice = |pair: &DirectionPair| &ring(rings, pair.column, self.lags, newest)[1..];
        // the weight of a lag of n steps is number n - 1
        if (position - whole).abs() < EQUAL_TIMES_SHARE {
            for pair in &self.pairs {
                past[pair.row] += dot(pair.weights_from(whole as usize), slice(pair));
            }
            return;
        }
        let (whole, share) = (position as usize, position - position.floor());
        // between one step and two there is no weight on the other side of the first
        let direct = usize::from(whole == 0);
        if direct == 1 {
            let lag = near + self.step;
            let [before, at, after] = [near, lag, lag + self.step].map(|lag| self.integrals.integrals_at_lag(lag).1);
            let weight = (before - at * 2.0 + after) / self.step;
            for pair in &self.pairs {
                past[pair.row] += weight[(pair.row, pair.column)] * slice(pair)[0];
            }
        }
        // the cubic through the weights of one lag before, two around and one behind
        let (x, y) = (share, 1.0 - share);
        let cubic = [
            -x * y * (1.0 + y) / 6.0,
            y * (1.0 + x) * (1.0 + y) / 2.0,
            x * (1.0 + x) * (1.0 + y) / 2.0,
            -x * y * (1.0 + x) / 6.0,
        ];
        for pair in &self.pairs {
            let velocities = &slice(pair)[direct..];
            for (n, factor) in cubic.into_iter().enumerate() {
                let from = (whole + direct + n).saturating_sub(1);
                past[pair.row] += factor * dot(pair.weights_from(from), velocities);
            }
        }
    }

    /// The force at a trial of the end of the step (N, N m; body axes), and its change with the velocity, -dF/dv.
    pub fn force(&self, velocity: &Six, state: &[f64]) -> (Six, Matrix6<f64>) {
        let damping = Matrix6::from_column_slice(&state[PRESENT..RINGS_START]);
        (-(six(state, PAST) + damping * velocity), damping)
    }

    /// The step is accepted: it ended at a time (s) with a velocity.
    pub fn commit(&self, time: f64, dt: f64, velocity: &Six, state: &mut [f64]) {
        let (head, rings) = state.split_at_mut(RINGS_START);
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
        while head[GRID] + self.step < time + EQUAL_TIMES_SHARE * self.step {
            let next = head[GRID] + self.step;
            if (next - time).abs() < EQUAL_TIMES_SHARE * self.step {
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
        let position = (head[HEAD] as usize + self.lags - 1) % self.lags;
        head[HEAD] = position as f64;
        for (ring, value) in rings.chunks_exact_mut(2 * self.lags).zip(velocity.iter()) {
            ring[position] = *value;
            ring[position + self.lags] = *value;
        }
    }
}

/// The velocities of a direction, newest first.
fn ring(rings: &[f64], direction: usize, lags: usize, newest: usize) -> &[f64] {
    let from = 2 * lags * direction + newest;
    &rings[from..from + lags]
}

/// Six values of a state.
fn six(state: &[f64], at: usize) -> Six {
    Six::from_column_slice(&state[at..at + 6])
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

#[cfg(test)]
mod tests {
    use super::*;

    /// K(t) = exp(-t), of which the memory of any velocity is known.
    fn exponential(step: f64) -> RetardationMemory {
        RetardationMemory::new(&|t| Matrix6::identity() * (-t).exp(), (0.05, 30.0), step)
    }

    /// The force in surge after steps of given lengths, with the velocity of a time.
    fn run(memory: &RetardationMemory, steps: &[f64], velocity: fn(f64) -> f64) -> f64 {
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
    fn memory_of_sine_matches_its_integral() {
        // int_0^t exp(-s) sin(t - s) ds = (sin t - cos t + exp(-t)) / 2; straight velocities err by h^2/12 of it: 6e-4 for h = 0.1
        let exact = -0.5 * (8.0f64.sin() - 8.0f64.cos() + (-8.0f64).exp());
        let at = |h: f64| run(&exponential(h), &vec![h; (8.0 / h).round() as usize], f64::sin);
        let (coarse, fine) = (at(0.1) - exact, at(0.05) - exact);
        assert!(coarse.abs() < 1e-3, "{coarse}");
        assert!((coarse / fine - 4.0).abs() < 0.1, "{coarse} {fine}");
    }

    #[test]
    fn memory_of_linear_velocity_is_exact_at_any_step() {
        // int_0^t exp(-s) 2 (t - s) ds = 2 (t - 1 + exp(-t))
        let exact = |t: f64| -2.0 * (t - 1.0 + (-t).exp());
        let uneven: Vec<f64> = [0.03, 0.07, 0.11, 0.04, 0.15].into_iter().cycle().take(100).collect();
        for (grid, steps) in
            [(0.1, vec![0.1; 80]), (1.0, vec![1.0; 8]), (0.4, vec![0.8; 10]), (0.05, uneven.clone()), (0.15, uneven)]
        {
            let time = steps.iter().sum();
            let got = run(&exponential(grid), &steps, |t| 2.0 * t);
            // the cubic through weights of exp(-t) 0.15 apart errs by 3/128 0.15^4 of it
            assert!((got - exact(time)).abs() < 1.2e-5 * exact(time).abs(), "{grid}: {got} for {}", exact(time));
        }
    }

    #[test]
    fn steps_off_the_grid_give_same_memory() {
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
    fn eight_lane_sums_match_plain_sums() {
        let list = |n: usize, rate: f64| (0..n).map(|i| (rate * i as f64).sin()).collect::<Vec<f64>>();
        for (count, values) in [(0, 9), (1, 9), (8, 8), (9, 8), (17, 17), (100, 103), (103, 100)] {
            let (weights, values) = (list(count, 0.7), list(values, 0.3));
            let plain = weights.iter().zip(&values).map(|(a, b)| a * b).sum::<f64>();
            // another order of some hundred sums of numbers up to 1
            assert!((dot(&weights, &values) - plain).abs() < 1e-14, "{count}");
        }
    }

    #[test]
    fn planes_of_symmetry_leave_few_pairs() {
        let mut kernel = Matrix6::from_diagonal_element(1.0);
        (kernel[(0, 4)], kernel[(4, 0)], kernel[(1, 3)], kernel[(3, 1)]) = (0.2, 0.2, -0.2, -0.2);
        kernel[(0, 1)] = 1e-12;
        assert_eq!(RetardationMemory::new(&|_| kernel, (0.1, 0.4), 0.1).pairs(), 10);
        // a round body does not radiate by its yaw, whatever rounding has left there
        (kernel[(5, 5)], kernel[(5, 0)], kernel[(0, 5)]) = (1e-27, 1e-14, 1e-14);
        assert_eq!(RetardationMemory::new(&|_| kernel, (0.1, 0.4), 0.1).pairs(), 9);
    }
}
