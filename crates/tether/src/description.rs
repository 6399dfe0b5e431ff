//! The description of a tether: what the data listing [AQWA-TETHER 7.1] reports of it before a run.

use super::TetherElement;
use super::line::{ElementLabel, TetherLine};
use windlass_base::fortran::without_noise;
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

    /// The table of 7.1: nodes from the vessel down with the element below each, and the facts under it in the listing. A towed tether has its lateral
    /// springs in two columns more.
    pub fn table(&self) -> Table {
        let towed = self.configuration == TetherArrangement::Towed;
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
        const ELEMENT: &str = "ELEMENT DESCRIPTION";
        const AREA: &str = "EXT AREA";
        const SPRINGS: &str = "SPRINGS/CONSTRAINTS";
        let coil = |row: &DescriptionRow, axis: usize| row.end.map(|e| if towed { 0.0 } else { self.springs[e][axis] });
        let mut table = self
            .facts(Table::new(format!("Description of Tension Leg Tether {}", self.number)))
            .with_rows(&nodes)
            .column("TETHER", "NODE", Dim::None, Digits::Usual, |row| row.node + 1)
            .column("", "ELEVATION", Dim::Length, Digits::Decimals(1), |row| self.line.distances()[row.node])
            .column(ELEMENT, "NODE 1", Dim::None, Digits::Usual, |row| label(row, |l| l.nodes[0]))
            .column(ELEMENT, "NODE 2", Dim::None, Digits::Usual, |row| label(row, |l| l.nodes[1]))
            .column(ELEMENT, "MATE GROUP", Dim::None, Digits::Usual, |row| label(row, |l| l.material))
            .column(ELEMENT, "GEOM GROUP", Dim::None, Digits::Usual, |row| label(row, |l| l.geometry))
            .column(ELEMENT, "X-SECT AREA", Dim::Area, Digits::Decimals(4), |row| row.element.map(|e| e.tube().area()))
            .column(ELEMENT, "2ND-MOM OF AREA", QUARTIC, Digits::Decimals(6), |row| {
                row.element.map(|e| e.tube().second_moment())
            })
            .column(ELEMENT, "EI", BENDING, Digits::Scientific(4), |row| row.element.map(|e| e.bending_stiffness()))
            .column(ELEMENT, "EA", Dim::Force, Digits::Scientific(4), |row| row.element.map(|e| e.axial_stiffness()))
            .column(AREA, "CAP AREA", Dim::Area, Digits::Decimals(3), |row| row.end.map(|e| self.caps[e]))
            .column(AREA, "EXTERNAL DIAM AREA", Dim::Area, Digits::Decimals(3), |row| {
                row.element.map(|e| e.tube().external_area())
            })
            .column(SPRINGS, "INLINE/VERTICAL", Dim::ForcePerLength, Digits::Scientific(3), |row| {
                row.end.map(|e| self.springs[e][0])
            })
            .column(SPRINGS, "X ROT COIL", Dim::MomentPerRadian, Digits::Scientific(3), |row| coil(row, 1))
            .column(SPRINGS, "Y ROT COIL", Dim::MomentPerRadian, Digits::Scientific(3), |row| coil(row, 2));
        if towed {
            for (axis, name) in [(1, "LATERAL Y"), (2, "LATERAL Z")] {
                table = table.column(SPRINGS, name, Dim::ForcePerLength, Digits::Scientific(3), |row| {
                    row.end.map(|e| self.springs[e][axis])
                });
            }
        }
        table.build()
    }

    /// The facts under the table of the listing, in its order and with its digits.
    fn facts(&self, out: Table) -> Table {
        const MILLIMETRES: Digits = Digits::Decimals(3);
        const FOUR: Digits = Digits::Scientific(4);
        let word = if self.configuration == TetherArrangement::Towed { "TOWED" } else { "INSTALLED" };
        let mut out = out.fact("TETHER CONFIGURATION", word, Dim::None);
        let axes = ["X", "Y", "Z"];
        let [anchor, vessel] = &self.ends;
        out = out.fact("VESSEL ATTACHMENT - NODE", vessel.node.as_str(), Dim::None);
        for (what, position) in [("POSITION IN FRA", vessel.given), ("INITIAL POSITION", vessel.initial)] {
            for (axis, value) in axes.into_iter().zip(position) {
                // what is rounding of the length is no place
                let value = without_noise(value, self.line.length());
                out = out.fact_with_digits(&format!("- {what} {axis}"), value, Dim::Length, MILLIMETRES);
            }
        }
        out = out.fact("ANCHOR ATTACHMENT - AT NODE", anchor.node.as_str(), Dim::None);
        for (axis, value) in axes.into_iter().zip(anchor.given) {
            out = out.fact_with_digits(&format!("- POSITION IN FRA {axis}"), value, Dim::Length, MILLIMETRES);
        }
        out = match self.stop.is_finite() {
            true => out.fact_with_digits("- STOP DIST BELOW ANCHOR", self.stop, Dim::Length, MILLIMETRES),
            false => out.fact("- STOP DIST BELOW ANCHOR", "none", Dim::None),
        };
        let pressure = Dim::Derived { force: 1, length: -2, seconds: 0 };
        let impact = Dim::Derived { force: 1, length: -3, seconds: 1 };
        let list = [
            ("UNSTRETCHED LENGTH OF TETHER", self.line.length(), Dim::Length, MILLIMETRES),
            ("INITIAL DISTANCE BETWEEN ANCHOR/ATTACHMENT", self.initial_distance(), Dim::Length, MILLIMETRES),
            ("LONGITUDINAL STIFFNESS OF COMPLETE TETHER", self.longitudinal_stiffness(), Dim::ForcePerLength, FOUR),
            ("WEIGHT OF TETHER", self.weight(), Dim::Force, FOUR),
            ("BUOYANCY OF TETHER (EXCLUDING END CAP EFFECTS)", self.buoyancy(), Dim::Force, FOUR),
            ("END CAP BUOYANCY (TETHER ASSUMED VERTICAL)", self.end_cap_buoyancy(), Dim::Force, FOUR),
            ("FREE HANGING REACTION (SUM OF ABOVE)", self.free_hanging_reaction(), Dim::Force, FOUR),
            ("INTERNAL FLUID - PRESSURE AT SEA LEVEL", self.internal[0], pressure, FOUR),
            ("INTERNAL FLUID - DENSITY", self.internal[1], Dim::Density, MILLIMETRES),
            ("IMPACT COEFFICIENTS - AXIAL STRESS FACTOR", self.impact[0], impact, FOUR),
            ("IMPACT COEFFICIENTS - HALF LIFE", self.impact[1], Dim::Time, MILLIMETRES),
        ];
        for (name, value, dim, digits) in list {
            out = out.fact_with_digits(name, value, dim, digits);
        }
        out.fact("TETHER GROUP FACTOR (FACTOR FOR VESSEL FORCES)", Cell::Integer(self.group), Dim::None)
    }
}
