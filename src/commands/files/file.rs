//! `&INSERT`, `USE_MAC` and `&FILE`.

use crate::commands::job::UserFile;
use crate::commands::settings::device::{existing, read_input, readable};
use crate::commands::{Call, Command, Effect, Job, PLAIN, absent};
use crate::report::files::{FileError, FilePlace, NameOperand, is_within};
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_language::record::Word;
use windlass_language::select::choose_word;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, TextForm, ValueSpec};

/// &INSERT.
pub static INSERT: Command = Command { spec: &INSERT_SPEC, edits: false, run: insert };
/// USE_MAC.
pub static USE_MAC: Command = Command { spec: &USE_MAC_SPEC, edits: false, run: use_mac };
/// &FILE.
pub static FILE: Command = Command { spec: &FILE_SPEC, edits: false, run: file };

static INSERT_SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new("FILE", Kind::File, "file name")],
    detail: "The file is looked for where it says, then beside the script. &EOFILE in it returns.",
    example: "",
    ..CommandSpec::new("&INSERT", "reads the records of a file here")
};
static USE_MAC_SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new("NAME", Kind::Text, "macro library")],
    detail: "Reads NAME, NAME.mac or NAME.cif beside the script; where there is none of them, a library that ships with windlass. V_MODEL defines \
             W_BOX NAME X Y Z LENGTH WIDTH HEIGHT -SHAPE CS -NO_TBOT -WEIGHT WT *N1 ..: a box in the wind with the middle of its bottom at X Y Z, \
             CS the shape coefficient of its faces, without wind on bottom and top by -NO_TBOT, and WT a weight at its middle. \
             TKR_MODEL and JGEN_INIT of V_MODEL are not in windlass, as the hulls they make are not public.",
    example: "MEDIT\nUSE_MAC V_MODEL\n&DESCRIBE BODY RIG\nW_BOX HOUSE 10 0 20 30 40 15 -SHAPE 1.1 -WEIGHT 250\nEND\n&STATUS PIECES",
    ..CommandSpec::new("USE_MAC", "loads a macro library")
};
static FILE_SPEC: CommandSpec = CommandSpec {
    form: TextForm::Text,
    data: &[ValueSpec::choice::<FileAction>("ACTION", "what to do")],
    detail: "MKDIR A; RM A; MV A B; CP A B; ANS_DIRECTORY A (a folder where answers go from now on, made if it is not there); OPEN TYPE FILE, WRITE TYPE text, \
             CLOSE TYPE (writes the file, whole; a file still open when the job ends is written then); USE TYPE FILE (for \
             &F_READ). Names that are written to, here and in STORE, PLOT and LINES: a relative name, with folders or without, is \
             inside the job's own folder (ROOT.ans or --out DIR) and must stay inside it; a name that begins with ./ or \
             ../ and an absolute name mean what they mean to the shell. In the job's folder an earlier file is kept as \
             name.1. Outside of it, and where a link leads out of it, writing needs --allow-files; a record typed at the terminal, not in \
             a loop or macro, may create a file or folder there after a question. No file outside is overwritten. The job's log and report and the files that are \
             open are neither removed nor moved. A relative name that USE reads is looked for in the job's folder first, \
             where a script's own files are, then beside the script and in the current directory; &INFO(FILE_EXISTS \
             name) looks in the same places.",
    example: "&FILE OPEN NOTE note.txt\n&FILE WRITE NOTE one line\n&FILE CLOSE NOTE\n&FILE RM note.txt",
    ..CommandSpec::new("&FILE", "works on files")
};

choices! {
    /// What `&FILE` does.
    enum FileAction {
        MakeFolder = "MKDIR",
        Remove = "RM",
        Move = "MV",
        Copy = "CP",
        Use = "USE",
        AnswerFolder = "ANS_DIRECTORY",
        Open = "OPEN",
        Write = "WRITE",
        Close = "CLOSE",
    }
}

fn insert(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const FILE: DatumKey<str> = INSERT_SPEC.word("FILE");
    let name = call.args.word(FILE).unwrap_or_default();
    let path = existing(job, name, call.args.position(FILE))?;
    Ok(Effect::Insert { name: name.to_string(), path, tag: PLAIN })
}

/// A library of macros that ships with the program.
pub struct ShippedLibrary {
    /// Its name.
    pub name: &'static str,
    /// The forms of its macros.
    pub macros: &'static str,
    text: &'static str,
}

/// Those libraries.
pub static LIBRARIES: &[ShippedLibrary] = &[ShippedLibrary {
    name: "V_MODEL",
    macros: "W_BOX NAME X Y Z LENGTH WIDTH HEIGHT -SHAPE CS -NO_TBOT -WEIGHT WT *N1 ..",
    text: include_str!("../../../share/macros/v_model.mac"),
}];

fn use_mac(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = USE_MAC_SPEC.word("NAME");
    let name = call.args.word(NAME).unwrap_or_default();
    let lower = name.to_ascii_lowercase();
    let candidates = [
        name.to_string(),
        format!("{name}.mac"),
        format!("{name}.cif"),
        format!("{lower}.mac"),
        format!("{lower}.cif"),
    ];
    for candidate in candidates {
        if let Ok(path) = existing(job, &candidate, call.args.position(NAME)) {
            return Ok(Effect::Insert { name: candidate, path, tag: PLAIN });
        }
    }
    if let Some(library) = LIBRARIES.iter().find(|library| library.name.eq_ignore_ascii_case(name)) {
        return Ok(Effect::Library { name: library.name, text: library.text });
    }
    let position = call.args.position(NAME);
    if let Some((library, macros)) = absent::LIBRARIES.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)) {
        // each of its macros says what is lost where it is called
        let text = format!("library {library} of MOSES is not in windlass; scripts call {macros} of it");
        job.remark(text, position);
        return Ok(Effect::Done);
    }
    let key = name.to_ascii_uppercase();
    if !job.missing_libraries.contains(&key) {
        job.missing_libraries.push(key);
    }
    let ours: Vec<&str> = LIBRARIES.iter().map(|library| library.name).collect();
    Err(Diagnostic::error(format!("there is no macro library {name}"), position)
        .label("looked for NAME, NAME.mac and NAME.cif beside the script")
        .help(format!("windlass ships with {}", ours.join(" ")))
        .help("an unknown record behind this is taken for a macro of it: solves will stop"))
}

fn file(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let usage = || {
        Diagnostic::error("&FILE lacks a word", call.record.whole())
            .help("form: &FILE MKDIR A | RM A | MV A B | CP A B | ANS_DIRECTORY A | OPEN TYPE FILE | WRITE TYPE text | CLOSE TYPE | USE TYPE FILE")
    };
    let action = call.words.get(1).ok_or_else(usage)?;
    let action = choose_word(&action.text, action.span, "action of &FILE")?;
    let first = call.words.get(2).ok_or_else(usage)?;
    let second = || call.words.get(3).ok_or_else(usage);
    let most = match action {
        FileAction::Move | FileAction::Copy | FileAction::Open | FileAction::Use => 4,
        FileAction::Write => usize::MAX,
        FileAction::MakeFolder | FileAction::Remove | FileAction::AnswerFolder | FileAction::Close => 3,
    };
    if let Some(word) = call.words.get(most) {
        return Err(Diagnostic::error(format!("&FILE {} takes no further word", action.word()), word.span));
    }
    let at = |error| to_diagnostic(&error, first.span);
    match action {
        FileAction::MakeFolder => job.output.folder.make_folder(&first.text).map_err(at).map(|_| ())?,
        FileAction::Remove => {
            not_open(job, first)?;
            job.output.folder.remove(&first.text).map_err(at).map(|_| ())?;
        }
        FileAction::Move | FileAction::Copy => {
            let (to, keep) = (second()?, action == FileAction::Copy);
            if !keep {
                not_open(job, first)?;
            }
            job.output.folder.transfer(&first.text, &to.text, keep).map_err(|(side, error)| match side {
                NameOperand::From => at(error),
                NameOperand::To => to_diagnostic(&error, to.span),
            })?;
        }
        FileAction::AnswerFolder => {
            job.output.folder.move_to(&first.text).map_err(at)?;
        }
        FileAction::Open => {
            let name = second()?;
            open(job, first, name)?;
        }
        FileAction::Write => write(job, call, first)?,
        FileAction::Close => close(job, first)?,
        FileAction::Use => {
            let name = second()?;
            let path = readable(job, &name.text, name.span)?;
            let bytes = read_input(job, &path, MAX_FILE_BYTES as u64)
                .map_err(|e| Diagnostic::error(format!("{}: {e}", path.display()), name.span))?;
            let text = String::from_utf8(bytes)
                .map_err(|e| Diagnostic::error(format!("{}: it is no text: {e}", path.display()), name.span))?;
            let lines = text.lines().rev().map(str::to_string).collect();
            write_unclosed(job, first)?;
            job.user_files.insert(first.text.to_ascii_uppercase(), UserFile::Reading { path, lines });
        }
    }
    Ok(Effect::Done)
}

/// Sees that a type of `&FILE` has neither a file nor one in this folder open.
fn not_open(job: &Job, name: &Word) -> Outcome<()> {
    let Ok(path) = job.output.folder.resolve(&name.text) else { return Ok(()) };
    let of = |file: &UserFile| match file {
        UserFile::Writing { position, .. } => is_within(position.path(), &path),
        UserFile::Reading { path: read, .. } => is_within(read, &path),
    };
    match job.user_files.iter().find(|(_, file)| of(file)) {
        Some((kind, _)) => {
            Err(to_diagnostic(&FileError::InUse(path), name.span).help(format!("&FILE CLOSE {kind} closes it")))
        }
        None => Ok(()),
    }
}

/// The name of a CSV file: .csv is added when it has no ending.
pub fn with_csv_ending(name: &str) -> String {
    if std::path::Path::new(name).extension().is_some() { name.to_string() } else { format!("{name}.csv") }
}

/// A file that could not be written or touched, at the word that names it.
pub fn to_diagnostic(error: &FileError, span: Span) -> Box<Diagnostic> {
    let mut made = Diagnostic::error(error.to_string(), span);
    made.help.extend(error.help().map(str::to_string));
    made
}

fn open(job: &mut Job, kind: &Word, name: &Word) -> Outcome<()> {
    write_unclosed(job, kind)?;
    let position = job.output.folder.position(&name.text).map_err(|e| to_diagnostic(&e, name.span))?;
    if let Some(other) = job.user_files.writing_at(position.path()) {
        let text = format!("{} is open already, as type {other}", position.path().display());
        return Err(Diagnostic::error(text, name.span));
    }
    let file = UserFile::Writing { position, text: String::new(), opened: name.span };
    job.user_files.insert(kind.text.to_ascii_uppercase(), file);
    Ok(())
}

/// Writes the file that this type still names, because the type gets another.
fn write_unclosed(job: &mut Job, kind: &Word) -> Outcome<()> {
    let key = kind.text.to_ascii_uppercase();
    if let Some(UserFile::Writing { position, text, opened }) = job.user_files.get(&key) {
        let note = written_unclosed(&key, position, text, *opened)?;
        job.notices.push(*note);
        job.user_files.remove(&key);
    }
    Ok(())
}

/// Writes a file that was not closed; the note that says so.
fn written_unclosed(kind: &str, position: &FilePlace, text: &str, opened: Span) -> Outcome<Box<Diagnostic>> {
    position.write(text.as_bytes()).map_err(|e| to_diagnostic(&e, opened))?;
    let note = format!("{} was not closed and is written as it stands", position.path().display());
    Ok(Diagnostic::remark(note, opened).help(format!("&FILE CLOSE {kind} closes it")))
}

/// At the end of the job: writes the files that were opened and never closed. Returns what is to be said of each.
pub fn write_open_files(job: &mut Job) -> Vec<Box<Diagnostic>> {
    let files = job.user_files.take();
    files
        .iter()
        .filter_map(|(kind, file)| match file {
            UserFile::Writing { position, text, opened } => {
                Some(written_unclosed(kind, position, text, *opened).unwrap_or_else(|error| error))
            }
            UserFile::Reading { .. } => None,
        })
        .collect()
}

/// Largest text a user's file may grow to (bytes).
const MAX_FILE_BYTES: usize = 256 << 20;

fn write(job: &mut Job, call: &Call, name: &Word) -> Outcome<()> {
    let words = windlass_language::token::words(call.record.text());
    let text = words.get(3).and_then(|t| call.record.text().get(t.range.start..)).unwrap_or_default().trim_end();
    match job.user_files.get_mut(&name.text.to_ascii_uppercase()) {
        Some(UserFile::Writing { text: lines, .. }) if lines.len() + text.len() < MAX_FILE_BYTES => {
            lines.push_str(text);
            lines.push('\n');
            Ok(())
        }
        Some(UserFile::Writing { .. }) => Err(Diagnostic::error("the file grows too large", name.span)),
        _ => Err(Diagnostic::error(format!("no file of type {} is open for writing", name.text), name.span)
            .help("&FILE OPEN TYPE FILE opens one")),
    }
}

fn close(job: &mut Job, name: &Word) -> Outcome<()> {
    let key = name.text.to_ascii_uppercase();
    match job.user_files.get(&key) {
        // a file that cannot be written now stays open, and is tried again at the end of the job
        Some(UserFile::Writing { position, text, .. }) => {
            position.write(text.as_bytes()).map_err(|e| to_diagnostic(&e, name.span))?;
        }
        Some(UserFile::Reading { .. }) => {}
        None => return Err(Diagnostic::error(format!("no file of type {} is open", name.text), name.span)),
    }
    job.user_files.remove(&key);
    Ok(())
}
