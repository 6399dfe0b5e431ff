//! What can be wrong with a problem.

use thiserror::Error;

/// Why a problem has no answer.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DiffractionError {
    /// A mesh without panels.
    #[error("the mesh has no panels")]
    NoPanels,
    /// A panel without area.
    #[error("panel {0} has no area")]
    FlatPanel(usize),
    /// A coordinate that is not finite.
    #[error("panel {0} has a coordinate that is not finite")]
    NotFinite(usize),
    /// A panel that rises above the water.
    #[error("panel {panel} rises {height:.4} m above the mean water level; cut the mesh there")]
    AboveWater {
        /// Its number, from 1.
        panel: usize,
        /// By how much (m).
        height: f64,
    },
    /// A panel of a half or quarter mesh on the wrong side of a mirror plane.
    #[error("panel {0} lies on the far side of a mirror plane")]
    BeyondMirror(usize),
    /// A frequency that is not above zero, or not finite.
    #[error("the frequency is {0} rad/s, and has to be above zero")]
    Frequency(f64),
    /// Density or gravity that is not above zero.
    #[error("density and gravity have to be above zero")]
    Water,
    /// A bottom that is not below the hull.
    #[error("the water is {depth} m deep, and the hull reaches down to {draught:.4} m")]
    Depth {
        /// Depth (m).
        depth: f64,
        /// Draught (m).
        draught: f64,
    },
    /// A mesh whose normals point into the hull.
    #[error("the panels of body {0} face inward: give their corners the other way round")]
    InsideOut(usize),
    /// A mesh with a gap below the water.
    #[error(
        "the mesh of body {body} is open below the water: by the x, y and z components of its normals it displaces {:.4}, {:.4} and {:.4} m3",
        volumes[0],
        volumes[1],
        volumes[2]
    )]
    OpenMesh {
        /// Its number, from 1.
        body: usize,
        /// Displaced volume by x, y and z (m3).
        volumes: [f64; 3],
    },
    /// A body within another.
    #[error("body {first} reaches into body {second}, or touches it, at x {:.3}, y {:.3}, z {:.3} m", at[0], at[1], at[2])]
    Overlap {
        /// Its number, from 1.
        first: usize,
        /// That of the other.
        second: usize,
        /// Where (m).
        at: [f64; 3],
    },
    /// A damping of a patch of the surface that is below zero, or not finite.
    #[error("the damping {epsilon} of lid {patch} has to be zero or more")]
    PatchDamping {
        /// The number of the patch, from 1.
        patch: usize,
        /// Its damping.
        epsilon: f64,
    },
    /// A patch of the surface without area.
    #[error("lid {0} has no area")]
    FlatPatch(usize),
    /// A patch that is not on the part of the surface that is solved for.
    #[error("lid {patch} is not at the mean water level, or beyond a mirror plane, at x {:.3}, y {:.3}, z {:.3} m", at[0], at[1], at[2])]
    PatchPlace {
        /// The number of the patch, from 1.
        patch: usize,
        /// Where (m).
        at: [f64; 3],
    },
    /// A patch that reaches into a hull.
    #[error("lid {patch} reaches into body {body} at x {:.3}, y {:.3} m: it lies on the water between or within hulls", at[0], at[1])]
    PatchInHull {
        /// The number of the patch, from 1.
        patch: usize,
        /// The number of the body, from 1.
        body: usize,
        /// Where (m).
        at: [f64; 2],
    },
    /// A body with other mirror planes than the first.
    #[error("body {0} has other mirror planes than body 1: all bodies have the same, or none")]
    OtherMirrors(usize),
    /// An origin beside the mirror planes.
    #[error("the origin of body {0} is not on the mirror planes")]
    OriginOffMirror(usize),
    /// A system of equations without a solution in numbers.
    #[error("the system of equations at {0:.6} rad/s has no solution that is finite")]
    NoSolution(f64),
    /// Matrices of another size than the motions.
    #[error("mass, stiffness and damping have to be matrices of {0} rows and columns")]
    MatrixSize(usize),
    /// Equations of motion without a solution.
    #[error(
        "the equations of motion at {0:.6} rad/s have no solution that is finite: a motion is without mass and stiffness"
    )]
    NoMotions(f64),
    /// The zero frequency in finite depth.
    #[error("the added mass of heave at zero frequency has no limit in water {0} m deep; take a low frequency")]
    ZeroFrequency(f64),
    /// Equations of a limit without a solution in numbers.
    #[error("the system of equations of the added mass at zero or infinite frequency has no solution that is finite")]
    NoLimit,
    /// Wave drift damping in finite depth.
    #[error("wave drift damping is for deep water, the water is {0} m deep")]
    DriftDampingDepth(f64),
    /// Motions of another number than six a body, or not for each heading.
    #[error("motions have to be six a body for each heading")]
    MotionCount,
    /// The user interrupted.
    #[error("interrupted")]
    Interrupted,
}
