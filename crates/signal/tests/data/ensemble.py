"""Gumbel fits of maxima of seeds by scipy, and how often the intervals of windlass_signal::ensemble hold the true value.

    python ensemble.py            prints ensemble.csv
    python ensemble.py coverage   prints the shares that the module's head states

scipy's moments use the deviation with n; the factor sqrt(n/(n-1)) turns it into that of the sample.
"""
import sys
import numpy as np
from scipy import stats
from scipy.optimize import minimize

SAMPLES = {
    "tension5": [2712.4, 2951.8, 2635.1, 3104.9, 2809.3],
    "tension10": [5210.0, 4987.5, 5534.2, 5105.8, 5078.4, 5391.0, 5640.7, 5012.3, 5166.9, 5288.6],
    "offset20": [14.21, 15.02, 13.88, 16.4, 14.77, 14.95, 15.6, 13.71, 14.02, 17.35,
                 14.5, 14.63, 15.21, 14.11, 16.02, 13.95, 14.38, 15.83, 14.87, 15.11],
}


def fits():
    print("sample,count,mean,deviation,moments_location,moments_scale,likelihood_location,likelihood_scale,fractile90")
    for name, data in SAMPLES.items():
        x = np.array(data)
        n = len(x)
        _, scale = stats.gumbel_r.fit(x, method="MM")
        # scipy's own moments scale, with n - 1
        scale *= np.sqrt(n / (n - 1))
        location = stats.gumbel_r(0, scale).mean()
        location = x.mean() - location
        # the likelihood of scipy's density, refined beyond the tolerance of fit()
        start = stats.gumbel_r.fit(x)
        best = minimize(lambda p: -stats.gumbel_r.logpdf(x, p[0], np.exp(p[1])).sum(), [start[0], np.log(start[1])],
                        method="Nelder-Mead", options={"xatol": 1e-11, "fatol": 1e-13, "maxiter": 20000})
        assert abs(best.x[0] / start[0] - 1) < 1e-6, (best.x, start)
        q90 = stats.gumbel_r.ppf(0.9, location, scale)
        print(name, n, *(f"{v:.10g}" for v in (x.mean(), x.std(ddof=1), location, scale, start[0], start[1], q90)), sep=",")


def coverage():
    rng = np.random.default_rng(20260701)
    euler, trials = 0.5772156649015329, 20000
    for n in (3, 5, 10, 20, 40):
        x = rng.gumbel(size=(trials, n))
        s = x.std(axis=1, ddof=1)
        k = -euler * np.sqrt(6) / np.pi
        mode = x.mean(axis=1) + k * s
        half = stats.t.ppf(0.975, n - 1) * s * np.sqrt((1 + k * 1.1395470994 + k * k * 1.1) / n)
        share = np.mean(np.abs(mode) <= half)
        scale = np.empty(trials)
        for i, row in enumerate(x):
            low, high = 1e-9, row.mean() - row.min()
            y = row - row.min()
            for _ in range(60):
                m = 0.5 * (low + high)
                e = np.exp(-y / m)
                if m - y.mean() + (e * y).sum() / e.sum() < 0:
                    low = m
                else:
                    high = m
            scale[i] = m
        location = -scale * np.log(np.exp(-x / scale[:, None]).mean(axis=1))
        reach = stats.t.ppf(0.975, n - 1) * scale * np.sqrt((1 + 6 / np.pi**2 * (1 - euler) ** 2) / n)
        print(n, "moments", share, "likelihood", np.mean(np.abs(location) <= reach), "scatter of the mode over the deviation",
              mode.std() / (np.pi / np.sqrt(6)))


coverage() if sys.argv[1:] == ["coverage"] else fits()
