//! What the project promises of itself: specs, the crates and what they may use, the list of what is shown.

#![allow(clippy::unwrap_used)]

mod coverage;
mod crates;
mod manual;
mod registries;
mod report_columns;
mod sources;
mod specs;
mod value_keys;
