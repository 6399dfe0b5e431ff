//! The wave spectrum of the towed-tether listing [AQWA-TETHER 8.1]: fifty lines and the significant height.
//!
//! Numbers and formulation: [W-TOWED 3]. `tests/data/aqwa_tether_spectrum.csv` holds the lines as printed.

use windlass_hydro::sea::components::bands;
use windlass_hydro::sea::density::{SpectralPeak, Spectrum};
use windlass_hydro::sea::dispersion::wave_number;
use windlass_model::Division;

/// Gravity of AQWA (m/s2), and the depth: wave numbers printed are those of deep water to their last digit.
const GRAVITY: f64 = 9.81;
/// Lowest and highest frequency (rad/s) of the JONS card.
const LIMITS: [f64; 2] = [0.37, 2.5];

/// JONSWAP by gamma 5.2273, alpha 0.01146, peak 0.6411 rad/s: the JONS card.
fn hump() -> SpectralPeak {
    SpectralPeak::from_alpha(0.01146, 0.6411, 5.2273, GRAVITY)
}

/// Line, wave number, frequency, phase, ordinate.
fn read_printed_spectrum() -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string("../../tests/data/aqwa_tether_spectrum.csv").unwrap();
    let lines = text.lines().filter(|l| l.starts_with(|c: char| c.is_ascii_digit()));
    lines.map(|l| l.split(',').map(|w| w.parse().unwrap()).collect()).collect()
}

#[test]
fn significant_height_matches_listing_over_all_and_within_limits() {
    let height = |limits| 4.0 * Spectrum::from_peaks(vec![hump()], limits).moment(0).sqrt();
    // printed to three decimals; alpha has four digits, so its half unit is 2.2e-4 of the energy, 1.1e-4 of the height
    assert!((height(None) - 6.302).abs() < 1e-3, "{}", height(None));
    assert!((height(Some(LIMITS)) - 6.293).abs() < 1e-3, "{}", height(Some(LIMITS)));
}

#[test]
fn fifty_equal_energy_components_match_listing() {
    let spectrum = Spectrum::from_peaks(vec![hump()], Some(LIMITS));
    let bands = bands(&spectrum, 50, Division::EqualEnergy, true).unwrap();
    let lines = read_printed_spectrum();
    assert_eq!((bands.len(), lines.len()), (50, 50));
    let (mut frequency, mut ordinate, mut last, mut number): (f64, f64, f64, f64) = (0.0, 0.0, 0.0, 0.0);
    for (band, line) in bands.iter().zip(&lines) {
        frequency = frequency.max((band.frequency - line[2]).abs());
        let k = wave_number(band.frequency, None, GRAVITY).unwrap();
        number = number.max((k / line[1] - 1.0).abs());
        let error = (band.mean_density().unwrap() / line[4] - 1.0).abs();
        if line[0] < 50.0 {
            ordinate = ordinate.max(error)
        } else {
            last = error
        }
        assert!(((2.0 * band.energy).sqrt() - 0.3147).abs() < 5e-5);
    }
    // printed to 1e-4; towed-tether.md found the same: one unit in the last digit at most
    assert!(frequency < 6.5e-5, "{frequency}");
    assert!(number < 1.3e-4, "{number}");
    assert!(ordinate < 1.3e-4, "{ordinate}");
    // the last ordinate is printed with three digits, 0.0484: half a unit is 1.0e-3
    assert!(last < 1.0e-3, "{last}");
}
