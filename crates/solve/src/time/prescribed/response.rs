//! A body that answers each wave of the sea as a table says.

use super::super::forces::BodyMotion;
use super::{DofMotion, Prescribed, motion_from_dofs};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use windlass_base::geometry::{Place, unit_vector};
use windlass_base::units::Dim;
use windlass_hydro::sea::Sea;
use windlass_model::{ClassError, ResponseRow, Responses};

/// A body that rides on the waves about its place.
#[derive(Debug)]
pub(super) struct RaoMotion {
    position: Place,
    sea: Option<Arc<Sea>>,
    /// Of each wave its frequency (rad/s), and of each degree of freedom the factors of cos(w t) and sin(w t) (m, rad).
    waves: Vec<(f64, [(f64, f64); 6])>,
}

/// A complex response: real and imaginary part, of `amplitude exp(i lag)`.
type ComplexPair = (f64, f64);

fn interpolate_pairs(a: [ComplexPair; 6], b: [ComplexPair; 6], share: f64) -> [ComplexPair; 6] {
    std::array::from_fn(|i| (a[i].0 + (b[i].0 - a[i].0) * share, a[i].1 + (b[i].1 - a[i].1) * share))
}

fn pairs(row: &ResponseRow) -> [ComplexPair; 6] {
    row.values.map(|(amplitude, lag)| (amplitude * lag.cos(), amplitude * lag.sin()))
}

/// Responses at a frequency, straight between the rows in their real and imaginary parts. Waves longer than the longest have its
/// response; shorter ones than the shortest none.
fn by_frequency(rows: &[ResponseRow], frequency: f64) -> [ComplexPair; 6] {
    let after = rows.partition_point(|r| r.frequency < frequency);
    match (after.checked_sub(1).and_then(|n| rows.get(n)), rows.get(after)) {
        (Some(low), Some(high)) => {
            let share = (frequency - low.frequency) / (high.frequency - low.frequency);
            interpolate_pairs(pairs(low), pairs(high), share)
        }
        (None, Some(first)) => pairs(first),
        (_, None) => [(0.0, 0.0); 6],
    }
}

/// An angle from 0 to a turn.
fn whole(angle: f64) -> f64 {
    angle.rem_euclid(TAU)
}

/// Responses to a wave that comes from a heading (rad, from the body's x axis toward its y axis).
///
/// # Errors
/// A heading that lies between none of the table.
fn response_at(table: &Responses, heading: f64, frequency: f64) -> Result<[ComplexPair; 6], ClassError> {
    let from = whole(heading);
    if table.symmetric && from > PI {
        // mirrored in the plane of x and z: sway, roll and yaw change their sign
        let mut found = response_between(table, TAU - from, frequency)?;
        for n in [1, 3, 5] {
            found[n] = (-found[n].0, -found[n].1);
        }
        return Ok(found);
    }
    response_between(table, from, frequency)
}

fn response_between(table: &Responses, from: f64, frequency: f64) -> Result<[ComplexPair; 6], ClassError> {
    const EQUAL_VALUES: f64 = 1e-9;
    if let Some((_, rows)) = table.headings.iter().find(|(h, _)| (h - from).abs() <= EQUAL_VALUES) {
        return Ok(by_frequency(rows, frequency));
    }
    let after = table.headings.partition_point(|(h, _)| *h < from);
    let low = after.checked_sub(1).and_then(|n| table.headings.get(n));
    let (low, high, turn) = match (low, table.headings.get(after)) {
        (Some(low), Some(high)) => (Some(low), Some(high), high.0 - low.0),
        // round by the north: from the last heading to the first one
        _ => {
            let ends = (table.headings.last(), table.headings.first());
            let turn = ends.0.zip(ends.1).map_or(TAU, |(a, b)| b.0 + TAU - a.0);
            (ends.0, ends.1, turn)
        }
    };
    match (low, high) {
        // a gap wider than a right angle is no table
        (Some(low), Some(high)) if table.headings.len() > 1 && turn <= 0.5 * PI + EQUAL_VALUES => {
            let share = whole(from - low.0) / turn;
            Ok(interpolate_pairs(by_frequency(&low.1, frequency), by_frequency(&high.1, frequency), share))
        }
        _ => Err(ClassError::with_values("waves come from {} of the body, and its table of responses has no headings within 90 degrees on both sides", &[(from, Dim::Angle)])
            .help("give more headings, or -SYMMETRIC where the table is of one side")),
    }
}

impl RaoMotion {
    /// That of a body at a place.
    pub(super) fn new(position: Place, table: &Responses, sea: Option<&Arc<Sea>>) -> Result<Self, ClassError> {
        let [x, y, _] = position.shift;
        let yaw = position.turn[2];
        let (cos, sin) = unit_vector(yaw);
        let components = sea.map_or(&[][..], |s| s.components.as_slice());
        let mut waves = Vec::with_capacity(components.len());
        for wave in components {
            let [tx, ty] = wave.toward;
            // waves come from where they do not go
            let heading = (-ty).atan2(-tx) - yaw;
            let found = response_at(table, heading, wave.frequency)?;
            // of Re(R exp(i (q0 - w t))), q0 the phase of the crest at the body's origin
            let (s, c) = (wave.number * (tx * x + ty * y) + wave.phase).sin_cos();
            let own = found.map(|(re, im)| {
                let (re, im) = (re * c - im * s, re * s + im * c);
                (wave.amplitude * re, wave.amplitude * im)
            });
            // surge and sway along global axes
            let [surge, sway, rest @ ..] = own;
            let turn = |a: f64, b: f64| (a * cos - b * sin, a * sin + b * cos);
            let ((xr, yr), (xi, yi)) = (turn(surge.0, sway.0), turn(surge.1, sway.1));
            let [heave, roll, pitch, yawing] = rest;
            waves.push((wave.frequency, [(xr, xi), (yr, yi), heave, roll, pitch, yawing]));
        }
        Ok(RaoMotion { position, sea: sea.cloned(), waves })
    }

    /// The ramp of the sea with its derivatives: `(1 - cos(pi t/T))/2`.
    fn ramp_factor(&self, time: f64) -> [f64; 3] {
        let (over, start) = self.sea.as_ref().map_or((0.0, 0.0), |s| (s.ramp, s.ramp_start));
        let time = time - start;
        if over <= 0.0 || time >= over {
            return [1.0, 0.0, 0.0];
        }
        if time <= 0.0 {
            return [0.0; 3];
        }
        let rate = PI / over;
        let (sin, cos) = (rate * time).sin_cos();
        [0.5 * (1.0 - cos), 0.5 * rate * sin, 0.5 * rate * rate * cos]
    }
}

impl Prescribed for RaoMotion {
    fn motion_at(&self, time: f64) -> Result<BodyMotion, ClassError> {
        let mut sums: DofMotion = [[0.0; 6]; 3];
        for (w, pairs) in &self.waves {
            let (sin, cos) = (w * time).sin_cos();
            for (i, (re, im)) in pairs.iter().enumerate() {
                let (value, beside) = (re * cos + im * sin, im * cos - re * sin);
                sums[0][i] += value;
                sums[1][i] += w * beside;
                sums[2][i] -= w * w * value;
            }
        }
        let (grown, mean) = (self.ramp_factor(time), self.position.values());
        let mut dofs: DofMotion = [[0.0; 6]; 3];
        for i in 0..6 {
            let [value, rate, second] = super::product(grown, [sums[0][i], sums[1][i], sums[2][i]]);
            dofs[0][i] = mean[i] + value;
            dofs[1][i] = rate;
            dofs[2][i] = second;
        }
        Ok(motion_from_dofs(&dofs))
    }
}
