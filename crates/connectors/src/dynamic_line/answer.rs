//! What the holders of a line feel of it.

use nalgebra::{Matrix6, Vector3};
use windlass_base::pose::Six;
use windlass_line_dynamics::{EndTangent, Matrix12, RodEndForces, SupportForce, SupportTangent};
use windlass_model::{ClassError, ConnectorResponse};

fn six(force: &Vector3<f64>, moment: &Vector3<f64>) -> Six {
    Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

/// Wrenches on the two ends, and their changes where they are known: by rates and accelerations where it is `moving`.
pub(super) fn on_ends(
    out: &mut ConnectorResponse,
    forces: &RodEndForces,
    tangent: Option<&EndTangent>,
    moving: bool,
) -> Result<(), ClassError> {
    out.clear(2);
    for (wrench, (force, moment)) in out.wrench.iter_mut().zip(forces.force.iter().zip(&forces.moment)) {
        *wrench = six(force, moment);
    }
    let fill = |blocks: &mut Vec<Matrix6<f64>>, whole: &Matrix12| {
        blocks.clear();
        // nalgebra goes through a view value by value, with its strides
        let block = |index: usize| Matrix6::from_fn(|i, j| -whole[(6 * (index / 2) + i, 6 * (index % 2) + j)]);
        blocks.extend((0..4).map(block));
    };
    if let Some(tangent) = tangent {
        fill(&mut out.stiffness, &tangent.position);
        if moving {
            fill(&mut out.damping, &tangent.velocity);
            fill(&mut out.inertia, &tangent.acceleration);
        }
    }
    finite(out)
}

/// Wrenches on the supports of a pipe, and their changes where they are known.
pub(super) fn on_supports(
    out: &mut ConnectorResponse,
    loads: &[SupportForce],
    tangent: Option<&SupportTangent>,
) -> Result<(), ClassError> {
    out.clear(loads.len());
    for (wrench, load) in out.wrench.iter_mut().zip(loads) {
        *wrench = six(&load.force, &load.moment);
    }
    if let Some(tangent) = tangent {
        out.stiffness.iter_mut().zip(&tangent.position).for_each(|(k, own)| *k = -own);
        out.damping.extend(tangent.velocity.iter().map(|c| -c));
    }
    finite(out)
}

fn finite(out: &ConnectorResponse) -> Result<(), ClassError> {
    if out.wrench.iter().any(|w| w.iter().any(|v| !v.is_finite())) {
        return Err(ClassError::new("its force is not finite"));
    }
    Ok(())
}
