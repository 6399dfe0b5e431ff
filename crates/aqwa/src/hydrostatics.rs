//! Decks 6 to 10: frequencies and directions, stiffness and coefficients of the structures at their equilibrium.
//!
//! Source: [AQWA-TETHER 6.2 and 8.1.7]; [AQWA-REF decks 6 to 10].

use super::card::Field;
use super::layout::{CardLayout, CardRecord, Slot, int, num};
use super::remarks::Remarks;
use super::surroundings::UniformStream;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

const DATABASE: &str = "coefficients over frequency are not read from a deck; \
                        take them from a hydrodynamic database of the model instead";
const UNPUBLISHED_CARD_REASON: &str = "the columns of this card are published nowhere";

const DOF_SLOTS: [Slot; 6] = [num("X", 21), num("Y", 31), num("Z", 41), num("RX", 51), num("RY", 61), num("RZ", 71)];
const ROW: &[Slot] =
    &[int("row", 16), DOF_SLOTS[0], DOF_SLOTS[1], DOF_SLOTS[2], DOF_SLOTS[3], DOF_SLOTS[4], DOF_SLOTS[5]];
const VALUES: &[Slot] = &[
    int("first index", 11),
    int("last index", 16),
    num("value 1", 21),
    num("value 2", 31),
    num("value 3", 41),
    num("value 4", 51),
    num("value 5", 61),
    num("value 6", 71),
];

/// Cards of deck 6.
pub const FREQUENCIES: &[CardLayout] = &[
    CardLayout::assume("FREQ", VALUES).freely(),
    CardLayout::assume("PERD", VALUES).freely(),
    CardLayout::assume("HRTZ", VALUES).freely(),
    CardLayout::assume("DIRN", VALUES).freely(),
    CardLayout::refuse("CSTR", UNPUBLISHED_CARD_REASON),
    CardLayout::text("FILE"),
    CardLayout::refuse("MVEF", UNPUBLISHED_CARD_REASON),
    CardLayout::refuse("FWDS", UNPUBLISHED_CARD_REASON),
];

/// Cards of deck 7.
pub const STIFFNESS: &[CardLayout] = &[
    CardLayout::new("LSTF", ROW).repeated_by(&[16]),
    CardLayout::new("ASTF", ROW).repeated_by(&[16]),
    CardLayout::refuse("SSTF", "a stiffness between structures is not read"),
    CardLayout::new("BFEQ", &[num("buoyancy force at equilibrium", 21)]),
    CardLayout::new("ZCGE", &[num("Z of the centre of gravity at equilibrium", 21)]),
    CardLayout::new("SPOS", &DOF_SLOTS),
    CardLayout::new("FIAM", ROW).repeated_by(&[16]),
    CardLayout::new("FIDP", ROW).repeated_by(&[16]),
    CardLayout::refuse("WAMS", DATABASE),
    CardLayout::refuse("WDMP", DATABASE),
    CardLayout::refuse("FREQ", DATABASE),
    CardLayout::refuse("PERD", DATABASE),
    CardLayout::refuse("HRTZ", DATABASE),
    CardLayout::refuse("DIRN", DATABASE),
    CardLayout::text("FILE"),
];

/// Cards of deck 8.
pub const DRIFT: &[CardLayout] = &[
    CardLayout::refuse("DRFT", DATABASE),
    CardLayout::refuse("FREQ", DATABASE),
    CardLayout::refuse("DIRN", DATABASE),
    CardLayout::refuse("FILE", DATABASE),
];

/// Cards of deck 9.
pub const DAMPING: &[CardLayout] = &[
    CardLayout::assume("FIDA", ROW).repeated_by(&[16]),
    CardLayout::assume("FIDD", ROW).repeated_by(&[16]),
    CardLayout::refuse("FILE", DATABASE),
];

/// Cards of deck 10.
pub const HULL: &[CardLayout] = &[
    CardLayout::assume("CURR", &[num("speed", 11), num("direction", 21)]),
    CardLayout::refuse("RUFC", "forces from a routine of the user are not read"),
    CardLayout::refuse("IUFC", "forces from a routine of the user are not read"),
    CardLayout::refuse("CUFX", UNPUBLISHED_CARD_REASON),
    CardLayout::refuse("THRS", UNPUBLISHED_CARD_REASON),
    CardLayout::refuse("DIRN", UNPUBLISHED_CARD_REASON),
];

/// Six rows of six numbers, in the units of the deck, rotations in radians.
pub type SixBySix = [[f64; 6]; 6];

/// What decks 6 to 10 say of one structure.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct HydrostaticsDecks {
    /// Wave frequencies of deck 6 (rad/s).
    pub frequencies: Vec<f64>,
    /// Wave directions of deck 6 (degrees, towards).
    pub directions: Vec<f64>,
    /// Linear hydrostatic stiffness (LSTF); rows that are not given are zero.
    pub stiffness: Option<SixBySix>,
    /// Stiffness added to the hydrostatic one (ASTF).
    pub added_stiffness: Option<SixBySix>,
    /// Buoyancy force at the free-floating equilibrium (BFEQ).
    pub buoyancy: Option<Field<f64>>,
    /// Z of the centre of gravity at that equilibrium (ZCGE).
    pub height: Option<Field<f64>>,
    /// Position of the stiffness matrix (SPOS): X, Y, Z, RX, RY, RZ, angles in degrees.
    pub position: Option<[f64; 6]>,
    /// Added mass that does not depend on frequency (FIAM; FIDA at drift frequency).
    pub added_mass: Option<SixBySix>,
    /// Damping that does not depend on frequency (FIDP; FIDD at drift frequency).
    pub damping: Option<SixBySix>,
    /// Current of deck 10, as decks of 2006 have it for NAUT.
    pub current: Option<UniformStream>,
    /// First LSTF card, else the header.
    pub span: Span,
    /// File with the coefficients of the hull (FILE), with its place.
    pub database: Option<(String, Span)>,
}

/// Takes the cards of one of the decks 6 to 10 into what is known of a structure.
pub fn read(into: &mut HydrostaticsDecks, deck: u8, records: &[CardRecord], remarks: &mut Remarks) {
    for record in records {
        match (deck, record.keyword.as_str()) {
            (6 | 7, "FILE") => file(into, record, remarks),
            (6, "DIRN") => into.directions.extend(given_values(record)),
            (6, keyword) => into.frequencies.extend(given_values(record).filter_map(|value| frequency(keyword, value))),
            (_, "LSTF") => {
                if into.stiffness.is_none() {
                    into.span = record.span;
                }
                row(&mut into.stiffness, record, remarks);
            }
            (_, "ASTF") => row(&mut into.added_stiffness, record, remarks),
            (_, "FIAM" | "FIDA") => row(&mut into.added_mass, record, remarks),
            (_, "FIDP" | "FIDD") => row(&mut into.damping, record, remarks),
            (_, "BFEQ") => into.buoyancy = Some(record.real(21)),
            (_, "ZCGE") => into.height = Some(record.real(21)),
            (_, "SPOS") => into.position = Some(record.reals(21).map(|field| field.value)),
            _ => {
                into.current =
                    Some(UniformStream { speed: record.real(11), direction: record.real(21), span: record.span })
            }
        }
    }
    if deck == 7 && into.stiffness.is_some() {
        for (keyword, missing) in [("BFEQ", into.buoyancy.is_none()), ("ZCGE", into.height.is_none())] {
            if missing {
                remarks.add(
                    Diagnostic::error(format!("deck 7: LSTF without {keyword}"), into.span)
                        .label("this stiffness is about an equilibrium")
                        .help("BFEQ is the buoyancy force at equilibrium, ZCGE the Z of the centre of gravity there"),
                );
            }
        }
    }
}

/// The file with the coefficients of a hull, whose name is the last word of the card.
fn file(into: &mut HydrostaticsDecks, record: &CardRecord, remarks: &mut Remarks) {
    let name = record.text.split(' ').next_back().unwrap_or_default();
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_uppercase();
    if ending != "AH1" {
        remarks.add(
            Diagnostic::error(format!("FILE, columns 21-80: `{name}` is no text database of AQWA"), record.text_place)
                .label("a file of ending AH1 belongs here")
                .help("the form of .HYD and .RES is not public: run the deck of AQWA-LINE with OPTIONS AHD1 END, which writes the same as text"),
        );
        return;
    }
    if let Some((_, earlier)) = &into.database {
        remarks.add(
            Diagnostic::error("FILE: the coefficients of this structure are given twice", record.span)
                .other(*earlier, "given here first"),
        );
        return;
    }
    into.database = Some((name.to_string(), record.text_place));
}

fn given_values(record: &CardRecord) -> impl Iterator<Item = f64> + '_ {
    record.reals::<6>(21).into_iter().filter(|field| field.given).map(|field| field.value)
}

/// A wave frequency in rad/s; none for one that is not above zero.
fn frequency(keyword: &str, value: f64) -> Option<f64> {
    let turn = 2.0 * std::f64::consts::PI;
    let frequency = match keyword {
        "PERD" => turn / value,
        "HRTZ" => turn * value,
        _ => value,
    };
    (frequency.is_finite() && frequency > 0.0).then_some(frequency)
}

fn row(matrix: &mut Option<SixBySix>, record: &CardRecord, remarks: &mut Remarks) {
    let number = record.int(16);
    let matrix = matrix.get_or_insert([[0.0; 6]; 6]);
    match usize::try_from(number.value - 1).ok().and_then(|index| matrix.get_mut(index)) {
        Some(row) => *row = record.reals(21).map(|field| field.value),
        None => remarks.add(
            Diagnostic::error(
                format!("deck 7, {}, columns 16-20: a matrix has rows 1 to 6", record.keyword),
                number.span,
            )
            .label("row belongs here"),
        ),
    }
}
