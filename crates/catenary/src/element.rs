//! One piece of a line, as the forces at its end make it: free, or resting on the bottom with a leg at either end.
//!
//! Axes: t along the bottom toward the fairlead, n normal to it and upward; on a flat bottom these are x and z. A
//! frictionless bottom acts along n alone, so that the tension along t (`p`) changes with the weight alone, whether the
//! line lies or hangs; what is left to find is the tension along n (`q`), which grows with the height.
//!
//! Source: Irvine 1981 (see [`super`]); contact: V = 0 at the touchdown; friction: Jonkman, NREL/TP-500-41958, 2007,
//! section 2.7.2 (Coulomb, fully mobilised toward the fairlead, down to no tension).

use super::law::Law;
use super::line::Segment;
use super::segment::{Reach, hanging};

/// The inclination of the bottom, rising toward the fairlead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilt {
    pub sin: f64,
    pub cos: f64,
}

impl Tilt {
    pub const FLAT: Tilt = Tilt { sin: 0.0, cos: 1.0 };

    /// From vertical / horizontal distance.
    pub fn new(slope: f64) -> Tilt {
        let hypotenuse = slope.hypot(1.0);
        Tilt { sin: slope / hypotenuse, cos: 1.0 / hypotenuse }
    }

    /// Vertical over horizontal distance.
    pub fn slope(self) -> f64 {
        self.sin / self.cos
    }

    /// The angle above the horizontal, toward the fairlead (rad).
    pub fn angle(self) -> f64 {
        self.sin.atan2(self.cos)
    }

    /// Components along t and n from those along x and z.
    pub fn turned(self, x: f64, z: f64) -> (f64, f64) {
        (x * self.cos + z * self.sin, z * self.cos - x * self.sin)
    }

    /// Components along x and z from those along t and n.
    pub fn back(self, t: f64, n: f64) -> (f64, f64) {
        (t * self.cos - n * self.sin, t * self.sin + n * self.cos)
    }

    /// A reach in t and n, its derivatives by p and q.
    fn reach(self, r: Reach) -> Reach {
        if self.sin == 0.0 {
            return r;
        }
        let Tilt { sin: s, cos: c } = self;
        let (x, z) = self.turned(r.x, r.z);
        // columns by p and q first, then rows along t and n
        let (x_p, z_p) = (r.x_h * c + r.x_v * s, r.z_h * c + r.z_v * s);
        let (x_q, z_q) = (r.x_v * c - r.x_h * s, r.z_v * c - r.z_h * s);
        let ((x_h, z_h), (x_v, z_v)) = (self.turned(x_p, z_p), self.turned(x_q, z_q));
        Reach { x, z, x_h, x_v, z_h, z_v }
    }
}

/// What pulls at the line's pieces.
#[derive(Clone, Copy, Debug)]
pub struct Ground {
    pub tilt: Tilt,
    /// Friction coefficient.
    pub friction: f64,
    /// The force below which there is no tension left (N): keeps directions defined.
    pub least: f64,
}

/// A piece of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Element {
    /// A length of line; `sees_bottom` when the bottom carries it.
    Length { segment: Segment, law: Option<Law>, sees_bottom: bool },
    /// A spring without length or weight, which stretches along its tension.
    Link(Law),
}

/// A stretch of a piece as the forces at its upper end make it.
///
/// `t`, `n`: its reach along the bottom and its drop normal to it (m); `_p`, `_q`: their derivatives by the tension
/// along t and n there. A leg gets longer with |q|.
#[derive(Clone, Copy, Debug, Default)]
pub struct Part {
    pub t: f64,
    pub n: f64,
    pub t_p: f64,
    pub t_q: f64,
    pub n_p: f64,
    pub n_q: f64,
}

impl From<Reach> for Part {
    fn from(r: Reach) -> Part {
        Part { t: r.x, n: r.z, t_p: r.x_h, t_q: r.x_v, n_p: r.z_h, n_q: r.z_v }
    }
}

impl Element {
    /// The whole piece, hanging free with `p` and `q` at its upper end.
    pub fn whole(&self, ground: &Ground, p: f64, q: f64) -> Part {
        match self {
            Element::Link(law) => linked(law, p, q),
            Element::Length { segment, law, .. } => {
                let tilt = ground.tilt;
                let all = segment.weight * segment.length;
                stretch(segment, law.as_ref(), tilt, segment.length, p - all * tilt.sin, q - all * tilt.cos).into()
            }
        }
    }

    /// The leg from the upper end, with `p` and `q` there, down to where the piece meets the bottom and q is zero. With
    /// a negative q the drop is that of -q, downward: so it grows with q throughout.
    pub fn upper_leg(&self, ground: &Ground, p: f64, q: f64) -> Part {
        let Element::Length { segment, law, .. } = self else { return Part::default() };
        let tilt = ground.tilt;
        let (across, along) = self.per_length(ground);
        let s = q.abs() / across;
        let touch = (p - along * s).max(ground.least);
        let r = stretch(segment, law.as_ref(), tilt, s, touch, 0.0);
        // a longer leg begins lower: one more piece at the touchdown, along the bottom
        let more = (1.0 + strain(segment, law.as_ref(), touch).0) / across;
        let sign = if q < 0.0 { -1.0 } else { 1.0 };
        Part { t: r.x, n: sign * r.z, t_p: r.x_h, t_q: sign * (r.x_v + more), n_p: sign * r.z_h, n_q: r.z_v }
    }

    /// The leg from where the piece leaves the bottom, with tension `p` there, to its lower end, where q is negative
    /// and the drop with it; with a positive q as for [`Element::upper_leg`].
    pub fn lower_leg(&self, ground: &Ground, p: f64, q: f64) -> Part {
        let Element::Length { segment, law, .. } = self else { return Part::default() };
        let tilt = ground.tilt;
        let (across, along) = self.per_length(ground);
        let s = q.abs() / across;
        let low = p - along * s;
        let r = stretch(segment, law.as_ref(), tilt, s, low, -across * s);
        // a longer leg goes on at its end, along the tension there
        let tension = low.hypot(across * s);
        let more = (1.0 + strain(segment, law.as_ref(), tension).0) / (tension * across);
        let sign = if q < 0.0 { -1.0 } else { 1.0 };
        Part { t: r.x, n: -sign * r.z, t_p: r.x_h, t_q: sign * more * low, n_p: -sign * r.z_h, n_q: more * across * s }
    }

    /// Unstretched length of a leg with |q| at its end (m).
    pub fn leg(&self, ground: &Ground, q: f64) -> f64 {
        match self {
            Element::Length { .. } => q.abs() / self.per_length(ground).0,
            Element::Link(_) => 0.0,
        }
    }

    /// How far q and p fall from the upper to the lower end of the free piece (N).
    pub fn fall(&self, ground: &Ground) -> (f64, f64) {
        let all = self.weight();
        (all * ground.tilt.cos, all * ground.tilt.sin)
    }

    /// Weight per unstretched length along n and t (N/m).
    pub fn per_length(&self, ground: &Ground) -> (f64, f64) {
        match self {
            Element::Length { segment, .. } => (segment.weight * ground.tilt.cos, segment.weight * ground.tilt.sin),
            Element::Link(_) => (0.0, 0.0),
        }
    }

    /// Whether the bottom can carry the piece.
    pub fn can_rest(&self) -> bool {
        matches!(self, Element::Length { segment, sees_bottom: true, .. } if segment.weight > 0.0)
    }

    /// Unstretched length (m).
    pub fn length(&self) -> f64 {
        match self {
            Element::Length { segment, .. } => segment.length,
            Element::Link(_) => 0.0,
        }
    }

    /// Weight of the whole piece (N).
    pub fn weight(&self) -> f64 {
        match self {
            Element::Length { segment, .. } => segment.weight * segment.length,
            Element::Link(_) => 0.0,
        }
    }

    /// `length` of the piece on the bottom, `p` the tension at its end toward the fairlead.
    pub fn rest(&self, ground: &Ground, p: f64, length: f64) -> Rest {
        match self {
            Element::Length { segment, law, .. } => rest(segment, law.as_ref(), ground, p, length),
            Element::Link(_) => Rest { p, p_p: 1.0, ..Rest::default() },
        }
    }
}

/// A stretch of line of unstretched length `length`, the tension at its lower end given along t and n.
pub fn stretch(segment: &Segment, law: Option<&Law>, tilt: Tilt, length: f64, p: f64, q: f64) -> Reach {
    let (h, v) = tilt.back(p, q);
    let part = Segment { length, ..*segment };
    let mut reach = hanging(&part, h, v);
    if let Some(law) = law {
        reach += law.beyond_linear(&part, h, v);
    }
    tilt.reach(reach)
}

/// A spring along its own tension: n = y(T) q/T.
pub(super) fn linked(law: &Law, p: f64, q: f64) -> Part {
    let tension = p.hypot(q);
    let (y, slope) = law.stretch(tension);
    let share = if tension > 0.0 { y / tension } else { slope };
    let turn = if tension > 0.0 { (slope - share) / (tension * tension) } else { 0.0 };
    Part {
        t: p * share,
        n: q * share,
        t_p: share + turn * p * p,
        t_q: turn * p * q,
        n_p: turn * p * q,
        n_q: share + turn * q * q,
    }
}

/// The part on the bottom; `_p` and `_s`: derivatives by the tension at its end toward the fairlead and by its length.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rest {
    /// Reach along t (m).
    pub t: f64,
    /// Tension left at its end toward the anchor (N).
    pub p: f64,
    pub t_p: f64,
    pub t_s: f64,
    pub p_p: f64,
    pub p_s: f64,
    /// Stretched length (m).
    pub stretched: f64,
}

fn rest(segment: &Segment, law: Option<&Law>, ground: &Ground, p: f64, length: f64) -> Rest {
    let Tilt { sin, cos } = ground.tilt;
    let loss = segment.weight * (sin + ground.friction * cos);
    if loss * length <= p {
        let end = p - loss * length;
        let (more, by_p) = mean_strain(segment, law, p, end);
        let stretched = length * (1.0 + more);
        let t_s = 1.0 + strain(segment, law, end).0;
        return Rest { t: stretched, p: end, t_p: length * by_p, t_s, p_p: 1.0, p_s: -loss, stretched };
    }
    let under = p / loss;
    let stretched = under * (1.0 + mean_strain(segment, law, p, 0.0).0);
    // without tension: down a smooth slope it slides to the anchor and lies there in a heap
    let slides = sin > ground.friction * cos;
    let slack = if slides { 0.0 } else { length - under };
    let (more, t_s) = if slides { (1.0, 0.0) } else { (0.0, 1.0) };
    let t_p = (more + strain(segment, law, p).0) / loss;
    Rest { t: stretched + slack, p: 0.0, t_p, t_s, p_p: 0.0, p_s: 0.0, stretched: stretched + (length - under) }
}

/// Strain at a tension, and its derivative.
pub(super) fn strain(segment: &Segment, law: Option<&Law>, tension: f64) -> (f64, f64) {
    law.map_or((tension / segment.ea, 1.0 / segment.ea), |l| l.stretch(tension))
}

/// Mean strain between two tensions, and its derivative when both change.
pub(super) fn mean_strain(segment: &Segment, law: Option<&Law>, a: f64, b: f64) -> (f64, f64) {
    match law {
        None => (0.5 * (a + b) / segment.ea, 1.0 / segment.ea),
        Some(law) => law.mean(a, b),
    }
}

/// V at the upper end of a line that touches down below it: from (T + EA)2 = (H + EA)2 + 2 EA w z.
pub fn vertical_of_contact(segment: &Segment, h: f64, z: f64) -> f64 {
    let rise = segment.weight * z;
    let stiff = h + segment.ea;
    let both = 2.0 * segment.ea * rise;
    let change = both / ((stiff * stiff + both).sqrt() + stiff);
    (change * (change + 2.0 * h)).sqrt()
}
