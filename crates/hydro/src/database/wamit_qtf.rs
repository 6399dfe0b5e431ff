//! Difference-frequency forces of a WAMIT `.12d`: rows `PER1 PER2 BETA1 BETA2 I Mod Pha Re Im`.
//!
//! Source: [WAMIT-7 second-order output]: `F(t) = Re sum_ij F_ij a_i conj(a_j) exp(+i (w_i - w_j) t)`, `F_ji = conj(F_ij)`,
//! made dimensionless by `rho g L` (forces) and `rho g L^2` (moments). The file gives each pair once or twice.

use super::rows::{DatabaseError, SourceFile, axis, heading, position, same_frequency, same_heading};
use super::wamit::{WamitScale, check_table_size, empty_qtf, frequency, mode_of};
use nalgebra::Complex;
use windlass_model::Qtf;

/// One row.
struct QtfRow {
    heading: f64,
    first: f64,
    second: f64,
    mode: usize,
    value: Complex<f64>,
}

/// Reads a `.12d`. Pairs that it lacks are zero, as of frequencies too far apart for a slow force, and said.
///
/// # Errors
/// A file without the form; a frequency without its mean drift, the pair with itself.
pub(super) fn read(remarks: &mut Vec<String>, file: &SourceFile, scale: &WamitScale) -> Result<Qtf, DatabaseError> {
    let mut pairs = Vec::new();
    let mut crossing = 0;
    for row in file.rows(9)? {
        let (of_first, of_second) = (heading(row.number(2)), heading(row.number(3)));
        if !same_heading(of_first, of_second) {
            crossing += 1;
            continue;
        }
        let Some(mode) = mode_of(file, &row, 4, scale)? else { continue };
        let unit = scale.density * scale.gravity * scale.length.powi(if mode < 3 { 1 } else { 2 });
        let (first, second) = (frequency(file, &row, 0)?, frequency(file, &row, 1)?);
        let value = Complex::new(row.number(7), -row.number(8)) * unit;
        pairs.push(QtfRow { heading: of_first, first, second, mode, value });
    }
    if crossing > 0 {
        remarks.push(format!("{}: {crossing} rows of crossing waves are not used", file.name));
    }
    if pairs.is_empty() {
        return Err(file.error("it has no row of this body with both waves of one heading"));
    }
    let headings = axis(pairs.iter().map(|p| p.heading), same_heading);
    let frequencies = axis(pairs.iter().flat_map(|p| [p.first, p.second]), same_frequency);
    let count = frequencies.len();
    check_table_size(file, &[headings.len(), count, count, 12])?;
    let mut qtf = empty_qtf(headings, frequencies);
    let mut given = vec![vec![false; count * count]; qtf.headings.len()];
    for pair in &pairs {
        let h = position(&qtf.headings, pair.heading);
        let (i, j) = (position(&qtf.frequencies, pair.first), position(&qtf.frequencies, pair.second));
        for (a, b, value) in [(i, j, pair.value), (j, i, pair.value.conj())] {
            let cell = qtf.values.get_mut(h).and_then(|t| t.get_mut(a)).and_then(|t| t.get_mut(b));
            if let Some(position) = cell.and_then(|six| six.get_mut(pair.mode)) {
                *position = value;
            }
            if let Some(mark) = given.get_mut(h).and_then(|t| t.get_mut(a * count + b)) {
                *mark = true;
            }
        }
    }
    let mut lacking = 0;
    for (h, marks) in given.iter().enumerate() {
        lacking += marks.iter().filter(|m| !**m).count();
        if let Some(i) = (0..count).find(|i| marks.get(i * count + i) != Some(&true)) {
            let at = |list: &[f64], i: usize| list.get(i).copied().unwrap_or_default();
            let (turn, w) = (at(&qtf.headings, h).to_degrees(), at(&qtf.frequencies, i));
            return Err(file.error(format!("it has no row of {w:.5} rad/s with itself at heading {turn:.2} degrees")));
        }
    }
    if lacking > 0 {
        remarks.push(format!("{}: {lacking} of {} pairs are not given and count as zero", file.name, count * count));
    }
    Ok(qtf)
}
