//! Whole rods against closed forms and other programs.

mod beam;
mod lowering;
mod motion;
mod rollers;
mod rope;
mod section;
mod still;
mod surface;
mod tangent;
mod violent;
