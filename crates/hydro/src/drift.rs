//! `#DRIFT`: mean wave drift from a table of coefficients over the square of the wave amplitude, by period and heading.
//!
//! The mean in a sea is `2 * sum of S dw D(w)`, in a regular wave `D a^2` [FALTINSEN-1990 5]. D is straight over
//! frequency between the periods given and constant beyond the first and the last; spreading of the sea is not
//! regarded. The layout is that of MOSES's report of mean drift forces [MOSES-RUNS wav_drift].
//!
//! Under way the same coefficients make the slow drift of the waves that the sea then has, each in its own direction, by Newman's approximation
//! ([`super::database::slow_drift`]): in a regular wave that is the mean, in a sea its mean is `sum a2 D`.

use super::heading::ByHeading;
use super::sea::Sea;
use super::spectrum::WaveEnergies;
use super::steady::{Medium, Steady};
use super::stream::{Immersion, LoadPlace, StreamWrench};
use super::{BodyLoad, Category, Load};
use nalgebra::{Matrix6x3, Vector3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_model::{ClassError, DriftTable};

/// Coefficients of one heading: the direction the waves come from in the body (rad); period (s), six coefficients (N/m2, N/m).
pub type DriftRow = (f64, Vec<(f64, [f64; 6])>);

/// The mean drift of one sea on a body.
#[derive(Debug)]
pub struct DriftLoad {
    steady: Arc<Steady>,
    at: Vector3<f64>,
    toward: Vector3<f64>,
    /// Mean force (N) and moment (N m) by the direction the sea comes from in the body.
    mean: ByHeading,
}

impl DriftLoad {
    /// The mean drift of a sea that travels toward a horizontal direction, about a point of the body (m).
    ///
    /// # Errors
    /// A table whose headings make none; see [`ByHeading::new`].
    pub fn new(
        steady: Arc<Steady>,
        at: Vector3<f64>,
        (toward, waves): (Vector3<f64>, &WaveEnergies),
        rows: &[DriftRow],
        symmetric: bool,
    ) -> Result<Self, ClassError> {
        let mut means: Vec<(f64, [f64; 6])> = rows.iter().map(|(h, rows)| (*h, mean(waves, rows).into())).collect();
        means.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(DriftLoad { steady, at, toward, mean: ByHeading::new(&means, symmetric)? })
    }

    /// The same for a part that stands turned about z by an angle (rad) in its body.
    pub fn rotate(self, angle: f64, axes: impl Fn(Six) -> Six) -> Self {
        DriftLoad { mean: self.mean.rotate(angle, axes), ..self }
    }
}

/// Coefficients by frequencies that grow (rad/s), of periods that grow (s).
fn by_frequency(rows: &[(f64, [f64; 6])]) -> Vec<(f64, Six)> {
    rows.iter().rev().map(|(t, c)| (TAU / t, Six::from(*c))).collect()
}

/// The coefficients at a frequency (rad/s): straight between those given, the ends hold beyond them.
fn interpolate_coefficients(list: &[(f64, Six)], w: f64) -> Six {
    let next = list.partition_point(|r| r.0 <= w);
    match (next.checked_sub(1).and_then(|i| list.get(i)), list.get(next)) {
        (Some((low, a)), Some((high, b))) => a + (b - a) * ((w - low) / (high - low)),
        (Some(end), None) | (None, Some(end)) => end.1,
        (None, None) => Six::zeros(),
    }
}

/// The mean over waves of coefficients over the square of the amplitude, by periods that grow.
pub fn mean(waves: &WaveEnergies, rows: &[(f64, [f64; 6])]) -> Six {
    let list = by_frequency(rows);
    waves.energies.iter().map(|(w, energy)| interpolate_coefficients(&list, *w) * (2.0 * energy)).sum()
}

/// The headings all round to which a table under way is drawn, beside those given: 5 degrees apart, between which what is straight
/// differs from the cubic of [`ByHeading`] by some 0.1 %.
const TABLE_HEADINGS: u32 = 72;
/// Headings nearer than this are one (rad).
const EQUAL_HEADINGS_RAD: f64 = 1e-6;
/// The most coefficients a table may have.
const MAX_COEFFICIENTS: usize = 1_000_000;

/// The table of a part that stands turned about z by an angle (rad) in its body, at the frequencies of the waves of a sea.
///
/// # Errors
/// A table whose headings make none; see [`ByHeading::new`]. A sea of more waves than are tabulated.
pub fn table(
    sea: &Sea,
    rows: &[DriftRow],
    symmetric: bool,
    (angle, axes): (f64, impl Fn(Six) -> Six),
) -> Result<DriftTable, ClassError> {
    let mut frequencies: Vec<f64> = sea.components.iter().map(|c| c.frequency).collect();
    frequencies.sort_by(f64::total_cmp);
    frequencies.dedup();
    let mut lists: Vec<(f64, Vec<(f64, Six)>)> = rows.iter().map(|(h, rows)| (*h, by_frequency(rows))).collect();
    lists.sort_by(|a, b| a.0.total_cmp(&b.0));
    let round = (0..TABLE_HEADINGS).map(|n| TAU * f64::from(n) / f64::from(TABLE_HEADINGS));
    let given = lists.iter().flat_map(|(h, _)| [*h, if symmetric { -h } else { *h }]);
    // waves go where they do not come from
    let mut headings: Vec<f64> = round.chain(given).map(|from| (from + angle + PI).rem_euclid(TAU)).collect();
    headings.sort_by(f64::total_cmp);
    headings.dedup_by(|a, b| (*a - *b).abs() < EQUAL_HEADINGS_RAD);
    if frequencies.len().saturating_mul(headings.len()) > MAX_COEFFICIENTS {
        return Err(ClassError::new("the sea has more waves, and the table more headings, than are tabulated"));
    }
    let mut values = vec![Vec::with_capacity(frequencies.len()); headings.len()];
    for w in &frequencies {
        let here: Vec<(f64, [f64; 6])> =
            lists.iter().map(|(h, list)| (*h, interpolate_coefficients(list, *w).into())).collect();
        let made = ByHeading::new(&here, symmetric)?.rotate(angle, &axes);
        for (toward, list) in headings.iter().zip(&mut values) {
            list.push(made.interpolate(toward - PI).0.into());
        }
    }
    Ok(DriftTable { frequencies, headings, values, method: None })
}

impl BodyLoad for DriftLoad {
    fn category(&self) -> Category {
        Category::WaveDrift
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let travel = pose.axes.transpose() * self.toward;
        let square = travel.x * travel.x + travel.y * travel.y;
        if square < 1e-12 {
            return Err(ClassError::new("the drift of waves has no heading: they travel along the body's z axis"));
        }
        let (value, slope) = self.mean.interpolate((-travel.y).atan2(-travel.x));
        let turned = nalgebra::RowVector3::new(-travel.y, travel.x, 0.0) / square;
        let by_velocity: Matrix6x3<f64> = slope * turned;
        // a stream of speed one: only its direction counts
        let position = LoadPlace { at: self.at, medium: Medium::Water, immersion: Immersion::Whole };
        let push = StreamWrench { wrench: value, by_velocity };
        Ok(position.load_in(&self.steady, pose, (self.toward, Vector3::zeros()), |_| push))
    }
}
