"""Motions of a free barge of 40 x 12 m, trimmed 1.76 degrees by its weight, in waves of 1 m: Capytaine 3.0.0, direct method, on the trimmed hull with panels by cosines.
Writes capytaine.csv: where the waves come from (deg), period (s), amplitudes of the origin of the barge along upright axes (m) and of roll and pitch (deg)."""
import capytaine as cpt
import numpy as np

RHO, G, DEPTH = 1025.0, 9.80665, 60.0
TRIM, RISE = np.radians(1.76), 0.0815


def cosines(n):
    return 0.5 * (1 - np.cos(np.pi * np.arange(n + 1) / n))


def mesh():
    x, y, z = -20 + 40 * cosines(28), -6 + 12 * cosines(10), -4 + 8 * np.arange(9) / 8
    quads = []
    for i in range(28):
        for j in range(10):
            a, b, c, d = x[i], x[i + 1], y[j], y[j + 1]
            quads.append([(a, c, -4), (a, d, -4), (b, d, -4), (b, c, -4)])
        for k in range(8):
            a, b, c, d = x[i], x[i + 1], z[k], z[k + 1]
            quads.append([(a, 6, c), (a, 6, d), (b, 6, d), (b, 6, c)])
            quads.append([(a, -6, c), (b, -6, c), (b, -6, d), (a, -6, d)])
    for j in range(10):
        for k in range(8):
            a, b, c, d = y[j], y[j + 1], z[k], z[k + 1]
            quads.append([(-20, a, c), (-20, a, d), (-20, b, d), (-20, b, c)])
            quads.append([(20, a, c), (20, b, c), (20, b, d), (20, a, d)])
    turn = np.array([[np.cos(TRIM), 0, np.sin(TRIM)], [0, 1, 0], [-np.sin(TRIM), 0, np.cos(TRIM)]])
    points = (np.array(quads, float) @ turn.T + [0, 0, RISE]).reshape(-1, 3)
    whole = cpt.Mesh(points, np.arange(len(points)).reshape(-1, 4)).merged_identical_vertices() if hasattr(
        cpt.Mesh, "merged_identical_vertices") else cpt.Mesh(points, np.arange(len(points)).reshape(-1, 4))
    return whole.immersed_part(), turn


def main():
    hull, turn = mesh()
    centre = turn @ np.array([1.0, 0, -0.5]) + [0, 0, RISE]
    body = cpt.FloatingBody(mesh=hull, dofs=cpt.rigid_body_dofs(rotation_center=tuple(centre)), center_of_mass=tuple(centre))
    stiffness = body.compute_hydrostatic_stiffness(rho=RHO, g=G).values
    mass = RHO * hull.volume
    inertia = np.diag([mass] * 3 + [mass * 64] * 3)
    inertia[3:, 3:] = turn @ inertia[3:, 3:] @ turn.T
    solver = cpt.BEMSolver(method="direct")
    with open("capytaine.csv", "w") as out:
        out.write("heading deg,period s,X,Y,Z,RX,RY\n")
        for period in (10.0, 20.0):
            omega = 2 * np.pi / period
            kind = dict(body=body, omega=omega, water_depth=DEPTH, rho=RHO, g=G)
            radiated = solver.solve_all([cpt.RadiationProblem(radiating_dof=dof, **kind) for dof in body.dofs])
            names = list(body.dofs)
            added = np.array([[r.added_mass[n] for r in radiated] for n in names])
            damping = np.array([[r.radiation_damping[n] for r in radiated] for n in names])
            for heading in (90, 180):
                wave = solver.solve(cpt.DiffractionProblem(wave_direction=np.radians(heading + 180), **kind))
                fk = cpt.bem.airy_waves.froude_krylov_force(wave)
                force = np.array([wave.forces[n] + fk[n] for n in names])
                moved = np.linalg.solve(stiffness - omega**2 * (inertia + added) - 1j * omega * damping, force)
                origin = moved[:3] + np.cross(moved[3:], np.array([0, 0, RISE]) - centre)
                values = [*abs(origin), *np.degrees(abs(moved[3:5]))]
                out.write(f"{heading},{period:g}," + ",".join(f"{v:.4f}" for v in values) + "\n")


if __name__ == "__main__":
    main()
