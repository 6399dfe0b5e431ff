//! Whole rods against closed forms and other programs.

mod beam;
mod chain900;
mod motion;
mod still;
mod tangent;
