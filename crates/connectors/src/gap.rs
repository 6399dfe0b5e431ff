//! GAP: a rigid contact that only pushes, with friction.
//!
//! Source: [MOSES-REF cls_res].

use super::fix::RIGID_STIFFNESS;
use super::restraint::RestraintClass;
use super::spring::Restraint;
use super::zero_law::Friction;
use super::{ClassKind, options as o};
use std::sync::Arc;
use windlass_base::choice::Dof;
use windlass_base::diagnostic::Outcome;
use windlass_base::units::Dim;
use windlass_language::spec::{CommandSpec, Kind, ValueSpec};
use windlass_model::{ClassRecord, ConnectorClass};

/// The class type.
pub static GAP: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

static SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new("COEF", Kind::Number(Dim::None), "coefficient of friction").or("0").not_negative()],
    options: &[o::IG_STIFF],
    detail: "In contact as the ends stood when the connector was defined: place the bodies first. It pushes rigidly (1.0E12 N/m) while the \
             second end has come nearer along element X than it stood then, and never pulls. While it pushes the ends stick to one \
             another in Y and Z, as stiffly, up to COEF times the push, beyond which they slide; where they stick is remembered from \
             step to step. Axes are those of the first node's body, turned by -EULER; global on ground. Its force belongs to \
             RIGID_CONNECTORS.",
    example: "MEDIT\n*P 0 0 0\n~REST GAP 0.3\nCONNECTOR G -EULER 0 90 0 ~REST *P\nEND\n&STATUS CLASS ~REST",
    ..CommandSpec::new("GAP", "rigid contact with friction")
};

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let mu = records.last().and_then(|r| r.args.number(const { SPEC.number("COEF") })).unwrap_or(0.0);
    let push = Restraint { dof: Dof::X, stiffness: RIGID_STIFFNESS, allowable: None };
    let friction = if mu > 0.0 { Friction::Stick { mu, stiffness: RIGID_STIFFNESS } } else { Friction::None };
    Ok(Arc::new(RestraintClass::new("GAP", vec![push]).pushing(friction)))
}
