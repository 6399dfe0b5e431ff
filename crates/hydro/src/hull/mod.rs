//! Hydrostatics of solids: the part below the water's surface, its buoyancy and exact stiffness, and meshes that bound it.
//!
//! A [`Surface`] of triangles and a [`TubeHull`] answer what of them is wet in a pose ([`Solid::wet`]); a [`SubmergedVolume`] gives the
//! buoyancy on the body ([`SubmergedVolume::load`]) and its [`Hydrostatics`]. Meshes are read by [`read_mesh`] and examined by
//! [`Surface::faults`] and [`intersect`]. Nothing here knows a record, a class or a body.

mod boxes;
mod combination;
mod cutting;
mod faults;
mod mesh;
mod panelling;
mod panels;
mod state;
mod surface;
mod tube;

pub use combination::{Combination, CombinationError};
pub use faults::{Fault, MAX_REPORTED_FAULTS, intersect};
pub use mesh::{MeshFile, MeshKind, close_above_waterline, read_mesh};
pub(super) use panelling::{Panel, Panelling, pair_triangles};
pub use state::Hydrostatics;
pub use surface::Surface;
pub use tube::TubeHull;

use super::Load;
use nalgebra::{Matrix6, Vector3};
use panels::MAX_POLYGON_CORNERS;
use windlass_base::pose::{Pose, Six};

/// Why a mesh or its file was not taken.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HullError {
    /// A panel that bounds nothing.
    #[error("panel {number}: {why}")]
    Panel {
        /// Its number, from 1.
        number: usize,
        /// What is wrong with it.
        why: PanelError,
    },
    /// A line of a text file.
    #[error("line {number}: {why}")]
    Line {
        /// Its number, from 1.
        number: usize,
        /// What is wrong with it, and what was expected.
        why: String,
    },
    /// A place in a binary file.
    #[error("byte {at}: {why}")]
    Byte {
        /// Bytes before it.
        at: usize,
        /// What is wrong there.
        why: String,
    },
}

/// What is wrong with a panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PanelError {
    /// A coordinate that is infinite or no number.
    #[error("a coordinate is not a finite number")]
    NotFinite,
    /// Fewer than three corners that differ: so many.
    #[error("{0} corners that differ; a panel has three or more")]
    FewCorners(usize),
    /// Not convex, with more corners than are cut into triangles: so many.
    #[error("not convex, with {0} corners; at most {MAX_POLYGON_CORNERS} are cut")]
    ManyCorners(usize),
    /// Edges that cross.
    #[error("its edges cross each other")]
    Crossing,
}

/// What is below the water's surface. Moments are taken about the origin of the pose, along global axes: x, y, z below are
/// global coordinates less those of the pose's origin, so that a body far from the global origin loses no digits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SubmergedVolume {
    /// Displaced volume (m3).
    pub volume: f64,
    /// Integral of (x, y, z) over the displaced volume (m4), about the pose's origin.
    pub moment: Vector3<f64>,
    /// Area of the waterplane (m2).
    pub plane_area: f64,
    /// Integrals of x and y over the waterplane (m3), about the pose's origin.
    pub plane_moment: [f64; 2],
    /// Integrals of xx, xy, yy over the waterplane (m4), about the pose's origin.
    pub plane_second: [f64; 3],
    /// Area of the skin below the water's surface (m2).
    pub wetted_area: f64,
}

/// A solid of which a part may be below the water's surface.
pub trait Solid {
    /// The part of it below z = `level` (m, global) in a pose.
    fn wet(&self, pose: &Pose, level: f64) -> SubmergedVolume;
}

impl SubmergedVolume {
    /// Adds another times a factor: a permeability, or -1 for what is not part of the solid. Both are of one pose. The
    /// wetted area takes the factor too: the skin of what is taken away is not skin of the body.
    pub fn add(&mut self, other: &SubmergedVolume, factor: f64) {
        self.volume += factor * other.volume;
        self.moment += factor * other.moment;
        self.plane_area += factor * other.plane_area;
        for (sum, value) in self.plane_moment.iter_mut().zip(other.plane_moment) {
            *sum += factor * value;
        }
        for (sum, value) in self.plane_second.iter_mut().zip(other.plane_second) {
            *sum += factor * value;
        }
        self.wetted_area += factor * other.wetted_area;
    }

    /// Buoyancy in water of a weight (N/m3), about the pose's origin in global axes, and -d(buoyancy)/d(motion).
    ///
    /// For a small motion of the body v = d + t x r, where r is from its origin: the displaced volume changes by
    /// -int v_z dA over the waterplane, and its moment by int v dV - int r v_z dA (Reynolds' transport theorem on the part
    /// of the solid below a level that stays). That is exact; it is what is left of hydrostatic pressure without the
    /// weight, so the block of roll and pitch holds gamma (I + V KB) and not GM.
    pub fn load(&self, water_weight: f64) -> Load {
        let [sx, sy] = self.plane_moment;
        let [xx, xy, yy] = self.plane_second;
        let [x, y, z] = self.moment.into();
        let wrench = Six::new(0.0, 0.0, self.volume, y, -x, 0.0) * water_weight;
        #[rustfmt::skip]
        let stiffness = Matrix6::new(
            0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
            0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
            0.0, 0.0, self.plane_area, sy, -sx, 0.0,
            0.0, 0.0, sy, z + yy, -xy, -x,
            0.0, 0.0, -sx, -xy, z + xx, -y,
            0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
        ) * water_weight;
        Load { wrench, stiffness }
    }
}
