//! Where nodes are at the start, and how long tethers are against what they span.

use super::Deck;
use super::elements::StructureDeck;
use super::remarks::Remarks;
use super::tethers::Tether;
use nalgebra::{Rotation3, Vector3};
use windlass_base::diagnostic::Diagnostic;

/// Strain past which a tether at the start is said to be shorter than its span: steel yields below 0.4 %.
const LONGEST_STRAIN: f64 = 0.01;

impl Deck {
    /// Position at the start of a node that moves with a structure: the node of deck 1 carried with the centre of gravity to
    /// its place of deck 15 and turned about it, by RX, then RY, then RZ about the fixed axes (assumed for large angles: no
    /// page seen gives the order).
    pub fn node_position(&self, structure: &StructureDeck, node: i64) -> Option<[f64; 3]> {
        let node = Vector3::from(self.nodes.get(&node)?.position);
        let centre = Vector3::from(self.mass_properties(structure).centre);
        let [x, y, z, rx, ry, rz] = self.start(structure);
        let turn = Rotation3::from_euler_angles(rx.to_radians(), ry.to_radians(), rz.to_radians());
        Some((Vector3::new(x, y, z) + turn * (node - centre)).into())
    }

    /// Unstretched length of a tether in the deck's unit of length: the sum of its elements.
    pub fn unstretched_length(&self, tether: &Tether) -> Option<f64> {
        let position = |node: i64| self.nodes.get(&node).map(|node| Vector3::from(node.position));
        let mut length = 0.0;
        for element in &tether.description.elements {
            length += (position(element.node2.value)? - position(element.node1.value)?).norm();
        }
        Some(length)
    }

    /// Distance at the start, in the deck's unit of length, between the anchor (or trailing end) of a tether and its node on the structure.
    pub fn span(&self, tether: &Tether) -> Option<f64> {
        let structure = self.structure(tether.structure.value)?;
        let anchor = Vector3::from(self.nodes.get(&tether.anchor.value)?.position);
        Some((Vector3::from(self.node_position(structure, tether.node.value)?) - anchor).norm())
    }
}

/// Warns of a tether that is far shorter than what it spans at the start.
pub fn check(deck: &Deck, remarks: &mut Remarks) {
    for tether in &deck.mooring.tethers {
        let (Some(length), Some(span)) = (deck.unstretched_length(tether), deck.span(tether)) else { continue };
        if length > 0.0 && span > length * (1.0 + LONGEST_STRAIN) {
            let message = format!("deck 14, TETH: this tether is {length:.3} long and spans {span:.3} at the start");
            remarks.add(
                Diagnostic::warning(message, tether.span)
                    .label(format!("a strain of {:.1} %", 100.0 * (span / length - 1.0)))
                    .help(
                        "lengths are those between the nodes of TELM; the structure starts where POS of deck 15 says",
                    ),
            );
        }
    }
}
