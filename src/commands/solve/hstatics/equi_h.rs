//! `EQUI_H`: the floating position of one body.
//!
//! Source: [MOSES-REF equi_h].

use super::arms::{ECHO, NUMITER, TOLERANCE, balance_limits};
use super::{WAVE, body, keep_wave, static_wave};
use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::units::Dim;
use windlass_hydro::stability::{Attitude, StillBody};
use windlass_language::spec::{CommandSpec, OptionSpec, ValueSpec};
use windlass_model::{ClassError, Model, SolveKind};

/// EQUI_H.
pub static EQUI_H: Command = Command { spec: &SPEC, edits: true, run };

choices! {
    /// A degree of freedom of a floating body.
    enum FloatingDof {
        Heave = "HEAVE",
        Roll = "ROLL",
        Pitch = "PITCH",
    }
}

const FIX: OptionSpec = OptionSpec::new(
    "-FIX",
    &[ValueSpec::choice::<FloatingDof>("DOF", "degree of freedom")],
    "holds degrees of freedom as they are",
)
.repeating(1);

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HSTATICS],
    options: &[ECHO, FIX, NUMITER, TOLERANCE, WAVE],
    detail: "Heave, roll and pitch of the body until its buoyancy equals its weight with contents and stands in one vertical with it: connectors, wind, current and \
             waves in motion have no part. Newton's iteration from where the body is. The result is the configuration from then on; there is no report: &STATUS B_W or CONFIGURATION shows \
             it, &INSTATE -PREVIOUS goes back. An equilibrium from which the body would turn away is said.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\n&WEIGHT -TOTAL TBRG 23000 200 0 12 38 118 120\n\
              HSTATICS\nEQUI_H -FIX ROLL\nEND\n&STATUS CONFIGURATION",
    ..CommandSpec::new("EQUI_H", "finds the floating position of the body")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (args, span) = (&call.args, call.args.span);
    let wave = static_wave(job, args);
    let (body, units) = (body(job, span)?, job.units);
    let to_error = |e: ClassError| e.diagnostic(span, units);
    job.model.check_effects(SolveKind::Statics).map_err(to_error)?;
    let mut free = [true; 3];
    for dof in args.option(&FIX).into_iter().flat_map(|given| given.choices::<FloatingDof>(const { FIX.choice("DOF") }))
    {
        free[dof as usize] = false;
    }
    if free == [false; 3] {
        let position = args.option(&FIX).map_or(span, |given| given.span);
        return Err(Diagnostic::error("-FIX leaves no degree of freedom to find", position));
    }
    let still = StillBody::new(&job.model, body, wave).map_err(to_error)?;
    let found = still.balance(&Attitude::from_place(&body.position), free, &balance_limits(args)).map_err(to_error)?;
    let (key, name) = (Model::key(&body.name), body.name.clone());
    let mut said = Vec::new();
    let (matrix, _) = still.stiffness(&found.attitude).map_err(to_error)?;
    if free[0] && matrix[(0, 0)] <= 0.0 {
        said.push(format!("{name} floats without a waterplane: nothing holds it in heave"));
    } else if free[1]
        && let Ok(height) = still.metacentric_height(&found.attitude)
        && height < 0.0
    {
        let height = windlass_base::units::eight_figures(Dim::Length.from_si(height, units));
        let length = Dim::Length.label(units);
        said.push(format!("{name} would roll away from this equilibrium: its metacentric height is {height} {length}"));
    }
    let steps = found.steps;
    if let Some(body) = job.model.bodies.get_mut(&key) {
        body.previous = body.position;
        // what rounding leaves of an angle is none
        let round = |angle: f64| if angle.abs() < 1e-12 { 0.0 } else { angle };
        let at = Attitude { roll: round(found.attitude.roll), trim: round(found.attitude.trim), ..found.attitude };
        body.position = at.position();
    }
    keep_wave(job, wave);
    said.into_iter().for_each(|text| job.warn(text, span));
    if args.switch(&ECHO, false) {
        job.remark(format!("{name} floats; steps: {steps}"), span);
    }
    Ok(Effect::Done)
}
