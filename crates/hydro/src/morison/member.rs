//! A round member or a bar as it stands to the water: where along its axis it is wet, and how much of its sections.

use super::super::Load;
use super::super::hull::TubeHull;
use super::super::steady::{Medium, Steady};
use super::super::stream::{Immersion, LoadPlace, StreamWrench};
use nalgebra::{Matrix3, Matrix6x3, RowVector6, Vector3};
use std::f64::consts::PI;
use windlass_base::pose::{Pose, Six};

/// Points and weights of Gauss-Legendre quadrature of four points on [0, 1] (Abramowitz and Stegun, table 25.4).
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_9, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Stations of a part of the axis: four where it is wet all round, four where sections are cut by the surface.
pub(super) const STATIONS_PER_SEGMENT: usize = 8;

/// Least length over which sections of an upright member pass from wet to dry, as a share of the radius: so that there is a
/// passage at every lean. What is integrated straight over it is the same for a passage of any length.
const MIN_TRANSITION_SHARE: f64 = 1e-3;

/// A member in its body, or a length of one that growth makes thicker or thinner than the next.
#[derive(Clone, Debug)]
pub(super) struct MemberLength {
    /// Where its axis begins, body coordinates (m).
    pub from: Vector3<f64>,
    /// Unit vector along it, in the body.
    pub axis: Vector3<f64>,
    /// Unit vector along the width of a bar, in the body; of a tube any across its axis.
    pub first: Vector3<f64>,
    /// Length and outer diameter (m), of a bar that of a tube of its area.
    pub length: f64,
    pub diameter: f64,
    /// 1/2 rho Cd b along its width and its depth, of a tube 1/2 rho Cd D twice, and 1/2 rho Cdt times the perimeter (kg/m2).
    pub across: [f64; 2],
    pub along: f64,
    /// Area of the section by which waves press on it (m2): with the permeability, nothing of what a database holds.
    pub section: f64,
    /// Added mass across a length, along its width and its depth (kg/m).
    pub added: [f64; 2],
    /// Added mass along the axis at each end, where it begins first (kg); none where another length goes on.
    pub end_added: [f64; 2],
    /// Factor of the force of waves.
    pub factor: f64,
    /// Its segments, as tubes.
    pub segments: Vec<TubeHull>,
}

impl MemberLength {
    /// Whether a stream drags it.
    pub fn drags(&self) -> bool {
        self.across != [0.0; 2] || self.along != 0.0
    }
}

/// A member in a pose.
#[derive(Clone, Copy, Debug)]
pub(super) struct MemberInPose {
    /// Arm from the body's origin to where the axis begins, global axes (m).
    pub from: Vector3<f64>,
    /// Unit vector along the axis, global axes.
    pub axis: Vector3<f64>,
    /// Unit vector along the width, global axes.
    pub first: Vector3<f64>,
    /// Height of the body's origin (m, global).
    pub origin: f64,
    /// How far the highest point of a section is over its centre (m).
    pub rise: f64,
}

/// A place on the axis that stands for a length of it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Station {
    /// Distance from where the axis begins (m).
    pub at: f64,
    /// The length it stands for (m).
    pub long: f64,
    /// Height of the centre over the surface, in rises: -1 is wet all round, 1 dry.
    pub height: f64,
}

impl Station {
    /// How much of the section's height is wet, from 0 to 1.
    pub fn share(&self) -> f64 {
        (0.5 * (1.0 - self.height)).clamp(0.0, 1.0)
    }

    /// How much of the section's area is wet, from 0 to 1.
    pub fn area(&self) -> f64 {
        let x = self.height.clamp(-1.0, 1.0);
        (x.acos() - x * (1.0 - x * x).sqrt()) / PI
    }

    /// How far the middle of the wet height is below the centre, over the rise of the section (a ratio).
    pub fn lower(&self) -> f64 {
        0.5 * (self.height.clamp(-1.0, 1.0) + 1.0)
    }
}

impl MemberInPose {
    /// Arm (m, global axes) from the body's origin to a position on the axis.
    pub fn arm(&self, at: f64) -> Vector3<f64> {
        self.from + self.axis * at
    }

    /// The least and the greatest height of a range of the axis (m, global).
    pub fn heights(&self, (from, to): (f64, f64)) -> (f64, f64) {
        let [a, b] = [from, to].map(|at| self.origin + self.from.z + self.axis.z * at);
        (a.min(b), a.max(b))
    }

    /// The station of a place on the axis, under a surface of a height (m, global).
    pub fn station(&self, at: f64, long: f64, level: f64) -> Station {
        let height = (self.origin + self.from.z + self.axis.z * at - level) / self.rise;
        Station { at, long, height }
    }

    /// The parts of a range of the axis between given heights, which fall (m, global).
    pub fn parts(&self, (from, to): (f64, f64), heights: &[f64]) -> impl Iterator<Item = (f64, f64)> {
        let (standing, count) = (*self, heights.len());
        let nth =
            move |n: usize| heights.get(if standing.axis.z > 0.0 { count.checked_sub(n + 1)? } else { n }).copied();
        let position = move |z: f64| (z - standing.origin - standing.from.z) / standing.axis.z;
        let cuts = (0..count).filter_map(move |n| nth(n).map(position)).filter(move |at| *at > from && *at < to);
        cuts.chain(std::iter::once(to)).scan(from, |start, end| Some((std::mem::replace(start, end), end)))
    }

    /// The stations of the wet part of a range of the axis.
    pub fn stations(&self, (from, to): (f64, f64), level: f64) -> impl Iterator<Item = Station> + use<> {
        let standing = *self;
        let [a, b] = [from, to].map(|at| standing.station(at, 0.0, level).height);
        let parts = [interval_between(a, b, f64::NEG_INFINITY, -1.0), interval_between(a, b, -1.0, 1.0)];
        parts.into_iter().flatten().flat_map(move |(p, q)| {
            let long = (to - from) * (q - p);
            GAUSS
                .into_iter()
                .map(move |(x, w)| standing.station(from + (to - from) * (p + (q - p) * x), w * long, level))
        })
    }
}

/// Where a straight line from `a` at 0 to `b` at 1 is between two values.
fn interval_between(a: f64, b: f64, low: f64, high: f64) -> Option<(f64, f64)> {
    if a == b {
        return (a > low && a <= high).then_some((0.0, 1.0));
    }
    let [p, q] = [low, high].map(|x| (x - a) / (b - a));
    let (p, q) = (p.min(q).max(0.0), p.max(q).min(1.0));
    (p < q).then_some((p, q))
}

impl MemberLength {
    /// It in a pose.
    pub fn standing(&self, pose: &Pose) -> MemberInPose {
        let axis = pose.axes * self.axis;
        let rise = 0.5
            * self.diameter
            * (axis.x * axis.x + axis.y * axis.y + MIN_TRANSITION_SHARE * MIN_TRANSITION_SHARE).sqrt();
        MemberInPose { from: pose.axes * self.from, axis, first: pose.axes * self.first, origin: pose.origin.z, rise }
    }

    /// The share of its volume that displaces water.
    pub fn displaces(&self) -> f64 {
        self.section / (PI * self.diameter * self.diameter / 4.0)
    }

    /// Most stations it has in any pose, in a current with a number of heights where it changes.
    pub fn most_stations(&self, kinks: usize) -> usize {
        STATIONS_PER_SEGMENT * (self.segments.len() + kinks)
    }

    /// Where each segment begins and ends on the axis (m from its first end).
    pub fn ranges(&self) -> impl Iterator<Item = (f64, f64)> {
        let each = self.length / self.segments.len().max(1) as f64;
        (0..self.segments.len()).map(move |n| (each * n as f64, each * (n + 1) as f64))
    }

    /// The drag of the current on the body at rest under the mean level, with its exact tangent.
    pub fn steady(&self, steady: &Steady, kinks: &[f64], pose: &Pose) -> Load {
        let mut sum = Load::none();
        let standing = self.standing(pose);
        let level = steady.around.tide;
        for station in self.ranges().flat_map(|r| standing.parts(r, kinks)).flat_map(|r| standing.stations(r, level)) {
            let arm = standing.arm(station.at);
            let position = LoadPlace {
                at: self.from + self.axis * station.at,
                medium: Medium::Water,
                immersion: Immersion::Whole,
            };
            let stream = steady.velocity(Medium::Water, pose.origin.z + arm.z);
            let load = position.load_in(steady, pose, stream, |flow| {
                let (force, by_flow) = drag((self.across, self.along), (&self.axis, &self.first), &flow);
                let mut push = StreamWrench { wrench: Six::zeros(), by_velocity: Matrix6x3::zeros() };
                push.wrench.fixed_rows_mut::<3>(0).copy_from(&force);
                push.by_velocity.fixed_rows_mut::<3>(0).copy_from(&by_flow);
                push
            });
            sum.wrench += load.wrench * (station.share() * station.long);
            sum.stiffness += load.stiffness * (station.share() * station.long);
            if station.height.abs() < 1.0 {
                sum.stiffness += load.wrench * self.drying(&standing, &station, &arm) * station.long;
            }
        }
        sum
    }

    /// How much less of a section is wet after a small motion of the body: -d(share)/d(motion).
    fn drying(&self, standing: &MemberInPose, station: &Station, arm: &Vector3<f64>) -> RowVector6<f64> {
        let MemberInPose { axis, rise, .. } = *standing;
        // height over rise; rise^2 = r^2 (1 - axis_z^2 + ..), and d(axis_z) = (axis x e_z) . turn
        let radius = 0.5 * self.diameter;
        let by_turn = arm.cross(&Vector3::z()) / rise
            + axis.cross(&Vector3::z()) * (station.height * radius * radius * axis.z / (rise * rise));
        RowVector6::new(0.0, 0.0, 1.0 / rise, by_turn.x, by_turn.y, by_turn.z) * 0.5
    }
}

/// Drag of a length by its factors along its width, its depth and its axis (kg/m2), with the unit vectors of axis and width: `c |u| u`
/// of each part of the flow (m/s), |u| across being that of both, and its change with the flow.
pub(super) fn drag(
    ([of_width, of_depth], along): ([f64; 2], f64),
    (axis, first): (&Vector3<f64>, &Vector3<f64>),
    flow: &Vector3<f64>,
) -> (Vector3<f64>, Matrix3<f64>) {
    let slip = axis.dot(flow);
    let beside = flow - axis * slip;
    let speed = beside.norm();
    let tangent = axis * axis.transpose();
    if of_width != of_depth {
        let factors = across_axis(axis, first, [of_width, of_depth]);
        let force = factors * beside;
        let mut by_flow = factors * speed + tangent * (2.0 * along * slip.abs());
        if speed > 0.0 {
            by_flow += force * beside.transpose() / speed;
        }
        return (force * speed + axis * (along * slip.abs() * slip), by_flow);
    }
    let across = of_width;
    let mut by_flow = (Matrix3::identity() - tangent) * (across * speed) + tangent * (2.0 * along * slip.abs());
    if speed > 0.0 {
        by_flow += beside * beside.transpose() * (across / speed);
    }
    (beside * (across * speed) + axis * (along * slip.abs() * slip), by_flow)
}

/// What is one value along a width and another along the depth, across an axis.
pub(super) fn across_axis(axis: &Vector3<f64>, first: &Vector3<f64>, [of_width, of_depth]: [f64; 2]) -> Matrix3<f64> {
    if of_width == of_depth {
        return (Matrix3::identity() - axis * axis.transpose()) * of_width;
    }
    let second = axis.cross(first);
    first * first.transpose() * of_width + second * second.transpose() * of_depth
}
