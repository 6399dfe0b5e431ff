//! The pressure of waves on a hull that does not change them (Froude and Krylov), up to the surface where it is: pieces of
//! `-DIFTYPE FK`.
//!
//! The whole pressure, `-rho g z` with the dynamic pressure of the waves, is integrated over the panels below the surface of the waves, and
//! the hydrostatics up to the mean level, which are the body's buoyancy, are taken off. All of it is found once a step, at the place expected
//! at its end.
//!
//! Panels are triangles whose edges are no longer than `EDGE` over the root mean square wave number of the pressure at their highest corner,
//! and near the surface, with the body where it is at the start, than `EDGE_AT_SURFACE` over that of the waves. On a panel whose nodes are all below the mean level and the waves, the
//! dynamic pressure alone is left; it is integrated by its values at the middles of the three edges, which is exact for a pressure of the
//! second degree [STRANG-FIX-1973 table 4.1]. A panel that the surface cuts is taken as four triangles: the surface of the waves is a
//! straight line across each, and below it the pressure is that of water at rest, by the elevations at the six nodes, with what the waves
//! differ from it linear in each triangle.
//!
//! What the hull makes of the waves, diffraction and radiation, needs a hydrodynamic database, which is why a piece
//! that is in one takes no part here.

use super::buoyancy::skin;
use super::hull::{Panel, Panelling, Surface};
use super::low_frequency::{SlowWrench, dividing_period, dividing_period_of};
use super::parts::map_parts;
use super::sea::{FilledGrid, PressureGrid, Sea, SeaAt};
use super::{BodyLoad, BodyStep, Category, DividedLoad, DynamicLoad, Load, PreparedLoad, StatefulLoad};
use nalgebra::Vector3;
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_model::{Body, ClassError, Model, WaveAction};

/// Longest edge of a panel times the root mean square wave number of the pressure on it: the force of a wave on a submerged box errs by less
/// than 5e-4, and with the fourth power of it.
const EDGE: f64 = 0.8;
/// The same of a panel that waves may cut; there the error goes with the square.
const EDGE_AT_SURFACE: f64 = 0.45;
/// Standard deviations of the surface from the mean level within which waves may cut a panel.
const SURFACE_BAND_DEVIATIONS: f64 = 3.0;
/// Nodes taken together by one thread.
const NODES_A_PART: usize = 256;
/// Panels at the surface taken together by one thread.
const PANELS_A_PART: usize = 64;
/// Panels of a piece beyond which all their edges are longer.
const MAX_PANELS_A_PIECE: usize = 20_000;

/// The pressure of a sea on the pieces of a body.
#[derive(Debug)]
pub struct WavePressure {
    sea: Arc<Sea>,
    /// Where the sea can be summed on a grid.
    grid: Option<PressureGrid>,
    /// Nodes of all pieces, body coordinates (m).
    nodes: Vec<Node>,
    panels: Vec<ScaledPanel>,
    /// Weight of the water (N/m3).
    weight: f64,
    slow: SlowWrench,
}

/// A node of the panels.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// Its place in the body (m).
    position: Vector3<f64>,
    /// Force and moment about the body's origin of a unit pressure at it on all panels whose edge it halves, in body axes (m2, m3); zero for a
    /// corner.
    wrench: Six,
    /// Whether it has one.
    counts: bool,
}

/// A panel with the factor of its piece.
#[derive(Clone, Copy, Debug)]
struct ScaledPanel {
    panel: Panel,
    factor: f64,
}

/// A node near the surface: its arm from the body's origin, its heights over the mean level and over the waves (m), by how much the
/// pressure of the waves differs there from that of water at rest below their surface (Pa), and a coordinate above whose zero it does not: there
/// the stretching ends.
#[derive(Clone, Copy, Debug, Default)]
struct NodePressure {
    arm: Vector3<f64>,
    height: f64,
    over: f64,
    extra: f64,
    kink: f64,
}

/// The wave pressure on a body under way; `None` without waves or without such pieces.
///
/// # Errors
/// A piece that is not a closed surface.
pub fn build_wave_pressure(
    model: &Model,
    body: &Body,
    sea: Option<&Arc<Sea>>,
) -> Result<Option<WavePressure>, ClassError> {
    let Some(sea) = sea else { return Ok(None) };
    let mut surfaces = Vec::new();
    for part in model.parts_of(body) {
        for piece in part.pieces.iter().filter(|p| p.waves == WaveAction::Pressure && p.permeability != 0.0) {
            let Some(surface) = skin(part, piece)? else { continue };
            let factor = piece.permeability * model.multipliers.factor(Category::Wave.name(), &part.name);
            surfaces.push((factor, surface));
        }
    }
    let pose = Pose::from_place(&body.position);
    let slow = SlowWrench::new(dividing_period(model, Some(sea)));
    let made = |surfaces: Vec<_>| WavePressure { slow, ..from_surfaces(sea, surfaces.into_iter(), &pose, 1.0) };
    Ok((!surfaces.is_empty()).then(|| made(surfaces)))
}

/// Root mean square of the wave numbers (1/m) of the pressure of a sea at a height over the mean level (m, not above it), by its energy.
fn mean_number(sea: &Sea, height: f64) -> f64 {
    let longest = sea.components.iter().map(|c| c.number).fold(f64::INFINITY, f64::min);
    let [all, numbers] = sea.components.iter().fold([0.0; 2], |[all, numbers], c| {
        let pressure = c.amplitude * ((c.number - longest) * height).exp();
        let energy = pressure * pressure;
        [all + energy, numbers + energy * c.number * c.number]
    });
    if all > 0.0 { (numbers / all).sqrt() } else { 0.0 }
}

/// That on closed surfaces with a factor each, whose panels suit the waves in a pose; `finer` divides the lengths of their edges.
fn from_surfaces(
    sea: &Arc<Sea>,
    surfaces: impl Iterator<Item = (f64, Surface)>,
    pose: &Pose,
    finer: f64,
) -> WavePressure {
    let near =
        SURFACE_BAND_DEVIATIONS * (0.5 * sea.components.iter().map(|c| c.amplitude * c.amplitude).sum::<f64>()).sqrt();
    let at_surface = EDGE_AT_SURFACE / mean_number(sea, 0.0) / finer;
    let height = |position: &Vector3<f64>| pose.origin.z + (pose.axes * position).z - sea.level;
    // a body that is raised by the waves takes its panels with it
    let longest_at = |height: f64| EDGE / mean_number(sea, (height + near).min(0.0)) / finer;
    let limit = |corners: &[Vector3<f64>; 3]| {
        let [low, high] = corners
            .iter()
            .map(height)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)]);
        if low < near && high > -near { at_surface } else { longest_at(high) }
    };
    let (mut nodes, mut panels): (Vec<Node>, Vec<ScaledPanel>) = (Vec::new(), Vec::new());
    for (factor, surface) in surfaces {
        let lowest = surface.vertices.iter().map(height).fold(f64::INFINITY, f64::min);
        let made = Panelling::new(&surface, longest_at(lowest), MAX_PANELS_A_PIECE).refine(&limit, MAX_PANELS_A_PIECE);
        let first = nodes.len() as u32;
        nodes.extend(made.nodes.into_iter().map(|position| Node { position, wrench: Six::zeros(), counts: false }));
        panels.extend(made.panels.into_iter().map(|p| ScaledPanel { panel: p.map(|n| n + first), factor }));
    }
    let position = |nodes: &[Node], n: u32| nodes[n as usize].position;
    for ScaledPanel { panel: [a, b, c, middles @ ..], factor } in &panels {
        let [a, b, c] = [a, b, c].map(|n| position(&nodes, *n));
        // a third of the area against the normal
        let third = (b - a).cross(&(c - a)) * (-factor / 6.0);
        for middle in middles {
            let node = &mut nodes[*middle as usize];
            node.wrench += about_origin(&node.position, &third);
            node.counts = true;
        }
    }
    let corners = nodes.iter().map(|n| (n.position, n.position));
    let extent = corners.reduce(|(low, high), (p, q)| (low.inf(&p), high.sup(&q))).map(|(low, high)| high - low);
    let grid = extent.and_then(|extent| PressureGrid::new(sea, [extent.norm(), extent.z], nodes.len()));
    let weight = sea.density * sea.gravity;
    let slow = SlowWrench::new(dividing_period_of(Some(sea)));
    WavePressure { sea: Arc::clone(sea), grid, nodes, panels, weight, slow }
}

/// A force and its moment about the origin.
fn about_origin(arm: &Vector3<f64>, force: &Vector3<f64>) -> Six {
    let moment = arm.cross(force);
    Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

/// The quarters of a panel, by their corners among its nodes.
const QUARTERS: [[usize; 3]; 4] = [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]];
/// Barycentric coordinates of the nodes of a panel.
const NODES: [[f64; 3]; 6] =
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5]];
/// Integrals over a panel, by its area, of the quadratic polynomial that is one at one of its nodes and zero at the others, times each
/// barycentric coordinate (`2 a! b! c! / (a + b + c + 2)!` for powers a, b, c).
const QUADRATIC_MOMENTS: [[f64; 3]; 6] = {
    let (own, other, beside, opposite) = (1.0 / 30.0, -1.0 / 60.0, 2.0 / 15.0, 1.0 / 15.0);
    [
        [own, other, other],
        [other, own, other],
        [other, other, own],
        [beside, beside, opposite],
        [opposite, beside, beside],
        [beside, opposite, beside],
    ]
};

/// A corner of a part of a panel: its barycentric coordinates, and what a [`NodePressure`] says of it.
#[derive(Clone, Copy, Debug)]
struct PanelCorner {
    position: [f64; 3],
    over: f64,
    extra: f64,
    kink: f64,
}

/// Where the line through the corners' zeros of a value divides a triangle.
#[allow(clippy::large_enum_variant, reason = "it lives on the stack, for a few instructions")]
enum ZeroLineCut {
    /// The whole triangle is below it.
    Below,
    /// The whole triangle is above it.
    Above,
    /// It parts one corner from the others: that corner, the other two in turn, and the ends of the line on the edges to them.
    Across { below: bool, corners: [PanelCorner; 3], ends: [PanelCorner; 2] },
}

/// How the zeros of a value divide a triangle; zero counts as below.
#[inline(always)]
fn divide([a, b, c]: &[PanelCorner; 3], value: impl Fn(&PanelCorner) -> f64) -> ZeroLineCut {
    let [p, q, r] = match [value(a) <= 0.0, value(b) <= 0.0, value(c) <= 0.0] {
        [true, true, true] => return ZeroLineCut::Below,
        [false, false, false] => return ZeroLineCut::Above,
        [true, false, false] | [false, true, true] => [a, b, c],
        [false, true, false] | [true, false, true] => [b, c, a],
        _ => [c, a, b],
    };
    let end = |q: &PanelCorner| {
        let share = value(p) / (value(p) - value(q));
        let between = |a: f64, b: f64| a + (b - a) * share;
        PanelCorner {
            position: std::array::from_fn(|i| between(p.position[i], q.position[i])),
            over: between(p.over, q.over),
            extra: between(p.extra, q.extra),
            kink: between(p.kink, q.kink),
        }
    };
    ZeroLineCut::Across { below: value(p) <= 0.0, ends: [end(q), end(r)], corners: [*p, *q, *r] }
}

/// Integrals of a pressure over parts of a panel, times each of its barycentric coordinates, over the panel's area.
#[derive(Clone, Copy, Debug, Default)]
struct PressureMoments([f64; 3]);

impl PressureMoments {
    /// Adds those over a triangle, which counts by a share, of a pressure that is linear on it, by its values at the corners.
    #[inline(always)]
    fn add_linear(&mut self, corners: &[PanelCorner; 3], counts: f64, [a, b, c]: [f64; 3]) {
        let twelfth = share(corners) * counts / 12.0;
        let [u, v, w] = corners.each_ref().map(|corner| &corner.position);
        for (i, sum) in self.0.iter_mut().enumerate() {
            *sum += twelfth * ((a + b + c) * (u[i] + v[i] + w[i]) + a * u[i] + b * v[i] + c * w[i]);
        }
    }

    /// Adds those over a triangle, which counts by a share, of a polynomial of the second degree by its values at the panel's nodes; by the
    /// middles of the edges.
    #[inline(always)]
    fn add_quadratic(&mut self, corners: &[PanelCorner; 3], counts: f64, values: &[f64; 6]) {
        let third = share(corners) * counts / 3.0;
        let [a, b, c] = corners.each_ref().map(|corner| &corner.position);
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let position = std::array::from_fn(|i| 0.5 * (p[i] + q[i]));
            let part = third * quadratic(values, &position);
            for (sum, share) in self.0.iter_mut().zip(position) {
                *sum += part * share;
            }
        }
    }
}

/// Applies an integral, which takes a triangle and by how much it counts, to the part of a triangle below the surface.
#[inline(always)]
fn below_surface(corners: &[PanelCorner; 3], counts: f64, mut integral: impl FnMut(&[PanelCorner; 3], f64)) {
    match divide(corners, |c| c.over) {
        ZeroLineCut::Above => {}
        ZeroLineCut::Below => integral(corners, counts),
        ZeroLineCut::Across { below: true, corners: [p, ..], ends: [q, r] } => integral(&[p, q, r], counts),
        ZeroLineCut::Across { below: false, corners: [p, ..], ends: [q, r] } => {
            integral(corners, counts);
            integral(&[p, q, r], -counts);
        }
    }
}

/// The value at a place of a panel of a polynomial of the second degree with these values at the nodes.
#[inline(always)]
fn quadratic(values: &[f64; 6], [u, v, w]: &[f64; 3]) -> f64 {
    let corners = values[0] * u * (2.0 * u - 1.0) + values[1] * v * (2.0 * v - 1.0) + values[2] * w * (2.0 * w - 1.0);
    corners + 4.0 * (values[3] * u * v + values[4] * v * w + values[5] * w * u)
}

/// Adds what the waves differ from water at rest below their surface, linear on the part of a triangle below the end of the stretching and zero at that
/// end, over what of it is wet. A quadrangle is cut along each of its diagonals, and each way counts half, so that a mirrored one gives the same.
#[inline(always)]
fn add_stretched(sum: &mut PressureMoments, corners: &[PanelCorner; 3], ends_at_surface: bool) {
    let mut wet = |part: [PanelCorner; 3], counts: f64| {
        below_surface(&part, counts, |part, counts| sum.add_linear(part, counts, part.each_ref().map(|c| c.extra)));
    };
    // what is cut there is then at the surface, and not beside it by rounding
    let at_end = |c: PanelCorner| PanelCorner { extra: 0.0, over: if ends_at_surface { 0.0 } else { c.over }, ..c };
    let ended = |c: PanelCorner| if c.kink == 0.0 { at_end(c) } else { c };
    match divide(corners, |c| c.kink) {
        ZeroLineCut::Above => {}
        ZeroLineCut::Below => wet(corners.map(ended), 1.0),
        ZeroLineCut::Across { below, corners: [p, q, r], ends: [pq, pr] } => {
            let ([p, q, r], pq, pr) = ([p, q, r].map(ended), at_end(pq), at_end(pr));
            if below {
                wet([p, pq, pr], 1.0);
            } else {
                wet([pq, q, r], 0.5);
                wet([pq, r, pr], 0.5);
                wet([pq, q, pr], 0.5);
                wet([q, r, pr], 0.5);
            }
        }
    }
}

/// Force and moment of the waves on a panel near the surface, beyond those of the mean level. Of its quarters the wet parts are taken: on each
/// the pressure of water at rest below the surface of the waves, which is of the second degree between the nodes, and linearly what the
/// waves differ from it, up to where the stretching ends. What the mean level gives is linear.
fn near_surface(near: &[NodePressure; 6], weight: f64) -> Six {
    let over = near.map(|n| n.over);
    let ends_at_surface = near.iter().all(|n| n.kink == n.over);
    let all_wet = over.iter().all(|over| *over <= 0.0);
    let mut sum = PressureMoments::default();
    if all_wet {
        for (value, moments) in over.iter().zip(&QUADRATIC_MOMENTS) {
            for (sum, moment) in sum.0.iter_mut().zip(moments) {
                *sum -= weight * value * moment;
            }
        }
    }
    for quarter in QUARTERS {
        let corners = quarter.map(|n| {
            let NodePressure { over, extra, kink, .. } = near[n];
            PanelCorner { position: NODES[n], over, extra, kink }
        });
        if corners.iter().all(|c| c.over > 0.0) {
            continue;
        }
        if !all_wet {
            below_surface(&corners, -weight, |part, counts| sum.add_quadratic(part, counts, &over));
        }
        let below = |value: fn(&PanelCorner) -> f64| corners.iter().filter(|c| value(c) < 0.0).count();
        match (below(|c| c.kink), below(|c| c.over)) {
            (0, _) => {}
            (3, 3) => sum.add_linear(&corners, 1.0, corners.each_ref().map(|c| c.extra)),
            _ => add_stretched(&mut sum, &corners, ends_at_surface),
        }
    }
    let corner = |n: usize| PanelCorner { position: NODES[n], over: near[n].height, extra: 0.0, kink: 0.0 };
    below_surface(&[corner(0), corner(1), corner(2)], weight, |part, counts| {
        sum.add_linear(part, counts, part.each_ref().map(|c| c.over));
    });
    // against the normal
    let area = (near[1].arm - near[0].arm).cross(&(near[2].arm - near[0].arm)) * -0.5;
    let [u, v, w] = sum.0;
    let about = near[0].arm * u + near[1].arm * v + near[2].arm * w;
    let (force, moment) = (area * (u + v + w), about.cross(&area));
    Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

/// The area of a triangle in barycentric coordinates, as a share of the panel's.
fn share([a, b, c]: &[PanelCorner; 3]) -> f64 {
    let edge = |p: &PanelCorner, q: &PanelCorner| [q.position[0] - p.position[0], q.position[1] - p.position[1]];
    let ([x, y], [u, v]) = (edge(a, b), edge(a, c));
    (x * v - y * u).abs()
}

/// The sea at one time around a body.
struct LocalSea<'a> {
    sea: SeaAt<'a>,
    grid: Option<FilledGrid<'a>>,
    origin: Vector3<f64>,
    /// Depth of the origin below the mean level (m).
    sunk: f64,
    weight: f64,
    /// Heights over the mean level below which all nodes are deep, and above which all are dry (m).
    range: [f64; 2],
}

/// How a node lies in the water of an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
enum NodeSubmergence {
    /// Below the mean level and the waves.
    Deep,
    /// Near the surface.
    Near,
    /// Above the mean level and the waves near it.
    Dry,
}

impl<'a> LocalSea<'a> {
    /// That around an origin, and over a mean level (m), in water of a weight (N/m3).
    fn new(sea: SeaAt<'a>, grid: Option<FilledGrid<'a>>, (origin, level): (Vector3<f64>, f64), weight: f64) -> Self {
        let highest = sea.highest();
        let [low, high] = grid.as_ref().map_or([-highest, highest], FilledGrid::range);
        let range = [low.min(0.0), high.max(0.0)];
        LocalSea { sunk: level - origin.z, sea, grid, origin, weight, range }
    }

    /// How a place at an arm from the origin lies, with the waves of this instant near it.
    fn lies(&self, arm: &Vector3<f64>) -> NodeSubmergence {
        let height = arm.z - self.sunk;
        let [low, high] = match self.grid.as_ref() {
            _ if height < self.range[0] => return NodeSubmergence::Deep,
            _ if height > self.range[1] => return NodeSubmergence::Dry,
            Some(grid) => grid.bounds(arm).unwrap_or(self.range),
            None => [self.sea.elevation(self.origin.x + arm.x, self.origin.y + arm.y); 2],
        };
        if height < low.min(0.0) {
            NodeSubmergence::Deep
        } else if height > high.max(0.0) {
            NodeSubmergence::Dry
        } else {
            NodeSubmergence::Near
        }
    }

    /// The surface and the pressure at an arm from the origin.
    fn surface_and_pressure(&self, arm: &Vector3<f64>) -> NodePressure {
        let height = arm.z - self.sunk;
        let on_grid = self.grid.as_ref().and_then(|grid| {
            let elevation = grid.elevation(arm)?;
            let depth = -self.sea.stretched_height(height, elevation)[0];
            let head = if depth > 0.0 { grid.head(arm, depth)? } else { elevation };
            Some((elevation, head * self.weight))
        });
        let (elevation, dynamic) = on_grid.unwrap_or_else(|| {
            let found = self.sea.kinematics_beyond_surface(self.origin + arm);
            (found.elevation, found.pressure)
        });
        let over = height - elevation;
        let kink =
            if self.sea.ends_at_surface() { over } else { self.sea.stretched_height(height, elevation).iter().sum() };
        NodePressure { arm: *arm, height, over, extra: dynamic - self.weight * elevation, kink }
    }

    /// Dynamic pressure (Pa) at an arm from the origin that is deep.
    fn dynamic(&self, arm: &Vector3<f64>) -> f64 {
        let height = arm.z - self.sunk;
        let on_grid = self.grid.as_ref().and_then(|grid| {
            let elevation = if self.sea.needs_elevation(height) { grid.elevation(arm)? } else { 0.0 };
            grid.head(arm, -self.sea.stretched_height(height, elevation)[0])
        });
        on_grid.map_or_else(|| self.sea.kinematics_to_surface(self.origin + arm).pressure, |head| head * self.weight)
    }
}

impl WavePressure {
    /// The force of the waves at a time in a pose, beyond that of the mean level. Nodes and panels are taken in parts of a fixed size side by
    /// side, whose sums are added in their order: the digits do not depend on the number of threads.
    pub fn force_at(&self, time: f64, pose: &Pose) -> Six {
        let [x, y, z] = [0, 1, 2].map(|axis| pose.axes.column(axis).into_owned());
        let arm = |Node { position: p, .. }: &Node| x * p.x + y * p.y + z * p.z;
        let arms: Vec<Vector3<f64>> = self.nodes.iter().map(arm).collect();
        let origin = pose.origin;
        let grid = self.grid.as_ref().map(|grid| grid.fill(&self.sea, time, origin, &arms));
        let around = LocalSea::new(self.sea.at_time(time), grid, (origin, self.sea.level), self.weight);
        // of all that is deep, by the middles of the edges
        let mut lies = vec![NodeSubmergence::Dry; arms.len()];
        let mut pressures = vec![0.0; arms.len()];
        let inputs = self.nodes.chunks(NODES_A_PART).zip(arms.chunks(NODES_A_PART));
        let outputs = lies.chunks_mut(NODES_A_PART).zip(pressures.chunks_mut(NODES_A_PART));
        let sums = map_parts(inputs.zip(outputs), |((nodes, arms), (lies, pressures))| {
            let mut sum = Six::zeros();
            for (((node, arm), lies), kept) in nodes.iter().zip(arms).zip(lies).zip(pressures) {
                *lies = around.lies(arm);
                if *lies == NodeSubmergence::Deep && node.counts {
                    *kept = around.dynamic(arm);
                    sum += node.wrench * *kept;
                }
            }
            sum
        });
        let sum = sums.iter().fold(Six::zeros(), |sum, part| sum + part);
        let turned = |first: usize| pose.axes * sum.fixed_rows::<3>(first);
        let (force, moment) = (turned(0), turned(3));
        let whole = Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
        // the other panels: what their deep middles gave is replaced
        let (mut asked, mut positions) = (Vec::new(), vec![u32::MAX; arms.len()]);
        let mut at_surface: Vec<([u32; 6], &ScaledPanel)> = Vec::new();
        for pressed in &self.panels {
            let all = |how: NodeSubmergence| pressed.panel.iter().all(|n| lies.get(*n as usize) == Some(&how));
            // of a dry panel no middle is deep
            if all(NodeSubmergence::Deep) || all(NodeSubmergence::Dry) {
                continue;
            }
            let own = pressed.panel.map(|n| match positions.get_mut(n as usize) {
                Some(position) if *position == u32::MAX => {
                    *position = asked.len() as u32;
                    asked.push(n as usize);
                    *position
                }
                Some(position) => *position,
                None => u32::MAX,
            });
            at_surface.push((own, pressed));
        }
        let near = |n: &usize| arms.get(*n).map(|arm| (around.surface_and_pressure(arm), pressures.get(*n).copied()));
        let known =
            map_parts(asked.chunks(NODES_A_PART / 4), |part| part.iter().map(near).collect::<Vec<_>>()).concat();
        let sums = map_parts(at_surface.chunks(PANELS_A_PART), |panels| {
            panels.iter().fold(Six::zeros(), |sum, panel| sum + self.beyond_deep(panel, &known))
        });
        sums.iter().fold(whole, |sum, part| sum + part)
    }

    /// The force on a panel at the surface, less that of the deep ones among the middles of its edges, by what is known of its nodes.
    fn beyond_deep(
        &self,
        (nodes, pressed): &([u32; 6], &ScaledPanel),
        known: &[Option<(NodePressure, Option<f64>)>],
    ) -> Six {
        let (mut near, mut counted) = ([NodePressure::default(); 6], [0.0; 6]);
        for ((near, counted), n) in near.iter_mut().zip(&mut counted).zip(nodes) {
            if let Some(Some((found, deep))) = known.get(*n as usize) {
                (*near, *counted) = (*found, deep.unwrap_or_default());
            }
        }
        let third = (near[1].arm - near[0].arm).cross(&(near[2].arm - near[0].arm)) / 6.0;
        let wet = near.iter().all(|n| n.over < 0.0 && n.height < 0.0);
        let mut own = if wet || near.iter().all(|n| n.over > 0.0 && n.height > 0.0) {
            Six::zeros()
        } else {
            near_surface(&near, self.weight)
        };
        for (node, counted) in near.iter().zip(counted).skip(3) {
            let dynamic = if wet { node.extra + self.weight * (node.height - node.over) } else { 0.0 };
            if counted != dynamic {
                own += about_origin(&node.arm, &third) * (counted - dynamic);
            }
        }
        own * pressed.factor
    }
}

/// Of the state of [`WavePressure`] what the step has kept; behind it what is slow.
const STEP_STATES: usize = 6;

impl BodyLoad for WavePressure {
    fn category(&self) -> Category {
        Category::Wave
    }

    /// Its mean: that of the waves of first order, nothing.
    fn mean_load(&self, _pose: &Pose) -> Result<Load, ClassError> {
        Ok(Load::none())
    }

    fn dynamic_load(&self, _at: &BodyStep, state: &[f64]) -> Result<DynamicLoad, ClassError> {
        Ok(DynamicLoad::from(Load { wrench: memory_of(state), ..Load::none() }))
    }

    fn as_stateful(&self) -> Option<&dyn StatefulLoad> {
        Some(self)
    }

    fn as_prepared(&self) -> Option<&dyn PreparedLoad> {
        Some(self)
    }

    fn as_divided(&self) -> Option<&dyn DividedLoad> {
        Some(self)
    }
}

impl StatefulLoad for WavePressure {
    fn states(&self) -> usize {
        STEP_STATES + SlowWrench::STATES
    }

    fn begin(&self, ahead: &BodyStep, state: &mut [f64]) -> Result<(), ClassError> {
        let found = self.force_at(ahead.time, ahead.pose);
        if found.iter().any(|x| !x.is_finite()) {
            return Err(ClassError::new("the pressure of the waves has no value where the body is"));
        }
        for (kept, value) in state.iter_mut().zip(found.iter()) {
            *kept = *value;
        }
        Ok(())
    }

    fn commit(&self, at: &BodyStep, state: &mut [f64]) {
        let wrench = memory_of(state);
        self.slow.commit(&wrench, at.dt, &mut state[STEP_STATES..]);
    }
}

impl PreparedLoad for WavePressure {
    fn prepared_wrench(&self, _at: &BodyStep, state: &[f64]) -> Six {
        memory_of(state)
    }
}

impl DividedLoad for WavePressure {
    fn other_categories(&self) -> &'static [Category] {
        &[Category::WaveMean]
    }

    fn part(&self, _: Category, _: &BodyStep, state: &[f64]) -> Six {
        SlowWrench::low_frequency_part(&state[STEP_STATES..])
    }
}

fn memory_of(state: &[f64]) -> Six {
    Six::from_iterator(state.iter().copied().chain([0.0; STEP_STATES]).take(STEP_STATES))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::sea::{Component, Water};
    use super::*;
    use nalgebra::Rotation3;
    use windlass_model::Stretching;

    const G: f64 = 9.80665;
    const RHO: f64 = 1025.0;

    /// Waves toward a direction (rad), the quantiles of an ISSC spectrum of 11 s; one of 6 s where there is one.
    fn sea(count: u32, toward: f64, amplitude: f64, stretching: Stretching) -> Arc<Sea> {
        let waves = (0..count).map(|n| {
            let share = (f64::from(n) + 0.5) / f64::from(count);
            let period = if count == 1 { 6.0 } else { 11.0 * (-0.8 * share.ln()).powf(0.25) };
            let frequency = std::f64::consts::TAU / period;
            let (sin, cos) = toward.sin_cos();
            let number = frequency * frequency / G;
            Component { frequency, number, amplitude, toward: [cos, sin], phase: f64::from(n * n) * 0.37 }
        });
        let water = Water { depth: None, level: 0.0, gravity: G, density: RHO };
        Arc::new(Sea::airy(waves.collect(), water, 0.0, stretching))
    }

    fn wave_pressure_of_boxes(sea: &Arc<Sea>, boxes: &[[[f64; 3]; 2]], finer: f64) -> WavePressure {
        let surfaces = boxes.iter().map(|[low, high]| (1.0, Surface::block(*low, *high)));
        from_surfaces(sea, surfaces, &Pose::default(), finer)
    }

    const SEMI: [[[f64; 3]; 2]; 6] = [
        [[-45.0, 22.5, -21.0], [45.0, 37.5, -12.0]],
        [[-45.0, -37.5, -21.0], [45.0, -22.5, -12.0]],
        [[24.0, 23.5, -12.0], [37.0, 36.5, 13.0]],
        [[-37.0, 23.5, -12.0], [-24.0, 36.5, 13.0]],
        [[24.0, -36.5, -12.0], [37.0, -23.5, 13.0]],
        [[-37.0, -36.5, -12.0], [-24.0, -23.5, 13.0]],
    ];

    #[test]
    fn submerged_box_in_oblique_wave_matches_closed_form() {
        let (toward, a, [long, wide], [low, high]) = (0.7f64, 0.8, [90.0, 15.0], [-21.0, -12.0]);
        let sea = sea(1, toward, a, Stretching::Linear);
        let made = wave_pressure_of_boxes(&sea, &[[[-45.0, -7.5, low], [45.0, 7.5, high]]], 1.0);
        let wave = sea.components[0];
        let (k, w) = (wave.number, wave.frequency);
        let [kx, ky] = [k * toward.cos(), k * toward.sin()];
        // int cos(kx x) dx over the length, and of the width and the height alike
        let (x, y) = (2.0 * (kx * long / 2.0).sin() / kx, 2.0 * (ky * wide / 2.0).sin() / ky);
        let z = ((k * high).exp() - (k * low).exp()) / k;
        let scale = RHO * G * a;
        for time in [0.3, 1.7, 3.1] {
            let (sin, cos) = (w * time).sin_cos();
            // the gradient of rho g a e^(kz) cos(kx x + ky y - wt) over the volume, against it
            let want = Vector3::new(-kx * sin, -ky * sin, -k * cos) * (scale * x * y * z);
            let got = made.force_at(time, &Pose::default());
            // cells of 5.6 m by 5 m, k h = 0.63 (the mean number of one wave is its own): fourth powers over some hundreds
            let error = (got.fixed_rows::<3>(0) - want).norm() / (scale * x * y * z * k).abs();
            assert!(error < 5e-4, "{error} at {time}");
        }
    }

    #[test]
    fn hull_far_from_origin_matches_closed_form_of_waves() {
        // the box is 6500 km from the origin of its body, as in a projection of maps; two hundred waves, each of the closed form above
        let far = 6.5e6;
        let sea = sea(200, 0.0, 0.15, Stretching::Linear);
        let made = wave_pressure_of_boxes(&sea, &[[[far - 45.0, -7.5, -30.0], [far + 45.0, 7.5, -21.0]]], 2.0);
        assert!(made.grid.is_some());
        let pose = Pose { origin: Vector3::new(-far, 0.0, 0.0), ..Pose::default() };
        for time in [0.0, 4.1, 9.3] {
            let (mut want, mut scale) = (Vector3::zeros(), 0.0);
            for wave in &sea.components {
                let (k, a) = (wave.number, wave.amplitude);
                let volume = 2.0 * (k * 45.0).sin() / k * 15.0 * ((k * -21.0).exp() - (k * -30.0).exp()) / k;
                let (sin, cos) = (wave.phase - wave.frequency * time).sin_cos();
                // the gradient of rho g a e^(kz) cos(kx - wt + phase) over the volume, against it
                want += Vector3::new(k * sin, 0.0, -k * cos) * (RHO * G * a * volume);
                scale += (RHO * G * a * k * volume).powi(2);
            }
            let got = made.force_at(time, &pose).fixed_rows::<3>(0).into_owned();
            // panels of half the usual length: a sixteenth of 5e-4, by the standard deviation of the force; rounding of 1e-9 m
            let error = (got - want).norm() / (0.5 * scale).sqrt();
            assert!(error < 5e-5, "{error} at {time}");
        }
    }

    #[test]
    fn symmetric_hull_and_sea_give_symmetric_forces() {
        // waves along x on hulls symmetric about y = 0: no sway, roll or yaw
        for (count, stretching) in [(1, Stretching::Linear), (200, Stretching::Wheeler)] {
            let sea = sea(count, std::f64::consts::PI, 1.0 / f64::from(count).sqrt(), stretching);
            for boxes in [&SEMI[..], &[[[-10.0, -10.0, -5.0], [10.0, 10.0, 5.0]]]] {
                let made = wave_pressure_of_boxes(&sea, boxes, 1.0);
                let axes = *Rotation3::from_euler_angles(0.0, 0.05, 0.0).matrix();
                let pose = Pose { origin: Vector3::new(3.0, 0.0, -0.4), axes };
                for time in [10.0, 11.3, 12.9] {
                    let got = made.force_at(time, &pose);
                    // rounding, of the buoyancy of the whole hull on arms of 30 m
                    let gross = RHO
                        * G
                        * boxes
                            .iter()
                            .map(|[low, high]| (0..3).map(|i| high[i] - low[i]).product::<f64>())
                            .sum::<f64>();
                    assert!(
                        got[1].abs() < 1e-13 * gross && got[3].abs().max(got[5].abs()) < 1e-12 * gross * 30.0,
                        "{got}"
                    );
                }
            }
        }
    }

    #[test]
    fn semi_submersible_forces_converge_and_do_not_depend_on_grid() {
        let sea = sea(200, 0.64, 0.15, Stretching::Linear);
        let (usual, finer) = (wave_pressure_of_boxes(&sea, &SEMI, 1.0), wave_pressure_of_boxes(&sea, &SEMI, 4.0));
        let direct = WavePressure { grid: None, ..wave_pressure_of_boxes(&sea, &SEMI, 1.0) };
        let (mut largest, mut off, mut of_grid) = (Six::zeros(), Six::zeros(), Six::zeros());
        for n in 0..6 {
            let t = f64::from(n);
            let axes = *Rotation3::from_euler_angles(0.03 * t.sin(), 0.04 * (2.0 * t).cos(), 0.1).matrix();
            let pose = Pose { origin: Vector3::new(3.0 * t.sin(), 5.0, t.cos()), axes };
            let time = 200.0 + 3.7 * t;
            let (got, fine) = (usual.force_at(time, &pose), finer.force_at(time, &pose));
            largest = largest.sup(&fine.abs());
            off = off.sup(&(got - fine).abs());
            if n < 2 {
                of_grid = of_grid.sup(&(got - direct.force_at(time, &pose)).abs());
            }
        }
        let (off, of_grid) = (off.component_div(&largest), of_grid.component_div(&largest));
        // panels a quarter as long leave a sixteenth of the error, and less
        assert!(off.max() < 1e-3 && off.fixed_rows::<3>(0).max() < 4e-4, "{off}");
        assert!(of_grid.max() < 1e-4 && of_grid.fixed_rows::<3>(0).max() < 3e-5, "{of_grid}");
    }
}
