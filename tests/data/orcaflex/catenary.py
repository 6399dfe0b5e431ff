"""Forces at the first ends of the lines of two_lines.yml by the closed forms of the elastic catenary: on the seabed with friction, and hanging free. Run
in a Python with scipy."""
import math

from scipy.optimize import fsolve

G, RHO = 9.80665, 1.025


def hanging(h, v, w, length, ea):
    x = h / w * (math.asinh(v / h) - math.asinh((v - w * length) / h)) + h * length / ea
    z = h / w * (math.hypot(1, v / h) - math.hypot(1, (v - w * length) / h)) + (v * length - w * length**2 / 2) / ea
    return x, z


def grounded(h, v, w, length, ea, mu):
    laid = length - v / w
    held = max(laid - h / (mu * w), 0.0)
    x = laid + h / w * math.asinh(v / h) + h * length / ea + mu * w / (2 * ea) * (held * (laid - h / (mu * w)) - laid**2)
    z = h / w * (math.hypot(1, v / h) - 1) + v**2 / (2 * ea * w)
    return x, z


def solve(form, x, z, guess, *rest):
    h, v = fsolve(lambda p: [a - b for a, b in zip(form(p[0], p[1], *rest), (x, z))], guess, xtol=1e-13)
    return h, v


area = math.pi / 4
chain = (0.2 - RHO * area * 0.15**2) * G
print("chain leg: H %.9f kN, V %.9f kN" % solve(grounded, 300, 90, (100, 150), chain, 330, 800e3, 0.5))
hose = (0.1842262 + 1.0 * area * 0.254**2 - RHO * area * 0.3556**2) * G
# from the vessel's point at 2, 0, -7.5 to the fixed place
print("hose: H %.9f kN, V %.9f kN" % solve(hanging, 60, 12.5, (20, 60), hose, 110, 711.2e3))
