//! What follows from a refused record: one line each, none in a check, and the model without what was refused.

use crate::common;
use std::process::Command;

/// The messages of a script, those with a place of their own apart from those of one line.
fn messages(script: &str) -> (Vec<String>, Vec<String>) {
    let (mut session, _screen, _folder) = common::session();
    session.open("s", script.to_string());
    session.run();
    let errors = session.reports.iter().filter(|r| r.severity == windlass_base::diagnostic::Severity::Error);
    let (placed, lines): (Vec<_>, Vec<_>) = errors.partition(|r| r.span.is_some());
    let texts = |list: Vec<&windlass_base::diagnostic::Diagnostic>| list.iter().map(|r| r.message.clone()).collect();
    (texts(placed), texts(lines))
}

/// A hull with a wrong section, and what would need it.
const HULL: &str = "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY B\nPGEN\nPLANE 0 91.5 -RECT 0 6.1 27.5 -FOO\nEND\nEND\n\
                    &INSTATE -CONDITION 2\n&WEIGHT -COMPUTE 5 10 25 25\n&EQUI\nHSTATICS\nCFORM 2 0 0 -DRAFT 1 2\nREPORT\nEND\nMOMENT\nREPORT\nEND\nEND\n";

#[test]
fn hull_whose_section_was_refused_has_one_error() {
    let (errors, lines) = messages(HULL);
    assert_eq!(errors, ["unknown option of PLANE `-FOO`"]);
    let done: Vec<_> = lines.iter().filter_map(|line| line.split(' ').nth(1)).collect();
    assert_eq!(done, ["&WEIGHT", "&EQUI", "CFORM", "MOMENT"], "{lines:?}");
    assert!(
        lines.iter().all(|line| line.contains("not computed is PLANE of B") && line.ends_with("(s:5:31)")),
        "{lines:?}"
    );
    // the same hull, mended at the end of the script, floats: nothing of the first is left but what stops solves
    let mended = format!(
        "{HULL}MEDIT\n&DESCRIBE BODY B\nPGEN\nPLANE 0 91.5 -RECT 0 6.1 27.5\nEND\nEND\n&PARAMETER -ACCEPT_MISSING YES\n&INSTATE -CONDITION B 2\n"
    );
    let displaced = common::function_values(&mended, "&BODY(DISPLACE B)")[0];
    assert!((displaced - 1.025 * 91.5 * 27.5 * 2.0).abs() < 1e-6, "{displaced}");
}

#[test]
fn names_of_refused_records_are_missed_in_one_line() {
    let (errors, lines) = messages(
        "&DIMEN -DIMEN METERS M-TONS\nINMODEL\n&SURFACE\nBLOCK A 0 0 0 10 10 10\nCOPY_BLOCK A B -FOO\nUNION U A B\nEND\n\
         &DESCRIBE BODY SHIP -FOO\n*CG 0 0 5\n#WEIGHT *CG 100 1 1 1\n*P 1 1 x\n~W B_CAT 76 -LEN 600 -DEP 50\nCONNECTOR L1 -ANC 180 580 ~W *P\nEND\n\
         &EQUI\n&STATUS B_W SHIP\n",
    );
    assert_eq!(errors.len(), 3, "{errors:?}");
    for (line, head, why) in [
        (0, "s:6:1: UNION", "the record of B at s:5:1 was refused"),
        (1, "s:10:1: #WEIGHT", "the record of its body at s:8:1 was refused"),
        (2, "s:13:30: a record that names it", "the record of *P at s:11:1 was refused"),
        (3, "s:15:1: &EQUI", "the record of its body at s:8:1 was refused"),
        (4, "s:16:1: &STATUS", "the record of SHIP at s:8:1 was refused"),
    ] {
        assert!(lines[line].starts_with(head) && lines[line].ends_with(why), "{line}: {lines:?}");
    }
    assert_eq!(lines.len(), 5, "{lines:?}");
    // a name that no record was to define is an error as ever, and a wrong word that comes twice is said twice
    let (errors, lines) = messages("&EQUI -IGNORE NOPE X\n&EQUI -IGNORE NOPE X\n&EQUI -OMEGA 3\n&EQUI -OMEGA 3\n");
    assert_eq!((errors.len(), lines.len()), (4, 0), "{errors:?} {lines:?}");
}

#[test]
fn solve_that_stops_again_says_so_in_one_line() {
    let cart =
        "MEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C 100 1 1 1\n#TANKER 240\nEND\n";
    let (errors, lines) = messages(&format!("{cart}&EQUI\n&EQUI\n"));
    assert!(errors.len() == 1 && errors[0].contains("not computed is #TANKER 240 (wind and current"), "{errors:?}");
    assert!(lines.len() == 1 && lines[0].starts_with("s:9:1: &EQUI is not done: the solve stops"), "{lines:?}");
}

#[test]
fn check_lists_refused_records_and_counts_what_follows() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("m.cif"), HULL).unwrap();
    let mut program = Command::new(env!("CARGO_BIN_EXE_windlass"));
    let done = program.args(["check", "--compat", "m.cif"]).current_dir(folder.path()).output().unwrap();
    let text = String::from_utf8(done.stdout).unwrap();
    let listed = text.split_once("These are refused:\n").unwrap_or_else(|| panic!("{text}")).1;
    let listed: Vec<_> = listed.lines().take_while(|line| !line.is_empty()).map(str::trim).collect();
    assert_eq!(listed, ["m.cif:5:1  PLANE 0 91.5 -RECT 0 6.1 27.5 -FOO"]);
    assert!(text.contains("1 more are not done, for want of what refused records would have made"), "{text}");
    assert_eq!(done.status.code(), Some(1));
}
