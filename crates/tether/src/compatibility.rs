//! Peculiarities of another program, each with a name.
//!
//! Where the listings of [AQWA-TETHER 8] come from something that is no part of the theory, it is a switch here: on when a deck is to give the
//! numbers of that program ([`Compatibility::aqwa_5_4`]), off natively. What each makes is reported of the installed example of [AQWA-TETHER 8.2],
//! with that switch alone off (crates/tether/tests/it/aqwa_tether_installed.rs holds them there).

/// How a structure with tethers goes from its two accelerations to the end of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VesselScheme {
    /// `x' = x + v h + (2 a1 + a2) h^2/6`: the acceleration is straight over the step. The listing of [AQWA-TETHER 8.2] has it, and it is the better.
    #[default]
    StraightAcceleration,
    /// `x' = x + (v + v') h/2`, as [AQWA-TETHER 3.6] has it. It damps: the heave of the example is 11 mm off at 5 s.
    MeanVelocity,
}

/// Where the rotational springs at the ends of installed tethers are at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpringReference {
    /// Where the tether is vertical, and upright in the structure. The listing of [AQWA-TETHER 8.2] has it.
    #[default]
    Vertical,
    /// Along the axis that the tether has at the start of the run, as one may read [AQWA-TETHER 7.1]: the moment at the top of the
    /// first tether at 6.5 s is then -391 kN m and not -1365 (printed: -1356), the surge up to 0.23 m another.
    InitialAxis,
}

/// What is done as another program does it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Compatibility {
    /// On a tube that the surface cuts, water is asked for along the wet part, but taken as if the fit ran over the whole element: at a
    /// share x of the element the fit gives its value at x, and not at x over the wet share. Off: the drag in surge at the start is
    /// 47,006 kN and not 39,478 (printed: 39,472), the surge up to 0.70 m another, and the impact is at 7.25 s and not at 7.5.
    pub whole_element_kinematics: bool,
    /// Friction along a tube, and Munk's moment, go by the flow along the tube at its first node, and not by the mean. Off: the moment of
    /// drag in pitch at the start is 396,245 kN m and not 349,991 (printed: 349,750); 4 mm of surge.
    pub friction_at_first_node: bool,
    /// Shear, moments, tensions and stresses of installed tethers are those of the second stage of the step that starts at the time they
    /// are given for: of the place predicted for the end of that step. Off: the wall tension at the top of the third tether at 6.5 s is
    /// 12,138 kN and not 10,791 (printed: 10,780); motions stay.
    pub second_stage_tables: bool,
    /// The structure feels the tension along the tangent of a tether's top and nothing else. Off: it also feels the moment of the coil there
    /// and, across the tether, all that the balance of the top asks for: shear, and the top's share of the water's force and of the
    /// tether's inertia. The surge is up to 0.40 m another, the heave 0.09 m.
    pub tension_alone_on_structure: bool,
    /// The velocity of an impact is the closing velocity along the tether over the cosine of its slope: what would be vertical of it. Off:
    /// 0.2450 m/s and not 0.2518 (printed stress over factor: 0.2519).
    pub vertical_impact: bool,
    /// The stiffness that tension gives a tether in bending is that of the tension in its middle all along. Off: each element has its own;
    /// the shape of the third mode is 0.0131 and 0.0135 at the inner nodes and not 0.0133 at both (printed: 0.0134).
    pub uniform_tension: bool,
    /// How the structure goes through a step.
    pub vessel_scheme: VesselScheme,
    /// Where end springs are at rest.
    pub springs: SpringReference,
}

impl Compatibility {
    /// Nothing but the theory.
    pub const fn native() -> Self {
        Compatibility {
            whole_element_kinematics: false,
            friction_at_first_node: false,
            second_stage_tables: false,
            tension_alone_on_structure: false,
            vertical_impact: false,
            uniform_tension: false,
            vessel_scheme: VesselScheme::StraightAcceleration,
            springs: SpringReference::Vertical,
        }
    }

    /// AQWA 5.4, whose listings are in [AQWA-TETHER 8].
    pub const fn aqwa_5_4() -> Self {
        Compatibility {
            whole_element_kinematics: true,
            friction_at_first_node: true,
            second_stage_tables: true,
            tension_alone_on_structure: true,
            vertical_impact: true,
            uniform_tension: true,
            vessel_scheme: VesselScheme::StraightAcceleration,
            springs: SpringReference::Vertical,
        }
    }
}

impl Default for Compatibility {
    fn default() -> Self {
        Compatibility::native()
    }
}
