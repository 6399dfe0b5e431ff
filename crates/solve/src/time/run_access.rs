//! What can be seen of a run from outside, and all that is needed to go on from where it is.

use super::accuracy::WorstFollowed;
use super::forces::BodyMotion;
use super::run::Run;
use super::snapshot::Snapshot;
use crate::link::Link;
use crate::system::SystemBody;
use windlass_hydro::Category;
use windlass_hydro::sea::Sea;
use windlass_model::{EnergyBalance, Model};

impl Run {
    /// Time reached (s).
    pub fn time(&self) -> f64 {
        self.now.time
    }

    /// The motion that its steps follow worst, of those that are large enough to count; none where nothing moved.
    pub fn worst_followed(&self) -> Option<WorstFollowed> {
        self.accuracy.worst(&self.system, &self.now.motions, &self.settings.method)
    }

    /// Whether a dynamic line acts now.
    pub fn has_dynamic_lines(&self) -> bool {
        self.system.links.iter().any(|l| l.is_dynamic())
    }

    /// The energy balance of the dynamic lines, by name, where it is kept.
    pub fn balance(&self) -> Vec<(String, EnergyBalance)> {
        let of = |link: &Link| {
            let state = &self.system.states[link.states.clone()];
            link.element.as_dynamic()?.energy_balance(state).map(|balance| (link.name.clone(), balance))
        };
        self.system.links.iter().filter_map(of).collect()
    }

    /// Names of the bodies that wave drift acts on.
    pub fn drifting_bodies(&self) -> impl Iterator<Item = &str> {
        let drifts = |node: &&SystemBody| node.floating.loads.iter().any(|load| load.category() == Category::WaveDrift);
        self.system.nodes.iter().filter(drifts).map(|node| node.name.as_str())
    }

    /// Number of degrees of freedom that move.
    pub fn free_degrees(&self) -> usize {
        self.system.nodes.iter().flat_map(|node| node.free).filter(|free| *free).count()
    }

    /// Motions now.
    pub fn motions(&self) -> &[BodyMotion] {
        &self.now.motions
    }

    /// The sea at a time (s) of the run: actions may have changed it.
    pub fn sea_at(&self, time: f64) -> Option<&Sea> {
        let found = self.seas.iter().rev().find(|(since, _)| *since <= time).or(self.seas.first());
        found.and_then(|(_, sea)| sea.as_deref())
    }

    /// Everything needed to go on from here.
    pub fn snapshot(&self) -> Snapshot {
        let lengths = self.history.layout.links.iter().map(|l| self.model.connectors.get(&Model::key(&l.name)));
        Snapshot {
            time: self.now.time,
            taken: self.taken,
            motions: self.now.motions.clone(),
            loads: self.now.memory.loads.clone(),
            states: self.system.states.clone(),
            lengths: lengths.map(|c| c.and_then(|c| c.first_length)).collect(),
            fired: self.fired.clone(),
            winches: self.winches.clone(),
            near: self.near.clone(),
            rows: self.history.len(),
            counts: self.counts,
            accuracy: self.accuracy.clone(),
        }
    }
}
