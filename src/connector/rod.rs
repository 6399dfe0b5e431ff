//! ROD: a line with bending stiffness and its own dynamics.
//!
//! Source: seed 001. Its engine comes with a later issue; its records are read, checked, kept and listed here.

use super::pipe::Pipe;
use super::section::{LineSection, properties};
use super::{ClassKind, checks, options as o};
use crate::language::diagnostic::{Diagnostic, Outcome};
use crate::language::source::Span;
use crate::language::spec::{CommandSpec, Kind, ValueSpec};
use crate::language::units::Dim;
use crate::model::{
    ClassError, ClassRecord, Connector, ConnectorClass, Element, FatigueSegment, PipeLayout, Surroundings,
};
use crate::table::Table;
use std::sync::Arc;

/// The class type.
pub static ROD: ClassKind = ClassKind { spec: &ROD_SPEC, segmented: true, build };

/// Most elements of a rod, all segments together (seed 001).
const ROD_ELEMENTS: i64 = 300;

static ROD_SPEC: CommandSpec = CommandSpec {
    data: &[o::OD, ValueSpec::new("T", Kind::Number(Dim::Section), "wall thickness").positive()],
    options: &[
        o::LEN,
        o::REFINE,
        o::IG_STIFF,
        o::SPGRAVITY,
        o::DENSITY,
        o::EMODULUS,
        o::POI_RAT,
        o::ALPHA,
        o::FYIELD,
        o::TENSTR,
        o::WTPLEN,
        o::DISPLEN,
        o::B_TENSION,
        o::C_SN,
        o::CLUMP,
        o::BUOYDIAMETER,
        o::DRAGDIAMETER,
        o::WINDDIAMETER,
        o::AMASDIAMETER,
        o::FRICTION,
        o::SLOPE,
        o::DEPANCHOR,
    ],
    detail: "Large-deflection tubular elements with inertia; at most 300 elements over all segments. No convolution.",
    example: "MEDIT\n~PIPE ROD 12.75 0.5 -LEN 1000 -REFINE 50\nEND\n&STATUS CLASS ~PIPE",
    ..CommandSpec::new("ROD", "line with bending stiffness and its own dynamics")
};

#[derive(Debug)]
struct Rod(Vec<LineSection>);

fn build(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    for name in ["-FRICTION", "-SLOPE", "-DEPANCHOR"] {
        checks::once(records, name)?;
    }
    let sections = records.iter().map(|r| LineSection::read(r, "ROD", true)).collect::<Outcome<Vec<_>>>()?;
    let elements = sections.iter().fold(0i64, |sum, s| sum.saturating_add(s.refine));
    if elements > ROD_ELEMENTS {
        let span = records.last().map_or(Span::default(), |r| r.args.option("-REFINE").map_or(r.args.span, |g| g.span));
        return Err(Diagnostic::error(format!("a ROD has at most {ROD_ELEMENTS} elements"), span)
            .label(format!("with this segment it has {elements}")));
    }
    Ok(Arc::new(Rod(sections)))
}

impl ConnectorClass for Rod {
    fn kind(&self) -> &'static str {
        "ROD"
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        checks::ends("ROD", connector, bodies, 2, 2)
    }

    fn fatigue_segments(&self) -> Vec<FatigueSegment> {
        self.0.iter().map(LineSection::fatigue).collect()
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        properties(name, "ROD", &self.0, surroundings)
    }

    fn first_length(&self) -> Option<f64> {
        self.0.first().map(|s| s.length)
    }

    /// A pipe of the first segment's section, as long as it needs to be.
    fn pipe(&self, layout: PipeLayout) -> Result<Box<dyn Element>, ClassError> {
        let section = self.0.first().ok_or_else(|| ClassError::new("the class has no record"))?;
        Ok(Box::new(Pipe::laid(section, layout)?))
    }
}
