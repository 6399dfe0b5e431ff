"""The quasi-static line: elastic catenaries with a seabed, over numpy arrays.

SI units throughout (m, N, N/m). A fairlead is `x` beside its anchor. Forces are pulls of the line: on the fairlead `h` toward the anchor and `v`
downward, on the anchor `anchor_h` toward the fairlead and `anchor_v` upward. Each answer is proven to 1e-9 of the fairlead tension, or is an
error: there is no guess. Lines are found as if nothing were known, so an answer does not depend on the others of its batch.
"""

from __future__ import annotations

from typing import Any, NamedTuple, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core

__all__ = ["Forces", "Line", "Shape", "System", "solve"]

Floats = NDArray[np.float64]


class Forces(NamedTuple):
    """Pulls of lines on their ends, one value a line; NaN for a line in `failed`."""

    #: Horizontal pull on the fairlead, toward the anchor (N).
    h: Floats
    #: Vertical pull on the fairlead, downward (N).
    v: Floats
    #: Horizontal pull on the anchor, toward the fairlead (N).
    anchor_h: Floats
    #: Vertical pull on the anchor, upward (N).
    anchor_v: Floats
    #: Unstretched length on the bottom (m); None of lines of several segments.
    grounded: Floats | None
    #: d(h, v)/d(x, z) (N/m), of shape (..., 2, 2), where it was asked for.
    stiffness: Floats | None
    #: Lines without an answer: the number in the raveled batch, and why.
    failed: list[tuple[int, str]]

    @property
    def tension(self) -> Floats:
        """Tension at the fairlead (N)."""
        return np.hypot(self.h, self.v)


class Shape(NamedTuple):
    """A line between its ends, from the fairlead."""

    #: Unstretched length from the fairlead (m).
    arc: Floats
    #: Horizontal distance from the fairlead (m).
    x: Floats
    #: Elevation (m).
    z: Floats
    #: Tension (N).
    tension: Floats
    #: Whether it lies on the bottom.
    on_bottom: NDArray[np.bool_]


def _columns(**given: ArrayLike) -> tuple[tuple[int, ...], list[Floats]]:
    """The common shape, and each input flat: of that shape, or of one value."""
    for name, value in given.items():
        if np.ma.is_masked(value):
            raise ValueError(f"{name} has masked values: fill them, or leave them out")
    arrays = [np.asarray(value, dtype=np.float64) for value in given.values()]
    shapes = {array.shape for array in arrays if array.size != 1 or array.ndim > 0}
    if len(shapes) > 1:
        shape = np.broadcast_shapes(*(array.shape for array in arrays))
        arrays = [array if array.ndim == 0 else np.broadcast_to(array, shape) for array in arrays]
    else:
        shape = next(iter(shapes), ())
    return shape, [np.ascontiguousarray(array).reshape(-1) for array in arrays]


def _errors(errors: str) -> bool:
    if errors not in ("raise", "nan"):
        raise ValueError(f"errors is {errors!r}: 'raise' or 'nan'")
    return errors == "raise"


def _threads(threads: int | None) -> int:
    if threads is None:
        return 0
    if threads != 1:
        raise ValueError(f"threads is {threads}: 1, or None for all cores")
    return 1


def _forces(made: dict[str, Any], failed: list[tuple[int, str]], shape: tuple[int, ...]) -> Forces:
    shaped = {name: made[name].reshape(shape) for name in ("h", "v", "anchor_h", "anchor_v")}
    grounded = made["grounded"].reshape(shape) if "grounded" in made else None
    stiffness = None
    if "kxx" in made:
        entries = [made[name] for name in ("kxx", "kxz", "kzx", "kzz")]
        stiffness = np.stack(entries, axis=-1).reshape((*shape, 2, 2))
    return Forces(**shaped, grounded=grounded, stiffness=stiffness, failed=failed)


def solve(
    x: ArrayLike,
    z: ArrayLike,
    length: ArrayLike,
    ea: ArrayLike,
    w: ArrayLike,
    *,
    seabed: bool = True,
    friction: ArrayLike = 0.0,
    stiffness: bool = False,
    errors: str = "raise",
    threads: int | None = None,
) -> Forces:
    """Forces of single lines whose fairleads are `x` beside and `z` above their anchors (m).

    `length` is unstretched (m), `ea` the axial stiffness (N), `w` the submerged weight per unstretched length (N/m; negative of a buoyant
    line). With `seabed` a flat bottom is at the anchor's elevation, with a `friction` coefficient. Inputs are broadcast against each other;
    results have their common shape. `errors="nan"` gives NaN for a line without an answer and lists it in `failed`; otherwise the first one
    raises `windlass.Error`. All cores work, and the interpreter is released; `threads=1` keeps to the calling one.

    >>> import numpy as np
    >>> found = solve(200.0, 0.0, 200.0 * np.sinh(1.0), 1e15, 1000.0, seabed=False)
    >>> round(float(found.h), 2)
    100000.0
    """
    shape, inputs = _columns(x=x, z=z, length=length, ea=ea, w=w, friction=friction)
    made, failed = _core.solve(
        *inputs, seabed=seabed, stiffness=stiffness, raise_=_errors(errors), threads=_threads(threads)
    )
    return _forces(made, failed, shape)


class Line:
    """A line of segments from its fairlead to its anchor, in SI units.

    `segments` are tuples of unstretched length (m), submerged weight per length (N/m) and axial stiffness (N). `joints` stand between them:
    None, `("weight", N)` submerged, `("buoy", lift N, weight N)` or `("spring buoy", capacity N, depth m)`. `anchor` is the elevation of the
    anchor (m, negative below the mean level), where with `seabed` the bottom is: of a `slope` (positive where it rises toward the fairlead)
    and a `friction` coefficient.
    """

    def __init__(
        self,
        segments: Sequence[tuple[float, float, float]],
        *,
        anchor: float,
        joints: Sequence[Any] | None = None,
        surface: float = 0.0,
        seabed: bool = True,
        slope: float = 0.0,
        friction: float = 0.0,
    ) -> None:
        given = None if joints is None else [None if joint is None else tuple(joint) for joint in joints]
        self._line = _core.Line(
            [(float(length), float(weight), float(ea)) for length, weight, ea in segments],
            anchor=anchor,
            joints=given,
            surface=surface,
            seabed=seabed,
            slope=slope,
            friction=friction,
        )

    @property
    def length(self) -> float:
        """Unstretched length (m)."""
        return self._line.length

    @property
    def anchor(self) -> float:
        """Elevation of the anchor (m)."""
        return self._line.anchor

    def forces(
        self,
        x: ArrayLike,
        z: ArrayLike,
        *,
        stiffness: bool = False,
        errors: str = "raise",
        threads: int | None = None,
    ) -> Forces:
        """Forces with the fairlead `x` beside the anchor (m) at the elevation `z` (m)."""
        shape, inputs = _columns(x=x, z=z)
        made, failed = self._line._solve(
            *inputs, stiffness=stiffness, raise_=_errors(errors), threads=_threads(threads)
        )
        return _forces(made, failed, shape)

    def shape(self, x: float, z: float, *, points: int = 20) -> Shape:
        """Its shape with the fairlead `x` beside the anchor (m) at the elevation `z` (m), with `points` inside each segment."""
        return Shape(**self._line.shape(x, z, points=points))

    def distance_at_tension(self, tension: float, z: float) -> float:
        """The distance of the fairlead from the anchor (m) at which its tension is `tension` (N)."""
        return self._line.distance_at_tension(tension, z)

    def __repr__(self) -> str:
        return repr(self._line)


class System:
    """Lines on one body: forces and stiffness at many poses of it.

    `anchors` are x, y of each anchor (m, global; the elevation is the line's), `fairleads` x, y, z of each fairlead in the axes of the body
    (m). A pose is x, y, z (m), roll, pitch, yaw (rad): yaw about z is made last. Moments are about the origin of the body, by global axes.
    """

    def __init__(
        self,
        lines: Sequence[Line],
        anchors: ArrayLike,
        fairleads: ArrayLike,
    ) -> None:
        at = self._rows("anchors", anchors, ("x", "y")).tolist()
        points = self._rows("fairleads", fairleads, ("x", "y", "z")).tolist()
        self._system = _core.System([line._line for line in lines], at, points)

    @staticmethod
    def _rows(name: str, given: ArrayLike, columns: tuple[str, ...]) -> Floats:
        made = np.asarray(given, dtype=np.float64)
        if made.ndim == 1 and made.size == len(columns):
            made = made.reshape(1, -1)
        if made.ndim != 2 or made.shape[1] != len(columns):
            raise ValueError(f"{name} have the shape {made.shape}: a row for each line, of {', '.join(columns)}")
        return made

    @staticmethod
    def _poses(poses: ArrayLike) -> tuple[tuple[int, ...], Floats]:
        given = np.ascontiguousarray(poses, dtype=np.float64)
        if given.ndim == 0 or given.shape[-1] != 6:
            raise ValueError(f"poses have the shape {given.shape}: x, y, z, roll, pitch, yaw come last")
        return given.shape[:-1], given.reshape(-1, 6)

    def wrench(self, poses: ArrayLike) -> Floats:
        """Force (N) and moment (N m) of the lines on the body at each pose, of shape (..., 6)."""
        shape, flat = self._poses(poses)
        return self._system._wrench(flat).reshape((*shape, 6))

    def stiffness(self, poses: ArrayLike) -> Floats:
        """-d(wrench)/d(translation, small rotation by global axes) at each pose, of shape (..., 6, 6)."""
        shape, flat = self._poses(poses)
        return self._system._stiffness(flat).reshape((*shape, 6, 6))

    def tensions(self, poses: ArrayLike) -> Floats:
        """Tension of each line at its fairlead (N) at each pose, of shape (..., lines)."""
        shape, flat = self._poses(poses)
        return self._system._tensions(flat).reshape((*shape, len(self)))

    def __len__(self) -> int:
        return len(self._system)

    def __repr__(self) -> str:
        return repr(self._system)
