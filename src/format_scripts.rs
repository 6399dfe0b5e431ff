//! `windlass fmt`: scripts in their layout, each written whole or left as it is.

use crate::commands::{COMMANDS, internal_names};
use crate::session::{read_all, read_text};
use std::io::{Write, stdin};
use std::path::{Path, PathBuf};
use windlass_base::printable::printable;
use windlass_language::flow::specs::CONTROL;
use windlass_language::format::{Commands, Spacing, format};
use windlass_language::select::Owner;
use windlass_language::source::Text;
use windlass_language::spec::{CommandSpec, TextForm};

/// What stands at the end of `windlass fmt --help`.
pub const HELP: &str = "\
Records inside &IF, &LOOP and &MACRO are two blanks further in, lines that continue a record too. Lines of the same form that are aligned by
hand stay aligned; other words have one blank between them. Words, their case, comments and text such as that of &TYPE stay as they are.
Records in menus are not moved in. AQWA decks have fixed columns, and are refused; so are models of OrcaFlex, MoorDyn and MAP++, where blanks have a meaning.

Exit codes:
  0    done
  1    with --check, a script would be changed
  2    wrong use of the command line, or a file that cannot be read, written or formatted";

/// The scripts to format.
#[derive(clap::Args, Debug, Default)]
pub struct FormatArgs {
    /// Scripts (model.cif), or - for standard input, which goes to standard output
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Write nothing: list the scripts that would be changed, and exit with 1 if there are any
    #[arg(long)]
    pub check: bool,
}

/// How formatting ended; the worst of all files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FormatEnd {
    /// All scripts are in their layout.
    Done,
    /// With `--check`, a script is not.
    Differs,
    /// A file could not be read, written or formatted.
    Failed,
}

/// Why a file is not formatted.
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    /// Its columns are fixed.
    #[error("{0} is an AQWA deck; its columns are fixed, and it is left as it is")]
    Deck(String),
    /// Blanks have a meaning in it.
    #[error("{0} is {1}; blanks have a meaning there, and it is left as it is")]
    Model(String, &'static str),
    /// A byte that is no text.
    #[error("{0}: line {1} holds a byte that is no text; the file is left as it is")]
    NotText(String, usize),
    /// It cannot be read.
    #[error(transparent)]
    Unreadable(#[from] crate::session::RecordReadError),
    /// It cannot be written.
    #[error("{name}: {source}")]
    Unwritable {
        /// The file.
        name: String,
        /// Why.
        source: std::io::Error,
    },
}

/// How a record is read, by its first word. What may be a macro, and a word that could be several commands one of which reads text,
/// counts as typed.
fn spacing(word: &str) -> Spacing {
    if word.starts_with(['~', '*', ':', '#']) {
        return Spacing::Words;
    }
    let begins = |spec: &&CommandSpec| spec.name.get(..word.len()).is_some_and(|head| head.eq_ignore_ascii_case(word));
    let mut specs: Vec<&CommandSpec> = COMMANDS.iter().map(|command| command.spec).filter(begins).collect();
    let exact = |spec: &&CommandSpec| spec.name.eq_ignore_ascii_case(word);
    if word.is_empty() || specs.iter().any(exact) {
        specs.retain(exact);
    }
    if specs.iter().any(|spec| spec.name == "&BUILDG") {
        Spacing::RowsAsTyped
    } else if specs.is_empty() || specs.iter().any(|spec| spec.form == TextForm::Text) {
        Spacing::AsTyped
    } else {
        Spacing::Words
    }
}

/// What a file is that INMODEL reads from other programs: a text model of OrcaFlex by its ending or its first line, a file of MoorDyn, MoorPy or MAP++ by
/// the lines of dashes that its sections begin with.
fn model_of_another_program(name: &str, text: &str) -> Option<&'static str> {
    let ending = Path::new(name).extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    let is_yaml = matches!(ending.as_deref(), Some("yml" | "yaml")) || text.starts_with("%YAML");
    if is_yaml {
        return Some("a text model of OrcaFlex");
    }
    let begins_section = |line: &str| line.trim_start().starts_with("---");
    (ending.as_deref() == Some("map") || text.lines().any(begins_section))
        .then_some("a file of MoorDyn, MoorPy or MAP++")
}

/// A script in its layout.
///
/// # Errors
/// A deck, or a text with bytes that are none.
pub fn format_script(name: &str, text: &Text) -> Result<String, FormatError> {
    let script = text.as_str();
    if let Some(at) = script.find('\0') {
        let line = 1 + script.bytes().take(at).filter(|byte| *byte == b'\n').count();
        return Err(FormatError::NotText(name.to_string(), line));
    }
    if windlass_aqwa::is_deck(script) {
        return Err(FormatError::Deck(name.to_string()));
    }
    if let Some(kind) = model_of_another_program(name, script) {
        return Err(FormatError::Model(name.to_string(), kind));
    }
    let internal: Vec<(&'static str, Owner)> =
        CONTROL.iter().map(|spec| (spec.name, spec.owner)).chain(internal_names()).collect();
    Ok(format(script, &Commands { internal: &internal, spacing: &spacing }))
}

/// Formats files, or says which would be changed; `complain` takes what goes wrong, a line each.
pub fn run(args: &FormatArgs, out: &mut dyn Write, complain: &dyn Fn(&str)) -> FormatEnd {
    let mut end = FormatEnd::Done;
    for path in &args.files {
        let done = format_file(path, args.check, out).unwrap_or_else(|error| {
            complain(&error.to_string());
            FormatEnd::Failed
        });
        end = end.max(done);
    }
    end
}

fn format_file(path: &Path, only_check: bool, out: &mut dyn Write) -> Result<FormatEnd, FormatError> {
    let is_stream = path == Path::new("-");
    let name = if is_stream { "standard input".to_string() } else { path.display().to_string() };
    let text = if is_stream { read_all(stdin(), &name)? } else { read_text(path)? };
    let formatted = format_script(&name, &text)?;
    let unwritable = |name: &str| {
        let name = name.to_string();
        |source| FormatError::Unwritable { name, source }
    };
    let differs = formatted != text.as_str();
    let said = if only_check && differs {
        let line = 1 + formatted.split('\n').zip(text.as_str().split('\n')).take_while(|(new, old)| new == old).count();
        format!("{}:{line}: would be changed\n", printable(&name))
    } else if only_check {
        String::new()
    } else if is_stream {
        formatted
    } else if differs {
        replace(path, &formatted).map_err(unwritable(&name))?;
        format!("{}: formatted\n", printable(&name))
    } else {
        String::new()
    };
    out.write_all(said.as_bytes()).and_then(|()| out.flush()).map_err(unwritable("standard output"))?;
    Ok(if only_check && differs { FormatEnd::Differs } else { FormatEnd::Done })
}

/// Puts a text in the place of a file, whole or not at all, with its permissions; a link leads to the file that is replaced.
fn replace(path: &Path, text: &str) -> std::io::Result<()> {
    let path = path.canonicalize()?;
    let metadata = std::fs::metadata(&path)?;
    if metadata.permissions().readonly() {
        return Err(std::io::ErrorKind::PermissionDenied.into());
    }
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut fresh = tempfile::Builder::new().prefix(".windlass-").suffix(".tmp").tempfile_in(folder)?;
    fresh.write_all(text.as_bytes())?;
    fresh.as_file().set_permissions(metadata.permissions())?;
    fresh.as_file().sync_all()?;
    fresh.persist(&path).map_err(|error| error.error)?;
    Ok(())
}
