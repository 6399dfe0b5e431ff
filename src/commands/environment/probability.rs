//! `-PROBABILITY` of `&ENV`: which extreme the statistics of FREQ_RESPONSE tell. What each word does is our reading.

use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::ValueKey;
use windlass_base::units::Dim;
use windlass_base::values::Given;
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
        ValueSpec::choice::<Statistic>("STAT", "statistic"),
        ValueSpec::new("DATA", Kind::Number(Dim::None), "its value").or("1; 3 h of MAXIMUM; 10800 s of TIME; 0.001"),
    ],
    "the maximum that STATISTICS of FREQ_RESPONSE reports: DATA times the rms or the significant amplitude, the most probable one of DATA \
     hours (MAXIMUM) or seconds (TIME), the one that a share DATA of the peaks exceeds (PROBABILITY)",
);

const DATA: ValueKey<f64> = PROBABILITY.number("DATA");

/// What a record says.
fn read(given: &Given) -> Result<ExtremeKind, &'static str> {
    let data = given.number(DATA);
    let or = |usual: f64| data.unwrap_or(usual);
    let statistic = given.choice(const { PROBABILITY.choice("STAT") }).ok_or("STAT is not given")?;
    let made = match statistic {
        Statistic::Rms => ExtremeKind::Times(or(1.0)),
        Statistic::Significant => ExtremeKind::Times(2.0 * or(1.0)),
        Statistic::Maximum => ExtremeKind::MostProbable(3600.0 * or(3.0)),
        Statistic::Time => ExtremeKind::MostProbable(or(10_800.0)),
        Statistic::Probability => ExtremeKind::Exceeded(or(1e-3)),
    };
    match made {
        ExtremeKind::Exceeded(share) if !(share > 0.0 && share < 1.0) => Err("a share of the peaks is between 0 and 1"),
        ExtremeKind::Times(value) | ExtremeKind::MostProbable(value) if value <= 0.0 => {
            Err("DATA must be greater than zero")
        }
        made => Ok(made),
    }
}

/// Sees that a record can be used.
///
/// # Errors
/// A value that is none of its statistic.
pub(crate) fn check(given: &Given) -> Outcome<()> {
    let place = given.place(DATA);
    read(given).map(|_| ()).map_err(|text| Diagnostic::error(text, place))
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
