//! What happens during a run: at a time, or when a condition is first met, within a 64th of a step.

use windlass_base::geometry::Position;
use windlass_model::{Body, ClassError, Model};

/// What a condition watches.
#[derive(Clone, Debug, PartialEq)]
pub enum Observable {
    /// The tension of a connector: the size of the force at the end that pulls, its first one but of a pipe (N); negative where it pushes.
    Tension(String),
    /// A degree of freedom of a body's origin (m; roll, pitch and yaw in rad).
    Dof(String, usize),
    /// The height of a point of a body above the mean water level (m), by its name.
    Height(String),
}

/// When something happens.
#[derive(Clone, Debug, PartialEq)]
pub enum Trigger {
    /// At the first step that ends at this time (s) or after it; the step is made to end there.
    At(f64),
    /// When what is watched is first above the value, within a 64th of a step.
    Above(Observable, f64),
    /// When it is first below.
    Below(Observable, f64),
    /// When another condition is first met at this time (s) or after it.
    After(f64, Box<Trigger>),
}

/// What happens.
#[derive(Clone, Debug, PartialEq)]
pub enum ActionKind {
    /// Connectors stop to act: they break, or are released.
    Release(Vec<String>),
    /// Connectors begin to act.
    Activate(Vec<String>),
    /// The length of a connector's first segment changes at a rate (m/s, positive pays out) until it has a length (m), where one is
    /// given.
    Winch(Vec<String>, f64, Option<f64>),
    /// Another environment: its wind, waves and current.
    Environment(String),
    /// The run ends.
    Stop,
}

/// Something that happens during a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Action {
    /// Its name as written.
    pub name: String,
    /// When.
    pub when: Trigger,
    /// What.
    pub what: ActionKind,
}

impl Trigger {
    /// What is watched; nothing for a time.
    pub fn observable(&self) -> Option<&Observable> {
        match self {
            Trigger::At(_) => None,
            Trigger::Above(watched, _) | Trigger::Below(watched, _) => Some(watched),
            Trigger::After(_, condition) => condition.observable(),
        }
    }

    /// The connector whose tension is watched.
    pub fn connector(&self) -> Option<&String> {
        match self.observable() {
            Some(Observable::Tension(name)) => Some(name),
            _ => None,
        }
    }
}

impl Action {
    /// The connectors it is about.
    pub fn connectors(&self) -> &[String] {
        match &self.what {
            ActionKind::Release(names) | ActionKind::Activate(names) | ActionKind::Winch(names, ..) => names,
            ActionKind::Environment(_) | ActionKind::Stop => &[],
        }
    }

    /// The environment it brings, where it does.
    pub fn environment(&self) -> Option<&String> {
        match &self.what {
            ActionKind::Environment(name) => Some(name),
            _ => None,
        }
    }
}

/// Where a point stands in its body, and the body's number.
pub(crate) fn point_in_body(model: &Model, name: &str) -> Result<(usize, Position), ClassError> {
    let missing = || ClassError::new(format!("there is no point {name} on a body"));
    let point = model.points.get(&Model::key(name)).ok_or_else(missing)?;
    let part = model.parts.get(&Model::key(&point.part)).ok_or_else(missing)?;
    let body: &Body = model.body_of(point).ok_or_else(missing)?;
    let index = model.bodies.get_index_of(&Model::key(&body.name)).ok_or_else(missing)?;
    Ok((index, part.position.apply(point.at)))
}
