//! The description of a towed tether [AQWA-TETHER 7.1].

use super::super::description::{TetherArrangement, TetherDescription, TetherEnd};
use super::Towed;

impl Towed {
    /// Its description [AQWA-TETHER 7.1]. Numbers of the nodes the user gave for the trailing end and the vessel's; impact and lower stop do
    /// not belong to a towed tether.
    pub fn description(&self, tether: usize, nodes: [&str; 2]) -> TetherDescription<'_> {
        let [x, y, z] = self.origin;
        let length = self.line.length();
        let far = [x + length * self.heading.cos(), y + length * self.heading.sin(), z];
        let end = |node: &str, position| TetherEnd { node: node.into(), given: position, initial: position };
        TetherDescription {
            number: tether,
            configuration: TetherArrangement::Towed,
            line: &self.line,
            ends: [end(nodes[0], self.origin), end(nodes[1], far)],
            springs: self.springs.map(|s| [s.along, s.y, s.z]),
            caps: [0.0; 2],
            stop: 0.0,
            density: self.density,
            gravity: self.gravity,
            internal: [0.0; 2],
            impact: [0.0; 2],
            group: 0,
        }
    }
}
