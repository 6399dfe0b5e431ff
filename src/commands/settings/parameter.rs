//! `&PARAMETER`: what holds for all computations.

use crate::commands::model_values::option_as_written;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::choice::YesNo;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::units::Dim;
use windlass_connectors::has_rope_stiffness;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionEffect, OptionSpec, ValueSpec};
use windlass_model::{RopeStiffness, SolveKind, UnmodelledEffect};

/// &PARAMETER.
pub static PARAMETER: Command = Command { spec: &SPEC, edits: false, run };

const ACCEPT_MISSING: OptionSpec = OptionSpec::new(
    "-ACCEPT_MISSING",
    &[ValueSpec::choice::<YesNo>("YES/NO", "YES goes on")],
    "whether solves go on without effects that are not computed, and motions without added mass; reports then say so",
)
.owner(Owner::Ours)
.default("NO: they are refused");

const STIFFNESS: OptionSpec = OptionSpec::ours(
    "-STIFFNESS",
    &[ValueSpec::choice::<RopeStiffness>("WHICH", "LOWER and UPPER of -EA_BOUNDS, DYNAMIC of -ROPE")],
    "the axial stiffness of fibre ropes, of classes defined from then on",
)
.default("that of -ROPE, else LOWER");
const SAVE: OptionSpec = OptionSpec::new("-SAVE", &[], "keeps the present parameters for -REMEMBER");
const REMEMBER: OptionSpec = OptionSpec::new("-REMEMBER", &[], "goes back to the parameters saved last");
const fn factor(name: &'static str, value: &'static [ValueSpec], help: &'static str) -> OptionSpec {
    OptionSpec::new(name, value, help)
}
const fn number(name: &'static str, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(Dim::None), help).not_negative()
}
const DRGTUB: OptionSpec = factor(
    "-DRGTUB",
    &[number("RE", "Reynolds number"), number("CD", "drag coefficient there")],
    "drag coefficients of tubes by Reynolds number; one coefficient for all is what TUBE takes where its record has no -CD",
)
.repeating(2);
const AMCTUB: OptionSpec =
    factor("-AMCTUB", &[number("CA", "added mass coefficient")], "added mass of tubes whose record has no -CA")
        .default("1");
const WCSTUBE: OptionSpec = factor(
    "-WCSTUBE",
    &[number("CS", "shape coefficient")],
    "shape coefficient in wind of tubes whose record has no -CS_WIND",
)
.default("1");
const DRGPLA: OptionSpec =
    factor("-DRGPLA", &[number("CD", "drag coefficient")], "drag of #PLATE whose record has no -CD").default("1");
const F_CD_TUBE: OptionSpec =
    factor("-F_CD_TUBE", &[number("CD", "drag coefficient")], "drag of tubes in the frequency domain")
        .stops(SolveKind::Motions, "another drag of tubes in the frequency domain");
const FM_ROD: OptionSpec =
    factor("-FM_ROD", &[number("F", "factor")], "factor of forces on rods: stops the next solve of motions, but for 1");
const AF_ENVIRONMENT: OptionSpec = factor(
    "-AF_ENVIRONMENT",
    &[ValueSpec::choice::<YesNo>(
        "YES/NO",
        "YES: force along the flow on the area seen from there; NO: along the normal",
    )],
    "how areas are loaded; #AREA, #PLATE and pieces have laws of their own",
)
.stops(SolveKind::Statics, "the direction of forces on areas");
const REL_WIND: OptionSpec = factor(
    "-REL_WIND",
    &[ValueSpec::choice::<YesNo>("YES/NO", "NO stops the next solve of motions")],
    "wind relative to what moves",
)
.default("YES");
const M_DISTANCE: OptionSpec =
    factor("-M_DISTANCE", &[number("D", "length")], "meshes of a diffraction that is not made").without_effect();
const M_WLFRACTION: OptionSpec =
    factor("-M_WLFRACTION", &[number("F", "fraction")], "meshes of a diffraction that is not made").without_effect();
const MAXREFINE: OptionSpec =
    factor("-MAXREFINE", &[number("N", "number")], "meshes of a diffraction that is not made").without_effect();

static SPEC: CommandSpec = CommandSpec {
    options: &[
        SAVE,
        REMEMBER,
        DRGTUB,
        AMCTUB,
        WCSTUBE,
        DRGPLA,
        F_CD_TUBE,
        FM_ROD,
        AF_ENVIRONMENT,
        REL_WIND,
        M_DISTANCE,
        M_WLFRACTION,
        MAXREFINE,
        ACCEPT_MISSING,
        STIFFNESS,
    ],
    detail: "-DRGTUB with several coefficients stops the next solve: drag by Reynolds number is not computed. Coefficients hold for tubes and \
             plates defined after. &STATUS PARAMETER lists what holds. Some records are read whose effect no solver computes (a factor of drift damping, say). Each is named when it is read, and stops the \
             next solve that it matters to, with one error that names the record and the effect. -ACCEPT_MISSING YES goes on, and every \
             report has a line that names them. A hull of -DIFTYPE FK has the pressure of the waves as they are without it; its added mass and radiation come from #AMASS, #DAMP or \
             DATABASE. -STIFFNESS chooses what a rope with -EA_BOUNDS or -ROPE is pulled by; it stands before its classes. Without added mass natural periods are those of dry mass, so that &STATUS MODES, FREQ_RESPONSE and TDOM refuse such a body.",
    example: "&PARAMETER -SAVE -AMCTUB 0.8 -DRGTUB 1E5 0.7\n&STATUS PARAMETER\n&PARAMETER -REMEMBER -ACCEPT_MISSING YES",
    ..CommandSpec::new("&PARAMETER", "sets what holds for all computations")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let mut made = job.model.parameters;
    let mut saved = job.model.saved_parameters.clone();
    let mut stiffness = job.model.defaults.rope_stiffness;
    let (mut unmodelled, mut remarks) = (Vec::new(), Vec::new());
    for given in &call.args.options {
        let value = given.values.first().and_then(|v| v.number());
        let mut lacks = |effect: &str, matters_to: SolveKind| {
            let record = format!("&PARAMETER {}", option_as_written(given, job.units));
            unmodelled.push(UnmodelledEffect { record, effect: effect.into(), matters_to, span: given.span });
        };
        match given {
            _ if given.is(&SAVE) => saved.push(made),
            _ if given.is(&REMEMBER) => {
                made = saved.pop().ok_or_else(|| {
                    Diagnostic::error("no parameters have been saved", given.span).help("&PARAMETER -SAVE saves them")
                })?;
            }
            _ if given.is(&STIFFNESS) => stiffness = given.choice(const { STIFFNESS.choice("WHICH") }).or(stiffness),
            _ if given.is(&ACCEPT_MISSING) => made.accept_missing = given.is_on(),
            _ if given.is(&AMCTUB) => made.tube_added_mass = value,
            _ if given.is(&WCSTUBE) => made.tube_wind = value,
            _ if given.is(&DRGPLA) => made.plate_drag = value,
            _ if given.is(&DRGTUB) => {
                let mut drags = given.groups().filter_map(|pair| pair.number(const { DRGTUB.number("CD") }));
                let first = drags.next();
                if drags.any(|drag| Some(drag) != first) {
                    lacks("drag of tubes by Reynolds number", SolveKind::Statics);
                }
                made.tube_drag = first;
            }
            _ if given.is(&FM_ROD) && value != Some(1.0) => lacks("a factor of forces on rods", SolveKind::Motions),
            _ if given.is(&FM_ROD) => {}
            _ if given.is(&REL_WIND) && !given.is_on() => lacks("wind that does not see motions", SolveKind::Motions),
            _ if given.is(&REL_WIND) => {}
            _ => match given.option.effect {
                OptionEffect::Stops(kind, effect) => lacks(effect, kind),
                OptionEffect::Acts | OptionEffect::Noted => remarks
                    .push((format!("{} has no effect: windlass makes no diffraction mesh", given.name()), given.span)),
            },
        }
    }
    if stiffness != job.model.defaults.rope_stiffness
        && let Some(class) = job.model.classes.values().find(|class| class.records.iter().any(has_rope_stiffness))
    {
        let span = call.args.option(&STIFFNESS).map_or(call.args.span, |given| given.span);
        let text =
            format!("class {} has a stiffness already: -STIFFNESS stands before the classes of ropes", class.name);
        return Err(Diagnostic::error(text, span).other(class.span, "defined here"));
    }
    job.model.defaults.rope_stiffness = stiffness;
    (job.model.parameters, job.model.saved_parameters) = (made, saved);
    for effect in unmodelled {
        job.warn(format!("not computed: {}; solves it matters to will stop", effect.sentence()), effect.span);
        job.model.keep_unmodelled(effect);
    }
    remarks.into_iter().for_each(|(text, span)| job.remark(text, span));
    Ok(Effect::Done)
}
