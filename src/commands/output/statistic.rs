//! `STATISTIC` of the disposition menu: what columns amount to.
//!
//! Source: [MOSES-REF disp_men]. The independent column, the cycles and the options of ours are described in
//! its help.

use crate::commands::output::disposition::{ANY_COLUMN, BOTH, COLUMN, HARD, MAG_USE, RECORD, VALUES, WIDE};
use crate::commands::output::disposition::{
    chosen_for_statistics, open_disposition, selectors, send, spec, to_diagnostic,
};
use crate::commands::output::result::{KEEP, keep_statistics};
use crate::commands::{Call, Command, Effect, Job};
use crate::report::{page, statistic};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_signal::SeriesError;

/// STATISTIC.
pub static STATISTIC: Command = Command { spec: &SPEC, edits: false, run: statistics };

const DURATION: OptionSpec = OptionSpec::new(
    "-DURATION",
    &[ValueSpec::new("HOURS", Kind::Number(Dim::None), "hours").positive()],
    "largest and smallest value in this time, by Rayleigh",
)
.owner(Owner::Ours);
const PEAKS: OptionSpec =
    OptionSpec::new("-PEAKS", &[], "lists the maxima and minima between crossings of the mean").owner(Owner::Ours);

static SPEC: CommandSpec = CommandSpec {
    data: &[COLUMN, ANY_COLUMN],
    repeat: 1,
    options: &[RECORD, VALUES, HARD, BOTH, WIDE, MAG_USE, DURATION, PEAKS, KEEP],
    detail: "The first column is the independent one; the extremes are given with their place in it. Kurtosis is the excess \
             over 3. Where the independent column grows, cycles are counted from an up-crossing of the mean to the next: \
             Period is their mean length, 1/3 Range the mean of the highest third of their crest-to-trough ranges \
             (of a wave record its significant height), 1/10 Range that of the highest tenth. 2 Std. Dev. is the significant \
             single amplitude of a Gaussian process. Of a run the rows before TTRA_SET of &ENV -TIME are left out, as TDOM leaves them \
             out of its own statistics, unless -EVENTS, -RECORD or -VALUES choose. -DURATION needs a column of time; EXTREMES fits distributions. -RESULT keeps NAME_MEAN, \
             NAME_SD, NAME_MIN and NAME_MAX.",
    ..spec("STATISTIC", "mean, deviation, extremes and cycles of columns")
};
fn statistics(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    open_disposition(job, args.span)?.numeric(&selectors(&args.data)).map_err(|e| to_diagnostic(args, &e))?;
    let (table, without) = chosen_for_statistics(job, args)?;
    let count = table.columns().len();
    let (independent, described) = if count > 1 { (Some(0), (1..count).collect()) } else { (None, vec![0]) };
    let mut parts = vec![statistic::in_units(&table, independent, &described, job.units)];
    let wrong = |e: SeriesError| Diagnostic::error(e.to_string(), args.span);
    parts.push(statistic::cycles(&table, job.units).map_err(wrong)?);
    if let Some(given) = args.option(&DURATION) {
        let duration = 3600.0 * given.first_number().unwrap_or_default();
        let refused = |e: SeriesError| Diagnostic::error(e.to_string(), given.span);
        parts.push(statistic::expected_extremes(&table, duration, job.units).map_err(refused)?);
    }
    if args.has(&PEAKS) {
        parts.push(statistic::peaks(&table).map_err(wrong)?);
    }
    if let Some(described) = parts.first() {
        keep_statistics(job, args, described)?;
    }
    parts.iter().for_each(|table| job.keep_table(table));
    let units = job.units;
    send(job, args, |width| {
        let text = |t: &Table| format!("{}\n\n{}", t.title, page::grid(t, units, width).join("\n"));
        let mut text = parts.iter().map(text).collect::<Vec<_>>().join("\n\n");
        if let Some(without) = &without {
            text.push_str(&page::fold_text(&format!("\n\n   {without}"), width));
        }
        text
    })?;
    Ok(Effect::Done)
}
