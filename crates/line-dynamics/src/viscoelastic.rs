//! Viscoelastic rope: a standard linear solid with static and dynamic stiffness.

use super::mesh::{Rod, RodElement};
use super::section::TensionLaw;
use super::state::RodState;
use nalgebra::Vector3;
use windlass_nonlinear::bisect;

/// Halvings of the strain of a slack rope: to the last digit of its share of the bracket.
const SLACK_HALVINGS: usize = 60;

/// A rope with a static and a dynamic stiffness, as one of polyester: a standard linear solid, the slow law with a
/// Maxwell element beside it, whose spring makes up the dynamic stiffness and whose damper lets it go within the
/// relaxation time.
///
/// The strain by which the damper has yielded is the mean strain of the last relaxation times, and the slow tension at
/// it the mean tension, by which the dynamic stiffness goes: EA_d = a + b T_mean ([API-RP-2SM; DNV-RP-E305];
/// the pair of static and dynamic stiffness after [FALKENBERG-2017]). In statics the slow law is left. Where the slow law is the stiffer of
/// the two it acts alone.
#[derive(Clone, Debug, PartialEq)]
pub struct ViscoelasticRope {
    /// Tension by strain when pulled slowly; not another viscoelastic law.
    pub slow: TensionLaw,
    /// Stiffness when pulled fast: a (N), and b (N of stiffness per N of mean tension).
    pub fast: [f64; 2],
    /// Relaxation time (s) of the Maxwell element: its damper over its spring.
    pub relaxation: f64,
}

/// How the stretch of the Maxwell spring follows the strain: stretch = `kept` + `follows` * strain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct MaxwellMemory {
    pub kept: f64,
    pub follows: f64,
}

impl MaxwellMemory {
    /// For an instantaneous change of strain, with the damper at its strain `yielded`.
    pub fn instantaneous(yielded: f64) -> Self {
        MaxwellMemory { kept: -yielded, follows: 1.0 }
    }

    /// After a share `alpha` of the relaxation time in which the strain went evenly from `before` to where it is: the
    /// exact answer of dy/dt = d(strain)/dt - y / tau.
    fn from_relaxation_over_step(alpha: f64, before: f64, yielded: f64) -> Self {
        let follows = if alpha > 0.0 { -(-alpha).exp_m1() / alpha } else { 1.0 };
        MaxwellMemory { kept: (-alpha).exp() * (before - yielded) - follows * before, follows }
    }
}

impl ViscoelasticRope {
    /// Stiffness of the Maxwell spring (N) where its damper has yielded by a strain, and its slope.
    fn maxwell_stiffness(&self, yielded: f64) -> (f64, f64) {
        let (mean, slope) = self.slow.evaluate(yielded);
        let stiffness = self.fast[0] + self.fast[1] * mean - slope;
        if stiffness > 0.0 {
            (stiffness, self.fast[1] * slope - self.slow.second_derivative(yielded))
        } else {
            (0.0, 0.0)
        }
    }

    /// Tension of the Maxwell element (N) at a strain, and its slope by the strain.
    pub(super) fn maxwell_tension(&self, strain: f64, memory: &MaxwellMemory) -> (f64, f64) {
        let y = memory.kept + memory.follows * strain;
        let (stiffness, slope) = self.maxwell_stiffness(strain - y);
        (stiffness * y, stiffness * memory.follows + y * slope * (1.0 - memory.follows))
    }

    /// Energy of a strain per unstretched length (J/m), and power lost in the damper (W/m).
    pub(super) fn energy_and_loss(&self, strain: f64, yielded: f64) -> (f64, f64) {
        let y = strain - yielded;
        let (stiffness, slope) = self.maxwell_stiffness(yielded);
        let lost = (stiffness - 0.5 * slope * y) * y * y / self.relaxation;
        (self.slow.energy(strain) + 0.5 * stiffness * y * y, lost)
    }

    /// Strain of a rope that is slack: that at which it has no tension. It shrinks as its damper goes back.
    fn slack_strain(&self, memory: &MaxwellMemory) -> f64 {
        // without the Maxwell spring's pull there is tension, at no strain there is none
        let high = -memory.kept / memory.follows.max(f64::MIN_POSITIVE);
        let [low, _] = bisect([0.0, high], SLACK_HALVINGS, |strain| {
            self.slow.evaluate(strain).0 + self.maxwell_tension(strain, memory).0 <= 0.0
        });
        low.max(0.0)
    }

    pub(super) fn find_fault(&self) -> Option<(f64, &'static str)> {
        let [a, b] = self.fast;
        if matches!(self.slow, TensionLaw::Viscoelastic(_)) {
            return Some((a, "its slow law must not be viscoelastic itself"));
        }
        if let Some(fault) = self.slow.find_fault() {
            return Some(fault);
        }
        if !(a.is_finite() && a >= self.slow.evaluate(0.0).1) {
            return Some((a, "its dynamic stiffness must be no less than the static one"));
        }
        if !(b.is_finite() && b >= 0.0) {
            return Some((b, "its dynamic stiffness must not fall with the mean tension"));
        }
        if !(self.relaxation.is_finite() && self.relaxation > 0.0) {
            return Some((self.relaxation, "its relaxation time must be positive"));
        }
        None
    }
}

/// Strain of the rope in an element of a rod between two positions: less the thermal one, and of a slack one its own.
pub(super) fn rope_strain(
    rod: &Rod,
    element: &RodElement,
    rope: &ViscoelasticRope,
    [a, b]: [&Vector3<f64>; 2],
    memory: &MaxwellMemory,
) -> f64 {
    let free = rod.segments[element.segment].tube.as_ref().map_or(0.0, |t| t.expansion * t.warmer);
    let strain = (b - a).norm() / element.rest - 1.0 - free;
    let taut = strain > 0.0 && rope.slow.evaluate(strain).0 + rope.maxwell_tension(strain, memory).0 >= 0.0;
    if element.compression || taut { strain } else { rope.slack_strain(memory) }
}

/// The strain of each element of a rod, where any of them remembers it: yielded in full.
pub(super) fn yielded_strains(rod: &Rod, position: &[Vector3<f64>]) -> Vec<f64> {
    if !rod.is_viscoelastic() {
        return Vec::new();
    }
    let pairs = rod.elements.iter().zip(position.windows(2));
    let strain = |(element, x): (&RodElement, &[Vector3<f64>])| {
        // a spring that has let go of everything
        let all = MaxwellMemory::default();
        rod.viscoelastic_law(element).map_or(0.0, |rope| rope_strain(rod, element, rope, [&x[0], &x[1]], &all))
    };
    pairs.map(strain).collect()
}

/// How each element follows its strain over a step of `h` seconds from a state; zero for at once.
pub(super) fn update_memory(rod: &Rod, from: &RodState, h: f64, memory: &mut [MaxwellMemory]) {
    let elements = rod.elements.iter().zip(from.position.windows(2)).zip(&from.yielded);
    for (memory, ((element, x), yielded)) in memory.iter_mut().zip(elements) {
        if let Some(rope) = rod.viscoelastic_law(element) {
            let before = rope_strain(rod, element, rope, [&x[0], &x[1]], &MaxwellMemory::instantaneous(*yielded));
            *memory = MaxwellMemory::from_relaxation_over_step(h / rope.relaxation, before, *yielded);
        }
    }
}

/// Where the dampers have yielded to at the end of a step.
pub(super) fn set_yielded_strains(rod: &Rod, memory: &[MaxwellMemory], state: &mut RodState) {
    let elements = rod.elements.iter().zip(state.position.windows(2)).zip(memory);
    for (yielded, ((element, x), memory)) in state.yielded.iter_mut().zip(elements) {
        if let Some(rope) = rod.viscoelastic_law(element) {
            let strain = rope_strain(rod, element, rope, [&x[0], &x[1]], memory);
            *yielded = strain - (memory.kept + memory.follows * strain);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn viscoelastic_slope_matches_tension_finite_difference() {
        let slow = [
            TensionLaw::Linear(1e7),
            TensionLaw::Polynomial(vec![8e6, 3e7, 2e8]),
            TensionLaw::Table(vec![(0.0, 0.0), (0.02, 2e5), (0.1, 1.8e6)]),
        ];
        for slow in slow {
            let rope = ViscoelasticRope { slow, fast: [2e7, 12.0], relaxation: 30.0 };
            assert_eq!(rope.find_fault(), None);
            for alpha in [0.0, 1e-3, 0.7, 1e3] {
                let memory = MaxwellMemory::from_relaxation_over_step(alpha, 0.015, 0.012);
                let (h, strain) = (1e-7, 0.031);
                let slope = (rope.maxwell_tension(strain + h, &memory).0 - rope.maxwell_tension(strain - h, &memory).0)
                    / (2.0 * h);
                // central differences of forces of order 1e6 N
                assert!(
                    (slope - rope.maxwell_tension(strain, &memory).1).abs() < 1e-2 + 1e-8 * slope.abs(),
                    "{rope:?} {alpha}"
                );
            }
        }
    }

    #[test]
    fn held_strain_relaxes_exponentially_at_any_step() {
        // y = y0 exp(-t / tau)
        for steps in [1, 7, 200] {
            let alpha = 1.3 / steps as f64;
            let yielded = (0..steps).fold(0.0, |yielded, _| {
                let memory = MaxwellMemory::from_relaxation_over_step(alpha, 0.02, yielded);
                0.02 - (memory.kept + memory.follows * 0.02)
            });
            // exact but for rounding
            assert!((0.02 - yielded - 0.02 * (-1.3f64).exp()).abs() < 1e-15);
        }
    }
}
