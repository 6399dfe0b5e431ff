//! `windlass fmt`: what it changes, what it leaves, its exit codes. The layout itself is tested in the crate of the language.

use std::fs::{read_to_string, write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

fn windlass(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let run = Command::new(env!("CARGO_BIN_EXE_windlass"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (run.status.code(), text(run.stdout), text(run.stderr))
}

fn copy_scripts(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() && path.extension().is_none() {
            copy_scripts(&path, &target);
        } else if path.is_file() {
            std::fs::copy(&path, &target).unwrap();
        }
    }
}

/// The shipped scripts below a folder, by name.
fn scripts(folder: &Path) -> Vec<PathBuf> {
    let mut list: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    list.retain(|path| path.extension().is_some_and(|end| end == "cif"));
    list.sort();
    list
}

#[test]
fn shipped_scripts_are_in_their_layout() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts");
    let all = [scripts(&folder), scripts(&folder.join("study"))].concat();
    assert!(all.len() > 60);
    let names: Vec<&str> = all.iter().map(|path| path.to_str().unwrap()).collect();
    let checked = windlass(&folder, &[&["fmt", "--check"], names.as_slice()].concat());
    assert_eq!(checked, (Some(0), String::new(), String::new()));
}

#[test]
fn formatted_scripts_print_the_same() {
    // each takes under a second in a debug build
    const QUICK: [&str; 9] = [
        "bridles",
        "design_check",
        "four_segment_line",
        "four_segment_pendant",
        "geometry",
        "history",
        "language",
        "lift",
        "menus",
    ];
    let folder = tempfile::tempdir().unwrap();
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts");
    let (typed, formatted) = (folder.path().join("typed"), folder.path().join("formatted"));
    copy_scripts(&shipped, &typed);
    // all lines begin at the margin and end with blanks
    for path in scripts(&typed) {
        let text = read_to_string(&path).unwrap();
        write(&path, text.lines().map(|line| format!("{}  \n", line.trim_start())).collect::<String>()).unwrap();
    }
    copy_scripts(&typed, &formatted);
    let all = scripts(&formatted);
    let names: Vec<&str> = all.iter().map(|path| path.to_str().unwrap()).collect();
    assert_eq!(windlass(&formatted, &[&["fmt"], names.as_slice()].concat()).0, Some(0));
    // once more changes nothing
    assert_eq!(
        windlass(&formatted, &[&["fmt", "--check"], names.as_slice()].concat()),
        (Some(0), String::new(), String::new())
    );
    for name in QUICK {
        let script = format!("{name}.cif");
        assert_ne!(
            read_to_string(typed.join(&script)).unwrap(),
            read_to_string(formatted.join(&script)).unwrap(),
            "{name}"
        );
        let (before, after) = (windlass(&typed, &[&script]), windlass(&formatted, &[&script]));
        assert_eq!((before.0, before.1), (after.0, after.1), "{name}");
    }
}

#[test]
fn check_names_line_and_writes_nothing_and_exit_codes_are_those_of_help() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    write(path.join("a.cif"), "$ \u{e9}\n&LOOP I 1 2\n&TYPE  a  b\n&ENDLOOP\n").unwrap();
    write(path.join("b.cif"), "END\n").unwrap();
    let before = read_to_string(path.join("a.cif")).unwrap();
    assert_eq!(windlass(path, &["fmt", "--check", "b.cif"]), (Some(0), String::new(), String::new()));
    let checked = windlass(path, &["fmt", "--check", "a.cif", "b.cif"]);
    assert_eq!(checked, (Some(1), "a.cif:3: would be changed\n".into(), String::new()));
    assert_eq!(read_to_string(path.join("a.cif")).unwrap(), before);
    assert_eq!(windlass(path, &["fmt", "a.cif", "b.cif"]), (Some(0), "a.cif: formatted\n".into(), String::new()));
    assert_eq!(read_to_string(path.join("a.cif")).unwrap(), "$ \u{e9}\n&LOOP I 1 2\n  &TYPE  a  b\n&ENDLOOP\n");
    assert_eq!(std::fs::read_dir(path).unwrap().count(), 2, "no other file is left");
    assert_eq!(windlass(path, &["fmt"]).0, Some(2));
    let missing = windlass(path, &["fmt", "none.cif", "b.cif"]);
    assert_eq!((missing.0, missing.2.contains("none.cif")), (Some(2), true), "{}", missing.2);
    let behind = windlass(path, &["--batch", "fmt", "a.cif"]);
    assert_eq!(behind.2, "windlass: fmt comes first, and takes scripts: windlass fmt --check model.cif\n");
}

#[test]
fn decks_and_bytes_that_are_no_text_are_left_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let deck = "JOB TEST  NAUT  TIME\nTITLE     a  deck\nOPTIONS REST END\n";
    write(path.join("d.dat"), deck).unwrap();
    write(path.join("e.cif"), b"A  B\nC \xe9  D\n").unwrap();
    let (code, out, err) = windlass(path, &["fmt", "d.dat", "e.cif"]);
    assert_eq!((code, out.as_str()), (Some(2), ""));
    assert_eq!(
        err,
        "windlass: d.dat is an AQWA deck; its columns are fixed, and it is left as it is\n\
         windlass: e.cif: line 2 holds a byte that is no text; the file is left as it is\n"
    );
    assert_eq!(read_to_string(path.join("d.dat")).unwrap(), deck);
    assert_eq!(std::fs::read(path.join("e.cif")).unwrap(), b"A  B\nC \xe9  D\n");
}

#[test]
#[cfg(unix)]
fn permissions_and_links_stay_and_read_only_files_are_refused() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    write(path.join("a.cif"), "A \n").unwrap();
    symlink("a.cif", path.join("link.cif")).unwrap();
    let mode = |bits| std::fs::set_permissions(path.join("a.cif"), std::fs::Permissions::from_mode(bits)).unwrap();
    mode(0o640);
    assert_eq!(windlass(path, &["fmt", "link.cif"]).0, Some(0));
    assert!(path.join("link.cif").is_symlink());
    assert_eq!(read_to_string(path.join("a.cif")).unwrap(), "A\n");
    assert_eq!(std::fs::metadata(path.join("a.cif")).unwrap().permissions().mode() & 0o777, 0o640);
    write(path.join("a.cif"), "A \n").unwrap();
    mode(0o440);
    assert_eq!(windlass(path, &["fmt", "a.cif"]).0, Some(2));
    assert_eq!(read_to_string(path.join("a.cif")).unwrap(), "A \n");
}
