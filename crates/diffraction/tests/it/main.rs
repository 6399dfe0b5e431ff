//! Tests of the public functions of the crate.
#![allow(clippy::unwrap_used)]

mod bad_input;
mod cylinder;
mod drift;
mod green_function;
mod hemisphere;
mod submerged_sphere;
mod two_boxes;
