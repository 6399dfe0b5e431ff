//! Class records of [MOSES-FLEX] and [AQWA-CONN] as a user writes them: every option is read and listed back, defaults and
//! worked examples give the numbers of the text.

use crate::common;

use windlass_connectors::CLASSES;
use windlass_language::spec::{Kind, ValueSpec};

/// Runs records; what they print, and the messages.
fn run(records: &str) -> (String, Vec<String>) {
    let (mut session, screen, _folder) = common::session();
    session.job.settings.error_limit = i64::MAX;
    session.open("records", records.to_string());
    session.run();
    session.job.output.flush();
    let text = screen.text();
    (text, session.reports.iter().map(|r| r.message.clone()).collect())
}

fn example_value(value: &ValueSpec, number: usize) -> String {
    match value.kind {
        Kind::Choice(words) => words[0].to_string(),
        Kind::Integer => "3".into(),
        Kind::Name(_) | Kind::Text | Kind::File => "NAME1".into(),
        // growing, so that a P-Y curve is one; small, so that ratios and slopes are in range
        _ => format!("0.{}", number + 1),
    }
}

#[test]
fn every_option_of_every_class_type_is_read_and_listed_back() {
    let curve = "&DATA CONVOLUTION TIME NAME1 0 4 10 2\n";
    for kind in CLASSES {
        let spec = kind.spec;
        for option in spec.options {
            let values: Vec<String> = option.values.iter().enumerate().map(|(i, v)| example_value(v, i)).collect();
            let data: Vec<String> = match spec.name {
                _ if option.name == "-TYPE" => Vec::new(),
                "LMU" if !option.name.ends_with("_PY") => ["60 24 48 X 1 1"].map(String::from).to_vec(),
                "ROD" => ["12 0.5"].map(String::from).to_vec(),
                "SPR" => ["X 1"].map(String::from).to_vec(),
                "FIX" => Vec::new(),
                "FOUNDATION" | "GSPR" if option.name == "-Y_PY" => ["TENSION X 1 1 Y 1 1"].map(String::from).to_vec(),
                "FOUNDATION" | "GSPR" if option.name == "-Z_PY" => ["TENSION X 1 1 Z 1 1"].map(String::from).to_vec(),
                "LMU" if option.name == "-Y_PY" => ["60 24 48 X 1 1 Y 1 1"].map(String::from).to_vec(),
                "LMU" if option.name == "-Z_PY" => ["60 24 48 X 1 1 Z 1 1"].map(String::from).to_vec(),
                "LMU" => ["60 24 48 X 1 1"].map(String::from).to_vec(),
                "FOUNDATION" | "GSPR" => ["TENSION X 1 1"].map(String::from).to_vec(),
                "ROLLER" => ["X 1 1"].map(String::from).to_vec(),
                "FENDER" => ["4 1 0.3"].map(String::from).to_vec(),
                "TETHER" => ["1 0.03"].map(String::from).to_vec(),
                "CATENARY" => ["170 0.02"].map(String::from).to_vec(),
                "LNDW" => ["5000 20 200 0.5"].map(String::from).to_vec(),
                "PULY" => ["5000 20 8"].map(String::from).to_vec(),
                _ => ["4"].map(String::from).to_vec(),
            };
            let mut text = values.join(" ");
            match option.name {
                "-PISTON" => text = "MAX 12 4 1 1 100 10".into(),
                "-TYPE" => text = "CHAIN_R4 4".into(),
                "-C_SN" => text = "WIRE".into(),
                // the dynamic stiffness is larger than the static one, that of the tube
                "-ROPE" => text = "1000000 20 100".into(),
                "-CLUMP" if spec.name == "CATENARY" => text = "100 50".into(),
                "-BUOY" => text = "50 100".into(),
                "-RATIO" => text = "1.2".into(),
                _ => {}
            }
            let needs_length = spec.options.iter().any(|o| o.name == "-LEN") && option.name != "-LEN";
            let length = if needs_length { "-LEN 10" } else { "" };
            let clump = if option.name == "-CLUMP_DRAG" { "-CLUMP 100" } else { "" };
            let record = format!("~C {} {} {length} {clump} {} {text}", spec.name, data.join(" "), option.name);
            let (out, mut messages) = run(&format!("{curve}MEDIT\n{record}\nEND\n&STATUS CL_FLEX\n"));
            // a bare diameter, what has no weight, and what does nothing there is said
            const NOTES: [&str; 6] = [
                "solid steel bar",
                "has no weight",
                "is weightless",
                "does nothing in",
                "-DYNAMICS alone",
                "solves it matters to will stop",
            ];
            messages.retain(|m| !NOTES.iter().any(|note| m.contains(note)));
            assert!(messages.is_empty(), "{record}: {messages:?}");
            let listed = format!("{} {text}", option.name);
            assert!(out.contains(listed.trim()), "`{listed}` is not listed back by\n{out}");
        }
    }
}

#[test]
fn both_small_examples_of_moses_give_submerged_weight_of_ten() {
    for options in ["-WTPLEN 10 -BUOYDIA 0", "-WTPLEN 15 -DISPLEN 5 -BUOYDIA 0"] {
        let (out, _) = run(&format!("MEDIT\n~L B_CAT 4 -LEN 100 {options}\nEND\n&STATUS CL_FLEX"));
        let row = out.lines().find(|l| l.trim_start().starts_with("1 ")).unwrap();
        assert_eq!(row.split_whitespace().nth(4), Some("10.0000"), "{out}");
    }
}

#[test]
fn weight_stiffness_and_break_use_solid_area_and_defaults() {
    // 4 in: A = 12.566 in2; 490.06 lb/ft3 -> 0.04277 kips/ft in air; sea water 63.99 lb/ft3 -> 0.03718 in water;
    // E 29,000 ksi -> 364,425 kips; ultimate 60 ksi -> 753.98 kips [W-DEFAULTS]
    let (out, _) = run("MEDIT\n~L B_CAT 4 -LEN 100\nEND\n&STATUS CL_FLEX");
    let row: Vec<&str> = out.lines().find(|l| l.trim_start().starts_with("1 ")).unwrap().split_whitespace().collect();
    assert_eq!(&row[1..7], ["4.000", "100.00", "0.0428", "0.0372", "3.6442E+05", "753.98"], "{out}");
}

#[test]
fn sling_has_stiffness_ae_over_l_and_takes_only_emodulus() {
    let (out, _) = run("MEDIT\n~S SLING 4 -LEN 120 -EMOD 12000\nEND\n&STATUS CL_FLEX");
    // 12,000 ksi x 12.566 in2 / 120 ft
    assert!(out.contains("Stiffness AE/L                   = 1256.6371 kips/ft"), "{out}");
    let (_, messages) = run("MEDIT\n~S DAVIT 4 -LEN 120 -B_TENSION 5");
    assert!(messages[0].contains("unknown option of DAVIT"));
}

#[test]
fn lmu_is_symmetric_by_default_with_moses_cone_tangent() {
    let (out, _) = run("MEDIT\n~L LMU 60 24 48 X 1 1\nEND\n&STATUS CL_FLEX");
    // (48 - 24) / (2 60)
    assert!(out.contains("Cone Tangent T                   = 0.2000"));
    assert!(out.contains("Symmetric about X                = YES"));
    let (out, _) = run("MEDIT\n~L GSPR TENSION X 1 1\nEND\n&STATUS CL_FLEX");
    assert!(out.contains("Symmetric about X                = NO"));
}

#[test]
fn repeated_name_adds_line_segment_and_replaces_spring() {
    let (out, _) =
        run("MEDIT\n~L B_CAT 4 -LEN 100\n~L B_CAT 3 -LEN 50\n~S GSPR X 1 1\n~S GSPR Y 2 2\nEND\n&STATUS CL_FLEX");
    assert!(
        out.contains("record 2: B_CAT 3") && !out.contains("record 2: GSPR") && out.contains("GSPR , Y 2 2"),
        "{out}"
    );
}

#[test]
fn b_cat_connects_to_ground_only_and_slings_take_one_point() {
    let model = "MEDIT\n&DESCRIBE BODY A\n*P 0 0 0\n&DESCRIBE BODY B\n*Q 9 0 0\n~L B_CAT 4 -LEN 100\n~H H_CAT 4 -LEN 10\n\
                 ~S SLING 4 -LEN 9\nCONNECTOR ONE ~L *P *Q\nCONNECTOR TWO ~H *P *Q\nCONNECTOR SL ~S *P *Q\nEND";
    let (_, mut messages) = run(model);
    messages.retain(|m| !m.contains("solid steel bar"));
    assert_eq!(messages.len(), 2, "{messages:?}");
    assert!(messages[0].contains("connects a body to ground") && messages[1].contains("takes 1 point"));
}

#[test]
fn script_prints_independent_four_segment_line_values() {
    let script = std::fs::read_to_string("scripts/four_segment_line.cif").unwrap();
    let table = script.replace("REPORT\n", "VIEW X Force 'Ten Top' 'V. Pull' 'Crit. Seg'\n");
    let (out, messages) = run(&table);
    assert!(messages.is_empty(), "{messages:?}");
    // rows of the reference count from 0, VIEW's from 1; X within 0.1 ft, forces within 0.1 kips as given there
    for (row, x, top, pull, segment) in [
        (2, 5681.9, 17.2, 0.0, 2),
        (16, 7536.6, 341.5, 0.0, 2),
        (23, 7767.3, 692.7, 0.0, 2),
        (30, 8021.1, 1142.3, 77.1, 3),
    ] {
        let line = out.lines().find(|l| l.starts_with(&format!("{row:>5} "))).unwrap();
        let numbers: Vec<f64> = line.split_whitespace().map(|w| w.parse().unwrap()).collect();
        assert!(
            (numbers[1] - x).abs() < 0.1 && (numbers[3] - top).abs() < 0.1 && (numbers[4] - pull).abs() < 0.1,
            "{line}"
        );
        assert_eq!(numbers[5], f64::from(segment), "{line}");
    }
}
