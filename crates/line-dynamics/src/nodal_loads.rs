//! What acts on nodes beside the elements: the bottom, supports, attachments, given forces.

use super::contact::contact;
use super::environment::LineEnvironment;
use super::mesh::Rod;
use super::morison::wet_prism;
use super::supports::{find_support_contact, support_load};
use super::system::{RodSystem, Weights};
use super::trial::Trial;
use nalgebra::Vector3;
use std::ops::Range;

/// Adds the bottom, supports, attachments and given forces at the nodes of a range of elements; without `TANGENT` their
/// residual alone.
pub(super) fn add_nodal_loads<const TANGENT: bool, const W: usize, const H: usize, const S: usize>(
    rod: &Rod,
    world: &LineEnvironment,
    trial: &Trial,
    Weights { k, c, m }: Weights,
    range: Range<usize>,
    system: &mut RodSystem<W, H, S>,
) {
    if let Some((bottom, ground)) = &world.bottom {
        // at rest its friction is another: see `statics_friction`
        let ground = if trial.is_static { &ground.smooth() } else { ground };
        let level = bottom.level();
        for node in range.start..=range.end {
            let (x, v) = (&trial.x[node], &trial.v[node]);
            if level.is_some_and(|height| x.z >= height) {
                continue;
            }
            if let Some(made) = contact(
                *bottom,
                ground,
                trial.seabed_penetration_scale[node],
                rod.contact_area(node),
                x,
                v,
                &trial.friction_direction[node],
                &trial.stuck_at[node],
                trial.exact_friction_tangent,
            ) {
                system.push(node, &-(made.force[0] + made.force[1]));
                system.block::<TANGENT>(node, node, &(made.by_position * -k - made.by_velocity * c));
            }
        }
    }
    for support in world.supports {
        // two nodes an equation have no room for a curve
        let Some(over) = find_support_contact(H > 5, support, &trial.x) else { continue };
        let nodes = over.nodes();
        if nodes.start < range.start || nodes.end > range.end + 1 {
            continue;
        }
        if let Some(made) = support_load(support, &over, &trial.v) {
            for (row, node) in nodes.clone().enumerate() {
                system.push(node, &(made.force * over.shares[row]));
                for (column, other) in nodes.clone().enumerate() {
                    let block = made.by_position[row][column] * k + made.by_velocity[row][column] * c;
                    system.block::<TANGENT>(node, other, &block);
                }
            }
        }
    }
    for held in rod.attachments.iter().filter(|a| (range.start..=range.end).contains(&a.node)) {
        let node = held.node;
        let fluid = &trial.fluid[node];
        let depth = fluid.surface - trial.x[node].z - held.pendant;
        let (share, by_depth) = wet_prism(depth, held.height);
        let (u, q) = (trial.v[node] - fluid.velocity, trial.a[node] - fluid.acceleration);
        let speed = u.norm();
        let (drag, water) = (0.5 * fluid.density * held.drag, fluid.density * held.volume);
        let mut wet = u * (drag * speed) + q * (water * held.added) - fluid.acceleration * water;
        wet.z -= water * world.gravity;
        let mut force = trial.a[node] * held.mass + wet * share;
        force.z += held.mass * world.gravity;
        let unit = if speed > 0.0 { u / speed } else { Vector3::zeros() };
        let mut block = unit * unit.transpose() * (c * share * drag * speed);
        for j in 0..3 {
            block[(j, j)] += c * share * drag * speed + m * (held.mass + share * water * held.added);
        }
        let mut third = block.column_mut(2);
        third -= wet * (k * by_depth);
        system.push(node, &force);
        system.block::<TANGENT>(node, node, &block);
    }
    for (node, force) in world.forces.iter().filter(|f| (range.start..=range.end).contains(&f.0)) {
        system.push(*node, &-force);
    }
}
