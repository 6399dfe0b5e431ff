//! The law of a zero-length spring in element axes: which part of a displacement deflects which spring, when none acts, friction, dashpots.
//!
//! Source: [MOSES-FLEX GSPR, FOUNDATION, LMU, ROLLER] and [MOSES-REF cls_res] (GAP).

use super::spring_law::{Dashpot, SpringGroup, rubbing};
use nalgebra::{Matrix3, Matrix6, Vector2, Vector3, Vector6};
use windlass_base::choices;
use windlass_model::Note;

choices! {
    /// The direction in which an element acts.
    pub enum Sense {
        /// None while the X displacement is negative.
        Tension = "TENSION",
        /// None while the X displacement is positive.
        Compression = "COMPRESSION",
        /// Always.
        Both = "BOTH",
    }
}

impl Sense {
    /// Whether a value along X, a displacement or a force, is of the sign in which it acts; zero is.
    fn acts_at(self, x: f64) -> bool {
        match self {
            Sense::Tension => x >= 0.0,
            Sense::Compression => x <= 0.0,
            Sense::Both => true,
        }
    }
}

/// How displacements deflect the springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactGeometry {
    /// As they are.
    Whole,
    /// A pin in a cone whose axis is X, its mouth at the origin, opening toward +X.
    Cone {
        /// Length of the cone (m).
        length: f64,
        /// Tangent of its angle.
        tangent: f64,
    },
    /// Gaps below and above in Y and Z (m), inside of which no spring is deflected; `None`: no rollers there.
    Gaps([Option<[f64; 2]>; 2]),
}

/// A deflection that follows from a displacement.
struct Deflection {
    /// Of the springs X, Y, Z (m).
    at: Vector3<f64>,
    /// Its derivative by the displacement.
    slopes: Matrix3<f64>,
    /// Which springs touch; a dashpot acts with its spring.
    touches: [bool; 3],
    outside: bool,
}

impl ContactGeometry {
    /// `None` where nothing touches.
    fn deflection(&self, u: &Vector3<f64>) -> Option<Deflection> {
        match self {
            ContactGeometry::Whole => {
                Some(Deflection { at: *u, slopes: Matrix3::identity(), touches: [true; 3], outside: false })
            }
            ContactGeometry::Cone { length, tangent } => in_cone(u, *length, *tangent),
            ContactGeometry::Gaps(gaps) => {
                let mut made = Deflection { at: *u, slopes: Matrix3::identity(), touches: [true; 3], outside: false };
                for (axis, gap) in gaps.iter().enumerate().map(|(i, gap)| (i + 1, gap)) {
                    let free = gap.map_or(u[axis], |[below, above]| u[axis].clamp(-below, above));
                    made.at[axis] = u[axis] - free;
                    // without gaps a pair of rollers holds also what stands between them
                    let touches = made.at[axis] != 0.0 || *gap == Some([0.0, 0.0]);
                    made.slopes[(axis, axis)] = f64::from(u8::from(touches));
                    if let Some(slot) = made.touches.get_mut(axis) {
                        *slot = touches;
                    }
                }
                Some(made)
            }
        }
    }
}

/// [MOSES-FLEX LMU] with two of its signs mended: the side deformation is d = max(0, D_h - T max(0, LEN - D_v)), the vertical one
/// c = max(0, D_v - LEN) + T d, a compression.
fn in_cone(u: &Vector3<f64>, length: f64, tangent: f64) -> Option<Deflection> {
    let below = -u.x;
    if below < 0.0 {
        return None;
    }
    let side = Vector3::new(0.0, u.y, u.z);
    let off = side.norm();
    let room = tangent * (length - below).max(0.0);
    let d = (off - room).max(0.0);
    let c = (below - length).max(0.0) + tangent * d;
    let n = side.try_normalize(0.0).unwrap_or_default();
    let mut slopes = Matrix3::zeros();
    // a pin on the ground of the cone has no room: a spring holds it also where it stands on the axis
    let touches = d > 0.0 || room == 0.0;
    if touches {
        let lateral = Matrix3::from_diagonal(&Vector3::new(0.0, 1.0, 1.0));
        // d n with d' = n along the side and T along the depth while the cone narrows
        let by_x = if below < length { -tangent } else { 0.0 };
        let across = if off > 0.0 { d / off } else { 1.0 };
        slopes = (lateral - n * n.transpose()) * across + n * n.transpose();
        slopes.set_column(0, &(n * by_x));
        let by_side = n * -tangent;
        slopes[(0, 1)] = by_side.y;
        slopes[(0, 2)] = by_side.z;
        slopes[(0, 0)] = -tangent * by_x;
    }
    if below > length {
        slopes[(0, 0)] += 1.0;
    }
    let outside = below <= length && off > tangent * length;
    let side = d * n;
    Some(Deflection { at: Vector3::new(-c, side.y, side.z), slopes, touches: [c > 0.0, touches, touches], outside })
}

/// What limits or makes a lateral force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// Nothing.
    None,
    /// The lateral springs reach at most MU |Fx| [MOSES-FLEX -FRICTION].
    Limit(f64),
    /// MU |Fx| against the velocity; no lateral springs [MOSES-FLEX -FRICTION].
    Rate(f64),
    /// Coulomb's: a stiff spring (N/m) from where it last stuck, at most MU |Fx|; its state is that place (Y, Z).
    Stick {
        /// Coefficient.
        mu: f64,
        /// Stiffness while it sticks (N/m).
        stiffness: f64,
    },
}

/// Forces in element axes against displacements, rates and states.
#[derive(Clone, Debug)]
pub struct ZeroLaw {
    /// When it acts.
    pub sense: Sense,
    /// What is deflected.
    pub contact: ContactGeometry,
    /// Springs.
    pub groups: Vec<SpringGroup>,
    /// Dashpots and the axes they act in; two axes: their resultant.
    pub dashpots: Vec<(Dashpot, [bool; 3])>,
    /// Friction in Y and Z.
    pub friction: Friction,
    /// Whether spring and dashpot together never pull along X.
    pub pushes_only: bool,
}

/// What the law answers.
pub struct LawResponse {
    /// Forces and moments on the holder, element axes, positive where the other end is drawn near (N, N m).
    pub force: Vector6<f64>,
    /// Deflections they belong to (m, rad).
    pub deflection: Vector6<f64>,
    /// Derivative of the forces by displacement and rotation.
    pub slopes: Matrix6<f64>,
    /// Derivative of the forces X, Y, Z by the rates (N s/m).
    pub by_rate: Matrix3<f64>,
    /// What a user should know.
    pub notes: Vec<Note>,
}

impl ZeroLaw {
    /// Number of values of its state.
    pub fn states(&self) -> usize {
        let stuck = if matches!(self.friction, Friction::Stick { .. }) { 2 } else { 0 };
        self.groups.iter().map(SpringGroup::states).sum::<usize>() + stuck
    }

    /// The largest stiffness (N/m, N m/rad) of a law that is linear and acts both ways everywhere, from springs alone.
    pub fn linear_stiffness(&self) -> Option<f64> {
        let plain = self.sense == Sense::Both
            && self.contact == ContactGeometry::Whole
            && self.friction == Friction::None
            && self.dashpots.is_empty()
            && !self.pushes_only
            && self.groups.iter().all(|g| g.viscous.is_none());
        let stiffnesses: Option<Vec<f64>> = self.groups.iter().map(|g| g.elastic.constant_stiffness()).collect();
        stiffnesses.filter(|_| plain)?.into_iter().reduce(f64::max)
    }

    /// Forces (N, N m; element axes) at a displacement and rotation `q` (m, rad); the step (s) is `None` in statics.
    pub fn evaluate(
        &self,
        q: &Vector6<f64>,
        rate: &Vector3<f64>,
        dt: Option<f64>,
        committed: &[f64],
        trial: &mut [f64],
    ) -> LawResponse {
        let u = q.fixed_rows::<3>(0).into_owned();
        let mut answer = LawResponse {
            force: Vector6::zeros(),
            deflection: *q,
            slopes: Matrix6::zeros(),
            by_rate: Matrix3::zeros(),
            notes: Vec::new(),
        };
        let deflection = if self.sense.acts_at(u.x) { self.contact.deflection(&u) } else { None };
        let Some(deflection) = deflection else { return self.release(&u, dt, committed, trial, answer) };
        answer.deflection.fixed_rows_mut::<3>(0).copy_from(&deflection.at);
        if deflection.outside {
            answer.notes.push(Note::warning("the tip of the pin stands outside of the cone's mouth"));
        }
        let mut by_deflection = Matrix6::zeros();
        let mut from = 0;
        for group in &self.groups {
            let to = from + group.states();
            let (old, new) = (committed.get(from..to), trial.get_mut(from..to));
            let (old, new) = (old.unwrap_or_default(), new.unwrap_or_default());
            group.evaluate(&answer.deflection, dt, old, new, &mut answer.force, &mut by_deflection);
            from = to;
        }
        // a spring that has not recovered yet does not pull where the element only pushes
        if !self.sense.acts_at(answer.force.x) {
            answer.force = Vector6::zeros();
            return self.release(&u, dt, committed, trial, answer);
        }
        answer.slopes = by_deflection;
        let k_u = by_deflection.fixed_view::<3, 3>(0, 0) * deflection.slopes;
        let mut force = answer.force.fixed_rows::<3>(0).into_owned();
        let mut slopes = k_u;
        if !self.pushes_only {
            self.add_friction(&u, rate, dt.is_some(), committed, trial, (&mut force, &mut slopes, &mut answer.by_rate));
        }
        if dt.is_some() {
            let [x, y, z] = deflection.touches;
            for (dashpot, [in_x, in_y, in_z]) in &self.dashpots {
                let (more, slope) = dashpot.evaluate(rate, [*in_x && x, *in_y && y, *in_z && z]);
                force += more;
                answer.by_rate += slope;
            }
        }
        if self.pushes_only {
            if force.x > 0.0 {
                force.x = 0.0;
                slopes.row_mut(0).fill(0.0);
                answer.by_rate.row_mut(0).fill(0.0);
            }
            // what rubs is pressed on by spring and dashpot together
            self.add_friction(&u, rate, dt.is_some(), committed, trial, (&mut force, &mut slopes, &mut answer.by_rate));
        }
        answer.force.fixed_rows_mut::<3>(0).copy_from(&force);
        answer.slopes.fixed_view_mut::<3, 3>(0, 0).copy_from(&slopes);
        answer
    }

    /// No force: what remembers recovers, and a later contact begins where it is made.
    fn release(
        &self,
        u: &Vector3<f64>,
        dt: Option<f64>,
        committed: &[f64],
        trial: &mut [f64],
        none: LawResponse,
    ) -> LawResponse {
        let mut from = 0;
        for group in &self.groups {
            let to = from + group.states();
            if let (Some(old), Some(new)) = (committed.get(from..to), trial.get_mut(from..to)) {
                group.release(dt, old, new);
            }
            from = to;
        }
        if let Some([y, z]) = trial.get_mut(from..) {
            (*y, *z) = (u.y, u.z);
        }
        none
    }

    /// Friction: changes the lateral forces and their derivatives by displacement and rate.
    fn add_friction(
        &self,
        u: &Vector3<f64>,
        rate: &Vector3<f64>,
        moving: bool,
        committed: &[f64],
        trial: &mut [f64],
        (force, slopes, by_rate): (&mut Vector3<f64>, &mut Matrix3<f64>, &mut Matrix3<f64>),
    ) {
        let lateral = Matrix3::from_diagonal(&Vector3::new(0.0, 1.0, 1.0));
        let along_x = slopes.row(0).into_owned() * force.x.signum();
        let rate_of_x = by_rate.row(0).into_owned() * force.x.signum();
        match self.friction {
            Friction::None => {}
            Friction::Limit(mu) => {
                let side = lateral * *force;
                limit(mu * force.x.abs(), &(along_x * mu), &side, &(lateral * *slopes), force, slopes);
            }
            Friction::Rate(mu) => {
                if moving {
                    let (n, by) = rubbing(&(lateral * rate));
                    let most = mu * force.x.abs();
                    *force += n * most;
                    *slopes += n * along_x * mu;
                    *by_rate += lateral * by * lateral * most + n * rate_of_x * mu;
                }
            }
            Friction::Stick { mu, stiffness } => {
                let from: usize = self.groups.iter().map(SpringGroup::states).sum();
                let stuck = committed.get(from..).and_then(|s| Some(Vector2::new(*s.first()?, *s.get(1)?)));
                let stuck = stuck.unwrap_or_default();
                let side = Vector3::new(0.0, stiffness * (u.y - stuck.x), stiffness * (u.z - stuck.y));
                force.y = side.y;
                force.z = side.z;
                *slopes += lateral * stiffness;
                let own = lateral * stiffness;
                limit(mu * force.x.abs(), &(along_x * mu), &side, &own, force, slopes);
                if let Some([y, z]) = trial.get_mut(from..) {
                    *y = u.y - force.y / stiffness;
                    *z = u.z - force.z / stiffness;
                }
            }
        }
    }
}

/// Shortens a lateral force to a largest size, whose derivative is `most_slope`; `own` is the derivative of the force before.
fn limit(
    most: f64,
    most_slope: &nalgebra::RowVector3<f64>,
    side: &Vector3<f64>,
    own: &Matrix3<f64>,
    force: &mut Vector3<f64>,
    slopes: &mut Matrix3<f64>,
) {
    let size = side.norm();
    if size <= most || size == 0.0 {
        return;
    }
    let n = side / size;
    let short = n * most;
    let by = n * most_slope + (Matrix3::identity() - n * n.transpose()) * own * (most / size);
    force.y = short.y;
    force.z = short.z;
    for row in 1..3 {
        slopes.set_row(row, &by.row(row));
    }
}
