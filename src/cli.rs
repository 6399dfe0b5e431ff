//! The command line: what is run, from where, and the exit code.

use crate::commands::find_stored;
use crate::commands::verdict::{OverBreak, Verdict};
use crate::format_scripts::{self, FormatArgs, FormatEnd};
use crate::lsp;
use crate::man_page::man_page;
use crate::manual;
use crate::repl;
use crate::report::files::JobFolder;
use crate::report::live::{LivePage, LivePageFile};
use crate::report::output::Output;
use crate::session::{RecordReadError, Session, SessionEnd, read_all};
use crate::study::report::{self, ReportArgs};
use crate::study::{self, StudyArgs, StudyExit};
use crate::verification::{VerifyArgs, VerifyEnd, verify};
use clap::{CommandFactory, Parser};
use clap_complete::Shell;
use std::io::{BufRead, BufWriter, ErrorKind, IsTerminal, Read, Write, stderr, stdin, stdout};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use windlass_base::diagnostic::nearest;
use windlass_base::printable::printable;
use windlass_language::record::LONGEST_RECORD;
use windlass_language::source::Text;

/// What stands at the end of `--help`.
const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    a record was wrong, or a result was asked for and there is none
  2    wrong use of the command line
  3    all results are there, but a tension exceeds its break in a state that was asked for: &EQUI,
       &STATUS F_CONNECTOR, or a run of TDOM (the largest tension at the first end, unless an action
       by its tension has released the line). MOVE, WATCH and TABLE never give 3, nor does the break
       of a bare diameter: it is given by -B_TENSION, -TENSTR, -FYIELD, -TYPE or -TMAX of the class.
       A line beyond any break whose ends are over 5 % of its length too far apart gives 3 as well.
  130  interrupted
A job that deserves several of them ends with 130 before 1, and with 1 before 3.

A ROOT with the name of a command (run, check, study, verify, open, report, fmt, lsp, manual) is
written with its ending: study.cif, or ./study.";

/// What stands at the end of `windlass verify --help`.
const VERIFY_HELP: &str = "\
Each case is a script with the numbers of its source. A quantity is met to its digits, met (within the
tolerance of the case), explained (beyond it, with the amount and the reason), or missed.

Exit codes:
  0    all quantities are met or explained
  1    a quantity is missed, a case file is wrong, or a file cannot be written
  2    wrong use of the command line";

/// A command interpreter for marine mooring analysis, in the style of MOSES.
#[derive(Parser, Debug)]
#[command(name = "windlass", version, about, after_help = EXIT_CODES)]
#[command(args_conflicts_with_subcommands = true, disable_help_subcommand = true)]
pub struct Cli {
    /// A command; without one the job is run.
    #[command(subcommand)]
    pub command: Option<Subcommand>,
    /// The job.
    #[command(flatten)]
    pub job: JobArgs,
    /// Print the man page
    #[arg(long)]
    pub man: bool,
    /// Print the completions of a shell
    #[arg(long, value_name = "SHELL")]
    pub completions: Option<Shell>,
}

/// The job to run, and how to run it.
#[derive(clap::Args, Debug, Default)]
pub struct JobArgs {
    /// A script (model.cif), an AQWA deck (tow.dat), a ROOT (runs ROOT.cif, then the terminal), or - for standard input
    pub job: Option<String>,
    /// What cannot be taken besides the job
    #[arg(hide = true)]
    pub surplus: Vec<String>,
    /// Execute a record; may be given several times, and blocks go on from one to the next
    #[arg(short = 'c', value_name = "RECORD", allow_hyphen_values = true)]
    pub commands: Vec<String>,
    /// Stay at the terminal after the script
    #[arg(short, long)]
    pub interactive: bool,
    /// Stop at the first error
    #[arg(long)]
    pub batch: bool,
    /// Folder for answers instead of ROOT.ans
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Let the job write outside of its own folder, and &FILE act there
    #[arg(long)]
    pub allow_files: bool,
    /// Keep a page of the model, tables and curves, written anew after each solve; it loads itself again when it changes
    #[arg(long, value_name = "FILE.html")]
    pub page: Option<PathBuf>,
}

/// The script to check.
#[derive(clap::Args, Debug, Default)]
pub struct CheckArgs {
    /// A script (model.cif) or an AQWA deck (tow.dat)
    pub script: String,
    /// List the records by name, and those that do not act
    #[arg(long)]
    pub compat: bool,
}

/// The answers to open.
#[derive(clap::Args, Debug, Default)]
pub struct OpenArgs {
    /// The folder of answers (ROOT.ans)
    pub folder: PathBuf,
    /// Execute a record instead of staying at the terminal; may be given several times
    #[arg(short = 'c', value_name = "RECORD", allow_hyphen_values = true)]
    pub commands: Vec<String>,
    /// Let records write outside of the folder
    #[arg(long)]
    pub allow_files: bool,
}

/// Where the manual goes.
#[derive(clap::Args, Debug, Default)]
pub struct ManualArgs {
    /// A folder; it is made where there is none
    pub dir: PathBuf,
}

/// The words that stand for a command of windlass and for no ROOT.
#[derive(clap::Subcommand, Debug)]
pub enum Subcommand {
    /// Run a job; the word may be left out
    #[command(after_help = EXIT_CODES)]
    Run(JobArgs),
    /// Check a script or a deck: what of it would act, stop a solve, be noted or refused; nothing is solved or written
    Check(CheckArgs),
    /// Run a table of cases, a process each, into one table of results
    #[command(after_help = study::HELP)]
    Study(StudyArgs),
    /// Runs a case of a study, which standard input describes.
    #[command(hide = true, name = study::CASE_COMMAND)]
    StudyCase,
    /// Compare results with published numbers, closed forms, listings and other programs
    #[command(after_help = VERIFY_HELP)]
    Verify(VerifyArgs),
    /// Open the run that a folder of answers holds, without the script that made it
    Open(OpenArgs),
    /// Write the report of a study: a page of HTML, and Markdown
    #[command(after_help = report::HELP)]
    Report(ReportArgs),
    /// Format scripts: blanks, indentation and columns, never a word
    #[command(after_help = format_scripts::HELP)]
    Fmt(FormatArgs),
    /// Serve an editor on standard input and output: errors as one types, help, completion, names
    Lsp,
    /// Write the pages of the manual that are made from the declarations of records below DIR
    Manual(ManualArgs),
}

/// The words that stand for a command.
const COMMANDS: [&str; 9] = ["run", "check", "study", "verify", "open", "report", "fmt", "lsp", "manual"];

impl Subcommand {
    fn name(&self) -> &'static str {
        match self {
            Subcommand::Run(_) => "run",
            Subcommand::Check(_) => "check",
            Subcommand::Study(_) => "study",
            Subcommand::StudyCase => study::CASE_COMMAND,
            Subcommand::Verify(_) => "verify",
            Subcommand::Open(_) => "open",
            Subcommand::Report(_) => "report",
            Subcommand::Fmt(_) => "fmt",
            Subcommand::Lsp => "lsp",
            Subcommand::Manual(_) => "manual",
        }
    }
}

/// Why the command line starts no job.
#[derive(Debug, thiserror::Error)]
enum UsageError {
    #[error("check comes first, and takes a script: windlass check --compat model.cif")]
    CheckFirst,
    #[error("verify comes first: windlass verify --list")]
    VerifyFirst,
    #[error("manual comes first, and takes a folder: windlass manual docs")]
    ManualFirst,
    #[error("study comes first, and takes a table and a script: windlass study cases.csv model.cif --out DIR")]
    StudyFirst,
    #[error("report comes first, and takes the folder of a study: windlass report DIR")]
    ReportFirst,
    #[error("open comes first, and takes a folder of answers: windlass open ROOT.ans")]
    OpenFirst,
    #[error("fmt comes first, and takes scripts: windlass fmt --check model.cif")]
    FormatFirst,
    #[error("lsp comes first, and takes nothing: windlass lsp")]
    ServerFirst,
    #[error("run needs a JOB: a script, a deck, or a ROOT{}", namesake("run"))]
    NoJob,
    #[error("a script and -c cannot be given together; if `{0}` is a record, it needs a -c of its own")]
    ScriptAndRecords(String),
    #[error("one script at a time: `{0}` is one too many")]
    SecondScript(String),
    #[error("there is no file {word}, nor {word}.cif; did you mean the command `{command}`?")]
    MeantCommand { word: String, command: &'static str },
    #[error("{0} is a folder")]
    Folder(String),
    #[error("there is no file {0}")]
    NoScript(String),
    #[error("there is no file {0}, nor {0}.cif")]
    NoRoot(String),
    #[error(transparent)]
    Unreadable(#[from] RecordReadError),
}

/// Where records come from.
enum RecordSource {
    /// All records of `-c`, one a line.
    Records(String),
    Script {
        name: String,
        text: Text,
        then_terminal: bool,
    },
    Terminal,
}

/// Exit code of a wrong use of the command line.
const USAGE: u8 = 2;
/// Exit code of a job with a tension beyond a break.
const OVER_BREAK: u8 = 3;
/// Exit code of a job that was interrupted.
const INTERRUPTED: u8 = 130;

/// Runs the program; returns the exit code, as `--help` lists them.
pub fn run(cli: Cli) -> u8 {
    if cli.man {
        return match man_page(Cli::command()) {
            Ok(page) => print_bytes(&page),
            Err(error) => {
                complain(&format!("the man page cannot be made: {error}"));
                1
            }
        };
    }
    if let Some(shell) = cli.completions {
        let mut script = Vec::new();
        clap_complete::generate(shell, &mut Cli::command(), "windlass", &mut script);
        return print_bytes(&script);
    }
    match &cli.command {
        Some(Subcommand::Check(check)) => return check_script(check),
        Some(Subcommand::Manual(manual)) => return write_manual(&manual.dir),
        Some(Subcommand::Verify(args)) => return run_verification(args),
        Some(Subcommand::Open(open)) => return open_answers(open),
        Some(Subcommand::Study(args)) => return study_code(study::run(args, &mut stdout().lock(), &complain)),
        Some(Subcommand::Report(args)) => return study_code(report::run(args, &mut stdout().lock(), &complain)),
        Some(Subcommand::Fmt(args)) => {
            return match format_scripts::run(args, &mut stdout().lock(), &complain) {
                FormatEnd::Done => 0,
                FormatEnd::Differs => 1,
                FormatEnd::Failed => USAGE,
            };
        }
        Some(Subcommand::Lsp) => {
            if stdin().is_terminal() {
                complain(
                    "lsp is started by an editor: docs/editors.md says how; it speaks the Language Server Protocol",
                );
                return USAGE;
            }
            return lsp::serve(stdin(), stdout());
        }
        Some(Subcommand::StudyCase) => return study::run_one(stdin().lock(), stdout().lock()),
        _ => {}
    }
    match job(cli) {
        Ok(job) => run_job(job),
        Err(error) => {
            complain(&error.to_string());
            USAGE
        }
    }
}

/// The exit code of a study or its report.
fn study_code(exit: StudyExit) -> u8 {
    match exit {
        StudyExit::Done => 0,
        StudyExit::Failed => 1,
        StudyExit::Usage => USAGE,
        StudyExit::Interrupted => INTERRUPTED,
    }
}

/// Prints what the command line draws by itself, the help or what is wrong with it; returns the exit code.
pub fn say(message: &clap::Error) -> u8 {
    match message.print().and_then(|()| stdout().flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            complain(&format!("standard output cannot be written: {error}"));
            1
        }
        _ => u8::try_from(message.exit_code()).unwrap_or(USAGE),
    }
}

/// A line on the message stream; nothing else can be done when it is gone.
fn complain(text: &str) {
    let _ = writeln!(stderr(), "windlass: {}", printable(text));
}

/// The job to run, of what stands on the command line.
fn job(cli: Cli) -> Result<JobArgs, UsageError> {
    let (name, job) = match cli.command {
        Some(Subcommand::Run(job)) => ("run", job),
        Some(command) => (command.name(), JobArgs::default()),
        None => {
            // a command behind options
            let mut job = cli.job;
            match COMMANDS.iter().find(|name| job.job.as_deref() == Some(**name)) {
                Some(name) => {
                    job.job = (!job.surplus.is_empty()).then(|| job.surplus.remove(0));
                    (*name, job)
                }
                None => return Ok(job),
            }
        }
    };
    match name {
        "run" if job.job.is_some() || !job.commands.is_empty() => Ok(job),
        "run" => Err(UsageError::NoJob),
        "check" => Err(UsageError::CheckFirst),
        "manual" => Err(UsageError::ManualFirst),
        "verify" => Err(UsageError::VerifyFirst),
        "open" => Err(UsageError::OpenFirst),
        "study" => Err(UsageError::StudyFirst),
        "fmt" => Err(UsageError::FormatFirst),
        "lsp" => Err(UsageError::ServerFirst),
        _ => Err(UsageError::ReportFirst),
    }
}

/// Prints bytes on the standard output; returns the exit code.
fn print_bytes(bytes: &[u8]) -> u8 {
    match stdout().write_all(bytes).and_then(|()| stdout().flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            complain(&format!("standard output cannot be written: {error}"));
            1
        }
        _ => 0,
    }
}

/// Writes the made pages of the manual below a folder; returns the exit code.
fn write_manual(dir: &Path) -> u8 {
    let pages = manual::build_pages();
    let mut written = 0;
    for page in &pages {
        let path = dir.join(&page.path);
        let (parent, name) = (path.parent().unwrap_or(dir), path.file_name().unwrap_or_default());
        let made = std::fs::create_dir_all(parent).map_err(|error| format!("{}: {error}", parent.display()));
        let folder = JobFolder::new(PathBuf::from("manual"), Some(parent.to_path_buf()), false);
        let done = made.and_then(|()| folder.check().map_err(|e| e.to_string())).and_then(|()| {
            // a page of an earlier version makes way; what is no such page is kept under another name
            match std::fs::read_to_string(&path) {
                Ok(earlier) if manual::is_made_page(&earlier) => replace_page(&path, page, &earlier),
                _ => {
                    let done = folder.write(&name.to_string_lossy(), page.text.as_bytes());
                    done.map(drop).map_err(|error| error.to_string())
                }
            }
        });
        match done {
            Ok(()) => written += 1,
            Err(error) => {
                complain(&format!("the manual cannot be written: {error}"));
                return 1;
            }
        }
    }
    print_bytes(format!("{written} pages below {}\n", printable(&dir.display().to_string())).as_bytes())
}

/// Puts a made page in the place of an earlier one, whole or not at all; one that is the same stays as it is.
fn replace_page(path: &Path, page: &manual::Page, earlier: &str) -> Result<(), String> {
    if earlier == page.text {
        return Ok(());
    }
    let fresh = path.with_extension("md.new");
    let done = std::fs::write(&fresh, &page.text).and_then(|()| std::fs::rename(&fresh, path));
    done.map_err(|error| format!("{}: {error}", path.display()))
}

/// How to run a file that has the name of a command, where there is one.
fn namesake(name: &str) -> String {
    let with_ending = [".cif", ".CIF", ".dat", ".DAT"].map(|end| format!("{name}{end}"));
    let script = with_ending.into_iter().find(|file| Path::new(file).is_file());
    let here = Path::new(name);
    match script {
        // a folder or a file of the bare name stands before the ROOT
        Some(script) if here.exists() || !script.ends_with("cif") => {
            format!("; the file {script} has its name: write `{script}` to run it")
        }
        Some(script) => format!("; the script {script} has its name: write `./{name}` or `{script}` to run it"),
        None if here.is_file() => format!("; there is a file of this name: write `./{name}` to run it"),
        None => String::new(),
    }
}

/// Runs verification cases; returns the exit code.
fn run_verification(args: &VerifyArgs) -> u8 {
    match verify(args, &mut stdout().lock(), &complain) {
        VerifyEnd::Met => 0,
        VerifyEnd::Missed => 1,
        VerifyEnd::Usage => USAGE,
    }
}

/// Opens the run of a folder of answers, then executes records or stays at the terminal; returns the exit code.
fn open_answers(args: &OpenArgs) -> u8 {
    // a ROOT stands for its folder
    let named = PathBuf::from(format!("{}.ans", args.folder.display()));
    let is_root = !args.folder.is_dir() && named.is_dir();
    let folder = if is_root { named } else { args.folder.clone() };
    let (kept, records) = match find_stored(&folder) {
        Ok(found) => found,
        Err(error) => {
            complain(&error.to_string());
            return USAGE;
        }
    };
    let terminal = stdin().is_terminal();
    let colour = stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
    // the files that a case of a study reads are named from its script
    let root = report::script_of_case(&folder).unwrap_or_else(|| folder.clone()).with_extension("");
    let job = JobFolder::new(root, Some(folder.clone()), args.allow_files);
    let mut session = Session::new(Output::new(job, Box::new(stdout()), Box::new(stderr()), colour));
    session.job.output.columns = screen_columns;
    session.job.output.lines = screen_lines;
    // the log of the job stays as it is
    session.job.output.keep_log = false;
    session.job.ask = Some(Arc::new(ask_standard_input));
    let running = Arc::clone(&session.interpreter.interrupt);
    // without the handler Ctrl-C ends the program, which loses no file
    let _ = ctrlc::set_handler(move || running.store(true, Ordering::Relaxed));
    if !session.open_stored(kept, &records) {
        let text = "cannot be opened: the records kept beside it do not make its model again";
        complain(&format!("the run in {} {text}", folder.display()));
        return 1;
    }
    if args.commands.is_empty() {
        repl::run(&mut session, terminal);
    } else {
        session.open("-c", args.commands.join("\n"));
        session.run();
    }
    session.finish();
    session.job.output.flush();
    exit_code(&session)
}

/// Checks a script; 1 where a record is refused.
fn check_script(args: &CheckArgs) -> u8 {
    let path = Path::new(&args.script);
    let text = match crate::session::read_text(path) {
        Ok(text) => text,
        Err(error) => {
            complain(&error.to_string());
            return USAGE;
        }
    };
    let colour = stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
    let folder = JobFolder::new(path.with_extension(""), None, false);
    let mut session = Session::new(Output::new(folder, Box::new(stdout()), Box::new(stderr()), colour));
    session.job.output.columns = screen_columns;
    session.job.output.keep_log = false;
    session.start_check();
    let by_name = args.compat;
    // a record that takes too long has no end to wait for: what was found is printed here, and the program ends
    let _watch = session.watch_check(move |report| {
        let code = i32::from(report.has_refused());
        for line in report.take_lines(by_name).unwrap_or_default() {
            let _ = writeln!(stdout(), "{line}");
        }
        std::process::exit(code);
    });
    session.open_to_check(&args.script, path, text);
    session.run();
    session.print_check(args.compat);
    session.job.output.flush();
    exit_code(&session)
}

fn run_job(cli: JobArgs) -> u8 {
    let terminal = stdin().is_terminal();
    // a job that is still being read is given up at once; later the record that runs says what it has
    let running: Arc<OnceLock<Arc<AtomicBool>>> = Arc::default();
    let interrupted = Arc::clone(&running);
    // without the handler Ctrl-C ends the program, which loses no file
    let _ = ctrlc::set_handler(move || match interrupted.get() {
        Some(flag) => flag.store(true, Ordering::Relaxed),
        None => std::process::exit(INTERRUPTED.into()),
    });
    if let Some(out) = cli.out.as_ref().filter(|out| out.exists() && !out.is_dir()) {
        complain(&format!("--out {}: this is a file; name a folder", out.display()));
        return USAGE;
    }
    let (input, root) = match input(&cli, terminal) {
        Ok(found) => found,
        Err(error) => {
            complain(&error.to_string());
            return USAGE;
        }
    };
    let colour = stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
    let folder = JobFolder::new(root, cli.out.clone(), cli.allow_files);
    if let Err(error) = folder.check() {
        complain(&format!("{error}; {}", error.help().unwrap_or_default()));
        return USAGE;
    }
    // a person sees each line as it comes; a file or a pipe is written in large pieces
    let screen: Box<dyn Write + Send> =
        if stdout().is_terminal() { Box::new(stdout()) } else { Box::new(BufWriter::with_capacity(1 << 16, stdout())) };
    let mut session = Session::new(Output::new(folder, screen, Box::new(stderr()), colour));
    session.job.output.columns = screen_columns;
    session.job.output.lines = screen_lines;
    session.job.settings.batch = cli.batch;
    if let Some(path) = &cli.page {
        let made = LivePageFile::new(path.clone()).and_then(|mut file| {
            let (title, state) = (path.display().to_string(), "the job begins");
            let units = session.job.units;
            file.write(&LivePage { title: &title, state, scene: None, tables: &[], run: None, units }).map(|()| file)
        });
        match made {
            Ok(file) => session.job.page = Some(file),
            Err(error) => {
                complain(&error.to_string());
                return USAGE;
            }
        }
    }
    // a terminal that goes on to give records asks in its own way
    session.job.ask = Some(Arc::new(ask_standard_input));
    session.job.output.keep_log = cli.out.is_some() || !matches!(input, RecordSource::Records(_));
    // nothing has set it before
    let _ = running.set(Arc::clone(&session.interpreter.interrupt));
    let (end, stay) = match input {
        RecordSource::Records(records) => {
            session.open("-c", records);
            (session.run(), cli.interactive)
        }
        RecordSource::Script { name, text, then_terminal } => {
            session.open_job(&name, text);
            (session.run(), cli.interactive || then_terminal)
        }
        RecordSource::Terminal => (SessionEnd::Done, true),
    };
    session.write_page(if stay { "the terminal waits" } else { "the job is done" });
    session.job.output.flush();
    let of_script = exit_code(&session);
    if stay && (end != SessionEnd::Finished || (cli.interactive && !cli.batch)) {
        repl::run(&mut session, terminal);
    }
    session.write_page("the job is done");
    session.finish();
    session.job.output.flush();
    // what a person saw at the terminal is not said again
    let code = if terminal && stay { of_script } else { exit_code(&session) };
    if !(terminal && stay) {
        let verdict = &session.job.verdict;
        if session.errors == 0 && verdict.absent > 0 {
            complain("exit code 1: a result that was asked for does not exist; the warnings say why");
        }
        if !verdict.over_break.is_empty() {
            let text = over_break(verdict);
            complain(&if code == OVER_BREAK { format!("exit code 3: {text}") } else { text });
        }
    }
    code
}

/// The answer to a `&GET` of a script: a line of standard input; `None` at its end. The question stands on the message stream.
fn ask_standard_input(prompt: &str) -> Option<String> {
    // nothing else can be done when the message stream is gone
    let _ = write!(stderr(), "{}? ", printable(prompt)).and_then(|()| stderr().flush());
    let mut bytes = Vec::new();
    let most = u64::try_from(LONGEST_RECORD).unwrap_or(u64::MAX);
    let read = stdin().lock().take(most).read_until(b'\n', &mut bytes);
    if !stdin().is_terminal() {
        let _ = writeln!(stderr());
    }
    let text = String::from_utf8_lossy(&bytes);
    matches!(read, Ok(1..)).then(|| text.trim_end_matches(['\n', '\r']).to_string())
}

fn exit_code(session: &Session) -> u8 {
    let verdict = &session.job.verdict;
    if session.interpreter.was_interrupted {
        INTERRUPTED
    } else if session.errors > 0 || verdict.absent > 0 {
        1
    } else if verdict.over_break.is_empty() {
        0
    } else {
        OVER_BREAK
    }
}

/// Connectors named for a tension beyond their break.
const MOST_NAMED: usize = 5;

/// The largest tensions over break, one a connector.
fn over_break(verdict: &Verdict) -> String {
    let mut list: Vec<&OverBreak> = verdict.over_break.iter().collect();
    list.sort_by(|a, b| b.ratio.total_cmp(&a.ratio));
    let mut named: Vec<&OverBreak> = Vec::new();
    for over in list {
        if !named.iter().any(|n| n.connector.eq_ignore_ascii_case(&over.connector)) {
            named.push(over);
        }
    }
    let more = named.len().saturating_sub(MOST_NAMED);
    let one = |o: &&OverBreak| format!("{} ({})", o.text(), o.command);
    let text = named.iter().take(MOST_NAMED).map(one).collect::<Vec<_>>().join("; ");
    format!("{text}{}", if more > 0 { format!("; and {more} connectors more") } else { String::new() })
}

/// Columns of standard output when it is a terminal; one that does not say has 80.
fn screen_columns() -> Option<usize> {
    let size = || terminal_size::terminal_size_of(stdout());
    stdout().is_terminal().then(|| size().map(|(width, _)| usize::from(width.0)).filter(|w| *w > 0).unwrap_or(80))
}

/// Lines of standard output when it is a terminal; one that does not say has 24.
fn screen_lines() -> Option<usize> {
    let size = || terminal_size::terminal_size_of(stdout());
    stdout().is_terminal().then(|| size().map(|(_, height)| usize::from(height.0)).filter(|h| *h > 0).unwrap_or(24))
}

fn input(cli: &JobArgs, terminal: bool) -> Result<(RecordSource, PathBuf), UsageError> {
    let here = PathBuf::from("windlass");
    if !cli.commands.is_empty() {
        if let Some(job) = &cli.job {
            return Err(UsageError::ScriptAndRecords(job.clone()));
        }
        return Ok((RecordSource::Records(cli.commands.join("\n")), here));
    }
    if let Some(surplus) = cli.surplus.first() {
        let meant = cli.job.as_ref().and_then(|job| meant_command(job, true));
        return Err(meant.unwrap_or_else(|| UsageError::SecondScript(surplus.clone())));
    }
    let Some(job) = &cli.job else {
        return if terminal { Ok((RecordSource::Terminal, here)) } else { Ok((standard_input()?, here)) };
    };
    if job == "-" {
        return Ok((standard_input()?, here));
    }
    let path = Path::new(job);
    if path.is_file() {
        let text = crate::session::read_text(path)?;
        return Ok((RecordSource::Script { name: job.clone(), text, then_terminal: false }, path.with_extension("")));
    }
    if let Some(script) = script_of_root(path) {
        let text = crate::session::read_text(&script)?;
        return Ok((
            RecordSource::Script { name: script.display().to_string(), text, then_terminal: true },
            path.into(),
        ));
    }
    if path.is_dir() {
        return Err(UsageError::Folder(job.clone()));
    }
    if let Some(error) = meant_command(job, false) {
        return Err(error);
    }
    if path.extension().is_some() || !terminal {
        let script = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("cif"));
        return Err(if script { UsageError::NoScript(job.clone()) } else { UsageError::NoRoot(job.clone()) });
    }
    Ok((RecordSource::Terminal, path.into()))
}

/// The error of a word that is no file and is a command but for its case, or is near to one: a lone word may be a new ROOT.
fn meant_command(word: &str, near_too: bool) -> Option<UsageError> {
    if Path::new(word).exists() || script_of_root(Path::new(word)).is_some() {
        return None;
    }
    let same = COMMANDS.into_iter().find(|name| name.eq_ignore_ascii_case(word));
    let command = same.or_else(|| nearest(word, COMMANDS).first().copied().filter(|_| near_too))?;
    Some(UsageError::MeantCommand { word: word.to_string(), command })
}

/// The script of a ROOT, where there is one.
fn script_of_root(root: &Path) -> Option<PathBuf> {
    let with = |end: &str| {
        let mut name = root.as_os_str().to_os_string();
        name.push(end);
        PathBuf::from(name)
    };
    [".cif", ".CIF"].map(with).into_iter().find(|script| script.is_file())
}

fn standard_input() -> Result<RecordSource, UsageError> {
    let text = read_all(stdin(), "standard input")?;
    Ok(RecordSource::Script { name: "standard input".into(), text, then_terminal: false })
}
