"""Largest lean of the rod of rod_pendulum.txt, its body moved by 2 m in x every 12 s, by scipy: a rigid rod on a pin, drag and added mass of
Morison's formula over its length (Gauss-Legendre), the drag of its flat end left out (it points at the pin). Prints the lean with the
acceleration of the pin, and without it. MoorDyn 2.7.2 (moordyn_rod_pendulum.py) has the lean without it: its pinned rods do not feel that the
pin accelerates."""
import numpy as np
from scipy.integrate import solve_ivp

RHO, G, L, D, MASS = 1025.0, 9.80665, 12.0, 0.5, 500.0
AREA = np.pi / 4 * D * D
x, w = np.polynomial.legendre.leggauss(40)
s, w = L * (x + 1) / 2, w * L / 2
FREQUENCY, AMPLITUDE = 2 * np.pi / 12, 2.0
# moments about the pin: of inertia, rod and added mass across it, and the first one
inertia = MASS * (L**3 / 3 + L * D * D / 16) + RHO * AREA * L**3 / 3
first, first_added = MASS * L * L / 2, RHO * AREA * L * L / 2
stiffness = (MASS - RHO * AREA) * G * L * L / 2


def lean(feels_pin):
    def rate(t, y):
        angle, spin = y  # foot toward +x
        v = AMPLITUDE * FREQUENCY * np.cos(FREQUENCY * t)
        a = -AMPLITUDE * FREQUENCY**2 * np.sin(FREQUENCY * t)
        across = v * np.cos(angle) + s * spin
        drag = np.sum(w * s * 0.5 * RHO * D * across * abs(across))
        pin = (first + first_added) * a * np.cos(angle) if feels_pin else 0.0
        return [spin, (-stiffness * np.sin(angle) - drag - pin) / inertia]

    found = solve_ivp(rate, [0, 96], [0, 0], rtol=1e-9, atol=1e-9, max_step=0.02)
    return np.degrees(np.max(np.abs(found.y[0][found.t > 72])))


print(f"with the acceleration of the pin {lean(True):.4f} deg, without {lean(False):.4f} deg")
