//! A number as its source prints it.

/// A printed number: its text, its value, and one unit of its last digit.
#[derive(Clone, Debug, PartialEq)]
pub struct Printed {
    /// As the source prints it.
    pub text: String,
    /// Its value.
    pub value: f64,
    /// One unit of its last digit.
    pub unit: f64,
}

impl Printed {
    /// Reads a printed number: `-0.0136`, `1.19e5`, `217E6`. `None` of any other text.
    pub fn read(text: &str) -> Option<Printed> {
        let (mantissa, exponent) = split(text);
        let plain = mantissa.strip_prefix(['-', '+']).unwrap_or(mantissa);
        let is_number = plain.bytes().any(|b| b.is_ascii_digit())
            && plain.bytes().all(|b| b.is_ascii_digit() || b == b'.')
            && plain.matches('.').count() <= 1;
        let power: i32 = if exponent.is_empty() { 0 } else { exponent.parse().ok()? };
        let value: f64 = text.parse().ok().filter(|v: &f64| is_number && v.is_finite())?;
        let unit = 10f64.powi(power.saturating_sub(decimals(mantissa)));
        Some(Printed { text: text.to_string(), value, unit }).filter(|p| p.unit > 0.0 && p.unit.is_finite())
    }

    /// Another number with as many digits and `more`, in the same form.
    pub fn like(&self, value: f64, more: usize) -> String {
        let (mantissa, exponent) = split(&self.text);
        let decimals = usize::try_from(decimals(mantissa)).unwrap_or(0) + more;
        if exponent.is_empty() {
            return format!("{value:.decimals$}");
        }
        let power: i32 = exponent.parse().unwrap_or(0);
        format!("{:.decimals$}e{power}", value / 10f64.powi(power))
    }
}

/// Mantissa and exponent of a number's text.
fn split(text: &str) -> (&str, &str) {
    text.split_once(['e', 'E']).unwrap_or((text, ""))
}

/// Digits behind the point.
fn decimals(mantissa: &str) -> i32 {
    mantissa.split_once('.').map_or(0, |(_, digits)| i32::try_from(digits.len()).unwrap_or(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_number_has_unit_of_its_last_digit() {
        let read = |text: &str| Printed::read(text).map(|p| (p.value, p.unit));
        assert_eq!(read("474.8"), Some((474.8, 0.1)));
        assert_eq!(read("-2816"), Some((-2816.0, 1.0)));
        assert_eq!(read("1.19e5"), Some((1.19e5, 1e3)));
        assert_eq!(read("217E6"), Some((2.17e8, 1e6)));
        assert!(["", "-", "1.2.3", "nan", "inf", "1e", "1e999", "12 kN"].iter().all(|text| read(text).is_none()));
    }

    #[test]
    fn number_like_a_printed_one_has_its_form() {
        let like = |text: &str, value: f64| Printed::read(text).map(|p| p.like(value, 1));
        assert_eq!(like("474.8", 474.812), Some("474.81".into()));
        assert_eq!(like("1.19e5", 118_953.0), Some("1.190e5".into()));
    }
}
