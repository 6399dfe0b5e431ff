"""Lines of one segment over a plane slope, solved without windlass: the closed form of the free part, and bracketed roots
(scipy brentq) of the way that the line has to go. Writes static_slopes.csv.

The fairlead is x beside and z above the anchor, which lies on the bottom; slope is the rise of the bottom toward the
fairlead over the distance. w N/m, EA N, L m. With friction mu the tension on the bottom falls by
w (sin + mu cos) a length toward the anchor, not below zero.
regime: suspended; lying (tension up to the anchor); held (friction takes it all before); heap_anchor (it slides down to
the anchor); heap_touchdown (H = 0, the lower part hangs on the anchor).
"""
import csv
import numpy as np
from scipy.optimize import brentq

def way(H, V, L, w, EA):
    """x and drop of a free length below a section with H and V (Irvine 1981, eqs 1.36 and 1.37)."""
    low = V - w * L
    x = H / w * (np.arcsinh(V / H) - np.arcsinh(low / H)) + H * L / EA
    return x, (np.hypot(H, V) - np.hypot(H, low)) / w + (V * L - 0.5 * w * L * L) / EA


def touching(X, Z, L, w, EA, slope, mu, H):
    """V, length that hangs and x, z of the touchdown (from the anchor) for the force H; none if it is not reached."""
    Vt = H * slope
    def gap(V):
        s = (V - Vt) / w
        dx, dz = way(H, V, s, w, EA)
        return (Z - dz) - slope * (X - dx)
    hi = Vt + w * L
    if gap(hi) > 0:
        return None
    V = brentq(gap, Vt * (1 + 1e-15) + 1e-300, hi, xtol=1e-14 * (H + w * L), rtol=8.9e-16, maxiter=500)
    s = (V - Vt) / w
    dx, dz = way(H, V, s, w, EA)
    return V, s, X - dx, Z - dz


def ends(X, Z, L, w, EA, slope, mu, H):
    """How far from the anchor the line ends, its forces there, and the regime; for a force H."""
    cos, sin = 1 / np.hypot(1, slope), slope / np.hypot(1, slope)
    found = touching(X, Z, L, w, EA, slope, mu, H)
    if found is None:
        def off(V):
            dx, dz = way(H, V, L, w, EA)
            return (Z - dz) - slope * (X - dx)
        lo, hi = -w * L - 10 * H, H * slope + w * L
        while off(hi) > 0:
            hi += w * L + H
        while off(lo) < 0:
            lo -= w * L + H
        V = brentq(off, lo, hi, xtol=1e-14 * (H + w * L), rtol=8.9e-16, maxiter=500)
        dx, _ = way(H, V, L, w, EA)
        return X - dx, V, (H, V - w * L), "suspended", 0.0
    V, s, xt, zt = found
    T, loss, rest = H / cos, w * (sin + mu * cos), L - s
    if loss > 0 and T < loss * rest:
        under = T / loss
        lies = under * (1 + 0.5 * T / EA)
        if sin > mu * cos:
            return xt - lies * cos, V, (0.0, 0.0), "heap_anchor", rest
        return xt - (lies + rest - under) * cos, V, (0.0, 0.0), "held", rest
    end = T - loss * rest
    lies = rest * (1 + 0.5 * (T + end) / EA)
    return xt - lies * cos, V, (end * cos, end * sin), "lying", rest


def solve(X, Z, L, w, EA, slope, mu):
    cos, sin = 1 / np.hypot(1, slope), slope / np.hypot(1, slope)
    depth = Z - slope * X
    free = brentq(lambda s: s + 0.5 * w * s * s / EA - depth, 0, depth)
    if sin <= mu * cos and free < L:
        # without horizontal force: straight down, and along the slope to the anchor
        gain = max(w * (-sin - mu * cos), 0.0)
        way_along = X / cos
        lies = brentq(lambda s: s + 0.5 * gain * s * s / EA - way_along, 0, way_along)
        if lies + free <= L:
            T = gain * lies
            return 0.0, w * free, T * cos, T * sin, L - free, "heap_touchdown"
    f = lambda H: ends(X, Z, L, w, EA, slope, mu, H)[0]
    lo, hi = 1e-6 * w * L, w * L
    while f(hi) > 0:
        hi *= 4
    while f(lo) < 0:
        lo /= 64
    H = brentq(f, lo, hi, xtol=1e-14 * w * L, rtol=8.9e-16, maxiter=500)
    off, V, (h, v), regime, grounded = ends(X, Z, L, w, EA, slope, mu, H)
    assert abs(off) < 1e-8 * L, off
    return H, V, h, v, grounded, regime


def main():
    rng = np.random.default_rng(19)
    rows = []
    for system in range(60):
        # a mooring of eight lines over one plane: each goes along its own azimuth, and sees its own slope
        steep, mu = rng.uniform(0.005, 0.06), (0.0 if system % 3 else rng.uniform(0.0, 0.08))
        depth, w = rng.uniform(50, 400), 10 ** rng.uniform(2.3, 3.5)
        L, EA = depth * rng.uniform(2.0, 7.0), w * 10 ** rng.uniform(4.5, 6.0)
        for line in range(8):
            slope = steep * np.cos(np.pi * line / 4 + 0.2)
            top = rng.uniform(0.0, 20.0)
            X = np.sqrt(L * L - depth * depth) * rng.uniform(0.75, 1.0)
            Z = depth - top
            if Z < slope * X + 1:
                continue
            rows.append([system, line, X, Z, L, w, EA, slope, mu, *solve(X, Z, L, w, EA, slope, mu)])
    with open(__file__.replace(".py", ".csv"), "w", newline="") as f:
        out = csv.writer(f, lineterminator="\n")
        out.writerow("system line x_m z_m length_m w_N_per_m EA_N slope friction H_N V_N anchor_H_N anchor_V_N grounded_m regime".split())
        for r in rows:
            out.writerow([repr(float(v)) if isinstance(v, (float, np.floating)) else v for v in r])
    print(len(rows), {k: sum(r[-1] == k for r in rows) for k in {r[-1] for r in rows}})


main()
