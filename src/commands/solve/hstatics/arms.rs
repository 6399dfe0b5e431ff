//! `RARM`: righting and heeling arms; and the options that STAB_OK and KG_ALLOW share with it.
//!
//! Source: [MOSES-REF rarm] for the options, [MOSES-HELP hystat] for -U_CURRENT.

use super::{MAX_ROWS, WAVE, body, clean, dispose, keep_wave, static_wave, with_wave};
use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::choice::YesNo;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::{Args, Given};
use windlass_hydro::stability::{
    ArmPoint, Arms, Attitude, BalanceLimits, DownFloodingPoint, Heeling, ResistanceCentre, StaticWave, StillBody,
    StopRule, find_down_flooding_points,
};
use windlass_language::spec::{CommandSpec, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{Body, ClassError, Model, SolveKind};

/// RARM.
pub static RARM: Command = Command { spec: &SPEC, edits: false, run };

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

choices! {
    /// Where a table of arms ends.
    enum StopWord {
        /// Where the righting arm is no longer positive.
        Righting = "RARM",
        /// Where the righting arm is no longer greater than the heeling arm.
        Net = "NET",
    }
}

choices! {
    /// When the current of -U_CURRENT is found.
    enum CurrentWord {
        /// Upright.
        Initial = "INITIAL",
    }
}

pub(super) const ECHO: OptionSpec = OptionSpec::new(
    "-ECHO",
    &[ValueSpec::choice::<YesNo>("YES/NO", "either").or("YES")],
    "accepted: iterations are not printed",
);
pub(super) const NUMITER: OptionSpec = OptionSpec::new(
    "-NUMITER",
    &[ValueSpec::new("N", Kind::Integer, "steps").in_range(1.0, 100_000.0)],
    "most steps of a balance",
)
.default("200");
pub(super) const TOLERANCE: OptionSpec = OptionSpec::new(
    "-TOLERANCE",
    &[
        number("HE", Dim::None, "of heave: a share of the weight").not_negative(),
        number("RO", Dim::Length, "of roll: an arm").or("as it closes").not_negative(),
        number("PI", Dim::Length, "of trim: an arm").or("as it closes").not_negative(),
    ],
    "what may be left after the last step of a balance that does not close; one that does goes on to 1e-10",
);
const FIX: OptionSpec = OptionSpec::new("-FIX", &[], "holds the trim that the body has");
const YAW: OptionSpec =
    OptionSpec::new("-YAW", &[number("A", Dim::Angle, "angle")], "angle of the roll axis from the body's x axis")
        .repeating(1)
        .default("0");
const WIND: OptionSpec = OptionSpec::new(
    "-WIND",
    &[number("V", Dim::WindSpeed, "speed, as of &ENV -WIND").not_negative()],
    "wind across the roll axis, onto the side that rises, with the profile of the environment",
)
.default("none");
const CEN_LATERAL: OptionSpec = OptionSpec::new(
    "-CEN_LATERAL",
    &[
        number("X", Dim::Length, "in the body"),
        number("Y", Dim::Length, "in the body"),
        number("Z", Dim::Length, "in the body"),
    ],
    "center of lateral resistance, about which the wind heels",
)
.default("the center of buoyancy (our reading)");
const U_CURRENT: OptionSpec = OptionSpec::new(
    "-U_CURRENT",
    &[ValueSpec::choice::<CurrentWord>("INITIAL", "the current that holds it upright, at all rolls")
        .or("at each roll anew")],
    "the drag of a current that holds the wind heels with it",
);
const COEFFICIENTS: &[ValueSpec] = &[
    number("C0", Dim::Length, "arm"),
    number("C1", Dim::Length, "a degree").or("0"),
    number("C2", Dim::Length, "a degree squared").or("0"),
    number("C3", Dim::Length, "a degree cubed").or("0"),
];
const W_COEFF: OptionSpec = OptionSpec::new(
    "-W_COEFF",
    COEFFICIENTS,
    "adds C0 + C1 a + C2 a^2 + C3 a^3 to the heeling arm, a being the roll in degrees (our reading)",
);
const R_COEFF: OptionSpec =
    OptionSpec::new("-R_COEFF", COEFFICIENTS, "adds the like to the righting arm (our reading)");
const STOP: OptionSpec = OptionSpec::new(
    "-STOP",
    &[ValueSpec::choice::<StopWord>(
        "HOW",
        "RARM: no longer positive; NET: no longer above the heeling arm (our reading)",
    )],
    "ends the table behind the roll at which the righting arm is lost",
);
const WEIGHT: OptionSpec = OptionSpec::new(
    "-WEIGHT",
    &[number("SF", Dim::None, "factor").positive()],
    "multiplies the weight of the body and of its contents, which then floats deeper (our reading)",
)
.default("1");

/// The options of a table of arms.
pub(super) const OPTIONS: [OptionSpec; 13] =
    [ECHO, FIX, NUMITER, TOLERANCE, WAVE, YAW, WIND, CEN_LATERAL, U_CURRENT, W_COEFF, R_COEFF, STOP, WEIGHT];

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HSTATICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[
        ValueSpec::new("INC", Kind::Number(Dim::Angle), "step of roll"),
        ValueSpec::new("NUM", Kind::Integer, "number of steps").in_range(1.0, MAX_ROWS),
    ],
    options: &OPTIONS,
    detail: "Righting arms of the body rolled from upright in steps, heave and trim balanced under weight, contents of compartments and buoyancy; free surfaces are exact at every \
             angle. The righting arm is positive where it turns the body back against INC, the heeling arm where the wind turns it on. Areas are those under the arms from upright, \
             by Simpson's rule with a balance amid each step; the ratio is the one over the other. The wind pushes pieces and #AREA loads above the water; where nothing holds it against the wind \
             but a point, that is -CEN_LATERAL. Holes with a point are down-flooding points: VENT and V_VALVE are not weathertight (NWT), WT_VENT is (WT); the least height of each over the water is \
             reported with its hole (our reading). A roll without a balance ends the table, and is said. The result goes to the disposition menu.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\n&WEIGHT -TOTAL TBRG 23000 200 0 12 38 118 120\n\
              &INSTATE -CONDITION 9\nHSTATICS\nRARM 5 12 -WIND 100 -CEN_LAT 200 0 4\nREPORT\nEND\nEND",
    ..CommandSpec::new("RARM", "righting and heeling arms")
};

/// What a record asks of a table of arms.
pub(super) struct ArmRequest {
    pub(super) wave: Option<StaticWave>,
    /// Angles of the roll axis, each with its place.
    pub(super) yaws: Vec<f64>,
    step: f64,
    steps: usize,
    stop: Option<StopRule>,
    holds_trim: bool,
    limits: BalanceLimits,
    polynomials: [[f64; 4]; 2],
    wind: f64,
    centre: Option<[f64; 3]>,
    current: Option<bool>,
    pub(super) weight_factor: f64,
}

/// The limits of -NUMITER and -TOLERANCE.
pub(super) fn balance_limits(args: &Args) -> BalanceLimits {
    let usual = BalanceLimits::default();
    let most = args.option_integer(&NUMITER).and_then(|n| usize::try_from(n).ok()).unwrap_or(usual.most);
    let left =
        args.option(&TOLERANCE).map(|given| given.numbers_or_zero(const { TOLERANCE.numbers(["HE", "RO", "PI"]) }));
    BalanceLimits { most, left }
}

impl ArmRequest {
    /// Reads the options of a record with its step and number of rolls.
    ///
    /// # Errors
    /// Options that exclude each other.
    pub(super) fn read(job: &Job, args: &Args, step: f64, steps: i64) -> Outcome<Self> {
        if step == 0.0 {
            return Err(Diagnostic::error("the step of the roll is zero", args.span));
        }
        let wave = static_wave(job, args);
        let (centre, current) = (args.option(&CEN_LATERAL), args.option(&U_CURRENT));
        if let (Some(_), Some(second)) = (centre, current) {
            return Err(Diagnostic::error("-CEN_LATERAL and -U_CURRENT exclude each other", second.span));
        }
        let polynomial = |option: &OptionSpec| match args.option(option) {
            Some(given) => given.numbers_or_zero(const { W_COEFF.numbers(["C0", "C1", "C2", "C3"]) }),
            None => [0.0; 4],
        };
        let yaws = args.option(&YAW).map(Given::numbers).filter(|list| !list.is_empty()).unwrap_or_else(|| vec![0.0]);
        Ok(ArmRequest {
            wave,
            yaws,
            step,
            steps: usize::try_from(steps).unwrap_or(1),
            stop: args.option_choice(&STOP, const { STOP.choice("HOW") }).map(|word| match word {
                StopWord::Righting => StopRule::Righting,
                StopWord::Net => StopRule::Net,
            }),
            holds_trim: args.has(&FIX),
            limits: balance_limits(args),
            polynomials: [polynomial(&R_COEFF), polynomial(&W_COEFF)],
            wind: args.option_number(&WIND).unwrap_or(0.0),
            centre: centre.map(|given| given.numbers_or_zero(const { CEN_LATERAL.numbers(["X", "Y", "Z"]) })),
            current: current.map(|given| given.choice(const { U_CURRENT.choice::<CurrentWord>("INITIAL") }).is_some()),
            weight_factor: args.option_number(&WEIGHT).unwrap_or(1.0),
        })
    }

    /// Whether anything heels the body.
    pub(super) fn heels(&self) -> bool {
        self.wind > 0.0 || self.polynomials[1] != [0.0; 4]
    }

    /// Where the rolls begin: upright, or with the trim that is held.
    pub(super) fn start(&self, body: &Body, axis: f64) -> Attitude {
        let [_, trim, heading] = body.position.turn;
        let trim = if self.holds_trim { trim } else { 0.0 };
        Attitude { origin: body.position.shift, roll: 0.0, trim, heading, axis }
    }

    /// What heels the body about a roll axis.
    ///
    /// # Errors
    /// A wind that cannot be computed.
    pub(super) fn heeling(&self, model: &Model, body: &Body, start: &Attitude) -> Result<Option<Heeling>, ClassError> {
        if self.wind <= 0.0 {
            return Ok(None);
        }
        let side = if self.step < 0.0 { -1.0 } else { 1.0 };
        let centre = match (self.centre, self.current) {
            (Some(point), _) => ResistanceCentre::Point(point.into()),
            (None, Some(is_initial)) => {
                ResistanceCentre::Current { drag: Heeling::drag_of_current(model, body, side, start)?, is_initial }
            }
            (None, None) => ResistanceCentre::Buoyancy,
        };
        Heeling::from_wind(model, body, self.wind, side, start, centre).map(Some)
    }

    /// The table of a body.
    ///
    /// # Errors
    /// No balance upright.
    pub(super) fn arms<'b>(
        &self,
        still: &'b StillBody,
        (heeling, points): (Option<&'b Heeling>, &'b [DownFloodingPoint]),
        start: &Attitude,
    ) -> Result<Arms<'b>, ClassError> {
        let mut arms = Arms::new(still, *start, self.step);
        (arms.heeling, arms.points) = (heeling, points);
        (arms.holds_trim, arms.limits, arms.polynomials) = (self.holds_trim, self.limits, self.polynomials);
        arms.with_rows(self.steps, self.stop)
    }

    /// The facts and remarks that a table has of it.
    pub(super) fn describe(&self, mut table: Table, still: &StillBody, weight: f64) -> Table {
        table = with_wave(table.fact("Weight", weight, Dim::Force), still.wave());
        if self.wind > 0.0 {
            table = table.fact("Wind", self.wind, Dim::WindSpeed);
            table.note(match (self.centre, self.current) {
                (Some(_), _) => "the wind heels about the point of -CEN_LATERAL",
                (None, Some(true)) => {
                    "the wind heels with the drag of the current that holds it upright, about the center of gravity"
                }
                (None, Some(false)) => "the wind heels with the drag of a current that holds it at each roll",
                (None, None) => "the wind heels about the center of buoyancy",
            });
        }
        if self.weight_factor != 1.0 {
            table = table.fact_with_digits("Weight Factor", self.weight_factor, Dim::None, Digits::Decimals(4));
        }
        for (of, polynomial) in ["righting", "heeling"].into_iter().zip(self.polynomials) {
            if polynomial != [0.0; 4] {
                table.note(format!("the polynomial of the roll in degrees is added to the {of} arm"));
            }
        }
        table
    }
}

/// The note of where a table of arms ends for want of a balance.
pub(super) fn note_end(table: &mut Table, arms: &Arms, units: UnitSystem) {
    if let Some(error) = &arms.ended {
        table.note_absent(format!("{}: {}", arms.body.name, error.text(units)));
    }
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (args, span) = (&call.args, call.args.span);
    let step = args.number(const { SPEC.number("INC") }).unwrap_or_default();
    let steps = args.integer(const { SPEC.integer("NUM") }).unwrap_or(1);
    let request = ArmRequest::read(job, args, step, steps)?;
    let body = body(job, span)?;
    let (model, units) = (&job.model, job.units);
    let to_error = |e: ClassError| e.diagnostic(span, units);
    model.check_effects(SolveKind::Statics).map_err(to_error)?;
    let [yaw] = request.yaws.as_slice() else {
        let position = args.option(&YAW).map_or(span, |given| given.span);
        return Err(
            Diagnostic::error("RARM has one roll axis", position).help("STAB_OK and KG_ALLOW take several -YAW")
        );
    };
    let mut still = StillBody::new(model, body, request.wave).map_err(to_error)?;
    still.weight_factor = request.weight_factor;
    let start = request.start(body, *yaw);
    let heeling = request.heeling(model, body, &start).map_err(to_error)?;
    let points = find_down_flooding_points(model, body);
    let arms = request.arms(&still, (heeling.as_ref(), &points), &start).map_err(to_error)?;
    let weight = arms.rows.first().map_or(0.0, |row| row.balance.weight);
    let mut table = request.describe(Table::new(format!("Righting Arms of {}", body.name)), &still, weight);
    if *yaw != 0.0 {
        table = table.fact("Roll Axis", *yaw, Dim::Angle);
        table.note("roll and trim are about the roll axis and across it");
    }
    note_end(&mut table, &arms, units);
    table.add_notes(model.caveats());
    table.note("areas in length times radians; draft is that of the body's origin");
    let side = arms.side();
    let rows: Vec<(&ArmPoint, [f64; 2])> = arms.rows.iter().zip(arms.areas.iter().copied()).collect();
    let heights = |weathertight: bool| points.iter().any(|point| point.is_weathertight == weathertight);
    let name = |row: &ArmPoint, kind: usize| {
        row.heights.get(kind).copied().flatten().and_then(|(_, n)| points.get(n)).map(|point| point.name.clone())
    };
    let mut made = table
        .with_rows(&rows)
        .column("", "Roll", Dim::Angle, Digits::Usual, |(row, _)| side * row.angle)
        .column("", "Draft", Dim::Length, Digits::Usual, |(row, _)| -row.balance.attitude.origin[2])
        .column("", "Trim", Dim::Angle, Digits::Usual, |(row, _)| clean(row.balance.attitude.trim));
    for (kind, group) in [(0, "Least NWT"), (1, "Least WT")] {
        if heights(kind == 1) {
            made = made
                .column(group, "Height", Dim::Length, Digits::Usual, |(row, _)| {
                    row.heights[kind].map(|(height, _)| height)
                })
                .column(group, "Point", Dim::None, Digits::Usual, |(row, _)| name(row, kind));
        }
    }
    made = made
        .column("Righting", "Arm", Dim::Length, Digits::Decimals(4), |(row, _)| clean(row.righting))
        .column("Righting", "Moment", Dim::Moment, Digits::Usual, |(row, _)| clean(row.righting) * row.balance.weight)
        .column("Righting", "Area", Dim::Length, Digits::Decimals(4), |(_, area)| clean(area[0]));
    if request.heels() {
        made = made
            .column("Heeling", "Arm", Dim::Length, Digits::Decimals(4), |(row, _)| clean(row.heeling))
            .column("Heeling", "Area", Dim::Length, Digits::Decimals(4), |(_, area)| clean(area[1]))
            .column("Area", "Ratio", Dim::None, Digits::Decimals(3), |(_, [righting, heeling])| {
                (*heeling > 0.0).then(|| righting / heeling)
            });
    }
    let table = made.build();
    keep_wave(job, request.wave);
    Ok(dispose(job, table, span))
}
