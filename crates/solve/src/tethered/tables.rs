//! Tables of a run of tethers, in the columns of [AQWA-TETHER 7.3 to 7.10].

use super::Tethered;
use super::history::{Quantity, TetherHistory};
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;
use windlass_signal::tether::tables::STRESS;
use windlass_tether::installed::Change;

pub(super) const SECONDS: Digits = Digits::Decimals(2);

pub(super) fn text(word: &str) -> Cell {
    Cell::Text(word.into())
}

pub(super) fn column(of: &Quantity, cells: Vec<Cell>) -> Column {
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
        // in one table of all of them, codes tell them apart
        let cells = values.into_iter().map(Cell::Number).collect();
        table.columns.push(Column { name: quantity.code.into(), ..column(quantity, cells) });
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
