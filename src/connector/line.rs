//! ROD, H_CAT and SL_ELEM: lines between a body and ground or another body.
//!
//! Source: seed 001. The engines that give them force come with later issues; their records are read, checked, kept
//! and listed here.

use super::section::{LineSection, properties};
use super::{ClassKind, checks, options as o};
use crate::language::diagnostic::{Diagnostic, Outcome};
use crate::language::source::Span;
use crate::language::spec::{CommandSpec, Kind, ValueSpec};
use crate::language::units::Dim;
use crate::model::{ClassRecord, Connector, ConnectorClass, Surroundings};
use crate::table::Table;
use std::sync::Arc;

/// The class type ROD.
pub static ROD: ClassKind = ClassKind { spec: &ROD_SPEC, segmented: true, build: build_rod };
/// The class type H_CAT.
pub static H_CAT: ClassKind = ClassKind { spec: &H_CAT_SPEC, segmented: true, build: build_h_cat };
/// The class type SL_ELEM.
pub static SL_ELEM: ClassKind = ClassKind { spec: &SL_ELEM_SPEC, segmented: true, build: build_sl_elem };

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

static H_CAT_SPEC: CommandSpec = CommandSpec {
    data: &[o::LINE_OD, ValueSpec::new("FLAG", Kind::Choice(&["EXACT"]), "with its weight").or("weightless")],
    options: &[
        o::LEN,
        o::TYPE,
        o::REFINE,
        o::IG_STIFF,
        o::SEND,
        o::X_PY,
        o::X_DAMPING,
        o::SPGRAVITY,
        o::DENSITY,
        o::CONVOLUTION,
        o::EMODULUS,
        o::POI_RAT,
        o::ALPHA,
        o::FYIELD,
        o::TENSTR,
        o::WTPLEN,
        o::DISPLEN,
        o::PISTON,
        o::B_TENSION,
        o::C_SN,
        o::TAB_LIM,
        o::CLUMP,
        o::BUOYDIAMETER,
        o::DRAGDIAMETER,
        o::WINDDIAMETER,
        o::AMASDIAMETER,
    ],
    detail: "A hanging catenary: it knows neither bottom nor surface, and takes no buoys. Without EXACT it is weightless: \
             a spring along the chord that only pulls.",
    example: "MEDIT\n~HANG H_CAT 3 EXACT -LEN 400\nEND\n&STATUS CLASS ~HANG",
    ..CommandSpec::new("H_CAT", "hanging catenary")
};

static SL_ELEM_SPEC: CommandSpec = CommandSpec {
    data: &[
        o::LINE_OD,
        ValueSpec::new("FLAG", Kind::Choice(&["TENSION"]), "tension only").or("tension and compression"),
    ],
    detail: "Its force depends only on the distance between the ends and acts along the line between them.",
    example: "MEDIT\n~TIE SL_ELEM 3 TENSION -LEN 50\nEND\n&STATUS CLASS ~TIE",
    ..CommandSpec { name: "SL_ELEM", help: "spring along the chord between its ends", ..H_CAT_SPEC }
};

#[derive(Debug)]
struct LineClass {
    kind: &'static str,
    flag: &'static str,
    sections: Vec<LineSection>,
}

fn sections(records: &[ClassRecord], kind: &'static str, tube: bool) -> Outcome<Vec<LineSection>> {
    for name in
        ["-SEND", "-X_PY", "-X_DAMPING", "-CONVOLUTION", "-PISTON", "-TAB_LIM", "-FRICTION", "-SLOPE", "-DEPANCHOR"]
    {
        checks::once(records, name)?;
    }
    records.iter().map(|r| LineSection::read(r, kind, tube)).collect()
}

fn build_rod(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    let sections = sections(records, "ROD", true)?;
    let elements = sections.iter().fold(0i64, |sum, s| sum.saturating_add(s.refine));
    if elements > ROD_ELEMENTS {
        let span = records.last().map_or(Span::default(), |r| r.args.option("-REFINE").map_or(r.args.span, |g| g.span));
        return Err(Diagnostic::error(format!("a ROD has at most {ROD_ELEMENTS} elements"), span)
            .label(format!("with this segment it has {elements}")));
    }
    Ok(Arc::new(LineClass { kind: "ROD", flag: "", sections }))
}

fn build_h_cat(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    for record in records {
        if let Some(clump) = record.args.option("-CLUMP").filter(|c| c.number(0).is_some_and(|w| w < 0.0)) {
            return Err(Diagnostic::error("an H_CAT takes no spring buoy", clump.span).help("use B_CAT"));
        }
    }
    let exact = records.iter().any(|r| r.args.word(1) == Some("EXACT"));
    let sections = sections(records, "H_CAT", false)?;
    Ok(Arc::new(LineClass { kind: "H_CAT", flag: if exact { "EXACT" } else { "weightless" }, sections }))
}

fn build_sl_elem(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    for record in records {
        if let Some(clump) = record.args.option("-CLUMP").filter(|c| c.number(0).is_some_and(|w| w < 0.0)) {
            return Err(Diagnostic::error("an SL_ELEM takes no spring buoy", clump.span).help("use B_CAT"));
        }
    }
    let tension = records.iter().any(|r| r.args.word(1) == Some("TENSION"));
    let sections = sections(records, "SL_ELEM", false)?;
    Ok(Arc::new(LineClass {
        kind: "SL_ELEM",
        flag: if tension { "TENSION" } else { "tension and compression" },
        sections,
    }))
}

impl ConnectorClass for LineClass {
    fn kind(&self) -> &'static str {
        self.kind
    }

    fn check(&self) -> Outcome<()> {
        Ok(())
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        checks::ends(self.kind, connector, bodies, 2, 2)
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        let table = properties(name, self.kind, &self.sections, surroundings);
        if self.flag.is_empty() { table } else { table.fact("Flag", self.flag, Dim::None) }
    }

    fn first_length(&self) -> Option<f64> {
        self.sections.first().map(|s| s.length)
    }
}
