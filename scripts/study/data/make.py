"""Writes semi.1, semi.3 and semi.8 in the form of WAMIT with ULEN 1 m, by Capytaine 3: added mass and damping, excitation, mean drift.

A semi-submersible of two pontoons 90 x 15 x 9 m and four columns 13 x 13 m at a draught of 21 m in 300 m of water, the one of
scripts/study/semi.cif. Origin amidships in the mean water plane, X forward. Capytaine has exp(-i w t) and reference point 0; the files
have exp(+i w t), over rho and g. Mean drift is the far-field one, of the body floating freely with CG at z = -2 m, radii of gyration
32, 34 and 40 m and 4 per cent of critical damping in heave, roll and pitch.

    pip install capytaine==3.0.0; python make.py
"""

import capytaine as cpt
import numpy as np
import xarray as xr

RHO, G, DEPTH = 1025.0, 9.80665, 300.0
PERIODS = [4.0, 5.0, 5.5, 6.0, 6.5, 7.0, 7.5, 8.0, 8.5, 9.0, 9.5, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0, 16.0, 17.0, 18.0, 20.0, 22.0, 25.0, 30.0]
HEADINGS = np.arange(0.0, 360.0, 15.0)
BOXES = [(-45, 22.5, -21, 45, 37.5, -12), (-45, -37.5, -21, 45, -22.5, -12)]
BOXES += [(x - 6.5, y - 6.5, -12, x + 6.5, y + 6.5, 0) for x in (30.5, -30.5) for y in (30, -30)]


def lines(axis, size):
    """Grid lines through every edge of a box, evenly between."""
    edges = sorted({float(b[axis]) for b in BOXES} | {float(b[axis + 3]) for b in BOXES})
    parts = [np.linspace(a, b, max(1, round((b - a) / size)) + 1)[:-1] for a, b in zip(edges, edges[1:])]
    return np.concatenate([*parts, [edges[-1]]])


def hull(size):
    """Quadrilaterals between what is inside of a box and what is not, but those in the water plane."""
    grid = [lines(a, size) for a in range(3)]
    middle = [(g[1:] + g[:-1]) / 2 for g in grid]
    x, y, z = np.meshgrid(*middle, indexing="ij")
    inside = np.zeros(x.shape, bool)
    for b in BOXES:
        inside |= (b[0] < x) & (x < b[3]) & (b[1] < y) & (y < b[4]) & (b[2] < z) & (z < b[5])
    solid = np.pad(inside, 1)
    vertices, faces = {}, []

    def number(i, j, k):
        return vertices.setdefault((i, j, k), len(vertices))

    for i, j, k in np.argwhere(inside):
        for axis in range(3):
            for side in (0, 1):
                step = [0, 0, 0]
                step[axis] = 2 * side - 1
                if solid[i + 1 + step[0], j + 1 + step[1], k + 1 + step[2]]:
                    continue
                if axis == 2 and side == 1 and grid[2][k + 1] == 0.0:
                    continue
                u, v = (axis + 1) % 3, (axis + 2) % 3
                square = [(0, 0), (1, 0), (1, 1), (0, 1)]
                corners = []
                for du, dv in square if side else square[::-1]:
                    c = [i, j, k]
                    c[axis] += side
                    c[u] += du
                    c[v] += dv
                    corners.append(number(*c))
                faces.append(corners)
    points = np.array([[grid[0][i], grid[1][j], grid[2][k]] for i, j, k in vertices])
    return cpt.Mesh(vertices=points, faces=np.array(faces), name="semi")


def main():
    mesh = hull(3.8)
    volume = sum((b[3] - b[0]) * (b[4] - b[1]) * (b[5] - b[2]) for b in BOXES)
    print(mesh.nb_faces, "panels, volume", mesh.volume, volume)
    body = cpt.FloatingBody(mesh=mesh, dofs=cpt.rigid_body_dofs(rotation_center=(0, 0, 0)), center_of_mass=(0, 0, -2), name="semi")
    stiffness = body.compute_hydrostatic_stiffness(rho=RHO, g=G)
    mass = RHO * volume
    inertia = mass * np.diag([1, 1, 1, 32.0**2, 34.0**2, 40.0**2])
    cross = mass * -2.0  # of the CG below the origin
    inertia[0, 4] = inertia[4, 0] = cross
    inertia[1, 3] = inertia[3, 1] = -cross
    inertia[3, 3] += mass * 4
    inertia[4, 4] += mass * 4
    names = list(body.dofs)
    solver = cpt.BEMSolver(method="indirect")
    test = xr.Dataset(coords={
        "omega": 2 * np.pi / np.array(PERIODS), "wave_direction": np.radians(HEADINGS), "radiating_dof": names,
        "theta": np.radians(np.arange(-2.0, 363.0)), "water_depth": [DEPTH], "rho": [RHO]})
    data = solver.fill_dataset(test, body, hydrostatics=False, progress_bar=False).squeeze()
    body.inertia_matrix = xr.DataArray(inertia, dims=["influenced_dof", "radiating_dof"], coords={"influenced_dof": names, "radiating_dof": names})
    data["inertia_matrix"] = body.inertia_matrix
    data["hydrostatic_stiffness"] = stiffness
    added = data["added_mass"].sel(omega=2 * np.pi / 25.0, method="nearest").transpose("influenced_dof", "radiating_dof").values
    damping = np.zeros((6, 6))
    for d in (2, 3, 4):
        damping[d, d] = 0.04 * 2 * np.sqrt((inertia[d, d] + added[d, d]) * stiffness.values[d, d])
    dissipation = xr.DataArray(damping, dims=["influenced_dof", "radiating_dof"], coords={"influenced_dof": names, "radiating_dof": names})
    motion = cpt.post_pro.rao(data, dissipation=dissipation)
    drift = cpt.post_pro.far_field_mean_drift_force(motion, data)
    infinite = [solver.solve(cpt.RadiationProblem(body=body, radiating_dof=b, omega=np.inf, water_depth=DEPTH, rho=RHO, g=G)) for b in names]
    coupled = [(i, j) for i in range(6) for j in range(6) if i == j or {i, j} in ({0, 4}, {1, 3})]
    with open("semi.1", "w") as first:
        for i, j in coupled:
            first.write(f"{0:8.3f} {i + 1} {j + 1} {infinite[j].added_masses[names[i]] / RHO:.5E}\n")
        for t in PERIODS:
            at = data.sel(omega=2 * np.pi / t, method="nearest")
            for i, j in coupled:
                m = float(at["added_mass"].sel(influenced_dof=names[i], radiating_dof=names[j])) / RHO
                c = float(at["radiation_damping"].sel(influenced_dof=names[i], radiating_dof=names[j])) / (RHO * 2 * np.pi / t)
                first.write(f"{t:8.3f} {i + 1} {j + 1} {m:.5E} {c:.5E}\n")
    with open("semi.3", "w") as third:
        for t in PERIODS:
            at = data.sel(omega=2 * np.pi / t, method="nearest")
            for h in HEADINGS:
                for i, a in enumerate(names):
                    x = np.conj(complex(at["excitation_force"].sel(wave_direction=np.radians(h), influenced_dof=a, method=None))) / (RHO * G)
                    third.write(f"{t:8.3f} {h:6.1f} {i + 1} {abs(x):.5E} {np.degrees(np.angle(x)):8.3f} {x.real:.5E} {x.imag:.5E}\n")
    with open("semi.8", "w") as eighth:
        for t in PERIODS:
            for h in HEADINGS:
                for i, name in ((1, "drift_force_surge"), (2, "drift_force_sway"), (6, "drift_force_yaw")):
                    d = float(drift[name].sel(omega=2 * np.pi / t, method="nearest").sel(wave_direction_k=np.radians(h), wave_direction_l=np.radians(h)).real) / (RHO * G)
                    eighth.write(f"{t:8.3f} {h:6.1f} {h:6.1f} {i} {abs(d):.5E} {0 if d >= 0 else 180:6.1f} {d:.5E} {0:.5E}\n")
    for t in PERIODS:
        at = drift.sel(omega=2 * np.pi / t, method="nearest").sel(wave_direction_k=0.0, wave_direction_l=0.0)
        print(t, float(at["drift_force_surge"].real) / 1e3, "kN/m2 of amplitude")


if __name__ == "__main__":
    main()
