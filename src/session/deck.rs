//! Decks of AQWA, MoorDyn and OrcaFlex: read, listed, and run as the records they amount to.

use super::Session;
use crate::commands::{DECK_HEAD, PLAIN, SCRIPT, existing};
use crate::report::page;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use windlass_aqwa::job::Program;
use windlass_aqwa::listing::ListingPart;
use windlass_aqwa::waves::WaveDeck;
use windlass_aqwa::{self as aqwa, Deck, Records, WrittenRecords};
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_base::fortran::format_fixed;
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::sea::Sea;
use windlass_language::source::Text;
use windlass_model::Model;
use windlass_moordyn::files::FileText;
use windlass_moordyn::records::{CallerWater, Like, LineModel, Settings, VESSEL};
use windlass_orcaflex as orcaflex;

/// Records made of a deck, with the cards or rows they are made of.
#[derive(Clone, Debug)]
pub(super) struct DeckRecords {
    text: String,
    /// From which byte on the text is made of which card or row: its name and place, in order.
    origins: Vec<(usize, String, Span)>,
    /// `card` or `row`.
    unit: &'static str,
}

impl DeckRecords {
    /// The card or row that a byte of the text is made of; none before the first record of a deck.
    fn origin(&self, byte: usize) -> Option<(&str, Span)> {
        let behind = self.origins.partition_point(|(at, _, _)| *at <= byte);
        let origin = behind.checked_sub(1).and_then(|index| self.origins.get(index));
        origin.map(|(_, name, span)| (name.as_str(), *span))
    }
}

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
        let Some((deck, records)) = self.translate_deck(name, None, text, aqwa::records) else { return };
        self.list(&deck);
        let script = records.script();
        let named = format!("{}.cif", stem(name));
        if let Err(error) = self.job.output.folder.write(&named, script.text.as_bytes()) {
            let text = format!("the records of the deck are not kept: {error}");
            self.report(Diagnostic::plain(Severity::Warning, text));
        }
        self.job.settings.batch = true;
        // what the listing has between the tethers and the motion comes where the records of the model end
        let [head, motion] = script.split();
        self.open_records(&named, motion, SCRIPT, None);
        self.open_records(&named, head, DECK_HEAD, None);
        self.listed = Some(Box::new(deck));
    }

    /// Opens a text that is only checked: of a deck the records it amounts to, unless a card of it is wrong.
    pub fn open_to_check(&mut self, name: &str, path: &Path, text: impl Into<Text>) {
        let text = text.into();
        if aqwa::is_deck(text.as_str()) {
            match self.translate_deck(name, Some(path), text, aqwa::records) {
                Some((_, records)) => self.open_records(&format!("records of {name}"), records.script(), SCRIPT, None),
                None => self.end_check("the deck has errors"),
            }
            return;
        }
        match self.interpreter.open(name, text, SCRIPT, None) {
            Ok(id) => self.source_files.push((id, path.to_path_buf())),
            Err(error) => self.report(*error),
        }
    }

    /// Reads the model of a deck next.
    pub(super) fn insert_deck(&mut self, name: &str, path: &Path, text: Text, span: Span) {
        if !aqwa::is_deck(text.as_str()) {
            let error = Diagnostic::error(format!("{name} is no deck of AQWA"), span);
            self.report(*error.help("a deck begins with a JOB line that names a program, as JOB HE01  DRIF"));
            return;
        }
        let Some((_, records)) = self.translate_deck(name, Some(path), text, aqwa::model_records) else { return };
        // the first points of a deck are in the ground
        self.job.model.current_part = None;
        let named = format!("records of {name}");
        self.open_records(&named, records.model_alone(), PLAIN, Some(span));
    }

    /// Reads the model of a MoorDyn deck next.
    pub(super) fn insert_moordyn(
        &mut self,
        (name, path): (&str, &Path),
        text: Text,
        (lines, like): (LineModel, Like),
        span: Span,
    ) {
        let id = self.interpreter.sources.add(name, text.clone(), 1);
        self.source_files.push((id, path.to_path_buf()));
        let reading = windlass_moordyn::read(text.as_str(), id);
        let is_failed = reading.is_failed();
        for message in reading.messages {
            self.report(message);
        }
        if is_failed {
            return;
        }
        let Some(files) = self.files_of_deck(&reading.deck, path) else { return };
        let around = self.job.model.surroundings();
        let water = CallerWater { depth: around.depth, density: around.water_density, gravity: around.gravity };
        let has_vessel = self.job.model.bodies.contains_key(VESSEL);
        let settings = Settings { lines, like, water, has_vessel, files: &files };
        match windlass_moordyn::records::records(&reading.deck, &settings) {
            Ok(records) => {
                let origins = records.origins.iter().map(|(at, origin)| (*at, origin.row.as_str(), origin.span));
                let taken = self.names_taken(&records.text, origins, VESSEL);
                if !taken.is_empty() {
                    for error in taken {
                        self.report(error);
                    }
                    return;
                }
                for note in records.notes {
                    self.report(note);
                }
                // the first points of a deck are in the ground
                self.job.model.current_part = None;
                let origins = records.origins.into_iter().map(|(at, origin)| (at, origin.row, origin.span)).collect();
                let made = DeckRecords { text: records.text, origins, unit: "row" };
                self.open_deck_records(&format!("records of {name}"), made, PLAIN, Some(span));
            }
            Err(list) => {
                for message in list {
                    self.report(message);
                }
            }
        }
    }

    /// Reads an OrcaFlex text model next.
    pub(super) fn insert_orcaflex(
        &mut self,
        (name, path): (&str, &Path),
        text: Text,
        lines: orcaflex::records::LineModel,
        span: Span,
    ) {
        let id = self.interpreter.sources.add(name, text.clone(), 1);
        self.source_files.push((id, path.to_path_buf()));
        let reading = orcaflex::read(text.as_str(), id);
        let is_failed = reading.is_failed();
        for message in reading.messages {
            self.report(message);
        }
        if is_failed {
            return;
        }
        let made = match orcaflex::records::records(&reading.model, lines) {
            Ok(made) => made,
            Err(list) => {
                for message in list {
                    self.report(message);
                }
                return;
            }
        };
        let origins = made.origins.iter().map(|(at, origin)| (*at, origin.object.as_str(), origin.span));
        let taken = self.names_taken(&made.text, origins, "");
        if !taken.is_empty() {
            for error in taken {
                self.report(error);
            }
            return;
        }
        for note in made.notes {
            self.report(note);
        }
        // the first points of a model are in the ground
        self.job.model.current_part = None;
        let origins = made.origins.into_iter().map(|(at, origin)| (at, origin.object, origin.span)).collect();
        let records = DeckRecords { text: made.text, origins, unit: "object" };
        self.open_deck_records(&format!("records of {name}"), records, PLAIN, Some(span));
    }

    /// The files beside a MoorDyn deck that it needs; nothing when one cannot be read, which is reported.
    fn files_of_deck(
        &mut self,
        deck: &windlass_moordyn::Deck,
        path: &Path,
    ) -> Option<BTreeMap<String, FileText<String>>> {
        let mut found = BTreeMap::new();
        for file in deck.files() {
            let beside = path.parent().unwrap_or(Path::new("")).join(&file.name);
            let read = existing(&self.job, &beside.to_string_lossy(), file.span).and_then(|path| {
                self.job.output.folder.note_reading(&path);
                let text = self.unsaved.read(&path).map_err(|error| Diagnostic::error(error.to_string(), file.span))?;
                Ok((path, text))
            });
            match read {
                Ok((path, text)) => {
                    let source = self.interpreter.sources.add(&file.name, text.clone(), 1);
                    self.source_files.push((source, path));
                    found.insert(file.name, FileText { text: text.as_str().to_string(), source });
                }
                Err(error) => {
                    self.report(*error);
                    return None;
                }
            }
        }
        Some(found)
    }

    /// Classes, points and bodies of a deck whose names the model has: their records would add a segment, move the point or load the body. The
    /// body `shared` may be there.
    fn names_taken<'a>(
        &self,
        text: &str,
        origins: impl Iterator<Item = (usize, &'a str, Span)>,
        shared: &str,
    ) -> Vec<Diagnostic> {
        let model = &self.job.model;
        let mut errors = Vec::new();
        for (at, row, span) in origins {
            let record = text.get(at..).unwrap_or_default();
            let name = record.split_whitespace().next().unwrap_or_default();
            let described = record.strip_prefix("&DESCRIBE BODY ").and_then(|rest| rest.split_whitespace().next());
            let (kind, name, is_taken) = match name.get(..1) {
                _ if described.is_some() => {
                    let body = described.unwrap_or_default();
                    ("body", body, body != shared && model.bodies.contains_key(&Model::key(body)))
                }
                Some("~") => ("class", name, model.classes.contains_key(&Model::key(name))),
                Some("*") => ("point", name, model.points.contains_key(&Model::key(name))),
                _ => continue,
            };
            if is_taken {
                let error = Diagnostic::error(format!("{row}: the model has a {kind} {name} already"), span);
                errors.push(*error.help("read the deck first, or DELETE what has its names"));
            }
        }
        errors
    }

    /// Reads the records of an AQWA deck next.
    fn open_records(&mut self, name: &str, records: WrittenRecords, tag: u32, span: Option<Span>) {
        let origins = records.origins.into_iter().map(|(at, origin)| (at, origin.card, origin.span)).collect();
        self.open_deck_records(name, DeckRecords { text: records.text, origins, unit: "card" }, tag, span);
    }

    /// Reads the records of a deck next; what is said of them later is said of the cards or rows they are made of.
    fn open_deck_records(&mut self, name: &str, records: DeckRecords, tag: u32, span: Option<Span>) {
        match self.interpreter.open(name, records.text.clone(), tag, span) {
            Ok(id) => self.decks.push((id, records)),
            Err(error) => self.report(*error),
        }
    }

    /// The card or row that a place in a text is made of, by name and place, and the record that it became with the word for it; of a text
    /// made of a deck.
    pub(super) fn card_of(&self, span: Span) -> Option<((&str, Span), &str, &'static str)> {
        let (_, records) = self.decks.iter().find(|(id, _)| *id == span.source)?;
        let byte = span.start as usize;
        let line = records.text.get(..byte)?.rfind('\n').map_or(0, |at| at + 1);
        Some((records.origin(byte)?, records.text.get(line..)?.lines().next()?, records.unit))
    }

    /// A message about a record of a deck as one about the card or row it is made of.
    pub(super) fn point_at_card(&self, mut said: Diagnostic) -> Diagnostic {
        if let Some(((name, origin), record, unit)) = said.span.and_then(|span| self.card_of(span)) {
            said.message = format!("{name}: {}", said.message);
            let record = record.trim().trim_end_matches('\\').trim_end();
            said.help.push(format!("the {unit} is read as the record `{record}`"));
            said.span = Some(origin);
        }
        if let Some((span, _)) = &mut said.other
            && let Some(((_, origin), _, _)) = self.card_of(*span)
        {
            *span = origin;
        }
        said
    }

    /// The deck of the stages before the first one of RESTART, where that names it: a file beside the job.
    fn earlier_stages(&mut self, deck: &Deck) -> Outcome<Option<(String, PathBuf, Text)>> {
        let (start, _) = deck.job.stages;
        let name = &deck.job.database;
        if start <= 1 || name.is_empty() {
            return Ok(None);
        }
        let file = format!("{name}.dat");
        let path = existing(&self.job, &file, deck.job.span).map_err(|error| {
            let text = format!("deck 0, RESTART: {}", error.message);
            let help = "columns 21 on name the deck of the earlier stages; a database of AQWA is not read";
            Diagnostic::error(text, deck.job.span).help(help)
        })?;
        self.job.output.folder.note_reading(&path);
        let text = self.unsaved.read(&path).map_err(|error| Diagnostic::error(error.to_string(), deck.job.span))?;
        Ok(Some((file, path, text)))
    }

    /// A deck with its records; nothing when it has an error, which is reported.
    fn translate_deck(
        &mut self,
        name: &str,
        path: Option<&Path>,
        text: Text,
        records: fn(&Deck) -> Result<Records, Vec<Diagnostic>>,
    ) -> Option<(Deck, Records)> {
        let id = self.interpreter.sources.add(name, text, 1);
        self.source_files.extend(path.map(|path| (id, path.to_path_buf())));
        let reading = aqwa::read(&self.interpreter.sources, id);
        let reading = match self.earlier_stages(&reading.deck) {
            Ok(None) => reading,
            Ok(Some((name, path, text))) => {
                let earlier = self.interpreter.sources.add(&name, text, 1);
                self.source_files.push((earlier, path));
                aqwa::read_after(&self.interpreter.sources, id, earlier)
            }
            Err(error) => {
                self.report(*error);
                return None;
            }
        };
        for message in reading.messages {
            self.report(message);
        }
        if reading.failed {
            return None;
        }
        match records(&reading.deck) {
            Ok(mut made) => {
                for note in std::mem::take(&mut made.notes) {
                    self.report(note);
                }
                Some((reading.deck, made))
            }
            Err(list) => {
                for message in list {
                    self.report(message);
                }
                None
            }
        }
    }

    /// The echo of the cards and the data of the decks.
    fn list(&mut self, deck: &Deck) {
        let mut lines: Vec<String> = Vec::new();
        for part in deck.listing_before_tethers() {
            match part {
                ListingPart::Echo(echo) => {
                    lines.push(format!("\n {}", echo.title));
                    lines.extend(echo.lines);
                }
                ListingPart::Page(page) => lines.extend(page::listing(&page, self.job.units)),
            }
        }
        if let Ok(units) = deck.units() {
            lines.push(format!("\n pages of the data are in {}", units.name));
        }
        self.job.say(&lines.join("\n"));
    }

    /// The pages between the tethers and the motion, once the model of the deck is made.
    pub(super) fn list_start(&mut self) {
        let Some(deck) = self.listed.take() else { return };
        let mut pages = deck.listing_before_motion();
        if matches!(deck.waves, WaveDeck::Spectra(_)) && deck.job.program == Program::Drift {
            let length = deck.units().map_or(1.0, |units| units.length);
            // the run refuses a sea that cannot be, at its record
            let sea = Sea::new(&self.job.model, &self.job.model.environment).ok().flatten();
            pages.extend(sea.as_ref().and_then(|sea| spectral_lines(sea, length)));
        }
        let lines: Vec<String> = pages.iter().flat_map(|page| page::listing(page, self.job.units)).collect();
        if !lines.is_empty() {
            self.job.say(&lines.join("\n"));
        }
    }
}

/// The lines of a spectrum [AQWA-TETHER 8.1], in a unit of length (m).
fn spectral_lines(sea: &Sea, length: f64) -> Option<Table> {
    let train = sea.trains.first()?;
    let waves = sea.components.get(train.components.clone())?;
    let variance: f64 = waves.iter().map(|wave| 0.5 * wave.amplitude * wave.amplitude).sum();
    let rows: Vec<_> = (1usize..).zip(waves.iter().zip(&train.bands)).collect();
    let four = Digits::Decimals(4);
    let table = Table::new("Wave Spectral Lines")
        .with_rows(&rows)
        .column("", "NUMBER", Dim::None, Digits::Usual, |(number, _)| *number)
        .column("", "WAVE NUMBER", Dim::None, Digits::Scientific(5), |(_, (wave, _))| wave.number * length)
        .column("", "FREQUENCY", Dim::None, four, |(_, (wave, _))| wave.frequency)
        .column("", "PHASE", Dim::None, four, |(_, (wave, _))| wave.phase.to_degrees().rem_euclid(360.0))
        .column("", "ORDINATES", Dim::None, four, |(_, (_, band))| band.mean_density().map(|s| s / (length * length)))
        .build();
    let height = format_fixed(4.0 * variance.sqrt() / length, 3);
    Some(table.fact("4 TIMES SQUARE ROOT OF RASTER AREA(S.W.H.)", height, Dim::None))
}

/// A file's name without its folder and ending.
fn stem(name: &str) -> String {
    Path::new(name).file_stem().map_or_else(|| "deck".into(), |stem| stem.to_string_lossy().replace(' ', "_"))
}
