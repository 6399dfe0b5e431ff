//! A hinge that knows the twist of the rod and a shape bent when free of load.

use super::bend::bend_slopes;
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

/// Unknowns of a hinge: the first edge, the second edge, the turn of the first about itself, and of the second.
pub(super) type Vector8 = SVector<f64, 8>;

/// One side of a hinge: the direction and length of its edge, and its director, a unit vector across it that turns with it.
#[derive(Clone, Copy, Debug)]
pub(super) struct HingeSide {
    pub direction: Vector3<f64>,
    pub length: f64,
    pub director: Vector3<f64>,
    /// Curvature angle it has at rest, by its components along the director and across it (rad).
    pub natural: [f64; 2],
}

impl HingeSide {
    /// The curvature at rest as a vector (1/m), turned with the edge.
    pub fn rest(&self) -> Vector3<f64> {
        self.director * self.natural[0] + self.direction.cross(&self.director) * self.natural[1]
    }
}

/// A director taken along by the shortest turn from one direction to another.
pub(super) fn transport_director(director: &Vector3<f64>, from: &Vector3<f64>, to: &Vector3<f64>) -> Vector3<f64> {
    let sum = from + to;
    let moved = director - sum * (director.dot(to) / (1.0 + from.dot(to)).max(1e-12));
    // rounding must not add up over a run
    (moved - to * moved.dot(to)).normalize()
}

/// The same turned by an angle about the direction it ends at.
pub(super) fn rotate_director(director: &Vector3<f64>, about: &Vector3<f64>, angle: f64) -> Vector3<f64> {
    let (sine, cosine) = angle.sin_cos();
    director * cosine + about.cross(director) * sine
}

/// Angle by which the second side is twisted against the first (rad).
pub(super) fn twist(e: &HingeSide, f: &HingeSide) -> f64 {
    let brought = transport_director(&e.director, &e.direction, &f.direction);
    f.direction.dot(&brought.cross(&f.director)).atan2(brought.dot(&f.director))
}

/// Energy of a hinge: 1/2 k |kappa - rest|^2 + 1/2 kt twist^2, but for what is constant.
pub(super) fn energy(k: f64, kt: f64, e: &HingeSide, f: &HingeSide) -> f64 {
    let angle = e.direction.cross(&f.direction).norm().atan2(e.direction.dot(&f.direction));
    let axis = e.direction.cross(&f.direction).try_normalize(1e-12).unwrap_or_else(Vector3::zeros);
    0.5 * k * (angle * angle - angle * axis.dot(&(e.rest() + f.rest()))) + 0.5 * kt * twist(e, f).powi(2)
}

/// Gradient of the energy and its derivative, with directors taken along by the shortest turn.
///
/// With c = e.f and s = (e x f).(b_e + b_f), b the curvature at rest on each side, the bending energy is k/2
/// (phi(c)^2 - phi/sin(phi) s); the twist turns by (e x f)/(1 + c).(de + df) as the edges turn
/// [BERGOU-2008 6]. The derivative is that of the gradient itself, so Newton's iteration is
/// exact.
pub(super) fn spatial(k: f64, kt: f64, e: &HingeSide, f: &HingeSide) -> (Vector8, SMatrix<f64, 8, 8>) {
    let (u, w) = (e.direction, f.direction);
    let c = u.dot(&w);
    let slopes = bend_slopes(u.cross(&w).norm(), c);
    let (be, bf) = (e.rest(), f.rest());
    let (qe, qf) = (be.cross(&u), bf.cross(&w));
    let s = w.dot(&qe) - u.dot(&qf);
    // energy by c, s, twist
    let by_c = k * (slopes.first - 0.5 * slopes.ratio[1] * s);
    let by_cc = k * (slopes.second - 0.5 * slopes.ratio[2] * s);
    let by_s = -0.5 * k * slopes.ratio[0];
    let by_cs = -0.5 * k * slopes.ratio[1];
    let by_m = kt * twist(e, f);
    // c, s and twist by the unknowns
    let (se, sf) = (qe * -c - qf, qe + qf * c);
    let (turn_e, turn_f) = (w.dot(&be), -u.dot(&bf));
    let psi = u.cross(&w) / (1.0 + c);
    let fall = psi / (1.0 + c);

    let ge = w * by_c + se * by_s + psi * by_m;
    let gf = u * by_c + sf * by_s + psi * by_m;
    let unit = Matrix3::identity();
    let o = |a: &Vector3<f64>, b: &Vector3<f64>| a * b.transpose();
    let (cross_u, cross_w) = (u.cross_matrix() / (1.0 + c), w.cross_matrix() / (1.0 + c));
    let ee = o(&w, &w) * by_cc
        + (o(&w, &se) + o(&se, &w)) * by_cs
        + (o(&u, &qe) * c - o(&qe, &w)) * by_s
        + o(&psi, &psi) * kt
        - (cross_w + o(&fall, &w)) * by_m;
    let ef = o(&w, &u) * by_cc
        + o(&w, &sf) * by_cs
        + o(&se, &u) * by_cs
        + unit * by_c
        + (o(&w, &qf) - o(&qe, &u)) * by_s
        + o(&psi, &psi) * kt
        + (cross_u - o(&fall, &u)) * by_m;
    let fe = o(&u, &w) * by_cc
        + o(&u, &se) * by_cs
        + o(&sf, &w) * by_cs
        + unit * by_c
        + (o(&qf, &w) - o(&u, &qe)) * by_s
        + o(&psi, &psi) * kt
        - (cross_w + o(&fall, &w)) * by_m;
    let ff = o(&u, &u) * by_cc
        + (o(&u, &sf) + o(&sf, &u)) * by_cs
        + (o(&qf, &u) - o(&w, &qf) * c) * by_s
        + o(&psi, &psi) * kt
        + (cross_u - o(&fall, &u)) * by_m;

    let (pe, pf) = (unit - o(&u, &u), unit - o(&w, &w));
    let (le, lf) = (1.0 / e.length, 1.0 / f.length);
    let mut gradient = Vector8::zeros();
    let mut matrix = SMatrix::<f64, 8, 8>::zeros();
    gradient.fixed_rows_mut::<3>(0).copy_from(&(pe * ge * le));
    gradient.fixed_rows_mut::<3>(3).copy_from(&(pf * gf * lf));
    gradient[6] = by_s * turn_e - by_m;
    gradient[7] = by_s * turn_f + by_m;
    // an edge's direction turns by (I - uu)/l of its move, and so do those projections
    let turning = |p: &Matrix3<f64>, u: &Vector3<f64>, g: &Vector3<f64>| {
        let across = p * g;
        p * -u.dot(g) - o(u, &across) - o(&across, u)
    };
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&((pe * ee * pe + turning(&pe, &u, &ge)) * (le * le)));
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&(pe * ef * pf * (le * lf)));
    matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&(pf * fe * pe * (le * lf)));
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&((pf * ff * pf + turning(&pf, &w, &gf)) * (lf * lf)));
    // gradients of the edges by the turns
    let e_te = w * (by_cs * turn_e) - be * (c * by_s) - psi * kt;
    let e_tf = w * (by_cs * turn_f) - bf * by_s + psi * kt;
    let f_te = u * (by_cs * turn_e) + be * by_s - psi * kt;
    let f_tf = u * (by_cs * turn_f) + bf * (c * by_s) + psi * kt;
    matrix.fixed_view_mut::<3, 1>(0, 6).copy_from(&(pe * e_te * le));
    matrix.fixed_view_mut::<3, 1>(0, 7).copy_from(&(pe * e_tf * le));
    matrix.fixed_view_mut::<3, 1>(3, 6).copy_from(&(pf * f_te * lf));
    matrix.fixed_view_mut::<3, 1>(3, 7).copy_from(&(pf * f_tf * lf));
    // torques by the edges, the same by symmetry of the energy
    matrix.fixed_view_mut::<1, 3>(6, 0).copy_from(&(pe * e_te * le).transpose());
    matrix.fixed_view_mut::<1, 3>(6, 3).copy_from(&(pf * f_te * lf).transpose());
    matrix.fixed_view_mut::<1, 3>(7, 0).copy_from(&(pe * e_tf * le).transpose());
    matrix.fixed_view_mut::<1, 3>(7, 3).copy_from(&(pf * f_tf * lf).transpose());
    matrix[(6, 6)] = kt - by_s * w.dot(&qe);
    matrix[(6, 7)] = -kt;
    matrix[(7, 6)] = -kt;
    matrix[(7, 7)] = kt + by_s * u.dot(&qf);
    (gradient, matrix)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hinge of two edges given as vectors, with directors taken along from those of a first shape and turned.
    fn move_hinge(start: &[HingeSide; 2], change: &Vector8) -> [HingeSide; 2] {
        [0, 1].map(|i| {
            let side = &start[i];
            let edge = side.direction * side.length + change.fixed_rows::<3>(3 * i);
            let direction = edge.normalize();
            let director = rotate_director(
                &transport_director(&side.director, &side.direction, &direction),
                &direction,
                change[6 + i],
            );
            HingeSide { direction, length: edge.norm(), director, natural: side.natural }
        })
    }

    fn start() -> [HingeSide; 2] {
        let side = |edge: Vector3<f64>, hint: Vector3<f64>, natural| {
            let direction = edge.normalize();
            let director = (hint - direction * direction.dot(&hint)).normalize();
            HingeSide { direction, length: edge.norm(), director, natural }
        };
        [
            side(Vector3::new(1.2, 0.1, 0.0), Vector3::y(), [0.3, -0.2]),
            side(Vector3::new(0.7, 0.5, -0.4), Vector3::new(0.1, 0.8, 0.5), [0.25, -0.1]),
        ]
    }

    #[test]
    fn spatial_hinge_forces_match_energy_finite_differences() {
        let (start, h) = (start(), 1e-6);
        let (gradient, matrix) = spatial(2.0, 1.5, &start[0], &start[1]);
        for i in 0..8 {
            let mut step = Vector8::zeros();
            step[i] = h;
            let at = |change: &Vector8| {
                let [e, f] = move_hinge(&start, change);
                (energy(2.0, 1.5, &e, &f), spatial(2.0, 1.5, &e, &f).0)
            };
            let (plus, minus) = (at(&step), at(&-step));
            // central differences of numbers of order one
            assert!(((plus.0 - minus.0) / (2.0 * h) - gradient[i]).abs() < 1e-8, "{i}");
            let difference = (plus.1 - minus.1) / (2.0 * h);
            let wrong = (difference - matrix.column(i)).amax();
            assert!(wrong < 1e-7, "{i}: {difference} {}", matrix.column(i));
        }
    }
}
