//! Where names lead, and that nothing outside of the job's folder is lost.

use super::*;

fn job() -> (tempfile::TempDir, JobFolder) {
    let dir = tempfile::tempdir().unwrap();
    let job = JobFolder::new(dir.path().join("job"), None, false);
    (dir, job)
}

#[test]
fn an_earlier_answer_is_kept_under_a_number() {
    let (_dir, job) = job();
    for text in ["one", "two", "three"] {
        job.write("t.csv", text.as_bytes()).unwrap();
    }
    let read = |name: &str| std::fs::read_to_string(job.folder.join(name)).unwrap();
    assert_eq!((read("t.csv"), read("t.csv.1"), read("t.csv.2")), ("three".into(), "one".into(), "two".into()));
}

#[test]
fn nothing_outside_the_folder_is_overwritten() {
    let (dir, job) = job();
    let path = dir.path().join("mine.txt");
    std::fs::write(&path, "mine").unwrap();
    assert!(matches!(job.write(path.to_str().unwrap(), b"x"), Err(FileError::Exists(_))));
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1, "no temporary file is left");
}

#[test]
fn file_commands_stay_below_the_folder_even_through_links_and_dots() {
    let (dir, job) = job();
    let secret = dir.path().join("secret");
    std::fs::write(&secret, "x").unwrap();
    std::fs::create_dir_all(job.folder.join("sub")).unwrap();
    assert!(matches!(job.remove("../secret"), Err(FileError::NotOwn { .. })));
    assert!(matches!(job.remove("sub/../../secret"), Err(FileError::LeadsOut { .. })));
    assert!(matches!(job.remove("./sub/../../secret"), Err(FileError::NotOwn { .. })));
    assert!(matches!(job.remove(secret.to_str().unwrap()), Err(FileError::NotOwn { .. })));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(dir.path(), job.folder.join("link")).unwrap();
        assert!(matches!(job.remove("link/secret"), Err(FileError::NotOwn { .. })));
        std::os::unix::fs::symlink(dir.path().join("new"), job.folder.join("nowhere")).unwrap();
        job.write("b", b"1").unwrap();
        assert!(matches!(job.transfer("b", "nowhere", true), Err((Side::To, FileError::NotOwn { .. }))));
        job.remove("b").unwrap();
    }
    assert!(secret.exists());
    job.write("a", b"1").unwrap();
    job.transfer("a", "b", true).unwrap();
    assert!(matches!(job.transfer("a", "b", false), Err((Side::To, FileError::Taken(_)))));
    job.remove("b").unwrap();
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_nowhere_is_no_way_out() {
    let (dir, job) = job();
    job.write("a", b"1").unwrap();
    let outside = dir.path().join("new");
    std::os::unix::fs::symlink(&outside, job.folder.join("link")).unwrap();
    for keep in [true, false] {
        assert!(matches!(job.transfer("a", "link", keep), Err((Side::To, FileError::NotOwn { .. }))));
    }
    assert!(matches!(job.write("link", b"x"), Err(FileError::NotOwn { .. })));
    assert!(matches!(job.make_folder("link/sub"), Err(FileError::NotOwn { .. })));
    assert!(!outside.exists() && job.folder.join("a").exists());
}

#[test]
fn a_folder_is_neither_written_over_nor_moved_away() {
    let (_dir, mut job) = job();
    job.make_folder("sub").unwrap();
    assert!(job.write("sub", b"1").is_err() && job.create("sub").is_err());
    assert!(job.transfer("sub", "copy", true).is_err());
    assert!(job.folder.join("sub").is_dir() && !job.folder.join("sub.1").exists());
}

#[test]
fn a_name_means_the_same_file_whatever_is_allowed() {
    let (dir, mut job) = job();
    job.write("a", b"1").unwrap();
    job.allow_files = true;
    assert_eq!(job.own("a").unwrap(), job.folder.join("a"));
    let beyond = dir.path().join("mine");
    assert_eq!(job.transfer("a", beyond.to_str().unwrap(), true).unwrap(), beyond);
    assert!(beyond.exists());
    assert!(matches!(job.own("a/../../mine"), Err(FileError::LeadsOut { .. })));
}

#[test]
fn names_keep_case_blanks_and_letters_of_any_alphabet() {
    let (_dir, job) = job();
    for name in ["Mixed Case.CSV", "anker\u{e9} \u{6d77}.csv", &"n".repeat(200)] {
        let path = job.write(name, b"1").unwrap();
        assert_eq!(path.file_name().unwrap().to_str(), Some(name));
    }
    assert!(job.write(&"n".repeat(5000), b"1").is_err());
    assert!(job.write("", b"1").is_err() && job.write("..", b"1").is_err());
}

#[test]
fn every_relative_name_is_inside_the_folder_and_a_dot_or_root_in_front_leads_to_the_shells_place() {
    let (_dir, job) = job();
    for (name, below) in
        [("x", "x"), ("a/x", "a/x"), ("a/./b/../x", "a/x"), ("a/../x", "x"), (".x", ".x"), ("..x", "..x")]
    {
        assert_eq!(job.resolve(name).unwrap(), job.folder.join(below), "{name}");
    }
    for name in ["./x", "../x", "./a/x", "..", ".", "/tmp/x"] {
        assert_eq!(job.resolve(name).unwrap(), Path::new(name));
    }
    for name in ["a/../../x", "a/b/../../../x", "a/..", "a/../..", ""] {
        assert!(matches!(job.resolve(name), Err(FileError::LeadsOut { .. })), "{name}");
    }
}

#[test]
fn a_subfolder_is_made_by_mkdir_and_then_takes_files() {
    let (_dir, job) = job();
    assert!(matches!(job.write("sub/x", b"1"), Err(FileError::NoFolder(_))));
    job.make_folder("sub").unwrap();
    job.write("sub/x", b"1").unwrap();
    job.write("sub/x", b"2").unwrap();
    job.transfer("sub/x.1", "y", false).unwrap();
    assert!(matches!(job.transfer("y", "none/y", false), Err((Side::To, FileError::NoFolder(_)))));
    let read = |name: &str| std::fs::read_to_string(job.folder.join(name)).unwrap();
    assert_eq!((read("sub/x"), read("y")), ("2".into(), "1".into()));
}

#[test]
fn a_place_is_refused_when_asked_for_and_leaves_nothing_behind() {
    let (dir, job) = job();
    let outside = |name: &str| dir.path().join(name).to_str().unwrap().to_string();
    std::fs::write(outside("mine"), "mine").unwrap();
    assert!(matches!(job.place(&outside("mine")), Err(FileError::Exists(_))));
    for name in ["none/x".into(), outside("none/x"), outside("mine/x")] {
        assert!(matches!(job.place(&name), Err(FileError::NoFolder(_))), "{name}");
    }
    for name in [outside(""), outside("x/"), outside(&"n".repeat(300)), "n".repeat(300), "x/".into(), "nul\0".into()] {
        assert!(matches!(job.place(&name), Err(FileError::System { .. })), "{name}");
    }
    let place = job.place(&outside("new")).unwrap();
    assert!(!place.path().exists());
    place.write(b"1").unwrap();
    assert!(matches!(place.write(b"2"), Err(FileError::Exists(_))));
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 3, "mine, new, and the job's folder");
    assert_eq!(std::fs::read_dir(&job.folder).unwrap().count(), 0);
}

#[cfg(unix)]
#[test]
fn no_file_is_made_through_a_link_that_leads_out_of_the_folder_unless_everything_is_allowed() {
    let (dir, mut job) = job();
    std::fs::create_dir_all(&job.folder).unwrap();
    let outside = dir.path().join("outside");
    std::fs::create_dir(&outside).unwrap();
    std::os::unix::fs::symlink(&outside, job.folder.join("link")).unwrap();
    assert!(matches!(job.place("link/x"), Err(FileError::NotOwn { .. })));
    assert!(matches!(job.write("link/x", b"1"), Err(FileError::NotOwn { .. })));
    assert_eq!(std::fs::read_dir(&outside).unwrap().count(), 0);
    job.allow_files = true;
    job.write("link/x", b"1").unwrap();
    assert!(outside.join("x").exists());
}

#[test]
fn a_file_that_grows_is_neither_deleted_nor_moved_nor_written_over() {
    let (_dir, mut job) = job();
    let _log = job.create("log").unwrap();
    assert!(matches!(job.remove("log"), Err(FileError::InUse(_))));
    assert!(matches!(job.write("log", b"x"), Err(FileError::InUse(_))));
    assert!(matches!(job.transfer("log", "b", false), Err((Side::From, FileError::InUse(_)))));
    job.allow_files = true;
    let (folder, beside) = (job.folder.clone(), job.folder.with_extension("away"));
    let moved = job.transfer(folder.to_str().unwrap(), beside.to_str().unwrap(), false);
    assert!(matches!(moved, Err((Side::From, FileError::InUse(_)))), "nor its folder");
    job.transfer("log", "copy", true).unwrap();
    assert!(job.folder.join("log").exists() && job.folder.join("copy").exists());
}
