//! What a dynamic line is made of, as its class says.

use std::f64::consts::FRAC_PI_4;
use windlass_line_dynamics::{RodSegment, SeabedPush, TensionLaw};
use windlass_model::{Ambient, Contents};

/// What stands where a part ends and the next begins.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointMass {
    /// Mass (kg).
    pub mass: f64,
    /// Displaced volume (m3).
    pub volume: f64,
    /// Added mass coefficient on the volume; of what displaces nothing its added mass (kg).
    pub added: f64,
    /// Drag coefficient times area (m2).
    pub drag: f64,
    /// Length of the pendant on which it floats above the line (m).
    pub pendant: f64,
}

/// What a part bears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BreakingStrength {
    /// Breaking tension (N).
    pub breaking: f64,
    /// Whether it was given.
    pub is_given: bool,
}

/// A part of a line: one record of its class.
#[derive(Clone, Debug, PartialEq)]
pub struct LinePart {
    /// Its properties; the number of elements is that of the class.
    pub segment: RodSegment,
    /// What it bears.
    pub strength: BreakingStrength,
    /// What stands at its end, if anything.
    pub joint: Option<JointMass>,
}

/// How the bottom answers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seabed {
    /// Normal stiffness per area (N/m3), where given.
    pub stiffness: Option<f64>,
    /// Normal damping per area (N s/m3), where given.
    pub damping: Option<f64>,
    /// Friction along the line.
    pub along: f64,
    /// Friction across the line; as along where not given.
    pub across: Option<f64>,
    /// Friction by speed alone: of an area, at a coefficient of one (N s/m3).
    pub friction_damping: Option<f64>,
    /// Where the bottom pushes.
    pub push: SeabedPush,
    /// Slope of the bottom, positive where the depth increases from the first end toward the second.
    pub slope: Option<f64>,
    /// Depth of the bottom at the second end below z = 0 (m), where the class says it.
    pub depth: Option<f64>,
    /// Whether it goes with an anchor, wherever that is put, as under lines that rest by a closed form.
    pub with_anchor: bool,
}

impl Seabed {
    /// Whether it is a plane of the line's own.
    pub fn slopes(&self) -> bool {
        self.slope.is_some_and(|s| s != 0.0)
    }
}

/// How an end is held in its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndFixity {
    /// Declination from straight down of the line where it leaves its first end, in the vertical plane of the ends (rad); along
    /// the chord of the ends as defined where not given.
    pub declination: Option<f64>,
    /// Rotational stiffness (N m/rad); rigid where not given.
    pub stiffness: Option<f64>,
}

/// A dynamic line.
#[derive(Clone, Debug, PartialEq)]
pub struct LineDescription {
    /// The class type, for messages.
    pub kind: &'static str,
    /// Its parts from the first end.
    pub parts: Vec<LinePart>,
    /// The bottom under it.
    pub seabed: Seabed,
    /// How its two ends are held; pinned where not.
    pub holds: [Option<EndFixity>; 2],
    /// Whether it is slammed where it enters the water.
    pub slam: bool,
    /// Whether what is reported as the tension at its ends is that in the middle of its end elements.
    pub has_middle_end_tension: bool,
    /// What is always reported of it.
    pub notes: Vec<String>,
}

impl LinePart {
    /// Its properties at an elevation (m, global z), with what grows on it there and with what it holds.
    pub fn with_growth(&self, ambient: Option<&dyn Ambient>, z: f64) -> RodSegment {
        let mut made = self.segment.clone();
        let Some(ambient) = ambient else { return made };
        let (thickness, density) = ambient.growth(z);
        if thickness > 0.0 {
            // it grows on the outside, however large the line is taken for buoyancy, drag or added mass
            let ring = |diameter: f64| FRAC_PI_4 * ((diameter + 2.0 * thickness).powi(2) - diameter * diameter);
            let own = ring(made.contact_diameter);
            made.mass += density * own;
            made.displaced += own;
            made.added_area += ring((made.added_area / FRAC_PI_4).sqrt());
            for diameter in [&mut made.drag_diameter, &mut made.contact_diameter, &mut made.wind_diameter] {
                *diameter += 2.0 * thickness;
            }
        }
        if let (Some(tube), Some(Contents { warmer, pressure, at, density })) = (&mut made.tube, ambient.contents()) {
            (tube.warmer, tube.pressure, tube.at, tube.contents) = (warmer, pressure, at, density);
            made.mass += density * FRAC_PI_4 * tube.inner * tube.inner;
        }
        made
    }

    /// Weight per length in water (N/m).
    pub fn submerged_weight(&self, density: f64, gravity: f64) -> f64 {
        (self.segment.mass - density * self.segment.displaced) * gravity
    }

    /// Tension over strain at no strain (N).
    pub fn ea(&self) -> f64 {
        match &self.segment.axial {
            TensionLaw::Linear(ea) => *ea,
            other => other.evaluate(0.0).1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;
    use windlass_model::Flow;

    /// 50 mm of growth of 1400 kg/m3 everywhere.
    #[derive(Debug)]
    struct Foul;

    impl Ambient for Foul {
        fn flow(&self, _: f64, _: &[Vector3<f64>], _: &mut [Flow]) {}

        fn mean(&self, _: &[Vector3<f64>], _: &mut [Flow]) {}

        fn bottom(&self, _: f64, _: f64) -> Option<(f64, [f64; 2])> {
            None
        }

        fn growth(&self, _: f64) -> (f64, f64) {
            (0.05, 1400.0)
        }
    }

    #[test]
    fn growth_is_on_outside_of_line_at_any_displacement() {
        let bare = RodSegment { displaced: 0.0, ..RodSegment::line(10.0, 1, 100.0, 1e6, 0.3) };
        let strength = BreakingStrength { breaking: 1.0, is_given: true };
        let grown = LinePart { segment: bare.clone(), strength, joint: None }.with_growth(Some(&Foul), -10.0);
        // a ring from 0.3 to 0.4 m
        let ring = FRAC_PI_4 * 0.07;
        assert!((grown.mass - 100.0 - 1400.0 * ring).abs() < 1e-9);
        assert!((grown.displaced - ring).abs() < 1e-12);
        assert!((grown.added_area - FRAC_PI_4 * 0.16).abs() < 1e-12);
        for diameter in [grown.drag_diameter, grown.contact_diameter, grown.wind_diameter] {
            assert!((diameter - 0.4).abs() < 1e-12);
        }
    }
}
