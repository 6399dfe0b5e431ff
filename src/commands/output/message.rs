//! Titles, messages, the clock, and the end of the job.

use crate::commands::{Call, Command, Effect, Job};
use crate::report::page::centre;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_language::select::choose_word;
use windlass_language::spec::{CommandSpec, TextForm, ValueSpec};

/// Width in which `&CTYPE` centres.
const CENTRING_WIDTH: usize = 80;

const fn text(name: &'static str, help: &'static str, example: &'static str) -> CommandSpec {
    CommandSpec { form: TextForm::Text, example, ..CommandSpec::new(name, help) }
}

/// &TITLE.
pub static TITLE: Command = Command { spec: &TITLE_SPEC, edits: false, run: title };
/// &SUBTITLE.
pub static SUBTITLE: Command = Command { spec: &SUBTITLE_SPEC, edits: false, run: subtitle };
/// &TYPE.
pub static TYPE: Command = Command { spec: &TYPE_SPEC, edits: false, run: say };
/// &S_BACK.
pub static S_BACK: Command = Command { spec: &S_BACK_SPEC, edits: false, run: send_back };
/// &CTYPE.
pub static CTYPE: Command = Command { spec: &CTYPE_SPEC, edits: false, run: say_centred };
/// &CUTYPE.
pub static CUTYPE: Command = Command { spec: &CUTYPE_SPEC, edits: false, run: say_underlined };
/// &ERROR.
pub static ERROR: Command = Command { spec: &ERROR_SPEC, edits: false, run: error };
/// &DCPTIME.
pub static DCPTIME: Command = Command { spec: &DCPTIME_SPEC, edits: false, run: dcptime };
/// &FINISH.
pub static FINISH: Command = Command { spec: &FINISH_SPEC, edits: false, run: finish };

static TITLE_SPEC: CommandSpec = text("&TITLE", "the title of every report", "&TITLE Mooring of the barge");
static SUBTITLE_SPEC: CommandSpec = text("&SUBTITLE", "the subtitle of every report", "&SUBTITLE intact");
static TYPE_SPEC: CommandSpec = text("&TYPE", "prints text", "&TYPE Hello");
static S_BACK_SPEC: CommandSpec = CommandSpec {
    form: TextForm::Text,
    detail: "Printed also where &DEVICE -SILENT YES keeps the rest off the screen: for programs that read windlass through a pipe.",
    example: "&DEVICE -SILENT YES\n&TYPE not seen\n&S_BACK seen",
    ..CommandSpec::new("&S_BACK", "prints text, also when silent")
};
static CTYPE_SPEC: CommandSpec = text("&CTYPE", "prints text, centred", "&CTYPE Hello");
static CUTYPE_SPEC: CommandSpec = text("&CUTYPE", "prints text, centred and underlined", "&CUTYPE Hello");
static ERROR_SPEC: CommandSpec = CommandSpec {
    form: TextForm::Text,
    data: &[ValueSpec::choice::<MessageClass>("CLASS", "how serious")],
    detail: "FATAL ends the job.",
    example: "&ERROR WARNING the depth is a guess",
    ..CommandSpec::new("&ERROR", "raises a message")
};
static DCPTIME_SPEC: CommandSpec = text("&DCPTIME", "prints the time since the last call", "&DCPTIME after the table");
static FINISH_SPEC: CommandSpec = CommandSpec { example: "&FINISH", ..CommandSpec::new("&FINISH", "ends the job") };

choices! {
    /// How serious a message of a script is.
    enum MessageClass {
        Warning = "WARNING",
        Error = "ERROR",
        Fatal = "FATAL",
    }
}

fn title(job: &mut Job, call: &Call) -> Outcome<Effect> {
    job.titles[0] = call.record.rest().0.to_string();
    Ok(Effect::Done)
}

fn subtitle(job: &mut Job, call: &Call) -> Outcome<Effect> {
    job.titles[1] = call.record.rest().0.to_string();
    Ok(Effect::Done)
}

fn say(job: &mut Job, call: &Call) -> Outcome<Effect> {
    job.say(call.record.rest().0);
    Ok(Effect::Done)
}

fn send_back(job: &mut Job, call: &Call) -> Outcome<Effect> {
    job.output.text(call.record.rest().0);
    Ok(Effect::Done)
}

fn say_centred(job: &mut Job, call: &Call) -> Outcome<Effect> {
    job.say(&centre(call.record.rest().0, CENTRING_WIDTH));
    Ok(Effect::Done)
}

fn say_underlined(job: &mut Job, call: &Call) -> Outcome<Effect> {
    job.say(&underline(call.record.rest().0));
    Ok(Effect::Done)
}

/// Text centred, with a line under it.
pub fn underline(text: &str) -> String {
    let line = "=".repeat(text.chars().count());
    format!("{}\n{}", centre(text, CENTRING_WIDTH), centre(&line, CENTRING_WIDTH))
}

fn error(_: &mut Job, call: &Call) -> Outcome<Effect> {
    let class = call.words.get(1).ok_or_else(|| {
        Diagnostic::error("&ERROR lacks its class", call.record.whole())
            .help("form: &ERROR WARNING|ERROR|FATAL message")
    })?;
    let severity = match choose_word(&class.text, class.span, "class of message")? {
        MessageClass::Warning => Severity::Warning,
        MessageClass::Error => Severity::Error,
        MessageClass::Fatal => Severity::Fatal,
    };
    let (rest, _) = call.record.rest();
    let message = rest.split_once([' ', ',']).map_or("", |(_, m)| m).trim();
    let mut made = Diagnostic::error(message, call.record.whole());
    made.severity = severity;
    Err(made)
}

fn dcptime(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let spent = job.clock.elapsed().as_secs_f64();
    job.clock = std::time::Instant::now();
    // a time of the machine: to the message stream and not among the results
    let line = format!("*** time {spent:.3} s {}", call.record.rest().0);
    job.output.message(line.trim_end(), line.trim_end());
    Ok(Effect::Done)
}

fn finish(_: &mut Job, _: &Call) -> Outcome<Effect> {
    Ok(Effect::Finish)
}
