//! Numbers as listings of Fortran programs write them.

/// A number in E format with a sign and two digits of exponent: `1.070E+12`.
pub fn exponent(value: f64, decimals: usize) -> String {
    // no minus before a zero
    let value = if value == 0.0 { 0.0 } else { value };
    let text = format!("{value:.decimals$E}");
    let (mantissa, power) = text.split_once('E').unwrap_or((&text, "0"));
    let (sign, digits) = power.strip_prefix('-').map_or(('+', power), |digits| ('-', digits));
    format!("{mantissa}E{sign}{digits:0>2}")
}

/// A number with decimals; no minus before what is printed as zero.
pub fn format_fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    if text.trim_start_matches('-').bytes().all(|b| b == b'0' || b == b'.') { text.replace('-', "") } else { text }
}

/// A value as zero when it is rounding beside the largest of its kind, both in one unit.
pub fn without_noise(value: f64, largest: f64) -> f64 {
    if value.abs() < 1e-12 * largest.abs() { 0.0 } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_written_with_sign_and_two_digits() {
        assert_eq!(exponent(1.0698e12, 3), "1.070E+12");
        assert_eq!(exponent(-0.0, 3), "0.000E+00");
        assert_eq!(exponent(-2.5e-3, 2), "-2.50E-03");
        assert_eq!(exponent(1.0e-120, 3), "1.000E-120");
    }

    #[test]
    fn fixed_zero_has_no_minus() {
        assert_eq!(
            [format_fixed(-0.0004, 3), format_fixed(-0.0006, 3), format_fixed(12.85, 3)],
            ["0.000", "-0.001", "12.850"]
        );
    }
}
