//! `&DIMEN` and `&DEFAULT`.

use super::{Call, Command, Effect, Job};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::units::{Dim, ForceUnit, LengthUnit, UnitSystem};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::Coordinates;

/// &DIMEN.
pub static DIMEN: Command = Command { spec: &DIMEN_SPEC, edits: false, run: dimen };
/// &DEFAULT.
pub static DEFAULT: Command = Command { spec: &DEFAULT_SPEC, edits: false, run: default };

static DIMEN_SPEC: CommandSpec = CommandSpec {
    options: &[
        OptionSpec::new("-SAVE", &[], "keeps the present units for -REMEMBER"),
        OptionSpec::new(
            "-DIMEN",
            &[
                ValueSpec::new("LENGTH", Kind::Choice(&["FEET", "METERS"]), "length unit"),
                ValueSpec::new("FORCE", Kind::Choice(FORCES), "force unit"),
            ],
            "sets the units of all that follows",
        ),
        OptionSpec::new("-REMEMBER", &[], "goes back to the units saved last"),
    ],
    detail: "FEET go with KIPS, L-TONS and S-TONS (sections in inches, stress in ksi), METERS with K-NTS and M-TONS (mm, \
             MPa); KN, N and NEWTONS are ours. The model is kept in SI: changing units never changes it.",
    example: "&DIMEN -SAVE -DIMEN METERS K-NTS\n&STATUS DIMENSIONS\n&DIMEN -REMEMBER",
    ..CommandSpec::new("&DIMEN", "sets the units")
};

const FORCES: &[&str] = &["KIPS", "L-TONS", "S-TONS", "K-NTS", "M-TONS", "KN", "N", "NEWTONS"];

fn dimen(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let mut units = job.units;
    let mut saved = job.saved_units.clone();
    for given in &call.args.options {
        match given.name {
            "-SAVE" => saved.push(units),
            "-REMEMBER" => {
                units = saved.pop().ok_or_else(|| {
                    Diagnostic::error("no units have been saved", given.span).help("&DIMEN -SAVE saves them")
                })?;
            }
            _ => {
                let length = if given.word(0) == Some("FEET") { LengthUnit::Feet } else { LengthUnit::Meters };
                let force = match given.word(1) {
                    Some("KIPS") => ForceUnit::Kips,
                    Some("L-TONS") => ForceUnit::LongTons,
                    Some("S-TONS") => ForceUnit::ShortTons,
                    Some("M-TONS") => ForceUnit::MetricTons,
                    Some("K-NTS" | "KN") => ForceUnit::Kilonewtons,
                    _ => ForceUnit::Newtons,
                };
                let feet = matches!(force, ForceUnit::Kips | ForceUnit::LongTons | ForceUnit::ShortTons);
                if feet != (length == LengthUnit::Feet) {
                    let span = given.values.get(1).map_or(given.span, |v| v.span);
                    let fitting =
                        if length == LengthUnit::Feet { "KIPS, L-TONS or S-TONS" } else { "K-NTS, M-TONS or N" };
                    return Err(Diagnostic::error("this force unit does not go with this length unit", span)
                        .label(format!("expected {fitting}")));
                }
                units = UnitSystem { length, force };
            }
        }
    }
    (job.units, job.saved_units) = (units, saved);
    Ok(Effect::Done)
}

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

static DEFAULT_SPEC: CommandSpec = CommandSpec {
    options: &[
        OptionSpec::new("-SAVE", &[], "keeps the present defaults for -REMEMBER"),
        OptionSpec::new("-REMEMBER", &[], "goes back to the defaults saved last"),
        OptionSpec::new(
            "-SPGRAVITY",
            &[number("SPGR", Dim::None, "specific gravity").positive()],
            "specific gravity of materials",
        ),
        OptionSpec::new("-DENSITY", &[number("RHO", Dim::Density, "density").positive()], "density of materials"),
        OptionSpec::new("-EMODULUS", &[number("EMOD", Dim::Stress, "Young's modulus").positive()], "Young's modulus"),
        OptionSpec::new(
            "-POI_RAT",
            &[number("POIRAT", Dim::None, "Poisson's ratio").within(0.0, 0.5)],
            "Poisson's ratio",
        ),
        OptionSpec::new("-ALPHA", &[number("ALPHA", Dim::ThermalExpansion, "thermal expansion")], "thermal expansion"),
        OptionSpec::new("-FYIELD", &[number("FYIELD", Dim::Stress, "yield stress").positive()], "yield stress"),
        OptionSpec::new("-TENSTR", &[number("TENSTR", Dim::Stress, "ultimate stress").positive()], "ultimate stress")
            .default("yield / 0.6"),
        OptionSpec::new("-WATER", &[number("RHO", Dim::Density, "density").positive()], "density of sea water"),
        OptionSpec::new(
            "-SPGWATER",
            &[number("SG", Dim::None, "specific gravity").positive()],
            "specific gravity of sea water",
        ),
        OptionSpec::new("-DEPTH", &[number("DEPTH", Dim::Length, "depth").positive()], "water depth"),
        OptionSpec::new("-RAMP", &[number("T", Dim::Time, "time").not_negative()], "ramp of time-domain runs"),
        OptionSpec::new("-RECT", &[], "points are given by x y z"),
        OptionSpec::new("-CYLINDER", &[], "points are given by radius, angle, z"),
        OptionSpec::new("-SPHERICAL", &[], "points are given by radius, angle, angle above the plane"),
        OptionSpec::new("-AIR", &[number("RHO", Dim::Density, "density").positive()], "density of air")
            .owner(Owner::Ours),
        OptionSpec::new("-GRAVITY", &[number("G", Dim::Acceleration, "gravity").positive()], "gravity")
            .owner(Owner::Ours),
    ],
    detail: "What holds where a record gives no value; &STATUS DEFAULTS lists all. Defaults hold for classes defined after.",
    example: "&DEFAULT -SAVE -EMODULUS 12000\n&STATUS DEFAULTS\n&DEFAULT -REMEMBER",
    ..CommandSpec::new("&DEFAULT", "sets defaults")
};

fn default(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let mut defaults = job.model.defaults;
    let mut saved = job.model.saved_defaults.clone();
    for given in &call.args.options {
        let value = given.number(0).unwrap_or(0.0);
        let material = &mut defaults.material;
        match given.name {
            "-SAVE" => saved.push(defaults),
            "-REMEMBER" => {
                defaults = saved.pop().ok_or_else(|| {
                    Diagnostic::error("no defaults have been saved", given.span).help("&DEFAULT -SAVE saves them")
                })?;
            }
            "-SPGRAVITY" => material.density = 1000.0 * value,
            "-DENSITY" => material.density = value,
            "-EMODULUS" => material.emodulus = value,
            "-POI_RAT" => material.poisson = value,
            "-ALPHA" => material.expansion = value,
            "-FYIELD" => material.yield_stress = value,
            "-TENSTR" => material.ultimate_stress = Some(value),
            "-WATER" => defaults.water_density = value,
            "-SPGWATER" => defaults.water_density = 1000.0 * value,
            "-DEPTH" => defaults.depth = Some(value),
            "-RAMP" => defaults.ramp = value,
            "-RECT" => defaults.coordinates = Coordinates::Rectangular,
            "-CYLINDER" => defaults.coordinates = Coordinates::Cylindrical,
            "-SPHERICAL" => defaults.coordinates = Coordinates::Spherical,
            "-AIR" => defaults.air_density = value,
            _ => defaults.gravity = value,
        }
    }
    (job.model.defaults, job.model.saved_defaults) = (defaults, saved);
    Ok(Effect::Done)
}
