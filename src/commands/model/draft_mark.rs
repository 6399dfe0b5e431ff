//! `&DESCRIBE DMARK`, and `-DRAFT` of `&INSTATE`, which brings a body to the drafts read at its marks.
//!
//! The form of DMARK is from memory of MOSES; that of `-DRAFT` is our reading.

use crate::commands::Job;
use crate::commands::describe::DRAFT;
use nalgebra::{DMatrix, DVector};
use windlass_base::dense::Lu;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::spec::ValueKey;
use windlass_base::values::{Given, Value};
use windlass_language::name as rule;
use windlass_model::{DraftMark, EntityKind, Model, find};

/// Describes a draft mark between two points of one body.
///
/// # Errors
/// A name that cannot be one or is taken, other than two points, points of no body or of two.
pub(super) fn describe(job: &mut Job, name: &str, position: Span, points: &[Value]) -> Outcome<()> {
    let model = &mut job.model;
    rule::check(name, None, "draft mark", position)?;
    model.free_name(name, &[EntityKind::DraftMark], position)?;
    let [first, second] = points else {
        return Err(Diagnostic::error("DMARK takes two points", position).help("form: &DESCRIBE DMARK NAME *PT1 *PT2"));
    };
    let on_body = |value: &Value| -> Outcome<(String, String)> {
        let point = find(&model.points, value.word().unwrap_or_default(), "point", value.span)?;
        let body = model.body_of(point).map(|b| Model::key(&b.name));
        let body = body.ok_or_else(|| Diagnostic::error(format!("{} is on no body", point.name), value.span))?;
        Ok((point.name.clone(), body))
    };
    let ((a, body), (b, other)) = (on_body(first)?, on_body(second)?);
    if body != other {
        return Err(Diagnostic::error(format!("{a} and {b} are points of two bodies"), second.span));
    }
    if Model::key(&a) == Model::key(&b) {
        return Err(Diagnostic::error("a draft mark runs between two points", second.span));
    }
    let mark = DraftMark { name: name.to_string(), points: [a, b], span: position };
    model.draft_marks.insert(Model::key(name), mark);
    job.note_name(name, position);
    Ok(())
}

/// The place of a body, by what drafts can change of it.
#[derive(Clone, Copy, PartialEq)]
enum Unknown {
    Height,
    Roll,
    Trim,
}

/// Most Newton steps to the drafts asked for; from upright four do.
const MAX_STEPS: usize = 50;
/// Error of a draft that is none (m).
const TOLERANCE_M: f64 = 1e-11;
/// Change of height (m) and angle (rad) for differences.
const DIFFERENCE: f64 = 1e-6;

/// Brings the body of some marks to their drafts: by its height at one mark, by its height and its trim or roll at two (whichever the
/// marks are farther apart for), by all three at three.
///
/// # Errors
/// More than three marks, marks of two bodies, one that is level; drafts that no place has.
pub(super) fn set_drafts(model: &mut Model, given: &Given) -> Outcome<()> {
    let mut asked: Vec<(DraftMark, f64, Span)> = Vec::new();
    for pair in given.groups() {
        const MARK: ValueKey<str> = DRAFT.word("DMARK");
        let (name, span) = (pair.word(MARK).unwrap_or_default(), pair.position(MARK));
        let mark = find(&model.draft_marks, name, "draft mark", span)?;
        asked.push((mark.clone(), pair.number(const { DRAFT.number("DRAFT") }).unwrap_or_default(), span));
    }
    let body_of = |mark: &DraftMark| {
        let point = model.points.get(&Model::key(&mark.points[0]))?;
        model.body_of(point).map(|b| Model::key(&b.name))
    };
    let Some(body) = asked.first().and_then(|(mark, ..)| body_of(mark)) else { return Ok(()) };
    if let Some((mark, _, span)) = asked.iter().find(|(mark, ..)| body_of(mark).as_ref() != Some(&body)) {
        return Err(Diagnostic::error(format!("{} is on another body than the mark before it", mark.name), *span));
    }
    let unknowns: &[Unknown] = match asked.as_slice() {
        [_] => &[Unknown::Height],
        [(a, ..), (b, ..)] => {
            let at =
                |mark: &DraftMark| model.points.get(&Model::key(&mark.points[0])).map(|p| p.at).unwrap_or_default();
            let ([ax, ay, _], [bx, by, _]) = (at(a), at(b));
            let lengthwise = (bx - ax).abs() >= (by - ay).abs();
            if lengthwise { &[Unknown::Height, Unknown::Trim] } else { &[Unknown::Height, Unknown::Roll] }
        }
        [_, _, _] => &[Unknown::Height, Unknown::Roll, Unknown::Trim],
        _ => return Err(Diagnostic::error("-DRAFT takes one to three marks of a body", given.span)),
    };
    let mut trial = model.clone();
    let shift = |model: &mut Model, unknown: Unknown, by: f64| {
        if let Some(body) = model.bodies.get_mut(&body) {
            match unknown {
                Unknown::Height => body.position.shift[2] += by,
                Unknown::Roll => body.position.turn[0] += by,
                Unknown::Trim => body.position.turn[1] += by,
            }
        }
    };
    let errors = |model: &Model| -> Outcome<DVector<f64>> {
        let mut list = Vec::new();
        for (mark, draft, span) in &asked {
            let now = model.draft_at(mark).ok_or_else(|| {
                Diagnostic::error(format!("the line of {} is level: there is no draft along it", mark.name), *span)
            })?;
            list.push(now - draft);
        }
        Ok(DVector::from_vec(list))
    };
    let no_place = || Diagnostic::error("no place of the body has these drafts", given.span);
    for _ in 0..MAX_STEPS {
        let now = errors(&trial)?;
        if now.amax() <= TOLERANCE_M {
            if let (Some(found), Some(moved)) = (model.bodies.get_mut(&body), trial.bodies.get(&body)) {
                found.position = moved.position;
            }
            return Ok(());
        }
        let mut slopes = DMatrix::zeros(now.len(), unknowns.len());
        for (column, unknown) in unknowns.iter().enumerate() {
            let [mut above, mut below] = [trial.clone(), trial.clone()];
            shift(&mut above, *unknown, DIFFERENCE);
            shift(&mut below, *unknown, -DIFFERENCE);
            slopes.set_column(column, &((errors(&above)? - errors(&below)?) / (2.0 * DIFFERENCE)));
        }
        let solved = Lu::new(slopes, &|| false).and_then(|factors| factors.solve(&now));
        let step = solved.map_err(|_| no_place().help("the marks stand on one line or in one place"))?;
        for (unknown, by) in unknowns.iter().zip(step.iter()) {
            shift(&mut trial, *unknown, -by);
        }
    }
    Err(no_place())
}
