//! `&PARAMETER`: what holds for all computations.

use crate::commands::{Call, Command, Effect, Job};
use windlass_base::choice::YesNo;
use windlass_base::diagnostic::Outcome;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, OptionSpec, ValueSpec};

/// &PARAMETER.
pub static PARAMETER: Command = Command { spec: &SPEC, edits: false, run };

const ACCEPT_MISSING: OptionSpec = OptionSpec::new(
    "-ACCEPT_MISSING",
    &[ValueSpec::choice::<YesNo>("YES/NO", "YES goes on")],
    "whether modes and runs go on where a body lacks added mass; reports then say so",
)
.owner(Owner::Ours)
.default("NO: they are refused");

static SPEC: CommandSpec = CommandSpec {
    options: &[ACCEPT_MISSING],
    detail: "A hull of -DIFTYPE FK has the pressure of the waves as they are without it; its added mass and radiation come from #AMASS, #DAMP or \
             DATABASE. Without added mass natural periods are those of dry mass, so that &STATUS MODES, FREQ_RESPONSE and TDOM refuse such a body.",
    example: "&PARAMETER -ACCEPT_MISSING YES",
    ..CommandSpec::new("&PARAMETER", "sets what holds for all computations")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    if let Some(given) = call.args.option(&ACCEPT_MISSING) {
        job.model.parameters.accept_missing = given.is_on();
    }
    Ok(Effect::Done)
}
