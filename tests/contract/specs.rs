//! What every spec must keep: unique names, abbreviations of MOSES that stay valid, help, examples that run, a golden
//! script for every command.

use std::fs;
use windlass::commands::{COMMANDS, commands_of_menu, find_opened_menu, menu};
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::Session;
use windlass_base::span::SourceId;
use windlass_connectors::{CLASSES, class_specs};
use windlass_language::flow::specs::CONTROL;
use windlass_language::record;
use windlass_language::select::{Owner, SearchResult, keyword};
use windlass_language::spec::{CommandSpec, MenuSpec, Opens};

fn specs() -> Vec<&'static CommandSpec> {
    COMMANDS.iter().map(|c| c.spec).chain(class_specs()).chain(CONTROL).collect()
}

#[test]
fn names_are_unique_in_every_menu() {
    for menu in menu::ALL {
        let mut names: Vec<&str> =
            commands_of_menu(menu).map(|c| c.spec.name).chain(CONTROL.iter().map(|s| s.name)).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count, "a name stands twice in menu {}", menu.name);
    }
}

#[test]
fn every_full_name_selects_itself_and_options_are_unique() {
    for spec in specs() {
        for option in spec.options {
            assert_eq!(
                keyword(option.name, spec.option_names()),
                SearchResult::One(option),
                "{} of {}",
                option.name,
                spec.name
            );
            let count = spec.options.iter().filter(|o| o.name == option.name).count();
            assert_eq!(count, 1, "{} stands twice in {}", option.name, spec.name);
        }
    }
}

#[test]
fn abbreviation_unique_among_moses_names_stays_valid() {
    for spec in specs() {
        let moses = || spec.option_names().filter(|(_, owner, _)| *owner == Owner::Moses);
        for (name, _, option) in moses() {
            for length in 2..name.len() {
                if let SearchResult::One(found) = keyword(&name[..length], moses()) {
                    assert_eq!(keyword(&name[..length], spec.option_names()), SearchResult::One(found), "{option:?}");
                }
            }
        }
    }
    for menu in menu::ALL {
        let all = || {
            let commands = commands_of_menu(menu).map(|c| (c.spec.name, c.spec.owner, c.spec.name));
            commands.chain(CONTROL.iter().map(|s| (s.name, s.owner, s.name)))
        };
        let moses = || all().filter(|(_, owner, _)| *owner == Owner::Moses);
        for (name, _, _) in moses() {
            for length in 1..name.len() {
                if let SearchResult::One(found) = keyword(&name[..length], moses()) {
                    assert_eq!(keyword(&name[..length], all()), SearchResult::One(found));
                }
            }
        }
    }
}

#[test]
fn abbreviations_seen_in_published_samples_are_accepted() {
    let b_cat = CLASSES.iter().find(|k| k.spec.name == "B_CAT").unwrap().spec;
    for (short, long) in [
        ("-DEP", "-DEPANCHOR"),
        ("-BUOY", "-BUOYDIAMETER"),
        ("-BUOYDIA", "-BUOYDIAMETER"),
        ("-WTPL", "-WTPLEN"),
        ("-EMOD", "-EMODULUS"),
    ] {
        let found = keyword(short, b_cat.option_names());
        assert!(matches!(found, SearchResult::One(o) if o.name == long), "{short}: {found:?}");
    }
    let command = |word: &str, menu: &'static MenuSpec| {
        let names = commands_of_menu(menu).map(|c| (c.spec.name, c.spec.owner, c.spec.name));
        keyword(word, names.chain(CONTROL.iter().map(|s| (s.name, s.owner, s.name))).collect::<Vec<_>>().into_iter())
    };
    assert_eq!(command("&INSTAT", &menu::MAIN), SearchResult::One("&INSTATE"));
    assert_eq!(command("&SELEC", &menu::MAIN), SearchResult::One("&SELECT"));
    let connector = COMMANDS.iter().find(|c| c.spec.name == "CONNECTOR").unwrap().spec;
    assert!(matches!(keyword("-ANC", connector.option_names()), SearchResult::One(o) if o.name == "-ANCHOR"));
}

#[test]
fn every_command_and_option_has_help() {
    for spec in specs() {
        assert!(!spec.help.is_empty(), "{} has no help", spec.name);
        for value in spec.data {
            assert!(!value.help.is_empty(), "{} of {} has no help", value.name, spec.name);
        }
        for option in spec.options {
            assert!(!option.help.is_empty(), "{} of {} has no help", option.name, spec.name);
            assert!(option.repeat <= option.values.len());
            for value in option.values {
                assert!(!value.help.is_empty(), "{} of {} of {} has no help", value.name, option.name, spec.name);
            }
        }
    }
}

#[test]
fn every_example_of_help_runs_without_error() {
    for spec in specs() {
        if spec.example.is_empty() {
            // two name files of the user's own, one acts at the terminal alone
            assert!(["&INSERT", "USE_MAC", "&UNDO"].contains(&spec.name), "{} has no example", spec.name);
            continue;
        }
        let folder = tempfile::tempdir().unwrap();
        let job = JobFolder::new(folder.path().join("job"), None, false);
        let mut session = Session::new(Output::new(job, Box::new(Vec::new()), Box::new(Vec::new()), false));
        session.keep_reports = true;
        session.open("example", spec.example.to_string());
        session.run();
        assert_eq!(session.errors, 0, "the example of {}: {:?}", spec.name, session.reports);
    }
}

#[test]
fn command_opens_menu_in_example_exactly_when_its_spec_says() {
    let mut opened = Vec::new();
    for spec in specs() {
        let folder = tempfile::tempdir().unwrap();
        let job = JobFolder::new(folder.path().join("job"), None, false);
        let mut session = Session::new(Output::new(job, Box::new(Vec::new()), Box::new(Vec::new()), false));
        session.interactive = true;
        session.interpreter.open_terminal();
        for line in spec.example.lines() {
            let (read, _, _) = record::read(line, SourceId::default(), 0);
            let words = read.words();
            let first = words.first().map(|w| w.text.to_ascii_uppercase()).unwrap_or_default();
            let command = commands_of_menu(session.job.menu().spec()).find(|c| c.spec.name == first);
            let said = command.and_then(|c| find_opened_menu(&session.job, c.spec, &words));
            let depth = session.job.menus.len();
            session.interpreter.feed("example", line, 1);
            session.run();
            let found = (session.job.menus.len() > depth).then(|| session.job.menu().end());
            let end = said.map(|menu| menu.end);
            assert_eq!(end, found, "`{line}` in the example of {}", spec.name);
            opened.extend(command.filter(|_| found.is_some()).map(|c| c.spec.name));
        }
    }
    let openers = COMMANDS.iter().filter(|c| c.spec.opens != Opens::Nothing);
    for command in openers {
        assert!(opened.contains(&command.spec.name), "no example shows {} open its menu", command.spec.name);
    }
}

#[test]
fn every_command_and_class_type_is_in_a_golden_script() {
    let mut text = String::new();
    for entry in fs::read_dir("scripts").unwrap().chain(fs::read_dir("scripts/insert").unwrap()).flatten() {
        if entry.path().is_file() {
            text.push_str(&fs::read_to_string(entry.path()).unwrap().to_uppercase());
        }
    }
    let words: Vec<&str> = text.split_whitespace().collect();
    for spec in specs() {
        let there = match spec.name {
            "~CLASS" => words.iter().any(|w| w.starts_with('~')),
            "*POINT" => words.iter().any(|w| w.starts_with('*')),
            ":SELECTOR" => words.iter().any(|w| w.starts_with(':')),
            name => words.contains(&name),
        };
        assert!(there, "{} stands in no script", spec.name);
    }
}
