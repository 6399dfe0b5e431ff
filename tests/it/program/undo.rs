//! Records taken back and a session written as a script: the models are compared in full.

use windlass::commands::undo::UndoStates;
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::{Session, SessionEnd};

/// A session in a folder, as at a terminal.
fn session(folder: &std::path::Path, root: &str) -> Session {
    let job = JobFolder::new(folder.join(root), None, false);
    let mut session = Session::new(Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false));
    session.keep_reports = true;
    session
}

/// Types records, as the terminal does: the state is taken before each.
fn type_records(session: &mut Session, records: &str) {
    if session.job.undo.is_none() {
        session.take_terminal();
        session.interpreter.open_terminal();
        session.job.undo = Some(UndoStates::default());
    }
    for line in records.lines() {
        assert_eq!(session.run(), SessionEnd::NeedLine);
        UndoStates::take(&mut session.job);
        session.interpreter.feed("terminal", line, 1);
    }
    assert_eq!(session.run(), SessionEnd::NeedLine);
    UndoStates::take(&mut session.job);
}

/// All of a model and the units, without the places of words in their texts.
fn whole_model(session: &Session) -> String {
    let text = format!("{:?} {:?}", session.job.model, session.job.units);
    let mut bare = String::new();
    let mut rest = text.as_str();
    while let Some((before, after)) = rest.split_once("Span {") {
        bare.push_str(before);
        rest = after.split_once('}').map_or("", |(_, after)| after);
    }
    bare + rest
}

const MODEL: &str = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY SEMI -IGNORE Z RX RY RZ\n*CG 0 0 0\n#WEIGHT *CG 30000 20 20 20\n\
                     ~W B_CAT 100 -LEN 700 -DEP 150\nCONNECTOR A -ANC 0 650 ~W *CG\nCONNECTOR B -ANC 120 650 ~W *CG\n\
                     CONNECTOR C -ANC -120 650 ~W *CG\nEND\n&INSTATE -LOCATE SEMI 5 3\n&EQUI\n&ENV STORM -SEA ISSC 180 6 10";

#[test]
fn undone_record_leaves_model_as_it_was_to_the_last_bit() {
    let folder = tempfile::tempdir().unwrap();
    let mut s = session(folder.path(), "job");
    type_records(&mut s, MODEL);
    let before = whole_model(&s);
    for record in [
        "MEDIT\n*Q 1 2 3",
        "&ENV STORM -CURRENT 1 90",
        "&DIMEN -DIMEN FEET KIPS",
        "&INSTATE -LOCATE SEMI 9 9",
        "&CONNECTOR A -INACTIVE",
        "&INSTATE -LOCATE SEMI 9 9\n&EQUI\n&UNDO",
    ] {
        type_records(&mut s, record);
        assert_ne!(whole_model(&s), before, "{record}");
        type_records(&mut s, "&UNDO");
        assert_eq!(whole_model(&s), before, "{record}");
    }
    assert_eq!(s.errors, 0, "{:?}", s.reports);
}

#[test]
fn saved_session_replayed_makes_the_same_model_without_undone_records() {
    let folder = tempfile::tempdir().unwrap();
    let mut s = session(folder.path(), "job");
    type_records(&mut s, MODEL);
    type_records(
        &mut s,
        "MEDIT\n*BAD 7 7 7\n&UNDO\n&LOOP I 1 3\n*Q%I% %I% 0.1 0\n&ENDLOOP\nEND\n&DIMEN -DIMEN FEET KIPS\nMEDIT\n*R 10 20 30\nEND\n&EQUI\n&SAVE again.cif",
    );
    assert_eq!(s.errors, 0, "{:?}", s.reports);
    let script = std::fs::read_to_string(folder.path().join("job.ans/again.cif")).unwrap();
    assert!(script.contains("*Q3 3 0.1 0") && !script.contains("*BAD") && !script.contains("&UNDO"), "{script}");
    let mut again = session(folder.path(), "again");
    again.open("again.cif", script);
    assert_eq!(again.run(), SessionEnd::Done);
    assert_eq!(again.errors, 0, "{:?}", again.reports);
    assert_eq!(whole_model(&again), whole_model(&s));
}

#[test]
fn undo_in_script_and_past_the_start_is_refused_and_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut script = session(folder.path(), "script");
    script.open("script", "MEDIT\n*P 0 0 0\n&UNDO\n");
    script.run();
    assert_eq!(script.errors, 1);
    assert!(script.reports.iter().any(|r| r.message.contains("at the terminal alone")));
    assert_eq!(script.job.model.points.len(), 1);
    let mut typed = session(folder.path(), "typed");
    type_records(&mut typed, "MEDIT\n*P 0 0 0\n&UNDO\n&UNDO");
    assert!(typed.reports.iter().any(|r| r.message.contains("nothing is left to take back")), "{:?}", typed.reports);
    assert!(typed.job.model.points.is_empty());
}

#[test]
fn the_last_hundred_changes_can_be_taken_back() {
    let folder = tempfile::tempdir().unwrap();
    let mut s = session(folder.path(), "job");
    type_records(&mut s, "MEDIT");
    let points: String = (0..120).map(|n| format!("*P{n} {n} 0 0\n")).collect();
    type_records(&mut s, points.trim_end());
    type_records(&mut s, "&UNDO\n".repeat(100).trim_end());
    assert_eq!((s.job.model.points.len(), s.errors), (20, 0));
    type_records(&mut s, "&UNDO");
    assert!(s.reports.iter().any(|r| r.message.contains("no earlier record is kept")), "{:?}", s.reports);
    assert_eq!(s.job.model.points.len(), 20);
}

#[test]
fn unknown_opener_in_script_gives_one_error_and_its_records_are_passed_over() {
    let folder = tempfile::tempdir().unwrap();
    let mut s = session(folder.path(), "job");
    s.open(
        "job",
        "MEDIT\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C 100 1 1 1\n*G 0 0 0\n~S GSPR BOTH X 40 1000 -LEN 0\n\
         CONNECTOR K ~S *C *G\nEND\n&ENV -TIME 1 0.1\nTDOM\nPRCPOST\nREL_MOTOIN *C *G\nREPORT\nEND\nTRAJECTORY\nREPORT\nEND\nEND\n\
         CONN_DESING\nPROPERTIES\nEND\n&TYPE MAIN is open\n",
    );
    s.run();
    assert_eq!(s.errors, 2, "{:?}", s.reports);
    assert_eq!(s.job.menus.len(), 1);
}
