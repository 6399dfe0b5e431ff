"""Exciting forces on a barge without any plane of symmetry in deep water, at headings of 40 and 137 degrees, by Capytaine 3.0.0: direct method, four
points a panel, no lid. The barge is a box 40 m long, 12 m wide and 4 m deep in panels of 2 m, sheared by half a metre for each metre to the side and tapered by
1 % for each metre ahead; motions and moments about the middle of its waterplane; water of 1025 kg/m3, gravity 9.80665.
Writes skew_barge.csv: frequency (rad/s), heading (degrees), direction, real and imaginary part of the force in a wave of 1 m."""
import csv

import capytaine as cpt
import numpy as np

NX, NY, NZ = 20, 6, 2


def corner(i, j, k):
    along, across = -20.0 + 2.0 * i, -6.0 + 2.0 * j
    return along + 0.5 * across, across * (1.0 - 0.01 * along), -2.0 * k


quads = []
for i in range(NX):
    for k in range(NZ):
        quads.append([(i, 0, k), (i, 0, k + 1), (i + 1, 0, k + 1), (i + 1, 0, k)])
        quads.append([(i, NY, k), (i + 1, NY, k), (i + 1, NY, k + 1), (i, NY, k + 1)])
    for j in range(NY):
        quads.append([(i, j, NZ), (i, j + 1, NZ), (i + 1, j + 1, NZ), (i + 1, j, NZ)])
for j in range(NY):
    for k in range(NZ):
        quads.append([(0, j, k), (0, j + 1, k), (0, j + 1, k + 1), (0, j, k + 1)])
        quads.append([(NX, j, k), (NX, j, k + 1), (NX, j + 1, k + 1), (NX, j + 1, k)])
points = np.array([corner(*place) for quad in quads for place in quad])
mesh = cpt.Mesh(vertices=points, faces=np.arange(len(points)).reshape(-1, 4)).with_quadrature("Gauss-Legendre 2")
body = cpt.FloatingBody(mesh=mesh, dofs=cpt.rigid_body_dofs(rotation_center=(0, 0, 0)), name="skew")
solver = cpt.BEMSolver(method="direct")
with open("skew_barge.csv", "w", newline="") as file:
    writer = csv.writer(file)
    writer.writerow("omega,heading,direction,re,im".split(","))
    for omega in [0.5, 0.8, 1.1]:
        for heading in [40, 137]:
            problem = cpt.DiffractionProblem(
                body=body, omega=omega, wave_direction=np.radians(heading), water_depth=np.inf, rho=1025.0, g=9.80665
            )
            found = solver.solve(problem)
            steady = cpt.bem.airy_waves.froude_krylov_force(problem)
            for direction, name in enumerate(["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"]):
                value = found.forces[name] + steady[name]
                writer.writerow([omega, heading, direction, f"{value.real:.6g}", f"{value.imag:.6g}"])
