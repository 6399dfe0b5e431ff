"""Motions of a free barge of 30 x 10 x 3 m, whose centre of gravity is 1 m above the water, in beam waves of 1 m in deep water, without other damping than that of the waves:
Capytaine 3.0.0, direct method, panels by cosines. Writes capytaine.csv: period (s), amplitudes of sway (m) and roll (deg) of the centre of gravity, by 640, 1,440 and 2,560
panels; the last column of each is what they go to by the square of the panel."""
import capytaine as cpt
import numpy as np

RHO, G = 1025.0, 9.80665
SIDES, ABOVE, RADII = (30.0, 10.0, 3.0), 1.0, (4.0, 9.0, 9.0)
MESHES = [(20, 8, 6), (30, 12, 9), (40, 16, 12)]


def cosines(n):
    return 0.5 * (1 - np.cos(np.pi * np.arange(n + 1) / n))


def hull(nx, ny, nz):
    x, y = [length * (cosines(n) - 0.5) for length, n in zip(SIDES, (nx, ny))]
    z = -SIDES[2] * cosines(nz)
    quads = []
    for a, b in zip(x, x[1:]):
        for c, d in zip(y, y[1:]):
            quads.append([(a, c, z[-1]), (a, d, z[-1]), (b, d, z[-1]), (b, c, z[-1])])
        for d, c in zip(z, z[1:]):
            for y0, order in ((y[-1], 1), (y[0], -1)):
                quads.append([(a, y0, c), (a, y0, d), (b, y0, d), (b, y0, c)][::order])
    for a, b in zip(y, y[1:]):
        for d, c in zip(z, z[1:]):
            for x0, order in ((x[0], 1), (x[-1], -1)):
                quads.append([(x0, a, c), (x0, a, d), (x0, b, d), (x0, b, c)][::order])
    points = np.array(quads, float).reshape(-1, 3)
    return cpt.Mesh(points, np.arange(len(points)).reshape(-1, 4))


def motions(mesh, period):
    centre = (0.0, 0.0, ABOVE)
    body = cpt.FloatingBody(mesh=mesh, dofs=cpt.rigid_body_dofs(rotation_center=centre), center_of_mass=centre)
    length, breadth, draught = SIDES
    volume = length * breadth * draught
    metacentric = breadth**2 / (12 * draught) - draught / 2 - ABOVE
    stiffness = np.zeros((6, 6))
    stiffness[2, 2] = RHO * G * length * breadth
    stiffness[3, 3] = RHO * G * volume * metacentric
    stiffness[4, 4] = RHO * G * volume * (length**2 / (12 * draught) - draught / 2 - ABOVE)
    inertia = RHO * volume * np.diag([1, 1, 1, *(r * r for r in RADII)])
    omega = 2 * np.pi / period
    solver = cpt.BEMSolver(method="direct")
    kind = dict(body=body, omega=omega, water_depth=np.inf, rho=RHO, g=G)
    names = list(body.dofs)
    radiated = solver.solve_all([cpt.RadiationProblem(radiating_dof=dof, **kind) for dof in names], progress_bar=False)
    added = np.array([[r.added_mass[n] for r in radiated] for n in names])
    damping = np.array([[r.radiation_damping[n] for r in radiated] for n in names])
    wave = solver.solve(cpt.DiffractionProblem(wave_direction=np.pi / 2, **kind))
    fk = cpt.bem.airy_waves.froude_krylov_force(wave)
    force = np.array([wave.forces[n] + fk[n] for n in names])
    moved = np.linalg.solve(stiffness - omega**2 * (inertia + added) - 1j * omega * damping, force)
    return abs(moved[1]), np.degrees(abs(moved[3]))


def main():
    with open("capytaine.csv", "w") as out:
        out.write("period s," + ",".join(f"{what} {n}" for what in ("sway", "roll") for n in ("coarse", "middle", "fine", "limit")) + "\n")
        for period in (5.0, 6.0, 8.0, 30.0):
            found = np.array([motions(hull(*counts), period) for counts in MESHES]).T
            rows = [[*of, of[2] + (of[2] - of[1]) / ((MESHES[2][0] / MESHES[1][0])**2 - 1)] for of in found]
            out.write(f"{period:g}," + ",".join(f"{v:.4f}" for row in rows for v in row) + "\n")


if __name__ == "__main__":
    main()
