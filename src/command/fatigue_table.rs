//! `&STATUS SN`: fatigue curves, the user's and those of the library, and the curve each segment of line goes by.

use super::Job;
use super::help::wrap;
use super::status::push;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{FatigueKind, Model};
use windlass_signal::fatigue::{Curve, find, library};

/// The tables for what follows SN: names of curves or classes, or patterns.
pub fn tables(job: &Job, fits: &dyn Fn(&str) -> bool, all: bool) -> Vec<Table> {
    let model = &job.model;
    let mut tables = Vec::new();
    // what the user defined is asked for first
    let own: Vec<Curve> =
        model.fatigue.curves.values().filter(|c| fits(&c.name)).filter_map(|c| Curve::through(c).ok()).collect();
    if !own.is_empty() {
        tables.push(points(model, fits));
    }
    tables.extend(segments(model, fits));
    let shipped = shipped(fits);
    if all || shipped.rows() > 0 {
        tables.push(shipped);
    }
    tables.retain(|t| t.rows() > 0);
    tables
}

/// The curves of `&REP_SELECT -SN`, as they were given.
fn points(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let mut table = Table::new("Fatigue Curves Defined")
        .column("", "Name", Dim::None, Digits::Usual)
        .column("", "Type", Dim::None, Digits::Usual)
        .column("Range", "Stress", Dim::Stress, Digits::Usual)
        .column("Range", "Tension / Break", Dim::None, Digits::Decimals(4))
        .column("", "Cycles", Dim::None, Digits::Scientific(5));
    for curve in model.fatigue.curves.values().filter(|c| fits(&c.name)) {
        for (index, (range, cycles)) in curve.points.iter().enumerate() {
            let first = |text: &str| if index == 0 { Cell::from(text) } else { Cell::Missing };
            let (stress, tension) = match curve.kind {
                FatigueKind::Stress => (Cell::Number(*range), Cell::Missing),
                FatigueKind::Tension => (Cell::Missing, Cell::Number(*range)),
            };
            push(&mut table, vec![first(&curve.name), first(curve.kind.name()), stress, tension, (*cycles).into()]);
        }
    }
    table
}

/// What each segment of a line class goes by.
fn segments(model: &Model, fits: &dyn Fn(&str) -> bool) -> Option<Table> {
    let mut table = Table::new("Fatigue Curves of Segments")
        .column("", "Class", Dim::None, Digits::Usual)
        .column("", "Segment", Dim::None, Digits::Usual)
        .column("", "Length", Dim::Length, Digits::Usual)
        .column("", "OD", Dim::Section, Digits::Usual)
        .column("", "Break", Dim::Force, Digits::Usual)
        .column("", "Curve", Dim::None, Digits::Usual)
        .column("", "Type", Dim::None, Digits::Usual)
        .column("", "From", Dim::None, Digits::Usual);
    let mut unknown = Vec::new();
    for class in model.classes.values().filter(|c| fits(&c.name)) {
        for (index, segment) in class.fatigue_segments().iter().enumerate() {
            let name = model.fatigue.curve_of(segment);
            let curve = name.and_then(|n| find(n, &model.fatigue));
            if let (Some(name), None) = (name, &curve) {
                unknown.push(format!(
                    "warning: {} segment {}: there is no fatigue curve {name}",
                    class.name,
                    index + 1
                ));
            }
            let from = match (&segment.curve, name) {
                (Some(_), _) => "-C_SN",
                (None, Some(_)) => "&REP_SELECT",
                (None, None) => "none",
            };
            let row = vec![
                if index == 0 { class.name.as_str().into() } else { Cell::Missing },
                (index + 1).into(),
                segment.length.into(),
                segment.od.into(),
                segment.breaking.into(),
                name.map_or(Cell::Missing, Cell::from),
                curve.map_or(Cell::Missing, |c| c.kind.name().into()),
                from.into(),
            ];
            push(&mut table, row);
        }
    }
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
    table.notes.extend(unknown);
    (table.rows() > 0).then_some(table)
}

/// The curves of the library.
fn shipped(fits: &dyn Fn(&str) -> bool) -> Table {
    let mut table = Table::new("Fatigue Curves of the Library")
        .column("", "Name", Dim::None, Digits::Usual)
        .column("", "Type", Dim::None, Digits::Usual)
        .column("First Branch", "m", Dim::None, Digits::Decimals(2))
        .column("First Branch", "log a", Dim::None, Digits::Decimals(4))
        .column("First Branch", "Down To", Dim::None, Digits::Decimals(3))
        .column("Second Branch", "m", Dim::None, Digits::Decimals(2))
        .column("Second Branch", "log a", Dim::None, Digits::Decimals(4))
        .column("", "Limit", Dim::None, Digits::Decimals(1))
        .column("", "By Mean", Dim::None, Digits::Decimals(2))
        .column("", "Legs", Dim::None, Digits::Decimals(0))
        .column("", "Thick.", Dim::None, Digits::Decimals(2))
        .column("", "Source", Dim::None, Digits::Usual)
        .column("", "What", Dim::None, Digits::Usual);
    let mut used: Vec<&str> = Vec::new();
    let some = |v: f64| if v == 0.0 { Cell::Missing } else { Cell::Number(v) };
    for shipped in library().curves.iter().filter(|c| fits(&c.name) || c.aliases.iter().any(|a| fits(a))) {
        let curve = shipped.curve();
        if !used.contains(&shipped.source.as_str()) {
            used.push(&shipped.source);
        }
        let number = used.iter().position(|key| *key == shipped.source).map_or(0, |i| i + 1);
        let (first, second) = (curve.branches.first(), curve.branches.get(1));
        let mark = if curve.unconfirmed { " ?" } else { "" };
        let aliases =
            if shipped.aliases.is_empty() { String::new() } else { format!(" ({})", shipped.aliases.join(", ")) };
        let row = vec![
            shipped.name.as_str().into(),
            curve.kind.name().into(),
            first.map(|b| b.slope).into(),
            first.map(|b| b.log_a).into(),
            some(first.map_or(0.0, |b| b.from)),
            second.map(|b| b.slope).into(),
            second.map(|b| b.log_a).into(),
            some(curve.limit),
            some(curve.mean_slope),
            curve.legs.into(),
            some(shipped.thickness_exponent),
            format!("{number}{mark}").into(),
            format!("{}{aliases}", shipped.what).into(),
        ];
        push(&mut table, row);
    }
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
