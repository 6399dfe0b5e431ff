"""The same barges by the same panels (make.py) at 1.4 rad/s, beyond the resonance of the gap: Capytaine 3.0.0, direct method, four points a
panel, with its default table of the Green function and with that of HAMS. One point a panel moves couplings of forces and moments by up to 0.8 % of their peak,
the Green functions by up to 1.2 %. Writes beyond_gap.csv: what, row, column, value by the table, value by HAMS."""
import csv
from pathlib import Path

import capytaine as cpt
import numpy as np

setup = (Path(__file__).parent / "make.py").read_text().split("solver = ")[0]
exec(setup.replace("mesh=barge(x, y, turn)", 'mesh=barge(x, y, turn).with_quadrature("Gauss-Legendre 2")'))
solvers = [cpt.BEMSolver(method="direct"), cpt.BEMSolver(green_function=cpt.HAMS_GF(), method="direct")]
with open("beyond_gap.csv", "w", newline="") as file:
    writer = csv.writer(file)
    writer.writerow("what,row,column,table,hams".split(","))
    for column, dof in enumerate(dofs):
        problem = cpt.RadiationProblem(
            body=both, radiating_dof=dof, omega=1.4, water_depth=np.inf, rho=1025.0, g=9.80665
        )
        found = [solver.solve(problem) for solver in solvers]
        for row, force in enumerate(dofs):
            writer.writerow(["A", row, column] + [f"{one.added_masses[force]:.6g}" for one in found])
            writer.writerow(["B", row, column] + [f"{one.radiation_dampings[force]:.6g}" for one in found])
