"""Dynamic lines for the time loop of another program: positions and velocities of the fairleads go in, forces on them come out.

SI units (m, kg, N, s), z up from the mean water level. A line is a large-deflection rod with mass, stretch, drag and added mass, on a flat bottom;
its anchor stays.

    >>> chain = dict(length=900.0, mass=199.0, ea=8.54e8, diameter=0.18, cd_normal=1.333, cd_axial=0.639, ca_normal=1.0, ca_axial=0.5,
    ...              elements=100, anchor=(-800.0, 0.0, -300.0), fairlead=(0.0, 0.0, -10.0))
    >>> lines = windlass.dynamics.Dynamics([chain], depth=300.0, dt=0.1)
    >>> force = lines.step(0.1, [[0.01, 0.0, -10.0]], [[0.2, 0.0, 0.0]])
"""

from __future__ import annotations

from typing import Any, Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core

__all__ = ["Dynamics"]

Floats = NDArray[np.float64]


class Dynamics:
    """Lines at rest at time 0 with their fairleads at their first places, then on their way.

    Each line is a mapping: `length` unstretched (m), `mass` per length in air (kg/m), `ea` (N), `diameter` (m) that displaces, drags and lies on
    the bottom, `cd_normal`, `cd_axial` (on the skin), `ca_normal`, `ca_axial`, `anchor` and `fairlead` (x, y, z in m); where wanted `elements`
    (50), `axial_damping` (N s), `ei` (N m2, pinned ends). Coefficients have no usual values: zero must be said. `depth` puts a flat bottom below
    the lines (m), with `seabed_stiffness` (N/m3, on diameter times length), `seabed_damping` (N s/m3) and Coulomb `friction`; without it they
    hang free. `environment` has options of an `&ENV` record, in metres, seconds and degrees: waves by a spectrum and a seed
    (`-SEA JONSWAP 180 9 12 3.3 -SEED 5 -RAMP 60`) or one by one (`-WAVES T A PHASE DIR ..`), current by depth, wind; its velocities come to
    `current`, and the lines feel it as those of `TDOM` do, the waves from time 0 on. `dt` is the longest step (s): a call that goes further is cut in equal ones, the fairleads on cubics between.
    """

    def __init__(
        self,
        lines: Sequence[Mapping[str, Any]],
        *,
        depth: float | None = None,
        density: float = 1025.0,
        gravity: float = 9.80665,
        current: Sequence[float] = (0.0, 0.0, 0.0),
        environment: str | None = None,
        seabed_stiffness: float = 3e6,
        seabed_damping: float = 3e5,
        friction: float = 0.0,
        dt: float = 0.05,
    ) -> None:
        self._lines = _core.Dynamics(
            [{**line, **{end: tuple(map(float, line[end])) for end in ("anchor", "fairlead") if end in line}} for line in lines],
            depth=depth,
            density=density,
            gravity=gravity,
            current=tuple(map(float, current)),
            environment=environment,
            seabed_stiffness=seabed_stiffness,
            seabed_damping=seabed_damping,
            friction=friction,
            dt=dt,
        )

    def step(self, t: float, x: ArrayLike, v: ArrayLike) -> Floats:
        """Takes the lines to the time `t` (s), at which their fairleads are at `x` (m) and move at `v` (m/s), a row each.

        Returns the force of each line on its fairlead (N), a row each. A step that is refused leaves the lines as they were.
        """
        at, speed = (np.ascontiguousarray(given, dtype=np.float64) for given in (x, v))
        return self._lines.step(t, np.atleast_2d(at), np.atleast_2d(speed))

    @property
    def time(self) -> float:
        """The time at which the lines are (s)."""
        return self._lines.time

    @property
    def forces(self) -> Floats:
        """Force of each line on its fairlead (N), a row each."""
        return self._lines.forces

    @property
    def anchor_forces(self) -> Floats:
        """Force of each line on its anchor (N), a row each."""
        return self._lines.anchor_forces

    @property
    def fairleads(self) -> Floats:
        """Where the fairleads are (m), a row each."""
        return self._lines.fairleads

    def nodes(self, line: int) -> Floats:
        """Where the nodes of a line (from 0) are (m), from its fairlead, a row each."""
        return self._lines.nodes(line)

    def __len__(self) -> int:
        return len(self._lines)

    def __repr__(self) -> str:
        return repr(self._lines)
