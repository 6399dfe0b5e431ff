//! Union, intersection and difference of closed surfaces.
//!
//! The triangles of both are cut along their common lines and those of the result are kept, by the algorithm of the library Manifold
//! ([MANIFOLD-3], crate `manifold-rust`): faces that lie in one plane are decided by symbolic perturbation, so that boxes that share a face join
//! without a crack, and the result is a closed surface again. The polyhedra are exact to rounding; a round form is as round as its panels.

use super::{Fault, Surface};
use manifold_rust::manifold::Manifold;
use manifold_rust::types::{BooleanEngine, Error, MeshGL64, OpType};
use nalgebra::Vector3;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// How two solids are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Combination {
    /// What is in either.
    Union,
    /// What is in both.
    Intersection,
    /// What is in the first and not in the second.
    Difference,
}

/// Why two surfaces were not combined.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CombinationError {
    /// One of them does not bound a volume: 0 the first, 1 the second.
    #[error("a surface does not bound a volume: {fault}")]
    NotSolid {
        /// Which.
        which: usize,
        /// What is wrong with it.
        fault: Fault,
    },
    /// Nothing is left.
    #[error("nothing is left")]
    Empty,
    /// The search for the common lines failed.
    #[error("the surfaces cannot be combined: {0}")]
    Failed(String),
}

impl Surface {
    /// What is in both, in either, or in this one alone.
    ///
    /// # Errors
    /// A surface with faults ([`Surface::faults`]), a result without volume, a failure of the library.
    pub fn combined(&self, other: &Surface, how: Combination) -> Result<Surface, CombinationError> {
        for (which, surface) in [self, other].into_iter().enumerate() {
            if let Some(fault) = surface.faults().into_iter().next() {
                return Err(CombinationError::NotSolid { which, fault });
            }
        }
        let how = match how {
            Combination::Union => OpType::Add,
            Combination::Intersection => OpType::Intersect,
            Combination::Difference => OpType::Subtract,
        };
        // a defect of the library is an error of this record, not the end of the program
        let made = catch_unwind(AssertUnwindSafe(|| {
            let first = solid_of(self);
            first.boolean_with_engine(&solid_of(other), how, BooleanEngine::Exact)
        }));
        let made = made.map_err(|_| CombinationError::Failed("internal error in the cut of their faces".into()))?;
        match made.status() {
            Error::NoError if made.num_tri() == 0 => Err(CombinationError::Empty),
            Error::NoError => surface_of(&made),
            status => Err(CombinationError::Failed(format!("{status:?}"))),
        }
    }
}

fn solid_of(surface: &Surface) -> Manifold {
    Manifold::from_mesh_gl64(&MeshGL64 {
        num_prop: 3,
        vert_properties: surface.vertices.iter().flat_map(|v| [v.x, v.y, v.z]).collect(),
        tri_verts: surface.faces.iter().flatten().map(|n| u64::from(*n)).collect(),
        ..MeshGL64::default()
    })
}

fn surface_of(solid: &Manifold) -> Result<Surface, CombinationError> {
    let mesh = solid.get_mesh_gl64(-1);
    let width = usize::try_from(mesh.num_prop).unwrap_or(0).max(3);
    let vertices = mesh.vert_properties.chunks_exact(width).map(|v| Vector3::new(v[0], v[1], v[2])).collect();
    let corner = |n: &u64| u32::try_from(*n).map_err(|_| CombinationError::Failed("too many vertices".into()));
    let faces = mesh.tri_verts.chunks_exact(3).map(|t| Ok([corner(&t[0])?, corner(&t[1])?, corner(&t[2])?]));
    Ok(Surface { vertices, faces: faces.collect::<Result<_, _>>()? })
}
