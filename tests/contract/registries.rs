//! What every registry beside the commands must keep: unique names, help, a script that uses each row, a line in the theory.

use std::collections::BTreeSet;
use std::fs;
use windlass::commands::absent::{ABSENT, CLASSES, REPORTS};
use windlass::commands::check_list::CheckedAs;
use windlass::commands::{COMMANDS, status_kinds};
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

#[test]
fn check_of_script_runs_every_command_of_model_menus() {
    const MODEL: [&str; 10] =
        ["INMODEL", "MEDIT", "ENVIRONMENT", "CURVES", "SELECT", "SURFACE", "BLOCK", "MESH", "PGEN", "BATHYMETRY"];
    for command in COMMANDS.iter().filter(|c| !c.spec.menus.is_empty() && c.spec.name != "LIST_BLOCK") {
        if command.spec.menus.iter().all(|menu| MODEL.contains(&menu.name)) {
            assert_eq!(CheckedAs::from_command(command), CheckedAs::Run, "{}: see check_list.rs", command.spec.name);
        }
    }
}

#[test]
fn nothing_listed_as_absent_is_there() {
    let names: BTreeSet<&str> = ABSENT.iter().map(|entry| entry.name).collect();
    assert_eq!(names.len(), ABSENT.len(), "an absent record stands twice");
    for entry in ABSENT {
        assert!(!entry.what.is_empty() && !entry.what.ends_with('.'), "{}: what it does is a phrase", entry.name);
        let same_place = |menus: &[&_]| menus.is_empty() || menus.iter().any(|menu| entry.menus.contains(menu));
        let there = |name: &str| COMMANDS.iter().any(|c| c.spec.name == name && same_place(c.spec.menus));
        assert!(!there(entry.name), "{} is a command: take it out of the table", entry.name);
    }
    for class in CLASSES {
        let there = windlass_connectors::class_specs().any(|spec| spec.name == class.name);
        assert!(!there, "{} is a class type: take it out of the table", class.name);
    }
    for (name, instead) in REPORTS {
        assert!(!instead.is_empty() && status_kinds().all(|(kind, ..)| kind != *name), "{name} is a kind of &STATUS");
    }
}
