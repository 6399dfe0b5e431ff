//! The state of a line in an engine's vector of states: a flag, the mesh, and the motion of its nodes, in as much room as its longest
//! mesh needs.

use crate::model::ClassError;
use crate::rod::{Balance, Rod, State};

/// Where what stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Layout {
    /// Most elements.
    pub elements: usize,
    /// Values of the motion of a mesh of so many.
    motion: usize,
    /// Values of the books behind them.
    books: usize,
}

/// A mesh: unstretched length (m), rate at which it grows (m/s) and segment of each element.
pub(super) type Mesh = Vec<(f64, f64, usize)>;

/// A state read back.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    pub mesh: Mesh,
    pub motion: Vec<f64>,
    pub balance: Option<Balance>,
}

/// Flag, and the counts of elements and of values of the motion.
const HEAD: usize = 3;
/// Values of an element of the mesh.
const EACH: usize = 3;

impl Layout {
    /// That of a line of so many elements at most; `motion` values are those of a mesh of so many.
    pub fn new(elements: usize, motion: usize, books: bool) -> Self {
        Layout { elements, motion, books: if books { Balance::NUMBERS } else { 0 } }
    }

    /// Values of a state.
    pub fn size(&self) -> usize {
        HEAD + EACH * self.elements + self.motion + self.books
    }

    /// Whether books are kept.
    pub fn has_books(&self) -> bool {
        self.books > 0
    }

    /// The books of a state that has them and has begun.
    pub fn balance(&self, state: &[f64]) -> Option<Balance> {
        let begun = state.first().is_some_and(|f| *f != 0.0) && self.books > 0;
        begun.then(|| state.last_chunk().map(Balance::unpack)).flatten()
    }

    /// Writes the books behind a state.
    pub fn keep_books(&self, balance: &Balance, out: &mut [f64]) {
        if self.books > 0
            && let Some(place) = out.last_chunk_mut()
        {
            *place = balance.pack();
        }
    }

    /// Writes a state that has begun.
    pub fn write(&self, rod: &Rod, state: &State, out: &mut [f64]) -> Result<(), ClassError> {
        let mesh = rod.mesh();
        let mut motion = Vec::with_capacity(self.motion);
        state.pack(&mut motion);
        if out.len() != self.size() || mesh.len() > self.elements || motion.len() > self.motion {
            return Err(ClassError::new("the line has grown beyond what its winch was to pay out"));
        }
        let head = [1.0, mesh.len() as f64, motion.len() as f64];
        let elements = mesh.iter().flat_map(|(rest, rate, segment)| [*rest, *rate, *segment as f64]);
        let room = EACH * (self.elements - mesh.len());
        let values = head.into_iter().chain(elements).chain(std::iter::repeat_n(0.0, room)).chain(motion);
        out.fill(0.0);
        for (place, value) in out.iter_mut().zip(values) {
            *place = value;
        }
        Ok(())
    }

    /// Reads a state; none of one that has not begun.
    pub fn read(&self, state: &[f64]) -> Result<Option<Kept>, ClassError> {
        let wrong = || ClassError::new("the state of the line is not one of its own");
        let (head, rest) = state.split_at_checked(HEAD).ok_or_else(wrong)?;
        let [begun, elements, motion] = head else { return Err(wrong()) };
        if *begun == 0.0 {
            return Ok(None);
        }
        let (mesh, all) = rest.split_at_checked(EACH * self.elements).ok_or_else(wrong)?;
        let (elements, motion) = (*elements as usize, *motion as usize);
        let mesh = mesh.chunks_exact(EACH).take(elements);
        let mesh =
            mesh.map(|e| if let [rest, rate, segment] = e { (*rest, *rate, *segment as usize) } else { (0.0, 0.0, 0) });
        Ok(Some(Kept {
            mesh: mesh.collect(),
            motion: all.get(..motion).ok_or_else(wrong)?.to_vec(),
            balance: self.balance(state),
        }))
    }
}
