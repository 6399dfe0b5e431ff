//! One piece of a line, as the forces at its end make it: free, or resting on a flat, smooth bottom with a leg at either
//! end.
//!
//! The horizontal force H is the same all along such a line. What is left to find is the vertical force V at the upper
//! end, which grows with the height.
//!
//! Source: [IRVINE-1981 1.4]; contact: V = 0 at the touchdown.

use super::line::Segment;
use super::segment::{SpanReach, hanging};
use super::stretch_law::StretchLaw;

/// A piece of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum LinePiece {
    /// A length of line; `sees_bottom` when the bottom carries it.
    Length { segment: Segment, law: Option<StretchLaw>, sees_bottom: bool },
    /// A spring without length or weight, which stretches along its tension.
    Link(StretchLaw),
}

impl LinePiece {
    /// The whole piece, hanging free with `h` and `v` at its upper end.
    pub fn whole(&self, h: f64, v: f64) -> SpanReach {
        match self {
            LinePiece::Link(law) => spring_reach(law, h, v),
            LinePiece::Length { segment, law, .. } => {
                stretch(segment, law.as_ref(), segment.length, h, v - segment.weight * segment.length)
            }
        }
    }

    /// The leg from the upper end, with `h` and `v` there, down to where the piece meets the bottom and V is zero. With
    /// a negative `v` the rise is that of `-v`, negative: so it grows with `v` throughout.
    pub fn upper_leg(&self, h: f64, v: f64) -> SpanReach {
        let LinePiece::Length { segment, law, .. } = self else { return SpanReach::default() };
        let s = v.abs() / segment.weight;
        let r = stretch(segment, law.as_ref(), s, h, 0.0);
        // a longer leg begins lower: one more piece at the touchdown, along the bottom
        let more = (1.0 + strain(segment, law.as_ref(), h).0) / segment.weight;
        let sign = if v < 0.0 { -1.0 } else { 1.0 };
        SpanReach { x: r.x, z: sign * r.z, x_h: r.x_h, x_v: sign * (r.x_v + more), z_h: sign * r.z_h, z_v: r.z_v }
    }

    /// The leg from where the piece leaves the bottom to its lower end, with `h` and `v` there: `v` is negative and the
    /// rise with it; with a positive `v` as for [`LinePiece::upper_leg`].
    pub fn lower_leg(&self, h: f64, v: f64) -> SpanReach {
        let LinePiece::Length { segment, law, .. } = self else { return SpanReach::default() };
        let s = v.abs() / segment.weight;
        let r = stretch(segment, law.as_ref(), s, h, -segment.weight * s);
        // a longer leg goes on at its end, along the tension there
        let tension = h.hypot(segment.weight * s);
        let more = (1.0 + strain(segment, law.as_ref(), tension).0) / (tension * segment.weight);
        let sign = if v < 0.0 { -1.0 } else { 1.0 };
        let z_v = more * segment.weight * s;
        SpanReach { x: r.x, z: -sign * r.z, x_h: r.x_h, x_v: sign * more * h, z_h: -sign * r.z_h, z_v }
    }

    /// Unstretched length of a leg with |V| at its end (m).
    pub fn leg(&self, v: f64) -> f64 {
        match self {
            LinePiece::Length { segment, .. } => v.abs() / segment.weight,
            LinePiece::Link(_) => 0.0,
        }
    }

    /// Whether the bottom can carry the piece.
    pub fn can_rest(&self) -> bool {
        matches!(self, LinePiece::Length { segment, sees_bottom: true, .. } if segment.weight > 0.0)
    }

    /// Unstretched length (m).
    pub fn length(&self) -> f64 {
        match self {
            LinePiece::Length { segment, .. } => segment.length,
            LinePiece::Link(_) => 0.0,
        }
    }

    /// Weight of the whole piece (N).
    pub fn weight(&self) -> f64 {
        match self {
            LinePiece::Length { segment, .. } => segment.weight * segment.length,
            LinePiece::Link(_) => 0.0,
        }
    }

    /// Weight per unstretched length (N/m).
    pub fn weight_per_length(&self) -> f64 {
        match self {
            LinePiece::Length { segment, .. } => segment.weight,
            LinePiece::Link(_) => 0.0,
        }
    }

    /// Strain at a tension (N), and its derivative (1/N).
    pub fn strain(&self, tension: f64) -> (f64, f64) {
        match self {
            LinePiece::Length { segment, law, .. } => strain(segment, law.as_ref(), tension),
            LinePiece::Link(_) => (0.0, 0.0),
        }
    }
}

/// A stretch of line of unstretched length `length`, with `h` and `v` at its lower end.
pub fn stretch(segment: &Segment, law: Option<&StretchLaw>, length: f64, h: f64, v: f64) -> SpanReach {
    let part = Segment { length, ..*segment };
    let mut reach = hanging(&part, h, v);
    if let Some(law) = law {
        reach += law.beyond_linear(&part, h, v);
    }
    reach
}

/// A spring along its own tension: z = y(T) V/T.
pub(super) fn spring_reach(law: &StretchLaw, h: f64, v: f64) -> SpanReach {
    let tension = h.hypot(v);
    let (y, slope) = law.stretch(tension);
    let share = if tension > 0.0 { y / tension } else { slope };
    let turn = if tension > 0.0 { (slope - share) / (tension * tension) } else { 0.0 };
    SpanReach {
        x: h * share,
        z: v * share,
        x_h: share + turn * h * h,
        x_v: turn * h * v,
        z_h: turn * h * v,
        z_v: share + turn * v * v,
    }
}

/// Strain at a tension, and its derivative.
pub(super) fn strain(segment: &Segment, law: Option<&StretchLaw>, tension: f64) -> (f64, f64) {
    law.map_or((tension / segment.ea, 1.0 / segment.ea), |l| l.stretch(tension))
}

/// Mean strain between two tensions, and its derivative when both change.
pub(super) fn mean_strain(segment: &Segment, law: Option<&StretchLaw>, a: f64, b: f64) -> (f64, f64) {
    match law {
        None => (0.5 * (a + b) / segment.ea, 1.0 / segment.ea),
        Some(law) => law.mean(a, b),
    }
}

/// V (N) at the upper end of a line that touches down below it: from (T + EA)2 = (H + EA)2 + 2 EA w z.
pub fn vertical_of_contact(segment: &Segment, h: f64, z: f64) -> f64 {
    let rise = segment.weight * z;
    let stiff = h + segment.ea;
    let both = 2.0 * segment.ea * rise;
    let change = both / ((stiff * stiff + both).sqrt() + stiff);
    (change * (change + 2.0 * h)).sqrt()
}
