//! What a session keeps for C. The calls themselves are used by `examples/all_calls.c`.

#![allow(clippy::unwrap_used)]

mod waves;

use windlass_capi::{CColumn, CSession};

const MODEL: &str = "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY BUOY -IGNORE Z RX RY RZ\n*CG 0 0 0\n*F 0 0 0\n\
    #WEIGHT *CG 100 2 2 2\n~W B_CAT 100 -LEN 300 -WTPLEN 1 -EMODULUS 1E12 -BUOYDIAMETER 0 -DEPANCHOR 100\n\
    CONNECTOR A -ANC 0 200 ~W *F\nEND\n&STATUS F_CONNECTOR";

#[test]
fn session_keeps_text_tables_and_error_of_last_call() {
    let mut session = CSession::new("job");
    assert!(session.run(MODEL), "{:?}", session.error());
    let [table] = session.tables() else { panic!("{} tables", session.tables().len()) };
    let column = |name: &str| -> &CColumn { table.columns.iter().find(|c| c.name.to_str() == Ok(name)).unwrap() };
    // 100 m of a line of 1 kN/m hang straight down
    assert!((column("Ten Top (kN)").numbers[0] - 100.0).abs() < 1e-6);
    assert_eq!(column("Ten Top (kN)").unit.to_str(), Ok("kN"));
    assert_eq!(column("Name").texts.as_ref().unwrap()[0].to_str(), Ok("A"));
    assert!(table.rows == 1 && session.text().to_str().unwrap().contains("Ten Top"));
    assert!(!session.run("&ENV -DEPTH 100\n  &ENV -DEPTH deep"));
    assert_eq!(session.error_place(), Some((2, 15)));
    assert!(session.tables().is_empty() && session.error().to_str().unwrap().contains("^^^^"));
    assert!(session.run("") && session.error().is_empty() && session.error_place().is_none());
    assert!(session.warnings().is_empty() && !session.run_file("/no/such/file"));
}
