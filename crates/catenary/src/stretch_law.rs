//! How a line or a spring stretches under tension, where that is not one number.

use super::line::Segment;
use super::segment::SpanReach;
use windlass_nonlinear::NewtonBracket;

/// Elongation against tension: strain for a length of line, metres for a spring. It grows with the tension and is odd.
#[derive(Clone, Debug, PartialEq)]
pub enum StretchLaw {
    /// Tension over stiffness (N, or N/m for a spring).
    Linear(f64),
    /// Straight lines between points (tension N, elongation), after (0, 0); the last slope goes on [MOSES-FLEX -X_PY].
    Curve(Vec<(f64, f64)>),
    /// T = EA(e) e with EA(e) = EA + k1 e + k2 e2 + k3 e3 up to the largest strain, beyond it EA grows with its slope
    /// there ([AQWA-CONN 5.8.3.1]; the secant reading is [W-SECANT]).
    Polynomial {
        /// Stiffness without strain (N).
        ea: f64,
        /// Its coefficients (N).
        k: [f64; 3],
        /// Largest strain of the polynomial.
        most: f64,
    },
    /// One after the other: their elongations add.
    Series(Vec<StretchLaw>),
    /// Linear up to a tension that cannot be passed: beyond it the line yields ([AQWA-CONN 5.8.3.1]: no extrapolation beyond the
    /// maximum tension). For definite answers it keeps a millionth of its stiffness.
    Capped {
        /// Stiffness (N).
        ea: f64,
        /// Largest tension (N).
        most: f64,
    },
}

/// Share of the stiffness that is left beyond the largest tension of [`StretchLaw::Capped`].
const RESIDUAL_STIFFNESS_SHARE: f64 = 1e-6;
/// Newton steps of the inverse polynomial.
const MAX_NEWTON_ITERATIONS: usize = 100;

impl StretchLaw {
    /// Elongation (m) at a tension >= 0 (N), and its derivative (m/N).
    pub fn stretch(&self, tension: f64) -> (f64, f64) {
        match self {
            StretchLaw::Linear(k) => (tension / k, 1.0 / k),
            StretchLaw::Series(laws) => {
                laws.iter().map(|l| l.stretch(tension)).fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1))
            }
            StretchLaw::Capped { ea, most } if tension <= *most => (tension / ea, 1.0 / ea),
            StretchLaw::Capped { ea, most } => {
                (most / ea + (tension - most) / (RESIDUAL_STIFFNESS_SHARE * ea), 1.0 / (RESIDUAL_STIFFNESS_SHARE * ea))
            }
            StretchLaw::Curve(points) => {
                let mut from = (0.0, 0.0);
                let mut last = (0.0, 0.0);
                for to in points {
                    let slope = (to.1 - from.1) / (to.0 - from.0);
                    last = (from.1 + slope * (tension - from.0), slope);
                    if tension <= to.0 {
                        break;
                    }
                    from = *to;
                }
                last
            }
            StretchLaw::Polynomial { ea, .. } => {
                // T(e) grows: Newton within a bracket
                let mut bracket = NewtonBracket::new(0.0, f64::INFINITY);
                let mut e = tension / ea;
                for _ in 0..MAX_NEWTON_ITERATIONS {
                    let (t, slope) = self.tension(e);
                    let off = t - tension;
                    if off == 0.0 {
                        break;
                    }
                    bracket.record(e, off);
                    let next = bracket.step(e - off / slope, || 2.0 * e);
                    if (next - e).abs() <= 2.0 * f64::EPSILON * next.abs() {
                        e = next;
                        break;
                    }
                    e = next;
                }
                (e, 1.0 / self.tension(e).1)
            }
        }
    }

    /// Tension at a strain, and its derivative; for the polynomial, zero for the others.
    fn tension(&self, e: f64) -> (f64, f64) {
        let StretchLaw::Polynomial { ea, k: [k1, k2, k3], most } = self else { return (0.0, 0.0) };
        let at = e.min(*most);
        let slope = k1 + at * (2.0 * k2 + at * 3.0 * k3);
        let stiffness = ea + at * (k1 + at * (k2 + at * k3)) + slope * (e - at);
        (stiffness * e, stiffness + slope * e)
    }

    /// Whether the tension grows with the strain up to the largest one.
    pub fn grows(&self) -> bool {
        match self {
            StretchLaw::Polynomial { most, .. } => (0..=200).all(|i| self.tension(most * f64::from(i) / 200.0).1 > 0.0),
            StretchLaw::Curve(points) => {
                let before = std::iter::once(&(0.0, 0.0)).chain(points);
                before.zip(points).all(|(a, b)| b.0 > a.0 && b.1 > a.1)
            }
            StretchLaw::Linear(k) => *k > 0.0,
            StretchLaw::Series(laws) => laws.iter().all(StretchLaw::grows),
            StretchLaw::Capped { ea, most } => *ea > 0.0 && *most > 0.0,
        }
    }

    /// Where the law changes its form (N).
    fn kink(&self) -> Option<f64> {
        match self {
            StretchLaw::Polynomial { most, .. } => Some(self.tension(*most).0),
            StretchLaw::Capped { most, .. } => Some(*most),
            _ => None,
        }
    }

    /// Mean strain where the tension runs evenly from `a` to `b` (N), and its derivative when both change alike.
    pub fn mean(&self, a: f64, b: f64) -> (f64, f64) {
        if a == b {
            return self.stretch(a);
        }
        let mut sum = (0.0, 0.0);
        gauss(a, b, &[self.kink()], |t, w| {
            let (e, slope) = self.stretch(t);
            sum = (sum.0 + w * e, sum.1 + w * slope);
        });
        sum
    }

    /// What a stretch of line reaches beyond the linear law of its `ea`, H and V at its lower end.
    pub fn beyond_linear(&self, part: &Segment, h: f64, low: f64) -> SpanReach {
        let high = low + part.weight * part.length;
        let turn = self.kink().filter(|k| *k > h.abs()).map(|k| ((k - h) * (k + h)).sqrt());
        let mut r = SpanReach::default();
        let mut add = |v: f64, weight: f64| {
            let t = h.hypot(v);
            if t == 0.0 {
                return;
            }
            let (e, slope) = self.stretch(t);
            let share = e / t - 1.0 / part.ea;
            let by_t = (slope - e / t) / t;
            let ds = weight * part.length;
            r.x += ds * share * h;
            r.z += ds * share * v;
            r.x_h += ds * (share + by_t * h * h / t);
            r.x_v += ds * by_t * h * v / t;
            r.z_h += ds * by_t * h * v / t;
            r.z_v += ds * (share + by_t * v * v / t);
        };
        if low == high {
            add(low, 1.0);
        } else {
            gauss(low, high, &[Some(0.0), turn, turn.map(|t| -t)], &mut add);
        }
        r
    }
}

/// Mean over an interval, cut at `cuts`, each part by eight points; `each` gets the place and its weight.
fn gauss(a: f64, b: f64, cuts: &[Option<f64>], mut each: impl FnMut(f64, f64)) {
    let mut ends: Vec<f64> =
        cuts.iter().flatten().copied().filter(|c| *c > a.min(b) && *c < a.max(b)).chain([a, b]).collect();
    ends.sort_by(f64::total_cmp);
    for (from, to) in ends.iter().zip(ends.iter().skip(1)) {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let share = half / (b - a).abs();
        for (x, w) in super::segment::GAUSS {
            each(middle - half * x, w * share);
            each(middle + half * x, w * share);
        }
    }
}
