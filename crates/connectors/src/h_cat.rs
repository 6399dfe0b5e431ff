//! H_CAT: a hanging catenary between a body and ground or another body; it knows neither bottom nor surface.
//!
//! Source: [MOSES-FLEX H_CAT]; [MOSES-HELP connect]: weightless unless EXACT, then with its weight in air.

use super::devices;
use super::dynamic_line as m;
use super::line_class::{LineClass, LineClassKind, LineForm, devices_help, dynamics_help};
use super::section::{self, LineSection};
use super::{ClassKind, options as o};
use windlass_base::diagnostic::Diagnostic;
use windlass_base::table::Table;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::Args;
use windlass_language::spec::{CommandSpec, DatumKey, OptionSpec, ValueSpec, count_options, join_lists, join_options};
use windlass_model::Surroundings;

/// The class type.
pub static H_CAT: ClassKind =
    ClassKind { spec: &H_CAT_SPEC, build: |records| LineClass::build(&KIND, records), idle: section::HANGING_IDLE };

const LISTS: &[&[OptionSpec]] = &[
    &[o::LEN, o::TYPE, o::REFINE, o::IG_STIFF, o::SEND, o::X_PY],
    &o::SEGMENT,
    &[o::EA_BOUNDS, o::TAB_LIM, o::CLUMP],
    &o::DIAMETERS,
    &m::LINE_OPTIONS,
    &devices::OPTIONS,
];

/// Options of lines between two points of bodies.
pub const LINE_OPTIONS: [OptionSpec; count_options(LISTS)] = join_lists(LISTS);

/// Options of a B_CAT that are taken, and do nothing without a bottom or give the place of an anchor.
const BOTTOM_OPTIONS: [OptionSpec; 3] = [o::DEPANCHOR, o::FRICTION, o::SLOPE];

static H_CAT_OPTIONS: [OptionSpec; LINE_OPTIONS.len() + BOTTOM_OPTIONS.len()] =
    join_options(&LINE_OPTIONS, &BOTTOM_OPTIONS);

/// What is said of a class with options of the bottom.
const NO_BOTTOM: &str = "it has no bottom: -FRICTION and -SLOPE do nothing, and -DEPANCHOR is the depth of its anchor alone; a B_CAT lies on the bottom";

static H_CAT_SPEC: CommandSpec = CommandSpec {
    data: &[o::LINE_OD, ValueSpec::choice::<o::CatenaryFlag>("FLAG", "with its weight").or("weightless")],
    options: &H_CAT_OPTIONS,
    detail: concat!(
        dynamics_help!(),
        "A hanging catenary: it knows neither bottom nor surface (reports say where it passes them), and takes no buoys. -DEPANCHOR is the depth of its anchor; -FRICTION and -SLOPE do nothing. Without EXACT it is weightless: \
             a spring along the chord that only pulls. ",
        devices_help!(),
    ),
    example: "MEDIT\n~HANG H_CAT 3 EXACT -LEN 400\nEND\n&STATUS CLASS ~HANG",
    ..CommandSpec::new("H_CAT", "hanging catenary")
};

const FLAG: DatumKey<o::CatenaryFlag> = H_CAT_SPEC.choice("FLAG");

static KIND: LineClassKind = LineClassKind {
    spec: &H_CAT_SPEC,
    flag: |args| args.choice(FLAG).map(|o::CatenaryFlag::Exact| args.position(FLAG)),
    per_line: &[o::SEND, o::X_PY, o::TAB_LIM, o::DEPANCHOR, o::FRICTION, o::SLOPE, m::SEABED],
    max_bodies: 2,
    takes_spring_buoys: false,
    has_dynamics: true,
    form,
    notes: |class| if has_bottom_options(class) { vec![NO_BOTTOM.into()] } else { Vec::new() },
    notices,
    add_facts,
};

/// A weightless one is a spring along its chord, unless clumps hang on it.
fn form(class: &LineClass) -> LineForm {
    let has_weight = class.flag.is_some();
    if !has_weight && class.sections.iter().all(|s| s.clump == 0.0) {
        return LineForm::Chord { takes_compression: false };
    }
    LineForm::Hanging { has_weight }
}

fn has_bottom_options(class: &LineClass) -> bool {
    BOTTOM_OPTIONS.iter().any(|option| class.per_line.option(option).is_some())
}

fn notices(class: &LineClass, last: &Args, units: UnitSystem, _: &Surroundings) -> Vec<Diagnostic> {
    if class.flag.is_some() {
        let weight = |s: &LineSection| (s.in_air(), "in air, which H_CAT hangs by");
        return section::bar_notice(&class.sections, last, units, weight).into_iter().collect();
    }
    let [only] = class.sections.as_slice() else { return Vec::new() };
    let weights = [o::WTPLEN, o::DENSITY, o::SPGRAVITY, o::TYPE];
    let given = weights.iter().find_map(|option| last.option(option)).filter(|_| only.clump == 0.0);
    let notice = given.map(|given| {
        let text = format!("{} is not used: an H_CAT without EXACT is weightless", given.name());
        *Diagnostic::remark(text, given.span).help("~NAME H_CAT OD EXACT has its weight; a dynamic line has it always")
    });
    notice.into_iter().collect()
}

fn add_facts(class: &LineClass, table: Table, _: &Surroundings) -> Table {
    let mut table = table.fact("Flag", if class.flag.is_some() { "EXACT" } else { "weightless" }, Dim::None);
    if has_bottom_options(class) {
        table.note(NO_BOTTOM);
    }
    table
}
