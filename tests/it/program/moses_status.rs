//! Reports of `&STATUS` that scripts of MOSES ask for, against closed forms: a mooring spread, the shape of lines, series over time.

use crate::common::{function_values, print_metric_records, run_script};

/// A body shifted by (3, 4), on two lines of 1 kN/m in water to 50 m below their fairleads.
const SPREAD: &str = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY B\n*A 10 0 0\n*Z 0 10 0\n~W B_CAT 76 EXACT -LEN 600 -DEP 50 -WTPLEN 1 -BUOY 0\n\
                      CONNECTOR L1 -ANC 30 580 ~W *A\nCONNECTOR L2 -ANC 200 570 ~W *Z\nEND\n&INSTATE -LOCATE B 3 4 0\n";

/// The numbers of the row of a table that begins with a word.
fn row(text: &str, begins: &str) -> Vec<f64> {
    let found = text.lines().find(|line| line.split_whitespace().next() == Some(begins));
    let found = found.unwrap_or_else(|| panic!("{begins} in {text}"));
    found.split_whitespace().filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn spread_has_direction_distance_and_weight_below_each_fairlead() {
    let (text, said) = run_script(&format!("{SPREAD}&STATUS SPREAD\n"));
    assert!(said.is_empty(), "{said:?}");
    for (name, fairlead, was, degrees, distance) in
        [("L1", [13.0, 4.0], [10.0, 0.0], 30.0f64, 580.0), ("L2", [3.0, 14.0], [0.0, 10.0], 200.0, 570.0)]
    {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let [x, y] = [was[0] + distance * cos - fairlead[0], was[1] + distance * sin - fairlead[1]];
        let [direction, level, first, top, horizontal, _, grounded] = row(&text, name)[..] else { panic!("{text}") };
        assert!((direction - y.atan2(x).to_degrees().rem_euclid(360.0)).abs() < 0.0051, "{name}: {direction}");
        assert!((level - x.hypot(y)).abs() < 0.0051 && first == 600.0, "{name}: {level}");
        // T = H + w h of a line that touches down; stretch changes it by less than T^2/(2 EA)
        assert!((top - horizontal - 50.0).abs() < 0.02, "{name}: {top} {horizontal}");
        // what hangs is sqrt(h^2 + 2 h H/w)
        let hanging = (50.0f64 * 50.0 + 2.0 * 50.0 * horizontal).sqrt();
        assert!((grounded - (600.0 - hanging)).abs() < 0.05, "{name}: {grounded}");
    }
}

#[test]
fn shape_of_line_is_catenary_from_its_touchdown() {
    let values = |column: &str| {
        let script = format!("{SPREAD}&STATUS DG_CONNECTOR L1 -PLOT\nSET_VARIABLE V {column}\nEND\n");
        function_values(&script, "%V")
    };
    let (xs, zs) = (values("X"), values("Z"));
    let (text, _) = run_script(&format!("{SPREAD}&STATUS SPREAD L1\n"));
    let horizontal = row(&text, "L1")[4];
    // z = a (cosh(s/a) - 1) above the bottom at a distance s from the touchdown, which lies a acosh(1 + h/a) from the fairlead
    let reach = horizontal * (1.0 + 50.0 / horizontal).acosh();
    let mut hanging = 0;
    for (x, z) in xs.iter().zip(&zs).filter(|(x, _)| **x < reach - 0.1) {
        let want = horizontal * (((reach - x) / horizontal).cosh() - 1.0) - 50.0;
        assert!((z - want).abs() < 0.03, "{x}: {z} is not {want}");
        hanging += 1;
    }
    assert!(hanging > 20 && zs.last() == Some(&-50.0), "{hanging}");
}

#[test]
fn wave_elevation_over_time_is_cosine_of_regular_wave() {
    // 2 m high, 8 s long, its crest at X = Y = 0 at 0 s; a ramp of 4 s multiplies by (1 - cos(pi t/T))/2
    for ramp in [0.0, 4.0] {
        let script = format!(
            "&DIMEN -DIMEN METERS K-NTS\n&ENV -SEA REGULAR 180 2 8 -TIME 12 0.5 -RAMP {ramp} -DEPTH 100\n&STATUS SEA_TSERIES -PLOT\nSET_VARIABLE V 2\nEND\n"
        );
        let values = function_values(&script, "%V");
        assert_eq!(values.len(), 25);
        for (n, got) in values.iter().enumerate() {
            let time = 0.5 * n as f64;
            let grown = if time < ramp { 0.5 * (1.0 - (std::f64::consts::PI * time / ramp).cos()) } else { 1.0 };
            let want = grown * (std::f64::consts::TAU * time / 8.0).cos();
            assert!((got - want).abs() < 1e-9, "{time}: {got} is not {want}");
        }
    }
}

#[test]
fn wind_over_time_follows_its_history() {
    // from 10 to 30 knots in 20 s, then at rest there
    let script = "&DIMEN -DIMEN METERS K-NTS\n&DATA CURVES W_HISTORY BLOW 0 10 20 30\n\
                  &ENV -WIND 15 0 -W_HISTORY BLOW -TIME 30 5 -RAMP 0\n&STATUS WIND_TSERIES -PLOT\nSET_VARIABLE V 2\nEND\n";
    let values = function_values(script, "%V");
    let want = [10.0, 15.0, 20.0, 25.0, 30.0, 30.0, 30.0];
    assert!(values.iter().zip(want).all(|(got, want)| (got - want).abs() < 1e-9) && values.len() == 7, "{values:?}");
}

#[test]
fn displacement_is_that_of_a_box_by_hand() {
    let (text, errors) = print_metric_records(
        "MEDIT\n&DESCRIBE BODY B\nPGEN\nPLANE 0 91.5 -RECT 0 6.10 27.50\nEND\nEND\n&INSTATE -CONDITION B 2\n&STATUS DISPLACEMENT",
    );
    // 91.5 x 27.5 x 2 m of 1.025 t/m3
    assert_eq!(errors, 0, "{text}");
    assert!((crate::common::fact(&text, "Displacement") - 5158.3125).abs() < 0.0051, "{text}");
}

#[test]
fn plot_of_report_without_curve_and_times_without_window_are_refused() {
    let (_, said) = run_script("&STATUS POINTS -PLOT\nREPORT\nEND\n&STATUS SEA_TSERIES\n&STATUS DG_CONNECTOR\n");
    assert_eq!(said.len(), 3, "{said:?}");
    assert!(said[0].contains("POINTS has nothing to plot"), "{said:?}");
    assert!(said[1].contains("the environment has no time"), "{said:?}");
    assert!(said[2].contains("no such active mooring line"), "{said:?}");
}
