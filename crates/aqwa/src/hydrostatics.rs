//! Decks 6 to 10: frequencies and directions, stiffness and coefficients of the structures at their equilibrium.
//!
//! Source: [AQWA-TETHER 6.2 and 8.1.7]; [AQWA-REF decks 6 to 10]; HRTZ and DIRN of deck 6 by decks of [BEMROSETTA-AQWA].

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

/// Of a file of several structures the one to take.
const STRUCTURE_OF_FILE: &[Slot] = &[int("structure of the file", 11).not_below_zero()];

/// Cards of deck 6.
pub const FREQUENCIES: &[CardLayout] = &[
    CardLayout::assume("FREQ", VALUES).freely(),
    CardLayout::assume("PERD", VALUES).freely(),
    CardLayout::new("HRTZ", VALUES).freely(),
    CardLayout::new("DIRN", VALUES).freely(),
    CardLayout::new("CSTR", STRUCTURE_OF_FILE),
    CardLayout::new("CPDB", &[]),
    CardLayout::text("FILE"),
    CardLayout::refuse("MVEF", UNPUBLISHED_CARD_REASON),
    CardLayout::refuse("FWDS", UNPUBLISHED_CARD_REASON),
];

/// Cards of deck 7.
pub const STIFFNESS: &[CardLayout] = &[
    CardLayout::new("LSTF", ROW).repeated_by(&[16]),
    CardLayout::new("ASTF", ROW).repeated_by(&[16]),
    CardLayout::refuse("SSTF", "a stiffness between structures is not read"),
    CardLayout::new("BFEQ", &[num("buoyancy force at equilibrium", 21).required()]),
    CardLayout::new("ZCGE", &[num("Z of the centre of gravity at equilibrium", 21).required()]),
    CardLayout::new("SPOS", &DOF_SLOTS),
    CardLayout::new("FIAM", ROW).repeated_by(&[16]),
    CardLayout::new("FIDP", ROW).repeated_by(&[16]),
    CardLayout::refuse("WAMS", DATABASE),
    CardLayout::refuse("WDMP", DATABASE),
    CardLayout::refuse("FREQ", DATABASE),
    CardLayout::refuse("PERD", DATABASE),
    CardLayout::refuse("HRTZ", DATABASE),
    CardLayout::refuse("DIRN", DATABASE),
    CardLayout::new("CSTR", STRUCTURE_OF_FILE),
    CardLayout::new("CPDB", &[]),
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
    CardLayout::assume("CURR", &[num("speed", 11).required(), num("direction", 21)]),
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
    /// Added mass beside that of the radiation, at all frequencies (FIAM).
    pub added_mass: Option<SixBySix>,
    /// Damping beside that of the radiation, at all frequencies (FIDP).
    pub damping: Option<SixBySix>,
    /// Added mass at drift frequencies (FIDA).
    pub drift_added_mass: Option<SixBySix>,
    /// Damping at drift frequencies (FIDD).
    pub drift_damping: Option<SixBySix>,
    /// Current of deck 10, as decks of 2006 have it for NAUT.
    pub current: Option<UniformStream>,
    /// First card of each keyword, with the number of its deck.
    pub cards: Vec<(u8, String, Span)>,
    /// File with the coefficients of the hull (FILE), with its place.
    pub database: Option<(String, Span)>,
    /// Number of the structure in that file (CSTR).
    pub structure_of_file: Option<Field<i64>>,
}

impl HydrostaticsDecks {
    /// The first card of a keyword: `deck 7, FIAM` and its place.
    pub fn card(&self, keyword: &str) -> Option<(String, Span)> {
        let found = self.cards.iter().find(|(_, other, _)| other == keyword);
        found.map(|(deck, keyword, span)| (format!("deck {deck}, {keyword}"), *span))
    }
}

/// Takes the cards of one of the decks 6 to 10 into what is known of a structure.
pub fn read(into: &mut HydrostaticsDecks, deck: u8, records: &[CardRecord], remarks: &mut Remarks) {
    for record in records {
        if into.card(&record.keyword).is_none() {
            into.cards.push((deck, record.keyword.clone(), record.span));
        }
        match (deck, record.keyword.as_str()) {
            (6 | 7, "FILE") => file(into, deck, record, remarks),
            (6 | 7, "CSTR") => structure_of_file(into, deck, record, remarks),
            // the copy that FILE asks for
            (6 | 7, "CPDB") => {}
            (6, "DIRN") => into.directions.extend(given_values(record)),
            (6, keyword) => into.frequencies.extend(given_values(record).filter_map(|value| frequency(keyword, value))),
            (_, "LSTF") => row(&mut into.stiffness, deck, record, remarks),
            (_, "ASTF") => row(&mut into.added_stiffness, deck, record, remarks),
            (_, "FIAM") => row(&mut into.added_mass, deck, record, remarks),
            (_, "FIDP") => row(&mut into.damping, deck, record, remarks),
            (_, "FIDA") => row(&mut into.drift_added_mass, deck, record, remarks),
            (_, "FIDD") => row(&mut into.drift_damping, deck, record, remarks),
            (_, "BFEQ") => {
                let buoyancy = record.real(21);
                if buoyancy.value <= 0.0 {
                    remarks.add(
                        Diagnostic::error(
                            format!("deck 7, BFEQ, columns 21-30: {} does not bear a structure", buoyancy.value),
                            buoyancy.span,
                        )
                        .label("the buoyancy force at equilibrium is the weight, mass times gravity"),
                    );
                }
                into.buoyancy = Some(buoyancy);
            }
            (_, "ZCGE") => into.height = Some(record.real(21)),
            (_, "SPOS") => into.position = Some(record.reals(21).map(|field| field.value)),
            _ => {
                into.current =
                    Some(UniformStream { speed: record.real(11), direction: record.real(21), span: record.span })
            }
        }
    }
    if deck == 7
        && let Some((_, stiffness)) = into.card("LSTF")
    {
        for (keyword, missing) in [("BFEQ", into.buoyancy.is_none()), ("ZCGE", into.height.is_none())] {
            if missing {
                remarks.add(
                    Diagnostic::error(format!("deck 7: LSTF without {keyword}"), stiffness)
                        .label("this stiffness is about an equilibrium")
                        .help("BFEQ is the buoyancy force at equilibrium, ZCGE the Z of the centre of gravity there"),
                );
            }
        }
    }
}

/// The number of the structure in the file of a hull.
fn structure_of_file(into: &mut HydrostaticsDecks, deck: u8, record: &CardRecord, remarks: &mut Remarks) {
    let number = record.int(11);
    if number.value == 0 {
        remarks.add(
            Diagnostic::error(format!("deck {deck}, CSTR, columns 11-15: no structure is named"), number.span)
                .label("the number of the structure in the FILE belongs here"),
        );
    }
    into.structure_of_file = Some(number);
}

/// The file with the coefficients of a hull, whose name is in columns 21 to 80.
fn file(into: &mut HydrostaticsDecks, deck: u8, record: &CardRecord, remarks: &mut Remarks) {
    let name = record.name.as_str();
    if record.text_place.start < record.name_place.start {
        remarks.add(
            Diagnostic::error(
                format!("deck {deck}, FILE, columns 11-20: a name of a file begins in column 21 or behind it"),
                record.text_place,
            )
            .label("a file unit has no meaning here")
            .help("the name of the file belongs in columns 21-80; it may hold blanks"),
        );
        return;
    }
    let plain = |c: char| c.is_alphanumeric() || " _-+=./\\:,()[]~#".contains(c);
    if let Some(other) = name.chars().find(|c| !plain(*c)) {
        remarks.add(
            Diagnostic::error(
                format!("deck {deck}, FILE, columns 21-80: a name of a file does not hold `{other}` here"),
                record.name_place,
            )
            .label("letters, digits, blanks and _-+=./\\:,()[]~# are taken")
            .help("give the file another name"),
        );
        return;
    }
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending).to_ascii_uppercase();
    if ending != "AH1" {
        remarks.add(
            Diagnostic::error(
                format!("deck {deck}, FILE, columns 21-80: `{name}` is no text database of AQWA"),
                record.name_place,
            )
                .label("a file of ending AH1 belongs here")
                .help("the form of .HYD and .RES is not public: run the deck of AQWA-LINE with OPTIONS AHD1 END, which writes the same as text"),
        );
        return;
    }
    if let Some((_, earlier)) = &into.database {
        remarks.add(
            Diagnostic::error(
                format!("deck {deck}, FILE: the coefficients of this structure are given twice"),
                record.span,
            )
            .other(*earlier, "given here first"),
        );
        return;
    }
    into.database = Some((name.to_string(), record.name_place));
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

fn row(matrix: &mut Option<SixBySix>, deck: u8, record: &CardRecord, remarks: &mut Remarks) {
    let number = record.int(16);
    let matrix = matrix.get_or_insert([[0.0; 6]; 6]);
    match usize::try_from(number.value - 1).ok().and_then(|index| matrix.get_mut(index)) {
        Some(row) => {
            *row = record.reals(21).map(|field| field.value);
            let heave = record.real(41);
            if record.keyword == "LSTF" && number.value == 3 && heave.value < 0.0 {
                remarks.add(
                    Diagnostic::error(
                        format!(
                            "deck 7, LSTF, row 3, columns 41-50: a stiffness in heave of {} is below 0",
                            heave.value
                        ),
                        heave.span,
                    )
                    .label("density times gravity times the area of the water plane belongs here"),
                );
            }
        }
        None => remarks.add(
            Diagnostic::error(
                format!("deck {deck}, {}, columns 16-20: a matrix has rows 1 to 6", record.keyword),
                number.span,
            )
            .label("row belongs here"),
        ),
    }
}
