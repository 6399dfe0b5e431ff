//! `&STATUS DIMENSIONS` and `DEFAULTS`.

use crate::commands::Job;
use crate::commands::post::prcpost::last_run;
use crate::commands::settings::units;
use crate::commands::status::kind::StatusKind;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{Coordinates, Model};
use windlass_solve::run_tables::run_table;

/// `&STATUS RUN`.
pub static RUN: StatusKind = StatusKind::new("RUN", "how the last run went", |query, _| {
    Ok(vec![run_table(last_run(query.job, query.args().span)?)])
});

/// `&STATUS DIMENSIONS`.
pub static DIMENSIONS: StatusKind = StatusKind::new("DIMENSIONS", "units", |query, _| Ok(vec![dimensions(query.job)]));

/// `&STATUS DEFAULTS`.
pub static DEFAULTS: StatusKind = StatusKind::new("DEFAULTS", "defaults", |query, _| Ok(vec![defaults(query.model())]));

/// Units.
pub(crate) fn dimensions(job: &Job) -> Table {
    let (length, force) = job.units.words();
    let quantities = [
        ("length", Dim::Length),
        ("section size", Dim::Section),
        ("force", Dim::Force),
        ("force per length", Dim::ForcePerLength),
        ("moment", Dim::Moment),
        ("stress", Dim::Stress),
        ("density", Dim::Density),
        ("angle", Dim::Angle),
        ("velocity", Dim::Velocity),
        ("wind speed", Dim::WindSpeed),
    ];
    Table::new("Dimensions")
        .fact("Length", length, Dim::None)
        .fact("Force", force, Dim::None)
        .fact("Units Saved", job.saved_units.len(), Dim::None)
        .with_rows(&quantities)
        .text("Quantity", |(name, _)| *name)
        .text("Unit", |(_, dim)| dim.label(job.units))
        .column("", "In SI", Dim::None, Digits::Scientific(10), |(_, dim)| dim.factor(job.units))
        .build()
}

/// Defaults.
pub(crate) fn defaults(model: &Model) -> Table {
    let d = &model.defaults;
    let mode = match d.coordinates {
        Coordinates::Rectangular => units::RECT.name,
        Coordinates::Cylindrical => units::CYLINDER.name,
        Coordinates::Spherical => units::SPHERICAL.name,
        Coordinates::Placed(_) => units::LOCATION.name,
    };
    let waves = &model.wave_defaults;
    Table::new("Defaults")
        .fact("Density of Material", d.material.density, Dim::Density)
        .fact("Young's Modulus", d.material.emodulus, Dim::Stress)
        .fact("Poisson's Ratio", d.material.poisson, Dim::None)
        .fact("Thermal Expansion", d.material.expansion, Dim::ThermalExpansion)
        .fact("Yield Stress", d.material.yield_stress, Dim::Stress)
        .fact("Ultimate Stress", d.material.ultimate(), Dim::Stress)
        .fact("Density of Sea Water", d.water_density, Dim::Density)
        .fact("Density of Air", d.air_density, Dim::Density)
        .fact("Gravity", d.gravity, Dim::Acceleration)
        .fact("Water Depth", d.depth, Dim::Length)
        .fact("Ramp", d.ramp, Dim::Time)
        .fact("Coordinates of Points", mode, Dim::None)
        .fact("Periods of RAO", waves.periods.len(), Dim::None)
        .fact("Headings of RAO", waves.headings.len(), Dim::None)
        .fact("Time of Reinforcement", waves.reinforcement, Dim::Time)
        .fact("Directions of Sea, Wind, Current", "where they come from, from +X toward +Y", Dim::None)
        .fact("Directions of -ANCHOR", "from fairlead to anchor, from +X toward +Y", Dim::None)
}
