//! From polygons to a surface of triangles: corners that are one, and polygons cut into triangles.

use super::{HullError, PanelError, Surface};
use nalgebra::{Vector2, Vector3};
use std::collections::HashMap;

/// Corners of a polygon that is not convex: cutting it takes up to the cube of their number.
pub(super) const MAX_POLYGON_CORNERS: usize = 256;

/// Vertices of which no two are nearer than a distance. The map is only asked, never listed, so its order does not matter.
struct Welded {
    vertices: Vec<Vector3<f64>>,
    cells: HashMap<[u64; 3], Vec<u32>>,
    weld: f64,
}

impl Welded {
    /// The vertex at a place: the nearest that is there already, or a new one.
    fn vertex(&mut self, at: Vector3<f64>) -> u32 {
        // adding zero makes one zero of two
        let cell = at.map(|x| if self.weld > 0.0 { (x / self.weld).floor() } else { x } + 0.0);
        let reach: &[f64] = if self.weld > 0.0 { &[0.0, -1.0, 1.0] } else { &[0.0] };
        let mut best: Option<(f64, u32)> = None;
        for dx in reach {
            for dy in reach {
                for dz in reach {
                    let key: [u64; 3] = (cell + Vector3::new(*dx, *dy, *dz)).map(|x| (x + 0.0).to_bits()).into();
                    for &n in self.cells.get(&key).into_iter().flatten() {
                        let Some(vertex) = self.vertices.get(n as usize) else { continue };
                        let away = (vertex - at).norm();
                        if away <= self.weld && best.is_none_or(|(least, _)| away < least) {
                            best = Some((away, n));
                        }
                    }
                }
            }
        }
        if let Some((_, n)) = best {
            return n;
        }
        let n = self.vertices.len() as u32;
        self.vertices.push(at);
        self.cells.entry(cell.map(f64::to_bits).into()).or_default().push(n);
        n
    }
}

impl Surface {
    /// From polygons: the corners of each counter-clockwise as seen from outside (m). Corners that are not further apart
    /// than `weld` (m) are one. A quadrilateral may be warped: it is cut along its shorter diagonal of those inside it.
    ///
    /// # Errors
    /// A polygon with a corner that is no number, with less than three corners that differ, whose edges cross, or which is not
    /// convex and has more than 256 corners: reported with its number, from 1.
    pub fn from_panels(panels: &[Vec<[f64; 3]>], weld: f64) -> Result<Surface, HullError> {
        let weld = if weld.is_finite() { weld.max(0.0) } else { 0.0 };
        let mut welded = Welded { vertices: Vec::new(), cells: HashMap::new(), weld };
        let mut faces = Vec::new();
        for (n, panel) in panels.iter().enumerate() {
            let wrong = |why: PanelError| HullError::Panel { number: n + 1, why };
            if panel.iter().flatten().any(|x| !x.is_finite()) {
                return Err(wrong(PanelError::NotFinite));
            }
            let mut corners: Vec<u32> = panel.iter().map(|&at| welded.vertex(at.into())).collect();
            corners.dedup();
            while corners.len() > 1 && corners.first() == corners.last() {
                corners.pop();
            }
            let mut distinct = corners.clone();
            distinct.sort_unstable();
            distinct.dedup();
            if distinct.len() < 3 {
                return Err(wrong(PanelError::FewCorners(distinct.len())));
            }
            triangulate(&corners, &welded.vertices, &mut faces).map_err(wrong)?;
        }
        Ok(Surface { vertices: welded.vertices, faces })
    }
}

/// Cuts a polygon into triangles of the same sense.
fn triangulate(corners: &[u32], vertices: &[Vector3<f64>], faces: &mut Vec<[u32; 3]>) -> Result<(), PanelError> {
    if let [a, b, c] = *corners {
        faces.push([a, b, c]);
        return Ok(());
    }
    let at: Vec<Vector3<f64>> = corners.iter().filter_map(|&n| vertices.get(n as usize)).copied().collect();
    let flat = flatten_polygon(&at);
    let turns = cycle(&flat).map(|[a, b, c]| turn(a, b, c));
    let size: f64 = flat.iter().map(|p| p.norm_squared()).fold(0.0, f64::max);
    // a corner that turns by less than rounding is straight
    let least = 1e-12 * size;
    if corners.len() > 4 && winds_around_once(&flat) && turns.clone().all(|t| t > least) {
        let [first, rest @ ..] = corners else { return Ok(()) };
        faces.extend(rest.windows(2).filter_map(|w| if let [b, c] = *w { Some([*first, b, c]) } else { None }));
        return Ok(());
    }
    if turns.clone().all(|t| t.abs() <= least) {
        // no area: kept as it is, for `faults` to tell
        let [first, rest @ ..] = corners else { return Ok(()) };
        faces.extend(rest.windows(2).filter_map(|w| if let [b, c] = *w { Some([*first, b, c]) } else { None }));
        return Ok(());
    }
    if corners.len() > MAX_POLYGON_CORNERS {
        return Err(PanelError::ManyCorners(corners.len()));
    }
    let mut left: Vec<(u32, Vector2<f64>, Vector3<f64>)> =
        corners.iter().zip(&flat).zip(&at).map(|((&n, &p), &q)| (n, p, q)).collect();
    while left.len() > 3 {
        let Some(ear) = shortest_ear(&left, least) else { return Err(PanelError::Crossing) };
        if let Some([a, b, c]) = corner_with_neighbours(&left, ear) {
            faces.push([a.0, b.0, c.0]);
        }
        left.remove(ear);
    }
    if let [a, b, c] = *left {
        if turn(a.1, b.1, c.1) < -least {
            return Err(PanelError::Crossing);
        }
        faces.push([a.0, b.0, c.0]);
    }
    Ok(())
}

/// The polygon seen against its mean normal (Newell), about its first corner.
fn flatten_polygon(at: &[Vector3<f64>]) -> Vec<Vector2<f64>> {
    let base = at.first().copied().unwrap_or_default();
    let next = at.iter().cycle().skip(1);
    let normal: Vector3<f64> = at.iter().zip(next).map(|(a, b)| (a - base).cross(&(b - base))).sum();
    let normal = normal.try_normalize(0.0).unwrap_or_else(Vector3::z);
    let mut across = Vector3::zeros();
    across[normal.iamin()] = 1.0;
    let x = across.cross(&normal).try_normalize(0.0).unwrap_or_else(Vector3::x);
    let y = normal.cross(&x);
    at.iter().map(|p| Vector2::new((p - base).dot(&x), (p - base).dot(&y))).collect()
}

/// Each corner between its neighbours.
fn cycle(flat: &[Vector2<f64>]) -> impl Iterator<Item = [Vector2<f64>; 3]> + Clone {
    let before = flat.iter().cycle().skip(flat.len().saturating_sub(1));
    before.zip(flat).zip(flat.iter().cycle().skip(1)).map(|((a, b), c)| [*a, *b, *c])
}

/// Twice the area of a triangle; positive counter-clockwise.
fn turn(a: Vector2<f64>, b: Vector2<f64>, c: Vector2<f64>) -> f64 {
    (b - a).perp(&(c - a))
}

/// Whether the edges turn by one full turn in all.
fn winds_around_once(flat: &[Vector2<f64>]) -> bool {
    let all: f64 = cycle(flat).map(|[a, b, c]| (b - a).perp(&(c - b)).atan2((b - a).dot(&(c - b)))).sum();
    (all - std::f64::consts::TAU).abs() < 1e-6
}

/// A corner between its neighbours.
fn corner_with_neighbours<T: Copy>(list: &[T], n: usize) -> Option<[T; 3]> {
    let before = list.get(n.checked_sub(1).unwrap_or(list.len().checked_sub(1)?))?;
    let after = list.get(n + 1).or_else(|| list.first())?;
    Some([*before, *list.get(n)?, *after])
}

/// The corner that can be cut off with the shortest cut: it turns inward and holds no other corner.
fn shortest_ear(left: &[(u32, Vector2<f64>, Vector3<f64>)], least: f64) -> Option<usize> {
    let mut best: Option<(f64, usize)> = None;
    for n in 0..left.len() {
        let Some([a, b, c]) = corner_with_neighbours(left, n) else { continue };
        let cut = (c.2 - a.2).norm();
        if turn(a.1, b.1, c.1) <= least || best.is_some_and(|(short, _)| short <= cut) {
            continue;
        }
        let inside =
            |p: Vector2<f64>| turn(a.1, b.1, p) >= -least && turn(b.1, c.1, p) >= -least && turn(c.1, a.1, p) >= -least;
        let of_ear = |n: u32| n == a.0 || n == b.0 || n == c.0;
        if !left.iter().any(|&(n, p, _)| !of_ear(n) && inside(p)) {
            best = Some((cut, n));
        }
    }
    best.map(|(_, n)| n)
}
