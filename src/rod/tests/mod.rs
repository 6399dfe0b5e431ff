//! Whole rods against closed forms and other programs.

mod beam;
mod lowering;
mod motion;
mod section;
mod snapshot;
mod still;
mod tangent;
mod violent;
