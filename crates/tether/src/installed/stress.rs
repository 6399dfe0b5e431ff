//! Stresses at an end of an element of an installed tether ([AQWA-TETHER 2.3]; the formulas of [W-INSTALLED 4]).
//!
//! With the wall's tension N, area A, second moment I, outer and inner radius R and r, the resultants V and M of shear and moment:
//! - axial `N/A`, to which what an impact left is added; bending `M R/I`; their sum and difference are the largest and the smallest;
//! - shear `V R^2/I`: the thin wall's `V Q/(2 t I)` with `Q = 2 R^2 t`;
//! - von Mises at both extreme fibres, outside and inside, of the axial and bending stress there and of the hoop and radial ones of Lame's
//!   thick cylinder [TIMOSHENKO-1956 44]; the shear stress, which is least there, is left out.

use crate::TetherTube;

/// What an end of an element bears.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EndLoads {
    /// Effective tension (N).
    pub effective: f64,
    /// Tension of the wall (N).
    pub wall: f64,
    /// Shear along X and along Y (N), as [AQWA-TETHER 8.2] prints it: what the element does to its end.
    pub shear: [f64; 2],
    /// Moments about X and about Y (N m), as printed.
    pub moment: [f64; 2],
    /// Pressure outside and inside (Pa).
    pub pressure: [f64; 2],
    /// Axial stress that an impact left (Pa).
    pub impact: f64,
    /// Whether it is the upper end.
    pub upper: bool,
}

/// The stresses there (Pa).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stresses {
    /// Axial.
    pub axial: f64,
    /// Bending at the outer fibre, of the resultant moment.
    pub bending: f64,
    /// Shear.
    pub shear: f64,
    /// Axial and bending, largest around the section.
    pub maximum: f64,
    /// Axial and bending, smallest around the section.
    pub minimum: f64,
    /// Largest von Mises stress.
    pub von_mises: f64,
    /// Bending of the moment about Y, at the fibre on +X.
    pub bending_y: f64,
}

impl EndLoads {
    /// The stresses in a tube.
    pub fn stresses(&self, tube: &TetherTube) -> Stresses {
        let (outer, inner) = (tube.radius(), 0.5 * tube.inner_diameter());
        let second = tube.second_moment();
        let [mx, my] = self.moment;
        let axial = self.wall / tube.area() + self.impact;
        let resultant = mx.hypot(my);
        let bending = resultant * outer / second;
        let [out, inside] = self.pressure;
        let ring = outer * outer - inner * inner;
        let (squares, twice) = (outer * outer + inner * inner, 2.0 * outer * outer);
        let outside = [(2.0 * inside * inner * inner - out * squares) / ring, -out];
        let within = [(inside * squares - out * twice) / ring, -inside];
        let mut worst = 0.0f64;
        for side in [1.0, -1.0] {
            worst = worst.max(von_mises([axial + side * bending, outside[0], outside[1]]));
            // a bar has no inner fibre
            if inner > 0.0 {
                worst = worst.max(von_mises([axial + side * resultant * inner / second, within[0], within[1]]));
            }
        }
        Stresses {
            axial,
            bending,
            shear: self.shear[0].hypot(self.shear[1]) * outer * outer / second,
            maximum: axial + bending,
            minimum: axial - bending,
            von_mises: worst,
            bending_y: if self.upper { my } else { -my } * outer / second,
        }
    }
}

/// Von Mises' stress of three principal ones.
fn von_mises([a, b, c]: [f64; 3]) -> f64 {
    (0.5 * ((a - b).powi(2) + (b - c).powi(2) + (c - a).powi(2))).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TUBE: TetherTube = TetherTube { outer_diameter: 1.1176, wall_thickness: 0.038 };

    #[test]
    fn stresses_match_listing_row() {
        // [AQWA-TETHER 8.2], tether 1 at 6.5 s, its top: kN and m; the depth of the top is (4.976 + 697.8)/(rho g A)
        let wall = -697.8e3;
        let pressure = (4.976e3 - wall) / TUBE.external_area();
        let loads = EndLoads {
            effective: 4.976e3,
            wall,
            shear: [122.1e3, 0.0],
            moment: [0.0, -1356e3],
            pressure: [pressure, 0.0],
            impact: 0.0,
            upper: true,
        };
        let found = loads.stresses(&TUBE);
        // printed to three digits
        let want =
            [(found.shear, 2.03e6), (found.maximum, 3.49e7), (found.minimum, -4.57e7), (found.von_mises, 4.12e7)];
        for (got, printed) in want.into_iter().chain([(found.bending_y, -4.03e7)]) {
            assert!((got / printed - 1.0).abs() < 2e-3, "{got} {printed}");
        }
    }

    #[test]
    fn pressure_on_capped_tube_matches_lame_stress() {
        // all around, ends too: a bar feels no von Mises stress; a tube at its inner side sqrt(3) p R^2/(R^2 - r^2)
        let bar = TetherTube { outer_diameter: 1.0, wall_thickness: 0.5 };
        let of = |tube: &TetherTube| EndLoads {
            wall: -1e6 * tube.external_area(),
            pressure: [1e6, 0.0],
            ..EndLoads::default()
        };
        assert!(of(&bar).stresses(&bar).von_mises < 1e-6);
        let (outer, inner) = (TUBE.radius(), 0.5 * TUBE.inner_diameter());
        let want = 3f64.sqrt() * 1e6 * outer * outer / (outer * outer - inner * inner);
        assert!((of(&TUBE).stresses(&TUBE).von_mises / want - 1.0).abs() < 1e-12);
    }
}
