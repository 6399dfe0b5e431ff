//! Wind and current on the pieces of a hull: `-CS_WIND` and `-CS_CURRENT`.
//!
//! Our reading, as the sources name the options only: along each axis e of the part the force is
//! `1/2 rho cs A |v| (v.e) e` with A the area of the exposed part of the piece as projected along e, what is above the water of
//! wind and below it of current. `|v| v` depends on the height alone and is integrated over the height, so that the force acts at
//! the centre of pressure; in a uniform stream that is the centroid of A.
//!
//! A is half the sum of what the skin shows from the two sides, exact for convex pieces; where a piece is hollow to the side, what
//! one part of it shelters from another counts too. The cut through the water closes the exposed part: half the waterplane times
//! the square of its cosine with e counts as skin. That makes A exact on an even keel; heeled, it is between the areas seen from
//! the two sides, and has a tangent, as the larger of the two has not.
//!
//! Under way the pressure changes by `|s| s.e - |m| m.e`, m being the mean stream and s the stream of the time as seen from the
//! body, both at the centroid of A of each axis, which moves with the body: so one that turns about its middle meets no more than
//! the centroids do. At rest in the mean stream nothing is added; in a uniform stream all of it is exact.

use super::buoyancy::{TUBE_PRISM_SIDES, skin};
use super::growth::Growth;
use super::growth_loads;
use super::hull::TubeHull;
use super::steady::{Medium, Steady};
use super::stream::category;
use super::strips::Strips;
use super::surface_integrals::{Skin, SurfaceIntegrals};
use super::{BodyLoad, BodyStep, Category, DynamicLoad, Load, cross};
use nalgebra::{Matrix3, Matrix6, RowVector6, SVector, Vector3, Vector6};
use std::sync::Arc;
use windlass_base::pose::Pose;
use windlass_model::{ClassError, Part, Piece, Shape};

/// A piece in wind or current.
#[derive(Debug)]
pub struct PieceLoad {
    skin: Arc<Skin>,
    steady: Arc<Steady>,
    strips: Strips,
    /// A pressure of one, with which what is exposed is its area.
    even: Strips<1>,
    medium: Medium,
    /// Axes of the part in the body: columns.
    axes: Matrix3<f64>,
    /// Shape coefficients along them.
    cs: [f64; 3],
}

impl PieceLoad {
    /// A skin in the wind or the current in force, with shape coefficients along the axes of its part: the columns of a matrix, in
    /// the body.
    pub fn new(skin: Arc<Skin>, steady: &Arc<Steady>, medium: Medium, axes: Matrix3<f64>, cs: [f64; 3]) -> Self {
        let (strips, even) = (Strips::new(steady, medium), Strips::uniform(steady, medium));
        PieceLoad { skin, steady: Arc::clone(steady), strips, even, medium, axes, cs }
    }

    /// The axes of the part that have a coefficient, in a pose, global, each with half of density times it.
    fn axes(&self, pose: &Pose) -> impl Iterator<Item = (usize, Vector3<f64>, f64)> {
        let (axes, half) = (pose.axes * self.axes, 0.5 * self.strips.density);
        let all = self.cs.into_iter().enumerate().filter(|(_, cs)| *cs != 0.0);
        all.map(move |(n, cs)| (n, axes.column(n).into_owned(), half * cs))
    }

    /// What the motion of the body and what varies in time add to the load in the mean stream.
    fn dynamic_part(&self, at: &BodyStep) -> DynamicLoad {
        let found = self.skin.surface_integrals(at.pose, &self.even);
        let height = at.pose.origin.z - self.even.level;
        let mut sum = DynamicLoad::from(Load::none());
        let (own, spin) = (at.velocity.fixed_rows::<3>(0).into_owned(), at.velocity.fixed_rows::<3>(3).into_owned());
        let (now, mean) = (self.steady.streams_at_time(at.time), self.steady.mean());
        for (n, e, half) in self.axes(at.pose) {
            let area =
                integrate_along(&found, n, &e, &self.even, height, |_| SVector::from([1.0]), |_| SVector::zeros());
            // none of a piece that the medium does not touch
            let Some(area) = area.filter(|a| a.force > 1e-9) else { continue };
            let centre = area.arm / area.force;
            let z = at.pose.origin.z + centre.z;
            let (stream, slope) = now.velocity(self.medium, z);
            let seen = RelativeStream { stream: stream - own - spin.cross(&centre), slope, spin };
            let (stream, slope) = mean.velocity(self.medium, z);
            let rest = RelativeStream { stream, slope, spin: Vector3::zeros() };
            for (seen, factor) in [(&seen, half), (&rest, -half)] {
                let (wrench, stiffness) = seen.pushes(&area, &e);
                sum.load.wrench += wrench * factor;
                sum.load.stiffness += stiffness * factor;
            }
            sum.damping += seen.damps(&area, &e) * half;
        }
        sum
    }
}

/// The loads of the wind and the current in force on a piece; under way also in air and water that are still; on a tube with
/// the growth it has where its body stands.
///
/// # Errors
/// A piece that is not a closed surface.
pub fn build_piece_load(
    steady: &Arc<Steady>,
    part: &Part,
    piece: &Piece,
    under_way: bool,
    growth: Option<(&Growth, &Pose)>,
) -> Result<Vec<PieceLoad>, ClassError> {
    let media = [(Medium::Air, piece.cs_wind), (Medium::Water, piece.cs_current)];
    let acts = |(medium, cs): &(Medium, [f64; 3])| (under_way || !steady.is_still(*medium)) && *cs != [0.0; 3];
    if !media.iter().any(acts) {
        return Ok(Vec::new());
    }
    let surface = match (growth, piece.shape.with_displacement(&part.position)) {
        (Some((growth, pose)), Shape::Tube { ends, diameter }) => {
            let tube = TubeHull { ends: ends.map(Vector3::from), diameter };
            tube.with_diameters(&growth_loads::stations(growth, pose, tube.ends, diameter), TUBE_PRISM_SIDES)
        }
        _ => skin(part, piece)?,
    };
    let Some(surface) = surface else { return Ok(Vec::new()) };
    let axes = *part.position.rotation().matrix();
    let skin = Arc::new(Skin::new(&surface, &axes));
    let made = media.into_iter().filter(acts);
    Ok(made.map(|(medium, cs)| PieceLoad::new(Arc::clone(&skin), steady, medium, axes, cs)).collect())
}

/// Force along an axis, and force times its arm, with their changes by d_z and the three rotations.
struct AxisLoad {
    force: f64,
    arm: Vector3<f64>,
    change: [(f64, Vector3<f64>); 4],
}

/// What the skin and the waterplane give along an axis `e` of the part. `of` is the combination of the components of w that acts
/// along an axis, and `by` the same of a change of the axis.
fn integrate_along<const D: usize>(
    found: &SurfaceIntegrals<D>,
    axis: usize,
    e: &Vector3<f64>,
    strips: &Strips<D>,
    height: f64,
    of: impl Fn(&Vector3<f64>) -> SVector<f64, D>,
    by: impl Fn(&Vector3<f64>) -> SVector<f64, D>,
) -> Option<AxisLoad> {
    let skin = found.along.get(axis)?;
    let flat = of(e);
    // the cut: at the height of the surface, which falls as the body rises
    let (w, plane) = (strips.at_surface(), &found.plane);
    let (share, pressure) = (0.5 * e.z * e.z, w.dot(&flat));
    let lid = |s: Vector3<f64>| Vector3::new(s.y, s.z, -height * s.x);
    let at_cut = lid(plane.sums);
    let change = std::array::from_fn(|n| {
        let turn = rotation(n);
        // the lift is a sum of 1, x, y
        let lift = Vector3::new(if n == 0 { 1.0 } else { 0.0 }, -turn.y, turn.x);
        let turned = turn.cross(e);
        let turned_flat = by(&turned);
        let mut force = (skin.force_by * lift).dot(&flat) + skin.force.dot(&turned_flat);
        let lifted = skin.arm_by[0] * lift.x + skin.arm_by[1] * lift.y + skin.arm_by[2] * lift.z;
        let mut arm = lifted * flat + turn.cross(&(skin.arm * flat)) + skin.arm * turned_flat;
        let (share_by, pressure_by) = (e.z * turned.z, w.dot(&turned_flat));
        let sums_by = plane.change.column(n).into_owned();
        let factor_by = share_by * pressure + share * pressure_by;
        force += factor_by * plane.sums.x + share * pressure * sums_by.x;
        let mut cut_by = lid(sums_by);
        cut_by.z -= lift.x * plane.sums.x;
        arm += at_cut * factor_by + cut_by * (share * pressure);
        (force, arm)
    });
    let force = skin.force.dot(&flat) + share * pressure * plane.sums.x;
    Some(AxisLoad { force, arm: skin.arm * flat + at_cut * (share * pressure), change })
}

/// The rotation of the n-th of the motions that change what is exposed: heave, roll, pitch, yaw.
fn rotation(n: usize) -> Vector3<f64> {
    let mut turn = Vector3::zeros();
    if let Some(at) = n.checked_sub(1).and_then(|n| turn.get_mut(n)) {
        *at = 1.0;
    }
    turn
}

/// A stream as it is seen at the centroid of an area.
struct RelativeStream {
    /// Velocity (m/s, global), and its change with the height (1/s).
    stream: Vector3<f64>,
    slope: Vector3<f64>,
    /// Rotation of the body (rad/s).
    spin: Vector3<f64>,
}

fn six(force: Vector3<f64>, moment: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

impl RelativeStream {
    /// `|s| s.e`, its change with s, and |s|.
    fn pressure(&self, e: &Vector3<f64>) -> (f64, Vector3<f64>, f64) {
        let (speed, along) = (self.stream.norm(), self.stream.dot(e));
        let change = if speed > 0.0 { self.stream * (along / speed) + e * speed } else { Vector3::zeros() };
        (speed * along, change, speed)
    }

    /// Force and moment on an area seen along an axis, over half the density, and -d(them)/d(motion).
    fn pushes(&self, area: &AxisLoad, e: &Vector3<f64>) -> (Vector6<f64>, Matrix6<f64>) {
        let (q, by_stream, speed) = self.pressure(e);
        let centre = area.arm / area.force;
        let mut stiffness = Matrix6::zeros();
        for (n, (area_by, arm_by)) in area.change.iter().enumerate() {
            let turned = rotation(n).cross(e);
            let centre_by = (arm_by - centre * *area_by) / area.force;
            let rise = centre_by.z + if n == 0 { 1.0 } else { 0.0 };
            let stream_by = self.slope * rise - self.spin.cross(&centre_by);
            let q_by = by_stream.dot(&stream_by) + speed * self.stream.dot(&turned);
            let force = e * (q_by * area.force + q * area_by) + turned * (q * area.force);
            let moment = (area.arm * q_by + arm_by * q).cross(e) + area.arm.cross(&turned) * q;
            stiffness.set_column(n + 2, &-six(force, moment));
        }
        (six(e * area.force, area.arm.cross(e)) * q, stiffness)
    }

    /// -d(force and moment)/d(velocity of the origin, rotation), over half the density.
    fn damps(&self, area: &AxisLoad, e: &Vector3<f64>) -> Matrix6<f64> {
        let (_, by_stream, _) = self.pressure(e);
        // d(stream) = -d(velocity) + centre x d(spin)
        let turning = -cross(area.arm / area.force).transpose() * by_stream;
        let by_velocity = RowVector6::new(by_stream.x, by_stream.y, by_stream.z, turning.x, turning.y, turning.z);
        six(e * area.force, area.arm.cross(e)) * by_velocity
    }
}

impl BodyLoad for PieceLoad {
    fn category(&self) -> Category {
        category(self.medium)
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let mut sum = Load::none();
        if self.steady.is_still(self.medium) {
            return Ok(sum);
        }
        let found = self.skin.surface_integrals(pose, &self.strips);
        let height = pose.origin.z - self.strips.level;
        let level = |v: &Vector3<f64>| v.xy();
        for (n, e, half) in self.axes(pose) {
            let Some(AxisLoad { force, arm, change }) =
                integrate_along(&found, n, &e, &self.strips, height, level, level)
            else {
                continue;
            };
            sum.wrench += six(e * force, arm.cross(&e)) * half;
            for (column, (force_by, arm_by)) in change.into_iter().enumerate() {
                let turned = rotation(column).cross(&e);
                let by = six(e * force_by + turned * force, arm_by.cross(&e) + arm.cross(&turned));
                let mut at = sum.stiffness.column_mut(column + 2);
                at -= by * half;
            }
        }
        finite(sum)
    }

    fn dynamic_load(&self, at: &BodyStep, _state: &[f64]) -> Result<DynamicLoad, ClassError> {
        let mean = self.mean_load(at.pose)?;
        let DynamicLoad { load, damping } = self.dynamic_part(at);
        let load = Load { wrench: mean.wrench + load.wrench, stiffness: mean.stiffness + load.stiffness };
        Ok(DynamicLoad { load: finite(load)?, damping })
    }
}

/// A load, where it has a value.
fn finite(load: Load) -> Result<Load, ClassError> {
    if load.wrench.iter().chain(load.stiffness.iter()).all(|x| x.is_finite()) {
        Ok(load)
    } else {
        Err(ClassError::new("the force of wind or current on a piece has no value where the body is"))
    }
}
