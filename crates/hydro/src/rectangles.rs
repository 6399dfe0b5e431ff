//! Plane faces of a hull that are made of rectangles, as a bottom around a moonpool or a side that a pontoon runs into: cut along their corners instead of into the
//! slender triangles that combinations of pieces leave.

use crate::hull::{Surface, pair_triangles};
use crate::wetted_hull::Polygon;
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};

/// Sine of the angle up to which triangles are in one plane, and sides along one direction.
const SAME_DIRECTION: f64 = 1e-6;
/// Levels nearer than this share of the size of a face are one.
const SAME_LEVEL_SHARE: f64 = 1e-7;

/// The faces of a closed surface: parallelograms, rectangles of what is made of them, and the triangles that are left.
pub fn faces(surface: &Surface) -> Vec<Polygon> {
    let (parallelograms, triangles) = pair_triangles(surface);
    let corner = |n: &u32| surface.vertices.get(*n as usize).copied();
    let groups = Groups::new(surface);
    let cut: BTreeMap<usize, Vec<Polygon>> = triangles
        .iter()
        .filter_map(|[a, b, _]| groups.of_edge.get(&(*a, *b)).copied())
        .collect::<BTreeSet<usize>>()
        .into_iter()
        .filter_map(|group| Some((group, groups.rectangles(surface, group)?)))
        .collect();
    let stays = |a: u32, b: u32| groups.of_edge.get(&(a, b)).is_none_or(|group| !cut.contains_key(group));
    let whole = parallelograms.iter().filter(|f| stays(f[0], f[1])).map(|f| f.iter().filter_map(corner).collect());
    let left = triangles.iter().filter(|f| stays(f[0], f[1])).map(|f| f.iter().filter_map(corner).collect());
    whole.chain(left).chain(cut.values().flatten().cloned()).collect()
}

/// Triangles that lie in one plane and hang together.
struct Groups {
    /// Of each side of a triangle, from corner to corner: its group.
    of_edge: BTreeMap<(u32, u32), usize>,
    /// Of each group the sides of its triangles.
    sides: BTreeMap<usize, Vec<(u32, u32)>>,
}

fn sides([a, b, c]: [u32; 3]) -> [(u32, u32); 3] {
    [(a, b), (b, c), (c, a)]
}

/// Unit normal of a triangle; of one without area zero.
fn normal(surface: &Surface, face: [u32; 3]) -> Vector3<f64> {
    let [a, b, c] = face.map(|n| surface.vertices.get(n as usize).copied().unwrap_or_default());
    (b - a).cross(&(c - a)).try_normalize(0.0).unwrap_or_else(Vector3::zeros)
}

impl Groups {
    fn new(surface: &Surface) -> Self {
        let of_face: BTreeMap<(u32, u32), usize> =
            surface.faces.iter().enumerate().flat_map(|(i, face)| sides(*face).map(|side| (side, i))).collect();
        let normals: Vec<Vector3<f64>> = surface.faces.iter().map(|face| normal(surface, *face)).collect();
        let mut group: Vec<Option<usize>> = vec![None; surface.faces.len()];
        for first in 0..surface.faces.len() {
            let mut open = vec![first];
            while let Some(index) = open.pop() {
                let (Some(own), Some(face)) = (group.get_mut(index), surface.faces.get(index)) else { continue };
                if own.is_some() {
                    continue;
                }
                *own = Some(first);
                // held against the first of the group, so that a smooth hull is no plane
                let is_level = |other: &usize| {
                    normals
                        .get(first)
                        .zip(normals.get(*other))
                        .is_some_and(|(a, b)| a.dot(b) > 0.0 && a.cross(b).norm() < SAME_DIRECTION)
                };
                open.extend(sides(*face).iter().filter_map(|(a, b)| of_face.get(&(*b, *a)).copied()).filter(is_level));
            }
        }
        let mut of_edge = BTreeMap::new();
        let mut of_group: BTreeMap<usize, Vec<(u32, u32)>> = BTreeMap::new();
        for (face, group) in surface.faces.iter().zip(&group) {
            let Some(group) = group else { continue };
            for side in sides(*face) {
                of_edge.insert(side, *group);
                of_group.entry(*group).or_default().push(side);
            }
        }
        Groups { of_edge, sides: of_group }
    }

    /// The rectangles of a group; none where its outline has sides in other than two directions that are square to each other.
    fn rectangles(&self, surface: &Surface, group: usize) -> Option<Vec<Polygon>> {
        let inner = |(a, b): &(u32, u32)| self.of_edge.get(&(*b, *a)) == Some(&group);
        let outline: Vec<[Vector3<f64>; 2]> = self
            .sides
            .get(&group)?
            .iter()
            .filter(|side| !inner(side))
            .map(|(a, b)| Some([*surface.vertices.get(*a as usize)?, *surface.vertices.get(*b as usize)?]))
            .collect::<Option<_>>()?;
        let length = |[a, b]: &[Vector3<f64>; 2]| (b - a).norm();
        let longest = outline.iter().max_by(|a, b| length(a).total_cmp(&length(b)))?;
        let along = (longest[1] - longest[0]).try_normalize(0.0)?;
        let up = normal(surface, *surface.faces.get(group)?).cross(&along);
        let origin = longest[0];
        let room = SAME_LEVEL_SHARE * outline.iter().flatten().map(|at| (at - origin).norm()).fold(0.0, f64::max);
        let flat: Vec<[[f64; 2]; 2]> =
            outline.iter().map(|side| side.map(|at| [(at - origin).dot(&along), (at - origin).dot(&up)])).collect();
        let is_square = |[[a, b], [c, d]]: &[[f64; 2]; 2]| {
            let (x, y) = ((c - a).abs(), (d - b).abs());
            x.min(y) <= SAME_DIRECTION * x.max(y) + room
        };
        if !flat.iter().all(is_square) {
            return None;
        }
        let turned: Vec<[[f64; 2]; 2]> = flat.iter().map(|side| side.map(|[x, y]| [y, x])).collect();
        let (one, other) = (bands(&flat, room)?, bands(&turned, room)?);
        let corner = |x: f64, y: f64| origin + along * x + up * y;
        let made = if one.len() <= other.len() {
            one.iter()
                .map(|[[a, b], [c, d]]| vec![corner(*a, *c), corner(*b, *c), corner(*b, *d), corner(*a, *d)])
                .collect()
        } else {
            other
                .iter()
                .map(|[[c, d], [a, b]]| vec![corner(*a, *c), corner(*b, *c), corner(*b, *d), corner(*a, *d)])
                .collect()
        };
        Some(made)
    }
}

/// Limits of x and of y.
type Rectangle = [[f64; 2]; 2];

/// The rectangles of what is within an outline of sides along x and y, as high as they can be; none of an outline that does not close.
fn bands(outline: &[[[f64; 2]; 2]], room: f64) -> Option<Vec<Rectangle>> {
    let mut levels: Vec<f64> = outline.iter().flatten().map(|at| at[1]).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup_by(|next, kept| *next - *kept <= room);
    let mut done: Vec<Rectangle> = Vec::new();
    let mut open: Vec<Rectangle> = Vec::new();
    for pair in levels.windows(2) {
        let [low, high] = pair else { continue };
        let middle = 0.5 * (low + high);
        let mut crossings: Vec<f64> = outline
            .iter()
            .filter(|[a, b]| (a[1] < middle) != (b[1] < middle))
            .map(|[a, b]| 0.5 * (a[0] + b[0]))
            .collect();
        crossings.sort_by(f64::total_cmp);
        if !crossings.len().is_multiple_of(2) {
            return None;
        }
        let mut next = Vec::new();
        for ends in crossings.chunks_exact(2) {
            let [first, last] = ends else { continue };
            let same = |[[a, b], _]: &Rectangle| (a - first).abs() <= room && (b - last).abs() <= room;
            match open.iter().position(same) {
                Some(at) => {
                    let [x, [from, _]] = open.swap_remove(at);
                    next.push([x, [from, *high]]);
                }
                None => next.push([[*first, *last], [*low, *high]]),
            }
        }
        done.append(&mut open);
        open = next;
    }
    done.append(&mut open);
    Some(done)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hull::Combination;
    use crate::wetted_hull::area_vector;

    fn area(face: &Polygon) -> f64 {
        area_vector(face).norm()
    }

    #[test]
    fn box_with_well_is_cut_into_rectangles() {
        let hull = Surface::block([-20.0, -6.0, -4.0], [20.0, 6.0, 4.0]);
        let well = Surface::block([-4.0, -2.0, -5.0], [4.0, 2.0, 5.0]);
        let made = faces(&hull.combined(&well, Combination::Difference).unwrap());
        // bottom and deck in four each, four sides and four of the well
        assert!(made.len() == 16 && made.iter().all(|face| face.len() == 4), "{made:?}");
        let whole: f64 = made.iter().map(area).sum();
        let exact = 2.0 * (40.0 * 12.0 - 8.0 * 4.0) + 2.0 * (40.0 + 12.0) * 8.0 + 2.0 * (8.0 + 4.0) * 8.0;
        assert!((whole - exact).abs() < 1e-9 * exact, "{whole} for {exact}");
    }

    #[test]
    fn face_with_skew_hole_stays_in_triangles() {
        let hull = Surface::block([-20.0, -6.0, -4.0], [20.0, 6.0, 4.0]);
        let mut well = Surface::block([-4.0, -2.0, -5.0], [4.0, 2.0, 5.0]);
        let (sine, cosine) = 0.3_f64.sin_cos();
        for at in &mut well.vertices {
            *at = Vector3::new(at.x * cosine - at.y * sine, at.x * sine + at.y * cosine, at.z);
        }
        let made = faces(&hull.combined(&well, Combination::Difference).unwrap());
        assert!(made.iter().any(|face| face.len() == 3));
        let whole: f64 = made.iter().map(area).sum();
        let exact = 2.0 * (40.0 * 12.0 - 8.0 * 4.0) + 2.0 * (40.0 + 12.0) * 8.0 + 2.0 * (8.0 + 4.0) * 8.0;
        assert!((whole - exact).abs() < 1e-9 * exact, "{whole} for {exact}");
    }
}
