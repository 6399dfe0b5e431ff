//! A rod on rollers.

use super::mesh::Rod;
use super::state::State;
use super::surroundings::{Roller, World};
use nalgebra::{Matrix3, Vector3};

/// What a cradle of rollers does to a rod.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RollerResult {
    /// Force on the rod (N, global).
    pub force: Vector3<f64>,
    /// Least distance of the rod's axis from where it would touch (m): positive when it is clear, negative the depth
    /// to which it presses in. None where the rod does not cross the cradle.
    pub gap: Option<f64>,
    /// Unstretched distance from end A of the point over the cradle (m).
    pub arc: Option<f64>,
}

/// Where a rod crosses the plane of a cradle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    /// The element.
    pub element: usize,
    /// Share of it before the plane.
    share: f64,
    /// Its edge (m), and how far that goes along the rollers' way (m).
    edge: Vector3<f64>,
    reach: f64,
    /// The crossing from the place of the cradle (m).
    at: Vector3<f64>,
}

/// Load of a cradle on the two nodes of an element, as one to be overcome, with its derivatives.
pub(super) struct Cradled {
    /// Force the rod needs from outside at the crossing (N), shared over the nodes by `shares`.
    pub force: Vector3<f64>,
    pub shares: [f64; 2],
    /// Derivatives of the nodes' shares of it by their positions (N/m) and velocities (N s/m): node by node.
    pub by_position: [[Matrix3<f64>; 2]; 2],
    pub by_velocity: [[Matrix3<f64>; 2]; 2],
    /// Energy of the springs (J).
    pub energy: f64,
    /// The part of the force that the springs make (N).
    pub elastic: Vector3<f64>,
}

impl Roller {
    /// The faces that push: unit normal into the cradle, and how far from the place along it the face lies (m).
    fn faces(&self) -> impl Iterator<Item = (Vector3<f64>, f64)> {
        let [_, across, up] = self.axes;
        let (sine, cosine) = (0.5 * self.opening).sin_cos();
        let floor = (self.half_width > 0.0).then_some((up, 0.0));
        let walled = self.half_width.is_finite();
        let flank = move |side: f64| walled.then(|| (up * sine - across * (side * cosine), -self.half_width * cosine));
        [floor, flank(-1.0), flank(1.0)].into_iter().flatten()
    }
}

/// Where a rod crosses the plane of a cradle, nearest to its place.
pub(super) fn crossing(roller: &Roller, x: &[Vector3<f64>]) -> Option<Crossing> {
    let along = roller.axes[0];
    let mut nearest: Option<Crossing> = None;
    let mut before = f64::NAN;
    for (i, place) in x.iter().enumerate() {
        let s = (place - roller.place).dot(&along);
        // a node in the plane belongs to one element alone
        if (before < 0.0 && s >= 0.0) || (before >= 0.0 && s < 0.0) {
            let (edge, reach) = (place - x[i - 1], s - before);
            let share = -before / reach;
            let at = x[i - 1] + edge * share - roller.place;
            if nearest.is_none_or(|n| at.norm_squared() < n.at.norm_squared()) {
                nearest = Some(Crossing { element: i - 1, share, edge, reach, at });
            }
        }
        before = s;
    }
    nearest
}

/// What a cradle does to the element that crosses it, from the velocities of its two nodes; none when it is clear.
///
/// The depth is taken where the element crosses the plane of the cradle, so the force of the springs is the slope of
/// their energy: it is at right angles to the rod, as that of something that rolls, and the rod slides from one element
/// to the next without a jump.
pub(super) fn cradled(roller: &Roller, crossing: &Crossing, v: [&Vector3<f64>; 2]) -> Option<Cradled> {
    let Crossing { share, edge, reach, at, .. } = *crossing;
    let (along, shares) = (roller.axes[0], [1.0 - share, share]);
    // how the crossing moves with the material there, as the element slides along itself through the plane
    let slide = Matrix3::identity() - edge * along.transpose() / reach;
    let velocity = v[0] * shares[0] + v[1] * shares[1] - roller.velocity;
    let moves = slide * velocity;
    let (mut push, mut elastic) = (Vector3::zeros(), Vector3::zeros());
    let (mut stiff, mut damp) = (Matrix3::zeros(), Matrix3::zeros());
    let mut energy = 0.0;
    for (normal, offset) in roller.faces() {
        let depth = offset - at.dot(&normal);
        if depth <= 0.0 {
            continue;
        }
        let (spring, grown, bend, held) = if depth < roller.soft {
            (
                0.5 * depth * depth / roller.soft,
                depth / roller.soft,
                1.0 / roller.soft,
                depth.powi(3) / (6.0 * roller.soft),
            )
        } else {
            let soft = roller.soft;
            (depth - 0.5 * soft, 1.0, 0.0, 0.5 * depth * depth - 0.5 * soft * depth + soft * soft / 6.0)
        };
        energy += roller.stiffness * held;
        elastic -= normal * (roller.stiffness * spring);
        let sinking = -moves.dot(&normal);
        let support = roller.stiffness * spring + roller.damping * grown * sinking;
        if support <= 0.0 {
            continue;
        }
        let outer = normal * normal.transpose();
        push -= normal * support;
        stiff += outer * (roller.stiffness * grown + roller.damping * bend * sinking);
        damp += outer * (roller.damping * grown);
    }
    if energy == 0.0 {
        return None;
    }
    let across = |force: Vector3<f64>| force - along * (edge.dot(&force) / reach);
    let force = across(push);
    let turned = slide.transpose();
    let (stiff, damp) = (turned * stiff * slide, turned * damp * slide);
    // by the material at the crossing, whose share of the nodes changes as it slides; and by the edge
    let dv = v[1] - v[0];
    let pull = force * along.transpose() / reach;
    let by_material = stiff - damp * dv * along.transpose() / reach;
    let by_edge = -(along * force.transpose()) / reach - damp * (along.dot(&velocity) / reach);
    let node = |row: usize, column: usize| {
        let (own, sign) = (shares[column], if column == 0 { -1.0 } else { 1.0 });
        // the first node's share grows as the material moves on, the second's falls
        let shifted = pull * if row == 0 { own } else { -own };
        shifted + (by_material * own + by_edge * sign) * shares[row]
    };
    Some(Cradled {
        force,
        shares,
        by_position: [0, 1].map(|row| [0, 1].map(|column| node(row, column))),
        by_velocity: [0, 1].map(|row| [0, 1].map(|column| damp * (shares[row] * shares[column]))),
        energy,
        elastic: across(elastic),
    })
}

impl Rod {
    /// What each cradle of a world does to the rod in a state.
    pub fn rollers(&self, state: &State, world: &World) -> Vec<RollerResult> {
        let look = |roller: &Roller| {
            let clear = RollerResult { force: Vector3::zeros(), gap: None, arc: None };
            let Some(found) = crossing(roller, &state.position) else { return clear };
            let (i, v) = (found.element, &state.velocity);
            let before: f64 = self.elements.iter().take(i).map(|e| e.rest).sum();
            let made = cradled(roller, &found, [&v[i], &v[i + 1]]);
            RollerResult {
                force: made.map_or_else(Vector3::zeros, |made| -made.force),
                gap: Some(roller.faces().map(|(n, offset)| found.at.dot(&n) - offset).fold(f64::INFINITY, f64::min)),
                arc: Some(before + found.share * self.elements[i].rest),
            }
        };
        world.rollers.iter().map(look).collect()
    }
}
