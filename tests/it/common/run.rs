//! Runs for tests: a model of records, settings by length and step, a run to its end.

use crate::common;
use windlass_model::Model;
use windlass_solve::time::{Action, Ending, Method, Run, RunSettings, SilentWatcher, StepTolerance, TimeScheme};

/// The model of records in metres and newtons.
pub fn model(records: &str) -> Model {
    model_as_written(&format!("&DIMEN -DIMEN METERS N\n{records}\n"))
}

/// The model of records that draw no error, in the units they set.
pub fn model_as_written(records: &str) -> Model {
    let (mut session, screen, _folder) = common::session();
    session.open("records", records.to_string());
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    session.job.model.clone()
}

/// A body B with records on points of it, in an environment, in metres and newtons.
pub fn body(records: &str, environment: &str) -> Model {
    model(&format!("MEDIT\n&DESCRIBE BODY B\n{records}\nEND\n{environment}"))
}

/// A run over a time with a step (s) by the usual scheme, every step kept.
pub fn settings(observed: f64, dt: f64) -> RunSettings {
    RunSettings {
        observed,
        dt,
        method: Method::default(),
        convergence: StepTolerance::default(),
        store: 1,
        capsize: true,
        adaptive: None,
        keep: true,
        along: 1,
        balance: false,
        transient: 0.0,
    }
}

/// The trapezoidal rule.
pub fn trapezoidal() -> Method {
    Method::Implicit(TimeScheme::newmark(0.25, 0.5))
}

/// A run that comes to its end.
pub fn run(model: &Model, settings: RunSettings, actions: Vec<Action>) -> Run {
    let mut run = Run::new(model, settings, actions).unwrap();
    assert_eq!(run.run(&mut SilentWatcher), Ok(Ending::Done));
    run
}
