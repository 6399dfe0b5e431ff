//! The deck of a model: what it is made of, in what order, and what is said of it.

use crate::commands::Job;
use indexmap::IndexMap;
use std::path::Path;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Position;
use windlass_base::span::Span;
use windlass_base::units::UnitSystem;
use windlass_model::{Connector, Model, Surroundings};
use windlass_moordyn::tables::{Attachment, Height, LineEnd, Point};
use windlass_moordyn::{Deck, Given, write};

/// A deck and the files beside it.
pub(super) struct WrittenDeck {
    /// The deck.
    pub text: String,
    /// Names and texts of the files.
    pub files: Vec<(String, String)>,
    /// What was left out or assumed.
    pub notes: Vec<Diagnostic>,
}

/// What a body of the model is in the deck.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum BodyRole {
    /// Its points are moved by a program, each by itself.
    Caller,
    /// The body of this id.
    Body(usize),
    /// The rod of this id, from its end A along the body's axes to its end B (m).
    Rod(usize, [Position; 2]),
    /// A free point of this id.
    Junction(usize),
}

/// Writes a deck.
pub(super) struct DeckWriter<'a> {
    pub(super) model: &'a Model,
    pub(super) units: UnitSystem,
    pub(super) around: Surroundings,
    /// Depth (m).
    pub(super) depth: f64,
    /// The record.
    pub(super) span: Span,
    /// The name of the deck, of whose folder its files are.
    pub(super) name: &'a str,
    pub(super) deck: Deck,
    /// The points of the model that are written, by name and offset.
    points: IndexMap<String, LineEnd>,
    /// What bodies are, by their keys.
    pub(super) bodies: IndexMap<String, BodyRole>,
    pub(super) files: Vec<(String, String)>,
    pub(super) notes: Vec<Diagnostic>,
    /// What the free text before the first section says.
    heads: Vec<String>,
}

/// A value of a deck that was not read from one.
pub(super) fn own<T>(value: T) -> Given<T> {
    Given { value, span: Span::default() }
}

/// A computed number without the rounding of its last digits.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.12e}").parse().unwrap_or(value)
}

impl<'a> DeckWriter<'a> {
    /// A writer of the model of a job.
    ///
    /// # Errors
    /// A model without connectors, or whose depth is not known.
    pub(super) fn new(job: &'a Job, name: &'a str, span: Span) -> Outcome<Self> {
        let model = &job.model;
        let around = model.surroundings();
        if !model.connectors.values().any(|connector| connector.active) {
            return Err(Diagnostic::error("there is no line to write", span).help("CONNECTOR makes one"));
        }
        let Some(depth) = around.depth else {
            return Err(Diagnostic::error("the depth of the water is not known", span).help("&ENV -DEPTH gives it"));
        };
        Ok(DeckWriter {
            model,
            units: job.units,
            around,
            depth,
            span,
            name,
            deck: Deck::default(),
            points: IndexMap::new(),
            bodies: IndexMap::new(),
            files: Vec::new(),
            notes: Vec::new(),
            heads: Vec::new(),
        })
    }

    /// The deck.
    ///
    /// # Errors
    /// What a deck cannot hold, by name.
    pub(super) fn write(mut self) -> Outcome<WrittenDeck> {
        self.water()?;
        self.bodies()?;
        self.lines()?;
        let title = format!("MoorDyn v2 deck of {}, written by windlass", self.name);
        let heads: Vec<String> = std::iter::once(title).chain(std::mem::take(&mut self.heads)).collect();
        let text = write::text(&self.deck, &heads);
        Ok(WrittenDeck { text, files: self.files, notes: self.notes })
    }

    /// Refuses what a deck cannot hold.
    pub(super) fn refuse(&self, message: impl Into<String>, help: &str) -> Box<Diagnostic> {
        let error = Diagnostic::error(message, self.span);
        if help.is_empty() { error } else { error.help(help) }
    }

    pub(super) fn remark(&mut self, text: impl Into<String>) {
        self.notes.push(*Diagnostic::remark(text, self.span));
    }

    /// A line of the free text, such as which name of the model a row has.
    pub(super) fn head(&mut self, text: String) {
        self.heads.push(text);
    }

    /// The name of a file beside the deck, as a record has it.
    pub(super) fn beside(&self, file: &str) -> String {
        Path::new(self.name).with_file_name(file).to_string_lossy().into_owned()
    }

    /// Adds a point; returns its id.
    pub(super) fn add_point(&mut self, attachment: Attachment, at: Position) -> usize {
        let [x, y, z] = at.map(rounded);
        let id = self.deck.points.len() + 1;
        self.deck.points.push(Point {
            id: own(id),
            attachment: own(attachment),
            horizontal: [x, y],
            height: own(Height::Given(z)),
            mass: own(0.0),
            volume: own(0.0),
            force: [0.0; 3],
            drag_area: own(0.0),
            added_mass: own(0.0),
        });
        id
    }

    /// What an end of a connector is in the deck; none of a line whose second end is an anchor.
    pub(super) fn end(&mut self, connector: &Connector, index: usize) -> Outcome<Option<LineEnd>> {
        let Some(name) = connector.points.get(index) else { return Ok(None) };
        let offset = connector.offsets.get(index).copied().unwrap_or_default();
        let key = format!("{} {offset:?}", Model::key(name));
        if let Some(end) = self.points.get(&key) {
            return Ok(Some(*end));
        }
        let point = self.model.points.get(&Model::key(name));
        let point = point.ok_or_else(|| self.refuse(format!("{}: there is no point {name}", connector.name), ""))?;
        let at = self.model.end(connector, index).unwrap_or_default();
        let body = self.model.body_of(point);
        let role = body.map(|body| self.bodies.get(&Model::key(&body.name)).copied().unwrap_or(BodyRole::Caller));
        let part = self.model.parts.get(&Model::key(&point.part));
        let in_body = part.map_or(point.at, |part| part.position.apply(point.at));
        let in_body = [0, 1, 2].map(|axis| in_body[axis] + offset[axis]);
        let end = match role {
            None => LineEnd::Point(self.add_point(Attachment::Fixed, at)),
            Some(BodyRole::Caller) => LineEnd::Point(self.add_point(Attachment::Coupled, at)),
            Some(BodyRole::Body(id)) => LineEnd::Point(self.add_point(Attachment::Body(id), in_body)),
            Some(BodyRole::Junction(id)) => {
                let end = LineEnd::Point(id);
                self.points.insert(key, end);
                return Ok(Some(end));
            }
            Some(BodyRole::Rod(id, [a, b])) => {
                let is_at =
                    |end: Position| (0..3).all(|axis| (end[axis] - in_body[axis]).abs() < super::system::AT_END_M);
                if is_at(a) {
                    LineEnd::RodA(id)
                } else if is_at(b) {
                    LineEnd::RodB(id)
                } else {
                    let text = format!(
                        "{} ends between the ends of the rod {}",
                        connector.name,
                        body.map_or("", |b| b.name.as_str())
                    );
                    return Err(self.refuse(text, "lines of a deck end at the ends of rods"));
                }
            }
        };
        if let LineEnd::Point(id) = end {
            self.head(format!("point {id}: {name}"));
        }
        self.points.insert(key, end);
        Ok(Some(end))
    }
}

/// How near two places are the same (m).
pub(super) const AT_END_M: f64 = 1e-6;
