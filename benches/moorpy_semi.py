#!/usr/bin/env python3
"""MoorPy 1.3.0 over the semi of scripts/study, intact, with each line lost and with some pairs (12: L1 and L2): python3 benches/moorpy_semi.py > tests/data/moorpy_semi.csv

In an environment that has moorpy==1.3.0, as .ci/peers makes it. The body is free in surge, sway and yaw and held in heave, roll and
pitch, so that its hydrostatics take no part; a force of 5 MN acts at its origin toward each of eight headings. Chains are those of
R4 100 mm: 199 kg/m with a volumetric diameter of 180 mm, EA 854 MN; 1,200 m between an anchor at a depth of 300 m, 1,114.4 m from
its fairlead, and the fairlead at a depth of 14 m.
"""
import contextlib
import csv
import math
import os
import sys

os.environ["PYTHONBREAKPOINT"] = "0"
sys.path[:] = [path for path in sys.path if os.path.realpath(path or ".") != os.path.dirname(os.path.realpath(__file__))]
import matplotlib

matplotlib.use("Agg")
import moorpy
import numpy as np

RHO, G = 1025.0, 9.80665
SECTION = math.pi / 4 * 0.18**2
FAIRLEADS = [(45, 37), (40, 38), (-40, 38), (-45, 37), (-45, -37), (-40, -38), (40, -38), (45, -37)]
PAIRS = [(1, 2), (1, 8), (3, 6), (4, 5)]
TOWARD = [30, 60, 120, 150, 210, 240, 300, 330]
DISTANCE, LENGTH, LOAD = 1114.4, 1200.0, 5e6


def system(lost):
    made = moorpy.System(depth=300.0, rho=RHO, g=G)
    chain = dict(name="chain", d_vol=0.18, m=199.0, w=(199.0 - RHO * SECTION) * G, EA=8.54e8)
    made.addBody(0, np.zeros(6), m=0.0, v=0.0, DOFs=[0, 1, 5])
    body = made.bodyList[0]
    for line, ((x, y), angle) in enumerate(zip(FAIRLEADS, TOWARD)):
        if line + 1 in lost:
            continue
        made.addPoint(1, [x + DISTANCE * math.cos(math.radians(angle)), y + DISTANCE * math.sin(math.radians(angle)), -300.0])
        anchor = len(made.pointList)
        made.addPoint(1, [x, y, -14.0])
        fairlead = len(made.pointList)
        body.attachPoint(fairlead, [x, y, -14.0])
        made.addLine(LENGTH, chain, pointA=anchor, pointB=fairlead)
    return made, body


def main():
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(["lost", "toward_deg", "X_m", "Y_m", "yaw_rad"] + [f"L{n}_N" for n in range(1, 9)] + ["left_N"])
    for lost in [()] + [(n,) for n in range(1, 9)] + PAIRS:
        made, body = system(lost)
        with open(os.devnull, "w") as nowhere, contextlib.redirect_stdout(nowhere):
            made.initialize()
        for toward in range(0, 360, 45):
            angle = math.radians(toward)
            body.f6Ext = np.array([LOAD * math.cos(angle), LOAD * math.sin(angle), 0, 0, 0, 0])
            with open(os.devnull, "w") as nowhere, contextlib.redirect_stdout(nowhere):
                for tol in (1e-2, 1e-5, 1e-7):
                    made.solveEquilibrium(DOFtype="free", tol=tol, maxIter=2000)
            tensions = [line.TB for line in made.lineList]
            for line in lost:
                tensions.insert(line - 1, 0.0)
            forces = body.getForces(all_DOFs=True)
            left = max(abs(forces[0]), abs(forces[1]), abs(forces[5]))
            out.writerow([f"{v:.10g}" for v in [int("".join(map(str, lost)) or 0), toward, body.r6[0], body.r6[1], body.r6[5], *tensions, left]])


if __name__ == "__main__":
    main()
