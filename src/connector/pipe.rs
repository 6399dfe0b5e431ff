//! A pipe on rollers or davits, laid to the bottom: a planar beam, its inner unknowns solved and condensed to its supports.
//!
//! Source: reference/model.md, Assemblies, and the public page on pipe assemblies of the MOSES manual (conn_pipe). The plane is that of
//! global X and Z; sway, roll and yaw of a support do nothing to the pipe. Along it runs from the last support, the tensioner, over the
//! first and down to the bottom, where it is held far beyond the touchdown.

use super::planar_beam::{Assembled, Foundation, Piece, PlanarBeam};
use super::section::LineSection;
use crate::language::units::Dim;
use crate::model::{
    ClassError, Element, End, Guess, PipeLayout, Pose, Response, Situation, Six, Summary, Surroundings,
};
use nalgebra::{Matrix3, Matrix6, Rotation3, SMatrix, Vector3};

type Motion = SMatrix<f64, 6, 3>;

/// Elements between two supports.
const BETWEEN: usize = 8;
/// Elements over a length sqrt(EI/H), in which the bend at an end decays.
const PER_LAYER: f64 = 4.0;
/// Fewest and most elements from the first support on.
const FREE: [f64; 2] = [60.0, 3000.0];
/// How deep the pipe presses itself into the bottom (m).
const PRESSED: f64 = 0.01;
/// Length over which the brake of the tensioner yields as the pipe does (m).
const BRAKE: f64 = 10.0;

/// The end that a tensioner holds.
#[derive(Debug)]
struct Tensioner {
    /// As laid, least and largest (N).
    tension: [f64; 3],
    /// N/m.
    stiffness: f64,
}

/// A pipe with its supports.
#[derive(Debug)]
pub struct Pipe {
    beam: PlanarBeam,
    supports: Vec<Box<dyn Element>>,
    /// Node of each support.
    at: Vec<usize>,
    tensioner: Option<Tensioner>,
    /// 1 where it is laid toward +X, -1 toward -X.
    side: f64,
    /// Where the nodes are when it is laid: along, elevation, angle.
    laid: Vec<Vector3<f64>>,
    bottom: f64,
}

impl Pipe {
    /// Lays a pipe of this section over its supports.
    ///
    /// # Errors
    /// No depth, a support below the bottom, a tension too small to reach the bottom, a single support.
    pub fn laid(section: &LineSection, layout: PipeLayout) -> Result<Self, ClassError> {
        let around = layout.surroundings;
        let depth = around.depth.ok_or_else(|| {
            ClassError::new("a pipe is laid on the bottom, and there is no depth").help("&ENV -DEPTH gives one")
        })?;
        let PipeLayout { supports, nodes, hang, lower, upper, .. } = layout;
        let ([first, .., last], [hang_first, .., _]) = (nodes.as_slice(), hang.as_slice()) else {
            return Err(ClassError::new("a pipe with a single support is a vertical riser, which is not solved yet")
                .help("give two or more rollers or davits"));
        };
        let side = if first.origin.x >= last.origin.x { 1.0 } else { -1.0 };
        let bottom = -depth;
        let height = first.origin.z - hang_first - bottom;
        let inner = section.thickness.map_or(0.0, |t| section.od - 2.0 * t);
        let ei = section.ea * (section.od * section.od + inner * inner) / 16.0;
        let in_water = section.weight - section.displacement - buoyancy(section, around);
        // TLOW is the tension at the first davit; on rollers the tensioner begins between its limits
        let risen = section.weight * (last.origin.z - first.origin.z);
        let pulled = upper.map_or(lower + risen, |upper| 0.5 * (lower + upper));
        // by weight from the tensioner down to the first support, and from there to the bottom
        let horizontal = pulled - risen - in_water * height;
        if height <= 0.0 || in_water <= 0.0 || horizontal <= 0.0 {
            let text = "its tension of {} does not carry it to the bottom, {} below the first support, at {} in water";
            let values = [(pulled, Dim::Force), (height, Dim::Length), (in_water, Dim::ForcePerLength)];
            return Err(ClassError::of(text, &values).help("-PIPE_TENSION needs more than weight times height"));
        }
        let place = |pose: &Pose, hang: f64| Vector3::new(side * pose.origin.x, pose.origin.z - hang, 0.0);
        let stations: Vec<_> = nodes.iter().zip(&hang).rev().map(|(pose, hang)| place(pose, *hang)).collect();
        let mut made = Made { section, around, ei, in_water, pulled, pieces: Vec::new(), laid: Vec::new() };
        let mut at = Vec::new();
        made.laid.extend(stations.first());
        for pair in stations.windows(2) {
            let [a, b] = pair else { continue };
            at.push(made.laid.len() - 1);
            for n in 1..=BETWEEN {
                made.to(a + (b - a) * (n as f64 / BETWEEN as f64));
            }
        }
        at.push(made.laid.len() - 1);
        // a catenary from the first support to the bottom, and as much again on it
        let a = horizontal / in_water;
        let arc = (height * height + 2.0 * height * a).sqrt();
        let layer = (ei / horizontal).sqrt();
        let beyond = arc.max(20.0 * layer);
        let count = ((arc + beyond) / layer * PER_LAYER).clamp(FREE[0], FREE[1]).ceil();
        let across = a * (arc / a).asinh();
        let start = made.laid.last().copied().unwrap_or_default();
        for n in 1..=(count as usize) {
            let s = (arc + beyond) * (n as f64 / count);
            let up = arc - s;
            let (along, z) =
                if up > 0.0 { (across - a * (up / a).asinh(), a.hypot(up) - a) } else { (across - up, 0.0) };
            made.to(Vector3::new(start.x + along, bottom + z, 0.0));
        }
        let Made { pieces, mut laid, .. } = made;
        let slopes: Vec<f64> = laid.windows(2).map(|w| (w[1].y - w[0].y).atan2(w[1].x - w[0].x)).collect();
        for (i, node) in laid.iter_mut().enumerate() {
            let of = |i: usize| slopes.get(i).copied();
            let before = i.checked_sub(1).and_then(of);
            node.z = match (before, of(i)) {
                (Some(a), Some(b)) => 0.5 * (a + b),
                (a, b) => a.or(b).unwrap_or(0.0),
            };
        }
        let end = laid.len() - 1;
        let beam = PlanarBeam {
            pieces,
            bottom: Some(Foundation { elevation: bottom, stiffness: in_water / PRESSED }),
            held: vec![(end, 0), (end, 1), (end, 2)],
        };
        let tensioner = upper.map(|upper| Tensioner { tension: [pulled, lower, upper], stiffness: section.ea / BRAKE });
        at.reverse();
        Ok(Pipe { beam, supports, at, tensioner, side, laid, bottom })
    }

    /// The motion of a point of the pipe in global axes by that of its node.
    fn along(&self) -> Motion {
        let mut p = Motion::zeros();
        p[(0, 0)] = self.side;
        p[(2, 1)] = 1.0;
        // from the direction along toward Z
        p[(4, 2)] = -self.side;
        p
    }

    /// The pipe's point at a node.
    fn point(&self, node: &Vector3<f64>) -> End {
        let turn = Rotation3::from_scaled_axis(Vector3::y() * (-self.side * node.z));
        let origin = Vector3::new(self.side * node.x, 0.0, node.y);
        End::still(Pose { origin, axes: *turn.matrix() })
    }

    /// What support `i` and the pipe do to one another in the plane: wrenches on the support and on the pipe's point, their
    /// blocks, and the motion of the support in the plane by that of its end.
    fn held(
        &self,
        i: usize,
        node: &Vector3<f64>,
        at: &Situation,
        out: &mut Response,
    ) -> Result<Matrix6<f64>, ClassError> {
        let (Some(end), Some(support)) = (at.ends.get(i), self.supports.get(i)) else {
            return Err(ClassError::new("a pipe has an end for each of its supports"));
        };
        let (flat, motion) = flattened(&end.pose);
        let ends = [End::still(flat), self.point(node)];
        let pair = Situation { ends: &ends, step: at.step, surroundings: at.surroundings };
        support.evaluate(&pair, &[], &mut [], &mut None, out)?;
        if let (Some(tensioner), true) = (&self.tensioner, i + 1 == self.supports.len()) {
            let (wrench, blocks) = tensioner.pull(self.side, &ends);
            out.wrench.iter_mut().zip(wrench).for_each(|(w, own)| *w += own);
            out.stiffness.iter_mut().zip(blocks).for_each(|(k, own)| *k += own);
        }
        Ok(motion)
    }

    /// Nodes at rest, with the stiffness of all that holds them.
    fn rest(&self, at: &Situation, guess: &mut Guess) -> Result<(Vec<Vector3<f64>>, Assembled), ClassError> {
        /// Most steps from the catenary it is laid as.
        const MOST: usize = 2000;
        let known = guess.as_ref().and_then(|g| g.downcast_ref::<Vec<Vector3<f64>>>()).cloned();
        let mut nodes = known.unwrap_or_else(|| self.laid.clone());
        let p = self.along();
        let mut wrong: Option<ClassError> = None;
        let mut out = Response::default();
        let mut more = |nodes: &[Vector3<f64>], k: &mut Assembled| {
            for (i, node) in self.at.iter().enumerate() {
                let Some(place) = nodes.get(*node) else { continue };
                if let Err(error) = self.held(i, place, at, &mut out) {
                    wrong = Some(error);
                    continue;
                }
                let (Some(w), Some(block)) = (out.wrench.get(1), out.stiffness.get(3)) else { continue };
                if let (Some(f), Some(d)) = (k.force.get_mut(*node), k.diagonal.get_mut(*node)) {
                    *f += p.transpose() * w;
                    *d += p.transpose() * block * p;
                }
            }
        };
        let mut found = self.beam.settle(&mut nodes, MOST, &mut more);
        if found.is_none() {
            nodes = self.laid.clone();
            found = self.beam.settle(&mut nodes, MOST, &mut more);
        }
        let mut k = Assembled::default();
        self.beam.assemble(&nodes, &mut k);
        more(&nodes, &mut k);
        if let Some(error) = wrong {
            return Err(error);
        }
        if found.is_none() {
            return Err(ClassError::new("the pipe does not come to rest on its supports"));
        }
        *guess = Some(Box::new(nodes.clone()));
        Ok((nodes, k))
    }
}

/// A pose in the plane of global X and Z: its place there and the pitch of its X axis; and its motion by that of the pose.
fn flattened(pose: &Pose) -> (Pose, Matrix6<f64>) {
    let a = pose.axes.column(0);
    let square = (a[0] * a[0] + a[2] * a[2]).max(1e-12);
    let turn = Rotation3::from_scaled_axis(Vector3::y() * (-a[2]).atan2(a[0]));
    let mut motion = Matrix6::zeros();
    motion[(0, 0)] = 1.0;
    motion[(2, 2)] = 1.0;
    // of the angle of X in the plane, by d a = turn x a
    for (column, value) in [(3, -a[0] * a[1] / square), (4, 1.0), (5, -a[1] * a[2] / square)] {
        motion[(4, column)] = value;
    }
    (Pose { origin: Vector3::new(pose.origin.x, 0.0, pose.origin.z), axes: *turn.matrix() }, motion)
}

/// A pipe while its nodes are made.
struct Made<'a> {
    section: &'a LineSection,
    around: &'a Surroundings,
    ei: f64,
    in_water: f64,
    pulled: f64,
    pieces: Vec<Piece>,
    laid: Vec<Vector3<f64>>,
}

impl Made<'_> {
    /// Adds an element to a place; above the water it weighs as in air.
    fn to(&mut self, place: Vector3<f64>) {
        let Some(from) = self.laid.last() else { return };
        let apart = (place - from).xy().norm();
        let wet = 0.5 * (place.y + from.y) < self.around.tide;
        let weight = if wet { self.in_water } else { self.section.weight };
        let ea = self.section.ea;
        self.pieces.push(Piece { length: apart / (1.0 + self.pulled / ea), ea, ei: self.ei, weight });
        self.laid.push(place);
    }
}

/// Of the pipe in water (N/m).
fn buoyancy(section: &LineSection, around: &Surroundings) -> f64 {
    around.water_weight() * std::f64::consts::FRAC_PI_4 * section.buoyancy_diameter.powi(2)
}

impl Tensioner {
    /// Pulls the pipe's point back along X of the support's body: wrenches on support and pipe, and their blocks.
    fn pull(&self, side: f64, ends: &[End; 2]) -> ([Six; 2], [Matrix6<f64>; 4]) {
        let [support, point] = ends.map(|e| e.pose);
        let a = support.axes * Vector3::x() * side;
        let d = point.origin - support.origin;
        let [laid, least, most] = self.tension;
        let free = laid + self.stiffness * a.dot(&d);
        let tension = free.clamp(least, most);
        let slope = if tension == free { self.stiffness } else { 0.0 };
        let force = a * tension;
        let moment = d.cross(&force);
        // by the motion of the support, its turn, and the motion of the point
        let by_point = a * a.transpose() * slope;
        let by_turn = a * a.cross(&d).transpose() * slope - a.cross_matrix() * tension;
        let (pull, arm) = (force.cross_matrix(), d.cross_matrix());
        let mut blocks = [Matrix6::zeros(); 4];
        let mut set = |block: usize, row: usize, column: usize, value: Matrix3<f64>| {
            if let Some(k) = blocks.get_mut(block) {
                k.fixed_view_mut::<3, 3>(row, column).copy_from(&-value);
            }
        };
        set(0, 0, 0, -by_point);
        set(0, 0, 3, by_turn);
        set(0, 3, 0, pull - arm * by_point);
        set(0, 3, 3, arm * by_turn);
        set(1, 0, 0, by_point);
        set(1, 3, 0, arm * by_point - pull);
        set(2, 0, 0, by_point);
        set(2, 0, 3, -by_turn);
        set(3, 0, 0, -by_point);
        let six = |f: Vector3<f64>, m: Vector3<f64>| Six::new(f.x, f.y, f.z, m.x, m.y, m.z);
        ([six(force, moment), six(-force, Vector3::zeros())], blocks)
    }
}

impl Element for Pipe {
    fn evaluate(
        &self,
        at: &Situation,
        _: &[f64],
        _: &mut [f64],
        guess: &mut Guess,
        out: &mut Response,
    ) -> Result<(), ClassError> {
        let (nodes, k) = self.rest(at, guess)?;
        let count = self.supports.len();
        let p = self.along();
        out.clear(count);
        let mut pair = Response::default();
        let (mut sides, mut back) = (Vec::new(), Vec::new());
        for (i, node) in self.at.iter().enumerate() {
            let place = nodes.get(*node).copied().unwrap_or_default();
            let motion = self.held(i, &place, at, &mut pair)?;
            let ([w, _], [k00, k01, k10, _]) = (pair.wrench.as_slice(), pair.stiffness.as_slice()) else { continue };
            if let (Some(wrench), Some(block)) = (out.wrench.get_mut(i), out.stiffness.get_mut((count + 1) * i)) {
                *wrench = *w;
                *block = k00 * motion;
            }
            back.push(k01 * p);
            let coupling = p.transpose() * k10 * motion;
            for column in coupling.column_iter() {
                let mut side = vec![Vector3::zeros(); nodes.len()];
                if let Some(at) = side.get_mut(*node) {
                    *at = column.into_owned();
                }
                sides.push(side);
            }
        }
        let solved = self.beam.solve(&k, &sides).ok_or_else(|| ClassError::new("nothing holds the pipe"))?;
        for (i, (node, back)) in self.at.iter().zip(&back).enumerate() {
            for (column, motion) in solved.iter().enumerate() {
                let Some(motion) = motion.get(*node) else { continue };
                if let Some(block) = out.stiffness.get_mut(count * i + column / 6) {
                    let mut at = block.column_mut(column % 6);
                    at -= back * motion;
                }
            }
        }
        Ok(())
    }

    fn summary(&self, at: &Situation, _: &[f64]) -> Result<Summary, ClassError> {
        let (nodes, _) = self.rest(at, &mut None)?;
        let borne = self.beam.pieces.iter().zip(nodes.windows(2)).map(|(piece, w)| piece.borne(&w[0], &w[1]).tension);
        let lies = |w: &[Vector3<f64>]| w.iter().all(|n| n.y <= self.bottom);
        let on = self.beam.pieces.iter().zip(nodes.windows(2)).filter(|(_, w)| lies(w)).map(|(p, _)| p.length);
        let (tension, grounded) = (borne.into_iter().next(), Some(on.sum()));
        Ok(Summary { tension, grounded, solution: "beam", ..Summary::default() })
    }

    fn made_for_place(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tensioner_is_stiff_by_the_differences_of_its_wrench() {
        let tensioner = Tensioner { tension: [5e4, 1e4, 9e4], stiffness: 2e5 };
        let support = Pose::default().moved(&Six::new(1.0, 2.0, 3.0, 0.1, -0.2, 0.3));
        let point = Pose::at([1.05, 2.1, 3.2]);
        let wrench = |motions: [Six; 2]| {
            tensioner.pull(1.0, &[End::still(support.moved(&motions[0])), End::still(point.moved(&motions[1]))]).0
        };
        let blocks = tensioner.pull(1.0, &[End::still(support), End::still(point)]).1;
        for (end, freedom) in (0..2).flat_map(|e| (0..6).map(move |f| (e, f))) {
            let moved = |sign: f64| {
                let mut motions = [Six::zeros(); 2];
                motions[end][freedom] = sign * 1e-6;
                wrench(motions)
            };
            let (plus, minus) = (moved(1.0), moved(-1.0));
            for (row, component) in (0..2).flat_map(|r| (0..6).map(move |c| (r, c))) {
                let slope = -(plus[row][component] - minus[row][component]) / 2e-6;
                let own = blocks[2 * row + end][(component, freedom)];
                assert!((slope - own).abs() < 1e-2, "{row} {component} {end} {freedom}: {slope} {own}");
            }
        }
    }
}
