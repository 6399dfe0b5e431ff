"""Tensions of MoorPy 1.3.0 at the ends of the lines of written_spread.txt, which windlass wrote of written_spread.cif: moorpy_written.csv. Run in a
Python with moorpy."""
import contextlib
import io
import pathlib

import moorpy

HERE = pathlib.Path(__file__).parent
with contextlib.redirect_stdout(io.StringIO()):
    system = moorpy.System(file=str(HERE / "written_spread.txt"), rho=1025, g=9.80665, depth=120)
    system.initialize()
    system.solveEquilibrium(tol=1e-9)
with open(HERE / "moorpy_written.csv", "w") as out:
    print("deck,line,TA,TB", file=out)
    for line in system.lineList:
        print(f"written_spread,{line.number},{float(line.TA)!r},{float(line.TB)!r}", file=out)
