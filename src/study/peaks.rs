//! What an intact case keeps for the transient cases that follow it: when the lines they lose pull hardest, and when their body is
//! farthest away.

use windlass_model::Model;
use windlass_signal::statistics::{crossings, moments};
use windlass_solve::results::lost_lines;
use windlass_solve::time::Run;
use windlass_study::record::{LinePeaks, Peak};

/// Most maxima of the tension of a line that are kept.
const MOST_MAXIMA: usize = 60;

/// The peaks of lines of a run behind its transient. Offsets are from where `model` has the bodies. Those of a line that the run does not
/// have, or that does not act all the time, are empty.
pub(super) fn line_peaks(run: Option<&Run>, model: &Model, lines: &[String]) -> Vec<LinePeaks> {
    let lost = run.map(lost_lines).unwrap_or_default();
    let acts = |line: &str| !lost.before.iter().chain(&lost.during).any(|name| name.eq_ignore_ascii_case(line));
    let peaks = |line: &String| {
        let found = run.filter(|_| acts(line)).and_then(|run| peaks_of(run, model, line));
        found.unwrap_or_else(|| LinePeaks { line: line.clone(), tension: Vec::new(), offset: None })
    };
    lines.iter().map(peaks).collect()
}

fn peaks_of(run: &Run, model: &Model, line: &str) -> Option<LinePeaks> {
    let layout = &run.history.layout;
    let link = layout.links.iter().position(|link| link.name.eq_ignore_ascii_case(line))?;
    let begin = run.statistics_start();
    let near = 1e-9 * begin.abs();
    let rows: Vec<&[f64]> = run.history.rows().filter(|row| row.first().is_some_and(|t| *t >= begin - near)).collect();
    let times: Vec<f64> = rows.iter().filter_map(|row| row.first().copied()).collect();
    let values: Vec<f64> = rows.iter().filter_map(|row| layout.tension(link, row)).collect();
    let mean = moments(&values).ok()?.mean;
    let at = |time: f64| times.iter().position(|t| *t == time);
    let peak = |time: f64, value: f64| {
        let before = at(time).and_then(|at| at.checked_sub(1)).and_then(|at| Some((*times.get(at)?, *values.get(at)?)));
        Peak { time, value, before }
    };
    // the largest of all may stand at an end of the record, where it is no maximum between crossings
    let largest = times.iter().zip(&values).reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    let mut tension = vec![peak(*largest.0, *largest.1)];
    let mut maxima = crossings(&times, &values, mean).map(|found| found.maxima).unwrap_or_default();
    maxima.sort_by(|a, b| b.value.total_cmp(&a.value).then(a.time.total_cmp(&b.time)));
    tension.extend(maxima.iter().filter(|found| found.time != *largest.0).map(|found| peak(found.time, found.value)));
    tension.truncate(MOST_MAXIMA);
    let body = layout.links.get(link)?.ends.iter().flatten().next().copied();
    let offset = body.and_then(|body| {
        let [x, y, _] = model.bodies.get(&layout.bodies.get(body)?.1)?.position.shift;
        let column = layout.body(body);
        let away = |row: &&[f64]| Some((*row.first()?, (row.get(column)? - x).hypot(row.get(column + 1)? - y)));
        let (time, value) = rows.iter().filter_map(away).reduce(|a, b| if b.1 > a.1 { b } else { a })?;
        Some(Peak { time, value, before: None })
    });
    Some(LinePeaks { line: line.to_owned(), tension, offset })
}
