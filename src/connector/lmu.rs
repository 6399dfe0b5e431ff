//! LMU: a pin in a cone.
//!
//! Source: seed 001 and its Figure 7. All three sizes are in inches or mm; OD(1) is the pin, OD(2) the mouth of the cone.

use super::spring::{Restraint, convolutions, no_anchor, restraint_table, restraints, symmetric};
use super::{ClassKind, checks, options as o};
use crate::language::diagnostic::{Diagnostic, Outcome};
use crate::language::source::Span;
use crate::language::spec::{CommandSpec, Kind, ValueSpec};
use crate::language::units::Dim;
use crate::model::{ClassRecord, Connector, ConnectorClass, Surroundings};
use crate::table::Table;
use std::sync::Arc;

/// The class type.
pub static LMU: ClassKind = ClassKind { spec: &SPEC, segmented: false, build };

static SPEC: CommandSpec = CommandSpec {
    data: &[
        ValueSpec::new("LEN", Kind::Number(Dim::Section), "length of the cone").positive(),
        ValueSpec::new("OD(1)", Kind::Number(Dim::Section), "diameter of the pin").positive(),
        ValueSpec::new("OD(2)", Kind::Number(Dim::Section), "diameter of the cone's mouth").positive(),
        o::DF,
        o::SPV,
        o::AF,
    ],
    repeat: 3,
    options: &[
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
    ],
    detail: "A GSPR with a SENSE of COMPRESSION whose deformation follows from the cone: T = (OD(2) - OD(1)) / (2 LEN). \
             The first point is the tip of the pin, the second the top of the cone. Symmetric unless -SYMMETRIC NO.",
    example: "MEDIT\n~LMU1 LMU 60 24 48 X 5000 1000 Y 800 300\nEND\n&STATUS CLASS ~LMU1",
    ..CommandSpec::new("LMU", "leg mating unit: a pin in a cone")
};

#[derive(Debug)]
struct PinInCone {
    length: f64,
    pin: f64,
    mouth: f64,
    restraints: Vec<Restraint>,
    symmetric: bool,
}

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let Some(record) = records.last() else { return Err(Diagnostic::error("a class needs a record", Span::default())) };
    let args = &record.args;
    let at = |index: usize| args.number(index).unwrap_or(0.0);
    let (length, pin, mouth) = (at(0), at(1), at(2));
    if mouth < pin {
        return Err(Diagnostic::error("the cone's mouth OD(2) is smaller than the pin OD(1)", args.place(2)));
    }
    checks::py_curves(args)?;
    let list = restraints(args, 3)?;
    let symmetric = symmetric(args, &list, true)?;
    convolutions(args, &list, symmetric)?;
    Ok(Arc::new(PinInCone { length, pin, mouth, symmetric, restraints: list }))
}

impl ConnectorClass for PinInCone {
    fn kind(&self) -> &'static str {
        "LMU"
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        no_anchor("LMU", connector)?;
        checks::ends("LMU", connector, bodies, 2, 2)
    }

    fn properties(&self, name: &str, _: &Surroundings) -> Table {
        restraint_table(name, "LMU", &self.restraints)
            .fact("Length", self.length, Dim::Section)
            .fact("Pin OD(1)", self.pin, Dim::Section)
            .fact("Cone Mouth OD(2)", self.mouth, Dim::Section)
            .fact("Cone Tangent T", (self.mouth - self.pin) / (2.0 * self.length), Dim::None)
            .fact("Symmetric about X", if self.symmetric { "YES" } else { "NO" }, Dim::None)
    }

    fn first_length(&self) -> Option<f64> {
        Some(self.length)
    }
}
