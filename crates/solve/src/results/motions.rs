//! Where bodies go.

use super::super::system::SolveError;
use super::super::time::{Run, VALUES_PER_BODY};
use super::{EventTable, Magnitude, RunEvent, group_head};
use nalgebra::Vector3;
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_model::Mass;

/// How motions are reported.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionOptions {
    /// Of the centre of gravity, instead of the origin.
    pub centre: bool,
    /// Velocities, accelerations and displacements along the axes of the body, instead of the global ones.
    pub local: bool,
    /// What magnitudes are of.
    pub magnitude: Magnitude,
}

/// A point of a body at an instant; global axes.
pub(super) struct PointMotion {
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
pub(super) fn find_motion(row: &[f64], from: usize, own: Vector3<f64>) -> PointMotion {
    let mut values = [f64::NAN; VALUES_PER_BODY];
    for (value, stored) in values.iter_mut().zip(row.get(from..).unwrap_or_default()) {
        *value = *stored;
    }
    let [x, y, z, roll, pitch, yaw, rest @ ..] = values;
    let [vx, vy, vz, wx, wy, wz, ax, ay, az, bx, by, bz] = rest;
    let turn = [roll, pitch, yaw];
    let pose = Pose::from_place(&Place { shift: [x, y, z], turn });
    let arm = pose.axes * own;
    let (spin, gain) = (Vector3::new(wx, wy, wz), Vector3::new(bx, by, bz));
    PointMotion {
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
pub fn trajectory(
    run: &Run,
    bodies: &[usize],
    options: &MotionOptions,
    events: &[RunEvent],
) -> Result<Table, SolveError> {
    let (layout, model) = (&run.history.layout, &run.model);
    let several = bodies.len() > 1;
    let depth = model.surroundings().depth.unwrap_or(f64::NAN);
    let first = run.history.values.get(..layout.width).unwrap_or_default();
    let mut chosen = Vec::new();
    for body in bodies {
        let Some((name, key)) = layout.bodies.get(*body) else { continue };
        let mass = model.bodies.get(key).map(|b| Mass::from_parts(model.parts_of(b), model.defaults.gravity));
        let own = mass.filter(|_| options.centre).map_or(Vector3::zeros(), |m| m.centre);
        let from = layout.body(*body);
        chosen.push((name, from, own, find_motion(first, from, own)));
    }
    let mut table = EventTable::new("Trajectory", (&run.history, events), |row| {
        Ok(chosen
            .iter()
            .map(|(_, from, own, start)| Displaced::new(find_motion(row, *from, *own), start, options.local))
            .collect())
    })?;
    let none = Displaced::default();
    for (index, (name, ..)) in chosen.iter().enumerate() {
        if !several {
            table = table.fact("Body", name.as_str(), Dim::None);
        }
        let body = |all: &Vec<Displaced>| all.get(index).copied().unwrap_or(none);
        let with = |vector: &Vector3<f64>| options.magnitude.components_and_magnitude(vector);
        let head = |group: &str| group_head(several, name, group);
        table = table
            .columns(&head("Location"), ["X", "Y", "Z", "Mag."], Dim::Length, |all| with(&body(all).at))
            .columns(&head("Location"), ["Roll", "Pitch", "Yaw"], Dim::Angle, |all| body(all).turn)
            .columns(&head("Velocity"), ["VX", "VY", "VZ", "V Mag."], Dim::Velocity, |all| with(&body(all).velocity[0]))
            .columns(&head("Velocity"), ["VRX", "VRY", "VRZ"], Dim::AngularVelocity, |all| body(all).velocity[1].into())
            .columns(&head("Acceleration"), ["AX", "AY", "AZ", "A Mag."], Dim::Acceleration, |all| {
                with(&body(all).acceleration[0])
            })
            .columns(&head("Acceleration"), ["ARX", "ARY", "ARZ"], Dim::AngularAcceleration, |all| {
                body(all).acceleration[1].into()
            })
            .columns(&head("Bottom"), ["Clearance"], Dim::Length, |all| [body(all).at.z + depth])
            .columns(&head("Displacement"), ["DX", "DY", "DZ", "D Mag."], Dim::Length, |all| with(&body(all).moved))
            .columns(&head("Displacement"), ["DRoll", "DPitch", "DYaw"], Dim::Angle, |all| body(all).turned);
    }
    let of = if options.centre { "the centre of gravity" } else { "the origin" };
    let axes = if options.local { "of the body" } else { "global" };
    Ok(table.fact("Of", of, Dim::None).fact("Axes", axes, Dim::None).build())
}

/// A point of a body and how far it is from where it was at the start; vectors along the axes asked for.
#[derive(Clone, Copy)]
struct Displaced {
    /// Where it is, global (m).
    at: Vector3<f64>,
    /// Roll, pitch, yaw (rad).
    turn: [f64; 3],
    /// Of the point (m/s), and of the rotation (rad/s).
    velocity: [Vector3<f64>; 2],
    /// Of the point (m/s2), and of the rotation (rad/s2).
    acceleration: [Vector3<f64>; 2],
    /// From the start (m, rad).
    moved: Vector3<f64>,
    turned: [f64; 3],
}

impl Default for Displaced {
    /// No numbers.
    fn default() -> Self {
        let nothing = Vector3::repeat(f64::NAN);
        Displaced {
            at: nothing,
            turn: [f64::NAN; 3],
            velocity: [nothing; 2],
            acceleration: [nothing; 2],
            moved: nothing,
            turned: [f64::NAN; 3],
        }
    }
}

impl Displaced {
    fn new(now: PointMotion, start: &PointMotion, local: bool) -> Self {
        let along = |v: Vector3<f64>| if local { now.pose.axes.transpose() * v } else { v };
        let ([roll, pitch, yaw], [roll0, pitch0, yaw0]) = (now.turn, start.turn);
        Displaced {
            at: now.at,
            turn: now.turn,
            velocity: now.velocity.map(along),
            acceleration: now.acceleration.map(along),
            moved: along(now.at - start.at),
            turned: [roll - roll0, pitch - pitch0, yaw - yaw0],
        }
    }
}
