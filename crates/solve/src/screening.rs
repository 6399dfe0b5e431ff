//! Quasi-static lines of a run, replayed as dynamic lines.
//!
//! A quasi-static line has the shape of rest between its ends at every instant: its own inertia and the drag of the water on it are left
//! out. Where they matter, tensions are larger by up to several times [DNV-OS-E301 ch. 2 sec. 2; API-RP-2SK 5.4]. After a run the most
//! loaded of these lines are run again as dynamic lines, one by one, with their ends moved as the run had them, in the water of the run.
//!
//! - Which: the [`REPLAYED_LINES`] lines with the largest tension over break behind the transient, of those whose class has dynamics.
//! - When: ten periods around the largest tension, cut at the ends of the run. The period is the energy period of the waves,
//!   T(-1,0) = m(-1)/m(0); without waves the mean up-crossing period of the tension.
//! - Start: at rest between the mean places of the ends, whose motion about these grows over the two periods before the ten. Where the run
//!   is not that old the replay begins with it, at rest, with the motion as it was.
//! - Mesh and step: elements of at most 20 m, at least 60 and at most 200; a hundredth of the period.
//!
//! Between stored instants ends move along the polynomials of fifth degree that have place, velocity and acceleration of both. What the line
//! would do to the bodies, were it a dynamic line in the run, is not found.

use crate::link::{EndAttachment, end_attachments};
use crate::time::{BodyMotion, LinkColumns, RowLayout, Run, VALUES_PER_BODY, end_of};
use nalgebra::Vector3;
use std::f64::consts::TAU;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_hydro::ambient;
use windlass_model::{
    ClassError, Connector, ConnectorElement, ConnectorResponse, End, Model, RunRequirement, Situation, SolverCache,
    Surroundings, TimeStep, list_names,
};
use windlass_signal::statistics::crossings;

/// Lines that are replayed.
pub const REPLAYED_LINES: usize = 3;
/// Ratio of largest tensions above which a line is warned of.
pub const LARGEST_RATIO: f64 = 1.1;
/// Periods of a replay around the largest tension, and those before over which the motion grows.
const REPLAY_PERIODS: f64 = 10.0;
const RAMP_PERIODS: f64 = 2.0;
/// Steps of a replay in a period: the scheme of dynamic lines then damps less than 0.01 % of critical.
const STEPS_PER_PERIOD: f64 = 100.0;
/// Stored instants that a period needs at least for its motion to be known between them: the polynomials of fifth degree miss a sine by
/// `(2 pi/n)^6 / 46080` of its amplitude, 9e-5 of one of the period and 6e-3 of one of half of it.
const LEAST_INSTANTS: f64 = 5.0;
/// Longest elements (m), and least and most of them.
const MAX_ELEMENT_LENGTH_M: f64 = 20.0;
const ELEMENTS: [usize; 2] = [60, 200];
/// How often a step is halved.
const MAX_STEP_HALVINGS: u32 = 6;

/// A line that was replayed.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// Its name.
    pub line: String,
    /// The times between which tensions are compared (s).
    pub window: [f64; 2],
    /// The period (s).
    pub period: f64,
    /// Elements of the dynamic line.
    pub elements: usize,
    /// Steps, those over which the motion grows counted.
    pub steps: usize,
    /// Largest tension of the quasi-static line there (N).
    pub quasi_static: f64,
    /// Largest tension of the dynamic line there (N), and when (s).
    pub dynamic: (f64, f64),
}

impl Replay {
    /// Largest tension of the dynamic line over that of the quasi-static one (both N).
    pub fn ratio(&self) -> f64 {
        self.dynamic.0 / self.quasi_static
    }
}

/// What came of the replays of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Screening {
    /// The lines that were replayed, the most loaded first.
    pub replays: Vec<Replay>,
    /// More loaded lines than the least of these that could not be, with the reason.
    pub left: Vec<(String, ClassError)>,
}

/// The lines that a run took quasi-statically, by their numbers in its layout.
fn quasi_static(run: &Run) -> Vec<usize> {
    let is_quasi_static = |link: &LinkColumns| {
        run.model.connectors.get(&Model::key(&link.name)).is_some_and(|c| run.model.is_quasi_static(c))
    };
    let links = run.history.layout.links.iter().enumerate();
    links.filter(|(_, link)| is_quasi_static(link)).map(|(number, _)| number).collect()
}

/// The names of the lines that a run took quasi-statically.
pub fn quasi_static_lines(run: &Run) -> Vec<&str> {
    let name = |number: usize| run.history.layout.links.get(number).map(|l| l.name.as_str());
    quasi_static(run).into_iter().filter_map(name).collect()
}

/// Replays the most loaded quasi-static lines of a run that kept its instants; `should_continue` is asked before each step, and false ends it.
pub fn screen(run: &Run, should_continue: &dyn Fn() -> bool) -> Screening {
    let mut made = Screening::default();
    for (number, peak) in by_load(run) {
        if made.replays.len() == REPLAYED_LINES {
            break;
        }
        let Some(link) = run.history.layout.links.get(number) else { continue };
        match replay(run, (number, link), peak, should_continue) {
            Ok(replay) => made.replays.push(replay),
            Err(error) => made.left.push((link.name.clone(), error)),
        }
    }
    made
}

/// The quasi-static lines that pulled behind the transient with the time of their largest tension (s): largest tension over break first.
fn by_load(run: &Run) -> Vec<(usize, f64)> {
    let mut found = Vec::new();
    for number in quasi_static(run) {
        let Some(link) = run.history.layout.links.get(number) else { continue };
        let of_it = |name: &str| name.strip_suffix(" Tension").is_some_and(|n| n == link.name);
        let seen =
            run.statistics.results().find(|(series, _)| of_it(&series.name)).and_then(|(_, seen)| seen.summary());
        let Some(most) = seen.map(|s| s.maximum).filter(|m| m.value > 0.0) else { continue };
        let class = run.model.connectors.get(&Model::key(&link.name)).map(|c| Model::key(&c.class));
        let class = class.and_then(|class| run.model.classes.get(&class));
        let breaking = class.and_then(|c| c.fatigue_segments().first().map(|s| s.breaking)).filter(|b| *b > 0.0);
        found.push((
            number,
            most.time,
            to_six_digits(breaking.map_or(0.0, |b| most.value / b)),
            to_six_digits(most.value),
        ));
    }
    found.sort_by(|a, b| b.2.total_cmp(&a.2).then(b.3.total_cmp(&a.3)).then(a.0.cmp(&b.0)));
    found.into_iter().map(|(number, time, ..)| (number, time)).collect()
}

/// A number to six digits: lines that are loaded alike but for rounding keep their order.
fn to_six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Replays one line around the time of its largest tension (s).
fn replay(
    run: &Run,
    (number, link): (usize, &LinkColumns),
    peak: f64,
    should_continue: &dyn Fn() -> bool,
) -> Result<Replay, ClassError> {
    let connector = run.model.connectors.get(&Model::key(&link.name));
    let connector = connector.ok_or_else(|| ClassError::new("it is no more in the model"))?;
    let period = period(run, number, peak)?;
    let motion = EndMotion::around_peak(run, (number, link), connector, (peak, period))?;
    let mut line = Twin::new(run, (link, connector), &motion)?;
    let dt = period / STEPS_PER_PERIOD;
    let steps = ((motion.window[1] - motion.begin) / dt - 1e-6).ceil().max(1.0) as usize;
    let mut dynamic = (f64::NEG_INFINITY, motion.begin);
    for step in 1..=steps {
        if !should_continue() {
            return Err(ClassError::new("the replay was interrupted"));
        }
        let time = (motion.begin + dt * step as f64).min(motion.window[1]);
        let tension = line.advance(&motion, time)?;
        if time >= motion.window[0] && tension > dynamic.0 {
            dynamic = (tension, time);
        }
    }
    let tensions = motion.rows.iter().filter(|row| row.time >= motion.window[0] && row.time <= motion.window[1]);
    let quasi_static = tensions.map(|row| row.tension).fold(f64::NEG_INFINITY, f64::max);
    let (line, window, elements) = (link.name.clone(), motion.window, line.elements);
    Ok(Replay { line, window, period, elements, steps, quasi_static, dynamic })
}

/// The period that a replay goes by (s).
fn period(run: &Run, link: usize, peak: f64) -> Result<f64, ClassError> {
    if let Some(sea) = run.sea_at(peak) {
        let squares =
            |power: i32| sea.components.iter().map(|c| c.amplitude.powi(2) * c.frequency.powi(power)).sum::<f64>();
        let (whole, behind) = (squares(0), squares(-1));
        if whole > 0.0 && behind.is_finite() {
            return Ok(TAU * behind / whole);
        }
    }
    let layout = &run.history.layout;
    let behind = |row: &&[f64]| row.first().is_some_and(|time| *time >= run.statistics_start());
    let (mut times, mut tensions) = (Vec::new(), Vec::new());
    for row in run.history.rows().filter(behind) {
        if let (Some(time), Some(tension), true) = (row.first(), layout.tension(link, row), acts(layout, link, row)) {
            times.push(*time);
            tensions.push(tension);
        }
    }
    let mean = tensions.iter().sum::<f64>() / tensions.len().max(1) as f64;
    let found = crossings(&times, &tensions, mean).ok().and_then(|c| c.period());
    found.ok_or_else(|| ClassError::new("its tension has no period: it does not cross its mean upward twice"))
}

/// Whether a connector acts in a row.
fn acts(layout: &RowLayout, link: usize, row: &[f64]) -> bool {
    let active = layout.links.get(link).and_then(|l| row.get(l.active));
    active.is_some_and(|a| *a > 0.0)
}

/// The ends of a line at a stored instant.
#[derive(Clone, Debug)]
struct StoredEnds {
    time: f64,
    ends: [End; 2],
    tension: f64,
}

/// How the ends of a line move in a replay.
#[derive(Debug)]
struct EndMotion {
    rows: Vec<StoredEnds>,
    /// Time at which the replay begins (s), and from when on the motion is that of the run.
    begin: f64,
    /// From when to when tensions are compared (s).
    window: [f64; 2],
    /// Mean places of the ends (m), where the motion grows.
    mean: [Vector3<f64>; 2],
    /// Time over which it grows (s); 0: the replay begins as the run did.
    growing: f64,
    /// Length of the first segment (m), where the run knew one.
    first_length: Option<f64>,
    /// The end whose pull is compared.
    pulled_end: usize,
}

impl EndMotion {
    /// That of the ends of a line around a time, for a period (s).
    fn around_peak(
        run: &Run,
        (number, link): (usize, &LinkColumns),
        connector: &Connector,
        (peak, period): (f64, f64),
    ) -> Result<Self, ClassError> {
        if let Some(assembly) = run.model.reeving(&connector.name) {
            return Err(ClassError::new(format!("it is a span of the line of {}", assembly.name)));
        }
        let layout = &run.history.layout;
        let known = link.ends.iter().position(Option::is_some);
        let pulled_end =
            if link.ends.get(link.pulling).is_some_and(Option::is_some) { Some(link.pulling) } else { known };
        let pulled_end = pulled_end.ok_or_else(|| ClassError::new("none of its ends is on a body"))?;
        let attached = end_attachments(&run.model, connector);
        // the stored instants around the peak at which it acts without a gap
        let near = |row: &&[f64]| {
            row.first().is_some_and(|t| (t - peak).abs() <= (REPLAY_PERIODS + RAMP_PERIODS + 1.0) * period)
        };
        let all: Vec<&[f64]> = run.history.rows().filter(near).collect();
        let at = all.iter().position(|row| row.first().is_some_and(|t| *t >= peak)).unwrap_or(0);
        let idle = |row: &&&[f64]| !acts(layout, number, row);
        let from = at - all.iter().take(at + 1).rev().take_while(|row| !idle(row)).count().saturating_sub(1).min(at);
        let until = at + all.iter().skip(at).take_while(|row| !idle(row)).count();
        let used = &all[from..until];
        let rows: Vec<StoredEnds> = used.iter().filter_map(|row| stored_ends(layout, number, &attached, row)).collect();
        let (Some(first), Some(last)) = (rows.first().map(|r| r.time), rows.last().map(|r| r.time)) else {
            return Err(ClassError::new("no instant around its largest tension is stored"));
        };
        let behind = first.max(run.statistics_start()).min(last);
        let begin = (peak - 0.5 * REPLAY_PERIODS * period).min(last - REPLAY_PERIODS * period).max(behind);
        let end = (begin + REPLAY_PERIODS * period).min(last);
        let spacing = rows.array_windows().map(|[a, b]| b.time - a.time).fold(0.0, f64::max);
        if !(spacing > 0.0 && spacing <= period / LEAST_INSTANTS) {
            let text = "its stored instants, {} apart, are too few for a period of {}";
            return Err(ClassError::with_values(text, &[(spacing, Dim::Time), (period, Dim::Time)])
                .help("-STORE keeps more instants"));
        }
        let ramped = begin - RAMP_PERIODS * period;
        let (start, growing) = if ramped > first { (ramped, RAMP_PERIODS * period) } else { (first, 0.0) };
        let within = |row: &&StoredEnds| row.time >= start && row.time <= end;
        let count = rows.iter().filter(within).count().max(1) as f64;
        let position = |side: usize| rows.iter().filter(within).map(|r| r.ends[side].pose.origin).sum::<Vector3<f64>>();
        let mean = [0, 1].map(|side| position(side) / count);
        let lengths: Vec<f64> =
            used.iter().filter_map(|row| row.get(link.active + 1).copied()).filter(|l| l.is_finite()).collect();
        if lengths.iter().any(|l| Some(l) != lengths.first()) {
            return Err(ClassError::new("a winch changes its length around its largest tension"));
        }
        Ok(EndMotion {
            rows,
            begin: start,
            window: [begin, end],
            mean,
            growing,
            first_length: lengths.first().copied(),
            pulled_end,
        })
    }

    /// The ends at a time (s).
    fn ends(&self, time: f64) -> Option<[End; 2]> {
        let after = self.rows.partition_point(|row| row.time <= time).clamp(1, self.rows.len().max(2) - 1);
        let (from, to) = (self.rows.get(after - 1)?, self.rows.get(after).or(self.rows.last())?);
        let made = [0, 1].map(|side| interpolate_ends((from.time, &from.ends[side]), (to.time, &to.ends[side]), time));
        if self.growing <= 0.0 || time >= self.begin + self.growing {
            return Some(made);
        }
        let share = smooth((time - self.begin) / self.growing);
        let [s, rate, faster] = [share[0], share[1] / self.growing, share[2] / self.growing.powi(2)];
        let mut grown = made;
        for (end, mean) in grown.iter_mut().zip(&self.mean) {
            let three = |six: &Six| six.fixed_rows::<3>(0).into_owned();
            let (off, v, a) = (end.pose.origin - mean, three(&end.velocity), three(&end.acceleration));
            end.pose.origin = mean + off * s;
            end.velocity = linear(&(v * s + off * rate));
            end.acceleration = linear(&(a * s + v * (2.0 * rate) + off * faster));
        }
        Some(grown)
    }
}

/// The ends of a line in a row.
fn stored_ends(layout: &RowLayout, number: usize, attached: &[EndAttachment; 2], row: &[f64]) -> Option<StoredEnds> {
    let motion = |body: usize| {
        let at = layout.body(body);
        let Some(numbers) = row.get(at..at + VALUES_PER_BODY) else { return BodyMotion::default() };
        let (position, rest) = numbers.split_at(6);
        let position =
            Place { shift: [position[0], position[1], position[2]], turn: [position[3], position[4], position[5]] };
        let (velocity, acceleration) = rest.split_at(6);
        BodyMotion {
            pose: Pose::from_place(&position),
            velocity: Six::from_column_slice(velocity),
            acceleration: Six::from_column_slice(acceleration),
            ..BodyMotion::default()
        }
    };
    let motions: Vec<BodyMotion> = (0..layout.bodies.len()).map(motion).collect();
    let ends = attached.map(|end| end_of(&end, &motions, true).0);
    Some(StoredEnds { time: *row.first()?, ends, tension: layout.tension(number, row)? })
}

fn linear(v: &Vector3<f64>) -> Six {
    Six::new(v.x, v.y, v.z, 0.0, 0.0, 0.0)
}

/// An end between two instants, by the polynomial of fifth degree with place, velocity and acceleration of both. Lines that are replayed
/// turn freely at their ends: of the axes those of the first instant are taken.
fn interpolate_ends((t0, from): (f64, &End), (t1, to): (f64, &End), time: f64) -> End {
    let h = t1 - t0;
    if h <= 0.0 {
        return *from;
    }
    let s = (time - t0) / h;
    let three = |six: &Six| six.fixed_rows::<3>(0).into_owned();
    let (v0, a0) = (three(&from.velocity) * h, three(&from.acceleration) * (h * h));
    let (v1, a1) = (three(&to.velocity) * h, three(&to.acceleration) * (h * h));
    let moved = to.pose.origin - from.pose.origin;
    // x = x0 + v0 s + a0 s2/2 + c3 s3 + c4 s4 + c5 s5
    let (dx, dv, da) = (moved - v0 - a0 * 0.5, v1 - v0 - a0, a1 - a0);
    let c3 = dx * 10.0 - dv * 4.0 + da * 0.5;
    let c4 = dx * -15.0 + dv * 7.0 - da;
    let c5 = dx * 6.0 - dv * 3.0 + da * 0.5;
    let position = from.pose.origin + v0 * s + a0 * (0.5 * s * s) + (c3 + (c4 + c5 * s) * s) * s.powi(3);
    let speed = v0 + a0 * s + (c3 * 3.0 + (c4 * 4.0 + c5 * (5.0 * s)) * s) * (s * s);
    let acceleration = a0 + (c3 * 6.0 + (c4 * 12.0 + c5 * (20.0 * s)) * s) * s;
    End {
        pose: Pose { origin: position, axes: from.pose.axes },
        velocity: linear(&(speed / h)),
        acceleration: linear(&(acceleration / (h * h))),
    }
}

/// A share that grows from 0 to 1 without a jump of its first two derivatives, with these.
fn smooth(s: f64) -> [f64; 3] {
    let s = s.clamp(0.0, 1.0);
    let rest = 1.0 - s;
    [s.powi(3) * (10.0 - 15.0 * s + 6.0 * s * s), 30.0 * s * s * rest * rest, 60.0 * s * rest * (1.0 - 2.0 * s)]
}

/// A line as a dynamic one, at a time of its replay.
struct Twin {
    element: Box<dyn ConnectorElement>,
    elements: usize,
    surroundings: Surroundings,
    pulled_end: usize,
    time: f64,
    committed: Vec<f64>,
    trial: Vec<f64>,
    cache: SolverCache,
    response: ConnectorResponse,
}

impl Twin {
    /// At rest where a motion begins.
    fn new(run: &Run, (link, connector): (&LinkColumns, &Connector), motion: &EndMotion) -> Result<Self, ClassError> {
        let sea = run.seas.iter().rev().find(|(since, _)| *since <= motion.window[0]).or(run.seas.first());
        let around = ambient(&run.model, sea.and_then(|(_, sea)| sea.as_ref()))?;
        let first_length = connector.first_length.and(motion.first_length);
        let of = |elements: usize| {
            let twin = Connector {
                dynamics: Some(elements),
                first_length,
                active: true,
                name: link.name.clone(),
                ..connector.clone()
            };
            run.model.element_of_run(&twin, Some(&around), RunRequirement::default())
        };
        let nothing = || ClassError::new("no instant around its largest tension is stored");
        let ends = motion.ends(motion.begin).ok_or_else(nothing)?;
        let [fewest, most] = ELEMENTS;
        let surroundings = run.model.surroundings();
        let element = of(fewest)?;
        let mut nodes = Vec::new();
        let mut start = vec![0.0; element.states()];
        element.start(&mut start);
        let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
        if let Some(nodal) = element.as_nodal() {
            nodal.find_nodes(&at, &start, &mut nodes)?;
        }
        let length = nodes.last().map_or(0.0, |n| n.arc);
        let wanted = ((length / MAX_ELEMENT_LENGTH_M).ceil() as usize).clamp(fewest, most);
        let element = if wanted == fewest { element } else { of(wanted)? };
        let mut committed = vec![0.0; element.states()];
        element.start(&mut committed);
        let mut made = Twin {
            elements: element.as_nodal().map_or(0, |nodal| nodal.max_nodes().saturating_sub(1)),
            element,
            surroundings,
            pulled_end: motion.pulled_end,
            time: motion.begin,
            trial: committed.clone(),
            committed,
            cache: SolverCache::new(),
            response: ConnectorResponse::default(),
        };
        made.evaluate(&ends, motion.begin, 0.0)?;
        Ok(made)
    }

    /// Takes it on to a time at which its ends are so.
    fn evaluate(&mut self, ends: &[End; 2], time: f64, dt: f64) -> Result<(), ClassError> {
        let at = Situation { ends, step: Some(TimeStep { time, dt }), surroundings: &self.surroundings };
        self.element.evaluate(&at, &self.committed, &mut self.trial, &mut self.cache, &mut self.response)?;
        std::mem::swap(&mut self.committed, &mut self.trial);
        self.time = time;
        Ok(())
    }

    /// Takes it on to a time (s), in as many parts as that needs; its tension (N).
    fn advance(&mut self, motion: &EndMotion, end: f64) -> Result<f64, ClassError> {
        let whole = end - self.time;
        let mut level = 0;
        while end - self.time > 1e-9 * whole {
            let part = (whole / f64::from(1u32 << level)).min(end - self.time);
            let time = if part >= end - self.time { end } else { self.time + part };
            let ends = motion.ends(time).ok_or_else(|| ClassError::new("its motion is not stored"))?;
            match self.evaluate(&ends, time, time - self.time) {
                Ok(()) => {}
                Err(error) if error.lasting || level >= MAX_STEP_HALVINGS => return Err(error),
                Err(_) => level += 1,
            }
        }
        let force = self.response.wrench.get(self.pulled_end).map_or(f64::NAN, |w| w.fixed_rows::<3>(0).norm());
        if force.is_finite() { Ok(force) } else { Err(ClassError::new("its tension is not finite")) }
    }
}

/// The replays as a table; none where nothing was replayed.
pub fn table(screening: &Screening) -> Option<Table> {
    if screening.replays.is_empty() {
        return None;
    }
    let mut table = Table::new("Screening of Quasi-Static Lines")
        .with_rows(&screening.replays)
        .text("Line", |replay| &replay.line)
        .columns("Window", ["From", "To"], Dim::Time, Digits::Usual, |replay| replay.window)
        .column("", "Period", Dim::Time, Digits::Usual, |replay| replay.period)
        .column("", "Elements", Dim::None, Digits::Usual, |replay| replay.elements)
        .column("", "Steps", Dim::None, Digits::Usual, |replay| replay.steps)
        .column("Largest Tension", "Quasi-Static", Dim::Force, Digits::Usual, |replay| replay.quasi_static)
        .column("Largest Tension", "Dynamic", Dim::Force, Digits::Usual, |replay| replay.dynamic.0)
        .column("Largest Tension", "At", Dim::Time, Digits::Usual, |replay| replay.dynamic.1)
        .column("", "Ratio", Dim::None, Digits::Decimals(3), Replay::ratio)
        .build();
    table.note(
        "replayed as dynamic lines: those with the largest tension over break, ten periods around that tension, ends moved as in the run",
    );
    table
        .note("the period is the energy period of the waves, without waves the mean up-crossing period of the tension");
    Some(table)
}

/// The lines that could not be replayed, a sentence for each reason.
pub fn remarks(screening: &Screening, units: UnitSystem) -> Vec<String> {
    let mut reasons: Vec<(String, Vec<&str>)> = Vec::new();
    for (line, error) in &screening.left {
        let text = error.text(units);
        match reasons.iter_mut().find(|(reason, _)| *reason == text) {
            Some((_, lines)) => lines.push(line),
            None => reasons.push((text, vec![line])),
        }
    }
    reasons
        .iter()
        .map(|(reason, lines)| format!("not replayed as a dynamic line: {}: {reason}", list_names(lines)))
        .collect()
}

/// What is wrong with taking a line quasi-statically, a sentence for each that is.
pub fn warnings(screening: &Screening, units: UnitSystem) -> Vec<String> {
    let shown = |force: f64| format!("{:.0} {}", Dim::Force.from_si(force, units), Dim::Force.label(units));
    let one = |replay: &Replay| {
        format!(
            "{}: as a dynamic line it pulls {:.2} times as hard as the quasi-static line of this run, {} for {}: &CONNECTOR {} -DYNAMICS {} \
             runs it so",
            replay.line,
            replay.ratio(),
            shown(replay.dynamic.0),
            shown(replay.quasi_static),
            replay.line,
            replay.elements
        )
    };
    screening.replays.iter().filter(|r| r.ratio() > LARGEST_RATIO).map(one).collect()
}
