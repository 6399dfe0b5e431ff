"""The catenary over arrays: closed forms, MoorPy's stored numbers, and what is refused."""

import _thread
import csv
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import windlass
from windlass.catenary import Line, System, solve

DATA = Path(__file__).parent / "data"
EXACT = Path(__file__).parents[2] / "tests" / "data" / "catenary_2000.csv"


def test_sinh_line_carries_its_weight_times_its_parameter():
    a = np.array([50.0, 100.0, 400.0])
    found = solve(2 * a, 0.0, 2 * a * np.sinh(1.0), 1e18, 1000.0, seabed=False)
    assert np.allclose(found.h, 1000.0 * a, rtol=1e-9)
    assert np.allclose(found.v, 1000.0 * a * np.sinh(1.0), rtol=1e-9)
    assert np.allclose(found.tension, 1000.0 * a * np.cosh(1.0), rtol=1e-9)
    assert found.failed == []


def test_grounded_inextensible_line_has_the_closed_form():
    w, z, length = 1500.0, 300.0, 900.0
    h = np.linspace(1e5, 6e5, 7)
    a = h / w
    suspended = np.sqrt(z * z + 2 * a * z)
    x = length - suspended + a * np.arccosh(1 + z / a)
    found = solve(x, z, length, 1e16, w)
    assert np.allclose(found.h, h, rtol=1e-6)
    assert np.allclose(found.v, w * suspended, rtol=1e-7)
    assert np.allclose(found.grounded, length - suspended, atol=1e-4)
    assert np.allclose(found.anchor_v, 0.0)


def test_two_thousand_exact_lines():
    with EXACT.open() as file:
        rows = [row for row in csv.DictReader(file)]
    column = lambda name, of: np.array([float(row[name]) for row in of])
    for suspended in ("0", "1"):
        chosen = [row for row in rows if row["suspended"] == suspended]
        inputs = [column(name, chosen) for name in ("x_m", "z_m", "length_m", "EA_N", "w_N_per_m")]
        found = solve(*inputs, seabed=suspended == "0", friction=column("friction", chosen))
        size = np.hypot(column("fairlead_H_N", chosen), column("fairlead_V_N", chosen)) + 1e-9
        assert np.max(np.abs(found.h - column("fairlead_H_N", chosen)) / size) < 1e-8
        assert np.max(np.abs(found.v - column("fairlead_V_N", chosen)) / size) < 1e-8


def test_moorpy_catenary_within_its_tolerance():
    data = np.loadtxt(DATA / "moorpy_catenary.csv", delimiter=",", skiprows=1).T
    x, z, length, ea, w, friction, h, v, anchor_h, anchor_v = data
    found = solve(x, z, length, ea, w, friction=friction)
    # MoorPy ends its search at 1e-10 of a metre or so, which a taut line turns into 1e-6 of its force
    assert np.allclose(found.h, h, rtol=2e-6) and np.allclose(found.v, v, rtol=2e-6)
    assert np.allclose(found.anchor_h, anchor_h, rtol=1e-5, atol=1e-6 * np.abs(h).max())
    assert np.allclose(found.anchor_v, anchor_v, rtol=1e-5, atol=1.0)


def test_threads_and_batches_change_no_digit():
    x = np.linspace(700.0, 850.0, 3000)
    one = solve(x, 300.0, 900.0, 8e8, 1500.0, threads=1, stiffness=True)
    all_cores = solve(x, 300.0, 900.0, 8e8, 1500.0, stiffness=True)
    assert np.array_equal(one.h, all_cores.h) and np.array_equal(one.stiffness, all_cores.stiffness)
    assert float(solve(x[17], 300.0, 900.0, 8e8, 1500.0).h) == one.h[17]


def test_stiffness_is_the_difference_of_the_force():
    x, z, step = 780.0, 300.0, 1e-3
    k = solve(x, z, 900.0, 8e8, 1500.0, stiffness=True).stiffness
    up = solve(np.array([x + step, x]), np.array([z, z + step]), 900.0, 8e8, 1500.0)
    down = solve(np.array([x - step, x]), np.array([z, z - step]), 900.0, 8e8, 1500.0)
    difference = np.array([up.h - down.h, up.v - down.v]) / (2 * step)
    assert np.allclose(k, difference, rtol=1e-5)


def test_inputs_are_broadcast_and_shapes_kept():
    found = solve(np.full((2, 1), 780.0), np.full((1, 3), 300.0), 900.0, 8e8, 1500.0, stiffness=True)
    assert found.h.shape == (2, 3) and found.stiffness.shape == (2, 3, 2, 2)
    assert np.ptp(found.h) == 0.0
    assert solve(780.0, 300.0, 900.0, 8e8, 1500.0).h.shape == ()
    assert solve([], 300.0, 900.0, 8e8, 1500.0).h.shape == (0,)
    # not contiguous, of another type
    assert solve(np.arange(700, 720)[::2], 300, 900, 8e8, 1500).h.shape == (10,)


def test_lines_without_an_answer_raise_or_are_nan():
    with pytest.raises(windlass.Error, match=r"line 1: the length of segment 1 cannot be -1"):
        solve(780.0, 300.0, [900.0, -1.0, 900.0], 8e8, 1500.0)
    found = solve(780.0, 300.0, [900.0, -1.0, np.nan], 8e8, 1500.0, errors="nan")
    assert np.isfinite(found.h[0]) and np.isnan(found.h[1:]).all()
    assert [at for at, _ in found.failed] == [1, 2]
    with pytest.raises(ValueError, match="'raise' or 'nan'"):
        solve(780.0, 300.0, 900.0, 8e8, 1500.0, errors="ignore")
    with pytest.raises(ValueError, match="broadcast"):
        solve(np.zeros(3), np.zeros(2), 900.0, 8e8, 1500.0)
    with pytest.raises(ValueError):
        solve("far", 300.0, 900.0, 8e8, 1500.0)


def test_line_of_one_segment_is_the_single_line():
    line = Line([(900.0, 1500.0, 8e8)], anchor=-300.0)
    x = np.array([700.0, 780.0, 830.0])
    one, several = solve(x, 300.0, 900.0, 8e8, 1500.0, stiffness=True), line.forces(x, 0.0, stiffness=True)
    assert np.allclose(one.h, several.h, rtol=1e-9) and np.allclose(one.stiffness, several.stiffness, rtol=1e-6)
    parts = Line([(300.0, 1500.0, 8e8), (600.0, 1500.0, 8e8)], anchor=-300.0)
    assert np.allclose(parts.forces(x, 0.0).h, one.h, rtol=1e-8)
    assert parts.length == 900.0 and parts.anchor == -300.0


def test_shape_and_tension_of_a_line():
    line = Line([(900.0, 1500.0, 1e15)], anchor=-300.0)
    h = 3e5
    x = line.distance_at_tension(h + 1500.0 * 300.0, 0.0)
    # on a bottom T = H + w z of an inextensible line
    assert np.isclose(float(line.forces(x, 0.0).h), h, rtol=1e-6)
    shape = line.shape(x, 0.0)
    assert shape.z[0] == pytest.approx(0.0) and shape.z[-1] == pytest.approx(-300.0)
    assert np.allclose(shape.tension, h + 1500.0 * (shape.z + 300.0), rtol=1e-5)
    assert shape.on_bottom.any() and not shape.on_bottom.all()
    with pytest.raises(windlass.Error, match="hanging straight down"):
        line.distance_at_tension(1000.0, 0.0)


def test_joints_are_taken_by_name():
    with_weight = Line([(450.0, 1500.0, 8e8)] * 2, anchor=-300.0, joints=[("weight", 5e4)])
    without = Line([(450.0, 1500.0, 8e8)] * 2, anchor=-300.0, joints=[None])
    assert with_weight.forces(850.0, 0.0).tension > without.forces(850.0, 0.0).tension
    with pytest.raises(ValueError, match="a joint is None"):
        Line([(450.0, 1500.0, 8e8)] * 2, anchor=-300.0, joints=[("wieght", 5e4)])
    with pytest.raises(windlass.Error, match="2 segments has 0 joints"):
        Line([(450.0, 1500.0, 8e8)] * 2, anchor=-300.0, joints=[])
    with pytest.raises(windlass.Error):
        Line([], anchor=-300.0)


def spread():
    angles = np.radians([45.0, 135.0, 225.0, 315.0])
    around = np.column_stack([np.cos(angles), np.sin(angles)])
    lines = [Line([(900.0, 1500.0, 8e8)], anchor=-300.0)] * 4
    fairleads = np.column_stack([30.0 * around, np.full(4, -10.0)])
    return System(lines, 820.0 * around, fairleads), fairleads


def test_symmetric_system_pulls_down_alone():
    system, _ = spread()
    wrench = system.wrench(np.zeros(6))
    one = solve(790.0, 290.0, 900.0, 8e8, 1500.0)
    assert np.allclose(wrench[[0, 1, 3, 4, 5]], 0.0, atol=1e-3)
    assert wrench[2] == pytest.approx(-4 * float(one.v), rel=1e-9)
    assert np.allclose(system.tensions(np.zeros((5, 6))), float(one.tension))
    assert len(system) == 4


def test_system_stiffness_is_the_difference_of_the_wrench():
    system, _ = spread()
    pose, step = np.array([4.0, -3.0, 1.0, 0.0, 0.0, 0.0]), 1e-4
    moves = np.eye(6) * step
    difference = -(system.wrench(pose + moves) - system.wrench(pose - moves)).T / (2 * step)
    assert np.allclose(system.stiffness(pose), difference, rtol=1e-5, atol=2.0)


def test_system_refuses_other_shapes():
    system, fairleads = spread()
    with pytest.raises(ValueError, match="roll, pitch, yaw"):
        system.wrench(np.zeros(5))
    with pytest.raises(ValueError, match="4 fairleads"):
        System([Line([(900.0, 1500.0, 8e8)], anchor=-300.0)], [[0.0, 0.0]], fairleads)
    line = Line([(900.0, 1500.0, 8e8)], anchor=-300.0)
    with pytest.raises(ValueError, match=r"anchors have the shape \(2, 3\)"):
        System([line] * 3, [[820, 0, -300], [-820, 0, -300]], np.zeros((3, 3)))
    with pytest.raises(ValueError, match=r"anchors have the shape \(2, 4\)"):
        System([line] * 4, np.zeros((2, 4)), fairleads)
    with pytest.raises(ValueError, match="x has masked values"):
        line.forces(np.ma.masked_array([700.0, 800.0], mask=[False, True]), 0.0)
    with pytest.raises(windlass.Error, match="pose 1, line 0"):
        system.wrench([[0.0] * 6, [0.0, 0.0, -400.0, 0.0, 0.0, 0.0]])


def test_large_batch_stops_at_control_c():
    # a minute of work of one core
    line = Line([(300.0, 900.0, 1e8), (600.0, 1500.0, 1e9)], anchor=-100.0, friction=0.5)
    x = np.linspace(700.0, 880.0, 2_000_000)

    def press():
        time.sleep(0.5)
        _thread.interrupt_main()

    thread = threading.Thread(target=press)
    begun = time.monotonic()
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        line.forces(x, -10.0, threads=1)
    thread.join()
    # well below what all of it takes
    assert time.monotonic() - begun < 10.0
