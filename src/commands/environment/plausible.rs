//! What no sea, wind or current on record comes near, and friction that no soil has: warned of at the record.

use crate::commands::environment::env::{
    A_SEA_OPTION, CURRENT, DEPTH, SEA_OPTION, SP_TYPE_OPTION, SPGWATER, WATER as WATER_OPTION,
};
use crate::commands::environment::wind_options::WIND;
use std::f64::consts::TAU;
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_base::span::Span;
use windlass_base::units::{Dim, METRES_PER_SECOND_PER_KNOT, UnitSystem, eight_figures};
use windlass_base::values::Args;
use windlass_connectors::options::FRICTION;
use windlass_hydro::sea::Sea as Waves;
use windlass_hydro::sea::dispersion::wave_number;
use windlass_hydro::spectrum;
use windlass_language::spec::OptionSpec;
use windlass_model::{Current, Environment, Model, SeaDefinition};

/// The highest wind over a minute on record, 185 knots (m/s): hurricane Patricia, 2015 (NOAA, National Hurricane Center, EP202015).
const HIGHEST_WIND: f64 = 185.0 * METRES_PER_SECOND_PER_KNOT;
/// Faster than every ocean current and all but a few tidal races (m/s): the Gulf Stream reaches 2.5 m/s.
const FASTEST_CURRENT: f64 = 5.0;
/// The deepest place of the ocean (m): Challenger Deep.
const MAX_OCEAN_DEPTH_M: f64 = 10_935.0;
/// Fresh water at its lightest to brine (kg/m3).
const WATER_DENSITIES: [f64; 2] = [900.0, 1300.0];
/// Coefficients of chain on soil go up to 1.0 to 1.5 ([API-RP-2SK] gives 1.0 for chain, 0.6 for wire).
const MAX_FRICTION: f64 = 2.0;

/// A value as the user wrote it, to four figures, with its unit.
pub(crate) fn format_value(value: f64, dim: Dim, units: UnitSystem) -> String {
    let own = dim.from_si(value, units);
    let short = format!("{own:.3e}").parse().unwrap_or(own);
    format!("{} {}", eight_figures(short), dim.label(units)).trim_end().to_string()
}

/// The steepness 2 pi Hs / (g Tp2) that a sea state does not exceed [DNV-RP-C205 3.5.4]: 1/15 up to a peak period of 8 s, 1/25 from 15 s.
fn steepest(peak: f64) -> f64 {
    let share = ((peak - 8.0) / 7.0).clamp(0.0, 1.0);
    (1.0 - share) / 15.0 + share / 25.0
}

/// What of an environment cannot be, as far as a record gives it.
pub(crate) fn doubts(model: &Model, env: &Environment, args: &Args, units: UnitSystem) -> Vec<Diagnostic> {
    let mut made = Vec::new();
    let mut warn = |text: String, at: Span| made.push(*Diagnostic::warning(text, at));
    let given = |option: &OptionSpec| {
        let given = args.option(option)?;
        let value = given.values.first()?;
        Some((value.number()?, value.span))
    };
    if let Some((depth, at)) = given(&DEPTH).filter(|(depth, _)| *depth > MAX_OCEAN_DEPTH_M) {
        let (depth, deepest) =
            (format_value(depth, Dim::Length, units), format_value(MAX_OCEAN_DEPTH_M, Dim::Length, units));
        warn(format!("a depth of {depth}: the deepest ocean has {deepest}"), at);
    }
    for option in [WATER_OPTION, SPGWATER] {
        let Some((_, at)) = given(&option) else { continue };
        let density = model.surroundings_in(env).water_density;
        if !(WATER_DENSITIES[0]..=WATER_DENSITIES[1]).contains(&density) {
            let text = format!(
                "water of {}: sea water has about 1025 kg/m3, 64 lb/ft3",
                format_value(density, Dim::Density, units)
            );
            warn(text, at);
        }
    }
    let wind = given(&WIND).and_then(|(_, at)| env.wind.map(|wind| (wind.speed, at)));
    if let Some((speed, at)) = wind.filter(|(speed, _)| *speed > HIGHEST_WIND) {
        let speed = format_value(speed, Dim::WindSpeed, units);
        warn(format!("a wind of {speed}: the highest on record over a minute had 185 knots"), at);
    }
    if let Some(option) = args.option(&CURRENT) {
        let fastest = match &env.current {
            Some(Current::Uniform { velocity, .. }) => *velocity,
            Some(Current::Profiles(list)) => list
                .iter()
                .filter_map(|(name, _)| model.curves.get(&Model::key(name)))
                .flat_map(|curve| curve.points.iter().map(|(_, v)| v.abs()))
                .fold(0.0, f64::max),
            None => 0.0,
        };
        if fastest > FASTEST_CURRENT {
            let (speed, gulf) = (format_value(fastest, Dim::Velocity, units), format_value(2.5, Dim::Velocity, units));
            let at = option.first_place();
            warn(format!("a current of {speed}: the Gulf Stream reaches {gulf}, tidal races four times as much"), at);
        }
    }
    for (option, sea) in [(SEA_OPTION, &env.sea), (A_SEA_OPTION, &env.added_sea)] {
        if let Some(sea) = sea.as_ref().filter(|_| args.has(&option) || args.has(&DEPTH) || args.has(&SP_TYPE_OPTION))
            && let Some(doubt) = breaking(model, env, sea, units)
        {
            made.push(doubt);
        }
    }
    made
}

/// Why a sea cannot be: its wave or its significant wave breaks, or it is steeper than sea states are.
fn breaking(model: &Model, env: &Environment, sea: &SeaDefinition, units: UnitSystem) -> Option<Diagnostic> {
    let Ok(found) = spectrum::build_spectrum(model, env, sea, None) else {
        // an error where the sea is made
        return None;
    };
    let Some(found) = found else {
        // the waves of a regular sea are made quickly
        let error = Waves::new(model, env).err()?.diagnostic(sea.position(2), units);
        return Some(Diagnostic { severity: Severity::Warning, ..*error });
    };
    let around = model.surroundings_in(env);
    let depth = around.depth.map(|d| d + around.tide);
    let peak = TAU / found.peak();
    let k = wave_number(found.peak(), depth, around.gravity).ok()?;
    // [MICHE-1944]
    let highest = 0.142 * TAU / k * depth.map_or(1.0, |d| (k * d).tanh());
    let height = format_value(sea.height, Dim::Length, units);
    if sea.height > highest {
        let highest = format_value(highest, Dim::Length, units);
        let text = format!(
            "a significant height of {height} with a peak period of {} breaks: the highest wave of that period here is 0.142 L tanh(k d) = {highest}",
            format_value(peak, Dim::Time, units)
        );
        return Some(*Diagnostic::warning(text, sea.position(2)));
    }
    let (steepness, limit) = (TAU * sea.height / (around.gravity * peak * peak), steepest(peak));
    (steepness > limit).then(|| {
        let text = format!(
            "a significant height of {height} with a peak period of {}: 2 pi HS/(g Tp2) is {steepness:.3}, and sea states have {limit:.3} at most (DNV-RP-C205 3.5.4)",
            format_value(peak, Dim::Time, units)
        );
        *Diagnostic::warning(text, sea.position(2))
    })
}

/// What is said of a coefficient of friction of a class that nothing has.
pub(crate) fn friction(args: &Args) -> Option<Diagnostic> {
    let value = args.option_if_declared(&FRICTION)?.values.first()?;
    let mu = value.number().filter(|mu| *mu > MAX_FRICTION)?;
    let text =
        format!("a coefficient of friction of {}: chain on soil has 0.6 to 1.5, wire 0.3 to 0.6", eight_figures(mu));
    Some(*Diagnostic::warning(text, value.span))
}

#[cfg(test)]
mod tests {
    use super::steepest;

    #[test]
    fn steepness_limit_matches_dnv_rp_c205() {
        // 3.5.4: 1/15 for Tp <= 8 s, 1/25 for Tp >= 15 s, linear between
        for (tp, limit) in
            [(5.0, 1.0 / 15.0), (8.0, 1.0 / 15.0), (11.5, 0.5 / 15.0 + 0.5 / 25.0), (15.0, 0.04), (20.0, 0.04)]
        {
            assert!((steepest(tp) - limit).abs() < 1e-15, "{tp}");
        }
    }
}
