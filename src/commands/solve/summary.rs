//! What a solve came to, in at most ten lines before its tables: what was solved, the residual, the worst line with its T/MBL, the
//! excursion, how many warnings follow, and what to look at next.

use crate::commands::Job;
use crate::commands::verdict::segment_at_first_end;
use crate::report::{format, page};
use windlass_base::diagnostic::Severity;
use windlass_base::geometry::Place;
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_model::{ConnectorSummary, Model};
use windlass_signal::running::Running;
use windlass_solve::DOFS;
use windlass_solve::frequency::{
    Derivative, ExtremeKind, FrequencyResponse, LinearQuantity, LinearSystem, Operators, ResponseStatistics,
};
use windlass_solve::time::{ResultSeries, Run};

/// The lines of a summary.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SolveSummary {
    head: String,
    lines: Vec<(&'static str, String)>,
}

/// Most lines of a summary.
const MAX_LINES: usize = 10;

/// A line by its tension over its break (MBL).
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WorstLine {
    /// The connector.
    pub name: String,
    /// Largest tension over break, of one that has a break.
    pub ratio: Option<f64>,
    /// Tension at the first end (N).
    pub tension: Option<f64>,
    /// Where and when, behind the values.
    pub position: String,
}

impl WorstLine {
    /// The worse of two: the larger T/MBL, and of lines without a break the larger tension.
    fn worse(self, other: WorstLine) -> WorstLine {
        let key = |line: &WorstLine| (line.ratio.unwrap_or(-1.0), line.tension.unwrap_or(f64::NEG_INFINITY));
        if key(&other) > key(&self) { other } else { self }
    }

    fn text(&self, units: UnitSystem) -> String {
        let tension =
            self.tension.map(|tension| format!("tension {} at its first end", number(tension, Dim::Force, units)));
        let ratio = self.ratio.map(|ratio| format!("T/MBL {ratio:.3}"));
        let mut parts: Vec<String> = ratio.into_iter().chain(tension).collect();
        if self.ratio.is_none() {
            parts.push("no break given".into());
        }
        format!("{}: {}{}", self.name, parts.join(", "), self.position)
    }
}

/// A value with its unit.
pub(crate) fn number(value: f64, dim: Dim, units: UnitSystem) -> String {
    let text = format::report(&Cell::Number(value), dim, Digits::Usual, units);
    format!("{text} {}", dim.label(units)).trim_end().to_string()
}

/// A count with its noun.
pub(crate) fn count(number: usize, noun: &str) -> String {
    match (number, noun) {
        (1, _) => format!("1 {noun}"),
        _ if noun.ends_with('y') => format!("{number} {}ies", noun.trim_end_matches('y')),
        _ => format!("{number} {noun}s"),
    }
}

impl SolveSummary {
    /// A summary of what was solved.
    pub(crate) fn new(head: impl Into<String>) -> Self {
        SolveSummary { head: head.into(), lines: Vec::new() }
    }

    /// Adds a line.
    pub(crate) fn line(mut self, label: &'static str, text: impl Into<String>) -> Self {
        self.lines.push((label, text.into()));
        self
    }

    /// Adds a line, where there is something to say.
    pub(crate) fn line_if(self, label: &'static str, text: Option<String>) -> Self {
        match text {
            Some(text) => self.line(label, text),
            None => self,
        }
    }

    /// Adds the worst line, where there is one.
    pub(crate) fn worst(self, worst: Option<WorstLine>, units: UnitSystem) -> Self {
        match worst {
            Some(worst) => self.line("Worst line", worst.text(units)),
            None => self.line("Worst line", "no connector has a tension"),
        }
    }

    /// Prints it, with the number of warnings that the job is about to report and what to look at next.
    pub(crate) fn print(self, job: &mut Job, next: &str) {
        let warnings = job.notices.iter().filter(|notice| notice.severity == Severity::Warning).count();
        self.print_with(job, warnings, next);
    }

    /// Prints it, with a number of warnings that follow and what to look at next.
    pub(crate) fn print_with(mut self, job: &mut Job, warnings: usize, next: &str) {
        let said = if warnings == 0 { "none".to_string() } else { format!("{warnings}, printed below") };
        self.lines.truncate(MAX_LINES - 3);
        self = self.line("Warnings", said).line("Next", next);
        job.say_fitted(|width| page::fold_text(&self.text(), width));
    }

    fn text(&self) -> String {
        let lines = self.lines.iter().map(|(label, text)| format!("\n   {label:<12}  {text}"));
        format!("\n{}{}", self.head, lines.collect::<String>())
    }
}

/// The worst of some connectors in a state.
pub(crate) fn worst_in_state<'a>(list: impl Iterator<Item = (&'a str, &'a ConnectorSummary)>) -> Option<WorstLine> {
    let line = |(name, summary): (&str, &ConnectorSummary)| {
        (summary.tension.is_some() || summary.ratio.is_some()).then(|| WorstLine {
            name: name.to_string(),
            ratio: summary.ratio,
            tension: summary.tension,
            position: summary
                .critical
                .filter(|segment| *segment > 1)
                .map_or(String::new(), |s| format!(", segment {s}")),
        })
    };
    list.filter_map(line).reduce(WorstLine::worse)
}

/// The body that has moved farthest from some places: how far, and in which direction.
pub(crate) fn farthest_move(before: &[Place], model: &Model, units: UnitSystem) -> String {
    let moved =
        before.iter().zip(model.bodies.values()).filter(|(_, body)| body.junction.is_none()).map(|(from, body)| {
            let [x, y, z] = std::array::from_fn(|i| body.position.shift[i] - from.shift[i]);
            (body.name.as_str(), [x, y, z], x.hypot(y))
        });
    let far = |m: &(&str, [f64; 3], f64)| m.2.hypot(m.1[2]);
    let Some((name, [x, y, z], level)) = moved.max_by(|a, b| far(a).total_cmp(&far(b))) else {
        return "no body".into();
    };
    // what the solution leaves is no excursion
    if level.hypot(z) < 1e-6 {
        return "none: the bodies were at rest".into();
    }
    if level < 1e-6 {
        return format!("{name}: {} upward from where it stood", number(z, Dim::Length, units));
    }
    let way = if level > 1e-6 { format!(" toward {:.1} deg", y.atan2(x).to_degrees()) } else { String::new() };
    format!(
        "{name}: {}{way}, {} upward, from where it stood",
        number(level, Dim::Length, units),
        number(z, Dim::Length, units)
    )
}

/// The worst line of a run behind its transient, by the largest tension at the first end over the break there.
pub(crate) fn worst_in_run(run: &Run) -> Option<WorstLine> {
    let line = |(series, running): (&ResultSeries, &Running)| {
        let name = series.name.strip_suffix(" Tension")?;
        let most = running.summary()?.maximum;
        let breaking = segment_at_first_end(&run.model, name)
            .map(|segment| segment.breaking)
            .filter(|b| b.is_finite() && *b > 0.0);
        Some(WorstLine {
            name: name.to_string(),
            ratio: breaking.map(|breaking| most.value / breaking),
            tension: Some(most.value),
            position: format!(", at {:.1} s", most.time),
        })
    };
    run.statistics.results().filter_map(line).reduce(WorstLine::worse)
}

/// The largest distance of a body from where it began, behind the transient.
pub(crate) fn excursion_in_run(run: &Run, units: UnitSystem) -> String {
    let layout = &run.history.layout;
    let mut most: Option<(&str, [f64; 3], f64)> = None;
    let far = |gone: &[f64; 3]| gone[0].hypot(gone[1]).hypot(gone[2]);
    for (body, (name, key)) in layout.bodies.iter().enumerate() {
        let Some(start) = run.model.bodies.get(key).filter(|b| b.junction.is_none()).map(|b| b.position.shift) else {
            continue;
        };
        let at = layout.body(body);
        for row in run.history.rows() {
            let (Some(time), Some([x, y, z])) = (row.first(), row.get(at..at + 3)) else { continue };
            let gone = [x - start[0], y - start[1], z - start[2]];
            let farther = |m: &(&str, [f64; 3], f64)| far(&gone) > far(&m.1);
            if *time >= run.statistics_start() && most.as_ref().is_none_or(farther) {
                most = Some((name, gone, *time));
            }
        }
    }
    match most {
        Some((name, gone, _)) if far(&gone) < 1e-6 => format!("none: {name} stays where it began"),
        Some((name, [x, y, z], time)) if x.hypot(y) < 1e-6 => {
            format!("{name}: {} upward from where it began, at {time:.1} s", number(z, Dim::Length, units))
        }
        Some((name, [x, y, z], time)) => {
            let [level, up] = [x.hypot(y), z].map(|value| number(value, Dim::Length, units));
            let toward = y.atan2(x).to_degrees();
            format!("{name}: {level} toward {toward:.1} deg, {up} upward, from where it began, at {time:.1} s")
        }
        None => "no instants are kept: the statistics below have the extremes of each degree of freedom".into(),
    }
}

/// The largest motions in unit waves, shifts and rotations: the body, the period and the heading of each.
pub(crate) fn largest_operators(linear: &LinearSystem, made: &Operators, units: UnitSystem) -> [String; 2] {
    [0..3, 3..6].map(|dofs| {
        let is_shift = dofs.start == 0;
        let mut most: Option<(f64, String)> = None;
        for (body, node) in linear.system.nodes.iter().enumerate().filter(|(_, node)| !node.junction) {
            for dof in dofs.clone() {
                let quantity = LinearQuantity::dof(linear, body, dof);
                for one in made.operators() {
                    let size = quantity.amplitude(one.motions, one.encounter, Derivative::Place).norm();
                    if size.is_finite() && most.as_ref().is_none_or(|(before, _)| size > *before) {
                        let name = DOFS.get(dof).copied().unwrap_or_default();
                        let (period, heading) = (std::f64::consts::TAU / one.frequency, one.heading.to_degrees());
                        most = Some((size, format!("{} {name} at {period:.2} s, heading {heading:.1} deg", node.name)));
                    }
                }
            }
        }
        let unit = Dim::Length.label(units);
        match most {
            None => "none".into(),
            Some((size, position)) if is_shift => format!("{size:.3} {unit}/{unit}, {position}"),
            // amplitude of the rotation in a wave with an amplitude of one length of the user's
            Some((size, position)) => {
                format!("{:.3} deg/{unit}, {position}", size.to_degrees() * Dim::Length.to_si(1.0, units))
            }
        }
    })
}

/// The worst line of a response in a sea, of those whose names fit: mean tension and extreme over the break at the first end.
pub(crate) fn worst_in_sea(
    model: &Model,
    (linear, response): (&LinearSystem, &FrequencyResponse),
    extreme: ExtremeKind,
    fits: &dyn Fn(&str) -> bool,
) -> Option<WorstLine> {
    let names: Vec<String> = linear.connectors().filter(|name| fits(name)).map(str::to_string).collect();
    let line = |name: &String| {
        // a connector that cannot be evaluated is reported where its force is asked for
        let (_, along) = LinearQuantity::tension(linear, name).ok().flatten()?;
        let found = ResponseStatistics::new(response, &along?, Derivative::Place);
        let most = found.mean + found.extreme(extreme).unwrap_or_else(|| found.significant());
        let breaking =
            segment_at_first_end(model, name).map(|segment| segment.breaking).filter(|b| b.is_finite() && *b > 0.0);
        let ratio = breaking.map(|breaking| most / breaking);
        let position = ", mean and extreme of -PROBABILITY, else the most probable of three hours".to_string();
        Some(WorstLine { name: name.clone(), ratio, tension: Some(most), position })
    };
    names.iter().filter_map(line).reduce(WorstLine::worse)
}

/// The largest extreme motion of a body in a sea, in one of its directions.
pub(crate) fn largest_in_sea(
    (linear, response): (&LinearSystem, &FrequencyResponse),
    extreme: ExtremeKind,
    units: UnitSystem,
) -> String {
    let mut most: Option<(f64, String)> = None;
    for (body, node) in linear.system.nodes.iter().enumerate().filter(|(_, node)| !node.junction) {
        for (dof, name) in DOFS.iter().enumerate().take(3) {
            let found = ResponseStatistics::new(response, &LinearQuantity::dof(linear, body, dof), Derivative::Place);
            let size = found.extreme(extreme).unwrap_or_else(|| found.significant());
            if most.as_ref().is_none_or(|(before, _)| size > *before) {
                most = Some((size, format!("{} {name}", node.name)));
            }
        }
    }
    most.map_or("none".into(), |(size, name)| format!("{name}: {} about its mean", number(size, Dim::Length, units)))
}

/// The summary of a table of statistics in a sea: of each kind of quantity the row with the largest maximum, with its deviation, its mean
/// and its mean period.
pub(crate) fn of_statistics(command: &str, table: &Table, solved: &str, units: UnitSystem) -> SolveSummary {
    const PARTS: [(&str, &str); 3] = [("", "Largest"), ("R ", "Rotation"), ("M ", "Moment")];
    let title = table.title.strip_prefix("Statistics: ").unwrap_or(&table.title);
    let mut summary = SolveSummary::new(format!("{command}: {title}")).line("Residual", solved);
    for (prefix, label) in PARTS {
        let column = |name: &str| table.get(&format!("{prefix}{name}"));
        let Some(maximum) = column("Maximum") else { continue };
        let sizes = maximum.cells.iter().enumerate().filter_map(|(row, cell)| Some((row, cell.number()?)));
        let moving = sizes.filter(|(_, size)| size.is_finite() && *size > 0.0);
        let Some((row, _)) = moving.max_by(|a, b| a.1.total_cmp(&b.1)) else { continue };
        let name = table.columns().first().map_or(String::new(), |first| cell(first, row, units));
        let part = |label: &str, name: &str| column(name).map(|column| format!("{label} {}", cell(column, row, units)));
        let parts = [part("maximum", "Maximum"), part("RMS", "RMS"), part("about a mean of", "Mean"), part("Tz", "Tz")];
        let text = parts.into_iter().flatten().collect::<Vec<_>>().join(", ");
        summary = summary.line(label, format!("{name}: {text}"));
    }
    summary
}

/// The cell of a column in a row, as text with its unit.
fn cell(column: &Column, row: usize, units: UnitSystem) -> String {
    let value = column.cells.get(row).unwrap_or(&Cell::Missing);
    format!("{} {}", format::report(value, column.dim, column.digits, units), column.dim.label(units))
        .trim_end()
        .to_string()
}

/// The summary of a table of CONN_DESIGN: its worst row by T/MBL or tension, and how far it goes.
pub(crate) fn of_table(command: &str, table: &Table, residual: &str, units: UnitSystem) -> SolveSummary {
    let rows = count(table.rows(), "row");
    let mut summary = SolveSummary::new(format!("{command}: {}, {rows}", table.title)).line("Residual", residual);
    let find = |names: &[&str]| names.iter().find_map(|name| table.get(name));
    let numbers = |column: &Column| -> Vec<(usize, f64)> {
        let cells = column.cells.iter().enumerate();
        cells.filter_map(|(row, cell)| cell.number().filter(|v| v.is_finite()).map(|v| (row, v))).collect()
    };
    let largest = |column: &Column| numbers(column).into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
    let ratio = find(&["Max T/TB", "T/TB", "T/TB Top"]).and_then(|c| largest(c).map(|(row, value)| (c, row, value)));
    let tension = find(&["Tension", "Ten Top"]).and_then(|c| largest(c).map(|(row, _)| (c, row)));
    let first = table.columns().first();
    let at = |row: usize| first.map_or(String::new(), |c| format!(", at {} {}", c.name, cell(c, row, units)));
    summary = match (ratio, tension) {
        (Some((_, row, value)), _) => {
            let line = find(&["Line"]).map_or(String::new(), |c| format!("{}: ", cell(c, row, units)));
            summary.line("Worst line", format!("{line}T/MBL {value:.3}{}", at(row)))
        }
        (None, Some((column, row))) => {
            summary.line("Worst line", format!("tension {}{}", cell(column, row, units), at(row)))
        }
        (None, None) => summary,
    };
    match find(&["Excursion"]).map(|c| (c, numbers(c))) {
        Some((column, values)) => {
            let least = values.iter().min_by(|a, b| a.1.total_cmp(&b.1));
            let most = values.iter().max_by(|a, b| a.1.total_cmp(&b.1));
            match (least, most) {
                (Some((low, _)), Some((high, _))) => summary
                    .line("Excursion", format!("{} to {}", cell(column, *low, units), cell(column, *high, units))),
                _ => summary,
            }
        }
        None => summary,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(name: &str, ratio: Option<f64>, tension: f64) -> WorstLine {
        WorstLine { name: name.into(), ratio, tension: Some(tension), position: String::new() }
    }

    #[test]
    fn line_nearest_its_break_is_worse_than_one_of_larger_tension() {
        let list = [line("A", None, 9e9), line("B", Some(0.4), 1e6), line("C", Some(0.5), 1e5)];
        let worst = list.into_iter().reduce(WorstLine::worse).unwrap();
        assert_eq!(worst.name, "C");
        // 1e5 N are 22.48 kips
        assert_eq!(worst.text(UnitSystem::default()), "C: T/MBL 0.500, tension 22.48 kips at its first end");
    }

    #[test]
    fn summary_has_at_most_ten_lines() {
        let full = (0..20).fold(SolveSummary::new("head"), |summary, _| summary.line("Line", "text"));
        let output = crate::report::output::Output::new(
            crate::report::files::JobFolder::new("job".into(), None, false),
            Box::new(std::io::sink()),
            Box::new(std::io::sink()),
            false,
        );
        let mut job = Job::new(output);
        job.output.keep_log = false;
        let mut kept = full.clone();
        kept.lines.truncate(MAX_LINES - 3);
        let text = kept.line("Warnings", "none").line("Next", "next").text();
        assert_eq!(text.trim().lines().count(), MAX_LINES);
        full.print(&mut job, "next");
    }
}
