//! What the holders of a line feel of it.

use crate::model::{ClassError, Response, Six};
use crate::rod::{EndForces, EndTangent, Twelve};
use nalgebra::Matrix6;

/// Wrenches and their changes.
pub(super) fn answer(
    out: &mut Response,
    forces: &EndForces,
    tangent: Option<&EndTangent>,
    moving: bool,
) -> Result<(), ClassError> {
    out.clear(2);
    for (wrench, (force, moment)) in out.wrench.iter_mut().zip(forces.force.iter().zip(&forces.moment)) {
        *wrench = Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
    }
    if out.wrench.iter().any(|w| w.iter().any(|v| !v.is_finite())) {
        return Err(ClassError::new("its force is no number"));
    }
    let Some(tangent) = tangent else { return Ok(()) };
    let fill = |blocks: &mut Vec<Matrix6<f64>>, whole: &Twelve| {
        blocks.clear();
        blocks.extend((0..4).map(|index| -whole.fixed_view::<6, 6>(6 * (index / 2), 6 * (index % 2))));
    };
    fill(&mut out.stiffness, &tangent.position);
    if moving {
        fill(&mut out.damping, &tangent.velocity);
        fill(&mut out.inertia, &tangent.acceleration);
    }
    Ok(())
}
