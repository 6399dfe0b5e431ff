//! A pipe laid over rollers or davits down to the bottom.
//!
//! Source: [MOSES-FLEX ROLLER, DAVIT], [MOSES-REF conn_pipe]. The pipe runs from the last support, the tensioner, over the first and down to the bottom, where it is held far beyond
//! the touchdown. It rolls through rollers, and hangs by davits from its own nodes.

use nalgebra::{Matrix3, Vector3};
use std::cell::RefCell;
use std::sync::Arc;
use windlass_base::pose::Pose;
use windlass_line_dynamics::{Support, SupportLaw, SupportReaction, SupportTarget};
use windlass_model::{ConnectorElement, ConnectorResponse, End, Situation, SolverCache, Surroundings};

/// What a pipe lies on.
#[derive(Clone, Debug)]
pub(super) struct PipeLay {
    /// The law of each support, between its node and a point of the pipe.
    pub supports: Arc<[Box<dyn ConnectorElement>]>,
    pub holds: Vec<SupportedPart>,
    pub tensioner: Option<Tensioner>,
    /// Axes of the pipe at a support in those of its node.
    pub turn: Matrix3<f64>,
    /// Where the far end is held on the bottom (m).
    pub anchor: Vector3<f64>,
    /// Nodes from which it comes to rest (m).
    pub shape: Vec<Vector3<f64>>,
}

/// What of the pipe a support holds.
#[derive(Clone, Copy, Debug)]
pub(super) enum SupportedPart {
    Node(usize),
    /// What crosses the plane through its node at right angles to this, in the axes of the pipe.
    Crossing(Vector3<f64>),
}

/// What pulls the end of a pipe back.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tensioner {
    /// Way of the pipe from it, in the axes of the pipe.
    pub along: Vector3<f64>,
    /// How far along the end is from its node as laid (m).
    pub at: f64,
    /// As laid, least and largest (N).
    pub tension: [f64; 3],
    /// N/m.
    pub stiffness: f64,
}

impl Tensioner {
    /// Tension (N), by how far along the end is from its node (m), and its slope (N/m), after it has paid out so much (m).
    fn tension(&self, along: f64, paid: f64) -> (f64, f64) {
        let [_, least, most] = self.tension;
        let free = self.braked_tension(along, paid);
        let tension = free.clamp(least, most);
        (tension, if tension == free { self.stiffness } else { 0.0 })
    }

    /// Tension (N) if its brake held.
    fn braked_tension(&self, along: f64, paid: f64) -> f64 {
        self.tension[0] + self.stiffness * (along - self.at - paid)
    }

    /// What it has paid out (m) at the end of a step in which the end has come there along: it takes hold anew where it is.
    fn pays(&self, along: f64, paid: f64) -> f64 {
        let beyond = self.braked_tension(along, paid) - self.tension(along, paid).0;
        if beyond == 0.0 { paid } else { paid + beyond / self.stiffness }
    }
}

/// A support where its end is, as the pipe feels it.
#[derive(Debug)]
pub(super) struct SupportContact<'a> {
    law: &'a dyn ConnectorElement,
    /// With what it has paid out (m).
    tensioner: Option<(&'a Tensioner, f64)>,
    holds: SupportedPart,
    /// The node, and the axes of the pipe there.
    pose: Pose,
    velocity: Vector3<f64>,
    around: &'a Surroundings,
    room: RefCell<ConnectorResponse>,
}

impl SupportLaw for SupportContact<'_> {
    fn reaction(&self, at: &Vector3<f64>, _: &Vector3<f64>) -> Option<SupportReaction> {
        let Pose { origin, axes } = self.pose;
        let ends = [End::at_rest(self.pose), End::at_rest(Pose { origin: origin + at, axes })];
        let situation = Situation { ends: &ends, step: None, surroundings: self.around };
        let mut out = self.room.borrow_mut();
        let found = self.law.evaluate(&situation, &[], &mut [], &mut SolverCache::new(), &mut out);
        let mut made = SupportReaction::default();
        match (found, out.wrench.get(1), out.stiffness.get(3)) {
            (Ok(()), Some(wrench), Some(block)) => {
                made.force = wrench.fixed_rows::<3>(0).into_owned();
                made.by_position = block.fixed_view::<3, 3>(0, 0).into_owned();
            }
            // a force that is no number makes the solver say that there is no answer
            _ => made.force = Vector3::repeat(f64::NAN),
        }
        if let Some((tensioner, paid)) = self.tensioner {
            let along = axes * tensioner.along;
            let (tension, slope) = tensioner.tension(along.dot(at), paid);
            made.force -= along * tension;
            made.by_position += along * along.transpose() * slope;
        }
        (made != SupportReaction::default()).then_some(made)
    }
}

impl SupportContact<'_> {
    pub fn support(&self) -> Support<'_> {
        let Pose { origin, axes } = self.pose;
        let holds = match self.holds {
            SupportedPart::Node(node) => SupportTarget::Node(node),
            SupportedPart::Crossing(along) => SupportTarget::Crossing(axes * along),
        };
        Support { position: origin, velocity: self.velocity, target: holds, law: self }
    }
}

impl PipeLay {
    /// The support that is a tensioner.
    pub fn tensioner(&self) -> Option<usize> {
        self.tensioner.and_then(|_| self.supports.len().checked_sub(1))
    }

    /// What its tensioner has paid out (m) at the end of a step in which the end of the pipe has come to a place.
    pub fn payout(&self, ends: &[End], end: &Vector3<f64>, paid: f64) -> f64 {
        let (Some(tensioner), Some(held)) = (&self.tensioner, ends.last()) else { return paid };
        let along = held.pose.axes * self.turn * tensioner.along;
        tensioner.pays(along.dot(&(end - held.pose.origin)), paid)
    }

    /// The supports where their ends are, its tensioner having paid out so much (m).
    pub fn find_contacts<'a>(
        &'a self,
        ends: &'a [End],
        around: &'a Surroundings,
        paid: f64,
    ) -> Vec<SupportContact<'a>> {
        let last = self.supports.len().saturating_sub(1);
        let laws = self.supports.iter().zip(&self.holds).enumerate();
        laws.zip(ends)
            .map(|((i, (law, holds)), end)| SupportContact {
                law: law.as_ref(),
                tensioner: self.tensioner.as_ref().filter(|_| i == last).map(|t| (t, paid)),
                holds: *holds,
                pose: Pose { axes: end.pose.axes * self.turn, ..end.pose },
                velocity: end.velocity.fixed_rows::<3>(0).into_owned(),
                around,
                room: RefCell::default(),
            })
            .collect()
    }
}
