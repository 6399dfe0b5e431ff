//! What the holders of a line feel of it.

use crate::model::{ClassError, Response, Six};
use crate::rod::{EndForces, EndTangent, OnSupport, SupportTangent, Twelve};
use nalgebra::{Matrix6, Vector3};

/// What a line does to what holds it, and how that changes where it is known.
pub(super) enum On {
    Ends(EndForces, Option<EndTangent>),
    Supports(Vec<OnSupport>, Option<SupportTangent>),
}

/// Wrenches and their changes.
pub(super) fn answer(out: &mut Response, felt: &On, moving: bool) -> Result<(), ClassError> {
    let six = |f: &Vector3<f64>, m: &Vector3<f64>| Six::new(f.x, f.y, f.z, m.x, m.y, m.z);
    match felt {
        On::Ends(forces, tangent) => {
            out.clear(2);
            for (wrench, (force, moment)) in out.wrench.iter_mut().zip(forces.force.iter().zip(&forces.moment)) {
                *wrench = six(force, moment);
            }
            let fill = |blocks: &mut Vec<Matrix6<f64>>, whole: &Twelve| {
                blocks.clear();
                blocks.extend((0..4).map(|index| -whole.fixed_view::<6, 6>(6 * (index / 2), 6 * (index % 2))));
            };
            if let Some(tangent) = tangent {
                fill(&mut out.stiffness, &tangent.position);
                if moving {
                    fill(&mut out.damping, &tangent.velocity);
                    fill(&mut out.inertia, &tangent.acceleration);
                }
            }
        }
        On::Supports(loads, tangent) => {
            out.clear(loads.len());
            for (wrench, load) in out.wrench.iter_mut().zip(loads) {
                *wrench = six(&load.force, &load.moment);
            }
            if let Some(tangent) = tangent {
                out.stiffness.iter_mut().zip(&tangent.position).for_each(|(k, own)| *k = -own);
                out.damping.extend(tangent.velocity.iter().map(|c| -c));
            }
        }
    }
    if out.wrench.iter().any(|w| w.iter().any(|v| !v.is_finite())) {
        return Err(ClassError::new("its force is no number"));
    }
    Ok(())
}
