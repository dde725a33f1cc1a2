# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""The exact predicates, of arrays of points that are broadcast against each other.

All sets are closed: triangles have their boundary, edges their ends; what is degenerate is the segment or point that it is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from . import _arrays, _core
from ._errors import OptionError, RangeError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


def orient3d(a: ArrayLike, b: ArrayLike, c: ArrayLike, d: ArrayLike, *, stop: _core.Stop | None = None) -> NDArray[np.int8]:
    """On which side of the plane of a, b, c the point d lies: the exact sign of det(b - a, c - a, d - a). (...,) of (..., 3) each.

    1: a, b, c appear counter-clockwise from d, which lies on the side that (b - a) x (c - a) points to; -1: on the other; 0: coplanar.

    Raises
    ------
    OptionError
        Another shape or type, or shapes that cannot be broadcast.
    RangeError
        A coordinate is not below 2^300.
    Cancelled

    Examples
    --------
    >>> import impinge
    >>> impinge.orient3d([0, 0, 0], [1, 0, 0], [0, 1, 0], [[0.25, 0.25, 1e-300], [5, 5, 0]])
    array([1, 0], dtype=int8)
    """
    rows = _rows({"a": (a, 1), "b": (b, 1), "c": (c, 1), "d": (d, 1)}, 2.0**300)
    return np.asarray(_core.orient3d(rows, stop)).reshape(rows.shape[:-2])


def triangles_meet(s: ArrayLike, t: ArrayLike, *, stop: _core.Stop | None = None) -> NDArray[np.int8]:
    """How triangles meet, exactly: `Kind`, or -1 where they share no point. (...,) of (..., 3, 3) each, a row a corner.

    Raises
    ------
    As `orient3d`.

    Examples
    --------
    >>> import impinge, numpy as np
    >>> s = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    >>> impinge.triangles_meet(s, [s + [0, 0, 1], s + [1, 0, 0], s + [0.5, 0, 0]])  # apart, at a corner, in a plane
    array([-1,  2,  2], dtype=int8)
    """
    rows = _rows({"s": (s, 3), "t": (t, 3)}, 2.0**300)
    return np.asarray(_core.triangles_meet(rows, stop)).reshape(rows.shape[:-2])


def vertex_face_impact(
    vertex_from: ArrayLike, face_from: ArrayLike, vertex_to: ArrayLike, face_to: ArrayLike, *, stop: _core.Stop | None = None
) -> NDArray[np.float64]:
    """The first time in [0, 1] at which a moving vertex, (..., 3), meets a moving face, (..., 3, 3), exactly: (..., 2).

    Each point moves on a straight line, from where it is in `..._from` at time 0 to where it is in `..._to` at time 1. The two numbers hold
    the time and are equal or neighbouring doubles; (0, 0) if and only if they meet at the start; NaN where they never meet.

    Raises
    ------
    As `orient3d`; RangeError only for what is not finite.

    Examples
    --------
    >>> import impinge
    >>> face = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    >>> impinge.vertex_face_impact([[0.25, 0.25, 1], [2, 2, 1]], face, [[0.25, 0.25, -1], [2, 2, -1]], face)
    array([[0.5, 0.5],
           [nan, nan]])
    """
    named = {"vertex_from": (vertex_from, 1), "face_from": (face_from, 3), "vertex_to": (vertex_to, 1), "face_to": (face_to, 3)}
    rows = _rows(named, np.inf)
    return np.asarray(_core.vertex_face_impact(rows, stop)).reshape(*rows.shape[:-2], 2)


def edge_edge_impact(
    a_from: ArrayLike, b_from: ArrayLike, a_to: ArrayLike, b_to: ArrayLike, *, stop: _core.Stop | None = None
) -> NDArray[np.float64]:
    """The first time in [0, 1] at which two moving edges, (..., 2, 3) each, meet: (..., 2), as `vertex_face_impact`.

    Raises
    ------
    As `vertex_face_impact`.

    Examples
    --------
    >>> import impinge, numpy as np
    >>> a, b = np.array([[-1, 0, 3], [1, 0, 3]]), np.array([[0, -1, 0], [0, 1, 0]])
    >>> impinge.edge_edge_impact(a, b, a - [0, 0, 4], b)
    array([0.75, 0.75])
    """
    rows = _rows({"a_from": (a_from, 2), "b_from": (b_from, 2), "a_to": (a_to, 2), "b_to": (b_to, 2)}, np.inf)
    return np.asarray(_core.edge_edge_impact(rows, stop)).reshape(*rows.shape[:-2], 2)


def _rows(named: dict[str, tuple[ArrayLike, int]], below: float) -> NDArray[np.float64]:
    """(..., P, 3): the points of each in turn; so many belong to each, of the shape (..., 3) for one and else (..., n, 3)."""
    arrays = []
    for what, (values, count) in named.items():
        array = _arrays.points(values, what, OptionError)
        if count > 1 and array.shape[-2:-1] != (count,):
            raise OptionError(f"{what} has the shape {array.shape}, not (..., {count}, 3)")
        if not (np.abs(array) < below).all():
            limit = "a finite number" if below == np.inf else "below 2^300"
            raise RangeError(f"{what} has a coordinate that is not {limit}; scale your coordinates")
        arrays.append(array[..., None, :] if count == 1 else array)
    try:
        shape = np.broadcast_shapes(*(array.shape[:-2] for array in arrays))
    except ValueError:
        shapes = ", ".join(f"{what} {array.shape[:-2]}" for what, array in zip(named, arrays))
        raise OptionError(f"the shapes cannot be broadcast, but for the points' own: {shapes}") from None
    rows = np.concatenate([np.broadcast_to(array, shape + array.shape[-2:]) for array in arrays], axis=-2)
    return np.ascontiguousarray(rows)
