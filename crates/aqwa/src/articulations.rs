//! Articulations of deck 12 (DCON): joints that hold two structures together at a point and lock none to three rotations.
//!
//! Source: [AQWA-REF DCON]: 0 ball and socket, 1 universal, 2 hinge, 3 locked; [AQWA-THEORY 1.2.3] for their axes.

use super::card::Field;
use super::layout::CardRecord;
use super::remarks::Remarks;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// A side of a joint: a node of a structure, and a second one on the axis about which that side turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointSide {
    /// The structure; 0 is the fixed reference.
    pub structure: Field<i64>,
    /// The node at the joint.
    pub node: Field<i64>,
    /// A node on the axis; 0 for none.
    pub axis: Field<i64>,
}

/// A joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Articulation {
    /// Rotations that are locked, 0 to 3.
    pub locked: Field<i64>,
    /// Its two sides.
    pub sides: [JointSide; 2],
    /// The card.
    pub span: Span,
}

/// The joints of the cards of deck 12.
pub fn read(records: &[CardRecord], remarks: &mut Remarks) -> Vec<Articulation> {
    let mut list = Vec::new();
    for record in records.iter().filter(|record| record.keyword == "DCON") {
        let locked = record.int(11);
        if !(0..=3).contains(&locked.value) {
            remarks.add(
                Diagnostic::error(
                    format!("deck 12, DCON, columns 11-15: {} is not a valid number of locked rotations", locked.value),
                    locked.span,
                )
                .label("0 ball and socket, 1 universal, 2 hinge, 3 locked"),
            );
            continue;
        }
        let side = |first: usize| JointSide {
            structure: record.int(first),
            node: record.int(first + 5),
            axis: record.int(first + 10),
        };
        list.push(Articulation { locked, sides: [side(16), side(36)], span: record.span });
    }
    list
}
