//! Articulations of deck 12 and fenders of deck 14 as connectors of the model.

use super::model::point;
use super::record_writer::{Script, difference, number, numbers, round_value};
use crate::Deck;
use crate::articulations::{Articulation, JointSide};
use crate::fenders::{FenderCard, FenderSide};
use nalgebra::{Rotation3, Vector3};
use windlass_base::diagnostic::Diagnostic;

/// Farthest that the two nodes of a joint, or what is taken for an axis, may be from one place (m).
const JOINT_GAP_M: f64 = 1e-3;
/// Chords of the curve of a fender over its size: between the points at half the size a cube is off by 3E-4 of itself.
const FENDER_CHORDS: u32 = 100;

/// The axes of a structure at the start, global for the ground.
fn axes(deck: &Deck, structure: i64) -> Rotation3<f64> {
    deck.structure(structure).map_or_else(Rotation3::identity, |structure| {
        let [_, _, _, rx, ry, rz] = deck.start(structure).map(f64::to_radians);
        Rotation3::from_euler_angles(rx, ry, rz)
    })
}

/// Where a node of a structure, or of the ground, is at the start.
fn position(deck: &Deck, structure: i64, node: i64) -> Option<Vector3<f64>> {
    match deck.structure(structure) {
        Some(found) => deck.node_position(found, node).map(Vector3::from),
        None => deck.nodes.get(&node).map(|node| Vector3::from(node.position)),
    }
}

/// Unit vector between two nodes of a structure at the start, global axes.
fn direction(deck: &Deck, structure: i64, from: i64, to: i64) -> Option<Vector3<f64>> {
    let along = position(deck, structure, to)? - position(deck, structure, from)?;
    along.try_normalize(JOINT_GAP_M)
}

/// The joints.
pub(super) fn articulations(deck: &Deck, out: &mut Script) {
    for (index, joint) in deck.articulations.iter().enumerate() {
        articulation(deck, &format!("J{}", index + 1), joint, out);
    }
}

fn articulation(deck: &Deck, name: &str, joint: &Articulation, out: &mut Script) {
    // the structure first, then the ground
    let [first, second] = match joint.sides {
        [ground, structure] if ground.structure.value <= 0 => [structure, ground],
        sides => sides,
    };
    let at = |side: &JointSide| position(deck, side.structure.value, side.node.value);
    let (Some(one), Some(other)) = (at(&first), at(&second)) else { return };
    let gap = out.scale.length((other - one).norm());
    if gap > JOINT_GAP_M {
        out.refuse(
            Diagnostic::error(
                format!("deck 12, DCON: the two nodes are {} m apart at the start", number(round_value(gap))),
                joint.span,
            )
            .label("a joint is one point of both structures")
            .help("POS of deck 15 puts the structures together"),
        );
        return;
    }
    let axis = |side: &JointSide| direction(deck, side.structure.value, side.node.value, side.axis.value);
    let turned = axes(deck, first.structure.value);
    let missing = |out: &mut Script| {
        out.refuse(
            Diagnostic::error("deck 12, DCON: this joint has no axis", joint.span)
                .label("a second node on each side gives it, columns 26-30 and 46-50")
                .help("a hinge turns about the axis of both, a universal joint about the two axes, which differ"),
        );
    };
    let (held, along) = match joint.locked.value {
        0 => ("X Y Z", None),
        // the rotation about the normal of the two axes is locked
        1 => match (axis(&first), axis(&second)) {
            (Some(a), Some(b)) if a.cross(&b).norm() > 1e-3 => ("X Y Z RX", Some(a.cross(&b))),
            _ => return missing(out),
        },
        // free about the axis
        2 => match axis(&first).or_else(|| axis(&second)) {
            Some(axis) => ("X Y Z RY RZ", Some(axis)),
            None => return missing(out),
        },
        _ => ("X Y Z RX RY RZ", None),
    };
    let euler = along.map_or_else(String::new, |along| {
        let own = turned.inverse() * along;
        let pitch = -own.z.atan2(own.x.hypot(own.y));
        format!(
            "-EULER {} ",
            numbers([0.0, pitch, own.y.atan2(own.x)].map(|angle| difference(angle.to_degrees(), 0.0)))
        )
    });
    out.card("deck 12, DCON", joint.span);
    out.record(format!("~{name} FIX {held}"));
    let points = [first, second].map(|side| point(side.structure.value, side.node.value));
    out.record(format!("CONNECTOR {name} {euler}~{name} {}", points.join(" ")));
}

/// The fenders.
pub(super) fn fenders(deck: &Deck, out: &mut Script) {
    for (index, fender) in deck.mooring.fenders.iter().enumerate() {
        write_fender(deck, &format!("F{}", index + 1), fender, out);
    }
}

fn write_fender(deck: &Deck, name: &str, fender: &FenderCard, out: &mut Script) {
    let [base, face] = fender.sides;
    let at = |side: &FenderSide| position(deck, side.structure.value, side.node.value);
    let (Some(from), Some(to)) = (at(&base), at(&face)) else { return };
    let normal = |side: &FenderSide| direction(deck, side.structure.value, side.node.value, side.direction.value);
    let Some(normal) = normal(&face).or_else(|| normal(&base)) else {
        out.refuse(
            Diagnostic::error("deck 14, FLIN: this fender has no direction", fender.span)
                .label("a second node on the contact plane's normal gives it, columns 51-55"),
        );
        return;
    };
    // from the base toward the face
    let toward = if (to - from).dot(&normal) < 0.0 { -normal } else { normal };
    let own = axes(deck, base.structure.value).inverse() * toward;
    let properties = fender.properties;
    let [linear, others @ ..] = fender.reaction;
    let scale = out.scale;
    let size = properties.size.value;
    let mut text = format!("~{name} FENDER {}", number(scale.length(size)));
    // a polynomial of its first power alone is one chord
    let first = if others == [0.0; 4] { FENDER_CHORDS - 1 } else { 1 };
    for step in first..FENDER_CHORDS {
        let compression = size * f64::from(step) / f64::from(FENDER_CHORDS);
        let reaction = fender.reaction.iter().rev().fold(0.0, |sum, p| (sum + p) * compression);
        let pair = [scale.force(reaction, 0), scale.length(compression)].map(round_value);
        text.push_str(if step % 8 == 0 { " \\\n  " } else { " " });
        text.push_str(&numbers(pair));
    }
    let along: [f64; 3] = own.into();
    text.push_str(&format!(" \\\n  -NORMAL {}", numbers(along.map(|part| difference(part, 0.0)))));
    if properties.friction.value > 0.0 {
        text.push_str(&format!(" -FRICTION {}", number(properties.friction.value)));
    }
    if properties.damping.value > 0.0 {
        if others == [0.0; 4] {
            // the damping coefficient times the stiffness
            text.push_str(&format!(
                " -X_DAMPING {} 1",
                number(round_value(scale.force(linear, -1) * properties.damping.value))
            ));
        } else {
            out.refuse(
                Diagnostic::error(
                    "deck 14, FEND, columns 71-80: damping in proportion to a stiffness that changes is not modelled",
                    properties.damping.span,
                )
                .help("a POLY of its first coefficient alone is damped; -X_DAMPING of FENDER is a dashpot"),
            );
        }
    }
    out.card("deck 14, FLIN", fender.span);
    out.word("-FRICTION", "deck 14, FEND", properties.friction.span);
    out.record(text);
    let points = [base, face].map(|side| point(side.structure.value, side.node.value));
    out.record(format!("CONNECTOR {name} ~{name} {}", points.join(" ")));
}
