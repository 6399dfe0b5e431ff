//! What is said of wave drift damping and of mean drift in a current: values, and what has no part in them.

use nalgebra::{Matrix2, Rotation2, Vector2};
use windlass_base::pose::Pose;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::database::attached::{
    VelocityEffect, coarse_slow_drift, mean_slow_drift, slow_drift_without_heading_slopes, velocity_effect,
};
use windlass_hydro::database::drift_damping::DriftByVelocity;
use windlass_hydro::steady::Steady;
use windlass_hydro::{Category, heading_of};
use windlass_model::{Body, ClassError, Model};

/// Share of the energy of a sea in waves for which the water is not deep that is let pass.
const SHALLOW_SHARE: f64 = 0.05;
/// Frequency of waves by the speed of the current over gravity up to which the formula, linear in the speed, is let pass: at 0.25 waves no more run against the
/// current from a body.
const FASTEST_CURRENT: f64 = 0.15;
/// Share of the energy of a sea in waves for which the current is too fast that is let pass.
const FAST_SHARE: f64 = 0.05;
/// Change of the damping by leaving out every second frequency, as a share of it, that is let pass: that of what is left out is a small part of it.
const COARSE_SHARE: f64 = 0.3;

/// Distance of headings of a database (rad) up to which the change of the drift with the heading is let pass: 45 degrees, and a little for rounding.
const WIDEST_SURE_GAP: f64 = std::f64::consts::FRAC_PI_4 + 1e-6;
/// Share of the damping by that change from which headings farther apart are warned of.
const SHARE_OF_HEADINGS: f64 = 0.1;

/// The wave drift damping of a body where it stands, in the sea of the environment.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyDriftDamping {
    /// The body.
    pub name: String,
    /// Row the force in surge and sway, column the velocity, axes of the body (N s/m).
    pub damping: Matrix2<f64>,
    /// What the mean current adds to the mean drift, global axes (N).
    pub by_current: Vector2<f64>,
    /// What has no part in it, or is uncertain, in sentences.
    pub warnings: Vec<String>,
    /// What is left out as asked, in sentences.
    pub notes: Vec<String>,
}

/// The wave drift damping of the bodies of a model that have mean drift by their databases.
///
/// # Errors
/// Waves or a current that cannot be computed; a body whose pieces give two factors.
pub fn body_drift_dampings(model: &Model) -> Result<Vec<BodyDriftDamping>, ClassError> {
    let mut list = Vec::new();
    for body in model.bodies.values() {
        list.extend(of_body(model, body)?);
    }
    Ok(list)
}

fn of_body(model: &Model, body: &Body) -> Result<Option<BodyDriftDamping>, ClassError> {
    let Some(drift) = mean_slow_drift(model, body)? else { return Ok(None) };
    let (name, pose) = (body.name.clone(), Pose::from_place(&body.position));
    let yaw = heading_of(&pose);
    let factor = model.multipliers.factor(Category::WaveDrift.name(), &name);
    let on_plan = drift.damping_on_plan(yaw)? * factor;
    let turn = Rotation2::new(yaw);
    let own_axes = |matrix: &Matrix2<f64>| turn.matrix().transpose() * matrix * turn.matrix();
    let (mut by_current, mut warnings, mut notes) = (Vector2::zeros(), Vec::new(), Vec::new());
    match velocity_effect(model, body)? {
        VelocityEffect::Acts(made) => {
            by_current = on_plan * made.current();
            warnings.extend(shallow_waves(model, &name, &made)?);
            warnings.extend(fast_current(model, &name, &made)?);
            if let Some(coarse) = coarse_slow_drift(model, body)? {
                let coarse = coarse.damping_on_plan(yaw)? * factor;
                if (coarse - on_plan).norm() > COARSE_SHARE * on_plan.norm() {
                    warnings.push(format!(
                        "the wave drift damping of {name} is uncertain: by every second frequency of its mean drift alone it differs by {:.0} %; a database with \
                         more periods where the waves are settles it",
                        100.0 * (coarse - on_plan).norm() / on_plan.norm()
                    ));
                }
            }
            if let Some((without, gap)) = slow_drift_without_heading_slopes(model, body)? {
                let share = (without.damping_on_plan(yaw)? * factor - on_plan).norm() / on_plan.norm();
                if gap > WIDEST_SURE_GAP && share > SHARE_OF_HEADINGS {
                    warnings.push(format!(
                        "the wave drift damping of {name} across the waves is uncertain: {:.0} % of the damping is by the change of the mean drift with the heading, and the \
                         database has headings {:.0} degrees apart there; at most 45 are close enough",
                        100.0 * share,
                        gap.to_degrees()
                    ));
                }
            }
        }
        VelocityEffect::LeftOut(reason) => warnings
            .push(format!("{name} has no wave drift damping, and no change of its mean drift by a current: {reason}")),
        VelocityEffect::OffByFactor => {
            notes.push(format!(
                "the wave drift damping of {name} is left out, and what a current changes of its drift (-DD_MULT 0)"
            ));
        }
        VelocityEffect::None => return Ok(None),
    }
    Ok(Some(BodyDriftDamping { name, damping: own_axes(&on_plan), by_current, warnings, notes }))
}

/// Share of the energy of the sea in waves of some frequencies (rad/s).
fn energy_share(model: &Model, counts: impl Fn(f64) -> bool) -> Result<f64, ClassError> {
    let (mut part, mut whole) = (0.0, 0.0);
    for (frequency, energy) in Steady::new(model)?.waves.iter().flat_map(|(_, waves)| &waves.energies) {
        whole += energy;
        part += if counts(*frequency) { *energy } else { 0.0 };
    }
    Ok(if whole > 0.0 { part / whole } else { 0.0 })
}

/// The warning of waves for which the water is not deep, where they have much of the energy.
fn shallow_waves(model: &Model, name: &str, made: &DriftByVelocity) -> Result<Option<String>, ClassError> {
    let shallow = energy_share(model, |frequency| !made.is_deep(frequency))?;
    Ok((shallow > SHALLOW_SHARE).then(|| {
        format!(
            "waves with {:.0} % of the energy of the sea have no part in the wave drift damping of {name}, nor in what a current changes of its drift: the water is not deep \
             for them, less than half their length, and the formula of Aranha holds in deep water alone",
            100.0 * shallow
        )
    }))
}

/// The warning of a current that is too fast for waves with much of the energy.
fn fast_current(model: &Model, name: &str, made: &DriftByVelocity) -> Result<Option<String>, ClassError> {
    let fast = energy_share(model, |frequency| made.speed_number(frequency) > FASTEST_CURRENT)?;
    Ok((fast > FAST_SHARE).then(|| {
        format!(
            "what the current changes of the mean drift of {name} is uncertain: the formula of Aranha is linear in its speed, and for waves with {:.0} % of the energy of the \
             sea the frequency by the speed over gravity is above {FASTEST_CURRENT}; -DD_MULT 0 leaves the change out",
            100.0 * fast
        )
    }))
}

/// The dampings as a table; none of no bodies.
pub fn drift_damping_table(list: &[BodyDriftDamping]) -> Option<Table> {
    if list.is_empty() {
        return None;
    }
    const DAMPING: Dim = Dim::Derived { force: 1, length: -1, seconds: 1 };
    let mut table = Table::new("Wave Drift Damping")
        .with_rows(list)
        .text("Body", |row| &row.name)
        .column("Damping", "Surge", DAMPING, Digits::Scientific(4), |row| row.damping[(0, 0)])
        .column("Damping", "Sway", DAMPING, Digits::Scientific(4), |row| row.damping[(1, 1)])
        .column("Damping", "Surge-Sway", DAMPING, Digits::Scientific(4), |row| row.damping[(0, 1)])
        .column("Drift by Current", "X", Dim::Force, Digits::Usual, |row| row.by_current.x)
        .column("Drift by Current", "Y", Dim::Force, Digits::Usual, |row| row.by_current.y)
        .build();
    table.note(
        "in the whole sea by the formula of Aranha, in deep water; damping along the axes of the body where it stands, drift that the mean current adds along global \
         axes; -DD_MULT multiplies both",
    );
    list.iter().flat_map(|row| &row.notes).for_each(|text| table.note(text.as_str()));
    Some(table)
}
