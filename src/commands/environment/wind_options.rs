//! The options of `&ENV` on wind.

use crate::commands::Job;
use crate::commands::environment::env::{PERIODS, curve, formula, known_curve, number, periods, spectrum};
use windlass_base::choices;
use windlass_base::diagnostic::Outcome;
use windlass_base::units::{Dim, METRES_PER_SECOND_PER_KNOT};
use windlass_base::values::{Given, Noun};
use windlass_hydro::gusts;
use windlass_language::select::Owner;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_model::{CurveKind, CurveReference, Environment, FormulaChoice, GustParts, Wind, WindCode, WindLaw};

choices! {
    /// The unit of a speed of wind.
    #[derive(Default)]
    pub(crate) enum WindUnit {
        #[default]
        Knots = "KNOTS",
        MetresPerSecond = "M/S",
        FeetPerSecond = "FT/S",
        KilometresPerHour = "KM/H",
        MilesPerHour = "MPH",
    }
}

impl WindUnit {
    /// A speed (m/s) of a number that was read as knots and is in this unit.
    fn speed(self, read: f64) -> f64 {
        let per_knot = match self {
            WindUnit::Knots => return read,
            WindUnit::MetresPerSecond => 1.0,
            WindUnit::FeetPerSecond => 0.3048,
            WindUnit::KilometresPerHour => 1.0 / 3.6,
            // the statute mile, 5280 ft
            WindUnit::MilesPerHour => 5280.0 * 0.3048 / 3600.0,
        };
        read / METRES_PER_SECOND_PER_KNOT * per_knot
    }
}

/// -WIND.
pub(crate) const WIND: OptionSpec = OptionSpec::new(
    "-WIND",
    &[
        number("SPEED", Dim::WindSpeed, "speed").not_negative(),
        number("DIR", Dim::Angle, "direction it comes from"),
        ValueSpec::choice::<WindUnit>("UNIT", "the unit of SPEED").or("KNOTS, whatever &DIMEN says"),
    ],
    "wind, in knots unless UNIT says otherwise",
)
.default("none");

/// -W_PROFILE.
pub(crate) const PROFILE: OptionSpec = OptionSpec::new(
    "-W_PROFILE",
    &[
        ValueSpec::choice::<WindLaw>("TYPE", "type"),
        number("EXP", Dim::None, "exponent").or("that of the type").not_negative(),
    ],
    "wind profile",
);

/// -W_DESIGN.
pub(crate) const DESIGN: OptionSpec = OptionSpec::new(
    "-W_DESIGN",
    &[
        ValueSpec::choice::<WindCode>("TYPE", "type"),
        number("DURATION", Dim::Time, "averaging time").or("that of the type").positive(),
    ],
    "design wind",
);

/// -W_SPECTRUM.
pub(crate) const SPECTRUM: OptionSpec = OptionSpec::new(
    "-W_SPECTRUM",
    &[ValueSpec::new("TYPE", Kind::ChoiceOrName(gusts::NAMES, Noun::Curve), "a gust spectrum, or a curve of one")],
    "gust spectrum",
);

/// -W_HISTORY.
pub(crate) const HISTORY: OptionSpec = OptionSpec::new("-W_HISTORY", &[curve("W_HISTORY curve")], "wind history");

/// -W_PERIOD.
pub(crate) const PERIOD: OptionSpec = OptionSpec::new("-W_PERIOD", PERIODS, "periods of the gusts").repeating(1);

/// -W_COMPONENTS.
pub(crate) const COMPONENTS: OptionSpec = OptionSpec::new(
    "-W_COMPONENTS",
    &[
        ValueSpec::new("N", Kind::Integer, "number of components").in_range(1.0, 10_000.0),
        number("INTENSITY", Dim::None, "standard deviation over mean speed")
            .or("that of the spectrum")
            .in_range(0.001, 1.0),
    ],
    "components of the gusts",
)
.owner(Owner::Ours)
.default("100");

/// -W_MD_CORRELATION.
pub(crate) const CORRELATION: OptionSpec = OptionSpec::new(
    "-W_MD_CORRELATION",
    &[number("F", Dim::None, "factor").in_range(-1.0, 1.0)],
    "correlation of gusts and mean drift",
);

/// Takes one of these options.
pub(crate) fn apply(job: &Job, env: &mut Environment, given: &Given) -> Outcome<()> {
    match given {
        _ if given.is(&WIND) => {
            let [speed, direction] = const { WIND.numbers(["SPEED", "DIR"]) }.map(|key| given.number(key));
            let unit = given.choice(const { WIND.choice::<WindUnit>("UNIT") }).unwrap_or_default();
            let speed = speed.map(|speed| unit.speed(speed));
            env.wind = speed.zip(direction).map(|(speed, direction)| Wind { speed, direction });
        }
        _ if given.is(&PROFILE) => {
            let kind = given.choice(const { PROFILE.choice("TYPE") });
            let value = given.number(const { PROFILE.number("EXP") });
            env.wind_profile = kind.map(|kind| FormulaChoice { kind, value, span: given.span });
        }
        _ if given.is(&DESIGN) => {
            let kind = given.choice(const { DESIGN.choice("TYPE") });
            let value = given.number(const { DESIGN.number("DURATION") });
            env.design_wind = kind.map(|kind| FormulaChoice { kind, value, span: given.span });
        }
        _ if given.is(&SPECTRUM) => {
            spectrum(job, given, gusts::NAMES)?;
            let named = formula(given, None);
            env.gusts = Some(CurveReference { kind: named.kind.to_ascii_uppercase(), ..named });
        }
        _ if given.is(&PERIOD) => {
            periods(given)?;
            env.gust_periods = given.numbers();
        }
        _ if given.is(&COMPONENTS) => {
            let number = given.integer(const { COMPONENTS.integer("N") }).and_then(|n| usize::try_from(n).ok());
            let intensity = given.number(const { COMPONENTS.number("INTENSITY") });
            env.gust_parts = number.map(|number| GustParts { number, intensity, span: given.span });
        }
        _ if given.is(&HISTORY) => {
            known_curve(job, given.values.first(), given, CurveKind::WindHistory)?;
            env.wind_history = Some(formula(given, None));
        }
        _ if given.is(&CORRELATION) => {
            env.drift_correlation =
                Some(CurveReference { kind: String::new(), value: given.first_number(), span: given.span });
        }
        _ => {}
    }
    Ok(())
}
