//! The skin of a piece in a stream: integrals of the stream's pressure over what is exposed, and how they change.
//!
//! Coordinates r = (x, y, z) are about the pose's origin, along global axes. The skin moves with its body: a motion of
//! translation d and rotation t lifts a point of it by `d_z + t_x y - t_y x`. With `w` a function of the height alone, an
//! integral of `w` over the exposed skin changes by that of `dw/dz` times the lift, and by `w` times the lift along the
//! waterline, where the skin comes out by `lift / s` across the line, s being the sine of the skin's slope. Both have the
//! same factor, so that they are one sum, of (1, x, y, z, xx, xy, yy, xz, yz).

use super::hull::Surface;
use super::strips::{Strip, Strips};
use nalgebra::{SMatrix, SVector, Vector3};
use windlass_base::pose::Pose;

/// A triangle of the skin: its corners, its unit normal in the body (outward), and how much of it is seen along each axis of the
/// part.
#[derive(Debug)]
struct Facet {
    corners: [u32; 3],
    normal: Vector3<f64>,
    seen: Vector3<f64>,
}

/// A skin, in body coordinates (m).
#[derive(Debug)]
pub struct Skin {
    vertices: Vec<Vector3<f64>>,
    facets: Vec<Facet>,
}

/// Sums of `w` times (1; x, y, z), and of its change with the lift, as the text above says.
#[derive(Clone, Copy, Debug)]
pub struct PressureIntegral<const D: usize = 2> {
    /// Integral of w (m4/s2).
    pub force: SVector<f64, D>,
    /// Integral of r w (m5/s2).
    pub arm: SMatrix<f64, 3, D>,
    /// Changes of `force` with a lift of 1, x, y: columns.
    pub force_by: SMatrix<f64, D, 3>,
    /// Changes of `arm` with a lift of 1, x, y.
    pub arm_by: [SMatrix<f64, 3, D>; 3],
}

/// The waterplane of the piece: integrals of (1, x, y) over it, and in columns their changes with heave and the rotations.
#[derive(Clone, Copy, Debug, Default)]
pub struct Waterplane {
    /// m2, m3, m3.
    pub sums: Vector3<f64>,
    /// By d_z, t_x, t_y, t_z.
    pub change: SMatrix<f64, 3, 4>,
}

/// What a stream finds of a skin.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceIntegrals<const D: usize = 2> {
    /// Along each axis of the part, by half of what of the skin is seen along it.
    pub along: [PressureIntegral<D>; 3],
    /// The waterplane.
    pub plane: Waterplane,
}

/// A row for each component of w of the nine products of the change, and one of the four of the value.
struct Sums<const D: usize> {
    value: SMatrix<f64, D, 4>,
    change: SMatrix<f64, D, 9>,
}

fn products(r: &Vector3<f64>) -> SMatrix<f64, 1, 9> {
    let [x, y, z] = [r.x, r.y, r.z];
    SMatrix::from_row_slice(&[1.0, x, y, z, x * x, x * y, y * y, x * z, y * z])
}

impl<const D: usize> Sums<D> {
    fn zero() -> Self {
        Sums { value: SMatrix::zeros(), change: SMatrix::zeros() }
    }

    /// A triangle within one strip. The integrands are of third degree, for which the rule of four points is exact (Strang and Fix
    /// 1973, table 4.1).
    fn triangle(&mut self, strip: &Strip<D>, strips: &Strips<D>, height: f64, [a, b, c]: [Vector3<f64>; 3]) {
        let area = 0.5 * (b - a).cross(&(c - a)).norm();
        let s = a + b + c;
        let middle = s / 3.0;
        if strip.is_uniform() {
            let w = strip.terms[0] * area;
            self.value += w * SMatrix::<f64, 1, 4>::from_row_slice(&[1.0, middle.x, middle.y, middle.z]);
            return;
        }
        let points = [(middle, -0.5625), (s * 0.2 + a * 0.4, 0.520_833_333_333_333_3)];
        let more = [b, c].map(|p| (s * 0.2 + p * 0.4, 0.520_833_333_333_333_3));
        for (r, weight) in points.into_iter().chain(more) {
            let (w, slope) = strip.evaluate(strips.sense * (r.z + height));
            let own = products(&r);
            self.value += w * (weight * area) * own.fixed_columns::<4>(0);
            self.change += slope * (strips.sense * weight * area) * own;
        }
    }

    /// A piece of the waterline: at its two Gauss points the products are of second degree.
    fn waterline(&mut self, w: SVector<f64, D>, points: [Vector3<f64>; 2], weight: f64) {
        for r in points {
            self.change += w * weight * products(&r);
        }
    }
}

impl<const D: usize> PressureIntegral<D> {
    fn zero() -> Self {
        let zero = SMatrix::zeros();
        PressureIntegral { force: SVector::zeros(), arm: zero, force_by: SMatrix::zeros(), arm_by: [zero; 3] }
    }

    fn add(&mut self, sums: &Sums<D>, share: f64) {
        let (v, d) = (&sums.value, &sums.change);
        self.force += v.column(0) * share;
        self.arm += v.fixed_columns::<3>(1).transpose() * share;
        self.force_by += d.fixed_columns::<3>(0) * share;
        for (sum, [x, y, z]) in self.arm_by.iter_mut().zip([[1, 2, 3], [4, 5, 7], [5, 6, 8]]) {
            for (row, column) in [x, y, z].into_iter().enumerate() {
                let mut at = sum.row_mut(row);
                at += d.column(column).transpose() * share;
            }
        }
    }
}

impl Waterplane {
    /// A piece of its rim between two points, the skin there having an outward normal of which `level` is the length of the level
    /// part. The plane grows outward by the speed of the skin along its normal, over that length (Reynolds' theorem on a level
    /// section); its integrals follow from the rim by the divergence theorem.
    fn rim(&mut self, points: [Vector3<f64>; 2], half: f64, normal: &Vector3<f64>, level: f64) {
        for r in points {
            let flux = (r.x * normal.x + r.y * normal.y) / level * half;
            self.sums += Vector3::new(flux / 2.0, r.x * flux / 3.0, r.y * flux / 3.0);
            let turn = r.cross(normal);
            let speed = SMatrix::<f64, 1, 4>::new(normal.z, turn.x, turn.y, turn.z) * (half / level);
            self.change += Vector3::new(1.0, r.x, r.y) * speed;
        }
    }
}

/// Where the edge between two points is at a distance from the surface.
fn section(low: (Vector3<f64>, f64), high: (Vector3<f64>, f64), at: f64) -> Vector3<f64> {
    let part = (at - low.1) / (high.1 - low.1);
    if part.is_finite() { low.0 + (high.0 - low.0) * part.clamp(0.0, 1.0) } else { low.0 }
}

impl Skin {
    /// That of a closed surface, seen along the axes of a part: the columns of a matrix, in the body.
    pub fn new(surface: &Surface, axes: &nalgebra::Matrix3<f64>) -> Self {
        let at = |n: u32| surface.vertices.get(n as usize).copied();
        let facet = |&corners: &[u32; 3]| {
            let [a, b, c] = corners.map(at);
            let normal = (b? - a?).cross(&(c? - a?)).try_normalize(0.0)?;
            // a cosine from rounding alone is not worth its sums
            let seen = (axes.transpose() * normal).map(|x| if x.abs() < 1e-15 { 0.0 } else { 0.5 * x.abs() });
            Some(Facet { corners, normal, seen })
        };
        Skin { vertices: surface.vertices.clone(), facets: surface.faces.iter().filter_map(facet).collect() }
    }

    /// What a stream finds of it in a pose.
    pub fn surface_integrals<const D: usize>(&self, pose: &Pose, strips: &Strips<D>) -> SurfaceIntegrals<D> {
        let height = pose.origin.z - strips.level;
        let position = |p: &Vector3<f64>| {
            let r = pose.axes * p;
            (r, strips.sense * (r.z + height))
        };
        let placed: Vec<(Vector3<f64>, f64)> = self.vertices.iter().map(position).collect();
        let mut found = SurfaceIntegrals { along: [PressureIntegral::zero(); 3], plane: Waterplane::default() };
        for facet in &self.facets {
            let [Some(a), Some(b), Some(c)] = facet.corners.map(|n| placed.get(n as usize).copied()) else { continue };
            let mut by_height = [a, b, c];
            by_height.sort_by(|p, q| p.1.total_cmp(&q.1));
            let [low, _, high] = by_height;
            // what lies in the surface is dry
            if high.1 < 0.0 || (high.1 == 0.0 && (strips.sense < 0.0 || low.1 < 0.0)) {
                continue;
            }
            let mut sums = Sums::zero();
            if low.1 < 0.0 {
                let [from, to] = cut_triangle(by_height, 0.0);
                let normal = pose.axes * facet.normal;
                let (level, long) = (normal.xy().norm(), (to - from).norm());
                if level > 0.0 {
                    let (middle, away) = ((from + to) / 2.0, (to - from) / (2.0 * f64::sqrt(3.0)));
                    let points = [middle - away, middle + away];
                    sums.waterline(strips.at_surface(), points, strips.sense * long / (2.0 * level));
                    found.plane.rim(points, long / 2.0, &normal, level);
                }
            }
            whole(&mut sums, strips, height, by_height);
            for (sum, share) in found.along.iter_mut().zip(facet.seen.iter()).filter(|(_, share)| **share != 0.0) {
                sum.add(&sums, *share);
            }
        }
        found
    }
}

/// The two points of a triangle, its corners in the order of their distance, at a distance.
fn cut_triangle([low, middle, high]: [(Vector3<f64>, f64); 3], at: f64) -> [Vector3<f64>; 2] {
    let near = if at < middle.1 { section(low, middle, at) } else { section(middle, high, at) };
    [section(low, high, at), near]
}

/// The exposed part of a triangle, strip by strip, and within a strip from corner to corner.
fn whole<const D: usize>(sums: &mut Sums<D>, strips: &Strips<D>, height: f64, corners: [(Vector3<f64>, f64); 3]) {
    let [low, middle, high] = corners;
    let mut from = low.1.max(0.0);
    for (strip, end) in strips.strips_between(from, high.1) {
        if low.1 >= strip.from && high.1 <= end {
            return sums.triangle(strip, strips, height, corners.map(|c| c.0));
        }
        let stop = end.min(high.1);
        let knee = (from < middle.1 && middle.1 < stop).then_some(middle.1);
        for to in knee.into_iter().chain([stop]) {
            if to <= from {
                continue;
            }
            let [a, b] = cut_triangle(corners, from);
            let c = section(low, high, to);
            let d = if to <= middle.1 { section(low, middle, to) } else { section(middle, high, to) };
            // at a tip one of the two triangles has no area
            if from > low.1 || low.1 == middle.1 {
                sums.triangle(strip, strips, height, [a, b, d]);
            }
            if to < high.1 || middle.1 == high.1 {
                sums.triangle(strip, strips, height, [a, d, c]);
            }
            from = to;
        }
    }
}
