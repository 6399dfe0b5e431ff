//! ROLLER: four physical rollers around a pipe.
//!
//! Source: [MOSES-FLEX ROLLER]. Gaps are in inches or mm; the second end is taken care of by the assembly.

use super::spring::{GENERALIZED_RESTRAINTS, Restraint, SENSE, Springs, no_anchor, restraint_table, restraints};
use super::zero_law::{ContactGeometry, Sense};
use super::{ClassKind, checks, options as o};
use nalgebra::Vector3;
use std::sync::Arc;
use windlass_base::choice::Dof;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::spec::ValueKey;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{
    ClassError, ClassRecord, ClassRole, Connection, Connector, ConnectorClass, ConnectorElement, Surroundings,
};

/// The class type.
pub static ROLLER: ClassKind = ClassKind { spec: &SPEC, build, idle: &[] };

const fn gap(name: &'static str, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(Dim::Section), help).not_negative()
}

const Y_ROLLER: OptionSpec = OptionSpec::new(
    "-Y_ROLLER",
    &[gap("Y-", "gap on the negative side"), gap("Y+", "gap on the positive side")],
    "gaps of the side rollers",
);
const Z_ROLLER: OptionSpec = OptionSpec::new(
    "-Z_ROLLER",
    &[gap("Z-", "gap below"), gap("Z+", "gap above")],
    "gaps of the lower and upper roller",
);

static SPEC: CommandSpec = CommandSpec {
    data: &o::GENERALIZED,
    repeat: 3,
    options: &[o::Y_PY, o::Z_PY, Y_ROLLER, Z_ROLLER],
    detail: "Pipe Y is lateral and Z upward: the axes of the node's body, turned by -EULER of the connector. -Y_ROLLER Y- Y+ and -Z_ROLLER \
             Z- Z+: the pipe moves freely by so much on each side of the node; beyond, the physical roller there pushes it back with \
             the SPV of Y or Z (1.0E9 N/m where none is given). With neither, lateral motion is restrained and the pipe cannot go below \
             the node; it can lift off. With one of them only, nothing restrains the other direction. A one-sided restraint: Z- 0, Z+ \
             10000. X, RX, RY and RZ are springs that act always. Rollers only push: SENSE COMPRESSION and BOTH say the same, TENSION is refused, and so is \
             COMPRESSION beside an X spring, which acts both ways. -Y_PY and -Z_PY \
             are in series with the rollers. A single point: the pipe assembly takes care of the other end, and without one it exerts \
             no force.",
    example: "MEDIT\n~ROLL ROLLER COMPRESSION Y 100 Z 100 -Z_ROLLER 0 10000\nEND\n&STATUS CLASS ~ROLL",
    ..CommandSpec::new("ROLLER", "rollers that carry a pipe")
};

/// Stiffness of a physical roller whose SPV is not given (N/m).
const DEFAULT_ROLLER_STIFFNESS: f64 = 1e9;

#[derive(Debug)]
struct Roller {
    given: Vec<Restraint>,
    springs: Springs,
    sides: Option<[f64; 2]>,
    heights: Option<[f64; 2]>,
}

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let Some(record) = records.last() else { return Err(Diagnostic::error("a class needs a record", Span::default())) };
    let args = &record.args;
    let gaps = |option: &OptionSpec, [below, above]: [ValueKey<f64>; 2]| {
        args.option(option).and_then(|g| Some([g.number(below)?, g.number(above)?]))
    };
    let given = restraints(args, GENERALIZED_RESTRAINTS)?;
    match args.choice(SENSE).unwrap_or(Sense::Both) {
        Sense::Tension => {
            return Err(Diagnostic::error("a ROLLER only pushes: SENSE TENSION has no meaning", args.position(SENSE))
                .help("leave SENSE out, or COMPRESSION"));
        }
        Sense::Compression if given.iter().any(|r| r.dof == Dof::X) => {
            return Err(Diagnostic::error(
                "the X spring of a ROLLER, along the pipe, acts both ways",
                args.position(SENSE),
            )
            .label("SENSE COMPRESSION cannot hold for it")
            .help("leave SENSE out: the rollers push all the same"));
        }
        Sense::Compression | Sense::Both => {}
    }
    let mut all = given.clone();
    for dof in [Dof::Y, Dof::Z] {
        if !all.iter().any(|r| r.dof == dof) {
            all.push(Restraint { dof, stiffness: DEFAULT_ROLLER_STIFFNESS, allowable: None });
        }
    }
    let springs = Springs::from_options(args, all, false, Vec::new())?;
    Ok(Arc::new(Roller {
        given,
        springs,
        sides: gaps(&Y_ROLLER, const { Y_ROLLER.numbers(["Y-", "Y+"]) }),
        heights: gaps(&Z_ROLLER, const { Z_ROLLER.numbers(["Z-", "Z+"]) }),
    }))
}

impl Roller {
    /// Gaps in Y and Z (m).
    fn gaps(&self) -> [Option<[f64; 2]>; 2] {
        match (self.sides, self.heights) {
            (None, None) => [Some([0.0, 0.0]), Some([0.0, f64::INFINITY])],
            gaps => gaps.into(),
        }
    }
}

impl ConnectorClass for Roller {
    fn kind(&self) -> &'static str {
        "ROLLER"
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        no_anchor("ROLLER", connector)?;
        checks::ends("ROLLER", connector, bodies, 1, 1)
    }

    fn properties(&self, name: &str, _: &Surroundings) -> Table {
        let mut table = restraint_table(name, "ROLLER", &self.given);
        for (label, gaps) in [("Y", self.sides), ("Z", self.heights)] {
            if let Some([below, above]) = gaps {
                table = table.fact(&format!("Gap {label}-"), below, Dim::Section).fact(
                    &format!("Gap {label}+"),
                    above,
                    Dim::Section,
                );
            }
        }
        if self.sides.is_none() && self.heights.is_none() {
            table.note("no gaps: no lateral motion, and the pipe cannot go below the roller");
        }
        table
    }

    fn role(&self) -> ClassRole {
        ClassRole::PipeRoller
    }

    /// Between the node and the point of the pipe that an assembly gives: it asks with `to_ground` false.
    fn element(&self, connection: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        checks::in_assembly("ROLLER", connection)?;
        self.springs.element(connection, Sense::Both, ContactGeometry::Gaps(self.gaps()), Vector3::zeros())
    }
}
