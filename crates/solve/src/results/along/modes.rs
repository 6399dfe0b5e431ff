//! How a line swings between its ends where they stand.

use super::at_rest::visit_lines_at_rest;
use crate::system::SolveError;
use nalgebra::Vector3;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{LineMode, LineNode, Model};

/// The slowest natural modes of the dynamic lines and whose names fit, about where they rest between their ends as
/// these stand: for each line a table, a row a mode, and with `shapes` behind it one of each mode, a row a node.
///
/// # Errors
/// A line that does not rest there, or has fewer modes.
pub fn natural_modes(
    model: &Model,
    fits: &dyn Fn(&str) -> bool,
    number: usize,
    shapes: bool,
) -> Result<Vec<Table>, SolveError> {
    let mut tables = Vec::new();
    visit_lines_at_rest(model, fits, |name, line, at, state| {
        let wrong = SolveError::error_about(name);
        // what is too much is refused before anything is solved
        let modes = line.natural_modes(at, state, number).map_err(&wrong)?;
        let mut nodes = Vec::new();
        line.find_nodes(at, state, &mut nodes).map_err(&wrong)?;
        tables.push(periods(name, &nodes, &modes));
        if shapes {
            for (index, mode) in modes.iter().enumerate() {
                tables.push(shape(name, index + 1, &nodes, mode));
            }
        }
        Ok(())
    })?;
    Ok(tables)
}

/// Periods, where each mode moves most, and which way.
fn periods(name: &str, nodes: &[LineNode], modes: &[LineMode]) -> Table {
    // the node that moves most; of equals the first: which of two equal antinodes is larger by a thousandth is rounding
    let most = |mode: &LineMode| {
        let size = |i: usize| mode.shape.get(i).map_or(0.0, Vector3::norm);
        (0..nodes.len()).fold(0, |most, i| if size(i) > size(most) * 1.001 { i } else { most })
    };
    let rows: Vec<_> = modes.iter().enumerate().map(|(index, mode)| (index + 1, mode, most(mode))).collect();
    let mut table = Table::new("Natural Modes of a Line")
        .fact("Line", name, Dim::None)
        .with_rows(&rows)
        .column("", "Mode", Dim::None, Digits::Usual, |(number, ..)| *number)
        .column("", "Period", Dim::Time, Digits::Decimals(3), |(_, mode, _)| mode.period())
        .column("", "Frequency", Dim::Frequency, Digits::Decimals(4), |(_, mode, _)| mode.frequency)
        .column("Most", "Node", Dim::None, Digits::Usual, |(.., most)| most + 1)
        .columns("Most", ["Arc", "X", "Y", "Z"], Dim::Length, Digits::Usual, |(.., most)| {
            let position = |n: &LineNode| [n.arc, n.position.x, n.position.y, n.position.z].map(|v| Some(clean(v)));
            nodes.get(*most).map_or([None; 4], position)
        })
        .columns("Share of Motion", ["Along", "In Plane", "Across"], Dim::None, Digits::Decimals(3), |(_, mode, _)| {
            shares(nodes, &mode.shape).map(|s| if s < 5e-4 { 0.0 } else { s })
        })
        .build();
    table.note("about rest between its ends where they stand and are held, in the mean current, with added mass, without damping");
    table.note("Along, In Plane and Across are along the line, in the vertical plane of its ends (of X where these are above each other) and across it");
    table
}

/// How much of a motion is along the line, across it in the vertical plane of the ends, and out of that plane: parts of the sum of
/// squares over the length.
fn shares(nodes: &[LineNode], shape: &[Vector3<f64>]) -> [f64; 3] {
    let chord = nodes.first().zip(nodes.last()).map_or_else(Vector3::x, |(a, b)| b.position - a.position);
    let level = Vector3::new(chord.x, chord.y, 0.0);
    let level = if level.norm() > 1e-3 * chord.norm() { level.normalize() } else { Vector3::x() };
    let out = Vector3::z().cross(&level);
    let mut sums = [0.0; 3];
    for (pair, moved) in nodes.windows(2).zip(shape.windows(2)) {
        let ([a, b], [p, q]) = (pair, moved) else { continue };
        let d = b.position - a.position;
        let Some(t) = d.try_normalize(0.0) else { continue };
        // across the line: a line that a current drives aside is not in the plane of its ends
        let beside = (out - t * t.dot(&out)).try_normalize(1e-9).unwrap_or_else(Vector3::zeros);
        for s in [p, q] {
            let (along, aside) = (s.dot(&t), s.dot(&beside));
            let rest = (s.norm_squared() - along * along - aside * aside).max(0.0);
            for (sum, part) in sums.iter_mut().zip([along * along, rest, aside * aside]) {
                *sum += part * (b.arc - a.arc);
            }
        }
    }
    let whole: f64 = sums.iter().sum();
    if whole > 0.0 { sums.map(|s| s / whole) } else { sums }
}

/// A coordinate (m) as zero where it is but rounding.
fn clean(position: f64) -> f64 {
    if position.abs() < 1e-9 { 0.0 } else { position }
}

/// The shape of one mode.
fn shape(name: &str, number: usize, nodes: &[LineNode], mode: &LineMode) -> Table {
    let rows: Vec<_> = nodes.iter().zip(&mode.shape).enumerate().collect();
    Table::new(format!("Shape of Mode {number} of a Line"))
        .fact("Line", name, Dim::None)
        .fact("Period", mode.period(), Dim::Time)
        .with_rows(&rows)
        .column("", "Node", Dim::None, Digits::Usual, |(index, _)| index + 1)
        .column("", "Arc", Dim::Length, Digits::Usual, |(_, (node, _))| node.arc)
        .columns("Place", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(_, (node, _))| {
            <[f64; 3]>::from(node.position).map(clean)
        })
        .columns("Motion", ["X", "Y", "Z"], Dim::None, Digits::Decimals(4), |(_, (_, moved))| {
            // what is nothing but rounding is nothing
            <[f64; 3]>::from(**moved).map(|v| if v.abs() < 5e-5 { 0.0 } else { v })
        })
        .build()
}
