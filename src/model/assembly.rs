//! Assemblies: connectors of a single node whose other ends an assembly takes care of.

use super::{Body, Model};
use crate::language::source::Span;
use indexmap::IndexMap;

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
        let AssemblyKind::TipHook { boom, slings } = &self.kind;
        std::iter::once(boom).chain(slings)
    }

    /// The same, to be renamed.
    pub fn members_mut(&mut self) -> impl Iterator<Item = &mut String> {
        let AssemblyKind::TipHook { boom, slings } = &mut self.kind;
        std::iter::once(boom).chain(slings)
    }
}

impl Model {
    /// The assembly a connector belongs to.
    pub fn assembly_of(&self, connector: &str) -> Option<&Assembly> {
        let key = Model::key(connector);
        self.assemblies.values().find(|a| a.members().any(|m| Model::key(m) == key))
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
