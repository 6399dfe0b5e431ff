//! A rod on what holds it between its ends.

use super::environment::{LineEnvironment, Support, SupportReaction, SupportTarget};
use super::mesh::Rod;
use super::newton_iteration::NewtonSystem;
use super::trial::Trial;
use nalgebra::{Matrix3, Matrix6, SMatrix, Vector3};

/// What a rod does to one of its supports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SupportForce {
    /// Force on the support (N, global).
    pub force: Vector3<f64>,
    /// Moment on it about its place (N m).
    pub moment: Vector3<f64>,
    /// Unstretched distance from end A of the point it holds (m); none of a roller that the rod does not cross.
    pub arc: Option<f64>,
}

/// How forces and moments on supports follow their motion, the rod in balance: blocks row by row, the motion of support
/// `j` in the wrench on support `i` at `i * supports + j`, translation and turn about its place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SupportTangent {
    /// By place and turn (N/m, N, N m).
    pub position: Vec<Matrix6<f64>>,
    /// By their rates; empty where no support feels any.
    pub velocity: Vec<Matrix6<f64>>,
}

/// Most nodes a support acts on.
const SUPPORT_NODES: usize = 3;

/// Where a support holds a rod.
#[derive(Clone, Copy, Debug)]
pub(super) struct SupportPoint {
    /// The first node it acts on, and how many.
    pub(super) node: usize,
    count: usize,
    /// The nodes' shares of the point.
    pub shares: [f64; SUPPORT_NODES],
    /// The point from the place of the support (m).
    pub(super) at: Vector3<f64>,
    /// Of a roller.
    rolls: Option<RollerCrossing>,
}

/// How a rod goes through the plane of a roller.
#[derive(Clone, Copy, Debug)]
struct RollerCrossing {
    along: Vector3<f64>,
    /// How the shares change along the curve.
    slopes: [f64; SUPPORT_NODES],
    /// The curve's own direction and its change, and how far the direction goes along the rollers' way (m).
    edge: Vector3<f64>,
    bend: Vector3<f64>,
    reach: f64,
}

/// Load of a support on the nodes it acts on, as one to be overcome, with its derivatives.
pub(super) struct SupportLoad {
    /// Force the rod needs from outside at the point (N), shared over the nodes by the shares of their meeting.
    pub force: Vector3<f64>,
    /// Derivatives of the nodes' shares of it by their positions (N/m) and velocities (N s/m): node by node.
    pub by_position: [[Matrix3<f64>; SUPPORT_NODES]; SUPPORT_NODES],
    pub by_velocity: [[Matrix3<f64>; SUPPORT_NODES]; SUPPORT_NODES],
    /// Energy of the springs (J), and the part of the force that they make (N).
    pub energy: f64,
    pub elastic: Vector3<f64>,
}

/// The curve of a rod between two points of it, as rollers meet it: a parabola by the shares of three nodes, or straight.
struct SupportPiece {
    node: usize,
    count: usize,
    /// Share of each node at the start, and its first and second change over the piece, which is 1 long.
    shares: [[f64; 3]; SUPPORT_NODES],
}

/// Pieces of a rod in a row. One that bends rolls as the smooth curve that touches each element in its middle, so that
/// a roller pushes it at right angles to where it bends, and not to the one or the other element beside a node.
fn pieces(smooth: bool, nodes: usize) -> impl Iterator<Item = SupportPiece> {
    let elements = nodes.saturating_sub(1);
    let straight = |node: usize, from: f64, to: f64| SupportPiece {
        node,
        count: 2,
        shares: [[1.0 - from, from - to, 0.0], [from, to - from, 0.0], [0.0; 3]],
    };
    let round =
        |node: usize| SupportPiece { node, count: 3, shares: [[0.5, -1.0, 1.0], [0.5, 1.0, -2.0], [0.0, 0.0, 1.0]] };
    let chords = (0..if smooth { 0 } else { elements }).map(move |i| straight(i, 0.0, 1.0));
    let first = (smooth && elements > 0).then(|| straight(0, 0.0, 0.5));
    let last = (smooth && elements > 0).then(|| straight(elements - 1, 0.5, 1.0));
    let bends = (0..if smooth { elements.saturating_sub(1) } else { 0 }).map(round);
    chords.chain(first).chain(bends).chain(last)
}

impl SupportPiece {
    /// A sum of the nodes' vectors by their shares, or a change of those.
    fn sum(weights: impl Iterator<Item = f64>, x: &[Vector3<f64>]) -> Vector3<f64> {
        weights.zip(x).fold(Vector3::zeros(), |sum, (w, x)| sum + x * w)
    }

    /// Where it crosses the plane of a roller.
    fn crossing(&self, support: &Support, along: Vector3<f64>, x: &[Vector3<f64>]) -> Option<SupportPoint> {
        let nodes = x.get(self.node..self.node + self.count)?;
        // height over the plane by c0 + c1 s + c2 s^2 / 2
        let plane = along.dot(&support.position);
        let mut c = [-plane, 0.0, 0.0];
        for (shares, x) in self.shares.iter().zip(nodes) {
            let own = x.dot(&along);
            c.iter_mut().zip(shares).for_each(|(c, share)| *c += own * share);
        }
        let [c0, c1, c2] = c;
        let end = c0 + c1 + 0.5 * c2;
        // a point in the plane belongs to one piece alone
        if (c0 < 0.0) == (end < 0.0) {
            return None;
        }
        // of the two roots that in the piece, between whose ends the sign changes once
        let root = (c1 * c1 - 2.0 * c2 * c0).max(0.0).sqrt();
        let rise = if end > c0 { root } else { -root };
        let s = if c1 + rise != 0.0 && (c1 < 0.0) == (rise < 0.0) { -2.0 * c0 / (c1 + rise) } else { (rise - c1) / c2 };
        let s = s.clamp(0.0, 1.0);
        let shares = self.shares.map(|[a, b, c]| a + b * s + 0.5 * c * s * s);
        let slopes = self.shares.map(|[_, b, c]| b + c * s);
        let edge = SupportPiece::sum(slopes.into_iter(), nodes);
        let bend = SupportPiece::sum(self.shares.iter().map(|share| share[2]), nodes);
        let reach = edge.dot(&along);
        let at = SupportPiece::sum(shares.into_iter(), nodes) - support.position;
        let rolls = Some(RollerCrossing { along, slopes, edge, bend, reach });
        (reach != 0.0).then_some(SupportPoint { node: self.node, count: self.count, shares, at, rolls })
    }
}

impl SupportPoint {
    /// The nodes it acts on.
    pub fn nodes(&self) -> std::ops::Range<usize> {
        self.node..self.node + self.count
    }

    /// A vector of its nodes at the point.
    pub fn value_at_contact(&self, of: &[Vector3<f64>]) -> Vector3<f64> {
        SupportPiece::sum(self.shares.into_iter(), &of[self.nodes()])
    }
}

/// Where a support holds a rod: of a roller, where that crosses its plane nearest to its place. A rod is `smooth` where
/// it bends: see [`Rod::smooth`].
pub(super) fn find_support_contact(smooth: bool, support: &Support, x: &[Vector3<f64>]) -> Option<SupportPoint> {
    let along = match support.target {
        SupportTarget::Node(node) => {
            let at = x.get(node)? - support.position;
            return Some(SupportPoint { node, count: 1, shares: [1.0, 0.0, 0.0], at, rolls: None });
        }
        SupportTarget::Crossing(along) => along,
    };
    let crossings = pieces(smooth, x.len()).filter_map(|piece| piece.crossing(support, along, x));
    crossings.min_by(|a, b| a.at.norm_squared().total_cmp(&b.at.norm_squared()))
}

/// What a support does where it holds a rod that moves at the velocities `v` of all its nodes; none when it is
/// clear.
///
/// A roller is asked at the point where the rod crosses its plane, so that its force is at right angles to the rod, as
/// that of something that rolls, and the rod slides from one element to the next without a jump.
pub(super) fn support_load(support: &Support, meeting: &SupportPoint, v: &[Vector3<f64>]) -> Option<SupportLoad> {
    let velocity = meeting.value_at_contact(v) - support.velocity;
    let none = [[Matrix3::zeros(); SUPPORT_NODES]; SUPPORT_NODES];
    let Some(RollerCrossing { along, slopes, edge, bend, reach }) = meeting.rolls else {
        let SupportReaction { force, by_position, by_velocity, elastic } =
            support.law.reaction(&meeting.at, &velocity)?;
        let mut made =
            SupportLoad { force: -force, by_position: none, by_velocity: none, energy: elastic.1, elastic: -elastic.0 };
        (made.by_position[0][0], made.by_velocity[0][0]) = (by_position, by_velocity);
        return Some(made);
    };
    // how the crossing moves with the material there, as the rod slides along itself through the plane
    let slide = Matrix3::identity() - edge * along.transpose() / reach;
    let made = support.law.reaction(&meeting.at, &(slide * velocity))?;
    let across = |force: Vector3<f64>| force - along * (edge.dot(&force) / reach);
    let force = across(-made.force);
    let turned = slide.transpose();
    let (stiff, damp) = (turned * made.by_position * slide, turned * made.by_velocity * slide);
    // by the material at the crossing, which slides along the curve; and by the direction of the curve there
    let dv = SupportPiece::sum(slopes.into_iter(), &v[meeting.nodes()]);
    let by_edge = -(along * force.transpose()) / reach - damp * (along.dot(&velocity) / reach);
    let by_material = stiff - (damp * dv + by_edge * bend) * along.transpose() / reach;
    // the shares of the nodes change as it slides
    let pull = force * along.transpose() / reach;
    let (mut by_position, mut by_velocity) = (none, none);
    for row in 0..meeting.count {
        for column in 0..meeting.count {
            let (share, own) = (meeting.shares[row], meeting.shares[column]);
            by_position[row][column] =
                (by_material * own + by_edge * slopes[column]) * share - pull * (slopes[row] * own);
            by_velocity[row][column] = damp * (share * own);
        }
    }
    Some(SupportLoad { force, by_position, by_velocity, energy: made.elastic.1, elastic: across(-made.elastic.0) })
}

/// A support in contact with the rod at the solver's trial.
struct SupportState {
    meeting: SupportPoint,
    load: SupportLoad,
    /// How its nodes move with it, as seen from the support: by its translation and turn.
    carried: [SMatrix<f64, 3, 6>; SUPPORT_NODES],
}

impl SupportState {
    fn evaluate(smooth: bool, support: &Support, x: &[Vector3<f64>], v: &[Vector3<f64>]) -> Option<SupportState> {
        let meeting = find_support_contact(smooth, support, x)?;
        let load = support_load(support, &meeting, v)?;
        let mut carried = [SMatrix::<f64, 3, 6>::zeros(); SUPPORT_NODES];
        for (made, x) in carried.iter_mut().zip(&x[meeting.nodes()]) {
            made.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
            made.fixed_view_mut::<3, 3>(0, 3).copy_from(&-(x - support.position).cross_matrix());
        }
        Some(SupportState { meeting, load, carried })
    }

    /// Load of one of its nodes.
    fn node_load(&self, row: usize) -> Vector3<f64> {
        self.load.force * self.meeting.shares[row]
    }

    /// Change of the load of one of its nodes with the motion of the support, the rod as it is: what counts is where the
    /// rod is as seen from the support, and with that the load turns.
    fn by_support(&self, row: usize, rates: bool) -> SMatrix<f64, 3, 6> {
        let blocks = if rates { &self.load.by_velocity } else { &self.load.by_position };
        let mut made = SMatrix::zeros();
        for (block, carried) in blocks[row].iter().zip(&self.carried) {
            made -= block * carried;
        }
        if !rates {
            let mut turn = made.fixed_view_mut::<3, 3>(0, 3);
            turn -= self.node_load(row).cross_matrix();
        }
        made
    }

    /// Change of the wrench on the support with a move of its nodes, by the weights of position and velocity.
    fn by_rod(&self, moved: impl Fn(usize) -> Vector3<f64>, [k, c]: [f64; 2]) -> SMatrix<f64, 6, 1> {
        let mut made = SMatrix::<f64, 6, 1>::zeros();
        for row in 0..self.meeting.count {
            let mut change = Vector3::zeros();
            for (column, node) in self.meeting.nodes().enumerate() {
                change +=
                    (self.load.by_position[row][column] * k + self.load.by_velocity[row][column] * c) * moved(node);
            }
            made += self.carried[row].transpose() * change;
            let mut moment = made.fixed_rows_mut::<3>(3);
            moment += moved(self.meeting.node + row).cross(&self.node_load(row));
        }
        made
    }

    /// Change of the wrench on the support with its own motion, the rod as it is.
    fn stiffness_by_own_motion(&self, rates: bool) -> Matrix6<f64> {
        let mut made = Matrix6::zeros();
        for row in 0..self.meeting.count {
            made += self.carried[row].transpose() * self.by_support(row, rates);
            if !rates {
                // the arm is shorter by what the place has moved
                let mut arm = made.fixed_view_mut::<3, 3>(3, 0);
                arm += self.node_load(row).cross_matrix();
            }
        }
        made
    }
}

/// [`super::RodSolver::support_tangent`] in coordinates from the origin of the trial, by the factors of the system.
pub(super) fn condense_to_supports(
    rod: &Rod,
    world: &LineEnvironment,
    trial: &Trial,
    system: &NewtonSystem,
) -> SupportTangent {
    let count = world.supports.len();
    let (x, v) = (&trial.x, &trial.v);
    let smooth = rod.is_smooth();
    let held: Vec<_> = world.supports.iter().map(|support| SupportState::evaluate(smooth, support, x, v)).collect();
    let feels = |h: &SupportState| h.load.by_velocity.iter().flatten().any(|block| *block != Matrix3::zeros());
    let rated = held.iter().flatten().any(feels);
    let mut made = SupportTangent::default();
    made.position.resize(count * count, Matrix6::zeros());
    if rated {
        made.velocity.resize(count * count, Matrix6::zeros());
    }
    let (stride, last) = (system.work.stride(), rod.elements.len());
    let known = trial.ends.map(|end| end.motion.is_some());
    let given = |node: usize| (node == 0 && known[0]) || (node == last && known[1]);
    let weights = [system.weights.k, system.weights.c];
    let mut right = vec![0.0; system.change.len()];
    for (blocks, rates) in [(&mut made.position, false), (&mut made.velocity, true)] {
        if rates && !rated {
            continue;
        }
        for (j, from) in held.iter().enumerate() {
            let Some(from) = from else { continue };
            blocks[count * j + j] += from.stiffness_by_own_motion(rates);
            for dof in 0..6 {
                right.fill(0.0);
                for (row, node) in from.meeting.nodes().enumerate().filter(|(_, node)| !given(*node)) {
                    let load = from.by_support(row, rates);
                    for axis in 0..3 {
                        right[stride * node + axis] -= load[(axis, dof)];
                    }
                }
                system.work.solve(&mut right);
                let moved = |node: usize| Vector3::from_row_slice(&right[stride * node..stride * node + 3]);
                for (i, on) in held.iter().enumerate() {
                    let Some(on) = on else { continue };
                    let change = on.by_rod(moved, weights);
                    let mut column = blocks[count * i + j].column_mut(dof);
                    column += change;
                }
            }
        }
    }
    made
}
