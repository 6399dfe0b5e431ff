//! Tables of a run of tethers, in the columns of [AQWA-TETHER 7.3 to 7.10].

use super::Tethered;
use super::history::{TetherHistory, TetherQuantity};
use windlass_base::fortran::without_noise;
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;
use windlass_signal::tether::tables::STRESS;
use windlass_tether::installed::RigChange;

pub(super) const SECONDS: Digits = Digits::Decimals(2);

/// A column of a quantity, with its values.
fn column(of: &TetherQuantity, cells: impl IntoIterator<Item = impl Into<Cell>>) -> Column {
    Column::new(of.group, of.name, of.dim, of.digits, cells)
}

/// How a run went.
pub fn run_table(run: &Tethered) -> Table {
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
    Table::new("Slack and Impact")
        .with_rows(&run.happened)
        .column("", "Time", Dim::Time, SECONDS, |event| event.time)
        .text("Tether", |event| &event.tether)
        .text("Event", |event| match event.change {
            RigChange::Slack => "slack",
            RigChange::Impact { .. } => "impact",
            RigChange::LowerStop { .. } => "on the lower stop",
        })
        .column("", "Velocity", Dim::Velocity, Digits::Decimals(3), |event| match event.change {
            RigChange::Impact { velocity, .. } => Some(velocity),
            _ => None,
        })
        .column("", "Stress", STRESS, Digits::Scientific(4), |event| match event.change {
            RigChange::Impact { stress, .. } => Some(stress),
            _ => None,
        })
        .column("", "Drop", Dim::Length, Digits::Decimals(3), |event| match event.change {
            RigChange::LowerStop { drop } => Some(drop),
            _ => None,
        })
        .build()
}

/// The actions of a run, and when they happened. Empty without rows.
pub fn actions(run: &Tethered) -> Table {
    Table::new("Actions")
        .with_rows(&run.actions)
        .text("Action", |(name, _)| name)
        .column("", "Time", Dim::Time, SECONDS, |(_, time)| *time)
        .build()
}

/// Number of a step, from 1 at the start.
fn step_number(run: &Tethered, instant: usize) -> Option<usize> {
    let time = run.times.get(instant)?;
    Some(((time - run.settings.start) / run.settings.step).round() as usize + 1)
}

/// Positions, velocities and accelerations of the nodes at some instants, from the vessel down [AQWA-TETHER 7.3].
pub fn motions(run: &Tethered, tether: &TetherHistory, instants: &[usize]) -> Table {
    let quantities = tether.node_quantities();
    let along = quantities.len() - 1;
    let nodes = || (0..tether.line.nodes()).rev();
    let rows: Vec<(usize, usize)> = instants.iter().flat_map(|i| nodes().map(move |node| (*i, node))).collect();
    let position = if tether.towed { "POSITION ALONG TETHER" } else { "HEIGHT ABOVE ANCHOR" };
    let mut table = Table::new(format!("Time History of Single Tether {}", tether.name))
        .with_rows(&rows)
        .column("STEP", "NUMB", Dim::None, Digits::Usual, |(instant, _)| step_number(run, *instant))
        .column("", "TIME", Dim::Time, SECONDS, |(instant, _)| run.times.get(*instant).copied())
        .column("", "NODE", Dim::None, Digits::Usual, |(_, node)| node + 1)
        .column("", position, Dim::Length, Digits::Decimals(1), |(instant, node)| {
            tether.node_at(*instant, *node, along)
        });
    let groups = ["POSITIONS", "VELOCITIES", "ACCELERATIONS"];
    for (q, of) in quantities.iter().enumerate().take(along) {
        let group = groups.get(q / 4).copied().unwrap_or_default();
        table = table.column(group, of.name, of.dim, of.digits, |(instant, node)| {
            let alike = (0..tether.line.nodes())
                .flat_map(|n| [4 * (q / 4) + q % 4 / 2 * 2, 4 * (q / 4) + q % 4 / 2 * 2 + 1].map(|q| (n, q)));
            let values = alike.filter_map(|(n, q)| tether.node_at(*instant, n, q));
            let largest = values.fold(0.0, |most: f64, v| most.max(v.abs()));
            tether.node_at(*instant, *node, q).map(|value| without_noise(value, largest))
        });
    }
    table.build()
}

/// Forces and stresses at both ends of the elements at some instants, the upper or vessel's end of each first [AQWA-TETHER 7.4, 7.11]. The listing has tensions and
/// shear stress of a towed tether too: they are zero.
pub fn forces(run: &Tethered, tether: &TetherHistory, instants: &[usize]) -> Table {
    let ends = || (0..2 * tether.line.elements().len()).rev();
    let rows: Vec<(usize, usize)> = instants.iter().flat_map(|i| ends().map(move |end| (*i, end))).collect();
    let along = tether.node_quantities().len() - 1;
    let position = if tether.towed { "DISTANCE" } else { "ELEVATION" };
    let mut table = Table::new(format!("Time History of Forces and Stresses for Tether {}", tether.name))
        .with_rows(&rows)
        .column("", "TIME", Dim::Time, SECONDS, |(instant, _)| run.times.get(*instant).copied())
        .column("", "ELEM", Dim::None, Digits::Usual, |(_, end)| end / 2 + 1)
        .column("NODE", "NUMB", Dim::None, Digits::Usual, |(_, end)| end.div_ceil(2) + 1)
        .column("", position, Dim::Length, Digits::Decimals(1), |(instant, end)| {
            tether.node_at(*instant, end.div_ceil(2), along)
        });
    let heads = if tether.towed { &TOWED_HEADS[..] } else { &INSTALLED_HEADS[..] };
    if tether.towed {
        for name in ["EFFECTIVE", "WALL"] {
            table = table.column("TENSIONS", name, Dim::Force, Digits::Scientific(4), |_| 0.0);
        }
    }
    for (q, ((group, name), of)) in heads.iter().zip(tether.end_quantities()).enumerate() {
        if tether.towed && q == 4 {
            table = table.column("STRESSES", "SHEAR", STRESS, Digits::Scientific(3), |_| 0.0);
        }
        // the listing has stresses with three figures
        let digits = if of.dim == STRESS { Digits::Scientific(3) } else { of.digits };
        table = table.column(group, name, of.dim, digits, |(instant, end)| {
            let alike = tether.end_quantities().iter().enumerate().filter(|(_, other)| other.dim == of.dim);
            let values = alike.flat_map(|(q, _)| ends().filter_map(move |end| tether.end_at(*instant, end, q)));
            let largest = values.fold(0.0, |most: f64, v| most.max(v.abs()));
            tether.end_at(*instant, *end, q).map(|value| without_noise(value, largest))
        });
    }
    table.build()
}

/// Heads of the columns of forces in the listing, in the order of the quantities.
const TOWED_HEADS: [(&str, &str); 7] = [
    ("SHEAR FORCE", "Y"),
    ("SHEAR FORCE", "Z"),
    ("BENDING MOMENTS", "Y"),
    ("BENDING MOMENTS", "Z"),
    ("STRESSES", "BENDING+AXIAL MAX"),
    ("STRESSES", "Y"),
    ("STRESSES", "Z"),
];
const INSTALLED_HEADS: [(&str, &str); 11] = [
    ("TENSIONS", "EFFECTIVE"),
    ("TENSIONS", "WALL"),
    ("SHEAR FORCE", "X"),
    ("SHEAR FORCE", "Y"),
    ("BENDING MOMENTS", "X"),
    ("BENDING MOMENTS", "Y"),
    ("STRESSES", "SHEAR"),
    ("STRESSES", "BENDING+AXIAL MAX"),
    ("STRESSES", "BENDING+AXIAL MIN"),
    ("STRESSES", "MAXIMUM VON MISES"),
    ("STRESSES", "BENDING Y"),
];

/// What a history in time is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HistoryTarget {
    /// A node, from 0 at the anchor or the trailing end.
    Node(usize),
    /// An end: twice the element and the end, from 0.
    End(usize),
}

/// Everything of a node or of an end over time.
pub fn series(run: &Tethered, tether: &TetherHistory, of: HistoryTarget) -> Table {
    let (what, list) = match of {
        HistoryTarget::Node(node) => (format!("Node {}", node + 1), tether.node_quantities()),
        HistoryTarget::End(end) => (format!("Element {}, End {}", end / 2 + 1, end % 2 + 1), tether.end_quantities()),
    };
    let mut columns = vec![Column::new("", "Time", Dim::Time, SECONDS, run.times.iter().copied())];
    for (index, quantity) in list.iter().enumerate() {
        let values = match of {
            HistoryTarget::Node(node) => tether.node(node, index),
            HistoryTarget::End(end) => tether.end(end, index),
        };
        // in one table of all of them, codes tell them apart
        columns.push(Column { name: quantity.code.into(), ..column(quantity, values) });
    }
    Table::from_columns(format!("{what} of Tether {}", tether.name), columns)
}

/// One quantity along the tether at some instants, with the least and the largest of the whole run [AQWA-TETHER 2.2, 2.3].
pub fn table_along_tether(
    run: &Tethered,
    tether: &TetherHistory,
    at_nodes: bool,
    index: usize,
    instants: &[usize],
) -> Option<Table> {
    let list = if at_nodes { tether.node_quantities() } else { tether.end_quantities() };
    let quantity = list.get(index)?;
    let positions: Vec<usize> =
        if at_nodes { (0..tether.line.nodes()).collect() } else { (0..2 * tether.line.elements().len()).collect() };
    let distance = |position: &usize| {
        let node = if at_nodes { *position } else { position.div_ceil(2) };
        tether.line.distances().get(node).copied()
    };
    let value = |instant: usize, position: usize| match at_nodes {
        true => tether.node_at(instant, position, index),
        false => tether.end_at(instant, position, index),
    };
    let whole = |position: &usize| if at_nodes { tether.node(*position, index) } else { tether.end(*position, index) };
    let TetherQuantity { dim, digits, .. } = *quantity;
    let mut table = Table::new(format!("{} {} along Tether {}", quantity.group, quantity.name, tether.name))
        .with_rows(&positions)
        .column("", "Distance", Dim::Length, Digits::Decimals(2), distance);
    for instant in instants {
        let time = run.times.get(*instant).copied().unwrap_or_default();
        table =
            table.column(quantity.group, &format!("{time:.2} s"), dim, digits, |position| value(*instant, *position));
    }
    let table = table
        .column(quantity.group, "Least", dim, digits, |position| whole(position).into_iter().reduce(f64::min))
        .column(quantity.group, "Largest", dim, digits, |position| whole(position).into_iter().reduce(f64::max));
    Some(table.build())
}
