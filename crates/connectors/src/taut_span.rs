//! A weightless straight line between its two ends: what its tension exerts on them, and how that changes with their places and velocities.
//!
//! From p to q it has the length l = |q - p|, the direction n = (q - p)/l and the rate l' = n (vq - vp). Its tension T, a function of both, pulls p along n and q
//! against it; the stiffness is n (dT/dl n + dT/dl' (1 - n n')(vq - vp)/l)' + T/l (1 - n n').

use super::spring::no_anchor;
use nalgebra::{Matrix3, Matrix6, Vector3};
use std::fmt::Debug;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_model::{
    ClassError, Connector, ConnectorElement, ConnectorResponse, ConnectorSummary, End, Note, Situation, SolverCache,
};

/// A straight line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TautSpan {
    /// Unit vector from its first end to its second.
    pub direction: Vector3<f64>,
    /// Its length (m).
    pub length: f64,
    /// Rate of its length (m/s).
    pub rate: f64,
    /// Velocity of the second end against the first across the line, over its length (1/s): the gradient of the rate by place.
    turning: Vector3<f64>,
}

/// The tension of a straight line, and how it changes with its length and rate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpanTension {
    /// Tension (N).
    pub tension: f64,
    /// Derivative by the length (N/m).
    pub by_length: f64,
    /// Derivative by the rate (N s/m).
    pub by_rate: f64,
}

/// The tension of a straight line without state.
pub trait SpanLaw: Debug + Send + Sync {
    /// The tension on the line as it is.
    fn tension_of(&self, span: &TautSpan) -> SpanTension;

    /// What the user should know of it.
    fn notes(&self, span: &TautSpan) -> Vec<Note>;
}

/// A straight line without state between two ends.
#[derive(Debug)]
pub struct SpanElement<L>(pub L);

impl<L: SpanLaw> ConnectorElement for SpanElement<L> {
    fn evaluate(
        &self,
        at: &Situation,
        _: &[f64],
        _: &mut [f64],
        _: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        let span = read_span(at.ends)?;
        apply_tension(&span, &self.0.tension_of(&span), out);
        Ok(())
    }

    fn summary(&self, at: &Situation, _: &[f64]) -> Result<ConnectorSummary, ClassError> {
        let span = read_span(at.ends)?;
        let (tension, notes) = (Some(self.0.tension_of(&span).tension), self.0.notes(&span));
        Ok(ConnectorSummary { tension, notes, solution: "exact", ..ConnectorSummary::default() })
    }
}

/// Refuses a connector of a straight line that is not between two points; `text` says what the class takes.
///
/// # Errors
/// An anchor beside its points, or another number of points.
pub fn check_span_ends(class: &str, text: &str, connector: &Connector) -> Outcome<()> {
    no_anchor(class, connector)?;
    if connector.points.len() == 2 { Ok(()) } else { Err(Diagnostic::error(text, connector.span)) }
}

/// The line between two ends.
///
/// # Errors
/// Another number of ends, both ends in one place.
pub fn read_span(ends: &[End]) -> Result<TautSpan, ClassError> {
    let [first, second] = ends else { return Err(ClassError::new("a line has two ends").lasting()) };
    let chord = second.pose.origin - first.pose.origin;
    let length = chord.norm();
    if length == 0.0 {
        return Err(ClassError::new("its ends are in one place, where its tension has no direction"));
    }
    let direction = chord / length;
    let velocity = (second.velocity - first.velocity).fixed_rows::<3>(0).into_owned();
    let rate = direction.dot(&velocity);
    Ok(TautSpan { direction, length, rate, turning: (velocity - direction * rate) / length })
}

/// The wrenches on its ends with stiffness and damping, in `out`.
pub fn apply_tension(span: &TautSpan, tension: &SpanTension, out: &mut ConnectorResponse) {
    out.clear(2);
    let n = span.direction;
    for (wrench, sign) in out.wrench.iter_mut().zip([1.0, -1.0]) {
        wrench.fixed_rows_mut::<3>(0).copy_from(&(n * (sign * tension.tension)));
    }
    let across = (Matrix3::identity() - n * n.transpose()) * (tension.tension / span.length);
    let along = n * (n * tension.by_length + span.turning * tension.by_rate).transpose();
    fill(&mut out.stiffness, &(across + along));
    if tension.by_rate != 0.0 {
        out.damping.resize(4, Matrix6::zeros());
        fill(&mut out.damping, &(n * n.transpose() * tension.by_rate));
    }
}

/// Fills the blocks of two ends that a force between them has.
fn fill(blocks: &mut [Matrix6<f64>], block: &Matrix3<f64>) {
    for (whole, sign) in blocks.iter_mut().zip([1.0, -1.0, -1.0, 1.0]) {
        whole.fixed_view_mut::<3, 3>(0, 0).copy_from(&(block * sign));
    }
}

/// Step from 0 at and below 0 to 1 at and above 1 without a kink, and its slope.
pub fn smooth_step(x: f64) -> (f64, f64) {
    let x = x.clamp(0.0, 1.0);
    (x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x))
}
