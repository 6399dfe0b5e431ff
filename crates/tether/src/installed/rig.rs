//! One tether of a run: where it is, how it stands, what it does to the structure, what its elements bear.

use super::axis::{AxisAttachment, TetherAxis};
use super::bending::{Bending, PlaneMotion, Stage};
use super::stress::{EndLoads, Stresses};
use super::tension::{TensionCase, TensionModel, TetherTension};
use super::tether::InstalledTether;
use crate::compatibility::{Compatibility, SpringReference};
use crate::structure::flow::FlowAt;
use nalgebra::{Matrix3, Matrix6, Vector3};
use windlass_base::pose::{Pose, Six};
use windlass_hydro::{cross, move_wrench};
use windlass_model::ClassError;

/// Which of the two stages of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepStage {
    /// The one at its start.
    First,
    /// The one at its end as predicted.
    Second,
}

/// A tether under way.
#[derive(Clone, Debug)]
pub struct Rig {
    tether: InstalledTether,
    axial: TensionModel,
    bending: Bending,
    axis: TetherAxis,
    attachment: AxisAttachment,
    tension: TetherTension,
    /// How it stood, and the tension and axis of it, at the start of the step.
    start: (TetherAxis, TetherTension),
    before: Option<TensionCase>,
    /// Axial stress of the last impact (Pa), and its time (s).
    impact: Option<(f64, f64)>,
    ends: Vec<[EndLoads; 2]>,
    stresses: Vec<[Stresses; 2]>,
}

/// What changes in how a tether stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RigChange {
    /// It has become slack, or is so at the start of the run.
    Slack,
    /// It is in tension again after it was slack, and has struck its upper anchor constraint.
    Impact {
        /// Closing velocity (m/s).
        velocity: f64,
        /// Axial stress that the impact makes (Pa).
        stress: f64,
    },
    /// Its lower end has fallen on the lower stop.
    LowerStop {
        /// How far it is below the anchor (m).
        drop: f64,
    },
}

impl Rig {
    /// A tether straight between its ends and at rest, in water of a density (kg/m3) under a gravity (m/s2).
    ///
    /// # Errors
    /// Those of [`InstalledTether::check`].
    pub fn new(
        tether: InstalledTether,
        [density, gravity]: [f64; 2],
        compatibility: &Compatibility,
    ) -> Result<Self, ClassError> {
        tether.check()?;
        let elements = tether.line.elements().len();
        Ok(Rig {
            axial: TensionModel::new(&tether, [density, gravity], compatibility.uniform_tension),
            bending: Bending::new(&tether, density, gravity),
            axis: TetherAxis::default(),
            attachment: AxisAttachment::default(),
            tension: TetherTension::default(),
            start: (TetherAxis::default(), TetherTension::default()),
            before: None,
            impact: None,
            ends: vec![[EndLoads::default(); 2]; elements],
            stresses: vec![[Stresses::default(); 2]; elements],
            tether,
        })
    }

    /// Finds axis and tension for a pose of the structure, and gives what the tether does to it about its centre of gravity.
    pub(super) fn pull(
        &mut self,
        which: StepStage,
        (pose, velocity): (&Pose, &Six),
        water: &FlowAt,
        compatibility: &Compatibility,
    ) -> Result<Six, ClassError> {
        self.attachment = AxisAttachment::new(self.tether.attachment, pose, velocity);
        let Some(axis) = TetherAxis::new(self.tether.anchor, self.attachment.at) else {
            return Err(ClassError::new("its attachment is at the anchor or straight below it"));
        };
        self.axis = axis;
        if self.before.is_none() && compatibility.springs == SpringReference::InitialAxis {
            self.bending.rest_along(&axis, self.attachment.upright);
        }
        if which == StepStage::First {
            // what is held goes by the length; that of a slack one differs by its slack alone
            self.tension = TetherTension { length: axis.chord, ..self.tension };
            let Rig { bending, axis, attachment, tension, .. } = self;
            bending.place_held(&Stage { axis, attachment, tension, water, dt: 0.0 });
        }
        let motion = self.motion(which);
        let arc = self.bending.arc(motion, axis.chord);
        let tension = self.axial.tension(&axis, self.attachment.at.z, arc, water);
        let slopes = self.bending.top_slopes(motion);
        let coil = self.bending.coil(motion, &axis, self.attachment.upright);
        self.tension = tension;
        if which == StepStage::First {
            self.start = (axis, tension);
        }
        let stage = Stage { axis: &self.axis, attachment: &self.attachment, tension: &self.tension, water, dt: 0.0 };
        self.bending.gather(which == StepStage::Second, &stage, &self.axial);
        let across = if compatibility.tension_alone_on_structure {
            slopes.map(|slope| slope * tension.pull)
        } else {
            self.bending.top_shear(which == StepStage::Second, &tension, &self.axial)
        };
        let force = -(axis.along * tension.pull + axis.across[0] * across[0] + axis.across[1] * across[1]);
        let arm = self.attachment.at - pose.origin;
        let mut sum = move_wrench(&Six::new(force.x, force.y, force.z, 0.0, 0.0, 0.0), arm);
        if !compatibility.tension_alone_on_structure {
            let moment = axis.across[1] * coil[0] - axis.across[0] * coil[1];
            sum += Six::new(0.0, 0.0, 0.0, moment.x, moment.y, moment.z);
        }
        for (push, at) in &self.bending.pushes {
            sum += move_wrench(&Six::new(push.x, push.y, push.z, 0.0, 0.0, 0.0), at - pose.origin);
        }
        if !sum.iter().all(|x| x.is_finite()) {
            return Err(ClassError::new("its force on the structure has no value"));
        }
        Ok(sum * self.tether.group)
    }

    /// The inertia across its axis that rides on the structure with the axis, about the centre of gravity, after [`Rig::pull`].
    pub(super) fn entrained_inertia(&self, pose: &Pose) -> Matrix6<f64> {
        let (arm, along) = (cross(self.attachment.at - pose.origin), self.axis.along);
        let plane = Matrix3::identity() - along * along.transpose();
        let mut sum = Matrix6::zeros();
        sum.fixed_view_mut::<3, 3>(0, 0).copy_from(&plane);
        sum.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-plane * arm));
        sum.fixed_view_mut::<3, 3>(3, 0).copy_from(&(arm * plane));
        sum.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-arm * plane * arm));
        sum * (self.bending.entrained_mass(&self.tension) * self.tether.group)
    }

    /// Finds the accelerations of a stage, that of the structure being known.
    pub(super) fn solve(
        &mut self,
        which: StepStage,
        (pose, acceleration): (&Pose, &Six),
        water: &FlowAt,
        dt: f64,
    ) -> Result<(), ClassError> {
        self.attachment.add_acceleration(self.attachment.at - pose.origin, acceleration);
        let stage = Stage { axis: &self.axis, attachment: &self.attachment, tension: &self.tension, water, dt };
        self.bending.stage(which == StepStage::Second, &stage)
    }

    /// What changed since the last state, at a time (s).
    pub(super) fn change(&mut self, time: f64, compatibility: &Compatibility) -> Option<RigChange> {
        let now = self.tension.standing;
        let before = self.before.replace(now).unwrap_or_default();
        match (before, now) {
            (TensionCase::Taut, TensionCase::Slack) => Some(RigChange::Slack),
            (TensionCase::Taut | TensionCase::Slack, TensionCase::OnStop) => {
                Some(RigChange::LowerStop { drop: self.tension.drop })
            }
            (TensionCase::Slack | TensionCase::OnStop, TensionCase::Taut) => {
                let closing = self.attachment.velocity.dot(&self.axis.along).max(0.0);
                let velocity = if compatibility.vertical_impact { closing / self.axis.along.z } else { closing };
                let made = self.tether.impact.map_or(0.0, |i| i.factor * velocity);
                self.impact = Some((self.impact_stress(time) + made, time));
                Some(RigChange::Impact { velocity, stress: made })
            }
            _ => None,
        }
    }

    /// Axial stress that impacts left at a time (Pa).
    pub fn impact_stress(&self, time: f64) -> f64 {
        match (self.impact, self.tether.impact) {
            (Some((stress, at)), Some(law)) => law.stress_after(stress, time - at),
            _ => 0.0,
        }
    }

    /// Finds what the elements bear and their stresses, of the stage just solved; `time` (s) is that they are reported for.
    pub(super) fn bear(&mut self, which: StepStage, water: &FlowAt, dt: f64, time: f64) {
        let impact = self.impact_stress(time);
        let stage = Stage { axis: &self.axis, attachment: &self.attachment, tension: &self.tension, water, dt };
        let elements = self.tether.line.elements();
        for (index, (element, (ends, stresses))) in
            elements.iter().zip(self.ends.iter_mut().zip(&mut self.stresses)).enumerate()
        {
            let [x, y] = self.bending.end_loads(index, which == StepStage::Second, &stage, &self.axial);
            let tensions = self.axial.ends(index, &self.tension, water);
            let tube = element.tube();
            for (end, upper) in [(0, false), (1, true)] {
                let at = 2 * end;
                let [effective, wall, out, inside] = tensions[end];
                ends[end] = EndLoads {
                    effective,
                    wall,
                    shear: [-x[at], -y[at]],
                    // RX = -dY/dz turns the sign again
                    moment: [y[at + 1], -x[at + 1]],
                    pressure: [out, inside],
                    impact,
                    upper,
                };
                stresses[end] = ends[end].stresses(&tube);
            }
        }
    }

    /// Writes what it remembers from one step to the next.
    pub(super) fn write(&self, out: &mut Vec<f64>) {
        let case = |case: TensionCase| match case {
            TensionCase::Taut => 0.0,
            TensionCase::Slack => 1.0,
            TensionCase::OnStop => 2.0,
        };
        let TetherTension { standing, bottom, cosine, length, heights, drop, pull } = self.tension;
        out.extend([case(standing), bottom, cosine, length, heights[0], heights[1], drop, pull]);
        out.push(self.before.map_or(-1.0, case));
        let (stress, time) = self.impact.unwrap_or((f64::NAN, f64::NAN));
        out.extend([stress, time]);
        self.bending.write(out);
    }

    /// Takes it back; what is left of the numbers, or nothing where there are too few.
    pub(super) fn take_up<'n>(&mut self, numbers: &'n [f64]) -> Option<&'n [f64]> {
        let (own, rest) = numbers.split_first_chunk::<11>()?;
        let case = |number: f64| match number {
            0.0 => Some(TensionCase::Taut),
            1.0 => Some(TensionCase::Slack),
            2.0 => Some(TensionCase::OnStop),
            _ => None,
        };
        let [standing, bottom, cosine, length, low, high, drop, pull, before, stress, time] = *own;
        self.tension =
            TetherTension { standing: case(standing)?, bottom, cosine, length, heights: [low, high], drop, pull };
        self.before = case(before);
        self.impact = stress.is_finite().then_some((stress, time));
        self.bending.take_up(rest)
    }

    /// The end of the step.
    pub(super) fn advance(&mut self, dt: f64) {
        self.bending.advance(dt);
    }

    fn motion(&self, which: StepStage) -> &[PlaneMotion; 2] {
        match which {
            StepStage::First => &self.bending.now,
            StepStage::Second => &self.bending.trial,
        }
    }

    /// The tether it is.
    pub fn tether(&self) -> &InstalledTether {
        &self.tether
    }

    /// The axis at the time of the moment.
    pub fn axis(&self) -> &TetherAxis {
        &self.start.0
    }

    /// How it stands at the time of the moment, with its tension.
    pub fn tension(&self) -> &TetherTension {
        &self.start.1
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.tether.line.nodes()
    }

    /// Distance of a node from the lower end along the axis (m).
    pub fn height(&self, node: usize) -> f64 {
        let share = self.tether.line.distances()[node] / self.tether.line.length();
        share * self.start.1.length
    }

    /// X and Y (m), RX and RY (rad) of a node against the axis.
    pub fn position(&self, node: usize) -> [f64; 4] {
        four([0, 1].map(|p| self.bending.now[p].deflection.as_slice()), node)
    }

    /// Their velocities (m/s, rad/s).
    pub fn velocity(&self, node: usize) -> [f64; 4] {
        four([0, 1].map(|p| self.bending.now[p].velocity.as_slice()), node)
    }

    /// Their accelerations (m/s2, rad/s2), those of the first stage.
    pub fn acceleration(&self, node: usize) -> [f64; 4] {
        four([0, 1].map(|p| self.bending.found[0][p].as_slice()), node)
    }

    /// The position of a node (m, global).
    pub fn node_position(&self, node: usize) -> Vector3<f64> {
        let (axis, tension) = &self.start;
        let [x, y, ..] = self.position(node);
        let top = self.tether.anchor + axis.along * axis.chord;
        top - axis.along * (tension.length - self.height(node)) + axis.across[0] * x + axis.across[1] * y
    }

    /// What each element bears at its lower and its upper end.
    pub fn ends(&self) -> &[[EndLoads; 2]] {
        &self.ends
    }

    /// The stresses at the lower and the upper end of each element.
    pub fn stresses(&self) -> &[[Stresses; 2]] {
        &self.stresses
    }

    /// Axial stiffness of the whole with its end springs (N/m).
    pub fn axial_stiffness(&self) -> f64 {
        self.axial.stiffness()
    }

    /// Where it is attached, from the centre of gravity, in the axes of the structure (m).
    pub fn attachment(&self) -> Vector3<f64> {
        self.tether.attachment
    }
}

/// X, Y, RX, RY of a node from both planes' deflections and slopes.
fn four([x, y]: [&[f64]; 2], node: usize) -> [f64; 4] {
    let at = |list: &[f64], i: usize| list[2 * node + i];
    // 0 - x: no minus before a zero
    [at(x, 0), at(y, 0), 0.0 - at(y, 1), at(x, 1)]
}
