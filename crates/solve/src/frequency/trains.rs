//! A sea as energy over frequency and direction.

use std::f64::consts::PI;
use windlass_base::geometry::unit_vector;
use windlass_hydro::sea::density::Spectrum;
use windlass_hydro::sea::{Sea, spreading};
use windlass_model::{ClassError, Environment, Model};

/// Directions that stand for a spread sea, with equal shares of its energy.
const SPREADING_DIRECTIONS: usize = 11;
/// Shares of the energy between which frequencies are taken; the end ones stand for the rest.
const ENERGY_SHARES: [f64; 2] = [0.0005, 0.9995];

/// Points evenly over a sea, and at equal shares of its energy.
const EVEN_POINTS: usize = 120;
const EQUAL_ENERGY_POINTS: usize = 80;
/// Points beyond, and the factor from each to the next: accelerations come from there too.
const TAIL_POINTS: (i32, f64) = (5, 1.2);

/// A spectrum with the directions its waves travel in.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Directional {
    pub spectrum: Spectrum,
    /// Directions of travel (rad), with equal shares of the energy.
    pub toward: Vec<f64>,
}

/// The seas of an environment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trains {
    /// Irregular ones.
    pub(super) irregular: Vec<Directional>,
    /// Regular ones: frequency (rad/s), direction of travel (rad), energy (m2), half the square of the amplitude.
    pub(super) regular: Vec<(f64, f64, f64)>,
}

impl Trains {
    /// Where their waves come from (rad).
    pub fn headings(&self) -> Vec<f64> {
        let irregular = self.irregular.iter().flat_map(|sea| sea.toward.iter().copied());
        irregular.chain(self.regular.iter().map(|(_, toward, _)| *toward)).map(|toward| toward + PI).collect()
    }

    /// Those of an environment; `None` for calm water. With `-SPREAD` the energy stands in eleven directions of equal shares.
    ///
    /// # Errors
    /// A sea that cannot be.
    pub fn new(model: &Model, env: &Environment) -> Result<Option<Self>, ClassError> {
        let Some(sea) = Sea::new(model, env)? else { return Ok(None) };
        let exponent = env.spreading.unwrap_or(spreading::LONG_CRESTED);
        let toward = |from: f64, turn: f64| {
            let (cos, sin) = unit_vector(from + turn);
            f64::atan2(-sin, -cos)
        };
        let mut made = Trains::default();
        for train in sea.trains {
            match train.spectrum {
                Some(spectrum) => {
                    let count = if exponent >= spreading::LONG_CRESTED { 1 } else { SPREADING_DIRECTIONS };
                    let turn = |i: usize| match count {
                        1 => 0.0,
                        _ => spreading::angle((i as f64 + 0.5) / count as f64, exponent),
                    };
                    let toward = (0..count).map(|i| toward(train.direction, turn(i))).collect();
                    made.irregular.push(Directional { spectrum, toward });
                }
                None => {
                    let waves = &sea.components[train.components];
                    let one = |c: &windlass_hydro::sea::Component| {
                        (c.frequency, c.toward[1].atan2(c.toward[0]), 0.5 * c.amplitude * c.amplitude)
                    };
                    made.regular.extend(waves.iter().map(one));
                }
            }
        }
        Ok(Some(made))
    }

    /// Points that tell the seas: evenly over them, at equal shares of their energy, and a few beyond.
    pub(super) fn points(&self, [low, high]: [f64; 2]) -> Vec<f64> {
        let shares = (1..EQUAL_ENERGY_POINTS).map(|i| i as f64 / EQUAL_ENERGY_POINTS as f64);
        let by_energy = self.irregular.iter().flat_map(|d| shares.clone().map(|s| d.spectrum.quantile(s)));
        let last = self.irregular.iter().fold(0.0, |last: f64, d| last.max(d.spectrum.range()[1]));
        let beyond = (1..=TAIL_POINTS.0).map(|i| high * TAIL_POINTS.1.powi(i)).filter(|w| *w < last);
        even([low, high], EVEN_POINTS).into_iter().chain(by_energy).chain(beyond).collect()
    }

    /// The lowest and highest frequency (rad/s) with energy of irregular seas worth a point; `None` without one.
    pub(super) fn range(&self) -> Option<[f64; 2]> {
        let of = |d: &Directional| ENERGY_SHARES.map(|s| d.spectrum.quantile(s));
        let ranges = self.irregular.iter().map(of);
        ranges.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
    }
}

/// Points with others dense about natural frequencies, given each with its damping ratio, that lie between them. Growing.
pub(super) fn refine_near_resonance(mut points: Vec<f64>, natural: &[(f64, f64)]) -> Vec<f64> {
    /// Points about a natural frequency, how many half widths they reach from it, and the smallest half width taken.
    const ABOUT: (i32, f64, f64) = (24, 60.0, 1e-4);
    let (count, reach, least) = ABOUT;
    let ends = points.iter().fold([f64::INFINITY, 0.0], |[low, high], w| [w.min(low), w.max(high)]);
    for (w, ratio) in natural {
        let step = f64::asinh(reach) / f64::from(count);
        let about = (-count..=count).map(|i| w * (1.0 + ratio.max(least) * (f64::from(i) * step).sinh()));
        points.extend(about.filter(|w| *w > ends[0] && *w < ends[1]));
    }
    points.sort_by(f64::total_cmp);
    points.dedup_by(|a, b| *a - *b <= 1e-12 * *b);
    points
}

/// Points evenly over a range, its ends among them.
pub(super) fn even([low, high]: [f64; 2], count: usize) -> Vec<f64> {
    (0..=count).map(|i| low + (high - low) * i as f64 / count as f64).collect()
}

/// The bounds midway between points, within two ends: one more than the points.
pub(super) fn bounds(points: &[f64], [first, last]: [f64; 2]) -> Vec<f64> {
    let between = points.windows(2).map(|pair| 0.5 * pair.iter().sum::<f64>());
    std::iter::once(first).chain(between).chain(std::iter::once(last)).collect()
}
