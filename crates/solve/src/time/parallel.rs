//! Dynamic lines, evaluated side by side: each by itself, so that the number of threads changes nothing.

use super::forces::{BodyForces, BodyMotion};
use crate::system::System;
use windlass_hydro::parts::for_each_part;
use windlass_model::{ClassError, ConnectorResponse, End, Situation, SolverCache, TimeStep};

/// One of them, with what its evaluation needs and finds.
#[derive(Default)]
pub(super) struct LineTask {
    /// Its number among the connectors.
    pub link: usize,
    pub ends: Vec<End>,
    pub cache: SolverCache,
    pub response: ConnectorResponse,
    pub failed: Option<ClassError>,
}

impl std::fmt::Debug for LineTask {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("LineTask").field("link", &self.link).field("ends", &self.ends).finish_non_exhaustive()
    }
}

impl BodyForces {
    /// Evaluates the dynamic lines.
    pub(super) fn evaluate_dynamic_lines(
        &mut self,
        system: &System,
        motions: &[BodyMotion],
        TimeStep { time, dt }: TimeStep,
    ) {
        if !self.has_dynamic_lines {
            self.line_tasks.clear();
            return;
        }
        let dynamic_lines = || system.links.iter().enumerate().filter(|(_, l)| l.is_dynamic());
        self.line_tasks.resize_with(dynamic_lines().count(), LineTask::default);
        let (mut tasks, mut trial) = (std::mem::take(&mut self.line_tasks), std::mem::take(&mut self.trial));
        let (mut lines, mut others, mut from) = (Vec::with_capacity(tasks.len()), trial.as_mut_slice(), 0);
        for (one, (index, link)) in tasks.iter_mut().zip(dynamic_lines()) {
            self.place_ends(link, motions);
            one.link = index;
            one.ends.clone_from(&self.ends);
            one.cache = self.caches.get_mut(index).map(SolverCache::take).unwrap_or_default();
            // states stand in the order of connectors
            let (_, own) = std::mem::take(&mut others).split_at_mut(link.states.start - from);
            let (own, behind) = own.split_at_mut(link.states.len());
            (others, from) = (behind, link.states.end);
            lines.push((one, own));
        }
        evaluate(system, &mut lines, Some(TimeStep { time, dt }));
        self.trial = trial;
        for one in &mut tasks {
            if let Some(cache) = self.caches.get_mut(one.link) {
                *cache = one.cache.take();
            }
        }
        self.line_tasks = tasks;
    }
}

/// Evaluates them at the end of a step; `step` as of [`Situation`].
fn evaluate(system: &System, lines: &mut [(&mut LineTask, &mut [f64])], step: Option<TimeStep>) {
    let one = |(line, trial): &mut (&mut LineTask, &mut [f64])| {
        let Some(link) = system.links.get(line.link) else { return };
        let at = Situation { ends: &line.ends, step, surroundings: &system.surroundings };
        let committed = &system.states[link.states.clone()];
        let made = link.element.evaluate(&at, committed, trial, &mut line.cache, &mut line.response);
        line.failed = made.err();
    };
    for_each_part(lines.len(), lines.iter_mut(), one);
}
