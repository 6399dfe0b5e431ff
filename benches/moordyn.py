#!/usr/bin/env python3
"""MoorDyn 2.7.2 over the work of benches/rod.rs, on one core.

    python3 benches/moordyn.py [--passes N] [--forces]

Makes target/moordyn-venv with MoorDyn from PyPI the first time; without a network, put a wheel in it by hand
(target/moordyn-venv/bin/python -m pip install moordyn-2.7.2-*.whl) and it is taken as it is.
Prints rows, tab between: name, segments of a line, scheme and step (s), seconds of the sea a second of the processor.
- chain900: the chain of tests/data/moordyn_chain900.csv, its fairlead driven, 60 s;
- vessel: a rigid body of 20,000 t on eight such lines, let go 10 m off, 60 s.
With --forces then rows `force`: segments, time (s), force on the driven fairlead (N).
Steps are four fifths of the largest that are stable, to 12 %, of the schemes that came out quickest of fifteen; the quickest pass counts.
"""
import argparse
import contextlib
import math
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / "target" / "moordyn-venv"
WHEEL = "moordyn==2.7.2"
SPAN = 60.0
# longest exchange with MoorDyn (s): a whole number of its steps
EXCHANGE = 0.02
LENGTH, SPREAD, DEPTH, FAIRLEAD, GRAVITY, DENSITY = 900.0, 800.0, 300.0, -10.0, 9.80665, 1025.0
CHAINS = {20: [("rk2", 0.0064), ("midpoint10", 0.036)], 50: [("rk2", 0.0039), ("rk4", 0.0094)],
          100: [("rk2", 0.0028), ("rk4", 0.0051)]}
VESSELS = {20: [("rk2", 0.006), ("rk4", 0.01)], 50: [("rk2", 0.004), ("rk4", 0.009)]}


def in_environment():
    """Starts this script again with the Python of the environment, which is made when it is not there."""
    if Path(sys.prefix) == VENV:
        return
    python = VENV / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", VENV], check=True)
    if subprocess.run([python, "-c", "import moordyn"], stderr=subprocess.DEVNULL).returncode != 0:
        quiet = ["--quiet", "--disable-pip-version-check"]
        subprocess.run([python, "-m", "pip", "install", *quiet, WHEEL], check=True, stdout=sys.stderr)
    os.execv(python, [str(python), __file__, *sys.argv[1:]])


@contextlib.contextmanager
def silent():
    """MoorDyn prints from C."""
    sys.stdout.flush()
    kept = [os.dup(1), os.dup(2)]
    nowhere = os.open(os.devnull, os.O_WRONLY)
    for number in (1, 2):
        os.dup2(nowhere, number)
    try:
        yield
    finally:
        for number, old in zip((1, 2), kept):
            os.dup2(old, number)
            os.close(old)
        os.close(nowhere)


def deck(bodies, points, lines, segments, scheme, step, relax):
    """An input file: `points` are attachment and place, `lines` pairs of points."""
    rule = "-" * 10
    rows = ["MoorDyn", f"{rule} LINE TYPES {rule}", "TypeName Diam Mass/m EA BA EI Cd Ca CdAx CaAx", "units",
            "chain 0.18 199 8.54e8 1e6 0 1.333 1 0.639 0.5"]
    if bodies:
        rows += [f"{rule} BODIES {rule}", "ID Attachment X0 Y0 Z0 r0 p0 y0 Mass CG I Volume CdA Ca", "units", *bodies]
    rows += [f"{rule} POINTS {rule}", "ID Attachment X Y Z Mass Volume CdA Ca", "units"]
    for number, (attachment, place) in enumerate(points, start=1):
        rows.append(f"{number} {attachment} {' '.join(map(repr, place))} 0 0 0 0")
    rows += [f"{rule} LINES {rule}", "ID LineType AttachA AttachB UnstrLen NumSegs LineOutputs", "units"]
    for number, (a, b) in enumerate(lines, start=1):
        rows.append(f"{number} chain {a} {b} {LENGTH} {segments} -")
    options = {"writeLog": 0, "dtM": step, "tScheme": scheme, "cfl": 1e6, "kBot": 3e6, "cBot": 3e5, "WtrDnsty": DENSITY,
               "g": GRAVITY, "WtrDpth": DEPTH, "dtIC": 1.0, "TmaxIC": relax, "threshIC": 1e-5, "ICgenDynamic": 0,
               "FrictionCoefficient": 0.0, "disableOutTime": 1}
    rows += [f"{rule} OPTIONS {rule}", *(f"{value} {name}" for name, value in options.items()), rule]
    return "\n".join(rows) + "\n"


def begun(text, start):
    import moordyn

    with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
        file.write(text)
        file.flush()
        system = moordyn.Create(file.name)
        moordyn.Init(system, start, [0.0] * len(start))
    return system


def surge(t):
    """Of the fairlead: 5 m, 10 s, brought up over 20 s."""
    up = 0.5 * (1.0 - math.cos(math.pi * t / 20.0)) if t < 20.0 else 1.0
    return 5.0 * up * math.sin(2.0 * math.pi * t / 10.0)


def chain(segments, scheme, step):
    """Seconds of the processor, and the fairlead force at times."""
    import moordyn

    points = [("Fixed", (-SPREAD, 0.0, -DEPTH)), ("Coupled", (0.0, 0.0, FAIRLEAD))]
    system = begun(deck([], points, [(1, 2)], segments, scheme, step, 100), [0.0, 0.0, FAIRLEAD])
    exchange = max(1, int(EXCHANGE / step + 1e-9)) * step
    forces, x = [], surge(0.0)
    start = time.process_time()
    for number in range(int(SPAN / exchange)):
        t = number * exchange
        to = surge(t + exchange)
        force = moordyn.Step(system, [x, 0.0, FAIRLEAD], [(to - x) / exchange, 0.0, 0.0], t, exchange)
        x = to
        # the force is that of the end of the exchange
        forces.append((t + exchange, math.hypot(force[0], force[2])))
    spent = time.process_time() - start
    moordyn.Close(system)
    return spent, forces


def vessel(segments, scheme, step):
    """Seconds of the processor."""
    import moordyn

    mass = 2e7
    # it floats with its lines, each of which pulls it down by as much as the static chain
    volume = (mass + 8 * 0.992693e6 / GRAVITY) / DENSITY
    points, lines = [], []
    for number in range(8):
        angle = math.radians(22.5 + 45.0 * number)
        at = (math.cos(angle), math.sin(angle))
        points.append(("Fixed", (830.0 * at[0], 830.0 * at[1], -DEPTH)))
        points.append(("Body1", (30.0 * at[0], 30.0 * at[1], FAIRLEAD)))
        lines.append((2 * number + 1, 2 * number + 2))
    body = f"1 Free 10 0 0 0 0 0 {mass} 0 1e10 {volume} 500 0.5"
    system = begun(deck([body], points, lines, segments, scheme, step, 0), [])
    exchange = max(1, int(EXCHANGE / step + 1e-9)) * step
    start = time.process_time()
    for number in range(int(SPAN / exchange)):
        moordyn.Step(system, [], [], number * exchange, exchange)
    spent = time.process_time() - start
    place = moordyn.GetBodyState(moordyn.GetBody(system, 1))[0]
    moordyn.Close(system)
    # a run that has blown up is no measure
    return (spent, None) if all(map(math.isfinite, place)) and abs(place[0]) < 20.0 else (math.inf, None)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--passes", type=int, default=5, help="passes of each piece of work")
    options.add_argument("--forces", action="store_true", help="prints the forces on the driven fairlead")
    options = options.parse_args()
    in_environment()
    # this file is no MoorDyn
    sys.path[:] = [path for path in sys.path if Path(path or ".").resolve() != Path(__file__).resolve().parent]
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    told = []
    for name, work, cases in (("chain900", chain, CHAINS), ("vessel", vessel, VESSELS)):
        for segments, schemes in cases.items():
            best = None
            for scheme, step in schemes:
                for _ in range(options.passes):
                    with silent():
                        spent, forces = work(segments, scheme, step)
                    if best is None or spent < best[0]:
                        best = (spent, f"{scheme} {step}", forces)
            print(name, segments, best[1], f"{SPAN / best[0]:.1f}", sep="\t", flush=True)
            told += [(segments, t, force) for t, force in best[2] or []]
    for row in told if options.forces else []:
        print("force", *row, sep="\t")


if __name__ == "__main__":
    main()
