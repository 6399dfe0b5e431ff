//! Per-run requirements used when building dynamic lines.

use super::action::{Action, ActionKind};
use super::run_settings::RunSettings;
use super::scheme::Method;
use std::collections::{BTreeMap, BTreeSet};
use windlass_model::{Model, RunRequirement, SchemeWeights};

/// What a run asks, by the keys of connectors; nothing where there is no run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunRequirements {
    /// Whether the energy and momentum balance is kept.
    balance: bool,
    /// The longest that winches make first segments (m).
    longest: BTreeMap<String, f64>,
    /// Those whose first end is let go.
    freed: BTreeSet<String>,
    /// The scheme of the bodies, where that is implicit.
    scheme: Option<SchemeWeights>,
}

impl RunRequirements {
    /// Those of a run at its start.
    pub fn new(model: &Model, actions: &[Action], settings: &RunSettings) -> Self {
        let RunSettings { observed, balance, .. } = *settings;
        let scheme = match &settings.method {
            Method::Implicit(scheme) => Some(scheme.weights()),
            Method::Corrector => None,
        };
        let mut longest: BTreeMap<String, f64> = BTreeMap::new();
        for action in actions {
            let ActionKind::Winch(names, rate, to) = &action.what else { continue };
            for name in names {
                let key = Model::key(name);
                let Some(now) = model.connectors.get(&key).and_then(|c| model.first_length(c)) else { continue };
                let paid = to.unwrap_or(now + rate.max(0.0) * observed);
                let most = longest.entry(key).or_insert(now);
                // winches that follow one another add up
                *most = if to.is_some() { most.max(paid) } else { *most + (paid - now).max(0.0) };
            }
        }
        RunRequirements { balance, longest, freed: BTreeSet::new(), scheme }
    }

    /// Lets the first end of a line go, or holds it again; whether that is other than it was.
    pub fn set_end_released(&mut self, name: &str, free: bool) -> bool {
        let key = Model::key(name);
        if free { self.freed.insert(key) } else { self.freed.remove(&key) }
    }

    /// What is asked of a connector.
    pub fn requirement(&self, name: &str) -> RunRequirement {
        let key = Model::key(name);
        RunRequirement {
            longest: self.longest.get(&key).copied(),
            balance: self.balance,
            freed: self.freed.contains(&key),
            scheme: self.scheme,
        }
    }
}
