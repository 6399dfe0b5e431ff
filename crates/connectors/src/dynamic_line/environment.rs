//! Water and bottom around a line, as the rod asks for them.

use super::describe::Seabed;
use nalgebra::Vector3;
use std::cell::RefCell;
use windlass_line_dynamics::{FluidField, FluidState, PlaneBottom, RodSegment, SeabedLaw, SeabedShape, UniformFluid};
use windlass_model::{Ambient, Flow, Surroundings};

/// How far a line presses itself into the bottom by its own weight, as a share of its diameter: what the bottom's stiffness follows
/// from where none is given.
const DEFAULT_PENETRATION_DIAMETERS: f64 = 0.02;
/// Weight by which a line that water carries meets the bottom, as a share of its weight in air: it comes there by its ends or a current.
pub(super) const BUOYANT_LINE_WEIGHT_SHARE: f64 = 0.1;
/// Damping of the bottom against what is critical for the line on it, where none is given.
const DEFAULT_DAMPING_RATIO: f64 = 0.5;
/// Way within which friction comes to be whole (m).
const DEFAULT_FRICTION_TRAVEL_M: f64 = 0.005;
/// Speed at which it is whole (m/s).
const DEFAULT_FRICTION_SPEED: f64 = 0.01;

/// The water of an environment.
#[derive(Debug)]
pub(super) struct LineWater<'a> {
    pub ambient: Option<&'a dyn Ambient>,
    pub around: &'a Surroundings,
    /// Whether waves are left out: at rest.
    pub mean: bool,
    /// Room for what is asked.
    pub flows: RefCell<Vec<Flow>>,
}

impl FluidField for LineWater<'_> {
    fn sample(&self, position: &Vector3<f64>, time: f64) -> FluidState {
        let mut found = [UniformFluid::vacuum().0];
        self.sample_into(std::slice::from_ref(position), time, &mut found);
        found[0]
    }

    fn sample_into(&self, positions: &[Vector3<f64>], time: f64, out: &mut [FluidState]) {
        let mut flows = self.flows.borrow_mut();
        flows.clear();
        flows.resize(positions.len(), Flow::still_water(self.around.tide));
        match self.ambient {
            Some(ambient) if self.mean => ambient.mean(positions, &mut flows),
            Some(ambient) => ambient.flow(time, positions, &mut flows),
            None => {}
        }
        let (density, air_density) = (self.around.water_density, self.around.air_density);
        for (out, Flow { velocity, acceleration, surface, head, wind }) in out.iter_mut().zip(flows.iter().copied()) {
            *out = FluidState { velocity, acceleration, surface, head, density, wind, air_density };
        }
    }

    fn uniform(&self) -> bool {
        self.ambient.is_none()
    }

    fn is_interrupted(&self) -> bool {
        self.ambient.is_some_and(|a| a.is_interrupted())
    }
}

/// The bottom: a plane of the line's own, the environment's over a grid, or flat at the depth the line or the environment says.
#[derive(Debug)]
pub(super) struct LineSeabed<'a> {
    pub plane: Option<PlaneBottom>,
    /// The environment, where its bottom is a grid.
    pub charted: Option<&'a dyn Ambient>,
    pub flat: f64,
}

impl SeabedShape for LineSeabed<'_> {
    fn height(&self, x: f64, y: f64) -> (f64, [f64; 2]) {
        match &self.plane {
            Some(plane) => plane.height(x, y),
            None => self.charted.and_then(|a| a.bottom(x, y)).unwrap_or((self.flat, [0.0; 2])),
        }
    }

    fn level(&self) -> Option<f64> {
        match &self.plane {
            Some(plane) => plane.level(),
            None => self.charted.is_none().then_some(self.flat),
        }
    }
}

/// How the bottom answers a line of these segments.
pub(super) fn ground(seabed: &Seabed, segments: &[RodSegment], around: &Surroundings) -> SeabedLaw {
    // by the heaviest segment, so that none presses itself in deeper
    let weight = |s: &RodSegment| {
        (s.mass - around.water_density * s.displaced).max(BUOYANT_LINE_WEIGHT_SHARE * s.mass) * around.gravity
    };
    let press = |s: &RodSegment| weight(s) / (DEFAULT_PENETRATION_DIAMETERS * s.contact_diameter * s.contact_diameter);
    let stiffest = segments.iter().map(press).filter(|k| k.is_finite()).fold(0.0, f64::max);
    let stiffness = seabed.stiffness.unwrap_or(stiffest);
    let heavy = segments.iter().map(|s| s.mass / s.contact_diameter).filter(|m| m.is_finite()).fold(0.0, f64::max);
    SeabedLaw {
        stiffness,
        damping: seabed.damping.unwrap_or(2.0 * DEFAULT_DAMPING_RATIO * (stiffness * heavy).sqrt()),
        penetration_scale: 0.0,
        friction_along: seabed.along,
        friction_across: seabed.across.unwrap_or(seabed.along),
        friction_speed: DEFAULT_FRICTION_SPEED,
        friction_travel: DEFAULT_FRICTION_TRAVEL_M,
        friction_damping: seabed.friction_damping,
        push: seabed.push,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_penetrates_seabed_by_share_of_diameter() {
        let around =
            Surroundings { water_density: 1000.0, air_density: 1.2, gravity: 10.0, depth: Some(50.0), tide: 0.0 };
        let segment = |mass: f64| RodSegment { displaced: 0.01, ..RodSegment::line(10.0, 1, mass, 1e6, 0.1) };
        let stiffness = |mass: f64| ground(&Seabed::default(), &[segment(mass), segment(5.0)], &around).stiffness;
        // 100 N/m on a shadow of 0.1 m sink in by 2 mm
        assert!((stiffness(20.0) - 100.0 / (0.1 * 0.002)).abs() < 1e-6);
        // a rope of 0.1 kg/m more than water, which a floor of the stiffness would carry within less than a micrometre
        assert!((stiffness(10.01) - 0.1 * 100.1 / (0.1 * 0.002)).abs() < 1e-6);
        assert!(stiffness(5.0) > 0.0);
    }
}
