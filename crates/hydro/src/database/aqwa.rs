//! The hydrodynamic database of AQWA as text: the file .AH1 that the option AHD1 writes.
//!
//! Source: the readers [BEMIO-AQWA] and [BEMROSETTA-AQWA], which agree. After lines that begin with `*`: the numbers of structures, directions and
//! frequencies, then the directions (degrees) and the frequencies (rad/s). Then sections, each a head and rows of numbers: GENERAL (depth, density, gravity,
//! symmetry; with a leading number in files of 18.2 and later), COG, MASS, HYDSTIFFNESS, ADDEDMASS, DAMPING and FORCERAO,
//! in newer files ADDEDMASS_LF and ADDEDMASS_HF, the limits of long and of short waves. FIDD, a damping of drift frequencies alone, is refused unless it is zero. The first row of a matrix, and the row
//! of moduli of a force, has the numbers of its structure, direction or frequency before its six values; a row of phases (degrees) follows that of the moduli. A phase is
//! a lag behind the crest at the centre of gravity. Matrices are about that centre. DatabaseUnits are any consistent set, which gravity and density tell apart.

use super::checks::check_database;
use super::nemoh::refer_phases;
use super::rows::{DatabaseError, SourceFile, heading, number};
use nalgebra::{Complex, Matrix6, Vector3};
use std::collections::BTreeMap;
use windlass_model::{Amplitudes, Database};

/// Most structures, directions or frequencies of a file.
const MAX_COUNT: usize = 10_000;
/// Gravity (length/s2) and the unit of length (m) that goes with it.
const LENGTH_UNITS: [(f64, f64); 2] = [(9.80665, 1.0), (32.174, 0.3048)];
/// Mass units (kg) of a set: kilogram, tonne, slug.
const MASS_UNITS: [f64; 3] = [1.0, 1000.0, 14.593_903];
/// Density of water (kg/m3) that is believed.
const WATER_DENSITY: std::ops::RangeInclusive<f64> = 950.0..=1100.0;

/// A row of numbers with its line, from 1.
type NumberedRow = (usize, Vec<f64>);

/// A file taken apart.
struct Sections<'a> {
    file: &'a SourceFile,
    counts: [usize; 3],
    directions: Vec<f64>,
    frequencies: Vec<f64>,
    sections: BTreeMap<String, (usize, Vec<NumberedRow>)>,
}

/// Factors to SI.
#[derive(Clone, Copy)]
struct DatabaseUnits {
    metres: f64,
    kilograms: f64,
}

/// Reads a file; of several structures one is chosen by its number, from 1.
///
/// # Errors
/// A file that does not have the form; matrices or forces that are missing; several structures where none is chosen; units that are not known.
pub fn read(source: &str, file: &SourceFile, body: Option<usize>) -> Result<Database, DatabaseError> {
    let sections = Sections::new(file)?;
    let [bodies, ..] = sections.counts;
    let chosen = match body {
        None if bodies > 1 => {
            return Err(
                file.error(format!("it has {bodies} structures: -INDEX, or CSTR of a deck, says which one to take"))
            );
        }
        None => 1,
        Some(n) if n == 0 || n > bodies => {
            return Err(file.error(format!("there is no structure {n}: it has {bodies}")));
        }
        Some(n) => n,
    };
    let (depth, density, gravity) = sections.general()?;
    let units = DatabaseUnits::find(density, gravity).ok_or_else(|| {
        file.error(format!("gravity {gravity} and density {density} belong to no set of units that is known"))
    })?;
    let centre = |body: usize| -> Result<Vector3<f64>, DatabaseError> {
        let (line, row) = sections.own_row("COG", body)?;
        match row.as_slice() {
            [_, x, y, z, ..] => Ok(Vector3::new(*x, *y, *z) * units.metres),
            _ => Err(file.wrong_at(*line, "a number of a structure and three coordinates are expected")),
        }
    };
    let about = centre(chosen)?;
    let mut order: Vec<(usize, f64)> = sections.frequencies.iter().copied().enumerate().collect();
    order.sort_by(|a, b| a.1.total_cmp(&b.1));
    let matrices = |name: &str, unit: f64| -> Result<Vec<Matrix6<f64>>, DatabaseError> {
        order.iter().map(|(at, _)| Ok(units.matrix(&sections.matrix(name, &[chosen, chosen, at + 1])?, unit))).collect()
    };
    let mut data = Database {
        source: source.to_string(),
        reference: about,
        frequencies: order.iter().map(|(_, w)| *w).collect(),
        added_mass: matrices("ADDEDMASS", units.kilograms)?,
        damping: matrices("DAMPING", units.kilograms)?,
        density: density * units.kilograms / units.metres.powi(3),
        gravity: gravity * units.metres,
        depth: (depth > 0.0).then_some(depth * units.metres),
        ..Database::default()
    };
    if sections.has("HYDSTIFFNESS") {
        data.hydrostatics = Some(units.matrix(&sections.matrix("HYDSTIFFNESS", &[chosen])?, units.kilograms));
    }
    if sections.has("MASS") {
        data.mass = Some(sections.matrix("MASS", &[chosen])?[(0, 0)] * units.kilograms).filter(|mass| *mass > 0.0);
    }
    excitation(&sections, &mut data, (chosen, &order), units)?;
    if bodies > 1 && chosen > 1 {
        let first = centre(1)?;
        refer_phases(&mut data, first.x - about.x, first.y - about.y);
        data.remarks
            .push("of several structures phases are taken to refer to the centre of gravity of the first".into());
    }
    // the limits that newer files have beside the frequencies
    for (name, limit) in [("ADDEDMASS_LF", &mut data.zero), ("ADDEDMASS_HF", &mut data.infinite)] {
        if sections.has(name) {
            *limit = Some(units.matrix(&sections.matrix(name, &[chosen, chosen])?, units.kilograms));
        }
    }
    let own = |(_, row): &&NumberedRow| row.iter().skip(1).any(|x| *x != 0.0) && row.first() == Some(&(chosen as f64));
    if let Some((line, _)) = sections.rows("FIDD").and_then(|rows| rows.iter().find(own)) {
        let why = "a damping of drift frequencies alone (FIDD) has no place in the model: put zeros here and give #DAMP, which acts at all frequencies";
        return Err(file.wrong_at(*line, why));
    }
    check_database(data)
}

/// The excitation by heading, then frequency.
fn excitation(
    sections: &Sections,
    data: &mut Database,
    (body, order): (usize, &[(usize, f64)]),
    units: DatabaseUnits,
) -> Result<(), DatabaseError> {
    let file = sections.file;
    let Some(rows) = sections.rows("FORCERAO") else { return Ok(()) };
    let mut headings: Vec<(usize, f64)> = sections.directions.iter().map(|h| heading(*h)).enumerate().collect();
    headings.sort_by(|a, b| a.1.total_cmp(&b.1));
    headings.dedup_by(|b, a| super::rows::same_heading(a.1, b.1));
    let mut found: BTreeMap<[usize; 3], Amplitudes> = BTreeMap::new();
    for pair in rows.chunks(2) {
        let [(line, moduli), (below, phases)] = pair else {
            return Err(file.error("FORCERAO has moduli without phases"));
        };
        let (Some(key), [_, _, _, values @ ..]) = (key::<3>(moduli), moduli.as_slice()) else {
            return Err(file.wrong_at(*line, "structure, direction and frequency are expected before six moduli"));
        };
        if values.len() != 6 || phases.len() != 6 {
            return Err(file.wrong_at(*below, "six moduli and six phases are expected"));
        }
        let mut six = Amplitudes::default();
        for (mode, (position, (modulus, phase))) in six.iter_mut().zip(values.iter().zip(phases)).enumerate() {
            let moment = i32::from(mode > 2);
            let size = modulus * units.kilograms * units.metres.powi(moment);
            *position = Complex::from_polar(size, phase.to_radians());
        }
        found.insert(key, six);
    }
    let at = |heading: usize, frequency: usize| {
        found.get(&[body, heading + 1, frequency + 1]).copied().ok_or_else(|| {
            file.error(format!(
                "FORCERAO lacks structure {body}, direction {}, frequency {}",
                heading + 1,
                frequency + 1
            ))
        })
    };
    for (heading, angle) in headings {
        let row: Result<Vec<Amplitudes>, DatabaseError> = order.iter().map(|(w, _)| at(heading, *w)).collect();
        data.headings.push(angle);
        data.excitation.push(row?);
    }
    Ok(())
}

/// The whole numbers at the begin of a row.
fn key<const N: usize>(row: &[f64]) -> Option<[usize; N]> {
    let mut out = [0; N];
    for (position, value) in out.iter_mut().zip(row) {
        if !(1.0..=MAX_COUNT as f64).contains(value) || value.fract() != 0.0 {
            return None;
        }
        *position = *value as usize;
    }
    (row.len() >= N).then_some(out)
}

impl DatabaseUnits {
    /// The set that gravity and the density of the water belong to.
    fn find(density: f64, gravity: f64) -> Option<DatabaseUnits> {
        let (_, metres) = LENGTH_UNITS.into_iter().find(|(usual, _)| (gravity / usual - 1.0).abs() < 0.01)?;
        let kilograms =
            MASS_UNITS.into_iter().find(|unit| WATER_DENSITY.contains(&(density * unit / metres.powi(3))))?;
        Some(DatabaseUnits { metres, kilograms })
    }

    /// A matrix of motions times a unit, with the lengths of its rotations.
    fn matrix(&self, raw: &Matrix6<f64>, unit: f64) -> Matrix6<f64> {
        Matrix6::from_fn(|i, j| raw[(i, j)] * unit * self.metres.powi(i32::from(i > 2) + i32::from(j > 2)))
    }
}

impl<'a> Sections<'a> {
    fn new(file: &'a SourceFile) -> Result<Sections<'a>, DatabaseError> {
        let mut head: Vec<f64> = Vec::new();
        let mut made = Sections {
            file,
            counts: [0; 3],
            directions: Vec::new(),
            frequencies: Vec::new(),
            sections: BTreeMap::new(),
        };
        let mut name: Option<String> = None;
        for (index, text) in file.text.lines().enumerate() {
            let (line, text) = (index + 1, text.trim());
            if text.is_empty() || text.starts_with('*') {
                continue;
            }
            if text.starts_with(|c: char| c.is_ascii_alphabetic()) {
                let words: Vec<String> = text.split_whitespace().map(str::to_ascii_uppercase).collect();
                let title = words.join("_");
                if made.sections.insert(title.clone(), (line, Vec::new())).is_some() {
                    return Err(file.wrong_at(line, format!("the section {title} is there twice")));
                }
                name = Some(title);
                continue;
            }
            let row: Option<Vec<f64>> = text.split_whitespace().map(number).collect();
            let Some(row) = row.filter(|row| row.iter().all(|x| x.is_finite())) else {
                return Err(file.wrong_at(line, "a row of finite numbers is expected"));
            };
            match name.as_ref().and_then(|name| made.sections.get_mut(name)) {
                Some((_, rows)) => rows.push((line, row)),
                None => head.extend(row),
            }
        }
        let Some(counts) = key::<3>(&head) else {
            return Err(file.error(
                "it does not begin with the numbers of structures, directions and frequencies: it is no file .AH1",
            ));
        };
        let [_, directions, frequencies] = counts;
        if head.len() != 3 + directions + frequencies {
            let why = format!(
                "{directions} directions and {frequencies} frequencies are announced, and {} numbers follow",
                head.len() - 3
            );
            return Err(file.error(why));
        }
        made.counts = counts;
        made.directions = head.get(3..3 + directions).unwrap_or_default().to_vec();
        made.frequencies = head.get(3 + directions..).unwrap_or_default().to_vec();
        Ok(made)
    }

    fn has(&self, name: &str) -> bool {
        self.sections.contains_key(name)
    }

    fn rows(&self, name: &str) -> Option<&[NumberedRow]> {
        self.sections.get(name).map(|(_, rows)| rows.as_slice())
    }

    /// Depth, density and gravity.
    fn general(&self) -> Result<(f64, f64, f64), DatabaseError> {
        let Some([(line, row), ..]) = self.rows("GENERAL") else {
            return Err(self.file.error("it has no section GENERAL with depth, density and gravity"));
        };
        // files of 18.2 and later have a number before the depth
        let like_gravity = |g: f64| LENGTH_UNITS.iter().any(|(usual, _)| (g / usual - 1.0).abs() < 0.01);
        match row.as_slice() {
            [depth, density, gravity, ..] if like_gravity(*gravity) => Ok((*depth, *density, *gravity)),
            [_, depth, density, gravity, ..] if like_gravity(*gravity) => Ok((*depth, *density, *gravity)),
            _ => Err(self.file.wrong_at(*line, "no gravity of metres or feet follows depth and density")),
        }
    }

    /// The row of a section that begins with the number of a structure.
    fn own_row(&self, name: &str, body: usize) -> Result<&NumberedRow, DatabaseError> {
        let rows = self.rows(name).ok_or_else(|| self.file.error(format!("it has no section {name}")))?;
        rows.iter()
            .find(|(_, row)| key::<1>(row) == Some([body]))
            .ok_or_else(|| self.file.error(format!("{name} lacks structure {body}")))
    }

    /// The matrix of a section whose first row begins with these numbers.
    fn matrix(&self, name: &str, wanted: &[usize]) -> Result<Matrix6<f64>, DatabaseError> {
        let Some(rows) = self.rows(name) else {
            return Err(self.file.error(format!("it has no section {name}")));
        };
        let count = wanted.len();
        let begins = |row: &[f64]| row.iter().zip(wanted).all(|(x, n)| *x == *n as f64) && row.len() == count + 6;
        for six in rows.chunks(6) {
            let Some((first, row)) = six.first() else { continue };
            if row.len() != count + 6 {
                let why = format!("{count} numbers and six values are expected in the first row of a matrix of {name}");
                return Err(self.file.wrong_at(*first, why));
            }
            if !begins(row) {
                continue;
            }
            let mut matrix = Matrix6::zeros();
            for (i, (line, row)) in six.iter().enumerate() {
                let values = if i == 0 { row.get(count..).unwrap_or_default() } else { row.as_slice() };
                if values.len() != 6 || six.len() != 6 {
                    return Err(self.file.wrong_at(*line, format!("a matrix of {name} has six rows of six values")));
                }
                for (j, value) in values.iter().enumerate() {
                    matrix[(i, j)] = *value;
                }
            }
            return Ok(matrix);
        }
        let numbers: Vec<String> = wanted.iter().map(usize::to_string).collect();
        Err(self.file.error(format!("{name} lacks the matrix {}", numbers.join(" "))))
    }
}
