//! A circular cylinder with flat ends: the integrals over its wet part, at any inclination.
//!
//! A section across the axis is wet below a chord: a circular segment of half angle phi from its lowest point, of area
//! r^2 (phi - sin phi cos phi) and first moment -2/3 r^3 sin^3 phi upward. Along the axis the segments are integrated with phi as
//! variable, in which all integrands are products of phi, sines and cosines: entire functions. Gauss-Legendre quadrature with n
//! points errs on sin(m phi) over a half width h by at most 2^(2n+1) n!^4 / ((2n+1) (2n)!^3) (m h)^(2n) (Abramowitz and Stegun
//! 25.4.30); with 16 points, h <= pi/2 and the highest m = 5 that is 1e-16. So it has the digits of the closed form, which
//! itself loses them where the axis is nearly level (it divides small differences by the slope).

use super::{Solid, SubmergedVolume, Surface};
use nalgebra::{Matrix2, Vector2, Vector3};
use std::f64::consts::{FRAC_PI_2, PI};
use windlass_base::pose::Pose;

/// A circular cylinder with flat ends, body coordinates (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TubeHull {
    /// The centres of its ends (m).
    pub ends: [Vector3<f64>; 2],
    /// Its outer diameter (m).
    pub diameter: f64,
}

impl TubeHull {
    /// The prism of a number of sides whose width, in the mean of all sides, is the diameter: its perimeter is that of the tube
    /// (Cauchy). `None` of a tube without length or diameter.
    pub fn prism(&self, sides: u32) -> Option<Surface> {
        self.with_diameters(&[(0.0, self.diameter), (1.0, self.diameter)], sides)
    }

    /// Whether nothing of one can lie in the other: their axes are further apart than both radii.
    pub fn is_apart(&self, other: &TubeHull) -> bool {
        // the prisms that stand for them are wider than the tubes by 0.04 %
        let reach = 0.5 * 1.001 * (self.diameter + other.diameter);
        segment_distance(&self.ends, &other.ends) > reach
    }

    /// The same with a diameter (m) that is straight along the axis between stations, from 0 at the first end to 1 at the second;
    /// two at one place make a step.
    pub fn with_diameters(&self, stations: &[(f64, f64)], sides: u32) -> Option<Surface> {
        let [foot, head] = self.ends;
        let axis = (head - foot).try_normalize(0.0).filter(|_| self.diameter > 0.0)?;
        let mut across = Vector3::zeros();
        across[axis.iamin()] = 1.0;
        let x = axis.cross(&across).try_normalize(0.0)?;
        let y = axis.cross(&x);
        let step = 2.0 * PI / f64::from(sides);
        let rim = |(at, diameter): &(f64, f64)| {
            let (end, radius) = (foot + (head - foot) * *at, 0.5 * diameter * (step / 2.0) / (step / 2.0).sin());
            (0..sides).map(move |n| {
                let (sin, cos) = (step * f64::from(n)).sin_cos();
                end + (x * cos + y * sin) * radius
            })
        };
        let last = u32::try_from(stations.len()).ok()?.checked_sub(1)?;
        let vertices = stations.iter().flat_map(rim).collect();
        let side = (0..last).flat_map(|k| (0..sides).map(move |n| (k * sides + n, k * sides + (n + 1) % sides)));
        let mantle = side.flat_map(|(n, m)| [[n, m, m + sides], [n, m + sides, n + sides]]);
        let top = last * sides;
        let ends = (1..sides.saturating_sub(1)).flat_map(|n| [[0, n + 1, n], [top, top + n, top + n + 1]]);
        Some(Surface { vertices, faces: mantle.chain(ends).collect() })
    }
}

/// The distance of two straight segments [ERICSON-2005 5.1.9].
fn segment_distance([p, p_end]: &[Vector3<f64>; 2], [q, q_end]: &[Vector3<f64>; 2]) -> f64 {
    let (along, other, between) = (p_end - p, q_end - q, p - q);
    let (a, e, f) = (along.norm_squared(), other.norm_squared(), other.dot(&between));
    let (b, c) = (along.dot(&other), along.dot(&between));
    let share = |value: f64, of: f64| if of > 0.0 { (value / of).clamp(0.0, 1.0) } else { 0.0 };
    let parallel = a * e - b * b;
    // parallel ones are as near at one end as anywhere they stand side by side
    let first = if parallel > 1e-12 * a * e { share(b * f - c * e, parallel) } else { 0.0 };
    let second = share(b * first + f, e);
    let first = share(b * second - c, a);
    (between + along * first - other * second).norm()
}

/// Points and weights of Gauss-Legendre quadrature of 16 points on [-1, 1], for the positive half (Newton's method on the Legendre
/// polynomial in 50 digits; Abramowitz and Stegun, table 25.4).
const GAUSS: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_58),
    (0.458_016_777_657_227_37, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_8, 0.149_595_988_816_576_74),
    (0.755_404_408_355_003, 0.124_628_971_255_533_88),
    (0.865_631_202_387_831_8, 0.095_158_511_682_492_79),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_894),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_096),
];

/// The tube as it stands to the water: the axis runs from the lower end.
struct TubeInWater {
    /// The lower end, about the pose's origin.
    foot: Vector3<f64>,
    /// Unit vector along the axis, upward or level.
    axis: Vector3<f64>,
    /// Unit vector of the axis seen from above.
    ahead: Vector2<f64>,
    /// Height of the foot's centre over the water.
    height: f64,
    /// Sine and cosine of the axis with the horizontal.
    sine: f64,
    cosine: f64,
    length: f64,
    radius: f64,
}

/// The length of the axis along which sections are cut by the water's surface, with the half angles of their segments.
struct CutZone {
    /// Where it begins on the axis; nearer the foot sections are wet, beyond the zone dry.
    from: f64,
    /// How long it is.
    long: f64,
    /// Mean of the half angles at its two ends, with sine and cosine.
    mean: f64,
    sin: f64,
    cos: f64,
    /// Half their difference, not negative.
    half: f64,
    /// The half angles at foot and head of the tube.
    ends: [f64; 2],
}

impl TubeInWater {
    fn new(tube: &TubeHull, pose: &Pose, level: f64) -> Option<TubeInWater> {
        let [mut foot, mut head] = tube.ends.map(|end| pose.axes * end);
        if foot.z > head.z {
            std::mem::swap(&mut foot, &mut head);
        }
        let span = head - foot;
        let (length, radius) = (span.norm(), tube.diameter / 2.0);
        if !(length > 0.0 && radius > 0.0 && length.is_finite() && radius.is_finite()) {
            return None;
        }
        let axis = span / length;
        let cosine = axis.x.hypot(axis.y);
        // by `hypot`, as squares of a small lean vanish
        let ahead = if cosine > 0.0 { Vector2::new(axis.x / cosine, axis.y / cosine) } else { Vector2::x() };
        let height = foot.z + (pose.origin.z - level);
        Some(TubeInWater { foot, axis, ahead, height, sine: axis.z, cosine, length, radius })
    }

    /// Where sections are cut. With the rise R of a section's highest point over its centre, h1 and h2 the heights of the
    /// centres at the zone's ends, A = sqrt(1 - h/R), B = sqrt(1 + h/R): the half angle is 2 atan(A / B), and sums and
    /// differences of two of them follow without loss from
    /// sin(mean) = (A1 B2 + A2 B1) / 2, cos(mean) = (B1 B2 - A1 A2) / 2,
    /// tan(half) = 2 (h2 - h1) / R / (A1 B2 + A2 B1) / (B1 B2 + A1 A2).
    fn zone(&self) -> CutZone {
        let rise = self.cosine * self.radius;
        let (foot, head) = (self.height, self.height + self.sine * self.length);
        let all = |from: f64, angle: f64| CutZone {
            from,
            long: 0.0,
            mean: angle,
            sin: 0.0,
            cos: angle.cos(),
            half: 0.0,
            ends: [angle; 2],
        };
        if head + rise < 0.0 {
            return all(self.length, PI);
        }
        if foot >= rise {
            return all(0.0, 0.0);
        }
        let (below, above) = (foot + rise <= 0.0 && self.sine > 0.0, head >= rise && self.sine > 0.0);
        let from = if below { (-(foot + rise) / self.sine).min(self.length) } else { 0.0 };
        if rise == 0.0 {
            return CutZone { from, long: 0.0, mean: FRAC_PI_2, sin: 1.0, cos: 0.0, half: FRAC_PI_2, ends: [PI, 0.0] };
        }
        let (h1, h2) = (if below { -rise } else { foot }, if above { rise } else { head });
        let difference = if below || above { h2 - h1 } else { self.sine * self.length };
        let long = if below || above { difference / self.sine } else { self.length };
        // heights in units of the rise: it may be as small as numbers get
        let root = |h: f64| ((1.0 - h / rise).max(0.0).sqrt(), (1.0 + h / rise).max(0.0).sqrt());
        let ((a1, b1), (a2, b2)) = (root(h1), root(h2));
        let crossed = a1 * b2 + a2 * b1;
        if crossed <= 0.0 {
            // level, and its top in the surface but for rounding
            return all(self.length, PI);
        }
        let (sin, cos) = (crossed / 2.0, (b1 * b2 - a1 * a2) / 2.0);
        let half = (2.0 * (difference / rise) / crossed).max(0.0).atan2(b1 * b2 + a1 * a2);
        CutZone { from, long, mean: sin.atan2(cos), sin, cos, half, ends: [2.0 * a1.atan2(b1), 2.0 * a2.atan2(b2)] }
    }

    /// Adds the length from the foot that is wet all round.
    fn whole(&self, to: f64, wet: &mut SubmergedVolume) {
        let area = PI * self.radius * self.radius;
        wet.volume += area * to;
        wet.moment += (self.foot + self.axis * (to / 2.0)) * (area * to);
        wet.wetted_area += 2.0 * PI * self.radius * to;
    }

    /// Adds what is wet, and the waterplane, along the zone.
    fn add_wet_part(&self, zone: &CutZone, wet: &mut SubmergedVolume) {
        let (r, s, c) = (self.radius, self.sine, self.cosine);
        let CutZone { long, half, .. } = *zone;
        // sin(half y) / sin(half), and its limit
        let part = |y: f64| if half > 0.0 { (half * y).sin() / half.sin() } else { y };
        let stretch = if half > 0.0 { half / half.sin() } else { 1.0 };
        // sine and cosine of the mean plus an angle
        let turned = |y: f64| {
            let (sin, cos) = y.sin_cos();
            (zone.sin * cos + zone.cos * sin, zone.cos * cos - zone.sin * sin)
        };
        let up = Vector3::new(-s * self.ahead.x, -s * self.ahead.y, c);
        let mut second = Matrix2::zeros();
        let mut first = Vector2::zeros();
        let nodes = GAUSS.iter().flat_map(|&(x, w)| [(-x, w), (x, w)]);
        for (x, weight) in nodes {
            let angle = zone.mean - half * x;
            let (sin, cos) = turned(-half * x);
            let at = zone.from + long * turned(half * (1.0 - x) / 2.0).0 / zone.sin * part((1.0 + x) / 2.0);
            let step = weight * long * stretch * sin / (2.0 * zone.sin);
            let area = r * r * segment(angle, sin, cos);
            wet.volume += area * step;
            wet.moment += (self.foot + self.axis * at) * (area * step) - up * (2.0 / 3.0 * (r * sin).powi(3) * step);
            wet.wetted_area += 2.0 * r * angle * step;
            // the waterplane: chords across the axis, at a distance from the foot as seen from above. For a steep axis that
            // follows from the angle, for a flat one from the place on the axis.
            let (distance, step) = if s >= c {
                ((r * cos - self.height * c) / s, weight * half * r * sin / s)
            } else {
                ((at + s * self.height) / c, step / c)
            };
            let centre = Vector2::new(self.foot.x, self.foot.y) + self.ahead * distance;
            let chord = 2.0 * r * sin * step;
            wet.plane_area += chord;
            first += centre * chord;
            let across = Vector2::new(-self.ahead.y, self.ahead.x);
            second += centre * centre.transpose() * chord;
            second += across * across.transpose() * (2.0 / 3.0 * (r * sin).powi(3) * step);
        }
        wet.plane_moment = [first.x, first.y];
        wet.plane_second = [second.m11, (second.m12 + second.m21) / 2.0, second.m22];
    }
}

/// phi - sin phi cos phi: the area of a circular segment of unit radius, by its series where the difference would lose digits.
fn segment(angle: f64, sin: f64, cos: f64) -> f64 {
    if angle > 0.5 {
        return angle - sin * cos;
    }
    // (y - sin y) / 2 with y = 2 phi
    let y = 2.0 * angle;
    let mut term = y * y * y / 12.0;
    let mut sum = term;
    for n in (4..=18).step_by(2) {
        term *= -y * y / f64::from(n * (n + 1));
        sum += term;
    }
    sum
}

impl Solid for TubeHull {
    /// What is level with the surface is treated as by a [`super::Surface`]: an end or a side that just touches it from above is dry,
    /// an upright tube whose head is just awash has its waterplane.
    fn wet(&self, pose: &Pose, level: f64) -> SubmergedVolume {
        let mut wet = SubmergedVolume::default();
        let Some(tube) = TubeInWater::new(self, pose, level) else { return wet };
        let zone = tube.zone();
        if zone.from > 0.0 {
            tube.whole(zone.from, &mut wet);
        }
        if zone.sin > 0.0 {
            tube.add_wet_part(&zone, &mut wet);
        }
        for angle in zone.ends {
            wet.wetted_area += tube.radius * tube.radius * segment(angle, angle.sin(), angle.cos());
        }
        wet
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segment_distance_matches_nearest_points() {
        // crossing above each other; skew, nearest at an end; parallel side by side, and behind each other; a point
        let at = |p: [[f64; 3]; 2]| p.map(Vector3::from);
        for (p, q, want) in [
            ([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[0.0, -1.0, 2.0], [0.0, 1.0, 2.0]], 2.0),
            ([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]], [[4.0, 4.0, 0.0], [4.0, 9.0, 1.0]], 5.0),
            ([[0.0, 0.0, 0.0], [0.0, 0.0, 10.0]], [[3.0, 4.0, 9.0], [3.0, 4.0, 20.0]], 5.0),
            ([[0.0, 0.0, 0.0], [0.0, 0.0, 10.0]], [[0.0, 0.0, 12.0], [0.0, 0.0, 20.0]], 2.0),
            ([[0.0, 0.0, 0.0], [0.0, 0.0, 10.0]], [[6.0, 8.0, 5.0], [6.0, 8.0, 5.0]], 10.0),
        ] {
            let (p, q) = (at(p), at(q));
            let turned = |[a, b]: [Vector3<f64>; 2]| [b, a];
            for (a, b) in [(p, q), (q, p), (turned(p), q), (p, turned(q))] {
                assert!((segment_distance(&a, &b) - want).abs() < 1e-12, "{a:?} {b:?}");
            }
        }
    }
}
