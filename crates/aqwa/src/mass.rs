//! Mass, centre of gravity and inertia of a structure from its elements, as the listing prints them.

use super::Deck;
use super::elements::{ElementShape, StructureDeck, StructureElement};
use std::f64::consts::PI;

/// Mass of the elements of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KindMass {
    /// The kind.
    pub shape: ElementShape,
    /// Number of elements.
    pub count: usize,
    /// Their mass, in the units of the deck.
    pub mass: f64,
}

/// Mass properties of a structure, in the units and axes of the deck.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct MassProperties {
    /// By kind of element, those with mass.
    pub kinds: Vec<KindMass>,
    /// Mass.
    pub mass: f64,
    /// Centre of gravity.
    pub centre: [f64; 3],
    /// Matrix of inertia about the centre of gravity; products of inertia stand with a minus sign, as
    /// `I_xy = -sum m x y`, so that the matrix is the one of the equation of motion.
    pub inertia: [[f64; 3]; 3],
}

/// A piece of mass: mass, centre, inertia about its own centre.
struct MassPiece {
    shape: ElementShape,
    mass: f64,
    centre: [f64; 3],
    inertia: [[f64; 3]; 3],
}

impl Deck {
    /// The mass properties of a structure; elements whose nodes or groups are missing are left out.
    pub fn mass_properties(&self, structure: &StructureDeck) -> MassProperties {
        let pieces: Vec<MassPiece> = structure.elements.iter().filter_map(|element| self.piece(element)).collect();
        let mut found = MassProperties::default();
        for shape in [ElementShape::Tube, ElementShape::PointMass] {
            let of: Vec<&MassPiece> = pieces.iter().filter(|piece| piece.shape == shape).collect();
            if !of.is_empty() {
                let mass = of.iter().map(|piece| piece.mass).sum();
                found.kinds.push(KindMass { shape, count: of.len(), mass });
            }
        }
        found.mass = pieces.iter().fold(0.0, |sum, piece| sum + piece.mass);
        if found.mass > 0.0 {
            found.centre = std::array::from_fn(|i| {
                pieces.iter().map(|piece| piece.mass * piece.centre[i]).sum::<f64>() / found.mass
            });
        }
        for piece in &pieces {
            let arm: [f64; 3] = std::array::from_fn(|i| piece.centre[i] - found.centre[i]);
            let square: f64 = arm.iter().map(|x| x * x).sum();
            for i in 0..3 {
                for j in 0..3 {
                    let unit = if i == j { square } else { 0.0 };
                    found.inertia[i][j] += piece.inertia[i][j] + piece.mass * (unit - arm[i] * arm[j]);
                }
            }
        }
        found
    }

    fn piece(&self, element: &StructureElement) -> Option<MassPiece> {
        let at = |index: usize| self.nodes.get(element.nodes.get(index)?).map(|node| node.position);
        let geometry = self.geometry(element.shape, element.geometry)?;
        let parameters = geometry.parameters.map(|field| field.value);
        let first = self.materials.get(&element.material)?.properties[0].value;
        match element.shape {
            ElementShape::PointMass => {
                let [xx, xy, xz, yy, yz, zz] = parameters;
                let inertia = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
                Some(MassPiece { shape: element.shape, mass: first, centre: at(0)?, inertia })
            }
            ElementShape::Tube => {
                let (from, to) = (at(0)?, at(1)?);
                let along: [f64; 3] = std::array::from_fn(|i| to[i] - from[i]);
                let square: f64 = along.iter().map(|x| x * x).sum();
                let length = square.sqrt();
                let [diameter, wall, ..] = parameters;
                let inner = diameter - 2.0 * wall;
                let mass = first * PI / 4.0 * (diameter * diameter - inner * inner) * length;
                // a tube about its middle: m (D^2 + d^2) / 8 along, half of it and m L^2 / 12 across
                let round = mass * (diameter * diameter + inner * inner) / 8.0;
                let across = round / 2.0 + mass * square / 12.0;
                let inertia = std::array::from_fn(|i| {
                    std::array::from_fn(|j| {
                        let unit = if i == j { across } else { 0.0 };
                        let axis = if square > 0.0 { along[i] * along[j] / square } else { 0.0 };
                        unit + (round - across) * axis
                    })
                });
                let centre = std::array::from_fn(|i| (from[i] + to[i]) / 2.0);
                Some(MassPiece { shape: element.shape, mass, centre, inertia })
            }
            _ => None,
        }
    }
}
