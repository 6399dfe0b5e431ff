//! Mooring lines of deck 14 as classes of the model.

use super::model::point;
use super::written::{Script, difference, number, numbers, round_value};
use crate::Deck;
use crate::lines::{Composite, CompositeJoint, CompositeSection, Ends, LineKind, MooringLine, Property};
use std::f64::consts::FRAC_PI_4;
use windlass_base::diagnostic::Diagnostic;

/// Diameter (m) of an elastic line as the class has it: only EA of the section counts.
const NOMINAL_DIAMETER_M: f64 = 1.0;

/// Classes and connectors.
pub(super) fn lines(deck: &Deck, out: &mut Script) {
    // composites that are written, each with the depth of its anchor where that is not the depth of the water
    let mut written: Vec<(usize, Option<f64>)> = Vec::new();
    for (index, line) in deck.mooring.lines.iter().enumerate() {
        let number = index + 1;
        let [first, second] = ends(line.ends);
        let anchor = anchor(deck, line, out);
        let class = match line.kind {
            LineKind::Elastic { stiffness, length } => elastic(number, stiffness, length, line, out),
            LineKind::Property { property, tension, .. } => match deck.mooring.properties.get(property) {
                Some(Property::Composite(composite)) if tension == 0.0 => {
                    let depth = anchor.and_then(|(_, depth)| depth);
                    let variant = (property, depth);
                    let others = written.iter().filter(|(other, _)| *other == property).count();
                    let known = written.iter().position(|other| *other == variant);
                    let place = known.map_or(others, |at| written.iter().take(at).filter(|w| w.0 == property).count());
                    let name = match place {
                        0 => format!("COMP{}", property + 1),
                        _ => format!("COMP{}_{}", property + 1, place + 1),
                    };
                    if known.is_none() {
                        written.push(variant);
                        catenary(&name, composite, depth, out);
                    }
                    Some(name)
                }
                Some(Property::Composite(_)) => {
                    refuse_class("NLIN with a winch tension", "a CATENARY with a PISTON of the model", line, out)
                }
                _ => refuse_class("POLY", "a GSPR with a table of force over extension", line, out),
            },
            LineKind::Winched { .. } => refuse_class("LNDW", "an SL_ELEM, with &ACTION for the winch", line, out),
            LineKind::Force(force) => constant_tension(number, force, line, out),
            LineKind::Winch { .. } => refuse_class("WNCH", "an SL_ELEM with -PISTON, which keeps a tension", line, out),
        };
        let Some(class) = class else { continue };
        let fairlead = point(first.0, first.1);
        let other = match anchor {
            Some((place, _)) if !matches!(line.kind, LineKind::Elastic { .. } | LineKind::Force(_)) => {
                format!("-ANCHOR {}", numbers(place))
            }
            _ => point(second.0, second.1),
        };
        out.card(format!("deck 14, {}", card(&line.kind)), line.span);
        out.record(format!("CONNECTOR L{number} ~{class} {fairlead} {other}"));
    }
}

/// Keyword of the card of a line.
fn card(kind: &LineKind) -> &'static str {
    match kind {
        LineKind::Elastic { .. } => "LINE",
        LineKind::Winched { .. } => "LNDW",
        LineKind::Force(_) => "FORC",
        LineKind::Winch { .. } => "WNCH",
        LineKind::Property { dynamic: false, .. } => "NLIN",
        LineKind::Property { dynamic: true, .. } => "NLID",
    }
}

/// Direction (degrees) and distance (m) of the anchor of a line, and its depth (m) where that is not the depth of the water; none of
/// a line between two structures.
fn anchor(deck: &Deck, line: &MooringLine, out: &Script) -> Option<([f64; 2], Option<f64>)> {
    let [(structure, node), (ground, anchor)] = ends(line.ends);
    let structure = deck.structure(structure).filter(|_| ground <= 0)?;
    let from = deck.node_position(structure, node)?.map(|x| out.scale.length(x));
    let to = deck.nodes.get(&anchor)?.position.map(|x| out.scale.length(x));
    let [x, y] = [difference(to[0], from[0]), difference(to[1], from[1])];
    let direction = if x == 0.0 && y == 0.0 { 0.0 } else { round_value(y.atan2(x).to_degrees()) };
    let depth = difference(0.0, to[2]);
    let of_water = out.scale.length(deck.global.depth);
    Some(([direction, round_value(x.hypot(y))], (depth != of_water).then_some(depth)))
}

/// Structure and node of both ends, the one on a structure first: that is the fairlead.
fn ends(ends: Ends) -> [(i64, i64); 2] {
    let first = (ends.structure1.value, ends.node1.value);
    let second = (ends.structure2.value, ends.node2.value);
    if first.0 <= 0 && second.0 > 0 { [second, first] } else { [first, second] }
}

fn refuse_class(card: &str, class: &str, line: &MooringLine, out: &mut Script) -> Option<String> {
    out.refuse(
        Diagnostic::error(format!("deck 14, {card}: this line is not read into the model"), line.span)
            .help(format!("in a script of the model it is {class}")),
    );
    None
}

/// A linear elastic line: EA over its length is the stiffness.
fn elastic(number_of: usize, stiffness: f64, length: f64, line: &MooringLine, out: &mut Script) -> Option<String> {
    if length <= 0.0 {
        return refuse_class("LINE without a length", "a GSPR along X between the two points", line, out);
    }
    let name = format!("L{number_of}");
    let length = out.scale.length(length);
    // N/m times m over the area, in MPa
    let modulus =
        out.scale.force(stiffness, -1) * 1e3 * length / (FRAC_PI_4 * NOMINAL_DIAMETER_M * NOMINAL_DIAMETER_M) / 1e6;
    out.card("deck 14, LINE", line.span);
    out.record(format!(
        "~{name} SL_ELEM {} TENSION -LEN {} -EMODULUS {}",
        number(1000.0 * NOMINAL_DIAMETER_M),
        number(length),
        number(round_value(modulus))
    ));
    Some(name)
}

/// A constant force towards the second node, on each end towards the other.
fn constant_tension(number_of: usize, force: f64, line: &MooringLine, out: &mut Script) -> Option<String> {
    if force < 0.0 {
        return refuse_class("FORC with a negative force", "a #TABLE for a force on the body", line, out);
    }
    let name = format!("L{number_of}");
    out.card("deck 14, FORC", line.span);
    out.record(format!("~{name} CT_LINE {}", number(out.scale.force(force, 0))));
    Some(name)
}

/// A composite line: one record a section from the fairlead, in kg, m, N. `depth` (m) is that of the anchor, on which the line lies,
/// where it is not the depth of the water.
fn catenary(name: &str, composite: &Composite, depth: Option<f64>, out: &mut Script) {
    if composite.slope != 0.0 {
        out.refuse(
            Diagnostic::error("deck 14, COMP, columns 51-60: the sea bed of a CATENARY is level", composite.span)
                .help("B_CAT of the model has -SLOPE"),
        );
    }
    if let Some(joint) = composite.sections.last().and_then(|section| section.joint) {
        out.refuse(
            Diagnostic::error("deck 14: a joint at the fairlead belongs to the structure", joint.span)
                .label("the section before it is the last one")
                .help("add its mass to the PMAS of the structure"),
        );
    }
    // the joint of a section of the deck is at its upper end, which is the lower end of the next one
    let mut below: Vec<Option<CompositeJoint>> = vec![None];
    below.extend(composite.sections.iter().map(|section| section.joint));
    let rows: Vec<(&CompositeSection, Option<CompositeJoint>)> = composite.sections.iter().zip(below).collect();
    let mut depth = depth.map_or(String::new(), |depth| format!(" -DEPANCHOR {}", number(depth)));
    for (section, joint) in rows.into_iter().rev() {
        let text = record(name, section, joint, out) + &std::mem::take(&mut depth);
        out.card("deck 14, ECAT", section.span);
        if let Some(joint) = joint {
            let (word, card) = if joint.buoy { ("-BUOY", "deck 14, BUOY") } else { ("-CLUMP", "deck 14, CLMP") };
            out.word(word, card, joint.span);
        }
        out.record(text);
    }
}

fn record(name: &str, section: &CompositeSection, joint: Option<CompositeJoint>, out: &Script) -> String {
    let scale = out.scale;
    let mut text = format!(
        "~{name} CATENARY {} -LEN {} -EA {} -TMAX {}",
        numbers([scale.line_mass(section.mass), scale.area(section.area)]),
        number(scale.length(section.length)),
        number(scale.newtons(section.stiffness)),
        number(scale.newtons(section.tension))
    );
    if let Some(growth) = section.growth {
        text.push_str(&format!(" -K {}", numbers(growth.map(|k| scale.newtons(k)))));
    }
    if section.bending > 0.0 {
        text.push_str(&format!(" -EI {}", number(scale.force(section.bending, 2) * 1e3)));
    }
    if let Some(water) = section.resistance {
        text.push_str(&format!(" -CA {} -CD {}", number(water.added_mass), number(water.drag)));
        if water.diameter > 0.0 {
            text.push_str(&format!(" -DE {}", number(scale.length(water.diameter))));
        }
        text.push_str(&format!(" -CX {}", number(water.inline)));
    }
    if let Some(joint) = joint {
        let kind = if joint.buoy { "-BUOY" } else { "-CLUMP" };
        let masses = [joint.mass, joint.displaced, joint.added].map(|mass| scale.mass(mass));
        text.push_str(&format!(" {kind} {} {}", numbers(masses), number(scale.area(joint.drag))));
    }
    text
}
