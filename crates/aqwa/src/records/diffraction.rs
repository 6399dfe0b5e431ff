//! Hulls by panels, and their radiation and diffraction: decks 1, 2 and 6 of AQWA-LINE as MESH and G_PRESSURE.

use super::model::body;
use super::record_writer::{Script, difference, numbers, opposite, round_value};
use crate::Deck;
use crate::elements::{ElementShape, StructureDeck};
use crate::job::Program;
use crate::mass::MassProperties;
use std::f64::consts::TAU;
use windlass_base::diagnostic::Diagnostic;

/// Displaced mass and mass of a structure that differ by more than this share are warned of: flat panels on a round hull are within.
const FLOATING_SHARE: f64 = 0.02;
/// Directions nearer than this (degrees) are one.
const SAME_DIRECTION: f64 = 1e-6;
/// The motions, as columns of reports name them.
const MOTIONS: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];

/// The pieces of the hull of a structure: its panels as they are.
pub(super) fn hull(deck: &Deck, of: &StructureDeck, mass: &MassProperties, out: &mut Script) {
    if deck.database(of).is_some() {
        return;
    }
    let Some(hull) = deck.hull(of) else { return };
    let header = format!("deck 2, ELM{}", of.number);
    if hull.has_walls {
        let text =
            "its panels end in the water line: upright walls are assumed above it, as high as the structure is deep";
        out.note(&header, of.span, text);
    }
    let displaced = hull.volume * deck.global.density;
    let tubes = of.elements.iter().any(|element| element.shape == ElementShape::Tube);
    if !tubes && (displaced - mass.mass).abs() > FLOATING_SHARE * mass.mass {
        let text = format!(
            "the panels of structure {} displace {displaced:.5E} and its mass is {:.5E}: it does not float at the water line of ZLWL, where its hydrodynamics are found",
            of.number, mass.mass
        );
        out.warn("deck 3", of.span, &text);
    }
    out.card(&header, of.span);
    out.record("&SURFACE");
    out.record(format!("MESH {}_HULL -OWN_PANELS -CS_WIND 0 0 0 -CS_CURRENT 0 0 0", body(of.number)));
    for vertex in &hull.vertices {
        let position = [0, 1, 2].map(|axis| {
            let [at, centre] = [vertex.position[axis], mass.centre[axis]].map(|x| out.scale.length(x));
            difference(at, centre)
        });
        out.card("deck 1", vertex.span);
        out.record(format!("VERTEX {} {}", vertex.name, numbers(position)));
    }
    for panel in &hull.panels {
        let names =
            panel.corners.iter().filter_map(|index| hull.vertices.get(*index)).map(|vertex| vertex.name.as_str());
        match panel.keyword {
            Some(keyword) => out.card(format!("deck 2, {keyword}"), panel.span),
            None => out.card(&header, panel.span),
        }
        out.record(format!("PANEL {}", names.collect::<Vec<_>>().join(" ")));
    }
    out.card(&header, of.span);
    out.record("END_MESH");
    out.record("END_&SURFACE");
}

/// Whether the hydrodynamics of a structure are found by its panels.
pub(super) fn is_computed(deck: &Deck, structure: &StructureDeck) -> bool {
    let known = deck.hydrostatics_of(structure.number);
    structure.is_diffracting()
        && deck.database(structure).is_none()
        && deck.job.has_diffraction()
        && known.is_some_and(|known| !known.frequencies.is_empty() && !known.directions.is_empty())
}

/// Structures that are solved together, those of each group in order.
fn groups(deck: &Deck) -> Vec<Vec<&StructureDeck>> {
    let mut groups: Vec<Vec<&StructureDeck>> = Vec::new();
    for structure in deck.structures.iter().filter(|structure| is_computed(deck, structure)) {
        let mut own = vec![structure];
        if let Some(first) = structure.solved_with {
            let is_with = |group: &Vec<&StructureDeck>| group.iter().any(|other| other.number >= first.value);
            let (with, apart): (Vec<_>, Vec<_>) = groups.into_iter().partition(is_with);
            groups = apart;
            own = with.into_iter().flatten().chain(own).collect();
        }
        groups.push(own);
    }
    groups
}

/// Directions (degrees, towards) with those that SYMX and SYMY of a structure give besides, as headings that waves come from.
fn headings(of: &StructureDeck, directions: &[f64]) -> Vec<f64> {
    let [over_y, over_x] = of.mirrors.map(|card| card.is_some());
    let mut list: Vec<f64> = Vec::new();
    for direction in directions {
        let mut all = vec![*direction];
        if over_y {
            all.extend(all.clone().into_iter().map(|d| -d));
        }
        if over_x {
            all.extend(all.clone().into_iter().map(|d| 180.0 - d));
        }
        for from in all.into_iter().map(opposite) {
            let is_there = |other: &f64| {
                let apart = (other - from).rem_euclid(360.0);
                apart.min(360.0 - apart) < SAME_DIRECTION
            };
            if !list.iter().any(is_there) {
                list.push(from);
            }
        }
    }
    list.sort_by(f64::total_cmp);
    list
}

fn periods(frequencies: &[f64]) -> Vec<f64> {
    let mut list: Vec<f64> = frequencies.iter().map(|frequency| round_value(TAU / frequency)).collect();
    list.sort_by(f64::total_cmp);
    list.dedup();
    list
}

/// The hydrodynamics of the structures by their panels, where deck 2 has them.
pub(super) fn diffraction(deck: &Deck, out: &mut Script) {
    let groups = groups(deck);
    if groups.is_empty() {
        return;
    }
    let fixed = |structure: &StructureDeck| deck.job.program != Program::Line && structure.fixed.is_some();
    for structure in deck.structures.iter().filter(|structure| fixed(structure)) {
        if let Some(card) = structure.fixed {
            out.note(
                "deck 2, FIXD",
                card,
                "fixes the structure in LINE alone; DACF of deck 12 holds degrees of freedom",
            );
        }
    }
    for structure in &deck.structures {
        if let Some((group, card)) = structure.lid {
            let text = match group {
                0 => "the lid within the hull is made of panels about as large as those of the water line".to_string(),
                _ => format!("the lid within the hull is made anew: the panels of group {group} are left out"),
            };
            out.note("deck 2, ILID", card, &text);
        }
        let [x, y, z] = deck.mass_properties(structure).centre;
        let line = structure.waterline.map_or(0.0, |(height, _)| height);
        match structure.waterline {
            Some((_, card)) => out.card("deck 2, ZLWL", card),
            None => out.card(format!("deck 2, ELM{}", structure.number), structure.span),
        }
        let place = [x, y, z - line].map(|value| out.scale.length(round_value(value)));
        out.record(format!("&INSTATE -LOCATE {} {} 0 0 0", body(structure.number), numbers(place)));
    }
    out.card("deck 0, JOB", deck.job.span);
    out.record("END");
    out.record("HYDRODYNAMICS");
    for group in &groups {
        let Some((first, others)) = group.split_first() else { continue };
        let Some(known) = deck.hydrostatics_of(first.number) else { continue };
        for other in others {
            let own = deck.hydrostatics_of(other.number);
            if own.is_none_or(|own| own.frequencies != known.frequencies || own.directions != known.directions) {
                let text = format!(
                    "the frequencies and directions of structure {} are those of structure {}, with which it is solved together",
                    other.number, first.number
                );
                out.warn("deck 6", other.span, &text);
            }
        }
        let mut text = format!("G_PRESSURE {}", body(first.number));
        if let Some(last) = others.last() {
            let names: Vec<String> = others.iter().map(|other| body(other.number)).collect();
            text.push_str(&format!(" -WITH {} -MEAN_DRIFT", names.join(" ")));
            if let Some(card) = last.solved_with {
                out.word("-WITH", "deck 2, HYDI", card.span);
            }
        }
        let directions = if others.is_empty() {
            headings(first, &known.directions)
        } else {
            headings(&StructureDeck::default(), &known.directions)
        };
        text.push_str(&format!(" \\\n  -HEADING {}", numbers(directions)));
        text.push_str(&format!(" \\\n  -PERIOD {}", numbers(periods(&known.frequencies))));
        let of_periods = ["FREQ", "PERD", "HRTZ"].into_iter().find_map(|keyword| known.card(keyword));
        for (word, card) in [("-HEADING", known.card("DIRN")), ("-PERIOD", of_periods)] {
            if let Some((card, span)) = card {
                out.word(word, card, span);
            }
        }
        let (start, _) = deck.job.stages;
        if start > 3 && !deck.job.database.is_empty() {
            let names: Vec<String> = group.iter().map(|structure| body(structure.number)).collect();
            text.push_str(&format!(" \\\n  -KEPT \"{}.ans/{}.nc\"", deck.job.database, names.join("_")));
        }
        out.card(format!("deck 2, ELM{}", first.number), first.span);
        out.record(text);
    }
    out.card("deck 0, JOB", deck.job.span);
    out.record("END");
    out.record("MEDIT");
}

/// Entries of a matrix that are not zero by the symmetry of a structure, of one and its transpose the first.
fn entries(of: &StructureDeck) -> Vec<[usize; 2]> {
    let [over_y, over_x] = of.mirrors.map(|card| card.is_some());
    // motions that are odd at y = 0, and at x = 0
    let (odd_y, odd_x) = ([1, 3, 5], [0, 4, 5]);
    let couples =
        |odd: [usize; 3], is_mirrored: bool, i: usize, j: usize| !is_mirrored || odd.contains(&i) == odd.contains(&j);
    let all = (0..6).flat_map(|i| (i..6).map(move |j| [i, j]));
    all.filter(|[i, j]| couples(odd_y, over_y, *i, *j) && couples(odd_x, over_x, *i, *j)).collect()
}

/// What LINE prints: stiffness, added mass, damping, exciting forces, mean drift, and motions in unit waves.
pub(super) fn results(deck: &Deck, out: &mut Script) {
    let groups = groups(deck);
    let alone = StructureDeck::default();
    let computed: Vec<(&StructureDeck, bool)> =
        groups.iter().flat_map(|group| group.iter().map(move |structure| (*structure, group.len() == 1))).collect();
    for (structure, _) in &computed {
        out.record(format!("&STATUS HYDROSTATICS {}", body(structure.number)));
    }
    out.record("HYDRODYNAMICS");
    for (structure, is_alone) in &computed {
        let name = body(structure.number);
        let pairs = entries(if *is_alone { structure } else { &alone });
        let column = |kind: &str| {
            let of = |[i, j]: &[usize; 2]| format!("'{kind} {}-{}'", MOTIONS[*i], MOTIONS[*j]);
            pairs.iter().map(of).collect::<Vec<_>>().join(" ")
        };
        for kind in ["A", "B"] {
            out.record(format!("V_MATRICES {name}"));
            out.record(format!("REPORT Period {}", column(kind)));
            out.record("END");
        }
        for view in ["V_EXFORCES", "V_MDRIFT"] {
            out.record(format!("{view} {name}"));
            out.record("REPORT");
            out.record("END");
        }
    }
    out.record("END");
    let is_fixed = |structure: &StructureDeck| deck.job.is_fixed() || structure.fixed.is_some();
    let moving: Vec<&StructureDeck> =
        computed.iter().map(|(structure, _)| *structure).filter(|structure| !is_fixed(structure)).collect();
    if moving.is_empty() {
        return;
    }
    out.record("FREQ_RESPONSE");
    out.record("RAO");
    for structure in moving {
        out.record(format!("MOTION {}", body(structure.number)));
        out.record("REPORT");
        out.record("END");
    }
    out.record("END");
}

/// Refuses a job of LINE whose structures have no panels.
pub(super) fn refuse_without_panels(deck: &Deck, out: &mut Script) {
    if deck.structures.iter().any(|structure| is_computed(deck, structure)) {
        return;
    }
    out.refuse(
        Diagnostic::error("deck 0: LINE is the diffraction of waves by panels, and no structure has any", deck.job.span)
            .label("QPPL and TPPL with DIFF in columns 12-15 of deck 2 are panels")
            .help("LIBR, FER, DRIF and NAUT run structures of tubes, and those whose FILE in deck 6 or 7 has their coefficients"),
    );
}
