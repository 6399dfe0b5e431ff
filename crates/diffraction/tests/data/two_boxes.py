"""Added mass, damping and excitation of two floating boxes side by side in deep water by Capytaine 3.0.0, direct method, on the mesh of
`two_boxes` in tests/it/two_boxes.rs. Each is 2 long, 1 wide and 0.5 deep, their middles at y = -1 and 1; motions and moments about the middle
of each waterplane; density 1000, gravity 9.81, no lid. Writes two_boxes.csv: what, row, column, value (its real and imaginary part)."""
import csv
import capytaine as cpt
import numpy as np

LENGTH, WIDTH, DRAUGHT, COUNTS = 2.0, 1.0, 0.5, (14, 8, 7)


def spread(i, n):
    return 0.5 * (1.0 - np.cos(np.pi * i / n))


def box(middle):
    nx, ny, nz = COUNTS
    x = lambda i: LENGTH * (spread(i, nx) - 0.5)
    y = lambda j: middle + WIDTH * (spread(j, ny) - 0.5)
    z = lambda k: -DRAUGHT * spread(k, nz)
    quads = []
    for i in range(nx):
        for k in range(nz):
            quads.append([(x(i), y(0), z(k)), (x(i), y(0), z(k + 1)), (x(i + 1), y(0), z(k + 1)), (x(i + 1), y(0), z(k))])
            quads.append([(x(i), y(ny), z(k)), (x(i + 1), y(ny), z(k)), (x(i + 1), y(ny), z(k + 1)), (x(i), y(ny), z(k + 1))])
        for j in range(ny):
            quads.append([(x(i), y(j), z(nz)), (x(i), y(j + 1), z(nz)), (x(i + 1), y(j + 1), z(nz)), (x(i + 1), y(j), z(nz))])
    for j in range(ny):
        for k in range(nz):
            quads.append([(x(0), y(j), z(k)), (x(0), y(j + 1), z(k)), (x(0), y(j + 1), z(k + 1)), (x(0), y(j), z(k + 1))])
            quads.append([(x(nx), y(j), z(k)), (x(nx), y(j), z(k + 1)), (x(nx), y(j + 1), z(k + 1)), (x(nx), y(j + 1), z(k))])
    quads = np.array(quads, float)
    return cpt.Mesh(vertices=quads.reshape(-1, 3), faces=np.arange(4 * len(quads)).reshape(-1, 4))


bodies = [
    cpt.FloatingBody(mesh=box(middle), dofs=cpt.rigid_body_dofs(rotation_center=(0, middle, 0)), name=name)
    for name, middle in [("a", -1.0), ("b", 1.0)]
]
both = bodies[0] + bodies[1]
dofs = [f"{name}__{dof}" for name in "ab" for dof in ["Surge", "Sway", "Heave", "Roll", "Pitch", "Yaw"]]
solver = cpt.BEMSolver(method="direct")
with open("two_boxes.csv", "w", newline="") as file:
    file.write("# Two floating boxes by Capytaine 3.0.0, direct method (two_boxes.py); wave number, what (A, B, X of 60 deg), row, column, real, imaginary\n")
    writer = csv.writer(file)
    writer.writerow("k,what,row,column,re,im".split(","))
    for k in [0.4, 1.2, 2.0]:
        common = {"body": both, "wavenumber": k, "water_depth": np.inf, "rho": 1000.0, "g": 9.81}
        for column, dof in enumerate(dofs):
            found = solver.solve(cpt.RadiationProblem(radiating_dof=dof, **common))
            for row, force in enumerate(dofs):
                for what, value in [("A", found.added_masses[force]), ("B", found.radiation_dampings[force])]:
                    if abs(value) > 1e-3:
                        writer.writerow([k, what, row, column, f"{value:.6g}", 0])
        found = solver.solve(cpt.DiffractionProblem(wave_direction=np.pi / 3, **common))
        for row, force in enumerate(dofs):
            # force total of Froude and Krylov and of diffraction
            value = found.forces[force] + cpt.bem.airy_waves.froude_krylov_force(found.problem)[force]
            writer.writerow([k, "X", row, 0, f"{value.real:.6g}", f"{value.imag:.6g}"])
