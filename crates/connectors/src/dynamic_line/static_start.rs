//! Where a line rests that has not rested near there before.

use super::element::DynamicLine;
use super::mesh::to_class_error;
use super::start;
use nalgebra::Vector3;
use windlass_line_dynamics::{
    LineEnvironment, PlaneBottom, Rod, RodEnd, RodEndForces, RodSolver, RodState, SeabedShape,
};
use windlass_model::{ClassError, Surroundings};

/// First and least share by which a bottom goes over from a plane to what it is.
const FIRST_STEP_SHARE: f64 = 0.25;
const MIN_STEP_SHARE: f64 = 0.02;

/// A bottom on its way from a plane to another.
struct TransitionBottom<'a> {
    plane: &'a PlaneBottom,
    other: &'a dyn SeabedShape,
    share: f64,
}

impl SeabedShape for TransitionBottom<'_> {
    fn height(&self, x: f64, y: f64) -> (f64, [f64; 2]) {
        let ((from, before), (to, after)) = (self.plane.height(x, y), self.other.height(x, y));
        let mean = |a: f64, b: f64| a + (b - a) * self.share;
        (mean(from, to), [mean(before[0], after[0]), mean(before[1], after[1])])
    }
}

impl DynamicLine {
    /// Where it comes to rest from its catenary, from a bow in the plane of its ends, or from one aside of that.
    pub(super) fn static_shape_from_catenary(
        &self,
        rod: &Rod,
        solver: &mut RodSolver,
        positions: [Vector3<f64>; 2],
        environment: &LineEnvironment,
        (around, ends): (&Surroundings, [RodEnd; 2]),
    ) -> Result<(RodState, RodEndForces), ClassError> {
        let mut from = |aside: bool| {
            let laid =
                if aside { None } else { self.start_on_plane((rod, solver), positions, environment, (around, ends)) };
            let mut state = match laid {
                Some(laid) => laid,
                None => {
                    let mut state = self.fallen_shape(positions, environment, around, aside)?;
                    solver.statics(rod, &mut state, environment, ends).map_err(to_class_error)?;
                    state
                }
            };
            // how softly it meets the bottom is known where it rests first
            let forces = solver.statics(rod, &mut state, environment, ends).map_err(to_class_error)?;
            Ok((state, forces))
        };
        // slack pipe would fold in the plane of its ends: it lies down sideways
        let bends = self.base.laid.is_none() && rod.segments().iter().any(|s| s.bending > 0.0);
        from(false).or_else(|error: ClassError| {
            let slack = bends && !error.lasting;
            if slack { from(true).map_err(|_| error) } else { Err(error) }
        })
    }

    /// From where it falls: in the plane of its ends, or bowed aside from it.
    fn fallen_shape(
        &self,
        positions: [Vector3<f64>; 2],
        environment: &LineEnvironment,
        around: &Surroundings,
        aside: bool,
    ) -> Result<RodState, ClassError> {
        if let Some(laid) = &self.base.laid {
            return RodState::along_points(&self.base.rod, &laid.shape).map_err(to_class_error);
        }
        let parts = &self.base.description.parts;
        let mut lengths: Vec<f64> = parts.iter().map(|p| p.segment.length).collect();
        if let Some(length) = lengths.first_mut() {
            *length = self.first;
        }
        let floor = environment.bottom.map(|(bottom, ground)| (bottom, ground.friction_along));
        let mut points = start::points(parts, &lengths, positions, floor, around);
        if aside {
            start::bow_aside(&mut points, positions, lengths.iter().sum());
        }
        RodState::along_points(&self.base.rod, &points).map_err(to_class_error)
    }

    /// Where it rests by friction on a bottom over a grid: laid on a plane, where its catenary is known, which then takes the shape of the
    /// bottom step by step.
    fn start_on_plane(
        &self,
        (rod, solver): (&Rod, &mut RodSolver),
        positions: [Vector3<f64>; 2],
        environment: &LineEnvironment,
        (around, ends): (&Surroundings, [RodEnd; 2]),
    ) -> Option<RodState> {
        let (other, ground) = environment.bottom.filter(|(_, ground)| ground.holds_at_rest())?;
        self.base
            .ambient
            .as_ref()
            .filter(|a| a.has_bottom_grid() && self.base.plane.is_none() && self.base.laid.is_none())?;
        let (plane, _) = start::plane(positions, other)?;
        let last = rod.nodes() - 1;
        let mut state = self
            .fallen_shape(positions, &LineEnvironment { bottom: Some((&plane, ground)), ..*environment }, around, false)
            .ok()?;
        let (mut share, mut step) = (0.0, FIRST_STEP_SHARE);
        let mut to = share;
        while share < 1.0 {
            let [before, bottom] = [share, to].map(|share| TransitionBottom { plane: &plane, other, share });
            let mut next = state.clone();
            let origin = next.origin;
            for x in next.position.iter_mut().take(last).skip(1) {
                let position = *x + origin;
                x.z += bottom.height(position.x, position.y).0 - before.height(position.x, position.y).0;
            }
            let environment = LineEnvironment { bottom: Some((&bottom, ground)), ..*environment };
            if solver.statics_with_friction(rod, &mut next, &environment, ends).ok()?.is_some() {
                (state, share) = (next, to);
            } else if step < MIN_STEP_SHARE || to == 0.0 {
                return None;
            } else {
                step *= 0.5;
            }
            to = (share + step).min(1.0);
        }
        Some(state)
    }
}
