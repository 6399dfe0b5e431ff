"""Tensions of MoorPy 1.3.0 at the ends of the lines of the decks beside this file: moorpy.csv. Run in a Python with moorpy."""
import contextlib
import io
import os
import pathlib
import tempfile

import moorpy
import numpy as np

HERE = pathlib.Path(__file__).parent
DECKS = ["grounded_chain", "taut_polyester", "chain_polyester_clump", "bridle", "three_chains", "elevated_anchor", "version_1",
         "point_force", "free_body"]
# MoorPy reads the columns of version 2 alone, whatever the names are
VERSION_1 = {
    "1  main  835.35  20  1  2  pt": "1  main  1  2  835.35  20  pt",
    "0  0  0  0  0  0  0\n": "0  0  0  0\n",
    "main  0.0766  113.35  7.536e8  -1.0  1.0  0.25  1.6  0.1": "main  0.0766  113.35  7.536e8  -1.0  0  1.6  1.0  0.1  0.25",
}

# MoorPy reads the forces of a point as its drag area, and takes no drag areas of six values
FORCES = {"2500  12  2.5e4  -1.4e4  6.0e3  0  0": "2500  12  0  0"} | {f"{z}  0  0  0  0  0  0  0\n": f"{z}  0  0  0  0\n" for z in (-150,)}
DRAG = {"8|8|12|0|0|0": "8"}

with open(HERE / "moorpy.csv", "w") as out:
    print("deck,line,TA,TB", file=out)
    for deck in DECKS:
        text = (HERE / f"{deck}.txt").read_text()
        if deck == "version_1":
            for old, new in VERSION_1.items():
                text = text.replace(old, new)
        for old, new in {"point_force": FORCES, "free_body": DRAG}.get(deck, {}).items():
            text = text.replace(old, new)
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            path = os.path.join(folder, "deck.txt")
            pathlib.Path(path).write_text(text)
            system = moorpy.System(file=path)
            if deck == "point_force":
                system.pointList[3].fExt = np.array([2.5e4, -1.4e4, 6.0e3])
            system.initialize()
            system.solveEquilibrium(tol=1e-9)
        for line in system.lineList:
            print(f"{deck},{line.number},{line.TA!r},{line.TB!r}".replace("np.float64(", "").replace(")", ""), file=out)
