//! Mooring lines of deck 14 as classes of the model.

use super::model::point;
use super::record_writer::{Script, difference, number, numbers, round_value};
use crate::Deck;
use crate::job::Program;
use crate::lines::{
    Composite, CompositeJoint, CompositeSection, DYNAMIC_ELEMENTS, Ends, LineKind, MooringLine, Property, Pulley,
};
use windlass_base::diagnostic::Diagnostic;

/// Classes and connectors.
pub(super) fn lines(deck: &Deck, out: &mut Script) {
    // composites that are written, each with the depth of its anchor where that is not the depth of the water
    let mut written: Vec<(usize, Option<f64>)> = Vec::new();
    for (index, line) in deck.mooring.lines.iter().enumerate() {
        let number = index + 1;
        let [first, second] = match line.pulley {
            Some(_) => [
                (line.ends.structure1.value, line.ends.node1.value),
                (line.ends.structure2.value, line.ends.node2.value),
            ],
            None => ends(line.ends),
        };
        let anchor = anchor(deck, line, out);
        let class = match line.kind {
            LineKind::Elastic { stiffness, length } => match line.pulley {
                Some(pulley) => over_pulley(deck, number, (stiffness, length), pulley, out),
                None => elastic(number, stiffness, length, line, out),
            },
            LineKind::Property { property, tension, length, winding_in, paying_out, dynamic } => {
                match deck.mooring.properties.get(property) {
                    Some(Property::Composite(composite))
                        if [length, winding_in, paying_out] == [0.0; 3] && (tension == 0.0 || dynamic) =>
                    {
                        let depth = anchor.and_then(|(_, depth)| depth);
                        let variant = (property, depth);
                        let others = written.iter().filter(|(other, _)| *other == property).count();
                        let known = written.iter().position(|other| *other == variant);
                        let position =
                            known.map_or(others, |at| written.iter().take(at).filter(|w| w.0 == property).count());
                        let name = match position {
                            0 => format!("COMP{}", property + 1),
                            _ => format!("COMP{}_{}", property + 1, position + 1),
                        };
                        if known.is_none() {
                            written.push(variant);
                            catenary(&name, composite, depth, out);
                        }
                        Some(name)
                    }
                    Some(Property::Composite(_)) => refuse_class(
                        &format!("{} of a COMP with columns 31-70", card(&line.kind)),
                        "those columns are the winch and the length of a POLY line; -PISTON of B_CAT is a tensioner of a catenary",
                        line,
                        out,
                    ),
                    Some(Property::Polynomial(_)) if tension > 0.0 => {
                        winch(number, tension, length, [winding_in, paying_out], line, out)
                    }
                    Some(_) if tension > 0.0 || winding_in != 0.0 || paying_out != 0.0 => refuse_class(
                        "NLIN with friction or a tension and no POLY winch",
                        "a winch has a tension in columns 31-40 and goes with POLY",
                        line,
                        out,
                    ),
                    Some(Property::Polynomial(powers)) => {
                        let mut power = 0;
                        let coefficients = powers.map(|p| {
                            power += 1;
                            out.scale.newtons_per(p, power)
                        });
                        nonlinear(number, length, &format!("-POLY {}", numbers(coefficients)), line, out)
                    }
                    Some(Property::SteelWire { stiffness, offset }) => {
                        let law = [out.scale.newtons_per(*stiffness, 1), out.scale.length(*offset)];
                        nonlinear(number, length, &format!("-SWIRE {}", numbers(law)), line, out)
                    }
                    None => None,
                }
            }
            LineKind::Winched { .. } => drum(number, line, out),
            LineKind::Force(force) => constant_tension(number, force, line, out),
            LineKind::Winch { tension, length, winding_in, paying_out } => {
                winch(number, tension, length, [winding_in, paying_out], line, out)
            }
        };
        let Some(class) = class else { continue };
        let fairlead = point(first.0, first.1);
        let other = match anchor {
            Some((position, _)) if deck.mooring.composite(line).is_some() => format!("-ANCHOR {}", numbers(position)),
            _ => point(second.0, second.1),
        };
        out.card(format!("deck 14, {}", card(&line.kind)), line.span);
        out.record(format!("CONNECTOR L{number} ~{class} {fairlead} {other}"));
        pretension(deck, number, line, out);
    }
    dynamics(deck, out);
}

/// The length of the section at the fairlead, where a composite asks for the one that gives the pretension of its line.
fn pretension(deck: &Deck, number_of: usize, line: &MooringLine, out: &mut Script) {
    let (Some(composite), LineKind::Property { tension, dynamic, .. }) = (deck.mooring.composite(line), line.kind)
    else {
        return;
    };
    let Some((top, below)) = composite.sections.split_last() else { return };
    let lower = below.iter().find_map(|section| section.found_length);
    let mut refuse = |message: &str, span, help: &str| out.refuse(Diagnostic::error(message, span).help(help));
    match (lower, top.found_length) {
        (Some(span), _) => refuse(
            "deck 14, ECAT, columns 26-30: the length of a section below the fairlead is not found for a pretension",
            span,
            "the flag of the last ECAT has the length of the section at the fairlead found; else give the length and 0 here",
        ),
        (None, None) if tension > 0.0 => refuse(
            "deck 14, NLID, columns 31-40: no section of the composite has its length found for this pretension",
            line.span,
            "1 in columns 26-30 of the last ECAT has it found; without a pretension leave columns 31-40 blank",
        ),
        (None, None) => {}
        (None, Some(span)) if !dynamic || tension <= 0.0 => refuse(
            "deck 14, ECAT, columns 26-30: a length is to be found for a pretension, and the line has none",
            span,
            "the pretension is in columns 31-40 of NLID; with the length of columns 71-80 leave the flag blank",
        ),
        (None, Some(span)) => {
            let text = "assumed: any number here has the length of the section at the fairlead found, which gives the tension of NLID at the fairlead where deck 15 puts the structure";
            out.note("deck 14, ECAT, columns 26-30", span, text);
            out.card("deck 14, NLID", line.span);
            let force = number(out.scale.force(tension, 0));
            out.record(format!("&CONNECTOR L{number_of} -L_TENSION {force}"));
        }
    }
}

/// Cable dynamics of the NLID lines.
fn dynamics(deck: &Deck, out: &mut Script) {
    if let Some(span) = deck.mooring.dynamics_off {
        out.card("deck 14, DOFF", span);
        out.remark("DOFF: the NLID lines are quasi-static");
        return;
    }
    for (index, line) in deck.mooring.lines.iter().enumerate() {
        let LineKind::Property { dynamic: true, .. } = line.kind else { continue };
        if deck.mooring.composite(line).is_none() {
            out.refuse(
                Diagnostic::error("deck 14, NLID: cable dynamics is of composite catenaries", line.span)
                    .help("NLIN is the card of a POLY or SWIR line"),
            );
            continue;
        }
        out.card("deck 14, NLID", line.span);
        let elements = deck.mooring.elements.map_or(i64::from(DYNAMIC_ELEMENTS), |given| given.value);
        if let Some(given) = deck.mooring.elements {
            out.word("-DYNAMICS", "deck 14, NCEL", given.span);
        }
        out.record(format!("&CONNECTOR L{} -DYNAMICS {elements}", index + 1));
    }
}

/// Whether a line (from 1) is broken from the start: of LIBR and FER, in the spectrum that is run.
pub(super) fn is_broken_at_start(deck: &Deck, line: usize) -> bool {
    matches!(deck.job.program, Program::Librium | Program::Fer)
        && deck.mooring.breaks.iter().any(|broken| usize::try_from(broken.line.value) == Ok(line))
}

/// Takes the lines out that are broken in the spectrum of a LIBR or FER job [AQWA-REF LBRK].
pub(super) fn broken_at_start(deck: &Deck, out: &mut Script) {
    for broken in &deck.mooring.breaks {
        if let Some(other) = [broken.time, broken.tensions[0], broken.tensions[1]].iter().find(|field| field.given) {
            let text = "times and tensions are of DRIF and NAUT: the line is broken from the start";
            out.note("deck 14, LBRK, columns 31-60", other.span, text);
        }
        out.card("deck 14, LBRK", broken.span);
        out.record(format!("&CONNECTOR L{} -INACTIVE", broken.line.value));
    }
}

/// The actions of lines that break during a run.
pub(super) fn breaks(deck: &Deck, out: &mut Script) {
    for (index, broken) in deck.mooring.breaks.iter().enumerate() {
        if broken.spectrum.given {
            let text = "a spectrum is of LIBR and FER: the line breaks by its time and tensions alone";
            out.note("deck 14, LBRK, columns 11-15", broken.spectrum.span, text);
        }
        let found = usize::try_from(broken.line.value - 1).ok().and_then(|at| deck.mooring.lines.get(at));
        let Some(line) = found else { continue };
        let name = format!("L{}", broken.line.value);
        let [first, second] = broken.tensions.map(|field| field.value);
        // a straight weightless line has one tension
        let tension = match (first > 0.0, second > 0.0) {
            (false, false) => None,
            (true, false) => Some(first),
            (both, true) if deck.mooring.composite(line).is_none() => {
                Some(if both { first.min(second) } else { second })
            }
            _ => {
                out.refuse(
                    Diagnostic::error(
                        "deck 14, LBRK, columns 51-60: the tension at the second end of a catenary is not watched",
                        broken.tensions[1].span,
                    )
                    .help("give the breaking tension at the first structure, columns 41-50"),
                );
                continue;
            }
        };
        // the first end of the connector is the one on a structure
        if tension.is_some() && deck.mooring.composite(line).is_some() && line.ends.structure1.value <= 0 {
            out.refuse(
                Diagnostic::error(
                    "deck 14, LBRK, columns 41-50: the tension at the anchor of a catenary is not watched",
                    broken.tensions[0].span,
                )
                .help("give the structure first on the card of the line"),
            );
            continue;
        }
        out.card("deck 14, LBRK", broken.span);
        let time = broken.time.value;
        match tension {
            None => out.record(format!("&ACTION LBRK{} -AT {} -RELEASE {name}", index + 1, number(time))),
            Some(tension) => {
                let after = if time > 0.0 { format!(" -AFTER {}", number(time)) } else { String::new() };
                let force = number(out.scale.force(tension, 0));
                out.record(format!("&ACTION LBRK{} -TENSION {name} {force}{after} -RELEASE {name}", index + 1));
            }
        }
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

/// A linear elastic line: the first of the coefficients of a polynomial alone.
fn elastic(number_of: usize, stiffness: f64, length: f64, line: &MooringLine, out: &mut Script) -> Option<String> {
    let law = format!("-POLY {}", number(out.scale.newtons_per(stiffness, 1)));
    nonlinear(number_of, length, &law, line, out)
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

/// An elastic line over a pulley, whose far end is on the structure of the pulley.
fn over_pulley(
    deck: &Deck,
    number_of: usize,
    (stiffness, length): (f64, f64),
    pulley: Pulley,
    out: &mut Script,
) -> Option<String> {
    let position = |node: i64| deck.nodes.get(&node).map(|node| node.position);
    let (from, to) = (position(pulley.ends.node1.value)?, position(pulley.ends.node2.value)?);
    let behind = from.iter().zip(to).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let name = format!("L{number_of}");
    let [length, behind] = [length, behind].map(|x| out.scale.length(x));
    let mut text =
        format!("~{name} PULY {}", numbers([out.scale.newtons_per(stiffness, 1), length, round_value(behind)]));
    if pulley.ratio > 1.0 {
        text.push_str(&format!(" -RATIO {}", number(pulley.ratio)));
    }
    out.card("deck 14, PULY", pulley.span);
    out.record(text);
    Some(name)
}

/// A winch that keeps a tension, with friction winding in and paying out.
fn winch(
    number_of: usize,
    tension: f64,
    length: f64,
    friction: [f64; 2],
    line: &MooringLine,
    out: &mut Script,
) -> Option<String> {
    let name = format!("L{number_of}");
    let mut text = format!("~{name} CT_LINE {}", number(out.scale.force(tension, 0)));
    if length > 0.0 {
        text.push_str(&format!(" -LENGTH {}", number(out.scale.length(length))));
    }
    if friction != [0.0; 2] {
        text.push_str(&format!(" -FRICTION {}", numbers(friction)));
    }
    out.card(format!("deck 14, {}", card(&line.kind)), line.span);
    out.record(text);
    Some(name)
}

/// A straight line of a law of its extension.
fn nonlinear(number_of: usize, length: f64, law: &str, line: &MooringLine, out: &mut Script) -> Option<String> {
    let name = format!("L{number_of}");
    out.card(format!("deck 14, {}", card(&line.kind)), line.span);
    out.record(format!("~{name} NLIN {} {law}", number(out.scale.length(length))));
    Some(name)
}

/// A linear line on a drum.
fn drum(number_of: usize, line: &MooringLine, out: &mut Script) -> Option<String> {
    let LineKind::Winched { stiffness, start, end, speed, tension, begins, added } = line.kind else { return None };
    let name = format!("L{number_of}");
    let scale = out.scale;
    let [start, end, speed, added] = [start, end, speed, added].map(|x| scale.length(x));
    let mut text = format!("~{name} LNDW {}", numbers([scale.newtons_per(stiffness, 1), start, end, speed]));
    if tension > 0.0 {
        text.push_str(&format!(" {}", number(scale.newtons(tension))));
    }
    if begins > 0.0 {
        text.push_str(&format!(" -START {}", number(begins)));
    }
    if added > 0.0 {
        text.push_str(&format!(" -ADDED {}", number(added)));
    }
    out.card("deck 14, LNDW", line.span);
    out.record(text);
    Some(name)
}

/// A composite line: one record a section from the fairlead, in kg, m, N. `depth` (m) is that of the anchor, on which the line lies,
/// where it is not the depth of the water.
fn catenary(name: &str, composite: &Composite, depth: Option<f64>, out: &mut Script) {
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
    if composite.slope != 0.0 {
        depth.push_str(&format!(" -SLOPE {}", number(round_value(composite.slope.to_radians().tan()))));
    }
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
