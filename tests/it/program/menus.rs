//! Menus as scripts use them. A record that should have opened a menu and was refused, in a script: the commands meant
//! for that menu are passed over up to its own `END`, with one message in all. The menus of curves and selectors make what
//! their one-record forms make; what a connector was given is read back; a culled result shows what it showed before.

use crate::common;

use windlass::session::{Session, SessionEnd};

/// What a script prints, its messages, and the session behind it.
struct ScriptRun {
    text: String,
    messages: Vec<String>,
    session: Session,
    end: SessionEnd,
}

fn run_with(script: &str, prepare: impl Fn(&mut Session)) -> ScriptRun {
    let (mut session, screen, _folder) = common::session();
    prepare(&mut session);
    session.open("script", script.to_string());
    let end = session.run();
    session.job.output.flush();
    let text = screen.text();
    let messages = session.reports.iter().map(|r| r.message.clone()).collect();
    ScriptRun { text, messages, session, end }
}

fn run(script: &str) -> ScriptRun {
    run_with(script, |_| {})
}

const MODEL: &str =
    "MEDIT\n*P 0 0 0\n~W B_CAT 4 -LEN 4000 -DEP 500 -BUOY 0 -WTPL .04 -EMOD 12000\nCONNECTOR A ~W *P\nEND\n";
const PASSED: &str = "the commands up to its END are passed over";

/// One error, which says that what follows is passed over, and every menu left.
fn one_error(run: &ScriptRun, message: &str) {
    assert_eq!(run.messages.len(), 1, "{:?}", run.messages);
    assert!(run.messages[0].contains(message), "{:?}", run.messages);
    assert_eq!(run.session.reports[0].help.iter().filter(|h| *h == PASSED).count(), 1, "{:?}", run.session.reports);
    assert_eq!(run.session.job.menus.len(), 1, "{:?}", run.session.job.menus);
}

#[test]
fn refused_table_gives_one_error_and_next_table_is_written() {
    let script =
        "CONN_DESIGN\nTABLE NOPE\nREPORT\nVLIST\nSTORE x\nEND_DISPOSE\nTABLE A\nVIEW X -RECORD 1 1\nEND\nEND\n";
    let run = run(&format!("{MODEL}{script}"));
    one_error(&run, "unknown connector NOPE");
    assert!(run.text.contains("3513.08636"), "{}", run.text);
}

#[test]
fn refused_menu_opener_waits_for_its_end() {
    for (script, message) in [
        ("CONN_DESIGN -FAST\nTABLE A\nREPORT\nCULL X 0 1\nVIEW\nEND\nEND_DISPOSE\nEND_CONN_DESIGN\n", "-FAST"),
        ("MEDIT now\n*Q 1 2 x\n~V WRONG 1\nCONNECTOR B ~V *Q\nEND_MEDIT\n", "takes no further value"),
        ("INMODEL now\n*Q 1 2 x\n~V WRONG 1\nEND_INMODEL\n", "takes no further value"),
        ("CONN_DESIGN\nTABLE A\nCULL Nope 0 1\nVIEW\nEND\nVLIST\nEND\nEND\n", "no column is called Nope"),
        ("CONN_DESIGN\nTABLE A\nCULL X -1E9 1E9\nVIEW\nC_SCALE 2 x\nEND\nEND\nEND\n", "no row is left"),
        ("&REPORT a b c\nTYPE x\nCUTYPE y\nEND_REPORT\n", "takes no further value"),
        ("&DATA CURVS\nC_PROFILE C 0 1\nEND_&DATA\n", "unknown kind of &DATA"),
    ] {
        let run = run(&format!("{MODEL}{script}"));
        one_error(&run, message);
        assert!(!run.session.job.model.points.contains_key("*Q"));
    }
}

#[test]
fn internal_commands_and_macros_run_while_plain_ones_are_skipped() {
    let script = "&MACRO SHOW WHAT\nVIEW %WHAT\n&TYPE shown %WHAT\nCULL X %NONE 1\nEND\n&ENDMACRO\nCONN_DESIGN\nTABLE NOPE\n\
                  &LOOP I 1 2\nVIEW %I\n&TYPE trip %I\n&ENDLOOP\n&IF .TRUE. &THEN\nSHOW me\n&ENDIF\n&SET A = 7\n\
                  &REPORT\nTYPE line of a report\nEND\nVIEW %NONE\nPLOT &NUMBER(REAL 1/0)\nEND\nEND\n&TYPE A is %A\n";
    let run = run(&format!("{MODEL}{script}"));
    one_error(&run, "unknown connector NOPE");
    for text in ["trip 1", "trip 2", "shown me", "line of a report", "A is 7"] {
        assert!(run.text.contains(text), "{text}: {}", run.text);
    }
}

#[test]
fn wrong_internal_command_and_wrong_end_are_still_errors() {
    let script = "CONN_DESIGN\nTABLE NOPE\n&TYPO\nVEIW\nEND_REPORT\nEND\nEND\n";
    let run = run(&format!("{MODEL}{script}"));
    assert_eq!(run.messages.len(), 3, "{:?}", run.messages);
    assert!(run.messages[1].contains("&TYPO") && run.messages[2].contains("END_REPORT does not leave"));
    assert_eq!(run.session.job.menus.len(), 1);
}

#[test]
fn end_of_file_and_finish_end_run_inside_skipped_menu() {
    let open = run(&format!("{MODEL}CONN_DESIGN\nTABLE NOPE\nREPORT\n"));
    assert_eq!((open.end, open.session.errors), (SessionEnd::Done, 1));
    assert_eq!(open.messages[1..], ["the input ends inside menu DISPOSITION, which END_DISPOSE leaves"]);
    let finished = run(&format!("{MODEL}CONN_DESIGN\nTABLE NOPE\nREPORT\n&FINISH\nEND\n"));
    assert_eq!((finished.end, finished.messages.len()), (SessionEnd::Finished, 1));
}

#[test]
fn run_that_stops_at_error_does_not_list_skipped_records() {
    for prepare in [|s: &mut Session| s.job.settings.batch = true, |s: &mut Session| s.job.settings.error_limit = 1] {
        let run = run_with("CONN_DESIGN -FAST\nTABLE A\nEND\nEND\n", prepare);
        assert_eq!((run.end, run.session.errors), (SessionEnd::Finished, 1));
        assert!(!run.session.reports[0].help.iter().any(|h| h == PASSED));
    }
}

#[test]
fn missing_model_file_takes_no_records_from_script() {
    let run = run("&DEVICE -AUXIN nowhere.dat\nINMODEL\nMEDIT\n*P 0 0 0\nEND\n&TYPE &NAMES(POINTS)\n");
    assert!(run.messages.len() == 1 && run.messages[0].contains("does not exist"), "{:?}", run.messages);
    assert!(run.text.contains("*P"), "{}", run.text);
}

#[test]
fn refused_opener_at_prompt_opens_no_menu() {
    let run = run_with(&format!("{MODEL}CONN_DESIGN\nTABLE NOPE\nREPORT\nEND\n"), |s| s.interactive = true);
    assert_eq!(run.messages.len(), 2, "{:?}", run.messages);
    assert!(run.messages[1].contains("unknown command `REPORT`"));
    assert_eq!(run.session.job.menus.len(), 1);
}

#[test]
fn terminal_after_script_runs_every_record() {
    let mut run = run(&format!("{MODEL}CONN_DESIGN\nTABLE NOPE\nREPORT\n"));
    run.session.take_terminal();
    assert_eq!(run.session.job.menu().name(), "CONN_DESIGN");
    run.session.interpreter.open_terminal();
    run.session.interpreter.feed("terminal", "TABLE A", 1);
    assert_eq!(run.session.run(), SessionEnd::NeedLine);
    assert_eq!((run.session.job.menus.len(), run.session.errors), (3, 1));
}

/// A model without the places its parts were written at.
fn without_places(run: &ScriptRun) -> (Vec<String>, Vec<String>) {
    let model = &run.session.job.model;
    let curves = model.curves.values().map(|c| format!("{} {:?} {:?}", c.name, c.kind, c.points)).collect();
    let selectors = model.selectors.values().map(|s| format!("{} {:?} {:?}", s.name, s.select, s.except)).collect();
    (curves, selectors)
}

#[test]
fn curve_menu_gives_curves_of_single_records_in_any_units() {
    let kinds =
        "C_PROFILE P_SPECTRUM F_SPECTRUM M_GROWTH W_HISTORY LT_MULTIPLIER CT_LENGTH EFFICIENCY CS_VELOCITY AM_PRESSURE";
    for units in ["", "&DIMEN -DIMEN METERS M-TONS\n"] {
        // a spectrum has no negative periods
        let first = |kind: &str| if kind.ends_with("SPECTRUM") { "0" } else { "-1" };
        let record = |kind: &str| format!("{kind} N_{kind} {} 2 3/2 4\n", first(kind));
        let menu: String = kinds.split(' ').map(record).collect();
        let single: String = kinds.split(' ').map(|k| format!("&DATA CURVES {}", record(k))).collect();
        let (menu, single) = (run(&format!("{units}&DATA CURVES\n{menu}END\n")), run(&format!("{units}{single}")));
        let of_script = without_places(&menu);
        assert_eq!(of_script.0.len(), 10);
        assert_eq!(of_script, without_places(&single));
        assert_eq!((menu.session.errors, menu.session.job.menus.len()), (0, 1), "{:?}", menu.messages);
    }
}

#[test]
fn selector_menu_gives_selectors_of_single_records() {
    let menu = run("&SELECT\n:B -EXCEPT X -SELECT Y Z\n:A -SEL *M@ :B -EXC *MD\nEND_&SELECT\n");
    let single = run("&SELECT :B -EXCEPT X -SELECT Y Z\n&SELECT :A -SEL *M@ :B -EXC *MD\n");
    assert_eq!((menu.session.errors, menu.session.job.menus.len()), (0, 1), "{:?}", menu.messages);
    assert_eq!(without_places(&menu).1.len(), 2);
    assert_eq!(without_places(&menu), without_places(&single));
}

#[test]
fn connector_offsets_and_angles_are_listed_only_where_given() {
    let model = "MEDIT\n*P 0 0 0\n*Q 9 0 0\n~G GSPR X 100 5\nCONNECTOR A ~G *P *Q\n";
    let none = run(&format!("{model}END\n&STATUS G_CONNECTOR\n"));
    assert!(!none.text.contains("-GO1") && !none.text.contains("-EULER"), "{}", none.text);
    let given = "CONNECTOR B ~G *P *Q -GO1 1 2 3 -GO2 4 5 6 -EULER 10 20 30\nEND\n&STATUS G_CONNECTOR\n";
    let given = run(&format!("{model}{given}"));
    let last = given.text.trim_end().lines().last().unwrap();
    let words: Vec<&str> = last.split_whitespace().collect();
    assert_eq!(words, ["B", "1.00", "2.00", "3.00", "4.00", "5.00", "6.00", "10.00", "20.00", "30.00"]);
}

#[test]
fn inside_cull_every_output_has_previous_output_rows_only() {
    let out = "REPORT X Force\nVIEW X Force\nVLIST\nSTATISTIC X Force\nSET_VARIABLE F Force\n&TYPE forces %F\n";
    let scaled = format!("{MODEL}CONN_DESIGN\nTABLE A\nC_SCALE 2 Force\nC_SHIFT -100 X\n");
    let all = run(&format!("{scaled}CULL Force -9 -1\n&TYPE /cut/\n{out}END\n&TYPE /cut/\n{out}END\nEND\n"));
    let parts: Vec<&str> = all.text.split("/cut/\n").collect();
    assert_eq!(parts[1], parts[2], "all rows kept");
    let rows = "REPORT X Force -RECORD 10 12\nSET_VARIABLE F Force -RECORD 10 12\n&TYPE forces %F\n";
    let few = "CULL Force -1 140 220 1E9\n&TYPE /cut/\nREPORT X Force\nSET_VARIABLE F Force\n&TYPE forces %F\nEND\n&TYPE /cut/\n";
    let some = run(&format!("{scaled}{few}{rows}END\nEND\n"));
    let parts: Vec<&str> = some.text.split("/cut/\n").collect();
    // the notes alone say of which rows they are
    let said = "   of the whole table, by its row numbers before CULL:\n   row 30 is beyond";
    assert!(parts[1].contains(said), "{}", parts[1]);
    assert_eq!(parts[1].replace(said, "   row 30 is beyond"), parts[2], "three rows kept");
}
