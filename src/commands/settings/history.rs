//! `&UNDO`, `&HISTORY` and `&SAVE`: the records of a session taken back, listed, and written as a script.

use crate::commands::output::disposition::write_file;
use crate::commands::undo::UndoStates;
use crate::commands::{Call, Command, Effect, Job};
use std::path::Path;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, ValueSpec};

/// &UNDO.
pub static UNDO: Command = Command { spec: &UNDO_SPEC, edits: false, run: undo };
/// &HISTORY.
pub static HISTORY: Command = Command { spec: &HISTORY_SPEC, edits: false, run: history };
/// &SAVE.
pub static SAVE: Command = Command { spec: &SAVE_SPEC, edits: false, run: save };

static UNDO_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    detail: "At the terminal alone. Takes back the last record that changed the model, its environment, units, titles, actions or what &EQUI \
             remembers; a record that inserted a file, called a macro or closed a loop is taken back with all it executed. \
             Records behind it, which changed nothing, go with it. The last 100 are kept, and at most 256 MB. Results (runs, files) stay.",
    ..CommandSpec::new("&UNDO", "takes back the last record that changed the model")
};
static HISTORY_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    detail: "Every record as it was executed: variables and functions replaced, loops, macros and inserted files written out. Records that \
             &UNDO took back are marked.",
    example: "MEDIT\n*P 0 0 0\nEND\n&HISTORY",
    ..CommandSpec::new("&HISTORY", "lists the records of the session")
};
static SAVE_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    data: &[ValueSpec::new("FILE", Kind::File, "file name ending in .cif, which is added when it has no ending")],
    detail: "The records of &HISTORY as a script, without those taken back: run, it makes the same model to the last bit. Files that \
             records name must be where they were. A relative file name is inside the job's folder: &HELP &FILE.",
    example: "MEDIT\n*P 0 0 0\nEND\n&SAVE session.cif",
    ..CommandSpec::new("&SAVE", "writes the records of the session as a script")
};

fn undo(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let span = call.args.span;
    let Some(states) = &job.undo else {
        return Err(Diagnostic::error("&UNDO acts at the terminal alone", span)
            .help("in a script leave the record out; &INSTATE -PREVIOUS takes back what &EQUI moved"));
    };
    let dropped = states.has_dropped();
    match UndoStates::take_back(job) {
        Some(done) => {
            let left = match done.left {
                0 => "nothing more can be taken back".to_string(),
                1 => "1 more can be".to_string(),
                left => format!("{left} more can be"),
            };
            let more = match done.more {
                0 => String::new(),
                1 => " and the record behind it, which changed nothing".to_string(),
                more => format!(" and the {more} records behind it, which changed nothing"),
            };
            job.say(&format!("taken back: {}{more}; {left}", done.record));
            Ok(Effect::Done)
        }
        None if dropped => Err(Diagnostic::error("no earlier record is kept: the model stays as it is", span).help(
            "the last 100 records that changed the model are kept, at most 256 MB, and those of the current process",
        )),
        None => {
            Err(Diagnostic::error("nothing is left to take back: the model is as it was when the terminal began", span)
                .help("&HISTORY lists the records"))
        }
    }
}

fn refuse_overflow(job: &Job, call: &Call) -> Outcome<()> {
    if job.journal.overflows() {
        return Err(Diagnostic::error("the session has more records than are kept (64 MB)", call.args.span));
    }
    Ok(())
}

fn history(job: &mut Job, call: &Call) -> Outcome<Effect> {
    refuse_overflow(job, call)?;
    let lines = job.journal.records().iter().enumerate().map(|(index, record)| {
        let mark = if record.is_undone { "  (taken back)" } else { "" };
        format!("{:>6}  {}{mark}\n", index + 1, record.text)
    });
    let text: String = lines.collect();
    job.say(if text.is_empty() { "no record yet" } else { &text });
    Ok(Effect::Done)
}

fn save(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const FILE: DatumKey<str> = SAVE_SPEC.word("FILE");
    let args = &call.args;
    refuse_overflow(job, call)?;
    let name = args.word(FILE).unwrap_or_default();
    let name = match Path::new(name).extension() {
        None => format!("{name}.cif"),
        Some(ending) if ending.eq_ignore_ascii_case("cif") => name.to_string(),
        Some(_) => return Err(Diagnostic::error(format!("a script ends in .cif, not `{name}`"), args.position(FILE))),
    };
    let head =
        concat!("$ the records of a session of windlass ", env!("CARGO_PKG_VERSION"), ", as they were executed\n");
    let text = format!("{head}{}", job.journal.script(false));
    write_file(job, &name, text.as_bytes(), args.position(FILE))?;
    Ok(Effect::Done)
}
