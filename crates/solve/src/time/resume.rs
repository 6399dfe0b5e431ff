//! A run that goes on from a snapshot, and how it knows its own.

use super::action::Action;
use super::run::Run;
use super::run_settings::RunSettings;
use super::snapshot::Snapshot;
use crate::system::SolveError;
use windlass_model::{ClassError, Model};
use windlass_signal::SeriesError;

/// FNV-1a, 64 bits (Fowler, Noll, Vo; RFC 9923): the same on every machine.
#[derive(Clone, Copy)]
struct Fingerprint(u64);

impl Fingerprint {
    fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn numbers<'a>(&mut self, values: impl IntoIterator<Item = &'a f64>) {
        values.into_iter().for_each(|v| self.bytes(&v.to_bits().to_le_bytes()));
    }
}

impl Run {
    /// A number that another model, environment, step or scheme does not have: of names, of the forces and their changes at the
    /// start, of the waves, of what happens. Names and comments of the input do not count.
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint_with(self.settings.balance)
    }

    /// The same with or without the energy balance of its lines.
    pub fn fingerprint_with(&self, balance: bool) -> u64 {
        self.fingerprint_of(balance, &self.actions)
    }

    /// That of the same run with other actions.
    pub fn fingerprint_with_actions(&self, actions: &[Action]) -> u64 {
        self.fingerprint_of(self.settings.balance, actions)
    }

    fn fingerprint_of(&self, balance: bool, actions: &[Action]) -> u64 {
        let mut made = Fingerprint(0xcbf2_9ce4_8422_2325);
        for (name, _) in &self.history.layout.bodies {
            made.bytes(name.to_ascii_uppercase().as_bytes());
        }
        for link in &self.history.layout.links {
            made.bytes(link.name.to_ascii_uppercase().as_bytes());
        }
        let forces = &self.now.forces;
        made.numbers(forces.sum.iter().chain(forces.stiffness.iter()).chain(forces.damping.iter()));
        for motion in &self.now.motions {
            made.numbers(motion.pose.origin.iter().chain(motion.pose.axes.iter()).chain(motion.acceleration.iter()));
        }
        if let Some(sea) = &self.sea {
            for c in &sea.components {
                made.numbers([c.frequency, c.number, c.amplitude, c.phase].iter().chain(&c.toward));
            }
            made.numbers(&[sea.ramp, sea.ramp_start]);
        }
        let RunSettings { dt, method, convergence, adaptive, .. } = &self.settings;
        made.numbers(&[self.start(), *dt, convergence.tolerance, adaptive.unwrap_or(0.0)]);
        made.bytes(format!("{method:?} {actions:?}").as_bytes());
        made.numbers(self.model.parameters.dividing.as_slice());
        // they stand in what lines remember
        if balance && self.system.links.iter().any(|l| l.is_dynamic()) {
            made.bytes(b"balance");
        }
        made.0
    }

    /// A run that goes on from a snapshot of an earlier run of the same model, environment and actions.
    ///
    /// # Errors
    /// As [`Run::new`]; a snapshot of another system.
    pub fn resume(
        model: &Model,
        settings: RunSettings,
        actions: Vec<Action>,
        (snapshot, rows): (&Snapshot, Vec<f64>),
    ) -> Result<Run, SolveError> {
        let mut run = Run::new(model, settings, actions)?;
        run.resume_from(snapshot, rows)?;
        Ok(run)
    }

    /// Goes on from a snapshot, with the rows up to it.
    ///
    /// # Errors
    /// A snapshot of another system.
    pub fn resume_from(&mut self, snapshot: &Snapshot, rows: Vec<f64>) -> Result<(), SolveError> {
        let other = || SolveError::new(ClassError::new("what was kept is of another system"));
        let mut happened: Vec<(f64, usize)> =
            snapshot.fired.iter().enumerate().filter_map(|(i, f)| f.map(|t| (t, i))).collect();
        happened.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (time, index) in happened {
            let what = self.actions.get(index).ok_or_else(other)?.what.clone();
            self.now.time = time;
            self.change(&what)?;
        }
        let links: Vec<String> = self.history.layout.links.iter().map(|l| l.name.clone()).collect();
        for (name, length) in links.iter().zip(&snapshot.lengths) {
            let Some(connector) = self.model.connectors.get_mut(&Model::key(name)) else { continue };
            if connector.first_length != *length {
                connector.first_length = *length;
                self.system.rebuild_connector(&self.model, name)?;
            }
        }
        // winches are not compared: one that has reached its length is no longer among them
        let fits = self.now.motions.len() == snapshot.motions.len()
            && self.now.memory.loads.len() == snapshot.loads.len()
            && self.system.states.len() == snapshot.states.len()
            && self.near.len() == snapshot.near.len()
            && links.len() == snapshot.lengths.len()
            && self.fired.len() == snapshot.fired.len();
        if !fits {
            return Err(other());
        }
        self.now.time = snapshot.time;
        self.now.motions.clone_from(&snapshot.motions);
        self.now.memory.loads.clone_from(&snapshot.loads);
        self.system.states.clone_from(&snapshot.states);
        self.fired.clone_from(&snapshot.fired);
        self.winches.clone_from(&snapshot.winches);
        self.near.clone_from(&snapshot.near);
        self.taken = snapshot.taken;
        self.counts = snapshot.counts;
        self.accuracy.clone_from(&snapshot.accuracy);
        self.clear_caches();
        self.history.values = rows;
        let wrong = |e: SeriesError| SolveError::new(ClassError::new(e.to_string()));
        for row in self.history.rows() {
            self.statistics.take(row).map_err(wrong)?;
        }
        Ok(())
    }
}
