//! Natural modes of a line.

use super::mesh::to_class_error;
use nalgebra::{Matrix2, Vector2, Vector3};
use windlass_base::dense::{DenseError, SymmetricEigen, never};
use windlass_line_dynamics::{LineEnvironment, Rod, RodEnd, RodError, RodMode, RodSolver, RodState};
use windlass_model::{ClassError, LineMode};

/// Most modes that are found: the cost grows with the square of their number, and no one reads as many.
const MAX_MODES: usize = 200;
/// Most memory that finding modes may take (bytes).
const MAX_MEMORY_BYTES: f64 = 1e9;
/// Two modes swing alike if their frequencies differ by no more than this share.
const EQUAL_FREQUENCIES_SHARE: f64 = 1e-6;

/// Refuses more modes of a line of so many nodes than are worth their memory.
///
/// # Errors
/// Their number, or what memory they would take.
pub(super) fn check_mode_count(nodes: usize, number: usize) -> Result<(), ClassError> {
    if number > MAX_MODES {
        return Err(ClassError::new(format!("{number} modes of a line are not found: at most {MAX_MODES}")));
    }
    // vectors of all nodes, with their loads and what they are made of; twice as many as are asked, and the last distinguished
    let bytes = 8.0 * 3.0 * nodes as f64 * 4.0 * (2.0 * (number as f64 + 1.0) + 8.0);
    if bytes > MAX_MEMORY_BYTES {
        let text = format!(
            "{number} modes of {} elements would take about {:.1} GB of memory: more than {:.0} GB",
            nodes.saturating_sub(1),
            bytes / 1e9,
            MAX_MEMORY_BYTES / 1e9
        );
        return Err(ClassError::new(text).help("fewer modes, or fewer elements by -REFINE"));
    }
    Ok(())
}

/// The slowest modes about a state of rest, with added mass and the bottom's stiffness, slowest first.
///
/// A round line that hangs straight down swings alike in all directions, and any mix of two such modes is a mode: the
/// one in the vertical plane of its ends is reported first, then the one across it.
pub(super) fn find_line_modes(
    rod: &Rod,
    solver: &mut RodSolver,
    state: &RodState,
    environment: &LineEnvironment,
    ends: [RodEnd; 2],
    number: usize,
) -> Result<Vec<LineMode>, ClassError> {
    // one more than asked, so that the last is distinguished from its like
    let mut found = match solver.modes(rod, state, environment, ends, number + 1) {
        Ok(found) => found,
        Err(stop @ RodError::Interrupted { .. }) => return Err(to_class_error(stop)),
        Err(_) => solver.modes(rod, state, environment, ends, number).map_err(to_class_error)?,
    };
    let (first, last) = (state.position.first(), state.position.last());
    let chord = first.zip(last).map_or_else(Vector3::x, |(a, b)| b - a);
    let level = Vector3::new(chord.x, chord.y, 0.0);
    // ends above each other within a thousandth stand in no plane of their own
    let along = if level.norm() > 1e-3 * chord.norm() { level.normalize() } else { Vector3::x() };
    let across = Vector3::z().cross(&along);
    let mut index = 0;
    while let Some([a, b]) = found.get_mut(index..index + 2).and_then(|pair| <&mut [RodMode; 2]>::try_from(pair).ok()) {
        let alike = (b.frequency - a.frequency).abs() <= EQUAL_FREQUENCIES_SHARE * b.frequency;
        if alike {
            set_apart(a, b, &across);
        }
        index += if alike { 2 } else { 1 };
    }
    found.truncate(number);
    let to_line_mode = |mode: RodMode| {
        // of two signs the one in which the largest component is positive
        let most = mode.shape.iter().map(|d| d.norm()).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        let peak = mode
            .shape
            .iter()
            .flat_map(|d| d.iter())
            .fold(0.0, |m: f64, c| if c.abs() > m.abs() * (1.0 + 1e-6) { *c } else { m });
        let scale = if peak < 0.0 { -most } else { most };
        LineMode { frequency: mode.frequency, shape: mode.shape.iter().map(|d| d / scale).collect() }
    };
    Ok(found.into_iter().map(to_line_mode).collect())
}

/// Makes of two modes of one frequency one with the least motion in a direction, and one with the least beside it.
fn set_apart(a: &mut RodMode, b: &mut RodMode, across: &Vector3<f64>) {
    let least = |part: &dyn Fn(&Vector3<f64>, &Vector3<f64>) -> f64| -> Result<Vector2<f64>, DenseError> {
        let mut sums = Matrix2::zeros();
        for (p, q) in a.shape.iter().zip(&b.shape) {
            let mixed = part(p, q);
            sums += Matrix2::new(part(p, p), mixed, mixed, part(q, q));
        }
        let eigen = SymmetricEigen::new(sums, &never)?;
        let which = if eigen.values[0] <= eigen.values[1] { 0 } else { 1 };
        Ok(eigen.vectors.column(which).into_owned())
    };
    let within = least(&|p, q| p.dot(across) * q.dot(across));
    let beside = least(&|p, q| p.dot(q) - p.dot(across) * q.dot(across));
    let (Ok(within), Ok(beside)) = (within, beside) else { return };
    // neither direction distinguishes the two modes, as of two along the line
    if (within[0] * beside[1] - within[1] * beside[0]).abs() < 1e-3 {
        return;
    }
    for (p, q) in a.shape.iter_mut().zip(b.shape.iter_mut()) {
        (*p, *q) = (*p * within[0] + *q * within[1], *p * beside[0] + *q * beside[1]);
    }
}
