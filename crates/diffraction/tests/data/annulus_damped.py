"""The annulus of annulus.py with a damped surface inside, phi_z = nu (1 + i epsilon) phi: wave elevation in its middle, and the part of the energy that is lost.
The eigenfunctions of the inside have complex wave numbers, k tanh k h = nu (1 + i epsilon); all else is as there.
Writes annulus_damped.csv: epsilon, wave number, elevation in the middle over the wave amplitude, power that the inside takes over rho g times the square of the
amplitude (m2/s2 m), by the flux through the cylinder below the inner side."""
import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import hankel1, iv, jv, k0e, k1e

from annulus import DEPTH, DRAUGHT, GRAVITY, INNER, OUTER, elevation, modes, slopes_below


def inner_modes(k, count, epsilon):
    kn, _ = modes(k, count)
    kn = kn.astype(complex)
    nu = k * np.tanh(k * DEPTH)
    # Newton from the free surface, by steps of epsilon
    for share in np.linspace(0, 1, 21)[1:]:
        value = nu * (1 + 1j * epsilon * share)
        for _ in range(20):
            x = kn[0]
            f, slope = x * np.tanh(x * DEPTH) - value, np.tanh(x * DEPTH) + x * DEPTH / np.cosh(x * DEPTH) ** 2
            kn[0] -= f / slope
            x = kn[1:]
            f = x * np.sin(x * DEPTH) + value * np.cos(x * DEPTH)
            slope = np.sin(x * DEPTH) + x * DEPTH * np.cos(x * DEPTH) - value * DEPTH * np.sin(x * DEPTH)
            kn[1:] -= f / slope
    norms = 0.5 * (1 + np.sin(2 * kn * DEPTH) / (2 * kn * DEPTH))
    norms[0] = 0.5 * (1 + np.sinh(2 * kn[0] * DEPTH) / (2 * kn[0] * DEPTH))
    return kn, np.sqrt(norms)


def solve(k, epsilon, count=80):
    kn, norm = modes(k, count)
    ki, own = inner_modes(k, count, epsilon)
    gap = DEPTH - DRAUGHT
    lam = np.arange(count) * np.pi / gap
    y, weight = np.polynomial.legendre.leggauss(600)
    y, weight = 0.5 * gap * (y + 1), 0.5 * weight
    z = np.empty((count, len(y)))
    z[0], z[1:] = np.cosh(k * y) / norm[0], np.cos(np.outer(kn[1:], y)) / norm[1:, None]
    zi = np.empty((count, len(y)), complex)
    zi[0], zi[1:] = np.cosh(ki[0] * y) / own[0], np.cos(np.outer(ki[1:], y)) / own[1:, None]
    cosines = np.cos(np.outer(lam, y)) * weight
    C, Ci = cosines @ z.T, cosines @ zi.T
    double = np.where(np.arange(count) == 0, 1.0, 2.0)
    out_slope = np.empty(count, complex)
    out_slope[0] = -k * hankel1(1, k * OUTER) / hankel1(0, k * OUTER)
    out_slope[1:] = -kn[1:] * k1e(kn[1:] * OUTER) / k0e(kn[1:] * OUTER)
    in_slope = np.empty(count, complex)
    in_slope[0] = -ki[0] * jv(1, ki[0] * INNER) / jv(0, ki[0] * INNER)
    in_slope[1:] = ki[1:] * iv(1, ki[1:] * INNER) / iv(0, ki[1:] * INNER)
    Fo, Fi, Go, Gi = slopes_below(lam)
    unit = norm[0] / np.cosh(k * DEPTH)
    at, slope = unit * jv(0, k * OUTER), -unit * k * jv(1, k * OUTER)
    share = gap / DEPTH
    out, inside = double[:, None] * C * (share / out_slope), double[:, None] * Ci * (share / in_slope)
    matrix = np.zeros((2 * count, 2 * count), complex)
    right = np.zeros(2 * count, complex)
    matrix[:count, :count] = np.eye(count) - out @ (C * Fo[:, None]).T
    matrix[:count, count:] = -out @ (C * Go[:, None]).T
    matrix[count:, :count] = -inside @ (Ci * Fi[:, None]).T
    matrix[count:, count:] = np.eye(count) - inside @ (Ci * Gi[:, None]).T
    right[:count] = double * C[:, 0] * (at - slope / out_slope[0])
    A, B = np.split(np.linalg.solve(matrix, right), 2)
    velocity = Fi * A + Gi * B
    beta = share * (Ci.T @ velocity) / in_slope
    middle = beta[0] / jv(0, ki[0] * INNER) * np.cosh(ki[0] * DEPTH) / own[0]
    rest = beta[1:] / iv(0, ki[1:] * INNER) * np.cos(ki[1:] * DEPTH) / own[1:]
    found = (1 + 1j * epsilon) * (middle + rest.sum())
    # p = rho g s, velocity = -i g/omega s' of the part s that is the same all round; others do not pass far in, and are left out
    omega = np.sqrt(GRAVITY * k * np.tanh(k * DEPTH))
    flux = gap * 2 * np.pi * INNER * (B * np.conj(velocity) / double).sum()
    power = 0.5 * (1j * GRAVITY / omega * flux).real
    return found, -power


if __name__ == "__main__":
    # without damping it is the annulus of annulus.py
    for k in [0.55, 0.7, 1.0]:
        assert abs(solve(k, 0.0)[0] - elevation(k)) < 1e-9 * abs(elevation(k)), k
    with open("annulus_damped.csv", "w") as file:
        file.write("# The annulus of annulus.py with a damped surface inside, by matched eigenfunctions (annulus_damped.py); power over rho g\n")
        file.write("epsilon,k,re,im,power of the part without angle\n")
        for epsilon in [0.02, 0.1]:
            top = minimize_scalar(lambda k: -abs(solve(k, epsilon)[0]), bounds=(0.6, 0.85), method="bounded", options={"xatol": 1e-8})
            for k in [top.x, 0.55, 0.7, 0.76, 1.0]:
                value, power = solve(k, epsilon, 120)
                file.write(f"{epsilon},{k:.6f},{value.real:.6g},{value.imag:.6g},{power:.6g}\n")
