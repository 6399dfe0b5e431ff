//! Statistics and fatigue of tethers [AQWA-TETHER 7.5 to 7.10, 7.12, 7.13].

use super::Tethered;
use super::history::{TetherHistory, TetherQuantity};
use windlass_base::table::{Digits, Fact, Table};
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
        let elapsed = match &run.times[first..end] {
            [from, .., to] => to - from,
            _ => 0.0,
        };
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
        let time = |step: usize| run.settings.time(step - 1);
        let (first, end) = (record(steps.first), record(last));
        let numbered = [(first + 1, time(steps.first)), (end + 1, time(last))];
        let each = every / store;
        let elapsed = time(last) - time(steps.first);
        Ok(TetherStatistics { first: first * each, end: end * each + 1, every: each, elapsed, records: Some(numbered) })
    }

    fn pick(self, values: Vec<f64>) -> Vec<f64> {
        values.get(self.first..self.end).unwrap_or_default().iter().step_by(self.every.max(1)).copied().collect()
    }

    /// A page with the records that it is of, as the listing has them.
    fn with_records(self, run: &Tethered, mut table: Table) -> Table {
        let text = match self.records {
            Some([(first, from), (last, to)]) => format!("{first} (TIME= {from:.2}) TO {last} (TIME= {to:.2})"),
            None => match &run.times[self.first..self.end] {
                [] => "NONE".to_string(),
                [one] => format!("TIME= {one:.2} TO TIME= {one:.2}"),
                [from, .., to] => format!("TIME= {from:.2} TO TIME= {to:.2}"),
            },
        };
        let fact = Fact {
            name: "RECORDS PROCESSED".into(),
            value: text.as_str().into(),
            dim: Dim::None,
            digits: Digits::Usual,
        };
        table.facts.insert(0, fact);
        table
    }

    /// Statistics of type 1 [AQWA-TETHER 7.5, 7.6, 7.12]: for each node a page of positions, of velocities and of accelerations, and a page for each end of an element.
    ///
    /// # Errors
    /// No instants.
    pub fn type_one(self, run: &Tethered, tether: &TetherHistory) -> Result<Vec<Table>, SeriesError> {
        let mut out = Vec::new();
        let title = format!("Tether {} Statistics", tether.name);
        let heads =
            if tether.towed { ["SWAY (Y)", "HEAVE (Z)", "PITCH (Y)", "YAW (Z)"] } else { ["X", "Y", "RX", "RY"] };
        for node in self.nodes(tether) {
            let position = node.as_place();
            for motion in position.channels.chunks(4) {
                let named = motion.iter().zip(heads);
                let channels =
                    named.map(|(c, name)| Channel { group: "", name, digits: Digits::Decimals(4), ..*c }).collect();
                let group = motion.first().map_or("", |channel| channel.group);
                let title = format!("{title}: Node {} - {group}", position.number);
                out.push(self.with_records(run, type_one(&title, &NodeSeries { channels, ..position.clone() })?));
            }
        }
        let what = if tether.towed { "Bending Moments and Stresses" } else { "Tensions and Stresses" };
        for end in self.ends(tether) {
            let title = format!("{title}: Element {} - {what}", end.number);
            let position = end.with_digits(Digits::Scientific(5));
            out.push(self.with_records(run, type_one(&title, &position.as_place())?));
        }
        Ok(out)
    }

    /// Statistics of type 2 [AQWA-TETHER 7.7, 7.8, 7.13]: a page for each parameter, of nodes and of ends.
    ///
    /// # Errors
    /// No instants.
    pub fn type_two(self, run: &Tethered, tether: &TetherHistory) -> Result<Vec<Table>, SeriesError> {
        let title = format!("Tether {} Statistics", tether.name);
        let nodes: Vec<Owned> =
            self.nodes(tether).into_iter().map(|node| node.with_digits(Digits::Decimals(3))).collect();
        let of_nodes: Vec<NodeSeries> = nodes.iter().map(Owned::as_place).collect();
        let ends = self.ends(tether);
        let of_ends: Vec<NodeSeries> = ends.iter().map(Owned::as_place).collect();
        let pages = [type_two(&title, "NODE", &of_nodes)?, type_two(&title, "ELEM", &of_ends)?];
        // the listing has the two pages of a parameter together
        let [nodes, ends] = pages.map(Vec::into_iter);
        Ok(nodes.zip(ends).flat_map(|(one, other)| [one, other]).map(|page| self.with_records(run, page)).collect())
    }

    fn nodes(self, tether: &TetherHistory) -> Vec<Owned> {
        let of = tether.node_quantities();
        let position = |(node, distance): (usize, &f64)| Owned {
            number: node + 1,
            distance: *distance,
            channels: of.iter().take(12).enumerate().map(|(q, of)| (*of, self.pick(tether.node(node, q)))).collect(),
        };
        tether.line.distances().iter().enumerate().map(position).collect()
    }

    fn ends(self, tether: &TetherHistory) -> Vec<Owned> {
        // an element has two ends: the first at its node, the second at the next
        let distances = tether.line.distances();
        let position = |end: usize| {
            let channels = if tether.towed { self.towed_end(tether, end) } else { self.installed_end(tether, end) };
            let distance = distances[end.div_ceil(2)];
            Owned { number: end / 2 + 1, distance, channels }
        };
        (0..2 * tether.line.elements().len()).map(position).collect()
    }

    /// The seven columns of figure 7.12.
    fn installed_end(self, tether: &TetherHistory, end: usize) -> Vec<(TetherQuantity, Vec<f64>)> {
        let of = tether.end_quantities();
        let reported = [
            (0, "EFFECTIVE TENSION"),
            (1, "WALL TENSION"),
            (6, "SHEAR STRESS"),
            (7, "MAX BND + AXL STRESS"),
            (8, "MIN BND + AXL STRESS"),
            (9, "VON MISES STRESS"),
            (10, "Y BENDING STRESS"),
        ];
        let named = |(q, name): (usize, &'static str)| {
            let quantity = TetherQuantity { group: "", name, ..*of.get(q)? };
            Some((quantity, self.pick(tether.end(end, q))))
        };
        reported.into_iter().filter_map(named).collect()
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
        let tube = tether.line.elements()[end / 2].tube().stress_of_moment();
        let stress = worst.iter().map(|m| m * tube).collect();
        let named = |q: usize, name: &'static str| of.get(q).map(|q| TetherQuantity { group: "", name, ..*q });
        let list = [
            (named(2, "Y (LATERAL) BND MOMENT"), y.clone()),
            (named(3, "Z (VERTICAL) BND MOMENT"), z.clone()),
            (named(3, "MAXIMUM BND MOMENT"), worst.clone()),
            (named(4, "MAX BND STRESS"), values(4)),
            (named(5, "Y (LAT) BND STRESS"), values(5)),
            (named(6, "Z (VER) BND STRESS"), values(6)),
            (named(6, "MAX SG BND STRESS"), stress),
        ];
        list.into_iter().filter_map(|(q, values)| Some((q?, values))).collect()
    }

    /// The histogram of stress ranges and the table of fatigue of a towed tether [AQWA-TETHER 7.9, 7.10]. `asked.duration` is overwritten by the elapsed
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
        let tube = |end: usize| tether.line.elements()[end / 2].tube().stress_of_moment();
        let records: Vec<EndRecord> = moments
            .iter()
            .enumerate()
            .map(|(end, [y, z])| EndRecord { about_y: y, about_z: z, stress_of_moment: tube(end) })
            .collect();
        let found = fatigue::fatigue_of_ends(&records, FatigueSettings { duration, ..asked })?;
        let distance = |end: usize| tether.line.distances()[end.div_ceil(2)];
        let ends: Vec<AtEnd> = found.into_iter().enumerate().map(|(end, f)| (end / 2 + 1, distance(end), f)).collect();
        let title = |what: &str| format!("{what} of Tether {}", tether.name);
        let four = Digits::Decimals(4);
        let hours = asked.peak_time / 3600.0;
        let mut table =
            windlass_signal::tether::tables::fatigue(&title("Fatigue Analysis and Maximum Stress"), &ends, hours)
                .fact_with_digits("Elapsed time", duration, Dim::Time, Digits::Decimals(3))
                .fact_with_digits("Stress Cutoff value (S0)", 0.0, Dim::None, Digits::Scientific(5))
                .fact_with_digits("Stress concentration factor", asked.curve.concentration, Dim::None, four)
                .fact_with_digits(
                    "SN curve intercept coefficient A",
                    asked.curve.in_unit(1e-3).intercept,
                    Dim::None,
                    Digits::Scientific(5),
                )
                .fact_with_digits("SN curve slope-m", asked.curve.slope, Dim::None, four)
                .fact_with_digits("Thickness Effect Value", 0.0, Dim::None, four);
        table.note("the intercept is for stresses in kN/m2; there is no cutoff and no effect of thickness");
        let ranges = histogram(&title("Stress Range Probability Distribution (1/2 Cycles)"), &ends);
        Ok([ranges, table].map(|page| self.with_records(run, page)))
    }
}

/// A place with its series.
struct Owned {
    number: usize,
    distance: f64,
    channels: Vec<(TetherQuantity, Vec<f64>)>,
}

impl Owned {
    /// The same with other digits.
    fn with_digits(mut self, digits: Digits) -> Self {
        self.channels.iter_mut().for_each(|(of, _)| of.digits = digits);
        self
    }

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
