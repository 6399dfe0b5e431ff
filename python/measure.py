#!/usr/bin/env python3
"""Lines a second through Python and through the bare loop of the C interface, on one core: python3 python/measure.py LIBRARY

LIBRARY is libwindlass_capi.so of a release build; both solve the same batch, and the best of the repeats counts.
"""
import ctypes
import sys
import time

import numpy as np

from windlass.catenary import solve

COUNT, REPEATS = 10_000, 60


def best(call):
    times = []
    for _ in range(REPEATS):
        begun = time.perf_counter()
        call()
        times.append(time.perf_counter() - begun)
    return min(times)


def main():
    draw = np.random.default_rng(1)
    x, z = draw.uniform(500, 900, COUNT), draw.uniform(50, 300, COUNT)
    length = np.hypot(x, z) * draw.uniform(1.001, 1.2, COUNT)
    ea, w = np.full(COUNT, 8e8), draw.uniform(500, 2000, COUNT)
    library = ctypes.CDLL(sys.argv[1])
    pointer = lambda array: array.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
    out = [np.empty(COUNT) for _ in range(5)]
    arguments = [pointer(array) for array in (x, z, length, ea, w)]
    results = [pointer(array) for array in out]
    call = lambda: library.windlass_catenary_solve(ctypes.c_size_t(COUNT), *arguments, None, 1, *results, None)
    assert call() == 0
    found = solve(x, z, length, ea, w)
    assert np.array_equal(found.h, out[0]) and np.array_equal(found.grounded, out[4])
    # by turns, so that what else the machine does meets both
    engine = min(best(call) for _ in range(3))
    python = min(best(lambda: solve(x, z, length, ea, w, threads=1)) for _ in range(3))
    engine = min(engine, *(best(call) for _ in range(3)))
    every_core = best(lambda: solve(x, z, length, ea, w))
    print(f"engine, one core    {COUNT / engine:12,.0f} lines/s")
    print(f"Python, one core    {COUNT / python:12,.0f} lines/s, {100 * (python / engine - 1):.1f} % longer")
    print(f"Python, all cores   {COUNT / every_core:12,.0f} lines/s")


if __name__ == "__main__":
    main()
