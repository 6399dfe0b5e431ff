//! The crates: what each may depend on, and what each declares of itself.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The folder of each engine crate by the name of its package, with its manifest.
fn crates() -> BTreeMap<String, (PathBuf, toml::Table)> {
    let folders = fs::read_dir("crates").unwrap().flatten().map(|entry| entry.path());
    let read = |folder: PathBuf| {
        let manifest: toml::Table = fs::read_to_string(folder.join("Cargo.toml")).unwrap().parse().unwrap();
        (manifest["package"]["name"].as_str().unwrap().to_string(), (folder, manifest))
    };
    folders.map(read).collect()
}

fn dependencies(manifest: &toml::Table) -> Vec<&str> {
    manifest["dependencies"].as_table().unwrap().keys().map(String::as_str).collect()
}

#[test]
fn engines_do_not_depend_on_language() {
    let crates = crates();
    for name in ["base", "catenary", "line-dynamics", "tether", "hydro", "signal", "solve", "model", "nonlinear"] {
        let (_, manifest) = &crates[&format!("windlass-{name}")];
        assert!(!dependencies(manifest).contains(&"windlass-language"), "windlass-{name} depends on the language");
    }
}

#[test]
fn libraries_are_used_only_in_their_crates() {
    let program: toml::Table = fs::read_to_string("Cargo.toml").unwrap().parse().unwrap();
    let mut users: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let all = crates().into_iter().map(|(name, (_, manifest))| (name, manifest));
    for (name, manifest) in all.chain([("windlass".to_string(), program)]) {
        for library in dependencies(&manifest) {
            users.entry(library.to_string()).or_default().push(name.clone());
        }
    }
    for library in ["rustyline", "comfy-table"] {
        assert_eq!(users[library], ["windlass"], "{library}");
    }
    for library in ["logos", "meval"] {
        assert_eq!(users[library], ["windlass-language"], "{library}");
    }
    assert!(users["nalgebra"].len() > 1 && users["indexmap"].len() > 1);
}

#[test]
fn every_crate_forbids_unsafe_code_and_documents_public_items() {
    for (name, (folder, _)) in crates() {
        let root = fs::read_to_string(folder.join("src/lib.rs")).unwrap();
        // the C interface is a boundary, and has its unsafe code in one file
        let of_unsafe = if name == C_INTERFACE { "#![deny(unsafe_code)]" } else { "#![forbid(unsafe_code)]" };
        for attribute in [of_unsafe, "#![deny(missing_docs)]"] {
            assert!(root.contains(attribute), "{name} lacks {attribute}");
        }
        assert!(root.contains("//! # Example\n"), "{name} has no example");
        assert!(folder.join("README.md").is_file(), "{name} has no README");
    }
}

const C_INTERFACE: &str = "windlass-capi";

/// The words that stand directly behind a text, up to a bracket.
fn names_behind<'t>(text: &'t str, before: &str) -> Vec<&'t str> {
    let name = |rest: &'t str| rest.split('(').next().unwrap_or_default();
    text.split(before).skip(1).map(name).collect()
}

#[test]
fn c_interface_has_unsafe_code_in_one_file_and_header_declares_what_it_exports() {
    let mut list = Vec::new();
    texts(Path::new("crates/capi/src"), &mut list);
    for (path, text) in &list {
        assert_eq!(text.contains("allow(unsafe_code"), path.ends_with("calls.rs"), "{}", path.display());
    }
    let (_, calls) = list.iter().find(|(path, _)| path.ends_with("calls.rs")).unwrap();
    let mut exported = names_behind(calls, "extern \"C\" fn ");
    let header = fs::read_to_string("crates/capi/include/windlass.h").unwrap();
    let code: Vec<&str> = header.split("/*").map(|part| part.rsplit("*/").next().unwrap_or_default()).collect();
    let code = code.concat();
    let words = code.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '('));
    let mut declared: Vec<&str> = words
        .filter(|word| word.starts_with("windlass_"))
        .filter_map(|word| word.split_once('(').map(|w| w.0))
        .collect();
    exported.sort_unstable();
    declared.sort_unstable();
    assert_eq!(declared, exported);
    assert!(exported.len() > 20);
    let example = fs::read_to_string("crates/capi/examples/all_calls.c").unwrap();
    for name in exported {
        assert!(example.contains(&format!("{name}(")), "the example does not call {name}");
    }
    // the Python package has none of its own
    let mut python = Vec::new();
    texts(Path::new("python/src"), &mut python);
    assert!(python.len() > 5);
    for (path, text) in python {
        assert!(code_has_no_unsafe(&text), "{}", path.display());
    }
}

fn code_has_no_unsafe(text: &str) -> bool {
    code(text).all(|line| !line.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|word| word == "unsafe"))
}

fn texts(folder: &Path, list: &mut Vec<(PathBuf, String)>) {
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            texts(&path, list);
        } else if path.extension().is_some_and(|e| e == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            list.push((path, text));
        }
    }
}

#[test]
fn engines_embed_only_files_of_their_folder() {
    for (name, (folder, _)) in crates() {
        let mut list = Vec::new();
        texts(&folder.join("src"), &mut list);
        let home = folder.canonicalize().unwrap();
        for (path, text) in list {
            let embedded = ["include_str!(\"", "include_bytes!(\""].map(|call| text.split(call).skip(1));
            for file in embedded.into_iter().flatten().filter_map(|rest| rest.split('"').next()) {
                let found = path.parent().unwrap().join(file).canonicalize();
                assert!(found.is_ok_and(|f| f.starts_with(&home)), "{name}: {} embeds {file}", path.display());
            }
        }
    }
}

/// A source without its tests, which stand last, and without comments.
fn code(text: &str) -> impl Iterator<Item = &str> {
    let own = text.split("#[cfg(test)]").next().unwrap_or_default();
    own.lines().map(|line| line.split("//").next().unwrap_or_default())
}

#[test]
fn dense_factorisations_are_in_one_crate() {
    let methods = [
        "lu",
        "full_piv_lu",
        "qr",
        "col_piv_qr",
        "cholesky",
        "udu",
        "lblt",
        "svd",
        "svd_unordered",
        "try_svd",
        "polar",
        "schur",
        "try_schur",
        "hessenberg",
        "bidiagonalize",
        "symmetric_tridiagonalize",
        "symmetric_eigen",
        "try_symmetric_eigen",
        "symmetric_eigenvalues",
        "eigenvalues",
        "complex_eigenvalues",
        "singular_values",
        "singular_values_unordered",
        "rank",
        "try_inverse",
        "try_inverse_mut",
        "pseudo_inverse",
        "determinant",
        "exp_matrix",
    ];
    let methods: Vec<String> = methods.iter().map(|m| format!(".{m}(")).collect();
    let types = ["LU", "FullPivLU", "QR", "ColPivQR", "Cholesky", "SVD", "Schur", "Hessenberg", "SymmetricEigen"];
    let mut list = Vec::new();
    for (_, (folder, _)) in crates() {
        texts(&folder.join("src"), &mut list);
    }
    texts(Path::new("src"), &mut list);
    let mut seen = false;
    for (path, text) in list {
        if path.ends_with("base/src/dense.rs") {
            seen = true;
            continue;
        }
        for (number, line) in code(&text).enumerate() {
            let position = format!("{}:{}", path.display(), number + 1);
            for method in &methods {
                assert!(
                    !line.contains(method.as_str()),
                    "{position} calls {method}): windlass_base::dense has it, guarded"
                );
            }
            // a name of nalgebra's decompositions comes from the guarded place, or not at all
            let brought = line.contains("nalgebra::") || line.trim_start().starts_with("use nalgebra");
            let words = || line.split(|c: char| !c.is_alphanumeric() && c != '_');
            let found = types.iter().find(|t| brought && words().any(|word| word == **t));
            assert!(
                found.is_none(),
                "{position} brings {} from nalgebra: windlass_base::dense has it, guarded",
                found.unwrap()
            );
        }
    }
    assert!(seen, "windlass_base::dense is not where it was");
}
