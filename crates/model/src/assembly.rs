//! Assemblies: connectors of a single node whose other ends an assembly takes care of.

use super::{
    Ambient, Body, ClassError, Connection, Connector, ConnectorClass, ConnectorElement, Curve, Model, Placement,
    RunRequirement, SchemeWeights, Surroundings,
};
use indexmap::IndexMap;
use nalgebra::Vector3;
use std::sync::Arc;
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::span::Span;

/// What an assembly is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum AssemblyKind {
    /// Slings from a body to a hook, and a line from the hook to the tip of a boom.
    TipHook {
        /// The connector from the boom to the hook.
        boom: String,
        /// The connectors from the body to the hook.
        slings: Vec<String>,
    },
    /// A pipe on supports.
    Pipe {
        /// Its ROD class.
        class: String,
        /// Its supports, from the one nearest to the bottom to the tensioner.
        supports: Vec<String>,
        /// TLOWER and TUPPER (N); no TUPPER on davits.
        tension: (f64, Option<f64>),
    },
    /// One line over pulleys without friction: its spans between them, in order.
    Pulley {
        /// The connectors that are its spans.
        line: Vec<String>,
    },
    /// A line that runs off a drum at the first end of its first span, over a pulley from each span to the next.
    Winch {
        /// The connectors that are its spans.
        line: Vec<String>,
        /// The drum.
        drum: Drum,
    },
}

/// A winch drum.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drum {
    /// Its radius (m).
    pub radius: f64,
    /// Its moment of inertia (kg m2).
    pub inertia: f64,
    /// Largest torque of its motor (N m).
    pub max_torque: f64,
    /// Torque up to which its brake holds it (N m).
    pub static_brake: f64,
    /// Torque of its brake while it slips (N m).
    pub dynamic_brake: f64,
    /// Line on the drum, which is all that can be paid out (m); infinite where it is not known.
    pub stored: f64,
    /// Whether it has a motor and a brake, and turns by its inertia.
    pub has_machine: bool,
    /// What governs it in a run.
    pub control: DrumControl,
}

/// What governs a drum in a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum DrumControl {
    /// Its brake holds it, and slips above the static torque.
    #[default]
    Brake,
    /// Its motor hauls in with a share of the largest torque, up to a length of the first segments together (m).
    Motor {
        /// The share.
        share: f64,
        /// The length at which it stops (m).
        bound: Option<f64>,
    },
    /// A curve over time: a rate of paying out over a factor (`LT_MULTIPLIER`), or a length paid out (`CT_LENGTH`).
    Curve {
        /// Its name.
        name: String,
        /// What its values are multiplied by: a rate (m/s), or a share.
        factor: f64,
        /// The length at which it stops (m).
        bound: Option<f64>,
    },
}

impl DrumControl {
    /// The length at which it stops (m).
    pub fn bound(&self) -> Option<f64> {
        match self {
            DrumControl::Brake => None,
            DrumControl::Motor { bound, .. } | DrumControl::Curve { bound, .. } => *bound,
        }
    }
}

/// A span of a line over pulleys.
#[derive(Clone, Debug)]
pub struct ReevedSpan {
    /// The connector it is.
    pub name: String,
    /// Its class.
    pub class: Arc<dyn ConnectorClass>,
    /// Where its ends are now, and the present length of its first segment.
    pub placement: Placement,
    /// That length (m).
    pub first_length: f64,
}

/// A line over pulleys, of which an element exerts the forces of one span.
#[derive(Clone, Debug)]
pub struct ReevedLayout {
    /// The assembly.
    pub name: String,
    /// Its spans in order.
    pub spans: Vec<ReevedSpan>,
    /// The one whose ends the element acts on: they stand before those of the others, which are in order.
    pub own: usize,
    /// The drum its first span runs off, and the curve that governs it.
    pub drum: Option<(Drum, Option<Curve>)>,
    /// Water, depth, gravity.
    pub surroundings: Surroundings,
}

/// What a pipe is made of where its supports are.
pub struct PipeLayout<'a> {
    /// Its name.
    pub name: &'a str,
    /// The law of each support, between its node and a point of the pipe.
    pub supports: Arc<[Box<dyn ConnectorElement>]>,
    /// Their nodes.
    pub nodes: Vec<Pose>,
    /// The way of the pipe through each, one way or the other, in the axes of its node: X as `-EULER` turns it.
    pub ways: Vec<Vector3<f64>>,
    /// How far below its node each holds the pipe (m): the length of a davit.
    pub hang: Vec<f64>,
    /// TLOWER: the least tension of the tensioner, or the nominal one at the first davit (N).
    pub lower: f64,
    /// TUPPER, the largest tension of the tensioner (N); `None` on davits.
    pub upper: Option<f64>,
    /// Water, depth, gravity.
    pub surroundings: &'a Surroundings,
    /// Water, air and bottom along it.
    pub ambient: Option<&'a Arc<dyn Ambient>>,
    /// Whether a run keeps the balance of its energy and momentum.
    pub balance: bool,
    /// The scheme that steps it; that of its engine where none.
    pub scheme: Option<SchemeWeights>,
}

/// A pipe over the supports that act, in the order of its ends.
pub struct LaidPipe<'a> {
    /// The supports.
    pub supports: Vec<&'a Connector>,
    /// The pipe, with an end at the node of each.
    pub element: Box<dyn ConnectorElement>,
}

/// Name of the one pipe assembly (the MOSES manual, conn_pipe).
pub const PIPE: &str = "&PIPE/ASSEMBLY";
/// What it is called for short (as PIPE).
const PIPE_SHORT: &str = "&PIPE";

/// The whole name of a line of that name: that of the pipe assembly where it is called for short.
pub fn line_name(name: &str) -> &str {
    if name.eq_ignore_ascii_case(PIPE_SHORT) { PIPE } else { name }
}

/// An assembly. The hook of a tip-hook set is a junction of its name, and the second point of its connectors.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembly {
    /// Its name as written.
    pub name: String,
    /// What it is made of.
    pub kind: AssemblyKind,
    /// Where it was defined.
    pub span: Span,
}

impl Assembly {
    /// The connectors it takes care of.
    pub fn members(&self) -> impl Iterator<Item = &String> {
        let (boom, others) = match &self.kind {
            AssemblyKind::TipHook { boom, slings } => (Some(boom), slings),
            AssemblyKind::Pipe { supports, .. } => (None, supports),
            AssemblyKind::Pulley { line } | AssemblyKind::Winch { line, .. } => (None, line),
        };
        boom.into_iter().chain(others)
    }

    /// The connectors that are the spans of one line, where it is one over pulleys or off a drum.
    pub fn reeved_line(&self) -> Option<&[String]> {
        match &self.kind {
            AssemblyKind::Pulley { line } | AssemblyKind::Winch { line, .. } => Some(line),
            AssemblyKind::TipHook { .. } | AssemblyKind::Pipe { .. } => None,
        }
    }

    /// The same, to be renamed.
    pub fn members_mut(&mut self) -> impl Iterator<Item = &mut String> {
        let (boom, others) = match &mut self.kind {
            AssemblyKind::TipHook { boom, slings } => (Some(boom), slings),
            AssemblyKind::Pipe { supports, .. } => (None, supports),
            AssemblyKind::Pulley { line } | AssemblyKind::Winch { line, .. } => (None, line),
        };
        boom.into_iter().chain(others)
    }
}

impl Model {
    /// The assembly a connector belongs to.
    pub fn assembly_of(&self, connector: &str) -> Option<&Assembly> {
        let key = Model::key(connector);
        self.assemblies.values().find(|a| a.members().any(|m| Model::key(m) == key))
    }

    /// Whether a connector holds a pipe, which acts in its place.
    pub fn holds_pipe(&self, connector: &str) -> bool {
        self.assembly_of(connector).is_some_and(|a| matches!(a.kind, AssemblyKind::Pipe { .. }))
    }

    /// The assembly whose line over pulleys or off a drum a connector is a span of.
    pub fn reeving(&self, connector: &str) -> Option<&Assembly> {
        self.assembly_of(connector).filter(|a| a.reeved_line().is_some())
    }

    /// The other spans of the line that a connector is a span of, in order.
    pub fn other_spans(&self, connector: &str) -> Vec<&Connector> {
        let key = Model::key(connector);
        let line = self.reeving(connector).and_then(Assembly::reeved_line).unwrap_or_default();
        let others = line.iter().map(|name| Model::key(name)).filter(|name| *name != key);
        others.filter_map(|name| self.connectors.get(&name)).collect()
    }

    /// Whether a connector is a span of a line of which another span does not act, so that nothing of it pulls.
    pub fn is_unreeved(&self, connector: &str) -> bool {
        self.other_spans(connector).iter().any(|span| !span.active)
    }

    /// The ends of a connector's element in the present configuration: its own two, then those of the other spans of its line.
    pub fn element_ends(&self, connector: &Connector) -> Vec<Pose> {
        let others = self.other_spans(&connector.name);
        std::iter::once(connector).chain(others).flat_map(|span| self.end_poses(span)).collect()
    }

    /// A connector as a span of its line over pulleys or off a drum; `None` of one that is none.
    ///
    /// # Errors
    /// A span that makes none here.
    pub(super) fn reeved_element(
        &self,
        connector: &Connector,
    ) -> Result<Option<Box<dyn ConnectorElement>>, ClassError> {
        let Some(assembly) = self.reeving(&connector.name) else { return Ok(None) };
        let key = Model::key(&connector.name);
        let (mut spans, mut own) = (Vec::new(), 0);
        for (index, name) in assembly.members().enumerate() {
            let name = Model::key(name);
            let kept = self.connectors.get(&name).filter(|_| name != key);
            if name == key {
                own = index;
            }
            let span = kept.unwrap_or(connector);
            let class = self.classes.get(&Model::key(&span.class));
            let class = class.ok_or_else(|| ClassError::new(format!("there is no class {}", span.class)))?;
            spans.push(ReevedSpan {
                name: span.name.clone(),
                class: Arc::clone(&class.object),
                placement: self.placement(span),
                first_length: self.first_length(span).unwrap_or(0.0),
            });
        }
        let drum = match &assembly.kind {
            AssemblyKind::Winch { drum, .. } => {
                let curve = match &drum.control {
                    DrumControl::Curve { name, .. } => {
                        let found = self.curves.get(&Model::key(name)).cloned();
                        Some(found.ok_or_else(|| ClassError::new(format!("there is no curve {name}")))?)
                    }
                    DrumControl::Brake | DrumControl::Motor { .. } => None,
                };
                Some((drum.clone(), curve))
            }
            _ => None,
        };
        let layout = ReevedLayout { name: assembly.name.clone(), spans, own, drum, surroundings: self.surroundings() };
        let class = layout.spans.get(own).map(|span| Arc::clone(&span.class));
        let Some(class) = class else { return Ok(None) };
        let kind = class.kind();
        let reeved = class.as_reeved();
        let reeved = reeved.ok_or_else(|| ClassError::new(format!("a {kind} does not run over a pulley")))?;
        reeved.reeved_line(layout).map(Some)
    }

    /// The supports of a pipe assembly that act, and the pipe on them; `None` of another assembly, or where none acts. `ambient`
    /// surrounds it, and a run may ask for its energy balance.
    ///
    /// # Errors
    /// A class or support that makes none here.
    pub fn pipe(
        &self,
        assembly: &Assembly,
        ambient: Option<&Arc<dyn Ambient>>,
        duty: RunRequirement,
    ) -> Result<Option<LaidPipe<'_>>, ClassError> {
        let AssemblyKind::Pipe { class, supports, tension: (lower, upper) } = &assembly.kind else { return Ok(None) };
        let held = supports.iter().filter_map(|name| self.connectors.get(&Model::key(name)));
        let held: Vec<&Connector> = held.filter(|c| c.active).collect();
        let found = self.classes.get(&Model::key(class)).map(|c| &c.object);
        let Some(found) = found.filter(|_| !held.is_empty()) else { return Ok(None) };
        let surroundings = self.surroundings();
        let (mut laws, mut nodes, mut ways, mut hang) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for connector in &held {
            let node = self.end_pose(connector, 0).unwrap_or_default();
            let placement = super::Placement { to_ground: false, ..self.placement(connector) };
            let class = self.classes.get(&Model::key(&connector.class));
            let class = class.ok_or_else(|| ClassError::new(format!("there is no class {}", connector.class)))?;
            laws.push(class.object.element(&Connection {
                connector,
                ends: [node, node],
                to_ground: false,
                placement,
                curve: &|name| self.curves.get(&Model::key(name)),
                surroundings: &surroundings,
                ambient: None,
                duty: RunRequirement::default(),
                tied: &super::TiedBodies::default,
            })?);
            hang.push(if upper.is_none() { self.first_length(connector).unwrap_or(0.0) } else { 0.0 });
            nodes.push(node);
            let turned = Place { turn: connector.euler.unwrap_or_default(), ..Place::default() };
            ways.push(turned.rotation().matrix().column(0).into_owned());
        }
        let (lower, upper) = (*lower, *upper);
        let layout = PipeLayout {
            name: &assembly.name,
            supports: laws.into(),
            nodes,
            ways,
            hang,
            lower,
            upper,
            surroundings: &surroundings,
            ambient,
            balance: duty.balance,
            scheme: duty.scheme,
        };
        let kind = found.kind();
        let class = found.as_pipe().ok_or_else(|| ClassError::new(format!("a class of type {kind} makes no pipe")))?;
        Ok(Some(LaidPipe { element: class.pipe(layout)?, supports: held }))
    }

    /// Whether a body is the hook of an assembly whose connectors are all inactive: nothing moves it then.
    pub fn idle_hook(&self, body: &Body) -> bool {
        let active = |name: &String| self.connectors.get(&Model::key(name)).is_some_and(|c| c.active);
        self.assemblies.get(&Model::key(&body.name)).is_some_and(|a| !a.members().any(active))
    }

    /// Takes an assembly apart: its hook goes, its connectors have a single node again.
    pub fn take_apart(&mut self, name: &str) {
        let key = Model::key(name);
        let Some(assembly) = self.assemblies.shift_remove(&key) else { return };
        if !matches!(assembly.kind, AssemblyKind::TipHook { .. }) {
            return;
        }
        for member in assembly.members() {
            if let Some(connector) = self.connectors.get_mut(&Model::key(member)) {
                connector.points.truncate(1);
            }
        }
        self.points.shift_remove(&format!("*{key}"));
        self.parts.shift_remove(&key);
        self.bodies.shift_remove(&key);
    }
}

/// Assemblies by their keys.
pub type Assemblies = IndexMap<String, Assembly>;
