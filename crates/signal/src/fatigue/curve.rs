//! An S-N or T-N curve: cycles to failure by range, N = a / S^m in branches.

use crate::SeriesError;
use windlass_model::{FatigueCurve, FatigueKind};

/// A branch of a curve: N = 10^log_a / S^slope for ranges from its own lower end up to that of the branch above it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveBranch {
    /// Exponent m.
    pub slope: f64,
    /// log10 of a, for stress ranges in MPa or tension ranges over the breaking tension.
    pub log_a: f64,
    /// Smallest range it holds for; 0 of the last.
    pub from: f64,
}

impl CurveBranch {
    /// Cycles to failure at a range (Pa, or tension over breaking tension), whether the branch holds there or not.
    pub fn cycles(&self, range: f64) -> f64 {
        10f64.powf(self.log_a - self.slope * range.log10())
    }
}

/// A fatigue curve.
#[derive(Clone, Debug, PartialEq)]
pub struct SnCurve {
    /// Its name.
    pub name: String,
    /// What its ranges are: stress in MPa, or tension over the breaking tension.
    pub kind: FatigueKind,
    /// Branches from the largest ranges down.
    pub branches: Vec<CurveBranch>,
    /// Range below which there is no damage; 0 for none.
    pub limit: f64,
    /// What log10 of a gains for each unit of mean tension over breaking tension ([API-RP-2SK], wire rope); negative.
    pub mean_slope: f64,
    /// Cross-sections of the nominal diameter that bear the tension: 2 of the legs of a chain's link [DNV-OS-E301], else 1.
    pub legs: f64,
    /// Whether its numbers are not confirmed by their source or by two who quote it.
    pub unconfirmed: bool,
}

impl SnCurve {
    /// A curve through the points of `&REP_SELECT -SN`: straight in the logarithms of range and cycles, and so beyond its
    /// ends.
    ///
    /// # Errors
    /// Fewer than two points; ranges or cycles that are not greater than zero; ranges that do not fall while cycles grow.
    pub fn from_points(given: &FatigueCurve) -> Result<SnCurve, SeriesError> {
        let points = &given.points;
        if points.len() < 2 {
            let got = points.len();
            return Err(SeriesError::TooFew { what: "a fatigue curve of points", need: 2, got });
        }
        if let Some((_, n)) = points.iter().find(|(s, n)| !(*s > 0.0 && *n > 0.0 && s.is_finite() && n.is_finite())) {
            let expected = "greater than zero, as their ranges";
            return Err(SeriesError::Setting { what: "the cycles of a fatigue curve", expected, value: *n });
        }
        let scale = match given.kind {
            FatigueKind::Stress => 1e-6,
            FatigueKind::Tension => 1.0,
        };
        let mut branches = Vec::new();
        for pair in points.windows(2) {
            let [(s1, n1), (s2, n2)] = pair else { continue };
            let (s1, s2) = (s1 * scale, s2 * scale);
            if s2 >= s1 || n2 <= n1 {
                return Err(SeriesError::Refused("ranges of a fatigue curve fall while its cycles grow".into()));
            }
            let slope = (n2 / n1).log10() / (s1 / s2).log10();
            branches.push(CurveBranch { slope, log_a: n1.log10() + slope * s1.log10(), from: s2 });
        }
        if let Some(last) = branches.last_mut() {
            last.from = 0.0;
        }
        Ok(SnCurve {
            name: given.name.clone(),
            kind: given.kind,
            branches,
            limit: 0.0,
            mean_slope: 0.0,
            legs: 1.0,
            unconfirmed: false,
        })
    }

    /// The branch that holds at a range; `None` at a range of zero or within the limit.
    fn branch(&self, range: f64) -> Option<&CurveBranch> {
        if range <= 0.0 || range < self.limit {
            return None;
        }
        self.branches.iter().find(|b| range >= b.from)
    }

    /// Damage of one cycle of a range (MPa, or a share of the breaking tension), `mean` being the mean tension over the
    /// breaking tension: the inverse of the cycles to failure; 0 below the limit.
    pub fn damage(&self, range: f64, mean: f64) -> f64 {
        self.branch(range).map_or(0.0, |b| 10f64.powf(-self.mean_slope * mean) / b.cycles(range))
    }

    /// Cycles to failure at a range and a mean (Pa, or tension over breaking tension), as [`SnCurve::damage`]; `None` where there is no
    /// damage.
    pub fn cycles(&self, range: f64, mean: f64) -> Option<f64> {
        let damage = self.damage(range, mean);
        (damage > 0.0).then(|| 1.0 / damage)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use windlass_base::span::Span;

    fn user(points: &[(f64, f64)]) -> FatigueCurve {
        FatigueCurve { name: "U".into(), kind: FatigueKind::Tension, points: points.to_vec(), span: Span::default() }
    }

    #[test]
    fn point_curve_passes_its_points_and_is_linear_between_and_beyond() {
        let curve = SnCurve::from_points(&user(&[(0.8, 1e3), (0.2, 1e5), (0.1, 1e7)])).unwrap();
        for (s, n) in [(0.8, 1e3), (0.2, 1e5), (0.1, 1e7)] {
            assert!((curve.cycles(s, 0.0).unwrap() / n - 1.0).abs() < 1e-12, "{s}");
        }
        // the middle of the logarithms: 0.4 lies half way from 0.8 to 0.2, so N is 1e4
        assert!((curve.cycles(0.4, 0.0).unwrap() / 1e4 - 1.0).abs() < 1e-12);
        // beyond the end with the slope 2 / log10(2)
        assert!((curve.cycles(0.05, 0.0).unwrap() / 1e9 - 1.0).abs() < 1e-12);
        assert_eq!(curve.cycles(0.0, 0.0), None);
    }

    #[test]
    fn points_in_wrong_order_are_refused() {
        assert!(SnCurve::from_points(&user(&[(0.5, 1e3)])).is_err());
        assert!(SnCurve::from_points(&user(&[(0.5, 1e3), (0.6, 1e4)])).is_err());
        assert!(SnCurve::from_points(&user(&[(0.5, 1e3), (0.4, 1e2)])).is_err());
        assert!(SnCurve::from_points(&user(&[(0.5, 1e3), (0.0, 1e4)])).is_err());
    }
}
