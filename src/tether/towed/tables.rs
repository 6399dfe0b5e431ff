//! Records of a towed tether as tables, in the columns and the order of the listing (seed 003, 7.3 and 7.4): nodes from the
//! vessel to the trailing end. Tensions are left out: they are zero by the theory.

use super::super::description::{Attachment, Configuration, Description};
use super::{Record, Towed};
use crate::language::units::Dim;
use crate::table::{Cell, Digits, Table};

/// Positions, velocities and accelerations of the nodes.
pub fn motions(record: &Record<'_>, tether: usize) -> Table {
    let mut out = Table::new(format!("Motions of Tether {tether}"))
        .fact("Step", record.index + 1, Dim::None)
        .fact("Time", record.time, Dim::Time)
        .column("", "Node", Dim::None, Digits::Usual)
        .column("", "Distance", Dim::Length, Digits::Decimals(1));
    let groups = [
        ("Position", [Dim::Length, Dim::Angle], [3, 2]),
        ("Velocity", [Dim::Velocity, Dim::AngularVelocity], [3, 2]),
        ("Acceleration", [Dim::Acceleration, Dim::AngularAcceleration], [3, 3]),
    ];
    for (group, [linear, angular], [digits, turns]) in groups {
        let short = &group[..3];
        for (name, dim, digits) in
            [("Y", linear, digits), ("Z", linear, digits), ("RY", angular, turns), ("RZ", angular, turns)]
        {
            out = out.column(group, &format!("{short} {name}"), dim, Digits::Decimals(digits));
        }
    }
    for (node, along) in record.along.iter().enumerate().rev() {
        let mut row: Vec<Cell> = vec![(node + 1).into(), (*along).into()];
        for list in [record.positions, record.velocities, record.accelerations] {
            row.extend(list[node].map(Cell::from));
        }
        // the row has one cell a column
        let _ = out.push(row);
    }
    out
}

/// Shear forces, bending moments and bending stresses at both ends of each element, the vessel's end of each first.
pub fn forces(record: &Record<'_>, tether: usize) -> Table {
    let mut out = Table::new(format!("Forces and Stresses of Tether {tether}"))
        .fact("Step", record.index + 1, Dim::None)
        .fact("Time", record.time, Dim::Time)
        .column("", "Element", Dim::None, Digits::Usual)
        .column("", "Node", Dim::None, Digits::Usual)
        .column("", "Distance", Dim::Length, Digits::Decimals(1))
        .column("Shear Force", "SY", Dim::Force, Digits::Scientific(4))
        .column("Shear Force", "SZ", Dim::Force, Digits::Scientific(4))
        .column("Bending Moment", "MY", Dim::Moment, Digits::Scientific(4))
        .column("Bending Moment", "MZ", Dim::Moment, Digits::Scientific(4))
        .column("Bending Stress", "Max", Dim::Stress, Digits::Scientific(3))
        .column("Bending Stress", "Y", Dim::Stress, Digits::Scientific(3))
        .column("Bending Stress", "Z", Dim::Stress, Digits::Scientific(3));
    for (index, end) in record.ends.iter().enumerate().rev() {
        let (element, node) = (index / 2, index.div_ceil(2));
        let mut row: Vec<Cell> = vec![(element + 1).into(), (node + 1).into(), record.along.get(node).copied().into()];
        row.extend(end.shear.iter().chain(&end.moment).chain(&end.stress).map(|v| Cell::from(*v)));
        // the row has one cell a column
        let _ = out.push(row);
    }
    out
}

impl Towed {
    /// Its description (7.1). Numbers of the nodes the user gave for the trailing end and the vessel's; impact and lower stop do
    /// not belong to a towed tether.
    pub fn description(&self, tether: usize, nodes: [&str; 2]) -> Description<'_> {
        let [x, y, z] = self.origin;
        let length = self.line.length();
        let far = [x + length * self.heading.cos(), y + length * self.heading.sin(), z];
        let end = |node: &str, place| Attachment { node: node.into(), given: place, initial: place };
        Description {
            number: tether,
            configuration: Configuration::Towed,
            line: &self.line,
            ends: [end(nodes[0], self.origin), end(nodes[1], far)],
            springs: self.springs.map(|s| [s.along, s.y, s.z]),
            caps: [0.0; 2],
            stop: 0.0,
            density: self.density,
            gravity: self.gravity,
            internal: [0.0; 2],
            impact: [0.0; 2],
            group: 0,
        }
    }
}
