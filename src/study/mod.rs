//! `windlass study`: runs a table of cases, a process each, and writes one table of what came of them.

mod case_process;
mod ensembles;
mod parquet_table;
mod parts;
mod peaks;
pub mod report;
mod seed_checks;
mod slurm;
mod tables;
mod variables;

pub use case_process::{CASE_COMMAND, CaseProgram, run_one};
pub use tables::StudyTables;

use self::case_process::Processes;
use self::slurm::SlurmOptions;
use crate::report::files::read_regular;
use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, Write, stderr};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use windlass_base::printable::printable;
use windlass_study::parts::newest_division;
use windlass_study::record::CaseStatus;
use windlass_study::runner::{Keep, Progress, RunCase, StudyEnd, StudyPlan, run_study};
use windlass_study::store::{Files, SCATTER_PERCENT, Study, StudyError, SystemFiles};
use windlass_study::table::{Case, CaseTable, MOST_CASES};

/// Longest table (bytes).
const LARGEST_TABLE: u64 = 1 << 30;
/// Failed cases that are named at the end.
const MOST_NAMED: usize = 10;

/// What stands at the end of `windlass study --help`.
pub const HELP: &str = "\
Each row of TABLE is a case: its columns become variables of MODEL (%HS%, %HEADING%), the column case names it, and %SEED% is made
of --seed, the name and the column member; lost, condition and stiffness say which lines are lost and how stiff fibre ropes are. TABLE is a CSV or Parquet file, or a TOML file of lists that are multiplied. MODEL keeps results by
&RESULT, by -RESULT of STATISTIC and EXTREMES, and by CODE_CHECK; they become columns of DIR/results.csv and results.parquet, and
rows of lines.csv. The same command again goes on where the study was stopped, and runs again what has changed.

    windlass study cases.csv model.cif --out DIR
    windlass study rerun DIR CASE            makes the answers of a case again, in DIR/rerun/CASE
    windlass study cases.csv model.cif --out DIR --slurm --partition=long --time=2:00:00
    windlass study cases.csv model.cif --out DIR --parts 20
    windlass study part DIR 7                runs the seventh of these parts, on any machine that sees DIR
    windlass study collect DIR               makes the tables when the parts are over

Exit codes:
  0    all cases are done; with --slurm or --parts: they are submitted or divided
  1    a case has failed, or a file cannot be read or written
  2    wrong use of the command line, or a table that is wrong: no case is run
  130  interrupted; the cases that are done stay done";

/// A study, and how it is run.
#[derive(clap::Args, Debug, Default)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true, disable_help_subcommand = true)]
pub struct StudyArgs {
    /// Something else to do with a study.
    #[command(subcommand)]
    pub command: Option<StudyCommand>,
    /// The cases: a CSV or Parquet file, or a grid of lists in TOML
    #[arg(required = true)]
    pub table: Option<PathBuf>,
    /// The script
    #[arg(required = true)]
    pub model: Option<PathBuf>,
    /// The folder of the study
    #[arg(long, value_name = "DIR", required = true)]
    pub out: Option<PathBuf>,
    /// Cases at a time [default: as many as the machine has cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
    /// Cases whose answers are kept; governing: the failed too, and those with the largest or least of a result or the most severe tension of a segment
    #[arg(long, value_enum, default_value_t = KeepArg::Governing)]
    pub keep: KeepArg,
    /// Seed of the study
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Most cases of a table
    #[arg(long, value_name = "N", default_value_t = MOST_CASES)]
    pub max_cases: usize,
    /// Run failed cases of an earlier start again
    #[arg(long)]
    pub retry_failed: bool,
    /// Half width of the 95 % interval of the most probable maximum over seeds, per cent of it, that ensembles.csv says the number of seeds for
    #[arg(long, value_name = "PERCENT", default_value_t = SCATTER_PERCENT)]
    pub scatter: f64,
    /// Divide the cases into N parts and run none here: windlass study part DIR runs each, collect DIR makes the tables
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub parts: Option<u32>,
    /// Submit the cases as a job array of Slurm; all that follows goes to sbatch, so that this is the last option
    #[arg(long, value_name = "OPTIONS OF SBATCH", num_args = 0.., allow_hyphen_values = true)]
    pub slurm: Option<Vec<String>>,
    /// Minutes that a task of the array is to take [default: 30]
    #[arg(long, value_name = "MINUTES", requires = "slurm", conflicts_with = "parts")]
    pub pack: Option<f64>,
    /// Cases that are run here first, to know their seconds, where none is measured yet [default: 8]
    #[arg(long, value_name = "N", requires = "slurm", value_parser = clap::value_parser!(u16).range(1..))]
    pub sample: Option<u16>,
    /// What runs the cases, where it is not this program.
    #[arg(skip)]
    pub program: Option<CaseProgram>,
}

/// What else is done with a study.
#[derive(clap::Subcommand, Debug)]
pub enum StudyCommand {
    /// Make the answers of one case again
    Rerun {
        /// The folder of the study
        study: PathBuf,
        /// The name of the case
        case: String,
    },
    /// Run a part of a study that --slurm or --parts has divided
    Part {
        /// The folder of the study
        study: PathBuf,
        /// Number of the part, from 1
        number: usize,
        /// The start of the study that the parts are of [default: the newest]
        #[arg(long, value_name = "N")]
        start: Option<u64>,
        /// Cases at a time [default: as many as the machine has cores]
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
        jobs: Option<u16>,
    },
    /// Make the tables of a study whose parts are over, and the answers of its governing cases
    Collect {
        /// The folder of the study
        study: PathBuf,
        /// Cases at a time [default: as many as the machine has cores]
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
        jobs: Option<u16>,
    },
}

/// Which cases keep their answers.
#[derive(ValueEnum, Clone, Copy, Debug, Default)]
pub enum KeepArg {
    /// No case.
    None,
    /// Failed cases.
    Failed,
    /// Failed and governing cases.
    #[default]
    Governing,
    /// All cases.
    All,
}

/// How a study ended.
pub enum StudyExit {
    /// All cases are done.
    Done,
    /// A case has failed, or a file cannot be read or written.
    Failed,
    /// The command line or the table is wrong.
    Usage,
    /// It was interrupted.
    Interrupted,
}

/// Runs a study, or a case of one again; `complain` takes what is wrong, `out` the summary.
pub fn run(args: &StudyArgs, out: &mut impl Write, complain: &dyn Fn(&str)) -> StudyExit {
    let stop = Arc::new(AtomicBool::new(false));
    let stopping = Arc::clone(&stop);
    // without the handler Ctrl-C ends the program; what is written stays whole
    let _ = ctrlc::set_handler(move || stopping.store(true, Ordering::Relaxed));
    let program = args.program.as_ref();
    match &args.command {
        Some(StudyCommand::Rerun { study, case }) => return rerun((study, case), program, out, complain),
        Some(StudyCommand::Part { study, number, start, jobs }) => {
            return parts::run_part((study, *number, *start), jobs_or_cores(*jobs), program, &stop, out, complain);
        }
        Some(StudyCommand::Collect { study, jobs }) => {
            return parts::collect(study, jobs_or_cores(*jobs), program, &stop, out, complain);
        }
        None => {}
    }
    let (Some(table), Some(model), Some(folder)) = (&args.table, &args.model, &args.out) else {
        complain("a study needs a table, a script and --out DIR");
        return StudyExit::Usage;
    };
    let cases = read_table(table, args.seed, args.max_cases);
    let cases = match cases {
        Ok(cases) => cases,
        Err(error) => {
            complain(&error);
            return StudyExit::Usage;
        }
    };
    if !model.is_file() {
        complain(&format!("there is no script {}", model.display()));
        return StudyExit::Usage;
    }
    if let Some(unused) = variables::complaint(&cases, &table.display().to_string(), model) {
        complain(&unused);
        return StudyExit::Usage;
    }
    let slurm = match args.slurm.as_deref().map(SlurmOptions::new).transpose() {
        Ok(slurm) => slurm,
        Err(error) => {
            complain(&format!("--slurm: {error}"));
            return StudyExit::Usage;
        }
    };
    if let Some(pack) = args.pack.filter(|minutes| !(minutes.is_finite() && *minutes > 0.0)) {
        complain(&format!("--pack {pack}: minutes above zero"));
        return StudyExit::Usage;
    }
    if !(args.scatter.is_finite() && args.scatter > 0.0) {
        complain(&format!("--scatter {}: per cent above zero", args.scatter));
        return StudyExit::Usage;
    }
    if let Some(job) = slurm::find_running(folder) {
        complain(&format!("{}: job {job} of Slurm is not over: wait for it, or scancel {job}", folder.display()));
        return StudyExit::Usage;
    }
    let jobs = jobs_or_cores(args.jobs);
    let processes = match Processes::new(model, threads_of_each(jobs), program) {
        Ok(processes) => processes,
        Err(error) => {
            complain(&format!("no process can be started: {error}"));
            return StudyExit::Failed;
        }
    };
    let plan = StudyPlan {
        folder: folder.clone(),
        model: model.display().to_string(),
        begun_in: std::env::current_dir().map(|folder| folder.display().to_string()).unwrap_or_default(),
        table_name: table.display().to_string(),
        table: cases,
        seed: args.seed,
        version: env!("CARGO_PKG_VERSION").to_owned(),
        jobs,
        keep: match args.keep {
            KeepArg::None => Keep::Nothing,
            KeepArg::Failed => Keep::Failed,
            KeepArg::Governing => Keep::Governing,
            KeepArg::All => Keep::Everything,
        },
        retry_failed: args.retry_failed,
        scatter_percent: args.scatter,
    };
    if slurm.is_some() || args.parts.is_some() {
        return parts::distribute(args, &plan, slurm.as_ref(), &processes, &stop, out, complain);
    }
    let ended = match with_bar(&mut |report| run_study(&plan, &SystemFiles, &processes, &stop, report)) {
        Ok(ended) => ended,
        Err(error) => return refused(&error, complain),
    };
    // what parts have run keeps no answers of governing cases before the parts are over
    let has_parts = newest_division(folder).is_ok_and(|start| start.is_some());
    let study = if has_parts && !stop.load(Ordering::Relaxed) {
        parts::finish(folder, plan.keep, jobs, &processes, &stop)
    } else {
        write_tables(folder)
    };
    match study {
        Ok(study) => report_end(&study, &ended, folder, out),
        Err(error) => {
            complain(&error);
            StudyExit::Failed
        }
    }
}

/// A number of things, by their name.
fn counted(number: usize, name: &str) -> String {
    format!("{number} {name}{}", if number == 1 { "" } else { "s" })
}

fn jobs_or_cores(jobs: Option<u16>) -> usize {
    jobs.map_or_else(|| std::thread::available_parallelism().map_or(1, usize::from), usize::from)
}

/// Threads of each of so many cases at a time.
fn threads_of_each(jobs: usize) -> usize {
    (std::thread::available_parallelism().map_or(1, usize::from) / jobs).max(1)
}

/// The exit of an error.
fn refused(error: &StudyError, complain: &dyn Fn(&str)) -> StudyExit {
    complain(&error.to_string());
    if matches!(error, StudyError::Folder { .. }) { StudyExit::Usage } else { StudyExit::Failed }
}

/// What takes how far a study is.
type ReportProgress<'a> = dyn Fn(Progress) + Sync + 'a;

/// Runs something that says how far it is, with a bar at a terminal.
fn with_bar<T>(run: &mut dyn FnMut(&ReportProgress<'_>) -> T) -> T {
    let bar = progress_bar();
    let made = run(&|progress| {
        bar.set_length(progress.total as u64);
        bar.set_position(progress.finished as u64);
        bar.set_message(format!("{} failed", progress.failed));
    });
    bar.finish_and_clear();
    made
}

/// Writes the tables of a study as it stands in its folder.
fn write_tables(folder: &Path) -> Result<Study, String> {
    let study = Study::open(folder).map_err(|e| e.to_string())?;
    tables::write(&study, folder, &SystemFiles).map_err(|e| format!("{}: {e}", folder.display()))?;
    Ok(study)
}

/// Prints what came of a start; the exit.
fn report_end(study: &Study, ended: &StudyEnd, folder: &Path, out: &mut impl Write) -> StudyExit {
    let left = study.info.cases.len().saturating_sub(ended.kept + ended.progress.finished);
    let text = summary(study, (left, ended), folder);
    print(out, &text);
    if left > 0 {
        StudyExit::Interrupted
    } else if study.count(CaseStatus::Failed) > 0 {
        StudyExit::Failed
    } else {
        StudyExit::Done
    }
}

/// Prints lines of text; a reader that has gone wants no more of it.
fn print(out: &mut impl Write, text: &str) {
    let _ = out.write_all(printable(text).replace("\\u{a}", "\n").as_bytes()).and_then(|()| out.flush());
}

/// The tables of a study as it stands in its folder.
///
/// # Errors
/// A folder without a study, and what the system refuses.
pub fn read(folder: &Path) -> Result<StudyTables, StudyError> {
    Study::open(folder).map(|study| StudyTables::new(&study))
}

/// The table of a file: Parquet, TOML or CSV by how its name ends.
fn read_table(table: &Path, seed: u64, most: usize) -> Result<CaseTable, String> {
    if table.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("parquet")) {
        return parquet_table::read(table, seed, most).map_err(|error| error.to_string());
    }
    let name = table.display().to_string();
    let bytes = read_regular(table, LARGEST_TABLE).map_err(|error| format!("{name}: {error}"))?;
    let text = String::from_utf8(bytes).map_err(|_| format!("{name}: it is not UTF-8"))?;
    CaseTable::parse(&name, &text, seed, most).map_err(|error| error.to_string())
}

/// A bar at a terminal, with the rate and the time to go.
fn progress_bar() -> ProgressBar {
    if !stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    let form = "{bar:30} {pos} of {len} cases, {msg}, {per_sec}, {eta} to go";
    if let Ok(style) = ProgressStyle::with_template(form) {
        bar.set_style(style);
    }
    bar
}

/// What came of a start that has left so many cases, in a few lines.
fn summary(study: &Study, (left, ended): (usize, &StudyEnd), folder: &Path) -> String {
    let (total, done) = (study.info.cases.len(), study.count(CaseStatus::Done));
    let (over, failed) = (study.count(CaseStatus::Overloaded), study.count(CaseStatus::Failed));
    let mut text = format!("{total} cases: {done} done, {over} overloaded, {failed} failed");
    if left > 0 {
        text.push_str(&format!(", {left} left: the same command goes on"));
    }
    text.push('\n');
    text.push_str(&earlier_cases(ended));
    let wrong: Vec<_> = study.records.iter().filter(|record| record.status() == CaseStatus::Failed).collect();
    for record in wrong.iter().take(MOST_NAMED) {
        text.push_str(&format!("   {} failed: {}\n", record.case(), record.reason()));
    }
    if wrong.len() > MOST_NAMED {
        text.push_str(&format!("   and {} more failed: the column reason of results.csv\n", wrong.len() - MOST_NAMED));
    }
    text.push_str(&format!("   {}\n", folder.join(tables::RESULTS_CSV).display()));
    text
}

/// What is said of cases of earlier starts.
fn earlier_cases(ended: &StudyEnd) -> String {
    let mut text = String::new();
    if ended.kept > 0 {
        text.push_str(&format!("   {} were done before\n", ended.kept));
    }
    for (case, reason) in ended.again.iter().take(MOST_NAMED) {
        text.push_str(&format!("   {case} was run again: {reason}\n"));
    }
    if ended.again.len() > MOST_NAMED {
        text.push_str(&format!("   and {} more were run again\n", ended.again.len() - MOST_NAMED));
    }
    text
}

/// Makes the answers of a case again.
fn rerun(
    (folder, name): (&Path, &str),
    program: Option<&CaseProgram>,
    out: &mut impl Write,
    complain: &dyn Fn(&str),
) -> StudyExit {
    let study = match Study::open(folder) {
        Ok(study) => study,
        Err(error) => {
            complain(&error.to_string());
            return StudyExit::Usage;
        }
    };
    let Some(record) = study.records.iter().find(|record| record.case().eq_ignore_ascii_case(name)) else {
        let names = study.records.iter().map(|record| record.case());
        let near = windlass_base::diagnostic::did_you_mean(name, names).map(|near| format!("; {near}"));
        complain(&format!("{} has no finished case {name}{}", folder.display(), near.unwrap_or_default()));
        return StudyExit::Usage;
    };
    let record = record.to_record();
    let (case, columns) = match Case::from_record(&record) {
        Ok(made) => made,
        Err(error) => {
            complain(&format!("{name}: {error}"));
            return StudyExit::Failed;
        }
    };
    let intact = case.intact.as_ref().and_then(|intact| study.records.of_case(intact)).map(|view| view.to_record());
    if let Some(intact) = intact.as_ref().filter(|intact| intact.status == CaseStatus::Failed) {
        complain(&format!("{name} follows its intact case {}, which has failed", intact.case));
        return StudyExit::Failed;
    }
    let place = folder.join("rerun").join(&record.case);
    let fresh = SystemFiles.remove_folder(&place).and_then(|()| SystemFiles.make_folder(&place));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let script = study.info.find_script(folder).unwrap_or_else(|| PathBuf::from(&study.info.model));
    let processes = Processes::new(&script, cores, program);
    let (processes, made) = match (fresh, processes) {
        (Ok(()), Ok(processes)) => {
            let made = processes.run(&case, &columns, &place, intact.as_ref());
            (processes, made)
        }
        (Err(error), _) | (_, Err(error)) => {
            complain(&format!("{}: {error}", place.display()));
            return StudyExit::Failed;
        }
    };
    let Some(made) = made else { return StudyExit::Interrupted };
    let changed = record.read.iter().find(|read| !processes.is_unchanged(read));
    let same = made.results == record.results && made.lines == record.lines && made.status == record.status;
    let verdict = match changed {
        _ if same => "the same results, to the last digit".to_owned(),
        Some(read) => format!("other results than before: {} has changed", read.path),
        None => format!("other results than before, made by version {}", record.version),
    };
    let _ = writeln!(out, "{}: {}, {verdict}\n   {}", made.case, made.status.text(), place.display());
    if !made.reason.is_empty() {
        let _ = writeln!(out, "   {}", printable(&made.reason));
    }
    if same && made.status != CaseStatus::Failed { StudyExit::Done } else { StudyExit::Failed }
}
