"""Writes capytaine.csv and capytaine_fine.csv: added mass, damping and exciting forces of a barge of 90 x 30 m at a draught of 3.7 m in 100 m of water, by
Capytaine 3.0.0, direct method, with a lid on the inner waterplane: on panels of one size of 1.5 m, and on panels that shrink toward edges and waterline
(those of one size leave roll damping 6 % short). About the middle of the waterplane, which is the reference of phases;
exp(-i w t). SI.

    pip install capytaine==3.0.0; python make.py > capytaine.csv; python make.py fine > capytaine_fine.csv
"""

import sys

import capytaine as cpt
import numpy as np

RHO, G = 1025.0, 9.80665


def cosines(low, high, count):
    return low + (high - low) * (1 - np.cos(np.pi * np.arange(count + 1) / count)) / 2


def fine_mesh():
    x, y, z = cosines(-45, 45, 64), cosines(-15, 15, 32), cosines(-3.7, 0, 8)
    faces = [
        ((x, y[::-1]), lambda a, b: (a, b, -3.7)),
        ((x, z), lambda a, b: (a, -15, b)),
        ((x[::-1], z), lambda a, b: (a, 15, b)),
        ((y, z), lambda a, b: (45, a, b)),
        ((y[::-1], z), lambda a, b: (-45, a, b)),
    ]
    quads = []
    for (first, second), place in faces:
        for i in range(len(first) - 1):
            for j in range(len(second) - 1):
                corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                quads.append([place(first[m], second[n]) for m, n in corners])
    quads = np.array(quads)
    made = cpt.Mesh(vertices=quads.reshape(-1, 3), faces=np.arange(4 * len(quads)).reshape(-1, 4))
    volumes = (made.faces_normals * made.faces_centers * made.faces_areas[:, None]).sum(axis=0)
    assert np.allclose(volumes, 90 * 30 * 3.7), volumes
    return made


def even_mesh():
    return cpt.mesh_parallelepiped(size=(90, 30, 7.4), resolution=(60, 20, 6), center=(0, 0, 0)).immersed_part()


mesh = fine_mesh() if sys.argv[1:] == ["fine"] else even_mesh()
lid = mesh.generate_lid(z=-0.2)
body = cpt.FloatingBody(mesh=mesh, lid_mesh=lid, dofs=cpt.rigid_body_dofs(rotation_center=(0, 0, 0)))
solver = cpt.BEMSolver(method="direct")
names = list(body.dofs)
print("period,kind,row,column,real,imaginary")
for period in (6.0, 8.0, 10.0, 14.0):
    w = 2 * np.pi / period
    for j, b in enumerate(names):
        made = solver.solve(cpt.RadiationProblem(body=body, radiating_dof=b, omega=w, water_depth=100.0, rho=RHO, g=G))
        for i, a in enumerate(names):
            if i == j:
                print(f"{period},A,{i + 1},{j + 1},{made.added_masses[a]:.6E},0")
                print(f"{period},B,{i + 1},{j + 1},{made.radiation_dampings[a]:.6E},0")
    for toward in (0.0, 90.0, 135.0):
        made = solver.solve(cpt.DiffractionProblem(body=body, wave_direction=np.radians(toward), omega=w, water_depth=100.0, rho=RHO, g=G))
        incident = cpt.bem.airy_waves.froude_krylov_force(made.problem)
        for i, a in enumerate(names):
            x = made.forces[a] + incident[a]
            print(f"{period},X,{i + 1},{toward},{x.real:.6E},{x.imag:.6E}")
