//! Decks with panels: radiation and diffraction of AQWA-LINE against exact series, what follows by RESTART, and wrong panels by card and column.

use crate::common;

use nalgebra::Complex;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;
use windlass::session::Session;
use windlass_aqwa as aqwa;
use windlass_language::source::Sources;
use windlass_model::Database;

const RADIUS: f64 = 10.0;
const DENSITY: f64 = 1.025;
const GRAVITY: f64 = 9.81;

/// A deck of panels whose nodes are given, in t, m, kN: one structure of which a quarter is given, with its centre of gravity below the surface.
struct PanelDeck {
    nodes: Vec<[f64; 3]>,
    panels: Vec<Vec<usize>>,
    mass: f64,
    depth: f64,
    frequencies: Vec<f64>,
}

impl PanelDeck {
    /// The head of a deck, and decks 1 to 8.
    fn text(&self, head: &str) -> String {
        let mut text = format!("{head}          COOR\n      NOD5\n");
        for (number, [x, y, z]) in self.nodes.iter().enumerate() {
            writeln!(text, "      {:5}         {x:10.6}{y:10.6}{z:10.6}", number + 1).unwrap();
        }
        text.push_str("      99999               0.0       0.0      -3.0\n END\n          ELM1      BALL\n      SYMX\n      SYMY\n");
        for (number, corners) in self.panels.iter().enumerate() {
            let keyword = if corners.len() == 4 { "QPPL" } else { "TPPL" };
            let list: String = corners.iter().map(|corner| format!("({:5})", corner + 1)).collect();
            writeln!(text, "     1{keyword} DIFF   14(1){list}  WB Elem Id:{number:5} Aqwa Elem No:{number:5}")
                .unwrap();
        }
        let inertia = 16.0 * self.mass;
        write!(
            text,
            "     1PMAS        50(1)(99999)(99999)(99999)\n END\n          FINI\n          MATE\n END           99999{:10.1}\n          GEOM\n \
             END  PMAS     99999{inertia:10.0}         0         0{inertia:10.0}         0{inertia:10.0}\n          GLOB\n      DPTH{:10.1}\n      DENS     {DENSITY}\n \
             END  ACCG      {GRAVITY}\n          FDR1\n",
            self.mass, self.depth
        )
        .unwrap();
        for (number, frequency) in self.frequencies.iter().enumerate() {
            let number = number + 1;
            writeln!(text, "      FREQ{number:5}{number:5}{frequency:10.7}").unwrap();
        }
        text.push_str(" END  DIRN    1    2       0.0      90.0\n          NONE\n          NONE\n");
        text
    }
}

const LINE: &str = "JOB BALL  LINE\nTITLE               Panels\nOPTIONS REST END\nRESTART   1  3\n";

/// A quarter of a hemisphere by rows and columns.
fn hemisphere(rows: usize, frequencies: Vec<f64>) -> PanelDeck {
    let clean = |x: f64| if x.abs() < 1e-9 { 0.0 } else { RADIUS * x };
    let point = |i: usize, j: usize| {
        let (t, p) = (FRAC_PI_2 * i as f64 / rows as f64, FRAC_PI_2 * j as f64 / rows as f64);
        [clean(t.cos() * p.cos()), clean(t.cos() * p.sin()), clean(-t.sin())]
    };
    let mut nodes: Vec<[f64; 3]> = (0..rows).flat_map(|i| (0..=rows).map(move |j| point(i, j))).collect();
    nodes.push([0.0, 0.0, -RADIUS]);
    let at = |i: usize, j: usize| if i == rows { rows * (rows + 1) } else { i * (rows + 1) + j };
    let panel = |i: usize, j: usize| {
        let mut corners = vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        corners.dedup();
        corners
    };
    let panels = (0..rows).flat_map(|i| (0..rows).map(move |j| panel(i, j))).collect();
    let mass = 2.0 / 3.0 * PI * RADIUS.powi(3) * DENSITY;
    PanelDeck { nodes, panels, mass, depth: 1000.0, frequencies }
}

/// A quarter of a truncated cylinder of draught 5 m, smaller panels towards its edges; the polygon has the area of the circle.
fn cylinder(rows: usize, rings: usize, turns: usize, frequencies: Vec<f64>) -> PanelDeck {
    let step = FRAC_PI_2 / turns as f64;
    let outer = RADIUS * (step / step.sin()).sqrt();
    let clean = |x: f64| if x.abs() < 1e-9 { 0.0 } else { x };
    let point = |r: f64, j: usize, z: f64| {
        let angle = step * j as f64;
        [clean(outer * r * angle.cos()), clean(outer * r * angle.sin()), z]
    };
    let height = |k: usize| clean(-0.25 * RADIUS * (1.0 - (PI * k as f64 / rows as f64).cos()));
    let radius = |i: usize| clean((FRAC_PI_2 * i as f64 / rings as f64).cos());
    // down the side, then along the bottom
    let line: Vec<[f64; 2]> =
        (0..=rows).map(|k| [1.0, height(k)]).chain((1..rings).map(|i| [radius(i), -0.5 * RADIUS])).collect();
    let mut nodes: Vec<[f64; 3]> = line.iter().flat_map(|[r, z]| (0..=turns).map(move |j| point(*r, j, *z))).collect();
    nodes.push([0.0, 0.0, -0.5 * RADIUS]);
    let last = line.len();
    let at = |i: usize, j: usize| if i == last { last * (turns + 1) } else { i * (turns + 1) + j };
    let panel = |i: usize, j: usize| {
        let mut corners = vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        corners.dedup();
        corners
    };
    let panels = (0..last).flat_map(|i| (0..turns).map(move |j| panel(i, j))).collect();
    let mass = 0.5 * PI * RADIUS.powi(3) * DENSITY;
    PanelDeck { nodes, panels, mass, depth: 1.5 * RADIUS, frequencies }
}

/// Rows of a table of exact numbers.
fn rows(file: &str) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(format!("crates/diffraction/tests/data/{file}")).unwrap();
    text.lines().skip(2).map(|line| line.split(',').map(|word| word.parse().unwrap()).collect()).collect()
}

/// A session that ran a deck without an error, and what it printed.
fn run(name: &str, text: &str) -> (Session, String, tempfile::TempDir) {
    let (mut session, screen, folder) = common::session();
    session.open_job(name, text);
    session.run();
    let reports: Vec<String> = session.reports.iter().map(|r| r.message.clone()).collect();
    assert_eq!(session.errors, 0, "{reports:#?}");
    let text = format!("{}\n{}", screen.text(), reports.join("\n"));
    (session, text, folder)
}

fn database(session: &Session) -> std::sync::Arc<Database> {
    session.job.model.bodies["S1"].database.as_ref().unwrap().data.clone()
}

/// Largest errors of A and B in surge and heave over a mass, and of X over the exact amplitudes; K of the rows over the radius.
fn errors(data: &Database, table: &[Vec<f64>], columns: [usize; 4], mass: f64) -> [f64; 2] {
    let mut worst = [0.0_f64; 2];
    let head = data.headings.iter().position(|heading| heading.abs() < 1e-9).unwrap();
    for row in table {
        let frequency = (row[0] * GRAVITY / RADIUS).sqrt();
        let at = data.frequencies.iter().position(|w| (w / frequency - 1.0).abs() < 1e-5).unwrap();
        for (mode, (a, x)) in [(0, (columns[0], columns[2])), (2, (columns[1], columns[3]))] {
            let added = data.added_mass[at][(mode, mode)] / mass;
            let damping = data.damping[at][(mode, mode)] / (mass * frequency);
            worst[0] = worst[0].max((added - row[a]).abs()).max((damping - row[a + 1]).abs());
            let exact = Complex::new(row[x], row[x + 1]);
            let made = data.excitation[head][at][mode] / (1000.0 * DENSITY * GRAVITY * RADIUS * RADIUS);
            worst[1] = worst[1].max((made - exact).norm() / exact.norm());
        }
    }
    worst
}

fn frequencies(table: &[Vec<f64>]) -> Vec<f64> {
    table.iter().map(|row| (row[0] * GRAVITY / RADIUS).sqrt()).collect()
}

#[test]
fn line_deck_of_hemisphere_has_exact_forces() {
    let table =
        rows("hemisphere.csv").into_iter().filter(|row| [0.1, 0.2, 0.5, 1.0].contains(&row[0])).collect::<Vec<_>>();
    let (session, text, _folder) = run("ball.dat", &hemisphere(15, frequencies(&table)).text(LINE));
    let mass = 2.0 / 3.0 * PI * RADIUS.powi(3) * 1000.0 * DENSITY;
    let [matrices, forces] = errors(&database(&session), &table, [1, 3, 5, 7], mass);
    // 900 panels; 400 leave 0.6 % of the displaced mass at K = 0.1 with the lid, and 0.45 % without it
    assert!(table.len() == 4 && matrices < 0.003 && forces < 0.005, "{matrices} {forces}");
    assert!(text.contains("upright walls are assumed above it"), "{text}");
}

#[test]
fn line_deck_of_cylinder_in_finite_depth_has_exact_forces() {
    // 16 rows and rings by 8 columns in a quarter: 1,024 panels
    let table: Vec<Vec<f64>> = rows("truncated_cylinder.csv").into_iter().filter(|row| row[0] < 2.0).collect();
    let (session, text, _folder) = run("can.dat", &cylinder(16, 16, 8, frequencies(&table)).text(LINE));
    let data = database(&session);
    assert_eq!(data.depth, Some(1.5 * RADIUS));
    // A over rho a3, half pi of which is displaced
    let [matrices, forces] = errors(&data, &table, [2, 4, 6, 8], 1000.0 * DENSITY * RADIUS.powi(3));
    assert!(matrices < 0.005 * FRAC_PI_2 && forces < 0.01, "{matrices} {forces}\n{text}");
}

/// The same mesh, frequencies and directions: what LINE kept is taken, and the heave of the free body is that of its coefficients.
#[test]
fn fer_deck_goes_on_from_line_deck_with_what_it_kept() {
    let deck = hemisphere(6, vec![0.7, 0.9, 1.1]);
    let (line, _, kept) = run("ball.dat", &deck.text(LINE));
    let first = database(&line);
    let (mut session, screen, folder) = common::session();
    let own = folder.path().join("ball.ans");
    std::fs::create_dir(&own).unwrap();
    std::fs::copy(kept.path().join("job.ans/S1.nc"), own.join("S1.nc")).unwrap();
    std::fs::write(folder.path().join("ball.dat"), deck.text(LINE)).unwrap();
    let decks: String = (9..=18).map(|number| format!("    {number:02}    NONE\n")).collect();
    let head = "JOB BALL  FER\nTITLE               Panels\nOPTIONS REST END\nRESTART   4  5      ball\n";
    session.open_job("fer.dat", format!("{head}{decks}"));
    session.run();
    let text = screen.text();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    assert!(text.contains("S1.nc: of the same mesh and settings"), "{text}");
    let data = database(&session);
    assert_eq!((&data.added_mass, &data.excitation), (&first.added_mass, &first.excitation));
    // X / (C - w2 (M + A) - i w B) at 0.9 rad/s
    let at = 1;
    let mass = deck.mass * 1000.0;
    // the water plane of the polygon of 24 sides
    let plane = 12.0 * RADIUS * RADIUS * (PI / 12.0).sin();
    let stiffness = 1000.0 * DENSITY * GRAVITY * plane;
    let w = data.frequencies[at];
    let own = Complex::new(stiffness - w * w * (mass + data.added_mass[at][(2, 2)]), -w * data.damping[at][(2, 2)]);
    let heave = (data.excitation[0][at][2] / own).norm();
    let row = text.lines().find(|line| line.contains(" 0.9000 ")).unwrap_or_else(|| panic!("{text}"));
    let near =
        row.split_whitespace().filter_map(|word| word.parse::<f64>().ok()).any(|x| (x / heave - 1.0).abs() < 2e-3);
    assert!(near, "{heave}: {row}");
}

/// What is said of a deck that cannot be run: the message with the text of its place.
fn refused(text: &str) -> Vec<(String, String)> {
    let mut sources = Sources::default();
    let id = sources.add("deck", text, 1);
    let reading = aqwa::read(&sources, id);
    assert!(reading.failed, "{:?}", reading.messages);
    let wrong = reading.messages.iter().filter(|said| said.severity == windlass_base::diagnostic::Severity::Error);
    wrong
        .map(|said| {
            let span = said.span.unwrap();
            (said.message.clone(), text[span.start as usize..span.end as usize].to_string())
        })
        .collect()
}

#[test]
fn wrong_panels_are_refused_by_card_and_side() {
    let deck = hemisphere(3, vec![0.7]);
    let good = deck.text(LINE);
    let card = |number: usize| {
        let wanted = format!("WB Elem Id:{number:5} ");
        good.lines().find(|line| line.contains(&wanted)).unwrap().to_string()
    };
    let groups = |card: &str| card[20..card.find("  WB").unwrap()].to_string();
    let only = |text: String, wanted: &str, place: &str| {
        let found = refused(&text);
        assert!(found.len() == 1 && found[0].0.contains(wanted) && found[0].1.contains(place), "{found:#?}");
    };
    // the panel between the rows, of nodes 6 10 11 7, turned
    let inner = card(4);
    assert_eq!(groups(&inner), "(1)(    6)(   10)(   11)(    7)");
    let turned = inner.replace("(    6)(   10)(   11)(    7)", "(    7)(   11)(   10)(    6)");
    only(good.replace(&inner, &turned), "the panel of nodes 7 11 10 6 faces into the hull", "(    7)(   11)");
    // left out: the four panels around it have a side of their own
    let found = refused(&good.replace(&format!("{inner}\n"), ""));
    assert!(
        found.len() == 4 && found.iter().all(|said| said.0.contains("no other panel has the side from node")),
        "{found:#?}"
    );
    assert!(
        found.iter().any(|said| said.0.contains("from node 6 to node 10, 8.6603 below the water line")),
        "{found:#?}"
    );
    // a panel twice
    let twice = good.replace(&inner, &format!("{inner}\n{inner}"));
    assert!(refused(&twice).iter().any(|said| said.0.contains("this element is given twice")));
    // all of them the other way round
    let all: String = good
        .lines()
        .map(|line| {
            let Some(end) = line.find("  WB") else { return format!("{line}\n") };
            let list: Vec<&str> = line[23..end].split_inclusive(')').collect();
            let turned: String = list.iter().rev().copied().collect();
            format!("{}{turned}{}\n", &line[..23], &line[end..])
        })
        .collect();
    let found = refused(&all);
    assert!(found.len() == 5 && found.iter().all(|said| said.0.contains("faces into the hull")), "{found:#?}");
    // above the water, and in it without DIFF
    let high = good.replace("      SYMX\n", "      SYMX\n      ZLWL          (-2.0)\n");
    let found = refused(&high);
    assert!(
        found.len() == 3
            && found.iter().all(|said| said.0.contains("a DIFF panel reaches 2.0000 above the water line")),
        "{found:#?}"
    );
    only(good.replace(&inner, &inner.replace("DIFF", "    ")), "a panel without DIFF reaches 8.6603 below", "QPPL");
    // nodes on one line
    let flat = inner.replace("(   10)(   11)", "(    6)(    7)");
    assert!(refused(&good.replace(&inner, &flat)).iter().any(|said| said.0.contains("has no area")));
    // nothing to solve for
    let still = good.replace("      FREQ    1    1 0.7000000\n", "");
    only(still, "deck 6: structure 1 has no frequencies", "ELM1");
    only(
        good.replace("      SYMX\n", "      SYMX\n      HYDI         3\n"),
        "3 is no structure before structure 1",
        "3",
    );
    only(good.replace("      SYMX\n", "      SYMX\n      VLID         3\n"), "a lid that takes energy", "VLID");
}
