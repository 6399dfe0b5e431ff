//! A dynamic line as an engine sees it.

use super::answer::{on_ends, on_supports};
use super::environment::{LineSeabed, LineWater};
use super::mesh::{to_class_error, wind};
use super::pipelay_supports::{PipeLay, SupportContact};
use super::rod_cache::{Base, EndDirection, RodCache};
use super::state_layout::{StateLayout, StateView};
use nalgebra::Vector3;
use std::cell::RefCell;
use std::sync::Arc;
use windlass_base::pose::Six;
use windlass_base::units::Dim;
use windlass_line_dynamics::{
    self as rod, EndTangent, LineEnvironment, Rod, RodEndForces, RodEndMotion, RodEnergyBalance, RodState, SeabedLaw,
};
use windlass_model::{
    Ambient, ClassError, ConnectorElement, ConnectorResponse, ConnectorSummary, DynamicConnector, End, Flow,
    NodalConnector, PlacedConnector, Situation, SolverCache,
};

/// An end may lie this much below the bottom (m).
const MAX_END_PENETRATION_M: f64 = 1e-3;

/// Share of its unstretched length that the ends of a line are apart at least while it pushes: nearer together it hangs or bows, and
/// its force on an end may be away from the other while it pulls.
const MIN_COMPRESSED_LENGTH_SHARE: f64 = 0.98;

/// What is said of a line that was given memory not its own.
const NO_MEMORY: &str = "the line has no memory";

/// A line between two ends.
#[derive(Debug)]
pub struct DynamicLine {
    pub(super) base: Arc<Base>,
    pub(super) layout: StateLayout,
    /// Length of the first part (m), and of its elements as the class has them.
    pub(super) first: f64,
    pub(super) nominal: f64,
}

/// A line at rest.
pub(super) struct LineAtRest {
    pub state: RodState,
    pub forces: RodEndForces,
}

impl DynamicLine {
    /// What its solver keeps in a cache; a new one in place of that of another line.
    pub(super) fn rod_cache<'a>(&self, cache: &'a mut SolverCache) -> Option<&'a mut RodCache> {
        cache.get_or_insert(|kept: &RodCache| Arc::ptr_eq(&kept.base, &self.base), || RodCache::new(&self.base))
    }

    /// The line's surroundings, at rest or under way, for what needs them, its tensioner having paid out so much (m); `flows` is room
    /// for what is asked of the water.
    pub(super) fn with_environment<T>(
        &self,
        at: &Situation,
        mean: bool,
        paid: f64,
        flows: &mut Vec<Flow>,
        act: impl FnOnce(&LineEnvironment) -> T,
    ) -> T {
        let around = at.surroundings;
        let ambient = self.base.ambient.as_deref();
        let water = LineWater { ambient, around, mean, flows: RefCell::new(std::mem::take(flows)) };
        let charted = ambient.filter(|a| a.has_bottom_grid());
        let floor = LineSeabed { plane: self.base.plane, charted, flat: self.base.flat.unwrap_or(f64::NEG_INFINITY) };
        let known = self.base.plane.is_some() || self.base.flat.is_some() || charted.is_some();
        let bottom: Option<(&dyn rod::SeabedShape, SeabedLaw)> = known.then_some((&floor, self.base.ground));
        let contacts =
            self.base.laid.as_ref().map(|laid| laid.find_contacts(at.ends, around, paid)).unwrap_or_default();
        let supports: Vec<_> = contacts.iter().map(SupportContact::support).collect();
        let slam = self.base.description.slam;
        let made =
            act(&LineEnvironment { bottom, slam, supports: &supports, ..LineEnvironment::new(&water, around.gravity) });
        *flows = water.flows.into_inner();
        made
    }

    /// What holds the ends.
    pub(super) fn end_conditions(&self, ends: &[End], still: bool) -> Result<[rod::RodEnd; 2], ClassError> {
        if let Some(laid) = &self.base.laid {
            return Ok([rod::RodEnd::FREE, rod::RodEnd::pin(laid.anchor)]);
        }
        let [first, second] = ends else { return Err(ClassError::new("a line has two ends").lasting()) };
        let made = |end: &End, hold: &Option<EndDirection>| {
            let three = |six: &Six| Vector3::new(six[0], six[1], six[2]);
            let mut motion = RodEndMotion::at_rest(end.pose.origin);
            let mut turning = Vector3::zeros();
            if !still {
                (motion.velocity, motion.acceleration) = (three(&end.velocity), three(&end.acceleration));
                turning = end.velocity.fixed_rows::<3>(3).into_owned();
            }
            let moved = rod::RodEnd::from_motion(motion).with_turning(turning);
            match hold {
                Some((direction, stiffness)) => {
                    rod::RodEnd { rotation: *stiffness, ..moved.with_clamp(end.pose.axes * direction) }
                }
                None => moved,
            }
        };
        let [a, b] = &self.base.holds;
        let first = if self.base.freed { rod::RodEnd::FREE } else { made(first, a) };
        Ok([first, made(second, b)])
    }

    /// What its holders bear. An anchor on the bottom does not bear what the end of the line presses on the bottom with: the half of its
    /// last element that has its weight at the anchor's node lies beside it.
    fn on_holders(
        &self,
        forces: RodEndForces,
        positions: &[Vector3<f64>; 2],
        environment: &LineEnvironment,
    ) -> RodEndForces {
        let mut made = forces;
        let (Some((bottom, _)), false, [_, anchor]) = (&environment.bottom, self.base.moving_ends[1], positions) else {
            return made;
        };
        let (height, [x, y]) = bottom.height(anchor.x, anchor.y);
        let outward = Vector3::new(-x, -y, 1.0).normalize();
        let [_, pull] = &mut made.force;
        let pressed = pull.dot(&outward).min(0.0);
        if anchor.z - height < MAX_END_PENETRATION_M {
            *pull -= outward * pressed;
        }
        made
    }

    /// Where its two ends are (m, global). What a pipe on supports is given as ends are these: its own are those of the shape it is laid in.
    ///
    /// # Errors
    /// Another number of ends than two, of a line between ends.
    fn end_positions(&self, ends: &[End]) -> Result<[Vector3<f64>; 2], ClassError> {
        match self.base.laid.as_ref().map(|laid| laid.shape.as_slice()) {
            Some([first, .., last]) => Ok([*first, *last]),
            Some(_) => Err(ClassError::new("the pipe has no shape that it is laid in").lasting()),
            None => End::origins(ends),
        }
    }

    /// Where it hangs at rest between ends.
    pub(super) fn find_rest(&self, at: &Situation, cache: &mut RodCache) -> Result<LineAtRest, ClassError> {
        let ends = self.end_conditions(at.ends, true)?;
        cache.forget_start();
        cache.forget_end();
        if cache.rod != self.base.rod {
            cache.rod = self.base.rod.clone();
        }
        cache.fit();
        let positions = self.end_positions(at.ends)?;
        let RodCache { rod, solver, rest, flows, .. } = cache;
        self.with_environment(at, true, 0.0, flows, |environment| {
            if let Some((bottom, _)) = &environment.bottom.filter(|_| self.base.laid.is_none()) {
                for (position, name) in positions.iter().zip(["first", "second"]) {
                    let below = bottom.height(position.x, position.y).0 - position.z;
                    if below > MAX_END_PENETRATION_M {
                        let text = format!("its {name} end lies {{}} below the bottom");
                        return Err(ClassError::with_values(text, &[(below, Dim::Length)])
                            .help("check its points, -DEPANCHOR and -DEPTH of &ENV"));
                    }
                }
            }
            let beside = rest.take().and_then(|mut state| {
                let forces = solver.statics(rod, &mut state, environment, ends).ok()?;
                Some((state, forces))
            });
            let (state, forces) = match beside {
                Some(found) if !solver.has_slid_without_friction() => found,
                beside => match (
                    self.static_shape_from_catenary(rod, solver, positions, environment, (at.surroundings, ends)),
                    beside,
                ) {
                    (Err(_), Some((mut state, _))) => {
                        let forces = solver.statics(rod, &mut state, environment, ends).map_err(to_class_error)?;
                        (state, forces)
                    }
                    (from_catenary, _) => from_catenary?,
                },
            };
            *rest = Some(state.clone());
            Ok(LineAtRest { state, forces })
        })
    }

    /// The rod of a mesh other than that of `rod`.
    pub(super) fn rod_with_mesh(&self, kept: &StateView, rod: &Rod) -> Result<Option<Rod>, ClassError> {
        let bands = &self.base.bands;
        if kept.mesh().eq(rod.each_of_mesh().map(|(rest, rate, segment)| (rest, rate, bands.part_of(segment)))) {
            return Ok(None);
        }
        // what is attached stands behind the first part, whose elements alone come and go
        let mut mesh: Vec<_> = kept.mesh().collect();
        bands.lay(&mut mesh);
        let before = self.base.rod.nodes() - 1;
        let shifted =
            |a: &rod::Attachment| rod::Attachment { node: (a.node + mesh.len()).saturating_sub(before), ..*a };
        let attached = self.base.attached.iter().map(shifted).collect();
        let segments = self.base.rod.segments().to_vec();
        Rod::with_mesh(self.base.rod.name(), segments, attached, &mesh).map(Some).map_err(to_class_error)
    }

    /// Its motion as a state has it, or where it rests if it has not begun, with its rod where that is not the one it was made with;
    /// and whether that is without the waves.
    pub(super) fn where_it_is(
        &self,
        at: &Situation,
        state: &[f64],
    ) -> Result<(Option<Rod>, RodState, bool), ClassError> {
        let base = &self.base.rod;
        match self.layout.read(state)? {
            Some(kept) => {
                let other = self.rod_with_mesh(&kept, base)?;
                let state = RodState::unpack(other.as_ref().unwrap_or(base), kept.motion).map_err(to_class_error)?;
                Ok((other, state, at.step.is_none()))
            }
            None => Ok((None, self.find_rest(at, &mut RodCache::new(&self.base))?.state, true)),
        }
    }

    /// Takes it to the end of a step.
    fn step(
        &self,
        at: &Situation,
        (time, dt): (f64, f64),
        (committed, kept): (&[f64], &StateView),
        trial: &mut [f64],
        cache: &mut RodCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        let (ends, positions) = (self.end_conditions(at.ends, false)?, self.end_positions(at.ends)?);
        if !cache.has_start(committed) {
            cache.forget_start();
            if let Some(rod) = self.rod_with_mesh(kept, &cache.rod)? {
                cache.rod = rod;
            }
            cache.state.unpack_into(&cache.rod, kept.motion).map_err(to_class_error)?;
            cache.keep_start(committed);
        }
        cache.forget_end();
        let RodCache { rod, state, .. } = &mut *cache;
        state.time = time - dt;
        let is_wound =
            if dt > 0.0 { wind(rod, state, (self.first, self.nominal, dt), &self.base.bands) } else { Ok(false) };
        // an instant, a winch, a pipe and the energy balance leave another state behind
        if dt == 0.0 || !matches!(is_wound, Ok(false)) || self.base.laid.is_some() || self.layout.has_balance() {
            cache.forget_start();
        }
        is_wound?;
        cache.fit();
        let RodCache { rod, solver, state, flows, .. } = cache;
        let forces = self.with_environment(at, false, kept.paid, flows, |environment| {
            if dt > 0.0 {
                let forces = solver.trial(rod, state, environment, time, ends).map_err(to_class_error)?;
                if self.base.laid.is_some() {
                    solver.copy_end_to(state);
                    on_supports(
                        out,
                        &rod.support_forces(state, environment),
                        solver.support_tangent(rod, environment).as_ref(),
                    )?;
                } else {
                    let tangent = solver.end_tangent_of_sides(rod, environment, self.base.moving_ends);
                    on_ends(out, &self.on_holders(forces, &positions, environment), tangent, true)?;
                }
                Ok::<_, ClassError>(forces)
            } else {
                // what a broken line springs back with lasts for a wave along an element, not for a step: it goes on as it moved
                let before = self.base.freed.then(|| state.clone());
                let forces = solver.start(rod, state, environment, ends).map_err(to_class_error)?;
                if let Some(before) = before {
                    state.clone_from(&before);
                }
                if self.base.laid.is_some() {
                    // what its supports feel does not follow their accelerations
                    on_supports(out, &rod.support_forces(state, environment), None)?;
                    return Ok(forces);
                }
                let mut tangent = EndTangent::default();
                for (side, mass) in solver.end_masses().iter().enumerate() {
                    tangent.acceleration.fixed_view_mut::<3, 3>(6 * side, 6 * side).copy_from(&-mass);
                }
                on_ends(out, &self.on_holders(forces, &positions, environment), Some(&tangent), true)?;
                Ok(forces)
            }
        })?;
        let balance = self.layout.has_balance().then(|| {
            self.with_environment(at, false, kept.paid, flows, |environment| match kept.balance {
                Some(mut balance) if dt > 0.0 => {
                    solver.copy_end_to(state);
                    balance.enter(rod, state, environment, solver, &forces);
                    balance
                }
                Some(balance) => balance,
                None => RodEnergyBalance::open(rod, state, environment, solver, &forces),
            })
        });
        let end = if dt > 0.0 { solver.end() } else { state };
        let paid = match (&self.base.laid, end.node_position(0)) {
            (Some(laid), Some(position)) if dt > 0.0 => laid.payout(at.ends, &position, kept.paid),
            _ => kept.paid,
        };
        self.layout.write((rod, &self.base.bands), (end, paid), trial)?;
        if let Some(balance) = balance {
            self.layout.write_balance(&balance, trial);
        }
        if dt > 0.0 {
            cache.keep_end(trial);
        }
        Ok(())
    }
}

impl ConnectorElement for DynamicLine {
    fn states(&self) -> usize {
        self.layout.size()
    }

    fn pulling_end(&self) -> usize {
        self.base.laid.as_ref().and_then(PipeLay::tensioner).unwrap_or(0)
    }

    fn compression_onset(&self) -> Option<f64> {
        let rod = &self.base.rod;
        // room for elements that it does not have is that of a winch, which changes its length
        let wound = self.layout.elements + 1 > rod.nodes();
        let stiff = rod.segments().iter().all(|s| s.bending > 0.0);
        let length = || rod.each_of_mesh().map(|(rest, ..)| rest).sum::<f64>();
        (stiff && !wound && self.base.laid.is_none()).then(|| MIN_COMPRESSED_LENGTH_SHARE * length())
    }

    fn as_placed(&self) -> Option<&dyn PlacedConnector> {
        self.base.laid.is_some().then_some(self)
    }

    fn as_nodal(&self) -> Option<&dyn NodalConnector> {
        Some(self)
    }

    fn as_dynamic(&self) -> Option<&dyn DynamicConnector> {
        Some(self)
    }

    fn evaluate(
        &self,
        at: &Situation,
        committed: &[f64],
        trial: &mut [f64],
        cache: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        let kept = self.layout.read(committed)?;
        let Some(cache) = self.rod_cache(cache) else { return Err(ClassError::new(NO_MEMORY).lasting()) };
        if let (Some(step), Some(kept)) = (at.step, &kept) {
            return self.step(at, (step.time, step.dt), (committed, kept), trial, cache, out);
        }
        let (found, positions) = (self.find_rest(at, cache)?, self.end_positions(at.ends)?);
        let RodCache { rod, solver, flows, .. } = &mut *cache;
        self.with_environment(at, true, 0.0, flows, |environment| match self.base.laid {
            Some(_) => {
                let loads = rod.support_forces(&found.state, environment);
                on_supports(out, &loads, solver.support_tangent(rod, environment).as_ref())
            }
            None => {
                let forces = self.on_holders(found.forces, &positions, environment);
                on_ends(out, &forces, solver.end_tangent(rod, environment), false)
            }
        })?;
        let mut state = found.state;
        state.time = at.step.map_or(0.0, |step| step.time);
        self.layout.write((rod, &self.base.bands), (&state, 0.0), trial)?;
        if let Some(step) = at.step {
            // a run begins here
            let begun = trial.to_vec();
            if let Some(kept) = self.layout.read(&begun)? {
                // its balance is not begun yet
                let kept = kept.without_balance();
                return self.step(at, (step.time, 0.0), (&begun, &kept), trial, cache, out);
            }
        }
        Ok(())
    }

    fn summary(&self, at: &Situation, committed: &[f64]) -> Result<ConnectorSummary, ClassError> {
        self.summarize(at, committed)
    }
}

impl PlacedConnector for DynamicLine {
    fn with_ambient(&self, ambient: &Arc<dyn Ambient>) -> Box<dyn ConnectorElement> {
        let base = Arc::new(Base { ambient: Some(ambient.clone()), ..Base::clone(&self.base) });
        Box::new(DynamicLine { base, ..*self })
    }
}
