//! A deck as records of the native language: what a script of the same case says.
//!
//! The session runs these records and nothing else, so that a deck and a script of the same case are the same thing. Numbers are
//! converted once, from the units of the deck to `&DIMEN -DIMEN METERS K-NTS` (tethers and catenaries: kg, m, N), and written with the
//! digits that read back as they are.

mod articulations;
mod diffraction;
mod environment;
mod lines;
mod model;
mod record_writer;
mod run;
mod sea;
mod tethers;

use super::Deck;
use record_writer::{RecordLine, Scale, Script, number};
use windlass_base::diagnostic::Diagnostic;

pub use record_writer::CardOrigin;

/// The record that sets the units of the others.
pub const UNITS: &str = "&DIMEN -DIMEN METERS K-NTS";

/// A deck as records, one a line (a record may go on over lines).
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Records {
    /// Units, defaults, bodies with their places, connectors, the environment.
    pub model: Vec<String>,
    /// What is run, and what is reported.
    pub job: Vec<String>,
    /// Records of `job` before the motion: title and tethers.
    before_motion: usize,
    /// What was assumed of the cards, and which of them have no effect.
    pub notes: Vec<Diagnostic>,
    /// The cards that the records of `model` and `job` are made of, by place in the record.
    origins: Vec<Vec<(usize, CardOrigin)>>,
}

/// Records as one text, with the cards they are made of.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct WrittenRecords {
    /// The script.
    pub text: String,
    /// From which byte on the text is made of which card, in order.
    pub origins: Vec<(usize, CardOrigin)>,
    /// The byte from which on the text runs the motion.
    pub motion: usize,
}

impl WrittenRecords {
    fn add(&mut self, record: &str, origins: &[(usize, CardOrigin)]) {
        let start = self.text.len();
        self.origins.extend(origins.iter().map(|(at, origin)| (start + at, origin.clone())));
        self.text.push_str(record);
        self.text.push('\n');
    }

    /// The model with its tethers, and the motion, as texts of their own.
    pub fn split(mut self) -> [WrittenRecords; 2] {
        let text = self.text.split_off(self.motion.min(self.text.len()));
        let from = self.text.len();
        let position = self.origins.partition_point(|(at, _)| *at < from);
        let origins = self.origins.split_off(position).into_iter().map(|(at, origin)| (at - from, origin)).collect();
        [self, WrittenRecords { text, origins, motion: 0 }]
    }
}

impl Records {
    fn new(model: Vec<RecordLine>, job: Vec<RecordLine>, before_motion: usize, notes: Vec<Diagnostic>) -> Self {
        let origins = model.iter().chain(&job).map(|line| line.origins.clone()).collect();
        let texts = |lines: Vec<RecordLine>| lines.into_iter().map(|line| line.text).collect();
        Records { model: texts(model), job: texts(job), before_motion, notes, origins }
    }

    /// The whole as a script.
    pub fn script(&self) -> WrittenRecords {
        let mut made = WrittenRecords::default();
        made.add(UNITS, &[]);
        let first = self.model.len() + self.before_motion;
        for (index, (record, origins)) in self.model.iter().chain(&self.job).zip(&self.origins).enumerate() {
            if index == first {
                made.motion = made.text.len();
            }
            made.add(record, origins);
        }
        if self.origins.len() <= first {
            made.motion = made.text.len();
        }
        made
    }

    /// The model alone, after which the units are as before.
    pub fn model_alone(&self) -> WrittenRecords {
        let mut made = WrittenRecords::default();
        made.add("&DIMEN -SAVE -DIMEN METERS K-NTS", &[]);
        for (record, origins) in self.model.iter().zip(&self.origins) {
            made.add(record, origins);
        }
        made.add("&DIMEN -REMEMBER", &[]);
        made
    }
}

/// The records of a deck.
///
/// # Errors
/// Units that cannot be determined; earlier stages that are not in the file; cards for which the model or its engines have no place: each
/// with the reason, and where there is one the native record to use.
pub fn records(deck: &Deck) -> Result<Records, Vec<Diagnostic>> {
    let mut out = write_script(deck)?;
    let model = std::mem::take(&mut out.lines);
    run::tethers(deck, &mut out);
    let before_motion = out.lines.len();
    run::motion(deck, &mut out);
    if out.wrong.is_empty() { Ok(Records::new(model, out.lines, before_motion, out.notes)) } else { Err(out.wrong) }
}

/// The records of the model of a deck, whatever program it is for.
///
/// # Errors
/// As [`records`], but for what is run.
pub fn model_records(deck: &Deck) -> Result<Records, Vec<Diagnostic>> {
    let out = write_script(deck)?;
    if out.wrong.is_empty() { Ok(Records::new(out.lines, Vec::new(), 0, out.notes)) } else { Err(out.wrong) }
}

/// The model as it could be written, with what is wrong with it.
fn write_script(deck: &Deck) -> Result<Script, Vec<Diagnostic>> {
    let (start, _) = deck.job.stages;
    if start > 1 && !deck.has_earlier_stages {
        let error = Diagnostic::error("deck 0, RESTART: this file begins after stage 1", deck.job.span)
            .label(format!("decks before those of stage {start} are not in it"))
            .help("name the deck of the earlier stages in columns 21 on of RESTART, without .dat, or give all stages in one file: a database is not read");
        return Err(vec![*error]);
    }
    let units = deck.units().map_err(|error| vec![*error])?;
    let mut out = Script::new(Scale::from_units(&units), "deck 0, JOB", deck.job.span);
    model(deck, &units, &mut out);
    Ok(out)
}

fn model(deck: &Deck, units: &super::units::Units, out: &mut Script) {
    out.remark(&format!("deck {} {}: {}", deck.job.run, deck.job.analysis, deck.job.title));
    out.remark(&format!(
        "its units are {}; all numbers below are in m, kN, kg/m3 and degrees, tethers in kg, m, N",
        units.name
    ));
    if deck.job.analysis == "DRFT" {
        let text = "DRFT runs as WFRQ: loads of wave and drift frequency act together in one run in time";
        out.note("deck 0, JOB, columns 17-20", deck.job.span, text);
    }
    let density = number(out.scale.density(deck.global.density));
    let gravity = number(out.scale.length(deck.global.gravity));
    let global = &deck.global;
    for (word, card, span) in [("-WATER", "DENS", global.density_span), ("-GRAVITY", "ACCG", global.gravity_span)] {
        if let Some(span) = span {
            out.word(word, format!("deck 5, {card}"), span);
        }
    }
    out.record(format!("&DEFAULT -WATER {density} -GRAVITY {gravity}"));
    environment::environment(deck, out);
    out.record("MEDIT");
    model::ground(deck, out);
    for structure in &deck.structures {
        model::structure(deck, structure, out);
    }
    diffraction::diffraction(deck, out);
    model::starts(deck, out);
    tethers::tethers(deck, out);
    lines::lines(deck, out);
    articulations::fenders(deck, out);
    articulations::articulations(deck, out);
    out.card("deck 0, JOB", deck.job.span);
    out.record("END");
}
