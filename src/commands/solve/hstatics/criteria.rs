//! `STAB_OK`: stability criteria, and their table, from which the options, their help and the tests of KG_ALLOW come.
//!
//! Source: [MOSES-REF stab_ok] for the quantities and the options that begin with -I_ and -D_. What is marked as our reading in the
//! table has no definition there.

use super::arms::{ArmRequest, OPTIONS, note_end};
use super::{MAX_ROWS, body, clean, dispose, keep_wave};
use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::spec::Owner;
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::{Args, Value};
use windlass_hydro::compartments_of;
use windlass_hydro::stability::{Quantity, Stability, StillBody, find_down_flooding_points};
use windlass_language::spec::{CommandSpec, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{Body, ClassError, Model, SolveKind};

/// STAB_OK.
pub static STAB_OK: Command = Command { spec: &SPEC, edits: false, run };

/// Which way a quantity must lie from its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Demand {
    /// It is not less.
    AtLeast,
    /// It is not greater.
    AtMost,
}

/// What a quantity is measured in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Measure {
    Length,
    Angle,
    Area,
    Ratio,
}

impl Measure {
    fn dim(self) -> Dim {
        match self {
            Measure::Length | Measure::Area => Dim::Length,
            Measure::Angle => Dim::Angle,
            Measure::Ratio => Dim::None,
        }
    }

    fn label(self, units: UnitSystem) -> String {
        match self {
            Measure::Area => format!("{}-rad", Dim::Length.label(units)),
            other => other.dim().label(units).to_string(),
        }
    }
}

/// A criterion: a quantity, and the options that give it its value.
pub(super) struct Criterion {
    /// The name of the quantity (MOSES).
    pub(super) name: &'static str,
    pub(super) quantity: Quantity,
    measure: Measure,
    pub(super) demand: Demand,
    /// For the intact body, the damaged body, and either.
    options: [OptionSpec; 3],
}

macro_rules! criteria {
    ($($name:literal $quantity:ident $measure:ident $demand:ident [$($second:ident)?] $what:literal;)*) => {
        /// All criteria. The text of each is the help of its options; [stab_ok] is the page of [MOSES-REF] that has its definition.
        pub(super) static CRITERIA: &[Criterion] = &[$(Criterion {
            name: $name,
            quantity: Quantity::$quantity,
            measure: Measure::$measure,
            demand: Demand::$demand,
            options: [
                OptionSpec::new(concat!("-I_", $name), criteria!(@values $measure $($second)?), concat!("intact body: ", $what)),
                OptionSpec::new(concat!("-D_", $name), criteria!(@values $measure $($second)?), concat!("damaged body: ", $what)),
                OptionSpec::new(concat!("-", $name), criteria!(@values $measure $($second)?), concat!("either: ", $what))
                    .owner(Owner::Ours),
            ],
        }),*];
    };
    (@dim Length) => { Dim::Length };
    (@dim Area) => { Dim::Length };
    (@dim Angle) => { Dim::Angle };
    (@dim Ratio) => { Dim::None };
    (@values $measure:ident) => { &[ValueSpec::new("VALUE", Kind::Number(criteria!(@dim $measure)), "the limit")] };
    (@values $measure:ident factor) => {
        &[
            ValueSpec::new("VALUE", Kind::Number(criteria!(@dim $measure)), "the limit"),
            ValueSpec::new("FACTOR", Kind::Number(Dim::None), "factor of the equilibrium").or("1"),
        ]
    };
    (@values $measure:ident roll) => {
        &[
            ValueSpec::new("VALUE", Kind::Number(criteria!(@dim $measure)), "the limit"),
            ValueSpec::new("MANG", Kind::Number(Dim::Angle), "roll to windward").or("0"),
        ]
    };
}

criteria! {
    "GM" MetacentricHeight Length AtLeast [] "metacentric height at the equilibrium, free surfaces included [stab_ok]";
    "DOWN_H" DownFloodingHeight Length AtLeast [] "height of the lowest NWT point at the equilibrium [stab_ok]";
    "ZCROSS" Equilibrium Angle AtMost [] "the equilibrium without wind, from upright [stab_ok]; an upper limit (our reading)";
    "THETA1" FirstIntercept Angle AtMost [] "first angle with R = H [stab_ok]; an upper limit (our reading)";
    "RANGE" Range Angle AtLeast [] "second angle with R = 0 [stab_ok]";
    "R_M_EQUI" RangeLessEquilibrium Angle AtLeast [factor] "RANGE less FACTOR times ZCROSS [stab_ok]";
    "DANG" DownFloodingAngle Angle AtLeast [] "angle at which an NWT point goes under water [stab_ok]";
    "DANG_T1" DownFloodingLessFirst Angle AtLeast [] "that less THETA1 [stab_ok]";
    "DWT_T1" WeathertightLessFirst Angle AtLeast [] "angle at which a WT point goes under water less THETA1 [stab_ok]";
    "ANG_DIFF" InterceptDifference Angle AtLeast [] "second less first angle with R = H [stab_ok]";
    "ANG@MARM" PeakAngle Angle AtLeast [] "angle of the greatest righting arm [stab_ok]";
    "AR_RATIO" AreaRatio Ratio AtLeast [] "area under R over that under H, up to the second R = H or DANG [stab_ok]";
    "ARR@30" AreaRatioTo30 Ratio AtLeast [] "the same up to 30 degrees at most [stab_ok]";
    "AR_WRATIO" WaveAreaRatio Ratio AtLeast [roll] "area between R and H behind THETA1 over that between H and R from MANG before it [stab_ok names it; our reading, after the weather criterion of IMO]";
    "ARM_RATIO" ArmRatio Ratio AtLeast [] "R over H at the greatest righting arm [stab_ok names it; our reading]";
    "AR_RESID" ResidualArea Area AtLeast [] "area between R and H from THETA1 to the second R = H or DANG [stab_ok]";
    "RARM@M30" ArmBeyond30 Length AtLeast [] "greatest righting arm at 30 degrees or more [stab_ok names it; our reading]";
    "RARM@30" ArmAt30 Length AtLeast [] "righting arm at 30 degrees [stab_ok]";
    "ARM_AR" AreaToSecond Area AtLeast [] "area under R up to the second R = H [stab_ok]";
    "ARE@DFLD" AreaToFlooding Area AtLeast [] "area under R up to DANG or the second R = H [stab_ok]";
    "ARE@MARM" AreaToPeak Area AtLeast [] "area under R up to the greatest righting arm [stab_ok]";
    "ARE@30" AreaTo30 Area AtLeast [] "area under R up to 30 degrees [stab_ok names it; our reading]";
    "ARE@40" AreaTo40 Area AtLeast [] "area under R up to 40 degrees or DANG [stab_ok names it; our reading]";
    "AREBTW" AreaFrom30To40 Area AtLeast [] "area under R from 30 degrees to 40 or DANG [stab_ok names it; our reading]";
}

const OF_CRITERIA: usize = 3 * CRITERION_COUNT;
/// Criteria in the table: an array of their options needs it while compiling.
const CRITERION_COUNT: usize = 24;

/// The options of a table of arms and of criteria.
pub(super) static CRITERION_OPTIONS: [OptionSpec; OPTIONS.len() + OF_CRITERIA] = {
    assert!(CRITERIA.len() == CRITERION_COUNT, "CRITERION_COUNT is their number");
    let mut all = [OPTIONS[0]; OPTIONS.len() + OF_CRITERIA];
    let mut i = 0;
    while i < OPTIONS.len() {
        all[i] = OPTIONS[i];
        i += 1;
    }
    let mut n = 0;
    while n < CRITERIA.len() {
        let mut which = 0;
        while which < 3 {
            all[OPTIONS.len() + 3 * n + which] = CRITERIA[n].options[which];
            which += 1;
        }
        n += 1;
    }
    all
};

pub(super) const STEPS: [ValueSpec; 2] = [
    ValueSpec::new("INC", Kind::Number(Dim::Angle), "step of roll").or("5"),
    ValueSpec::new("NUM", Kind::Integer, "number of steps").or("12").in_range(1.0, MAX_ROWS),
];

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HSTATICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &STEPS,
    options: &CRITERION_OPTIONS,
    detail: "The quantities of stability criteria, about each roll axis of -YAW, of righting and heeling arms as of RARM INC NUM; a quantity whose option is given is tested against its limit. \
             -I_ of a name is the limit of the intact body, -D_ that of the damaged one, which has a flooded compartment; the name alone is either's (ours). R(a) and H(a) are the righting \
             and the heeling arm; angles but ZCROSS and areas are from the equilibrium without wind. Areas are in length times radians (our reading). \
             Crossings and peaks are found, not read between rolls. Where an angle lies beyond the last roll, that stands for it and is marked `or more`. A quantity \
             that does not exist has no value: without wind, down-flooding points or crossing; asked for it fails. The result goes to the disposition menu.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\n&WEIGHT -TOTAL TBRG 23000 200 0 12 38 118 120\n\
              &INSTATE -CONDITION 9\nHSTATICS\nSTAB_OK 5 14 -WIND 100 -I_GM 1 -I_AR_RATIO 1.4 -RANGE 36\nREPORT\nEND\nEND",
    ..CommandSpec::new("STAB_OK", "checks stability criteria")
};

/// A criterion that a record gives a limit.
pub(super) struct Limit {
    pub(super) criterion: &'static Criterion,
    /// The limit (SI).
    pub(super) value: f64,
    /// The factor or the roll that it needs.
    pub(super) second: f64,
}

/// The limits that hold for a body.
pub(super) fn read_limits(args: &Args, model: &Model, body: &Body) -> Vec<Limit> {
    let is_damaged = compartments_of(model, body).any(|c| c.contents.is_flooded);
    let mut limits = Vec::new();
    for criterion in CRITERIA {
        let [intact, damaged, either] = &criterion.options;
        let given = args.option(if is_damaged { damaged } else { intact }).or_else(|| args.option(either));
        let Some(given) = given else { continue };
        let usual = if criterion.quantity == Quantity::RangeLessEquilibrium { 1.0 } else { 0.0 };
        let second = given.values.get(1).and_then(Value::number).unwrap_or(usual);
        limits.push(Limit { criterion, value: given.first_number().unwrap_or(0.0), second });
    }
    limits
}

impl Limit {
    /// By how much a value is on the right side of the limit; not at all without a value.
    pub(super) fn margin(&self, value: Option<f64>) -> Option<f64> {
        value.map(|value| match self.criterion.demand {
            Demand::AtLeast => value - self.value,
            Demand::AtMost => self.value - value,
        })
    }

    /// The limit in the user's units, with them.
    pub(super) fn text(&self, units: UnitSystem) -> String {
        let measure = self.criterion.measure;
        let sign = if self.criterion.demand == Demand::AtLeast { ">=" } else { "<=" };
        let value = windlass_base::units::eight_figures(measure.dim().from_si(self.value, units));
        format!("{sign} {value} {}", measure.label(units)).trim_end().to_string()
    }
}

struct CriterionRow {
    yaw: f64,
    criterion: &'static Criterion,
    value: Option<f64>,
    is_cut_short: bool,
    demand: String,
    verdict: &'static str,
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (args, span) = (&call.args, call.args.span);
    let step = args.number(const { SPEC.number("INC") }).unwrap_or(5f64.to_radians());
    let steps = args.integer(const { SPEC.integer("NUM") }).unwrap_or(12);
    let request = ArmRequest::read(job, args, step, steps)?;
    let body = body(job, span)?;
    let (model, units) = (&job.model, job.units);
    let to_error = |e: ClassError| e.diagnostic(span, units);
    model.check_effects(SolveKind::Statics).map_err(to_error)?;
    let limits = read_limits(args, model, body);
    let mut still = StillBody::new(model, body, request.wave).map_err(to_error)?;
    still.weight_factor = request.weight_factor;
    let points = find_down_flooding_points(model, body);
    let mut table = Table::new(format!("Stability of {}", body.name));
    let (mut rows, mut weight) = (Vec::new(), 0.0);
    for yaw in &request.yaws {
        let start = request.start(body, *yaw);
        let heeling = request.heeling(model, body, &start).map_err(to_error)?;
        let arms = request.arms(&still, (heeling.as_ref(), &points), &start).map_err(to_error)?;
        weight = arms.rows.first().map_or(weight, |row| row.balance.weight);
        note_end(&mut table, &arms, units);
        let stability = Stability::from_arms(&arms).map_err(to_error)?;
        for criterion in CRITERIA {
            let limit = limits.iter().find(|limit| std::ptr::eq(limit.criterion, criterion));
            let second = limit.map_or(0.0, |limit| limit.second);
            let value = stability.value(criterion.quantity, second).map_err(to_error)?;
            if value.is_none() && limit.is_none() {
                continue;
            }
            let verdict = match limit.map(|limit| limit.margin(value)) {
                None => "",
                Some(Some(margin)) if margin >= 0.0 => "passed",
                Some(_) => "FAILED",
            };
            rows.push(CriterionRow {
                yaw: *yaw,
                criterion,
                value,
                is_cut_short: value.is_some() && stability.is_cut_short(criterion.quantity),
                demand: limit.map(|limit| limit.text(units)).unwrap_or_default(),
                verdict,
            });
        }
    }
    let failed: Vec<&str> = rows.iter().filter(|row| row.verdict == "FAILED").map(|row| row.criterion.name).collect();
    let mut table = request.describe(table, &still, weight);
    if !failed.is_empty() {
        table.warn(format!("{} does not meet {}", body.name, failed.join(", ")));
    }
    table.add_notes(model.caveats());
    let table = table
        .with_rows(&rows)
        .column("", "Axis", Dim::Angle, Digits::Usual, |row| row.yaw)
        .text("Quantity", |row| row.criterion.name)
        .column("", "Value", Dim::None, Digits::Decimals(4), |row| {
            row.value.map(|value| clean(row.criterion.measure.dim().from_si(value, units)))
        })
        .text("Unit", |row| row.criterion.measure.label(units))
        .text("Reach", |row| if row.is_cut_short { "or more" } else { "" })
        .text("Limit", |row| row.demand.clone())
        .text("Verdict", |row| row.verdict)
        .build();
    if failed.is_empty()
        && limits.is_empty()
        && args.options.iter().any(|given| given.name().starts_with("-D_") || given.name().starts_with("-I_"))
    {
        let state =
            "no limit holds: those of -I_ are for a body without, those of -D_ for one with flooded compartments";
        job.notices.push(*Diagnostic::remark(state, span));
    }
    keep_wave(job, request.wave);
    Ok(dispose(job, table, span))
}
