//! The mooring that is also run in MoorPy and MAP++: eight chains of 900 m in 300 m of water; and how a pass over it is reported.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::fmt::Write;
use windlass_model::Model;

use super::measured::model_from_records;

/// A body SHIP on eight chains around: anchors at 830 m in 300 m of water, fairleads at 30 m and 10 m down, 199 kg/m of 0.18 m in sea
/// water. `hull` are records of the body, `line` makes the records of ~CHAIN of its options, `then` stand behind all.
pub fn model(hull: &str, line: &dyn Fn(&str) -> String, then: &str) -> Model {
    let mut records = format!("&DIMEN -DIMEN METERS N\n&ENV -DEPTH 300\nMEDIT\n&DESCRIBE BODY SHIP\n{hull}");
    for line in 0..8 {
        let (sin, cos) = (22.5 + 45.0 * f64::from(line)).to_radians().sin_cos();
        writeln!(records, "*F{line} {} {} -10", 30.0 * cos, 30.0 * sin).unwrap();
    }
    // E of a full section of 180 mm with EA = 8.54e8 N, in MPa as records have it
    let section = std::f64::consts::FRAC_PI_4 * 0.18 * 0.18;
    let modulus = 8.54e8 / section / 1e6;
    let weight = (199.0 - 1025.0 * section) * 9.80665;
    records.push_str(&line(&format!("-BUOY 0 -WTPL {weight} -EMOD {modulus}")));
    for line in 0..8 {
        let angle = 22.5 + 45.0 * f64::from(line);
        writeln!(records, "CONNECTOR L{line} -ANC {angle} 800 ~CHAIN *F{line}").unwrap();
    }
    records.push_str("END\n");
    records.push_str(then);
    model_from_records(&records)
}
