//! ROLLER: four physical rollers around a pipe.
//!
//! Source: seed 001. Gaps are in inches or mm; the second end is taken care of by the assembly.

use super::spring::{Restraint, no_anchor, restraint_table, restraints};
use super::{ClassKind, checks, options as o};
use crate::language::diagnostic::{Diagnostic, Outcome};
use crate::language::source::Span;
use crate::language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use crate::language::units::Dim;
use crate::model::{ClassRecord, Connector, ConnectorClass, Surroundings};
use crate::table::Table;
use std::sync::Arc;

/// The class type.
pub static ROLLER: ClassKind = ClassKind { spec: &SPEC, segmented: false, build };

const fn gap(name: &'static str, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(Dim::Section), help).not_negative()
}

static SPEC: CommandSpec = CommandSpec {
    data: &[o::SENSE, o::DF, o::SPV, o::AF],
    repeat: 3,
    options: &[
        o::Y_PY,
        o::Z_PY,
        OptionSpec::new(
            "-Y_ROLLER",
            &[gap("Y-", "gap on the negative side"), gap("Y+", "gap on the positive side")],
            "gaps of the side rollers",
        ),
        OptionSpec::new(
            "-Z_ROLLER",
            &[gap("Z-", "gap below"), gap("Z+", "gap above")],
            "gaps of the lower and upper roller",
        ),
    ],
    detail: "With neither -Y_ROLLER nor -Z_ROLLER lateral motion is restrained and the pipe cannot go below the roller. \
             A one-sided restraint: Z- 0, Z+ 10000.",
    example: "MEDIT\n~ROLL ROLLER COMPRESSION Y 100 Z 100 -Z_ROLLER 0 10000\nEND\n&STATUS CLASS ~ROLL",
    ..CommandSpec::new("ROLLER", "rollers that carry a pipe")
};

#[derive(Debug)]
struct Roller {
    restraints: Vec<Restraint>,
    sides: Option<(f64, f64)>,
    heights: Option<(f64, f64)>,
}

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let Some(record) = records.last() else { return Err(Diagnostic::error("a class needs a record", Span::default())) };
    let args = &record.args;
    checks::py_curves(args)?;
    let gaps = |name: &str| args.option(name).and_then(|g| Some((g.number(0)?, g.number(1)?)));
    Ok(Arc::new(Roller { restraints: restraints(args, 1)?, sides: gaps("-Y_ROLLER"), heights: gaps("-Z_ROLLER") }))
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
        let mut table = restraint_table(name, "ROLLER", &self.restraints);
        for (label, gaps) in [("Y", self.sides), ("Z", self.heights)] {
            if let Some((below, above)) = gaps {
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
}
