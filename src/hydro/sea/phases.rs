//! Phases of the components.

use crate::model::Phasing;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;
use std::f64::consts::TAU;

/// Phases (rad) of components by their frequencies (rad/s); `train` is 0 for the sea and 1 for the added sea.
///
/// Reinforced at a time t_r: `phase = w t_r`, as zeta goes with `cos(.. - w t + phase)`. (MOSES writes the same with the other
/// sign of the phase.) Seeded: uniform over a turn, from the upper 53 bits of PCG XSL RR 128/64 with the seed as state and
/// `train` as stream (O'Neill 2014; rand_pcg promises these values for good), in the order of the frequencies.
pub fn phases(phasing: Phasing, train: u64, frequencies: impl Iterator<Item = f64>) -> Vec<f64> {
    match phasing {
        Phasing::Reinforced(time) => frequencies.map(|w| (w * time).rem_euclid(TAU)).collect(),
        Phasing::Seeded(seed) => {
            let mut numbers = Pcg64::new(u128::from(seed), u128::from(train));
            frequencies.map(|_| TAU * (numbers.next_u64() >> 11) as f64 / (1u64 << 53) as f64).collect()
        }
    }
}
