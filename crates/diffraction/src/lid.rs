//! The lid on the waterplane inside of a hull.
//!
//! The waterplane is cut into strips along x between levels of y: the ends of the sides of the waterline, and levels between them a panel
//! apart. Across a strip the waterline is entered and left in turn; what lies between is cut
//! into panels. So any number of rings is closed, and a moonpool, which runs round the other way, stays open.

use crate::mesh::MirrorPlanes;
use crate::panel::Panel;
use nalgebra::Vector3;

/// Points nearer than this share of a panel's diagonal are one.
const JOIN_SHARE: f64 = 1e-4;
/// Levels nearer than this share of a panel of the lid are one. A lid that leaves the waterline by a tenth of a panel costs 1 % of the drift.
const LEVEL_SHARE: f64 = 0.02;
/// A panel may be longer by this share of the size than those of the waterline.
const SPARE_SHARE: f64 = 0.3;

/// A side of the waterline: its lower and its upper end by x and level, and whether the hull begins there toward x.
struct Side {
    lower: [f64; 2],
    upper: [f64; 2],
    begins: bool,
}

impl Side {
    /// Where it is at a level.
    fn x_at(&self, y: f64) -> f64 {
        let share = (y - self.lower[1]) / (self.upper[1] - self.lower[1]);
        self.lower[0] + (self.upper[0] - self.lower[0]) * share
    }
}

/// Panels of the waterplane inside of a hull, about as large as those at its waterline: none of a hull below the water. `None` where the
/// waterline does not close.
pub fn close_waterplane(hull: &[Panel], mirrors: MirrorPlanes) -> Option<Vec<Panel>> {
    let ends = waterline(hull);
    if ends.is_empty() {
        return Some(Vec::new());
    }
    let length = ends.iter().map(|[a, b]| (b - a).norm()).sum::<f64>() / ends.len() as f64;
    let levels = levels(&ends, length);
    let level_of = |y: f64| levels.iter().copied().min_by(|a, b| (a - y).abs().total_cmp(&(b - y).abs())).unwrap_or(y);
    let sides: Vec<Side> = ends
        .iter()
        .map(|[a, b]| ([a.x, level_of(a.y)], [b.x, level_of(b.y)]))
        .filter(|(a, b)| a[1] != b[1])
        .map(|(a, b)| {
            // counter-clockwise about the hull: it lies toward x of a side that runs down
            if a[1] < b[1] {
                Side { lower: a, upper: b, begins: false }
            } else {
                Side { lower: b, upper: a, begins: true }
            }
        })
        .collect();
    let mut made = Vec::new();
    for pair in levels.windows(2) {
        let &[low, high] = pair else { continue };
        let rows = ((high - low) / length - SPARE_SHARE).ceil().max(1.0) as usize;
        let level = |row: usize| low + (high - low) * row as f64 / rows as f64;
        let middle = 0.5 * (low + high);
        let mut crossed: Vec<&Side> =
            sides.iter().filter(|side| side.lower[1] <= low && side.upper[1] >= high).collect();
        crossed.sort_by(|a, b| a.x_at(middle).total_cmp(&b.x_at(middle)));
        let plane = Side { lower: [0.0, low], upper: [0.0, high], begins: true };
        if mirrors.x && crossed.first().is_some_and(|side| !side.begins) {
            crossed.insert(0, &plane);
        }
        for pair in crossed.chunks(2) {
            let &[left, right] = pair else { return None };
            if !left.begins || right.begins {
                return None;
            }
            let width = right.x_at(middle) - left.x_at(middle);
            let columns = (width / length - SPARE_SHARE).ceil().max(1.0) as usize;
            for row in 0..rows {
                let at = |column: usize, y: f64| {
                    let (from, to) = (left.x_at(y), right.x_at(y));
                    Vector3::new(from + (to - from) * column as f64 / columns as f64, y, 0.0)
                };
                let (below, above) = (level(row), level(row + 1));
                let cells = (0..columns).map(|c| [at(c, below), at(c + 1, below), at(c + 1, above), at(c, above)]);
                made.extend(cells.filter_map(Panel::new));
            }
        }
    }
    Some(made)
}

/// The levels of the ends of sides, growing, those near each other as their mean; the first and the last are kept.
fn levels(ends: &[[Vector3<f64>; 2]], length: f64) -> Vec<f64> {
    let mut all: Vec<f64> = ends.iter().flat_map(|[a, b]| [a.y, b.y]).collect();
    all.sort_by(f64::total_cmp);
    let mut groups: Vec<Vec<f64>> = Vec::new();
    for y in all {
        match groups.last_mut() {
            Some(group) if group.first().is_some_and(|first| y - first < LEVEL_SHARE * length) => group.push(y),
            _ => groups.push(vec![y]),
        }
    }
    let count = groups.len();
    let level = |(i, group): (usize, Vec<f64>)| {
        let of = |pick: Option<&f64>| pick.copied().unwrap_or_default();
        match i {
            0 => of(group.first()),
            _ if i + 1 == count => of(group.last()),
            _ => group.iter().sum::<f64>() / group.len() as f64,
        }
    };
    groups.into_iter().enumerate().map(level).collect()
}

/// The sides of panels at the mean level, each counter-clockwise about the hull as seen from above.
fn waterline(hull: &[Panel]) -> Vec<[Vector3<f64>; 2]> {
    let mut sides: Vec<[Vector3<f64>; 2]> = Vec::new();
    for panel in hull {
        let corners = panel.corners();
        let room = JOIN_SHARE * panel.diagonal;
        for i in 0..corners.len() {
            let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
            if a.z.abs() < room && b.z.abs() < room && (a - b).norm() > room {
                // seen from the water the upper side runs clockwise about the hull
                sides.push([Vector3::new(b.x, b.y, 0.0), Vector3::new(a.x, a.y, 0.0)]);
            }
        }
    }
    sides
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// The upright wall over a ring of points, 1 m deep: counter-clockwise points make a hull, clockwise ones a moonpool.
    fn wall(points: &[[f64; 2]], closed: bool) -> Vec<Panel> {
        let count = if closed { points.len() } else { points.len() - 1 };
        (0..count)
            .map(|i| {
                let ([ax, ay], [bx, by]) = (points[i], points[(i + 1) % points.len()]);
                let at = Vector3::new;
                Panel::new([at(ax, ay, -1.0), at(bx, by, -1.0), at(bx, by, 0.0), at(ax, ay, 0.0)]).unwrap()
            })
            .collect()
    }

    fn circle(centre: [f64; 2], radius: f64, count: i32) -> Vec<[f64; 2]> {
        (0..count.abs())
            .map(|i| TAU * f64::from(i) / f64::from(count))
            .map(|angle| [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()])
            .collect()
    }

    fn area(lid: &[Panel]) -> f64 {
        assert!(lid.iter().all(|panel| panel.normal.z > 0.999));
        lid.iter().map(|panel| panel.area).sum()
    }

    #[test]
    fn rectangle_has_panels_of_size_of_its_sides() {
        let along = (0..=12).map(|i| [45.0 - 3.75 * f64::from(i), 15.0]).rev();
        let across = (0..4).map(|i| [45.0, 3.75 * f64::from(i)]);
        let points: Vec<_> = across.chain(along.rev()).collect();
        let lid = close_waterplane(&wall(&points, false), MirrorPlanes { x: true, y: true }).unwrap();
        assert!((area(&lid) - 675.0).abs() < 1e-9 && lid.len() == 48, "{} {}", area(&lid), lid.len());
    }

    #[test]
    fn circle_keeps_its_area_and_count() {
        // a polygon of 32 sides
        let lid = close_waterplane(&wall(&circle([3.0, -2.0], 5.0, 32), true), MirrorPlanes::default()).unwrap();
        let exact = 16.0 * 25.0 * (TAU / 32.0).sin();
        assert!((area(&lid) / exact - 1.0).abs() < 1e-3, "{} {exact}", area(&lid));
        // 78 m2 by sides of 0.98 m
        assert!((80..=130).contains(&lid.len()), "{}", lid.len());
    }

    #[test]
    fn moonpool_stays_open_and_every_column_is_closed() {
        let mut hull = wall(&circle([0.0, 0.0], 6.0, 48), true);
        hull.extend(wall(&circle([0.0, 0.0], 2.0, -24), true));
        let lid = close_waterplane(&hull, MirrorPlanes::default()).unwrap();
        let exact = 24.0 * 36.0 * (TAU / 48.0).sin() - 12.0 * 4.0 * (TAU / 24.0).sin();
        assert!((area(&lid) / exact - 1.0).abs() < 1e-3, "{} {exact}", area(&lid));
        assert!(lid.iter().all(|panel| panel.centroid.norm() > 1.9));
        let columns: Vec<Panel> = [[10.0, 10.0], [10.0, -10.0], [-10.0, 10.0], [-10.0, -10.0]]
            .iter()
            .flat_map(|centre| wall(&circle(*centre, 3.0, 24), true))
            .collect();
        let lid = close_waterplane(&columns, MirrorPlanes::default()).unwrap();
        let exact = 4.0 * 12.0 * 9.0 * (TAU / 24.0).sin();
        assert!((area(&lid) / exact - 1.0).abs() < 1e-3, "{} {exact}", area(&lid));
    }

    #[test]
    fn waterline_with_gap_is_not_closed_and_hull_below_water_has_none() {
        let mut hull = wall(&circle([0.0, 0.0], 6.0, 48), true);
        hull.remove(3);
        assert_eq!(close_waterplane(&hull, MirrorPlanes::default()), None);
        let at = |x, y| Vector3::new(x, y, -2.0);
        let deep = [Panel::new([at(0.0, 0.0), at(0.0, 1.0), at(1.0, 1.0), at(1.0, 0.0)]).unwrap()];
        assert_eq!(close_waterplane(&deep, MirrorPlanes::default()), Some(Vec::new()));
    }
}
