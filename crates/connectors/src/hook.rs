//! The place of a hook that lines of given lengths lead to.
//!
//! None of the lines is stretched where the hook is within the length of each from its node: in the intersection of
//! balls, which is convex. The place looked for, the highest or the nearest to a point, is then on at most three of their
//! surfaces, so that it is one of a few that can be written down, and the others are slack.

use nalgebra::Vector3;

/// A line to the hook.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlingConstraint {
    /// Its node (m).
    pub node: Vector3<f64>,
    /// Its length (m).
    pub length: f64,
}

/// Which place is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SlingObjective {
    /// The farthest along a direction of unit length.
    Along(Vector3<f64>),
    /// The nearest to a point (m).
    Near(Vector3<f64>),
}

impl SlingObjective {
    /// The direction to it.
    fn direction_from(&self, at: Vector3<f64>) -> Vector3<f64> {
        match self {
            SlingObjective::Along(direction) => *direction,
            SlingObjective::Near(point) => point - at,
        }
    }

    /// How far it is.
    fn distance_left(&self, at: Vector3<f64>) -> f64 {
        match self {
            SlingObjective::Along(direction) => -direction.dot(&at),
            SlingObjective::Near(point) => (point - at).norm(),
        }
    }
}

/// Share of a length by which rounding may stretch a line.
const LENGTH_ROUNDING_SHARE: f64 = 1e-9;

/// The best position (m) in which no line is stretched; `None` where the lines do not reach one another.
pub fn hook(lines: &[SlingConstraint], goal: SlingObjective) -> Option<Vector3<f64>> {
    let mut positions = Vec::new();
    if let SlingObjective::Near(point) = goal {
        positions.push(point);
    }
    for (i, a) in lines.iter().enumerate() {
        positions.extend(goal.direction_from(a.node).try_normalize(0.0).map(|to| a.node + to * a.length));
        for (j, b) in lines.iter().enumerate().skip(i + 1) {
            let Some((centre, axis, radius)) = circle(a, b) else { continue };
            let to = goal.direction_from(centre);
            positions.extend((to - axis * axis.dot(&to)).try_normalize(1e-12).map(|to| centre + to * radius));
            for c in lines.iter().skip(j + 1) {
                positions.extend(crossing(centre, axis, radius, c).into_iter().flatten());
            }
        }
    }
    let reached =
        |at: &Vector3<f64>| lines.iter().all(|l| (at - l.node).norm() <= l.length * (1.0 + LENGTH_ROUNDING_SHARE));
    positions.into_iter().filter(reached).min_by(|a, b| goal.distance_left(*a).total_cmp(&goal.distance_left(*b)))
}

/// The circle on which two lines end together: its centre, axis and radius.
fn circle(a: &SlingConstraint, b: &SlingConstraint) -> Option<(Vector3<f64>, Vector3<f64>, f64)> {
    let apart = b.node - a.node;
    let distance = apart.norm();
    let axis = apart.try_normalize(0.0)?;
    let along = (distance * distance + a.length * a.length - b.length * b.length) / (2.0 * distance);
    let square = a.length * a.length - along * along;
    (square >= 0.0).then(|| (a.node + axis * along, axis, square.sqrt()))
}

/// The places of a circle at the length of a line from its node.
fn crossing(
    centre: Vector3<f64>,
    axis: Vector3<f64>,
    radius: f64,
    line: &SlingConstraint,
) -> Option<[Vector3<f64>; 2]> {
    let to = line.node - centre;
    let height = axis.dot(&to);
    let flat = to - axis * height;
    let far = flat.norm();
    let first = flat.try_normalize(1e-12 * line.length)?;
    let square = line.length * line.length - height * height;
    let along = (far * far + radius * radius - square) / (2.0 * far);
    let across = radius * radius - along * along;
    let second = axis.cross(&first) * across.max(0.0).sqrt();
    (across >= -1e-12 * radius * radius).then(|| [1.0, -1.0].map(|sign| centre + first * along + second * sign))
}

/// The hook (m) of a body that hangs from it: the position farthest from the centre of gravity, from a first one upward.
pub fn hanging(lines: &[SlingConstraint], centre: Vector3<f64>, up: Vector3<f64>) -> Option<Vector3<f64>> {
    /// Most steps; each goes farther from the centre, and slings that meet in a point need two.
    const MAX_STEPS: usize = 500;
    let mut at = hook(lines, SlingObjective::Along(up))?;
    for _ in 0..MAX_STEPS {
        let Some(away) = (at - centre).try_normalize(0.0) else { break };
        let next = hook(lines, SlingObjective::Along(away))?;
        let moved = (next - at).norm();
        at = next;
        if moved <= 1e-13 * (at - centre).norm() {
            break;
        }
    }
    Some(at)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(lengths: [f64; 4]) -> Vec<SlingConstraint> {
        let nodes = [[3.0, 4.0], [-3.0, 4.0], [-3.0, -4.0], [3.0, -4.0]];
        let make = |([x, y], length): ([f64; 2], f64)| SlingConstraint { node: Vector3::new(x, y, 0.0), length };
        nodes.into_iter().zip(lengths).map(make).collect()
    }

    #[test]
    fn equal_slings_meet_above_middle() {
        let at = hook(&lines([13.0; 4]), SlingObjective::Along(Vector3::z())).unwrap();
        assert!((at - Vector3::new(0.0, 0.0, 12.0)).norm() < 1e-12, "{at}");
    }

    #[test]
    fn longer_slings_on_one_diagonal_go_slack() {
        // the short pair alone: still 12 above its middle
        let at = hook(&lines([13.0, 13.5, 13.0, 13.5]), SlingObjective::Along(Vector3::z())).unwrap();
        assert!((at - Vector3::new(0.0, 0.0, 12.0)).norm() < 1e-12, "{at}");
        // three that meet at (-1, 1, 12), within their triangle; the fourth is too long to matter
        let far = |x: f64, y: f64| ((x + 1.0).powi(2) + (y - 1.0).powi(2) + 144.0).sqrt();
        let lengths = [far(3.0, 4.0), far(-3.0, 4.0), far(-3.0, -4.0), 20.0];
        let at = hook(&lines(lengths), SlingObjective::Along(Vector3::z())).unwrap();
        assert!((at - Vector3::new(-1.0, 1.0, 12.0)).norm() < 1e-12, "{at}");
    }

    #[test]
    fn one_line_points_to_boom_and_short_one_is_refused() {
        let one = [SlingConstraint { node: Vector3::zeros(), length: 5.0 }];
        let at = hook(&one, SlingObjective::Near(Vector3::new(30.0, 0.0, 40.0))).unwrap();
        assert!((at - Vector3::new(3.0, 0.0, 4.0)).norm() < 1e-12, "{at}");
        assert_eq!(hook(&lines([2.0; 4]), SlingObjective::Along(Vector3::z())), None);
    }

    #[test]
    fn hanging_body_rotates_centre_of_gravity_below_hook() {
        // one sling at the corner: in line with the centre
        let one = [SlingConstraint { node: Vector3::new(3.0, 0.0, 0.0), length: 5.0 }];
        let at = hanging(&one, Vector3::new(0.0, 0.0, -4.0), Vector3::z()).unwrap();
        assert!((at - Vector3::new(6.0, 0.0, 4.0)).norm() < 1e-9, "{at}");
    }
}
