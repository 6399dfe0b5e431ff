//! A barge at a quay: the quay as a body that is held, beside the barge and its mirror image. A wall that reaches far is a plane of symmetry: the barge at
//! it has the added mass and damping of two barges that mirror each other's motions.

use crate::common;

use std::sync::Arc;
use windlass_model::Database;

const BARGE: &str = "*GB 0 0 0\n#WEIGHT *GB 19293 4 11 11\n&SURFACE\nBLOCK HULL -20 -6 -4 20 6 4\nEND_&SURFACE\n";

/// The database of the barge 10 m from the wall, with another body.
fn beside(other: &str, name: &str, place: &str) -> Arc<Database> {
    let (mut session, _screen, _folder) = common::session();
    session.open(
        "records",
        format!(
            "&DIMEN -DIMEN METERS KN\n&ENV CALM -DEPTH 16\nINMODEL\n&DESCRIBE BODY BARGE\n{BARGE}{other}END\n&INSTATE -LOCATE BARGE 0 10 0\n\
             &INSTATE -LOCATE {name} {place}\nHYDRODYNAMICS\nG_PRESSURE BARGE -WITH {name} -PERIOD 8 10 -HEADING 90 180 270 -PANEL 3\nEND\n"
        ),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    session.job.model.bodies["BARGE"].database.as_ref().unwrap().data.clone()
}

#[test]
fn barge_at_quay_is_one_of_two_that_mirror_each_other() {
    let twin = BARGE.replace("*GB", "*GT").replace("HULL", "HULT");
    let mirrored = beside(&format!("&DESCRIBE BODY TWIN\n{twin}"), "TWIN", "0 -10 0");
    let wall = "&DESCRIBE BODY QUAY -IGNORE X Y Z RX RY RZ\n*GQ 0 0 0\n#WEIGHT *GQ 1E6 10 30 30\n&SURFACE\nBLOCK WALL -40 -4 -15.5 40 4 4\nEND_&SURFACE\n";
    let quay = beside(wall, "QUAY", "0 -4 0");
    let other = &mirrored.interactions[0];
    for at in 0..2 {
        // the image sways the other way and heaves the same way
        for (mode, sign) in [(1, -1.0), (2, 1.0)] {
            let exact = mirrored.added_mass[at][(mode, mode)] + sign * other.added_mass[at][(mode, mode)];
            let made = quay.added_mass[at][(mode, mode)];
            // the quay is 80 m long and leaves half a metre at the bottom: 4 % of the added mass in heave at 8 s, 2 % at 10 s and in sway
            assert!((made / exact - 1.0).abs() < 0.05, "{at} {mode}: {made} for {exact}");
        }
        let exact = mirrored.damping[at][(2, 2)] + other.damping[at][(2, 2)];
        assert!(
            (quay.damping[at][(2, 2)] / exact - 1.0).abs() < 0.06,
            "{at}: {} for {exact}",
            quay.damping[at][(2, 2)]
        );
    }
}
