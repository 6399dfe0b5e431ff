//! The tension of each segment of a dynamic line over a run, what its anchor bears and how much of it lies on the bottom.

use super::LineResults;
use crate::results::RunEvent;
use crate::results::line_loads::{AnchorRecord, TensionSeries};
use crate::results::line_paths::PathPoint;
use crate::time::NodeRow;

/// The largest effective tension of the nodes of each segment at each event, the most the anchor bears, and the least length on the
/// bottom. A pull on the anchor is the tension of the last node along the last part of the line; where that part lies on the bottom, the
/// anchor is not pulled up.
pub(crate) fn line_loads(line: &LineResults, to_ground: bool, events: &[RunEvent]) -> TensionSeries {
    let mut made = TensionSeries {
        times: Vec::with_capacity(events.len()),
        segments: vec![Vec::with_capacity(events.len()); line.sections.len()],
        anchor: to_ground.then(AnchorRecord::default),
        grounded: None,
    };
    let mut row = Vec::new();
    for event in events {
        line.row(event, &mut row);
        made.times.push(row.first().copied().unwrap_or(f64::NAN));
        let nodes: Vec<NodeRow> =
            line.numbered_nodes().filter_map(|(_, position)| line.columns.node(position, &row)).collect();
        let mut most = vec![f64::NAN; line.sections.len()];
        for node in &nodes {
            for (_, segment, _) in line.sides(node, &row) {
                if let Some(value) = most.get_mut(segment) {
                    *value = value.max(node.effective);
                }
            }
        }
        made.segments.iter_mut().zip(most).for_each(|(series, value)| series.push(value));
        let lies = |pair: &&[NodeRow]| pair.iter().all(|node| node.clearance <= 0.0);
        let grounded: f64 =
            nodes.windows(2).filter(lies).filter_map(|pair| Some(pair.last()?.arc - pair.first()?.arc)).sum();
        made.grounded = Some(made.grounded.map_or(grounded, |least: f64| least.min(grounded)));
        if let (Some(anchor), [.., before, last]) = (&mut made.anchor, nodes.as_slice()) {
            let way: [f64; 3] = std::array::from_fn(|i| before.position[i] - last.position[i]);
            let length = way.iter().fold(0.0, |sum: f64, d| sum.hypot(*d));
            let share = if length > 0.0 { last.effective / length } else { 0.0 };
            let up = if before.clearance <= 0.0 { 0.0 } else { (share * way[2]).max(0.0) };
            anchor.take([share * way[0].hypot(way[1]), up]);
        }
    }
    made
}

/// Where the nodes of a dynamic line are at an event.
pub(crate) fn dynamic_path(line: &LineResults, event: &RunEvent) -> Vec<PathPoint> {
    let mut row = Vec::new();
    line.row(event, &mut row);
    line.numbered_nodes()
        .filter_map(|(_, position)| line.columns.node(position, &row))
        .map(|node| PathPoint {
            segment: line.sides(&node, &row).last().map_or(0, |(_, segment, _)| segment) + 1,
            position: node.position.into(),
            height: Some(node.clearance).filter(|height| height.is_finite()),
        })
        .collect()
}
