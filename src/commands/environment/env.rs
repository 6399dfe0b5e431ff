//! `&ENV`: wind, waves, current, water.
//!
//! Source: [MOSES-REF env].

use crate::commands::environment::plausible::format_value;
use crate::commands::environment::{ambient_options, plausible, probability, sea_options, wind_options};
use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::choice::YesNo;
use windlass_base::diagnostic::{Diagnostic, Outcome, did_you_mean};
use windlass_base::span::Span;
use windlass_base::spec::ValueKey;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::{Args, Given, Noun, Value};
use windlass_hydro::sea::spectra::{self, ShapeParameter};
use windlass_language::name as rule;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::options::PHASES;
use windlass_model::{
    Current, Curve, CurveKind, CurveReference, EntityKind, Environment, FormulaChoice, Model, PeriodType, Phasing,
    SeaDefinition, TimeWindow, find,
};

/// &ENV.
pub static ENV: Command = Command { spec: &ENV_SPEC, edits: false, run };
/// ENV within `&DATA ENVIRONMENT`.
pub static NAMED_ENV: Command = Command { spec: &NAMED_SPEC, edits: false, run: define };

pub(crate) const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}
pub(crate) const fn curve(help: &'static str) -> ValueSpec {
    ValueSpec::new("NAME", Kind::Name(Noun::Curve), help)
}

const SEA: &[ValueSpec] = &[
    ValueSpec::new("NAME", Kind::ChoiceOrName(spectra::NAMES, Noun::Curve), "a spectrum, or a curve of one"),
    number("DIR", Dim::Angle, "direction it comes from"),
    number("HS", Dim::Length, "significant height, or height of a regular wave").not_negative(),
    number("PERIOD", Dim::Time, "period").positive(),
    number("PARAM", Dim::None, "parameters of the spectrum, as GAMMA of JONSWAP").or("those of the spectrum"),
];
pub(crate) const PERIODS: &[ValueSpec] = &[number("T", Dim::Time, "period").positive()];

/// -SEA.
pub(crate) const SEA_OPTION: OptionSpec = OptionSpec::new("-SEA", SEA, "sea").repeating(1).default("none");
/// -A_SEA.
pub(crate) const A_SEA_OPTION: OptionSpec =
    OptionSpec::new("-A_SEA", SEA, "sea added to -SEA").repeating(1).default("none");
/// -SP_TYPE.
pub(crate) const SP_TYPE_OPTION: OptionSpec = OptionSpec::new(
    "-SP_TYPE",
    &[ValueSpec::choice::<PeriodType>("TYPE", "peak, mean or zero-crossing period")],
    "type of the spectrum's period",
);
/// -SPREAD.
pub(crate) const SPREAD_OPTION: OptionSpec =
    OptionSpec::new("-SPREAD", &[number("EXP", Dim::None, "exponent").positive()], "spreading cos(H - th)**EXP")
        .default("200: long-crested");

/// `-DURATION`.
pub(crate) const DURATION: OptionSpec =
    OptionSpec::new("-DURATION", &[number("D", Dim::Days, "days").not_negative()], "days, for fatigue");
/// `-WATER`.
pub(crate) const WATER: OptionSpec =
    OptionSpec::new("-WATER", &[number("RHO", Dim::Density, "density").positive()], "density of the water")
        .default("&DEFAULT");
/// `-SPGWATER`.
pub(crate) const SPGWATER: OptionSpec = OptionSpec::new(
    "-SPGWATER",
    &[number("SG", Dim::None, "specific gravity").positive()],
    "specific gravity of the water",
);
/// `-S_PERIOD`.
pub(crate) const S_PERIOD: OptionSpec =
    OptionSpec::new("-S_PERIOD", PERIODS, "periods of the sea's components").repeating(1);
const MD_PERIOD: OptionSpec =
    OptionSpec::new("-MD_PERIOD", PERIODS, "periods of the mean drift").repeating(1).without_effect();
/// `-TIME`.
pub(crate) const TIME: OptionSpec = OptionSpec::new(
    "-TIME",
    &[
        number("TOBSERV", Dim::Time, "time observed").positive(),
        number("DELTA_TIME", Dim::Time, "time step").positive(),
        number("TTRA_SET", Dim::Time, "time set aside for the transient: statistics leave it out")
            .or("0")
            .not_negative(),
        ValueSpec::new("NCYCLES", Kind::Integer, "cycles: kept and shown, without effect").or("1").in_range(1.0, 1e6),
    ],
    "time window",
);
/// `-START`.
pub(crate) const START: OptionSpec = OptionSpec::new(
    "-START",
    &[number("T", Dim::Time, "time").not_negative()],
    "time of the first instant of runs: waves, histories and actions are as at that time, and ramps and TTRA_SET count from it",
)
.owner(Owner::Ours)
.default("0");
/// `-RAMP`.
pub(crate) const RAMP: OptionSpec =
    OptionSpec::new("-RAMP", &[number("T", Dim::Time, "time").not_negative()], "ramp of the loads").default("&DEFAULT");
/// `-T_REINFORCE`.
pub(crate) const T_REINFORCE: OptionSpec = OptionSpec::new(
    "-T_REINFORCE",
    &[number("TB", Dim::Time, "time")],
    "time at which all wave components are in phase",
);
/// `-CURRENT`.
pub(crate) const CURRENT: OptionSpec = OptionSpec::new(
    "-CURRENT",
    &[
        ValueSpec::new("V", Kind::Text, "velocity (zero or more), or name of a C_PROFILE curve"),
        number("DIR", Dim::Angle, "direction it comes from"),
    ],
    "current: V DIR, or NAME1 DIR1 NAME2 DIR2 ..",
)
.repeating(2)
.default("none");
const C_HISTORY: OptionSpec =
    OptionSpec::new("-C_HISTORY", &[curve("C_HISTORY curve")], "factor of the current over time").owner(Owner::Ours);
/// `-TIDE`.
pub(crate) const TIDE: OptionSpec =
    OptionSpec::new("-TIDE", &[number("CHANGE", Dim::Length, "rise of the water level")], "tide").default("0");
/// `-DEPTH`.
pub(crate) const DEPTH: OptionSpec =
    OptionSpec::new("-DEPTH", &[number("D", Dim::Length, "depth").positive()], "water depth").default("&DEFAULT");
const M_GROWTH: OptionSpec = OptionSpec::new(
    "-M_GROWTH",
    &[curve("M_GROWTH curve"), number("RHO", Dim::Density, "density of the growth").or("1325 kg/m3").positive()],
    "marine growth",
);
const USE_MEAN: OptionSpec =
    OptionSpec::new("-USE_MEAN", &[ValueSpec::choice::<YesNo>("YES/NO", "on or off").or("YES")], "uses mean values")
        .without_effect();
/// `-E_PERIOD`.
pub(crate) const E_PERIOD: OptionSpec =
    OptionSpec::new("-E_PERIOD", PERIODS, "periods of the waves in SRESPONSE, where it gives none").repeating(1);

const OPTIONS: &[OptionSpec] = &[
    DURATION,
    WATER,
    SPGWATER,
    probability::PROBABILITY,
    SEA_OPTION,
    A_SEA_OPTION,
    sea_options::WAVES,
    sea_options::S_HISTORY,
    SP_TYPE_OPTION,
    SPREAD_OPTION,
    sea_options::COMPONENTS,
    sea_options::SEED,
    PHASES,
    sea_options::STRETCHING,
    sea_options::STOKES,
    S_PERIOD,
    MD_PERIOD,
    TIME,
    START,
    RAMP,
    T_REINFORCE,
    wind_options::WIND,
    wind_options::PROFILE,
    wind_options::DESIGN,
    wind_options::SPECTRUM,
    wind_options::HISTORY,
    wind_options::PERIOD,
    wind_options::COMPONENTS,
    wind_options::CORRELATION,
    CURRENT,
    C_HISTORY,
    TIDE,
    DEPTH,
    M_GROWTH,
    ambient_options::BATHYMETRY,
    ambient_options::T_PRESSURE,
    USE_MEAN,
    E_PERIOD,
];

static ENV_SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new("NAME", Kind::Name(Noun::New), "name to keep it under").or("none: start from nothing")],
    options: OPTIONS,
    detail: "Directions are where sea, wind and current come from, from +X toward +Y: 180 travels along +X, a head sea for a vessel whose X runs aft. Without a name the \
             environment starts from the defaults; a new name too, and is kept; an old name edits what is kept. It stays in \
             force until the next &ENV. NCYCLES of -TIME, -MD_PERIOD and -USE_MEAN are kept and shown, and act on nothing: the sources do not say what they do to a line. The sources list no types for -PROBABILITY, -SP_TYPE, -W_PROFILE, -W_DESIGN and \
             -W_SPECTRUM: those taken are the field's usual ones. Depth and tide together must leave water. \
             -T_PRESSURE names data of the command T_PRESSURE: what pipes of class ROD hold, and how warm. -BATHYMETRY names a bottom of \
             &BATHYMETRY: dynamic lines lie on it, anchors of connectors defined by -ANCHOR stand on it, and a quasi-static B_CAT lies on its profile along \
             the azimuth of the line. Lines of AQWA, and a B_CAT with -SLOPE or -DEPANCHOR or whose anchor was given an elevation, lie on a plane \
             through their anchor. Waves have the depth of -DEPTH everywhere. \
             -W_SPECTRUM adds gusts in the time domain, the same at all places and heights, on the speed 10 m up. \
             The speed of -WIND is then an hourly mean: periods from an hour to a second are taken, in -W_COMPONENTS of equal energy or about \
             those of -W_PERIOD, with phases of -SEED. A curve is a density over rad/s in ft2/s or m2/s, as it is; INTENSITY scales any \
             spectrum. -W_HISTORY takes the place of the speed of -WIND in the time domain, with its direction and profile; -C_HISTORY \
             multiplies the current; both are straight between their points, and with the gusts grow over -RAMP from the means, \
             on which statics stands. -M_GROWTH adds to the diameter of tubes in drag, inertia and waves, with its weight, buoyancy and inertia, by the elevations at which they stand when loads are made; not to other pieces; of lines it acts on dynamic ones, quasi-static lines have none. -W_MD_CORRELATION other than 0 is refused in the time domain. \
             -WIND is the mean 10 m above the water over the time of the formula (1 h for API, NPD, ISO; 10 min for DNV; 1 min for \
             ABS); below 1 m it is that of 1 m. -W_PROFILE: POWER, exponent 1/7 unless given (also without the option); \
             LOGARITHMIC, with Charnock's roughness; API RP 2A 20th edition, exponent 0.125; NPD (Froya) and ISO 19901-1; DNV-RP-C205; \
             ABS MODU rules, joined between the middles of their bands. -W_DESIGN turns the mean into that of DURATION by the gust \
             factor of its code, and gives the profile where -W_PROFILE does not. Currents of several curves add up as vectors; a curve \
             counts depth from the actual surface, tide included, is straight between its points and constant beyond them; below \
             the bottom there is none. What PERIOD is stands with each spectrum below; the highest peak of a curve is moved to it. A spectrum becomes wave components: bands of equal energy, the \
             frequency of each at the centroid of its energy, or of equal width (EQUAL_FREQUENCY, also at the centroid, so that the \
             sea does not repeat itself), or about the periods of -S_PERIOD; energy outside LOW to HIGH is left out. With -SPREAD \
             below 200 each component has one direction, from the cumulative spreading function at points of low discrepancy. \
             Phases are random from -SEED, 1 unless given: the same in every run, without the crest that one reinforcement time \
             makes; another seed is another realisation. A run begins at 0 s, or at -START, which leaves the sea as it is and enters it later: its instants, and the times of &ACTION, histories and phases, are times of the sea. \
             -T_REINFORCE puts all components in phase at X = Y = 0 at TB, as MOSES \
             does: the crest there is the sum of the amplitudes, which &STATUS SEA_SPECTRUM reports; let TB be outside the run unless \
             it is wanted. A regular wave has its crest at X = Y = 0 at TB, or at 0 s. Of -SEED, -T_REINFORCE and -PHASES the last one \
             holds. -PHASES gives the phase of each component, in the order of &STATUS SEA_SPECTRUM with the added sea last, of \
             zeta = sum a cos(k x - w t + phase), x along its travel. -WAVES gives waves one by one, -S_HISTORY those of an elevation \
             over time at X = Y = 0: the waves of its Fourier transform, whose sum passes through every value less their mean, and which repeat with the length of the \
             history. Both add to -SEA, and none of -PHASES, -SEED and -T_REINFORCE is theirs. -STRETCHING is what linear waves do above the mean level: LINEAR goes straight on from it, WHEELER takes the \
             actual surface for the mean level, DELTA is between the two (Rodenbusch and Forristall 1986: 0.3, over half the \
             significant height), EXPONENTIAL uses the profile itself also above the water, as AQWATM does; with the others \
             nothing moves above the actual surface. STOKES is Fenton's theory of order -STOKES, without a mean current; neither it \
             nor REGULAR may be higher than 0.142 L tanh(k d).",
    example: "&ENV STORM -SEA ISSC 180 22 10.3 -WIND 60 180 -DEPTH 3000\n&STATUS ENVIRONMENT",
    ..CommandSpec::new("&ENV", "sets the environment")
};

static NAMED_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::ENVIRONMENT],
    data: &[ValueSpec::new("NAME", Kind::Name(Noun::New), "name to keep it under")],
    detail: "As &ENV, but the environment is kept and not put in force.",
    example: "&DATA ENVIRONMENT\nENV CALM -DEPTH 500\nEND",
    ..CommandSpec { name: "ENV", help: "defines an environment", ..ENV_SPEC }
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let made = build(job, &call.args)?;
    if !made.name.is_empty() {
        job.model.environments.insert(Model::key(&made.name), made.clone());
    }
    doubt(job, &made, &call.args);
    job.model.environment = made;
    ambient_options::planes(job, call.args.option(&ambient_options::BATHYMETRY));
    Ok(Effect::Done)
}

fn define(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let made = build(job, &call.args)?;
    doubt(job, &made, &call.args);
    job.model.environments.insert(Model::key(&made.name), made);
    Ok(Effect::Done)
}

/// Warns of what cannot be.
fn doubt(job: &mut Job, made: &Environment, args: &Args) {
    let doubts = plausible::doubts(&job.model, made, args, job.units);
    job.notices.extend(doubts);
}

fn build(job: &Job, args: &Args) -> Outcome<Environment> {
    const NAME: DatumKey<str> = ENV_SPEC.word("NAME");
    let name = args.word(NAME).unwrap_or_default();
    if !name.is_empty() {
        rule::check(name, None, "environment", args.position(NAME))?;
        job.model.free_name(name, &[EntityKind::Environment], args.position(NAME))?;
    }
    let kept = job.model.environments.get(&Model::key(name)).filter(|_| !name.is_empty());
    let mut env = kept.cloned().unwrap_or_else(|| Environment {
        name: name.to_string(),
        span: args.span,
        phasing: job.model.wave_defaults.reinforcement.map(Phasing::Reinforced),
        ..Environment::default()
    });
    sea_options::one_phasing(args)?;
    for given in &args.options {
        apply(job, &mut env, given)?;
        env.options.retain(|g| !g.is(given.option));
        env.options.push(given.clone());
    }
    leaves_water(job, args, &env)?;
    Ok(env)
}

/// Sees that depth and tide leave water, where this record gives one of them.
fn leaves_water(job: &Job, args: &Args, env: &Environment) -> Outcome<()> {
    let around = job.model.surroundings_in(env);
    let Some(given) = args.option(&TIDE).or(args.option(&DEPTH)) else { return Ok(()) };
    match around.depth {
        Some(depth) if depth + around.tide <= 0.0 => {
            let shown = |length: f64| Dim::Length.from_si(length, job.units);
            let text = format!("a depth of {} with a tide of {} leaves no water", shown(depth), shown(around.tide));
            Err(Diagnostic::error(text, given.first_place()))
        }
        _ => Ok(()),
    }
}

/// Periods, each once.
pub(crate) fn periods(given: &Given) -> Outcome<()> {
    for (index, value) in given.values.iter().enumerate() {
        if let Some(first) = given.values.iter().take(index).find(|v| v.content == value.content) {
            return Err(Diagnostic::error(format!("{} has the same period twice", given.name()), value.span)
                .other(first.span, "first given here"));
        }
    }
    Ok(())
}

/// Puts what an option says into an environment.
///
/// # Errors
/// An option that contradicts itself, or names what is not there.
pub(crate) fn apply(job: &Job, env: &mut Environment, given: &Given) -> Outcome<()> {
    let value = given.first_number();
    match given {
        _ if given.is(&WATER) => env.water_density = value,
        _ if given.is(&SPGWATER) => env.water_density = value.map(|s| 1000.0 * s),
        _ if given.is(&DEPTH) => env.depth = value,
        _ if given.is(&TIDE) => env.tide = value,
        _ if given.is(&RAMP) => env.ramp = value,
        _ if given.is(&START) => env.run_start = value.unwrap_or(0.0),
        _ if given.is(&SPREAD_OPTION) => env.spreading = value,
        _ if given.is(&SP_TYPE_OPTION) => {
            let kind = given.choice(const { SP_TYPE_OPTION.choice("TYPE") });
            env.sea_period = kind.map(|kind| FormulaChoice { kind, value: None, span: given.span });
        }
        _ if given.is(&SEA_OPTION) => env.sea = Some(sea(job, given)?),
        _ if given.is(&A_SEA_OPTION) => env.added_sea = Some(sea(job, given)?),
        _ if given.is(&TIME) => {
            const OBSERVED: ValueKey<f64> = TIME.number("TOBSERV");
            const STEP: ValueKey<f64> = TIME.number("DELTA_TIME");
            const TRANSIENT: ValueKey<f64> = TIME.number("TTRA_SET");
            let [observed, step] = given.numbers_or_zero([OBSERVED, STEP]);
            if step > observed {
                return Err(Diagnostic::error("the time step is longer than the time observed", given.position(STEP)));
            }
            if let Some(transient) =
                given.number(TRANSIENT).filter(|transient| observed > 0.0 && *transient >= observed)
            {
                let text = format!(
                    "the transient set aside, {}, leaves nothing of the {} observed",
                    format_value(transient, Dim::Time, job.units),
                    format_value(observed, Dim::Time, job.units)
                );
                return Err(Diagnostic::error(text, given.position(TRANSIENT))
                    .help("TTRA_SET is part of TOBSERV, at its beginning"));
            }
            env.time = Some(TimeWindow {
                observed,
                step,
                transient: given.number(TRANSIENT),
                cycles: given.integer(const { TIME.integer("NCYCLES") }),
            });
        }
        _ if given.is(&CURRENT) => env.current = Some(current(job, given)?),
        _ if given.is(&S_PERIOD) || given.is(&MD_PERIOD) || given.is(&E_PERIOD) => periods(given)?,
        _ if given.is(&probability::PROBABILITY) => probability::check(given)?,
        _ if given.is(&C_HISTORY) => {
            known_curve(job, given.values.first(), given, CurveKind::CurrentHistory)?;
            env.current_history = Some(formula(given, None));
        }
        _ if given.is(&M_GROWTH) => {
            known_curve(job, given.values.first(), given, CurveKind::MarineGrowth)?;
            env.growth = Some(formula(given, Some(const { M_GROWTH.number("RHO") })));
        }
        _ => {}
    }
    ambient_options::apply(job, env, given)?;
    wind_options::apply(job, env, given)?;
    sea_options::apply(job, env, given)
}

/// The curve that the first value names, with its number where the option has one.
pub(crate) fn formula(given: &Given, value: Option<ValueKey<f64>>) -> CurveReference {
    let value = value.and_then(|key| given.number(key));
    CurveReference { kind: given.first_word().unwrap_or_default().to_string(), value, span: given.span }
}

fn sea(job: &Job, given: &Given) -> Outcome<SeaDefinition> {
    const NAME: ValueKey<str> = SEA_OPTION.word("NAME");
    const DIRECTION: ValueKey<f64> = SEA_OPTION.number("DIR");
    const HEIGHT: ValueKey<f64> = SEA_OPTION.number("HS");
    const PERIOD: ValueKey<f64> = SEA_OPTION.number("PERIOD");
    const PARAMETERS: ValueKey<f64> = SEA_OPTION.number("PARAM");
    let name = given.word(NAME).unwrap_or_default();
    spectrum(job, given, spectra::NAMES)?;
    let [direction, height, period] = given.numbers_or_zero([DIRECTION, HEIGHT, PERIOD]);
    let [at_direction, at_height, at_period] = [DIRECTION, HEIGHT, PERIOD].map(|key| given.position(key));
    Ok(SeaDefinition {
        spectrum: name.to_string(),
        direction,
        height,
        period,
        shape: shape(name, (given.values_from(PARAMETERS), given.span), job.units)?,
        positions: [given.position(NAME), at_direction, at_height, at_period],
    })
}

/// The parameters that a record gives a spectrum, SI; `span` is that of the option.
fn shape(name: &str, (given, span): (&[Value], Span), units: UnitSystem) -> Outcome<Vec<Option<f64>>> {
    let declared = spectra::find(name).map(|spectrum| spectrum.parameters).filter(|declared| !declared.is_empty());
    let declared = declared.unwrap_or(std::slice::from_ref(&spectra::GAMMA));
    if let Some(value) = given.get(declared.len()) {
        let names: Vec<&str> = declared.iter().map(|parameter| parameter.name).collect();
        let text = format!("{name} takes no further value after {}", names.join(" "));
        return Err(Diagnostic::error(text, value.span));
    }
    let to_si = |(parameter, value): (&ShapeParameter, &Value)| {
        let Some(number) = value.number() else { return Ok(None) };
        let si = parameter.dim.to_si(number, units);
        let [low, high] = parameter.range;
        if !(low..=high).contains(&si) {
            let bound = |bound: f64| format_value(bound, parameter.dim, units);
            let text = format!("{} of {name} must be between {} and {}", parameter.name, bound(low), bound(high));
            return Err(Diagnostic::error(text, value.span).label(format!("this is {number}")));
        }
        Ok(Some(si))
    };
    let read: Vec<Option<f64>> = declared.iter().zip(given).map(to_si).collect::<Outcome<_>>()?;
    let is_missing = |(index, parameter): &(usize, &ShapeParameter)| {
        parameter.default.is_none() && read.get(*index).copied().flatten().is_none()
    };
    if let Some((_, missing)) = declared.iter().enumerate().find(is_missing) {
        let text = format!("{name} needs {} after its period", missing.name);
        return Err(Diagnostic::error(text, span).help(format!("{}: {}", missing.name, missing.help)));
    }
    Ok(read)
}

/// Sees that the first word names a known spectrum or a curve that is one.
pub(crate) fn spectrum(job: &Job, given: &Given, known: &[&str]) -> Outcome<()> {
    let (name, span) = (given.first_word().unwrap_or_default(), given.first_place());
    if known.iter().any(|s| s.eq_ignore_ascii_case(name)) {
        return Ok(());
    }
    let spectral = |c: &Curve| matches!(c.kind, CurveKind::PeriodSpectrum | CurveKind::FrequencySpectrum);
    let expected = format!("expected {} or a P_SPECTRUM or F_SPECTRUM curve", known.join(", "));
    match job.model.curves.get(&Model::key(name)) {
        Some(curve) if spectral(curve) => Ok(()),
        Some(curve) => {
            let text = format!("curve {name} is a {}, not a spectrum", curve.kind.name());
            Err(Diagnostic::error(text, span).label(expected).other(curve.span, "defined here"))
        }
        None => {
            let curves = job.model.curves.values().filter(|c| spectral(c)).map(|c| c.name.as_str());
            let mut error = Diagnostic::error(format!("unknown spectrum {name}"), span).label(expected);
            error.help.extend(did_you_mean(name, known.iter().copied().chain(curves)));
            Err(error)
        }
    }
}

pub(crate) fn known_curve(job: &Job, named: Option<&Value>, given: &Given, kind: CurveKind) -> Outcome<()> {
    let name = named.and_then(Value::word).unwrap_or_default();
    let position = named.map_or(given.span, |value| value.span);
    let curve = find(&job.model.curves, name, "curve", position)?;
    if curve.kind != kind {
        return Err(Diagnostic::error(
            format!("curve {name} is a {}, not a {}", curve.kind.name(), kind.name()),
            position,
        )
        .other(curve.span, "defined here"));
    }
    Ok(())
}

fn current(job: &Job, given: &Given) -> Outcome<Current> {
    let mut profiles = Vec::new();
    for pair in given.groups() {
        let Some(what) = pair.value(const { CURRENT.word("V") }) else { continue };
        let direction = pair.number(const { CURRENT.number("DIR") }).unwrap_or(0.0);
        let word = what.word().unwrap_or_default();
        if let Ok(velocity) = windlass_language::number::evaluate(word) {
            if given.values.len() > 2 {
                return Err(Diagnostic::error("a uniform current has one velocity and one direction", what.span)
                    .help("form: -CURRENT V DIR, or -CURRENT NAME1 DIR1 NAME2 DIR2 .."));
            }
            if velocity < 0.0 {
                return Err(Diagnostic::error("V of -CURRENT must be zero or more", what.span)
                    .label(format!("this is {velocity}"))
                    .help("a current from the other side has another direction"));
            }
            let velocity = Dim::Velocity.checked_si(velocity, job.units).map_err(|error| {
                Diagnostic::error(format!("V of -CURRENT is too {}", error.size()), what.span).label(error.to_string())
            })?;
            return Ok(Current::Uniform { velocity, direction });
        }
        known_curve(job, Some(what), given, CurveKind::CurrentProfile)?;
        profiles.push((word.to_string(), direction));
    }
    Ok(Current::Profiles(profiles))
}
