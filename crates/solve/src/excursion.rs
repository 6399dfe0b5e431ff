//! A body moved along a horizontal direction until a line breaks: what its connectors do to it on the way.

use super::equilibrium::{EquilibriumOptions as Rest, equilibrium};
use super::offset::{BodyConnectors, ConnectorPull};
use super::system::{SolveError, System, SystemState};
use nalgebra::Vector3;
use windlass_base::pose::{Pose, Six};
use windlass_base::units::Dim;
use windlass_model::{ClassError, ConnectorSummary};

/// How a body is moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExcursionPath {
    /// The body's number.
    pub body: usize,
    /// The direction, from +X toward +Y (rad).
    pub direction: f64,
    /// Whether all else comes to rest at every excursion: the body across the direction, up and down and about its axes,
    /// and the other bodies. Without it they stay.
    pub free: bool,
    /// The largest excursion (m); none: until a line breaks.
    pub most: Option<f64>,
}

/// A body at an excursion.
#[derive(Clone, Debug, PartialEq)]
pub struct ExcursionStep {
    /// The excursion along the direction (m).
    pub excursion: f64,
    /// Poses of all bodies.
    pub poses: Vec<Pose>,
    /// Forces and moments of the connectors on the body about its origin, global axes.
    pub wrench: Six,
    /// What is reported of each of its connectors.
    pub lines: Vec<ConnectorSummary>,
}

impl ExcursionStep {
    /// The largest T/break of its connectors, and the number of the one that has it.
    pub fn worst(&self) -> Option<(f64, usize)> {
        worst(&self.lines)
    }

    fn overload(&self) -> f64 {
        self.worst().map_or(-1.0, |(ratio, _)| ratio - 1.0)
    }
}

/// The largest T/break of connectors, and the number of the first that has it but for rounding.
pub fn worst(lines: &[ConnectorSummary]) -> Option<(f64, usize)> {
    let ratios = lines.iter().enumerate().filter_map(|(i, l)| Some((l.ratio?, i)));
    ratios.fold(None, |worst, one| match worst {
        Some((ratio, _)) if one.0 <= ratio * (1.0 + EQUAL_RATIOS) => worst,
        _ => Some(one),
    })
}

/// Where a path ends.
#[derive(Clone, Debug, PartialEq)]
pub enum ExcursionEnd {
    /// This connector breaks.
    Breaks(usize),
    /// The largest excursion asked for.
    Most,
    /// Farther on there is no answer, for this reason.
    Lost(SolveError),
}

/// Ratios that differ by less are those of lines that stand alike.
const EQUAL_RATIOS: f64 = 1e-9;
/// Most steps in which a free body is taken from one excursion to the next.
const MAX_STRIDES: f64 = 200.0;
/// Largest share of the size of the mooring in one step of the search, and in one step of a body that is free.
const MAX_STEP_SHARE: f64 = 0.05;
/// A body without a break is not moved farther than so many sizes of its mooring.
const MAX_EXCURSION_SIZES: f64 = 10.0;

/// A line breaks where its tension is its breaking tension to this share.
const BREAK_TOLERANCE: f64 = 1e-13;

/// A body on its way.
#[derive(Debug)]
pub struct ExcursionSearch<'a> {
    system: &'a System,
    path: ExcursionPath,
    from: Vec<Pose>,
    along: Vector3<f64>,
    connectors: BodyConnectors,
    size: f64,
    /// What follows the bodies where they are free.
    state: SystemState,
}

impl<'a> ExcursionSearch<'a> {
    /// A body of a system, with all bodies where a state has them.
    ///
    /// # Errors
    /// A body without connectors.
    pub fn new(system: &'a System, start: &[Pose], path: ExcursionPath) -> Result<Self, SolveError> {
        let connectors = BodyConnectors::on_body(system, path.body)?;
        let from = start.to_vec();
        let size = connectors.size(system, &from).max(1.0);
        let along = Vector3::new(path.direction.cos(), path.direction.sin(), 0.0);
        let state = SystemState::from_poses(from.clone());
        Ok(ExcursionSearch { system, path, from, along, connectors, size, state })
    }

    /// Names of the body's connectors.
    pub fn names(&self) -> Vec<String> {
        self.connectors.names(self.system).map(str::to_string).collect()
    }

    /// The body at an excursion (m); free bodies go there from where they are.
    ///
    /// # Errors
    /// A connector without an answer there, bodies that do not come to rest.
    pub fn move_to(&mut self, excursion: f64) -> Result<ExcursionStep, SolveError> {
        let body = self.path.body;
        let start = self.from[body];
        if self.path.free {
            let before: Vec<Pose> = self.state.poses.clone();
            let gone = (before[body].origin - start.origin).dot(&self.along);
            let strides = ((excursion - gone).abs() / (MAX_STEP_SHARE * self.size)).ceil().clamp(1.0, MAX_STRIDES);
            for n in 1..=strides as usize {
                let to = if n as f64 >= strides { excursion } else { gone + (excursion - gone) * n as f64 / strides };
                if let Err(error) = self.find_equilibrium(start, to) {
                    self.state = SystemState::from_poses(before);
                    return Err(error);
                }
            }
        } else if let Some(pose) = self.state.poses.get_mut(body) {
            pose.origin = start.origin + self.along * excursion;
        }
        let mut pull = ConnectorPull::default();
        self.connectors.pull(self.system, &self.state.poses, &mut pull)?;
        let lines = self.connectors.summaries(self.system, &self.state.poses)?;
        Ok(ExcursionStep { excursion, poses: self.state.poses.clone(), wrench: pull.wrench, lines })
    }

    /// Puts the body at an excursion and lets all else come to rest.
    fn find_equilibrium(&mut self, start: Pose, excursion: f64) -> Result<(), SolveError> {
        let held = Some((self.path.body, self.path.direction));
        if let Some(pose) = self.state.poses.get_mut(self.path.body) {
            let off = excursion - (pose.origin - start.origin).dot(&self.along);
            pose.origin += self.along * off;
        }
        equilibrium(self.system, &mut self.state, &Rest { held, ..Rest::default() }).map(|_| ())
    }

    /// All bodies where they were.
    pub fn restore_start(&mut self) {
        self.state = SystemState::from_poses(self.from.clone());
    }

    /// The end of the path: the first line to break, or the largest excursion.
    ///
    /// # Errors
    /// No answer where the body is; nothing that breaks, and no largest excursion.
    pub fn end(&mut self) -> Result<(ExcursionStep, ExcursionEnd), SolveError> {
        let mut here = self.move_to(0.0)?;
        if let Some((_, line)) = here.worst().filter(|(ratio, _)| *ratio >= 1.0) {
            return Ok((here, ExcursionEnd::Breaks(line)));
        }
        if here.worst().is_none() && self.path.most.is_none() {
            return Err(self.endless("none of its connectors has a breaking tension"));
        }
        let mut stride = 1e-3 * self.size;
        let most = self.path.most.unwrap_or(f64::INFINITY);
        while here.excursion < most {
            if here.excursion > MAX_EXCURSION_SIZES * self.size && most.is_infinite() {
                return Err(self.endless("none of its lines breaks"));
            }
            let next = (here.excursion + stride).min(most);
            match self.move_to(next) {
                Ok(there) if there.overload() >= 0.0 => return self.breaking(here, there),
                Ok(there) => {
                    here = there;
                    stride *= 1.6;
                    // so far that a break is looked for in steps
                    if here.excursion <= MAX_EXCURSION_SIZES * self.size {
                        stride = stride.min(MAX_STEP_SHARE * self.size);
                    }
                }
                Err(error) if stride < 1e-9 * self.size => {
                    return if here.excursion > 0.0 { Ok((here, ExcursionEnd::Lost(error))) } else { Err(error) };
                }
                Err(_) => stride *= 0.25,
            }
        }
        Ok((here, ExcursionEnd::Most))
    }

    fn endless(&self, why: &str) -> SolveError {
        let who = self.system.nodes.get(self.path.body).map(|n| n.name.clone());
        let far = MAX_EXCURSION_SIZES * self.size;
        let error = ClassError::with_values(format!("{why} within {{}}"), &[(far, Dim::Length)]);
        SolveError { who, error: error.help("-DISTANCE says how far it is moved") }
    }

    /// The excursion at which the first line breaks, between one that holds and one that does not:
    /// [RIDDERS-1979], which is exact for a tension that grows exponentially.
    fn breaking(
        &mut self,
        holds: ExcursionStep,
        broken: ExcursionStep,
    ) -> Result<(ExcursionStep, ExcursionEnd), SolveError> {
        let (mut low, mut high) = (holds, broken);
        for _ in 0..100 {
            let width = high.excursion - low.excursion;
            let close = high.overload().min(-low.overload()) <= BREAK_TOLERANCE;
            if close || width <= 4.0 * f64::EPSILON * high.excursion.max(1e-3 * self.size) {
                break;
            }
            let middle = self.move_to(low.excursion + 0.5 * width)?;
            let (below, between, above) = (low.overload(), middle.overload(), high.overload());
            let root = (between * between - below * above).sqrt();
            // below is negative and above positive: the root lies between them
            let guess = middle.excursion - 0.5 * width * between / root;
            if between >= 0.0 {
                high = middle
            } else {
                low = middle
            }
            if guess > low.excursion && guess < high.excursion {
                let there = self.move_to(guess)?;
                if there.overload() >= 0.0 { high = there } else { low = there }
            }
        }
        let nearest = if high.overload() <= -low.overload() { high } else { low };
        let line = nearest.worst().map_or(0, |(_, line)| line);
        Ok((nearest, ExcursionEnd::Breaks(line)))
    }

    /// Equal steps from where the body is to the end of its path, `rows` in all.
    ///
    /// # Errors
    /// As [`ExcursionSearch::end`] and [`ExcursionSearch::move_to`].
    pub fn rows(&mut self, rows: usize) -> Result<(Vec<ExcursionStep>, ExcursionEnd), SolveError> {
        let (last, end) = self.end()?;
        self.restore_start();
        let count = if last.excursion > 0.0 { rows.max(2) - 1 } else { 0 };
        let step = |n: usize| last.excursion * n as f64 / count.max(1) as f64;
        let mut list = (0..count).map(|n| self.move_to(step(n))).collect::<Result<Vec<_>, _>>()?;
        list.push(last);
        Ok((list, end))
    }
}

/// Restoring force along a direction (from +X toward +Y, rad), positive when it pushes back; the force across it,
/// toward its left; and upward (N).
pub fn resolve_wrench(wrench: &Six, direction: f64) -> [f64; 3] {
    let (sin, cos) = direction.sin_cos();
    let (x, y) = (wrench[0], wrench[1]);
    [-(x * cos + y * sin), y * cos - x * sin, wrench[2]]
}
