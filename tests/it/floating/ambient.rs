//! What lines feel all along themselves, from the records that say so.

use std::sync::Arc;
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::Session;
use windlass_hydro::ambient;
use windlass_model::Ambient;

/// What surrounds lines after a script; `errors` of its records are refused.
fn after(script: &str, errors: i64) -> Arc<dyn Ambient> {
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
fn what_a_pipe_holds_reaches_lines_in_si() {
    let hot = "T_PRESSURE HOT 180 2.2 -LAID 60 -SPGRAVITY 0.8 -AT 50";
    let found = after(&format!("MEDIT\n{hot}\nEND\n&ENV -T_PRESSURE HOT"), 0).contents().unwrap();
    // 120 F, 2.2 ksi of 6.894757 MPa (NIST SP 811), 50 ft
    assert!((found.warmer - 120.0 / 1.8).abs() < 1e-12);
    assert!((found.pressure / 2.2 / 6.894_757e6 - 1.0).abs() < 1e-7);
    assert!((found.at - 15.24).abs() < 1e-12 && (found.density - 800.0).abs() < 1e-10);
    let metres = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\nT_PRESSURE HOT 60 15 -DENSITY 850\nEND\n&ENV -T_PRESSURE HOT";
    let found = after(metres, 0).contents().unwrap();
    assert_eq!((found.warmer, found.pressure, found.at, found.density), (60.0, 15e6, 0.0, 850.0));
    assert_eq!(after(&format!("{metres}\n&ENV"), 0).contents(), None);
}

#[test]
fn a_bottom_of_records_reaches_lines_and_one_with_a_refused_row_does_not() {
    let records =
        "&DIMEN -DIMEN METERS K-NTS\n&BATHYMETRY B -DEPTHS\nX 0 100\nY 0 30 40\nY 50 32 42\nEND\n&ENV -DEPTH 35 ";
    let (z, [by_x, by_y]) = after(&format!("{records}-BATHYMETRY B"), 0).bottom(50.0, 25.0).unwrap();
    // a plane of 0.1 along x and 0.04 along y
    assert!((z + 36.0).abs() < 1e-12 && (by_x + 0.1).abs() < 1e-14 && (by_y + 0.04).abs() < 1e-14);
    assert_eq!(after(records, 0).bottom(50.0, 25.0), Some((-35.0, [0.0, 0.0])));
    // the row, the grid, and the name
    let wrong = records.replace("50 32 42", "50 32 deep");
    assert_eq!(after(&format!("{wrong}-BATHYMETRY B"), 3).bottom(50.0, 25.0), None);
}
