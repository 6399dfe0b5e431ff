//! Pressure and elevation of Airy waves at many places around a body, interpolated on a grid.
//!
//! In a long-crested sea both depend on two coordinates alone: the distance along the direction of travel, and the depth. The waves of each
//! direction are summed on a uniform grid of stations and levels, once for an instant; between its nodes a Lagrange polynomial of six
//! points in each coordinate is taken. A wave of number k errs by at most `C (k h)^6` of its amplitude, with h the spacing and
//! `C = (5/2 3/2 1/2)^2 / 6!` (error of the interpolating polynomial midway between the central nodes). The spacing is the one for which the
//! root of the sum of the squares of these errors is [`TOLERANCE`] of that of the amplitudes.
//!
//! A grid costs the product of stations, levels and components in multiplications, where the direct sum costs a sine, a cosine and an
//! exponential for each place and component. Short-crested seas have a direction for each component, and take the direct sum.

use super::eight::{Eight, sin_cos};
use super::{Component, Sea};
use multiversion::multiversion;
use nalgebra::Vector3;
use std::f64::consts::TAU;
use windlass_model::Stretching;

/// Error of the interpolated elevation and pressure, as a share of their standard deviation.
const TOLERANCE: f64 = 3e-6;
/// Largest value of the error's polynomial over 6!, midway between the two central nodes.
const CENTRAL: f64 = 3.515_625 / 720.0;
/// Nodes of an interpolation along one coordinate.
const POINTS: usize = 6;
/// Nodes before the one at or before a place.
const BEFORE: usize = 2;
/// Directions of travel beyond which the direct sum is taken.
const MOST_DIRECTIONS: usize = 4;
/// A node of the grid costs about this share of a place of the direct sum (measured with 200 components).
const NODE_COST: f64 = 0.1;
/// Levels summed together: their sums stay in registers.
const TILE: usize = 4;

/// The grid of a sea around a body.
#[derive(Clone, Debug)]
pub struct PressureGrid {
    trains: Vec<Train>,
}

/// Waves of one direction.
#[derive(Clone, Debug)]
struct Train {
    /// Unit vector of travel.
    toward: [f64; 2],
    /// Distance of stations, and of levels (m).
    spacing: f64,
    blocks: Vec<Block>,
    /// Pressure head over elevation at each level, blocks innermost; level [`BEFORE`] is the mean surface, and each next one is deeper.
    decay: Vec<Eight>,
    levels: usize,
}

/// Eight waves; those that fill up the last block have no amplitude.
#[derive(Clone, Copy, Debug)]
struct Block {
    k: Eight,
    w: Eight,
    amplitude: Eight,
    phase: Eight,
    /// Cosine and sine of k times the spacing.
    turn: [Eight; 2],
}

/// The values of one instant.
#[derive(Debug)]
pub struct FilledGrid<'a> {
    parts: Vec<FilledTrain<'a>>,
    highest: f64,
}

/// Those of one direction.
#[derive(Debug)]
struct FilledTrain<'a> {
    train: &'a Train,
    /// Pressure heads (m of water), levels innermost.
    heads: Vec<f64>,
    levels: usize,
    /// Place of the first station along the direction of travel, in spacings from the origin.
    first: f64,
}

impl PressureGrid {
    /// That of a sea for a number of places no farther from each other than a distance (m), and over a height (m); `None` where the direct
    /// sum is cheaper, or the sea is not made of a few long-crested trains of Airy waves.
    pub fn new(sea: &Sea, [across, height]: [f64; 2], places: usize) -> Option<Self> {
        if sea.stokes.is_some() || sea.stretching == Stretching::Exponential || !(across > 0.0 && across.is_finite()) {
            return None;
        }
        let mut groups: Vec<([f64; 2], Vec<&Component>)> = Vec::new();
        for component in sea.components.iter().filter(|c| c.amplitude != 0.0) {
            match groups.iter().position(|(toward, _)| *toward == component.toward) {
                Some(known) => groups.get_mut(known)?.1.push(component),
                None if groups.len() < MOST_DIRECTIONS => groups.push((component.toward, vec![component])),
                None => return None,
            }
        }
        // what it costs is known before it is made: the nodes bound its memory too
        let spacings: Vec<f64> = groups.iter().map(|(_, members)| spacing(members, across)).collect();
        let nodes: f64 = spacings.iter().map(|h| (across / h) * (height / h + POINTS as f64)).sum();
        if groups.is_empty() || nodes * NODE_COST >= places as f64 {
            return None;
        }
        let made = groups.iter().zip(spacings);
        let trains = made.map(|((toward, members), h)| Train::new(*toward, members, sea.depth, (across, h))).collect();
        Some(PressureGrid { trains })
    }

    /// The sea at a time (s) around places given by their arms from a body's origin, of which `lowest` is the depth of the deepest below
    /// the mean level (m).
    pub fn fill(&self, sea: &Sea, time: f64, origin: [f64; 2], arms: &[Vector3<f64>], lowest: f64) -> FilledGrid<'_> {
        let factor = sea.factor(time);
        let fill = |train: &'_ Train| {
            // up to the level below the deepest place, and the nodes beyond it
            let levels = ((lowest.max(0.0) / train.spacing) as usize + POINTS).min(train.levels);
            let along = arms.iter().map(|arm| train.toward[0] * arm.x + train.toward[1] * arm.y);
            let [low, high] = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
            let first = (low / train.spacing).floor() - BEFORE as f64;
            let stations = ((high / train.spacing).floor() - first) as usize + POINTS - BEFORE;
            let begin = train.toward[0] * origin[0] + train.toward[1] * origin[1] + first * train.spacing;
            let phasors = train.blocks.iter().map(|b| b.at(time, begin, factor)).collect();
            let mut heads = vec![0.0; stations * levels];
            sum_waves(&train.blocks, phasors, &train.decay, levels, &mut heads);
            (heads, levels, first)
        };
        let parts = self.trains.iter().map(|train| {
            let (heads, levels, first) = fill(train);
            FilledTrain { train, heads, levels, first }
        });
        let parts: Vec<_> = parts.collect();
        // the largest at the nodes times the sum of the weights' magnitudes midway between the central two, 2 (3 + 25 + 150) / 256
        let top = |part: &FilledTrain<'_>| {
            let nodes = part.heads.iter().skip(BEFORE).step_by(part.levels.max(1));
            nodes.fold(0.0, |most: f64, head| most.max(head.abs()))
        };
        let highest = 356.0 / 256.0 * parts.iter().map(top).sum::<f64>();
        FilledGrid { parts, highest }
    }
}

impl Block {
    /// Amplitudes times cosine and sine of `k begin - w t + phase`.
    fn at(&self, time: f64, begin: f64, factor: f64) -> [Eight; 2] {
        // whole turns are taken off each term first, so that neither a long run nor a far origin costs digits
        let angle = |i: usize| (self.k[i] * begin) % TAU - (self.w[i] * time) % TAU + self.phase[i];
        let (sin, cos) = sin_cos(&std::array::from_fn(angle));
        let scaled = |part: Eight| std::array::from_fn(|i| factor * self.amplitude[i] * part[i]);
        [scaled(cos), scaled(sin)]
    }
}

/// The distance of stations (m) at which waves err by [`TOLERANCE`], at most that of the places.
fn spacing(members: &[&Component], across: f64) -> f64 {
    let energy: f64 = members.iter().map(|c| c.amplitude * c.amplitude).sum();
    let sixth: f64 = members.iter().map(|c| (c.amplitude * c.number.powi(6)).powi(2)).sum();
    (TOLERANCE / CENTRAL * (energy / sixth).sqrt()).powf(1.0 / 6.0).min(across)
}

impl Train {
    fn new(toward: [f64; 2], members: &[&Component], depth: Option<f64>, (across, spacing): (f64, f64)) -> Self {
        // a body may sink by its own size; deeper places take the direct sum
        let deepest = 2.0 * across;
        let levels = (depth.map_or(deepest, |d| d.min(deepest)) / spacing) as usize + POINTS;
        let blocks: Vec<Block> = members
            .chunks(8)
            .map(|list| {
                let each = |value: &dyn Fn(&Component) -> f64| {
                    let mut lanes = [0.0; 8];
                    lanes.iter_mut().zip(list).for_each(|(lane, c)| *lane = value(c));
                    lanes
                };
                Block {
                    k: each(&|c| c.number),
                    w: each(&|c| c.frequency),
                    amplitude: each(&|c| c.amplitude),
                    phase: each(&|c| c.phase),
                    turn: [each(&|c| (c.number * spacing).cos()), each(&|c| (c.number * spacing).sin())],
                }
            })
            .collect();
        let decay = (0..levels)
            .flat_map(|level| {
                let height = (BEFORE as f64 - level as f64) * spacing;
                blocks.iter().map(move |b| b.k.map(|k| head(k, height, depth)))
            })
            .collect();
        Train { toward, spacing, blocks, decay, levels }
    }
}

/// Pressure head of a wave over its elevation, `cosh(k(z+d))/cosh(kd)`, at a height (m) over the mean level.
fn head(k: f64, height: f64, depth: Option<f64>) -> f64 {
    let decay = (k * height).exp();
    match depth {
        Some(d) => decay * (1.0 + (-2.0 * k * (height + d)).exp()) / (1.0 + (-2.0 * k * d).exp()),
        None => decay,
    }
}

/// The waves summed at each station, levels innermost; `phasors` are those of the first station.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn sum_waves(blocks: &[Block], mut phasors: Vec<[Eight; 2]>, decay: &[Eight], levels: usize, values: &mut [f64]) {
    let count = blocks.len();
    for station in values.chunks_exact_mut(levels) {
        for (tile, out) in station.chunks_mut(TILE).enumerate() {
            let mut sums = [[0.0; 8]; TILE];
            for (row, sum) in sums.iter_mut().enumerate() {
                let begin = (tile * TILE + row) * count;
                let Some(heads) = decay.get(begin..begin + count) else { break };
                for ([cos, _], head) in phasors.iter().zip(heads) {
                    for i in 0..8 {
                        sum[i] += cos[i] * head[i];
                    }
                }
            }
            for (out, sum) in out.iter_mut().zip(&sums) {
                *out = sum.iter().sum();
            }
        }
        for ([cos, sin], block) in phasors.iter_mut().zip(blocks) {
            let [c, s] = &block.turn;
            for i in 0..8 {
                (cos[i], sin[i]) = (cos[i] * c[i] - sin[i] * s[i], sin[i] * c[i] + cos[i] * s[i]);
            }
        }
    }
}

/// Lagrange's weights of nodes 0 to 5 at a place among them.
fn weights(t: f64) -> [f64; POINTS] {
    let d: [f64; POINTS] = std::array::from_fn(|i| t - i as f64);
    let (a, b, c) = (d[0] * d[1], d[2] * d[3], d[4] * d[5]);
    [
        -d[1] * b * c / 120.0,
        d[0] * b * c / 24.0,
        -a * d[3] * c / 12.0,
        a * d[2] * c / 12.0,
        -a * b * d[5] / 24.0,
        a * b * d[4] / 120.0,
    ]
}

impl FilledTrain<'_> {
    fn elevation(&self, arm: &Vector3<f64>) -> Option<f64> {
        let Train { toward, spacing, .. } = self.train;
        let along = (toward[0] * arm.x + toward[1] * arm.y) / spacing - self.first;
        let station = (along as usize).checked_sub(BEFORE)?;
        let mut sum = 0.0;
        for (column, x) in
            self.heads.get(station * self.levels..)?.chunks(self.levels).zip(weights(along - station as f64))
        {
            sum += x * column.get(BEFORE)?;
        }
        Some(sum)
    }

    fn head(&self, arm: &Vector3<f64>, depth: f64) -> Option<f64> {
        let Train { toward, spacing, .. } = self.train;
        let along = (toward[0] * arm.x + toward[1] * arm.y) / spacing - self.first;
        let down = depth / spacing + BEFORE as f64;
        let station = (along as usize).checked_sub(BEFORE)?;
        let level = (down as usize).checked_sub(BEFORE)?;
        if level + POINTS > self.levels {
            return None;
        }
        let (x, z) = (weights(along - station as f64), weights(down - level as f64));
        let mut sum = 0.0;
        for (column, x) in self.heads.get(station * self.levels + level..)?.chunks(self.levels).zip(x) {
            let [a, b, c, d, e, f] = *column.first_chunk::<POINTS>()?;
            sum += x * ((a * z[0] + b * z[1] + c * z[2]) + (d * z[3] + e * z[4] + f * z[5]));
        }
        Some(sum)
    }
}

impl FilledGrid<'_> {
    /// Pressure head of the waves (m of water) at an arm from the origin and a depth below the mean level (m, not negative); `None` beyond
    /// the grid.
    pub fn head(&self, arm: &Vector3<f64>, depth: f64) -> Option<f64> {
        self.parts.iter().try_fold(0.0, |sum, part| Some(sum + part.head(arm, depth)?))
    }

    /// Elevation of the waves (m) at an arm from the origin.
    pub fn elevation(&self, arm: &Vector3<f64>) -> Option<f64> {
        self.parts.iter().try_fold(0.0, |sum, part| Some(sum + part.elevation(arm)?))
    }

    /// A bound of the elevation at places within the grid (m).
    pub fn highest(&self) -> f64 {
        self.highest
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::dispersion::wave_number;
    use super::super::{Sea, Water};
    use super::*;

    /// Forty waves of two directions, periods from 4 to 20 s, their energy that of a peak at 11 s.
    fn sea(depth: Option<f64>) -> Sea {
        let components = (0..40u32).map(|n| {
            let frequency = TAU / 20.0 + f64::from(n) * 0.032;
            let number = wave_number(frequency, depth, 9.80665).unwrap();
            let away = (frequency - TAU / 11.0) / 0.3;
            let toward = if n % 3 == 0 { [0.6, -0.8] } else { [-1.0, 0.0] };
            let amplitude = 0.5 * (-away * away).exp() + 0.02;
            Component { frequency, number, amplitude, toward, phase: f64::from(n * n) }
        });
        let water = Water { depth, level: 1.5, gravity: 9.80665, density: 1025.0 };
        Sea::airy(components.collect(), water, 0.0, Stretching::Linear)
    }

    /// sum a cosh(k(z+d))/cosh(kd) cos(k x - w t + phase), written out.
    fn written_out(sea: &Sea, time: f64, [x, y]: [f64; 2], depth: f64) -> f64 {
        let wave = |c: &Component| {
            let vary = match sea.depth {
                Some(d) => (c.number * (d - depth)).cosh() / (c.number * d).cosh(),
                None => (-c.number * depth).exp(),
            };
            let along = c.number * (c.toward[0] * x + c.toward[1] * y);
            c.amplitude * vary * (along - c.frequency * time + c.phase).cos()
        };
        sea.components.iter().map(wave).sum()
    }

    #[test]
    fn grid_heads_are_the_sum_of_the_waves() {
        for depth in [None, Some(40.0)] {
            let sea = sea(depth);
            let deviation = (0.5 * sea.components.iter().map(|c| c.amplitude.powi(2)).sum::<f64>()).sqrt();
            let grid = PressureGrid::new(&sea, [100.0, 30.0], 100_000).unwrap();
            let arms: Vec<Vector3<f64>> = (0..500)
                .map(|n| {
                    let n = f64::from(n);
                    Vector3::new(40.0 * (n * 0.7).sin(), 25.0 * (n * 1.3).cos(), 0.0)
                })
                .collect();
            let (origin, time) = ([820.0, -310.0], 9876.5);
            let filled = grid.fill(&sea, time, origin, &arms, 30.0);
            let (mut square, mut highest) = (0.0, 0.0f64);
            for (n, arm) in arms.iter().enumerate() {
                let depth = 30.0 * (n as f64 / 499.0);
                let place = [origin[0] + arm.x, origin[1] + arm.y];
                square += (filled.head(arm, depth).unwrap() - written_out(&sea, time, place, depth)).powi(2);
                highest = highest.max(written_out(&sea, time, place, 0.0).abs());
            }
            // the spacing is chosen for an error of 3e-6 of the deviation at places midway between nodes, in each of two coordinates
            let error = (square / 500.0).sqrt() / deviation;
            assert!(error < 5e-6, "{error}");
            assert!(filled.highest() > highest && filled.highest() < 2.0 * highest);
            assert!(filled.head(&arms[0], 45.0).is_none());
        }
    }

    #[test]
    fn grid_is_refused_where_the_direct_sum_is_cheaper() {
        assert!(PressureGrid::new(&sea(None), [100.0, 30.0], 10).is_none());
        let mut spread = sea(None);
        for (n, c) in spread.components.iter_mut().enumerate() {
            c.toward = [(n as f64).cos(), (n as f64).sin()];
        }
        assert!(PressureGrid::new(&spread, [100.0, 30.0], 100_000).is_none());
    }
}
