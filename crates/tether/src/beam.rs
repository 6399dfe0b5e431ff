//! One element of a tether in one plane: a beam with a cubic deflection. Unknowns are deflection and slope at its first end,
//! then at its second; lengths are of the element, `a` is the fraction of it from the first end.
//!
//! Source: [AQWA-TETHER 3.2 and 3.3], with its misprints mended [W-TOWED misprints]: the third row of T is
//! `La(1-a)^2`, the last two are `-La^2(1-a)` in the plane of the slope; the lower rows of K follow from its symmetry. The
//! geometric stiffness, which the listing has and the manual does not mention, is that of
//! [PRZEMIENIECKI-1968 eq. 15.25].

use windlass_base::band::{BandMatrix, UnusablePivot};
use windlass_model::ClassError;

/// A matrix of one element in one plane.
pub type Matrix4 = [[f64; 4]; 4];
/// Two ends' deflections and slopes, or forces and moments.
pub type Vector4 = [f64; 4];

/// Gauss points on 0..1 and their weights (sum 1): exact for polynomials up to the seventh power, as mass is.
pub const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Deflection at `a` of unit unknowns; also the loads at the ends of a unit force at `a` (the manual's T).
#[inline]
pub fn deflection(a: f64, length: f64) -> Vector4 {
    let (b, square) = (1.0 - a, a * a);
    let second = square * (3.0 - 2.0 * a);
    [1.0 - second, length * a * b * b, second, -length * square * b]
}

/// Slope at `a` of unit unknowns; also the loads at the ends of a unit moment at `a` (the manual's B).
#[inline]
pub fn slope(a: f64, length: f64) -> Vector4 {
    let first = 6.0 * a * (1.0 - a) / length;
    [-first, 1.0 - 4.0 * a + 3.0 * a * a, first, 3.0 * a * a - 2.0 * a]
}

/// Curvature at `a` of unit unknowns (1/m).
#[inline]
pub fn curvature(a: f64, length: f64) -> Vector4 {
    let first = (12.0 * a - 6.0) / (length * length);
    [first, (6.0 * a - 4.0) / length, -first, (6.0 * a - 2.0) / length]
}

/// Bending stiffness (N/m, N, N m) of a beam of stiffness EI (N m2) and a length (m), by deflection and slope of both ends.
pub fn stiffness(ei: f64, length: f64) -> Matrix4 {
    let l = length;
    scale_matrix(
        ei / (l * l * l),
        [
            [12.0, 6.0 * l, -12.0, 6.0 * l],
            [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l],
            [-12.0, -6.0 * l, 12.0, -6.0 * l],
            [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l],
        ],
    )
}

/// Stiffness (N/m, N, N m) of a tension (N; positive holds it straight) across the line (geometric stiffness), consistent with the cubic.
pub fn geometric(tension: f64, length: f64) -> Matrix4 {
    let l = length;
    scale_matrix(
        tension / (30.0 * l),
        [
            [36.0, 3.0 * l, -36.0, 3.0 * l],
            [3.0 * l, 4.0 * l * l, -3.0 * l, -l * l],
            [-36.0, -3.0 * l, 36.0, -3.0 * l],
            [3.0 * l, -l * l, -3.0 * l, 4.0 * l * l],
        ],
    )
}

/// Mass (kg, kg m, kg m2) of a uniform mass per length (kg/m), consistent with the cubic.
pub fn mass(per_length: f64, length: f64) -> Matrix4 {
    let l = length;
    scale_matrix(
        per_length * l / 420.0,
        [
            [156.0, 22.0 * l, 54.0, -13.0 * l],
            [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
            [54.0, 13.0 * l, 156.0, -22.0 * l],
            [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
        ],
    )
}

/// Loads at the ends (N, N m) of a uniform force per length (N/m).
pub fn uniform_load(per_length: f64, length: f64) -> Vector4 {
    let half = 0.5 * per_length * length;
    [half, half * length / 6.0, half, -half * length / 6.0]
}

/// Loads at the ends of a force per length given at the fraction `a`, over the whole element by Gauss quadrature.
pub fn load(length: f64, force: impl Fn(f64) -> f64) -> Vector4 {
    let mut sum = [0.0; 4];
    for (a, weight) in GAUSS {
        add(&mut sum, weight * length * force(a), &deflection(a, length));
    }
    sum
}

/// Adds a multiple of a vector to another.
#[inline]
pub fn add(sum: &mut Vector4, factor: f64, vector: &Vector4) {
    for (s, v) in sum.iter_mut().zip(vector) {
        *s += factor * v;
    }
}

/// The sum of products of two vectors.
#[inline]
pub fn dot(one: &Vector4, other: &Vector4) -> f64 {
    one[0] * other[0] + one[1] * other[1] + one[2] * other[2] + one[3] * other[3]
}

/// A matrix times a vector.
#[inline]
pub fn times(matrix: &Matrix4, vector: &Vector4) -> Vector4 {
    [dot(&matrix[0], vector), dot(&matrix[1], vector), dot(&matrix[2], vector), dot(&matrix[3], vector)]
}

/// The unknowns of element `index` (from 0) out of those of the whole plane.
#[inline]
pub fn of_element(all: &[f64], index: usize) -> Vector4 {
    let at = 2 * index;
    [all[at], all[at + 1], all[at + 2], all[at + 3]]
}

/// Adds the loads of element `index` to those of the whole plane.
#[inline]
pub fn gather(all: &mut [f64], index: usize, loads: &Vector4) {
    for (sum, load) in all[2 * index..2 * index + 4].iter_mut().zip(loads) {
        *sum += load;
    }
}

/// A symmetric matrix of one plane of a tether: a node is coupled to the next alone, so three entries on either side of the
/// diagonal are filled.
pub type PlaneMatrix = BandMatrix<3, 7>;

/// Adds the matrix of element `index` to that of the whole plane.
#[inline]
pub fn assemble(all: &mut PlaneMatrix, index: usize, matrix: &Matrix4) {
    for (i, row) in matrix.iter().enumerate() {
        all.add_to_row(2 * index + i, 2 * index, *row);
    }
}

/// Factors the matrix of a plane, of inertia and stiffness together, into `factors`.
///
/// # Errors
/// A pivot that is not above zero: a mass is missing, or a motion has neither stiffness nor mass.
pub fn factor(matrix: &PlaneMatrix, factors: &mut PlaneMatrix) -> Result<(), ClassError> {
    factors.clone_from(matrix);
    factors.factor_positive().map_err(|UnusablePivot { row }| {
        ClassError::new(format!(
            "the matrix of the tether is singular at node {}: neither mass nor stiffness holds it",
            row / 2 + 1
        ))
    })
}

/// Twice the energy (J) of an element: bending plus tension. Bending is reckoned of the slopes against the chord, so that a rigid motion,
/// however large, has none to the last digit; the matrix would leave its rounding.
pub fn twice_energy(ei: f64, tension: f64, length: f64, at: &Vector4) -> f64 {
    let chord = (at[2] - at[0]) / length;
    let (first, second) = (at[1] - chord, at[3] - chord);
    let bending = 4.0 * ei / length * (first * first + first * second + second * second);
    // the integral of the slope squared: chord and the slopes against it do not mix in it
    let pull = chord * chord + (2.0 * first * first - first * second + 2.0 * second * second) / 15.0;
    bending + tension * length * pull
}

/// A matrix times a number.
fn scale_matrix(factor: f64, mut matrix: Matrix4) -> Matrix4 {
    matrix.iter_mut().flatten().for_each(|value| *value *= factor);
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;

    const L: f64 = 3.7;

    /// The integral over the element of the product of two shapes.
    fn integral(shape: impl Fn(f64, f64) -> Vector4) -> Matrix4 {
        let mut sum = [[0.0; 4]; 4];
        for (a, weight) in GAUSS {
            let values = shape(a, L);
            for (row, value) in sum.iter_mut().zip(values) {
                add(row, weight * L * value, &values);
            }
        }
        sum
    }

    fn assert_near(one: Matrix4, other: Matrix4) {
        for (x, y) in one.iter().flatten().zip(other.iter().flatten()) {
            assert!((x - y).abs() < 1e-13 * (1.0 + y.abs()), "{x} {y}");
        }
    }

    #[test]
    fn beam_matrices_match_integrals_of_shape_functions() {
        assert_near(mass(1.0, L), integral(deflection));
        assert_near(geometric(1.0, L), integral(slope));
        assert_near(stiffness(1.0, L), integral(curvature));
        let uniform = uniform_load(2.0, L);
        assert_near([uniform; 4], [load(L, |_| 2.0); 4]);
    }

    #[test]
    fn slope_and_curvature_are_derivatives_of_deflection() {
        let h = 1e-5;
        for a in [0.1, 0.5, 0.83] {
            let (before, after) = (deflection(a - h, L), deflection(a + h, L));
            let (back, on) = (slope(a - h, L), slope(a + h, L));
            for i in 0..4 {
                // central differences: truncation h^2, rounding 1e-16/h
                assert!(((after[i] - before[i]) / (2.0 * h * L) - slope(a, L)[i]).abs() < 1e-9);
                assert!(((on[i] - back[i]) / (2.0 * h * L) - curvature(a, L)[i]).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn energy_matches_matrices_and_is_zero_for_rigid_motion() {
        let at = [0.3, -0.2, 0.7, 0.45];
        let matrix = dot(&at, &times(&stiffness(5.0, L), &at)) + dot(&at, &times(&geometric(2.0, L), &at));
        assert!((twice_energy(5.0, 2.0, L, &at) / matrix - 1.0).abs() < 1e-14);
        assert_eq!(twice_energy(1e9, 0.0, 2.0, &[1.0, 0.5, 2.0, 0.5]), 0.0);
    }
}
