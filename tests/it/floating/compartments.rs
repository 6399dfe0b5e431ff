//! Compartments: closed forms of a box barge with tanks.

use crate::common::{fact, function_values, print_metric_records};

/// The row of the last table that begins with a word, as its words.
fn row<'t>(text: &'t str, begins: &str) -> Vec<&'t str> {
    let found = text.lines().rfind(|line| line.split_whitespace().next() == Some(begins));
    found.unwrap_or_else(|| panic!("{begins} in {text}")).split_whitespace().collect()
}

/// The numbers of such a row.
fn numbers(text: &str, begins: &str) -> Vec<f64> {
    row(text, begins).into_iter().filter_map(|word| word.parse().ok()).collect()
}

fn check_near(got: f64, want: f64, by: f64) {
    assert!((got - want).abs() <= by, "{got} is not {want}");
}

/// The tutorial barge of 6000 t, 91.5 x 27.5 x 6.1 m, with a tank of 30 x 20 x 4 m amidships, its floor at 1 m.
const BARGE: &str = "MEDIT\n&DESCRIBE BODY B -IGNORE X Y RZ\nPGEN\nPLANE 0 91.5 -RECT 0 6.10 27.50\nEND\n\
    &DESCRIBE COMPARTMENT T -DESCRIPTION 'middle tank'\nPGEN\nPLANE 30.75 60.75 -RECT 1 5 20\nEND\nEND\n\
    &WEIGHT -TOTAL B 6000 45.75 0 5 9 25 25\n&INSTATE -CONDITION B 2.5\n";

#[test]
fn contents_weigh_and_their_surface_takes_metacentric_height() {
    // 50 % of 2400 m3 at 1.025: 1230 t at z = 2; W = 7230 t, d = W/(rho L B) = 2.80328, KG = (6000*5 + 1230*2)/7230,
    // GM = d/2 + B^2/(12 d) - KG, loss rho l b^3/(12 W)
    let (text, errors) = print_metric_records(&format!(
        "{BARGE}&COMPARTMENT -PERCENT T 50 1.025\n&EQUI\n&STATUS HYDROSTATICS\n&STATUS COMPARTMENT"
    ));
    assert_eq!(errors, 0, "{text}");
    let weight = 7230.0;
    let draft = weight / (1.025 * 91.5 * 27.5);
    let gm = 0.5 * draft + 27.5 * 27.5 / (12.0 * draft) - (6000.0 * 5.0 + 1230.0 * 2.0) / weight;
    let loss = 1.025 * 30.0 * 20f64.powi(3) / (12.0 * weight);
    check_near(fact(&text, "Displacement"), weight, 0.0051);
    check_near(fact(&text, "KG"), 4.48963, 0.0051);
    check_near(fact(&text, "GM Transverse"), gm, 0.0051);
    check_near(fact(&text, "Free Surface Transverse"), loss, 0.0051);
    check_near(fact(&text, "Free Surface Longitudinal"), 1.025 * 20.0 * 27000.0 / (12.0 * weight), 0.0051);
    check_near(fact(&text, "Corrected GM Transverse"), gm - loss, 0.0051);
    // the stiffness in roll is that of the corrected height, to six digits
    let found: f64 = row(&text, "RX")[4].parse().unwrap();
    check_near(found, weight * (gm - loss), 1e-5 * found);
    let [percent, sounding, amount, gravity, x, y, z, transverse, longitudinal] = numbers(&text, "T")[..] else {
        panic!("{text}")
    };
    for (got, want) in [
        (percent, 50.0),
        (sounding, 2.0),
        (amount, 1230.0),
        (gravity, 1.025),
        (x, 45.75),
        (y, 0.0),
        (z, 2.0),
        (transverse, 20000.0),
        (longitudinal, 45000.0),
    ] {
        check_near(got, want, 0.0051);
    }
}

#[test]
fn righting_arm_with_tank_equals_two_wall_sided_forms() {
    let (text, errors) = print_metric_records(&format!(
        "{BARGE}&COMPARTMENT -CORRECT -PERCENT T 50 1.025\n&EQUI\nHSTATICS B\nRARM 5 2\nREPORT\nEND\nEND"
    ));
    assert_eq!(errors, 0, "{text}");
    let weight = 7230.0;
    let draft = weight / (1.025 * 91.5 * 27.5);
    let bm = 27.5 * 27.5 / (12.0 * draft);
    let gm = 0.5 * draft + bm - (6000.0 * 5.0 + 1230.0 * 2.0) / weight;
    let loss = 1.025 * 30.0 * 20f64.powi(3) / (12.0 * weight);
    for (roll, begins) in [(5.0_f64, "5.00"), (10.0, "10.00")] {
        let a = roll.to_radians();
        let want = a.sin() * (gm - loss + 0.5 * (bm - loss) * a.tan().powi(2));
        // roll, draft, trim, arm
        check_near(numbers(&text, begins)[3], want, 6e-5);
    }
}

#[test]
fn contents_without_a_free_surface_keep_the_metacentric_height() {
    for records in
        ["&COMPARTMENT -APP_NONE -PERCENT T 50 1.025", "&COMPARTMENT -PERCENT T 50 1.025\n&COMPARTMENT -APP_NONE T"]
    {
        let (text, errors) = print_metric_records(&format!("{BARGE}{records}\n&EQUI\n&STATUS HYDROSTATICS"));
        assert_eq!(errors, 0, "{text}");
        let found: f64 = row(&text, "RX")[4].parse().unwrap();
        check_near(found, 7230.0 * fact(&text, "GM Transverse"), 7230.0 * 0.0051);
        assert!(!text.contains("Free Surface Transverse"), "{text}");
    }
    // full: no surface either
    let (text, _) = print_metric_records(&format!("{BARGE}&COMPARTMENT -FULL T\n&EQUI\n&STATUS HYDROSTATICS"));
    check_near(fact(&text, "Displacement"), 6000.0 + 2400.0 * 1.025, 0.0051);
    assert!(!text.contains("Free Surface Transverse"), "{text}");
}

#[test]
fn amounts_in_every_form_fill_alike() {
    for form in [
        "-PERCENT T 50 1.025",
        "-FRACTION T 0.5 1.025",
        "-AMOUNT T 1230 1.025",
        "-SOUNDING T 2 1.025",
        "-ULLAGE T 2 1.025",
        "-PERCENT @ 0 T 50 1.025",
    ] {
        let (text, errors) = print_metric_records(&format!("{BARGE}&COMPARTMENT {form}\n&STATUS COMPARTMENT"));
        assert_eq!(errors, 0, "{form}: {text}");
        check_near(numbers(&text, "T")[2], 1230.0, 0.0051);
    }
    // liquid fills 98 % of the space, at its own density
    let model = BARGE.replace("\nPGEN\nPLANE 30.75", "\nPGEN -PERM -0.98\nPLANE 30.75");
    let (text, _) = print_metric_records(&format!("{model}&COMPARTMENT -PERCENT T 50 0.87\n&STATUS COMPARTMENT"));
    check_near(numbers(&text, "T")[2], 0.98 * 1200.0 * 0.87, 0.0051);
}

#[test]
fn flooded_compartment_loses_its_buoyancy() {
    // open over 30 of 91.5 m and the whole breadth: d = W/(rho B (L - mu 30))
    for share in [1.0, 0.95] {
        let model = BARGE.replace(
            "PGEN\nPLANE 30.75 60.75 -RECT 1 5 20",
            &format!("PGEN -PERM -{share}\nPLANE 30.75 60.75 -RECT 0 6.1 27.5"),
        );
        let (text, errors) =
            print_metric_records(&format!("{model}&COMPARTMENT -FLOOD T\n&EQUI\n&STATUS CONFIGURATION"));
        assert_eq!(errors, 0, "{text}");
        let draft = 6000.0 / (1.025 * 27.5 * (91.5 - share * 30.0));
        check_near(numbers(&text, "B")[2], -draft, 0.0051);
        // closed again it has what it had before: nothing
        let (text, _) = print_metric_records(&format!(
            "{model}&COMPARTMENT -FLOOD T\n&COMPARTMENT -NO_FLOOD T\n&EQUI\n&STATUS CONFIGURATION"
        ));
        check_near(numbers(&text, "B")[2], -2.32634, 0.0051);
    }
}

#[test]
fn residual_water_stays_and_has_no_surface() {
    let model = BARGE.replace("-DESCRIPTION 'middle tank'", "-MINIMUM 10 1.025");
    let (text, errors) = print_metric_records(&format!(
        "{model}&COMPARTMENT -PERCENT T 5\n&EQUI\n&STATUS COMPARTMENT\n&STATUS HYDROSTATICS"
    ));
    assert!(errors == 0 && text.contains("its -MINIMUM"), "{text}");
    check_near(fact(&text, "Displacement"), 6000.0 + 246.0, 0.0051);
    assert!(!text.contains("Free Surface Transverse"), "{text}");
}

/// Wing tanks of 30 x 10 x 5 m, two to port, two to starboard.
const WINGS: &str = "MEDIT\n&DESCRIBE BODY B -IGNORE X Y RZ\nPGEN\nPLANE 0 91.5 -RECT 0 6.10 27.50\nEND\n\
    &DESCRIBE COMPARTMENT FS\nPGEN -STBD\nPLANE 5 35 -CART 3 0.5 13 0.5 13 5.5 3 5.5\nEND\n\
    &DESCRIBE COMPARTMENT FP\nPGEN -PORT\nPLANE 5 35 -CART 3 0.5 13 0.5 13 5.5 3 5.5\nEND\n\
    &DESCRIBE COMPARTMENT AS\nPGEN -STBD\nPLANE 55 85 -CART 3 0.5 13 0.5 13 5.5 3 5.5\nEND\n\
    &DESCRIBE COMPARTMENT AP\nPGEN -PORT\nPLANE 55 85 -CART 3 0.5 13 0.5 13 5.5 3 5.5\nEND\nEND\n";

#[test]
fn ballast_balances_body_at_its_position() {
    // upright at 3 m: W = 1.025*91.5*27.5*3 = 7737.468 t; of it 6000 t at (47, 0.5): 1737.468 t of ballast, whose moments are
    // about x = 0: 7737.468*45.75 - 6000*47, about y = 0: -6000*0.5; by symmetry of the four arms the shares differ by these alone
    let (text, errors) = print_metric_records(&format!(
        "{WINGS}&WEIGHT -TOTAL B 6000 47 0.5 5 9 25 25\n&INSTATE -CONDITION B 3\n&CMP_BAL B @\n&STATUS COMPARTMENT\n&EQUI\n&STATUS CONFIGURATION"
    ));
    assert_eq!(errors, 0, "{text}");
    let whole = 1.025 * 91.5 * 27.5 * 3.0 - 6000.0;
    let (along, across) = ((whole + 6000.0) * 45.75 - 6000.0 * 47.0, -6000.0 * 0.5);
    let mean = 0.25 * whole;
    // arms x 20 and 70, y 8: sum w = whole, sum w x = along, sum w y = across, the fourth pattern zero
    let (aft, starboard) = ((along - 45.0 * whole) / (4.0 * 25.0), across / (4.0 * 8.0));
    for (name, want) in [
        ("FS", mean - aft + starboard),
        ("FP", mean - aft - starboard),
        ("AS", mean + aft + starboard),
        ("AP", mean + aft - starboard),
    ] {
        check_near(numbers(&text, name)[2], want, 0.0051);
    }
    // nothing moves it
    let position = numbers(&text, "B");
    check_near(position[2], -3.0, 0.0051);
    check_near(position[3], 0.0, 0.0051);
    check_near(position[4], 0.0, 0.0051);
}

#[test]
fn ballast_of_a_trimmed_and_heeled_body_leaves_it_at_rest() {
    let (text, errors) = print_metric_records(&format!(
        "{WINGS}&WEIGHT -TOTAL B 6000 45 0 5 9 25 25\n&INSTATE -CONDITION B 3 2 0.4\n&CMP_BAL B @\n&EQUI\n&STATUS CONFIGURATION"
    ));
    assert_eq!(errors, 0, "{text}");
    let position = numbers(&text, "B");
    for (got, want) in position[2..5].iter().zip([-3.0, 2.0, 0.4]) {
        check_near(*got, want, 0.0051);
    }
}

#[test]
fn impossible_ballast_is_refused_without_change() {
    for condition in ["2", "6", "3 30"] {
        let (text, errors) = print_metric_records(&format!(
            "{WINGS}&WEIGHT -TOTAL B 6000 47 0.5 5 9 25 25\n&INSTATE -CONDITION B {condition}\n&CMP_BAL B @\n&STATUS COMPARTMENT"
        ));
        assert!(errors == 1 && text.contains("no solution to the ballasting problem"), "{condition}: {text}");
        check_near(numbers(&text, "FS")[2], 0.0, 1e-9);
    }
    let (text, errors) = print_metric_records(&format!("{WINGS}&CMP_BAL B FS AP"));
    assert!(errors == 1 && text.contains("2 compartments cannot balance"), "{text}");
}

#[test]
fn contents_count_in_the_mass_of_modes_and_runs() {
    // heave: sqrt(rho g A / (W/g)) with W = 7230 t, A = 91.5 x 27.5 m2
    let (text, errors) =
        print_metric_records(&format!("{BARGE}&COMPARTMENT -PERCENT T 50 1.025\n&EQUI\n&STATUS MODES"));
    assert_eq!(errors, 0, "{text}");
    let frequency = (9.80665_f64 * 1.025 * 91.5 * 27.5 / 7230.0).sqrt();
    let period = std::f64::consts::TAU / frequency;
    assert!(
        text.contains(&format!("{frequency:.4}")) || text.contains(&format!("{period:.2}")),
        "{frequency} {period}: {text}"
    );
    let (text, errors) = print_metric_records(&format!(
        "{BARGE}&ENV -TIME 3 0.1\n&COMPARTMENT -PERCENT T 50 1.025\n&EQUI\nTDOM\nPRCPOST\nTRAJECTORY B\nREPORT\nEND\nEND"
    ));
    assert_eq!(errors, 0, "{text}");
    let draft = 7230.0 / (1.025 * 91.5 * 27.5);
    assert!(text.contains(&format!("{:.2}", -draft)), "{draft}: {text}");
}

#[test]
fn capacity_of_box_tank_grows_with_its_sounding() {
    let (text, errors) = print_metric_records(&format!(
        "{BARGE}HSTATICS B\nTANK_CAPACITY T 1\nREPORT\nEND\nTANK_CAPACITY T 2 -ROLL 10\nREPORT\nEND\nEND"
    ));
    assert_eq!(errors, 0, "{text}");
    let first = text.lines().find(|line| line.split_whitespace().next() == Some("3.00")).unwrap();
    let found: Vec<f64> = first.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    for (got, want) in found.iter().zip([3.0, 75.0, 1800.0, 1845.0, 45.75, 0.0, 2.5, 20000.0, 45000.0]) {
        check_near(*got, want, 0.0051);
    }
    // rolled by 10 degrees, half way up its middle: half of it, its centre shifted by 400 tan/(24)
    let rolled = numbers(&text, "2.00");
    check_near(rolled[2], 1200.0, 0.0051);
    check_near(rolled[5], -400.0 * 10f64.to_radians().tan() / 24.0, 0.0051);
}

#[test]
fn heights_of_holes_are_reported() {
    let (text, errors) = print_metric_records(&format!(
        "{BARGE}MEDIT\n&DESCRIBE BODY B\n*V 45 10 6.1\n&DESCRIBE HOLE H VENT -POINT *V -AREA 0.2\n&DESCRIBE COMPARTMENT T -HOLES H\nEND\n\
         &INSTATE -CONDITION B 2.5\n&STATUS V_HOLES"
    ));
    assert_eq!(errors, 0, "{text}");
    check_near(*numbers(&text, "H").last().unwrap(), 3.6, 0.0051);
}

#[test]
fn ballast_stays_within_minimum_and_maximum() {
    // pairs of equal tanks fore, amidships and aft; 3 m of draft less 6000 t are 50 % of all six: amidships at most 20 %, so 65 % of the others
    let tank = |name: &str, x: f64, side: &str| {
        format!(
            "&DESCRIBE COMPARTMENT {name}\nPGEN -{side}\nPLANE {} {} -CART 1 1 13 1 13 6 1 6\nEND\n",
            x - 5.0,
            x + 5.0
        )
    };
    let tanks: String = [("1", 15.0), ("2", 45.75), ("3", 76.5)]
        .iter()
        .flat_map(|(n, x)| [tank(&format!("{n}P"), *x, "PORT"), tank(&format!("{n}S"), *x, "STBD")])
        .collect();
    let all = 1.025 * 6.0 * 10.0 * 12.0 * 5.0;
    let draft = (6000.0 + 0.5 * all) / (1.025 * 91.5 * 27.5);
    let barge = format!(
        "MEDIT\n&DESCRIBE BODY B\nPGEN\nPLANE 0 91.5 -RECT 0 6.10 27.50\nEND\n{tanks}END\n&WEIGHT -TOTAL B 6000 45.75 0 5 9 25 25\n\
         &INSTATE -CONDITION B {draft}\n"
    );
    let percent = |limits: &str, name: &str| {
        let script = format!(
            "&DIMEN -DIMEN METERS M-TONS\n{barge}{limits}&CMP_BAL B @\n&SET P = &COMPARTMENT({name} -PERCENT)\n"
        );
        function_values(&script, "&TOKEN(2 %P)")[0]
    };
    for (limits, middle, others) in [
        ("", 50.0, 50.0),
        ("&COMPARTMENT -MAXIMUM 2@ 20\n", 20.0, 65.0),
        ("MEDIT\n&DESCRIBE COMPARTMENT 2P -MINIMUM 70\n&DESCRIBE COMPARTMENT 2S -MINIMUM 70\nEND\n", 70.0, 40.0),
    ] {
        for (name, want) in [("2P", middle), ("2S", middle), ("1P", others), ("3S", others)] {
            check_near(percent(limits, name), want, 1e-4);
        }
    }
    // -FULL stops there, and more is refused
    let full = format!(
        "&DIMEN -DIMEN METERS M-TONS\n{barge}&COMPARTMENT -MAXIMUM 1P 95\n&COMPARTMENT -FULL 1P\n&SET P = &COMPARTMENT(1P -PERCENT)\n"
    );
    check_near(function_values(&full, "&TOKEN(2 %P)")[0], 95.0, 1e-9);
    let (text, errors) =
        print_metric_records(&format!("{barge}&COMPARTMENT -MAXIMUM 1P 95\n&COMPARTMENT -PERCENT 1P 96"));
    assert!(errors == 1 && text.contains("96 % of compartment 1P is more than its -MAXIMUM of 95 %"), "{text}");
}

/// A polygon of a cross-section below a height: area and height of its centroid.
fn below(corners: &[[f64; 2]], height: f64) -> [f64; 2] {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        if a[1] <= height {
            kept.push(*a);
        }
        if (a[1] <= height) != (b[1] <= height) {
            let share = (height - a[1]) / (b[1] - a[1]);
            kept.push([a[0] + share * (b[0] - a[0]), height]);
        }
    }
    let (mut area, mut moment) = (0.0, 0.0);
    for (a, b) in kept.iter().zip(kept.iter().cycle().skip(1)) {
        let cross = a[0] * b[1] - b[0] * a[1];
        area += 0.5 * cross;
        moment += cross * (a[1] + b[1]) / 6.0;
    }
    [area, moment / area]
}

/// The same of the part of so large an area, found by bisection: the height of its surface and that of its centroid.
fn filled(corners: &[[f64; 2]], area: f64) -> [f64; 2] {
    let (mut low, mut high) = (-100.0, 100.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if below(corners, middle)[0] < area { low = middle } else { high = middle }
    }
    [high, below(corners, high)[1]]
}

#[test]
fn work_of_heeling_barge_with_slack_tanks_is_its_potential_energy() {
    // to 40 degrees: the deck goes under, the bilge comes out, and the liquid meets roof and floor of both tanks. The energy of the barge at a heel,
    // over its weight: heights of the weight and of both liquids above the waterline less that of the centre of buoyancy, of cut polygons
    let (length, dry, kg) = (91.5, 6000.0, 5.0);
    let rectangle = |y: [f64; 2], z: [f64; 2]| [[y[0], z[0]], [y[1], z[0]], [y[1], z[1]], [y[0], z[1]]];
    let hull = rectangle([-13.75, 13.75], [0.0, 6.1]);
    let (span, tanks) =
        (30.0, [(rectangle([2.0, 12.0], [1.0, 5.0]), 0.6), (rectangle([-12.0, -2.0], [1.0, 5.0]), 0.6)]);
    let liquid = 1.025 * span * 40.0 * 0.6;
    let weight = dry + 2.0 * liquid;
    let energy = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let turned = |list: &[[f64; 2]; 4]| list.map(|[y, z]| [y * cos - z * sin, y * sin + z * cos]);
        let [waterline, buoyancy] = filled(&turned(&hull), weight / (1.025 * length));
        let contents: f64 =
            tanks.iter().map(|(tank, share)| liquid * (filled(&turned(tank), 40.0 * share)[1] - waterline)).sum();
        (dry * (kg * cos - waterline) + contents) / weight - (buoyancy - waterline)
    };
    let script = "&DIMEN -DIMEN METERS M-TONS\n&DEFAULT -WATER 1025 -G 9.80665\nMEDIT\n&DESCRIBE BODY B\nPGEN\nPLANE 0 91.5 -RECT 0 6.10 27.50\nEND\n\
                  &DESCRIBE COMPARTMENT TS\nPGEN -STBD\nPLANE 30.75 60.75 -CART 2 1 12 1 12 5 2 5\nEND\n\
                  &DESCRIBE COMPARTMENT TP\nPGEN -PORT\nPLANE 30.75 60.75 -CART 2 1 12 1 12 5 2 5\nEND\nEND\n\
                  &WEIGHT -TOTAL B 6000 45.75 0 5 9 25 25\n&COMPARTMENT -PERCENT @ 60 1.025\n&INSTATE -CONDITION B 2.9\n\
                  HSTATICS B\nRARM 0.5 80 -TOLERANCE 1E-9 1E-9 1E-9\nSET_VARIABLE V Arm\nEND\nEND\n";
    let arms = function_values(script, "%V");
    assert_eq!(arms.len(), 81);
    // Simpson's rule on steps of half a degree
    let mut work = 0.0;
    for (n, three) in arms.windows(3).enumerate().step_by(2) {
        let [a, b, c] = three else { continue };
        work += 0.5f64.to_radians() * (a + 4.0 * b + c) / 3.0;
        let want = energy(0.5 * (n + 2) as f64) - energy(0.0);
        assert!((work - want).abs() < 2e-6, "{} degrees: {work} is not {want}", 0.5 * (n + 2) as f64);
    }
}
