//! A deck as records of windlass: what a script of the same system says.
//!
//! The session runs these records and nothing else, so that a deck and a script of the same system are the same thing. Numbers are in
//! `&DIMEN -DIMEN METERS K-NTS`. Fixed points are `*P1` .. in the ground, coupled ones `*P4` .. on the body VESSEL, free ones junctions `P7`;
//! bodies are `BODY1` .., lines connectors `L1` ... Coupled and fixed bodies stand still until PRESCRIBE gives them a motion.

use crate::Deck;
use crate::options::Options;
use crate::tables::{Attachment, AxialStiffness, Body, Height, Line, LineEnd, LineType, Point};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// MoorDyn's g (m/s2) where the deck gives none [MOORDYN-2].
const DEFAULT_GRAVITY: f64 = 9.80665;
/// MoorDyn's density of water (kg/m3) where the deck gives none.
const DEFAULT_DENSITY: f64 = 1025.0;
/// MoorDyn's stiffness (Pa/m) and damping (Pa s/m) of the seabed where the deck gives none.
const DEFAULT_SEABED: [f64; 2] = [3e6, 3e5];
/// How far an anchor may stand from the seabed (m) and still be on it: places of decks are rounded to millimetres.
const ON_SEABED_M: f64 = 1e-3;
/// Longest part of a type's name that a class keeps: names have 64 characters, and a number may follow.
const CLASS_NAME_CHARACTERS: usize = 40;

/// How lines are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineModel {
    /// As dynamic lines (class ROD) of NumSegs elements.
    Dynamic,
    /// As quasi-static lines (B_CAT to anchors on the seabed, else H_CAT), NumSegs unused.
    Static,
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

/// The records of a deck that was read without an error.
///
/// # Errors
/// What bears a load and is not read into the model: rods, masses of free bodies with constant volume, tables of stiffness of static lines,
/// waves and currents from files, seafloor files; each at its word.
pub fn records(deck: &Deck, model: LineModel) -> Result<Records, Vec<Diagnostic>> {
    let mut writer = Writer {
        deck,
        model,
        out: Records::default(),
        wrong: Vec::new(),
        depth: 0.0,
        classes: BTreeMap::new(),
        has_hanging_lines: false,
    };
    writer.write();
    if writer.wrong.is_empty() { Ok(writer.out) } else { Err(writer.wrong) }
}

/// A number as a record has it: the shortest text that reads back as it.
fn number(value: f64) -> String {
    let value = value + 0.0;
    if value == 0.0 || (1e-4..1e9).contains(&value.abs()) { format!("{value}") } else { format!("{value:E}") }
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

struct Writer<'a> {
    deck: &'a Deck,
    model: LineModel,
    out: Records,
    wrong: Vec<Diagnostic>,
    /// Depth of the water (m).
    depth: f64,
    /// Records of classes and the name of each.
    classes: BTreeMap<String, String>,
    /// Whether a line is an H_CAT.
    has_hanging_lines: bool,
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
        let depth = number(self.depth);
        let defaults = format!("&DEFAULT -WATER {} -GRAVITY {} -DEPTH {depth}", number(density), number(gravity));
        self.record("OPTIONS", water, &defaults);
        self.record("OPTIONS", whole, &format!("&ENV MOORDYN -DEPTH {depth}"));
        self.record("POINTS", whole, "MEDIT");
        self.points();
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
        self.deck.options.gravity.as_ref().map_or(DEFAULT_GRAVITY, |given| given.value)
    }

    fn density(&self) -> f64 {
        self.deck.options.density.as_ref().map_or(DEFAULT_DENSITY, |given| given.value)
    }

    /// Weight in air (kN) of a mass (kg).
    fn weight(&self, mass: f64) -> f64 {
        rounded(mass * self.gravity() / 1000.0)
    }

    /// Depth of the water: WtrDpth, or as deep as the deepest point of the ground.
    fn find_depth(&mut self, options: &Options, span: Span) -> f64 {
        let given = options.depth.as_ref().map(|depth| depth.value.abs()).filter(|depth| *depth > 0.0);
        let fixed = self.deck.points.iter().filter(|point| point.attachment.value == Attachment::Fixed);
        let depth_of = |point: &Point| match point.height.value {
            Height::Given(z) => Some((-z, point.height.span)),
            Height::Seabed => None,
        };
        let deepest =
            fixed.filter_map(depth_of).filter(|(depth, _)| *depth > 0.0).reduce(|a, b| if b.0 > a.0 { b } else { a });
        match (given, deepest) {
            (Some(depth), Some((below, at))) if below > depth + ON_SEABED_M => {
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

    fn refuse_what_is_not_read(&mut self) {
        for rod in &self.deck.rods {
            let text = format!("rod {} is not read into the model: its weight and loads would be lost", rod.id.value);
            self.refuse(rod.id.span, text, "in records a rigid rod is a body of one TUBE: &HELP ~CLASS TUBE");
        }
        let options = &self.deck.options;
        if let Some(given) = options.wave_kinematics.as_ref().filter(|given| given.value > 0) {
            let help = "write 0 WaveKin, and give the sea by -SEA of &ENV";
            self.refuse(given.span, format!("the waves of WaveKin {} are not read", given.value), help);
        }
        if let Some(given) = options.currents.as_ref().filter(|given| given.value > 0) {
            let help = "write 0 Currents, and give the current by -CURRENT of &ENV";
            self.refuse(given.span, format!("the current of Currents {} is not read", given.value), help);
        }
        if let Some(given) = &options.seafloor_file {
            let help = "leave the option out, and give the bottom by &BATHYMETRY and -BATHYMETRY of &ENV";
            self.refuse(given.span, format!("the seafloor file {} is not read", given.value), help);
        }
        if let Some(given) = options.density.as_ref().filter(|given| given.value == 0.0) {
            self.refuse(given.span, "a sea without density", "expected the density of the water (kg/m3), such as 1025");
        }
    }

    fn holder(&self, point: &Point) -> Holder {
        match point.attachment.value {
            Attachment::Free => Holder::Junction,
            Attachment::Coupled | Attachment::CoupledPinned => Holder::Body,
            Attachment::Body(_) | Attachment::BodyPinned(_) => Holder::Body,
            Attachment::Fixed | Attachment::Pinned => Holder::Ground,
        }
    }

    fn place(&self, point: &Point) -> [f64; 3] {
        let [x, y] = point.horizontal;
        let z = match point.height.value {
            Height::Given(z) => z,
            Height::Seabed => -self.depth,
        };
        [x, y, z]
    }

    /// Points of the ground, of the vessel and of bodies, then junctions.
    fn points(&mut self) {
        let deck = self.deck;
        let of = |kind: Attachment| deck.points.iter().filter(move |point| point.attachment.value == kind);
        for point in of(Attachment::Fixed) {
            self.point(point);
        }
        for (index, point) in of(Attachment::Coupled).enumerate() {
            let row = format!("POINTS {}", point.id.value);
            if index == 0 {
                self.record(&row, point.attachment.span, "&DESCRIBE BODY VESSEL");
                self.record(&row, point.attachment.span, "PRESCRIBE VESSEL -SINUSOID X 0 1");
            }
            self.point(point);
        }
        for body in &deck.bodies {
            self.body(body);
            for point in of(Attachment::Body(body.id.value)) {
                self.point(point);
            }
        }
        for point in of(Attachment::Free) {
            self.junction(point);
        }
    }

    fn point(&mut self, point: &Point) {
        if point.height.value == Height::Seabed && point.attachment.value != Attachment::Fixed {
            self.refuse(point.height.span, "a point that is not fixed has no height by the seabed", "expected Z (m)");
        }
        let at = numbers(&self.place(point));
        let id = point.id.value;
        self.record(&format!("POINTS {id}"), point.id.span, &format!("*P{id} {at}"));
    }

    fn junction(&mut self, point: &Point) {
        let row = format!("POINTS {}", point.id.value);
        let span = point.id.span;
        if point.force != [0.0; 3] {
            let text = format!("the constant force on point {} is not read", point.id.value);
            self.refuse(span, text, "FX, FY and FZ of a free point must be 0; Mass and Volume give vertical forces");
        }
        for (given, name) in [(&point.drag_area, "CdA"), (&point.added_mass, "Ca")] {
            // an added mass is a share of the displaced one: without volume it is none
            let acts = given.value > 0.0 && (name == "CdA" || point.volume.value > 0.0);
            if acts && self.model == LineModel::Dynamic {
                let text = format!("{name} of the free point {} is not read: a junction has no {name}", point.id.value);
                self.refuse(
                    given.span,
                    text,
                    "expected 0; INMODEL -MOORDYN FILE -STATIC reads the deck for statics without current",
                );
            } else if acts && name == "CdA" {
                let text = format!("CdA of the free point {} is left out: a current does not push it", point.id.value);
                let warning = Diagnostic::warning(text, given.span);
                self.out.notes.push(*warning.help("the equilibrium is that of the deck in still water alone"));
            }
        }
        let weight = self.weight(point.mass.value);
        let lift = rounded(self.density() * self.gravity() * point.volume.value / 1000.0);
        let mut text = format!("JUNCTION P{} {}", point.id.value, numbers(&self.place(point)));
        if weight > 0.0 {
            text.push_str(&format!(" -WEIGHT {}", number(weight)));
        }
        if lift > 0.0 {
            text.push_str(&format!(" -DISPLACEMENT {}", number(lift)));
        }
        self.record(&row, span, &text);
    }

    fn body(&mut self, body: &Body) {
        let (id, span) = (body.id.value, body.id.span);
        let row = format!("BODIES {id}");
        let name = format!("BODY{id}");
        match body.attachment.value {
            Attachment::Fixed | Attachment::Coupled => {}
            Attachment::CoupledPinned => {
                let help = "expected Coupled, which holds its rotations too, or Fixed";
                self.refuse(body.attachment.span, format!("body {id} with free rotations is not read"), help);
            }
            _ => {
                let help = "expected Coupled or Fixed; in records: #WEIGHT, a piece or #HYDROSTATIC, then PRESCRIBE BODY1 -FREE";
                let text =
                    format!("the loads of the free body {id} are not read: constant volume, drag areas, added mass");
                self.refuse(body.attachment.span, text, help);
            }
        }
        let [.., roll, pitch, yaw] = body.place;
        if [roll, pitch, yaw].iter().filter(|angle| **angle != 0.0).count() > 1 {
            let text = format!("body {id} is turned about more than one axis");
            self.refuse(
                span,
                text,
                "expected one of r0, p0, y0 other than 0: MoorDyn and MoorPy turn in different orders",
            );
        }
        self.record(&row, span, &format!("&DESCRIBE BODY {name}"));
        self.record(&row, span, &format!("&INSTATE -LOCATE {name} {}", numbers(&body.place)));
        self.record(&row, body.attachment.span, &format!("PRESCRIBE {name} -SINUSOID X 0 1"));
        if body.mass.value > 0.0 || body.volume.value > 0.0 {
            let text = format!(
                "body {id} stands still or moves as prescribed: its mass, volume, drag and added mass do nothing"
            );
            self.remark(body.mass.span, text);
        }
    }

    fn line(&mut self, line: &Line) {
        let kind = self.deck.line_types.iter().find(|kind| kind.name.value == line.line_type.value);
        let [a, b] = line.ends.each_ref().map(|end| match end.value {
            LineEnd::Point(id) => id.checked_sub(1).and_then(|index| self.deck.points.get(index)),
            // rods are refused
            LineEnd::RodA(_) | LineEnd::RodB(_) => None,
        });
        let (Some(kind), Some(a), Some(b)) = (kind, a, b) else { return };
        // the first end of a connector is the fairlead: B is MoorDyn's
        let (first, second) = if self.holder(b) == Holder::Ground { (a, b) } else { (b, a) };
        let row = format!("LINES {}", line.id.value);
        let Some(text) = self.class_data(line, kind, first, second) else { return };
        let name = self.class_name(kind, &text);
        let record = format!("CONNECTOR L{} ~{name} *P{} *P{}", line.id.value, first.id.value, second.id.value);
        self.record(&row, line.id.span, &record);
    }

    /// The name of the class of these data, whose record is written when it is new.
    fn class_name(&mut self, kind: &LineType, data: &str) -> String {
        if let Some(name) = self.classes.get(data) {
            return name.clone();
        }
        let kept = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' };
        let base: String = kind.name.value.chars().take(CLASS_NAME_CHARACTERS).map(kept).collect();
        let is_taken = |name: &String| self.classes.values().any(|other| other == name);
        let numbered = (2..).map(|number| format!("{base}_{number}"));
        let name = std::iter::once(base.clone()).chain(numbered).find(|name| !is_taken(name)).unwrap_or(base.clone());
        self.record(&format!("LINE TYPES {}", kind.name.value), kind.name.span, &format!("~{name} {data}"));
        self.classes.insert(data.to_string(), name.clone());
        name
    }

    /// Type and options of the class of a line.
    fn class_data(&mut self, line: &Line, kind: &LineType, first: &Point, second: &Point) -> Option<String> {
        let options = &self.deck.options;
        let diameter = kind.diameter.value;
        let ea = match &kind.stiffness.value {
            AxialStiffness::Linear(ea) => *ea,
            AxialStiffness::Table(file) => {
                let text = format!("the table of stiffness {file} is not read");
                self.refuse(kind.stiffness.span, text, "expected EA (N); in records a table is -STRETCH of class ROD");
                return None;
            }
        };
        let size = number(rounded(diameter * 1000.0));
        let weight = number(self.weight(kind.mass.value));
        let length = number(line.length.value);
        let common = format!("-LEN {length} -WTPLEN {weight}");
        let friction = options.friction.as_ref().map_or(0.0, |given| given.value);
        let friction = if friction > 0.0 { format!(" -FRICTION {}", number(friction)) } else { String::new() };
        if self.model == LineModel::Static {
            let modulus = number(rounded(ea / (PI * diameter * diameter / 4.0) / 1e6));
            if kind.bending.value > 0.0 {
                let text = format!("{}: a static line has no bending stiffness", kind.name.value);
                if !self.out.notes.iter().any(|note| note.message == text) {
                    self.out.notes.push(*Diagnostic::warning(text, kind.bending.span).help("-STATIC takes EI away"));
                }
            }
            let on_bottom = self.place(second)[2] <= -self.depth + ON_SEABED_M;
            return Some(match (self.holder(second), self.holder(first)) {
                (Holder::Ground, Holder::Body | Holder::Junction) if on_bottom => {
                    format!("B_CAT {size} EXACT {common} -EMODULUS {modulus}{friction}")
                }
                _ => {
                    // H_CAT hangs by its weight in air, whatever it displaces
                    let water = self.density() * PI * diameter * diameter / 4.0;
                    let weight = number(self.weight(kind.mass.value - water));
                    self.has_hanging_lines = true;
                    format!("H_CAT {size} EXACT -LEN {length} -WTPLEN {weight} -BUOYDIAMETER 0 -EMODULUS {modulus}")
                }
            });
        }
        let segment = line.length.value / line.segments.value.max(1) as f64;
        let damping = match kind.damping.value {
            share if share < 0.0 => -share * segment * (ea * kind.mass.value).sqrt(),
            given => given,
        };
        let seabed = [
            options.seabed_stiffness.as_ref().map_or(DEFAULT_SEABED[0], |given| given.value),
            options.seabed_damping.as_ref().map_or(DEFAULT_SEABED[1], |given| given.value),
        ];
        Some(format!(
            "ROD {size} {} {common} -REFINE {} -EA {} -EI {} -AX_DAMPING {} -CD {} -CA {} -SEABED {}{friction}",
            number(rounded(diameter * 500.0)),
            line.segments.value,
            number(rounded(ea / 1000.0)),
            number(rounded(kind.bending.value / 1000.0)),
            number(rounded(damping / 1000.0)),
            numbers(&[kind.cd_normal.value, kind.cd_axial.value]),
            numbers(&[kind.ca_normal.value, kind.ca_axial.value]),
            numbers(&seabed.map(|value| rounded(value / 1000.0))),
        ))
    }

    fn notes(&mut self, whole: Span) {
        let options = &self.deck.options;
        let friction = options.friction.as_ref().filter(|given| given.value > 0.0);
        if let (Some(given), LineModel::Dynamic) = (friction, self.model) {
            self.remark(given.span, "friction is Coulomb's: FricDamp and StatDynFricScale, by which MoorDyn builds it up with speed, are not used");
        }
        if let (true, Some(line)) = (self.has_hanging_lines, self.deck.lines.first()) {
            let text = "lines that do not end on the seabed are H_CAT: they have their weight in water, and -DYNAMICS of &CONNECTOR would take it for their mass; without -STATIC they are dynamic lines";
            self.remark(line.id.span, text);
        }
        if !options.unused.is_empty() {
            let names: Vec<&str> = options.unused.iter().map(|(name, _)| name.value.as_str()).collect();
            let at = options.unused.first().map_or(whole, |(name, _)| name.span);
            self.remark(
                at,
                format!("options of MoorDyn's own integration and output are not used: {}", names.join(" ")),
            );
        }
        if let Some(kind) = self.deck.line_types.first() {
            let text = "decks have no breaking tension: ratios to it are of solid steel of Diam and mean nothing; &HELP ~CLASS B_CAT -B_TENSION";
            self.remark(kind.name.span, text);
        }
    }
}
