//! What the step of a run has to follow, before it goes: the shortest natural period and the shortest waves.

use super::run::Run;
use crate::modes::modes_with;
use windlass_hydro::sea::Sea;
use windlass_model::GivenMotion;

/// Share of the energy of a sea that its shortest waves hold, whose longest is what a step has to follow.
const SHORTEST_WAVES: f64 = 0.1;
/// Degrees of freedom up to which modes are always found.
const MAX_DOFS_ALWAYS_MODAL: usize = 60;
/// Steps of a run that cost more than twenty times its modes, of however many bodies: both grow with the cube of their number.
const MANY_STEPS: f64 = 2000.0;

/// A period and what has it.
#[derive(Clone, Debug, PartialEq)]
pub struct NaturalPeriod {
    /// The body that moves most, as written.
    pub body: String,
    /// Its degree of freedom.
    pub dof: &'static str,
    /// Its period (s).
    pub period: f64,
}

/// What a step has to follow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Resolution {
    /// The natural modes at the start of the run, shortest first, by the stiffness and inertia there: dynamic lines count with
    /// their inertia alone. None of many bodies in a short run, whose modes would cost more than a twentieth of it.
    pub natural: Vec<NaturalPeriod>,
    /// Of the waves the period below which a tenth of the energy is (s).
    pub wave: Option<f64>,
    /// The shortest period of the motions that are given by sines (s), and the body.
    pub given: Option<(String, f64)>,
}

impl Resolution {
    /// What the step of a run has to follow, at its start.
    pub(super) fn from_run(run: &Run) -> Resolution {
        let sines = |key: &String| match run.model.bodies.get(key)?.prescribed.as_ref().map(|p| &p.motion) {
            Some(GivenMotion::Sinusoids { list, .. }) => {
                list.iter().filter(|s| s.amplitude != 0.0).map(|s| s.period).reduce(f64::min)
            }
            _ => None,
        };
        let swung = run.system.nodes.iter().filter_map(|n| sines(&n.key).map(|period| (n.name.clone(), period)));
        Resolution {
            natural: natural_periods(run),
            wave: run.sea.as_deref().and_then(shortest),
            given: swung.reduce(|a, b| if b.1 < a.1 { b } else { a }),
        }
    }
}

/// The natural modes of a run at its start, shortest first.
fn natural_periods(run: &Run) -> Vec<NaturalPeriod> {
    let free = run.system.nodes.iter().flat_map(|n| n.free).filter(|f| *f).count();
    if free > MAX_DOFS_ALWAYS_MODAL && run.settings.observed / run.settings.dt < MANY_STEPS {
        return Vec::new();
    }
    let poses: Vec<_> = run.now.motions.iter().map(|m| m.pose).collect();
    let forces = &run.now.forces;
    let mut mass = run.system.mass_matrix(&poses);
    if mass.shape() != forces.inertia.shape() {
        return Vec::new();
    }
    mass += &forces.inertia;
    if !mass.iter().chain(forces.stiffness.iter()).all(|v| v.is_finite()) {
        return Vec::new();
    }
    // what cannot be solved here is found, and named, by the first step
    let mut list: Vec<NaturalPeriod> = modes_with(&run.system, &mass, &forces.stiffness)
        .unwrap_or_default()
        .into_iter()
        .filter_map(|m| m.period.map(|period| NaturalPeriod { body: m.most.0, dof: m.most.1, period }))
        .collect();
    list.sort_by(|a, b| a.period.total_cmp(&b.period));
    list
}

/// The period below which a share of the energy of a sea is (s).
fn shortest(sea: &Sea) -> Option<f64> {
    let mut list: Vec<(f64, f64)> = sea.components.iter().map(|c| (c.frequency, c.amplitude * c.amplitude)).collect();
    list.sort_by(|a, b| b.0.total_cmp(&a.0));
    let whole: f64 = list.iter().map(|c| c.1).sum();
    let mut sum = 0.0;
    let found = list.into_iter().find(|(_, energy)| {
        sum += energy;
        sum >= SHORTEST_WAVES * whole
    });
    found
        .filter(|(frequency, _)| whole > 0.0 && *frequency > 0.0)
        .map(|(frequency, _)| std::f64::consts::TAU / frequency)
}
