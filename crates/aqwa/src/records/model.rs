//! Structures as bodies: decks 1 to 4, 7, 12, 15 and 17.

use super::diffraction;
use super::record_writer::{Script, difference, number, numbers, round_value};
use crate::Deck;
use crate::elements::{ElementShape, StructureDeck, StructureElement};
use crate::hydrostatics::{HydrostaticsDecks, SixBySix};
use crate::job::Program;
use crate::mass::MassProperties;
use nalgebra::Matrix6;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Friction along a tube: fixed in AQWA [AQWA-REF TUBE].
const AXIAL_FRICTION: f64 = 0.016;
/// Products of inertia beyond this share of the largest moment of inertia are no rounding.
const INERTIA_ROUNDING_SHARE: f64 = 1e-9;
/// Tubes of less than this share of the mass of their structure have a nominal mass.
const NOMINAL_MASS_SHARE: f64 = 1e-10;
const DOFS: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];
const STIFFNESS_OPTIONS: [&str; 6] = ["-KX", "-KY", "-KZ", "-KRX", "-KRY", "-KRZ"];

/// Name of the body of a structure.
pub(super) fn body(structure: i64) -> String {
    format!("S{structure}")
}

/// Name of a node on a structure, or in the ground (structure 0).
pub(super) fn point(structure: i64, node: i64) -> String {
    if structure > 0 { format!("*S{structure}_{node}") } else { format!("*N{node}") }
}

/// The nodes of anchors and trailing ends: points of the ground, as long as no body is described yet.
pub(super) fn ground(deck: &Deck, out: &mut Script) {
    let of_tethers = deck.mooring.tethers.iter().map(|tether| tether.anchor.value);
    let of_lines = deck.mooring.lines.iter().flat_map(|line| {
        let ends = line.ends;
        [(ends.structure1.value, ends.node1.value), (ends.structure2.value, ends.node2.value)]
    });
    let mut nodes: Vec<i64> = of_tethers.collect();
    nodes.extend(of_lines.chain(of_joints(deck)).filter(|(structure, _)| *structure <= 0).map(|(_, node)| node));
    nodes.sort_unstable();
    nodes.dedup();
    for node in nodes {
        if let Some(found) = deck.nodes.get(&node) {
            let position = found.position.map(|x| out.scale.length(x));
            out.card("deck 1", found.span);
            out.record(format!("{} {}", point(0, node), numbers(position)));
        }
    }
}

/// Structures and nodes of fenders and joints.
fn of_joints(deck: &Deck) -> impl Iterator<Item = (i64, i64)> + '_ {
    let fenders = deck.mooring.fenders.iter().flat_map(|f| f.sides.map(|s| (s.structure.value, s.node.value)));
    let joints = deck.articulations.iter().flat_map(|j| j.sides.map(|s| (s.structure.value, s.node.value)));
    fenders.chain(joints)
}

/// The nodes of a structure that something refers to, in order.
fn nodes(deck: &Deck, structure: &StructureDeck) -> Vec<i64> {
    let own = structure.number;
    let mut list: Vec<i64> = Vec::new();
    let tubes = structure.elements.iter().filter(|element| element.shape == ElementShape::Tube);
    list.extend(tubes.flat_map(|element| element.nodes.iter().copied()));
    list.extend(deck.mooring.tethers.iter().filter(|t| t.structure.value == own).map(|t| t.node.value));
    for line in &deck.mooring.lines {
        for (number, node) in [(line.ends.structure1, line.ends.node1), (line.ends.structure2, line.ends.node2)] {
            list.extend((number.value == own).then_some(node.value));
        }
    }
    list.extend(of_joints(deck).filter(|(number, _)| *number == own).map(|(_, node)| node));
    list.extend(deck.printing.nodes.iter().filter(|n| n.structure.value == own).map(|n| n.node.value));
    list.sort_unstable();
    list.dedup();
    list
}

/// A structure as a body whose origin is its centre of gravity.
pub(super) fn structure(deck: &Deck, of: &StructureDeck, out: &mut Script) {
    let mass = mass(deck, of, out);
    let nominal = deck.mooring.tethers.iter().any(|tether| tether.is_towed());
    let name = body(of.number);
    let header = format!("deck 2, ELM{}", of.number);
    out.card(&header, of.span);
    out.remark(&format!("structure {}: the origin of the body is its center of gravity", of.number));
    let held = fixed_dof_option(deck, of, nominal, out);
    out.record(format!("&DESCRIBE BODY {name}{held}"));
    out.record(format!("*{name}_CG 0 0 0"));
    for node in nodes(deck, of) {
        if let Some(found) = deck.nodes.get(&node) {
            let position = [0, 1, 2].map(|i| {
                let [at, centre] = [found.position[i], mass.centre[i]].map(|x| out.scale.length(x));
                difference(at, centre)
            });
            out.card("deck 1", found.span);
            out.record(format!("{} {}", point(of.number, node), numbers(position)));
        }
    }
    let massive = of.elements.iter().find(|element| element.shape == ElementShape::PointMass);
    match massive {
        Some(element) => out.card("deck 2, PMAS", element.span),
        None => out.card(&header, of.span),
    }
    weight(deck, of, &mass, out);
    let index = deck.structures.iter().position(|s| s.number == of.number);
    let known = index.and_then(|index| deck.hydrostatics.get(index));
    if let Some(known) = known {
        hydrostatics(deck, of, known, nominal, out);
        if !nominal {
            constant_matrices(deck, of, known, out);
        }
    }
    if let Some((name, span)) = known.and_then(|known| known.database.as_ref()) {
        database(deck, of, name, *span, out);
    }
    diffraction::hull(deck, of, &mass, out);
    out.card(&header, of.span);
    tubes(deck, of, out);
}

/// The coefficients of a hull. Its hydrostatics are those of the file where the deck gives none.
fn database(deck: &Deck, of: &StructureDeck, name: &str, span: Span, out: &mut Script) {
    let own = |at: usize| deck.hydrostatics.get(at);
    let index = deck.structures.iter().position(|s| s.number == of.number).unwrap_or(0);
    let quoted = if name.contains([' ', ',']) { format!("\"{name}\"") } else { name.to_string() };
    let mut text = format!("DATABASE {} -AQWA {quoted}", body(of.number));
    // a file that several structures name holds all of them
    let sharing = (0..deck.structures.len()).filter(|at| {
        own(*at).and_then(|known| known.database.as_ref()).is_some_and(|(other, _)| other.eq_ignore_ascii_case(name))
    });
    match own(index).and_then(|known| known.structure_of_file) {
        Some(number) => {
            text.push_str(&format!(" -INDEX {}", number.value));
            out.word("-INDEX", "deck 6, CSTR", number.span);
        }
        None if sharing.count() > 1 => text.push_str(&format!(" -INDEX {}", of.number)),
        None => {}
    }
    let has_tubes = of.elements.iter().any(|element| element.shape == ElementShape::Tube);
    if own(index).is_none_or(|known| known.stiffness.is_none()) && !has_tubes {
        text.push_str(" -HYDROSTATICS YES");
    }
    let card = own(index).and_then(|known| known.card("FILE")).map_or_else(|| "deck 7, FILE".into(), |(card, _)| card);
    out.card(card, span);
    out.record(text);
}

/// Mass, centre and inertia of a structure. Tubes whose mass is a nominal one (decks of structures whose whole mass stands in PMAS give
/// them a density of 1E-10) are left out: they would move the centre of gravity by what nobody can measure, and spoil the digits of
/// the cards.
fn mass(deck: &Deck, of: &StructureDeck, out: &mut Script) -> MassProperties {
    let whole = deck.mass_properties(of);
    let tubes = whole.kinds.iter().find(|kind| kind.shape == ElementShape::Tube).map_or(0.0, |kind| kind.mass);
    if tubes == 0.0 || tubes > NOMINAL_MASS_SHARE * whole.mass {
        return whole;
    }
    let first = of.elements.iter().find(|element| element.shape == ElementShape::Tube);
    let text = format!(
        "the nominal mass of the tubes of structure {}, {tubes:.1E} of {}, is left out",
        of.number,
        number(round_value(whole.mass - tubes))
    );
    out.note("deck 2, TUBE", first.map_or(of.span, |tube| tube.span), &text);
    let elements = of.elements.iter().filter(|element| element.shape != ElementShape::Tube).cloned().collect();
    deck.mass_properties(&StructureDeck { elements, ..of.clone() })
}

/// The degrees of freedom that are held, as an option.
fn fixed_dof_option(deck: &Deck, of: &StructureDeck, nominal: bool, out: &mut Script) -> String {
    if nominal {
        let text = "a towed tether runs by itself: its nominal vessel is held where it is";
        out.note(&format!("deck 2, ELM{}", of.number), of.span, text);
        return format!(" -IGNORE {}", DOFS.join(" "));
    }
    if deck.job.is_fixed() || (deck.job.program == Program::Line && of.fixed.is_some()) {
        return format!(" -IGNORE {}", DOFS.join(" "));
    }
    let given: Vec<_> = deck.held.iter().filter(|held| held.structure.value == of.number).collect();
    if let (Some(first), false) = (given.first(), deck.mooring.tethers.is_empty()) {
        out.refuse(
            Diagnostic::error(
                format!("deck 12, {}: a structure that tethers hold moves in all degrees of freedom here", first.card),
                first.dof.span,
            )
            .help("the engine of tethers holds none; a stiff GSPR of the model to the ground does"),
        );
    }
    let mut dofs: Vec<usize> = given.iter().filter_map(|h| usize::try_from(h.dof.value - 1).ok()).collect();
    dofs.sort_unstable();
    dofs.dedup();
    let names: Vec<&str> = dofs.iter().filter_map(|dof| DOFS.get(*dof).copied()).collect();
    if names.is_empty() { String::new() } else { format!(" -IGNORE {}", names.join(" ")) }
}

fn weight(deck: &Deck, of: &StructureDeck, mass: &MassProperties, out: &mut Script) {
    if mass.mass <= 0.0 {
        out.refuse(
            Diagnostic::error(format!("deck 2: structure {} has no mass", of.number), of.span)
                .help("a PMAS element with a material and a geometry group gives it mass and inertia"),
        );
        return;
    }
    let [xx, yy, zz] = [0, 1, 2].map(|i| mass.inertia[i][i]);
    let products = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| mass.inertia[i][j].abs());
    let largest = [xx, yy, zz].into_iter().fold(0.0, f64::max);
    if products.iter().any(|product| *product > INERTIA_ROUNDING_SHARE * largest) {
        let text = format!("deck 4: structure {} has products of inertia", of.number);
        out.refuse(
            Diagnostic::error(text, of.span)
                .label("about axes along those of deck 1 through its center of gravity")
                .help("#WEIGHT has radii of gyration along the axes of its body; give the structure in its principal axes"),
        );
    }
    let radii = [xx, yy, zz].map(|inertia| round_value(out.scale.length((inertia.max(0.0) / mass.mass).sqrt())));
    let weight = round_value(out.scale.force(mass.mass * deck.global.gravity, 0));
    out.record(format!("#WEIGHT *{}_CG {} {}", body(of.number), number(weight), numbers(radii)));
}

/// Refuses what a card of decks 6 to 9 says.
fn refuse_card(known: &HydrostaticsDecks, keyword: &str, what: &str, help: &str, out: &mut Script) {
    let Some((card, span)) = known.card(keyword) else { return };
    out.refuse(Diagnostic::error(format!("{card}: {what} is not read into the model"), span).help(help));
}

/// Added mass and damping that do not depend on the frequency (FIAM, FIDP), about the centre of gravity.
fn constant_matrices(deck: &Deck, of: &StructureDeck, known: &HydrostaticsDecks, out: &mut Script) {
    let gravity = deck.global.gravity;
    // added mass is a weight in the model
    let given = [("FIAM", "#AMASS", known.added_mass, gravity, 0), ("FIDP", "#DAMP", known.damping, 1.0, -1)];
    for (keyword, record, matrix, factor, power) in given {
        let (Some(matrix), Some((card, span))) = (matrix, known.card(keyword)) else { continue };
        let entry = |(row, column): (usize, usize), value: f64| {
            out.scale.force(round_value(value * factor), power + i32::from(row > 2) + i32::from(column > 2))
        };
        let rows = matrix.iter().enumerate().map(|(row, values)| {
            numbers(values.iter().enumerate().map(|(column, value)| entry((row, column), *value)))
        });
        let rows: Vec<String> = rows.collect();
        let text = format!("{record} *{}_CG -MATRIX \\\n  {}", body(of.number), rows.join(" \\\n  "));
        out.card(card, span);
        out.record(text);
    }
}

fn hydrostatics(deck: &Deck, of: &StructureDeck, known: &HydrostaticsDecks, nominal: bool, out: &mut Script) {
    if !nominal {
        let of_drift = "one matrix acts at all frequencies here: FIAM and FIDP of deck 7 give it";
        if known.drift_added_mass.is_some() {
            refuse_card(known, "FIDA", "an added mass of drift frequencies alone", of_drift, out);
        }
        if known.drift_damping.is_some() {
            refuse_card(known, "FIDD", "a damping of drift frequencies alone", of_drift, out);
        }
        if known.position.is_some_and(|p| p.iter().enumerate().any(|(i, x)| i != 2 && *x != 0.0)) {
            let help = "#HYDROSTATIC is about (0, 0, ZCGE), upright";
            refuse_card(known, "SPOS", "an X, Y or a rotation of the stiffness", help, out);
        }
    }
    let (Some(buoyancy), Some(height)) = (known.buoyancy, known.height) else {
        if known.added_stiffness.is_some() && !nominal {
            refuse_card(
                known,
                "ASTF",
                "a stiffness without LSTF",
                "a GSPR of the model to the ground is a stiffness",
                out,
            );
        }
        return;
    };
    if !nominal && of.elements.iter().any(|element| element.shape == ElementShape::Tube) {
        let help = "its tubes displace water themselves; leave out LSTF, or the tubes";
        refuse_card(known, "LSTF", "a stiffness of a structure of tubes", help, out);
        return;
    }
    if !nominal && deck.database(of).is_none() && of.hull_elements().next().is_some() {
        let help = "its panels displace water themselves; leave out LSTF, or the panels and give FILE";
        refuse_card(known, "LSTF", "a stiffness of a structure of panels", help, out);
        return;
    }
    let stiffness = sum(known.stiffness, known.added_stiffness);
    let mut text = format!("#HYDROSTATIC *{}_CG", body(of.number));
    text.push_str(&format!(" -BUOYANCY {}", number(out.scale.force(buoyancy.value, 0))));
    text.push_str(&format!(" -ZCGE {}", number(out.scale.length(height.value))));
    for (row, name) in STIFFNESS_OPTIONS.iter().enumerate() {
        let values: Vec<f64> = (0..6)
            .map(|column| {
                let power = i32::from(row > 2) + i32::from(column > 2) - 1;
                out.scale.force(stiffness[(row, column)], power)
            })
            .collect();
        if values.iter().any(|value| *value != 0.0) {
            text.push_str(&format!(" {name} {}", numbers(values)));
        }
    }
    if let Some((card, span)) = known.card("LSTF").or_else(|| known.card("BFEQ")) {
        out.card(card, span);
    }
    out.word("-BUOYANCY", "deck 7, BFEQ", buoyancy.span);
    out.word("-ZCGE", "deck 7, ZCGE", height.span);
    out.record(text);
}

fn sum(a: Option<SixBySix>, b: Option<SixBySix>) -> Matrix6<f64> {
    let of = |rows: Option<SixBySix>| {
        rows.map_or_else(Matrix6::zeros, |rows| {
            Matrix6::from_fn(|i, j| rows.get(i).and_then(|r| r.get(j)).copied().unwrap_or(0.0))
        })
    };
    of(a) + of(b)
}

/// The tubes of a structure, and what elements have no place in the model.
fn tubes(deck: &Deck, of: &StructureDeck, out: &mut Script) {
    if let Some(other) = of.elements.iter().find(|e| e.shape == ElementShape::PointBuoyancy) {
        out.refuse(
            Diagnostic::error("deck 2, PBOY: a buoyancy at a point has no place in the model", other.span)
                .help("give a TUBE of the same volume, or BFEQ of deck 7"),
        );
    }
    let tubes: Vec<&StructureElement> =
        of.elements.iter().filter(|element| element.shape == ElementShape::Tube).collect();
    if tubes.is_empty() {
        return;
    }
    let factors = deck.multipliers(of.number);
    out.record("&SURFACE");
    for (index, tube) in tubes.iter().enumerate() {
        let (Some(geometry), [first, second]) =
            (deck.geometry(ElementShape::Tube, tube.geometry), tube.nodes.as_slice())
        else {
            continue;
        };
        let name = body(of.number);
        let text = format!(
            "TUBE {name}_T{} {} {} {} -CD {} -CDA {} -CA {}",
            index + 1,
            point(of.number, *first),
            point(of.number, *second),
            number(out.scale.section(geometry.parameters[0].value)),
            number(product(geometry.drag(), factors.drag)),
            number(product(AXIAL_FRICTION, factors.drag)),
            number(product(geometry.added_mass(), factors.added_mass)),
        );
        out.card("deck 2, TUBE", tube.span);
        out.word("-CD", "deck 4, CONT", geometry.drag.map_or(geometry.span, |field| field.span));
        out.word("-CA", "deck 4, CONT", geometry.added_mass.map_or(geometry.span, |field| field.span));
        out.record(text);
    }
    out.record("END_&SURFACE");
}

/// A coefficient times a multiplier of deck 17.
pub(super) fn product(coefficient: f64, factor: f64) -> f64 {
    if factor == 1.0 { coefficient } else { round_value(coefficient * factor) }
}

/// Where the structures are at the start.
pub(super) fn starts(deck: &Deck, out: &mut Script) {
    for start in deck.starts.iter().filter(|start| start.velocity) {
        if start.values.iter().any(|value| *value != 0.0) {
            out.refuse(
                Diagnostic::error(
                    format!("deck 15, VEL{}: a run starts with the bodies at rest", start.structure),
                    start.span,
                )
                .label("zeros belong here")
                .help("a run in time lets a body come up to speed before the statistics start"),
            );
        }
    }
    for structure in &deck.structures {
        let given = deck.starts.iter().find(|start| start.structure == structure.number && !start.velocity);
        match given {
            Some(start) => out.card(format!("deck 15, POS{}", start.structure), start.span),
            None => out.card(format!("deck 2, ELM{}", structure.number), structure.span),
        }
        let [x, y, z, rx, ry, rz] = deck.start(structure);
        let [x, y, z] = [x, y, z].map(|value| out.scale.length(value));
        out.record(format!("&INSTATE -LOCATE {} {}", body(structure.number), numbers([x, y, z, rx, ry, rz])));
    }
}
