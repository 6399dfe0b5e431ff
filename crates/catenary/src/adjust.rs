//! Lengths that give a line a wanted force between given ends.

use super::line::Line;
use super::refused::LineError;
use super::search::{Point, rising_root};

/// The force that is wanted at the fairlead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aim {
    /// Horizontal force (N).
    Horizontal(f64),
    /// Tension (N).
    Tension(f64),
}

impl Line {
    /// The length of the first segment (m) with which the fairlead, `x` beside the anchor and at elevation `fairlead`,
    /// bears what is wanted; its present length when nothing is.
    ///
    /// # Errors
    /// [`LineError`]; among them a force that no length gives.
    pub fn first_length(&self, x: f64, fairlead: f64, aim: Option<Aim>) -> Result<f64, LineError> {
        let present = self.segments.first().map_or(0.0, |s| s.length);
        let Some(aim) = aim else { return Ok(present) };
        let wanted = match aim {
            Aim::Horizontal(force) | Aim::Tension(force) => force,
        };
        if !(wanted > 0.0 && wanted.is_finite()) {
            return Err(LineError::Value { what: "the force", segment: 1, value: wanted });
        }
        let force = |length: f64| {
            let state = self.clone().with_first_length(length)?.at_distance(x, fairlead)?;
            Ok(match aim {
                Aim::Horizontal(_) => state.force,
                Aim::Tension(_) => state.top_tension,
            })
        };
        // a longer line pulls less; what is too short to be solved pulls too much
        let (length, _) = rising_root(present, -wanted, |length| Point {
            value: force(length).map_or(f64::NEG_INFINITY, |f| -f).max(-f64::MAX),
            slope: f64::NAN,
        });
        let found: f64 = force(length)?;
        if (found - wanted).abs() <= 1e-9 * wanted {
            return Ok(length);
        }
        Err(LineError::NoLength { wanted, nearest: found })
    }
}
