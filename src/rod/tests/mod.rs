//! Whole rods against closed forms and other programs.

mod beam;
mod end_tangent;
mod lowering;
mod motion;
mod section;
mod snapshot;
mod still;
mod surface;
mod tangent;
mod violent;
