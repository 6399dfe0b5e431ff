//! GSPR and FOUNDATION: generalized springs of zero length, in chosen degrees of freedom.
//!
//! Source: seed 001. A FOUNDATION is a GSPR that is checked in a FOUNDATION check.

use super::{ClassKind, checks, options as o};
use crate::language::args::Args;
use crate::language::diagnostic::{Diagnostic, Outcome};
use crate::language::source::Span;
use crate::language::spec::CommandSpec;
use crate::language::units::Dim;
use crate::model::{ClassRecord, Connector, ConnectorClass, Surroundings};
use crate::table::{Cell, Digits, Table};
use std::sync::Arc;

/// The class type GSPR.
pub static GSPR: ClassKind = ClassKind { spec: &GSPR_SPEC, segmented: false, build: build_gspr };
/// The class type FOUNDATION.
pub static FOUNDATION: ClassKind = ClassKind { spec: &FOUNDATION_SPEC, segmented: false, build: build_foundation };

static GSPR_SPEC: CommandSpec = CommandSpec {
    data: &[o::SENSE, o::DF, o::SPV, o::AF],
    repeat: 3,
    options: &[
        o::LEN,
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
    detail: "SENSE TENSION: no load while the element X displacement is negative; COMPRESSION: none while it is positive; \
             BOTH or left out: always. -LEN is an offset along element X. Element axes are the body axes of the first \
             node unless -EULER is given on the connector.",
    example: "MEDIT\n~FENDER GSPR COMPRESSION X 1000 500 -X_PY 10 0.1 50 0.3\nEND\n&STATUS CLASS ~FENDER",
    ..CommandSpec::new("GSPR", "generalized spring")
};

static FOUNDATION_SPEC: CommandSpec = CommandSpec {
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
    detail: "A GSPR of zero length that is checked in a FOUNDATION check.",
    example: "MEDIT\n~PAD FOUNDATION COMPRESSION Z 5000 800 X 100 50\nEND\n&STATUS CLASS ~PAD",
    ..CommandSpec { name: "FOUNDATION", help: "generalized spring with a foundation check", ..GSPR_SPEC }
};

/// One restrained degree of freedom.
#[derive(Clone, Debug, PartialEq)]
pub struct Restraint {
    /// X Y Z RX RY RZ.
    pub dof: String,
    /// Spring value (N/m or N m/rad).
    pub stiffness: f64,
    /// Allowable force or moment (N or N m), where checked.
    pub allowable: Option<f64>,
}

#[derive(Debug)]
struct Spring {
    kind: &'static str,
    sense: String,
    restraints: Vec<Restraint>,
    offset: f64,
    symmetric: bool,
}

/// Restraints in data from position `from`, three values each.
///
/// # Errors
/// The same degree of freedom twice.
pub fn restraints(args: &Args, from: usize) -> Outcome<Vec<Restraint>> {
    let mut list: Vec<(Restraint, Span)> = Vec::new();
    for group in args.data.get(from..).unwrap_or_default().chunks(3) {
        let (Some(dof), Some(span)) = (group.first().and_then(|v| v.word()), group.first().map(|v| v.span)) else {
            continue;
        };
        if let Some((_, first)) = list.iter().find(|(r, _)| r.dof == dof) {
            return Err(Diagnostic::error(format!("degree of freedom {dof} is given twice"), span)
                .other(*first, "first given here"));
        }
        let number = |index: usize| group.get(index).and_then(|v| v.number());
        let made = Restraint { dof: dof.to_string(), stiffness: number(1).unwrap_or(0.0), allowable: number(2) };
        list.push((made, span));
    }
    Ok(list.into_iter().map(|(r, _)| r).collect())
}

/// Checks `-SYMMETRIC`: only Y properties are given then.
///
/// # Errors
/// A Z property beside -SYMMETRIC.
pub fn symmetric(args: &Args, list: &[Restraint], default: bool) -> Outcome<bool> {
    let on = args.switch("-SYMMETRIC", default);
    let given = args.option("-SYMMETRIC").filter(|_| on);
    if let Some(given) = given {
        let has_z = list.iter().any(|r| r.dof.ends_with('Z')) || args.has("-Z_PY") || args.has("-Z_DAMPING");
        if has_z {
            return Err(Diagnostic::error("with -SYMMETRIC only the Y properties are given; Z follows", given.span));
        }
    }
    Ok(on)
}

/// Sees that `-CONVOLUTION DF NAME` acts in a degree of freedom that is restrained, once in each.
///
/// # Errors
/// Another degree of freedom, or one given twice, at its word.
pub fn convolutions(args: &Args, list: &[Restraint], symmetric: bool) -> Outcome<()> {
    let mut seen: Vec<(&str, Span)> = Vec::new();
    for value in args.all("-CONVOLUTION").filter_map(|given| given.values.first()) {
        let Some(dof) = value.word() else { continue };
        let like_y = dof.replace('Z', "Y");
        if !list.iter().any(|r| r.dof == dof || (symmetric && r.dof == like_y)) {
            let known: Vec<&str> = list.iter().map(|r| r.dof.as_str()).collect();
            return Err(Diagnostic::error(format!("degree of freedom {dof} is not restrained"), value.span)
                .label(format!("expected {}", known.join(" or "))));
        }
        if let Some((_, first)) = seen.iter().find(|(other, _)| *other == dof) {
            return Err(Diagnostic::error(format!("-CONVOLUTION is given twice for {dof}"), value.span)
                .other(*first, "first given here"));
        }
        seen.push((dof, value.span));
    }
    Ok(())
}

fn build_kind(records: &[ClassRecord], kind: &'static str) -> Outcome<Arc<dyn ConnectorClass>> {
    let Some(record) = records.last() else { return Err(Diagnostic::error("a class needs a record", Span::default())) };
    let args = &record.args;
    checks::py_curves(args)?;
    let list = restraints(args, 1)?;
    let symmetric = symmetric(args, &list, false)?;
    convolutions(args, &list, symmetric)?;
    Ok(Arc::new(Spring {
        kind,
        sense: args.word(0).unwrap_or("BOTH").to_string(),
        symmetric,
        restraints: list,
        offset: args.option_number("-LEN").unwrap_or(0.0),
    }))
}

fn build_gspr(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    build_kind(records, "GSPR")
}

fn build_foundation(records: &[ClassRecord]) -> Outcome<Arc<dyn ConnectorClass>> {
    build_kind(records, "FOUNDATION")
}

impl ConnectorClass for Spring {
    fn kind(&self) -> &'static str {
        self.kind
    }

    fn check_ends(&self, connector: &Connector, bodies: usize) -> Outcome<()> {
        no_anchor(self.kind, connector)?;
        checks::ends(self.kind, connector, bodies, 2, 2)
    }

    fn properties(&self, name: &str, _: &Surroundings) -> Table {
        restraint_table(name, self.kind, &self.restraints)
            .fact("Sense", self.sense.as_str(), Dim::None)
            .fact("Offset along X", self.offset, Dim::Length)
            .fact("Symmetric about X", if self.symmetric { "YES" } else { "NO" }, Dim::None)
    }

    fn first_length(&self) -> Option<f64> {
        Some(self.offset)
    }
}

/// Only lines to ground have an anchor.
///
/// # Errors
/// `-ANCHOR` on another class.
pub fn no_anchor(kind: &str, connector: &Connector) -> Outcome<()> {
    if connector.anchor.is_some() {
        return Err(Diagnostic::error(format!("-ANCHOR belongs to lines, not to a {kind}"), connector.span));
    }
    Ok(())
}

/// The `&STATUS CLASS` table of restraints.
pub fn restraint_table(name: &str, kind: &str, restraints: &[Restraint]) -> Table {
    let mut table = Table::new(format!("Class {name}"))
        .fact("Type", kind, Dim::None)
        .column("", "DF", Dim::None, Digits::Usual)
        .column("Translation", "Stiffness", Dim::ForcePerLength, Digits::Usual)
        .column("Translation", "Allowable", Dim::Force, Digits::Usual)
        .column("Rotation", "Rot. Stiffness", Dim::MomentPerRadian, Digits::Usual)
        .column("Rotation", "Rot. Allowable", Dim::Moment, Digits::Usual);
    for r in restraints {
        let (stiffness, allowable) = (Cell::Number(r.stiffness), Cell::from(r.allowable));
        let none = || Cell::Missing;
        let mut row = vec![Cell::Text(r.dof.clone())];
        if r.dof.len() == 1 {
            row.extend([stiffness, allowable, none(), none()]);
        } else {
            row.extend([none(), none(), stiffness, allowable]);
        }
        // the row has one cell a column, made just above
        let _ = table.push(row);
    }
    table
}
