//! Hydrostatics, waves and databases against closed forms, listings and published values.

#![allow(clippy::unwrap_used)]

mod aqwa_tether_spectrum;
mod body_groups;
mod combination;
mod hemisphere;
mod hydro_databases;
mod hydrostatics;
mod tanks;
