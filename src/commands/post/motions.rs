//! `TRAJECTORY` of the PRCPOST menu: motions of bodies.

use crate::commands::Command;
use crate::commands::post::prcpost::{BODIES, BODY, EVENTS, LOCAL, MAG_DEFINE, PostQuery, show, spec};
use windlass_base::diagnostic::Outcome;
use windlass_base::table::Table;
use windlass_language::spec::{CommandSpec, OptionSpec};
use windlass_solve::results::{self, MotionOptions};

/// TRAJECTORY.
pub static TRAJECTORY: Command = Command { spec: &SPEC, edits: false, run: |job, call| show(job, call, build) };

const CG: OptionSpec = OptionSpec::new("-CG", &[], "of the centre of gravity").default("of the origin of the body");

static SPEC: CommandSpec = CommandSpec {
    options: &[BODY, EVENTS, MAG_DEFINE, CG, LOCAL],
    detail: "Of each body its location, velocity, acceleration, clearance of the bottom and displacement from the start of the run; \
             REPORT LOCATION, VELOCITY, ACCELERATION, BOTTOM or DISPLACEMENT prints one of these groups. Locations and angles are those of \
             &STATUS CONFIGURATION, angles without jumps; rates of turning are about the axes X, Y, Z. The clearance is the height of the \
             origin, or centre of gravity, above the bottom at the depth of the environment. Events between stored instants are interpolated.",
    ..spec("TRAJECTORY", BODIES, "motions of bodies")
};

fn build(query: &PostQuery) -> Outcome<Table> {
    let args = query.args();
    let how = MotionOptions { centre: args.has(&CG), local: query.is_local(), magnitude: query.magnitude() };
    query.to_outcome(results::trajectory(query.run, &query.bodies()?, &how, &query.events()?))
}
