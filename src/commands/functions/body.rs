//! `&BODY` and `&PART`: what bodies and their parts are, and what they displace where they stand.
//!
//! Source: [MOSES-HELP modeling] for WEIGHT, CG and RADII; no source at hand says what the other actions give: their values are our reading.

use super::{numbers, pick};
use crate::commands::Job;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Position;
use windlass_base::pose::Pose;
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_hydro::hull::Hydrostatics;
use windlass_hydro::{Hull, laden_mass};
use windlass_language::record::Word;
use windlass_model::{Body, Mass, Model, Part, Point, find};

choices! {
    /// What `&BODY` gives.
    enum BodyAction {
        Location = "LOCATION",
        Parts = "PARTS",
        Points = "POINTS",
        Weight = "WEIGHT",
        CentreOfGravity = "CG",
        Radii = "RADII",
        Current = "CURRENT",
        Draft = "DRAFT",
        Displacement = "DISPLACE",
        CentreOfBuoyancy = "CB",
        MetacentricHeights = "GM",
        LargestBuoyancy = "MAX_BUOY",
        Extremes = "EXTREMES",
    }
}

choices! {
    /// What `&PART` gives.
    enum PartAction {
        Body = "BODY",
        Current = "CURRENT",
        Location = "LOCATION",
        Points = "POINTS",
        Pieces = "PIECES",
        Weight = "WEIGHT",
        CentreOfGravity = "CG",
        Radii = "RADII",
        Extremes = "EXTREMES",
    }
}

/// The least and the greatest coordinates of points and pieces, as X1 X2 Y1 Y2 Z1 Z2.
fn extremes<'a>(
    model: &'a Model,
    parts: impl Iterator<Item = &'a Part>,
    position: impl Fn(&Part, Position) -> Position,
) -> Option<[f64; 6]> {
    let mut found: Option<[f64; 6]> = None;
    for part in parts {
        let points = model.points.values().filter(|p| Model::key(&p.part) == Model::key(&part.name)).map(|p| p.at);
        let reaches = part.pieces.iter().filter_map(|piece| piece.shape.extent());
        let corners = reaches.flat_map(|[low, high]| {
            [0, 1, 2, 3, 4, 5, 6, 7].map(|n| [0, 1, 2].map(|i| if n >> i & 1 == 0 { low[i] } else { high[i] }))
        });
        for at in points.chain(corners) {
            let at = position(part, at);
            let so_far = found.get_or_insert([at[0], at[0], at[1], at[1], at[2], at[2]]);
            for (axis, value) in at.into_iter().enumerate() {
                so_far[2 * axis] = so_far[2 * axis].min(value);
                so_far[2 * axis + 1] = so_far[2 * axis + 1].max(value);
            }
        }
    }
    found
}

/// The mass of some parts, which is not zero.
fn mass<'a>(job: &Job, parts: impl Iterator<Item = &'a Part>, owner: &str, span: Span) -> Outcome<Mass> {
    let mass = Mass::from_parts(parts, job.model.defaults.gravity);
    if mass.mass == 0.0 {
        return Err(
            Diagnostic::error(format!("{owner} has no weight"), span).help("#WEIGHT and &WEIGHT -TOTAL give one")
        );
    }
    Ok(mass)
}

fn join_names<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<Vec<_>>().join(" ")
}

/// The hull of a body.
fn hull(job: &Job, body: &Body, span: Span) -> Outcome<Hull> {
    let hull = Hull::new(&job.model, body).map_err(|e| e.diagnostic(span, job.units))?;
    hull.ok_or_else(|| {
        Diagnostic::error(format!("{} has no hull", body.name), span)
            .help("PGEN, &SURFACE and &DESCRIBE PIECE give one")
    })
}

/// The value of `&BODY(ACTION rest)`.
pub(super) fn body(job: &Job, action: &Word, rest: &[Word], span: Span) -> Outcome<String> {
    let action_name: BodyAction = pick(action, "BODY")?;
    let model = &job.model;
    if action_name == BodyAction::Current {
        return Ok(model.current_body().map(|b| b.name.clone()).unwrap_or_default());
    }
    let Some(name) = rest.first() else { return Err(Diagnostic::error("&BODY lacks the body's name", span)) };
    let found = find(&model.bodies, &name.text, "body", name.span)?;
    let key = Model::key(&found.name);
    let pose = Pose::from_place(&found.position);
    let own_mass = || mass(job, model.parts_of(found), &found.name, name.span);
    let state = || -> Outcome<(Hydrostatics, bool)> {
        let hull = hull(job, found, name.span)?;
        let mass = laden_mass(model, found).map_err(|e| e.diagnostic(name.span, job.units))?;
        let state = Hydrostatics::new(&hull.wet(&pose), &pose, mass.centre, hull.water_weight());
        let state = state
            .ok_or_else(|| Diagnostic::error(format!("{} displaces no water where it is", found.name), name.span))?;
        Ok((state, mass.mass > 0.0))
    };
    Ok(match action_name {
        BodyAction::Current => String::new(),
        BodyAction::Location => {
            let [x, y, z, roll, pitch, yaw] = found.position.values();
            format!("{} {}", numbers(&[x, y, z], Dim::Length, job), numbers(&[roll, pitch, yaw], Dim::Angle, job))
        }
        BodyAction::Parts => {
            join_names(model.parts.values().filter(|p| Model::key(&p.body) == key).map(|p| p.name.as_str()))
        }
        BodyAction::Points => {
            let own = |p: &&Point| model.body_of(p).is_some_and(|b| Model::key(&b.name) == key);
            join_names(model.points.values().filter(own).map(|p| p.name.as_str()))
        }
        BodyAction::Weight => numbers(&[own_mass()?.mass * model.defaults.gravity], Dim::Force, job),
        BodyAction::CentreOfGravity => numbers(own_mass()?.centre.as_slice(), Dim::Length, job),
        BodyAction::Radii => numbers(&own_mass()?.radii().map(|k| k.unwrap_or(0.0)), Dim::Length, job),
        BodyAction::Draft => numbers(&[0.0 - found.position.shift[2]], Dim::Length, job),
        BodyAction::Displacement => match hull(job, found, name.span) {
            Ok(hull) => numbers(&[hull.wet(&pose).volume * hull.water_weight()], Dim::Force, job),
            Err(error) => return Err(error),
        },
        BodyAction::CentreOfBuoyancy => {
            let (state, _) = state()?;
            numbers(pose.local(state.centre_of_buoyancy).as_slice(), Dim::Length, job)
        }
        BodyAction::MetacentricHeights => {
            let (state, has_weight) = state()?;
            if !has_weight {
                return Err(Diagnostic::error(format!("{} has no weight, and so no GM", found.name), name.span)
                    .help("#WEIGHT and &WEIGHT -TOTAL give one"));
            }
            numbers(&[state.gm_t, state.gm_l], Dim::Length, job)
        }
        BodyAction::LargestBuoyancy => {
            /// Deeper than any body is high (m).
            const DEEP: f64 = 1e6;
            let hull = hull(job, found, name.span)?;
            let mut sunk = found.position;
            sunk.shift[2] = -DEEP;
            numbers(&[hull.wet(&Pose::from_place(&sunk)).volume * hull.water_weight()], Dim::Force, job)
        }
        BodyAction::Extremes => extremes(model, model.parts_of(found), |part, at| part.position.apply(at))
            .map_or(String::new(), |six| numbers(&six, Dim::Length, job)),
    })
}

/// The value of `&PART(ACTION rest)`.
pub(super) fn part(job: &Job, action: &Word, rest: &[Word], span: Span) -> Outcome<String> {
    let action_name: PartAction = pick(action, "PART")?;
    let model = &job.model;
    if action_name == PartAction::Current {
        return Ok(model.current_part.clone().unwrap_or_default());
    }
    let Some(name) = rest.first() else { return Err(Diagnostic::error("&PART lacks the part's name", span)) };
    let found = find(&model.parts, &name.text, "part", name.span)?;
    let own_mass = || mass(job, std::iter::once(found), &found.name, name.span);
    Ok(match action_name {
        PartAction::Current => String::new(),
        PartAction::Body => found.body.clone(),
        PartAction::Location => {
            let [x, y, z, roll, pitch, yaw] = found.position.values();
            format!("{} {}", numbers(&[x, y, z], Dim::Length, job), numbers(&[roll, pitch, yaw], Dim::Angle, job))
        }
        PartAction::Points => {
            let own = |p: &&Point| Model::key(&p.part) == Model::key(&found.name);
            join_names(model.points.values().filter(own).map(|p| p.name.as_str()))
        }
        PartAction::Pieces => join_names(found.pieces.iter().map(|p| p.name.as_str())),
        PartAction::Weight => numbers(&[own_mass()?.mass * model.defaults.gravity], Dim::Force, job),
        PartAction::CentreOfGravity => numbers(own_mass()?.centre.as_slice(), Dim::Length, job),
        PartAction::Radii => numbers(&own_mass()?.radii().map(|k| k.unwrap_or(0.0)), Dim::Length, job),
        PartAction::Extremes => extremes(model, std::iter::once(found), |_, at| at)
            .map_or(String::new(), |six| numbers(&six, Dim::Length, job)),
    })
}
