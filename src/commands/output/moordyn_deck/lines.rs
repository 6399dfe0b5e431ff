//! Connectors as lines, their segments as line types.

use super::system::{DeckWriter, own, rounded};
use std::f64::consts::FRAC_PI_4;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Position;
use windlass_base::table::Table;
use windlass_model::{AxialLaw, Class, Condition, Connector, LineProperties, LineSampling, Model, SegmentProperties};
use windlass_moordyn::tables::{Attachment, AxialStiffness, Line, LineEnd, LineType};

/// Segments of a quasi-static line whose records say nothing of them.
const DEFAULT_SEGMENTS: f64 = 40.0;
/// How far an anchor may stand from the seabed (m) and still be on it.
const ON_SEABED_M: f64 = 1e-3;
/// Most points of a table of stiffness in MoorDyn.
const MAX_STIFFNESS_POINTS: usize = 30;
/// Longest part of a class's name that a line type keeps.
const TYPE_NAME_CHARACTERS: usize = 40;

/// What holds for all lines of a deck, and the line that said it first.
#[derive(Default)]
struct Common {
    friction: Option<(String, f64)>,
    friction_damping: Option<(String, f64)>,
    stiffness: Option<(String, f64)>,
    damping: Option<(String, f64)>,
}

/// One of them.
#[derive(Clone, Copy)]
enum Slot {
    Friction,
    FrictionDamping,
    Stiffness,
    Damping,
}

impl Common {
    fn slot(&mut self, slot: Slot) -> &mut Option<(String, f64)> {
        match slot {
            Slot::Friction => &mut self.friction,
            Slot::FrictionDamping => &mut self.friction_damping,
            Slot::Stiffness => &mut self.stiffness,
            Slot::Damping => &mut self.damping,
        }
    }
}

impl DeckWriter<'_> {
    /// Every connector as lines, and what the bottom does to them.
    pub(super) fn lines(&mut self) -> Outcome<()> {
        let model = self.model;
        let mut common = Common::default();
        for connector in model.connectors.values() {
            if !connector.active {
                self.remark(format!("{} is inactive: it is not in the deck", connector.name));
                continue;
            }
            self.line(connector, &mut common)?;
        }
        let options = &mut self.deck.options;
        options.gravity = Some(own(self.around.gravity));
        options.density = Some(own(self.around.water_density));
        options.depth = Some(own(self.depth));
        options.friction = common.friction.map(|(_, value)| own(rounded(value)));
        options.friction_damping = common.friction_damping.map(|(_, value)| own(rounded(value)));
        options.seabed_stiffness = common.stiffness.map(|(_, value)| own(rounded(value)));
        options.seabed_damping = common.damping.map(|(_, value)| own(rounded(value)));
        Ok(())
    }

    /// Refuses a connector, for a reason.
    fn refuse_line(&self, connector: &Connector, why: &str, help: &[String]) -> Box<Diagnostic> {
        let mut error = Diagnostic::error(format!("a deck cannot hold {}: {why}", connector.name), self.span)
            .other(connector.span, "it is defined here");
        error.help.extend(help.iter().cloned());
        error
    }

    fn properties(&self, connector: &Connector, class: &Class) -> Outcome<LineProperties> {
        let kind = class.object.kind();
        let nothing = || {
            let why = match kind {
                "FIX" => "it is a joint of class type FIX, and what is pinned in MoorDyn 2.7.2 does not feel that its pin accelerates".to_string(),
                _ => format!("a connector of class type {kind} has no counterpart"),
            };
            self.refuse_line(connector, &why, &[])
        };
        if self.model.assembly_of(&connector.name).is_some() {
            return Err(self.refuse_line(connector, "it belongs to an assembly", &[]));
        }
        let segmented = class.object.as_segmented().ok_or_else(nothing)?;
        segmented
            .line_properties(&self.around, connector.dynamics.is_some())
            .map_err(|error| self.refuse_line(connector, &error.text(self.units), &error.help))
    }

    fn line(&mut self, connector: &Connector, common: &mut Common) -> Outcome<()> {
        let class = self.model.classes.get(&Model::key(&connector.class));
        let class = class.ok_or_else(|| self.refuse_line(connector, "its class is not defined", &[]))?;
        let mut properties = self.properties(connector, class)?;
        if let (Some(length), Some(first)) = (connector.first_length, properties.segments.first_mut()) {
            first.length = length;
        }
        let first = self.end(connector, 0)?;
        let first = first.ok_or_else(|| self.refuse_line(connector, "it has no first end", &[]))?;
        let second = match self.end(connector, 1)? {
            Some(end) => end,
            None => {
                let far = self.model.placement(connector).other;
                let at = far.ok_or_else(|| self.refuse_line(connector, "its anchor has no place", &[]))?;
                let id = self.add_point(Attachment::Fixed, at);
                self.head(format!("point {id}: the anchor of {}", connector.name));
                LineEnd::Point(id)
            }
        };
        self.bottom(connector, &properties, common)?;
        let ends = self.ends_of(connector);
        let joints = self.joints(connector, class, &properties, ends);
        let counts = segment_counts(connector, &properties);
        // the second end of a connector is MoorDyn's end A
        let count = properties.segments.len();
        let mut from = second;
        for index in (0..count).rev() {
            let Some(segment) = properties.segments.get(index) else { continue };
            let to = match index.checked_sub(1) {
                None => first,
                Some(before) => {
                    let at = joints.get(before).copied().unwrap_or_default();
                    LineEnd::Point(self.joint(at, properties.segments.get(before)))
                }
            };
            let line_type = self.line_type(connector, class, segment)?;
            let id = self.deck.lines.len() + 1;
            let name =
                if count > 1 { format!("{} segment {}", connector.name, index + 1) } else { connector.name.clone() };
            self.head(format!("line {id}: {name}"));
            self.deck.lines.push(Line {
                id: own(id),
                line_type: own(line_type),
                ends: [own(from), own(to)],
                length: own(segment.length),
                segments: own(counts.get(index).copied().unwrap_or(1)),
                outputs: own("-".to_string()),
                has_contact: true,
            });
            from = to;
        }
        Ok(())
    }

    /// Both ends of a connector (m).
    fn ends_of(&self, connector: &Connector) -> [Position; 2] {
        let placement = self.model.placement(connector);
        [placement.fairlead, placement.other.unwrap_or(placement.fairlead)]
    }

    /// A free point between two segments, with what the first of them attaches there.
    fn joint(&mut self, at: Position, segment: Option<&SegmentProperties>) -> usize {
        let id = self.add_point(Attachment::Free, at);
        let density = self.around.water_density;
        if let (Some(attached), Some(point)) = (segment.and_then(|s| s.attached), self.deck.points.last_mut()) {
            point.mass = own(rounded(attached.mass));
            point.volume = own(rounded(attached.volume));
            point.drag_area = own(rounded(attached.drag_area));
            let displaced = attached.volume * density;
            point.added_mass = own(if displaced > 0.0 { rounded(attached.added / displaced) } else { 0.0 });
        }
        id
    }

    /// Where the ends of inner segments stand: of a quasi-static line as it hangs, else on the chord.
    fn joints(
        &self,
        connector: &Connector,
        class: &Class,
        properties: &LineProperties,
        [first, second]: [Position; 2],
    ) -> Vec<Position> {
        let whole: f64 = properties.segments.iter().map(|segment| segment.length).sum();
        let mut passed = 0.0;
        let chord = properties.segments.iter().map(|segment| {
            passed += segment.length;
            let share = if whole > 0.0 { passed / whole } else { 0.0 };
            let [x, y, z] = [0, 1, 2].map(|axis| first[axis] + (second[axis] - first[axis]) * share);
            [x, y, z.max(-self.depth)]
        });
        let chord: Vec<Position> = chord.collect();
        if properties.segments.len() < 2 {
            return chord;
        }
        let placement = self.model.placement(connector);
        let shape = class
            .line(&placement, &self.around)
            .and_then(|line| line.geometry(&connector.name, Condition::Placed, LineSampling::Inside(1)));
        let Ok(shape) = shape else { return chord };
        let (distance, [along, across]) = placement.span();
        let joint = |index: usize| -> Option<Position> {
            let [passed, z, span] = at_end_of(&shape, index + 1)?;
            let share = if span > 0.0 { passed / span } else { 0.0 };
            let [fx, fy, _] = first;
            Some([fx + along * distance * share, fy + across * distance * share, z])
        };
        (0..properties.segments.len())
            .map(|index| joint(index).or(chord.get(index).copied()).unwrap_or_default())
            .collect()
    }

    /// What the bottom does is the same for all lines of a deck.
    fn bottom(&self, connector: &Connector, properties: &LineProperties, common: &mut Common) -> Outcome<()> {
        let Some(seabed) = properties.seabed else { return Ok(()) };
        let [_, [_, _, anchor]] = self.ends_of(connector);
        let is_static = connector.dynamics.is_none()
            && self.model.classes.get(&Model::key(&connector.class)).is_some_and(|c| c.object.as_line().is_some());
        let bottom = match seabed.depth {
            Some(depth) => Some(-depth),
            // a quasi-static line lies on a plane through its anchor
            None if is_static => Some(anchor),
            None => None,
        };
        let has_grid = self.model.bathymetry_in(&self.model.environment).is_some();
        if let Some(bottom) = bottom.filter(|bottom| !has_grid && (bottom + self.depth).abs() > ON_SEABED_M) {
            let text = format!(
                "it lies on a bottom at {:.3} m, and the depth of the environment is {:.3} m",
                bottom, self.depth
            );
            return Err(self.refuse_line(connector, &text, &["decks have one depth: &ENV -DEPTH".to_string()]));
        }
        let mut given = vec![
            (Slot::Friction, Some(seabed.friction), "friction of the seabed"),
            (Slot::Stiffness, seabed.stiffness, "stiffness of the seabed"),
            (Slot::Damping, seabed.damping, "damping of the seabed"),
        ];
        // MoorDyn's is of a node, whatever lies with it
        for (segment, count) in properties.segments.iter().zip(segment_counts(connector, properties)) {
            let node = segment.outside * segment.length / count.max(1) as f64;
            given.push((
                Slot::FrictionDamping,
                seabed.friction_damping.map(|rate| rate * node),
                "friction by speed of a node",
            ));
        }
        for (slot, value, what) in given {
            let Some(value) = value else { continue };
            match common.slot(slot) {
                Some((name, other)) if (*other - value).abs() > 1e-9 * other.abs().max(value.abs()) => {
                    let text = format!("its {what} is not that of {name}: decks have one");
                    return Err(self.refuse_line(connector, &text, &[]));
                }
                Some(_) => {}
                slot @ None => *slot = Some((connector.name.clone(), value)),
            }
        }
        Ok(())
    }

    /// The line type of a segment; returns its name.
    fn line_type(&mut self, connector: &Connector, class: &Class, segment: &SegmentProperties) -> Outcome<String> {
        let water = self.around.water_density;
        // a line that hangs by its weight in water has the mass that weighs so with the volume of its outside
        let hangs = segment.displaced <= 0.0;
        let displaced = if hangs { FRAC_PI_4 * segment.outside * segment.outside } else { segment.displaced };
        let diameter = (displaced / FRAC_PI_4).sqrt();
        if diameter.is_nan() || diameter <= 0.0 {
            return Err(self.refuse_line(connector, "it has no volume", &["-BUOYDIAMETER gives it one".to_string()]));
        }
        let mass = if hangs { segment.mass + water * displaced } else { segment.mass };
        let scale = segment.drag_diameter / diameter;
        let share = segment.added_area / displaced;
        let [cd_normal, cd_axial] = segment.drag.map(|cd| own(rounded(cd * scale)));
        let [ca_normal, ca_axial] = segment.added.map(|ca| own(rounded(ca * share)));
        let name = self.type_name(class);
        let stiffness = match &segment.axial {
            AxialLaw::Linear(ea) => AxialStiffness::Linear(rounded(*ea)),
            AxialLaw::Table(points) => AxialStiffness::Table(self.stiffness_file(connector, &name, points)?),
        };
        let made = LineType {
            name: own(name),
            diameter: own(rounded(diameter)),
            mass: own(rounded(mass)),
            stiffness: own(stiffness),
            damping: own(rounded(segment.axial_damping)),
            bending: own(rounded(segment.bending)),
            cd_normal,
            ca_normal,
            cd_axial,
            ca_axial,
            friction: None,
        };
        if segment.has_bore {
            let text = format!("{}: pressure on the wall of a tube stretches it, which MoorDyn leaves out", class.name);
            if !self.notes.iter().any(|note| note.message == text) {
                self.remark(text);
            }
        }
        let same = |other: &&LineType| LineType { name: made.name.clone(), ..(*other).clone() } == made;
        if let Some(known) = self.deck.line_types.iter().find(same) {
            return Ok(known.name.value.clone());
        }
        let name = made.name.value.clone();
        self.deck.line_types.push(made);
        Ok(name)
    }

    /// A name that no line type has yet.
    fn type_name(&self, class: &Class) -> String {
        let base = base_name(class);
        let is_taken = |name: &String| self.deck.line_types.iter().any(|kind| kind.name.value == *name);
        let numbered = (2..).map(|number| format!("{base}_{number}"));
        std::iter::once(base.clone()).chain(numbered).find(|name| !is_taken(name)).unwrap_or(base.clone())
    }

    /// The file of a table of stiffness; returns its name.
    fn stiffness_file(&mut self, connector: &Connector, name: &str, points: &[(f64, f64)]) -> Outcome<String> {
        if points.len() > MAX_STIFFNESS_POINTS {
            let text =
                format!("its table of stiffness has {} points: MoorDyn reads {MAX_STIFFNESS_POINTS}", points.len());
            return Err(self.refuse_line(connector, &text, &[]));
        }
        let rows: Vec<String> = points.iter().map(|(strain, tension)| format!("{strain} {tension}")).collect();
        // MoorDyn refuses a line break behind the last row
        let text = format!("tension by strain\nstrain tension\n(-) (N)\n{}", rows.join("\n"));
        let known = self.files.iter().find(|(_, other)| *other == text).map(|(file, _)| file.clone());
        let file = match known {
            Some(file) => file,
            None => {
                let file = self.beside(&format!("{}_stiffness.txt", name.to_ascii_lowercase()));
                self.files.push((file.clone(), text));
                file
            }
        };
        let inside = std::path::Path::new(&file).file_name().map(|name| name.to_string_lossy().into_owned());
        Ok(inside.unwrap_or(file))
    }
}

/// The name of a class as that of a line type.
fn base_name(class: &Class) -> String {
    class.name.trim_start_matches('~').chars().take(TYPE_NAME_CHARACTERS).collect()
}

/// Horizontal distance from the first end, height, and the whole distance (m), where a segment of a line ends.
fn at_end_of(shape: &Table, segment: usize) -> Option<[f64; 3]> {
    let column = |name: &str| shape.get(name).map(|column| column.numbers());
    let (x, z, segments) = (column("X")?, column("Z")?, column("Segment")?);
    let last = segments.iter().rposition(|number| *number == segment as f64)?;
    let (from, to) = (*x.first()?, *x.last()?);
    Some([(*x.get(last)? - from).abs(), *z.get(last)?, (to - from).abs()])
}

/// Segments of MoorDyn in each segment of a line.
fn segment_counts(connector: &Connector, properties: &LineProperties) -> Vec<usize> {
    let whole: f64 = properties.segments.iter().map(|segment| segment.length).sum();
    let wanted = connector.dynamics.map_or(DEFAULT_SEGMENTS, |count| count as f64);
    let of = |segment: &SegmentProperties| match (segment.elements, connector.dynamics) {
        (Some(count), None) => count,
        (given, _) => {
            let share = if whole > 0.0 { (wanted * segment.length / whole).round() as usize } else { 1 };
            share.max(given.unwrap_or(1)).max(1)
        }
    };
    properties.segments.iter().map(of).collect()
}
