//! The other side of a body that is symmetric about its x-z plane.

use super::rows::{axis, position, same_heading};
use std::f64::consts::TAU;
use windlass_model::Database;

/// Which of the six change sign on the other side.
const MIRROR_SIGNS: [f64; 6] = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0];

/// The same with the headings of the other side of a body that is symmetric about its x-z plane; those that are there stay.
/// A reference point off that plane has no mirror: the database is left as it is.
pub fn mirror_headings(mut data: Database) -> Database {
    if data.reference.y.abs() > 1e-9 {
        data.remarks.push("its point is off the plane of symmetry: no headings are mirrored".into());
        return data;
    }
    let own = data.headings.clone();
    fill(&own, &mut data.excitation, |six| std::array::from_fn(|i| six[i] * MIRROR_SIGNS[i]));
    if let Some(motions) = &mut data.motions {
        fill(&own, motions, |six| std::array::from_fn(|i| six[i] * MIRROR_SIGNS[i]));
    }
    data.headings = both_sides(&own);
    if let Some(drift) = &mut data.drift {
        fill(&drift.headings, &mut drift.values, |six| std::array::from_fn(|i| six[i] * MIRROR_SIGNS[i]));
        drift.headings = both_sides(&drift.headings);
    }
    if let Some(qtf) = &mut data.qtf {
        let mirror = |row: &Vec<super::Amplitudes>| {
            row.iter().map(|six| std::array::from_fn(|i| six[i] * MIRROR_SIGNS[i])).collect::<Vec<_>>()
        };
        fill(&qtf.headings, &mut qtf.values, mirror);
        qtf.headings = both_sides(&qtf.headings);
    }
    data.remarks.retain(|r| !r.starts_with(super::checks::HEADING_GAP_REMARK));
    data.remarks.extend(super::checks::gaps(&data.headings));
    data
}

/// Where a heading of one side is on the other.
fn other(heading: f64) -> f64 {
    let turn = (TAU - heading).rem_euclid(TAU);
    if turn > TAU - 1e-9 { 0.0 } else { turn }
}

/// Headings with those of the other side.
fn both_sides(headings: &[f64]) -> Vec<f64> {
    axis(headings.iter().copied().chain(headings.iter().map(|h| other(*h))), same_heading)
}

/// Puts tables by heading on both sides.
fn fill<T: Clone>(headings: &[f64], tables: &mut Vec<Vec<T>>, mirror: impl Fn(&T) -> T) {
    if tables.is_empty() {
        return;
    }
    let both = both_sides(headings);
    let made = both.iter().map(|heading| {
        let near = |h: f64| headings.get(position(headings, h)).is_some_and(|own| same_heading(*own, h));
        if near(*heading) {
            return tables.get(position(headings, *heading)).cloned().unwrap_or_default();
        }
        tables.get(position(headings, other(*heading))).map_or(Vec::new(), |t| t.iter().map(&mirror).collect())
    });
    *tables = made.collect();
}
