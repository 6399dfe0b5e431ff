"""Wave elevation in the middle of a floating annulus that is held, by matched eigenfunctions: 2 outside, 0.5 inside, 1 deep, in water 4 deep. Its
middle sees the part of the wave alone that is the same all round. Three regions, outside, below and inside the annulus, each with its own
eigenfunctions; potentials and radial velocities meet between them. 160 of them change the height of the peak by 1e-4 against 80.
Writes annulus.csv: wave number of the peak, its height over the wave amplitude; then wave numbers beside it."""
import numpy as np
from scipy.optimize import brentq, minimize_scalar
from scipy.special import hankel1, i0e, i1e, jv, k0e, k1e

OUTER, INNER, DRAUGHT, DEPTH, GRAVITY = 2.0, 0.5, 1.0, 4.0, 9.81


def modes(k, count):
    """Wave numbers, the first k itself and the others of cos k_n(z + h), and the squares of the norms over h."""
    nu = k * np.tanh(k * DEPTH)
    kn = [k] + [
        brentq(lambda x: x * np.sin(x * DEPTH) + nu * np.cos(x * DEPTH), (n - 0.5) * np.pi / DEPTH + 1e-12, n * np.pi / DEPTH)
        for n in range(1, count)
    ]
    kn = np.array(kn)
    norms = 0.5 * (1 + np.sin(2 * kn * DEPTH) / (2 * kn * DEPTH))
    norms[0] = 0.5 * (1 + np.sinh(2 * k * DEPTH) / (2 * k * DEPTH))
    return kn, np.sqrt(norms)


def slopes_below(lam):
    """Slopes at both sides of radial functions below the annulus: of F, which is 1 outside and 0 inside, and of G, the other way round."""
    Fo, Fi, Go, Gi = (np.empty(len(lam)) for _ in range(4))
    span = np.log(OUTER / INNER)
    Fo[0], Fi[0], Go[0], Gi[0] = 1 / (OUTER * span), 1 / (INNER * span), -1 / (OUTER * span), -1 / (INNER * span)
    a, b = lam[1:] * OUTER, lam[1:] * INNER
    fall = np.exp(-(a - b))  # scaled Bessel functions: I ~ exp(x) ie, K ~ exp(-x) ke
    down = i0e(a) * k0e(b) - i0e(b) * k0e(a) * fall**2
    Fo[1:] = lam[1:] * (i1e(a) * k0e(b) + k1e(a) * i0e(b) * fall**2) / down
    Fi[1:] = lam[1:] * (i1e(b) * k0e(b) + k1e(b) * i0e(b)) * fall / down
    Go[1:] = -lam[1:] * (i1e(a) * k0e(a) + k1e(a) * i0e(a)) * fall / down
    Gi[1:] = -lam[1:] * (i0e(a) * k1e(b) + i1e(b) * k0e(a) * fall**2) / down
    return Fo, Fi, Go, Gi


def elevation(k, count=80):
    kn, norm = modes(k, count)
    gap = DEPTH - DRAUGHT
    lam = np.arange(count) * np.pi / gap
    # C[l, n] = 1/gap int_0^gap cos(lam y) Z_n(y) dy, y = z + h, by Gauss's rule
    y, weight = np.polynomial.legendre.leggauss(600)
    y, weight = 0.5 * gap * (y + 1), 0.5 * weight
    z = np.empty((count, len(y)))
    z[0] = np.cosh(k * y) / norm[0]
    z[1:] = np.cos(np.outer(kn[1:], y)) / norm[1:, None]
    C = (np.cos(np.outer(lam, y)) * weight) @ z.T
    double = np.where(np.arange(count) == 0, 1.0, 2.0)  # 1 over the norm of a cosine
    # radial functions outside, equal to 1 on the outer side, and their slopes; inside the same on the inner side
    out_slope = np.empty(count, complex)
    out_slope[0] = -k * hankel1(1, k * OUTER) / hankel1(0, k * OUTER)
    out_slope[1:] = -kn[1:] * k1e(kn[1:] * OUTER) / k0e(kn[1:] * OUTER)
    in_slope = np.empty(count)
    in_slope[0] = -k * jv(1, k * INNER) / jv(0, k * INNER)
    in_slope[1:] = kn[1:] * i1e(kn[1:] * INNER) / i0e(kn[1:] * INNER)
    Fo, Fi, Go, Gi = slopes_below(lam)
    # incident wave J0(k r) cosh k(z + h)/cosh kh as a multiple of Z_0
    unit = norm[0] / np.cosh(k * DEPTH)
    at, slope = unit * jv(0, k * OUTER), -unit * k * jv(1, k * OUTER)
    # unknowns: A (below, outside), B (below, inside). phi_out = incident + sum alpha Z, alpha from velocities:
    # alpha_n out_slope_n + slope (n = 0) = gap/h sum_l C_ln (A_l Fo_l + B_l Go_l); potentials: A_l = double_l sum_n C_ln (..)
    share = gap / DEPTH
    out = double[:, None] * C * (share / out_slope)  # to A
    inside = double[:, None] * C * (share / in_slope)
    matrix = np.zeros((2 * count, 2 * count), complex)
    right = np.zeros(2 * count, complex)
    matrix[:count, :count] = np.eye(count) - out @ (C * Fo[:, None]).T
    matrix[:count, count:] = -out @ (C * Go[:, None]).T
    matrix[count:, :count] = -inside @ (C * Fi[:, None]).T
    matrix[count:, count:] = np.eye(count) - inside @ (C * Gi[:, None]).T
    right[:count] = double * C[:, 0] * (at - slope / out_slope[0])
    A, B = np.split(np.linalg.solve(matrix, right), 2)
    beta = share * (C.T @ (Fi * A + Gi * B)) / in_slope
    # in the middle J0 = 1 over J0(k b), I0 = 1 over I0(kn b); surface
    middle = beta[0] / jv(0, k * INNER) * np.cosh(k * DEPTH) / norm[0]
    rest = beta[1:] / i0e(kn[1:] * INNER) * np.exp(-kn[1:] * INNER) * np.cos(kn[1:] * DEPTH) / norm[1:]
    return middle + rest.sum()


if __name__ == "__main__":
    # without an annulus the wave goes through: a check of the parts
    found = minimize_scalar(lambda k: -abs(elevation(k)), bounds=(0.6, 0.85), method="bounded", options={"xatol": 1e-9})
    finer = minimize_scalar(lambda k: -abs(elevation(k, 160)), bounds=(0.6, 0.85), method="bounded", options={"xatol": 1e-9})
    print(found.x, -found.fun, finer.x, -finer.fun)
    with open("annulus.csv", "w") as file:
        file.write("# A floating annulus, held, by matched eigenfunctions (annulus.py): wave number, elevation in the middle (real, imaginary); the first row is the peak\n")
        file.write("k,re,im\n")
        for k in [finer.x, 0.4, 0.55, 0.65, 0.85, 1.0, 1.3]:
            value = elevation(k, 160)
            file.write(f"{k:.6f},{value.real:.6g},{value.imag:.6g}\n")
