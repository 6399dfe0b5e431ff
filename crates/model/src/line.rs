//! What a mooring line between two places answers, whatever its class.

use super::bathymetry::Bathymetry;
use super::class::ClassError;
use super::element::ConnectorElement;
use super::note::Note;
use std::sync::Arc;
use windlass_base::geometry::Position;
use windlass_base::table::Table;

/// Where a connector's ends are when it is asked something (m, global).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Placement {
    /// The first end: the fairlead of a line.
    pub fairlead: Position,
    /// The other end; the elevation of an anchor is its own, else from the depth its class says.
    pub other: Option<Position>,
    /// Whether the other end is in the ground.
    pub to_ground: bool,
    /// Whether it is an anchor, and no point.
    pub anchored: bool,
    /// Length of the first segment in place of the class's (m).
    pub first_length: Option<f64>,
    /// Long-term stiffness of the viscoelastic spring of the class (N/m), where its curve is defined.
    pub series: Option<f64>,
    /// The bathymetry that the line lies on; none where its bottom is a plane.
    pub bathymetry: Option<Arc<Bathymetry>>,
}

impl Placement {
    /// Horizontal distance between the ends (m), and the direction from the first to the other.
    pub fn span(&self) -> (f64, [f64; 2]) {
        let [x, y, _] = self.fairlead;
        let [ox, oy, _] = self.other.unwrap_or(self.fairlead);
        let distance = (ox - x).hypot(oy - y);
        if distance > 0.0 { (distance, [(ox - x) / distance, (oy - y) / distance]) } else { (0.0, [1.0, 0.0]) }
    }
}

/// In which configuration a line is asked for; its fairlead keeps its elevation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Condition {
    /// Between its ends as they are.
    Placed,
    /// At this horizontal distance (m).
    Distance(f64),
    /// Pulled with this horizontal force at the fairlead (N).
    Horizontal(f64),
    /// With this tension at the fairlead (N).
    Tension(f64),
    /// With this vertical force on the fairlead (N, downward).
    Vertical(f64),
}

/// A change of a line itself, to see what it does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LineChange {
    /// Another friction coefficient of the bottom.
    Friction(f64),
    /// Another slope of the bottom.
    Slope(f64),
    /// All weights in water times this.
    Weight(f64),
    /// All axial stiffnesses times this.
    Stiffness(f64),
}

/// What a line does to what it is attached to, and what it bears.
#[derive(Clone, Debug, PartialEq)]
pub struct LineLoads {
    /// Force of the line on its first end (N, global).
    pub fairlead: Position,
    /// Force of the line on its other end (N, global).
    pub other: Position,
    /// d(force on the first end)/d(its position) (N/m, global), row by row.
    pub stiffness: [[f64; 3]; 3],
    /// Horizontal distance between the ends (m).
    pub distance: f64,
    /// Tension at the fairlead (N).
    pub tension: f64,
    /// Largest tension over own break.
    pub ratio: f64,
    /// The segment that has it, from 1.
    pub critical: usize,
    /// As [`super::ConnectorSummary::over_given_break`].
    pub over_given_break: Option<(f64, usize)>,
    /// Unstretched length on the bottom (m).
    pub grounded: f64,
    /// How it was found: exactly, or from a table.
    pub solution: &'static str,
    /// What a user should know of it; `warning: ` before what is dangerous.
    pub notes: Vec<Note>,
}

/// A line in one configuration, in its own vertical plane.
#[derive(Clone, Debug, PartialEq)]
pub struct LineConfiguration {
    /// Horizontal distance between the ends (m).
    pub distance: f64,
    /// Horizontal force of the line on its first end, toward the other (N).
    pub horizontal: f64,
    /// Vertical force of the line on its first end (N, downward).
    pub vertical: f64,
    /// Tension at the fairlead (N); negative of a spring that pushes.
    pub tension: f64,
    /// Largest tension over own break.
    pub ratio: f64,
    /// The segment that has it, from 1.
    pub critical: usize,
    /// Horizontal pull on the anchor toward the fairlead, and vertical one upward (N).
    pub anchor: [f64; 2],
    /// Stretched length on the bottom (m).
    pub on_bottom: f64,
    /// What a user should know of it; `warning: ` before what is dangerous.
    pub notes: Vec<Note>,
}

impl LineLoads {
    /// Horizontal pull on the other end toward the first, and vertical one upward (N); `along` is the direction from
    /// the first end to the other.
    pub fn anchor(&self, along: [f64; 2]) -> [f64; 2] {
        let [x, y, z] = self.other;
        // no pull is zero without a sign
        [0.0 - x * along[0] - y * along[1], z]
    }
}

/// The lengths of a first segment with which a condition holds.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundLength {
    /// The one nearest to the present length (m).
    pub length: f64,
    /// The others (m).
    pub others: Vec<f64>,
    /// Bounds between which lengths have no configuration (m).
    pub unsolved: Vec<[f64; 2]>,
}

impl FoundLength {
    /// The only one.
    pub fn single(length: f64) -> Self {
        FoundLength { length, others: Vec::new(), unsolved: Vec::new() }
    }
}

/// A row of a line's table without a configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct AbsentRow {
    /// Its number, from 1.
    pub number: usize,
    /// Why.
    pub error: ClassError,
}

/// At how many points the shape of a line is tabulated. Ends of segments, joints and touchdown points are always among them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineSampling {
    /// As many as a drawn curve needs.
    Adaptive,
    /// So many inside each segment, evenly.
    Inside(usize),
}

/// A mooring line between two places.
pub trait LineModel {
    /// The thirty-row table of `CONN_DESIGN TABLE`, and its rows without a configuration, which have no numbers but their force.
    ///
    /// # Errors
    /// A line without a configuration in any row.
    fn tabulate(&self, connector: &str) -> Result<(Table, Vec<AbsentRow>), ClassError>;

    /// The shape of the line: arc length, position, tension, angle, one row a point.
    ///
    /// # Errors
    /// A condition that no configuration meets.
    fn geometry(&self, connector: &str, condition: Condition, sampling: LineSampling) -> Result<Table, ClassError>;

    /// The line in one configuration, solved exactly whatever its forces between its ends come from.
    ///
    /// # Errors
    /// A condition that no configuration meets.
    fn configuration(&self, condition: Condition) -> Result<LineConfiguration, ClassError>;

    /// What the line does between its ends as they are.
    ///
    /// # Errors
    /// A line for which no configuration could be proven.
    fn loads(&self) -> Result<LineLoads, ClassError>;

    /// The line with a change.
    ///
    /// # Errors
    /// A change of what the line does not have: a bottom, a weight, a stiffness that is one number.
    fn with_change(&self, change: LineChange) -> Result<Box<dyn LineModel>, ClassError>;

    /// The line as an engine sees it.
    ///
    /// # Errors
    /// A line between moving ends that rests on the bottom; a table that cannot be made.
    fn element(&self) -> Result<Box<dyn ConnectorElement>, ClassError>;

    /// The horizontal distance between the ends under a condition (m).
    ///
    /// # Errors
    /// A condition that no configuration meets.
    fn distance(&self, condition: Condition) -> Result<f64, ClassError>;

    /// The lengths of the first segment with which the condition holds between the ends as they are.
    ///
    /// # Errors
    /// A condition that no length meets.
    fn first_length(&self, condition: Condition) -> Result<FoundLength, ClassError>;
}
