//! Marine growth on members: a thickness by elevation, and what it adds to a member.
//!
//! Source: [MOSES-REF curv]: the curve M_GROWTH gives the added outside diameter by elevation, twice the thickness.
//! Our readings: elevations are global, above z = 0, tide left out, as growth stays where it has grown; it is straight between
//! the points of the curve, and there is none above its highest and below its lowest elevation. Where bodies move it stays on them:
//! whoever makes a load asks with the elevation at which the part stands then. Drag and inertia take the larger diameter; the density
//! of the growth in air is 1325 kg/m3 unless given ([NORSOK-N-003; DNV-RP-C205], from memory of them).

use std::f64::consts::FRAC_PI_4;
use windlass_model::{ClassError, CurveKind, Environment, Model};

/// Density of growth where none is given (kg/m3).
pub const DEFAULT_DENSITY: f64 = 1325.0;

/// Marine growth of an environment.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// Elevation (m), added diameter (m); elevations grow.
    points: Vec<(f64, f64)>,
    /// Density of the growth in air (kg/m3).
    pub density: f64,
}

impl Growth {
    /// That of an environment; `None` when it has none.
    ///
    /// # Errors
    /// A curve that is not there, or takes away from the diameter.
    pub fn from_environment(model: &Model, env: &Environment) -> Result<Option<Self>, ClassError> {
        let Some(named) = &env.growth else { return Ok(None) };
        let found = model.curves.get(&Model::key(&named.kind)).filter(|c| c.kind == CurveKind::MarineGrowth);
        let Some(curve) = found else {
            return Err(ClassError::new(format!("there is no M_GROWTH curve {}", named.kind)).with_span(named.span));
        };
        let density = named.value.unwrap_or(DEFAULT_DENSITY);
        Growth::new(curve.points.clone(), density).map(Some).map_err(|e| e.with_span(curve.span))
    }

    /// Growth by elevation (m, growing) as added diameter (m), of a density in air (kg/m3).
    ///
    /// # Errors
    /// A diameter below zero, elevations that do not grow, a density that is not positive.
    pub fn new(points: Vec<(f64, f64)>, density: f64) -> Result<Self, ClassError> {
        if points.iter().any(|p| p.1.is_nan() || p.1 < 0.0) {
            return Err(ClassError::new("marine growth does not take away from a diameter: added OD is zero or more"));
        }
        let grows = points.windows(2).all(|w| matches!(w, [a, b] if a.0 < b.0));
        if !grows || !density.is_finite() || density <= 0.0 {
            return Err(ClassError::new("marine growth has elevations that grow and a density above zero"));
        }
        Ok(Growth { points, density })
    }

    /// What it adds to the outside diameter of a member (m) at a global elevation (m): twice its thickness.
    pub fn added_diameter(&self, z: f64) -> f64 {
        let next = self.points.partition_point(|p| p.0 <= z);
        match (next.checked_sub(1).and_then(|i| self.points.get(i)), self.points.get(next)) {
            (Some((low, at_low)), Some((high, at_high))) => at_low + (at_high - at_low) * (z - low) / (high - low),
            (Some((top, at_top)), None) if *top == z => *at_top,
            _ => 0.0,
        }
    }

    /// The elevations at which it changes otherwise than before (m).
    pub fn elevations(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|p| p.0)
    }

    /// Area of the growth in a section of a member of a bare outside diameter (m) at a global elevation (m2).
    pub fn section(&self, bare: f64, z: f64) -> f64 {
        let whole = bare + self.added_diameter(z);
        FRAC_PI_4 * (whole * whole - bare * bare)
    }

    /// Mass it adds to a member of a bare outside diameter (m) per length at a global elevation (kg/m).
    pub fn mass(&self, bare: f64, z: f64) -> f64 {
        self.density * self.section(bare, z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn growth() -> Growth {
        Growth::new(vec![(-40.0, 0.1), (0.0, 0.2), (2.0, 0.0)], DEFAULT_DENSITY).unwrap()
    }

    #[test]
    fn growth_is_linear_between_its_points_and_zero_outside() {
        let growth = growth();
        for (z, added) in [(-40.0, 0.1), (-20.0, 0.15), (0.0, 0.2), (1.0, 0.1), (2.0, 0.0), (-40.1, 0.0), (5.0, 0.0)] {
            assert!((growth.added_diameter(z) - added).abs() < 1e-15, "{z}");
        }
        let flat = Growth::new(vec![(-10.0, 0.1), (0.0, 0.1)], DEFAULT_DENSITY).unwrap();
        assert_eq!((flat.added_diameter(0.0), flat.added_diameter(0.1)), (0.1, 0.0));
    }

    #[test]
    fn growth_mass_matches_its_ring() {
        // a ring of 50 mm about 1 m at -40 m: pi (0.55^2 - 0.5^2) x 1325 = pi x 0.0525 x 1325
        assert!((growth().mass(1.0, -40.0) - std::f64::consts::PI * 0.0525 * 1325.0).abs() < 1e-10);
    }

    #[test]
    fn negative_growth_is_refused() {
        assert!(Growth::new(vec![(-10.0, -0.1), (0.0, 0.1)], DEFAULT_DENSITY).is_err());
        assert!(Growth::new(vec![(0.0, 0.1), (-10.0, 0.1)], DEFAULT_DENSITY).is_err());
        assert!(Growth::new(vec![(-10.0, 0.1), (0.0, 0.1)], 0.0).is_err());
    }
}
