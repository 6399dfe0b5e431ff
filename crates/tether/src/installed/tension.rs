//! Tension of an installed tether, static along its length: effective and wall tension, slack, free hanging, lower stop.
//!
//! With s from the anchor, w the weight in water per length with what is inside, p and q the pressure outside and inside, A and a the areas
//! they act on, the effective tension `T = N + p A - q a` of the wall's N [SPARKS-1984]
//! grows by w times the cosine of the axis. The wall's stretch over the whole is that of the ends:
//! `int N/EA ds + R/k at both ends = L - L0`, of which T at the anchor follows. Of a uniform tether it is
//! `T = EA/L0 (L - L0) + rho g (h_top + h_bot)/2 A` in the middle [W-INSTALLED 4]. A cap that water does not press on
//! takes `p A_cap` from what the end bears: `R = T - p A_cap`.
//!
//! A tether is slack when the anchor would have to push. It then hangs from the structure with nothing at its lower end; where that falls on
//! the lower stop, it is pushed up by its axial stiffness. With a stop at the anchor itself it never hangs free.

use super::axis::TetherAxis;
use super::tether::InstalledTether;
use crate::structure::flow::FlowAt;

/// How a tether stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TensionCase {
    /// In tension.
    #[default]
    Taut,
    /// Hanging from the structure.
    Slack,
    /// Slack, its lower end on the lower stop.
    OnStop,
}

/// One element with what its tension needs.
#[derive(Clone, Copy, Debug)]
struct ElementSpan {
    /// Share of the length at its lower end, its middle and its upper end.
    shares: [f64; 3],
    /// Axial flexibility (m/N).
    flexibility: f64,
    /// Areas outside and inside (m2).
    areas: [f64; 2],
    /// Weight in water with what is inside, of what is below its middle and below its upper end (N).
    below: [f64; 2],
}

/// What the tension of a tether goes by.
#[derive(Clone, Debug)]
pub struct TensionModel {
    spans: Vec<ElementSpan>,
    /// Unstretched length (m).
    length: f64,
    flexibility: f64,
    /// Flexibility of the end springs (m/N).
    ends: [f64; 2],
    caps: [f64; 2],
    /// Pressure at the mean level (Pa) and weight density (N/m3) of what is inside.
    inside: [f64; 2],
    stop: Option<f64>,
    /// Whether the tension in the middle holds all along for bending.
    uniform: bool,
    /// Weight in water with what is inside (N).
    weight: f64,
}

/// The tension at one moment.
#[derive(Clone, Copy, Debug, Default)]
pub struct TetherTension {
    /// How it stands.
    pub standing: TensionCase,
    /// Effective tension at the lower end (N).
    pub bottom: f64,
    /// Cosine of the axis and the vertical.
    pub cosine: f64,
    /// Length that its elements have together (m).
    pub length: f64,
    /// Height of the lower end and of the attachment (m, global).
    pub heights: [f64; 2],
    /// How far the lower end hangs below the anchor along the axis (m); zero when taut.
    pub drop: f64,
    /// The pull at the structure (N): effective tension less what a cap there is not pressed with.
    pub pull: f64,
}

impl TensionModel {
    /// That of a tether in water of a density (kg/m3) under a gravity (m/s2); `uniform`: what bends it is the tension in its middle all along.
    pub fn new(tether: &InstalledTether, [density, gravity]: [f64; 2], uniform: bool) -> Self {
        let line = &tether.line;
        let (mut below, mut start) = (0.0, 0.0);
        let length = line.length();
        let spans: Vec<ElementSpan> = line
            .elements()
            .iter()
            .map(|e| {
                let tube = e.tube();
                let inside = tube.internal_area() * tether.fluid.density;
                let weight = (e.mass_per_length() + inside - density * tube.external_area()) * gravity * e.length;
                let span = ElementSpan {
                    shares: [start, start + 0.5 * e.length, start + e.length].map(|s| s / length),
                    flexibility: e.length / e.axial_stiffness(),
                    areas: [tube.external_area(), tube.internal_area()],
                    below: [below + 0.5 * weight, below + weight],
                };
                below += weight;
                start += e.length;
                span
            })
            .collect();
        let ends = [tether.anchor_springs.inline, tether.vessel_springs.inline].map(f64::recip);
        TensionModel {
            flexibility: spans.iter().map(|s| s.flexibility).sum::<f64>() + ends[0] + ends[1],
            spans,
            length,
            ends,
            caps: tether.caps,
            inside: [tether.fluid.pressure, tether.fluid.density * gravity],
            stop: tether.lower_stop,
            uniform,
            weight: below,
        }
    }

    /// Axial stiffness of the whole with its end springs (N/m).
    pub fn stiffness(&self) -> f64 {
        1.0 / self.flexibility
    }

    /// Weight in water with what is inside (N).
    pub fn weight(&self) -> f64 {
        self.weight
    }

    /// Pressure outside and inside at a height (m, global).
    pub fn pressures(&self, z: f64, water: &FlowAt) -> [f64; 2] {
        [water.hydrostatic(z), self.inside[0] + self.inside[1] * (water.flow().level - z)]
    }

    /// The tension of an axis whose tether is longer than the chord by an arc (m), attached at a height (m, global).
    pub fn tension(&self, axis: &TetherAxis, top: f64, arc: f64, water: &FlowAt) -> TetherTension {
        let cosine = axis.along.z;
        let mut made = TetherTension { cosine, length: axis.chord, ..TetherTension::default() };
        made.heights = [top - axis.chord * cosine, top];
        let loads = self.extension_by_weight_and_pressure(&made, water);
        let pressed = self.caps[0] * water.hydrostatic(made.heights[0]);
        let taut = (axis.chord + arc - self.length - loads) / self.flexibility;
        made.bottom = taut;
        if taut < pressed {
            // what the lower end would fall until nothing pushes it
            made.drop = (pressed - taut) * self.flexibility;
            made.standing = TensionCase::Slack;
            made.bottom = pressed;
            if let Some(stop) = self.stop.filter(|stop| made.drop > *stop) {
                made.bottom = taut + stop / self.flexibility;
                made.drop = stop;
                made.standing = if stop > 0.0 { TensionCase::OnStop } else { TensionCase::Taut };
            }
            if made.standing != TensionCase::Taut {
                made.length = self.length;
                made.heights[0] = top - self.length * cosine;
            }
        }
        made.pull = made.bottom + self.weight * cosine - self.caps[1] * water.hydrostatic(top);
        made
    }

    /// How much longer the tether is by weight and pressure than by its tension at the lower end (m).
    fn extension_by_weight_and_pressure(&self, at: &TetherTension, water: &FlowAt) -> f64 {
        let height = |share: f64| at.heights[0] + (at.heights[1] - at.heights[0]) * share;
        let mut sum = 0.0;
        for span in &self.spans {
            let [p, q] = self.pressures(height(span.shares[1]), water);
            let wall = span.below[0] * at.cosine - p * span.areas[0] + q * span.areas[1];
            sum += wall * span.flexibility;
        }
        let [bottom, top] = at.heights.map(|z| water.hydrostatic(z));
        sum - bottom * self.caps[0] * self.ends[0] + (self.weight * at.cosine - top * self.caps[1]) * self.ends[1]
    }

    /// Effective tension that bends an element: that in its middle, or in the middle of a taut tether (N).
    pub fn middle(&self, element: usize, at: &TetherTension) -> f64 {
        if self.uniform && at.standing == TensionCase::Taut {
            return at.bottom + 0.5 * self.weight * at.cosine;
        }
        at.bottom + self.spans[element].below[0] * at.cosine
    }

    /// At the ends of an element, lower and upper: effective tension, wall tension (N), pressure outside and inside (Pa).
    pub fn ends(&self, element: usize, at: &TetherTension, water: &FlowAt) -> [[f64; 4]; 2] {
        let span = &self.spans[element];
        let [low, _, high] = span.shares;
        let under = 2.0 * span.below[0] - span.below[1];
        [(low, under), (high, span.below[1])].map(|(share, below)| {
            let z = at.heights[0] + (at.heights[1] - at.heights[0]) * share;
            let [p, q] = self.pressures(z, water);
            let effective = at.bottom + below * at.cosine;
            [effective, effective - p * span.areas[0] + q * span.areas[1], p, q]
        })
    }
}
