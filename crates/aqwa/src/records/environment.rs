//! The water, waves, current and wind: decks 5, 10, 11, 13 and 16.

use super::record_writer::{Script, difference, number, numbers, opposite, round_value};
use super::sea;
use crate::Deck;
use crate::surroundings::{CurrentLayer, UniformStream};
use crate::waves::{SpectrumCard, WaveDeck};
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;
use windlass_base::units::METRES_PER_SECOND_PER_KNOT;

/// Names of the curves of a current profile.
const PROFILE: [&str; 2] = ["CPRF_X", "CPRF_Y"];

/// The record of the environment, with the curves it names before it.
pub(super) fn environment(deck: &Deck, out: &mut Script) {
    let mut options = vec![format!("-DEPTH {}", number(out.scale.length(deck.global.depth)))];
    options.extend(sea::options(deck, out));
    options.extend(current(deck, out));
    options.extend(wind(deck, out));
    options.extend(time(deck, out));
    if let Some(span) = deck.global.depth_span {
        out.word("-DEPTH", "deck 5, DPTH", span);
    }
    let of_waves = match &deck.waves {
        WaveDeck::Spectra(list) => list.first().map(|sea| sea.span),
        WaveDeck::Regular(wave) => Some(wave.span),
        WaveDeck::Still => None,
    };
    if let Some(span) = of_waves {
        out.word("-SEA", "deck 13", span);
    }
    let streams = [("-CURRENT", current_span(deck)), ("-WIND", wind_of(deck).map(|(card, flow)| (card, flow.span)))];
    for (word, origin) in streams {
        if let Some((card, span)) = origin {
            out.word(word, card, span);
        }
    }
    if let Some(steps) = deck.steps {
        out.word("-TIME", "deck 16, TIME", steps.span);
    }
    out.record(format!("&ENV {}", options.join(" \\\n  ")));
}

/// The first spectrum, which is the one that is run.
pub(super) fn spectrum(deck: &Deck) -> Option<&SpectrumCard> {
    match &deck.waves {
        WaveDeck::Spectra(list) => list.first(),
        _ => None,
    }
}

/// Time steps, and the time of the first of them, the start.
fn time(deck: &Deck, out: &mut Script) -> Option<String> {
    let steps = deck.steps?;
    if steps.start < 0.0 {
        out.refuse(
            Diagnostic::error("deck 16, TIME, columns 31-40: the start is before 0 s", steps.span)
                .label(format!("this one is at {} s", steps.start))
                .help("0, also by leaving it blank, or a later time"),
        );
    }
    if steps.count.value < 2 {
        out.refuse(
            Diagnostic::error("deck 16, TIME, columns 16-20: one step is the start alone", steps.count.span)
                .label("2 steps at least"),
        );
        return None;
    }
    let observed = round_value((steps.count.value - 1) as f64 * steps.step.value);
    let start = if steps.start > 0.0 { format!(" -START {}", number(steps.start)) } else { String::new() };
    Some(format!("-TIME {}{start}", numbers([observed, steps.step.value])))
}

/// A stream as x and y of its velocity (m/s).
fn components(flow: &UniformStream, out: &Script) -> [f64; 2] {
    let (speed, angle) = (out.scale.length(flow.speed.value), flow.direction.value);
    [round_value(speed * cosine(angle)), round_value(speed * cosine(angle - 90.0))]
}

fn cosine(degrees: f64) -> f64 {
    windlass_language::number::cosine_of_degrees(degrees)
}

/// The card of the current: that of the profile, else of the uniform current in force.
pub(super) fn current_span(deck: &Deck) -> Option<(&'static str, Span)> {
    let flows = deck.surroundings.profile.iter().any(|layer| layer.speed != 0.0);
    let profile = deck.surroundings.profile.first().filter(|_| flows).map(|layer| ("deck 11, CPRF", layer.span));
    profile.or_else(|| uniform(deck).first().map(|(card, flow)| (*card, flow.span)))
}

/// The uniform currents that are given, with their cards; the first one is in force.
fn uniform(deck: &Deck) -> Vec<(&'static str, UniformStream)> {
    let own = match &deck.waves {
        WaveDeck::Spectra(list) => list.first().and_then(|s| s.current),
        WaveDeck::Regular(wave) => wave.current,
        WaveDeck::Still => None,
    };
    let of_hulls = deck.hydrostatics.iter().find_map(|h| h.current);
    [("deck 13, CURR", own), ("deck 11, CURR", deck.surroundings.current), ("deck 10, CURR", of_hulls)]
        .into_iter()
        .filter_map(|(card, flow)| Some((card, flow?)))
        .filter(|(_, flow)| flow.speed.value != 0.0)
        .collect()
}

/// The current of the deck: that of the spectrum or wave, else the uniform one, else that of deck 10; with the profile.
fn current(deck: &Deck, out: &mut Script) -> Option<String> {
    let given = uniform(deck);
    if let [(taken, _), others @ ..] = given.as_slice()
        && !others.is_empty()
    {
        let text = format!("no current is taken from here: that of {taken} is in force");
        for (card, flow) in others {
            out.warn(card, flow.span, &text);
        }
    }
    let uniform = given.first().map(|(_, flow)| *flow);
    if deck.surroundings.profile.is_empty() {
        let flow = uniform?;
        let speed = out.scale.length(flow.speed.value);
        let toward = if speed < 0.0 { flow.direction.value + 180.0 } else { flow.direction.value };
        return Some(format!("-CURRENT {}", numbers([speed.abs(), opposite(toward)])));
    }
    let added = uniform.map_or([0.0; 2], |flow| components(&flow, out));
    Some(profile(&deck.surroundings.profile, added, out))
}

/// A profile with a uniform current added, as curves along X and Y: the direction may turn with the depth.
fn profile(layers: &[CurrentLayer], added: [f64; 2], out: &mut Script) -> String {
    let mut rows: Vec<(f64, [f64; 2])> = Vec::new();
    for layer in layers.iter().rev() {
        let speed = out.scale.length(layer.speed);
        let own = [cosine(layer.direction), cosine(layer.direction - 90.0)];
        let velocity = [0, 1].map(|i| round_value(speed * own[i] + added[i]));
        rows.push((difference(0.0, out.scale.length(layer.height)), velocity));
    }
    if let [(_, [x, y])] = rows.as_slice() {
        // one layer is the same everywhere
        let (speed, toward) = (round_value(x.hypot(*y)), round_value(y.atan2(*x).to_degrees()));
        return format!("-CURRENT {}", numbers([speed, opposite(toward)]));
    }
    let mut options = String::from("-CURRENT");
    for (axis, (name, from)) in PROFILE.iter().zip([180.0, 270.0]).enumerate() {
        if rows.iter().all(|(_, velocity)| velocity[axis] == 0.0) {
            continue;
        }
        let pairs = numbers(rows.iter().flat_map(|(depth, velocity)| [*depth, velocity[axis]]));
        out.record(format!("&DATA CURVES C_PROFILE {name} {pairs}"));
        options.push_str(&format!(" {name} {}", number(from)));
    }
    if options == "-CURRENT" { "-CURRENT 0 0".into() } else { options }
}

/// The wind in force, with its card.
fn wind_of(deck: &Deck) -> Option<(&'static str, UniformStream)> {
    let own = match &deck.waves {
        WaveDeck::Spectra(list) => list.first().and_then(|s| s.wind),
        WaveDeck::Regular(wave) => wave.wind,
        WaveDeck::Still => None,
    };
    let own = own.map(|flow| ("deck 13, WIND", flow));
    let found = own.or(deck.surroundings.wind.map(|flow| ("deck 11, WIND", flow)));
    found.filter(|(_, flow)| flow.speed.value != 0.0)
}

fn wind(deck: &Deck, out: &mut Script) -> Option<String> {
    let (card, flow) = wind_of(deck)?;
    out.warn(card, flow.span, "the structures of a deck have no areas for the wind; #AREA of the model gives them");
    let speed = out.scale.length(flow.speed.value);
    let toward = if speed < 0.0 { flow.direction.value + 180.0 } else { flow.direction.value };
    Some(format!("-WIND {}", numbers([round_value(speed.abs() / METRES_PER_SECOND_PER_KNOT), opposite(toward)])))
}
