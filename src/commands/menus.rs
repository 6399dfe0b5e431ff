//! The commands that open menus, and the end of INMODEL.

use crate::commands::environment::bathymetry;
use crate::commands::menu;
use crate::commands::model::assembly::build_assembly;
use crate::commands::model::class::known_curves;
use crate::commands::model::connector::build_connector;
use crate::commands::model::element::build_elements;
use crate::commands::model::{hydrodynamics, pgen, piece};
use crate::commands::output::buildg;
use crate::commands::settings::device::existing;
use crate::commands::{Call, Command, DeckFormat, Effect, INMODEL_FILE, Job, Menu};
use std::path::PathBuf;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_language::record::Word;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, MenuSpec, Opens, OptionSpec, ValueSpec};
use windlass_language::token::TokenKind as Lex;
use windlass_moordyn::records::{Like, LineModel};
use windlass_orcaflex::records as orcaflex;

/// INMODEL.
pub static INMODEL: Command = Command { spec: &INMODEL_SPEC, edits: false, run: inmodel };
/// MEDIT.
pub static MEDIT: Command = Command { spec: &MEDIT_SPEC, edits: false, run: medit };
/// PRCPOST.
pub static PRCPOST: Command = Command { spec: &PRCPOST_SPEC, edits: false, run: prcpost };
/// CONN_DESIGN.
pub static CONN_DESIGN: Command = Command { spec: &CONN_DESIGN_SPEC, edits: false, run: conn_design };

const AQWA: OptionSpec = OptionSpec::new(
    "-AQWA",
    &[ValueSpec::new("FILE", Kind::File, "the deck; looked for where it says, then beside the script")],
    "reads the model of an AQWA deck",
)
.owner(Owner::Ours);

const MOORDYN: OptionSpec = OptionSpec::new(
    "-MOORDYN",
    &[ValueSpec::new("FILE", Kind::File, "the deck; looked for where it says, then beside the script")],
    "reads the model of a deck of MoorDyn, MoorPy or MAP++",
)
.owner(Owner::Ours);
const ORCAFLEX: OptionSpec = OptionSpec::new(
    "-ORCAFLEX",
    &[ValueSpec::new("FILE", Kind::File, "the text model (.yml); looked for where it says, then beside the script")],
    "reads an OrcaFlex text model",
)
.owner(Owner::Ours);
const STATIC: OptionSpec =
    OptionSpec::new("-STATIC", &[], "reads the lines of -MOORDYN and -ORCAFLEX as quasi-static ones")
        .default("as dynamic lines of the segments given")
        .owner(Owner::Ours);

const LIKE: OptionSpec = OptionSpec::new(
    "-LIKE",
    &[ValueSpec::choice::<Like>("WHOM", "MOORDYN: the answers of MoorDyn 2.7.2").or("RIGHT")],
    "whose answer is taken where MoorDyn and the right one part",
)
.default("RIGHT")
.owner(Owner::Ours);

static INMODEL_SPEC: CommandSpec = CommandSpec {
    opens: Opens::UnlessFile(&menu::INMODEL),
    menus: &[&menu::MAIN],
    options: &[AQWA, MOORDYN, ORCAFLEX, STATIC, LIKE],
    detail: "Reads model descriptions from ROOT.DAT, or from the file of &DEVICE -AUXIN; without either the records follow \
             up to END. A CONNECTOR may name classes and points that are defined later. -AQWA reads decks 1 to 17 of a deck of \
             AQWA cards instead: its structures become bodies S1, S2 .. with their centers of gravity as origins, its nodes points *S1_1010 or, in \
             the ground, *N9010, its tethers and lines connectors T1, L1 .. and its sea the environment in force; a file of INMODEL that is a deck is read so by itself. \
             `windlass NAME.dat` also runs it, and writes its records to NAME.cif in the folder of answers. -MOORDYN reads a deck of MoorDyn \
             2 or 1, of MoorPy, or a file of MAP++: fixed points become points *P1 .. of the ground, coupled ones points of a body VESSEL, free ones junctions P3 .., \
             bodies BODY1 .., rods bodies ROD1 .. of one TUBE or parts of their body, lines connectors L1 .. that begin at the fairlead (MoorDyn's end B), and depth, density and g defaults and the environment \
             in force, with the currents, waves and seafloor of the files beside the deck. A file of MAP++ has the water in force, and static lines alone. What is coupled stands still until PRESCRIBE moves it; \
             a body VESSEL that the model has takes the coupled points, and moves as it did. With -LIKE MOORDYN, as in MoorDyn 2.7.2, bodies have their buoyancy at the center of gravity and lose the first one of three or six drag areas, friction of the seabed rises with speed by FricDamp, a seafloor pushes straight up, waves act on points and bodies by drag alone, and tensions at ends are those in the middle of the end segments. A line is a dynamic one of class ROD with NumSegs elements; with \
             -STATIC it is a B_CAT to an anchor on the seabed, else an H_CAT. -ORCAFLEX reads General, Environment, LineTypes, Vessels and Lines of an OrcaFlex text model: vessels \
             become bodies that stand still until PRESCRIBE moves them, lines connectors of their names with their ends *L1A, *L1B ... A load that is not read is an error at its word.",
    example: "INMODEL\n&DESCRIBE BODY TBRG\nCONNECTOR A ~W *P\n*P 0 0 0\n~W B_CAT 4 -LEN 500\nEND",
    ..CommandSpec::new("INMODEL", "reads the model")
};
static MEDIT_SPEC: CommandSpec = CommandSpec {
    opens: Opens::Menu(&menu::MEDIT),
    menus: &[&menu::MAIN],
    detail: "Names must be defined before they are used.",
    example: "MEDIT\n*P 0 0 0\nEND",
    ..CommandSpec::new("MEDIT", "edits the model, up to END")
};
static CONN_DESIGN_SPEC: CommandSpec = CommandSpec {
    opens: Opens::Menu(&menu::CONN_DESIGN),
    menus: &[&menu::MAIN],
    detail: "TABLE tabulates a line, GEOMETRY shapes it, MOVE moves a body until a line breaks, WATCH draws its watch circle.",
    example: "CONN_DESIGN\nEND",
    ..CommandSpec::new("CONN_DESIGN", "connector design, up to END")
};

static PRCPOST_SPEC: CommandSpec = CommandSpec {
    opens: Opens::Menu(&menu::PRCPOST),
    menus: &[&menu::MAIN],
    detail: "Tables of the last run of TDOM; each opens the disposition menu. A run whose model has been changed since is reported \
             as it was; points are taken where they stand in their bodies now.",
    example: "PRCPOST\nEND",
    ..CommandSpec::new("PRCPOST", "post-processing of a run, up to END")
};

/// The menu that a record of this command opens, so that an `END` of its own belongs to it.
pub fn find_opened_menu(job: &Job, spec: &CommandSpec, words: &[Word]) -> Option<&'static MenuSpec> {
    match spec.opens {
        Opens::Nothing => None,
        Opens::Menu(name) => Some(name),
        Opens::AtMost(name, count) => (words.len() <= count + 1).then_some(name),
        Opens::AtMostElse(name, count, other) => Some(if words.len() <= count + 1 { name } else { other }),
        Opens::WithOption(name, option) => words.iter().any(|w| stands_for(w, option)).then_some(name),
        Opens::WithEither(name, options) => {
            words.iter().any(|w| options.iter().any(|option| stands_for(w, option))).then_some(name)
        }
        Opens::WithoutOption(name, option) => (!words.iter().any(|w| stands_for(w, option))).then_some(name),
        Opens::Short(name, count) => {
            let data = words.iter().skip(1).take_while(|w| w.kind != Lex::Option).count();
            (data <= count).then_some(name)
        }
        Opens::UnlessFile(name) => {
            let deck = words.iter().any(|w| w.kind == Lex::Option);
            (!deck && model_file(job).is_none()).then_some(name)
        }
    }
}

/// Whether a word is an option, in full or not.
fn stands_for(word: &Word, option: &OptionSpec) -> bool {
    word.text.len() >= 3 && option.name.starts_with(&word.text.to_ascii_uppercase())
}

/// The file INMODEL reads: that of `&DEVICE -AUXIN`, there or not, else ROOT.DAT when there is one.
fn model_file(job: &Job) -> Option<PathBuf> {
    let root = &job.output.folder.root;
    let beside = || ["dat", "DAT"].iter().map(|e| root.with_extension(e)).find(|p| p.exists());
    job.settings.auxiliary.clone().or_else(beside)
}

fn inmodel(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let is_static = call.args.has(&STATIC);
    let lines = if is_static { LineModel::Static } else { LineModel::Dynamic };
    let like =
        call.args.option(&LIKE).and_then(|given| given.choice(const { LIKE.choice("WHOM") })).unwrap_or(Like::Right);
    let orcaflex = if is_static { orcaflex::LineModel::Static } else { orcaflex::LineModel::Dynamic };
    let mut decks: Vec<Effect> = Vec::new();
    for (option, format) in [
        (&AQWA, DeckFormat::Aqwa),
        (&MOORDYN, DeckFormat::MoorDyn(lines, like)),
        (&ORCAFLEX, DeckFormat::OrcaFlex(orcaflex)),
    ] {
        let Some(value) = call.args.option(option).and_then(|given| given.values.first()) else { continue };
        if !decks.is_empty() {
            return Err(
                Diagnostic::error("INMODEL reads one deck", value.span).help("read the other by another INMODEL")
            );
        }
        let name = value.word().unwrap_or_default();
        decks.push(Effect::Deck { name: name.to_string(), path: existing(job, name, value.span)?, format });
    }
    if let (Some(given), false) = (call.args.option(&LIKE), call.args.has(&MOORDYN)) {
        let error = Diagnostic::error("-LIKE says whose answers a MoorDyn deck is read for", given.span);
        return Err(error.help("write INMODEL -MOORDYN FILE -LIKE MOORDYN"));
    }
    if is_static && ![&MOORDYN, &ORCAFLEX].into_iter().any(|option| call.args.has(option)) {
        let error = Diagnostic::error(
            "-STATIC says how the lines of a MoorDyn deck are read, or of an OrcaFlex model",
            call.args.span,
        );
        return Err(error.help("write INMODEL -MOORDYN FILE -STATIC"));
    }
    if let Some(deck) = decks.pop() {
        return Ok(deck);
    }
    let found = model_file(job);
    if let Some(path) = found.as_ref().filter(|p| !p.exists()) {
        let text = format!("the auxiliary input {} does not exist", path.display());
        return Err(Diagnostic::error(text, call.args.span).help("set by &DEVICE -AUXIN"));
    }
    job.menus.push(Menu::Inmodel);
    Ok(match found {
        Some(path) => Effect::Insert { name: path.display().to_string(), path, tag: INMODEL_FILE },
        None => Effect::Done,
    })
}

fn medit(job: &mut Job, _: &Call) -> Outcome<Effect> {
    job.menus.push(Menu::Medit);
    Ok(Effect::Done)
}

fn prcpost(job: &mut Job, _: &Call) -> Outcome<Effect> {
    job.menus.push(Menu::Post);
    Ok(Effect::Done)
}

fn conn_design(job: &mut Job, _: &Call) -> Outcome<Effect> {
    job.menus.push(Menu::ConnDesign);
    Ok(Effect::Done)
}

/// What a menu that has been left still does: INMODEL builds the connectors that waited for names defined later, PGEN
/// the piece of its planes, and a piece given by panels is complete. Returns what is wrong; `at` is the record that left it.
pub fn finish(job: &mut Job, left: Menu, at: Option<Span>) -> Vec<Diagnostic> {
    match left {
        Menu::Inmodel => {
            let mut notices = piece::complete_piece(job, at);
            notices.extend(finish_inmodel(job));
            notices
        }
        Menu::Medit | Menu::Mesh(_) => piece::complete_piece(job, at),
        Menu::Surface => piece::finish_surface(job, at),
        Menu::Block(planes) => pgen::finish_block(job, *planes, at).err().into_iter().map(|e| *e).collect(),
        Menu::Building(building) => {
            buildg::open_built_table(job, &building, at).err().into_iter().map(|e| *e).collect()
        }
        Menu::Soundings(soundings) => {
            bathymetry::finish_grid(job, *soundings, at).err().into_iter().map(|e| *e).collect()
        }
        Menu::Total(data) => hydrodynamics::finish_total(job, *data, at),
        Menu::Planes(planes) => pgen::build(job, *planes, at).err().into_iter().map(|e| *e).collect(),
        _ => Vec::new(),
    }
}

/// Builds the connectors that waited for names defined later; returns what is wrong with each that cannot be built, and
/// with the curves that classes name.
fn finish_inmodel(job: &mut Job) -> Vec<Diagnostic> {
    let waiting = std::mem::take(&mut job.deferred);
    let records = job.model.classes.values().flat_map(|class| class.records.iter());
    let curves: Vec<_> = records.filter_map(|r| known_curves(job, &r.args).err()).collect();
    let mut wrong: Vec<_> = curves.into_iter().collect();
    wrong.extend(waiting.iter().filter_map(|args| build_connector(job, args).err()));
    for record in std::mem::take(&mut job.deferred_elements) {
        let before = job.model.clone();
        if let Err(error) = build_elements(job, &record) {
            job.model = before;
            wrong.push(error);
        }
    }
    for args in std::mem::take(&mut job.deferred_assemblies) {
        // one that fails half way leaves the model as it was
        let before = job.model.clone();
        if let Err(error) = build_assembly(job, &args) {
            job.model = before;
            wrong.push(error);
        }
    }
    wrong.into_iter().map(|e| *e).collect()
}
