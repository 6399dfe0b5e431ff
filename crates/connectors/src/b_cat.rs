//! B_CAT: a catenary to ground, of one or more segments.
//!
//! Source: [MOSES-FLEX B_CAT].

use super::devices;
use super::dynamic_line as m;
use super::line_class::{LineClass, LineClassKind, LineForm, devices_help, dynamics_help};
use super::section;
use super::{ClassKind, options as o};
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_language::spec::{CommandSpec, DatumKey, OptionSpec, ValueSpec, count_options, join_lists};
use windlass_model::{AnchoredClass, ConnectorClass, StaticLineClass, Surroundings};

/// The class type.
pub static B_CAT: ClassKind =
    ClassKind { spec: &SPEC, build: |records| LineClass::build(&KIND, records), idle: section::CATENARY_IDLE };

const LISTS: &[&[OptionSpec]] = &[
    &[o::LEN, o::TYPE, o::DEPANCHOR, o::REFINE, o::IG_STIFF, o::SEND, o::X_PY],
    &o::SEGMENT,
    &[o::EA_BOUNDS, o::TAB_LIM, o::TABLE, o::CLUMP],
    &o::DIAMETERS,
    &[o::FRICTION, o::SLOPE],
    &m::LINE_OPTIONS,
    &devices::OPTIONS,
];

static OPTIONS: [OptionSpec; count_options(LISTS)] = join_lists(LISTS);

static SPEC: CommandSpec = CommandSpec {
    data: &[
        o::LINE_OD,
        ValueSpec::choice::<o::CatenaryFlag>("FLAG", "without effect: the line is always solved exactly").or("exact"),
    ],
    options: &OPTIONS,
    detail: concat!(
        dynamics_help!(),
        "One record a segment, fairlead first, all with the same class name. A negative -CLUMP is a spring buoy: \
             the joint stays CLEN below the surface until the pull reaches the buoy's displacement, then sinks; the \
             segments above it do not see the bottom. -TYPE NAME D takes a chain or rope of the library (&STATUS LINE_TYPES) \
             instead of OD. Per segment: OD, -TYPE, -LEN, material, diameters, -CLUMP, -B_TENSION, -C_SN. Per line, on any \
             record: FLAG, -DEPANCHOR, -FRICTION, -SLOPE, -TABLE, -TAB_LIM, -SEND, -X_PY, -X_DAMPING, -CONVOLUTION, -PISTON. \
             Connects a body to ground. On -BATHYMETRY of &ENV the line lies on the profile along its azimuth, unless -DEPANCHOR or -SLOPE is given. The line is solved exactly wherever it is used. -TABLE is the shortcut of MOSES: thirty rows \
             at the elevation of the fairlead, forces interpolated between them, exact nearer than the first row, straight on beyond the \
             last. Its rows are made anew where the fairlead rises or sinks, which makes it slower than the exact solution. ",
        devices_help!(),
    ),
    example: "MEDIT\n~WIRE B_CAT 4.625 -LEN 500 -BUOY 0 -WTPL 37.51/1000 -EMOD 29000*0.1 -CLUMP -100\n\
              ~WIRE B_CAT 4.625 -LEN 4000 -BUOY 0 -WTPL 37.51/1000 -EMOD 29000*0.1 -DEPANCHOR 3000\nEND\n&STATUS CLASS ~WIRE",
    ..CommandSpec::new("B_CAT", "catenary to ground")
};

const FLAG: DatumKey<o::CatenaryFlag> = SPEC.choice("FLAG");

static KIND: LineClassKind = LineClassKind {
    spec: &SPEC,
    flag: |args| args.choice(FLAG).map(|o::CatenaryFlag::Exact| args.position(FLAG)),
    per_line: &[o::DEPANCHOR, o::FRICTION, o::SLOPE, o::TAB_LIM, o::SEND, o::X_PY, m::SEABED],
    max_bodies: 1,
    takes_spring_buoys: true,
    has_dynamics: true,
    form: |_| LineForm::OnBottom,
    notes: |_| Vec::new(),
    notices: |class, last, units, around| {
        let weight = |s: &section::LineSection| (s.submerged_weight(around), "in water");
        section::bar_notice(&class.sections, last, units, weight).into_iter().collect()
    },
    add_facts,
};

fn add_facts(class: &LineClass, table: Table, surroundings: &Surroundings) -> Table {
    let mut table = table
        .fact("Solution", if class.is_tabulated() { "table of thirty points (-TABLE)" } else { "exact" }, Dim::None)
        .fact("Depth at Anchor", class.anchor_depth(surroundings), Dim::Length)
        .fact("Slope of Bottom", class.slope().unwrap_or(0.0), Dim::None)
        .fact("Friction of Bottom", class.friction(), Dim::None)
        .fact("Table Limit", class.table_limit(), Dim::Force);
    if class.check().is_err() {
        table.note("a spring buoy ends the last segment: a further segment is needed");
    }
    table
}
