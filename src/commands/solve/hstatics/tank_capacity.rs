//! `TANK_CAPACITY`: what a compartment holds by its sounding.
//!
//! Source: [MOSES-REF tank].

use super::{MAX_ROWS, dispose};
use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::Tank;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::find;

/// TANK_CAPACITY.
pub static TANK_CAPACITY: Command = Command { spec: &SPEC, edits: false, run };

const ROLL: OptionSpec =
    OptionSpec::new("-ROLL", &[ValueSpec::new("A", Kind::Number(Dim::Angle), "roll")], "roll of the body").default("0");
const PITCH: OptionSpec =
    OptionSpec::new("-PITCH", &[ValueSpec::new("A", Kind::Number(Dim::Angle), "pitch")], "pitch of the body")
        .default("0");

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HSTATICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[
        ValueSpec::new("TNAME", Kind::Text, "the compartment"),
        ValueSpec::new("INC", Kind::Number(Dim::Length), "step of the sounding").positive(),
    ],
    options: &[ROLL, PITCH],
    detail: "What a compartment holds by its sounding, from the bottom of its tube to its top, in the attitude given. Weights are of the liquid that is in it. \
             Centres are in the system of the body; the second moments of the surface are about axes through its centroid. The result goes to the \
             disposition menu.",
    example: "&DESCRIBE BODY TBRG\nMEDIT\n&DESCRIBE COMPARTMENT T1\nPGEN\nPLANE 10 60 -RECT 1 19 90\nEND\nEND\nHSTATICS\nTANK_CAPACITY T1 3\nREPORT\nEND\nEND",
    ..CommandSpec::new("TANK_CAPACITY", "what a compartment holds by its sounding")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const TANK: DatumKey<str> = SPEC.word("TNAME");
    const STEP: DatumKey<f64> = SPEC.number("INC");
    let (args, span) = (&call.args, call.args.span);
    let model = &job.model;
    let to_error = |e: windlass_model::ClassError| e.diagnostic(span, job.units);
    let compartment =
        find(&model.compartments, args.word(TANK).unwrap_or_default(), "compartment", args.position(TANK))?;
    let tank = Tank::new(model, compartment).map_err(to_error)?;
    let turn = [args.option_number(&ROLL).unwrap_or(0.0), args.option_number(&PITCH).unwrap_or(0.0), 0.0];
    let pose = Pose::from_place(&Place { turn, ..Place::default() });
    let tube = tank.sounding_tube(model, compartment);
    let [top, bottom] = tube.map(nalgebra::Vector3::from);
    let (length, step) = ((top - bottom).norm(), args.number(STEP).unwrap_or(1.0));
    if length / step > MAX_ROWS {
        return Err(Diagnostic::error(format!("more than {MAX_ROWS} steps"), args.position(STEP)));
    }
    let mut soundings: Vec<f64> =
        (0..).map(|n| f64::from(n) * step).take_while(|s| *s < length * (1.0 - 1e-9)).collect();
    soundings.push(length);
    let at = |sounding: &f64| {
        let volume = tank.volume_at(&pose, tube, *sounding).ok_or_else(|| {
            windlass_model::ClassError::new(format!(
                "the sounding tube of {} lies level in this attitude",
                compartment.name
            ))
        })?;
        Ok((*sounding, tank.liquid_of(&pose, volume)?))
    };
    let rows = soundings.iter().map(at).collect::<Result<Vec<_>, _>>().map_err(to_error)?;
    let weight = tank.density() * model.defaults.gravity;
    let centre = |liquid: &windlass_hydro::Liquid| {
        let found = liquid.centroid().map(|c| pose.axes.transpose() * c);
        found.map_or([None; 3], |c| [c.x, c.y, c.z].map(|x| Some(if x.abs() < 1e-9 { 0.0 } else { x })))
    };
    let fourth = Dim::Derived { force: 0, length: 4, seconds: 0 };
    let table = Table::new(format!("Capacity of {}", compartment.name))
        .fact("Roll", turn[0], Dim::Angle)
        .fact("Pitch", turn[1], Dim::Angle)
        .with_rows(&rows)
        .column("", "Sounding", Dim::Length, Digits::Usual, |(sounding, _)| *sounding)
        .column("", "% Full", Dim::None, Digits::Decimals(2), |(_, l)| 100.0 * l.volume() / tank.capacity)
        .column("", "Volume", Dim::Volume, Digits::Usual, |(_, l)| l.volume())
        .column("", "Weight", Dim::Force, Digits::Usual, |(_, l)| l.volume() * weight)
        .columns("Center", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(_, l)| centre(l))
        .columns("Free Surface", ["Trans.", "Long."], fourth, Digits::Usual, |(_, l)| {
            l.surface_inertia(&pose).map(Some)
        })
        .build();
    Ok(dispose(job, table, span))
}
