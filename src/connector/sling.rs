//! SLING and DAVIT: lines whose force depends only on the distance between the ends; AE/L, tension only.
//!
//! Source: seed 001: the area is that of a solid circle of OD; the only other option is -EMODULUS.

use super::section::{LineSection, properties};
use super::spring::no_anchor;
use super::{ClassKind, checks, options as o};
use crate::language::diagnostic::Outcome;
use crate::language::spec::CommandSpec;
use crate::language::units::Dim;
use crate::model::{ClassRecord, Connector, ConnectorClass, Surroundings};
use crate::table::Table;
use std::sync::Arc;

/// The class type SLING.
pub static SLING: ClassKind = ClassKind { spec: &SLING_SPEC, segmented: false, build: build_sling };
/// The class type DAVIT.
pub static DAVIT: ClassKind = ClassKind { spec: &DAVIT_SPEC, segmented: false, build: build_davit };

static SLING_SPEC: CommandSpec = CommandSpec {
    data: &[o::OD],
    options: &[o::LEN, o::EMODULUS],
    detail: "Stiffness AE/L with the full area of OD. A single point; the assembly takes care of the other end.",
    example: "MEDIT\n~SL1 SLING 4 -LEN 120 -EMOD 12000\nEND\n&STATUS CLASS ~SL1",
    ..CommandSpec::new("SLING", "lifting sling")
};
static DAVIT_SPEC: CommandSpec = CommandSpec {
    example: "MEDIT\n~DV1 DAVIT 2 -LEN 30\nEND\n&STATUS CLASS ~DV1",
    ..CommandSpec { name: "DAVIT", help: "davit line of a pipe being laid", ..SLING_SPEC }
};

#[derive(Debug)]
struct Sling {
    kind: &'static str,
    section: Vec<LineSection>,
}

fn build(records: &[ClassRecord], kind: &'static str) -> Outcome<Arc<dyn ConnectorClass>> {
    let section =
        records.iter().rev().take(1).map(|r| LineSection::read(r, kind, false)).collect::<Outcome<Vec<_>>>()?;
    Ok(Arc::new(Sling { kind, section }))
}

fn build_sling(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    build(records, "SLING")
}

fn build_davit(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    build(records, "DAVIT")
}

impl ConnectorClass for Sling {
    fn kind(&self) -> &'static str {
        self.kind
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        no_anchor(self.kind, connector)?;
        checks::ends(self.kind, connector, bodies, 1, 1)
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        let stiffness = self.section.first().map(|s| s.ea / s.length);
        properties(name, self.kind, &self.section, surroundings).fact("Stiffness AE/L", stiffness, Dim::ForcePerLength)
    }

    fn first_length(&self) -> Option<f64> {
        self.section.first().map(|s| s.length)
    }
}
