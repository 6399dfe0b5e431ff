"""Added mass, damping and excitation of two barges in deep water by Capytaine 3.0.0, direct method, on the panels that
`BLOCK HULL -20 -6 -4 20 6 4` of each has with -PANEL 2. The second lies 5 m ahead and 20 m to the left of the first and is turned by 20 degrees.
Motions and moments about the middle of each waterplane, all along the axes of the first; water of 1025 kg/m3, gravity 9.80665, no lid.
Writes capytaine.csv: frequency, what, row, column (heading in degrees for X), real and imaginary part."""
import csv
import capytaine as cpt
import numpy as np

L, B, T, SIZE = 40.0, 12.0, 4.0, 2.0
NX, NY, NZ = int(L / SIZE), int(B / SIZE), int(T / SIZE)


def barge(x0, y0, turn):
    x = lambda i: -L / 2 + SIZE * i
    y = lambda j: -B / 2 + SIZE * j
    z = lambda k: -SIZE * k
    quads = []
    for i in range(NX):
        for k in range(NZ):
            quads.append([(x(i), y(0), z(k)), (x(i), y(0), z(k + 1)), (x(i + 1), y(0), z(k + 1)), (x(i + 1), y(0), z(k))])
            quads.append([(x(i), y(NY), z(k)), (x(i + 1), y(NY), z(k)), (x(i + 1), y(NY), z(k + 1)), (x(i), y(NY), z(k + 1))])
        for j in range(NY):
            quads.append([(x(i), y(j), z(NZ)), (x(i), y(j + 1), z(NZ)), (x(i + 1), y(j + 1), z(NZ)), (x(i + 1), y(j), z(NZ))])
    for j in range(NY):
        for k in range(NZ):
            quads.append([(x(0), y(j), z(k)), (x(0), y(j + 1), z(k)), (x(0), y(j + 1), z(k + 1)), (x(0), y(j), z(k + 1))])
            quads.append([(x(NX), y(j), z(k)), (x(NX), y(j), z(k + 1)), (x(NX), y(j + 1), z(k + 1)), (x(NX), y(j + 1), z(k))])
    quads = np.array(quads, float).reshape(-1, 3)
    c, s = np.cos(turn), np.sin(turn)
    turned = np.column_stack([x0 + c * quads[:, 0] - s * quads[:, 1], y0 + s * quads[:, 0] + c * quads[:, 1], quads[:, 2]])
    return cpt.Mesh(vertices=turned, faces=np.arange(len(quads)).reshape(-1, 4))


bodies = [
    cpt.FloatingBody(mesh=barge(x, y, turn), dofs=cpt.rigid_body_dofs(rotation_center=(x, y, 0)), name=name)
    for name, x, y, turn in [("a", 0.0, 0.0, 0.0), ("b", 5.0, 20.0, np.radians(20.0))]
]
both = bodies[0] + bodies[1]
dofs = [f"{name}__{dof}" for name in "ab" for dof in ["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"]]
solver = cpt.BEMSolver(method="direct")
with open("capytaine.csv", "w", newline="") as file:
    writer = csv.writer(file)
    writer.writerow("omega,what,row,column,re,im".split(","))
    for omega in [0.5, 0.65, 0.8]:
        common = {"body": both, "omega": omega, "water_depth": np.inf, "rho": 1025.0, "g": 9.80665}
        for column, dof in enumerate(dofs):
            found = solver.solve(cpt.RadiationProblem(radiating_dof=dof, **common))
            for row, force in enumerate(dofs):
                writer.writerow([omega, "A", row, column, f"{found.added_masses[force]:.6g}", 0])
                writer.writerow([omega, "B", row, column, f"{found.radiation_dampings[force]:.6g}", 0])
        for heading in [0, 60]:
            found = solver.solve(cpt.DiffractionProblem(wave_direction=np.radians(heading), **common))
            steady = cpt.bem.airy_waves.froude_krylov_force(found.problem)
            for row, force in enumerate(dofs):
                value = found.forces[force] + steady[force]
                writer.writerow([omega, "X", row, heading, f"{value.real:.6g}", f"{value.imag:.6g}"])
