//! The semi of scripts/study beside MoorPy 1.3.0 [MOORPY-1], intact, with each line lost and with pairs of lines lost (12: L1 and L2):
//! tests/data/moorpy_semi.csv, which benches/moorpy_semi.py made. Surge, sway and yaw under 5 MN toward eight headings.

use crate::common;

use windlass_base::pose::Six;
use windlass_model::Model;
use windlass_solve::{EquilibriumOptions, System, equilibrium};

fn model(lost: &str) -> Model {
    let (mut session, screen, _folder) = common::session();
    let mut records = std::fs::read_to_string("scripts/study/semi.cif").unwrap();
    records = records.replace("data/semi", "scripts/study/data/semi");
    records.push_str("MEDIT\n&DESCRIBE BODY SEMI -IGNORE Z RX RY\nEND\n");
    if lost != "0" {
        let lines: Vec<String> = lost.chars().map(|n| format!("L{n}")).collect();
        records.push_str(&format!("&CONNECTOR {} -INACTIVE\n", lines.join(" ")));
    }
    session.open("semi.cif", records);
    session.run();
    assert!(session.errors == 0, "{}", screen.text());
    session.job.model.clone()
}

#[test]
fn semi_of_the_study_rests_where_moorpy_has_it() {
    let mut reader = csv::Reader::from_path("tests/data/moorpy_semi.csv").unwrap();
    let (mut rows, mut known): (usize, Option<(String, Model)>) = (0, None);
    let mut worst = [0.0_f64; 3];
    for row in reader.records() {
        let row = row.unwrap();
        let number = |i: usize| row[i].parse::<f64>().unwrap();
        if known.as_ref().is_none_or(|(lost, _)| *lost != row[0]) {
            known = Some((row[0].to_owned(), model(&row[0])));
        }
        let model = &known.as_ref().unwrap().1;
        let mut system = System::new(model, &[]).unwrap();
        let (sin, cos) = number(1).to_radians().sin_cos();
        system.applied = vec![(0, Six::new(5e6 * cos, 5e6 * sin, 0.0, 0.0, 0.0, 0.0))];
        let mut state = system.state(model);
        let found = equilibrium(&system, &mut state, &EquilibriumOptions::default()).unwrap();
        assert!(found.search.residual < 1e-8, "{found:?}");
        let pose = state.poses[0];
        let yaw = pose.axes[(1, 0)].atan2(pose.axes[(0, 0)]);
        let list = system.contributions(&state.poses).unwrap();
        let offset = number(2).hypot(number(3));
        let away = (pose.origin.x - number(2)).hypot(pose.origin.y - number(3)) / offset;
        let tension = (1..=8).filter(|n| row[4 + n] != *"0").map(|n| {
            let own = list.iter().find(|c| c.connector.as_deref() == Some(format!("L{n}").as_str())).unwrap();
            (own.load.wrench.fixed_rows::<3>(0).norm() / number(4 + n) - 1.0).abs()
        });
        let now = [away, (yaw - number(4)).abs(), tension.fold(0.0, f64::max)];
        worst = std::array::from_fn(|i| worst[i].max(now[i]));
        rows += 1;
    }
    assert_eq!(rows, 104);
    // of the offset, radians, of the tension; MoorPy stops at steps of 1e-7
    assert!(worst[0] < 1e-6 && worst[1] < 1e-7 && worst[2] < 1e-6, "{worst:?}");
}
