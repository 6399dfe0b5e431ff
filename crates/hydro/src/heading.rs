//! Six values by heading, smooth all round.

use std::f64::consts::{PI, TAU};
use windlass_base::pose::Six;
use windlass_model::ClassError;

/// Six values that depend on a direction: cubic between the headings given, with the slope at each that of the parabola
/// through it and its neighbours, and periodic. Value and slope have no jump, so that an equilibrium is found.
#[derive(Clone, Debug, PartialEq)]
pub struct ByHeading {
    /// Heading (rad) in a turn from the first, value, slope.
    nodes: Vec<(f64, Six, Six)>,
}

/// Which of the six change sign on the other side of a body that is symmetric about its x-z plane.
const MIRROR_SIGNS: [f64; 6] = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0];

impl ByHeading {
    /// A table of headings that grow (rad) and their values.
    ///
    /// # Errors
    /// Fewer than two headings; headings that do not grow, or go round more than once; a symmetric table without both 0 and
    /// 180 degrees, or with sideways values there.
    pub fn new(rows: &[(f64, [f64; 6])], symmetric: bool) -> Result<Self, ClassError> {
        let ends = (rows.first().map_or(0.0, |r| r.0), rows.last().map_or(0.0, |r| r.0));
        if rows.len() < 2 {
            return Err(ClassError::new("a table by heading has at least two headings"));
        }
        if rows.windows(2).any(|w| matches!(w, [a, b] if b.0 <= a.0)) {
            return Err(ClassError::new("headings must grow from row to row"));
        }
        if ends.1 - ends.0 >= TAU - 1e-9 {
            return Err(ClassError::new("headings go round more than once: 360 degrees is 0 again"));
        }
        let mut all: Vec<(f64, Six)> = rows.iter().map(|(h, v)| (*h, Six::from(*v))).collect();
        if symmetric {
            if ends.0.abs() > 1e-9 || (ends.1 - PI).abs() > 1e-9 {
                return Err(ClassError::new("a symmetric table goes from heading 0 to 180"));
            }
            let mirror = Six::from(MIRROR_SIGNS);
            let sideways = |row: &(f64, Six)| (row.1 - row.1.component_mul(&mirror)).amax() != 0.0;
            if all.first().is_some_and(sideways) || all.last().is_some_and(sideways) {
                return Err(ClassError::new("sway, roll and yaw of a symmetric table are zero at headings 0 and 180"));
            }
            let inner = rows.len() - 2;
            let other: Vec<(f64, Six)> =
                all.iter().skip(1).take(inner).rev().map(|(h, v)| (TAU - h, v.component_mul(&mirror))).collect();
            all.extend(other);
        }
        Ok(ByHeading { nodes: with_slopes(&all) })
    }

    /// The same with every heading grown by an angle (rad), and its values in turned axes.
    pub fn rotate(self, angle: f64, axes: impl Fn(Six) -> Six) -> Self {
        let turn = |(at, value, slope): (f64, Six, Six)| (at + angle, axes(value), axes(slope));
        ByHeading { nodes: self.nodes.into_iter().map(turn).collect() }
    }

    /// The values at a heading (rad), and their change with it.
    pub fn interpolate(&self, heading: f64) -> (Six, Six) {
        let [(first, ..), ..] = self.nodes.as_slice() else { return (Six::zeros(), Six::zeros()) };
        let turn = (heading - first).rem_euclid(TAU);
        let next = self.nodes.partition_point(|n| n.0 - first <= turn);
        // behind the last comes the first
        let (a, va, sa) = self.nodes[next.saturating_sub(1)];
        let (b, vb, sb) = self.nodes[next % self.nodes.len()];
        let length = if next < self.nodes.len() { b - a } else { b + TAU - a };
        let t = (turn - (a - first)) / length;
        let (t2, t3) = (t * t, t * t * t);
        let value = va * (2.0 * t3 - 3.0 * t2 + 1.0)
            + vb * (3.0 * t2 - 2.0 * t3)
            + (sa * (t3 - 2.0 * t2 + t) + sb * (t3 - t2)) * length;
        let slope = (vb - va) * (6.0 * (t - t2) / length) + sa * (3.0 * t2 - 4.0 * t + 1.0) + sb * (3.0 * t2 - 2.0 * t);
        (value, slope)
    }
}

/// Adds the slopes to nodes of one turn.
fn with_slopes(all: &[(f64, Six)]) -> Vec<(f64, Six, Six)> {
    let count = all.len();
    let node = |i: usize| all[i % count];
    let made = all.iter().enumerate().map(|(i, (at, value))| {
        let ((before, vb), (after, va)) = (node(i + count - 1), node(i + 1));
        let (back, on) = ((at - before).rem_euclid(TAU), (after - at).rem_euclid(TAU));
        let (behind, ahead) = ((value - vb) / back, (va - value) / on);
        (*at, *value, (behind * on + ahead * back) / (back + on))
    });
    made.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heading_table_is_smooth_periodic_and_mirrored() {
        let row = |h: f64, x: f64, y: f64| (f64::to_radians(h), [x, y, 0.0, 0.0, 0.0, -y]);
        let rows = [row(0.0, -2.0, 0.0), row(60.0, -1.0, -3.0), row(90.0, 0.1, -4.0), row(180.0, 2.5, 0.0)];
        let table = ByHeading::new(&rows, true).unwrap();
        for (heading, value) in rows {
            assert!((table.interpolate(heading + TAU).0 - Six::from(value)).amax() < 1e-12);
            let mirrored = Six::from(value).component_mul(&Six::from(MIRROR_SIGNS));
            assert!((table.interpolate(-heading).0 - mirrored).amax() < 1e-12);
        }
        for step in -50..50 {
            // between headings: at one the second derivative jumps
            let at = 0.131 * f64::from(step) + 0.01;
            let h = 1e-5;
            let by_difference = (table.interpolate(at + h).0 - table.interpolate(at - h).0) / (2.0 * h);
            assert!((table.interpolate(at).1 - by_difference).amax() < 1e-8, "{at}");
        }
    }

    #[test]
    fn cosine_is_interpolated_closely_between_30_degree_headings() {
        // the cubic with slopes by differences errs by some h^3/24 for h = 0.52: below 1 %
        let rows: Vec<_> = (0..12).map(|i| f64::from(i * 30).to_radians()).map(|h| (h, [h.cos(); 6])).collect();
        let table = ByHeading::new(&rows, false).unwrap();
        for step in 0..100 {
            let at = 0.0628 * f64::from(step);
            assert!((table.interpolate(at).0[0] - at.cos()).abs() < 0.01, "{at}");
        }
    }
}
