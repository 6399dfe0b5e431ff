//! The bottom as heights over a grid of x and y, regular or not.
//!
//! Between the points it is a bicubic Hermite surface: in every cell the heights, slopes and twists of its corners hold, so that height
//! and slopes are continuous over the whole grid. The slopes at a point are those of the parabola through it and its two neighbours
//! (one-sided at an edge), the twists the same of the slopes: a plane, and any surface quadratic in x and in y, is met exactly. Beyond
//! its edges the bottom keeps the height of the edge, and slopes along the edge only; the slope across it ends there.
//! Source: [DEBOOR-1962] for the cells; Bessel's parabolas for the slopes [DEBOOR-1978 IV].

use super::ClassError;
use windlass_base::span::Span;
use windlass_base::units::Dim;

/// The most points of a grid: 32 bytes each, 128 MB together.
pub const MAX_GRID_POINTS: usize = 4_000_000;

/// A bottom over a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Bathymetry {
    /// Its name as written.
    pub name: String,
    /// Places of its columns and rows (m, global), growing.
    x: Vec<f64>,
    y: Vec<f64>,
    /// Of every point, row by row of one y: height (m, global z), its slopes dz/dx and dz/dy, and d2z/dxdy (1/m).
    points: Vec<[f64; 4]>,
    /// Where it was defined.
    pub span: Span,
}

impl Bathymetry {
    /// A bottom of a name from the places of its columns and rows (m) and its heights (m, global z), row by row of one y.
    ///
    /// # Errors
    /// Fewer than two columns or rows, places that do not grow, more points than [`MAX_GRID_POINTS`], heights that are too few or
    /// too many or no numbers.
    pub fn new(name: &str, x: Vec<f64>, y: Vec<f64>, heights: &[f64], span: Span) -> Result<Self, ClassError> {
        for (positions, what) in [(&x, "x"), (&y, "y")] {
            grows(positions, what).map_err(|e| e.with_span(span))?;
        }
        let wanted = fits(x.len(), y.len()).map_err(|e| e.with_span(span))?;
        if heights.len() != wanted {
            let text = format!("{} by {} points have {wanted} heights, not {}", x.len(), y.len(), heights.len());
            return Err(ClassError::new(text).with_span(span));
        }
        if heights.iter().any(|z| !z.is_finite()) {
            return Err(ClassError::new("a height of the bottom is not finite").with_span(span));
        }
        let mut points: Vec<[f64; 4]> = heights.iter().map(|z| [*z, 0.0, 0.0, 0.0]).collect();
        let columns = x.len();
        for row in points.chunks_exact_mut(columns) {
            slopes(&x, row, 0, 1);
        }
        let mut column = vec![[0.0; 4]; y.len()];
        for at in 0..columns {
            for (to, from) in column.iter_mut().zip(points.iter().skip(at).step_by(columns)) {
                *to = *from;
            }
            slopes(&y, &mut column, 0, 2);
            slopes(&y, &mut column, 1, 3);
            for (from, to) in column.iter().zip(points.iter_mut().skip(at).step_by(columns)) {
                *to = *from;
            }
        }
        Ok(Bathymetry { name: name.to_string(), x, y, points, span })
    }

    /// A bottom from points x, y, z (m, global) in any order that together make a grid.
    ///
    /// # Errors
    /// Points that make no grid: a place without a height or with two, and as [`Bathymetry::new`].
    pub fn from_points(name: &str, mut given: Vec<[f64; 3]>, span: Span) -> Result<Self, ClassError> {
        if given.iter().flatten().any(|v| !v.is_finite()) {
            return Err(ClassError::new("a position of the bottom is not finite").with_span(span));
        }
        // one zero, not two
        given.iter_mut().flatten().for_each(|v| *v += 0.0);
        given.sort_by(|a, b| a[1].total_cmp(&b[1]).then(a[0].total_cmp(&b[0])));
        let different = |axis: usize| {
            let mut all: Vec<f64> = given.iter().map(|p| p[axis]).collect();
            all.sort_by(f64::total_cmp);
            all.dedup();
            all
        };
        let (x, y) = (different(0), different(1));
        let length = |v: f64| (v, Dim::Length);
        if let Some([a, b]) = given.windows(2).find_map(|w| match w {
            [a, b] if a[0] == b[0] && a[1] == b[1] => Some([a, b]),
            _ => None,
        }) {
            let values = [length(a[0]), length(a[1]), length(a[2]), length(b[2])];
            return Err(ClassError::with_values("the bottom at x = {}, y = {} is given twice: {} and {}", &values)
                .with_span(span));
        }
        let wanted = x.len().saturating_mul(y.len());
        if given.len() != wanted {
            let (columns, rows, count) = (x.len(), y.len(), given.len());
            let text = format!(
                "{count} points with {columns} different x and {rows} different y make no grid: that has {wanted} points"
            );
            let mut error = ClassError::new(text);
            let positions = y.iter().flat_map(|y| x.iter().map(move |x| (*x, *y)));
            let there = given.iter().map(Some).chain(std::iter::repeat(None));
            let missing = |((x, y), p): &((f64, f64), Option<&[f64; 3]>)| p.is_none_or(|p| p[0] != *x || p[1] != *y);
            if let Some(((x, y), _)) = positions.zip(there).find(missing) {
                let further = ClassError::with_values(
                    "the first place without a height is x = {}, y = {}",
                    &[length(x), length(y)],
                );
                error.message = error.message.then("; ").then(further.message);
            }
            return Err(error.with_span(span).help("every x has a point at every y"));
        }
        let heights: Vec<f64> = given.iter().map(|p| p[2]).collect();
        Bathymetry::new(name, x, y, &heights, span)
    }

    /// Elevation of the bottom (m, global z) and its slopes dz/dx, dz/dy at a place (m).
    pub fn elevation_and_slopes(&self, x: f64, y: f64) -> (f64, [f64; 2]) {
        let (column, across) = CubicCell::locate(&self.x, x);
        let (row, up) = CubicCell::locate(&self.y, y);
        let columns = self.x.len();
        let corner =
            |i: usize, j: usize| self.points.get((row + j) * columns + column + i).copied().unwrap_or([f64::NAN; 4]);
        let (mut z, mut by_x, mut by_y) = (0.0, 0.0, 0.0);
        for i in 0..2 {
            for j in 0..2 {
                let [height, slope_x, slope_y, twist] = corner(i, j);
                // along x the height and its slope, each with what it is along y
                let (h, hy) =
                    (height * up.value[j] + slope_y * up.slope[j], height * up.value_by[j] + slope_y * up.slope_by[j]);
                let (s, sy) =
                    (slope_x * up.value[j] + twist * up.slope[j], slope_x * up.value_by[j] + twist * up.slope_by[j]);
                z += h * across.value[i] + s * across.slope[i];
                by_x += h * across.value_by[i] + s * across.slope_by[i];
                by_y += hy * across.value[i] + sy * across.slope[i];
            }
        }
        (z, [by_x, by_y])
    }

    /// Least and greatest x, then y, of the grid (m).
    pub fn extent(&self) -> [[f64; 2]; 2] {
        [&self.x, &self.y].map(|list| [0, list.len() - 1].map(|i| list.get(i).copied().unwrap_or(f64::NAN)))
    }

    /// How far a place (m) lies beyond the edges of the grid (m); 0 on it.
    pub fn distance_outside(&self, position: [f64; 2]) -> f64 {
        let axes = self.extent().into_iter().zip(position);
        axes.map(|([low, high], at)| (low - at).max(at - high).max(0.0)).fold(0.0, f64::hypot)
    }

    /// The shortest distance between neighbouring columns or rows (m).
    pub fn finest_spacing(&self) -> f64 {
        let steps = |positions: &[f64]| positions.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
        steps(&self.x).min(steps(&self.y))
    }

    /// Places of its columns and of its rows (m), growing.
    pub fn places(&self) -> [&[f64]; 2] {
        [&self.x, &self.y]
    }

    /// Heights of its points (m, global z), row by row of one y.
    pub fn point_heights(&self) -> impl Iterator<Item = f64> {
        self.points.iter().map(|[z, ..]| *z)
    }

    /// Numbers of its columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.x.len(), self.y.len()]
    }

    /// Heights of its deepest and of its highest point (m, global z).
    pub fn heights(&self) -> [f64; 2] {
        let all = || self.points.iter().map(|p| p[0]);
        [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)]
    }
}

/// How many points a grid of so many columns and rows has.
///
/// # Errors
/// More than [`MAX_GRID_POINTS`].
pub fn fits(columns: usize, rows: usize) -> Result<usize, ClassError> {
    match columns.checked_mul(rows) {
        Some(count) if count <= MAX_GRID_POINTS => Ok(count),
        count => {
            let size = size_of::<[f64; 4]>();
            let megabytes = count.map_or(f64::INFINITY, |n| n as f64 * size as f64 / 1e6);
            let text = format!(
                "a bottom of {columns} by {rows} points asks for {megabytes:.0} MB: at most {MAX_GRID_POINTS} points, {} MB, are taken",
                MAX_GRID_POINTS * size / 1_000_000
            );
            Err(ClassError::new(text).help("leave points out: the bottom is smooth between them"))
        }
    }
}

fn grows(positions: &[f64], what: &str) -> Result<(), ClassError> {
    if positions.len() < 2 {
        return Err(ClassError::new(format!(
            "a bottom has at least two different {what}, and this one {}",
            positions.len()
        )));
    }
    let wrong = positions.windows(2).find_map(|w| match w {
        [a, b] if a < b && a.is_finite() && b.is_finite() => None,
        [a, b] => Some([(*b, Dim::Length), (*a, Dim::Length)]),
        _ => None,
    });
    match wrong {
        Some(values) => {
            Err(ClassError::with_values(format!("{what} of the bottom must grow: {{}} follows {{}}"), &values))
        }
        None => Ok(()),
    }
}

/// Puts the slopes of one of the values of points at these places into another.
fn slopes(positions: &[f64], points: &mut [[f64; 4]], from: usize, to: usize) {
    let parts: Vec<(f64, f64)> = positions
        .windows(2)
        .zip(points.windows(2))
        .map(|(at, of)| {
            let step = at[1] - at[0];
            (step, (of[1][from] - of[0][from]) / step)
        })
        .collect();
    let last = points.len() - 1;
    for (i, point) in points.iter_mut().enumerate() {
        let before = i.checked_sub(1).and_then(|b| parts.get(b));
        point[to] = match (before, parts.get(i)) {
            (Some((a, left)), Some((b, right))) => (left * b + right * a) / (a + b),
            (None, Some((a, own))) => parts.get(1).map_or(*own, |(b, next)| own - (next - own) * a / (a + b)),
            (Some((a, own)), None) => {
                let other = last.checked_sub(2).and_then(|b| parts.get(b));
                other.map_or(*own, |(b, next)| own + (own - next) * a / (a + b))
            }
            (None, None) => 0.0,
        };
    }
}

/// Hermite's cubics at a place of a cell: what its two ends give by their values and slopes, and how that changes with the place.
struct CubicCell {
    value: [f64; 2],
    slope: [f64; 2],
    value_by: [f64; 2],
    slope_by: [f64; 2],
}

impl CubicCell {
    /// The number of the cell in which a place lies, and its cubics there; beyond the edges those of the edge, without change.
    fn locate(positions: &[f64], at: f64) -> (usize, CubicCell) {
        let index = positions.partition_point(|p| *p <= at).saturating_sub(1).min(positions.len() - 2);
        let (low, high) = (positions[index], positions[index + 1]);
        let step = high - low;
        let whole = (at - low) / step;
        let t = whole.clamp(0.0, 1.0);
        // beyond the edge nothing changes
        let rate = if whole == t { 1.0 / step } else { 0.0 };
        let (t2, t3) = (t * t, t * t * t);
        let cell = CubicCell {
            value: [1.0 - 3.0 * t2 + 2.0 * t3, 3.0 * t2 - 2.0 * t3],
            slope: [step * (t - 2.0 * t2 + t3), step * (t3 - t2)],
            value_by: [6.0 * (t2 - t) * rate, 6.0 * (t - t2) * rate],
            slope_by: [step * rate * (1.0 - 4.0 * t + 3.0 * t2), step * rate * (3.0 * t2 - 2.0 * t)],
        };
        (index, cell)
    }
}

#[cfg(test)]
mod tests;
