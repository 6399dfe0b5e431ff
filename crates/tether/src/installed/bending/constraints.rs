//! What an installed tether is held by beside its ends: constraints, openings of the structure, rigid coils.
//!
//! What is held rigidly has its acceleration given, and its place and velocity put right at the start of each step; the edge of an opening
//! wider than the tether is a spring.

use super::{Bending, LOOK_AHEAD, OPENING_EDGE_STIFFNESS_RATIO, Stage};
use crate::installed::axis::{TetherAxis, tilt};
use nalgebra::Vector3;

/// What an unknown is held to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum DofConstraint {
    /// The axis: an end.
    Axis,
    /// A place across, vertical over the anchor.
    Fixed,
    /// The middle of an opening.
    Opening,
    /// The vertical.
    Vertical,
    /// The structure's upright axis.
    Upright,
}

impl Bending {
    /// Takes the springs of the ends for at rest along an axis, the structure standing as it does.
    pub fn rest_along(&mut self, axis: &TetherAxis, upright: Vector3<f64>) {
        let vessel = tilt(upright);
        self.rest = [axis.tilt, [0, 1].map(|p| axis.tilt[p] - vessel[p])];
    }

    /// Puts what is held where it is held, at the start of a step.
    pub fn place_held(&mut self, stage: &Stage) {
        for plane in 0..2 {
            for index in 0..self.held[plane].len() {
                let (unknown, hold) = self.held[plane][index];
                let [position, velocity, _] = self.target(unknown, hold, plane, stage);
                self.now[plane].deflection[unknown] = position;
                self.now[plane].velocity[unknown] = velocity;
            }
        }
    }

    /// What an unknown is held to: place, velocity and acceleration in the moving axis.
    fn target(&self, unknown: usize, hold: DofConstraint, plane: usize, stage: &Stage) -> [f64; 3] {
        let Stage { axis, attachment, tension, .. } = stage;
        let parts = |v: Vector3<f64>| axis.parts(v)[plane];
        let [rate, growth] =
            [parts(attachment.velocity) / tension.length, parts(attachment.acceleration) / tension.length];
        let share = self.shares[unknown / 2];
        // the springs' rest counts at the ends alone
        let last = self.right.len() - 1;
        let rest = |end: usize| if unknown == [1, last][end] { self.rest[end][plane] } else { 0.0 };
        let turn = |v: Vector3<f64>| if plane == 0 { v.y } else { -v.x };
        match hold {
            DofConstraint::Axis => [0.0; 3],
            DofConstraint::Vertical => [rest(0) - axis.tilt[plane], -rate, -growth],
            DofConstraint::Upright => {
                let [spin, change] = attachment.spin;
                let position = rest(1) + tilt(attachment.upright)[plane] - axis.tilt[plane];
                [position, turn(spin) - rate, turn(change) - growth]
            }
            DofConstraint::Fixed => {
                let at = anchor(stage) + Vector3::z() * (share * tension.length);
                let [here, speed, change] = self.on_axis(share, stage);
                [parts(at - here), -parts(speed), -parts(change)]
            }
            DofConstraint::Opening => {
                let [at, velocity, acceleration] = self.opening(share, stage);
                let [here, speed, change] = self.on_axis(share, stage);
                [parts(at - here), parts(velocity - speed), parts(acceleration - change)]
            }
        }
    }

    /// A point of the axis: place, velocity, acceleration (global).
    fn on_axis(&self, share: f64, stage: &Stage) -> [Vector3<f64>; 3] {
        let end = stage.attachment;
        let at = end.at - stage.axis.along * ((1.0 - share) * stage.tension.length);
        [at, end.velocity * share, end.acceleration * share]
    }

    /// The middle of an opening of the structure: place, velocity, acceleration (global).
    fn opening(&self, share: f64, stage: &Stage) -> [Vector3<f64>; 3] {
        let end = stage.attachment;
        let arm = -end.upright * ((1.0 - share) * stage.tension.length);
        let [spin, change] = end.spin;
        let turning = spin.cross(&arm);
        [end.at + arm, end.velocity + turning, end.acceleration + change.cross(&arm) + spin.cross(&turning)]
    }

    /// The edge of each opening that a node is at, as a spring.
    pub(super) fn edges(&mut self, second: bool, plane: usize, stage: &Stage) {
        for index in 0..self.openings.len() {
            let (unknown, gap) = self.openings[index];
            let motion = if second { &self.trial } else { &self.now };
            let share = self.shares[unknown / 2];
            let [here, ..] = self.on_axis(share, stage);
            let [middle, ..] = self.opening(share, stage);
            let middle = stage.axis.parts(middle - here);
            let off = [0, 1].map(|p| motion[p].deflection[unknown] - middle[p]);
            let far = off[0].hypot(off[1]);
            if far <= gap {
                continue;
            }
            let spring = OPENING_EDGE_STIFFNESS_RATIO * self.mass.get(unknown, unknown) / (stage.dt * stage.dt);
            let edge = middle[plane] + off[plane] * (gap / far);
            self.stiffness[plane].add(unknown, unknown, spring);
            self.right[unknown] += spring * edge;
            let push = stage.axis.across[plane] * (spring * (motion[plane].deflection[unknown] - edge));
            self.pushes.push((push, here + middle[0] * stage.axis.across[0] + middle[1] * stage.axis.across[1]));
        }
    }

    /// Gives what is held its acceleration.
    pub(super) fn hold(&mut self, plane: usize, stage: &Stage) {
        for index in 0..self.held[plane].len() {
            let (unknown, hold) = self.held[plane][index];
            let [_, _, acceleration] = self.target(unknown, hold, plane, stage);
            if acceleration != 0.0 {
                let reach = unknown.saturating_sub(3)..(unknown + 4).min(self.right.len());
                for other in reach.filter(|other| *other != unknown) {
                    self.right[other] -= self.system.get(other.max(unknown), other.min(unknown)) * acceleration;
                }
            }
            self.system.hold(unknown, 1.0);
            self.right[unknown] = acceleration;
        }
    }

    /// What the constraints on the structure do to it, by what is missing in the balance of the unknowns they hold.
    pub(super) fn react(&mut self, second: bool, plane: usize, stage: &Stage) {
        if !self.held[plane].iter().any(|h| h.1 == DofConstraint::Opening) {
            return;
        }
        self.frame_acceleration(plane, stage);
        let found = &self.found[usize::from(second)][plane];
        for (frame, a) in self.frame.iter_mut().zip(found) {
            *frame += a;
        }
        let now = &self.now[plane];
        let moving = now.deflection.iter().zip(&now.velocity).zip(found);
        for (ahead, ((x, v), a)) in self.ahead.iter_mut().zip(moving) {
            *ahead = x + LOOK_AHEAD * stage.dt * (v + 0.5 * stage.dt * a);
        }
        for index in 0..self.held[plane].len() {
            let (unknown, hold) = self.held[plane][index];
            if hold != DofConstraint::Opening {
                continue;
            }
            let reach = unknown.saturating_sub(3)..(unknown + 4).min(self.right.len());
            let mut push = 0.0;
            for other in reach {
                let (row, column) = (other.max(unknown), other.min(unknown));
                push += self.mass.get(row, column) * self.frame[other];
                push += self.stiffness[plane].get(row, column) * self.ahead[other];
            }
            let element = unknown / 2;
            let load = |e: Option<usize>, i: usize| e.and_then(|e| self.loads[plane].get(e)).map_or(0.0, |l| l[i]);
            push += self.tension_ahead[usize::from(second)] * self.arc_slope[plane][unknown];
            push -= load(Some(element), 0) + load(element.checked_sub(1), 2);
            let share = self.shares[element];
            let [at, ..] = self.opening(share, stage);
            self.pushes.push((stage.axis.across[plane] * -push, at));
        }
    }
}

/// The anchor of a stage's axis.
fn anchor(stage: &Stage) -> Vector3<f64> {
    stage.attachment.at - stage.axis.along * stage.axis.chord
}
