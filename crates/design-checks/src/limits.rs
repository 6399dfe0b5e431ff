//! Limits that the user gives: offsets, clearances, grounded lengths.

use crate::{CheckError, Verdict, finite};
use nalgebra::Vector3;

/// On which side of a limit a value must be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// At most the limit: an offset.
    AtMost,
    /// At least the limit: a clearance, a grounded length.
    AtLeast,
}

/// Checks a value against a limit in the same unit. The limit is the user's own: it is confirmed.
///
/// # Errors
/// A value or limit that is not finite.
pub fn check_limit(value: f64, limit: f64, side: Side) -> Result<Verdict, CheckError> {
    finite("the value", value)?;
    finite("the limit", limit)?;
    let holds = match side {
        Side::AtMost => value <= limit,
        Side::AtLeast => value >= limit,
    };
    Ok(if holds { Verdict::Pass } else { Verdict::Fail })
}

/// Shortest distance (m) of two polylines, each of at least one point (m); none of an empty one. Parts are straight.
///
/// The nearest points of two straight parts are found as in C. Ericson, "Real-time collision detection", 5.1.9.
pub fn distance(first: &[Vector3<f64>], second: &[Vector3<f64>]) -> Option<f64> {
    let mut least: Option<f64> = None;
    for [a, b] in parts(first) {
        for [c, d] in parts(second) {
            let found = part_distance([a, b], [c, d]);
            least = Some(least.map_or(found, |known| known.min(found)));
        }
    }
    least
}

/// Shortest distance (m) of a polyline from flat convex panels, given by their corners in order (m); 0 where it goes through one; none
/// without points or panels.
pub fn distance_to_panels(line: &[Vector3<f64>], panels: &[Vec<Vector3<f64>>]) -> Option<f64> {
    let mut least: Option<f64> = None;
    for panel in panels {
        let mut edge = panel.clone();
        edge.extend(panel.first().copied());
        let mut found = distance(line, &edge);
        if let Some(normal) = normal(panel) {
            let height = |point: &Vector3<f64>| panel.first().map_or(f64::NAN, |corner| normal.dot(&(point - corner)));
            for point in line {
                let above = height(point);
                if is_inside(&(point - normal * above), panel, &normal) {
                    found = found.map(|known| known.min(above.abs()));
                }
            }
            for [a, b] in parts(line) {
                let (from, to) = (height(&a), height(&b));
                if from * to < 0.0 && is_inside(&(a + (b - a) * (from / (from - to))), panel, &normal) {
                    found = Some(0.0);
                }
            }
        }
        least = match (least, found) {
            (Some(known), Some(found)) => Some(known.min(found)),
            (known, found) => known.or(found),
        };
    }
    least
}

/// The unit normal of a flat panel; none of one without area.
fn normal(panel: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let first = panel.first()?;
    let sum = panel.windows(2).fold(Vector3::zeros(), |sum: Vector3<f64>, pair| match pair {
        [a, b] => sum + (a - first).cross(&(b - first)),
        _ => sum,
    });
    sum.try_normalize(0.0)
}

/// Whether a point of the plane of a convex panel is inside it.
fn is_inside(point: &Vector3<f64>, panel: &[Vector3<f64>], normal: &Vector3<f64>) -> bool {
    let next = panel.iter().cycle().skip(1);
    panel.iter().zip(next).all(|(a, b)| normal.dot(&(b - a).cross(&(point - a))) >= 0.0)
}

/// The straight parts of a polyline; a single point is a part without length.
fn parts(line: &[Vector3<f64>]) -> Vec<[Vector3<f64>; 2]> {
    match line {
        [single] => vec![[*single, *single]],
        _ => line.windows(2).filter_map(|pair| <[Vector3<f64>; 2]>::try_from(pair).ok()).collect(),
    }
}

fn part_distance([a, b]: [Vector3<f64>; 2], [c, d]: [Vector3<f64>; 2]) -> f64 {
    let (u, v, w) = (b - a, d - c, a - c);
    let (uu, vv, uv, uw, vw) = (u.dot(&u), v.dot(&v), u.dot(&v), u.dot(&w), v.dot(&w));
    let clamped = |numerator: f64, denominator: f64| {
        if denominator > 0.0 { (numerator / denominator).clamp(0.0, 1.0) } else { 0.0 }
    };
    let determinant = uu * vv - uv * uv;
    let s = clamped(uv * vw - vv * uw, determinant);
    let t = clamped(uv * s + vw, vv);
    // with t held at an end of its part, s anew
    let s = clamped(uv * t - uw, uu);
    (w + u * s - v * t).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64, z: f64) -> Vector3<f64> {
        Vector3::new(x, y, z)
    }

    #[test]
    fn distances_of_straight_parts_match_geometry() {
        let along_x = [point(0.0, 0.0, 0.0), point(10.0, 0.0, 0.0)];
        // crossing 3 above, end to end, side by side, and a point
        let cases: [(&[Vector3<f64>], f64); 5] = [
            (&[point(5.0, -4.0, 3.0), point(5.0, 4.0, 3.0)], 3.0),
            (&[point(13.0, 4.0, 0.0), point(20.0, 9.0, 0.0)], 5.0),
            (&[point(-5.0, 2.0, 0.0), point(20.0, 2.0, 0.0)], 2.0),
            (&[point(4.0, 3.0, 4.0)], 5.0),
            (&[point(5.0, 8.0, 0.0), point(5.0, 3.0, 0.0), point(5.0, 1.5, 0.0)], 1.5),
        ];
        for (other, want) in cases {
            let found = distance(&along_x, other).unwrap();
            assert!((found - want).abs() < 1e-12, "{other:?}: {found}");
            assert!((distance(other, &along_x).unwrap() - want).abs() < 1e-12);
        }
        assert_eq!(distance(&along_x, &[]), None);
    }

    #[test]
    fn distance_from_panel_is_that_of_its_face_edge_or_zero_through_it() {
        let square = vec![vec![point(0.0, 0.0, 0.0), point(4.0, 0.0, 0.0), point(4.0, 4.0, 0.0), point(0.0, 4.0, 0.0)]];
        let found = |line: &[Vector3<f64>]| distance_to_panels(line, &square).unwrap();
        // over the middle, beside an edge, and through the face
        assert!((found(&[point(2.0, 2.0, 1.5), point(2.0, 2.0, 9.0)]) - 1.5).abs() < 1e-12);
        assert!((found(&[point(7.0, 2.0, 4.0), point(9.0, 2.0, 4.0)]) - 5.0).abs() < 1e-12);
        assert_eq!(found(&[point(1.0, 1.0, -3.0), point(1.0, 1.0, 3.0)]), 0.0);
        assert!((found(&[point(2.0, 2.0, -2.5)]) - 2.5).abs() < 1e-12);
        assert_eq!(distance_to_panels(&[], &square), None);
    }

    #[test]
    fn limit_holds_on_its_side() {
        assert_eq!(check_limit(12.0, 12.0, Side::AtMost), Ok(Verdict::Pass));
        assert_eq!(check_limit(12.1, 12.0, Side::AtMost), Ok(Verdict::Fail));
        assert_eq!(check_limit(9.0, 10.0, Side::AtLeast), Ok(Verdict::Fail));
        assert!(check_limit(f64::NAN, 1.0, Side::AtLeast).is_err());
    }
}
