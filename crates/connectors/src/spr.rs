//! SPR: a restraint by springs in chosen degrees of freedom.
//!
//! Source: [MOSES-REF cls_res].

use super::restraint::RestraintClass;
use super::spring::{RestraintKeys, restraints};
use super::{ClassKind, options as o};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_language::spec::CommandSpec;
use windlass_model::{ClassRecord, ConnectorClass};

/// The class type.
pub static SPR: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

static SPEC: CommandSpec = CommandSpec {
    data: &[o::DF, o::SPV],
    repeat: 2,
    options: &[o::IG_STIFF],
    detail: "Springs that are without force as the ends stood when the connector was defined: place the bodies first. Axes are those of \
             the first node's body, turned by -EULER; global on ground. With one node it holds to the ground. Its force belongs to \
             RIGID_CONNECTORS.",
    example: "MEDIT\n*P 0 0 0\n~PAD SPR X 1000 Z 2000 RY 500\nCONNECTOR S ~PAD *P\nEND\n&STATUS CLASS ~PAD",
    ..CommandSpec::new("SPR", "restraint by springs")
};

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let record = records.last().ok_or_else(|| Diagnostic::error("a class needs a record", Span::default()))?;
    let list = restraints(
        &record.args,
        RestraintKeys { dof: const { SPEC.choice("DF") }, stiffness: const { SPEC.number("SPV") }, allowable: None },
    )?;
    Ok(Arc::new(RestraintClass::new("SPR", list)))
}
