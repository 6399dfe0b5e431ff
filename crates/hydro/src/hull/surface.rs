//! A closed surface of triangles: its volume, and the exact integrals over its part below the water's surface.

use super::{Solid, SubmergedVolume};
use nalgebra::{Matrix3, Vector3};
use windlass_base::pose::Pose;

/// A closed surface of triangles, body coordinates (m), normals outward.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// The corners (m).
    pub vertices: Vec<Vector3<f64>>,
    /// Three corners each, counter-clockwise as seen from outside.
    pub faces: Vec<[u32; 3]>,
}

impl Surface {
    /// A box between two opposite corners (m), in any order.
    pub fn block(low: [f64; 3], high: [f64; 3]) -> Surface {
        let (low, high) = (Vector3::from(low), Vector3::from(high));
        let ends = [low.inf(&high), low.sup(&high)];
        let at = |side: u8, bit: u8| ends[usize::from(side & bit != 0)];
        let vertices = (0..8).map(|n| Vector3::new(at(n, 1).x, at(n, 2).y, at(n, 4).z)).collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faces = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Surface { vertices, faces }
    }

    /// Its volume (m3); negative where normals point inward.
    pub fn volume(&self) -> f64 {
        let base = self.vertices.first().copied().unwrap_or_default();
        let six: f64 = (0..self.faces.len())
            .filter_map(|n| self.corners(n))
            .map(|[a, b, c]| (a - base).dot(&(b - base).cross(&(c - base))))
            .sum();
        six / 6.0
    }

    /// The corners of a face; none where it names no vertex of the surface.
    pub(super) fn corners(&self, face: usize) -> Option<[Vector3<f64>; 3]> {
        let [a, b, c] = *self.faces.get(face)?;
        let at = |n: u32| self.vertices.get(n as usize).copied();
        Some([at(a)?, at(b)?, at(c)?])
    }
}

/// Integrals over the wet skin and along the waterline while they are gathered. Coordinates are about the pose's origin
/// with z from the water's surface.
#[derive(Default)]
struct HullSums {
    volume: f64,
    moment: Vector3<f64>,
    area: f64,
    first: [f64; 2],
    second: [f64; 3],
    /// Twice the wetted area.
    skin: f64,
    /// Twice the integrals of xx, yy, zz, yz, xz, xy over the volume, where they are asked for.
    products: Option<[f64; 6]>,
}

/// Points of a triangle by their shares of its corners, with weights: exact for polynomials of the third degree.
const CUBIC: [([f64; 3], f64); 7] = [
    ([1.0, 0.0, 0.0], 0.05),
    ([0.0, 1.0, 0.0], 0.05),
    ([0.0, 0.0, 1.0], 0.05),
    ([0.5, 0.5, 0.0], 2.0 / 15.0),
    ([0.0, 0.5, 0.5], 2.0 / 15.0),
    ([0.5, 0.0, 0.5], 2.0 / 15.0),
    ([1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0], 0.45),
];

impl HullSums {
    /// A triangle of the wet skin.
    ///
    /// The divergence theorem with the fluxes (0, 0, z), (0, 0, x z), (0, 0, y z), (0, 0, z z / 2), whose divergences are
    /// 1, x, y, z. All vanish on z = 0: the waterplane needs no lid. Over a triangle the integrals of these polynomials
    /// follow from the sums over its corners.
    fn triangle(&mut self, a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>) {
        let normal = (b - a).cross(&(c - a));
        let s = a + b + c;
        self.volume += normal.z * s.z;
        let squares = Vector3::new(
            a.x * a.z + b.x * b.z + c.x * c.z,
            a.y * a.z + b.y * b.z + c.y * c.z,
            a.z * a.z + b.z * b.z + c.z * c.z,
        );
        self.moment += normal.z * (s * s.z + squares);
        self.skin += normal.norm();
        if let Some(products) = &mut self.products {
            // fluxes whose divergences are xx .. xy, and that vanish on z = 0
            for ([p, q, r], weight) in CUBIC {
                let at = a * p + b * q + c * r;
                let flux = [
                    at.x * at.x * at.z,
                    at.y * at.y * at.z,
                    at.z * at.z * at.z / 3.0,
                    0.5 * at.y * at.z * at.z,
                    0.5 * at.x * at.z * at.z,
                    at.x * at.y * at.z,
                ];
                for (sum, flux) in products.iter_mut().zip(flux) {
                    *sum += weight * normal.z * flux;
                }
            }
        }
    }

    /// A piece of the waterline, run through with the waterplane on the left as seen from above: against the rim of the wet
    /// skin. Green's theorem makes of the closed line the integrals over the waterplane.
    fn waterline(&mut self, from: Vector3<f64>, to: Vector3<f64>) {
        let c = from.x * to.y - from.y * to.x;
        self.area += c;
        self.first[0] += c * (from.x + to.x);
        self.first[1] += c * (from.y + to.y);
        self.second[0] += c * (from.x * from.x + from.x * to.x + to.x * to.x);
        self.second[1] += c * (2.0 * (from.x * from.y + to.x * to.y) + from.x * to.y + to.x * from.y);
        self.second[2] += c * (from.y * from.y + from.y * to.y + to.y * to.y);
    }

    /// What it comes to, with z from the pose's origin, `drop` below which is the water's surface.
    fn wet(self, drop: f64) -> SubmergedVolume {
        let volume = self.volume / 6.0;
        let [x, y, z] = [self.moment.x / 24.0, self.moment.y / 24.0, self.moment.z / 48.0];
        SubmergedVolume {
            volume,
            moment: Vector3::new(x, y, z - drop * volume),
            plane_area: self.area / 2.0,
            plane_moment: self.first.map(|v| v / 6.0),
            plane_second: [self.second[0] / 12.0, self.second[1] / 24.0, self.second[2] / 12.0],
            wetted_area: self.skin / 2.0,
        }
    }
}

/// Where the edge from a point below the surface to one that is not passes through it. Both faces of an edge ask it in this
/// order and get the same point, so the waterline stays closed.
fn crossing(low: Vector3<f64>, high: Vector3<f64>) -> Vector3<f64> {
    if high.z == 0.0 {
        return high;
    }
    let mut at = low + (high - low) * (low.z / (low.z - high.z));
    at.z = 0.0;
    at
}

impl Solid for Surface {
    /// Exact for the polyhedron: each triangle is cut at the surface and its polynomials are integrated. What lies in the
    /// surface itself is dry: a deck that is just awash leaves its waterplane, a keel that just touches has none.
    fn wet(&self, pose: &Pose, level: f64) -> SubmergedVolume {
        self.gather(pose, level, HullSums::default()).wet(pose.origin.z - level)
    }
}

impl Surface {
    /// Integrals of xx, xy .. zz over what of it is below z = `level` (m, global) in a pose (m5), about the origin of the pose in global axes.
    pub fn second_moments(&self, pose: &Pose, level: f64) -> Matrix3<f64> {
        let drop = pose.origin.z - level;
        let sum = self.gather(pose, level, HullSums { products: Some([0.0; 6]), ..HullSums::default() });
        let [xx, yy, zz, yz, xz, xy] = sum.products.unwrap_or_default().map(|twice| 0.5 * twice);
        // z from the water's surface to the origin of the pose, `drop` above it
        let wet = sum.wet(drop);
        let [x, y, z] = wet.moment.into();
        let (xz, yz) = (xz - drop * x, yz - drop * y);
        let zz = zz - 2.0 * drop * (z + drop * wet.volume) + drop * drop * wet.volume;
        Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    }

    /// Adds up what of it is below the surface.
    fn gather(&self, pose: &Pose, level: f64, mut sum: HullSums) -> HullSums {
        let drop = pose.origin.z - level;
        let axes = &pose.axes;
        let position = |p: &Vector3<f64>| {
            let mut at = axes * p;
            at.z += drop;
            at
        };
        let placed: Vec<Vector3<f64>> = self.vertices.iter().map(position).collect();
        let corner = |n: u32| placed.get(n as usize).copied();
        for &[a, b, c] in &self.faces {
            let (Some(a), Some(b), Some(c)) = (corner(a), corner(b), corner(c)) else { continue };
            match [a.z < 0.0, b.z < 0.0, c.z < 0.0] {
                [true, true, true] => sum.triangle(a, b, c),
                [false, false, false] => {}
                [true, false, false] => tip(&mut sum, a, b, c),
                [false, true, false] => tip(&mut sum, b, c, a),
                [false, false, true] => tip(&mut sum, c, a, b),
                [false, true, true] => stump(&mut sum, a, b, c),
                [true, false, true] => stump(&mut sum, b, c, a),
                [true, true, false] => stump(&mut sum, c, a, b),
            }
        }
        sum
    }
}

/// A triangle with one corner below the surface.
fn tip(sum: &mut HullSums, low: Vector3<f64>, next: Vector3<f64>, last: Vector3<f64>) {
    let (p, q) = (crossing(low, next), crossing(low, last));
    sum.triangle(low, p, q);
    sum.waterline(q, p);
}

/// A triangle with one corner at or above the surface.
fn stump(sum: &mut HullSums, high: Vector3<f64>, next: Vector3<f64>, last: Vector3<f64>) {
    if high.z == 0.0 {
        return sum.triangle(high, next, last);
    }
    let (p, q) = (crossing(next, high), crossing(last, high));
    sum.triangle(p, next, last);
    sum.triangle(p, last, q);
    sum.waterline(p, q);
}
