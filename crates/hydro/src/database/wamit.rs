//! Files of WAMIT: `.1` added mass and damping, `.3` (or `.2`) excitation, `.4` motions, `.8` and `.9` mean drift, `.12d`
//! difference-frequency forces, `.hst` hydrostatics.
//!
//! Source: [WAMIT-7 3, 4] (forms of the numeric output, and how it is made dimensionless with the length ULEN):
//! `A = A' rho L^k`, `B = B' rho L^k w` with k = 3 for two translations, 4 for one and one rotation, 5 for two rotations;
//! `X = X' rho g L^m` with m = 2 for forces, 3 for moments; motions `x'` and `x' / L`; `C = C' rho g L^(k-1)`, so that
//! C33 goes with L^2 and C44 with L^4; drift and QTF `rho g L` and `rho g L^2`. Periods are in s: zero is infinite frequency, negative is zero frequency.
//! WAMIT writes with exp(+i w t): amplitudes are conjugated here. Headings are degrees of the direction of travel, phases
//! refer to the global origin of the run, moments to that of the body, which stands at XBODY there [WAMIT-7 3].

use super::checks::{MAX_DATABASE_NUMBERS, check_database};
use super::matrices::{PairRow, by_frequency, matrix};
use super::nemoh::refer_phases;
use super::rows::{
    ByWave, DatabaseError, ModeRow, NumberRow, SourceFile, by_wave, heading, same_frequency, same_heading,
};
use nalgebra::{Complex, Matrix6, Vector3};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use windlass_model::{Amplitudes, Database, DriftTable, Interaction, Qtf};

/// What the files of one WAMIT run do not say themselves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WamitScale {
    /// Length ULEN by which the output is made dimensionless (m).
    pub length: f64,
    /// Density of the water (kg/m3).
    pub density: f64,
    /// Gravity (m/s2).
    pub gravity: f64,
    /// Depth (m); `None` for deep water.
    pub depth: Option<f64>,
    /// Which body of the run, from 1; `None` where it has one only.
    pub body: Option<usize>,
    /// XBODY: x and y of the origin of the body in the axes of the run (m); the body is not turned there.
    pub origin: Option<[f64; 2]>,
}

/// Reads the files of a run, distinguished by their endings; those of other endings are passed over.
///
/// # Errors
/// A file that does not have the form; rows that are missing or given twice; files of unlike frequencies; another body.
pub fn read(source: &str, files: &[SourceFile], scale: &WamitScale) -> Result<Database, DatabaseError> {
    let mut data = Database {
        source: source.to_string(),
        reference: Vector3::zeros(),
        density: scale.density,
        gravity: scale.gravity,
        depth: scale.depth,
        ..Database::default()
    };
    let find = |ending: &str| files.iter().find(|f| f.ending() == ending);
    if let Some(file) = find("1") {
        radiation(&mut data, file, scale)?;
    }
    let weight = scale.density * scale.gravity;
    let force = |mode: usize| weight * scale.length.powi(if mode < 3 { 2 } else { 3 });
    if let Some(file) = find("3").or_else(|| find("2")) {
        let table = by_wave(file, &modes(file, scale, force)?)?;
        data.excitation = same_waves(&mut data, file, table)?;
    }
    if let Some(file) = find("4") {
        let motion = |mode: usize| if mode < 3 { 1.0 } else { 1.0 / scale.length };
        let table = by_wave(file, &modes(file, scale, motion)?)?;
        data.motions = Some(same_waves(&mut data, file, table)?);
    }
    if let Some(file) = find("9").or_else(|| find("8")) {
        data.drift = Some(drift(&mut data.remarks, file, scale)?);
    }
    if let Some(file) = find("12d") {
        data.qtf = Some(super::wamit_qtf::read(&mut data.remarks, file, scale)?);
    }
    if let Some(file) = find("hst") {
        data.hydrostatics = Some(hydrostatics(file, scale)?);
    }
    match scale.origin {
        Some([x, y]) => {
            refer_phases(&mut data, -x, -y);
            if data.qtf.is_some() && (x != 0.0 || y != 0.0) {
                data.remarks.push("phases of its difference-frequency forces are left as they are: of a body away from the global origin they are off".into());
            }
        }
        None if scale.body.is_some() => data.remarks.push(
            "its phases are those of waves at the global origin of WAMIT: -XBODY X Y says where the origin of this body stands there; without it they are taken as those at the body"
                .into(),
        ),
        None => {}
    }
    if files.iter().any(|f| f.ending() == "12s") {
        data.remarks.push("sum-frequency forces (.12s) are not used: they do not move a moored body slowly".into());
    }
    check_database(data)
}

/// The direction of this body that a number of a mode means; `None` for another body.
pub(super) fn mode_of(
    file: &SourceFile,
    row: &NumberRow,
    column: usize,
    scale: &WamitScale,
) -> Result<Option<usize>, DatabaseError> {
    let Some(number) = row.ordinal(column) else {
        return Err(file.wrong_at(row.line, format!("{} is not a valid number of a mode", row.number(column))));
    };
    if number > 6 && scale.body.is_none() {
        let text = format!("mode {number} is of a second body: -INDEX says which body to take");
        return Err(file.wrong_at(row.line, text));
    }
    let first = 6 * (scale.body.unwrap_or(1) - 1);
    Ok((number > first && number <= first + 6).then(|| number - first - 1))
}

/// A frequency of a period that is greater than zero.
pub(super) fn frequency(file: &SourceFile, row: &NumberRow, column: usize) -> Result<f64, DatabaseError> {
    let frequency = TAU / row.number(column);
    if frequency > 0.0 && frequency.is_finite() && frequency < 1e6 {
        Ok(frequency)
    } else {
        Err(file.wrong_at(row.line, format!("{} is no period of a wave", row.number(column))))
    }
}

/// Rows of the motions of another body, by frequency and at the infinite one.
type OtherRows = (Vec<PairRow>, Vec<(usize, f64)>);

/// Added mass and damping of a `.1`.
fn radiation(data: &mut Database, file: &SourceFile, scale: &WamitScale) -> Result<(), DatabaseError> {
    let mut rows: Vec<(f64, usize, [f64; 2])> = Vec::new();
    let (mut infinite, mut zero) = (Vec::new(), Vec::new());
    // of the motions of other bodies, by their number from 0
    let mut others: BTreeMap<usize, OtherRows> = BTreeMap::new();
    data.index = scale.body.unwrap_or(1) - 1;
    for row in file.rows(4)? {
        let (own, by) = (mode_of(file, &row, 1, scale)?, mode_of(file, &row, 2, scale)?);
        let (Some(i), Some(j)) = (own, by.or_else(|| row.ordinal(2).map(|number| (number - 1) % 6))) else { continue };
        let other = by.is_none().then(|| row.ordinal(2).map_or(0, |number| (number - 1) / 6));
        let power = 3 + i32::from(i >= 3) + i32::from(j >= 3);
        let unit = scale.density * scale.length.powi(power);
        let (period, added) = (row.number(0), row.number(3) * unit);
        if let Some(other) = other {
            let (rows, infinite) = others.entry(other).or_default();
            if period == 0.0 {
                infinite.push((6 * i + j, added));
            } else if period > 0.0 && row.count >= 5 {
                let w = frequency(file, &row, 0)?;
                rows.push((w, 6 * i + j, [added, row.number(4) * unit * w]));
            }
        } else if period == 0.0 {
            infinite.push((6 * i + j, added));
        } else if period < 0.0 {
            zero.push((6 * i + j, added));
        } else {
            if row.count < 5 {
                return Err(file.wrong_at(row.line, "a period has added mass and damping"));
            }
            let w = frequency(file, &row, 0)?;
            rows.push((w, 6 * i + j, [added, row.number(4) * unit * w]));
        }
    }
    let table = by_frequency(file, &rows)?;
    let limit = |rows: &[(usize, f64)]| (!rows.is_empty()).then(|| matrix(rows.iter().copied()));
    (data.frequencies, data.added_mass, data.damping) = (table.frequencies, table.added_mass, table.damping);
    (data.infinite, data.zero) = (limit(&infinite), limit(&zero));
    let marks_exchanged = exchanged_limits(data);
    for (index, (rows, infinite)) in others {
        let table = by_frequency(file, &rows)?;
        if table.frequencies.len() != data.frequencies.len() {
            return Err(file.error(format!("body {} has other frequencies than this one", index + 1)));
        }
        let infinite = limit(&infinite).filter(|_| !marks_exchanged);
        let (added_mass, damping) = (table.added_mass, table.damping);
        data.interactions.push(Interaction { index, added_mass, damping, infinite, place: None });
    }
    Ok(())
}

/// Puts right the limits of a file whose writer exchanged the marks of zero and infinite frequency (a version of Capytaine did).
fn exchanged_limits(data: &mut Database) -> bool {
    let (Some(infinite), Some(zero), Some(low), Some(high)) =
        (data.infinite, data.zero, data.added_mass.first(), data.added_mass.last())
    else {
        return false;
    };
    // translations only: rotations of a body may be nothing but rounding
    let off = |a: &Matrix6<f64>, b: &Matrix6<f64>| (0..3).map(|i| (a[(i, i)] - b[(i, i)]).powi(2)).sum::<f64>().sqrt();
    if off(&zero, high) + off(&infinite, low) < 0.5 * (off(&zero, low) + off(&infinite, high)) {
        (data.infinite, data.zero) = (Some(zero), Some(infinite));
        let text =
            "the rows of period 0 hold the limit of long waves and those of -1 that of short ones: they are exchanged";
        data.remarks.push(text.into());
        return true;
    }
    false
}

/// Rows `PER BETA I Mod Pha Re Im`, each times the unit of its mode.
fn modes(file: &SourceFile, scale: &WamitScale, unit: impl Fn(usize) -> f64) -> Result<Vec<ModeRow>, DatabaseError> {
    let mut list = Vec::new();
    for row in file.rows(7)? {
        let Some(mode) = mode_of(file, &row, 2, scale)? else { continue };
        if row.number(0) <= 0.0 {
            continue;
        }
        let frequency = frequency(file, &row, 0)?;
        // conjugated: exp(+i w t) to exp(-i w t)
        let value = Complex::new(row.number(5), -row.number(6)) * unit(mode);
        list.push(ModeRow { heading: heading(row.number(1)), frequency, mode, value });
    }
    Ok(list)
}

/// A table on the frequencies and headings that the database has, or the first to give them.
fn same_waves(data: &mut Database, file: &SourceFile, table: ByWave) -> Result<Vec<Vec<Amplitudes>>, DatabaseError> {
    let agree = |own: &mut Vec<f64>, other: Vec<f64>, same: fn(f64, f64) -> bool, what: &str, show: fn(f64) -> f64| {
        if own.is_empty() {
            *own = other;
        } else if let Some(odd) = own.iter().find(|a| !other.iter().any(|b| same(**a, *b))) {
            return Err(file.error(format!("it lacks the {what} {:.5} of the other files", show(*odd))));
        } else if let Some(odd) = other.iter().find(|a| !own.iter().any(|b| same(**a, *b))) {
            return Err(file.error(format!("the other files lack its {what} {:.5}", show(*odd))));
        }
        Ok(())
    };
    agree(&mut data.frequencies, table.frequencies, same_frequency, "frequency (rad/s)", |w| w)?;
    agree(&mut data.headings, table.headings, same_heading, "heading (degrees)", f64::to_degrees)?;
    Ok(table.values)
}

/// Mean drift of a `.8` or `.9`: rows `PER BETA1 BETA2 I Mod Pha Re Im`.
fn drift(remarks: &mut Vec<String>, file: &SourceFile, scale: &WamitScale) -> Result<DriftTable, DatabaseError> {
    let weight = scale.density * scale.gravity;
    let mut list = Vec::new();
    let mut crossing = 0;
    for row in file.rows(8)? {
        if row.number(0) <= 0.0 {
            continue;
        }
        let (first, second) = (heading(row.number(1)), heading(row.number(2)));
        if !same_heading(first, second) {
            crossing += 1;
            continue;
        }
        let Some(mode) = mode_of(file, &row, 3, scale)? else { continue };
        let unit = weight * scale.length.powi(if mode < 3 { 1 } else { 2 });
        let frequency = frequency(file, &row, 0)?;
        list.push(ModeRow { heading: first, frequency, mode, value: Complex::new(row.number(6) * unit, 0.0) });
    }
    if crossing > 0 {
        remarks.push(format!("{}: {crossing} rows of crossing waves are not used", file.name));
    }
    let table = by_wave(file, &list)?;
    let real = |row: &Vec<Amplitudes>| row.iter().map(|six| six.map(|v| v.re)).collect();
    let values = table.values.iter().map(real).collect();
    Ok(DriftTable { frequencies: table.frequencies, headings: table.headings, values, method: None })
}

/// Hydrostatics of a `.hst`: rows `I J C`.
fn hydrostatics(file: &SourceFile, scale: &WamitScale) -> Result<Matrix6<f64>, DatabaseError> {
    let mut matrix = Matrix6::zeros();
    for row in file.rows(3)? {
        let (Some(i), Some(j)) = (mode_of(file, &row, 0, scale)?, mode_of(file, &row, 1, scale)?) else { continue };
        let power = 2 + i32::from(i >= 3) + i32::from(j >= 3);
        matrix[(i, j)] = row.number(2) * scale.density * scale.gravity * scale.length.powi(power);
    }
    Ok(matrix)
}

/// Whether a table of so many numbers is small enough.
pub(super) fn check_table_size(file: &SourceFile, sizes: &[usize]) -> Result<usize, DatabaseError> {
    let cells = sizes.iter().try_fold(1usize, |product, n| product.checked_mul(*n));
    cells
        .filter(|n| *n <= MAX_DATABASE_NUMBERS)
        .ok_or_else(|| file.error(format!("its table has more than {MAX_DATABASE_NUMBERS} places")))
}

/// An empty QTF on its axes.
pub(super) fn empty_qtf(headings: Vec<f64>, frequencies: Vec<f64>) -> Qtf {
    let count = frequencies.len();
    let values = vec![vec![vec![Amplitudes::default(); count]; count]; headings.len()];
    Qtf { frequencies, headings, values }
}
