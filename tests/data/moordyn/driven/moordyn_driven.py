"""MoorDyn 2.7.2 over the decks beside this file: moordyn_driven.csv, the largest and the least of what the last periods of a run have, with 20 and
with 40 segments a line. Run in a Python with moordyn and numpy; `moordyn_driven.py DECK ...` runs these alone and prints.

The fairlead moves by a sine in x and z with a period of 10 s, or stands in waves. Forces are those on the fairlead's point; places are those of the
free point, the body (with its pitch) and end A of the rod. The step of the coupling is 0.01 s: MoorDyn goes straight on within it."""
import os
import pathlib
import re
import shutil
import sys
import tempfile

import moordyn
import numpy as np

HERE = pathlib.Path(__file__).parent
PERIOD, STEP = 10.0, 0.01
# MoorDyn prints from C
SAID = os.fdopen(os.dup(1), "w")
os.dup2(os.open(os.devnull, os.O_WRONLY), 1)


def clump(system, rows):
    # the free point
    number = next(int(row[0]) for row in rows if row[1:2] == ["Free"])
    _, _, z = moordyn.GetPointPos(moordyn.GetPoint(system, number))
    return {"z": z}


def body(system, _):
    x, _, _, _, pitch, _ = moordyn.GetBodyState(moordyn.GetBody(system, 1))[0]
    return {"x": x, "pitch": np.degrees(pitch)}


def buoys(system, rows):
    number = next(int(row[0]) for row in rows if row[1:2] == ["Free"] and len(row) == 9)
    px, _, pz = moordyn.GetPointPos(moordyn.GetPoint(system, number))
    bx, _, bz, _, pitch, _ = moordyn.GetBodyState(moordyn.GetBody(system, 1))[0]
    return {"x": px, "z": pz, "body x": bx, "body z": bz, "body pitch": np.degrees(pitch)}


def rod(system, _):
    x, _, z = moordyn.GetRodNodePos(moordyn.GetRod(system, 1), 0)
    return {"x": x, "z": z}


def tension(system, _):
    # in the middle of the last segment
    return {"FairTen": moordyn.GetLineFairTen(moordyn.GetLine(system, 1))}


def nothing(*_):
    return {}


# amplitudes of the fairlead in x and z (m), end of the run and beginning of what counts (s), the steps of MoorDyn with 20 and 40 segments (s)
DECKS = {
    "clump": ((1.5, 1.0), 120, 90, (1e-3, 5e-4), clump),
    "body": ((1.5, 1.0), 120, 90, (1e-3, 5e-4), body),
    "body_like": ((1.5, 1.0), 120, 90, (1e-3, 5e-4), body),
    "slope_like": ((1.0, 0.5), 120, 90, (1e-3,), tension),
    "rod": ((1.0, 0.8), 120, 90, (5e-4, 5e-4), rod),
    "current": ((0.8, 0.5), 120, 90, (1e-3, 5e-4), nothing),
    "waves": ((0.0, 0.0), 160, 120, (1e-3, 5e-4), nothing),
    "buoys_like": ((0.0, 0.0), 160, 120, (1e-3, 5e-4), buoys),
    "elevation": ((0.0, 0.0), 160, 120, (1e-3, 5e-4), nothing),
}


def run(name, segments, step):
    """The largest and the least of each quantity."""
    (ax, az), end, begin, _, places = DECKS[name]
    text = (HERE / f"{name}.txt").read_text()
    text = re.sub(r"(?m)^(\d+(?: +\S+){4}) +20 +-$", rf"\1 {segments} -", text)
    # a deck that windlass wrote has no step
    text = re.sub(r"(?m)^\S+ +dtM\n", "", text)
    text = re.sub(r"(?m)^(.*--- OPTIONS.*)$", rf"\1\n{step} dtM", text)
    rows = [row.split() for row in text.splitlines()]
    with tempfile.TemporaryDirectory() as folder:
        for path in HERE.glob("*.txt"):
            shutil.copy(path, folder)
        # a seafloor file is looked for where the program runs
        os.chdir(folder)
        path = pathlib.Path(folder) / "deck.txt"
        path.write_text(text)
        system = moordyn.Create(str(path))
        fairlead = next(row for row in rows if row[1:2] == ["Coupled"])
        start = np.array([float(x) for x in fairlead[2:5]])
        amplitude, frequency = np.array([ax, 0.0, az]), 2 * np.pi / PERIOD
        moordyn.Init(system, list(start), [0.0] * 3)
        point = moordyn.GetPoint(system, int(fairlead[0]))
        found = {}
        for index in range(round(end / STEP)):
            time = index * STEP
            place = start + amplitude * np.sin(frequency * time)
            moordyn.Step(system, list(place), list(amplitude * frequency * np.cos(frequency * time)), time, STEP)
            if time >= begin:
                now = {"force": np.linalg.norm(moordyn.GetPointForce(point))} | places(system, rows)
                for quantity, value in now.items():
                    found.setdefault(quantity, []).append(value)
        moordyn.Close(system)
    return {quantity: (max(values), min(values)) for quantity, values in found.items()}


chosen = sys.argv[1:] or list(DECKS)
rows = ["deck,segments,quantity,largest,least"]
for name in chosen:
    # friction is of a node: a line with it has the segments of its deck
    for segments, step in zip((20, 40) if len(DECKS[name][3]) == 2 else (66,), DECKS[name][3]):
        rows += [f"{name},{segments},{quantity},{largest:.6g},{least:.6g}" for quantity, (largest, least) in run(name, segments, step).items()]
if sys.argv[1:]:
    print("\n".join(rows), file=SAID, flush=True)
else:
    (HERE / "moordyn_driven.csv").write_text("\n".join(rows) + "\n")
