//! The lid on the waterplane inside of a hull.

use crate::mesh::MirrorPlanes;
use crate::panel::Panel;
use nalgebra::Vector3;

/// Points nearer than this share of a panel's diagonal are one.
const JOIN_SHARE: f64 = 1e-4;

/// Panels of the waterplane inside of a hull, in rings about a point from which its waterline is seen; none where the waterline is not one
/// ring (or one chain between mirror planes), or is not seen.
pub fn close_waterplane(hull: &[Panel], mirrors: MirrorPlanes) -> Option<Vec<Panel>> {
    let chain = waterline(hull)?;
    let (first, last) = (*chain.first()?, *chain.last()?);
    let closed = (first - last).norm() < JOIN_SHARE * (chain.get(1)? - first).norm();
    let centre = match (closed, mirrors.x, mirrors.y) {
        (true, false, false) => chain.iter().skip(1).sum::<Vector3<f64>>() / (chain.len() - 1) as f64,
        (false, true, true) => Vector3::zeros(),
        // the chain ends on the plane
        (false, true, false) | (false, false, true) => (first + last) * 0.5,
        _ => return None,
    };
    let steps: Vec<[Vector3<f64>; 2]> = chain.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let seen = steps.iter().all(|[a, b]| (a - centre).cross(&(b - centre)).z > 0.0);
    let length = steps.iter().map(|[a, b]| (b - a).norm()).sum::<f64>() / steps.len() as f64;
    let radius = chain.iter().map(|point| (point - centre).norm()).sum::<f64>() / chain.len() as f64;
    if !seen || length <= 0.0 {
        return None;
    }
    let rings = ((radius / length).round() as usize).max(1);
    let at = |point: &Vector3<f64>, ring: usize| centre + (point - centre) * (1.0 - ring as f64 / rings as f64);
    (0..rings)
        .flat_map(|ring| steps.iter().map(move |[a, b]| [at(a, ring), at(b, ring), at(b, ring + 1), at(a, ring + 1)]))
        .map(Panel::new)
        .collect()
}

/// The sides of panels at the mean level as one chain of points, counter-clockwise seen from above.
fn waterline(hull: &[Panel]) -> Option<Vec<Vector3<f64>>> {
    let mut sides: Vec<[Vector3<f64>; 2]> = Vec::new();
    for panel in hull {
        let corners = panel.corners();
        let room = JOIN_SHARE * panel.diagonal;
        for i in 0..corners.len() {
            let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
            if a.z.abs() < room && b.z.abs() < room && (a - b).norm() > room {
                // seen from the water the upper side runs clockwise about the hull
                sides.push([Vector3::new(b.x, b.y, 0.0), Vector3::new(a.x, a.y, 0.0)]);
            }
        }
    }
    let room = JOIN_SHARE * hull.iter().map(|panel| panel.diagonal).fold(0.0, f64::max);
    let near = |a: &Vector3<f64>, b: &Vector3<f64>| (a - b).norm() < room;
    // an open chain begins at a point where no side ends
    let begins = (0..sides.len()).find(|i| !sides.iter().any(|side| near(&side[1], &sides[*i][0]))).unwrap_or(0);
    if sides.is_empty() {
        return None;
    }
    let [first, mut end] = sides.swap_remove(begins);
    let mut chain = vec![first, end];
    while !sides.is_empty() {
        let next = sides.iter().position(|side| near(&side[0], &end))?;
        end = sides.swap_remove(next)[1];
        chain.push(end);
    }
    Some(chain)
}
