//! Pressure and elevation of Airy waves at many places around a body, interpolated on a grid.
//!
//! In a long-crested sea both depend on two coordinates alone: the distance along the direction of travel, and the depth. The waves of each
//! direction are summed on uniform grids of stations and levels, once for an instant; between its nodes a Lagrange polynomial of eight
//! points in each coordinate is taken. A wave of number k errs by at most `C (k h)^8` of what is left of its amplitude at a depth, with h the
//! spacing and `C = (7/2 5/2 3/2 1/2)^2 / 8!` (error of the interpolating polynomial midway between the central nodes). The spacing is the one for
//! which the root of the sum of the squares of these errors is [`TOLERANCE`] of that of the amplitudes at the mean level. Short waves do not
//! reach down: each layer, deeper than the one before, has a coarser grid.
//!
//! A grid costs the product of stations, levels and components in multiplications, where the direct sum costs a sine, a cosine and an
//! exponential for each place and component; only nodes that a place needs are summed. Short-crested seas have a direction for each component,
//! and take the direct sum.

use super::super::parts::map_parts;
use super::simd_math::{Lanes8, sin_cos};
use super::{Component, Sea};
use multiversion::multiversion;
use nalgebra::Vector3;
use std::f64::consts::TAU;
use windlass_model::Stretching;
use windlass_nonlinear::bisect;

/// Error of the interpolated elevation and pressure, as a share of their standard deviation.
const TOLERANCE: f64 = 1e-5;
/// Largest value of the error's polynomial over 8!, midway between the two central nodes.
const CENTRAL: f64 = 43.066_406_25 / 40_320.0;
/// Nodes of an interpolation along one coordinate.
const POINTS: usize = 8;
/// Nodes before the one at or before a place.
const BEFORE: usize = 3;
/// How far an interpolation between the two central nodes goes beyond the least and the largest of its nodes, as a share of their difference:
/// the sum of the magnitudes of the negative weights midway, 2 (5 + 245) / 2048.
const OVERSHOOT: f64 = 500.0 / 2048.0;
/// Directions of travel beyond which the direct sum is taken.
const MOST_DIRECTIONS: usize = 4;
/// A node of the grid costs about this share of a place of the direct sum (measured with 200 components).
const NODE_COST: f64 = 0.1;
/// Levels summed together: their sums stay in registers.
const TILE: usize = 8;
/// Stations summed by one thread.
const STATIONS_A_PART: usize = 32;
/// The spacing of a layer over that of the layer above it.
const COARSER: f64 = 1.5;
/// Halvings of the depth range in which a layer's beginning is looked for.
const HALVINGS: usize = 40;

/// The grid of a sea around a body.
#[derive(Clone, Debug)]
pub struct PressureGrid {
    trains: Vec<Train>,
    /// Whether a place's depth alone says at which depth the waves are summed for it.
    unstretched: bool,
}

/// Waves of one direction.
#[derive(Clone, Debug)]
struct Train {
    /// Unit vector of travel.
    toward: [f64; 2],
    blocks: Vec<Block>,
    /// The first one begins at the mean level, each next one below it.
    layers: Vec<Layer>,
}

/// Depths with a grid of their own.
#[derive(Clone, Debug)]
struct Layer {
    /// Depth from which on it is taken (m), down to that of the next one.
    top: f64,
    /// Distance of stations, and of levels (m), and one over it (1/m).
    spacing: f64,
    per_metre: f64,
    /// Cosine and sine of k times the spacing.
    turns: Phasors,
    /// Pressure head over elevation at each level, levels innermost, with [`TILE`] more for each wave; level [`BEFORE`] is at the top, and each next one
    /// is deeper.
    decay: Vec<f64>,
    levels: usize,
}

/// Cosines and sines of all waves of a direction.
#[derive(Clone, Debug, Default)]
struct Phasors {
    cos: Vec<f64>,
    sin: Vec<f64>,
}

impl FromIterator<[Lanes8; 2]> for Phasors {
    fn from_iter<I: IntoIterator<Item = [Lanes8; 2]>>(blocks: I) -> Self {
        let mut made = Phasors::default();
        for [cos, sin] in blocks {
            made.cos.extend(cos);
            made.sin.extend(sin);
        }
        made
    }
}

/// Lanes8 waves; those that fill up the last block have no amplitude.
#[derive(Clone, Copy, Debug)]
struct Block {
    k: Lanes8,
    w: Lanes8,
    amplitude: Lanes8,
    phase: Lanes8,
}

/// The values of one instant.
#[derive(Debug)]
pub struct FilledGrid<'a> {
    parts: Vec<FilledTrain<'a>>,
}

/// Those of one direction.
#[derive(Debug)]
struct FilledTrain<'a> {
    toward: [f64; 2],
    layers: Vec<FilledLayer<'a>>,
    /// Elevation at the stations of the first layer (m).
    surface: Vec<f64>,
    /// Bounds of the elevation at places whose interpolation begins at a station (m).
    bounds: Vec<[f64; 2]>,
}

/// Those of one layer.
#[derive(Debug)]
struct FilledLayer<'a> {
    layer: &'a Layer,
    /// Pressure heads (m of water), levels innermost; no number at nodes that no place needs.
    heads: Vec<f64>,
    levels: usize,
    /// Place of the first station along the direction of travel, in spacings from the origin.
    first: f64,
}

/// Levels of a station that places need: from one, to before another.
type LevelRange = (usize, usize);

/// None of them.
const CLOSED: LevelRange = (usize::MAX, 0);

impl PressureGrid {
    /// That of a sea for a number of places no farther from each other than a distance (m), and over a height (m); `None` where the direct
    /// sum is cheaper, or the sea is not made of a few long-crested trains of Airy waves.
    pub fn new(sea: &Sea, [across, height]: [f64; 2], positions: usize) -> Option<Self> {
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
        let layers: Vec<Vec<[f64; 2]>> = groups.iter().map(|(_, members)| layers(members, sea.depth, across)).collect();
        let nodes: f64 = layers.iter().map(|layers| count(layers, across, height)).sum();
        if groups.is_empty() || nodes * NODE_COST >= positions as f64 {
            return None;
        }
        let made = groups.iter().zip(layers);
        let trains = made
            .map(|((toward, members), layers)| Train::new(*toward, members, sea.depth, (across, &layers)))
            .collect();
        Some(PressureGrid { trains, unstretched: sea.stretching == Stretching::Linear })
    }

    /// The sea at a time (s) around places given by their arms from a body's origin (m, global).
    pub fn fill(&self, sea: &Sea, time: f64, origin: Vector3<f64>, arms: &[Vector3<f64>]) -> FilledGrid<'_> {
        let factor = sea.factor(time);
        let sunk = sea.level - origin.z;
        let parts = self.trains.iter().map(|train| {
            let begin = train.toward[0] * origin.x + train.toward[1] * origin.y;
            let along = |arm: &Vector3<f64>| train.toward[0] * arm.x + train.toward[1] * arm.y;
            let ends =
                arms.iter().map(along).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
            let lowest = arms.iter().map(|arm| sunk - arm.z).fold(0.0, f64::max);
            let mut layers: Vec<FilledLayer<'_>> = Vec::with_capacity(train.layers.len());
            for layer in train.layers.iter().take_while(|layer| layer.top <= lowest) {
                layers.push(FilledLayer::new(layer, ends, lowest));
            }
            let mut windows: Vec<Vec<LevelRange>> = layers.iter().map(|layer| vec![CLOSED; layer.stations()]).collect();
            let mut filled = FilledTrain { toward: train.toward, layers, surface: Vec::new(), bounds: Vec::new() };
            if self.unstretched {
                for arm in arms.iter().filter(|arm| arm.z < sunk) {
                    if let Some(found) = filled.locate(along(arm), sunk - arm.z)
                        && let Some(window) = windows.get_mut(found.layer).and_then(|w| w.get_mut(found.station))
                    {
                        *window = (window.0.min(found.level), window.1.max(found.level + POINTS));
                    }
                }
            } else {
                for (layer, windows) in filled.layers.iter().zip(&mut windows) {
                    windows.fill((0, layer.levels));
                }
            }
            let parts = filled.layers.iter_mut().zip(&windows).enumerate().flat_map(|(index, (layer, windows))| {
                let FilledLayer { layer: own, heads, levels, first } = layer;
                let (own, first, levels, windows) = (*own, *first, *levels, spread(windows));
                heads.chunks_mut(STATIONS_A_PART * levels.max(1)).enumerate().map(move |(part, heads)| {
                    let before = part * STATIONS_A_PART;
                    let windows = windows.get(before..).unwrap_or_default().to_vec();
                    let from = begin + (first + before as f64) * own.spacing;
                    (own, levels, (windows, index == 0), from, heads)
                })
            });
            map_parts(parts, |(layer, levels, (windows, surface), from, heads)| {
                let phasors = train.blocks.iter().map(|b| b.phasors(time, from, factor)).collect();
                sum_waves(phasors, (&layer.turns, &layer.decay), levels, (&windows, surface), heads);
            });
            if let Some(top) = filled.layers.first() {
                filled.surface = top.heads.iter().skip(BEFORE).step_by(top.levels.max(1)).copied().collect();
                filled.bounds = filled.surface.windows(POINTS).map(bounds).collect();
            }
            filled
        });
        FilledGrid { parts: parts.collect() }
    }
}

impl Block {
    /// Amplitudes times cosine and sine of `k begin - w t + phase`.
    fn phasors(&self, time: f64, begin: f64, factor: f64) -> [Lanes8; 2] {
        // whole turns are taken off each term first, so that neither a long run nor a far origin costs digits
        let angle = |i: usize| (self.k[i] * begin) % TAU - (self.w[i] * time) % TAU + self.phase[i];
        let (sin, cos) = sin_cos(&std::array::from_fn(angle));
        let scaled = |part: Lanes8| std::array::from_fn(|i| factor * self.amplitude[i] * part[i]);
        [scaled(cos), scaled(sin)]
    }
}

/// The distance of stations (m) at which waves err by [`TOLERANCE`] at a depth (m) and below.
fn spacing(members: &[&Component], water: Option<f64>, depth: f64) -> f64 {
    let energy: f64 = members.iter().map(|c| c.amplitude * c.amplitude).sum();
    let left = |c: &Component| c.amplitude * head(c.number, -depth, water) * c.number.powi(POINTS as i32);
    let steepest: f64 = members.iter().map(|c| left(c).powi(2)).sum();
    (TOLERANCE / CENTRAL * (energy / steepest).sqrt()).powf(1.0 / POINTS as f64)
}

/// Top and spacing (m) of each layer for places no farther from each other than a distance (m).
fn layers(members: &[&Component], water: Option<f64>, across: f64) -> Vec<[f64; 2]> {
    let deepest = water.map_or(2.0 * across, |d| d.min(2.0 * across));
    let mut made = vec![[0.0, spacing(members, water, 0.0).min(across)]];
    while let Some([top, last]) = made.last().copied() {
        let next = COARSER * last;
        // nodes of an interpolation reach above its place
        let above = BEFORE as f64 * next;
        if next > across || spacing(members, water, (deepest - above).max(0.0)) < next {
            break;
        }
        let lowest = (deepest - above).max(0.0);
        let [_, position] = bisect([0.0, lowest], HALVINGS, |depth| spacing(members, water, depth) < next);
        let found = (position + above).max(top);
        if found >= deepest {
            break;
        }
        made.push([found, next]);
    }
    made
}

/// The nodes of layers for places no farther from each other than a distance (m), and over a height (m).
fn count(layers: &[[f64; 2]], across: f64, height: f64) -> f64 {
    let bottoms = layers.iter().skip(1).map(|[top, _]| *top).chain([f64::INFINITY]);
    let each = layers.iter().zip(bottoms).map(|([top, h], bottom)| {
        let deep = bottom.min(height) - top;
        if deep >= 0.0 { (across / h + POINTS as f64) * (deep / h + POINTS as f64) } else { 0.0 }
    });
    each.sum()
}

impl Train {
    fn new(toward: [f64; 2], members: &[&Component], depth: Option<f64>, (across, tops): (f64, &[[f64; 2]])) -> Self {
        // a body may sink by its own size; deeper places take the direct sum
        let deepest = depth.map_or(2.0 * across, |d| d.min(2.0 * across));
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
                }
            })
            .collect();
        let bottoms = tops.iter().skip(1).map(|[top, _]| *top).chain([deepest]);
        let layers = tops.iter().zip(bottoms).map(|([top, spacing], bottom)| {
            let levels = ((bottom - top) / spacing) as usize + POINTS + 1;
            let height = move |level: usize| (BEFORE as f64 - level as f64) * spacing - top;
            let of_wave = |k: f64| (0..levels + TILE).map(move |level| head(k, height(level), depth));
            let decay = blocks.iter().flat_map(|b| b.k.map(of_wave).into_iter().flatten());
            let turn = |b: &Block| [b.k.map(|k| (k * spacing).cos()), b.k.map(|k| (k * spacing).sin())];
            let decay = decay.collect();
            Layer {
                top: *top,
                spacing: *spacing,
                per_metre: 1.0 / spacing,
                turns: blocks.iter().map(turn).collect(),
                decay,
                levels,
            }
        });
        Train { toward, layers: layers.collect(), blocks }
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

/// The levels that each station is needed at, from those of the places whose first station it is.
fn spread(first: &[LevelRange]) -> Vec<LevelRange> {
    let join = |(low, high): LevelRange, (a, b): &LevelRange| (low.min(*a), high.max(*b));
    (0..first.len())
        .map(|n| first.get(n.saturating_sub(POINTS - 1)..=n).unwrap_or_default().iter().fold(CLOSED, join))
        .collect()
}

/// The waves summed at each station, levels innermost, in its window, and with `surface` at level [`BEFORE`]; `phasors` are those of the
/// first station.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn sum_waves(
    Phasors { mut cos, mut sin }: Phasors,
    (turns, decay): (&Phasors, &[f64]),
    levels: usize,
    (windows, surface): (&[LevelRange], bool),
    values: &mut [f64],
) {
    let stride = decay.len() / turns.cos.len().max(1);
    for (station, (low, high)) in values.chunks_exact_mut(levels).zip(windows) {
        let alone = surface && !(*low..*high).contains(&BEFORE);
        for (from, to) in [(*low, *high), if alone { (BEFORE, BEFORE + 1) } else { CLOSED }] {
            let Some(window) = station.get_mut(from..to.max(from)) else { continue };
            for (tile, out) in window.chunks_mut(TILE).enumerate() {
                let sums = sum_tile(&cos, decay, stride, from + tile * TILE);
                out.iter_mut().zip(sums).for_each(|(out, sum)| *out = sum);
            }
        }
        let turns = turns.cos.iter().zip(&turns.sin);
        for ((cos, sin), (c, s)) in cos.iter_mut().zip(&mut sin).zip(turns) {
            (*cos, *sin) = (*cos * c - *sin * s, *sin * c + *cos * s);
        }
    }
}

/// The waves summed at a level and the next ones, by their cosines and their heads, which stand a stride apart.
#[inline(always)]
fn sum_tile(cos: &[f64], decay: &[f64], stride: usize, level: usize) -> [f64; TILE] {
    let [mut a, mut b, mut c, mut d] = [[0.0; TILE]; 4];
    let mut at = level;
    for cos in cos.as_chunks::<4>().0 {
        add_scaled(&mut a, cos[0], tile(decay, at));
        add_scaled(&mut b, cos[1], tile(decay, at + stride));
        add_scaled(&mut c, cos[2], tile(decay, at + 2 * stride));
        add_scaled(&mut d, cos[3], tile(decay, at + 3 * stride));
        at += 4 * stride;
    }
    std::array::from_fn(|i| (a[i] + b[i]) + (c[i] + d[i]))
}

/// The heads from one on: each wave has that many more than levels.
#[inline(always)]
fn tile(heads: &[f64], from: usize) -> &[f64; TILE] {
    const NONE: &[f64; TILE] = &[f64::NAN; TILE];
    heads.get(from..).and_then(|heads| heads.first_chunk()).unwrap_or(NONE)
}

/// Adds numbers times a factor to sums.
#[inline(always)]
fn add_scaled(sums: &mut [f64; TILE], factor: f64, numbers: &[f64; TILE]) {
    for i in 0..TILE {
        sums[i] += factor * numbers[i];
    }
}

/// One over the products of the distances of each of nodes 0 to 7 from the others.
const SCALES: [f64; POINTS] =
    [-1.0 / 5040.0, 1.0 / 720.0, -1.0 / 240.0, 1.0 / 144.0, -1.0 / 144.0, 1.0 / 240.0, -1.0 / 720.0, 1.0 / 5040.0];

/// Lagrange's weights of nodes 0 to 7 at a place among them.
#[inline(always)]
fn weights(t: f64) -> [f64; POINTS] {
    let d: [f64; POINTS] = std::array::from_fn(|i| t - i as f64);
    let (a, b, c, e) = (d[0] * d[1], d[2] * d[3], d[4] * d[5], d[6] * d[7]);
    let (ab, ce) = (a * b, c * e);
    let others = [
        d[1] * b * ce,
        d[0] * b * ce,
        a * d[3] * ce,
        a * d[2] * ce,
        ab * d[5] * e,
        ab * d[4] * e,
        ab * c * d[7],
        ab * c * d[6],
    ];
    std::array::from_fn(|i| others[i] * SCALES[i])
}

/// A place on the grid of a layer: the first station and level of its interpolation, and where it is from there, in spacings.
struct Found {
    layer: usize,
    station: usize,
    level: usize,
    x: f64,
    z: f64,
}

/// Bounds of what is interpolated between the two central ones of some nodes.
fn bounds(nodes: &[f64]) -> [f64; 2] {
    let [low, high] =
        nodes.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(*x), high.max(*x)]);
    let beyond = OVERSHOOT * (high - low);
    [low - beyond, high + beyond]
}

/// Bounds that hold all of some bounds.
fn bounds_of_all(list: &[[f64; 2]]) -> [f64; 2] {
    let join = |[low, high]: [f64; 2], [a, b]: [f64; 2]| [low.min(a), high.max(b)];
    list.iter().copied().reduce(join).unwrap_or([f64::NEG_INFINITY, f64::INFINITY])
}

impl<'a> FilledLayer<'a> {
    /// One without values for places between ends along the direction of travel, down to a depth (m).
    fn new(layer: &'a Layer, [low, high]: [f64; 2], lowest: f64) -> Self {
        // up to the level below the deepest place, and the nodes beyond it
        let levels = (((lowest - layer.top).max(0.0) * layer.per_metre) as usize + POINTS).min(layer.levels);
        let first = (low * layer.per_metre).floor() - BEFORE as f64;
        let stations = ((high * layer.per_metre).floor() - first) as usize + POINTS - BEFORE;
        FilledLayer { layer, heads: vec![f64::NAN; stations * levels], levels, first }
    }

    fn stations(&self) -> usize {
        self.heads.len() / self.levels.max(1)
    }

    /// First station of the interpolation of a place along the direction of travel (m), and where the place is from there.
    #[inline(always)]
    fn station(&self, along: f64) -> Option<(usize, f64)> {
        let along = along * self.layer.per_metre - self.first;
        let station = (along as usize).checked_sub(BEFORE)?;
        Some((station, along - station as f64))
    }
}

impl FilledTrain<'_> {
    fn elevation(&self, arm: &Vector3<f64>) -> Option<f64> {
        let top = self.layers.first()?;
        let (station, x) = top.station(self.toward[0] * arm.x + self.toward[1] * arm.y)?;
        let nodes = self.surface.get(station..)?.first_chunk::<POINTS>()?;
        Some(nodes.iter().zip(weights(x)).map(|(node, x)| node * x).sum())
    }

    /// Where a place along the direction of travel and a depth (m) is; `None` beyond the grid.
    #[inline(always)]
    fn locate(&self, along: f64, depth: f64) -> Option<Found> {
        let index = self.layers.iter().rposition(|layer| layer.layer.top <= depth)?;
        let layer = self.layers.get(index)?;
        let down = (depth - layer.layer.top) * layer.layer.per_metre + BEFORE as f64;
        let (station, x) = layer.station(along)?;
        let level = (down as usize).checked_sub(BEFORE)?;
        (level + POINTS <= layer.levels).then_some(Found { layer: index, station, level, x, z: down - level as f64 })
    }

    fn head(&self, arm: &Vector3<f64>, depth: f64) -> Option<f64> {
        let found = self.locate(self.toward[0] * arm.x + self.toward[1] * arm.y, depth)?;
        let layer = self.layers.get(found.layer)?;
        interpolate(layer.heads.get(found.station * layer.levels + found.level..)?, layer.levels, [found.x, found.z])
    }
}

/// What is interpolated at a place among eight by eight nodes, by those from its first one on, levels innermost.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn interpolate(nodes: &[f64], levels: usize, [x, z]: [f64; 2]) -> Option<f64> {
    let (x, z) = (weights(x), weights(z));
    let mut sums = [0.0; POINTS];
    let mut first = 0;
    for x in x {
        let column = nodes.get(first..)?.first_chunk::<POINTS>()?;
        for i in 0..POINTS {
            sums[i] += x * column[i];
        }
        first += levels;
    }
    for i in 0..POINTS {
        sums[i] *= z[i];
    }
    let [a, b, c, d, e, f, g, h] = sums;
    Some(((a + b) + (c + d)) + ((e + f) + (g + h)))
}

impl FilledGrid<'_> {
    /// Pressure head of the waves (m of water) at an arm from the origin and a depth below the mean level (m, not negative); `None` beyond
    /// the grid. Without stretching the depth is that of one of the places for which the grid was filled.
    pub fn head(&self, arm: &Vector3<f64>, depth: f64) -> Option<f64> {
        self.parts.iter().try_fold(0.0, |sum, part| Some(sum + part.head(arm, depth)?))
    }

    /// Elevation of the waves (m) at an arm from the origin.
    pub fn elevation(&self, arm: &Vector3<f64>) -> Option<f64> {
        self.parts.iter().try_fold(0.0, |sum, part| Some(sum + part.elevation(arm)?))
    }

    /// Bounds of the elevation of the waves around the body, lower and upper (m).
    pub fn range(&self) -> [f64; 2] {
        self.parts.iter().fold([0.0; 2], |[low, high], part| {
            let [a, b] = bounds_of_all(&part.bounds);
            [low + a, high + b]
        })
    }

    /// Bounds of the elevation of the waves at an arm from the origin, lower and upper (m).
    pub fn bounds(&self, arm: &Vector3<f64>) -> Option<[f64; 2]> {
        self.parts.iter().try_fold([0.0; 2], |[low, high], part| {
            let (station, _) = part.layers.first()?.station(part.toward[0] * arm.x + part.toward[1] * arm.y)?;
            let [a, b] = part.bounds.get(station)?;
            Some([low + a, high + b])
        })
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
    fn sum_directly(sea: &Sea, time: f64, [x, y]: [f64; 2], depth: f64) -> f64 {
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
    fn grid_pressure_heads_equal_sum_of_waves() {
        for depth in [None, Some(40.0)] {
            let sea = sea(depth);
            let deviation = (0.5 * sea.components.iter().map(|c| c.amplitude.powi(2)).sum::<f64>()).sqrt();
            let grid = PressureGrid::new(&sea, [100.0, 30.0], 100_000).unwrap();
            let (origin, time) = (Vector3::new(820.0, -310.0, 4.5), 9876.5);
            let arms: Vec<Vector3<f64>> = (0..500)
                .map(|n| {
                    let depth = 30.0 * f64::from(n) / 499.0;
                    let n = f64::from(n);
                    Vector3::new(40.0 * (n * 0.7).sin(), 25.0 * (n * 1.3).cos(), sea.level - depth - origin.z)
                })
                .collect();
            let filled = grid.fill(&sea, time, origin, &arms);
            assert!(grid.trains.iter().all(|train| train.layers.len() > 1));
            let mut square = 0.0;
            for arm in &arms {
                let depth = sea.level - (origin.z + arm.z);
                let position = [origin.x + arm.x, origin.y + arm.y];
                let found = filled.head(arm, sea.level - origin.z - arm.z).unwrap();
                square += (found - sum_directly(&sea, time, position, depth)).powi(2);
                let [low, high] = filled.bounds(arm).unwrap();
                let surface = sum_directly(&sea, time, position, 0.0);
                // to the error of the interpolation
                assert!(low - 1e-4 * deviation < surface && surface < high + 1e-4 * deviation);
            }
            // the spacing is chosen for an error of 1e-5 of the deviation at places midway between nodes, in each of two coordinates
            let error = (square / 500.0).sqrt() / deviation;
            assert!(error < 1.7e-5, "{error}");
            assert!(filled.head(&arms[0], 45.0).is_none());
        }
    }

    #[test]
    fn grid_is_refused_where_direct_sum_is_faster() {
        assert!(PressureGrid::new(&sea(None), [100.0, 30.0], 10).is_none());
        let mut spread = sea(None);
        for (n, c) in spread.components.iter_mut().enumerate() {
            c.toward = [(n as f64).cos(), (n as f64).sin()];
        }
        assert!(PressureGrid::new(&spread, [100.0, 30.0], 100_000).is_none());
    }
}
