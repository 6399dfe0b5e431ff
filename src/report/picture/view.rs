//! From where a scene is seen, and how what is seen is fitted into a rectangle of pixels.

use std::f64::consts::FRAC_PI_2;
use windlass_base::geometry::{Position, unit_vector};

/// The altitude from which the three axes of a cube look equally long (rad): asin(1/sqrt 3).
const ISOMETRIC: f64 = 0.615_479_708_670_387_3;
/// A component smaller than this is none.
const ZERO_COMPONENT: f64 = 1e-9;

/// A parallel projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The global direction to the right in the picture, and the one upward.
    right: Position,
    up: Position,
    /// Horizontal direction to the viewer, from +X toward +Y (rad).
    from: f64,
    /// Which of the three it is.
    pub kind: ViewKind,
    /// Factor on heights.
    pub stretch: f64,
}

/// The kinds of a view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViewKind {
    /// From above, X to the right and Y up.
    Plan,
    /// From the side, Z up.
    Elevation,
    /// Slantwise from above.
    Axonometric,
}

impl View {
    /// From above, X to the right and Y up.
    pub fn plan() -> View {
        View { right: [1.0, 0.0, 0.0], up: [0.0, 1.0, 0.0], from: -FRAC_PI_2, kind: ViewKind::Plan, stretch: 1.0 }
    }

    /// Horizontally, by a viewer who stands in the direction `from`, counted from +X toward +Y (rad); heights are drawn
    /// `stretch` times as large as they are.
    pub fn elevation(from: f64, stretch: f64) -> View {
        View::toward(from, 0.0, ViewKind::Elevation, stretch)
    }

    /// Slantwise from above, by a viewer who stands in the direction `from` (rad): isometric.
    pub fn isometric(from: f64, stretch: f64) -> View {
        View::toward(from, ISOMETRIC, ViewKind::Axonometric, stretch)
    }

    /// The viewer looks along -w, w = (cos a cos b, sin a cos b, sin b); right is z x w, up is w x right.
    fn toward(from: f64, above: f64, kind: ViewKind, stretch: f64) -> View {
        let ((c, s), (ca, sa)) = (unit_vector(from), unit_vector(above));
        // no component is zero without a sign
        let right = [0.0 - s, c, 0.0];
        let up = [0.0 - c * sa, 0.0 - s * sa, ca * stretch];
        View { right, up, from, kind, stretch }
    }

    /// Where a place stands in the picture: to the right and up (m).
    pub fn project(&self, at: Position) -> [f64; 2] {
        let dot = |axis: Position| axis.iter().zip(at).map(|(a, b)| a * b).sum();
        [dot(self.right), dot(self.up)]
    }

    /// The direction to the viewer (unit vector, global).
    pub fn viewer(&self) -> Position {
        let altitude = match self.kind {
            ViewKind::Plan => FRAC_PI_2,
            ViewKind::Elevation => 0.0,
            ViewKind::Axonometric => ISOMETRIC,
        };
        let ((c, s), (ca, sa)) = (unit_vector(self.from), unit_vector(altitude));
        [c * ca, s * ca, sa]
    }

    /// What stands above the picture.
    pub fn title(&self) -> String {
        let (c, s) = unit_vector(self.from);
        let side = match (c, s) {
            (1.0, _) => "+X".to_string(),
            (-1.0, _) => "-X".to_string(),
            (_, 1.0) => "+Y".to_string(),
            (_, -1.0) => "-Y".to_string(),
            _ => format!("{:.0} deg", self.from.to_degrees()),
        };
        let stretch = if self.stretch == 1.0 { String::new() } else { format!(", heights {} times", self.stretch) };
        match self.kind {
            ViewKind::Plan => "Plan".into(),
            ViewKind::Elevation => format!("Elevation, seen from {side}{stretch}"),
            ViewKind::Axonometric => format!("Isometric view, from {side}{stretch}"),
        }
    }

    /// The axes that can be shown, each with its name and where it points in the picture (a unit axis, not stretched).
    pub fn axes(&self) -> Vec<(&'static str, [f64; 2])> {
        let mut axes = Vec::new();
        let units = [("X", [1.0, 0.0, 0.0]), ("Y", [0.0, 1.0, 0.0]), ("Z", [0.0, 0.0, 1.0])];
        let aside = self.right.iter().all(|c| (c.abs() - 1.0).abs() > ZERO_COMPONENT);
        for (name, unit) in units {
            let [h, v] = self.project(unit);
            let v = if name == "Z" { v / self.stretch } else { v };
            // two axes that point along the same line are reported as one across the view
            let crowded = self.kind == ViewKind::Elevation && aside && name != "Z";
            if h.hypot(v) > ZERO_COMPONENT && !crowded {
                axes.push((name, [h, v]));
            }
        }
        if self.kind == ViewKind::Elevation && aside {
            axes.insert(0, ("X'", [1.0, 0.0]));
        }
        axes
    }

    /// The axes in words, for a picture of characters.
    pub fn axes_in_words(&self) -> String {
        let word = |(name, [h, v]): (&str, [f64; 2])| {
            let across = if h > 0.3 {
                "right"
            } else if h < -0.3 {
                "left"
            } else {
                ""
            };
            let along = if v > 0.3 {
                "up"
            } else if v < -0.3 {
                "down"
            } else {
                ""
            };
            let both = if across.is_empty() || along.is_empty() { "" } else { "-" };
            format!("{name} {along}{both}{across}")
        };
        self.axes().into_iter().map(word).collect::<Vec<_>>().join(", ")
    }
}

/// The rectangle that points reach: low and high, to the right and up (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Lower left corner.
    pub low: [f64; 2],
    /// Upper right corner.
    pub high: [f64; 2],
}

impl Extent {
    /// That of points; `None` without one.
    pub fn from_points(points: impl Iterator<Item = [f64; 2]>) -> Option<Extent> {
        points.fold(None, |extent, [x, y]| {
            let Extent { low, high } = extent.unwrap_or(Extent { low: [x, y], high: [x, y] });
            Some(Extent { low: [low[0].min(x), low[1].min(y)], high: [high[0].max(x), high[1].max(y)] })
        })
    }

    /// Width and height (m); of a single place they are one metre, and neither is lost in the rounding of the other.
    pub fn size(&self) -> [f64; 2] {
        let (w, h) = (self.high[0] - self.low[0], self.high[1] - self.low[1]);
        let largest = [self.low, self.high].as_flattened().iter().fold(0.0f64, |m, v| m.max(v.abs()));
        let least = (1e-6 * largest).max(1e-3 * w.max(h));
        let least = if least > 0.0 { least } else { 1.0 };
        [w.max(least), h.max(least)]
    }
}

/// A rectangle of pixels with one scale for both directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewFrame {
    /// Left, top, width, height (pixels).
    pub at: [i32; 4],
    /// Pixels a metre.
    pub scale: f64,
    centre: [f64; 2],
}

impl ViewFrame {
    /// Fits an extent into a rectangle, leaving so many pixels free at each side and above and below.
    pub fn fit(extent: &Extent, at: [i32; 4], free: (i32, i32)) -> ViewFrame {
        let [_, _, width, height] = at;
        let [w, h] = extent.size();
        let room = |whole: i32, free: i32| f64::from((whole - 2 * free).max(2));
        let scale = (room(width, free.0) / w).min(room(height, free.1) / h);
        let middle = |i: usize| {
            let (low, high) = (extent.low.get(i), extent.high.get(i));
            low.zip(high).map_or(0.0, |(l, h)| 0.5 * (l + h))
        };
        ViewFrame { at, scale, centre: [middle(0), middle(1)] }
    }

    /// The pixel of a place in the picture.
    pub fn pixel(&self, [x, y]: [f64; 2]) -> (i32, i32) {
        let [left, top, width, height] = self.at;
        let from = |start: i32, size: i32, by: f64| (f64::from(start) + 0.5 * f64::from(size) + by).round() as i32;
        (from(left, width, (x - self.centre[0]) * self.scale), from(top, height, (self.centre[1] - y) * self.scale))
    }
}

/// The largest round length (1, 2 or 5 times a power of ten) that is no longer than `most`.
pub fn round_length(most: f64) -> f64 {
    let power = 10f64.powf(most.log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|m| m * power).find(|l| *l <= most * (1.0 + 1e-12)).unwrap_or(power)
}

/// The convex hull of points, counterclockwise from the leftmost; points on its edges are left out (monotone chain
/// [ANDREW-1979]).
pub fn hull(mut points: Vec<(i32, i32)>) -> Vec<(i32, i32)> {
    points.sort_unstable();
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let cross = |o: (i32, i32), a: (i32, i32), b: (i32, i32)| {
        let d = |p: (i32, i32)| (i64::from(p.0) - i64::from(o.0), i64::from(p.1) - i64::from(o.1));
        let ((ax, ay), (bx, by)) = (d(a), d(b));
        ax * by - ay * bx
    };
    let half = |list: &mut dyn Iterator<Item = (i32, i32)>| {
        let mut chain: Vec<(i32, i32)> = Vec::new();
        for point in list {
            while let [.., a, b] = *chain.as_slice()
                && cross(a, b, point) <= 0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut ring = half(&mut points.iter().copied());
    ring.extend(half(&mut points.iter().rev().copied()));
    ring
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(a: [f64; 2], b: [f64; 2]) {
        assert!((a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12, "{a:?} {b:?}");
    }

    #[test]
    fn each_view_projects_points_to_expected_positions() {
        let at = [3.0, 4.0, 5.0];
        assert_near(View::plan().project(at), [3.0, 4.0]);
        // from -Y X runs to the right, from +Y to the left; from +X (astern) Y runs to the right, from -X to the left
        assert_near(View::elevation(-FRAC_PI_2, 1.0).project(at), [3.0, 5.0]);
        assert_near(View::elevation(FRAC_PI_2, 1.0).project(at), [-3.0, 5.0]);
        assert_near(View::elevation(0.0, 1.0).project(at), [4.0, 5.0]);
        assert_near(View::elevation(2.0 * FRAC_PI_2, 2.0).project(at), [-4.0, 10.0]);
        // from -45 degrees the place (3, 4) lies (3 + 4) / sqrt 2 to the right
        assert_near(View::elevation(-0.5 * FRAC_PI_2, 1.0).project(at), [7.0 / 2f64.sqrt(), 5.0]);
    }

    #[test]
    fn isometric_view_shows_cube_edges_equal_and_120_degrees_apart() {
        let view = View::isometric(-0.5 * FRAC_PI_2, 1.0);
        let edges: Vec<[f64; 2]> = view.axes().into_iter().map(|(_, at)| at).collect();
        assert_eq!(edges.len(), 3);
        for (i, a) in edges.iter().enumerate() {
            assert!((a[0].hypot(a[1]) - (2f64 / 3.0).sqrt()).abs() < 1e-12);
            let b = edges[(i + 1) % 3];
            // X and -Y and Z lie a third of a turn apart, so do X and Y but for a sign
            let cosine = (a[0] * b[0] + a[1] * b[1]) / (a[0].hypot(a[1]) * b[0].hypot(b[1]));
            assert!((cosine.abs() - 0.5).abs() < 1e-12, "{edges:?}");
        }
    }

    #[test]
    fn titles_and_axes_name_view_direction() {
        assert_eq!(View::elevation(-FRAC_PI_2, 1.0).title(), "Elevation, seen from -Y");
        assert_eq!(View::elevation(30f64.to_radians(), 3.0).title(), "Elevation, seen from 30 deg, heights 3 times");
        assert_eq!(View::plan().axes_in_words(), "X right, Y up");
        assert_eq!(View::elevation(FRAC_PI_2, 5.0).axes_in_words(), "X left, Z up");
        assert_eq!(View::elevation(0.5, 1.0).axes_in_words(), "X' right, Z up");
        assert_eq!(View::isometric(-0.5 * FRAC_PI_2, 1.0).axes_in_words(), "X down-right, Y up-right, Z up");
    }

    #[test]
    fn frame_keeps_one_scale_and_contains_extent() {
        let extent = Extent::from_points([[0.0, 0.0], [100.0, 10.0]].into_iter()).unwrap();
        let frame = ViewFrame::fit(&extent, [10, 20, 240, 140], (20, 20));
        assert_eq!(frame.scale, 2.0);
        assert_eq!((frame.pixel([0.0, 5.0]), frame.pixel([100.0, 5.0])), ((30, 90), (230, 90)));
        assert_eq!(frame.pixel([0.0, 10.0]), (30, 80));
        let single = Extent::from_points(std::iter::once([5e6, 5e6])).unwrap();
        assert_eq!(ViewFrame::fit(&single, [0, 0, 100, 100], (0, 0)).pixel([5e6, 5e6]), (50, 50));
        assert_eq!(Extent::from_points(std::iter::empty()), None);
    }

    #[test]
    fn scale_bar_lengths_are_round() {
        for (most, round) in [(1.0, 1.0), (1.99, 1.0), (4.9, 2.0), (7.0, 5.0), (2300.0, 2000.0), (0.03, 0.02)] {
            assert!((round_length(most) - round).abs() < 1e-12 * round, "{most}");
        }
    }

    #[test]
    fn hull_of_square_with_points_within_is_square() {
        let points = vec![(0, 0), (2, 1), (4, 0), (4, 4), (0, 4), (2, 2), (2, 0), (4, 4)];
        assert_eq!(hull(points), [(0, 0), (4, 0), (4, 4), (0, 4)]);
        assert_eq!(hull(vec![(1, 1), (0, 0), (2, 2)]).len(), 2);
    }
}
