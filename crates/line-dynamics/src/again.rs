//! A trial that follows another of the same step, as when a body looks for its own motion.

use super::ends::End;
use super::mesh::Rod;
use super::scheme::Scheme;
use super::state::State;
use super::step::{At, Solver};
use super::surroundings::World;
use super::trial::{largest, turn};
use nalgebra::Vector3;

/// Largest move of a node, as a share of the shortest element, that is foretold from the trial before.
const NEAR: f64 = 0.1;
/// A move that is a smaller share of the tolerance than this is made by the linear response alone. An iteration ends by a move
/// within the tolerance without looking again; this one is a hundred times smaller, so that what it leaves of the balance, which
/// goes by its square, is ten thousand times smaller, however many there are in a step.
const SLIGHT: f64 = 1e-2;

/// How a trial has been moved from the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Moved {
    /// Near enough for an iteration with the factors at hand.
    Near,
    /// So little that nothing is left to do: the forces of the ends are taken along, too.
    Slightly,
}

impl Solver {
    /// Takes the end of the last trial as the trial's motion.
    pub(super) fn follow_next(&mut self) {
        self.trial.x.copy_from_slice(&self.next.position);
        self.trial.v.copy_from_slice(&self.next.velocity);
        self.trial.a.copy_from_slice(&self.next.acceleration);
        self.trial.director.copy_from_slice(&self.next.director);
    }

    /// Whether the last trial was one of the same step, made in one part.
    pub(super) fn follows(&self, state: &State, time: f64, ends: &[End; 2]) -> bool {
        let held = |ends: &[End; 2]| ends.map(|e| e.motion.is_some());
        self.at == At::Trial
            && self.whole
            && self.next.time == time
            && held(&self.trial.ends) == held(ends)
            && self.began == *state
    }

    /// Begins a trial where the last one of the step ended, moved by the linear response to what is new in the motion
    /// of the ends; none if the last one is too far away.
    pub(super) fn again(
        &mut self,
        rod: &Rod,
        from: &State,
        world: &World,
        scheme: &Scheme,
        ends: &[End; 2],
    ) -> Option<Moved> {
        let elsewhere = [0, 1].map(|side: usize| self.trial.ends[side].motion != ends[side].motion);
        self.linearise(rod, world, false, elsewhere)?;
        let (stride, last) = (self.work.stride(), rod.elements.len());
        let size = self.change.len();
        let known = ends.map(|e| e.motion.is_some());
        let held = |row: usize| match row.checked_sub(stride * last) {
            Some(axis) if known[1] && axis < 3 => Some((1, axis)),
            _ => (known[0] && row < 3).then_some((0, row)),
        };
        // what the ends themselves feel of velocities and accelerations the scheme does not make
        let mut felt = [Vector3::zeros(); 2];
        // and the moves with which the scheme would make them
        let mut aside: f64 = 0.0;
        self.change.fill(0.0);
        for (side, node) in [(0, 0), (1, last)] {
            let (Some(old), Some(new)) = (self.trial.ends[side].motion, ends[side].motion) else { continue };
            if !elsewhere[side] {
                continue;
            }
            let place = stride * node;
            let moved = new.position - old.position;
            // the matrix has the columns of the ends, with velocity and acceleration as the scheme makes them follow
            let faster = new.velocity - old.velocity - moved * self.weights.c;
            let harder = new.acceleration - old.acceleration - moved * self.weights.m;
            aside = aside.max(faster.amax() / self.weights.c).max(harder.amax() / self.weights.m);
            for axis in 0..3 {
                let by = [&self.near.columns[1][side][axis], &self.near.columns[2][side][axis]];
                for (i, (c, m)) in by[0].iter().zip(by[1]).enumerate() {
                    let row = (place + axis + i + 1).checked_sub(by[0].len().div_ceil(2));
                    let Some(row) = row.filter(|row| *row < size) else { continue };
                    let force = c * faster[axis] + m * harder[axis];
                    match held(row) {
                        Some((side, axis)) => felt[side][axis] += force,
                        None => self.change[row] -= force,
                    }
                }
            }
            self.change[place..place + 3].copy_from_slice(moved.as_slice());
        }
        self.work.solve(&mut self.change);
        let most = largest(&self.change, stride, rod.shortest());
        let share = most / rod.shortest();
        if share > NEAR {
            return None;
        }
        self.near.moved += most;
        let next = &mut self.next;
        turn(&mut next.director, &next.position, &self.change, stride, [false; 2]);
        for i in 0..=last {
            let d = &self.change[stride * i..stride * i + 3];
            next.position[i] += Vector3::new(d[0], d[1], d[2]);
            let u = next.position[i] - from.position[i];
            [next.averaged[i], next.velocity[i], next.acceleration[i]] = scheme.follow(from, i, u);
        }
        for (side, node) in [(0, 0), (1, last)] {
            if let Some(motion) = ends[side].motion {
                next.hold(node, &motion);
            }
        }
        // what holds an end turns it otherwise
        let turned = |side: usize| {
            let (old, new) = (&self.trial.ends[side], &ends[side]);
            old.direction != new.direction || old.side != new.side || old.rotation != new.rotation
        };
        let all = share.max(aside / rod.shortest());
        // supports that have moved are met by an iteration
        if !world.supports.is_empty() {
            return Some(Moved::Near);
        }
        if all > SLIGHT * self.settings.tolerance || turned(0) || turned(1) {
            return Some(Moved::Near);
        }
        self.work.carry_ends(&self.change);
        self.work.add_to_ends(&felt);
        Some(Moved::Slightly)
    }
}
