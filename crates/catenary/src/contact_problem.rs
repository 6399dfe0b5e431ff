//! Active-set iteration for seabed contact of a line of several segments, at a given horizontal force.
//!
//! With the active set given, the vertical force at the top of each stretch follows by a safeguarded Newton iteration on its drop; a
//! solution beside is the warm start. Then the set is changed where the solution contradicts it: everywhere at once for the first
//! `MAX_JOINT_CHANGES` changes, then where it is furthest off alone, against cycling. Lines with friction or on a slope are laid by
//! `layout` instead.

use super::active_set::{ActiveSet, LineStretch, first_policy};
use super::element::LinePiece;
use super::error::LineError;
use super::multi_segment::{JointStatus, LineSolution, MultiSegmentLine, SegmentSolution};
use super::segment::SpanReach;
use windlass_nonlinear::{Convergence, NewtonBracket, NewtonSearch};

/// A chain to be rested at a given horizontal force.
pub struct ContactProblem<'a> {
    chain: &'a MultiSegmentLine,
    top: f64,
    bottom: f64,
    /// Horizontal force (N), and that of what touches the bottom: no smaller than the chain's least one.
    h: f64,
    h_touching: f64,
    policy: ActiveSet,
    /// Vertical forces of the last solution, to begin with.
    near: Vec<(f64, f64)>,
}

/// Changes of the policy all at once, and after that one at a time.
const MAX_JOINT_CHANGES: usize = 30;
const MAX_SINGLE_CHANGES: usize = 300;
/// Newton steps after which a search gives up.
const MAX_NEWTON_ITERATIONS: usize = 200;

impl<'a> ContactProblem<'a> {
    pub fn new(
        chain: &'a MultiSegmentLine,
        h: f64,
        top: f64,
        bottom: f64,
        near: Option<&LineSolution>,
    ) -> ContactProblem<'a> {
        // of the same elements and joints: from here on the lists of a policy are as long as those of the chain
        let near = near.filter(|n| {
            let policy = &n.policy;
            n.held.len() == chain.elements.len()
                && policy.rests.len() == chain.elements.len()
                && policy.stands.len() == chain.pulls.len()
        });
        ContactProblem {
            chain,
            top,
            bottom,
            h,
            h_touching: h.max(chain.least),
            policy: near.map_or_else(|| first_policy(chain), |n| n.policy.clone()),
            near: near.map_or_else(Vec::new, vertical_forces),
        }
    }

    /// Policy iteration.
    ///
    /// # Errors
    /// A search that finds no root, or a set of touching joints that goes on changing.
    pub fn solve_active_set(&mut self) -> Result<LineSolution, LineError> {
        let mut iterations = 0;
        for change in 0..MAX_SINGLE_CHANGES {
            let rested = self.solve()?;
            iterations += rested.iterations;
            let next = self.better(&rested, change >= MAX_JOINT_CHANGES);
            if next == self.policy {
                return Ok(LineSolution { iterations, ..rested });
            }
            self.near = vertical_forces(&rested);
            self.policy = next;
        }
        Err(LineError::NotConverged { force: self.h, residual: f64::NAN, iterations })
    }

    /// The height of a joint that stands fast.
    fn height(&self, joint: usize) -> f64 {
        match self.policy.stands.get(joint) {
            Some(JointStatus::Step(k)) => self.chain.pulls[joint].steps[*k].0,
            _ => 0.0,
        }
    }

    /// The chain under the present policy.
    fn solve(&self) -> Result<LineSolution, LineError> {
        let count = self.chain.elements.len();
        let mut rested = LineSolution { policy: self.policy.clone(), ..LineSolution::default() };
        let start = |rests: &bool| SegmentSolution {
            h: if *rests { self.h_touching } else { self.h },
            rests: *rests,
            ..SegmentSolution::default()
        };
        rested.held = self.policy.rests.iter().map(start).collect();
        for section in self.policy.sections(count) {
            let from =
                section.start_joint().map_or(if section.begins_with_leg { 0.0 } else { self.top }, |j| self.height(j));
            let to = match section.end_joint(count) {
                Some(j) => self.height(j),
                None if section.ends_with_leg => 0.0,
                None => self.bottom,
            };
            self.solve_section(&section, from - to, &mut rested)?;
        }
        for (element, held) in self.chain.elements.iter().zip(&mut rested.held) {
            if !held.rests {
                (held.x, held.above) = (held.upper.x, element.length());
                continue;
            }
            let (above, below) = (element.leg(held.v_hi), element.leg(held.v_lo));
            held.above = above;
            held.ground = element.length() - above - below;
            held.ground_stretched = held.ground.max(0.0) * (1.0 + element.strain(held.h).0);
            held.x = held.upper.x + held.lower.x + held.ground_stretched;
        }
        let mut z = self.top;
        rested.z.push(z);
        for (i, held) in rested.held.iter().enumerate() {
            z = match self.policy.stands.get(i) {
                None => self.bottom,
                Some(JointStatus::Free(_)) if held.rests => -held.lower.z,
                Some(JointStatus::Free(_)) => z - held.upper.z,
                Some(_) => self.height(i),
            };
            rested.z.push(z);
        }
        let joints = self.chain.pulls.iter().zip(&self.policy.stands);
        for ((pull, stand), (above, below)) in joints.zip(rested.held.iter().zip(rested.held.iter().skip(1))) {
            let line = above.v_lo - below.v_hi;
            let (lift, reaction) = match stand {
                JointStatus::Free(k) => (pull.lift_after(*k), 0.0),
                JointStatus::Step(_) => (-line, 0.0),
                JointStatus::Bottom => (pull.lift, -line - pull.lift),
            };
            rested.lifts.push(lift);
            rested.reactions.push(reaction);
        }
        rested.x = rested.held.iter().map(|h| h.x).sum();
        Ok(rested)
    }

    /// The vertical force at the upper end of a section, from its drop.
    fn solve_section(&self, section: &LineStretch, drop: f64, rested: &mut LineSolution) -> Result<(), LineError> {
        let elements = &self.chain.elements;
        let run: Vec<(usize, &LinePiece)> =
            elements.iter().enumerate().skip(section.from).take(section.to + 1 - section.from).collect();
        let lone_leg = run.len() == 1 && (section.begins_with_leg || section.ends_with_leg);
        if lone_leg && drop == 0.0 {
            for held in rested.held.iter_mut().skip(section.from).take(1) {
                let none = SpanReach { z_v: f64::INFINITY, ..SpanReach::default() };
                if section.begins_with_leg {
                    (held.v_lo, held.lower) = (0.0, none);
                } else {
                    (held.v_hi, held.upper) = (0.0, none);
                }
            }
            return Ok(());
        }
        let walk = |v: f64, held: &mut [SegmentSolution]| {
            let (mut v, mut z, mut z_v) = (v, 0.0, 0.0);
            for (i, element) in &run {
                let Some(held) = held.get_mut(*i) else { continue };
                let part = if *i == section.from && section.begins_with_leg {
                    held.lower = element.lower_leg(held.h, v);
                    held.v_lo = v;
                    held.lower
                } else if *i == section.to && section.ends_with_leg {
                    held.upper = element.upper_leg(held.h, v);
                    held.v_hi = v;
                    held.upper
                } else {
                    held.upper = element.whole(held.h, v);
                    held.v_hi = v;
                    held.v_lo = v - element.weight();
                    held.upper
                };
                z += part.z;
                z_v += part.z_v;
                if let (Some(JointStatus::Free(k)), Some(pull)) = (self.policy.stands.get(*i), self.chain.pulls.get(*i))
                {
                    v = held.v_lo + pull.lift_after(*k);
                }
            }
            (z, z_v)
        };
        let length: f64 = run.iter().map(|(_, e)| e.length()).sum();
        let weight: f64 = run.iter().map(|(_, e)| e.weight()).sum();
        let pulled: f64 = run.iter().filter_map(|(i, _)| self.chain.pulls.get(*i)).map(|p| p.lift.abs()).sum();
        let h = self.h;
        let near = self.near.get(section.from).map(|(hi, lo)| if section.begins_with_leg { *lo } else { *hi });
        let steepness = (drop / length.max(f64::MIN_POSITIVE)).clamp(-2.0, 2.0);
        let mut v = near.filter(|v| v.is_finite()).unwrap_or(0.5 * weight + h * steepness);
        if lone_leg && v == 0.0 {
            v = drop.signum() * (h + weight.abs()) * 1e-3;
        }
        let fine = 2.0 * f64::EPSILON * (length + drop.abs());
        let mut search = NewtonSearch::new(NewtonBracket::OPEN, weight.abs() + pulled + h);
        let mut convergence = Convergence::new(fine);
        let mut best = (f64::INFINITY, v, f64::INFINITY);
        let mut steps = 0;
        while steps < MAX_NEWTON_ITERATIONS {
            steps += 1;
            let (z, z_v) = walk(v, &mut rested.held);
            let off = z - drop;
            if !off.is_finite() {
                break;
            }
            let status = convergence.record(off.abs());
            if status.is_improved() {
                best = (off.abs(), v, z_v);
            }
            if status.is_final() {
                break;
            }
            let next = search.advance(v, off, v - off / z_v);
            if next == v || search.bracket.is_narrower_than(4.0) {
                break;
            }
            v = next;
        }
        let (off, v, z_v) = best;
        walk(v, &mut rested.held);
        let tension = rested.held.iter().fold(h, |m: f64, held| m.max(held.v_hi.abs()));
        rested.iterations += steps;
        rested.left = rested.left.max(off);
        rested.unbalance = rested.unbalance.max(off / z_v);
        if off <= 1e-12 * length || off <= 1e-10 * tension * z_v {
            return Ok(());
        }
        Err(LineError::NotConverged { force: h, residual: off, iterations: steps })
    }

    /// The policy that a solution asks for; `one` changes only what is furthest off.
    fn better(&self, rested: &LineSolution, one: bool) -> ActiveSet {
        let length = self.chain.length();
        let fine = 1e-12 * length;
        let largest = |m: f64, held: &SegmentSolution| m.max(held.v_hi.abs()).max(held.v_lo.abs()).max(held.h);
        let size = rested.held.iter().fold(self.chain.least, largest);
        let small = 1e-12 * size;
        // by how much a piece or joint is off, and what it becomes
        let mut pieces: Vec<(f64, usize)> = Vec::new();
        let mut joints: Vec<(f64, usize, JointStatus)> = Vec::new();
        // heights of the upper and the lower end of each piece
        let ends = rested.z.iter().zip(rested.z.iter().skip(1));
        let held = self.chain.elements.iter().zip(&rested.held).zip(ends.clone());
        for (i, ((element, held), (high, low))) in held.enumerate() {
            if held.rests {
                let broken = held.ground < -fine || held.v_hi < -small || held.v_lo > small;
                if broken {
                    pieces.push(((-held.ground / length).max(1e-12), i));
                }
            } else if element.can_rest() {
                let lowest = self.lowest(element, held, *high, *low);
                if lowest < -fine {
                    pieces.push((-lowest / length, i));
                }
            }
        }
        let loads = rested.lifts.iter().zip(&rested.reactions);
        let joints_now = rested.policy.stands.iter().zip(&self.chain.pulls).zip(loads).zip(ends);
        for (j, (((stand, pull), (&lift, &reaction)), (_, &height))) in joints_now.enumerate() {
            let step = |k: usize| pull.steps.get(k).map(|(z, _)| *z);
            match *stand {
                JointStatus::Free(k) => {
                    let floor = pull.on_bottom.then_some(0.0);
                    let under = k.checked_sub(1).and_then(step);
                    let (low, next) = match (under, floor) {
                        (Some(u), Some(f)) if f > u => (f, JointStatus::Bottom),
                        (Some(u), _) => (u, JointStatus::Step(k - 1)),
                        (None, Some(f)) => (f, JointStatus::Bottom),
                        (None, None) => (f64::NEG_INFINITY, JointStatus::Bottom),
                    };
                    if height < low - fine {
                        joints.push(((low - height) / length, j, next));
                    } else if let Some(above) = step(k)
                        && height > above + fine
                    {
                        joints.push(((height - above) / length, j, JointStatus::Step(k)));
                    }
                }
                JointStatus::Bottom => {
                    if reaction < -small {
                        joints.push((-reaction / size, j, JointStatus::Free(0)));
                    }
                }
                JointStatus::Step(k) => {
                    let (most, least) = (pull.lift_after(k), pull.lift_after(k + 1));
                    if lift > most + small {
                        joints.push(((lift - most) / size, j, JointStatus::Free(k)));
                    } else if lift < least - small {
                        joints.push(((least - lift) / size, j, JointStatus::Free(k + 1)));
                    }
                }
            }
        }
        let mut policy = rested.policy.clone();
        let worst = pieces.iter().map(|p| p.0).chain(joints.iter().map(|j| j.0)).fold(0.0, f64::max);
        let mut left = if one { 1 } else { usize::MAX };
        for (off, i) in pieces {
            if let Some(rests) = policy.rests.get_mut(i).filter(|_| left > 0 && (!one || off >= worst)) {
                *rests = !*rests;
                left -= 1;
            }
        }
        for (off, j, next) in joints {
            if let Some(stand) = policy.stands.get_mut(j).filter(|_| left > 0 && (!one || off >= worst)) {
                *stand = next;
                left -= 1;
            }
        }
        policy
    }

    /// The height of the lowest point of a free piece.
    fn lowest(&self, element: &LinePiece, held: &SegmentSolution, hi: f64, lo: f64) -> f64 {
        if held.v_lo < 0.0 && held.v_hi > 0.0 {
            hi - element.upper_leg(self.h_touching, held.v_hi).z
        } else {
            hi.min(lo)
        }
    }
}

fn vertical_forces(rested: &LineSolution) -> Vec<(f64, f64)> {
    rested.held.iter().map(|h| (h.v_hi, h.v_lo)).collect()
}
