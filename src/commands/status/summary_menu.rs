//! The menu `&SUMMARY`: reports of the model's geometry, under the words of MOSES.
//!
//! Source: [MOSES-HELP lgroup] names LOADG_SUM, published samples CATEG_SUM, POINT_SUM, N_COINCIDENT and the macro GEOM; what stands in each is our reading: the
//! tables of &STATUS.

use crate::commands::menu;
use crate::commands::name_filter::NameFilter;
use crate::commands::status::kind::{Query, StatusKind};
use crate::commands::status::{body_tables, categories, class_tables, compartments, loads_table, model_tables};
use crate::commands::verdict::Verdict;
use crate::commands::{Call, Command, Effect, Job, Menu};
use nalgebra::Vector3;
use windlass_base::diagnostic::Outcome;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_language::spec::{CommandSpec, Kind, MenuSpec, Opens, ValueSpec};
use windlass_model::{Model, Point};

/// &SUMMARY.
pub static SUMMARY: Command = Command { spec: &MENU_SPEC, edits: false, run: open };
/// CATEG_SUM.
pub static CATEG_SUM: Command =
    Command { spec: &CATEG_SPEC, edits: false, run: |job, call| report(job, call, &[&categories::CATEGORY]) };
/// LOADG_SUM.
pub static LOADG_SUM: Command =
    Command { spec: &LOADG_SPEC, edits: false, run: |job, call| report(job, call, &[&loads_table::LOADS]) };
/// POINT_SUM.
pub static POINT_SUM: Command =
    Command { spec: &POINT_SPEC, edits: false, run: |job, call| report(job, call, &[&model_tables::POINTS]) };
/// PIECE_SUM.
pub static PIECE_SUM: Command =
    Command { spec: &PIECE_SPEC, edits: false, run: |job, call| report(job, call, &[&body_tables::PIECES]) };
/// COMPART_SUM.
pub static COMPART_SUM: Command =
    Command { spec: &COMPART_SPEC, edits: false, run: |job, call| report(job, call, &[&compartments::COMPARTMENT]) };
/// CLASS_SUM.
pub static CLASS_SUM: Command =
    Command { spec: &CLASS_SPEC, edits: false, run: |job, call| report(job, call, &[&class_tables::CL_FLEX]) };
/// N_COINCIDENT.
pub static N_COINCIDENT: Command = Command { spec: &COINCIDENT_SPEC, edits: false, run: coincident };
/// GEOM.
pub static GEOM: Command = Command {
    spec: &GEOM_SPEC,
    edits: false,
    run: |job, call| {
        let all: &[&StatusKind] = &[
            &class_tables::CL_FLEX,
            &model_tables::POINTS,
            &body_tables::PIECES,
            &categories::CATEGORY,
            &loads_table::LOADS,
        ];
        report(job, call, all)
    },
};

const MENUS: &[&MenuSpec] = &[&menu::SUMMARY];
const NAMES: &[ValueSpec] =
    &[ValueSpec::new("NAME", Kind::Name(Noun::Selector), "only what fits this name, pattern or selector").or("all")];

static MENU_SPEC: CommandSpec = CommandSpec {
    opens: Opens::Menu(&menu::SUMMARY),
    detail: "CATEG_SUM, LOADG_SUM, POINT_SUM, PIECE_SUM, COMPART_SUM, CLASS_SUM, N_COINCIDENT, GEOM.",
    example: "MEDIT\n&DESCRIBE BODY B\n*CG 0 0 0\n#WEIGHT *CG 100 1 1 1\nEND\n&SUMMARY\nCATEG_SUM\nPOINT_SUM *CG\nEND_&SUMMARY",
    ..CommandSpec::new("&SUMMARY", "summaries of the model, up to END")
};

const fn summary(name: &'static str, help: &'static str, example: &'static str) -> CommandSpec {
    CommandSpec { menus: MENUS, data: NAMES, repeat: 1, example, ..CommandSpec::new(name, help) }
}

static CATEG_SPEC: CommandSpec = summary(
    "CATEG_SUM",
    "weight and point buoyancy of load categories, as &STATUS CATEGORY",
    "&SUMMARY\nCATEG_SUM\nEND",
);
static LOADG_SPEC: CommandSpec = CommandSpec {
    detail: "ATTRIB, which MOSES takes here, may stand: the attributes are always listed.",
    ..summary("LOADG_SUM", "loads of parts and what they come to, as &STATUS LOADS", "&SUMMARY\nLOADG_SUM ATTRIB\nEND")
};
static POINT_SPEC: CommandSpec = summary("POINT_SUM", "points, as &STATUS POINTS", "&SUMMARY\nPOINT_SUM\nEND");
static PIECE_SPEC: CommandSpec = summary("PIECE_SUM", "pieces of hulls, as &STATUS PIECES", "&SUMMARY\nPIECE_SUM\nEND");
static COMPART_SPEC: CommandSpec =
    summary("COMPART_SUM", "compartments, as &STATUS COMPARTMENT", "&SUMMARY\nCOMPART_SUM\nEND");
static CLASS_SPEC: CommandSpec = summary("CLASS_SUM", "classes, as &STATUS CL_FLEX", "&SUMMARY\nCLASS_SUM\nEND");
static COINCIDENT_SPEC: CommandSpec = CommandSpec {
    menus: MENUS,
    data: &[ValueSpec::new("DISTANCE", Kind::Number(Dim::Length), "largest distance")
        .or("a thousandth of a length unit")
        .not_negative()],
    detail: "Pairs of points of one body, or of the ground, that are no farther apart; that distance is our reading.",
    example: "MEDIT\n*A 0 0 0\n*B 0 0 0\nEND\n&SUMMARY\nN_COINCIDENT\nEND",
    ..CommandSpec::new("N_COINCIDENT", "points that coincide")
};
static GEOM_SPEC: CommandSpec =
    CommandSpec { menus: MENUS, example: "&SUMMARY\nGEOM\nEND", ..CommandSpec::new("GEOM", "all geometric summaries") };

fn open(job: &mut Job, _: &Call) -> Outcome<Effect> {
    job.menus.push(Menu::Summary);
    Ok(Effect::Done)
}

/// Prints the tables of some kinds of &STATUS.
fn report(job: &mut Job, call: &Call, kinds: &[&StatusKind]) -> Outcome<Effect> {
    let given = call.args.data.iter().filter(|v| v.word().is_none_or(|word| !word.eq_ignore_ascii_case("ATTRIB")));
    let names = NameFilter::new(given, &job.model);
    let query = Query { job, call, names: &names };
    let mut tables = Vec::new();
    for kind in kinds {
        let mut made = (kind.tables)(&query, &mut Verdict::default())?;
        if kinds.len() == 1 {
            names.check(kind.name, &made, kind.names)?;
        }
        tables.append(&mut made);
    }
    job.say_tables(&tables);
    Ok(Effect::Done)
}

fn coincident(job: &mut Job, call: &Call) -> Outcome<Effect> {
    /// Share of a length unit within which points coincide.
    const NEAR: f64 = 1e-3;
    let usual = Dim::Length.to_si(NEAR, job.units);
    let most = call.args.number(const { COINCIDENT_SPEC.number("DISTANCE") }).unwrap_or(usual);
    let model = &job.model;
    let body = |p: &Point| model.body_of(p).map(|b| Model::key(&b.name));
    let mut placed: Vec<(Vector3<f64>, &Point)> = model.points.values().map(|p| (model.global(p).into(), p)).collect();
    // sorted along x, a point is compared with those that are near there
    placed.sort_by(|(a, _), (b, _)| a.x.total_cmp(&b.x));
    let mut pairs: Vec<(&Point, &Point, f64)> = Vec::new();
    for (index, (at, point)) in placed.iter().enumerate() {
        let behind = placed.get(index + 1..).unwrap_or_default().iter().take_while(|(other, _)| other.x - at.x <= most);
        for (other, second) in behind {
            let apart = (other - at).norm();
            if apart <= most && body(point) == body(second) {
                pairs.push((point, second, apart));
            }
        }
    }
    let table = Table::new("Points that Coincide")
        .with_rows(&pairs)
        .text("Point", |(point, ..)| &point.name)
        .text("Other", |(_, other, _)| &other.name)
        .columns("Global", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(point, ..)| model.global(point))
        .column("", "Distance", Dim::Length, Digits::Decimals(6), |(.., apart)| *apart)
        .build();
    job.say_tables(&[table]);
    Ok(Effect::Done)
}
