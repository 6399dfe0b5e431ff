//! HSTATICS in the forms of MOSES, against closed forms of the tutorial barge: a box of 91.5 x 27.5 x 6.1 m. While neither its bilge nor its
//! deck edge crosses the surface (roll below 9.6 degrees at a draft of 2.33 m) its righting arm is GZ = sin a (GM + BM tan^2 a / 2), and
//! the area under it from upright GM (1 - cos a) + BM / 2 (1 / cos a + cos a - 2).

use crate::common::{self, assert_near};
use std::f64::consts::PI;

const LENGTH: f64 = 91.5;
const BEAM: f64 = 27.5;
const WEIGHT: f64 = 6000.0;
/// Weight of water (t/m3).
const WATER: f64 = 1.025;
const KG: f64 = 5.0;

fn draft() -> f64 {
    WEIGHT / (WATER * LENGTH * BEAM)
}
fn bm() -> f64 {
    BEAM * BEAM / (12.0 * draft())
}
fn km() -> f64 {
    0.5 * draft() + bm()
}
/// Righting arm of the box with its center of gravity at a height (m).
fn righting_arm(degrees: f64, kg: f64) -> f64 {
    let a = degrees.to_radians();
    a.sin() * (km() - kg + 0.5 * bm() * a.tan().powi(2))
}
/// Area under it from upright (m rad).
fn area(degrees: f64, kg: f64) -> f64 {
    let c = degrees.to_radians().cos();
    (km() - kg) * (1.0 - c) + 0.5 * bm() * (1.0 / c + c - 2.0)
}

/// What a session prints, and its messages.
fn print_records(records: &str) -> (String, Vec<String>) {
    let (mut session, screen, _folder) = common::session();
    session.open("records", format!("&DIMEN -DIMEN METERS M-TONS\n&DEFAULT -WATER 1025 -G 9.80665\n{records}\n"));
    session.run();
    let said = session.reports.iter().map(|d| format!("{}: {} {}", d.severity.mark(), d.message, d.help.join(" ")));
    (screen.text(), said.collect())
}

/// The barge under some weights of category and stations of their own, with more records of its menu.
fn barge(weight: &str, more: &str) -> String {
    format!(
        "MEDIT\n&DESCRIBE BODY B\n*CG 45.75 0 5\n{more}PGEN -CS_WIND 0 0 0 -CS_CURRENT 0 0 0\nPLANE 0 91.5 -RECT 0 6.10 27.50\nEND\n{weight}\nEND\n\
         &INSTATE -CONDITION 2\n"
    )
}
const OWN: &str = "#WEIGHT *CG 6000 9 25 25";

/// A column of the table of a command of HSTATICS, in metres and tonnes.
fn column(records: &str, command: &str, selector: &str) -> Vec<f64> {
    let (text, said) = print_records(&format!(
        "{records}HSTATICS\n{command}\nSET_VARIABLE V '{selector}'\nEND\nEND\n&TYPE GOT %V% END\n"
    ));
    let values = text.split_once("GOT ").and_then(|(_, rest)| rest.split_once(" END")).map(|(values, _)| values);
    let values = values.unwrap_or_else(|| panic!("{command}: {said:?}\n{text}"));
    values.split_whitespace().map(|word| word.parse().unwrap()).collect()
}

/// The rows of quantities and values that STAB_OK and KG_ALLOW print.
fn value(text: &str, name: &str, position: usize) -> f64 {
    let line = text.lines().find(|line| line.split_whitespace().nth(1) == Some(name));
    let word = line.and_then(|line| line.split_whitespace().nth(position)).and_then(|word| word.parse().ok());
    word.unwrap_or_else(|| panic!("{name} in {text}"))
}

#[test]
fn curves_of_form_vary_draft_as_moses_has_them() {
    // four drafts from 1 m: displacement rho L B d, KMT = d / 2 + B^2 / (12 d)
    let hull = barge("", "");
    for (selector, of) in [
        ("Displ.", &(|d: f64| WATER * LENGTH * BEAM * d) as &dyn Fn(f64) -> f64),
        ("KMT", &|d: f64| 0.5 * d + BEAM * BEAM / (12.0 * d)),
        ("BML", &|d: f64| LENGTH * LENGTH / (12.0 * d)),
    ] {
        let found = column(&hull, "CFORM 1 0 0 -DRAFT 0.5 4", selector);
        assert_eq!(found.len(), 4);
        for (n, got) in found.iter().enumerate() {
            assert_near(*got, of(1.0 + 0.5 * n as f64), 1e-9);
        }
    }
    // a box rolled about its keel line while its sides are wet: the volume is L B d' / cos a, d' being the depth of the origin
    let rolled = column(&hull, "CFORM 3 2 0 -ROLL 2 3", "Volume");
    for (n, got) in rolled.iter().enumerate() {
        assert_near(*got, LENGTH * BEAM * 3.0 / (2.0 * (n as f64 + 1.0)).to_radians().cos(), 1e-9);
    }
}

#[test]
fn curves_of_form_under_static_wave_match_integrals_of_cosine() {
    // a wave as long as the box, amplitude 1 m: the volume is that of still water; KB = (d^2 + a^2 / 2) / (2 d); with the crest at a
    // quarter length LCB = L / 2 - a L / (2 pi d)
    let hull = barge("", "");
    let wave = format!("-WAVE {LENGTH} {} {}", LENGTH / 2.0, LENGTH / 4.0);
    let command = format!("CFORM 3 0 0 -DRAFT 1 1 {wave}");
    // straight pieces of 1/96 of the wave, corrected to the fourth order: 1e-6 of the amplitude
    assert_near(column(&hull, &command, "Volume")[0], LENGTH * BEAM * 3.0, 1e-6);
    assert_near(column(&hull, &command, "KB")[0], (9.0 + 0.5) / 6.0, 1e-5);
    assert_near(column(&hull, &command, "LCB")[0], LENGTH / 2.0 - LENGTH / (2.0 * PI * 3.0), 1e-5);
    // the wave stays for the next command, and ends with one of no height
    let next = format!("{command}\nEND\nCFORM 3 0 0 -DRAFT 1 1");
    assert_near(column(&hull, &next, "KB")[0], (9.0 + 0.5) / 6.0, 1e-5);
    assert_near(column(&hull, &format!("{next} -WAVE 0"), "KB")[0], 1.5, 1e-12);
}

#[test]
fn equi_h_finds_heel_of_weight_beside_centreline() {
    // GZ(a) = y cos a: the weight at y = tan a (GM + BM tan^2 a / 2) turns the starboard side down by a
    let offset = righting_arm(3.0, KG) / 3f64.to_radians().cos();
    let records = format!(
        "{}HSTATICS\nEQUI_H\nEND\n&TYPE AT &BODY(LOCATION B) END\nHSTATICS\nEQUI_H -FIX ROLL PITCH\nEND\n",
        barge("#WEIGHT *OFF 6000 9 25 25", &format!("*OFF 45.75 {offset:.12} 5\n"))
    );
    let (text, said) = print_records(&records);
    assert!(said.is_empty(), "{said:?}");
    let at = text.split_once("AT ").unwrap().1.split_once(" END").unwrap().0;
    let at: Vec<f64> = at.split_whitespace().map(|word| word.parse().unwrap()).collect();
    // eight figures are printed
    assert_near(at[3], -3.0, 1e-7);
    assert!(at[4].abs() < 1e-6, "{at:?}");
    // an upright box with KG above KM is in an equilibrium from which it rolls away: KG 40, KM 28.25
    let high = barge("#WEIGHT *HIGH 6000 9 25 25", "*HIGH 45.75 0 40\n");
    let (_, said) = print_records(&format!("{high}HSTATICS\nEQUI_H\nEND\n"));
    assert!(said.len() == 1 && said[0].contains("metacentric height is -11.74"), "{said:?}");
}

#[test]
fn righting_arms_and_areas_match_wall_sided_formula() {
    let records = barge(OWN, "");
    let arms = column(&records, "RARM 2.5 3", "Righting: Arm");
    let areas = column(&records, "RARM 2.5 3", "Righting: Area");
    for (n, (arm, got)) in arms.iter().zip(&areas).enumerate() {
        let degrees = 2.5 * n as f64;
        assert!((arm - righting_arm(degrees, KG)).abs() < 1e-8, "{arm} at {degrees}");
        // Simpson's rule over 2.5 degrees errs by h^5 / 2880 f'''' < 1e-8
        assert!((got - area(degrees, KG)).abs() < 1e-7, "{got} at {degrees}");
    }
    // rolled to the other side they are the same
    let other = column(&records, "RARM -2.5 3", "Righting: Arm");
    assert_near(other[3], righting_arm(7.5, KG), 1e-8);
    // twice the weight: the draft, KB and BM of the box at 12,000 t
    let doubled = column(&records, "RARM 2.5 1 -WEIGHT 2", "Righting: Arm");
    let (d, a) = (2.0 * draft(), 2.5f64.to_radians());
    let bm = BEAM * BEAM / (12.0 * d);
    assert_near(doubled[1], a.sin() * (0.5 * d + bm - KG + 0.5 * bm * a.tan().powi(2)), 1e-8);
}

#[test]
fn righting_arm_about_skew_axis_lets_trim_follow() {
    // a small roll about an axis at 30 degrees with trim free across it: GM' = 2 x 2 stiffness of GMT and GML condensed
    let records = barge(OWN, "");
    let angle = 0.01f64;
    let arms = column(&records, &format!("RARM {angle} 1 -YAW 30"), "Righting: Arm");
    let (gmt, gml) = (km() - KG, 0.5 * draft() + LENGTH * LENGTH / (12.0 * draft()) - KG);
    let (c, s) = (30f64.to_radians().cos(), 30f64.to_radians().sin());
    let (along, across, both) = (gmt * c * c + gml * s * s, gmt * s * s + gml * c * c, (gml - gmt) * s * c);
    let want = (along - both * both / across) * angle.to_radians();
    // terms of third order in the angle are 1e-7 of it
    assert_near(arms[1] / want, 1.0, 1e-6);
    // with the trim held it does not follow
    let held = column(&records, &format!("RARM {angle} 1 -YAW 30 -FIX"), "Righting: Arm");
    assert_near(held[1] / (along * angle.to_radians()), 1.0, 1e-6);
}

#[test]
fn wind_heeling_moment_is_about_holding_point() {
    // 100 m2 at 20 m above the keel in a wind that is the same at all heights: F = rho V^2 / 2 A, upright arm F (z - z0) / W
    let records = format!(
        "{}&ENV -W_PROFILE POWER 0\n&DEFAULT -AIR 1.226\n",
        barge(&format!("{OWN}\n#AREA *UP 0 100 0"), "*UP 45.75 0 20\n")
    );
    let knot = 1852.0 / 3600.0;
    let force = 0.5 * 1.226 * (50.0 * knot * 50.0 * knot) * 100.0 / (1000.0 * 9.80665);
    let about = |command: &str| column(&records, command, "Heeling: Arm")[0];
    assert_near(about("RARM 5 1 -WIND 50 -CEN_LATERAL 45.75 0 1"), force * 19.0 / WEIGHT, 1e-6);
    assert_near(about("RARM 5 1 -WIND 50"), force * (20.0 - 0.5 * draft()) / WEIGHT, 1e-6);
    // the drag of a box is that of its wet side, whose center is at half the draft
    let drags = records.replace("-CS_CURRENT 0 0 0", "-CS_CURRENT 1 1 1");
    let held = column(&drags, "RARM 5 1 -WIND 50 -U_CURRENT", "Heeling: Arm")[0];
    assert_near(held, force * (20.0 - 0.5 * draft()) / WEIGHT, 1e-6);
    let (_, said) = print_records(&format!("{records}HSTATICS\nRARM 5 1 -WIND 50 -U_CURRENT\nEND\nEND\n"));
    assert!(said.len() == 1 && said[0].contains("nothing of it has drag"), "{said:?}");
}

#[test]
fn criteria_match_crossings_solved_by_hand() {
    // a constant heeling arm GZ(5 deg): R = H first at 5 deg. A vent at half the beam whose height over the water is
    // (z - d) cos a - B/2 sin a goes under at 8 deg
    let arm = righting_arm(5.0, KG);
    let vent = draft() + 0.5 * BEAM * 8f64.to_radians().tan();
    let records = format!(
        "{}HSTATICS\nSTAB_OK 1 9 -W_COEFF {arm:.12} -I_GM 23 -I_THETA1 5.1 -I_AR_RATIO 9 -D_GM 99\nREPORT\nEND\nEND\n",
        barge(OWN, &format!("*VENT 45.75 {:.6} {vent:.12}\n&DESCRIBE HOLE V VENT -POINT *VENT\n", -0.5 * BEAM))
    );
    let (text, said) = print_records(&records);
    let heel = |degrees: f64| arm * degrees.to_radians();
    for (name, want) in [
        ("GM", km() - KG),
        ("ZCROSS", 0.0),
        ("THETA1", 5.0),
        ("DOWN_H", vent - draft()),
        ("DANG", 8.0),
        ("DANG_T1", 3.0),
        ("AR_RATIO", area(8.0, KG) / heel(8.0)),
        ("AR_RESID", area(8.0, KG) - area(5.0, KG) - heel(3.0)),
        ("ARE@DFLD", area(8.0, KG)),
    ] {
        // four decimals are printed
        assert!((value(&text, name, 2) - want).abs() < 6e-5, "{name} {want}: {text}");
    }
    // RA(8 deg) / HA(8 deg) = 0.80: the one limit that is not met; those of a damaged body are not asked
    assert!(said.len() == 1 && said[0].contains("does not meet AR_RATIO"), "{said:?}");
}

#[test]
fn angles_of_leaning_body_start_at_its_equilibrium() {
    // the weight beside the centreline of `equi_h` raises port: the equilibrium is 3 deg before upright, and an arm from there
    let offset = righting_arm(3.0, KG) / 3f64.to_radians().cos();
    let records = barge("#WEIGHT *OFF 6000 9 25 25", &format!("*OFF 45.75 {offset:.12} 5\n"));
    for (step, want) in [("1", -3.0), ("-1", 3.0)] {
        let (text, _) = print_records(&format!("{records}HSTATICS\nSTAB_OK {step} 6\nREPORT\nEND\nEND\n"));
        assert!((value(&text, "ZCROSS", 2) - want).abs() < 6e-5, "{text}");
    }
}

#[test]
fn allowable_kg_matches_closed_forms() {
    let records = barge(OWN, "*VENT 45.75 -13.75 4.2588\n&DESCRIBE HOLE V V_VALVE -POINT *VENT\n");
    let kg = |options: &str, name: &str, position: usize| {
        let (text, said) = print_records(&format!("{records}HSTATICS\nKG_ALLOW 1 9 {options}\nREPORT\nEND\nEND\n"));
        assert!(said.is_empty(), "{said:?}");
        value(&text, name, position)
    };
    // without a criterion KM; GM >= 0.15 takes that from it
    assert!((kg("", "KM", 5) - km()).abs() < 6e-5);
    assert!((kg("-I_GM 0.15", "GM", 5) - (km() - 0.15)).abs() < 6e-5);
    // the area to down-flooding, (KM - KG) (1 - cos a) + BM / 2 (..) >= 0.1, solved for KG; a is where the vent goes under
    let flooding = ((4.2588 - draft()) / (0.5 * BEAM)).atan().to_degrees();
    let form = area(flooding, km());
    let want = km() - (0.1 - form) / (1.0 - flooding.to_radians().cos());
    assert!((kg("-ARE@DFLD 0.1", "ARE@DFLD", 5) - want).abs() < 6e-5);
    assert!((kg("-ARE@DFLD 0.1 -GM 0.15", "all", 2) - want).abs() < 6e-5);
    // a hull of 2 m draft without weight: KM = d / 2 + B^2 / (12 d)
    let (text, _) = print_records(&format!("{}HSTATICS\nKG_ALLOW\nREPORT\nEND\nEND\n", barge("", "")));
    assert!((value(&text, "KM", 5) - (1.0 + BEAM * BEAM / 24.0)).abs() < 6e-5, "{text}");
    // 1000 t at KG 5 of the 5158.3125 t: what all may have less their moment, over the rest
    let (text, _) =
        print_records(&format!("{}HSTATICS\nKG_ALLOW\nREPORT\nEND\nEND\n", barge("#WEIGHT *CG 1000 9 25 25", "")));
    let whole = WATER * LENGTH * BEAM * 2.0;
    let want = ((1.0 + BEAM * BEAM / 24.0) * whole - 5000.0) / (whole - 1000.0);
    assert!((value(&text, "KM", 6) - want).abs() < 6e-5, "{want}: {text}");
}

#[test]
fn bending_of_box_matches_beams_by_hand() {
    // W over the middle l on buoyancy over L: W (L - l) / 8 sagging; a force amidships W L / 8; evenly over the length nothing. Ballast
    // in a tank of the middle third is the first again, here 1000 t
    let midship = |weight: &str, more: &str| {
        let records = format!("{}HSTATICS\nEQUI_H\nEND\n", barge(weight, more));
        (column(&records, "MOMENT", "Moment")[10], column(&records, "MOMENT", "Shear"))
    };
    let (moment, shear) = midship(&format!("{OWN} -LDIST 30.5 61"), "");
    assert_near(moment, WEIGHT * (LENGTH - 30.5) / 8.0, 1e-9);
    // a quarter length from the end: W / 4, all buoyancy
    assert_near(shear[5], WEIGHT / 4.0, 1e-9);
    assert_near(midship(OWN, "").0, WEIGHT * LENGTH / 8.0, 1e-9);
    let (moment, shear) = midship(&format!("{OWN} -LDIST 0 91.5"), "");
    assert!(moment.abs() < 1e-6 && shear.iter().all(|q| q.abs() < 1e-6), "{moment} {shear:?}");
    let tank = "&DESCRIBE COMPARTMENT T\nPGEN\nPLANE 30.5 61 -RECT 0 5 20\nEND\n&DESCRIBE COMPARTMENT B\n";
    let records = barge(&format!("{OWN} -LDIST 0 91.5"), tank);
    let filled = format!("{records}&COMPARTMENT -AMOUNT T 1000 1.025\nHSTATICS\nEQUI_H\nEND\n");
    assert_near(column(&filled, "MOMENT", "Moment")[10], 1000.0 * (LENGTH - 30.5) / 8.0, 1e-9);
    assert_near(column(&filled, "MOMENT", "Contents")[20], 1000.0, 1e-9);
}

#[test]
fn bending_in_static_wave_matches_integral_of_cosine() {
    // crest amidships, amplitude 1 m, length of the box, the weight even: the buoyancy of -cos(2 pi x / L) bends it by
    // rho B a L^2 / (2 pi^2), hogging
    let records = format!("{}HSTATICS\nEQUI_H\nEND\n", barge(&format!("{OWN} -LDIST 0 91.5"), ""));
    let wave = format!("MOMENT -WAVE {LENGTH} {} {}", LENGTH / 2.0, LENGTH / 2.0);
    let found = column(&records, &wave, "Moment");
    assert_near(found[10] / (-WATER * BEAM * LENGTH * LENGTH / (2.0 * PI * PI)), 1.0, 1e-5);
    // with the trough there it sags as much; EQUI_H under the wave closes what a crest at a quarter leaves open
    let skew = format!("-WAVE {LENGTH} {} {}", LENGTH / 2.0, LENGTH / 4.0);
    let (text, said) = print_records(&format!("{records}HSTATICS\nMOMENT {skew}\nREPORT\nEND\nEND\n"));
    assert!(said.len() == 1 && said[0].contains("do not close"), "{said:?} {text}");
    let (text, said) = print_records(&format!("{records}HSTATICS\nEQUI_H {skew}\nMOMENT\nREPORT\nEND\nEND\n"));
    assert!(said.is_empty() && !text.contains("not in equilibrium"), "{said:?} {text}");
}

#[test]
fn loads_without_stations_and_closure_error_are_reported() {
    let records = barge(OWN, "");
    let (text, said) = print_records(&format!("{records}HSTATICS\nMOMENT\nREPORT\nEND\nEND\n"));
    // just before the force amidships half of the buoyancy pushes up
    assert!(text.lines().any(|line| line.contains("Greatest Shear") && line.contains("2579.16")), "{text}");
    // at 2 m draft 5158.3125 t carry 6000 t
    assert!(said.len() == 1 && said[0].contains("-841.6875"), "{said:?}");
    assert!(text.contains("weights without -LDIST act at their centers: 1, of 6000 m-tons in all"), "{text}");
    let (_, said) = print_records(&format!("{records}HSTATICS\nMOMENT -ALLOW 20 1\nEND\nEND\n"));
    assert!(said.iter().any(|text| text.contains("need the section of the body")), "{said:?}");
    let (_, said) = print_records(
        "MEDIT\n&DESCRIBE BODY B\n*P 0 0 0\n#WEIGHT *P 100 1 1 1\n#BUOY *P 200 1 1 9\nEND\nHSTATICS\nEQUI_H -WAVE 50 20\nEND\n",
    );
    assert!(said.len() == 1 && said[0].contains("not of its hull's pieces"), "{said:?}");
}

#[test]
fn polynomials_of_arms_add_to_both_and_end_the_table() {
    let records = barge(OWN, "");
    let poly = |c: [f64; 4], a: f64| c[0] + a * (c[1] + a * (c[2] + a * c[3]));
    let (w, r) = ([0.02, 0.003, -1e-4, 1e-5], [0.01, -0.002, 2e-4, -3e-5]);
    let options = format!("-W_COEFF {} {} {} {} -R_COEFF {} {} {} {}", w[0], w[1], w[2], w[3], r[0], r[1], r[2], r[3]);
    let heeling = column(&records, &format!("RARM 2 4 {options}"), "Heeling: Arm");
    let righting = column(&records, &format!("RARM 2 4 {options}"), "Righting: Arm");
    for n in 0..5 {
        let a = 2.0 * n as f64;
        assert!((heeling[n] - poly(w, a)).abs() < 1e-9, "{a} {}", heeling[n]);
        assert!((righting[n] - righting_arm(a, KG) - poly(r, a)).abs() < 1e-8, "{a} {}", righting[n]);
    }
    // the righting arm is lost at 5.5 deg, and the net one at 7.5 deg: the row behind is the last
    let falls = righting_arm(5.5, KG) / 5.5f64.powi(3);
    let made = column(&records, &format!("RARM 1 9 -R_COEFF 0 0 0 {} -STOP RARM", -falls), "Righting: Arm");
    assert_eq!(made.len(), 7, "{made:?}");
    let rises = righting_arm(7.5, KG) / 7.5f64.powi(3);
    let made = column(&records, &format!("RARM 1 9 -W_COEFF 0 0 0 {rises} -STOP NET"), "Righting: Arm");
    assert_eq!(made.len(), 9, "{made:?}");
    assert_eq!(column(&records, &format!("RARM 1 9 -W_COEFF 0 0 0 {rises} -STOP RARM"), "Righting: Arm").len(), 10);
}

#[test]
fn weather_arm_and_weathertight_criteria_match_closed_forms() {
    // a constant heeling arm GZ(5 deg), a vent that goes under at 8 deg and a weathertight one at 7 deg
    let arm = righting_arm(5.0, KG);
    let height = |degrees: f64| draft() + 0.5 * BEAM * degrees.to_radians().tan();
    let side = -0.5 * BEAM;
    let holes = format!(
        "*V1 45.75 {side:.6} {:.12}\n*V2 45.75 {side:.6} {:.12}\n&DESCRIBE HOLE V VENT -POINT *V1\n&DESCRIBE HOLE W WT_VENT -POINT *V2\n",
        height(8.0),
        height(7.0)
    );
    let asked = |options: &str| {
        let (text, said) =
            print_records(&format!("{}HSTATICS\nSTAB_OK 1 9 {options}\nREPORT\nEND\nEND\n", barge(OWN, &holes)));
        assert!(said.is_empty(), "{said:?}");
        text
    };
    let heel = |degrees: f64| arm * degrees.to_radians();
    let text = asked(&format!("-W_COEFF {arm:.12} -I_AR_WRATIO 0.1 4 -I_DWT_T1 1"));
    let weather = (area(8.0, KG) - area(5.0, KG) - heel(3.0)) / (heel(4.0) - area(5.0, KG) + area(1.0, KG));
    for (name, want) in [("DWT_T1", 2.0), ("AR_WRATIO", weather)] {
        assert!((value(&text, name, 2) - want).abs() < 6e-5, "{name} {want}: {text}");
    }
    // the righting arm GZ(a) - c a^3 is greatest between 6 and 7 deg, where its ratio to the heeling arm is asked
    let falls = 3e-3;
    let righting = |a: f64| righting_arm(a, KG) - falls * a.powi(3);
    let peak = (0..90_000).map(|n| 1e-4 * f64::from(n)).map(righting).fold(0.0, f64::max);
    let arm = righting(2.0);
    let text = asked(&format!("-R_COEFF 0 0 0 {} -W_COEFF {arm:.12} -I_ARM_RATIO 1", -falls));
    assert!((value(&text, "ARM_RATIO", 2) - peak / arm).abs() < 1e-4, "{} {text}", peak / arm);
}
