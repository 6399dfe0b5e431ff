//! `&STATUS SN`: fatigue curves, the user's and those of the library, and the curve each segment of line goes by.

use crate::commands::Job;
use crate::commands::help::wrap;
use crate::commands::status::kind::StatusKind;
use windlass_base::choice::Choice;
use windlass_base::table::{Digits, Table, TableNote};
use windlass_base::units::Dim;
use windlass_model::EntityKind;
use windlass_model::options::C_SN;
use windlass_model::{FatigueKind, FatigueSegment, Model};
use windlass_signal::fatigue::{SnCurve, find, library};

/// `&STATUS SN`.
pub static SN: StatusKind =
    StatusKind::new("SN", "fatigue curves, and those the segments of line classes go by", |query, _| {
        Ok(tables(query.job, &query.fits(), !query.is_named()))
    })
    .with_names(&[EntityKind::Class]);

/// The tables for what follows SN: names of curves or classes, or patterns.
pub fn tables(job: &Job, fits: &dyn Fn(&str) -> bool, all: bool) -> Vec<Table> {
    let model = &job.model;
    let mut tables = Vec::new();
    // what the user defined is asked for first
    let own: Vec<SnCurve> =
        model.fatigue.curves.values().filter(|c| fits(&c.name)).filter_map(|c| SnCurve::from_points(c).ok()).collect();
    if !own.is_empty() {
        tables.push(points(model, fits));
    }
    tables.extend(segments(model, fits));
    let shipped = library_table(fits);
    if all || shipped.rows() > 0 {
        tables.push(shipped);
    }
    tables.retain(|t| t.rows() > 0);
    tables
}

/// The curves of `&REP_SELECT -SN`, as they were given.
fn points(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let curves = model.fatigue.curves.values().filter(|c| fits(&c.name));
    let rows: Vec<_> = curves
        .flat_map(|curve| {
            curve
                .points
                .iter()
                .enumerate()
                .map(move |(i, (range, cycles))| ((i == 0).then_some(curve), curve.kind, *range, *cycles))
        })
        .collect();
    Table::new("Fatigue Curves Defined")
        .with_rows(&rows)
        .text("Name", |(first, ..)| first.map(|c| c.name.as_str()))
        .text("Type", |(first, ..)| first.map(|c| c.kind.word()))
        .column("Range", "Stress", Dim::Stress, Digits::Usual, |(_, kind, range, _)| {
            (*kind == FatigueKind::Stress).then_some(*range)
        })
        .column("Range", "Tension / Break", Dim::None, Digits::Decimals(4), |(_, kind, range, _)| {
            (*kind == FatigueKind::Tension).then_some(*range)
        })
        .column("", "Cycles", Dim::None, Digits::Scientific(5), |(.., cycles)| *cycles)
        .build()
}

/// A segment of a line class with the curve it goes by.
struct SegmentRow<'m> {
    /// The class, on the row of its first segment.
    class: Option<&'m str>,
    /// From 1.
    number: usize,
    segment: FatigueSegment,
    /// The name of the curve.
    name: Option<String>,
    curve: Option<SnCurve>,
}

/// What each segment of a line class goes by.
fn segments(model: &Model, fits: &dyn Fn(&str) -> bool) -> Option<Table> {
    let (mut rows, mut unknown) = (Vec::new(), Vec::new());
    for class in model.classes.values().filter(|c| fits(&c.name)) {
        for (index, segment) in class.fatigue_segments().into_iter().enumerate() {
            let name = model.fatigue.curve_of(&segment).map(str::to_string);
            let curve = name.as_deref().and_then(|n| find(n, &model.fatigue));
            let number = index + 1;
            if let (Some(name), None) = (&name, &curve) {
                let text = format!("{} segment {number}: there is no fatigue curve {name}", class.name);
                unknown.push(TableNote::warning(text));
            }
            rows.push(SegmentRow { class: (index == 0).then_some(&class.name), number, segment, name, curve });
        }
    }
    if rows.is_empty() {
        return None;
    }
    let mut table = Table::new("Fatigue Curves of Segments")
        .with_rows(&rows)
        .text("Class", |row| row.class)
        .column("", "Segment", Dim::None, Digits::Usual, |row| row.number)
        .column("", "Length", Dim::Length, Digits::Usual, |row| row.segment.length)
        .column("", "OD", Dim::Section, Digits::Usual, |row| row.segment.od)
        .column("", "Break", Dim::Force, Digits::Usual, |row| row.segment.breaking)
        .text("Curve", |row| row.name.as_deref())
        .text("Type", |row| row.curve.as_ref().map(|c| c.kind.word()))
        .text("From", |row| match (&row.segment.curve, &row.name) {
            (Some(_), _) => C_SN.name,
            (None, Some(_)) => "&REP_SELECT",
            (None, None) => "none",
        })
        .build();
    if let Some(thickness) = model.fatigue.thickness {
        table = table.fact("Thickness Correction TO", thickness.reference, Dim::Section).fact(
            "                     POWER",
            thickness.power,
            Dim::None,
        );
        if thickness.most.is_finite() {
            table = table.fact("                     MAXCOR", thickness.most, Dim::None);
        }
    }
    table.add_notes(unknown);
    Some(table)
}

/// The curves of the library.
fn library_table(fits: &dyn Fn(&str) -> bool) -> Table {
    let chosen = library().curves.iter().filter(|c| fits(&c.name) || c.aliases.iter().any(|a| fits(a)));
    let rows: Vec<_> = chosen.map(|shipped| (shipped, shipped.curve())).collect();
    let mut used: Vec<&str> = Vec::new();
    for (shipped, _) in &rows {
        if !used.contains(&shipped.source.as_str()) {
            used.push(&shipped.source);
        }
    }
    let some = |v: f64| (v != 0.0).then_some(v);
    let mut table = Table::new("Fatigue Curves of the Library")
        .with_rows(&rows)
        .text("Name", |(shipped, _)| &shipped.name)
        .text("Type", |(_, curve)| curve.kind.word())
        .column("First Branch", "m", Dim::None, Digits::Decimals(2), |(_, c)| c.branches.first().map(|b| b.slope))
        .column("First Branch", "log a", Dim::None, Digits::Decimals(4), |(_, c)| c.branches.first().map(|b| b.log_a))
        .column("First Branch", "Down To", Dim::None, Digits::Decimals(3), |(_, c)| {
            c.branches.first().and_then(|b| some(b.from))
        })
        .column("Second Branch", "m", Dim::None, Digits::Decimals(2), |(_, c)| c.branches.get(1).map(|b| b.slope))
        .column("Second Branch", "log a", Dim::None, Digits::Decimals(4), |(_, c)| c.branches.get(1).map(|b| b.log_a))
        .column("", "Limit", Dim::None, Digits::Decimals(1), |(_, curve)| some(curve.limit))
        .column("", "By Mean", Dim::None, Digits::Decimals(2), |(_, curve)| some(curve.mean_slope))
        .column("", "Legs", Dim::None, Digits::Decimals(0), |(_, curve)| curve.legs)
        .column("", "Thick.", Dim::None, Digits::Decimals(2), |(shipped, _)| some(shipped.thickness_exponent))
        .text("Source", |(shipped, curve)| {
            let number = used.iter().position(|key| *key == shipped.source).map_or(0, |i| i + 1);
            format!("{number}{}", if curve.unconfirmed { " ?" } else { "" })
        })
        .text("What", |(shipped, _)| match shipped.aliases.as_slice() {
            [] => shipped.what.clone(),
            aliases => format!("{} ({})", shipped.what, aliases.join(", ")),
        })
        .build();
    table
        .note("log10 N = log a - m log10 S: S is a stress range in MPa, or a tension range over the breaking tension.");
    table.note("Down To: range at which the second branch begins; Limit: range without damage below it; By Mean: what log a gains");
    table.note("times mean tension / break; Legs: sections of the nominal diameter under stress; Thick.: exponent of thickness the");
    table.note("source gives, which only -THICK_SN applies. A source with ? is not confirmed: check it before a number is quoted.");
    for (index, key) in used.iter().enumerate() {
        let Some(source) = library().sources.get(*key) else { continue };
        let sure = if source.unconfirmed { "NOT CONFIRMED: " } else { "" };
        let text = format!("{} ({sure}{})", source.text, source.how);
        for (line, words) in wrap(&text, 104).into_iter().enumerate() {
            let number = if line == 0 { format!("{}.", index + 1) } else { String::new() };
            table.note(format!("{number:<3} {words}"));
        }
    }
    table
}
