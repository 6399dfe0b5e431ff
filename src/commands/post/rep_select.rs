//! `&REP_SELECT`: the fatigue curves reports and lines go by, and the correction for thickness.
//!
//! Source: [MOSES-REF sn_def, sn_bind, fatigue].

use crate::commands::{Call, Command, Effect, Job};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::ValueKey;
use windlass_base::units::Dim;
use windlass_base::values::Given;
use windlass_base::values::Noun;
use windlass_language::name as rule;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{FatigueCurve, FatigueKind, Model, ThicknessCorrection};
use windlass_signal::fatigue::{SnCurve, find};

/// &REP_SELECT.
pub static REP_SELECT: Command = Command { spec: &SPEC, edits: false, run };

const SN: OptionSpec = OptionSpec::new(
    "-SN",
    &[
        ValueSpec::new("CURVE", Kind::Name(Noun::New), "name of a curve"),
        ValueSpec::choice::<FatigueKind>("TYPE", "what S is").or("a curve that is known"),
        ValueSpec::new("S", Kind::Number(Dim::None), "range: stress (ksi or MPa), or tension / break")
            .or("none")
            .positive(),
        ValueSpec::new("N", Kind::Number(Dim::None), "cycles to failure").or("none").positive(),
    ],
    "chooses a curve, and with points defines it",
)
.repeating(2)
.many();
const THICK_SN: OptionSpec = OptionSpec::new(
    "-THICK_SN",
    &[
        ValueSpec::new("TO", Kind::Number(Dim::Section), "reference thickness").positive(),
        ValueSpec::new("POWER", Kind::Number(Dim::None), "exponent").not_negative(),
        ValueSpec::new("MAXCOR", Kind::Number(Dim::None), "largest factor").or("no bound").positive(),
    ],
    "corrects stress ranges for thickness",
);

static SPEC: CommandSpec = CommandSpec {
    options: &[SN, THICK_SN],
    detail: "-SN CURVE chooses a curve of the library (&STATUS SN lists them) or one defined before; -SN CURVE TYPE S1 N1 S2 N2 \
             .. defines one by at least two points, ranges falling while cycles grow, straight in the logarithms between and \
             beyond them. The curves chosen replace those chosen before. A segment of a line goes by its -C_SN, else by the \
             last curve chosen. -THICK_SN TO POWER MAXCOR multiplies the stress ranges of curves of STRESS by MIN((t / TO)**POWER, \
             MAXCOR), t being the wall or, of a solid section, the diameter; as the formula stands, a section thinner than TO gains.",
    example: "&REP_SELECT -SN CHAIN\n&REP_SELECT -SN ROPE TENSION 0.5 1000 0.2 40000 0.1 700000 -THICK_SN 1 0.25 2\n&STATUS SN ROPE",
    ..CommandSpec::new("&REP_SELECT", "chooses fatigue curves")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    if args.options.is_empty() {
        return Err(Diagnostic::error("&REP_SELECT asks for -SN or -THICK_SN", args.span));
    }
    let mut selection = job.model.fatigue.clone();
    let mut chosen = Vec::new();
    for given in args.occurrences(&SN) {
        let name = given.word(const { SN.word("CURVE") }).unwrap_or_default();
        let position = given.first_place();
        if given.values.len() > 1 {
            let made = define_curve(job, given, name)?;
            if selection.curves.insert(Model::key(name), made).is_some() {
                job.remark(format!("fatigue curve {name} is redefined"), position);
            }
        }
        let Some(curve) = find(name, &selection) else {
            return Err(Diagnostic::error(format!("there is no fatigue curve {name}"), position)
                .help("&STATUS SN lists the curves; -SN CURVE TYPE S N S N .. defines one"));
        };
        if curve.unconfirmed {
            job.remark(format!("the numbers of fatigue curve {} are not confirmed: &STATUS SN", curve.name), position);
        }
        chosen.push(curve.name);
    }
    if !chosen.is_empty() {
        selection.chosen = chosen;
    }
    if let Some(given) = args.option(&THICK_SN) {
        let [reference, power, most] =
            const { THICK_SN.numbers(["TO", "POWER", "MAXCOR"]) }.map(|key| given.number(key));
        selection.thickness = Some(ThicknessCorrection {
            reference: reference.unwrap_or(1.0),
            power: power.unwrap_or(0.0),
            most: most.unwrap_or(f64::INFINITY),
        });
    }
    job.model.fatigue = selection;
    Ok(Effect::Done)
}

/// A curve of points.
fn define_curve(job: &Job, given: &Given, name: &str) -> Outcome<FatigueCurve> {
    let span = given.first_place();
    rule::check(name, None, "fatigue curve", span)?;
    let kind = given.choice(const { SN.choice("TYPE") }).unwrap_or(FatigueKind::Tension);
    let dim = if kind == FatigueKind::Stress { Dim::Stress } else { Dim::None };
    let mut points = Vec::new();
    for pair in given.groups() {
        const RANGE: ValueKey<f64> = SN.number("S");
        let Some(cycles) = pair.number(const { SN.number("N") }) else {
            return Err(Diagnostic::error("a range of a fatigue curve lacks its cycles", pair.position(RANGE)));
        };
        points.push((dim.to_si(pair.number(RANGE).unwrap_or_default(), job.units), cycles));
    }
    let curve = FatigueCurve { name: name.to_string(), kind, points, span };
    SnCurve::from_points(&curve).map_err(|e| Diagnostic::error(format!("{name}: {e}"), span))?;
    Ok(curve)
}
