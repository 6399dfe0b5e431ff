//! What is wrong with a surface that should be closed, and whether two of them share room.

use super::Surface;
use super::boxes::Boxes;
use super::cutting::intersect_triangles;
use nalgebra::Vector3;
use std::fmt;

/// Pairs of faces that cut each other, and parts that are inside out, are reported up to this number.
pub const MAX_REPORTED_FAULTS: usize = 20;

/// Faces closer than this part of the size of the mesh touch and do not cut (files often keep seven digits).
const TOUCHING_DISTANCE_SHARE: f64 = 1e-7;

/// Faces asked at most whether they are inside another surface.
const MAX_CHECKED_FACES: usize = 64;

/// A fault of a surface; places in body coordinates (m), faces counted from 0.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// An edge with a face on one side only: the surface has a hole there.
    Open {
        /// The edge's ends.
        edge: [[f64; 3]; 2],
    },
    /// An edge of three faces or more.
    Crowded {
        /// The edge's ends.
        edge: [[f64; 3]; 2],
        /// How many.
        faces: usize,
    },
    /// An edge whose two faces have their normals to different sides.
    Turned {
        /// The edge's ends.
        edge: [[f64; 3]; 2],
    },
    /// A closed part whose normals point inward, though it is no hollow of another.
    InsideOut {
        /// Its volume (m3), negative.
        volume: f64,
        /// A corner of it.
        at: [f64; 3],
    },
    /// Two faces that cut each other; the first [`MAX_REPORTED_FAULTS`] are reported.
    Cut {
        /// The faces.
        faces: [usize; 2],
        /// A common point.
        at: [f64; 3],
    },
    /// A face without area, or which names a vertex that is not there.
    Degenerate {
        /// The face.
        face: usize,
        /// Its first corner.
        at: [f64; 3],
    },
}

fn position(at: &[f64; 3]) -> String {
    let [x, y, z] = at;
    format!("({x:.3} {y:.3} {z:.3})")
}

impl fmt::Display for Fault {
    /// In metres.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::Open { edge: [a, b] } => {
                write!(f, "the edge from {} to {} has a face on one side only", position(a), position(b))
            }
            Fault::Crowded { edge: [a, b], faces } => {
                write!(f, "the edge from {} to {} has {faces} faces", position(a), position(b))
            }
            Fault::Turned { edge: [a, b] } => {
                write!(f, "the faces at the edge from {} to {} look to different sides", position(a), position(b))
            }
            Fault::InsideOut { volume, at } => {
                write!(f, "the part at {} is inside out: its volume is {volume:.3} m3", position(at))
            }
            Fault::Cut { faces: [a, b], at } => {
                write!(f, "faces {} and {} cut each other at {}", a + 1, b + 1, position(at))
            }
            Fault::Degenerate { face, at } => write!(f, "face {} at {} has no area", face + 1, position(at)),
        }
    }
}

impl Surface {
    /// What is wrong with it: [`Surface::leaks`], and faces that cut each other. Empty of a good closed surface.
    pub fn faults(&self) -> Vec<Fault> {
        let (size, mut list) = (self.size(), self.leaks());
        let boxes = Boxes::new(self);
        let mut cuts: Vec<(usize, usize, Vector3<f64>)> = Vec::new();
        boxes.pairs(&boxes, 0.0, |m, n| {
            let (m, n) = (m.min(n), m.max(n));
            if let (true, Some(a), Some(b)) = (m < n, self.corners(m), self.corners(n)) {
                cuts.extend(intersect_triangles(&a, &b, TOUCHING_DISTANCE_SHARE * size).map(|at| (m, n, at)));
            }
            // a pair may come twice
            cuts.len() >= 2 * MAX_REPORTED_FAULTS
        });
        cuts.sort_by_key(|&(m, n, _)| (m, n));
        cuts.dedup_by_key(|&mut (m, n, _)| (m, n));
        list.extend(
            cuts.iter().take(MAX_REPORTED_FAULTS).map(|&(m, n, at)| Fault::Cut { faces: [m, n], at: at.into() }),
        );
        list
    }

    /// What keeps it from bounding a volume: degenerate faces, then edges, and parts that are inside out. The volume of parts is
    /// only judged when all edges are right. This asks no pairs of faces: it is quick.
    pub fn leaks(&self) -> Vec<Fault> {
        let size = self.size();
        let mut list = Vec::new();
        for face in 0..self.faces.len() {
            let corners = self.corners(face);
            let thin = corners.is_none_or(|[a, b, c]| {
                let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
                let height = (b - a).cross(&(c - a)).norm() / longest;
                height.is_nan() || height <= 1e-12 * size
            });
            if thin {
                list.push(Fault::Degenerate { face, at: corners.map_or([f64::NAN; 3], |c| c[0].into()) });
            }
        }
        let before = list.len();
        self.edge_faults(&mut list);
        if list.len() == before {
            self.turned_parts(&mut list);
        }
        list
    }

    /// The diagonal of the box round it (m).
    fn size(&self) -> f64 {
        let Some(first) = self.vertices.first() else { return 0.0 };
        let (low, high) = self.vertices.iter().fold((*first, *first), |(l, h), v| (l.inf(v), h.sup(v)));
        (high - low).norm()
    }

    /// Edges in order of their vertices, with how often they are run each way.
    fn edge_faults(&self, list: &mut Vec<Fault>) {
        let mut edges: Vec<(u32, u32, bool)> = Vec::with_capacity(3 * self.faces.len());
        for &[a, b, c] in &self.faces {
            edges.extend([(a, b), (b, c), (c, a)].map(|(p, q)| (p.min(q), p.max(q), p < q)));
        }
        edges.sort_unstable();
        let at = |n: u32| self.vertices.get(n as usize).map_or([f64::NAN; 3], |&v| v.into());
        for same in edges.chunk_by(|p, q| (p.0, p.1) == (q.0, q.1)) {
            let Some(&(p, q, _)) = same.first() else { continue };
            let (edge, onward) = ([at(p), at(q)], same.iter().filter(|e| e.2).count());
            match same.len() {
                1 => list.push(Fault::Open { edge }),
                2 if onward == 1 => {}
                2 => list.push(Fault::Turned { edge }),
                faces => list.push(Fault::Crowded { edge, faces }),
            }
        }
    }

    /// Connected parts of negative volume that are not hollows of the others.
    fn turned_parts(&self, list: &mut Vec<Fault>) {
        let parts = self.parts();
        let earlier = list.len();
        for (n, part) in parts.iter().enumerate() {
            let volume = part.volume();
            let Some(&at) = part.vertices.first() else { continue };
            let others = parts.iter().enumerate().filter(|(m, _)| *m != n);
            if volume < 0.0 && others.map(|(_, p)| p.winding(at)).sum::<f64>() < 0.5 {
                list.push(Fault::InsideOut { volume, at: at.into() });
            }
            if list.len() >= earlier + MAX_REPORTED_FAULTS {
                break;
            }
        }
    }

    /// Its connected parts, over the same vertices' places.
    fn parts(&self) -> Vec<Surface> {
        let mut root: Vec<usize> = (0..self.vertices.len()).collect();
        fn find(root: &mut [usize], mut n: usize) -> usize {
            while let Some(&up) = root.get(n) {
                if up == n {
                    break;
                }
                let higher = root.get(up).copied().unwrap_or(up);
                if let Some(own) = root.get_mut(n) {
                    *own = higher;
                }
                n = higher;
            }
            n
        }
        for face in &self.faces {
            let [a, b, c] = face.map(|v| find(&mut root, v as usize));
            let least = a.min(b).min(c);
            for n in [a, b, c] {
                if let Some(own) = root.get_mut(n) {
                    *own = least;
                }
            }
        }
        let mut parts: indexmap::IndexMap<usize, Surface> = indexmap::IndexMap::new();
        for (n, &[a, ..]) in self.faces.iter().enumerate() {
            let Some(corners) = self.corners(n) else { continue };
            let part = parts.entry(find(&mut root, a as usize)).or_default();
            let first = part.vertices.len() as u32;
            part.vertices.extend(corners);
            part.faces.push([first, first + 1, first + 2]);
        }
        parts.into_values().collect()
    }

    /// How often it goes round a point: 1 inside, 0 outside (solid angle of a triangle [VAN-OOSTEROM-1983]).
    fn winding(&self, at: Vector3<f64>) -> f64 {
        let angles = (0..self.faces.len()).filter_map(|n| self.corners(n)).map(|corners| {
            let [a, b, c] = corners.map(|p| p - at);
            let (u, v, w) = (a.norm(), b.norm(), c.norm());
            let across = u * v * w + a.dot(&b) * w + b.dot(&c) * u + c.dot(&a) * v;
            2.0 * a.dot(&b.cross(&c)).atan2(across)
        });
        angles.sum::<f64>() / (4.0 * std::f64::consts::PI)
    }

    /// A point just inside one of its faces that is inside the other too.
    fn shared_point(&self, other: &Surface, depth: f64) -> Option<Vector3<f64>> {
        let stride = self.faces.len().div_ceil(MAX_CHECKED_FACES).max(1);
        (0..self.faces.len()).step_by(stride).filter_map(|n| self.corners(n)).find_map(|[a, b, c]| {
            let inward = -(b - a).cross(&(c - a)).try_normalize(0.0)?;
            let at = (a + b + c) / 3.0 + inward * depth;
            (self.winding(at) > 0.5 && other.winding(at) > 0.5).then_some(at)
        })
    }
}

/// A point (m) that two closed surfaces share: they cut each other, or one is within the other. None where they are apart or
/// only touch, to 1e-7 of their size.
pub fn intersect(a: &Surface, b: &Surface) -> Option<[f64; 3]> {
    let margin = TOUCHING_DISTANCE_SHARE * a.size().max(b.size());
    let mut found = None;
    Boxes::new(a).pairs(&Boxes::new(b), 0.0, |m, n| {
        let (Some(p), Some(q)) = (a.corners(m), b.corners(n)) else { return false };
        found = intersect_triangles(&p, &q, margin);
        found.is_some()
    });
    // without a cut one is within the other or they are apart: points just inside the faces of each tell
    let found = found.or_else(|| a.shared_point(b, 2.0 * margin)).or_else(|| b.shared_point(a, 2.0 * margin));
    found.map(Into::into)
}
