"""Radiation and diffraction of a floating hemisphere by Capytaine: what tests/data/hemisphere holds.

pip install capytaine==3.0.0 netCDF4; python make.py
Radius 10 m, deep water, 1025 kg/m3, g 9.80665 m/s2; moments about the centre of the waterplane; waves from 0 to 315 degrees.
"""
import os

import numpy as np
import xarray as xr
import capytaine as cpt
from capytaine.io.xarray import export_dataset, separate_complex_values

cpt.set_logging("WARNING")
radius, rho, g = 10.0, 1025.0, 9.80665
mesh = cpt.mesh_sphere(radius=radius, resolution=(32, 64)).immersed_part()
body = cpt.FloatingBody(
    mesh=mesh,
    lid_mesh=mesh.generate_lid(z=-0.05 * radius),
    dofs=cpt.rigid_body_dofs(rotation_center=(0, 0, 0)),
    center_of_mass=(0, 0, -3.0),
    name="hemisphere",
)
body.inertia_matrix = body.compute_rigid_body_inertia(rho=rho)
body.hydrostatic_stiffness = body.compute_hydrostatic_stiffness(rho=rho, g=g)

# the Ka of Hulme's table, and steps of 0.05 rad/s for the transforms
table = [0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4, 1.6, 1.8, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0]
omega = np.unique(np.round(np.concatenate([np.sqrt(np.array(table) * g / radius), np.arange(0.05, 3.61, 0.05)]), 12))
matrix = xr.Dataset(coords={
    "omega": np.concatenate([[0.0], omega, [np.inf]]),
    "radiating_dof": list(body.dofs),
    "rho": [rho], "g": [g], "water_depth": [np.inf],
})
waves = xr.Dataset(coords={
    "omega": omega, "wave_direction": np.radians(np.arange(0, 360, 45)), "rho": [rho], "g": [g], "water_depth": [np.inf],
})
solver = cpt.BEMSolver(method="direct")
data = xr.merge([
    solver.fill_dataset(matrix, body, hydrostatics=True),
    solver.fill_dataset(waves, body, hydrostatics=True),
], compat="override", join="outer")
keep = ["added_mass", "radiation_damping", "excitation_force", "hydrostatic_stiffness", "inertia_matrix", "disp_mass"]
data = data[keep]
export_dataset("hemisphere.nc", data, format="netcdf")
# every fourth frequency as what xarray writes where only scipy is installed, and as WAMIT and NEMOH files
data = data.assign_coords({d: [str(v) for v in data[d].values] for d in ("influenced_dof", "radiating_dof")})
coarse = data.isel(omega=[0] + list(range(1, len(omega) + 1, 4)) + [len(omega) + 1])
separate_complex_values(coarse).to_netcdf("classic.nc", format="NETCDF3_64BIT", engine="scipy")
export_dataset("wamit", coarse, format="wamit", exports=("1", "3", "hst"))

# NEMOH: six frequencies and five headings in the form of its version 3 (Capytaine's own writer leaves the heads out)
def nemoh(of, folder):
    os.makedirs(f"{folder}/results", exist_ok=True)
    os.makedirs(f"{folder}/mesh", exist_ok=True)
    dofs = [str(v) for v in of.influenced_dof.values]
    w = of.omega.values
    with open(f"{folder}/Nemoh.cal", "w") as out:
        out.write("--- Environment ---\n%g ! RHO\n%g ! G\n0. ! DEPTH\n0. 0. ! XEFF YEFF\n" % (rho, g))
        out.write("--- Description of floating bodies ---\n1 ! Number of bodies\n--- Body 1 ---\nhemisphere.dat\n2113 2048\n")
        lines = [f"{1 if i < 3 else 2} {' '.join('1.' if i % 3 == k else '0.' for k in range(3))} 0. 0. 0. ! {d}\n" for i, d in enumerate(dofs)]
        out.write("6\n" + "".join(lines) + "6\n" + "".join(lines) + "0\n")
        out.write("--- Load cases ---\n1 %d %g %g\n%d 0. 180.\n" % (len(w), w[0], w[-1], len(of.wave_direction)))
    with open(f"{folder}/results/RadiationCoefficients.tec", "w") as out:
        out.write('VARIABLES="w (rad/s)"\n')
        for k in range(6):
            out.write(f'"A   1{k + 1:4d}" "B   1{k + 1:4d}"\n')
        for j in range(6):
            out.write(f'Zone t="Motion of body   1 in DoF{j + 1:4d}",I={len(w):6d},F=POINT\n')
            for n in range(len(w)):
                pairs = [f"{of.added_mass.values[n, i, j]:15.7E}{of.radiation_damping.values[n, i, j]:15.7E}" for i in range(6)]
                out.write(f"{w[n]:15.7E}" + "".join(pairs) + "\n")
    with open(f"{folder}/results/ExcitationForce.tec", "w") as out:
        out.write('VARIABLES="w (rad/s)"\n')
        for k in range(6):
            out.write(f'"abs(F   1{k + 1:4d})" "angle(F   1{k + 1:4d})"\n')
        for h, beta in enumerate(np.degrees(of.wave_direction.values)):
            out.write(f'Zone t="Excitation force - beta = {beta:7.3f} deg",I={len(w):6d},F=POINT\n')
            for n in range(len(w)):
                x = of.excitation_force.values[n, h, :]
                out.write(f"{w[n]:15.7E}" + "".join(f"{abs(v):15.7E}{np.angle(v):15.7E}" for v in x) + "\n")
    np.savetxt(f"{folder}/mesh/KH.dat", of.hydrostatic_stiffness.values, fmt="%14.7E")
    with open(f"{folder}/mesh/Hydrostatics.dat", "w") as out:
        out.write(" XF =  0.000 - XG =  0.000\n YF =  0.000 - YG =  0.000\n ZF = -3.744 - ZG = -3.000\n")
        out.write(f" Displacement = {float(of.disp_mass) / rho:14.7E}\n")


nemoh(coarse.isel(omega=slice(3, 27, 4), wave_direction=slice(0, 5)), "nemoh")
