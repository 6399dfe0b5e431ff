//! Mooring lines of deck 14 and the properties they refer to.
//!
//! A property (POLY; COMP with its ECAT, ECAX, ECAH, ECAB, BUOY and CLMP cards) serves all NLIN cards that follow it, up
//! to the next one. Sections are listed from the anchor upwards.
//!
//! Source: [AQWA-REF deck 14]; [AQWA-CONN 5.8.3] for what a section holds.

use super::card::Field;
use super::layout::CardRecord;
use super::remarks::Remarks;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Most sections of a composite line.
const MAX_SECTIONS: i64 = 10;
/// Most points of the table of a composite line.
const MAX_TABLE_POINTS: i64 = 600;

/// Where a line is fixed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// First structure; 0 is the fixed reference.
    pub structure1: Field<i64>,
    /// Node on it.
    pub node1: Field<i64>,
    /// Second structure; 0 is the fixed reference.
    pub structure2: Field<i64>,
    /// Node on it.
    pub node2: Field<i64>,
}

impl Ends {
    /// Structure and node of both ends.
    pub fn numbers(&self) -> [i64; 4] {
        [self.structure1, self.node1, self.structure2, self.node2].map(|field| field.value)
    }
}

/// What a mooring line is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LineKind {
    /// LINE: linear elastic.
    Elastic {
        /// Stiffness (force a length).
        stiffness: f64,
        /// Unstretched length.
        length: f64,
    },
    /// LNDW: linear elastic on a winch.
    Winched {
        /// Stiffness at the start length.
        stiffness: f64,
        /// Length at the start.
        start: f64,
        /// Length at which the winch stops.
        end: f64,
        /// Speed of paying out.
        speed: f64,
        /// Tension at which the winch stalls.
        tension: f64,
    },
    /// FORC: constant force towards the second node.
    Force(
        /// The force.
        f64,
    ),
    /// WNCH: constant tension.
    Winch {
        /// Tension.
        tension: f64,
        /// Length.
        length: f64,
        /// Friction factor while winding in.
        winding_in: f64,
        /// Friction factor while paying out.
        paying_out: f64,
    },
    /// NLIN, NLID: as the property of this index says.
    Property {
        /// Index of the property.
        property: usize,
        /// Winch tension; 0 for none.
        tension: f64,
        /// Unstretched length, for POLY.
        length: f64,
        /// Friction factor while winding in.
        winding_in: f64,
        /// Friction factor while paying out.
        paying_out: f64,
        /// Whether cable dynamics was asked for (NLID).
        dynamic: bool,
    },
}

/// A mooring line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MooringLine {
    /// Where it is fixed.
    pub ends: Ends,
    /// What it is.
    pub kind: LineKind,
    /// The card.
    pub span: Span,
}

/// A point between two sections of a composite line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompositeJoint {
    /// Whether it is a buoy (BUOY); else a clump weight (CLMP).
    pub buoy: bool,
    /// Mass.
    pub mass: f64,
    /// Mass of the water displaced.
    pub displaced: f64,
    /// Added mass.
    pub added: f64,
    /// Drag coefficient times area.
    pub drag: f64,
    /// The card.
    pub span: Span,
}

/// Added mass and drag of a section (ECAH).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectionResistance {
    /// Added mass coefficient.
    pub added_mass: f64,
    /// Drag coefficient.
    pub drag: f64,
    /// Diameter for drag.
    pub diameter: f64,
    /// Inline drag coefficient.
    pub inline: f64,
}

/// A section of a composite line (ECAT and the cards that follow it).
#[derive(Clone, Debug, PartialEq)]
pub struct CompositeSection {
    /// Mass a length.
    pub mass: f64,
    /// Area of the cross-section.
    pub area: f64,
    /// EA; by default 5.0E6 times the mass a length.
    pub stiffness: f64,
    /// Greatest tension; by default 5.0E4 times the mass a length.
    pub tension: f64,
    /// Unstretched length.
    pub length: f64,
    /// ECAX: EA grows by k1 e + k2 e^2 + k3 e^3 with the strain e.
    pub growth: Option<[f64; 3]>,
    /// ECAH in force.
    pub resistance: Option<SectionResistance>,
    /// ECAB: EI; 0 when not given.
    pub bending: f64,
    /// BUOY or CLMP at the upper end.
    pub joint: Option<CompositeJoint>,
    /// The card.
    pub span: Span,
}

/// A composite catenary (COMP).
#[derive(Clone, Debug, PartialEq)]
pub struct Composite {
    /// Vertical levels and horizontal offsets of its table.
    pub points: (i64, i64),
    /// Sections that were announced.
    pub announced: Field<i64>,
    /// Lowest and highest Z of the first attachment.
    pub heights: (f64, f64),
    /// Slope of the sea bed (degrees).
    pub slope: f64,
    /// The sections, from the anchor upwards.
    pub sections: Vec<CompositeSection>,
    /// The card.
    pub span: Span,
}

/// What a non-linear line refers to.
#[derive(Clone, Debug, PartialEq)]
pub enum Property {
    /// POLY: tension P1 e + P2 e^2 + .. + P5 e^5 of the extension e.
    Polynomial([f64; 5]),
    /// COMP with its sections.
    Composite(Composite),
}

/// The walk through the cards of mooring lines.
#[derive(Clone, Debug, Default)]
pub struct LineCardParser {
    resistance: Option<SectionResistance>,
}

impl LineCardParser {
    /// Takes a card.
    pub fn take(
        &mut self,
        record: &CardRecord,
        properties: &mut Vec<Property>,
        lines: &mut Vec<MooringLine>,
        remarks: &mut Remarks,
    ) {
        let value = |column: usize| record.real(column).value;
        let kind = match record.keyword.as_str() {
            "POLY" => {
                self.complete(properties, remarks);
                properties.push(Property::Polynomial(record.reals(31).map(|field| field.value)));
                return;
            }
            "COMP" => {
                self.complete(properties, remarks);
                properties.push(Property::Composite(composite(record, remarks)));
                self.resistance = None;
                return;
            }
            "ECAT" | "ECAX" | "ECAH" | "ECAB" | "BUOY" | "CLMP" => {
                self.section(record, properties, remarks);
                return;
            }
            "LINE" => LineKind::Elastic { stiffness: value(31), length: value(41) },
            "LNDW" => LineKind::Winched {
                stiffness: value(31),
                start: value(41),
                end: value(51),
                speed: value(61),
                tension: value(71),
            },
            "FORC" => LineKind::Force(value(31)),
            "WNCH" => {
                LineKind::Winch { tension: value(31), length: value(41), winding_in: value(51), paying_out: value(61) }
            }
            _ => {
                self.complete(properties, remarks);
                let Some(property) = properties.len().checked_sub(1) else {
                    remarks.add(
                        Diagnostic::error(
                            format!("deck 14, {}: no property comes before this line", record.keyword),
                            record.span,
                        )
                        .help("POLY, or COMP with its ECAT cards, belongs before it"),
                    );
                    return;
                };
                LineKind::Property {
                    property,
                    tension: value(31),
                    length: value(41),
                    winding_in: value(51),
                    paying_out: value(61),
                    dynamic: record.keyword == "NLID",
                }
            }
        };
        if let LineKind::Elastic { stiffness, length } = kind
            && (stiffness <= 0.0 || length < 0.0)
        {
            remarks.add(
                Diagnostic::error(
                    "deck 14, LINE: a line has a stiffness above 0 and a length not below 0",
                    record.span,
                )
                .label("stiffness in columns 31-40, unstretched length in 41-50"),
            );
        }
        let ends = Ends {
            structure1: record.int(11),
            node1: record.int(16),
            structure2: record.int(21),
            node2: record.int(26),
        };
        lines.push(MooringLine { ends, kind, span: record.span });
    }

    /// Ends the walk.
    pub fn finish(&mut self, properties: &[Property], remarks: &mut Remarks) {
        self.complete(properties, remarks);
    }

    /// Checks that the last composite has the sections it announced.
    fn complete(&self, properties: &[Property], remarks: &mut Remarks) {
        let Some(Property::Composite(last)) = properties.last() else { return };
        let found = i64::try_from(last.sections.len()).unwrap_or(i64::MAX);
        if found != last.announced.value {
            let key = format!("sections {}", properties.len());
            let message = format!("deck 14, COMP: {} sections are announced, {found} follow", last.announced.value);
            remarks.add_once(&key, || {
                Diagnostic::error(message, last.announced.span).label("number of sections, columns 26-30")
            });
        }
    }

    fn section(&mut self, record: &CardRecord, properties: &mut [Property], remarks: &mut Remarks) {
        let keyword = record.keyword.as_str();
        let value = |column: usize| record.real(column).value;
        if keyword == "ECAH" {
            let resistance =
                SectionResistance { added_mass: value(31), drag: value(51), diameter: value(61), inline: value(71) };
            self.resistance = Some(resistance);
        }
        let Some(Property::Composite(composite)) = properties.last_mut() else {
            remarks.add(
                Diagnostic::error(format!("deck 14, {keyword}: this is a card of a composite line"), record.span)
                    .label("a COMP card belongs before it"),
            );
            return;
        };
        if keyword == "ECAT" {
            match ecat(record, self.resistance) {
                Ok(section) => composite.sections.push(section),
                Err(error) => remarks.add(error),
            }
            return;
        }
        let Some(section) = composite.sections.last_mut() else {
            if keyword != "ECAH" {
                remarks.add(
                    Diagnostic::error(format!("deck 14, {keyword}: there is no section yet"), record.span)
                        .label("an ECAT card belongs before it"),
                );
            }
            return;
        };
        match keyword {
            "ECAX" => section.growth = Some([value(31), value(41), value(51)]),
            "ECAH" => section.resistance = self.resistance,
            "ECAB" => section.bending = value(31),
            _ => {
                section.joint = Some(CompositeJoint {
                    buoy: keyword == "BUOY",
                    mass: value(31),
                    displaced: value(41),
                    added: value(51),
                    drag: value(61),
                    span: record.span,
                });
            }
        }
    }
}

fn composite(record: &CardRecord, remarks: &mut Remarks) -> Composite {
    let points = (record.int(11).or(15), record.int(16).or(40));
    let announced = record.int(26);
    if !(1..=MAX_SECTIONS).contains(&announced.value) {
        remarks.add(
            Diagnostic::error(
                format!("deck 14, COMP, columns 26-30: {} is no number of sections", announced.value),
                announced.span,
            )
            .label(format!("1 to {MAX_SECTIONS} belongs here")),
        );
    }
    if points.0 < 1 || points.1 < 1 || points.0.saturating_mul(points.1) > MAX_TABLE_POINTS {
        remarks.add(
            Diagnostic::error(format!("deck 14, COMP: a table of {} by {} points", points.0, points.1), record.span)
                .label(format!("columns 11-15 times columns 16-20 is 1 to {MAX_TABLE_POINTS}")),
        );
    }
    let of_table =
        [record.int(11).span, record.int(16).span, record.int(21).span, record.real(31).span, record.real(41).span];
    let given = [
        record.int(11).given,
        record.int(16).given,
        record.int(21).given,
        record.real(31).given,
        record.real(41).given,
    ];
    if let Some((span, _)) = of_table.into_iter().zip(given).find(|(_, given)| *given) {
        remarks.add_once("table of a composite", || {
            Diagnostic::remark("deck 14, COMP: no table is made; a line is solved exactly at each position", span)
                .label("columns 11-25 and 31-50 describe the table and have no effect")
        });
    }
    Composite {
        points,
        announced,
        heights: (record.real(31).value, record.real(41).value),
        slope: record.real(51).value,
        sections: Vec::new(),
        span: record.span,
    }
}

fn ecat(record: &CardRecord, resistance: Option<SectionResistance>) -> Result<CompositeSection, Box<Diagnostic>> {
    let (mass, length) = (record.real(31), record.real(71));
    if mass.value <= 0.0 {
        return Err(Diagnostic::error(
            "deck 14, ECAT, columns 31-40: a section has a mass a length above 0",
            mass.span,
        ));
    }
    if length.value < 1.0 {
        return Err(Diagnostic::error("deck 14, ECAT, columns 71-80: a section is at least 1 long", length.span));
    }
    Ok(CompositeSection {
        mass: mass.value,
        area: record.real(41).value,
        stiffness: record.real(51).or(5.0e6 * mass.value),
        tension: record.real(61).or(5.0e4 * mass.value),
        length: length.value,
        growth: None,
        resistance,
        bending: 0.0,
        joint: None,
        span: record.span,
    })
}
