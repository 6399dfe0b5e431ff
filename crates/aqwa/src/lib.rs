//! The AQWA card-image deck: a file of 80-column cards in decks 0 to 20, read into [`Deck`].
//!
//! Nothing is converted here: values are as given, in the units of the deck (any consistent set; [`Deck::units`] gives
//! which from gravity and the density of the water), angles in degrees, directions those towards which something
//! travels. Card errors name the deck, the card and its columns, and carry the place. A card that does not fit its
//! columns is refused. A card whose columns no source confirms is read with a note of what was assumed; a card that would change the answer and is not read is an error.
//!
//! How the parts correspond to the model:
//!
//! | deck | here | in the model |
//! |---|---|---|
//! | 0 | [`job::JobDeck`] | title, kind of run (DRIF spectrum, NAUT regular wave), stages |
//! | 1 | [`nodes::NodeTable`] | points; a node of a structure moves with the body |
//! | 2 | [`elements::StructureDeck`] | one body each: TUBE and STUB Morison members, PMAS weight, DISC plate, PBOY buoyancy |
//! | 2 QPPL, TPPL | [`panels::DeckHull`] | its hull; G_PRESSURE with the panels, frequencies and directions of deck 6 |
//! | 3, 4 | [`properties::MaterialCard`], [`properties::Geometry`] | sizes, densities and coefficients of the members and of tether elements |
//! | 5 | [`properties::WaterAndGravity`] | depth, density, gravity of the environment |
//! | 7 | [`hydrostatics::HydrostaticsDecks`] | linear stiffness of a body about (X, Y, ZCGE) with buoyancy BFEQ, as of a hydrodynamic database |
//! | 10, 11, 13 CURR, WIND | [`surroundings::SurroundingsDeck`], [`surroundings::UniformStream`] | current profile and wind; the model's directions are those they come FROM, so add 180 degrees |
//! | 12 | [`surroundings::FixedDof`], [`articulations::Articulation`] | fixed degrees of freedom of a body; joints as FIX |
//! | 13 | [`waves::WaveDeck`] | sea of spectral components, or regular wave (second order unless AIRY) |
//! | 14 LINE, FORC, WNCH, LNDW, POLY, SWIR, COMP | [`lines::MooringLine`] | connectors of the classes CT_LINE, LNDW, NLIN, CATENARY |
//! | 14 FEND, FLIN | [`fenders::FenderCard`] | fenders |
//! | 14 TELM .. TETH | [`tethers::Tether`] | a tether connector, towed or installed |
//! | 15 | [`run::Start`] | position and velocity of the bodies at the start (of their centres of gravity) |
//! | 16 | [`run::TimeSteps`] | steps of the time domain: the first is the start |
//! | 17 | [`run::MorisonMultipliers`] | multipliers of drag, added mass and slam |
//! | 18 | [`printing::Printing`] | what the listing prints, and how often |
//!
//! Sources: [AQWA-TETHER] (the AQWATM-TETHER manual of 2006) and [AQWA-REF].
//!
//! # Example
//! ```
//! use windlass_language::source::Sources;
//!
//! let mut sources = Sources::default();
//! let id = sources.add("tow.dat", "JOB HE01  DRIF  WFRQ\nTITLE               Tether tow\n", 1);
//! assert_eq!(windlass_aqwa::read(&sources, id).deck.job.title, "Tether tow");
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod articulations;
pub mod card;
mod checks;
mod deck_dispatch;
mod echo;
pub mod elements;
pub mod end_springs;
pub mod fenders;
pub mod hydrostatics;
pub mod job;
pub mod layout;
pub mod lines;
pub mod listing;
pub mod mass;
pub mod mooring;
pub mod nodes;
pub mod panels;
pub mod printing;
pub mod properties;
pub mod reader;
pub mod records;
pub mod remarks;
mod repeats;
pub mod run;
mod start_positions;
pub mod surroundings;
pub mod tethers;
pub mod units;
pub mod waves;

use elements::{ElementShape, StructureDeck};
use hydrostatics::HydrostaticsDecks;
use job::JobDeck;
use mooring::MooringDeck;
use nodes::NodeTable;
use printing::Printing;
use properties::{Geometries, Geometry, Materials, WaterAndGravity};
use reader::{CardReader, Cards};
use run::{MorisonMultipliers, Start, TimeSteps};
use surroundings::{FixedDof, SurroundingsDeck};
use waves::WaveDeck;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::SourceId;
use windlass_language::source::Sources;

pub use echo::Echo;
pub use job::is_deck;
pub use records::{CardOrigin, Records, WrittenRecords, model_records, records};

/// A deck that was read.
#[derive(Clone, Debug, Default)]
pub struct Deck {
    /// Deck 0.
    pub job: JobDeck,
    /// Deck 1.
    pub nodes: NodeTable,
    /// Deck 2: the structures in order, 1 first.
    pub structures: Vec<StructureDeck>,
    /// Deck 3.
    pub materials: Materials,
    /// Deck 4.
    pub geometries: Geometries,
    /// Deck 5.
    pub global: WaterAndGravity,
    /// Decks 6 to 10, one entry a structure.
    pub hydrostatics: Vec<HydrostaticsDecks>,
    /// Deck 11.
    pub surroundings: SurroundingsDeck,
    /// Deck 12.
    pub held: Vec<FixedDof>,
    /// Joints of deck 12.
    pub articulations: Vec<articulations::Articulation>,
    /// Deck 13.
    pub waves: WaveDeck,
    /// Deck 14.
    pub mooring: MooringDeck,
    /// Deck 15.
    pub starts: Vec<Start>,
    /// Deck 16.
    pub steps: Option<TimeSteps>,
    /// Deck 17.
    pub multipliers: Vec<MorisonMultipliers>,
    /// Deck 18.
    pub printing: Printing,
    /// All cards from deck 1 on as they were read, for the echo.
    pub cards: Vec<Cards>,
    /// Whether the decks of the stages before the first one of RESTART are there, from the file of an earlier run.
    pub has_earlier_stages: bool,
}

/// What came of reading a file.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    /// The deck, as far as it could be read.
    pub deck: Deck,
    /// Errors, warnings and notes in the order met.
    pub messages: Vec<Diagnostic>,
    /// Whether there was an error; such a deck is not run.
    pub failed: bool,
}

impl Deck {
    /// A geometry group by the kind of element it is for and its number.
    pub fn geometry(&self, shape: ElementShape, group: i64) -> Option<&Geometry> {
        self.geometries.get(&(shape, group))
    }

    /// A structure by its number.
    pub fn structure(&self, number: i64) -> Option<&StructureDeck> {
        self.structures.iter().find(|structure| structure.number == number)
    }

    /// The file with the coefficients of the hull of a structure, with its place.
    pub fn database(&self, structure: &elements::StructureDeck) -> Option<&(String, windlass_base::span::Span)> {
        self.hydrostatics_of(structure.number)?.database.as_ref()
    }

    /// What decks 6 to 10 say of a structure, by its number.
    pub fn hydrostatics_of(&self, number: i64) -> Option<&HydrostaticsDecks> {
        let index = self.structures.iter().position(|other| other.number == number)?;
        self.hydrostatics.get(index)
    }

    /// Position of the centre of gravity of a structure at the start: X, Y, Z, RX, RY, RZ (degrees). The place of deck 15,
    /// else that of the structure as modelled, its water line (ZLWL) in the surface.
    pub fn start(&self, structure: &StructureDeck) -> [f64; 6] {
        let given = self.starts.iter().find(|start| start.structure == structure.number && !start.velocity);
        given.map_or_else(
            || {
                let [x, y, z] = self.mass_properties(structure).centre;
                // the axes of deck 1 may lie elsewhere than the water line
                let line = structure.waterline.map_or(0.0, |(height, _)| height);
                [x, y, z - line, 0.0, 0.0, 0.0]
            },
            |start| start.values,
        )
    }

    /// The loads of a structure's Morison elements are multiplied by these.
    pub fn multipliers(&self, structure: i64) -> MorisonMultipliers {
        let found = self.multipliers.iter().find(|m| m.structure.value == structure);
        found.copied().unwrap_or(MorisonMultipliers {
            structure: card::Field { value: structure, ..card::Field::default() },
            drag: 1.0,
            added_mass: 1.0,
            slam: 0.0,
        })
    }

    /// First and last time step of the statistics: TSTS and TSTF of deck 18, else all steps.
    pub fn statistics(&self) -> (i64, i64) {
        let last = self.steps.map_or(1, |steps| steps.count.value);
        let given = |field: Option<card::Field<i64>>, usual: i64| field.map_or(usual, |field| field.value_or(usual));
        (given(self.printing.first, 1), given(self.printing.last, last).min(last))
    }

    /// The units of the deck.
    ///
    /// # Errors
    /// When gravity and the density of the water belong to no set of units known.
    pub fn units(&self) -> Result<units::Units, Box<Diagnostic>> {
        units::units(&self.global)
    }
}

/// Reads a file of cards.
pub fn read(sources: &Sources, id: SourceId) -> Reading {
    read_stages(sources, id, None)
}

/// Reads a file of cards that begins after stage 1 [AQWA-TETHER chapter 5]; the decks of the stages before are those of the file of an earlier run.
pub fn read_after(sources: &Sources, id: SourceId, earlier: SourceId) -> Reading {
    read_stages(sources, id, Some(earlier))
}

fn read_stages(sources: &Sources, id: SourceId, earlier: Option<SourceId>) -> Reading {
    let Some(source) = sources.get(id) else { return Reading::default() };
    let mut reader = CardReader::new(source, id);
    let mut deck = Deck { job: job::read(&mut reader), ..Deck::default() };
    let mut before = earlier.and_then(|id| Some(CardReader::new(sources.get(id)?, id)));
    let done = before.as_mut().map(job::read);
    deck.has_earlier_stages = done.is_some();
    for number in 1..=20 {
        if deck.job.has_deck(number) {
            deck_dispatch::read(&mut deck, number, &mut reader);
        } else if let (Some(job), Some(before)) = (&done, &mut before)
            && job.has_deck(number)
            && deck.job.is_earlier(number)
        {
            deck_dispatch::read(&mut deck, number, before);
        }
    }
    if let Some(before) = before {
        reader.remarks.take_over(before.remarks);
    }
    if let Some(line) = reader.peek() {
        let warning = Diagnostic::warning("what follows the last deck is not read", line.whole());
        reader.remarks.add(warning);
    }
    checks::check(&deck, &mut reader.remarks);
    let failed = reader.remarks.has_error();
    Reading { deck, messages: reader.remarks.into_list(), failed }
}
