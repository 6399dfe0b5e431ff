"""Radiation and diffraction of a floating hemisphere by Capytaine: what tests/data/hemisphere holds.

pip install capytaine==3.0.0 netCDF4; python make.py
Radius 10 m, deep water, 1025 kg/m3, g 9.80665 m/s2; moments about the centre of the waterplane; waves from 0 to 315 degrees.
"""
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
export_dataset("nemoh", coarse.isel(omega=slice(1, -1)), format="nemoh")
