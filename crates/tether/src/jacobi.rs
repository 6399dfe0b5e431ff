//! The place of each natural mode in the matrices: `MODE FREEDOM POSN` of the listing [AQWA-TETHER 7.2].
//!
//! The listing gives the row of the diagonal on which the generalised Jacobi iteration of `K phi = w^2 M phi` leaves the eigenvalue of a mode. The
//! iteration is that of [BATHE-1996 11.3.2]: rows are swept in order and a pair is rotated unless its coupling factors, squared, are below a
//! threshold, here `0.01^sweep`. With it the places of all eighteen modes of the two listings come out. Frequencies and shapes are found otherwise
//! ([`super::modes`]): a rotation loses the digits of modes that soft springs hold.

use super::beam::PlaneMatrix;

/// Sweeps at most; the two listings' matrices need eleven.
const MAX_SWEEPS: i32 = 30;
/// What the threshold of the squared coupling factors is multiplied by from one sweep to the next.
const THRESHOLD_RATIO: f64 = 0.01;
/// Unknowns at most: the work grows with their cube, some seconds beyond this.
const MAX_UNKNOWNS: usize = 200;

/// The unknowns on whose diagonals the eigenvalues come to lie, lowest eigenvalue first; unknowns without mass have none. Empty for a plane of more
/// than 200 unknowns.
pub fn eigenvalue_places(stiffness: &PlaneMatrix, mass: &PlaneMatrix) -> Vec<usize> {
    let order = mass.order();
    if order > MAX_UNKNOWNS {
        return Vec::new();
    }
    let free: Vec<usize> = (0..order).filter(|i| mass.get(*i, *i) > 0.0).collect();
    let dense = |of: &PlaneMatrix| -> Vec<Vec<f64>> {
        free.iter().map(|i| free.iter().map(|j| of.get(*i, *j)).collect()).collect()
    };
    let mut pencil = [dense(stiffness), dense(mass)];
    for sweep in 1..=MAX_SWEEPS {
        let threshold = THRESHOLD_RATIO.powi(sweep);
        let mut rotated = false;
        for j in 0..free.len() {
            for k in j + 1..free.len() {
                rotated |= rotate(&mut pencil, j, k, threshold);
            }
        }
        if !rotated && sweep > 2 {
            break;
        }
    }
    let [k, m] = &pencil;
    let value = |i: &usize| k[*i][*i] / m[*i][*i];
    let mut list: Vec<usize> = (0..free.len()).collect();
    list.sort_by(|a, b| value(a).total_cmp(&value(b)));
    list.into_iter().map(|i| free[i]).collect()
}

/// Makes the entries of a pair zero in both matrices, unless their coupling factors are below the threshold; whether it did.
fn rotate(pencil: &mut [Vec<Vec<f64>>; 2], j: usize, k: usize, threshold: f64) -> bool {
    let coupling = |of: &[Vec<f64>]| (of[j][k] / of[j][j]) * (of[j][k] / of[k][k]);
    let [stiffness, mass] = &*pencil;
    if coupling(stiffness).abs() < threshold && coupling(mass).abs() < threshold {
        return false;
    }
    let at_k = stiffness[k][k] * mass[j][k] - mass[k][k] * stiffness[j][k];
    let at_j = stiffness[j][j] * mass[j][k] - mass[j][j] * stiffness[j][k];
    let across = stiffness[j][j] * mass[k][k] - stiffness[k][k] * mass[j][j];
    let root = (0.25 * across * across + at_k * at_j).max(0.0).sqrt();
    let [plus, minus] = [0.5 * across + root, 0.5 * across - root];
    let larger = if minus.abs() > plus.abs() { minus } else { plus };
    let (upper, lower) =
        if larger == 0.0 { (0.0, -stiffness[j][k] / stiffness[k][k]) } else { (at_k / larger, -at_j / larger) };
    for matrix in pencil {
        for i in (0..matrix.len()).filter(|i| *i != j && *i != k) {
            let (one, other) = (matrix[i][j], matrix[i][k]);
            let turned = [one + lower * other, other + upper * one];
            (matrix[i][j], matrix[j][i]) = (turned[0], turned[0]);
            (matrix[i][k], matrix[k][i]) = (turned[1], turned[1]);
        }
        let (jj, kk, jk) = (matrix[j][j], matrix[k][k], matrix[j][k]);
        matrix[k][k] = kk + 2.0 * upper * jk + upper * upper * jj;
        matrix[j][j] = jj + 2.0 * lower * jk + lower * lower * kk;
        (matrix[j][k], matrix[k][j]) = (0.0, 0.0);
    }
    true
}
