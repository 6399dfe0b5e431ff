//! What is kept of a run, as tables: structure, tethers, events.

use super::rig::Change;
use super::rig::Rig;
use super::run::{Event, Moment, Observer};
use super::tension::Standing;
use crate::language::units::Dim;
use crate::model::{ClassError, Place, Six};
use crate::table::{Cell, Digits, Table, TableError};
use crate::tether::structure::Forces;

/// Numbers kept at most: 400 MB.
const MOST_NUMBERS: usize = 50_000_000;
/// Numbers of the structure in a state: motions, kinds of force, error.
const STRUCTURE: usize = 1 + 18 + 6 * Forces::KINDS.len() + 6;
/// Numbers of a node, and of an end of an element.
const NODE: usize = 13;
const END: usize = 12;

/// Motions of a node across its axis, in the order they are kept.
pub const MOTIONS: [(&str, &str, Dim); 12] = [
    ("Position", "X", Dim::Length),
    ("Position", "Y", Dim::Length),
    ("Position", "RX", Dim::Angle),
    ("Position", "RY", Dim::Angle),
    ("Velocity", "X", Dim::Velocity),
    ("Velocity", "Y", Dim::Velocity),
    ("Velocity", "RX", Dim::AngularVelocity),
    ("Velocity", "RY", Dim::AngularVelocity),
    ("Acceleration", "X", Dim::Acceleration),
    ("Acceleration", "Y", Dim::Acceleration),
    ("Acceleration", "RX", Dim::AngularAcceleration),
    ("Acceleration", "RY", Dim::AngularAcceleration),
];

/// What an end of an element bears, in the order it is kept (seed 003, 7.11).
pub const LOADS: [(&str, &str, Dim); END] = [
    ("Tension", "Effective", Dim::Force),
    ("Tension", "Wall", Dim::Force),
    ("Shear Force", "X", Dim::Force),
    ("Shear Force", "Y", Dim::Force),
    ("Bending Moment", "X", Dim::Moment),
    ("Bending Moment", "Y", Dim::Moment),
    ("Stress", "Shear", Dim::Stress),
    ("Stress", "Maximum", Dim::Stress),
    ("Stress", "Minimum", Dim::Stress),
    ("Stress", "von Mises", Dim::Stress),
    ("Stress", "Y Bending", Dim::Stress),
    ("Stress", "Axial", Dim::Stress),
];

/// Which of [`LOADS`] the statistics of figures 7.12 and 7.13 are of, in their order.
pub const STATISTICS: [usize; 7] = [0, 1, 6, 7, 8, 9, 10];

/// When tethers are kept. The structure is kept at every state of [`History::every`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Keep {
    /// At the same states as the structure.
    Always,
    /// From a tether's going slack on, for a time (s), at every state (TSLK of seed 003, A.6).
    WhenSlack(f64),
}

/// A tether's states.
#[derive(Clone, Debug, Default)]
struct Kept {
    name: String,
    times: Vec<f64>,
    standings: Vec<Standing>,
    /// Node by node, then end by end, of each state.
    numbers: Vec<f64>,
    nodes: usize,
    /// Until when it is kept after it went slack (s).
    until: Option<f64>,
}

/// What is kept of a run.
#[derive(Clone, Debug)]
pub struct History {
    /// Every how many states the run is kept.
    pub every: usize,
    keep: Keep,
    structure: Vec<[f64; STRUCTURE]>,
    tethers: Vec<Kept>,
    events: Vec<Event>,
    numbers: usize,
}

impl History {
    /// A history of every state, or of one in a number of them.
    pub fn new(every: usize, keep: Keep) -> Self {
        let every = every.max(1);
        History { every, keep, structure: Vec::new(), tethers: Vec::new(), events: Vec::new(), numbers: 0 }
    }

    /// The events, in order.
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Times of the structure (s).
    pub fn times(&self) -> Vec<f64> {
        self.structure.iter().map(|row| row[0]).collect()
    }

    /// A series of the structure: position, velocity, acceleration (0 to 2) in a direction (0 to 5); angles are roll, pitch, yaw.
    pub fn motion(&self, order: usize, direction: usize) -> Vec<f64> {
        self.structure.iter().filter_map(|row| row.get(1 + 6 * order + direction).copied()).collect()
    }

    /// A series of a kind of force on the structure, by the order of [`Forces::KINDS`].
    pub fn force(&self, kind: usize, direction: usize) -> Vec<f64> {
        self.structure.iter().filter_map(|row| row.get(19 + 6 * kind + direction).copied()).collect()
    }

    /// Times at which a tether is kept (s).
    pub fn tether_times(&self, tether: usize) -> &[f64] {
        self.tethers.get(tether).map_or(&[], |t| &t.times)
    }

    /// A series of a node of a tether, by the order of [`MOTIONS`]. Nodes count from 0 at the anchor.
    pub fn node(&self, tether: usize, node: usize, motion: usize) -> Vec<f64> {
        let Some(kept) = self.tethers.get(tether) else { return Vec::new() };
        kept.states().filter_map(|s| s.get(NODE * node + 1 + motion).copied()).collect()
    }

    /// A series of an end of an element of a tether, by the order of [`LOADS`]; `upper` is its upper end.
    pub fn end(&self, tether: usize, element: usize, upper: bool, load: usize) -> Vec<f64> {
        let Some(kept) = self.tethers.get(tether) else { return Vec::new() };
        let at = NODE * kept.nodes + END * (2 * element + usize::from(upper)) + load;
        kept.states().filter_map(|s| s.get(at).copied()).collect()
    }

    /// The structure: motions of the centre of gravity, forces and moments about it, error expected of the step.
    ///
    /// # Errors
    /// None that can happen: the rows are made to fit.
    pub fn structure_table(&self) -> Result<Table, TableError> {
        let mut table = Table::new("Time History of Structure").column("", "Time", Dim::Time, Digits::Decimals(2));
        let linear = [Dim::Length, Dim::Velocity, Dim::Acceleration];
        let angular = [Dim::Angle, Dim::AngularVelocity, Dim::AngularAcceleration];
        let groups = ["Position", "Velocity", "Acceleration"].into_iter().zip(linear.into_iter().zip(angular));
        let forces = Forces::KINDS.into_iter().map(|kind| (kind, (Dim::Force, Dim::Moment)));
        for (group, dims) in groups.chain(forces).chain([("Error per Timestep", (Dim::Length, Dim::Angle))]) {
            let digits = if dims.0 == Dim::Force || dims.0 == Dim::Length && group != "Position" {
                Digits::Scientific(5)
            } else {
                Digits::Decimals(4)
            };
            for (index, name) in ["X", "Y", "Z", "RX", "RY", "RZ"].into_iter().enumerate() {
                table = table.column(group, name, if index < 3 { dims.0 } else { dims.1 }, digits);
            }
        }
        for row in &self.structure {
            table.push(row.iter().map(|x| Cell::from(*x)).collect())?;
        }
        Ok(table)
    }

    /// The motions of a tether (seed 003, 7.3), nodes from the structure down.
    ///
    /// # Errors
    /// None that can happen: the rows are made to fit.
    pub fn motions_table(&self, tether: usize) -> Result<Table, TableError> {
        let name = self.tethers.get(tether).map_or("", |t| &t.name);
        let mut table = Table::new(format!("Time History of Single Tether {name}"))
            .column("", "Time", Dim::Time, Digits::Decimals(2))
            .column("", "Node", Dim::None, Digits::Decimals(0))
            .column("", "Height", Dim::Length, Digits::Decimals(1))
            .column("", "State", Dim::None, Digits::Usual);
        for (group, name, dim) in MOTIONS {
            let turns = name.starts_with('R') && group != "Acceleration";
            table = table.column(group, name, dim, Digits::Decimals(if turns { 2 } else { 3 }));
        }
        let Some(kept) = self.tethers.get(tether) else { return Ok(table) };
        for ((time, standing), state) in kept.times.iter().zip(&kept.standings).zip(kept.states()) {
            for (node, numbers) in state.chunks_exact(NODE).take(kept.nodes).enumerate().rev() {
                let [height, motions @ ..] = numbers else { continue };
                let mut row = vec![Cell::from(*time), Cell::from(node + 1), Cell::from(*height), told(*standing)];
                row.extend(motions.iter().map(|x| Cell::from(*x)));
                table.push(row)?;
            }
        }
        Ok(table)
    }

    /// What the elements of a tether bear (seed 003, 7.11), from the structure down, each by its upper and its lower end.
    ///
    /// # Errors
    /// None that can happen: the rows are made to fit.
    pub fn loads_table(&self, tether: usize) -> Result<Table, TableError> {
        let name = self.tethers.get(tether).map_or("", |t| &t.name);
        let mut table = Table::new(format!("Time History of Forces and Stresses for Tether {name}"))
            .column("", "Time", Dim::Time, Digits::Decimals(2))
            .column("", "Element", Dim::None, Digits::Decimals(0))
            .column("", "Node", Dim::None, Digits::Decimals(0))
            .column("", "Elevation", Dim::Length, Digits::Decimals(1));
        for (group, name, dim) in LOADS {
            let digits = if group == "Stress" { 3 } else { 4 };
            table = table.column(group, name, dim, Digits::Scientific(digits));
        }
        let Some(kept) = self.tethers.get(tether) else { return Ok(table) };
        for (time, state) in kept.times.iter().zip(kept.states()) {
            let (nodes, ends) = state.split_at((NODE * kept.nodes).min(state.len()));
            for (index, loads) in ends.chunks_exact(END).enumerate().rev() {
                let node = index / 2 + index % 2;
                let height = nodes.get(NODE * node).copied().unwrap_or_default();
                let mut row =
                    vec![Cell::from(*time), Cell::from(index / 2 + 1), Cell::from(node + 1), Cell::from(height)];
                row.extend(loads.iter().map(|x| Cell::from(*x)));
                table.push(row)?;
            }
        }
        Ok(table)
    }

    /// What happened to the tethers.
    ///
    /// # Errors
    /// None that can happen: the rows are made to fit.
    pub fn events_table(&self) -> Result<Table, TableError> {
        let mut table = Table::new("Tether Events")
            .column("", "Time", Dim::Time, Digits::Decimals(2))
            .column("", "Tether", Dim::None, Digits::Usual)
            .column("", "Event", Dim::None, Digits::Usual)
            .column("Impact", "Velocity", Dim::Velocity, Digits::Decimals(2))
            .column("Impact", "Stress", Dim::Stress, Digits::Scientific(4))
            .column("", "Drop", Dim::Length, Digits::Decimals(3));
        for event in &self.events {
            let (what, numbers) = match event.change {
                Change::Slack => ("HAS BECOME SLACK", [None; 3]),
                Change::Impact { velocity, stress } => {
                    ("HAS IMPACTED ON THE UPPER ANCHOR CONSTRAINT", [Some(velocity), Some(stress), None])
                }
                Change::LowerStop { drop } => ("IS ON THE LOWER STOP", [None, None, Some(drop)]),
            };
            let name = self.tethers.get(event.tether).map_or("", |t| &t.name);
            let mut row = vec![Cell::from(event.time), Cell::from(name), Cell::from(what)];
            row.extend(numbers.map(Cell::from));
            table.push(row)?;
        }
        Ok(table)
    }
}

/// How a tether stands, in a word.
fn told(standing: Standing) -> Cell {
    Cell::from(match standing {
        Standing::Taut => "taut",
        Standing::Slack => "slack",
        Standing::OnStop => "on stop",
    })
}

impl Kept {
    fn states(&self) -> impl Iterator<Item = &[f64]> {
        self.numbers.chunks_exact((NODE * self.nodes + END * 2 * self.nodes.saturating_sub(1)).max(1))
    }

    fn take(&mut self, rig: &Rig, time: f64) {
        self.times.push(time);
        self.standings.push(rig.tension().standing);
        for node in 0..self.nodes {
            self.numbers.push(rig.height(node));
            self.numbers.extend(rig.position(node));
            self.numbers.extend(rig.velocity(node));
            self.numbers.extend(rig.acceleration(node));
        }
        for (ends, stresses) in rig.ends().iter().zip(rig.stresses()) {
            for (l, s) in ends.iter().zip(stresses) {
                let [fx, fy] = l.shear;
                let [mx, my] = l.moment;
                self.numbers.extend([l.effective, l.wall, fx, fy, mx, my]);
                self.numbers.extend([s.shear, s.maximum, s.minimum, s.von_mises, s.bending_y, s.axial]);
            }
        }
    }
}

impl Observer for History {
    fn observe(&mut self, moment: &Moment) -> Result<(), ClassError> {
        if self.tethers.is_empty() {
            let kept = |rig: &Rig| Kept { name: rig.tether().name.clone(), nodes: rig.nodes(), ..Kept::default() };
            self.tethers = moment.tethers.iter().map(kept).collect();
        }
        self.events.extend(moment.events);
        let due = moment.state.is_multiple_of(self.every);
        if due {
            let mut row = [0.0; STRUCTURE];
            let place = Six::from(moment.pose.place(&Place::default()).values());
            let motions = [place, moment.velocity, moment.acceleration];
            let all = motions.into_iter().chain(moment.forces.kinds()).chain([moment.error]);
            row[0] = moment.time;
            row[1..].iter_mut().zip(all.flat_map(<[f64; 6]>::from)).for_each(|(to, from)| *to = from);
            self.structure.push(row);
            self.numbers += STRUCTURE;
        }
        for (index, (rig, kept)) in moment.tethers.iter().zip(&mut self.tethers).enumerate() {
            let now = match self.keep {
                Keep::Always => due,
                Keep::WhenSlack(time) => {
                    if moment.events.iter().any(|e| e.tether == index && e.change == Change::Slack) {
                        kept.until = Some(moment.time + time);
                    }
                    kept.until.is_some_and(|until| moment.time <= until)
                }
            };
            if now {
                let before = kept.numbers.len();
                kept.take(rig, moment.time);
                self.numbers += kept.numbers.len() - before;
            }
        }
        if self.numbers > MOST_NUMBERS {
            let text = format!("the history of the run is larger than the {MOST_NUMBERS} numbers that are kept");
            return Err(ClassError::new(text).help("keep fewer states, or take the statistics as the run goes"));
        }
        Ok(())
    }
}
