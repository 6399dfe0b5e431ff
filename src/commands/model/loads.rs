//! `#AREA`, `#PLATE`, `#TABLE`, `#DRIFT`: loads of wind, current and waves on a part; `#DRAG`, `#DAMP`, `#AMASS`: its matrices; `#TANAKA`, `#ROLL_DAMPING`; `#LUMP`, `#FORCE`.
//!
//! Source: [MOSES-HELP lgroup]; `#AREA *PT AX AY AZ` as in [MOSES-RUNS sea_keep/cargo]. The
//! order of the values of the others is ours: no source gives it.

use crate::commands::files::number_rows::rows;
use crate::commands::menu;
use crate::commands::model::weight::{self, CATEGORY};
use crate::commands::model_values::option_as_written;
use crate::commands::{Call, Command, Effect, Job};
use nalgebra::{Matrix6, Vector3};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::{Position, unit_vector};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::units::eight_figures;
use windlass_base::values::Noun;
use windlass_base::values::{Args, Given};
use windlass_hydro::heading::ByHeading;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, MenuSpec, OptionEffect, OptionSpec, ValueSpec};
use windlass_model::{Fluid, GROUND, LoadKind, Lump, Model, PartLoad, RollDamping, SolveKind, UnmodelledEffect, find};

/// #AREA.
pub static AREA: Command = Command { spec: &AREA_SPEC, edits: false, run: area };
/// #PLATE.
pub static PLATE: Command = Command { spec: &PLATE_SPEC, edits: false, run: plate };
/// #TABLE.
pub static TABLE: Command = Command { spec: &TABLE_SPEC, edits: false, run: table };
/// #DRIFT.
pub static DRIFT: Command = Command { spec: &DRIFT_SPEC, edits: false, run: drift };
/// #DRAG.
pub static DRAG: Command =
    Command { spec: &DRAG_SPEC, edits: false, run: |job, call| matrix(job, call, LoadKind::Drag) };
/// #DAMP.
pub static DAMP: Command =
    Command { spec: &DAMP_SPEC, edits: false, run: |job, call| matrix(job, call, LoadKind::Damping) };
/// #AMASS.
pub static AMASS: Command = Command { spec: &AMASS_SPEC, edits: false, run: added_mass };

/// #TANAKA.
pub static TANAKA: Command = Command { spec: &TANAKA_SPEC, edits: false, run: tanaka };
/// #ROLL_DAMPING.
pub static ROLL_DAMPING: Command = Command { spec: &ROLL_DAMPING_SPEC, edits: false, run: roll_damping };
/// #TANKER.
pub static TANKER: Command = Command { spec: &TANKER_SPEC, edits: true, run: tanker };
/// #LUMP.
pub static LUMP: Command = Command { spec: &LUMP_SPEC, edits: false, run: lump };
/// #FORCE.
pub static FORCE: Command = Command { spec: &FORCE_SPEC, edits: false, run: force };
/// #BUOY.
pub static BUOY: Command = Command { spec: &BUOY_SPEC, edits: false, run: buoy };

const MENUS: &[&MenuSpec] = &[&menu::INMODEL, &menu::MEDIT];
const POINT: ValueSpec = ValueSpec::new("*PT", Kind::Name(Noun::Point), "a point of the part");
choices! {
    /// What moves past a point.
    enum FluidChoice {
        Air = "AIR",
        Water = "WATER",
    }
}

const FLUID: OptionSpec = OptionSpec::new(
    "-FLUID",
    &[ValueSpec::choice::<FluidChoice>("FLUID", "AIR or WATER")],
    "wind or current, whatever the height of the point",
)
.default("the global height of the point decides")
.owner(Owner::Ours);
const SYMMETRIC: OptionSpec =
    OptionSpec::new("-SYMMETRIC", &[], "headings 0 to 180 only; the other side mirrors them").owner(Owner::Ours);

const fn derived_dimension(force: i8, length: i8, seconds: i8) -> Dim {
    Dim::Derived { force, length, seconds }
}
const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}
/// Force and moment per unit of the given dimensions.
const fn six(force: Dim, moment: Dim) -> [ValueSpec; 6] {
    [
        number("FX", force, "surge"),
        number("FY", force, "sway"),
        number("FZ", force, "heave"),
        number("MX", moment, "roll"),
        number("MY", moment, "pitch"),
        number("MZ", moment, "yaw"),
    ]
}
/// An area times the third power of a length.
const FIFTH_POWER: Dim = derived_dimension(0, 5, 0);
/// The names of the six.
const SIX_NAMES: [&str; 6] = ["FX", "FY", "FZ", "MX", "MY", "MZ"];
const STREAM: [ValueSpec; 6] = six(derived_dimension(1, -2, 2), derived_dimension(1, -1, 2));
const WAVE: [ValueSpec; 6] = six(derived_dimension(1, -2, 0), derived_dimension(1, -1, 0));
const ENTRIES: [&str; 36] = [
    "M11", "M12", "M13", "M14", "M15", "M16", "M21", "M22", "M23", "M24", "M25", "M26", "M31", "M32", "M33", "M34",
    "M35", "M36", "M41", "M42", "M43", "M44", "M45", "M46", "M51", "M52", "M53", "M54", "M55", "M56", "M61", "M62",
    "M63", "M64", "M65", "M66",
];
/// A 6x6 matrix row by row; a moment has one length more, and so has a rotation.
const fn whole(seconds: i8) -> [ValueSpec; 36] {
    let mut made = [number("M", Dim::None, "entry of the matrix"); 36];
    let mut at = 0;
    while at < 36 {
        let lengths = (at / 6 / 3 + at % 6 / 3) as i8;
        let base = if seconds == 0 { 0 } else { -1 };
        made[at] =
            number(ENTRIES[at], derived_dimension(1, lengths + base, seconds), "entry of the matrix, row by row");
        at += 1;
    }
    made
}
const fn diagonal(seconds: i8) -> [ValueSpec; 7] {
    let base = if seconds == 0 { 0 } else { -1 };
    let (force, moment) = (derived_dimension(1, base, seconds), derived_dimension(1, base + 2, seconds));
    [
        POINT,
        number("X", force, "surge").or("0").not_negative(),
        number("Y", force, "sway").or("0").not_negative(),
        number("Z", force, "heave").or("0").not_negative(),
        number("RX", moment, "roll").or("0").not_negative(),
        number("RY", moment, "pitch").or("0").not_negative(),
        number("RZ", moment, "yaw").or("0").not_negative(),
    ]
}
const OF_RATE: &[ValueSpec] = &diagonal(1);
const OF_WEIGHT: &[ValueSpec] = &diagonal(0);
const FULL_RATE: OptionSpec =
    OptionSpec::new("-MATRIX", &whole(1), "the whole matrix, row by row, instead of its diagonal").owner(Owner::Ours);
const FULL_WEIGHT: OptionSpec =
    OptionSpec::new("-MATRIX", &whole(0), "the whole matrix, row by row, instead of its diagonal").owner(Owner::Ours);

const SHAPE_COEFFICIENT: [ValueSpec; 1] = [number("C", Dim::None, "coefficient").not_negative()];
const WIND_COEFFICIENT: OptionSpec =
    OptionSpec::new("-WIND", &SHAPE_COEFFICIENT, "shape coefficient in wind (our reading)").default("1");
const DRAG_COEFFICIENT: OptionSpec =
    OptionSpec::new("-DRAG", &SHAPE_COEFFICIENT, "drag coefficient in current (our reading)").default("1");
const ADDED_MASS_COEFFICIENT: OptionSpec =
    OptionSpec::new("-AMASS", &SHAPE_COEFFICIENT, "coefficient of added mass; #AMASS gives the mass itself")
        .stops(SolveKind::Motions, "added mass of an area");
const EDDY_FACTOR: OptionSpec =
    OptionSpec::new("-TANAKA", &SHAPE_COEFFICIENT, "eddy damping of an area; #TANAKA gives that of the hull")
        .stops(SolveKind::Motions, "eddy damping of an area");
const NORMAL_MULTIPLIER: OptionSpec = OptionSpec::new(
    "-MULT_N",
    &[number("N", Dim::None, "a multiplier")],
    "a multiplier whose meaning no source gives; multiply the areas instead",
)
.stops(SolveKind::Statics, "a multiplier of an area");
/// Coefficients in air and in water.
const SHAPE_COEFFICIENTS: [OptionSpec; 2] = [WIND_COEFFICIENT, DRAG_COEFFICIENT];
/// What areas and plates take of which no solver computes the effect.
const NOT_COMPUTED: [OptionSpec; 3] = [ADDED_MASS_COEFFICIENT, EDDY_FACTOR, NORMAL_MULTIPLIER];

static AREA_SPEC: CommandSpec = CommandSpec {
    menus: MENUS,
    data: &[
        POINT,
        number("AX", Dim::Area, "area times shape coefficient along x").not_negative(),
        number("AY", Dim::Area, "along y").or("0").not_negative(),
        number("AZ", Dim::Area, "along z").or("0").not_negative(),
    ],
    options: &[
        FLUID,
        CATEGORY,
        WIND_COEFFICIENT,
        DRAG_COEFFICIENT,
        ADDED_MASS_COEFFICIENT,
        EDDY_FACTOR,
        NORMAL_MULTIPLIER,
    ],
    detail: "The force along each axis of the part is 1/2 rho A |w| w, with w the component and |w| the speed of the stream in \
             these axes, on the point, times -WIND in air and -DRAG in water. Above the water it is wind, below it current, by the global height of the point, with a \
             passage of 0.5 m about the surface in which both act in part (our reading: a jump would hide equilibria).",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*CAR 90 0 40\n#AREA *CAR 50*20 80*20\nEND\n&ENV -WIND 60 180\n&STATUS LOADS",
    ..CommandSpec::new("#AREA", "area in wind or current")
};

const CD: OptionSpec =
    OptionSpec::new("-CD", &[number("CD", Dim::None, "drag coefficient").not_negative()], "drag coefficient")
        .default("1")
        .owner(Owner::Ours);

static PLATE_SPEC: CommandSpec = CommandSpec {
    menus: MENUS,
    data: &[POINT, POINT, POINT, ValueSpec { name: "*PT", help: "a further corner", ..POINT }.or("none")],
    repeat: 1,
    options: &[
        CD,
        FLUID,
        CATEGORY,
        WIND_COEFFICIENT.default("CD"),
        DRAG_COEFFICIENT.default("CD"),
        ADDED_MASS_COEFFICIENT,
        EDDY_FACTOR,
        NORMAL_MULTIPLIER,
    ],
    detail: "Corners in order round the plate, at least three, not on one line. The drag 1/2 rho CD A |w.n| (w.n) is along the \
             normal alone, on the centre of the area; the sense of the normal does not matter. Wind or current as with #AREA, by \
             the height of the centre.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*A 0 -50 20\n*B 0 50 20\n*C 0 50 60\n*D 0 -50 60\n#PLATE *A *B *C *D -CD 1.2\nEND\n\
              &ENV -WIND 60 150\n&STATUS LOADS",
    ..CommandSpec::new("#PLATE", "flat plate in wind or current")
};

static TABLE_SPEC: CommandSpec = CommandSpec {
    menus: MENUS,
    data: &[
        POINT,
        number("HEADING", Dim::Angle, "direction the stream comes from; grows"),
        STREAM[0],
        STREAM[1],
        STREAM[2],
        STREAM[3],
        STREAM[4],
        STREAM[5],
    ],
    repeat: 7,
    options: &[SYMMETRIC, FLUID, CATEGORY],
    detail: "Groups of a heading and six coefficients: force and moment about the point, in the axes of the part, over the \
             square of the speed, which is in ft/s or m/s for wind too. The heading is the direction the stream comes from, \
             from x toward y of the part: 180 is a stream from ahead for a vessel with x aft, and pushes with a positive FX; a force \
             against the stream is noted. Between headings the values are \
             cubic and smooth all round. Wind or current as with #AREA: a table whose point is above the water has no current.",
    example: "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY TBRG\n*MID 60 0 -3\n\
              #TABLE *MID 0 -90 0 0 0 0 0 90 0 -900 0 0 0 0 180 90 0 0 0 0 0 -SYMMETRIC\nEND\n&ENV -CURRENT 1 150\n&STATUS LOADS",
    ..CommandSpec::new("#TABLE", "wind or current coefficients by heading")
};

static DRIFT_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: MENUS,
    data: &[
        POINT,
        number("HEADING", Dim::Angle, "direction the waves come from"),
        number("PERIOD", Dim::Time, "period; grows").positive(),
        WAVE[0],
        WAVE[1],
        WAVE[2],
        WAVE[3],
        WAVE[4],
        WAVE[5],
    ],
    repeat: 7,
    options: &[SYMMETRIC, CATEGORY],
    detail: "One record a heading: groups of a period and six mean forces and moments about the point, in the axes of the part, \
             over the square of the wave amplitude, as MOSES reports mean drift forces. Records of one point make one table, of at \
             least two headings. The mean in a sea is twice the sum of its energies S dw times the coefficient, in a regular wave \
             the coefficient times the square of the amplitude. Coefficients are straight over frequency and constant beyond the \
             first and last period, cubic and smooth over heading; spreading is not regarded in equilibrium. In the time domain \
             the waves make slow drift of it by Newman's approximation, each wave with the coefficient of its own direction; its mean \
             is the mean drift, and all there is in a regular wave. With a DATABASE that has drift of its own it is an error.",
    example: "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY TBRG\n*MID 60 0 0\n#DRIFT *MID 0 6 -40 0 0 0 0 0 14 -5 0 0 0 0 0 -SYMM\n\
              #DRIFT *MID 180 6 40 0 0 0 0 0 14 5 0 0 0 0 0 -SYMM\nEND\n&ENV -SEA ISSC 170 4 9\n&STATUS LOADS",
    ..CommandSpec::new("#DRIFT", "mean wave drift by period and heading")
};

static DRAG_SPEC: CommandSpec = CommandSpec {
    menus: MENUS,
    data: OF_RATE,
    options: &[FULL_RATE, CATEGORY],
    detail: "Linear drag of the water at a point: force over velocity, moment over rate, in the axes of the part. In statics the \
             current at the depth of the point acts through it, above the water that of the surface. Forces, never masses.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*CG 200 0 8\n#DRAG *CG 50 400\nEND\n&ENV -CURRENT 3 150\n&STATUS LOADS",
    ..CommandSpec::new("#DRAG", "linear drag matrix at a point")
};

static DAMP_SPEC: CommandSpec = CommandSpec {
    menus: MENUS,
    data: OF_RATE,
    options: &[FULL_RATE, CATEGORY],
    detail: "Linear damping of the part's own motion: force over velocity, moment over rate, in the axes of the part. No current \
             acts through it (our reading; #DRAG is for that).",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*CG 200 0 8\n#DAMP *CG 50 400 900\nEND\n&STATUS LOADS",
    ..CommandSpec::new("#DAMP", "linear damping matrix at a point")
};

static AMASS_SPEC: CommandSpec = CommandSpec {
    menus: MENUS,
    data: OF_WEIGHT,
    options: &[FULL_WEIGHT, CATEGORY],
    detail: "Added mass as a weight (never a mass): X Y Z in force, RX RY RZ in force times length squared, about the point and in \
             the axes of the part; divided by gravity when computed.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*CG 200 0 8\n#AMASS *CG 4E3 2E4 6E4 5E7 6E8 5E8\nEND\n&STATUS LOADS",
    ..CommandSpec::new("#AMASS", "added mass at a point")
};

static TANAKA_SPEC: CommandSpec = CommandSpec {
    menus: MENUS,
    data: &[number("F", Dim::None, "factor").not_negative()],
    options: &[CATEGORY],
    detail: "Eddy damping of the roll of the part described last: a moment F b |p| p against the rate of roll p, with b that of a sharp-cornered barge \
             [IKEDA-1993] of the box around the pieces of the part, at the draft and the center of gravity of the place where a run begins. It acts in TDOM and, \
             linearised in the sea, in SRESPONSE; in RAO, which has no amplitude, not. Round bilges have less: F is 1 for sharp corners. -TANAKA of a \
             piece is the same of the box around that piece. Our reading: MOSES names Tanaka's formula.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\nPGEN\nPLANE 0 400 -RECT 0 20 100\nEND\n#TANAKA 1\nEND\n&STATUS LOADS",
    ..CommandSpec::new("#TANAKA", "eddy damping of roll")
};

const LINEAR_ROLL: OptionSpec = OptionSpec::ours(
    "-LINEAR",
    &[number("B", derived_dimension(1, 1, 1), "moment over the rate of roll").not_negative()],
    "linear damping",
);
const QUADRATIC_ROLL: OptionSpec = OptionSpec::ours(
    "-QUADRATIC",
    &[number("B", derived_dimension(1, 1, 2), "moment over the square of the rate of roll").not_negative()],
    "quadratic damping",
);
const CRITICAL_ROLL: OptionSpec = OptionSpec::ours(
    "-CRITICAL",
    &[number("PERCENT", Dim::None, "per cent of the critical damping").in_range(0.0, 100.0)],
    "linear damping as a share of the critical one",
);

static ROLL_DAMPING_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: MENUS,
    options: &[LINEAR_ROLL, QUADRATIC_ROLL, CRITICAL_ROLL, CATEGORY],
    detail: "Damping of the roll of the body about the x axis of the part described last: a moment B p against the rate of roll p, B |p| p, or both. -CRITICAL p is \
             linear with B = 2 p/100 sqrt((I + A) C): I the moment of inertia and A the added mass at the natural period of roll, of the database and of #AMASS, C the \
             hydrostatic stiffness of the body alone, all about its center of gravity, where a run begins; moorings and the coupling to sway are left out. Linear damping acts in TDOM and the \
             frequency domain; quadratic in TDOM and, linearised in the sea, in SRESPONSE, not in RAO.",
    example: "&DIMEN -DIMEN METERS KN\nMEDIT\n&DESCRIBE BODY B\n*G 0 0 0\n#WEIGHT *G 19293 4 11 11\nPGEN\nPLANE -20 20 -RECT -4 2 12\nEND\n\
              #ROLL_DAMPING -CRITICAL 5 -QUADRATIC 1E5\nEND\n&STATUS LOADS",
    ..CommandSpec::new("#ROLL_DAMPING", "damping of roll: linear, quadratic, per cent of critical")
};

const COEFFICIENT_FILE: OptionSpec = OptionSpec::ours(
    "-FILE",
    &[ValueSpec::new("FILE", Kind::File, "coefficients by heading; looked for where it says, then beside the script")],
    "the coefficients",
);
const LBP: OptionSpec =
    OptionSpec::ours("-LBP", &[number("L", Dim::Length, "length").positive()], "length between perpendiculars");
const TANKER_DRAFT: OptionSpec = OptionSpec::ours(
    "-DRAFT",
    &[number("T", Dim::Length, "draft").positive()],
    "draft that the coefficients of current are for",
);
const WIND_AREAS: OptionSpec = OptionSpec::ours(
    "-WIND_AREAS",
    &[
        number("AT", Dim::Area, "transverse area, seen from ahead").positive(),
        number("AL", Dim::Area, "longitudinal area, seen from the side").positive(),
    ],
    "areas that the coefficients of wind are for",
);
/// The form of `#TANKER` that acts.
const TANKER_FORM: &str = "form: #TANKER SIZE *PT -FILE FILE -LBP L -DRAFT T -WIND_AREAS AT AL";
/// What a row of the file of `#TANKER` is.
const TANKER_ROW: &str = "HEADING CXW CYW CNW CXC CYC CNC, separated by commas: degrees that grow, three coefficients of wind, three of current";
/// Most headings of a file.
const MAX_HEADINGS: usize = 361;

static TANKER_SPEC: CommandSpec = CommandSpec {
    menus: MENUS,
    data: &[
        number("SIZE", Dim::None, "deadweight in thousands of tons, as MOSES has it: listed alone").positive(),
        ValueSpec::new("*PT", Kind::Name(Noun::Point), "the point the moments are about: midship")
            .or("none, where there is no -FILE"),
    ],
    options: &[COEFFICIENT_FILE, LBP, TANKER_DRAFT, WIND_AREAS, SYMMETRIC, CATEGORY],
    detail: "Wind and current on a tanker by coefficients of your own, as [OCIMF-1994] defines them: wind FX = 1/2 rho CXW V^2 AT, FY = 1/2 rho CYW V^2 AL, \
             MZ = 1/2 rho CNW V^2 AL LBP; current FX = 1/2 rho CXC V^2 LBP T, FY likewise with CYC, MZ = 1/2 rho CNC V^2 LBP^2 T. windlass ships no \
             coefficients: OCIMF's are not free. The file has a row a heading: HEADING, CXW, CYW, CNW, CXC, CYC, CNC, separated by commas, after a line of heads or none. \
             Headings are directions the stream comes from and forces are in the axes of the part, as in #TABLE: with x aft 180 is a stream from ahead, and \
             CXW is positive there. Coefficients of MOSES by SIZE alone are not in windlass: without -FILE the next solve stops.",
    example: "&FILE OPEN C tanker.csv\n&FILE WRITE C 0,-0.9,0,0,-0.04,0,0\n&FILE WRITE C 90,0,-0.7,0.05,0,-0.6,0.02\n&FILE WRITE C 180,0.9,0,0,0.04,0,0\n&FILE CLOSE C\n\
              MEDIT\n&DESCRIBE BODY TANKER\n*MID 450 0 0\n#TANKER 150 *MID -FILE job.ans/tanker.csv -LBP 900 -DRAFT 50 -WIND_AREAS 13000 38000 -SYMMETRIC\nEND\n\
              &ENV -WIND 60 90 -CURRENT 2 180\n&STATUS LOADS",
    ..CommandSpec::new(
        "#TANKER",
        "wind and current on a tanker by coefficients of a file; without one the next solve stops",
    )
};

static BUOY_SPEC: CommandSpec = CommandSpec {
    menus: MENUS,
    data: &[
        POINT,
        number("B", Dim::Force, "buoyancy when it is all under water"),
        number("DX", Dim::Length, "length along x").or("0").not_negative(),
        number("DY", Dim::Length, "length along y").or("0").not_negative(),
        number("DZ", Dim::Length, "height").or("0").not_negative(),
    ],
    options: &[CATEGORY],
    detail: "A force upward at the point, in proportion to what is under water of a height DZ about the point, measured along the vertical; without DZ all of it \
             below the surface and none above. DX and DY are listed and change nothing. The reading is ours. &APPLY multiplies it by #BUOY.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*F 200 0 8\n#BUOY *F 50 0 0 4 -CATEGORY FLOATS\nEND\n&APPLY -PERCENT -CATEGORY @ #BUOY 105\n&STATUS LOADS",
    ..CommandSpec::new("#BUOY", "buoyancy at a point")
};

const LUMP_DRAG: OptionSpec = OptionSpec::ours(
    "-DRAG",
    &[
        number("AX", Dim::Area, "drag coefficient times area along x").not_negative(),
        number("AY", Dim::Area, "along y").not_negative().or("AX"),
        number("AZ", Dim::Area, "along z").not_negative().or("AX"),
    ],
    "drag of the water that moves past it",
)
.default("none");
const LUMP_ROTARY_DRAG: OptionSpec = OptionSpec::ours(
    "-R_DRAG",
    &[
        number("RX", FIFTH_POWER, "about x").not_negative(),
        number("RY", FIFTH_POWER, "about y").not_negative(),
        number("RZ", FIFTH_POWER, "about z").not_negative(),
    ],
    "drag against turning, over half the density and the square of the rate",
)
.default("none");
const LUMP_ADDED_MASS: OptionSpec = OptionSpec::ours(
    "-AMASS",
    &[
        number("CX", Dim::None, "coefficient along x, on the mass of water of the volume").not_negative(),
        number("CY", Dim::None, "along y").not_negative().or("CX"),
        number("CZ", Dim::None, "along z").not_negative().or("CX"),
    ],
    "added mass",
)
.default("none");
const LUMP_CONSTANT: OptionSpec =
    OptionSpec::ours("-CONSTANT", &[], "all of it acts wherever the point is").default("the share that is under water");
/// `-NO_WAVE_INERTIA`, of JUNCTION too.
pub(super) const NO_WAVE_INERTIA: OptionSpec = OptionSpec::ours(
    "-NO_WAVE_INERTIA",
    &[],
    "waves act by drag alone: the acceleration of the water does nothing, as at points and bodies of MoorDyn",
)
.default("it acts");

static LUMP_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: MENUS,
    data: &[POINT, number("V", Dim::Volume, "volume; its mass is that of #WEIGHT").not_negative()],
    options: &[LUMP_DRAG, LUMP_ROTARY_DRAG, LUMP_ADDED_MASS, LUMP_CONSTANT, NO_WAVE_INERTIA, CATEGORY],
    detail: "A small body, as a buoy or a clump, by Morison's formula at one point: buoyancy rho g V, drag 1/2 rho A |w| w along each axis of the part with w the \
             water past the point, 1/2 rho R |p| p against the rate p of turning about each axis, added mass rho C V, and in waves rho V (1 + C) times the \
             acceleration of the water. What acts is the share of a sphere of the volume that is under the mean level; with -CONSTANT always all of it, as of \
             bodies of constant volume in MoorDyn. The added mass is always whole. In waves it acts in TDOM alone.",
    example: "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY BUOY\n*CG 0 0 -10\n#WEIGHT *CG 30 1 1 1\n#LUMP *CG 5 -DRAG 2 -AMASS 0.5\nEND\n&STATUS LOADS",
    ..CommandSpec::new("#LUMP", "small body in the water, at a point")
};

static FORCE_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: MENUS,
    data: &[
        POINT,
        number("FX", Dim::Force, "along global x"),
        number("FY", Dim::Force, "along global y").or("0"),
        number("FZ", Dim::Force, "upward").or("0"),
    ],
    options: &[CATEGORY],
    detail: "A force that neither time nor the motion of the body changes, on the global axes; its point moves and turns with the body. It has no \
             mass. In runs it acts from the first instant, in category APPLIED. Of &APPLY the multipliers of load groups act on it.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*TOW 0 0 4\n#FORCE *TOW -50\nEND\n&STATUS LOADS",
    ..CommandSpec::new("#FORCE", "constant force at a point")
};

/// The first datum of every load.
const PLACE: DatumKey<str> = AREA_SPEC.word("*PT");

/// Where a record's point stands in the part being described, and that part.
fn position(job: &Job, args: &Args) -> Outcome<(String, Position)> {
    let (name, span) = (args.word(PLACE).unwrap_or_default(), args.position(PLACE));
    place_of_point(job, args, name, span)
}

/// Where a point stands in the part being described, and that part.
fn place_of_point(job: &Job, args: &Args, name: &str, span: Span) -> Outcome<(String, Position)> {
    let point = find(&job.model.points, name, "point", span)?;
    let Some(part) = job.model.current_part.clone().filter(|p| Model::key(p) != GROUND) else {
        return Err(Diagnostic::error("a load belongs to a part, and none is described yet", args.span)
            .help("&DESCRIBE BODY describes one"));
    };
    if Model::key(&point.part) != Model::key(&part) {
        let text = format!("{} belongs to {}, and the load to {part}", point.name, point.part);
        return Err(Diagnostic::error(text, span)
            .other(point.span, "defined here")
            .help(format!("&DESCRIBE PART {} goes on with the other part", point.part)));
    }
    Ok((part, point.at))
}

fn keep(job: &mut Job, args: &Args, (part, at): (String, Position), kind: LoadKind) -> Outcome<Effect> {
    let given = args.option_if_declared(&FLUID);
    let fluid = match given.and_then(|given| given.choice(const { FLUID.choice("FLUID") })) {
        Some(FluidChoice::Air) => Fluid::Air,
        Some(FluidChoice::Water) => Fluid::Water,
        None => Fluid::ByHeight,
    };
    let record = kind.name();
    for given in args.options.iter().filter(|given| given.is_any(&NOT_COMPUTED)) {
        if let (OptionEffect::Stops(matters_to, effect), true) =
            (given.option.effect, given.first_number().is_some_and(|value| value != neutral(given)))
        {
            let (record, effect) = (format!("{} of {record}", option_as_written(given, job.units)), effect.to_string());
            let kept = UnmodelledEffect { record, effect, matters_to, span: given.span };
            job.remark(format!("not computed: {}; solves it matters to will stop", kept.sentence()), given.span);
            job.model.keep_unmodelled(kept);
        }
    }
    let category = weight::category_of(args);
    let point = args.data.iter().find_map(|value| value.word()).unwrap_or_default();
    let group = weight::group_for(&job.model, point, args.span)?;
    let usual = match kind {
        LoadKind::Plate { .. } if has_shape_coefficients(args) => plate_drag(job, args),
        _ => 1.0,
    };
    // -DRAG of #LUMP is its areas
    let is_shape = matches!(kind, LoadKind::Area(_) | LoadKind::Plate { .. });
    let given = |option: &OptionSpec| args.number_if_declared(option).filter(|_| is_shape);
    let shape_coefficients = SHAPE_COEFFICIENTS.map(|option| given(&option).unwrap_or(usual));
    job.model.loads.push(PartLoad { part, at, fluid, kind, shape_coefficients, category, group, span: args.span });
    Ok(Effect::Done)
}

/// The value of an option that changes nothing.
fn neutral(given: &Given) -> f64 {
    if given.is(&NORMAL_MULTIPLIER) { 1.0 } else { 0.0 }
}

/// Whether a record gives the coefficient of an area in air or in water.
fn has_shape_coefficients(args: &Args) -> bool {
    SHAPE_COEFFICIENTS.iter().any(|option| args.option_if_declared(option).is_some())
}

/// The drag coefficient of a plate in every stream for which its record gives none.
fn plate_drag(job: &Job, args: &Args) -> f64 {
    args.option_number(&CD).or(job.model.parameters.plate_drag).unwrap_or(1.0)
}

fn buoy(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let force = args.number(const { BUOY_SPEC.number("B") }).unwrap_or_default();
    let size = args.numbers_or_zero(const { BUOY_SPEC.numbers(["DX", "DY", "DZ"]) });
    keep(job, args, position(job, args)?, LoadKind::Buoyancy { force, size })
}

fn lump(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let volume = args.number(const { LUMP_SPEC.number("V") }).unwrap_or_default();
    let drag_areas = args.option(&LUMP_DRAG).map_or([0.0; 3], |given| {
        first_for_absent(const { LUMP_DRAG.numbers(["AX", "AY", "AZ"]) }.map(|key| given.number(key)))
    });
    let added = args.option(&LUMP_ADDED_MASS).map_or([0.0; 3], |given| {
        first_for_absent(const { LUMP_ADDED_MASS.numbers(["CX", "CY", "CZ"]) }.map(|key| given.number(key)))
    });
    let rotary_drag = args
        .option(&LUMP_ROTARY_DRAG)
        .map_or([0.0; 3], |given| given.numbers_or_zero(const { LUMP_ROTARY_DRAG.numbers(["RX", "RY", "RZ"]) }));
    let is_constant = args.has(&LUMP_CONSTANT);
    let lump = Lump {
        volume,
        is_buoyant: true,
        is_constant,
        drag_areas,
        rotary_drag,
        added,
        ignores_water_acceleration: args.has(&NO_WAVE_INERTIA),
    };
    keep(job, args, position(job, args)?, LoadKind::Lump(lump))
}

/// Three values, the later ones the first where they are absent.
fn first_for_absent([x, y, z]: [Option<f64>; 3]) -> [f64; 3] {
    let first = x.unwrap_or(0.0);
    [first, y.unwrap_or(first), z.unwrap_or(first)]
}

fn force(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let components = args.numbers_or_zero(const { FORCE_SPEC.numbers(["FX", "FY", "FZ"]) });
    keep(job, args, position(job, args)?, LoadKind::Force(components))
}

fn tanaka(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let Some(part) = job.model.current_part.clone().filter(|p| Model::key(p) != GROUND) else {
        return Err(Diagnostic::error("a load belongs to a part, and none is described yet", args.span)
            .help("&DESCRIBE BODY describes one"));
    };
    let factor = args.number(const { TANAKA_SPEC.number("F") }).unwrap_or_default();
    keep(job, args, (part, [0.0; 3]), LoadKind::EddyDamping(factor))
}

fn roll_damping(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let Some(part) = job.model.current_part.clone().filter(|p| Model::key(p) != GROUND) else {
        return Err(Diagnostic::error("a load belongs to a part, and none is described yet", args.span)
            .help("&DESCRIBE BODY describes one"));
    };
    let given = [LINEAR_ROLL, QUADRATIC_ROLL, CRITICAL_ROLL].map(|option| args.option_number(&option));
    if given.iter().all(Option::is_none) {
        return Err(Diagnostic::error("#ROLL_DAMPING without a value", args.span)
            .help("-LINEAR B, -QUADRATIC B or -CRITICAL PERCENT, or several of them"));
    }
    let [linear, quadratic, percent] = given.map(Option::unwrap_or_default);
    let kind = LoadKind::RollDamping(RollDamping { linear, quadratic, critical: percent / 100.0 });
    keep(job, args, (part, [0.0; 3]), kind)
}

fn tanker(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const MIDSHIP: DatumKey<str> = TANKER_SPEC.word("*PT");
    let args = &call.args;
    if !args.has(&COEFFICIENT_FILE) {
        let size = args.number(const { TANKER_SPEC.number("SIZE") }).unwrap_or_default();
        let record = format!("#TANKER {}", eight_figures(size));
        let effect = "wind and current on a tanker, whose coefficients windlass does not ship".to_string();
        let kept = UnmodelledEffect { record, effect, matters_to: SolveKind::Statics, span: args.span };
        let said = format!("not computed: {}; solves it matters to will stop", kept.sentence());
        let said = Diagnostic::warning(said, args.span).help(TANKER_FORM);
        job.notices.push(*said.help(format!("a row of the file is {TANKER_ROW}: 0,-0.9,0,0,-0.04,0,0")));
        job.model.keep_unmodelled(kept);
        return Ok(Effect::Done);
    }
    if args.word(MIDSHIP).is_none() {
        return Err(Diagnostic::error("#TANKER lacks its value *PT, the point the moments are about", args.span)
            .help(TANKER_FORM));
    }
    let position = place_of_point(job, args, args.word(MIDSHIP).unwrap_or_default(), args.position(MIDSHIP))?;
    let lacking = [LBP, TANKER_DRAFT, WIND_AREAS].into_iter().find(|option| !args.has(option));
    if let Some(option) = lacking {
        return Err(Diagnostic::error(
            format!("#TANKER lacks {}: windlass ships no coefficients of tankers", option.name),
            args.span,
        )
        .help(TANKER_FORM)
        .help(format!("a row of the file is {TANKER_ROW}: 0,-0.9,0,0,-0.04,0,0")));
    }
    let file = args.option(&COEFFICIENT_FILE).and_then(|given| given.values.first());
    let (name, span) = file.and_then(|v| Some((v.word()?, v.span))).unwrap_or(("", args.span));
    let found = rows::<7>(job, (name, span), TANKER_ROW, MAX_HEADINGS)?;
    let (length, draft) = (args.option_number(&LBP).unwrap_or(0.0), args.option_number(&TANKER_DRAFT).unwrap_or(0.0));
    let [ahead, beside] = args
        .option(&WIND_AREAS)
        .map_or([0.0; 2], |given| given.numbers_or_zero(const { WIND_AREAS.numbers(["AT", "AL"]) }));
    let around = job.model.surroundings();
    let (air, water) = (0.5 * around.air_density, 0.5 * around.water_density);
    let (mut wind, mut current) = (Vec::new(), Vec::new());
    for (_, [heading, xw, yw, nw, xc, yc, nc]) in found {
        let angle = heading.to_radians();
        wind.push((angle, [air * xw * ahead, air * yw * beside, 0.0, 0.0, 0.0, air * nw * beside * length]));
        let area = length * draft;
        current.push((angle, [water * xc * area, water * yc * area, 0.0, 0.0, 0.0, water * nc * area * length]));
    }
    let symmetric = args.has(&SYMMETRIC);
    for table in [&wind, &current] {
        ByHeading::new(table, symmetric).map_err(|e| e.diagnostic(span, job.units))?;
    }
    for (fluid, rows) in [(Fluid::Air, wind), (Fluid::Water, current)] {
        let (category, group) = (weight::category_of(args), None);
        let kind = LoadKind::Coefficients { rows, symmetric };
        let (part, at) = position.clone();
        let shape_coefficients = [1.0; 2];
        job.model.loads.push(PartLoad { part, at, fluid, kind, shape_coefficients, category, group, span: args.span });
    }
    Ok(Effect::Done)
}

fn area(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let areas = args.numbers_or_zero(const { AREA_SPEC.numbers(["AX", "AY", "AZ"]) });
    keep(job, args, position(job, args)?, LoadKind::Area(areas))
}

fn plate(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let mut corners: Vec<Vector3<f64>> = Vec::new();
    let mut part = String::new();
    for (name, span) in args.data.iter().filter_map(|value| Some((value.word()?, value.span))) {
        let (of, at) = place_of_point(job, args, name, span)?;
        part = of;
        corners.push(at.into());
    }
    let Some((first, rest)) = corners.split_first() else { return Ok(Effect::Done) };
    // triangles that share the first corner
    let triangles = || rest.iter().zip(rest.iter().skip(1)).map(|(b, c)| (b, c, (b - first).cross(&(c - first)) * 0.5));
    let whole: Vector3<f64> = triangles().map(|(_, _, area)| area).sum();
    let size = whole.norm();
    let span = corners.iter().map(|c| (c - first).norm_squared()).fold(0.0, f64::max);
    if size <= 1e-9 * span {
        return Err(Diagnostic::error("the corners of a plate lie on one line", args.span));
    }
    let normal = whole / size;
    let off = corners.iter().map(|c| (c - first).dot(&normal).abs()).fold(0.0, f64::max);
    if off > 0.01 * span.sqrt() {
        return Err(Diagnostic::error("the corners of a plate do not lie in one plane", args.span)
            .label("more than a hundredth of its size off")
            .help("give it as several plates"));
    }
    let moment: Vector3<f64> = triangles().map(|(b, c, area)| (first + b + c) / 3.0 * area.dot(&normal)).sum();
    let drag = if has_shape_coefficients(args) { 1.0 } else { plate_drag(job, args) };
    let kind = LoadKind::Plate { area: drag * size, normal: normal.into() };
    keep(job, args, (part, (moment / size).into()), kind)
}

/// Rows of six coefficients over a heading or a period, which grows.
///
/// # Errors
/// A heading or a period that does not grow, at its value.
fn coefficient_rows(
    args: &Args,
    abscissa: DatumKey<f64>,
    coefficients: [DatumKey<f64>; 6],
) -> Outcome<Vec<(f64, [f64; 6])>> {
    let mut rows: Vec<(f64, [f64; 6])> = Vec::new();
    for group in args.groups_from(abscissa) {
        let at = group.number(abscissa).unwrap_or(0.0);
        if rows.last().is_some_and(|(last, _)| at <= *last) {
            return Err(Diagnostic::error("the first value of each group must grow", group.position(abscissa))
                .label("not larger than that of the group before"));
        }
        rows.push((at, group.numbers_or_zero(coefficients)));
    }
    Ok(rows)
}

fn table(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let position = position(job, args)?;
    const HEADING: DatumKey<f64> = TABLE_SPEC.number("HEADING");
    let rows = coefficient_rows(args, HEADING, const { TABLE_SPEC.numbers(SIX_NAMES) })?;
    let symmetric = args.has(&SYMMETRIC);
    ByHeading::new(&rows, symmetric).map_err(|e| e.diagnostic(args.span, job.units))?;
    against(job, args, rows.iter().map(|(heading, six)| (*heading, six)));
    keep(job, args, position, LoadKind::Coefficients { rows, symmetric })
}

fn drift(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const HEADING: DatumKey<f64> = DRIFT_SPEC.number("HEADING");
    let args = &call.args;
    let position = position(job, args)?;
    const PERIOD: DatumKey<f64> = DRIFT_SPEC.number("PERIOD");
    let rows = coefficient_rows(args, PERIOD, const { DRIFT_SPEC.numbers(SIX_NAMES) })?;
    let heading = args.number(HEADING).unwrap_or(0.0);
    let same = |l: &&PartLoad| {
        let again = matches!(&l.kind, LoadKind::Drift { heading: h, .. } if *h == heading);
        again && Model::key(&l.part) == Model::key(&position.0) && l.at == position.1
    };
    if let Some(old) = job.model.loads.iter().find(same) {
        return Err(Diagnostic::error("this heading is given already at this point", args.position(HEADING))
            .other(old.span, "given here"));
    }
    against(job, args, rows.iter().map(|(_, six)| (heading, six)));
    keep(job, args, position, LoadKind::Drift { heading, rows, symmetric: args.has(&SYMMETRIC) })
}

/// Notes the first force that is against what comes from its heading: signs or headings are easily taken the other way.
fn against<'a>(job: &mut Job, args: &Args, mut rows: impl Iterator<Item = (f64, &'a [f64; 6])>) {
    let wrong = |(heading, [fx, fy, ..]): &(f64, &[f64; 6])| {
        let (cos, sin) = unit_vector(*heading);
        fx * cos + fy * sin > 1e-6 * fx.hypot(*fy)
    };
    if let Some((heading, _)) = rows.find(wrong) {
        let degrees = eight_figures(heading.to_degrees());
        job.remark(format!("the force at heading {degrees} is against what comes from there"), args.span);
    }
}

/// The matrix of a record: its diagonal, or whole.
fn values(args: &Args) -> Outcome<Matrix6<f64>> {
    // DAMP and AMASS name their data alike
    const DIAGONAL: [DatumKey<f64>; 6] = DRAG_SPEC.numbers(["X", "Y", "Z", "RX", "RY", "RZ"]);
    let given = DIAGONAL.iter().any(|key| args.number(*key).is_some());
    match args.option(&FULL_RATE).map(Given::numbers) {
        Some(_) if given => {
            Err(Diagnostic::error("-MATRIX and a diagonal contradict each other", args.position(DIAGONAL[0])))
        }
        Some(all) => Ok(Matrix6::from_row_iterator(all.into_iter().chain(std::iter::repeat(0.0)).take(36))),
        None if !given => Err(Diagnostic::error("a matrix without values", args.span)
            .help("give its diagonal, or all of it with -MATRIX")),
        None => Ok(Matrix6::from_diagonal(&args.numbers_or_zero(DIAGONAL).into())),
    }
}

fn matrix(job: &mut Job, call: &Call, kind: fn(Matrix6<f64>) -> LoadKind) -> Outcome<Effect> {
    let position = position(job, &call.args)?;
    keep(job, &call.args, position, kind(values(&call.args)?))
}

fn added_mass(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let position = position(job, &call.args)?;
    let (matrix, gravity) = (values(&call.args)?, job.model.defaults.gravity);
    keep(job, &call.args, position, LoadKind::AddedMass(matrix / gravity))
}
