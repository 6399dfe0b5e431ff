//! `&DESCRIBE SENSOR`: what a sensor reads of a run, and when it raises its alarm.
//!
//! Source: [MOSES-REF sensor]. How a signal of three numbers becomes one is known in part: NORM is MOSES's, the letters of single
//! ones are our reading.

use crate::commands::Job;
use crate::commands::name_filter::NameFilter;
use windlass_base::choice::{Choice, YesNo};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::values::{Args, Given, Value};
use windlass_language::name as rule;
use windlass_language::select::choose_word;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_model::{Model, SensorRecord, SensorSignal, SolveKind, UnmodelledEffect, find};

choices! {
    /// Signals of sensors.
    enum SignalWord {
        Time = "TIME",
        Point = "POINT",
        Vector = "VECTOR",
        Length = "C_LENGTH",
        Force = "C_FORCE",
        Watertight = "MIN_WT_DOWN",
        DownFlooding = "MIN_NWT_DOWN",
        Angles = "BODY_ANG",
    }
}

choices! {
    /// What is taken of a signal of three numbers.
    enum ComponentWord {
        Norm = "NORM",
        X = "X",
        Y = "Y",
        Z = "Z",
        Roll = "ROLL",
        Pitch = "PITCH",
        Yaw = "YAW",
    }
}

const CHOSEN: &[ValueSpec] = &[ValueSpec::new(":SEL", Kind::Item, "sensors: a name, a pattern or a selector")];
const ON: OptionSpec = OptionSpec::new("-ON", CHOSEN, "of SENSOR without a name: turns sensors on").repeating(1);
const OFF: OptionSpec =
    OptionSpec::new("-OFF", CHOSEN, "of SENSOR without a name: turns sensors off: they are not reported").repeating(1);
const DELETE: OptionSpec = OptionSpec::new("-DELETE", CHOSEN, "of SENSOR without a name: deletes sensors").repeating(1);
const SIGNAL: OptionSpec = OptionSpec::new(
    "-SIGNAL",
    &[
        ValueSpec::choice::<SignalWord>("TYPE", "what is read"),
        ValueSpec::new(
            "SOURCE",
            Kind::Item,
            "a point of POINT, two of VECTOR, a connector, a body; behind it the desired value (not used), then NORM, or X, Y, Z, ROLL, PITCH or YAW (our reading)",
        )
        .or("none of TIME; NORM"),
    ],
    "of a sensor: its signal",
)
.repeating(1);
const DERIVATIVE: OptionSpec = OptionSpec::new(
    "-DERIVATIVE",
    &[ValueSpec::choice::<YesNo>("YES/NO", "YES or NO")],
    "of a sensor of POINT or VECTOR: reads the rate of the signal",
)
.default("NO");
const LIMITS: OptionSpec = OptionSpec::new(
    "-LIMITS",
    &[
        ValueSpec::new("LOW", Kind::Number(Dim::None), "lower limit, in the user's units of the signal"),
        ValueSpec::new("HIGH", Kind::Number(Dim::None), "upper limit"),
    ],
    "of a sensor: the values outside of which its alarm is set",
);
const CONVOLUTION: OptionSpec = OptionSpec::new(
    "-CONVOLUTION",
    &[ValueSpec::new("CURVE", Kind::Item, "a convolution")],
    "of a sensor: refused, windlass has no convolutions of signals",
);
const ACTION: OptionSpec = OptionSpec::new(
    "-ACTION",
    &[ValueSpec::new("ACTION", Kind::Item, "what is done, and to what")],
    "of a sensor: what its alarm does; stops motions, for windlass does not do it (&ACTION acts on conditions)",
)
.repeating(1)
.stops(SolveKind::Motions, "what the alarm of a sensor does");

/// What a sensor takes.
pub(super) const OWN: [OptionSpec; 8] = [ON, OFF, DELETE, SIGNAL, DERIVATIVE, LIMITS, CONVOLUTION, ACTION];

/// Describes a sensor, or turns sensors on and off or deletes them.
///
/// # Errors
/// A name that cannot be one, an unknown source, an option that does not belong to a sensor or to its signal.
pub(super) fn describe(job: &mut Job, args: &Args, name: Option<(&str, Span)>, surplus: &[Value]) -> Outcome<()> {
    if let Some(given) = args.options.iter().find(|given| !given.is_any(&OWN)) {
        return Err(Diagnostic::error(format!("{} does not belong to SENSOR", given.name()), given.span));
    }
    if let Some(value) = surplus.first() {
        return Err(Diagnostic::error("SENSOR takes one name", value.span)
            .help("form: &DESCRIBE SENSOR NAME -SIGNAL TYPE SOURCE -LIMITS LOW HIGH"));
    }
    let Some((name, span)) = name else { return switch(job, args) };
    if let Some(given) = args.options.iter().find(|given| given.is_any(&[ON, OFF, DELETE])) {
        return Err(Diagnostic::error(format!("{} goes without the name of a sensor", given.name()), given.span));
    }
    rule::check(name, None, "sensor", span)?;
    if let Some(given) = args.option(&CONVOLUTION) {
        return Err(Diagnostic::error("windlass has no convolutions of signals: -CONVOLUTION of a sensor", given.span)
            .help("without it the sensor reads the signal as it is"));
    }
    let Some(given) = args.option(&SIGNAL) else {
        return Err(Diagnostic::error(format!("sensor {name} lacks -SIGNAL"), span)
            .help("form: &DESCRIBE SENSOR NAME -SIGNAL TYPE SOURCE"));
    };
    let (signal, sources, component) = read_signal(&job.model, given)?;
    let is_rate = args.switch(&DERIVATIVE, false);
    let is_place = matches!(signal, SensorSignal::Point | SensorSignal::Vector);
    if let Some(given) = args.option(&DERIVATIVE).filter(|_| is_rate && !is_place) {
        return Err(Diagnostic::error(
            "-DERIVATIVE goes with POINT and VECTOR, whose velocities a run keeps",
            given.span,
        ));
    }
    let dim = match signal {
        SensorSignal::Time => Dim::Time,
        SensorSignal::Force => Dim::Force,
        SensorSignal::Angles => Dim::Angle,
        _ if is_rate => Dim::Velocity,
        _ => Dim::Length,
    };
    let limits = match args.option(&LIMITS) {
        None => None,
        Some(given) => {
            let limits = given.numbers_or_zero(const { LIMITS.numbers(["LOW", "HIGH"]) });
            if limits[0] > limits[1] {
                return Err(Diagnostic::error("the lower limit is above the upper one", given.span));
            }
            Some(limits.map(|v| dim.to_si(v, job.units)))
        }
    };
    let made = SensorRecord { name: name.to_string(), signal, sources, component, is_rate, limits, is_on: true, span };
    if let Some(given) = args.option(&ACTION) {
        let (record, effect) = (format!("-ACTION of sensor {name}"), "what the alarm of a sensor does".to_string());
        let effect = UnmodelledEffect { record, effect, matters_to: SolveKind::Motions, span: given.span };
        job.model.keep_unmodelled(effect);
    }
    job.model.sensors.insert(Model::key(name), made);
    job.note_name(name, span);
    Ok(())
}

/// The signal of -SIGNAL: its sort, its sources, and which of three numbers is taken.
fn read_signal(model: &Model, given: &Given) -> Outcome<(SensorSignal, Vec<String>, Option<usize>)> {
    let word = given.choice(const { SIGNAL.choice("TYPE") }).unwrap_or(SignalWord::Time);
    let mut rest = given.values.iter().skip(1).filter(|value| value.is_given()).peekable();
    let count = match word {
        SignalWord::Time => 0,
        SignalWord::Vector => 2,
        _ => 1,
    };
    let mut sources = Vec::new();
    for _ in 0..count {
        let Some((name, span)) = rest.next().and_then(|value| Some((value.word()?, value.span))) else {
            let what = match word {
                SignalWord::Point => "a point",
                SignalWord::Vector => "two points",
                SignalWord::Length | SignalWord::Force => "a connector",
                _ => "a body",
            };
            return Err(Diagnostic::error(format!("{} of -SIGNAL takes {what}", word.word()), given.span));
        };
        sources.push(match word {
            SignalWord::Point | SignalWord::Vector => find(&model.points, name, "point", span)?.name.clone(),
            SignalWord::Length | SignalWord::Force => find(&model.connectors, name, "connector", span)?.name.clone(),
            _ => find(&model.bodies, name, "body", span)?.name.clone(),
        });
    }
    let is_number = |value: &&Value| value.word().is_some_and(|word| word.parse::<f64>().is_ok());
    while rest.peek().is_some_and(is_number) {
        rest.next();
    }
    let is_three = matches!(word, SignalWord::Point | SignalWord::Vector | SignalWord::Force | SignalWord::Angles);
    let component = match rest.next().filter(|_| is_three) {
        None => None,
        Some(value) => {
            let chosen: ComponentWord =
                choose_word(value.word().unwrap_or_default(), value.span, "component of a signal")?;
            let (of_angles, which) = match chosen {
                ComponentWord::Norm => (None, None),
                ComponentWord::X => (Some(false), Some(0)),
                ComponentWord::Y => (Some(false), Some(1)),
                ComponentWord::Z => (Some(false), Some(2)),
                ComponentWord::Roll => (Some(true), Some(0)),
                ComponentWord::Pitch => (Some(true), Some(1)),
                ComponentWord::Yaw => (Some(true), Some(2)),
            };
            if of_angles.is_some_and(|angles| angles != (word == SignalWord::Angles)) {
                return Err(Diagnostic::error(format!("{} has no {}", word.word(), chosen.word()), value.span)
                    .help("BODY_ANG takes ROLL, PITCH or YAW, the others X, Y or Z"));
            }
            which
        }
    };
    if let Some(value) = rest.next() {
        return Err(Diagnostic::error("windlass reads no more of a signal than its component", value.span)
            .help("components are along the global axes"));
    }
    let signal = match word {
        SignalWord::Time => SensorSignal::Time,
        SignalWord::Point => SensorSignal::Point,
        SignalWord::Vector => SensorSignal::Vector,
        SignalWord::Length => SensorSignal::Length,
        SignalWord::Force => SensorSignal::Force,
        SignalWord::Watertight => SensorSignal::WatertightHeight,
        SignalWord::DownFlooding => SensorSignal::DownFloodingHeight,
        SignalWord::Angles => SensorSignal::Angles,
    };
    Ok((signal, sources, component))
}

/// Turns sensors on or off, or deletes them.
fn switch(job: &mut Job, args: &Args) -> Outcome<()> {
    let [given] = args.options.as_slice() else {
        return Err(Diagnostic::error("&DESCRIBE SENSOR lacks its value NAME", args.span)
            .help("without one it takes -ON, -OFF or -DELETE"));
    };
    if !given.is_any(&[ON, OFF, DELETE]) {
        return Err(Diagnostic::error("&DESCRIBE SENSOR lacks its value NAME", args.span));
    }
    let chosen = NameFilter::new(&given.values, &job.model);
    let names: Vec<String> = job.model.sensors.keys().filter(|key| chosen.matches(key)).cloned().collect();
    chosen.check_used("the sensors", &[])?;
    for key in names {
        if given.is(&DELETE) {
            job.model.sensors.shift_remove(&key);
        } else if let Some(sensor) = job.model.sensors.get_mut(&key) {
            sensor.is_on = given.is(&ON);
        }
    }
    Ok(())
}
