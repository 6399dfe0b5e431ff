"""The hemisphere of wamit.1, .3 and .hst as a text database of AQWA in tonnes: python ah1.py

The layout is that of the readers BEMIO (readAQWA) and BEMRosetta (aqwa.cpp). WAMIT is dimensionless by rho, g and one metre and leads; AQWA lags.
"""
import math
from collections import defaultdict

rho, g = 1.025, 9.80665
one, three, hst = (
    [[float(v) for v in line.split()] for line in open(f"wamit.{end}")] for end in ("1", "3", "hst")
)
periods = sorted({r[0] for r in three}, reverse=True)
headings = sorted({r[1] for r in three})
omega = [2 * math.pi / t for t in periods]
added, damping, force = defaultdict(float), defaultdict(float), {}
for row in one:
    if row[0] > 0:
        key = (row[0], int(row[1]), int(row[2]))
        added[key] = rho * row[3]
        damping[key] = rho * row[4] * 2 * math.pi / row[0]
for row in three:
    force[row[0], row[1], int(row[2])] = (rho * g * row[3], -row[4])
stiff = {(int(i), int(j)): rho * g * v for i, j, v in hst}


def six(values):
    return "".join(f" {v: .6E}" for v in values)


with open("hemisphere.AH1", "w") as out:
    out.write("* a hemisphere of 10 m in tonnes, metres and seconds\n* Nstr Ndir Nfreq\n")
    rows = [headings[i:i + 6] for i in range(0, len(headings), 6)]
    out.write(f"{1:6d}{len(headings):6d}{len(omega):6d}" + "\n".join("".join(f"{h:10.3f}" for h in r) for r in rows) + "\n")
    for i in range(0, len(omega), 6):
        out.write("".join(f"{w:12.7f}" for w in omega[i:i + 6]) + "\n")
    out.write(f" GENERAL\n{1000.0:10.3f}{rho:10.5f}{g:10.5f}  0\n DRAFT\n    1    10.000\n COG\n    1     0.000     0.000     0.000\n")
    mass = rho * 2 / 3 * math.pi * 1000
    out.write(" MASS\n")
    for i in range(6):
        out.write(("    1" if i == 0 else "     ") + six([mass * (25.0 if i > 2 else 1.0) * (i == j) for j in range(6)]) + "\n")
    out.write(" HYDSTIFFNESS\n")
    for i in range(1, 7):
        out.write(("    1" if i == 1 else "     ") + six([stiff.get((i, j), 0.0) for j in range(1, 7)]) + "\n")
    for name, table in (("ADDEDMASS", added), ("DAMPING", damping)):
        out.write(f" {name}\n")
        for k, period in enumerate(periods, 1):
            for i in range(1, 7):
                head = f"    1    1{k:5d}" if i == 1 else " " * 15
                out.write(head + six([table[period, i, j] for j in range(1, 7)]) + "\n")
    out.write(" FIDD\n    1" + six([0.0] * 6) + "\n FORCERAO\n")
    for h, heading in enumerate(headings, 1):
        for k, period in enumerate(periods, 1):
            pairs = [force[period, heading, i] for i in range(1, 7)]
            out.write(f"    1{h:5d}{k:5d}" + six([p[0] for p in pairs]) + "\n")
            out.write(" " * 15 + "".join(f"{p[1]:14.3f}" for p in pairs) + "\n")
