//! Panels of six nodes, small enough for the waves, on a closed surface of triangles.
//!
//! A rectangle or parallelogram, two triangles that share their longest edge, is divided in cells whose diagonals point to its middle; other
//! triangles have their long edges halved. The division of a mirrored surface is therefore the mirrored division, and a pressure that is
//! symmetric gives a force that is symmetric to rounding. Neighbours on an edge may be divided otherwise: panels are plane parts of the surface's
//! triangles and cover it, which is all that the integral of a pressure needs.

use super::Surface;
use nalgebra::Vector3;
use std::collections::BTreeMap;
use std::f64::consts::SQRT_2;

/// A triangle's corners a, b, c and the middles of its edges ab, bc, ca.
pub type Panel = [u32; 6];

/// A closed surface of panels, body coordinates (m), normals outward.
#[derive(Clone, Debug, Default)]
pub struct Panelling {
    /// Corners and middles (m).
    pub nodes: Vec<Vector3<f64>>,
    /// The panels.
    pub panels: Vec<Panel>,
}

/// Lengths that differ by less than this share of themselves are equal: they come from coordinates with the errors of rounding.
const EQUAL_LENGTHS_SHARE: f64 = 1e-9;

/// The nodes made so far, and the middle of each edge that has one.
struct PanelNodes {
    at: Vec<Vector3<f64>>,
    middles: BTreeMap<(u32, u32), u32>,
    /// The nodes within an edge of a parallelogram, by its ends and the number of its parts.
    rows: BTreeMap<(u32, u32, usize), Vec<u32>>,
}

impl PanelNodes {
    fn position(&self, node: u32) -> Vector3<f64> {
        self.at[node as usize]
    }

    fn add(&mut self, position: Vector3<f64>) -> u32 {
        self.at.push(position);
        (self.at.len() - 1) as u32
    }

    fn length(&self, p: u32, q: u32) -> f64 {
        (self.position(q) - self.position(p)).norm()
    }

    fn middle(&mut self, p: u32, q: u32) -> u32 {
        let key = (p.min(q), p.max(q));
        if let Some(known) = self.middles.get(&key) {
            return *known;
        }
        let made = self.add((self.position(p) + self.position(q)) * 0.5);
        self.middles.insert(key, made);
        made
    }

    /// The nodes from p to q, both ends among them, in a number of equal parts.
    fn divide_edge(&mut self, p: u32, q: u32, parts: usize) -> Vec<u32> {
        let key = (p.min(q), p.max(q));
        let (from, to) = (self.position(key.0), self.position(key.1));
        if !self.rows.contains_key(&(key.0, key.1, parts)) {
            let inner = (1..parts).map(|i| self.add(from + (to - from) * (i as f64 / parts as f64))).collect();
            self.rows.insert((key.0, key.1, parts), inner);
        }
        let mut row = vec![p];
        if let Some(inner) = self.rows.get(&(key.0, key.1, parts)) {
            if p < q { row.extend(inner) } else { row.extend(inner.iter().rev()) }
        }
        row.push(q);
        row
    }
}

impl Panelling {
    /// That of a surface, with corners no farther from each other than a length (m), or than makes about `most` panels.
    pub fn new(surface: &Surface, longest: f64, most: usize) -> Self {
        let area: f64 = (0..surface.faces.len())
            .filter_map(|n| surface.corners(n))
            .map(|[a, b, c]| 0.5 * (b - a).cross(&(c - a)).norm())
            .sum();
        // halved edges leave triangles of at least an eighth of the square of the longest one
        let longest = longest.max((8.0 * area / most.max(1) as f64).sqrt());
        // so that the corners of a cell are no farther from each other either
        let side = longest / 2f64.sqrt();
        let mut nodes = PanelNodes { at: surface.vertices.clone(), middles: BTreeMap::new(), rows: BTreeMap::new() };
        let (parallelograms, mut triangles) = pair_triangles(surface);
        let mut done = Vec::new();
        for corners in parallelograms {
            divide_parallelogram(&mut nodes, corners, side, &mut done);
        }
        while !triangles.is_empty() {
            let mut finer = Vec::new();
            for triangle in triangles {
                match divide_triangle(&mut nodes, triangle, side) {
                    Some(parts) => finer.extend(parts),
                    None => done.push(triangle),
                }
            }
            triangles = finer;
        }
        let panel = |[a, b, c]: [u32; 3]| [a, b, c, nodes.middle(a, b), nodes.middle(b, c), nodes.middle(c, a)];
        let panels = done.into_iter().map(panel).collect();
        Panelling { nodes: nodes.at, panels }
    }
}

impl Panelling {
    /// Divides panels in four until none has an edge longer than a limit (m) that depends on its corners; where that makes more than
    /// `most`, all limits are longer by the same factor.
    pub fn refine(&self, limit: &dyn Fn(&[Vector3<f64>; 3]) -> f64, most: usize) -> Self {
        let mut factor = 1.0;
        loop {
            // panels that are not divided are as many as there are
            if let Some(made) = self.try_refine(&|corners| factor * limit(corners), most.max(self.panels.len())) {
                return made;
            }
            factor *= SQRT_2;
        }
    }

    /// The same with these limits; `None` where they make more than `most`.
    fn try_refine(&self, limit: &dyn Fn(&[Vector3<f64>; 3]) -> f64, most: usize) -> Option<Self> {
        let mut nodes = PanelNodes { at: self.nodes.clone(), middles: BTreeMap::new(), rows: BTreeMap::new() };
        for [a, b, c, x, y, z] in &self.panels {
            for (p, q, middle) in [(a, b, x), (b, c, y), (c, a, z)] {
                nodes.middles.insert((*p.min(q), *p.max(q)), *middle);
            }
        }
        let (mut open, mut panels) = (self.panels.clone(), Vec::new());
        while let Some([a, b, c, x, y, z]) = open.pop() {
            let corners = [a, b, c].map(|n| nodes.position(n));
            let longest = nodes.length(a, b).max(nodes.length(b, c)).max(nodes.length(c, a));
            if longest <= limit(&corners) {
                panels.push([a, b, c, x, y, z]);
                continue;
            }
            // three more than the one that is divided
            if panels.len() + open.len() + 4 > most {
                return None;
            }
            for [p, q, r] in [[a, x, z], [x, b, y], [z, y, c], [x, y, z]] {
                open.push([p, q, r, nodes.middle(p, q), nodes.middle(q, r), nodes.middle(r, p)]);
            }
        }
        Some(Panelling { nodes: nodes.at, panels })
    }
}

/// The parallelograms of a surface, corners in turn, and the triangles that are left.
pub fn pair_triangles(surface: &Surface) -> (Vec<[u32; 4]>, Vec<[u32; 3]>) {
    let position = |n: u32| surface.vertices[n as usize];
    let length = |p: u32, q: u32| (position(q) - position(p)).norm();
    // each face turned so that its longest edge, where there is one, comes first
    let turned = |[a, b, c]: [u32; 3]| {
        let turns = [[a, b, c], [b, c, a], [c, a, b]];
        turns.into_iter().find(|[p, q, r]| {
            let long = length(*p, *q) * (1.0 - EQUAL_LENGTHS_SHARE);
            long > length(*q, *r) && long > length(*r, *p)
        })
    };
    let mut open: BTreeMap<(u32, u32), (usize, u32)> = BTreeMap::new();
    let mut taken = vec![false; surface.faces.len()];
    let mut parallelograms = Vec::new();
    for (index, face) in surface.faces.iter().enumerate() {
        let Some([p, q, r]) = turned(*face) else { continue };
        if let Some((other, s)) = open.remove(&(q, p)) {
            let gap = (position(r) + position(s) - position(p) - position(q)).norm();
            if gap <= EQUAL_LENGTHS_SHARE * length(p, q) {
                parallelograms.push([p, s, q, r]);
                for n in [index, other] {
                    if let Some(mark) = taken.get_mut(n) {
                        *mark = true;
                    }
                }
            }
        } else {
            open.insert((p, q), (index, r));
        }
    }
    let left = surface.faces.iter().zip(&taken).filter(|(_, taken)| !**taken).map(|(face, _)| *face).collect();
    (parallelograms, left)
}

/// Cells of a parallelogram, two triangles each: their diagonals point to its middle, so that they are the same seen from each of its sides.
/// A cell halfway along a side is four triangles about its own middle.
fn divide_parallelogram(nodes: &mut PanelNodes, [a, b, c, d]: [u32; 4], side: f64, done: &mut Vec<[u32; 3]>) {
    let parts = |length: f64| (length * (1.0 - EQUAL_LENGTHS_SHARE) / side).ceil().max(1.0) as usize;
    let (columns, rows) = (parts(nodes.length(a, b)), parts(nodes.length(a, d)));
    let (low, high) = (nodes.divide_edge(a, b, columns), nodes.divide_edge(d, c, columns));
    let (left, right) = (nodes.divide_edge(a, d, rows), nodes.divide_edge(b, c, rows));
    let (origin, along, up) =
        (nodes.position(a), nodes.position(b) - nodes.position(a), nodes.position(d) - nodes.position(a));
    let mut lines = vec![low];
    for j in 1..rows {
        let mut line = vec![left[j]];
        for i in 1..columns {
            line.push(nodes.add(origin + along * (i as f64 / columns as f64) + up * (j as f64 / rows as f64)));
        }
        line.push(right[j]);
        lines.push(line);
    }
    lines.push(high);
    for (j, pair) in lines.windows(2).enumerate() {
        let [below, above] = pair else { continue };
        for (i, (lower, upper)) in below.windows(2).zip(above.windows(2)).enumerate() {
            let ([p, q], [s, r]) = (lower, upper) else { continue };
            let (p, q, r, s) = (*p, *q, *r, *s);
            if 2 * i + 1 == columns || 2 * j + 1 == rows {
                let middle = nodes.add((nodes.position(p) + nodes.position(r)) * 0.5);
                done.extend([[p, q, middle], [q, r, middle], [r, s, middle], [s, p, middle]]);
            } else if (2 * i < columns) == (2 * j < rows) {
                done.extend([[p, q, r], [p, r, s]]);
            } else {
                done.extend([[p, q, s], [q, r, s]]);
            }
        }
    }
}

/// The parts of a triangle whose edges longer than a length are halved; `None` where none is.
fn divide_triangle(nodes: &mut PanelNodes, [a, b, c]: [u32; 3], longest: f64) -> Option<Vec<[u32; 3]>> {
    let mut half = |p: u32, q: u32| (nodes.length(p, q) > longest).then(|| nodes.middle(p, q));
    // turned so that what is halved comes first
    let ([a, b, c], halves) = match [half(a, b), half(b, c), half(c, a)] {
        [None, y @ Some(_), z] => ([b, c, a], [y, z, None]),
        [None, None, z @ Some(_)] => ([c, a, b], [z, None, None]),
        [x @ Some(_), None, z @ Some(_)] => ([c, a, b], [z, x, None]),
        halves => ([a, b, c], halves),
    };
    Some(match halves {
        [Some(x), None, _] => vec![[a, x, c], [x, b, c]],
        [Some(x), Some(y), Some(z)] => vec![[a, x, z], [x, b, y], [z, y, c], [x, y, z]],
        [Some(x), Some(y), None] => {
            // what is left of it has the corners a, x, y, c: cut along the shorter diagonal, and where they are equal along both
            let (one, other) = (nodes.length(a, y), nodes.length(x, c));
            let mut parts = vec![[x, b, y]];
            if (one - other).abs() <= EQUAL_LENGTHS_SHARE * one {
                let middle =
                    nodes.add((nodes.position(a) + nodes.position(x) + nodes.position(y) + nodes.position(c)) * 0.25);
                parts.extend([[a, x, middle], [x, y, middle], [y, c, middle], [c, a, middle]]);
            } else if one < other {
                parts.extend([[a, x, y], [a, y, c]]);
            } else {
                parts.extend([[a, x, c], [x, y, c]]);
            }
            parts
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume by the divergence theorem over the four triangles of each panel.
    fn volume(made: &Panelling) -> f64 {
        let at = |n: u32| made.nodes[n as usize];
        let part = |[a, b, c]: [u32; 3]| at(a).dot(&at(b).cross(&at(c))) / 6.0;
        let quarters = |&[a, b, c, x, y, z]: &Panel| [[a, x, z], [x, b, y], [z, y, c], [x, y, z]];
        made.panels.iter().flat_map(quarters).map(part).sum()
    }

    #[test]
    fn panels_cover_surface_and_are_small() {
        let block = Surface::block([-45.0, 22.5, -21.0], [45.0, 37.5, -12.0]);
        // a wedge: its sides are rectangles, its ends triangles
        let wedge = Surface {
            vertices: [
                [0.0, -6.0, 0.0],
                [0.0, 6.0, 0.0],
                [0.0, 0.0, -8.0],
                [40.0, -6.0, 0.0],
                [40.0, 6.0, 0.0],
                [40.0, 0.0, -8.0],
            ]
            .map(Vector3::from)
            .to_vec(),
            faces: vec![[0, 1, 2], [3, 5, 4], [0, 3, 4], [0, 4, 1], [1, 4, 5], [1, 5, 2], [2, 5, 3], [2, 3, 0]],
        };
        for (surface, exact) in [(block, 90.0 * 15.0 * 9.0), (wedge, 0.5 * 12.0 * 8.0 * 40.0)] {
            for longest in [3.0, 7.0, 1e3] {
                let made = Panelling::new(&surface, longest, 1_000_000);
                assert!((volume(&made).abs() / exact - 1.0).abs() < 1e-12);
                let mut whole = Vector3::zeros();
                for [a, b, c, ..] in &made.panels {
                    let [a, b, c] = [a, b, c].map(|n| made.nodes[*n as usize]);
                    whole += (b - a).cross(&(c - a));
                    let edge = (b - a).norm().max((c - b).norm()).max((a - c).norm());
                    assert!(edge <= longest * (1.0 + 1e-9));
                }
                assert!(whole.norm() < 1e-10, "the areas of a closed surface add up to nothing");
            }
        }
    }

    #[test]
    fn panels_of_mirrored_surface_are_mirrored() {
        let block = Surface::block([-30.0, -10.0, -8.0], [30.0, 10.0, 6.0]);
        for longest in [2.7, 11.0] {
            let made = Panelling::new(&block, longest, 1_000_000);
            let key = |p: &Panel, sign: f64| {
                let mut corners: Vec<[i64; 3]> = p[..3]
                    .iter()
                    .map(|n| {
                        let at = made.nodes[*n as usize];
                        [at.x, sign * at.y, at.z].map(|x| (x * 1e6).round() as i64)
                    })
                    .collect();
                corners.sort_unstable();
                corners
            };
            let all = |sign: f64| made.panels.iter().map(|p| key(p, sign)).collect::<std::collections::BTreeSet<_>>();
            assert_eq!(all(1.0), all(-1.0));
        }
    }
}
