//! Records about devices and pictures that are accepted and change nothing: `&LOGDEVICE`, `&CHANNEL`, `&PI_VIEW`.
//!
//! Source: [MOSES-REF int_ldv_cha, pic].

use crate::commands::{Call, Command, Effect, Job};
use windlass_base::diagnostic::Outcome;
use windlass_language::spec::{CommandSpec, TextForm};

/// &LOGDEVICE.
pub static LOGDEVICE: Command = Command { spec: &LOGDEVICE_SPEC, edits: false, run };
/// &CHANNEL.
pub static CHANNEL: Command = Command { spec: &CHANNEL_SPEC, edits: false, run };
/// &PI_VIEW.
pub static PI_VIEW: Command = Command { spec: &PI_VIEW_SPEC, edits: false, run };

const fn accepted_spec(
    name: &'static str,
    help: &'static str,
    detail: &'static str,
    example: &'static str,
) -> CommandSpec {
    CommandSpec { form: TextForm::Text, detail, example, ..CommandSpec::new(name, help) }
}

static LOGDEVICE_SPEC: CommandSpec = accepted_spec(
    "&LOGDEVICE",
    "accepted: styles and margins of devices",
    "windlass writes plain text; a note says once that the record changes nothing. -HARD of reports and STORE choose where results go.",
    "&LOGDEVICE OUTPUT -MARGIN 1 1 1 1 -LANDSCAPE",
);
static CHANNEL_SPEC: CommandSpec = accepted_spec(
    "&CHANNEL",
    "accepted: channels of devices",
    "A note says once that the record changes nothing. &FILE ANS_DIRECTORY says where answers go.",
    "&CHANNEL OUTPUT -PAGE 66",
);
static PI_VIEW_SPEC: CommandSpec = accepted_spec(
    "&PI_VIEW",
    "accepted: views of pictures under a name",
    "A note says once that the record changes nothing; the views of &PICTURE are those of &HELP &PICTURE.",
    "&PI_VIEW -ADD CORNER ISO",
);

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let Some(first) = call.words.first() else { return Ok(Effect::Done) };
    let name = [&LOGDEVICE, &CHANNEL, &PI_VIEW].map(|c| c.spec.name);
    let said = name.into_iter().find(|name| name.eq_ignore_ascii_case(&first.text)).unwrap_or("the record");
    if !job.absent_said.contains(&said) {
        job.absent_said.push(said);
        job.remark(format!("{said} has no effect in windlass (said once)"), first.span);
    }
    Ok(Effect::Done)
}
