//! Files of places at times, and of responses to waves.

use crate::commands::Job;
use crate::commands::files::number_rows::{NumberLine, rows};
use std::f64::consts::TAU;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_model::{PathRow, ResponseRow, Responses};

/// Places at times, in SI.
///
/// # Errors
/// A file that cannot be read, rows that are none, times that do not grow or do not hold the time zero.
pub(super) fn path(job: &Job, file: (&str, Span)) -> Outcome<Vec<PathRow>> {
    let (name, span) = file;
    let what = "time, x, y, z, roll, pitch, yaw; times grow, and angles are in degrees";
    let read: Vec<NumberLine<7>> = rows(job, file, what, usize::MAX)?;
    let refused = |why: String| Diagnostic::error(format!("{name} cannot be used: {why}"), span);
    let wrong = read.windows(2).find_map(|w| w.last().zip(w.first()).filter(|(b, a)| b.1[0] <= a.1[0]));
    if let Some((late, early)) = wrong {
        let text = format!("the time {} of line {} is not after {} of the row before", late.1[0], late.0, early.1[0]);
        return Err(refused(text).help(format!("a row is {what}")));
    }
    let (first, last) = read.first().zip(read.last()).map_or((0.0, 0.0), |(a, b)| (a.1[0], b.1[0]));
    if read.len() < 2 {
        return Err(refused("a motion needs two or more rows".into()));
    }
    if first > 0.0 || last <= 0.0 {
        return Err(refused(format!("it goes from {first} s to {last} s, and runs begin at 0 s")));
    }
    let si = |(_, row): &NumberLine<7>| {
        let [time, x, y, z, roll, pitch, yaw] = *row;
        let long = |v: f64| Dim::Length.to_si(v, job.units);
        let angle = |v: f64| Dim::Angle.to_si(v, job.units);
        (time, [long(x), long(y), long(z), angle(roll), angle(pitch), angle(yaw)])
    };
    Ok(read.iter().map(si).collect())
}

/// Responses by heading and period, in SI.
///
/// # Errors
/// A file that cannot be read, a period that is not positive or comes twice, headings of the other side of a symmetric table.
pub(super) fn responses(job: &Job, file: (&str, Span), symmetric: bool) -> Outcome<Responses> {
    let (name, span) = file;
    let what =
        "heading, period, and for surge, sway, heave, roll, pitch, yaw each amplitude and lag; angles are in degrees";
    let read: Vec<NumberLine<14>> = rows(job, file, what, usize::MAX)?;
    let refused = |why: String| Diagnostic::error(format!("{name} cannot be used: {why}"), span);
    let mut headings: Vec<(f64, Vec<ResponseRow>)> = Vec::new();
    for (line, row) in read {
        let [heading, period, ..] = row;
        if period <= 0.0 {
            return Err(refused(format!("line {line}: the period {period} is not positive")));
        }
        let heading = heading.rem_euclid(360.0);
        if symmetric && heading > 180.0 {
            let text = format!("line {line}: heading {heading} is of the side that -SYMMETRIC mirrors");
            return Err(refused(text).help("give headings from 0 to 180"));
        }
        let heading = Dim::Angle.to_si(heading, job.units);
        let mut values = [(0.0, 0.0); 6];
        for (dof, (value, pair)) in values.iter_mut().zip(row[2..].chunks_exact(2)).enumerate() {
            let (amplitude, lag) = (pair.first().copied().unwrap_or(0.0), pair.last().copied().unwrap_or(0.0));
            // degrees a long unit of length
            let angle = Dim::Angle.to_si(amplitude, job.units) / job.units.metres();
            *value = (if dof < 3 { amplitude } else { angle }, Dim::Angle.to_si(lag, job.units));
        }
        let made = ResponseRow { frequency: TAU / period, values };
        match headings.iter_mut().find(|(h, _)| *h == heading) {
            Some((_, rows)) if rows.iter().any(|r| r.frequency == made.frequency) => {
                return Err(refused(format!("line {line}: this heading has the period {period} twice")));
            }
            Some((_, rows)) => rows.push(made),
            None => headings.push((heading, vec![made])),
        }
    }
    headings.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, rows) in &mut headings {
        rows.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    }
    Ok(Responses { headings, symmetric })
}
