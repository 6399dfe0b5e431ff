//! `-PROBABILITY` of `&ENV`: which extreme the statistics of FREQ_RESPONSE tell. What each word does is our reading.

use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::ValueKey;
use windlass_base::units::Dim;
use windlass_base::values::{Given, Value};
use windlass_language::number::evaluate;
use windlass_language::select::choose_word;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_model::{Environment, Model};
use windlass_solve::frequency::ExtremeKind;

choices! {
    /// What DATA is.
    enum Statistic {
        /// A multiple of the rms.
        Rms = "RMS",
        /// A multiple of the significant amplitude.
        Significant = "SIGNIFICANT",
        /// Hours.
        Maximum = "MAXIMUM",
        /// Seconds.
        Time = "TIME",
        /// A share of the peaks.
        Probability = "PROBABILITY",
    }
}

/// The option.
pub(crate) const PROBABILITY: OptionSpec = OptionSpec::new(
    "-PROBABILITY",
    &[
        ValueSpec::new("STAT", Kind::Item, "RMS, SIGNIFICANT, MAXIMUM, TIME or PROBABILITY; or a number of rms"),
        ValueSpec::new("DATA", Kind::Number(Dim::None), "its value").or("1; 3 h of MAXIMUM; 10800 s of TIME; 0.001"),
    ],
    "the maximum that STATISTICS of FREQ_RESPONSE reports: a number times the rms (-PROBABILITY 4.2), DATA times the rms or the significant amplitude, the most probable one of DATA \
     hours (MAXIMUM) or seconds (TIME), the one that a share DATA of the peaks exceeds (PROBABILITY)",
);

const DATA: ValueKey<f64> = PROBABILITY.number("DATA");

/// What a record says.
fn read(given: &Given) -> Result<ExtremeKind, &'static str> {
    let data = given.number(DATA);
    let or = |usual: f64| data.unwrap_or(usual);
    let first = given.values.first();
    let times = first.and_then(|value| value.number().or_else(|| evaluate(value.word()?).ok()));
    let made = match times {
        Some(times) if data.is_none() => ExtremeKind::Times(times),
        Some(_) => return Err("a number of rms takes no DATA"),
        None => by_statistic(first.and_then(|value| statistic(value).ok()).ok_or("STAT is not given")?, or),
    };
    match made {
        ExtremeKind::Exceeded(share) if !(share > 0.0 && share < 1.0) => Err("a share of the peaks is between 0 and 1"),
        ExtremeKind::Times(value) | ExtremeKind::MostProbable(value) if value <= 0.0 => {
            Err("the number must be greater than zero")
        }
        made => Ok(made),
    }
}

/// The statistic a word names.
fn statistic(value: &Value) -> Outcome<Statistic> {
    choose_word(value.word().unwrap_or_default(), value.span, "value of STAT of -PROBABILITY")
}

fn by_statistic(statistic: Statistic, or: impl Fn(f64) -> f64) -> ExtremeKind {
    match statistic {
        Statistic::Rms => ExtremeKind::Times(or(1.0)),
        Statistic::Significant => ExtremeKind::Times(2.0 * or(1.0)),
        Statistic::Maximum => ExtremeKind::MostProbable(3600.0 * or(3.0)),
        Statistic::Time => ExtremeKind::MostProbable(or(10_800.0)),
        Statistic::Probability => ExtremeKind::Exceeded(or(1e-3)),
    }
}

/// Sees that a record can be used.
///
/// # Errors
/// A value that is none of its statistic.
pub(crate) fn check(given: &Given) -> Outcome<()> {
    if let Some(first) = given.values.first().filter(|v| v.word().is_some_and(|word| evaluate(word).is_err())) {
        statistic(first)?;
    }
    let position = given.position(DATA);
    read(given).map(|_| ()).map_err(|text| Diagnostic::error(text, position))
}

/// The extreme that the environment in force asks for, else `&DEFAULT`.
pub(crate) fn extreme(model: &Model) -> Option<ExtremeKind> {
    extreme_in(model, &model.environment)
}

/// The extreme that an environment asks for, else `&DEFAULT`.
pub(crate) fn extreme_in(model: &Model, env: &Environment) -> Option<ExtremeKind> {
    let given = env.options.iter().rev().find(|given| given.is(&PROBABILITY));
    given.or(model.wave_defaults.probability.as_ref()).and_then(|given| read(given).ok())
}
