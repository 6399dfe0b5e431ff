//! Names: an environment is reported by its name, a selector follows what is renamed, DELETE says what it did and no more,
//! and `&HELP` states the one rule of names.

use crate::common;

/// What a script prints, and its messages with their help lines.
fn run(script: &str) -> (String, Vec<String>) {
    let (mut session, screen, _folder) = common::session();
    session.open("script", script.to_string());
    session.run();
    session.job.output.flush();
    let text = screen.text();
    let of_names = session.reports.iter().filter(|r| !r.message.contains("solid steel bar"));
    let said = of_names.map(|r| format!("{} {}", r.message, r.help.join(" ")).trim().to_string());
    (text, said.collect())
}

#[test]
fn named_environment_is_reported_and_unknown_one_suggests_nearest() {
    let both = "&ENV STORM -DEPTH 111\n&ENV SWELL -DEPTH 222\n";
    let (storm, said) = run(&format!("{both}&STATUS ENV STORM\n"));
    assert!(storm.contains("S T O R M") && storm.contains("111") && !storm.contains("222"), "{storm}");
    assert!(said.is_empty(), "{said:?}");
    let (force, _) = run(&format!("{both}&STATUS ENV\n"));
    assert!(force.contains("S W E L L") && !force.contains("111"), "{force}");
    let (all, _) = run(&format!("{both}&STATUS ENV S@\n"));
    assert!(all.contains("111") && all.contains("222"), "{all}");
    let (none, said) = run(&format!("{both}&STATUS ENV STROM\n"));
    assert!(none.is_empty(), "{none}");
    assert_eq!(said, ["nothing among ENVIRONMENT is called STROM did you mean STORM?"]);
}

const MODEL: &str =
    "&DESCRIBE BODY B2\nMEDIT\n*PX 0 0 0\n*OTHER 1 0 0\n~L B_CAT 4 -LEN 900 -DEP 100\nCONNECTOR A ~L *PX\n";

#[test]
fn selectors_follow_renamed_parts() {
    let (text, said) = run(&format!(
        "{MODEL}&SELECT :W -SEL *PX\n&SELECT :NOT -SEL *@ -EXCEPT *px\n&SELECT :A -SEL A\nRENAME *PX *PY\nRENAME A K\n\
         &TYPE <&NAMES(POINTS :W)> <&NAMES(POINTS :NOT)> <&NAMES(CONNECTORS :A)>\n"
    ));
    assert!(text.contains("<*PY> <*OTHER> <K>"), "{text} {said:?}");
}

#[test]
fn connectors_pending_in_inmodel_follow_renamed_parts() {
    let (text, said) =
        run("INMODEL\nCONNECTOR A ~W *P\n*P 0 0 0\n~W B_CAT 4 -LEN 900\nRENAME *P *Q\nRENAME ~W ~V\nEND\n\
         &TYPE <&CONNECTOR(CLASS A)> <&CONNECTOR(POINTS A)>\n");
    assert!(text.contains("<~V> <*Q>"), "{text} {said:?}");
}

#[test]
fn refused_deletion_reports_nothing_deleted_and_names_body_once() {
    let (text, said) = run(&format!("{MODEL}DELETE A NOPE\nEND\n&TYPE <&NAMES(CONNECTORS)>\n"));
    assert_eq!((said.len(), text.contains("<A>")), (1, true), "{said:?}");
    assert!(said[0].starts_with("nothing is called NOPE"), "{said:?}");
    let (text, said) = run(&format!("{MODEL}DELETE A\nDELETE B2\nEND\n&TYPE <&NAMES(PARTS)> <&NAMES(POINTS)>\n"));
    assert_eq!(said, ["connector A is deleted", "body B2 is deleted"]);
    assert!(text.contains("<> <>"), "{text}");
}

#[test]
fn deleting_everything_succeeds_whatever_the_references() {
    let (text, said) = run(&format!(
        "{MODEL}&DATA CURVES C_PROFILE CUR 0 1 9 1\n&ENV E -CURRENT CUR 0\n&ENV\n&SELECT :U -SEL X\n&SELECT :T -SEL :U\n\
         DELETE @\n&TYPE <&NAMES(BODIES)&NAMES(CLASSES)&NAMES(CURVES)&NAMES(SELECTORS)&NAMES(ENVIRONMENTS)>\n"
    ));
    assert!(text.contains("<>"), "{text} {said:?}");
}

#[test]
fn help_states_the_name_rule() {
    let (text, _) = run("&HELP\n");
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        text.contains("A name has 1 to 64 characters, a marker (~ class, * point, : selector) among them"),
        "{text}"
    );
    let (text, _) = run("MEDIT\n&HELP DELETE\n&HELP RENAME\n");
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("What is still used is not deleted") && text.contains("what a name may be"), "{text}");
}
