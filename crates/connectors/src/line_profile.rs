//! The bathymetry under a line: its profile along the vertical plane of the ends.
//!
//! The line lies in that plane, which turns with its fairlead; what the bottom does across it is left out. The profile is made of plane
//! faces between points at equal distances from the anchor, so that it changes without jumps when the plane turns.

use std::sync::Arc;
use windlass_catenary::{Line, LineError};
use windlass_model::Bathymetry;

/// Faces in the shortest side of a cell of the grid: a chord of a sixteenth is off the parabola through three depths by 1/256 of that
/// parabola's own height over the cell.
const FACES_PER_CELL: f64 = 16.0;
/// The most faces of a profile; the time to solve a line grows with them.
const MAX_FACES: f64 = 400.0;
/// How far the profile goes, over the unstretched length or the distance of the ends, whichever is longer: lines stretch, become longer,
/// and are searched with larger forces than they bear.
const PROFILE_REACH_RATIO: f64 = 1.25;

/// The bathymetry along the azimuth of a line.
#[derive(Clone, Debug)]
pub struct LineProfile {
    grid: Arc<Bathymetry>,
    /// Place of the anchor (m, global).
    anchor: [f64; 2],
    /// Direction from the fairlead to the anchor.
    azimuth: [f64; 2],
    /// Horizontal distance between the points (m).
    spacing: f64,
    /// Number of faces.
    faces: usize,
    friction: f64,
}

impl LineProfile {
    /// The profile of a grid for a line of an unstretched length or a distance of its ends (m) that comes to its anchor (m, global) in a
    /// direction, with a friction coefficient.
    pub fn new(grid: &Arc<Bathymetry>, anchor: [f64; 2], azimuth: [f64; 2], length: f64, friction: f64) -> LineProfile {
        let reach = PROFILE_REACH_RATIO * length;
        let finest = grid.finest_spacing() / FACES_PER_CELL;
        let faces = (reach / finest).ceil().clamp(1.0, MAX_FACES);
        LineProfile { grid: grid.clone(), anchor, azimuth, spacing: reach / faces, faces: faces as usize, friction }
    }

    /// The spacing of its points over the smallest of the grid: above one, the profile steps over depths of the grid.
    pub fn coarseness(&self) -> f64 {
        self.spacing / self.grid.finest_spacing()
    }

    /// The line on the profile.
    ///
    /// # Errors
    /// An anchor below the bottom; depths that are not finite.
    pub fn lay(&self, line: Line) -> Result<Line, LineError> {
        let ([x, y], [ux, uy]) = (self.anchor, self.azimuth);
        let position = |face: usize| {
            let from_anchor = face as f64 * self.spacing;
            (from_anchor, self.grid.elevation_and_slopes(x - from_anchor * ux, y - from_anchor * uy).0)
        };
        let positions: Vec<(f64, f64)> = (0..=self.faces).map(position).collect();
        line.over_profile(&positions, self.friction)
    }

    /// Direction from the fairlead to the anchor: a unit vector on the plan.
    pub fn azimuth(&self) -> [f64; 2] {
        self.azimuth
    }

    /// The profile in another direction from the fairlead to the anchor.
    pub fn with_azimuth(&self, azimuth: [f64; 2]) -> LineProfile {
        LineProfile { azimuth, ..self.clone() }
    }

    /// The same profile with another friction coefficient.
    pub fn with_friction(&self, friction: f64) -> LineProfile {
        LineProfile { friction, ..self.clone() }
    }
}
