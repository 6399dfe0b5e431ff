//! The statistics, histogram and fatigue tables of a tether [AQWA-TETHER figures 7.5 to 7.10, 7.12 and 7.13], with the
//! columns and the order of that manual.

use super::fatigue::{EndFatigue, STRESS_RANGE_BINS};
use super::global::{GlobalStatistics, global};
use crate::SeriesError;
use windlass_base::fortran::without_noise;
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;

/// Stress in the users' force over the square of their length, as a consistent set of units has it.
pub const STRESS: Dim = Dim::Derived { force: 1, length: -2, seconds: 0 };

/// One series of a place along a tether.
#[derive(Clone, Copy, Debug)]
pub struct Channel<'a> {
    /// Head shared with its neighbours, e.g. `Position`.
    pub group: &'a str,
    /// Its own head, e.g. `RY`.
    pub name: &'a str,
    /// What it measures.
    pub dim: Dim,
    /// Its digits in reports.
    pub digits: Digits,
    /// Its values, SI.
    pub values: &'a [f64],
}

/// A node, or an end of an element, with its series.
#[derive(Clone, Debug)]
pub struct NodeSeries<'a> {
    /// Number of the node or the element.
    pub number: usize,
    /// Distance from the trailing end or the anchor (m).
    pub distance: f64,
    /// Its series: as many, of the same names, at every place.
    pub channels: Vec<Channel<'a>>,
}

fn of_place(position: &NodeSeries) -> Result<Vec<GlobalStatistics>, SeriesError> {
    position.channels.iter().map(|channel| global(channel.values)).collect()
}

/// The same with zeros for what is rounding beside the largest of its group and dimension.
fn quiet(mut positions: Vec<Vec<GlobalStatistics>>, channels: &[Channel]) -> Vec<Vec<GlobalStatistics>> {
    let alike = |one: &Channel, other: &Channel| one.group == other.group && one.dim == other.dim;
    let largest: Vec<f64> = channels
        .iter()
        .map(|channel| {
            let of_place = |position: &Vec<GlobalStatistics>| -> f64 {
                let same = position.iter().zip(channels).filter(|(_, other)| alike(channel, other));
                same.fold(0.0, |most: f64, (of, _)| most.max(of.mean.abs()).max(of.significant))
            };
            positions.iter().map(of_place).fold(0.0, f64::max)
        })
        .collect();
    for of in positions.iter_mut().flat_map(|position| position.iter_mut().zip(&largest)) {
        let (of, largest) = of;
        let numbers = [&mut of.mean, &mut of.significant, &mut of.highest_third, &mut of.lowest_third];
        for value in numbers.into_iter().chain(&mut of.maxima).chain(&mut of.minima) {
            *value = without_noise(*value, *largest);
        }
    }
    positions
}

/// The column of a channel.
fn channel_column(channel: &Channel, cells: impl IntoIterator<Item = f64>) -> Column {
    Column::new(channel.group, channel.name, channel.dim, channel.digits, cells)
}

/// A quantity of the statistics of type 1: its words and where it stands.
type StatisticRow = (&'static str, fn(&GlobalStatistics) -> f64);

const TABLE_ROWS: [StatisticRow; 10] = [
    ("MEAN VALUE", |g| g.mean),
    ("2 x R.M.S", |g| g.significant),
    ("MEAN HIGHEST 1/3 PEAKS +", |g| g.highest_third),
    ("MEAN HIGHEST 1/3 PEAKS -", |g| g.lowest_third),
    ("MAXIMUM PEAKS +", |g| g.maxima[0]),
    ("", |g| g.maxima[1]),
    ("", |g| g.maxima[2]),
    ("MINIMUM PEAKS -", |g| g.minima[0]),
    ("", |g| g.minima[1]),
    ("", |g| g.minima[2]),
];

/// Statistics of type 1: one page a place, all parameters of each series (figures 7.5, 7.6, 7.12). The means of the highest
/// third are from the mean, the peaks are not.
///
/// # Errors
/// As [`global`].
pub fn type_one(title: &str, position: &NodeSeries) -> Result<Table, SeriesError> {
    let found = quiet(vec![of_place(position)?], &position.channels).pop().unwrap_or_default();
    let mut columns = vec![Column::new("", "", Dim::None, Digits::Usual, TABLE_ROWS.map(|(label, _)| label))];
    for (channel, of) in position.channels.iter().zip(&found) {
        columns.push(channel_column(channel, TABLE_ROWS.map(|(_, value)| value(of))));
    }
    Ok(Table::from_columns(title, columns).fact("DISTANCE", position.distance, Dim::Length))
}

/// The pages of the statistics of type 2, in their order.
pub const PAGES: [StatisticRow; 4] = [
    ("Mean Value", |g| g.mean),
    ("2 x R.M.S", |g| g.significant),
    ("Maximum Peaks", |g| g.maxima[0]),
    ("Minimum Peaks", |g| g.minima[0]),
];

/// Statistics of type 2: one page a parameter, a row for each place along the tether (figures 7.7, 7.8, 7.13), and their
/// mean, largest or least below; `what` is the head of the first column, `NODE` or `ELEM`.
///
/// # Errors
/// As [`global`].
pub fn type_two(title: &str, what: &str, positions: &[NodeSeries]) -> Result<Vec<Table>, SeriesError> {
    let channels = positions.first().map_or(&[][..], |position| &position.channels);
    let found = quiet(positions.iter().map(of_place).collect::<Result<Vec<_>, _>>()?, channels);
    let page = |(index, (name, value)): (usize, &StatisticRow)| {
        let last = match index {
            0 => "MEAN",
            3 => "MINIMUM",
            _ => "MAXIMUM",
        };
        let mut numbers: Vec<Cell> = positions.iter().map(|p| Cell::Integer(p.number as i64)).collect();
        numbers.push(Cell::Text(last.into()));
        let mut distances: Vec<Cell> = positions.iter().map(|p| Cell::Number(p.distance)).collect();
        distances.push(Cell::Missing);
        let mut columns = vec![
            Column::new("", what, Dim::None, Digits::Usual, numbers),
            Column::new("", "DISTNCE", Dim::Length, Digits::Decimals(2), distances),
        ];
        for (at, channel) in positions.first().map_or(&[][..], |p| &p.channels).iter().enumerate() {
            let values: Vec<f64> = found.iter().map(|of| of.get(at).map_or(f64::NAN, value)).collect();
            let summary = match index {
                0 => values.iter().sum::<f64>() / values.len() as f64,
                3 => values.iter().copied().fold(f64::INFINITY, f64::min),
                _ => values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            };
            columns.push(channel_column(channel, values.into_iter().chain([summary])));
        }
        Table::from_columns(format!("{title}: {name}"), columns)
    };
    Ok(PAGES.iter().enumerate().map(page).collect())
}

/// An end of an element in the tables of fatigue: the element's number, the distance, what was found.
pub type AtEnd = (usize, f64, EndFatigue);

/// Half cycles by stress range at the place of most damage of every end (figure 7.9).
pub fn histogram(title: &str, ends: &[AtEnd]) -> Table {
    let width = ends.first().map_or(0.0, |(_, _, found)| found.ranges.width);
    let edge = |shift: usize| (0..STRESS_RANGE_BINS).map(move |bin| (bin + shift) as f64 * width);
    let mut columns = vec![
        Column::new("", "BIN", Dim::None, Digits::Usual, 1..=STRESS_RANGE_BINS),
        Column::new("STRESS RANGE", "FROM", STRESS, Digits::Scientific(5), edge(0)),
        Column::new("STRESS RANGE", "TO", STRESS, Digits::Scientific(5), edge(1)),
    ];
    for (element, distance, found) in ends {
        let (group, name) = (format!("ELEMENT {element}"), format!("{distance:.0}"));
        let counts = found.ranges.counts.iter().map(|n| *n as i64);
        columns.push(Column::new(&group, &name, Dim::None, Digits::Usual, counts));
    }
    let mut table = Table::from_columns(title, columns);
    table.note("distances in metres");
    table.note("half cycles of the rainflow at the place round the circumference that has the most damage");
    table
}

const MOMENT: Dim = Dim::Moment;
const THREE_DIGITS: Digits = Digits::Scientific(3);

/// Fatigue life and the peak stress expected in some hours of every end; below them what the listing has along the tether: largest values, least life, mean
/// angles and mean stress (figure 7.10).
pub fn fatigue(title: &str, ends: &[AtEnd], hours: f64) -> Table {
    let peak_head = &format!("{hours}HR PK STRESS");
    let degrees = Digits::Decimals(0);
    type FatigueField<'h> = (&'static str, &'h str, Dim, Digits, fn(&EndFatigue) -> f64, fn(&[f64]) -> f64);
    let mean: fn(&[f64]) -> f64 = |values| values.iter().sum::<f64>() / values.len().max(1) as f64;
    let smallest: fn(&[f64]) -> f64 = |values| values.iter().copied().fold(f64::INFINITY, f64::min);
    let largest: fn(&[f64]) -> f64 = |values| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    const MOMENTS: &str = "BENDING MOMENTS SIGNIFICANT";
    const FATIGUE: &str = "FATIGUE";
    const STRESSES: &str = "MAX BENDING STRESS";
    let fields: [FatigueField; 14] = [
        (MOMENTS, "Y", MOMENT, THREE_DIGITS, |f| f.significant_moments[0], largest),
        (MOMENTS, "Z", MOMENT, THREE_DIGITS, |f| f.significant_moments[1], largest),
        (MOMENTS, "MAX DAM", MOMENT, THREE_DIGITS, |f| f.significant_moments[2], largest),
        (FATIGUE, "EFFECTIVE STRS RNG", STRESS, THREE_DIGITS, |f| f.effective_range, largest),
        (FATIGUE, "PN.", Dim::Angle, degrees, |f| f.angle, mean),
        (FATIGUE, "CYC/HR", Dim::None, degrees, |f| f.cycles * 3600.0, largest),
        (FATIGUE, "DAMAGE/HR", Dim::None, THREE_DIGITS, |f| f.damage_rate * 3600.0, largest),
        (FATIGUE, "FATIGUE LIFE-DYS", Dim::Days, Digits::Decimals(1), |f| f.life_days * 86_400.0, smallest),
        (STRESSES, "MAX PK", STRESS, THREE_DIGITS, |f| f.largest, largest),
        (STRESSES, "MEAN", STRESS, THREE_DIGITS, |f| f.mean, mean),
        (STRESSES, "SIGNFCNT", STRESS, THREE_DIGITS, |f| f.significant, largest),
        (STRESSES, "PN.", Dim::Angle, degrees, |f| f.peak_angle, mean),
        (STRESSES, "CYC/HR", Dim::None, degrees, |f| f.peak_cycles * 3600.0, largest),
        (STRESSES, peak_head, STRESS, THREE_DIGITS, |f| f.expected_peak, largest),
    ];
    let mut elements: Vec<Cell> = ends.iter().map(|(element, _, _)| Cell::Integer(*element as i64)).collect();
    elements.push(Cell::Text("ALONG TETHER".into()));
    let mut distances: Vec<Cell> = ends.iter().map(|(_, distance, _)| Cell::Number(*distance)).collect();
    distances.push(Cell::Missing);
    let mut columns = vec![
        Column::new("", "Elem", Dim::None, Digits::Usual, elements),
        Column::new("", "DISTNCE", Dim::Length, Digits::Decimals(2), distances),
    ];
    for (group, name, dim, digits, value, along) in fields {
        let values: Vec<f64> = ends.iter().map(|(_, _, found)| value(found)).collect();
        let last = (!values.is_empty()).then(|| along(&values));
        let cells = values.into_iter().map(Some).chain([last]);
        columns.push(Column::new(group, name, dim, digits, cells));
    }
    Table::from_columns(title, columns)
}
