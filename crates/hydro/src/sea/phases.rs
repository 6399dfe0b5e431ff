//! Phases of the components.

use super::Component;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;
use std::f64::consts::TAU;
use windlass_model::options::PHASES;
use windlass_model::{ClassError, Environment, Phasing};

/// Sees that phases which are given (`-PHASES`) are as many as the components.
///
/// # Errors
/// More or fewer.
pub fn one_each(env: &Environment, components: &[Component]) -> Result<(), ClassError> {
    if env.sea_phases.is_empty() || env.sea_phases.len() == components.len() {
        return Ok(());
    }
    let text = format!("-PHASES has {} phases for {} wave components", env.sea_phases.len(), components.len());
    let error = ClassError::new(text)
        .help("one each, in the order of &STATUS SEA_SPECTRUM; -COMPONENTS says how many there are");
    let given = env.options.iter().find(|given| given.is(&PHASES));
    Err(match given {
        Some(option) => error.with_span(option.span),
        None => error,
    })
}

/// Phases (rad) of components by their frequencies (rad/s); `train` is 0 for the sea and 1 for the added sea.
///
/// Reinforced at a time t_r: `phase = w t_r`, as zeta goes with `cos(.. - w t + phase)`. (MOSES writes the same with the other
/// sign of the phase.) Seeded: uniform over a turn, from the upper 53 bits of PCG XSL RR 128/64 with the seed as state and
/// `train` as stream ([ONEILL-2014]; rand_pcg promises these values for good), in the order of the frequencies.
pub fn phases(phasing: Phasing, train: u64, frequencies: impl Iterator<Item = f64>) -> Vec<f64> {
    match phasing {
        Phasing::Reinforced(time) => frequencies.map(|w| (w * time).rem_euclid(TAU)).collect(),
        Phasing::Seeded(seed) => {
            let mut numbers = Pcg64::new(u128::from(seed), u128::from(train));
            frequencies.map(|_| TAU * (numbers.next_u64() >> 11) as f64 / (1u64 << 53) as f64).collect()
        }
    }
}
