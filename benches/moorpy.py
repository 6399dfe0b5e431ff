#!/usr/bin/env python3
"""MoorPy 1.3.0 and windlass over the same work, in one run, on one core.

    python3 benches/moorpy.py [--passes N]

Makes target/moorpy-venv with MoorPy from PyPI, and prints a table:
- the 2,000 single lines of tests/data/catenary_2000.csv, cold: lines a second, and how many are wrong;
- a thirty-row force-distance table of the four-segment line of [MOSES-FLEX example], its buoy sunk;
- forces on a body on eight chains and their tensions at 200 offsets, the body held.
The time of a pass is MoorPy's CPU time, and wall time for windlass; the least of the passes counts, since other work on
the machine only ever adds.
"""
import argparse
import contextlib
import csv
import math
import os
import platform
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / "target" / "moorpy-venv"
PACKAGES = ["moorpy==1.3.0", "numpy==2.4.6", "scipy==1.17.1", "matplotlib==3.11.2", "PyYAML==6.0.3"]
FOOT, KIP = 0.3048, 4448.2216152605


def in_environment():
    """Starts this script again with the Python of the environment, which is made when it is not there."""
    python = VENV / "bin" / "python"
    if Path(sys.prefix) == VENV:
        return
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", VENV], check=True)
    subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *PACKAGES], check=True)
    os.execv(python, [str(python), __file__, *sys.argv[1:]])


def least(passes, work):
    """The least CPU time (s) of so many passes."""
    times = []
    for _ in range(passes):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times)


def windlass(bench):
    """What benches/rates.rs or offsets.rs prints: times as name -> (solutions, seconds), rows as (X, H)."""
    subprocess.run(["cargo", "bench", "--quiet", "--no-run", "--bench", bench], cwd=ROOT, check=True)
    command = ["cargo", "bench", "--quiet", "--bench", bench]
    out = subprocess.run(command, cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE).stdout
    times, rows = {}, []
    for name, a, b in (line.split("\t") for line in out.splitlines()):
        if name == "row":
            rows.append((float(a), float(b)))
        else:
            times[name] = (int(a), float(b))
    return times, rows


def single_lines(passes):
    """Seconds a pass over the 2,000 lines, their number, and the errors: relative to the fairlead tension, or None
    where MoorPy raises."""
    from moorpy.Catenary import catenary

    with open(ROOT / "tests" / "data" / "catenary_2000.csv", newline="") as file:
        cases = list(csv.DictReader(file))
    # without a bottom: a negative CB is the height of the lower end above it
    given = [
        (float(c["x_m"]), float(c["z_m"]), float(c["length_m"]), float(c["EA_N"]), float(c["w_N_per_m"]),
         -1e6 if c["suspended"] == "1" else float(c["friction"]))
        for c in cases
    ]

    def solve(x, z, length, ea, weight, cb):
        try:
            return catenary(x, z, length, ea, weight, CB=cb, nNodes=2)
        except Exception:
            return None

    errors = []
    for case, numbers in zip(cases, given):
        got = solve(*numbers)
        if got is None or not all(map(math.isfinite, got[:4])):
            errors.append(None)
            continue
        right = [float(case["fairlead_H_N"]), float(case["fairlead_V_N"])]
        off = math.hypot(-got[2] - right[0], -got[3] - right[1])
        tension = math.hypot(*right)
        errors.append(off / tension if tension > 0 else (0.0 if off == 0 else math.inf))
    return least(passes, lambda: [solve(*numbers) for numbers in given]), len(given), errors


def four_segments(passes, rows, tolerance):
    """Seconds MoorPy takes for the rows of the table, and the largest difference in H from windlass, relative to the H
    of the row, rows 1 to 29. The fairlead is put where windlass's row has it; the buoy, sunk in every row, is a constant
    lift; the joints start each row where the last one left them, in favour of MoorPy."""
    import moorpy

    def line_type(name, od, weight, e):
        newtons = weight * KIP / FOOT
        return dict(name=name, d_vol=0.0, m=newtons / 9.80665, w=newtons, EA=e * math.pi / 4 * od * od * KIP)

    wire, chain = line_type("wire", 4.625, 0.03751, 2900.0), line_type("chain", 4.375, 0.1582, 4350.0)
    depth = 3000.0 * FOOT
    x = rows[0][0]
    system = moorpy.System(depth=depth, rho=1025, g=9.80665)
    system.addPoint(1, [0.0, 0.0, -depth])
    system.addPoint(0, [x - 5900 * FOOT, 0.0, -depth + 1.0])
    system.addPoint(0, [x - 4300 * FOOT, 0.0, -depth + 100.0])
    system.addPoint(0, [x - 450 * FOOT, 0.0, -400.0 * FOOT], fExt=[0.0, 0.0, 100.0 * KIP])
    system.addPoint(-1, [x, 0.0, 0.0])
    for number, (kind, length) in enumerate([(wire, 2000), (chain, 2000), (wire, 4000), (wire, 500)], start=1):
        system.addLine(length * FOOT, kind, pointA=number, pointB=number + 1)
    system.initialize()
    fairlead = system.pointList[-1]
    start = [point.r.copy() for point in system.pointList]
    found = []

    def table():
        found.clear()
        for point, r in zip(system.pointList, start):
            point.setPosition(r)
        for x, _ in rows:
            fairlead.setPosition([x, 0.0, 0.0])
            system.solveEquilibrium(tol=tolerance, maxIter=1000)
            found.append(-fairlead.getForces(xyz=True)[0])

    # it prints its determinants
    with open(os.devnull, "w") as nowhere, contextlib.redirect_stdout(nowhere):
        seconds = least(passes, table)
    return seconds, max(abs(got - h) / h for got, (_, h) in list(zip(found, rows))[1:])


def eight_lines(passes, rows):
    """Seconds MoorPy takes for as many offsets as windlass has rows, and the largest difference in the restoring force, as a
    share of that of the row, past 1 m. The mooring is that of benches/offsets.rs."""
    import moorpy
    import numpy

    section = math.pi / 4 * 0.18**2
    weight = (199.0 - 1025 * section) * 9.80665
    system = moorpy.System(depth=300.0, rho=1025, g=9.80665)
    chain = dict(name="chain", d_vol=0.18, m=199.0, w=weight, EA=8.54e8)
    system.addBody(1, numpy.zeros(6))
    body = system.bodyList[0]
    for line in range(8):
        angle = math.radians(22.5 + 45 * line)
        fairlead = [30 * math.cos(angle), 30 * math.sin(angle), -10.0]
        system.addPoint(1, [830 * math.cos(angle), 830 * math.sin(angle), -300.0])
        system.addPoint(1, fairlead)
        anchor = len(system.pointList) - 1
        body.attachPoint(anchor + 1, fairlead)
        system.addLine(900.0, chain, pointA=anchor, pointB=anchor + 1)
    system.initialize()
    found = []

    def offsets():
        found.clear()
        for x, _ in rows:
            body.setPosition(numpy.array([x, 0, 0, 0, 0, 0.0]))
            for line in system.lineList:
                line.staticSolve()
            found.append(-body.getForces(lines_only=True)[0])

    seconds = least(passes, offsets)
    return seconds, max(abs(got - f) / f for got, (x, f) in zip(found, rows) if x > 1)


def cpu():
    try:
        for line in open("/proc/cpuinfo"):
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--passes", type=int, default=5, help="passes of each piece of work (MoorPy)")
    options = options.parse_args()
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        os.environ[name] = "1"
    # MoorPy calls breakpoint() where it does not know on
    os.environ["PYTHONBREAKPOINT"] = "0"
    in_environment()
    # this file is no MoorPy
    sys.path[:] = [path for path in sys.path if Path(path).resolve() != Path(__file__).resolve().parent]
    import matplotlib
    matplotlib.use("Agg")
    import moorpy
    import numpy
    from importlib.metadata import version
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    times, rows = windlass("rates")
    offset_times, offsets = windlass("offsets")
    seconds, number, errors = single_lines(options.passes)
    tables = [(tolerance, *four_segments(options.passes, rows, tolerance)) for tolerance in (0.05, 0.001)]
    held, held_off = eight_lines(options.passes, offsets)

    rust = subprocess.run(["rustc", "--version"], cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE).stdout.strip()
    commit = ["git", "describe", "--always", "--dirty"]
    commit = subprocess.run(commit, cwd=ROOT, text=True, stdout=subprocess.PIPE).stdout.strip() or "unknown"
    print(f"CPU        {cpu()}, one core")
    print(f"windlass   {commit}, {rust}")
    print(f"MoorPy     {version('moorpy')}, numpy {numpy.__version__}, Python {platform.python_version()}")
    raised = errors.count(None)
    wrong = [sum(e is None or e > limit for e in errors) for limit in (1e-6, 1e-2)]
    print(f"\nMoorPy on the {number} lines: {wrong[0]} wrong by more than 1e-6 of the fairlead tension or raised, "
          f"{wrong[1]} by more than 1e-2 or raised; {raised} raised")
    print(f"\n{'single lines':<46}{'lines/s':>12}{'ratio':>10}")
    print(f"{'MoorPy, catenary(), cold':<46}{number / seconds:>12,.0f}{1:>10}")
    for name in ("cold", "cold along the path", "followed along the path"):
        count, best = times[name]
        print(f"{'windlass, ' + name:<46}{count / best:>12,.0f}{count / best * seconds / number:>10,.0f}")
    print(f"\n{'thirty rows, four segments, buoy sunk':<46}{'ms':>12}{'ratio':>10}{'largest difference in H':>27}")
    ours = times["thirty rows, four segments, sunk buoy"][1]
    for tolerance, table, off in tables:
        name = f"MoorPy, System, tol={tolerance}"
        print(f"{name:<46}{1e3 * table:>12,.1f}{table / ours:>10,.0f}{off:>27.1e}")
    print(f"{'windlass':<46}{1e3 * ours:>12.4f}{1:>10}")
    heading = f"{len(offsets)} offsets of eight lines, held"
    print(f"\n{heading:<46}{'ms':>12}{'ratio':>10}{'largest difference in force':>31}")
    ours = offset_times["forces and tensions"][1]
    print(f"{'MoorPy, Line.staticSolve, Body.getForces':<46}{1e3 * held:>12,.1f}{held / ours:>10,.0f}{held_off:>31.1e}")
    for name, (_, seconds) in offset_times.items():
        print(f"{'windlass, ' + name:<46}{1e3 * seconds:>12.4f}{seconds / ours:>10,.1f}")


if __name__ == "__main__":
    main()
