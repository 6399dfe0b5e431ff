//! The pieces of a plain line together, at a given horizontal force: how they come to rest.
//!
//! Where the line touches the bottom, where a joint lies on it, and where a pendant holds a joint, the height is known.
//! Between such places one number is unknown, the vertical force at the upper one, and the drop grows with it: a
//! safeguarded Newton iteration finds it. Which places these are is found by policy iteration: what sinks below the
//! bottom is put on it, what the bottom would have to hold down is let go, a joint at a step of its lift stays there as
//! long as the lift lies between the two sides of the step.
//!
//! Axes: x from the anchor toward the fairlead, z upward from the bottom at the anchor. The bottom is flat and smooth, so
//! that the horizontal force is the same all along.

use super::active_set::ActiveSet;
use super::contact_problem::ContactProblem;
use super::element::LinePiece;
use super::error::LineError;
use super::segment::SpanReach;

/// What pulls at a joint.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct JointPull {
    /// Lift (N, upward) below all its steps.
    pub lift: f64,
    /// Elevations (m above the bottom at the anchor) from which on the lift is smaller, and by how much (N); rising.
    pub steps: Vec<(f64, f64)>,
    /// Whether the bottom carries the joint.
    pub on_bottom: bool,
}

impl JointPull {
    /// The lift when this many steps are passed (N).
    pub fn lift_after(&self, steps: usize) -> f64 {
        self.lift - self.steps.iter().take(steps).map(|s| s.1).sum::<f64>()
    }
}

/// The pieces of a line from the fairlead to the anchor.
#[derive(Clone, Debug)]
pub struct MultiSegmentLine {
    pub elements: Vec<LinePiece>,
    /// Between the pieces.
    pub pulls: Vec<JointPull>,
    /// The force below which there is no tension left (N): keeps directions defined.
    pub least: f64,
}

/// Where a joint stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointStatus {
    /// Free, with this many of its lift's steps passed.
    Free(usize),
    /// At a step of its lift.
    Step(usize),
    /// On the bottom.
    Bottom,
}

/// A piece of a chain at rest.
#[derive(Clone, Copy, Debug, Default)]
pub struct SegmentSolution {
    /// Horizontal force (N); of a piece that rests, no smaller than the chain's least one.
    pub h: f64,
    /// Vertical force at the upper and at the lower end (N).
    pub v_hi: f64,
    pub v_lo: f64,
    /// Reach (m).
    pub x: f64,
    /// Whether it rests on the bottom.
    pub rests: bool,
    /// Unstretched length on the bottom, and the same stretched (m).
    pub ground: f64,
    pub ground_stretched: f64,
    /// Unstretched length that hangs above the touchdown (m); the whole length when nothing is on the bottom.
    pub above: f64,
    /// The piece when it is free, its upper leg when it rests.
    pub upper: SpanReach,
    /// Its lower leg.
    pub lower: SpanReach,
}

/// A chain at rest.
#[derive(Clone, Debug, Default)]
pub struct LineSolution {
    /// Heights of all the ends of the pieces, the fairlead's first (m above the bottom).
    pub z: Vec<f64>,
    pub held: Vec<SegmentSolution>,
    pub policy: ActiveSet,
    /// Lift at each joint (N, upward).
    pub lifts: Vec<f64>,
    /// Reaction of the bottom at each joint (N, upward).
    pub reactions: Vec<f64>,
    /// Reach (m).
    pub x: f64,
    /// Its derivatives by the horizontal force, and by the fairlead's height.
    pub x_by: [f64; 2],
    /// Derivatives of V at the fairlead by the same.
    pub v_by: [f64; 2],
    /// Derivatives of H and of V at the anchor by the same.
    pub far_h_by: [f64; 2],
    pub far_v_by: [f64; 2],
    /// Largest height left between two known ones (m), and what it makes as a force (N).
    pub left: f64,
    pub unbalance: f64,
    pub iterations: usize,
}

impl MultiSegmentLine {
    /// Rests the chain with the horizontal force `h`, the ends at heights `top` and `bottom` (m); `near` is a policy to
    /// begin with.
    ///
    /// # Errors
    /// [`LineError::NotConverged`].
    pub fn solve_contact(
        &self,
        h: f64,
        top: f64,
        bottom: f64,
        near: Option<&LineSolution>,
    ) -> Result<LineSolution, LineError> {
        let mut rested = ContactProblem::new(self, h, top, bottom, near).solve_active_set()?;
        for (index, (dh, dtop)) in [(1.0, 0.0), (0.0, 1.0)].into_iter().enumerate() {
            let values = self.change(&rested, dh, dtop);
            let lists = [&mut rested.x_by, &mut rested.v_by, &mut rested.far_h_by, &mut rested.far_v_by];
            for (list, value) in lists.into_iter().zip(values) {
                if let Some(position) = list.get_mut(index) {
                    *position = value;
                }
            }
        }
        Ok(rested)
    }

    /// A chain to begin with that nothing holds up.
    pub fn afloat(&self, h: f64) -> LineSolution {
        let held = SegmentSolution { h, ..SegmentSolution::default() };
        let policy =
            ActiveSet { rests: vec![false; self.elements.len()], stands: vec![JointStatus::Free(0); self.pulls.len()] };
        LineSolution { held: vec![held; self.elements.len()], policy, ..LineSolution::default() }
    }

    /// Unstretched length (m).
    pub fn length(&self) -> f64 {
        self.elements.iter().map(LinePiece::length).sum()
    }

    /// How the reach, V at the fairlead, H and V at the anchor change with the horizontal force and the height of the
    /// fairlead.
    fn change(&self, rested: &LineSolution, dh: f64, dtop: f64) -> [f64; 4] {
        let count = self.elements.len();
        let mut dv_hi = vec![0.0; count];
        let mut dv_lo = vec![0.0; count];
        let mut dx = vec![0.0; count];
        for section in rested.policy.sections(count) {
            let start = if section.starts_at_fairlead() { dtop } else { 0.0 };
            let (mut slope, mut given) = (0.0, 0.0);
            for (_, part, _) in section.parts(&rested.held) {
                slope += part.z_v;
                given += part.z_h * dh;
            }
            // a leg without height has no finite stiffness: it does not move
            let change = start - given;
            let dv = if change == 0.0 { 0.0 } else { change / slope };
            for (i, part, lower) in section.parts(&rested.held) {
                let moved = part.x_h * dh + if dv == 0.0 { 0.0 } else { part.x_v * dv };
                let rests = rested.held.get(i).is_some_and(|h| h.rests);
                if let (Some(x), Some(hi), Some(lo)) = (dx.get_mut(i), dv_hi.get_mut(i), dv_lo.get_mut(i)) {
                    *x = if lower { *x + moved } else { moved };
                    if !lower {
                        *hi = dv;
                    }
                    if lower || !rests {
                        *lo = dv;
                    }
                }
            }
        }
        // what lies between the legs; under the least force it has no tension that could change
        let mut far = dh;
        let changes = dx.iter_mut().zip(dv_hi.iter().zip(&dv_lo));
        for ((element, held), (x, (hi, lo))) in self.elements.iter().zip(&rested.held).zip(changes) {
            far = if held.rests && held.h <= self.least { 0.0 } else { dh };
            if held.rests {
                let (strain, by_h) = element.strain(held.h);
                let weight = element.weight_per_length();
                let longer = lo / weight - hi / weight;
                *x += held.ground * by_h * far + (1.0 + strain) * longer;
            }
        }
        let last = self.elements.len() - 1;
        [dx.iter().sum(), dv_hi[0], far, dv_lo[last]]
    }
}
