//! One elastic segment under given end forces: how far it reaches, how high it rises, and the derivatives.

use super::line::Segment;

/// Reach and rise of a stretch of line with their derivatives.
///
/// `x`, `z`: horizontal and vertical distance from the lower to the upper end (m). `_h`: derivative with respect to the
/// horizontal force at fixed vertical force (m/N); `_v`: with respect to the vertical force, which shifts by the same
/// amount at both ends (m/N). A leg that ends on the bottom is longer the larger |V| is: its `_v` includes that.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpanReach {
    pub x: f64,
    pub z: f64,
    pub x_h: f64,
    pub x_v: f64,
    pub z_h: f64,
    pub z_v: f64,
}

impl std::ops::AddAssign for SpanReach {
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
/// ([IRVINE-1981 eqs 1.36 and 1.37], in forces). With tan phi = V/H = sinh theta, half the change of theta has the
/// hyperbolic tangent u = |V1 - V0|/(T0 + T1); what follows is in forces divided by T0 + T1, and forms no difference of
/// nearly equal numbers for a weightless, a very taut or a vertical segment.
pub fn hanging(segment: &Segment, h: f64, low: f64) -> SpanReach {
    let Segment { length, weight, ea } = *segment;
    let change = weight * length;
    let high = low + change;
    let (t0, t1) = ((h * h + low * low).sqrt(), (h * h + high * high).sqrt());
    let scale = 1.0 / (t0 + t1);
    let (a, p, q) = (h * scale, low * scale, high * scale);
    let (aa, pq, tt) = (a * a, p * q, (t0 * scale) * (t1 * scale));
    let vertical = p * p + q * q;
    // (1 - u2)/2 = a2 + t0 t1 + p q
    let half = if pq < 0.0 { aa + aa * (aa + vertical) / (tt - pq) } else { aa + (tt + pq) };
    let u = change.abs() * scale;
    let bend = bend(u, half);
    // t0 t1 - a2
    let over = (aa * vertical + pq * pq) / (tt + aa);
    let share = 1.0 / (half * tt);
    let (flexibility, compliance) = (length / ea, length * scale);
    let x_v = -compliance * a * (p + q) * (half * share);
    SpanReach {
        x: 2.0 * length * a * (1.0 + bend) + h * flexibility,
        z: length * (p + q) + 0.5 * (low + high) * flexibility,
        x_h: compliance * (2.0 * bend + (2.0 * half * over - aa * u * u) * share) + flexibility,
        x_v,
        z_h: x_v,
        z_v: compliance * aa * share + flexibility,
    }
}

/// atanh(u)/u - 1, with `half` = (1 - u2)/2 free of cancellation.
fn bend(u: f64, half: f64) -> f64 {
    let q = u * u;
    if q < 1.0 / 64.0 {
        // u2/3 + u4/5 + ...: the tenth term is below 1e-16 of the first
        let square = q * q;
        let low = (1.0 / 3.0 + q / 5.0) + square * (1.0 / 7.0 + q / 9.0);
        let high = (1.0 / 11.0 + q / 13.0) + square * (1.0 / 15.0 + q / 17.0 + square / 19.0);
        q * (low + square * square * high)
    } else {
        let y = u * (1.0 + u) / half;
        let sum = 1.0 + y;
        // ln(1 + y), with what the sum rounds away
        0.5 * (sum.ln() + (y - (sum - 1.0)) / sum) / u - 1.0
    }
}

/// The stretch of a grounded segment that is lifted: from the touchdown, where V = 0, up to a section with vertical
/// force `high` >= 0; with the rest of the segment lying on the bottom under the tension H.
///
/// Returns the reach of the whole segment and the unstretched length on the bottom. `weight` must be positive.
pub fn lifted_reach(segment: &Segment, h: f64, high: f64) -> (SpanReach, f64) {
    let Segment { length, weight, ea } = *segment;
    let t = (h * h + high * high).sqrt();
    let hanging = high / weight;
    let ground = (length - hanging).max(0.0);
    // asinh(V/H) = 2 atanh(u), T - H = u V
    let (scale, per_t, per_weight, per_ea) = (1.0 / (t + h), 1.0 / t, 1.0 / weight, 1.0 / ea);
    let u = high * scale;
    let bend = bend(u, h * scale);
    let lift = high * u;
    let ratio = lift * per_t;
    let x_v = -ratio * per_weight;
    let reach = SpanReach {
        x: 2.0 * h * u / weight * (1.0 + bend) + h * per_ea * hanging + ground * (1.0 + h * per_ea),
        z: (lift + 0.5 * high * high * per_ea) / weight,
        // asinh(V/H) - V/T
        x_h: 2.0 * u * (bend + 0.5 * ratio) * per_weight + (hanging + ground) * per_ea,
        x_v,
        z_h: x_v,
        z_v: high * (per_t + per_ea) * per_weight,
    };
    (reach, ground)
}

/// Places and weights of Gauss's rule with eight points, for the half interval.
pub const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
];

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
    fn derivatives_match_reach_and_rise_finite_differences() {
        for weight in [500.0, -300.0, 0.01] {
            for (h, low) in [(1e5, 2e4), (1e5, -4e4), (3e3, 0.0), (2e6, -1e5), (50.0, 9e4)] {
                check_derivatives(h, low, &Segment { length: 700.0, weight, ea: 5e8 });
            }
        }
        let chain = Segment { length: 900.0, weight: 1500.0, ea: 8e8 };
        for (h, high) in [(1e5, 4e5), (1e6, 2e4), (2e3, 9e5)] {
            let (reach, _) = lifted_reach(&chain, h, high);
            let (plus, minus) =
                (lifted_reach(&chain, h * 1.000001, high).0, lifted_reach(&chain, h * 0.999999, high).0);
            let scale = reach.x_h.abs() + reach.z_v.abs();
            assert!(((plus.x - minus.x) / (2e-6 * h) - reach.x_h).abs() < 1e-5 * scale);
            assert!(((plus.z - minus.z) / (2e-6 * h) - reach.z_h).abs() < 1e-5 * scale);
        }
    }

    #[test]
    fn bend_matches_library_on_both_sides_of_series_limit() {
        for u in [1e-3, 0.05, 0.12, 0.124_999, 0.125_001, 0.3, 0.9, 0.999_9] {
            let (got, want) = (bend(u, 0.5 * (1.0 - u) * (1.0 + u)), u.atanh() / u - 1.0);
            assert!((got - want).abs() < 4e-16 * (1.0 + want), "{u}: {got} {want}");
        }
        assert_eq!(bend(0.0, 0.5), 0.0);
    }

    #[test]
    fn nearly_weightless_segment_matches_straight_spring() {
        let reach = hanging(&Segment { length: 100.0, weight: 1e-9, ea: 1e6 }, 3e3, 4e3);
        assert!((reach.x - (60.0 + 0.3)).abs() < 1e-9 && (reach.z - (80.0 + 0.4)).abs() < 1e-9, "{reach:?}");
    }

    #[test]
    fn lifted_and_hanging_solutions_agree_at_lower_end_touchdown() {
        let chain = Segment { length: 900.0, weight: 1500.0, ea: 8e8 };
        let (a, ground) = lifted_reach(&chain, 2e5, 900.0 * 1500.0);
        let b = hanging(&chain, 2e5, 0.0);
        assert!(ground.abs() < 1e-9 && (a.x - b.x).abs() < 1e-9 && (a.z - b.z).abs() < 1e-9);
        assert!((a.x_h - b.x_h).abs() < 1e-12 && (a.z_v - (b.z_v)).abs() < 1e-12);
    }
}
