//! What a deck runs and prints: decks 0, 14, 16, 17 and 18.

use super::diffraction;
use super::environment::{current_span, spectrum};
use super::lines;
use super::model::{body, point};
use super::record_writer::{Script, number, numbers, opposite, round_value};
use super::tethers::name;
use crate::Deck;
use crate::elements::ElementShape;
use crate::job::Program;
use crate::lines::LineKind;
use crate::printing::{PrintedNode, omitted_rows};
use crate::tethers::{Fatigue, Tether};
use crate::waves::WaveDeck;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// Hours for which the peak stress is expected when TPSH is not given [AQWA-TETHER A.5].
const DEFAULT_PEAK_HOURS: f64 = 3.0;

/// The title, and what is listed of the tethers before they move.
pub(super) fn tethers(deck: &Deck, out: &mut Script) {
    // a title may hold what the language would read
    let plain = |c: char| if c.is_ascii_alphanumeric() || "-.()/+=".contains(c) { c } else { ' ' };
    let title: String = deck.job.title.chars().map(plain).collect();
    if !title.trim().is_empty() {
        out.record(format!("&TITLE {}", title.split_whitespace().collect::<Vec<_>>().join(" ")));
    }
    if !deck.mooring.tethers.is_empty() {
        if let Some(first) = deck.mooring.tethers.first() {
            out.card("deck 14, TETH", first.span);
        }
        out.record("&STATUS TETHERS");
        if let Some(modes) = deck.mooring.modes.filter(|modes| modes.value > 0) {
            out.card("deck 14, TEIG", modes.span);
            out.record(format!("&STATUS TETHER_MODES -NUMBER {} -AQWA", modes.value));
        }
    }
}

/// The records that run a deck.
pub(super) fn motion(deck: &Deck, out: &mut Script) {
    out.card("deck 0, JOB", deck.job.span);
    if !deck.job.runs() {
        let (_, finish) = deck.job.stages;
        let data = deck.job.options.iter().find(|(name, _)| name == "DATA");
        let (card, span, text) = match data {
            Some((_, span)) => ("deck 0, OPTIONS, DATA", *span, "the data are checked and listed; nothing is run"),
            None if finish < 4 => (
                "deck 0, RESTART",
                deck.job.span,
                "the stages end before the analysis: the model is made, and nothing is run",
            ),
            None => ("deck 0, RESTART", deck.job.span, "the stages end before the motion: nothing is run"),
        };
        out.note(card, span, text);
        return;
    }
    if deck.job.program != Program::Line {
        wave_loads(deck, out);
        cards_without_effect(deck, out);
        current_loads(deck, out);
    }
    match deck.job.program {
        Program::Drift | Program::Naut => {
            lines::breaks(deck, out);
            out.card("deck 16, TIME", deck.steps.map_or(deck.job.span, |steps| steps.span));
        }
        Program::Librium | Program::Fer => {
            lines::broken_at_start(deck, out);
            say_what_is_of_runs(deck, out);
            out.card("deck 0, JOB", deck.job.span);
        }
        Program::Line => diffraction::refuse_without_panels(deck, out),
    }
    match (deck.job.program, deck.mooring.tethers.is_empty()) {
        (Program::Drift | Program::Naut, false) => write_tether_run(deck, out),
        (Program::Drift | Program::Naut, true) => bodies(deck, out),
        (Program::Librium, true) => {
            out.record("&EQUI");
            out.record("&STATUS CONFIGURATION");
            if !deck.mooring.lines.is_empty() {
                out.record("&STATUS F_CONNECTOR");
            }
        }
        (Program::Librium, false) => out.refuse(
            Diagnostic::error("deck 0: tethers are run in time, with DRIF or NAUT", deck.job.span)
                .label("LIBR is the equilibrium")
                .help("INMODEL -AQWA reads the model; &EQUI then takes installed tethers as bars"),
        ),
        (Program::Fer, true) => frequency_domain(deck, out),
        (Program::Fer, false) => out.refuse(
            Diagnostic::error("deck 0: tethers are run in time, with DRIF or NAUT", deck.job.span)
                .label("FER is the frequency domain"),
        ),
        (Program::Line, _) => diffraction::results(deck, out),
    }
}

/// Whether the deck runs in time.
fn is_timed(deck: &Deck) -> bool {
    matches!(deck.job.program, Program::Drift | Program::Naut)
}

/// The last time of a run (s).
fn end_of_run(deck: &Deck) -> Option<f64> {
    deck.steps.filter(|_| is_timed(deck)).map(|steps| round_value(steps.end()))
}

/// Says which cards are read and change nothing in what this deck runs.
fn cards_without_effect(deck: &Deck, out: &mut Script) {
    let towed = deck.mooring.tethers.iter().any(Tether::is_towed);
    if let (Some(sea), false) = (spectrum(deck), towed)
        && sea.towing.is_some_and(|(speed, _)| speed != 0.0)
    {
        let text = "a towing speed is of towed tethers, and this deck has none; it has no effect here";
        out.warn("deck 13, TOWS", sea.span, text);
    }
    if let (Some(given), false) = (deck.multipliers.iter().find(|given| given.slam > 0.0), towed) {
        let text = "slam is of towed tethers; it has no effect here";
        out.warn("deck 17, SLMM, columns 21-30", given.structure.span, text);
    }
    let program = match deck.job.program {
        Program::Fer => "FER works in the frequency domain",
        _ => "LIBR finds an equilibrium",
    };
    if let Some(steps) = deck.steps.filter(|_| !is_timed(deck)) {
        out.note("deck 16, TIME", steps.span, &format!("{program} and has no time steps: the card has no effect"));
    }
    if let Some(end) = end_of_run(deck) {
        for broken in deck.mooring.breaks.iter().filter(|broken| broken.time.value > end) {
            let text =
                format!("{} s come after the end of the run at {end} s: the line does not break", broken.time.value);
            out.warn("deck 14, LBRK, columns 31-40", broken.time.span, &text);
        }
        for line in &deck.mooring.lines {
            if let LineKind::Winched { begins, .. } = line.kind
                && begins >= end
            {
                let text = format!("its drum begins to turn at {begins} s (DWT0), and the run ends at {end} s");
                out.warn("deck 14, LNDW", line.span, &text);
            }
        }
    }
}

/// A run in waves needs loads of the waves on each structure: those of its tubes, as the coefficients of decks 6 to 8 are not read.
fn wave_loads(deck: &Deck, out: &mut Script) {
    // FER without a spectrum finds the motions in unit waves
    let waves = match &deck.waves {
        WaveDeck::Still => deck.job.program == Program::Fer,
        WaveDeck::Regular(wave) => wave.amplitude > 0.0,
        WaveDeck::Spectra(_) => true,
    };
    // the vessel of a towed tether is a nominal one and is held
    if deck.mooring.tethers.iter().any(Tether::is_towed) {
        return;
    }
    for structure in &deck.structures {
        let has_tubes = structure.elements.iter().any(|element| element.shape == ElementShape::Tube);
        if has_tubes || deck.database(structure).is_some() || diffraction::is_computed(deck, structure) {
            continue;
        }
        let number = structure.number;
        if waves {
            let message = format!("decks 6 to 8: structure {number} has no wave coefficients, and no tubes");
            let error = Diagnostic::error(message, structure.span)
                .label("no load of the waves would act on it")
                .help("FILE NAME.AH1 in deck 6 or 7 gives them; or INMODEL -AQWA takes the model of the deck, and DATABASE of the model its coefficients");
            out.refuse(match deck.job.program {
                Program::Fer => error.help("LIBR finds the equilibrium without them"),
                _ => error.help("still water is NONE in the place of deck 13"),
            });
        } else if is_timed(deck)
            && moves(deck, number)
            && deck.hydrostatics_of(number).is_none_or(|h| h.added_mass.is_none())
        {
            let text = format!(
                "structure {number} has no added mass and no radiation damping: decks 6 to 8 give none, and it has no tubes; it moves with its own mass alone"
            );
            out.warn(&format!("deck 2, ELM{number}"), structure.span, &text);
        }
    }
}

/// Whether a structure has a degree of freedom that deck 12 does not hold.
fn moves(deck: &Deck, structure: i64) -> bool {
    let holds = |dof: i64| deck.held.iter().any(|held| held.structure.value == structure && held.dof.value == dof);
    !(1..=6).all(holds)
}

/// A current meets a structure by its tubes, or by coefficients of its hull, which no deck gives here: names each structure on which it does not act.
fn current_loads(deck: &Deck, out: &mut Script) {
    let Some((card, span)) = current_span(deck) else { return };
    for structure in &deck.structures {
        let has_tubes = structure.elements.iter().any(|element| element.shape == ElementShape::Tube);
        let is_nominal = deck.mooring.tethers.iter().any(Tether::is_towed);
        if has_tubes || is_nominal {
            continue;
        }
        let text = format!(
            "no load of the current acts on structure {}: it has no tubes, and the hull coefficients of deck 10 (CUFX) are not read; \
             INMODEL -AQWA reads the model of the deck, and #TABLE gives it coefficients",
            structure.number
        );
        out.warn(card, span, &text);
    }
}

/// Says which cards of deck 18 are of runs in time, in a job that makes none.
fn say_what_is_of_runs(deck: &Deck, out: &mut Script) {
    let printing = &deck.printing;
    let steps = [
        ("PREV", printing.structures),
        ("TPRV", printing.tethers),
        ("TGRV", printing.records),
        ("TSTS", printing.first),
        ("TSTF", printing.last),
    ];
    for (keyword, field) in steps {
        if let Some(field) = field {
            out.note(&format!("deck 18, {keyword}, columns 11-15"), field.span, "is of runs in time, DRIF and NAUT");
        }
    }
    for node in &printing.nodes {
        let text = "the node is printed where it starts; its motion is of runs in time, DRIF and NAUT";
        out.note("deck 18, NODE, columns 16-20", node.node.span, text);
    }
    say_parameters_without_rows(deck, out);
}

/// Says that rows of forces are turned on and off on pages of structures with tethers alone.
fn say_parameters_without_rows(deck: &Deck, out: &mut Script) {
    for switch in &deck.printing.switches {
        let keyword = if switch.on { "PRNT" } else { "NOPR" };
        let text = format!(
            "parameter {} is a row of the pages of structures with tethers; the tables of this job have none of these rows",
            switch.parameter.value
        );
        out.note(&format!("deck 18, {keyword}, columns 16-20"), switch.parameter.span, &text);
    }
}

/// A run without tethers: bodies and lines as the model has them, printed as deck 18 asks.
fn bodies(deck: &Deck, out: &mut Script) {
    let printing = &deck.printing;
    let of_tethers =
        [("TPRV", printing.tethers), ("TGRV", printing.records), ("TSTS", printing.first), ("TSTF", printing.last)];
    for (keyword, field) in of_tethers {
        if let Some(field) = field {
            out.note(&format!("deck 18, {keyword}, columns 11-15"), field.span, "is of tethers, and the deck has none");
        }
    }
    say_parameters_without_rows(deck, out);
    if !printing.nodes.is_empty() {
        out.record("MEDIT");
        for printed in &printing.nodes {
            out.card("deck 18, NODE", printed.structure.span);
            out.record(format!("&DESCRIBE INTEREST {}", point(printed.structure.value, printed.node.value)));
        }
        out.record("END");
        out.card("deck 16, TIME", deck.steps.map_or(deck.job.span, |steps| steps.span));
    }
    out.record("TDOM");
    out.card("deck 0, JOB", deck.job.span);
    out.record("PRCPOST");
    let every = every(printing.structures).map_or(String::new(), |steps| format!(" {}", events(deck, steps)));
    let report = |text: String, out: &mut Script| {
        out.record(text + &every);
        out.record("REPORT");
        out.record("END");
    };
    for structure in &deck.structures {
        report(format!("TRAJECTORY {}", body(structure.number)), out);
    }
    for printed in &printing.nodes {
        say_fixed_reference(printed, out);
        out.card("deck 18, NODE", printed.structure.span);
        report(format!("POINTS {}", point(printed.structure.value, printed.node.value)), out);
    }
    for (index, line) in deck.mooring.lines.iter().enumerate() {
        let on =
            |number: i64| number == 0 || [line.ends.structure1.value, line.ends.structure2.value].contains(&number);
        if let Some(asked) = printing.tensions.iter().find(|field| on(field.value)) {
            out.card("deck 18, PTEN", asked.span);
            report(format!("CONFORCE L{}", index + 1), out);
        }
    }
    out.record("END");
}

/// Says that the place of a node is one in the fixed reference axes, where it is asked for relative to another node.
fn say_fixed_reference(printed: &PrintedNode, out: &mut Script) {
    if printed.reference.0.value > 0 || printed.reference.1.value > 0 {
        let text = "places are printed in the fixed reference axes, and not relative to this";
        out.warn("deck 18, NODE, columns 21-30", printed.reference.0.span, text);
    }
}

/// Motions and tensions in the sea of the deck, without a sea in unit waves: about the places of deck 15, which are those of an equilibrium, or about the
/// equilibrium where a structure has no place there.
fn frequency_domain(deck: &Deck, out: &mut Script) {
    if let WaveDeck::Regular(_) = deck.waves {
        out.refuse(
            Diagnostic::error("deck 13: a regular wave is for NAUT, this JOB is for FER", deck.job.span)
                .help("SPEC is the deck of a spectrum; NONE gives the motions in unit waves"),
        );
        return;
    }
    for held in deck.held.iter().filter(|held| held.card == "DACF") {
        let text = "the degree of freedom is held here; the card has no effect in AQWA-FER [AQWA-REF DACF]";
        out.note("deck 12, DACF, columns 16-20", held.dof.span, text);
    }
    let sea = matches!(deck.waves, WaveDeck::Spectra(_));
    let placed = |number: i64| deck.starts.iter().any(|start| start.structure == number && !start.velocity);
    match deck.structures.iter().find(|structure| !placed(structure.number)) {
        Some(structure) => {
            let text = format!("deck 15 has no POS{}: the equilibrium is found first, as with LIBR", structure.number);
            out.note(&format!("deck 2, ELM{}", structure.number), structure.span, &text);
            out.record("&EQUI");
        }
        None => {
            for start in deck.starts.iter().filter(|start| !start.velocity) {
                let text = "the place is taken for that of the equilibrium, about which FER works; without the card it is found";
                out.note(&format!("deck 15, POS{}", start.structure), start.span, text);
            }
        }
    }
    out.record("FREQ_RESPONSE");
    out.record(if sea { "SRESPONSE" } else { "RAO" });
    let (prefix, tensions) = if sea { ("STATISTICS ", "STATISTICS TENSION") } else { ("", "CONFORCE") };
    for structure in &deck.structures {
        out.record(format!("{prefix}MOTION {}", body(structure.number)));
        out.record("REPORT");
        out.record("END");
    }
    for number in (1..=deck.mooring.lines.len()).filter(|number| !lines::is_broken_at_start(deck, *number)) {
        out.record(format!("{tensions} L{number}"));
        out.record("REPORT");
        out.record("END");
    }
    out.record("END");
}

/// Steps between printed or kept instants, as given; 1 for a card with nothing on it.
fn every(field: Option<crate::card::Field<i64>>) -> Option<i64> {
    field.map(|field| field.value.max(1))
}

fn common_divisor(a: i64, b: i64) -> i64 {
    if b == 0 { a } else { common_divisor(b, a % b) }
}

/// Times of a page at each so many steps, from the start to the end.
fn events(deck: &Deck, steps: i64) -> String {
    let Some(run) = deck.steps else { return String::new() };
    format!("-EVENTS {}", numbers([run.start, round_value(run.end()), round_value(steps as f64 * run.step.value)]))
}

fn write_tether_run(deck: &Deck, out: &mut Script) {
    let towed = deck.mooring.tethers.iter().any(Tether::is_towed);
    let printing = &deck.printing;
    let slack = deck.mooring.slack_time.filter(|_| !towed && printing.tethers.is_none());
    // a tether may go slack, and its structure comes to a state, at any step
    let finest = if towed { every(printing.records).unwrap_or(1) } else { 1 };
    let store =
        [every(printing.structures), every(printing.tethers)].into_iter().flatten().fold(finest, common_divisor);
    let mut run = format!("TDOM -TETHERS AQWA -STORE {}", store.max(1));
    let slam = deck.mooring.tethers.first().map_or(0.0, |tether| deck.multipliers(tether.structure.value).slam);
    if towed && slam > 0.0 {
        run.push_str(&format!(" -SLAM {}", number(slam)));
    }
    if let Some((speed, toward)) = spectrum(deck).and_then(|s| s.towing).filter(|(speed, _)| towed && *speed != 0.0) {
        let toward = if speed < 0.0 { opposite(toward) } else { toward };
        run.push_str(&format!(" -TOW {}", numbers([out.scale.length(speed.abs()), toward])));
    }
    out.record(run);
    if printing.span == Span::default() {
        out.card("deck 0, JOB", deck.job.span);
    } else {
        out.card("deck 18", printing.span);
    }
    out.record("PRCPOST");
    structure(deck, towed, out);
    let asked = |tether: &Tether| {
        printing.tensions.iter().any(|field| field.value == 0 || field.value == tether.structure.value)
    };
    let silent = !deck.mooring.tethers.iter().any(asked);
    if let (true, Some(other)) = (silent, printing.tensions.first()) {
        let text = "no tether is on this structure: nothing is printed of the tethers over time";
        out.warn("deck 18, PTEN, columns 11-15", other.span, text);
    }
    for (index, tether) in deck.mooring.tethers.iter().enumerate() {
        if asked(tether) {
            pages(deck, &name(index), slack.map(|time| time.value), out);
        }
        if deck.job.program == Program::Drift {
            statistics(deck, &name(index), tether, out);
        }
    }
    if !towed {
        out.record(format!("TETHER {} EVENTS", name(0)));
        harmonics(deck, out);
    }
    out.record("END");
}

/// Pages of the structure.
fn structure(deck: &Deck, towed: bool, out: &mut Script) {
    let printing = &deck.printing;
    if let Some(steps) = every(printing.structures) {
        let mut text = String::from("STRUCTURE PAGES");
        for printed in printing.nodes.iter().filter(|_| !towed) {
            text.push_str(&format!(" {}", point(printed.structure.value, printed.node.value)));
            say_fixed_reference(printed, out);
        }
        let number = deck.mooring.tethers.first().map_or(1, |tether| tether.structure.value);
        let omitted = omitted_rows(printing, number, deck.job.program);
        if !omitted.is_empty() {
            text.push_str(&format!(" -OMIT {}", omitted.join(" ")));
        }
        out.record(format!("{text} {}", events(deck, steps)));
    }
}

/// The harmonics of the motion of the structure in a regular wave: the last pages of the listing.
fn harmonics(deck: &Deck, out: &mut Script) {
    let WaveDeck::Regular(wave) = &deck.waves else { return };
    if deck.job.program != Program::Naut || wave.amplitude == 0.0 {
        return;
    }
    let lasts = deck.steps.map_or(0.0, |steps| steps.end() - steps.start);
    if lasts < wave.period {
        let span = deck.steps.map_or(deck.job.span, |steps| steps.span);
        let text = format!(
            "the run lasts {lasts} s, less than the cycle of the wave of {} s: no harmonics of the structure are printed",
            number(wave.period)
        );
        out.note("deck 16, TIME, columns 16-30", span, &text);
    } else {
        out.record("STRUCTURE HARMONICS");
    }
}

/// Pages of a tether: at an interval, or after it went slack.
fn pages(deck: &Deck, name: &str, slack: Option<f64>, out: &mut Script) {
    let when = match (every(deck.printing.tethers), slack) {
        (Some(steps), _) => events(deck, steps),
        (None, Some(time)) => format!("-SLACK {}", number(time.max(0.0))),
        // neither card: each state that is printed of the structure, else each one kept
        (None, None) => events(deck, every(deck.printing.structures).unwrap_or(1)),
    };
    out.record(format!("TETHER {name} MOTIONS {when}"));
    out.record(format!("TETHER {name} FORCES {when}"));
}

/// Statistics between TSTS and TSTF, and of towed tethers stress ranges and fatigue.
fn statistics(deck: &Deck, name: &str, tether: &Tether, out: &mut Script) {
    let (first, last) = deck.statistics();
    let between = format!("-STEPS {first} {last} {}", every(deck.printing.records).unwrap_or(1));
    out.record(format!("TETHER {name} STATISTICS 1 {between}"));
    out.record(format!("TETHER {name} STATISTICS 2 {between}"));
    if !tether.is_towed() {
        return;
    }
    let Fatigue { concentration, intercept, slope } = tether.description.fatigue;
    let curve = format!("-SN {}", numbers([concentration, scale_intercept(intercept, slope, out), slope]));
    let hours = number(tether.description.peak_hours.unwrap_or(DEFAULT_PEAK_HOURS));
    out.record(format!("TETHER {name} RANGES {between} {curve}"));
    out.record(format!("TETHER {name} FATIGUE {between} {curve} -HOURS {hours}"));
}

/// The intercept of `N = A / R^m` for stresses in kN/m2.
fn scale_intercept(intercept: f64, slope: f64, out: &Script) -> f64 {
    let unit = out.scale.pascals(1.0) / 1000.0;
    if unit == 1.0 { intercept } else { round_value(intercept * unit.powf(slope)) }
}
