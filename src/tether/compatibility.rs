//! Peculiarities of another program, each with a name.
//!
//! Where the listings of seed 003 come from something that is no part of the theory, it is a switch here: on when a deck is to give the
//! numbers of that program ([`Compatibility::aqwa_5_4`]), off natively. The differences told are those of the seed's examples.

/// What is done as another program does it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Compatibility {
    /// On a tube that the surface cuts, water is asked for along the wet part, but taken as if the fit ran over the whole element: at a
    /// share x of the element the fit gives its value at x, and not at x over the wet share.
    pub whole_element_kinematics: bool,
    /// Friction along a tube, and Munk's moment, go by the flow along the tube at its first node, and not by the mean.
    pub friction_at_first_node: bool,
    /// Shear, moments, tensions and stresses of installed tethers are those of the second stage of the step that starts at the time they
    /// are given for: of the place predicted for the end of that step.
    pub second_stage_tables: bool,
    /// The structure feels the tension along the tangent of a tether's top, and not the moment of the coil there.
    pub tension_alone_on_structure: bool,
    /// The velocity of an impact is the closing velocity along the tether over the cosine of its slope: what would be vertical of it.
    pub vertical_impact: bool,
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
        }
    }

    /// AQWA 5.4, whose listings seed 003 holds.
    pub const fn aqwa_5_4() -> Self {
        Compatibility {
            whole_element_kinematics: true,
            friction_at_first_node: true,
            second_stage_tables: true,
            tension_alone_on_structure: true,
            vertical_impact: true,
        }
    }
}

impl Default for Compatibility {
    fn default() -> Self {
        Compatibility::native()
    }
}
