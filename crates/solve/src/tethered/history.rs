//! What is kept of a run of tethers.

use super::case::TowingVessel;
use windlass_base::table::Digits;
use windlass_base::units::Dim;
use windlass_tether::TetherLine;
use windlass_tether::installed::RigChange;
use windlass_tether::structure::StructureForces;
use windlass_tether::towed;

/// A quantity of nodes or of ends of elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TetherQuantity {
    /// What a record calls it.
    pub code: &'static str,
    /// Head shared with others of its kind.
    pub group: &'static str,
    /// Its own head.
    pub name: &'static str,
    /// What it measures.
    pub dim: Dim,
    /// Digits in reports.
    pub digits: Digits,
}

const fn quantity(
    code: &'static str,
    group: &'static str,
    name: &'static str,
    dim: Dim,
    digits: Digits,
) -> TetherQuantity {
    TetherQuantity { code, group, name, dim, digits }
}

const FOUR_DECIMALS: Digits = Digits::Scientific(4);
const STRESS: Dim = windlass_signal::tether::tables::STRESS;
const GROUPS: [&str; 3] = ["POSITION", "VELOCITY", "ACCELERATION"];
const LINEAR: [(Dim, Digits); 3] = [
    (Dim::Length, Digits::Decimals(3)),
    (Dim::Velocity, Digits::Decimals(3)),
    (Dim::Acceleration, Digits::Decimals(3)),
];
const ANGULAR: [(Dim, Digits); 3] = [
    (Dim::Angle, Digits::Decimals(2)),
    (Dim::AngularVelocity, Digits::Decimals(2)),
    (Dim::AngularAcceleration, Digits::Decimals(3)),
];

const fn of_nodes(codes: [[&'static str; 4]; 3]) -> [TetherQuantity; 13] {
    let names = codes[0];
    let mut out = [quantity("ALONG", "", "Along", Dim::Length, Digits::Decimals(2)); 13];
    let mut kind = 0;
    while kind < 3 {
        let mut i = 0;
        while i < 4 {
            let (dim, digits) = if i < 2 { LINEAR[kind] } else { ANGULAR[kind] };
            out[4 * kind + i] = quantity(codes[kind][i], GROUPS[kind], names[i], dim, digits);
            i += 1;
        }
        kind += 1;
    }
    out
}

/// Quantities of the nodes of a towed tether.
pub const TOWED_NODE: [TetherQuantity; 13] =
    of_nodes([["Y", "Z", "RY", "RZ"], ["VY", "VZ", "VRY", "VRZ"], ["AY", "AZ", "ARY", "ARZ"]]);
/// Quantities of the nodes of an installed tether.
pub const INSTALLED_NODE: [TetherQuantity; 13] =
    of_nodes([["X", "Y", "RX", "RY"], ["VX", "VY", "VRX", "VRY"], ["AX", "AY", "ARX", "ARY"]]);
/// Quantities of the ends of elements of a towed tether.
pub const TOWED_END: [TetherQuantity; 7] = [
    quantity("SY", "Shear Force", "Y", Dim::Force, FOUR_DECIMALS),
    quantity("SZ", "Shear Force", "Z", Dim::Force, FOUR_DECIMALS),
    quantity("MY", "Bending Moment", "Y", Dim::Moment, FOUR_DECIMALS),
    quantity("MZ", "Bending Moment", "Z", Dim::Moment, FOUR_DECIMALS),
    quantity("SMAX", "Bending Stress", "Max", STRESS, FOUR_DECIMALS),
    quantity("STY", "Bending Stress", "Y", STRESS, FOUR_DECIMALS),
    quantity("STZ", "Bending Stress", "Z", STRESS, FOUR_DECIMALS),
];
/// Quantities of the ends of elements of an installed tether.
pub const INSTALLED_END: [TetherQuantity; 11] = [
    quantity("EFF", "Tension", "Effective", Dim::Force, FOUR_DECIMALS),
    quantity("WALL", "Tension", "Wall", Dim::Force, FOUR_DECIMALS),
    quantity("SX", "Shear Force", "X", Dim::Force, FOUR_DECIMALS),
    quantity("SY", "Shear Force", "Y", Dim::Force, FOUR_DECIMALS),
    quantity("MX", "Bending Moment", "X", Dim::Moment, FOUR_DECIMALS),
    quantity("MY", "Bending Moment", "Y", Dim::Moment, FOUR_DECIMALS),
    quantity("SHEAR", "Stress", "Shear", STRESS, FOUR_DECIMALS),
    quantity("MAX", "Bending and Axial", "Max", STRESS, FOUR_DECIMALS),
    quantity("MIN", "Bending and Axial", "Min", STRESS, FOUR_DECIMALS),
    quantity("MISES", "Stress", "von Mises", STRESS, FOUR_DECIMALS),
    quantity("STY", "Stress", "Y Bending", STRESS, FOUR_DECIMALS),
];

/// A tether in time.
#[derive(Clone, Debug)]
pub struct TetherHistory {
    /// Its name.
    pub name: String,
    /// Whether it is towed.
    pub towed: bool,
    /// Its elements from the anchor or the trailing end.
    pub line: TetherLine,
    /// `nodes[(instant * number of nodes + node) * 13 + quantity]`, nodes from the anchor or the trailing end.
    pub nodes: Vec<f64>,
    /// `ends[(instant * 2 * number of elements + 2 * element + end) * quantities + quantity]`, the lower or trailing end of an element first.
    pub ends: Vec<f64>,
}

impl TetherHistory {
    /// Quantities of its nodes.
    pub fn node_quantities(&self) -> &'static [TetherQuantity] {
        if self.towed { &TOWED_NODE } else { &INSTALLED_NODE }
    }

    /// Quantities of the ends of its elements.
    pub fn end_quantities(&self) -> &'static [TetherQuantity] {
        if self.towed { &TOWED_END } else { &INSTALLED_END }
    }

    /// The series of a quantity of a node (SI).
    pub fn node(&self, node: usize, quantity: usize) -> Vec<f64> {
        let step = self.line.nodes() * TOWED_NODE.len();
        self.nodes.iter().skip(node * TOWED_NODE.len() + quantity).step_by(step.max(1)).copied().collect()
    }

    /// The series of a quantity of an end (SI): twice the element and the end, from 0.
    pub fn end(&self, end: usize, quantity: usize) -> Vec<f64> {
        let each = self.end_quantities().len();
        let step = 2 * self.line.elements().len() * each;
        self.ends.iter().skip(end * each + quantity).step_by(step.max(1)).copied().collect()
    }

    /// A value of a node at an instant (SI).
    pub fn node_at(&self, instant: usize, node: usize, quantity: usize) -> Option<f64> {
        self.nodes.get((instant * self.line.nodes() + node) * TOWED_NODE.len() + quantity).copied()
    }

    /// A value of an end at an instant (SI).
    pub fn end_at(&self, instant: usize, end: usize, quantity: usize) -> Option<f64> {
        let each = self.end_quantities().len();
        self.ends.get((instant * 2 * self.line.elements().len() + end) * each + quantity).copied()
    }
}

/// The structure in time, about its centre of gravity.
#[derive(Clone, Debug)]
pub struct StructureHistory {
    /// Name of the body.
    pub body: String,
    /// Names of its points.
    pub points: Vec<String>,
    /// `rows[instant * width + column]`: [`StructureHistory::KINDS`] by six, then x, y, z of each point.
    pub rows: Vec<f64>,
}

impl StructureHistory {
    /// What there is six of an instant.
    pub const KINDS: [&'static str; 13] = [
        "POSITION",
        "VELOCITY",
        "ACCELERATION",
        StructureForces::KINDS[0],
        StructureForces::KINDS[1],
        StructureForces::KINDS[2],
        StructureForces::KINDS[3],
        StructureForces::KINDS[4],
        StructureForces::KINDS[5],
        StructureForces::KINDS[6],
        StructureForces::KINDS[7],
        StructureForces::KINDS[8],
        "ERROR PER TIMESTEP",
    ];

    /// Values of an instant.
    pub fn width(&self) -> usize {
        6 * Self::KINDS.len() + 3 * self.points.len()
    }

    /// The six of a kind, or the three of a point behind them, at an instant.
    pub fn value(&self, instant: usize, column: usize) -> Option<f64> {
        self.rows.get(instant * self.width() + column).copied()
    }

    /// A column as a series (SI).
    pub fn series(&self, column: usize) -> Vec<f64> {
        self.rows.iter().skip(column).step_by(self.width().max(1)).copied().collect()
    }
}

/// What happened to a tether.
#[derive(Clone, Debug, PartialEq)]
pub struct TetherRunEvent {
    /// When (s).
    pub time: f64,
    /// Its name.
    pub tether: String,
    /// What.
    pub change: RigChange,
}

/// What is kept of the vessel of a towed tether whose end is displaced: it is held, and feels its weight, as much buoyancy, and the end spring.
pub(super) fn vessel_row(vessel: &TowingVessel, tether: &towed::Towed, [y, z]: [f64; 2]) -> Vec<f64> {
    let (sine, cosine) = tether.heading.sin_cos();
    let spring = &tether.springs[1];
    let (across, up) = (spring.y * y, spring.z * z);
    let pull = nalgebra::Vector3::new(-sine * across, cosine * across, up);
    let turning = vessel.arm.cross(&pull);
    let mut row = vec![0.0; 6 * StructureHistory::KINDS.len()];
    let mut put = |name: &str, values: [f64; 6]| {
        let kind = StructureHistory::KINDS.iter().position(|kind| *kind == name);
        if let Some(position) = kind.and_then(|kind| row.get_mut(6 * kind..6 * kind + 6)) {
            position.copy_from_slice(&values);
        }
    };
    put("POSITION", vessel.position.values());
    put("GRAVITY", [0.0, 0.0, -vessel.weight, 0.0, 0.0, 0.0]);
    put("HYDROSTATIC", [0.0, 0.0, vessel.weight, 0.0, 0.0, 0.0]);
    put("MOORING", [pull.x, pull.y, pull.z, turning.x, turning.y, turning.z]);
    row
}
