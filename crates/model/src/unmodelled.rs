//! Records whose effect no solver computes. They stop the next solve, unless `&PARAMETER -ACCEPT_MISSING` accepts them.
//!
//! Whoever reads such a record keeps an [`UnmodelledEffect`]: in [`crate::Piece::unmodelled`] where it belongs to a piece, else by
//! [`Model::keep_unmodelled`]. Solvers ask [`Model::check_effects`]; [`Model::caveats`] names in every report what was accepted.

use crate::{ClassError, Model};
use windlass_base::span::Span;

/// Most records that one message lists.
const MAX_LISTED: usize = 6;

pub use windlass_base::spec::SolveKind;

/// A record that changes a mass, a buoyancy, a stiffness, a damping, a load, a length or a place, where no solver computes it.
#[derive(Clone, Debug, PartialEq)]
pub struct UnmodelledEffect {
    /// The record or option as written, and whose it is: `-DD_MULT 2 of piece HULL`.
    pub record: String,
    /// What is not computed: `wave drift damping`.
    pub effect: String,
    /// The solves it matters to: what matters to statics matters to motions too.
    pub matters_to: SolveKind,
    /// Where it was given.
    pub span: Span,
}

impl UnmodelledEffect {
    /// The record with what it would change.
    pub fn sentence(&self) -> String {
        format!("{} ({})", self.record, self.effect)
    }
}

impl Model {
    /// Keeps a record whose effect no solver computes, and that belongs to no piece.
    pub fn keep_unmodelled(&mut self, effect: UnmodelledEffect) {
        self.unmodelled.push(effect);
    }

    /// The effects that solves of a kind would need and nothing computes.
    pub fn unmodelled_effects(&self, kind: SolveKind) -> Vec<&UnmodelledEffect> {
        let of_pieces = self.parts.values().flat_map(|part| &part.pieces).flat_map(|piece| &piece.unmodelled);
        of_pieces.chain(&self.unmodelled).filter(|effect| effect.matters_to <= kind).collect()
    }

    /// Sees that nothing is left out of a solve that has not been accepted.
    ///
    /// # Errors
    /// The records whose effect is not computed, each with it; at the place of the first.
    pub fn check_effects(&self, kind: SolveKind) -> Result<(), ClassError> {
        let effects = self.unmodelled_effects(kind);
        let Some(first) = effects.first().filter(|_| !self.parameters.accept_missing) else { return Ok(()) };
        let text = format!("the solve stops: not computed is {}", list(&effects));
        Err(ClassError::new(text).with_span(first.span).help(
            "leave the record out, or go on without its effect by &PARAMETER -ACCEPT_MISSING YES, which every report then says",
        ))
    }

    /// Sees that motions can be computed: all effects are, and no hull under waves lacks added mass.
    ///
    /// # Errors
    /// As [`Model::check_effects`] and [`Model::check_added_mass`].
    pub fn check_motions(&self) -> Result<(), ClassError> {
        self.check_effects(SolveKind::Motions)?;
        self.check_added_mass()
    }

    /// The remark on what is not computed and has been accepted.
    pub(crate) fn accepted_effects(&self) -> Option<String> {
        let effects = self.unmodelled_effects(SolveKind::Motions);
        (!effects.is_empty() && self.parameters.accept_missing)
            .then(|| format!("not computed, as &PARAMETER -ACCEPT_MISSING accepts: {}", list(&effects)))
    }
}

fn list(effects: &[&UnmodelledEffect]) -> String {
    let listed: Vec<String> = effects.iter().take(MAX_LISTED).map(|e| e.sentence()).collect();
    let more = effects.len().saturating_sub(MAX_LISTED);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    listed.join(", ") + &more
}
