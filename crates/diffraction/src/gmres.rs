//! GMRES for several right sides that go through the matrix together [SAAD-SCHULTZ-1986].

use nalgebra::Complex;
use rayon::prelude::*;

type C = Complex<f64>;

/// Iterations after which the Krylov spaces are begun anew.
const RESTART: usize = 60;
/// Sums of a scalar product side by side.
const LANES: usize = 8;
/// Rounds of restarts before it is given up.
const MAX_ROUNDS: usize = 4;

/// Vectors of one length, one after the other.
#[derive(Clone, Debug)]
pub struct Columns {
    length: usize,
    values: Vec<C>,
}

impl Columns {
    /// So many vectors of zeros.
    pub fn zeros(length: usize, count: usize) -> Self {
        Columns { length, values: vec![C::default(); length * count] }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.values.len().checked_div(self.length).unwrap_or_default()
    }

    /// Their length.
    pub fn length(&self) -> usize {
        self.length
    }

    /// One of them.
    pub fn column(&self, index: usize) -> &[C] {
        &self.values[index * self.length..(index + 1) * self.length]
    }

    /// One of them, to be written.
    pub fn column_mut(&mut self, index: usize) -> &mut [C] {
        &mut self.values[index * self.length..(index + 1) * self.length]
    }
}

/// The Krylov space of one right side.
struct Krylov {
    basis: Vec<Vec<C>>,
    /// Columns of the Hessenberg matrix, made triangular by the rotations.
    triangle: Vec<Vec<C>>,
    rotations: Vec<(f64, C)>,
    /// The right side in the basis, rotated; the last is the residual.
    rotated: Vec<C>,
    target: f64,
}

impl Krylov {
    fn new(residual: Vec<C>, target: f64) -> Self {
        let size = norm(&residual);
        let basis = if size > 0.0 { vec![residual.iter().map(|v| v / size).collect()] } else { Vec::new() };
        Krylov { basis, triangle: Vec::new(), rotations: Vec::new(), rotated: vec![C::new(size, 0.0)], target }
    }

    fn residual(&self) -> f64 {
        self.rotated.last().map_or(0.0, |v| v.norm())
    }

    fn is_done(&self) -> bool {
        self.basis.is_empty() || self.residual() <= self.target || self.triangle.len() == self.basis.len()
    }

    /// Takes the product of the matrix with the last vector of the basis.
    fn extend(&mut self, mut product: Vec<C>) {
        let mut column = Vec::with_capacity(self.basis.len() + 1);
        // Gram and Schmidt's method one by one: stable enough for GMRES
        for own in &self.basis {
            let share = dot(own, &product);
            for (value, own) in product.iter_mut().zip(own) {
                *value -= own * share;
            }
            column.push(share);
        }
        let size = norm(&product);
        for (i, (cosine, sine)) in self.rotations.iter().enumerate() {
            let (a, b) = (column[i], column[i + 1]);
            column[i] = a * *cosine + sine.conj() * b;
            column[i + 1] = b * *cosine - sine * a;
        }
        let last = column.len() - 1;
        let diagonal = column[last];
        let length = diagonal.norm().hypot(size);
        let (cosine, sine) = if diagonal.norm() > 0.0 {
            (diagonal.norm() / length, diagonal.conj() / diagonal.norm() * (size / length))
        } else {
            (0.0, C::new(1.0, 0.0))
        };
        column[last] = diagonal * cosine + sine.conj() * size;
        let residual = self.rotated[last];
        self.rotated[last] = residual * cosine;
        self.rotated.push(-sine * residual);
        self.rotations.push((cosine, sine));
        self.triangle.push(column);
        if size > 0.0 && size.is_finite() {
            self.basis.push(product.iter().map(|v| v / size).collect());
        }
    }

    /// Adds the best combination of the basis to a solution.
    fn add_to(&self, solution: &mut [C]) {
        let count = self.triangle.len();
        let mut shares = vec![C::default(); count];
        for i in (0..count).rev() {
            let known: C = (i + 1..count).map(|j| self.triangle[j][i] * shares[j]).sum();
            shares[i] = (self.rotated[i] - known) / self.triangle[i][i];
        }
        for (share, own) in shares.iter().zip(&self.basis) {
            for (value, own) in solution.iter_mut().zip(own) {
                *value += own * share;
            }
        }
    }
}

/// Solves `A x = b` for all right sides until each residual is at most `tolerance` of its right side: the solutions, and how often the matrix
/// was used; none where that takes too many rounds or a number is not finite. `multiply` gives the products of the matrix with vectors, and
/// `multiply_roughly` those that span the Krylov spaces: with what it leaves the next round begins.
pub fn solve(
    right: &Columns,
    tolerance: f64,
    multiply_roughly: impl Fn(&Columns) -> Columns,
    multiply: impl Fn(&Columns) -> Columns,
) -> Option<(Columns, usize)> {
    let mut solution = Columns::zeros(right.length(), right.count());
    let mut uses = 0;
    let targets: Vec<f64> = (0..right.count()).map(|i| tolerance * norm(right.column(i))).collect();
    let mut spaces: Vec<Krylov> =
        targets.iter().enumerate().map(|(i, target)| Krylov::new(right.column(i).to_vec(), *target)).collect();
    for _ in 0..MAX_ROUNDS {
        for _ in 0..RESTART {
            let active: Vec<usize> = (0..spaces.len()).filter(|i| !spaces[*i].is_done()).collect();
            if active.is_empty() {
                break;
            }
            let mut vectors = Columns::zeros(right.length(), active.len());
            for (position, index) in active.iter().enumerate() {
                vectors.column_mut(position).copy_from_slice(spaces[*index].basis.last()?);
            }
            let products = multiply_roughly(&vectors);
            uses += 1;
            let growing: Vec<&mut Krylov> = spaces.iter_mut().filter(|space| !space.is_done()).collect();
            growing
                .into_par_iter()
                .enumerate()
                .for_each(|(position, space)| space.extend(products.column(position).to_vec()));
        }
        for (index, space) in spaces.iter().enumerate() {
            space.add_to(solution.column_mut(index));
        }
        let products = multiply(&solution);
        uses += 1;
        let residuals: Vec<Vec<C>> = (0..right.count())
            .map(|i| right.column(i).iter().zip(products.column(i)).map(|(b, a)| b - a).collect())
            .collect();
        let sizes: Vec<f64> = residuals.iter().map(|residual| norm(residual)).collect();
        if sizes.iter().any(|size| !size.is_finite()) {
            return None;
        }
        // what rough products leave in the true residual is allowed for
        if sizes.iter().zip(&targets).all(|(size, target)| *size <= 2.0 * target) {
            return Some((solution, uses));
        }
        spaces = residuals.into_iter().zip(&targets).map(|(residual, target)| Krylov::new(residual, *target)).collect();
    }
    None
}

fn norm(vector: &[C]) -> f64 {
    vector.iter().map(|v| v.norm_sqr()).sum::<f64>().sqrt()
}

fn dot(one: &[C], other: &[C]) -> C {
    // sums side by side, which do not wait for each other
    let mut sums = [C::default(); LANES];
    let (ones, others) = (one.chunks_exact(LANES), other.chunks_exact(LANES));
    let rest: C = ones.remainder().iter().zip(others.remainder()).map(|(a, b)| a.conj() * b).sum();
    for (ones, others) in ones.zip(others) {
        for ((sum, a), b) in sums.iter_mut().zip(ones).zip(others) {
            *sum += a.conj() * b;
        }
    }
    sums.iter().sum::<C>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_right_sides_of_small_matrix_have_hand_solutions() {
        // A = [[2, i], [0, 4]]: A (1, 1) = (2 + i, 4), A (i, 2) = (4 i, 8)
        let i = C::new(0.0, 1.0);
        let mut right = Columns::zeros(2, 2);
        right.column_mut(0).copy_from_slice(&[C::new(2.0, 1.0), C::new(4.0, 0.0)]);
        right.column_mut(1).copy_from_slice(&[i * 4.0, C::new(8.0, 0.0)]);
        let multiply = |x: &Columns| {
            let mut out = Columns::zeros(2, x.count());
            for c in 0..x.count() {
                let [a, b] = [x.column(c)[0], x.column(c)[1]];
                out.column_mut(c).copy_from_slice(&[a * 2.0 + b * i, b * 4.0]);
            }
            out
        };
        let (found, _) = solve(&right, 1e-12, multiply, multiply).unwrap();
        for (value, exact) in found.values.iter().zip([C::new(1.0, 0.0), C::new(1.0, 0.0), i, C::new(2.0, 0.0)]) {
            assert!((value - exact).norm() < 1e-11, "{value}");
        }
    }
}
