//! Forces of gravity and water on the elements of a towed tether at one time, and the mass of the water they move.
//!
//! Each element is divided into integration lengths, each of these where the surface passes the top or the bottom of the
//! tube, and each piece is integrated at four Gauss points with the actual surface [AQWA-TETHER 3.3 and 3.4].
//!
//! The waves meet each place where the slopes of the tether have drawn it, along the axis toward the vessel's end, which is the origin of
//! the axis [AQWA-TETHER 4]: an element of length `L` reaches over `L (1 - slope^2/2)`.

use super::super::beam::{self, GAUSS, Matrix4, Vector4, add, deflection, dot, of_element, slope};
use super::super::line::TetherElement;
use super::Towed;
use super::scheme::TowedState;
use super::water::{TowedFlow, Turn, Waters};
use super::wet_section::{Scan, SubmergedSection, SubmergenceState};
use windlass_base::units::Dim;
use windlass_model::ClassError;

/// Integration lengths at most: a long element in short waves has many.
const MAX_INTEGRATION_LENGTHS: usize = 200_000;
/// Largest change of a wave's phase (rad) that turns kept for the straight axis are taken on by its series: within 1e-16 of the sine.
const MAX_SERIES_PHASE: f64 = 0.1;
/// Turns kept at most for places that do not move (128 bytes each: 32 MB); beyond that they are taken anew.
const MAX_CACHED_PHASES: usize = 1 << 18;

/// A piece of an element short enough for the waves.
#[derive(Clone, Debug)]
struct IntegrationLength {
    element: usize,
    /// Where it begins and how long it is, as fractions of the element.
    from: f64,
    share: f64,
    /// Its Gauss points: distance from the first node (m), shapes there.
    x: [f64; 4],
    deflections: [Vector4; 4],
    slopes: [Vector4; 4],
}

/// By how much the slopes of a tether draw an element toward the vessel's end.
#[derive(Clone, Copy, Debug, Default)]
struct Foreshortening {
    /// At its first node (m), not below zero.
    start: f64,
    /// A metre of its length: half the square of its slope, from node to node.
    rate: f64,
}

impl Foreshortening {
    /// Shift of a place so far (m) from its first node.
    #[inline]
    fn shift(&self, distance: f64) -> f64 {
        self.start - self.rate * distance
    }
}

/// How an element stands and moves in both planes (y, z).
struct ElementMotion {
    at: [Vector4; 2],
    velocity: [Vector4; 2],
}

/// Loads of the elements, with the work space to find them.
#[derive(Clone, Debug)]
pub struct Loading<'a> {
    case: &'a Towed,
    waters: Waters,
    lengths: Vec<IntegrationLength>,
    scan: Scan,
    /// Turns of the waves at the Gauss points of the lengths, in order; empty when they would be too many or are none.
    kept: Vec<Turn>,
    /// How each element is drawn toward the vessel's end.
    shortened: Vec<Foreshortening>,
    /// Turns at the time and at the place in hand.
    time: Vec<Turn>,
    position: Vec<Turn>,
    /// Loads of gravity along z.
    gravity: Vec<Vector4>,
    /// Loads of each element in the planes y and z.
    pub forces: Vec<[Vector4; 2]>,
    /// Mass of the moved water of each element in the planes y and z.
    pub added: Vec<[Matrix4; 2]>,
}

impl<'a> Loading<'a> {
    /// Loads of a tether, none of them found yet.
    ///
    /// # Errors
    /// More integration lengths than can be: an element is very long for the waves.
    pub fn new(case: &'a Towed) -> Result<Self, ClassError> {
        let waters = Waters::new(case);
        let limit = Waters::integration_length(&case.waves).unwrap_or(f64::INFINITY);
        let mut lengths = Vec::new();
        for (element, (e, start)) in case.line.elements().iter().zip(case.line.distances()).enumerate() {
            let number = (e.length / limit).ceil().max(1.0);
            if lengths.len() as f64 + number > MAX_INTEGRATION_LENGTHS as f64 {
                let message =
                    "the elements of the tether make too many integration lengths of {}, a quarter of a wave length";
                return Err(ClassError::with_values(message, &[(limit, Dim::Length)]));
            }
            let share = 1.0 / number;
            for index in 0..number as usize {
                let from = index as f64 * share;
                let positions = GAUSS.map(|(a, _)| from + share * a);
                lengths.push(IntegrationLength {
                    element,
                    from,
                    share,
                    x: positions.map(|a| start + a * e.length),
                    deflections: positions.map(|a| deflection(a, e.length)),
                    slopes: positions.map(|a| slope(a, e.length)),
                });
            }
        }
        let mut kept = Vec::new();
        if 4 * lengths.len() * waters.blocks() <= MAX_CACHED_PHASES {
            lengths.iter().flat_map(|l| l.x).for_each(|x| waters.at_place(x, 0.0, &mut kept));
        }
        let elements = case.line.elements();
        let weight = |e: &TetherElement| beam::uniform_load(-e.mass_per_length() * case.gravity, e.length);
        Ok(Loading {
            case,
            lengths,
            scan: Scan::default(),
            kept,
            shortened: vec![Foreshortening::default(); elements.len()],
            time: Vec::with_capacity(waters.blocks()),
            position: Vec::with_capacity(waters.blocks()),
            gravity: elements.iter().map(weight).collect(),
            forces: vec![[[0.0; 4]; 2]; elements.len()],
            added: vec![[[[0.0; 4]; 4]; 2]; elements.len()],
            waters,
        })
    }

    /// Finds the loads at a time (s) of a state.
    pub fn find(&mut self, time: f64, state: &TowedState) {
        self.waters.at_time(time, &mut self.time);
        self.shorten(state);
        for ((forces, added), gravity) in self.forces.iter_mut().zip(&mut self.added).zip(&self.gravity) {
            *forces = [[0.0; 4], *gravity];
            *added = [[[0.0; 4]; 4]; 2];
        }
        let lengths = std::mem::take(&mut self.lengths);
        for (index, length) in lengths.iter().enumerate() {
            self.add_loads(index, length, state);
        }
        self.lengths = lengths;
        for matrix in self.added.iter_mut().flatten() {
            for i in 1..4 {
                let (above, below) = matrix.split_at_mut(i);
                for (j, row) in above.iter().enumerate() {
                    below[0][j] = row[i];
                }
            }
        }
    }

    /// Finds by how much each element is drawn toward the vessel's end in a state.
    fn shorten(&mut self, state: &TowedState) {
        let mut end = 0.0;
        let elements = self.case.line.elements().iter().enumerate();
        for ((index, element), shortened) in elements.zip(&mut self.shortened).rev() {
            let chords = [0, 1].map(|plane| {
                let [near, _, far, _] = of_element(&state.at[plane], index);
                (far - near) / element.length
            });
            let rate = 0.5 * (chords[0] * chords[0] + chords[1] * chords[1]);
            *shortened = Foreshortening { start: end + rate * element.length, rate };
            end = shortened.start;
        }
    }

    /// Adds the loads of an integration length.
    fn add_loads(&mut self, index: usize, length: &IntegrationLength, state: &TowedState) {
        let motion = ElementMotion {
            at: [of_element(&state.at[0], length.element), of_element(&state.at[1], length.element)],
            velocity: [of_element(&state.velocity[0], length.element), of_element(&state.velocity[1], length.element)],
        };
        let case = self.case;
        let Some(element) = case.line.elements().get(length.element) else { return };
        let blocks = self.waters.blocks();
        let straight = !self.waters.lateral || motion.at[0] == [0.0; 4];
        let usable = straight && !self.kept.is_empty();
        let shortened = self.shortened[length.element];
        let start = length.x[0] - (length.from + length.share * GAUSS[0].0) * element.length;
        let shifts = length.x.map(|x| shortened.shift(x - start));
        self.position.clear();
        for (i, (x, shift)) in length.x.iter().zip(shifts).enumerate() {
            if usable && shift.abs() * self.waters.steepest <= MAX_SERIES_PHASE {
                let kept = &self.kept[(4 * index + i) * blocks..(4 * index + i + 1) * blocks];
                self.waters.at_shifted_place(kept, shift, &mut self.position);
            } else {
                self.waters.at_place(x + shift, dot(&length.deflections[i], &motion.at[0]), &mut self.position);
            }
        }
        let mut elevations = [0.0; 4];
        let mut heights = [0.0; 4];
        for i in 0..4 {
            elevations[i] = self.waters.elevation(&self.time, &self.position[i * blocks..(i + 1) * blocks]);
            heights[i] = elevations[i] - case.origin[2] - dot(&length.deflections[i], &motion.at[1]);
        }
        let radius = 0.5 * element.outer_diameter;
        match self.scan.wetness(&heights, radius) {
            SubmergenceState::Dry => {}
            SubmergenceState::Under => {
                let wet = SubmergedSection::new(radius, element.outer_diameter);
                for i in 0..4 {
                    let z = elevations[i] - heights[i];
                    let flow =
                        self.waters.flow(&self.time, &self.position[i * blocks..(i + 1) * blocks], z, elevations[i]);
                    let position = AxisPlace {
                        weight: GAUSS[i].1 * length.share * element.length,
                        deflection: length.deflections[i],
                        slope: length.slopes[i],
                        wet,
                        flow,
                    };
                    let (forces, added) = (&mut self.forces[length.element], &mut self.added[length.element]);
                    position.load(case, element, &motion, forces, added);
                }
            }
            SubmergenceState::Cut { limits, pieces } => {
                for piece in limits.windows(2).take(pieces) {
                    self.piece(length, element, &motion, piece[0], piece[1]);
                }
            }
        }
    }

    /// Adds the loads of a piece of a length, from one fraction of it to another, with the actual surface.
    fn piece(
        &mut self,
        length: &IntegrationLength,
        element: &TetherElement,
        motion: &ElementMotion,
        from: f64,
        to: f64,
    ) {
        let case = self.case;
        let start = length.x[0] - (length.from + length.share * GAUSS[0].0) * element.length;
        for (at, weight) in GAUSS {
            let a = length.from + length.share * (from + (to - from) * at);
            let shape = deflection(a, element.length);
            let y = if self.waters.lateral { dot(&shape, &motion.at[0]) } else { 0.0 };
            self.position.clear();
            let distance = a * element.length;
            let shift = self.shortened[length.element].shift(distance);
            self.waters.at_place(start + distance + shift, y, &mut self.position);
            let elevation = self.waters.elevation(&self.time, &self.position);
            let z = case.origin[2] + dot(&shape, &motion.at[1]);
            let wet = SubmergedSection::new(elevation - z, element.outer_diameter);
            if wet.height == 0.0 {
                continue;
            }
            let position = AxisPlace {
                weight: weight * (to - from) * length.share * element.length,
                slope: slope(a, element.length),
                flow: self.waters.flow(&self.time, &self.position, z, elevation),
                deflection: shape,
                wet,
            };
            let (forces, added) = (&mut self.forces[length.element], &mut self.added[length.element]);
            position.load(case, element, motion, forces, added);
        }
    }
}

/// A place of the axis in the water.
struct AxisPlace {
    /// Length it stands for (m).
    weight: f64,
    /// Shapes there.
    deflection: Vector4,
    slope: Vector4,
    wet: SubmergedSection,
    flow: TowedFlow,
}

impl AxisPlace {
    /// Adds its loads and its mass of water to those of its element (the upper triangle of the mass alone).
    #[inline]
    fn load(
        &self,
        case: &Towed,
        element: &TetherElement,
        motion: &ElementMotion,
        forces: &mut [Vector4; 2],
        added: &mut [Matrix4; 2],
    ) {
        let (wet, density, factors) = (&self.wet, case.density, &case.multipliers);
        let flow = &self.flow;
        let slopes = [dot(&self.slope, &motion.at[0]), dot(&self.slope, &motion.at[1])];
        // across the axis as it is sloped there
        let relative: [f64; 2] = std::array::from_fn(|p| {
            flow.velocity[p + 1] - flow.velocity[0] * slopes[p] - dot(&self.deflection, &motion.velocity[p])
        });
        let drag = 0.5 * density * element.drag * factors.drag * wet.height * relative[0].hypot(relative[1]);
        let moved = density * element.added_mass * factors.added_mass;
        for p in 0..2 {
            let acceleration = flow.acceleration[p + 1] - flow.acceleration[0] * slopes[p];
            let mass = moved * wet.added[p];
            let mut force = (density * wet.area + mass) * acceleration + drag * relative[p];
            if p == 1 {
                let enters = relative[1] > 0.0 || case.compatibility.exit_slam;
                let slam = if enters { factors.slam * moved * wet.growth * relative[1] * relative[1] } else { 0.0 };
                force += density * case.gravity * wet.area + slam;
                // buoyancy acts below the axis, which on a sloped tube is beside it
                let moment = density * case.gravity * wet.moment * slopes[1];
                add(&mut forces[1], self.weight * moment, &self.slope);
            }
            add(&mut forces[p], self.weight * force, &self.deflection);
            for (i, row) in added[p].iter_mut().enumerate() {
                let part = self.weight * mass * self.deflection[i];
                for (entry, shape) in row.iter_mut().zip(&self.deflection).skip(i) {
                    *entry += part * shape;
                }
            }
        }
    }
}
