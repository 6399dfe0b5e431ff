//! Lines of a deck as classes and connectors.

use super::{Held, Holder, Like, LineModel, ON_SEABED_M, Writer, number, numbers, rounded};
use crate::files;
use crate::tables::{AxialStiffness, Line, LineEnd, LineType};
use std::f64::consts::PI;
use windlass_base::diagnostic::Diagnostic;

/// MoorDyn's stiffness (Pa/m) and damping (Pa s/m) of the seabed where the deck gives none.
const DEFAULT_SEABED: [f64; 2] = [3e6, 3e5];
/// MoorDyn's FricDamp (N s/m of a node at a coefficient of 1) where the deck gives none.
const DEFAULT_FRICTION_DAMPING: f64 = 200.0;
/// Longest part of a type's name that a class keeps: names have 64 characters, and a number may follow.
const CLASS_NAME_CHARACTERS: usize = 40;

impl Writer<'_> {
    pub(super) fn line(&mut self, line: &Line) {
        let kind = self.deck.line_types.iter().find(|kind| kind.name.value == line.line_type.value);
        let [a, b] = line.ends.each_ref().map(|end| self.holding(end.value));
        let (Some(kind), Some(a), Some(b)) = (kind, a, b) else { return };
        if kind.bending.value > 0.0 && self.model == LineModel::Dynamic {
            let rods = line.ends.iter().filter(|end| !matches!(end.value, LineEnd::Point(_)));
            for end in rods.collect::<Vec<_>>() {
                let text = format!("the end of line {} bends with its rod, which is not read", line.id.value);
                let help = "expected EI 0, or a point on the rod's body: lines are hinged at their ends";
                self.refuse(end.span, text, help);
            }
        }
        // the first end of a connector is the fairlead: B is MoorDyn's
        let (first, second) = if b.holder == Holder::Ground { (a, b) } else { (b, a) };
        let row = format!("LINES {}", line.id.value);
        let Some(text) = self.class_data(line, kind, &first, &second) else { return };
        let name = self.class_name(kind, &text);
        let record = format!("CONNECTOR L{} ~{name} {} {}", line.id.value, first.name, second.name);
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
    fn class_data(&mut self, line: &Line, kind: &LineType, first: &Held, second: &Held) -> Option<String> {
        let options = &self.deck.options;
        let diameter = kind.diameter.value;
        let (ea, stretch) = match &kind.stiffness.value {
            AxialStiffness::Linear(ea) => (*ea, None),
            AxialStiffness::Table(file) => {
                if self.model == LineModel::Static {
                    let text = format!("the table of stiffness {file} is not read for static lines");
                    self.refuse(kind.stiffness.span, text, "expected EA (N), or no -STATIC");
                    return None;
                }
                if kind.damping.value < 0.0 {
                    let text = "a share of critical damping needs EA: a table has no one stiffness";
                    self.refuse(kind.damping.span, text, "expected BA (N s), 0 or more");
                    return None;
                }
                let table = self.parse((file, kind.stiffness.span), files::stiffness_table)?;
                let words: Vec<String> = table.iter().map(|(e, t)| numbers(&[rounded(t / 1000.0), *e])).collect();
                (0.0, Some(format!("-STRETCH {}", words.join(" "))))
            }
        };
        let size = number(rounded(diameter * 1000.0));
        let weight = number(self.weight(kind.mass.value));
        let length = number(line.length.value);
        let common = format!("-LEN {length} -WTPLEN {weight}");
        let coefficient = kind.friction.as_ref().or(options.friction.as_ref()).map_or(0.0, |given| given.value);
        let friction = if coefficient > 0.0 { format!(" -FRICTION {}", number(coefficient)) } else { String::new() };
        if self.model == LineModel::Static {
            let modulus = number(rounded(ea / (PI * diameter * diameter / 4.0) / 1e6));
            if kind.bending.value > 0.0 {
                let text = format!("{}: a static line has no bending stiffness", kind.name.value);
                if !self.out.notes.iter().any(|note| note.message == text) {
                    self.out.notes.push(*Diagnostic::warning(text, kind.bending.span).help("-STATIC takes EI away"));
                }
            }
            let on_bottom = second.height <= -self.depth + ON_SEABED_M && line.has_contact;
            return Some(match (second.holder, first.holder) {
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
        // MoorDyn's friction is of a node, whatever lies with it; across a line it is that along it
        let mut bottom = numbers(&seabed.map(|value| rounded(value / 1000.0)));
        if self.like == Like::MoorDyn {
            if !friction.is_empty() {
                let damping = options.friction_damping.as_ref().map_or(DEFAULT_FRICTION_DAMPING, |given| given.value);
                let area = diameter * segment;
                bottom.push_str(&format!(" {} {}", number(coefficient), number(rounded(damping / area / 1000.0))));
            }
            if options.seafloor_file.is_some() {
                bottom.push_str(" -VERTICAL_PUSH");
            }
            bottom.push_str(" -MID_TENSION");
        }
        Some(format!(
            "ROD {size} {} {common} -REFINE {} {} -EI {} -AX_DAMPING {} -CD {} -CA {} -SEABED {}{friction}",
            number(rounded(diameter * 500.0)),
            line.segments.value,
            stretch.unwrap_or_else(|| format!("-EA {}", number(rounded(ea / 1000.0)))),
            number(rounded(kind.bending.value / 1000.0)),
            number(rounded(damping / 1000.0)),
            numbers(&[kind.cd_normal.value, kind.cd_axial.value]),
            numbers(&[kind.ca_normal.value, kind.ca_axial.value]),
            bottom,
        ))
    }
}
