//! What lines feel all along themselves, from the records that say so.

use crate::common;
use std::f64::consts::TAU;
use std::sync::Arc;
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::Session;
use windlass_hydro::ambient;
use windlass_model::Ambient;

/// What surrounds lines after a script; `errors` of its records are refused.
fn ambient_after(script: &str, errors: i64) -> Arc<dyn Ambient> {
    let folder = tempfile::tempdir().unwrap();
    let job = JobFolder::new(folder.path().join("job"), None, false);
    let mut session = Session::new(Output::new(job, Box::new(Vec::new()), Box::new(Vec::new()), false));
    session.keep_reports = true;
    session.open("script", script.to_string());
    session.run();
    assert_eq!(session.errors, errors, "{:?}", session.reports);
    ambient(&session.job.model, None).unwrap()
}

#[test]
fn pipe_contents_reach_lines_in_si() {
    let hot = "T_PRESSURE HOT 180 2.2 -LAID 60 -SPGRAVITY 0.8 -AT 50";
    let found = ambient_after(&format!("MEDIT\n{hot}\nEND\n&ENV -T_PRESSURE HOT"), 0).contents().unwrap();
    // 120 F, 2.2 ksi of 6.894757 MPa (NIST SP 811), 50 ft
    assert!((found.warmer - 120.0 / 1.8).abs() < 1e-12);
    assert!((found.pressure / 2.2 / 6.894_757e6 - 1.0).abs() < 1e-7);
    assert!((found.at - 15.24).abs() < 1e-12 && (found.density - 800.0).abs() < 1e-10);
    let metres = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\nT_PRESSURE HOT 60 15 -DENSITY 850\nEND\n&ENV -T_PRESSURE HOT";
    let found = ambient_after(metres, 0).contents().unwrap();
    assert_eq!((found.warmer, found.pressure, found.at, found.density), (60.0, 15e6, 0.0, 850.0));
    assert_eq!(ambient_after(&format!("{metres}\n&ENV"), 0).contents(), None);
}

#[test]
fn recorded_seabed_reaches_lines_and_one_with_refused_row_does_not() {
    let records =
        "&DIMEN -DIMEN METERS K-NTS\n&BATHYMETRY B -DEPTHS\nX 0 100\nY 0 30 40\nY 50 32 42\nEND\n&ENV -DEPTH 35 ";
    let (z, [by_x, by_y]) = ambient_after(&format!("{records}-BATHYMETRY B"), 0).bottom(50.0, 25.0).unwrap();
    // a plane of 0.1 along x and 0.04 along y
    assert!((z + 36.0).abs() < 1e-12 && (by_x + 0.1).abs() < 1e-14 && (by_y + 0.04).abs() < 1e-14);
    assert_eq!(ambient_after(records, 0).bottom(50.0, 25.0), Some((-35.0, [0.0, 0.0])));
    // the row, the grid, and the name
    let wrong = records.replace("50 32 42", "50 32 deep");
    assert_eq!(ambient_after(&format!("{wrong}-BATHYMETRY B"), 3).bottom(50.0, 25.0), None);
}

#[test]
fn spectrum_tables_print_density_at_their_frequencies() {
    let (mut session, screen, _folder) = common::session();
    let records = "&DIMEN -DIMEN METERS K-NTS\n&ENV -SEA JONSWAP 180 6 10 1 -S_PERIOD 8 9.6 14 -WIND 40 180 -W_SPECTRUM API -W_PERIOD 20 100 300\n\
                   &STATUS SEA_SPECTRUM\n&STATUS WIND_SPECTRUM\n";
    session.open("test", records.to_string());
    session.run();
    let text = screen.text();
    let density = |period: &str, column: usize| -> f64 {
        let row = text.lines().map(|l| l.split_whitespace().collect::<Vec<_>>()).find(|w| w.get(1) == Some(&period));
        row.unwrap()[column].parse().unwrap()
    };
    // Pierson-Moskowitz (gamma 1), Hs 6 m, Tp 10 s: 5/16 Hs^2 wp^4 / w^5 exp(-5/4 (wp/w)^4); printed to four decimals
    for (period, seconds) in [("14.000", 14.0), ("9.600", 9.6), ("8.000", 8.0f64)] {
        let ratio = seconds / 10.0;
        let want = 11.25 * ratio.powi(5) / (TAU / 10.0) * (-1.25 * ratio.powi(4)).exp();
        assert!((density(period, 6) - want).abs() <= 5.1e-5, "{period}: {} {want}", density(period, 6));
    }
    // [API-RP-2A], 20th edition, at 10 m, over rad/s; the formula stands in steps of its logarithm, off by 2e-5; printed to three
    let speed = 40.0 * 1852.0 / 3600.0;
    let (deviation, peak) = (0.15 * 0.5f64.powf(-0.125) * speed, 0.0025 * speed);
    for (period, seconds) in [("300.000", 300.0), ("100.000", 100.0), ("20.000", 20.0)] {
        let want = deviation * deviation / peak * (1.0 + 1.5 / (seconds * peak)).powf(-5.0 / 3.0) / TAU;
        assert!((density(period, 5) - want).abs() <= 5.1e-4 + 2e-5 * want, "{period}: {} {want}", density(period, 5));
    }
}
