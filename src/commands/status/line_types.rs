//! `&STATUS LINE_TYPES`: the library of chains and ropes, its values at a diameter, and the formulas of a type.

use crate::commands::Job;
use crate::commands::help::wrap;
use crate::commands::status::kind::StatusKind;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::Value;
use windlass_base::wildcard::matches;
use windlass_connectors::line_types::{DiameterFormula, LineType, library};
use windlass_connectors::{list_kinds_with_option, options};
use windlass_language::number;

/// `&STATUS LINE_TYPES`.
pub static LINE_TYPES: StatusKind =
    StatusKind::new("LINE_TYPES", "chains and ropes of the library, for -TYPE", |query, _| {
        tables(query.job, &query.args().data)
    });

/// The tables for what follows LINE_TYPES: nothing, nominal diameters in the user's section unit, names or patterns.
///
/// # Errors
/// A diameter that is not greater than zero, or that no formula has a value for; a name of no type.
pub fn tables(job: &Job, data: &[Value]) -> Outcome<Vec<Table>> {
    let types = &library().types;
    let mut tables = Vec::new();
    for given in data.iter().skip(1) {
        if let Some(word) = given.word() {
            let found = tables_of_types(job, types, word, given.span)?;
            if found.is_empty() {
                return Err(Diagnostic::error(format!("nothing among LINE_TYPES is called {word}"), given.span));
            }
            tables.extend(found);
        }
    }
    if tables.is_empty() {
        tables.push(list(types));
    }
    Ok(tables)
}

/// The tables of a diameter, a name or a pattern.
fn tables_of_types(job: &Job, types: &[LineType], word: &str, position: Span) -> Outcome<Vec<Table>> {
    if let Ok(value) = number::evaluate(word) {
        let diameter = Dim::Section.to_si(value, job.units);
        if diameter > 0.0 && types.iter().any(|t| t.has_values(diameter)) {
            return Ok(vec![values(types, diameter, job)]);
        }
        let what =
            if diameter > 0.0 { "no line type has this diameter" } else { "a diameter must be greater than zero" };
        return Err(Diagnostic::error(what, position).label(format!("this is {value}")));
    }
    Ok(types.iter().filter(|t| matches(word, &t.name)).map(formulas).collect())
}

/// All types with the diameters their formulas are held for.
fn list(types: &[LineType]) -> Table {
    let mut table = Table::new("Line Types")
        .with_rows(types)
        .text("Name", |t| &t.name)
        .column("Nominal Diameter", "From", Dim::Section, Digits::Usual, |t| t.diameter.least)
        .column("Nominal Diameter", "To", Dim::Section, Digits::Usual, |t| t.diameter.most)
        .text("What", |t| &t.what)
        .build();
    let kinds = list_kinds_with_option(&options::TYPE);
    table.note(format!("-TYPE NAME D on {kinds} uses one; &STATUS LINE_TYPES D gives the values at a diameter,"));
    table.note("&STATUS LINE_TYPES NAME the formulas of a type and their sources");
    table
}

/// The values of all types at a nominal diameter (m).
fn values(types: &[LineType], diameter: f64, job: &Job) -> Table {
    let around = job.model.surroundings();
    let used = used_sources(types);
    let chosen: Vec<&LineType> = types.iter().filter(|t| t.has_values(diameter)).collect();
    let submerged = |t: &LineType| t.submerged_mass(diameter, around.water_density) * around.gravity;
    let mut table = Table::new("Line Types at a Diameter")
        .fact("Nominal Diameter", diameter, Dim::Section)
        .fact("Water Density", around.water_density, Dim::Density)
        .with_rows(&chosen)
        .text("Name", |t| &t.name)
        .column("Diameter of", "Volume", Dim::Section, Digits::Usual, |t| t.volume_diameter(diameter))
        .column("", "Mass", Dim::MassPerLength, Digits::Usual, |t| t.mass.evaluate(diameter))
        .column("Weight / Length", "Air", Dim::ForcePerLength, Digits::Usual, |t| {
            t.mass.evaluate(diameter) * around.gravity
        })
        .column("Weight / Length", "Water", Dim::ForcePerLength, Digits::Usual, |t| submerged(t))
        .column("", "AE", Dim::Force, Digits::Scientific(5), |t| t.ea.evaluate(diameter))
        .column("", "Break", Dim::Force, Digits::Usual, |t| t.breaking.evaluate(diameter))
        .text("In Range", |t| if t.covers(diameter) { "yes" } else { "no" })
        .text("Sources", |t| {
            let own = used_sources(std::slice::from_ref(*t));
            own.iter().filter_map(|key| number_of(&used, key)).collect::<Vec<_>>().join(" ")
        })
        .build();
    tell_sources(&mut table, types);
    table
}

/// The formulas of one type.
fn formulas(line: &LineType) -> Table {
    let text = |f: &DiameterFormula, unit: &str| match f.d3 {
        0.0 => format!("{:e} d**2 {unit}", f.d2),
        d3 => format!("{:e} d**2 {} {:e} d**3 {unit}", f.d2, if d3 < 0.0 { '-' } else { '+' }, d3.abs()),
    };
    let mut table = Table::new(format!("Line Type {}", line.name))
        .fact("What", line.what.as_str(), Dim::None)
        .fact("Nominal Diameter from", line.diameter.least, Dim::Section)
        .fact("                 to", line.diameter.most, Dim::Section)
        .fact("Mass / Length (d in m)", text(&line.mass, "kg/m"), Dim::None)
        .fact("Diameter of Displaced Volume", format!("{} d", line.volume.ratio), Dim::None)
        .fact("AE", text(&line.ea, "N"), Dim::None)
        .fact("Break", text(&line.breaking, "N"), Dim::None)
        .fact("Diameter for Drag", format!("{} d", line.drag.ratio), Dim::None)
        .fact("   its Published Coefficient", format!("{}", line.drag.coefficient), Dim::None);
    tell_sources(&mut table, std::slice::from_ref(line));
    table
}

/// The keys of the sources of these types, in the order of their first use.
fn used_sources(types: &[LineType]) -> Vec<&str> {
    let mut keys: Vec<&str> = Vec::new();
    for (_, key) in types.iter().flat_map(LineType::sources) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys
}

/// The number a source has under a table, from 1.
fn number_of(used: &[&str], key: &str) -> Option<String> {
    used.iter().position(|k| *k == key).map(|index| (index + 1).to_string())
}

/// Under the table: each source, what it gives, how sure it is, and where that was seen.
fn tell_sources(table: &mut Table, types: &[LineType]) {
    for (index, key) in used_sources(types).into_iter().enumerate() {
        let Some(source) = library().sources.get(key) else { continue };
        let mut given: Vec<&str> = Vec::new();
        for (what, _) in types.iter().flat_map(LineType::sources).filter(|(_, used)| *used == key) {
            if !given.contains(&what) {
                given.push(what);
            }
        }
        let text = format!("{}: {} ({}: {})", given.join(", "), source.text, source.sure.word(), source.how);
        for (line, words) in wrap(&text, 104).into_iter().enumerate() {
            let number = if line == 0 { format!("{}.", index + 1) } else { String::new() };
            table.note(format!("{number:<3} {words}"));
        }
    }
}
