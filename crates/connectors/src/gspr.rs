//! GSPR: a generalized spring in chosen degrees of freedom.
//!
//! Source: [MOSES-FLEX GSPR].

use super::spring::GeneralizedSpring;
use super::{ClassKind, foundation, options as o};
use std::sync::Arc;
use windlass_base::diagnostic::Outcome;
use windlass_language::spec::{CommandSpec, OptionSpec, join_options};
use windlass_model::{ClassRecord, ConnectorClass};

/// The class type.
pub static GSPR: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

/// Those of the zero-length classes, and `-LEN`, which only this one has.
static OPTIONS: [OptionSpec; 1 + foundation::OPTIONS.len()] = join_options(&[o::LEN_OFFSET], foundation::OPTIONS);

static SPEC: CommandSpec = CommandSpec {
    data: &o::GENERALIZED,
    repeat: 3,
    options: &OPTIONS,
    detail: "SENSE TENSION: no load in any degree of freedom while the element X displacement is negative; COMPRESSION: none while \
             it is positive; BOTH or left out: always. -LEN is an offset along element X: the spring begins there. Displacements are \
             those of the second end from the first, along the body axes of the first node, turned by -EULER of the connector; \
             global axes when it is on ground. With one node the spring acts between it and the ground at the place where the \
             connector was defined. A rotation is the rotation vector of the turn of the ends against each other since then, at \
             most half a turn. The force acts at the second end: on the body of the first it has that arm, a couple that F_CONNECTOR does not \
             print and FORCE has. &HELP ~CLASS FOUNDATION lists the options.",
    example: "MEDIT\n~FENDER GSPR COMPRESSION X 1000 500 -X_PY 10 0.1 50 0.3\nEND\n&STATUS CLASS ~FENDER",
    ..CommandSpec::new("GSPR", "generalized spring")
};

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    Ok(Arc::new(GeneralizedSpring::read(records, "GSPR")?))
}
