//! Whole rods against closed forms and other programs.

mod again;
mod beam;
mod end_tangent;
mod lowering;
mod motion;
mod rope;
mod section;
mod snapshot;
mod still;
mod supports;
mod surface;
mod tangent;
mod violent;
