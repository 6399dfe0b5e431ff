//! Bodies whose motion is given: by sines, by their responses to the waves of the sea, or by a file of places.
//!
//! A motion is x, y, z and roll, pitch, yaw with their first and second derivatives in time, each exact; the rotation and its
//! derivatives in global axes follow from those of the angles ([`motion_from_dofs`]).

mod response;
mod spline;

use super::forces::BodyMotion;
use nalgebra::Vector3;
use response::RaoMotion;
use spline::Spline;
use std::f64::consts::TAU;
use std::fmt::Debug;
use std::sync::Arc;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::sea::Sea;
use windlass_model::{Body, ClassError, GivenMotion, Sinusoid};

/// A motion that is given for all times.
pub trait Prescribed: Debug + Send + Sync {
    /// The motion at a time (s); its auxiliary acceleration is its acceleration.
    ///
    /// # Errors
    /// A time for which there is none.
    fn motion_at(&self, time: f64) -> Result<BodyMotion, ClassError>;
}

/// The motion a body of a model is given in a sea, from where it stands, in a run that begins at `start` (s); `None` of one that forces move.
///
/// # Errors
/// Waves beyond a table of responses.
pub fn build_prescribed(
    body: &Body,
    sea: Option<&Arc<Sea>>,
    start: f64,
) -> Result<Option<Box<dyn Prescribed>>, ClassError> {
    let Some(given) = &body.prescribed else { return Ok(None) };
    let made: Box<dyn Prescribed> = match &given.motion {
        GivenMotion::Sinusoids { list, ramp } => {
            Box::new(SinusoidalMotion { position: body.position, list: list.clone(), ramp: *ramp, start })
        }
        GivenMotion::Responses(table) => {
            Box::new(RaoMotion::new(body.position, table, sea).map_err(|e| e.with_span(given.span))?)
        }
        GivenMotion::Path(rows) => Box::new(Spline::new(rows).map_err(|e| e.with_span(given.span))?),
    };
    Ok(Some(made))
}

/// x, y, z (m) and roll, pitch, yaw (rad), with their first and second derivatives in time.
pub(super) type DofMotion = [[f64; 6]; 3];

/// The motion of six degrees of freedom.
///
/// The axes are those of yaw about z, pitch about y and roll about x, each about the axes already turned. With e1 the body's x axis, e2 the
/// y axis after the yaw alone and e3 the vertical, the rotation is `roll' e1 + pitch' e2 + yaw' e3`; e2 turns with the yaw and e1 with
/// yaw and pitch, which gives its derivative.
pub(super) fn motion_from_dofs([values, rates, seconds]: &DofMotion) -> BodyMotion {
    let position = Place::new(*values);
    let pose = Pose::from_place(&position);
    let [_, _, yaw] = position.turn;
    let (e1, e3) = (pose.axes.column(0).into_owned(), Vector3::z());
    let e2 = Vector3::new(-yaw.sin(), yaw.cos(), 0.0);
    let [x, y, z, roll, pitch, turn] = *rates;
    let before = e2 * pitch + e3 * turn;
    let rotation = e1 * roll + before;
    let [ax, ay, az, by_roll, by_pitch, by_yaw] = *seconds;
    let change = e1 * by_roll + e2 * by_pitch + e3 * by_yaw + e3.cross(&e2) * (turn * pitch) + before.cross(&e1) * roll;
    let acceleration = Six::new(ax, ay, az, change.x, change.y, change.z);
    BodyMotion {
        pose,
        velocity: Six::new(x, y, z, rotation.x, rotation.y, rotation.z),
        acceleration,
        auxiliary: acceleration,
        jerk: Six::zeros(),
    }
}

/// Sines about a place.
#[derive(Debug)]
struct SinusoidalMotion {
    position: Place,
    list: Vec<Sinusoid>,
    ramp: f64,
    /// Time at which the ramp begins (s).
    start: f64,
}

/// A ramp from 0 to 1 with its first and second derivatives, all of them without a jump: `10 s^3 - 15 s^4 + 6 s^5`.
fn ramp(time: f64, over: f64) -> [f64; 3] {
    if over <= 0.0 || time >= over {
        return [1.0, 0.0, 0.0];
    }
    let s = (time / over).max(0.0);
    let value = s * s * s * (10.0 + s * (6.0 * s - 15.0));
    let rate = 30.0 * s * s * (1.0 - s) * (1.0 - s) / over;
    [value, rate, 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s) / (over * over)]
}

/// A product with its first and second derivatives.
pub(super) fn product(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] * b[0], a[1] * b[0] + a[0] * b[1], a[2] * b[0] + 2.0 * a[1] * b[1] + a[0] * b[2]]
}

impl Prescribed for SinusoidalMotion {
    fn motion_at(&self, time: f64) -> Result<BodyMotion, ClassError> {
        let grown = ramp(time - self.start, self.ramp);
        let mut dofs = [self.position.values(), [0.0; 6], [0.0; 6]];
        for sine in &self.list {
            let frequency = TAU / sine.period;
            let (sin, cos) = (frequency * time + sine.phase).sin_cos();
            let own = [sin, frequency * cos, -frequency * frequency * sin].map(|v| v * sine.amplitude);
            for (sums, value) in dofs.iter_mut().zip(product(grown, own)) {
                if let Some(sum) = sums.get_mut(sine.dof) {
                    *sum += value;
                }
            }
        }
        Ok(motion_from_dofs(&dofs))
    }
}
