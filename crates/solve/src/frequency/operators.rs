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
    /// Frequencies of encounter (rad/s) by heading, then frequency; those of the waves where nothing sails.
    pub encounters: Vec<Vec<f64>>,
}

/// Motions in a wave of unit amplitude.
#[derive(Clone, Copy, Debug)]
pub struct Operator<'a> {
    /// Direction the wave comes from (rad).
    pub heading: f64,
    /// Its frequency (rad/s).
    pub frequency: f64,
    /// The frequency (rad/s) of the motions, negative where the bodies overtake the wave.
    pub encounter: f64,
    /// The motions.
    pub motions: &'a Motions,
}

impl Operators {
    /// Those of a system at frequencies (rad/s), for headings that waves come from (rad).
    ///
    /// # Errors
    /// As [`LinearSystem::operators`]; more than memory is taken for.
    pub fn new(linear: &LinearSystem, frequencies: &[f64], headings: &[f64]) -> Result<Self, SolveError> {
        check_memory(frequencies.len(), headings.len(), linear)?;
        let toward: Vec<f64> = headings.iter().map(|h| h + PI).collect();
        let mut motions: Vec<Vec<Motions>> = vec![Vec::with_capacity(frequencies.len()); headings.len()];
        let mut encounters = vec![Vec::with_capacity(frequencies.len()); headings.len()];
        for frequency in frequencies {
            let own = linear.operators(*frequency, &toward)?;
            motions.iter_mut().zip(own).for_each(|(list, one)| list.push(one));
            for (list, toward) in encounters.iter_mut().zip(&toward) {
                list.push(linear.encounter(*frequency, *toward)?);
            }
        }
        Ok(Operators { frequencies: frequencies.to_vec(), headings: headings.to_vec(), motions, encounters })
    }

    /// The motions of each heading and frequency.
    pub fn operators(&self) -> impl Iterator<Item = Operator<'_>> {
        let by_heading = self.headings.iter().zip(&self.motions).zip(&self.encounters);
        by_heading.flat_map(|((heading, list), met)| {
            let heading = *heading;
            let all = self.frequencies.iter().zip(list).zip(met);
            all.map(move |((frequency, motions), encounter)| Operator {
                heading,
                frequency: *frequency,
                encounter: *encounter,
                motions,
            })
        })
    }
}
