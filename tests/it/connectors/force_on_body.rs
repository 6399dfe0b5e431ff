//! The force that reports print of a connector is that on its body, in whatever order its ends were given.

use crate::common;

#[test]
fn connector_force_is_that_on_the_body_in_either_order_of_ends() {
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
