//! What a comparison comes to.

use super::printed::Printed;

/// How far a number may lie from the printed one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// In the unit of the printed number.
    Absolute(f64),
    /// A fraction of the printed number.
    Relative(f64),
}

impl Tolerance {
    /// Reads `0.5 %` or `0.01`. `None` of any other text, and of what is not above zero.
    pub fn read(text: &str) -> Option<Tolerance> {
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| *v > 0.0 && v.is_finite());
        match text.trim().strip_suffix('%') {
            Some(percent) => number(percent).map(|v| Tolerance::Relative(v / 100.0)),
            None => number(text).map(Tolerance::Absolute),
        }
    }

    /// Whether an error is within it. `size` is what a fraction is taken of.
    fn takes(self, error: f64, size: f64) -> bool {
        match self {
            Tolerance::Absolute(most) => error.abs() <= most,
            Tolerance::Relative(share) => error.abs() <= share * size.abs(),
        }
    }
}

/// What a comparison comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Rounded to the digits that are printed it is the printed number.
    MetToDigits,
    /// Within the tolerance of the case.
    Met,
    /// Beyond the tolerance, within the bound of an explanation.
    Explained,
    /// Beyond both, or there is no result.
    Missed,
}

impl Verdict {
    /// All of them, the best first.
    pub const ALL: [Verdict; 4] = [Verdict::MetToDigits, Verdict::Met, Verdict::Explained, Verdict::Missed];

    /// As pages print it.
    pub fn text(self) -> &'static str {
        match self {
            Verdict::MetToDigits => "met to its digits",
            Verdict::Met => "met",
            Verdict::Explained => "explained",
            Verdict::Missed => "MISSED",
        }
    }
}

/// Rounding of binary numbers beside half a unit of the last digit.
const ROUNDING: f64 = 1e-9;

/// What a number comes to beside a printed one. Fractions are of `size`.
pub fn judge(
    ours: f64,
    printed: &Printed,
    tolerance: Option<Tolerance>,
    explained: Option<Tolerance>,
    size: f64,
) -> Verdict {
    let error = ours - printed.value;
    if !error.is_finite() {
        Verdict::Missed
    } else if error.abs() <= (0.5 + ROUNDING) * printed.unit {
        Verdict::MetToDigits
    } else if tolerance.is_some_and(|t| t.takes(error, size)) {
        Verdict::Met
    } else if explained.is_some_and(|t| t.takes(error, size)) {
        Verdict::Explained
    } else {
        Verdict::Missed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdict_goes_from_digits_to_miss() {
        let (printed, met, explained) = (Printed::read("100.0"), Tolerance::read("1 %"), Tolerance::read("5"));
        let verdict = |ours| printed.as_ref().map(|p| judge(ours, p, met, explained, p.value));
        assert_eq!(verdict(100.05), Some(Verdict::MetToDigits));
        assert_eq!(verdict(99.0), Some(Verdict::Met));
        assert_eq!(verdict(104.9), Some(Verdict::Explained));
        assert_eq!(verdict(94.9), Some(Verdict::Missed));
        assert_eq!(verdict(f64::NAN), Some(Verdict::Missed));
    }

    #[test]
    fn tolerance_is_a_number_above_zero_or_a_percentage() {
        assert_eq!(Tolerance::read("0.5 %"), Some(Tolerance::Relative(0.005)));
        assert_eq!(Tolerance::read("0.01"), Some(Tolerance::Absolute(0.01)));
        assert!(["", "0", "-1", "a %", "1 mm", "inf"].iter().all(|text| Tolerance::read(text).is_none()));
    }
}
