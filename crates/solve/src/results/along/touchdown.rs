//! Where a line meets the bottom.

use super::LineResults;
use crate::results::{EventTable, RunEvent};
use crate::system::SolveError;
use crate::time::NodeRow;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::Idealisation;

/// The touchdown point over some events, from the first end: the first node on the bottom with its distance and tension, the point
/// between it and the one before at which the line would begin to lie, and the unstretched length on the bottom.
///
/// # Errors
/// None of its own.
pub fn touchdown(line: &LineResults, events: &[RunEvent]) -> Result<Table, SolveError> {
    let mut table = EventTable::new("Touchdown", (&line.run.history, events), |row| {
        let there: Vec<(usize, NodeRow)> = line
            .numbered_nodes()
            .filter_map(|(number, position)| Some((number, line.columns.node(position, row)?)))
            .collect();
        let Some(first) = there.iter().position(|(_, n)| n.clearance <= 0.0) else {
            return Ok(Touchdown { grounded: if there.is_empty() { f64::NAN } else { 0.0 }, ..Touchdown::NONE });
        };
        let Some((number, node)) = there.get(first) else { return Ok(Touchdown::NONE) };
        let before = |back: usize| first.checked_sub(back).and_then(|i| there.get(i)).map(|(_, n)| n);
        let (arc, position) = interpolate_touchdown(before(2), before(1), node);
        let lies = |pair: &&[(usize, NodeRow)]| pair.iter().all(|(_, n)| n.clearance <= 0.0);
        let pairs = there.windows(2).filter(lies).filter_map(|p| Some(p.last()?.1.arc - p.first()?.1.arc));
        let (node_arc, tension) = (node.arc, node.effective);
        Ok(Touchdown { node: *number as f64, node_arc, tension, arc, position, grounded: pairs.sum() })
    })?
    .fact("Line", line.name, Dim::None)
    .fact("Model", Idealisation::Dynamic, Dim::None)
    .column("First Node on Bottom", "Node", Dim::None, Digits::Decimals(0), |t| t.node)
    .columns("First Node on Bottom", ["Node Arc"], Dim::Length, |t| [t.node_arc])
    .columns("First Node on Bottom", ["Tension"], Dim::Force, |t| [t.tension])
    .columns("Touchdown", ["Arc"], Dim::Length, |t| [t.arc])
    .columns("Touchdown", ["X", "Y", "Z"], Dim::Length, |t| t.position)
    .columns("On Bottom", ["Length"], Dim::Length, |t| [t.grounded])
    .build();
    table.note(
        "Touchdown lies between the first node on the bottom and the one before, where a parabola through the two nodes before comes down",
    );
    Ok(table)
}

/// Where a line meets the bottom; what is not there is not a number.
struct Touchdown {
    /// Number of the first node on the bottom, from 1, its distance from the first end (m) and its tension (N).
    node: f64,
    node_arc: f64,
    tension: f64,
    /// Distance (m) and place (m) at which the line begins to lie.
    arc: f64,
    position: [f64; 3],
    /// Unstretched length on the bottom (m).
    grounded: f64,
}

impl Touchdown {
    /// Of a line that does not touch down.
    const NONE: Self = Touchdown {
        node: f64::NAN,
        node_arc: f64::NAN,
        tension: f64::NAN,
        arc: f64::NAN,
        position: [f64::NAN; 3],
        grounded: f64::NAN,
    };
}

/// The unstretched distance and the place at which a line comes down between the last node off the bottom and the first on it. A
/// heavy line leaves the bottom with the height growing as the square of the distance, so that the roots of two heights tell where from.
fn interpolate_touchdown(far: Option<&NodeRow>, last: Option<&NodeRow>, first: &NodeRow) -> (f64, [f64; 3]) {
    let Some(last) = last else { return (first.arc, first.position) };
    let far = far.filter(|f| f.clearance > last.clearance && last.clearance > 0.0);
    let on = far.map_or(first.arc, |far| {
        let [high, low] = [far.clearance.sqrt(), last.clearance.sqrt()];
        last.arc + (last.arc - far.arc) * low / (high - low)
    });
    let on = on.clamp(last.arc, first.arc);
    let share = (on - last.arc) / (first.arc - last.arc);
    let mut at = last.position;
    for (value, next) in at.iter_mut().zip(first.position) {
        *value += share * (next - *value);
    }
    (on, at)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn node(arc: f64, clearance: f64) -> NodeRow {
        NodeRow { arc, position: [10.0 * arc, 0.0, clearance], clearance, effective: 1.0, bent: None }
    }

    #[test]
    fn line_touches_down_at_root_of_its_parabola() {
        // heights 0.02 (s - 7.3)^2 on the way down
        let height = |s: f64| 0.02 * (s - 7.3f64).powi(2);
        let [far, last, first] = [node(5.0, height(5.0)), node(6.0, height(6.0)), node(8.0, -0.001)];
        let (arc, at) = interpolate_touchdown(Some(&far), Some(&last), &first);
        assert!((arc - 7.3).abs() < 1e-12 && (at[0] - 73.0).abs() < 1e-9, "{arc} {at:?}");
        // never beyond the node that lies
        assert_eq!(interpolate_touchdown(Some(&far), Some(&last), &node(7.0, 0.0)).0, 7.0);
        // without a node to tell the slope by, that node
        assert_eq!(interpolate_touchdown(None, Some(&last), &first).0, 8.0);
        assert_eq!(interpolate_touchdown(None, None, &first), (8.0, first.position));
    }
}
