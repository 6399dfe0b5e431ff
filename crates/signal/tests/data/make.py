"""Numbers of other programs for crates/signal/tests/it/post.rs: numpy, scipy, rainflow 3.2 and FLife 2.3 (PyPI).

    python make.py      writes series.csv (the signal) and expected.txt (one `name value` a line) beside itself

The signal is a sum of harmonics with fixed phases and a small square, so that its skewness and kurtosis are not zero; no
random numbers, so that any version of numpy makes the same. The maxima fitted are read from it here, independently.
"""
import os
import FLife
import numpy as np
import rainflow
import scipy
from scipy import signal, stats

here = os.path.dirname(os.path.abspath(__file__))
n, step = 4096, 0.5
t = np.arange(n) * step
k = np.arange(1, 61)
w = 0.35 + 1.1 * ((k * 0.6180339887498949) % 1.0)
a = 1.2 * np.exp(-((w - 0.6) / 0.18) ** 2) + 0.35 * np.exp(-((w - 1.1) / 0.15) ** 2)
p = 2 * np.pi * ((k * k * 0.7548776662466927) % 1.0)
x = (a[:, None] * np.cos(w[:, None] * t + p[:, None])).sum(axis=0)
x = np.round(100.0 + x + 0.02 * x * x, 6)
np.savetxt(os.path.join(here, "series.csv"), x, fmt="%.6f")
out = []
put = lambda name, value: out.append(f"{name} {float(value)!r}")
put("mean", x.mean())
put("deviation", x.std())
put("rms", np.sqrt((x * x).mean()))
put("skewness", stats.skew(x))
put("kurtosis", stats.kurtosis(x))
f, s = signal.welch(x, fs=1 / step, window="hann", nperseg=512, noverlap=256, detrend="constant", scaling="density")
for i in [1, 10, 25, 40, 60, 100, 256]:
    put(f"welch_{i}", s[i] / (2 * np.pi))
put("welch_sum", s.sum() * f[1])
cycles = list(rainflow.extract_cycles(x))
put("rainflow_cycles", sum(c for r, m, c, i, j in cycles))
put("rainflow_halves", sum(1 for r, m, c, i, j in cycles if c == 0.5))
put("rainflow_range3", sum(c * r**3 for r, m, c, i, j in cycles))
put("rainflow_range_mean", sum(c * r * m for r, m, c, i, j in cycles))
put("rainflow_largest", max(r for r, m, c, i, j in cycles))
# maxima between crossings of the mean: the highest sample of each stay above it that has a beginning and an end
above = x >= x.mean()
edges = np.flatnonzero(above[1:] != above[:-1]) + 1
maxima = np.array([x[i:j].max() for i, j in zip(edges[:-1], edges[1:]) if above[i]])
minima = np.array([x[i:j].min() for i, j in zip(edges[:-1], edges[1:]) if not above[i]])
put("maxima", len(maxima))
put("minima", len(minima))
put("maxima_sum", maxima.sum())
put("minima_sum", minima.sum())
c, loc, scale = stats.weibull_min.fit(maxima - x.mean(), floc=0)
put("weibull_shape", c)
put("weibull_scale", scale)
blocks = x[: n // 32 * 32].reshape(32, -1).max(axis=1)
loc, scale = stats.gumbel_r.fit(blocks)
put("gumbel_location", loc)
put("gumbel_scale", scale)
spec = np.fft.rfft(x) / n
for i in [0, 200, 205, 210]:
    put(f"fft_{i}", abs(spec[i]) * (1 if i == 0 else 2))
# fatigue damage a second of a two-peaked stress spectrum by FLife, whose curves N = C / S^k take amplitudes: 2^k of ranges
g = np.linspace(0, 6, 60001)
s = 1200 * np.exp(-(((g - 0.5) / 0.08) ** 2)) + 300 * np.exp(-(((g - 1.1) / 0.2) ** 2))
data = FLife.SpectralData(input={"PSD": s * 2 * np.pi, "f": g / 2 / np.pi})
for i in (0, 1, 2, 4):
    put(f"fatigue_m{i}", np.trapezoid(g**i * s, g))
for k, c in ((3.0, 10**11.687), (5.0, 10**15.606)):
    put(f"narrow_{k:.0f}", 2**k / FLife.Narrowband(data).get_life(c, k))
    put(f"dirlik_{k:.0f}", 2**k / FLife.Dirlik(data).get_life(c, k))
put("scipy_version_major_minor", ".".join(scipy.__version__.split(".")[:2]))
with open(os.path.join(here, "expected.txt"), "w") as file:
    file.write("\n".join(out) + "\n")
