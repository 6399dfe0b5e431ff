//! Members in waves, and moving.

use super::added;
use super::member::{MemberInPose, MemberLength, Station, across_axis, drag};
use crate::hull::{Solid, SubmergedVolume};
use crate::sea::{Kinematics, Sea, SeaAt};
use crate::steady::{Medium, Steady, Streams};
use crate::{BodyStep, DynamicLoad, Load, in_pose};
use nalgebra::{Matrix6, Vector3};
use std::sync::Arc;
use windlass_base::pose::Six;

/// What is kept first: force of waves, difference of added mass.
const WAVE_STATE: usize = 0;
const ADDED_MASS_STATE: usize = 6;
const HEADER_STATES: usize = 42;
/// Of each segment: height of the surface over the mean level, and whether that may change what is wet of it.
const STATES_PER_SEGMENT: usize = 2;
/// Of each station: the three drag factors times its length, the axis, the width, its arm, and the velocity of the water.
const STATES_PER_STATION: usize = 15;
/// How far a trial may be from where it was expected, for a segment to be taken as clear of the surface (m).
const SURFACE_MARGIN_M: f64 = 1.0;

/// What members meet under way.
#[derive(Debug)]
pub(super) struct MemberWaveLoads {
    sea: Option<Arc<Sea>>,
    /// Added mass that the body's inertia holds, body axes.
    held: Matrix6<f64>,
    /// Height of the mean surface (m, global), and weight of the water (N/m3).
    level: f64,
    weight: f64,
    /// Heights at which the current begins to change otherwise (m, global), highest first.
    kinks: Vec<f64>,
    /// Segments of all members, and most stations of all.
    segments: usize,
    stations: usize,
    /// More than the waves rise or fall (m).
    reach: f64,
}

/// A wrench of a force at an arm.
fn at_arm(arm: &Vector3<f64>, force: &Vector3<f64>) -> Six {
    let moment = arm.cross(force);
    Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

fn three(values: &[f64]) -> Vector3<f64> {
    Vector3::from_iterator(values.iter().copied().chain([0.0; 3]).take(3))
}

/// The water at a time.
struct WaterAtTime<'a> {
    sea: Option<SeaAt<'a>>,
    steady: &'a Steady,
    streams: Streams<'a>,
    origin: Vector3<f64>,
    level: f64,
}

impl WaterAtTime<'_> {
    /// At a station, in the middle of what is wet of it.
    fn kinematics_at(&self, standing: &MemberInPose, station: &Station) -> Kinematics {
        let mut position = self.origin + standing.arm(station.at);
        position.z -= station.lower() * standing.rise;
        self.sea.as_ref().map_or(Kinematics::still_water(0.0), |sea| sea.kinematics(position))
    }

    fn current(&self, z: f64) -> Vector3<f64> {
        if self.steady.current.is_none() { Vector3::zeros() } else { self.streams.velocity(Medium::Water, z).0 }
    }

    /// Height of the surface over the mean level where it cuts the axis in a range, or else at the range's middle (m).
    fn surface(&self, standing: &MemberInPose, (from, to): (f64, f64)) -> f64 {
        let Some(sea) = &self.sea else { return 0.0 };
        let mut at = 0.5 * (from + to);
        let mut found = 0.0;
        // twice again from where it was found to cut: the axis leans, and the surface slopes less
        for n in 0..3 {
            let position = self.origin + standing.arm(at);
            found = sea.elevation(position.x, position.y);
            let next = (self.level + found - self.origin.z - standing.from.z) / standing.axis.z;
            let cut = (from..=to).contains(&next);
            if n == 2 || !cut || standing.axis.x.hypot(standing.axis.y) * (next - at).abs() < 1e-3 {
                break;
            }
            at = next;
        }
        found
    }
}

impl MemberWaveLoads {
    pub(super) fn new(
        sea: Option<Arc<Sea>>,
        (rods, kinks): (&[MemberLength], &[f64]),
        steady: &Steady,
        held: &Matrix6<f64>,
    ) -> Self {
        let reach = sea.as_ref().map_or(0.0, |s| 2.0 * s.components.iter().map(|c| c.amplitude.abs()).sum::<f64>());
        let (level, weight) = (steady.around.tide, steady.around.water_weight());
        let segments = rods.iter().map(|r| r.segments.len()).sum();
        let stations = rods.iter().map(|r| r.most_stations(kinks.len())).sum();
        MemberWaveLoads { sea, held: *held, level, weight, kinks: kinks.to_vec(), segments, stations, reach }
    }

    /// Whether there is a sea.
    pub(super) fn has_waves(&self) -> bool {
        self.sea.is_some()
    }

    pub(super) fn states(&self) -> usize {
        HEADER_STATES + STATES_PER_SEGMENT * self.segments + STATES_PER_STATION * self.stations
    }

    /// Finds the water at the stations, and the force of the waves.
    pub(super) fn begin(&self, rods: &[MemberLength], steady: &Steady, ahead: &BodyStep, state: &mut [f64]) {
        let sea = self.sea.as_ref().map(|sea| sea.at_time(ahead.time));
        let streams = steady.streams_at_time(ahead.time);
        let water = WaterAtTime { sea, steady, streams, origin: ahead.pose.origin, level: self.level };
        let (head, rest) = state.split_at_mut(HEADER_STATES);
        let (mut segments, mut stations) = rest.split_at_mut(STATES_PER_SEGMENT * self.segments);
        stations.fill(0.0);
        let (mut wave, mut mass) = (Six::zeros(), Matrix6::zeros());
        for rod in rods {
            let sizes =
                (STATES_PER_SEGMENT * rod.segments.len(), STATES_PER_STATION * rod.most_stations(self.kinks.len()));
            let (own, others) = segments.split_at_mut(sizes.0);
            let (slots, more) = stations.split_at_mut(sizes.1);
            wave += self.member(&water, (rod, &rod.standing(ahead.pose)), (own, slots), &mut mass) * rod.factor;
            (segments, stations) = (others, more);
        }
        mass -= in_pose(&self.held, ahead.pose);
        for (kept, value) in head.iter_mut().skip(WAVE_STATE).zip(wave.iter()) {
            *kept = *value;
        }
        for (kept, value) in head.iter_mut().skip(ADDED_MASS_STATE).zip(mass.iter()) {
            *kept = *value;
        }
    }

    /// One member: the force of the waves on it but for hydrostatics, and its added mass; its segments are kept.
    fn member(
        &self,
        water: &WaterAtTime,
        (rod, standing): (&MemberLength, &MemberInPose),
        (kept, slots): (&mut [f64], &mut [f64]),
        mass: &mut Matrix6<f64>,
    ) -> Six {
        let mut slots = slots.chunks_exact_mut(STATES_PER_STATION);
        let axis = &standing.axis;
        let mut sum = Six::zeros();
        // the heights of the surface at both ends, and where it cuts the axis
        let mut heights = [0.0; 2];
        let mut cut = None;
        for (n, (range, own)) in rod.ranges().zip(kept.chunks_exact_mut(STATES_PER_SEGMENT)).enumerate() {
            let (low, high) = standing.heights(range);
            let clear = high + standing.rise < self.level - self.reach;
            let over = if clear { 0.0 } else { water.surface(standing, range) };
            let level = self.level + over;
            let near = high + standing.rise + SURFACE_MARGIN_M > self.level.min(level)
                && low - standing.rise - SURFACE_MARGIN_M < self.level.max(level);
            if low < level && level <= high {
                cut = Some(over);
            }
            if n == 0 {
                heights[0] = over;
            }
            heights[1] = over;
            self.segment(water, (rod, standing), (range, level), &mut slots, (&mut sum, mass));
            let counts = near && over != 0.0 && rod.section != 0.0;
            own.copy_from_slice(&[over, if counts { 1.0 } else { 0.0 }]);
        }
        // along the axis: what the ends bear, and the surface between them
        let mut shares = [0.0; 2];
        let mut pressed = 0.0;
        for (n, (at, sense)) in [(0.0, 1.0), (rod.length, -1.0)].into_iter().enumerate() {
            let station = standing.station(at, 0.0, self.level + heights[n]);
            shares[n] = station.area();
            if shares[n] == 0.0 || water.sea.is_none() && rod.end_added[n] == 0.0 {
                continue;
            }
            let found = water.kinematics_at(standing, &station);
            pressed += sense * shares[n] * found.pressure;
            let end = axis * axis.transpose() * (rod.end_added[n] * shares[n]);
            let arm = standing.arm(at);
            sum += at_arm(&arm, &(end * found.acceleration));
            added::add(mass, &arm, &end);
        }
        let surface = cut.unwrap_or(0.5 * (heights[0] + heights[1]));
        pressed += (shares[1] - shares[0]) * self.weight * surface;
        sum + at_arm(&standing.from, &(axis * (rod.section * pressed)))
    }

    /// One segment under a surface: inertia across the axis, and its stations.
    fn segment<'a>(
        &self,
        water: &WaterAtTime,
        (rod, standing): (&MemberLength, &MemberInPose),
        (range, level): ((f64, f64), f64),
        slots: &mut impl Iterator<Item = &'a mut [f64]>,
        (sum, mass): (&mut Six, &mut Matrix6<f64>),
    ) {
        let axis = &standing.axis;
        let added = across_axis(axis, &standing.first, rod.added);
        let parts = standing.parts(range, &self.kinks);
        for (station, slot) in parts.flat_map(|part| standing.stations(part, level)).zip(slots) {
            let arm = standing.arm(station.at);
            let found = water.kinematics_at(standing, &station);
            let beside = found.acceleration - axis * axis.dot(&found.acceleration);
            let share = station.area() * station.long;
            let pressed = beside * (water.steady.around.water_density * rod.section);
            *sum += at_arm(&arm, &((pressed + added * beside) * share));
            if rod.added != [0.0; 2] {
                added::add(mass, &arm, &(added * share));
            }
            let flow = found.velocity + water.current(water.origin.z + arm.z);
            let wet = station.share() * station.long;
            let (slot_drag, positions) = slot.split_at_mut(3);
            slot_drag.copy_from_slice(&[rod.across[0] * wet, rod.across[1] * wet, rod.along * wet]);
            for (kept, value) in positions.iter_mut().zip(axis.iter().chain(&standing.first).chain(&arm).chain(&flow)) {
                *kept = *value;
            }
        }
    }

    /// Drag at a velocity of the body, and its change with that.
    pub(super) fn drag(&self, at: &BodyStep, state: &[f64]) -> (Six, Matrix6<f64>) {
        let mut sum = (Six::zeros(), Matrix6::zeros());
        let (own, turn) = (three(at.velocity.as_slice()), three(&at.velocity.as_slice()[3..]));
        let (stations, _) =
            state[HEADER_STATES + STATES_PER_SEGMENT * self.segments..].as_chunks::<STATES_PER_STATION>();
        for station in stations {
            let [of_width, of_depth, along, positions @ ..] = station;
            if *of_width == 0.0 && *of_depth == 0.0 && *along == 0.0 {
                continue;
            }
            let [ax, ay, az, fx, fy, fz, rx, ry, rz, ux, uy, uz] = *positions;
            let (axis, first) = (Vector3::new(ax, ay, az), Vector3::new(fx, fy, fz));
            let (arm, flow) = (Vector3::new(rx, ry, rz), Vector3::new(ux, uy, uz));
            let flow = flow - own - turn.cross(&arm);
            let (force, by_flow) = drag(([*of_width, *of_depth], *along), (&axis, &first), &flow);
            sum.0 += at_arm(&arm, &force);
            // the velocity of the place is own - arm x turn, so that this has the form of a mass there
            added::add(&mut sum.1, &arm, &by_flow);
        }
        sum
    }

    pub(super) fn dynamic_load(&self, rods: &[MemberLength], at: &BodyStep, state: &[f64]) -> DynamicLoad {
        let (drag, damping) = self.drag(at, state);
        let mut load = Load { wrench: drag + six(state, WAVE_STATE), stiffness: Matrix6::zeros() };
        let segments = rods.iter().flat_map(|rod| rod.segments.iter().map(move |tube| (rod, tube)));
        for ((rod, tube), kept) in segments.zip(state[HEADER_STATES..].chunks_exact(STATES_PER_SEGMENT)) {
            let [over, near, ..] = kept else { continue };
            if *near == 0.0 {
                continue;
            }
            let mut wet = SubmergedVolume::default();
            wet.add(&tube.wet(at.pose, self.level + over), 1.0);
            wet.add(&tube.wet(at.pose, self.level), -1.0);
            let more = wet.load(self.weight * rod.displaces() * rod.factor);
            load.wrench += more.wrench;
            load.stiffness += more.stiffness;
        }
        DynamicLoad { load, damping }
    }

    /// Added mass of what is wet beyond what the body's inertia holds, global axes.
    pub(super) fn inertia(state: &[f64]) -> Matrix6<f64> {
        Matrix6::from_iterator(state.iter().skip(ADDED_MASS_STATE).copied().chain([0.0; 36]).take(36))
    }
}

fn six(state: &[f64], from: usize) -> Six {
    Six::from_iterator(state.iter().skip(from).copied().chain([0.0; 6]).take(6))
}
