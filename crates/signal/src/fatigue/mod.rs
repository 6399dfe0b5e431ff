//! Fatigue: curves of stress or tension, damage of counted cycles and of spectra, and what a mooring line comes to.

pub mod curve;
pub mod damage;
pub mod library;
pub mod line;
pub mod spectral;

pub use curve::{CurveBranch, SnCurve};
pub use damage::{Damage, ScatterState, cycle_damage, life, sum_damage};
pub use library::{find, library};
pub use line::{Exposure, LineDamage, Loaded, SegmentDamage, SegmentLife, line_damage, line_life};
