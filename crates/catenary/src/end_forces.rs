//! What one segment is asked and answers: the bottom under it, how it lies, the forces at its ends.

/// A flat bottom at the anchor's elevation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FlatBottom {
    /// Friction coefficient, zero or more.
    pub friction: f64,
}

/// How a segment lies between its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// Free from end to end.
    Suspended,
    /// Straight up and under tension from end to end.
    VerticalTaut,
    /// Part of it lies on the bottom under tension.
    Contact,
    /// The same; friction on the grounded part takes some of the tension.
    ContactFriction,
    /// The same; friction takes all of the tension before the anchor.
    ContactFrictionAnchorZero,
    /// It hangs straight down to the bottom and lies there without tension.
    FullySlack,
    /// All of it on the bottom, without tension.
    OnBottomSlack,
    /// All of it on the bottom, stretched.
    OnBottomTaut,
    /// Without weight and longer than the way between its ends: no force, and no definite shape.
    WeightlessSlack,
}

impl Regime {
    /// The name used in tables.
    pub fn name(self) -> &'static str {
        match self {
            Regime::Suspended => "suspended",
            Regime::VerticalTaut => "vertical_taut",
            Regime::Contact => "contact",
            Regime::ContactFriction => "contact_friction",
            Regime::ContactFrictionAnchorZero => "contact_friction_anchorzero",
            Regime::FullySlack => "fully_slack",
            Regime::OnBottomSlack => "on_bottom_slack",
            Regime::OnBottomTaut => "on_bottom_taut",
            Regime::WeightlessSlack => "weightless_slack",
        }
    }
}

/// The forces at the ends of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndForces {
    /// How it lies.
    pub regime: Regime,
    /// Where the fairlead is: beside and above the anchor (m).
    pub at: [f64; 2],
    /// Pull of the line on the fairlead (N): toward the anchor, and downward.
    pub fairlead: [f64; 2],
    /// Pull of the line on the anchor (N): toward the fairlead, and upward.
    pub anchor: [f64; 2],
    /// Unstretched length on the bottom (m).
    pub grounded: f64,
    /// d(fairlead H, V)/d(x, z) (N/m), row by row. At a change of regime, that of the regime named. Infinite in its last place
    /// for [`Regime::OnBottomTaut`] alone: there V grows as the root of z.
    pub stiffness: [[f64; 2]; 2],
    /// What is left of the distances, mapped through the stiffness to a force (N).
    pub residual: f64,
    /// Newton steps.
    pub iterations: usize,
}

impl EndForces {
    /// Of a line without weight that is longer than the way between its ends.
    pub(super) fn slack(at: [f64; 2]) -> Self {
        EndForces {
            regime: Regime::WeightlessSlack,
            at,
            fairlead: [0.0; 2],
            anchor: [0.0; 2],
            grounded: 0.0,
            stiffness: [[0.0; 2]; 2],
            residual: 0.0,
            iterations: 0,
        }
    }

    /// d(pull on the anchor)/d(place of the fairlead) (N/m), row by row, over a bottom with this friction.
    pub(super) fn coupling(&self, friction: f64) -> [[f64; 2]; 2] {
        let [horizontal, vertical] = self.stiffness;
        let none = [0.0; 2];
        match self.regime {
            // what hangs free pulls at both ends with the difference of its weight, which does not change
            Regime::Suspended | Regime::VerticalTaut => self.stiffness,
            Regime::Contact | Regime::OnBottomTaut => [horizontal, none],
            // what is lifted is no longer held by friction, and weighs on the fairlead
            Regime::ContactFriction => {
                let [[xx, xz], [zx, zz]] = [horizontal, vertical];
                [[xx + friction * zx, xz + friction * zz], none]
            }
            Regime::ContactFrictionAnchorZero
            | Regime::FullySlack
            | Regime::OnBottomSlack
            | Regime::WeightlessSlack => [none; 2],
        }
    }

    /// The same line upside down.
    pub(super) fn upside_down(self) -> Self {
        let EndForces { at: [x, z], fairlead, anchor, stiffness: [[a, b], [c, d]], .. } = self;
        EndForces {
            at: [x, -z],
            fairlead: [fairlead[0], -fairlead[1]],
            anchor: [anchor[0], -anchor[1]],
            stiffness: [[a, -b], [-c, d]],
            ..self
        }
    }
}
