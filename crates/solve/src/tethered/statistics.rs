//! Statistics and fatigue of tethers [AQWA-TETHER 7.5 to 7.10, 7.12, 7.13].

use super::Tethered;
use super::history::{TetherHistory, TetherQuantity};
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_signal::SeriesError;
use windlass_signal::tether::fatigue::{self, EndRecord, FatigueSettings};
use windlass_signal::tether::tables::{AtEnd, Channel, NodeSeries, histogram, type_one, type_two};

/// The records that statistics and fatigue are of: stored instants, and the time they stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TetherStatistics {
    /// The stored instant of the first record.
    pub first: usize,
    /// One behind that of the last.
    pub end: usize,
    /// Stored instants from one record to the next.
    pub every: usize,
    /// Time that the cycles of fatigue and the peaks are counted in (s).
    pub elapsed: f64,
    /// First and last record as [AQWA-TETHER B.3] numbers them, with the times of the steps asked for.
    records: Option<[(usize, f64); 2]>,
}

/// Steps between which statistics are processed, as cards TSTS, TSTF and TGRV count them [AQWA-TETHER B.2, B.3]: the start is step 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StatisticsSteps {
    /// First step.
    pub first: usize,
    /// Last step.
    pub last: usize,
    /// Steps from one record to the next.
    pub every: usize,
}

impl TetherStatistics {
    /// Those between two times (s), both counted.
    pub fn new(run: &Tethered, from: f64, to: f64) -> Self {
        let slack = 1e-6 * run.settings.step;
        let first = run.times.iter().position(|t| *t >= from - slack).unwrap_or(run.times.len());
        let end = run.times.iter().rposition(|t| *t <= to + slack).map_or(first, |i| i + 1).max(first);
        let time = |i: usize| run.times.get(i).copied().unwrap_or_default();
        let elapsed = time(end.saturating_sub(1)) - time(first);
        TetherStatistics { first, end, every: 1, elapsed, records: None }
    }

    /// Those between two steps. The listing of [AQWA-TETHER 8.1] has records 1, 3, 5, .. of the steps under TGRV 2 and processes "RECORDS 50
    /// (TIME= 24.75) TO 751" under TSTS 100: the window begins with the last record at or before its first step, and lasts from step to step.
    ///
    /// # Errors
    /// Steps that the run has not, or between which it kept no records of their own.
    pub fn between_steps(run: &Tethered, steps: StatisticsSteps) -> Result<Self, SeriesError> {
        let (store, every) = (run.settings.store.max(1), steps.every.max(1));
        if !every.is_multiple_of(store) {
            return Err(SeriesError::Refused(format!(
                "records are asked for every {every} steps, and the run kept every {store}: the first must be a multiple of the second"
            )));
        }
        let states = (run.times.len().max(1) - 1) * store + 1;
        let last = steps.last.min(states);
        if steps.first == 0 || steps.first > last {
            let [first, last] = [steps.first, steps.last];
            return Err(SeriesError::Refused(format!(
                "steps {first} to {last} are not of the run, which has 1 to {states}"
            )));
        }
        let record = |step: usize| (step - 1) / every;
        let time = |step: usize| (step - 1) as f64 * run.settings.step;
        let (first, end) = (record(steps.first), record(last));
        let numbered = [(first + 1, time(steps.first)), (end + 1, time(last))];
        let each = every / store;
        let elapsed = time(last) - time(steps.first);
        Ok(TetherStatistics { first: first * each, end: end * each + 1, every: each, elapsed, records: Some(numbered) })
    }

    fn pick(self, values: Vec<f64>) -> Vec<f64> {
        values.get(self.first..self.end).unwrap_or_default().iter().step_by(self.every.max(1)).copied().collect()
    }

    fn title(self, run: &Tethered, what: &str) -> String {
        if let Some([(first, from), (last, to)]) = self.records {
            return format!("{what}, Records {first} (Time {from:.2}) to {last} (Time {to:.2})");
        }
        let time = |i: usize| run.times.get(i).copied().unwrap_or_default();
        format!("{what}, {:.2} to {:.2} s", time(self.first), time(self.end.saturating_sub(1)))
    }

    /// Statistics of type 1 (7.5, 7.6, 7.12): a page for each node and each end.
    ///
    /// # Errors
    /// No instants.
    pub fn type_one(self, run: &Tethered, tether: &TetherHistory) -> Result<Vec<Table>, SeriesError> {
        let mut out = Vec::new();
        for (places, what) in [(self.nodes(tether), "Node"), (self.ends(tether), "Element")] {
            for place in &places {
                let title = format!("Statistics of Tether {}, {what} {}", tether.name, place.number);
                out.push(type_one(&self.title(run, &title), &place.as_place())?);
            }
        }
        Ok(out)
    }

    /// Statistics of type 2 (7.7, 7.8, 7.13): a page for each parameter.
    ///
    /// # Errors
    /// No instants.
    pub fn type_two(self, run: &Tethered, tether: &TetherHistory) -> Result<Vec<Table>, SeriesError> {
        let mut out = Vec::new();
        for (places, what) in [(self.nodes(tether), "Node"), (self.ends(tether), "Elem")] {
            let title = self.title(run, &format!("Statistics of Tether {}", tether.name));
            let borrowed: Vec<NodeSeries> = places.iter().map(Owned::as_place).collect();
            out.extend(type_two(&title, what, &borrowed)?);
        }
        Ok(out)
    }

    fn nodes(self, tether: &TetherHistory) -> Vec<Owned> {
        let of = tether.node_quantities();
        let place = |(node, distance): (usize, &f64)| Owned {
            number: node + 1,
            distance: *distance,
            channels: of.iter().take(12).enumerate().map(|(q, of)| (*of, self.pick(tether.node(node, q)))).collect(),
        };
        tether.line.distances().iter().enumerate().map(place).collect()
    }

    fn ends(self, tether: &TetherHistory) -> Vec<Owned> {
        let distances = tether.line.distances();
        let place = |end: usize| {
            let channels = if tether.towed { self.towed_end(tether, end) } else { self.installed_end(tether, end) };
            let distance = distances.get(end.div_ceil(2)).copied().unwrap_or_default();
            Owned { number: end / 2 + 1, distance, channels }
        };
        (0..2 * tether.line.elements().len()).map(place).collect()
    }

    /// The seven columns of figure 7.12.
    fn installed_end(self, tether: &TetherHistory, end: usize) -> Vec<(TetherQuantity, Vec<f64>)> {
        let of = tether.end_quantities();
        let reported = [0, 1, 6, 7, 8, 9, 10];
        reported.iter().filter_map(|q| Some((*of.get(*q)?, self.pick(tether.end(end, *q))))).collect()
    }

    /// The seven columns of figure 7.6: both moments, the moment where its deviation round the tube is largest, the largest stress, both
    /// stresses, the stress where its deviation is largest.
    fn towed_end(self, tether: &TetherHistory, end: usize) -> Vec<(TetherQuantity, Vec<f64>)> {
        let of = tether.end_quantities();
        let values = |q: usize| self.pick(tether.end(end, q));
        let (y, z) = (values(2), values(3));
        let turned = |angle: f64| -> Vec<f64> {
            let (sine, cosine) = angle.sin_cos();
            y.iter().zip(&z).map(|(y, z)| y * cosine + z * sine).collect()
        };
        let spread = |angle: f64| windlass_signal::tether::global::spread(&turned(angle)).1;
        let mut best = (0.0, spread(0.0));
        for step in 1..18 {
            let angle = f64::from(step * 10).to_radians();
            let found = spread(angle);
            if found > best.1 {
                best = (angle, found);
            }
        }
        let worst = turned(best.0);
        let tube = tether.line.elements().get(end / 2).map(|e| e.tube().stress_of_moment()).unwrap_or_default();
        let stress = worst.iter().map(|m| m * tube).collect();
        let named = |q: usize, name: &'static str| of.get(q).map(|q| TetherQuantity { name, ..*q });
        let list = [
            (named(2, "Y"), y.clone()),
            (named(3, "Z"), z.clone()),
            (named(3, "Max"), worst.clone()),
            (named(4, "Max"), values(4)),
            (named(5, "Y"), values(5)),
            (named(6, "Z"), values(6)),
            (named(6, "Max Sig"), stress),
        ];
        list.into_iter().filter_map(|(q, values)| Some((q?, values))).collect()
    }

    /// The histogram of stress ranges and the table of fatigue of a towed tether (7.9, 7.10). `asked.duration` is overwritten by the elapsed
    /// time of the records.
    ///
    /// # Errors
    /// Fewer than two instants; what [`fatigue::fatigue_of_ends`] refuses.
    pub fn fatigue(
        self,
        run: &Tethered,
        tether: &TetherHistory,
        asked: FatigueSettings,
    ) -> Result<[Table; 2], SeriesError> {
        let duration = self.elapsed;
        let count = 2 * tether.line.elements().len();
        let moments: Vec<[Vec<f64>; 2]> = (0..count).map(|end| [2, 3].map(|q| self.pick(tether.end(end, q)))).collect();
        let tube = |end: usize| tether.line.elements().get(end / 2).map(|e| e.tube().stress_of_moment());
        let records: Vec<EndRecord> = moments
            .iter()
            .enumerate()
            .map(|(end, [y, z])| EndRecord { about_y: y, about_z: z, stress_of_moment: tube(end).unwrap_or_default() })
            .collect();
        let found = fatigue::fatigue_of_ends(&records, FatigueSettings { duration, ..asked })?;
        let distance = |end: usize| tether.line.distances().get(end.div_ceil(2)).copied().unwrap_or_default();
        let ends: Vec<AtEnd> = found.into_iter().enumerate().map(|(end, f)| (end / 2 + 1, distance(end), f)).collect();
        let title = |what: &str| self.title(run, &format!("{what} of Tether {}", tether.name));
        let mut table = windlass_signal::tether::tables::fatigue(&title("Fatigue and Peak Stress"), &ends)
            .fact("Elapsed Time", duration, Dim::Time)
            .fact("Stress Concentration Factor", asked.curve.concentration, Dim::None)
            .fact("S-N Curve Intercept A", asked.curve.in_unit(1e-3).intercept, Dim::None)
            .fact("S-N Curve Slope m", asked.curve.slope, Dim::None)
            .fact("Time of Expected Peak", asked.peak_time / 3600.0, Dim::None);
        table.note(
            "the expected peak is of the time of expected peaks, in hours; the intercept is for stresses in kN/m2",
        );
        Ok([histogram(&title("Stress Ranges, Half Cycles,"), &ends), table])
    }
}

/// A place with its series.
struct Owned {
    number: usize,
    distance: f64,
    channels: Vec<(TetherQuantity, Vec<f64>)>,
}

impl Owned {
    fn as_place(&self) -> NodeSeries<'_> {
        NodeSeries {
            number: self.number,
            distance: self.distance,
            channels: self
                .channels
                .iter()
                .map(|(of, values)| Channel { group: of.group, name: of.name, dim: of.dim, digits: of.digits, values })
                .collect(),
        }
    }
}
