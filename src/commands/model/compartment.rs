//! `&DESCRIBE COMPARTMENT` and `HOLE`, `&COMPARTMENT`, `&CMP_BAL`: spaces of bodies and what is in them.
//!
//! Source: [MOSES-REF cmp, cmp_fill]; `&COMPARTMENT -PERCENT @ 0 4P 100 1.0255` as in [MOSES-RUNS hystat/pcomp]. The other forms are from
//! memory of MOSES and marked in the help.

use crate::commands::model::piece;
use crate::commands::name_filter::NameFilter;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::pose::{Pose, Six};
use windlass_base::span::Span;
use windlass_base::units::{Dim, eight_figures};
use windlass_base::values::{Args, Given, Noun, Value};
use windlass_hydro::{Category, Floating, Tank, balance_tanks};
use windlass_language::name as rule;
use windlass_language::number::evaluate;
use windlass_language::select::choose_word;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{
    Compartment, EntityKind, FreeSurface, GROUND, Hole, HoleKind, Model, SolveKind, TankContents, find,
};

/// &COMPARTMENT.
pub static COMPARTMENT: Command = Command { spec: &SPEC, edits: true, run };
/// &CMP_BAL.
pub static CMP_BAL: Command = Command { spec: &BALANCE_SPEC, edits: true, run: balance };

/// Density of fresh water (kg/m3), which specific gravities are of.
const FRESH_WATER: f64 = 1000.0;

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

/// `-DESCRIPTION`.
const DESCRIPTION: OptionSpec = OptionSpec::new(
    "-DESCRIPTION",
    &[ValueSpec::new("TEXT", Kind::Text, "text in quotes")],
    "of a compartment: what it is",
);
const S_TUBE: OptionSpec = OptionSpec::new(
    "-S_TUBE",
    &[
        ValueSpec::new("*TOP", Kind::Name(Noun::Point), "its upper end"),
        ValueSpec::new("*BOTTOM", Kind::Name(Noun::Point), "its lower end"),
    ],
    "of a compartment: its sounding tube",
)
.default("on the body's vertical through the centroid of the full tank");
const MINIMUM: OptionSpec = OptionSpec::new(
    "-MINIMUM",
    &[
        number("PERC", Dim::None, "percent of its volume").in_range(0.0, 100.0),
        number("SPGR", Dim::None, "specific gravity").or("as the contents").positive(),
    ],
    "of a compartment: what cannot be pumped out; it has no free surface",
);
const MAXIMUM: OptionSpec = OptionSpec::new(
    "-MAXIMUM",
    &[number("PERC", Dim::None, "percent of its volume").in_range(0.0, 100.0)],
    "of a compartment: what it is filled to at most (our reading)",
)
.default("100");
const HOLES: OptionSpec =
    OptionSpec::new("-HOLES", &[ValueSpec::new("HOLE", Kind::Text, "a hole")], "of a compartment: its holes")
        .repeating(1);
const HOLE_POINT: OptionSpec = OptionSpec::new(
    "-POINT",
    &[ValueSpec::new("*PT", Kind::Name(Noun::Point), "a point of the body")],
    "of a hole: where it is",
);
const HOLE_AREA: OptionSpec =
    OptionSpec::new("-AREA", &[number("A", Dim::Area, "area").not_negative()], "of a hole: its area, listed alone");
const HOLE_FRICTION: OptionSpec = OptionSpec::new(
    "-FRICTION",
    &[number("F", Dim::None, "factor").not_negative()],
    "of a hole: its friction factor, listed alone",
);
const HOLE_NORMAL: OptionSpec = OptionSpec::new(
    "-NORMAL",
    &[
        number("NX", Dim::None, "X of its normal"),
        number("NY", Dim::None, "Y").or("0"),
        number("NZ", Dim::None, "Z").or("0"),
    ],
    "of a hole: the way it looks, which matters to a flow in time alone",
)
.without_effect();

/// What a compartment and a hole take.
pub(super) const OWN: [OptionSpec; 9] =
    [DESCRIPTION, S_TUBE, MINIMUM, MAXIMUM, HOLES, HOLE_POINT, HOLE_AREA, HOLE_FRICTION, HOLE_NORMAL];
/// What of it a hole takes.
pub(super) const OF_HOLE: [OptionSpec; 4] = [HOLE_POINT, HOLE_AREA, HOLE_FRICTION, HOLE_NORMAL];

choices! {
    /// Sorts of holes.
    enum HoleWord {
        FloodValve = "F_VALVE",
        WatertightVent = "WT_VENT",
        MastVent = "M_VENT",
        Vent = "VENT",
        VentValve = "V_VALVE",
    }
}

/// Begins a compartment: pieces that follow belong to it.
///
/// # Errors
/// A name that is taken, an unknown point or hole, no part.
pub(super) fn describe(job: &mut Job, args: &Args, name: &str, span: Span) -> Outcome<()> {
    let part = piece::current_part(&job.model, span)?.name.clone();
    if Model::key(&part) == GROUND {
        return Err(Diagnostic::error("a compartment belongs to a body, and none is described yet", span)
            .help("&DESCRIBE BODY describes one"));
    }
    let key = Model::key(name);
    if let Some(exterior) = job.model.parts.get(&key).map(|p| p.name.clone()) {
        piece::finish_piece(job);
        job.model.current_part = Some(exterior);
        job.model.current_compartment = None;
        return Ok(());
    }
    rule::check(name, None, "compartment", span)?;
    job.model.free_name(name, &[EntityKind::Compartment], span)?;
    let point = |key: &'static str, value: Option<&Value>| -> Outcome<Option<String>> {
        let Some((word, at)) = value.and_then(|v| Some((v.word()?, v.span))) else { return Ok(None) };
        let point = find(&job.model.points, word, "point", at)?;
        let own = job.model.body_of(point).map(|b| Model::key(&b.name));
        let body = job.model.parts.get(&Model::key(&part)).map(|p| Model::key(&p.body));
        if own != body {
            return Err(Diagnostic::error(format!("{key} of -S_TUBE is no point of the body of {part}"), at)
                .other(point.span, "defined here"));
        }
        Ok(Some(point.name.clone()))
    };
    let tube = match args.option(&S_TUBE).map(|given| given.values.as_slice()) {
        Some([top, bottom, ..]) => point("*TOP", Some(top))?.zip(point("*BOTTOM", Some(bottom))?).map(|(t, b)| [t, b]),
        _ => None,
    };
    let mut holes = Vec::new();
    for value in args.option(&HOLES).map(|given| given.values.as_slice()).unwrap_or_default() {
        let found = find(&job.model.holes, value.word().unwrap_or_default(), "hole", value.span)?;
        holes.push(found.name.clone());
    }
    let density = job.model.surroundings().water_density;
    let old = job.model.compartments.get(&key).cloned();
    let empty = TankContents { fraction: 0.0, density, surface: FreeSurface::Level, is_flooded: false };
    let mut made = old.unwrap_or_else(|| Compartment {
        name: name.to_string(),
        part: part.clone(),
        description: String::new(),
        sounding_tube: None,
        residual: 0.0,
        maximum: 1.0,
        holes: Vec::new(),
        contents: empty,
        span,
    });
    made.sounding_tube = tube.or(made.sounding_tube);
    if args.has(&HOLES) {
        made.holes = holes;
    }
    if let Some(text) = args.option_word(&DESCRIPTION) {
        made.description = text.to_string();
    }
    if let Some(given) = args.option(&MINIMUM) {
        made.residual = 0.01 * given.number(const { MINIMUM.number("PERC") }).unwrap_or(0.0);
        made.contents.fraction = made.contents.fraction.max(made.residual);
        if let Some(gravity) = given.number(const { MINIMUM.number("SPGR") }) {
            made.contents.density = FRESH_WATER * gravity;
        }
    }
    if let Some(given) = args.option(&MAXIMUM) {
        made.maximum = 0.01 * given.first_number().unwrap_or(100.0);
    }
    if made.maximum < made.residual || made.contents.fraction > made.maximum {
        let at = args.option(&MAXIMUM).map_or(span, |given| given.span);
        let text = format!("-MAXIMUM of compartment {name} is less than what is in it, or than its -MINIMUM");
        return Err(Diagnostic::error(text, at));
    }
    piece::finish_piece(job);
    let model = &mut job.model;
    model.current_part = Some(made.part.clone());
    model.current_compartment = Some(made.name.clone());
    model.compartments.insert(key, made);
    job.note_name(name, span);
    Ok(())
}

/// Describes a hole.
///
/// # Errors
/// No sort or an unknown one, an unknown point.
pub(super) fn describe_hole(job: &mut Job, args: &Args, name: &str, span: Span, kind: &[Value]) -> Outcome<()> {
    rule::check(name, None, "hole", span)?;
    let [kind] = kind else {
        return Err(Diagnostic::error("HOLE takes one sort", span)
            .help("form: &DESCRIBE HOLE NAME F_VALVE|WT_VENT|M_VENT|VENT|V_VALVE -POINT *PT"));
    };
    let word: HoleWord = choose_word(kind.word().unwrap_or_default(), kind.span, "sort of hole")?;
    let point = match args.option(&HOLE_POINT).and_then(|given| given.values.first()) {
        Some(value) => {
            let point = find(&job.model.points, value.word().unwrap_or_default(), "point", value.span)?;
            if job.model.body_of(point).is_none() {
                return Err(Diagnostic::error(format!("{} is on no body", point.name), value.span));
            }
            Some(point.name.clone())
        }
        None => None,
    };
    let kind = match word {
        HoleWord::FloodValve => HoleKind::FloodValve,
        HoleWord::WatertightVent => HoleKind::WatertightVent,
        HoleWord::MastVent => HoleKind::MastVent,
        HoleWord::Vent => HoleKind::Vent,
        HoleWord::VentValve => HoleKind::VentValve,
    };
    let (area, friction) = (args.option_number(&HOLE_AREA), args.option_number(&HOLE_FRICTION));
    let made = Hole { name: name.to_string(), kind, point, area, friction, span };
    job.model.holes.insert(Model::key(name), made);
    Ok(())
}

/// The word of a sort of hole.
pub fn hole_word(kind: HoleKind) -> &'static str {
    match kind {
        HoleKind::FloodValve => "F_VALVE",
        HoleKind::WatertightVent => "WT_VENT",
        HoleKind::MastVent => "M_VENT",
        HoleKind::Vent => "VENT",
        HoleKind::VentValve => "V_VALVE",
    }
}

const CHOSEN: &[ValueSpec] = &[ValueSpec::new(":SEL", Kind::Item, "compartments: a name, a pattern or a selector")];
const FOLLOWING: &[ValueSpec] = &[ValueSpec::new(":SEL", Kind::Item, "compartments: a name, a pattern or a selector")
    .or("those of the options that follow")];
const AMOUNTS: &[ValueSpec] =
    &[ValueSpec::new(":SEL", Kind::Item, "compartments, a value and, where it changes, the specific gravity; in turn")];

const FLOOD: OptionSpec =
    OptionSpec::new("-FLOOD", CHOSEN, "opens compartments to the sea: they are filled up to the waterline")
        .repeating(1)
        .many();
const NO_FLOOD: OptionSpec =
    OptionSpec::new("-NO_FLOOD", CHOSEN, "closes them: they have the contents again that they had before")
        .repeating(1)
        .many();
const CORRECT: OptionSpec =
    OptionSpec::new("-CORRECT", FOLLOWING, "the surface of the liquid stays level and its volume stays")
        .repeating(1)
        .many();
const APP_NONE: OptionSpec =
    OptionSpec::new("-APP_NONE", FOLLOWING, "the liquid turns with the body as it lies upright: no free surface")
        .repeating(1)
        .many();
const FULL: OptionSpec = OptionSpec::new("-FULL", CHOSEN, "fills compartments, to their -MAXIMUM").repeating(1).many();
const MOST: OptionSpec = OptionSpec::new(
    "-MAXIMUM",
    &[ValueSpec::new(":SEL", Kind::Item, "compartments and the percent they are filled to at most; in turn")],
    "what compartments are filled to at most, as -MAXIMUM of &DESCRIBE COMPARTMENT (our reading)",
)
.repeating(1)
.many();
const PERCENT: OptionSpec =
    OptionSpec::new("-PERCENT", AMOUNTS, "contents as percent of the volume").repeating(1).many();
const FRACTION: OptionSpec =
    OptionSpec::new("-FRACTION", AMOUNTS, "contents as a share of the volume").repeating(1).many();
const AMOUNT: OptionSpec = OptionSpec::new("-AMOUNT", AMOUNTS, "contents by weight").repeating(1).many();
const SOUNDING: OptionSpec =
    OptionSpec::new("-SOUNDING", AMOUNTS, "contents by the length of the sounding tube that is wet")
        .repeating(1)
        .many();
const ULLAGE: OptionSpec =
    OptionSpec::new("-ULLAGE", AMOUNTS, "contents by the length of the sounding tube that is dry").repeating(1).many();

static SPEC: CommandSpec = CommandSpec {
    options: &[FLOOD, NO_FLOOD, CORRECT, APP_NONE, FULL, MOST, PERCENT, FRACTION, AMOUNT, SOUNDING, ULLAGE],
    absent: &[
        (
            "-DYNAMIC",
            "flow through holes in time is not computed; -FLOOD fills up to the waterline, -PERCENT keeps the contents",
        ),
        ("-OPEN_VALVE", "the pressure of trapped air is not computed; -FLOOD fills up to the waterline"),
        (
            "-DOWN_FLOOD",
            "holes do not let water in; &STATUS V_HOLES reports their heights, -FLOOD fills up to the waterline",
        ),
        ("-APPROXIMATE", "the surface is taken exactly: -CORRECT"),
        ("-APP_WORST", "the surface is taken exactly: -CORRECT"),
        ("-INT_PRE", "the pressure of trapped air is not computed"),
    ],
    detail: "Options act in the order given; of several that name a compartment the last counts. Amounts: a selector, a value and, where it \
             changes, the specific gravity of the liquid to fresh water of 1000 kg/m3, repeated: -PERCENT @ 0 4P 100 1.0255. Without any the density is \
             that of the sea when the compartment was described. -SOUNDING and -ULLAGE are read in the attitude the body has. The default is -CORRECT: \
             level and centre are exact in any attitude. Contents are constant; in TDOM their surface is level at every instant (quasi-static), their \
             inertia that of where they lie when the run begins, and nothing sloshes. What lies below -MINIMUM of a compartment stays in it. The flags \
             -CORRECT and -APP_NONE stand alone before the options they rule, or name compartments themselves. Our reading: -FULL sets 100 %, or the -MAXIMUM, which no amount \
             and no &CMP_BAL exceeds; the sea of -FLOOD does.",
    example: "&DESCRIBE BODY TBRG\nMEDIT\nPGEN\nPLANE 0 400 -RECT 0 20 100\nEND\n&DESCRIBE COMPARTMENT 1P -DESCRIPTION 'wing tank'\nPGEN -PERM -0.98 -STBD\n\
              PLANE 10 60 -CART 20 1 49 1 49 19 20 19\nEND\nEND\n&WEIGHT -TOTAL TBRG 20000 200 0 12 38 118 120\n&INSTATE -CONDITION 9\n\
              &COMPARTMENT -CORRECT -PERCENT @ 0 1P 50 1.0255\n&STATUS COMPARTMENT",
    ..CommandSpec::new("&COMPARTMENT", "sets what is in compartments")
};

/// The compartments a word chooses.
fn choose_compartments(model: &Model, value: &Value) -> Outcome<Vec<String>> {
    let filter = NameFilter::new([value], model);
    let keys = model.compartments.iter().filter(|(_, c)| filter.matches(&c.name)).map(|(key, _)| key.clone()).collect();
    filter.check_used("the compartments", &[EntityKind::Compartment])?;
    Ok(keys)
}

/// The compartments that the words of a flag choose.
fn all_chosen(model: &Model, given: &Given) -> Outcome<Vec<String>> {
    let words = given.values.iter().filter(|v| v.word().is_some());
    Ok(words
        .map(|value| choose_compartments(model, value))
        .collect::<Outcome<Vec<_>>>()?
        .into_iter()
        .flatten()
        .collect())
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    piece::finish_piece(job);
    if call.args.options.is_empty() {
        return Err(Diagnostic::error("&COMPARTMENT lacks what to do", call.args.span)
            .help("&COMPARTMENT -PERCENT :SEL PERC [SPGR] fills compartments; &HELP &COMPARTMENT"));
    }
    let mut surface = None;
    for given in &call.args.options {
        match given {
            _ if given.is_any(&[FLOOD, NO_FLOOD]) => {
                for key in all_chosen(&job.model, given)? {
                    if let Some(tank) = job.model.compartments.get_mut(&key) {
                        tank.contents.is_flooded = given.is(&FLOOD);
                    }
                }
            }
            _ if given.is_any(&[CORRECT, APP_NONE]) => {
                let kind = if given.is(&CORRECT) { FreeSurface::Level } else { FreeSurface::Frozen };
                let keys = all_chosen(&job.model, given)?;
                if keys.is_empty() {
                    surface = Some(kind);
                }
                for key in keys {
                    if let Some(tank) = job.model.compartments.get_mut(&key) {
                        tank.contents.surface = kind;
                    }
                }
            }
            _ if given.is(&FULL) => {
                for key in all_chosen(&job.model, given)? {
                    let fraction = job.model.compartments.get(&key).map_or(1.0, |tank| tank.maximum);
                    fill(job, &key, Amount { fraction, density: None, surface, span: given.span })?;
                }
            }
            _ if given.is(&MOST) => set_maxima(job, given)?,
            _ => set_amounts(job, given, surface)?,
        }
    }
    Ok(Effect::Done)
}

/// What a compartment is filled with.
struct Amount {
    fraction: f64,
    density: Option<f64>,
    surface: Option<FreeSurface>,
    span: Span,
}

fn fill(job: &mut Job, key: &str, amount: Amount) -> Outcome<()> {
    let Some(tank) = job.model.compartments.get_mut(key) else { return Ok(()) };
    let name = tank.name.clone();
    if !(-1e-9..=1.0 + 1e-9).contains(&amount.fraction) {
        let percent = eight_figures(100.0 * amount.fraction);
        return Err(Diagnostic::error(
            format!("compartment {name} cannot hold {percent} % of its volume"),
            amount.span,
        )
        .help("0 to 100 %"));
    }
    let asked = amount.fraction.clamp(0.0, 1.0);
    if asked > tank.maximum * (1.0 + 1e-9) {
        let [percent, most] = [asked, tank.maximum].map(|share| eight_figures(100.0 * share));
        return Err(Diagnostic::error(
            format!("{percent} % of compartment {name} is more than its -MAXIMUM of {most} %"),
            amount.span,
        )
        .help("&COMPARTMENT -MAXIMUM :SEL PERC sets another"));
    }
    tank.contents = TankContents {
        fraction: asked.max(tank.residual),
        density: amount.density.unwrap_or(tank.contents.density),
        surface: amount.surface.unwrap_or(tank.contents.surface),
        is_flooded: false,
    };
    if asked < tank.residual {
        let percent = eight_figures(100.0 * tank.residual);
        job.remark(format!("{percent} % stays in compartment {name}: its -MINIMUM"), amount.span);
    }
    Ok(())
}

/// Pairs of a selector and the percent that its compartments are filled to at most.
fn set_maxima(job: &mut Job, given: &Given) -> Outcome<()> {
    for pair in given.values.chunks(2) {
        let [name, value] = pair else {
            let lacking = pair.first().map_or(given.span, |v| v.span);
            return Err(Diagnostic::error("-MAXIMUM takes compartments and a percent, in turn", lacking));
        };
        let percent = value.word().and_then(|word| evaluate(word).ok()).filter(|p| (0.0..=100.0).contains(p));
        let Some(most) = percent.map(|p| 0.01 * p) else {
            return Err(Diagnostic::error("-MAXIMUM must be a percent from 0 to 100", value.span));
        };
        for key in choose_compartments(&job.model, name)? {
            let Some(tank) = job.model.compartments.get_mut(&key) else { continue };
            if most < tank.residual || tank.contents.fraction > most * (1.0 + 1e-9) {
                let text = format!("compartment {} holds more than this, or its -MINIMUM is more", tank.name);
                return Err(Diagnostic::error(text, value.span));
            }
            tank.maximum = most;
        }
    }
    Ok(())
}

/// Groups of a selector, a value and a specific gravity.
fn set_amounts(job: &mut Job, given: &Given, surface: Option<FreeSurface>) -> Outcome<()> {
    let mut rest = given.values.iter().filter(|v| v.word().is_some()).peekable();
    while let Some(name) = rest.next() {
        let keys = choose_compartments(&job.model, name)?;
        let Some(value) = rest.next() else {
            return Err(Diagnostic::error(
                format!("{} of {} lacks its value", name.word().unwrap_or_default(), given.name()),
                name.span,
            ));
        };
        let numeric = |value: &Value| value.word().and_then(|word| evaluate(word).ok()).filter(|x| x.is_finite());
        let Some(amount) = numeric(value) else {
            return Err(Diagnostic::error(
                format!("expected a number, not {}", value.word().unwrap_or_default()),
                value.span,
            ));
        };
        // a word that is a number is a specific gravity, unless a compartment has that name
        let is_tank = |v: &Value| v.word().is_some_and(|word| job.model.compartments.contains_key(&Model::key(word)));
        let gravity = rest.next_if(|v| numeric(v).is_some() && !is_tank(v));
        if let Some(wrong) = gravity.filter(|v| numeric(v).is_none_or(|x| x <= 0.0)) {
            return Err(Diagnostic::error("the specific gravity must be greater than zero", wrong.span));
        }
        let density = gravity.and_then(numeric).map(|sg| FRESH_WATER * sg);
        for key in keys {
            let fraction = share(job, &key, given, amount, density, value.span)?;
            fill(job, &key, Amount { fraction, density, surface, span: value.span })?;
        }
    }
    Ok(())
}

/// The share of a compartment that a value of an option is.
fn share(job: &Job, key: &str, given: &Given, amount: f64, density: Option<f64>, span: Span) -> Outcome<f64> {
    let to_error = |e: windlass_model::ClassError| e.diagnostic(span, job.units);
    if given.is(&PERCENT) {
        return Ok(0.01 * amount);
    }
    if given.is(&FRACTION) {
        return Ok(amount);
    }
    let model = &job.model;
    let Some(compartment) = model.compartments.get(key) else { return Ok(0.0) };
    let tank = Tank::new(model, compartment).map_err(to_error)?;
    if given.is(&AMOUNT) {
        let weight = Dim::Force.to_si(amount, job.units);
        let density = density.unwrap_or(compartment.contents.density);
        return Ok(weight / (density * model.defaults.gravity * tank.capacity));
    }
    let pose = pose_of(model, compartment);
    let [top, bottom] = tank.sounding_tube(model, compartment);
    let length = (nalgebra::Vector3::from(top) - nalgebra::Vector3::from(bottom)).norm();
    let value = Dim::Length.to_si(amount, job.units);
    if value < 0.0 || value > length * (1.0 + 1e-9) {
        return Err(Diagnostic::error(
            format!("{} of compartment {} is beyond its sounding tube", given.name(), compartment.name),
            span,
        )
        .label(format!(
            "the tube is {} {} long",
            eight_figures(Dim::Length.from_si(length, job.units)),
            Dim::Length.label(job.units)
        )));
    }
    let sounding = if given.is(&ULLAGE) { length - value } else { value };
    let volume = tank.volume_at(&pose, [top, bottom], sounding).ok_or_else(|| {
        Diagnostic::error(format!("the sounding tube of compartment {} lies level", compartment.name), span)
    })?;
    Ok(volume / tank.capacity)
}

/// Where the body of a compartment stands.
pub fn pose_of(model: &Model, compartment: &Compartment) -> Pose {
    let body = model.parts.get(&Model::key(&compartment.part)).and_then(|p| model.bodies.get(&Model::key(&p.body)));
    body.map(|b| Pose::from_place(&b.position)).unwrap_or_default()
}

static BALANCE_SPEC: CommandSpec = CommandSpec {
    data: &[
        ValueSpec::new("BODY", Kind::Name(Noun::Body), "the body"),
        ValueSpec::new(":SEL", Kind::Item, "compartments to fill: a name, a pattern or a selector"),
    ],
    repeat: 1,
    detail: "Fills the compartments named so that weight, contents and buoyancy balance at the present draft, roll and trim. At least three are needed, \
             and four as a rule: to port and starboard, fore and aft. Of all contents between -MINIMUM and -MAXIMUM that do, those are taken that differ least from the same \
             percentage of all. What is in other compartments stays. Connectors, wind and current are left out. A compartment keeps the density \
             of its liquid; it is closed, with a level surface.",
    example: "&DESCRIBE BODY TBRG\nMEDIT\nPGEN\nPLANE 0 400 -RECT 0 20 100\nEND\n&DESCRIBE COMPARTMENT 1P\nPGEN -STBD\nPLANE 10 190 -CART 1 1 49 1 49 19 1 19\nEND\n\
              &DESCRIBE COMPARTMENT 1S\nPGEN -PORT\nPLANE 10 190 -CART 1 1 49 1 49 19 1 19\nEND\n&DESCRIBE COMPARTMENT 2P\nPGEN -STBD\nPLANE 210 390 -CART 1 1 49 1 49 19 1 19\nEND\n\
              &DESCRIBE COMPARTMENT 2S\nPGEN -PORT\nPLANE 210 390 -CART 1 1 49 1 49 19 1 19\nEND\nEND\n&WEIGHT -TOTAL TBRG 12000 195 1 12 38 118 120\n&INSTATE -CONDITION 9\n\
              &CMP_BAL TBRG @\n&STATUS COMPARTMENT",
    ..CommandSpec::new("&CMP_BAL", "fills compartments so that a body is in equilibrium where it floats")
};

fn balance(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const BODY: DatumKey<str> = BALANCE_SPEC.word("BODY");
    piece::finish_piece(job);
    let args = &call.args;
    let to_error = |job: &Job, e: windlass_model::ClassError| e.diagnostic(args.span, job.units);
    let body = find(&job.model.bodies, args.word(BODY).unwrap_or_default(), "body", args.position(BODY))?.clone();
    job.model.check_effects(SolveKind::Statics).map_err(|e| to_error(job, e))?;
    let mut keys: Vec<String> = Vec::new();
    for value in args.data_after(BODY) {
        for key in choose_compartments(&job.model, value)? {
            let compartment = job.model.compartments.get(&key);
            let own = compartment.and_then(|c| job.model.parts.get(&Model::key(&c.part)));
            if own.is_none_or(|p| Model::key(&p.body) != Model::key(&body.name)) {
                let name = compartment.map(|c| c.name.clone()).unwrap_or_default();
                return Err(Diagnostic::error(format!("{name} is no compartment of {}", body.name), value.span));
            }
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
    }
    if keys.len() < 3 {
        return Err(Diagnostic::error(format!("{} compartments cannot balance a body", keys.len()), args.span)
            .help("choose at least four, to port and starboard, fore and aft"));
    }
    // what the others leave to be carried
    let mut without = job.model.clone();
    for key in &keys {
        if let Some(tank) = without.compartments.get_mut(key) {
            tank.contents.fraction = 0.0;
            tank.contents.is_flooded = false;
        }
    }
    let floating = Floating::at_rest(&without, &body).map_err(|e| to_error(job, e))?;
    let pose = Pose::from_place(&body.position);
    let still = [Category::Weight, Category::Contents, Category::Buoyancy];
    let mut rest = Six::zeros();
    for load in floating.loads.iter().filter(|load| still.contains(&load.category())) {
        rest += load.mean_load(&pose).map_err(|e| to_error(job, e))?.wrench;
    }
    let made = |key: &String| without.compartments.get(key).map(|c| Tank::new(&without, c));
    let tanks = keys.iter().filter_map(made).collect::<Result<Vec<_>, _>>().map_err(|e| to_error(job, e))?;
    let shares = balance_tanks(&tanks, &pose, &rest).map_err(|e| to_error(job, e))?;
    for (key, share) in keys.iter().zip(shares) {
        let Some(tank) = job.model.compartments.get_mut(key) else { continue };
        tank.contents.fraction = share;
        tank.contents.is_flooded = false;
        tank.contents.surface = FreeSurface::Level;
    }
    Ok(Effect::Done)
}
