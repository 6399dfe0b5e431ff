//! Draft marks of `&DESCRIBE DMARK`: lines on a body along which its draft is read.
//!
//! That a mark is a line between two points is known [MOSES-REF ppo_inte]; that its reading counts from the first point is our reading.

use super::Model;
use windlass_base::span::Span;

/// A draft mark.
#[derive(Clone, Debug, PartialEq)]
pub struct DraftMark {
    /// Its name as written.
    pub name: String,
    /// The points it runs between, of one body.
    pub points: [String; 2],
    /// Where it was defined.
    pub span: Span,
}

impl Model {
    /// The draft at a mark (m): the length along its line from its first point to the water's surface, negative where that point is
    /// above it. `None` of a line that is level, or whose points are not there.
    pub fn draft_at(&self, mark: &DraftMark) -> Option<f64> {
        let at = |name: &String| self.points.get(&Model::key(name)).map(|p| self.global(p));
        let [first, second] = [at(&mark.points[0])?, at(&mark.points[1])?];
        let length = first.iter().zip(second).map(|(a, b)| (b - a).powi(2)).sum::<f64>().sqrt();
        let rise = second[2] - first[2];
        let draft = length * (self.surroundings().tide - first[2]) / rise;
        (rise != 0.0 && draft.is_finite()).then_some(draft)
    }
}
