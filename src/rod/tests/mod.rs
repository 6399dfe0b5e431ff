//! Whole rods against closed forms and other programs.

mod across;
mod again;
mod beam;
mod end_tangent;
mod friction;
mod lowering;
mod motion;
mod released;
mod rope;
mod section;
mod slope;
mod snap;
mod snapshot;
mod still;
mod supports;
mod surface;
mod tangent;
mod violent;
