//! Fenders of deck 14: FEND with the size, friction and damping, FLIN for where one stands; the polynomial of the last POLY is its reaction
//! over compression.
//!
//! Source: [AQWA-REF FEND, FLIN, POLY].

use super::card::Field;
use super::layout::CardRecord;
use super::lines::Property;
use super::remarks::Remarks;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// What a card FEND gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FenderProperties {
    /// Distance between the contact planes at which it just touches both.
    pub size: Field<f64>,
    /// Coefficient of friction.
    pub friction: Field<f64>,
    /// Damping over stiffness (s).
    pub damping: Field<f64>,
}

/// A side of a fender: a node of a structure, and a second one in the direction of the normal of the plane through the first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FenderSide {
    /// The structure; 0 is the fixed reference.
    pub structure: Field<i64>,
    /// The node.
    pub node: Field<i64>,
    /// The node that gives the direction; 0 for none.
    pub direction: Field<i64>,
}

/// A fender (FLIN).
#[derive(Clone, Debug, PartialEq)]
pub struct FenderCard {
    /// Type.
    pub kind: Field<i64>,
    /// Where it is fixed, and the contact plane that it meets.
    pub sides: [FenderSide; 2],
    /// Reaction P1 d + .. + P5 d^5 over the compression d.
    pub reaction: [f64; 5],
    /// The properties in force.
    pub properties: FenderProperties,
    /// The card.
    pub span: Span,
}

impl FenderProperties {
    /// Reads a card FEND.
    pub fn read(record: &CardRecord, remarks: &mut Remarks) -> FenderProperties {
        let made = FenderProperties { size: record.real(31), friction: record.real(51), damping: record.real(71) };
        for (field, columns, what, wrong) in [
            (made.size, "31-40", "size", made.size.value <= 0.0),
            (made.friction, "51-60", "friction coefficient", made.friction.value < 0.0),
            (made.damping, "71-80", "damping coefficient", made.damping.value < 0.0),
        ] {
            if wrong {
                let message = format!("deck 14, FEND, columns {columns}: {} is no {what} of a fender", field.value);
                remarks.add(Diagnostic::error(message, field.span).label(format!("{what} belongs here")));
            }
        }
        made
    }
}

impl FenderCard {
    /// Reads a card FLIN with the properties in force.
    pub fn read(
        record: &CardRecord,
        properties: &[Property],
        fender: Option<FenderProperties>,
        remarks: &mut Remarks,
    ) -> Option<FenderCard> {
        let (Some(Property::Polynomial(reaction)), Some(known)) = (properties.last(), fender) else {
            remarks.add(
                Diagnostic::error("deck 14, FLIN: POLY and FEND belong before a fender", record.span)
                    .label("the reaction over the compression, and the size of the fender")
                    .help("the last property card before FLIN is POLY"),
            );
            return None;
        };
        let side = |first: usize| FenderSide {
            structure: record.int(first),
            node: record.int(first + 5),
            direction: record.int(first + 10),
        };
        let kind = record.int(11);
        if !(0..=1).contains(&kind.value) {
            remarks.add(
                Diagnostic::error(
                    format!("deck 14, FLIN, columns 11-15: a fender of type {} is not read", kind.value),
                    kind.span,
                )
                .label("1 or nothing, a fixed fender that acts along the normal of its contact plane")
                .help("floating and omni-directional fenders are not modelled"),
            );
            return None;
        }
        remarks.add_once("type of a fender", || {
            Diagnostic::remark("deck 14, FLIN: no source gives the codes of fender types", kind.span)
                .label("assumed: 1 or nothing, a fixed fender that acts along the normal of its contact plane")
        });
        Some(FenderCard {
            kind,
            sides: [side(21), side(41)],
            reaction: *reaction,
            properties: known,
            span: record.span,
        })
    }
}
