//! What `&UNDO` goes back to: the model and the settings that records change, as they were when the terminal last waited for a record.
//!
//! Each state shares with the next what did not change. The states kept are at most `MAX_STATES`, and at most `MAX_BYTES` together.
//! A script keeps none.

use super::{Job, Menu};
use std::any::Any;
use std::collections::VecDeque;
use std::fmt::{Debug, Write};
use std::sync::Arc;
use windlass_model::Model;

/// Records that can be taken back.
const MAX_STATES: usize = 100;
/// Bytes of all states, as their text has them.
const MAX_BYTES: usize = 256 << 20;

/// A part of a state: its value, shared with the states in which it is the same.
#[derive(Clone)]
struct SharedPart {
    sum: u64,
    bytes: usize,
    value: Arc<dyn Any + Send + Sync>,
}

/// The state of a job that records change.
#[derive(Clone)]
struct SharedState {
    parts: Vec<SharedPart>,
    /// The open menus, where none holds a result.
    menus: Option<Vec<Menu>>,
    /// What is being built in menus.
    building: u64,
    /// What the journal knows of the open menus.
    journal_menus: Vec<bool>,
}

/// States to go back to.
#[derive(Default)]
pub struct UndoStates {
    now: Option<SharedState>,
    /// Records executed when `now` was taken.
    records: usize,
    /// The states before, oldest first, each with the records executed from it to the next.
    before: VecDeque<(SharedState, std::ops::Range<usize>)>,
    /// States that were dropped: there were too many, they were too large, or of another process.
    dropped: usize,
    /// The process that the states are of: each has a model of its own.
    process: String,
}

/// What `&UNDO` did.
pub struct TakenBack {
    /// The first of the records that were taken back.
    pub record: String,
    /// How many records behind it went with it.
    pub more: usize,
    /// How many can be taken back still.
    pub left: usize,
}

/// The sum and length of the text of a value (FNV-1a, 64 bits).
struct TextSum(u64, usize);

impl Write for TextSum {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.0 = text.bytes().fold(self.0, |sum, b| (sum ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3));
        self.1 += text.len();
        Ok(())
    }
}

fn text_sum(value: &impl Debug) -> (u64, usize) {
    let mut sum = TextSum(0xcbf2_9ce4_8422_2325, 0);
    // writing to a sum cannot fail
    let _ = write!(sum, "{value:?}");
    (sum.0, sum.1)
}

/// Passes over the parts of a state, always in the same order.
trait PartVisitor {
    fn visit<T: Debug + Clone + Send + Sync + 'static>(&mut self, value: &mut T);
}

/// Takes the parts as they are, sharing those of the state before that are the same.
struct Capture<'a> {
    before: &'a [SharedPart],
    parts: Vec<SharedPart>,
}

impl PartVisitor for Capture<'_> {
    fn visit<T: Debug + Clone + Send + Sync + 'static>(&mut self, value: &mut T) {
        let (sum, bytes) = text_sum(value);
        let same = self.before.get(self.parts.len()).filter(|part| part.sum == sum && part.bytes == bytes);
        let made = || SharedPart { sum, bytes, value: Arc::new(value.clone()) };
        self.parts.push(same.cloned().unwrap_or_else(made));
    }
}

/// Puts the parts back.
struct Restore<'a>(std::slice::Iter<'a, SharedPart>);

impl PartVisitor for Restore<'_> {
    fn visit<T: Debug + Clone + Send + Sync + 'static>(&mut self, value: &mut T) {
        if let Some(kept) = self.0.next().and_then(|part| part.value.downcast_ref::<T>()) {
            *value = kept.clone();
        }
    }
}

/// All that records change: the model, and what the job keeps for later records.
fn visit_state(job: &mut Job, visitor: &mut impl PartVisitor) {
    let Model {
        bodies,
        parts,
        points,
        loads,
        multipliers,
        parameters,
        saved_parameters,
        unmodelled,
        sensors,
        draft_marks,
        classes,
        connectors,
        assemblies,
        curves,
        bathymetries,
        fillings,
        fatigue,
        environments,
        selectors,
        environment,
        defaults,
        wave_defaults,
        saved_defaults,
        compartments,
        holes,
        current_compartment,
        load_groups,
        current_load_group,
        current_part,
        current_piece,
        interrupt: _,
    } = &mut job.model;
    visitor.visit(bodies);
    visitor.visit(parts);
    visitor.visit(points);
    visitor.visit(loads);
    visitor.visit(multipliers);
    visitor.visit(parameters);
    visitor.visit(saved_parameters);
    visitor.visit(unmodelled);
    visitor.visit(sensors);
    visitor.visit(draft_marks);
    visitor.visit(classes);
    visitor.visit(connectors);
    visitor.visit(assemblies);
    visitor.visit(curves);
    visitor.visit(bathymetries);
    visitor.visit(fillings);
    visitor.visit(fatigue);
    visitor.visit(environments);
    visitor.visit(selectors);
    visitor.visit(environment);
    visitor.visit(defaults);
    visitor.visit(wave_defaults);
    visitor.visit(saved_defaults);
    visitor.visit(compartments);
    visitor.visit(holes);
    visitor.visit(current_compartment);
    visitor.visit(load_groups);
    visitor.visit(current_load_group);
    visitor.visit(current_part);
    visitor.visit(current_piece);
    visitor.visit(&mut job.units);
    visitor.visit(&mut job.saved_units);
    visitor.visit(&mut job.titles);
    visitor.visit(&mut job.deferred);
    visitor.visit(&mut job.deferred_elements);
    visitor.visit(&mut job.deferred_assemblies);
    visitor.visit(&mut job.uncompared_pieces);
    visitor.visit(&mut job.shapes);
    visitor.visit(&mut job.actions);
    visitor.visit(&mut job.equilibrium);
}

/// The menus that a state keeps: none where one of them holds a result, which may be large and is no part of the model.
fn kept_menus(job: &Job) -> Option<Vec<Menu>> {
    let holds_result = |menu: &Menu| matches!(menu, Menu::Disposition(_) | Menu::Frequency(_));
    (!job.menus.iter().any(holds_result)).then(|| job.menus.clone())
}

/// What is being built in the open menus.
fn building_sum(job: &Job) -> u64 {
    let builds = |menu: &&Menu| {
        matches!(menu, Menu::Block(_) | Menu::Total(_) | Menu::Building(_) | Menu::Soundings(_) | Menu::Planes(_))
    };
    text_sum(&job.menus.iter().filter(builds).collect::<Vec<_>>()).0
}

impl SharedState {
    fn capture(job: &mut Job, before: Option<&SharedState>) -> Self {
        let mut capture = Capture { before: before.map_or(&[], |state| &state.parts), parts: Vec::new() };
        visit_state(job, &mut capture);
        let (menus, building) = (kept_menus(job), building_sum(job));
        SharedState { parts: capture.parts, menus, building, journal_menus: job.journal.menus.clone() }
    }

    fn restore(&self, job: &mut Job) {
        visit_state(job, &mut Restore(self.parts.iter()));
        if let Some(menus) = &self.menus {
            job.menus.clone_from(menus);
            job.journal.menus.clone_from(&self.journal_menus);
        }
    }

    fn is_same(&self, other: &SharedState) -> bool {
        let parts = self.parts.iter().zip(&other.parts);
        self.building == other.building && parts.into_iter().all(|(a, b)| a.sum == b.sum && a.bytes == b.bytes)
    }

    /// Bytes that it does not share with the state behind it.
    fn own_bytes(&self, next: &SharedState) -> usize {
        let own = self.parts.iter().zip(&next.parts).filter(|(a, b)| !Arc::ptr_eq(&a.value, &b.value));
        own.map(|(part, _)| part.bytes).sum()
    }
}

impl UndoStates {
    /// Takes the state of a job that waits for a record; the record before is one to take back where it changed something.
    pub fn take(job: &mut Job) {
        let Some(mut states) = job.undo.take() else { return };
        if states.process != job.process {
            states.dropped += states.before.len();
            states.before.clear();
            states.now = None;
            states.process.clone_from(&job.process);
        }
        let made = SharedState::capture(job, states.now.as_ref());
        let records = job.journal.records().len();
        if let Some(before) = states.now.take().filter(|before| !before.is_same(&made)) {
            states.before.push_back((before, states.records..records));
        }
        states.now = Some(made);
        states.records = records;
        states.drop_oldest();
        job.undo = Some(states);
    }

    /// Drops the oldest states until they are few and small enough.
    fn drop_oldest(&mut self) {
        while self.before.len() > MAX_STATES || self.bytes() > MAX_BYTES {
            if self.before.pop_front().is_none() {
                return;
            }
            self.dropped += 1;
        }
    }

    fn bytes(&self) -> usize {
        let states: Vec<&SharedState> = self.before.iter().map(|(state, _)| state).chain(&self.now).collect();
        states.windows(2).map(|pair| if let [a, b] = pair { a.own_bytes(b) } else { 0 }).sum()
    }

    /// Takes the last record back that changed something; `None` where there is none left.
    pub fn take_back(job: &mut Job) -> Option<TakenBack> {
        let mut states = job.undo.take()?;
        let found = states.before.pop_back();
        let done = found.map(|(state, records)| {
            state.restore(job);
            // with its menus what stands behind it goes too; it changed nothing, and would be read in another menu
            let end = if state.menus.is_some() { job.journal.records().len() } else { records.end };
            let (record, more) = job.journal.take_back(records.start, end);
            states.now = Some(state);
            TakenBack { record, more, left: states.before.len() }
        });
        job.undo = Some(states);
        done
    }

    /// Whether states were dropped: they were too many or too large.
    pub fn has_dropped(&self) -> bool {
        self.dropped > 0
    }
}
