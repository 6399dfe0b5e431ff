//! `MOMENT`: shear and bending along the body.
//!
//! Source: [MOSES-REF moment], [MOSES-HELP hystat].

use super::{WAVE, body, dispose, keep_wave, static_wave, with_wave};
use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::diagnostic::Outcome;
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, eight_figures};
use windlass_hydro::stability::{StillBody, find_strength};
use windlass_language::spec::{CommandSpec, Opens};
use windlass_model::{ClassError, Model, SolveKind};

/// MOMENT.
pub static MOMENT: Command = Command { spec: &SPEC, edits: false, run };

/// Intervals of the table.
const INTERVALS: usize = 20;
/// What may be left behind the last load before it is warned of, as a share of the weight, and of the weight times the length.
const CLOSING_TOLERANCE: f64 = 1e-4;

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HSTATICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    options: &[WAVE],
    absent: &[(
        "-ALLOW",
        "stress and deflection need the section of the body, which it has none of; shear and moment are compared by hand",
    )],
    detail: "Shear and bending moment of the body as it stands, at 21 stations along its hull, of weights, contents of compartments and buoyancy; \
             connectors, wind and current have no part. Stations are level distances from the origin along the heading. Weights, contents and buoyancy are what lies before the station; \
             shear is the force upward on that; the moment is positive sagging (our reading). A weight with -LDIST is a trapezoid between its stations that keeps its \
             weight and center; one without, a total of &WEIGHT too, acts at its center (our reading), and the table says how much does. What \
             lies beyond an end of the hull acts there as force and moment. Behind all loads shear and moment are zero in equilibrium: what is left is reported, \
             and warned of; EQUI_H, &EQUI, &WEIGHT -COMPUTE and &CMP_BAL bring the body there, under -WAVE EQUI_H does. The greatest values are those of 400 intervals.",
    example: "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY B\n*CG 45.75 0 5\nPGEN\nPLANE 0 91.5 -RECT 0 6.1 27.5\nEND\n#WEIGHT *CG 6000 9 25 25 -LDIST 30.5 61\nEND\n\
              HSTATICS\nEQUI_H\nMOMENT\nREPORT\nEND\nEND",
    ..CommandSpec::new("MOMENT", "shear and bending along the body")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let span = call.args.span;
    let wave = static_wave(job, &call.args);
    let (body, units) = (body(job, span)?, job.units);
    let to_error = |e: ClassError| e.diagnostic(span, units);
    job.model.check_effects(SolveKind::Statics).map_err(to_error)?;
    let still = StillBody::new(&job.model, body, wave).map_err(to_error)?;
    let found = find_strength(&job.model, body, &still, INTERVALS).map_err(to_error)?;
    let [up, down, sagging, hogging] = found.extremes;
    let tiny = CLOSING_TOLERANCE * found.weight;
    let value = |x: f64, dim: Dim| format!("{} {}", eight_figures(dim.from_si(x, units)), dim.label(units));
    let round = |x: f64, scale: f64| if x.abs() < 1e-9 * scale { 0.0 } else { x };
    let whole = found.weight * found.length;
    let mut table = with_wave(Table::new(format!("Longitudinal Strength of {}", body.name)), still.wave())
        .fact("Weight", found.weight, Dim::Force)
        .fact("Greatest Shear", round(up.shear, found.weight), Dim::Force)
        .fact("At X", up.station, Dim::Length)
        .fact("Least Shear", round(down.shear, found.weight), Dim::Force)
        .fact("At X", down.station, Dim::Length)
        .fact("Sagging Moment", round(sagging.moment.max(0.0), whole), Dim::Moment)
        .fact("At X", sagging.station, Dim::Length)
        .fact("Hogging Moment", round((-hogging.moment).max(0.0), whole), Dim::Moment)
        .fact("At X", hogging.station, Dim::Length)
        .fact("Shear Left", round(found.left[0], found.weight), Dim::Force)
        .fact("Moment Left", round(found.left[1], whole), Dim::Moment);
    let [shear, moment] = found.left;
    if shear.abs() > tiny || moment.abs() > tiny * found.length {
        table.warn(format!(
            "{} is not in equilibrium: shear and moment do not close, {} and {} are left behind the last load; EQUI_H brings it to rest",
            body.name,
            value(shear, Dim::Force),
            value(moment, Dim::Moment)
        ));
    }
    if found.points.0 > 0 {
        table.note(format!(
            "weights without -LDIST act at their centers: {}, of {} in all",
            found.points.0,
            value(found.points.1, Dim::Force)
        ));
    }
    if found.others != 0.0 {
        table.note(format!(
            "buoyancy and weight of points, members and growth, {} upward in all, act at their centers",
            value(found.others, Dim::Force)
        ));
    }
    let own = |name: &String| {
        let point = job.model.points.get(&Model::key(name));
        point.and_then(|p| job.model.body_of(p)).is_some_and(|b| Model::key(&b.name) == Model::key(&body.name))
    };
    let held = job.model.connectors.values().filter(|c| c.active && c.points.iter().any(own)).count();
    if held > 0 {
        table.note(format!("{held} connectors are left out"));
    }
    table.add_notes(job.model.caveats());
    let table = table
        .with_rows(&found.rows)
        .column("", "X", Dim::Length, Digits::Usual, |row| row.station)
        .column("", "Weight", Dim::Force, Digits::Usual, |row| row.weight)
        .column("", "Contents", Dim::Force, Digits::Usual, |row| row.contents)
        .column("", "Buoyancy", Dim::Force, Digits::Usual, |row| row.buoyancy)
        .column("", "Shear", Dim::Force, Digits::Usual, |row| round(row.shear, found.weight))
        .column("", "Moment", Dim::Moment, Digits::Usual, |row| round(row.moment, whole))
        .build();
    keep_wave(job, wave);
    Ok(dispose(job, table, span))
}
