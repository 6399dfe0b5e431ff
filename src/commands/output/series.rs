//! The commands of the disposition menu that work on series: each makes a table and opens an inner disposition menu over it.
//!
//! Source: [MOSES-REF disp_men], for SPECTRUM and FFT; the others are ours.

use crate::commands::menu;
use crate::commands::output::disposition::{
    ANY_COLUMN, COLUMN, MAG_USE, MENU, RECORD, VALUES, chosen_for_statistics, open_disposition, selectors,
    to_diagnostic,
};
use crate::commands::output::result::{KEEP, keep_extremes};
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use crate::report::{page, statistic};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_base::values::Args;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, Opens, OptionSpec, ValueSpec};
use windlass_signal::SeriesError;
use windlass_signal::tables::{self, Analysis, Extremes, SeriesRecord};

const EXAMPLE: &str = "&BUILDG -CSV\nTime (s),Tension (kips),Z (ft)\n0,100,0\n1,120,2\n2,131,3\n3,128,2\n4,108,0\n5,90,-2\n6,80,-3\n\
                       7,83,-2\n8,101,0\n9,121,2\n10,133,3\n11,127,2\n12,107,0\n13,89,-2\n14,79,-3\n15,82,-2\n16,101,0\nEND\n\
                       SPECTRUM Time Tension Z -SEGMENT 16\nVLIST\nEND\nFFT Time Z\nVIEW 1:3 -RECORD 2 4\nEND\n\
                       EXTREMES Time Tension -DURATION 3\nREPORT\nEND\nEXCEEDANCE Time Z -LEVELS 5\nVIEW\nEND\n\
                       HISTOGRAM Time Tension -BINS 4\nVIEW\nEND\nRAINFLOW Time Tension -CYCLES\nVIEW\nEND\n\
                       HARMONIC Time Tension -PERIOD 8 -ORDERS 2\nREPORT\nEND\nEND";

const fn spec(name: &'static str, help: &'static str) -> CommandSpec {
    CommandSpec {
        menus: MENU,
        opens: Opens::Menu(&menu::DISPOSITION),
        data: &[COLUMN, COLUMN, ANY_COLUMN],
        repeat: 1,
        example: EXAMPLE,
        ..CommandSpec::new(name, help)
    }
}

const SEGMENT: OptionSpec = OptionSpec::ours(
    "-SEGMENT",
    &[ValueSpec::new("N", Kind::Integer, "samples").in_range(8.0, 67_108_864.0)],
    "samples of a segment",
)
.default("an eighth of the series, as a power of two");
const DURATION: OptionSpec = OptionSpec::ours(
    "-DURATION",
    &[ValueSpec::new("HOURS", Kind::Number(Dim::None), "hours").positive()],
    "time the extreme is sought in",
)
.default("3 hours");
const BLOCKS: OptionSpec = OptionSpec::ours(
    "-BLOCKS",
    &[ValueSpec::new("N", Kind::Integer, "number of blocks").in_range(10.0, 1e6)],
    "blocks the record is cut into for Gumbel",
)
.default("20, or as many as hold ten up-crossings of the mean");
const LOWS: OptionSpec = OptionSpec::ours("-MINIMA", &[], "seeks the smallest value");
const LEVELS: OptionSpec =
    OptionSpec::ours("-LEVELS", &[ValueSpec::new("N", Kind::Integer, "number of levels").in_range(2.0, 1e4)], "levels")
        .default("50");
const BINS: OptionSpec =
    OptionSpec::ours("-BINS", &[ValueSpec::new("N", Kind::Integer, "number of bins").in_range(1.0, 1e3)], "bins")
        .default("20");
const MEANS: OptionSpec = OptionSpec::ours(
    "-MEANS",
    &[ValueSpec::new("N", Kind::Integer, "number of bins").in_range(1.0, 1e3)],
    "bins of the mean of the cycles",
)
.default("1: means are not distinguished");
const CYCLES: OptionSpec = OptionSpec::ours("-CYCLES", &[], "lists every cycle instead of counting them into bins");
const PERIOD: OptionSpec = OptionSpec::ours(
    "-PERIOD",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "period").positive()],
    "period of the first harmonic",
)
.default("that of the sine which fits the first series best");
const ORDERS: OptionSpec = OptionSpec::ours(
    "-ORDERS",
    &[ValueSpec::new("N", Kind::Integer, "number of harmonics").in_range(1.0, 50.0)],
    "harmonics",
)
.default("3");
const LAST: OptionSpec = OptionSpec::ours(
    "-LAST",
    &[ValueSpec::new("N", Kind::Integer, "number of cycles").in_range(1.0, 1e9)],
    "only the last cycles of the series",
)
.default("all whole cycles");

/// SPECTRUM.
pub static SPECTRUM: Command = Command {
    spec: &CommandSpec {
        options: &[SEGMENT, RECORD, VALUES, MAG_USE],
        detail: "The first column is time. Spectral densities by Welch's method: segments that overlap by half under a Hann \
                 window, each without its mean; one-sided, over rad/s, so that densities times the step of frequency sum to the \
                 variance. Prints the moments m0, m1, m2, m4 (over rad/s, in the unit squared), the peak period Tp, T1 = 2 pi \
                 m0/m1, Tz = 2 pi sqrt(m0/m2), Bandwidth sqrt(1 - m2**2/(m0 m4)) and Width sqrt(m0 m2/m1**2 - 1). Times that are \
                 not uniform are interpolated at their mean step, and it is said. Opens an inner disposition menu over the \
                 spectrum; END returns.",
        ..spec("SPECTRUM", "spectral densities of columns")
    },
    edits: false,
    run: spectrum,
};
/// FFT.
pub static FFT: Command = Command {
    spec: &CommandSpec {
        options: &[RECORD, VALUES, MAG_USE],
        detail: "The first column is time. Amplitudes and phases of the harmonics of the whole record, without a window; the \
                 first row is the mean. Opens an inner disposition menu; END returns.",
        ..spec("FFT", "Fourier amplitudes of columns")
    },
    edits: false,
    run: |job, call| open(job, call, |record, _| tables::amplitudes(record)),
};
/// EXTREMES.
pub static EXTREMES: Command = Command {
    spec: &CommandSpec {
        owner: Owner::Ours,
        options: &[DURATION, BLOCKS, LOWS, RECORD, VALUES, MAG_USE, KEEP],
        detail: "The first column is time. The most probable and the expected largest value in a time by three ways: Rayleigh, \
                 from the standard deviation and the mean up-crossing period; a Weibull distribution fitted to the maxima between \
                 crossings of the mean, at least 30 of them; a Gumbel distribution fitted to the maxima of blocks, at least 10. \
                 Both fits are of greatest likelihood; their 95 per cent intervals of the most probable value are asymptotic \
                 and take maxima for independent. A way that has too little to go by is left empty, and it is said why. -RESULT keeps \
                 the most probable values NAME_RAYLEIGH, NAME_WEIBULL and NAME_GUMBEL of the ways that answer, and _LOW and _HIGH of \
                 the fits. Opens an inner disposition menu; END returns.",
        ..spec("EXTREMES", "largest values of columns in a time")
    },
    edits: false,
    run: |job, call| {
        let (record, without) = record(job, &call.args)?;
        let args = &call.args;
        let duration = 3600.0 * args.option_number(&DURATION).unwrap_or(3.0);
        let asked = Extremes { duration, blocks: whole(args, &BLOCKS), lows: args.has(&LOWS) };
        let mut table = tables::extremes(&record, asked).map_err(|e| series_error(args, &e))?;
        keep_extremes(job, args, &table, job.units)?;
        table.add_notes(without);
        enter(job, table);
        Ok(Effect::Done)
    },
};
/// EXCEEDANCE.
pub static EXCEEDANCE: Command = Command {
    spec: &CommandSpec {
        owner: Owner::Ours,
        options: &[LEVELS, RECORD, VALUES, MAG_USE],
        detail: "The first column is time. Shares of the values, and of the maxima between crossings of the mean, that are \
                 greater than each of equally spaced levels; beside them what a Gaussian narrow-banded process of the same \
                 deviation has. Opens an inner disposition menu; END returns.",
        ..spec("EXCEEDANCE", "shares of values and maxima above levels")
    },
    edits: false,
    run: |job, call| open(job, call, |record, args| tables::exceedance(record, whole(args, &LEVELS).unwrap_or(50))),
};
/// HISTOGRAM.
pub static HISTOGRAM: Command = Command {
    spec: &CommandSpec {
        owner: Owner::Ours,
        options: &[BINS, RECORD, VALUES, MAG_USE],
        detail: "The first column is time. Values counted into equal bins from the smallest to the largest. Opens an inner \
                 disposition menu; END returns.",
        ..spec("HISTOGRAM", "values counted into bins")
    },
    edits: false,
    run: |job, call| open(job, call, |record, args| tables::histogram(record, whole(args, &BINS).unwrap_or(20))),
};
/// RAINFLOW.
pub static RAINFLOW: Command = Command {
    spec: &CommandSpec {
        owner: Owner::Ours,
        options: &[BINS, MEANS, CYCLES, RECORD, VALUES, MAG_USE],
        detail: "The first column is time. Cycles by the rainflow counting of ASTM E1049, with what the series does not close \
                 as half cycles; counted into bins of range, and with -MEANS of mean, of which those that hold any are listed. \
                 Opens an inner disposition menu; END returns.",
        ..spec("RAINFLOW", "rainflow cycles of columns")
    },
    edits: false,
    run: |job, call| {
        open(job, call, |record, args| {
            let bins = if args.has(&CYCLES) { 0 } else { whole(args, &BINS).unwrap_or(20) };
            tables::rainflow(record, bins, whole(args, &MEANS).unwrap_or(1))
        })
    },
};
/// HARMONIC.
pub static HARMONIC: Command = Command {
    spec: &CommandSpec {
        owner: Owner::Ours,
        options: &[PERIOD, ORDERS, LAST, RECORD, VALUES, MAG_USE],
        detail: "The first column is time. Mean, amplitudes and phases of the harmonics of a response to a regular wave, by \
                 least squares over the last whole cycles, and the root mean square of what they leave. -LAST N keeps a start \
                 from rest out. Opens an inner disposition menu; END returns.",
        ..spec("HARMONIC", "harmonics of a regular response")
    },
    edits: false,
    run: |job, call| {
        open(job, call, |record, args| {
            let asked = Analysis {
                period: args.option_number(&PERIOD),
                orders: whole(args, &ORDERS).unwrap_or(3),
                cycles: whole(args, &LAST),
            };
            tables::harmonics(record, asked)
        })
    },
};

/// A whole number given with an option.
fn whole(args: &Args, option: &OptionSpec) -> Option<usize> {
    args.option_integer(option).and_then(|n| usize::try_from(n).ok())
}

/// The record of the columns chosen, and what is to be said of the rows left out.
fn record(job: &Job, args: &Args) -> Outcome<(SeriesRecord, Option<String>)> {
    open_disposition(job, args.span)?.numeric(&selectors(&args.data)).map_err(|e| to_diagnostic(args, &e))?;
    let (table, without) = chosen_for_statistics(job, args)?;
    Ok((SeriesRecord::from_table(&table).map_err(|e| series_error(args, &e))?, without))
}

fn series_error(args: &Args, error: &SeriesError) -> Box<Diagnostic> {
    Diagnostic::error(error.to_string(), args.span)
}

/// Makes a table of the columns chosen and opens an inner menu over it.
fn open(
    job: &mut Job,
    call: &Call,
    make: impl Fn(&SeriesRecord, &Args) -> Result<Table, SeriesError>,
) -> Outcome<Effect> {
    let (record, without) = record(job, &call.args)?;
    let mut table = make(&record, &call.args).map_err(|e| series_error(&call.args, &e))?;
    table.add_notes(without);
    enter(job, table);
    Ok(Effect::Done)
}

/// Opens an inner menu over a table.
fn enter(job: &mut Job, table: Table) {
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(table))));
}

fn spectrum(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let (record, without) = record(job, args)?;
    let length = whole(args, &SEGMENT);
    let mut table = tables::density(&record, length).map_err(|e| series_error(args, &e))?;
    let moments = statistic::spectral(&record, length, job.units).map_err(|e| series_error(args, &e))?;
    job.keep_table(&moments);
    let units = job.units;
    job.say_fitted(|width| {
        let mut text = format!("{}\n\n{}", moments.title, page::grid(&moments, units, width).join("\n"));
        if let Some(without) = &without {
            text.push_str(&page::fold_text(&format!("\n\n   {without}"), width));
        }
        text
    });
    table.add_notes(without);
    enter(job, table);
    Ok(Effect::Done)
}
