//! What the fluid does to half an element, and how much of it is under water.

use super::environment::{FluidState, LineEnvironment};
use super::mesh::RodElement;
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
/// velocity relative to the fluid; added mass likewise, normal and tangential [MORISON-1950;
/// DNV-RP-C205 6.2].
#[inline(always)]
pub(super) fn half_load(
    half: &RodElement,
    t: &Vector3<f64>,
    fluid: &FluidState,
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

/// Drag of wind on half an element of direction `t` if all of it were dry: 1/2 rho Cd D |u_n| u_n across it, u the
/// velocity relative to the air ([DNV-RP-C205 5]; the cross-flow principle as for Morison's drag).
/// Its `by_acceleration` is zero.
#[inline]
pub(super) fn wind_load(half: &RodElement, t: &Vector3<f64>, fluid: &FluidState, velocity: &Vector3<f64>) -> HalfLoad {
    let u = velocity - fluid.wind;
    let along = u.dot(t);
    let across = u - t * along;
    let speed = across.norm();
    let factor = fluid.air_density * half.wind * speed;
    let unit = if speed > 0.0 { across / speed } else { Vector3::zeros() };
    let crosswise = unit * unit.transpose() * factor;
    let flat = Matrix3::identity() - t * t.transpose();
    HalfLoad {
        force: across * factor,
        by_velocity: flat * factor + crosswise,
        by_acceleration: Matrix3::zeros(),
        by_direction: t * u.transpose() * -factor - crosswise * along - Matrix3::identity() * (factor * along),
    }
}

/// A node and the fluid there.
#[derive(Clone, Copy)]
pub(super) struct HalfNode<'a> {
    pub position: &'a Vector3<f64>,
    pub velocity: &'a Vector3<f64>,
    pub acceleration: &'a Vector3<f64>,
    pub fluid: &'a FluidState,
}

/// Force of water and wind (N) on the half element of direction `t` beside the first of its two nodes, the sum that
/// assembly makes with its tangent.
pub(super) fn half_force(
    half: &RodElement,
    t: &Vector3<f64>,
    world: &LineEnvironment,
    [node, other]: [HalfNode; 2],
) -> Vector3<f64> {
    let [own, far] = [node, other].map(|n| n.fluid.surface - n.position.z);
    let middle = 0.5 * (own + far);
    let HalfNode { velocity, acceleration, fluid, .. } = node;
    let share = wet_share(own, middle, half.diameter).0;
    let mut force = wind_load(half, t, fluid, velocity).force * (share - 1.0);
    if share > 0.0 && fluid.density > 0.0 {
        force -= half_load(half, t, fluid, velocity, acceleration, world.gravity).force * share;
        let rising = [node, other].map(|n| n.velocity.z - n.fluid.velocity.z);
        if world.slam
            && share < 1.0
            && let Some(entry) = water_entry(own, middle, half.diameter, rising)
        {
            force -= slam_load(half, t, fluid, velocity, entry.rate).force;
        }
    }
    force
}

/// How fast half an element gets wet: the rate of its wet share (1/s), which is none while it comes out, and its
/// derivatives by the height (m) and the upward velocity (m/s) of its own node and the other one.
pub(super) struct WaterEntry {
    pub rate: f64,
    pub by_height: [f64; 2],
    pub by_velocity: [f64; 2],
}

/// The entry of half an element whose own node lies `own` below the surface and whose middle `middle` (m), the nodes
/// going up at `rising` relative to the water (m/s, own node and other).
pub(super) fn water_entry(own: f64, middle: f64, diameter: f64, rising: [f64; 2]) -> Option<WaterEntry> {
    let (_, by_own, by_middle) = wet_share(own, middle, diameter);
    let mean = 0.5 * (rising[0] + rising[1]);
    let rate = -(by_own * rising[0] + by_middle * mean);
    if rate <= 0.0 {
        return None;
    }
    let [twice_own, mixed, twice_middle] = wet_curvature(own, middle, diameter);
    let (of_own, of_middle) = (twice_own * rising[0] + mixed * mean, mixed * rising[0] + twice_middle * mean);
    Some(WaterEntry {
        rate,
        by_height: [of_own + 0.5 * of_middle, 0.5 * of_middle],
        by_velocity: [-(by_own + 0.5 * by_middle), -0.5 * by_middle],
    })
}

/// Slam on half an element whose wet share grows at `rate` (1/s), as a load to be overcome: the momentum of the added
/// mass that it takes up, d(m_a)/dt u, with its derivatives by velocity and direction, the rate as it is.
///
/// Water entry by the momentum of the added mass ([VON-KARMAN-1929; FALTINSEN-1990 9.2;
/// DNV-RP-H103 3.2.9; DNV-RP-C205 8], C_s = 2 / (rho A_p) dA33/dh): on entry alone, as water that is left behind
/// gives nothing back.
pub(super) fn slam_load(
    half: &RodElement,
    t: &Vector3<f64>,
    fluid: &FluidState,
    velocity: &Vector3<f64>,
    rate: f64,
) -> HalfLoad {
    let u = velocity - fluid.velocity;
    let across = fluid.density * half.added[0] * rate;
    let more = fluid.density * half.added[1] * rate - across;
    let along = u.dot(t);
    HalfLoad {
        force: u * across + t * (more * along),
        by_velocity: Matrix3::identity() * across + t * t.transpose() * more,
        by_acceleration: Matrix3::zeros(),
        by_direction: t * u.transpose() * more + Matrix3::identity() * (more * along),
    }
}

/// Least height over which anything comes out of the water (m): far thinner than a line, and thick enough that a slope
/// over it is a number.
const MIN_DIAMETER: f64 = 1e-6;

/// SubmergedVolume share of a prism of a `height` whose middle lies `depth` below the surface (m), and its slope.
pub(super) fn wet_prism(depth: f64, height: f64) -> (f64, f64) {
    let height = height.max(MIN_DIAMETER);
    let share = depth / height + 0.5;
    if (0.0..1.0).contains(&share) { (share, 1.0 / height) } else { (share.clamp(0.0, 1.0), 0.0) }
}

/// SubmergedVolume share of a section of a `width` whose middle lies `depth` below the surface (m): a cubic near the segment of the
/// circle (they differ by 0.04 at most), whose slope has no jump. With its first and second derivative by depth over
/// width, and its integral.
fn wet_section(depth: f64, width: f64) -> [f64; 4] {
    let s = depth / width + 0.5;
    if s <= 0.0 {
        [0.0; 4]
    } else if s < 1.0 {
        [s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s), 6.0 - 12.0 * s, s * s * s * (1.0 - 0.5 * s)]
    } else {
        [1.0, 0.0, 0.0, s - 0.5]
    }
}

/// Ends of a length that differ in depth by less than this share of its diameter are taken as a level length: the two
/// points of Gauss are then good to 1e-7, and differences of integrals over it to the same.
const LEVEL_SLOPE: f64 = 1e-3;
/// Places of Gauss's two points on a length of one.
const GAUSS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// SubmergedVolume share of a length whose ends lie `a` and `b` below the surface (m, negative above), and its slopes by a and b.
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
    share_across_surface(a, b, diameter)
}

/// The same where the length is neither wet nor dry all along.
#[inline(never)]
fn share_across_surface(a: f64, b: f64, diameter: f64) -> (f64, f64, f64) {
    let width = diameter.max(MIN_DIAMETER);
    if (a - b).abs() < LEVEL_SLOPE * width {
        return GAUSS.iter().fold((0.0, 0.0, 0.0), |(share, by_a, by_b), g| {
            let at = wet_section(b + (a - b) * g, width);
            (share + 0.5 * at[0], by_a + 0.5 * g * at[1] / width, by_b + 0.5 * (1.0 - g) * at[1] / width)
        });
    }
    let (at_a, at_b) = (wet_section(a, width), wet_section(b, width));
    let share = (at_a[3] - at_b[3]) * width / (a - b);
    (share, (at_a[0] - share) / (a - b), (share - at_b[0]) / (a - b))
}

/// Second derivatives of [`wet_share`]: by a twice, by a and b, by b twice.
fn wet_curvature(a: f64, b: f64, diameter: f64) -> [f64; 3] {
    let width = diameter.max(MIN_DIAMETER);
    if (a - b).abs() < LEVEL_SLOPE * width {
        return GAUSS.iter().fold([0.0; 3], |sum, g| {
            let bend = 0.5 * wet_section(b + (a - b) * g, width)[2] / (width * width);
            [sum[0] + g * g * bend, sum[1] + g * (1.0 - g) * bend, sum[2] + (1.0 - g) * (1.0 - g) * bend]
        });
    }
    let (_, by_a, by_b) = wet_share(a, b, diameter);
    let slope = |depth| wet_section(depth, width)[1] / width;
    [(slope(a) - 2.0 * by_a) / (a - b), (by_a - by_b) / (a - b), (2.0 * by_b - slope(b)) / (a - b)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::section::RodSegment;
    use crate::{Attachment, Rod};

    fn element() -> RodElement {
        let segment = RodSegment {
            drag_normal: 1.2,
            drag_tangential: 0.1,
            added_normal: 1.0,
            added_tangential: 0.3,
            wind_drag: 1.1,
            ..RodSegment::line(10.0, 1, 50.0, 1e8, 0.3)
        };
        Rod::new("test", vec![segment], Vec::<Attachment>::new()).unwrap().elements[0].clone()
    }

    #[test]
    fn fluid_load_derivatives_match_finite_differences() {
        let half = element();
        let fluid = FluidState {
            velocity: Vector3::new(1.0, -0.3, 0.2),
            acceleration: Vector3::new(0.4, 0.1, -0.5),
            surface: 0.0,
            head: 0.0,
            density: 1025.0,
            wind: Vector3::new(9.0, 4.0, -2.0),
            air_density: 1.226,
        };
        let (t, v, a) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.2, 0.7, -1.0), Vector3::new(0.3, -0.2, 0.9));
        type LoadFunction = fn(&RodElement, Vector3<f64>, &FluidState, Vector3<f64>, Vector3<f64>) -> HalfLoad;
        let loads: [LoadFunction; 3] = [
            |half, t, fluid, v, a| half_load(half, &t, fluid, &v, &a, 9.81),
            |half, t, fluid, v, _| wind_load(half, &t, fluid, &v),
            |half, t, fluid, v, _| slam_load(half, &t, fluid, &v, 0.7),
        ];
        for (load, i) in loads.into_iter().flat_map(|load| [0, 1, 2].map(|i| (load, i))) {
            let at = |t: Vector3<f64>, v: Vector3<f64>, a: Vector3<f64>| load(&half, t, &fluid, v, a);
            let whole = at(t, v, a);
            let h = 1e-6;
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
    fn wet_share_is_submerged_length_with_its_slopes() {
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
            let found = wet_curvature(a, b, 0.2);
            let slopes = |a: f64, b: f64| [wet_share(a, b, 0.2).1, wet_share(a, b, 0.2).2];
            let by_a = [0, 1].map(|i| (slopes(a + h, b)[i] - slopes(a - h, b)[i]) / (2.0 * h));
            let by_b = [0, 1].map(|i| (slopes(a, b + h)[i] - slopes(a, b - h)[i]) / (2.0 * h));
            // and of slopes of order ten, with a jump of their own slope of 6 / D^2 h at the edge of the section
            for (made, wanted) in found.iter().zip([by_a[0], by_a[1], by_b[1]]) {
                assert!((made - wanted).abs() < 1e-5 * (1.0 + wanted.abs()), "{a} {b}: {found:?} {by_a:?} {by_b:?}");
            }
            assert!((by_a[1] - by_b[0]).abs() < 1e-5 * (1.0 + by_b[0].abs()));
        }
    }

    #[test]
    fn wet_share_of_section_approximates_circle_segment() {
        for i in 0..=20 {
            let s = i as f64 / 20.0;
            let angle = (1.0 - 2.0 * s).acos();
            let circle = (angle - 0.5 * (2.0 * angle).sin()) / std::f64::consts::PI;
            // the cubic has half of it at half, and the slope 1.5 for the chord's 4 / pi
            assert!((wet_share((s - 0.5) * 0.3, (s - 0.5) * 0.3, 0.3).0 - circle).abs() < 0.045, "{s} {circle}");
        }
    }
}
