//! Shapes, sensitivity tables and connector forces as the commands give them, against the closed catenary of a line that
//! does not stretch, y = H/w (cosh(w x/H) - 1), against AE/L, and against each other.

use crate::common;
use crate::common::assert_near;

use std::collections::HashMap;
use windlass::session::Session;
use windlass_connectors::CLASSES;
use windlass_model::Placement;

/// What a job printed, what it said, and the columns of the CSV file it stored.
struct Done {
    text: String,
    said: Vec<String>,
    errors: i64,
    stored: HashMap<String, Vec<Option<f64>>>,
}

impl Done {
    /// The numbers of the row of the connector forces that begins with a name.
    fn row(&self, name: &str) -> Vec<f64> {
        let line = self.text.lines().find(|l| l.trim_start().starts_with(&format!("{name} "))).unwrap();
        line.split_whitespace().filter_map(|w| w.parse().ok()).collect()
    }

    fn column(&self, name: &str) -> Vec<f64> {
        let found = self.stored.get(name).unwrap_or_else(|| panic!("no {name}: {:?} {}", self.said, self.text));
        found.iter().map(|v| v.unwrap()).collect()
    }
}

/// Runs records in metres and newtons; `change` may edit the session before the last of them.
fn run(records: &str, change: impl Fn(&mut Session), last: &str) -> Done {
    let (mut session, screen, folder) = common::session();
    session.job.settings.error_limit = i64::MAX;
    session.interactive = true;
    session.open("records", format!("&DIMEN -DIMEN METERS N\n{records}\n"));
    session.run();
    change(&mut session);
    session.open("last", format!("{last}\n"));
    session.run();
    session.job.output.flush();
    let mut stored: HashMap<String, Vec<Option<f64>>> = HashMap::new();
    if let Ok(mut reader) = csv::Reader::from_path(folder.path().join("job.ans/t.csv")) {
        let heads = reader.headers().unwrap().clone();
        for record in reader.records() {
            let record = record.unwrap();
            for (head, cell) in heads.iter().zip(&record) {
                let name = head.split(" (").next().unwrap().to_string();
                stored.entry(name).or_default().push(cell.parse().ok());
            }
        }
    }
    let text = screen.text();
    let errors = session.errors;
    Done { text, said: session.reports.iter().map(|r| r.message.clone()).collect(), errors, stored }
}

/// A line of 1010 m that weighs 1 kN/m and hardly stretches, in water of 200 m; its anchor lies toward 30 degrees.
fn stiff(flag: &str, distance: f64) -> String {
    format!(
        "MEDIT\n*P 7 -3 0\n~L B_CAT 100 {flag} -LEN 1010 -DEP 200 -BUOY 0 -WTPL 1000 -EMOD 1E11 -B_TEN 1E6\n\
         CONNECTOR A -ANC 30 {distance} ~L *P\nEND"
    )
}

/// Distance, vertical force, suspended length of that line at a horizontal force, `h` high.
fn closed_form(force: f64, h: f64, length: f64) -> [f64; 3] {
    let a = force / 1000.0;
    let suspended = (h * h + 2.0 * h * a).sqrt();
    [length - suspended + a * (1.0 + h / a).acosh(), 1000.0 * suspended, suspended]
}

/// Whether a number is what a report shows of another: forces to 1 N, distances to 0.01 m, ratios to 0.001.
fn is_printed_as(got: f64, want: f64) -> bool {
    (got - want).abs() <= if want.abs() > 1e4 { 0.51 } else { 0.0051 }
}

#[test]
fn stiff_line_shape_matches_closed_form_catenary() {
    // a strain of 6e-10 at most: 1e-8 leaves room for it
    let (force, a) = (300_000.0, 300.0);
    let done =
        run(&stiff("", 900.0), |_| (), "CONN_DESIGN\nGEOMETRY A -HORIZONTAL 300000\nREPORT X\nSTORE t\nEND\nEND");
    let [x, _, suspended] = closed_form(force, 200.0, 1010.0);
    assert_near(suspended, 400.0, 1e-12);
    let touchdown = x - 610.0;
    let (xs, zs, arcs) = (done.column("X"), done.column("Z"), done.column("Arc Length"));
    let (tensions, angles) = (done.column("Tension"), done.column("Angle"));
    assert_near(*xs.last().unwrap(), x, 1e-8);
    for i in 0..xs.len() {
        let u = ((touchdown - xs[i]) / a).max(0.0);
        assert_near(zs[i], -200.0 + a * (u.cosh() - 1.0), 1e-8);
        assert_near(arcs[i], if u > 0.0 { 400.0 - a * u.sinh() } else { 400.0 + xs[i] - touchdown }, 1e-8);
        assert_near(tensions[i], force * u.cosh(), 1e-8);
        assert_near(angles[i], u.sinh().atan().to_degrees(), 1e-7);
    }
    let marked: Vec<usize> = (0..xs.len()).filter(|i| done.stored["Touchdown"][*i].is_some()).collect();
    assert_eq!(marked.len(), 1);
    assert_near(xs[marked[0]], touchdown, 1e-8);
    assert!(done.stored["Joint"].iter().all(Option::is_none));
    for fact in ["Horizontal Force                 = 300000 N", "Tension at Top                   = 500000 N"] {
        assert!(done.text.contains(fact), "{fact} is not in\n{}", done.text);
    }
}

#[test]
fn every_configuration_request_gives_same_configuration() {
    let [x, ..] = closed_form(3e5, 200.0, 1010.0);
    let shape = |distance: f64, options: &str| {
        run(&stiff("EXACT", distance), |_| (), &format!("CONN_DESIGN\nGEOMETRY A {options}\nSTORE t\nEND\nEND"))
    };
    let want = shape(900.0, "-HORIZONTAL 3E5");
    for other in [shape(x, ""), shape(900.0, "-TENSION 5E5"), shape(900.0, &format!("-DISTANCE {x}"))] {
        for name in ["X", "Z", "Tension"] {
            // a force known to 1e-9 leaves the nearly stiff line's distance and with it the force this uncertain
            other.column(name).iter().zip(want.column(name)).for_each(|(a, b)| assert_near(*a, b, 1e-6));
        }
    }
}

#[test]
fn sensitivity_tables_match_closed_form_catenary() {
    let table = |options: &str| {
        run(&stiff("", 900.0), |_| (), &format!("CONN_DESIGN\nTABLE A -VARY {options}\nSTORE t\nEND\nEND"))
    };
    let rows = |done: &Done, forces: &[f64], heights: &[f64], lengths: &[f64]| {
        assert_eq!((done.errors, done.column("X").len()), (0, forces.len()), "{:?}", done.said);
        for (i, ((force, h), l)) in forces.iter().zip(heights).zip(lengths).enumerate() {
            let [x, vertical, suspended] = closed_form(*force, *h, *l);
            for (name, want) in [
                ("X", x),
                ("Force", *force),
                ("V. Force", vertical),
                ("Ten Top", force + 1000.0 * h),
                ("Max T/TB", (force + 1000.0 * h) / 1e6),
                ("Crit. Seg", 1.0),
                ("V. Pull", 0.0),
                ("H. Pull", *force),
                ("Line on Bottom", l - suspended),
            ] {
                assert_near(done.column(name)[i], want, 2e-6);
            }
        }
    };
    let forces = [1e5, 2e5, 4e5];
    let distances = forces.map(|h| closed_form(h, 200.0, 1010.0)[0]);
    rows(&table("HORIZONTAL 1E5 2E5 4E5"), &forces, &[200.0; 3], &[1010.0; 3]);
    rows(&table("TENSION 3E5 4E5 6E5"), &forces, &[200.0; 3], &[1010.0; 3]);
    rows(
        &table(&format!("DISTANCE {} {} {}", distances[0], distances[1], distances[2])),
        &forces,
        &[200.0; 3],
        &[1010.0; 3],
    );
    rows(&table("FAIRLEAD -50 0 50 -HORIZONTAL 2E5"), &[2e5; 3], &[150.0, 200.0, 250.0], &[1010.0; 3]);
    rows(&table("LENGTH 900 1000 1100 -TENSION 4E5"), &[2e5; 3], &[200.0; 3], &[900.0, 1000.0, 1100.0]);
    let x = distances[1];
    rows(&table(&format!("LENGTH 1010 1100 -DISTANCE {x}")).first(1), &[2e5], &[200.0], &[1010.0]);
}

impl Done {
    /// The same with the first rows of the stored columns alone.
    fn first(mut self, rows: usize) -> Done {
        self.stored.values_mut().for_each(|c| c.truncate(rows));
        self
    }
}

#[test]
fn unsolved_configuration_has_empty_row_and_named_warning() {
    // hanging straight down the line bears 200 kN
    let last = "CONN_DESIGN\nTABLE A -VARY TENSION 3E5 100 2E6\nREPORT\nSTORE t\nEND\nEND";
    let done = run(&stiff("", 900.0), |_| (), last);
    assert_eq!(done.errors, 0);
    let found: Vec<bool> = done.stored["X"].iter().map(Option::is_some).collect();
    assert_eq!(found, [true, false, true]);
    assert!(done.said[0] == "Tension 2000000 N: the line is beyond its breaking tension", "{:?}", done.said);
    assert!(done.said[1].starts_with("Tension 100 N: no position has the tension"), "{:?}", done.said);
    for note in ["   warning: Tension 2000000 N: the line is beyond", "   Tension 100 N: no position has"] {
        assert!(done.text.contains(note), "{}", done.text);
    }
}

#[test]
fn connector_forces_match_placed_shape_and_point_to_anchor() {
    let (records, x) = (stiff("EXACT", 0.0), closed_form(3e5, 200.0, 1010.0)[0]);
    let records = records.replace("-ANC 30 0", &format!("-ANC 30 {x}"));
    let done = run(&records, |_| (), "&STATUS F_CONNECTOR\nCONN_DESIGN\nGEOMETRY A\nREPORT X\nSTORE t\nEND\nEND");
    let row = done.row("A");
    let (c, s) = (30f64.to_radians().cos(), 30f64.to_radians().sin());
    let (h, v) = (done.column("Horizontal")[0], done.column("Vertical")[0]);
    for (got, want) in row.iter().zip([x, h * c, h * s, -v, h.hypot(v), h.hypot(v) / 1e6, 1.0, 0.0, h]) {
        assert!(is_printed_as(*got, want), "{got} is not {want} in {row:?}");
    }
    assert_near(h, 3e5, 1e-6);
    assert_near(v, 4e5, 1e-6);
    assert_near(row[9], 610.0, 1e-5);
    assert!(done.text.lines().any(|l| l.trim_start().starts_with("A ") && l.contains(" exact ")));
}

#[test]
fn line_angles_match_catenary_with_and_without_uplift() {
    let table = |x: f64| {
        let records = stiff("EXACT", 0.0).replace("-ANC 30 0", &format!("-ANC 30 {x}"));
        run(&records, |_| (), "&STATUS LINE_ANGLES -DISPOSE\nSTORE t\nREPORT\nEND")
    };
    // on the bottom the slope at the fairlead is V/H, and the height is s tan(b/2) of a suspended length s
    let slack = table(closed_form(3e5, 200.0, 1010.0)[0]);
    assert_near(slack.column("Azimuth")[0], 30.0, 1e-6);
    assert_near(slack.column("Declination")[0], 90.0 - (4f64 / 3.0).atan().to_degrees(), 1e-6);
    assert_near(slack.column("Uplift")[0], 0.0, 1e-6);
    let below = (90.0 - slack.column("Declination")[0]).to_radians();
    assert_near((1010.0 - slack.column("Unstretched")[0]) * (0.5 * below).tan(), 200.0, 1e-5);
    // lifted off the bottom by a slope u at the anchor: h = H/w (sqrt(1 + t^2) - sqrt(1 + u^2)), t = u + w L/H, grows as H falls
    let u = 5f64.to_radians().tan();
    let height = |a: f64| a * ((1.0 + (u + 1010.0 / a).powi(2)).sqrt() - (1.0 + u * u).sqrt());
    let (mut low, mut high) = (1e2, 1e5);
    for _ in 0..200 {
        let a: f64 = 0.5 * (low + high);
        if height(a) > 200.0 { low = a } else { high = a }
    }
    let t = u + 1010.0 / low;
    let taut = table(low * (t.asinh() - u.asinh()));
    // the strain, 3e-8 here, changes the slopes of a line this taut by some thousand times as much
    assert_near(taut.column("Uplift")[0], 5.0, 1e-4);
    assert_near(taut.column("Declination")[0], 90.0 - t.atan().to_degrees(), 1e-4);
    assert!(taut.text.contains("uplift at the anchor: A; drag anchors are rated for none"), "{}", taut.text);
}

#[test]
fn line_angles_list_lines_that_do_not_pull_and_dynamic_lines() {
    // a chord (3, 4, -12) of 13 m: 14 m are slack, and push where they are not TENSION; a declination of atan(5 / 12)
    let records = "MEDIT\n*P 0 0 0\n*Q 3 4 -12\n~S SL_ELEM 100 TENSION -LEN 14 -WTPL 0\n~C SL_ELEM 100 -LEN 14 -WTPL 0\n\
                   ~D SL_ELEM 100 -LEN 12.9 -WTPL 0\nCONNECTOR S ~S *P *Q\nCONNECTOR C ~C *P *Q\nCONNECTOR D ~D *P *Q\nEND";
    let done = run(records, |_| (), "&STATUS LINE_ANGLES -DISPOSE\nSTORE t\nREPORT\nEND");
    assert_eq!(done.errors, 0, "{:?}", done.said);
    let (tension, declination) = (&done.stored["Fairlead: Tension"], &done.stored["Declination"]);
    assert_eq!(done.stored["Azimuth"].iter().map(Option::is_some).collect::<Vec<_>>(), [false, false, true]);
    assert!(tension[0] == Some(0.0) && tension[1] < Some(0.0), "{tension:?}");
    assert_eq!(done.stored["Anchor: Tension"], *tension);
    assert!(declination[0].is_none() && declination[1].is_none());
    assert_near(declination[2].unwrap(), (5f64 / 12.0).atan().to_degrees(), 1e-6);
    assert_near(done.stored["Azimuth"][2].unwrap(), (4f64 / 3.0).atan().to_degrees(), 1e-6);
    // as a dynamic line of 60 elements the catenary of the test above, to what its elements of 17 m leave
    let records = stiff("EXACT", 0.0).replace("-ANC 30 0", &format!("-ANC 30 {}", closed_form(3e5, 200.0, 1010.0)[0]));
    let dynamic =
        run(&records, |_| (), "&CONNECTOR A -DYNAMICS 60\n&STATUS LINE_ANGLES -DISPOSE\nSTORE t\nREPORT\nEND");
    assert_near(dynamic.column("Declination")[0], 90.0 - (4f64 / 3.0).atan().to_degrees(), 1e-3);
}

#[test]
fn constant_tension_line_angles_match_its_chord() {
    // a chord (3, 4, -12) of 13 m, which carries its tension straight
    let records = "MEDIT\n*P 0 0 0\n*Q 3 4 -12\n~W CT_LINE 100\nCONNECTOR W ~W *P *Q\nEND";
    let done = run(records, |_| (), "&STATUS LINE_ANGLES -DISPOSE\nSTORE t\nREPORT\nEND");
    assert_eq!(done.errors, 0, "{:?}", done.said);
    assert_near(done.column("Azimuth")[0], (4f64 / 3.0).atan().to_degrees(), 1e-6);
    assert_near(done.column("Declination")[0], (5f64 / 12.0).atan().to_degrees(), 1e-6);
    assert_near(done.column("Uplift")[0], (12f64 / 5.0).atan().to_degrees(), 1e-6);
    assert_eq!(done.stored["Fairlead: Tension"], done.stored["Anchor: Tension"]);
    assert_near(done.stored["Fairlead: Tension"][0].unwrap(), 100.0, 1e-6);
}

#[test]
fn tabulated_connector_forces_are_near_exact_and_marked_tabulated() {
    let x = closed_form(3e5, 200.0, 1010.0)[0];
    let done = run(&stiff("-TABLE", x), |_| (), "&STATUS F_CONNECTOR");
    let row = done.row("A");
    assert!(done.text.lines().any(|l| l.trim_start().starts_with("A ") && l.contains(" table ")), "{}", done.text);
    // thirty rows between 0 and 1 MN: a monotone cubic is within some percent of the steep force
    assert_near(row[1].hypot(row[2]), 3e5, 0.03);
    assert_near(-row[3], 4e5, 0.03);
}

#[test]
fn inactive_unsolved_or_non_line_connector_stops_no_other() {
    let records = format!(
        "{}\nMEDIT\n&DESCRIBE BODY B\n*Q 0 0 0\n~G GSPR X 1 1\n~T SL_ELEM 100 -LEN 10 -EMOD 100\n\
         CONNECTOR OFF -ANC 0 900 ~L *P\nCONNECTOR LOST ~L *P\nCONNECTOR GS ~G *P *Q\nCONNECTOR TIE ~T *P *Q\nEND",
        stiff("EXACT", 900.0)
    );
    let switch = |session: &mut Session| {
        session.job.model.connectors.get_mut("OFF").unwrap().active = false;
    };
    let done = run(&records, switch, "&STATUS F_CONNECTOR");
    assert_eq!(done.errors, 0, "{:?}", done.said);
    let solution = |name: &str| {
        let line = done.text.lines().find(|l| l.trim_start().starts_with(&format!("{name} "))).unwrap();
        line.split_whitespace().nth(2).unwrap().to_string()
    };
    assert_eq!([solution("OFF"), solution("LOST"), solution("GS")], ["inactive", "none", "exact"]);
    assert_eq!(done.row("A").len(), 10);
    // a spring of 10 m between points that lie apart by less pushes them apart, along the line between them: its body, at its second
    // end, away from the point on the ground
    let (row, chord) = (done.row("TIE"), 58f64.sqrt());
    let force = std::f64::consts::FRAC_PI_4 * 1e4 * 100.0 * (10.0 - chord) / 10.0;
    for (got, want) in row[1..].iter().zip([-force * 7.0 / chord, force * 3.0 / chord, 0.0, -force]) {
        assert!(is_printed_as(*got, want), "{got} is not {want} in {row:?}");
    }
    assert!(done.said.iter().any(|m| m == "LOST: the other end of the line has no place"), "{:?}", done.said);
    // one newton per metre over seven metres
    assert_near(done.row("GS")[1].abs(), 7.0, 1e-9);
}

#[test]
fn spring_along_chord_keeps_ae_over_l_at_any_varied_distance() {
    let records = "MEDIT\n&DESCRIBE BODY A\n*P 0 0 3\n&DESCRIBE BODY B\n*Q 8 0 3\n~T SL_ELEM 100 -LEN 10 -EMOD 100\n\
                   CONNECTOR TIE ~T *P *Q\nEND";
    let done = run(records, |_| (), "CONN_DESIGN\nTABLE TIE -VARY DISTANCE 6 10 11\nSTORE t\nEND\nEND");
    let shape = run(records, |_| (), "CONN_DESIGN\nGEOMETRY TIE\nEND\nEND");
    assert_eq!(
        shape.said[..2],
        [
            "an SL_ELEM has no weight: 5257 N in water are left out",
            "the spring is pushed together: it is straight between its ends"
        ]
    );
    let stiffness = std::f64::consts::FRAC_PI_4 * 1e4 * 100.0 / 10.0;
    for (got, want) in done.column("Force").iter().zip([-4.0, 0.0, 1.0]) {
        assert_near(*got, stiffness * want, 1e-9);
    }
}

#[test]
fn only_line_classes_declare_line_capability() {
    for kind in CLASSES {
        let (mut session, _screen, _folder) = common::session();
        session.open("example", format!("&ENV -DEPTH 5000\n{}", kind.spec.example));
        session.run();
        let class = session.job.model.classes.values().next().unwrap();
        let position = Placement { other: Some([9.0, 0.0, -9.0]), ..Placement::default() };
        let line = class.line(&position, &session.job.model.surroundings());
        let none = line
            .is_err_and(|e| ["is no mooring line", "is a dynamic line"].iter().any(|why| e.to_string().contains(why)));
        assert_eq!(class.object.as_line().is_some(), !none, "{}", kind.spec.name);
    }
}
