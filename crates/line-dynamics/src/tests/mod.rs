//! Whole rods against closed forms and other programs.

mod across;
mod again;
mod beam;
mod cantilever;
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

/// A buoy of half a cubic metre at a node.
fn buoy(node: usize) -> super::Attachment {
    super::Attachment { volume: 0.5, height: 0.8, drag: 0.4, added: 0.5, ..super::Attachment::mass(node, 100.0) }
}
