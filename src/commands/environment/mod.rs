//! Records about sea, wind, current, bottom, and the curves they use.

pub(crate) mod ambient_options;
pub(crate) mod bathymetry;
pub(crate) mod curves;
pub(crate) mod env;
pub(crate) mod plausible;
pub(crate) mod probability;
pub(crate) mod sea_options;
pub(crate) mod wind_options;
