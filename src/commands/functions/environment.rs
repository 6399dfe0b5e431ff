//! `&ENV`: the environment in force, or one kept under a name.
//!
//! That MOSES has the function is known, what its actions give is our reading: the values as the options of `&ENV` take them.

use super::{numbers, pick};
use crate::commands::Job;
use windlass_base::choices;
use windlass_base::diagnostic::Outcome;
use windlass_base::units::Dim;
use windlass_language::record::Word;
use windlass_model::{Current, SeaDefinition, find};

choices! {
    /// What `&ENV` gives.
    enum EnvironmentAction {
        Name = "NAME",
        Depth = "DEPTH",
        Tide = "TIDE",
        Water = "WATER",
        SpecificGravity = "SPGWATER",
        Sea = "SEA",
        AddedSea = "A_SEA",
        Wind = "WIND",
        Current = "CURRENT",
        Time = "TIME",
        Ramp = "RAMP",
    }
}

/// The value of `&ENV(ACTION rest)`; empty where the environment has none.
pub(super) fn environment(job: &Job, action: &Word, rest: &[Word]) -> Outcome<String> {
    let action: EnvironmentAction = pick(action, "ENV")?;
    let model = &job.model;
    let env = match rest.first() {
        Some(name) => find(&model.environments, &name.text, "environment", name.span)?,
        None => &model.environment,
    };
    let around = model.surroundings_in(env);
    let sea = |sea: &Option<SeaDefinition>| {
        sea.as_ref().map_or(String::new(), |sea| {
            let direction = numbers(&[sea.direction], Dim::Angle, job);
            let height = numbers(&[sea.height], Dim::Length, job);
            format!("{} {direction} {height} {}", sea.spectrum, numbers(&[sea.period], Dim::Time, job))
        })
    };
    Ok(match action {
        EnvironmentAction::Name => env.name.clone(),
        EnvironmentAction::Depth => around.depth.map_or(String::new(), |d| numbers(&[d], Dim::Length, job)),
        EnvironmentAction::Tide => numbers(&[around.tide], Dim::Length, job),
        EnvironmentAction::Water => numbers(&[around.water_density], Dim::Density, job),
        EnvironmentAction::SpecificGravity => numbers(&[around.water_density / 1000.0], Dim::None, job),
        EnvironmentAction::Sea => sea(&env.sea),
        EnvironmentAction::AddedSea => sea(&env.added_sea),
        EnvironmentAction::Wind => env.wind.map_or(String::new(), |wind| {
            let speed = numbers(&[wind.speed], Dim::WindSpeed, job);
            format!("{speed} {}", numbers(&[wind.direction], Dim::Angle, job))
        }),
        EnvironmentAction::Current => match &env.current {
            None => String::new(),
            Some(Current::Uniform { velocity, direction }) => {
                let speed = numbers(&[*velocity], Dim::Velocity, job);
                format!("{speed} {}", numbers(&[*direction], Dim::Angle, job))
            }
            Some(Current::Profiles(list)) => list
                .iter()
                .map(|(name, direction)| format!("{name} {}", numbers(&[*direction], Dim::Angle, job)))
                .collect::<Vec<_>>()
                .join(" "),
        },
        EnvironmentAction::Time => env.time.map_or(String::new(), |time| {
            let all = [Some(time.observed), Some(time.step), time.transient];
            numbers(&all.into_iter().flatten().collect::<Vec<_>>(), Dim::Time, job)
        }),
        EnvironmentAction::Ramp => numbers(&[env.ramp.unwrap_or(model.defaults.ramp)], Dim::Time, job),
    })
}
