//! The Green function of the linear free surface.
//!
//! In deep water it is `1/r + 1/r' + k W(X, Y)` with the distance `r` from the source, `r'` from its image above the mean level,
//! `X = k R` of the horizontal distance and `Y = -k (z + zeta) >= 0` of the heights, and the wave part
//!
//! ```text
//! W(X, Y) = 2 int_0^inf exp(-u Y) J0(u X) / (u - 1) du      (the path passes below the pole)
//! ```
//!
//! for the time factor `exp(-i omega t)` [NEWMAN-1985]. It obeys `dW/dY = -(W + 2/d)`, `d = sqrt(X2 + Y2)`.

mod finite_depth;
mod patch;
mod quadrature;
mod special;
mod wave_part;

pub use finite_depth::{FiniteDepthTable, FrequencyPart, FrequencySlopes};
pub use quadrature::integrate_wave_part;
pub use wave_part::{WavePart, WavePartBatch, WavePartTable};
