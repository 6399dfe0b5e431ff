//! Radiation in time: the added mass at infinite frequency, and the memory of the water as a kernel.
//!
//! [CUMMINS-1962]: `F = -A_inf a - int_0^inf K(s) v(t - s) ds`. [OGILVIE-1964]:
//! `K(t) = 2/pi int_0^inf B(w) cos(w t) dw`, `A_inf = A(w) + 1/w int_0^inf K(t) sin(w t) dt`.

use super::interpolation::moved_matrix;
use nalgebra::Matrix6;
use std::f64::consts::PI;
use windlass_model::{ClassError, Database};

/// Memory where none is given (s), when the kernel has died away by then.
pub const USUAL_MEMORY: f64 = 60.0;
/// The longest memory that is chosen (s).
const LONGEST_MEMORY: f64 = 300.0;
/// What is left of the kernel, over its largest value, that is let go.
const TRUNCATION_TOLERANCE: f64 = 2e-3;
/// How far beyond the last frequency damping is continued, over it, and in how many parts.
const TAIL: (f64, usize) = (8.0, 60);

/// The radiation of a body about its origin, body axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Radiation {
    /// Frequencies of the damping: zero, those of the source, and a tail falling as 1/w3 to nothing (rad/s).
    frequencies: Vec<f64>,
    /// Damping at them, straight between.
    damping: Vec<Matrix6<f64>>,
    /// Added mass at infinite frequency (kg, kg m, kg m2).
    pub infinite: Matrix6<f64>,
    /// Where it is not given but found by Ogilvie's relation: how far single frequencies stray from it, over its diagonal.
    pub estimated: Option<f64>,
}

impl Radiation {
    /// That of a database; `None` where it has none. An added mass at infinite frequency that it lacks is the mean of Ogilvie's relation over
    /// its frequencies, those of short waves with the more weight (w2).
    ///
    /// # Errors
    /// Fewer than two frequencies.
    pub fn new(data: &Database) -> Result<Option<Self>, ClassError> {
        let (Some(last), Some(end)) = (data.frequencies.last(), data.damping.last()) else { return Ok(None) };
        if data.frequencies.len() < 2 {
            let text = format!("the database ({}) has one frequency only: its radiation has no memory", data.source);
            return Err(ClassError::new(text));
        }
        let mut frequencies = vec![0.0];
        let mut damping = vec![Matrix6::zeros()];
        frequencies.extend(&data.frequencies);
        damping.extend(data.damping.iter().map(|b| moved_matrix(b, data.reference)));
        let end = moved_matrix(end, data.reference);
        let (reach, parts) = TAIL;
        for n in 1..=parts {
            let over = reach.powf(n as f64 / parts as f64);
            frequencies.push(last * over);
            damping.push(if n < parts { end / over.powi(3) } else { Matrix6::zeros() });
        }
        let mut radiation = Radiation { frequencies, damping, infinite: Matrix6::zeros(), estimated: None };
        match data.infinite {
            Some(given) => radiation.infinite = moved_matrix(&given, data.reference),
            None => {
                let added: Vec<Matrix6<f64>> =
                    data.added_mass.iter().map(|a| moved_matrix(a, data.reference)).collect();
                let (infinite, stray) = radiation.by_ogilvie(&data.frequencies, &added);
                (radiation.infinite, radiation.estimated) = (infinite, Some(stray));
            }
        }
        Ok(Some(radiation))
    }

    /// The kernel at a time (N/m, N, N m): exact for damping that is straight between its frequencies (Filon).
    pub fn kernel_at(&self, time: f64) -> Matrix6<f64> {
        let lines = || self.frequencies.windows(2).zip(self.damping.windows(2));
        let mut sum = Matrix6::zeros();
        if time == 0.0 {
            for (w, b) in lines() {
                if let ([w0, w1], [b0, b1]) = (w, b) {
                    sum += (b0 + b1) * (0.5 * (w1 - w0));
                }
            }
            return sum * (2.0 / PI);
        }
        // int (b0 + s (w - w0)) cos(w t) dw, of which the terms b sin(w t) / t cancel from line to line and vanish at both ends
        let mut before = 1.0;
        for (w, b) in lines() {
            if let ([w0, w1], [b0, b1]) = (w, b) {
                let cos = (w1 * time).cos();
                sum += (b1 - b0) * ((cos - before) / (w1 - w0));
                before = cos;
            }
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
        PI / (10.0 * self.frequencies.iter().rev().nth(TAIL.1).copied().unwrap_or(1.0))
    }

    /// The memory after which what is left of the kernel is two thousandths of its largest (s): 60 s, or more up to 300 s.
    pub fn memory(&self) -> f64 {
        let largest = self.kernel_at(0.0).diagonal();
        let scale = |i: usize, j: usize| (largest[i] * largest[j]).abs().sqrt().max(f64::MIN_POSITIVE);
        let alive = |t: f64| {
            let kernel = self.kernel_at(t);
            (0..6).any(|i| (0..=i).any(|j| kernel[(i, j)].abs() > TRUNCATION_TOLERANCE * scale(i, j)))
        };
        let step = 0.25 * PI / self.frequencies.iter().rev().nth(TAIL.1).copied().unwrap_or(1.0).max(0.1);
        let from = (USUAL_MEMORY / step).ceil() as usize;
        let to = (LONGEST_MEMORY / step).floor() as usize;
        let last = (from..=to).rev().find(|n| alive(*n as f64 * step));
        last.map_or(USUAL_MEMORY, |n| n as f64 * step)
    }

    /// Added mass at infinite frequency (kg, kg m, kg m2) from values at frequencies (rad/s), and how far those stray from it (a share of its
    /// largest entry).
    pub fn by_ogilvie(&self, frequencies: &[f64], added: &[Matrix6<f64>]) -> (Matrix6<f64>, f64) {
        let single: Vec<Matrix6<f64>> =
            frequencies.iter().zip(added).map(|(w, a)| a + self.sine_part(*w) / *w).collect();
        let weight: f64 = frequencies.iter().map(|w| w * w).sum();
        let mean = frequencies.iter().zip(&single).map(|(w, a)| a * (w * w / weight)).sum::<Matrix6<f64>>();
        let mut stray: f64 = 0.0;
        for i in 0..6 {
            let size = mean[(i, i)].abs();
            let square: f64 =
                frequencies.iter().zip(&single).map(|(w, a)| w * w / weight * (a[(i, i)] - mean[(i, i)]).powi(2)).sum();
            if size > 0.0 {
                stray = stray.max(square.sqrt() / size);
            }
        }
        (mean, stray)
    }

    /// `int_0^inf K(t) sin(w t) dt = 2 w/pi PV int B(s) / (w2 - s2) ds`, in closed form for damping straight between its frequencies.
    ///
    /// `2 w/(w2 - s2) = 1/(w - s) + 1/(w + s)`, and each gives logarithms. Those of `w - s` at a frequency of the list itself cancel
    /// between the lines before and behind it, which have the same value there: they are left out.
    fn sine_part(&self, w: f64) -> Matrix6<f64> {
        let log = |x: f64| if x.abs() <= 1e-12 * w { 0.0 } else { x.abs().ln() };
        let mut sum = Matrix6::zeros();
        for (ends, b) in self.frequencies.windows(2).zip(self.damping.windows(2)) {
            let ([s0, s1], [b0, b1]) = (ends, b) else { continue };
            let slope = (b1 - b0) / (s1 - s0);
            let cut = b0 - slope * *s0;
            // int (cut + slope s)/(w - s) ds = -(cut + slope w) ln|w - s| - slope s
            // int (cut + slope s)/(w + s) ds = (cut - slope w) ln(w + s) + slope s
            let near = (cut + slope * w) * (log(w - s0) - log(w - s1));
            let far = (cut - slope * w) * (log(w + s1) - log(w + s0));
            sum += near + far;
        }
        sum / PI
    }
}
