//! What a run says of itself, and how it compares with another.

use super::time::{Counts, History, Method, Run, Series, results};
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;

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
        .fact("Began", run.began.as_str(), Dim::None)
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
    if run.actions.is_empty() {
        return table;
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

/// Mean, deviation and extremes of the results of a run behind its transient, a table for each dimension.
pub fn extremes(run: &Run) -> Vec<Table> {
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
        for (series, running) in run.statistics.all().filter(|(s, _)| s.dim == dim) {
            if let Some(m) = running.summary() {
                let (least, most) = (m.minimum, m.maximum);
                let cells = [m.mean, m.deviation, least.value, least.time, most.value, most.time];
                push(&mut table, &series.name, cells.map(Cell::from));
            }
        }
        if table.rows() > 0 {
            tables.push(table);
        }
    }
    if let Some(last) = tables.last_mut() {
        last.note(match run.settings.transient {
            t if t > 0.0 => "of the stored instants behind TTRA_SET: PRCPOST takes other parts",
            _ => "of all stored instants, the beginning included: PRCPOST takes parts",
        });
    }
    tables
}

/// What differs between a run and the same with half the step: a table for each dimension.
pub fn compared(first: &History, second: &History) -> Vec<Table> {
    let all = results(&first.layout);
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
            let cells =
                [Some(worst.1), worst.0, Some(one.most), Some(other.most), Some(one.deviation), Some(other.deviation)];
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

/// Deviation and largest value of a result.
struct Moments {
    deviation: f64,
    most: f64,
}

impl Moments {
    fn of(history: &History, series: &Series) -> Self {
        let values = || history.rows().map(|row| series.value(row));
        let count = history.len().max(1) as f64;
        let mean = values().sum::<f64>() / count;
        let variance = values().map(|v| (v - mean) * (v - mean)).sum::<f64>() / count;
        Moments { deviation: variance.sqrt(), most: values().fold(f64::NEG_INFINITY, f64::max) }
    }
}

/// Adds the row of a result.
fn push(table: &mut Table, name: &str, cells: impl IntoIterator<Item = Cell>) {
    let row = std::iter::once(Cell::from(name)).chain(cells).collect();
    if table.push(row).is_err() {
        table.note(format!("{name} is left out"));
    }
}

/// The books of energy and momentum of lines that move by themselves, where the run kept them.
pub fn books(run: &Run) -> Option<Table> {
    let kept = run.books();
    if kept.is_empty() {
        return None;
    }
    let energy = Dim::Derived { force: 1, length: 1, seconds: 0 };
    let impulse = Dim::Derived { force: 1, length: 0, seconds: 1 };
    let mut table = Table::new("Books of Lines".to_string()).column("", "Line", Dim::None, Digits::Usual);
    for name in ["Motion", "Stretch", "Height", "Bottom"] {
        table = table.column("Energy Now", name, energy, Digits::Scientific(3));
    }
    for name in ["1st End", "2nd End", "Water", "Damping", "Bottom"] {
        table = table.column("Work Done by", name, energy, Digits::Scientific(3));
    }
    table = table
        .column("Not in the Books", "Energy", energy, Digits::Scientific(2))
        .column("Not in the Books", "of Most", Dim::None, Digits::Scientific(2))
        .column("Not in the Books", "Momentum", impulse, Digits::Scientific(2));
    for (name, b) in kept {
        let mut row: Vec<Cell> = vec![name.as_str().into()];
        row.extend(b.energy.iter().chain(&b.work).map(|v| Cell::Number(*v)));
        let share = if b.turnover > 0.0 { b.energy_error / b.turnover } else { 0.0 };
        row.extend([b.energy_error, share, b.momentum_error.norm()].map(Cell::Number));
        // the row has one cell a column, made just above
        let _ = table.push(row);
    }
    table.note("energy that is in no book was damped by the scheme (negative) or is the error of its steps; a winch adds mass that the books do not follow");
    Some(table)
}
