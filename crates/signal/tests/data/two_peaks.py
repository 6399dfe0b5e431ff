"""scripts/series.csv: one hour of a line's tension and a heave, swell of 14 s and wind sea of 7 s, second-order tension.

    python two_peaks.py      phases of a fixed seed, so that every run writes the same file
"""
import os
import numpy as np

t = np.arange(3600.0)
w = 0.25 + 1.1 * (np.arange(120) + 0.5) / 120
s = 2.2 * np.exp(-(((w - 0.45) / 0.05) ** 2)) + 0.8 * np.exp(-(((w - 0.9) / 0.14) ** 2))
a = np.sqrt(2 * s * (w[1] - w[0]))
p = np.random.default_rng(1).uniform(0, 2 * np.pi, 120)
z = (a[:, None] * np.cos(w[:, None] * t + p[:, None])).sum(axis=0)
rate = (-w[:, None] * a[:, None] * np.sin(w[:, None] * t + p[:, None])).sum(axis=0)
f = 1500 + 180 * z + 40 * rate + 25 * z * z
path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../scripts/series.csv")
with open(path, "w") as file:
    file.write("Time (s),Tension (kN),Heave (m)\n")
    for row in zip(t, f, z):
        file.write("%d,%.2f,%.4f\n" % row)
