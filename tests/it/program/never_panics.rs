//! Random text through the whole interpreter: it may refuse everything, but it must not panic, and every record is
//! answered.

use proptest::prelude::*;
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::Session;

fn words() -> impl Strategy<Value = String> {
    let known = [
        "&SET",
        "&IF",
        "&ELSE",
        "&ENDIF",
        "&LOOP",
        "&ENDLOOP",
        "&MACRO",
        "&ENDMACRO",
        "&THEN",
        "&EXIT",
        "&TYPE",
        "&ENV",
        "&STATUS",
        "&DIMEN",
        "&DESCRIBE",
        "BODY",
        "MEDIT",
        "INMODEL",
        "END",
        "CONN_DESIGN",
        "TABLE",
        "CONNECTOR",
        "&CONNECTOR",
        "-L_TENSION",
        "-A_HORIZONTAL",
        "~W",
        "*P",
        ":S",
        "B_CAT",
        "GSPR",
        "ROD",
        "-LEN",
        "-CLUMP",
        "-DEP",
        "-SEA",
        "ISSC",
        "-X_PY",
        "1",
        "-2.5",
        "3E4",
        "1/0",
        "2**3",
        "(",
        ")",
        "=",
        ",",
        ",,",
        "\\\n",
        "\n",
        "\n",
        "\n",
        "\n",
        "$",
        "'",
        "%A",
        "%(A)",
        "&NUMBER(REAL",
        "&TOKEN(2",
        ".EQ.",
        ".NOT.",
        "X",
        "A",
        "REPORT",
        "VIEW",
        "PLOT",
        "CULL",
        "@",
        "-RECORD",
        "&INSTATE",
        "-LOCATE",
        "&SELECT",
        "-SELECT",
        "&DEFAULT",
        "-CYLINDER",
        "&DATA",
        "CURVES",
        "C_PROFILE",
        "é",
        "\u{0}",
    ];
    prop::collection::vec(
        prop_oneof![8 => prop::sample::select(known.to_vec()).prop_map(str::to_string), 1 => ".{0,6}"],
        0..60,
    )
    .prop_map(|list| list.join(" "))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn interpreter_answers_any_text_without_panic(text in words()) {
        let folder = tempfile::tempdir().unwrap();
        let job = JobFolder::new(folder.path().join("job"), None, false);
        let mut output = Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false);
        output.keep_log = false;
        let mut session = Session::new(output);
        session.keep_reports = true;
        session.interpreter.budget = 2000;
        session.job.settings.error_limit = i64::MAX;
        session.open("random", text);
        session.run();
        prop_assert!(session.reports.iter().all(|r| !r.message.contains("defect")), "{:?}", session.reports);
    }
}
