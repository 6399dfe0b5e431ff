//! A run of a towed tether in time, and what is reported of each step.

use super::Towed;
use super::scheme::{TowedScheme, TowedState, USUAL_B};
use std::ops::ControlFlow;
use windlass_base::units::Dim;
use windlass_model::ClassError;

/// Square of the largest slope of an element: rotations of more than 30 degrees invalidate the analysis [AQWA-TETHER 4].
const LARGEST_STEEPNESS: f64 = 1.0 / 3.0;

/// Steps of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TowedSteps {
    /// Time of the first record (s).
    pub start: f64,
    /// Length of a step (s).
    pub step: f64,
    /// Number of records, the first at the start: the last is `(number - 1) * step` later, as card TIME of deck 16.
    pub number: usize,
    /// The scheme's b [AQWA-TETHER 3.6]: 0.5 to 1.
    pub b: f64,
}

impl Default for TowedSteps {
    /// The start alone, with a step of 0.25 s and the manual's b.
    fn default() -> Self {
        TowedSteps { start: 0.0, step: 0.25, number: 1, b: USUAL_B }
    }
}

/// Forces, moments and stresses at an end of an element, with the signs of the listing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ElementEnd {
    /// Shear forces SY, SZ (N): of the element on the node.
    pub shear: [f64; 2],
    /// Bending moments MY = EI z'', MZ = EI y'' (N m).
    pub moment: [f64; 2],
    /// Bending stress (N/m2): the largest around the tube, that of MY, that of MZ. At an angle phi around the tube it is
    /// `stress[1] cos(phi) + stress[2] sin(phi)`.
    pub stress: [f64; 3],
}

/// What a run reports of one time. Rotations are by the right hand: RY = -z', RZ = y'.
#[derive(Clone, Copy, Debug)]
pub struct TowedRecord<'a> {
    /// Its number from 0.
    pub index: usize,
    /// Its time (s).
    pub time: f64,
    /// Place of each node along the straight axis (m), shortened by the slopes: the sum of `L (1 - slope^2/2)`.
    pub along: &'a [f64],
    /// Y, Z (m), RY, RZ (rad) of each node from the straight axis.
    pub positions: &'a [[f64; 4]],
    /// Their rates (m/s, rad/s).
    pub velocities: &'a [[f64; 4]],
    /// Their accelerations (m/s2, rad/s2).
    pub accelerations: &'a [[f64; 4]],
    /// Both ends of each element: first end, second end of element 1, then of element 2 and so on.
    pub ends: &'a [ElementEnd],
}

/// Who looks at the records of a run as they come: statistics need not keep them.
pub trait TowedObserver {
    /// Takes a record; [`ControlFlow::Break`] ends the run.
    fn record(&mut self, record: &TowedRecord<'_>) -> ControlFlow<()>;

    /// Called before each step and at the end, where the run can be resumed: the number of the record that comes next, and what
    /// [`Towed::resume`] needs.
    ///
    /// # Errors
    /// What ends the run.
    fn checkpoint(&mut self, _next: usize, _numbers: &dyn Fn() -> Vec<f64>) -> Result<(), ClassError> {
        Ok(())
    }
}

impl<F: FnMut(&TowedRecord<'_>)> TowedObserver for F {
    fn record(&mut self, record: &TowedRecord<'_>) -> ControlFlow<()> {
        self(record);
        ControlFlow::Continue(())
    }
}

/// Keeps the records whole, in flat lists.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TowedHistory {
    /// Every how many records one is kept; 0 is taken for 1.
    pub every: usize,
    /// Their times (s).
    pub times: Vec<f64>,
    /// `nodes[(record * number of nodes + node) * 13 + quantity]`: Y, Z, RY, RZ, their rates, their accelerations, place along.
    pub nodes: Vec<f64>,
    /// `ends[(record * 2 * number of elements + 2 * element + end) * 7 + quantity]`: SY, SZ, MY, MZ, stress largest, of MY, of MZ.
    pub ends: Vec<f64>,
}

impl TowedHistory {
    /// Values of a node in [`TowedHistory::nodes`].
    pub const OF_A_NODE: usize = 13;
    /// Values of an end in [`TowedHistory::ends`].
    pub const OF_AN_END: usize = 7;

    /// The series of a quantity of a node (from 0) out of a number of nodes.
    pub fn node(&self, node: usize, nodes: usize, quantity: usize) -> Vec<f64> {
        let step = nodes * Self::OF_A_NODE;
        self.nodes.iter().skip(node * Self::OF_A_NODE + quantity).step_by(step.max(1)).copied().collect()
    }

    /// The series of a quantity of an end (2 * element + end, from 0) out of a number of elements.
    pub fn end(&self, end: usize, elements: usize, quantity: usize) -> Vec<f64> {
        let step = 2 * elements * Self::OF_AN_END;
        self.ends.iter().skip(end * Self::OF_AN_END + quantity).step_by(step.max(1)).copied().collect()
    }
}

impl TowedObserver for TowedHistory {
    fn record(&mut self, record: &TowedRecord<'_>) -> ControlFlow<()> {
        if record.index.is_multiple_of(self.every.max(1)) {
            self.times.push(record.time);
            for (i, along) in record.along.iter().enumerate() {
                self.nodes.extend(record.positions[i]);
                self.nodes.extend(record.velocities[i]);
                self.nodes.extend(record.accelerations[i]);
                self.nodes.push(*along);
            }
            for end in record.ends {
                self.ends.extend(end.shear);
                self.ends.extend(end.moment);
                self.ends.extend(end.stress);
            }
        }
        ControlFlow::Continue(())
    }
}

impl Towed {
    /// Runs it from rest on its straight axis, and shows each record to an observer. The state at the end is returned.
    ///
    /// # Errors
    /// Those of [`Towed::check`]; steps that cannot be, or too large for the end springs; a motion without bound, or slopes
    /// of 30 degrees or more, where the theory of small deflections has ended.
    pub fn run(&self, steps: &TowedSteps, observer: &mut dyn TowedObserver) -> Result<TowedState, ClassError> {
        let order = 2 * self.line.nodes();
        let zeros = || [vec![0.0; order], vec![0.0; order]];
        self.run_from(TowedState { at: zeros(), velocity: zeros() }, steps, observer)
    }

    /// The same from a state.
    ///
    /// # Errors
    /// Those of [`Towed::run`]; a state of another number of nodes.
    pub fn run_from(
        &self,
        state: TowedState,
        steps: &TowedSteps,
        observer: &mut dyn TowedObserver,
    ) -> Result<TowedState, ClassError> {
        let order = 2 * self.line.nodes();
        self.run_on((0, state, [vec![0.0; order], vec![0.0; order]]), steps, observer)
    }

    /// Goes on from a checkpoint of a run of the same steps: the number of the record that comes next, and the numbers of
    /// [`TowedObserver::checkpoint`]. It comes to the numbers of the run that was not interrupted, bit for bit.
    ///
    /// # Errors
    /// Those of [`Towed::run`]; numbers of another tether.
    pub fn resume(
        &self,
        (next, numbers): (usize, &[f64]),
        steps: &TowedSteps,
        observer: &mut dyn TowedObserver,
    ) -> Result<TowedState, ClassError> {
        let order = 2 * self.line.nodes();
        if numbers.len() != 6 * order {
            return Err(ClassError::new("the checkpoint is not one of this towed tether"));
        }
        let mut lists = numbers.chunks(order.max(1)).map(<[f64]>::to_vec);
        let mut pair = || [lists.next().unwrap_or_default(), lists.next().unwrap_or_default()];
        let state = TowedState { at: pair(), velocity: pair() };
        self.run_on((next, state, pair()), steps, observer)
    }

    fn run_on(
        &self,
        (first, mut state, before): (usize, TowedState, [Vec<f64>; 2]),
        steps: &TowedSteps,
        observer: &mut dyn TowedObserver,
    ) -> Result<TowedState, ClassError> {
        self.check()?;
        steps.check()?;
        let order = 2 * self.line.nodes();
        if state.at.iter().chain(&state.velocity).any(|list| list.len() != order) {
            return Err(ClassError::new(format!("the state of the towed tether is not one of {} nodes", order / 2)));
        }
        let mut scheme = TowedScheme::new(self, steps.step, steps.b)?;
        scheme.check_step()?;
        let mut shown = RecordLists { before, ..RecordLists::new(order / 2) };
        let mut next = first;
        for index in first..steps.number {
            observer.checkpoint(index, &|| checkpoint_numbers(&state, &shown.before))?;
            let time = steps.start + index as f64 * steps.step;
            scheme.stages(time, &state)?;
            shown.fill(self, &scheme, &state, index)?;
            let record = TowedRecord {
                index,
                time,
                along: &shown.along,
                positions: &shown.positions,
                velocities: &shown.velocities,
                accelerations: &shown.accelerations,
                ends: &shown.ends,
            };
            if observer.record(&record).is_break() {
                break;
            }
            scheme.advance(&mut state);
            shown.keep(&scheme);
            next = index + 1;
        }
        observer.checkpoint(next, &|| checkpoint_numbers(&state, &shown.before))?;
        Ok(state)
    }
}

/// Deflections, their rates and the mean accelerations of the step before, plane by plane.
fn checkpoint_numbers(state: &TowedState, before: &[Vec<f64>; 2]) -> Vec<f64> {
    state.at.iter().chain(&state.velocity).chain(before).flatten().copied().collect()
}

impl TowedSteps {
    /// Whether there are such steps.
    fn check(&self) -> Result<(), ClassError> {
        if !(self.step.is_finite() && self.step > 0.0 && self.start.is_finite()) {
            let message = "a run of the towed tether needs a step above zero and a start; these are {} and {}";
            return Err(ClassError::with_values(message, &[(self.step, Dim::Time), (self.start, Dim::Time)]));
        }
        if !(0.5..=1.0).contains(&self.b) {
            let message = "the b of the scheme is {}; below 0.5 it is not stable, and above 1 it has no meaning";
            return Err(ClassError::with_values(message, &[(self.b, Dim::None)]));
        }
        Ok(())
    }
}

/// The lists of a record, filled anew at each.
struct RecordLists {
    along: Vec<f64>,
    positions: Vec<[f64; 4]>,
    velocities: Vec<[f64; 4]>,
    accelerations: Vec<[f64; 4]>,
    ends: Vec<ElementEnd>,
    /// Mean accelerations of the step before, in the planes y and z.
    before: [Vec<f64>; 2],
}

impl RecordLists {
    fn new(nodes: usize) -> Self {
        let list = || vec![[0.0; 4]; nodes];
        RecordLists {
            along: vec![0.0; nodes],
            positions: list(),
            velocities: list(),
            accelerations: list(),
            ends: vec![ElementEnd::default(); 2 * (nodes - 1)],
            before: [vec![0.0; 2 * nodes], vec![0.0; 2 * nodes]],
        }
    }

    /// Fills them from a state and the stages that start from it.
    fn fill(&mut self, case: &Towed, scheme: &TowedScheme, state: &TowedState, index: usize) -> Result<(), ClassError> {
        // 0 - x: no minus before a zero
        let turned = |y: &[f64], z: &[f64], i: usize| [y[2 * i], z[2 * i], 0.0 - z[2 * i + 1], y[2 * i + 1]];
        let [first, second] = &scheme.accelerations;
        let old = case.compatibility.acceleration_of_step_before;
        for i in 0..self.along.len() {
            self.positions[i] = turned(&state.at[0], &state.at[1], i);
            self.velocities[i] = turned(&state.velocity[0], &state.velocity[1], i);
            let one = turned(&first[0], &first[1], i);
            self.accelerations[i] = if old && index > 0 {
                turned(&self.before[0], &self.before[1], i)
            } else if old {
                one
            } else {
                let two = turned(&second[0], &second[1], i);
                std::array::from_fn(|q| 0.5 * (one[q] + two[q]))
            };
        }
        let mut along = 0.0;
        for (i, e) in case.line.elements().iter().enumerate() {
            let chord: [f64; 2] = std::array::from_fn(|p| (state.at[p][2 * i + 2] - state.at[p][2 * i]) / e.length);
            let steepness = chord[0] * chord[0] + chord[1] * chord[1];
            if steepness > LARGEST_STEEPNESS {
                let message = format!(
                    "element {} of the towed tether is steeper than 30 degrees at record {}: small deflections have ended",
                    i + 1,
                    index + 1
                );
                return Err(ClassError::new(message)
                    .help("stiffer end springs, a smaller step or less current along the axis may help"));
            }
            self.along[i] = along;
            along += e.length * (1.0 - 0.5 * steepness);
            for end in 0..2 {
                self.ends[2 * i + end] = scheme.end(i, end);
            }
        }
        if let Some(last) = self.along.last_mut() {
            *last = along;
        }
        Ok(())
    }

    /// Keeps the mean accelerations of a step that is done.
    fn keep(&mut self, scheme: &TowedScheme) {
        let [first, second] = &scheme.accelerations;
        for p in 0..2 {
            for (kept, (a, b)) in self.before[p].iter_mut().zip(first[p].iter().zip(&second[p])) {
                *kept = 0.5 * (a + b);
            }
        }
    }
}
