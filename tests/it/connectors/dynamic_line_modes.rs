//! Natural modes of lines through the program, `&STATUS ROD_MODES`, against closed forms.

use crate::common;

use std::f64::consts::{FRAC_PI_4, PI};
use windlass::session::Session;
use windlass_base::table::Table;
use windlass_solve::results::along::natural_modes;

const GRAVITY: f64 = 9.80665;

/// A session that has run records in metres and newtons over deep water.
fn done(records: &str) -> (Session, String) {
    let (mut session, screen, _folder) = common::session();
    session.open("test", format!("&DIMEN -DIMEN METERS N\n&ENV -DEPTH 1000\nMEDIT\n{records}END\n"));
    session.run();
    (session, screen.text())
}

/// Tables of the modes of a line S between two points.
fn modes(class: &str, ends: [[f64; 3]; 2], number: usize, shapes: bool) -> Vec<Table> {
    let [a, b] = ends.map(|[x, y, z]| format!("{x} {y} {z}"));
    let (session, _) = done(&format!("{class}\n*A {a}\n*B {b}\nCONNECTOR S ~S *A *B\n"));
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    natural_modes(&session.job.model, &|name| name == "S", number, shapes).unwrap()
}

/// Frequencies of the modes across the plane of the ends.
fn across(table: &Table) -> Vec<f64> {
    let sides = column(table, "Across");
    let found: Vec<f64> =
        column(table, "Frequency").into_iter().zip(sides).filter(|(_, side)| *side > 0.5).map(|(w, _)| w).collect();
    assert!(found.len() >= 3);
    found
}

fn column(table: &Table, name: &str) -> Vec<f64> {
    table.get(name).unwrap().numbers()
}

#[test]
fn hanging_chain_modes_match_bessel_zeros() {
    // 100 N/m over 100 m with a third of its weight left at its lower end: T grows fourfold, and w = a/2 sqrt(3 g / L) with the roots
    // a of J0(a) Y0(2a) = Y0(a) J0(2a): 3.12303, 6.27344, 9.41821 (Abramowitz and Stegun, table 9.7, 1/lambda = 0.5). It is longer by
    // 8333 N of mean tension over EA / L = 1E7 N/m
    let roots = [3.12303, 6.27344, 9.41821];
    let table = |elements: usize| {
        let class = format!("~S ROD 50 25 -LEN 100 -REFINE {elements} -EI 0 -EA 1E9 -WTPLEN 100");
        modes(&class, [[0.0, 0.0, 200.0], [0.0, 0.0, 100.0 - 8.333333333e-4]], 6, false).remove(0)
    };
    let [coarse, fine] = [50, 200].map(|n| column(&table(n), "Frequency"));
    let errors = |found: &[f64]| -> Vec<f64> {
        (0..3).map(|i| found[2 * i] / (0.5 * roots[i] * (3.0 * GRAVITY / 100.0).sqrt()) - 1.0).collect()
    };
    let (coarse_errors, fine_errors) = (errors(&coarse), errors(&fine));
    // lumped masses swing slow by about (n pi / elements)2 / 24
    for i in 0..3 {
        let lumped = ((i + 1) as f64 * PI / 50.0).powi(2) / 24.0;
        assert!((-2.0 * lumped..0.0).contains(&coarse_errors[i]), "{coarse_errors:?}");
        assert!(fine_errors[i].abs() < 0.15 * lumped + 3e-6, "{fine_errors:?} {coarse_errors:?}");
        // alike in both directions, reported one in each
        assert!((fine[2 * i] / fine[2 * i + 1] - 1.0).abs() < 1e-6);
    }
    let reported = table(50);
    let sides: Vec<[f64; 2]> =
        column(&reported, "In Plane").into_iter().zip(column(&reported, "Across")).map(Into::into).collect();
    assert!(sides.iter().all(|s| s.iter().any(|v| (v - 1.0).abs() < 1e-3)), "{sides:?}");
    assert!((column(&reported, "In Plane").iter().sum::<f64>() - 3.0).abs() < 1e-3);
}

#[test]
fn taut_string_in_water_oscillates_with_added_mass() {
    // 1 MN by 0.001 of strain; across, n half waves of N lumped elements swing with w = 2 N sqrt(T/(M L)) sin(n pi/2N), M the mass of all
    let class = "~S ROD 50 25 -LEN 100 -REFINE 60 -EI 0 -EA 1E9 -WTPLEN 30 -CA 1";
    let tables = modes(class, [[0.0, 0.0, -50.0], [100.1, 0.0, -50.0]], 6, true);
    let mass = 100.0 * (30.0 / GRAVITY + 1025.0 * FRAC_PI_4 * 0.05 * 0.05);
    let found = across(&tables[0]);
    for (n, w) in [1.0, 2.0, 3.0].iter().zip(&found) {
        let want = 120.0 * (1e6 / (mass * 100.1)).sqrt() * (n * PI / 120.0).sin();
        // 10 N/m of weight in water sag by 12 mm, which stretch it by 4E-8 of 1E-3
        assert!((w / want - 1.0).abs() < 5e-5, "{n} {w} {want}");
    }
    // its shape is a half wave: a table of shapes behind that of periods
    assert_eq!(tables.len(), 7);
    assert_eq!(tables[1].rows(), 61);
}

#[test]
fn pinned_tensioned_beam_frequencies_match_closed_form() {
    // w2 = k2 (T + EI k2) / m, k = n pi/L, in air; light, so that it does not sag
    let class = "~S ROD 500 20 -LEN 100 -REFINE 100 -EI 2E8 -EA 6E9 -WTPLEN 1";
    let length = 100.0 + 5e5 / 6e9 * 100.0;
    let tables = modes(class, [[0.0, 0.0, 50.0], [length, 0.0, 50.0]], 8, false);
    let found = across(&tables[0]);
    for (n, w) in [1.0, 2.0, 3.0].iter().zip(&found) {
        let k = n * PI / length;
        let want = k * ((5e5 + 2e8 * k * k) * length / (1.0 / GRAVITY * 100.0)).sqrt();
        // hinges between 100 straight elements are soft by up to (n pi/100)2 / 12
        let soft = (n * PI / 100.0).powi(2) / 12.0;
        assert!((w / want - 1.0).abs() < soft + 1e-4, "{n} {w} {want}");
    }
}

#[test]
fn too_many_modes_and_non_dynamic_lines_are_refused() {
    let records =
        "~S ROD 50 25 -LEN 100 -REFINE 10 -EI 0 -EA 1E9 -WTPLEN 100\n*A 0 0 200\n*B 0 0 101\nCONNECTOR S ~S *A *B\n";
    for (asked, says) in [("S -NUMBER 300", "at most 200"), ("S -NUMBER 60", "unknowns cannot be found"), ("X", "no")] {
        let (mut session, _) = done(records);
        session.open("test", format!("&STATUS ROD_MODES {asked}\n"));
        session.run();
        assert_eq!(session.errors, 1, "{asked}");
        let said = format!("{:?}", session.reports);
        assert!(said.contains(says), "{said}");
    }
}
