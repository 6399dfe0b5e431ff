//! `~NAME TYPE ...`: defines a class, or adds a segment to one.

use crate::commands::absent::{self, AbsentClass};
use crate::commands::environment::plausible;
use crate::commands::menu;
use crate::commands::model_values::option_as_written;
use crate::commands::{Call, Command, Effect, Job, Menu};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::values::Args;
use windlass_base::values::Noun;
use windlass_connectors::{
    CLASSES, ClassKind, SECTIONS, SHAPE_SPEC, SectionKind, check_sections, class_specs, member_class, type_notices,
};
use windlass_language::args;
use windlass_language::name;
use windlass_language::record::Word;
use windlass_language::select::choose;
use windlass_language::spec::{CommandSpec, OptionEffect, TextForm};
use windlass_model::options::{C_SN, IG_STIFF};
use windlass_model::{Class, ClassRecord, Curve, CurveKind, Model, SolveKind, UnmodelledEffect, find};

/// ~CLASS.
pub static CLASS: Command = Command { spec: &SPEC, edits: false, run };

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    form: TextForm::Text,
    detail: "Repeating the name of a line class adds the next segment, fairlead first; for the other types it replaces the \
             class. The types from TUBE on are sections of structural members, which BEAM and PLATE take; a name of &DATA SHAPES is such a type too. In MEDIT the curves it names exist; in INMODEL they may be defined up to its END. &HELP ~CLASS TYPE \
             shows a type.",
    example: "MEDIT\n~WIRE B_CAT 4 -LEN 2000\n~WIRE B_CAT 3.5 -LEN 1000\nEND",
    ..CommandSpec::new("~CLASS", "NAME TYPE ...: defines a class")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let [name, rest @ ..] = call.words else { return Ok(Effect::Done) };
    let known = || class_specs().map(|spec| (spec.name, spec.owner, spec));
    let Some(word) = rest.first() else {
        let types: Vec<&str> = known().map(|(name, ..)| name).collect();
        return Err(Diagnostic::error(format!("class {} lacks its type", name.text), name.span)
            .label("expected a class type after this")
            .help(format!("known: {}", types.join(" "))));
    };
    name::check(&name.text, Some('~'), "class", name.span)?;
    let is_known = known().any(|(known, ..)| known.eq_ignore_ascii_case(&word.text));
    if let Some(shape) = job.shapes.get(&Model::key(&word.text)).filter(|_| !is_known).cloned() {
        let read = args::read(&SHAPE_SPEC, name.span, rest.get(1..).unwrap_or_default(), job.units)?;
        return append_section(job, name, shape.kind, shape.with_options(read));
    }
    if let (Some(absent), false) = (absent::find_class(&word.text), is_known) {
        keep_absent(job, &name.text, absent, word.span);
        return Ok(Effect::Done);
    }
    if absent::is_rolled_shape(&word.text) && !is_known {
        job.absent_classes.insert(Model::key(&name.text), None);
        job.warn(
            format!("the dimensions of {} are not in windlass: members of {} will stop solves", word.text, name.text),
            word.span,
        );
        return Ok(Effect::Done);
    }
    let spec = choose(&word.text, word.span, "class type", known())?;
    if let Some(kind) = SECTIONS.iter().find(|kind| std::ptr::eq(kind.spec, spec)) {
        let read = args::read(spec, name.span, rest.get(1..).unwrap_or_default(), job.units)?;
        return append_section(job, name, kind, read);
    }
    let Some(kind) = CLASSES.iter().find(|kind| std::ptr::eq(kind.spec, spec)).copied() else {
        return Ok(Effect::Done);
    };
    let read = args::read(kind.spec, name.span, rest.get(1..).unwrap_or_default(), job.units)?;
    if matches!(job.menu(), Menu::Medit) {
        known_curves(job, &read)?;
    }
    let mut notices = type_notices(&read, job.units);
    notices.extend(unknown_fatigue(&read, job));
    let record = ClassRecord { args: read, defaults: job.model.defaults };
    let key = Model::key(&name.text);
    let mut remark = None;
    if let Some(class) = job.model.classes.get(&key) {
        if class.object.kind() != kind.spec.name {
            return Err(Diagnostic::error(format!("{} is a {} already", class.name, class.object.kind()), word.span)
                .other(class.span, "defined here")
                .help(format!("DELETE {} first, or use another name", class.name)));
        }
        let users = job.model.users_of_class(&name.text);
        if class.object.as_segmented().is_some() {
            if let Some(user) = users.first() {
                return Err(Diagnostic::error(
                    format!("{} is used by connector {user}; a further segment would change it", class.name),
                    name.span,
                )
                .other(class.span, "defined here")
                .help("define all segments before the connector, or DELETE the connector first"));
            }
        } else {
            remark = Some(match users.len() {
                0 => format!("{} is replaced", class.name),
                n => format!("{} is replaced; {n} connectors use it", class.name),
            });
        }
    }
    let last = record.args.clone();
    let object = match job.model.classes.get_mut(&key).filter(|class| class.object.as_segmented().is_some()) {
        Some(class) => {
            class.append(record, kind.build)?;
            class.name = name.text.to_string();
            Arc::clone(&class.object)
        }
        None => {
            let object = (kind.build)(std::slice::from_ref(&record))?;
            let ignored_stiffness = record.args.option_if_declared(&IG_STIFF).is_some();
            let (name, span, built) = (name.text.to_string(), name.span, Arc::clone(&object));
            let class = Class { name, records: vec![record], ignored_stiffness, object: built, span };
            job.model.classes.insert(key, class);
            object
        }
    };
    notices.extend(object.notices(&last, job.units, &job.model.surroundings()));
    notices.extend(plausible::friction(&last));
    notices.extend(idle(job, kind, &last));
    job.note_name(&name.text, name.span);
    job.notices.extend(notices);
    keep_unmodelled_options(job, &name.text, &last);
    if let Some(text) = remark {
        job.remark(text, name.span);
    }
    Ok(Effect::Done)
}

/// Adds a section to a class of structural members, or defines the class.
///
/// # Errors
/// Dimensions that make no section; a class of connectors of that name; a second segment without length.
fn append_section(job: &mut Job, name: &Word, kind: &'static SectionKind, read: Args) -> Outcome<Effect> {
    let record = ClassRecord { args: read, defaults: job.model.defaults };
    let section = (kind.read)(&record)?;
    let key = Model::key(&name.text);
    let old = job.model.classes.get(&key);
    if let Some(old) = old.filter(|old| old.object.as_members().is_none()) {
        let text = format!("{} is a {} already", old.name, old.object.kind());
        return Err(Diagnostic::error(text, name.span).other(old.span, "defined here"));
    }
    if let Some(user) = job.model.users_of_class(&name.text).first() {
        let text = format!("{} is used by {user}; a further segment would change it", name.text);
        return Err(Diagnostic::error(text, name.span).help("define all segments before the first BEAM of the class"));
    }
    let mut sections = old.and_then(|old| old.object.as_members()).map(<[_]>::to_vec).unwrap_or_default();
    let mut records = old.map(|old| old.records.clone()).unwrap_or_default();
    let span = old.map_or(name.span, |old| old.span);
    sections.push(section);
    check_sections(&sections, name.span)?;
    records.push(record);
    let class =
        Class { name: name.text.to_string(), records, ignored_stiffness: false, object: member_class(sections), span };
    job.model.classes.insert(key, class);
    job.note_name(&name.text, name.span);
    Ok(Effect::Done)
}

/// Keeps the name of a class of a type that windlass does not have, so that what uses it is not an error of its own; says so once a type.
fn keep_absent(job: &mut Job, name: &str, absent: &'static AbsentClass, span: Span) {
    job.absent_classes.insert(Model::key(name), Some(absent.of_connectors));
    if job.absent_said.contains(&absent.name) {
        return;
    }
    job.absent_said.push(absent.name);
    let text = format!("class type {} of MOSES is not in windlass: {} (said once)", absent.name, absent.of_connectors);
    job.warn(text, span);
}

/// What a refused record of a class leaves in a script: what uses a class without any record stops solves, and so does a class of several
/// segments that lacks one, without an error of their own.
pub fn keep_refused(job: &mut Job, words: &[Word]) {
    let Some(name) = words.first() else { return };
    let key = Model::key(&name.text);
    match job.model.classes.get(&key) {
        None => {
            job.absent_classes.entry(key).or_insert(Some("its class was refused"));
        }
        Some(class) if class.object.as_segmented().is_some() || class.object.as_members().is_some() => {
            let (record, effect) = (format!("a segment of class {}", class.name), "its record was refused".to_string());
            let (matters_to, span) = (SolveKind::Statics, name.span);
            job.model.keep_unmodelled(UnmodelledEffect { record, effect, matters_to, span });
        }
        Some(_) => {}
    }
}

/// What options of a class would do that no solver computes: solves they matter to stop.
fn keep_unmodelled_options(job: &mut Job, class: &str, args: &Args) {
    for given in &args.options {
        let OptionEffect::Stops(matters_to, effect) = given.option.effect else { continue };
        let record = format!("{} of class {class}", option_as_written(given, job.units));
        let kept = UnmodelledEffect { record, effect: effect.into(), matters_to, span: given.span };
        job.remark(format!("not computed: {}; solves it matters to will stop", kept.sentence()), given.span);
        job.model.keep_unmodelled(kept);
    }
}

/// Sees that the curves a record names exist and are convolutions: no other curve has a place in a class.
///
/// # Errors
/// An unknown curve, or one of another sort, at its word.
pub fn known_curves(job: &Job, args: &Args) -> Outcome<()> {
    for value in args.options.iter().flat_map(|given| given.names(Noun::Curve)) {
        let Some(name) = value.word() else { continue };
        let curve: &Curve = find(&job.model.curves, name, "curve", value.span)
            .map_err(|e| e.help(format!("&DATA CONVOLUTION TIME {name} T1 K1 T2 K2 .. defines it")))?;
        if !matches!(curve.kind, CurveKind::ConvolutionTime | CurveKind::ConvolutionFrequency) {
            let text = format!("curve {name} is a {}, not a CONVOLUTION", curve.kind.name());
            return Err(Diagnostic::error(text, value.span).other(curve.span, "defined here"));
        }
    }
    Ok(())
}

/// What is said, once for each class type, of options that do nothing in it.
fn idle(job: &mut Job, kind: &'static ClassKind, args: &Args) -> Vec<Diagnostic> {
    let mut made = Vec::new();
    for (option, with) in kind.idle {
        let Some(given) = args.option(option) else { continue };
        let said = (kind.spec.name, option.name);
        if job.idle_said.contains(&said) {
            continue;
        }
        job.idle_said.push(said);
        let text = match *with {
            "" => format!("{} does nothing in {} (said once)", option.name, kind.spec.name),
            with => format!("{} of {} acts with {with} alone (said once)", option.name, kind.spec.name),
        };
        made.push(*Diagnostic::remark(text, given.span));
    }
    made
}

/// What is said of a fatigue curve that nothing defines yet.
fn unknown_fatigue(args: &Args, job: &Job) -> Option<Diagnostic> {
    let value = args.option_if_declared(&C_SN).and_then(|given| given.values.first())?;
    let name = value.word().filter(|w| windlass_signal::fatigue::find(w, &job.model.fatigue).is_none())?;
    let text = format!("{name} is kept as the name of an S-N curve that is not defined here");
    let made = Diagnostic::remark(text, value.span);
    Some(*made.help("&STATUS SN lists the curves; &REP_SELECT -SN CURVE TYPE S N S N .. defines one"))
}
