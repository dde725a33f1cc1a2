# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""When rigid bodies meet that move from one pose to another."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from . import _arrays, _core
from ._errors import OptionError
from ._mesh import MeshLike, as_core
from ._queries import Interval

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class Sweep:
    """How a rigid body moves from one pose, at time 0, to another, at time 1; immutable.

    Parameters
    ----------
    start, to : (4, 4) arrays; None: the identity
    path : "screw" or "straight"
        On a screw the body turns about an axis and glides along it at constant speed. On a straight path each vertex moves on a straight line,
        as in `find_impacts`: a body that turns is then not rigid on the way.
    turns : int
        Of a screw: whole turns beside the least angle, which is from 0 to half a turn; -1 is the other way round.

    Raises
    ------
    PoseError
        Another shape or type, or a last row other than 0 0 0 1. (Whether it is a rotation, `pose_at` and `time_of_impact` look.)
    OptionError
        Another path, or turns beyond 32 bits.

    Examples
    --------
    >>> import impinge
    >>> quarter = impinge.Sweep(None, [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]])
    >>> impinge.pose_at(quarter, 0.5).round(3).tolist()  # an eighth of a turn, and half of the way up
    [[0.707, -0.707, 0.0, 0.0], [0.707, 0.707, 0.0, 0.0], [0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 0.0, 1.0]]
    """

    __slots__ = ("_core", "_made_of")

    def __init__(
        self, start: ArrayLike | None, to: ArrayLike | None, *, path: Literal["screw", "straight"] = "screw", turns: int = 0
    ) -> None:
        if path not in ("screw", "straight"):
            raise OptionError(f"path is {path!r}; choose 'screw' or 'straight'")
        if not -(2**31) <= turns < 2**31:
            raise OptionError(f"turns is {turns}; choose a number of 32 bits")
        first, last = _arrays.pose(start, "start"), _arrays.pose(to, "to")
        self._core = _core.Sweep(first, last, path == "straight", turns)
        self._made_of = copy.deepcopy((first, last, path, turns))

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, self._made_of

    def __repr__(self) -> str:
        *_, path, turns = self._made_of
        return f"<impinge.Sweep: {path}{f', {turns} turns' if turns else ''}>"


def _unpickled(start: Any, to: Any, path: Any, turns: int) -> Sweep:
    return Sweep(start, to, path=path, turns=turns)


def at_rest(pose: ArrayLike | None = None) -> Sweep:
    """The sweep of a body that stands still, at a pose, (4, 4). Errors as `Sweep`.

    >>> import impinge
    >>> impinge.pose_at(impinge.at_rest(), [0.25, 1]).shape
    (2, 4, 4)
    """
    return Sweep(pose, pose)


def pose_at(sweep: Sweep, time: ArrayLike) -> NDArray[np.float64]:
    """The poses, (..., 4, 4), at times from 0 to 1, (...,), up to rounding: the sweep's own at 0 and 1.

    Raises
    ------
    PoseError
        A pose of the sweep is not a rotation and a translation.
    OptionError
        A time that is not from 0 to 1; turns of a straight path, or between poses that tell no axis; a straight path on which the body
        turns, where there are no poses.

    Examples
    --------
    >>> import impinge
    >>> up = impinge.Sweep(None, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 4], [0, 0, 0, 1]])
    >>> impinge.pose_at(up, [0, 0.25, 1])[:, 2, 3]
    array([0., 1., 4.])
    """
    times = _arrays.numbers(time, "time", OptionError)
    return np.asarray(_core.poses_at(_checked(sweep, "sweep"), times)).reshape(*times.shape, 4, 4)


class TimeOfImpact(NamedTuple):
    """The first contact of two bodies, or their first approach."""

    time: Interval  #: they share no point before `lo`
    gap: float  #: at `time.hi`; 0: they share a point then (straight paths: within `time`), exactly
    points: NDArray[np.float64]  #: (2, 3): where, one of a and one of b, up to rounding


def time_of_impact(
    a: MeshLike,
    b: MeshLike,
    sweep_a: Sweep,
    sweep_b: Sweep,
    tolerance: float,
    *,
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> TimeOfImpact | None:
    """When two rigid bodies that move first meet; None if they do not.

    On screws conservative: before `time.lo` no two triangles share a point, at no real time nor at any pose of `pose_at`; at `time.hi`, which is
    the same, they do, or are nearer than `tolerance`, in your unit of length, while some of them approach each other. What passes at a distance
    above the tolerance is never reported. The tolerance is raised to what rounding needs. On a straight path, beside another one or a screw that
    does not turn, exact for any tolerance, by `find_impacts`: `time` holds the first contact between equal or neighbouring doubles.

    Raises
    ------
    MeshError
        No mesh, or one without triangles.
    PoseError, RangeError
    OptionError
        A tolerance that is not above 0; no `Sweep`; sweeps as in `pose_at`, or a straight path beside a screw that turns.
    Cancelled, OutOfMemoryError

    Examples
    --------
    >>> import impinge
    >>> sheet = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> down = impinge.Sweep([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1]], [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -1], [0, 0, 0, 1]])
    >>> time, gap, points = impinge.time_of_impact(sheet, sheet, down, impinge.at_rest(), 1e-6)
    >>> 0.749999 < time.lo <= 0.75, gap < 1e-6
    (True, True)
    """
    cores = as_core(a, "a"), _checked(sweep_a, "sweep_a"), as_core(b, "b"), _checked(sweep_b, "sweep_b")
    found = _core.time_of_impact(*cores, tolerance, threads, stop)
    return None if found is None else TimeOfImpact(Interval(*found[0]), found[1], np.asarray(found[2]))


def _checked(sweep: Sweep, what: str) -> _core.Sweep:
    if not isinstance(sweep, Sweep):
        raise OptionError(f"{what} is no Sweep: {type(sweep).__name__}; of a body that stands still give at_rest(pose)")
    return sweep._core
