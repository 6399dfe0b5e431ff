"""Lines over bottoms of plane faces, solved without windlass: for each case the contacts are stated by hand, the free spans
are closed forms (Irvine 1981, eqs 1.36 and 1.37), and scipy's root closes the touchdowns, ridges and ends (residuals
below 1e-9 m). Every solution is checked to stay above the bottom and to press on it. Prints the numbers that
crates/catenary/tests/it/catenary_bottoms.rs and tests/it/connectors/profile_lines.rs compare with.

u is the distance from the anchor toward the fairlead, faces are numbered from the anchor. Friction mu takes
w (sin + mu cos) of tension a length toward the anchor, and the factor exp(-mu angle) around a ridge.
"""
import numpy as np
from scipy.optimize import root


class Line:
    def __init__(self, u, z, h, v, w, EA, L, mu, places):
        self.u, self.z, self.h, self.v, self.w, self.EA, self.left, self.mu = u, z, h, v, w, EA, L, mu
        self.at = np.array([p[0] for p in places], float)
        self.zs = np.array([p[1] for p in places], float)
        self.slopes = np.diff(self.zs) / np.diff(self.at)
        self.path, self.presses, self.grounded = [], [], 0.0

    def bottom(self, u):
        k = np.clip(np.searchsorted(self.at, u) - 1, 0, len(self.slopes) - 1)
        return self.zs[k] + (u - self.at[k]) * self.slopes[k]

    def hang(self, s):
        h, v, w, EA = self.h, self.v, self.w, self.EA
        for part in np.linspace(0, s, 200):
            low = v - w * part
            x = h / w * (np.arcsinh(v / h) - np.arcsinh(low / h)) + h * part / EA
            drop = (np.hypot(h, v) - np.hypot(h, low)) / w + (v * part - 0.5 * w * part**2) / EA
            self.path.append((self.u - x, self.z - drop))
        self.u, self.z, self.v, self.left = self.u - x, self.z - drop, low, self.left - s
        return self

    def to_tangent(self, face):
        """Hangs down to where the line runs along a face; what is left between them."""
        self.hang((self.v - self.h * self.slopes[face]) / self.w)
        return self.z - (self.zs[face] + (self.u - self.at[face]) * self.slopes[face])

    def lie(self, face, s):
        slope = self.slopes[face]
        cos, sin = 1 / np.hypot(1, slope), slope / np.hypot(1, slope)
        T, loss = np.hypot(self.h, self.v), self.w * (sin + self.mu * cos)
        end = T - loss * s
        along = s * (1 + 0.5 * (T + end) / self.EA)
        self.presses += [s, end]
        self.u, self.z, self.left = self.u - along * cos, self.z - along * sin, self.left - s
        self.h, self.v, self.grounded = end * cos, end * sin, self.grounded + s
        return self

    def lie_to(self, face, u):
        """Lies up to a vertex."""
        slope = self.slopes[face]
        cos, sin = 1 / np.hypot(1, slope), slope / np.hypot(1, slope)
        T, loss = np.hypot(self.h, self.v), self.w * (sin + self.mu * cos)
        along = (self.u - u) / cos
        # s (1 + T/EA) - loss s2/(2 EA) = along
        a, b = -0.5 * loss / self.EA, 1 + T / self.EA
        s = along / b if abs(a) < 1e-300 else 2 * along / (b + np.sqrt(b * b + 4 * a * along))
        return self.lie(face, s)

    def turn(self, by):
        T, angle = np.hypot(self.h, self.v) * np.exp(-self.mu * by), np.arctan2(self.v, self.h) + by
        self.presses.append(by)
        self.h, self.v = T * np.cos(angle), T * np.sin(angle)
        return self

    def turn_to(self, face):
        return self.turn(np.arctan(self.slopes[face]) - np.arctan2(self.v, self.h))


def case(name, places, X, Z, L, w, EA, mu, unknowns, contacts):
    def close(p):
        line = Line(X, Z, p[0], p[1], w, EA, L, mu, places)
        return np.array(contacts(line, p), float), line
    scale = np.array([u if u else 1.0 for u in unknowns])
    found = root(lambda q: close(q * scale)[0], np.ones(len(scale)), method="hybr", options=dict(xtol=1e-14, maxfev=20000))
    off, line = close(found.x * scale)
    assert np.abs(off).max() < 1e-9 * L, (name, off, found.x * scale)
    gaps = [z - line.bottom(u) for u, z in line.path if u >= 0]
    assert min(gaps) > -1e-7 * L, (name, min(gaps))
    assert min(line.presses) > 0, (name, line.presses)
    H, V = found.x[:2] * scale[:2]
    print(f"{name}: H {H:.6f} V {V:.6f} far {line.h:.6f} {line.v:.6f} grounded {line.grounded:.9f}")


def valley(line, p):
    one = line.to_tangent(1)
    line.lie(1, p[2])
    two = line.to_tangent(0)
    return [one, two, line.lie(0, line.left).u]


def ridge(line, p):
    one = line.to_tangent(1)
    line.lie_to(1, line.at[1]).turn_to(0)
    return [one, line.lie(0, line.left).u]


def tip(line, p):
    line.hang(p[2])
    aside, above = line.u - line.at[1], line.z - line.zs[1]
    line.turn(p[3])
    two = line.to_tangent(0)
    return [aside, above, two, line.lie(0, line.left).u]


def bridge(line, p):
    one = line.to_tangent(3)
    line.lie_to(3, line.at[3]).turn(p[2]).hang(p[3])
    aside, above = line.u - line.at[1], line.z - line.zs[1]
    line.turn_to(0)
    return [one, aside, above, line.lie(0, line.left).u]


CHAIN = dict(w=1200.0, EA=6e8)
for mu in (0.0, 0.2):
    case(f"valley {mu}", [(0, -200), (400, -220), (1000, -190)], 900, -10, 968, mu=mu, **CHAIN,
         unknowns=[3e5, 5e5, 150.0], contacts=valley)
    case(f"ridge {mu}", [(0, -220), (250, -190), (1000, -215)], 800, -10, 876, mu=mu, **CHAIN,
         unknowns=[3e5, 5e5], contacts=ridge)
    case(f"tip {mu}", [(0, -260), (300, -170), (1000, -400)], 700, -10, 765, mu=mu, **CHAIN,
         unknowns=[6e5, 6e5, 400.0, 0.3], contacts=tip)
    case(f"bridge {mu}", [(0, -230), (150, -200), (230, -260), (310, -195), (1000, -215)], 900, -10, 976, mu=mu, **CHAIN,
         unknowns=[3e5, 5e5, 0.03, 162.0], contacts=bridge)
