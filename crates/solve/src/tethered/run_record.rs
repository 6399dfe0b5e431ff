//! A run of tethers, kept instant by instant: in memory and in a file, or as statistics alone; and how it goes on from a checkpoint.

use super::case::{Installed, TetherCase, TetherCaseKind, TowedCase, case};
use super::history::{
    INSTALLED_END, StructureHistory, TOWED_END, TOWED_NODE, TetherHistory, TetherRunEvent, vessel_row,
};
use super::{TetherRunSettings, Tethered};
use crate::SolveError;
use crate::time::{Action, RunFileError, STEPS_PER_SNAPSHOT, Snapshot, Watcher};
use std::ops::ControlFlow;
use windlass_base::geometry::Place;
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{ClassError, Model};
use windlass_signal::running::{Running, RunningSummary};
use windlass_tether::installed::{Installation, InstalledObserver, InstalledTether, Moment, RigChange};
use windlass_tether::towed::{TowedObserver, TowedRecord, TowedSteps};

/// Numbers that an event has in a checkpoint.
const EVENT_NUMBERS: usize = 5;

/// A run that was made and has not begun, or goes on.
#[derive(Debug)]
pub struct TetherRun {
    case: TetherCase,
    kept: Tethered,
    fingerprint: u64,
    /// The state that comes next, with what the engine needs to go on there.
    from: Option<(usize, Vec<f64>)>,
}

impl TetherRun {
    /// The run of the tethers of a model.
    ///
    /// # Errors
    /// A model without tethers, or with what does not run with them; an action that does not go with them; a run that would keep too much.
    pub fn new(model: &Model, actions: &[Action], settings: TetherRunSettings) -> Result<Self, SolveError> {
        settings.check().map_err(SolveError::new)?;
        let case = case(model, actions, &settings)?;
        let fingerprint = fingerprint(&case, &settings);
        let mut kept = Tethered {
            settings,
            times: Vec::new(),
            structure: None,
            tethers: Vec::new(),
            happened: Vec::new(),
            actions: Vec::new(),
            seed: case.seed,
            notes: case.notes.clone(),
            interrupted: false,
            running: Vec::new(),
        };
        let structure = |body: &str, points: Vec<String>| {
            Some(StructureHistory { body: body.to_string(), points, rows: Vec::new() })
        };
        match &case.kind {
            TetherCaseKind::Towed(towed) => {
                kept.tethers.push(history(&towed.name, true, &towed.tether.line));
                kept.structure = towed.vessel.as_ref().and_then(|vessel| structure(&vessel.body, Vec::new()));
            }
            TetherCaseKind::Installed(installed) => {
                kept.tethers.extend(installed.tethers.iter().map(|t| history(&t.name, false, &t.line)));
                let points = installed.points.iter().map(|(name, _)| name.clone()).collect();
                kept.structure = structure(&installed.body, points);
            }
        }
        let width = kept.width();
        settings.room(width).map_err(SolveError::new)?;
        if !settings.keep {
            kept.running = vec![Running::with_level(0.0); width - 1];
        }
        Ok(TetherRun { case, kept, fingerprint, from: None })
    }

    /// A number that another model, environment, step or scheme does not have; how long the run lasts does not count.
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// Numbers of a row: time, structure, nodes and ends of each tether.
    pub fn width(&self) -> usize {
        self.kept.width()
    }

    /// Takes up a run that was kept: its checkpoint, and its rows up to there.
    ///
    /// # Errors
    /// A checkpoint of another run.
    pub fn take_up(&mut self, snapshot: &Snapshot, rows: &[f64]) -> Result<(), SolveError> {
        let other = || SolveError::new(ClassError::new("the checkpoint is not one of these tethers"));
        for row in rows.chunks(self.kept.width()) {
            self.kept.keep_row(row);
        }
        for event in snapshot.loads.chunks(EVENT_NUMBERS) {
            let [time, tether, kind, one, two] = *event else { return Err(other()) };
            let change = match kind {
                0.0 => RigChange::Slack,
                1.0 => RigChange::Impact { velocity: one, stress: two },
                _ => RigChange::LowerStop { drop: one },
            };
            let name = self.kept.tethers.get(tether as usize).map(|t| t.name.clone()).ok_or_else(other)?;
            self.kept.happened.push(TetherRunEvent { time, tether: name, change });
        }
        self.from = Some((snapshot.taken, snapshot.states.clone()));
        Ok(())
    }

    /// Runs, showing rows and checkpoints to a watcher.
    ///
    /// # Errors
    /// What the engine refuses; a file that cannot be written.
    pub fn run(self, watcher: &mut dyn Watcher) -> Result<Tethered, SolveError> {
        let TetherRun { case, mut kept, from, .. } = self;
        let from = from.as_ref().map(|(next, numbers)| (*next, numbers.as_slice()));
        let done = match case.kind {
            TetherCaseKind::Towed(towed) => run_towed(&towed, &mut kept, from, watcher),
            TetherCaseKind::Installed(installed) => run_installed(*installed, &mut kept, from, watcher),
        };
        done.map_err(SolveError::new)?;
        watcher.finish().map_err(|e| SolveError::new(unwritten(e)))?;
        Ok(kept)
    }
}

fn unwritten(error: RunFileError) -> ClassError {
    ClassError::new(error.to_string())
}

fn history(name: &str, towed: bool, line: &windlass_tether::TetherLine) -> TetherHistory {
    TetherHistory { name: name.to_string(), towed, line: line.clone(), nodes: Vec::new(), ends: Vec::new() }
}

/// FNV-1a of what the case and its settings are, but for the time observed.
fn fingerprint(case: &TetherCase, settings: &TetherRunSettings) -> u64 {
    let kind = match &case.kind {
        TetherCaseKind::Towed(towed) => format!("{towed:?}"),
        TetherCaseKind::Installed(installed) => {
            let Installed { body, structure, tethers, flow, compatibility, course, centre, points } = &**installed;
            let start = (course.start, course.step, course.pose, course.velocity);
            format!("{body}{structure:?}{tethers:?}{flow:?}{compatibility:?}{start:?}{centre:?}{points:?}")
        }
    };
    let TetherRunSettings { start: began, step, store, compatible, slam, tow, .. } = settings;
    let text = format!("{kind}{began:?}{step:?}{store:?}{compatible:?}{slam:?}{tow:?}");
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |sum, byte| (sum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

impl TetherHistory {
    /// Numbers of its nodes and of its ends at an instant.
    fn numbers(&self) -> [usize; 2] {
        let ends = if self.towed { TOWED_END.len() } else { INSTALLED_END.len() };
        [self.line.nodes() * TOWED_NODE.len(), 2 * self.line.elements().len() * ends]
    }
}

impl Tethered {
    /// Numbers of a row: time, structure, nodes and ends of each tether.
    fn width(&self) -> usize {
        let structure = self.structure.as_ref().map_or(0, StructureHistory::width);
        1 + structure + self.tethers.iter().flat_map(TetherHistory::numbers).sum::<usize>()
    }

    /// Keeps a row, or takes it into the statistics.
    fn keep_row(&mut self, row: &[f64]) {
        let Some((time, values)) = row.split_first() else { return };
        if !self.settings.keep {
            if *time >= self.settings.statistics_start() {
                for (running, value) in self.running.iter_mut().zip(values) {
                    // times grow and values are finite: the engine sees to both
                    let _ = running.push(*time, *value);
                }
            }
            return;
        }
        self.times.push(*time);
        let mut rest = values;
        let mut take = |count: usize| {
            let (own, behind) = rest.split_at(count.min(rest.len()));
            rest = behind;
            own
        };
        if let Some(structure) = &mut self.structure {
            let own = take(structure.width());
            structure.rows.extend_from_slice(own);
        }
        for tether in &mut self.tethers {
            let [nodes, ends] = tether.numbers();
            let own = take(nodes);
            tether.nodes.extend_from_slice(own);
            let own = take(ends);
            tether.ends.extend_from_slice(own);
        }
    }

    /// What happened so far, as numbers.
    fn event_numbers(&self) -> Vec<f64> {
        let position = |name: &str| self.tethers.iter().position(|t| t.name == name).unwrap_or(0) as f64;
        let numbers = |event: &TetherRunEvent| {
            let (kind, one, two) = match event.change {
                RigChange::Slack => (0.0, 0.0, 0.0),
                RigChange::Impact { velocity, stress } => (1.0, velocity, stress),
                RigChange::LowerStop { drop } => (2.0, drop, 0.0),
            };
            [event.time, position(&event.tether), kind, one, two]
        };
        self.happened.iter().flat_map(numbers).collect()
    }
}

/// Takes the states of a run as they come.
struct RunRecorder<'a> {
    kept: &'a mut Tethered,
    watcher: &'a mut dyn Watcher,
    row: Vec<f64>,
    rows: usize,
    /// Number of states of the whole run.
    states: usize,
    stopped: bool,
}

impl<'a> RunRecorder<'a> {
    fn new(kept: &'a mut Tethered, watcher: &'a mut dyn Watcher) -> Self {
        let (rows, states) = (kept.times.len(), kept.settings.states());
        RunRecorder { kept, watcher, row: Vec::new(), rows, states, stopped: false }
    }

    /// Whether the run goes on at a time; remembers that it does not.
    fn should_continue(&mut self, time: f64) -> bool {
        self.stopped = !self.watcher.should_continue(time);
        !self.stopped
    }

    fn is_stored(&self, state: usize) -> bool {
        state.is_multiple_of(self.kept.settings.store.max(1))
    }

    fn keep(&mut self) -> Result<(), ClassError> {
        self.kept.keep_row(&self.row);
        self.rows += 1;
        if self.kept.settings.keep { self.watcher.row(&self.row).map_err(unwritten) } else { Ok(()) }
    }

    /// Writes a checkpoint now and then, where the run ends and where it is stopped.
    fn checkpoint(&mut self, next: usize, numbers: &dyn Fn() -> Vec<f64>) -> Result<(), ClassError> {
        let due = next > 0 && (next.is_multiple_of(STEPS_PER_SNAPSHOT) || next >= self.states || self.stopped);
        if !due || !self.kept.settings.keep {
            return Ok(());
        }
        let snapshot = Snapshot {
            time: self.kept.settings.time(next),
            taken: next,
            states: numbers(),
            loads: self.kept.event_numbers(),
            rows: self.rows,
            ..Snapshot::default()
        };
        self.watcher.snapshot(&snapshot).map_err(unwritten)
    }
}

struct TowedKeeper<'a> {
    keeper: RunRecorder<'a>,
    case: &'a TowedCase,
    /// An error of a file, reported when the engine has returned.
    error: Option<ClassError>,
}

impl TowedObserver for TowedKeeper<'_> {
    fn record(&mut self, record: &TowedRecord<'_>) -> ControlFlow<()> {
        if !self.keeper.should_continue(record.time) {
            return ControlFlow::Break(());
        }
        if !self.keeper.is_stored(record.index) {
            return ControlFlow::Continue(());
        }
        let row = &mut self.keeper.row;
        row.clear();
        row.push(record.time);
        if let (Some(vessel), Some([y, z, ..])) = (&self.case.vessel, record.positions.last()) {
            row.extend(vessel_row(vessel, &self.case.tether, [*y, *z]));
        }
        let nodes = record.positions.iter().zip(record.velocities).zip(record.accelerations).zip(record.along);
        for (((position, velocity), acceleration), along) in nodes {
            row.extend(position.iter().chain(velocity).chain(acceleration));
            row.push(*along);
        }
        for end in record.ends {
            row.extend(end.shear.iter().chain(&end.moment).chain(&end.stress));
        }
        match self.keeper.keep() {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.error = Some(error);
                ControlFlow::Break(())
            }
        }
    }

    fn checkpoint(&mut self, next: usize, numbers: &dyn Fn() -> Vec<f64>) -> Result<(), ClassError> {
        self.keeper.checkpoint(next, numbers)
    }
}

fn run_towed(
    case: &TowedCase,
    kept: &mut Tethered,
    from: Option<(usize, &[f64])>,
    watcher: &mut dyn Watcher,
) -> Result<(), ClassError> {
    let settings = kept.settings;
    let steps =
        TowedSteps { start: settings.start, step: settings.step, number: settings.states(), ..TowedSteps::default() };
    let mut observer = TowedKeeper { keeper: RunRecorder::new(kept, watcher), case, error: None };
    match from {
        Some(checkpoint) => case.tether.resume(checkpoint, &steps, &mut observer)?,
        None => case.tether.run(&steps, &mut observer)?,
    };
    let TowedKeeper { keeper, error, .. } = observer;
    let stopped = keeper.stopped;
    if let Some(error) = error {
        return Err(error);
    }
    kept.interrupted = stopped;
    Ok(())
}

struct InstalledKeeper<'a> {
    keeper: RunRecorder<'a>,
    positions: Vec<nalgebra::Vector3<f64>>,
    near: Place,
    /// What the engine needs to go on at the state that is shown next.
    last: Option<(usize, Vec<f64>)>,
}

impl InstalledObserver for InstalledKeeper<'_> {
    fn checkpoint(&mut self, next: usize, numbers: &dyn Fn() -> Vec<f64>) -> Result<(), ClassError> {
        self.keeper.checkpoint(next, numbers)?;
        // a stop is seen in the middle of a step, which changes the state
        let asked =
            self.keeper.kept.settings.keep && !self.keeper.should_continue(self.keeper.kept.settings.time(next));
        if asked {
            self.last = Some((next, numbers()));
        }
        Ok(())
    }

    fn observe(&mut self, moment: &Moment) -> Result<(), ClassError> {
        if self.keeper.stopped || !self.keeper.should_continue(moment.time) {
            self.keeper.stopped = true;
            return Err(ClassError::new("the run was interrupted"));
        }
        let kept = &mut *self.keeper.kept;
        for event in moment.events {
            let name = kept.tethers.get(event.tether).map(|t| t.name.clone()).unwrap_or_default();
            kept.happened.push(TetherRunEvent { time: event.time, tether: name, change: event.change });
        }
        self.near = moment.pose.position(&self.near);
        if !self.keeper.is_stored(moment.state) {
            return Ok(());
        }
        let row = &mut self.keeper.row;
        row.clear();
        row.push(moment.time);
        row.extend(self.near.values());
        row.extend(moment.velocity.iter());
        row.extend(moment.acceleration.iter());
        for kind in moment.forces.kinds() {
            row.extend(kind.iter());
        }
        row.extend(moment.error.iter());
        for position in &self.positions {
            row.extend(moment.pose.point(*position).iter());
        }
        for rig in moment.tethers {
            for node in 0..rig.nodes() {
                row.extend(rig.position(node));
                row.extend(rig.velocity(node));
                row.extend(rig.acceleration(node));
                row.push(rig.height(node));
            }
            for (loads, stresses) in rig.ends().iter().flatten().zip(rig.stresses().iter().flatten()) {
                let [shear_x, shear_y] = loads.shear;
                let [moment_x, moment_y] = loads.moment;
                row.extend([loads.effective, loads.wall, shear_x, shear_y, moment_x, moment_y]);
                row.extend([stresses.shear, stresses.maximum, stresses.minimum, stresses.von_mises]);
                row.push(stresses.bending_y);
            }
        }
        self.keeper.keep()
    }
}

fn run_installed(
    case: Installed,
    kept: &mut Tethered,
    from: Option<(usize, &[f64])>,
    watcher: &mut dyn Watcher,
) -> Result<(), ClassError> {
    let Installed { mut structure, tethers, flow, compatibility, course, points, .. } = case;
    let (_, positions): (Vec<String>, _) = points.into_iter().unzip();
    let mut near = course.pose.position(&Place::default());
    // rotations of the last row, so that they grow on
    if let Some(numbers) = kept.structure.as_ref().and_then(|s| s.rows.get(s.rows.len().checked_sub(s.width())?..))
        && let [x, y, z, roll, pitch, yaw, ..] = *numbers
    {
        near = Place { shift: [x, y, z], turn: [roll, pitch, yaw] };
    }
    let tethers: Vec<InstalledTether> = tethers;
    let mut observer = InstalledKeeper { keeper: RunRecorder::new(kept, watcher), positions, near, last: None };
    let mut installation = Installation::new(structure.as_mut(), tethers, &flow, compatibility)?;
    let ended = match from {
        Some(checkpoint) => installation.resume(&course, checkpoint, &mut observer),
        None => installation.run(&course, &mut observer),
    };
    drop(installation);
    let InstalledKeeper { mut keeper, last, .. } = observer;
    keeper.kept.actions = structure.actions();
    if keeper.stopped {
        if let Some((next, numbers)) = last {
            keeper.checkpoint(next, &|| numbers.clone())?;
        }
        kept.interrupted = true;
        return Ok(());
    }
    ended
}

/// The statistics of a run that kept no instants [AQWA-TETHER 7.7, 7.8 and 7.13]: for each tether its nodes and its ends, mean, twice the deviation, largest and
/// smallest value; and the same of the motions of the structure. Nothing of a run that kept its instants, or had none behind its transient.
pub fn statistics_tables(run: &Tethered) -> Vec<Table> {
    type SummaryColumn = (&'static str, fn(&RunningSummary) -> f64);
    const PAGES: [SummaryColumn; 4] = [
        ("Mean Value", |s| s.mean),
        ("2 x R.M.S", |s| 2.0 * s.deviation),
        ("Maximum", |s| s.maximum.value),
        ("Minimum", |s| s.minimum.value),
    ];
    let found: Vec<Option<RunningSummary>> = run.running.iter().map(Running::summary).collect();
    let Some(Some(first)) = found.first() else { return Vec::new() };
    let mut tables = Vec::new();
    let mut at = 0;
    let value = |position: usize, of: fn(&RunningSummary) -> f64| found.get(position).and_then(|s| s.as_ref()).map(of);
    let counted = |table: Table| table.fact("INSTANTS PROCESSED", Cell::Integer(first.count as i64), Dim::None);
    if let Some(structure) = &run.structure {
        let names = ["X", "Y", "Z", "RX", "RY", "RZ"];
        let dims = [
            [Dim::Length, Dim::Velocity, Dim::Acceleration],
            [Dim::Angle, Dim::AngularVelocity, Dim::AngularAcceleration],
        ];
        for (part, range) in [0..3, 3..6].into_iter().enumerate() {
            let rows: Vec<usize> = range.collect();
            let mut columns = vec![Column::new(
                "",
                "FREEDOM",
                Dim::None,
                Digits::Usual,
                rows.iter().filter_map(|dof| names.get(*dof)).copied(),
            )];
            for (kind, motion) in StructureHistory::KINDS.iter().enumerate().take(3) {
                for (name, of) in PAGES {
                    let cells = rows.iter().map(|dof| value(at + 6 * kind + dof, of));
                    let dim = dims.get(part).and_then(|d| d.get(kind)).copied().unwrap_or(Dim::None);
                    columns.push(Column::new(motion, name, dim, Digits::Decimals(4), cells));
                }
            }
            let what = if part == 0 { "Translations" } else { "Rotations" };
            tables.push(counted(Table::from_columns(format!("Statistics of {}: {what}", structure.body), columns)));
        }
        at += structure.width();
    }
    for tether in &run.tethers {
        let [nodes, ends] = tether.numbers();
        let of_nodes = (tether.node_quantities(), at, tether.line.nodes(), 12);
        let of_ends =
            (tether.end_quantities(), at + nodes, 2 * tether.line.elements().len(), tether.end_quantities().len());
        for (name, of) in PAGES {
            for (head, (quantities, from, positions, shown)) in [("NODE", of_nodes), ("ELEM", of_ends)] {
                let number = |position: usize| if head == "NODE" { position + 1 } else { position / 2 + 1 };
                let node = |position: usize| if head == "NODE" { position } else { position.div_ceil(2) };
                let distances = (0..positions).map(|position| tether.line.distances().get(node(position)).copied());
                let mut columns = vec![
                    Column::new("", head, Dim::None, Digits::Usual, (0..positions).map(number)),
                    Column::new("", "DISTNCE", Dim::Length, Digits::Decimals(2), distances),
                ];
                for (index, quantity) in quantities.iter().enumerate().take(shown) {
                    let cells = (0..positions).map(|position| value(from + position * quantities.len() + index, of));
                    columns.push(Column::new(quantity.group, quantity.name, quantity.dim, quantity.digits, cells));
                }
                tables
                    .push(counted(Table::from_columns(format!("Tether {} Statistics: {name}", tether.name), columns)));
            }
        }
        at += nodes + ends;
    }
    tables
}
