//! The options of `&ENV` that make wave components of its seas.

use crate::commands::Job;
use crate::commands::environment::env;
use std::f64::consts::TAU;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::ValueKey;
use windlass_base::units::Dim;
use windlass_base::values::{Args, Given, Group};
use windlass_language::select::Owner;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_model::options::PHASES;
use windlass_model::{Components, CurveKind, Division, ElevationHistory, Environment, GivenWave, Phasing, Stretching};

/// The options of which the last one holds.
const PHASINGS: [OptionSpec; 3] = [env::T_REINFORCE, SEED, PHASES];

/// -WAVES.
pub(crate) const WAVES: OptionSpec = OptionSpec::new(
    "-WAVES",
    &[
        env::number("T", Dim::Time, "period").positive(),
        env::number("A", Dim::Length, "amplitude").not_negative(),
        env::number("PHASE", Dim::Angle, "phase: zeta = A cos(k x - w t + PHASE), x along its travel"),
        env::number("DIR", Dim::Angle, "direction it comes from"),
    ],
    "waves one by one, added to -SEA",
)
.repeating(4)
.default("none")
.owner(Owner::Ours);

/// -S_HISTORY.
pub(crate) const S_HISTORY: OptionSpec = OptionSpec::new(
    "-S_HISTORY",
    &[
        env::curve("S_HISTORY curve"),
        env::number("DIR", Dim::Angle, "direction its waves come from"),
        env::number("HIGH", Dim::Frequency, "highest frequency of its waves").or("none").positive(),
    ],
    "waves by their elevation over time at X = Y = 0, added to -SEA",
)
.default("none")
.owner(Owner::Ours);

/// -COMPONENTS.
pub(crate) const COMPONENTS: OptionSpec = OptionSpec::new(
    "-COMPONENTS",
    &[
        ValueSpec::new("N", Kind::Integer, "how many for each sea").in_range(1.0, 5000.0),
        ValueSpec::choice::<Division>("TYPE", "how the spectrum is cut").or("EQUAL_ENERGY"),
        ValueSpec::new("LOW", Kind::Number(Dim::Frequency), "lowest frequency").or("none").positive(),
        ValueSpec::new("HIGH", Kind::Number(Dim::Frequency), "highest frequency, given with LOW").or("none").positive(),
    ],
    "wave components",
)
.default("200 EQUAL_ENERGY")
.owner(Owner::Ours);

/// -SEED.
pub(crate) const SEED: OptionSpec = OptionSpec::new(
    "-SEED",
    &[ValueSpec::new("N", Kind::Integer, "whole number").in_range(0.0, 9e15)],
    "random phases of the wave components, from this seed",
)
.default("1, without -T_REINFORCE")
.owner(Owner::Ours);

/// -STRETCHING.
pub(crate) const STRETCHING: OptionSpec = OptionSpec::new(
    "-STRETCHING",
    &[ValueSpec::choice::<Stretching>("TYPE", "method")],
    "kinematics of waves above the mean level",
)
.default("LINEAR")
.owner(Owner::Ours);

/// -STOKES.
pub(crate) const STOKES: OptionSpec = OptionSpec::new(
    "-STOKES",
    &[ValueSpec::new("N", Kind::Integer, "order").in_range(2.0, 5.0)],
    "order of a STOKES wave",
)
.default("5")
.owner(Owner::Ours);

/// Takes one of these options, or one of MOSES's on the components.
pub(crate) fn apply(job: &Job, env: &mut Environment, given: &Given) -> Outcome<()> {
    let whole = || given.first_integer().and_then(|n| u64::try_from(n).ok());
    match given {
        _ if given.is(&COMPONENTS) => env.components = Some(components(given)?),
        _ if given.is(&WAVES) => env.waves = given.groups().map(|group| wave(&group)).collect(),
        _ if given.is(&S_HISTORY) => {
            env::known_curve(job, given.values.first(), given, CurveKind::ElevationHistory)?;
            env.elevation = Some(ElevationHistory {
                curve: env::formula(given, None),
                direction: given.number(const { S_HISTORY.number("DIR") }).unwrap_or(0.0),
                highest: given.number(const { S_HISTORY.number("HIGH") }),
            });
        }
        _ if given.is(&env::S_PERIOD) => env.sea_periods = given.numbers(),
        _ if given.is(&PHASES) => env.sea_phases = given.numbers(),
        _ if given.is(&SEED) => env.phasing = whole().map(Phasing::Seeded),
        _ if given.is(&env::T_REINFORCE) => env.phasing = given.first_number().map(Phasing::Reinforced),
        _ if given.is(&STOKES) => env.stokes = whole().and_then(|n| u8::try_from(n).ok()),
        _ if given.is(&STRETCHING) => {
            env.stretching = given.choice(const { STRETCHING.choice("TYPE") });
        }
        _ => return Ok(()),
    }
    if given.is_any(&PHASINGS) {
        env.options.retain(|g| !g.is_any(&PHASINGS));
        if given.is(&PHASES) {
            env.phasing = None;
        } else {
            env.sea_phases.clear();
        }
    }
    Ok(())
}

/// One wave of -WAVES.
fn wave(group: &Group<'_>) -> GivenWave {
    let [period, amplitude, phase, direction] =
        group.numbers_or_zero(const { WAVES.numbers(["T", "A", "PHASE", "DIR"]) });
    GivenWave { frequency: TAU / period, amplitude, phase, direction }
}

/// Refuses two ways to make phases in one record.
pub(crate) fn one_phasing(args: &Args) -> Outcome<()> {
    let mut given = PHASINGS.iter().filter_map(|option| args.option(option));
    match (given.next(), given.next()) {
        (Some(one), Some(other)) => {
            let text = format!("phases come from {} or from {}, not from both", one.name(), other.name());
            Err(Diagnostic::error(text, other.span).other(one.span, "the other one"))
        }
        _ => Ok(()),
    }
}

fn components(given: &Given) -> Outcome<Components> {
    let number = given.integer(const { COMPONENTS.integer("N") }).and_then(|n| usize::try_from(n).ok()).unwrap_or(1);
    let division: Option<Division> = given.choice(const { COMPONENTS.choice("TYPE") });
    const LOW: ValueKey<f64> = COMPONENTS.number("LOW");
    const HIGH: ValueKey<f64> = COMPONENTS.number("HIGH");
    let limits = match (given.number(LOW), given.number(HIGH)) {
        (Some(low), Some(high)) if high > low => Some([low, high]),
        (Some(_), Some(_)) => {
            return Err(Diagnostic::error("the highest frequency is not above the lowest", given.position(HIGH))
                .other(given.position(LOW), "the lowest"));
        }
        (None, None) => None,
        _ => {
            return Err(Diagnostic::error("a lowest frequency needs a highest one", given.position(LOW))
                .help("form: -COMPONENTS N TYPE LOW HIGH"));
        }
    };
    Ok(Components { number, division: division.unwrap_or_default(), limits, span: given.span })
}
