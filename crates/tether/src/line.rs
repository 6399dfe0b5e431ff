//! The elements of a tether one after the other, from the trailing or anchor end to the vessel.

use super::section::TetherTube;
use windlass_base::units::Dim;
use windlass_model::ClassError;

/// More elements than this are refused: work and memory go with them.
pub const MAX_ELEMENTS: usize = 10_000;

/// One element: a piece of tube between two nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TetherElement {
    /// Length (m).
    pub length: f64,
    /// Outer diameter (m).
    pub outer_diameter: f64,
    /// Wall thickness (m).
    pub wall_thickness: f64,
    /// Density of the wall (kg/m3).
    pub density: f64,
    /// Young's modulus (N/m2).
    pub youngs_modulus: f64,
    /// Drag coefficient across the axis, on the diameter.
    pub drag: f64,
    /// Added mass coefficient across the axis, on the displaced mass.
    pub added_mass: f64,
    /// What the user calls its nodes and groups; plays no part in the mechanics.
    pub label: ElementLabel,
}

/// Numbers of an element as the user gave them (card TELM).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ElementLabel {
    /// Node at the trailing or anchor side, and at the vessel's side.
    pub nodes: [i64; 2],
    /// Material group.
    pub material: i64,
    /// Geometric group.
    pub geometry: i64,
}

impl TetherElement {
    /// Its cross section.
    pub fn tube(&self) -> TetherTube {
        TetherTube { outer_diameter: self.outer_diameter, wall_thickness: self.wall_thickness }
    }

    /// Mass of the wall per length (kg/m).
    pub fn mass_per_length(&self) -> f64 {
        self.density * self.tube().area()
    }

    /// Bending stiffness EI (N m2).
    pub fn bending_stiffness(&self) -> f64 {
        self.youngs_modulus * self.tube().second_moment()
    }

    /// Axial stiffness EA (N).
    pub fn axial_stiffness(&self) -> f64 {
        self.youngs_modulus * self.tube().area()
    }
}

/// Elements that follow each other without a gap, each of which can be reckoned with.
#[derive(Clone, Debug, PartialEq)]
pub struct TetherLine {
    elements: Vec<TetherElement>,
    /// Distances of the nodes from the first, unstretched (m).
    distances: Vec<f64>,
}

impl TetherLine {
    /// A line of elements, first the one at the trailing or anchor end. Each begins at the node where the one before ends.
    ///
    /// # Errors
    /// No element or too many; elements that are not contiguous; a length, diameter, thickness, density or modulus that is not
    /// positive; a thickness above the radius; a negative coefficient. The error names the element by its number from 1.
    pub fn new(elements: Vec<TetherElement>) -> Result<Self, ClassError> {
        if elements.is_empty() {
            return Err(ClassError::new("a tether needs at least one element"));
        }
        if elements.len() > MAX_ELEMENTS {
            let message = format!("a tether of {} elements is more than the {MAX_ELEMENTS} allowed", elements.len());
            return Err(ClassError::new(message));
        }
        for (index, element) in elements.iter().enumerate() {
            sound(index + 1, element)?;
        }
        for (index, pair) in elements.windows(2).enumerate() {
            let (ends, begins) = (pair[0].label.nodes[1], pair[1].label.nodes[0]);
            if ends != begins {
                let message = format!(
                    "elements {} and {} of the tether are not contiguous: one ends at node {ends}, the next begins at node {begins}",
                    index + 1,
                    index + 2
                );
                let help = "give the elements in order from the trailing or anchor end; node 1 of each is node 2 of the one before";
                return Err(ClassError::new(message).help(help));
            }
        }
        let mut distances = vec![0.0];
        let mut along = 0.0;
        for element in &elements {
            along += element.length;
            distances.push(along);
        }
        Ok(TetherLine { elements, distances })
    }

    /// The same with the nodes called 1, 2, 3 ... from the trailing or anchor end.
    ///
    /// # Errors
    /// Those of [`TetherLine::new`].
    pub fn with_numbered_nodes(mut elements: Vec<TetherElement>) -> Result<Self, ClassError> {
        for (element, number) in elements.iter_mut().zip(1..) {
            element.label.nodes = [number, number + 1];
        }
        TetherLine::new(elements)
    }

    /// The elements from the trailing or anchor end.
    pub fn elements(&self) -> &[TetherElement] {
        &self.elements
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.distances.len()
    }

    /// Distances of the nodes from the first, unstretched (m).
    pub fn distances(&self) -> &[f64] {
        &self.distances
    }

    /// Length unstretched (m).
    pub fn length(&self) -> f64 {
        self.distances.last().copied().unwrap_or_default()
    }

    /// Weight in air (N).
    pub fn weight(&self, gravity: f64) -> f64 {
        self.elements.iter().map(|e| e.mass_per_length() * gravity * e.length).sum()
    }

    /// Buoyancy, positive up, wholly under water of a density (kg/m3), without end caps (N).
    pub fn buoyancy(&self, density: f64, gravity: f64) -> f64 {
        self.elements.iter().map(|e| density * gravity * e.tube().external_area() * e.length).sum()
    }

    /// Axial flexibility (m/N): the sum of `L / EA`.
    pub fn axial_flexibility(&self) -> f64 {
        self.elements.iter().map(|e| e.length / e.axial_stiffness()).sum()
    }
}

/// Whether an element can be reckoned with.
fn sound(number: usize, element: &TetherElement) -> Result<(), ClassError> {
    let e = element;
    let positive = [
        ("length", e.length, Dim::Length),
        ("outer diameter", e.outer_diameter, Dim::Section),
        ("wall thickness", e.wall_thickness, Dim::Section),
        ("density", e.density, Dim::None),
        ("Young's modulus", e.youngs_modulus, Dim::None),
    ];
    for (what, value, dim) in positive {
        if !(value.is_finite() && value > 0.0) {
            let message = format!("element {number} of the tether has the {what} {{}}; it must be above zero");
            return Err(ClassError::with_values(message, &[(value, dim)]));
        }
    }
    for (what, value) in [("drag coefficient", e.drag), ("added mass coefficient", e.added_mass)] {
        if !(value.is_finite() && value >= 0.0) {
            let message = format!("element {number} of the tether has the {what} {{}}; it must not be negative");
            return Err(ClassError::with_values(message, &[(value, Dim::None)]));
        }
    }
    // a bar may be given as half the diameter rounded up in its last digit
    let radius = e.tube().radius();
    if e.wall_thickness > radius * (1.0 + 1e-9) {
        let message = format!("element {number} of the tether has a wall of {{}}, thicker than its radius of {{}}");
        return Err(ClassError::with_values(message, &[(e.wall_thickness, Dim::Section), (radius, Dim::Section)]));
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn element() -> TetherElement {
        TetherElement {
            length: 10.0,
            outer_diameter: 1.0,
            wall_thickness: 0.05,
            density: 7850.0,
            youngs_modulus: 2.1e11,
            drag: 0.75,
            added_mass: 1.0,
            label: ElementLabel::default(),
        }
    }

    #[test]
    fn distances_run_from_first_node() {
        let line =
            TetherLine::with_numbered_nodes(vec![element(), TetherElement { length: 5.0, ..element() }]).unwrap();
        assert_eq!(line.distances(), [0.0, 10.0, 15.0]);
        assert_eq!((line.nodes(), line.length(), line.elements()[1].label.nodes), (3, 15.0, [2, 3]));
    }

    #[test]
    fn invalid_line_is_error_that_names_element() {
        let of = |list: Vec<TetherElement>| TetherLine::new(list).unwrap_err().to_string();
        assert!(of(Vec::new()).contains("at least one"));
        let gap = |nodes| TetherElement { label: ElementLabel { nodes, ..ElementLabel::default() }, ..element() };
        assert!(of(vec![gap([1, 2]), gap([3, 4])]).contains("elements 1 and 2 of the tether are not contiguous"));
        assert!(
            of(vec![TetherElement { length: 0.0, ..element() }]).contains("element 1 of the tether has the length 0")
        );
        assert!(of(vec![TetherElement { wall_thickness: 0.51, ..element() }]).contains("thicker than its radius"));
        assert!(of(vec![TetherElement { drag: f64::NAN, ..element() }]).contains("drag coefficient"));
        assert!(of(vec![element(); MAX_ELEMENTS + 1]).contains("more than"));
    }
}
