//! What a dynamic line reports of itself: its nodes, modes and energy balance.

use super::describe::LinePart;
use super::element::DynamicLine;
use super::mesh::{max_payout_step, to_class_error};
use super::modes;
use super::rod_cache::RodCache;
use std::f64::consts::PI;
use windlass_line_dynamics::{RodSettings, RodSolver};
use windlass_model::{
    ClassError, ConnectorSummary, DynamicConnector, EnergyBalance, LineMode, LineNode, LineSide, NodalConnector, Note,
    Situation, SolverCache,
};

/// Longest elements at an end that is held, by sqrt(EI/T), of which nothing is said: moment there is then 3 % low.
const COARSE_MESH_RATIO: f64 = 0.5;

impl NodalConnector for DynamicLine {
    fn max_nodes(&self) -> usize {
        self.layout.elements + 1
    }

    fn has_bending(&self) -> bool {
        self.base.rod.segments().iter().any(|s| s.bending > 0.0 || s.tube.is_some())
    }

    fn find_nodes(&self, at: &Situation, state: &[f64], out: &mut Vec<LineNode>) -> Result<(), ClassError> {
        let paid = self.layout.payout(state)?;
        let (other, state, still) = self.where_it_is(at, state)?;
        let rod = other.as_ref().unwrap_or(&self.base.rod);
        let ends = self.end_conditions(at.ends, still)?;
        *out = self
            .with_environment(at, still, paid, &mut Vec::new(), |environment| rod.results(&state, environment, &ends));
        // the class speaks of its records, of which a rod may have several segments, and a pipe all of the first
        let record = |segment| if self.base.laid.is_some() { 0 } else { self.base.bands.part_of(segment) };
        for node in out.iter_mut() {
            node.segment = record(node.segment);
            let before = node.before.map(|b| LineSide { segment: record(b.segment), ..b });
            node.before = before.filter(|b| b.segment != node.segment);
        }
        self.take_middle_end_tension(out);
        Ok(())
    }

    fn find_row_nodes(
        &self,
        at: &Situation,
        state: &[f64],
        cache: &mut SolverCache,
        out: &mut Vec<LineNode>,
    ) -> Result<(), ClassError> {
        let (Some(kept), Some(cache)) = (self.layout.read(state)?, self.rod_cache(cache)) else {
            return self.find_nodes(at, state, out);
        };
        let ends = self.end_conditions(at.ends, at.step.is_none())?;
        let is_end = cache.has_end(state);
        if !is_end {
            if self.rod_with_mesh(&kept, &cache.rod)?.is_some() {
                return self.find_nodes(at, state, out);
            }
            cache.forget_start();
            cache.state.unpack_into(&cache.rod, kept.motion).map_err(to_class_error)?;
        }
        let RodCache { rod, state, solver, flows, .. } = cache;
        let (state, sampled) = if is_end { (solver.end(), Some(solver.fluid())) } else { (&*state, None) };
        self.with_environment(at, at.step.is_none(), kept.paid, flows, |environment| {
            rod.row(state, environment, &ends, sampled, out);
        });
        self.take_middle_end_tension(out);
        Ok(())
    }
}

impl DynamicConnector for DynamicLine {
    fn energy_balance(&self, state: &[f64]) -> Option<EnergyBalance> {
        let found = self.layout.balance(state)?;
        let (e, w) = (&found.energy, &found.work);
        Some(EnergyBalance {
            energy: [e.kinetic, e.elastic, e.gravity, e.bottom + e.supports],
            work: [w.ends[0], w.ends[1], w.fluid + w.given, w.damping, w.bottom + w.supports],
            energy_error: found.energy_error(),
            turnover: found.turnover,
            momentum_error: found.momentum_error(),
        })
    }

    fn natural_modes(&self, at: &Situation, state: &[f64], number: usize) -> Result<Vec<LineMode>, ClassError> {
        modes::check_mode_count(self.base.rod.nodes(), number)?;
        let paid = self.layout.payout(state)?;
        let (other, state, _) = self.where_it_is(at, state)?;
        let rod = other.as_ref().unwrap_or(&self.base.rod);
        let ends = self.end_conditions(at.ends, true)?;
        let mut solver = RodSolver::new(rod, RodSettings::default());
        self.with_environment(at, true, paid, &mut Vec::new(), |environment| {
            modes::find_line_modes(rod, &mut solver, &state, environment, ends, number)
        })
    }

    fn max_payout_step(&self) -> f64 {
        max_payout_step(self.nominal)
    }

    /// That it rests without the friction that the bottom has.
    fn static_caution(&self, at: &Situation) -> Option<&'static str> {
        if !self.base.ground.holds_at_rest() {
            return None;
        }
        let mut cache = RodCache::new(&self.base);
        let slid = self.find_rest(at, &mut cache).is_ok() && cache.solver.has_slid_without_friction();
        slid.then_some(
            "friction of the bottom at rest is left out, but against sliding down a slope: no rest was found with it",
        )
    }
}

impl DynamicLine {
    /// Gives the ends the tension in the middle of their elements, of a line that reports it so.
    fn take_middle_end_tension(&self, nodes: &mut [LineNode]) {
        if !self.base.description.has_middle_end_tension {
            return;
        }
        let of = |pair: Option<&[LineNode; 2]>| pair.map_or(0.0, |[a, b]| 0.5 * (b.effective - a.effective));
        let changes = [of(nodes.first_chunk()), -of(nodes.last_chunk())];
        let add = |node: Option<&mut LineNode>, change: f64| {
            if let Some(node) = node {
                node.effective += change;
                node.wall += change;
            }
        };
        add(nodes.first_mut(), changes[0]);
        add(nodes.last_mut(), changes[1]);
    }

    /// What is said of ends that are held where elements are too long for the bending there, which fades over sqrt(EI/T).
    fn coarse_mesh_notes(&self, nodes: &[LineNode]) -> Vec<Note> {
        let parts = &self.base.description.parts;
        let of = |part: Option<&LinePart>, pair: Option<&[LineNode; 2]>, name: &str| {
            let (part, [a, b]) = (part?, pair?);
            let fades = (part.segment.bending / a.effective.max(b.effective).max(f64::MIN_POSITIVE)).sqrt();
            let share = (b.arc - a.arc) / fades;
            (share > COARSE_MESH_RATIO).then(|| {
                Note::warning(format!(
                    "elements at its {name} end, which is held, are {share:.1} sqrt(EI/T) long: moment and shear \
                     there are too small; -REFINE makes them shorter"
                ))
            })
        };
        let [first, second] = &self.base.holds;
        let first = first.and_then(|_| of(parts.first(), nodes.first_chunk(), "first"));
        let second = second.and_then(|_| of(parts.last(), nodes.last_chunk(), "second"));
        first.into_iter().chain(second).collect()
    }

    /// What is said of segments with elements that are pushed harder than one with hinged ends bears: they are straight between their
    /// nodes, and buckle at nodes alone.
    fn stocky_element_notes(&self, nodes: &[LineNode]) -> Vec<Note> {
        let beyond = |number: usize, part: &LinePart| {
            let mut own = nodes.array_windows().filter(|[a, _]| a.segment == number);
            let euler = |length: f64| PI.powi(2) * part.segment.bending / length.powi(2);
            part.segment.bending > 0.0 && own.any(|[a, b]| -0.5 * (a.effective + b.effective) > euler(b.arc - a.arc))
        };
        let parts = self.base.description.parts.iter().enumerate();
        let notes = parts.filter(|(number, part)| beyond(*number, part)).map(|(number, _)| {
            Note::warning(format!(
                "elements of its segment {} are pushed beyond Euler's load of their length: they cannot bend between \
                 nodes; -REFINE makes them shorter",
                number + 1
            ))
        });
        notes.collect()
    }

    pub(super) fn summarize(&self, at: &Situation, committed: &[f64]) -> Result<ConnectorSummary, ClassError> {
        let mut nodes = Vec::new();
        self.find_nodes(at, committed, &mut nodes)?;
        let notes = self.base.description.notes.iter().map(|n| n.as_str().into()).collect();
        let mut summary = ConnectorSummary { solution: "rod", notes, ..ConnectorSummary::default() };
        summary.tension = nodes.first().map(|n| n.effective);
        let sides = nodes.iter().flat_map(|n| n.sides().map(move |s| (n.effective, s.segment)));
        let parts = &self.base.description.parts;
        let ratio = |(pull, segment): (f64, usize)| {
            let strength = parts.get(segment)?.strength;
            Some((pull / strength.breaking, segment + 1, strength.is_given))
        };
        let ratios: Vec<_> = sides.filter_map(ratio).collect();
        let largest = |list: &mut dyn Iterator<Item = &(f64, usize, bool)>| {
            list.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(ratio, segment, _)| (*ratio, *segment))
        };
        summary.over_given_break = largest(&mut ratios.iter().filter(|(.., given)| *given));
        if let Some((ratio, segment)) = largest(&mut ratios.iter()) {
            (summary.ratio, summary.critical) = (Some(ratio), Some(segment));
            if ratio > 1.0 {
                summary.notes.push(Note::warning("the line is beyond its breaking tension"));
            }
        }
        summary.notes.extend(self.coarse_mesh_notes(&nodes));
        summary.notes.extend(self.stocky_element_notes(&nodes));
        if at.step.is_none() {
            summary.notes.extend(self.static_caution(at).map(Note::warning));
        }
        let lies = |pair: &[LineNode]| pair.iter().all(|n| n.clearance <= 0.0);
        summary.grounded = Some(nodes.windows(2).filter(|p| lies(p)).map(|p| p[1].arc - p[0].arc).sum());
        Ok(summary)
    }
}
