//! A rod cut into elements.

use super::element_list::ElementList;
use super::error::RodError;
use super::section::{Attachment, RodSegment, TensionLaw};
use super::spatial::transport_director;
use super::viscoelastic::ViscoelasticRope;
use nalgebra::Vector3;

/// Most elements of one rod: far beyond what a line needs, and still some hundred megabytes.
pub const MAX_ELEMENTS: usize = 100_000;

/// Memory an element takes in a run (bytes), rounded up: band, state, copies of both.
pub const BYTES_PER_ELEMENT: f64 = 3000.0;

/// What one element needs in every iteration; half quantities go to each of its two nodes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RodElement {
    /// Unstretched length (m).
    pub rest: f64,
    /// Rate at which it grows (m/s), positive when paid out.
    pub rate: f64,
    /// Its segment.
    pub segment: usize,
    /// Constant EA (N), or zero where the segment's law must be asked.
    pub ea: f64,
    /// Axial damping (N s).
    pub damping: f64,
    /// Whether its tension is that of a constant EA, damping and pressure: such elements are taken several at once.
    pub plain: bool,
    /// Whether it resists being shortened.
    pub compression: bool,
    /// Bending stiffness (N m2).
    pub bending: f64,
    /// Torsional stiffness (N m2).
    pub torsion: f64,
    /// Half its mass (kg).
    pub mass: f64,
    /// Half its displaced volume (m3).
    pub volume: f64,
    /// Half its added volumes, normal and tangential (m3).
    pub added: [f64; 2],
    /// Half its drag areas, normal and tangential, times a half (m2).
    pub drag: [f64; 2],
    /// Half its drag area to the wind, times a half (m2).
    pub wind: f64,
    /// Half its shadow on the bottom (m2).
    pub contact: f64,
    /// Height over which it comes out of the water (m).
    pub diameter: f64,
}

impl RodElement {
    pub fn new(segment: &RodSegment, index: usize, rest: f64) -> Self {
        let half = 0.5 * rest;
        let ea = if let super::section::TensionLaw::Linear(ea) = segment.axial { ea } else { 0.0 };
        RodElement {
            rest,
            rate: 0.0,
            segment: index,
            ea,
            plain: ea > 0.0,
            damping: segment.axial_damping,
            compression: segment.compression,
            bending: segment.bending,
            torsion: segment.torsion,
            mass: half * segment.mass,
            volume: half * segment.displaced,
            added: [
                half * segment.added_area * segment.added_normal,
                half * segment.added_area * segment.added_tangential,
            ],
            drag: [
                0.5 * half * segment.drag_diameter * segment.drag_normal,
                0.5 * half * std::f64::consts::PI * segment.drag_diameter * segment.drag_tangential,
            ],
            wind: 0.5 * half * segment.wind_diameter * segment.wind_drag,
            contact: half * segment.contact_diameter,
            diameter: segment.contact_diameter,
        }
    }
}

/// A slender rod from end A to end B: a row of straight elements between nodes.
///
/// Unknowns are the three translations of each node, and with torsional stiffness the turn of each element about
/// itself. Tension follows the stretch of an element, bending the angle between the directions of neighbouring
/// elements: the moment at a node is EI times that angle over the length between the middles of the elements. With EI
/// = 0 nothing but the chain is left. All forces are derivatives of the energy of the actual shape, without
/// restriction of rotation; errors fall with the square of the element length. The section is the same in all
/// directions, and the rod straight when free of load unless [`Rod::set_shape`] says otherwise; shear deformation and
/// rotary inertia are left out, as a slender rod has none worth counting.
///
/// Sources: geometry of the discrete rod after [BERGOU-2008],
/// with the angle itself as measure of curvature, which closes a circle exactly; line properties in the sense of API
/// RP 2SK.
#[derive(Clone, Debug, PartialEq)]
pub struct Rod {
    pub(super) name: String,
    pub(super) segments: Vec<RodSegment>,
    pub(super) elements: ElementList,
    pub(super) attachments: Vec<Attachment>,
    /// The shape free of load, where it is not straight.
    pub(super) natural: Option<UnloadedShape>,
}

/// The shape of a rod free of load.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct UnloadedShape {
    /// Directors of end A's holder, of the elements, and of end B's holder.
    pub directors: Vec<Vector3<f64>>,
    /// Curvature angle at each node by the directors before and after it (rad).
    pub curvature: Vec<[[f64; 2]; 2]>,
}

impl Rod {
    /// Cuts segments, from end A to end B, into elements.
    ///
    /// # Errors
    /// A property that makes no rod, more elements than [`MAX_ELEMENTS`], or an attachment to a node that is not there.
    pub fn new(name: &str, segments: Vec<RodSegment>, attachments: Vec<Attachment>) -> Result<Self, RodError> {
        let refuse = |why: String| RodError::Shape { rod: name.to_string(), why };
        if segments.is_empty() {
            return Err(refuse("a rod needs at least one segment".to_string()));
        }
        for (i, segment) in segments.iter().enumerate() {
            segment.check(name, i + 1)?;
        }
        check_element_count(name, segments.iter().fold(0usize, |sum, s| sum.saturating_add(s.elements)))?;
        let elements = segments
            .iter()
            .enumerate()
            .flat_map(|(i, s)| (0..s.elements).map(move |_| RodElement::new(s, i, s.length / s.elements as f64)))
            .collect();
        Rod::of_elements(name, segments, attachments, elements)
    }

    /// Puts elements of the segments together.
    pub(super) fn of_elements(
        name: &str,
        segments: Vec<RodSegment>,
        attachments: Vec<Attachment>,
        elements: Vec<RodElement>,
    ) -> Result<Self, RodError> {
        let refuse = |why: String| RodError::Shape { rod: name.to_string(), why };
        let count = elements.len();
        check_element_count(name, count)?;
        if count == 0 {
            return Err(refuse("a rod needs at least one element".to_string()));
        }
        for (i, segment) in segments.iter().enumerate() {
            segment.check(name, i + 1)?;
        }
        for a in &attachments {
            let numbers = [a.mass, a.volume, a.height, a.pendant, a.drag, a.added];
            if a.node > count || numbers.iter().any(|v| !(v.is_finite() && *v >= 0.0)) {
                let node = a.node;
                return Err(refuse(format!(
                    "the attachment at node {node} needs a node from 0 to {count} and no negative property"
                )));
            }
        }
        let elements = ElementList::new(elements);
        Ok(Rod { name: name.to_string(), segments, elements, attachments, natural: None })
    }

    /// Gives the rod a shape that it has when free of load: the positions of its nodes (m), and its directions at both ends. It needs
    /// torsional stiffness, as a bent rod can only bend another way by twisting.
    ///
    /// # Errors
    /// A rod without torsional stiffness, or not one place a node.
    pub fn set_shape(&mut self, points: &[Vector3<f64>], ends: [Vector3<f64>; 2]) -> Result<(), RodError> {
        let refuse = |why: &str| Err(RodError::Shape { rod: self.name.clone(), why: why.to_string() });
        if points.len() != self.nodes() || !self.twists() {
            return refuse("a shape free of load needs torsional stiffness, and the place of every node");
        }
        let mut directions = vec![ends[0].normalize()];
        directions.extend(points.windows(2).map(|p| (p[1] - p[0]).normalize()));
        directions.push(ends[1].normalize());
        if directions.iter().any(|d| !d.iter().all(|c| c.is_finite())) {
            return refuse("two of its nodes have the same place");
        }
        let directors = transport_sides(&directions);
        let curvature = (0..self.nodes())
            .map(|i| {
                let (e, f) = (directions[i], directions[i + 1]);
                let axis = e.cross(&f).try_normalize(1e-12).unwrap_or_else(Vector3::zeros);
                let vector = axis * e.cross(&f).norm().atan2(e.dot(&f));
                [i, i + 1].map(|j| [vector.dot(&directors[j]), vector.dot(&directions[j].cross(&directors[j]))])
            })
            .collect();
        self.natural = Some(UnloadedShape { directors, curvature });
        Ok(())
    }

    /// The direction across the rod at end A and end B, in the shape free of load, by which a holder keeps it from twisting.
    pub fn sides(&self) -> Option<[Vector3<f64>; 2]> {
        let directors = &self.natural.as_ref()?.directors;
        Some([*directors.first()?, *directors.last()?])
    }

    /// Whether torsion is among its unknowns.
    pub(super) fn twists(&self) -> bool {
        self.elements.iter().any(|e| e.torsion > 0.0)
    }

    /// Torsional stiffness of the hinge at an inner node (N m).
    pub(super) fn twist_hinge(&self, node: usize) -> f64 {
        let (a, b) = (&self.elements[node - 1], &self.elements[node]);
        if a.torsion > 0.0 && b.torsion > 0.0 { 2.0 / (a.rest / a.torsion + b.rest / b.torsion) } else { 0.0 }
    }

    /// Curvature angle of a node when free of load, by the directors before and after it (rad).
    pub(super) fn natural_curvature(&self, node: usize) -> [[f64; 2]; 2] {
        self.natural.as_ref().map_or([[0.0; 2]; 2], |n| n.curvature[node])
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its segments from end A.
    pub fn segments(&self) -> &[RodSegment] {
        &self.segments
    }

    /// Area by which a node lies on the bottom (m2).
    pub(super) fn contact_area(&self, node: usize) -> f64 {
        let before = node.checked_sub(1).and_then(|i| self.elements.get(i));
        let own: f64 = before.into_iter().chain(self.elements.get(node)).map(|e| e.contact).sum();
        own + self.attachments.iter().filter(|a| a.node == node).map(|a| a.bearing).sum::<f64>()
    }

    /// What is attached to its nodes, as winches have renumbered them.
    pub fn attachments(&self) -> &[Attachment] {
        &self.attachments
    }

    /// Number of nodes: one more than elements.
    pub fn nodes(&self) -> usize {
        self.elements.len() + 1
    }

    /// Unstretched length (m).
    pub fn length(&self) -> f64 {
        self.elements.iter().map(|e| e.rest).sum()
    }

    /// Unstretched length of its shortest element (m).
    pub(super) fn shortest(&self) -> f64 {
        self.elements.iter().map(|e| e.rest).fold(f64::INFINITY, f64::min)
    }

    /// Force across a rod (N) that bends it by an angle of one over its length, EI / L^2 of the softest element: none of one with an
    /// element that does not bend.
    pub(super) fn bending_force(&self) -> f64 {
        self.elements.iter().map(|e| e.bending).fold(f64::INFINITY, f64::min) / self.length().powi(2)
    }

    /// Unstretched distance of each node from end A (m).
    pub fn arc(&self) -> Vec<f64> {
        let mut sum = 0.0;
        std::iter::once(0.0)
            .chain(self.elements.iter().map(|e| {
                sum += e.rest;
                sum
            }))
            .collect()
    }

    /// Stiffness of the hinge at an inner node (N m): the halves of its two elements in series.
    #[inline(always)]
    pub(super) fn hinge(&self, node: usize) -> f64 {
        let (a, b) = (&self.elements[node - 1], &self.elements[node]);
        if a.bending > 0.0 && b.bending > 0.0 { 2.0 / (a.rest / a.bending + b.rest / b.bending) } else { 0.0 }
    }

    /// Whether rollers meet it as a smooth curve: where it bends. The system of one that does not has no room for it.
    pub(super) fn is_smooth(&self) -> bool {
        self.twists() || self.elements.iter().any(|e| e.bending > 0.0)
    }

    /// Whether a rod of a weight (N) stands by its bending stiffness: EI / L^2 is above it. Every element bears compression and bends.
    pub(super) fn is_stiff(&self, weight: f64) -> bool {
        self.bending_force() > weight && self.elements.iter().all(|e| e.compression)
    }

    /// Whether any of it remembers how it was pulled.
    pub(super) fn is_viscoelastic(&self) -> bool {
        self.elements.iter().any(|e| self.viscoelastic_law(e).is_some())
    }

    /// The law of an element that remembers how it was pulled.
    pub(super) fn viscoelastic_law(&self, element: &RodElement) -> Option<&ViscoelasticRope> {
        match &self.segments[element.segment].axial {
            TensionLaw::Viscoelastic(rope) => Some(rope),
            _ => None,
        }
    }
}

/// Refuses more elements than one run should hold.
fn check_element_count(rod: &str, elements: usize) -> Result<(), RodError> {
    if elements > MAX_ELEMENTS {
        let megabytes = elements as f64 * BYTES_PER_ELEMENT / 1e6;
        return Err(RodError::TooLarge { rod: rod.to_string(), elements, megabytes, most: MAX_ELEMENTS });
    }
    Ok(())
}

/// Directors of a row of directions: across the first one, and taken along without twist.
pub(super) fn transport_sides(directions: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let Some(first) = directions.first() else { return Vec::new() };
    let axis = Vector3::ith(first.iamin(), 1.0);
    let mut directors = vec![(axis - first * first.dot(&axis)).normalize()];
    for pair in directions.windows(2) {
        let last = directors[directors.len() - 1];
        directors.push(transport_director(&last, &pair[0], &pair[1]));
    }
    directors
}
