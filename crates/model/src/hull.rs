//! What makes a body float: pieces of its parts, each a closed surface, or one linear stiffness.

use crate::UnmodelledEffect;
use nalgebra::{Matrix6, Vector3};
use windlass_base::geometry::{Place, Position};
use windlass_base::span::Span;
use windlass_base::values::Given;

/// The form of a piece, in the system of its part (m).
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Panels, each a polygon of three or more corners.
    Panels(Vec<Vec<Position>>),
    /// A box along the axes of the part, between two opposite corners; low is less than high in every direction.
    Block {
        /// The corner with the least coordinates.
        low: Position,
        /// The corner with the greatest.
        high: Position,
    },
    /// A round member with flat ends.
    Tube {
        /// Centres of its ends.
        ends: [Position; 2],
        /// Its outer diameter.
        diameter: f64,
    },
    /// A straight member with a rectangular outline.
    Bar {
        /// Centres of its ends.
        ends: [Position; 2],
        /// Its width and its depth, as vectors across its axis: axis, width and depth are right-handed.
        sides: [Position; 2],
    },
}

impl Shape {
    /// The middle of a tube or a bar (m) and the volume of its outline (m3); none of other forms.
    pub fn member_volume(&self) -> Option<(Position, f64)> {
        let (ends, area) = match self {
            Shape::Tube { ends, diameter } => (ends, std::f64::consts::FRAC_PI_4 * diameter * diameter),
            Shape::Bar { ends, sides } => {
                let [width, depth] = sides.map(|side| Vector3::from(side).norm());
                (ends, width * depth)
            }
            Shape::Panels(_) | Shape::Block { .. } => return None,
        };
        let [a, b] = ends.map(Vector3::from);
        Some((((a + b) * 0.5).into(), area * (b - a).norm()))
    }
}

/// A surface that water presses on, or a space within one that water fills.
///
/// Source: [MOSES-REF pieces].
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Its name as written.
    pub name: String,
    /// By how much of its volume the body's displacement grows: 1 of an exterior, -1 of an interior that is open to the sea, a
    /// fraction between.
    pub permeability: f64,
    /// Its form.
    pub shape: Shape,
    /// Shape coefficients of the wind force along the axes of the part; zeros where it takes none.
    pub cs_wind: [f64; 3],
    /// Shape coefficients of the current force along the axes of the part; zeros where it takes none.
    pub cs_current: [f64; 3],
    /// What water does to it by Morison's formula, of a tube or a bar.
    pub member: Option<Member>,
    /// Where it is of a structural element: that.
    pub element: Option<ElementOf>,
    /// Of a member, the load category that `&APPLY` multiplies its loads by; none of other pieces.
    pub category: Option<String>,
    /// What waves do to it.
    pub waves: WaveAction,
    /// Whether its panels are those of radiation and diffraction as they are.
    pub own_panels: bool,
    /// Factor of its eddy damping of roll; zero of none.
    pub eddy_damping: f64,
    /// Factor of the wave drift damping of its body; none where it gives none.
    pub drift_damping: Option<f64>,
    /// Options that do not act, as given.
    pub kept: Vec<Given>,
    /// Those of them whose effect no solver computes.
    pub unmodelled: Vec<UnmodelledEffect>,
    /// The interior compartment it belongs to; none of a piece of the hull.
    pub compartment: Option<String>,
    /// Where it was defined.
    pub span: Span,
}

/// Coefficients of a round member in Morison's formula, on its outer diameter D; all without a dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// Drag across the axis, Cd: 1/2 rho Cd D |u| u a length.
    pub drag: f64,
    /// Friction along the axis, on the skin: 1/2 rho Cdt pi D |u| u a length.
    pub friction: f64,
    /// Added mass across the axis, Ca = Cm - 1: rho Ca pi D^2/4 a length.
    pub added: f64,
    /// Added mass along the axis at the first and the second end: rho Caa pi D^3/12, of the half sphere on the end.
    pub end_added: [f64; 2],
    /// Of a bar, what counts instead of a diameter.
    pub breadths: Option<Breadths>,
}

/// A structural element, of `BEAM` or `PLATE`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ElementOf {
    /// Its name.
    pub name: String,
    /// The class of its section.
    pub class: String,
}

/// What water meets of a bar, along its width and along its depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Breadths {
    /// Breadth against a flow along each (m): 1/2 rho Cd b |u| u a length.
    pub drag: [f64; 2],
    /// Area whose water moves with it along each (m2): rho times it a length, whatever Ca is.
    pub added: [f64; 2],
}

/// What waves do to a piece.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WaveAction {
    /// What its form says: a tube is a member of Morison's formula, another piece feels nothing.
    #[default]
    ByForm,
    /// It is part of the hull of a hydrodynamic database, which holds all forces of waves on it but drag.
    Database,
    /// Pressure of the waves as they are without it, up to their surface (Froude and Krylov).
    Pressure,
    /// Nothing, and it is no part of a hull that is meshed.
    Nothing,
}

impl Shape {
    /// The least and the greatest coordinates it reaches in the part (m); `None` of no panels.
    pub fn extent(&self) -> Option<[Position; 2]> {
        let (points, more): (Vec<&Position>, Vector3<f64>) = match self {
            Shape::Panels(panels) => (panels.iter().flatten().collect(), Vector3::zeros()),
            Shape::Block { low, high } => (vec![low, high], Vector3::zeros()),
            Shape::Tube { ends: [a, b], diameter } => {
                let axis = (Vector3::from(*b) - Vector3::from(*a)).normalize();
                // how far a circle across the axis reaches in each direction
                (vec![a, b], axis.map(|c| 0.5 * diameter * (1.0 - c * c).max(0.0).sqrt()))
            }
            Shape::Bar { ends: [a, b], sides: [width, depth] } => {
                (vec![a, b], (Vector3::from(*width).abs() + Vector3::from(*depth).abs()) * 0.5)
            }
        };
        let first = Vector3::from(**points.first()?);
        let (low, high) = points.iter().fold((first, first), |(low, high), at| {
            let at = Vector3::from(**at);
            (low.inf(&at), high.sup(&at))
        });
        Some([(low - more).into(), (high + more).into()])
    }

    /// The same form moved within its part. A block that turns becomes panels.
    pub fn with_displacement(&self, by: &Place) -> Shape {
        match self {
            Shape::Panels(panels) => {
                Shape::Panels(panels.iter().map(|p| p.iter().map(|at| by.apply(*at)).collect()).collect())
            }
            Shape::Block { low, high } if by.turn == [0.0; 3] => {
                Shape::Block { low: by.apply(*low), high: by.apply(*high) }
            }
            Shape::Block { low, high } => Shape::Panels(box_panels(*low, *high)).with_displacement(by),
            Shape::Tube { ends, diameter } => Shape::Tube { ends: ends.map(|at| by.apply(at)), diameter: *diameter },
            Shape::Bar { ends, sides } => {
                Shape::Bar { ends: ends.map(|at| by.apply(at)), sides: sides.map(|side| by.rotate(side)) }
            }
        }
    }
}

/// The six faces of a bar, their corners counterclockwise from outside.
pub fn bar_panels(ends: &[Position; 2], sides: &[Position; 2]) -> Vec<Vec<Position>> {
    let ([foot, head], [width, depth]) = (ends.map(Vector3::from), sides.map(Vector3::from));
    let corner = |at: [f64; 3]| -> Position {
        let [along, across, up] = at;
        (foot + (head - foot) * along + width * (across - 0.5) + depth * (up - 0.5)).into()
    };
    box_panels([0.0; 3], [1.0; 3]).into_iter().map(|face| face.into_iter().map(corner).collect()).collect()
}

/// The six faces of a box, their corners counterclockwise from outside.
pub fn box_panels(low: Position, high: Position) -> Vec<Vec<Position>> {
    let ([x0, y0, z0], [x1, y1, z1]) = (low, high);
    vec![
        vec![[x0, y0, z0], [x0, y1, z0], [x1, y1, z0], [x1, y0, z0]],
        vec![[x0, y0, z1], [x1, y0, z1], [x1, y1, z1], [x0, y1, z1]],
        vec![[x0, y0, z0], [x1, y0, z0], [x1, y0, z1], [x0, y0, z1]],
        vec![[x0, y1, z0], [x0, y1, z1], [x1, y1, z1], [x1, y1, z0]],
        vec![[x0, y0, z0], [x0, y0, z1], [x0, y1, z1], [x0, y1, z0]],
        vec![[x1, y0, z0], [x1, y1, z0], [x1, y1, z1], [x1, y0, z1]],
    ]
}

/// Buoyancy by a constant stiffness about an upright equilibrium.
///
/// Source: [AQWA-REF deck 7] (LSTF, BFEQ, ZCGE): F = K (Xe - X) + B at the centre of gravity.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearHydrostatics {
    /// The point whose place and force are meant, in the body (m): as AQWA has it, the centre of gravity.
    pub at: Position,
    /// Height of that point in the global system when the body floats at rest, upright (m).
    pub height: f64,
    /// The buoyancy then, upward (N).
    pub buoyancy: f64,
    /// K, in axes that turn with the yaw of the body (N/m, N/rad, N m/m, N m/rad): x, y, z, roll, pitch, yaw.
    pub stiffness: Matrix6<f64>,
    /// Where it was given.
    pub span: Span,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hull_extent_is_restored_after_moving_back() {
        let block = Shape::Block { low: [0.0, -50.0, 0.0], high: [400.0, 50.0, 20.0] };
        let turned = block.with_displacement(&Place::new([0.0, 0.0, 0.0, 0.0, 0.0, std::f64::consts::FRAC_PI_2]));
        assert_eq!(turned.extent(), Some([[-50.0, 0.0, 0.0], [50.0, 400.0, 20.0]]));
        assert_eq!(
            block.with_displacement(&Place::new([5.0, 0.0, 0.0, 0.0, 0.0, 0.0])).extent().map(|e| e[0][0]),
            Some(5.0)
        );
        assert_eq!(Shape::Panels(Vec::new()).extent(), None);
    }

    #[test]
    fn faces_of_box_look_outward() {
        for panel in box_panels([0.0; 3], [2.0, 3.0, 4.0]) {
            let at = |i: usize| Vector3::from(panel[i]);
            let normal = (at(1) - at(0)).cross(&(at(2) - at(0)));
            let centre = (at(0) + at(2)) * 0.5 - Vector3::new(1.0, 1.5, 2.0);
            assert!(normal.dot(&centre) > 0.0, "{panel:?}");
        }
    }
}
