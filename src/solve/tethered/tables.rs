//! Tables of a run of tethers, in the columns of seed 003, 7.3 to 7.10.

use super::Tethered;
use super::history::{Quantity, StructureHistory, TetherHistory};
use crate::language::units::Dim;
use crate::post::SeriesError;
use crate::post::cycle::{AQWA_SAMPLES, Cycle};
use crate::post::tether::fatigue::{self, Asked, EndRecord};
use crate::post::tether::tables::{AtEnd, Channel, Place, STRESS, histogram, type_one, type_two};
use crate::table::{Cell, Column, Digits, Table};
use crate::tether::installed::Change;

const SECONDS: Digits = Digits::Decimals(2);

fn text(word: &str) -> Cell {
    Cell::Text(word.into())
}

fn column(of: &Quantity, cells: Vec<Cell>) -> Column {
    Column { name: of.name.into(), group: of.group.into(), dim: of.dim, digits: of.digits, cells }
}

/// How a run went.
pub fn told(run: &Tethered) -> Table {
    let last = run.times.last().copied();
    let names: Vec<&str> = run.tethers.iter().map(|t| t.name.as_str()).collect();
    let scheme = if run.settings.compatible { "two stages, as AQWA 5.4" } else { "two stages" };
    let mut table = Table::new("Tethers in Time")
        .fact("Tethers", names.join(" ").as_str(), Dim::None)
        .fact("Time Reached", last, Dim::Time)
        .fact("Step", run.settings.step, Dim::Time)
        .fact("Scheme", scheme, Dim::None)
        .fact("Stored Instants", run.times.len(), Dim::None);
    if let Some(seed) = run.seed {
        table = table.fact("Seed of Phases", Cell::Integer(i64::try_from(seed).unwrap_or(i64::MAX)), Dim::None);
    }
    for note in &run.notes {
        table.note(note.clone());
    }
    table
}

/// What happened: tethers that went slack, that struck, whose lower end fell on its stop. Empty without rows.
pub fn events(run: &Tethered) -> Table {
    let mut table = Table::new("Slack and Impact")
        .column("", "Time", Dim::Time, SECONDS)
        .column("", "Tether", Dim::None, Digits::Usual)
        .column("", "Event", Dim::None, Digits::Usual)
        .column("", "Velocity", Dim::Velocity, Digits::Decimals(3))
        .column("", "Stress", STRESS, Digits::Scientific(4))
        .column("", "Drop", Dim::Length, Digits::Decimals(3));
    for event in &run.happened {
        let (what, numbers) = match event.change {
            Change::Slack => ("slack", [None; 3]),
            Change::Impact { velocity, stress } => ("impact", [Some(velocity), Some(stress), None]),
            Change::LowerStop { drop } => ("on the lower stop", [None, None, Some(drop)]),
        };
        let [velocity, stress, drop] = numbers.map(Cell::from);
        let row = vec![event.time.into(), text(&event.tether), text(what), velocity, stress, drop];
        // the row has one cell a column, made just above
        let _ = table.push(row);
    }
    table
}

/// Positions, velocities and accelerations of the nodes at some instants, from the vessel down (7.3).
pub fn motions(run: &Tethered, tether: &TetherHistory, instants: &[usize]) -> Table {
    let mut table = Table::new(format!("Motions of Tether {}", tether.name))
        .column("", "Time", Dim::Time, SECONDS)
        .column("", "Node", Dim::None, Digits::Usual);
    let of = tether.of_a_node();
    let along = of.len() - 1;
    let order: Vec<usize> = std::iter::once(along).chain(0..along).collect();
    table.columns.extend(order.iter().filter_map(|q| of.get(*q)).map(|q| column(q, Vec::new())));
    for instant in instants {
        for node in (0..tether.line.nodes()).rev() {
            let mut row = vec![Cell::from(run.times.get(*instant).copied()), (node + 1).into()];
            row.extend(order.iter().map(|q| Cell::from(tether.node_at(*instant, node, *q))));
            // the row has one cell a column
            let _ = table.push(row);
        }
    }
    table
}

/// Forces and stresses at both ends of the elements at some instants, the upper or vessel's end of each first (7.4, 7.11).
pub fn forces(run: &Tethered, tether: &TetherHistory, instants: &[usize]) -> Table {
    let mut table = Table::new(format!("Forces and Stresses of Tether {}", tether.name))
        .column("", "Time", Dim::Time, SECONDS)
        .column("", "Elem", Dim::None, Digits::Usual)
        .column("", "Node", Dim::None, Digits::Usual)
        .column("", "Along", Dim::Length, Digits::Decimals(1));
    table.columns.extend(tether.of_an_end().iter().map(|q| column(q, Vec::new())));
    let along = tether.of_a_node().len() - 1;
    for instant in instants {
        for end in (0..2 * tether.line.elements().len()).rev() {
            let node = end.div_ceil(2);
            let mut row = vec![
                Cell::from(run.times.get(*instant).copied()),
                (end / 2 + 1).into(),
                (node + 1).into(),
                tether.node_at(*instant, node, along).into(),
            ];
            row.extend((0..tether.of_an_end().len()).map(|q| Cell::from(tether.end_at(*instant, end, q))));
            // the row has one cell a column
            let _ = table.push(row);
        }
    }
    table
}

/// What a history in time is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// A node, from 0 at the anchor or the trailing end.
    Node(usize),
    /// An end: twice the element and the end, from 0.
    End(usize),
}

/// Everything of a node or of an end over time.
pub fn series(run: &Tethered, tether: &TetherHistory, of: Of) -> Table {
    let (what, list) = match of {
        Of::Node(node) => (format!("Node {}", node + 1), tether.of_a_node()),
        Of::End(end) => (format!("Element {}, End {}", end / 2 + 1, end % 2 + 1), tether.of_an_end()),
    };
    let mut table = Table::new(format!("{what} of Tether {}", tether.name));
    let times = run.times.iter().map(|t| Cell::Number(*t)).collect();
    let head = Quantity { code: "", group: "", name: "Time", dim: Dim::Time, digits: SECONDS };
    table.columns.push(column(&head, times));
    for (index, quantity) in list.iter().enumerate() {
        let values = match of {
            Of::Node(node) => tether.node(node, index),
            Of::End(end) => tether.end(end, index),
        };
        table.columns.push(column(quantity, values.into_iter().map(Cell::Number).collect()));
    }
    table
}

/// One quantity along the tether at some instants, with the least and the largest of the whole run (2.2, 2.3).
pub fn along(
    run: &Tethered,
    tether: &TetherHistory,
    at_nodes: bool,
    index: usize,
    instants: &[usize],
) -> Option<Table> {
    let list = if at_nodes { tether.of_a_node() } else { tether.of_an_end() };
    let quantity = list.get(index)?;
    let places: Vec<usize> =
        if at_nodes { (0..tether.line.nodes()).collect() } else { (0..2 * tether.line.elements().len()).collect() };
    let distance = |place: &usize| {
        let node = if at_nodes { *place } else { place.div_ceil(2) };
        Cell::from(tether.line.distances().get(node).copied())
    };
    let mut table = Table::new(format!("{} {} along Tether {}", quantity.group, quantity.name, tether.name));
    let head = Quantity { code: "", group: "", name: "Distance", dim: Dim::Length, digits: Digits::Decimals(2) };
    table.columns.push(column(&head, places.iter().map(distance).collect()));
    for instant in instants {
        let value = |place: &usize| {
            if at_nodes { tether.node_at(*instant, *place, index) } else { tether.end_at(*instant, *place, index) }
        };
        let cells = places.iter().map(|p| Cell::from(value(p))).collect();
        let time = run.times.get(*instant).copied().unwrap_or_default();
        table.columns.push(Column { name: format!("{time:.2} s"), ..column(quantity, cells) });
    }
    let all = |place: &usize| if at_nodes { tether.node(*place, index) } else { tether.end(*place, index) };
    let folded = |least: bool| {
        let of = |place: &usize| {
            let values = all(place).into_iter();
            Cell::from(if least { values.reduce(f64::min) } else { values.reduce(f64::max) })
        };
        places.iter().map(of).collect()
    };
    for (name, least) in [("Least", true), ("Largest", false)] {
        table.columns.push(Column { name: name.into(), ..column(quantity, folded(least)) });
    }
    Some(table)
}

/// Dimensions and digits of the six of a kind of [`StructureHistory`].
fn six(kind: usize) -> [(Dim, Digits); 2] {
    let three = Digits::Decimals(3);
    match kind {
        0 => [(Dim::Length, three), (Dim::Angle, three)],
        1 => [(Dim::Velocity, three), (Dim::AngularVelocity, three)],
        2 => [(Dim::Acceleration, three), (Dim::AngularAcceleration, three)],
        12 => [(Dim::Length, Digits::Scientific(3)), (Dim::Angle, Digits::Scientific(3))],
        _ => [(Dim::Force, Digits::Scientific(4)), (Dim::Moment, Digits::Scientific(4))],
    }
}

const SIX: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];

/// The motion of the structure's centre of gravity and the forces on it at an instant (seed 003, 8.2): a motion or kind of force a row.
/// Two tables: one of motions with the points asked for, one of forces.
pub fn structure(run: &Tethered, structure: &StructureHistory, instant: usize, points: &[usize]) -> [Table; 2] {
    let time = run.times.get(instant).copied();
    let title = |what: &str| format!("{what} of Structure {}", structure.body);
    let mut out = [title("Motions"), title("Forces")]
        .map(|t| Table::new(t).fact("Time", time, Dim::Time).column("", "Freedom", Dim::None, Digits::Usual));
    // the six of a motion have two dimensions: metres and degrees stand in columns of their own
    let [motions, forces] = &mut out;
    motions.columns.clear();
    forces.columns.clear();
    let kinds =
        |rows: &[usize]| rows.iter().map(|k| text(StructureHistory::KINDS.get(*k).copied().unwrap_or(""))).collect();
    let moved = [0, 1, 2, 12];
    let pushed: Vec<usize> = (3..12).collect();
    let head = |name: &str, dim, digits, cells| Column { name: name.into(), group: String::new(), dim, digits, cells };
    forces.columns.push(head("Kind", Dim::None, Digits::Usual, kinds(&pushed)));
    for (freedom, name) in SIX.iter().enumerate() {
        let (dim, digits) = six(3)[freedom / 3];
        let cells = pushed.iter().map(|k| Cell::from(structure.at(instant, 6 * k + freedom))).collect();
        forces.columns.push(head(name, dim, digits, cells));
    }
    motions.columns.push(head("Freedom", Dim::None, Digits::Usual, SIX.map(text).to_vec()));
    for kind in moved {
        let name = StructureHistory::KINDS.get(kind).copied().unwrap_or("");
        for (part, range) in [(0, 0..3), (1, 3..6)] {
            let (dim, digits) = six(kind)[part];
            let value = |f: usize| {
                if range.contains(&f) { Cell::from(structure.at(instant, 6 * kind + f)) } else { Cell::Missing }
            };
            let cells = (0..6).map(value).collect();
            motions
                .columns
                .push(Column { group: name.into(), ..head(["Linear", "Angular"][part], dim, digits, cells) });
        }
    }
    let behind = 6 * StructureHistory::KINDS.len();
    for point in points {
        let name = structure.points.get(*point).map_or("", String::as_str);
        let cells =
            (0..6).map(|f| if f < 3 { structure.at(instant, behind + 3 * point + f).into() } else { Cell::Missing });
        let column = head("Point", Dim::Length, Digits::Decimals(3), cells.collect());
        motions.columns.push(Column { group: name.into(), ..column });
    }
    out
}

/// Everything of the structure over time.
pub fn structure_series(run: &Tethered, structure: &StructureHistory) -> Table {
    let mut table = Table::new(format!("Structure {} in Time", structure.body));
    let head = Quantity { code: "", group: "", name: "Time", dim: Dim::Time, digits: SECONDS };
    table.columns.push(column(&head, run.times.iter().map(|t| Cell::Number(*t)).collect()));
    for (kind, name) in StructureHistory::KINDS.iter().enumerate() {
        for (freedom, axis) in SIX.iter().enumerate() {
            let (dim, digits) = six(kind)[freedom / 3];
            let cells = structure.series(6 * kind + freedom).into_iter().map(Cell::Number).collect();
            table.columns.push(Column { name: (*axis).into(), group: (*name).into(), dim, digits, cells });
        }
    }
    for (index, point) in structure.points.iter().enumerate() {
        for (axis, name) in SIX.iter().take(3).enumerate() {
            let cells = structure.series(6 * StructureHistory::KINDS.len() + 3 * index + axis);
            let cells = cells.into_iter().map(Cell::Number).collect();
            let (dim, digits) = six(0)[0];
            table.columns.push(Column { name: (*name).into(), group: point.clone(), dim, digits, cells });
        }
    }
    table
}

/// Mean, drift and the first harmonics of the structure's motions over one cycle (seed 003, 8.2.21): the cycle of a regular wave's period
/// from the first of the instants, or what lies between the first and the last of them. As the listing has it, `x = mean + sum A cos(n w t -
/// phase)` by sixteen samples of the cycle, what it drifts taken off as a straight line about its middle.
///
/// # Errors
/// Too few instants, or a cycle that they do not hold.
pub fn harmonics(
    run: &Tethered,
    structure: &StructureHistory,
    period: Option<f64>,
    instants: &[usize],
) -> Result<Table, SeriesError> {
    let time = |place: Option<&usize>| place.and_then(|i| run.times.get(*i)).copied().unwrap_or_default();
    let (start, end) = (time(instants.first()), time(instants.last()));
    let period = period.unwrap_or(end - start);
    let mut table = Table::new(format!("Harmonics of Structure {}", structure.body))
        .fact("Start", start, Dim::Time)
        .fact("Period", period, Dim::Time)
        .column("", "Motion", Dim::None, Digits::Usual)
        .column("", "Freedom", Dim::None, Digits::Usual)
        .column("", "Mean", Dim::None, Digits::Decimals(4))
        .column("", "Drift", Dim::None, Digits::Decimals(4));
    for order in ["1", "2", "3", "4"] {
        table = table.column(order, "Amplitude", Dim::None, Digits::Decimals(4)).column(
            order,
            "Phase",
            Dim::Angle,
            Digits::Decimals(1),
        );
    }
    for (kind, motion) in StructureHistory::KINDS.iter().enumerate().take(3) {
        for (freedom, axis) in SIX.iter().enumerate() {
            let values = structure.series(6 * kind + freedom);
            let found = Cycle::of(&run.times, &values, (start, period), 4, AQWA_SAMPLES)?;
            // one column holds metres and degrees: numbers without a dimension, in metres and degrees
            let told = |value: f64| Cell::Number(if freedom < 3 { value } else { value.to_degrees() });
            let mut row = vec![text(motion), text(axis), told(found.mean), told(found.drift)];
            for harmonic in &found.harmonics {
                row.extend([told(harmonic.amplitude), Cell::Number(-harmonic.phase)]);
            }
            // the row has one cell a column
            let _ = table.push(row);
        }
    }
    table.note("lengths in metres, angles in degrees; x = mean + sum A cos(n w t - phase)");
    Ok(table)
}

/// Which of the stored instants statistics and fatigue are of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// First of them.
    pub first: usize,
    /// One behind the last.
    pub end: usize,
}

impl Statistics {
    /// Those between two times (s), both counted.
    pub fn between(run: &Tethered, from: f64, to: f64) -> Self {
        let slack = 1e-6 * run.settings.step;
        let first = run.times.iter().position(|t| *t >= from - slack).unwrap_or(run.times.len());
        let end = run.times.iter().rposition(|t| *t <= to + slack).map_or(first, |i| i + 1);
        Statistics { first, end: end.max(first) }
    }

    fn of(self, values: Vec<f64>) -> Vec<f64> {
        values.get(self.first..self.end).unwrap_or_default().to_vec()
    }

    fn title(self, run: &Tethered, what: &str) -> String {
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
                out.push(type_one(&self.title(run, &title), &place.borrowed())?);
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
            let borrowed: Vec<Place> = places.iter().map(Owned::borrowed).collect();
            out.extend(type_two(&title, what, &borrowed)?);
        }
        Ok(out)
    }

    fn nodes(self, tether: &TetherHistory) -> Vec<Owned> {
        let of = tether.of_a_node();
        let place = |(node, distance): (usize, &f64)| Owned {
            number: node + 1,
            distance: *distance,
            channels: of.iter().take(12).enumerate().map(|(q, of)| (*of, self.of(tether.node(node, q)))).collect(),
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
    fn installed_end(self, tether: &TetherHistory, end: usize) -> Vec<(Quantity, Vec<f64>)> {
        let of = tether.of_an_end();
        let told = [0, 1, 6, 7, 8, 9, 10];
        told.iter().filter_map(|q| Some((*of.get(*q)?, self.of(tether.end(end, *q))))).collect()
    }

    /// The seven columns of figure 7.6: both moments, the moment where its deviation round the tube is largest, the largest stress, both
    /// stresses, the stress where its deviation is largest.
    fn towed_end(self, tether: &TetherHistory, end: usize) -> Vec<(Quantity, Vec<f64>)> {
        let of = tether.of_an_end();
        let values = |q: usize| self.of(tether.end(end, q));
        let (y, z) = (values(2), values(3));
        let turned = |angle: f64| -> Vec<f64> {
            let (sine, cosine) = angle.sin_cos();
            y.iter().zip(&z).map(|(y, z)| y * cosine + z * sine).collect()
        };
        let spread = |angle: f64| crate::post::tether::global::spread(&turned(angle)).1;
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
        let named = |q: usize, name: &'static str| of.get(q).map(|q| Quantity { name, ..*q });
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

    /// The histogram of stress ranges and the table of fatigue of a towed tether (7.9, 7.10). `asked.duration` is overwritten by the time
    /// between the first and the last instant.
    ///
    /// # Errors
    /// Fewer than two instants; what [`fatigue::along`] refuses.
    pub fn fatigue(self, run: &Tethered, tether: &TetherHistory, asked: Asked) -> Result<[Table; 2], SeriesError> {
        let time = |i: usize| run.times.get(i).copied().unwrap_or_default();
        let duration = time(self.end.saturating_sub(1)) - time(self.first);
        let count = 2 * tether.line.elements().len();
        let moments: Vec<[Vec<f64>; 2]> = (0..count).map(|end| [2, 3].map(|q| self.of(tether.end(end, q)))).collect();
        let tube = |end: usize| tether.line.elements().get(end / 2).map(|e| e.tube().stress_of_moment());
        let records: Vec<EndRecord> = moments
            .iter()
            .enumerate()
            .map(|(end, [y, z])| EndRecord { about_y: y, about_z: z, stress_of_moment: tube(end).unwrap_or_default() })
            .collect();
        let found = fatigue::along(&records, Asked { duration, ..asked })?;
        let distance = |end: usize| tether.line.distances().get(end.div_ceil(2)).copied().unwrap_or_default();
        let ends: Vec<AtEnd> = found.into_iter().enumerate().map(|(end, f)| (end / 2 + 1, distance(end), f)).collect();
        let title = |what: &str| self.title(run, &format!("{what} of Tether {}", tether.name));
        let mut table = crate::post::tether::tables::fatigue(&title("Fatigue and Peak Stress"), &ends)
            .fact("Elapsed Time", duration, Dim::Time)
            .fact("Stress Concentration Factor", asked.curve.concentration, Dim::None)
            .fact("S-N Curve Intercept A", asked.curve.intercept, Dim::None)
            .fact("S-N Curve Slope m", asked.curve.slope, Dim::None)
            .fact("Time of Expected Peak", asked.peak_time / 3600.0, Dim::None);
        table.note("the expected peak is of the time of expected peaks, in hours; the intercept is for stresses in Pa");
        Ok([histogram(&title("Stress Ranges, Half Cycles,"), &ends), table])
    }
}

/// A place with its series.
struct Owned {
    number: usize,
    distance: f64,
    channels: Vec<(Quantity, Vec<f64>)>,
}

impl Owned {
    fn borrowed(&self) -> Place<'_> {
        Place {
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
