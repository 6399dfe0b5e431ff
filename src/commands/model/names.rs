//! `DELETE` and `RENAME`: of anything in the model that has a name.

use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome, suggest};
use windlass_base::span::Span;
use windlass_base::values::Content;
use windlass_base::values::Noun;
use windlass_base::wildcard::{is_wild, matches};
use windlass_language::name;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, ValueSpec};
use windlass_model::{AssemblyKind, Compartment, EntityKind, Model, Piece};

/// DELETE.
pub static DELETE: Command = Command { spec: &DELETE_SPEC, edits: true, run: delete };
/// RENAME.
pub static RENAME: Command = Command { spec: &RENAME_SPEC, edits: false, run: rename };

static DELETE_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[ValueSpec::new("NAME", Kind::Name(Noun::Selector), "what to delete; wild characters may be used")],
    repeat: 1,
    detail: "Names are those of connectors, classes, points, assemblies, parts, bodies, pieces, curves, bathymetries, T_PRESSURE data, environments and selectors; a name \
             means one thing, since all but classes, points and selectors have different names. A \
             body goes with its parts, points, weights and pieces. An assembly goes with its hook, and its connectors have a single node again. What is still used is not deleted: a class or point by a connector, a connector by an assembly, a curve by \
             a class or an environment (also by the one in force), a bathymetry or T_PRESSURE data by an environment, a selector by another. With one name that is refused \
             nothing is deleted.",
    example: "MEDIT\n*P 0 0 0\nDELETE *P\nEND",
    ..CommandSpec::new("DELETE", "deletes things from the model")
};

static RENAME_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[
        ValueSpec::new("OLD", Kind::Name(Noun::Selector), "present name"),
        ValueSpec::new("NEW", Kind::Name(Noun::Selector), "new name, with the same marker"),
    ],
    detail: "What refers to the thing by its name follows: connectors, parts, points, selectors. A selector's pattern with \
             wild characters stays as it is. &HELP alone says what a name may be.",
    example: "MEDIT\n*P 0 0 0\nRENAME *P *Q\nEND",
    ..CommandSpec::new("RENAME", "renames a connector, class, point, body or assembly")
};

fn delete(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let mut deleted = Vec::new();
    for value in &call.args.data {
        let Some(pattern) = value.word() else { continue };
        let fits = |name: &str| name.eq_ignore_ascii_case(pattern) || (is_wild(pattern) && matches(pattern, name));
        let all = job.model.things();
        let chosen: Vec<(EntityKind, String)> =
            all.iter().filter(|(_, name)| fits(name)).map(|(thing, name)| (*thing, name.to_string())).collect();
        if chosen.is_empty() {
            let mut error = Diagnostic::error(format!("nothing is called {pattern}"), value.span);
            error.help.extend(suggest(pattern, all.iter().map(|(_, name)| *name)));
            return Err(error);
        }
        for (thing, name) in &chosen {
            let stays = |user: &&str| !chosen.iter().any(|(_, other)| other == user);
            if let Some(user) = job.model.users(*thing, name).into_iter().find(stays) {
                let text = format!("{name} is used by {user} and is not deleted");
                return Err(Diagnostic::error(text, value.span));
            }
        }
        for (thing, name) in chosen {
            remove(&mut job.model, thing, &name);
            deleted.push((thing, name, value.span));
        }
    }
    for (thing, name, span) in deleted {
        job.remark(format!("{} {name} is deleted", thing.word()), span);
    }
    Ok(Effect::Done)
}

/// Takes one thing out of the model, a body with its parts and points.
fn remove(model: &mut Model, thing: EntityKind, name: &str) {
    let key = Model::key(name);
    match thing {
        EntityKind::Connector => drop(model.connectors.shift_remove(&key)),
        EntityKind::Class => drop(model.classes.shift_remove(&key)),
        EntityKind::Point => drop(model.points.shift_remove(&key)),
        EntityKind::Environment => drop(model.environments.shift_remove(&key)),
        EntityKind::Curve => drop(model.curves.shift_remove(&key)),
        EntityKind::Bathymetry => drop(model.bathymetries.shift_remove(&key)),
        EntityKind::Filling => drop(model.fillings.shift_remove(&key)),
        EntityKind::DraftMark => drop(model.draft_marks.shift_remove(&key)),
        EntityKind::Selector => drop(model.selectors.shift_remove(&key)),
        EntityKind::Part => {
            model.loads.retain(|l| Model::key(&l.part) != key);
            model.multipliers.parts.shift_remove(&key);
            model.parts.shift_remove(&key);
        }
        EntityKind::Piece => {
            // an element goes whole, with its weight
            let element = model.piece(name).and_then(|(_, piece)| piece.element.clone());
            if let Some(element) = element {
                model.remove_element(&element.name);
                return;
            }
            let other = |piece: &Piece| !piece.name.eq_ignore_ascii_case(name);
            model.parts.values_mut().for_each(|part| part.pieces.retain(other));
        }
        EntityKind::Compartment => {
            remove_compartments(model, |c| Model::key(&c.name) == key);
        }
        EntityKind::Assembly => model.take_apart(name),
        EntityKind::Body => {
            let parts = &model.parts;
            let own = |part: &str| parts.get(&Model::key(part)).is_some_and(|p| Model::key(&p.body) == key);
            let tanks: Vec<String> =
                model.compartments.values().filter(|c| own(&c.part)).map(|c| c.name.clone()).collect();
            model.points.retain(|_, p| !own(&p.part));
            let points = &model.points;
            model.draft_marks.retain(|_, mark| mark.points.iter().all(|p| points.contains_key(&Model::key(p))));
            model.loads.retain(|l| !own(&l.part));
            model.multipliers.parts.retain(|part, _| !own(part));
            model.parts.retain(|_, p| Model::key(&p.body) != key);
            model.bodies.shift_remove(&key);
            remove_compartments(model, |c| tanks.contains(&c.name));
        }
    }
    if model.current_part.as_ref().is_some_and(|p| !model.parts.contains_key(&Model::key(p))) {
        model.current_part = None;
    }
    if model.current_piece.as_ref().is_some_and(|piece| model.piece(piece).is_none()) {
        model.current_piece = None;
    }
}

/// Takes compartments out of the model with their pieces.
fn remove_compartments(model: &mut Model, goes: impl Fn(&Compartment) -> bool) {
    let names: Vec<String> = model.compartments.values().filter(|c| goes(c)).map(|c| c.name.clone()).collect();
    let own = |piece: &Piece| {
        piece.compartment.as_ref().is_some_and(|of| names.iter().any(|name| name.eq_ignore_ascii_case(of)))
    };
    model.parts.values_mut().for_each(|part| part.pieces.retain(|piece| !own(piece)));
    model.compartments.retain(|_, c| !names.contains(&c.name));
    if model.current_compartment.as_ref().is_some_and(|c| !model.compartments.contains_key(&Model::key(c))) {
        model.current_compartment = None;
    }
}

fn rename(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const OLD: DatumKey<str> = RENAME_SPEC.word("OLD");
    const NEW: DatumKey<str> = RENAME_SPEC.word("NEW");
    let [(old, span), (new, position)] =
        [OLD, NEW].map(|key| (call.args.word(key).unwrap_or_default(), call.args.position(key)));
    let model = &mut job.model;
    let known = model.things();
    let renamed = |t: &EntityKind| {
        matches!(
            t,
            EntityKind::Connector | EntityKind::Class | EntityKind::Point | EntityKind::Body | EntityKind::Assembly
        )
    };
    let found = known.iter().find(|(t, name)| renamed(t) && name.eq_ignore_ascii_case(old)).map(|(t, _)| *t);
    if name::marker(old) != name::marker(new) {
        return Err(Diagnostic::error("the new name must have the same marker as the old one", position));
    }
    let Some(thing) = found else {
        let mut error =
            Diagnostic::error(format!("no connector, class, point, body or assembly is called {old}"), span);
        error.help.extend(suggest(old, known.iter().filter(|(t, _)| renamed(t)).map(|(_, name)| *name)));
        return Err(error);
    };
    name::check(new, name::marker(old), thing.word(), position)?;
    check_name_free(model, new, position)?;
    if thing == EntityKind::Assembly {
        check_name_free(model, &format!("*{new}"), position)?;
    }
    let (from, to) = (Model::key(old), Model::key(new));
    let follow = |name: &mut String| {
        if Model::key(name) == from {
            *name = new.to_string();
        }
    };
    match thing {
        EntityKind::Connector => {
            move_entry(&mut model.connectors, &from, to, |c| c.name = new.to_string());
            model.assemblies.values_mut().flat_map(|a| a.members_mut()).for_each(follow);
        }
        EntityKind::Class => {
            move_entry(&mut model.classes, &from, to, |c| c.name = new.to_string());
            model.connectors.values_mut().for_each(|c| follow(&mut c.class));
            let pieces = model.parts.values_mut().flat_map(|part| &mut part.pieces);
            pieces.filter_map(|piece| piece.element.as_mut()).for_each(|element| follow(&mut element.class));
            for assembly in model.assemblies.values_mut() {
                if let AssemblyKind::Pipe { class, .. } = &mut assembly.kind {
                    follow(class);
                }
            }
        }
        EntityKind::Point => {
            move_entry(&mut model.points, &from, to, |p| p.name = new.to_string());
            model.connectors.values_mut().flat_map(|c| c.points.iter_mut()).for_each(follow);
            model.draft_marks.values_mut().flat_map(|m| m.points.iter_mut()).for_each(follow);
        }
        sort => {
            if sort == EntityKind::Assembly {
                hook_renamed(model, &from, &to, new);
            }
            move_entry(&mut model.bodies, &from, to.clone(), |b| b.name = new.to_string());
            model.parts.values_mut().for_each(|p| follow(&mut p.body));
            move_entry(&mut model.parts, &from, to.clone(), |p| p.name = new.to_string());
            model.points.values_mut().for_each(|p| follow(&mut p.part));
            model.loads.iter_mut().for_each(|l| follow(&mut l.part));
            if let Some(factor) = model.multipliers.parts.shift_remove(&from) {
                model.multipliers.parts.insert(to.clone(), factor);
            }
            model.current_part.iter_mut().for_each(follow);
        }
    }
    model.selectors.values_mut().flat_map(|s| s.select.iter_mut().chain(&mut s.except)).for_each(follow);
    // CONNECTOR records of an open INMODEL name their class and points
    let waiting = job.deferred.iter_mut().chain(&mut job.deferred_assemblies);
    for value in waiting.flat_map(|args| args.data.iter_mut().skip(1)) {
        if value.word().is_some_and(|word| Model::key(word) == from) {
            value.content = Content::Word(Arc::from(new));
        }
    }
    job.remark(format!("{} {old} is now {new}", thing.word()), span);
    Ok(Effect::Done)
}

/// Gives an assembly and the point of its hook a new name.
fn hook_renamed(model: &mut Model, from: &str, to: &str, new: &str) {
    let (old_point, point) = (format!("*{from}"), format!("*{new}"));
    move_entry(&mut model.assemblies, from, to.to_string(), |a| a.name = new.to_string());
    move_entry(&mut model.points, &old_point, Model::key(&point), |p| p.name = point.clone());
    for name in model.connectors.values_mut().flat_map(|c| c.points.iter_mut()) {
        if Model::key(name) == old_point {
            *name = point.clone();
        }
    }
}

/// Sees that nothing has a name yet.
fn check_name_free(model: &Model, new: &str, position: Span) -> Outcome<()> {
    match EntityKind::ALL.into_iter().find_map(|thing| model.definition_span(thing, new)) {
        Some(span) => Err(Diagnostic::error(format!("{new} exists already"), position).other(span, "defined here")),
        None => Ok(()),
    }
}

/// Gives an entry a new key at its old place.
fn move_entry<T>(table: &mut indexmap::IndexMap<String, T>, from: &str, to: String, change: impl FnOnce(&mut T)) {
    if let Some((index, _, mut entry)) = table.shift_remove_full(from) {
        change(&mut entry);
        table.shift_insert(index, to, entry);
    }
}
