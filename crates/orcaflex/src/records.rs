//! A text model as records of windlass: what a script of the same system says. The session runs these records and nothing else.
//!
//! Numbers are in `&DIMEN -DIMEN METERS K-NTS`. Vessels are bodies that stand still until PRESCRIBE gives them a motion, lines connectors that begin at
//! their end A, or at B where A alone is in the ground.

use crate::Given;
use crate::model::{Holder, Line, LineEnd, LineType, TextModel, WaveTrain};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_4;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// OrcaFlex's density of sea water (te/m3) where the model gives none.
const DEFAULT_DENSITY: f64 = 1.025;
/// OrcaFlex's g (m/s2).
const GRAVITY: f64 = 9.80665;
/// Longest part of a name that is kept.
const NAME_CHARACTERS: usize = 40;
/// How far an anchor may stand from the seabed (m), in outer diameters, and still be on it.
const ON_SEABED_DIAMETERS: f64 = 1.0;

/// How lines are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineModel {
    /// As dynamic lines (class ROD) of the segments of the model.
    Dynamic,
    /// As quasi-static lines: B_CAT to anchors on the seabed, else H_CAT.
    Static,
}

/// The object that a record is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectOrigin {
    /// Section and name, as `Lines leg`.
    pub object: String,
    /// The place of its name.
    pub span: Span,
}

/// A text model as records, one a line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Records {
    /// The records.
    pub text: String,
    /// From which byte on the text is made of which object, in order.
    pub origins: Vec<(usize, ObjectOrigin)>,
    /// What was assumed.
    pub notes: Vec<Diagnostic>,
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
    values.iter().map(|value| number(rounded(*value))).collect::<Vec<_>>().join(" ")
}

/// Where a direction toward (deg) comes from.
fn from(toward: f64) -> f64 {
    rounded((toward + 180.0).rem_euclid(360.0))
}

struct Writer<'a> {
    model: &'a TextModel,
    lines: LineModel,
    depth: f64,
    /// Density (te/m3).
    density: f64,
    out: Records,
    wrong: Vec<Diagnostic>,
    /// Names of the model that are taken, in upper case.
    taken: Vec<String>,
    /// Bodies by the names of their vessels.
    bodies: BTreeMap<&'a str, String>,
    points: usize,
}

/// The records of a model that was read without an error.
///
/// # Errors
/// What bears a load and is not read: a model without depth, two seas.
pub fn records(model: &TextModel, lines: LineModel) -> Result<Records, Vec<Diagnostic>> {
    let density = model.environment.density.as_ref().map_or(DEFAULT_DENSITY, |given| given.value);
    let depth = model.environment.depth.as_ref().map_or(f64::NAN, |given| given.value);
    let mut writer = Writer {
        model,
        lines,
        depth,
        density,
        out: Records::default(),
        wrong: Vec::new(),
        taken: Vec::new(),
        bodies: BTreeMap::new(),
        points: 0,
    };
    writer.write();
    if writer.wrong.is_empty() { Ok(writer.out) } else { Err(writer.wrong) }
}

impl<'a> Writer<'a> {
    fn record(&mut self, object: &str, span: Span, text: &str) {
        self.out.origins.push((self.out.text.len(), ObjectOrigin { object: object.to_string(), span }));
        self.out.text.push_str(text);
        self.out.text.push('\n');
    }

    fn refuse(&mut self, span: Span, message: impl Into<String>, help: &str) {
        self.wrong.push(*Diagnostic::error(message, span).help(help.to_string()));
    }

    /// A name of windlass for one of the model, that nothing has yet.
    fn name(&mut self, given: &str, else_begins: &str) -> String {
        let kept = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' };
        let plain: String = given.chars().take(NAME_CHARACTERS).map(kept).collect();
        let begins = plain.starts_with(|c: char| c.is_ascii_alphabetic());
        let base = if begins { plain } else { format!("{else_begins}{plain}") };
        let numbered = (2..).map(|number| format!("{base}_{number}"));
        let free = std::iter::once(base.clone()).chain(numbered).find(|name| !self.taken.contains(name));
        let name = free.unwrap_or(base);
        self.taken.push(name.clone());
        name
    }

    fn write(&mut self) {
        let model = self.model;
        let first = model.lines.first().map(|line| line.name.span).unwrap_or_default();
        let around = model.environment.span.unwrap_or(first);
        if self.depth.is_nan() {
            self.refuse(around, "the model gives no depth of the water", "add WaterDepth to Environment");
            return;
        }
        self.record("General", around, "&DIMEN -SAVE -DIMEN METERS K-NTS");
        let depth = number(self.depth);
        let water =
            format!("&DEFAULT -WATER {} -GRAVITY {GRAVITY} -DEPTH {depth}", number(rounded(self.density * 1000.0)));
        self.record("Environment", around, &water);
        let said = self.water(around);
        self.record("Environment", around, &format!("&ENV ORCAFLEX -DEPTH {depth}{said}"));
        self.record("Environment", around, "MEDIT");
        self.ground_points();
        for vessel in &model.vessels {
            let name = self.name(&vessel.name.value, "V");
            let object = format!("Vessels {}", vessel.name.value);
            let place: Vec<f64> = vessel.position.iter().chain(&vessel.orientation).copied().collect();
            self.record(&object, vessel.name.span, &format!("&DESCRIBE BODY {name}"));
            self.record(&object, vessel.name.span, &format!("&INSTATE -LOCATE {name} {}", numbers(&place)));
            self.record(&object, vessel.name.span, &format!("PRESCRIBE {name} -SINUSOID X 0 1"));
            self.bodies.insert(vessel.name.value.as_str(), name);
            self.vessel_points(&vessel.name);
        }
        if let Some(vessel) = model.vessels.first() {
            let text = "vessels stand still at their places until PRESCRIBE moves them: their types are not read";
            self.out.notes.push(*Diagnostic::remark(text, vessel.name.span));
        }
        for (index, line) in model.lines.iter().enumerate() {
            self.line(index, line);
        }
        self.record("Lines", around, "END");
        self.record("General", around, "&DIMEN -REMEMBER");
        if let Some(kind) = model.line_types.first() {
            let text = "AllowableTension is no breaking tension: ratios to it are of solid steel of OD and mean nothing; &HELP ~CLASS B_CAT -B_TENSION";
            self.out.notes.push(*Diagnostic::remark(text, kind.name.span));
        }
    }

    /// Curves, and what the environment says of waves, current and wind.
    fn water(&mut self, around: Span) -> String {
        let env = &self.model.environment;
        let mut said = String::new();
        if let Some([speed, toward]) = &env.current {
            if env.current_profile.is_empty() {
                said.push_str(&format!(" -CURRENT {} {}", number(speed.value), number(from(toward.value))));
            } else {
                let mut list = String::new();
                for (name, turn, direction) in [("ORCAFLEX_X", 0.0, 180.0), ("ORCAFLEX_Y", 90.0, 270.0)] {
                    let part = |[depth, factor, rotation]: &[f64; 3]| {
                        let angle = (toward.value + rotation - turn).to_radians();
                        [*depth, speed.value * factor * angle.cos()]
                    };
                    let mut rows: Vec<[f64; 2]> = env.current_profile.iter().map(part).collect();
                    if rows.iter().all(|[_, velocity]| velocity.abs() < 1e-12) {
                        continue;
                    }
                    // a curve has two points, and is constant beyond them
                    if let [[depth, velocity]] = rows[..] {
                        rows.push([depth + 1.0, velocity]);
                    }
                    let words: Vec<String> = rows.iter().map(|row| numbers(row)).collect();
                    self.record(
                        "Environment",
                        speed.span,
                        &format!("&DATA CURVES C_PROFILE {name} {}", words.join(" ")),
                    );
                    list.push_str(&format!(" {name} {}", number(direction)));
                }
                if !list.is_empty() {
                    said.push_str(&format!(" -CURRENT{list}"));
                }
            }
        }
        if let Some([speed, toward]) = &env.wind {
            said.push_str(&format!(" -WIND {} {}", number(speed.value), number(from(toward.value))));
        }
        match env.waves.as_slice() {
            [] => {}
            [WaveTrain::Airy { toward, height, period, .. }] => {
                said.push_str(&format!(" -SEA REGULAR {} {}", number(from(*toward)), numbers(&[*height, *period])));
            }
            [WaveTrain::Jonswap { toward, height, period, gamma, .. }] => {
                let values = numbers(&[*height, *period, *gamma]);
                said.push_str(&format!(" -SP_TYPE PEAK -SEA JONSWAP {} {values}", number(from(*toward))));
                let text = "components and phases of the sea are those of &ENV -COMPONENTS and -SEED";
                self.out.notes.push(*Diagnostic::remark(text, around));
            }
            [_, WaveTrain::Airy { span, .. } | WaveTrain::Jonswap { span, .. }, ..] => {
                let span = *span;
                self.refuse(span, "a second wave train is not read: its loads would be lost", "&ENV -A_SEA adds it");
            }
        }
        said
    }

    /// The place of an end in space, or in the axes of its vessel.
    fn place(&self, end: &LineEnd) -> [f64; 3] {
        let [x, y, z] = end.at;
        if end.holder.value == Holder::Anchored { [x, y, z - self.depth] } else { [x, y, z] }
    }

    /// Points of the ground: ends that are fixed or anchored, named by line and end.
    fn ground_points(&mut self) {
        let model = self.model;
        for (index, line) in model.lines.iter().enumerate() {
            for (letter, end) in ['A', 'B'].into_iter().zip(&line.ends) {
                if !matches!(end.holder.value, Holder::Vessel(_)) {
                    let mut place = self.place(end);
                    if self.is_on_seabed(line, end) {
                        place[2] = -self.depth;
                    }
                    self.point(index, line, letter, place);
                }
            }
        }
    }

    fn vessel_points(&mut self, vessel: &Given<String>) {
        let model = self.model;
        for (index, line) in model.lines.iter().enumerate() {
            for (letter, end) in ['A', 'B'].into_iter().zip(&line.ends) {
                if end.holder.value == Holder::Vessel(vessel.value.clone()) {
                    self.point(index, line, letter, end.at);
                }
            }
        }
    }

    fn point(&mut self, index: usize, line: &Line, letter: char, at: [f64; 3]) {
        self.points += 1;
        let record = format!("*L{}{letter} {}", index + 1, numbers(&at));
        self.record(&format!("Lines {}", line.name.value), line.name.span, &record);
    }

    fn kind(&self, name: &str) -> Option<&'a LineType> {
        self.model.line_types.iter().find(|kind| kind.name.value == name)
    }

    /// Whether an end lies on the seabed: anchored at about half a diameter above it, where the middle of a line lies.
    fn is_on_seabed(&self, line: &Line, end: &LineEnd) -> bool {
        let outer =
            line.sections.iter().filter_map(|section| self.kind(&section.line_type.value)).map(|kind| kind.outer.value);
        let widest = outer.fold(0.0, f64::max);
        let [_, _, z] = self.place(end);
        !matches!(end.holder.value, Holder::Vessel(_)) && z <= -self.depth + ON_SEABED_DIAMETERS * widest
    }

    fn line(&mut self, index: usize, line: &Line) {
        let object = format!("Lines {}", line.name.value);
        let [a, b] = &line.ends;
        let in_ground = |end: &LineEnd| !matches!(end.holder.value, Holder::Vessel(_));
        let below = |end: &LineEnd| self.place(end)[2];
        // the first end of a connector is the fairlead
        let reverse = in_ground(a) && (!in_ground(b) || below(a) < below(b));
        let (first, second, far) = if reverse { ('B', 'A', a) } else { ('A', 'B', b) };
        let grounded = self.is_on_seabed(line, far);
        let class = self.name(&line.name.value, "L");
        let sections: Vec<_> =
            if reverse { line.sections.iter().rev().collect() } else { line.sections.iter().collect() };
        for section in sections {
            let Some(kind) = self.kind(&section.line_type.value) else { continue };
            let data = self.section(kind, section.length.value, section.segments, line.contents, grounded);
            self.record(&format!("LineTypes {}", kind.name.value), section.line_type.span, &format!("~{class} {data}"));
        }
        let number = index + 1;
        let record = format!("CONNECTOR {class} ~{class} *L{number}{first} *L{number}{second}");
        self.record(&object, line.name.span, &record);
    }

    /// Type and options of a section's class.
    fn section(&self, kind: &LineType, length: f64, segments: usize, contents: f64, grounded: bool) -> String {
        let outer = kind.outer.value;
        let mass = kind.mass.value + contents * FRAC_PI_4 * kind.inner * kind.inner;
        let weight = |mass: f64| number(rounded(mass * GRAVITY));
        let size = number(rounded(outer * 1000.0));
        let drag =
            kind.drag_diameter.map_or(String::new(), |d| format!(" -DRAGDIAMETER {}", number(rounded(d * 1000.0))));
        let friction =
            if kind.friction > 0.0 { format!(" -FRICTION {}", number(kind.friction)) } else { String::new() };
        let length = number(length);
        if self.lines == LineModel::Static {
            // MPa of the full area
            let modulus = number(rounded(kind.ea.value / (FRAC_PI_4 * outer * outer) / 1000.0));
            if grounded {
                return format!(
                    "B_CAT {size} EXACT -LEN {length} -WTPLEN {} -EMODULUS {modulus}{friction}",
                    weight(mass)
                );
            }
            // H_CAT hangs by its weight in air, whatever it displaces
            let wet = weight(mass - self.density * FRAC_PI_4 * outer * outer);
            return format!("H_CAT {size} EXACT -LEN {length} -WTPLEN {wet} -BUOYDIAMETER 0 -EMODULUS {modulus}");
        }
        let stiffness = self.model.environment.seabed_stiffness.as_ref();
        let seabed = stiffness.map_or(String::new(), |given| format!(" -SEABED {}", number(given.value)));
        format!(
            "ROD {size} {} -LEN {length} -WTPLEN {} -REFINE {segments} -EA {} -EI {} -POI_RAT 0.5 -CD {} -CA {}{drag}{seabed}{friction}",
            number(rounded(outer * 500.0)),
            weight(mass),
            number(kind.ea.value),
            number(kind.ei),
            numbers(&kind.drag),
            numbers(&kind.added),
        )
    }
}
