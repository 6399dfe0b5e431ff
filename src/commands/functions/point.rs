//! `&POINT`: places of points, and points by their places.
//!
//! Source: [MOSES-REF geom_sfun]. An unknown point gives a null string, as there.

use super::{find_point, number_words, numbers, pick};
use crate::commands::Job;
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Position;
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_language::record::Word;
use windlass_model::{AssemblyKind, Model, Point, find};

choices! {
    /// What `&POINT` gives.
    enum PointAction {
        Coordinates = "COORDINATES",
        Distance = "D_NODE",
        Part = "PART",
        EulerAngles = "EULER_ANGLES",
        Between = "N_2NODES",
        InBox = "N_BOX",
        Ratio = "RATIO",
        Deflection = "DEFLECTION",
        HookLocation = "HOOK_LOC",
        Offset = "OFFSET",
        Close = "CLOSE",
        Nearest = "NEAREST",
        RelativeMotion = "REL_MOTION",
    }
}

impl PointAction {
    /// Why windlass has no such value; `None` where it has one.
    fn why_absent(self) -> Option<&'static str> {
        match self {
            PointAction::Ratio => {
                Some("the unity ratio of a joint comes from a stress analysis, which windlass does not make")
            }
            PointAction::Deflection => {
                Some("deflections of nodes come from a stress analysis, which windlass does not make")
            }
            PointAction::Offset => Some("offsets of members belong to a stress analysis, which windlass does not make"),
            PointAction::RelativeMotion => Some(
                "motions are not kept with the points; POINTS of PRCPOST and FR_POINT of FREQ_RESPONSE report them",
            ),
            _ => None,
        }
    }
}

fn distance(a: Position, b: Position) -> f64 {
    a.iter().zip(b).map(|(p, q)| (p - q).powi(2)).sum::<f64>().sqrt()
}

/// The value of `&POINT(ACTION rest)`.
pub(super) fn point(job: &Job, action: &Word, rest: &[Word], span: Span) -> Outcome<String> {
    let model = &job.model;
    let at = |i: usize| find_point(job, rest.get(i)).map(|p| model.global(p));
    let joined = |list: Vec<&Point>| list.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(" ");
    let lengths = |i: usize| {
        number_words(rest.get(i..).unwrap_or_default())
            .map(|v| v.into_iter().map(|x| Dim::Length.to_si(x, job.units)).collect::<Vec<_>>())
    };
    let action_name: PointAction = pick(action, "POINT")?;
    if let Some(why) = action_name.why_absent() {
        let text = format!("&POINT({} ..) has no value: {why}", action_name.word());
        return Err(Diagnostic::error(text, action.span));
    }
    Ok(match action_name {
        PointAction::Coordinates => {
            let Some(found) = find_point(job, rest.first()) else { return Ok(String::new()) };
            let system = rest.get(1).map(|w| w.text.to_ascii_uppercase()).unwrap_or_default();
            let position = if !system.is_empty() && "-GLOBAL".starts_with(&system) {
                model.global(found)
            } else if !system.is_empty() && "-BODY".starts_with(&system) {
                model.parts.get(&Model::key(&found.part)).map_or(found.at, |p| p.position.apply(found.at))
            } else {
                found.at
            };
            numbers(&position, Dim::Length, job)
        }
        PointAction::Distance => {
            at(0).zip(at(1)).map_or(String::new(), |(a, b)| numbers(&[distance(a, b)], Dim::Length, job))
        }
        PointAction::Part => find_point(job, rest.first()).map_or(String::new(), |p| p.part.clone()),
        PointAction::EulerAngles => {
            let (Some(o), Some(x), Some(xy)) = (at(0), at(1), at(2)) else { return Ok(String::new()) };
            let v = |p: Position| nalgebra::Vector3::from(p) - nalgebra::Vector3::from(o);
            let (e1, e3) = (v(x), v(x).cross(&v(xy)));
            if e1.norm() == 0.0 || e3.norm() == 0.0 {
                return Err(Diagnostic::error("the three points lie on one line", span));
            }
            let (e1, e3) = (e1.normalize(), e3.normalize());
            let matrix = nalgebra::Matrix3::from_columns(&[e1, e3.cross(&e1), e3]);
            let (roll, pitch, yaw) = nalgebra::Rotation3::from_matrix_unchecked(matrix).euler_angles();
            numbers(&[roll, pitch, yaw], Dim::Angle, job)
        }
        PointAction::Between => {
            let (Some(a), Some(b)) = (at(0), at(1)) else { return Ok(String::new()) };
            let whole = distance(a, b);
            let named =
                |index: usize, p: &Point| rest.get(index).is_some_and(|w| Model::key(&w.text) == Model::key(&p.name));
            let from_first = |p: &Point| distance(a, model.global(p));
            let on_line = |p: &&Point| {
                let there = from_first(p) + distance(model.global(p), b) <= whole * (1.0 + 1e-9);
                there || named(0, p) || named(1, p)
            };
            let mut list: Vec<&Point> = model.points.values().filter(on_line).collect();
            // the two ends first and last, also where another point stands on one of them
            let rank = |p: &Point| u8::from(!named(0, p)) + u8::from(named(1, p) && !named(0, p));
            list.sort_by(|p, q| rank(p).cmp(&rank(q)).then(from_first(p).total_cmp(&from_first(q))));
            joined(list)
        }
        PointAction::InBox => {
            let b = lengths(0)?;
            let [x1, x2, y1, y2, z1, z2] = b.as_slice() else {
                return Err(Diagnostic::error("N_BOX takes X1 X2 Y1 Y2 Z1 Z2", span));
            };
            let inside = |p: &&Point| {
                let [x, y, z] = model.global(p);
                (*x1..=*x2).contains(&x) && (*y1..=*y2).contains(&y) && (*z1..=*z2).contains(&z)
            };
            joined(model.points.values().filter(inside).collect())
        }
        PointAction::Close => {
            let Some(a) = at(0) else { return Ok(String::new()) };
            let r = lengths(1)?.first().copied().unwrap_or(0.0);
            let own = rest.first().map(|w| Model::key(&w.text)).unwrap_or_default();
            let near = |p: &&Point| Model::key(&p.name) != own && distance(model.global(p), a) <= r;
            joined(model.points.values().filter(near).collect())
        }
        PointAction::Nearest => {
            let v = lengths(0)?;
            let [x, y, z] = v.as_slice() else { return Err(Diagnostic::error("NEAREST takes X Y Z", span)) };
            let to = |p: &Point| distance(model.global(p), [*x, *y, *z]);
            model.points.values().min_by(|a, b| to(a).total_cmp(&to(b))).map_or(String::new(), |p| p.name.clone())
        }
        PointAction::HookLocation => {
            let Some(name) = rest.first() else {
                return Err(Diagnostic::error("HOOK_LOC takes the name of a tip-hook set", span));
            };
            let set = find(&model.assemblies, &name.text, "assembly", name.span)?;
            match (&set.kind, model.bodies.get(&Model::key(&set.name))) {
                (AssemblyKind::TipHook { .. }, Some(hook)) => numbers(&hook.position.shift, Dim::Length, job),
                _ => return Err(Diagnostic::error(format!("{} is no tip-hook set", set.name), name.span)),
            }
        }
        PointAction::Ratio | PointAction::Deflection | PointAction::Offset | PointAction::RelativeMotion => {
            String::new()
        }
    })
}
