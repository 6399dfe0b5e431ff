//! Where a line is at an instant, with its forces there; and its nodes over time.

use super::{CLEARANCE, LineResults};
use crate::results::{EventTable, RunEvent};
use crate::system::SolveError;
use crate::time::{BentRow, NodeRow};
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{ClassError, Idealisation};

/// A place along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LinePosition {
    /// A node, from 1 at the first end.
    Node(usize),
    /// An unstretched distance from the first end (m); what is between two nodes is on the straight line between theirs.
    Arc(f64),
}

/// A number of a node, with its column: name, dimension, digits.
type NodeColumn = (&'static str, Dim, Digits, fn(&NodeRow) -> Option<f64>);

/// Columns of every node behind its place.
const NODE: [NodeColumn; 5] = [
    ("X", Dim::Length, Digits::Usual, |node| Some(node.position[0])),
    ("Y", Dim::Length, Digits::Usual, |node| Some(node.position[1])),
    ("Z", Dim::Length, Digits::Usual, |node| Some(node.position[2])),
    ("Clearance", Dim::Length, CLEARANCE, |node| Some(node.clearance)),
    ("Tension", Dim::Force, Digits::Usual, |node| Some(node.effective)),
];

/// Columns of a node of a line that bends, behind them.
const BENT: [NodeColumn; 6] = [
    ("Wall", Dim::Force, Digits::Usual, |node| node.bent.map(|b| b.wall)),
    ("Shear", Dim::Force, Digits::Usual, |node| node.bent.map(|b| b.shear)),
    ("Moment", Dim::Moment, Digits::Usual, |node| node.bent.map(|b| b.moment())),
    ("M1", Dim::Moment, Digits::Usual, |node| node.bent.map(|b| b.bends[0])),
    ("M2", Dim::Moment, Digits::Usual, |node| node.bent.map(|b| b.bends[1])),
    ("Von Mises", Dim::Stress, Digits::Usual, |node| node.bent.map(|b| b.worse())),
];

/// The columns of the nodes of a line.
fn node_columns(bends: bool) -> impl Iterator<Item = &'static NodeColumn> {
    NODE.iter().chain(BENT.iter().filter(move |_| bends))
}

/// The line at an event: its nodes from the first end.
///
/// # Errors
/// Numbers that make no table.
pub fn shape(line: &LineResults, event: &RunEvent) -> Result<Table, SolveError> {
    let mut row = Vec::new();
    line.row(event, &mut row);
    let bends = line.columns.bends;
    let time = row.first().copied().unwrap_or(f64::NAN);
    // a node that a winch has not made yet has no row
    let numbered = line.numbered_nodes();
    let nodes: Vec<(usize, NodeRow)> =
        numbered.filter_map(|(number, position)| Some((number, line.columns.node(position, &row)?))).collect();
    let mut table = Table::new("Along a Line at an Instant")
        .fact("Line", line.name, Dim::None)
        .fact("Model", Idealisation::Dynamic, Dim::None)
        .fact("Time", time, Dim::Time)
        .with_rows(&nodes)
        .column("", "Node", Dim::None, Digits::Usual, |(number, _)| *number)
        .column("", "Arc", Dim::Length, Digits::Usual, |(_, node)| node.arc);
    for (name, dim, digits, value) in node_columns(bends) {
        table =
            table.column("", name, *dim, *digits, |(_, node)| value(node).filter(|v| v.is_finite()).map(|v| v + 0.0));
    }
    let mut table = table
        .column("", "Utilisation", Dim::None, Digits::Decimals(3), |(_, node)| line.node_utilisation(node, &row))
        .build();
    if table.rows() == 0 {
        table.note("the line does not act then");
    }
    Ok(table)
}

/// Places of a line over some events.
///
/// # Errors
/// A node that the line has not, a distance beyond its ends at every event.
pub fn histories(line: &LineResults, wanted: &[LinePosition], events: &[RunEvent]) -> Result<Table, SolveError> {
    let (run, bends) = (line.run, line.columns.bends);
    let (mut positions, mut groups, mut arcs) = (Vec::new(), Vec::new(), Vec::new());
    for (index, position) in wanted.iter().enumerate() {
        match position {
            LinePosition::Node(number) => {
                let found = number.checked_sub(1).and_then(|i| line.positions.get(i));
                let found = found.ok_or_else(|| {
                    let text = format!("{} has no node {number}: they are 1 to {}", line.name, line.nodes());
                    SolveError::new(ClassError::new(text))
                })?;
                positions.push(Ok(*found));
                groups.push(format!("Node {number}"));
            }
            LinePosition::Arc(arc) => {
                positions.push(Err(*arc));
                let name = format!("Place {}", index + 1);
                arcs.push((name.clone(), *arc));
                groups.push(name);
            }
        }
    }
    let mut table = EventTable::new("Places Along a Line", (&run.history, events), |row| {
        let node = |position: &Result<usize, f64>| match position {
            Ok(position) => line.columns.node(*position, row),
            Err(arc) => line.at_arc(*arc, row),
        };
        Ok(positions.iter().map(node).collect::<Vec<Option<NodeRow>>>())
    })?
    .fact("Line", line.name, Dim::None)
    .fact("Model", Idealisation::Dynamic, Dim::None);
    for (name, arc) in &arcs {
        table = table.fact(name, *arc, Dim::Length);
    }
    for (index, group) in groups.iter().enumerate() {
        for (name, dim, digits, value) in node_columns(bends) {
            table = table.column(group, name, *dim, *digits, |nodes| {
                nodes.get(index).and_then(Option::as_ref).and_then(value).unwrap_or(f64::NAN)
            });
        }
    }
    let table = table.build();
    let empty = |c: &&windlass_base::table::Column| c.cells.iter().all(|c| *c == Cell::Missing);
    if wanted.iter().any(|w| matches!(w, LinePosition::Arc(_)))
        && let Some(column) = table.columns().iter().filter(|c| c.name == "Tension").find(empty)
    {
        let text = format!("{} of {} is beyond its ends at all these times", column.group, line.name);
        return Err(SolveError::new(ClassError::new(text)));
    }
    Ok(table)
}

impl LineResults<'_> {
    /// The line at an unstretched distance from its first end (m) in a row; none beyond its ends.
    pub(super) fn at_arc(&self, arc: f64, row: &[f64]) -> Option<NodeRow> {
        let mut before: Option<NodeRow> = None;
        let near = 1e-9 * self.length(row).abs();
        for (_, node) in self.columns.nodes(row) {
            if node.arc >= arc - near {
                let Some(from) = before else { return (node.arc <= arc + near).then_some(node) };
                let share = ((arc - from.arc) / (node.arc - from.arc)).clamp(0.0, 1.0);
                return Some(interpolate_nodes(&from, &node, share));
            }
            before = Some(node);
        }
        None
    }
}

/// A share of the way from one node to another.
fn interpolate_nodes(from: &NodeRow, to: &NodeRow, share: f64) -> NodeRow {
    let mix = |a: f64, b: f64| a + share * (b - a);
    let three = |i: usize| {
        let at = |n: &NodeRow| n.position.get(i).copied().unwrap_or(f64::NAN);
        mix(at(from), at(to))
    };
    let bent = from.bent.zip(to.bent).map(|(a, b)| BentRow {
        wall: mix(a.wall, b.wall),
        shear: mix(a.shear, b.shear),
        bends: [mix(a.bends[0], b.bends[0]), mix(a.bends[1], b.bends[1])],
        // what lies between is behind the one and before the other
        von_mises: [mix(a.von_mises[1], b.von_mises[0]); 2],
        pressures: [mix(a.pressures[0], b.pressures[0]), mix(a.pressures[1], b.pressures[1])],
    });
    NodeRow {
        arc: mix(from.arc, to.arc),
        position: [three(0), three(1), three(2)],
        clearance: mix(from.clearance, to.clearance),
        effective: mix(from.effective, to.effective),
        bent,
    }
}
