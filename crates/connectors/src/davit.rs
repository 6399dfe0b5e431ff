//! DAVIT: a line from which a pipe hangs while it is laid.
//!
//! Source: [MOSES-FLEX DAVIT]: as a SLING.

use super::ClassKind;
use super::sling::{DATA, DETAIL, OPTIONS};
use super::tie::TieClass;
use std::sync::Arc;
use windlass_base::diagnostic::Outcome;
use windlass_language::spec::CommandSpec;
use windlass_model::{ClassRecord, ClassRole, ConnectorClass};

/// The class type.
pub static DAVIT: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

static SPEC: CommandSpec = CommandSpec {
    data: DATA,
    options: OPTIONS,
    detail: DETAIL,
    example: "MEDIT\n~DV1 DAVIT 2 -LEN 30\nEND\n&STATUS CLASS ~DV1",
    ..CommandSpec::new("DAVIT", "davit line of a pipe being laid")
};

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    Ok(Arc::new(TieClass::read(records, "DAVIT", ClassRole::PipeDavit)?))
}
