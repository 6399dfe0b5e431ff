//! What the fluid does to half an element, and how much of it is under water.

use super::mesh::Element;
use super::surroundings::Fluid;
use nalgebra::{Matrix3, Vector3};

/// Force of the fluid on half an element if all of it were wet, as a load to be overcome (N), with its derivatives.
pub(super) struct HalfLoad {
    /// The force the half needs from outside to go on moving as it does (N).
    pub force: Vector3<f64>,
    /// By the velocity of its node (N s/m).
    pub by_velocity: Matrix3<f64>,
    /// By the acceleration of its node (kg).
    pub by_acceleration: Matrix3<f64>,
    /// By the direction of the element (N).
    pub by_direction: Matrix3<f64>,
}

/// Buoyancy, the fluid's own inertia, added mass and Morison drag on half an element of direction `t`.
///
/// Effective-tension form: the pressure of the fluid on the sides acts as the displaced fluid's weight and inertia,
/// in full along all axes. Drag 1/2 rho Cd D |u_n| u_n across and 1/2 rho Cx pi D |u_t| u_t along the rod, u the
/// velocity relative to the fluid; added mass likewise, normal and tangential (Morison et al. 1950; DNV-RP-C205
/// section 6.2).
#[inline(always)]
pub(super) fn half_load(
    half: &Element,
    t: &Vector3<f64>,
    fluid: &Fluid,
    velocity: &Vector3<f64>,
    acceleration: &Vector3<f64>,
    gravity: f64,
) -> HalfLoad {
    let density = fluid.density;
    let u = velocity - fluid.velocity;
    let q = acceleration - fluid.acceleration;
    let along = u.dot(t);
    let across = u - t * along;
    let speed = across.norm();
    let (normal, tangential) = (density * half.drag[0], density * half.drag[1]);
    let (added, added_more) = (density * half.added[0], density * (half.added[1] - half.added[0]));
    let volume = density * half.volume;
    let q_along = q.dot(t);

    let mut force =
        across * (normal * speed) + t * (tangential * along.abs() * along + added_more * q_along) + q * added;
    force -= fluid.acceleration * volume;
    force.z -= volume * gravity;

    let unit = if speed > 0.0 { across / speed } else { Vector3::zeros() };
    // (I - tt) |un| + un un / |un|, plus the tangential part along tt
    let along_stiff = 2.0 * tangential * along.abs() - normal * speed;
    let outer = t * t.transpose();
    let mut by_velocity = outer * along_stiff + (unit * unit.transpose()) * (normal * speed);
    let mut by_acceleration = outer * added_more;
    for i in 0..3 {
        by_velocity[(i, i)] += normal * speed;
        by_acceleration[(i, i)] += added;
    }
    // d(across)/dt = -(t u' + (u.t) I); d|across| = -(u.t) unit.dt
    let mut by_direction = t * (u * (2.0 * tangential * along.abs() - normal * speed) + q * added_more).transpose()
        - unit * unit.transpose() * (normal * speed * along);
    let diagonal = tangential * along.abs() * along - normal * speed * along + added_more * q_along;
    for i in 0..3 {
        by_direction[(i, i)] += diagonal;
    }
    HalfLoad { force, by_velocity, by_acceleration, by_direction }
}

/// Wet share of a length whose ends lie `a` and `b` below the surface (m, negative above), and its slopes by a and b.
/// A section wets as its diameter goes under, so the share has no jump for a length that lies in the surface.
#[inline]
pub(super) fn wet_share(a: f64, b: f64, diameter: f64) -> (f64, f64, f64) {
    let half = 0.5 * diameter;
    if a >= half && b >= half {
        return (1.0, 0.0, 0.0);
    }
    if a <= -half && b <= -half {
        return (0.0, 0.0, 0.0);
    }
    let width = diameter.max(1e-6);
    let ramp = |s: f64| (s / width + 0.5).clamp(0.0, 1.0);
    if (a - b).abs() < 1e-6 * width {
        let middle = 0.5 * (a + b);
        let slope = if middle.abs() < 0.5 * width { 0.5 / width } else { 0.0 };
        return (ramp(middle), slope, slope);
    }
    // integral of the ramp from far above to s
    let area = |s: f64| {
        let up = s + 0.5 * width;
        if up <= 0.0 {
            0.0
        } else if up < width {
            0.5 * up * up / width
        } else {
            s
        }
    };
    let share = (area(a) - area(b)) / (a - b);
    (share, (ramp(a) - share) / (a - b), (share - ramp(b)) / (a - b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rod::section::Segment;
    use crate::rod::{Attachment, Rod};

    fn element() -> Element {
        let segment = Segment {
            drag_normal: 1.2,
            drag_tangential: 0.1,
            added_normal: 1.0,
            added_tangential: 0.3,
            ..Segment::line(10.0, 1, 50.0, 1e8, 0.3)
        };
        Rod::new("test", vec![segment], Vec::<Attachment>::new()).unwrap().elements[0].clone()
    }

    #[test]
    fn derivatives_of_the_fluid_load_are_its_differences() {
        let half = element();
        let fluid = Fluid {
            velocity: Vector3::new(1.0, -0.3, 0.2),
            acceleration: Vector3::new(0.4, 0.1, -0.5),
            surface: 0.0,
            density: 1025.0,
        };
        let (t, v, a) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.2, 0.7, -1.0), Vector3::new(0.3, -0.2, 0.9));
        let at = |t: Vector3<f64>, v: Vector3<f64>, a: Vector3<f64>| half_load(&half, &t, &fluid, &v, &a, 9.81);
        let whole = at(t, v, a);
        let h = 1e-6;
        for i in 0..3 {
            let mut e = Vector3::zeros();
            e[i] = h;
            let by_v = (at(t, v + e, a).force - at(t, v - e, a).force) / (2.0 * h);
            let by_a = (at(t, v, a + e).force - at(t, v, a - e).force) / (2.0 * h);
            // the direction stays of length one: its steps are across t
            let d = e - t * t.dot(&e);
            let by_t = (at(t + d, v, a).force - at(t - d, v, a).force) / (2.0 * h);
            let wanted = whole.by_direction * (d / h);
            // central differences of forces of order 1e3 N
            assert!((by_v - whole.by_velocity.column(i)).norm() < 1e-4);
            assert!((by_a - whole.by_acceleration.column(i)).norm() < 1e-4);
            assert!((by_t - wanted).norm() < 1e-4, "{by_t} {wanted}");
        }
    }

    #[test]
    fn wet_share_is_the_length_under_water_and_has_its_slopes() {
        assert_eq!(wet_share(3.0, 5.0, 0.2).0, 1.0);
        assert_eq!(wet_share(-3.0, -5.0, 0.2).0, 0.0);
        // a length through the surface is wet by what lies under it
        assert!((wet_share(3.0, -1.0, 0.2).0 - 0.75).abs() < 1e-12);
        let h = 1e-7;
        for (a, b) in [(3.0, -1.0), (0.05, -2.0), (0.02, 0.07), (-0.3, 0.05), (0.01, 0.01)] {
            let (_, by_a, by_b) = wet_share(a, b, 0.2);
            let da = (wet_share(a + h, b, 0.2).0 - wet_share(a - h, b, 0.2).0) / (2.0 * h);
            let db = (wet_share(a, b + h, 0.2).0 - wet_share(a, b - h, 0.2).0) / (2.0 * h);
            // central differences of a number of order one
            assert!((by_a - da).abs() < 1e-6 && (by_b - db).abs() < 1e-6, "{a} {b}: {by_a} {da} {by_b} {db}");
        }
    }
}
