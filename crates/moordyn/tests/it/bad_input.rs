//! Decks that are wrong: the word, what is expected, and what is near. MoorDyn or MoorPy read most of these in silence.

use crate::{SINGLE_LINE, read};

/// The one error of the deck after a replacement: the word it stands at, and all that it says.
fn error(from: &str, to: &str) -> (String, String) {
    assert!(SINGLE_LINE.contains(from), "{from}");
    let text = SINGLE_LINE.replacen(from, to, 1);
    let reading = read(&text);
    assert!(reading.is_failed(), "{to}");
    assert_eq!(reading.messages.len(), 1, "{:#?}", reading.messages);
    let message = &reading.messages[0];
    let span = message.span.unwrap();
    let word = text[span.start as usize..span.end as usize].to_string();
    (word, format!("{}; {}; {}", message.message, message.label, message.help.join(" ")))
}

#[test]
fn wrong_words_are_errors_at_the_word() {
    for (from, to, word, says) in [
        ("8.2e8", "chain_stiffness", "chain_stiffness", "EA is not a number"),
        ("8.2e8", "8.2l8", "8.2l8", "expected a number"),
        ("8.2e8", "nan", "nan", "expected a number"),
        ("8.2e8", "0", "0", "must be greater than 0"),
        ("8.2e8", "1e9|2e9", "1e9|2e9", "viscoelastic"),
        ("8.2e8", "SYROPE:a.txt|1|2", "SYROPE:a.txt|1|2", "Syrope"),
        ("-0.8        0 ", "-0.8 ei.txt", "ei.txt", "table of bending stiffness"),
        ("182.3", "-182.3", "-182.3", "must be greater than 0"),
        ("chain      1 ", "chian 1", "chian", "did you mean chain?"),
        ("Coupled ", "Couplde", "Couplde", "did you mean Coupled"),
        ("2        850", "3        850", "3", "the last point is 2"),
        ("2        850", "1        850", "1", "same place"),
        ("2        850", "R1        850", "R1", "expected a point"),
        ("50       pt", "5.5       pt", "5.5", "expected a whole number from 1"),
        ("50       pt", "50 pt 7", "7", "belongs to no column"),
        ("2   Coupled", "3   Coupled", "3", "expected 2"),
        ("kBot", "kBott", "kBott", "did you mean kBot"),
        ("1e6     kBot", "kBot 1e6", "kBot", "write 1e6 kBot"),
        ("1e6     kBot", "1000 WtrDnsity", "WtrDnsity", "did you mean WtrDnsty"),
        ("1e6     kBot", "5 Currents", "5", "loads would be lost"),
        ("1e6     kBot", "4 WaveKin", "4", "expected one of 0 1 2 3 7"),
        ("1e6     kBot", "100 depth", "100", "given twice"),
        ("200     WtrDpth", "bathymetry.txt WtrDpth", "bathymetry.txt", "expected a number"),
    ] {
        let (found, text) = error(from, to);
        assert_eq!(found, word, "{text}");
        assert!(text.contains(says), "{text}");
    }
}

#[test]
fn sections_that_act_and_are_not_read_are_errors() {
    for name in ["FAILURE", "CONTROL", "EXTERNAL LOADS", "SYROPE IC"] {
        let (_, text) = error("---------------------- OUTPUTS", &format!("--- {name} ---\n-\n-\n1 1\n--- OUTPUTS"));
        assert!(text.contains(name) && text.contains("not read"), "{text}");
    }
}

#[test]
fn vortex_induced_vibration_is_an_error() {
    let text = SINGLE_LINE.replace("CdAx  CaAx", "CdAx CaAx Cl").replace("0.4   0.5", "0.4 0.5 0.3");
    let reading = read(&text);
    assert!(reading.is_failed());
    assert!(reading.messages[0].message.contains("vortex-induced vibration"));
    assert!(!read(&text.replace("0.5 0.3", "0.5 0")).is_failed());
}

#[test]
fn misspelt_section_behind_others_is_an_error() {
    let (_, text) = error("OPTIONS ---", "OPTINS ---");
    assert!(text.contains("did you mean OPTIONS?"), "{text}");
    let (_, text) = error("OPTIONS ---", "Where it is ---");
    assert!(text.contains("belongs to no section"), "{text}");
}

#[test]
fn short_row_names_the_missing_column() {
    let (_, text) = error("0.4   0.5", "0.4");
    assert!(text.contains("no value for CaAx"), "{text}");
}

#[test]
fn unknown_column_is_a_warning_and_the_order_that_of_version_2() {
    let reading = read(&SINGLE_LINE.replace("UnstrLen  NumSegs", "Len_unstr NumSegs"));
    assert!(!reading.is_failed());
    assert_eq!(reading.messages.len(), 1);
    assert_eq!(reading.deck.lines[0].length.value, 850.0);
}

#[test]
fn any_beginning_of_a_deck_and_any_bytes_are_answered() {
    for end in 0..SINGLE_LINE.len() {
        read(&SINGLE_LINE[..end]);
    }
    for text in [
        "",
        "\0\0",
        "---",
        "--- LINES ---",
        "--- LINES ---\n\n\n1 é R 1 ü|| 9999999999999999999999 -",
        "--- OPTIONS ---\n1\n",
    ] {
        assert!(read(text).is_failed() || text == "--- LINES ---", "{text}");
    }
}

#[test]
fn unknown_column_among_names_in_another_order_is_an_error() {
    let text = SINGLE_LINE.replace("AttachA  AttachB  UnstrLen  NumSegs", "Len_unstr NumSegs AttachA AttachB");
    let reading = read(&text);
    assert!(reading.is_failed());
    assert_eq!(reading.messages[0].message, "column Len_unstr is not known here");
}

#[test]
fn units_and_sizes_that_are_hardly_meant_are_warned_of() {
    for (from, to, word, says) in [
        ("(#)       (m)      (-)      (-)", "(#) (km) (-) (-)", "(km)", "the line of units has (km)"),
        ("0.1384", "138.4", "138.4", "line type chain is 138.4 m thick"),
        ("1e6     kBot", "1.025 rho", "1.025", "the density of the water is 1.025 kg/m3"),
        ("0.002   dtM", "abc dtM", "abc", "dtM is not a number: abc"),
    ] {
        assert!(SINGLE_LINE.contains(from), "{from}");
        let text = SINGLE_LINE.replacen(from, to, 1);
        let reading = read(&text);
        let [message] = &reading.messages[..] else { panic!("{to}: {:#?}", reading.messages) };
        let span = message.span.unwrap();
        assert_eq!(&text[span.start as usize..span.end as usize], word);
        assert!(message.message.contains(says), "{}", message.message);
        assert!(!reading.is_failed());
    }
}
