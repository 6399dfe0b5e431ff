//! Natural periods and shapes of a rod about where it rests.

use super::ends::RodEnd;
use super::environment::LineEnvironment;
use super::error::RodError;
use super::mesh::Rod;
use super::state::RodState;
use super::system::Weights;
use super::trial::{StaticFriction, Trial, sample_fluid, set_friction_directions, set_seabed_penetration_scales};
use super::viscoelastic::update_memory;
use super::workspace::Workspace;
use nalgebra::{DMatrix, Vector3};
use windlass_base::dense::{Cholesky, DenseError, SymmetricEigen};

/// Rounds of iteration after which modes are given up.
const MAX_ITERATIONS: usize = 500;
/// Change of the square of a frequency from one round to the next, as a share, at which it is taken.
const FREQUENCY_TOLERANCE: f64 = 1e-11;
/// The same at which it is taken when the changes no longer shrink: a stiff line's slow modes are known to rounding only.
const ROUNDING_CHANGE: f64 = 1e-7;
/// Rounds in which a change that shrinks would have halved.
const MAX_STALLED_ITERATIONS: usize = 8;

/// One natural mode without damping.
#[derive(Clone, Debug, PartialEq)]
pub struct RodMode {
    /// Circular frequency (rad/s).
    pub frequency: f64,
    /// Displacement of each node; the largest component is 1.
    pub shape: Vec<Vector3<f64>>,
}

/// [`super::RodSolver::modes`] in coordinates from the origin of the state.
pub(super) fn find_modes(
    trial: &mut Trial,
    work: &mut Workspace,
    rod: &Rod,
    state: &RodState,
    world: &LineEnvironment,
    ends: [RodEnd; 2],
    count: usize,
) -> Result<Vec<RodMode>, RodError> {
    let refuse = |why: String| RodError::Shape { rod: rod.name.clone(), why };
    let last = rod.elements.len();
    let stride = work.stride();
    let size = stride * rod.nodes();
    let space = (count + 8).max(2 * count).min(size.saturating_sub(6));
    if count == 0 || count * 2 > size.saturating_sub(6) {
        return Err(refuse(format!("{count} modes of {size} unknowns cannot be found")));
    }
    trial.time = state.time;
    trial.ends = ends;
    trial.x.copy_from_slice(&state.position);
    trial.director.copy_from_slice(&state.director);
    trial.v.fill(Vector3::zeros());
    trial.a.fill(Vector3::zeros());
    trial.friction = StaticFriction::None;
    trial.stuck_at.copy_from_slice(&state.stuck);
    set_friction_directions(rod, state, world, &mut trial.friction_direction);
    set_seabed_penetration_scales(state, world, &mut trial.seabed_penetration_scale);
    update_memory(rod, state, 0.0, &mut trial.memory);
    sample_fluid(world, state.time, trial);
    let known = [ends[0].motion.is_some(), ends[1].motion.is_some()];
    let free = |node: usize| !((node == 0 && known[0]) || (node == last && known[1]));
    let mut matrix = |weights: Weights| {
        work.assemble(rod, world, trial, weights, 0..last);
        work.clone()
    };
    let stiffness = matrix(Weights { k: 1.0, c: 0.0, m: 0.0 });
    let mass = matrix(Weights { k: 0.0, c: 0.0, m: 1.0 });
    // a shift as slow as the rod is long keeps a free rod's stiffness from being singular
    let shift = 0.01 * world.gravity.abs().max(1e-3) / rod.length();
    let mut shifted = matrix(Weights { k: 1.0, c: 0.0, m: shift });
    for node in [0, last].into_iter().filter(|n| !free(*n)) {
        shifted.fix(node);
    }
    shifted.factor().map_err(|node| refuse(format!("its stiffness vanishes at element {}", node.clamp(1, last))))?;
    let times = |matrix: &Workspace, vector: &[f64]| {
        let mut made = vec![0.0; size];
        matrix.times(vector, &mut made);
        for node in [0, last].into_iter().filter(|n| !free(*n)) {
            made[stride * node..stride * node + 3].fill(0.0);
        }
        made
    };
    // starting vectors: sines along the rod in each direction, whose order is that of a line's modes
    let mut vectors: Vec<Vec<f64>> = (0..space)
        .map(|j| {
            let half_waves = (j / 3 + 1) as f64;
            let position = |i: usize| (i as f64 + 0.37) / (last as f64 + 0.74) * std::f64::consts::PI * half_waves;
            let at = |i: usize| {
                let (node, axis) = (i / stride, i % stride);
                if axis == j % 3 && free(node) { position(node).sin() + 0.1 * position(node).cos() } else { 0.0 }
            };
            (0..size).map(at).collect()
        })
        .collect();
    let mut found = vec![0.0; space];
    let (mut least, mut stale) = (f64::INFINITY, 0);
    for _ in 0..MAX_ITERATIONS {
        if world.fluid.is_interrupted() {
            return Err(RodError::Interrupted { rod: rod.name.clone() });
        }
        for vector in &mut vectors {
            *vector = times(&mass, vector);
            shifted.solve(vector);
        }
        let loaded: Vec<Vec<f64>> = vectors.iter().map(|v| times(&mass, v)).collect();
        let held: Vec<Vec<f64>> = vectors.iter().map(|v| times(&stiffness, v)).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(p, q)| p * q).sum::<f64>();
        let small = |of: &[Vec<f64>]| {
            DMatrix::from_fn(space, space, |i, j| 0.5 * (dot(&vectors[i], &of[j]) + dot(&vectors[j], &of[i])))
        };
        let (k, m) = (small(&held), small(&loaded));
        let stop = || world.fluid.is_interrupted();
        let wrong = |e| match e {
            DenseError::Interrupted => RodError::Interrupted { rod: rod.name.clone() },
            _ => refuse("its modes cannot be distinguished".to_string()),
        };
        let inverse = Cholesky::new(m, &stop).and_then(|factor| factor.inverse_of_lower()).map_err(wrong)?;
        let eigen = SymmetricEigen::new(&inverse * k * inverse.transpose(), &stop).map_err(wrong)?;
        let mut order: Vec<usize> = (0..space).collect();
        order.sort_by(|a, b| eigen.values[*a].total_cmp(&eigen.values[*b]));
        let turn = inverse.transpose() * &eigen.vectors;
        vectors = order
            .iter()
            .map(|j| {
                let mut made = vec![0.0; size];
                for (i, vector) in vectors.iter().enumerate() {
                    for (m, v) in made.iter_mut().zip(vector) {
                        *m += turn[(i, *j)] * v;
                    }
                }
                made
            })
            .collect();
        let values: Vec<f64> = order.iter().map(|j| eigen.values[*j]).collect();
        let change = |(a, b): (&f64, &f64)| (a - b).abs() / (a.abs() + shift);
        let larger = |most: f64, c: f64| if c.is_nan() { f64::INFINITY } else { most.max(c) };
        let worst = values[..count].iter().zip(&found).map(change).fold(0.0, larger);
        if worst < 0.5 * least {
            (least, stale) = (worst, 0);
        } else {
            stale += 1;
        }
        let settled = worst <= FREQUENCY_TOLERANCE || (worst <= ROUNDING_CHANGE && stale >= MAX_STALLED_ITERATIONS);
        found = values;
        if settled {
            if let Some(value) = found[..count].iter().find(|v| **v < -1e-6 * shift) {
                return Err(refuse(format!("it does not rest there: a mode grows at {:.3e} 1/s", (-value).sqrt())));
            }
            let modes = found[..count].iter().zip(&vectors).map(|(value, vector)| {
                let most = vector.iter().fold(0.0, |m: f64, v| if v.abs() > m.abs() { *v } else { m });
                let shape = vector.chunks(stride).map(|d| Vector3::new(d[0], d[1], d[2]) / most).collect();
                RodMode { frequency: value.max(0.0).sqrt(), shape }
            });
            return Ok(modes.collect());
        }
    }
    Err(refuse(format!("its modes do not settle in {MAX_ITERATIONS} rounds")))
}
