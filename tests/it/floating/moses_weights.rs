//! Weights, load categories and load groups in the forms of MOSES.

use crate::common::{fact, print_records};

/// The row of a table that begins with words, as numbers.
fn row(text: &str, begins: &str) -> Vec<f64> {
    let found = text.lines().find(|line| line.split_whitespace().collect::<Vec<_>>().join(" ").starts_with(begins));
    let found = found.unwrap_or_else(|| panic!("{begins} in {text}"));
    found.split_whitespace().filter_map(|word| word.parse().ok()).collect()
}

fn check_near(got: f64, want: f64, by: f64) {
    assert!((got - want).abs() <= by, "{got} is not {want}");
}

#[test]
fn computed_weight_balances_box_at_its_draft() {
    // displacement of a box in sea water of 0.0639887 kip/ft3 and GM = d/2 + B^2/(12 d) - ZCG, at even keel
    for (l, b, d, weight, gmt, gml) in [
        (180.0, 50.0, 7.0, 4031.29, 28.2619, 384.214),
        (300.0, 90.0, 7.0, 12093.9, 94.9286, 1069.93),
        (400.0, 100.0, 9.0, 23035.9, 92.0926, 1480.98),
    ] {
        let records = format!(
            "MEDIT\n&DESCRIBE BODY BARGE\nPGEN\nPLANE 0 {l} -RECT 0 14 {b}\nEND\nEND\n&INSTATE -CONDITION {d}\n\
             &WEIGHT -COMPUTE 5 32 85 85\n&STATUS WEIGHT\n&STATUS HYDROSTATICS"
        );
        let (text, errors) = print_records(&records);
        assert_eq!(errors, 0, "{text}");
        let [_, found, x, y, z, kx, ky, kz] = row(&text, "BARGE (whole)")[..] else { panic!("{text}") };
        check_near(found, weight, 1e-5 * weight);
        for (got, want) in [(x, 0.5 * l), (y, 0.0), (z, 5.0), (kx, 32.0), (ky, 85.0), (kz, 85.0)] {
            check_near(got, want, 0.0051);
        }
        check_near(fact(&text, "GM Transverse"), gmt, 0.0051);
        check_near(fact(&text, "GM Longitudinal"), gml, 0.0051);
    }
}

#[test]
fn computed_weight_of_heeled_body_lies_on_vertical_through_buoyancy() {
    let (text, errors) = print_records(
        "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY B\nPGEN\nPLANE 0 91.5 -RECT 0 6.10 27.50\nEND\nEND\n\
         &INSTATE -CONDITION B 2.8 4 0.5\n&WEIGHT -COMPUTE B 5 9 25 25\n&EQUI\n&STATUS CONFIGURATION\n&STATUS HYDROSTATICS",
    );
    assert_eq!(errors, 0, "{text}");
    // nothing moves it: roll 4, trim 0.5 as they were given
    let position = row(&text[text.find("C O N F I G U R A T I O N").unwrap_or(0)..], "B ");
    check_near(position[2], -2.8, 0.0051);
    check_near(position[3], 4.0, 0.0051);
    check_near(position[4], 0.5, 0.0051);
    check_near(fact(&text, "Center of Gravity X"), fact(&text, "Center of Buoyancy X"), 0.0101);
    check_near(fact(&text, "Center of Gravity Y"), fact(&text, "Center of Buoyancy Y"), 0.0101);
}

#[test]
fn computed_weight_adds_to_present_weight() {
    // 180 x 50 x 7 ft: 4031.29 kip; of these 1000 at x 60: the rest is 3031.29 at (4031.29*90 - 60000)/3031.29 = 99.896
    let (text, errors) = print_records(
        "MEDIT\n&DESCRIBE BODY B\n*P 60 0 9\n#WEIGHT *P 1000\nPGEN\nPLANE 0 180 -RECT 0 14 50\nEND\nEND\n&INSTATE -CONDITION 7\n\
         &WEIGHT -COMPUTE 5 32 85 85\n&STATUS WEIGHT",
    );
    assert_eq!(errors, 0, "{text}");
    let whole = row(&text, "B (whole)");
    check_near(whole[1], 4031.29, 0.02);
    check_near(whole[2], 90.0, 0.0051);
    // z: (1000*9 + 3031.29*5)/4031.29
    check_near(whole[4], 5.9922, 0.0051);
}

const TWO: &str = "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY B\n*P 10 0 2\n*Q 40 0 6\n#WEIGHT *P 300 4 8 8 -CATEGORY STEEL\n\
    #WEIGHT *Q 100 -CATEGORY CARGO\nEND\n";

#[test]
fn total_of_unchanged_weight_moves_the_centre() {
    let (text, errors) = print_records(&format!("{TWO}&WEIGHT -TOTAL B 400 20 1 4 5 12 12\n&STATUS WEIGHT"));
    assert_eq!(errors, 0, "{text}");
    let whole = row(&text, "B (whole)");
    for (got, want) in whole[1..].iter().zip([400.0, 20.0, 1.0, 4.0, 5.0, 12.0, 12.0]) {
        check_near(*got, want, 0.0051);
    }
    // radii that are not given stay: kx^2 = (300 (16 + 1) + 100 9)/400 about z = 3
    let (text, _) = print_records(&format!("{TWO}&WEIGHT -TOTAL B 400 20 1 4\n&STATUS WEIGHT"));
    check_near(row(&text, "B (whole)")[5], 15f64.sqrt(), 0.0051);
}

#[test]
fn defined_weight_and_margin_change_the_total() {
    let (text, errors) =
        print_records(&format!("{TWO}&WEIGHT -DEFINE B 100 60 0 8 1 1 1\n&WEIGHT -MARGIN 1.06\n&STATUS WEIGHT"));
    assert_eq!(errors, 0, "{text}");
    let whole = row(&text, "B (whole)");
    check_near(whole[1], 1.06 * 500.0, 0.0051);
    check_near(whole[2], (300.0 * 10.0 + 100.0 * 40.0 + 100.0 * 60.0) / 500.0, 0.0051);
}

#[test]
fn spread_of_a_weight_leaves_its_centre() {
    let (text, errors) =
        print_records("MEDIT\n&DESCRIBE BODY B\n*P 10 0 2\n#WEIGHT *P 300 -LDIST 2 20\nEND\n&STATUS WEIGHT");
    assert!(errors == 0, "{text}");
    check_near(row(&text, "B (whole)")[2], 10.0, 1e-9);
}

#[test]
fn category_multipliers_act_on_weights_and_compound_with_groups() {
    for (apply, want) in [
        // 300 x 1.05 + 100 x 1.10: the later category wins
        ("&APPLY -PERCENT -CATEGORY @ #DEAD 110 #BUOY 100 -CATEGORY STEEL #DEAD 105 #BUOY 100", 425.0),
        ("&APPLY -FRACTION -CATEGORY STEEL 0.5", 250.0),
        ("&APPLY -FRACTION -CATEGORY STEEL 0.5\n&APPLY -FRACTION -CATEGORY CARGO 2", 500.0),
        ("&APPLY -FRACTION -LOAD_GROUP B 0.5", 200.0),
        // group and category: 0.6 x 0.6 = 0.36
        ("&APPLY -FRACTION -LOAD_GROUP B 0.6 -CATEGORY @ #DEAD 0.6", 144.0),
        ("&APPLY -PERCENT @ 50", 200.0),
        ("&APPLY -PERCENT @ 50\n&APPLY -PERCENT @ 100", 400.0),
    ] {
        let (text, errors) = print_records(&format!("{TWO}{apply}\n&STATUS WEIGHT"));
        assert_eq!(errors, 0, "{apply}: {text}");
        check_near(row(&text, "B (whole)")[1], want, 0.0051);
    }
}

#[test]
fn load_groups_scale_their_loads_alone() {
    let model = |form: &str| {
        format!(
            "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY B\n*P 10 0 10\n#WEIGHT *P 300\n#AREA *P 100 100\n{form}\n\
             #WEIGHT *P 100\n#AREA *P 100 100 -CATEGORY HOUSE\n&DESCRIBE PART B\nEND\n&ENV -WIND 40 180\n"
        )
    };
    let force = |text: &str| row(text, "B WIND")[0];
    for form in ["&DESCRIBE LOAD_GROUP CARGO *P", "&DESCRIBE LOAD GROUP CARGO"] {
        let (text, errors) = print_records(&format!("{}&STATUS LOADS", model(form)));
        assert_eq!(errors, 0, "{text}");
        let both = force(&text);
        let (text, _) = print_records(&format!(
            "{}&APPLY -FRACTION -LOAD_GROUP CARGO 0.5\n&STATUS LOADS\n&STATUS WEIGHT",
            model(form)
        ));
        check_near(force(&text), 0.75 * both, 0.011);
        check_near(row(&text, "B (whole)")[1], 350.0, 0.0051);
        let (text, _) =
            print_records(&format!("{}&APPLY -FRACTION -CATEGORY HOUSE #WIND 0.2\n&STATUS LOADS", model(form)));
        check_near(force(&text), 0.6 * both, 0.011);
    }
    // 1/2 x 1.226 x (40 x 0.514444)^2 x 200 m2 = 51,911 N = 5.294 t
    let (text, _) = print_records(&format!("{}&STATUS LOADS", model("&DESCRIBE LOAD_GROUP CARGO")));
    check_near(force(&text), 5.294, 0.006);
}

#[test]
fn point_buoyancy_equals_displaced_weight() {
    // 50 t of buoyancy over a height of 4 m about z = 0: under a weight of 30 t it sinks to 0.6 of its height, z = 0.2 m above its middle
    let model = "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY B -IGNORE X Y RX RY RZ\n*F 0 0 0\n#BUOY *F 50 3 3 4\n*G 0 0 -1\n\
                 #WEIGHT *G 30 1 1 1\nEND\n";
    let (text, errors) = print_records(&format!("{model}&EQUI\n&STATUS CONFIGURATION"));
    assert_eq!(errors, 0, "{text}");
    check_near(row(&text[text.find("C O N F I G U R A T I O N").unwrap_or(0)..], "B ")[2], -0.4, 0.0051);
    // with 1.2 times the buoyancy: 30/60 of the height
    let (text, _) =
        print_records(&format!("{model}&APPLY -PERCENT -CATEGORY @ #BUOY 120\n&EQUI\n&STATUS CONFIGURATION"));
    check_near(row(&text[text.find("C O N F I G U R A T I O N").unwrap_or(0)..], "B ")[2], 0.0, 0.0051);
}

#[test]
fn tanker_has_forces_of_its_coefficients() {
    let file = "&FILE OPEN C tanker.csv\n&FILE WRITE C 0,-0.9,0,0,-0.04,0,0\n&FILE WRITE C 90,0,-0.7,0.05,0,-0.6,0.02\n\
                &FILE WRITE C 180,0.9,0,0,0.04,0,0\n&FILE CLOSE C\n";
    let model = "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY T\n*MID 0 0 10\n\
                 #TANKER 150 *MID -FILE job.ans/tanker.csv -LBP 270 -DRAFT 16 -WIND_AREAS 1200 3500 -SYMMETRIC\nEND\n";
    // current 1 m/s from +y: FY = 1/2 1025 (-0.6) 270 16, MZ = 1/2 1025 0.02 270^2 16; wind 40 kn from 180: FX = 1/2 1.226 0.9 v^2 1200
    let tonne = 9806.65;
    let (text, errors) = print_records(&format!("{file}{model}&ENV -CURRENT 1 90\n&STATUS LOADS"));
    assert_eq!(errors, 0, "{text}");
    let current = row(&text, "T V_DRAG");
    check_near(current[1], -0.5 * 1025.0 * 0.6 * 270.0 * 16.0 / tonne, 0.006);
    check_near(current[5], 0.5 * 1025.0 * 0.02 * 270.0 * 270.0 * 16.0 / tonne, 0.006);
    let (text, _) = print_records(&format!("{file}{model}&ENV -WIND 40 180\n&STATUS LOADS"));
    let speed: f64 = 40.0 * 1852.0 / 3600.0;
    check_near(row(&text, "T WIND")[0], 0.5 * 1.226 * 0.9 * speed * speed * 1200.0 / tonne, 0.006);
    // without a file: the form of one, and the next solve stops; with one of lacking values an error
    for point in ["", " *MID"] {
        let (text, errors) =
            print_records(&format!("MEDIT\n&DESCRIBE BODY T\n*MID 0 0 10\n#TANKER 150{point}\nEND\n&TYPE read\n&EQUI"));
        assert!(errors == 1 && text.contains("HEADING CXW CYW CNW CXC CYC CNC") && text.contains("read"), "{text}");
        assert!(text.contains("the solve stops: not computed is #TANKER 150 (wind and current on a tanker"), "{text}");
    }
    let (text, errors) =
        print_records("MEDIT\n&DESCRIBE BODY T\n*MID 0 0 10\n#TANKER 150 *MID -FILE a.csv -LBP 9\nEND");
    assert!(errors == 1 && text.contains("#TANKER lacks -DRAFT"), "{text}");
}

#[test]
fn eddy_damping_leaves_the_swing_of_quadratic_damping() {
    // I p' = -K phi + b p^2 from a0 to the other side: (1 - x1) e^x1 = (1 + x0) e^-x0, x = 2 (b/I) a;
    // b = 3/4 rho L d^4 (H0^2 + 1 - OG/d)(H0^2 + (1 - OG/d)^2), the barge of 91.5 x 27.5 m with its centre 5 m above the keel
    let (draft, roll) = (2.32634_f64, 5f64.to_radians());
    let (h0, below) = (27.5 / (2.0 * draft), 1.0 + (5.0 - draft) / draft);
    let b = 0.75 * 1025.0 * 91.5 * draft.powi(4) * (h0 * h0 + below) * (h0 * h0 + below * below);
    let beta = 2.0 * b / (6e6 * 81.0);
    let wanted = (1.0 + beta * roll) * (-beta * roll).exp();
    let mut x = 0.5;
    for _ in 0..50 {
        x -= ((1.0 - x) * f64::exp(x) - wanted) / (-x * f64::exp(x));
    }
    let want = (x / beta).to_degrees();
    for (piece, record) in [("", "#TANAKA 1\n"), ("-TANAKA 1", "")] {
        let (text, errors) = print_records(&format!(
            "&DIMEN -DIMEN METERS M-TONS\n&DEFAULT -WATER 1025 -G 9.80665\n&ENV -DEPTH 100 -TIME 5 0.02\nMEDIT\n\
             &DESCRIBE BODY B -IGNORE X Y Z RY RZ\n*G 0 0 0\n#WEIGHT *G 6000 9 25 25\n\
             PGEN {piece} -CS_WIND 0 0 0 -CS_CURRENT 0 0 0\nPLANE -45.75 45.75 -RECT -5 1.1 27.5\nEND\n{record}END\n\
             &INSTATE -LOCATE B 0 0 2.67366 5\nTDOM\nPRCPOST\nTRAJECTORY B\nREPORT\nEND\nEND"
        ));
        assert_eq!(errors, 0, "{text}");
        let rows =
            text.lines().map(|line| line.split_whitespace().filter_map(|w| w.parse().ok()).collect::<Vec<f64>>());
        let rolls: Vec<f64> = rows.filter(|row| row.len() > 7).filter_map(|row| row.get(5).copied()).collect();
        let least = rolls.iter().copied().fold(0.0, f64::min);
        // the restoring moment is not quite linear
        check_near(least, -want, 0.01 * want + 0.005);
    }
}

#[test]
fn roll_damping_in_per_cent_of_critical_is_that_of_the_closed_form() {
    // a box of 40 x 12 x 4 m, its centre of gravity 0.5 m below the waterline, gyrated by 4 m: BM = 144/(12 x 4) = 3 m, KB = 2 m, KG = 3.5 m, GM = 1.5 m;
    // A = 20 % of the inertia of roll about the centre. B = 2 zeta sqrt((I + A) C); roll alone decays with a log decrement of 2 pi zeta/sqrt(1 - zeta2)
    let mass = 40.0 * 12.0 * 4.0 * 1.025;
    let weight = mass * 9.80665;
    let (inertia, stiffness) = (mass * 16.0 * 1.2, weight * 1.5);
    let damping = 2.0 * 0.04 * f64::sqrt(inertia * stiffness);
    let period = std::f64::consts::TAU * (inertia / stiffness).sqrt();
    let decay = |record: &str| {
        let (text, errors) = print_records(&format!(
            "&DIMEN -DIMEN METERS KN\n&DEFAULT -WATER 1025 -G 9.80665\n&ENV -DEPTH 100 -TIME {} {}\nMEDIT\n\
             &DESCRIBE BODY B -IGNORE X Y Z RY RZ\n*G 0 0 -0.5\n#WEIGHT *G {weight} 4 11 11\n#AMASS *G 0 0 0 {}\n\
             PGEN -CS_WIND 0 0 0 -CS_CURRENT 0 0 0\nPLANE -20 20 -RECT -4 2 12\nEND\n{record}\nEND\n\
             &INSTATE -LOCATE B 0 0 0 1\nTDOM\nPRCPOST\nTRAJECTORY B\nREPORT\nEND\nEND",
            2.0 * period,
            period / 200.0,
            0.2 * weight * 16.0
        ));
        assert_eq!(errors, 0, "{text}");
        let rows =
            text.lines().map(|line| line.split_whitespace().filter_map(|w| w.parse().ok()).collect::<Vec<f64>>());
        rows.filter(|row| row.len() > 7).filter_map(|row| row.get(5).copied()).next_back().unwrap()
    };
    let percent = decay("#ROLL_DAMPING -CRITICAL 4");
    // about the origin the body is held there: I about it is 4 % of a half metre squared more, 0.25/19.2 = 1.3 %, which the period and the decay have
    let about = mass * (16.0 * 1.2 + 0.25);
    let (w, c) = ((stiffness / about).sqrt(), damping / (2.0 * about));
    let damped = (w * w - c * c).sqrt();
    let time = 2.0 * period;
    let exact = (-c * time).exp() * ((damped * time).cos() + c / damped * (damped * time).sin());
    check_near(percent, exact, 0.01);
    let linear = decay(&format!("#ROLL_DAMPING -LINEAR {damping}"));
    check_near(linear, percent, 1e-4);
    assert!(print_records("MEDIT\n&DESCRIBE BODY B\n#ROLL_DAMPING\nEND").0.contains("#ROLL_DAMPING without a value"));
}

#[test]
fn quadratic_roll_damping_leaves_the_swing_of_its_closed_form() {
    // I p' = -K phi + b p2 from a0 to the other side: (1 - x1) e^x1 = (1 + x0) e^-x0, x = 2 (b/I) a
    let (mass, roll) = (40.0 * 12.0 * 4.0 * 1.025, 3f64.to_radians());
    let inertia = mass * 16.0;
    let beta = 4.0;
    let b = 0.5 * beta * inertia;
    let wanted = (1.0 + beta * roll) * (-beta * roll).exp();
    let mut x = 0.2;
    for _ in 0..50 {
        x -= ((1.0 - x) * f64::exp(x) - wanted) / (-x * f64::exp(x));
    }
    let want = (x / beta).to_degrees();
    let weight = mass * 9.80665;
    let (text, errors) = print_records(&format!(
        "&DIMEN -DIMEN METERS KN\n&DEFAULT -WATER 1025 -G 9.80665\n&ENV -DEPTH 100 -TIME 8 0.02\nMEDIT\n\
         &DESCRIBE BODY B -IGNORE X Y Z RY RZ\n*G 0 0 0\n#WEIGHT *G {weight} 4 11 11\n\
         PGEN -CS_WIND 0 0 0 -CS_CURRENT 0 0 0\nPLANE -20 20 -RECT -4 2 12\nEND\n#ROLL_DAMPING -QUADRATIC {b}\nEND\n\
         &INSTATE -LOCATE B 0 0 0 3\nTDOM\nPRCPOST\nTRAJECTORY B\nREPORT\nEND\nEND"
    ));
    assert_eq!(errors, 0, "{text}");
    let rows = text.lines().map(|line| line.split_whitespace().filter_map(|w| w.parse().ok()).collect::<Vec<f64>>());
    let least = rows.filter(|row| row.len() > 7).filter_map(|row| row.get(5).copied()).fold(0.0, f64::min);
    // the restoring moment is not quite linear
    check_near(least, -want, 0.01 * want);
}

#[test]
fn area_and_plate_have_coefficients_in_wind_and_current() {
    // 1/2 x 1.226 x (40 x 0.514444)^2 x 100 m2 = 25,955 N = 2.6467 t of wind on each unit of coefficient
    let records = |load: &str| {
        format!(
            "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY B\n*P 10 0 10\n*A 0 -5 8\n*B 0 5 8\n*C 0 5 18\n*D 0 -5 18\n{load}\nEND\n\
                 &ENV -WIND 40 180 -W_PROFILE POWER 0\n&STATUS LOADS"
        )
    };
    for (load, coefficient) in [
        ("#AREA *P 100", 1.0),
        ("#AREA *P 100 -WIND 1.3 -DRAG 0.4", 1.3),
        ("#AREA *P 100 -DRAG 0.4", 1.0),
        ("#PLATE *A *B *C *D -CD 0.9", 0.9),
        ("#PLATE *A *B *C *D -CD 0.9 -WIND 1.5", 1.5),
        ("#PLATE *A *B *C *D -CD 0.9 -DRAG 1.5", 0.9),
    ] {
        let (text, errors) = print_records(&records(load));
        assert_eq!(errors, 0, "{text}");
        check_near(row(&text, "B WIND")[0], 2.6467 * coefficient, 0.0051);
    }
    // 1/2 x 1025 x 2^2 x 10 m2 x 0.4 = 8,200 N = 0.8362 t under water
    let wet = "&DIMEN -DIMEN METERS M-TONS\n&DEFAULT -WATER 1025\nMEDIT\n&DESCRIBE BODY B\n*P 0 0 -9\n#AREA *P 10 -WIND 9 -DRAG 0.4\nEND\n\
               &ENV -CURRENT 2 180\n&STATUS LOADS";
    check_near(row(&print_records(wet).0, "B V_DRAG")[0], 0.8362, 0.0051);
}

#[test]
fn options_of_areas_and_force_sets_that_are_not_computed_stop_solves() {
    let records = |load: &str, more: &str| {
        format!(
            "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY B -IGNORE X Y RX RY RZ\n*F 0 0 0\n#BUOY *F 50 3 3 4\n#WEIGHT *F 30 1 1 1\n\
                 #AREA *F 10 {load}\nEND\n{more}\n&EQUI"
        )
    };
    for (load, more, named) in [
        ("-MULT_N 2", "", "-MULT_N 2 of #AREA (a multiplier of an area)"),
        ("", "&APPLY -PERCENT -FORCE #CRANE 100", "&APPLY -FORCE #CRANE (a set of forces on points)"),
    ] {
        let (text, errors) = print_records(&records(load, more));
        assert!(errors == 1 && text.contains(named), "{text}");
    }
    for more in ["&APPLY -FORCE #CRANE 1\n&APPLY -FORCE #CRANE 0", "&APPLY -FORCE WIND 0.5"] {
        assert_eq!(print_records(&records("-MULT_N 1", more)).1, 0);
    }
    let (text, errors) = print_records(&records("", "&APPLY -CATEGORY STEAL #DEAD 2"));
    assert!(errors == 0 && text.contains("no load is of category STEAL"), "{text}");
    assert_eq!(print_records(&records("-AMASS 1", "")).1, 0, "statics have no added mass");
}

#[test]
fn instate_takes_body_before_its_options() {
    for form in ["B -CONDITION 9 2 1", "-CONDITION B 9 2 1", "-CONDITION 9 2 1"] {
        let records = format!("MEDIT\n&DESCRIBE BODY A\n&DESCRIBE BODY B\nEND\n&INSTATE {form}\n&STATUS CONFIGURATION");
        let (text, errors) = print_records(&records);
        assert_eq!(errors, 0, "{text}");
        let position = row(&text, "B ");
        assert_eq!([position[2], position[3], position[4]], [-9.0, 2.0, 1.0], "{text}");
    }
    let (text, errors) = print_records(
        "MEDIT\n&DESCRIBE BODY A\n&DESCRIBE BODY B\nEND\n&INSTATE A -LOCATE 1 2 3 -MOVE 1 -MOVE B 5\n&STATUS CONFIGURATION",
    );
    assert_eq!(errors, 0, "{text}");
    assert_eq!(row(&text, "A ")[..3], [2.0, 2.0, 3.0]);
    assert_eq!(row(&text, "B ")[..3], [5.0, 0.0, 0.0]);
}

#[test]
fn margin_multiplies_weights_of_its_categories_beside_their_multiplier() {
    let barge = "MEDIT\n&DESCRIBE BODY B\n*P 0 0 9\n#WEIGHT *P 1000 -CATEGORY STR_MODEL\n#WEIGHT *P 500\nEND\n";
    let weight = |records: &str| crate::common::function_values(&format!("{barge}{records}"), "&BODY(WEIGHT B)")[0];
    for (records, want) in [
        ("&APPLY -MARGIN STR@ 6.0\n&APPLY -PERCENT @ 100\n", 1560.0),
        ("&APPLY -MARGIN STR@ 6.0 EXTRA -10\n", 1060.0 + 450.0),
        ("&APPLY -PERCENT -CATEGORY STR@ #DEAD 105 -MARGIN STR@ 6\n", 1000.0 * 1.05 * 1.06 + 500.0),
        ("&APPLY -MARGIN @ 6\n&APPLY -MARGIN STR@ 3\n", 1530.0),
    ] {
        check_near(weight(records), want, 1e-9 * want);
    }
    let (text, errors) =
        print_records(&format!("{barge}&APPLY -MARGIN STR@\n&APPLY -MARGIN STR@ x\n&APPLY -MARGIN STR@ -101\n"));
    assert!(errors == 3 && text.contains("a load category of -MARGIN lacks its percent"), "{text}");
    assert!(text.contains("expected a multiplier, not x") && text.contains("leaves a negative weight"), "{text}");
}

#[test]
fn computed_weight_says_which_connectors_it_leaves_out() {
    let (text, errors) = print_records(
        "MEDIT\n&DESCRIBE BODY B\n*P 0 0 9\nPGEN\nPLANE 0 180 -RECT 0 14 50\nEND\n~T TUG_BOAT 100\nCONNECTOR T1 -TUG 90 100 ~T *P\nCONNECTOR T2 -TUG 270 100 ~T *P\nEND\n\
         &INSTATE -CONDITION B 7\n&WEIGHT -COMPUTE B 5 32 85 85\n&STATUS WEIGHT",
    );
    // 180 x 50 x 7 ft of sea water, as without them
    assert_eq!(errors, 0, "{text}");
    check_near(row(&text, "B (whole)")[1], 4031.29, 0.05);
    assert!(text.contains("-COMPUTE leaves out 2 connectors of B"), "{text}");
}
