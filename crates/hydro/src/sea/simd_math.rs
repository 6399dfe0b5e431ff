//! Sines, cosines and exponentials of eight numbers at once, in loops the compiler turns into vector instructions: a sea of
//! hundreds of components spends its time in them. They are the same on every machine, which those of a C library are not.
//!
//! Sources: the kernels and split constants of fdlibm ([FDLIBM-5], k_sin.c, k_cos.c, e_rem_pio2.c, e_exp.c), without
//! their last half unit: errors are below 3e-16 of one.

/// Lanes8 numbers.
pub type Lanes8 = [f64; 8];

/// Added to a number and subtracted again it rounds to a whole one, which then stands in the lowest bits.
pub(super) const ROUND: f64 = 6_755_399_441_055_744.0;
/// Up to here an angle loses nothing when whole quarter turns are subtracted.
pub(super) const MAX_REDUCIBLE_ANGLE: f64 = 1.0e6;
/// A quarter turn in three parts; 33 bits each, so that their whole multiples are exact.
const QUARTER: [f64; 3] = [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];
const SIN: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
const COS: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];
/// The natural logarithm of 2 in two parts.
const LOG_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];
/// The series of the exponential, highest power first: with |r| < 0.35 the next term is below 4e-18.
const TAYLOR: [f64; 14] = {
    let mut series = [1.0; 14];
    let mut i = 13;
    while i > 0 {
        series[i - 1] = series[i] / (14 - i) as f64;
        i -= 1;
    }
    series
};
/// Exponents beyond this are taken for it: 1e-304 is nothing.
const DEEP: f64 = 700.0;

/// Sines and cosines of angles (rad).
#[inline(always)]
pub fn sin_cos(angles: &Lanes8) -> (Lanes8, Lanes8) {
    let (mut sines, mut cosines) = ([0.0; 8], [0.0; 8]);
    if !angles.iter().all(|a| a.abs() <= MAX_REDUCIBLE_ANGLE) {
        for ((sin, cos), angle) in sines.iter_mut().zip(&mut cosines).zip(angles) {
            (*sin, *cos) = angle.sin_cos();
        }
        return (sines, cosines);
    }
    for ((sin, cos), angle) in sines.iter_mut().zip(&mut cosines).zip(angles) {
        let shifted = angle * std::f64::consts::FRAC_2_PI + ROUND;
        let (whole, turn) = (shifted - ROUND, shifted.to_bits());
        let r = ((angle - whole * QUARTER[0]) - whole * QUARTER[1]) - whole * QUARTER[2];
        let z = r * r;
        let s = r + r * z * (SIN[0] + z * (SIN[1] + z * (SIN[2] + z * (SIN[3] + z * (SIN[4] + z * SIN[5])))));
        let tail = COS[0] + z * (COS[1] + z * (COS[2] + z * (COS[3] + z * (COS[4] + z * COS[5]))));
        let c = 1.0 - (0.5 * z - z * z * tail);
        let odd = turn & 1 == 1;
        let (a, b) = if odd { (c, s) } else { (s, c) };
        *sin = f64::from_bits(a.to_bits() ^ ((turn & 2) << 62));
        *cos = f64::from_bits(b.to_bits() ^ ((turn.wrapping_add(1) & 2) << 62));
    }
    (sines, cosines)
}

/// Exponentials.
#[inline(always)]
pub fn exp(powers: &Lanes8) -> Lanes8 {
    let mut found = [0.0; 8];
    for (found, power) in found.iter_mut().zip(powers) {
        let power = power.clamp(-DEEP, DEEP);
        let shifted = power * std::f64::consts::LOG2_E + ROUND;
        let whole = shifted - ROUND;
        let r = (power - whole * LOG_2[0]) - whole * LOG_2[1];
        let value = TAYLOR.iter().fold(0.0, |sum, c| sum * r + c);
        *found = value * f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batched_functions_match_standard_library() {
        for i in -200_000..200_000i32 {
            let at = f64::from(i) * 0.7 + f64::from(i % 97) * 1e-3;
            let (sin, cos) = sin_cos(&[at; 8]);
            let (s, c) = at.sin_cos();
            assert!((sin[3] - s).abs() < 3e-16 && (cos[5] - c).abs() < 3e-16, "{at}");
            let power = f64::from(i) * 3.4e-3;
            assert!((exp(&[power; 8])[0] / power.exp() - 1.0).abs() < 6e-16, "{power}");
        }
        let far = sin_cos(&[3e7; 8]);
        assert_eq!((far.0[0], far.1[0]), 3e7f64.sin_cos());
        assert_eq!(exp(&[-1e9; 8])[0], (-700f64).exp());
        assert!(sin_cos(&[f64::NAN; 8]).0[0].is_nan() && exp(&[f64::NAN; 8])[0].is_nan());
    }
}
