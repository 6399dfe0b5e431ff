//! Wrong text models: the message and the word it stands at.

use super::{GOOD, first_error, read};

/// The error of the good model with a piece exchanged.
fn with(old: &str, new: &str) -> (String, String) {
    assert!(GOOD.contains(old), "{old}");
    first_error(&GOOD.replacen(old, new, 1))
}

#[test]
fn wrong_values_are_errors_at_their_words() {
    let cases = [
        ("OD: 0.15", "OD: wide", "OD is not a number: wide", "wide"),
        ("OD: 0.15", "OD: 0", "OD is 0", "0"),
        ("OD: 0.15", "OD: 1e999", "OD is not a number: 1e999", "1e999"),
        ("EA: 800e3", "EA: Rope stiffness", "EA is not a number: Rope stiffness", "Rope stiffness"),
        ("UnitsSystem: SI", "UnitsSystem: US", "UnitsSystem US is not read", "US"),
        ("SeabedType: Flat", "SeabedType: Profile", "SeabedType Profile is not read", "Profile"),
        ("SeabedSlope: 0", "SeabedSlope: 2", "SeabedSlope 2 is not read", "2"),
        ("WaveType: Airy", "WaveType: Dean stream", "a wave train of type Dean stream is not read", "Airy"),
        ("StaticsVIV: None", "StaticsVIV: Milan", "StaticsVIV Milan is not read", "Milan"),
        ("Cl: 0", "Cl: 0.3", "Cl 0.3 is not read", "0.3"),
        ("- - FPSO", "- - FPSQ", "what a line is connected to, FPSQ is not known", "FPSQ"),
        ("- - hose", "- - hosse", "line type hosse is not known", "hosse"),
        ("ContentsPressure: 0", "ContentsPressure: 5", "ContentsPressure 5 is not read", "5"),
        ("ContentsDensity: 1", "ContentsDensity: -1", "ContentsDensity is -1", "-1"),
        ("RefCurrentSpeed: 0", "RefCurrentSpeed: -1", "RefCurrentSpeed is -1", "-1"),
        (
            "SeabedLateralFrictionCoefficient: 0.5",
            "SeabedLateralFrictionCoefficient: -0.5",
            "SeabedLateralFrictionCoefficient is -0.5",
            "-0.5",
        ),
        ("Groups:", "6DBuoys:", "6DBuoys is not read: its loads would be lost", "6DBuoys"),
        ("Lines:", "Lynes:", "Lynes is not read: its loads would be lost", "Lynes"),
    ];
    for (old, new, message, word) in cases {
        let (said, at) = with(old, new);
        assert!(said.starts_with(message), "{new}: {said}");
        let word = if word == "Airy" { "Dean stream" } else { word };
        assert_eq!(at, word, "{new}: {said}");
    }
}

#[test]
fn short_lists_and_misspelt_columns_are_errors() {
    let (said, _) = with("  Orientation:\n  - 0\n  - 0\n  - 0", "  Orientation:\n  - 0\n  - 0");
    assert_eq!(said, "Orientation has 2 values");
    let (said, _) = with("LineType, Length, TargetSegmentLength:", "LineType, Length, TargetSegmentLenght:");
    assert_eq!(said, "the column TargetSegmentLenght is not used");
}

#[test]
fn names_that_lack_or_come_twice_are_errors() {
    let (said, _) = with("  MassPerUnitLength: 0.2\n", "");
    assert_eq!(said, "the line type has no MassPerUnitLength");
    let (said, at) = with("  EA: 800e3\n", "  EA: 800e3\n  EA: 900e3\n");
    assert_eq!((said.as_str(), at.as_str()), ("EA is given twice", "EA"));
    let (said, at) = with("- Name: hose", "- Name: chain");
    assert_eq!((said.as_str(), at.as_str()), ("line type chain is defined twice", "chain"));
    let (said, _) = with("      - 300\n", "");
    assert!(said.starts_with("the row has 7 values for 8 columns"), "{said}");
}

#[test]
fn what_is_no_yaml_is_an_error_at_its_place() {
    for text in [
        "",
        "Lines: [",
        "a: b: c",
        "Lines: {",
        "\t- x",
        "- - -",
        "\u{0}",
        "&a [*a]",
        "x: *y",
        "a: 1\n---\nb: 2",
        "? [a]\n: b",
        "!!map {}",
    ] {
        let reading = read(text);
        assert!(reading.is_failed(), "{text:?}");
        assert!(reading.messages.iter().all(|message| message.span.is_some()), "{text:?}");
    }
}

#[test]
fn aliases_and_depth_do_not_grow_beyond_their_text() {
    let bomb = "a: &a [x, x]\nb: &b [*a, *a]\nc: &c [*b, *b]\n";
    assert_eq!(first_error(bomb), ("an anchor of YAML is not read".to_string(), "&".to_string()));
    let deep = "[".repeat(100_000);
    assert!(read(&deep).is_failed());
    let deep = (0..3000).map(|n| format!("{}a:\n", " ".repeat(n))).collect::<String>();
    assert!(read(&deep).is_failed());
}

#[test]
fn bytes_beyond_ascii_keep_their_places() {
    let (said, at) = first_error(&GOOD.replacen("OD: 0.15", "Category: Général\n  OD: x", 1).replacen(
        "Name: chain",
        "Name: chaîne ünd",
        1,
    ));
    assert_eq!((said.as_str(), at.as_str()), ("Category Général is not read: its section would be lost", "Général"));
}
