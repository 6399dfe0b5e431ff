//! How what varies in time grows from nothing at the start of a run.

use std::f64::consts::PI;

/// The share that has grown at a time (s) over a ramp of a length (s), from 0 to 1, and its change with time (1/s):
/// `(1 - cos(pi t/T))/2`; without a length all is there at once.
pub fn ramp(length: f64, time: f64) -> (f64, f64) {
    if length <= 0.0 || time >= length {
        return (1.0, 0.0);
    }
    if time <= 0.0 {
        return (0.0, 0.0);
    }
    let (sin, cos) = (PI * time / length).sin_cos();
    (0.5 * (1.0 - cos), 0.5 * PI / length * sin)
}
