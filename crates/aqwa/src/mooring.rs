//! Deck 14: mooring lines and tethers. This file has the cards and the walk through them; [`super::lines`] and
//! [`super::tethers`] have what they make.
//!
//! Source: [AQWA-TETHER Appendix A]; [AQWA-REF deck 14].

use super::card::Field;
use super::fenders::{FenderCard, FenderProperties};
use super::layout::{CardLayout, CardRecord, Slot, int, num};
use super::lines::{Composite, LineBreak, LineCardParser, LineKind, MooringLine, Property};
use super::remarks::Remarks;
use super::tethers::{Builder, Tether};
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

const ENDS: [Slot; 4] = [
    int("structure 1", 11).not_below_zero(),
    int("node 1", 16).not_below_zero(),
    int("structure 2", 21).not_below_zero(),
    int("node 2", 26).not_below_zero(),
];
const NOT_YET: &str = "pre-processing of tethers is not available in AQWA 5.4 [AQWA-TETHER A.13] nor here";

const TABLE_OF_LINE: &str = "no public source has the columns of ZRNG, XRNG, HRNG and VRNG, the table of LE2D; \
                             COMP and ECAT give the line, which is solved exactly";

/// Most elements of a dynamic line that a deck may ask for: more than lines of some kilometres need.
const MAX_ELEMENTS: i64 = 1000;

/// The card that closes a tether.
const TETHER: &[&str] = &["TETH"];
/// The cards that begin a section.
const SECTION: &[&str] = &["ECAT", "COMP"];

/// Cards of deck 14.
pub const LAYOUTS: &[CardLayout] = &[
    CardLayout::new(
        "TELM",
        &[int("node 1", 11), int("node 2", 16), int("material group", 21), int("geometry group", 26)],
    )
    .freely(),
    CardLayout::new("TSPA", SPRING).repeatable_after(TETHER),
    CardLayout::new("TSPV", SPRING).repeatable_after(TETHER),
    CardLayout::new("TEIG", &[int("number of modes", 11)]),
    CardLayout::new(
        "TFAT",
        &[
            num("reserved", 31),
            num("stress concentration factor", 41).or("1.24"),
            num("S-N intercept", 51).or("1.3367E24"),
            num("S-N slope m", 61).or("3.5"),
        ],
    )
    .repeatable_after(TETHER),
    CardLayout::new("TPSH", &[int("hours", 11), num("hours", 31)]).repeatable_after(TETHER),
    CardLayout::new("TSLK", &[num("time", 31).not_below_zero()]),
    CardLayout::new("TEGR", &[int("number of identical tethers", 11)]).repeatable_after(TETHER),
    CardLayout::new("TCAP", &[num("anchor cap area", 31), num("vessel cap area", 41)]).repeatable_after(TETHER),
    CardLayout::new("TIFL", &[num("internal pressure", 31), num("density of the internal fluid", 41)])
        .repeatable_after(TETHER),
    CardLayout::new("TIMP", &[num("stress factor", 31), num("half life", 41)]).repeatable_after(TETHER),
    CardLayout::new("TLOW", &[num("distance of the lower stop below the anchor", 31)]).repeatable_after(TETHER),
    CardLayout::new("TLAC", &[]).freely(),
    CardLayout::new("TROC", &[]).freely(),
    CardLayout::new("TLAV", &[num("gap", 31)]).freely(),
    CardLayout::new("TROV", &[]).freely(),
    CardLayout::new(
        "TETH",
        &[int("structure", 11), int("node on it", 16), int("0 (fixed)", 21), int("anchor or trailing node", 26)],
    )
    .freely(),
    CardLayout::pass_over("TSTE", NOT_YET),
    CardLayout::pass_over("TTIM", NOT_YET),
    CardLayout::pass_over("TRAO", NOT_YET),
    CardLayout::refuse("TECP", "composite tethers are not read"),
    CardLayout::refuse("TSEG", "composite tethers are not read"),
    CardLayout::refuse("TSGH", "composite tethers are not read"),
    CardLayout::new(
        "LINE",
        &[
            ENDS[0],
            ENDS[1],
            ENDS[2],
            ENDS[3],
            num("stiffness", 31).required(),
            num("unstretched length", 41).required(),
        ],
    )
    .freely(),
    CardLayout::new(
        "LNDW",
        &[
            ENDS[0],
            ENDS[1],
            ENDS[2],
            ENDS[3],
            num("stiffness", 31).required(),
            num("start length", 41).required(),
            num("end length", 51).required(),
            num("winch speed", 61).required(),
            num("greatest tension", 71).not_below_zero(),
        ],
    )
    .freely(),
    CardLayout::new("FORC", &[ENDS[0], ENDS[1], ENDS[2], ENDS[3], num("force", 31).required()]).freely(),
    CardLayout::assume(
        "WNCH",
        &[
            ENDS[0],
            ENDS[1],
            ENDS[2],
            ENDS[3],
            num("tension", 31).required(),
            num("length", 41),
            num("friction winding in", 51),
            num("friction paying out", 61),
        ],
    )
    .freely(),
    CardLayout::new("NLIN", NON_LINEAR).freely(),
    CardLayout::new("NLID", NON_LINEAR).freely(),
    CardLayout::new("POLY", &[num("P1", 31), num("P2", 41), num("P3", 51), num("P4", 61), num("P5", 71)]).freely(),
    CardLayout::new(
        "COMP",
        &[
            int("vertical levels", 11),
            int("horizontal offsets", 16),
            int("flags of warnings and of symmetry", 21).not_below_zero(),
            int("number of sections", 26),
            num("lowest Z", 31),
            num("highest Z", 41),
            num("slope of the sea bed", 51),
        ],
    )
    .freely(),
    CardLayout::new(
        "ECAT",
        &[
            int("flag of the length found for a pretension", 26).not_below_zero(),
            num("mass a length", 31).not_below_zero().required(),
            num("area", 41).not_below_zero(),
            num("EA", 51).not_below_zero().or("5.0E6 times the mass a length"),
            num("greatest tension", 61).not_below_zero().or("5.0E4 times the mass a length"),
            num("length", 71).not_below_zero().required(),
        ],
    )
    .freely(),
    CardLayout::new("ECAX", &[num("k1", 31).required(), num("k2", 41), num("k3", 51)]).repeatable_after(SECTION),
    CardLayout::new(
        "ECAH",
        &[
            num("added mass coefficient", 31).not_below_zero().or("1.0"),
            num("drag coefficient", 51).not_below_zero().or("1.0"),
            num("drag diameter", 61).not_below_zero().or("that of the area of the section"),
            num("inline drag coefficient", 71).not_below_zero().or("0.025"),
        ],
    )
    .repeatable_after(SECTION),
    CardLayout::new("ECAB", &[num("EI", 31).not_below_zero()]).repeatable_after(SECTION),
    CardLayout::assume("BUOY", JOINT).one_of("joint", SECTION),
    CardLayout::assume("CLMP", JOINT).one_of("joint", SECTION),
    CardLayout::new("DYNM", &[]).one_of("cable dynamics", &[]),
    CardLayout::new("DOFF", &[]).one_of("cable dynamics", &[]),
    CardLayout::new("SWIR", &[num("asymptotic stiffness", 31).required(), num("asymptotic offset", 41).required()])
        .freely(),
    CardLayout::new(
        "LBRK",
        &[
            int("spectrum", 11).not_below_zero(),
            int("number of the line", 16).not_below_zero().required(),
            num("time", 31).not_below_zero(),
            num("breaking tension at structure 1", 41).not_below_zero(),
            num("breaking tension at structure 2", 51).not_below_zero(),
        ],
    )
    .repeated_by(&[16]),
    CardLayout::new("DWT0", &[num("time at which winching starts", 31).not_below_zero().required()]).freely(),
    CardLayout::new("DWAL", &[num("additional length", 31).not_below_zero().required()]).freely(),
    CardLayout::assume("NCEL", &[int("elements of a dynamic line", 11)]),
    CardLayout::new(
        "FEND",
        &[num("size", 31).required(), num("friction coefficient", 51), num("damping over stiffness", 71)],
    )
    .freely(),
    CardLayout::new(
        "FLIN",
        &[
            int("type", 11),
            int("structure 1", 21),
            int("node 1", 26),
            int("node on normal 1", 31),
            int("structure 2", 41),
            int("node 2", 46),
            int("node on normal 2", 51),
        ],
    )
    .freely(),
    CardLayout::refuse("FENP", "no public source has the columns of this card; FEND and FLIN give a fender"),
    CardLayout::new(
        "PULY",
        &[
            ENDS[0],
            ENDS[1],
            ENDS[2],
            ENDS[3],
            num("angle", 31),
            num("radius", 41),
            num("bearing friction T2/T1", 51),
            num("sliding friction T2/T1", 61),
        ],
    )
    .freely(),
    CardLayout::refuse("FILE", "the file of a load-extension table is not read; POLY and NLIN give a nonlinear line"),
    CardLayout::refuse("LE2D", TABLE_OF_LINE),
    CardLayout::refuse("ZRNG", TABLE_OF_LINE),
    CardLayout::refuse("XRNG", TABLE_OF_LINE),
    CardLayout::refuse("HRNG", TABLE_OF_LINE),
    CardLayout::refuse("VRNG", TABLE_OF_LINE),
    CardLayout::refuse("PRLD", "no public source has the columns of this card; COMP and ECAT give the line"),
    CardLayout::refuse(
        "DRUM",
        "no public source has this card; LNDW with DWT0 and DWAL is the drum winch of AQWA, WNCH a winch with friction",
    ),
];

const SPRING: &[Slot] = &[
    int("1 for a towed tether, blank for an installed one", 11),
    num("stiffness 1", 31),
    num("stiffness 2", 41),
    num("stiffness 3", 51),
];
const NON_LINEAR: &[Slot] = &[
    ENDS[0],
    ENDS[1],
    ENDS[2],
    ENDS[3],
    num("winch tension", 31),
    num("unstretched length", 41),
    num("friction winding in", 51),
    num("friction paying out", 61),
];
const JOINT: &[Slot] = &[
    num("mass", 31),
    num("displaced mass", 41),
    num("added mass", 51).not_below_zero(),
    num("drag coefficient times area", 61).not_below_zero(),
];

/// Deck 14.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct MooringDeck {
    /// Properties that lines refer to, in the order of input.
    pub properties: Vec<Property>,
    /// Mooring lines in the order of input.
    pub lines: Vec<MooringLine>,
    /// Fenders in the order of input.
    pub fenders: Vec<FenderCard>,
    /// Lines that break (LBRK).
    pub breaks: Vec<LineBreak>,
    /// The card that switches cable dynamics off (DOFF): NLID lines are then quasi-static.
    pub dynamics_off: Option<Span>,
    /// Elements of the NLID lines (NCEL); the number of AQWA where it is not given.
    pub elements: Option<Field<i64>>,
    /// Tethers in the order of their TETH cards.
    pub tethers: Vec<Tether>,
    /// Modes to print of the eigenvalue solution of each tether (TEIG).
    pub modes: Option<Field<i64>>,
    /// Time for which a tether is printed after it goes slack (TSLK); the TPRV card of deck 18 overrides it.
    pub slack_time: Option<Field<f64>>,
    /// Place of the last card.
    pub span: Span,
}

impl MooringDeck {
    /// The composite catenary that a line is, if it is one.
    pub fn composite(&self, line: &MooringLine) -> Option<&Composite> {
        match line.kind {
            LineKind::Property { property, .. } => match self.properties.get(property) {
                Some(Property::Composite(composite)) => Some(composite),
                _ => None,
            },
            _ => None,
        }
    }
}

/// The number of elements of a dynamic line.
fn elements(record: &CardRecord, remarks: &mut Remarks) -> Option<Field<i64>> {
    let number = record.int(11);
    let fits = (1..=MAX_ELEMENTS).contains(&number.value);
    if !fits {
        remarks.add(
            Diagnostic::error(
                format!("deck 14, NCEL, columns 11-15: {} is not a valid number of elements", number.value),
                number.span,
            )
            .label(format!("1 to {MAX_ELEMENTS} belongs here")),
        );
    }
    fits.then_some(number)
}

/// The mooring of the cards of deck 14.
pub fn read(records: &[CardRecord], remarks: &mut Remarks) -> MooringDeck {
    let mut mooring = MooringDeck::default();
    let mut tether = Builder::default();
    let mut walk = LineCardParser::default();
    let mut fender = None;
    for record in records {
        mooring.span = record.span;
        match record.keyword.as_str() {
            "TEIG" if record.int(11).value < 0 => remarks.add(
                Diagnostic::error(
                    "deck 14, TEIG, columns 11-15: a number of modes is not below 0",
                    record.int(11).span,
                )
                .label("number of modes"),
            ),
            "TEIG" => mooring.modes = Some(record.int(11)),
            "TSLK" => mooring.slack_time = Some(record.real(31)),
            "TETH" => {
                if let Some(done) = tether.close(record, &mooring.tethers, remarks) {
                    mooring.tethers.push(done);
                }
            }
            keyword if keyword.starts_with('T') => tether.take(record, remarks),
            "DOFF" => mooring.dynamics_off = Some(record.span),
            "DYNM" => {}
            "NCEL" => mooring.elements = elements(record, remarks),
            "FEND" => fender = Some(FenderProperties::read(record, remarks)),
            "FLIN" => {
                walk.use_property();
                mooring.fenders.extend(FenderCard::read(record, &mooring.properties, fender, remarks));
            }
            "LBRK" => mooring.breaks.push(LineBreak::read(record, remarks)),
            _ => walk.take(record, &mut mooring.properties, &mut mooring.lines, remarks),
        }
    }
    tether.finish(remarks);
    walk.finish(&mooring.properties, remarks);
    mooring
}
