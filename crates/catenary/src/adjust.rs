//! Lengths of the first segment that give a line a wanted force between given ends.
//!
//! The force need not fall with the length: a heavy first segment pulls more when it is longer, and clumps and buoys come off the
//! bottom. So the lengths are sampled, from one too short for its ends to one that lies there without tension, and each change of sign
//! and each extreme between two samples is closed in. Solutions nearer to each other than two samples can be missed where the force has
//! more than one extreme between these.

use super::error::LineError;
use super::line::Line;
use windlass_nonlinear::{BracketedRoot, Halvings};

/// The force that is wanted at the fairlead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aim {
    /// Horizontal force (N).
    Horizontal(f64),
    /// Tension (N).
    Tension(f64),
}

/// All lengths that give a force.
#[derive(Clone, Debug, PartialEq)]
pub struct Lengths {
    /// Of the first segment (m), the shortest first.
    pub found: Vec<f64>,
    /// Bounds between which lengths have no configuration (m).
    pub unsolved: Vec<[f64; 2]>,
}

impl Lengths {
    /// The one nearest to a length (m), and the others.
    pub fn nearest(&self, present: f64) -> Option<(f64, Vec<f64>)> {
        let near = self.found.iter().copied().min_by(|a, b| (a - present).abs().total_cmp(&(b - present).abs()))?;
        Some((near, self.found.iter().copied().filter(|l| *l != near).collect()))
    }
}

/// Evenly spaced samples, and those whose distance from the shortest length grows by a factor.
const EVEN_SAMPLES: u32 = 120;
const GROWING_SAMPLES: u32 = 60;
/// Share of the longest length at which the growing distances begin: a nearly inextensible line goes from slack to tight in that.
const FIRST_DISTANCE: f64 = 1e-7;
/// Most doublings of the longest length, while the force still falls.
const MAX_DOUBLINGS: usize = 40;
/// Steps that close in a change of sign or an extreme.
const MAX_STEPS: usize = 200;
/// Share of the force within which a length gives it.
const FORCE_TOLERANCE: f64 = 1e-9;

/// A length, and its force less the wanted one; none where the line has no configuration.
type Sample = (f64, Option<f64>);

impl Line {
    /// The lengths of the first segment (m) with which the fairlead, `x` beside the anchor and at elevation `fairlead`, bears what is
    /// wanted.
    ///
    /// # Errors
    /// [`LineError`]; among them a force that no length gives.
    pub fn first_lengths(&self, x: f64, fairlead: f64, aim: Aim) -> Result<Lengths, LineError> {
        let (Aim::Horizontal(wanted) | Aim::Tension(wanted)) = aim;
        if !(wanted > 0.0 && wanted.is_finite()) {
            return Err(LineError::Value { what: "the force", segment: 1, value: wanted });
        }
        let mut failed = None;
        let mut off = |length: f64| {
            let state = self.clone().with_first_length(length).and_then(|line| line.at_distance(x, fairlead));
            let force = state.map(|s| match aim {
                Aim::Horizontal(_) => s.force,
                Aim::Tension(_) => s.top_tension,
            });
            force.map_err(|error| failed = Some(error)).ok().map(|force| force - wanted)
        };
        let mut samples: Vec<Sample> = Vec::new();
        for length in self.sampled_lengths(x, fairlead, aim) {
            samples.push((length, off(length)));
        }
        // what hangs deep loses its horizontal force slowly
        for _ in 0..MAX_DOUBLINGS {
            let [.., (_, Some(before)), (length, Some(last))] = samples.as_slice() else { break };
            if *last <= 0.0 || *last >= before * (1.0 - 1e-12) {
                break;
            }
            let longer = 2.0 * length;
            samples.push((longer, off(longer)));
        }
        let least = FORCE_TOLERANCE * wanted;
        let mut nearest = f64::INFINITY;
        let mut found = Vec::new();
        let mut keep = |(length, value): Sample| {
            let Some(value) = value else { return };
            nearest = if value.abs() < nearest.abs() { value } else { nearest };
            if value.abs() <= least {
                found.push(length);
            }
        };
        samples.iter().copied().for_each(&mut keep);
        for pair in samples.windows(2) {
            let [(a, Some(at_a)), (b, Some(at_b))] = pair else { continue };
            if at_a.abs() > least && at_b.abs() > least && at_a * at_b < 0.0 {
                keep(crossing([*a, *b], [*at_a, *at_b], &mut off));
            }
        }
        for three in samples.windows(3) {
            let [(a, Some(at_a)), (_, Some(at)), (b, Some(at_b))] = three else { continue };
            let same = at_a * at > 0.0 && at * at_b > 0.0;
            if same && at.abs() <= at_a.abs() && at.abs() <= at_b.abs() {
                let (length, value) = extreme([*a, *b], at.signum(), &mut off);
                keep((length, Some(value)));
                if value * at < 0.0 {
                    keep(crossing([*a, length], [*at_a, value], &mut off));
                    keep(crossing([length, *b], [value, *at_b], &mut off));
                }
            }
        }
        found.sort_by(f64::total_cmp);
        // a line that only lies down further keeps its force: its lengths are one answer, the shortest of them
        let mut apart: Vec<f64> = Vec::new();
        for length in found {
            let same = apart.last().is_some_and(|last| {
                length - last <= 1e-9 * length || off(0.5 * (last + length)).is_some_and(|v| v.abs() <= least)
            });
            if !same {
                apart.push(length);
            }
        }
        if !apart.is_empty() {
            return Ok(Lengths { found: apart, unsolved: unsolved_intervals(&samples) });
        }
        match failed {
            Some(error) if nearest.is_infinite() => Err(error),
            _ => Err(LineError::NoLength { wanted, nearest: nearest + wanted }),
        }
    }

    /// Lengths from too short to slack, the present one among them.
    fn sampled_lengths(&self, x: f64, fairlead: f64, aim: Aim) -> Vec<f64> {
        let Some((first, others)) = self.segments.split_first() else { return Vec::new() };
        let drop = (fairlead - self.anchor).abs();
        let chord = x.hypot(drop);
        let weight: f64 = self.segments.iter().map(|s| (s.weight * s.length).abs()).sum();
        let wanted = match aim {
            Aim::Tension(tension) => tension,
            Aim::Horizontal(force) if x > 0.0 => force * chord / x,
            Aim::Horizontal(force) => force,
        };
        // a straight line that stretches under the force and all of the weight is shorter than any other
        let most = 2.0 * (wanted + weight);
        let stretched: f64 = others.iter().map(|s| s.length * (1.0 + most / s.ea)).sum();
        let springs: f64 = self.springs.iter().flatten().map(|law| law.stretch(most).0).sum();
        let tight = (chord - stretched - springs) / (1.0 + most / first.ea);
        let rest: f64 = others.iter().map(|s| s.length).sum();
        let size = chord + drop + rest;
        let shortest = tight.max(1e-6 * size);
        // what hangs by itself bears its weight: from there on the tension only grows, or the line lies slack
        let heavy = if first.weight == 0.0 { 0.0 } else { wanted / first.weight.abs() };
        let longest = (3.0 * size).max(2.5 * heavy + 2.0 * size).max(2.0 * first.length);
        let span = longest - shortest;
        let even = (0..=EVEN_SAMPLES).map(|n| f64::from(n) / f64::from(EVEN_SAMPLES));
        let growing =
            (0..GROWING_SAMPLES).map(|n| FIRST_DISTANCE.powf(1.0 - f64::from(n) / f64::from(GROWING_SAMPLES)));
        let mut lengths: Vec<f64> = even.chain(growing).map(|share| shortest + share * span).collect();
        lengths.push(first.length);
        lengths.sort_by(f64::total_cmp);
        lengths.dedup();
        lengths
    }
}

/// The length between two at which the force changes over its wanted value, and what is left there.
fn crossing(ends: [f64; 2], values: [f64; 2], off: &mut impl FnMut(f64) -> Option<f64>) -> Sample {
    // where another part of the line comes to lie on the bottom the force may jump
    let mut search = BracketedRoot::new(ends, values, Halvings::EveryThird);
    for _ in 0..MAX_STEPS {
        let Some(length) = search.propose() else { break };
        let Some(value) = off(length) else { break };
        search.record(length, value);
    }
    let (length, value) = search.best();
    (length, Some(value))
}

/// The length between two at which a force that is too large (`sign` 1) is least, or one too small (-1) largest, by golden sections;
/// one beyond the wanted force ends the search.
fn extreme([mut low, mut high]: [f64; 2], sign: f64, off: &mut impl FnMut(f64) -> Option<f64>) -> (f64, f64) {
    let share = 0.5 * (5.0_f64.sqrt() - 1.0);
    let mut at = |length: f64| (length, off(length).map_or(f64::INFINITY, |v| v * sign));
    let mut left = at(high - share * (high - low));
    let mut right = at(low + share * (high - low));
    for _ in 0..MAX_STEPS {
        if left.1.min(right.1) < 0.0 || high - low <= 1e-10 * high {
            break;
        }
        if left.1 < right.1 {
            (high, right) = (right.0, left);
            left = at(high - share * (high - low));
        } else {
            (low, left) = (left.0, right);
            right = at(low + share * (high - low));
        }
    }
    let (length, value) = if left.1 < right.1 { left } else { right };
    (length, value * sign)
}

/// Where lengths between solved ones, or beyond the last, have no configuration.
fn unsolved_intervals(samples: &[Sample]) -> Vec<[f64; 2]> {
    let solved = |s: &Sample| s.1.is_some();
    let mut gaps = Vec::new();
    let Some(mut from) = samples.iter().position(solved) else { return gaps };
    while let Some(begin) = samples.iter().skip(from).position(|s| !solved(s)).map(|n| from + n) {
        let end = samples.iter().skip(begin).position(solved).map(|n| begin + n);
        let length = |at: usize| samples.get(at).map_or(f64::INFINITY, |s| s.0);
        gaps.push([length(begin), length(end.unwrap_or(samples.len()) - 1)]);
        let Some(end) = end else { break };
        from = end;
    }
    gaps
}
