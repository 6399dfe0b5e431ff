//! Cantilevered rods under dead loads, by &EQUI, against scipy's elastica (benches/cantilever_elastica.py).

use crate::common;
use windlass_solve::results::along::lines_at_rest;

/// The tip of a pipe clamped at (0, 0, 50), from there (m).
fn tip(elements: usize, load: f64, weight: f64) -> [f64; 2] {
    let records = format!(
        "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 1000\nMEDIT\n&DESCRIBE BODY ROOT -IGNORE X Y Z RX RY RZ\n*A 0 0 50\n\
         JUNCTION T 10 0 50 -WEIGHT {load}\n\
         ~P ROD 168.3 7.11 -LEN 10 -REFINE {elements} -CLAMP FIRST -EMODULUS 200000 -WTPLEN {weight}\n\
         CONNECTOR R ~P *A *T\nEND\n&EQUI -TOLERANCE 1E-9\n"
    );
    let (mut session, _, _folder) = common::session();
    session.open("test", records);
    session.run();
    assert_eq!(session.errors, 0, "{elements} {load} {weight}: {:?}", session.reports);
    let table = lines_at_rest(&session.job.model, &|_| true).unwrap().remove(0);
    ["X", "Z"].map(|name| *table.get(name).unwrap().numbers().last().unwrap())
}

#[test]
fn cantilever_under_dead_load_matches_elastica_at_any_mesh() {
    for line in include_str!("../../../crates/line-dynamics/tests/data/cantilever_elastica.csv").lines().skip(1) {
        let row: Vec<f64> = line.split(',').map(|v| v.parse().unwrap()).collect();
        let (load, weight, exact) = (row[0], row[1].max(1e-6), [row[2], 50.0 + row[3]]);
        let made = [20, 40, 80, 160].map(|elements| tip(elements, load, weight));
        let off = |[x, z]: [f64; 2]| (x - exact[0]).hypot(z - exact[1]);
        for pair in made.windows(2) {
            let ratio = off(pair[0]) / off(pair[1]);
            // second order: 4 but for the next term
            assert!((3.8..4.2).contains(&ratio), "{load} {weight}: {ratio}");
        }
        let beyond = [0, 1].map(|i| (4.0 * made[3][i] - made[2][i]) / 3.0);
        // the fourth-order term, and what the tolerance of &EQUI leaves: 1e-9 of gravity over 3 EI / L^3
        assert!(off(beyond) < 1e-5, "{load} {weight}: {beyond:?} {exact:?}");
    }
}
