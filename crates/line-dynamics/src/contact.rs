//! Seabed contact and seabed friction of a node of a dynamic line in time, with their derivatives.
//!
//! Normal reaction: a spring and a dashpot per contact area, the stiffness growing from zero over a small penetration. Friction:
//! Coulomb, with coefficients along the line and across it, mobilised over a displacement from the stick point and over a speed.
//! At rest friction is that of `statics_friction` and `stick_friction` instead.

use super::environment::{SeabedLaw, SeabedPush, SeabedShape};
use nalgebra::{Matrix3, Vector3};

/// Force of the bottom on a node with its derivatives.
pub(super) struct SeabedContact {
    /// The force on the node (N): normal part, and friction.
    pub force: [Vector3<f64>; 2],
    /// The force that its elastic energy makes (N): another than the push where that is straight up on a slope.
    pub elastic: Vector3<f64>,
    /// Derivative of their sum by the position (N/m).
    pub by_position: Matrix3<f64>,
    /// Derivative of their sum by the velocity (N s/m).
    pub by_velocity: Matrix3<f64>,
}

/// A place below the bottom.
struct Penetration {
    /// The direction in which the bottom pushes.
    normal: Vector3<f64>,
    /// How far below it the place is, against that direction (m).
    depth: f64,
    /// Derivative of the depth by the place.
    by_place: Vector3<f64>,
}

fn penetration(bottom: &dyn SeabedShape, push: SeabedPush, x: &Vector3<f64>) -> Option<Penetration> {
    let (height, slope) = bottom.height(x.x, x.y);
    if x.z >= height {
        return None;
    }
    let outward = Vector3::new(-slope[0], -slope[1], 1.0);
    Some(match push {
        SeabedPush::Normal => {
            let normal = outward.normalize();
            Penetration { normal, depth: (height - x.z) * normal.z, by_place: -normal }
        }
        SeabedPush::Vertical => Penetration { normal: Vector3::z(), depth: height - x.z, by_place: -outward },
    })
}

/// Contact force per stiffness at a penetration, with two derivatives by it, and the energy per stiffness. The stiffness has its full
/// value from a penetration `soft` on (m).
struct ContactForce {
    depth: f64,
    share: f64,
    bend: f64,
    energy: f64,
}

fn contact_force(depth: f64, soft: f64) -> ContactForce {
    if depth < soft {
        let energy = depth.powi(3) / (6.0 * soft);
        return ContactForce { depth: 0.5 * depth * depth / soft, share: depth / soft, bend: 1.0 / soft, energy };
    }
    let energy = 0.5 * depth * depth - 0.5 * soft * depth + soft * soft / 6.0;
    ContactForce { depth: depth - 0.5 * soft, share: 1.0, bend: 0.0, energy }
}

/// Elastic energy of the bottom under a node (J); `soft` as in [`contact`].
pub(super) fn energy(bottom: &dyn SeabedShape, ground: &SeabedLaw, soft: f64, area: f64, x: &Vector3<f64>) -> f64 {
    penetration(bottom, ground.push, x)
        .map_or(0.0, |found| ground.stiffness * area * contact_force(found.depth, soft).energy)
}

/// A vector no longer than one, and its derivative by the vector or, unless `exact`, the secant.
fn cap_to_unit(u: &Vector3<f64>, exact: bool) -> (Vector3<f64>, Matrix3<f64>) {
    let size = u.norm();
    if size <= 1.0 {
        return (*u, Matrix3::identity());
    }
    let made = u / size;
    let turned = if exact { made * made.transpose() } else { Matrix3::zeros() };
    (made, (Matrix3::identity() - turned) / size)
}

/// Where a node sticks from then on that has stuck at a place and is now at `x`.
pub(super) fn update_stick_point(
    bottom: &dyn SeabedShape,
    ground: &SeabedLaw,
    x: &Vector3<f64>,
    stuck: &Vector3<f64>,
) -> Vector3<f64> {
    let Some(Penetration { normal, .. }) = penetration(bottom, ground.push, x) else { return *x };
    let way = x - stuck;
    let (held, _) = cap_to_unit(&((way - normal * way.dot(&normal)) / ground.friction_travel), true);
    x - held * ground.friction_travel
}

/// Normal reaction of the bottom on a node at rest.
pub(super) struct NormalReaction {
    /// Force (N), normal to the bottom, with the normal.
    pub force: f64,
    pub normal: Vector3<f64>,
    /// Derivative of the force by the penetration (N/m).
    pub by_depth: f64,
}

/// Normal reaction on a node; `soft` and `area` as in [`contact`]. None above the bottom.
pub(super) fn normal_reaction(
    bottom: &dyn SeabedShape,
    ground: &SeabedLaw,
    soft: f64,
    area: f64,
    x: &Vector3<f64>,
) -> Option<NormalReaction> {
    let Penetration { normal, depth, .. } = penetration(bottom, ground.push, x)?;
    let (spring, k) = (contact_force(depth, soft), ground.stiffness * area);
    Some(NormalReaction { force: k * spring.depth, normal, by_depth: k * spring.share })
}

/// What the bottom does to a node with a shadow of `area` (m2) whose rod runs in direction `lay`; none when it is
/// clear of it. Its stiffness is whole from a penetration `soft` on (m).
///
/// Friction that is whole grows no more, so Newton's tangent of it overshoots a stop. Unless `exact`, its derivatives
/// are by the secant, the slope from sticking, which bounds the force from above and cannot.
///
/// The curvature of the bottom within the penetration is left out of the derivatives.
#[inline]
#[expect(clippy::too_many_arguments, reason = "a contact has that many causes")]
pub(super) fn contact(
    bottom: &dyn SeabedShape,
    ground: &SeabedLaw,
    soft: f64,
    area: f64,
    x: &Vector3<f64>,
    v: &Vector3<f64>,
    lay: &Vector3<f64>,
    stuck: &Vector3<f64>,
    exact: bool,
) -> Option<SeabedContact> {
    let Penetration { normal, depth, by_place } = penetration(bottom, ground.push, x)?;
    let ContactForce { depth: penetration, share, bend, .. } = contact_force(depth, soft);
    let sinking = -v.dot(&normal);
    let (k, c) = (ground.stiffness * area, ground.damping * area);
    let support = k * penetration + c * share * sinking;
    if support <= 0.0 {
        return None;
    }
    let outer = normal * normal.transpose();
    let (by_depth, by_sinking) = (k * share + c * bend * sinking, c * share);
    let mut made = SeabedContact {
        force: [normal * support, Vector3::zeros()],
        elastic: by_place * (-k * penetration),
        by_position: normal * by_place.transpose() * by_depth,
        by_velocity: outer * -by_sinking,
    };
    if ground.rough() {
        let along = (lay - normal * lay.dot(&normal)).try_normalize(1e-9).unwrap_or_else(Vector3::zeros);
        let (aa, flat) = (along * along.transpose(), Matrix3::identity() - outer);
        let (mu_a, mu_c) = (ground.friction_along, ground.friction_across);
        let mu = if along == Vector3::zeros() { flat * mu_a.max(mu_c) } else { aa * mu_a + (flat - aa) * mu_c };
        if let Some(rate) = ground.friction_damping {
            // what the support has to do with it: nothing below its limit, all of it beyond
            let own = flat * v * (rate * area / support);
            let (rubbed, by_speed) = cap_to_unit(&own, exact);
            let by_support = if own.norm() > 1.0 { -(mu * rubbed) } else { Vector3::zeros() };
            made.force[1] = -(mu * rubbed) * support;
            made.by_position += by_support * by_place.transpose() * by_depth;
            made.by_velocity -= mu * by_speed * flat * (rate * area) + by_support * normal.transpose() * by_sinking;
            return Some(made);
        }
        let (held, by_way) = cap_to_unit(&(flat * (x - stuck) / ground.friction_travel), exact);
        let (rubbed, by_both) = cap_to_unit(&(held + flat * v / ground.friction_speed), exact);
        let (pull, stiff) = (-(mu * rubbed), mu * by_both * -support);
        made.force[1] = pull * support;
        made.by_position += stiff * by_way * flat / ground.friction_travel + pull * by_place.transpose() * by_depth;
        made.by_velocity += stiff * flat / ground.friction_speed - pull * normal.transpose() * by_sinking;
    }
    Some(made)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PlaneBottom;

    #[test]
    fn contact_and_friction_derivatives_match_finite_differences() {
        let bottom = PlaneBottom { height: -3.0, slope: [0.2, -0.1] };
        let ground = SeabedLaw {
            stiffness: 1e5,
            damping: 1e3,
            penetration_scale: 0.02,
            friction_along: 0.4,
            friction_across: 0.9,
            friction_speed: 0.05,
            friction_travel: 0.02,
            friction_damping: None,
            push: SeabedPush::Normal,
        };
        let lay = Vector3::new(1.0, 0.3, 0.1);
        let stuck = Vector3::new(1.01, 2.02, -3.0);
        let whole = |ground: &SeabedLaw, x: Vector3<f64>, v: Vector3<f64>| {
            let made = contact(&bottom, ground, 0.02, 0.7, &x, &v, &lay, &stuck, true).unwrap();
            (made.force[0] + made.force[1], made)
        };
        let h = 1e-7;
        let vertical = SeabedLaw { push: SeabedPush::Vertical, ..ground };
        // below the limit of friction, and beyond it
        let damped = |rate: f64| SeabedLaw { friction_damping: Some(rate), ..vertical };
        let laws = [ground, vertical, damped(1e3), damped(1e6), SeabedLaw { push: SeabedPush::Normal, ..damped(1e6) }];
        for (ground, depth) in laws.iter().flat_map(|law| [(law, 0.01), (law, 0.05)]) {
            let whole = |x, v| whole(ground, x, v);
            let (x, v) = (Vector3::new(1.0, 2.0, -3.0 - depth), Vector3::new(0.03, -0.02, -0.01));
            let made = whole(x, v).1;
            for i in 0..3 {
                let mut e = Vector3::zeros();
                e[i] = h;
                let by_x = (whole(x + e, v).0 - whole(x - e, v).0) / (2.0 * h);
                let by_v = (whole(x, v + e).0 - whole(x, v - e).0) / (2.0 * h);
                // central differences of forces of order 1e3 N: rounding 1e-13 * 1e3 / 1e-7
                assert!((by_x - made.by_position.column(i)).norm() < 1e-2 * made.by_position.norm().max(1.0) * 1e-2);
                assert!((by_v - made.by_velocity.column(i)).norm() < 1e-4 * made.by_velocity.norm().max(1.0));
            }
        }
    }

    #[test]
    fn friction_by_speed_is_that_of_moordyn_and_push_is_straight_up() {
        let bottom = PlaneBottom { height: 0.0, slope: [0.3, 0.0] };
        // mu 0.5 and FricDamp 200 N s/m on a node with a shadow of 0.4 m2
        let ground = SeabedLaw {
            friction_along: 0.5,
            friction_across: 0.5,
            friction_damping: Some(200.0 / 0.4),
            push: SeabedPush::Vertical,
            ..SeabedLaw::elastic(1e5)
        };
        let x = Vector3::new(1.0, 0.0, 0.29);
        let at = |v| contact(&bottom, &ground, 0.0, 0.4, &x, &v, &Vector3::x(), &Vector3::zeros(), true).unwrap();
        // 1e5 N/m3 * 0.4 m2 * 0.01 m straight down; 200 * 0.5 * 0.3 m/s; 0.5 * 400 N from 2 m/s on
        for (speed, friction) in [(0.0, 0.0), (0.3, 30.0), (1.9, 190.0), (5.0, 200.0)] {
            let made = at(Vector3::new(0.0, speed, 0.0));
            assert!((made.force[0] - Vector3::z() * 400.0).norm() < 1e-9, "{}", made.force[0]);
            assert!((made.force[1] + Vector3::y() * friction).norm() < 1e-9, "{}", made.force[1]);
        }
    }

    #[test]
    fn fast_sliding_friction_is_mu_times_normal_force() {
        let bottom = PlaneBottom { height: 0.0, slope: [0.0, 0.0] };
        let ground =
            SeabedLaw { friction_along: 0.4, friction_across: 0.9, friction_speed: 1e-6, ..SeabedLaw::elastic(1e5) };
        let x = Vector3::new(0.0, 0.0, -0.01);
        let at = |v| contact(&bottom, &ground, 0.0, 1.0, &x, &v, &Vector3::x(), &x, true).unwrap();
        // 1e5 * 0.01 = 1000 N normal; v0 / v squared is 1e-12
        assert!((at(Vector3::new(1.0, 0.0, 0.0)).force[1].x + 400.0).abs() < 1e-6);
        assert!((at(Vector3::new(0.0, 1.0, 0.0)).force[1].y + 900.0).abs() < 1e-6);
    }
}
