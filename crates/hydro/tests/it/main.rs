//! Hydrostatics, waves and databases against closed forms, listings and published values.

#![allow(clippy::unwrap_used)]

mod hemisphere;
mod hydro_databases;
mod hydrostatics;
mod seed_003_spectrum;
