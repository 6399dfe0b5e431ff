//! Devices of a line: what options such as -PISTON, -CONVOLUTION and -X_DAMPING add to it, one file each, listed in [`DEVICES`].
//!
//! Source: [MOSES-FLEX], on lines other than ROD: a line is "a set of springs in series, a dashpot, and a hydraulic tension control device". Piston and viscoelastic
//! spring lengthen the line at its first end, along its tension there (see [`Extension`]). The manual does not say where the dashpot acts:
//! here along the chord between the two ends, against the rate of its length, on both ends alike, and only in time steps and while the
//! line has a tension; it does not enter the tension that the piston controls.

mod convolution;
mod dashpot;
mod piston;

use super::extension::{EndPull, ExtensibleLine, Extension};
use super::per_line::PerLineOptions;
use super::viscous::Affine;
use nalgebra::{Matrix3, Vector3};
use std::fmt::Debug;
use std::sync::Arc;
use windlass_base::diagnostic::Outcome;
use windlass_base::span::Span;
use windlass_base::values::{Args, Given};
use windlass_language::spec::OptionSpec;
use windlass_model::{
    ClassError, Connection, ConnectorElement, ConnectorResponse, ConnectorSummary, End, Note, Situation, SolverCache,
    SpringState,
};

/// Every device, in the order in which they stand from the first end of a line on.
static DEVICES: &[&DeviceKind] = &[&piston::PISTON, &convolution::CONVOLUTION, &dashpot::X_DAMPING];

/// Their options, for the specs of classes of lines.
pub const OPTIONS: [OptionSpec; DEVICES.len()] = options();

const fn options() -> [OptionSpec; DEVICES.len()] {
    let mut options = [*piston::PISTON.option; DEVICES.len()];
    let mut i = 0;
    while i < options.len() {
        options[i] = *DEVICES[i].option;
        i += 1;
    }
    options
}

/// Checks what a record says of devices.
///
/// # Errors
/// What contradicts itself, at its value.
pub fn check(args: &Args) -> Outcome<()> {
    DEVICES.iter().try_for_each(|kind| args.option_if_declared(kind.option).map_or(Ok(()), kind.check))
}

/// A device that an option adds to a line. One is declared in the file that has its law, and listed in [`DEVICES`].
struct DeviceKind {
    /// Its option, which holds for the whole line.
    option: &'static OptionSpec,
    /// Refuses values that contradict each other.
    check: fn(&Given) -> Outcome<()>,
    /// The device of such an option, checked.
    read: fn(&Given) -> Option<Arc<dyn Device>>,
}

/// A device of a class.
trait Device: Debug + Send + Sync {
    /// What it does in a line.
    ///
    /// # Errors
    /// A curve that is not there or does not do.
    fn action(&self, connection: &Connection) -> Result<DeviceAction, ClassError>;

    /// What a table or a shape of a line says that leaves it as it is without motion.
    fn note(&self) -> Option<Note> {
        None
    }

    /// The curve of a spring in series that the statics of a line has too, with its place.
    fn curve(&self) -> Option<(String, Span)> {
        None
    }
}

/// What a device does in a line.
enum DeviceAction {
    /// It lengthens or shortens the line to control its tension.
    Control(Box<dyn TensionControl>),
    /// It gives way in series.
    Spring(Box<dyn SeriesSpring>),
    /// It acts along the chord against the rate of its length.
    Damper(Box<dyn ChordDamper>),
}

/// A link in series whose length follows from the tension that it lets through. Its state is its position (m).
trait TensionControl: Debug + Send + Sync {
    /// The position at which it adds nothing to the line (m).
    fn nominal(&self) -> f64;

    /// Where it is at the end of a step (s; `None`: in statics) that began at another position, and what it does there.
    /// `at` gives the tension (N) at a position, and its derivative by it.
    ///
    /// # Errors
    /// A position at which the line has no answer; a limit that no position holds.
    fn find_position(
        &self,
        before: f64,
        dt: Option<f64>,
        at: &mut dyn FnMut(f64) -> Result<(f64, f64), ClassError>,
    ) -> Result<(f64, ControlState), ClassError>;
}

/// What a control of the tension does at an instant.
struct ControlState {
    /// Whether it holds the tension, so that the line has no stiffness along it.
    holds: bool,
    /// What is reported of it.
    note: Note,
}

/// A spring in series with a memory: a force that is straight over its deflection within a step.
trait SeriesSpring: Debug + Send + Sync {
    /// Number of values of its state.
    fn states(&self) -> usize;

    /// Force at the end of a step (s; `None`: in statics) against the deflection there.
    fn step(&self, dt: Option<f64>, committed: &[f64]) -> Affine;

    /// Writes the state at the end of a step to a deflection (m).
    fn advance(&self, dt: Option<f64>, committed: &[f64], deflection: f64, trial: &mut [f64]);
}

/// A damper along the chord.
trait ChordDamper: Debug + Send + Sync {
    /// Force against a rate of the chord's length (m/s), and its derivative by the rate (N, N s/m).
    fn force(&self, rate: f64) -> (f64, f64);
}

/// The devices of a class.
#[derive(Clone, Debug, Default)]
pub struct Devices {
    list: Vec<Arc<dyn Device>>,
    /// The curve of a viscoelastic spring, with its place.
    pub convolution: Option<(String, Span)>,
}

impl Devices {
    /// Of a line's options.
    pub fn read(options: &PerLineOptions) -> Devices {
        let read = |kind: &&DeviceKind| options.option(kind.option).and_then(kind.read);
        let list: Vec<Arc<dyn Device>> = DEVICES.iter().filter_map(read).collect();
        let convolution = list.iter().find_map(|device| device.curve());
        Devices { list, convolution }
    }

    /// Whether there are none.
    pub fn is_none(&self) -> bool {
        self.list.is_empty()
    }

    /// What is reported of a line whose devices do not move.
    pub fn notes(&self) -> Vec<Note> {
        self.list.iter().filter_map(|device| device.note()).collect()
    }

    /// The element of a line with them; `line` has none of them.
    ///
    /// # Errors
    /// A curve that is not defined, or is no convolution, or does not keep any stiffness.
    pub fn element(
        &self,
        connection: &Connection,
        line: Box<dyn ExtensibleLine>,
    ) -> Result<Box<dyn ConnectorElement>, ClassError> {
        let mut made = DeviceElement { line, control: None, springs: Vec::new(), dampers: Vec::new() };
        for device in &self.list {
            match device.action(connection)? {
                DeviceAction::Control(control) => made.control = Some(control),
                DeviceAction::Spring(spring) => made.springs.push(spring),
                DeviceAction::Damper(damper) => made.dampers.push(damper),
            }
        }
        Ok(Box::new(made))
    }
}

/// A line with devices, as an engine sees it. Its state: the position of the control (m), then the states of the springs.
#[derive(Debug)]
struct DeviceElement {
    line: Box<dyn ExtensibleLine>,
    control: Option<Box<dyn TensionControl>>,
    springs: Vec<Box<dyn SeriesSpring>>,
    dampers: Vec<Box<dyn ChordDamper>>,
}

/// Where the devices stand.
struct DeviceState {
    pull: EndPull,
    /// Position of the control and what it does.
    control: Option<(f64, ControlState)>,
    /// Force against deflection of each spring.
    springs: Vec<Affine>,
    /// All that lengthens the line.
    extension: Extension,
}

impl DeviceElement {
    /// State of the control, and those of the springs.
    fn split_states<'a>(&self, states: &'a [f64]) -> (Option<f64>, &'a [f64]) {
        match self.control {
            Some(_) => (states.first().copied(), states.get(1..).unwrap_or_default()),
            None => (None, states),
        }
    }

    fn find_forces(
        &self,
        at: &Situation,
        committed: &[f64],
        cache: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<DeviceState, ClassError> {
        let dt = at.step.map(|s| s.dt);
        let (before, mut memory) = self.split_states(committed);
        let mut springs = Vec::with_capacity(self.springs.len());
        for spring in &self.springs {
            let (own, rest) = memory.split_at(spring.states().min(memory.len()));
            springs.push(spring.step(dt, own));
            memory = rest;
        }
        let links = springs.iter().map(|a| Extension { length: -a.rest / a.slope, compliance: 1.0 / a.slope });
        let in_series = |a: Extension, b: Extension| Extension {
            length: a.length + b.length,
            compliance: a.compliance + b.compliance,
        };
        let spring = links.reduce(in_series).unwrap_or(Extension::NONE);
        let mut pull_at = |by: f64| {
            let extension = Extension { length: spring.length + by, ..spring };
            self.line
                .pull(at.ends, extension, cache, out)
                .map(|pull| (extension, pull, -axial_stiffness(out, &pull.along)))
        };
        let Some(control) = &self.control else {
            let (extension, pull, _) = pull_at(0.0)?;
            return Ok(DeviceState { pull, control: None, springs, extension });
        };
        let nominal = control.nominal();
        let mut last = None;
        let stand = control.find_position(before.unwrap_or(nominal), dt, &mut |s| {
            let (extension, pull, slope) = pull_at(s - nominal)?;
            last = Some((s, extension, pull));
            Ok((pull.tension, slope))
        })?;
        let (extension, pull) = match last {
            Some((s, extension, pull)) if s == stand.0 => (extension, pull),
            _ => pull_at(stand.0 - nominal).map(|(extension, pull, _)| (extension, pull))?,
        };
        Ok(DeviceState { pull, control: Some(stand), springs, extension })
    }

    fn write_state(&self, at: &Situation, committed: &[f64], trial: &mut [f64], found: &DeviceState) {
        let (_, mut memory) = self.split_states(committed);
        let (own, mut rest) = trial.split_at_mut(trial.len().min(usize::from(self.control.is_some())));
        if let (Some((position, _)), Some(first)) = (&found.control, own.first_mut()) {
            *first = *position;
        }
        for (spring, line) in self.springs.iter().zip(&found.springs) {
            let count = spring.states();
            let (before, others) = memory.split_at(count.min(memory.len()));
            let (new, behind) = rest.split_at_mut(count.min(rest.len()));
            spring.advance(at.step.map(|s| s.dt), before, (found.pull.tension - line.rest) / line.slope, new);
            (memory, rest) = (others, behind);
        }
    }
}

/// Stiffness of the first end along a direction (N/m).
fn axial_stiffness(out: &ConnectorResponse, along: &Vector3<f64>) -> f64 {
    out.stiffness.first().map_or(0.0, |k| along.dot(&(k.fixed_view::<3, 3>(0, 0) * along)))
}

/// Takes the stiffness away with which the tension would change. A link at the first end that grows by da acts as that end moved by
/// da along the tension t, so that with K the stiffness without control and da such that the tension stays,
/// K'ij = Kij - (Ki1 t)(t' K1j) / (t' K11 t).
fn remove_axial_stiffness(along: &Vector3<f64>, out: &mut ConnectorResponse) {
    let axial = axial_stiffness(out, along);
    let [k11, k12, k21, k22] = out.stiffness.as_mut_slice() else { return };
    if axial <= 0.0 {
        return;
    }
    let part = |block: &nalgebra::Matrix6<f64>| block.fixed_view::<3, 3>(0, 0).into_owned();
    let (columns, rows) =
        ([part(k11) * along, part(k21) * along], [part(k11), part(k12)].map(|k| along.transpose() * k));
    for (i, blocks) in columns.iter().zip([[k11, k12], [k21, k22]]) {
        for (j, block) in rows.iter().zip(blocks) {
            let mut view = block.fixed_view_mut::<3, 3>(0, 0);
            view -= i * j / axial;
        }
    }
}

/// Adds a damper along the chord between two ends.
fn add_damper(damper: &dyn ChordDamper, ends: &[End], out: &mut ConnectorResponse) {
    let [first, second] = ends else { return };
    let along = second.pose.origin - first.pose.origin;
    let chord = along.norm();
    if chord == 0.0 {
        return;
    }
    let unit = along / chord;
    let rate = (second.velocity - first.velocity).fixed_rows::<3>(0).into_owned();
    let speed = unit.dot(&rate);
    let (force, slope) = damper.force(speed);
    let across = (Matrix3::identity() - unit * unit.transpose()) / chord;
    // the direction turns, and with it the part of the rate along it
    let by_place = across * force + unit * (across * rate).transpose() * slope;
    let by_rate = unit * unit.transpose() * slope;
    if let [near, far] = out.wrench.as_mut_slice() {
        for (wrench, sign) in [(near, 1.0), (far, -1.0)] {
            let mut part = wrench.fixed_rows_mut::<3>(0);
            part += unit * (force * sign);
        }
    }
    out.damping.resize(4, nalgebra::Matrix6::zeros());
    for (blocks, more) in [(&mut out.stiffness, by_place), (&mut out.damping, by_rate)] {
        for (index, block) in blocks.iter_mut().enumerate() {
            let sign = if index == 0 || index == 3 { 1.0 } else { -1.0 };
            let mut part = block.fixed_view_mut::<3, 3>(0, 0);
            part += more * sign;
        }
    }
}

impl ConnectorElement for DeviceElement {
    fn states(&self) -> usize {
        usize::from(self.control.is_some()) + self.springs.iter().map(|spring| spring.states()).sum::<usize>()
    }

    fn start(&self, state: &mut [f64]) {
        if let (Some(control), Some(first)) = (&self.control, state.first_mut()) {
            *first = control.nominal();
        }
    }

    fn evaluate(
        &self,
        at: &Situation,
        committed: &[f64],
        trial: &mut [f64],
        cache: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        let found = self.find_forces(at, committed, cache, out)?;
        if found.control.as_ref().is_some_and(|(_, does)| does.holds) {
            remove_axial_stiffness(&found.pull.along, out);
        }
        self.write_state(at, committed, trial, &found);
        if at.step.is_some() && found.pull.tension != 0.0 {
            self.dampers.iter().for_each(|damper| add_damper(damper.as_ref(), at.ends, out));
        }
        Ok(())
    }

    fn summary(&self, at: &Situation, committed: &[f64]) -> Result<ConnectorSummary, ClassError> {
        let found = self.find_forces(at, committed, &mut SolverCache::new(), &mut ConnectorResponse::default())?;
        let mut summary = self.line.summary_with_link(at.ends, found.extension)?;
        if let Some((position, does)) = found.control {
            summary.notes.push(does.note);
            let force = found.pull.tension;
            summary.springs.push(SpringState { dof: "PISTON".into(), deflection: position, force, allowable: None });
        }
        Ok(summary)
    }

    fn compression_onset(&self) -> Option<f64> {
        self.line.compression_onset()
    }
}
