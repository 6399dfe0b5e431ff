//! The thirty rows of a mooring line as the table of `CONN_DESIGN TABLE`.

use super::mooring::Mooring;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_catenary::{Buoy, JointState, MissingRow, TableRow};
use windlass_model::{Idealisation, Note};

/// The twelve columns of TABLE [MOSES-RUNS con_d]; a row without a configuration has its force alone.
pub fn report(mooring: &Mooring, connector: &str, found: &[TableRow], missing: &[MissingRow]) -> Table {
    let rows = merge_missing_rows(found, missing);
    let bottom = mooring.line.floor().map(|f| f.elevation).or(mooring.bottom);
    let force_of = |number: usize| missing.iter().find(|m| m.number == number).map(|m| m.force);
    let outcomes: Vec<Result<&TableRow, Option<f64>>> =
        rows.iter().enumerate().map(|(index, row)| row.ok_or_else(|| force_of(index + 1))).collect();
    let mut out = Table::new(format!("Properties of Line {connector}"))
        .fact("Model", Idealisation::QuasiStatic, Dim::None)
        .fact("Water Depth", bottom.map(|b| -b), Dim::Length)
        .fact("Fairlead Above Mean Water", mooring.fairlead(), Dim::Length)
        .fact("Length of First Segment", mooring.line.segments().first().map(|s| s.length), Dim::Length)
        .with_rows(&outcomes)
        .column("", "X", Dim::Length, Digits::Usual, |row| row.ok().map(|r| r.state.x))
        .column("Horizontal", "Force", Dim::Force, Digits::Usual, |row| match row {
            Ok(row) => Some(row.state.force),
            Err(force) => *force,
        })
        .column("Horizontal", "DF/DX", Dim::ForcePerLength, Digits::Decimals(3), |row| {
            row.ok().map(|r| 1.0 / r.state.dx_dh)
        })
        .column("Tension", "Ten Top", Dim::Force, Digits::Usual, |row| row.ok().map(|r| r.state.top_tension))
        .column("Tension", "Max T/TB", Dim::None, Digits::Decimals(3), |row| row.ok().map(|r| r.ratio))
        .column("Tension", "Cri Break", Dim::Force, Digits::Usual, |row| row.ok().map(|r| r.critical_break))
        .column("Tension", "Crit. Seg", Dim::None, Digits::Usual, |row| row.ok().map(|r| r.critical))
        .column("Anchor", "V. Pull", Dim::Force, Digits::Usual, |row| row.ok().map(|r| r.state.anchor_vertical))
        .column("Anchor", "H. Pull", Dim::Force, Digits::Usual, |row| row.ok().map(|r| r.state.anchor_horizontal))
        .column("", "Line on Bottom", Dim::Length, Digits::Usual, |row| row.ok().map(|r| r.state.grounded_stretched))
        .column("1st Connection", "Height Ab Anchor", Dim::Length, Digits::Usual, |row| {
            row.ok().and_then(first_joint).map(|j| j.z - mooring.line.anchor())
        })
        .column("1st Connection", "Net Force Applied", Dim::Force, Digits::Usual, |row| {
            row.ok().and_then(first_joint).map(|j| j.lift)
        })
        .build();
    let is = |which: fn(&TableRow) -> bool| move |row: &Option<&TableRow>| row.is_some_and(which);
    if let Some(first) = rows.iter().position(is(|r| r.ratio > 1.0)) {
        out.note(format!("{} beyond the breaking tension (Max T/TB above 1)", rows_from(first, rows.len() - 1)));
    }
    let buoy = |row: &Option<&TableRow>| row.and_then(|r| r.state.joints.iter().find_map(|j| j.buoy));
    let states: Vec<Option<Buoy>> = rows.iter().map(buoy).collect();
    out.add_notes(buoy_notes(&states));
    out.add_notes(mooring.notes.iter().map(Note::for_table_without_values));
    if rows.iter().any(is(|r| !r.state.below_bottom.is_empty())) {
        out.warn("a segment above the spring buoy hangs below the bottom in some rows (it does not see it)");
    }
    let above = is(|r| !r.state.above_surface.is_empty());
    if let Some(first) = rows.iter().position(above) {
        let last = rows.iter().rposition(above).unwrap_or(first);
        let which = rows_from(first, last);
        out.warn(format!("{which} with a buoyant part of the line above the water surface, which it does not see"));
    }
    out
}

/// The joint next to the fairlead.
fn first_joint(row: &TableRow) -> Option<&JointState> {
    row.state.joints.first()
}

/// The rows of a table in their order, those without a configuration among them.
fn merge_missing_rows<'a>(found: &'a [TableRow], missing: &[MissingRow]) -> Vec<Option<&'a TableRow>> {
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
