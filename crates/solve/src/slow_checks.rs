//! What is said of slow drift before a run: slow modes that have little damping, and Newman's approximation in shallow water.

use crate::frequency::{LinearSystem, natural};
use crate::time::Run;
use windlass_hydro::database::slow_drift::remark_on_depth;
use windlass_hydro::low_frequency::dividing_period;
use windlass_model::{Body, DriftMethod, LoadKind, Model};

/// Damping over critical below which a slow mode is named: its motion by slow drift goes as the inverse root of it.
const LITTLE_DAMPING: f64 = 0.03;
/// A period beyond which nothing holds a mode but rounding (s).
const LONGEST_PERIOD: f64 = 1e4;
/// Degrees of freedom that slow drift moves.
const DRIFTING: [&str; 3] = ["X", "Y", "RZ"];
/// Degrees of freedom up to which modes are found.
const MAX_DOFS: usize = 60;

/// A slow mode that has little damping.
#[derive(Clone, Debug, PartialEq)]
pub struct LightMode {
    /// The body and the degree of freedom that move most.
    pub most: (String, &'static str),
    /// Its natural period (s).
    pub period: f64,
    /// Its damping over critical.
    pub ratio: f64,
}

/// The modes of a run, about where its bodies begin, that drift makes swing with less than three hundredths of critical damping: those of bodies with
/// wave drift whose periods are above the dividing period of the run. Damping is the linear one of records, connectors, streams and radiated waves.
/// None of more than 60 degrees of freedom, or where bodies have motions that are given.
pub fn light_slow_modes(run: &Run) -> Vec<LightMode> {
    let drifting: Vec<&str> = run.drifting_bodies().collect();
    let Some(sea) = run.sea.as_deref().filter(|_| !drifting.is_empty() && run.free_degrees() <= MAX_DOFS) else {
        return Vec::new();
    };
    let slowest_wave = dividing_period(&run.model, Some(sea));
    // what cannot be solved is named by the run itself
    let modes = LinearSystem::new(&run.model).and_then(|linear| natural(&linear)).unwrap_or_default();
    modes
        .into_iter()
        .filter_map(|mode| {
            let (period, ratio) = (mode.mode.period?, mode.damping?);
            let is_slow = period > slowest_wave && period < LONGEST_PERIOD && DRIFTING.contains(&mode.mode.most.1);
            let is_light = is_slow && ratio < LITTLE_DAMPING && drifting.contains(&mode.mode.most.0.as_str());
            is_light.then_some(LightMode { most: mode.mode.most, period, ratio })
        })
        .collect()
}

/// How the mean drift of the drifting bodies was found by panels, in a sentence each; nothing of those whose coefficients were read.
pub fn drift_methods(run: &Run) -> Vec<String> {
    let method = |name: &str| {
        let attached = run.model.bodies.get(&Model::key(name))?.database.as_ref()?;
        let drift = attached.data.drift.as_ref().filter(|_| attached.drift != DriftMethod::None)?;
        Some(format!("the mean drift of {name} was found {}", drift.method.as_ref()?))
    };
    run.drifting_bodies().filter_map(method).collect()
}

/// What a run with slow drift is warned of.
pub fn warnings_of_slow_drift(run: &Run) -> Vec<String> {
    let mut list: Vec<String> = light_slow_modes(run)
        .into_iter()
        .map(|LightMode { most: (body, dof), period, ratio }| {
            format!(
                "the slow mode {body} {dof} with a period of {period:.1} s has {:.2} % of critical damping, drag that grows with velocity left out: below {:.0} % this \
                 damping decides how far slow drift moves it; #DRAG and #DAMP give more",
                100.0 * ratio,
                100.0 * LITTLE_DAMPING
            )
        })
        .collect();
    let Some(sea) = run.sea.as_deref() else { return list };
    let by_newman =
        |name: &&str| run.model.bodies.get(&Model::key(name)).is_some_and(|body| is_by_newman(&run.model, body));
    let names: Vec<&str> = run.drifting_bodies().filter(by_newman).collect();
    if !names.is_empty() {
        let waves = sea.components.iter().map(|wave| (wave.amplitude * wave.amplitude, wave.number));
        list.extend(remark_on_depth(waves, sea.depth).map(|text| format!("{}: {text}", names.join(", "))));
    }
    list
}

/// Whether the slow drift of a body is by Newman's approximation.
fn is_by_newman(model: &Model, body: &Body) -> bool {
    let of_records = || {
        let is_own = |part: &str| model.parts_of(body).any(|own| Model::key(&own.name) == Model::key(part));
        model.loads.iter().any(|load| matches!(load.kind, LoadKind::Drift { .. }) && is_own(&load.part))
    };
    match &body.database {
        Some(attached) => match attached.drift {
            DriftMethod::Newman => attached.data.drift.is_some() || attached.data.qtf.is_some(),
            DriftMethod::Full => attached.data.qtf.is_none() && attached.data.drift.is_some(),
            DriftMethod::Mean => false,
            DriftMethod::None => of_records(),
        },
        None => of_records(),
    }
}
