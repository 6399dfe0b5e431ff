//! What can only be checked when all decks are read: whether what a card refers to is there, and what
//! [AQWA-TETHER 8.1] demands of a towed tether.

use super::Deck;
use super::card::Field;
use super::elements::ElementShape;
use super::job::Program;
use super::lines::{DYNAMIC_ELEMENTS, LineKind, MooringLine};
use super::panels;
use super::remarks::Remarks;
use super::start_positions;
use super::tethers::Tether;
use super::waves::WaveDeck;
use std::f64::consts::TAU;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Share of the weight by which a buoyancy may differ from it: the digits a card usually has.
const BUOYANCY_SHARE: f64 = 1e-3;

/// Checks a deck as a whole; decks that belong to stages before the first one are not asked for.
pub fn check(deck: &Deck, remarks: &mut Remarks) {
    let whole = deck.job.has_deck(1);
    if whole {
        elements(deck, remarks);
        panels::check(deck, remarks);
        diffraction(deck, remarks);
        assumed_coefficients(deck, remarks);
        waterlines(deck, remarks);
        buoyancies(deck, remarks);
        for tether in &deck.mooring.tethers {
            tether_refers(deck, tether, remarks);
        }
        line_ends(deck, remarks);
        line_breaks(deck, remarks);
        joints(deck, remarks);
        numbers_of_structures(deck, remarks);
        start_positions::check(deck, remarks);
    }
    check_towed_tether(deck, whole, remarks);
    run(deck, remarks);
    time_step(deck, remarks);
    output(deck, remarks);
}

fn missing(what: String, span: Span, remarks: &mut Remarks) {
    remarks.add(Diagnostic::error(what, span).label("refers to what is not there"));
}

fn elements(deck: &Deck, remarks: &mut Remarks) {
    for structure in &deck.structures {
        for element in &structure.elements {
            let keyword = element.shape.keyword();
            for node in &element.nodes {
                if !deck.nodes.contains_key(node) {
                    missing(format!("deck 2, {keyword}: node {node} is not in deck 1"), element.span, remarks);
                }
            }
            if element.material != 0 && !deck.materials.contains_key(&element.material) {
                let message = format!("deck 2, {keyword}: material group {} is not in deck 3", element.material);
                missing(message, element.span, remarks);
            }
            if element.geometry != 0 && deck.geometry(element.shape, element.geometry).is_none() {
                let message = format!("deck 2, {keyword}: deck 4 has no {keyword} group {}", element.geometry);
                missing(message, element.span, remarks);
            }
            match element.shape {
                ElementShape::Quad | ElementShape::Triangle | ElementShape::FieldPoint => {
                    if deck.database(structure).is_some() {
                        remarks.add_once(&format!("panels of {}", structure.number), || {
                            Diagnostic::remark(
                                format!("deck 2, {keyword}: the panels are not used: FILE gives what comes of them"),
                                element.span,
                            )
                        });
                        continue;
                    }
                    if element.shape == ElementShape::FieldPoint {
                        remarks.add_once("field points", || {
                            let text = format!("deck 2, {keyword}: no pressures are printed at points of the field");
                            Diagnostic::remark(text, element.span)
                                .help("PLOT WAVES of the model draws the waves around the bodies")
                        });
                    }
                }
                ElementShape::Stub | ElementShape::Disc => remarks.add_once("stubs", || {
                    Diagnostic::error(
                        format!("deck 2, {keyword}: no source gives the geometry of this element"),
                        element.span,
                    )
                    .help("give a TUBE instead")
                }),
                ElementShape::Tube | ElementShape::PointMass | ElementShape::PointBuoyancy => {}
            }
            let ends = (element.nodes.first(), element.nodes.get(1));
            if let (ElementShape::Tube, (Some(first), Some(second))) = (element.shape, ends)
                && deck.nodes.get(first).zip(deck.nodes.get(second)).is_some_and(|(a, b)| a.position == b.position)
            {
                let message = format!("deck 2, TUBE: nodes {first} and {second} are at one place");
                remarks.add(Diagnostic::error(message, element.span).label("a tube has a length"));
            }
        }
    }
}

/// What the diffraction of waves by panels asks for: frequencies and directions, a mass, structures that are there.
fn diffraction(deck: &Deck, remarks: &mut Remarks) {
    for structure in &deck.structures {
        let number = structure.number;
        if let Some(first) = structure.solved_with
            && !(1..number).contains(&first.value)
        {
            let text =
                format!("deck 2, HYDI, columns 16-20: {} is no structure before structure {number}", first.value);
            remarks.add(
                Diagnostic::error(text, first.span)
                    .label("the first of the structures that are solved together with this one")
                    .help("the card stands in the deck of the last of them"),
            );
        }
        let has_tubes = structure.elements.iter().any(|element| element.shape == ElementShape::Tube);
        if let (Some(card), true) = (structure.mirrors.iter().flatten().next(), has_tubes) {
            remarks.add(
                Diagnostic::error("deck 2: no source says what SYMX and SYMY do to TUBE elements", *card)
                    .help("give all panels of a structure with tubes, without SYMX and SYMY"),
            );
        }
        if !structure.is_diffracting() || deck.database(structure).is_some() || !deck.job.has_deck(6) {
            continue;
        }
        let known = deck.hydrostatics_of(number);
        for (what, cards, is_missing) in [
            ("frequencies", "FREQ, PERD or HRTZ", known.is_none_or(|known| known.frequencies.is_empty())),
            ("directions", "DIRN", known.is_none_or(|known| known.directions.is_empty())),
        ] {
            if is_missing && deck.job.program == Program::Line {
                remarks.add(
                    Diagnostic::error(format!("deck 6: structure {number} has no {what}"), structure.span)
                        .label("its panels diffract waves")
                        .help(format!(
                            "{cards} in deck 6: first index in columns 11-15, last in 16-20, values from 21 on"
                        )),
                );
            }
        }
    }
}

/// Says which tubes have the assumed coefficients.
fn assumed_coefficients(deck: &Deck, remarks: &mut Remarks) {
    for ((shape, group), geometry) in &deck.geometries {
        if *shape != ElementShape::Tube {
            continue;
        }
        let blank = [
            ("drag", geometry.drag.is_none(), geometry.drag()),
            ("added mass", geometry.added_mass.is_none(), geometry.added_mass()),
        ];
        for (what, _, value) in blank.into_iter().filter(|(_, assumed, _)| *assumed) {
            remarks.add(
                Diagnostic::remark(
                    format!("deck 4, TUBE: group {group} has no {what} coefficient: {value} is assumed"),
                    geometry.span,
                )
                .help("CONT after the card: drag in columns 21-30, added mass in columns 31-40"),
            );
        }
    }
}

/// ZLWL of deck 2 and ZCGE of deck 7 tell the same draught.
fn waterlines(deck: &Deck, remarks: &mut Remarks) {
    for (structure, hydrostatics) in deck.structures.iter().zip(&deck.hydrostatics) {
        let (Some((line, at)), Some(height)) = (structure.waterline, hydrostatics.height) else { continue };
        let centre = deck.mass_properties(structure).centre[2];
        // the four decimals a card usually has
        if (centre - line - height.value).abs() > 1e-3 * (1.0 + centre.abs()) {
            let message = format!(
                "deck 7, ZCGE: the centre of gravity is at {}, but ZLWL puts it at {}",
                height.value,
                centre - line
            );
            remarks.add(Diagnostic::error(message, height.span).other(at, "the water line of deck 2"));
        }
    }
}

/// BFEQ of deck 7 is the weight of a structure that floats by itself [AQWA-REF BFEQ]; that of the nominal vessel of a towed tether has a check of its own.
fn buoyancies(deck: &Deck, remarks: &mut Remarks) {
    if deck.mooring.tethers.iter().any(Tether::is_towed) {
        return;
    }
    for (structure, known) in deck.structures.iter().zip(&deck.hydrostatics) {
        let weight = deck.mass_properties(structure).mass * deck.global.gravity;
        let Some(buoyancy) = known.buoyancy.filter(|given| given.value > 0.0 && weight > 0.0) else { continue };
        if (buoyancy.value - weight).abs() > BUOYANCY_SHARE * weight {
            let message = format!(
                "deck 7, BFEQ, columns 21-30: {} is not the weight of structure {}, {weight:.5E}",
                buoyancy.value, structure.number
            );
            remarks.add(
                Diagnostic::warning(message, buoyancy.span)
                    .label("the buoyancy force at the free-floating equilibrium")
                    .help("the structure floats where its stiffness, lines and joints bear the difference"),
            );
        }
    }
}

fn node(deck: &Deck, card: &str, node: Field<i64>, remarks: &mut Remarks) {
    if !deck.nodes.contains_key(&node.value) {
        missing(format!("{card}: node {} is not in deck 1", node.value), node.span, remarks);
    }
}

fn structure(deck: &Deck, card: &str, number: Field<i64>, remarks: &mut Remarks) {
    if number.value > 0 && deck.structure(number.value).is_none() {
        missing(format!("{card}: structure {} is not in deck 2", number.value), number.span, remarks);
    }
}

fn tether_refers(deck: &Deck, tether: &Tether, remarks: &mut Remarks) {
    node(deck, "deck 14, TETH, columns 16-20", tether.node, remarks);
    node(deck, "deck 14, TETH, columns 26-30", tether.anchor, remarks);
    structure(deck, "deck 14, TETH, columns 11-15", tether.structure, remarks);
    if tether.copy_of.is_some() {
        return;
    }
    for element in &tether.description.elements {
        node(deck, "deck 14, TELM, columns 11-15", element.node1, remarks);
        node(deck, "deck 14, TELM, columns 16-20", element.node2, remarks);
        let (material, geometry) = (element.material, element.geometry);
        if !deck.materials.contains_key(&material.value) {
            let message = format!("deck 14, TELM, columns 21-25: material group {} is not in deck 3", material.value);
            missing(message, material.span, remarks);
        }
        match deck.geometry(ElementShape::Tube, geometry.value) {
            None => {
                let message = format!("deck 14, TELM, columns 26-30: deck 4 has no TUBE group {}", geometry.value);
                missing(message, geometry.span, remarks);
            }
            Some(tube) if tube.parameters[1].value <= 0.0 => {
                let message = "deck 14, TELM: a tether element has a wall, and this group has none";
                remarks
                    .add(Diagnostic::error(message, geometry.span).other(tube.span, "wall thickness, columns 31-40"));
            }
            Some(_) => {}
        }
        let position = |field: Field<i64>| deck.nodes.get(&field.value).map(|node| node.position);
        if position(element.node1).zip(position(element.node2)).is_some_and(|(a, b)| a == b) {
            remarks.add(
                Diagnostic::error("deck 14, TELM: both nodes are at one place", element.span)
                    .label("an element has a length"),
            );
        }
        if let Some(stiff) = deck.materials.get(&material.value).filter(|m| m.properties[1].value <= 0.0) {
            remarks.add(
                Diagnostic::error("deck 14, TELM: this material has no Young's modulus", material.span)
                    .other(stiff.span, "Young's modulus belongs in columns 31-40"),
            );
        }
    }
}

fn line_ends(deck: &Deck, remarks: &mut Remarks) {
    for line in &deck.mooring.lines {
        if matches!(line.kind, LineKind::Property { dynamic: true, .. })
            && deck.mooring.dynamics_off.is_none()
            && deck.mooring.elements.is_none()
        {
            remarks.add_once("NLID", || {
                Diagnostic::remark(
                    format!("deck 14, NLID: a dynamic line is cut into {DYNAMIC_ELEMENTS} elements"),
                    line.span,
                )
                .help("NCEL, columns 11-15, gives another number; -DYNAMICS N of &CONNECTOR does in a script")
            });
        }
        if let Some(pulley) = line.pulley {
            node(deck, "deck 14, PULY, columns 16-20", pulley.ends.node1, remarks);
            node(deck, "deck 14, PULY, columns 26-30", pulley.ends.node2, remarks);
        }
        let ends = line.ends;
        let earlier = deck.mooring.lines.iter().take_while(|other| other.span != line.span);
        if let Some(same) = earlier.into_iter().find(|other| other.ends.numbers() == ends.numbers()) {
            remarks.add(
                Diagnostic::warning("deck 14: another line runs between these nodes", line.span)
                    .label("both are taken")
                    .other(same.span, "the other one"),
            );
        }
        if deck.mooring.composite(line).is_some() {
            bottom(deck, line, remarks);
        }
        if ends.structure1.value == 0 && ends.structure2.value == 0 {
            let message = "deck 14, columns 11-15 and 21-25: this line is on no structure";
            remarks.add(
                Diagnostic::error(message, line.span)
                    .label("the number of a structure belongs in columns 11-15 or 21-25; 0 is the ground"),
            );
        }
        for (number, point) in [(ends.structure1, ends.node1), (ends.structure2, ends.node2)] {
            structure(deck, "deck 14, structure of a line", number, remarks);
            node(deck, "deck 14, node of a line", point, remarks);
        }
    }
}

/// Whether the structures and nodes of joints and fenders are there.
fn joints(deck: &Deck, remarks: &mut Remarks) {
    for joint in &deck.articulations {
        for side in joint.sides {
            structure(deck, "deck 12, DCON, structure", side.structure, remarks);
            node(deck, "deck 12, DCON, node", side.node, remarks);
            if side.axis.value != 0 {
                node(deck, "deck 12, DCON, node on an axis", side.axis, remarks);
            }
        }
    }
    for fender in &deck.mooring.fenders {
        for side in fender.sides {
            structure(deck, "deck 14, FLIN, structure", side.structure, remarks);
            node(deck, "deck 14, FLIN, node", side.node, remarks);
            if side.direction.value != 0 {
                node(deck, "deck 14, FLIN, node on a normal", side.direction, remarks);
            }
        }
    }
}

/// Whether the lines that break (LBRK) are there, and whether the card says when they do.
fn line_breaks(deck: &Deck, remarks: &mut Remarks) {
    let is_static = matches!(deck.job.program, Program::Librium | Program::Fer);
    for broken in &deck.mooring.breaks {
        if is_static && broken.spectrum.value == 0 {
            remarks.add(broken.refuse_without_spectrum());
        } else if !is_static && !broken.has_condition() {
            remarks.add(broken.refuse_without_condition());
        }
        let found = usize::try_from(broken.line.value - 1).ok().and_then(|index| deck.mooring.lines.get(index));
        if found.is_none() {
            let message = format!("deck 14, LBRK, columns 16-20: there is no line {}", broken.line.value);
            remarks.add(
                Diagnostic::error(message, broken.line.span)
                    .label(format!("lines count in the order of their cards, 1 to {}", deck.mooring.lines.len())),
            );
        }
    }
}

/// Says which bottom a line from a structure to an anchor lies on: that of its anchor.
fn bottom(deck: &Deck, line: &MooringLine, remarks: &mut Remarks) {
    let [first, _, second, _] = line.ends.numbers();
    let anchor = match (first > 0, second > 0) {
        (true, false) => line.ends.node2,
        (false, true) => line.ends.node1,
        _ => return,
    };
    let Some(position) = deck.nodes.get(&anchor.value) else { return };
    let (z, bed) = (position.position[2], -deck.global.depth);
    if z >= 0.0 {
        let message = format!("deck 14: the anchor of this line is at Z = {z}, which is not below the water line");
        remarks.add(Diagnostic::error(message, anchor.span).label("a line lies on the bottom at its anchor"));
    } else if z < bed {
        let message = format!("deck 14: the anchor of this line is at Z = {z}, below the sea bed at {bed}");
        remarks.add(Diagnostic::warning(message, anchor.span).label("the line lies on a bottom at its anchor"));
    } else if z > bed {
        let message = format!("deck 14: the anchor of this line is at Z = {z}, above the sea bed at {bed}");
        remarks.add(Diagnostic::remark(message, anchor.span).label("the line lies on a bottom at its anchor"));
    }
}

fn numbers_of_structures(deck: &Deck, remarks: &mut Remarks) {
    for start in &deck.starts {
        let number = Field { value: start.structure, given: true, span: start.span };
        structure(deck, "deck 15", number, remarks);
    }
    for held in &deck.held {
        structure(deck, &format!("deck 12, {}", held.card), held.structure, remarks);
    }
    for multipliers in &deck.multipliers {
        structure(deck, "deck 17", multipliers.structure, remarks);
    }
    for printed in &deck.printing.nodes {
        structure(deck, "deck 18, NODE, columns 11-15", printed.structure, remarks);
        node(deck, "deck 18, NODE, columns 16-20", printed.node, remarks);
    }
    for number in &deck.printing.tensions {
        structure(deck, "deck 18, PTEN, columns 11-15", *number, remarks);
    }
    for switch in &deck.printing.switches {
        structure(deck, "deck 18, columns 11-15", switch.structure, remarks);
    }
}

/// What 6.1, 6.2, 8.1 and A.12 demand of a towed tether.
fn check_towed_tether(deck: &Deck, whole: bool, remarks: &mut Remarks) {
    let Some(tether) = deck.mooring.tethers.iter().find(|tether| tether.is_towed()) else { return };
    if deck.mooring.tethers.len() > 1 {
        remarks.add(
            Diagnostic::error("deck 14: a towed tether is the only tether of a deck", tether.span)
                .help("its TETH card is the last and only one [AQWA-TETHER A.12]"),
        );
    }
    if tether.structure.value != 1 {
        remarks.add(
            Diagnostic::error(
                "deck 14, TETH, columns 11-15: a towed tether is fixed to structure 1",
                tether.structure.span,
            )
            .label("1 belongs here"),
        );
    }
    if !whole {
        return;
    }
    if !deck.job.option("LSTF") {
        remarks.add(
            Diagnostic::warning("deck 0: a towed tether asks for the option LSTF", deck.job.span)
                .help("the nominal vessel is held by the linear stiffness of deck 7 [AQWA-TETHER 8.1.0]"),
        );
    }
    let position = |number: i64| deck.nodes.get(&number).map(|node| node.position);
    let elements = &tether.description.elements;
    let along: Vec<[f64; 3]> = elements
        .iter()
        .take(1)
        .map(|element| element.node1)
        .chain(elements.iter().map(|element| element.node2))
        .filter_map(|field| position(field.value))
        .collect();
    let straight = along.windows(2).all(|pair| pair[1][0] > pair[0][0] && pair[1][1..] == pair[0][1..]);
    if !straight {
        remarks.add(
            Diagnostic::error(
                "deck 14: the nodes of a towed tether lie along +X, from the trailing end on",
                tether.span,
            )
            .help("X increases from element to element; Y and Z stay (chapter 4 and 6.1)"),
        );
    }
    let (Some(trailing), Some(first), Some(last)) = (position(tether.anchor.value), along.first(), along.last()) else {
        return;
    };
    let length = last[0] - first[0];
    if (trailing[0] + length).abs() > 1e-6 * length.abs() {
        remarks.add(
            Diagnostic::warning(
                format!("deck 14, TETH: the trailing end is at X = {}, the tether is {length} long", trailing[0]),
                tether.anchor.span,
            )
            .help("X of the trailing end is minus the length of the tether [AQWA-TETHER 6.1]"),
        );
    }
    nominal_vessel(deck, trailing[2], remarks);
}

/// BFEQ is the weight of the nominal vessel, ZCGE the Z of the trailing end [AQWA-TETHER 6.2].
fn nominal_vessel(deck: &Deck, depth: f64, remarks: &mut Remarks) {
    let (Some(structure), Some(known)) = (deck.structures.first(), deck.hydrostatics.first()) else { return };
    let weight = deck.mass_properties(structure).mass * deck.global.gravity;
    if let Some(buoyancy) = known.buoyancy
        && weight > 0.0
        && (buoyancy.value - weight).abs() > 1e-3 * weight
    {
        remarks.add(
            Diagnostic::warning(format!("deck 7, BFEQ: the weight of the vessel is {weight}"), buoyancy.span)
                .help("the buoyancy force is the mass times gravity [AQWA-TETHER 8.1.7]"),
        );
    }
    if let Some(height) = known.height
        && (height.value - depth).abs() > 1e-6
    {
        remarks.add(
            Diagnostic::warning(format!("deck 7, ZCGE: the trailing end of the tether is at Z = {depth}"), height.span)
                .help("the two are the same [AQWA-TETHER 8.1.7]"),
        );
    }
}

/// Time steps, statistics, phases and the wave of the program.
fn run(deck: &Deck, remarks: &mut Remarks) {
    if !deck.job.has_deck(9) {
        return;
    }
    let timed = matches!(deck.job.program, Program::Drift | Program::Naut);
    if timed && deck.steps.is_none() && !remarks.has_error() {
        remarks.add(
            Diagnostic::error("deck 16: a run in time has no TIME card", deck.job.span)
                .help("TIME: number of steps in columns 16-20, time step in 21-30, start in 31-40"),
        );
    }
    if let (Some(steps), Some(last)) = (deck.steps, deck.printing.last)
        && last.value > steps.count.value
    {
        let message = format!("deck 18, TSTF: step {} comes after the last one, {}", last.value, steps.count.value);
        remarks.add(Diagnostic::warning(message, last.span).help("the statistics end with the last step"));
    }
    match &deck.waves {
        WaveDeck::Regular(_) if deck.job.program == Program::Drift => remarks.add(
            Diagnostic::warning("deck 13: a regular wave is for NAUT, this JOB is for DRIF", deck.job.span)
                .help("SPEC is the deck of a spectrum"),
        ),
        WaveDeck::Spectra(spectra) => {
            for spectrum in spectra {
                let given = spectrum.phases.len();
                if given > 0 && i64::try_from(given) != Ok(spectrum.lines) {
                    let message = format!("deck 13, PHAS: {given} phases for {} spectral lines", spectrum.lines);
                    remarks.add(Diagnostic::error(message, spectrum.span).label("the spectrum they are for"));
                }
            }
        }
        _ => {}
    }
}

/// Chapter 4: the step of a tether's run is at most a tenth of the period of any response. The shortest is that of the shortest wave.
fn time_step(deck: &Deck, remarks: &mut Remarks) {
    let (Some(steps), false) = (deck.steps, deck.mooring.tethers.is_empty()) else { return };
    let shortest = match &deck.waves {
        WaveDeck::Still => return,
        WaveDeck::Regular(wave) => wave.period,
        WaveDeck::Spectra(list) => {
            let highest = list.iter().map(|sea| sea.range.1).fold(0.0, f64::max);
            if highest <= 0.0 {
                return;
            }
            TAU / highest
        }
    };
    // a wave of 2.5 rad/s and a step of 0.25 s are the manual's own
    if shortest > 0.0 && steps.step.value > 0.1 * shortest {
        let message = format!(
            "deck 16, TIME, columns 21-30: a step of {} s is more than a tenth of the period of the shortest wave, {shortest:.3} s",
            steps.step.value
        );
        remarks.add(
            Diagnostic::warning(message, steps.step.span)
                .help("compare the bending moments of a short run with those of one of half the step (chapter 4)"),
        );
    }
}

/// What is asked to be printed of the tethers.
fn output(deck: &Deck, remarks: &mut Remarks) {
    let Some(tether) = deck.mooring.tethers.first() else { return };
    if let Some(modes) = deck.mooring.modes {
        let most = 4 * deck.mooring.tethers.iter().map(Tether::nodes).max().unwrap_or(0);
        if i64::try_from(most).is_ok_and(|most| modes.value > most) {
            remarks.add(
                Diagnostic::remark(
                    format!("deck 14, TEIG: a tether has at most {most} modes here; all are printed"),
                    modes.span,
                )
                .help("there are four degrees of freedom at each node [AQWA-TETHER A.3]"),
            );
        }
    }
    if deck.job.has_deck(18) && deck.printing.tensions.is_empty() {
        remarks.add(
            Diagnostic::warning("deck 18 has no PTEN card: nothing is printed of the tethers", tether.span)
                .help("PTEN, structure in columns 11-15, asks for it [AQWA-TETHER 8.1.18]"),
        );
    }
    let slack = deck.mooring.slack_time.filter(|time| time.value > 0.0);
    if let (Some(slack), Some(every)) = (slack, deck.printing.tethers) {
        remarks.add(
            Diagnostic::remark("deck 14, TSLK: TPRV of deck 18 overrides this card", slack.span)
                .other(every.span, "TPRV"),
        );
    }
}
