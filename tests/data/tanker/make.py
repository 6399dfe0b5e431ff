"""Writes tanker.3 and tanker.8, in the form of WAMIT with ULEN 1 m: surge forces of a box of 260 x 46 x 16 m, the size of a tanker.

Excitation: pressure of the undisturbed wave on the two ends (Froude and Krylov),
    X = 2 i B (1 - exp(-k T)) / k  sin(k L cos(b) / 2)     over rho g, exp(+i w t) as WAMIT has it.
Mean drift: waves reflected at the bow, F = rho g a^2 / 2  B R^2 (Maruo, J. Ship Research 4, 1960), with the reflection of a
vertical barrier of the same draft in deep water, R^2 = pi^2 I1^2(kT) / (pi^2 I1^2 + K1^2) (Ursell, Proc. Camb. Phil. Soc. 43, 1947).
"""

from math import cos, cosh, exp, pi, radians, sin

L, B, T, G = 260.0, 46.0, 16.0, 9.80665
PERIODS = [4, 4.5, 5, 5.5, 6, 6.5, 7, 7.5, 8, 8.5, 9, 9.5, 10, 10.5, 11, 12, 13, 14, 15, 16, 18, 20, 25, 30]


def reflected(x):
    # pi I1 = int_0^pi exp(x cos t) cos t dt, K1 = int_0^inf exp(-x cosh t) cosh t dt: trapezoids, exact for such ends
    n = 4000
    i = sum(exp(x * cos(pi * (j + 0.5) / n)) * cos(pi * (j + 0.5) / n) for j in range(n)) * pi / n
    h = 12 / n
    k = sum(exp(-x * cosh(j * h)) * cosh(j * h) for j in range(1, n)) * h + 0.5 * h * exp(-x)
    return i * i / (i * i + k * k)


with open("tanker.3", "w") as first, open("tanker.8", "w") as drift:
    for period in PERIODS:
        k = (2 * pi / period) ** 2 / G
        for heading in (0, 90, 180, 270):
            c = round(cos(radians(heading)), 12)
            x = 2 * B * (1 - exp(-k * T)) / k * sin(k * L * c / 2)
            d = 0.5 * B * reflected(k * T) * c
            pha = 90 if x >= 0 else -90
            first.write(f"{period:10.4f} {heading:6.1f} 1 {abs(x):.6E} {pha} {0:.6E} {x:.6E}\n")
            pha = 0 if d >= 0 else 180
            drift.write(f"{period:10.4f} {heading:6.1f} {heading:6.1f} 1 {abs(d):.6E} {pha} {d:.6E} {0:.6E}\n")
