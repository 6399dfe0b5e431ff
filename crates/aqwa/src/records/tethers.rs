//! Tethers of deck 14: a class for each description, a connector for each TETH card.

use super::model::{point, product};
use super::record_writer::{Script, difference, number, numbers, round_value};
use crate::Deck;
use crate::elements::ElementShape;
use crate::end_springs::EndSpringCard;
use crate::tethers::{ConstraintKind, TelmCard, Tether, TetherCards};
use windlass_base::span::Span;

/// Cards of an installed tether with the options they become.
const OPTIONS: [(&str, &str); 5] =
    [("TCAP", "-CAPS"), ("TIFL", "-FLUID"), ("TIMP", "-IMPACT"), ("TLOW", "-LOW_STOP"), ("TEGR", "-GROUP")];

/// Name of the connector of a tether, by its place in deck 14.
pub(super) fn name(index: usize) -> String {
    format!("T{}", index + 1)
}

/// Classes and connectors.
pub(super) fn tethers(deck: &Deck, out: &mut Script) {
    for (index, tether) in deck.mooring.tethers.iter().enumerate() {
        if tether.copy_of.is_none() {
            class(deck, index, tether, out);
        }
        connector(deck, index, tether, out);
    }
}

/// One record a TELM card, from the vessel to the anchor: the class has its sections from the fairlead.
fn class(deck: &Deck, index: usize, tether: &Tether, out: &mut Script) {
    let factors = deck.multipliers(tether.structure.value);
    for element in tether.description.elements.iter().rev() {
        let (Some(length), Some(material), Some(geometry)) = (
            length(deck, element, out),
            deck.materials.get(&element.material.value),
            deck.geometry(ElementShape::Tube, element.geometry.value),
        ) else {
            continue;
        };
        let [density, modulus, _] = material.properties.map(|field| field.value);
        let [diameter, wall, ..] = geometry.parameters.map(|field| out.scale.length(field.value));
        let text = format!(
            "~{} TETHER {} -LEN {} -DENSITY {} -EMODULUS {} -CA {} -CD {} -LABEL {} {} {} {}",
            name(index),
            numbers([diameter, wall]),
            number(length),
            number(out.scale.density(density)),
            number(out.scale.pascals(modulus)),
            number(product(geometry.added_mass(), factors.added_mass)),
            number(product(geometry.drag(), factors.drag)),
            element.node1.value,
            element.node2.value,
            element.material.value,
            element.geometry.value,
        );
        out.card("deck 14, TELM", element.span);
        out.word("TETHER", "deck 4, TUBE", geometry.span);
        out.word("-LEN", "deck 14, TELM", element.span);
        let [density, modulus, _] = material.properties.map(|field| field.span);
        out.word("-DENSITY", "deck 3, columns 21-30", density);
        out.word("-EMODULUS", "deck 3, columns 31-40", modulus);
        for (word, field) in [("-CA", geometry.added_mass), ("-CD", geometry.drag)] {
            out.word(word, "deck 4, CONT", field.map_or(geometry.span, |field| field.span));
        }
        out.record(text);
    }
}

/// Length of an element (m).
fn length(deck: &Deck, element: &TelmCard, out: &Script) -> Option<f64> {
    let position = |node: i64| deck.nodes.get(&node).map(|node| node.position.map(|x| out.scale.length(x)));
    let (from, to) = (position(element.node1.value)?, position(element.node2.value)?);
    let along = [0, 1, 2].map(|i| difference(to[i], from[i]));
    Some(match along.iter().filter(|x| **x != 0.0).count() {
        // along an axis the digits of the cards are the length
        1 => along.iter().sum::<f64>().abs(),
        _ => round_value(along.iter().map(|x| x * x).sum::<f64>().sqrt()),
    })
}

fn connector(deck: &Deck, index: usize, tether: &Tether, out: &mut Script) {
    let class = tether.copy_of.map_or(index, |number| number.saturating_sub(1));
    let mut text = format!(
        "CONNECTOR {} ~{} {} {}",
        name(index),
        name(class),
        point(tether.structure.value, tether.node.value),
        point(0, tether.anchor.value)
    );
    let description = &tether.description;
    out.card("deck 14, TETH", tether.span);
    text.push_str(if tether.is_towed() { " -TOWED" } else { " -INSTALLED" });
    for (spring, side) in [(description.vessel, 'V'), (description.anchor, 'A')] {
        if let Some(spring) = spring {
            let word = match (side, tether.is_towed()) {
                ('V', true) => "-V_MOORING",
                ('V', false) => "-V_SPRINGS",
                (_, true) => "-A_MOORING",
                (_, false) => "-A_SPRINGS",
            };
            out.word(word, format!("deck 14, TSP{side}"), spring.span);
            text.push_str(&springs(spring, side, tether.is_towed(), out));
        }
    }
    if tether.is_towed() {
        not_of_towed(description, out);
        text.push_str(&impact_and_stop(description, out));
    } else {
        text.push_str(&of_installed(description, out));
    }
    if let Some(node) = deck.nodes.get(&tether.node.value) {
        let position = node.position.map(|x| out.scale.length(x));
        text.push_str(&format!(" \\\n  -GIVEN {}", numbers(position)));
    }
    out.record(text);
}

fn springs(spring: EndSpringCard, side: char, towed: bool, out: &Script) -> String {
    let values = spring.stiffness.map(|field| field.value);
    let (kind, powers) = if towed { ("MOORING", [-1; 3]) } else { ("SPRINGS", [-1, 1, 1]) };
    let values = values.into_iter().zip(powers).map(|(value, power)| out.scale.force(value, power));
    format!(" \\\n  -{side}_{kind} {}", numbers(values))
}

/// Says which cards have no effect on a towed tether.
fn not_of_towed(description: &TetherCards, out: &mut Script) {
    let given = [
        ("TCAP", description.caps != (0.0, 0.0)),
        ("TIFL", description.fluid != (0.0, 0.0)),
        ("TEGR", description.group > 1),
    ];
    let cards = given.into_iter().filter(|(_, given)| *given);
    let cards = cards.filter_map(|(keyword, _)| Some((keyword, description.card(keyword)?)));
    let constraints = description.constraints.iter().map(|(kind, _, span)| (card(*kind), *span));
    for (keyword, span) in cards.chain(constraints) {
        let card = format!("deck 14, {keyword}, columns 7-10");
        out.note(&card, span, "a card of installed tethers; it has no effect on a towed one");
    }
}

/// Impact and lower stop. A towed tether has them for its description alone.
fn impact_and_stop(description: &TetherCards, out: &mut Script) -> String {
    let mut text = String::new();
    match description.impact {
        Some((factor, half_life)) if factor > 0.0 && half_life > 0.0 => {
            text.push_str(&format!(" \\\n  -IMPACT {}", numbers([out.scale.force(factor, -3), half_life])));
        }
        Some((factor, _)) if factor > 0.0 => {
            let span = description.card("TIMP").unwrap_or_default();
            out.warn("deck 14, TIMP, columns 41-50", span, "no half life: the stress of an impact is gone at once")
        }
        _ => {}
    }
    if let Some(stop) = description.lower_stop {
        text.push_str(&format!(" -LOW_STOP {}", number(out.scale.length(stop))));
    }
    text
}

fn of_installed(description: &TetherCards, out: &mut Script) -> String {
    let mut text = String::new();
    for (keyword, word) in OPTIONS {
        if let Some(span) = description.card(keyword) {
            out.word(word, format!("deck 14, {keyword}"), span);
        }
    }
    for (kind, _, span) in &description.constraints {
        out.word("-CONSTRAINT", format!("deck 14, {}", card(*kind)), *span);
    }
    let (at_anchor, at_vessel) = description.caps;
    if (at_anchor, at_vessel) != (0.0, 0.0) {
        text.push_str(&format!(" \\\n  -CAPS {}", numbers([at_anchor, at_vessel].map(|area| out.scale.area(area)))));
    }
    let (pressure, density) = description.fluid;
    if (pressure, density) != (0.0, 0.0) {
        let values = [out.scale.force(pressure, -2), out.scale.density(density)];
        text.push_str(&format!(" \\\n  -FLUID {}", numbers(values)));
    }
    text.push_str(&impact_and_stop(description, out));
    for (kind, gap, span) in &description.constraints {
        let node = constrained_node(description, *kind, *span, out);
        text.push_str(&format!(" \\\n  -CONSTRAINT {} {node}", hold(*kind)));
        if *kind == ConstraintKind::LateralVessel && *gap > 0.0 {
            text.push_str(&format!(" {}", number(out.scale.length(*gap))));
        }
    }
    if description.group > 1 {
        text.push_str(&format!(" -GROUP {}", description.group));
    }
    text
}

fn card(kind: ConstraintKind) -> &'static str {
    match kind {
        ConstraintKind::LateralFixed => "TLAC",
        ConstraintKind::RotationalFixed => "TROC",
        ConstraintKind::LateralVessel => "TLAV",
        ConstraintKind::RotationalVessel => "TROV",
    }
}

fn hold(kind: ConstraintKind) -> &'static str {
    match kind {
        ConstraintKind::LateralFixed => "LATERAL_FIXED",
        ConstraintKind::RotationalFixed => "ROTATIONAL_FIXED",
        ConstraintKind::LateralVessel => "LATERAL_VESSEL",
        ConstraintKind::RotationalVessel => "ROTATIONAL_VESSEL",
    }
}

/// The node that a constraint holds, 1 at the anchor. The cards name none [AQWA-TETHER A.14]: a card between two TELM cards is taken for the node
/// between them; else it is next to the end that its kind belongs to.
fn constrained_node(description: &TetherCards, kind: ConstraintKind, at: Span, out: &mut Script) -> usize {
    let count = description.elements.len();
    let before = description.elements.iter().filter(|element| element.span.start < at.start).count();
    let card = format!("deck 14, {}, columns 7-10", card(kind));
    let number = |node: usize| {
        let elements = &description.elements;
        let field = node.checked_sub(2).and_then(|index| elements.get(index)).map(|element| element.node2);
        field.map_or_else(String::new, |field| format!(" {}", field.value))
    };
    if (1..count).contains(&before) {
        let text = format!("assumed to hold node{} of the TELM card before it", number(before + 1));
        out.note(&card, at, &text);
        return before + 1;
    }
    let (node, end) = match kind {
        ConstraintKind::LateralFixed | ConstraintKind::RotationalFixed => (2, "anchor"),
        ConstraintKind::LateralVessel | ConstraintKind::RotationalVessel => (count.max(1), "vessel"),
    };
    let node = node.min(count + 1);
    let text = format!("the card names no node: assumed to hold node{} next to the {end}", number(node));
    out.note(&card, at, &text);
    node
}
