//! What every registry beside the commands must keep: unique names, help, a script that uses each row, a line in the theory.

use std::collections::BTreeSet;
use std::fs;
use windlass_hydro::gusts::GUST_SPECTRA;
use windlass_hydro::sea::spectra::SPECTRA;

/// What stands in the files of a folder.
fn texts(folder: &str) -> String {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.filter(|path| path.is_file()).map(|path| fs::read_to_string(path).unwrap()).collect()
}

/// Holds rows of name and help to the promises; `option` is the option that takes the names, `theory` the chapter that has them.
fn keep_promises(rows: &[(&str, &str)], option: &str, theory: &str) {
    let names: BTreeSet<&str> = rows.iter().map(|(name, _)| *name).collect();
    assert_eq!(names.len(), rows.len(), "a name of {option} stands twice");
    let scripts = texts("scripts") + &texts("tests/errors");
    let words: Vec<&str> = scripts.split_whitespace().collect();
    let used: BTreeSet<&str> = words.windows(2).filter(|pair| pair[0] == option).map(|pair| pair[1]).collect();
    let chapter = fs::read_to_string(format!("docs/theory/{theory}.md")).unwrap();
    for (name, help) in rows {
        assert!(!help.is_empty() && !help.ends_with('.'), "{name} of {option}: help is a phrase");
        assert!(used.contains(name), "no script has {option} {name}");
        assert!(chapter.contains(&format!("`{name}`")), "docs/theory/{theory}.md does not name `{name}`");
    }
}

#[test]
fn every_wave_spectrum_has_name_help_script_and_theory() {
    let rows: Vec<_> = SPECTRA.iter().map(|spectrum| (spectrum.name, spectrum.help)).collect();
    keep_promises(&rows, "-SEA", "waves");
    for parameter in SPECTRA.iter().flat_map(|spectrum| spectrum.parameters) {
        assert!(!parameter.help.is_empty() && parameter.range[0] < parameter.range[1], "{}", parameter.name);
    }
}

#[test]
fn every_gust_spectrum_has_name_help_script_and_theory() {
    let rows: Vec<_> = GUST_SPECTRA.iter().map(|spectrum| (spectrum.name, spectrum.help)).collect();
    keep_promises(&rows, "-W_SPECTRUM", "hydrodynamics");
}
