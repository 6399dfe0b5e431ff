//! What of a solid is below a water surface that is no plane: straight between vertical planes across a heading, as a static wave is or
//! the sections of a longitudinal strength calculation.
//!
//! With t the height over the water's surface, whose slope is constant between two such planes, the fluxes (0, 0, t), (0, 0, x t),
//! (0, 0, t t / 2 + e t), e being the height of the surface, have the divergences 1, x, z. They run along the vertical planes and vanish in
//! the water's surface, so that neither cut needs a lid: the sums over the wet skin, cut at both, are the integrals over the volume. The
//! area of the waterplane is the flux of (0, 0, 1) out of it, less that of the skin.

use crate::hull::{SubmergedVolume, Surface};
use nalgebra::{Vector2, Vector3};
use windlass_base::pose::Pose;

/// A water surface over the distance along a heading.
#[derive(Clone, Debug, PartialEq)]
pub struct WaterSlabs {
    /// Horizontal unit vector along the heading (global).
    pub ahead: Vector2<f64>,
    /// Distances from the origin of the pose along the heading (m), growing, and heights of the water there (m, global). It is straight
    /// between them and level before the first and behind the last.
    pub stations: Vec<[f64; 2]>,
}

/// Corners of a part of a triangle: about the origin of the pose in global axes (m), with the height over the water (m).
type WetCorner = (Vector3<f64>, f64);

impl WaterSlabs {
    /// How many slabs there are: one more than stations.
    pub fn count(&self) -> usize {
        self.stations.len() + 1
    }

    /// The distance of a point from the origin of the pose along the heading (m).
    pub fn distance(&self, arm: &Vector3<f64>) -> f64 {
        self.ahead.dot(&arm.xy())
    }

    /// Height of the water at a distance (m, global).
    pub fn level(&self, distance: f64) -> f64 {
        let behind = self.stations.partition_point(|[at, _]| *at <= distance);
        self.level_in(behind, distance)
    }

    /// Height of the water in a slab, straight on beyond its ends.
    fn level_in(&self, slab: usize, distance: f64) -> f64 {
        let from = slab.checked_sub(1).and_then(|n| self.stations.get(n));
        match (from, self.stations.get(slab)) {
            (Some([a, low]), Some([b, high])) if b > a => low + (high - low) * (distance - a) / (b - a),
            (Some([_, level]), _) | (None, Some([_, level])) => *level,
            (None, None) => 0.0,
        }
    }

    /// What of a surface is wet in a pose, slab by slab, times a factor.
    pub fn add_surface(&self, surface: &Surface, pose: &Pose, factor: f64, sums: &mut [SubmergedVolume]) {
        let placed: Vec<Vector3<f64>> = surface.vertices.iter().map(|p| pose.axes * p).collect();
        let at = |n: u32| placed.get(n as usize).copied();
        for &[a, b, c] in &surface.faces {
            let (Some(a), Some(b), Some(c)) = (at(a), at(b), at(c)) else { continue };
            let reach = [a, b, c].map(|p| self.distance(&p));
            let (low, high) = reach.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), s| (l.min(*s), h.max(*s)));
            let first = self.stations.partition_point(|[at, _]| *at <= low);
            for (slab, sum) in sums.iter_mut().enumerate().take(self.count()).skip(first) {
                let from = slab.checked_sub(1).and_then(|n| self.stations.get(n)).map(|s| s[0]);
                if from.is_some_and(|from| from > high) {
                    break;
                }
                let height = |p: &Vector3<f64>| p.z + pose.origin.z - self.level_in(slab, self.distance(p));
                let mut part: Vec<WetCorner> = [a, b, c].iter().map(|p| (*p, height(p))).collect();
                if let Some(from) = from.filter(|from| *from > low) {
                    part = keep_negative(&part, |(p, _)| from - self.distance(p));
                }
                if let Some([to, _]) = self.stations.get(slab).filter(|[to, _]| *to < high) {
                    part = keep_negative(&part, |(p, _)| self.distance(p) - to);
                }
                part = keep_negative(&part, |(_, t)| *t);
                add_polygon(&part, factor, sum);
            }
        }
    }
}

/// The part of a convex polygon where a function that is straight over it is not positive.
fn keep_negative(polygon: &[WetCorner], value: impl Fn(&WetCorner) -> f64) -> Vec<WetCorner> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (p, q) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let (a, b) = (value(p), value(q));
        if a <= 0.0 {
            kept.push(*p);
        }
        if (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0) {
            let share = a / (a - b);
            kept.push((p.0 + (q.0 - p.0) * share, p.1 + (q.1 - p.1) * share));
        }
    }
    kept
}

/// Adds the integrals of a convex part of the wet skin.
fn add_polygon(polygon: &[WetCorner], factor: f64, sum: &mut SubmergedVolume) {
    let [first, rest @ ..] = polygon else { return };
    for pair in rest.windows(2) {
        let [second, third] = pair else { continue };
        let corners = [first, second, third];
        let normal = (second.0 - first.0).cross(&(third.0 - first.0));
        let area = 0.5 * normal.z * factor;
        sum.wetted_area += 0.5 * normal.norm() * factor;
        // integral of a product of two functions that are straight over the triangle, over its projection
        let product = |f: &dyn Fn(&WetCorner) -> f64, g: &dyn Fn(&WetCorner) -> f64| {
            let (mut fs, mut gs, mut both) = (0.0, 0.0, 0.0);
            for corner in corners {
                let (a, b) = (f(corner), g(corner));
                fs += a;
                gs += b;
                both += a * b;
            }
            area / 12.0 * (fs * gs + both)
        };
        let (x, y, t) = (|c: &WetCorner| c.0.x, |c: &WetCorner| c.0.y, |c: &WetCorner| c.1);
        // the height of the water over the origin of the pose: z - t
        let water = |c: &WetCorner| c.0.z - c.1;
        let whole = |f: &dyn Fn(&WetCorner) -> f64| corners.iter().map(|c| f(c)).sum::<f64>() * area / 3.0;
        sum.volume += whole(&t);
        sum.moment += Vector3::new(product(&x, &t), product(&y, &t), 0.5 * product(&t, &t) + product(&water, &t));
        sum.plane_area -= area;
        sum.plane_moment[0] -= whole(&x);
        sum.plane_moment[1] -= whole(&y);
        sum.plane_second[0] -= product(&x, &x);
        sum.plane_second[1] -= product(&x, &y);
        sum.plane_second[2] -= product(&y, &y);
    }
}
