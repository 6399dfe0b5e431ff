//! One elastic segment under given end forces: how far it reaches, how high it rises, and the derivatives.

use super::line::Segment;

/// Reach and rise of a stretch of line with their derivatives.
///
/// `x`, `z`: horizontal and vertical distance from the lower to the upper end (m). `_h`: derivative with respect to the
/// horizontal force at fixed vertical force (m/N); `_v`: with respect to the vertical force, which shifts by the same
/// amount at both ends (m/N).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach {
    pub x: f64,
    pub z: f64,
    pub x_h: f64,
    pub x_v: f64,
    pub z_h: f64,
    pub z_v: f64,
}

impl std::ops::AddAssign for Reach {
    fn add_assign(&mut self, other: Self) {
        self.x += other.x;
        self.z += other.z;
        self.x_h += other.x_h;
        self.x_v += other.x_v;
        self.z_h += other.z_h;
        self.z_v += other.z_v;
    }
}

/// A segment hanging free between a lower section with vertical force `low` and an upper one with `low + w L`.
///
/// x = (H/w)(asinh(V1/H) - asinh(V0/H)) + H L/EA, z = (T1 - T0)/w + (V0 + V1) L/(2 EA)
/// (Irvine 1981, eqs 1.36 and 1.37, in forces).
pub fn hanging(segment: &Segment, h: f64, low: f64) -> Reach {
    let Segment { length, weight, ea } = *segment;
    let high = low + weight * length;
    let (t0, t1) = (h.hypot(low), h.hypot(high));
    let flexibility = length / ea;
    // sums over T, not differences: exact also for a weightless or a very taut segment
    let z_rigid = length * (low + high) / (t0 + t1);
    let x_rigid = length * horizontal_share(h, low, high, t0, t1);
    let inverse = length * mean(|v| 1.0 / h.hypot(v).powi(3), low, high);
    let (hh, hv, vv) = closed(h, low, high, t0, t1, length).unwrap_or_else(|| {
        let hv = -length * mean(|v| h * v / h.hypot(v).powi(3), low, high);
        let vv = length * mean(|v| v * v / h.hypot(v).powi(3), low, high);
        (vv, hv, h * h * inverse)
    });
    Reach {
        x: x_rigid + h * flexibility,
        z: z_rigid + 0.5 * (low + high) * flexibility,
        x_h: hh + flexibility,
        x_v: hv,
        z_h: hv,
        z_v: vv + flexibility,
    }
}

/// The stretch of a grounded segment that is lifted: from the touchdown, where V = 0, up to a section with vertical
/// force `high` >= 0; with the rest of the segment lying on the bottom under the tension H.
///
/// Returns the reach of the whole segment and the unstretched length on the bottom. `weight` must be positive.
pub fn lifted(segment: &Segment, h: f64, high: f64) -> (Reach, f64) {
    let Segment { length, weight, ea } = *segment;
    let t = h.hypot(high);
    let hanging = high / weight;
    let ground = (length - hanging).max(0.0);
    let ratio = high * high / (t * (t + h));
    let rise = (high / h).asinh();
    let x_h_rigid = small_difference(high / h).map_or(rise - high / t, |series| series) / weight;
    let reach = Reach {
        x: h / weight * rise + h * hanging / ea + ground * (1.0 + h / ea),
        z: (high * high / (t + h) + 0.5 * high * high / ea) / weight,
        x_h: x_h_rigid + (hanging + ground) / ea,
        x_v: -ratio / weight,
        z_h: -ratio / weight,
        z_v: (high / t + high / ea) / weight,
    };
    (reach, ground)
}

/// asinh(a) - a/sqrt(1+a2) for small a, where the difference would lose its digits: a3/3 - 3 a5/10 + 15 a7/56 - ...
fn small_difference(a: f64) -> Option<f64> {
    let q = a * a;
    (q < 1e-2).then(|| {
        let c = [1.0 / 3.0, -3.0 / 10.0, 15.0 / 56.0, -35.0 / 144.0, 315.0 / 1408.0, -693.0 / 3328.0, 3003.0 / 15360.0];
        a * q * c.iter().rev().fold(0.0, |sum, c| sum * q + c)
    })
}

/// Mean of H/T over the segment: the horizontal reach of an inextensible one per length.
fn horizontal_share(h: f64, low: f64, high: f64, t0: f64, t1: f64) -> f64 {
    let change = high - low;
    if change == 0.0 {
        return h / t0;
    }
    let sine = if low * high > 0.0 {
        // asinh(a) - asinh(b) = asinh((a2 - b2)/(a sqrt(1+b2) + b sqrt(1+a2))) for a, b of one sign
        change * (low + high) / (high * t0 + low * t1)
    } else {
        (high * t0 - low * t1) / (h * h)
    };
    h * sine.asinh() / change
}

/// The integrals of V2/T3, -H V/T3 and H2/T3 over the segment in closed form; `None` where differences would lose
/// digits, that is where V changes little against T.
fn closed(h: f64, low: f64, high: f64, t0: f64, t1: f64, length: f64) -> Option<(f64, f64, f64)> {
    let change = high - low;
    if change.abs() < 0.2 * t0.min(t1) {
        return None;
    }
    // high/T1 - low/T0, for one sign without the difference of two numbers near one
    let turn = if low * high > 0.0 {
        h * h * change * (low + high) / ((high * t0 + low * t1) * t0 * t1)
    } else {
        high / t1 - low / t0
    };
    let vv = length * turn / change;
    let hv = -h * length * (low + high) / ((t0 + t1) * t0 * t1);
    let hh = length * (horizontal_share(h, low, high, t0, t1) / h - turn / change);
    Some((hh, hv, vv))
}

/// Places and weights of Gauss's rule with eight points, for the half interval.
pub const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
];

/// Mean of a smooth function of V between two values that differ little against T: Gauss with eight points, whose
/// error there is below 1e-15.
fn mean(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    0.5 * GAUSS.iter().map(|(x, w)| w * (f(middle - half * x) + f(middle + half * x))).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check_derivatives(h: f64, low: f64, segment: &Segment) {
        let reach = hanging(segment, h, low);
        let (dh, dv) = (h * 1e-6, (low.abs() + h) * 1e-6);
        let plus = hanging(segment, h + dh, low);
        let minus = hanging(segment, h - dh, low);
        let scale = reach.x_h.abs() + reach.z_v.abs();
        assert!(((plus.x - minus.x) / (2.0 * dh) - reach.x_h).abs() < 1e-6 * scale, "x_h {reach:?}");
        assert!(((plus.z - minus.z) / (2.0 * dh) - reach.z_h).abs() < 1e-6 * scale, "z_h {reach:?}");
        let plus = hanging(segment, h, low + dv);
        let minus = hanging(segment, h, low - dv);
        assert!(((plus.x - minus.x) / (2.0 * dv) - reach.x_v).abs() < 1e-6 * scale, "x_v {reach:?}");
        assert!(((plus.z - minus.z) / (2.0 * dv) - reach.z_v).abs() < 1e-6 * scale, "z_v {reach:?}");
    }

    #[test]
    fn derivatives_are_the_differences_of_reach_and_rise() {
        for weight in [500.0, -300.0, 0.01] {
            for (h, low) in [(1e5, 2e4), (1e5, -4e4), (3e3, 0.0), (2e6, -1e5), (50.0, 9e4)] {
                check_derivatives(h, low, &Segment { length: 700.0, weight, ea: 5e8 });
            }
        }
        let chain = Segment { length: 900.0, weight: 1500.0, ea: 8e8 };
        for (h, high) in [(1e5, 4e5), (1e6, 2e4), (2e3, 9e5)] {
            let (reach, _) = lifted(&chain, h, high);
            let (plus, minus) = (lifted(&chain, h * 1.000001, high).0, lifted(&chain, h * 0.999999, high).0);
            let scale = reach.x_h.abs() + reach.z_v.abs();
            assert!(((plus.x - minus.x) / (2e-6 * h) - reach.x_h).abs() < 1e-5 * scale);
            assert!(((plus.z - minus.z) / (2e-6 * h) - reach.z_h).abs() < 1e-5 * scale);
        }
    }

    #[test]
    fn a_nearly_weightless_segment_is_a_straight_spring() {
        let reach = hanging(&Segment { length: 100.0, weight: 1e-9, ea: 1e6 }, 3e3, 4e3);
        assert!((reach.x - (60.0 + 0.3)).abs() < 1e-9 && (reach.z - (80.0 + 0.4)).abs() < 1e-9, "{reach:?}");
    }

    #[test]
    fn lifted_and_hanging_agree_at_touchdown_of_the_lower_end() {
        let chain = Segment { length: 900.0, weight: 1500.0, ea: 8e8 };
        let (a, ground) = lifted(&chain, 2e5, 900.0 * 1500.0);
        let b = hanging(&chain, 2e5, 0.0);
        assert!(ground.abs() < 1e-9 && (a.x - b.x).abs() < 1e-9 && (a.z - b.z).abs() < 1e-9);
        assert!((a.x_h - b.x_h).abs() < 1e-12 && (a.z_v - (b.z_v)).abs() < 1e-12);
    }
}
