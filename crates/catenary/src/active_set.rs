//! The active set of a line of several segments: which segments rest on the seabed and which joints are held (on the seabed, or by a
//! pendant), and the stretches of line between them.
//!
//! For a given active set each stretch is a problem of its own; `contact_problem` solves them and changes the set.

use super::element::LinePiece;
use super::multi_segment::{JointStatus, MultiSegmentLine, SegmentSolution};
use super::segment::SpanReach;

/// Which pieces rest on the bottom, and how the joints stand.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ActiveSet {
    pub rests: Vec<bool>,
    pub stands: Vec<JointStatus>,
}

/// A run of line between two places of known height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineStretch {
    /// The first piece, and whether only its lower leg belongs to it.
    pub from: usize,
    pub begins_with_leg: bool,
    /// The last piece, and whether only its upper leg belongs to it.
    pub to: usize,
    pub ends_with_leg: bool,
}

impl LineStretch {
    /// The joint of known height at its upper end; none at the fairlead or on the bottom within a piece.
    pub fn start_joint(&self) -> Option<usize> {
        if self.begins_with_leg { None } else { self.from.checked_sub(1) }
    }

    /// Whether its upper end is the fairlead.
    pub fn starts_at_fairlead(&self) -> bool {
        self.from == 0 && !self.begins_with_leg
    }

    /// The joint of known height at its lower end; none at the anchor or on the bottom within a piece.
    pub fn end_joint(&self, count: usize) -> Option<usize> {
        if self.ends_with_leg || self.to + 1 >= count { None } else { Some(self.to) }
    }

    /// Its parts: piece, part, whether that is the piece's lower leg.
    pub fn parts<'a>(
        &self,
        held: &'a [SegmentSolution],
    ) -> impl Iterator<Item = (usize, &'a SpanReach, bool)> + use<'a> {
        let own = *self;
        held.iter().enumerate().skip(own.from).take(own.to + 1 - own.from).map(move |(i, h)| {
            let lower = i == own.from && own.begins_with_leg;
            (i, if lower { &h.lower } else { &h.upper }, lower)
        })
    }
}

impl ActiveSet {
    /// The sections of a chain of so many pieces, from the fairlead down.
    pub fn sections(&self, count: usize) -> Vec<LineStretch> {
        let mut list = Vec::with_capacity(count);
        let (mut from, mut begins_with_leg) = (0, false);
        for i in 0..count {
            if self.rests[i] {
                list.push(LineStretch { from, begins_with_leg, to: i, ends_with_leg: true });
                (from, begins_with_leg) = (i, true);
            }
            let fast = self.stands.get(i).is_none_or(|s| !matches!(s, JointStatus::Free(_)));
            if fast {
                list.push(LineStretch { from, begins_with_leg, to: i, ends_with_leg: false });
                (from, begins_with_leg) = (i + 1, false);
            }
        }
        list
    }
}

/// A policy to begin with: joints that are not lifted, and the pieces between them, lie on the bottom.
pub fn first_policy(chain: &MultiSegmentLine) -> ActiveSet {
    let stands: Vec<JointStatus> = chain
        .pulls
        .iter()
        .map(|p| match p.steps.is_empty() {
            true if p.on_bottom && p.lift <= 0.0 => JointStatus::Bottom,
            true => JointStatus::Free(0),
            false => JointStatus::Step(0),
        })
        .collect();
    let low = |j: Option<usize>| j.is_none_or(|j| stands.get(j).is_none_or(|s| *s == JointStatus::Bottom));
    let rests = |(i, e): (usize, &LinePiece)| e.can_rest() && low(i.checked_sub(1)) && low(Some(i)) && i > 0;
    let rests = chain.elements.iter().enumerate().map(rests).collect();
    ActiveSet { rests, stands }
}
