"""Wave forces on two bottom-mounted cylinders of radius 1 that stand at (-2, 0) and (2, 0) in water 2 deep, by the exact series of Linton
and Evans, J. Fluid Mech. 215, 1990, equations 2.11 and 2.14: total force over that of a cylinder alone, which MacCamy and Fuchs give.
Writes two_cylinders.csv with X1 and X2 of each cylinder over rho g, four_cylinders.csv with those of four at (-2, -2), (-2, 2), (2, -2) and (2, 2), and two_cylinders_drift.csv with the mean drift of each along x and y over rho g, by the
pressure on it: -1/4 int |zeta|^2 n dl + 1/(4 g) int |grad phi|^2 n dS, n out of the cylinder. Needs numpy and scipy."""
import csv
import numpy as np
from scipy.special import h1vp, hankel1, jvp

CENTRES = np.array([[-2.0, 0.0], [2.0, 0.0]])
SQUARE = np.array([[-2.0, -2.0], [-2.0, 2.0], [2.0, -2.0], [2.0, 2.0]])
DEPTH, TERMS = 2.0, 12


def coefficients(k, heading, centres=CENTRES):
    orders = np.arange(-TERMS, TERMS + 1)
    count = len(orders)
    z = jvp(orders, k) / h1vp(orders, k)
    bodies = len(centres)
    matrix = np.eye(bodies * count, dtype=complex)
    right = np.zeros(bodies * count, dtype=complex)
    for one in range(bodies):
        phase = np.exp(1j * k * (centres[one] @ [np.cos(heading), np.sin(heading)]))
        right[one * count : (one + 1) * count] = -phase * np.exp(1j * orders * (np.pi / 2 - heading))
        for other in set(range(bodies)) - {one}:
            # from the other cylinder to this one
            arm = centres[one] - centres[other]
            distance, angle = np.hypot(*arm), np.arctan2(arm[1], arm[0])
            m, n = np.meshgrid(orders, orders, indexing="ij")
            block = z[None, :] * np.exp(1j * (n - m) * angle) * hankel1(n - m, k * distance)
            matrix[one * count : (one + 1) * count, other * count : (other + 1) * count] = block
    return np.linalg.solve(matrix, right).reshape(bodies, count)


def drift(k, own):
    """Mean force of the two components along x and y, of a cylinder with the coefficients A_n."""
    orders = np.arange(-TERMS, TERMS + 1)
    angles = 2 * np.pi * np.arange(256) / 256
    turns = np.exp(1j * np.outer(angles, orders))
    # elevation on the surface, by the Wronskian of J and H, and its slope along it
    parts = -2j / (np.pi * k) * own / h1vp(orders, k)
    f, slope = turns @ parts, turns @ (1j * orders * parts)
    kh = k * DEPTH
    cosh2 = (DEPTH / 2 + np.sinh(2 * kh) / (4 * k)) / np.cosh(kh) ** 2
    sinh2 = (np.sinh(2 * kh) / (4 * k) - DEPTH / 2) / np.cosh(kh) ** 2
    velocity = (abs(slope) ** 2 * cosh2 + k * k * abs(f) ** 2 * sinh2) / (k * np.tanh(kh))
    pressure = 0.25 * (velocity - abs(f) ** 2) * 2 * np.pi / len(angles)
    return (pressure * np.cos(angles)).sum(), (pressure * np.sin(angles)).sum()


with open("two_cylinders_drift.csv", "w", newline="") as file:
    file.write("# Mean drift over rho g of two bottom-mounted cylinders by the series of Linton and Evans (two_cylinders.py); radius 1, at x = -2 and 2, depth 2\n")
    writer = csv.writer(file)
    writer.writerow("k,heading deg,Fx a,Fy a,Fx b,Fy b".split(","))
    for k in [0.6, 1.0, 1.5]:
        for degrees in [0, 45]:
            values = [v for own in coefficients(k, np.radians(degrees)) for v in drift(k, own)]
            writer.writerow([k, degrees] + [f"{v:.8g}" for v in values])

def forces(k, degrees, centres):
    """X1 and X2 over rho g of each cylinder: on the surface phi is proportional to sum A_n/H_n'(k) exp(i n theta), of which the force takes n = 1 and -1."""
    unit = 4j * np.tanh(k * DEPTH) / (k * k * h1vp(1, k))
    row = [k, degrees]
    for own in coefficients(k, np.radians(degrees), centres):
        plus, minus = own[TERMS + 1], own[TERMS - 1]
        x, y = unit * (plus - minus) / 2, unit * 1j * (plus + minus) / 2
        row += [f"{v:.8g}" for v in (x.real, x.imag, y.real, y.imag)]
    return row


for name, title, centres in [
    ("two_cylinders.csv", "Two bottom-mounted cylinders by the series of Linton and Evans (two_cylinders.py); radius 1, at x = -2 and 2, depth 2", CENTRES),
    ("four_cylinders.csv", "Four bottom-mounted cylinders by the series of Linton and Evans (two_cylinders.py); radius 1, 4 apart in a square, depth 2", SQUARE),
]:
    with open(name, "w", newline="") as file:
        file.write(f"# {title}\n")
        writer = csv.writer(file)
        writer.writerow(["k", "heading deg"] + [f"{part} X{axis} {body}" for body in "abcd"[: len(centres)] for axis in (1, 2) for part in ("Re", "Im")])
        for k in [0.6, 1.0, 1.5]:
            for degrees in [0, 45] if len(centres) == 2 else [0, 30]:
                writer.writerow(forces(k, degrees, centres))
# the factor of a cylinder alone: X1 of MacCamy and Fuchs for A_n = -exp(i n pi/2)
for k in [0.6, 1.0]:
    print(k, 4j * np.tanh(k * DEPTH) / (k * k * h1vp(1, k)) * (-1j - 1j) / 2)
