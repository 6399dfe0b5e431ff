//! A wave that stands still along a body: the water's surface is a cosine along the heading of its x axis, and the pressure below it that
//! of the water above. The profile is our reading; [MOSES-REF hstatic] has its length, steepness and crest alone.

use super::slabs::WaterSlabs;
use nalgebra::Vector2;
use std::f64::consts::TAU;
use windlass_base::units::Dim;
use windlass_model::ClassError;

/// Straight pieces of the profile in a wave length. With the correction of [`StaticWave::slabs`] the volume under it is that of the cosine to 1e-6 of the wave's.
const PIECES_IN_A_WAVE: f64 = 96.0;
/// Most pieces along a body: shorter waves are refused.
const MAX_PIECES: f64 = 4000.0;

/// A static wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticWave {
    /// Length (m).
    pub length: f64,
    /// Height from trough to crest (m).
    pub height: f64,
    /// Distance of a crest from the origin of the body along the heading of its x axis (m).
    pub crest: f64,
}

impl StaticWave {
    /// Height of the surface over the mean level at a distance along the heading (m).
    pub fn elevation(&self, distance: f64) -> f64 {
        0.5 * self.height * (TAU * (distance - self.crest) / self.length).cos()
    }

    /// The surface between two distances about a mean level (m, global), by straight pieces.
    ///
    /// A cosine interpolated between points a phase `a` apart has the mean of the cosine times `(sin(a/2) / (a/2))^2`; its ordinates are
    /// divided by that, so that what smooth functions integrate over it is right to the fourth order in `a`.
    ///
    /// # Errors
    /// A wave too short for the body.
    pub fn slabs(&self, ahead: Vector2<f64>, [low, high]: [f64; 2], level: f64) -> Result<WaterSlabs, ClassError> {
        let step = self.length / PIECES_IN_A_WAVE;
        let pieces = ((high - low) / step).ceil();
        if pieces.is_nan() || pieces > MAX_PIECES {
            let text = "a static wave of {} is too short for a body of {}";
            return Err(ClassError::with_values(text, &[(self.length, Dim::Length), (high - low, Dim::Length)]));
        }
        let half = 0.5 * TAU / PIECES_IN_A_WAVE;
        let corrected = (half / half.sin()).powi(2);
        let mut stations = Vec::new();
        let mut at = low;
        while at < high + step {
            stations.push([at, level + corrected * self.elevation(at)]);
            at += step;
        }
        Ok(WaterSlabs { ahead, stations })
    }
}
