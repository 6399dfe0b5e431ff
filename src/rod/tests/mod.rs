//! Whole rods against closed forms and other programs.

mod beam;
mod chain900;
mod motion;
mod section;
mod still;
mod tangent;
