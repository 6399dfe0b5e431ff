//! A deck as records of the native language: what a script of the same case says.
//!
//! The session runs these records and nothing else, so that a deck and a script of the same case are the same thing. Numbers are
//! converted once, from the units of the deck to `&DIMEN -DIMEN METERS K-NTS` (tethers and catenaries: kg, m, N), and written with the
//! digits that read back as they are.

mod environment;
mod lines;
mod model;
mod run;
mod sea;
mod tethers;
mod written;

use super::Deck;
use windlass_base::diagnostic::Diagnostic;
use written::{Scale, Script, number};

/// The record that sets the units of the others.
pub const UNITS: &str = "&DIMEN -DIMEN METERS K-NTS";

/// A deck as records, one a line (a record may go on over lines).
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Records {
    /// Units, defaults, bodies with their places, connectors, the environment.
    pub model: Vec<String>,
    /// What is run, and what is told.
    pub job: Vec<String>,
}

impl Records {
    /// The whole as a script.
    pub fn script(&self) -> String {
        let lines = std::iter::once(UNITS).chain(self.model.iter().chain(&self.job).map(String::as_str));
        lines.map(|line| format!("{line}\n")).collect()
    }

    /// The model alone, after which the units are as before.
    pub fn model_alone(&self) -> String {
        let saved = UNITS.replacen("&DIMEN", "&DIMEN -SAVE", 1);
        let lines = std::iter::once(saved.as_str()).chain(self.model.iter().map(String::as_str));
        lines.chain(std::iter::once("&DIMEN -REMEMBER")).map(|line| format!("{line}\n")).collect()
    }
}

/// The records of a deck.
///
/// # Errors
/// Units that cannot be told; earlier stages that are not in the file; cards for which the model or its engines have no place: each
/// with the reason, and where there is one the native record to use.
pub fn records(deck: &Deck) -> Result<Records, Vec<Diagnostic>> {
    let mut out = written(deck)?;
    let model = std::mem::take(&mut out.lines);
    run::job(deck, &mut out);
    if out.wrong.is_empty() { Ok(Records { model, job: out.lines }) } else { Err(out.wrong) }
}

/// The records of the model of a deck, whatever program it is for.
///
/// # Errors
/// As [`records`], but for what is run.
pub fn model_records(deck: &Deck) -> Result<Records, Vec<Diagnostic>> {
    let out = written(deck)?;
    if out.wrong.is_empty() { Ok(Records { model: out.lines, job: Vec::new() }) } else { Err(out.wrong) }
}

/// The model as it could be written, with what is wrong with it.
fn written(deck: &Deck) -> Result<Script, Vec<Diagnostic>> {
    let (start, _) = deck.job.stages;
    if start > 1 {
        let error = Diagnostic::error("deck 0, RESTART: this file begins after stage 1", deck.job.span)
            .label(format!("decks before those of stage {start} are not in it"))
            .help("give all stages in one file, 1 to 5: what an earlier run kept in its database is not read");
        return Err(vec![*error]);
    }
    let units = deck.units().map_err(|error| vec![*error])?;
    let mut out = Script::new(Scale::of(&units));
    model(deck, &units, &mut out);
    Ok(out)
}

fn model(deck: &Deck, units: &super::units::Units, out: &mut Script) {
    out.remark(&format!("deck {} {}: {}", deck.job.run, deck.job.analysis, deck.job.title));
    out.remark(&format!(
        "its units are {}; all numbers below are in m, kN, kg/m3 and degrees, tethers in kg, m, N",
        units.name
    ));
    let density = number(out.scale.density(deck.global.density));
    let gravity = number(out.scale.length(deck.global.gravity));
    out.record(format!("&DEFAULT -WATER {density} -GRAVITY {gravity}"));
    environment::environment(deck, out);
    out.record("MEDIT");
    model::ground(deck, out);
    for structure in &deck.structures {
        model::structure(deck, structure, out);
    }
    model::starts(deck, out);
    tethers::tethers(deck, out);
    lines::lines(deck, out);
    out.record("END");
}
