//! `&RESULT` and `-RESULT`: what is kept of a run.

use crate::common::{print_records, session};

#[test]
fn statistic_keeps_mean_deviation_and_range_of_each_column() {
    let (mut session, _, _folder) = session();
    // 1, 5, 3, 7: mean 4, deviation sqrt(5)
    let records = "&DIMEN -DIMEN METERS K-NTS\n&BUILDG -CSV\nTime (s),Tension (kN)\n0,1\n1,5\n2,3\n3,7\nEND\n\
                   STATISTIC Time Tension -RESULT TOP\nEND\n&RESULT PERIOD 12.5 -UNIT s\n";
    session.open("records", records);
    session.run();
    assert_eq!(session.errors, 0);
    let kept: Vec<(&str, f64, &str)> =
        session.job.kept.results().iter().map(|r| (r.name.as_str(), r.value, r.unit.as_str())).collect();
    assert_eq!(
        kept,
        [
            ("TOP_MEAN", 4.0, "kN"),
            ("TOP_SD", 5f64.sqrt(), "kN"),
            ("TOP_MIN", 1.0, "kN"),
            ("TOP_MAX", 7.0, "kN"),
            ("PERIOD", 12.5, "s")
        ]
    );
}

#[test]
fn result_kept_twice_or_with_a_wrong_name_is_an_error() {
    let (text, errors) = print_records("&RESULT A 1\n&RESULT a 2\n&RESULT 2B 1\n&RESULT C_%D 1\n");
    assert_eq!(errors, 3);
    assert!(text.contains("Result A = 1") && text.contains("a result a has been kept before"), "{text}");
    assert!(text.contains("`2B` cannot name a result"), "{text}");
    let two = "&BUILDG -CSV\nTime (s),A,B\n0,1,1\n1,5,2\nEND\nSTATISTIC Time A B -RESULT X\nEND\n";
    assert!(print_records(two).0.contains("-RESULT has 1 name for 2 columns"));
}
