//! `&REPORT`: a small menu that writes a report line by line.

use crate::commands::menu;
use crate::commands::output::message::underline;
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::page::centre;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_language::spec::{CommandSpec, Kind, Opens, OptionSpec, TextForm, ValueSpec};

/// &REPORT.
pub static REPORT: Command = Command { spec: &REPORT_SPEC, edits: false, run: open };
/// TYPE.
pub static TYPE: Command = Command { spec: &TYPE_SPEC, edits: false, run: line };
/// CTYPE.
pub static CTYPE: Command = Command { spec: &CTYPE_SPEC, edits: false, run: print_centred };
/// CUTYPE.
pub static CUTYPE: Command = Command { spec: &CUTYPE_SPEC, edits: false, run: headline };

const HARD: OptionSpec = OptionSpec::new("-HARD", &[], "to the report file");
const BOTH: OptionSpec = OptionSpec::new("-BOTH", &[], "to the screen and the report file");

static REPORT_SPEC: CommandSpec = CommandSpec {
    opens: Opens::Menu(&menu::REPORT),
    data: &[
        ValueSpec::new("H1", Kind::Text, "first heading").or("none"),
        ValueSpec::new("H2", Kind::Text, "second heading").or("none"),
    ],
    options: &[HARD, BOTH],
    detail: "TYPE, CTYPE and CUTYPE write lines; END_REPORT closes.",
    example: "&REPORT 'Summary of lines'\nTYPE one line\nEND_REPORT",
    ..CommandSpec::new("&REPORT", "opens a report")
};

const fn writer(name: &'static str, help: &'static str) -> CommandSpec {
    CommandSpec {
        form: TextForm::Text,
        menus: const { &[&menu::REPORT] },
        example: "&REPORT\nTYPE text\nCTYPE text\nCUTYPE text\nEND",
        ..CommandSpec::new(name, help)
    }
}
static TYPE_SPEC: CommandSpec = writer("TYPE", "writes a line");
static CTYPE_SPEC: CommandSpec = writer("CTYPE", "writes a line, centred");
static CUTYPE_SPEC: CommandSpec = writer("CUTYPE", "writes a line, centred and underlined");

fn open(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let both = call.args.has(&BOTH);
    let hard = call.args.has(&HARD) || both;
    job.menus.push(Menu::Report { screen: !hard || both, hard });
    let heads: Vec<String> = call.args.data.iter().filter_map(|v| v.word()).map(str::to_string).collect();
    for head in heads {
        write(job, call, &underline(&head))?;
    }
    Ok(Effect::Done)
}

fn write(job: &mut Job, call: &Call, text: &str) -> Outcome<()> {
    let Menu::Report { screen, hard } = *job.menu() else { return Ok(()) };
    if hard {
        job.output.hard(text).map_err(|e| Diagnostic::error(e.to_string(), call.record.whole()))?;
    }
    if screen {
        job.say(text);
    }
    Ok(())
}

fn line(job: &mut Job, call: &Call) -> Outcome<Effect> {
    write(job, call, call.record.rest().0)?;
    Ok(Effect::Done)
}

fn print_centred(job: &mut Job, call: &Call) -> Outcome<Effect> {
    write(job, call, &centre(call.record.rest().0, 80))?;
    Ok(Effect::Done)
}

fn headline(job: &mut Job, call: &Call) -> Outcome<Effect> {
    write(job, call, &underline(call.record.rest().0))?;
    Ok(Effect::Done)
}
