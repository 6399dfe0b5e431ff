//! The description of an installed tether [AQWA-TETHER 7.1 and 8.2]: what it is made of and how it hangs at the start.

use super::axis::TetherAxis;
use super::tension::TensionModel;
use super::tether::InstalledTether;
use crate::description::{TetherArrangement, TetherDescription as Listed, TetherEnd};
use crate::structure::flow::WaterFlow;
use nalgebra::Vector3;
use windlass_model::ClassError;

/// The numbers of the description beside those of the elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstalledDescription {
    /// The attachment at the start (m, global).
    pub attachment: Vector3<f64>,
    /// Length unstretched (m).
    pub unstretched: f64,
    /// Distance from anchor to attachment at the start (m).
    pub distance: f64,
    /// Axial stiffness of the whole with its end springs (N/m).
    pub stiffness: f64,
    /// Weight in air, what is inside counted (N).
    pub weight: f64,
    /// Buoyancy without caps, wholly under water: negative (N).
    pub buoyancy: f64,
    /// What pressure does not do on the caps of the vertical tether: downward at the anchor's, upward at the structure's (N).
    pub caps: f64,
    /// Reaction of the free hanging tether: the sum of the three (N).
    pub hanging: f64,
    /// Effective tension in the middle at the start (N).
    pub tension: f64,
}

impl InstalledDescription {
    /// That of a tether with its attachment at a place (m, global).
    ///
    /// # Errors
    /// A tether that cannot be reckoned with, or is too short for its span.
    pub fn new(tether: &InstalledTether, attachment: Vector3<f64>, flow: &WaterFlow) -> Result<Self, ClassError> {
        tether.check()?;
        let distance = (attachment - tether.anchor).norm();
        tether.spans(distance)?;
        let Some(axis) = TetherAxis::new(tether.anchor, attachment) else {
            return Err(ClassError::new(format!("tether {} hangs straight below its anchor", tether.name)));
        };
        let (density, gravity) = (flow.density, flow.gravity);
        let axial = TensionModel::new(tether, [density, gravity], false);
        let water = flow.at_time(0.0);
        let tension = axial.tension(&axis, attachment.z, 0.0, &water);
        let line = &tether.line;
        let inside = |e: &crate::TetherElement| tether.fluid.density * e.tube().internal_area() * e.length;
        let weight = line.weight(gravity) + gravity * line.elements().iter().map(inside).sum::<f64>();
        let buoyancy = -line.buoyancy(density, gravity);
        let top = tether.anchor.z + line.length();
        let caps = tether.caps[0] * water.hydrostatic(tether.anchor.z) - tether.caps[1] * water.hydrostatic(top);
        Ok(InstalledDescription {
            attachment,
            unstretched: line.length(),
            distance,
            stiffness: axial.stiffness(),
            weight,
            buoyancy,
            caps,
            hanging: weight + buoyancy + caps,
            tension: tension.bottom + 0.5 * axial.weight() * tension.cosine,
        })
    }

    /// The listing of it [AQWA-TETHER 7.1]: the tether's number from 1, and what the nodes at anchor and attachment are called. A lower stop
    /// that is not given is infinitely far down.
    pub fn to_listing<'a>(
        &self,
        tether: &'a InstalledTether,
        (number, [anchor, vessel]): (usize, [&str; 2]),
        centre: Vector3<f64>,
        flow: &WaterFlow,
    ) -> Listed<'a> {
        let ends = [
            TetherEnd { node: anchor.into(), given: tether.anchor.into(), initial: tether.anchor.into() },
            TetherEnd {
                node: vessel.into(),
                given: (centre + tether.attachment).into(),
                initial: self.attachment.into(),
            },
        ];
        let springs = [tether.anchor_springs, tether.vessel_springs].map(|s| [s.inline, s.rotation[0], s.rotation[1]]);
        Listed {
            number,
            configuration: TetherArrangement::Installed,
            line: &tether.line,
            ends,
            springs,
            caps: tether.caps,
            stop: tether.lower_stop.unwrap_or(f64::INFINITY),
            density: flow.density,
            gravity: flow.gravity,
            internal: [tether.fluid.pressure, tether.fluid.density],
            impact: tether.impact.map_or([0.0; 2], |i| [i.factor, i.half_life]),
            group: tether.group.round() as i64,
        }
    }
}
