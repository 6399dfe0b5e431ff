//! What the restraints FIX, SPR and GAP share: no deflection as the ends stood when the connector was defined.
//!
//! Source: [MOSES-REF cls_res]: the program sets the offset of the second end at definition.

use super::checks;
use super::fix::rigid_stiffness;
use super::spring::{Restraint, no_anchor, restraint_table};
use super::spring_law::{Elastic, SpringGroup};
use super::zero_law::{ContactGeometry, Friction, Sense, ZeroLaw};
use super::zero_length::{ZeroLength, defined_displacement, element_turns};
use nalgebra::Matrix3;
use windlass_base::diagnostic::Outcome;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_model::{
    ClassError, Connection, Connector, ConnectorCategory, ConnectorClass, ConnectorElement, Surroundings,
};

/// A class of restraints.
#[derive(Debug)]
pub struct RestraintClass {
    kind: &'static str,
    restraints: Vec<Restraint>,
    sense: Sense,
    friction: Friction,
    rigid: bool,
}

impl RestraintClass {
    /// Of a class with these springs, that act both ways.
    pub fn new(kind: &'static str, restraints: Vec<Restraint>) -> Self {
        RestraintClass { kind, restraints, sense: Sense::Both, friction: Friction::None, rigid: false }
    }

    /// The same whose stiffnesses grow with the bodies that it ties ([`rigid_stiffness`]).
    #[must_use]
    pub fn rigid(self) -> Self {
        RestraintClass { rigid: true, ..self }
    }

    /// The same that only pushes along X, with friction.
    #[must_use]
    pub fn pushing(self, friction: Friction) -> Self {
        RestraintClass { sense: Sense::Compression, friction, ..self }
    }
}

impl ConnectorClass for RestraintClass {
    fn kind(&self) -> &'static str {
        self.kind
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        no_anchor(self.kind, connector)?;
        checks::ends(self.kind, connector, bodies, 2, 2)
    }

    fn properties(&self, name: &str, _: &Surroundings) -> Table {
        let table = restraint_table(name, self.kind, &self.restraints);
        match self.friction {
            Friction::Stick { mu, .. } => table.fact("Friction", mu, Dim::None),
            _ => table,
        }
    }

    fn element(&self, connection: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        let (turn, other_turn) = element_turns(connection, 0, Matrix3::identity());
        let rigid = self.rigid.then(|| rigid_stiffness(&(connection.tied)()));
        let stiffness =
            |r: &Restraint| rigid.map_or(r.stiffness, |[along, about]| if r.dof.is_rotation() { about } else { along });
        let list = || self.restraints.iter().map(|r| (r.dof.index(), stiffness(r)));
        let group =
            |(dof, stiffness)| SpringGroup { dofs: vec![dof], elastic: Elastic::new(stiffness, None), viscous: None };
        let law = ZeroLaw {
            sense: self.sense,
            contact: ContactGeometry::Whole,
            groups: list().map(group).collect(),
            dashpots: Vec::new(),
            friction: self.friction,
            pushes_only: false,
        };
        Ok(Box::new(ZeroLength {
            holder: 0,
            turn,
            other_turn,
            rest: defined_displacement(connection, &turn),
            law,
            listed: list().map(|(dof, _)| (dof, None)).collect(),
            category: ConnectorCategory::Rigid,
        }))
    }
}
