//! Results of NEMOH 2 and 3: `Nemoh.cal`, `RadiationCoefficients.tec`, `ExcitationForce.tec`, and where they are there `KH.dat`
//! (hydrostatic stiffness) and `Hydrostatics.dat` (displaced volume).
//!
//! Source: [NEMOH-3 Output files] and the writers of both versions (Results.f90). A zone of the radiation file is one motion, its
//! columns added mass and damping of each force; a zone of the excitation file one heading, its columns modulus and phase of
//! each force. The first line gives the unit of frequency: rad/s, Hz or s. NEMOH writes with exp(-i w t), as is done here (documentation of Capytaine,
//! "Conventions"). Phases are in rad where none exceeds pi, else in degrees: the documentation says degrees, what the versions known write is rad.
//! Phases refer to the point XEFF YEFF of `Nemoh.cal`, moments to the point of its rotations.

use super::checks::check_database;
use super::matrices::{PairRow, by_frequency};
use super::nemoh_case::{NemohCase, NemohDirection};
use super::rows::{DatabaseError, ModeRow, SourceFile, by_wave, heading, number, same_frequency, separates};
use crate::sea::dispersion::wave_number;
use nalgebra::{Complex, Matrix6};
use std::f64::consts::{PI, TAU};
use windlass_model::Database;

/// Reads the results of a run; files are distinguished by their names.
///
/// # Errors
/// A file that is missing or does not have the form; rows that are missing; a run of several bodies where none is chosen.
pub fn read(source: &str, files: &[SourceFile], body: Option<usize>) -> Result<Database, DatabaseError> {
    let find = |name: &str| {
        files.iter().find(|f| {
            let own = f.name.rsplit(['/', '\\']).next().unwrap_or_default();
            own.eq_ignore_ascii_case(name)
        })
    };
    let Some(file) = find("Nemoh.cal") else {
        return Err(DatabaseError::Whole(format!("{source}: there is no Nemoh.cal")));
    };
    let case = super::nemoh_case::read(file)?;
    let chosen = match (body, case.bodies.len()) {
        (None, 1) => 0,
        (None, count) => {
            return Err(file.error(format!("it has {count} bodies: -INDEX says which one to take")));
        }
        (Some(n), count) if n == 0 || n > count => {
            return Err(file.error(format!("there is no body {n}: it has {count}")));
        }
        (Some(n), _) => n - 1,
    };
    let Some(about) = case.reference_point(chosen) else {
        return Err(file.error("rotations and moments of the body are about several points"));
    };
    let mut data = Database {
        source: source.to_string(),
        reference: about,
        density: case.density,
        gravity: case.gravity,
        depth: case.depth,
        ..Database::default()
    };
    if let Some(file) = find("RadiationCoefficients.tec") {
        let table = by_frequency(file, &radiation(file, &case, chosen)?)?;
        (data.frequencies, data.added_mass, data.damping) = (table.frequencies, table.added_mass, table.damping);
    }
    if let Some(file) = find("ExcitationForce.tec") {
        let (rows, degrees) = excitation(file, &case, chosen)?;
        if degrees {
            data.remarks.push(format!("{}: phases exceed pi and are taken to be in degrees", file.name));
        }
        let table = by_wave(file, &rows)?;
        if data.frequencies.is_empty() {
            data.frequencies = table.frequencies;
        } else if let Some(odd) = odd(&data.frequencies, &table.frequencies) {
            return Err(file.error(format!("{odd:.5} rad/s is in one of its radiation and excitation files only")));
        }
        (data.headings, data.excitation) = (table.headings, table.values);
        let [x, y] = case.waves_at;
        refer_phases(&mut data, x - about.x, y - about.y);
    }
    let own = format!("KH_{chosen}.dat");
    if let Some(file) = find("KH.dat").filter(|_| case.bodies.len() == 1).or_else(|| find(&own)) {
        data.hydrostatics = Some(stiffness(file)?);
    }
    let own = format!("Hydrostatics_{chosen}.dat");
    if let Some(file) = find("Hydrostatics.dat").filter(|_| case.bodies.len() == 1).or_else(|| find(&own)) {
        let line = file.text.lines().find(|l| l.to_ascii_lowercase().contains("displacement"));
        let volume = line.and_then(|l| l.split('=').nth(1)).and_then(|t| t.split_whitespace().next());
        data.mass = volume.and_then(number).map(|v| v * case.density);
    }
    check_database(data)
}

/// A frequency of one list that the other lacks.
fn odd(a: &[f64], b: &[f64]) -> Option<f64> {
    let lacks = |list: &[f64], w: f64| !list.iter().any(|v| same_frequency(*v, w));
    a.iter().find(|w| lacks(b, **w)).or_else(|| b.iter().find(|w| lacks(a, **w))).copied()
}

/// Phases of excitation and motions, which refer to a wave at a point with this offset from the reference point, as of a wave at the reference point.
pub(super) fn refer_phases(data: &mut Database, dx: f64, dy: f64) {
    if dx == 0.0 && dy == 0.0 {
        return;
    }
    let motions = data.motions.iter_mut().flat_map(|table| table.iter_mut().zip(&data.headings));
    for (row, heading) in data.excitation.iter_mut().zip(&data.headings).chain(motions) {
        let along = dx * heading.cos() + dy * heading.sin();
        for (six, w) in row.iter_mut().zip(&data.frequencies) {
            // the wave there is that at the reference point times exp(i k along); a frequency without a wave is refused later
            let number = wave_number(*w, data.depth, data.gravity).unwrap_or_default();
            let shift = Complex::from_polar(1.0, number * along);
            six.iter_mut().for_each(|x| *x *= shift);
        }
    }
}

/// What makes a frequency (rad/s) of the first column of a file.
type ToFrequency = fn(f64) -> f64;

/// A zone of a Tecplot file.
struct TecplotZone {
    title: String,
    rows: Vec<(usize, Vec<f64>)>,
}

/// The zones, and what makes a frequency (rad/s) of the first column.
fn zones(file: &SourceFile) -> Result<(Vec<TecplotZone>, ToFrequency), DatabaseError> {
    let head = file.text.lines().next().unwrap_or_default().to_ascii_lowercase();
    let frequency: ToFrequency = if head.contains("(hz)") {
        |f| TAU * f
    } else if head.contains("(s)") {
        |t| TAU / t
    } else {
        |w| w
    };
    let mut zones: Vec<TecplotZone> = Vec::new();
    for (index, line) in file.text.lines().enumerate() {
        if line.trim_start().get(..4).is_some_and(|w| w.eq_ignore_ascii_case("zone")) {
            let title = line.split('"').nth(1).unwrap_or_default().to_string();
            zones.push(TecplotZone { title, rows: Vec::new() });
            continue;
        }
        let Some(zone) = zones.last_mut() else { continue };
        let words = line.split(separates).filter(|w| !w.is_empty());
        let numbers: Option<Vec<f64>> = words.map(number).collect();
        match numbers {
            Some(list) if list.is_empty() => {}
            Some(list) => zone.rows.push((index + 1, list)),
            None => return Err(file.wrong_at(index + 1, "a row of finite numbers is expected")),
        }
    }
    if zones.is_empty() { Err(file.error("it has no Zone: it is no file of NEMOH")) } else { Ok((zones, frequency)) }
}

/// The frequency of a row and its columns of one force, from 0.
fn columns(
    file: &SourceFile,
    (line, row): &(usize, Vec<f64>),
    force: usize,
    frequency: ToFrequency,
) -> Result<(f64, f64, f64), DatabaseError> {
    let (Some(first), Some(a), Some(b)) = (row.first(), row.get(1 + 2 * force), row.get(2 + 2 * force)) else {
        return Err(file.wrong_at(*line, format!("{} numbers are too few for force {}", row.len(), force + 1)));
    };
    let w = frequency(*first);
    if w > 0.0 && w < 1e6 {
        Ok((w, *a, *b))
    } else {
        Err(file.wrong_at(*line, format!("{first} is no frequency of a wave")))
    }
}

/// The forces of a body with their place among all forces.
fn forces(case: &NemohCase, body: usize) -> Vec<(usize, NemohDirection)> {
    let before: usize = case.bodies.iter().take(body).map(|b| b.1.len()).sum();
    let own = case.bodies.get(body).map_or(&[][..], |b| b.1.as_slice());
    own.iter().enumerate().map(|(n, d)| (before + n, *d)).collect()
}

/// Rows of added mass and damping.
fn radiation(file: &SourceFile, case: &NemohCase, body: usize) -> Result<Vec<PairRow>, DatabaseError> {
    let (zones, frequency) = zones(file)?;
    let mut rows = Vec::new();
    for zone in &zones {
        let whole: Vec<usize> = zone.title.split_whitespace().filter_map(|w| w.parse().ok()).collect();
        let [of, n] = whole.as_slice() else {
            return Err(
                file.error(format!("the zone `{}` names no motion of a body", shorten_for_message(&zone.title)))
            );
        };
        if *of != body + 1 {
            continue;
        }
        let motion = case.bodies.get(body).and_then(|b| b.0.get(n.wrapping_sub(1)));
        let Some(motion) = motion else {
            return Err(file.error(format!("it has a motion {n} of body {of} that Nemoh.cal does not have")));
        };
        for row in &zone.rows {
            for (column, force) in forces(case, body) {
                let (w, added, damping) = columns(file, row, column, frequency)?;
                rows.push((w, 6 * force.mode + motion.mode, [added, damping]));
            }
        }
    }
    Ok(rows)
}

/// Rows of excitation, and whether phases are in degrees.
fn excitation(file: &SourceFile, case: &NemohCase, body: usize) -> Result<(Vec<ModeRow>, bool), DatabaseError> {
    let (zones, frequency) = zones(file)?;
    let mut rows = Vec::new();
    let mut largest: f64 = 0.0;
    for zone in &zones {
        let beta = zone.title.split('=').nth(1).and_then(|t| t.split_whitespace().next()).and_then(number);
        let Some(beta) = beta else {
            return Err(file.error(format!("the zone `{}` names no heading", shorten_for_message(&zone.title))));
        };
        for row in &zone.rows {
            for (column, force) in forces(case, body) {
                let (w, modulus, phase) = columns(file, row, column, frequency)?;
                largest = largest.max(phase.abs());
                rows.push((heading(beta), w, force.mode, modulus, phase));
            }
        }
    }
    let degrees = largest > PI + 1e-4;
    let factor = if degrees { PI / 180.0 } else { 1.0 };
    let rows = rows.into_iter().map(|(heading, frequency, mode, modulus, phase)| ModeRow {
        heading,
        frequency,
        mode,
        value: Complex::from_polar(modulus, phase * factor),
    });
    Ok((rows.collect(), degrees))
}

/// A 6 x 6 matrix of six rows.
fn stiffness(file: &SourceFile) -> Result<Matrix6<f64>, DatabaseError> {
    let rows = file.rows(6)?;
    if rows.len() != 6 {
        return Err(file.error(format!("it has {} rows, not six", rows.len())));
    }
    Ok(Matrix6::from_fn(|i, j| rows[i].number(j)))
}

/// The beginning of a text, as an error shows it.
fn shorten_for_message(text: &str) -> String {
    text.chars().take(40).filter(|c| !c.is_control()).collect()
}
