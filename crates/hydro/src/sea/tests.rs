//! The sea against closed forms, other programs and its own differences.

#![allow(clippy::unwrap_used)]

use super::components::{bands, bands_about};
use super::density::Spectrum;
use super::spectra::{PeriodType, default_gamma, jonswap, most_probable, ochi_hubble, torsethaugen};
use super::*;
use std::f64::consts::{PI, TAU};
use windlass_model::{Division, Phasing};

const GRAVITY: f64 = 9.80665;

fn issc() -> Spectrum {
    Spectrum::from_peaks(jonswap(4.0, 10.0, PeriodType::Peak, 1.0), None)
}

fn component(frequency: f64, amplitude: f64, toward: [f64; 2], phase: f64, depth: Option<f64>) -> Component {
    let number = dispersion::wave_number(frequency, depth, GRAVITY).unwrap();
    Component { frequency, number, amplitude, toward, phase }
}

/// Three waves that cross.
fn crossing(depth: Option<f64>, stretching: Stretching) -> Sea {
    let components = vec![
        component(0.5, 1.5, [1.0, 0.0], 0.3, depth),
        component(0.8, 1.0, [0.6, 0.8], 2.0, depth),
        component(1.3, 0.3, [0.0, -1.0], 4.0, depth),
    ];
    Sea::airy(components, Water { depth, level: 1.5, gravity: GRAVITY, density: 1025.0 }, 30.0, stretching)
}

#[test]
fn quantiles_and_centroids_of_issc_match_closed_form() {
    // energy below x = w/wp is exp(-1.25 x^-4): the quantile of a share q is (-0.8 ln q)^(-1/4)
    let (spectrum, peak) = (issc(), TAU / 10.0);
    for q in [1e-6, 0.01, 0.3, 0.5, 0.9, 0.999, 1.0 - 1e-9f64] {
        let exact = peak * (-0.8 * q.ln()).powf(-0.25);
        // near 1 the share has 1e-16 / 1e-9 digits
        let tolerance = if q > 0.9999 { 1e-7 } else { 1e-12 };
        assert!((spectrum.quantile(q) / exact - 1.0).abs() < tolerance, "{q}");
    }
    // m1 = wp (5/4)^(1/4) Gamma(3/4) m0
    assert!((spectrum.moment(0) - 1.0).abs() < 1e-13);
    assert!((spectrum.moment(1) - peak * 1.25f64.powf(0.25) * 1.225_416_702_465_177_6).abs() < 1e-12);
    assert!((spectrum.moment(-1) * peak - 1.25f64.powf(-0.25) * 0.906_402_477_055_477).abs() < 1e-12);
}

#[test]
fn equal_energy_sea_has_its_significant_wave_height() {
    for division in [Division::EqualEnergy, Division::EqualFrequency] {
        for number in [1, 7, 200, 1000] {
            let made = bands(&issc(), number, division, false).unwrap();
            let (m0, m1) = made.iter().fold((0.0, 0.0), |s, b| (s.0 + b.energy, s.1 + b.energy * b.frequency));
            assert!((m0 - 1.0).abs() < 1e-12, "{division:?} {number} {m0}");
            // equal energies keep the mean frequency too; bands of equal width give the ends' energy to the end components
            if division == Division::EqualEnergy {
                assert_eq!(made.len(), number);
                assert!((m1 / issc().moment(1) - 1.0).abs() < 1e-12);
                assert!(made.iter().all(|b| (b.energy * number as f64 - 1.0).abs() < 1e-10));
            }
            assert!(made.windows(2).all(|p| p[0].frequency < p[1].frequency));
        }
    }
}

#[test]
fn bands_around_periods_keep_energy_and_those_periods() {
    let made = bands_about(&issc(), &[12.0, 6.0, 8.0, 10.0]).unwrap();
    assert!((made.iter().map(|b| b.energy).sum::<f64>() - 1.0).abs() < 1e-12);
    let periods: Vec<f64> = made.iter().map(|b| TAU / b.frequency).collect();
    for (found, wanted) in periods.iter().zip([12.0, 10.0, 8.0, 6.0]) {
        assert!((found - wanted).abs() < 1e-12);
    }
}

#[test]
fn ochi_and_hubble_matches_wafo() {
    // pywafo, wafo/spectrum/models.py, OchiHubble(par=2), Hm0 = 7 m: printed S(1), S(2), S(3)
    let fall = |a: f64, b: f64| a * (-b * 7.0f64).exp();
    let parts = [[0.84 * 7.0, fall(0.41, 0.016), 2.55], [0.54 * 7.0, fall(0.88, 0.026), fall(1.82, 0.089)]];
    let spectrum = Spectrum::from_peaks(ochi_hubble(parts).unwrap(), None);
    for (w, s) in [(1.0, 0.901_556_36), (2.0, 0.041_854_45), (3.0, 0.005_832_07)] {
        assert!((spectrum.density(w) - s).abs() < 1e-8, "{w}: {}", spectrum.density(w));
    }
    let all = Spectrum::from_peaks(ochi_hubble(most_probable(7.0)).unwrap(), None);
    // 0.84^2 + 0.54^2 = 0.9972
    assert!((all.moment(0) * 16.0 / 49.0 - 0.9972).abs() < 1e-12);
    assert!(ochi_hubble(most_probable(40.0)).is_err());
}

#[test]
fn torsethaugen_keeps_height_and_peak_periods_of_its_model() {
    for (height, period) in [(3.0, 7.0), (3.0, 9.0), (8.0, 14.0), (2.0, 18.0), (12.0, 15.5)] {
        let humps = torsethaugen(height, period).unwrap();
        let spectrum = Spectrum::from_peaks(humps.clone(), None);
        assert!((4.0 * spectrum.moment(0).sqrt() / height - 1.0).abs() < 1e-6, "{height} {period}");
        assert!((humps[0].peak - TAU / period).abs() < 1e-12);
    }
    // at Tp = Tf = 6.6 Hs^(1/3) both branches are one sea of one hump: JONSWAP-like with N = 4
    let fetch = 6.6 * 8.0f64.cbrt();
    assert_eq!(torsethaugen(8.0, fetch).unwrap().len(), 1);
    let gamma = 35.0 * (TAU / 9.81 * 8.0 / (fetch * fetch)).powf(6.0 / 7.0);
    assert!((torsethaugen(8.0, fetch).unwrap()[0].gamma / gamma - 1.0).abs() < 1e-12);
    assert!(torsethaugen(8.0, 26.0).is_err() && torsethaugen(8.0, 3.0).is_err());
}

#[test]
fn default_peakedness_matches_dnv() {
    let gamma = |period| default_gamma(4.0, period, PeriodType::Peak);
    assert_eq!((gamma(7.0), gamma(7.2), gamma(10.0), gamma(12.0)), (5.0, 5.0, 1.0, 1.0));
    assert!((gamma(8.6) - (5.75f64 - 1.15 * 4.3).exp()).abs() < 1e-12);
    // of a mean period: the peak period that comes of it gives the same peakedness back
    let found = default_gamma(4.0, 7.2, PeriodType::Mean);
    let peak = TAU / jonswap(4.0, 7.2, PeriodType::Mean, found)[0].peak;
    assert!((gamma(peak) / found - 1.0).abs() < 1e-9, "{found}");
}

#[test]
fn spreading_matches_cumulative_cosine_squared() {
    // exponent 2: the integral of cos^2 from -pi/2 to t is 1/2 + (t + sin t cos t)/pi
    for angle in [-1.5, -0.7, 0.0, 0.2, 1.1] {
        let exact = 0.5 + (angle + f64::sin(angle) * f64::cos(angle)) / PI;
        assert!((spreading::share(angle, 2.0) - exact).abs() < 1e-12, "{angle}");
        assert!((spreading::angle(exact, 2.0) - angle).abs() < 1e-9);
    }
    // under cos2 the mean of the cosine is 8/(3 pi), of its square 3/4
    let parts = spreading::parts(36, PI, 2.0);
    let mean = |of: fn(f64) -> f64| parts.iter().map(|([x, _], share)| of(*x) * share).sum::<f64>();
    assert!((mean(|x| x) - 8.0 / (3.0 * PI)).abs() < 1e-5 && (mean(|x| x * x) - 0.75).abs() < 1e-12);
    assert_eq!(spreading::parts(36, PI, spreading::LONG_CRESTED), [([1.0, 0.0], 1.0)]);
    let made = spreading::directions(2000, 0.0, 2.0);
    // the mean of cos^2 of the direction under a cos^2 spreading is 3/4; low discrepancy: about 1/N
    let mean = made.iter().map(|d| d[0] * d[0]).sum::<f64>() / 2000.0;
    assert!((mean - 0.75).abs() < 2e-3, "{mean}");
    assert!(made.iter().all(|d| d[0] <= 0.0), "all within a quarter turn of where the sea goes");
    assert!(spreading::directions(3, 0.0, 200.0).iter().all(|d| *d == [-1.0, 0.0]));
}

#[test]
fn phases_of_a_seed_are_reproducible() {
    let frequencies = || [0.5, 0.6, 0.7].into_iter();
    let of = |seed, train| phases::phases(Phasing::Seeded(seed), train, frequencies());
    assert_eq!(of(1, 0), of(1, 0));
    assert!(of(1, 0) != of(2, 0) && of(1, 0) != of(1, 1));
    let many = phases::phases(Phasing::Seeded(3), 0, (0..20_000).map(f64::from));
    // of 20,000 uniform phases the mean cosine is 0.005 give or take
    assert!(many.iter().all(|p| (0.0..TAU).contains(p)));
    assert!((many.iter().map(|p| p.cos()).sum::<f64>() / 20_000.0).abs() < 0.02);
}

#[test]
fn velocity_derivative_matches_acceleration_and_continuity_holds() {
    for depth in [None, Some(8.0), Some(200.0)] {
        for stretching in [Stretching::Linear, Stretching::Exponential] {
            let sea = crossing(depth, stretching);
            for time in [7.0, 80.0] {
                let (at, h) = (Vector3::new(13.0, -7.0, -4.0), 1e-4);
                let v = |at: Vector3<f64>, time: f64| sea.kinematics(at, time).velocity;
                let rate = (v(at, time + h) - v(at, time - h)) / (2.0 * h);
                // differences of second order with a step of 1e-4: some 1e-9
                assert!((rate - sea.kinematics(at, time).acceleration).norm() < 1e-7, "{depth:?} {time}");
                let step = |i: usize| {
                    let mut step = Vector3::zeros();
                    step[i] = h;
                    (v(at + step, time) - v(at - step, time)) / (2.0 * h)
                };
                let (x, y, z) = (step(0), step(1), step(2));
                assert!((x.x + y.y + z.z).abs() < 1e-8, "no water is made");
                assert!((x.z - z.x).abs() + (y.z - z.y).abs() + (x.y - y.x).abs() < 3e-8, "no water turns");
            }
        }
    }
}

#[test]
fn pressure_and_acceleration_satisfy_linear_equation_of_motion() {
    // rho du/dt = -grad p, away from the ramp
    for depth in [None, Some(8.0), Some(200.0)] {
        let sea = crossing(depth, Stretching::Linear);
        let (at, h, time) = (Vector3::new(3.0, 5.0, -2.0), 1e-3, 99.0);
        for i in 0..3 {
            let mut step = Vector3::zeros();
            step[i] = h;
            let p = |at| sea.kinematics(at, time).pressure;
            let slope = (p(at + step) - p(at - step)) / (2.0 * h);
            assert!((slope / 1025.0 + sea.kinematics(at, time).acceleration[i]).abs() < 1e-6, "{depth:?} {i}");
        }
    }
}

#[test]
fn bottom_is_impermeable_and_surface_moves_with_water() {
    let sea = crossing(Some(20.0), Stretching::Linear);
    assert!(sea.kinematics(Vector3::new(4.0, 2.0, 1.5 - 20.0), 50.0).velocity.z.abs() < 1e-15);
    // linear: at the mean level d(zeta)/dt = w
    let level = Vector3::new(4.0, 2.0, 1.5);
    let sea = Sea { ramp: 0.0, ..crossing(Some(20.0), Stretching::Exponential) };
    let rate = (sea.elevation(4.0, 2.0, 50.0 + 1e-4) - sea.elevation(4.0, 2.0, 50.0 - 1e-4)) / 2e-4;
    assert!((sea.kinematics(level, 50.0).velocity.z - rate).abs() < 1e-7);
}

#[test]
fn deep_line_kinematics_keep_their_error_bounds() {
    // Hs 5 m and Tp 11 s in 300 m, written out: a w cosh(k(z+d))/sinh(kd) cos q and its like
    let depth = 300.0;
    for spread in [0.0, 0.4] {
        let components: Vec<Component> = (0..100)
            .map(|n| {
                let n = f64::from(n);
                let frequency = 0.3 + 0.02 * n;
                let angle = spread * (n * 2.3).sin();
                let amplitude = 0.8 * (-((frequency - 0.571) / 0.25).powi(2)).exp() + 0.02;
                component(frequency, amplitude, [angle.cos(), angle.sin()], n * n, Some(depth))
            })
            .collect();
        let water = Water { depth: Some(depth), level: 1.5, gravity: GRAVITY, density: 1025.0 };
        let sea = Sea::airy(components.clone(), water, 0.0, Stretching::Linear);
        let time = 777.3;
        let at = sea.at_time(time);
        let heights: Vec<f64> = (0..66).map(|i| -30.0 - 4.5 * f64::from(i)).collect();
        let positions: Vec<Vector3<f64>> = (0..66)
            .zip(&heights)
            .map(|(i, height)| Vector3::new(30.0 * f64::from(i) - 700.0, 13.0 * f64::from(i), height + 1.5))
            .collect();
        let mut all = vec![Kinematics::still_water(1.0); positions.len()];
        at.wetted_lines(&positions, |i, found| all[i] = found);
        for ((position, height), found) in positions.iter().zip(&heights).zip(&all) {
            // whatever places are asked together, down to the bottom and below it
            at.wetted_lines(std::slice::from_ref(position), |_, alone| assert_eq!(alone, *found));
            let height = height.max(-depth);
            let (mut pressure, mut velocity, mut rate) = (0.0, Vector3::zeros(), Vector3::zeros());
            // twice a millionth of the waves that are left out, and the stated share of the others
            let mut bounds = [0.0; 3];
            for c in &components {
                let (k, w) = (c.number, c.frequency);
                let q = k * (c.toward[0] * position.x + c.toward[1] * position.y) - w * time + c.phase;
                let (cosh, sinh) = ((k * (height + depth)).cosh(), (k * (height + depth)).sinh());
                let along = Vector3::new(c.toward[0], c.toward[1], 0.0) * cosh;
                let up = Vector3::z() * sinh;
                pressure += 1025.0 * GRAVITY * c.amplitude * cosh / (k * depth).cosh() * q.cos();
                velocity += (along * q.cos() + up * q.sin()) * (c.amplitude * w / (k * depth).sinh());
                rate += (along * q.sin() - up * q.cos()) * (c.amplitude * w * w / (k * depth).sinh());
                let share = if (k * height).exp() < 1e-6 { 2e-6 } else { 2e-9 };
                for (power, bound) in (0..).zip(&mut bounds) {
                    *bound += share * c.amplitude * w.powi(power);
                }
            }
            assert!((found.velocity - velocity).norm() < bounds[1], "{height}: {} {velocity}", found.velocity);
            assert!((found.acceleration - rate).norm() < bounds[2], "{height}: {} {rate}", found.acceleration);
            let head = 1025.0 * GRAVITY * bounds[0];
            assert!((found.pressure - pressure).abs() < head, "{height}: {} {pressure}", found.pressure);
            assert_eq!(found.elevation, 0.0);
        }
    }
}

#[test]
fn kinematics_do_not_overflow_at_any_depth() {
    for depth in [Some(1e-3), Some(0.1), Some(1e3), Some(1e5), None] {
        let sea = Sea::airy(
            vec![component(0.05, 1e-4, [1.0, 0.0], 0.0, depth), component(6.0, 1e-4, [1.0, 0.0], 0.0, depth)],
            Water { depth, level: 0.0, gravity: GRAVITY, density: 1025.0 },
            0.0,
            Stretching::Wheeler,
        );
        for z in [1e-5, -1e-4, -0.05, -50.0, -9e4] {
            let found = sea.kinematics(Vector3::new(1.0, 0.0, z), 3.0);
            let all = found.velocity.iter().chain(found.acceleration.iter()).chain([&found.pressure, &found.elevation]);
            assert!(all.clone().all(|v| v.is_finite()), "{depth:?} {z} {found:?}");
        }
    }
}

#[test]
fn stretching_methods_differ_at_crest() {
    let depth = Some(50.0);
    let (w, a) = (0.6, 3.0);
    let wave = component(w, a, [1.0, 0.0], 0.0, depth);
    let (k, kd) = (wave.number, wave.number * 50.0);
    let water = Water { depth, level: 0.0, gravity: GRAVITY, density: 1025.0 };
    let at =
        |stretching, z: f64| Sea::airy(vec![wave], water, 0.0, stretching).kinematics(Vector3::new(0.0, 0.0, z), 0.0);
    let level = a * w / kd.tanh();
    let close = |found: f64, wanted: f64| assert!((found / wanted - 1.0).abs() < 1e-12, "{found} {wanted}");
    // closed forms of each method at the crest, z = a
    close(at(Stretching::Wheeler, a).velocity.x, level);
    close(at(Stretching::Linear, a).velocity.x, level + a * w * k * a);
    close(at(Stretching::Exponential, a).velocity.x, a * w * (k * (50.0 + a)).cosh() / kd.sinh());
    close(at(Stretching::Delta, a).velocity.x, level + a * w * k * 0.3 * a);
    // with the water at rest the pressure at the surface is none
    for stretching in [Stretching::Wheeler, Stretching::Linear, Stretching::Delta] {
        close(at(stretching, a).pressure, 1025.0 * GRAVITY * a);
        assert_eq!(at(stretching, a + 1e-9).velocity.norm(), 0.0, "nothing above the surface");
    }
    assert!(at(Stretching::Exponential, a + 1.0).velocity.x > level, "no cut");
    // below the stretching depth, two standard deviations, delta stretching is linear theory
    assert_eq!(at(Stretching::Delta, -5.0), at(Stretching::Linear, -5.0));
}

#[test]
fn ramp_begins_and_ends_smoothly() {
    let sea = crossing(None, Stretching::Linear);
    assert_eq!((sea.factor(-1.0), sea.factor(0.0), sea.factor(30.0)), (0.0, 0.0, 1.0));
    assert!((sea.factor(15.0) - 0.5).abs() < 1e-15);
    assert_eq!(sea.elevation(1.0, 2.0, 0.0), 0.0);
    assert_eq!(Sea { ramp: 0.0, ..sea }.factor(0.0), 1.0);
}
