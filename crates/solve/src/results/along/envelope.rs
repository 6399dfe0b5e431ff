//! The least, mean and most at each node.

use super::{CLEARANCE, LineResults, segments_at, sides};
use crate::results::RunEvent;
use crate::system::SolveError;
use crate::time::{AlongEnvelope, NodeQuantity};
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::Idealisation;

/// Quantities reported, with the head of their columns and the sign they have there.
const ENVELOPE_QUANTITIES: [(&str, &str, NodeQuantity, Dim); 6] = [
    ("Clearance", "C", NodeQuantity::Clearance, Dim::Length),
    ("Effective Tension", "T", NodeQuantity::Effective, Dim::Force),
    ("Wall Tension", "W", NodeQuantity::Wall, Dim::Force),
    ("Shear", "V", NodeQuantity::Shear, Dim::Force),
    ("Bending Moment", "M", NodeQuantity::Moment, Dim::Moment),
    ("Von Mises", "S", NodeQuantity::VonMises, Dim::Stress),
];

/// Least, mean and most of clearance, tensions, shear, moment and von Mises stress at each node over some events, and the largest share
/// of the yield stress of a tube or of the break of another section; of a run without stored instants over those behind its transient.
///
/// # Errors
/// Numbers that make no table.
pub fn envelope(line: &LineResults, events: &[RunEvent]) -> Result<Table, SolveError> {
    let (run, columns) = (line.run, line.columns);
    let mut made = AlongEnvelope::default();
    let mut row = Vec::new();
    for event in events {
        line.row(event, &mut row);
        made.take(columns, &row).map_err(|e| line.error(e.to_string()))?;
    }
    let seen = match run.envelopes.get(line.link) {
        Some(kept) if run.history.is_empty() => kept,
        _ => &made,
    };
    let wall = columns.bends && line.sections.iter().any(|s| s.tube.is_some());
    let quantities: Vec<_> = ENVELOPE_QUANTITIES
        .iter()
        .filter(|(.., quantity, _)| match quantity {
            NodeQuantity::Clearance | NodeQuantity::Effective => true,
            NodeQuantity::Wall | NodeQuantity::VonMises => wall,
            _ => columns.bends,
        })
        .collect();
    let mut rows = Vec::new();
    let length = line.positions.last().and_then(|p| seen.extremes(*p, NodeQuantity::Arc)).map_or(f64::NAN, |s| s.mean);
    let (mut worst, mut wound): (Option<(f64, usize)>, bool) = (None, false);
    for (number, position) in line.numbered_nodes() {
        let of = |quantity: NodeQuantity| seen.extremes(position, quantity);
        let arc = of(NodeQuantity::Arc).map(|s| s.mean);
        wound |= of(NodeQuantity::Arc).is_some_and(|s| s.most.value - s.least.value > 1e-6 * length);
        let used = arc.zip(of(NodeQuantity::Effective)).and_then(|(arc, tension)| {
            let stress = [NodeQuantity::VonMisesBefore, NodeQuantity::VonMisesBehind].map(of);
            let sides = sides(&line.sections, segments_at(&line.sections, length - arc));
            let used = sides.map(|(side, _, section)| {
                section.utilisation(tension.most.value, stress.get(side).and_then(|s| Some(s.as_ref()?.most.value)))
            });
            used.reduce(f64::max)
        });
        if let Some(used) = used
            && worst.is_none_or(|(most, _)| used > most)
        {
            worst = Some((used, number));
        }
        rows.push((number, position, arc, used));
    }
    let mut table = Table::new("Envelope Along a Line")
        .fact("Line", line.name, Dim::None)
        .fact("Model", Idealisation::Dynamic, Dim::None)
        .with_rows(&rows)
        .column("", "Node", Dim::None, Digits::Usual, |(number, ..)| *number)
        .column("", "Arc", Dim::Length, Digits::Usual, |(_, _, arc, _)| *arc);
    for (group, sign, quantity, dim) in quantities {
        let digits = if *sign == "C" { CLEARANCE } else { Digits::Usual };
        let names = ["Min", "Mean", "Max"].map(|part| format!("{sign} {part}"));
        table = table.columns(group, names.each_ref().map(String::as_str), *dim, digits, |(_, position, ..)| {
            let found = seen.extremes(*position, *quantity);
            found.map_or([None; 3], |s| [s.least.value, s.mean, s.most.value].map(Some))
        });
    }
    let mut table = table.column("", "Utilisation", Dim::None, Digits::Decimals(3), |(.., used)| *used).build();
    if let Some((used, node)) = worst {
        table.note(format!("most is used at node {node}: {used:.3}"));
    }
    table.note(if wall {
        "Utilisation is von Mises stress over yield stress of a tube, tension over breaking tension of other sections"
    } else {
        "Utilisation is tension over breaking tension"
    });
    if wound {
        table.note("a winch changed the length: Arc is the mean of each node while it was there");
    }
    if line.columns.most > line.nodes() && run.settings.along > 1 {
        table.note(format!("every {} node is kept: TDOM -ALONG", ordinal(run.settings.along)));
    }
    Ok(table)
}

/// 2nd, 3rd, 4th.
fn ordinal(number: usize) -> String {
    let ending = match (number % 10, number % 100) {
        (1, rest) if rest != 11 => "st",
        (2, rest) if rest != 12 => "nd",
        (3, rest) if rest != 13 => "rd",
        _ => "th",
    };
    format!("{number}{ending}")
}
