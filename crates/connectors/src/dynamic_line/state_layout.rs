//! The state of a line in an engine's vector of states: a flag, the mesh, and the motion of its nodes, in as much room as its longest
//! mesh needs.

use super::mesh::Bands;
use windlass_line_dynamics::{Rod, RodEnergyBalance, RodState};
use windlass_model::ClassError;

/// Where what stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StateLayout {
    /// Most elements.
    pub elements: usize,
    /// Values of the motion of a mesh of so many.
    motion: usize,
    /// Values of the energy balance behind them.
    balance: usize,
}

/// A state as it stands in the engine's vector.
#[derive(Clone, Copy, Debug)]
pub(super) struct StateView<'a> {
    /// Unstretched length (m), rate at which it grows (m/s) and part of each element.
    mesh: &'a [f64],
    /// What [`RodState::pack`] made of the motion.
    pub motion: &'a [f64],
    /// How much pipe the tensioner has paid out since the pipe was laid (m).
    pub paid: f64,
    /// Its energy balance, where it is kept and begun.
    pub balance: Option<RodEnergyBalance>,
}

impl StateView<'_> {
    /// The same before its balance is begun.
    pub fn without_balance(self) -> Self {
        StateView { balance: None, ..self }
    }

    /// The elements of its mesh, as [`Rod::mesh`] gives them, but for their parts in place of segments: how many of these a part has
    /// may change during a run.
    pub fn mesh(&self) -> impl ExactSizeIterator<Item = (f64, f64, usize)> {
        let (each, _) = self.mesh.as_chunks::<VALUES_PER_ELEMENT>();
        each.iter().map(|[rest, rate, part]| (*rest, *rate, *part as usize))
    }
}

/// Flag, the counts of elements and of values of the motion, and what a tensioner has paid out.
const HEADER_VALUES: usize = 4;
/// Values of an element of the mesh.
const VALUES_PER_ELEMENT: usize = 3;

impl StateLayout {
    /// That of a line of so many elements at most; `motion` values are those of a mesh of so many.
    pub fn new(elements: usize, motion: usize, balance: bool) -> Self {
        StateLayout { elements, motion, balance: if balance { RodEnergyBalance::PACKED_LEN } else { 0 } }
    }

    /// Values of a state.
    pub fn size(&self) -> usize {
        HEADER_VALUES + VALUES_PER_ELEMENT * self.elements + self.motion + self.balance
    }

    /// Whether the energy balance is kept.
    pub fn has_balance(&self) -> bool {
        self.balance > 0
    }

    /// The energy balance of a state that has one and has begun.
    pub fn balance(&self, state: &[f64]) -> Option<RodEnergyBalance> {
        let begun = state.first().is_some_and(|f| *f != 0.0) && self.balance > 0;
        begun.then(|| state.last_chunk().map(RodEnergyBalance::unpack)).flatten()
    }

    /// Writes the energy balance behind a state.
    pub fn write_balance(&self, balance: &RodEnergyBalance, out: &mut [f64]) {
        if self.balance > 0
            && let Some(position) = out.last_chunk_mut()
        {
            *position = balance.pack();
        }
    }

    /// How much pipe the tensioner of a state has paid out (m).
    ///
    /// # Errors
    /// A state that is not one of its own.
    pub fn payout(&self, state: &[f64]) -> Result<f64, ClassError> {
        let wrong = || ClassError::new("the state of the line is not one of its own").lasting();
        state.get(HEADER_VALUES - 1).copied().ok_or_else(wrong)
    }

    /// Writes a state that has begun, and what its tensioner has paid out.
    ///
    /// # Errors
    /// A state of another length, or of another line.
    pub fn write(
        &self,
        (rod, bands): (&Rod, &Bands),
        (state, paid): (&RodState, f64),
        out: &mut [f64],
    ) -> Result<(), ClassError> {
        let wrong = || ClassError::new("the line has grown beyond what its winch was to pay out").lasting();
        let mesh = rod.each_of_mesh();
        if out.len() != self.size() || mesh.len() > self.elements {
            return Err(wrong());
        }
        let (head, rest) = out.split_first_chunk_mut::<HEADER_VALUES>().ok_or_else(wrong)?;
        let (elements, motion) = rest.split_at_mut_checked(VALUES_PER_ELEMENT * self.elements).ok_or_else(wrong)?;
        let count = state.pack_into(motion.get_mut(..self.motion).ok_or_else(wrong)?).ok_or_else(wrong)?;
        *head = [1.0, mesh.len() as f64, count as f64, paid];
        let (own, free) = elements.split_at_mut_checked(VALUES_PER_ELEMENT * mesh.len()).ok_or_else(wrong)?;
        for (position, (rest, rate, segment)) in own.as_chunks_mut::<VALUES_PER_ELEMENT>().0.iter_mut().zip(mesh) {
            *position = [rest, rate, bands.part_of(segment) as f64];
        }
        free.fill(0.0);
        motion.get_mut(count..).ok_or_else(wrong)?.fill(0.0);
        Ok(())
    }

    /// Reads a state; none of one that has not begun.
    ///
    /// # Errors
    /// A state of another length, or of another line.
    pub fn read<'a>(&self, state: &'a [f64]) -> Result<Option<StateView<'a>>, ClassError> {
        let wrong = || ClassError::new("the state of the line is not one of its own").lasting();
        let (head, rest) = state.split_at_checked(HEADER_VALUES).ok_or_else(wrong)?;
        let [begun, elements, motion, paid] = head else { return Err(wrong()) };
        if *begun == 0.0 {
            return Ok(None);
        }
        let (mesh, all) = rest.split_at_checked(VALUES_PER_ELEMENT * self.elements).ok_or_else(wrong)?;
        let (elements, motion) = (*elements as usize, *motion as usize);
        let mesh = mesh.get(..VALUES_PER_ELEMENT.saturating_mul(elements)).ok_or_else(wrong)?;
        let motion = all.get(..motion).ok_or_else(wrong)?;
        Ok(Some(StateView { mesh, motion, paid: *paid, balance: self.balance(state) }))
    }
}
