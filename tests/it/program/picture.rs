//! Pictures: what is drawn stands where the model says, and what cannot be drawn is said.

use crate::common;

use common::session;
use windlass_model::{Condition, LineSampling, Model};
use windlass_solve::scene::{Scene, SceneOptions, Sign, Stroke};

const MOORING: &str = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY BARGE\n*BOW 0 0 5\n*STERN 100 0 5\n&INSTATE -CONDITION 0\n\
    ~W B_CAT 100 EXACT -LEN 700 -DEP 120 -BUOY 0 -WTPL 0.5\n\
    CONNECTOR A -ANC 120 600 ~W *BOW\nCONNECTOR B -ANC 0 650 ~W *STERN\nEND\n";

fn run(text: &str) -> (Model, Vec<String>, String, tempfile::TempDir) {
    let (mut session, screen, folder) = session();
    session.open("script", text.to_string());
    session.run();
    let reports = session.reports.iter().map(|r| r.message.clone()).collect();
    (session.job.model.clone(), reports, screen.text(), folder)
}

fn scene(model: &Model) -> (Scene, usize) {
    let choice = SceneOptions { connector: &|_| true, body: &|_| true, stop: &|| false };
    let (scene, unshaped) = Scene::build(model, &choice).unwrap();
    (scene, unshaped.len())
}

#[test]
fn line_picture_runs_from_fairlead_over_touchdown_to_anchor_in_plane() {
    let (model, reports, ..) = run(MOORING);
    assert!(reports.is_empty(), "{reports:?}");
    let (scene, unshaped) = scene(&model);
    assert_eq!((unshaped, scene.bottom), (0, Some(-120.0)));
    let path = scene.paths.iter().find(|p| p.name == "A").unwrap();
    assert_eq!((path.stroke, path.points[0]), (Stroke::Line, [0.0, 0.0, 5.0]));
    // 600 m toward 120 degrees
    let anchor = [-300.0, 600.0 * 0.75f64.sqrt(), -120.0];
    let near = |a: [f64; 3], b: [f64; 3], within: f64| a.iter().zip(b).all(|(p, q)| (p - q).abs() < within);
    assert!(near(*path.points.last().unwrap(), anchor, 1e-6), "{:?}", path.points.last());
    let touchdown = scene.marks.iter().find(|m| m.sign == Sign::Touchdown).unwrap().at;
    assert!(path.points.iter().any(|p| near(*p, touchdown, 1e-9)));
    assert!((touchdown[2] + 120.0).abs() < 1e-6);
    for [x, y, z] in &path.points {
        assert!((y + x * 3f64.sqrt()).abs() < 1e-6 && *z > -120.000_001);
    }
}

#[test]
fn points_between_shape_rows_are_on_the_line() {
    // beside the seabed the hanging part is a catenary: z - z0 = a (cosh((x - x0) / a) - 1) with a = H / w but for its
    // elastic stretch, which a stiff line has little of. A cubic over the arc h between two rows is off by h^4 / 384 of
    // the fourth derivative of z = sqrt(a^2 + s^2) by the arc s, at most 3 / a^3
    let (model, ..) = run(&MOORING.replace("-WTPL 0.5", "-WTPL 0.5 -EMOD 1E9"));
    let (scene, _) = scene(&model);
    let path = scene.paths.iter().find(|p| p.name == "B").unwrap();
    let connector = &model.connectors["B"];
    let line = model.classes["~W"].line(&model.placement(connector), &model.surroundings()).unwrap();
    let table = line.geometry("B", Condition::Placed, LineSampling::Adaptive).unwrap();
    let force = line.configuration(Condition::Placed).unwrap().horizontal;
    let a = force / 500.0;
    let bound = 3.0 * (700.0f64 / 10.0).powi(4) / (384.0 * a.powi(3));
    let touchdown = table.facts.iter().find(|f| f.name == "Touchdown at X").unwrap();
    let x0 = 100.0 + touchdown.value.number().unwrap();
    let hanging: Vec<_> = path.points.iter().filter(|p| p[0] < x0).collect();
    assert!(hanging.len() > 20, "{}", hanging.len());
    for [x, _, z] in hanging {
        let want = a * (((x0 - x) / a).cosh() - 1.0) - 120.0;
        assert!((z - want).abs() < bound, "at {x}: {z}, the catenary {want}");
    }
}

#[test]
fn unsolved_line_is_dashed_and_named() {
    let (model, reports, screen, _) =
        run(&MOORING.replace("END\n", "~T B_CAT 100 EXACT -LEN 700 -DEP 1 -BUOY 0 -WTPL 0.5\n*LOW 50 0 -3\nCONNECTOR C -ANC 90 600 ~T *LOW\nEND\n&PICTURE PLAN\n"));
    let (scene, unshaped) = scene(&model);
    assert_eq!(unshaped, 1);
    assert_eq!(scene.paths.iter().find(|p| p.name == "C").unwrap().stroke, Stroke::Unsolved);
    assert!(reports.iter().any(|r| r.contains("C: dashed between its ends")), "{reports:?}");
    assert!(screen.contains("Plan"));
}

#[test]
fn unsupported_picture_is_reported() {
    for (record, message) in [
        ("&PICTURE PLAN NOBODY", "nothing among what can be drawn is called NOBODY"),
        ("&PICTURE ASKEW", "nothing among what can be drawn is called ASKEW"),
        ("&PICTURE PLAN -FROM 20", "-FROM goes with"),
        ("&PICTURE TOP -EXAGGERATE 2", "no heights"),
        ("&PICTURE -FILE a.jpg", "ends in .svg or .png"),
        ("&PICTURE -FILE a.svg -FORMAT PNG", "does not end in .png"),
        ("&PICTURE -FORMAT TERMINAL -HARD", "goes to no file"),
    ] {
        let (_, reports, _, folder) = run(&format!("{MOORING}{record}\n"));
        assert!(reports.iter().any(|r| r.contains(message)), "{record}: {reports:?}");
        let files = std::fs::read_dir(folder.path().join("job.ans")).map_or(0, |d| {
            d.flatten().filter(|e| e.path().extension().is_some_and(|x| x == "svg" || x == "png")).count()
        });
        assert_eq!(files, 0, "{record}");
    }
    assert!(run("&PICTURE\n").1.iter().any(|r| r.contains("nothing to draw")));
}

#[test]
fn picture_files_are_reproducible_with_names_and_round_scale() {
    let drawn = || {
        let (_, reports, _, folder) = run(&format!("{MOORING}&PICTURE -HARD\n&PICTURE ISO -FORMAT PNG\n"));
        assert!(reports.is_empty(), "{reports:?}");
        let read = |name: &str| std::fs::read(folder.path().join("job.ans").join(name)).unwrap();
        (read("FIGURE1.svg"), read("FIGURE2.png"))
    };
    let (svg, png) = drawn();
    assert_eq!((svg.clone(), png.clone()), drawn());
    let svg = String::from_utf8(svg).unwrap();
    for text in
        ["Plan", "Elevation, seen from -Y", "BARGE", "*STERN", "water surface", "sea bottom", "200 m", "touchdown"]
    {
        assert!(svg.contains(text), "{text} is missing");
    }
    assert!(png.starts_with(b"\x89PNG"));
}

#[test]
fn dynamic_line_picture_has_its_static_nodes() {
    let rod = MOORING
        .replace("B_CAT 100 EXACT", "ROD 100 50 -EI 0 -REFINE 140")
        .replace("-WTPL 0.5", "-WTPL 0.5 -SEABED 1E4");
    let [exact, drawn] = [MOORING, &rod].map(|records| {
        let (model, reports, ..) = run(records);
        assert!(reports.is_empty(), "{reports:?}");
        let (scene, unshaped) = scene(&model);
        assert_eq!(unshaped, 0);
        scene.paths.into_iter().find(|p| p.name == "B").unwrap()
    });
    assert_eq!((drawn.stroke, drawn.points.len()), (Stroke::Pipe, 141));
    // every node lies by the line that hangs as heavy, within what a mesh of 5 m and a soft bottom make of it
    for point in &drawn.points {
        let near = |p: &[f64; 3]| p.iter().zip(point).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
        let across = exact.points.windows(2).map(|w| {
            let along: Vec<f64> = w[1].iter().zip(&w[0]).map(|(b, a)| b - a).collect();
            let square: f64 = along.iter().map(|v| v * v).sum();
            let dot: f64 = along.iter().zip(point.iter().zip(&w[0])).map(|(d, (p, a))| d * (p - a)).sum();
            let t = (dot / square.max(1e-12)).clamp(0.0, 1.0);
            near(&[0, 1, 2].map(|i| w[0][i] + t * along[i]))
        });
        let apart = across.fold(f64::MAX, f64::min).sqrt();
        assert!(apart < 0.3, "{point:?}: {apart}");
    }
}

#[test]
fn pipe_picture_has_pipe_and_supports_where_records_put_them() {
    let (model, ..) = run("&DIMEN -DIMEN METERS K-NTS\n&ENV LAY -DEPTH 50\nMEDIT\n&DESCRIBE BODY BARGE\n\
        *R1 46.82 0 6.58\n*R2 37.97 0 7.92\n*R3 29 0 8.73\n~ROLL ROLLER COMPRESSION Z 20000\n~PIPE ROD 323.9 15.9 -LEN 12\n\
        CONNECTOR R1 ~ROLL *R1\nCONNECTOR R2 ~ROLL *R2\nCONNECTOR R3 ~ROLL *R3\nPIPE ~PIPE R1 R2 R3 -PIPE_TENSION 580 620\nEND\n\
        &INSTATE -LOCATE BARGE 0 0 -3\n");
    let (scene, unshaped) = scene(&model);
    assert_eq!(unshaped, 0);
    let supports: Vec<_> = scene.marks.iter().filter(|m| m.sign == Sign::PipeSupport).map(|m| m.at).collect();
    assert_eq!(supports, [[46.82, 0.0, 3.58], [37.97, 0.0, 4.92], [29.0, 0.0, 5.73]]);
    assert!(scene.marks.iter().all(|m| m.sign != Sign::Anchor && m.sign != Sign::Fairlead));
    let pipe = scene.paths.iter().find(|p| p.stroke == Stroke::Pipe).unwrap();
    // it runs from above the tensioner down to the bottom, half its diameter over it, with the tension of the tensioner
    let (first, last) = (pipe.points[0], *pipe.points.last().unwrap());
    assert!((first[0] - 29.0).abs() < 0.1 && first[2] > 5.7, "{first:?}");
    assert!((last[2] + 50.0).abs() < 0.2, "{last:?}");
    assert!((580.0..=620.0).contains(&(pipe.tensions[0] / 1e3)), "{}", pipe.tensions[0]);
}

/// Width and height of a PNG file (pixels), from its header (bytes 16 to 24).
fn png_size(path: &std::path::Path) -> [u32; 2] {
    let bytes = std::fs::read(path).unwrap();
    [16, 20].map(|at| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()))
}

#[test]
fn plots_and_pictures_are_as_large_as_pixels_says() {
    let (mut session, _screen, folder) = session();
    session.open(
        "records",
        "&DIMEN -DIMEN METERS KN\nMEDIT\n&DESCRIBE BODY SHIP\n*F 0 0 0\n~C B_CAT -TYPE CHAIN_R4 80 -LEN 500 -DEPANCHOR 100\n\
         CONNECTOR A -ANC 0 450 ~C *F\nEND\n&ENV -DEPTH 100\n&PICTURE -FILE small.png -PIXELS 480\n\
         &PICTURE -FILE usual.png\n&PICTURE -FILE large.png -PIXELS 1600\nCONN_DESIGN\nTABLE A\nPLOT X Force -FILE p.png -PIXELS 640 300\n\
         PLOT X Force -FILE q.png -PIXELS 480\nPLOT X Force -FILE r.png\nPLOT X Force -FILE s.svg -PIXELS 480\nEND\nEND\n"
            .to_string(),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let at = |name: &str| folder.path().join("job.ans").join(name);
    assert_eq!(["p.png", "q.png", "r.png"].map(|name| png_size(&at(name))), [[640, 300], [480, 320], [900, 600]]);
    let widths = ["small.png", "usual.png", "large.png"].map(|name| png_size(&at(name))[0]);
    assert_eq!(widths, [480, 1000, 1600]);
    assert!(std::fs::read_to_string(at("s.svg")).unwrap().contains("width=\"480\" height=\"320\""));
    for (record, message) in [
        ("&PICTURE -FILE t.png -PIXELS 20", "WIDTH of -PIXELS of &PICTURE must be"),
        ("&PICTURE -FILE t.png -PIXELS wide", "WIDTH of -PIXELS of &PICTURE must be"),
    ] {
        session.open("record", record.to_string());
        session.run();
        assert!(session.reports.last().unwrap().message.contains(message), "{record}: {:?}", session.reports.last());
        assert!(!at("t.png").exists());
    }
}
