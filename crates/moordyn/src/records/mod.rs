//! A deck as records of windlass: what a script of the same system says.
//!
//! The session runs these records and nothing else, so that a deck and a script of the same system are the same thing. Numbers are in
//! `&DIMEN -DIMEN METERS K-NTS`. Fixed points are `*P1` .. in the ground, coupled ones `*P4` .. on the body VESSEL, free ones junctions `P7`;
//! bodies are `BODY1` .., rods bodies of one TUBE `ROD1` .. or parts of the body they are fixed to, lines connectors `L1` ... What is coupled
//! stands still until PRESCRIBE gives it a motion.

mod bodies;
mod lines;
mod water;

use crate::Deck;
use crate::files::FileText;
use crate::options::Options;
use crate::tables::{Attachment, Height, Point};
use crate::write::number;
use std::collections::BTreeMap;
use windlass_base::choices;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// MoorDyn's g (m/s2) where the deck gives none [MOORDYN-2].
const DEFAULT_GRAVITY: f64 = 9.80665;
/// MoorDyn's density of water (kg/m3) where the deck gives none.
const DEFAULT_DENSITY: f64 = 1025.0;
/// The body that what is coupled is on.
pub const VESSEL: &str = "VESSEL";
/// What is taken of MoorDyn where its answers are asked for, and what is not.
const TAKEN: &str = "buoyancy of bodies at their centre of gravity; the first one of three or six drag areas of a body lost; friction by FricDamp; the push of a \
                     seafloor straight up; no acceleration of the water of waves at points and bodies; tensions at ends in the middle of the end segments";
const STILL_RIGHT: &str = "pins that accelerate; a seafloor bicubic between its points; a bottom that never pulls; ends of rods over the bottom";
/// How far an anchor may stand from the seabed (m) and still be on it: places of decks are rounded to millimetres.
const ON_SEABED_M: f64 = 1e-3;

/// How lines are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineModel {
    /// As dynamic lines (class ROD) of NumSegs elements.
    Dynamic,
    /// As quasi-static lines (B_CAT to anchors on the seabed, else H_CAT), NumSegs unused.
    Static,
}

choices! {
    /// Whose answer is taken where MoorDyn 2.7.2 [MOORDYN-2] and the right one part.
    pub enum Like {
        /// The right one.
        Right = "RIGHT",
        /// MoorDyn's: buoyancy of bodies at their centre of gravity, no first one of three or six drag areas, friction by FricDamp, a seafloor
        /// that pushes straight up, waves that act on points and bodies by drag alone, tensions at ends in the middle of the end segments.
        MoorDyn = "MOORDYN",
    }
}

/// The water of a program that reads a file of MAP++, which does not say it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CallerWater {
    /// Depth (m).
    pub depth: Option<f64>,
    /// Density (kg/m3).
    pub density: f64,
    /// Gravity (m/s2).
    pub gravity: f64,
}

/// How a deck is read, and what it needs besides itself.
#[derive(Clone, Copy, Debug)]
pub struct Settings<'a> {
    /// How lines are read.
    pub lines: LineModel,
    /// Whose answer is taken where MoorDyn's is another.
    pub like: Like,
    /// The water where the deck is a file of MAP++.
    pub water: CallerWater,
    /// Whether the model has a body VESSEL: what is coupled is then on it, and its motion is left as it is.
    pub has_vessel: bool,
    /// The files of [`Deck::files`], by their names there.
    pub files: &'a BTreeMap<String, FileText<String>>,
}

/// The row that a record is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct RowOrigin {
    /// Table and id, as `LINES 3`.
    pub row: String,
    /// The row's first word.
    pub span: Span,
}

/// A deck as records, one a line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Records {
    /// The records.
    pub text: String,
    /// From which byte on the text is made of which row, in order.
    pub origins: Vec<(usize, RowOrigin)>,
    /// What was assumed, and what has no effect.
    pub notes: Vec<Diagnostic>,
}

/// The records of a deck that was read without an error. Depth, density and gravity are those of the deck, or of the caller where it is a file
/// of MAP++; the lines of such a file are static.
///
/// # Errors
/// What bears a load and is not read into the model: waves of the caller, tables of stiffness and seafloor files of static lines, rods without
/// length; each at its word. Files that are not there or wrong.
pub fn records(deck: &Deck, settings: &Settings<'_>) -> Result<Records, Vec<Diagnostic>> {
    let mut writer = Writer {
        deck,
        model: if deck.map.is_some() { LineModel::Static } else { settings.lines },
        like: settings.like,
        caller: settings.water,
        files: settings.files,
        out: Records::default(),
        wrong: Vec::new(),
        depth: 0.0,
        classes: BTreeMap::new(),
        has_hanging_lines: false,
        has_vessel: false,
        finds_vessel: settings.has_vessel,
        pins: Vec::new(),
    };
    writer.write();
    if writer.wrong.is_empty() { Ok(writer.out) } else { Err(writer.wrong) }
}

/// A computed number without the rounding of its last digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.12e}").parse().unwrap_or(value)
}

fn numbers(values: &[f64]) -> String {
    values.iter().map(|value| number(*value)).collect::<Vec<_>>().join(" ")
}

/// What a point of the deck is in the model.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Holder {
    Ground,
    Body,
    Junction,
}

/// What holds an end of a line.
struct Held {
    /// The name of its point in the model.
    name: String,
    holder: Holder,
    /// Z in the deck (m); of points of a body in its axes.
    height: f64,
}

struct Writer<'a> {
    deck: &'a Deck,
    model: LineModel,
    like: Like,
    caller: CallerWater,
    files: &'a BTreeMap<String, FileText<String>>,
    out: Records,
    wrong: Vec<Diagnostic>,
    /// Depth of the water (m).
    depth: f64,
    /// Records of classes and the name of each.
    classes: BTreeMap<String, String>,
    /// Whether a line is an H_CAT.
    has_hanging_lines: bool,
    /// Whether the body VESSEL is described, and whether the model had it.
    has_vessel: bool,
    finds_vessel: bool,
    /// The axes whose twist classes of pins hold already.
    pins: Vec<usize>,
}

impl Writer<'_> {
    fn record(&mut self, row: &str, span: Span, text: &str) {
        self.out.origins.push((self.out.text.len(), RowOrigin { row: row.to_string(), span }));
        self.out.text.push_str(text);
        self.out.text.push('\n');
    }

    fn refuse(&mut self, span: Span, message: impl Into<String>, help: &str) {
        self.wrong.push(*Diagnostic::error(message, span).help(help.to_string()));
    }

    fn remark(&mut self, span: Span, message: impl Into<String>) {
        self.out.notes.push(*Diagnostic::remark(message, span));
    }

    fn write(&mut self) {
        self.refuse_what_is_not_read();
        let options = &self.deck.options;
        let first = self.first_span();
        let at = |given: Option<Span>| given.unwrap_or(first);
        let whole = at(options.depth.as_ref().map(|depth| depth.span));
        self.depth = self.find_depth(options, whole);
        if !self.wrong.is_empty() {
            return;
        }
        let water = at(options.density.as_ref().map(|density| density.span));
        let (density, gravity) = (self.density(), self.gravity());
        self.record("OPTIONS", whole, "&DIMEN -SAVE -DIMEN METERS K-NTS");
        if self.deck.map.is_none() {
            let depth = number(self.depth);
            let defaults = format!("&DEFAULT -WATER {} -GRAVITY {} -DEPTH {depth}", number(density), number(gravity));
            self.record("OPTIONS", water, &defaults);
            let around = self.water();
            self.record("OPTIONS", whole, &format!("&ENV MOORDYN -DEPTH {depth}{around}"));
        }
        self.record("POINTS", whole, "MEDIT");
        self.points();
        self.rods();
        for line in &self.deck.lines {
            self.line(line);
        }
        self.record("LINES", whole, "END");
        self.record("OPTIONS", whole, "&DIMEN -REMEMBER");
        self.notes(whole);
    }

    fn first_span(&self) -> Span {
        let deck = self.deck;
        let line = deck.lines.first().map(|line| line.id.span);
        line.or_else(|| deck.bodies.first().map(|body| body.id.span)).unwrap_or_default()
    }

    fn gravity(&self) -> f64 {
        if self.deck.map.is_some() {
            return self.caller.gravity;
        }
        self.deck.options.gravity.as_ref().map_or(DEFAULT_GRAVITY, |given| given.value)
    }

    fn density(&self) -> f64 {
        if self.deck.map.is_some() {
            return self.caller.density;
        }
        self.deck.options.density.as_ref().map_or(DEFAULT_DENSITY, |given| given.value)
    }

    /// Weight in air (kN) of a mass (kg).
    fn weight(&self, mass: f64) -> f64 {
        rounded(mass * self.gravity() / 1000.0)
    }

    /// Depth of the water: WtrDpth, or as deep as the deepest point of the ground; of a file of MAP++ that of the caller.
    fn find_depth(&mut self, options: &Options, span: Span) -> f64 {
        if self.deck.map.is_some() {
            return self.callers_depth(span);
        }
        let given = options.depth.as_ref().map(|depth| depth.value.abs()).filter(|depth| *depth > 0.0);
        let has_floor = options.seafloor_file.is_some();
        let fixed = self.deck.points.iter().filter(|point| point.attachment.value == Attachment::Fixed);
        let depth_of = |point: &Point| match point.height.value {
            Height::Given(z) => Some((-z, point.height.span)),
            Height::Seabed => None,
        };
        let deepest =
            fixed.filter_map(depth_of).filter(|(depth, _)| *depth > 0.0).reduce(|a, b| if b.0 > a.0 { b } else { a });
        match (given, deepest) {
            (Some(depth), Some((below, at))) if below > depth + ON_SEABED_M && !has_floor => {
                let text = format!(
                    "the point stands {} m below the water of WtrDpth {}",
                    number(rounded(below - depth)),
                    number(depth)
                );
                let warning = Diagnostic::warning(text, at).label("the depth is taken from it, as MoorDyn does");
                self.out.notes.push(*warning.help("give WtrDpth, or the Z of the point, anew"));
                below
            }
            (Some(depth), _) => depth,
            (None, Some((below, at))) => {
                self.remark(
                    at,
                    format!("the deck gives no WtrDpth: the depth is that of this point, {} m", number(below)),
                );
                below
            }
            (None, None) => {
                self.refuse(span, "the deck gives no depth of the water", "add a row such as `200 WtrDpth` to OPTIONS");
                0.0
            }
        }
    }

    fn callers_depth(&mut self, span: Span) -> f64 {
        let Some(depth) = self.caller.depth else {
            let help = "a file of MAP++ has none: give &DEFAULT -DEPTH D before INMODEL";
            self.refuse(span, "the depth of the water is not known", help);
            return 0.0;
        };
        let below = |point: &&Point| matches!(point.height.value, Height::Given(z) if z < -depth - ON_SEABED_M);
        if let Some(point) =
            self.deck.points.iter().find(|point| point.attachment.value == Attachment::Fixed && below(point))
        {
            let text = format!("the node stands below the bottom, which is {} m deep", number(depth));
            self.refuse(
                point.height.span,
                text,
                "&DEFAULT -DEPTH or &ENV -DEPTH before INMODEL sets the depth; Z may be `depth`",
            );
        }
        let CallerWater { density, gravity, .. } = self.caller;
        self.remark(
            span,
            format!(
                "a file of MAP++ names no water: depth {} m, {} kg/m3 and g {} m/s2 are those in force",
                number(rounded(depth)),
                number(rounded(density)),
                number(rounded(gravity)),
            ),
        );
        depth
    }

    fn refuse_what_is_not_read(&mut self) {
        let options = &self.deck.options;
        if let Some(given) = options.wave_kinematics.as_ref().filter(|given| given.value == 1) {
            let help = "write 0 WaveKin, and give the sea by -SEA of &ENV";
            self.refuse(given.span, "the waves of WaveKin 1 are those of the caller, and are not read", help);
        }
        if let Some(given) = options.seafloor_file.as_ref().filter(|_| self.model == LineModel::Static) {
            let help = "read the lines as dynamic ones, without -STATIC; or give the anchors by -ANCHOR of CONNECTOR";
            self.refuse(given.span, "static lines of a deck do not lie on its seafloor file", help);
        }
        if let Some(given) = options.density.as_ref().filter(|given| given.value == 0.0) {
            self.refuse(given.span, "a sea without density", "expected the density of the water (kg/m3), such as 1025");
        }
    }

    /// What MoorDyn leaves out or does in another way in this deck, and whose answer is taken.
    fn note_what_parts(&mut self, whole: Span) {
        let deck = self.deck;
        let has_volume = deck.points.iter().any(|point| point.volume.value > 0.0)
            || deck.bodies.iter().any(|body| body.volume.value > 0.0);
        let waves = deck.options.wave_kinematics.as_ref().filter(|given| given.value > 0);
        if let Some(given) = waves.filter(|_| has_volume) {
            let text = match self.like {
                Like::Right => {
                    "waves accelerate the water around points and bodies; MoorDyn leaves that out: so does -LIKE MOORDYN"
                }
                Like::MoorDyn => "waves act on points and bodies by drag alone, as in MoorDyn",
            };
            self.remark(given.span, text);
        }
        if self.model == LineModel::Dynamic && self.like == Like::Right && deck.map.is_none() {
            let text = "tensions at ends of lines are those there; FairTen of MoorDyn is that in the middle of the last segment: so it is with -LIKE MOORDYN";
            self.remark(deck.lines.first().map_or(whole, |line| line.id.span), text);
        }
    }

    fn notes(&mut self, whole: Span) {
        let options = &self.deck.options;
        if self.like == Like::MoorDyn {
            self.remark(
                whole,
                format!("-LIKE MOORDYN takes these answers of MoorDyn: {TAKEN}. Right are still: {STILL_RIGHT}"),
            );
        }
        self.note_what_parts(whole);
        let friction = options.friction.as_ref().filter(|given| given.value > 0.0);
        if let (Some(given), LineModel::Dynamic) = (friction, self.model) {
            let text = match self.like {
                Like::Right => {
                    "friction is Coulomb's: FricDamp and StatDynFricScale, by which MoorDyn builds it up with speed, are not used; with -LIKE MOORDYN FricDamp is"
                }
                Like::MoorDyn => {
                    "friction rises with speed by FricDamp up to Coulomb's and holds nothing at rest, as in MoorDyn; StatDynFricScale is not used"
                }
            };
            self.remark(given.span, text);
        }
        if let (true, Some(line)) = (self.has_hanging_lines, self.deck.lines.first()) {
            let text = "lines that do not end on the seabed are H_CAT: they have their weight in water, and -DYNAMICS of &CONNECTOR would take it for their mass";
            let way_out = if self.deck.map.is_some() { "" } else { "; without -STATIC they are dynamic lines" };
            self.remark(line.id.span, format!("{text}{way_out}"));
        }
        if !options.unused.is_empty() {
            let names: Vec<&str> = options.unused.iter().map(|(name, _)| name.value.as_str()).collect();
            let at = options.unused.first().map_or(whole, |(name, _)| name.span);
            self.remark(
                at,
                format!("options of MoorDyn's own integration and output are not used: {}", names.join(" ")),
            );
        }
        if let Some(given) = self.deck.map.as_ref().and_then(|map| map.unused.first()) {
            let names: Vec<&str> =
                self.deck.map.iter().flat_map(|map| &map.unused).map(|name| name.value.as_str()).collect();
            self.remark(
                given.span,
                format!("options of MAP++'s own search and output are not used: {}", names.join(" ")),
            );
        }
        if let Some(kind) = self.deck.line_types.first() {
            let text = "decks have no breaking tension: ratios to it are of solid steel of Diam and mean nothing; &HELP ~CLASS B_CAT -B_TENSION";
            self.remark(kind.name.span, text);
        }
    }
}
