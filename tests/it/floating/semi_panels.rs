//! A semi-submersible of pontoons and columns by the panels of a mesh file, against Capytaine on the same panels.

use crate::common;

#[test]
fn semi_has_added_mass_of_capytaine_on_same_panels() {
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/semi_panels/semi.obj");
    let (mut session, _screen, folder) = common::session();
    std::fs::copy(mesh, folder.path().join("semi.obj")).unwrap();
    session.open(
        folder.path().join("records.cif").to_str().unwrap(),
        "&DIMEN -DIMEN METERS KN\n&DEFAULT -WATER 1025\n&ENV CALM\nMEDIT\n&DESCRIBE BODY SEMI\n&SURFACE\nMESH HULL semi.obj -OWN_PANELS\nEND_&SURFACE\n\
         END\n&WEIGHT -COMPUTE SEMI 2 28 30 34\nHYDRODYNAMICS\nG_PRESSURE SEMI -PERIOD 8 10 12 15 20 -HEADING 0 45 -PANEL 4\nEND\n"
            .to_owned(),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let data = session.job.model.bodies["SEMI"].database.as_ref().unwrap().data.clone();
    let rows = include_str!("../../data/semi_panels/semi.csv").lines().skip(1).map(|line| {
        let mut cells = line.split(',').map(|cell| cell.parse::<f64>().unwrap());
        [0; 5].map(|_| cells.next().unwrap())
    });
    let mut count = 0;
    for [period, direction, tonnes, ..] in rows {
        let at = data.frequencies.iter().position(|w| (w * period / std::f64::consts::TAU - 1.0).abs() < 1e-9).unwrap();
        let mode = direction as usize - 1;
        // 1 % on the same mesh; windlass has a lid besides, which costs up to 0.95 % with panels as large as these
        let made = data.added_mass[at][(mode, mode)];
        assert!((made / (1000.0 * tonnes) - 1.0).abs() < 0.01, "{period} {direction}: {made} for {tonnes}");
        count += 1;
    }
    assert_eq!(count, 15);
}
