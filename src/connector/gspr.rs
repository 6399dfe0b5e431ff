//! GSPR: a generalized spring in chosen degrees of freedom.
//!
//! Source: seed 001.

use super::spring::Generalized;
use super::{ClassKind, options as o};
use crate::language::diagnostic::Outcome;
use crate::language::spec::{CommandSpec, OptionSpec};
use crate::model::{ClassRecord, ConnectorClass};
use std::sync::Arc;

/// The class type.
pub static GSPR: ClassKind = ClassKind { spec: &SPEC, segmented: false, build };

/// The options of the zero-length classes, `-LEN` first, which only this one has.
const OPTIONS: &[OptionSpec] = &[
    o::LEN_OFFSET,
    o::SYMMETRIC,
    o::IG_STIFF,
    o::CONVOLUTION_DF,
    o::X_PY,
    o::Y_PY,
    o::Z_PY,
    o::X_DAMPING,
    o::Y_DAMPING,
    o::Z_DAMPING,
    o::FRICTION_MU,
];

static SPEC: CommandSpec = CommandSpec {
    data: &[o::SENSE, o::DF, o::SPV, o::AF],
    repeat: 3,
    options: OPTIONS,
    detail: "SENSE TENSION: no load in any degree of freedom while the element X displacement is negative; COMPRESSION: none while \
             it is positive; BOTH or left out: always. -LEN is an offset along element X: the spring begins there. Displacements are \
             those of the second end from the first, along the body axes of the first node, turned by -EULER of the connector; \
             global axes when it is on ground. With one node the spring acts between it and the ground at the place where the \
             connector was defined. A rotation is the rotation vector of the turn of the ends against each other since then, at \
             most half a turn. &HELP ~CLASS FOUNDATION tells of the options.",
    example: "MEDIT\n~FENDER GSPR COMPRESSION X 1000 500 -X_PY 10 0.1 50 0.3\nEND\n&STATUS CLASS ~FENDER",
    ..CommandSpec::new("GSPR", "generalized spring")
};

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    Ok(Arc::new(Generalized::read(records, "GSPR")?))
}
