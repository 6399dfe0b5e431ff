//! A case of the tether engine from the model.

use super::TetherRunSettings;
use super::actions::refuse_any;
use super::moored::Moored;
use crate::SolveError;
use crate::time::Action;
use nalgebra::Vector3;
use std::f64::consts::PI;
use std::sync::Arc;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::Floating;
use windlass_hydro::current::CurrentField;
use windlass_hydro::sea::Sea;
use windlass_hydro::spectrum::{is_regular, is_stokes};
use windlass_model::{
    Attribute, Body, ClassError, Connector, Mass, Model, Shape, TetherEnds, TetherHold, TetherSection, TetherUse,
};
use windlass_tether::compatibility::Compatibility;
use windlass_tether::installed::modes::count_fast_modes;
use windlass_tether::installed::{
    EndSprings, Impact, InstalledRunSettings, InstalledTether, InternalFluid, NodeConstraint,
};
use windlass_tether::line::ElementLabel;
use windlass_tether::modes::warn_of_fast_modes;
use windlass_tether::structure::Structure;
use windlass_tether::structure::floating_body::Afloat;
use windlass_tether::structure::flow::{FlowWaves, WaterFlow};
use windlass_tether::structure::tubes::{TubeMember, Tubes};
use windlass_tether::structure::wave::DeepWave;
use windlass_tether::towed::{self, EndSpring, Towed};
use windlass_tether::{TetherElement, TetherLine};

/// A case, ready to run.
#[derive(Debug)]
pub struct TetherCase {
    /// What it is.
    pub kind: TetherCaseKind,
    /// Seed of the random phases, where they are random.
    pub seed: Option<u64>,
    /// What a user should know of how it was made.
    pub notes: Vec<String>,
}

/// The two sorts of case.
#[derive(Debug)]
pub enum TetherCaseKind {
    /// One towed tether.
    Towed(Box<TowedCase>),
    /// Installed tethers with their structure.
    Installed(Box<Installed>),
}

/// A towed tether with the vessel that it hangs on.
#[derive(Debug)]
pub struct TowedCase {
    /// Name of the tether.
    pub name: String,
    /// The tether.
    pub tether: Towed,
    /// The vessel, where its end is on a body.
    pub vessel: Option<TowingVessel>,
}

/// The vessel of a towed tether. It is held: its pages have its place, its weight, and the pull of the spring at the tether's end.
#[derive(Debug)]
pub struct TowingVessel {
    /// Name of the body.
    pub body: String,
    /// Place of its centre of gravity.
    pub position: Place,
    /// Weight (N).
    pub weight: f64,
    /// The tether's end from the centre of gravity (m, global).
    pub arm: Vector3<f64>,
}

/// Installed tethers with the structure they hold.
#[derive(Debug)]
pub struct Installed {
    /// Name of the body.
    pub body: String,
    /// What acts on it besides the tethers.
    pub structure: Box<dyn Structure>,
    /// The tethers.
    pub tethers: Vec<InstalledTether>,
    /// The water.
    pub flow: WaterFlow,
    /// Peculiarities kept.
    pub compatibility: Compatibility,
    /// Where and how it starts, its step and number of states.
    pub course: InstalledRunSettings,
    /// The centre of gravity in the axes of the body (m).
    pub centre: Vector3<f64>,
    /// Nodes of the body that are reported: names, and places from the centre of gravity in its axes (m).
    pub points: Vec<(String, Vector3<f64>)>,
}

/// The sections of a connector that is a tether; none of others.
pub(super) fn sections<'a>(model: &'a Model, connector: &Connector) -> &'a [TetherSection] {
    model.classes.get(&Model::key(&connector.class)).map_or(&[], |class| class.tether_sections())
}

/// The elements of a tether from its anchor or trailing end; the class has them from the vessel.
pub(super) fn line(sections: &[TetherSection]) -> Result<TetherLine, ClassError> {
    let mut elements = Vec::new();
    let mut node = 0;
    for (index, section) in sections.iter().enumerate().rev() {
        let count = section.elements.max(1);
        for _ in 0..count {
            node += 1;
            let group = index as i64 + 1;
            let [n1, n2, material, geometry] = section.label.unwrap_or([node, node + 1, group, group]);
            elements.push(TetherElement {
                length: section.length / count as f64,
                outer_diameter: section.outer_diameter,
                wall_thickness: section.wall_thickness,
                density: section.density,
                youngs_modulus: section.youngs_modulus,
                drag: section.drag,
                added_mass: section.added_mass,
                label: ElementLabel { nodes: [n1, n2], material, geometry },
            });
        }
    }
    TetherLine::new(elements)
}

/// The case of a model.
///
/// # Errors
/// No tether; an action that a run of tethers cannot do; a towed one with another; installed ones of several bodies, or between bodies; what the environment or the model has that
/// does not run with tethers.
pub fn case(model: &Model, actions: &[Action], settings: &TetherRunSettings) -> Result<TetherCase, SolveError> {
    let of = |c: &&Connector| c.active && !sections(model, c).is_empty();
    let tethers: Vec<&Connector> = model.connectors.values().filter(of).collect();
    let Some(first) = tethers.first() else {
        let error = ClassError::new("the model has no tether that acts");
        return Err(SolveError::new(error.help("a connector of class type TETHER is one")));
    };
    let is_towed = |c: &Connector| c.tether.as_ref().is_some_and(|t| t.used == TetherUse::Towed);
    let sea = Sea::new(model, &model.environment).map_err(SolveError::new)?.map(Arc::new);
    let seed = sea.as_ref().and_then(|s| s.seed);
    let mut notes = Vec::new();
    for (given, name) in
        [(model.environment.current_history.is_some(), "-C_HISTORY"), (model.environment.growth.is_some(), "-M_GROWTH")]
    {
        if given {
            notes.push(format!("{name} does not act on tethers"));
        }
    }
    if let Some(towed) = tethers.iter().find(|c| is_towed(c)) {
        if tethers.len() > 1 {
            let error = ClassError::new("a towed tether runs alone: the model has other tethers");
            return Err(SolveError { who: Some(towed.name.clone()), error: error.with_span(towed.span) });
        }
        refuse_any(actions)?;
        let made = towed_case(model, first, sea.as_deref(), settings, &mut notes);
        let made = made.map_err(|error| SolveError { who: Some(first.name.clone()), error })?;
        let made = TowedCase { name: first.name.clone(), tether: made, vessel: towing_vessel(model, first) };
        return Ok(TetherCase { kind: TetherCaseKind::Towed(Box::new(made)), seed, notes });
    }
    let made = installed_case(model, &tethers, sea.as_ref(), (settings, actions), &mut notes)?;
    Ok(TetherCase { kind: TetherCaseKind::Installed(Box::new(made)), seed, notes })
}

fn current(model: &Model) -> Result<CurrentField, ClassError> {
    let around = model.surroundings();
    CurrentField::new(model, &model.environment, around.depth.map(|d| d + around.tide))
}

fn towed_case(
    model: &Model,
    connector: &Connector,
    sea: Option<&Sea>,
    settings: &TetherRunSettings,
    notes: &mut Vec<String>,
) -> Result<Towed, ClassError> {
    let ends = connector.tether.clone().unwrap_or_default();
    let [vessel, trailing] = model.end_poses(connector).map(|pose| pose.origin);
    let around = model.surroundings();
    let chord = vessel - trailing;
    if (chord.x == 0.0 && chord.y == 0.0) || chord.z.abs() > 1e-6 * chord.norm() {
        let error =
            ClassError::new("the axis of a towed tether lies level: its vessel and its trailing end are at one height");
        return Err(error.with_span(connector.span));
    }
    let line = line(sections(model, connector))?;
    if (chord.norm() / line.length() - 1.0).abs() > 1e-3 {
        notes.push(format!(
            "tether {}: its ends are {:.3} m apart and its elements {:.3} m long together: the elements count, from the trailing end",
            connector.name,
            chord.norm(),
            line.length()
        ));
    }
    if let Some(sea) = sea.filter(|s| s.ramp > 0.0) {
        notes.push(format!("waves act on a towed tether from the start: the ramp of {} s is left out", sea.ramp));
    }
    let [at_vessel, at_trailing] = ends.springs_in_force().map(|[along, y, z]| EndSpring { along, y, z });
    let field = current(model)?;
    let current = if field.is_none() {
        Vec::new()
    } else {
        let mut depths = field.kinks();
        depths.push(0.0);
        depths.retain(|d| d.is_finite() && *d >= 0.0);
        depths.sort_by(f64::total_cmp);
        depths.dedup();
        let at = |d: f64| field.at_depth(d).0;
        depths.into_iter().map(|d| (-d, [at(d).x, at(d).y])).collect()
    };
    let made = Towed {
        line,
        origin: [trailing.x, trailing.y, trailing.z - around.tide],
        heading: chord.y.atan2(chord.x),
        springs: [at_trailing, at_vessel],
        density: around.water_density,
        gravity: around.gravity,
        depth: around.depth.map(|d| d + around.tide),
        waves: sea.map(|s| s.components.clone()).unwrap_or_default(),
        stokes: sea.and_then(|s| s.stokes),
        current,
        tow: settings.tow,
        multipliers: towed::WaterForceMultipliers { slam: settings.slam, ..towed::WaterForceMultipliers::default() },
        compatibility: if settings.compatible {
            towed::TowedCompatibility::aqwa_5_4()
        } else {
            towed::TowedCompatibility::native()
        },
    };
    made.check()?;
    notes.extend(made.warnings());
    notes.extend(warn_of_fast_modes(&connector.name, made.count_fast_modes()?));
    Ok(made)
}

/// The body at the vessel's end of a towed tether.
fn towing_vessel(model: &Model, connector: &Connector) -> Option<TowingVessel> {
    let body = model.body_of(model.points.get(&Model::key(connector.points.first()?))?)?;
    let gravity = model.defaults.gravity;
    let mass = Mass::from_parts(model.parts_of(body), gravity);
    let pose = Pose::from_place(&body.position);
    let centre = pose.point(mass.centre);
    let [end, _] = model.end_poses(connector).map(|pose| pose.origin);
    let position = Place { shift: centre.into(), turn: body.position.turn };
    Some(TowingVessel { body: body.name.clone(), position, weight: mass.mass * gravity, arm: end - centre })
}

/// The body that all installed tethers hold.
fn tethered_body<'a>(model: &'a Model, tethers: &[&Connector]) -> Result<&'a Body, SolveError> {
    let body_of = |connector: &Connector, end: usize| {
        let name = connector.points.get(end)?;
        model.body_of(model.points.get(&Model::key(name))?)
    };
    let mut found: Option<&Body> = None;
    for connector in tethers {
        let refused = |text: String| {
            Err(SolveError {
                who: Some(connector.name.clone()),
                error: ClassError::new(text).with_span(connector.span),
            })
        };
        let Some(body) = body_of(connector, 0) else {
            return refused(
                "the first point of an installed tether is on the structure; this one is in the ground".into(),
            );
        };
        if body_of(connector, 1).is_some() {
            return refused("the second point of an installed tether is its anchor in the ground".into());
        }
        if found.is_some_and(|other| other.name != body.name) {
            let other = found.map_or("", |b| b.name.as_str());
            return refused(format!(
                "installed tethers run with one structure, and these hold {other} and {}",
                body.name
            ));
        }
        found = Some(body);
    }
    found.ok_or_else(|| SolveError::new(ClassError::new("no tether holds a body")))
}

fn constraint(node: usize, hold: TetherHold) -> NodeConstraint {
    let node = node.saturating_sub(1);
    match hold {
        TetherHold::LateralFixed => NodeConstraint::FixedLateral { node },
        TetherHold::RotationalFixed => NodeConstraint::FixedRotation { node },
        TetherHold::LateralVessel { gap } => NodeConstraint::VesselLateral { node, gap },
        TetherHold::RotationalVessel => NodeConstraint::VesselRotation { node },
    }
}

/// An installed tether of the engine; `centre` is the centre of gravity in the axes of its body.
pub(super) fn installed_tether(
    model: &Model,
    connector: &Connector,
    body: &Body,
    centre: Vector3<f64>,
    notes: &mut Vec<String>,
) -> Result<InstalledTether, ClassError> {
    let ends: TetherEnds = connector.tether.clone().unwrap_or_default();
    let [fairlead, anchor] = model.end_poses(connector).map(|pose| pose.origin);
    let attachment = Pose::from_place(&body.position).local(fairlead) - centre;
    let line = line(sections(model, connector))?;
    let mut springs = [EndSprings::default(); 2];
    for ((into, given), position) in springs.iter_mut().zip(ends.springs).zip(["vessel", "anchor"]) {
        let (made, taken) = EndSprings::from_card(given);
        *into = made;
        for taken in &taken {
            let text = format!(", {position}: {}", taken.text());
            // one note for all tethers that have it
            match notes.iter_mut().find(|note| note.starts_with("tether ") && note.ends_with(&text)) {
                Some(note) => note.insert_str(note.len() - text.len(), &format!(" {}", connector.name)),
                None => notes.push(format!("tether {}{text}", connector.name)),
            }
        }
    }
    let [vessel_springs, anchor_springs] = springs;
    let [cap_vessel, cap_anchor] = ends.caps;
    let [pressure, density] = ends.fluid;
    let made = InstalledTether {
        anchor_springs,
        vessel_springs,
        caps: [cap_anchor, cap_vessel],
        fluid: InternalFluid { pressure, density },
        impact: ends.impact.map(|[factor, half_life]| Impact { factor, half_life }),
        lower_stop: ends.low_stop,
        group: ends.count(),
        constraints: ends.constraints.iter().map(|c| constraint(c.node, c.hold)).collect(),
        ..InstalledTether::new(connector.name.clone(), line, anchor, attachment)
    };
    made.check()?;
    Ok(made)
}

/// The members of a body when it has nothing else that water or wind acts on; in axes of the body from its centre of gravity.
fn tubes_alone(model: &Model, body: &Body, centre: Vector3<f64>) -> Option<Vec<TubeMember>> {
    if body.linear.is_some() || body.database.is_some() {
        return None;
    }
    let mut tubes = Vec::new();
    for part in model.parts_of(body) {
        if model.loads.iter().any(|load| load.part.eq_ignore_ascii_case(&part.name)) {
            return None;
        }
        for piece in &part.pieces {
            let (Some(member), Shape::Tube { ends, diameter }) =
                (piece.member, piece.shape.with_displacement(&part.position))
            else {
                return None;
            };
            let attributes = [Attribute::Buoyancy, Attribute::Drag, Attribute::AddedMass, Attribute::Wind];
            let is_scaled = attributes.iter().any(|a| model.member_factor(&part.name, piece, *a) != 1.0);
            if is_scaled || piece.permeability != 1.0 {
                return None;
            }
            tubes.push(TubeMember {
                ends: ends.map(|end| Vector3::from(end) - centre),
                diameter,
                drag: member.drag,
                added: member.added,
                friction: member.friction,
            });
        }
    }
    (!tubes.is_empty()).then_some(tubes)
}

/// The waves as AQWA has them: a regular one in deep water, of the second order if it is a STOKES wave.
fn deep_wave(model: &Model) -> Option<Result<DeepWave, ClassError>> {
    let sea = model.environment.sea.as_ref()?;
    if !is_regular(sea) {
        return None;
    }
    let wave = DeepWave::new(0.5 * sea.height, sea.period, sea.direction + PI, model.defaults.gravity);
    Some(wave.map(|wave| DeepWave { second: is_stokes(sea), ..wave }))
}

fn installed_case(
    model: &Model,
    tethers: &[&Connector],
    sea: Option<&Arc<Sea>>,
    (settings, actions): (&TetherRunSettings, &[Action]),
    notes: &mut Vec<String>,
) -> Result<Installed, SolveError> {
    let body = tethered_body(model, tethers)?;
    let of_body = |error: ClassError| SolveError { who: Some(body.name.clone()), error };
    let gravity = model.defaults.gravity;
    let mass = Mass::from_parts(model.parts_of(body), gravity);
    let centre = mass.centre;
    let mut list = Vec::new();
    for connector in tethers {
        let made = installed_tether(model, connector, body, centre, notes);
        list.push(made.map_err(|error| SolveError { who: Some(connector.name.clone()), error })?);
    }
    let around = model.surroundings();
    let mut flow = WaterFlow::still_water(around.water_density, gravity).map_err(SolveError::new)?;
    flow.level = around.tide;
    flow.current = current(model).map_err(SolveError::new)?;
    if let Some(sea) = sea {
        let deep = if settings.compatible { deep_wave(model) } else { None };
        flow.waves = match deep {
            Some(wave) => FlowWaves::Deep(wave.map_err(SolveError::new)?),
            None => FlowWaves::Sea(Arc::clone(sea)),
        };
    }
    let compatibility = if settings.compatible { Compatibility::aqwa_5_4() } else { Compatibility::native() };
    let alone = settings.compatible.then(|| tubes_alone(model, body, centre)).flatten();
    let structure: Box<dyn Structure> = match alone {
        Some(tubes) => {
            let own = mass.inertia_about(centre);
            Box::new(Tubes::new(mass.mass, own, tubes, compatibility).map_err(of_body)?)
        }
        None => {
            if settings.compatible {
                notes.push(format!(
                    "{} has more than members: its loads are windlass's own, not as AQWA has them",
                    body.name
                ));
            }
            let floating = Floating::under_way(model, body, sea).map_err(of_body)?;
            Box::new(Afloat::new(floating).map_err(of_body)?)
        }
    };
    let structure = Moored::build(structure, model, (body, centre), actions)?;
    let pose = Pose::from_place(&body.position);
    let course = InstalledRunSettings {
        start: settings.start,
        step: settings.step,
        states: settings.states(),
        pose: Pose { origin: pose.point(centre), axes: pose.axes },
        velocity: Six::zeros(),
    };
    for tether in &list {
        let attachment = course.pose.point(tether.attachment);
        // one that is too short for its span has an error of its own in the run
        let fast = count_fast_modes(tether, attachment, &flow, &compatibility).unwrap_or(0);
        notes.extend(warn_of_fast_modes(&tether.name, fast));
    }
    let points = model.points.values().filter(|p| model.body_of(p).is_some_and(|b| b.name == body.name));
    let points = points.map(|p| (p.name.clone(), pose.local(Vector3::from(model.global(p))) - centre)).collect();
    Ok(Installed { body: body.name.clone(), structure, tethers: list, flow, compatibility, course, centre, points })
}
