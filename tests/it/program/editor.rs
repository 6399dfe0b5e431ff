//! The editor through a pseudo-terminal, as a person sees it: completion, hints, history, Ctrl-C, a wrong record, blocks
//! over several lines, a resize.

#![cfg(unix)]
use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};
use std::io::{Read, Write};
use std::num::NonZeroU16;
use std::path::Path;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

const SIZE: PtySize = PtySize { rows: 30, cols: 100, pixel_width: 0, pixel_height: 0 };

fn whole(n: u16) -> NonZeroU16 {
    NonZeroU16::new(n).unwrap()
}

/// A program in a pseudo-terminal, and what its screen shows.
pub(super) struct Terminal {
    child: Box<dyn Child + Send + Sync>,
    master: Box<dyn MasterPty + Send>,
    keys: Box<dyn Write + Send>,
    bytes: Receiver<Vec<u8>>,
    screen: vt100::Parser,
    /// Bytes that came from the program.
    received: usize,
}

impl Terminal {
    pub(super) fn start(home: &Path, arguments: &[&str]) -> Terminal {
        Terminal::start_sized(home, arguments, SIZE, &[("PAGER", "cat")])
    }

    /// Starts it in a terminal of a size, with variables of the environment.
    pub(super) fn start_sized(home: &Path, arguments: &[&str], size: PtySize, variables: &[(&str, &str)]) -> Terminal {
        let pair = native_pty_system().openpty(size).unwrap();
        let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_windlass"));
        command.args(arguments);
        command.cwd(home);
        command.env("HOME", home);
        command.env("XDG_STATE_HOME", home.join("state"));
        command.env("TERM", "xterm-256color");
        command.env_remove("NO_COLOR");
        variables.iter().for_each(|(name, value)| command.env(name, value));
        let child = pair.slave.spawn_command(command).unwrap();
        drop(pair.slave);
        let mut reader = pair.master.try_clone_reader().unwrap();
        let (sender, bytes) = channel();
        std::thread::spawn(move || {
            let mut buffer = [0; 4096];
            while let Ok(count) = reader.read(&mut buffer) {
                if count == 0 || sender.send(buffer[..count].to_vec()).is_err() {
                    break;
                }
            }
        });
        let keys = pair.master.take_writer().unwrap();
        Terminal {
            child,
            master: pair.master,
            keys,
            bytes,
            screen: vt100::Parser::new(whole(size.rows), whole(size.cols), 500),
            received: 0,
        }
    }

    pub(super) fn press(&mut self, keys: &str) {
        self.keys.write_all(keys.as_bytes()).unwrap();
        self.keys.flush().unwrap();
    }

    /// Waits until something holds of the screen; the time limit only ends a test that has failed.
    fn wait(&mut self, what: &str, holds: impl Fn(&vt100::Screen) -> bool) {
        let limit = Instant::now() + Duration::from_secs(20);
        while !holds(self.screen.screen()) {
            let left = limit.saturating_duration_since(Instant::now());
            match self.bytes.recv_timeout(left) {
                Ok(bytes) => {
                    self.received += bytes.len();
                    self.screen.process(&bytes);
                }
                Err(_) => {
                    let _ = self.child.kill();
                    panic!("{what} never came; the screen holds\n{}", self.screen.screen().contents());
                }
            }
        }
    }

    /// Waits for a text anywhere on the screen.
    pub(super) fn see(&mut self, text: &str) {
        self.wait(text, |screen| screen.contents().contains(text));
    }

    /// Waits until the editor has printed this prompt and the cursor stands behind it: only then is it in raw mode.
    pub(super) fn ready(&mut self, prompt: &str) {
        self.wait(prompt, |screen| {
            let (row, column) = screen.cursor_position();
            let line = screen.rows(0, 200).nth(row.into()).unwrap_or_default();
            line.trim_end() == prompt.trim_end() && usize::from(column) == prompt.len()
        });
    }

    /// Types a record, sees it on the line, and enters it.
    pub(super) fn record(&mut self, text: &str) {
        self.press(text);
        self.see(text);
        self.press("\r");
    }

    /// The bytes the program has written until it ended by itself.
    pub(super) fn all_output(mut self) -> Vec<u8> {
        let mut all = Vec::new();
        while let Ok(bytes) = self.bytes.recv_timeout(Duration::from_secs(60)) {
            all.extend(bytes);
        }
        let _ = self.child.kill();
        all
    }

    pub(super) fn end(mut self) -> u32 {
        self.press("\x04");
        let limit = Instant::now() + Duration::from_secs(20);
        loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                return status.exit_code();
            }
            if Instant::now() > limit {
                let _ = self.child.kill();
                panic!("the program did not end; the screen holds\n{}", self.screen.screen().contents());
            }
            std::thread::yield_now();
        }
    }
}

#[test]
fn completion_hints_wrong_record_and_ctrl_c() {
    let home = tempfile::tempdir().unwrap();
    let mut t = Terminal::start(home.path(), &[]);
    t.ready("MAIN> ");
    t.press("MED\t");
    t.see("MAIN> MEDIT ");
    t.press("\r");
    t.ready("MEDIT> ");
    t.record("*MLA 1 2 3");
    t.ready("MEDIT> ");
    t.press("~WIRE B_C\t");
    t.see("~WIRE B_CAT ");
    t.press("4 -LEN 100 -DEPA\t");
    t.see("-DEPANCHOR DEPTH");
    t.press("50\r");
    t.ready("MEDIT> ");
    t.press("~LEG B_CAT -TY\tWIRE_S\t");
    t.see("~LEG B_CAT -TYPE WIRE_SPIRAL");
    t.press("3.5 -LEN 100\r");
    t.ready("MEDIT> ");
    t.press("&STATUS LINE_T\tHM\t");
    t.see("&STATUS LINE_TYPES HMPE");
    t.press("\x03");
    t.ready("MEDIT> ");
    t.press("CONNECTOR A ~W\t*\t");
    t.see("CONNECTOR A ~WIRE *MLA");
    t.press("\r");
    t.ready("MEDIT> ");
    t.record("NONSENSE");
    t.see("unknown command `NONSENSE` in menu MEDIT");
    t.ready("MEDIT> ");
    t.press("half a record");
    t.see("half a record");
    t.press("\x03");
    t.ready("MEDIT> ");
    t.press("~X B_CAT 4 \\\r-LEN ten");
    t.see("-LEN ten");
    t.press("\r");
    t.see("L of -LEN of B_CAT must be a number (ft)");
    t.ready("MEDIT> ");
    t.record("&LOOP I 1 2");
    t.ready("loop ... ");
    t.press("\x03");
    t.see("the open block is given up");
    t.ready("MEDIT> ");
    t.record("&LOOP I 1 2");
    t.ready("loop ... ");
    t.record("&TYPE trip %I");
    t.ready("loop ... ");
    t.record("&ENDLOOP");
    t.see("trip 2");
    t.ready("MEDIT> ");
    assert_eq!(t.end(), 0);
}

#[test]
fn history_persists_between_sessions() {
    let home = tempfile::tempdir().unwrap();
    let mut t = Terminal::start(home.path(), &[]);
    t.ready("MAIN> ");
    t.record("&TYPE remember me");
    t.ready("MAIN> ");
    assert_eq!(t.end(), 0);
    let mut t = Terminal::start(home.path(), &[]);
    t.ready("MAIN> ");
    t.press("\x1b[A");
    t.see("MAIN> &TYPE remember me");
    t.press("\r");
    t.ready("MAIN> ");
    assert_eq!(t.end(), 0);
}

#[test]
fn resize_leaves_editor_working() {
    let home = tempfile::tempdir().unwrap();
    let mut t = Terminal::start(home.path(), &[]);
    t.ready("MAIN> ");
    t.press("&TYPE before");
    t.see("&TYPE before");
    t.master.resize(PtySize { rows: 12, cols: 60, ..SIZE }).unwrap();
    t.screen.screen_mut().set_size(whole(12), whole(60));
    t.press(" and after\r");
    t.see("\nbefore and after");
    t.ready("MAIN> ");
    assert_eq!(t.end(), 0);
}

#[test]
fn ctrl_c_stops_endless_loop_and_returns_to_prompt() {
    let home = tempfile::tempdir().unwrap();
    let script = "&DEVICE -RECORDS 1000000000000\n&TYPE begun\n&LOOP\n&SET A = 1\n&ENDLOOP\n";
    std::fs::write(home.path().join("job.cif"), script).unwrap();
    let mut t = Terminal::start(home.path(), &["-i", "job.cif"]);
    t.see("begun");
    t.press("\x03");
    t.see("interrupted");
    t.ready("MAIN> ");
    t.record("&TYPE alive");
    t.ready("MAIN> ");
    assert_eq!(t.end(), 130);
}

#[test]
fn script_stopped_by_ctrl_c_exits_with_130() {
    let home = tempfile::tempdir().unwrap();
    let script = "&DEVICE -RECORDS 1000000000000\n&TYPE begun\n&LOOP\n&SET A = 1\n&ENDLOOP\n";
    std::fs::write(home.path().join("job.cif"), script).unwrap();
    let mut t = Terminal::start(home.path(), &["run", "job.cif"]);
    t.see("begun");
    t.press("\x03");
    t.see("interrupted");
    assert_eq!(t.end(), 130);
}

#[test]
fn root_runs_its_script_and_continues_at_terminal() {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("barge.cif"), "&TYPE from the script\nMEDIT\n").unwrap();
    let mut t = Terminal::start(home.path(), &["barge"]);
    t.see("from the script");
    t.ready("MEDIT> ");
    assert_eq!(t.end(), 0);
}

#[test]
fn output_without_terminal_has_no_colour() {
    let run = std::process::Command::new(env!("CARGO_BIN_EXE_windlass")).args(["-c", "NONSENSE"]).output().unwrap();
    assert!(!run.stderr.contains(&0x1b), "{}", String::from_utf8_lossy(&run.stderr));
}

#[test]
fn records_typed_ahead_all_run_in_order() {
    let home = tempfile::tempdir().unwrap();
    let mut t = Terminal::start(home.path(), &[]);
    t.ready("MAIN> ");
    let many: String = (3..40).map(|i| format!("*P{i} {i} 0 0\r")).collect();
    t.press(&format!(
        "MEDIT\r*A 1 1 1\r*B 1 1 1\r{many}&TYPE names &TOKEN(1 &NAMES(POINTS)) &TOKEN(N &NAMES(POINTS))\r"
    ));
    t.see("names *A 39");
    t.ready("MEDIT> ");
    t.press("&TYPE got &GET(name)\rJoe\r&TYPE and on\r");
    t.see("got Joe");
    t.see("\nand on");
    t.ready("MEDIT> ");
    t.press("\x1b[A\x1b[A");
    t.wait("the last record but one", |screen| {
        let (row, _) = screen.cursor_position();
        screen.rows(0, 200).nth(row.into()).is_some_and(|line| line.trim_end() == "MEDIT> &TYPE got &GET(name)")
    });
    t.press("\x03");
    t.ready("MEDIT> ");
    assert_eq!(t.end(), 0);
}

#[test]
fn completion_offers_every_kind_of_word_and_no_lone_dash() {
    let home = tempfile::tempdir().unwrap();
    let mut t = Terminal::start(home.path(), &[]);
    t.ready("MAIN> ");
    t.record("MEDIT");
    t.ready("MEDIT> ");
    t.record("&DESCRIBE BODY TBRG");
    t.ready("MEDIT> ");
    for (keys, line) in [
        ("~W B_CAT 4 -LEN \t5", "~W B_CAT 4 -LEN 5"),
        ("&STATUS CON\t!", "&STATUS CONFIGURATION !"),
        ("&HELP TRAJ\t!", "&HELP TRAJECTORY !"),
        ("&HELP DIM\t!", "&HELP &DIMEN !"),
        ("&HELP &NUM\t!", "&HELP &NUMBER !"),
        ("&ENV -SEA JON\t1", "&ENV -SEA JONSWAP 1"),
        ("&ENV X -USE_MEAN N\t!", "&ENV X -USE_MEAN NO !"),
        ("&TYPE &NUM\tREAL", "&TYPE &NUMBER(REAL"),
        ("&TYPE 1-&NUM\tREAL", "&TYPE 1-&NUMBER(REAL"),
        ("DELETE TB\t!", "DELETE TBRG !"),
    ] {
        t.press(keys);
        t.see(&format!("MEDIT> {line}"));
        t.press("\x03");
        t.ready("MEDIT> ");
    }
    for (keys, shown) in [("&STATUS C\t", "CL_FLEX"), ("&HELP ST\t", "STORE"), ("~W B_CAT 4 \t", "-DEPANCHOR")] {
        t.press(keys);
        t.see(shown);
        t.press("\x03");
        t.ready("MEDIT> ");
    }
    assert_eq!(t.end(), 0);
}

#[test]
fn ctrl_c_leaves_line_without_its_hint() {
    let home = tempfile::tempdir().unwrap();
    let mut t = Terminal::start(home.path(), &[]);
    t.ready("MAIN> ");
    t.press("&DIMEN -DIMEN ");
    t.wait("the hint", |screen| {
        screen
            .contents()
            .lines()
            .any(|l| l.len() > "MAIN> &DIMEN -DIMEN ".len() && l.starts_with("MAIN> &DIMEN -DIMEN "))
    });
    t.press("\x03");
    t.ready("MAIN> ");
    let screen = t.screen.screen().contents();
    assert!(screen.lines().any(|l| l.trim_end() == "MAIN> &DIMEN -DIMEN"), "{screen}");
    assert_eq!(t.end(), 0);
}

#[test]
fn ctrl_d_names_the_unclosed_block() {
    let home = tempfile::tempdir().unwrap();
    for (record, prompt, said) in [
        ("&LOOP I 1 2", "loop ... ", "this &LOOP is not closed"),
        ("&IF .TRUE. &THEN", "if ... ", "this &IF is not closed"),
        ("&MACRO M", "macro ... ", "this &MACRO is not closed"),
    ] {
        let mut t = Terminal::start(home.path(), &[]);
        t.ready("MAIN> ");
        t.record(record);
        t.ready(prompt);
        t.press("\x04");
        t.see(said);
        t.see("terminal:1:1");
    }
}

#[test]
fn plot_has_terminal_width_unless_its_size_is_set() {
    let home = tempfile::tempdir().unwrap();
    let mut t = Terminal::start(home.path(), &[]);
    t.ready("MAIN> ");
    t.record("&DATA CURVES C_PROFILE CUR 0 1 100 2");
    t.ready("MAIN> ");
    for (columns, setting, width) in
        [(100, "&TYPE as it is", 99..=100), (60, "&TYPE as it is", 58..=60), (60, "&DEVICE -PLOT_SIZE 45 12", 40..=45)]
    {
        t.master.resize(PtySize { rows: 60, cols: columns, ..SIZE }).unwrap();
        t.screen.screen_mut().set_size(whole(60), whole(columns));
        t.press("\x0c");
        t.ready("MAIN> ");
        t.record(setting);
        t.ready("MAIN> ");
        t.press("\x0c");
        t.wait("a cleared screen", |screen| screen.contents().trim() == "MAIN>");
        t.record("&STATUS CURVES -PLOT");
        t.ready("DISPOSITION> ");
        let rows: Vec<String> = t.screen.screen().rows(0, 300).collect();
        let plotted = |row: &&String| row.contains(|c| ('\u{2800}'..='\u{28ff}').contains(&c));
        let got = rows.iter().filter(plotted).map(|r| r.trim_end().chars().count()).max().unwrap_or(0);
        assert!(width.contains(&got), "{got} of {columns}\n{}", rows.join("\n"));
        t.record("END");
        t.ready("MAIN> ");
    }
    assert_eq!(t.end(), 0);
}

#[test]
fn comment_line_inside_continued_record_waits_for_next_line() {
    let home = tempfile::tempdir().unwrap();
    let mut t = Terminal::start(home.path(), &[]);
    t.ready("MAIN> ");
    t.press("&TYPE one \\\r$ a remark\rtwo\r");
    t.wait("both halves", |screen| screen.contents().lines().any(|l| l.starts_with("one") && l.ends_with("two")));
    t.ready("MAIN> ");
    assert_eq!(t.end(), 0);
}

#[test]
fn very_long_run_is_announced_and_interrupt_promises_no_file() {
    let home = tempfile::tempdir().unwrap();
    let records = "&DIMEN -DIMEN METERS N\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n\
         #WEIGHT *C 9806.65 1 1 1\n~S GSPR BOTH X 4000 1E9 -LEN 0\nCONNECTOR S ~S *C *G\nEND\n&ENV -TIME 1E9 0.001\nTDOM -STATISTICS\n";
    std::fs::write(home.path().join("job.cif"), records).unwrap();
    let mut t = Terminal::start(home.path(), &["run", "job.cif"]);
    t.see("1.0e12 steps");
    t.see("Ctrl-C ends it");
    t.press("\x03");
    t.see("-STATISTICS keeps no file to go on from");
    assert_eq!(t.end(), 130);
}

#[test]
fn typed_record_may_create_outside_file_after_one_question() {
    let home = tempfile::tempdir().unwrap();
    let file = |name: &str| home.path().join(name);
    std::fs::write(file("mine"), "mine").unwrap();
    std::fs::write(file("script.cif"), "&FILE OPEN S ./by_script\n").unwrap();
    let mut t = Terminal::start(home.path(), &[]);
    t.ready("MAIN> ");
    t.record("&FILE OPEN T ./new");
    t.see("new is outside of the job's folder. Create it (y/N)?");
    t.press("y\r");
    t.ready("MAIN> ");
    t.record("&FILE CLOSE T");
    t.ready("MAIN> ");
    t.record("&FILE OPEN U ./other");
    t.see("other is outside of the job's folder. Create it (y/N)?");
    t.press("\r");
    t.see("the answer was no");
    t.ready("MAIN> ");
    t.record("&FILE OPEN U ./mine");
    t.see("no file is overwritten");
    t.ready("MAIN> ");
    t.record("&INSERT script.cif");
    t.see("by_script is not below the job's own folder");
    t.ready("MAIN> ");
    t.end();
    assert_eq!((std::fs::read(file("new")).unwrap(), std::fs::read(file("mine")).unwrap()), (vec![], b"mine".to_vec()));
    assert!(!file("other").exists() && !file("by_script").exists());
}

#[test]
fn long_line_printing_time_is_proportional_to_its_length() {
    let home = tempfile::tempdir().unwrap();
    let mut t = Terminal::start(home.path(), &[]);
    t.ready("MAIN> ");
    let before = t.received;
    t.press(&format!("&TYPE {}THE_END", "word ".repeat(2000)));
    t.see("THE_END");
    // 1,000 characters painted one by one are less than 1 MB (half a square, each word with two escapes); then the whole line is printed
    // once a row of 100 characters: half of 100 times 10,000 characters. Painted to its end it would be 50 MB and more
    let printed = t.received - before;
    assert!(printed < 2_000_000, "{printed} bytes");
    t.press("\r");
    t.ready("MAIN> ");
    assert_eq!(t.end(), 0);
}
