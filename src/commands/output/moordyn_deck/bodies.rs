//! Bodies, junctions and rods.

use super::system::{AT_END_M, BodyRole, DeckWriter, own, rounded};
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_4;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Position;
use windlass_model::{Body, LoadKind, Lump, Mass, Member, Model, Part, PartLoad, Shape, Weight};
use windlass_moordyn::records::VESSEL;
use windlass_moordyn::tables::{self, Attachment, Rod, RodType};

/// Segments of a rod: the model has none.
const ROD_SEGMENTS: usize = 10;
/// Products of inertia that are zero but for rounding, as a share of the largest moment.
const PRODUCT_TOLERANCE: f64 = 1e-9;
/// A turn below this is rounding (rad).
const LEAST_TURN: f64 = 1e-7;

/// A round member of a body, in the body's axes (m).
struct Bar<'a> {
    ends: [Position; 2],
    diameter: f64,
    member: &'a Member,
    /// Drag coefficient of its flat ends.
    cd_end: f64,
}

/// What a free body is made of.
struct Parts<'a> {
    mass: Mass,
    /// Places in the body (m) with masses without a size of their own (kg), beside one that has it.
    masses: Vec<(Position, f64)>,
    bars: Vec<Bar<'a>>,
    /// Places in the body (m) with what the water does there.
    lumps: Vec<(Position, Lump)>,
    /// Places in the body (m) with constant forces (N).
    forces: Vec<(Position, [f64; 3])>,
}

impl<'a> DeckWriter<'a> {
    /// What every body is in the deck; its rows.
    pub(super) fn bodies(&mut self) -> Outcome<()> {
        let model = self.model;
        for (key, body) in &model.bodies {
            let role = self.body(body)?;
            self.bodies.insert(key.clone(), role);
        }
        Ok(())
    }

    fn body(&mut self, body: &Body) -> Outcome<BodyRole> {
        if body.junction.is_some() {
            return self.junction(body);
        }
        if body.prescribed.is_some() {
            if body.name.eq_ignore_ascii_case(VESSEL) || axes_turned(body) > 1 {
                return Ok(BodyRole::Caller);
            }
            let id = self.body_row(body, Attachment::Coupled, &Mass::default());
            return Ok(BodyRole::Body(id));
        }
        match self.parts_of_free(body) {
            Err(why) => {
                self.note_moved_body(body, &why);
                Ok(BodyRole::Caller)
            }
            Ok(parts) if axes_turned(body) > 1 && !parts.is_rod() => {
                let text = format!(
                    "{} is turned about more than one axis, which a deck does not hold: read again it would stand still",
                    body.name
                );
                Err(Diagnostic::error(text, self.span)
                    .help("store the model before &EQUI, or &INSTATE -LOCATE turns the body about one axis"))
            }
            Ok(parts) => self.free_body(body, &parts),
        }
    }

    /// Says why a program moves the points of a body.
    fn note_moved_body(&mut self, body: &Body, why: &str) {
        self.remark(format!(
            "{} has {why}, which a deck does not have: a program moves its points, as coupled ones",
            body.name
        ));
    }

    fn junction(&mut self, body: &Body) -> Outcome<BodyRole> {
        let model = self.model;
        let gravity = self.around.gravity;
        let [x, y, z] = body.position.shift;
        let id = self.add_point(Attachment::Free, [x, y, z]);
        let mass = Mass::from_parts(model.parts_of(body), gravity).mass;
        let volume = body.junction.map_or(0.0, |junction| junction.volume);
        let (mut force, mut area, mut added) = ([0.0; 3], 0.0, 0.0);
        for (_, load) in self.loads_of(body) {
            match &load.kind {
                LoadKind::Force(own_force) => force = [0, 1, 2].map(|axis| force[axis] + own_force[axis]),
                LoadKind::Lump(lump)
                    if is_alike(&lump.drag_areas) && is_alike(&lump.added) && lump.rotary_drag == [0.0; 3] =>
                {
                    area += lump.drag_areas[0];
                    added += lump.added[0];
                }
                other => {
                    let text =
                        format!("a deck cannot hold {}: {} at a junction has no counterpart", body.name, other.name());
                    return Err(self.refuse(text, ""));
                }
            }
        }
        if let Some(point) = self.deck.points.last_mut() {
            point.mass = own(rounded(mass));
            point.volume = own(rounded(volume));
            point.force = force.map(rounded);
            point.drag_area = own(rounded(area));
            point.added_mass = own(rounded(added));
        }
        self.head(format!("point {id}: the junction {}", body.name));
        Ok(BodyRole::Junction(id))
    }

    /// Adds the row of a body; returns its id.
    fn body_row(&mut self, body: &Body, attachment: Attachment, mass: &Mass) -> usize {
        let id = self.deck.bodies.len() + 1;
        let ([x, y, z], [roll, pitch, yaw]) = (body.position.shift, written_turn(body));
        let place = [x, y, z, roll.to_degrees(), pitch.to_degrees(), yaw.to_degrees()].map(rounded);
        let about = mass.inertia_about(mass.centre).diagonal();
        self.deck.bodies.push(tables::Body {
            id: own(id),
            attachment: own(attachment),
            place,
            mass: own(rounded(mass.mass)),
            centre: own(mass.centre.iter().map(|value| rounded(*value)).collect()),
            inertia: own(about.iter().map(|value| rounded(value.max(0.0))).collect()),
            volume: own(0.0),
            drag_area: own(vec![0.0]),
            added_mass: own(vec![0.0]),
        });
        self.head(format!("body {id}: {}", body.name));
        id
    }

    /// Loads on the parts of a body.
    fn loads_of(&self, body: &Body) -> Vec<(&'a Part, &'a PartLoad)> {
        let model = self.model;
        let key = Model::key(&body.name);
        let parts: Vec<&Part> = model.parts.values().filter(|part| Model::key(&part.body) == key).collect();
        let part_of = |load: &PartLoad| parts.iter().find(|part| part.name.eq_ignore_ascii_case(&load.part)).copied();
        model.loads.iter().filter_map(|load| Some((part_of(load)?, load))).collect()
    }

    /// What a free body is made of, in its axes; else what it has that a deck has not.
    fn parts_of_free(&self, body: &Body) -> Result<Parts<'a>, String> {
        let model = self.model;
        let has = |what: &str| Err(what.to_string());
        if !body.ignored.is_empty() {
            return has("degrees of freedom that are left out");
        }
        if body.linear.is_some() || body.database.is_some() {
            return has("hydrostatics or a database");
        }
        let key = Model::key(&body.name);
        let parts: Vec<&Part> = model.parts.values().filter(|part| Model::key(&part.body) == key).collect();
        if model.compartments.values().any(|tank| parts.iter().any(|part| part.name.eq_ignore_ascii_case(&tank.part))) {
            return has("compartments");
        }
        let mut bars = Vec::new();
        for piece in parts.iter().flat_map(|part| part.pieces.iter().map(move |piece| (part, piece))) {
            let (part, piece) = piece;
            match (&piece.shape, &piece.member) {
                (Shape::Tube { ends, diameter }, Some(member))
                    if piece.permeability == 1.0 && piece.eddy_damping == 0.0 =>
                {
                    bars.push(Bar {
                        ends: ends.map(|at| part.position.apply(at)),
                        diameter: *diameter,
                        member,
                        cd_end: 0.0,
                    });
                }
                _ => return has("a hull"),
            }
        }
        if bars.iter().any(|bar| bar.member.friction != 0.0 || bar.member.end_added[0] != bar.member.end_added[1]) {
            return has("tubes with friction along them or with unlike ends");
        }
        let gravity = self.around.gravity;
        let weights = || parts.iter().flat_map(|part| part.weights.iter().map(move |weight| (*part, weight)));
        let has_size = |weight: &Weight| weight.radii != [0.0; 3];
        let is_sized = weights().any(|(_, weight)| has_size(weight));
        let bare = |part: &&Part| Part {
            weights: part.weights.iter().filter(|weight| !is_sized || has_size(weight)).cloned().collect(),
            pieces: Vec::new(),
            ..(**part).clone()
        };
        let sized: Vec<Part> = parts.iter().map(bare).collect();
        let mass = Mass::from_parts(sized.iter(), gravity);
        let points = weights().filter(|(_, weight)| is_sized && !has_size(weight));
        let masses: Vec<(Position, f64)> = points
            .map(|(part, weight)| (part.position.apply(weight.at), weight.weight * weight.multiplier / gravity))
            .collect();
        if masses.iter().any(|(_, mass)| *mass < 0.0) {
            return has("weights below zero");
        }
        if mass.mass <= 0.0 {
            return has("no weight");
        }
        let about = mass.inertia_about(mass.centre);
        let largest = about.diagonal().max();
        let products = [about[(0, 1)], about[(0, 2)], about[(1, 2)]];
        if products.iter().any(|product| product.abs() > PRODUCT_TOLERANCE * largest) {
            return has("products of inertia");
        }
        let (mut lumps, mut forces) = (Vec::new(), Vec::new());
        for (part, load) in self.loads_of(body) {
            let at = part.position.apply(load.at);
            if load.shape_coefficients != [1.0; 2] {
                return has("loads with shape coefficients");
            }
            match &load.kind {
                LoadKind::Force(force) => forces.push((at, *force)),
                LoadKind::Lump(lump) => {
                    if lump.volume == 0.0 && take_end_drag(&mut bars, part, at, lump) {
                        continue;
                    }
                    if part.position.turn != [0.0; 3] && !(is_alike(&lump.drag_areas) && is_alike(&lump.added)) {
                        return has("#LUMP with unlike areas in a part that is turned");
                    }
                    if lump.volume > 0.0 && !lump.is_constant {
                        return has("#LUMP without -CONSTANT");
                    }
                    lumps.push((at, *lump));
                }
                other => return Err(other.name().to_string()),
            }
        }
        if bars.iter().any(|bar| bar.cd_end < 0.0) {
            return has("tubes with drag on one end");
        }
        Ok(Parts { mass, masses, bars, lumps, forces })
    }

    /// The rows of a free body: a rod where it is one, else a body with what is fixed to it.
    fn free_body(&mut self, body: &Body, parts: &Parts<'a>) -> Outcome<BodyRole> {
        if let (true, [bar]) = (parts.is_rod(), parts.bars.as_slice()) {
            let length = bar.length();
            let name = self.rod_type(bar, parts.mass.mass / length);
            let ends = bar.ends.map(|at| body.position.apply(at));
            let id = self.rod(&name, Attachment::Free, ends);
            self.head(format!("rod {id}: {}", body.name));
            return Ok(BodyRole::Rod(id, bar.ends));
        }
        let id = self.body_row(body, Attachment::Free, &parts.mass);
        let mut on_points: Vec<(Position, Lump)> = Vec::new();
        for (at, lump) in &parts.lumps {
            let at_origin = at.iter().all(|value| value.abs() < AT_END_M);
            // MoorDyn has the volume of a body at its centre of gravity
            let keeps_volume = parts.mass.centre.norm() < AT_END_M || lump.volume == 0.0;
            let is_free =
                self.deck.bodies.last().is_some_and(|row| row.volume.value == 0.0 && row.drag_area.value == [0.0]);
            let plain = is_alike(&lump.drag_areas) && is_alike(&lump.added) && lump.rotary_drag == [0.0; 3];
            match (at_origin && is_free, keeps_volume || !is_alike(&lump.added), plain) {
                (true, true, _) => self.lump_of_body(&body.name, lump),
                (true, false, _) => {
                    on_points.push((*at, Lump { drag_areas: [0.0; 3], rotary_drag: [0.0; 3], ..*lump }));
                    self.lump_of_body(&body.name, &Lump { volume: 0.0, added: [0.0; 3], ..*lump });
                }
                (false, _, true) => on_points.push((*at, *lump)),
                (false, _, false) => {
                    let text = format!(
                        "a deck cannot hold {}: a #LUMP with unlike areas acts at its reference point alone",
                        body.name
                    );
                    return Err(self.refuse(text, ""));
                }
            }
        }
        for (at, lump) in on_points {
            let point = self.add_point(Attachment::Body(id), at);
            self.head(format!("point {point}: a #LUMP of {}", body.name));
            if let Some(row) = self.deck.points.last_mut() {
                row.volume = own(rounded(lump.volume));
                row.drag_area = own(rounded(lump.drag_areas[0]));
                row.added_mass = own(rounded(lump.added[0]));
            }
        }
        for (at, mass) in &parts.masses {
            let point = self.add_point(Attachment::Body(id), *at);
            self.head(format!("point {point}: a #WEIGHT of {}", body.name));
            if let Some(row) = self.deck.points.last_mut() {
                row.mass = own(rounded(*mass));
            }
        }
        for (at, force) in &parts.forces {
            let point = self.add_point(Attachment::Body(id), *at);
            self.head(format!("point {point}: a #FORCE of {}", body.name));
            if let Some(row) = self.deck.points.last_mut() {
                row.force = force.map(rounded);
            }
        }
        for bar in &parts.bars {
            let name = self.rod_type(bar, 0.0);
            self.rod(&name, Attachment::Body(id), bar.ends);
        }
        Ok(BodyRole::Body(id))
    }

    /// What the water does at the reference point of the last body.
    fn lump_of_body(&mut self, name: &str, lump: &Lump) {
        let Some(row) = self.deck.bodies.last_mut() else { return };
        row.volume = own(rounded(lump.volume));
        let [along, about] = [lump.drag_areas, lump.rotary_drag].map(|areas| areas.map(rounded));
        // MoorDyn 2.7.2 loses the first one of six areas, and none of two
        let is_short = is_alike(&along) && is_alike(&about);
        row.drag_area = own(match (along, about) {
            ([0.0, 0.0, 0.0], [0.0, 0.0, 0.0]) => vec![0.0],
            ([area, ..], [turning, ..]) if is_short => vec![area, turning],
            _ => along.iter().chain(&about).copied().collect(),
        });
        let added = lump.added.map(rounded);
        row.added_mass = own(if is_alike(&added) { vec![added[0]] } else { added.to_vec() });
        if !is_short && along[0] > 0.0 {
            self.remark(format!("{name}: MoorDyn 2.7.2 loses the first one of six drag areas, that along x"));
        }
    }

    /// The type of a rod of this mass per length (kg/m); returns its name.
    fn rod_type(&mut self, bar: &Bar<'_>, mass: f64) -> String {
        let [added, _] = bar.member.end_added;
        let values = [bar.member.drag, bar.member.added, bar.cd_end, added].map(|value| own(rounded(value)));
        let [cd, ca, cd_end, ca_end] = values;
        let made = RodType {
            name: own(format!("ROD{}", self.deck.rod_types.len() + 1)),
            diameter: own(rounded(bar.diameter)),
            mass: own(rounded(mass)),
            normal: [cd, ca],
            end: [cd_end, ca_end],
        };
        let known =
            self.deck.rod_types.iter().find(|other| RodType { name: made.name.clone(), ..(*other).clone() } == made);
        if let Some(known) = known {
            return known.name.value.clone();
        }
        let name = made.name.value.clone();
        self.deck.rod_types.push(made);
        name
    }

    fn rod(&mut self, rod_type: &str, attachment: Attachment, ends: [Position; 2]) -> usize {
        let id = self.deck.rods.len() + 1;
        self.deck.rods.push(Rod {
            id: own(id),
            rod_type: own(rod_type.to_string()),
            attachment: own(attachment),
            ends: ends.map(|end| end.map(rounded)),
            segments: own(ROD_SEGMENTS),
        });
        id
    }
}

impl Parts<'_> {
    /// Whether it is a rod by itself.
    fn is_rod(&self) -> bool {
        let alone = self.lumps.is_empty() && self.forces.is_empty() && self.masses.is_empty();
        matches!(self.bars.as_slice(), [bar] if alone && bar.is_solid(&self.mass))
    }
}

impl Bar<'_> {
    fn length(&self) -> f64 {
        let [a, b] = self.ends.map(Vector3::from);
        (b - a).norm()
    }

    /// Whether a mass is that of this bar, solid and the same all along.
    fn is_solid(&self, mass: &Mass) -> bool {
        let [a, b] = self.ends.map(Vector3::from);
        let length = self.length();
        if length <= 0.0 || (mass.centre - (a + b) * 0.5).norm() > AT_END_M {
            return false;
        }
        let axis = (b - a) / length;
        let about = mass.inertia_about(mass.centre);
        let across = mass.mass * (length * length / 12.0 + self.diameter * self.diameter / 16.0);
        let along = mass.mass * self.diameter * self.diameter / 8.0;
        let wanted = nalgebra::Matrix3::identity() * across + axis * axis.transpose() * (along - across);
        (about - wanted).norm() <= SOLID_TOLERANCE * across
    }
}

/// How far moments of inertia of a rod may be from those of a solid bar: the digits of its records.
const SOLID_TOLERANCE: f64 = 1e-6;

/// Gives a bar the drag of a flat end that a lump at the end is; false of another lump.
fn take_end_drag(bars: &mut [Bar<'_>], part: &Part, at: Position, lump: &Lump) -> bool {
    if lump.rotary_drag != [0.0; 3] || lump.added != [0.0; 3] {
        return false;
    }
    let area: f64 = lump.drag_areas.iter().sum();
    let axes: Vec<usize> = (0..3).filter(|axis| lump.drag_areas.get(*axis).is_some_and(|area| *area > 0.0)).collect();
    let [axis] = axes[..] else { return false };
    let mut unit = [0.0; 3];
    if let Some(one) = unit.get_mut(axis) {
        *one = 1.0;
    }
    let along = Vector3::from(part.position.rotate(unit));
    for bar in bars {
        let [a, b] = bar.ends.map(Vector3::from);
        let is_at = |end: Vector3<f64>| (end - Vector3::from(at)).norm() < AT_END_M;
        let is_along = (b - a).cross(&along).norm() <= AT_END_M * bar.length().max(1.0);
        if !(is_along && (is_at(a) || is_at(b))) {
            continue;
        }
        let coefficient = area / (FRAC_PI_4 * bar.diameter * bar.diameter);
        // negative until the other end has the same
        let first = bar.cd_end == 0.0;
        let second = bar.cd_end < 0.0 && (bar.cd_end + coefficient).abs() <= 1e-9 * coefficient;
        if first {
            bar.cd_end = -coefficient;
            return true;
        }
        if second {
            bar.cd_end = coefficient;
            return true;
        }
    }
    false
}

/// Whether three values are one.
fn is_alike([x, y, z]: &[f64; 3]) -> bool {
    x == y && y == z
}

/// About how many axes a body is turned.
fn axes_turned(body: &Body) -> usize {
    written_turn(body).iter().filter(|angle| **angle != 0.0).count()
}

/// Roll, pitch and yaw as a deck has them (rad): what rounding turns is none.
fn written_turn(body: &Body) -> [f64; 3] {
    body.position.turn.map(|angle| if angle.abs() < LEAST_TURN { 0.0 } else { angle })
}
