//! Results along dynamic lines: against the catenary, and against themselves kept in other ways.

use crate::common::{print_records, run};

use run::{model, settings};
use windlass_base::table::Table;
use windlass_solve::results::along::{LinePosition, LineResults, envelope, histories, lines_at_rest, touchdown};
use windlass_solve::results::events;
use windlass_solve::time::{Ending, Run, RunFileError, RunSettings, SilentWatcher, Snapshot, Watcher};

const DEPTH: f64 = 100.0;

/// A ship held where it is, with a chain on a flat bottom in so many elements.
fn chain(elements: usize, sea: &str) -> String {
    format!(
        "MEDIT\n&DESCRIBE BODY SHIP -IGNORE X Y Z RX RY RZ\n*T 0 0 0\n#WEIGHT *T 1E7 5 5 5\n\
         ~C B_CAT 100 -WTPLEN 2000 -BUOYDIA 0 -LEN 400 -EMODULUS 1E11 -B_TENSION 6E6 -DEPANCHOR {DEPTH}\n\
         CONNECTOR A -ANC 0 350 ~C *T\n&CONNECTOR A -DYNAMICS {elements}\nEND\n&ENV -DEPTH {DEPTH} {sea}\n"
    )
}

fn last(table: &Table, column: &str) -> f64 {
    *table.get(column).unwrap().numbers().last().unwrap()
}

#[test]
fn static_chain_touchdown_matches_catenary() {
    let mut off = Vec::new();
    for elements in [40, 80] {
        let model = model(&chain(elements, ""));
        let mut run = Run::new(&model, settings(0.2, 0.1), Vec::new()).unwrap();
        run.run(&mut SilentWatcher).unwrap();
        let line = LineResults::find(&run, "a").unwrap();
        let table = touchdown(&line, &events(&run.history, None).unwrap()[..1]).unwrap();
        // w = 2000 N/m, H the tension on the bottom: a catenary of parameter a = H/w rises h over an arc sqrt(h^2 + 2 h a)
        let parameter = last(&table, "Tension") / 2000.0;
        let suspended = (DEPTH * DEPTH + 2.0 * DEPTH * parameter).sqrt();
        let arc = last(&table, "Arc");
        // chain and bottom do not stretch or yield visibly: 100 kN on 785 MN, 20 mm of penetration
        off.push((arc - suspended).abs());
        assert!((last(&table, "Length") - (400.0 - suspended)).abs() < 1.5 * 400.0 / elements as f64);
    }
    // a line that sinks 2 mm in leaves the bottom over sqrt(2 a 2 mm), 0.3 m, and two heights tell the slope to a share of an element of 10
    // or 5 m
    assert!(off.iter().all(|off| *off < 1.0), "{off:?}");
}

#[test]
fn static_line_matches_first_row_of_run_in_still_water() {
    let model = model(&chain(20, ""));
    let rest = &lines_at_rest(&model, &|_| true).unwrap()[0];
    let mut run = Run::new(&model, settings(0.2, 0.1), Vec::new()).unwrap();
    run.run(&mut SilentWatcher).unwrap();
    let line = LineResults::find(&run, "A").unwrap();
    assert_eq!(line.nodes(), 21);
    let first = &events(&run.history, None).unwrap()[..1];
    let table = envelope(&line, first).unwrap();
    for (a, b) in rest.get("Tension").unwrap().numbers().iter().zip(table.get("T Mean").unwrap().numbers()) {
        // statics are solved to 1e-5 of a tension
        assert!((a / b - 1.0).abs() < 1e-4, "{a} {b}");
    }
    assert_eq!(rest.get("Arc").unwrap().numbers(), table.get("Arc").unwrap().numbers());
}

#[test]
fn thinned_node_output_matches_full_output() {
    let model = model(&chain(12, "-SEA REGULAR 180 4 9"));
    let ran = |change: fn(RunSettings) -> RunSettings| {
        let mut run = Run::new(&model, change(settings(10.0, 0.25)), Vec::new()).unwrap();
        assert_eq!(run.run(&mut SilentWatcher), Ok(Ending::Done));
        run
    };
    let (all, fourth) = (ran(|s| s), ran(|s| RunSettings { along: 4, ..s }));
    let (bare, none) = (ran(|s| RunSettings { keep: false, ..s }), ran(|s| RunSettings { along: 0, ..s }));
    let reported = |run: &Run| {
        let line = LineResults::find(run, "A").unwrap();
        let kept = if run.history.is_empty() { Vec::new() } else { events(&run.history, None).unwrap() };
        envelope(&line, &kept).unwrap()
    };
    let (whole, some, flat) = (reported(&all), reported(&fourth), reported(&bare));
    for column in ["Arc", "T Min", "T Mean", "T Max", "C Min", "Utilisation"] {
        let (a, b, c) = (&whole.get(column).unwrap().cells, &some.get(column).unwrap().cells, flat.get(column));
        // from the second end: 13, 9, 5 and 1 of thirteen
        assert_eq!(b.len(), 4);
        for (few, many) in [(0, 0), (1, 4), (2, 8), (3, 12)] {
            assert_eq!(a[many], b[few], "{column}");
        }
        assert_eq!(a, &c.unwrap().cells, "{column}");
    }
    assert!(LineResults::find(&none, "A").unwrap_err().help[0].contains("-ALONG"));
    assert!(LineResults::find(&all, "B").is_err());
    // a place between two nodes is between them
    let line = LineResults::find(&all, "A").unwrap();
    let kept = events(&all.history, None).unwrap();
    let arcs = whole.get("Arc").unwrap().numbers();
    let middle = 0.5 * (arcs[1] + arcs[2]);
    let table =
        histories(&line, &[LinePosition::Node(2), LinePosition::Arc(middle), LinePosition::Node(3)], &kept).unwrap();
    let tensions: Vec<Vec<f64>> = table.columns().iter().filter(|c| c.name == "Tension").map(|c| c.numbers()).collect();
    for ((low, middle), high) in tensions[0].iter().zip(&tensions[1]).zip(&tensions[2]) {
        assert!(
            (middle - (low + high) / 2.0).abs() <= 1e-9 * (low.abs() + high.abs()),
            "{low} {middle} {high}, nodes at {arcs:?}"
        );
    }
    assert!(histories(&line, &[LinePosition::Arc(401.0)], &kept).is_err());
    assert!(histories(&line, &[LinePosition::Node(14)], &kept).is_err());
}

/// Keeps snapshots and rows as they come.
#[derive(Default)]
struct RowRecorder {
    snapshots: Vec<Snapshot>,
    rows: Vec<Vec<f64>>,
}

impl Watcher for RowRecorder {
    fn row(&mut self, row: &[f64]) -> Result<(), RunFileError> {
        self.rows.push(row.to_vec());
        Ok(())
    }

    fn snapshot(&mut self, snapshot: &Snapshot) -> Result<(), RunFileError> {
        self.snapshots.push(Snapshot::read(&snapshot.bytes()).unwrap());
        Ok(())
    }
}

#[test]
fn continued_run_has_nodes_of_uninterrupted_run() {
    let model = model(&chain(8, "-SEA REGULAR 180 4 9"));
    let wanted = settings(60.0, 0.1);
    let mut whole = Run::new(&model, wanted.clone(), Vec::new()).unwrap();
    let mut kept = RowRecorder::default();
    assert_eq!(whole.run(&mut kept), Ok(Ending::Done));
    // one at the start, one after 500 steps
    assert_eq!(kept.snapshots.iter().map(|s| s.taken).collect::<Vec<_>>(), [0, 500]);
    for snapshot in &kept.snapshots {
        let rows: Vec<f64> = kept.rows[..snapshot.rows].concat();
        let mut again = Run::resume(&model, wanted.clone(), Vec::new(), (snapshot, rows)).unwrap();
        assert_eq!(again.run(&mut SilentWatcher), Ok(Ending::Done));
        // bit by bit: what is not there is not a number
        let bits = |run: &Run| run.history.values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(again.history.len(), whole.history.len());
        assert!(bits(&again) == bits(&whole), "from step {}", snapshot.taken);
    }
}

#[test]
fn rows_exceeding_memory_are_refused_before_run() {
    let model = model(&chain(100, ""));
    let refused = Run::new(&model, settings(1e6, 0.01), Vec::new()).unwrap_err().error;
    assert!(refused.to_string().contains("GB of memory") && refused.help[0].contains("-STORE"), "{refused:?}");
    assert!(Run::new(&model, RunSettings { keep: false, ..settings(1e6, 0.01) }, Vec::new()).is_ok());
    assert!(Run::new(&model, RunSettings { store: 1000, ..settings(1e6, 0.01) }, Vec::new()).is_ok());
}

/// The numbers of a line of the summary of `ROD .. ENVELOPE`.
fn summary_numbers(text: &str, label: &str) -> Vec<f64> {
    let begun = text.lines().skip_while(|line| !line.contains(" ENVELOPE: ")).take(10);
    let line = begun.into_iter().find(|line| line.trim_start().starts_with(label)).unwrap_or_else(|| panic!("{text}"));
    line.split([' ', ',', ';']).filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn envelope_summary_of_a_chain_at_rest_meets_its_catenary() {
    let (text, errors) = print_records(
        "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE X Y Z RX RY RZ\n*T 0 0 0\n#WEIGHT *T 1000 5 5 5\n\
         ~C B_CAT 100 -LEN 350 -DEPANCHOR 100 -WTPLEN 2 -BUOYDIA 0.01 -B_TENSION 5000\nCONNECTOR A ~C *T -ANC 0 280\n\
         &CONNECTOR A -DYNAMICS 70\nEND\n&ENV -DEPTH 100 -TIME 10 0.5\nTDOM\nPRCPOST\nROD A\nEND\n",
    );
    assert_eq!(errors, 0, "{text}");
    // a = 18.4766 m solves 280 = a acosh(1 + 100 / a) + 350 - s with the hanging length s = root of 100^2 + 200 a = 117.03 m
    let tension = summary_numbers(&text, "Tension");
    // at the top w (a + h) = 236.95 kN, on the bottom w a = 36.95 kN; 70 elements
    assert!((tension[0] - 236.95).abs() < 0.3 && tension[1] == 0.0, "{tension:?}");
    assert!((tension[3] - 36.95).abs() < 0.3, "{tension:?}");
    // 237 of 5000 kN
    assert!((summary_numbers(&text, "Utilisation")[0] - 0.047).abs() < 6e-4);
    // atan(s / a) = 81.028 deg
    assert!((summary_numbers(&text, "Departure")[0] - 81.028).abs() < 0.02);
    // a acosh(1 + h / a) = 47.03 m, s = 117.03 m: within half an element of 5 m, as the touchdown lies between two nodes
    let layback = summary_numbers(&text, "Layback");
    assert!((layback[0] - 47.03).abs() < 2.5 && (layback[1] - 117.03).abs() < 2.5, "{layback:?}");
    assert!(!text.contains("Sagbend"), "a chain has no moment");
}

#[test]
fn envelope_summary_has_strain_of_its_largest_moment() {
    let (text, errors) = print_records(
        "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE X Y Z RX RY RZ\n*T 0 0 -5\n#WEIGHT *T 1000 5 5 5\n\
         *E 150 0 -100\n~R ROD 300 20 -LEN 185 -REFINE 24 -FYIELD 450\nCONNECTOR A ~R *T *E\nEND\n\
         &ENV -DEPTH 100 -SEA REGULAR 180 4 9 -TIME 12 0.25\nTDOM\nPRCPOST\nROD A\nEND\n",
    );
    assert_eq!(errors, 0, "{text}");
    let (strain, sagbend) = (summary_numbers(&text, "Strain"), summary_numbers(&text, "Sagbend"));
    // M r / E I with r = 0.15 m, E = 29000 ksi = 199.95 GPa, I = pi / 64 (0.3^4 - 0.26^4) = 1.732903E-4 m4, in per cent
    let expected = 100.0 * sagbend[0] * 1e3 * 0.15 / (199.948e9 * 1.732_903e-4);
    assert!((strain[0] - expected).abs() < 1e-3 * expected, "{strain:?} {expected}");
    // where and when are those of the moment
    assert_eq!(strain[1..], sagbend[1..]);
}
