"""Tensions of MoorPy 1.3.0 at the ends of the lines of the MAP++ files beside this file: moorpy_map.csv. MoorPy reads no files of MAP++: the
systems are made by hand, with the copies of REPEAT turned clockwise as in MAP++'s source (mapinit.c, expand_node_position_z).
Run in a Python with moorpy and numpy."""
import contextlib
import io
import pathlib

import moorpy
import numpy as np
from moorpy.Catenary import catenary

HERE = pathlib.Path(__file__).parent
RHO, GRAVITY = 1025.0, 9.80665
FRICTION = {"map_spread": 0.8}


def kind(name, diameter, mass, stiffness):
    weight = (mass - np.pi / 4 * diameter**2 * RHO) * GRAVITY
    return {"name": name, "d_vol": diameter, "d_nom": diameter, "m": mass, "w": weight, "EA": stiffness, "EAd": 0.0, "EAd_Lm": 0.0,
            "BA": 0.0, "BAd": 0.0, "EI": 0.0, "Cd": 0.0, "Ca": 0.0, "CdAx": 0.0, "CaAx": 0.0, "material": name, "cost": 0.0, "MBL": 0.0}


def spread():
    system = moorpy.System(depth=200, rho=RHO, g=GRAVITY)
    chain = kind("chain", 0.144, 126.0, 5.83e8)
    for angle in np.radians([0, 100, 235]):
        turn = np.array([[np.cos(angle), np.sin(angle), 0], [-np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        for place in ([760, 180, -200], [30, 4, -12]):
            system.addPoint(1, turn @ np.array(place, float))
        count = len(system.pointList)
        system.addLine(830, chain, pointA=count - 1, pointB=count)
    return system


def bridle():
    system = moorpy.System(depth=150, rho=RHO, g=GRAVITY)
    wire, rope = kind("wire", 0.09, 36.0, 4.1e8), kind("rope", 0.18, 24.6, 3.2e7)
    system.addPoint(1, [420, 0, -150])
    system.addPoint(0, [110, 2, -62], m=4200, v=1.5, fExt=np.array([1.4e4, -3.0e3, 8.0e3]))
    system.addPoint(1, [20, 18, -12])
    system.addPoint(1, [20, -18, -12])
    system.addPoint(0, [30, 60, -50], m=9000)
    system.addPoint(1, [-10, 90, -14])
    for length, line, a, b in ((375, wire, 1, 2), (102, rope, 2, 3), (102, rope, 2, 4), (85, rope, 5, 3), (70, rope, 5, 6)):
        system.addLine(length, line, pointA=a, pointB=b)
    return system


with open(HERE / "moorpy_map.csv", "w") as out:
    print("deck,line,TA,TB,HA", file=out)
    for deck, system in (("map_spread", spread()), ("map_bridle", bridle())):
        with contextlib.redirect_stdout(io.StringIO()):
            system.initialize()
            system.solveEquilibrium(tol=1e-9)
        for line in system.lineList:
            tensions, anchor = (line.TA, line.TB), np.hypot(*line.fA[:2])
            if deck in FRICTION:
                # systems of MoorPy leave friction out; its catenary has it
                span = line.rB - line.rA
                kind = line.type
                ax, az, bx, bz, _ = catenary(np.hypot(span[0], span[1]), span[2], line.L, kind["EA"], kind["w"], CB=FRICTION[deck])
                tensions, anchor = (np.hypot(ax, az), np.hypot(bx, bz)), abs(ax)
            print(f"{deck},{line.number},{float(tensions[0])!r},{float(tensions[1])!r},{float(anchor)!r}", file=out)
