//! What a solved line looks like.

use super::layout::LaidLine;
use super::multi_segment::LineSolution;

/// How a spring buoy stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Buoy {
    /// The joint is above the end of its pendant: no pull. A buoy without pendant: it has left the water.
    Slack,
    /// The joint hangs on its pendant; the buoy floats.
    Held,
    /// The buoy is pulled under with all its capacity.
    Sunk,
}

/// Where a line that is longer than its way lies in a heap: its tension is zero there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Heap {
    /// Straight below the fairlead, where the line first touches the bottom; what lies beyond hangs on the anchor.
    Touchdown,
    /// At the anchor: the spare length slides down the slope to it.
    Anchor,
    /// In a hollow of the bottom, at this distance from the anchor (m).
    Hollow(f64),
}

/// A segment in a configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentState {
    /// Tension at the end toward the fairlead (N).
    pub top_tension: f64,
    /// Tension at the end toward the anchor (N).
    pub bottom_tension: f64,
    /// Horizontal force at the end toward the fairlead (N).
    pub top_horizontal: f64,
    /// Horizontal force at the end toward the anchor (N): smaller where friction or a slope took some.
    pub bottom_horizontal: f64,
    /// Vertical force at the end toward the fairlead (N, positive where the line rises toward the fairlead).
    pub top_vertical: f64,
    /// Vertical force at the end toward the anchor (N).
    pub bottom_vertical: f64,
    /// Unstretched length on the bottom (m).
    pub grounded: f64,
}

/// A joint in a configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointState {
    /// Horizontal distance from the fairlead (m).
    pub x: f64,
    /// Elevation (m).
    pub z: f64,
    /// Force applied to the line there (N, upward; of a clump weight on the bottom, what the bottom does not carry).
    pub lift: f64,
    /// What the bottom carries there (N, normal to it).
    pub reaction: f64,
    /// State of the spring buoy, if there is one.
    pub buoy: Option<Buoy>,
}

/// A line in equilibrium.
#[derive(Clone, Debug)]
pub struct LineState {
    /// Horizontal force at the fairlead (N).
    pub force: f64,
    /// Horizontal distance from fairlead to anchor (m).
    pub x: f64,
    /// Derivative of the distance with respect to the horizontal force at a fixed fairlead elevation (m/N).
    pub dx_dh: f64,
    /// Vertical force of the line on the fairlead (N, downward).
    pub top_vertical: f64,
    /// Tension at the fairlead (N).
    pub top_tension: f64,
    /// Horizontal pull on the anchor (N, toward the fairlead).
    pub anchor_horizontal: f64,
    /// Vertical pull on the anchor (N, upward).
    pub anchor_vertical: f64,
    /// d(H, V at the fairlead)/d(x, z of the fairlead) (N/m), row by row. Infinite in its last place for a line that lies on
    /// the bottom up to its fairlead: there V grows as the root of z.
    pub stiffness: [[f64; 2]; 2],
    /// d(H, V at the anchor)/d(x, z of the fairlead) (N/m), row by row.
    pub coupling: [[f64; 2]; 2],
    /// Unstretched length on the bottom (m).
    pub grounded: f64,
    /// The same, stretched (m).
    pub grounded_stretched: f64,
    /// Where the line first meets the bottom: distance from the fairlead and elevation (m).
    pub touchdown: Option<(f64, f64)>,
    /// Segments, fairlead first.
    pub segments: Vec<SegmentState>,
    /// Joints, fairlead first.
    pub joints: Vec<JointState>,
    /// Segments (from 1) that hang below the bottom because the first segment does not see it where a spring buoy ends it, with
    /// how far (m).
    pub below_bottom: Vec<(usize, f64)>,
    /// Segments (from 1) whose buoyant line or lower joint rises above the water surface, with how far (m).
    pub above_surface: Vec<(usize, f64)>,
    /// The line reaches without any horizontal force.
    pub slack: bool,
    /// Where spare length lies in a heap on a bottom that is not flat, and how much of it (m).
    pub heap: Option<(Heap, f64)>,
    /// Iterations of all the searches.
    pub iterations: usize,
    /// What is left of the distance, mapped through the stiffness to a force (N): at most 1e-9 of the tension.
    pub residual: f64,
    /// Largest force left at a joint (N): at most 1e-9 of the tension.
    pub unbalance: f64,
    /// Ends of the chain's pieces: distance from the fairlead and elevation (m).
    pub(super) positions: Vec<(f64, f64)>,
    pub(super) rested: LineSolution,
    /// The stretches of a line over a bottom that is not flat and smooth.
    pub(super) laid: Option<Box<LaidLine>>,
}

impl LineState {
    /// Whether every number is one.
    pub(super) fn is_finite(&self) -> bool {
        let slope = if self.slack { 0.0 } else { self.dx_dh };
        let line = [self.force, self.x, slope, self.top_tension, self.grounded_stretched];
        let far = [self.anchor_horizontal, self.anchor_vertical, self.stiffness[0][0], self.stiffness[0][1]];
        let joints = self.joints.iter().flat_map(|j| [j.x, j.z, j.lift, j.reaction]);
        let parts = self.segments.iter().flat_map(|s| [s.top_tension, s.bottom_tension, s.grounded]);
        line.into_iter().chain(far).chain(joints).chain(parts).all(f64::is_finite)
    }
}
