//! LMU: a pin in a cone.
//!
//! Source: [MOSES-FLEX LMU, Figure 7]. All three sizes are in inches or mm; OD(1) is the pin, OD(2) the mouth of the cone.

use super::foundation::OPTIONS;
use super::spring::{RestraintKeys, Springs, no_anchor, restraint_table};
use super::zero_law::{ContactGeometry, Sense};
use super::zero_length::{ZeroLength, element_turns};
use super::{ClassKind, checks, options as o};
use nalgebra::{Matrix3, Vector3};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, ValueSpec};
use windlass_model::{
    ClassError, ClassRecord, Connection, Connector, ConnectorCategory, ConnectorClass, ConnectorElement, LengthClass,
    Surroundings,
};

/// The class type.
pub static LMU: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

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
    options: OPTIONS,
    detail: "A GSPR with a SENSE of COMPRESSION whose deflections follow from the cone: T = (OD(2) - OD(1)) / (2 LEN). The first point \
             is the tip of the pin, the second the top of the cone. The cone's axis, element X, is the z axis of the second point's body, \
             upward out of the mouth, turned by -EULER of the connector; element Y and Z are that body's x and y. D_v is how far the tip \
             is below the mouth along the axis, D_h how far from the axis. No force for D_v < 0. Sides: d = max(0, D_h - T max(0, LEN - \
             D_v)) deflects Y (and Z), which push the pin toward the axis. Bottom: c = max(0, D_v - LEN) + T d compresses X, which \
             pushes the pin out of the cone. That is the text of the manual with two signs mended: taken literally it pulls a centred \
             pin outward, and unloads one that has landed. With unlike SPV in X and Y these forces have no energy. A tip beside the mouth \
             is warned of. Symmetric unless -SYMMETRIC NO or Z properties are given. &HELP ~CLASS FOUNDATION lists the options.",
    example: "MEDIT\n*CONE 0 0 0\n&DESCRIBE BODY DECK\n*PIN 0 0 0\n~LMU1 LMU 60 24 48 X 5000 1000 Y 800 300\n\
              CONNECTOR L1 ~LMU1 *PIN *CONE\nEND\n&STATUS CLASS ~LMU1",
    ..CommandSpec::new("LMU", "leg mating unit: a pin in a cone")
};

#[derive(Debug)]
struct PinInCone {
    length: f64,
    pin: f64,
    mouth: f64,
    springs: Springs,
}

/// Element axes of an upright cone in its body: X along z, Y along x, Z along y.
const UPRIGHT: Matrix3<f64> = Matrix3::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0);

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let Some(record) = records.last() else { return Err(Diagnostic::error("a class needs a record", Span::default())) };
    let args = &record.args;
    const MOUTH: DatumKey<f64> = SPEC.number("OD(2)");
    let [length, pin, mouth] = args.numbers_or_zero(const { SPEC.numbers(["LEN", "OD(1)", "OD(2)"]) });
    if mouth < pin {
        return Err(Diagnostic::error("the cone's mouth OD(2) is smaller than the pin OD(1)", args.position(MOUTH)));
    }
    let keys = RestraintKeys {
        dof: const { SPEC.choice("DF") },
        stiffness: const { SPEC.number("SPV") },
        allowable: Some(const { SPEC.number("AF") }),
    };
    Ok(Arc::new(PinInCone { length, pin, mouth, springs: Springs::read(args, keys, true)? }))
}

impl PinInCone {
    /// Tangent of the angle between the cone's side and its axis.
    fn tangent(&self) -> f64 {
        (self.mouth - self.pin) / (2.0 * self.length)
    }
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
        restraint_table(name, "LMU", &self.springs.restraints)
            .fact("Length", self.length, Dim::Section)
            .fact("Pin OD(1)", self.pin, Dim::Section)
            .fact("Cone Mouth OD(2)", self.mouth, Dim::Section)
            .fact("Cone Tangent T", self.tangent(), Dim::None)
            .fact("Symmetric about X", if self.springs.symmetric { "YES" } else { "NO" }, Dim::None)
    }

    fn element(&self, connection: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        // the cone carries the axes, the pin is displaced in them
        let holder = 1;
        let (turn, other_turn) = element_turns(connection, holder, UPRIGHT);
        let contact = ContactGeometry::Cone { length: self.length, tangent: self.tangent() };
        let law = self.springs.law(connection, Sense::Compression, contact)?;
        let listed = self.springs.reported_stiffnesses();
        Ok(Box::new(ZeroLength {
            holder,
            turn,
            other_turn,
            rest: Vector3::zeros(),
            law,
            listed,
            category: ConnectorCategory::Flexible,
        }))
    }

    fn as_length(&self) -> Option<&dyn LengthClass> {
        Some(self)
    }
}

impl LengthClass for PinInCone {
    fn first_length(&self) -> Option<f64> {
        Some(self.length)
    }
}
