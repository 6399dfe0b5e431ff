//! `CFORM`: curves of form.
//!
//! Source: [MOSES-REF cform]; the form of three data is ours.

use super::{MAX_ROWS, WAVE, body, dispose, keep_wave, static_wave, with_wave};
use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::Given;
use windlass_hydro::Hull;
use windlass_hydro::hull::Hydrostatics;
use windlass_hydro::stability::{Attitude, StillBody};
use windlass_language::spec::{CommandSpec, Kind, Opens, OptionSpec, ValueSpec};

/// CFORM.
pub static CFORM: Command = Command { spec: &SPEC, edits: false, run };

const NUM: ValueSpec = ValueSpec::new("NUM", Kind::Integer, "number of conditions").in_range(1.0, MAX_ROWS);

const fn step(dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new("INC", Kind::Number(dim), help)
}

const DRAFT: OptionSpec = OptionSpec::new("-DRAFT", &[step(Dim::Length, "step of the draft"), NUM], "varies the draft");
const ROLL: OptionSpec = OptionSpec::new("-ROLL", &[step(Dim::Angle, "step of the roll"), NUM], "varies the roll");
const PITCH: OptionSpec = OptionSpec::new("-PITCH", &[step(Dim::Angle, "step of the trim"), NUM], "varies the trim");

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HSTATICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[
        ValueSpec::new("DRAFT", Kind::Number(Dim::Length), "first draft of the body's origin"),
        ValueSpec::new("ROLL", Kind::Number(Dim::None), "first roll; without an option the step of the draft").or("0"),
        ValueSpec::new("TRIM", Kind::Number(Dim::None), "first trim; without an option the number of drafts").or("0"),
    ],
    options: &[DRAFT, ROLL, PITCH, WAVE],
    detail: "Curves of form of the body at its x, y and yaw, for NUM conditions of which draft, roll or trim grows by INC. Without -DRAFT, -ROLL and -PITCH the three data are \
             the first draft, its step and the number of drafts, upright (ours). LCB, TCB, LCF, TCF are in the system of the body; KB, KMT, KML are vertical, above its origin; BMT and BML are about \
             its longitudinal and transverse axis; the moment to trim is that of BM, or of GM where the body has a weight. Conditions in which nothing is wet have no \
             numbers. The result goes to the disposition menu, where REPORT BASIC and REPORT COEFFICIENT print a part of it.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\nHSTATICS\nCFORM 1 0 0 -DRAFT 0.5 4\nREPORT BASIC\nEND\nCFORM 9 -ROLL 2 5 -WAVE 400 20\nREPORT\nEND\nEND",
    ..CommandSpec::new("CFORM", "curves of form")
};

/// What varies, by how much, and how often.
struct FormVariation {
    name: &'static str,
    dim: Dim,
    step: f64,
    count: i64,
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (args, span, units) = (&call.args, call.args.span, job.units);
    let [draft, second, third] = args.numbers_or_zero(const { SPEC.numbers(["DRAFT", "ROLL", "TRIM"]) });
    let varying: Vec<&Given> = [DRAFT, ROLL, PITCH].iter().filter_map(|option| args.option(option)).collect();
    let ([roll, trim], variation) = match varying.as_slice() {
        [] => {
            let position = args.position(const { SPEC.number("ROLL") });
            if second <= 0.0 {
                return Err(Diagnostic::error("the step of the draft must be greater than zero", position)
                    .help("forms: CFORM DRAFT INC NUM; CFORM DRAFT ROLL TRIM -DRAFT INC NUM"));
            }
            let position = args.position(const { SPEC.number("TRIM") });
            if third.fract() != 0.0 || !(1.0..=MAX_ROWS).contains(&third) {
                return Err(Diagnostic::error(
                    format!("the number of drafts must be a whole number between 1 and {MAX_ROWS}"),
                    position,
                )
                .help("forms: CFORM DRAFT INC NUM; CFORM DRAFT ROLL TRIM -DRAFT INC NUM"));
            }
            let step = Dim::Length.to_si(second, units);
            ([0.0; 2], FormVariation { name: "Draft", dim: Dim::Length, step, count: third as i64 })
        }
        [given] => {
            let (name, dim, option) = match given {
                _ if given.is(&DRAFT) => ("Draft", Dim::Length, &DRAFT),
                _ if given.is(&ROLL) => ("Roll", Dim::Angle, &ROLL),
                _ => ("Trim", Dim::Angle, &PITCH),
            };
            let (step, count) = (given.number(option.number("INC")), given.integer(option.integer("NUM")));
            let angles = [second, third].map(f64::to_radians);
            (angles, FormVariation { name, dim, step: step.unwrap_or(0.0), count: count.unwrap_or(1) })
        }
        [_, other, ..] => {
            return Err(Diagnostic::error("CFORM varies one of draft, roll and trim", other.span));
        }
    };
    let wave = static_wave(job, args);
    let body = body(job, span)?;
    let to_error = |e: windlass_model::ClassError| e.diagnostic(span, units);
    let Some(hull) = Hull::new(&job.model, body).map_err(to_error)? else {
        return Err(Diagnostic::error(format!("{} has no hull", body.name), span)
            .help("PGEN, &SURFACE and &DESCRIBE PIECE give one"));
    };
    let still = StillBody::new(&job.model, body, wave).map_err(to_error)?;
    let mass = *still.mass();
    let first = Attitude { roll, trim, ..Attitude::from_place(&body.position) };
    let condition = |n: i64| {
        let grown = variation.step * n as f64;
        let mut at = first;
        at.origin[2] = -draft;
        let value = match variation.name {
            "Draft" => {
                at.origin[2] -= grown;
                -at.origin[2]
            }
            "Roll" => {
                at.roll += grown;
                at.roll
            }
            _ => {
                at.trim += grown;
                at.trim
            }
        };
        let (wet, skin) = still.wet_and_skin(&at)?;
        let pose = at.pose();
        let found = Hydrostatics::new(&wet, &pose, mass.centre, hull.water_weight());
        Ok((value, pose, found.map(|h| Hydrostatics { wetted_area: skin, ..h })))
    };
    let rows = (0..variation.count).map(condition).collect::<Result<Vec<_>, _>>().map_err(to_error)?;
    let has_flooded = windlass_hydro::compartments_of(&job.model, body).any(|c| c.contents.is_flooded);
    let high = |h: &Hydrostatics| if mass.mass > 0.0 && !has_flooded { h.gm_l } else { h.bm_l };
    let length = |name: &str| if name == variation.name { None } else { Some(()) };
    let mut table = Table::new(format!("Curves of Form of {}", body.name));
    for (name, value, dim) in [("Draft", draft, Dim::Length), ("Roll", roll, Dim::Angle), ("Trim", trim, Dim::Angle)] {
        if length(name).is_some() {
            table = table.fact(name, value, dim);
        }
    }
    table = with_wave(table, wave.as_ref());
    if has_flooded {
        table.note("flooded compartments displace nothing");
    }
    const BASIC: &str = "Basic";
    const COEFFICIENT: &str = "Coefficient";
    let table = table
        .with_rows(&rows)
        .column("", variation.name, variation.dim, Digits::Usual, |(value, ..)| *value)
        .column(BASIC, "Displ.", Dim::Force, Digits::Usual, |(.., h)| h.map(|h| h.displacement))
        .column(BASIC, "Volume", Dim::Volume, Digits::Usual, |(.., h)| h.map(|h| h.volume))
        .column(BASIC, "KB", Dim::Length, Digits::Usual, |(.., h)| h.map(|h| h.kb))
        .columns(BASIC, ["LCB", "TCB"], Dim::Length, Digits::Usual, |(_, pose, h)| {
            local(h.map(|h| pose.local(h.centre_of_buoyancy)))
        })
        .column(BASIC, "WP Area", Dim::Area, Digits::Usual, |(.., h)| h.map(|h| h.plane_area))
        .columns(BASIC, ["LCF", "TCF"], Dim::Length, Digits::Usual, |(_, pose, h)| {
            let level = |[x, y]: [f64; 2]| nalgebra::Vector3::new(x, y, still.level());
            local(h.and_then(|h| h.centre_of_flotation).map(|f| pose.local(level(f))))
        })
        .columns(BASIC, ["KMT", "KML", "BMT", "BML"], Dim::Length, Digits::Usual, |(.., h)| {
            h.map_or([None; 4], |h| [h.kb + h.bm_t, h.kb + h.bm_l, h.bm_t, h.bm_l].map(Some))
        })
        .column(COEFFICIENT, "Wet Area", Dim::Area, Digits::Usual, |(.., h)| h.map(|h| h.wetted_area))
        .column(COEFFICIENT, "Immersion", Dim::ForcePerLength, Digits::Usual, |(.., h)| {
            h.map(|h| h.plane_area * hull.water_weight())
        })
        .column(COEFFICIENT, "Trim 1 Deg", Dim::Moment, Digits::Usual, |(.., h)| {
            h.map(|h| h.displacement * high(&h) * 1f64.to_radians())
        })
        .build();
    keep_wave(job, wave);
    Ok(dispose(job, table, span))
}

/// The level coordinates of a point of the body.
fn local(at: Option<nalgebra::Vector3<f64>>) -> [Option<f64>; 2] {
    at.map_or([None; 2], |at| [at.x, at.y].map(|x| Some(super::clean(x))))
}
