//! What MOSES has and windlass does not: one message each, no cascade, and what would change a result stops the next solve.

use crate::common;
use windlass_base::diagnostic::Severity;

/// What a script prints, and its messages with how serious they are.
fn run(script: &str) -> (String, Vec<(Severity, String)>) {
    let (mut session, screen, _folder) = common::session();
    session.open("script", script.to_string());
    session.run();
    session.job.output.flush();
    let said = session.reports.iter().map(|r| (r.severity, format!("{} {}", r.message, r.help.join(" "))));
    (screen.text(), said.collect())
}

/// A cart on a spring, at rest.
const CART: &str = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n*D 1 0 0\n\
                    #WEIGHT *C 100 1 1 1\n~S GSPR BOTH X 40 1000 -LEN 0\nCONNECTOR K ~S *C *G\n";

#[test]
fn absent_menu_is_skipped_with_one_message() {
    for (script, says) in [
        (
            "STRUCTURAL\nS_INITIAL\nLCASE A 1 B 2\nLCASE B 2\nEND\n",
            "STRUCTURAL of MOSES is not in windlass: a stress analysis",
        ),
        ("STRPOST\nBEAM POST\nEND_STRPOST\n", "STRPOST of MOSES"),
        ("LAUNCH\nPHASE 1\nEND\n", "LAUNCH of MOSES"),
        ("&UGX\nLINE 0 0 1 1\nTEXT hello\nEND_&UGX\n", "&UGX of MOSES has no effect"),
        ("&TABLE\nROW 1 2\nEND\n", "&TABLE of MOSES has no effect"),
        ("HYDRODYNAMICS\nI_MDRIFT CART A\nHEADING 3 4\nEND\nEND\n", "I_MDRIFT of MOSES"),
    ] {
        let (text, said) = run(&format!("&DESCRIBE BODY CART\n{script}&TYPE behind &INFO(MENU)\n"));
        assert!(said[0].1.starts_with(says), "{script}: {said:?}");
        assert!(said.len() == 1, "{script}: {said:?}");
        assert!(text.contains("behind MAIN"), "{script}: {text}");
    }
}

#[test]
fn absent_table_of_post_processing_makes_one_error_for_its_records() {
    let run_then = format!("{CART}END\n&ENV -TIME 1 0.1 -RAMP 0\nTDOM\n");
    let (text, said) = run(&format!(
        "{run_then}FREQ_RESPONSE\nTD_POINT L\nREPORT\nEND\nEND\nPRCPOST\nTRAJECTORY\nREPORT LOCATION\nEND\nEND\n&TYPE behind &INFO(MENU)\n"
    ));
    let errors: Vec<_> = said.iter().filter(|(severity, _)| *severity == Severity::Error).collect();
    assert!(errors.len() == 1 && errors[0].1.contains("TDOM gives motions"), "{said:?}");
    assert!(text.contains("behind MAIN") && text.contains("T R A J E C T O R Y"), "{text}");
}

#[test]
fn absent_record_that_changes_forces_stops_next_solve_until_accepted() {
    for (records, names) in [
        (
            "~W W14X140\nBEAM ~W *C *D\nBEAM ~W *D *C\nEND\n",
            "BEAM of class ~W (weight, buoyancy, wind and drag of a shape without dimensions",
        ),
        ("ASSEMBLY LLEG *C *D CART 0 0 0\nEND\n", "ASSEMBLY LLEG (launch legs"),
        (
            "~P PROPULSION 100\nCONNECTOR T ~P *C\nCONNECTOR U ~P *D\nEND\n",
            "CONNECTOR T of class ~P (the thrust of a propeller)",
        ),
        ("END\nTKR_MODEL 80 TANKER\n", "TKR_MODEL (the hull, weight, wind and current of a tanker"),
        ("END\n&PARAMETER -AF_ENVIRONMENT YES\n", "&PARAMETER -AF_ENVIRONMENT YES (the direction of forces on areas)"),
        ("END\n&PARAMETER -DRGTUB 1E4 1.2 1E6 0.7\n", "(drag of tubes by Reynolds number)"),
    ] {
        let (_, said) = run(&format!("{CART}{records}&EQUI\n"));
        let errors: Vec<_> = said.iter().filter(|(severity, _)| *severity == Severity::Error).collect();
        assert!(errors.len() == 1 && errors[0].1.contains(names), "{records}: {said:?}");
        let before = said.iter().filter(|(severity, _)| *severity == Severity::Warning).count();
        assert_eq!(before, 1, "{records}: {said:?}");
        let (text, said) = run(&format!("{CART}{records}&PARAMETER -ACCEPT_MISSING YES\n&EQUI\n"));
        assert!(said.iter().all(|(severity, _)| *severity != Severity::Error), "{records}: {said:?}");
        assert!(text.contains("as &PARAMETER -ACCEPT_MISSING accepts") && text.contains(names), "{records}: {text}");
    }
}

#[test]
fn absent_record_of_motions_lets_statics_run() {
    for records in ["HYDRODYNAMICS\nG_PRESSURE CART\nEND\n", "&PARAMETER -REL_WIND NO\n", "&PARAMETER -F_CD_TUBE 0.8\n"]
    {
        let (text, said) = run(&format!("{CART}END\n{records}&EQUI\n&ENV -TIME 1 0.1 -RAMP 0\nTDOM\n&TYPE behind\n"));
        let errors: Vec<_> = said.iter().filter(|(severity, _)| *severity == Severity::Error).collect();
        assert!(errors.len() == 1 && errors[0].1.contains("the solve stops"), "{records}: {said:?}");
        assert!(text.contains("E Q U I L I B R I U M") && text.contains("behind"), "{text}");
    }
}

#[test]
fn absent_library_is_named_with_macros_it_would_define() {
    let (_, said) = run("USE_MAC AUTO_TKR\n");
    assert!(said.len() == 1 && said[0].1.contains("AUTO_TKR of MOSES is not in windlass"), "{said:?}");
    assert!(said[0].1.contains("TKR_GEN, TKR_SIM"), "{said:?}");
}

#[test]
fn refused_class_makes_one_error_and_stops_solves_that_need_it() {
    let script = format!("{CART}~T GSPR BOTH Q 40\nCONNECTOR A ~T *C *G\nCONNECTOR B ~T *D *G\nEND\n&EQUI\n");
    let (_, said) = run(&script);
    let errors: Vec<_> = said.iter().filter(|(severity, _)| *severity == Severity::Error).collect();
    assert_eq!(errors.len(), 2, "{said:?}");
    assert!(errors[1].1.contains("CONNECTOR A of class ~T (its class was refused)"), "{said:?}");
    // a line whose second segment is refused is no shorter line
    let line = "~L B_CAT 80 -LEN 100\n~L B_CAT 80 -LEN 100 -BOGUS\nEND\n&EQUI\n";
    let (_, said) = run(&format!("{CART}{line}"));
    assert!(said.iter().any(|(_, text)| text.contains("a segment of class ~L (its record was refused)")), "{said:?}");
    // what is put right at a terminal holds
    let (mut session, _screen, _folder) = common::session();
    session.interactive = true;
    session.open("t", format!("{CART}~L B_CAT 80 -LEN 100\n~L B_CAT 80 -LEN 100 -BOGUS\nEND\n&EQUI\n"));
    session.run();
    assert_eq!(session.errors, 1, "{:?}", session.reports);
}

#[test]
fn records_of_disposition_without_a_table_make_no_cascade() {
    let run_then = format!("{CART}END\n&ENV -TIME 1 0.1 -RAMP 0\nTDOM\nPRCPOST\n");
    let behind = "TRAJECTORY\nREPORT LOCATION\nEND\nEND\n&TYPE behind &INFO(MENU)\n";
    for (records, errors) in
        [("TRAJECTRY CART\nREPORT\nVLIST\nEND\n", 1), ("REPORT\nEND\n", 1), ("TRAJECTORY-EVENT 0 1\nREPORT\nEND\n", 0)]
    {
        let (text, said) = run(&format!("{run_then}{records}{behind}"));
        let found = said.iter().filter(|(severity, _)| *severity == Severity::Error).count();
        assert_eq!(found, errors, "{records}: {said:?}");
        assert!(text.contains("behind MAIN") && text.contains("T R A J E C T O R Y"), "{records}: {text}");
    }
}

#[test]
fn events_of_report_take_rows_by_their_times() {
    let (text, said) = run(
        "&BUILDG -CSV\nTime X\n0 10\n0.5 15\n1 20\n1.5 25\n2 30\nEND\nREPORT -EVENTS 0.5 2 0.5 -HARD\nREPORT -EVENTS 1 2 1\nREPORT -EVENTS 5\nEND\n",
    );
    assert!(said.len() == 1 && said[0].1.contains("no value among these events"), "{said:?}");
    for (value, shown) in [("2.00000E+01", true), ("3.00000E+01", true), ("1.00000E+01", false), ("2.50000E+01", false)]
    {
        let found = text.lines().any(|line| line.split_whitespace().nth(1) == Some(value));
        assert_eq!(found, shown, "{value}: {text}");
    }
}

#[test]
fn absent_report_and_form_of_describe_are_refused_with_what_there_is() {
    let (_, said) = run("&STATUS PILE\n&STATUS NOTE\nMEDIT\nASSEMBLY CONTROL A B\nEND\n");
    assert!(said.len() == 3 && said[..2].iter().all(|(severity, _)| *severity == Severity::Error), "{said:?}");
    assert!(said[1].1.contains("stand in the log") && said[2].1.contains("a control of lengths"), "{said:?}");
}

#[test]
fn records_without_effect_are_noted_once() {
    let (text, said) = run(
        "&LOGDEVICE OUTPUT -LANDSCAPE\n&LOGDEVICE LOG\n&CHANNEL A\n&PI_VIEW -ADD A ISO\n&DEVICE -SILENT YES\n&TYPE hidden\n&S_BACK seen\n",
    );
    assert!(said.len() == 3 && said.iter().all(|(severity, _)| *severity == Severity::Note), "{said:?}");
    assert!(text.contains("seen") && !text.contains("hidden"), "{text}");
}

#[test]
fn absent_records_are_explained_by_help() {
    let (text, said) = run("&HELP STRUCTURAL\n&HELP HYDRODYNAMICS\n");
    assert!(text.contains("a stress analysis") && text.contains("DATABASE reads"), "{text} {said:?}");
}

#[test]
fn absent_tables_do_not_use_up_the_limit_of_errors() {
    let block = |name: &&str| format!("{name}\nREPORT\nEND\n");
    let frequency: String = ["TD_POINT", "FR_PANPRESS", "ST_PANPRESS"].iter().map(block).collect();
    let menus: String = ["STRUCTURAL", "STRPOST", "LAUNCH", "STATIC_PROCESS"].iter().map(block).collect();
    let (text, said) = run(&format!(
        "{menus}&EVENT_STORE\nTKR_SIM\nLCASE\nFREQ_RESPONSE\n{frequency}FP_STD\nEND\nHYDRODYNAMICS\nE_PRESSURE B\nE_MDRIFT B\nEND\n&TYPE behind &INFO(MENU)\n"
    ));
    assert!(said.len() > 10 && text.contains("behind MAIN"), "{said:?} {text}");
}

#[test]
fn reports_of_a_refused_solve_are_no_errors_of_their_own() {
    let script = format!(
        "{CART}END\nHYDRODYNAMICS\nG_PRESSURE CART\nEND\n&ENV -TIME 1 0.1 -RAMP 0\nTDOM\nPRCPOST\nTRAJECTORY\nREPORT\nEND\n\
         CONFORCE K\nREPORT\nEND\nEND\n&TYPE behind &INFO(MENU)\n"
    );
    let (text, said) = run(&script);
    let count = |severity: Severity| said.iter().filter(|(own, _)| *own == severity).count();
    assert_eq!((count(Severity::Error), count(Severity::Note)), (1, 2), "{said:?}");
    assert!(text.contains("behind MAIN") && said.iter().any(|(_, text)| text.contains("TDOM was refused")), "{said:?}");
    // without a refused run it is an error, as before
    let (_, said) = run("PRCPOST\nTRAJECTORY\nREPORT\nEND\nEND\n");
    assert!(said.len() == 1 && said[0].0 == Severity::Error, "{said:?}");
}
