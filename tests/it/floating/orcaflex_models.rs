//! OrcaFlex text models [ORCAFLEX-A01] beside the closed forms of elastic catenaries: tests/data/orcaflex/catenary.py.

use crate::common;

use windlass_model::Model;
use windlass_solve::{EquilibriumOptions, System, equilibrium};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/orcaflex");
/// Horizontal and vertical force (N) at the first ends, by catenary.py.
const FORCES: [(&str, [f64; 2]); 2] =
    [("CHAIN_LEG", [271_420.500865, 335_937.180507]), ("HOSE", [19_496.942228, 80_245.554235])];

fn read(options: &str) -> Model {
    let (mut session, _screen, _folder) = common::session();
    session.open("records", format!("INMODEL -ORCAFLEX \"{FOLDER}/two_lines.yml\" {options}\n"));
    session.run();
    assert!(session.errors == 0, "{:?}", session.reports);
    session.job.model.clone()
}

/// Horizontal and vertical force (N) of a quasi-static line on its first end.
fn force(model: &Model, name: &str) -> [f64; 2] {
    let connector = &model.connectors[name];
    let class = &model.classes[&Model::key(&connector.class)];
    let line = class.line(&model.placement(connector), &model.surroundings()).unwrap();
    let [x, y, z] = line.loads().unwrap().fairlead;
    [x.hypot(y), -z]
}

#[test]
fn two_lines_have_the_forces_of_their_closed_forms() {
    let model = read("-STATIC");
    for (name, [h, v]) in FORCES {
        let [got_h, got_v] = force(&model, name);
        assert!((got_h / h - 1.0).abs() < 1e-8 && (got_v / v - 1.0).abs() < 1e-8, "{name}: {got_h} {got_v}");
    }
}

#[test]
fn dynamic_lines_of_a_model_rest_near_their_catenaries() {
    let model = read("");
    let system = System::new(&model, &[]).unwrap();
    let mut state = system.state(&model);
    let found = equilibrium(&system, &mut state, &EquilibriumOptions::default()).unwrap();
    assert!(found.search.residual < 1e-9, "{found:?}");
    for part in system.contributions(&state.poses).unwrap() {
        if part.connector.as_deref() == Some("HOSE") {
            let [x, y, z] = [0, 1, 2].map(|axis| part.load.wrench[axis]);
            // elements of 3 and 0.5 m
            let (h, v) = (x.hypot(y), z.abs());
            assert!((h / FORCES[1].1[0] - 1.0).abs() < 2e-3 && (v / FORCES[1].1[1] - 1.0).abs() < 2e-3, "{h} {v}");
        }
    }
}

#[test]
fn wrong_models_are_errors_at_their_words() {
    let good = std::fs::read_to_string(format!("{FOLDER}/two_lines.yml")).unwrap();
    for (old, new, word, message) in [
        ("OD: 0.15", "OD: wide", "wide", "OD is not a number"),
        ("WaterDepth: 100", "WaterDepht: 100", "Environment", "gives no depth"),
        ("Groups:", "3DBuoys:", "3DBuoys", "3DBuoys is not read"),
        ("EA: 800e3", "EA: [800e3", "", "is no YAML"),
        ("  Orientation:", "  InitialHeading: 30\n  Orientation:", "30", "InitialHeading"),
        ("Connection, ConnectionX", "Connect, ConnectionX", "", "has no Connection"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("model.yml");
        assert!(good.contains(old), "{old}");
        let text = good.replacen(old, new, 1);
        std::fs::write(&path, &text).unwrap();
        let (mut session, _screen, _folder) = common::session();
        session.open("records", format!("INMODEL -ORCAFLEX \"{}\"\n", path.display()));
        session.run();
        let said = session.reports.iter().find(|report| report.message.contains(message));
        let span = said.unwrap_or_else(|| panic!("{new}: {:?}", session.reports)).span.unwrap();
        if !word.is_empty() {
            assert_eq!(&text[span.start as usize..span.end as usize], word, "{new}");
        }
        assert!(session.errors > 0 && session.job.model.connectors.is_empty(), "{new}");
    }
}
