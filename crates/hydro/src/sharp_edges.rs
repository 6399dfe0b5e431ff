//! The sides of the faces of a hull toward which panels are refined.
//!
//! Round an edge that sticks out into the water the velocity has no bound, and at the waterline the potential has a logarithm: panels of one size are
//! short there.

use crate::wetted_hull::{Polygon, area_vector};
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Faces whose normals are apart by more than this cosine (40 degrees) meet at a sharp edge.
const SMOOTH_COSINE: f64 = 0.766;
/// Where along a side faces beside it are looked for that do not share its ends.
const SHARES: [f64; 3] = [0.2, 0.5, 0.8];

/// Of each side of each face, from a corner to the next, whether it is sharp and sticks out, or is at the waterline; corners within `room` (m) are one.
pub fn sharp_edges(faces: &[Polygon], room: f64) -> Vec<Vec<bool>> {
    let room = room.max(f64::MIN_POSITIVE);
    let plates: Vec<Plate> = faces.iter().map(Plate::new).collect();
    let key = |at: &Vector3<f64>| [0, 1, 2].map(|axis| (at[axis] / (8.0 * room)).round() as i64);
    let mut at_edge: BTreeMap<[[i64; 3]; 2], Vec<usize>> = BTreeMap::new();
    let edge = |a: &Vector3<f64>, b: &Vector3<f64>| {
        let mut ends = [key(a), key(b)];
        ends.sort_unstable();
        ends
    };
    for (index, face) in faces.iter().enumerate() {
        for (a, b) in sides(face) {
            at_edge.entry(edge(a, b)).or_default().push(index);
        }
    }
    let by_low = LowestFirst::new(&plates);
    let of_face = |(index, face): (usize, &Polygon)| {
        let own = plates.get(index);
        sides(face)
            .map(|(a, b)| {
                if a.z.abs() <= room && b.z.abs() <= room {
                    return true;
                }
                let Some(own) = own else { return false };
                let turns = |other: &Plate, at: &Vector3<f64>| {
                    own.normal.dot(&other.normal) < SMOOTH_COSINE && (other.middle - at).dot(&own.normal) < 0.0
                };
                let middle = (a + b) * 0.5;
                let shared = at_edge.get(&edge(a, b)).map_or(&[][..], Vec::as_slice);
                if shared.len() > 1 {
                    let others = shared.iter().filter(|other| **other != index).filter_map(|other| plates.get(*other));
                    return others.into_iter().any(|other| turns(other, &middle));
                }
                SHARES.iter().any(|share| {
                    let at = a + (b - a) * *share;
                    by_low.near(&at, 2.0 * room).any(|other| {
                        other != index
                            && plates.get(other).is_some_and(|plate| turns(plate, &at))
                            && faces.get(other).is_some_and(|face| holds(face, &at, 2.0 * room))
                    })
                })
            })
            .collect()
    };
    faces.iter().enumerate().map(of_face).collect()
}

/// The side of a face that a point is on, within `room` (m).
pub fn edge_at(face: &Polygon, at: &Vector3<f64>, room: f64) -> Option<usize> {
    sides(face).position(|(a, b)| {
        let (along, arm) = (b - a, at - a);
        let share = arm.dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
        (0.0..=1.0).contains(&share) && (arm - along * share).norm() <= room
    })
}

/// The sides of a face: from each corner to the next.
fn sides(face: &Polygon) -> impl Iterator<Item = (&Vector3<f64>, &Vector3<f64>)> {
    face.iter().zip(face.iter().cycle().skip(1))
}

/// Whether a point is on a convex face, within `room` (m).
fn holds(face: &Polygon, at: &Vector3<f64>, room: f64) -> bool {
    let Some(normal) = area_vector(face).try_normalize(0.0) else { return false };
    sides(face).all(|(a, b)| {
        let arm = at - a;
        let inward = normal.cross(&(b - a)).try_normalize(0.0).unwrap_or_else(Vector3::zeros);
        arm.dot(&normal).abs() <= room && arm.dot(&inward) >= -room
    })
}

/// What of a face tells whether another one turns away from it.
struct Plate {
    normal: Vector3<f64>,
    middle: Vector3<f64>,
    /// Limits of x (m).
    limits: [f64; 2],
}

impl Plate {
    fn new(face: &Polygon) -> Self {
        let limits =
            face.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [low.min(p.x), high.max(p.x)]);
        let middle = face.iter().sum::<Vector3<f64>>() / face.len().max(1) as f64;
        Plate { normal: area_vector(face).try_normalize(0.0).unwrap_or_else(Vector3::zeros), middle, limits }
    }
}

/// Faces by their lowest x, so that few are looked at for a point.
struct LowestFirst {
    order: Vec<([f64; 2], usize)>,
    /// The widest along x (m).
    width: f64,
}

impl LowestFirst {
    fn new(plates: &[Plate]) -> Self {
        let mut order: Vec<_> = plates.iter().enumerate().map(|(index, plate)| (plate.limits, index)).collect();
        order.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        let width = plates.iter().map(|plate| plate.limits[1] - plate.limits[0]).fold(0.0, f64::max);
        LowestFirst { order, width }
    }

    /// Faces that have the x of a point, within `room` (m).
    fn near(&self, at: &Vector3<f64>, room: f64) -> impl Iterator<Item = usize> + '_ {
        let (x, first) = (at.x, self.order.partition_point(|(limits, _)| limits[0] < at.x - self.width - room));
        let from_first = self.order.iter().skip(first).take_while(move |(limits, _)| limits[0] <= x + room);
        from_first.filter(move |(limits, _)| limits[1] >= x - room).map(|(_, index)| *index)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_of_a_step_are_sharp_where_it_sticks_out() {
        // a hull that steps down, seen along y: a wall from the water to z = -1, a bottom to x = 2, a wall down to z = -3; water before and below it. The
        // first corner sticks out, the second is drawn in
        let at = |x: f64, z: f64| [Vector3::new(x, 0.0, z), Vector3::new(x, 2.0, z)];
        let line = [at(0.0, 0.0), at(0.0, -1.0), at(2.0, -1.0), at(2.0, -3.0)];
        let face = |[[a, b], [c, d]]: [[Vector3<f64>; 2]; 2]| vec![b, a, c, d];
        let mut faces: Vec<Polygon> = line.windows(2).map(|pair| face([pair[0], pair[1]])).collect();
        if area_vector(&faces[0]).x > 0.0 {
            faces.iter_mut().for_each(|face| face.reverse());
        }
        let normals: Vec<Vector3<f64>> = faces.iter().map(|face| area_vector(face).normalize()).collect();
        assert_eq!(normals, [-Vector3::x(), -Vector3::z(), -Vector3::x()]);
        let found = sharp_edges(&faces, 1e-9);
        let count: Vec<usize> = found.iter().map(|face| face.iter().filter(|is| **is).count()).collect();
        assert_eq!(count, [2, 1, 0]);
    }

    #[test]
    fn edge_is_sharp_where_faces_beside_it_are_divided_otherwise() {
        // a wall of two faces over one floor, by x
        let p = Vector3::new;
        let wall =
            |low: f64, high: f64| vec![p(low, 0.0, -2.0), p(high, 0.0, -2.0), p(high, 0.0, -0.5), p(low, 0.0, -0.5)];
        let floor = vec![p(0.0, 0.0, -2.0), p(0.0, 3.0, -2.0), p(4.0, 3.0, -2.0), p(4.0, 0.0, -2.0)];
        let found = sharp_edges(&[wall(0.0, 1.0), wall(1.0, 4.0), floor], 1e-9);
        assert_eq!(
            found,
            [vec![true, false, false, false], vec![true, false, false, false], vec![false, false, false, true]]
        );
    }
}
