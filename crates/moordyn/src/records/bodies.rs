//! Points, bodies and rods of a deck.

use super::{Held, Holder, Like, Writer, number, numbers, rounded};
use crate::Given;
use crate::tables::{Attachment, Body, Height, LineEnd, Point, Rod, RodType};
use std::f64::consts::PI;
use windlass_base::span::Span;

/// The pin that holds no twist, among those by their axes.
const BALL: usize = 3;
/// Waves act by drag alone on points and bodies of MoorDyn.
const NO_WAVE_INERTIA: &str = " -NO_WAVE_INERTIA";
/// A prescribed motion that is none: what is coupled stands still until the user moves it.
const STILL: &str = "-SINUSOID X 0 1";

/// Three values of a deck that has one for all or three.
fn three(values: &[f64]) -> [f64; 3] {
    match *values {
        [x, y, z, ..] => [x, y, z],
        [one, ..] => [one; 3],
        [] => [0.0; 3],
    }
}

/// Drag areas along and about the axes: one value is all six, two are the three along and the three about, of three each is both, six are six.
fn drag_areas(values: &[f64]) -> [[f64; 3]; 2] {
    match *values {
        [along, about] => [[along; 3], [about; 3]],
        [x, y, z, rx, ry, rz, ..] => [[x, y, z], [rx, ry, rz]],
        _ => [three(values); 2],
    }
}

/// What the water does at a point: volume (m3), drag areas (m2, m5), coefficients of added mass.
struct InWater {
    volume: f64,
    areas: [[f64; 3]; 2],
    added: [f64; 3],
}

impl InWater {
    /// The record of it at a point; none where the water does nothing. A body of MoorDyn keeps its whole volume above the surface too.
    fn record(&self, point: &str, like: Like) -> Option<String> {
        let [along, about] = &self.areas;
        let acts = self.volume > 0.0 || along.iter().chain(about).any(|area| *area > 0.0);
        acts.then(|| {
            let mut text = format!("#LUMP {point} {}", number(self.volume));
            for (option, values) in [("-DRAG", along), ("-R_DRAG", about), ("-AMASS", &self.added)] {
                if values.iter().any(|value| *value > 0.0) {
                    text.push_str(&format!(" {option} {}", numbers(values)));
                }
            }
            text.push_str(" -CONSTANT");
            if like == Like::MoorDyn && self.volume > 0.0 {
                text.push_str(NO_WAVE_INERTIA);
            }
            text
        })
    }
}

/// The axes of a rod: end A is the origin, and z, or x of a rod that is nearly level, stands along it, upward or ahead.
struct RodAxes {
    /// Roll, pitch and yaw (deg).
    turn: [f64; 3],
    /// The axis along the rod.
    axis: usize,
    /// Where end B is on it (m).
    end: f64,
}

impl RodAxes {
    /// Those of a rod; none of one without length.
    fn new(rod: &Rod) -> Option<Self> {
        let [a, b] = &rod.ends;
        let length = rod_length(rod);
        if length == 0.0 {
            return None;
        }
        let [x, y, z] = [0, 1, 2].map(|axis| (b[axis] - a[axis]) / length);
        let level = x.hypot(y);
        if z.abs() >= level {
            // upward: a body that hangs head down would count as capsized
            let sense = if z < 0.0 { -1.0 } else { 1.0 };
            let yaw = if level == 0.0 { 0.0 } else { (sense * y).atan2(sense * x).to_degrees() };
            let pitch = level.atan2(sense * z).to_degrees();
            return Some(RodAxes { turn: [0.0, rounded(pitch), rounded(yaw)], axis: 2, end: rounded(sense * length) });
        }
        let (pitch, yaw) = ((-z).atan2(level).to_degrees(), y.atan2(x).to_degrees());
        Some(RodAxes { turn: [0.0, rounded(pitch), rounded(yaw)], axis: 0, end: rounded(length) })
    }

    /// A place along the rod, from 0 at A to 1 at B.
    fn place(&self, share: f64) -> [f64; 3] {
        self.along(rounded(self.end * share), 0.0)
    }

    /// Three values, one along the rod and the other two across it.
    fn along(&self, along: f64, across: f64) -> [f64; 3] {
        let mut values = [across; 3];
        if let Some(value) = values.get_mut(self.axis) {
            *value = along;
        }
        values
    }
}

impl Writer<'_> {
    pub(super) fn holder(&self, point: &Point) -> Holder {
        match point.attachment.value {
            Attachment::Free => Holder::Junction,
            Attachment::Coupled | Attachment::CoupledPinned => Holder::Body,
            Attachment::Body(_) | Attachment::BodyPinned(_) => Holder::Body,
            Attachment::Fixed | Attachment::Pinned => Holder::Ground,
        }
    }

    /// What holds an end of a line; none of an id that the deck does not have.
    pub(super) fn holding(&self, end: LineEnd) -> Option<Held> {
        match end {
            LineEnd::Point(id) => {
                let point = self.deck.points.get(id.checked_sub(1)?)?;
                let [_, _, height] = self.place(point);
                Some(Held { name: format!("*P{id}"), holder: self.holder(point), height })
            }
            LineEnd::RodA(id) | LineEnd::RodB(id) => {
                let rod = self.deck.rods.get(id.checked_sub(1)?)?;
                let (letter, [_, _, height]) =
                    if matches!(end, LineEnd::RodA(_)) { ('A', rod.ends[0]) } else { ('B', rod.ends[1]) };
                let is_fixed = rod.attachment.value == Attachment::Fixed;
                let holder = if is_fixed { Holder::Ground } else { Holder::Body };
                Some(Held { name: format!("*R{id}{letter}"), holder, height })
            }
        }
    }

    pub(super) fn place(&self, point: &Point) -> [f64; 3] {
        let [x, y] = point.horizontal;
        let z = match point.height.value {
            Height::Given(z) => z,
            Height::Seabed => -self.depth,
        };
        [x, y, z]
    }

    /// Points of the ground and fixed rods, then what is on the vessel, bodies with their points and rods, junctions.
    pub(super) fn points(&mut self) {
        let deck = self.deck;
        let of = |kind: Attachment| deck.points.iter().filter(move |point| point.attachment.value == kind);
        for point in of(Attachment::Fixed) {
            self.point(point);
        }
        for rod in deck.rods.iter().filter(|rod| rod.attachment.value == Attachment::Fixed) {
            let row = format!("RODS {}", rod.id.value);
            for (letter, end) in ['A', 'B'].into_iter().zip(&rod.ends) {
                self.record(&row, rod.id.span, &format!("*R{}{letter} {}", rod.id.value, numbers(end)));
            }
        }
        let pinned = |kind: Attachment| kind == Attachment::CoupledPinned;
        for point in of(Attachment::Coupled) {
            self.vessel(&format!("POINTS {}", point.id.value), point.attachment.span);
            self.point(point);
            self.loads_of_moved_point(point);
        }
        for body in deck.bodies.iter().filter(|body| pinned(body.attachment.value)) {
            let row = format!("BODIES {}", body.id.value);
            self.vessel(&row, body.attachment.span);
            let [x, y, z, ..] = body.place;
            self.record(&row, body.id.span, &format!("*V{} {}", body.id.value, numbers(&[x, y, z])));
        }
        for rod in deck.rods.iter().filter(|rod| pinned(rod.attachment.value)) {
            let row = format!("RODS {}", rod.id.value);
            self.vessel(&row, rod.attachment.span);
            self.record(&row, rod.id.span, &format!("*VR{} {}", rod.id.value, numbers(&rod.ends[0])));
        }
        for body in &deck.bodies {
            self.body(body);
        }
        for point in of(Attachment::Free) {
            self.junction(point);
        }
    }

    /// The body of what the caller moves, described where it is first needed.
    fn vessel(&mut self, row: &str, span: Span) {
        if !self.has_vessel {
            self.has_vessel = true;
            self.record(row, span, "&DESCRIBE BODY VESSEL");
            if self.finds_vessel {
                self.remark(
                    span,
                    "what is coupled is on the body VESSEL of the model, in its axes; its motion is left as it is",
                );
            } else {
                self.record(row, span, &format!("PRESCRIBE VESSEL {STILL}"));
            }
        }
    }

    /// A joint between the first node, whose twist about an axis it holds, and the second one or the ground: what hangs on a pin of MoorDyn does
    /// not turn about its own axis.
    fn pin(&mut self, row: &str, span: Span, axis: usize, name: &str, nodes: &str) {
        let twist = ["RX", "RY", "RZ"].get(axis).copied().unwrap_or("RZ");
        if !self.pins.contains(&axis) {
            self.pins.push(axis);
            self.record(row, span, &format!("~PIN_{twist} FIX X Y Z {twist}"));
        }
        self.record(row, span, &format!("CONNECTOR {name} ~PIN_{twist} {nodes}"));
    }

    fn point(&mut self, point: &Point) {
        if point.height.value == Height::Seabed && point.attachment.value != Attachment::Fixed {
            self.refuse(point.height.span, "a point that is not fixed has no height by the seabed", "expected Z (m)");
        }
        let at = numbers(&self.place(point));
        let id = point.id.value;
        self.record(&format!("POINTS {id}"), point.id.span, &format!("*P{id} {at}"));
    }

    /// That what a point weighs does nothing where its body is moved.
    fn loads_of_moved_point(&mut self, point: &Point) {
        let acts = [&point.mass, &point.volume, &point.drag_area].into_iter().any(|given| given.value > 0.0);
        if acts || point.force != [0.0; 3] {
            let text =
                format!("point {} is moved by the caller: what it weighs and bears moves nothing", point.id.value);
            self.remark(point.mass.span, text);
        }
    }

    /// What a point of a free body weighs and bears.
    fn loads_of_point(&mut self, point: &Point) {
        let (id, span) = (point.id.value, point.id.span);
        let (row, name) = (format!("POINTS {id}"), format!("*P{id}"));
        if point.mass.value > 0.0 {
            let record = format!("#WEIGHT {name} {}", number(self.weight(point.mass.value)));
            self.record(&row, span, &record);
        }
        let (area, added) = (point.drag_area.value, point.added_mass.value);
        let water = InWater { volume: point.volume.value, areas: [[area; 3], [0.0; 3]], added: [added; 3] };
        if let Some(record) = water.record(&name, self.like) {
            self.record(&row, span, &record);
        }
        self.force(&row, span, &name, point.force);
    }

    fn force(&mut self, row: &str, span: Span, point: &str, force: [f64; 3]) {
        if force != [0.0; 3] {
            let force = numbers(&force.map(|force| rounded(force / 1000.0)));
            self.record(row, span, &format!("#FORCE {point} {force}"));
        }
    }

    fn junction(&mut self, point: &Point) {
        let row = format!("POINTS {}", point.id.value);
        let span = point.id.span;
        let weight = self.weight(point.mass.value);
        let lift = rounded(self.density() * self.gravity() * point.volume.value / 1000.0);
        let mut text = format!("JUNCTION P{} {}", point.id.value, numbers(&self.place(point)));
        let added = if lift > 0.0 { point.added_mass.value } else { 0.0 };
        for (option, value) in
            [("-WEIGHT", weight), ("-DISPLACEMENT", lift), ("-DRAG", point.drag_area.value), ("-AMASS", added)]
        {
            if value > 0.0 {
                text.push_str(&format!(" {option} {}", number(value)));
            }
        }
        if self.like == Like::MoorDyn && lift > 0.0 {
            text.push_str(NO_WAVE_INERTIA);
        }
        if point.force != [0.0; 3] {
            text.push_str(&format!(" -FORCE {}", numbers(&point.force.map(|force| rounded(force / 1000.0)))));
        }
        self.record(&row, span, &text);
    }

    fn body(&mut self, body: &Body) {
        let deck = self.deck;
        let (id, span) = (body.id.value, body.id.span);
        let row = format!("BODIES {id}");
        let name = format!("BODY{id}");
        let [.., roll, pitch, yaw] = body.place;
        if [roll, pitch, yaw].iter().filter(|angle| **angle != 0.0).count() > 1 {
            let text = format!("body {id} is turned about more than one axis");
            self.refuse(
                span,
                text,
                "expected one of r0, p0, y0 other than 0: MoorDyn and MoorPy turn in different orders",
            );
        }
        let is_moved = matches!(body.attachment.value, Attachment::Fixed | Attachment::Coupled);
        self.record(&row, span, &format!("&DESCRIBE BODY {name}"));
        self.record(&row, span, &format!("&INSTATE -LOCATE {name} {}", numbers(&body.place)));
        if is_moved {
            self.record(&row, body.attachment.span, &format!("PRESCRIBE {name} {STILL}"));
            if body.mass.value > 0.0 || body.volume.value > 0.0 {
                let text = format!(
                    "body {id} stands still or moves as prescribed: its mass, volume, drag and added mass do nothing"
                );
                self.remark(body.mass.span, text);
            }
        } else {
            self.loads_of_body(body);
        }
        for point in deck.points.iter().filter(|point| point.attachment.value == Attachment::Body(id)) {
            self.point(point);
            if is_moved {
                self.loads_of_moved_point(point);
            } else {
                self.loads_of_point(point);
            }
        }
        for rod in deck.rods.iter().filter(|rod| rod.attachment.value == Attachment::Body(id)) {
            let Some(axes) = RodAxes::new(rod) else { continue };
            let row = format!("RODS {}", rod.id.value);
            let place = numbers(&rod.ends[0]);
            let part = format!("&DESCRIBE PART ROD{} -MOVE {place} {}", rod.id.value, numbers(&axes.turn));
            self.record(&row, rod.id.span, &part);
            self.rod_loads(rod, &axes, !is_moved);
        }
        if body.attachment.value == Attachment::CoupledPinned {
            // a body turns about all axes
            if !self.pins.contains(&BALL) {
                self.pins.push(BALL);
                self.record(&row, body.attachment.span, "~PIN_BALL FIX X Y Z");
            }
            self.record(&row, body.attachment.span, &format!("CONNECTOR PIN{id} ~PIN_BALL *B{id} *V{id}"));
        }
    }

    /// Weight, volume, drag and added mass of a body that forces move.
    fn loads_of_body(&mut self, body: &Body) {
        let (id, span) = (body.id.value, body.id.span);
        let row = format!("BODIES {id}");
        let centre = match body.centre.value[..] {
            [x, y, z, ..] => [x, y, z],
            [z, ..] => [0.0, 0.0, z],
            [] => [0.0; 3],
        };
        let (mass, inertia) = (body.mass.value, three(&body.inertia.value));
        if mass == 0.0 && inertia != [0.0; 3] {
            self.refuse(
                body.mass.span,
                format!("body {id} has moments of inertia and no mass"),
                "expected a mass (kg)",
            );
            return;
        }
        let has_rods = self.deck.rods.iter().any(|rod| rod.attachment.value == Attachment::Body(id));
        if mass == 0.0 && !has_rods {
            let help = "expected Mass greater than 0, or rods fixed to it that weigh";
            self.refuse(body.mass.span, format!("the free body {id} has no mass"), help);
            return;
        }
        self.record(&row, span, &format!("*B{id} 0 0 0"));
        if mass > 0.0 {
            let radii = inertia.map(|inertia| rounded((inertia / mass).max(0.0).sqrt()));
            self.record(&row, span, &format!("*B{id}CG {}", numbers(&centre)));
            let record = format!("#WEIGHT *B{id}CG {} {}", number(self.weight(mass)), numbers(&radii));
            self.record(&row, body.mass.span, &record);
        }
        let areas = self.drag_areas_of_body(body);
        let water = InWater { volume: body.volume.value, areas, added: three(&body.added_mass.value) };
        if let Some(record) = water.record(&format!("*B{id}"), self.like) {
            self.record(&row, span, &record);
        }
        if body.volume.value > 0.0 && centre != [0.0; 3] {
            self.lift_of_body(body, centre);
        }
    }

    /// Where the buoyancy of a body acts whose centre of gravity is not its reference point.
    fn lift_of_body(&mut self, body: &Body, centre: [f64; 3]) {
        let id = body.id.value;
        if self.like == Like::Right {
            let text = format!(
                "the buoyancy of body {id} acts at its reference point; MoorDyn puts it at the centre of gravity, where a body has no righting moment: so does -LIKE MOORDYN"
            );
            self.remark(body.centre.span, text);
            return;
        }
        // a pair of forces moves the lift of #LUMP, whose added mass stays where it is
        let lift = rounded(self.density() * self.gravity() * body.volume.value);
        let row = format!("BODIES {id}");
        let span = body.centre.span;
        self.force(&row, span, &format!("*B{id}"), [0.0, 0.0, -lift]);
        if body.mass.value == 0.0 {
            self.record(&row, span, &format!("*B{id}CG {}", numbers(&centre)));
        }
        self.force(&row, span, &format!("*B{id}CG"), [0.0, 0.0, lift]);
        self.remark(span, format!("the buoyancy of body {id} acts at its centre of gravity, as in MoorDyn: a body has no righting moment there"));
    }

    /// Drag areas of a body along and about its axes.
    fn drag_areas_of_body(&mut self, body: &Body) -> [[f64; 3]; 2] {
        let given = &body.drag_area;
        let [mut along, mut about] = drag_areas(&given.value);
        let is_lost =
            matches!(given.value.len(), 3 | 6) && (along[0] > 0.0 || (given.value.len() == 3 && about[0] > 0.0));
        if !is_lost {
            return [along, about];
        }
        let id = body.id.value;
        match self.like {
            Like::Right => {
                let text = format!(
                    "the first drag area of body {id} acts; MoorDyn 2.7.2 loses it where three or six are given: so does -LIKE MOORDYN"
                );
                self.remark(given.span, text);
            }
            Like::MoorDyn => {
                along[0] = 0.0;
                if given.value.len() == 3 {
                    about[0] = 0.0;
                }
                self.remark(given.span, format!("the first drag area of body {id} is lost, as MoorDyn 2.7.2 loses it where three or six are given"));
            }
        }
        [along, about]
    }

    /// Rods that are bodies of their own.
    pub(super) fn rods(&mut self) {
        let deck = self.deck;
        for rod in &deck.rods {
            let (id, span) = (rod.id.value, rod.id.span);
            if rod_length(rod) == 0.0 {
                let help = "expected ends A and B apart; lines that meet in a point are joined by a free point";
                self.refuse(
                    span,
                    format!("rod {id} has no length: a joint of lines by their moments is not read"),
                    help,
                );
                continue;
            }
            let Some(axes) = RodAxes::new(rod) else { continue };
            let row = format!("RODS {id}");
            // the ends of the first stand among the points of the ground, the others with their body
            if matches!(rod.attachment.value, Attachment::Fixed | Attachment::Body(_)) {
                continue;
            }
            let [x, y, z] = match rod.attachment.value {
                Attachment::BodyPinned(body) => self.on_body(body, rod.ends[0]),
                _ => rod.ends[0],
            };
            if let Attachment::BodyPinned(body) = rod.attachment.value
                && self.is_turned(body)
            {
                let help = "expected Body#, or a body with r0, p0 and y0 of 0";
                self.refuse(rod.attachment.span, format!("rod {id} is pinned to a body that is turned"), help);
                continue;
            }
            let [roll, pitch, yaw] = axes.turn;
            self.record(&row, span, &format!("&DESCRIBE BODY ROD{id}"));
            self.record(&row, span, &format!("&INSTATE -LOCATE ROD{id} {}", numbers(&[x, y, z, roll, pitch, yaw])));
            let is_moved = rod.attachment.value == Attachment::Coupled;
            self.rod_loads(rod, &axes, !is_moved);
            let pin = format!("PINR{id}");
            match rod.attachment.value {
                Attachment::Coupled => self.record(&row, span, &format!("PRESCRIBE ROD{id} {STILL}")),
                Attachment::Pinned => self.pin(&row, span, axes.axis, &pin, &format!("*R{id}A")),
                Attachment::CoupledPinned => self.pin(&row, span, axes.axis, &pin, &format!("*R{id}A *VR{id}")),
                Attachment::BodyPinned(body) => {
                    self.record(&row, span, &format!("&DESCRIBE BODY BODY{body}"));
                    self.record(&row, span, &format!("*BR{id} {}", numbers(&rod.ends[0])));
                    self.pin(&row, span, axes.axis, &pin, &format!("*R{id}A *BR{id}"));
                }
                _ => {}
            }
        }
    }

    fn is_turned(&self, body: usize) -> bool {
        let body = body.checked_sub(1).and_then(|index| self.deck.bodies.get(index));
        body.is_some_and(|body| body.place[3..].iter().any(|angle| *angle != 0.0))
    }

    /// A place of a body that is not turned, in space.
    fn on_body(&self, body: usize, at: [f64; 3]) -> [f64; 3] {
        let body = body.checked_sub(1).and_then(|index| self.deck.bodies.get(index));
        let [x, y, z, ..] = body.map_or([0.0; 6], |body| body.place);
        let [dx, dy, dz] = at;
        [x + dx, y + dy, z + dz]
    }

    /// Ends, weight and member of a rod in its axes.
    fn rod_loads(&mut self, rod: &Rod, axes: &RodAxes, acts: bool) {
        let (id, span) = (rod.id.value, rod.id.span);
        let row = format!("RODS {id}");
        self.record(&row, span, &format!("*R{id}A 0 0 0"));
        self.record(&row, span, &format!("*R{id}B {}", numbers(&axes.place(1.0))));
        let Some(kind) = self.deck.rod_types.iter().find(|kind| kind.name.value == rod.rod_type.value) else { return };
        if !acts {
            let text = format!("rod {id} stands still or moves as prescribed: its mass and the water at it do nothing");
            self.remark(span, text);
            return;
        }
        if kind.mass.value == 0.0 && !matches!(rod.attachment.value, Attachment::Body(_)) {
            self.refuse(kind.mass.span, format!("rod {id} moves and has no mass"), "expected Mass/m greater than 0");
            return;
        }
        let (diameter, length) = (kind.diameter.value, axes.end.abs());
        if kind.mass.value > 0.0 {
            let across = rounded((length * length / 12.0 + diameter * diameter / 16.0).sqrt());
            let about = rounded(diameter / 8f64.sqrt());
            let weight = number(self.weight(kind.mass.value * length));
            let radii = numbers(&axes.along(about, across));
            self.record(&row, span, &format!("*R{id}CG {}", numbers(&axes.place(0.5))));
            self.record(&row, span, &format!("#WEIGHT *R{id}CG {weight} {radii}"));
        }
        if diameter > 0.0 {
            self.rod_in_water(rod, axes, kind);
        }
    }

    fn rod_in_water(&mut self, rod: &Rod, axes: &RodAxes, kind: &RodType) {
        let (id, span) = (rod.id.value, rod.id.span);
        let row = format!("RODS {id}");
        let diameter = kind.diameter.value;
        let [cd, ca, cd_end, ca_end] =
            [&kind.normal[0], &kind.normal[1], &kind.end[0], &kind.end[1]].map(|given: &Given<f64>| given.value);
        if cd_end > 0.0 {
            let area = rounded(cd_end * PI * diameter * diameter / 4.0);
            for letter in ['A', 'B'] {
                let record = format!("#LUMP *R{id}{letter} 0 -DRAG {}", numbers(&axes.along(area, 0.0)));
                self.record(&row, span, &record);
            }
        }
        self.record(&row, span, "&SURFACE");
        let size = number(rounded(diameter * 1000.0));
        let coefficients = format!("-CD {} -CDA 0 -CA {} -CAA {}", number(cd), number(ca), number(ca_end));
        self.record(&row, span, &format!("TUBE TUBE{id} *R{id}A *R{id}B {size} {coefficients}"));
        self.record(&row, span, "END");
    }
}

fn rod_length(rod: &Rod) -> f64 {
    let [a, b] = &rod.ends;
    let [x, y, z] = [0, 1, 2].map(|axis| b[axis] - a[axis]);
    (x * x + y * y + z * z).sqrt()
}
