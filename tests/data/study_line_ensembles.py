"""Tensions of a catenary for eight members of a storm, and Gumbel fits of them by scipy as maxima and as minima.

    python study_line_ensembles.py > study_line_ensembles.csv

The line is 1,010 m long, weighs 1,000 N/m, hangs 200 m high and does not stretch. At a horizontal force H its tension at the top is
T = H + w h; what hangs is s = sqrt(h^2 + 2 h H / w) long, and the anchor is 1010 - s + H / w acosh(1 + w h / H) away.
scipy's moments take the deviation with n: the factor sqrt(n / (n - 1)) turns it into that of the sample.
"""
import numpy as np
from scipy import stats
from scipy.optimize import minimize

W, HEIGHT, LENGTH = 1000.0, 200.0, 1010.0
FORCES = np.array([500e3, 462e3, 541e3, 518e3, 489e3, 603e3, 476e3, 530e3])


def anchor(force):
    hanging = np.sqrt(HEIGHT**2 + 2 * HEIGHT * force / W)
    return LENGTH - hanging + force / W * np.arccosh(1 + W * HEIGHT / force)


def fit(x, law, euler_sign):
    scale = x.std(ddof=1) * np.sqrt(6) / np.pi
    location = x.mean() - euler_sign * np.euler_gamma * scale
    assert abs(law(location, scale).mean() / x.mean() - 1) < 1e-12
    start = law.fit(x)
    best = minimize(lambda p: -law.logpdf(x / 1e5, p[0], np.exp(p[1])).sum(), [start[0] / 1e5, np.log(start[1] / 1e5)],
                    method="Nelder-Mead", options={"xatol": 1e-12, "fatol": 1e-13, "maxiter": 20000})
    likely = best.x[0] * 1e5, np.exp(best.x[1]) * 1e5
    assert abs(likely[0] / start[0] - 1) < 1e-5, (likely, start)
    # the value that nine of ten storms do not go beyond
    beyond = law(location, scale).ppf(0.9 if euler_sign > 0 else 0.1)
    return location, scale, *likely, beyond


tensions = FORCES + W * HEIGHT
print("what,value")
for member, (force, tension) in enumerate(zip(FORCES, tensions), 1):
    print(f"anchor{member},{anchor(force):.9f}")
    print(f"tension{member},{tension:.1f}")
for extreme, law, sign in (("largest", stats.gumbel_r, 1), ("least", stats.gumbel_l, -1)):
    names = ("moments_location", "moments_scale", "likelihood_location", "likelihood_scale", "moments_p90")
    for name, value in zip(names, fit(tensions, law, sign)):
        print(f"{extreme}_{name},{value:.10g}")
print(f"mean,{tensions.mean():.10g}")
print(f"standard_deviation,{tensions.std(ddof=1):.10g}")
