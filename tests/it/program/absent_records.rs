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
    let (_, said) = run("USE_MAC V_MODEL\n");
    assert!(said.len() == 1 && said[0].1.contains("no macro library V_MODEL"), "{said:?}");
    assert!(said[0].1.contains("TKR_MODEL, W_BOX, JGEN_INIT"), "{said:?}");
}

#[test]
fn absent_report_and_form_of_describe_are_refused_with_what_there_is() {
    let (_, said) = run("&STATUS PILE\n&STATUS SPREAD\nMEDIT\nASSEMBLY CONTROL A B\nEND\n");
    assert!(said.len() == 3 && said[..2].iter().all(|(severity, _)| *severity == Severity::Error), "{said:?}");
    assert!(said[1].1.contains("LINE_ANGLES") && said[2].1.contains("a control of lengths"), "{said:?}");
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
