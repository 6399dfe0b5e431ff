//! `#HYDROSTATIC`: the buoyancy of a body by a constant stiffness.
//!
//! Source: [AQWA-REF deck 7] (LSTF, BFEQ, ZCGE). The record is ours.

use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use nalgebra::{Matrix6, RowVector6};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::ValueKey;
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{LinearHydrostatics, Model, find};

/// #HYDROSTATIC.
pub static HYDROSTATIC: Command = Command { spec: &SPEC, edits: false, run };

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}
/// A row of the stiffness: of a force, or of a moment. A rotation is in radians.
const FORCE_ROW: &[ValueSpec] = &[
    number("X", Dim::ForcePerLength, "by x"),
    number("Y", Dim::ForcePerLength, "by y"),
    number("Z", Dim::ForcePerLength, "by z"),
    number("RX", Dim::Force, "by roll, per radian"),
    number("RY", Dim::Force, "by pitch, per radian"),
    number("RZ", Dim::Force, "by yaw, per radian"),
];
const MOMENT_ROW: &[ValueSpec] = &[
    number("X", Dim::Force, "by x"),
    number("Y", Dim::Force, "by y"),
    number("Z", Dim::Force, "by z"),
    number("RX", Dim::MomentPerRadian, "by roll"),
    number("RY", Dim::MomentPerRadian, "by pitch"),
    number("RZ", Dim::MomentPerRadian, "by yaw"),
];
const ROWS: [OptionSpec; 6] = [KX, KY, KZ, KRX, KRY, KRZ];

const BUOYANCY: OptionSpec = OptionSpec::ours(
    "-BUOYANCY",
    &[number("B", Dim::Force, "upward force").not_negative()],
    "buoyancy when the body floats at rest: BFEQ",
);
const ZCGE: OptionSpec = OptionSpec::ours(
    "-ZCGE",
    &[number("Z", Dim::Length, "height in the global system")],
    "height of the point when the body floats at rest",
);
const KX: OptionSpec = OptionSpec::ours("-KX", FORCE_ROW, "row of the force in x");
const KY: OptionSpec = OptionSpec::ours("-KY", FORCE_ROW, "row of the force in y");
const KZ: OptionSpec = OptionSpec::ours("-KZ", FORCE_ROW, "row of the force in z");
const KRX: OptionSpec = OptionSpec::ours("-KRX", MOMENT_ROW, "row of the roll moment");
const KRY: OptionSpec = OptionSpec::ours("-KRY", MOMENT_ROW, "row of the pitch moment");
const KRZ: OptionSpec = OptionSpec::ours("-KRZ", MOMENT_ROW, "row of the yaw moment");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[
        ValueSpec::new("*PT", Kind::Name(Noun::Point), "the point it is about: the centre of gravity"),
        number("K33", Dim::ForcePerLength, "stiffness of heave").or("0, or as -KZ"),
        number("K44", Dim::MomentPerRadian, "stiffness of roll").or("0, or as -KRX"),
        number("K55", Dim::MomentPerRadian, "stiffness of pitch").or("0, or as -KRY"),
    ],
    options: &[BUOYANCY, ZCGE, KX, KY, KZ, KRX, KRY, KRZ],
    detail: "The linear hydrostatics of an AQWA deck (LSTF, BFEQ, ZCGE) instead of a hull: F = K (Xe - X) + B at the point, where X are its place \
             and the roll, pitch and yaw, Xe is (0, 0, ZCGE) upright without yaw, and B acts upward. K stands in axes that turn with the \
             yaw of the body. -BUOYANCY and -ZCGE must be there. For a body in balance B is its weight less what else bears it. The three \
             numbers are the diagonal of a body with no more; the rows give all 36. One record a body: a second one replaces it.",
    example: "MEDIT\n&DESCRIBE BODY TOWED\n*CG 30 0 0.5\n#WEIGHT *CG 650\n#HYDROSTATIC *CG 70 1200 60000 -BUOYANCY 650 -ZCGE -0.5\nEND\n\
              &STATUS HYDROSTATICS",
    ..CommandSpec::new("#HYDROSTATIC", "buoyancy of a body by a linear stiffness")
};

/// The values of a row; all rows name theirs alike.
const ROW: [ValueKey<f64>; 6] = KX.numbers(["X", "Y", "Z", "RX", "RY", "RZ"]);
const POINT: DatumKey<str> = SPEC.word("*PT");
/// What of the diagonal stands among the data, by rows.
const DIAGONAL: [Option<DatumKey<f64>>; 6] =
    [None, None, Some(SPEC.number("K33")), Some(SPEC.number("K44")), Some(SPEC.number("K55")), None];

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let model = &job.model;
    let point = find(&model.points, args.word(POINT).unwrap_or_default(), "point", args.position(POINT))?;
    let body = model.body_of(point).ok_or_else(|| {
        Diagnostic::error(
            format!("{} is a point of the ground, which does not float", point.name),
            args.position(POINT),
        )
        .other(point.span, "defined here")
    })?;
    let lacking = [BUOYANCY, ZCGE].into_iter().find(|option| !args.has(option));
    if let Some(option) = lacking {
        return Err(Diagnostic::error(format!("#HYDROSTATIC lacks {}", option.name), args.span)
            .help("form: #HYDROSTATIC *PT K33 K44 K55 -BUOYANCY B -ZCGE Z"));
    }
    let mut stiffness = Matrix6::zeros();
    for (n, (row, key)) in ROWS.into_iter().zip(DIAGONAL).enumerate() {
        let single = key.and_then(|key| args.number(key));
        match (args.option(&row), single) {
            (Some(given), Some(_)) => {
                return Err(Diagnostic::error(format!("{} is given twice", row.name), given.span)
                    .other(key.map_or(args.span, |key| args.position(key)), "first given here"));
            }
            (Some(given), None) => stiffness.set_row(n, &RowVector6::from(given.numbers_or_zero(ROW))),
            (None, single) => stiffness[(n, n)] = single.unwrap_or(0.0),
        }
    }
    let part = model.parts.get(&Model::key(&point.part));
    let made = LinearHydrostatics {
        at: part.map_or(point.at, |p| p.position.apply(point.at)),
        height: args.option_number(&ZCGE).unwrap_or_default(),
        buoyancy: args.option_number(&BUOYANCY).unwrap_or_default(),
        stiffness,
        span: args.span,
    };
    let (key, name) = (Model::key(&body.name), body.name.clone());
    let old = job.model.bodies.get_mut(&key).and_then(|b| b.linear.replace(made));
    if old.is_some() {
        job.remark(format!("the linear hydrostatics of {name} are replaced"), args.span);
    }
    Ok(Effect::Done)
}
