//! Decks 11 and 12: current, wind, and the degrees of freedom that are held.
//!
//! Directions are those TOWARDS which something travels, in degrees from +X towards +Y.
//!
//! Source: [AQWA-TETHER 6.4] and the listing; [AQWA-REF decks 11, 12]; directions and phases by [W-DIRECTIONS].

use super::card::Field;
use super::layout::{CardLayout, CardRecord, int, num};
use super::remarks::Remarks;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Cards of deck 11.
pub const LAYOUTS: &[CardLayout] = &[
    CardLayout::new("CURR", &[num("speed", 11).required(), num("direction", 21)]),
    CardLayout::new("WIND", &[num("speed", 11).required(), num("direction", 21)]),
    CardLayout::new("CPRF", &[num("Z of the current", 11), num("speed", 21), num("direction", 31)]).freely(),
    CardLayout::new("CDRN", &[num("direction of the profile", 11)]),
];

const NO_COLUMNS: &str =
    "no public source has the columns of this card; GSPR of the model is a spring or a dashpot at a joint";

/// Cards of deck 12.
pub const CONSTRAINTS: &[CardLayout] = &[
    CardLayout::new("DACF", &[int("structure", 11).required(), int("degree of freedom", 16).required()])
        .repeated_by(&[11, 16]),
    CardLayout::new(
        "FDOF",
        &[
            int("structure", 16).required(),
            int("X", 21),
            int("Y", 26),
            int("Z", 31),
            int("RX", 36),
            int("RY", 41),
            int("RZ", 46),
        ],
    )
    .repeated_by(&[16]),
    CardLayout::new(
        "DCON",
        &[
            int("locked rotations", 11),
            int("structure 1", 16),
            int("node 1", 21).required(),
            int("node on axis 1", 26),
            int("structure 2", 36),
            int("node 2", 41).required(),
            int("node on axis 2", 46),
        ],
    )
    .freely(),
    CardLayout::refuse("DLCK", "no public source has this card; 3 in columns 11-15 of DCON locks a joint"),
    CardLayout::refuse("FCON", "friction of joints by their reactions is not modelled"),
    CardLayout::refuse("FDCN", NO_COLUMNS),
    CardLayout::refuse("KFCN", NO_COLUMNS),
    CardLayout::refuse("CFCN", NO_COLUMNS),
    CardLayout::refuse("DFCN", NO_COLUMNS),
];

/// A uniform stream.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniformStream {
    /// Speed.
    pub speed: Field<f64>,
    /// Direction towards which it travels (degrees).
    pub direction: Field<f64>,
    /// The card.
    pub span: Span,
}

/// One depth of a current profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentLayer {
    /// Z, negative below the water line.
    pub height: f64,
    /// Speed.
    pub speed: f64,
    /// Direction towards which it travels (degrees).
    pub direction: f64,
    /// The card.
    pub span: Span,
}

/// Deck 11.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct SurroundingsDeck {
    /// Current that is the same at all depths.
    pub current: Option<UniformStream>,
    /// Wind.
    pub wind: Option<UniformStream>,
    /// Current profile from the bottom upwards; it adds to the uniform current.
    pub profile: Vec<CurrentLayer>,
}

/// A degree of freedom of a structure that is held (DACF, FDOF).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedDof {
    /// The structure.
    pub structure: Field<i64>,
    /// The degree of freedom, 1 to 6.
    pub dof: Field<i64>,
    /// Keyword of the card.
    pub card: &'static str,
}

/// The current and wind of the cards of deck 11.
pub fn read(records: &[CardRecord], remarks: &mut Remarks) -> SurroundingsDeck {
    let mut found = SurroundingsDeck::default();
    let mut turn = None;
    for record in records {
        match record.keyword.as_str() {
            "CPRF" => {
                let height = record.real(11);
                if let Some(below) = found.profile.last()
                    && height.value <= below.height
                {
                    remarks.add(
                        Diagnostic::error(
                            "deck 11, CPRF, columns 11-20: a profile goes from the bottom upwards",
                            height.span,
                        )
                        .label("a Z above that of the card before belongs here")
                        .other(below.span, "the card before"),
                    );
                    continue;
                }
                let (speed, direction) = (record.real(21).value, record.real(31).value);
                found.profile.push(CurrentLayer { height: height.value, speed, direction, span: record.span });
            }
            "CDRN" => turn = Some(record.real(11).value),
            keyword => {
                let flow =
                    Some(UniformStream { speed: record.real(11), direction: record.real(21), span: record.span });
                if keyword == "CURR" { found.current = flow } else { found.wind = flow }
            }
        }
    }
    if let Some(direction) = turn {
        for layer in found.profile.iter_mut().filter(|layer| layer.direction == 0.0) {
            layer.direction = direction;
        }
    }
    if let (Some(current), false) = (found.current, found.profile.is_empty()) {
        remarks.add(
            Diagnostic::remark("deck 11: the uniform current and the profile are added as vectors", current.span)
                .help("assumed: no public page says how the two go together"),
        );
    }
    found
}

/// Refuses a card of deck 12 that holds a degree of freedom of no structure: the ground, or a number below 0.
fn refuse_ground(record: &CardRecord, structure: Field<i64>, columns: &str, remarks: &mut Remarks) {
    if structure.value <= 0 {
        let message = format!("deck 12, {}, columns {columns}: {} is no structure", record.keyword, structure.value);
        remarks.add(
            Diagnostic::error(message, structure.span)
                .label("the number of a structure of deck 2 belongs here, 1 for ELM1"),
        );
    }
}

/// The degrees of freedom held by the cards of deck 12.
pub fn read_constraints(records: &[CardRecord], remarks: &mut Remarks) -> Vec<FixedDof> {
    let mut list = Vec::new();
    for record in records {
        match record.keyword.as_str() {
            "DACF" => {
                let (structure, dof) = (record.int(11), record.int(16));
                refuse_ground(record, structure, "11-15", remarks);
                if (1..=6).contains(&dof.value) {
                    list.push(FixedDof { structure, dof, card: "DACF" });
                } else {
                    remarks.add(
                        Diagnostic::error(
                            format!("deck 12, DACF, columns 16-20: {} is no degree of freedom", dof.value),
                            dof.span,
                        )
                        .label("1 to 6 belongs here: X, Y, Z, RX, RY, RZ"),
                    );
                }
            }
            "FDOF" => {
                let structure = record.int(16);
                refuse_ground(record, structure, "16-20", remarks);
                for dof in 1..=6 {
                    let flag = record.int(16 + 5 * dof);
                    match flag.value {
                        0 => {}
                        1 => list.push(FixedDof {
                            structure,
                            dof: Field { value: i64::try_from(dof).unwrap_or(0), given: true, span: flag.span },
                            card: "FDOF",
                        }),
                        other => remarks.add(
                            Diagnostic::error(
                                format!("deck 12, FDOF: {other} says nothing of a degree of freedom"),
                                flag.span,
                            )
                            .label("1 holds it, 0 or nothing leaves it free"),
                        ),
                    }
                }
            }
            _ => {}
        }
    }
    list
}
