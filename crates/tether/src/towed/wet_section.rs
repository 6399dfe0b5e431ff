//! The wet part of a horizontal round tube, and where along an element the surface cuts it.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use super::super::beam::GAUSS;

/// The wet part of a cross section with the surface at a height over the axis; areas stand for displaced mass over density.
///
/// Added mass as AQWA-DRIFT of 2006 has it [W-TOWED 2]: with h the submerged height over the
/// diameter D and `c^2 = 4 D^2 h (1-h)` the waterline chord squared, across y that of a circle of diameter hD; along z that of
/// half a flat plate of width c up to half depth, and what that lacks above it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SubmergedSection {
    /// Submerged height (m), also the width that drag acts on.
    pub height: f64,
    /// Submerged area (m2).
    pub area: f64,
    /// Area of the added mass along y and z (m2), for a coefficient of 1.
    pub added: [f64; 2],
    /// Growth of that along z with the rise of the surface (m), for slam.
    pub growth: f64,
    /// First moment of the submerged area about the axis, downward (m3).
    pub moment: f64,
}

impl SubmergedSection {
    /// That of a surface `s` above the axis of a tube of diameter `d`.
    #[inline]
    pub fn new(s: f64, d: f64) -> Self {
        let r = 0.5 * d;
        if s >= r {
            let area = FRAC_PI_4 * d * d;
            return SubmergedSection { height: d, area, added: [area; 2], growth: 0.0, moment: 0.0 };
        }
        // not `<=`: a surface that is no number is for the check of the step
        if s <= -r {
            return SubmergedSection { height: 0.0, area: 0.0, added: [0.0; 2], growth: 0.0, moment: 0.0 };
        }
        let h = (s + r) / d;
        let half_chord_squared = r * r - s * s;
        let half_chord = half_chord_squared.sqrt();
        let plate = FRAC_PI_4 * 2.0 * half_chord_squared;
        SubmergedSection {
            height: s + r,
            area: r * r * (FRAC_PI_2 + (s / r).asin()) + s * half_chord,
            added: [FRAC_PI_4 * (s + r) * (s + r), if h < 0.5 { plate } else { FRAC_PI_4 * d * d - plate }],
            growth: FRAC_PI_2 * d * (1.0 - 2.0 * h).abs(),
            moment: 2.0 / 3.0 * half_chord_squared * half_chord,
        }
    }
}

/// Places along an integration length where its fitted surface is looked at [AQWA-TETHER 3.4].
const SURFACE_SAMPLES: usize = 23;
/// Pieces of an integration length at most [AQWA-TETHER 3.4].
pub const MAX_WETTED_PIECES: usize = 7;

/// How the surface lies along an integration length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SubmergenceState {
    /// Above the tube all along.
    Under,
    /// Below the tube all along.
    Dry,
    /// In these pieces (fractions of the length) it does not pass the top or the bottom of the tube.
    Cut {
        /// Their limits, 0 to 1.
        limits: [f64; MAX_WETTED_PIECES + 1],
        /// How many pieces there are.
        pieces: usize,
    },
}

/// The cubic through the values at the Gauss points, at the places looked at: weights of the values.
#[derive(Clone, Debug, PartialEq)]
pub struct Scan {
    weights: [[f64; 4]; SURFACE_SAMPLES],
}

impl Default for Scan {
    fn default() -> Self {
        let mut weights = [[1.0; 4]; SURFACE_SAMPLES];
        for (position, row) in weights.iter_mut().enumerate() {
            let at = position as f64 / (SURFACE_SAMPLES - 1) as f64;
            for (i, weight) in row.iter_mut().enumerate() {
                for (j, (other, _)) in GAUSS.iter().enumerate() {
                    if i != j {
                        *weight *= (at - other) / (GAUSS[i].0 - other);
                    }
                }
            }
        }
        Scan { weights }
    }
}

impl Scan {
    /// How the surface lies, of its heights over the axis at the Gauss points of the length and the radius of the tube.
    pub fn wetness(&self, heights: &[f64; 4], radius: f64) -> SubmergenceState {
        let mut values = [0.0; SURFACE_SAMPLES];
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for (value, w) in values.iter_mut().zip(&self.weights) {
            *value = w[0] * heights[0] + w[1] * heights[1] + w[2] * heights[2] + w[3] * heights[3];
            least = least.min(*value);
            most = most.max(*value);
        }
        if least >= radius {
            return SubmergenceState::Under;
        }
        if most <= -radius {
            return SubmergenceState::Dry;
        }
        let mut limits = [0.0; MAX_WETTED_PIECES + 1];
        let mut pieces = 0;
        for position in 1..SURFACE_SAMPLES {
            let (from, to) = (values[position - 1], values[position]);
            // in the order the line between them meets top and bottom
            let levels = if to >= from { [-radius, radius] } else { [radius, -radius] };
            for level in levels {
                if (from < level) != (to < level) && pieces + 1 < MAX_WETTED_PIECES {
                    pieces += 1;
                    limits[pieces] =
                        (position as f64 - 1.0 + (level - from) / (to - from)) / (SURFACE_SAMPLES - 1) as f64;
                }
            }
        }
        pieces += 1;
        limits[pieces] = 1.0;
        SubmergenceState::Cut { limits, pieces }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn half_submerged_tube_has_half_area_and_half_added_mass_along_z() {
        let (half, whole) = (SubmergedSection::new(0.0, 2.0), SubmergedSection::new(1.0, 2.0));
        assert!((half.area - PI / 2.0).abs() < 1e-15 && (whole.area - PI).abs() < 1e-15);
        // a plate of the diameter has the added mass of the circle, half of it wet: [NEWMAN-1977 4.15]
        assert!((half.added[1] - PI / 2.0).abs() < 1e-15 && (half.added[0] - PI / 4.0).abs() < 1e-15);
        assert_eq!(
            SubmergedSection::new(-1.0, 2.0),
            SubmergedSection { height: 0.0, area: 0.0, added: [0.0; 2], growth: 0.0, moment: 0.0 }
        );
        // the centre of half a disc is 4 r / 3 pi off
        assert!((half.moment - half.area * 4.0 / (3.0 * PI)).abs() < 1e-15);
    }

    #[test]
    fn wetted_section_derivatives_match_added_mass_and_area() {
        let h = 1e-6;
        for s in [-0.9, -0.4, 0.3, 0.8] {
            let (before, at, after) =
                (SubmergedSection::new(s - h, 2.0), SubmergedSection::new(s, 2.0), SubmergedSection::new(s + h, 2.0));
            assert!(((after.added[1] - before.added[1]) / (2.0 * h) - at.growth).abs() < 1e-8);
            assert!(((after.area - before.area) / (2.0 * h) - 2.0 * (1.0 - s * s).sqrt()).abs() < 1e-8);
        }
    }

    #[test]
    fn inclined_surface_cuts_length_at_bottom_and_top_crossings() {
        let scan = Scan::default();
        // s = 4 a - 2 on a tube of radius 1: bottom at a quarter, top at three quarters
        let heights = GAUSS.map(|(a, _)| 4.0 * a - 2.0);
        let SubmergenceState::Cut { limits, pieces } = scan.wetness(&heights, 1.0) else { panic!("it is cut") };
        assert_eq!(pieces, 3);
        for (limit, want) in limits.iter().zip([0.0, 0.25, 0.75, 1.0]) {
            assert!((limit - want).abs() < 1e-14, "{limits:?}");
        }
        assert_eq!(scan.wetness(&[1.5; 4], 1.0), SubmergenceState::Under);
        assert_eq!(scan.wetness(&[-1.5; 4], 1.0), SubmergenceState::Dry);
        let down = GAUSS.map(|(a, _)| 5.0 - 100.0 * a);
        let SubmergenceState::Cut { limits, pieces } = scan.wetness(&down, 1.0) else { panic!("it is cut") };
        assert!(pieces == 3 && (limits[1] - 0.04).abs() < 1e-14 && (limits[2] - 0.06).abs() < 1e-14);
    }
}
