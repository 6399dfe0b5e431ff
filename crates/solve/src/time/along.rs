//! What a run keeps of a dynamic line: some numbers of each of its nodes.
//!
//! A line that a winch lengthens has more nodes later. Nodes are numbered so that 1 is the first end, and each node of the line keeps
//! its number while it lasts, as counted from the second end; a place whose node is not there holds no numbers.

use windlass_model::{ClassError, LineNode};
use windlass_signal::SeriesError;
use windlass_signal::line::envelope::{Envelope, EnvelopeValue};

/// Numbers of every node: unstretched distance from the first end, x, y, z, clearance of the bottom (m; none: not a number), effective
/// tension (N).
const VALUES_PER_NODE: usize = 6;
/// Numbers of a node of a line that bends: also tension in the wall (N), shear (N), moments about two directions (N m), von Mises
/// stress on both sides (Pa; 0 without a wall), pressures outside and inside (Pa).
const VALUES_PER_BENT_NODE: usize = VALUES_PER_NODE + 8;

/// Which numbers of a row are those of the nodes of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct AlongColumns {
    /// Where they begin.
    pub at: usize,
    /// Whether its nodes have a wall, shear and moments to report.
    pub bends: bool,
    /// Numbers of the nodes that are kept, from 1 at the first end.
    pub numbers: Vec<usize>,
    /// Most nodes of the line.
    pub most: usize,
}

/// A node as a row has it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodeRow {
    /// Unstretched distance from the first end (m).
    pub arc: f64,
    /// Position (m, global).
    pub position: [f64; 3],
    /// Height over the bottom (m); not a number without one.
    pub clearance: f64,
    /// Effective tension (N).
    pub effective: f64,
    /// What a line that bends has more.
    pub bent: Option<BentRow>,
}

/// What a node of a line that bends has more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BentRow {
    /// Tension in the wall (N); where two segments meet that of the side with the larger von Mises stress.
    pub wall: f64,
    /// Shear force (N).
    pub shear: f64,
    /// Moments about two directions across the line, carried along it without twist (N m).
    pub bends: [f64; 2],
    /// Largest von Mises stress on the side toward the first end and toward the second (Pa), which differ where two segments meet; 0
    /// without a wall.
    pub von_mises: [f64; 2],
    /// Pressure outside and inside above the atmosphere's (Pa), for a tube.
    pub pressures: [f64; 2],
}

impl BentRow {
    /// Bending moment (N m).
    pub fn moment(&self) -> f64 {
        let [one, other] = self.bends;
        one.hypot(other)
    }

    /// Largest von Mises stress of both sides (Pa).
    pub fn worse(&self) -> f64 {
        let [before, behind] = self.von_mises;
        before.max(behind)
    }
}

impl AlongColumns {
    /// Of a line with at most so many nodes, of which every so manieth is kept, counted from the second end, and both ends; none of a
    /// line without nodes, or where none are kept.
    pub fn new(at: usize, (most, bends): (usize, bool), every: usize) -> Option<Self> {
        if most < 2 || every == 0 {
            return None;
        }
        let mut numbers: Vec<usize> = (2..=most).rev().step_by(every).collect();
        numbers.push(1);
        numbers.reverse();
        Some(AlongColumns { at, bends, numbers, most })
    }

    /// Numbers of a node.
    pub fn stride(&self) -> usize {
        if self.bends { VALUES_PER_BENT_NODE } else { VALUES_PER_NODE }
    }

    /// Numbers of all nodes that are kept.
    pub fn width(&self) -> usize {
        self.stride() * self.numbers.len()
    }

    /// Writes the nodes of an instant, given from the first end.
    ///
    /// # Errors
    /// The node that has something that is no number.
    pub(super) fn write(&self, nodes: &[LineNode], row: &mut [f64]) -> Result<(), ClassError> {
        let Some(own) = row.get_mut(self.at..self.at + self.width()) else { return Ok(()) };
        own.fill(f64::NAN);
        for (number, columns) in self.numbers.iter().zip(own.chunks_exact_mut(self.stride())) {
            let found = match number {
                1 => nodes.first(),
                // counted from the second end, and never the first end twice
                _ => nodes.len().checked_sub(self.most - number + 1).filter(|i| *i > 0).and_then(|i| nodes.get(i)),
            };
            let Some(node) = found else { continue };
            let LineNode { arc, position, effective, shear, moment, clearance, pressures, .. } = node;
            let clearance = if clearance.is_finite() { *clearance } else { f64::NAN };
            let values = [*arc, position.x, position.y, position.z, clearance, *effective];
            let mut whole = values.iter().enumerate().all(|(i, v)| i == 4 || v.is_finite());
            let (first, rest) = columns.split_at_mut(VALUES_PER_NODE);
            first.copy_from_slice(&values);
            if self.bends {
                // of a line that reports its moment alone, all of it is about one direction
                let bends = if node.bends == [0.0; 2] { [*moment, 0.0] } else { node.bends };
                let behind = node.side_after();
                let mises = [node.before.unwrap_or(behind), behind].map(|side| side.von_mises());
                let wall = node.worse().wall;
                let bent = [wall, *shear, bends[0], bends[1], mises[0], mises[1], pressures[0], pressures[1]];
                whole &= bent.iter().all(|v| v.is_finite());
                rest.copy_from_slice(&bent);
            }
            if !whole {
                return Err(ClassError::new(format!("node {number}: result is not finite")));
            }
        }
        Ok(())
    }

    /// A node that is kept, by its place among these, in a row; none where it is not there.
    pub fn node(&self, position: usize, row: &[f64]) -> Option<NodeRow> {
        let from = self.at + self.stride() * position;
        let numbers = row.get(from..from + self.stride()).filter(|_| position < self.numbers.len())?;
        let [arc, x, y, z, clearance, effective, rest @ ..] = numbers else { return None };
        let bent = match rest {
            [wall, shear, one, other, before, behind, outside, inside] => Some(BentRow {
                wall: *wall,
                shear: *shear,
                bends: [*one, *other],
                von_mises: [*before, *behind],
                pressures: [*outside, *inside],
            }),
            _ => None,
        };
        let node = NodeRow { arc: *arc, position: [*x, *y, *z], clearance: *clearance, effective: *effective, bent };
        arc.is_finite().then_some(node)
    }

    /// All nodes that are kept, with their places, from the first end; those that are not there are left out.
    pub fn nodes<'a>(&'a self, row: &'a [f64]) -> impl Iterator<Item = (usize, NodeRow)> + 'a {
        (0..self.numbers.len()).filter_map(|position| Some((position, self.node(position, row)?)))
    }
}

/// Quantities of a node whose least, mean and most are reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeQuantity {
    /// Unstretched distance from the first end (m).
    Arc,
    /// Height over the bottom (m).
    Clearance,
    /// Effective tension (N).
    Effective,
    /// Tension in the wall (N).
    Wall,
    /// Shear force (N).
    Shear,
    /// Bending moment (N m).
    Moment,
    /// The larger von Mises stress of both sides (Pa).
    VonMises,
    /// Von Mises stress of the side toward the first end (Pa).
    VonMisesBefore,
    /// Von Mises stress of the side toward the second end (Pa).
    VonMisesBehind,
}

impl NodeQuantity {
    const ALL: [NodeQuantity; 9] = [
        NodeQuantity::Arc,
        NodeQuantity::Clearance,
        NodeQuantity::Effective,
        NodeQuantity::Wall,
        NodeQuantity::Shear,
        NodeQuantity::Moment,
        NodeQuantity::VonMises,
        NodeQuantity::VonMisesBefore,
        NodeQuantity::VonMisesBehind,
    ];

    /// Its value; not a number of a node that has none.
    pub fn value(self, node: &NodeRow) -> f64 {
        let bent = |of: fn(&BentRow) -> f64| node.bent.as_ref().map_or(f64::NAN, of);
        match self {
            NodeQuantity::Arc => node.arc,
            NodeQuantity::Clearance => node.clearance,
            NodeQuantity::Effective => node.effective,
            NodeQuantity::Wall => bent(|b| b.wall),
            NodeQuantity::Shear => bent(|b| b.shear),
            NodeQuantity::Moment => bent(BentRow::moment),
            NodeQuantity::VonMises => bent(BentRow::worse),
            NodeQuantity::VonMisesBefore => bent(|b| b.von_mises[0]),
            NodeQuantity::VonMisesBehind => bent(|b| b.von_mises[1]),
        }
    }
}

/// Least, mean and most at each node of a line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AlongEnvelope(Envelope);

impl AlongEnvelope {
    /// Takes the nodes of a row.
    ///
    /// # Errors
    /// Something infinite.
    pub fn take(&mut self, along: &AlongColumns, row: &[f64]) -> Result<(), SeriesError> {
        let time = row.first().copied().unwrap_or(f64::NAN);
        let all = (0..along.numbers.len()).flat_map(|position| {
            let node = along.node(position, row);
            NodeQuantity::ALL.map(|quantity| node.as_ref().map_or(f64::NAN, |node| quantity.value(node)))
        });
        self.0.take(time, all)
    }

    /// What was seen of a quantity at the node of a place; none where it never was there.
    pub fn extremes(&self, position: usize, quantity: NodeQuantity) -> Option<EnvelopeValue> {
        self.0.extremes(position * NodeQuantity::ALL.len() + quantity as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    fn line(nodes: usize) -> Vec<LineNode> {
        let at = |i: usize| LineNode {
            arc: i as f64,
            position: Vector3::new(10.0 * i as f64, 0.0, -5.0),
            effective: 100.0 + i as f64,
            clearance: f64::INFINITY,
            bends: [3.0, 4.0],
            ..LineNode::default()
        };
        (0..nodes).map(at).collect()
    }

    #[test]
    fn nodes_keep_their_numbers_from_second_end() {
        let columns = AlongColumns::new(2, (5, false), 1).unwrap();
        assert_eq!(columns.numbers, [1, 2, 3, 4, 5]);
        let mut row = vec![0.0; 2 + columns.width()];
        columns.write(&line(5), &mut row).unwrap();
        let all: Vec<f64> = columns.nodes(&row).map(|(_, n)| n.arc).collect();
        assert_eq!(all, [0.0, 1.0, 2.0, 3.0, 4.0]);
        // a line of three nodes: its first end is node 1, the others 4 and 5
        columns.write(&line(3), &mut row).unwrap();
        let now: Vec<(usize, f64)> = columns.nodes(&row).map(|(p, n)| (columns.numbers[p], n.arc)).collect();
        assert_eq!(now, [(1, 0.0), (4, 1.0), (5, 2.0)]);
        assert_eq!(columns.node(1, &row), None);
        assert_eq!(columns.node(9, &row), None);
        assert!(columns.node(0, &row).unwrap().clearance.is_nan());
        // more than were expected: the end and those next to the other
        columns.write(&line(7), &mut row).unwrap();
        let now: Vec<f64> = columns.nodes(&row).map(|(_, n)| n.arc).collect();
        assert_eq!(now, [0.0, 3.0, 4.0, 5.0, 6.0]);
    }

    #[test]
    fn every_second_node_is_counted_from_second_end_with_both_ends() {
        let columns = AlongColumns::new(0, (6, true), 2).unwrap();
        assert_eq!(columns.numbers, [1, 2, 4, 6]);
        let mut row = vec![0.0; columns.width()];
        columns.write(&line(6), &mut row).unwrap();
        let last = columns.node(3, &row).unwrap();
        assert_eq!((last.arc, last.bent.unwrap().moment()), (5.0, 5.0));
        assert_eq!(AlongColumns::new(0, (6, true), 9).unwrap().numbers, [1, 6]);
        assert_eq!(AlongColumns::new(0, (6, true), 0), None);
        assert_eq!(AlongColumns::new(0, (0, true), 1), None);
    }

    #[test]
    fn envelope_refers_to_nodes_by_position() {
        let columns = AlongColumns::new(1, (3, true), 1).unwrap();
        let mut envelope = AlongEnvelope::default();
        for time in [1.0, 2.0] {
            let mut row = vec![time; 1 + columns.width()];
            let mut nodes = line(if time > 1.5 { 2 } else { 3 });
            nodes.iter_mut().for_each(|n| n.effective *= time);
            columns.write(&nodes, &mut row).unwrap();
            envelope.take(&columns, &row).unwrap();
        }
        let top = envelope.extremes(0, NodeQuantity::Effective).unwrap();
        assert_eq!((top.least.value, top.most.value, top.most.time, top.count), (100.0, 200.0, 2.0, 2));
        assert_eq!(envelope.extremes(1, NodeQuantity::Moment).unwrap().count, 1);
        assert_eq!(envelope.extremes(2, NodeQuantity::Arc).unwrap().least.value, 1.0);
        assert_eq!(envelope.extremes(2, NodeQuantity::Clearance), None);
    }

    #[test]
    fn node_value_not_a_number_is_error() {
        let columns = AlongColumns::new(0, (3, true), 1).unwrap();
        let mut row = vec![0.0; columns.width()];
        let mut nodes = line(3);
        nodes[1].shear = f64::NAN;
        assert!(columns.write(&nodes, &mut row).unwrap_err().to_string().contains("node 2"));
    }
}
