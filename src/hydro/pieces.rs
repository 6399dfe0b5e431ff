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

use super::area::category;
use super::buoyancy::skin;
use super::exposed::{Exposed, Skin};
use super::steady::{Medium, Steady};
use super::strips::Strips;
use super::{BodyLoad, Category, Load};
use crate::model::{ClassError, Part, Piece, Pose};
use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use std::sync::Arc;

/// A piece in wind or current.
#[derive(Debug)]
pub struct PieceLoad {
    skin: Arc<Skin>,
    strips: Strips,
    medium: Medium,
    /// Axes of the part in the body: columns.
    axes: Matrix3<f64>,
    /// Shape coefficients along them.
    cs: [f64; 3],
}

impl PieceLoad {
    /// A skin in the wind or the current in force, with shape coefficients along the axes of its part: the columns of a matrix, in
    /// the body.
    pub fn new(skin: Arc<Skin>, steady: &Steady, medium: Medium, axes: Matrix3<f64>, cs: [f64; 3]) -> Self {
        PieceLoad { skin, strips: Strips::of(steady, medium), medium, axes, cs }
    }
}

/// The loads of the wind and the current in force on a piece.
///
/// # Errors
/// A piece that is not a closed surface.
pub fn of(steady: &Steady, part: &Part, piece: &Piece) -> Result<Vec<PieceLoad>, ClassError> {
    let media = [(Medium::Air, piece.cs_wind), (Medium::Water, piece.cs_current)];
    let acts = |(medium, cs): &(Medium, [f64; 3])| !steady.still(*medium) && *cs != [0.0; 3];
    if !media.iter().any(acts) {
        return Ok(Vec::new());
    }
    let Some(surface) = skin(part, piece)? else { return Ok(Vec::new()) };
    let axes = *part.place.rotation().matrix();
    let skin = Arc::new(Skin::of(&surface, &axes));
    let made = media.into_iter().filter(acts);
    Ok(made.map(|(medium, cs)| PieceLoad::new(Arc::clone(&skin), steady, medium, axes, cs)).collect())
}

/// Force along an axis, and force times its arm, with their changes by d_z and the three rotations.
struct Along {
    force: f64,
    arm: Vector3<f64>,
    change: [(f64, Vector3<f64>); 4],
}

/// What the skin and the waterplane give along an axis `e` of the part.
fn along(found: &Exposed, axis: usize, e: &Vector3<f64>, strips: &Strips, height: f64) -> Option<Along> {
    let skin = found.along.get(axis)?;
    let flat = e.xy();
    // the cut: at the height of the surface, which falls as the body rises
    let (w, plane) = (strips.at_surface(), &found.plane);
    let (share, pressure) = (0.5 * e.z * e.z, w.dot(&flat));
    let lid = |s: Vector3<f64>| Vector3::new(s.y, s.z, -height * s.x);
    let at_cut = lid(plane.sums);
    let change = std::array::from_fn(|n| {
        let mut turn = Vector3::zeros();
        if let Some(at) = n.checked_sub(1).and_then(|n| turn.get_mut(n)) {
            *at = 1.0;
        }
        // the lift is a sum of 1, x, y
        let lift = Vector3::new(if n == 0 { 1.0 } else { 0.0 }, -turn.y, turn.x);
        let turned = turn.cross(e);
        let mut force = (skin.force_by * lift).dot(&flat) + skin.force.dot(&turned.xy());
        let lifted = skin.arm_by[0] * lift.x + skin.arm_by[1] * lift.y + skin.arm_by[2] * lift.z;
        let mut arm = lifted * flat + turn.cross(&(skin.arm * flat)) + skin.arm * turned.xy();
        let (share_by, pressure_by) = (e.z * turned.z, w.dot(&turned.xy()));
        let sums_by = plane.change.column(n).into_owned();
        let factor_by = share_by * pressure + share * pressure_by;
        force += factor_by * plane.sums.x + share * pressure * sums_by.x;
        let mut cut_by = lid(sums_by);
        cut_by.z -= lift.x * plane.sums.x;
        arm += at_cut * factor_by + cut_by * (share * pressure);
        (force, arm)
    });
    let force = skin.force.dot(&flat) + share * pressure * plane.sums.x;
    Some(Along { force, arm: skin.arm * flat + at_cut * (share * pressure), change })
}

impl BodyLoad for PieceLoad {
    fn category(&self) -> Category {
        category(self.medium)
    }

    fn load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let found = self.skin.exposed(pose, &self.strips);
        let (axes, height) = (pose.axes * self.axes, pose.origin.z - self.strips.level);
        let (mut wrench, mut stiffness) = (Vector6::zeros(), Matrix6::zeros());
        for (n, cs) in self.cs.into_iter().enumerate().filter(|(_, cs)| *cs != 0.0) {
            let e = axes.column(n).into_owned();
            let Some(Along { force, arm, change }) = along(&found, n, &e, &self.strips, height) else { continue };
            let half = 0.5 * self.strips.density * cs;
            let six = |f: Vector3<f64>, m: Vector3<f64>| Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z) * half;
            wrench += six(e * force, arm.cross(&e));
            for (column, (force_by, arm_by)) in change.into_iter().enumerate() {
                let mut turn = Vector3::zeros();
                if let Some(at) = column.checked_sub(1).and_then(|n| turn.get_mut(n)) {
                    *at = 1.0;
                }
                let turned = turn.cross(&e);
                let by = six(e * force_by + turned * force, arm_by.cross(&e) + arm.cross(&turned));
                let mut at = stiffness.column_mut(column + 2);
                at -= by;
            }
        }
        if wrench.iter().chain(stiffness.iter()).all(|x| x.is_finite()) {
            Ok(Load { wrench, stiffness })
        } else {
            Err(ClassError::new("the force of wind or current on a piece has no value where the body is"))
        }
    }
}
