#!/usr/bin/env python3
"""The set-down of scripts/lmu.cif solved apart from windlass: python3 tests/data/lmu_stages.py > tests/data/lmu_stages.csv

Needs numpy and scipy (1.17.1 made the file). Forces by the formulas of [MOSES-FLEX LMU], no derivative of them anywhere: least squares on nine
equations of balance (deck: forces, and moments about its center of gravity; hook: forces), derivatives by differences.

A leg: T = (OD(2) - OD(1)) / (2 LEN); D_v the depth of the tip below the mouth, D_h its distance from the axis; nothing for
D_v < 0; d = max(0, D_h - T max(0, LEN - D_v)) toward the axis with K_h d; c = max(0, D_v - LEN) + T d upward with K_v c.
A rope: EA (l - L) / L, none where it is slack.
"""
import csv
import sys

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

CONES = np.array([[10, 6, 0], [-10, 6, 0], [-10, -6, 0], [10, -6, 0]], float)
PINS = CONES.copy()
EYES = CONES + [0, 0, 8]
CG, WEIGHT, HOOK_WEIGHT = np.array([0.5, -0.25, 5]), 8000.0, 50.0
TIP = np.array([0.3, 0.2, 70])
LEN, OD1, OD2, KV, KH = 1.5, 0.8, 1.6, 50000.0, 8000.0
T = (OD2 - OD1) / (2 * LEN)
EA_HOIST, EA_ROPE = (1e5 * 1e3 * np.pi / 4 * d * d for d in (0.200, 0.120))  # kN: 100,000 MPa
ROPE = 24.0
EA_TUGGER, TUGGER = 1e3 * 1e3 * np.pi / 4 * 0.040**2, 49.0  # 1,000 MPa
WINCHES = np.array([[10, 56, 8], [-10, 56, 8]], float)


def pull(a, b, length, ea):
    """Force on end a of a rope to b (kN)."""
    away = b - a
    long = np.linalg.norm(away)
    return max(0.0, ea * (long - length) / length) * away / long


def leg(tip, mouth):
    """Force on the pin (kN)."""
    deep = mouth[2] - tip[2]
    side = (tip - mouth)[:2]
    off = np.hypot(*side)
    if deep < 0:
        return np.zeros(3)
    d = max(0.0, off - T * max(0.0, LEN - deep))
    c = max(0.0, deep - LEN) + T * d
    inward = -side / off * KH * d if off > 0 else np.zeros(2)
    return np.array([*inward, KV * c])


def forces(x, hoist):
    """Places, the hook; forces of legs, ropes and tuggers on the deck, of the hoist on the hook."""
    turn = Rotation.from_rotvec(x[3:6]).as_matrix()
    at = lambda p: x[:3] + turn @ p
    hook = x[6:9]
    legs = [leg(at(p), c) for p, c in zip(PINS, CONES)]
    ropes = [pull(at(e), hook, ROPE, EA_ROPE) for e in EYES]
    tuggers = [pull(at(e), w, TUGGER, EA_TUGGER) for e, w in zip(EYES, WINCHES)]
    return at, hook, legs, ropes, tuggers, pull(hook, TIP, hoist, EA_HOIST)


def left(x, hoist):
    at, hook, legs, ropes, tuggers, lift = forces(x, hoist)
    center = at(CG)
    force = sum(legs) + sum(ropes) + sum(tuggers) - [0, 0, WEIGHT]
    moment = sum(np.cross(at(p) - center, f) for p, f in zip(PINS, legs))
    moment = moment + sum(np.cross(at(e) - center, f) for e, f in zip(EYES, ropes))
    moment = moment + sum(np.cross(at(e) - center, f) for e, f in zip(EYES, tuggers))
    knot = lift - sum(ropes) - [0, 0, HOOK_WEIGHT]
    return np.concatenate([force, moment / 10, knot])


def main():
    out = csv.writer(sys.stdout, lineterminator="\n")
    head = [f"{n}_{axis}" for n in ("L1", "L2", "L3", "L4") for axis in ("FX_kN", "FY_kN", "FZ_kN")]
    out.writerow(["hoist_m", "X_m", "Y_m", "Z_m", *head, "S1_kN", "S2_kN", "S3_kN", "S4_kN", "T1_kN", "T2_kN", "HOIST_kN"])
    numbers = np.random.default_rng(1)
    spread = np.array([0.1, 0.1, 0.05, 0.01, 0.01, 0.02, 0.1, 0.1, 0.02])
    for hoist in (41.7, 42.75, 43.2):
        # hung from the hook, or on the ground of the cones
        near = np.array([0, 0, max(40.9 - hoist, -1.53), 0, 0, 0, 0.3, 0.2, 69.995 - hoist])
        for _ in range(40):
            x = near + spread * numbers.normal(size=9)
            found = least_squares(left, x, args=(hoist,), x_scale="jac", method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=3000)
            if np.abs(found.fun).max() < 1e-7:
                break
        x = found.x
        _, _, legs, ropes, tuggers, lift = forces(x, hoist)
        print(hoist, "m: left", np.abs(found.fun).max(), "kN", file=sys.stderr)
        row = [hoist, *x[:3], *np.concatenate(legs), *map(np.linalg.norm, ropes), *map(np.linalg.norm, tuggers), np.linalg.norm(lift)]
        out.writerow([f"{v:.9g}" for v in row])


main()
