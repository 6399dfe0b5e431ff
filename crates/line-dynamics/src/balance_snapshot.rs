//! Energy balance of a rod as numbers and back, for checkpoints of a run.

use super::energy_balance::{Energy, RodEnergyBalance, Work};
use nalgebra::Vector3;

impl RodEnergyBalance {
    /// How many numbers a packed balance has.
    pub const PACKED_LEN: usize = 34;

    /// The balance as numbers.
    pub fn pack(&self) -> [f64; RodEnergyBalance::PACKED_LEN] {
        let work = |w: &Work| [w.ends[0], w.ends[1], w.fluid, w.damping, w.bottom, w.supports, w.given];
        let e = &self.energy;
        let vectors = [self.opened.1, self.force, self.momentum, self.impulse];
        let all = [self.time, self.opened.0, self.turnover]
            .into_iter()
            .chain(work(&self.power))
            .chain(work(&self.work))
            .chain([e.kinetic, e.elastic, e.gravity, e.bottom, e.supports])
            .chain(vectors.iter().flat_map(|v| [v.x, v.y, v.z]));
        let mut made = [0.0; RodEnergyBalance::PACKED_LEN];
        for (position, value) in made.iter_mut().zip(all) {
            *position = value;
        }
        made
    }

    /// The balance that [`RodEnergyBalance::pack`] made numbers of.
    pub fn unpack(from: &[f64; RodEnergyBalance::PACKED_LEN]) -> RodEnergyBalance {
        let work = |at: usize| Work {
            ends: [from[at], from[at + 1]],
            fluid: from[at + 2],
            damping: from[at + 3],
            bottom: from[at + 4],
            supports: from[at + 5],
            given: from[at + 6],
        };
        let vector = |n: usize| Vector3::new(from[22 + 3 * n], from[23 + 3 * n], from[24 + 3 * n]);
        RodEnergyBalance {
            time: from[0],
            opened: (from[1], vector(0)),
            turnover: from[2],
            power: work(3),
            work: work(10),
            energy: Energy {
                kinetic: from[17],
                elastic: from[18],
                gravity: from[19],
                bottom: from[20],
                supports: from[21],
            },
            force: vector(1),
            momentum: vector(2),
            impulse: vector(3),
        }
    }
}
