//! The forces of a line on its two ends, for an engine that asks for them at one place of the fairlead after the other.
//!
//! One segment that stretches by its stiffness, over a flat bottom at its anchor or over none, is the fast path: the two forces at its
//! fairlead are the only unknowns (`end_forces_cold`, `end_forces_warm`). Any other line is solved with all its contacts (`solve`), and the
//! forces are those of its state. Both are proven to the same residual; callers do not choose.

use super::end_forces::EndForces;
use super::error::LineError;
use super::line::Line;
use super::state::LineState;

/// What a line does to its two ends, in its vertical plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineForces {
    /// Horizontal and vertical pull on the fairlead (N, toward the anchor and downward).
    pub fairlead: [f64; 2],
    /// Horizontal and vertical pull on the anchor (N, toward the fairlead and upward).
    pub anchor: [f64; 2],
    /// d(fairlead)/d(distance, elevation of the fairlead) (N/m).
    pub stiffness: [[f64; 2]; 2],
    /// d(anchor)/d(distance, elevation of the fairlead) (N/m).
    pub coupling: [[f64; 2]; 2],
}

impl From<&LineState> for LineForces {
    fn from(state: &LineState) -> Self {
        LineForces {
            fairlead: [state.force, state.top_vertical],
            anchor: [state.anchor_horizontal, state.anchor_vertical],
            stiffness: state.stiffness,
            coupling: state.coupling,
        }
    }
}

/// The last solution of a line: it decides how long the next one takes, and its digits only within the proof.
#[derive(Clone, Debug)]
pub struct CatenaryWarmStart(LastSolution);

#[derive(Clone, Debug)]
enum LastSolution {
    Segment(EndForces),
    Line(Box<LineState>),
}

impl CatenaryWarmStart {
    /// The last pull on the fairlead (N, toward the anchor and downward).
    pub fn fairlead(&self) -> [f64; 2] {
        match &self.0 {
            LastSolution::Segment(last) => last.fairlead,
            LastSolution::Line(last) => [last.force, last.top_vertical],
        }
    }
}

impl Line {
    /// The forces with the fairlead at elevation `fairlead` (m) and `x` >= 0 beside the anchor (m). `warm` is the last solution of this line,
    /// `None` for a cold start, and becomes this one.
    ///
    /// # Errors
    /// [`LineError`]; forces that are returned have been proven. `warm` is then as before.
    pub fn solve_forces(
        &self,
        x: f64,
        fairlead: f64,
        warm: &mut Option<CatenaryWarmStart>,
    ) -> Result<LineForces, LineError> {
        let Some((segment, bottom)) = self.lone_segment else {
            let state = match warm {
                Some(CatenaryWarmStart(LastSolution::Line(last))) => self.solve_warm_start(x, fairlead, last)?,
                _ => self.at_distance(x, fairlead)?,
            };
            let forces = LineForces::from(&state);
            match warm {
                Some(CatenaryWarmStart(LastSolution::Line(last))) => **last = state,
                _ => *warm = Some(CatenaryWarmStart(LastSolution::Line(Box::new(state)))),
            }
            return Ok(forces);
        };
        let rise = fairlead - self.anchor;
        let found = match warm {
            Some(CatenaryWarmStart(LastSolution::Segment(last))) => segment.solve_warm_start(x, rise, bottom, last)?,
            _ => segment.solve_end_forces(x, rise, bottom)?,
        };
        *warm = Some(CatenaryWarmStart(LastSolution::Segment(found)));
        let coupling = found.coupling(bottom.map_or(0.0, |b| b.friction));
        Ok(LineForces { fairlead: found.fairlead, anchor: found.anchor, stiffness: found.stiffness, coupling })
    }
}
