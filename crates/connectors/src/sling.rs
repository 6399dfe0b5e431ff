//! SLING: a line of a lifting assembly.
//!
//! Source: [MOSES-FLEX SLING]: the area is that of a solid circle of OD; the only other option is -EMODULUS.

use super::tie::TieClass;
use super::{ClassKind, options as o};
use std::sync::Arc;
use windlass_base::diagnostic::Outcome;
use windlass_language::spec::{CommandSpec, OptionSpec, ValueSpec};
use windlass_model::{ClassRecord, ClassRole, ConnectorClass};

/// The class type.
pub static SLING: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

/// Data of a SLING and a DAVIT.
pub const DATA: &[ValueSpec] = &[o::OD];
/// Options of both.
pub const OPTIONS: &[OptionSpec] = &[o::LEN, o::EMODULUS];
/// Help on both.
pub const DETAIL: &str = "Pulls along the chord between its ends with AE/L of the full area of OD, beyond its length L; it never pushes \
    and has no weight. A single point: the assembly it belongs to takes care of the other end, and without one it exerts no force.";

static SPEC: CommandSpec = CommandSpec {
    data: DATA,
    options: OPTIONS,
    detail: DETAIL,
    example: "MEDIT\n~SL1 SLING 4 -LEN 120 -EMOD 12000\nEND\n&STATUS CLASS ~SL1",
    ..CommandSpec::new("SLING", "lifting sling")
};

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    Ok(Arc::new(TieClass::read(records, "SLING", ClassRole::Sling)?))
}
