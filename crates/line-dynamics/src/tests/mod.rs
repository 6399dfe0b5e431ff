//! Whole rods against closed forms and other programs.

mod beam;
mod cantilever;
mod end_tangent;
mod euler_fallback;
mod friction;
mod friction_across;
mod lowering;
mod motion;
mod released;
mod section;
mod slope;
mod snap_loads;
mod snapshot;
mod statics_and_modes;
mod supports;
mod surface;
mod tangent;
mod viscoelastic;
mod warm_start;

/// A buoy of half a cubic metre at a node.
fn buoy(node: usize) -> super::Attachment {
    super::Attachment { volume: 0.5, height: 0.8, drag: 0.4, added: 0.5, ..super::Attachment::mass(node, 100.0) }
}
