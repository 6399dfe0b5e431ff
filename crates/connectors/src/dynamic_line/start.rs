//! From where a line falls into its first position of rest.

use super::describe::LinePart;
use nalgebra::Vector3;
use std::f64::consts::PI;
use windlass_catenary::{self as catenary, Joint, Line, Segment};
use windlass_line_dynamics::{PlaneBottom, SeabedShape};
use windlass_model::Surroundings;
use windlass_nonlinear::bisect;

/// Points of each part between its ends: so many that their chords follow a touchdown of a few metres' radius.
const POINTS_PER_PART: usize = 400;
/// Points of a shape that only has the right length.
const ROUGH_SHAPE_POINTS: usize = 60;
/// Halvings of the sag of a bow: what is left is below the rounding of its length.
const SAG_HALVINGS: usize = 60;

/// How far from the bottom an end lies on it (m).
const ON_BOTTOM: f64 = 0.1;

/// What a line may lie on, and its friction.
pub(super) type StartSeabed<'a> = Option<(&'a dyn SeabedShape, f64)>;

/// Points from the first end to the second: the catenary of the line, or, where that has no answer, a bow of its length.
pub(super) fn points(
    parts: &[LinePart],
    lengths: &[f64],
    ends: [Vector3<f64>; 2],
    floor: StartSeabed,
    around: &Surroundings,
) -> Vec<Vector3<f64>> {
    catenary(parts, lengths, ends, floor, around)
        .unwrap_or_else(|| bow(lengths.iter().sum(), ends, floor, parts, around))
}

/// Bows points aside from the vertical plane of the ends, as far as a circle of the length would reach.
pub(super) fn bow_aside(points: &mut [Vector3<f64>], [from, to]: [Vector3<f64>; 2], length: f64) {
    let chord = to - from;
    let across = Vector3::new(-chord.y, chord.x, 0.0).try_normalize(1e-9).unwrap_or_else(Vector3::y);
    let last = points.len().saturating_sub(1).max(1) as f64;
    for (i, point) in points.iter_mut().enumerate() {
        *point += across * (length / PI * (PI * i as f64 / last).sin());
    }
}

/// The plane through that of two ends that is on a bottom, the second if both are, with the mean slope from there to half way to the other,
/// and level across; with it whether it is the first. None where neither is.
pub(super) fn plane([first, second]: [Vector3<f64>; 2], bottom: &dyn SeabedShape) -> Option<(PlaneBottom, bool)> {
    let height = |position: Vector3<f64>| bottom.height(position.x, position.y).0;
    let on = |end: Vector3<f64>| (end.z - height(end)).abs() < ON_BOTTOM;
    let turned = !on(second) && on(first);
    let (from, to) = if turned { (second, first) } else { (first, second) };
    let half = 0.5 * Vector3::new(from.x - to.x, from.y - to.y, 0.0);
    let rise = (height(to + half) - height(to)) / half.norm_squared();
    let slope = if half.norm() > 0.0 { [half.x * rise, half.y * rise] } else { [0.0; 2] };
    let height = to.z - slope[0] * to.x - slope[1] * to.y;
    (on(to) && height.is_finite()).then_some((PlaneBottom { height, slope }, turned))
}

fn catenary(
    parts: &[LinePart],
    lengths: &[f64],
    ends: [Vector3<f64>; 2],
    floor: StartSeabed,
    around: &Surroundings,
) -> Option<Vec<Vector3<f64>>> {
    let weight = |p: &LinePart| p.submerged_weight(around.water_density, around.gravity);
    let mut segments: Vec<_> =
        parts.iter().zip(lengths).map(|(p, l)| Segment { length: *l, weight: weight(p), ea: p.ea() }).collect();
    let joint = |p: &LinePart| {
        p.joint.map_or(Joint::Free, |j| Joint::Weight((j.mass - around.water_density * j.volume) * around.gravity))
    };
    let mut joints: Vec<_> = parts.iter().take(parts.len().saturating_sub(1)).map(joint).collect();
    let floor = match floor {
        Some((bottom, friction)) => Some((plane(ends, bottom)?, friction)),
        None => None,
    };
    let turned = floor.is_some_and(|((_, turned), _)| turned);
    let [mut from, mut to] = ends;
    if turned {
        (from, to) = (to, from);
        segments.reverse();
        joints.reverse();
    }
    let across = Vector3::new(to.x - from.x, to.y - from.y, 0.0);
    let distance = across.norm();
    let toward = across.try_normalize(1e-12).unwrap_or_else(Vector3::x);
    // the catenary engine knows a plane bottom under the second end alone
    let floor = floor.map(|((plane, _), friction)| {
        let slope = -Vector3::new(plane.slope[0], plane.slope[1], 0.0).dot(&toward);
        catenary::SeabedModel { elevation: to.z, slope, friction }
    });
    let line = Line::new(segments, joints, to.z, around.tide).ok()?.with_seabed(floor).ok()?;
    let state = line.at_distance(distance, from.z).ok()?;
    let shape = line.shape(&state, POINTS_PER_PART);
    let mut points: Vec<_> = shape.iter().map(|p| Vector3::new(from.x, from.y, p.z) + toward * p.x).collect();
    if turned {
        points.reverse();
    }
    points.iter().all(|p| p.iter().all(|c| c.is_finite())).then_some(points)
}

/// A bow of a length between two ends in their vertical plane, downward of a heavy line and upward of a buoyant one; what would be
/// under the bottom lies on it.
fn bow(
    length: f64,
    [from, to]: [Vector3<f64>; 2],
    floor: StartSeabed,
    parts: &[LinePart],
    around: &Surroundings,
) -> Vec<Vector3<f64>> {
    let weight: f64 =
        parts.iter().map(|p| p.submerged_weight(around.water_density, around.gravity) * p.segment.length).sum();
    let side = if weight < 0.0 { 1.0 } else { -1.0 };
    let shape = |sag: f64| -> Vec<Vector3<f64>> {
        (0..=ROUGH_SHAPE_POINTS)
            .map(|i| {
                let s = i as f64 / ROUGH_SHAPE_POINTS as f64;
                let mut point = from + (to - from) * s;
                point.z += side * 4.0 * sag * s * (1.0 - s);
                if let Some((bottom, _)) = floor {
                    point.z = point.z.max(bottom.height(point.x, point.y).0);
                }
                point
            })
            .collect()
    };
    let long = |points: &[Vector3<f64>]| points.windows(2).map(|p| (p[1] - p[0]).norm()).sum::<f64>();
    if long(&shape(0.0)) >= length {
        return shape(0.0);
    }
    let [_, sag] = bisect([0.0, length], SAG_HALVINGS, |sag| long(&shape(sag)) < length);
    shape(sag)
}
