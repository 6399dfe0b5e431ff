//! Where a line is at an instant, with its forces there; and its nodes over time.

use super::{CLEARANCE, Line};
use crate::results::{Event, columns, filled, timed};
use crate::system::SolveError;
use crate::time::{BentRow, NodeRow};
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{ClassError, DYNAMIC};

/// A place along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Where {
    /// A node, from 1 at the first end.
    Node(usize),
    /// An unstretched distance from the first end (m); what is between two nodes is on the straight line between theirs.
    Arc(f64),
}

/// Columns of a node behind its place.
fn forces(mut table: Table, group: &str, bends: bool) -> Table {
    table = columns(table, group, &["X", "Y", "Z"], Dim::Length).column(group, "Clearance", Dim::Length, CLEARANCE);
    table = columns(table, group, &["Tension"], Dim::Force);
    if bends {
        table = columns(table, group, &["Wall", "Shear"], Dim::Force);
        table = columns(table, group, &["Moment", "M1", "M2"], Dim::Moment);
        table = columns(table, group, &["Von Mises"], Dim::Stress);
    }
    table
}

/// The numbers of these columns.
fn told(node: Option<&NodeRow>, bends: bool, out: &mut Vec<f64>) {
    let Some(node) = node else {
        out.extend(std::iter::repeat_n(f64::NAN, if bends { 11 } else { 5 }));
        return;
    };
    out.extend(node.position);
    out.extend([node.clearance, node.effective]);
    if let Some(bent) = &node.bent {
        let BentRow { wall, shear, bends: [one, other], .. } = *bent;
        out.extend([wall, shear, bent.moment(), one, other, bent.worse()]);
    }
}

/// The line at an event: its nodes from the first end.
///
/// # Errors
/// Numbers that make no table.
pub fn shape(line: &Line, event: &Event) -> Result<Table, SolveError> {
    let mut row = Vec::new();
    line.row(event, &mut row);
    let bends = line.columns.bends;
    let time = row.first().copied().unwrap_or(f64::NAN);
    let mut table = Table::new("Along a Line at an Instant")
        .fact("Line", line.name, Dim::None)
        .fact("Model", DYNAMIC, Dim::None)
        .fact("Time", time, Dim::Time)
        .column("", "Node", Dim::None, Digits::Usual)
        .column("", "Arc", Dim::Length, Digits::Usual);
    table = forces(table, "", bends).column("", "Used", Dim::None, Digits::Decimals(3));
    let mut numbers = Vec::new();
    for (number, place) in line.numbered() {
        // a node that a winch has not made yet has no row
        let Some(node) = line.columns.node(place, &row) else { continue };
        let mut cells: Vec<Cell> = vec![number.into(), node.arc.into()];
        numbers.clear();
        told(Some(&node), bends, &mut numbers);
        cells.extend(numbers.iter().map(|v| if v.is_finite() { Cell::Number(v + 0.0) } else { Cell::Missing }));
        cells.push(line.used(&node, &row).into());
        table.push(cells).map_err(|e| line.wrong(e.to_string()))?;
    }
    if table.rows() == 0 {
        table.note("the line does not act then");
    }
    Ok(table)
}

/// Places of a line over some events.
///
/// # Errors
/// A node that the line has not, a distance beyond its ends at every event.
pub fn histories(line: &Line, wanted: &[Where], events: &[Event]) -> Result<Table, SolveError> {
    let (run, bends) = (line.run, line.columns.bends);
    let mut table = timed("Places Along a Line").fact("Line", line.name, Dim::None).fact("Model", DYNAMIC, Dim::None);
    let mut places = Vec::new();
    for (index, place) in wanted.iter().enumerate() {
        let group = match place {
            Where::Node(number) => {
                let found = number.checked_sub(1).and_then(|i| line.places.get(i));
                let found = found.ok_or_else(|| {
                    let text = format!("{} has no node {number}: they are 1 to {}", line.name, line.nodes());
                    SolveError::new(ClassError::new(text))
                })?;
                places.push(Ok(*found));
                format!("Node {number}")
            }
            Where::Arc(arc) => {
                places.push(Err(*arc));
                let name = format!("Place {}", index + 1);
                table = table.fact(&name, *arc, Dim::Length);
                name
            }
        };
        table = forces(table, &group, bends);
    }
    let table = filled((&run.history, events), table, &mut |row, made| {
        for place in &places {
            let node = match place {
                Ok(place) => line.columns.node(*place, row),
                Err(arc) => line.at_arc(*arc, row),
            };
            told(node.as_ref(), bends, made);
        }
        Ok(())
    })?;
    let empty = |c: &&windlass_base::table::Column| c.cells.iter().all(|c| *c == Cell::Missing);
    if wanted.iter().any(|w| matches!(w, Where::Arc(_)))
        && let Some(column) = table.columns.iter().filter(|c| c.name == "Tension").find(empty)
    {
        let text = format!("{} of {} is beyond its ends at all these times", column.group, line.name);
        return Err(SolveError::new(ClassError::new(text)));
    }
    Ok(table)
}

impl Line<'_> {
    /// The line at an unstretched distance from its first end (m) in a row; none beyond its ends.
    pub(super) fn at_arc(&self, arc: f64, row: &[f64]) -> Option<NodeRow> {
        let mut before: Option<NodeRow> = None;
        let near = 1e-9 * self.length(row).abs();
        for (_, node) in self.columns.nodes(row) {
            if node.arc >= arc - near {
                let Some(from) = before else { return (node.arc <= arc + near).then_some(node) };
                let share = ((arc - from.arc) / (node.arc - from.arc)).clamp(0.0, 1.0);
                return Some(between(&from, &node, share));
            }
            before = Some(node);
        }
        None
    }
}

/// A share of the way from one node to another.
fn between(from: &NodeRow, to: &NodeRow, share: f64) -> NodeRow {
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
