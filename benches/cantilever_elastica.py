#!/usr/bin/env python3
"""Tips of a cantilever by scipy: python3 benches/cantilever_elastica.py > crates/line-dynamics/tests/data/cantilever_elastica.csv

A steel pipe of 168.3 by 7.11 mm (E 2e11 Pa) and 10 m is clamped level and hangs under a dead load at its tip, with its own weight and
without. With s the unstretched arc from the clamp, theta the slope downward, V(s) = P + w (L - s) and the tension T = V sin(theta):

    EI theta'' = -(1 + T / EA) V cos(theta),    theta(0) = 0, theta'(L) = 0,
    x' = (1 + T / EA) cos(theta),    z' = -(1 + T / EA) sin(theta)

(Euler and Bernoulli, extensible). By shooting on theta'(0): the root without a wave, which is the first one.
"""
import math

from scipy.integrate import solve_ivp
from scipy.optimize import brentq

LENGTH, OUTER, WALL, E = 10.0, 0.1683, 0.00711, 2e11
INNER = OUTER - 2 * WALL
AREA = math.pi / 4 * (OUTER**2 - INNER**2)
EI, EA = E * math.pi / 64 * (OUTER**4 - INNER**4), E * AREA


def tip(load, weight):
    def slopes(s, y):
        theta, turn, _, _ = y
        hung = load + weight * (LENGTH - s)
        stretch = 1 + hung * math.sin(theta) / EA
        return [turn, -stretch * hung * math.cos(theta) / EI, stretch * math.cos(theta), -stretch * math.sin(theta)]

    def shot(turn):
        return solve_ivp(slopes, (0, LENGTH), [0, turn, 0, 0], method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]

    # the slope at the clamp is largest of a rod that all but stands on end: theta' < 2 sqrt(V / EI)
    most = 2 * math.sqrt((load + weight * LENGTH) / EI)
    low, step = 0.0, most / 400
    while shot(low)[1] * shot(low + step)[1] > 0:
        low += step
    turn = brentq(lambda turn: shot(turn)[1], low, low + step, xtol=1e-15)
    theta, _, x, z = shot(turn)
    return x, z, theta, EI * turn


print("load N,weight N/m,tip x m,tip z m,slope rad,moment at the clamp N m")
for load in [40e3, 80e3, 200e3]:
    for weight in [0.0, 280.0]:
        print(f"{load:.0f},{weight:.0f}," + ",".join(f"{v:.9g}" for v in tip(load, weight)))
