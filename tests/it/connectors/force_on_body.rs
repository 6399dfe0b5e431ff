//! The force that reports print of a connector is that on its body, in whatever order its ends were given.

use crate::common;

#[test]
fn connector_force_acts_on_body_in_either_end_order() {
    // 8 m of EA 80 kN (E 10.19 N/mm2, a bar of 100 mm) stretched by 2 m pull the body at x = 0 toward the point at x = 10
    let records = "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100 -TIME 1 0.5\nMEDIT\n*FIXED 10 0 0\n\
         &DESCRIBE BODY B -IGNORE X Y Z RX RY RZ\n*CG 0 0 0\n#WEIGHT *CG 1000 5 5 5\n*P 0 0 0\n~S SL_ELEM 100 TENSION -LEN 8 -EMOD 10.185916357881302\n\
         CONNECTOR K ~S *FIXED *P\nCONNECTOR L ~S *P *FIXED\nEND\n&STATUS F_CONNECTOR\n\
         TDOM\nPRCPOST\nCONFORCE K\nREPORT\nEND\nCONFORCE L\nREPORT\nEND\nEND\n";
    let (mut session, screen, _folder) = common::session();
    session.open("test", records.to_string());
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let text = screen.text();
    let rows = |first: &str, column: usize| -> Vec<f64> {
        let words = text.lines().map(|l| l.split_whitespace().collect::<Vec<_>>());
        let words = words.filter(|w| w.first() == Some(&first) && w.len() > column + 2);
        words.filter_map(|w| w[column].parse().ok()).collect()
    };
    // Name Class Solution Distance FX
    assert_eq!((rows("K", 4)[0], rows("L", 4)[0]), (20.0, 20.0), "{text}");
    // Time FX, of both connectors
    assert_eq!(rows("0.50", 1), [20.0, 20.0], "{text}");
}

#[test]
fn line_tension_acts_on_body_in_either_end_order() {
    // an inextensible catenary of 60 m and 1 kN/m from (0, 0) up to (40, 30): sqrt(L2 - v2) = 2 a sinh(h/2a) by scipy
    let records = "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100\nMEDIT\n*FIXED 0 0 0\n\
         &DESCRIBE BODY B -IGNORE X Y Z RX RY RZ\n*P 40 0 30\n~H H_CAT 100 EXACT -LEN 60 -WTPL 1 -EMOD 1E9\n\
         CONNECTOR K ~H *FIXED *P\nCONNECTOR L ~H *P *FIXED\nEND\n&STATUS F_CONNECTOR\n";
    let (mut session, screen, _folder) = common::session();
    session.open("test", records.to_string());
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let text = screen.text();
    for name in ["K", "L"] {
        let row: Vec<&str> = text
            .lines()
            .map(str::trim)
            .find(|l| l.starts_with(&format!("{name} ")))
            .unwrap()
            .split_whitespace()
            .collect();
        // Name Class Solution Distance FX FY FZ Ten Top, to the second decimal
        assert_eq!((row[4], row[7]), ("-15.56", "49.97"), "{text}");
    }
    session.open("more", "&CONNECTOR K -L_TENSION 80\n".to_string());
    session.run();
    assert!(format!("{:?}", session.reports).contains("its first end is in the ground"), "{:?}", session.reports);
}
