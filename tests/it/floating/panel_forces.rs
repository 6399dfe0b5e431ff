//! G_PRESSURE: the database of a barge by panels beside Capytaine 3.0.0 over a mesh of its own (tests/data/barge/make.py), where it stands,
//! turned and trimmed, and what cannot be meshed.

use crate::common;

use std::sync::Arc;
use windlass_model::Database;

/// A barge of 90 x 30 m whose keel is 3.7 m below its origin, and G_PRESSURE of it behind records.
fn database(place: &str, pieces: &str, pressure: &str) -> (Option<Arc<Database>>, String) {
    let (mut session, screen, _folder) = common::session();
    let records = format!(
        "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025 -G 9.80665\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY BARGE\n*CG 0 0 0\n\
         #WEIGHT *CG 100000 12 26 26\n&SURFACE\n{pieces}\nEND_&SURFACE\nEND\n&INSTATE -LOCATE BARGE {place}\n\
         HYDRODYNAMICS\nG_PRESSURE BARGE {pressure}\nEND\n"
    );
    session.open("records", records);
    session.run();
    let said: Vec<String> = session.reports.iter().map(|r| format!("{} {}", r.message, r.help.join(" "))).collect();
    let data = session.job.model.bodies["BARGE"].database.as_ref().map(|attached| Arc::clone(&attached.data));
    (data, format!("{}\n{}", screen.text(), said.join("\n")))
}

const BARGE: &str = "BLOCK HULL -45 -15 -3.7 45 15 4";
const ASKED: &str = "-PERIOD 6 8 10 14 -HEADING 180 270 315 -PANEL 1.6";

#[test]
fn barge_by_panels_has_the_forces_of_capytaine() {
    let (data, text) = database("0 0 0", BARGE, ASKED);
    let data = data.unwrap_or_else(|| panic!("{text}"));
    let mut reader = csv::Reader::from_path("tests/data/barge/capytaine.csv").unwrap();
    let rows: Vec<Vec<String>> = reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect();
    let mut worst = [[0.0_f64; 2]; 3];
    for (kind, name) in ["A", "B", "X"].into_iter().enumerate() {
        for mode in 0..6 {
            let own: Vec<&Vec<String>> =
                rows.iter().filter(|row| row[1] == name && row[2] == (mode + 1).to_string()).collect();
            let number = |row: &Vec<String>, i: usize| row[i].parse::<f64>().unwrap();
            let size = |row: &&&Vec<String>| number(row, 4).hypot(number(row, 5));
            let peak = own.iter().map(|row| size(&row)).fold(0.0, f64::max);
            for row in own {
                let frequency = std::f64::consts::TAU / number(row, 0);
                let at = data.frequencies.iter().position(|w| (w / frequency - 1.0).abs() < 1e-9).unwrap();
                let off = match name {
                    "A" => (data.added_mass[at][(mode, mode)] - number(row, 4)).abs(),
                    "B" => (data.damping[at][(mode, mode)] - number(row, 4)).abs(),
                    _ => {
                        let heading = number(row, 3).to_radians();
                        let h = data.headings.iter().position(|x| (x - heading).abs() < 1e-9).unwrap();
                        let x = data.excitation[h][at][mode];
                        (x.re - number(row, 4)).hypot(x.im - number(row, 5))
                    }
                };
                let group = usize::from(mode >= 3);
                // of a mode that no wave of these headings excites there is nothing to compare
                if peak > 1e-3 * if mode < 3 { 1e7 } else { 1e8 } {
                    worst[kind][group] = worst[kind][group].max(off / peak);
                }
            }
        }
    }
    // of the largest of its mode: the meshes differ, and roll damping of a box converges last
    let bounds = [0.003, 0.006, 0.01];
    assert!(worst.iter().zip(bounds).all(|(own, bound)| own.iter().all(|w| *w < bound)), "{worst:?}");
    assert_eq!(data.depth, Some(100.0));
}

#[test]
fn forces_turn_with_the_body_and_do_not_depend_on_where_it_lies() {
    let asked = "-PERIOD 8 10 -HEADING 180 -PANEL 4";
    let (home, text) = database("0 0 0", BARGE, asked);
    let (away, _) = database("500 -70 0 0 0 40", BARGE, asked);
    let (home, away) = (home.unwrap_or_else(|| panic!("{text}")), away.unwrap());
    let near = |a: f64, b: f64, size: f64| (a - b).abs() <= 1e-6 * size;
    for i in 0..6 {
        assert!(near(home.added_mass[0][(i, i)], away.added_mass[0][(i, i)], home.added_mass[0][(i, i)]));
        let size = home.excitation[0][0].iter().map(|x| x.norm()).fold(0.0, f64::max);
        assert!(near(home.excitation[0][0][i].re, away.excitation[0][0][i].re, size));
    }
}

#[test]
fn two_blocks_that_touch_are_one_hull() {
    let (one, first) = database("0 0 0", BARGE, "-PERIOD 8 10 -HEADING 180 -PANEL 3");
    let halves = "BLOCK AFT -45 -15 -3.7 0 15 4\nBLOCK FORE 0 -15 -3.7 45 15 4";
    let (two, text) = database("0 0 0", halves, "-PERIOD 8 10 -HEADING 180 -PANEL 3");
    let (one, two) = (one.unwrap_or_else(|| panic!("{first}")), two.unwrap_or_else(|| panic!("{text}")));
    assert!(text.contains("AFT FORE"), "{text}");
    // of other panels
    for mode in [0, 2, 4] {
        let [a, b] = [&one, &two].map(|data| data.added_mass[0][(mode, mode)]);
        assert!((a / b - 1.0).abs() < 0.02, "{mode}: {a} {b}");
    }
}

#[test]
fn what_cannot_be_meshed_is_refused_with_what_to_do() {
    let refused = |place: &str, pieces: &str, asked: &str| {
        let (data, text) = database(place, pieces, asked);
        assert!(data.is_none(), "{text}");
        text
    };
    let asked = "-PERIOD 8 -HEADING 180";
    assert!(refused("0 0 20", BARGE, asked).contains("BARGE does not touch the water where it stands"));
    let text = refused("0 0 0", BARGE, "-PERIOD 2 -HEADING 180 -PANEL 5");
    assert!(
        text.contains("the shortest wave, of 6.24 m, has 1.2 panels of 5.00 m")
            && text.contains("-PANEL 0.78 has eight"),
        "{text}"
    );
    let text = refused("0 0 0", BARGE, "-PERIOD 8 -HEADING 180 -PANEL 0.01");
    assert!(text.contains("are the most") && text.contains("-PANEL gives a larger size"), "{text}");
    let text = refused("0 0 0", BARGE, "-PERIOD 8 -HEADING 180 -DEPTH 3");
    assert!(text.contains("BARGE: ") && text.contains("3.7"), "{text}");
    let moonpool = format!("{BARGE}\nBLOCK POOL -5 -5 -3.7 5 5 4 -PERMEABILITY -1");
    assert!(refused("0 0 0", &moonpool, asked).contains("POOL of BARGE has permeability -1"));
    assert!(refused("0 0 0", "", asked).contains("BARGE has no hull for G_PRESSURE"));
}
