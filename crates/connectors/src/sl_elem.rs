//! SL_ELEM: a spring along the chord between its ends, both ways or in tension only.
//!
//! Source: [MOSES-FLEX SL_ELEM].

use super::dynamic_line as m;
use super::h_cat::LINE_OPTIONS;
use super::line_class::{LineClass, LineClassKind, LineForm, devices_help};
use super::section::four_figures;
use super::{ClassKind, options as o};
use windlass_base::choices;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::Args;
use windlass_language::spec::{CommandSpec, DatumKey, OptionSpec, ValueSpec};
use windlass_model::{Note, Surroundings};

/// The class type.
pub static SL_ELEM: ClassKind =
    ClassKind { spec: &SL_ELEM_SPEC, build: |records| LineClass::build(&KIND, records), idle: IDLE };

/// Options that do nothing in a spring along a chord.
const IDLE: &[(OptionSpec, &str)] = &[
    (o::WTPLEN, ""),
    (o::DISPLEN, ""),
    (o::DENSITY, ""),
    (o::SPGRAVITY, ""),
    (o::BUOYDIAMETER, ""),
    (o::DRAGDIAMETER, ""),
    (o::WINDDIAMETER, ""),
    (o::AMASDIAMETER, ""),
    (o::POI_RAT, ""),
    (o::ALPHA, ""),
    (o::REFINE, ""),
    (o::CLUMP, ""),
    (m::CD, ""),
    (m::CA, ""),
    (m::AX_DAMPING, ""),
    (m::SEABED, ""),
];

choices! {
    /// The flag of a straight line.
    enum BarFlag {
        /// It only pulls.
        Tension = "TENSION",
    }
}

static SL_ELEM_SPEC: CommandSpec = CommandSpec {
    data: &[o::LINE_OD, ValueSpec::choice::<BarFlag>("FLAG", "tension only").or("tension and compression")],
    detail: concat!(
        "Its force depends only on the distance between the ends and acts along the line between them: it has no weight. H_CAT EXACT has. ",
        devices_help!(),
    ),
    example: "MEDIT\n~TIE SL_ELEM 3 TENSION -LEN 50\nEND\n&STATUS CLASS ~TIE",
    options: &LINE_OPTIONS,
    ..CommandSpec::new("SL_ELEM", "spring along the chord between its ends")
};

const FLAG: DatumKey<BarFlag> = SL_ELEM_SPEC.choice("FLAG");

static KIND: LineClassKind = LineClassKind {
    spec: &SL_ELEM_SPEC,
    flag: |args| args.choice(FLAG).map(|BarFlag::Tension| args.position(FLAG)),
    per_line: &[o::SEND, o::X_PY, o::TAB_LIM],
    max_bodies: 2,
    takes_spring_buoys: false,
    has_dynamics: false,
    form: |class| LineForm::Chord { takes_compression: class.flag.is_none() },
    notes: |class| {
        let clump = class.sections.iter().find(|s| s.clump != 0.0);
        clump.map(|_| Note::warning("-CLUMP does not act on an SL_ELEM, which is straight")).into_iter().collect()
    },
    notices,
    add_facts: |class, table, _| {
        let flag = if class.flag.is_some() { "TENSION" } else { "tension and compression" };
        let mut table = table.fact("Flag", flag, Dim::None);
        table.note("an SL_ELEM has no weight: those above are not used");
        table
    },
};

fn notices(class: &LineClass, last: &Args, units: UnitSystem, around: &Surroundings) -> Vec<Diagnostic> {
    let [only] = class.sections.as_slice() else { return Vec::new() };
    let weight = only.submerged_weight(around) * only.length;
    if weight == 0.0 {
        return Vec::new();
    }
    let text = format!("an SL_ELEM has no weight: {} in water are left out", four_figures(weight, Dim::Force, units));
    vec![*Diagnostic::remark(text, last.span).help("H_CAT EXACT has its weight, ROD bends as well")]
}
