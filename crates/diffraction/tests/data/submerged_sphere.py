"""Added mass, damping and wave forces of a sphere of radius 1 whose middle is DEPTH below the surface of deep water, by multipoles that meet the condition
of the surface, expanded about the middle (Linton, Ocean Engineering 18, 1991, with the depth infinite): time goes as exp(-i omega t), A and B over the displaced mass (and omega),
X over rho g for waves along x. Writes submerged_sphere.csv. Needs numpy and scipy."""
import csv
import math
import numpy as np
from scipy.special import expi

DEPTH, TERMS = 1.5, 24


def integrals(k):
    """int (q + k)/(q - k) q^n exp(-2 q d) dq below the pole, n = 0 .. 2 TERMS."""
    d, wave = DEPTH, math.exp(-2 * k * DEPTH)
    rest = [complex(-wave * expi(2 * k * d), math.pi * wave)]
    plain = [math.factorial(n) / (2 * d) ** (n + 1) for n in range(2 * TERMS + 1)]
    for n in range(1, 2 * TERMS + 1):
        rest.append(k * rest[-1] + plain[n - 1])
    return [p + 2 * k * r for p, r in zip(plain, rest)]


def solve(k, m):
    """Of modes with cos(m psi): the share of P_1^m on the sphere by its own motion, and by the wave (a potential of -i g/omega)."""
    orders = range(1, TERMS + 1)
    whole = integrals(k)
    image = np.array([[whole[n + s] / (math.factorial(n - m) * math.factorial(s + m)) for n in orders] for s in orders])
    own = np.diag([-(s + 1.0) for s in orders])
    slopes = own + np.array([[s * image[s - 1, n - 1] for n in orders] for s in orders])
    first = np.zeros(TERMS, dtype=complex)
    first[0] = 1.0
    wave = np.array([(2 if m else 1) * 1j**m * math.exp(-k * DEPTH) * k**s / math.factorial(s + m) for s in orders])
    moved = np.linalg.solve(slopes, first)
    met = np.linalg.solve(slopes, -np.array([s for s in orders]) * wave)
    at = lambda c: c[0] + image[0] @ c
    return at(moved), at(met) + wave[0]


def main():
    with open("submerged_sphere.csv", "w", newline="") as file:
        write = csv.writer(file, lineterminator="\n")
        write.writerow(["# by submerged_sphere.py"])
        write.writerow(["K", "A11", "B11", "A33", "B33", "Re X1", "Im X1", "Re X3", "Im X3"])
        for k in [0.2, 0.5, 0.8, 1.0, 1.5, 2.0, 3.0]:
            row = [k]
            forces = []
            for m in (1, 0):
                moved, met = solve(k, m)
                # the pressure i omega rho phi on the sphere, over the mass of 4 pi/3: cos2 of each axis adds up to it
                row += [f"{-moved.real:.6f}", f"{-moved.imag:.6f}"]
                force = 4 * math.pi / 3 * -1j * -1j * met
                forces += [f"{force.real:.6f}", f"{force.imag:.6f}"]
                # the energy of the waves far away: B over omega is K |X|^2/(2 g) of heave, of surge half of that
                energy = (1 if m else 2) * k * abs(force) ** 2 / 4 / (4 * math.pi / 3)
                assert abs(energy + moved.imag) < 1e-9 * abs(moved.imag), (k, m, energy, moved.imag)
            write.writerow(row + forces)


if __name__ == "__main__":
    main()
