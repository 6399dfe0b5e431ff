"""Writes capytaine.csv: added mass, damping and exciting forces of a barge of 90 x 30 m at a draught of 3.7 m in 100 m of water, by
Capytaine 3.0.0, direct method, with a lid on the inner waterplane. About the middle of the waterplane, which is the reference of phases;
exp(-i w t). SI.

    pip install capytaine==3.0.0; python make.py > capytaine.csv
"""

import capytaine as cpt
import numpy as np

RHO, G = 1025.0, 9.80665
mesh = cpt.mesh_parallelepiped(size=(90, 30, 7.4), resolution=(60, 20, 6), center=(0, 0, 0)).immersed_part()
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
