//! A line class grows by one record a segment: each is appended to what is there, and one that is refused changes nothing.

use crate::common;

use std::sync::Arc;
use windlass::session::Session;
use windlass_connectors::CLASSES;
use windlass_model::{Class, LineLoads, Placement};

fn session(records: &str) -> Session {
    let (mut session, _screen, _folder) = common::session();
    session.open("records", format!("&DIMEN -DIMEN METERS N\n&ENV -DEPTH 300\nMEDIT\n{records}\n"));
    session.run();
    session
}

fn class(session: &Session) -> &Class {
    session.job.model.classes.values().next_back().unwrap()
}

/// Everything that is known of a class.
fn contents(session: &Session) -> String {
    format!("{:?}", class(session))
}

#[test]
fn class_of_10_000_records_is_built_once() {
    // inextensible, 1000 m between ends of one height, w = 500 N/m: s = S sinh(a)/a with a = w S/(2 H) = 1
    let length = 1000.0 * 1f64.sinh() / 10_000.0;
    let record = format!("~L H_CAT 100 EXACT -LEN {length:.15} -WTPL 500 -EMOD 1E12\n");
    let mut session = session(&record);
    let object = Arc::as_ptr(&class(&session).object).cast::<u8>();
    session.open("more", record.repeat(9_999));
    session.run();
    let class = class(&session);
    assert_eq!(Arc::as_ptr(&class.object).cast::<u8>(), object, "built anew");
    assert_eq!(class.records.len(), 10_000);
    let position = Placement { other: Some([1000.0, 0.0, 0.0]), ..Placement::default() };
    let LineLoads { fairlead, .. } = class.line(&position, &session.job.model.surroundings()).unwrap().loads().unwrap();
    for (got, want) in fairlead.into_iter().zip([250e3, 0.0, -250e3 * 1f64.sinh()]) {
        assert!((got - want).abs() <= 0.01, "{fairlead:?}");
    }
}

#[test]
fn records_appended_singly_match_records_together() {
    let mut segmented = 0;
    for kind in CLASSES {
        let records: Vec<&str> = kind.spec.example.lines().filter(|line| line.starts_with('~')).collect();
        let session = session(&[records.as_slice(), records.as_slice()].concat().join("\n"));
        let class = class(&session);
        if class.object.as_segmented().is_none() {
            continue;
        }
        assert_eq!(class.records.len(), 2 * records.len(), "{}: {:?}", kind.spec.name, session.reports);
        let together = (kind.build)(&class.records).unwrap();
        assert_eq!(format!("{:?}", class.object), format!("{together:?}"), "{}", kind.spec.name);
        segmented += 1;
    }
    assert_eq!(segmented, 6);
}

#[test]
fn refused_record_leaves_its_class_unchanged() {
    for (first, refused, message) in [
        ("~L B_CAT 100 -LEN 500 -DEP 200", "~L B_CAT 80 -LEN 600 -DEP 210", "-DEPANCHOR holds for the whole line"),
        (
            "~L B_CAT 100 -LEN 500 -SEABED 1E4",
            "~L B_CAT 80 -LEN 600 -FRI .5 -SEABED 1E5",
            "-SEABED holds for the whole",
        ),
        ("~L B_CAT 100 EXACT -LEN 500", "~L B_CAT 80 -LEN 600 -FRICTION .5 -TABLE", "EXACT and -TABLE contradict"),
        ("~L B_CAT 100 -LEN 500", "~L B_CAT 80 -FRICTION .5", "B_CAT lacks -LEN"),
        ("~L B_CAT 100 -LEN 500", "~L B_CAT 80 -LEN 9 -PISTON MAX 9 10 20 1 500", "lies beyond its stroke"),
        ("~L H_CAT 100 -LEN 500 -TAB 1E6", "~L H_CAT 80 EXACT -LEN 600 -TAB 2E6", "-TAB_LIM holds for the whole line"),
        ("~L H_CAT 100 -LEN 500", "~L H_CAT 80 EXACT -LEN 600 -CLUMP -5", "class type H_CAT takes no spring buoy"),
        ("~L SL_ELEM 100 -LEN 500 -SEND 1E6", "~L SL_ELEM 80 TENSION -LEN 600 -SEND 2E6", "-SEND holds for the whole"),
        ("~L ROD 300 20 -LEN 500 -CLAMP SECOND", "~L ROD 300 20 -LEN 50 -SLAM -EI 0", "its segment does not bend"),
        ("~L ROD 300 20 -LEN 500 -CLAMP FIRST", "~L ROD 300 20 -LEN 50 -CLAMP BOTH", "the first end is held twice"),
        (
            "~L ROD 300 20 -LEN 500 -SLOPE .1",
            "~L ROD 300 20 -LEN 50 -SLAM -SLOPE .2",
            "-SLOPE holds for the whole line",
        ),
        ("~L CATENARY 170 .02 -LEN 280 -DEP 90", "~L CATENARY 60 .01 -LEN 9 -DEP 80", "-DEPANCHOR holds for the whole"),
        ("~L TETHER 1.1 .035 -LEN 250", "~L TETHER 1.1 .035", "TETHER lacks -LEN"),
    ] {
        let mut session = session(first);
        let before = contents(&session);
        session.open("refused", format!("{refused}\n"));
        session.run();
        assert!(session.reports.iter().any(|r| r.message.contains(message)), "{refused}: {:?}", session.reports);
        assert_eq!(contents(&session), before, "{refused}");
    }
}

#[test]
fn segment_added_to_copied_class_is_not_in_the_copy() {
    let mut session = session("~L B_CAT 100 -LEN 500");
    let copy = session.job.model.clone();
    let before = format!("{:?}", copy.classes.values().next_back().unwrap());
    session.open("more", "~L B_CAT 80 -LEN 600\n");
    session.run();
    assert_eq!(class(&session).fatigue_segments().len(), 2);
    assert_eq!(format!("{:?}", copy.classes.values().next_back().unwrap()), before);
}
