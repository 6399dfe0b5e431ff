//! What is kept of a run of tethers.

use super::Tethered;
use super::case::{Installed, TowedCase, TowingVessel};
use std::ops::ControlFlow;
use windlass_base::geometry::Place;
use windlass_base::table::Digits;
use windlass_base::units::Dim;
use windlass_model::ClassError;
use windlass_tether::TetherLine;
use windlass_tether::installed::{Installation, InstalledObserver, Moment, RigChange};
use windlass_tether::structure::StructureForces;
use windlass_tether::towed::{self, TowedHistory, TowedSteps};

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

const FOUR: Digits = Digits::Scientific(4);
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
    quantity("SY", "Shear Force", "Y", Dim::Force, FOUR),
    quantity("SZ", "Shear Force", "Z", Dim::Force, FOUR),
    quantity("MY", "Bending Moment", "Y", Dim::Moment, FOUR),
    quantity("MZ", "Bending Moment", "Z", Dim::Moment, FOUR),
    quantity("SMAX", "Bending Stress", "Max", STRESS, FOUR),
    quantity("STY", "Bending Stress", "Y", STRESS, FOUR),
    quantity("STZ", "Bending Stress", "Z", STRESS, FOUR),
];
/// Quantities of the ends of elements of an installed tether.
pub const INSTALLED_END: [TetherQuantity; 11] = [
    quantity("EFF", "Tension", "Effective", Dim::Force, FOUR),
    quantity("WALL", "Tension", "Wall", Dim::Force, FOUR),
    quantity("SX", "Shear Force", "X", Dim::Force, FOUR),
    quantity("SY", "Shear Force", "Y", Dim::Force, FOUR),
    quantity("MX", "Bending Moment", "X", Dim::Moment, FOUR),
    quantity("MY", "Bending Moment", "Y", Dim::Moment, FOUR),
    quantity("SHEAR", "Stress", "Shear", STRESS, FOUR),
    quantity("MAX", "Bending and Axial", "Max", STRESS, FOUR),
    quantity("MIN", "Bending and Axial", "Min", STRESS, FOUR),
    quantity("MISES", "Stress", "von Mises", STRESS, FOUR),
    quantity("STY", "Stress", "Y Bending", STRESS, FOUR),
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

    /// The series of a quantity of a node.
    pub fn node(&self, node: usize, quantity: usize) -> Vec<f64> {
        let step = self.line.nodes() * TOWED_NODE.len();
        self.nodes.iter().skip(node * TOWED_NODE.len() + quantity).step_by(step.max(1)).copied().collect()
    }

    /// The series of a quantity of an end: twice the element and the end, from 0.
    pub fn end(&self, end: usize, quantity: usize) -> Vec<f64> {
        let each = self.end_quantities().len();
        let step = 2 * self.line.elements().len() * each;
        self.ends.iter().skip(end * each + quantity).step_by(step.max(1)).copied().collect()
    }

    /// A value of a node at an instant.
    pub fn node_at(&self, instant: usize, node: usize, quantity: usize) -> Option<f64> {
        self.nodes.get((instant * self.line.nodes() + node) * TOWED_NODE.len() + quantity).copied()
    }

    /// A value of an end at an instant.
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

    /// A column as a series.
    pub fn series(&self, column: usize) -> Vec<f64> {
        self.rows.iter().skip(column).step_by(self.width().max(1)).copied().collect()
    }
}

/// What happened to a tether.
#[derive(Clone, Debug, PartialEq)]
pub struct Happening {
    /// When (s).
    pub time: f64,
    /// Its name.
    pub tether: String,
    /// What.
    pub change: RigChange,
}

/// Runs a towed tether.
///
/// # Errors
/// What the engine refuses; a run that would keep too much.
pub fn run_towed(
    case: &TowedCase,
    kept: &mut Tethered,
    should_continue: &mut dyn FnMut(f64) -> bool,
) -> Result<(), ClassError> {
    let TowedCase { name, tether, vessel } = case;
    let settings = kept.settings;
    let line = &tether.line;
    let of_vessel = if vessel.is_some() { 6 * StructureHistory::KINDS.len() } else { 0 };
    let per = line.nodes() * TOWED_NODE.len() + 2 * line.elements().len() * TOWED_END.len() + of_vessel;
    settings.room(per)?;
    let steps = TowedSteps { step: settings.step, number: settings.states(), ..TowedSteps::default() };
    let mut history = TowedHistory { every: settings.store.max(1), ..TowedHistory::default() };
    let mut rows = Vec::new();
    let mut keeper = Keeper { case, history: &mut history, rows: &mut rows, should_continue, interrupted: false };
    tether.run(&steps, &mut keeper)?;
    kept.interrupted = keeper.interrupted;
    kept.times = std::mem::take(&mut history.times);
    let (nodes, ends) = (history.nodes, history.ends);
    kept.tethers.push(TetherHistory { name: name.clone(), towed: true, line: line.clone(), nodes, ends });
    kept.structure = vessel.as_ref().map(|v| StructureHistory { body: v.body.clone(), points: Vec::new(), rows });
    Ok(())
}

struct Keeper<'a> {
    case: &'a TowedCase,
    history: &'a mut TowedHistory,
    /// Rows of the vessel.
    rows: &'a mut Vec<f64>,
    should_continue: &'a mut dyn FnMut(f64) -> bool,
    interrupted: bool,
}

impl towed::TowedObserver for Keeper<'_> {
    fn record(&mut self, record: &towed::TowedRecord<'_>) -> ControlFlow<()> {
        if !(self.should_continue)(record.time) {
            self.interrupted = true;
            return ControlFlow::Break(());
        }
        if record.index.is_multiple_of(self.history.every)
            && let (Some(vessel), Some([y, z, ..])) = (&self.case.vessel, record.positions.last())
        {
            self.rows.extend(vessel_row(vessel, &self.case.tether, [*y, *z]));
        }
        self.history.record(record)
    }
}

/// What is kept of the vessel of a towed tether whose end is displaced: it is held, and feels its weight, as much buoyancy, and the end spring.
fn vessel_row(vessel: &TowingVessel, tether: &towed::Towed, [y, z]: [f64; 2]) -> Vec<f64> {
    let (sine, cosine) = tether.heading.sin_cos();
    let spring = &tether.springs[1];
    let (across, up) = (spring.y * y, spring.z * z);
    let pull = nalgebra::Vector3::new(-sine * across, cosine * across, up);
    let turning = vessel.arm.cross(&pull);
    let mut row = vec![0.0; 6 * StructureHistory::KINDS.len()];
    let mut put = |name: &str, values: [f64; 6]| {
        let kind = StructureHistory::KINDS.iter().position(|kind| *kind == name);
        if let Some(place) = kind.and_then(|kind| row.get_mut(6 * kind..6 * kind + 6)) {
            place.copy_from_slice(&values);
        }
    };
    put("POSITION", vessel.place.values());
    put("GRAVITY", [0.0, 0.0, -vessel.weight, 0.0, 0.0, 0.0]);
    put("HYDROSTATIC", [0.0, 0.0, vessel.weight, 0.0, 0.0, 0.0]);
    put("MOORING", [pull.x, pull.y, pull.z, turning.x, turning.y, turning.z]);
    row
}

/// Runs installed tethers with their structure.
///
/// # Errors
/// What the engine refuses; a run that would keep too much.
pub fn run_installed(
    case: Installed,
    kept: &mut Tethered,
    should_continue: &mut dyn FnMut(f64) -> bool,
) -> Result<(), ClassError> {
    let Installed { body, mut structure, tethers, flow, compatibility, course, points, .. } = case;
    let of = |t: &windlass_tether::installed::InstalledTether| {
        t.line.nodes() * INSTALLED_NODE.len() + 2 * t.line.elements().len() * INSTALLED_END.len()
    };
    let per = tethers.iter().map(of).sum::<usize>() + 6 * StructureHistory::KINDS.len() + 3 * points.len();
    kept.settings.room(per)?;
    kept.tethers.extend(tethers.iter().map(|t| TetherHistory {
        name: t.name.clone(),
        towed: false,
        line: t.line.clone(),
        nodes: Vec::new(),
        ends: Vec::new(),
    }));
    let (names, places) = points.into_iter().unzip();
    kept.structure = Some(StructureHistory { body, points: names, rows: Vec::new() });
    let mut near = Place::default();
    let start = course.pose.place(&near);
    near = start;
    let mut taker = Taker { kept, should_continue, places, near, stopped: false };
    let mut installation = Installation::new(structure.as_mut(), tethers, &flow, compatibility)?;
    let ended = installation.run(&course, &mut taker);
    if taker.stopped {
        kept.interrupted = true;
        return Ok(());
    }
    ended
}

struct Taker<'a> {
    kept: &'a mut Tethered,
    should_continue: &'a mut dyn FnMut(f64) -> bool,
    places: Vec<nalgebra::Vector3<f64>>,
    near: Place,
    stopped: bool,
}

impl InstalledObserver for Taker<'_> {
    fn observe(&mut self, moment: &Moment) -> Result<(), ClassError> {
        if !(self.should_continue)(moment.time) {
            self.stopped = true;
            return Err(ClassError::new("the run was interrupted"));
        }
        let kept = &mut *self.kept;
        for event in moment.events {
            let name = kept.tethers.get(event.tether).map(|t| t.name.clone()).unwrap_or_default();
            kept.happened.push(Happening { time: event.time, tether: name, change: event.change });
        }
        self.near = moment.pose.place(&self.near);
        if !moment.state.is_multiple_of(kept.settings.store.max(1)) {
            return Ok(());
        }
        kept.times.push(moment.time);
        if let Some(structure) = &mut kept.structure {
            let rows = &mut structure.rows;
            rows.extend(self.near.values());
            rows.extend(moment.velocity.iter());
            rows.extend(moment.acceleration.iter());
            for kind in moment.forces.kinds() {
                rows.extend(kind.iter());
            }
            rows.extend(moment.error.iter());
            for place in &self.places {
                rows.extend(moment.pose.point(*place).iter());
            }
        }
        for (history, rig) in kept.tethers.iter_mut().zip(moment.tethers) {
            for node in 0..rig.nodes() {
                history.nodes.extend(rig.position(node));
                history.nodes.extend(rig.velocity(node));
                history.nodes.extend(rig.acceleration(node));
                history.nodes.push(rig.height(node));
            }
            for (loads, stresses) in rig.ends().iter().flatten().zip(rig.stresses().iter().flatten()) {
                let [shear_x, shear_y] = loads.shear;
                let [moment_x, moment_y] = loads.moment;
                history.ends.extend([
                    loads.effective,
                    loads.wall,
                    shear_x,
                    shear_y,
                    moment_x,
                    moment_y,
                    stresses.shear,
                    stresses.maximum,
                    stresses.minimum,
                    stresses.von_mises,
                    stresses.bending_y,
                ]);
            }
        }
        Ok(())
    }
}
