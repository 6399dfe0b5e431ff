//! The pressure of a stream over the height, in strips: `w = |v| v`, in each strip a parabola of the distance from the surface.
//!
//! A strip ends where the formula or the curve of the stream has a kink; within one the parabola goes through the ends and
//! the middle. So a single current that is straight between the points of its curve is exact. Strips of wind double their
//! height from 1 m: there the parabola keeps within 0.3 % of the square of a power of 1/7, and its integral over a strip
//! within some 3e-4.

use super::steady::{Medium, Steady};
use super::wind::MIN_WIND_HEIGHT_M;
use nalgebra::{SVector, Vector3};

/// Highest strip of wind (m); above it the wind is that of its upper end.
const MAX_WIND_HEIGHT_M: f64 = 1024.0;
/// Into how many a strip is divided in which several currents are added: the length of a sum is no parabola.
const PARTS_PER_STRIP: usize = 4;

/// `w = a + b u + c u u`, u from the start of the strip; of D components.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strip<const D: usize = 2> {
    /// Where it begins: height over the surface in air, depth below it in water (m).
    pub from: f64,
    /// The coefficients, horizontal (m2/s2, m/s2, 1/s2).
    pub terms: [SVector<f64, D>; 3],
}

impl<const D: usize> Strip<D> {
    /// Whether w is the same all over it.
    pub fn is_uniform(&self) -> bool {
        self.terms[1] == SVector::<f64, D>::zeros() && self.terms[2] == SVector::<f64, D>::zeros()
    }

    /// w at a distance from the surface, and its change with that distance.
    pub fn evaluate(&self, distance: f64) -> (SVector<f64, D>, SVector<f64, D>) {
        let (u, [a, b, c]) = (distance - self.from, self.terms);
        (a + (b + c * u) * u, b + c * (2.0 * u))
    }
}

/// A stream of air or water from the surface up or down.
#[derive(Clone, Debug)]
pub struct Strips<const D: usize = 2> {
    /// From the surface on; the last has no end. Never empty.
    strips: Vec<Strip<D>>,
    /// 1 in air and -1 in water: the sense of the distance along z.
    pub sense: f64,
    /// Height of the surface (m, global).
    pub level: f64,
    /// Density (kg/m3).
    pub density: f64,
}

impl Strips {
    /// Those of the wind or the current in force.
    pub fn new(steady: &Steady, medium: Medium) -> Self {
        let level = steady.around.tide;
        let (sense, mut levels) = match medium {
            Medium::Air => {
                let doubled = std::iter::successors(Some(MIN_WIND_HEIGHT_M), |z| Some(2.0 * z))
                    .take_while(|z| *z <= MAX_WIND_HEIGHT_M);
                (1.0, doubled.chain(steady.wind.iter().flat_map(|w| w.kinks())).collect())
            }
            Medium::Water => (-1.0, steady.current.kinks()),
        };
        // below the bottom there is no water: the current that would begin to fail there goes on
        let bottom = steady.around.depth.map(|d| d + level).filter(|_| medium == Medium::Water);
        let last = levels.iter().fold(0.0, |a: f64, b| a.max(*b)).min(bottom.unwrap_or(f64::INFINITY));
        levels.push(0.0);
        levels.push(last);
        levels.retain(|u| (0.0..=last).contains(u));
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        if medium == Medium::Water && !steady.current.simple() {
            levels = divide_levels(&levels);
        }
        let w = |u: f64| {
            let v: Vector3<f64> = match (medium, &steady.wind) {
                (Medium::Air, Some(wind)) => wind.toward * wind.speed(u).0,
                (Medium::Air, None) => Vector3::zeros(),
                (Medium::Water, _) => steady.current.at_depth(u).0,
            };
            v.xy() * v.norm()
        };
        let ends: Vec<SVector<f64, 2>> = levels.iter().map(|u| w(*u)).collect();
        let mut strips: Vec<Strip> = Vec::new();
        for (at, value) in levels.windows(2).zip(ends.windows(2)) {
            let ([low, high], [first, last]) = (at, value) else { continue };
            let (long, middle) = (high - low, w(0.5 * (low + high)));
            let strip = if first == last && middle == *first {
                Strip { from: *low, terms: [*first, SVector::zeros(), SVector::zeros()] }
            } else {
                let b = (middle * 4.0 - first * 3.0 - last) / long;
                Strip { from: *low, terms: [*first, b, (first + last - middle * 2.0) * (2.0 / (long * long))] }
            };
            join(&mut strips, strip);
        }
        let end = ends.last().copied().unwrap_or_default();
        join(&mut strips, Strip { from: last, terms: [end, SVector::zeros(), SVector::zeros()] });
        Strips { strips, sense, level, density: steady.density(medium) }
    }
}

impl Strips<1> {
    /// A pressure of one all over air or water.
    pub fn uniform(steady: &Steady, medium: Medium) -> Self {
        let sense = if medium == Medium::Air { 1.0 } else { -1.0 };
        let strip = Strip { from: 0.0, terms: [SVector::from([1.0]), SVector::zeros(), SVector::zeros()] };
        Strips { strips: vec![strip], sense, level: steady.around.tide, density: steady.density(medium) }
    }
}

impl<const D: usize> Strips<D> {
    /// The strips from a distance to another, each with where it ends.
    pub fn strips_between(&self, low: f64, high: f64) -> impl Iterator<Item = (&Strip<D>, f64)> {
        let first = self.strips.partition_point(|s| s.from <= low).saturating_sub(1);
        let rest = &self.strips[first..];
        let ends = rest.iter().skip(1).map(|s| s.from).chain(std::iter::once(f64::INFINITY));
        rest.iter().zip(ends).enumerate().take_while(move |(n, (s, _))| *n == 0 || s.from < high).map(|(_, s)| s)
    }

    /// w at the surface.
    pub fn at_surface(&self) -> SVector<f64, D> {
        self.strips.first().map_or_else(SVector::zeros, |s| s.terms[0])
    }
}

/// Adds a strip, or lets the one before go on where nothing changes.
fn join(strips: &mut Vec<Strip>, strip: Strip) {
    let same = strips.last().is_some_and(|s| s.is_uniform() && strip.is_uniform() && s.terms[0] == strip.terms[0]);
    if !same {
        strips.push(strip);
    }
}

/// Levels with [`PARTS_PER_STRIP`] strips for each.
fn divide_levels(levels: &[f64]) -> Vec<f64> {
    let mut made: Vec<f64> = levels
        .windows(2)
        .flat_map(|w| {
            let (low, long) =
                (w.first().copied().unwrap_or_default(), w.last().zip(w.first()).map_or(0.0, |(b, a)| b - a));
            (0..PARTS_PER_STRIP).map(move |n| low + long * n as f64 / PARTS_PER_STRIP as f64)
        })
        .collect();
    made.extend(levels.last());
    made
}
