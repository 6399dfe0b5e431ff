//! Fatigue along a line.

use super::LineResults;
use crate::results::RunEvent;
use crate::system::SolveError;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{ClassError, FatigueKind, FatigueSelection, Idealisation};
use windlass_signal::SeriesError;
use windlass_signal::fatigue::{SnCurve, find, life};
use windlass_signal::line::fatigue::{NodeDamage, NodeRecord, TubeCircumference, node_damage};

/// Damage of each node over the stored instants of some events, round a tube at some points, and the life in years that it leaves
/// when the record comes again for ever, with a design fatigue factor; where two segments meet that of the side that fails first. Each segment goes by its curve as for [`super::super::line_damages`].
///
/// # Errors
/// A segment without a curve, a record without length, what [`node_damage`] says.
pub fn fatigue_table(
    line: &LineResults,
    selection: &FatigueSelection,
    (round, factor): (&TubeCircumference, f64),
    events: &[RunEvent],
) -> Result<Table, SolveError> {
    let wrong = |error: ClassError| SolveError { who: Some(line.name.to_string()), error };
    let refused = |e: SeriesError| wrong(ClassError::new(e.to_string()));
    let mut curves = Vec::new();
    for (index, section) in line.sections.iter().enumerate() {
        let named = selection.curve_of(&section.segment);
        let text = match named {
            Some(curve) => format!("there is no fatigue curve {curve}"),
            None => format!("segment {} has no fatigue curve", index + 1),
        };
        let missing = || wrong(ClassError::new(text).help("-C_SN of its class, or &REP_SELECT -SN, names one"));
        curves.push(named.and_then(|c| find(c, selection)).ok_or_else(missing)?);
    }
    let mut row = Vec::new();
    // one for each side: where two segments meet they go by curves and stresses of their own
    let mut records: Vec<[NodeHistory; 2]> = line.positions.iter().map(|_| Default::default()).collect();
    for event in events {
        line.row(event, &mut row);
        let time = row.first().copied().unwrap_or(f64::NAN);
        for (records, position) in records.iter_mut().zip(&line.positions) {
            let Some(node) = line.columns.node(*position, &row) else { continue };
            for (side, segment, section) in line.sides(&node, &row) {
                let Some(record) = records.get_mut(side) else { continue };
                record.take((time, node.arc, segment));
                record.tension.push(section.stress_tension(&node));
                for (moments, value) in record.bends.iter_mut().zip(node.bent.map(|b| b.bends).unwrap_or_default()) {
                    moments.push(value);
                }
            }
        }
    }
    let mut table = Table::new("Fatigue Along a Line")
        .fact("Line", line.name, Dim::None)
        .fact("Model", Idealisation::Dynamic, Dim::None)
        .fact("Record", records.iter().flatten().map(NodeHistory::length).fold(0.0, f64::max), Dim::Time)
        .fact("Design Fatigue Factor", factor, Dim::None);
    let by = |kind: FatigueKind| curves.iter().any(|c| c.kind == kind);
    let round_tubes = line.columns.bends && by(FatigueKind::Stress) && line.sections.iter().any(|s| s.tube.is_some());
    if round_tubes {
        table = table.fact("Points Round a Tube", round.points, Dim::None).fact(
            "Stress Concentration",
            round.concentration,
            Dim::None,
        );
    }
    let mut rows = Vec::new();
    let mut worst: Option<(f64, usize)> = None;
    for (index, sides) in records.iter().enumerate() {
        let mut most = None;
        for record in sides.iter().filter(|r| r.tension.len() > 1) {
            let (Some(section), Some(curve)) = (line.sections.get(record.segment), curves.get(record.segment)) else {
                continue;
            };
            let [one, other] = &record.bends;
            let bends = line.columns.bends.then_some([one.as_slice(), other.as_slice()]);
            let node = NodeRecord { segment: &section.segment, curve, tension: &record.tension, bends };
            let made = node_damage(&node, selection.thickness.as_ref(), round).map_err(refused)?;
            if most.as_ref().is_none_or(|(_, _, found): &(_, _, NodeDamage)| made.damage >= found.damage) {
                most = Some((record, curve, made));
            }
        }
        let Some((record, curve, found)) = most else { continue };
        let years = life(found.damage, record.length(), factor).map_err(refused)?;
        if worst.is_none_or(|(most, _)| found.damage > most) {
            worst = Some((found.damage, index + 1));
        }
        rows.push(FatigueRow { node: index + 1, record, curve, found, years });
    }
    if rows.is_empty() {
        return Err(line.error("fatigue needs more than one instant at which it acts"));
    }
    let largest = |row: &FatigueRow, kind: FatigueKind| (row.curve.kind == kind).then_some(row.found.largest);
    let mut columns = table
        .with_rows(&rows)
        .column("", "Node", Dim::None, Digits::Usual, |row| row.node)
        .column("", "Arc", Dim::Length, Digits::Usual, |row| row.record.arc)
        .column("", "Segment", Dim::None, Digits::Usual, |row| row.record.segment + 1)
        .text("Curve", |row| &row.curve.name)
        .column("", "Cycles", Dim::None, Digits::Decimals(1), |row| row.found.cycles);
    if by(FatigueKind::Stress) {
        columns = columns.column("Largest Range", "Stress", Dim::Stress, Digits::Scientific(3), |row| {
            largest(row, FatigueKind::Stress)
        });
    }
    if by(FatigueKind::Tension) {
        columns = columns
            .column("Largest Range", "T/TB", Dim::None, Digits::Decimals(4), |row| largest(row, FatigueKind::Tension));
    }
    if round_tubes {
        columns = columns.column("", "Point", Dim::Angle, Digits::Decimals(1), |row| row.found.angle);
    }
    let mut table = columns
        .column("", "Damage", Dim::None, Digits::Scientific(4), |row| row.found.damage)
        .column("", "Life, Years", Dim::None, Digits::Scientific(4), |row| row.years)
        .build();
    if let Some((damage, node)) = worst.filter(|(damage, _)| *damage > 0.0) {
        table.note(format!("most damage is at node {node}: {damage:.4E}"));
    }
    for curve in curves.iter().filter(|c| c.unconfirmed) {
        note_once(&mut table, curve);
    }
    table.note("Life is that of this record coming again for ever, over the design fatigue factor; none where there is no damage");
    Ok(table)
}

fn note_once(table: &mut Table, curve: &SnCurve) {
    let text = format!("the numbers of curve {} are not confirmed: &STATUS SN", curve.name);
    if !table.notes.iter().any(|note| note.text == text) {
        table.note(text);
    }
}

/// A node with the side of it that has the most damage.
struct FatigueRow<'r> {
    /// From 1.
    node: usize,
    record: &'r NodeHistory,
    curve: &'r SnCurve,
    found: NodeDamage,
    /// Years until the damage is 1; none without damage.
    years: Option<f64>,
}

/// What a node bore while it was there.
#[derive(Debug, Default)]
struct NodeHistory {
    from: Option<f64>,
    to: f64,
    arc: f64,
    segment: usize,
    tension: Vec<f64>,
    bends: [Vec<f64>; 2],
}

impl NodeHistory {
    fn take(&mut self, (time, arc, segment): (f64, f64, usize)) {
        self.from = self.from.or(Some(time));
        (self.to, self.arc, self.segment) = (time, arc, segment);
    }

    /// How long it was there (s).
    fn length(&self) -> f64 {
        self.from.map_or(0.0, |from| self.to - from)
    }
}
