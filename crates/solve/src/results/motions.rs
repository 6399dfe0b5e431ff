//! Where bodies go.

use super::super::system::SolveError;
use super::super::time::{OF_BODY, Run};
use super::{Event, Magnitude, columns, filled, headed, timed};
use nalgebra::Vector3;
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_model::Mass;

/// How motions are told.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Told {
    /// Of the centre of gravity, instead of the origin.
    pub centre: bool,
    /// Velocities, accelerations and displacements along the axes of the body, instead of the global ones.
    pub local: bool,
    /// What magnitudes are of.
    pub magnitude: Magnitude,
}

/// A point of a body at an instant; global axes.
pub(super) struct Moving {
    /// Where the body is.
    pub pose: Pose,
    /// Roll, pitch, yaw (rad), without jumps from row to row.
    pub turn: [f64; 3],
    /// Where the point is (m).
    pub at: Vector3<f64>,
    /// Velocity of the point (m/s), and of the rotation (rad/s).
    pub velocity: [Vector3<f64>; 2],
    /// Acceleration of the point (m/s2), and of the rotation (rad/s2).
    pub acceleration: [Vector3<f64>; 2],
}

/// A point of a body, `own` in its system (m), whose values begin at `from` of a row:
/// `v = v0 + w x r` and `a = a0 + dw/dt x r + w x (w x r)`.
pub(super) fn moving(row: &[f64], from: usize, own: Vector3<f64>) -> Moving {
    let mut values = [f64::NAN; OF_BODY];
    for (value, stored) in values.iter_mut().zip(row.get(from..).unwrap_or_default()) {
        *value = *stored;
    }
    let [x, y, z, roll, pitch, yaw, rest @ ..] = values;
    let [vx, vy, vz, wx, wy, wz, ax, ay, az, bx, by, bz] = rest;
    let turn = [roll, pitch, yaw];
    let pose = Pose::of(&Place { shift: [x, y, z], turn });
    let arm = pose.axes * own;
    let (spin, gain) = (Vector3::new(wx, wy, wz), Vector3::new(bx, by, bz));
    Moving {
        pose,
        turn,
        at: pose.origin + arm,
        velocity: [Vector3::new(vx, vy, vz) + spin.cross(&arm), spin],
        acceleration: [Vector3::new(ax, ay, az) + gain.cross(&arm) + spin.cross(&spin.cross(&arm)), gain],
    }
}

/// Location, velocity, acceleration, clearance of the bottom and displacement from the start of the run of some of its bodies, by
/// their numbers. The clearance is the height of the origin, or the centre of gravity, above the bottom.
///
/// The columns of one body stand where the published samples have them: X in column 2, the angles in 6 to 8.
///
/// # Errors
/// None of its own.
pub fn trajectory(run: &Run, bodies: &[usize], told: &Told, events: &[Event]) -> Result<Table, SolveError> {
    let (layout, model) = (&run.history.layout, &run.model);
    let several = bodies.len() > 1;
    let depth = model.surroundings().depth.unwrap_or(f64::NAN);
    let mut table = timed("Trajectory");
    let mut chosen = Vec::new();
    for body in bodies {
        let Some((name, key)) = layout.bodies.get(*body) else { continue };
        let mass = model.bodies.get(key).map(|b| Mass::of(model.parts_of(b), model.defaults.gravity));
        let own = mass.filter(|_| told.centre).map_or(Vector3::zeros(), |m| m.centre);
        let from = layout.body(*body);
        let first = run.history.values.get(..layout.width).unwrap_or_default();
        chosen.push((from, own, moving(first, from, own)));
        if !several {
            table = table.fact("Body", name.as_str(), Dim::None);
        }
        let head = |group: &str| headed(several, name, group);
        table = columns(table, &head("Location"), &["X", "Y", "Z", "Mag."], Dim::Length);
        table = columns(table, &head("Location"), &["Roll", "Pitch", "Yaw"], Dim::Angle);
        table = columns(table, &head("Velocity"), &["VX", "VY", "VZ", "V Mag."], Dim::Velocity);
        table = columns(table, &head("Velocity"), &["VRX", "VRY", "VRZ"], Dim::AngularVelocity);
        table = columns(table, &head("Acceleration"), &["AX", "AY", "AZ", "A Mag."], Dim::Acceleration);
        table = columns(table, &head("Acceleration"), &["ARX", "ARY", "ARZ"], Dim::AngularAcceleration);
        table = columns(table, &head("Bottom"), &["Clearance"], Dim::Length);
        table = columns(table, &head("Displacement"), &["DX", "DY", "DZ", "D Mag."], Dim::Length);
        table = columns(table, &head("Displacement"), &["DRoll", "DPitch", "DYaw"], Dim::Angle);
    }
    table = table.fact("Of", if told.centre { "the centre of gravity" } else { "the origin" }, Dim::None);
    table = table.fact("Axes", if told.local { "of the body" } else { "global" }, Dim::None);
    filled((&run.history, events), table, &mut |row, made| {
        for (from, own, start) in &chosen {
            let now = moving(row, *from, *own);
            let along = |v: Vector3<f64>| if told.local { now.pose.axes.transpose() * v } else { v };
            told.magnitude.push(&now.at, made);
            made.extend(now.turn);
            for [point, turning] in [now.velocity, now.acceleration] {
                told.magnitude.push(&along(point), made);
                made.extend(along(turning).iter());
            }
            made.push(now.at.z + depth);
            told.magnitude.push(&along(now.at - start.at), made);
            made.extend(now.turn.iter().zip(start.turn).map(|(a, b)| a - b));
        }
        Ok(())
    })
}
