//! Connector classes: one file a class, each a spec and an object that implements
//! [`ConnectorClass`](crate::model::ConnectorClass). `catenary` is the line engine.

pub mod catenary;

use crate::language::diagnostic::Outcome;
use crate::language::spec::CommandSpec;
use crate::model::{ClassRecord, ConnectorClass};
use std::sync::Arc;

/// A type of class a user can name in a `~NAME TYPE ...` record.
pub struct ClassKind {
    /// The record's form behind the class name; its name is the type.
    pub spec: &'static CommandSpec,
    /// True when a repeated class name adds a segment; else it replaces the class.
    pub segmented: bool,
    /// Builds the object from all records of the class so far, fairlead first.
    pub build: fn(&[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>>,
}

/// All class types, in the order of the manual.
pub static CLASSES: &[&ClassKind] = &[];
