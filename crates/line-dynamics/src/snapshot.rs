//! A rod and its state as rows of numbers, and back: what a snapshot of a run keeps.

use super::error::RodError;
use super::mesh::{Rod, RodElement};
use super::section::{Attachment, RodSegment};
use super::state::RodState;
use nalgebra::Vector3;

/// Numbers before the nodes: time and origin.
const HEADER_LEN: usize = 4;
/// Numbers of a node: position, velocity, acceleration, averaged acceleration, where it sticks, bedding.
const NUMBERS_PER_NODE: usize = 16;

impl Rod {
    /// Its elements from end A, as winches have made them: unstretched length (m), rate at which it grows (m/s), and
    /// segment, from 0.
    pub fn mesh(&self) -> Vec<(f64, f64, usize)> {
        self.each_of_mesh().collect()
    }

    /// The elements of [`Rod::mesh`], one after the other.
    pub fn each_of_mesh(&self) -> impl ExactSizeIterator<Item = (f64, f64, usize)> {
        self.elements.iter().map(|e| (e.rest, e.rate, e.segment))
    }

    /// Makes a rod of given elements, as [`Rod::mesh`] gives them; `attachments` are on its nodes as they now are. A
    /// shape free of load must be given again.
    ///
    /// # Errors
    /// As [`Rod::new`], and an element of no length, of a segment that is not there, or of one before that of the
    /// element before it.
    pub fn with_mesh(
        name: &str,
        segments: Vec<RodSegment>,
        attachments: Vec<Attachment>,
        mesh: &[(f64, f64, usize)],
    ) -> Result<Self, RodError> {
        let elements: Option<Vec<RodElement>> = mesh
            .iter()
            .map(|(rest, rate, index)| {
                let sound = rest.is_finite() && *rest > 0.0 && rate.is_finite();
                let segment = segments.get(*index).filter(|_| sound)?;
                Some(RodElement { rate: *rate, ..RodElement::new(segment, *index, *rest) })
            })
            .collect();
        let refuse = |why: &str| RodError::Shape { rod: name.to_string(), why: why.to_string() };
        let elements = elements.ok_or_else(|| refuse("every element needs a length above zero and a segment"))?;
        if elements.windows(2).any(|pair| pair[1].segment < pair[0].segment) {
            return Err(refuse("its elements must follow each other as the segments do"));
        }
        Rod::of_elements(name, segments, attachments, elements)
    }
}

impl RodState {
    /// Appends all of it to a row of numbers: the time and the origin; position, velocity, acceleration, averaged acceleration,
    /// place where it sticks and bedding of each node; the director of each element of a rod with torsion; the strain to which each element of
    /// one with viscoelastic rope has yielded.
    pub fn pack(&self, out: &mut Vec<f64>) {
        let count = HEADER_LEN + NUMBERS_PER_NODE * self.position.len() + 3 * self.director.len() + self.yielded.len();
        let from = out.len();
        out.resize(from + count, 0.0);
        self.pack_into(&mut out[from..]);
    }

    /// The same into the beginning of a list: how many numbers they are; none where the list is too short.
    pub fn pack_into(&self, out: &mut [f64]) -> Option<usize> {
        let count = HEADER_LEN + NUMBERS_PER_NODE * self.position.len() + 3 * self.director.len() + self.yielded.len();
        let (head, rest) = out.get_mut(..count)?.split_first_chunk_mut::<HEADER_LEN>()?;
        *head = [self.time, self.origin.x, self.origin.y, self.origin.z];
        let (nodes, rest) = rest.split_at_mut(NUMBERS_PER_NODE * self.position.len());
        let motions = self.position.iter().zip(&self.velocity).zip(&self.acceleration).zip(&self.averaged);
        let (nodes, _) = nodes.as_chunks_mut::<NUMBERS_PER_NODE>();
        for (position, (((((x, v), a), averaged), s), bedding)) in
            nodes.iter_mut().zip(motions.zip(&self.stuck).zip(&self.bedding))
        {
            *position = [
                x.x, x.y, x.z, v.x, v.y, v.z, a.x, a.y, a.z, averaged.x, averaged.y, averaged.z, s.x, s.y, s.z,
                *bedding,
            ];
        }
        let (directors, yielded) = rest.split_at_mut(3 * self.director.len());
        for (numbers, director) in directors.chunks_exact_mut(3).zip(&self.director) {
            numbers.copy_from_slice(director.as_slice());
        }
        yielded.copy_from_slice(&self.yielded);
        Some(count)
    }

    /// How many numbers [`RodState::pack`] makes of a state of a rod.
    pub fn packed_len(rod: &Rod) -> usize {
        RodState::packed_len_with(rod, rod.elements.len())
    }

    /// The same of a rod of such segments that a winch has given so many elements.
    pub fn packed_len_with(rod: &Rod, elements: usize) -> usize {
        let (turns, strains) =
            (if rod.twists() { 3 * elements } else { 0 }, if rod.is_viscoelastic() { elements } else { 0 });
        HEADER_LEN + NUMBERS_PER_NODE * elements.saturating_add(1) + turns + strains
    }

    /// The state that [`RodState::pack`] made numbers of, to the last bit.
    ///
    /// # Errors
    /// Another count of numbers than a state of this rod has, or one that is no number.
    pub fn unpack(rod: &Rod, from: &[f64]) -> Result<Self, RodError> {
        let mut made = RodState::default();
        made.unpack_into(rod, from)?;
        Ok(made)
    }

    /// Becomes the state of [`RodState::unpack`], in memory that is there. It is left as it was where there is an error.
    ///
    /// # Errors
    /// As [`RodState::unpack`].
    pub fn unpack_into(&mut self, rod: &Rod, from: &[f64]) -> Result<(), RodError> {
        let wanted = RodState::packed_len(rod);
        let refuse = |why: String| RodError::Shape { rod: rod.name.clone(), why };
        if from.len() != wanted {
            return Err(refuse(format!("its state is {wanted} numbers, not {}", from.len())));
        }
        // without a way out of the loop it goes many at a time
        let whole = from.iter().fold(true, |whole, v| whole & v.is_finite());
        if !whole {
            let position = from.iter().position(|v| !v.is_finite()).unwrap_or(0);
            return Err(refuse(format!("number {} of its state is {}", position + 1, from[position])));
        }
        let (nodes, elements) = from[HEADER_LEN..].split_at(NUMBERS_PER_NODE * rod.nodes());
        let (directors, yielded) = elements.split_at(if rod.twists() { 3 * rod.elements.len() } else { 0 });
        (self.time, self.origin) = (from[0], Vector3::new(from[1], from[2], from[3]));
        let count = rod.nodes();
        for list in
            [&mut self.position, &mut self.velocity, &mut self.acceleration, &mut self.averaged, &mut self.stuck]
        {
            list.resize(count, Vector3::zeros());
        }
        self.bedding.resize(count, 0.0);
        let motions = self.position.iter_mut().zip(&mut self.velocity).zip(&mut self.acceleration);
        let lists = motions.zip(&mut self.averaged).zip(&mut self.stuck).zip(&mut self.bedding);
        let (nodes, _) = nodes.as_chunks::<NUMBERS_PER_NODE>();
        for ((((((x, v), a), averaged), s), bedding), node) in lists.zip(nodes) {
            let three = |first: usize| Vector3::new(node[first], node[first + 1], node[first + 2]);
            (*x, *v, *a, *averaged, *s) = (three(0), three(3), three(6), three(9), three(12));
            *bedding = node[NUMBERS_PER_NODE - 1];
        }
        self.director.clear();
        self.director.extend(directors.chunks_exact(3).map(Vector3::from_column_slice));
        self.yielded.clear();
        self.yielded.extend_from_slice(yielded);
        Ok(())
    }
}
