#!/usr/bin/env python3
"""MoorPy 1.3.0 over a free body on eight chains: python3 benches/moorpy_equilibrium.py > tests/data/moorpy_equilibrium.csv

In an environment that has moorpy==1.3.0, as benches/moorpy.py makes it (target/moorpy-venv/bin/python). The mooring is that of
benches/equilibrium.rs: chains of 900 m in 300 m of water, of one segment or of two of 450 m with a clump of 100 kN between. The body
is a box of 60 by 60 by 18 m whose origin is in its waterplane: mass, waterplane area and metacentric height are given to MoorPy
as numbers, its hydrostatics are linear in them. Surge loads act at the origin of the body.
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
WEIGHT, SIDE, DRAFT, CG = 2e8, 60.0, 8.0, -2.0
SECTION = math.pi / 4 * 0.18**2
LOADS = [0.0, 1e6, 2e6, 3e6, 4e6]


def system(clump):
    made = moorpy.System(depth=300.0, rho=RHO, g=G)
    chain = dict(name="chain", d_vol=0.18, m=199.0, w=(199.0 - RHO * SECTION) * G, EA=8.54e8)
    area = SIDE * SIDE
    volume = area * DRAFT
    # rM: the metacentre, KB + BM above the keel; MoorPy's buoyancy of a body is constant but for AWP * heave
    metacentre = -DRAFT / 2 + area * SIDE**2 / 12 / volume
    made.addBody(0, np.zeros(6), m=WEIGHT / G, v=volume, rCG=np.array([0, 0, CG]), AWP=area, rM=np.array([0, 0, metacentre]))
    body = made.bodyList[0]
    for line in range(8):
        angle = math.radians(22.5 + 45 * line)
        out = lambda r, z: [r * math.cos(angle), r * math.sin(angle), z]
        made.addPoint(1, out(830.0, -300.0))
        anchor = len(made.pointList)
        made.addPoint(1, out(30.0, -10.0))
        fairlead = len(made.pointList)
        body.attachPoint(fairlead, out(30.0, -10.0))
        if clump:
            made.addPoint(0, out(440.0, -250.0), m=1e5 / G)
            knot = len(made.pointList)
            # MoorPy lets the bottom begin to carry a point 2 m above it: with that a clump near the bottom weighs less, and the tension
            # above it is up to 0.9 per cent off that of the catenary
            made.pointList[-1].zTol = 0.001
            made.addLine(450.0, chain, pointA=anchor, pointB=knot)
            made.addLine(450.0, chain, pointA=knot, pointB=fairlead)
        else:
            made.addLine(900.0, chain, pointA=anchor, pointB=fairlead)
    return made, body


def main():
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(["clump_N", "load_N", "X_m", "Z_m", "pitch_rad"] + [f"L{n}_N" for n in range(8)] + ["left_N", "lowest_m"])
    for clump in (0.0, 1e5):
        made, body = system(clump)
        with open(os.devnull, "w") as nowhere, contextlib.redirect_stdout(nowhere):
            made.initialize()
        for load in LOADS:
            body.f6Ext = np.array([load, 0, 0, 0, 0, 0])
            with open(os.devnull, "w") as nowhere, contextlib.redirect_stdout(nowhere):
                for tol in (1e-2, 1e-5, 1e-7):
                    made.solveEquilibrium(DOFtype="free", tol=tol, maxIter=2000)
            fairleads = [p for p in made.pointList if p.number in body.attachedP]
            tensions = []
            for point in fairleads:
                line = made.lineList[point.attached[0] - 1]
                tensions.append(line.TB)
            knots = [p for p in made.pointList if p.type == 0]
            left = max(np.abs(forces[:3]).max() for forces in [body.getForces(), *(p.getForces(xyz=True) for p in knots)])
            lowest = min((p.r[2] for p in knots), default=0.0)
            out.writerow([f"{v:.10g}" for v in [clump, load, body.r6[0], body.r6[2], body.r6[4], *tensions, left, lowest]])


main()
