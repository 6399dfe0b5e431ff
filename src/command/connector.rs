//! `CONNECTOR`, and the deletion and renaming of anything in the model.

use super::{Call, Command, Effect, Job, Menu};
use crate::language::args::Args;
use crate::language::diagnostic::{Diagnostic, Outcome, did_you_mean};
use crate::language::select::{Owner, is_wild, matches};
use crate::language::source::Span;
use crate::language::spec::{CommandSpec, Kind, Noun, OptionSpec, ValueSpec};
use crate::language::units::Dim;
use crate::model::{Anchor, Connector, Model, find, unit_vector};

/// CONNECTOR.
pub static CONNECTOR: Command = Command { spec: &CONNECTOR_SPEC, edits: false, run: connector };
/// DELETE.
pub static DELETE: Command = Command { spec: &DELETE_SPEC, edits: true, run: delete };
/// RENAME.
pub static RENAME: Command = Command { spec: &RENAME_SPEC, edits: false, run: rename };

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}
const OFFSET: &[ValueSpec] =
    &[number("X", Dim::Length, "offset"), number("Y", Dim::Length, "offset"), number("Z", Dim::Length, "offset")];

static CONNECTOR_SPEC: CommandSpec = CommandSpec {
    menus: &["INMODEL", "MEDIT"],
    data: &[
        ValueSpec::new("NAME", Kind::Name(Noun::New), "name of the connector"),
        ValueSpec::new("~CLASS", Kind::Name(Noun::Class), "its class"),
        ValueSpec::new("*N1", Kind::Name(Noun::Point), "its first point: the fairlead"),
        ValueSpec::new("*N2", Kind::Name(Noun::Point), "its second point").or("ground"),
    ],
    options: &[
        OptionSpec::new(
            "-ANCHOR",
            &[
                number("THET", Dim::Angle, "direction from the fairlead, from +X toward +Y"),
                number("DTA", Dim::Length, "horizontal distance from fairlead to anchor").not_negative(),
            ],
            "where the anchor lies, in the present configuration",
        ),
        OptionSpec::new("-GO1", OFFSET, "offset of the first end from its point"),
        OptionSpec::new("-GO2", OFFSET, "offset of the second end from its point"),
        OptionSpec::new(
            "-EULER",
            &[
                number("RX", Dim::Angle, "about X"),
                number("RY", Dim::Angle, "about Y"),
                number("RZ", Dim::Angle, "about Z"),
            ],
            "angles of the element axes",
        )
        .default("body axes of the first node"),
    ],
    detail: "With one point the other end is ground. In INMODEL the names may be defined later.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*MLA 400 50 20\n~WIRE b_cat 4.19 -DEP 500 -LEN 4000 -BUOY 0 -WTPL .0125\n\
              CONNECTOR A -ANC -45 20 ~WIRE *MLA\nEND\n&STATUS G_CONNECTOR",
    ..CommandSpec::new("CONNECTOR", "connects a point to ground or two points")
};

static DELETE_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &["INMODEL", "MEDIT"],
    data: &[ValueSpec::new("NAME", Kind::Name(Noun::Selector), "what to delete; wild characters may be used")],
    repeat: 1,
    detail: "Names are those of connectors, classes, points, parts, bodies, curves, environments and selectors. What is \
             still used is not deleted.",
    example: "MEDIT\n*P 0 0 0\nDELETE *P\nEND",
    ..CommandSpec::new("DELETE", "deletes things from the model")
};

static RENAME_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &["INMODEL", "MEDIT"],
    data: &[
        ValueSpec::new("OLD", Kind::Name(Noun::Selector), "present name"),
        ValueSpec::new("NEW", Kind::Name(Noun::Selector), "new name, with the same marker"),
    ],
    detail: "What refers to the thing follows.",
    example: "MEDIT\n*P 0 0 0\nRENAME *P *Q\nEND",
    ..CommandSpec::new("RENAME", "renames a connector, class, point or body")
};

fn connector(job: &mut Job, call: &Call) -> Outcome<Effect> {
    if matches!(job.menu(), Menu::Inmodel) {
        job.deferred.push(call.args.clone());
        return Ok(Effect::Done);
    }
    build_connector(job, &call.args)?;
    Ok(Effect::Done)
}

/// Makes a connector of a record whose names are all defined.
///
/// # Errors
/// Unknown names, a class that is not complete, ends that do not fit the class, a name that is taken.
pub fn build_connector(job: &mut Job, args: &Args) -> Outcome<()> {
    let model = &job.model;
    let name = args.word(0).unwrap_or_default();
    if let Some(old) = model.connectors.get(&Model::key(name)) {
        return Err(Diagnostic::error(format!("connector {name} exists already"), args.place(0))
            .other(old.span, "defined here")
            .help(format!("DELETE {name} first, or use another name")));
    }
    let class = find(&model.classes, args.word(1).unwrap_or_default(), "class", args.place(1))?;
    let mut points = Vec::new();
    let mut bodies: Vec<&str> = Vec::new();
    for index in 2..args.data.len() {
        let Some(word) = args.word(index) else { continue };
        let point = find(&model.points, word, "point", args.place(index))?;
        if let Some(body) = model.body_of(point)
            && !bodies.contains(&body.name.as_str())
        {
            bodies.push(&body.name);
        }
        points.push(point);
    }
    let vector = |option: &str| {
        let numbers = args.option(option).map(|g| g.numbers()).unwrap_or_default();
        [0, 1, 2].map(|i| numbers.get(i).copied().unwrap_or(0.0))
    };
    let mut made = Connector {
        name: name.to_string(),
        class: class.name.clone(),
        points: points.iter().map(|p| p.name.clone()).collect(),
        anchor: None,
        offsets: [vector("-GO1"), vector("-GO2")],
        euler: args.has("-EULER").then(|| vector("-EULER")),
        first_length: None,
        active: true,
        span: args.span,
    };
    made.anchor = args.option("-ANCHOR").map(|given| {
        let (direction, distance) = (given.number(0).unwrap_or(0.0), given.number(1).unwrap_or(0.0));
        let [x, y, _] = model.end(&made, 0).unwrap_or_default();
        let (cos, sin) = unit_vector(direction);
        Anchor { direction, distance, at: [x + distance * cos, y + distance * sin], elevation: None }
    });
    class.object.check()?;
    class.object.check_ends(&made, bodies.len())?;
    let span = args.place(0);
    job.model.connectors.insert(Model::key(name), made);
    job.note_name(name, span);
    Ok(())
}

fn delete(job: &mut Job, call: &Call) -> Outcome<Effect> {
    for value in &call.args.data {
        let Some(pattern) = value.word() else { continue };
        let names: Vec<String> = all_names(&job.model)
            .into_iter()
            .filter(|n| n.eq_ignore_ascii_case(pattern) || (is_wild(pattern) && matches(pattern, n)))
            .collect();
        if names.is_empty() {
            let known = all_names(&job.model);
            let mut error = Diagnostic::error(format!("nothing is called {pattern}"), value.span);
            error.help.extend(did_you_mean(pattern, known.iter().map(String::as_str)));
            return Err(error);
        }
        for name in names {
            let what = remove(&mut job.model, &name, value.span)?;
            job.remark(format!("{what} {name} is deleted"), value.span);
        }
    }
    Ok(Effect::Done)
}

fn all_names(model: &Model) -> Vec<String> {
    let mut names: Vec<String> = model.connectors.values().map(|c| c.name.clone()).collect();
    names.extend(model.classes.values().map(|c| c.name.clone()));
    names.extend(model.points.values().map(|p| p.name.clone()));
    names.extend(model.parts.values().map(|p| p.name.clone()));
    names.extend(model.bodies.values().map(|b| b.name.clone()));
    names.extend(model.curves.values().map(|c| c.name.clone()));
    names.extend(model.environments.values().map(|e| e.name.clone()));
    names.extend(model.selectors.values().map(|s| s.name.clone()));
    names.dedup_by(|a, b| a.eq_ignore_ascii_case(b));
    names
}

/// Takes one thing out of the model; returns what it was.
fn remove(model: &mut Model, name: &str, span: Span) -> Outcome<&'static str> {
    let key = Model::key(name);
    let used = |by: Vec<&str>| match by.first() {
        Some(user) => Err(Diagnostic::error(format!("{name} is used by {user} and is not deleted"), span)),
        None => Ok(()),
    };
    if model.connectors.shift_remove(&key).is_some() {
        return Ok("connector");
    }
    if model.classes.contains_key(&key) {
        used(model.users_of_class(name))?;
        model.classes.shift_remove(&key);
        return Ok("class");
    }
    if model.points.contains_key(&key) {
        used(model.users_of_point(name))?;
        model.points.shift_remove(&key);
        return Ok("point");
    }
    if model.bodies.contains_key(&key) {
        let points: Vec<String> = model
            .points
            .values()
            .filter(|p| model.body_of(p).is_some_and(|b| Model::key(&b.name) == key))
            .map(|p| p.name.clone())
            .collect();
        for point in &points {
            used(model.users_of_point(point))?;
        }
        for point in points {
            model.points.shift_remove(&Model::key(&point));
        }
        model.parts.retain(|_, p| Model::key(&p.body) != key);
        model.bodies.shift_remove(&key);
        if model.current_part.as_ref().is_some_and(|p| !model.parts.contains_key(&Model::key(p))) {
            model.current_part = None;
        }
        return Ok("body");
    }
    if model.parts.contains_key(&key) {
        used(model.points.values().filter(|p| Model::key(&p.part) == key).map(|p| p.name.as_str()).collect())?;
        model.parts.shift_remove(&key);
        return Ok("part");
    }
    if model.curves.shift_remove(&key).is_some() {
        return Ok("curve");
    }
    if model.environments.shift_remove(&key).is_some() {
        return Ok("environment");
    }
    model.selectors.shift_remove(&key);
    Ok("selector")
}

fn rename(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (old, new) = (call.args.word(0).unwrap_or_default(), call.args.word(1).unwrap_or_default());
    let span = call.args.place(0);
    let mark = |name: &str| name.chars().next().filter(|c| "~*:".contains(*c));
    if mark(old) != mark(new) {
        return Err(Diagnostic::error("the new name must have the same marker as the old one", call.args.place(1)));
    }
    let model = &mut job.model;
    let (from, to) = (Model::key(old), Model::key(new));
    if all_names(model).iter().any(|n| Model::key(n) == to) {
        return Err(Diagnostic::error(format!("{new} exists already"), call.args.place(1)));
    }
    let what = if let Some(index) = model.connectors.get_index_of(&from) {
        move_entry(&mut model.connectors, index, to, |c| c.name = new.to_string());
        "connector"
    } else if let Some(index) = model.classes.get_index_of(&from) {
        move_entry(&mut model.classes, index, to, |c| c.name = new.to_string());
        for user in model.connectors.values_mut().filter(|c| Model::key(&c.class) == from) {
            user.class = new.to_string();
        }
        "class"
    } else if let Some(index) = model.points.get_index_of(&from) {
        move_entry(&mut model.points, index, to, |p| p.name = new.to_string());
        for point in model.connectors.values_mut().flat_map(|c| c.points.iter_mut()).filter(|p| Model::key(p) == from) {
            *point = new.to_string();
        }
        "point"
    } else if let Some(index) = model.bodies.get_index_of(&from) {
        move_entry(&mut model.bodies, index, to.clone(), |b| b.name = new.to_string());
        for part in model.parts.values_mut().filter(|p| Model::key(&p.body) == from) {
            part.body = new.to_string();
        }
        if let Some(index) = model.parts.get_index_of(&from) {
            move_entry(&mut model.parts, index, to, |p| p.name = new.to_string());
            for point in model.points.values_mut().filter(|p| Model::key(&p.part) == from) {
                point.part = new.to_string();
            }
            if model.current_part.as_ref().is_some_and(|p| Model::key(p) == from) {
                model.current_part = Some(new.to_string());
            }
        }
        "body"
    } else {
        let known = all_names(model);
        let mut error = Diagnostic::error(format!("no connector, class, point or body is called {old}"), span);
        error.help.extend(did_you_mean(old, known.iter().map(String::as_str)));
        return Err(error);
    };
    job.remark(format!("{what} {old} is now {new}"), span);
    Ok(Effect::Done)
}

/// Gives an entry a new key at its old place.
fn move_entry<T>(table: &mut indexmap::IndexMap<String, T>, index: usize, key: String, change: impl FnOnce(&mut T)) {
    if let Some((_, mut entry)) = table.shift_remove_index(index) {
        change(&mut entry);
        table.shift_insert(index, key, entry);
    }
}
