"""MoorDyn 2.7.2 over written_spread.txt: the forces on the fairleads of L1, L2 and UP (N), with the segments of the deck and with twice as many.
Run in a Python with moordyn and numpy: `moordyn_spread.py [FACTOR]`.

The lines of the deck have no damping, and drag on their sway dies out with the square of the speed: as it is, the deck sways for minutes, and L1
by 4e-3 of its force. Here drag is 40 times as large and BA is half of critical, which a position of rest does not feel."""
import os
import pathlib
import re
import sys
import tempfile

import moordyn
import numpy as np

HERE = pathlib.Path(__file__).parent
# MoorDyn prints from C
SAID = os.fdopen(os.dup(1), "w")
os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
TYPE = re.compile(r"(?m)^((?:LEG|LEG_2|PENDANT|CHAIN)(?: +\S+){3} +)0( +\S+ +)(\S+)")
LINE = re.compile(r"(?m)^(\d+ +\S+ +\d+ +\d+ +\d+ +)(\d+)( +-)$")
# the coupled points
FAIRLEADS = {"L1": 2, "L2": 5, "UP": 8}
END, STEP = 60.0, 0.5


def run(factor):
    text = (HERE / "written_spread.txt").read_text()
    text = TYPE.sub(lambda m: f"{m[1]}-0.5{m[2]}{40 * float(m[3])}", text)
    text = LINE.sub(lambda m: f"{m[1]}{factor * int(m[2])}{m[3]}", text)
    text = re.sub(r"(?m)^(.*--- OPTIONS.*)$", rf"\1\n{2.5e-4 / factor} dtM", text)
    places = [float(x) for row in text.splitlines() if "Coupled" in row for x in row.split()[2:5]]
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "deck.txt"
        path.write_text(text)
        system = moordyn.Create(str(path))
        still = [0.0] * len(places)
        moordyn.Init(system, places, still)
        for index in range(round(END / STEP)):
            moordyn.Step(system, places, still, index * STEP, STEP)
        force = {name: np.linalg.norm(moordyn.GetPointForce(moordyn.GetPoint(system, point))) for name, point in FAIRLEADS.items()}
        moordyn.Close(system)
    print(f"{factor}:", *(f"{name} {value:.1f}" for name, value in force.items()), file=SAID, flush=True)


for factor in [int(word) for word in sys.argv[1:]] or [1, 2]:
    run(factor)
