//! `&DATA`: curves, and the menu that defines environments.

use super::{Call, Command, Effect, Job, Menu};
use crate::language::diagnostic::{Diagnostic, Outcome};
use crate::language::number;
use crate::language::select::{Owner, choose};
use crate::language::spec::{CommandSpec, Form, Kind, ValueSpec};
use crate::model::{Curve, CurveKind, Model};

/// &DATA.
pub static DATA: Command = Command { spec: &SPEC, edits: false, run };

static SPEC: CommandSpec = CommandSpec {
    form: Form::Text,
    data: &[ValueSpec::new("KIND", Kind::Choice(&["CURVES", "ENVIRONMENT"]), "what is defined")],
    detail: "&DATA CURVES TYPE NAME a1 b1 a2 b2 .. with TYPE C_PROFILE (depth, velocity), P_SPECTRUM (period, density), \
             F_SPECTRUM (frequency, density), M_GROWTH (elevation, added OD), W_HISTORY (time, knots), LT_MULTIPLIER, \
             CT_LENGTH, EFFICIENCY, CS_VELOCITY or AM_PRESSURE; the first value grows. &DATA ENVIRONMENT opens a menu of ENV \
             records up to END.",
    example: "&DATA CURVES C_PROFILE CUR 0 3.0 100 2.0 500 0.5\n&STATUS CURVES CUR",
    ..CommandSpec::new("&DATA", "defines curves and environments")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let form = "form: &DATA CURVES TYPE NAME a1 b1 a2 b2 .. or &DATA ENVIRONMENT";
    let Some(kind) = call.words.get(1) else {
        return Err(Diagnostic::error("&DATA lacks what it defines", call.record.whole()).help(form));
    };
    let names = [("CURVES", Owner::Moses, true), ("ENVIRONMENT", Owner::Moses, false)];
    if !choose(&kind.text, kind.span, "kind of &DATA", names.into_iter())? {
        job.menus.push(Menu::Environments);
        return Ok(Effect::Done);
    }
    let [_, _, kind, name, values @ ..] = call.words else {
        return Err(Diagnostic::error("a curve has a type, a name and pairs of values", call.record.whole()).help(form));
    };
    let kinds = CurveKind::ALL.iter().map(|(n, k)| (*n, Owner::Moses, *k));
    let kind = choose(&kind.text, kind.span, "type of curve", kinds)?;
    let [first, second] = kind.axes();
    let mut points: Vec<(f64, f64)> = Vec::new();
    for pair in values.chunks(2) {
        let [a, b] = pair else {
            let span = pair.first().map_or(name.span, |w| w.span);
            return Err(Diagnostic::error("the values of a curve come in pairs", span)
                .label(format!("{} without {}", first.0, second.0)));
        };
        let read = |word: &crate::language::record::Word, axis: (&str, crate::language::units::Dim)| {
            number::evaluate(&word.text).map(|v| axis.1.to_si(v, job.units)).map_err(|e| {
                Diagnostic::error(format!("{} of a {} curve must be a number", axis.0, kind.name()), word.span)
                    .label(e.to_string())
            })
        };
        let point = (read(a, first)?, read(b, second)?);
        if points.last().is_some_and(|last| point.0 <= last.0) {
            return Err(Diagnostic::error(format!("{} of a curve must grow from point to point", first.0), a.span)
                .label("not larger than the one before"));
        }
        points.push(point);
    }
    if points.len() < 2 {
        return Err(Diagnostic::error("a curve has at least two points", name.span));
    }
    let made = Curve { name: name.text.to_string(), kind, points, span: name.span };
    if job.model.curves.insert(Model::key(&name.text), made).is_some() {
        job.remark(format!("curve {} is redefined", name.text), name.span);
    }
    Ok(Effect::Done)
}
