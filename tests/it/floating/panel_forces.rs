//! G_PRESSURE: the database of a barge by panels beside Capytaine 3.0.0 over a mesh of its own (tests/data/barge/make.py), where it stands,
//! turned and trimmed, and what cannot be meshed.

use crate::common;

use nalgebra::{Complex, Matrix3, Matrix6, Vector3};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use windlass_model::Database;
use windlass_solve::frequency::{LinearSystem, Operators};

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

/// How far added mass, damping and exciting forces of a database are off those of a table of the barge, over the largest of their motion: the most of
/// all forces, and of all moments.
fn off_capytaine(data: &Database, file: &str) -> [[f64; 2]; 3] {
    let mut reader = csv::Reader::from_path(format!("tests/data/barge/{file}")).unwrap();
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
    worst
}

#[test]
fn barge_by_panels_has_the_forces_of_capytaine() {
    let (data, text) = database("0 0 0", BARGE, &format!("{ASKED} -EDGE_SHARE 1"));
    let data = data.unwrap_or_else(|| panic!("{text}"));
    let worst = off_capytaine(&data, "capytaine.csv");
    // of the largest of its mode: the meshes differ, and roll damping of a box converges last
    let bounds = [0.003, 0.006, 0.01];
    assert!(worst.iter().zip(bounds).all(|(own, bound)| own.iter().all(|w| *w < bound)), "{worst:?}");
    assert_eq!(data.depth, Some(100.0));
}

#[test]
fn panels_refined_toward_edges_near_the_forces_of_fine_panels() {
    let (data, text) = database("0 0 0", BARGE, ASKED);
    let worst = off_capytaine(&data.unwrap_or_else(|| panic!("{text}")), "capytaine_fine.csv");
    // 1,628 panels of one size are 3.4 % off in added mass, 6.1 % in damping (of roll) and 2.5 % in exciting forces; 1,916 with a quarter of the size at the edges
    // half of that, 2,304 with a tenth 1.0, 2.0 and 0.8 %, and 7,400 of half the size with a tenth 0.3, 0.5 and 0.4 %
    let bounds = [0.018, 0.032, 0.013];
    assert!(worst.iter().zip(bounds).all(|(own, bound)| own.iter().all(|w| *w < bound)), "{worst:?}");
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
fn piece_of_diftype_none_is_no_part_of_the_hull() {
    // a skeg of half the draught again; the barge alone without it, to the last digit
    let asked = "-PERIOD 8 10 -HEADING 180 -PANEL 4 -MEAN_DRIFT NO";
    let skeg = format!("{BARGE}\nBLOCK SKEG -45 -1 -5.5 -30 1 -3.7 -DIFTYPE NONE");
    let made = |pieces: &str| {
        let (data, text) = database("0 0 0", pieces, asked);
        (data.unwrap_or_else(|| panic!("{text}")), text)
    };
    let ((alone, _), (beside, text), (with, _)) = (made(BARGE), made(&skeg), made(&skeg.replace(" -DIFTYPE NONE", "")));
    assert_eq!((&alone.added_mass, &alone.excitation), (&beside.added_mass, &beside.excitation));
    assert!(
        text.contains("Pieces                           = HULL\n") && with.added_mass != alone.added_mass,
        "{text}"
    );
    let (none, text) = database("0 0 0", &format!("{BARGE} -DIFTYPE NONE"), asked);
    assert!(none.is_none() && text.contains("BARGE has no hull for G_PRESSURE"), "{text}");
}

#[test]
fn usual_periods_that_panels_do_not_carry_are_named() {
    // 16 panels of 4 m are a wave of 64 m, of w2 = 2 pi g/64, w = 0.981: the last of every 0.05 rad/s is 0.95, 6.61 s. Of 2 rad/s the wave is 15.4 m
    let (data, text) = database("0 0 0", BARGE, "-HEADING 180 -PANEL 4 -MEAN_DRIFT NO");
    let last = data.unwrap_or_else(|| panic!("{text}")).frequencies.last().copied().unwrap();
    assert!((last - 0.95).abs() < 1e-9, "{last}");
    let said = "the usual periods below 6.61 s are left out, as their waves have less than 16 panels; -PANEL 0.96 has all, down to 3.14 s";
    assert!(text.contains(said), "{text}");
    let (_, text) = database("0 0 0", BARGE, "-HEADING 180 -PERIOD 8 10 -PANEL 4 -MEAN_DRIFT NO");
    assert!(!text.contains("usual periods"), "{text}");
}

#[test]
fn gap_narrower_than_half_a_panel_is_warned_of() {
    // sides of 12 m breadth 20 m apart, and 12.8 m apart
    let said = |between: f64, panel: f64| {
        let behind = format!(
            "&INSTATE -LOCATE A 0 0 0 0 0 0 -LOCATE B 0 {between} 0 0 0 0\nHYDRODYNAMICS\nG_PRESSURE A -WITH B -PERIOD 8 -HEADING 180 -PANEL {panel} -MEAN_DRIFT NO\nEND\n"
        );
        two_barges(0.0, "-PERIOD 8 -HEADING 180 -PANEL 3 -MEAN_DRIFT NO", &behind).1
    };
    let text = said(12.8, 4.0);
    assert!(
        text.contains("the gap between A and B is 0.80 m, less than half a panel of 4.00 m")
            && text.contains("-PANEL 1.60"),
        "{text}"
    );
    let text = said(20.0, 4.0);
    assert!(!text.contains("the gap between"), "{text}");
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
    assert!(text.contains("are the most") && text.contains("-PANEL "), "{text}");
    let text = refused("0 0 0", BARGE, "-PERIOD 8 -HEADING 180 -DEPTH 3");
    assert!(text.contains("BARGE: ") && text.contains("3.7"), "{text}");
    let moonpool = format!("{BARGE}\nBLOCK POOL -5 -5 -3.7 5 5 4 -PERMEABILITY -1");
    assert!(refused("0 0 0", &moonpool, asked).contains("POOL of BARGE has permeability -1"));
    assert!(refused("0 0 0", "", asked).contains("BARGE has no hull for G_PRESSURE"));
}

/// A sphere of a radius (m) about the origin as a Wavefront file: 4 m panels round, 2 m from pole to pole.
fn sphere(radius: f64, m: usize) -> String {
    let mut text = String::new();
    for i in 0..=2 * m {
        for j in 0..4 * m {
            let (down, turn) = (PI * i as f64 / (2 * m) as f64, TAU * j as f64 / (4 * m) as f64);
            let (x, y, z) = (down.sin() * turn.cos(), down.sin() * turn.sin(), down.cos());
            text += &format!("v {:.17} {:.17} {:.17}\n", radius * x, radius * y, radius * z);
        }
    }
    let at = |i: usize, j: usize| i * 4 * m + j % (4 * m) + 1;
    for i in 0..2 * m {
        for j in 0..4 * m {
            let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            // a pole is one corner
            let kept: Vec<String> = match i {
                0 => [corners[0], corners[1], corners[2]].map(|n| n.to_string()).to_vec(),
                _ if i + 1 == 2 * m => [corners[0], corners[1], corners[3]].map(|n| n.to_string()).to_vec(),
                _ => corners.map(|n| n.to_string()).to_vec(),
            };
            text += &format!("f {}\n", kept.join(" "));
        }
    }
    text
}

/// A body of the sphere with the mass of what its lower half displaces, and records behind it.
fn ball(radius: f64, m: usize, held: &str, centre: f64, records: &str) -> (windlass::session::Session, String) {
    let (mut session, screen, folder) = common::session();
    let file = folder.path().join("ball.obj");
    std::fs::write(&file, sphere(radius, m)).unwrap();
    let weight = 2.0 / 3.0 * PI * radius.powi(3) * 1.025 * 9.80665;
    session.open(
        "records",
        format!(
            "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025 -G 9.80665\nMEDIT\n*EARTH 0 0 {centre}\n&DESCRIBE BODY BALL {held}\n*CG 0 0 {centre}\n\
             #WEIGHT *CG {weight} {r} {r} {r}\n&SURFACE\nMESH HULL {}\nEND_&SURFACE\nEND\n{records}",
            file.display(),
            r = 0.5 * radius
        ),
    );
    session.run();
    let said: Vec<String> = session.reports.iter().map(|r| format!("{} {}", r.message, r.help.join(" "))).collect();
    let text = format!("{}\n{}", screen.text(), said.join("\n"));
    (session, text)
}

#[test]
fn added_mass_at_zero_frequency_is_in_database_and_its_report() {
    // surge: half the displaced mass, that of a whole sphere in unbounded water; flat panels of 1 m on a radius of 10 m enclose 1 % less
    let records =
        "HYDRODYNAMICS\nG_PRESSURE BALL -PERIOD 8 9 -HEADING 0 -PANEL 1 -MEAN_DRIFT NO\nEND\n&STATUS DATABASE\n";
    let (session, text) = ball(10.0, 16, "", 0.0, records);
    let mass = 2.0 / 3.0 * PI * 1e3 * 1025.0;
    let zero = session.job.model.bodies["BALL"].database.as_ref().unwrap().data.zero.unwrap();
    assert!((zero[(0, 0)] / mass - 0.5).abs() < 0.01, "{}", zero[(0, 0)] / mass);
    let row = text.lines().find(|line| line.trim_start().starts_with("0.0000")).unwrap_or_else(|| panic!("{text}"));
    let surge: f64 = row.split_whitespace().filter_map(|word| word.parse().ok()).nth(1).unwrap();
    // four digits
    assert!((surge / zero[(0, 0)] - 1.0).abs() < 5e-4, "{row}");
}

#[test]
fn drift_of_hemisphere_by_records_meets_exact_series() {
    // K = omega2 a/g, drift of the body held and free over rho g a: exact series, as in crates/diffraction/tests/data/hemisphere.csv;
    // far field 1 %, control surface 1.5 %, near field 3 % of the largest of each, 0.648 and 0.872
    let text = std::fs::read_to_string("crates/diffraction/tests/data/hemisphere.csv").unwrap();
    let rows: Vec<Vec<f64>> =
        text.lines().skip(2).map(|l| l.split(',').map(|w| w.parse().unwrap()).collect()).collect();
    let wanted: Vec<&Vec<f64>> = rows.iter().filter(|n| [0.5, 1.0, 1.4, 2.0].contains(&n[0])).collect();
    assert_eq!(wanted.len(), 4);
    let radius = 10.0;
    let period = |k: f64| TAU / (k * 9.80665 / radius).sqrt();
    let periods: Vec<String> = wanted.iter().map(|n| period(n[0]).to_string()).collect();
    for (held, column, largest) in [("-IGNORE X Y Z RX RY RZ", 9, 0.648), ("", 10, 0.872)] {
        let records = format!(
            "HYDRODYNAMICS\nG_PRESSURE BALL -PERIOD {} -HEADING 180 90 -PANEL 3\nG_MDRIFT BALL\n\
             END\n",
            periods.join(" ")
        );
        let (session, text) = ball(radius, 16, held, 0.0, &records);
        let attached = session.job.model.bodies["BALL"].database.clone().unwrap_or_else(|| panic!("{text}"));
        let drift = attached.data.drift.clone().unwrap_or_else(|| panic!("{text}"));
        let scale = 1025.0 * 9.80665 * radius;
        for n in &wanted {
            let frequency = TAU / period(n[0]);
            let at = drift.frequencies.iter().position(|w| (w / frequency - 1.0).abs() < 1e-6).unwrap();
            // waves toward 0 push along x, toward 270 along -y
            let [ahead, aside] = [0.0, 1.5 * PI].map(|heading: f64| {
                let h = drift.headings.iter().position(|x| (x - heading).abs() < 1e-6).unwrap();
                drift.values[h][at].map(|value| value / scale)
            });
            assert!((ahead[0] - n[column]).abs() < 0.01 * largest, "{held} K {}: {ahead:?} for {}", n[0], n[column]);
            assert!((aside[1] + n[column]).abs() < 0.01 * largest, "{held} K {}: {aside:?} for {}", n[0], n[column]);
            assert!(ahead[1].abs() < 1e-3 && aside[0].abs() < 1e-3, "{ahead:?} {aside:?}");
        }
        // the report of G_MDRIFT: period, heading, X and Y far away, by the control surface and by the pressure on the hull, two differences
        let from = text.find("M E A N   D R I F T").unwrap_or_else(|| panic!("{text}"));
        let lines: Vec<Vec<f64>> = text[from..]
            .lines()
            .map(|line| line.split_whitespace().map_while(|word| word.parse().ok()).collect::<Vec<f64>>())
            .filter(|numbers| numbers.len() == 10)
            .collect();
        assert_eq!(lines.len(), 4, "{text}");
        for (line, n) in lines.iter().rev().zip(wanted.iter()) {
            // the table is in kN/m2
            for (at, share) in [(4, 0.015), (6, 0.03)] {
                let drift = 1e3 * line[at].hypot(line[at + 1]) / scale;
                assert!((drift - n[column]).abs() < share * largest, "{held} K {}: {drift} for {}", n[0], n[column]);
            }
        }
    }
}

#[test]
fn wave_drift_damping_of_hemisphere_by_panels_meets_exact_series() {
    // K = 0.8, held: along the waves w/g (4 D + 2 K dD/dK), across them 2 w D/g, by differences of five rows of the exact series; 1.5 % of the larger
    let text = std::fs::read_to_string("crates/diffraction/tests/data/hemisphere.csv").unwrap();
    let rows: Vec<Vec<f64>> =
        text.lines().skip(2).map(|l| l.split(',').map(|w| w.parse().unwrap()).collect()).collect();
    let at = |k: f64| rows.iter().find(|n| (n[0] - k).abs() < 1e-9).unwrap()[9];
    let (radius, k) = (10.0, 0.8);
    let slope = (at(0.6) - 8.0 * at(0.7) + 8.0 * at(0.9) - at(1.0)) / 1.2;
    let frequency = |k: f64| (k * 9.80665 / radius).sqrt();
    let scale = 1025.0 * radius * frequency(k);
    let (along, across) = (scale * (4.0 * at(k) + 2.0 * k * slope), scale * 2.0 * at(k));
    let periods: Vec<String> = [0.6, 0.7, 0.8, 0.9, 1.0].map(|k| (TAU / frequency(k)).to_string()).to_vec();
    let records = format!(
        "&ENV -SEA REGULAR 180 2 {}\nHYDRODYNAMICS\nG_PRESSURE BALL -PERIOD {} -HEADING 0 45 90 135 180 225 270 315 -PANEL 3\nG_MDRIFT BALL\nEND\n",
        TAU / frequency(k),
        periods.join(" ")
    );
    let (session, text) = ball(radius, 16, "-IGNORE X Y Z RX RY RZ", 0.0, &records);
    let found = windlass_solve::drift_damping::body_drift_dampings(&session.job.model).unwrap();
    let found = found.first().unwrap_or_else(|| panic!("{text}")).damping;
    for (made, exact) in [(found[(0, 0)], along), (found[(1, 1)], across), (found[(0, 1)], 0.0), (found[(1, 0)], 0.0)] {
        assert!((made - exact).abs() < 0.015 * along, "{made} for {exact}");
    }
}

#[test]
fn drift_of_hemisphere_is_checked_by_control_surface() {
    let text = std::fs::read_to_string("crates/diffraction/tests/data/hemisphere.csv").unwrap();
    let rows: Vec<Vec<f64>> =
        text.lines().skip(2).map(|l| l.split(',').map(|w| w.parse().unwrap()).collect()).collect();
    let radius = 10.0;
    let ks = [0.5, 1.0, 1.4];
    // held, over rho g a
    let exact = ks.map(|k: f64| rows.iter().find(|n| n[0] == k).unwrap()[9]);
    let periods = ks.map(|k: f64| (TAU / (k * 9.80665 / radius).sqrt()).to_string()).join(" ");
    // far field and control surface are 4.6 % of the largest drift apart by 60 panels, which is 8.2 % off, and 0.2 % by 1984, which is 0.4 % off
    for (m, [least, most], apart) in [(3, [0.05, 0.09], [3.0, 5.0]), (16, [0.0, 0.01], [0.0, 0.5])] {
        let records = format!("HYDRODYNAMICS\nG_PRESSURE BALL -PERIOD {periods} -HEADING 180 -PANEL 6\nEND\n");
        let (session, text) = ball(radius, m, "-IGNORE X Y Z RX RY RZ", 0.0, &records);
        let data = session.job.model.bodies["BALL"].database.clone().unwrap_or_else(|| panic!("{text}")).data;
        let drift = data.drift.as_ref().unwrap();
        let found = drift.values[0].iter().map(|six| six[0].abs() / (1025.0 * 9.80665 * radius));
        let off = found.zip(exact).map(|(made, exact)| (made - exact).abs()).fold(0.0, f64::max) / exact[2];
        assert!((least..most).contains(&off), "{m}: {off}\n{text}");
        let shown: Vec<f64> = pressure_rows(&text).filter(|row| row.len() == 7).map(|row| row[5]).collect();
        assert!(shown.len() == 1 && (apart[0]..apart[1]).contains(&shown[0]), "{m}: {shown:?}\n{text}");
        assert!(!text.contains("mean drift far away"), "{text}");
    }
}

/// The numbers of the rows of the report of G_PRESSURE, which name the motion where exciting forces differ most.
fn pressure_rows(text: &str) -> impl Iterator<Item = Vec<f64>> + '_ {
    let is_row = |line: &&str| {
        ["surge", "sway", "heave", "roll", "pitch", "yaw"].iter().any(|name| line.contains(&format!(" {name} ")))
    };
    let numbers = |line: &str| line.split_whitespace().filter_map(|word| word.parse().ok()).collect::<Vec<f64>>();
    text.lines().filter(is_row).map(numbers).filter(|row| row.len() >= 5)
}

#[test]
fn worst_motion_of_exciting_forces_is_named_with_its_share() {
    // a barge of 40 x 12 x 4 m beside another in waves from abeam: roll, a small moment by pressures at the bilges, converges last
    let (session, text) = two_barges(0.0, "-PERIOD 8 10 -HEADING 90 -PANEL 3", "");
    let row = pressure_rows(&text).max_by(|a, b| a[3].total_cmp(&b[3])).unwrap_or_else(|| panic!("{text}"));
    let warning = "the exciting forces of ";
    let from = text.find(warning).unwrap_or_else(|| panic!("{text}"));
    let named = &text[from + warning.len()..];
    assert!(named.starts_with("A roll by pressure") || named.starts_with("B roll by pressure"), "{text}");
    assert!(named.contains(&format!("at a period of {:.2} s, more than 5 %", row[0])), "{text}");
    assert!(named.contains(&format!("differ by {:.1} % of the largest", row[3])), "{row:?} {text}");
    assert_eq!(session.errors, 0, "{text}");
}

#[test]
fn kept_results_of_another_job_are_taken_where_they_match() {
    let records = |period: &str, kept: &str| {
        format!(
            "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY BARGE\n*CG 0 0 0\n#WEIGHT *CG 100000 12 26 26\n&SURFACE\n{BARGE}\n\
             END_&SURFACE\nEND\nHYDRODYNAMICS\nG_PRESSURE BARGE -PERIOD {period} -HEADING 180 -PANEL 8 {kept}\nEND\n"
        )
    };
    let run = |records: String| {
        let (mut session, screen, folder) = common::session();
        session.open("records", records);
        session.run();
        let said: Vec<String> = session.reports.iter().map(|r| r.message.clone()).collect();
        let data = session.job.model.bodies["BARGE"].database.as_ref().map(|attached| Arc::clone(&attached.data));
        (data, format!("{}\n{}", screen.text(), said.join("\n")), folder, session)
    };
    let (first, text, _folder, session) = run(records("8 10", ""));
    let file = session.job.output.folder.folder.join("BARGE.nc");
    assert!(file.is_file(), "{text}");
    let kept = format!("-KEPT {}", file.display());
    let (again, text, ..) = run(records("8 10", &kept));
    assert!(text.contains("BARGE.nc: of the same mesh and settings"), "{text}");
    assert_eq!(first, again);
    let (_, text, ..) = run(records("8 11", &kept));
    assert!(text.contains("is of another mesh or other settings"), "{text}");
    // one that was cut off is computed anew
    let whole = std::fs::read(&file).unwrap();
    std::fs::write(&file, &whole[..whole.len() - 100]).unwrap();
    let (again, text, ..) = run(records("8 10", &kept));
    assert!(text.contains("BARGE.nc is damaged: the results are computed"), "{text}");
    assert_eq!(first, again);
}

#[test]
fn motions_in_waves_name_bodies_with_members_that_feel_none_there() {
    let records = |kind: &str| {
        format!(
            "-PERIOD 8 10 -HEADING 180 -PANEL 6 -MEAN_DRIFT NO\nEND\nMEDIT\n&DESCRIBE BODY S\n*T1 0 0 -3\n*T2 0 0 -13\n&SURFACE\n\
             TUBE T *T1 *T2 1000 {kind}\nEND_&SURFACE\nEND\nFREQ_RESPONSE\nRAO -PERIOD 8 -HEADING 180\n"
        )
    };
    let is_named = |kind: &str| {
        let (_, text) = floating_barge(19_300.0, 0.0, &records(kind), "END\n");
        assert!(text.contains("Excursion"), "{text}");
        text.contains("waves act on members, lumps and hulls of -DIFTYPE FK of S in TDOM alone")
    };
    assert!(is_named("") && !is_named("-DIFTYPE 3DDIF"));
}

#[test]
fn drift_of_own_panels_acts_in_equilibrium() {
    // a head sea moves the ball on a linear spring by its mean drift over the stiffness
    let records = "HYDRODYNAMICS\nG_PRESSURE BALL -HEADING 180 -PERIOD 4 5 6 7 8 10 12 -PANEL 3\nEND\n\
                   MEDIT\n~SPRING GSPR BOTH X 50 1E6 -LEN 0\nCONNECTOR HOLD ~SPRING *CG *EARTH\nEND\n\
                   &ENV SEA -SEA REGULAR 180 2 6\n&EQUI\n";
    let (session, text) = ball(10.0, 8, "-IGNORE Y RX RY RZ", -3.0, records);
    let body = &session.job.model.bodies["BALL"];
    let drift = body.database.as_ref().and_then(|a| a.data.drift.clone()).unwrap_or_else(|| panic!("{text}"));
    let at = drift.frequencies.iter().position(|w| (w - TAU / 6.0).abs() < 1e-9).unwrap();
    // amplitude of a wave of 2 m height: 1 m
    let expected = drift.values[0][at][0] / 50e3;
    assert!(expected > 0.05, "{expected} {text}");
    assert!((body.position.shift[0] / expected - 1.0).abs() < 0.02, "{} {expected} {text}", body.position.shift[0]);
}

#[test]
fn hemisphere_with_own_database_moves_as_with_that_of_capytaine() {
    // the body of scripts/frequency.cif on springs in place of chains; amplitudes by period, 1.5 % of the largest
    let moored = "MEDIT\n~SPRING GSPR BOTH X 150 1E6 Y 150 1E6 -LEN 0\nCONNECTOR HOLD ~SPRING *CG *EARTH\n\
                  #DAMP *CG 100 100 0 0 0 0\nEND\n";
    let motions = |database: &str| {
        let records = format!("{moored}{database}");
        let (session, text) = ball(10.0, 14, "-IGNORE RZ", -3.0, &records);
        let linear = LinearSystem::new(&session.job.model).unwrap_or_else(|e| panic!("{e:?} {text}"));
        let operators = Operators::new(&linear, &[6.0, 8.0, 10.0, 12.0].map(|t| TAU / t), &[PI]).unwrap();
        operators.motions[0].iter().map(|m| [0, 2, 4].map(|i| m[i])).collect::<Vec<_>>()
    };
    let own = motions("HYDRODYNAMICS\nG_PRESSURE BALL -HEADING 180 -PERIOD 4 5 6 8 10 12 15 20 -PANEL 3\nEND\n");
    let other = motions("MEDIT\nDATABASE BALL -CAPYTAINE tests/data/hemisphere/hemisphere.nc -SYMMETRIC\nEND\n");
    for (i, what) in ["surge", "heave", "pitch"].into_iter().enumerate() {
        let largest = other.iter().map(|m| m[i].norm()).fold(0.0, f64::max);
        for (a, b) in own.iter().zip(&other) {
            assert!((a[i] - b[i]).norm() < 0.015 * largest, "{what}: {} {}", a[i], b[i]);
        }
    }
}

/// Two barges of 40 x 12 m at a draught of 4 m, the second 5 m ahead, 20 m to the left and turned by 20 degrees; all turned by `turn` (degrees) about a
/// place far from the origin.
fn two_barges(turn: f64, asked: &str, behind: &str) -> (windlass::session::Session, String) {
    let (mut session, screen, _folder) = common::session();
    let (sine, cosine) = turn.to_radians().sin_cos();
    let (x, y) = (300.0 + 5.0 * cosine - 20.0 * sine, -70.0 + 5.0 * sine + 20.0 * cosine);
    let weight = 40.0 * 12.0 * 4.0 * 1.025 * 9.80665;
    let body = |name: &str| {
        format!(
            "&DESCRIBE BODY {name}\n*G{name} 0 0 0\n#WEIGHT *G{name} {weight} 4 11 11\n#DAMP *G{name} 100 100 0 2E4\n&SURFACE\n\
             BLOCK H{name} -20 -6 -4 20 6 4\nEND_&SURFACE\n"
        )
    };
    session.open(
        "records",
        format!(
            "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025 -G 9.80665\nMEDIT\n{}{}END\n\
             &INSTATE -LOCATE A 300 -70 0 0 0 {turn}\n&INSTATE -LOCATE B {x} {y} 0 0 0 {}\n\
             HYDRODYNAMICS\nG_PRESSURE A -WITH B {asked}\nEND\n{behind}",
            body("A"),
            body("B"),
            turn + 20.0
        ),
    );
    session.run();
    let said: Vec<String> = session.reports.iter().map(|r| format!("{} {}", r.message, r.help.join(" "))).collect();
    let text = format!("{}\n{}", screen.text(), said.join("\n"));
    (session, text)
}

#[test]
fn two_barges_by_panels_have_the_forces_of_capytaine_on_same_mesh() {
    let periods = [0.5, 0.65, 0.8].map(|w: f64| (TAU / w).to_string()).join(" ");
    let (session, text) = two_barges(35.0, &format!("-PERIOD {periods} -HEADING 180 240 -PANEL 2 -EDGE_SHARE 1"), "");
    let data = ["A", "B"]
        .map(|name| session.job.model.bodies[name].database.as_ref().unwrap_or_else(|| panic!("{text}")).data.clone());
    let mut reader = csv::Reader::from_path("tests/data/two_barges/capytaine.csv").unwrap();
    let rows: Vec<Vec<String>> = reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect();
    // from the axes of each body to those of the first
    let turns = [0.0, 20f64.to_radians()].map(|angle| {
        let (sine, cosine) = angle.sin_cos();
        let mut turn = Matrix6::identity();
        for at in [0, 3] {
            turn[(at, at)] = cosine;
            turn[(at + 1, at + 1)] = cosine;
            turn[(at, at + 1)] = -sine;
            turn[(at + 1, at)] = sine;
        }
        turn
    });
    let block = |i: usize, j: usize, what: &str, at: usize| -> Matrix6<f64> {
        let own = &data[i];
        let between = own.interactions.first();
        let matrix = match (i == j, what) {
            (true, "A") => own.added_mass[at],
            (true, _) => own.damping[at],
            (false, "A") => between.unwrap().added_mass[at],
            (false, _) => between.unwrap().damping[at],
        };
        turns[i] * matrix * turns[j].transpose()
    };
    let mut values: Vec<(String, usize, Complex<f64>, Complex<f64>)> = Vec::new();
    // at 1.4 rad/s the lid, which the mesh of Capytaine has not, changes the coupling of surge and pitch by 1.1 % of the peak on this mesh:
    // crates/diffraction/tests/it/two_boxes.rs compares them there without a lid
    for row in rows.iter().filter(|row| row[0].parse::<f64>().unwrap() < 0.9) {
        let number = |i: usize| row[i].parse::<f64>().unwrap();
        let at = data[0].frequencies.iter().position(|w| (w / number(0) - 1.0).abs() < 1e-9).unwrap();
        let (i, given) = (number(2) as usize, Complex::new(number(4), number(5)));
        let is_moment = |motion: usize| usize::from(motion % 6 > 2);
        if row[1] == "X" {
            let (body, toward) = (i / 6, number(3).to_radians());
            let own = &data[body];
            // phases of Capytaine are those at the origin of the first body
            let heading = (toward - [0.0, 20f64.to_radians()][body]).rem_euclid(TAU);
            let h = own.headings.iter().position(|x| (x - heading).abs() < 1e-6).unwrap();
            let k = number(0).powi(2) / 9.80665;
            let phase =
                Complex::from_polar(1.0, if body == 1 { k * (5.0 * toward.cos() + 20.0 * toward.sin()) } else { 0.0 });
            let made: Complex<f64> = (0..6).map(|n| own.excitation[h][at][n] * turns[body][(i % 6, n)]).sum();
            values.push((row[1].clone(), is_moment(i), made * phase, given));
        } else {
            let j = number(3) as usize;
            // the moment by a translation is the force by the rotation
            if is_moment(i) > is_moment(j) {
                continue;
            }
            let made = block(i / 6, j / 6, &row[1], at)[(i % 6, j % 6)];
            values.push((row[1].clone(), is_moment(i) + is_moment(j), made.into(), given));
        }
    }
    assert!(values.len() > 700, "{}", values.len());
    for (what, kind, made, given) in &values {
        let alike = values.iter().filter(|other| other.0 == *what && other.1 == *kind);
        let peak = alike.fold(0.0, |most: f64, other| most.max(other.3.norm()));
        assert!((made - given).norm() < 0.01 * peak, "{what} of kind {kind}: {made} for {given}, peak {peak}");
    }
}

/// The amplitude of the harmonic of a frequency in values at times, their mean taken out.
fn harmonic(times: &[f64], values: &[f64], w: f64) -> Complex<f64> {
    let mut normal = Matrix3::zeros();
    let mut right = Vector3::zeros();
    for (t, v) in times.iter().zip(values) {
        let row = Vector3::new((w * t).cos(), (w * t).sin(), 1.0);
        normal += row * row.transpose();
        right += row * *v;
    }
    let solved = normal.lu().solve(&right).unwrap();
    Complex::new(solved[0], solved[1])
}

/// Motions of two barges 20 m beside each other over the wave amplitude: direction by direction of A and B, by the linear equations, the same without what
/// each does to the other, and by a run in waves of 0.8 rad/s and 0.2 m height toward 60 degrees. The databases have frequencies up to a last one by a
/// step (rad/s).
fn motions_of_two_barges(last: f64, step: f64) -> Vec<[Complex<f64>; 3]> {
    let period = TAU / 0.8;
    let count = (last / step).round() as u32;
    let frequencies: Vec<String> = (2..=count).map(|i| (TAU / (step * f64::from(i))).to_string()).collect();
    let asked = format!("-PERIOD {} -PANEL 2.5 -EDGE_SHARE 0.25 -MEAN_DRIFT NO", frequencies.join(" "));
    let behind = format!("&ENV SEA -SEA REGULAR 240 0.2 {period} -TIME 260 0.1 -RAMP 60\nTDOM\n");
    let (session, text) = two_barges(0.0, &asked, &behind);
    let mut model = session.job.model.clone();
    let linear = LinearSystem::new(&model).unwrap_or_else(|e| panic!("{e:?} {text}"));
    let (frequency, toward) = (TAU / period, [PI / 3.0]);
    let together = linear.operators(frequency, &toward).unwrap().remove(0);
    for name in ["A", "B"] {
        let attached = model.bodies.get_mut(name).unwrap().database.as_mut().unwrap();
        let mut data = (*attached.data).clone();
        data.interactions.clear();
        attached.data = Arc::new(data);
    }
    let apart = LinearSystem::new(&model).unwrap().operators(frequency, &toward).unwrap().remove(0);
    let history = &session.job.run.as_ref().unwrap_or_else(|| panic!("{text}")).history;
    let times = history.times();
    let from = times.len() - (8.0 * period / 0.1) as usize;
    let of = |at: usize| {
        let values = history.series(history.layout.body(at / 6) + at % 6);
        [together[at], apart[at], harmonic(&times[from..], &values[from..], frequency) / 0.1]
    };
    (0..12).map(of).collect()
}

#[test]
fn radiation_of_other_barge_acts_in_frequency_and_time_alike() {
    let all = motions_of_two_barges(2.1, 0.1);
    for heave in [2, 8] {
        let [together, apart, made] = all[heave];
        // phases are 0.6 degrees apart, at half the step too: the memory fades
        let (size, lag) = (made.norm() / together.norm(), (made / together).arg().to_degrees());
        assert!((size - 1.0).abs() < 0.005 && lag.abs() < 0.7, "{heave}: {made} for {together} and {apart}");
    }
    let differ = [2, 8].map(|heave| (all[heave][1] - all[heave][0]).norm() / all[2][0].norm());
    assert!(differ[0].max(differ[1]) > 0.35, "{differ:?}");
}

#[test]
fn two_barges_whose_frequencies_end_early_move_in_time_as_in_frequency() {
    // the damping of both and between them is far from its end at 1.3 rad/s; sway and heave of both within 1 %
    let all = motions_of_two_barges(1.3, 0.05);
    for at in [1, 2, 7, 8] {
        let [together, apart, made] = all[at];
        let size = made.norm() / together.norm();
        assert!((size - 1.0).abs() < 0.01, "{at}: {made} for {together} and {apart}");
    }
}

#[test]
fn file_of_panels_is_taken_again_and_reads_back_the_same() {
    let pressure = "HYDRODYNAMICS\nG_PRESSURE A -WITH B -PERIOD 8 10 -HEADING 180 240 -PANEL 4 -EDGE_SHARE 0.5\nEND\n";
    let read = "MEDIT\nDATABASE A -CAPYTAINE A_B.nc -INDEX 1\nDATABASE B -CAPYTAINE A_B.nc -INDEX 2\nEND\n";
    let data = |session: &windlass::session::Session| {
        ["A", "B"].map(|name| (*session.job.model.bodies[name].database.as_ref().unwrap().data).clone())
    };
    let (first, text) = two_barges(35.0, "-PERIOD 8 10 -HEADING 180 240 -PANEL 4 -EDGE_SHARE 0.5", "");
    assert!(text.contains("wrote ") && text.contains("A_B.nc"), "{text}");
    let (again, text) = two_barges(35.0, "-PERIOD 8 10 -HEADING 180 240 -PANEL 4 -EDGE_SHARE 0.5", pressure);
    assert!(text.contains("A_B.nc: of the same mesh and settings"), "{text}");
    assert_eq!(data(&first), data(&again));
    let (other, text) = two_barges(35.0, "-PERIOD 8 10 -HEADING 180 240 -PANEL 4 -EDGE_SHARE 0.5", read);
    let plain = |data: [Database; 2]| {
        data.map(|own| Database { source: String::new(), panels: None, remarks: Vec::new(), ..own })
    };
    assert_eq!(plain(data(&first)), plain(data(&other)), "{text}");
    // the second is turned by 20 degrees
    let [_, second] = data(&first);
    let wanted = [160.0_f64, 220.0].map(|from| (from - 180.0).rem_euclid(360.0).to_radians());
    assert!(wanted.iter().all(|h| second.headings.iter().any(|own| (own - h).abs() < 1e-9)), "{:?}", second.headings);
    // another period is another problem
    let other = pressure.replace("8 10", "8 11");
    let (_, text) = two_barges(35.0, "-PERIOD 8 10 -HEADING 180 240 -PANEL 4 -EDGE_SHARE 0.5", &other);
    assert!(!text.contains("of the same mesh and settings"), "{text}");
}

#[test]
fn check_of_panels_shows_change_with_finer_mesh() {
    // the change of a result is that of a run with panels of the size that has twice as many: 4 m divides the barge of 90 x 30 x 3.7 m, a quarter of which is solved, into
    // whole panels, of which 2.83 m make fewer than twice as many
    let (data, text) = database("0 0 0", BARGE, "-PERIOD 8 10 -HEADING 180 -PANEL 4 -CHECK");
    let fact = |name: &str| -> f64 {
        let line =
            text.lines().find(|line| line.trim_start().starts_with(name)).unwrap_or_else(|| panic!("{name}: {text}"));
        line.split_whitespace().filter_map(|word| word.parse().ok()).next().unwrap()
    };
    let [own, more] = ["Panels  ", "Panels of the Finer Mesh"].map(fact);
    assert!(more >= 2.0 * own && more < 2.3 * own, "{own} {more}");
    let (fine, _) = database("0 0 0", BARGE, &format!("-PERIOD 8 10 -HEADING 180 -PANEL {}", fact("Finer Panels")));
    let (data, fine) = (data.unwrap(), fine.unwrap());
    let row = text.lines().find(|line| line.contains("added mass") && line.contains("BARGE Z-Z"));
    let numbers: Vec<f64> =
        row.unwrap_or_else(|| panic!("{text}")).split_whitespace().filter_map(|w| w.parse().ok()).collect();
    let values = |data: &Database| data.added_mass.iter().map(|m| m[(2, 2)]).collect::<Vec<f64>>();
    let (own, other) = (values(&data), values(&fine));
    let largest = own.iter().copied().fold(0.0, f64::max);
    let change = own.iter().zip(&other).map(|(a, b)| 100.0 * (a - b).abs() / largest).fold(0.0, f64::max);
    assert!((numbers[0] / largest - 1.0).abs() < 1e-3 && (numbers[1] - change).abs() < 1e-3, "{numbers:?} {change}");
    assert!(text.contains("Inside Out") && text.contains("Energy"), "{text}");
}

#[test]
fn drift_of_each_of_two_barges_adds_up_to_waves_far_away() {
    // the momentum through a box around each against Kochin's function of both
    let (session, text) = two_barges(0.0, "-PERIOD 6 8 -HEADING 225 -PANEL 2", "");
    let from = text.find("Drift: largest difference of the sum").unwrap_or_else(|| panic!("{text}"));
    let rows: Vec<Vec<f64>> = pressure_rows(&text[..from]).collect();
    assert!(rows.len() == 2 && rows.iter().all(|row| row.len() == 7) && rows.iter().all(|row| row[5] < 5.0), "{text}");
    for name in ["A", "B"] {
        let data = session.job.model.bodies[name].database.as_ref().unwrap().data.clone();
        assert!(data.drift.as_ref().is_some_and(|drift| drift.values[0].iter().any(|six| six[1].abs() > 0.0)));
    }
}

/// A barge of 40 x 12 m with a weight (kN) at a point ahead of its middle, where it floats, with G_PRESSURE, and records behind it.
fn floating_barge(weight: f64, ahead: f64, asked: &str, records: &str) -> (windlass::session::Session, String) {
    let (mut session, screen, _folder) = common::session();
    session.open(
        "records",
        format!(
            "&DIMEN -DIMEN METERS KN\n&DEFAULT -WATER 1025 -G 9.80665\n&ENV CALM -DEPTH 60\nMEDIT\n&DESCRIBE BODY S\n*G {ahead} 0 -0.5\n#WEIGHT *G {weight} 8 8 8\n\
             &SURFACE\nBLOCK HULL -20 -6 -4 20 6 4\nEND_&SURFACE\nEND\n&EQUI\nHYDRODYNAMICS\nG_PRESSURE S {asked}\nEND\n{records}"
        ),
    );
    session.run();
    let said: Vec<String> = session.reports.iter().map(|r| format!("{} {}", r.message, r.help.join(" "))).collect();
    let text = format!("{}\n{}", screen.text(), said.join("\n"));
    (session, text)
}

#[test]
fn trimmed_barge_moves_as_by_capytaine_on_its_trimmed_hull() {
    // tests/data/trimmed_barge/make.py: forces of a trimmed body stay along upright axes; tilted with it a thirtieth of the heave force pushed it ahead in beam
    // waves, by 0.58 m at 20 s. Panels of 3 m beside cosines: 1.5 % of a metre
    let (session, text) = floating_barge(18_900.0, 1.0, "-PERIOD 8 9 10 12 14 17 20 -PANEL 3", "");
    let linear = LinearSystem::new(&session.job.model).unwrap_or_else(|e| panic!("{e:?} {text}"));
    let mut reader = csv::Reader::from_path("tests/data/trimmed_barge/capytaine.csv").unwrap();
    for row in reader.records() {
        let row: Vec<f64> = row.unwrap().iter().map(|word| word.parse().unwrap()).collect();
        let operators = Operators::new(&linear, &[TAU / row[1]], &[row[0].to_radians() + PI]).unwrap();
        let made = &operators.motions[0][0];
        for (dof, exact) in row[2..5].iter().enumerate() {
            let made = made[dof].norm();
            assert!((made - exact).abs() < 0.015, "{} deg, {} s, {dof}: {made} for {exact}", row[0], row[1]);
        }
        // of pitch in head waves
        let (made, exact) = (made[4].norm().to_degrees(), row[6]);
        assert!((made - exact).abs() < 0.02 * 2.05, "{} deg, {} s: {made} for {exact}", row[0], row[1]);
    }
}

#[test]
fn wide_barge_rolls_as_by_capytaine_on_ever_finer_panels() {
    // tests/data/wide_barge/make.py: what sway and roll in beam waves go to by the square of the panel, where 2,560 panels by cosines are 10 % off in roll at 8 s
    // still; panels of 1.5 m, 3 % of the roll at 5 s (of 2 m 4.2 %, of 1 m 0.8 %). The force of a rotation in the direction of a translation stands for the moment of the translation too:
    // with that by its pressure roll was 6 % off at 6 s, 19 % at 8 s and 13 % at 30 s
    let records = "&DIMEN -DIMEN METERS KN\n&DEFAULT -WATER 1025 -G 9.80665\nMEDIT\n&DESCRIBE BODY S\n*G 0 0 1\n&SURFACE\nBLOCK HULL -15 -5 -3 15 5 5\nEND_&SURFACE\n\
                   END\n&WEIGHT -COMPUTE S 1 4 9 9\nHYDRODYNAMICS\nG_PRESSURE S -PERIOD 5 6 8 30 -HEADING 270 -PANEL 1.5 -MEAN_DRIFT NO\nEND\n";
    let (mut session, screen, _folder) = common::session();
    session.open("records", records.to_owned());
    session.run();
    let linear = LinearSystem::new(&session.job.model).unwrap_or_else(|e| panic!("{e:?} {}", screen.text()));
    let mut reader = csv::Reader::from_path("tests/data/wide_barge/capytaine.csv").unwrap();
    for row in reader.records() {
        let row: Vec<f64> = row.unwrap().iter().map(|word| word.parse().unwrap()).collect();
        let operators = Operators::new(&linear, &[TAU / row[0]], &[1.5 * PI]).unwrap();
        // of the origin, a metre below the centre of gravity
        let made = &operators.motions[0][0];
        let (sway, roll) = ((made[1] - made[3]).norm(), made[3].norm().to_degrees());
        let room = if row[0] < 10.0 { 0.03 * 1.0571 } else { 0.03 * row[8] };
        assert!((sway - row[4]).abs() < 0.01 && (roll - row[8]).abs() < room, "{} s: {sway} {roll}", row[0]);
    }
}

#[test]
fn body_that_floats_otherwise_than_its_database_had_it_is_named() {
    let ballast = |weight: f64| {
        format!(
            "MEDIT\n&DESCRIBE BODY S\n#WEIGHT *G {weight} 8 8 8\nEND\n&EQUI\nFREQ_RESPONSE\nRAO -PERIOD 9 -HEADING 180\nEND\n"
        )
    };
    // 4824.87 kN are 1.000 m of 480 m2 of sea water, a hundred 0.02 m
    let (_, text) = floating_barge(19_300.0, 0.0, "-PERIOD 8 10 -PANEL 6", &ballast(4824.87));
    assert!(text.contains("S is 1.00 m below where G_PRESSURE had it"), "{text}");
    let (_, text) = floating_barge(19_300.0, 0.0, "-PERIOD 8 10 -PANEL 6", &ballast(100.0));
    assert!(!text.contains("S is ") && !text.contains("times the mass"), "{text}");
}

#[test]
fn drift_with_roll_damping_in_per_cent_is_the_same_when_it_is_made_again() {
    let damped = "MEDIT\n&DESCRIBE BODY S\n#ROLL_DAMPING *G -CRITICAL 5\nEND\nHYDRODYNAMICS\nG_PRESSURE S -PERIOD 8 9 9.5 10 12 -PANEL 4 -HEADING 90 180\nEND\n";
    let drift = |records: &str| {
        let (session, text) = floating_barge(19_300.0, 0.0, "-PERIOD 10 -HEADING 180 -PANEL 6", records);
        let data = session.job.model.bodies["S"].database.as_ref().unwrap_or_else(|| panic!("{text}")).data.clone();
        data.drift.clone().unwrap_or_else(|| panic!("{text}")).values
    };
    let finer = damped.replace("-PANEL 4", "-PANEL 3.9");
    let (once, behind_other) = (drift(damped), drift(&format!("{finer}{damped}")));
    assert_eq!(once, behind_other);
}

/// A closed cylinder as a mesh file: of a radius about the z axis from 5 m above the origin to a depth (m), in panels smaller toward the water and the depth. Its
/// columns stand on a radius that gives the polygon the area of the circle.
fn cylinder_file(radius: f64, depth: f64, [rows, columns]: [usize; 2]) -> String {
    let step = TAU / columns as f64;
    let wider = radius * (step / step.sin()).sqrt();
    let below = (0..=rows).map(|k| -0.5 * depth * (1.0 - (PI * k as f64 / rows as f64).cos()));
    let heights: Vec<f64> = std::iter::once(5.0).chain(below).collect();
    let corners = heights.iter().flat_map(|z| {
        (0..columns).map(move |j| {
            let (sine, cosine) = (step * j as f64).sin_cos();
            format!("v {:.9} {:.9} {z:.9}\n", wider * cosine, wider * sine)
        })
    });
    let (top, number) = (columns * heights.len() + 1, |row: usize, j: usize| columns * row + j % columns + 1);
    let faces = (0..columns).flat_map(|j| {
        let last = heights.len() - 1;
        let ends = [
            format!("f {top} {} {}\n", number(0, j), number(0, j + 1)),
            format!("f {} {} {}\n", top + 1, number(last, j + 1), number(last, j)),
        ];
        let sides = (0..last).map(move |row| {
            let [a, b] = [number(row, j), number(row, j + 1)];
            format!("f {a} {} {} {b}\n", a + columns, b + columns)
        });
        ends.into_iter().chain(sides)
    });
    let middles = format!("v 0 0 5\nv 0 0 {}\n", -depth);
    corners.chain([middles]).chain(faces).collect()
}

#[test]
fn drift_of_each_of_two_cylinders_on_the_bottom_meets_exact_series() {
    // crates/diffraction/tests/data/two_cylinders.py: the pressure on each by the series of Linton and Evans for a radius of 1 in water 2 deep, here of 10 m in
    // 20 m; held by weights that no wave moves. 1.5 % of the largest force
    let (mut session, screen, folder) = common::session();
    let file = folder.path().join("cylinder.obj");
    std::fs::write(&file, cylinder_file(10.0, 20.0, [8, 32])).unwrap();
    let body = |name: &str| {
        format!(
            "&DESCRIBE BODY {name} -IGNORE Z RX RY\n*G{name} 0 0 0\n#WEIGHT *G{name} 1E9 1E3 1E3 1E3\n&SURFACE\nMESH H{name} {} -OWN_PANELS\n\
             END_&SURFACE\n",
            file.display()
        )
    };
    let exact = include_str!("../../../crates/diffraction/tests/data/two_cylinders_drift.csv");
    let rows: Vec<Vec<f64>> =
        exact.lines().skip(2).map(|line| line.split(',').map(|word| word.parse().unwrap()).collect()).collect();
    let frequency = |k: f64| (0.1 * k * (2.0 * k).tanh() * 9.80665).sqrt();
    let periods = [0.6, 1.0].map(|k| (TAU / frequency(k)).to_string()).join(" ");
    session.open(
        "records",
        format!(
            "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025 -G 9.80665\n&ENV CALM -DEPTH 20\nMEDIT\n{}{}END\n&INSTATE -LOCATE A -20 0 0\n\
             &INSTATE -LOCATE B 20 0 0\nHYDRODYNAMICS\nG_PRESSURE A -WITH B -PERIOD {periods} -HEADING 180 225\nEND\n",
            body("A"),
            body("B")
        ),
    );
    session.run();
    let text = screen.text();
    assert!(text.contains("on the bottom, without panels there"), "{text}");
    let drift = ["A", "B"].map(|name| {
        let attached = session.job.model.bodies[name].database.as_ref().unwrap_or_else(|| panic!("{text}"));
        attached.data.drift.clone().unwrap_or_else(|| panic!("{text}"))
    });
    for row in rows.iter().filter(|row| row[0] <= 1.0) {
        let largest = row[2].hypot(row[3]).max(row[4].hypot(row[5]));
        for (table, exact) in drift.iter().zip(row[2..].chunks(2)) {
            let at = table.frequencies.iter().position(|w| (w / frequency(row[0]) - 1.0).abs() < 1e-6).unwrap();
            let heading = table.headings.iter().position(|h| (h - row[1].to_radians()).abs() < 1e-6).unwrap();
            for (made, exact) in table.values[heading][at].iter().zip(exact) {
                let made = made / (1025.0 * 9.80665 * 10.0);
                assert!((made - exact).abs() < 0.015 * largest, "k {}, {} deg: {made} for {exact}", row[0], row[1]);
            }
        }
    }
}

#[test]
fn body_around_another_has_rest_of_drift_and_run_in_time_says_so() {
    // two pontoons 24 m apart are one body with a barge between them, of three planes of symmetry: an upright box fits around the barge alone
    let hulls = "&DIMEN -DIMEN METERS KN\nMEDIT\n&DESCRIBE BODY PAIR\n*G 0 0 0\n#WEIGHT *G 15434 9 6 10\n#DAMP *G 99 99 0 2E4\n&SURFACE\nBLOCK P -12 6 -4 12 14 4\nBLOCK S -12 -14 -4 12 -6 4\nEND_&SURFACE\n\
                 &DESCRIBE BODY MID\n*H 0 0 0\n#WEIGHT *H 1929 2 2 2\n#DAMP *H 99 99 0 2E3\n&SURFACE\nBLOCK H -6 -2 -4 6 2 4\nEND_&SURFACE\nEND\n";
    let asked = "HYDRODYNAMICS\nG_PRESSURE PAIR -WITH MID -PERIOD 5 7 -HEADING 180 -PANEL 2\nEND\n";
    let ran = "&ENV SEA -SEA REGULAR 180 0.5 7 -RAMP 5 -TIME 10 0.25\nTDOM\n";
    let run = |records: &str| {
        let (mut session, screen, _folder) = common::session();
        session.open("records", records.to_owned());
        session.run();
        (session, screen.text())
    };
    let (session, text) = run(&format!("{hulls}{asked}{ran}"));
    assert!(text.contains("PAIR by the waves far away from all bodies, less the drift of the others"), "{text}");
    assert!(text.contains("MID by a control surface around it"), "{text}");
    assert!(text.contains("the mean drift of MID was found by a control surface around it"), "{text}");
    assert!(!text.contains("Drift: largest difference of the sum"), "{text}");
    let drift = |name: &str| session.job.model.bodies[name].database.as_ref().unwrap().data.drift.clone().unwrap();
    assert!(drift("PAIR").values[0].iter().chain(&drift("MID").values[0]).all(|six| six[0].is_finite()));
    let (session, text) = run(&format!("{hulls}{}", asked.replace("-PANEL", "-MEAN_DRIFT NO -PANEL")));
    assert!(session.job.model.bodies["MID"].database.as_ref().unwrap().data.drift.is_none(), "{text}");
}

#[test]
fn lid_between_barges_lowers_water_of_gap_and_is_kept_with_results() {
    // two barges of 40 x 12 m side by side, 4 m apart: the damping is that of the waves far away and the power that the lid takes, to 3 % on these panels (5 % at 4.5 s, where the water of the gap resounds); an
    // epsilon of 0 changes nothing
    let body = |name: &str| {
        format!(
            "&DESCRIBE BODY {name}\n*G{name} 0 0 0\n#WEIGHT *G{name} 19293 4 11 11\n&SURFACE\nBLOCK H{name} -20 -6 -4 20 6 4\nEND_&SURFACE\n"
        )
    };
    let run = |lid: &str, behind: &str| {
        let (mut session, screen, folder) = common::session();
        let records = format!(
            "&DIMEN -DIMEN METERS KN\nMEDIT\n{}{}END\n&INSTATE -LOCATE A 0 8 0\n&INSTATE -LOCATE B 0 -8 0\n\
             HYDRODYNAMICS\nG_PRESSURE A -WITH B -PERIOD 5 6 -HEADING 90 -PANEL 2 {lid} -MEAN_DRIFT NO\n{behind}END\n",
            body("A"),
            body("B")
        );
        session.open("records", records);
        session.run();
        let said: Vec<String> = session.reports.iter().map(|r| format!("{} {}", r.message, r.help.join(" "))).collect();
        (session, format!("{}\n{}", screen.text(), said.join("\n")), folder)
    };
    let data =
        |session: &windlass::session::Session| (*session.job.model.bodies["B"].database.as_ref().unwrap().data).clone();
    let (plain, text, _) = run("", "");
    let (free, other, _) = run("-LID -20 -2 20 -14 0", "");
    assert!(other.contains("lid 1 reaches into body"), "{other}");
    assert!(free.job.model.bodies["B"].database.is_none());
    let (free, other, _) = run("-LID -20 -6 20 -10 0", "");
    let (one, two) = (data(&plain), data(&free));
    for (a, b) in one.added_mass.iter().chain(&one.damping).zip(two.added_mass.iter().chain(&two.damping)) {
        assert!((a - b).amax() < 1e-5 * a.amax(), "{text}{other}");
    }
    // in axes of A, which stands at y = 8
    let (damped, text, folder) = run("-LID -20 -6 20 -10 0.1", "");
    let found = data(&damped);
    assert_eq!(found.lids, [[-20.0, -6.0, 20.0, -10.0, 0.1]]);
    assert!(text.contains("Damping Lid 1 Epsilon") && text.contains("0.1"), "{text}");
    let mut files = vec![folder.path().to_owned()];
    let mut kept = None;
    while let Some(path) = files.pop() {
        if path.is_dir() {
            files.extend(std::fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.ends_with("A_B.nc") {
            kept = Some(std::fs::read(path).unwrap());
        }
    }
    let energy = windlass_hydro::database::capytaine::numbers("A_B.nc", &kept.unwrap(), "energy_difference").unwrap();
    assert!(energy.len() == 2 && energy.iter().all(|off| *off < 0.03), "{energy:?}");
    let change = (found.damping[1] - one.damping[1]).amax() / one.damping[1].amax();
    assert!(change > 0.01, "{change}");
    for (lid, fault) in [
        ("-LID 0 -6 0 -10 0.1", "has no area"),
        ("-LID -20 -6 20 -10 0.1 -LID 0 -6 5 -10 0.1", "-LID 1 and -LID 2 overlap"),
        ("-LID -20 -6 20 -10 -0.1", "EPSILON of -LID of G_PRESSURE must be between 0 and 100"),
        ("-LID -1E6 -6 1E6 -10 0.1", "of lids"),
    ] {
        let (session, text, _) = run(lid, "");
        assert!(text.contains(fault) && session.job.model.bodies["B"].database.is_none(), "{lid}: {text}");
    }
}

#[test]
fn bodies_that_cannot_be_solved_together_are_refused() {
    let asked = "-PERIOD 8 10 -HEADING 180 -PANEL 4 -EDGE_SHARE 0.5";
    let (session, text) =
        two_barges(0.0, asked, "&INSTATE -LOCATE B 305 -65\nHYDRODYNAMICS\nG_PRESSURE B -WITH A\nEND\n");
    assert!(text.contains("body 1 reaches into body 2") && text.contains("1 is B, 2 is A"), "{text}");
    // the databases of before are kept
    assert!(session.job.model.bodies["A"].database.as_ref().unwrap().data.interactions.len() == 1);
    let (_, text) = two_barges(0.0, asked, "HYDRODYNAMICS\nG_PRESSURE A -WITH A\nEND\n");
    assert!(text.contains("A is named twice"), "{text}");
    // moved away from where they were solved
    let (_, text) = two_barges(
        0.0,
        "-PERIOD 8 10 -PANEL 4 -EDGE_SHARE 0.5",
        "&INSTATE -LOCATE B 345 -30\nFREQ_RESPONSE\nRAO -HEADING 180 -PERIOD 8 10\nMOTION A\nREPORT\nEND\nEND\n",
    );
    assert!(text.contains("away from where G_PRESSURE of A and B had it beside A"), "{text}");
}

#[test]
fn roll_without_other_damping_is_warned_of() {
    // 40 x 12 x 4 m, its centre of gravity in the waterline: GM is 144/(12 4) - 2 = 1 m, so that with a radius of 4 m and added mass it rolls
    // slower than 2 pi 4/sqrt(g 1) = 8.0 s, where it radiates little
    let said = |damping: &str| {
        let (mut session, screen, _folder) = common::session();
        session.open(
            "records",
            format!(
                "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025 -G 9.80665\nMEDIT\n&DESCRIBE BODY BARGE\n*CG 0 0 0\n#WEIGHT *CG 19299 4 11 11\n\
                 {damping}&SURFACE\nBLOCK HULL -20 -6 -4 20 6 4\nEND_&SURFACE\nEND\n\
                 HYDRODYNAMICS\nG_PRESSURE BARGE -PERIOD 6 7 8 9 10 11 12 14 -HEADING 180 -PANEL 2\nEND\n"
            ),
        );
        session.run();
        let said: Vec<String> = session.reports.iter().map(|r| r.message.clone()).collect();
        format!("{}\n{}", screen.text(), said.join("\n"))
    };
    let text = said("");
    let from = text.find("BARGE: roll has the damping of radiated waves alone").unwrap_or_else(|| panic!("{text}"));
    let period = text[from..].split("natural period of ").nth(1).and_then(|t| t.split(' ').next()?.parse::<f64>().ok());
    assert!(period.is_some_and(|t| (8.0..11.0).contains(&t)), "{text}");
    let damped = said("#DAMP *CG 0 0 0 2E4\n");
    assert!(!damped.contains("roll has the damping"), "{damped}");
}

#[test]
fn one_period_serves_motions_and_waves_beyond_it_are_said() {
    let (mut session, _screen, _folder) = common::session();
    let hull = "&DIMEN -DIMEN METERS KN\nMEDIT\n&DESCRIBE BODY BARGE\n*G 0 0 0\n#WEIGHT *G 100552 12 26 26\n#DAMP *G 99 99 0 2E5\n&SURFACE\nBLOCK HULL -45 -15 -3.7 45 15 4\nEND_&SURFACE\nEND\n";
    session.open(
        "records",
        format!(
            "{hull}HYDRODYNAMICS\nG_PRESSURE BARGE -PERIOD 8 -HEADING 180 -PANEL 6\nEND\nFREQ_RESPONSE\nRAO\nEND\n"
        ),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let said = |session: &windlass::session::Session| {
        session.reports.iter().map(|r| r.message.clone()).collect::<Vec<_>>().join("\n")
    };
    assert!(!said(&session).contains("outside of it"), "{}", said(&session));
    // of the spectrum of ISSC with a mean period of T1, exp(-691/(T1 w)^4) of the energy is below a frequency: 0.758 below 2 pi/8 with 9 s
    session.open("more", "FREQ_RESPONSE\nRAO -PERIOD 8 20\nEND\n&ENV SEA -SEA ISSC 180 2 9 -TIME 20 0.25\nFREQ_RESPONSE\nSRESPONSE\nEND\n&EQUI\nTDOM\n".to_owned());
    session.run();
    let text = said(&session);
    assert!(
        text.contains("the database of BARGE has periods of 8.00 s alone: that of 20.00 s is outside of it"),
        "{text}"
    );
    assert!(
        text.contains("76 % of the energy of the sea is in longer waves")
            && text.contains("24 % of the energy of the sea is in shorter"),
        "{text}"
    );
    let drift = "the mean drift of BARGE in its database has periods of 8.00 s alone: 76 % of the energy of the sea is in longer waves, for which the drift of its longest period stands; 24 %";
    assert!(text.contains(drift), "{text}");
    // nothing holds it
    assert!(text.contains("nothing holds BARGE in X, Y, RZ: ") && text.contains("drift carries it away"), "{text}");
    assert!(text.contains("its database has one frequency only"), "{text}");
    assert_eq!(session.errors, 1, "{text}");
}

#[test]
fn options_of_another_source_of_a_database_are_refused() {
    let (mut session, _screen, _folder) = common::session();
    let file = "tests/data/hemisphere/hemisphere.nc";
    session.open(
        "records",
        format!("&DIMEN -DIMEN METERS KN\nMEDIT\n&DESCRIBE BODY B\nDATABASE B -CAPYTAINE {file} -XBODY 1 2\nDATABASE B -CAPYTAINE {file} -PHASE LEAD\nEND\n"),
    );
    session.run();
    let said: Vec<&str> = session.reports.iter().map(|report| report.message.as_str()).collect();
    assert_eq!(said, ["-XBODY goes with -WAMIT, not with -CAPYTAINE", "-PHASE goes with -RAO, not with -CAPYTAINE"]);
    assert!(session.job.model.bodies["B"].database.is_none());
}
