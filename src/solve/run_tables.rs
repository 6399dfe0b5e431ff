//! What a run says of itself, and its results as series.

use super::system::FREEDOMS;
use super::time::{Counts, History, Method, OF_BODY, Run};
use crate::language::units::Dim;
use crate::table::{Cell, Digits, Table};

/// A result against time.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What it is of, and which: `TBRG X`, `A Tension`.
    pub name: String,
    /// Its dimension.
    pub dim: Dim,
    /// Its numbers in a row: one, or the components of a force whose size it is.
    pub columns: std::ops::Range<usize>,
}

impl Series {
    /// Its value in a row.
    pub fn value(&self, row: &[f64]) -> f64 {
        match row.get(self.columns.clone()) {
            Some([one]) => *one,
            Some(several) => several.iter().map(|v| v * v).sum::<f64>().sqrt(),
            None => f64::NAN,
        }
    }
}

/// The results a run is judged by: places and angles of the bodies, tensions of the connectors.
pub fn results(history: &History) -> Vec<Series> {
    let layout = &history.layout;
    let mut list = Vec::new();
    for (body, (name, _)) in layout.bodies.iter().enumerate() {
        let at = layout.body(body);
        debug_assert!(OF_BODY >= 6, "a row begins with the place");
        for (i, freedom) in FREEDOMS.iter().enumerate() {
            let dim = if i < 3 { Dim::Length } else { Dim::Angle };
            list.push(Series { name: format!("{name} {freedom}"), dim, columns: at + i..at + i + 1 });
        }
    }
    for (link, columns) in layout.links.iter().enumerate() {
        let first = (0..columns.ends.len()).find_map(|end| layout.wrench(link, end));
        if let Some(at) = first {
            list.push(Series { name: format!("{} Tension", columns.name), dim: Dim::Force, columns: at..at + 3 });
        }
    }
    list
}

/// How a run stepped.
fn scheme(method: &Method) -> String {
    match method {
        Method::Implicit(s) if s.alpha_m == 0.0 && s.alpha_f == 0.0 => {
            format!("Newmark, beta {}, alpha {}", s.beta, s.gamma)
        }
        Method::Implicit(s) => {
            // rho = af / (1 - af)
            format!("generalised-alpha, spectral radius {:.3}", s.alpha_f / (1.0 - s.alpha_f))
        }
        Method::Corrector => "predictor and corrector".into(),
    }
}

/// What a run did.
pub fn told(run: &Run) -> Table {
    let Counts { steps, cut, iterations, evaluations } = run.counts;
    let mut table = Table::new("Time Domain")
        .fact("Time Reached", run.time(), Dim::Time)
        .fact("Step", run.settings.dt, Dim::Time)
        .fact("Scheme", scheme(&run.settings.method), Dim::None)
        .fact("Steps", steps, Dim::None)
        .fact("Steps Cut", cut, Dim::None)
        .fact("Iterations", iterations, Dim::None)
        .fact("Evaluations", evaluations, Dim::None);
    if let Some(sea) = &run.sea {
        table = table.fact("Wave Components", sea.components.len(), Dim::None);
        if let Some(seed) = sea.seed {
            table = table.fact("Seed", seed.to_string(), Dim::None);
        }
        if let Some(time) = sea.reinforcement {
            table = table.fact("Reinforced At", time, Dim::Time);
        }
    }
    let mut table = table.column("", "Action", Dim::None, Digits::Usual).column("", "Time", Dim::Time, Digits::Usual);
    for (action, fired) in run.actions.iter().zip(&run.fired) {
        let cells = vec![action.name.as_str().into(), Cell::from(*fired)];
        if table.push(cells).is_err() {
            table.note("an action is left out");
        }
    }
    table
}

/// Mean, deviation and extremes of the results of a history, a table for each dimension.
pub fn extremes(history: &History) -> Vec<Table> {
    let all = results(history);
    let mut tables = Vec::new();
    for (title, dim) in KINDS {
        let mut table = Table::new(title)
            .column("", "Result", Dim::None, Digits::Usual)
            .column("", "Mean", dim, Digits::Usual)
            .column("", "Std. Dev.", dim, Digits::Usual)
            .column("Minimum", "Least", dim, Digits::Usual)
            .column("Minimum", "At", Dim::Time, Digits::Usual)
            .column("Maximum", "Most", dim, Digits::Usual)
            .column("Maximum", "At ", Dim::Time, Digits::Usual);
        for series in all.iter().filter(|s| s.dim == dim) {
            let m = Moments::of(history, series);
            let cells = [m.mean, m.deviation, m.least.1, m.least.0, m.most.1, m.most.0];
            push(&mut table, &series.name, cells.map(Cell::from));
        }
        if table.rows() > 0 {
            tables.push(table);
        }
    }
    if let Some(last) = tables.last_mut() {
        last.note("of the whole run, its beginning included: PRCPOST takes parts of it");
    }
    tables
}

/// What differs between a run and the same with half the step: a table for each dimension.
pub fn compared(first: &History, second: &History) -> Vec<Table> {
    let all = results(first);
    let mut tables = Vec::new();
    for (title, dim) in KINDS {
        let mut table = Table::new(format!("{title} with Half the Step"))
            .column("", "Result", Dim::None, Digits::Usual)
            .column("Largest Difference", "Size", dim, Digits::Scientific(3))
            .column("Largest Difference", "At", Dim::Time, Digits::Usual)
            .column("Maximum", "Full Step", dim, Digits::Usual)
            .column("Maximum", "Half Step", dim, Digits::Usual)
            .column("Std. Dev.", "Full Step ", dim, Digits::Usual)
            .column("Std. Dev.", "Half Step ", dim, Digits::Usual);
        for series in all.iter().filter(|s| s.dim == dim) {
            let pairs = first.rows().zip(second.rows());
            let differences = pairs.map(|(a, b)| (a.first().copied(), (series.value(a) - series.value(b)).abs()));
            let worst = differences.fold((None, -1.0), |worst, at| if at.1 > worst.1 { at } else { worst });
            let (one, other) = (Moments::of(first, series), Moments::of(second, series));
            let cells = [
                Some(worst.1),
                worst.0,
                Some(one.most.1),
                Some(other.most.1),
                Some(one.deviation),
                Some(other.deviation),
            ];
            push(&mut table, &series.name, cells.map(Cell::from));
        }
        if table.rows() > 0 {
            tables.push(table);
        }
    }
    if let Some(last) = tables.last_mut() {
        last.note("at the instants both runs have; a difference that does not fall with the step again is one of an action or an impact");
    }
    tables
}

/// The dimensions of results, with what they are called.
const KINDS: [(&str, Dim); 3] = [("Places", Dim::Length), ("Angles", Dim::Angle), ("Tensions", Dim::Force)];

/// Mean, deviation and extremes (time, value) of a result.
struct Moments {
    mean: f64,
    deviation: f64,
    least: (f64, f64),
    most: (f64, f64),
}

impl Moments {
    fn of(history: &History, series: &Series) -> Self {
        let values = || history.rows().map(|row| (row.first().copied().unwrap_or(0.0), series.value(row)));
        let count = history.len().max(1) as f64;
        let mean = values().map(|(_, v)| v).sum::<f64>() / count;
        let variance = values().map(|(_, v)| (v - mean) * (v - mean)).sum::<f64>() / count;
        let least = values().fold((0.0, f64::INFINITY), |best, at| if at.1 < best.1 { at } else { best });
        let most = values().fold((0.0, f64::NEG_INFINITY), |best, at| if at.1 > best.1 { at } else { best });
        Moments { mean, deviation: variance.sqrt(), least, most }
    }
}

/// Adds the row of a result.
fn push(table: &mut Table, name: &str, cells: impl IntoIterator<Item = Cell>) {
    let row = std::iter::once(Cell::from(name)).chain(cells).collect();
    if table.push(row).is_err() {
        table.note(format!("{name} is left out"));
    }
}
