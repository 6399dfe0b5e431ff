//! Stiff ties whose forces are unknowns: held while bodies move, and followed by what a Newton step makes of them.
//!
//! A Newton step of bodies and forces together, the forces taken out, is that of the tie's own law: `(K + G'kG) dx = r(f) + G'(k q - f)`, with
//! the residual `r` under the force `f` that is held and the excess of the law over it. Then `f` becomes `k (q + G dx)`, in which rounding
//! of places cancels, and what is left on the bodies does not feel it.

use super::link::EndAttachment;
use nalgebra::{DVector, Matrix6, Vector3};
use windlass_base::pose::Six;
use windlass_hydro::move_wrench;
use windlass_model::TieResponse;

/// A tie at the places of its ends.
#[derive(Debug)]
struct TieAtEnds {
    tie: TieResponse,
    /// Of each end its body and the arm from there (m, global); none in the ground.
    ends: [Option<(usize, Vector3<f64>)>; 2],
    /// -d(wrench)/d(motion) of the ends, two by two.
    stiffness: Vec<Matrix6<f64>>,
}

/// The ties of a system, and the forces that are held.
#[derive(Debug, Default)]
pub(crate) struct Ties {
    /// Whether forces are held; else those of the law act.
    pub holds: bool,
    /// The force of each connector that is a tie.
    pub forces: Vec<Option<Six>>,
    /// What the laws have beyond the forces held, six a body about its origin, global axes (N, N m).
    pub excess: DVector<f64>,
    made: Vec<(usize, TieAtEnds)>,
}

impl Ties {
    /// Nothing is evaluated yet, of so many connectors and bodies.
    pub fn begin(&mut self, links: usize, bodies: usize) {
        self.made.clear();
        self.forces.resize(links, None);
        if self.excess.nrows() != 6 * bodies {
            self.excess = DVector::zeros(6 * bodies);
        }
        self.excess.fill(0.0);
    }

    /// Takes what a connector answered as a tie.
    pub fn take(
        &mut self,
        link: usize,
        tie: TieResponse,
        stiffness: &[Matrix6<f64>],
        (ends, arms): (&[EndAttachment], &[Vector3<f64>]),
    ) {
        if let Some(force) = self.forces.get_mut(link) {
            force.get_or_insert(tie.force);
        }
        let mut on = [None, None];
        for (((slot, end), arm), excess) in on.iter_mut().zip(ends).zip(arms).zip(&tie.excess) {
            if let EndAttachment::Body(body, _) = end {
                *slot = Some((*body, *arm));
                let mut at = self.excess.fixed_rows_mut::<6>(6 * body);
                at += move_wrench(excess, *arm);
            }
        }
        self.made.push((link, TieAtEnds { tie, ends: on, stiffness: stiffness.to_vec() }));
    }

    pub fn is_empty(&self) -> bool {
        self.made.is_empty()
    }

    /// The largest deflection that a force held does not explain (m, rad).
    pub fn gap(&self) -> f64 {
        self.made.iter().map(|(_, held)| held.tie.gap).fold(0.0, f64::max)
    }

    /// The forces behind motions of the bodies: translation and rotation vector, global axes.
    pub fn predict(&self, motion: &dyn Fn(usize) -> Six) -> Vec<Option<Six>> {
        let mut forces = self.forces.clone();
        for (link, held) in &self.made {
            let mut force = held.tie.force;
            for (end, slopes) in held.ends.iter().zip(&held.tie.slopes) {
                if let Some((body, arm)) = end {
                    force += slopes * moved_end(&motion(*body), arm);
                }
            }
            if let Some(slot) = forces.get_mut(*link) {
                *slot = Some(force);
            }
        }
        forces
    }

    /// The stiffness of the ties, block by block: the row's body, the column's and -d(wrench about its origin)/d(motion) (N/m, N, N m).
    pub fn blocks(&self) -> Vec<(usize, usize, Matrix6<f64>)> {
        let mut list = Vec::new();
        for (_, held) in &self.made {
            for (i, row) in held.ends.iter().enumerate() {
                for (j, column) in held.ends.iter().enumerate() {
                    if let (Some((body, own)), Some((other, far)), Some(block)) =
                        (row, column, held.stiffness.get(2 * i + j))
                    {
                        list.push((*body, *other, windlass_hydro::move_stiffness(block, *own, *far)));
                    }
                }
            }
        }
        list
    }

    /// Only ties between bodies that count, and to the ground, are left to follow motions.
    pub fn keep(&mut self, counts: &dyn Fn(usize) -> bool) {
        self.made.retain(|(_, held)| held.ends.iter().flatten().all(|(body, _)| counts(*body)));
    }
}

/// The motion of a point of a body that moves: translation and rotation vector.
fn moved_end(motion: &Six, arm: &Vector3<f64>) -> Six {
    let turn = Vector3::new(motion[3], motion[4], motion[5]);
    let by_turn = turn.cross(arm);
    motion + Six::new(by_turn.x, by_turn.y, by_turn.z, 0.0, 0.0, 0.0)
}

/// Forces between two lists: those of the first and a share of the way to the second.
pub(crate) fn interpolate_forces(from: &[Option<Six>], to: &[Option<Six>], share: f64) -> Vec<Option<Six>> {
    let one = |(from, to): (&Option<Six>, &Option<Six>)| match (from, to) {
        (Some(from), Some(to)) => Some(from + (to - from) * share),
        (_, to) => *to,
    };
    from.iter().zip(to).map(one).collect()
}
