//! What a connector of class TETHER is: sections of tube, and how their two ends are held.
//!
//! Source: [AQWA-CONN 5.8.3.3] (sections); [AQWA-TETHER Appendix A] (what deck 14 says of a tether).

/// A section of a tether: elements of one tube, from the fairlead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TetherSection {
    /// Outer diameter (m).
    pub outer_diameter: f64,
    /// Wall thickness (m).
    pub wall_thickness: f64,
    /// Unstretched length (m).
    pub length: f64,
    /// Number of elements it is cut into.
    pub elements: usize,
    /// Density of the material (kg/m3).
    pub density: f64,
    /// Young's modulus (Pa).
    pub youngs_modulus: f64,
    /// Transverse added mass coefficient.
    pub added_mass: f64,
    /// Transverse drag coefficient.
    pub drag: f64,
    /// What the user calls its nodes (that at the anchor's side first), its material and its geometry; for tables alone.
    pub label: Option<[i64; 4]>,
}

/// Which of the two tethers of [AQWA-TETHER 2] it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum TetherUse {
    /// Between a structure and its anchor, under tension.
    #[default]
    Installed,
    /// Afloat along the surface behind a vessel.
    Towed,
}

/// How a node of an installed tether is held beside the springs of its ends (cards TLAC, TROC, TLAV, TROV).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TetherHold {
    /// It stays where it is sideways when the tether is vertical over its anchor.
    LateralFixed,
    /// It stays vertical.
    RotationalFixed,
    /// It passes through an opening of the structure.
    LateralVessel {
        /// What it can move from the middle of the opening to any side (m).
        gap: f64,
    },
    /// It turns with the structure.
    RotationalVessel,
}

/// A constraint: which node, counted from 1 at the anchor, and how it is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TetherConstraint {
    /// The node.
    pub node: usize,
    /// How.
    pub hold: TetherHold,
}

/// How the ends of a tether are held and what is in it. The first of two values is that of the fairlead, at the vessel; the
/// second that of the anchor or the trailing end.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct TetherEnds {
    /// Installed or towed.
    pub used: TetherUse,
    /// Stiffness of the springs at each end where given: installed, along the tether (N/m) and two rotational (N m/rad); towed, along
    /// X, Y and Z of the tether (N/m).
    pub springs: [Option<[f64; 3]>; 2],
    /// Areas of the end caps that no water presses on (m2).
    pub caps: [f64; 2],
    /// Pressure at sea level (Pa) and density (kg/m3) of the fluid inside.
    pub fluid: [f64; 2],
    /// Axial stress of an impact at unit velocity (Pa s/m), and the time after which half of it is left (s).
    pub impact: Option<[f64; 2]>,
    /// Distance of the lower stop below the anchor (m); 0: it never hangs free.
    pub low_stop: Option<f64>,
    /// Constraints.
    pub constraints: Vec<TetherConstraint>,
    /// Identical tethers side by side: what they do to the structure counts so many times; 0 as 1.
    pub group: usize,
    /// Place of the node at the vessel as a deck gives it, for the description (m).
    pub given: Option<[f64; 3]>,
}

impl TetherEnds {
    /// Stiffness of a spring that is not given [AQWA-TETHER A.2 and 8.1.14], in N/m or N m/rad where the card's unit is a thousand.
    pub const DEFAULT_SPRING_STIFFNESS: f64 = 1.0e18;

    /// How many tethers it stands for (a number, one or more).
    pub fn count(&self) -> f64 {
        self.group.max(1) as f64
    }

    /// Springs in force at the fairlead and at the far end: inline (N/m), two rotational (N m/rad). Installed:
    /// [`TetherEnds::DEFAULT_SPRING_STIFFNESS`] all where none are given and along the tether
    /// where not above zero; rotational ones below zero are none. Towed: STIFF where zero or not given.
    pub fn springs_in_force(&self) -> [[f64; 3]; 2] {
        self.springs.map(|given| {
            let Some([first, second, third]) = given else { return [Self::DEFAULT_SPRING_STIFFNESS; 3] };
            match self.used {
                TetherUse::Towed => {
                    [first, second, third].map(|k| if k == 0.0 { Self::DEFAULT_SPRING_STIFFNESS } else { k })
                }
                TetherUse::Installed => {
                    let inline = if first > 0.0 { first } else { Self::DEFAULT_SPRING_STIFFNESS };
                    [inline, second.max(0.0), third.max(0.0)]
                }
            }
        })
    }
}
