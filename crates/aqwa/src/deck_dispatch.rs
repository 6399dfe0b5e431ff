//! Joins the decks: which cards a deck may hold, and where what they say belongs in [`Deck`].

use super::layout::{CardLayout, CardRecord};
use super::reader::{CardReader, Cards};
use super::{
    Deck, articulations, elements, hydrostatics, mooring, nodes, printing, properties, run, surroundings, waves,
};
use hydrostatics::HydrostaticsDecks;
use windlass_base::diagnostic::Diagnostic;

/// Reads deck `number`, 1 to 20.
pub fn read(deck: &mut Deck, number: u8, reader: &mut CardReader<'_>) {
    match number {
        2 => structures(deck, reader),
        6..=10 => per_structure(deck, number, reader),
        19 | 20 if reader.peek().is_none() => {}
        _ => single(deck, number, reader),
    }
}

fn layouts(number: u8, keyword: &str) -> &'static [CardLayout] {
    match number {
        1 => nodes::LAYOUTS,
        2 => elements::LAYOUTS,
        3 => properties::MATERIALS,
        4 => properties::GEOMETRIES,
        5 => properties::GLOBALS,
        6 => hydrostatics::FREQUENCIES,
        7 => hydrostatics::STIFFNESS,
        8 => hydrostatics::DRIFT,
        9 => hydrostatics::DAMPING,
        10 => hydrostatics::HULL,
        11 => surroundings::LAYOUTS,
        12 => surroundings::CONSTRAINTS,
        13 if keyword == "WAVE" => waves::REGULAR,
        13 => waves::SPECTRA,
        14 => mooring::LAYOUTS,
        15 => run::STARTS,
        16 => run::DECK_16_CARDS,
        17 => run::MULTIPLIERS,
        _ => printing::LAYOUTS,
    }
}

/// Reads a deck that is there once.
fn single(deck: &mut Deck, number: u8, reader: &mut CardReader<'_>) {
    let Some(header) = reader.header(number, false) else { return };
    if header.keyword == "NONE" {
        if number == 5 {
            deck.global = properties::read_global(&[], &mut reader.remarks);
        }
        deck.cards.push(Cards { deck: number, header, records: Vec::new() });
        return;
    }
    let label = format!("deck {number} {}", header.keyword);
    let records = reader.records(number, &label, layouts(number, &header.keyword));
    let remarks = &mut reader.remarks;
    match number {
        1 => deck.nodes = nodes::read(&records, remarks),
        3 => deck.materials = properties::read_materials(&records, remarks),
        4 => deck.geometries = properties::read_geometries(&records, remarks),
        5 => deck.global = properties::read_global(&records, remarks),
        11 => deck.surroundings = surroundings::read(&records, remarks),
        12 => {
            deck.held = surroundings::read_constraints(&records, remarks);
            deck.articulations = articulations::read(&records, remarks);
        }
        13 if header.keyword == "WAVE" => deck.waves = waves::read_regular(&records, remarks),
        13 => deck.waves = waves::read_spectra(&records, remarks),
        14 => deck.mooring = mooring::read(&records, remarks),
        15 => deck.starts = run::read_starts(&records, remarks),
        16 => deck.steps = run::read_steps(&records, remarks),
        17 => deck.multipliers = run::read_multipliers(&records, remarks),
        _ => deck.printing = printing::read(&records, remarks),
    }
    deck.cards.push(Cards { deck: number, header, records });
}

/// Reads the decks ELM1, ELM2, .. up to FINI.
fn structures(deck: &mut Deck, reader: &mut CardReader<'_>) {
    let mut made = 0;
    while deck.structures.len() < run::MAX_STRUCTURES as usize {
        let next = reader.next_header();
        if !deck.structures.is_empty() && !next.is_some_and(|(number, _)| number == 2 || number == 0) {
            let here = reader.current_span();
            reader.remarks.add(
                Diagnostic::warning("deck 2: the series of structures has no FINI", here)
                    .label("FINI belongs before this"),
            );
            return;
        }
        let Some(header) = reader.header(2, true) else { return };
        if header.keyword != "ELM" {
            deck.cards.push(Cards { deck: 2, header, records: Vec::new() });
            return;
        }
        let wanted = i64::try_from(deck.structures.len()).unwrap_or(i64::MAX).saturating_add(1);
        if header.structure != wanted {
            reader.remarks.add(
                Diagnostic::error(
                    format!("deck 2: ELM{} comes in the place of ELM{wanted}", header.structure),
                    header.span,
                )
                .label("structures are numbered 1, 2, .. in order"),
            );
        }
        let label = format!("deck 2 ELM{}", header.structure);
        let records = reader.records(2, &label, layouts(2, "ELM"));
        let structure = elements::read(header.structure, header.span, &records, made, &mut reader.remarks);
        made += structure.elements.len();
        deck.structures.push(structure);
        deck.cards.push(Cards { deck: 2, header, records });
    }
}

/// Reads the decks of one number for each structure: as many as there are structures, or fewer and FINI, or NONE.
fn per_structure(deck: &mut Deck, number: u8, reader: &mut CardReader<'_>) {
    let count = deck.structures.len().max(1);
    for index in 0..count {
        let next = reader.next_header();
        if index > 0 && !next.is_some_and(|(other, _)| other == number || other == 0) {
            let here = reader.current_span();
            reader.remarks.add(
                Diagnostic::warning(
                    format!("deck {number} is there for {index} of {count} structures and has no FINI"),
                    here,
                )
                .label("FINI belongs before this"),
            );
            return;
        }
        let Some(header) = reader.header(number, true) else { return };
        if header.structure == 0 {
            deck.cards.push(Cards { deck: number, header, records: Vec::new() });
            return;
        }
        let records = take(deck, number, &header.keyword, header.structure, reader);
        deck.cards.push(Cards { deck: number, header, records });
    }
    if let Some((0, header)) = reader.next_header()
        && header.keyword == "FINI"
    {
        reader.take();
        let message = format!("deck {number}: FINI after the last structure has no effect");
        reader.remarks.add(Diagnostic::warning(message, header.span));
    }
}

fn take(deck: &mut Deck, number: u8, keyword: &str, structure: i64, reader: &mut CardReader<'_>) -> Vec<CardRecord> {
    let label = format!("deck {number} {keyword}{structure}");
    let here = reader.current_span();
    let records = reader.records(number, &label, layouts(number, keyword));
    let count = deck.structures.len().max(1);
    let index = usize::try_from(structure - 1).unwrap_or(usize::MAX);
    if index >= count {
        let message = format!("{label}: there is no structure {structure} in deck 2");
        reader.remarks.add(Diagnostic::error(message, here));
        return records;
    }
    deck.hydrostatics.resize(count, HydrostaticsDecks::default());
    if let Some(into) = deck.hydrostatics.get_mut(index) {
        hydrostatics::read(into, number, &records, &mut reader.remarks);
    }
    records
}
