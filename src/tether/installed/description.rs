//! The description of an installed tether (seed 003, 7.1 and 8.2): what it is made of and how it hangs at the start.

use super::axis::Axis;
use super::tension::Axial;
use super::tether::InstalledTether;
use crate::language::units::Dim;
use crate::model::ClassError;
use crate::table::{Cell, Digits, Table, TableError};
use crate::tether::structure::flow::Flow;
use nalgebra::Vector3;

/// The numbers of the description beside those of the elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Description {
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

impl Description {
    /// That of a tether with its attachment at a place (m, global).
    ///
    /// # Errors
    /// A tether that cannot be reckoned with, or is too short for its span.
    pub fn of(tether: &InstalledTether, attachment: Vector3<f64>, flow: &Flow) -> Result<Self, ClassError> {
        tether.check()?;
        let distance = (attachment - tether.anchor).norm();
        tether.spans(distance)?;
        let Some(axis) = Axis::of(tether.anchor, attachment) else {
            return Err(ClassError::new(format!("tether {} hangs straight below its anchor", tether.name)));
        };
        let (density, gravity) = (flow.density, flow.gravity);
        let axial = Axial::of(tether, [density, gravity], false);
        let water = flow.at(0.0);
        let tension = axial.tension(&axis, attachment.z, 0.0, &water);
        let line = &tether.line;
        let inside = |e: &crate::tether::TetherElement| tether.fluid.density * e.tube().internal_area() * e.length;
        let weight = line.weight(gravity) + gravity * line.elements().iter().map(inside).sum::<f64>();
        let buoyancy = -line.buoyancy(density, gravity);
        let top = tether.anchor.z + line.length();
        let caps = tether.caps[0] * water.hydrostatic(tether.anchor.z) - tether.caps[1] * water.hydrostatic(top);
        Ok(Description {
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

    /// As a table: nodes from the structure down, each with the element below it, in the columns of seed 003.
    ///
    /// # Errors
    /// None that can happen: the rows are made to fit.
    pub fn table(&self, tether: &InstalledTether) -> Result<Table, TableError> {
        let (scientific, decimals) = (Digits::Scientific(4), Digits::Decimals);
        let newton = Dim::Force;
        let mut table = Table::new(format!("Description of Tension Leg Tether {}", tether.name))
            .fact("Tether Configuration", "INSTALLED", Dim::None)
            .fact("Unstretched Length", self.unstretched, Dim::Length)
            .fact("Initial Distance Anchor to Attachment", self.distance, Dim::Length)
            .fact("Longitudinal Stiffness", self.stiffness, Dim::ForcePerLength)
            .fact("Weight", self.weight, newton)
            .fact("Buoyancy without End Caps", self.buoyancy, newton)
            .fact("End Cap Buoyancy", self.caps, newton)
            .fact("Free Hanging Reaction", self.hanging, newton)
            .fact("Internal Pressure at Sea Level", tether.fluid.pressure, Dim::Stress)
            .fact("Internal Density", tether.fluid.density, Dim::Density)
            .fact("Axial Stress Factor", tether.impact.map(|i| i.factor), Dim::None)
            .fact("Half Life", tether.impact.map(|i| i.half_life), Dim::Time)
            .fact("Lower Stop below Anchor", tether.lower_stop, Dim::Length)
            .fact("Group Factor", tether.group, Dim::None)
            .column("", "Node", Dim::None, decimals(0))
            .column("", "Elevation", Dim::Length, decimals(1))
            .column("Element", "Node 1", Dim::None, decimals(0))
            .column("Element", "Node 2", Dim::None, decimals(0))
            .column("Element", "Material", Dim::None, decimals(0))
            .column("Element", "Geometry", Dim::None, decimals(0))
            .column("", "Area", Dim::Area, decimals(4))
            .column("", "2nd Moment", Dim::Derived { force: 0, length: 4, seconds: 0 }, decimals(6))
            .column("", "EI", Dim::Derived { force: 1, length: 2, seconds: 0 }, scientific)
            .column("", "EA", Dim::Force, scientific)
            .column("", "Cap Area", Dim::Area, decimals(3))
            .column("", "Ext Area", Dim::Area, decimals(3))
            .column("Spring", "Inline", Dim::ForcePerLength, scientific)
            .column("Spring", "X Rot", Dim::MomentPerRadian, scientific)
            .column("Spring", "Y Rot", Dim::MomentPerRadian, scientific);
        let line = &tether.line;
        for (node, distance) in line.distances().iter().enumerate().rev() {
            let element = node.checked_sub(1).and_then(|i| line.elements().get(i));
            let ends = [(0, &tether.anchor_springs), (line.nodes() - 1, &tether.vessel_springs)];
            let spring = ends.iter().find(|(at, _)| *at == node).map(|(_, s)| *s);
            let cap = [(0, tether.caps[0]), (line.nodes() - 1, tether.caps[1])];
            let cap = cap.iter().find(|(at, _)| *at == node).map(|(_, area)| *area);
            let label = |i: i64| Cell::Integer(i);
            let of = |value: fn(&crate::tether::TetherElement) -> f64| Cell::from(element.map(value));
            table.push(vec![
                Cell::from(node + 1),
                Cell::from(*distance),
                element.map_or(Cell::Missing, |e| label(e.label.nodes[0])),
                element.map_or(Cell::Missing, |e| label(e.label.nodes[1])),
                element.map_or(Cell::Missing, |e| label(e.label.material)),
                element.map_or(Cell::Missing, |e| label(e.label.geometry)),
                of(|e| e.tube().area()),
                of(|e| e.tube().second_moment()),
                of(|e| e.bending_stiffness()),
                of(|e| e.axial_stiffness()),
                Cell::from(cap),
                of(|e| e.tube().external_area()),
                Cell::from(spring.map(|s| s.inline)),
                Cell::from(spring.map(|s| s.rotation[0])),
                Cell::from(spring.map(|s| s.rotation[1])),
            ])?;
        }
        Ok(table)
    }
}
