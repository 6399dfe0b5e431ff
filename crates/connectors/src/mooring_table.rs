//! The thirty rows of a mooring line as the table of `CONN_DESIGN TABLE`.

use super::mooring::Mooring;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_catenary::{Buoy, MissingRow, Row};
use windlass_model::QUASI_STATIC;

/// The twelve columns of TABLE [MOSES-RUNS con_d]; a row without a configuration has its force alone.
pub fn report(mooring: &Mooring, connector: &str, found: &[Row], missing: &[MissingRow]) -> Table {
    let rows = numbered(found, missing);
    let bottom = mooring.line.floor().map(|f| f.elevation).or(mooring.bottom);
    let mut out = Table::new(format!("Properties of Line {connector}"))
        .fact("Model", QUASI_STATIC, Dim::None)
        .fact("Water Depth", bottom.map(|b| -b), Dim::Length)
        .fact("Fairlead Above Mean Water", mooring.fairlead(), Dim::Length)
        .fact("Length of First Segment", mooring.line.segments().first().map(|s| s.length), Dim::Length)
        .column("", "X", Dim::Length, Digits::Usual)
        .column("Horizontal", "Force", Dim::Force, Digits::Usual)
        .column("Horizontal", "DF/DX", Dim::ForcePerLength, Digits::Decimals(3))
        .column("Tension", "Ten Top", Dim::Force, Digits::Usual)
        .column("Tension", "Max T/TB", Dim::None, Digits::Decimals(3))
        .column("Tension", "Cri Break", Dim::Force, Digits::Usual)
        .column("Tension", "Crit. Seg", Dim::None, Digits::Usual)
        .column("Anchor", "V. Pull", Dim::Force, Digits::Usual)
        .column("Anchor", "H. Pull", Dim::Force, Digits::Usual)
        .column("", "Line on Bottom", Dim::Length, Digits::Usual)
        .column("1st Connection", "Height Ab Anchor", Dim::Length, Digits::Usual)
        .column("1st Connection", "Net Force Applied", Dim::Force, Digits::Usual);
    for (number, row) in rows.iter().enumerate() {
        let Some(row) = row else {
            let force = missing.iter().find(|m| m.number == number + 1).map(|m| m.force);
            let mut cells = vec![Cell::Missing; 12];
            if let Some(cell) = cells.get_mut(1) {
                *cell = force.into();
            }
            let _ = out.push(cells);
            continue;
        };
        let s = &row.state;
        let joint = s.joints.first();
        let cells: Vec<Cell> = vec![
            s.x.into(),
            s.force.into(),
            (1.0 / s.dx_dh).into(),
            s.top_tension.into(),
            row.ratio.into(),
            row.critical_break.into(),
            row.critical.into(),
            s.anchor_vertical.into(),
            s.anchor_horizontal.into(),
            s.grounded_stretched.into(),
            joint.map(|j| j.z - mooring.line.anchor()).into(),
            joint.map(|j| j.lift).into(),
        ];
        // the row has one cell a column, made just above
        let _ = out.push(cells);
    }
    let is = |which: fn(&Row) -> bool| move |row: &Option<&Row>| row.is_some_and(which);
    if let Some(first) = rows.iter().position(is(|r| r.ratio > 1.0)) {
        out.note(format!("{} beyond the breaking tension (Max T/TB above 1)", rows_from(first, rows.len() - 1)));
    }
    let buoy = |row: &Option<&Row>| row.and_then(|r| r.state.joints.iter().find_map(|j| j.buoy));
    let states: Vec<Option<Buoy>> = rows.iter().map(buoy).collect();
    out.notes.extend(buoy_notes(&states));
    out.notes.extend(mooring.notes.iter().map(|n| n.to_string()));
    if rows.iter().any(is(|r| !r.state.below_bottom.is_empty())) {
        out.note("warning: a segment above the spring buoy hangs below the bottom in some rows (it does not see it)");
    }
    let above = is(|r| !r.state.above_surface.is_empty());
    if let Some(first) = rows.iter().position(above) {
        let last = rows.iter().rposition(above).unwrap_or(first);
        let which = rows_from(first, last);
        out.note(format!(
            "warning: {which} with a buoyant part of the line above the water surface, which it does not see"
        ));
    }
    out
}

/// The rows of a table in their order, those without a configuration among them.
fn numbered<'a>(found: &'a [Row], missing: &[MissingRow]) -> Vec<Option<&'a Row>> {
    let mut found = found.iter();
    let all = found.len() + missing.len();
    (1..=all).map(|n| if missing.iter().any(|m| m.number == n) { None } else { found.next() }).collect()
}

/// `row 3 is` or `rows 3 to 5 are`, counted from 1.
fn rows_from(first: usize, last: usize) -> String {
    if first == last { format!("row {} is", first + 1) } else { format!("rows {} to {} are", first + 1, last + 1) }
}

/// How a buoy stands, in a word.
pub fn buoy_word(buoy: Buoy) -> &'static str {
    match buoy {
        Buoy::Slack => "slack",
        Buoy::Held => "held by its pendant",
        Buoy::Sunk => "sunk",
    }
}

/// In which rows a spring buoy floats, hangs slack, or is sunk.
fn buoy_notes(states: &[Option<Buoy>]) -> Vec<String> {
    let mut notes = Vec::new();
    let mut from = 0;
    while let Some(state) = states.get(from) {
        let run = states.iter().skip(from).take_while(|s| *s == state).count();
        if let Some(state) = state {
            notes.push(format!("{} with the spring buoy {}", rows_from(from, from + run - 1), buoy_word(*state)));
        }
        from += run;
    }
    notes
}
