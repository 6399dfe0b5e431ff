//! A session that a program calls.

use std::sync::atomic::Ordering;
use windlass::hosted::{HostMessage, HostSettings, HostView, HostedSession, columns, plot, text};
use windlass::report::stored::ColumnValues;
use windlass_base::diagnostic::Severity;

/// A chain of 1 kN/m that does not stretch, in 100 m of water.
const CHAIN: &str = "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY BUOY -IGNORE Z RX RY RZ\n*CG 0 0 0\n*F 0 0 0\n\
    #WEIGHT *CG 100 2 2 2\n~W B_CAT 100 -LEN 300 -WTPLEN 1 -EMODULUS 1E12 -BUOYDIAMETER 0 -DEPANCHOR 100\n\
    CONNECTOR A -ANC 0 250 ~W *F\nEND\n";

fn session() -> (HostedSession, tempfile::TempDir) {
    let folder = tempfile::tempdir().unwrap();
    (HostedSession::new(HostSettings { root: folder.path().join("job"), ..HostSettings::default() }), folder)
}

fn refused(session: &mut HostedSession, records: &str) -> HostMessage {
    session.run(records, None).error.unwrap()
}

#[test]
fn hosted_tables_hold_numbers_of_the_catenary() {
    let (mut session, _folder) = session();
    assert_eq!(session.run(CHAIN, None).error, None);
    let made = session.run("CONN_DESIGN\nTABLE A", None);
    assert_eq!((made.error, session.menu()), (None, "DISPOSITION"));
    let [kept] = made.tables.as_slice() else { panic!("{} tables", made.tables.len()) };
    let stored = columns(kept);
    let numbers = |head: &str| match &stored.iter().find(|column| column.head == head).unwrap().values {
        ColumnValues::Numbers(list) => list.iter().map(|value| value.unwrap()).collect::<Vec<_>>(),
        other => panic!("{other:?}"),
    };
    let (force, tension, grounded) = (numbers("Force (kN)"), numbers("Ten Top (kN)"), numbers("Line on Bottom (m)"));
    let mut compared = 0;
    for ((h, t), ground) in force.iter().zip(&tension).zip(&grounded).filter(|(_, ground)| **ground > 0.0) {
        // of an inextensible line on a bottom T = H + w z and s^2 = z^2 + 2 z H / w
        assert!((t - (h + 100.0)).abs() < 1e-6 * t, "{t} at {h}");
        let suspended = (100.0f64 * 100.0 + 200.0 * h).sqrt();
        assert!((300.0 - suspended - ground).abs() < 1e-3, "{ground} at {h}");
        compared += 1;
    }
    assert!(compared > 5);
    assert!(text(kept).contains("Ten Top"));
    assert!(plot(kept, &["2".into(), "4".into()]).unwrap().starts_with("<svg"));
    // without names: X, and the columns of the two units that come first behind it
    let all = plot(kept, &[]).unwrap();
    assert!(all.contains("Force (kN)") || all.contains("Horizontal: Force"));
    assert!(all.contains("DF/DX") && !all.contains("Crit. Seg"));
    assert!(plot(kept, &["Tensoin".into()]).unwrap_err().to_string().contains("Tensoin"));
    // what is shown is said once: the next call has its own tables
    assert!(session.run("END\nEND", None).tables.is_empty());
}

#[test]
fn hosted_call_stops_at_first_error_and_session_goes_on() {
    let (mut session, _folder) = session();
    let said = refused(&mut session, "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH deep\n&SET A = 1\nNONSENSE");
    assert_eq!((said.line, said.column, said.word.as_deref()), (Some(2), Some(13), Some("deep")));
    assert_eq!((said.severity, said.source.as_deref()), (Severity::Error, Some("call 1")));
    assert!(said.rendered.contains("^^^^") && said.rendered.contains("call 1:2:13"), "{}", said.rendered);
    // the record before it acted, those behind it did not
    assert_eq!(session.variable("A"), None);
    assert!(session.units().contains("Meters"));
    assert_eq!(session.run("&ENV -DEPTH 100\n&SET A = 2", Some("cell 3")).error, None);
    assert_eq!(session.variable("A").as_deref(), Some("2"));
    // a menu stays open between calls, and a block that is not closed is an error of its call
    session.run("MEDIT", None);
    assert_eq!(session.menu(), "MEDIT");
    session.run("END", None);
    assert!(refused(&mut session, "&IF 1 .GT. 0").is_block_error());
    assert_eq!(session.run("&SET B = 3", None).error, None);
    let missing = session.run_file(std::path::Path::new("/no/such/file.cif")).error.unwrap();
    assert!(missing.message.contains("/no/such/file.cif"));
}

trait BlockError {
    fn is_block_error(&self) -> bool;
}

impl BlockError for HostMessage {
    fn is_block_error(&self) -> bool {
        self.severity == Severity::Error && self.line.is_some()
    }
}

#[test]
fn hosted_picture_and_film_are_drawn_or_say_what_is_missing() {
    let (mut session, _folder) = session();
    assert!(session.picture(&[HostView::Plan]).is_err());
    session.run(CHAIN, None);
    let picture = session.picture(&[HostView::Plan, HostView::Elevation(-1.5)]).unwrap();
    assert!(picture.starts_with("<svg") && picture.contains("BUOY"));
    assert!(session.film().unwrap_err().to_string().contains("TDOM makes one"));
    assert_eq!(session.run("&ENV -TIME 2 0.1\n&INSTATE -LOCATE BUOY 1\nTDOM", None).error, None);
    let (page, _) = session.film().unwrap();
    assert!(page.contains("<html") && page.contains("BUOY"));
}

#[test]
fn hosted_call_is_interrupted_by_its_flag() {
    let (mut session, _folder) = session();
    session.run(CHAIN, None);
    let flag = session.interrupt_flag();
    // a call takes the flag back before it begins: it is for the call that runs
    flag.store(true, Ordering::Relaxed);
    assert!(!session.run("&SET A = 1", None).interrupted);
    let running = std::thread::spawn(move || {
        while std::sync::Arc::strong_count(&flag) > 1 {
            flag.store(true, Ordering::Relaxed);
            std::thread::yield_now();
        }
    });
    let ended = session.run("&LOOP I 1 1000000\n&SET A = %I%\n&ENDLOOP", None);
    assert!(ended.interrupted && ended.error.is_some_and(|error| error.message.contains("interrupted")));
    drop(session);
    running.join().unwrap();
}

#[test]
fn hosted_remarks_and_verdict_are_of_the_call() {
    let (mut session, _folder) = session();
    session.run(CHAIN, None);
    // 3250 kN of tension in a chain whose break is given as 50 kN
    let weak = "MEDIT\n~V B_CAT 100 -LEN 300 -WTPLEN 1 -B_TENSION 50 -DEPANCHOR 100\nCONNECTOR B -ANC 90 250 ~V *F\nEND\n&STATUS F_CONNECTOR";
    let made = session.run(weak, None);
    assert_eq!(made.error, None);
    assert!(made.over_break.iter().any(|text| text.contains('B')), "{:?}", made.over_break);
    assert!(session.run("&SET A = 1", None).over_break.is_empty());
    let finished = session.run("&SET A = 2\n&FINISH\n&SET A = 3", None);
    assert!(finished.finished && finished.error.is_none());
    assert_eq!(session.variable("A").as_deref(), Some("2"));
}
