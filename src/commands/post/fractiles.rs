//! `CF_FRACTILES` of the PRCPOST menu: forces of connectors that are not exceeded a share of the time.

use crate::commands::Command;
use crate::commands::post::prcpost::{CONNECTORS, EVENTS, MAG_DEFINE, PostQuery, asked_behind_transient, show, spec};
use windlass_base::diagnostic::Outcome;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::Given;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_solve::results;

/// CF_FRACTILES.
pub static CF_FRACTILES: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

/// A force below this (N) is rounding of sums that cancel, as on the end of a line that was released, and counts as zero.
const MIN_FORCE_N: f64 = 1e-9;
/// Shares of the time where none are given (per cent).
const DEFAULT_PERCENT: [f64; 4] = [50.0, 90.0, 99.0, 99.9];

const PERCENT: OptionSpec = OptionSpec::new(
    "-PERCENT",
    &[ValueSpec::new("P", Kind::Number(Dim::None), "share of the time").in_range(0.0, 100.0)],
    "shares of the time, in per cent",
)
.repeating(1)
.default("50 90 99 99.9")
.owner(Owner::Ours);

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    options: &[EVENTS, MAG_DEFINE, PERCENT],
    detail: "Of each connector the mean, standard deviation and largest magnitude of the force on its first end on a body, and the \
             magnitudes that are not exceeded for a share of the time. Each stored instant counts alike, but those before TTRA_SET; between \
             two of them in order of size a fractile lies on the straight line. These are shares of the time, not of the maxima: EXTREMES and \
             EXCEEDANCE of the disposition menu are about maxima.",
    example: "MEDIT\n&DESCRIBE BODY BUOY -IGNORE Z RX RY RZ\n*P 0 0 0\n#WEIGHT *P 2000 10 10 10\n~W B_CAT 4 -LEN 4000 -DEP 500\n\
              CONNECTOR A -ANC 0 3900 ~W *P\nCONNECTOR B -ANC 180 3900 ~W *P\nEND\n&INSTATE -LOCATE BUOY 5\n&ENV -TIME 60 1\n\
              TDOM\nPRCPOST\nCF_FRACTILES -PERCENT 50 95\nREPORT\nEND\nEND",
    ..spec("CF_FRACTILES", CONNECTORS, "force magnitudes not exceeded a share of the time")
};

/// A connector and its forces (N), the smallest first; none where it never acts.
struct ForceRecord {
    name: String,
    sorted: Vec<f64>,
}

fn build(query: &PostQuery) -> Outcome<Table> {
    let events = asked_behind_transient(query.job, query.args())?.1;
    let series = query.to_outcome(results::magnitudes(query.run, &query.connectors()?, query.magnitude(), &events))?;
    // the first column is the time
    let records = series.columns().iter().skip(1).map(|column| ForceRecord::new(column.name.clone(), column.numbers()));
    let percent = query.args().option(&PERCENT).map_or(DEFAULT_PERCENT.to_vec(), Given::numbers);
    let mut table = fractile_table(&records.collect::<Vec<_>>(), &percent, events.len());
    table.add_notes(series.notes);
    Ok(table)
}

fn fractile_table(records: &[ForceRecord], percent: &[f64], instants: usize) -> Table {
    let mut table = Table::new("Fractiles of Connector Forces")
        .fact("Instants", instants, Dim::None)
        .with_rows(records)
        .text("Name", |record| &record.name)
        .column("Force Magnitude", "Mean", Dim::Force, Digits::Usual, |record| record.mean())
        .column("Force Magnitude", "Std. Dev.", Dim::Force, Digits::Usual, |record| record.deviation())
        .build();
    for percent in percent {
        table = table
            .with_rows(records)
            .column("Not Exceeded", &format!("{percent} %"), Dim::Force, Digits::Usual, |record| {
                record.fractile(0.01 * percent)
            })
            .build();
    }
    table
        .with_rows(records)
        .column("Force Magnitude", "Max.", Dim::Force, Digits::Usual, |record| record.sorted.last().copied())
        .build()
}

impl ForceRecord {
    fn new(name: String, mut forces: Vec<f64>) -> Self {
        forces.iter_mut().filter(|force| **force < MIN_FORCE_N).for_each(|force| *force = 0.0);
        forces.sort_by(f64::total_cmp);
        ForceRecord { name, sorted: forces }
    }

    /// Reckoned from the least: of equal forces it is that force to the last digit, and they deviate by nothing.
    fn mean(&self) -> Option<f64> {
        let least = self.sorted.first()?;
        Some(least + self.sorted.iter().map(|force| force - least).sum::<f64>() / self.sorted.len() as f64)
    }

    fn deviation(&self) -> Option<f64> {
        let mean = self.mean()?;
        Some((self.sorted.iter().map(|t| (t - mean).powi(2)).sum::<f64>() / self.sorted.len() as f64).sqrt())
    }

    /// The force that is not exceeded a share of the time (0..1): straight between the values in order, the first of which is at a
    /// share of 0 and the last at 1.
    fn fractile(&self, share: f64) -> Option<f64> {
        let at = share.clamp(0.0, 1.0) * self.sorted.len().checked_sub(1)? as f64;
        let below = self.sorted.get(at.floor() as usize)?;
        let above = self.sorted.get(at.ceil() as usize)?;
        Some(below + at.fract() * (above - below))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(forces: Vec<f64>) -> ForceRecord {
        ForceRecord::new("A".into(), forces)
    }

    fn assert_near(got: Option<f64>, want: f64, tolerance: f64) {
        assert!(got.is_some_and(|got| (got - want).abs() <= tolerance), "{got:?} is not {want}");
    }

    #[test]
    fn fractiles_match_numpy() {
        // numpy.percentile([15, 20, 35, 40, 50], [5, 30, 40, 95]) = 16, 23, 29, 48
        let record = record(vec![35.0, 15.0, 50.0, 40.0, 20.0]);
        for (percent, want) in [(0.0, 15.0), (5.0, 16.0), (30.0, 23.0), (40.0, 29.0), (95.0, 48.0), (100.0, 50.0)] {
            assert_near(record.fractile(0.01 * percent), want, 1e-12);
        }
        assert_near(record.mean(), 32.0, 1e-12);
        // numpy.std of the same
        assert_near(record.deviation(), 12.884_098_726_725_126, 1e-12);
        assert_eq!(self::record(Vec::new()).fractile(0.5), None);
    }

    #[test]
    fn equal_forces_have_no_deviation() {
        let record = record(vec![146.387_123_456_789; 33]);
        assert_eq!((record.mean(), record.deviation()), (Some(146.387_123_456_789), Some(0.0)));
    }

    #[test]
    fn rounding_of_released_line_counts_as_zero() {
        let record = record(vec![2.0, 9e-17, 0.0, 4.0]);
        assert_eq!(
            (record.fractile(0.0), record.fractile(1.0 / 3.0), record.mean()),
            (Some(0.0), Some(0.0), Some(1.5))
        );
    }

    #[test]
    fn fractiles_of_harmonic_force_follow_arcsine_law() {
        // a sine is below -cos(pi q) a share q of the time; 10,000 instants of a whole cycle leave 1e-4 of the slope there
        let record =
            record((0..10_000).map(|i| 5.0 + 2.0 * (std::f64::consts::TAU * f64::from(i) / 1e4).sin()).collect());
        for share in [0.5, 0.9, 0.99, 0.999] {
            assert_near(record.fractile(share), 5.0 - 2.0 * (std::f64::consts::PI * share).cos(), 1e-3);
        }
        assert_near(record.deviation(), 2f64.sqrt(), 1e-9);
    }
}
