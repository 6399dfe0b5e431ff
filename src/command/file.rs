//! `&INSERT`, `USE_MAC` and `&FILE`.

use super::device::existing;
use super::job::UserFile;
use super::{Call, Command, Effect, Job, PLAIN};
use crate::language::diagnostic::{Diagnostic, Outcome};
use crate::language::record::Word;
use crate::language::select::{Owner, choose};
use crate::language::spec::{CommandSpec, Form, Kind, ValueSpec};
use crate::report::files::FileError;

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
    detail: "Reads NAME, NAME.mac or NAME.cif beside the script.",
    example: "",
    ..CommandSpec::new("USE_MAC", "loads a macro library")
};
static FILE_SPEC: CommandSpec = CommandSpec {
    form: Form::Text,
    data: &[ValueSpec::new("ACTION", Kind::Choice(ACTIONS), "what to do")],
    detail: "MKDIR A; RM A; MV A B; CP A B; ANS_DIRECTORY A (where answers go from now on); OPEN TYPE FILE, WRITE TYPE text, \
             CLOSE TYPE (writes the file, whole); USE TYPE FILE (for &F_READ). RM, MV, CP and MKDIR act below the job's own \
             folder only, unless the program was started with --allow-files.",
    example: "&FILE OPEN NOTE note.txt\n&FILE WRITE NOTE one line\n&FILE CLOSE NOTE\n&FILE RM note.txt",
    ..CommandSpec::new("&FILE", "works on files")
};

const ACTIONS: &[&str] = &["MKDIR", "RM", "MV", "CP", "USE", "ANS_DIRECTORY", "OPEN", "WRITE", "CLOSE"];

fn insert(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let name = call.args.word(0).unwrap_or_default();
    let path = existing(job, name, call.args.place(0))?;
    Ok(Effect::Insert { name: name.to_string(), path, tag: PLAIN })
}

fn use_mac(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let name = call.args.word(0).unwrap_or_default();
    let lower = name.to_ascii_lowercase();
    let candidates = [
        name.to_string(),
        format!("{name}.mac"),
        format!("{name}.cif"),
        format!("{lower}.mac"),
        format!("{lower}.cif"),
    ];
    for candidate in candidates {
        if let Ok(path) = existing(job, &candidate, call.args.place(0)) {
            return Ok(Effect::Insert { name: candidate, path, tag: PLAIN });
        }
    }
    Err(Diagnostic::error(format!("there is no macro library {name}"), call.args.place(0))
        .label("looked for NAME, NAME.mac and NAME.cif beside the script"))
}

fn file(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let usage = || {
        Diagnostic::error("&FILE lacks a word", call.record.whole())
            .help("form: &FILE MKDIR A | RM A | MV A B | CP A B | ANS_DIRECTORY A | OPEN TYPE FILE | WRITE TYPE text | CLOSE TYPE | USE TYPE FILE")
    };
    let action = call.words.get(1).ok_or_else(usage)?;
    let names = ACTIONS.iter().map(|a| (*a, Owner::Moses, *a));
    let action = choose(&action.text, action.span, "action of &FILE", names)?;
    let first = call.words.get(2).ok_or_else(usage)?;
    let second = || call.words.get(3).ok_or_else(usage);
    let most = match action {
        "MV" | "CP" | "OPEN" | "USE" => 4,
        "WRITE" => usize::MAX,
        _ => 3,
    };
    if let Some(word) = call.words.get(most) {
        return Err(Diagnostic::error(format!("&FILE {action} takes no further word"), word.span));
    }
    let at = |error: FileError| {
        let mut made = Diagnostic::error(error.to_string(), first.span);
        if matches!(error, FileError::NotOwn { .. }) {
            made.help.push("a script may only touch what is its own; --allow-files lifts this".into());
        }
        made
    };
    match action {
        "MKDIR" => job.output.folder.make_folder(&first.text).map_err(at).map(|_| ())?,
        "RM" => job.output.folder.remove(&first.text).map_err(at).map(|_| ())?,
        "MV" | "CP" => {
            let to = second()?;
            job.output.folder.transfer(&first.text, &to.text, action == "CP").map_err(at)?;
        }
        "ANS_DIRECTORY" => {
            let path = job.output.folder.own(&first.text).map_err(at)?;
            job.output.folder.folder = path;
        }
        "OPEN" => {
            let path = second()?.text.to_string().into();
            job.user_files.insert(first.text.to_ascii_uppercase(), UserFile::Writing(path, String::new()));
        }
        "WRITE" => write(job, call, first)?,
        "CLOSE" => close(job, first)?,
        _ => {
            let name = second()?;
            let path = existing(job, &name.text, name.span)?;
            let text = std::fs::read_to_string(&path)
                .map_err(|e| Diagnostic::error(format!("{}: {e}", path.display()), name.span))?;
            let lines = text.lines().rev().map(str::to_string).collect();
            job.user_files.insert(first.text.to_ascii_uppercase(), UserFile::Reading(lines));
        }
    }
    Ok(Effect::Done)
}

/// Largest text a user's file may grow to (bytes).
const LARGEST: usize = 256 << 20;

fn write(job: &mut Job, call: &Call, name: &Word) -> Outcome<()> {
    let words = crate::language::token::words(call.record.text());
    let text = words.get(3).and_then(|t| call.record.text().get(t.range.start..)).unwrap_or_default().trim_end();
    match job.user_files.get_mut(&name.text.to_ascii_uppercase()) {
        Some(UserFile::Writing(_, lines)) if lines.len() + text.len() < LARGEST => {
            lines.push_str(text);
            lines.push('\n');
            Ok(())
        }
        Some(UserFile::Writing(..)) => Err(Diagnostic::error("the file grows too large", name.span)),
        _ => Err(Diagnostic::error(format!("no file of type {} is open for writing", name.text), name.span)
            .help("&FILE OPEN TYPE FILE opens one")),
    }
}

fn close(job: &mut Job, name: &Word) -> Outcome<()> {
    match job.user_files.shift_remove(&name.text.to_ascii_uppercase()) {
        Some(UserFile::Writing(path, text)) => job
            .output
            .folder
            .write(&path.to_string_lossy(), text.as_bytes())
            .map(|_| ())
            .map_err(|e| Diagnostic::error(e.to_string(), name.span)),
        Some(UserFile::Reading(_)) => Ok(()),
        None => Err(Diagnostic::error(format!("no file of type {} is open", name.text), name.span)),
    }
}
