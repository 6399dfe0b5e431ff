//! Dynamic lines against MoorDyn and exact catenaries.

#![allow(clippy::unwrap_used)]

mod coupled;
mod moordyn;
mod rod_moordyn;
mod rod_statics;
