//! FOUNDATION: a generalized spring of zero length that is checked in a FOUNDATION check.
//!
//! Source: [MOSES-FLEX FOUNDATION]. The check takes the ratio and the springs of [`windlass_model::ConnectorSummary`].

use super::spring::GeneralizedSpring;
use super::{ClassKind, options as o};
use std::sync::Arc;
use windlass_base::diagnostic::Outcome;
use windlass_language::spec::{CommandSpec, OptionSpec};
use windlass_model::{ClassRecord, ConnectorClass};

/// The class type.
pub static FOUNDATION: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

/// The options of a spring of zero length.
pub const OPTIONS: &[OptionSpec] = &[
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
    data: &o::GENERALIZED,
    repeat: 3,
    options: OPTIONS,
    detail: "A GSPR of zero length that is checked in a FOUNDATION check: the largest of its forces over their AF. Its options are \
             those of all zero-length classes. -X_PY: in series with SPV, both have one force; the curve is the same both ways, begins \
             at zero, and its last slope goes on. -CONVOLUTION DF NAME: one more spring in series, of &DATA CONVOLUTION. -X_DAMPING: F \
             = min(Co v**Ex, Fo) against the velocity v between the ends while the spring acts (SENSE, or the contact of an LMU); for \
             Ex below 1 it is rounded off under 1 mm/s. -FRICTION MU: the resultant of the Y and Z spring forces is at most MU times \
             the X spring's; without Y and Z springs, MU times that force acts against the lateral velocity, rounded off under 1 cm/s, \
             zero in statics. Dashpots are not limited by friction. -SYMMETRIC: Z is as Y; P-Y curves and dashpots act on the resultant \
             of both. With SENSE, a viscoelastic spring that has not recovered yet does not pull where the element only pushes.",
    example: "MEDIT\n~PAD FOUNDATION COMPRESSION Z 5000 800 X 100 50\nEND\n&STATUS CLASS ~PAD",
    ..CommandSpec::new("FOUNDATION", "generalized spring with a foundation check")
};

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    Ok(Arc::new(GeneralizedSpring::read(records, "FOUNDATION")?.with_foundation_check()))
}
