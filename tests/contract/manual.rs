//! The copy of the made pages of the manual is that of the declarations.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

#[test]
fn made_pages_of_manual_are_those_of_declarations() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let pages = windlass::manual::build_pages();
    if std::env::var_os("BLESS").is_some() {
        fs::create_dir_all(docs.join("reference")).unwrap();
        pages.iter().for_each(|page| fs::write(docs.join(&page.path), &page.text).unwrap());
    }
    for page in &pages {
        let kept = fs::read_to_string(docs.join(&page.path)).unwrap_or_default();
        assert!(kept == page.text, "docs/{} is of other declarations: cargo run -- manual docs", page.path);
    }
    let made: BTreeSet<String> = pages.into_iter().map(|page| page.path).collect();
    for entry in fs::read_dir(docs.join("reference")).unwrap() {
        let name = format!("reference/{}", entry.unwrap().file_name().to_string_lossy());
        assert!(made.contains(&name), "docs/{name} is made of no declaration");
    }
}

#[test]
fn grammar_of_editors_is_that_of_declarations() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(windlass::manual::GRAMMAR_FILE);
    let made = windlass::manual::build_grammar();
    if std::env::var_os("BLESS").is_some() {
        fs::write(&path, &made).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == made, "{} is of other declarations: BLESS=1 cargo test --test contract", path.display());
}

#[test]
fn every_command_stands_on_one_page_of_reference() {
    let pages = windlass::manual::build_pages();
    let heads: Vec<&str> =
        pages.iter().flat_map(|page| page.text.lines()).filter(|line| line.starts_with("## ")).collect();
    for command in windlass::commands::COMMANDS {
        let escaped: String = command
            .spec
            .name
            .chars()
            .map(|c| if "&#_*~".contains(c) { format!("\\{c}") } else { c.to_string() })
            .collect();
        let listed = heads.iter().filter(|head| **head == format!("## {escaped}")).count();
        let shared = windlass::commands::COMMANDS.iter().filter(|other| other.spec.name == command.spec.name).count();
        assert!((shared..=shared + 1).contains(&listed), "{} stands {listed} times, not {shared}", command.spec.name);
    }
}
