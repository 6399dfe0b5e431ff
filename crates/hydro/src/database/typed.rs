//! A database of matrices and forces given period by period.

use super::checks::check_database;
use super::rows::{DatabaseError, axis, same_heading};
use nalgebra::{Complex, Matrix3, Matrix6, Vector3};
use std::f64::consts::TAU;
use windlass_model::{Amplitudes, Database, Surroundings};

/// What is given of one period.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TypedPeriod {
    /// The period (s).
    pub period: f64,
    /// Added mass (kg, kg m, kg m2).
    pub added_mass: Option<Matrix6<f64>>,
    /// Damping by radiated waves (N s/m, N s, N m s).
    pub damping: Option<Matrix6<f64>>,
    /// Headings the waves travel toward, from the x axis of the values (rad), with forces over wave amplitude (N/m, N).
    pub forces: Vec<(f64, Amplitudes)>,
}

/// Where values given by period stand in their body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TypedAxes {
    /// The point they are about (m).
    pub reference: Vector3<f64>,
    /// Their axes in the body.
    pub axes: Matrix3<f64>,
    /// The angle of their x axis from that of the body, in the plane (rad).
    pub yaw: f64,
}

/// The database of values given by period, in the axes of the body; density, gravity and depth are those of the surroundings.
///
/// # Errors
/// No period, or one that is given twice; matrices or headings that only some periods have; what every database is refused for.
pub fn build(
    source: &str,
    position: &TypedAxes,
    periods: &[TypedPeriod],
    around: &Surroundings,
) -> Result<Database, DatabaseError> {
    let wrong = |why: String| Err(DatabaseError::Whole(format!("{source}: {why}")));
    let mut list: Vec<&TypedPeriod> = periods.iter().collect();
    list.sort_by(|a, b| b.period.total_cmp(&a.period));
    let Some(first) = list.first() else { return wrong("it has no period".into()) };
    for pair in list.windows(2) {
        if let [a, b] = pair
            && a.period <= b.period * (1.0 + 1e-9)
        {
            return wrong(format!("the period of {} s is given twice", b.period));
        }
    }
    let has_matrices = first.added_mass.is_some();
    let headings = axis(first.forces.iter().map(|(heading, _)| turn_heading(*heading, position.yaw)), same_heading);
    let mut turn = Matrix6::zeros();
    for at in [0, 3] {
        turn.fixed_view_mut::<3, 3>(at, at).copy_from(&position.axes);
    }
    let (mut added_mass, mut damping) = (Vec::new(), Vec::new());
    let mut excitation = vec![Vec::new(); headings.len()];
    for given in &list {
        if given.added_mass.is_some() != has_matrices || given.damping.is_some() != has_matrices {
            return wrong(format!(
                "the period of {} s has not both added mass and damping, as others have",
                given.period
            ));
        }
        if let (Some(mass), Some(damp)) = (&given.added_mass, &given.damping) {
            added_mass.push(turn * mass * turn.transpose());
            damping.push(turn * damp * turn.transpose());
        }
        if given.forces.len() != headings.len() {
            return wrong(format!("the period of {} s has not the headings of the others, each once", given.period));
        }
        for (heading, row) in headings.iter().zip(&mut excitation) {
            let own = given.forces.iter().find(|(own, _)| same_heading(turn_heading(*own, position.yaw), *heading));
            let Some((_, force)) = own else {
                return wrong(format!(
                    "the period of {} s has not the headings of the others, each once",
                    given.period
                ));
            };
            row.push(rotate(&position.axes, force));
        }
    }
    check_database(Database {
        source: source.to_string(),
        reference: position.reference,
        frequencies: list.iter().map(|given| TAU / given.period).collect(),
        added_mass,
        damping,
        headings,
        excitation,
        density: around.water_density,
        gravity: around.gravity,
        depth: around.depth,
        ..Database::default()
    })
}

/// A heading in the body, in [0, 2 pi).
fn turn_heading(heading: f64, yaw: f64) -> f64 {
    let angle = (heading + yaw).rem_euclid(TAU);
    if angle > TAU - 1e-9 { 0.0 } else { angle }
}

/// A force and a moment in the axes of the body.
fn rotate(axes: &Matrix3<f64>, force: &Amplitudes) -> Amplitudes {
    let axes = axes.map(|x| Complex::new(x, 0.0));
    let [a, b, c, d, e, f] = *force;
    let (force, moment) = (axes * Vector3::new(a, b, c), axes * Vector3::new(d, e, f));
    [force.x, force.y, force.z, moment.x, moment.y, moment.z]
}
