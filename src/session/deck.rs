//! AQWA decks: read, listed, and run as the records they amount to.

use super::Session;
use crate::commands::{PLAIN, SCRIPT};
use crate::report::page;
use std::path::Path;
use windlass_aqwa::{self as aqwa, Deck, Records, WrittenRecords};
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_base::span::Span;
use windlass_language::source::Text;

impl Session {
    /// Opens a text as the job: an AQWA deck as the records it amounts to, anything else as a script.
    ///
    /// A deck is listed first, as its listing has it. Its records are kept in the folder of answers as a script. A deck with an error
    /// is not run, and an error in its records ends the run: what would follow would not be that of the deck.
    pub fn open_job(&mut self, name: &str, text: impl Into<Text>) {
        let text = text.into();
        if !aqwa::is_deck(text.as_str()) {
            self.open(name, text);
            return;
        }
        let Some((deck, records)) = self.translate_deck(name, text, aqwa::records) else { return };
        self.tell(&deck);
        let script = records.script();
        let named = format!("{}.cif", stem(name));
        if let Err(error) = self.job.output.folder.write(&named, script.text.as_bytes()) {
            let text = format!("the records of the deck are not kept: {error}");
            self.report(Diagnostic::plain(Severity::Warning, text));
        }
        self.job.settings.batch = true;
        self.open_records(&named, script, SCRIPT, None);
    }

    /// Reads the model of a deck next.
    pub(super) fn insert_deck(&mut self, name: &str, text: Text, span: Span) {
        if !aqwa::is_deck(text.as_str()) {
            let error = Diagnostic::error(format!("{name} is no deck of AQWA"), span);
            self.report(*error.help("a deck begins with a JOB line that names a program, as JOB HE01  DRIF"));
            return;
        }
        let Some((_, records)) = self.translate_deck(name, text, aqwa::model_records) else { return };
        // the first points of a deck are in the ground
        self.job.model.current_part = None;
        let named = format!("records of {name}");
        self.open_records(&named, records.model_alone(), PLAIN, Some(span));
    }

    /// Reads the records of a deck next; what is said of them later is said of the cards they are made of.
    fn open_records(&mut self, name: &str, records: WrittenRecords, tag: u32, span: Option<Span>) {
        match self.interpreter.open(name, records.text.clone(), tag, span) {
            Ok(id) => self.decks.push((id, records)),
            Err(error) => self.report(*error),
        }
    }

    /// A message about a record of a deck as one about the card it is made of.
    pub(super) fn point_at_card(&self, mut said: Diagnostic) -> Diagnostic {
        let made_of = |span: Span| {
            let (_, records) = self.decks.iter().find(|(id, _)| *id == span.source)?;
            let byte = span.start as usize;
            let line = records.text.get(..byte)?.rfind('\n').map_or(0, |at| at + 1);
            Some((records.origin(byte)?, records.text.get(line..)?.lines().next()?))
        };
        if let Some((origin, record)) = said.span.and_then(made_of) {
            said.message = format!("{}: {}", origin.card, said.message);
            said.help
                .push(format!("the card is read as the record `{}`", record.trim().trim_end_matches('\\').trim_end()));
            said.span = Some(origin.span);
        }
        if let Some((span, _)) = &mut said.other
            && let Some((origin, _)) = made_of(*span)
        {
            *span = origin.span;
        }
        said
    }

    /// A deck with its records; nothing when it has an error, which is reported.
    fn translate_deck(
        &mut self,
        name: &str,
        text: Text,
        records: fn(&Deck) -> Result<Records, Vec<Diagnostic>>,
    ) -> Option<(Deck, Records)> {
        let id = self.interpreter.sources.add(name, text, 1);
        let reading = aqwa::read(&self.interpreter.sources, id);
        for message in reading.messages {
            self.report(message);
        }
        if reading.failed {
            return None;
        }
        match records(&reading.deck) {
            Ok(made) => Some((reading.deck, made)),
            Err(list) => {
                for message in list {
                    self.report(message);
                }
                None
            }
        }
    }

    /// The echo of the cards and the data of decks 1 to 5.
    fn tell(&mut self, deck: &Deck) {
        let mut lines: Vec<String> = Vec::new();
        for echo in deck.echo().into_iter().filter(|echo| !echo.lines.is_empty()) {
            lines.push(format!("\n {}", echo.title));
            lines.extend(echo.lines);
        }
        let unit = deck.units().map_or("", |units| units.name);
        // a deck always makes its tables (their rows are made with them)
        for table in deck.data_tables() {
            lines.push(format!("\n {} ({unit})\n", table.title));
            lines.extend(page::grid(&table, self.job.units));
        }
        self.job.say(&lines.join("\n"));
    }
}

/// A file's name without its folder and ending.
fn stem(name: &str) -> String {
    Path::new(name).file_stem().map_or_else(|| "deck".into(), |stem| stem.to_string_lossy().replace(' ', "_"))
}
