#!/usr/bin/env python3
"""End forces of single lines by MoorPy's catenary: prints moorpy_catenary.csv.

Lines with and without touchdown, slack, taut and with friction on the bottom. MoorPy is asked for 1e-10.
"""
import itertools

from moorpy.Catenary import catenary

print("x,z,length,ea,w,friction,h,v,anchor_h,anchor_v")
for z, slack, stiff, friction in itertools.product([100.0, 300.0], [1.001, 1.02, 1.1, 1.25], [5e7, 8e8], [0.0, 0.6]):
    x, w = 600.0, 1500.0
    length = slack * (x * x + z * z) ** 0.5
    ax, az, fx, fz, _ = catenary(x, z, length, stiff, w, CB=friction, Tol=1e-10, MaxIter=500)
    # MoorPy has the forces of the line on its ends along the axes: the fairlead is pulled back and down
    print(",".join(f"{value:.12g}" for value in (x, z, length, stiff, w, friction, -fx, -fz, ax, az)))
