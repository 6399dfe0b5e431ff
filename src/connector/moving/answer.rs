//! What the ends of a line are held by, and what they feel of it.

use super::describe::Description;
use crate::model::{ClassError, Connection, Response, Six};
use crate::rod::{EndForces, EndTangent, Twelve};
use nalgebra::{Matrix6, Vector3};

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

/// The directions in which the ends are held, in the axes of their holders as defined.
pub(super) fn holds(
    description: &Description,
    connection: &Connection,
) -> Result<[Option<(Vector3<f64>, Option<f64>)>; 2], ClassError> {
    let [a, b] = connection.connector.defined;
    let b = if connection.to_ground { crate::model::Pose { origin: connection.ends[1].origin, ..b } } else { b };
    let chord = b.origin - a.origin;
    let across = Vector3::new(chord.x, chord.y, 0.0).try_normalize(1e-9).unwrap_or_else(Vector3::x);
    let mut made = [None, None];
    for ((place, hold), pose) in made.iter_mut().zip(&description.holds).zip([a, b]) {
        let Some(hold) = hold else { continue };
        let direction = match hold.declination {
            Some(angle) => across * angle.sin() - Vector3::z() * angle.cos(),
            None => chord.try_normalize(1e-9).ok_or_else(|| {
                ClassError::new("the two ends are at one place: an end that is held has no direction there")
            })?,
        };
        *place = Some((pose.axes.transpose() * direction, hold.stiffness));
    }
    Ok(made)
}
