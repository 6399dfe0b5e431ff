//! Structural elements: what water, wind and gravity make of beams and plates of given sections.
//!
//! A beam is straight lengths of one section each, as tubes or bars by Morison's formula ([`crate::morison`]); a cone is tubes of steps in
//! diameter, each with the volume of its length of the cone. Water that fills a flooded member moves with it across its axis, as
//! in an open pipe, and not along it. A plate is bars along its longest side, as broad as it is there: its added mass is that of strips, `CA rho pi/4 b^2` a length
//! \[DNV-RP-C205 appendix D\].
//!
//! The weight of a length is put at the two points of Gauss' quadrature, that of a plate at the middles of the sides of its triangles: with
//! them the mass, its centre and its moments and products of inertia are exact. The thickness of members is not in their inertia.

use nalgebra::{Vector2, Vector3};
use std::f64::consts::FRAC_PI_4;
use windlass_base::geometry::Position;
use windlass_base::units::Dim;
use windlass_model::{Breadths, ClassError, Member, MemberSection, SectionOutline, Shape};

/// Largest step in diameter of a cone, as a share of its largest one, and the most steps. Drag and volume are exact with any step; wind is
/// within the square of the step over 24.
const CONE_STEP: f64 = 0.05;
const MAX_CONE_STEPS: f64 = 20.0;
/// Strips of a length of a plate that grows or falls in breadth; the area is exact with any number.
const PLATE_STRIPS: usize = 8;

/// Coefficients of members where their records give none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MemberCoefficients {
    /// Drag across a round member.
    pub tube_drag: f64,
    /// Added mass across a round member.
    pub tube_added: f64,
    /// Shape coefficient of a round member in wind.
    pub tube_wind: f64,
    /// Drag of a bar or a plate across its axis.
    pub flat_drag: f64,
    /// Added mass of a bar or a plate.
    pub flat_added: f64,
    /// Shape coefficient of a bar or a plate in wind.
    pub flat_wind: f64,
}

/// A structural element, in its part.
#[derive(Clone, Debug, Default)]
pub struct StructuralElement {
    /// Its pieces.
    pub pieces: Vec<StructuralPiece>,
    /// Its weights: places (m), and each weight (N).
    pub weights: Vec<(Position, f64)>,
}

/// A piece of a structural element.
#[derive(Clone, Debug)]
pub struct StructuralPiece {
    /// Its form.
    pub shape: Shape,
    /// The share of the volume of that form that displaces water.
    pub permeability: f64,
    /// What water does to it.
    pub member: Member,
    /// Shape coefficients of the wind along the axes of the part.
    pub cs_wind: [f64; 3],
}

/// Where a beam is, and what is in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeamPlace {
    /// Its nodes, in the part (m).
    pub ends: [Vector3<f64>; 2],
    /// Local z is in the plane of the axis and this direction, in the part; the second counts where the axis runs along the first.
    pub directions: [[f64; 3]; 2],
    /// How far the section is turned about its axis (rad), from local y to local z.
    pub turn: f64,
    /// Whether water fills it.
    pub is_flooded: bool,
}

/// A beam of sections from its first node to its second; `water_weight` (N/m3) is that which a displacement per length is of.
///
/// # Errors
/// Nodes at one place; segments that are longer than the beam, or all shorter.
pub fn build_beam(
    sections: &[MemberSection],
    position: &BeamPlace,
    coefficients: &MemberCoefficients,
    water_weight: f64,
) -> Result<StructuralElement, ClassError> {
    let [first, second] = position.ends;
    let length = (second - first).norm();
    let Some(axis) = (second - first).try_normalize(1e-9) else {
        return Err(ClassError::new("its two nodes are at one place"));
    };
    let [width, depth] = local_directions(&axis, position);
    let mut made = StructuralElement::default();
    let mut from = 0.0;
    for (section, long) in sections.iter().zip(segment_lengths(sections, length)?) {
        let [start, end] = [from, from + long].map(|at| first + axis * at + depth * section.shift);
        from += long;
        for (share, weight) in gauss_weights(section.weight) {
            made.weights.push(((start + (end - start) * share).into(), weight * long));
        }
        let along = MemberPart { section, ends: [start, end], axis, width, depth, is_flooded: position.is_flooded };
        made.pieces.extend(along.pieces(coefficients, water_weight));
    }
    Ok(made)
}

/// Unit vectors along local y and z of a beam.
fn local_directions(axis: &Vector3<f64>, position: &BeamPlace) -> [Vector3<f64>; 2] {
    let [primary, secondary] =
        position.directions.map(|d| Vector3::from(d).try_normalize(0.0).unwrap_or_else(Vector3::z));
    // where both are along the beam any direction across it is as good
    let mut other = Vector3::zeros();
    other[axis.iamin()] = 1.0;
    let across = [primary, secondary, other].into_iter().find(|d| d.cross(axis).norm() > 1e-6).unwrap_or(other);
    let up = (across - axis * axis.dot(&across)).try_normalize(0.0).unwrap_or(other);
    let side = up.cross(axis);
    let (sin, cos) = position.turn.sin_cos();
    [side * cos + up * sin, up * cos - side * sin]
}

/// The lengths of the segments of a member (m): as given, and what is left for the one that gives none.
fn segment_lengths(sections: &[MemberSection], length: f64) -> Result<Vec<f64>, ClassError> {
    if sections.len() == 1 {
        return Ok(vec![length]);
    }
    let given: f64 = sections.iter().filter_map(|s| s.length).sum();
    let left = length - given;
    let open = sections.iter().any(|s| s.length.is_none());
    let fits = if open { left > 0.0 } else { left.abs() <= 1e-6 * length };
    if !fits {
        let text = "its segments are {} long together, and its nodes are {} apart";
        return Err(ClassError::with_values(text, &[(given, Dim::Length), (length, Dim::Length)])
            .help("one segment of the class may leave -LEN out and takes what is left"));
    }
    Ok(sections.iter().map(|s| s.length.unwrap_or(left)).collect())
}

/// Points of a length, as shares of it, and the weight at each over that length, of a weight that is straight between its ends.
fn gauss_weights([first, second]: [f64; 2]) -> [(f64, f64); 2] {
    let half = 0.5 / 3.0_f64.sqrt();
    [0.5 - half, 0.5 + half].map(|at| (at, 0.5 * (first + (second - first) * at)))
}

/// The area of a circle (m2).
fn circle(diameter: f64) -> f64 {
    FRAC_PI_4 * diameter * diameter
}

/// A length of one section.
struct MemberPart<'s> {
    section: &'s MemberSection,
    ends: [Vector3<f64>; 2],
    axis: Vector3<f64>,
    width: Vector3<f64>,
    depth: Vector3<f64>,
    is_flooded: bool,
}

impl MemberPart<'_> {
    fn pieces(&self, c: &MemberCoefficients, water_weight: f64) -> Vec<StructuralPiece> {
        let beside = if water_weight > 0.0 { self.section.displacement / water_weight } else { 0.0 };
        match self.section.outline {
            SectionOutline::Round([a, b]) if a == b => vec![self.tube(self.ends, [0.0, 1.0], [a; 2], c, beside)],
            SectionOutline::Round([a, b]) => {
                let [foot, head] = self.ends;
                let count = ((a - b).abs() / (CONE_STEP * a.max(b))).ceil().clamp(1.0, MAX_CONE_STEPS);
                let step = |n: usize| {
                    let shares = [n, n + 1].map(|n| n as f64 / count);
                    let ends = shares.map(|at| foot + (head - foot) * at);
                    self.tube(ends, shares, shares.map(|at| a + (b - a) * at), c, beside)
                };
                (0..count as usize).map(step).collect()
            }
            SectionOutline::Bar { width, depth } => vec![self.bar([width, depth], c, beside)],
            SectionOutline::Plate(_) => Vec::new(),
        }
    }

    /// The mean over a length of an area that is straight between the ends of the section.
    fn mean(of: [f64; 2], shares: [f64; 2]) -> f64 {
        of[0] + (of[1] - of[0]) * 0.5 * (shares[0] + shares[1])
    }

    /// A length of a round member of diameters at its ends; `beside` is displaced area beside its own (m2).
    fn tube(
        &self,
        ends: [Vector3<f64>; 2],
        shares: [f64; 2],
        [a, b]: [f64; 2],
        c: &MemberCoefficients,
        beside: f64,
    ) -> StructuralPiece {
        let section = self.section;
        // the diameter with the volume of the cone, and the mean one that flow meets
        let diameter = if a == b { a } else { ((a * a + a * b + b * b) / 3.0).sqrt() };
        let mean = 0.5 * (a + b);
        let whole = circle(diameter);
        let metal = MemberPart::mean(section.metal, shares);
        let enclosed = if section.is_closed() { whole.max(metal) } else { metal };
        let displaced = match section.buoyancy_diameter {
            Some(given) => circle(given),
            None if self.is_flooded => metal,
            None => enclosed,
        };
        let contained = if self.is_flooded { (enclosed - metal).max(0.0) } else { 0.0 };
        let added = section.added_mass_diameter.map_or(1.0, circle_over(whole));
        let drag = c.tube_drag * section.drag_diameter.unwrap_or(mean) / diameter;
        let member = Member {
            drag,
            friction: if drag > 0.0 { TUBE_FRICTION * section.drag_diameter.unwrap_or(mean) / diameter } else { 0.0 },
            added: c.tube_added * added + contained / whole,
            end_added: [0.0; 2],
            breadths: None,
        };
        let wind = c.tube_wind * section.wind_diameter.map_or(1.0, |given| given / diameter);
        StructuralPiece {
            shape: Shape::Tube { ends: ends.map(Position::from), diameter },
            permeability: (displaced + beside) / whole,
            member,
            cs_wind: [wind; 3],
        }
    }

    /// A member with a rectangular outline.
    fn bar(&self, [width, depth]: [f64; 2], c: &MemberCoefficients, beside: f64) -> StructuralPiece {
        let section = self.section;
        let outline = width * depth;
        let mean = |of: [f64; 2]| 0.5 * (of[0] + of[1]);
        let contained = if self.is_flooded { mean(section.enclosed) - mean(section.metal) } else { 0.0 };
        // a flow along the width meets the depth
        let seen = [depth, width];
        let added = seen.map(|b| c.flat_added * circle(section.added_mass_diameter.unwrap_or(b)) + contained);
        let breadths = Breadths { drag: section.drag_diameter.map_or(seen, |given| [given; 2]), added };
        let wind = section.wind_diameter.map_or([c.flat_wind; 3], |given| {
            let long = (self.ends[1] - self.ends[0]).norm();
            [0, 1, 2].map(|n| {
                let [along, across, up] = [self.axis[n], self.width[n], self.depth[n]].map(f64::abs);
                let area = long * (depth * across + width * up) + outline * along;
                let wanted = given * long * (1.0 - along * along).max(0.0).sqrt();
                if area > 0.0 { c.flat_wind * wanted / area } else { 0.0 }
            })
        });
        StructuralPiece {
            shape: Shape::Bar {
                ends: self.ends.map(Position::from),
                sides: [(self.width * width).into(), (self.depth * depth).into()],
            },
            permeability: (mean(section.displaced_areas(self.is_flooded)) + beside) / outline,
            member: flat_member(c, breadths),
            cs_wind: wind,
        }
    }
}

/// The share of an area that the circle of a diameter has.
fn circle_over(area: f64) -> impl Fn(f64) -> f64 {
    move |diameter| circle(diameter) / area
}

/// Skin friction along members, as AQWA has it.
const TUBE_FRICTION: f64 = 0.016;

/// The coefficients of a bar.
fn flat_member(c: &MemberCoefficients, breadths: Breadths) -> Member {
    let friction = if c.flat_drag > 0.0 { TUBE_FRICTION } else { 0.0 };
    Member { drag: c.flat_drag, friction, added: c.flat_added, end_added: [0.0; 2], breadths: Some(breadths) }
}

/// A plane plate with its corners round it, in the part (m).
///
/// # Errors
/// Corners that lie on a line, not in a plane, or round a shape that is not convex.
pub fn build_plate(
    section: &MemberSection,
    corners: &[Vector3<f64>],
    coefficients: &MemberCoefficients,
) -> Result<StructuralElement, ClassError> {
    let SectionOutline::Plate(thickness) = section.outline else {
        return Err(ClassError::new(format!("its class is a {}, not a PLATE", section.kind)));
    };
    let Some(origin) = corners.first().copied() else { return Err(ClassError::new("it has no corners")) };
    let area: Vector3<f64> =
        corners.windows(2).map(|w| (w[0] - origin).cross(&(w[1] - origin))).sum::<Vector3<f64>>() * 0.5;
    let size = corners.iter().map(|at| (at - origin).norm()).fold(0.0, f64::max);
    let Some(normal) = area.try_normalize(1e-9 * size * size) else {
        return Err(ClassError::new("its corners lie on a line"));
    };
    if corners.iter().any(|at| (at - origin).dot(&normal).abs() > 1e-3 * size) {
        return Err(ClassError::new("its corners do not lie in a plane").help("divide it into triangles"));
    }
    let edges = corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| b - a);
    let along = edges.fold(Vector3::zeros(), |most: Vector3<f64>, e| if e.norm() > most.norm() { e } else { most });
    let Some(x) = (along - normal * normal.dot(&along)).try_normalize(0.0) else {
        return Err(ClassError::new("its corners lie on a line"));
    };
    let y = normal.cross(&x);
    let flat: Vec<Vector2<f64>> =
        corners.iter().map(|at| Vector2::new((at - origin).dot(&x), (at - origin).dot(&y))).collect();
    let turns = |[a, b, c]: [Vector2<f64>; 3]| (b - a).perp(&(c - b));
    let around = flat.iter().zip(flat.iter().cycle().skip(1)).zip(flat.iter().cycle().skip(2));
    if around.into_iter().any(|((a, b), c)| turns([*a, *b, *c]) < -1e-9 * size * size) {
        return Err(ClassError::new("its outline is not convex").help("divide it into convex plates"));
    }
    let mut made = StructuralElement::default();
    for (a, b) in corners.iter().zip(corners.iter().skip(1)).skip(1) {
        let share = 0.5 * (a - origin).cross(&(b - origin)).norm() * section.weight[0] / 3.0;
        for middle in [(origin + a) * 0.5, (a + b) * 0.5, (b + origin) * 0.5] {
            made.weights.push((middle.into(), share));
        }
    }
    for [from, to, low, high] in strips(&flat, size) {
        let (breadth, middle) = (high - low, 0.5 * (low + high));
        let ends = [from, to].map(|at| Position::from(origin + x * at + y * middle));
        let seen = [thickness, breadth];
        let added = seen.map(|b| coefficients.flat_added * circle(b));
        made.pieces.push(StructuralPiece {
            shape: Shape::Bar { ends, sides: [(y * breadth).into(), (normal * thickness).into()] },
            permeability: 1.0,
            member: flat_member(coefficients, Breadths { drag: seen, added }),
            cs_wind: [coefficients.flat_wind; 3],
        });
    }
    Ok(made)
}

/// Strips along x of a convex outline: where each begins and ends, and its least and greatest y. Each has the area of its length.
fn strips(corners: &[Vector2<f64>], size: f64) -> Vec<[f64; 4]> {
    let mut cuts: Vec<f64> = corners.iter().map(|at| at.x).collect();
    cuts.sort_by(f64::total_cmp);
    cuts.dedup_by(|a, b| (*a - *b).abs() < 1e-9 * size);
    let span = |x: f64| {
        let edges = corners.iter().zip(corners.iter().cycle().skip(1));
        let crossed = edges.filter(|(a, b)| (a.x - x) * (b.x - x) <= 0.0 && a.x != b.x);
        let at = crossed.map(|(a, b)| a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x));
        at.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)])
    };
    let mut made = Vec::new();
    for pair in cuts.windows(2) {
        let [from, to] = pair else { continue };
        let near = |share: f64| span(from + (to - from) * share);
        let ([a, b], [c, d]) = (near(0.25), near(0.75));
        let is_even = (a - c).abs() + (b - d).abs() < 1e-9 * size;
        let count = if is_even { 1 } else { PLATE_STRIPS };
        for n in 0..count {
            let at = |n: f64| from + (to - from) * n / count as f64;
            let [low, high] = span(at(n as f64 + 0.5));
            made.push([at(n as f64), at(n as f64 + 1.0), low, high]);
        }
    }
    made
}
