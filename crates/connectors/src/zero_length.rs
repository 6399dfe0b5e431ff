//! The element of every zero-length class: from the poses of two ends to displacements in element axes, from a law there to wrenches
//! and their exact derivatives.
//!
//! The element axes R are fixed to the body of one end, the holder. With d from the holder's point to the other's, the displacement is
//! u = R^T d - rest, the rotation theta the rotation vector of the relative turn since the definition. A law with forces s(u, theta, ..)
//! conjugated to them exerts R s_u on the holder with the moment d x R s_u about its point, -R s_u on the other, and the moments
//! +-R J^-T s_theta with J the left Jacobian of SO(3) [SIMO-VUQUOC-1986; SOLA-2018 eq. 145]: what the virtual work of s asks.

use super::zero_law::{LawResponse, ZeroLaw};
use nalgebra::{Matrix3, Matrix6, Rotation3, SMatrix, UnitQuaternion, Vector3, Vector6};
use windlass_base::choice::{Choice, Dof};
use windlass_base::geometry::Place;
use windlass_model::{
    ClassError, Connection, ConnectorCategory, ConnectorElement, ConnectorResponse, ConnectorSummary, Note, Situation,
    SolverCache, SpringState, StiffTie, TieResponse,
};

type Wide = SMatrix<f64, 3, 12>;

/// Stiffness (N/m, N m/rad) from which on an engine may hold the force of a linear spring: rounding of places a kilometre away is then
/// a ten-thousandth of a newton.
const MIN_HELD_STIFFNESS: f64 = 1e9;
/// Deflection that is rounding where the ends are near the origin (m, rad).
const DEFLECTION_ROUNDING: f64 = 1e-13;

/// A connector of a zero-length class.
#[derive(Debug)]
pub struct ZeroLength {
    /// The end whose body carries the element axes.
    pub holder: usize,
    /// Element axes in that body.
    pub turn: Matrix3<f64>,
    /// The same axes at definition in the body of the other end.
    pub other_turn: Matrix3<f64>,
    /// Displacement without deflection, element axes (m).
    pub rest: Vector3<f64>,
    /// Forces in element axes.
    pub law: ZeroLaw,
    /// Degrees of freedom that reports list, with their allowable forces (N or N m).
    pub listed: Vec<(usize, Option<f64>)>,
    /// Whether it is a restraint.
    pub category: ConnectorCategory,
}

/// Element axes of a connector in the body of its holder, and at definition in that of the other end. `own` are the axes of the class
/// where `-EULER` does not turn them.
pub fn element_turns(connection: &Connection, holder: usize, own: Matrix3<f64>) -> (Matrix3<f64>, Matrix3<f64>) {
    let euler = connection.connector.euler.map_or(Matrix3::identity(), |turn| {
        let position = Place { turn, ..Default::default() };
        *position.rotation().matrix()
    });
    let turn = euler * own;
    let [first, second] = connection.connector.defined;
    let (held, other) = if holder == 0 { (first, second) } else { (second, first) };
    (turn, other.axes.transpose() * held.axes * turn)
}

/// Displacement in element axes between the ends of a connector when it was defined (m).
pub fn defined_displacement(connection: &Connection, turn: &Matrix3<f64>) -> Vector3<f64> {
    let [first, second] = connection.connector.defined;
    (first.axes * turn).transpose() * (second.origin - first.origin)
}

/// `[v]` with `[v] w = v x w`.
fn cross(v: &Vector3<f64>) -> Matrix3<f64> {
    v.cross_matrix()
}

/// c in `J^-1 = 1 - [t]/2 + c [t]2`, with c = (1 - (t/2) cot(t/2)) / t2, and its derivative by t2.
fn coefficient(square: f64) -> (f64, f64) {
    // below this the closed form loses more digits than the series
    if square < 0.25 {
        // |B_2n| / (2n)!
        let terms = [
            1.0 / 12.0,
            1.0 / 720.0,
            1.0 / 30_240.0,
            1.0 / 1_209_600.0,
            1.0 / 47_900_160.0,
            691.0 / 1_307_674_368_000.0,
            1.0 / 74_724_249_600.0,
        ];
        let mut sum = (0.0, 0.0);
        for term in terms.iter().rev() {
            sum = (term + square * sum.0, sum.0 + square * sum.1);
        }
        return sum;
    }
    let t = square.sqrt();
    let (sin, cos) = (0.5 * t).sin_cos();
    let c = (1.0 - 0.5 * t * cos / sin) / square;
    // c t2 = 1 - (t/2) cot(t/2)
    let slope = -0.5 * cos / sin + 0.25 * t / (sin * sin);
    (c, (slope / (2.0 * t) - c) / square)
}

/// How the ends stand to one another, in element axes.
struct RelativeMotion {
    /// Element axes, global.
    axes: Matrix3<f64>,
    /// From the holder's point to the other (m, global).
    apart: Vector3<f64>,
    /// Displacement and rotation (m, rad).
    q: Vector6<f64>,
    /// Rate of the displacement (m/s).
    rate: Vector3<f64>,
    /// The same in global axes, and the rotation of the holder (rad/s).
    spin: [Vector3<f64>; 2],
}

impl ZeroLength {
    fn motion(&self, at: &Situation) -> Result<RelativeMotion, ClassError> {
        let [first, second] = at.ends else { return Err(ClassError::new("a spring has two ends")) };
        let (held, other) = if self.holder == 0 { (first, second) } else { (second, first) };
        let axes = held.pose.axes * self.turn;
        let apart = other.pose.origin - held.pose.origin;
        let u = axes.transpose() * apart - self.rest;
        let relative = axes.transpose() * other.pose.axes * self.other_turn;
        let relative = Rotation3::from_matrix_unchecked(relative);
        let theta = UnitQuaternion::from_rotation_matrix(&relative).scaled_axis();
        let still = at.step.is_none();
        let part = |six: &Vector6<f64>, from: usize| six.fixed_rows::<3>(from).into_owned();
        let turning = part(&held.velocity, 3);
        let moving = part(&other.velocity, 0) - part(&held.velocity, 0) - turning.cross(&apart);
        let zero = Vector3::zeros();
        let (moving, turning) = if still { (zero, zero) } else { (moving, turning) };
        let mut q = Vector6::zeros();
        q.fixed_rows_mut::<3>(0).copy_from(&u);
        q.fixed_rows_mut::<3>(3).copy_from(&theta);
        Ok(RelativeMotion { axes, apart, q, rate: axes.transpose() * moving, spin: [moving, turning] })
    }

    fn evaluate_law(
        &self,
        at: &Situation,
        committed: &[f64],
        trial: &mut [f64],
    ) -> Result<(RelativeMotion, LawResponse), ClassError> {
        let motion = self.motion(at)?;
        let answer = self.law.evaluate(&motion.q, &motion.rate, at.step.map(|s| s.dt), committed, trial);
        Ok((motion, answer))
    }

    /// The wrenches on both ends, in their order, of forces in element axes.
    fn wrenches_of(&self, motion: &RelativeMotion, force: &Vector6<f64>) -> [Vector6<f64>; 2] {
        let theta = motion.q.fixed_rows::<3>(3).into_owned();
        let (c, _) = coefficient(theta.norm_squared());
        let turn = cross(&theta);
        let back = Matrix3::identity() + turn * 0.5 + turn * turn * c;
        let g = motion.axes * force.fixed_rows::<3>(0);
        let moment = motion.axes * (back * force.fixed_rows::<3>(3));
        let made = [join_halves(&g, &(motion.apart.cross(&g) + moment)), join_halves(&-g, &-moment)];
        if self.holder == 0 { made } else { [made[1], made[0]] }
    }

    /// How displacement and rotation change with the motions of both ends, in their order.
    fn deflection_derivatives(&self, motion: &RelativeMotion) -> [Matrix6<f64>; 2] {
        let rt = motion.axes.transpose();
        let theta = motion.q.fixed_rows::<3>(3).into_owned();
        let (c, _) = coefficient(theta.norm_squared());
        let turn = cross(&theta);
        let forth = Matrix3::identity() - turn * 0.5 + turn * turn * c;
        let (mut held, mut other) = (Matrix6::zeros(), Matrix6::zeros());
        held.fixed_view_mut::<3, 3>(0, 0).copy_from(&-rt);
        held.fixed_view_mut::<3, 3>(0, 3).copy_from(&(rt * cross(&motion.apart)));
        held.fixed_view_mut::<3, 3>(3, 3).copy_from(&-(forth * rt));
        other.fixed_view_mut::<3, 3>(0, 0).copy_from(&rt);
        other.fixed_view_mut::<3, 3>(3, 3).copy_from(&(forth * rt));
        if self.holder == 0 { [held, other] } else { [other, held] }
    }

    /// Writes forces and moments on both ends and their derivatives.
    fn write_response(&self, motion: &RelativeMotion, answer: &LawResponse, out: &mut ConnectorResponse) {
        let RelativeMotion { axes: r, apart, q, spin: [moving, turning], .. } = motion;
        let rt = r.transpose();
        let part = |six: &Vector6<f64>, from: usize| six.fixed_rows::<3>(from).into_owned();
        let (g, s_theta, theta) = (r * part(&answer.force, 0), part(&answer.force, 3), part(q, 3));

        // moments: h = J^-T s = s + t x s / 2 + c t x (t x s)
        let (c, c_slope) = coefficient(theta.norm_squared());
        let turn = cross(&theta);
        let back = Matrix3::identity() + turn * 0.5 + turn * turn * c; // J^-T
        let forth = back.transpose(); // J^-1
        let twice = theta.cross(&theta.cross(&s_theta));
        let h_by_theta = cross(&s_theta) * -0.5 + twice * theta.transpose() * (2.0 * c_slope)
            - (cross(&theta.cross(&s_theta)) + turn * cross(&s_theta)) * c;
        let moment = r * (back * s_theta);

        // columns: translation and rotation of the holder, then of the other
        let one = Matrix3::identity();
        let block = |parts: [Matrix3<f64>; 4]| {
            let mut wide = Wide::zeros();
            for (i, part) in parts.iter().enumerate() {
                wide.fixed_columns_mut::<3>(3 * i).copy_from(part);
            }
            wide
        };
        let zero = Matrix3::zeros();
        let d_apart = block([-one, zero, one, zero]);
        let d_spin = block([zero, one, zero, zero]);
        let d_u = rt * (d_apart + cross(apart) * d_spin);
        let d_theta = forth * rt * block([zero, -one, zero, one]);
        let d_rate = rt * (cross(moving) * d_spin - cross(turning) * d_apart);
        let k_u = answer.slopes.fixed_view::<3, 3>(0, 0).into_owned();
        let k_theta = answer.slopes.fixed_view::<3, 3>(3, 3).into_owned();

        let d_g = r * (k_u * d_u + answer.by_rate * d_rate) - cross(&g) * d_spin;
        let d_moment = r * ((back * k_theta + h_by_theta) * d_theta) - cross(&moment) * d_spin;
        let d_held = cross(apart) * d_g - cross(&g) * d_apart + d_moment;
        let held = apart.cross(&g) + moment;

        out.clear(2);
        let order = if self.holder == 0 { [0, 1] } else { [1, 0] };
        let wrenches = [join_halves(&g, &held), join_halves(&-g, &-moment)];
        let slopes = [[d_g, d_held], [-d_g, -d_moment]];
        for (own, end) in order.iter().enumerate() {
            if let (Some(slot), Some(w)) = (out.wrench.get_mut(*end), wrenches.get(own)) {
                *slot = *w;
            }
        }
        write_blocks(&slopes, order, &mut out.stiffness);
        if answer.by_rate != zero {
            let by_rate = r * answer.by_rate * d_u;
            out.damping.resize(4, Matrix6::zeros());
            write_blocks(&[[by_rate, cross(apart) * by_rate], [-by_rate, Wide::zeros()]], order, &mut out.damping);
        }
    }
}

fn join_halves(force: &Vector3<f64>, moment: &Vector3<f64>) -> Vector6<f64> {
    Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

/// Negative derivatives of the wrenches as blocks in the order of the ends.
fn write_blocks(slopes: &[[Wide; 2]; 2], order: [usize; 2], blocks: &mut [Matrix6<f64>]) {
    for (own, end) in slopes.iter().zip(order) {
        for (column, other) in order.iter().enumerate() {
            let Some(block) = blocks.get_mut(2 * end + other) else { continue };
            for (row, half) in own.iter().enumerate() {
                block.fixed_rows_mut::<3>(3 * row).copy_from(&-half.fixed_columns::<6>(6 * column));
            }
        }
    }
}

impl ConnectorElement for ZeroLength {
    fn states(&self) -> usize {
        self.law.states()
    }

    fn evaluate(
        &self,
        at: &Situation,
        committed: &[f64],
        trial: &mut [f64],
        _: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        let (motion, answer) = self.evaluate_law(at, committed, trial)?;
        self.write_response(&motion, &answer, out);
        let blocks = out.stiffness.iter().chain(&out.damping).flat_map(|b| b.iter());
        if out.wrench.iter().flat_map(|w| w.iter()).chain(blocks).any(|v| !v.is_finite()) {
            return Err(ClassError::new("the force of the spring, or its stiffness, is too large a number"));
        }
        Ok(())
    }

    fn summary(&self, at: &Situation, committed: &[f64]) -> Result<ConnectorSummary, ClassError> {
        let mut trial = committed.to_vec();
        let (motion, answer) = self.evaluate_law(at, committed, &mut trial)?;
        // the law knows the force on the holder
        let sign = if self.holder == 0 { 1.0 } else { -1.0 };
        let springs: Vec<SpringState> = self
            .listed
            .iter()
            .map(|(dof, allowable)| SpringState {
                dof: Dof::SIX.get(*dof).map_or("", |dof| dof.word()).to_string(),
                deflection: answer.deflection[*dof],
                force: sign * answer.force[*dof],
                allowable: *allowable,
            })
            .collect();
        let ratio = springs.iter().filter_map(|s| s.allowable.map(|most| s.force.abs() / most)).reduce(f64::max);
        let mut notes: Vec<Note> = answer.notes;
        if ratio.is_some_and(|r| r > 1.0) {
            notes.push(Note::warning("a force is beyond its allowable"));
        }
        let turned = motion.q.fixed_rows::<3>(3).norm();
        if turned > HALF_TURN && self.listed.iter().any(|(dof, _)| *dof > 2) {
            notes.push(Note::warning("the ends are turned by nearly half a turn against each other, beyond which a spring does not determine the sense"));
        }
        let tension = self.listed.iter().any(|(dof, _)| *dof == 0).then(|| answer.force[0]);
        Ok(ConnectorSummary { tension, ratio, solution: "exact", springs, notes, ..ConnectorSummary::default() })
    }

    fn category(&self) -> ConnectorCategory {
        self.category
    }

    fn as_stiff_tie(&self) -> Option<&dyn StiffTie> {
        self.law.linear_stiffness().filter(|k| *k >= MIN_HELD_STIFFNESS).map(|_| self as _)
    }
}

/// Relative rotation above which a user is warned: 170 degrees.
const HALF_TURN: f64 = 170.0 * std::f64::consts::PI / 180.0;

impl StiffTie for ZeroLength {
    fn evaluate_tie(
        &self,
        at: &Situation,
        held: Option<&Vector6<f64>>,
        out: &mut ConnectorResponse,
    ) -> Result<TieResponse, ClassError> {
        let motion = self.motion(at)?;
        let mut answer = self.law.evaluate(&motion.q, &Vector3::zeros(), None, &[], &mut []);
        let force = answer.force;
        let held = held.copied().unwrap_or(force);
        let more = force - held;
        answer.force = held;
        self.write_response(&motion, &answer, out);
        let slopes = self.deflection_derivatives(&motion).map(|by| answer.slopes * by);
        let far = at.ends.iter().map(|end| end.pose.origin.norm()).fold(0.0, f64::max);
        let rounding = DEFLECTION_ROUNDING + 8.0 * f64::EPSILON * far;
        let lack = |i: usize| {
            let k = answer.slopes[(i, i)];
            if k > 0.0 { (more[i].abs() / k - rounding).max(0.0) } else { 0.0 }
        };
        let gap = (0..6).map(lack).fold(0.0, f64::max);
        Ok(TieResponse { force, slopes, excess: self.wrenches_of(&motion, &more), gap })
    }
}
