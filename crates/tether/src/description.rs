//! The description of a tether: what the data listing [AQWA-TETHER 7.1] reports of it before a run.

use super::TetherElement;
use super::line::{ElementLabel, TetherLine};
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;

/// Second moment of area (m4).
const QUARTIC: Dim = Dim::Derived { force: 0, length: 4, seconds: 0 };
/// Bending stiffness (N m2).
const BENDING: Dim = Dim::Derived { force: 1, length: 2, seconds: 0 };

/// How a tether is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TetherArrangement {
    /// Afloat behind a vessel.
    Towed,
    /// Between an anchor and a vessel.
    Installed,
}

/// A place where a tether ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TetherEnd {
    /// What the user calls its node.
    pub node: String,
    /// Where it was given (m).
    pub given: [f64; 3],
    /// Where it is at the start (m).
    pub initial: [f64; 3],
}

/// What is reported of a tether.
#[derive(Clone, Debug, PartialEq)]
pub struct TetherDescription<'a> {
    /// Its number, from 1.
    pub number: usize,
    /// How it is used.
    pub configuration: TetherArrangement,
    /// Its elements.
    pub line: &'a TetherLine,
    /// Its ends: anchor or trailing, vessel.
    pub ends: [TetherEnd; 2],
    /// Springs of the same ends. Installed: inline (N/m) and two rotational (N m/rad); towed: along the axis, y, z (N/m).
    pub springs: [[f64; 3]; 2],
    /// Areas of the same ends that water does not press on (m2).
    pub caps: [f64; 2],
    /// Distance of the lower stop below the anchor (m).
    pub stop: f64,
    /// Density of the water (kg/m3) and gravity (m/s2).
    pub density: f64,
    /// Gravity (m/s2).
    pub gravity: f64,
    /// Pressure of the internal fluid at sea level (N/m2), and its density (kg/m3).
    pub internal: [f64; 2],
    /// Axial stress of impact per speed (N s/m3), and the time in which it halves (s).
    pub impact: [f64; 2],
    /// Number of tethers this one stands for in the forces on the vessel; 0 where none was given.
    pub group: i64,
}

/// A node with the element below it.
struct DescriptionRow<'t> {
    /// From 0 at the anchor or the trailing end.
    node: usize,
    element: Option<&'t TetherElement>,
    /// The end of the tether that the node is.
    end: Option<usize>,
}

impl TetherDescription<'_> {
    /// Distance between its ends at the start (m).
    pub fn initial_distance(&self) -> f64 {
        let [one, other] = [self.ends[0].initial, self.ends[1].initial];
        one.iter().zip(&other).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    }

    /// Stiffness along the axis (N/m): tube and the spring of the anchor or trailing end, one after the other. The listing leaves
    /// open which end it takes (its examples have like springs), but it takes one.
    pub fn longitudinal_stiffness(&self) -> f64 {
        let spring = self.springs[0][0];
        if spring > 0.0 { 1.0 / (1.0 / spring + self.line.axial_flexibility()) } else { 0.0 }
    }

    /// Weight in air (N).
    pub fn weight(&self) -> f64 {
        self.line.weight(self.gravity)
    }

    /// Buoyancy wholly under water without end caps (N), negative up, as the listing signs it.
    pub fn buoyancy(&self) -> f64 {
        -self.line.buoyancy(self.density, self.gravity)
    }

    /// What the end caps take from the buoyancy of an upright tether (N), positive down: pressure that is missing under the
    /// lower end less that missing above the upper one.
    pub fn end_cap_buoyancy(&self) -> f64 {
        let pressure = |end: usize| self.density * self.gravity * (-self.ends[end].initial[2]).max(0.0);
        pressure(0) * self.caps[0] - pressure(1) * self.caps[1]
    }

    /// Reaction of the wholly submerged tether hanging free (N), positive down: the sum of the three.
    pub fn free_hanging_reaction(&self) -> f64 {
        self.weight() + self.buoyancy() + self.end_cap_buoyancy()
    }

    /// The table of 7.1: nodes from the vessel down with the element below each, and the facts under it in the listing.
    pub fn table(&self) -> Table {
        let towed = self.configuration == TetherArrangement::Towed;
        let second = if towed { Dim::ForcePerLength } else { Dim::MomentPerRadian };
        let names = if towed { ["Along", "Y", "Z"] } else { ["Inline", "X Rot", "Y Rot"] };
        let last = self.line.nodes() - 1;
        let nodes: Vec<DescriptionRow> = (0..=last)
            .rev()
            .map(|node| DescriptionRow {
                node,
                element: self.line.elements().get(node),
                end: if node == 0 { Some(0) } else { (node == last).then_some(1) },
            })
            .collect();
        let label = |row: &DescriptionRow, value: fn(&ElementLabel) -> i64| row.element.map(|e| value(&e.label));
        self.facts(Table::new(format!("Description of Tether {}", self.number)))
            .with_rows(&nodes)
            .column("", "Tether Node", Dim::None, Digits::Usual, |row| row.node + 1)
            .column("", "Distance", Dim::Length, Digits::Decimals(1), |row| self.line.distances()[row.node])
            .column("Element", "Node 1", Dim::None, Digits::Usual, |row| label(row, |l| l.nodes[0]))
            .column("Element", "Node 2", Dim::None, Digits::Usual, |row| label(row, |l| l.nodes[1]))
            .column("Element", "Material", Dim::None, Digits::Usual, |row| label(row, |l| l.material))
            .column("Element", "Geometry", Dim::None, Digits::Usual, |row| label(row, |l| l.geometry))
            .column("Section", "Area", Dim::Area, Digits::Decimals(4), |row| row.element.map(|e| e.tube().area()))
            .column("Section", "2nd Moment", QUARTIC, Digits::Decimals(6), |row| {
                row.element.map(|e| e.tube().second_moment())
            })
            .column("Section", "EI", BENDING, Digits::Scientific(4), |row| row.element.map(|e| e.bending_stiffness()))
            .column("Section", "EA", Dim::Force, Digits::Scientific(4), |row| row.element.map(|e| e.axial_stiffness()))
            .column("Outside Area", "Cap", Dim::Area, Digits::Decimals(3), |row| row.end.map(|e| self.caps[e]))
            .column("Outside Area", "Diameter", Dim::Area, Digits::Decimals(3), |row| {
                row.element.map(|e| e.tube().external_area())
            })
            .column("Spring", names[0], Dim::ForcePerLength, Digits::Scientific(3), |row| {
                row.end.map(|e| self.springs[e][0])
            })
            .columns("Spring", [names[1], names[2]], second, Digits::Scientific(3), |row| {
                row.end.map_or([None; 2], |e| [Some(self.springs[e][1]), Some(self.springs[e][2])])
            })
            .build()
    }

    /// The facts under the table of the listing, in its order.
    fn facts(&self, out: Table) -> Table {
        let word = if self.configuration == TetherArrangement::Towed { "TOWED" } else { "INSTALLED" };
        let mut out = out.fact("Configuration", word, Dim::None);
        for (name, end) in [("Vessel Attachment", &self.ends[1]), ("Anchor Attachment", &self.ends[0])] {
            out = out.fact(&format!("{name} Node"), end.node.as_str(), Dim::None);
            for (axis, value) in ["X", "Y", "Z"].iter().zip(end.given) {
                out = out.fact(&format!("{name} Given {axis}"), value, Dim::Length);
            }
            for (axis, value) in ["X", "Y", "Z"].iter().zip(end.initial) {
                out = out.fact(&format!("{name} Initial {axis}"), value, Dim::Length);
            }
        }
        out = match self.stop.is_finite() {
            true => out.fact("Stop Below Anchor", self.stop, Dim::Length),
            false => out.fact("Stop Below Anchor", "none", Dim::None),
        };
        out.fact("Unstretched Length", self.line.length(), Dim::Length)
            .fact("Initial Distance", self.initial_distance(), Dim::Length)
            .fact("Longitudinal Stiffness", self.longitudinal_stiffness(), Dim::ForcePerLength)
            .fact("Weight", self.weight(), Dim::Force)
            .fact("Buoyancy", self.buoyancy(), Dim::Force)
            .fact("End Cap Buoyancy", self.end_cap_buoyancy(), Dim::Force)
            .fact("Free Hanging Reaction", self.free_hanging_reaction(), Dim::Force)
            .fact("Internal Pressure", self.internal[0], Dim::Derived { force: 1, length: -2, seconds: 0 })
            .fact("Internal Density", self.internal[1], Dim::Density)
            .fact("Impact Stress Factor", self.impact[0], Dim::Derived { force: 1, length: -3, seconds: 1 })
            .fact("Impact Half Life", self.impact[1], Dim::Time)
            .fact("Group Factor", Cell::Integer(self.group), Dim::None)
    }
}
