//! A flat panel: geometry, and the integrals of `1/r` over it.

use nalgebra::{Matrix3, Vector3};
use std::f64::consts::TAU;

/// Distance, in longest diagonals of a panel, from which its integrals are those of its area and second moments.
const FAR_DIAGONALS: f64 = 4.0;
/// Points of the rule on a panel near another: two along each direction.
const GAUSS_POINT: f64 = 0.577_350_269_189_625_8;

/// A point nearer to the middle of a panel than this share of its diagonal is its middle.
const MIDDLE_SHARE: f64 = 1e-6;

/// A quadrilateral, or a triangle that repeats a corner; seen from the water its corners run counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    corners: [Vector3<f64>; 4],
    /// Centroid (m).
    pub centroid: Vector3<f64>,
    /// Unit normal, into the water.
    pub normal: Vector3<f64>,
    /// Area (m2).
    pub area: f64,
    /// Longest diagonal or side (m).
    pub diagonal: f64,
    /// Second moments of area about the centroid (m4).
    second_moments: Matrix3<f64>,
    /// Points of a rule of quadrature, each with its area.
    rule: [(Vector3<f64>, f64); 4],
}

impl Panel {
    /// A panel by its corners (m); none where it has no area or a corner is not finite.
    pub fn new(corners: [Vector3<f64>; 4]) -> Option<Self> {
        let triangles = triangles(&corners);
        let crosses = triangles.map(|[a, b, c]| (b - a).cross(&(c - a)) * 0.5);
        let vector = crosses[0] + crosses[1];
        let normal = vector.try_normalize(0.0)?;
        let area = vector.norm();
        let shares = crosses.map(|cross| cross.dot(&normal));
        let middles = triangles.map(|[a, b, c]| (a + b + c) / 3.0);
        let centroid = (middles[0] * shares[0] + middles[1] * shares[1]) / area;
        let mut second_moments = Matrix3::zeros();
        for (triangle, share) in triangles.iter().zip(shares) {
            // exact for a triangle: the midpoints of its sides, a third of the area each
            for (from, to) in [(0, 1), (1, 2), (2, 0)] {
                let arm = (triangle[from] + triangle[to]) * 0.5 - centroid;
                let arm = arm - normal * normal.dot(&arm);
                second_moments += arm * arm.transpose() * (share / 3.0);
            }
        }
        let diagonal = (0..4)
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .fold(0.0, |most: f64, (i, j)| most.max((corners[i] - corners[j]).norm()));
        let rule = rule(&corners, area);
        let finite = area.is_finite() && centroid.iter().all(|x| x.is_finite());
        finite.then_some(Panel { corners, centroid, normal, area, diagonal, second_moments, rule })
    }

    /// Its corners (m).
    pub fn corners(&self) -> &[Vector3<f64>; 4] {
        &self.corners
    }

    /// Four points with the areas that they stand for (m, m2).
    pub fn rule(&self) -> &[(Vector3<f64>, f64); 4] {
        &self.rule
    }

    /// The distance of a point (m).
    pub(crate) fn distance(&self, at: &Vector3<f64>) -> f64 {
        triangles(&self.corners).iter().map(|triangle| triangle_distance(triangle, at)).fold(f64::INFINITY, f64::min)
    }

    /// `int dS/r` (m) and `int d(1/r)/dN dS` over the panel, seen from a point; N is its normal. The second is the solid angle, positive
    /// on the side of the normal and zero on the panel itself [HESS-SMITH-1967].
    pub fn rankine(&self, from: &Vector3<f64>) -> [f64; 2] {
        let arm = from - self.centroid;
        let distance2 = arm.norm_squared();
        if distance2 > (FAR_DIAGONALS * self.diagonal).powi(2) {
            return self.far_rankine(&arm, distance2);
        }
        let [potential, angle] = triangles(&self.corners).iter().fold([0.0; 2], |[potential, angle], triangle| {
            let [p, a] = triangle_rankine(triangle, from);
            [potential + p, angle + a]
        });
        // corners of seven figures are not in one plane: the middle is beside one of the triangles by a hair, on this side or the other, and sees
        // half of a sphere; on the panel there is no jump
        if distance2 <= (MIDDLE_SHARE * self.diagonal).powi(2) {
            return [potential, angle - TAU * (angle / TAU).round()];
        }
        [potential, angle]
    }

    /// The gradients of both of [`Panel::rankine`] by the position of the point (without unit, 1/m), which is not on an edge of the panel.
    pub fn rankine_gradients(&self, from: &Vector3<f64>) -> [Vector3<f64>; 2] {
        let arm = from - self.centroid;
        let distance2 = arm.norm_squared();
        if distance2 > (FAR_DIAGONALS * self.diagonal).powi(2) {
            return self.far_rankine_gradients(&arm, distance2);
        }
        let triangles = triangles(&self.corners).map(|triangle| triangle_rankine_gradients(&triangle, from));
        [triangles[0][0] + triangles[1][0], triangles[0][1] + triangles[1][1]]
    }

    fn far_rankine_gradients(&self, arm: &Vector3<f64>, distance2: f64) -> [Vector3<f64>; 2] {
        let height = arm.dot(&self.normal);
        let over2 = 1.0 / distance2;
        let over3 = over2 * over2.sqrt();
        let turned = self.second_moments * arm;
        let (trace, along) = (self.second_moments.trace(), arm.dot(&turned) * over2);
        let potential = (turned * (3.0 * over2) - arm * (self.area + over2 * (7.5 * along - 1.5 * trace))) * over3;
        let share = self.area + over2 * (7.5 * along - 1.5 * trace);
        let fall = arm * (3.0 * self.area + over2 * (52.5 * along - 7.5 * trace));
        let angle = self.normal * (share * over3) + (turned * 15.0 * over2 - fall) * (height * over2 * over3);
        [potential, angle]
    }

    /// The same by the first terms of the expansion about the centroid.
    fn far_rankine(&self, arm: &Vector3<f64>, distance2: f64) -> [f64; 2] {
        let height = arm.dot(&self.normal);
        let over2 = 1.0 / distance2;
        let over = over2.sqrt();
        let (trace, along) = (self.second_moments.trace(), arm.dot(&(self.second_moments * arm)));
        let potential = over * (self.area + 0.5 * over2 * (3.0 * along * over2 - trace));
        let angle = height * over * over2 * (self.area + 0.5 * over2 * (15.0 * along * over2 - 3.0 * trace));
        [potential, angle]
    }
}

/// The two triangles of a quadrilateral; the second has no area where the last two corners are one.
fn triangles([a, b, c, d]: &[Vector3<f64>; 4]) -> [[Vector3<f64>; 3]; 2] {
    [[*a, *b, *c], [*a, *c, *d]]
}

/// The distance of a point from a triangle (m): along its normal above or below it, elsewhere from the nearest of its sides.
fn triangle_distance(corners: &[Vector3<f64>; 3], at: &Vector3<f64>) -> f64 {
    let sides = [(0, 1), (1, 2), (2, 0)].map(|(from, to)| (corners[from], corners[to] - corners[from]));
    let normal = sides[0].1.cross(&sides[1].1).try_normalize(0.0);
    let is_inside =
        |normal: &Vector3<f64>| sides.iter().all(|(from, side)| normal.cross(side).dot(&(at - from)) >= 0.0);
    if let Some(normal) = normal.filter(is_inside) {
        return (at - corners[0]).dot(&normal).abs();
    }
    let from_side = |(from, side): &(Vector3<f64>, Vector3<f64>)| {
        let along = (at - from).dot(side) / side.norm_squared().max(f64::MIN_POSITIVE);
        (at - from - side * along.clamp(0.0, 1.0)).norm()
    };
    sides.iter().map(from_side).fold(f64::INFINITY, f64::min)
}

/// Gauss's points of the bilinear map, with areas that add up to that of the panel.
fn rule(corners: &[Vector3<f64>; 4], area: f64) -> [(Vector3<f64>, f64); 4] {
    let [a, b, c, d] = corners;
    let signs = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let mut points = signs.map(|(s, t)| {
        let (s, t) = (s * GAUSS_POINT, t * GAUSS_POINT);
        let point = (a * ((1.0 - s) * (1.0 - t))
            + b * ((1.0 + s) * (1.0 - t))
            + c * ((1.0 + s) * (1.0 + t))
            + d * ((1.0 - s) * (1.0 + t)))
            * 0.25;
        let along = (b - a) * (1.0 - t) + (c - d) * (1.0 + t);
        let across = (d - a) * (1.0 - s) + (c - b) * (1.0 + s);
        (point, along.cross(&across).norm())
    });
    let sum: f64 = points.iter().map(|point| point.1).sum();
    for point in &mut points {
        point.1 *= area / sum;
    }
    points
}

/// As [`Panel::rankine`], of a triangle: logarithms of its sides, and the solid angle [VAN-OOSTEROM-STRACKEE-1983].
fn triangle_rankine(corners: &[Vector3<f64>; 3], from: &Vector3<f64>) -> [f64; 2] {
    let arms = corners.map(|corner| corner - from);
    let distances = arms.map(|arm| arm.norm());
    let cross = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
    let Some(normal) = cross.try_normalize(0.0) else { return [0.0; 2] };
    let [a, b, c] = &arms;
    let [la, lb, lc] = distances;
    let triple = a.dot(&b.cross(c));
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    // the arms lead to the triangle, so a point on the side of its normal has a negative product; in its plane it has no angle
    let height = -arms[0].dot(&normal);
    let flat = height.abs() <= 1e-12 * (la + lb + lc);
    let angle = if flat { 0.0 } else { 2.0 * (-triple).atan2(below) };
    let mut potential = -height * angle;
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        let side = corners[j] - corners[i];
        let length = side.norm();
        if length == 0.0 {
            continue;
        }
        // distance of the foot of the point from the side, positive inside
        let inward = normal.cross(&side) / length;
        let inside = -arms[i].dot(&inward);
        let sum = distances[i] + distances[j];
        if inside != 0.0 && sum > length {
            potential += inside * ((sum + length) / (sum - length)).ln();
        }
    }
    [potential, angle]
}

/// As [`Panel::rankine_gradients`], of a triangle: that of the solid angle is the field of a current round it.
fn triangle_rankine_gradients(corners: &[Vector3<f64>; 3], from: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let arms = corners.map(|corner| corner - from);
    let distances = arms.map(|arm| arm.norm());
    let cross = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
    let Some(normal) = cross.try_normalize(0.0) else { return [Vector3::zeros(); 2] };
    let [_, angle] = triangle_rankine(corners, from);
    let (mut potential, mut by_angle) = (normal * -angle, Vector3::zeros());
    for (i, j) in [(0, 1), (1, 2), (2, 0)] {
        let side = corners[j] - corners[i];
        let length = side.norm();
        let sum = distances[i] + distances[j];
        if length == 0.0 || sum <= length {
            continue;
        }
        potential += normal.cross(&side) * (((sum + length) / (sum - length)).ln() / length);
        let product = distances[i] * distances[j];
        let below = product * (product + arms[i].dot(&arms[j]));
        if below > 0.0 {
            by_angle -= arms[i].cross(&arms[j]) * (sum / below);
        }
    }
    [potential, by_angle]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, SQRT_2};

    fn square() -> Panel {
        let corner = |x: f64, y: f64| Vector3::new(x, y, 0.0);
        Panel::new([corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)]).unwrap()
    }

    #[test]
    fn potential_at_middle_of_unit_square_is_closed_form() {
        // int dS/r over a square of side a from its middle: 4 a ln(1 + sqrt 2)
        let [potential, angle] = square().rankine(&Vector3::zeros());
        assert!((potential - 4.0 * (1.0 + SQRT_2).ln()).abs() < 1e-14, "{potential}");
        assert_eq!(angle, 0.0);
    }

    #[test]
    fn distance_from_square_is_along_normal_beside_side_or_corner() {
        let square = square();
        for (at, distance) in [([0.2, -0.3, 0.7], 0.7), ([0.8, 0.1, 0.4], 0.5), ([0.9, -0.8, 1.2], 1.3)] {
            let found = square.distance(&Vector3::from(at));
            assert!((found - distance).abs() < 1e-14, "{at:?}: {found}");
        }
    }

    #[test]
    fn panel_not_quite_plane_sees_nothing_of_itself() {
        let corner = |x: f64, y: f64, z: f64| Vector3::new(x, y, z);
        // a corner 1e-7 of the side above and below the plane of the others
        for off in [1e-7, -1e-7] {
            let panel = Panel::new([
                corner(0.0, 0.0, 0.0),
                corner(1.0, 0.0, 0.0),
                corner(0.8, 1.0, off),
                corner(0.2, 1.0, 0.0),
            ]);
            let panel = panel.unwrap();
            let [_, angle] = panel.rankine(&panel.centroid);
            assert!(angle.abs() < 1e-5, "{angle}");
        }
    }

    #[test]
    fn solid_angle_of_face_from_middle_of_cube_is_sixth_of_sphere() {
        let [_, above] = square().rankine(&Vector3::new(0.0, 0.0, 0.5));
        let [_, below] = square().rankine(&Vector3::new(0.0, 0.0, -0.5));
        assert!((above - 2.0 * PI / 3.0).abs() < 1e-14 && (below + 2.0 * PI / 3.0).abs() < 1e-14, "{above} {below}");
    }

    #[test]
    fn gradients_above_middle_of_unit_square_are_closed_form() {
        // solid angle 4 asin(q/(q + h2)), q = 1/4 = (a/2)2: its slope along the axis; the pull of the square is the angle
        let h = 0.3_f64;
        let [pull, slope] = square().rankine_gradients(&Vector3::new(0.0, 0.0, h));
        let (q, h2) = (0.25, h * h);
        let angle = 4.0 * (q / (q + h2)).asin();
        let exact = -8.0 * q * h / ((q + h2) * (h2 * (2.0 * q + h2)).sqrt());
        assert!((pull.z + angle).abs() < 1e-13 && (slope.z - exact).abs() < 1e-12, "{pull} {slope} {angle} {exact}");
        assert!(pull.xy().norm() < 1e-14 && slope.xy().norm() < 1e-14);
    }

    #[test]
    fn gradients_far_away_meet_exact_ones() {
        let panel = square();
        let from = Vector3::new(4.0, 1.0, 3.5);
        let far = panel.far_rankine_gradients(&(from - panel.centroid), (from - panel.centroid).norm_squared());
        let near = triangles(panel.corners()).map(|triangle| triangle_rankine_gradients(&triangle, &from));
        for (which, scale) in [(0, 1.0), (1, 0.2)] {
            let off = (far[which] - near[0][which] - near[1][which]).norm();
            // fourth moments, as of the expansion itself
            assert!(off < 5e-4 * scale / 28.0, "{which}: {off}");
        }
    }

    #[test]
    fn far_expansion_meets_exact_integrals() {
        let panel = square();
        for direction in [Vector3::new(1.0, 0.3, 0.5), Vector3::new(0.1, 0.2, 1.0), Vector3::new(1.0, 1.0, 0.02)] {
            let from = direction.normalize() * 6.0;
            let far = panel.rankine(&from);
            let exact = triangles(panel.corners()).iter().fold([0.0; 2], |[p, a], triangle| {
                let [q, b] = triangle_rankine(triangle, &from);
                [p + q, a + b]
            });
            // the fourth moments that are left out are below (0.5/6)^4 of the area over r, or over r2
            for (a, b, scale) in [(far[0], exact[0], 1.0 / 6.0), (far[1], exact[1], 1.0 / 36.0)] {
                assert!((a - b).abs() < 4.8e-5 * scale, "{far:?} {exact:?}");
            }
        }
    }
}
