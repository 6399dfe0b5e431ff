//! An installed tether as it is given.

use crate::TetherLine;
use nalgebra::Vector3;
use windlass_base::units::Dim;
use windlass_model::ClassError;

/// The stiffness along the tether of an end that does not give way (N/m): 1E15 kN/m [AQWA-TETHER A.2].
pub const RIGID_INLINE_STIFFNESS: f64 = 1e18;
/// The stiffness of an end that does not turn (N m/rad): a thousandth of [AQWA-TETHER A.2], which leaves the moments of the end three digits more.
pub const RIGID_STIFFNESS: f64 = 1e15;
/// Constraints of a tether at most [AQWA-TETHER A.14].
pub const MAX_CONSTRAINTS: usize = 5;
/// Strain from which on a tether is taken for too short for its span: steel yields at a tenth of it.
const MAX_STRAIN: f64 = 0.02;

/// Springs at an end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndSprings {
    /// Along the tether (N/m).
    pub inline: f64,
    /// Against rotation about X and about Y (N m/rad).
    pub rotation: [f64; 2],
}

impl Default for EndSprings {
    /// Rigid, as of a card that is missing.
    fn default() -> Self {
        EndSprings { inline: RIGID_INLINE_STIFFNESS, rotation: [RIGID_STIFFNESS; 2] }
    }
}

/// A value of an end spring that was not taken as it was given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DefaultTaken {
    /// No values were given: [`RIGID_INLINE_STIFFNESS`] and [`RIGID_STIFFNESS`].
    Missing,
    /// The inline stiffness was blank, zero or negative: it is [`RIGID_INLINE_STIFFNESS`].
    Inline,
    /// The rotational stiffness about X (0) or Y (1) was negative: it is zero.
    Rotation(usize),
}

impl DefaultTaken {
    /// What to report of it.
    pub const fn text(self) -> &'static str {
        match self {
            DefaultTaken::Missing => "no end springs are given: all are rigid",
            DefaultTaken::Inline => "the inline spring is blank, zero or negative: it is rigid (1E15 kN/m)",
            DefaultTaken::Rotation(0) => "the rotational spring about X is negative: it is zero",
            DefaultTaken::Rotation(_) => "the rotational spring about Y is negative: it is zero",
        }
    }
}

impl EndSprings {
    /// The springs of a card [AQWA-TETHER A.2], the inline one and those against rotation about X and Y, and what was not taken as given.
    /// `None` is a card that is missing; blanks are zero.
    pub fn from_card(given: Option<[f64; 3]>) -> (Self, Vec<DefaultTaken>) {
        let Some([inline, x, y]) = given else { return (EndSprings::default(), vec![DefaultTaken::Missing]) };
        let mut taken = Vec::new();
        // a value that is no number is left to the checks of the tether
        let inline = if inline <= 0.0 {
            taken.push(DefaultTaken::Inline);
            RIGID_INLINE_STIFFNESS
        } else {
            inline
        };
        let mut rotation = [x, y];
        for (index, value) in rotation.iter_mut().enumerate() {
            if *value < 0.0 {
                taken.push(DefaultTaken::Rotation(index));
                *value = 0.0;
            }
        }
        (EndSprings { inline, rotation }, taken)
    }
}

/// What holds a node beside the ends [AQWA-TETHER A.14]. Nodes count from 0 at the anchor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NodeConstraint {
    /// A node stays at the place across the axis that it has when the tether is vertical over its anchor (TLAC).
    FixedLateral {
        /// The node.
        node: usize,
    },
    /// A node stays vertical (TROC).
    FixedRotation {
        /// The node.
        node: usize,
    },
    /// A node passes through an opening of the structure that is below the attachment as far as the node is along the tether (TLAV).
    VesselLateral {
        /// The node.
        node: usize,
        /// What it can move from the middle of the opening to any side (m).
        gap: f64,
    },
    /// A node turns with the structure (TROV).
    VesselRotation {
        /// The node.
        node: usize,
    },
}

impl NodeConstraint {
    /// Its node.
    pub const fn node(self) -> usize {
        match self {
            NodeConstraint::FixedLateral { node }
            | NodeConstraint::FixedRotation { node }
            | NodeConstraint::VesselLateral { node, .. }
            | NodeConstraint::VesselRotation { node } => node,
        }
    }
}

/// What a tether has inside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InternalFluid {
    /// Pressure at the mean sea level (Pa).
    pub pressure: f64,
    /// Density (kg/m3).
    pub density: f64,
}

/// Stress of an impact: factor times velocity, decaying by half in each half life [AQWA-TETHER 3.8].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    /// Stress over velocity of impact (Pa s/m).
    pub factor: f64,
    /// Half life (s).
    pub half_life: f64,
}

impl Impact {
    /// What is left of a stress (Pa) a time (s) later.
    pub fn stress_after(&self, stress: f64, after: f64) -> f64 {
        stress * (-std::f64::consts::LN_2 * after / self.half_life).exp()
    }
}

/// A tether, or a group of equal ones, between an anchor and a structure.
#[derive(Clone, Debug, PartialEq)]
pub struct InstalledTether {
    /// What the user calls it.
    pub name: String,
    /// Its elements from the anchor.
    pub line: TetherLine,
    /// The anchor (m, global).
    pub anchor: Vector3<f64>,
    /// Where it is attached, from the centre of gravity of the structure, in its axes (m).
    pub attachment: Vector3<f64>,
    /// Springs at the anchor.
    pub anchor_springs: EndSprings,
    /// Springs at the structure.
    pub vessel_springs: EndSprings,
    /// Areas at the anchor and at the structure that the water does not press on (m2).
    pub caps: [f64; 2],
    /// What is inside.
    pub fluid: InternalFluid,
    /// Stress of impact.
    pub impact: Option<Impact>,
    /// How far the lower end can fall below the anchor before it meets a stop (m); `None`: any distance. Zero: it is never free.
    pub lower_stop: Option<f64>,
    /// How many tethers it stands for in the force on the structure.
    pub group: f64,
    /// What holds it between its ends.
    pub constraints: Vec<NodeConstraint>,
}

impl InstalledTether {
    /// A tether between its anchor and its attachment (m, global) with rigid ends, without caps, fluid, impact, stop and constraints.
    pub fn new(name: impl Into<String>, line: TetherLine, anchor: Vector3<f64>, attachment: Vector3<f64>) -> Self {
        InstalledTether {
            name: name.into(),
            line,
            anchor,
            attachment,
            anchor_springs: EndSprings::default(),
            vessel_springs: EndSprings::default(),
            caps: [0.0; 2],
            fluid: InternalFluid::default(),
            impact: None,
            lower_stop: None,
            group: 1.0,
            constraints: Vec::new(),
        }
    }

    /// Sees that it can be reckoned with.
    ///
    /// # Errors
    /// A value that is not finite or has the wrong sign; too many constraints, or one of a node that is not there or is an end held already.
    pub fn check(&self) -> Result<(), ClassError> {
        let refuse = |what: &str| Err(ClassError::new(format!("tether {}: {what}", self.name)));
        if !self.anchor.iter().chain(self.attachment.iter()).all(|x| x.is_finite()) {
            return refuse("the anchor or the attachment has a coordinate that is no finite number");
        }
        let springs = [self.anchor_springs, self.vessel_springs];
        if !springs.iter().all(|s| s.inline > 0.0 && s.rotation.iter().all(|k| *k >= 0.0 && k.is_finite())) {
            return refuse("an inline spring must be stiffer than zero, a rotational one not less than zero");
        }
        if !self.caps.iter().all(|a| a.is_finite() && *a >= 0.0) {
            return refuse("the area of an end cap must be zero or more");
        }
        if !(self.fluid.pressure.is_finite() && self.fluid.density.is_finite() && self.fluid.density >= 0.0) {
            return refuse("pressure and density of the internal fluid must be finite, the density not negative");
        }
        if self.impact.is_some_and(|i| !(i.factor.is_finite() && i.factor >= 0.0 && i.half_life > 0.0)) {
            return refuse("the impact factor must be zero or more, and its half life above zero");
        }
        if self.lower_stop.is_some_and(|d| !(d.is_finite() && d >= 0.0)) {
            return refuse("the lower stop must be at the anchor or below: a distance of zero or more");
        }
        if !(self.group.is_finite() && self.group >= 0.0) {
            return refuse("the group factor must be zero or more");
        }
        if self.constraints.len() > MAX_CONSTRAINTS {
            return refuse("a tether has up to five constraints");
        }
        for constraint in &self.constraints {
            let (node, last) = (constraint.node(), self.line.nodes() - 1);
            let lateral =
                matches!(constraint, NodeConstraint::FixedLateral { .. } | NodeConstraint::VesselLateral { .. });
            if node > last {
                return refuse(&format!("a constraint is on node {}, and the last is {}", node + 1, last + 1));
            }
            if lateral && (node == 0 || node == last) {
                return refuse("a lateral constraint is on an end, which is held already");
            }
            if let NodeConstraint::VesselLateral { gap, .. } = constraint
                && !(gap.is_finite() && *gap >= 0.0)
            {
                return refuse("the gap of a lateral constraint must be zero or more");
            }
        }
        Ok(())
    }

    /// Sees that it is no shorter than its span (m) allows.
    ///
    /// # Errors
    /// A span of nothing, or one that strains it by more than two hundredths.
    pub fn spans(&self, span: f64) -> Result<(), ClassError> {
        let length = self.line.length();
        if !(span > 0.0 && span.is_finite()) {
            return Err(ClassError::new(format!("tether {}: anchor and attachment are at one place", self.name)));
        }
        if span > length * (1.0 + MAX_STRAIN) {
            let text = format!("tether {} is {{}} long, shorter than its span of {{}}", self.name);
            return Err(ClassError::with_values(text, &[(length, Dim::Length), (span, Dim::Length)])
                .help("give longer elements, or see the anchor, the attachment and the place of the structure"));
        }
        Ok(())
    }
}
