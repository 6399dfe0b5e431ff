//! Where names lead, and that nothing outside of the job's folder is lost.

use super::*;

fn job() -> (tempfile::TempDir, JobFolder) {
    let dir = tempfile::tempdir().unwrap();
    let job = JobFolder::new(dir.path().join("job"), None, false);
    (dir, job)
}

#[test]
fn earlier_answer_is_kept_under_a_number() {
    let (_dir, job) = job();
    for text in ["one", "two", "three"] {
        job.write("t.csv", text.as_bytes()).unwrap();
    }
    let read = |name: &str| std::fs::read_to_string(job.folder.join(name)).unwrap();
    assert_eq!((read("t.csv"), read("t.csv.1"), read("t.csv.2")), ("three".into(), "one".into(), "two".into()));
}

#[test]
fn file_outside_answers_folder_is_not_overwritten() {
    let (dir, mut job) = job();
    let path = dir.path().join("mine.txt");
    std::fs::write(&path, "mine").unwrap();
    for allowed in [false, true] {
        job.allow_files = allowed;
        let refused = job.write(path.to_str().unwrap(), b"x").unwrap_err();
        assert!(
            matches!(refused, FileError::Exists(_)) == allowed
                && matches!(refused, FileError::NotOwn { .. }) != allowed
        );
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
        assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1, "no temporary file is left");
    }
}

#[test]
fn file_commands_stay_inside_folder_through_links_and_dots() {
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
        assert!(matches!(job.transfer("b", "nowhere", true), Err((NameOperand::To, FileError::NotOwn { .. }))));
        job.remove("b").unwrap();
    }
    assert!(secret.exists());
    job.write("a", b"1").unwrap();
    job.transfer("a", "b", true).unwrap();
    assert!(matches!(job.transfer("a", "b", false), Err((NameOperand::To, FileError::Taken(_)))));
    job.remove("b").unwrap();
}

#[cfg(unix)]
#[test]
fn dangling_link_does_not_lead_out_of_folder() {
    let (dir, job) = job();
    job.write("a", b"1").unwrap();
    let outside = dir.path().join("new");
    std::os::unix::fs::symlink(&outside, job.folder.join("link")).unwrap();
    for keep in [true, false] {
        assert!(matches!(job.transfer("a", "link", keep), Err((NameOperand::To, FileError::NotOwn { .. }))));
    }
    assert!(matches!(job.write("link", b"x"), Err(FileError::NotOwn { .. })));
    assert!(matches!(job.make_folder("link/sub"), Err(FileError::NotOwn { .. })));
    assert!(!outside.exists() && job.folder.join("a").exists());
}

#[test]
fn folder_is_neither_overwritten_nor_moved() {
    let (_dir, mut job) = job();
    job.make_folder("sub").unwrap();
    assert!(job.write("sub", b"1").is_err() && job.create("sub").is_err());
    assert!(job.transfer("sub", "copy", true).is_err());
    assert!(job.folder.join("sub").is_dir() && !job.folder.join("sub.1").exists());
}

#[test]
fn file_name_means_same_file_with_and_without_allow_files() {
    let (dir, mut job) = job();
    job.write("a", b"1").unwrap();
    job.allow_files = true;
    let beyond = dir.path().join("mine");
    assert_eq!(job.transfer("a", beyond.to_str().unwrap(), true).unwrap(), beyond);
    assert!(beyond.exists());
    assert!(matches!(job.remove("a/../../mine"), Err(FileError::LeadsOut { .. })));
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
fn relative_name_is_in_answers_folder_and_dot_or_root_is_shell_path() {
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
fn mkdir_creates_subfolder_for_files() {
    let (_dir, job) = job();
    assert!(matches!(job.write("sub/x", b"1"), Err(FileError::NoFolder(_))));
    job.make_folder("sub").unwrap();
    job.write("sub/x", b"1").unwrap();
    job.write("sub/x", b"2").unwrap();
    job.transfer("sub/x.1", "y", false).unwrap();
    assert!(matches!(job.transfer("y", "none/y", false), Err((NameOperand::To, FileError::NoFolder(_)))));
    let read = |name: &str| std::fs::read_to_string(job.folder.join(name)).unwrap();
    assert_eq!((read("sub/x"), read("y")), ("2".into(), "1".into()));
}

#[test]
fn refused_path_creates_no_file() {
    let (dir, mut job) = job();
    assert!(matches!(job.position(dir.path().join("new").to_str().unwrap()), Err(FileError::NotOwn { .. })));
    job.allow_files = true;
    let outside = |name: &str| dir.path().join(name).to_str().unwrap().to_string();
    std::fs::write(outside("mine"), "mine").unwrap();
    assert!(matches!(job.position(&outside("mine")), Err(FileError::Exists(_))));
    for name in ["none/x".into(), outside("none/x"), outside("mine/x")] {
        assert!(matches!(job.position(&name), Err(FileError::NoFolder(_))), "{name}");
    }
    for name in [outside(""), outside("x/"), outside(&"n".repeat(300)), "n".repeat(300), "x/".into(), "nul\0".into()] {
        assert!(matches!(job.position(&name), Err(FileError::System { .. })), "{name}");
    }
    let position = job.position(&outside("new")).unwrap();
    assert!(!position.path().exists());
    position.write(b"1").unwrap();
    assert!(matches!(position.write(b"2"), Err(FileError::Exists(_))));
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 3, "mine, new, and the job's folder");
    assert_eq!(std::fs::read_dir(&job.folder).unwrap().count(), 0);
}

#[cfg(unix)]
#[test]
fn link_out_of_folder_makes_no_file_without_allow_files() {
    let (dir, mut job) = job();
    std::fs::create_dir_all(&job.folder).unwrap();
    let outside = dir.path().join("outside");
    std::fs::create_dir(&outside).unwrap();
    std::os::unix::fs::symlink(&outside, job.folder.join("link")).unwrap();
    assert!(matches!(job.position("link/x"), Err(FileError::NotOwn { .. })));
    assert!(matches!(job.write("link/x", b"1"), Err(FileError::NotOwn { .. })));
    assert_eq!(std::fs::read_dir(&outside).unwrap().count(), 0);
    job.allow_files = true;
    job.write("link/x", b"1").unwrap();
    assert!(outside.join("x").exists());
}

#[test]
fn growing_file_is_not_deleted_moved_or_overwritten() {
    let (_dir, mut job) = job();
    let _log = job.create("log").unwrap();
    assert!(matches!(job.remove("log"), Err(FileError::InUse(_))));
    assert!(matches!(job.write("log", b"x"), Err(FileError::InUse(_))));
    assert!(matches!(job.transfer("log", "b", false), Err((NameOperand::From, FileError::InUse(_)))));
    job.allow_files = true;
    let (folder, beside) = (job.folder.clone(), job.folder.with_extension("away"));
    let moved = job.transfer(folder.to_str().unwrap(), beside.to_str().unwrap(), false);
    assert!(matches!(moved, Err((NameOperand::From, FileError::InUse(_)))), "nor its folder");
    job.transfer("log", "copy", true).unwrap();
    assert!(job.folder.join("log").exists() && job.folder.join("copy").exists());
}

/// A job whose user answers every question so, and counts the questions.
fn answer_questions_with(job: &mut JobFolder, answer: Option<&'static str>) -> Arc<Mutex<Vec<String>>> {
    let questions = Arc::new(Mutex::new(Vec::new()));
    let list = Arc::clone(&questions);
    job.typed = true;
    job.question = Some(Arc::new(move |text| {
        list.lock().unwrap().push(text.to_string());
        answer.map(str::to_string)
    }));
    questions
}

#[test]
fn typed_record_creates_outside_file_after_one_question_only() {
    let (dir, mut job) = job();
    job.write("own", b"1").unwrap();
    let outside = |name: &str| dir.path().join(name).to_str().unwrap().to_string();
    for (answer, made) in
        [(Some("y"), true), (Some(" Yes "), true), (Some(""), false), (Some("n"), false), (None, false)]
    {
        let questions = answer_questions_with(&mut job, answer);
        for done in [
            job.write(&outside("file"), b"1").map(|_| ()),
            job.make_folder(&outside("folder/sub")).map(|_| ()),
            job.transfer("own", &outside("copy"), true).map(|_| ()).map_err(|e| e.1),
        ] {
            assert!(
                made == done.is_ok() && (made || matches!(done, Err(FileError::Declined(_)))),
                "{answer:?}: {done:?}"
            );
        }
        assert_eq!(questions.lock().unwrap().len(), 3, "one question each");
        assert_eq!(
            [outside("file"), outside("folder/sub"), outside("copy")].map(|p| Path::new(&p).exists()),
            [made; 3]
        );
        if made {
            assert!(matches!(job.write(&outside("file"), b"2"), Err(FileError::Exists(_))));
            assert!(matches!(job.remove(&outside("file")), Err(FileError::NotOwn { .. })), "nor deletes");
            assert_eq!(questions.lock().unwrap().len(), 3, "what is refused anyway is not asked");
            std::fs::remove_file(outside("file")).unwrap();
            std::fs::remove_file(outside("copy")).unwrap();
            std::fs::remove_dir_all(outside("folder")).unwrap();
        }
    }
    let questions = answer_questions_with(&mut job, Some("y"));
    job.typed = false;
    assert!(matches!(job.write(&outside("file"), b"1"), Err(FileError::NotOwn { .. })), "a script is not asked for");
    job.typed = true;
    job.write("own", b"2").unwrap();
    assert!(questions.lock().unwrap().is_empty());
}

#[cfg(unix)]
#[test]
fn linked_answers_folder_is_refused_unless_user_named_it() {
    let dir = tempfile::tempdir().unwrap();
    let victim = dir.path().join("victim");
    std::fs::create_dir(&victim).unwrap();
    std::fs::write(victim.join("x"), "mine").unwrap();
    std::os::unix::fs::symlink(&victim, dir.path().join("job.ans")).unwrap();
    let mut job = JobFolder::new(dir.path().join("job"), None, false);
    let inside = job.folder.join("x").to_str().unwrap().to_string();
    let link = |done: Result<PathBuf, FileError>| {
        assert!(matches!(done, Err(FileError::FolderIsLink(_))), "{done:?}");
    };
    for name in ["x", &inside] {
        link(job.remove(name));
        link(job.write(name, b"1"));
        link(job.make_folder(name));
        link(job.transfer(name, "y", false).map_err(|e| e.1));
    }
    link(job.create("LOG").map(|_| PathBuf::new()));
    link(job.check().map(|()| PathBuf::new()));
    assert!(FileError::FolderIsLink(PathBuf::new()).help().is_some_and(|help| help.contains("--out DIR")));
    assert_eq!(std::fs::read_dir(&victim).unwrap().count(), 1);
    // named by the user, it is resolved once: what the link says later does not matter
    let named = JobFolder::new(dir.path().join("job"), Some(dir.path().join("job.ans")), false);
    named.check().unwrap();
    named.write("y", b"1").unwrap();
    std::fs::remove_file(dir.path().join("job.ans")).unwrap();
    std::fs::create_dir(dir.path().join("other")).unwrap();
    std::os::unix::fs::symlink(dir.path().join("other"), dir.path().join("job.ans")).unwrap();
    named.write("z", b"1").unwrap();
    assert!(victim.join("z").exists());
    assert_eq!(std::fs::read_dir(dir.path().join("other")).unwrap().count(), 0);
}

#[cfg(unix)]
#[test]
fn link_made_between_check_and_write_does_not_lead_out() {
    let (dir, job) = job();
    let (outside, sub) = (dir.path().join("outside"), job.folder.join("sub"));
    std::fs::create_dir(&outside).unwrap();
    job.make_folder("sub").unwrap();
    let position = job.position("sub/x").unwrap();
    let mut growing = position.begin().unwrap();
    growing.write_all(b"1").unwrap();
    std::fs::rename(&sub, job.folder.join("away")).unwrap();
    std::os::unix::fs::symlink(&outside, &sub).unwrap();
    assert!(matches!(position.write(b"1"), Err(FileError::NotOwn { .. })));
    growing.finish().unwrap();
    assert!(job.folder.join("away/x").exists(), "it stands where it was begun");
    assert_eq!(std::fs::read_dir(&outside).unwrap().count(), 0);
}

#[cfg(unix)]
#[test]
fn link_swapped_in_during_write_does_not_lead_out() {
    use std::sync::atomic::AtomicBool;
    let (dir, job) = job();
    let outside = dir.path().join("outside");
    std::fs::create_dir(&outside).unwrap();
    std::fs::write(outside.join("x"), "mine").unwrap();
    job.make_folder("sub").unwrap();
    job.write("own", b"1").unwrap();
    let [sub, away, link] = ["sub", "away", "link"].map(|name| job.folder.join(name));
    std::os::unix::fs::symlink(&outside, &link).unwrap();
    let over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !over.load(Ordering::Relaxed) {
                for (from, to) in [(&sub, &away), (&link, &sub), (&sub, &link), (&away, &sub)] {
                    std::fs::rename(from, to).unwrap();
                }
            }
        });
        // each of these succeeds or is refused, as it meets the folder or the link
        for _ in 0..300 {
            let _ = job.write("sub/x", b"theirs");
            let _ = job.remove("sub/x");
            let _ = job.transfer("own", "sub/z", true);
            let _ = job.transfer("sub/z", "back", false);
            let _ = job.remove("back");
        }
        over.store(true, Ordering::Relaxed);
    });
    assert_eq!(std::fs::read_to_string(outside.join("x")).unwrap(), "mine");
    assert_eq!(std::fs::read_dir(&outside).unwrap().count(), 1);
}

#[test]
fn temporary_files_of_killed_jobs_are_removed_and_others_kept() {
    let (dir, job) = job();
    job.make_folder("sub").unwrap();
    let left = ["", "sub/"].map(|sub| job.folder.join(format!("{sub}.windlass-1-0.tmp")));
    let others = [".windlass-notes", "x.tmp", ".tmpA1"].map(|name| job.folder.join(name));
    for path in left.iter().chain(&others) {
        std::fs::write(path, "x").unwrap();
    }
    let living = job.position("living").unwrap();
    let mut living = living.begin().unwrap();
    living.write_all(b"1").unwrap();
    let next = JobFolder::new(dir.path().join("job"), None, false);
    next.write("sub/y", b"1").unwrap();
    assert!(left.iter().all(|path| !path.exists()) && others.iter().all(|path| path.exists()));
    living.finish().unwrap();
    assert_eq!(std::fs::read_to_string(job.folder.join("living")).unwrap(), "1");
}

#[test]
fn earlier_file_gets_next_free_number() {
    let (_dir, job) = job();
    for number in 0..100 {
        job.write("t", format!("{number}").as_bytes()).unwrap();
    }
    let read = |name: &str| std::fs::read_to_string(job.folder.join(name)).unwrap();
    assert_eq!(
        (read("t"), read("t.1"), read("t.42"), read("t.99")),
        ("99".into(), "0".into(), "41".into(), "98".into())
    );
    assert!(!job.folder.join("t.100").exists());
}

#[cfg(unix)]
#[test]
fn folder_deleted_during_run_is_named() {
    let (_dir, mut job) = job();
    let log = job.create("log").unwrap();
    assert!(!is_unlinked(&log));
    std::fs::remove_dir_all(&job.folder).unwrap();
    assert!(is_unlinked(&log));
    for done in [job.write("x", b"1"), job.create("TDOM.run").map(|_| PathBuf::new()), job.make_folder("sub")] {
        assert!(matches!(done, Err(FileError::FolderGone(_))), "{done:?}");
    }
}

#[test]
fn file_read_outside_script_folder_is_noted_once() {
    let dir = tempfile::tempdir().unwrap();
    let here = dir.path().join("here");
    std::fs::create_dir(&here).unwrap();
    for path in [here.join("in"), dir.path().join("out")] {
        std::fs::write(path, "x").unwrap();
    }
    let job = JobFolder::new(here.join("job"), None, false);
    for name in ["in", "../out", "in", "../here/in", "../out"] {
        job.note_reading(&here.join(name));
    }
    assert_eq!(job.read_outside(), [real(&dir.path().join("out")).unwrap()]);
    assert!(job.read_outside().is_empty());
}
