"""Lines on a bathymetry, by equations of their own (scipy): a plane that slopes across the line, and a dome. 1200 N/m.

    python3 bathymetry_lines.py

On a plane: elastic catenary; what lies on the slope has the tension T = T_anchor + w sin(slope) s, and hangs on tangentially.
On the dome z = -200 - k (x - c)^2 (x from the anchor): inextensible; without friction T - w z is the same all along what lies,
and what hangs begins tangentially; the unknowns are the touchdown and the horizontal force.
"""
from math import asinh, atan, cos, hypot, radians, sin, sqrt
from scipy.optimize import fsolve

W = 1200.0


def plane(slope, x, z, length, ea):
    """Forces (N) of a line whose fairlead lies x beside and z above its anchor, on a bottom that rises by slope toward it."""
    a = atan(slope)

    def rest(unknown):
        h, lying = unknown[0] * 1e5, unknown[1] * 100.0
        tension = h / cos(a)
        v0, hung = tension * sin(a), length - lying
        v = v0 + W * hung
        at_anchor = tension - W * sin(a) * lying
        along = lying + (at_anchor * lying + 0.5 * W * sin(a) * lying**2) / ea
        own_x = h / W * (asinh(v / h) - asinh(v0 / h)) + h * hung / ea
        own_z = (hypot(h, v) - hypot(h, v0)) / W + (v**2 - v0**2) / (2.0 * W * ea)
        return along * cos(a) + own_x - x, along * sin(a) + own_z - z

    (h, lying), _, good, _ = fsolve(rest, (3.0, 4.0), xtol=1e-14, full_output=True)
    h, lying = h * 1e5, lying * 100.0
    assert good == 1 and 0.0 < lying < length, (h, lying)
    return h, h * sin(a) / cos(a) + W * (length - lying), lying


def dome(k, c, x, z, length):
    """The same on the dome, its top c from the anchor; z is the fairlead's elevation."""

    def bottom(at):
        return -200.0 - k * (at - c) ** 2

    def arc(at):
        # along the parabola from its top
        u = 2.0 * k * (at - c)
        return (u * sqrt(1.0 + u * u) + asinh(u)) / (4.0 * k)

    def rest(unknown):
        at, h = unknown[0] * 100.0, unknown[1] * 1e5
        slope = -2.0 * k * (at - c)
        v0 = h * slope
        v = v0 + W * (length - (arc(at) - arc(0.0)))
        own_x = h / W * (asinh(v / h) - asinh(v0 / h))
        own_z = (hypot(h, v) - hypot(h, v0)) / W
        return at + own_x - x, bottom(at) + own_z - z

    (at, h), _, good, _ = fsolve(rest, (4.0, 3.0), xtol=1e-14, full_output=True)
    at, h = at * 100.0, h * 1e5
    assert good == 1 and 0.0 < at < x, (at, h)
    lying = arc(at) - arc(0.0)
    return h, -2.0 * k * (at - c) * h + W * (length - lying), lying


if __name__ == "__main__":
    # bottom -200 + 0.05 y: lines that leave their anchor at the origin at 0, 30 and -90 degrees
    for degrees in (0.0, 30.0, -90.0):
        slope = 0.05 * sin(radians(degrees))
        h, v, lying = plane(slope, 900.0, 190.0, 968.0, 6e8)
        print(f"plane {degrees}: {h:.6f} {v:.6f} {lying:.9f}")
    d = 1e-5
    (h1, v1, _), (h0, v0, _) = (plane(0.05 * sin(a), 900.0, 190.0, 968.0, 6e8) for a in (d, -d))
    print(f"by azimuth: {(h1 - h0) / (2 * d):.4f} {(v1 - v0) / (2 * d):.4f}")
    print("dome: {:.6f} {:.6f} {:.9f}".format(*dome(5e-5, 250.0, 900.0, -10.0, 968.0)))
