//! What a slow velocity changes of the mean drift: wave drift damping, and mean drift in a current [ARANHA-1994].
//!
//! A body that moves with the velocity V through deep water has the drift `D - B V`,
//!
//! ```text
//! B_ix = w/g [(4 D_i + w dD_i/dw) cos b - 2 dD_i/db sin b]
//! B_iy = w/g [(4 D_i + w dD_i/dw) sin b + 2 dD_i/db cos b]
//! ```
//!
//! in surge and sway, where D is the drift over the square of the wave amplitude, w the frequency in still water and b the direction of travel.
//! V is the velocity of the body less that of the current: frequencies of a sea are those of an observer who drifts with the current, as its wave numbers
//! are. The change of D with the frequency is that of cubics through the table with the slopes of the polynomials through five neighbours; with
//! the heading it is that of the polynomial by which excitation goes between headings. In water that is not deep for a wave the formula does not
//! hold, and the wave has no part in B.

use super::interpolation::{bracket_frequency, bracket_heading, heading_shares};
use nalgebra::{Matrix2, Rotation2, Vector2};
use std::f64::consts::{PI, TAU};
use windlass_model::{ClassError, DriftTable};

/// Wave number times depth from which water is deep for a wave: half a wave length, where tanh(k h) is 0.996.
const LEAST_DEEP: f64 = PI;
/// Frequencies through which the polynomial of a slope goes.
const SLOPE_NODES: usize = 5;
/// Step of the heading in differences of the drift (rad): that of a trigonometric polynomial of twelfth degree errs by 1e-4.
const HEADING_STEP: f64 = 2e-3;

/// A drift in surge and sway with its changes: by the heading of the table, then the frequency.
#[derive(Clone, Copy, Debug)]
struct DriftSlopes {
    /// N/m2.
    drift: Vector2<f64>,
    /// With the frequency (N s/m2).
    by_frequency: Vector2<f64>,
    /// With the heading (N/m2).
    by_heading: Vector2<f64>,
}

/// What a velocity changes of the mean drift of one table.
#[derive(Clone, Debug)]
pub struct DriftByVelocity {
    frequencies: Vec<f64>,
    headings: Vec<f64>,
    slopes: Vec<Vec<DriftSlopes>>,
    gravity: f64,
    /// The lowest frequency for which the water is deep (rad/s).
    least: f64,
    /// What all is multiplied by.
    factor: f64,
    /// Mean velocity of the current at the surface (m/s, global plan).
    current: Vector2<f64>,
}

/// Water for [`DriftByVelocity`].
#[derive(Clone, Copy, Debug)]
pub struct DriftWater {
    /// m/s2.
    pub gravity: f64,
    /// m; none of deep water.
    pub depth: Option<f64>,
    /// Mean velocity of the current at the surface (m/s, global plan).
    pub current: Vector2<f64>,
}

impl DriftByVelocity {
    /// That of a table in water, times a factor.
    ///
    /// # Errors
    /// A table of one frequency, or with a heading that has no neighbours within 90 degrees, in words.
    pub fn new(table: &DriftTable, water: DriftWater, factor: f64) -> Result<Self, String> {
        if table.frequencies.len() < 2 {
            return Err("its mean drift has one frequency".into());
        }
        let plan = |six: &[f64; 6]| Vector2::new(six[0], six[1]);
        let by_frequency: Vec<Vec<Vector2<f64>>> = table
            .values
            .iter()
            .map(|row| slopes_by_frequency(&table.frequencies, &row.iter().map(plan).collect::<Vec<_>>()))
            .collect();
        let mut slopes = Vec::with_capacity(table.headings.len());
        for ((heading, row), by_frequency) in table.headings.iter().zip(&table.values).zip(by_frequency) {
            let shares = heading_slope_shares(&table.headings, *heading)?;
            let made = row.iter().zip(by_frequency).enumerate().map(|(at, (six, by_frequency))| {
                let value = |place: &usize| table.values.get(*place).and_then(|row| row.get(at)).map(plan);
                let parts = shares.iter().filter_map(|(place, share)| Some(value(place)? * *share));
                DriftSlopes { drift: plan(six), by_frequency, by_heading: parts.sum() }
            });
            slopes.push(made.collect());
        }
        let least = water.depth.map_or(0.0, |depth| (water.gravity / depth * LEAST_DEEP * LEAST_DEEP.tanh()).sqrt());
        let (frequencies, headings) = (table.frequencies.clone(), table.headings.clone());
        Ok(DriftByVelocity {
            frequencies,
            headings,
            slopes,
            gravity: water.gravity,
            least,
            factor,
            current: water.current,
        })
    }

    /// Mean velocity of the current (m/s, global plan).
    pub fn current(&self) -> Vector2<f64> {
        self.current
    }

    /// The frequency of waves (rad/s) by the speed of the current over gravity, in which the formula is linear.
    pub fn speed_number(&self, frequency: f64) -> f64 {
        frequency * self.current.norm() / self.gravity
    }

    /// Whether water is deep for waves of a frequency (rad/s).
    pub fn is_deep(&self, frequency: f64) -> bool {
        frequency >= self.least
    }

    /// The same without what changes with the heading.
    pub(super) fn without_heading_slopes(mut self) -> Self {
        self.slopes.iter_mut().flatten().for_each(|slopes| slopes.by_heading = Vector2::zeros());
        self
    }

    /// How far apart the headings of the table stand about a heading (rad).
    ///
    /// # Errors
    /// A heading in a gap of the table.
    pub(super) fn heading_gap(&self, heading: f64) -> Result<f64, ClassError> {
        let (low, high, _) = bracket_heading(&self.headings, heading)?;
        let count = self.headings.len();
        // of a heading of the table both gaps beside it
        let pairs =
            if low == high { [((low + count - 1) % count, low), (low, (low + 1) % count)] } else { [(low, high); 2] };
        let gaps = pairs.map(|(from, to)| (self.headings[to] - self.headings[from]).rem_euclid(TAU));
        Ok(gaps[0].max(gaps[1]))
    }

    /// The damping over the square of the amplitude (N s/m3) of a wave of a frequency (rad/s) at a heading of the table, by its place: row the force,
    /// column the velocity, on the axes of the table. Nothing where the water is not deep for the wave.
    pub(super) fn damping_at_place(&self, place: usize, frequency: f64) -> Matrix2<f64> {
        let (Some(row), Some(heading)) = (self.slopes.get(place), self.headings.get(place)) else {
            return Matrix2::zeros();
        };
        let (low, high, share) = bracket_frequency(&self.frequencies, frequency);
        let (Some(one), Some(two)) = (row.get(low), row.get(high)) else { return Matrix2::zeros() };
        if !self.is_deep(frequency) {
            return Matrix2::zeros();
        }
        let (drift, slope) = if low == high {
            // the drift is held there
            let ends = self.frequencies.first().zip(self.frequencies.last());
            let is_inside = ends.is_some_and(|(first, last)| frequency >= *first && frequency <= *last);
            (one.drift, if is_inside { one.by_frequency } else { Vector2::zeros() })
        } else {
            cubic(self.frequencies[high] - self.frequencies[low], share, one, two)
        };
        let by_heading = one.by_heading + (two.by_heading - one.by_heading) * share;
        let (sine, cosine) = heading.sin_cos();
        let along = drift * 4.0 + slope * frequency;
        let columns = [along * cosine - by_heading * (2.0 * sine), along * sine + by_heading * (2.0 * cosine)];
        Matrix2::from_columns(&columns) * (self.factor * frequency / self.gravity)
    }

    /// What the mean current adds to the drift over the square of the amplitude (N/m2), at a heading of the table, of a wave of a frequency (rad/s)
    /// toward a direction (rad, global), on the axes of the table.
    pub(super) fn by_current(&self, place: usize, frequency: f64, toward: f64) -> Vector2<f64> {
        let Some(heading) = self.headings.get(place).filter(|_| self.current != Vector2::zeros()) else {
            return Vector2::zeros();
        };
        // the table stands at the yaw `toward - heading`
        self.damping_at_place(place, frequency) * (Rotation2::new(heading - toward) * self.current)
    }

    /// Adds to the drift of a wave of a frequency (rad/s) toward a direction (rad, global) what the mean current makes of it, for a table at a yaw
    /// (rad), on its axes; straight between its headings.
    ///
    /// # Errors
    /// A heading in a gap of the table.
    pub fn in_current(
        &self,
        drift: [f64; 6],
        (toward, yaw): (f64, f64),
        frequency: f64,
    ) -> Result<[f64; 6], ClassError> {
        let (low, high, share) = bracket_heading(&self.headings, toward - yaw)?;
        let [one, two] = [low, high].map(|place| self.by_current(place, frequency, toward));
        let added = one + (two - one) * share;
        let [x, y, rest @ ..] = drift;
        let [z, rx, ry, rz] = rest;
        Ok([x + added.x, y + added.y, z, rx, ry, rz])
    }
}

/// Value and slope of the cubic with the values and slopes of both ends, over a width, at a share of it.
fn cubic(width: f64, t: f64, one: &DriftSlopes, two: &DriftSlopes) -> (Vector2<f64>, Vector2<f64>) {
    let (rise, first, last) = (two.drift - one.drift, one.by_frequency * width, two.by_frequency * width);
    let value =
        one.drift + rise * (t * t * (3.0 - 2.0 * t)) + first * (t * (1.0 - t) * (1.0 - t)) + last * (t * t * (t - 1.0));
    let slope = rise * (6.0 * t * (1.0 - t)) + first * (1.0 - t * (4.0 - 3.0 * t)) + last * (t * (3.0 * t - 2.0));
    (value, slope / width)
}

/// Slopes at frequencies of values there: of the polynomial through the nearest of them.
fn slopes_by_frequency(frequencies: &[f64], values: &[Vector2<f64>]) -> Vec<Vector2<f64>> {
    let count = frequencies.len().min(values.len());
    let nodes = count.min(SLOPE_NODES);
    (0..count)
        .map(|at| {
            let first = at.saturating_sub(nodes / 2).min(count - nodes);
            let near: Vec<usize> = (first..first + nodes).collect();
            near.iter().map(|node| values[*node] * slope_share(frequencies, &near, *node, at)).sum()
        })
        .collect()
}

/// The share of the value at one node in the slope of the polynomial through nodes, at one of them.
fn slope_share(x: &[f64], nodes: &[usize], node: usize, at: usize) -> f64 {
    let others = || nodes.iter().copied().filter(move |other| *other != node);
    if node == at {
        return others().map(|other| 1.0 / (x[at] - x[other])).sum();
    }
    let between = others().filter(|other| *other != at);
    between.map(|other| (x[at] - x[other]) / (x[node] - x[other])).product::<f64>() / (x[node] - x[at])
}

/// The shares of the headings of a table in the change with the heading at one of them (1/rad).
fn heading_slope_shares(headings: &[f64], at: f64) -> Result<Vec<(usize, f64)>, String> {
    let beside = [-HEADING_STEP, HEADING_STEP].map(|step| (step, heading_shares(headings, at + step).ok()));
    let own = heading_shares(headings, at).map_err(|e| e.to_string())?;
    let sides: Vec<(f64, Vec<(usize, f64)>)> =
        beside.into_iter().filter_map(|(step, side)| Some((step, side?))).collect();
    let count = sides.len() as f64;
    if sides.is_empty() {
        return Err(format!(
            "its mean drift toward {:.1} degrees has no other heading within 90 degrees",
            at.to_degrees()
        ));
    }
    let from = |(step, side): (f64, Vec<(usize, f64)>)| {
        let width = step * count;
        let own = own.iter().map(move |(place, share)| (*place, -share / width)).collect::<Vec<_>>();
        side.into_iter().map(move |(place, share)| (place, share / width)).chain(own)
    };
    Ok(sides.into_iter().flat_map(from).collect())
}
