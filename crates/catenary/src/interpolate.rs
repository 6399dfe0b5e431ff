//! Forces of a line from its table: a monotone cubic in the horizontal distance.
//!
//! Source: [MOSES-FLEX -TAB_LIM]; [W-TABLE] for the rows. The rows are of one elevation of the fairlead; stiffness by
//! that elevation is interpolated from the rows' own. Monotone cubic: [FRITSCH-CARLSON-1980].

use super::error::LineError;
use super::line_forces::LineForces;
use super::table::TableRow;

/// One quantity against the distance.
#[derive(Clone, Debug)]
struct InterpolatedQuantity {
    /// Values and slopes at the points, as many as those.
    y: Vec<f64>,
    slope: Vec<f64>,
}

impl InterpolatedQuantity {
    /// A curve through the points, with these slopes or slopes of its own, reduced until it is monotone.
    fn new(x: &[f64], y: Vec<f64>, slopes: Option<Vec<f64>>) -> InterpolatedQuantity {
        let secants: Vec<f64> = x
            .iter()
            .zip(&y)
            .zip(x.iter().skip(1).zip(y.iter().skip(1)))
            .map(|((x0, y0), (x1, y1))| if x1 > x0 { (y1 - y0) / (x1 - x0) } else { 0.0 })
            .collect();
        let between = |i: usize| {
            let before = i.checked_sub(1).and_then(|i| secants.get(i)).copied();
            let after = secants.get(i).copied();
            match (before, after) {
                (Some(a), Some(b)) if a * b <= 0.0 => 0.0,
                (Some(a), Some(b)) => 2.0 * a * b / (a + b),
                (a, b) => a.or(b).unwrap_or(0.0),
            }
        };
        let mut slope = slopes.unwrap_or_else(|| (0..y.len()).map(between).collect());
        for (i, s) in slope.iter_mut().enumerate() {
            // within three times either secant a cubic is monotone
            for secant in [i.checked_sub(1).and_then(|i| secants.get(i)), secants.get(i)].into_iter().flatten() {
                *s = if *s * secant <= 0.0 { 0.0 } else { s.signum() * s.abs().min(3.0 * secant.abs()) };
            }
        }
        InterpolatedQuantity { y, slope }
    }

    /// Value and slope between points `i` and `i + 1`, `h` apart, at the share `t` of the way.
    fn evaluate(&self, i: usize, h: f64, t: f64) -> (f64, f64) {
        let (y0, y1, s0, s1) = (self.y[i], self.y[i + 1], self.slope[i], self.slope[i + 1]);
        let (a, b) = (h * s0 - (y1 - y0), (y1 - y0) - h * s1);
        let u = 1.0 - t;
        let value = u * y0 + t * y1 + t * u * (a * u + b * t);
        let slope = (y1 - y0) / h + (u - t) * (a * u + b * t) / h + t * u * (b - a) / h;
        (value, slope)
    }
}

/// A line's table as functions of the horizontal distance.
#[derive(Clone, Debug)]
pub struct Interpolated {
    /// Distances that grow, at least two; the curves have a point at each.
    x: Vec<f64>,
    force: InterpolatedQuantity,
    vertical: InterpolatedQuantity,
    /// What friction takes: without any, the anchor's pull is the force.
    taken: InterpolatedQuantity,
    anchor_vertical: InterpolatedQuantity,
    grounded: InterpolatedQuantity,
    ratio: InterpolatedQuantity,
    /// Of d(H, V at the fairlead)/d(x, z): dH/dz less dV/dx, which friction makes, and dV/dz.
    unlike: InterpolatedQuantity,
    heave: InterpolatedQuantity,
    /// d(H, V at the anchor)/d(x, z).
    coupling: [InterpolatedQuantity; 4],
}

/// What the table gives at a distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FromTable {
    /// Forces and their derivatives.
    pub forces: LineForces,
    /// Unstretched length on the bottom (m).
    pub grounded: f64,
    /// Largest tension over own break.
    pub ratio: f64,
    /// The segment that has it, from 1.
    pub critical: usize,
    /// Whether the distance lies beyond the table.
    pub beyond: bool,
}

impl Interpolated {
    /// From the rows of [`super::table`].
    ///
    /// # Errors
    /// [`LineError::Table`]: fewer than two rows, or distances that do not grow with the force.
    pub fn new(rows: &[TableRow]) -> Result<Interpolated, LineError> {
        let of = |f: fn(&TableRow) -> f64| rows.iter().map(f).collect::<Vec<f64>>();
        let x = of(|r| r.state.x);
        let growing = x.windows(2).take_while(|pair| pair[0] < pair[1]).count() + 1;
        if rows.len() < 2 || growing < rows.len() {
            return Err(LineError::Table(growing.min(rows.len())));
        }
        // a fairlead on the bottom has a stiffness without end
        fn finite(v: f64) -> f64 {
            if v.is_finite() { v } else { 0.0 }
        }
        let curve = |f: &dyn Fn(&TableRow) -> f64| {
            InterpolatedQuantity::new(&x, rows.iter().map(|r| finite(f(r))).collect(), None)
        };
        let position = |m: fn(&TableRow) -> [[f64; 2]; 2], i: usize, j: usize| curve(&|r: &TableRow| m(r)[i][j]);
        let coupling = [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| position(|r| r.state.coupling, i, j));
        Ok(Interpolated {
            force: InterpolatedQuantity::new(&x, of(|r| r.state.force), Some(of(|r| 1.0 / r.state.dx_dh))),
            vertical: InterpolatedQuantity::new(
                &x,
                of(|r| r.state.top_vertical),
                Some(of(|r| finite(r.state.stiffness[1][0]))),
            ),
            taken: curve(&|r| r.state.force - r.state.anchor_horizontal),
            anchor_vertical: curve(&|r| r.state.anchor_vertical),
            grounded: curve(&|r| r.state.grounded),
            ratio: curve(&|r| r.ratio),
            unlike: curve(&|r| r.state.stiffness[0][1] - r.state.stiffness[1][0]),
            heave: position(|r| r.state.stiffness, 1, 1),
            coupling,
            x,
        })
    }

    /// The interval that holds a distance (m): its number, its length (m), how far along it the distance is, from 0 to 1, and how
    /// far beyond the table (m).
    fn interval(&self, x: f64) -> (usize, f64, f64, f64) {
        let last = self.x.len() - 1;
        let inside = x.clamp(self.x[0], self.x[last]);
        let i = self.x.partition_point(|v| *v <= inside).clamp(1, last) - 1;
        let from = self.x[i];
        let h = self.x[i + 1] - from;
        (i, h, if h > 0.0 { (inside - from) / h } else { 0.0 }, x - inside)
    }

    /// What the ends of the line are pulled with at a distance (m), as of [`Interpolated::evaluate`].
    pub fn forces(&self, x: f64) -> LineForces {
        let (i, h, t, beyond) = self.interval(x);
        let (mut force, slope) = self.force.evaluate(i, h, t);
        force += slope * beyond;
        let straight = |curve: &InterpolatedQuantity| {
            let (value, slope) = curve.evaluate(i, h, t);
            value + slope * beyond
        };
        let inside = |curve: &InterpolatedQuantity| curve.evaluate(i, h, t).0;
        let (vertical, zx) = self.vertical.evaluate(i, h, t);
        let (xz, zz) = (zx + inside(&self.unlike), inside(&self.heave));
        let [axx, axz, azx, azz] = self.coupling.each_ref().map(inside);
        let force = force.max(0.0);
        LineForces {
            fairlead: [force, vertical + zx * beyond],
            anchor: [(force - straight(&self.taken)).max(0.0), straight(&self.anchor_vertical)],
            stiffness: [[if force > 0.0 { slope } else { 0.0 }, xz], [zx, zz]],
            coupling: [[axx, axz], [azx, azz]],
        }
    }

    /// At a distance (m) not nearer than the first row; beyond the last one on straight lines.
    pub fn evaluate(&self, x: f64, rows: &[TableRow]) -> FromTable {
        let (i, h, t, beyond) = self.interval(x);
        let one = |curve: &InterpolatedQuantity| {
            let (value, slope) = curve.evaluate(i, h, t);
            (value + slope * beyond).max(0.0)
        };
        let critical_row = if t < 0.5 { i } else { i + 1 };
        FromTable {
            forces: self.forces(x),
            grounded: one(&self.grounded),
            ratio: one(&self.ratio),
            critical: rows.get(critical_row).map_or(1, |r| r.critical),
            beyond: beyond > 0.0,
        }
    }
}
