//! What every database must fulfil, whatever its source.

use super::rows::DatabaseError;
use nalgebra::Matrix6;
use std::f64::consts::TAU;
use windlass_base::units::Dim;
use windlass_model::{Amplitudes, Database};

/// Asymmetry of added mass or damping, over the geometric mean of the diagonal, that is said.
const MAX_ASYMMETRY: f64 = 0.05;
/// The most numbers a database may hold (1e7: 80 MB).
pub(super) const MAX_DATABASE_NUMBERS: usize = 10_000_000;

/// How the remark of a gap between headings begins.
pub(super) const HEADING_GAP_REMARK: &str = "its headings leave a gap";

/// Names of the six directions.
pub const MODES: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];

/// Sees that a database is whole and finite, and notes what looks wrong.
///
/// # Errors
/// Numbers that are not finite; tables of unlike size; neither radiation, excitation nor motions.
pub(super) fn check_database(mut data: Database) -> Result<Database, DatabaseError> {
    let wrong = |why: String| Err(DatabaseError::Whole(format!("{}: {why}", data.source)));
    let count = data.frequencies.len();
    if count == 0 || (data.added_mass.is_empty() && data.excitation.is_empty() && data.motions.is_none()) {
        return wrong("it holds neither added mass, excitation nor motions".into());
    }
    let growing = |list: &[f64]| list.windows(2).all(|w| matches!(w, [a, b] if a < b));
    if !data.frequencies.iter().all(|w| w.is_finite() && *w > 0.0) || !growing(&data.frequencies) {
        return wrong("its frequencies are not finite and greater than zero".into());
    }
    if !data.headings.iter().all(|h| (0.0..TAU).contains(h)) || !growing(&data.headings) {
        return wrong("its headings do not go once round".into());
    }
    let fits = |list: &[Matrix6<f64>]| list.is_empty() || list.len() == count;
    let shaped = |table: &[Vec<Amplitudes>]| {
        table.is_empty() || (table.len() == data.headings.len() && table.iter().all(|row| row.len() == count))
    };
    let whole = fits(&data.added_mass)
        && fits(&data.damping)
        && data.added_mass.len() == data.damping.len()
        && shaped(&data.excitation)
        && data.motions.as_ref().is_none_or(|m| shaped(m));
    if !whole {
        return wrong("its tables are of unlike size".into());
    }
    if let Some(what) = find_invalid_value(&data) {
        return wrong(format!("{what} is not finite, or larger than {:E}", Dim::None.most()));
    }
    if !(data.density > 0.0 && data.density.is_finite() && data.gravity > 0.0 && data.gravity.is_finite()) {
        return wrong("its density and gravity are not greater than zero".into());
    }
    let remarks: Vec<String> = [
        unsymmetric("added mass", &data.added_mass, &data.frequencies),
        unsymmetric("damping", &data.damping, &data.frequencies),
        negative_damping(&data),
        gaps(&data.headings),
    ]
    .into_iter()
    .flatten()
    .collect();
    data.remarks.extend(remarks);
    Ok(data)
}

/// The first value that is not finite or too large to be reckoned with, in words.
fn find_invalid_value(data: &Database) -> Option<String> {
    let bad = |v: &f64| v.is_nan() || v.abs() > Dim::None.most();
    let name = |i: usize| MODES.get(i).copied().unwrap_or_default();
    let entry = |m: &Matrix6<f64>| m.iter().position(bad).map(|at| format!("{}-{}", name(at % 6), name(at / 6)));
    let by_frequency = |what: &str, list: &[Matrix6<f64>]| {
        let found = list.iter().zip(&data.frequencies).find_map(|(m, w)| entry(m).map(|position| (position, *w)));
        found.map(|(position, w)| format!("{what} {position} at {w:.4} rad/s"))
    };
    let single = |what: &str, m: &Option<Matrix6<f64>>| Some(format!("{what} {}", entry(m.as_ref()?)?));
    let by_wave = |what: &str, table: &[Vec<Amplitudes>]| {
        let waves = table
            .iter()
            .zip(&data.headings)
            .flat_map(|(row, h)| row.iter().zip(&data.frequencies).map(move |(a, w)| (a, h, w)));
        let one = |a: &Amplitudes| a.iter().position(|x| bad(&x.re) || bad(&x.im));
        let found = waves.into_iter().find_map(|(a, h, w)| one(a).map(|mode| (mode, *h, *w)));
        found
            .map(|(mode, h, w)| format!("{what} {} at {w:.4} rad/s, heading {:.1} degrees", name(mode), h.to_degrees()))
    };
    by_frequency("added mass", &data.added_mass)
        .or_else(|| by_frequency("damping", &data.damping))
        .or_else(|| single("added mass at infinite frequency", &data.infinite))
        .or_else(|| single("added mass at zero frequency", &data.zero))
        .or_else(|| single("hydrostatic stiffness", &data.hydrostatics))
        .or_else(|| by_wave("excitation", &data.excitation))
        .or_else(|| by_wave("motion", data.motions.as_deref().unwrap_or_default()))
        .or_else(|| data.reference.iter().any(bad).then(|| "the point of reference".to_string()))
        .or_else(|| {
            let mut drift = data.drift.iter().flat_map(|d| d.values.iter().flatten().flatten());
            drift.any(bad).then(|| "a coefficient of drift".to_string())
        })
}

/// The worst asymmetry of matrices, where it is to be said.
fn unsymmetric(what: &str, list: &[Matrix6<f64>], frequencies: &[f64]) -> Option<String> {
    let mut worst = (MAX_ASYMMETRY, 0, 0, 0.0);
    // the largest of each direction over all frequencies: damping of long waves is all noise
    let size = [0, 1, 2, 3, 4, 5].map(|i| list.iter().map(|m| m[(i, i)].abs()).fold(0.0, f64::max));
    let scale = |i: usize, j: usize| (size[i] * size[j]).sqrt();
    for (matrix, frequency) in list.iter().zip(frequencies) {
        for i in 0..6 {
            for j in 0..i {
                let off = (matrix[(i, j)] - matrix[(j, i)]).abs();
                if off > worst.0 * scale(i, j) && scale(i, j) > 0.0 {
                    worst = (off / scale(i, j), i, j, *frequency);
                }
            }
        }
    }
    let (off, i, j, frequency) = worst;
    let name = |i: usize| MODES.get(i).copied().unwrap_or_default();
    (off > MAX_ASYMMETRY).then(|| {
        format!(
            "{what} is not symmetric: {}-{} differs by {:.1} % at {frequency:.4} rad/s",
            name(i),
            name(j),
            100.0 * off
        )
    })
}

/// The first negative damping on a diagonal that is more than noise.
fn negative_damping(data: &Database) -> Option<String> {
    (0..6).find_map(|i| {
        let largest = data.damping.iter().map(|m| m[(i, i)].abs()).fold(0.0, f64::max);
        let least = data.damping.iter().zip(&data.frequencies).min_by(|a, b| a.0[(i, i)].total_cmp(&b.0[(i, i)]))?;
        let value = least.0[(i, i)];
        (value < -0.01 * largest).then(|| {
            let name = MODES.get(i).copied().unwrap_or_default();
            format!(
                "damping of {name} is negative at {:.4} rad/s: {:.1} % of its largest",
                least.1,
                100.0 * value / largest
            )
        })
    })
}

/// The widest gap between headings, where it is wider than what is interpolated over.
pub(super) fn gaps(headings: &[f64]) -> Option<String> {
    let first = *headings.first()?;
    let next = headings.iter().skip(1).copied().chain([first + TAU]);
    let (from, to) = headings.iter().copied().zip(next).max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)))?;
    (to - from > super::interpolation::WIDEST_GAP).then(|| {
        let [from, to, gap] = [from, to, to - from].map(f64::to_degrees);
        let back = |toward: f64| (toward + 180.0) % 360.0;
        if headings.len() == 1 {
            return format!(
                "{HEADING_GAP_REMARK} all round: waves other than toward {from:.0} degrees in the body (from {:.0}) are refused",
                back(from)
            );
        }
        format!(
            "{HEADING_GAP_REMARK} of {gap:.0} degrees: waves toward {from:.0} to {:.0} in the body (from {:.0} to {:.0}) are refused",
            to % 360.0,
            back(from),
            back(to)
        )
    })
}
