//! What a run says of itself, and how it compares with another.

use super::screening::quasi_static_lines;
use super::time::{
    History, Method, NaturalPeriod, POOR_PERIOD, Resolution, ResultSeries, Run, RunCounts, WorstFollowed, results,
};
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::Category;
use windlass_hydro::low_frequency::dividing_period;
use windlass_model::{Body, Idealisation, LoadKind, Model, PartLoad, WaveAction, add_model_column, list_names};

/// How a run stepped.
fn scheme(run: &Run) -> String {
    match &run.settings.method {
        Method::Implicit(s) if s.alpha_m == 0.0 && s.alpha_f == 0.0 => {
            format!("Newmark, beta {}, alpha {}", s.beta, s.gamma)
        }
        Method::Implicit(s) => {
            // rho = af / (1 - af)
            format!("generalised-alpha, spectral radius {:.3}", s.alpha_f / (1.0 - s.alpha_f))
        }
        Method::Corrector if run.has_dynamic_lines() => {
            "predictor and corrector; dynamic lines by generalised-alpha, spectral radius 0.200".into()
        }
        Method::Corrector => "predictor and corrector".into(),
    }
}

/// What a run did.
pub fn run_table(run: &Run) -> Table {
    let RunCounts { steps: counted, cut, iterations, evaluations } = run.counts;
    let mut table = Table::new("Time Domain").fact("Began", run.began.as_str(), Dim::None);
    if run.start() > 0.0 {
        table = table.fact("Start", run.start(), Dim::Time);
    }
    table = table
        .fact("Time Reached", run.time(), Dim::Time)
        .fact("Step", run.settings.dt, Dim::Time)
        .fact("Scheme", scheme(run), Dim::None)
        .fact("Steps", counted, Dim::None)
        .fact("Steps Cut", cut, Dim::None)
        .fact("Iterations", iterations, Dim::None)
        .fact("Evaluations", evaluations, Dim::None);
    let Resolution { natural, wave, .. } = &run.resolution;
    let steps = |period: f64| format_digits(period / run.settings.dt);
    if let Some(NaturalPeriod { body, dof, period }) = natural.first() {
        let text = format!("{} s ({body} {dof}), {} steps", format_digits(*period), steps(*period));
        table = table.fact("Shortest Natural Period", text, Dim::None);
    }
    if let Some(period) = wave {
        table =
            table.fact("Shortest Waves", format!("{} s, {} steps", format_digits(*period), steps(*period)), Dim::None);
    }
    if let Some(WorstFollowed { body, dof, period, distortion }) = run.worst_followed() {
        let (error, ..) = run.accuracy.largest;
        let [longer, damping] = [distortion.period, distortion.damping].map(percent);
        let text = format!("{longer} of {} s ({body} {dof}), damping {damping} of critical", format_digits(period));
        table = table.fact("Largest Error of a Step", error, Dim::Length).fact(
            "Largest Error of a Period",
            text,
            Dim::None,
        );
    }
    if let Some(sea) = &run.sea {
        table = table.fact("Wave Components", sea.components.len(), Dim::None);
        if let Some(seed) = sea.seed {
            table = table.fact("Seed", seed.to_string(), Dim::None);
        }
        if let Some(time) = sea.reinforcement {
            table = table.fact("Reinforced At", time, Dim::Time);
        }
    }
    let means = run.history.layout.categories.contains(&Category::WaveMean);
    if means || run.model.bodies.values().any(|b| b.database.is_some()) {
        table = table.fact("Dividing Period", dividing_period(&run.model, run.sea.as_deref()), Dim::Time);
    }
    let quasi_static = quasi_static_lines(run);
    if !quasi_static.is_empty() {
        table.note(format!("quasi-static lines, without inertia and drag of their own: {}", list_names(&quasi_static)));
    }
    table.add_notes(run.model.caveats());
    if let Some(names) = without_drift(&run.model).filter(|_| run.sea.is_some()) {
        table.note(format!(
            "{names}: -DIFTYPE FK is no drift force; its mean (W_MEAN of BODY_FORCE) is of the undisturbed waves alone, and #DRIFT gives drift"
        ));
    }
    if run.actions.is_empty() {
        return table;
    }
    let actions: Vec<_> = run.actions.iter().zip(&run.fired).collect();
    table
        .with_rows(&actions)
        .text("Action", |(action, _)| &action.name)
        .column("", "Time", Dim::Time, Digits::Usual, |(_, fired)| **fired)
        .build()
}

/// The bodies under the pressure of waves on their hull that have no drift.
fn without_drift(model: &Model) -> Option<String> {
    let own = |body: &Body, part: &str| model.parts_of(body).any(|p| Model::key(&p.name) == Model::key(part));
    let drifts = |body: &Body| {
        let given = |l: &PartLoad| matches!(l.kind, LoadKind::Drift { .. }) && own(body, &l.part);
        body.database.is_some() || model.loads.iter().any(given)
    };
    let pressed = |body: &&Body| {
        let mut pieces = model.parts_of(body).flat_map(|part| part.pieces.iter());
        pieces.any(|piece| piece.waves == WaveAction::Pressure)
    };
    let names: Vec<&str> =
        model.bodies.values().filter(pressed).filter(|body| !drifts(body)).map(|b| b.name.as_str()).collect();
    (!names.is_empty()).then(|| names.join(", "))
}

/// A number with three digits that count.
fn format_digits(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let first = value.abs().log10().floor();
    if (-4.0..6.0).contains(&first) {
        format!("{value:.*}", (2.0 - first).max(0.0) as usize)
    } else {
        format!("{value:.2e}")
    }
}

/// A share in percent; less than a ten-thousandth is not reported.
fn percent(share: f64) -> String {
    if share.abs() < 1e-4 { "below 0.01 %".into() } else { format!("{} %", format_digits(100.0 * share)) }
}

/// Steps from which on a run is announced.
const MANY_STEPS: f64 = 1e8;

/// What is wrong with the step of a run before it goes, a sentence each.
pub fn warnings_of_step(run: &Run) -> Vec<String> {
    let (Resolution { natural, wave, given }, dt, method) = (&run.resolution, run.settings.dt, &run.settings.method);
    let mut list = Vec::new();
    let steps = run.settings.observed / dt;
    if steps >= MANY_STEPS {
        let hours = format_digits(steps * 1e-5 / 3600.0);
        list.push(format!(
            "the run has {steps:.1e} steps: at 10 microseconds each they take {hours} hours; Ctrl-C ends it"
        ));
    }
    if run.settings.adaptive.is_some() {
        return list;
    }
    let poor = |period: f64| {
        let made = method.distortion(period, dt);
        (made.measure() > 1.0).then(|| {
            format!(
                "a step of at most {} s errs by less than {}",
                format_digits(method.longest_step(period)),
                percent(POOR_PERIOD)
            )
        })
    };
    if let Some((period, remedy)) = wave.and_then(|p| poor(p).map(|r| (p, r))) {
        let by = percent(method.distortion(period, dt).period);
        list.push(format!(
            "a step of {} s is too long for the waves: a tenth of their energy has periods below {} s, where the scheme errs by {by} of a period; {remedy}",
            format_digits(dt),
            format_digits(period)
        ));
    }
    if let Some((body, period)) = given.as_ref().filter(|(_, period)| method.distortion(*period, dt).measure() > 1.0) {
        list.push(format!(
            "a step of {} s is too long for {body}, which is moved with a period of {} s: between the steps forces are missed",
            format_digits(dt),
            format_digits(*period)
        ));
    }
    // stiffer modes than waves excite follow their forces as in statics
    let excited = |swing: &&NaturalPeriod| wave.is_some_and(|wave| swing.period >= 0.5 * wave);
    if let Some((NaturalPeriod { body, dof, period }, remedy)) =
        natural.iter().find(excited).and_then(|swing| poor(swing.period).map(|r| (swing, r)))
    {
        let by = percent(method.distortion(*period, dt).period);
        list.push(format!(
            "a step of {} s is too long for the natural period of {body} in {dof}, {} s: the scheme errs by {by} of it; {remedy}",
            format_digits(dt),
            format_digits(*period)
        ));
    }
    list
}

/// What the steps of a run were too long for, as it saw itself.
pub fn warning_of_accuracy(run: &Run) -> Option<String> {
    let WorstFollowed { body, dof, period, distortion } =
        run.worst_followed().filter(|w| w.distortion.measure() > 1.0)?;
    let [longer, damping] = [distortion.period, distortion.damping].map(percent);
    Some(format!(
        "the steps were too long for the motion of {body} in {dof}: of its period of {} s the scheme errs by {longer} and damps {damping} of critical; a step of at most {} s follows it, and -CHECK shows the difference",
        format_digits(period),
        format_digits(run.settings.method.longest_step(period))
    ))
}

/// Mean, deviation and extremes of the results of a run behind its transient, a table for each dimension.
pub fn extremes(run: &Run) -> Vec<Table> {
    let mut tables = Vec::new();
    for (title, dim) in KINDS {
        let of_dim = run.statistics.results().filter(|(s, _)| s.dim == dim);
        let rows: Vec<_> = of_dim.filter_map(|(series, running)| Some((series, running.summary()?))).collect();
        let mut table = Table::new(title)
            .with_rows(&rows)
            .text("Result", |(series, _)| &series.name)
            .column("", "Mean", dim, Digits::Usual, |(_, m)| m.mean)
            .column("", "Std. Dev.", dim, Digits::Usual, |(_, m)| m.deviation)
            .column("Minimum", "Least", dim, Digits::Usual, |(_, m)| m.minimum.value)
            .column("Minimum", "At", Dim::Time, Digits::Usual, |(_, m)| m.minimum.time)
            .column("Maximum", "Most", dim, Digits::Usual, |(_, m)| m.maximum.value)
            .column("Maximum", "At ", Dim::Time, Digits::Usual, |(_, m)| m.maximum.time)
            .build();
        if dim == Dim::Force {
            add_model_column(&mut table, |series| model_of_series(&run.model, series));
        }
        if table.rows() > 0 {
            tables.push(table);
        }
    }
    if let Some(last) = tables.last_mut() {
        last.add_notes(run.model.caveats());
        last.note(match run.settings.transient {
            t if t > 0.0 => "of the stored instants after TTRA_SET: PRCPOST takes other parts",
            _ => "of all stored instants, the beginning included: PRCPOST takes parts",
        });
    }
    tables
}

/// How the connector of a series of tension is idealised.
fn model_of_series(model: &Model, series: &str) -> Option<Idealisation> {
    series.strip_suffix(" Tension").and_then(|name| model.idealisation(name))
}

/// What differs between a run and the same with half the step, behind its transient: a table for each dimension.
pub fn comparison_tables(run: &Run, second: &History) -> Vec<Table> {
    let (first, transient) = (&run.history, run.statistics_start());
    let all = results(&first.layout);
    let mut tables = Vec::new();
    for (title, dim) in KINDS {
        let rows: Vec<Difference> = all
            .iter()
            .filter(|s| s.dim == dim)
            .map(|series| {
                let pairs = first.rows().zip(second.rows()).filter(|(row, _)| is_behind(row, transient));
                let differences = pairs.map(|(a, b)| (a.first().copied(), (series.value(a) - series.value(b)).abs()));
                let (time, size) = differences.fold((None, -1.0), |worst, at| if at.1 > worst.1 { at } else { worst });
                let moments = [first, second].map(|history| ComparedMoments::new(history, series, transient));
                Difference { name: &series.name, size, time, moments }
            })
            .collect();
        let mut table = Table::new(format!("{title} with Half the Step"))
            .with_rows(&rows)
            .text("Result", |row| row.name)
            .column("Largest Difference", "Size", dim, Digits::Scientific(3), |row| row.size)
            .column("Largest Difference", "At", Dim::Time, Digits::Usual, |row| row.time)
            .columns("Maximum", ["Full Step", "Half Step"], dim, Digits::Usual, |row| {
                row.moments.each_ref().map(|m| m.most)
            })
            .columns("Std. Dev.", ["Full Step ", "Half Step "], dim, Digits::Usual, |row| {
                row.moments.each_ref().map(|m| m.deviation)
            })
            .build();
        if dim == Dim::Force {
            add_model_column(&mut table, |series| model_of_series(&run.model, series));
        }
        if table.rows() > 0 {
            tables.push(table);
        }
    }
    if let Some(last) = tables.last_mut() {
        last.note("at the instants both runs have after TTRA_SET; a difference that does not fall with the step again is one of an action or an impact");
    }
    tables
}

/// The dimensions of results, with what they are called.
const KINDS: [(&str, Dim); 3] =
    [("Places", Dim::Length), ("Angles", Dim::Angle), ("Tensions at First Ends", Dim::Force)];

/// Whether a row is behind the transient (s).
fn is_behind(row: &[f64], transient: f64) -> bool {
    row.first().is_some_and(|time| *time >= transient)
}

/// Deviation and largest value of a result.
struct ComparedMoments {
    deviation: f64,
    most: f64,
}

impl ComparedMoments {
    fn new(history: &History, series: &ResultSeries, transient: f64) -> Self {
        let values = || history.rows().filter(|row| is_behind(row, transient)).map(|row| series.value(row));
        let count = values().count().max(1) as f64;
        let mean = values().sum::<f64>() / count;
        let variance = values().map(|v| (v - mean) * (v - mean)).sum::<f64>() / count;
        ComparedMoments { deviation: variance.sqrt(), most: values().fold(f64::NEG_INFINITY, f64::max) }
    }
}

/// What differs in a result between a run and the same with half the step.
struct Difference<'r> {
    name: &'r str,
    /// The largest difference of an instant, and when (s).
    size: f64,
    time: Option<f64>,
    /// Of the run, and of that with half the step.
    moments: [ComparedMoments; 2],
}

/// The energy and momentum balance of dynamic lines, where the run kept them.
pub fn balance(run: &Run) -> Option<Table> {
    let kept = run.balance();
    if kept.is_empty() {
        return None;
    }
    let energy = Dim::Derived { force: 1, length: 1, seconds: 0 };
    let impulse = Dim::Derived { force: 1, length: 0, seconds: 1 };
    let mut table = Table::new("Energy and Momentum Balance of Lines")
        .with_rows(&kept)
        .text("Line", |(name, _)| name)
        .columns("Energy Now", ["Motion", "Stretch", "Height", "Bottom"], energy, Digits::Scientific(3), |(_, b)| {
            b.energy
        })
        .columns(
            "Work Done by",
            ["1st End", "2nd End", "Water", "Damping", "Bottom"],
            energy,
            Digits::Scientific(3),
            |(_, b)| b.work,
        )
        .column("Imbalance", "Energy", energy, Digits::Scientific(2), |(_, b)| b.energy_error)
        .column("Imbalance", "of Most", Dim::None, Digits::Scientific(2), |(_, b)| {
            if b.turnover > 0.0 { b.energy_error / b.turnover } else { 0.0 }
        })
        .column("Imbalance", "Momentum", impulse, Digits::Scientific(2), |(_, b)| b.momentum_error.norm())
        .build();
    table.note("the imbalance is energy that the scheme damps (negative) or the error of its steps; the mass that a winch adds is not in the balance");
    Some(table)
}
