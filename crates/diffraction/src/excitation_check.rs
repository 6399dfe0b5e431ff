//! Wave exciting forces by pressure against those by Haskind's relation: what their difference says of a mesh.

use crate::problem::{FrequencyForces, MOTIONS};
use nalgebra::{Complex, Vector3};

/// Share of the largest exciting force of its kind on its body below which a motion is measured by that share.
const LEAST_OF_KIND: f64 = 0.05;
/// Share of the largest exciting force of a motion over all frequencies by which a difference is measured at least: where the force vanishes at a frequency, a
/// small difference is much of it.
const LEAST_OF_PEAK: f64 = 0.2;

/// Exciting forces of a frequency (N, N m for an amplitude of 1 m): heading by heading, six motions a body.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExcitationPair {
    /// By Haskind's relation.
    pub by_haskind: Vec<Vec<Complex<f64>>>,
    /// By the pressure on the hull.
    pub by_pressure: Vec<Vec<Complex<f64>>>,
}

/// How far exciting forces by pressure are off those by Haskind's relation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExcitationDifference {
    /// The motion where they differ most, six a body.
    pub motion: usize,
    /// The difference over the largest force of that motion.
    pub share: f64,
}

impl ExcitationPair {
    /// Both forces of a solution.
    pub fn new(forces: &FrequencyForces) -> Self {
        ExcitationPair { by_haskind: forces.excitation.clone(), by_pressure: forces.pressure_excitation.clone() }
    }

    /// The largest of each motion at all headings: of the difference, and of the force by Haskind's relation.
    fn largest(&self, arms: &[Vector3<f64>]) -> Vec<[f64; 2]> {
        let count = self.by_haskind.first().map_or(0, Vec::len);
        let mut motions = vec![[0.0_f64; 2]; count];
        for (by_haskind, by_pressure) in self.by_haskind.iter().zip(&self.by_pressure) {
            let both = about(by_haskind, arms).into_iter().zip(about(by_pressure, arms));
            for ([difference, largest], (haskind, pressure)) in motions.iter_mut().zip(both) {
                *difference = difference.max((pressure - haskind).norm());
                *largest = largest.max(haskind.norm());
            }
        }
        motions
    }
}

/// Forces with the moments of each body about a point at an arm from its origin (m); bodies without an arm keep theirs.
fn about(forces: &[Complex<f64>], arms: &[Vector3<f64>]) -> Vec<Complex<f64>> {
    let mut moved = forces.to_vec();
    for (own, arm) in moved.chunks_exact_mut(MOTIONS).zip(arms) {
        if let [x, y, z, roll, pitch, yaw] = own {
            *roll -= *z * arm.y - *y * arm.z;
            *pitch -= *x * arm.z - *z * arm.x;
            *yaw -= *y * arm.x - *x * arm.y;
        }
    }
    moved
}

/// Frequency by frequency: the motion whose exciting forces by both ways differ most, over the largest force of that motion at all headings. A motion whose
/// forces are less than a twentieth of the largest of its kind (forces or moments) on its body, as one that symmetry leaves without any, is measured by that twentieth,
/// and every motion by a fifth of its largest force at all frequencies at least. Moments are taken about a point at an arm from the origin of each body (m): about its
/// centre of gravity they are what turns it, while an origin far below adds the moment of the forces, which hides errors. It measures the mesh; none where there are no
/// headings.
pub fn excitation_differences(pairs: &[ExcitationPair], arms: &[Vector3<f64>]) -> Vec<Option<ExcitationDifference>> {
    let all: Vec<Vec<[f64; 2]>> = pairs.iter().map(|pair| pair.largest(arms)).collect();
    let mut least: Vec<f64> = Vec::new();
    for own in &all {
        least.resize(own.len(), 0.0);
        least.iter_mut().zip(own).for_each(|(least, [_, largest])| *least = least.max(LEAST_OF_PEAK * largest));
    }
    let worst = |motions: &Vec<[f64; 2]>| {
        let kind = |motion: usize| {
            let first = motion - motion % 3;
            motions.iter().skip(first).take(3).fold(0.0, |most: f64, [_, largest]| most.max(*largest))
        };
        let share = |(motion, ([difference, largest], least)): (usize, (&[f64; 2], &f64))| {
            let measure = largest.max(LEAST_OF_KIND * kind(motion)).max(*least);
            (measure > 0.0).then_some(ExcitationDifference { motion, share: difference / measure })
        };
        let found = motions.iter().zip(&least).enumerate().filter_map(share);
        found.reduce(|most, other| if other.share > most.share { other } else { most })
    };
    all.iter().map(worst).collect()
}
