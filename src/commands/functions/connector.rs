//! `&CONNECTOR` and `&ELEMENT`: connectors and members as they are, and what connectors exert between their ends.
//!
//! Source: [MOSES-REF ele] for the actions of `&ELEMENT`; those of `&CONNECTOR` are our reading. Forces are those of `&STATUS F_CONNECTOR`.

use super::{numbers, pick};
use crate::commands::Job;
use crate::commands::status::forces::{ConnectorForces, find_forces};
use nalgebra::Vector3;
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome, suggest};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_language::record::Word;
use windlass_model::{Attribute, Connector, EntityKind, Model, Part, Piece, Shape, Weight, find};

choices! {
    /// What `&CONNECTOR` gives.
    enum ConnectorAction {
        Class = "CLASS",
        Points = "POINTS",
        Status = "STATUS",
        Anchor = "ANCHOR",
        Length = "LENGTH",
        Force = "FORCE",
        Tension = "TENSION",
        Ratio = "RATIO",
        Horizontal = "HORIZONTAL",
        Distance = "DISTANCE",
        OnBottom = "ON_BOTTOM",
    }
}

choices! {
    /// What `&ELEMENT` gives.
    enum ElementAction {
        Nodes = "EN_NODES",
        Class = "CLASS",
        Category = "CATEGORY",
        ElementType = "ELE_TYPE",
        Weight = "WEIGHT",
        Buoyancy = "BUOYANCY",
        Cosines = "DCOSINES",
        Length = "LENGTH",
        SegmentLengths = "SEG_LENG",
        Ratio = "RATIO",
        Stress = "STRESS",
        Damage = "CDR",
    }
}

/// What a connector that acts exerts; `None` of one that is inactive.
fn solve(job: &Job, connector: &Connector, span: Span) -> Outcome<Option<ConnectorForces>> {
    let model = &job.model;
    if !connector.active {
        return Ok(None);
    }
    if model.holds_pipe(&connector.name) {
        return Err(Diagnostic::error(format!("{} holds a pipe, which has the forces", connector.name), span)
            .help("&STATUS ASSEMBLIES reports them"));
    }
    find_forces(model, connector).map(Some).map_err(|mut error| {
        error.message = error.message.with_subject(format!("connector {}", connector.name));
        error.diagnostic(span, job.units)
    })
}

/// The value of `&CONNECTOR(ACTION rest)`.
pub(super) fn connector(job: &Job, action: &Word, rest: &[Word], span: Span) -> Outcome<String> {
    let action: ConnectorAction = pick(action, "CONNECTOR")?;
    let Some(name) = rest.first() else { return Err(Diagnostic::error("&CONNECTOR lacks the connector's name", span)) };
    let found = find(&job.model.connectors, &name.text, "connector", name.span)?;
    let one = |value: Option<f64>, dim: Dim| value.map_or(String::new(), |v| numbers(&[v], dim, job));
    let forces = || solve(job, found, name.span);
    Ok(match action {
        ConnectorAction::Class => found.class.clone(),
        ConnectorAction::Points => found.points.join(" "),
        ConnectorAction::Status => if found.active { "ACTIVE" } else { "INACTIVE" }.into(),
        ConnectorAction::Anchor => found.anchor.map_or(String::new(), |a| numbers(&a.at, Dim::Length, job)),
        ConnectorAction::Length => one(job.model.first_length(found), Dim::Length),
        ConnectorAction::Force => {
            let force = forces()?.map_or([0.0; 3], |f| f.on_body());
            let size = Vector3::from(force).norm();
            format!("{} {}", numbers(&force, Dim::Force, job), numbers(&[size], Dim::Force, job))
        }
        ConnectorAction::Tension => one(forces()?.map_or(Some(0.0), |f| f.summary.tension), Dim::Force),
        ConnectorAction::Ratio => one(forces()?.map_or(Some(0.0), |f| f.summary.ratio), Dim::None),
        ConnectorAction::Horizontal => {
            let [x, y, _] = forces()?.map_or([0.0; 3], |f| f.on_body());
            numbers(&[x.hypot(y)], Dim::Force, job)
        }
        ConnectorAction::Distance => {
            let [first, second] = job.model.end_poses(found).map(|p| p.origin);
            numbers(&[(second - first).xy().norm()], Dim::Length, job)
        }
        ConnectorAction::OnBottom => one(forces()?.and_then(|f| f.summary.grounded), Dim::Length),
    })
}

/// What `&ELEMENT` is asked about.
enum ElementSubject<'m> {
    Connector(&'m Connector),
    /// A BEAM, a PLATE or a tube of a hull: its part, its pieces in order, and the class of its section.
    Member(&'m Part, Vec<&'m Piece>, Option<&'m str>),
}

fn find_element<'m>(model: &'m Model, name: &Word) -> Outcome<ElementSubject<'m>> {
    if let Some(connector) = model.connectors.get(&Model::key(&name.text)) {
        return Ok(ElementSubject::Connector(connector));
    }
    if let Some((part, piece)) = model.piece(&name.text) {
        let of = |piece: &&Piece| piece.element.as_ref().is_some_and(|e| Model::key(&e.name) == Model::key(&name.text));
        if let Some(element) = piece.element.as_ref().filter(|_| of(&piece)) {
            return Ok(ElementSubject::Member(part, part.pieces.iter().filter(of).collect(), Some(&element.class)));
        }
        if matches!(piece.shape, Shape::Tube { .. }) {
            return Ok(ElementSubject::Member(part, vec![piece], None));
        }
    }
    let mut error = Diagnostic::error(format!("unknown element {}", name.text), name.span);
    let known = [EntityKind::Connector, EntityKind::Piece].into_iter().flat_map(|kind| model.names(kind));
    error.help.extend(suggest(&name.text, known));
    error.help.push("the elements of windlass are its connectors, BEAMs, PLATEs and the tubes of its hulls".into());
    Err(error)
}

/// The value of `&ELEMENT(ACTION rest)`.
pub(super) fn element(job: &Job, action: &Word, rest: &[Word], span: Span) -> Outcome<String> {
    let asked: ElementAction = pick(action, "ELEMENT")?;
    let Some(name) = rest.first() else { return Err(Diagnostic::error("&ELEMENT lacks the element's name", span)) };
    let model = &job.model;
    let absent = |why: &str| {
        let text = format!("&ELEMENT({} {}) has no value: {why}", asked.word(), name.text);
        Err(Diagnostic::error(text, action.span))
    };
    let unit = |from: [f64; 3], to: [f64; 3]| {
        let way = Vector3::from(to) - Vector3::from(from);
        way.try_normalize(0.0).map_or(String::new(), |way| numbers(way.as_slice(), Dim::None, job))
    };
    match (find_element(model, name)?, asked) {
        (_, ElementAction::Stress | ElementAction::Damage) => absent("windlass makes no stress analysis"),
        (ElementSubject::Connector(found), ElementAction::Nodes) => Ok(found.points.join(" ")),
        (ElementSubject::Connector(found), ElementAction::Class) => Ok(found.class.clone()),
        (ElementSubject::Connector(found), ElementAction::ElementType) => {
            let class = find(&model.classes, &found.class, "class", name.span)?;
            Ok(class.object.kind().to_string())
        }
        (ElementSubject::Connector(found), ElementAction::Length) => {
            let [first, second] = model.end_poses(found).map(|p| p.origin);
            Ok(numbers(&[(second - first).norm()], Dim::Length, job))
        }
        (ElementSubject::Connector(found), ElementAction::Cosines) => {
            let [first, second] = model.end_poses(found).map(|p| p.origin.into());
            Ok(unit(first, second))
        }
        (ElementSubject::Connector(found), ElementAction::Ratio) => {
            let ratio = solve(job, found, name.span)?.map_or(Some(0.0), |f| f.summary.ratio);
            Ok(ratio.map_or(String::new(), |r| numbers(&[r], Dim::None, job)))
        }
        (ElementSubject::Connector(_), ElementAction::Category) => absent("connectors belong to no category"),
        (
            ElementSubject::Connector(_),
            ElementAction::Weight | ElementAction::Buoyancy | ElementAction::SegmentLengths,
        ) => absent("weights, buoyancies and lengths of segments are those of its class: &STATUS CL_FLEX"),
        (ElementSubject::Member(_, pieces, _), ElementAction::Length) => {
            let lengths = pieces.iter().filter_map(|piece| member_ends(piece)).map(|[a, b]| (b - a).norm());
            Ok(numbers(&[lengths.sum()], Dim::Length, job))
        }
        (ElementSubject::Member(_, pieces, _), ElementAction::Cosines) => {
            let [first, last] = [pieces.first(), pieces.last()].map(|piece| piece.and_then(|p| member_ends(p)));
            Ok(first.zip(last).map_or(String::new(), |([a, _], [_, b])| unit(a.into(), b.into())))
        }
        (ElementSubject::Member(part, pieces, _), ElementAction::Buoyancy) => {
            let volumes = pieces.iter().filter_map(|piece| {
                let share = piece.permeability * model.member_factor(&part.name, piece, Attribute::Buoyancy);
                Some(piece.shape.member_volume()?.1 * share)
            });
            Ok(numbers(&[volumes.sum::<f64>() * model.surroundings().water_weight()], Dim::Force, job))
        }
        (ElementSubject::Member(part, _, Some(_)), ElementAction::Weight) => {
            let own = |weight: &&Weight| weight.element.as_deref().is_some_and(|e| e.eq_ignore_ascii_case(&name.text));
            let weights = part.weights.iter().filter(own).map(|weight| weight.weight * weight.multiplier);
            Ok(numbers(&[weights.sum()], Dim::Force, job))
        }
        (ElementSubject::Member(_, _, Some(class)), ElementAction::Class) => Ok(class.to_string()),
        (ElementSubject::Member(_, pieces, _), ElementAction::Category) => {
            Ok(pieces.first().and_then(|piece| piece.category.clone()).unwrap_or_default())
        }
        (ElementSubject::Member(_, pieces, class), ElementAction::ElementType) => {
            let is_plate = class.and_then(|class| model.classes.get(&Model::key(class)));
            let is_plate = is_plate.and_then(|class| class.object.as_members()?.first().map(|s| s.kind == "PLATE"));
            let tube = pieces.first().is_some_and(|piece| matches!(piece.shape, Shape::Tube { .. }));
            Ok(match is_plate {
                Some(true) => "PLATE",
                Some(false) => "BEAM",
                None if tube => "TUBE",
                None => "",
            }
            .into())
        }
        (ElementSubject::Member(_, _, Some(_)), _) => absent("nodes and stresses of members are not kept"),
        (ElementSubject::Member(_, _, None), _) => {
            absent("a tube of a hull has neither class, nodes, weight nor stress")
        }
    }
}

/// The ends of a tube or a bar in its part (m).
fn member_ends(piece: &Piece) -> Option<[Vector3<f64>; 2]> {
    match &piece.shape {
        Shape::Tube { ends, .. } | Shape::Bar { ends, .. } => Some(ends.map(Vector3::from)),
        Shape::Panels(_) | Shape::Block { .. } => None,
    }
}
