//! Dynamic lines against MoorDyn and exact catenaries.

mod moordyn;
mod rod_moordyn;
mod rod_statics;
