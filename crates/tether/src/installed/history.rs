//! What is kept of a run as series: structure, tethers, events.

use super::rig::Rig;
use super::rig::RigChange;
use super::run::{InstalledObserver, Moment, TetherEvent};
use crate::structure::StructureForces;
use windlass_base::geometry::Place;
use windlass_base::pose::Six;
use windlass_model::ClassError;

/// Numbers kept at most: 400 MB.
const MAX_STORED_NUMBERS: usize = 50_000_000;
/// Numbers of the structure in a state: motions, kinds of force, error.
const NUMBERS_PER_STRUCTURE: usize = 1 + 18 + 6 * StructureForces::KINDS.len() + 6;
/// Numbers of a node, and of an end of an element.
const NUMBERS_PER_NODE: usize = 13;
const NUMBERS_PER_END: usize = 12;

/// When tethers are kept. The structure is kept at every state of [`InstalledHistory::every`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Keep {
    /// At the same states as the structure.
    Always,
    /// From a tether's going slack on, for a time (s), at every state (TSLK of [AQWA-TETHER A.6]).
    WhenSlack(f64),
}

/// A tether's states.
#[derive(Clone, Debug, Default)]
struct TetherStates {
    times: Vec<f64>,
    /// Node by node, then end by end, of each state.
    numbers: Vec<f64>,
    nodes: usize,
    /// Until when it is kept after it went slack (s).
    until: Option<f64>,
}

/// What is kept of a run.
#[derive(Clone, Debug)]
pub struct InstalledHistory {
    /// Every how many states the run is kept.
    pub every: usize,
    keep: Keep,
    structure: Vec<[f64; NUMBERS_PER_STRUCTURE]>,
    tethers: Vec<TetherStates>,
    events: Vec<TetherEvent>,
    numbers: usize,
}

impl InstalledHistory {
    /// A history of every state, or of one in a number of them.
    pub fn new(every: usize, keep: Keep) -> Self {
        let every = every.max(1);
        InstalledHistory { every, keep, structure: Vec::new(), tethers: Vec::new(), events: Vec::new(), numbers: 0 }
    }

    /// The events, in order.
    pub fn events(&self) -> &[TetherEvent] {
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

    /// A series (N, N m) of a kind of force on the structure, by the order of [`StructureForces::KINDS`].
    pub fn force(&self, kind: usize, direction: usize) -> Vec<f64> {
        self.structure.iter().filter_map(|row| row.get(19 + 6 * kind + direction).copied()).collect()
    }

    /// A series of the error expected of the step in a direction (0 to 5).
    pub fn error(&self, direction: usize) -> Vec<f64> {
        let at = 19 + 6 * StructureForces::KINDS.len() + direction;
        self.structure.iter().filter_map(|row| row.get(at).copied()).collect()
    }

    /// Times at which a tether is kept (s).
    pub fn tether_times(&self, tether: usize) -> &[f64] {
        self.tethers.get(tether).map_or(&[], |t| &t.times)
    }

    /// A series (m, rad, s) of a node of a tether, X, Y, RX, RY, their velocities and their accelerations in this order. Nodes count from 0
    /// at the anchor.
    pub fn node(&self, tether: usize, node: usize, motion: usize) -> Vec<f64> {
        let Some(kept) = self.tethers.get(tether) else { return Vec::new() };
        kept.states().filter_map(|s| s.get(NUMBERS_PER_NODE * node + 1 + motion).copied()).collect()
    }

    /// A series (N, N m, Pa) of an end of an element of a tether, in the order effective and wall tension, shear along X and Y, moments about
    /// X and Y, shear stress, largest and smallest of bending and
    /// axial stress, von Mises, bending of the moment about Y, axial stress; `upper` is its upper end.
    pub fn end(&self, tether: usize, element: usize, upper: bool, load: usize) -> Vec<f64> {
        let Some(kept) = self.tethers.get(tether) else { return Vec::new() };
        let at = NUMBERS_PER_NODE * kept.nodes + NUMBERS_PER_END * (2 * element + usize::from(upper)) + load;
        kept.states().filter_map(|s| s.get(at).copied()).collect()
    }
}

impl TetherStates {
    fn states(&self) -> impl Iterator<Item = &[f64]> {
        self.numbers
            .chunks_exact((NUMBERS_PER_NODE * self.nodes + NUMBERS_PER_END * 2 * self.nodes.saturating_sub(1)).max(1))
    }

    fn take(&mut self, rig: &Rig, time: f64) {
        self.times.push(time);
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

impl InstalledObserver for InstalledHistory {
    fn observe(&mut self, moment: &Moment) -> Result<(), ClassError> {
        if self.tethers.is_empty() {
            let kept = |rig: &Rig| TetherStates { nodes: rig.nodes(), ..TetherStates::default() };
            self.tethers = moment.tethers.iter().map(kept).collect();
        }
        self.events.extend(moment.events);
        let due = moment.state.is_multiple_of(self.every);
        if due {
            let mut row = [0.0; NUMBERS_PER_STRUCTURE];
            let position = Six::from(moment.pose.position(&Place::default()).values());
            let motions = [position, moment.velocity, moment.acceleration];
            let all = motions.into_iter().chain(moment.forces.kinds()).chain([moment.error]);
            row[0] = moment.time;
            row[1..].iter_mut().zip(all.flat_map(<[f64; 6]>::from)).for_each(|(to, from)| *to = from);
            self.structure.push(row);
            self.numbers += NUMBERS_PER_STRUCTURE;
        }
        for (index, (rig, kept)) in moment.tethers.iter().zip(&mut self.tethers).enumerate() {
            let now = match self.keep {
                Keep::Always => due,
                Keep::WhenSlack(time) => {
                    if moment.events.iter().any(|e| e.tether == index && e.change == RigChange::Slack) {
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
        if self.numbers > MAX_STORED_NUMBERS {
            let text = format!("the history of the run is larger than the {MAX_STORED_NUMBERS} numbers that are kept");
            return Err(ClassError::new(text).help("keep fewer states, or take the statistics as the run goes"));
        }
        Ok(())
    }
}
