//! The environment of a rod in the rod's own coordinates.
//!
//! Bending forces follow second differences of the nodes' positions over the cube of the element length: on short elements the rounding
//! of a position far from the global origin is a force of its own. A [`RodState`](super::RodState) therefore has its positions from an
//! origin beside the rod, and so has all that the solver does. What lies around the rod is in global places; this module takes it there.

use super::ends::RodEnd;
use super::environment::{FluidField, FluidState, LineEnvironment, SeabedShape, Support};
use nalgebra::Vector3;
use std::cell::RefCell;

/// An environment in coordinates from an origin.
pub(super) struct LocalEnvironment<'a> {
    world: &'a LineEnvironment<'a>,
    origin: Vector3<f64>,
    fluid: LocalFluid<'a>,
    bottom: Option<LocalBottom<'a>>,
    supports: Vec<Support<'a>>,
}

/// A fluid in coordinates from an origin.
struct LocalFluid<'a> {
    fluid: &'a dyn FluidField,
    origin: Vector3<f64>,
    /// Room for global places.
    room: RefCell<Vec<Vector3<f64>>>,
}

/// A bottom in coordinates from an origin.
struct LocalBottom<'a> {
    bottom: &'a dyn SeabedShape,
    origin: Vector3<f64>,
    /// Its height where it is level everywhere.
    level: Option<f64>,
}

impl<'a> LocalEnvironment<'a> {
    /// Moves an environment to an origin (m, global); `room` is memory for global places.
    pub fn new(world: &'a LineEnvironment<'a>, origin: Vector3<f64>, room: Vec<Vector3<f64>>) -> Self {
        LocalEnvironment {
            world,
            origin,
            fluid: LocalFluid { fluid: world.fluid, origin, room: RefCell::new(room) },
            bottom: world.bottom.map(|(bottom, _)| LocalBottom {
                bottom,
                origin,
                level: bottom.level().map(|height| height - origin.z),
            }),
            supports: world.supports.iter().map(|s| Support { position: s.position - origin, ..*s }).collect(),
        }
    }

    /// The environment in coordinates from the origin.
    pub fn world(&self) -> LineEnvironment<'_> {
        let ground = self.world.bottom.map(|(_, ground)| ground);
        let bottom = self.bottom.as_ref().map(|bottom| bottom as &dyn SeabedShape).zip(ground);
        LineEnvironment { fluid: &self.fluid, bottom, supports: &self.supports, ..*self.world }
    }

    /// Gives back the memory for global places.
    pub fn into_room(self) -> Vec<Vector3<f64>> {
        self.fluid.room.into_inner()
    }

    /// Ends in coordinates from the origin.
    pub fn ends(&self, ends: [RodEnd; 2]) -> [RodEnd; 2] {
        ends.map(|mut end| {
            if let Some(motion) = &mut end.motion {
                motion.position -= self.origin;
            }
            end
        })
    }
}

impl FluidField for LocalFluid<'_> {
    fn sample(&self, position: &Vector3<f64>, time: f64) -> FluidState {
        let mut found = self.fluid.sample(&(position + self.origin), time);
        found.surface -= self.origin.z;
        found
    }

    fn sample_into(&self, positions: &[Vector3<f64>], time: f64, out: &mut [FluidState]) {
        let mut global = self.room.borrow_mut();
        global.clear();
        global.extend(positions.iter().map(|x| x + self.origin));
        self.fluid.sample_into(&global, time, out);
        for fluid in out {
            fluid.surface -= self.origin.z;
        }
    }

    fn uniform(&self) -> bool {
        self.fluid.uniform()
    }

    fn is_interrupted(&self) -> bool {
        self.fluid.is_interrupted()
    }
}

impl SeabedShape for LocalBottom<'_> {
    fn height(&self, x: f64, y: f64) -> (f64, [f64; 2]) {
        if let Some(level) = self.level {
            return (level, [0.0; 2]);
        }
        let (height, slope) = self.bottom.height(x + self.origin.x, y + self.origin.y);
        (height - self.origin.z, slope)
    }

    fn level(&self) -> Option<f64> {
        self.level
    }
}
