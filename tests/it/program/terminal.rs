//! What a person meets at a terminal beside the editor: reports as wide as the screen, pages, words of everyday use.

#![cfg(unix)]
use super::editor::Terminal;
use portable_pty::PtySize;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Eight lines on a body: its reports have more columns than any screen here.
fn write_mooring(folder: &Path) {
    let mut text = "&DEVICE -SET_DATE 2026-11-25\nMEDIT\n&DESCRIBE BODY SEMI -IGNORE Z RX RY RZ\n*CG 0 0 0\n#WEIGHT *CG 30000 20 20 20\n\
                    ~W B_CAT 4 -LEN 2000 -DEP 500 -WTPLEN 0.04 -B_TENSION 700\n"
        .to_string();
    for line in 1..=8 {
        text.push_str(&format!("CONNECTOR L{line} -ANC {} 1900 ~W *CG\n", 45 * line));
    }
    text.push_str(
        "END\n&EQUI\n&STATUS F_CONNECTOR\nCONN_DESIGN\nMOVE SEMI 0 -ROWS 4\nREPORT\nVIEW\nEND\nEND\n&HELP &EQUI\n",
    );
    fs::write(folder.join("job.cif"), text).unwrap();
}

fn size(cols: u16) -> PtySize {
    PtySize { rows: 40, cols, pixel_width: 0, pixel_height: 0 }
}

#[test]
fn reports_and_help_fit_screens_of_60_100_and_200_columns() {
    for cols in [60, 100, 200] {
        let home = tempfile::tempdir().unwrap();
        write_mooring(home.path());
        let terminal = Terminal::start_sized(home.path(), &["job.cif"], size(cols), &[("NO_COLOR", "1")]);
        let bytes = terminal.all_output();
        let text = String::from_utf8(bytes).unwrap().replace('\r', "");
        assert!(!text.contains('\x1b'), "NO_COLOR: {text}");
        for line in text.lines() {
            assert!(line.chars().count() <= usize::from(cols), "{cols} columns: {line}");
        }
        // each of eight lines has its tension at four excursions, wherever its column stands
        assert!((1..=8).all(|line| text.contains(&format!("Ten L{line}"))), "{text}");
        let log = fs::read_to_string(home.path().join("job.ans/LOG00001.TXT")).unwrap();
        assert!(log.lines().any(|line| line.chars().count() > 200), "the log keeps the full width");
    }
}

#[test]
fn piped_report_and_wide_report_keep_their_full_width() {
    let home = tempfile::tempdir().unwrap();
    write_mooring(home.path());
    let run = Command::new(env!("CARGO_BIN_EXE_windlass")).arg("job.cif").current_dir(home.path()).output().unwrap();
    let text = String::from_utf8(run.stdout).unwrap();
    assert!(text.lines().any(|line| line.chars().count() > 200));
    let script = fs::read_to_string(home.path().join("job.cif")).unwrap();
    fs::write(home.path().join("job.cif"), script.replace("\nREPORT\n", "\nREPORT -WIDE\n")).unwrap();
    let terminal = Terminal::start_sized(home.path(), &["job.cif"], size(60), &[]);
    let text = String::from_utf8(terminal.all_output()).unwrap();
    assert!(text.lines().any(|line| line.chars().count() > 200));
}

#[test]
fn long_output_goes_to_the_pager_until_device_says_no() {
    let home = tempfile::tempdir().unwrap();
    // a pager that keeps what it was given
    fs::write(home.path().join("keep"), "cat >> kept.txt\n").unwrap();
    let mut t = Terminal::start_sized(home.path(), &[], size(100), &[("PAGER", "sh keep")]);
    t.ready("MAIN> ");
    t.record("&TYPE short");
    t.ready("MAIN> ");
    t.record("&HELP &ENV");
    t.ready("MAIN> ");
    let kept = fs::read_to_string(home.path().join("kept.txt")).unwrap();
    assert!(kept.starts_with("&ENV: ") && kept.lines().count() > 40 && !kept.contains("short"));
    t.record("&DEVICE -PAGES NO");
    t.ready("MAIN> ");
    t.record("&HELP &DEVICE");
    t.ready("MAIN> ");
    assert_eq!(fs::read_to_string(home.path().join("kept.txt")).unwrap(), kept);
    assert_eq!(t.end(), 0);
}

#[test]
fn missing_pager_prints_text_as_it_is() {
    let home = tempfile::tempdir().unwrap();
    let mut t = Terminal::start_sized(home.path(), &[], size(100), &[("PAGER", "windlass-no-such-pager")]);
    t.ready("MAIN> ");
    t.record("&HELP &ENV");
    t.see("the order of -STOKES");
    t.ready("MAIN> ");
    assert_eq!(t.end(), 0);
}

#[test]
fn everyday_words_are_answered_and_openers_say_how_to_leave() {
    let home = tempfile::tempdir().unwrap();
    let mut t = Terminal::start(home.path(), &[]);
    t.ready("MAIN> ");
    t.record("help tension");
    t.see("explains one, &HELP NAME -OPTION an option alone");
    t.ready("MAIN> ");
    t.record("MEDIT");
    t.see("END or END_MEDIT leaves it");
    t.ready("MEDIT> ");
    t.record("*PORT 1 2 3");
    t.ready("MEDIT> ");
    t.record("CONNECTOR A ~V *PORT");
    t.see("no class is defined yet");
    t.ready("MEDIT> ");
    t.record("&UNDO");
    t.see("taken back: *PORT 1 2 3");
    t.ready("MEDIT> ");
    t.record("&UNDO");
    t.see("nothing is left to take back");
    t.ready("MEDIT> ");
    t.record("quit");
    let text = String::from_utf8_lossy(&t.all_output()).into_owned();
    assert!(!text.contains("error"), "{text}");
}

#[test]
fn wind_of_a_unit_word_is_the_same_wind_in_knots() {
    // 1 knot is 1852 m an hour, a statute mile 1609.344 m, by definition
    for (speed, unit) in [
        ("10", ""),
        ("10", "KNOTS"),
        ("5.144444444444", "M/S"),
        ("16.8780985710", "FT/S"),
        ("18.52", "KM/H"),
        ("11.5077944802", "MPH"),
    ] {
        let run = Command::new(env!("CARGO_BIN_EXE_windlass"))
            .args(["-c", &format!("&ENV -WIND {speed} 90 {unit}"), "-c", "&STATUS ENVIRONMENT"])
            .output()
            .unwrap();
        let text = String::from_utf8(run.stdout).unwrap();
        assert!(text.lines().any(|l| l.starts_with("   Wind ") && l.ends_with("= 10.00 knots")), "{unit}: {text}");
    }
    let run =
        Command::new(env!("CARGO_BIN_EXE_windlass")).args(["-c", "&ENV A -WIND 10 90 FURLONGS"]).output().unwrap();
    assert_eq!(run.status.code(), Some(1), "no unit, and the environment has a name");
}

#[test]
fn messages_have_colour_at_a_terminal_unless_no_color_is_set() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("job.cif"), "&EQUI\n").unwrap();
    let at_terminal = |variables: &[(&str, &str)]| {
        let terminal = Terminal::start_sized(home.path(), &["job.cif"], size(60), variables);
        String::from_utf8(terminal.all_output()).unwrap()
    };
    let coloured = at_terminal(&[]);
    assert!(coloured.contains("\x1b[") && coloured.contains("there is no body"), "{coloured}");
    let plain = at_terminal(&[("NO_COLOR", "1")]);
    assert!(!plain.contains('\x1b') && plain.contains("there is no body"), "{plain}");
    let run = Command::new(env!("CARGO_BIN_EXE_windlass")).arg("job.cif").current_dir(home.path()).output().unwrap();
    let piped = String::from_utf8(run.stderr).unwrap();
    assert!(!piped.contains('\x1b') && piped.contains("there is no body"), "{piped}");
}

#[test]
fn summaries_of_solves_fit_screens_of_60_100_and_200_columns() {
    for cols in [60, 100, 200] {
        let home = tempfile::tempdir().unwrap();
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let script = fs::read_to_string(root.join("scripts/rod_results.cif")).unwrap();
        fs::write(home.path().join("job.cif"), script).unwrap();
        let terminal = Terminal::start_sized(home.path(), &["job.cif"], size(cols), &[("NO_COLOR", "1")]);
        let text = String::from_utf8(terminal.all_output()).unwrap().replace('\r', "");
        let begun = text.lines().skip_while(|line| !line.starts_with("ROD AFT ENVELOPE: "));
        let summary: Vec<&str> = begun.take_while(|line| !line.trim().is_empty()).collect();
        assert!(summary.iter().any(|line| line.contains("Layback")), "{text}");
        assert!(summary.iter().all(|line| line.chars().count() <= usize::from(cols)), "{cols} columns: {summary:#?}");
    }
}
