//! A line of the class ROD at rest by friction on a bottom that slopes.

use crate::common;

/// Lines of a body that is held, of classes ~C and ~B with their anchors toward X and Y, in an environment: warnings that friction of ~C
/// is left out, and the horizontal force and the tension at the fairlead (N) of the lines of those classes.
fn solve_held_body(environment: &str, classes: &[String]) -> (usize, Vec<[f64; 2]>) {
    held_at(environment, classes, 400.0)
}

/// The same with their anchors at a distance (m).
fn held_at(environment: &str, classes: &[String], distance: f64) -> (usize, Vec<[f64; 2]>) {
    let (mut session, screen, _folder) = common::session();
    let names: Vec<_> = ["C", "B"].into_iter().zip([0, 90]).take(classes.len()).collect();
    let classes: String = names.iter().zip(classes).map(|((name, _), class)| format!("~{name} {class}\n")).collect();
    let lines: String =
        names.iter().map(|(name, toward)| format!("CONNECTOR {name} -ANC {toward} {distance} ~{name} *R\n")).collect();
    session.open(
        "records",
        format!(
            "&DIMEN -DIMEN METERS N\n{environment}\nMEDIT\n&DESCRIBE BODY RIG -IGNORE X Y Z RX RY RZ\n*R 0 0 -10\n#WEIGHT *R 1E6 1 1 1\n\
             {classes}{lines}END\n&EQUI\nTDOM\n&STATUS F_CONNECTOR\n"
        ),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let warned =
        session.reports.iter().filter(|r| r.message.contains("C: friction of the bottom at rest is left out")).count();
    let text = screen.text();
    let pulls = names.iter().map(|(name, _)| {
        let class = format!("~{name} ");
        let line = text.lines().rev().find(|l| l.contains(&class)).unwrap();
        let numbers: Vec<f64> = line.split_whitespace().skip(4).filter_map(|n| n.parse().ok()).collect();
        [numbers[0].hypot(numbers[1]), numbers[3]]
    });
    (warned, pulls.collect())
}

const FLAT: &str = "&ENV -DEPTH 100 -TIME 0.2 0.1";

/// A chain as a ROD and as a B_CAT, from 100 m of water up a slope.
fn rod_and_catenary(length: f64, slope: f64) -> (usize, Vec<[f64; 2]>) {
    let line = format!("-LEN {length} -WTPLEN 1000 -FRICTION 0.6 -SLOPE {slope}");
    let rod = format!("ROD 100 50 -REFINE 88 -EI 0 -EA 1E9 {line}");
    solve_held_body(FLAT, &[rod, format!("B_CAT 100 -EMOD 1.2732E11 {line}")])
}

#[test]
fn slack_line_on_slope_matches_catenary() {
    for (length, slope) in [(440.0, 0.1), (420.0, 0.1), (430.0, 0.02), (430.0, 0.0), (440.0, -0.1)] {
        let (warned, pulls) = rod_and_catenary(length, slope);
        println!("{length} {slope}: {pulls:?}");
        assert_eq!(warned, 0);
        for (rod, catenary) in pulls[0].iter().zip(&pulls[1]) {
            // elements of 5 m, a touchdown of 7 m radius in the slackest of them
            assert!((rod - catenary).abs() < 1.5e-2 * catenary, "{length} {slope}: {rod} {catenary}");
        }
    }
}

#[test]
fn heaped_chain_on_slope_hangs_vertically_like_catenary() {
    for (length, slope) in [(520.0, 0.1), (470.0, 0.1), (500.0, 0.0)] {
        let (warned, pulls) = rod_and_catenary(length, slope);
        println!("{length} {slope}: {pulls:?}");
        assert_eq!(warned, 0);
        let [rod, catenary] = [pulls[0], pulls[1]];
        // up to a whole element more hangs from the last node on the bottom
        assert!(rod[0] < 0.02 * rod[1] && catenary[0] == 0.0, "{rod:?} {catenary:?}");
        assert!((rod[1] - catenary[1]).abs() < 1000.0 * length / 88.0, "{rod:?} {catenary:?}");
    }
}

#[test]
fn friction_holds_grounded_line_in_current_from_any_side() {
    let chain = "ROD 100 50 -LEN 700 -REFINE 140 -EI 0 -EA 5E8 -WTPLEN 1000 -FRICTION 0.8 -CD 1.2";
    let pull = |current: &str| {
        let (warned, pulls) = held_at(&format!("&ENV -DEPTH 100 -TIME 0.2 0.1 {current}"), &[chain.to_string()], 660.0);
        assert_eq!(warned, 0, "{current}");
        pulls[0]
    };
    let still = pull("");
    for (speed, heading) in [(0.05, 90.0), (0.05, 30.0), (0.5, 180.0), (0.5, 0.0), (1.0, 90.0)] {
        let now = pull(&format!("-CURRENT {speed} {heading}"));
        println!("{speed} {heading}: {now:?} {still:?}");
        // by drag on what hangs, of a quarter of the length
        for (now, still) in now.iter().zip(&still) {
            assert!((now / still - 1.0).abs() < 1e-3 + 0.02 * speed * speed, "{now} {still}");
        }
    }
}

/// The environment of a bottom over a grid whose depth goes by X alone.
fn grid(depth: impl Fn(f64) -> f64) -> String {
    let positions = || (-8..=32).map(|i| 25.0 * f64::from(i));
    let row = |of: &dyn Fn(f64) -> f64| positions().map(|x| format!(" {:.6}", of(x))).collect::<String>();
    let (x, depths) = (row(&|x| x), row(&depth));
    format!("&BATHYMETRY B -DEPTHS\nX{x}\nY -1000{depths}\nY 1000{depths}\nEND\n&ENV -BATHYMETRY B -TIME 0.2 0.1")
}

fn rod(length: f64, elements: usize) -> String {
    format!("ROD 100 50 -LEN {length} -REFINE {elements} -EI 0 -EA 1E9 -WTPLEN 1000 -FRICTION 0.6")
}

#[test]
fn planar_grid_slope_supports_line_like_plane() {
    let plane = solve_held_body(FLAT, &[format!("{} -SLOPE 0.1", rod(440.0, 88))]);
    let charted = solve_held_body(&grid(|x| 60.0 + 0.1 * x), &[rod(440.0, 88)]);
    println!("{plane:?} {charted:?}");
    assert_eq!([plane.0, charted.0], [0, 0]);
    for (a, b) in plane.1[0].iter().zip(&charted.1[0]) {
        assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
    }
}

#[test]
fn friction_holds_slack_line_over_hills_and_valleys_of_grid() {
    for (amplitude, wave, slope, length) in
        [(5.0, 600.0, 0.1, 430.0), (-2.0, 300.0, 0.1, 440.0), (2.0, 150.0, 0.03, 450.0), (-5.0, 300.0, 0.1, 440.0)]
    {
        let hill = |x: f64| amplitude * (std::f64::consts::TAU * x / wave).sin();
        let bottom = grid(|x| 100.0 + slope * (x - 400.0) + hill(x) - hill(400.0));
        let [coarse, fine] = [66, 110].map(|elements| {
            let (warned, pulls) = solve_held_body(&bottom, &[rod(length, elements)]);
            assert_eq!(warned, 0);
            pulls[0]
        });
        println!("{amplitude} {wave}: {coarse:?} {fine:?}");
        for (coarse, fine) in coarse.iter().zip(&fine) {
            // elements of 7 and 4 m at a touchdown of 8 m radius in the slackest of them
            assert!((coarse / fine - 1.0).abs() < 2e-2, "{coarse} {fine}");
        }
    }
}
