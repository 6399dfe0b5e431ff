//! `&STATUS ENVIRONMENT`: the tables.

use crate::commands::Job;
use crate::commands::environment::env;
use crate::commands::environment::wind_options;
use crate::commands::model_values::option_as_written;
use crate::commands::status::kind::StatusKind;
use crate::commands::status::sea_table::phasing;
use crate::commands::status::wind_table;
use windlass_base::table::{Cell, Table};
use windlass_base::units::Dim;
use windlass_hydro::gusts::Gusts;
use windlass_hydro::sea::spectra::GAMMA;
use windlass_hydro::spectrum::shape_of;
use windlass_hydro::steady::Steady;
use windlass_language::spec::OptionSpec;
use windlass_model::EntityKind;
use windlass_model::{Current, Environment, SeaDefinition};

/// `&STATUS ENVIRONMENT`.
pub static ENVIRONMENT: StatusKind =
    StatusKind::new("ENVIRONMENT", "the environment in force, or one kept under a name", |query, _| {
        Ok(environments(query.job, query.is_named().then_some(&query.fits())))
    })
    .with_names(&[EntityKind::Environment])
    .of_moses();

/// The environment in force, or those kept under a name that is chosen.
pub(crate) fn environments(job: &Job, chosen: Option<&dyn Fn(&str) -> bool>) -> Vec<Table> {
    let model = &job.model;
    match chosen {
        None => vec![environment(job, &model.environment)],
        Some(fits) => model.environments.values().filter(|e| fits(&e.name)).map(|e| environment(job, e)).collect(),
    }
}

/// The direction something travels toward that comes from a direction (rad).
fn opposite(from: f64) -> f64 {
    (from + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
}

/// The sum of currents at the surface, and at half depth and at the bottom where the depth is known.
fn depths(mut table: Table, steady: &Steady) -> Table {
    let deep = steady.around.depth.map(|d| d + steady.around.tide);
    let positions = [("at surface", Some(0.0)), ("at half depth", deep.map(|d| 0.5 * d)), ("at bottom", deep)];
    for (name, depth) in positions {
        let Some(depth) = depth else { continue };
        let velocity = steady.current.at_depth(depth).0;
        table = table.fact(&format!("Current {name}"), velocity.norm(), Dim::Velocity);
        if velocity.norm() > 0.0 {
            let toward = velocity.y.atan2(velocity.x).rem_euclid(std::f64::consts::TAU);
            table =
                table.fact("   comes from", opposite(toward), Dim::Angle).fact("   travels toward", toward, Dim::Angle);
        }
    }
    table
}

fn facts_of_sea(table: Table, name: &str, env: &Environment, sea: &SeaDefinition) -> Table {
    let table = table
        .fact(name, sea.spectrum.as_str(), Dim::None)
        .fact("   comes from", sea.direction, Dim::Angle)
        .fact("   travels toward", opposite(sea.direction), Dim::Angle)
        .fact("   height", sea.height, Dim::Length)
        .fact("   period", sea.period, Dim::Time);
    let shape = shape_of(env, sea);
    if shape.is_empty() {
        let kept = sea.shape.first().copied().flatten();
        return table.fact(&format!("   {}", GAMMA.name.to_lowercase()), kept, GAMMA.dim);
    }
    shape.iter().fold(table, |table, (parameter, value)| {
        table.fact(&format!("   {}", parameter.name.to_lowercase()), *value, parameter.dim)
    })
}

fn environment(job: &Job, env: &Environment) -> Table {
    let model = &job.model;
    let around = model.surroundings_in(env);
    let name = if env.name.is_empty() { "in Force" } else { &env.name };
    let mut table = Table::new(format!("Environment {name}"))
        .fact("Water Density", around.water_density, Dim::Density)
        .fact("Water Depth", around.depth, Dim::Length)
        .fact("Tide", around.tide, Dim::Length)
        .fact("Ramp", env.ramp.unwrap_or(model.defaults.ramp), Dim::Time);
    for (name, sea) in [("Sea", &env.sea), ("Added Sea", &env.added_sea)] {
        if let Some(sea) = sea {
            table = facts_of_sea(table, name, env, sea);
        }
    }
    if !env.waves.is_empty() {
        table = table.fact("Waves Given", env.waves.len(), Dim::None);
    }
    if let Some(history) = &env.elevation {
        table = table
            .fact("Elevation over Time", history.curve.kind.as_str(), Dim::None)
            .fact("   comes from", history.direction, Dim::Angle)
            .fact("   travels toward", opposite(history.direction), Dim::Angle);
    }
    if env.has_waves() || env.sea.is_some() || env.added_sea.is_some() {
        table = table.fact("Spreading Exponent", env.spreading.unwrap_or(200.0), Dim::None);
        match windlass_hydro::sea::Sea::new(model, env) {
            Ok(Some(sea)) => {
                table = table.fact("Wave Components", sea.components.len(), Dim::None).fact(
                    "Phases of Waves",
                    if sea.trains.iter().all(|train| train.is_given) { "as given".into() } else { phasing(&sea) },
                    Dim::None,
                );
            }
            Ok(None) => {}
            Err(error) => table.warn(error.text(job.units).to_string()),
        }
    }
    let steady = Steady::streams(model, env);
    let field = steady.as_ref().ok();
    if let Some(wind) = env.wind {
        table = table.fact("Wind", wind.speed, Dim::WindSpeed).fact("   comes from", wind.direction, Dim::Angle).fact(
            "   travels toward",
            opposite(wind.direction),
            Dim::Angle,
        );
        if let Some(field) = field.and_then(|s| s.wind) {
            let at = |height: f64| field.speed(height).0;
            table = table.fact("   speed at 10 m", at(10.0), Dim::WindSpeed).fact(
                "   speed at 50 m",
                at(50.0),
                Dim::WindSpeed,
            );
        }
    }
    match Gusts::new(model, env) {
        Ok(Some(gusts)) => table = wind_table::facts(table, &gusts),
        Ok(None) => {}
        Err(error) => table.warn(error.text(job.units).to_string()),
    }
    table = match &env.current {
        None => table,
        Some(Current::Uniform { velocity, direction }) => table
            .fact("Current", *velocity, Dim::Velocity)
            .fact("   comes from", *direction, Dim::Angle)
            .fact("   travels toward", opposite(*direction), Dim::Angle),
        Some(Current::Profiles(list)) => {
            let named = list.iter().fold(table, |t, (name, direction)| {
                t.fact("Current Profile", name.as_str(), Dim::None).fact("   comes from", *direction, Dim::Angle)
            });
            field.map_or(named.clone(), |f| depths(named, f))
        }
    };
    if let Err(error) = &steady {
        table.warn(error.text(job.units).to_string());
    }
    if env.run_start > 0.0 {
        table = table.fact("Start of Runs", env.run_start, Dim::Time);
    }
    if let Some(time) = env.time {
        table = table
            .fact("Time Observed", time.observed, Dim::Time)
            .fact("Time Step", time.step, Dim::Time)
            .fact("Transient", time.transient, Dim::Time)
            .fact("Cycles", time.cycles.map(Cell::Integer), Dim::None);
    }
    others(table, env, job)
}

/// The options kept that have no line of their own above, as they were given.
fn others(mut table: Table, env: &Environment, job: &Job) -> Table {
    const SHOWN: [OptionSpec; 12] = [
        env::WATER,
        env::SPGWATER,
        env::DEPTH,
        env::TIDE,
        env::RAMP,
        env::SEA_OPTION,
        env::A_SEA_OPTION,
        env::SPREAD_OPTION,
        wind_options::WIND,
        env::CURRENT,
        env::TIME,
        env::START,
    ];
    for given in env.options.iter().filter(|given| !given.is_any(&SHOWN)) {
        let text = option_as_written(given, job.units);
        let values = text.split_once(' ').map_or("", |(_, values)| values);
        table = table.fact(given.name(), values, Dim::None);
    }
    table
}
