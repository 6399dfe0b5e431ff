//! What an engine asks of a connector: the wrench on each of its ends, how it changes, and the state it would leave.
//!
//! An engine holds the states of all its elements in one vector, gives each its committed part, and commits the trial part
//! only with an accepted step. In statics there is no step: rates are zero and a trial state is where the element comes to
//! rest.

use super::along::{EnergyBalance, LineMode, LineNode};
use super::ambient::Ambient;
use super::class::ClassError;
use super::connector::Connector;
use super::curve::Curve;
use super::environment::Surroundings;
use super::line::Placement;
use super::note::Note;
use super::scheme::SchemeWeights;
use super::tie::TieResponse;
use nalgebra::{Matrix3, Matrix6, Vector3};
use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};

/// An end of a connector: a point of a body with that body's axes, or a place in the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// The point (m, global) and the axes of its body; global axes on the ground.
    pub pose: Pose,
    /// Velocity of the point (m/s) and rotation of its body (rad/s), global axes.
    pub velocity: Six,
    /// Their derivatives (m/s2, rad/s2): for elements with inertia of their own.
    pub acceleration: Six,
}

impl End {
    /// An end at rest.
    pub fn at_rest(pose: Pose) -> Self {
        End { pose, velocity: Six::zeros(), acceleration: Six::zeros() }
    }

    /// Where the two ends of a line are (m, global).
    ///
    /// # Errors
    /// Another number of ends.
    pub fn origins(ends: &[End]) -> Result<[Vector3<f64>; 2], ClassError> {
        match ends {
            [first, second] => Ok([first.pose.origin, second.pose.origin]),
            _ => Err(ClassError::new(format!("a line has two ends, not {}", ends.len()))),
        }
    }
}

/// A step of a time-domain engine, to the end of which an element is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeStep {
    /// Time at its end (s).
    pub time: f64,
    /// Its length (s).
    pub dt: f64,
}

/// In which situation an element is evaluated.
#[derive(Clone, Copy, Debug)]
pub struct Situation<'a> {
    /// The ends, in the order of the connector's points; a second end in the ground stands behind a single point.
    pub ends: &'a [End],
    /// The step; `None` in statics. To an element with inertia of its own ([`ConnectorElement::as_dynamic`]) also one without length: what
    /// it exerts at once, as it moves.
    pub step: Option<TimeStep>,
    /// Water, depth, gravity.
    pub surroundings: &'a Surroundings,
}

/// What the solver of an element keeps of its last answer, to start the next one near it (warm start). Answers do not depend on it
/// but for rounding, so that it can be cleared at any time.
#[derive(Default)]
pub struct SolverCache(Option<Box<dyn Any + Send>>);

impl SolverCache {
    /// A cache with nothing in it.
    pub const fn new() -> Self {
        SolverCache(None)
    }

    /// What it keeps, if that is of this type.
    pub fn get<T: Any>(&self) -> Option<&T> {
        self.0.as_ref()?.downcast_ref()
    }

    /// The same to be changed.
    pub fn get_mut<T: Any>(&mut self) -> Option<&mut T> {
        self.0.as_mut()?.downcast_mut()
    }

    /// Keeps a value in place of what it kept.
    pub fn set<T: Any + Send>(&mut self, value: T) {
        self.0 = Some(Box::new(value));
    }

    /// What it keeps, where that is of this type and usable; else a new value, which it keeps from now on.
    pub fn get_or_insert<T: Any + Send>(
        &mut self,
        is_usable: impl FnOnce(&T) -> bool,
        make: impl FnOnce() -> T,
    ) -> Option<&mut T> {
        if !self.get().is_some_and(is_usable) {
            self.set(make());
        }
        self.get_mut()
    }

    /// Takes its content out.
    pub fn take(&mut self) -> Self {
        SolverCache(self.0.take())
    }
}

impl Debug for SolverCache {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(if self.0.is_some() { "SolverCache(..)" } else { "SolverCache" })
    }
}

/// What an element answers. Blocks are in the order of ends, row by row: block `i * ends + j` is that of the wrench on end `i` and
/// the motion of end `j`.
#[derive(Clone, Debug, Default)]
pub struct ConnectorResponse {
    /// Wrench on each end: force (N) and moment (N m) about the end's point, global axes.
    pub wrench: Vec<Six>,
    /// -d(wrench)/d(translation of the point, rotation vector), global axes (N/m, N/rad, N, N m/rad): positive where the
    /// element holds back.
    pub stiffness: Vec<Matrix6<f64>>,
    /// -d(wrench)/d(velocity); empty when the wrench depends on no rate.
    pub damping: Vec<Matrix6<f64>>,
    /// -d(wrench)/d(acceleration); empty of an element without inertia of its own.
    pub inertia: Vec<Matrix6<f64>>,
}

impl ConnectorResponse {
    /// All zero for so many ends, without rates.
    pub fn clear(&mut self, ends: usize) {
        self.wrench.clear();
        self.wrench.resize(ends, Six::zeros());
        self.stiffness.clear();
        self.stiffness.resize(ends * ends, Matrix6::zeros());
        self.damping.clear();
        self.inertia.clear();
    }
}

/// One degree of freedom of a spring, in element axes.
#[derive(Clone, Debug, PartialEq)]
pub struct SpringState {
    /// X Y Z RX RY RZ.
    pub dof: String,
    /// Deflection (m or rad).
    pub deflection: f64,
    /// Force on the first end (N or N m).
    pub force: f64,
    /// Allowable force (N or N m), where one is given.
    pub allowable: Option<f64>,
}

/// A fender in a situation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FenderState {
    /// Deflection (m); zero where it does not touch.
    pub deflection: f64,
    /// Rated deflection (m).
    pub rated: f64,
    /// Reaction of its curve (N).
    pub reaction: f64,
    /// Energy absorbed, the area under its curve (N m).
    pub energy: f64,
    /// The same at the rated deflection (N m).
    pub rated_energy: f64,
}

/// What is reported of an element in a situation, beside the wrench on its ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ConnectorSummary {
    /// Tension at the first end (N), of elements that have one; negative of a spring that pushes.
    pub tension: Option<f64>,
    /// Largest tension over own break, or force over allowable.
    pub ratio: Option<f64>,
    /// The segment that has it, from 1.
    pub critical: Option<usize>,
    /// Largest tension over a break that was given (its value, a strength, a line type; not that of a bare diameter), and the
    /// segment that has it, from 1.
    pub over_given_break: Option<(f64, usize)>,
    /// By what share of its length a line is too short for its ends, of one that reaches them beyond its break alone.
    pub too_short: Option<f64>,
    /// Unstretched length on the bottom (m).
    pub grounded: Option<f64>,
    /// How it was found: `exact`, `table`, ...
    pub solution: &'static str,
    /// Deflections and forces of springs.
    pub springs: Vec<SpringState>,
    /// Of a fender, how far it is deflected.
    pub fender: Option<FenderState>,
    /// What a user should know; `warning: ` before what is dangerous.
    pub notes: Vec<Note>,
}

/// To which force category of reports the force of an element belongs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ConnectorCategory {
    /// FLEX_CONNECTORS.
    #[default]
    Flexible,
    /// RIGID_CONNECTORS: restraints.
    Rigid,
}

/// A connector as an engine sees it: its force law. Its parameters do not change. What only some elements can do are traits of their
/// own, which the accessors `as_..` give; an element that wraps another passes the accessor on.
pub trait ConnectorElement: Debug + Send + Sync {
    /// Number of values of its state.
    fn states(&self) -> usize {
        0
    }

    /// Its state before anything has happened, in SI.
    fn start(&self, _state: &mut [f64]) {}

    /// The wrench on its ends and how it changes; `trial` is the state at the end of the step.
    ///
    /// # Errors
    /// A situation for which no answer could be proven.
    fn evaluate(
        &self,
        at: &Situation,
        committed: &[f64],
        trial: &mut [f64],
        cache: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError>;

    /// The wrenches on its ends at rest, as of [`ConnectorElement::evaluate`], without how they change; `out` is overwritten.
    ///
    /// # Errors
    /// As [`ConnectorElement::evaluate`].
    fn evaluate_wrenches(
        &self,
        at: &Situation,
        committed: &[f64],
        cache: &mut SolverCache,
        out: &mut Vec<Six>,
    ) -> Result<(), ClassError> {
        let (mut all, mut trial) = (ConnectorResponse::default(), committed.to_vec());
        self.evaluate(at, committed, &mut trial, cache, &mut all)?;
        *out = all.wrench;
        Ok(())
    }

    /// What is reported of it.
    ///
    /// # Errors
    /// As [`ConnectorElement::evaluate`].
    fn summary(&self, at: &Situation, committed: &[f64]) -> Result<ConnectorSummary, ClassError>;

    /// Where its force is counted.
    fn category(&self) -> ConnectorCategory {
        ConnectorCategory::Flexible
    }

    /// On how many of its ends, from the first, it exerts forces; where those behind are only changes these.
    fn acting_ends(&self) -> usize {
        usize::MAX
    }

    /// The length of its first segment in a state (m), of an element that it runs into and out of by itself.
    ///
    /// # Errors
    /// As [`ConnectorElement::evaluate`].
    fn running_length(&self, _at: &Situation, _committed: &[f64]) -> Result<Option<f64>, ClassError> {
        Ok(None)
    }

    /// The end by whose force its tension is reported.
    fn pulling_end(&self) -> usize {
        0
    }

    /// Of an element that also takes compression, the least distance of its ends (m) from which on a force on the one away from the
    /// other is compression; none of one that only pulls.
    fn compression_onset(&self) -> Option<f64> {
        None
    }

    /// The element as one whose force follows from the place of its first end alone.
    fn as_anchored(&self) -> Option<&dyn AnchoredConnector> {
        None
    }

    /// The element as a stiff tie, whose force an engine may hold.
    fn as_stiff_tie(&self) -> Option<&dyn StiffTie> {
        None
    }

    /// The element as one made for the place of its ends.
    fn as_placed(&self) -> Option<&dyn PlacedConnector> {
        None
    }

    /// The element as one that is cut into nodes.
    fn as_nodal(&self) -> Option<&dyn NodalConnector> {
        None
    }

    /// The element as a dynamic line: it has inertia between its ends, its wrench depends on their accelerations, and its state in a
    /// run begins where it hangs at rest.
    fn as_dynamic(&self) -> Option<&dyn DynamicConnector> {
        None
    }
}

/// What an [`AnchoredConnector`] exerts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AnchoredResponse {
    /// Wrench on each end, forces alone (N), global axes.
    pub wrenches: [Six; 2],
    /// -d(force on the first end)/d(place of the first end), global axes (N/m).
    pub stiffness: Matrix3<f64>,
}

/// An element from a body to the ground without state, which pulls with a force that the place of its first end alone changes.
pub trait AnchoredConnector {
    /// What [`ConnectorElement::evaluate`] gives, with less work.
    ///
    /// # Errors
    /// As [`ConnectorElement::evaluate`].
    fn evaluate_anchored(&self, at: &Situation, cache: &mut SolverCache) -> Result<AnchoredResponse, ClassError>;
}

/// A linear tie so stiff that rounding of places makes forces.
pub trait StiffTie {
    /// What it exerts, in `out`, with a force that an engine holds in place of that of its law; `None` for that of its law.
    ///
    /// # Errors
    /// As [`ConnectorElement::evaluate`].
    fn evaluate_tie(
        &self,
        at: &Situation,
        held: Option<&Six>,
        out: &mut ConnectorResponse,
    ) -> Result<TieResponse, ClassError>;
}

/// An element whose parameters depend on where its ends were when it was made, so that a solver makes it anew where they come to rest.
pub trait PlacedConnector {
    /// The same in other surroundings, without being made anew for them.
    fn with_ambient(&self, ambient: &Arc<dyn Ambient>) -> Box<dyn ConnectorElement>;
}

/// An element that is cut into nodes and has results along itself.
pub trait NodalConnector {
    /// How many nodes it reports at most: elements may appear at a winch.
    fn max_nodes(&self) -> usize;

    /// Whether its nodes have a wall, shear and moments to report.
    fn has_bending(&self) -> bool;

    /// Its nodes in a state; `out` is overwritten.
    ///
    /// # Errors
    /// A state that is not one of its own.
    fn find_nodes(&self, at: &Situation, state: &[f64], out: &mut Vec<LineNode>) -> Result<(), ClassError>;

    /// The same with what a row of a run keeps of them, as quickly as may be: velocities and curvatures may be left out, of one without
    /// bending all beside effective tension and clearance. What the solver keeps is room to work in.
    ///
    /// # Errors
    /// As [`NodalConnector::find_nodes`].
    fn find_row_nodes(
        &self,
        at: &Situation,
        state: &[f64],
        cache: &mut SolverCache,
        out: &mut Vec<LineNode>,
    ) -> Result<(), ClassError>;
}

/// A dynamic line.
pub trait DynamicConnector: NodalConnector {
    /// The energy and momentum balance in a state, where a run keeps them.
    fn energy_balance(&self, state: &[f64]) -> Option<EnergyBalance>;

    /// Its slowest natural modes in a state, slowest first, with its ends held where they are.
    ///
    /// # Errors
    /// A state that is not one of its own, one that is not stable, or more modes than it has.
    fn natural_modes(&self, at: &Situation, state: &[f64], number: usize) -> Result<Vec<LineMode>, ClassError>;

    /// The most by which a winch may change its length within one step (m).
    fn max_payout_step(&self) -> f64;

    /// What the user should know of it at rest; nothing where there is nothing to say.
    fn static_caution(&self, at: &Situation) -> Option<&'static str>;
}

/// What a run asks of a dynamic line; nothing of the kind where there is no run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RunRequirement {
    /// The longest its first segment becomes (m), where a winch pays it out.
    pub longest: Option<f64>,
    /// Whether its energy and momentum balance is kept.
    pub balance: bool,
    /// Whether its first end is let go: it falls, held at its second end.
    pub freed: bool,
    /// The scheme that steps it; that of its engine where none.
    pub scheme: Option<SchemeWeights>,
}

/// What a class is given about the connector that an element is made of.
#[derive(Clone)]
pub struct Connection<'a> {
    /// The connector.
    pub connector: &'a Connector,
    /// Where its two ends stand now; the second in the ground where it has one point.
    pub ends: [Pose; 2],
    /// Whether the second end is in the ground.
    pub to_ground: bool,
    /// How the ends of a line are given to its class.
    pub placement: Placement,
    /// The curve of a name.
    pub curve: &'a dyn Fn(&str) -> Option<&'a Curve>,
    /// Water, depth, gravity.
    pub surroundings: &'a Surroundings,
    /// What surrounds it all along, where an engine gives it.
    pub ambient: Option<&'a Arc<dyn Ambient>>,
    /// What a run asks of it.
    pub duty: RunRequirement,
    /// What a rigid tie between its ends has to hold.
    pub tied: &'a dyn Fn() -> TiedBodies,
}

/// The bodies at the ends of a connector, as a rigid tie sees them: of each quantity that of the body with the most.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TiedBodies {
    /// Mass (kg), and largest moment of inertia about the centre of gravity (kg m2).
    pub inertia: [f64; 2],
    /// Largest hydrostatic stiffness of a translation (N/m) and of a rotation (N m/rad), of those that are given as numbers.
    pub stiffness: [f64; 2],
}

impl Debug for Connection<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Connection").field("connector", &self.connector).field("ends", &self.ends).finish()
    }
}
