//! `&DEVICE`: how the program behaves.

use crate::commands::{Call, Command, Effect, Job};
use crate::report::files::{is_within, open_regular, read_regular};
use std::path::{Path, PathBuf};
use windlass_base::choice::YesNo;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};

/// &DEVICE.
pub static DEVICE: Command = Command { spec: &SPEC, edits: false, run };

/// Names of a folder among which one that was meant is looked for.
const MOST_NEAR: usize = 1000;
const YES_NO: ValueSpec = ValueSpec::choice::<YesNo>("YES/NO", "on or off").or("YES");
const FILE: ValueSpec = ValueSpec::new("FILE", Kind::File, "file name");
const ANY: ValueSpec = ValueSpec::new("VALUE", Kind::Text, "as MOSES takes it").or("none");

/// An option of MOSES that has no meaning here: it is read, kept out of the way and said.
const fn ignored_option(name: &'static str) -> OptionSpec {
    OptionSpec::new(name, &[ANY], "a setting of devices that windlass does not have").without_effect()
}

const BATCH: OptionSpec = OptionSpec::new("-BATCH", &[YES_NO], "stops at the first error").default("NO");
const LIMERROR: OptionSpec = OptionSpec::new(
    "-LIMERROR",
    &[ValueSpec::new("N", Kind::Integer, "errors").in_range(1.0, 1e9)],
    "errors after which a script ends",
)
.default("10");
const SET_DATE: OptionSpec =
    OptionSpec::new("-SET_DATE", &[ValueSpec::new("DATE", Kind::Text, "date as printed")], "date of reports")
        .default("today");
const OECHO: OptionSpec = OptionSpec::new("-OECHO", &[YES_NO], "shows the records as they are executed").default("NO");
const MECHO: OptionSpec =
    OptionSpec::new("-MECHO", &[YES_NO], "the same: shows the records as they are executed").default("NO");
const SILENT: OptionSpec =
    OptionSpec::new("-SILENT", &[YES_NO], "prints nothing on the screen but messages").default("NO");
const NAME_FIGURE: OptionSpec =
    OptionSpec::new("-NAME_FIGURE", &[ValueSpec::new("NAME", Kind::Text, "prefix")], "prefix of the names of figures")
        .default("FIGURE");
const FIG_NUM: OptionSpec = OptionSpec::new(
    "-FIG_NUM",
    &[ValueSpec::new("N", Kind::Integer, "number").in_range(1.0, 1e6)],
    "number of the next figure",
)
.default("1");
const AUXIN: OptionSpec = OptionSpec::new("-AUXIN", &[FILE], "file INMODEL reads instead of ROOT.DAT");
const IAUXIN: OptionSpec = OptionSpec::new("-IAUXIN", &[FILE], "the same as -AUXIN");
const COMIN: OptionSpec = OptionSpec::new("-COMIN", &[FILE], "reads commands from a file next");
const ICOMIN: OptionSpec = OptionSpec::new("-ICOMIN", &[FILE], "the same as -COMIN");
const RECORDS: OptionSpec = OptionSpec::new(
    "-RECORDS",
    &[ValueSpec::new("N", Kind::Integer, "records").in_range(1.0, 1e15)],
    "records a run may execute",
)
.default("2000000")
.owner(Owner::Ours);
const PLOT_SIZE: OptionSpec = OptionSpec::new(
    "-PLOT_SIZE",
    &[
        ValueSpec::new("COLUMNS", Kind::Integer, "columns").in_range(40.0, 200.0),
        ValueSpec::new("LINES", Kind::Integer, "lines").in_range(10.0, 100.0),
    ],
    "size of plots in the terminal",
)
.default("the terminal's width, else 90; 26")
.owner(Owner::Ours);
const WIDE: OptionSpec = OptionSpec::new(
    "-WIDE",
    &[YES_NO],
    "reports are as wide as their columns; NO: at a terminal columns that do not fit go on below, behind the row heads",
)
.default("NO")
.owner(Owner::Ours);
const PAGES: OptionSpec = OptionSpec::new(
    "-PAGES",
    &[YES_NO],
    "what is longer than the terminal is shown by the pager of PAGER, else less; never where output is no terminal",
)
.default("YES")
.owner(Owner::Ours);
const US_DATE: OptionSpec = ignored_option("-US_DATE");
const CONT_ENTRY: OptionSpec = ignored_option("-CONT_ENTRY");
const G_DEFAULT: OptionSpec = ignored_option("-G_DEFAULT");
const IDISPLAY: OptionSpec = ignored_option("-IDISPLAY");
const CLIENT: OptionSpec = ignored_option("-CLIENT");
const FN_LOWER: OptionSpec = ignored_option("-FN_LOWER");
const LICENSE: OptionSpec = ignored_option("-LICENSE");
const PROJ_ID: OptionSpec = ignored_option("-PROJ_ID");
const PRIMARY: OptionSpec = ignored_option("-PRIMARY");

static SPEC: CommandSpec = CommandSpec {
    options: &[
        BATCH,
        LIMERROR,
        SET_DATE,
        OECHO,
        MECHO,
        SILENT,
        NAME_FIGURE,
        FIG_NUM,
        AUXIN,
        IAUXIN,
        COMIN,
        ICOMIN,
        RECORDS,
        PLOT_SIZE,
        WIDE,
        PAGES,
        US_DATE,
        CONT_ENTRY,
        G_DEFAULT,
        IDISPLAY,
        CLIENT,
        FN_LOWER,
        LICENSE,
        PROJ_ID,
        PRIMARY,
    ],
    detail: "File names keep their case; quotes take blanks. -SET_DATE takes its date in quotes when it holds blanks.",
    example: "&DEVICE -LIMERROR 5 -SET_DATE 2026-11-21",
    ..CommandSpec::new("&DEVICE", "sets how the program behaves")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let mut settings = job.settings.clone();
    let mut effect = Effect::Done;
    let mut remarks = Vec::new();
    for given in &call.args.options {
        let whole = given.first_integer().unwrap_or(0);
        let word = || given.first_word().unwrap_or_default();
        match given {
            _ if given.is(&BATCH) => settings.batch = given.is_on(),
            _ if given.is(&LIMERROR) => settings.error_limit = whole,
            _ if given.is(&SET_DATE) => settings.date = Some(word().to_string()),
            _ if given.is(&OECHO) || given.is(&MECHO) => settings.echo = given.is_on(),
            _ if given.is(&SILENT) => settings.silent = given.is_on(),
            _ if given.is(&NAME_FIGURE) => settings.figure_name = word().to_string(),
            _ if given.is(&FIG_NUM) => settings.figure_number = whole,
            _ if given.is(&AUXIN) || given.is(&IAUXIN) => settings.auxiliary = Some(beside_root(job, word())),
            _ if given.is(&COMIN) || given.is(&ICOMIN) => {
                let path = existing(job, word(), given.first_place())?;
                effect = Effect::Insert { name: word().to_string(), path, tag: crate::commands::PLAIN };
            }
            _ if given.is(&RECORDS) => effect = Effect::Budget(u64::try_from(whole).unwrap_or(u64::MAX)),
            _ if given.is(&PLOT_SIZE) => {
                let size = |key| given.integer(key).and_then(|n| usize::try_from(n).ok());
                let [columns, lines] = const { [PLOT_SIZE.integer("COLUMNS"), PLOT_SIZE.integer("LINES")] };
                settings.plot_size = size(columns).zip(size(lines));
            }
            _ if given.is(&WIDE) => settings.wide = given.is_on(),
            _ if given.is(&PAGES) => settings.pages = given.is_on(),
            _ => remarks.push((format!("{} has no effect in windlass", given.name()), given.span)),
        }
    }
    job.settings = settings;
    for (text, span) in remarks {
        job.remark(text, span);
    }
    Ok(effect)
}

/// A file name as the user means it: beside the job's root when it has no folder of its own, else as written. Of a script in a folder of
/// answers, as &SAVE writes them, also beside that folder, where the files of the job that answered are.
pub fn beside_root(job: &Job, name: &str) -> PathBuf {
    let path = Path::new(name);
    let folder = job.output.folder.root.parent().unwrap_or(Path::new(""));
    if path.is_absolute() || path.exists() {
        return path.to_path_buf();
    }
    let beside = folder.join(path);
    let answers = folder.extension().is_some_and(|ending| ending == "ans") && !beside.exists();
    let outside = folder.parent().filter(|_| answers).map(|outer| outer.join(path)).filter(|outer| outer.exists());
    outside.unwrap_or(beside)
}

/// A file that a script may have written: in the job's folder when it is there, else as [`beside_root`].
pub fn find_file(job: &Job, name: &str) -> PathBuf {
    let own = job.output.folder.resolve(name).ok().filter(|path| path.exists());
    own.unwrap_or_else(|| beside_root(job, name))
}

/// A file to be read that a script may have written, as [`find_file`].
///
/// # Errors
/// A file that is not there.
pub fn readable(job: &Job, name: &str, span: Span) -> Outcome<PathBuf> {
    let path = find_file(job, name);
    if path.is_file() { within_check(job, path, span) } else { existing(job, name, span) }
}

/// A file that is to be read, which a check of a script takes from the script's folder alone.
///
/// # Errors
/// A file outside of it.
pub fn within_check(job: &Job, path: PathBuf, span: Span) -> Outcome<PathBuf> {
    let folder = job.output.folder.root.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if job.checking.is_none() || is_within(&path, folder) {
        return Ok(path);
    }
    Err(Diagnostic::error(
        format!("{} is outside of the script's folder: a check does not read it", path.display()),
        span,
    ))
}

/// Opens a file that is input: a regular one; what is outside of the script's folder comes into the log.
///
/// # Errors
/// As [`open_regular`].
pub fn open_input(job: &Job, path: &Path) -> std::io::Result<std::fs::File> {
    job.output.folder.note_reading(path);
    open_regular(path)
}

/// The bytes of a file that is input, as [`open_input`], and of at most so many bytes.
///
/// # Errors
/// As [`read_regular`].
pub fn read_input(job: &Job, path: &Path, largest: u64) -> std::io::Result<Vec<u8>> {
    job.output.folder.note_reading(path);
    read_regular(path, largest)
}

/// A file to be read: beside the job's root, or as written.
///
/// # Errors
/// A file that is not there.
pub fn existing(job: &Job, name: &str, span: Span) -> Outcome<PathBuf> {
    let path = beside_root(job, name);
    if path.is_file() {
        return within_check(job, path, span);
    }
    // a check does not tell what there is elsewhere
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let nearest = folder.ancestors().find(|folder| folder.exists()).unwrap_or(Path::new("."));
    if within_check(job, nearest.to_path_buf(), span).is_err() {
        return within_check(job, path, span);
    }
    if path.exists() {
        let sort = if path.is_dir() { "a folder" } else { "not a regular file" };
        return Err(Diagnostic::error(format!("{} is {sort}", path.display()), span));
    }
    // as the name is written, with its folders
    let written = |entry: std::fs::DirEntry| Path::new(name).with_file_name(entry.file_name()).display().to_string();
    let near: Vec<String> = std::fs::read_dir(folder)
        .map(|entries| entries.flatten().take(MOST_NEAR).map(written).collect())
        .unwrap_or_default();
    let mut error = Diagnostic::error(format!("there is no file {}", path.display()), span);
    error.help.extend(windlass_base::diagnostic::did_you_mean(name, near.iter().map(String::as_str)));
    Err(error)
}
