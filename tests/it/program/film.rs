//! Films of runs: what a page and a series hold is what the run did, whole, and within its bounds.

use crate::common;

use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use windlass::session::Session;
use windlass_solve::film::{Film, FilmSelection, MAX_FRAMES};

/// A box with a hull on two chains, away from rest; the chain `B` is let go at 3 s.
const MOORED: &str = "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100 -TIME 6 0.2\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE Z RX RY\n*CG 0 0 0\n\
    #WEIGHT *CG 50000 10 20 20\nPGEN HULL -PERM 1\nPLANE -20 20 -RECTANGLE -4 4 12\nEND PGEN\n*A 20 0 0\n*B -20 0 0\n\
    ~CHAIN B_CAT 100 EXACT -LEN 400 -DEPANCHOR 100\nCONNECTOR A -ANC 0 370 ~CHAIN *A\nCONNECTOR B -ANC 180 370 ~CHAIN *B\nEND\n\
    &INSTATE -LOCATE SHIP 5 2 0 0 0 3\n&ACTION GONE -AT 3 -RELEASE B\nTDOM\n";

fn run(records: &str) -> (Session, tempfile::TempDir, PathBuf) {
    let (mut session, _, folder) = common::session();
    session.open("test", records.to_string());
    session.run();
    let job = folder.path().join("job.ans");
    (session, folder, job)
}

/// The data of a page.
fn data(page: &str) -> Value {
    let begin = page.find("id=\"data\">").unwrap() + 10;
    let end = begin + page[begin..].find("</script>").unwrap();
    serde_json::from_str(&page[begin..end]).unwrap()
}

/// The bytes of base64, by the alphabet of RFC 4648.
fn bytes(value: &Value) -> Vec<u8> {
    let letters: Vec<u8> = (b'A'..=b'Z').chain(b'a'..=b'z').chain(b'0'..=b'9').chain(*b"+/").collect();
    let mut out = Vec::new();
    let (mut held, mut bits) = (0u32, 0);
    for letter in value.as_str().unwrap().bytes().take_while(|l| *l != b'=') {
        held = held << 6 | letters.iter().position(|l| *l == letter).unwrap() as u32;
        bits += 6;
        if bits >= 8 {
            bits -= 8;
            out.push((held >> bits & 255) as u8);
        }
    }
    out
}

fn doubles(value: &Value) -> Vec<f64> {
    bytes(value).chunks_exact(8).map(|c| f64::from_le_bytes(c.try_into().unwrap())).collect()
}

fn singles(value: &Value) -> Vec<f64> {
    bytes(value).chunks_exact(4).map(|c| f64::from(f32::from_le_bytes(c.try_into().unwrap()))).collect()
}

fn shorts(value: &Value) -> Vec<f64> {
    bytes(value).chunks_exact(2).map(|c| f64::from(u16::from_le_bytes([c[0], c[1]]))).collect()
}

#[test]
fn film_page_holds_every_instant_with_bodies_and_lines_in_place() {
    let (session, _folder, job) = run(&format!("{MOORED}&ANIMATE run"));
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let data = data(&fs::read_to_string(job.join("run.html")).unwrap());
    let history = &session.job.run.as_ref().unwrap().history;
    assert_eq!(doubles(&data["times"]), history.times());
    let body = &data["bodies"][0];
    let poses = singles(&body["poses"]);
    assert_eq!((body["name"].as_str().unwrap(), poses.len(), history.len()), ("SHIP", 7 * 31, 31));
    let at = history.layout.body(0);
    for (row, pose) in [(0, &poses[..7]), (30, &poses[7 * 30..])] {
        let position = &history.rows().nth(row).unwrap()[at..at + 6];
        // numbers of 32 bits have 24 of their own: 6e-8 of their size
        assert!(pose.iter().zip(&position[..3]).all(|(p, q)| (p - q).abs() <= 6e-8 * q.abs()), "{pose:?} {position:?}");
        let half = 0.5 * position[5];
        assert!((pose[5] - half.sin()).abs() < 1e-7 && (pose[6] - half.cos()).abs() < 1e-7, "{pose:?} {position:?}");
    }
    // twelve triangles of a box of 40 by 12 by 8 m
    assert_eq!(bytes(&body["triangles"]).len(), 12 * 3 * 4);
    let corners = singles(&body["points"]);
    assert!(corners.chunks(3).all(|c| c[0].abs() <= 20.0 && c[1].abs() <= 6.0 && c[2].abs() <= 4.0));
    let [low, high] = ["low", "high"].map(|k| [0, 1, 2].map(|i| data[k][i].as_f64().unwrap()));
    let line = &data["lines"][0];
    let (points, tensions) = (shorts(&line["points"]), shorts(&line["tensions"]));
    assert_eq!((points.len(), tensions.len()), (31 * 40 * 3, 31 * 40));
    let last = history.rows().last().unwrap();
    let (sin, cos) = last[at + 5].sin_cos();
    let ends = [[last[at] + 20.0 * cos, last[at + 1] + 20.0 * sin, last[at + 2]], [390.0, 0.0, -100.0]];
    for (end, first) in ends.iter().zip([30 * 40 * 3, 31 * 40 * 3 - 3]) {
        for (i, want) in end.iter().enumerate() {
            let step = (high[i] - low[i]) / 65535.0;
            let found = low[i] + step * points[first + i];
            assert!((found - want).abs() <= 0.51 * step + 1e-9, "{found} {want}");
        }
    }
    // the tension at the fairlead is that of the run, to a step of the page and what the step of the run left
    let most = data["tension"].as_f64().unwrap();
    let at = history.layout.wrench(0, 0).unwrap();
    let pull = last[at..at + 3].iter().map(|v| v * v).sum::<f64>().sqrt();
    assert!((tensions[30 * 40] / 65535.0 * most - pull).abs() < most / 65535.0 + 1e-6 * pull);
    let states = bytes(&data["lines"][1]["states"]);
    assert_eq!((states[14], states[16], states.len()), (1, 0, 31));
}

#[test]
fn film_page_fetches_nothing_and_is_well_formed_with_any_title() {
    let (session, _folder, job) =
        run(&format!("{MOORED}&ANIMATE run -HEADING '</script><b>& <!-- \\ {{{{ 7 }}}}' -EVENTS 0 6 2"));
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let page = fs::read_to_string(job.join("run.html")).unwrap();
    for word in ["http", "src=", "href=", "import ", "import(", "fetch(", "url("] {
        assert!(!page.contains(word), "{word}");
    }
    assert!(data(&page)["title"].as_str().unwrap().starts_with("</script><b>& <!--"));
    assert_eq!(page.matches("<script").count(), page.matches("</script>").count());
    let mut open: Vec<String> = Vec::new();
    let mut rest = page.as_str();
    while let Some(at) = rest.find('<') {
        let end = at + rest[at..].find('>').unwrap();
        let tag = &rest[at + 1..end];
        rest = &rest[end + 1..];
        let name = tag.trim_start_matches('/').split_whitespace().next().unwrap().to_string();
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name));
        } else if !["!DOCTYPE", "meta", "input"].contains(&name.as_str()) {
            if ["script", "style"].contains(&name.as_str()) {
                // their text is no markup
                rest = &rest[rest.find(&format!("</{name}>")).unwrap()..];
            }
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

#[test]
fn film_beyond_limits_is_thinned_evenly_with_a_note() {
    let (mut session, ..) = run(MOORED);
    let run = session.job.run.as_mut().unwrap();
    let width = run.history.layout.width;
    let first: Vec<f64> = run.history.values[..width].to_vec();
    run.history.values = (0..5001)
        .flat_map(|n| {
            let mut row = first.clone();
            row[0] = 0.1 * f64::from(n);
            row
        })
        .collect();
    let all = |_: &str| true;
    let take = FilmSelection { connector: &|_| false, body: &all, window: None, points: 40, stop: &|| false };
    let film = Film::build(run, &take).unwrap();
    assert!(film.times.len() <= MAX_FRAMES && film.times.len() == 1667, "{}", film.times.len());
    assert!(film.notes[0].contains("one in 3 of 5001"), "{:?}", film.notes);
    let stopped = Film::build(run, &FilmSelection { stop: &|| true, ..take });
    assert_eq!(stopped.unwrap_err().to_string(), "interrupted");
}

#[test]
fn film_series_has_a_file_per_instant_and_lists_their_times() {
    let (session, _folder, job) = run(&format!("{MOORED}&ANIMATE run.vtk -EVENTS 0 6 1.5 -POINTS 9"));
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let list: Value = serde_json::from_str(&fs::read_to_string(job.join("run.vtk.series")).unwrap()).unwrap();
    let files = list["files"].as_array().unwrap();
    let times: Vec<f64> = files.iter().map(|f| f["time"].as_f64().unwrap()).collect();
    assert_eq!(times, [0.0, 1.5, 3.0, 4.5, 6.0]);
    for (n, file) in files.iter().enumerate() {
        let text = fs::read_to_string(job.join(file["name"].as_str().unwrap())).unwrap();
        assert!(text.starts_with("# vtk DataFile Version 3.0\n") && text.contains("\nASCII\nDATASET POLYDATA\n"));
        let lines = if n < 2 { 2 } else { 1 };
        assert!(text.contains(&format!("LINES {lines} {}\n9 0 1", 10 * lines)), "{n}: {text}");
        assert!(text.contains("POLYGONS 12 48\n") && text.contains(&format!("CELL_DATA {}\n", lines + 12)));
        let points: usize = text.split("POINTS ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
        let values: Vec<f64> = text
            .split("SCALARS tension_N double 1\nLOOKUP_TABLE default\n")
            .nth(1)
            .unwrap()
            .lines()
            .map_while(|l| l.parse().ok())
            .collect();
        assert_eq!(values.len(), points);
        assert!(values[..9 * lines].iter().all(|t| *t > 1e4) && values[9 * lines..].iter().all(|t| *t == 0.0));
    }
}

#[test]
fn invalid_film_is_refused_and_leaves_no_file() {
    for (records, want) in [
        ("&ANIMATE a.html", "there is no run yet"),
        (&format!("{MOORED}&ANIMATE a.avi"), "ends in .html or .vtk"),
        (&format!("{MOORED}&ANIMATE a.html -EVENTS 7 9"), "chooses none of the instants"),
        (&format!("{MOORED}&ANIMATE a.html -EVENTS 0 6 1E-9"), "more than two million"),
        (&format!("{MOORED}&ANIMATE a.html NOBODY"), "is called NOBODY"),
        (&MOORED.replace("TDOM\n", "TDOM -STATISTICS\n&ANIMATE a.vtk"), "the run kept no instants"),
    ] {
        let (session, _folder, job) = run(records);
        assert!(session.reports.iter().any(|r| r.message.contains(want)), "{want}: {:?}", session.reports);
        assert!(!job.join("a.html").exists() && !job.join("a_0000.vtk").exists());
    }
}

/// A rod that is let go at 2 s, and one that is moved, on a vessel in waves.
const RODS: &str = "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100 -TIME 6 0.2 -SEA REGULAR 180 3 7\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE Z RX RY RZ\n\
    *CG 0 0 0\n#WEIGHT *CG 50000 10 20 20\n*A 20 0 0\n*B -20 0 0\n~ROD ROD 100 50 -LEN 400 -REFINE 30 -EI 0\n\
    CONNECTOR A -ANC 0 370 ~ROD *A\nCONNECTOR B -ANC 180 370 ~ROD *B\nEND\n&ACTION GONE -AT 2 -RELEASE B\n";

#[test]
fn film_shows_dynamic_line_nodes_and_released_line_falls() {
    let (session, ..) = run(&format!("{RODS}TDOM\n"));
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let run = session.job.run.as_ref().unwrap();
    let take = FilmSelection { connector: &|_| true, body: &|_| true, window: None, points: 31, stop: &|| false };
    let film = Film::build(run, &take).unwrap();
    assert_eq!(film.times, run.history.times());
    for (strand, link) in film.strands.iter().zip(&run.history.layout.links) {
        let along = link.along.as_ref().unwrap();
        assert!(strand.line && strand.count == 31);
        // elements are alike, so that 31 points are the 31 nodes
        for (frame, row) in run.history.rows().enumerate() {
            for ((_, node), (n, point)) in along.nodes(row).zip(strand.points_at(frame).iter().enumerate()) {
                let apart = node.position.iter().zip(point).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                assert!(apart < 1e-6, "{} {frame} {n}: {apart}", strand.name);
                assert!(
                    (strand.tensions[31 * frame + n] - node.effective).abs() < 1e-6 * node.effective.abs().max(1e6)
                );
            }
        }
    }
    // let go at 2 s, B falls; A is held
    let first = |name: &str, frame: usize| film.strands.iter().find(|s| s.name == name).unwrap().points_at(frame)[0];
    assert!(first("B", 10)[2] > -1e-6 && first("B", 30)[2] < -10.0);
    assert!(first("A", 30)[2].abs() < 1e-6);
    assert!(film.notes.iter().all(|n| !n.contains("is not shown")), "{:?}", film.notes);
}

#[test]
fn film_of_line_without_stored_nodes_reports_it() {
    let (session, ..) = run(&format!("{RODS}TDOM -ALONG 0\n"));
    let run = session.job.run.as_ref().unwrap();
    let take = FilmSelection { connector: &|_| true, body: &|_| true, window: None, points: 31, stop: &|| false };
    let film = Film::build(run, &take).unwrap();
    for name in ["A", "B"] {
        assert!(
            film.notes.iter().any(|n| n.starts_with(&format!("{name} is not shown as it moved"))),
            "{:?}",
            film.notes
        );
    }
}
