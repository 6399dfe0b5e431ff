//! Records of many finished cases, held small: what cases share (columns, names and units of results, files read, texts of cells) is there
//! once, and a case has its numbers and little else. A case with five inputs and ten results takes about 300 bytes, as a [`CaseRecord`] with the tables made of it 6 kB.

use crate::kept::{KeptResult, LineAnalysis, LineRow, LineVerdict, LossTime, MooringCondition, SeedCheck};
use crate::record::{CaseRecord, CaseStatus, FileRead, FollowedCase, LinePeaks};
use crate::stiffness::{CaseStiffness, STIFFNESS};
use indexmap::{IndexMap, IndexSet};
use std::ops::Range;

/// What many cases of a study share.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Frame {
    columns: Vec<String>,
    /// Names, units and whether they are least ones.
    results: Vec<(String, String, bool)>,
    title: String,
    units: Option<(String, String)>,
    caveats: Vec<String>,
    read: Vec<FileRead>,
    version: String,
    start: u64,
}

/// What of a row of a line is no number.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct LineFrame {
    line: String,
    segment: Option<usize>,
    analysis: Option<LineAnalysis>,
    condition: MooringCondition,
    lost: Vec<String>,
    verdict: Option<LineVerdict>,
    code: Option<String>,
    factor_source: Option<String>,
    uplift: Option<bool>,
    anchor_verdict: Option<LineVerdict>,
    fatigue_confirmed: Option<bool>,
}

/// A row of a line.
#[derive(Clone, Debug)]
struct SmallLine {
    frame: u32,
    /// Which of [`LineRow::numbers_mut`] are there, a bit each, the first the lowest.
    present: u32,
    /// Those that are.
    numbers: Box<[f64]>,
    maxima: Option<usize>,
    loss: Option<Box<LossTime>>,
    seeds: Option<u32>,
}

/// What few cases have.
#[derive(Clone, Debug, Default)]
struct Rare {
    reason: String,
    messages: Vec<String>,
    peaks: Vec<LinePeaks>,
    intact: Option<FollowedCase>,
}

/// A case. Its name, cells and results stand behind those of others: small pieces of memory of their own among those that a decoded record
/// gives back would make each allocation a search.
#[derive(Clone, Debug)]
pub(crate) struct SmallRecord {
    /// Where its name is in [`Records::names`].
    case: Range<usize>,
    frame: u32,
    status: CaseStatus,
    seed: u64,
    seconds: f64,
    /// Where the places of the texts of its cells are in [`Records::cell_places`].
    cells: Range<usize>,
    /// Where the values of its results are in [`Records::results`].
    results: Range<usize>,
    lines: Box<[SmallLine]>,
    rare: Option<Box<Rare>>,
}

/// Records of finished cases, in an order.
#[derive(Clone, Debug, Default)]
pub struct Records {
    frames: IndexSet<Frame>,
    line_frames: IndexSet<LineFrame>,
    /// By their text.
    seeds: IndexMap<String, SeedCheck>,
    cells: IndexSet<Box<str>>,
    /// Names of all cases, one behind the other.
    names: String,
    /// Places in `cells`, those of a record together.
    cell_places: Vec<u32>,
    /// Values of results, those of a record together.
    results: Vec<f64>,
    rows: Vec<SmallRecord>,
    /// The frame of the record that came last.
    last_frame: u32,
}

/// A record among others.
#[derive(Clone, Copy, Debug)]
pub struct RecordView<'a> {
    all: &'a Records,
    frame: &'a Frame,
    row: &'a SmallRecord,
}

/// The place of a thing among those that are shared; it is added where it is new. 2^32 of one kind do not fit in the memory of any machine.
fn place_in<T: std::hash::Hash + Eq>(all: &mut IndexSet<T>, value: T) -> u32 {
    u32::try_from(all.insert_full(value).0).unwrap_or(u32::MAX)
}

impl Records {
    /// A record made small; [`Records::set_rows`] takes it up.
    pub(crate) fn compact(&mut self, record: CaseRecord) -> SmallRecord {
        let CaseRecord {
            case,
            values,
            seed,
            status,
            reason,
            title,
            units,
            seconds,
            messages,
            caveats,
            results,
            lines,
            peaks,
            intact,
            read,
            version,
            start,
        } = record;
        let (columns, texts): (Vec<String>, Vec<String>) = values.into_iter().unzip();
        let first_cell = self.cell_places.len();
        self.cell_places.extend(texts.into_iter().map(|text| match self.cells.get_index_of(text.as_str()) {
            Some(known) => u32::try_from(known).unwrap_or(u32::MAX),
            None => place_in(&mut self.cells, text.into_boxed_str()),
        }));
        let first_result = self.results.len();
        self.results.extend(results.iter().map(|result| result.value));
        let first_letter = self.names.len();
        self.names.push_str(&case);
        let heads = results.into_iter().map(|KeptResult { name, unit, is_least, value: _ }| (name, unit, is_least));
        let frame = Frame { columns, results: heads.collect(), title, units, caveats, read, version, start };
        let rare = Rare { reason, messages, peaks, intact };
        let is_plain =
            rare.reason.is_empty() && rare.messages.is_empty() && rare.peaks.is_empty() && rare.intact.is_none();
        // most records share all of it with the one before them
        if self.frames.get_index(self.last_frame as usize) != Some(&frame) {
            self.last_frame = place_in(&mut self.frames, frame);
        }
        SmallRecord {
            case: first_letter..self.names.len(),
            frame: self.last_frame,
            status,
            seed,
            seconds,
            cells: first_cell..self.cell_places.len(),
            results: first_result..self.results.len(),
            lines: lines.into_iter().map(|row| self.compact_line(row)).collect(),
            rare: (!is_plain).then(|| Box::new(rare)),
        }
    }

    fn compact_line(&mut self, mut row: LineRow) -> SmallLine {
        let (mut present, mut numbers) = (0, Vec::new());
        for (bit, number) in row.numbers_mut().into_iter().enumerate() {
            if let Some(number) = number.take() {
                present |= 1 << bit;
                numbers.push(number);
            }
        }
        let frame = LineFrame {
            line: row.line,
            segment: row.segment,
            analysis: row.analysis,
            condition: row.condition,
            lost: row.lost,
            verdict: row.verdict,
            code: row.code,
            factor_source: row.factor_source,
            uplift: row.uplift,
            anchor_verdict: row.anchor_verdict,
            fatigue_confirmed: row.fatigue_confirmed,
        };
        SmallLine {
            frame: place_in(&mut self.line_frames, frame),
            present,
            numbers: numbers.into_boxed_slice(),
            maxima: row.maxima,
            loss: row.loss,
            seeds: row.seeds.map(|seeds| {
                let text = serde_json::to_string(&*seeds).unwrap_or_default();
                u32::try_from(self.seeds.insert_full(text, *seeds).0).unwrap_or(u32::MAX)
            }),
        }
    }

    /// Takes up records that [`Records::compact`] of this one has made, in their order.
    pub(crate) fn set_rows(&mut self, rows: impl Iterator<Item = SmallRecord>) {
        self.rows = rows.collect();
    }

    /// Adds a record.
    pub fn push(&mut self, record: CaseRecord) {
        let row = self.compact(record);
        self.rows.push(row);
    }

    /// How many records there are.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The record at a place.
    pub fn get(&self, place: usize) -> Option<RecordView<'_>> {
        self.rows.get(place).and_then(|row| self.view(row))
    }

    /// The records, in their order.
    pub fn iter(&self) -> impl Iterator<Item = RecordView<'_>> + Clone {
        self.rows.iter().filter_map(|row| self.view(row))
    }

    /// The record of a case.
    pub fn of_case(&self, name: &str) -> Option<RecordView<'_>> {
        self.iter().find(|record| record.case() == name)
    }

    fn view<'a>(&'a self, row: &'a SmallRecord) -> Option<RecordView<'a>> {
        let frame = self.frames.get_index(row.frame as usize)?;
        Some(RecordView { all: self, frame, row })
    }

    /// The texts of all cells, each once.
    pub fn cells(&self) -> impl Iterator<Item = &str> {
        self.cells.iter().map(|text| &**text)
    }
}

impl FromIterator<CaseRecord> for Records {
    fn from_iter<I: IntoIterator<Item = CaseRecord>>(records: I) -> Self {
        let mut made = Records::default();
        records.into_iter().for_each(|record| made.push(record));
        made
    }
}

impl<'a> RecordView<'a> {
    /// Name of the case.
    pub fn case(&self) -> &'a str {
        self.all.names.get(self.row.case.clone()).unwrap_or_default()
    }

    /// Its seed.
    pub fn seed(&self) -> u64 {
        self.row.seed
    }

    /// How it ended.
    pub fn status(&self) -> CaseStatus {
        self.row.status
    }

    /// Why it failed; empty of others.
    pub fn reason(&self) -> &'a str {
        self.row.rare.as_ref().map_or("", |rare| &rare.reason)
    }

    /// Seconds of the clock that it took.
    pub fn seconds(&self) -> f64 {
        self.row.seconds
    }

    /// Errors and warnings.
    pub fn messages(&self) -> &'a [String] {
        self.row.rare.as_ref().map_or(&[], |rare| &rare.messages)
    }

    /// Which start of the study it is of.
    pub fn start(&self) -> u64 {
        self.frame.start
    }

    /// Labels of the units of length and of force that its script uses.
    pub fn units(&self) -> Option<&'a (String, String)> {
        self.frame.units.as_ref()
    }

    /// Columns of its row.
    pub fn columns(&self) -> &'a [String] {
        &self.frame.columns
    }

    /// Columns and values of its row.
    pub fn values(&self) -> impl Iterator<Item = (&'a str, &'a str)> + Clone + use<'a> {
        let all = self.all;
        let cell = move |place: &u32| all.cells.get_index(*place as usize).map_or("", |text| &**text);
        let places = all.cell_places.get(self.row.cells.clone()).unwrap_or_default();
        self.frame.columns.iter().map(String::as_str).zip(places.iter().map(cell))
    }

    /// Its named results: names and values.
    pub fn results(&self) -> impl Iterator<Item = (&'a (String, String, bool), f64)> + Clone + use<'a> {
        let values = self.all.results.get(self.row.results.clone()).unwrap_or_default();
        self.frame.results.iter().zip(values.iter().copied())
    }

    /// Whether it has the same columns, results, files and version as another, so that what is found of them holds for both.
    pub fn is_like(&self, other: &RecordView) -> bool {
        std::ptr::eq(self.frame, other.frame)
    }

    /// How many rows of lines it has.
    pub fn line_count(&self) -> usize {
        self.row.lines.len()
    }

    /// Its rows of lines.
    pub fn lines(&self) -> impl Iterator<Item = LineRow> + Clone + use<'a> {
        let all = self.all;
        self.row.lines.iter().filter_map(move |line| {
            let LineFrame {
                line: name,
                segment,
                analysis,
                condition,
                lost,
                verdict,
                code,
                factor_source,
                uplift,
                anchor_verdict,
                fatigue_confirmed,
            } = all.line_frames.get_index(line.frame as usize)?.clone();
            let mut row = LineRow {
                line: name,
                segment,
                analysis,
                condition,
                lost,
                loss: line.loss.clone(),
                seeds: line.seeds.and_then(|at| all.seeds.get_index(at as usize)).map(|(_, of)| Box::new(of.clone())),
                maxima: line.maxima,
                verdict,
                code,
                factor_source,
                uplift,
                anchor_verdict,
                fatigue_confirmed,
                ..LineRow::default()
            };
            let mut numbers = line.numbers.iter();
            for (bit, number) in row.numbers_mut().into_iter().enumerate() {
                if line.present & (1 << bit) != 0 {
                    *number = numbers.next().copied();
                }
            }
            Some(row)
        })
    }

    /// Peaks of the lines that transient cases lose.
    pub fn peaks(&self) -> &'a [LinePeaks] {
        self.row.rare.as_ref().map_or(&[], |rare| &rare.peaks)
    }

    /// The intact case that it has followed.
    pub fn intact(&self) -> Option<&'a FollowedCase> {
        self.row.rare.as_ref().and_then(|rare| rare.intact.as_ref())
    }

    /// What it has read.
    pub fn read(&self) -> &'a [FileRead] {
        &self.frame.read
    }

    /// Version of the program that has made it.
    pub fn version(&self) -> &'a str {
        &self.frame.version
    }

    /// Whether tensions are judged by it, as [`CaseRecord::judges_tension`] has it.
    pub fn judges_tension(&self) -> bool {
        let cell = self.values().find(|(name, _)| name.eq_ignore_ascii_case(STIFFNESS)).map(|(_, cell)| cell);
        cell.and_then(|cell| CaseStiffness::parse(cell).ok()) != Some(CaseStiffness::Lower)
    }

    /// What a transient case that follows this one keeps of it.
    pub fn followed(&self) -> FollowedCase {
        FollowedCase::new(self.case(), self.status(), self.peaks())
    }

    /// The whole record.
    pub fn to_record(&self) -> CaseRecord {
        let owned = |(name, value): (&str, &str)| (name.to_owned(), value.to_owned());
        let result = |((name, unit, is_least), value): (&(String, String, bool), f64)| KeptResult {
            name: name.clone(),
            value,
            unit: unit.clone(),
            is_least: *is_least,
        };
        CaseRecord {
            case: self.case().to_owned(),
            values: self.values().map(owned).collect(),
            seed: self.seed(),
            status: self.status(),
            reason: self.reason().to_owned(),
            title: self.frame.title.clone(),
            units: self.frame.units.clone(),
            seconds: self.seconds(),
            messages: self.messages().to_vec(),
            caveats: self.frame.caveats.clone(),
            results: self.results().map(result).collect(),
            lines: self.lines().collect(),
            peaks: self.peaks().to_vec(),
            intact: self.intact().cloned(),
            read: self.frame.read.clone(),
            version: self.frame.version.clone(),
            start: self.frame.start,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Peak;

    #[test]
    fn records_come_back_as_they_were_put_in() {
        let line = |n: usize| LineRow {
            line: format!("L{n}"),
            segment: Some(n),
            analysis: Some(LineAnalysis::Dynamic),
            lost: vec!["L9".into()],
            loss: (n == 2).then(|| Box::new(LossTime { number: 1, time: 4.5, reason: "largest".into() })),
            maxima: Some(40),
            mean_tension: Some(1.5),
            mpm: (n == 1).then_some(f64::MIN_POSITIVE),
            offset: Some(-0.0),
            verdict: Some(LineVerdict::Fail),
            code: Some("C".into()),
            uplift: Some(true),
            design_life: Some(20.0),
            fatigue_confirmed: Some(n == 1),
            seeds: (n == 2).then(|| {
                Box::new(SeedCheck {
                    mean: -0.4,
                    characteristic: 1.5,
                    added: 0.1,
                    storm_ratio: 3.0,
                    statistic: crate::kept::SeedStatistic::MeanPlus(vec![(5, 0.6)]),
                    is_confirmed: true,
                })
            }),
            ..LineRow::default()
        };
        let record = |n: usize, more: bool| CaseRecord {
            case: format!("C{n}"),
            values: vec![("HS".into(), "9".into()), ("W".into(), n.to_string())],
            seed: n as u64,
            status: CaseStatus::Overloaded,
            units: Some(("m".into(), "kN".into())),
            seconds: n as f64 / 3.0,
            caveats: vec!["quick".into()],
            results: vec![
                KeptResult::new("T", n as f64, "kN").unwrap(),
                KeptResult::new("C", 0.1, "m").unwrap().least(),
            ],
            lines: if more { vec![line(1), line(2), LineRow::default()] } else { Vec::new() },
            messages: if more { vec!["warning: a".into()] } else { Vec::new() },
            peaks: vec![LinePeaks {
                line: "L1".into(),
                tension: vec![Peak { time: 1.0, value: 2.0, before: Some((0.5, 1.0)) }],
                offset: None,
            }],
            intact: more.then(|| FollowedCase { case: "C0".into(), sum: None }),
            read: vec![FileRead { path: "a".into(), size: 1, hash: "h".into() }],
            version: "1".into(),
            start: 2,
            ..CaseRecord::default()
        };
        let given: Vec<CaseRecord> = (0..20).map(|n| record(n, n % 3 == 0)).collect();
        let small: Records = given.iter().cloned().collect();
        let back: Vec<CaseRecord> = small.iter().map(|view| view.to_record()).collect();
        assert_eq!(back, given);
        assert_eq!((small.frames.len(), small.line_frames.len()), (1, 3));
        assert_eq!(small.of_case("C7").map(|view| view.followed()), Some(given[7].followed()));
    }
}
