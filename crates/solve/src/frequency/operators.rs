//! Response amplitude operators: motions in waves of unit amplitude by heading and frequency.

use super::linear::{LinearSystem, Motions};
use super::response::check_memory;
use crate::system::SolveError;
use std::f64::consts::PI;

/// Motions in waves of unit amplitude.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Operators {
    /// Frequencies (rad/s).
    pub frequencies: Vec<f64>,
    /// Directions the waves come from (rad).
    pub headings: Vec<f64>,
    /// By heading, then frequency.
    pub motions: Vec<Vec<Motions>>,
}

impl Operators {
    /// Those of a system.
    ///
    /// # Errors
    /// As [`LinearSystem::operators`]; more than memory is taken for.
    pub fn new(linear: &LinearSystem, frequencies: &[f64], headings: &[f64]) -> Result<Self, SolveError> {
        check_memory(frequencies.len(), headings.len(), linear)?;
        let toward: Vec<f64> = headings.iter().map(|h| h + PI).collect();
        let mut motions: Vec<Vec<Motions>> = vec![Vec::with_capacity(frequencies.len()); headings.len()];
        for frequency in frequencies {
            let own = linear.operators(*frequency, &toward)?;
            motions.iter_mut().zip(own).for_each(|(list, one)| list.push(one));
        }
        Ok(Operators { frequencies: frequencies.to_vec(), headings: headings.to_vec(), motions })
    }

    /// Each heading (rad) and frequency (rad/s) with the motions there.
    pub fn operators(&self) -> impl Iterator<Item = (f64, f64, &Motions)> {
        self.headings
            .iter()
            .zip(&self.motions)
            .flat_map(|(h, list)| self.frequencies.iter().zip(list).map(move |(w, q)| (*h, *w, q)))
    }
}
