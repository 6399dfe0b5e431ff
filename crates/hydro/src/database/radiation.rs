//! Radiation in time: the added mass at infinite frequency, and the memory of the water as a kernel.
//!
//! [CUMMINS-1962]: `F = -A_inf a - int_0^inf K(s) v(t - s) ds`. [OGILVIE-1964]:
//! `K(t) = 2/pi int_0^inf B(w) cos(w t) dw`, `A_inf = A(w) + 1/w int_0^inf K(t) sin(w t) dt`.
//!
//! A source ends at some frequency, often before its damping does. What is beyond it is found by its added mass, which the second relation ties to
//! the damping at all frequencies: beyond the last frequency w_n the damping is, with `u = 1 - (w_n/w)^2`,
//! `(w_n/w)^3 (B_n (1 - u)^2 + 2 B_1 u (1 - u) + B_2 u^2)`, and B_1 and B_2 are those of least squares of the relation over the frequencies of the
//! source [W-TAIL]. A steady motion at one of these frequencies then meets in time the added mass and damping that the source has there. Of bodies
//! solved together each pair of directions has a tail of its own, and those of all bodies together give no energy.

use super::checks::MODES;
use super::interpolation::moved_matrix;
use nalgebra::{DMatrix, Matrix6, Vector6};
use std::f64::consts::PI;
use windlass_base::dense::{SymmetricEigen, least_squares, never};
use windlass_model::{ClassError, Database};

/// Memory where none is given (s), when the kernel has died away by then.
pub const USUAL_MEMORY: f64 = 60.0;
/// The longest memory that is chosen (s).
const LONGEST_MEMORY: f64 = 300.0;
/// What is left of the kernel, over its largest value, that is let go.
const TRUNCATION_TOLERANCE: f64 = 2e-3;
/// How far beyond the last frequency damping is continued, over it, and in how many parts.
const TAIL: (f64, usize) = (8.0, 60);
/// Parts of the range of the source between which damping is straight: a cubic is met to `h2/8` of its curvature, 1e-4 of a hump as wide as a fifth
/// of the range.
const INNER_PARTS: f64 = 200.0;
/// Frequencies of a source from which the damping beyond its last is found; of fewer it falls as 1/w3.
const LEAST_FREQUENCIES: usize = 5;
/// The share of the added mass by which a source may miss Ogilvie's relation before it is warned of.
const MAX_OGILVIE_ERROR: f64 = 0.05;
/// Added mass over the largest of translations or rotations that is rounding, as of the yaw of a round body.
const ROUNDING_SHARE: f64 = 1e-6;
/// Share of the misfit of a tail that falls as 1/w3 below which a fitted one must come to be taken: that of a source whose frequencies leave a sharp
/// resonance out, as of a gap between bodies, explains little, and is none of the water.
const EXPLAINED_SHARE: f64 = 0.5;
/// Singular values of the least squares of a tail, of columns of about one, below which a combination is not determined.
const UNDETERMINED: f64 = 1e-6;

/// The radiation of a body about its origin, body axes, or that of a body as it acts on another.
#[derive(Clone, Debug, PartialEq)]
pub struct Radiation {
    /// Frequencies of the damping: zero, those of the source and between them, and a tail (rad/s).
    frequencies: Vec<f64>,
    /// Damping at them, straight between.
    damping: Vec<Matrix6<f64>>,
    /// Change of the damping from each frequency to the next, over that of the frequency.
    slopes: Vec<Matrix6<f64>>,
    /// Added mass at infinite frequency (kg, kg m, kg m2) that goes with the kernel.
    pub infinite: Matrix6<f64>,
    /// How the kernel goes with the added mass of the source.
    pub quality: OgilvieQuality,
    /// Whether the source has one frequency only: it serves motions at that frequency, and there is no kernel.
    pub has_one_frequency: bool,
}

/// How well the kernel and the added mass of a source fulfil Ogilvie's relation, over the largest added mass of a direction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OgilvieQuality {
    /// How far single frequencies stray from it, root mean square, those of short waves with the more weight; in which direction most.
    pub stray: (f64, usize),
    /// By how much the added mass at infinite frequency by the relation is above that of the source; in which direction most. None where the
    /// source has none, or too few frequencies.
    pub shift: Option<(f64, usize)>,
}

impl Radiation {
    /// Sees that there is a kernel, which a run in time needs.
    ///
    /// # Errors
    /// One frequency only.
    pub fn check_memory(&self) -> Result<(), ClassError> {
        if self.has_one_frequency {
            let text = "its database has one frequency only: radiation has no memory, which a run in time needs";
            return Err(ClassError::new(text).help("more periods of the database; FREQ_RESPONSE takes one"));
        }
        Ok(())
    }

    /// That of a database of a body alone, or of the own motions of one of several; `None` where it has none.
    pub fn new(data: &Database) -> Option<Self> {
        let fit = RadiationFit::new(data)?;
        if !fit.is_determined {
            let end = fit.end;
            return Some(fit.finish(&[end; 2]));
        }
        let first = positive_part(&fit.first_tail());
        let second = positive_part(&fit.second_tail(&first));
        Some(fit.finish(&[first, second]))
    }

    /// That of all pairs of some bodies of one source, row by row: the force on the body of the row by motions of that of the column, about the origins and in
    /// the axes of both. `database` gives what is known of a pair. The tails of all pairs together give no energy, as those of a body alone.
    pub fn of_bodies(count: usize, database: impl Fn(usize, usize) -> Option<Database>) -> Vec<Option<Self>> {
        let pairs = (0..count * count).map(|pair| (pair / count, pair % count));
        let fits: Vec<Option<RadiationFit>> =
            pairs.map(|(row, column)| database(row, column).and_then(|data| RadiationFit::new(&data))).collect();
        let is_determined = fits.iter().flatten().all(|fit| fit.is_determined);
        let joined = |blocks: &[Matrix6<f64>]| {
            if !is_determined {
                return blocks.to_vec();
            }
            let mut whole = DMatrix::zeros(6 * count, 6 * count);
            for (pair, block) in blocks.iter().enumerate() {
                whole.fixed_view_mut::<6, 6>(6 * (pair / count), 6 * (pair % count)).copy_from(block);
            }
            let whole = positive_part_of(&whole);
            let block = |pair: usize| whole.fixed_view::<6, 6>(6 * (pair / count), 6 * (pair % count)).into_owned();
            (0..count * count).map(block).collect::<Vec<Matrix6<f64>>>()
        };
        let of = |tail: &dyn Fn(usize, &RadiationFit) -> Matrix6<f64>| {
            let all = fits.iter().enumerate();
            let blocks: Vec<_> =
                all.map(|(pair, fit)| fit.as_ref().map_or_else(Matrix6::zeros, |fit| tail(pair, fit))).collect();
            joined(&blocks)
        };
        let first = of(&|_, fit| fit.first_tail());
        let second = of(&|pair, fit| fit.second_tail(&first[pair]));
        let tails = first.into_iter().zip(second);
        fits.into_iter().zip(tails).map(|(fit, (one, two))| fit.map(|fit| fit.finish(&[one, two]))).collect()
    }

    /// The kernel at a time (N/m, N, N m): exact for damping that is straight between its frequencies (Filon).
    pub fn kernel_at(&self, time: f64) -> Matrix6<f64> {
        if time == 0.0 {
            let lines = self.frequencies.windows(2).zip(self.damping.windows(2));
            let part = |ends: (&[f64], &[Matrix6<f64>])| match ends {
                ([w0, w1], [b0, b1]) => (b0 + b1) * (0.5 * (w1 - w0)),
                _ => Matrix6::zeros(),
            };
            return lines.map(part).sum::<Matrix6<f64>>() * (2.0 / PI);
        }
        // int (b0 + s (w - w0)) cos(w t) dw, of which the terms b sin(w t) / t cancel from line to line and vanish at both ends
        let mut before = 1.0;
        let mut sum = Matrix6::zeros();
        for (frequency, slope) in self.frequencies.iter().skip(1).zip(&self.slopes) {
            let cos = (frequency * time).cos();
            sum += slope * (cos - before);
            before = cos;
        }
        sum * (2.0 / (PI * time * time))
    }

    /// The kernel at 0, dt, 2 dt .. to a memory (s).
    pub fn kernel(&self, dt: f64, memory: f64) -> Vec<Matrix6<f64>> {
        let lags = (memory / dt).ceil().clamp(1.0, 1e6) as usize;
        (0..=lags).map(|n| self.kernel_at(n as f64 * dt)).collect()
    }

    /// The kernel of a memory that ends (s): over its second half it fades as a squared cosine. Cut off at once, what is left of it would give
    /// slow motions a damping, or take it from them.
    pub fn tapered_retardation(&self, time: f64, memory: f64) -> Matrix6<f64> {
        let faded = (2.0 * time / memory - 1.0).clamp(0.0, 1.0);
        self.kernel_at(time) * (0.5 * PI * faded).cos().powi(2)
    }

    /// A twentieth of the shortest period that the source has (s): within it the kernel is smooth.
    pub fn finest(&self) -> f64 {
        PI / (10.0 * self.last_frequency().unwrap_or(1.0))
    }

    /// The last frequency of the source (rad/s).
    fn last_frequency(&self) -> Option<f64> {
        self.frequencies.iter().rev().nth(TAIL.1).copied()
    }

    /// The memory after which what is left of the kernel is two thousandths of its largest (s): 60 s, or more up to 300 s.
    pub fn memory(&self) -> f64 {
        let largest = self.kernel_at(0.0).diagonal();
        let scale = |i: usize, j: usize| (largest[i] * largest[j]).abs().sqrt().max(f64::MIN_POSITIVE);
        let alive = |t: f64| {
            let kernel = self.kernel_at(t);
            (0..6).any(|i| (0..=i).any(|j| kernel[(i, j)].abs() > TRUNCATION_TOLERANCE * scale(i, j)))
        };
        let step = 0.25 * PI / self.last_frequency().unwrap_or(1.0).max(0.1);
        let from = (USUAL_MEMORY / step).ceil() as usize;
        let to = (LONGEST_MEMORY / step).floor() as usize;
        let last = (from..=to).rev().find(|n| alive(*n as f64 * step));
        last.map_or(USUAL_MEMORY, |n| n as f64 * step)
    }

    /// The added mass at a frequency (rad/s) that goes with the kernel (kg, kg m, kg m2), by Ogilvie's relation.
    pub fn added_mass_at(&self, frequency: f64) -> Matrix6<f64> {
        self.infinite + weighted_sum(&relation_weights(&self.frequencies, frequency), &self.damping)
    }
}

/// Damping at zero, where it is nothing, at the frequencies of a source and between them, by the cubics of [STEFFEN-1990], which have no larger and no
/// smaller values than their ends; straight between steps of the last frequency over [`INNER_PARTS`].
fn refined(frequencies: &[f64], damping: &[Matrix6<f64>]) -> (Vec<f64>, Vec<Matrix6<f64>>) {
    let places: Vec<f64> = std::iter::once(0.0).chain(frequencies.iter().copied()).collect();
    let values: Vec<Matrix6<f64>> = std::iter::once(Matrix6::zeros()).chain(damping.iter().copied()).collect();
    let secants: Vec<(f64, Matrix6<f64>)> = places
        .windows(2)
        .zip(values.windows(2))
        .filter_map(|ends| match ends {
            ([w0, w1], [b0, b1]) => Some((w1 - w0, (b1 - b0) / (w1 - w0))),
            _ => None,
        })
        .collect();
    let inner = secants.windows(2).filter_map(|pair| match pair {
        [(before, low), (after, high)] => {
            let mean = |a: f64, b: f64| (a * after + b * before) / (before + after);
            let of = |a: f64, b: f64| (a.signum() + b.signum()) * a.abs().min(b.abs()).min(0.5 * mean(a, b).abs());
            Some(low.zip_map(high, of))
        }
        _ => None,
    });
    let ends = [secants.first(), secants.last()].map(|secant| secant.map_or_else(Matrix6::zeros, |secant| secant.1));
    let slopes: Vec<Matrix6<f64>> = std::iter::once(ends[0]).chain(inner).chain([ends[1]]).collect();
    let step = places.last().copied().unwrap_or_default() / INNER_PARTS;
    let (mut made, mut list) = (vec![0.0], vec![Matrix6::zeros()]);
    for ((w, b), s) in places.windows(2).zip(values.windows(2)).zip(slopes.windows(2)) {
        let ([w0, w1], [b0, b1], [s0, s1]) = (w, b, s) else { continue };
        let parts = ((w1 - w0) / step).ceil().max(1.0) as usize;
        for n in 1..parts {
            let x = n as f64 / parts as f64;
            let y = 1.0 - x;
            let bent = (s0 * y - s1 * x) * (x * y * (w1 - w0));
            made.push(w0 + (w1 - w0) * x);
            list.push(b0 * (y * y * (1.0 + 2.0 * x)) + b1 * (x * x * (1.0 + 2.0 * y)) + bent);
        }
        made.push(*w1);
        list.push(*b1);
    }
    (made, list)
}

/// The shares of dampings at frequencies (rad/s), straight between, in `A(w) - A_inf = 2/pi PV int B(s) / (s2 - w2) ds` at a frequency.
///
/// `2 w/(w2 - s2) = 1/(w - s) + 1/(w + s)`, and each gives logarithms. Those of `w - s` at a frequency of the list itself cancel
/// between the lines before and behind it, which have the same value there: they are left out.
fn relation_weights(frequencies: &[f64], w: f64) -> Vec<f64> {
    let log = |x: f64| if x.abs() <= 1e-12 * w { 0.0 } else { x.abs().ln() };
    let mut weights = vec![0.0; frequencies.len()];
    for (place, ends) in frequencies.windows(2).enumerate() {
        let [s0, s1] = ends else { continue };
        let (near, far) = (log(w - s0) - log(w - s1), log(w + s1) - log(w + s0));
        let scale = -1.0 / (PI * w * (s1 - s0));
        if let Some([low, high]) = weights.get_mut(place..place + 2) {
            *low += scale * ((s1 - w) * near + (s1 + w) * far);
            *high += scale * ((w - s0) * near - (w + s0) * far);
        }
    }
    weights
}

fn weighted_sum(weights: &[f64], list: &[Matrix6<f64>]) -> Matrix6<f64> {
    weights.iter().zip(list).map(|(weight, matrix)| matrix * *weight).sum()
}

/// The damping of a source, and what its added mass says of that beyond the last frequency.
struct RadiationFit {
    frequencies: Vec<f64>,
    /// Damping without B_1 and B_2.
    damping: Vec<Matrix6<f64>>,
    /// The shares of B_1 and B_2 in it.
    shares: [Vec<f64>; 2],
    /// At the last frequency of the source.
    end: Matrix6<f64>,
    given: Option<Matrix6<f64>>,
    relation: OgilvieRelation,
    /// Whether there are frequencies enough for a fit.
    is_determined: bool,
    has_one_frequency: bool,
}

impl RadiationFit {
    fn new(data: &Database) -> Option<Self> {
        let (last, end) = (data.frequencies.last()?, data.damping.last()?);
        let moved = |list: &[Matrix6<f64>]| list.iter().map(|m| moved_matrix(m, data.reference)).collect::<Vec<_>>();
        let (mut frequencies, mut damping) = refined(&data.frequencies, &moved(&data.damping));
        let end = moved_matrix(end, data.reference);
        let mut shares = [vec![0.0; frequencies.len()], vec![0.0; frequencies.len()]];
        let (reach, parts) = TAIL;
        for n in 1..=parts {
            let over = reach.powf(n as f64 / parts as f64);
            let fall = if n < parts { over.powi(-3) } else { 0.0 };
            let rise = 1.0 - over.powi(-2);
            frequencies.push(last * over);
            damping.push(end * (fall * (1.0 - rise).powi(2)));
            for (shares, share) in shares.iter_mut().zip([2.0 * rise * (1.0 - rise), rise * rise]) {
                shares.push(fall * share);
            }
        }
        let given = data.infinite.map(|given| moved_matrix(&given, data.reference));
        let relation =
            OgilvieRelation::new(&data.frequencies, &moved(&data.added_mass), (&frequencies, &damping, &shares));
        let is_determined = data.frequencies.len() >= LEAST_FREQUENCIES;
        let has_one_frequency = data.frequencies.len() == 1;
        Some(RadiationFit { frequencies, damping, shares, end, given, relation, is_determined, has_one_frequency })
    }

    /// What a fit explains of the added mass, else the damping at the last frequency, with which the tail falls as 1/w3.
    fn explained(&self, fitted: &Matrix6<f64>) -> Matrix6<f64> {
        let given = self.given.as_ref();
        let [first, second, limit] = self.relation.fit(&[None; 2], given);
        let plain = self.relation.fit(&[Some(self.end); 2], given)[2];
        let (before, after) =
            (self.relation.misfit(&[self.end; 2], &plain), self.relation.misfit(&[first, second], &limit));
        Matrix6::from_fn(|i, j| {
            let at = (i, j);
            if after[at] < EXPLAINED_SHARE * before[at] { fitted[at] } else { self.end[at] }
        })
    }

    /// B_1.
    fn first_tail(&self) -> Matrix6<f64> {
        if !self.is_determined {
            return self.end;
        }
        self.explained(&self.relation.fit(&[None; 2], self.given.as_ref())[0])
    }

    /// B_2 beside a B_1.
    fn second_tail(&self, first: &Matrix6<f64>) -> Matrix6<f64> {
        if !self.is_determined {
            return self.end;
        }
        self.explained(&self.relation.fit(&[Some(*first), None], self.given.as_ref())[1])
    }

    /// The radiation with B_1 and B_2.
    fn finish(self, tail: &[Matrix6<f64>; 2]) -> Radiation {
        let RadiationFit {
            frequencies, mut damping, shares, given, relation, is_determined, has_one_frequency, ..
        } = self;
        let infinite = given.unwrap_or_else(|| relation.fit(&tail.map(Some), None)[2]);
        for (share, matrix) in shares.iter().zip(tail) {
            damping.iter_mut().zip(share).for_each(|(damping, share)| *damping += matrix * *share);
        }
        let free = is_determined.then(|| relation.fit(&[None; 2], None)[2]);
        let shift = given.zip(free).map(|(given, free)| relation.worst(&|i| free[(i, i)] - given[(i, i)]));
        let quality = OgilvieQuality { stray: relation.stray(tail, &infinite), shift };
        let slopes = frequencies
            .windows(2)
            .zip(damping.windows(2))
            .filter_map(|ends| match ends {
                ([w0, w1], [b0, b1]) => Some((b1 - b0) / (w1 - w0)),
                _ => None,
            })
            .collect();
        Radiation { frequencies, damping, slopes, infinite, quality, has_one_frequency }
    }
}

/// Ogilvie's relation at the frequencies of a source: what its added mass leaves for that at infinite frequency and for a tail.
struct OgilvieRelation {
    rows: Vec<OgilvieRow>,
    /// The largest added mass of each direction.
    sizes: Vector6<f64>,
}

/// Ogilvie's relation at a frequency.
struct OgilvieRow {
    /// Its weight, w2 over the sum of all: an error of added mass is a force in proportion to w2.
    weight: f64,
    /// Added mass that the damping to the last frequency does not explain.
    left: Matrix6<f64>,
    /// The shares of B_1 and B_2 in it.
    shares: [f64; 2],
}

impl OgilvieQuality {
    /// What it says of a source, in words, and whether that is a warning; `is_given` tells that the source has the added mass at infinite frequency.
    pub fn sentence(&self, is_given: bool) -> (String, bool) {
        let percent = |(share, direction): (f64, usize)| {
            format!("{:.1} % in {}", 100.0 * share.abs(), MODES.get(direction).copied().unwrap_or_default())
        };
        let (stray, is_warning) = (percent(self.stray), self.stray.0 > MAX_OGILVIE_ERROR);
        let (text, is_warning) = match self.shift {
            None if is_given => (
                format!(
                    "its frequencies are too few to see how its added mass at infinite frequency goes with Ogilvie's relation; single frequencies stray from it by {stray}"
                ),
                is_warning,
            ),
            None => (
                format!(
                    "added mass at infinite frequency is by Ogilvie's relation; single frequencies stray from it by {stray}"
                ),
                is_warning,
            ),
            Some(shift) => (
                format!(
                    "the added mass at infinite frequency differs by {} from that by Ogilvie's relation; single frequencies stray from it by {stray}",
                    percent(shift)
                ),
                is_warning || shift.0.abs() > MAX_OGILVIE_ERROR,
            ),
        };
        let remedy = "; runs in time need a database of more periods, shorter ones above all, and motions in the frequency domain do not";
        (if is_warning { text + remedy } else { text }, is_warning)
    }
}

impl OgilvieRelation {
    fn new(
        frequencies: &[f64],
        added: &[Matrix6<f64>],
        (places, damping, shares): (&[f64], &[Matrix6<f64>], &[Vec<f64>; 2]),
    ) -> Self {
        let whole: f64 = frequencies.iter().map(|w| w * w).sum();
        let row = |(w, added): (&f64, &Matrix6<f64>)| {
            let weights = relation_weights(places, *w);
            let share = |list: &Vec<f64>| weights.iter().zip(list).map(|(weight, share)| weight * share).sum();
            let [first, second] = shares;
            OgilvieRow {
                weight: w * w / whole,
                left: added - weighted_sum(&weights, damping),
                shares: [share(first), share(second)],
            }
        };
        let sizes = Vector6::from_fn(|i, _| added.iter().map(|a| a[(i, i)].abs()).fold(0.0, f64::max));
        OgilvieRelation { rows: frequencies.iter().zip(added).map(row).collect(), sizes }
    }

    /// B_1, B_2 and the added mass at infinite frequency by least squares; those that are given stay.
    fn fit(&self, tail: &[Option<Matrix6<f64>>; 2], infinite: Option<&Matrix6<f64>>) -> [Matrix6<f64>; 3] {
        let [first, second] = *tail;
        let mut made = [first, second, infinite.copied()];
        let free: Vec<usize> = (0..3).filter(|i| made[*i].is_none()).collect();
        let share = |row: &OgilvieRow, i: usize| row.shares.get(i).copied().unwrap_or(1.0);
        let matrix = DMatrix::from_fn(self.rows.len(), free.len(), |n, i| {
            self.rows[n].weight.sqrt() * share(&self.rows[n], free[i])
        });
        let right = DMatrix::from_fn(self.rows.len(), 36, |n, entry| {
            let row = &self.rows[n];
            let known: f64 = made.iter().enumerate().filter_map(|(i, m)| Some((*m)?[entry] * share(row, i))).sum();
            row.weight.sqrt() * (row.left[entry] - known)
        });
        let solved = least_squares(matrix, &right, UNDETERMINED, &never);
        for (place, i) in free.iter().enumerate() {
            let row = solved.as_ref().ok().map(|solved| Matrix6::from_fn(|a, b| solved[(place, a + 6 * b)]));
            made[*i] = Some(row.unwrap_or_else(Matrix6::zeros));
        }
        made.map(Option::unwrap_or_default)
    }

    /// The worst of values of the six directions over the largest added mass of each, and its direction.
    fn worst(&self, value: &dyn Fn(usize) -> f64) -> (f64, usize) {
        let kind = |i: usize| self.sizes.rows(3 * (i / 3), 3).max();
        let over = |i: usize| if self.sizes[i] > ROUNDING_SHARE * kind(i) { value(i) / self.sizes[i] } else { 0.0 };
        (0..6)
            .map(|i| (over(i), i))
            .fold((0.0, 0), |most: (f64, usize), one| if one.0.abs() > most.0.abs() { one } else { most })
    }

    /// What a tail and an added mass at infinite frequency leave of the relation, root mean square over the frequencies.
    fn misfit(&self, tail: &[Matrix6<f64>; 2], infinite: &Matrix6<f64>) -> Matrix6<f64> {
        let [first, second] = tail;
        let square = |row: &OgilvieRow| {
            let off = row.left - infinite - first * row.shares[0] - second * row.shares[1];
            off.component_mul(&off) * row.weight
        };
        self.rows.iter().map(square).sum::<Matrix6<f64>>().map(f64::sqrt)
    }

    /// How far frequencies stray from the relation.
    fn stray(&self, tail: &[Matrix6<f64>; 2], infinite: &Matrix6<f64>) -> (f64, usize) {
        let misfit = self.misfit(tail, infinite);
        self.worst(&|i| misfit[(i, i)])
    }
}

/// A matrix of damping without what would give energy: of its symmetric part diagonals that are not negative, no pair above their geometric mean, no
/// negative eigenvalue. The rest, which coarse panels leave, does no work.
fn positive_part_of(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let count = matrix.nrows();
    let sizes = matrix.diagonal().map(|own| own.max(0.0).sqrt());
    let shares = DMatrix::from_fn(count, count, |i, j| {
        let size = sizes[i] * sizes[j];
        if size > 0.0 { (0.5 * (matrix[(i, j)] + matrix[(j, i)]) / size).clamp(-1.0, 1.0) } else { 0.0 }
    });
    let whole = |shares: &DMatrix<f64>| {
        DMatrix::from_fn(count, count, |i, j| {
            let size = sizes[i] * sizes[j];
            let idle = if size > 0.0 { 0.5 * (matrix[(i, j)] - matrix[(j, i)]) } else { 0.0 };
            shares[(i, j)] * size + idle
        })
    };
    let Ok(eigen) = SymmetricEigen::new(shares.clone(), &never) else {
        return whole(&DMatrix::identity(count, count));
    };
    if eigen.values.min() >= 0.0 {
        return whole(&shares);
    }
    let values = DMatrix::from_diagonal(&eigen.values.map(|value| value.max(0.0)));
    let clipped = &eigen.vectors * values * eigen.vectors.transpose();
    let diagonal = clipped.diagonal().map(|own| if own > 0.0 { own.sqrt().recip() } else { 0.0 });
    whole(&DMatrix::from_fn(count, count, |i, j| clipped[(i, j)] * diagonal[i] * diagonal[j]))
}

/// As [`positive_part_of`], of one body.
fn positive_part(matrix: &Matrix6<f64>) -> Matrix6<f64> {
    positive_part_of(&DMatrix::from_fn(6, 6, |i, j| matrix[(i, j)])).fixed_view::<6, 6>(0, 0).into_owned()
}
