//! Natural modes of a tether in one plane: `K phi = w^2 M phi` in banded form.
//!
//! Each eigenvalue is enclosed by counting the negative pivots of `K - s M` (Sturm's sequence
//! [PARLETT-1998 3.3]), its shape found by inverse iteration, and the eigenvalue reckoned again from the energies of
//! the shape. The error of the last is the square of that of the shape, and the energy of bending leaves out rigid motion to
//! the last digit, so that modes held by soft springs alone keep all their digits beside a stiffness a million times theirs.

use super::beam::PlaneMatrix;
use super::jacobi::eigenvalue_places;
use std::f64::consts::{PI, TAU};
use windlass_base::units::Dim;
use windlass_model::ClassError;
use windlass_nonlinear::try_bisect;

/// Halvings of an interval at most; a double has no more to give.
const MAX_BISECTIONS: usize = 200;
/// Inverse iterations at most, and the change of the shape that ends them.
const MAX_INVERSE_ITERATIONS: usize = 12;
const SHAPE_TOLERANCE: f64 = 1e-14;
/// Slope (rad) that counts as much as unit deflection when a shape is scaled: ten degrees [AQWA-TETHER 7.2].
const TEN_DEGREES: f64 = PI / 18.0;

/// The problem of one plane.
pub struct Pencil<'a> {
    /// Stiffness. An unknown that is held has a positive diagonal alone ([`PlaneMatrix::hold`]).
    pub stiffness: &'a PlaneMatrix,
    /// Mass. An unknown that is held has none.
    pub mass: &'a PlaneMatrix,
    /// Twice the energy of a deflected plane, springs included: [`super::beam::twice_energy`] of each element.
    pub twice_energy: &'a dyn Fn(&[f64]) -> f64,
}

/// A mode of one plane.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneMode {
    /// Square of its frequency (rad2/s2); negative where it is not stable.
    pub eigenvalue: f64,
    /// Deflection and slope of each node; `phi' M phi = 1`.
    pub shape: Vec<f64>,
    /// Its unknown in the matrices ([`super::jacobi::eigenvalue_places`]): twice the node, and one more for a slope.
    pub position: Option<usize>,
}

/// The plane a mode lies in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModePlane {
    /// Deflections along y, rotations RZ.
    Y,
    /// Deflections along z, rotations RY.
    Z,
}

/// A mode of the whole tether, scaled as in the listing [AQWA-TETHER 7.2].
#[derive(Clone, Debug, PartialEq)]
pub struct NaturalMode {
    /// Its plane.
    pub plane: ModePlane,
    /// Square of its frequency (rad2/s2).
    pub eigenvalue: f64,
    /// Deflection of each node from the first: largest 1, positive, unless a slope would exceed ten degrees, which then is
    /// the largest.
    pub deflections: Vec<f64>,
    /// Slope d/dx of each node (rad) at that scale.
    pub slopes: Vec<f64>,
    /// Its unknown in the matrices of its plane: twice the node, and one more for a slope.
    pub position: Option<usize>,
}

impl NaturalMode {
    /// Frequency (rad/s); none of a mode that is not stable.
    pub fn frequency(&self) -> Option<f64> {
        (self.eigenvalue >= 0.0).then(|| self.eigenvalue.sqrt())
    }

    /// Period (s); none of a mode that is not stable or has no stiffness.
    pub fn period(&self) -> Option<f64> {
        (self.eigenvalue > 0.0).then(|| TAU / self.eigenvalue.sqrt())
    }

    /// `MODE FREEDOM POSN` [AQWA-TETHER 7.2]: its number among the four degrees of freedom Y, Z, RY, RZ of each node, from 1.
    pub fn freedom_position(&self) -> Option<usize> {
        self.dof_of([[1, 4], [2, 3]])
    }

    /// The place by those of deflection and slope in the two planes.
    pub(crate) fn dof_of(&self, dofs: [[usize; 2]; 2]) -> Option<usize> {
        let [deflection, slope] = dofs[usize::from(self.plane == ModePlane::Z)];
        self.position.map(|position| 4 * (position / 2) + if position % 2 == 0 { deflection } else { slope })
    }

    /// Y, Z (scaled), RY, RZ (rad) of a node by the right hand.
    pub fn node(&self, index: usize) -> [f64; 4] {
        let value = |list: &[f64]| list[index];
        let (deflection, slope) = (value(&self.deflections), value(&self.slopes));
        match self.plane {
            ModePlane::Y => [deflection, 0.0, 0.0, slope],
            // 0 - x: no minus before a zero
            ModePlane::Z => [0.0, deflection, 0.0 - slope, 0.0],
        }
    }
}

/// Shortest natural period that a tether should have (s): those of very short elements are below it, and their bending is lost in the
/// rounding of the program [AQWA-TETHER 4].
pub const SHORTEST_PERIOD: f64 = 0.01;

/// How many modes of a plane have a period below one (s).
///
/// # Errors
/// A matrix with an entry that is no finite number.
pub fn count_below_period(pencil: &Pencil, period: f64) -> Result<usize, ClassError> {
    let order = pencil.mass.order();
    let massive = (0..order).filter(|i| pencil.mass.get(*i, *i) > 0.0).count();
    let mut search = ModeSearch { pencil, factors: PlaneMatrix::new(order), shifted: PlaneMatrix::new(order) };
    let slower = search.count_eigenvalues_below((TAU / period).powi(2))?;
    Ok(massive.saturating_sub(slower))
}

/// What is said of a tether with modes that are too fast; nothing without one.
pub fn warn_of_fast_modes(tether: &str, count: usize) -> Option<String> {
    (count > 0).then(|| {
        format!(
            "tether {tether}: {count} natural periods are below {SHORTEST_PERIOD} s, the limit of the AQWA-TETHER manual: its shortest \
             elements are too stiff; give them a lower Young's modulus"
        )
    })
}

/// The lowest `number` modes of a plane (fewer when it has fewer), lowest eigenvalue first.
///
/// # Errors
/// A matrix with an entry that is no finite number.
pub fn modes(pencil: &Pencil, number: usize) -> Result<Vec<PlaneMode>, ClassError> {
    let order = pencil.mass.order();
    let mut ratio: f64 = 0.0;
    for i in 0..order {
        let (k, m) = (pencil.stiffness.get(i, i), pencil.mass.get(i, i));
        if !(k.is_finite() && m.is_finite()) {
            return Err(not_finite());
        }
        if m > 0.0 {
            ratio = ratio.max((k / m).abs());
        }
    }
    let massive = (0..order).filter(|i| pencil.mass.get(*i, *i) > 0.0).count();
    let number = number.min(massive);
    let mut search = ModeSearch { pencil, factors: PlaneMatrix::new(order), shifted: PlaneMatrix::new(order) };
    let ratio = ratio.max(f64::MIN_POSITIVE);
    let mut high = ratio;
    while search.count_eigenvalues_below(high)? < number && high < ratio * 1e12 {
        high *= 2.0;
    }
    let mut low = -ratio * 1e-9;
    while search.count_eigenvalues_below(low)? > 0 && low > -ratio * 1e12 {
        low *= 4.0;
    }
    let mut found: Vec<PlaneMode> = Vec::with_capacity(number);
    for index in 0..number {
        let shift = search.enclose(index, low, high, ratio * f64::EPSILON)?;
        found.push(search.shape(shift, &found)?);
    }
    found.sort_by(|a, b| a.eigenvalue.total_cmp(&b.eigenvalue));
    for (mode, position) in found.iter_mut().zip(eigenvalue_places(pencil.stiffness, pencil.mass)) {
        mode.position = Some(position);
    }
    Ok(found)
}

/// The error of a matrix with an entry that is not finite.
fn not_finite() -> ClassError {
    ClassError::new("the natural modes of the tether cannot be found: a stiffness or mass is not finite")
}

/// The modes of both planes together, lowest eigenvalue first and those in z before their like in y, scaled for the listing.
pub fn together(y: &[PlaneMode], z: &[PlaneMode], number: usize) -> Vec<NaturalMode> {
    let mut all: Vec<NaturalMode> =
        z.iter().map(|m| scale_mode(ModePlane::Z, m)).chain(y.iter().map(|m| scale_mode(ModePlane::Y, m))).collect();
    all.sort_by(|a, b| a.eigenvalue.total_cmp(&b.eigenvalue));
    all.truncate(number);
    all
}

/// A mode scaled for the listing.
fn scale_mode(plane: ModePlane, mode: &PlaneMode) -> NaturalMode {
    let deflections: Vec<f64> = mode.shape.iter().step_by(2).copied().collect();
    let slopes: Vec<f64> = mode.shape.iter().skip(1).step_by(2).copied().collect();
    let largest = |list: &[f64]| list.iter().fold(0.0, |most: f64, v| if v.abs() > most.abs() { *v } else { most });
    let (deflection, slope) = (largest(&deflections), largest(&slopes) / TEN_DEGREES);
    let size = if deflection.abs() >= slope.abs() { deflection } else { slope };
    let size = if size == 0.0 { 1.0 } else { size };
    let times = |list: Vec<f64>| list.into_iter().map(|v| v / size).collect();
    let (eigenvalue, position) = (mode.eigenvalue, mode.position);
    NaturalMode { plane, eigenvalue, deflections: times(deflections), slopes: times(slopes), position }
}

/// A search with its work space.
struct ModeSearch<'a> {
    pencil: &'a Pencil<'a>,
    factors: PlaneMatrix,
    shifted: PlaneMatrix,
}

impl ModeSearch<'_> {
    /// How many eigenvalues are below a value; leaves the factors of `K - s M`.
    fn count_eigenvalues_below(&mut self, value: f64) -> Result<usize, ClassError> {
        self.shifted.clone_from(self.pencil.stiffness);
        self.shifted.add_scaled(-value, self.pencil.mass);
        self.factors.factor_shifted(&self.shifted).map_err(|_| not_finite())
    }

    /// A value close to eigenvalue `index` (from 0), between two that enclose it.
    fn enclose(&mut self, index: usize, low: f64, high: f64, rounding: f64) -> Result<f64, ClassError> {
        let is_close = |[low, high]: [f64; 2]| high - low <= 1e-9 * low.abs().max(high.abs()) || high - low <= rounding;
        let is_below = |value| Ok::<bool, ClassError>(self.count_eigenvalues_below(value)? <= index);
        let [low, high] = try_bisect([low, high], MAX_BISECTIONS, is_close, is_below)?;
        Ok(0.5 * (low + high))
    }

    /// The mode next to a value, across all that are found.
    fn shape(&mut self, shift: f64, found: &[PlaneMode]) -> Result<PlaneMode, ClassError> {
        let order = self.pencil.mass.order();
        self.count_eigenvalues_below(shift)?;
        // no symmetry that a mode could lack, and the same every time
        let mut shape: Vec<f64> = (0..order).map(|i| 1.0 + 0.37 * (1.7 * i as f64 + 0.4).sin()).collect();
        let mut momentum = vec![0.0; order];
        let mut before = vec![0.0; order];
        for _ in 0..MAX_INVERSE_ITERATIONS {
            self.pencil.mass.times(&shape, &mut momentum);
            shape.copy_from_slice(&momentum);
            self.factors.solve(&mut shape);
            self.normalise(&mut shape, &mut momentum, found);
            let sign: f64 = shape.iter().zip(&before).map(|(a, b)| a * b).sum();
            let size = shape.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
            let change =
                shape.iter().zip(&before).fold(0.0, |most: f64, (a, b)| most.max((a - sign.signum() * b).abs()));
            before.copy_from_slice(&shape);
            if change <= SHAPE_TOLERANCE * size {
                break;
            }
        }
        let eigenvalue = (self.pencil.twice_energy)(&shape);
        if !eigenvalue.is_finite() {
            let message = "the natural mode of the tether near a squared frequency of {} cannot be found";
            return Err(ClassError::with_values(message, &[(shift, Dim::None)]));
        }
        Ok(PlaneMode { eigenvalue, shape, position: None })
    }

    /// Takes the found modes out of a shape (twice: once leaves the rounding of what was taken out) and gives it unit mass.
    fn normalise(&self, shape: &mut [f64], momentum: &mut [f64], found: &[PlaneMode]) {
        for _ in 0..2 {
            self.pencil.mass.times(shape, momentum);
            for mode in found {
                let part: f64 = mode.shape.iter().zip(momentum.iter()).map(|(a, b)| a * b).sum();
                for (value, other) in shape.iter_mut().zip(&mode.shape) {
                    *value -= part * other;
                }
            }
        }
        self.pencil.mass.times(shape, momentum);
        let mass: f64 = shape.iter().zip(momentum.iter()).map(|(a, b)| a * b).sum();
        if mass > 0.0 {
            let factor = mass.sqrt().recip();
            shape.iter_mut().for_each(|value| *value *= factor);
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::beam;
    use super::*;

    /// A uniform beam of unit length, EI and mass, under a tension, its ends on springs; `held` unknowns do not move.
    fn uniform(elements: usize, tension: f64, springs: f64, held: &[usize], number: usize) -> Vec<PlaneMode> {
        let length = 1.0 / elements as f64;
        let order = 2 * (elements + 1);
        let (mut k, mut m) = (PlaneMatrix::new(order), PlaneMatrix::new(order));
        for i in 0..elements {
            beam::assemble(&mut k, i, &beam::stiffness(1.0, length));
            beam::assemble(&mut k, i, &beam::geometric(tension, length));
            beam::assemble(&mut m, i, &beam::mass(1.0, length));
        }
        k.add(0, 0, springs);
        k.add(order - 2, order - 2, springs);
        for unknown in held {
            k.hold(*unknown, 1.0);
            m.hold(*unknown, 0.0);
        }
        let energy = |x: &[f64]| {
            let of = |i| beam::twice_energy(1.0, tension, length, &beam::of_element(x, i));
            (0..elements).map(of).sum::<f64>() + springs * (x[0] * x[0] + x[order - 2] * x[order - 2])
        };
        modes(&Pencil { stiffness: &k, mass: &m, twice_energy: &energy }, number).unwrap()
    }

    #[test]
    fn free_beam_has_two_rigid_modes_and_closed_form_flexible_modes() {
        // [BLEVINS-1979 table 8-1]: lambda 4.73004074, 7.85320462, 10.9956078
        let found = uniform(40, 0.0, 0.0, &[], 5);
        assert!(found[0].eigenvalue.abs() < 1e-12 && found[1].eigenvalue.abs() < 1e-12);
        for (mode, lambda) in found[2..].iter().zip([4.730_040_74f64, 7.853_204_62, 10.995_607_8]) {
            // the cubic's error is (lambda/elements)^4/720 of the eigenvalue
            assert!((mode.eigenvalue / lambda.powi(4) - 1.0).abs() < (lambda / 40.0).powi(4) / 700.0 + 1e-8);
        }
    }

    #[test]
    fn pinned_tensioned_beam_modes_match_closed_form() {
        // (n pi)^4 + T (n pi)^2 [BLEVINS-1979 8.1.7]
        let found = uniform(40, 25.0, 0.0, &[0, 80], 4);
        for (mode, n) in found.iter().zip(1..) {
            let wave = PI * f64::from(n);
            let want = wave.powi(4) + 25.0 * wave * wave;
            assert!((mode.eigenvalue / want - 1.0).abs() < (wave / 40.0).powi(4) / 500.0, "{n}");
            assert_eq!((mode.shape[0], mode.shape[80]), (0.0, 0.0));
        }
    }

    #[test]
    fn soft_spring_modes_keep_accuracy_beside_stiff_beam() {
        // a rigid bar has 2k/m and 6k/m; bending under its own inertia takes k L^3/(60 EI) and k L^3/(420 EI) of them. The
        // stiffest entry of the matrix is 8e9 times the spring; what is left is the next order, k^2 of the whole
        let k = 1e-4;
        let found = uniform(40, 0.0, k, &[], 2);
        assert!((found[0].eigenvalue / (2.0 * k * (1.0 - k / 60.0)) - 1.0).abs() < 1e-10, "{}", found[0].eigenvalue);
        assert!((found[1].eigenvalue / (6.0 * k * (1.0 - k / 420.0)) - 1.0).abs() < 1e-10, "{}", found[1].eigenvalue);
    }

    #[test]
    fn all_modes_are_available_and_orthogonal() {
        let found = uniform(6, 0.0, 2.0, &[], 99);
        assert_eq!(found.len(), 14);
        for (i, one) in found.iter().enumerate() {
            for other in &found[..i] {
                let mut product = vec![0.0; 14];
                let mut m = PlaneMatrix::new(14);
                (0..6).for_each(|e| beam::assemble(&mut m, e, &beam::mass(1.0, 1.0 / 6.0)));
                m.times(&one.shape, &mut product);
                let cross: f64 = other.shape.iter().zip(&product).map(|(a, b)| a * b).sum();
                assert!(cross.abs() < 1e-12, "{cross}");
            }
        }
        assert!(found.windows(2).all(|p| p[0].eigenvalue < p[1].eigenvalue));
    }

    #[test]
    fn beam_above_buckling_load_has_negative_eigenvalue() {
        // Euler's load is pi^2
        let found = uniform(20, -12.0, 0.0, &[0, 40], 2);
        assert!(found[0].eigenvalue < 0.0 && found[1].eigenvalue > 0.0);
        let natural = together(&found, &[], 9);
        assert_eq!((natural[0].period(), natural[0].frequency(), natural.len()), (None, None, 2));
    }

    #[test]
    fn shape_is_scaled_to_unit_deflection_or_ten_degrees() {
        let mode = |shape: Vec<f64>| PlaneMode { eigenvalue: 1.0, shape, position: None };
        let found = together(&[mode(vec![2.0, 0.1, -4.0, 0.2])], &[mode(vec![0.1, 0.5, 0.0, -1.0])], 9);
        assert_eq!((found[0].plane, found[1].plane), (ModePlane::Z, ModePlane::Y));
        assert_eq!(found[1].deflections, [-0.5, 1.0]);
        assert!((found[0].slopes[1] - TEN_DEGREES).abs() < 1e-15);
        assert_eq!(found[0].node(1), [0.0, found[0].deflections[1], -found[0].slopes[1], 0.0]);
    }
}
