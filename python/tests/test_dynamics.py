"""Dynamic lines driven from Python: a taut line's stiffness, the weight of a hanging one, MoorDyn's chain."""

import csv
import os
import signal
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import windlass
from windlass.dynamics import Dynamics

MOORDYN = Path(__file__).parents[2] / "tests" / "data" / "moordyn_chain900.csv"
BARE = dict(cd_normal=0.0, cd_axial=0.0, ca_normal=0.0, ca_axial=0.0)


def test_taut_line_pulled_slowly_gives_its_stiffness():
    line = dict(length=100.0, mass=0.01, ea=1e6, diameter=0.01, elements=10, anchor=(0, 0, 0), fairlead=(101, 0, 0), **BARE)
    lines = Dynamics([line], density=0.0, dt=0.5)
    assert lines.forces[0, 0] == pytest.approx(-1e4, abs=1.0)
    for t in np.arange(1.0, 21.0):
        force = lines.step(t, [101.0 + 0.05 * t, 0.0, 0.0], [0.05, 0.0, 0.0])
    assert force[0, 0] == pytest.approx(-2e4, abs=20.0)
    assert lines.anchor_forces[0, 0] == pytest.approx(2e4, abs=20.0)
    assert (lines.time, len(lines)) == (20.0, 1)


def test_ends_of_a_hanging_line_carry_its_weight():
    line = dict(length=120.0, mass=50.0, ea=1e8, diameter=0.05, elements=20, anchor=(0, 0, -5), fairlead=(0, 90, 0), **BARE)
    lines = Dynamics([line], density=0.0, gravity=9.81)
    assert lines.forces[0, 2] + lines.anchor_forces[0, 2] == pytest.approx(-120 * 50 * 9.81, abs=1.0)
    nodes = lines.nodes(0)
    assert nodes.shape == (21, 3) and np.allclose(nodes[0], (0, 90, 0)) and np.allclose(nodes[-1], (0, 0, -5))


def test_ends_below_the_bottom_and_no_depth_are_refused():
    line = dict(length=900.0, mass=199.0, ea=8.54e8, diameter=0.18, elements=30, anchor=(-800, 0, -300), fairlead=(0, 0, -10), **BARE)
    with pytest.raises(windlass.Error, match="line 1: its anchor at z -300 m is below the bottom at -50 m"):
        Dynamics([line], depth=50.0)
    for depth in (0.0, -5.0):
        with pytest.raises(ValueError, match="more than zero"):
            Dynamics([line], depth=depth)
    lines = Dynamics([line], depth=300.0)
    assert np.array_equal(lines.nodes(-1), lines.nodes(0))
    with pytest.raises(IndexError):
        lines.nodes(-2)


def test_driven_chain_follows_moordyn():
    chain = dict(
        length=900.0, mass=199.0, ea=8.54e8, diameter=0.18, elements=100, axial_damping=1e6,
        cd_normal=1.333, cd_axial=0.639, ca_normal=1.0, ca_axial=0.5,
        anchor=(-800.0, 0.0, -300.0), fairlead=(0.0, 0.0, -10.0),
    )
    lines = Dynamics([chain], depth=300.0, dt=0.1)
    with MOORDYN.open() as file:
        rows = [[float(cell) for cell in row] for row in csv.reader(file) if row[0].replace(".", "").isdigit()]
    wanted = {round(row[0], 6): np.hypot(row[1], row[2]) for row in rows}
    size = max(wanted.values()) - min(wanted.values())
    worst = 0.0
    for t in np.round(np.arange(0.1, 30.05, 0.1), 6):
        w, p = 2 * np.pi / 10, np.pi / 20
        r, rate = (0.5 * (1 - np.cos(p * t)), 0.5 * p * np.sin(p * t)) if t < 20 else (1.0, 0.0)
        x, v = 5 * r * np.sin(w * t), 5 * (rate * np.sin(w * t) + r * w * np.cos(w * t))
        force = lines.step(t, [[x, 0.0, -10.0]], [[v, 0.0, 0.0]])
        if t in wanted:
            worst = max(worst, abs(np.linalg.norm(force) - wanted[t]))
    assert 0.0 < worst < 0.02 * size


#: A taut vertical line in the upper water, and the regular wave it stands in: 2 m of amplitude, 10 s, along X, in 50 m of water.
STIFF = dict(length=9.99, mass=100.0, ea=1e9, diameter=0.3, elements=50, cd_normal=1.2, cd_axial=0.0, ca_normal=1.0, ca_axial=0.0)
WAVE = dict(amplitude=2.0, period=10.0, depth=50.0)


def morison(t, current=0.0, density=1025.0, gravity=9.80665):
    """Morison's force (N) on STIFF between 20 and 10 m below the surface at x = 0, by linear theory; loads are those of the length without tension."""
    a, w, d = WAVE["amplitude"], 2 * np.pi / WAVE["period"], WAVE["depth"]
    k = w * w / gravity
    for _ in range(100):
        k = w * w / (gravity * np.tanh(k * d))
    z = np.linspace(-20.0, -10.0, 2001)
    profile = a * w * np.cosh(k * (z + d)) / np.sinh(k * d)
    u, du = profile * np.cos(w * t) + current, -profile * w * np.sin(w * t)
    size, cd, ca = STIFF["diameter"], STIFF["cd_normal"], STIFF["ca_normal"]
    load = 0.25 * np.pi * size**2 * density * (1 + ca) * du + 0.5 * density * cd * size * np.abs(u) * u
    return np.trapezoid(load, z) * STIFF["length"] / 10.0


@pytest.mark.parametrize("current", [0.0, 0.8])
def test_wave_on_a_taut_vertical_line_is_morison(current):
    line = {**STIFF, "anchor": (0, 0, -20), "fairlead": (0, 0, -10)}
    wave = f"-WAVES {WAVE['period']} {WAVE['amplitude']} 0 180 -RAMP 20"
    lines = Dynamics([line], depth=WAVE["depth"], current=(current, 0, 0), environment=wave, dt=0.05)
    # at rest the current alone
    assert (lines.forces + lines.anchor_forces)[0, 0] == pytest.approx(0.5 * 1025 * 1.2 * 0.3 * current**2 * 9.99, abs=0.5)
    found, wanted = [], []
    for t in np.arange(0.5, 60.01, 0.5):
        force = lines.step(t, [[0.0, 0.0, -10.0]], [[0.0, 0.0, 0.0]])
        if t > 40:
            found.append((force + lines.anchor_forces)[0, 0])
            wanted.append(morison(t, current))
    # the line gives way by a few millimetres, and its nodes stand for 0.2 m each
    assert np.abs(np.array(found) - wanted).max() < 0.005 * np.abs(wanted).max()


def test_environment_of_lines_is_one_record():
    line = {**STIFF, "anchor": (0, 0, -20), "fairlead": (0, 0, -10)}
    for options, said in [
        ("-SEA JONSVAP 180 9 12", "JONSWAP"),
        ("-SEA JONSWAP 180 9 12\n&FINISH", "one &ENV record"),
        ("-DEPTH 80", "arguments of their own"),
        ("-SEA", "expected"),
    ]:
        with pytest.raises(windlass.Error, match=said):
            Dynamics([line], depth=50.0, environment=options)


def test_wrong_lines_and_steps_are_named():
    good = dict(length=100.0, mass=1.0, ea=1e6, diameter=0.01, anchor=(0, 0, 0), fairlead=(99, 0, 0), **BARE)
    for change, said in [
        (dict(mass=-1.0), "the mass per length"),
        (dict(lenght=1.0), "`lenght` is no property of a line: did you mean length"),
        (dict(elements=10**9), "at most"),
        (dict(elements=2.5), "elements is no whole number"),
        (dict(fairlead=(np.nan, 0, 0)), "an end is not finite"),
    ]:
        with pytest.raises((windlass.Error, ValueError), match=said):
            Dynamics([{**good, **change}])
    with pytest.raises(ValueError, match="cd_normal is missing"):
        Dynamics([{name: value for name, value in good.items() if name != "cd_normal"}])
    lines = Dynamics([good], density=0.0)
    with pytest.raises(windlass.Error, match="goes nowhere"):
        lines.step(-1.0, [99.0, 0, 0], [0, 0, 0])
    with pytest.raises(windlass.Error, match="1 fairleads"):
        lines.step(1.0, np.zeros((2, 3)), np.zeros((2, 3)))
    with pytest.raises(ValueError, match="a row x, y, z a line"):
        lines.step(1.0, np.zeros((1, 2)), np.zeros((1, 2)))
    with pytest.raises(IndexError):
        lines.nodes(3)
    assert lines.time == 0.0


def test_long_step_stops_at_control_c_and_changes_nothing():
    line = dict(length=900.0, mass=199.0, ea=8.54e8, diameter=0.18, elements=300, anchor=(-800, 0, -300), fairlead=(0, 0, -10), **BARE)
    lines = Dynamics([line], depth=300.0, dt=0.001)
    before = lines.forces
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begun = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        lines.step(900.0, [[0, 0, -10]], [[0, 0, 0]])
    assert time.monotonic() - begun < 5.0
    assert lines.time == 0.0 and np.array_equal(lines.forces, before)
