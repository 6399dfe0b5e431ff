//! The pieces of a line together, at a given tension along the bottom: how they come to rest.
//!
//! Where the line touches the bottom, where a joint lies on it, and where a pendant holds a joint, the height is known.
//! Between such places one number is unknown, the tension along n at the upper one, and the drop grows with it: a
//! safeguarded Newton iteration finds it. Which places these are is found by policy iteration: what sinks below the
//! bottom is put on it, what the bottom would have to hold down is let go, a joint at a step of its lift stays there as
//! long as the lift lies between the two sides of the step. Friction changes the tension along the line, a sloped
//! bottom the height at which a pendant ends; both are brought in by repeating.

use super::element::{Element, Ground, Part};
use super::policy::Policy;
use super::refused::LineError;
use super::settle::Problem;

/// What pulls at a joint.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Pull {
    /// Lift (N, upward) below all its steps.
    pub lift: f64,
    /// Elevations (m above the bottom at the anchor) from which on the lift is smaller, and by how much (N); rising.
    pub steps: Vec<(f64, f64)>,
    /// Whether the bottom carries the joint.
    pub on_bottom: bool,
}

impl Pull {
    /// The lift when this many steps are passed (N).
    pub fn passed(&self, steps: usize) -> f64 {
        self.lift - self.steps.iter().take(steps).map(|s| s.1).sum::<f64>()
    }
}

/// The pieces of a line from the fairlead to the anchor.
#[derive(Clone, Debug)]
pub struct Chain {
    pub elements: Vec<Element>,
    /// Between the pieces.
    pub pulls: Vec<Pull>,
    pub ground: Ground,
}

/// Where a joint stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stand {
    /// Free, with this many of its lift's steps passed.
    Free(usize),
    /// At a step of its lift.
    Step(usize),
    /// On the bottom.
    Bottom,
}

/// A piece of a chain at rest.
#[derive(Clone, Copy, Debug, Default)]
pub struct Held {
    /// Tension along t and n at the upper end (N).
    pub p_hi: f64,
    pub q_hi: f64,
    /// The same at the lower end.
    pub p_lo: f64,
    pub q_lo: f64,
    /// Tension where the piece leaves the bottom toward the anchor (N).
    pub leave: f64,
    /// Reach along t (m).
    pub t: f64,
    /// By how much the tension given at its upper end is too small to leave any at the touchdown (N).
    pub lacks: f64,
    /// Whether it rests on the bottom.
    pub rests: bool,
    /// Unstretched length on the bottom, and the same stretched (m).
    pub ground: f64,
    pub ground_stretched: f64,
    /// Unstretched length that hangs above the touchdown (m); the whole length when nothing is on the bottom.
    pub above: f64,
    /// The piece when it is free, its upper leg when it rests.
    pub upper: Part,
    /// Its lower leg.
    pub lower: Part,
}

/// A chain at rest.
#[derive(Clone, Debug, Default)]
pub struct Rested {
    /// Heights of all the ends of the pieces, the fairlead's first (m along n).
    pub n: Vec<f64>,
    pub held: Vec<Held>,
    pub policy: Policy,
    /// Lift at each joint (N, upward).
    pub lifts: Vec<f64>,
    /// Reaction of the bottom at each joint (N, along n).
    pub reactions: Vec<f64>,
    /// Reach along t (m).
    pub t: f64,
    /// Its derivatives by the tension p at the fairlead, and by the fairlead's height.
    pub t_by: [f64; 2],
    /// Derivatives of q at the fairlead by the same.
    pub q_by: [f64; 2],
    /// Derivatives of p and of q at the anchor by the same.
    pub far_p_by: [f64; 2],
    pub far_q_by: [f64; 2],
    /// Largest height left between two known ones (m), and what it makes as a force (N).
    pub left: f64,
    pub unbalance: f64,
    pub iterations: usize,
}

/// Repetitions for friction and slope.
const MOST_ROUNDS: usize = 200;

impl Chain {
    /// Rests the chain with tension `p` along t at the fairlead, the ends at heights `top` and `bottom` (m); `near` is a
    /// policy to begin with, `at` is the place of the anchor along t (m).
    ///
    /// # Errors
    /// [`LineError::NotConverged`].
    pub fn rest(&self, p: f64, top: f64, bottom: f64, at: f64, near: Option<&Rested>) -> Result<Rested, LineError> {
        let mut problem = Problem::new(self, p, top, bottom, near);
        let mut iterations = 0;
        for round in 0..MOST_ROUNDS {
            let mut rested = problem.settle()?;
            iterations += rested.iterations;
            // smaller steps when it does not come to an end
            let share = 0.5f64.powi(i32::try_from(round / 30).unwrap_or(0));
            let change = if self.coupled() { problem.follow(&rested, p, at, share) } else { 0.0 };
            if change <= 1e-14 || (round > 60 && change <= 1e-11) {
                rested.iterations = iterations;
                self.rates(&mut rested);
                return Ok(rested);
            }
        }
        Err(LineError::NotConverged { force: p, residual: f64::NAN, iterations })
    }

    /// A chain to begin with that nothing holds up.
    pub fn afloat(&self, p: f64) -> Rested {
        let held = Held { p_hi: p, leave: p, ..Held::default() };
        let policy = Policy { rests: vec![false; self.elements.len()], stands: vec![Stand::Free(0); self.pulls.len()] };
        Rested { held: vec![held; self.elements.len()], policy, ..Rested::default() }
    }

    /// Unstretched length (m).
    pub fn length(&self) -> f64 {
        self.elements.iter().map(Element::length).sum()
    }

    /// Whether tensions or steps depend on the shape.
    fn coupled(&self) -> bool {
        self.ground.friction > 0.0 || self.ground.tilt.sin != 0.0
    }

    /// Derivatives of the reach and of q at the fairlead.
    fn rates(&self, rested: &mut Rested) {
        for (index, (dp, dtop)) in [(1.0, 0.0), (0.0, 1.0)].into_iter().enumerate() {
            let values = self.change(rested, dp, dtop);
            let lists = [&mut rested.t_by, &mut rested.q_by, &mut rested.far_p_by, &mut rested.far_q_by];
            for (list, value) in lists.into_iter().zip(values) {
                if let Some(place) = list.get_mut(index) {
                    *place = value;
                }
            }
        }
    }

    /// How the reach, q at the fairlead, p and q at the anchor change with the tension and the height at the fairlead.
    fn change(&self, rested: &Rested, dp: f64, dtop: f64) -> [f64; 4] {
        let count = self.elements.len();
        let Ground { tilt, friction, least } = self.ground;
        let mut dps = vec![dp; count];
        let mut dleaves = vec![dp; count];
        // places of the joints along t: a pendant's end moves with them over a slope
        let mut dplaces = vec![0.0; count + 1];
        let mut dq_hi = vec![0.0; count];
        let mut dq_lo = vec![0.0; count];
        let mut dt = vec![0.0; count];
        let mut far = dp;
        for _ in 0..MOST_ROUNDS {
            for section in rested.policy.sections(count) {
                let start = match section.start_joint() {
                    None if section.starts_free() => 0.0,
                    None => dtop,
                    Some(j) => self.step_change(rested, j, &dplaces),
                };
                let end = section.end_joint(count).map_or(0.0, |j| self.step_change(rested, j, &dplaces));
                let (mut slope, mut given) = (0.0, 0.0);
                for (i, part, lower) in section.parts(&rested.held) {
                    let list = if lower { &dleaves } else { &dps };
                    slope += part.n_q;
                    given += part.n_p * list.get(i).copied().unwrap_or(0.0);
                }
                // a leg without height has no stiffness that could be told: it does not move
                let change = start - end - given;
                let dq = if change == 0.0 { 0.0 } else { change / slope };
                for (i, part, lower) in section.parts(&rested.held) {
                    let list = if lower { &dleaves } else { &dps };
                    let by_p = part.t_p * list.get(i).copied().unwrap_or(0.0);
                    let moved = by_p + if dq == 0.0 { 0.0 } else { part.t_q * dq };
                    let rests = rested.held.get(i).is_some_and(|h| h.rests);
                    if let (Some(t), Some(hi), Some(lo)) = (dt.get_mut(i), dq_hi.get_mut(i), dq_lo.get_mut(i)) {
                        *t = if lower { *t + moved } else { moved };
                        if !lower {
                            *hi = dq;
                        }
                        if lower || !rests {
                            *lo = dq;
                        }
                    }
                }
            }
            // what lies between the legs, and the tension that goes on
            let mut next = vec![dp];
            let mut next_leaves = Vec::with_capacity(count);
            for (i, (element, held)) in self.elements.iter().zip(&rested.held).enumerate() {
                let at = |list: &[f64]| list.get(i).copied().unwrap_or(0.0);
                let mut leave = at(&dps);
                let mut out = leave;
                if held.rests {
                    let (across, along) = element.per_length(&self.ground);
                    let (s_up, s_low) = (at(&dq_hi) / across, -at(&dq_lo) / across);
                    let touching = held.p_hi - along * held.above;
                    let touch = if touching > least { at(&dps) - along * s_up } else { 0.0 };
                    let rest = element.rest(&self.ground, touching.max(least), held.ground);
                    let shorter = -s_up - s_low;
                    leave = rest.p_p * touch + rest.p_s * shorter;
                    out = leave - along * s_low;
                    if let Some(t) = dt.get_mut(i) {
                        *t += rest.t_p * touch + rest.t_s * shorter;
                    }
                }
                next_leaves.push(leave);
                far = out;
                let Some(stand) = rested.policy.stands.get(i) else { continue };
                let line = at(&dq_lo) - dq_hi.get(i + 1).copied().unwrap_or(0.0);
                let change = match stand {
                    Stand::Step(_) => out - line / tilt.cos * tilt.sin,
                    Stand::Bottom => out + friction * line,
                    Stand::Free(_) => out,
                };
                let lies = *stand == Stand::Bottom;
                let floored = lies && rested.held.get(i + 1).is_some_and(|h| h.p_hi <= least);
                next.push(if floored { 0.0 } else { change });
            }
            let mut places = vec![0.0];
            let mut place = 0.0;
            for change in dt.iter().rev() {
                place += change;
                places.push(place);
            }
            places.reverse();
            let off = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
            let forces = off(&next, &dps).max(off(&next_leaves, &dleaves));
            let size = next.iter().fold(dp.abs(), |m: f64, v| m.max(v.abs()));
            let same = !self.coupled()
                || (forces <= 1e-13 * size
                    && (tilt.sin == 0.0 || off(&places, &dplaces) <= 1e-13 * (place.abs() + dtop.abs())));
            (dps, dleaves, dplaces) = (next, next_leaves, places);
            if same {
                break;
            }
        }
        let end = |list: Option<&f64>| list.copied().unwrap_or(0.0);
        [dt.iter().sum(), end(dq_hi.first()), far, end(dq_lo.last())]
    }

    /// How the height of a joint that stands fast changes: at the end of a pendant over a slope.
    fn step_change(&self, rested: &Rested, joint: usize, dplaces: &[f64]) -> f64 {
        match rested.policy.stands.get(joint) {
            Some(Stand::Step(_)) => {
                let tilt = self.ground.tilt;
                -dplaces.get(joint + 1).copied().unwrap_or(0.0) * tilt.sin / tilt.cos
            }
            _ => 0.0,
        }
    }
}
