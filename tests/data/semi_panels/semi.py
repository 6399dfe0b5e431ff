#!/usr/bin/env python3
"""A semi of two pontoons and four columns by Capytaine 3.0.0, direct method, deep water: python semi.py writes semi.csv and semi.obj.

semi.csv: period (s), direction (1 surge, 3 heave, 5 pitch about the middle at the surface), added mass (t, t m2), and the amplitude of the
exciting force in a wave of 1 m toward 0 and 45 degrees (kN, kN m). semi.obj is the same mesh of 552 panels below the surface, closed by one row
of panels up to 4 m above it. Pontoons of 80 x 12 x 7 m, columns of 12 x 12 m, draught 20 m; 1.025 t/m3, 9.80665 m/s2.
"""
import numpy as np
import capytaine as cpt

SIZE = 4.0


def divided(edges):
    made = [edges[0]]
    for a, b in zip(edges, edges[1:]):
        number = max(1, round((b - a) / SIZE))
        made += [a + (b - a) * k / number for k in range(1, number + 1)]
    return made


def face(axis, at, first, second, outward, is_left_out=lambda x, y: False):
    """Panels of a rectangle across an axis; their corners run anticlockwise as seen from the water."""
    others = [i for i in range(3) if i != axis]
    panels = []
    for a, b in zip(first, first[1:]):
        for c, d in zip(second, second[1:]):
            if is_left_out((a + b) / 2, (c + d) / 2):
                continue
            corners = []
            for s, t in ((a, c), (b, c), (b, d), (a, d)):
                corner = [0.0, 0.0, 0.0]
                corner[axis], corner[others[0]], corner[others[1]] = at, s, t
                corners.append(corner)
            normal = np.cross(np.subtract(corners[1], corners[0]), np.subtract(corners[3], corners[0]))
            panels.append(corners if normal[axis] * outward > 0 else corners[::-1])
    return panels


def column_sides(x, y, z):
    return (face(1, y[0], x, z, -1) + face(1, y[-1], x, z, 1) + face(0, x[0], y, z, -1) + face(0, x[-1], y, z, 1))


wet, above = [], []
for y0, y1 in ((20, 32), (-32, -20)):
    along, across, up = divided([-40, -38, -26, 26, 38, 40]), divided([y0, y1]), divided([-20, -13])
    wet += face(2, -20, along, across, -1) + face(2, -13, along, across, 1, lambda x, y: 26 < abs(x) < 38)
    wet += column_sides(along, across, up)
    for x0, x1 in ((-38, -26), (26, 38)):
        x = divided([x0, x1])
        wet += column_sides(x, across, divided([-13, 0]))
        above += column_sides(x, across, [0, 4]) + face(2, 4, x, across, 1)

corners, faces = {}, []
for panel in wet + above:
    faces.append([corners.setdefault(tuple(corner), len(corners) + 1) for corner in panel])
with open("semi.obj", "w") as file:
    file.writelines("v %g %g %g\n" % corner for corner in corners)
    file.writelines("f %d %d %d %d\n" % tuple(number) for number in faces)

vertices = np.array(wet).reshape(-1, 3)
mesh = cpt.Mesh(vertices=vertices, faces=np.arange(len(vertices)).reshape(-1, 4))
body = cpt.FloatingBody(mesh=mesh, dofs=cpt.rigid_body_dofs(rotation_center=(0, 0, 0)))
solver = cpt.BEMSolver(method="direct")
with open("semi.csv", "w") as file:
    file.write("period,direction,added_mass,force_0,force_45\n")
    for period in (8, 10, 12, 15, 20):
        common = dict(body=body, omega=2 * np.pi / period, rho=1025.0, g=9.80665)
        problems = [cpt.RadiationProblem(radiating_dof=dof, **common) for dof in body.dofs]
        problems += [cpt.DiffractionProblem(wave_direction=toward, **common) for toward in (0.0, np.pi / 4)]
        found = cpt.assemble_dataset(solver.solve_all(problems, progress_bar=False), hydrostatics=False)
        added = found.added_mass.values.squeeze()
        force = (found.diffraction_force + found.Froude_Krylov_force).values.squeeze()
        for k in (0, 2, 4):
            numbers = (added[k, k], abs(force[0][k]), abs(force[1][k]))
            file.write(f"{period},{k + 1}," + ",".join("%.7g" % (number / 1000) for number in numbers) + "\n")
