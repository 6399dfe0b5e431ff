//! The command line: what is run, from where, and the exit code.

use crate::repl;
use crate::report::files::JobFolder;
use crate::report::output::Output;
use crate::session::{End, Session, read_all};
use clap::Parser;
use std::io::{BufWriter, IsTerminal, Write, stderr, stdin, stdout};
use std::path::{Path, PathBuf};
use windlass_language::source::Text;

/// A command interpreter for marine mooring analysis, in the style of MOSES.
#[derive(Parser, Debug)]
#[command(name = "windlass", version, about)]
pub struct Cli {
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
    /// Let &FILE act outside of the job's own folder
    #[arg(long)]
    pub allow_files: bool,
}

/// Where records come from.
enum Input {
    /// All records of `-c`, one a line.
    Records(String),
    Script {
        name: String,
        text: Text,
        then_terminal: bool,
    },
    Terminal,
}

/// Runs the program; returns the exit code: 0, 1 (an error in the records), 2 (usage).
pub fn run(cli: Cli) -> u8 {
    let terminal = stdin().is_terminal();
    let (input, root) = match input(&cli, terminal) {
        Ok(found) => found,
        Err(text) => {
            // nothing else can be done when the message stream is gone
            let _ = writeln!(stderr(), "windlass: {text}");
            return 2;
        }
    };
    let colour = stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
    let folder = JobFolder::new(root, cli.out.clone(), cli.allow_files);
    // a person sees each line as it comes; a file or a pipe is written in large pieces
    let screen: Box<dyn Write + Send> =
        if stdout().is_terminal() { Box::new(stdout()) } else { Box::new(BufWriter::with_capacity(1 << 16, stdout())) };
    let mut session = Session::new(Output::new(folder, screen, Box::new(stderr()), colour));
    session.job.output.columns = screen_columns;
    session.job.settings.batch = cli.batch;
    session.job.output.keep_log = cli.out.is_some() || !matches!(input, Input::Records(_));
    let interrupt = session.interpreter.interrupt.clone();
    // without the handler Ctrl-C ends the program, which loses no file
    let _ = ctrlc::set_handler(move || interrupt.store(true, std::sync::atomic::Ordering::Relaxed));
    let (end, stay) = match input {
        Input::Records(records) => {
            session.open("-c", records);
            (session.run(), cli.interactive)
        }
        Input::Script { name, text, then_terminal } => {
            session.open_job(&name, text);
            (session.run(), cli.interactive || then_terminal)
        }
        Input::Terminal => (End::Done, true),
    };
    session.job.output.flush();
    let script_errors = session.errors;
    if stay && (end != End::Finished || cli.interactive) {
        repl::run(&mut session, terminal);
    }
    session.finish();
    session.job.output.flush();
    let failed = if terminal && stay { script_errors > 0 } else { session.errors > 0 };
    u8::from(failed)
}

/// Columns of standard output when it is a terminal; one that does not tell has 80.
fn screen_columns() -> Option<usize> {
    let size = || terminal_size::terminal_size_of(stdout());
    stdout().is_terminal().then(|| size().map(|(width, _)| usize::from(width.0)).filter(|w| *w > 0).unwrap_or(80))
}

fn input(cli: &Cli, terminal: bool) -> Result<(Input, PathBuf), String> {
    let here = PathBuf::from("windlass");
    if !cli.commands.is_empty() {
        if let Some(job) = &cli.job {
            return Err(format!(
                "a script and -c cannot be given together; if `{job}` is a record, it needs a -c of its own"
            ));
        }
        return Ok((Input::Records(cli.commands.join("\n")), here));
    }
    if let Some(surplus) = cli.surplus.first() {
        return Err(format!("one script at a time: `{surplus}` is one too many"));
    }
    let Some(job) = &cli.job else {
        return if terminal { Ok((Input::Terminal, here)) } else { Ok((standard_input()?, here)) };
    };
    if job == "-" {
        return Ok((standard_input()?, here));
    }
    let path = Path::new(job);
    if path.is_file() {
        let text = crate::session::read_text(path)?;
        return Ok((Input::Script { name: job.clone(), text, then_terminal: false }, path.with_extension("")));
    }
    if path.is_dir() {
        return Err(format!("{job} is a folder"));
    }
    for end in ["cif", "CIF"] {
        let mut name = path.as_os_str().to_os_string();
        name.push(format!(".{end}"));
        let script = PathBuf::from(name);
        if script.is_file() {
            let text = crate::session::read_text(&script)?;
            return Ok((Input::Script { name: script.display().to_string(), text, then_terminal: true }, path.into()));
        }
    }
    if path.extension().is_some() || !terminal {
        let script = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("cif"));
        return Err(format!(
            "there is no file {job}{}",
            if script { String::new() } else { format!(", nor {job}.cif") }
        ));
    }
    Ok((Input::Terminal, path.into()))
}

fn standard_input() -> Result<Input, String> {
    let text = read_all(stdin(), "standard input")?;
    Ok(Input::Script { name: "standard input".into(), text, then_terminal: false })
}
