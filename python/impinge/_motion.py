# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""When moving meshes meet: continuous collision detection."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from . import _arrays, _core
from ._errors import MeshError
from ._mesh import Mesh, MeshLike, as_core
from ._queries import Interval

if TYPE_CHECKING:
    from numpy.typing import NDArray

#: A mesh at time 0 and, with the same faces, at time 1.
Moving = tuple[MeshLike, MeshLike]


class Feature(IntEnum):
    """Which kinds of features meet. Every other way in which triangles come to touch is one of these too."""

    VERTEX_FACE = 0  #: a vertex of the first mesh and a face of the second; or, of a mesh with itself, any of it
    FACE_VERTEX = 1  #: a face of the first mesh and a vertex of the second
    EDGE_EDGE = 2


@dataclass(frozen=True, eq=False)
class Impacts:
    """Every vertex and face, and every two edges, that meet on the way; in the order of feature and ids. The arrays own their memory."""

    features: NDArray[np.uint8]  #: (K,): `Feature`
    ids: NDArray[np.int32]  #: (K, 2): a vertex or a face by its index, an edge by its row in `Mesh.edges`
    times: NDArray[np.float64]  #: (K, 2): hold the first time at which they meet between equal or neighbouring doubles
    points: NDArray[np.float64]  #: (K, 3): where, up to rounding
    normals: NDArray[np.float64]  #: (K, 3): unit, up to rounding: of the face or at right angles to both edges; to where the first comes from
    earliest: Interval | None  #: the first time of all, those beyond the limit too; (0, 0) if and only if something touches at the start
    truncated: bool  #: there are more than `limit`

    def __bool__(self) -> bool:
        """Whether anything meets."""
        return self.earliest is not None

    def __repr__(self) -> str:
        first = "" if self.earliest is None else f", the first at {self.earliest.lo}"
        return f"<impinge.Impacts: {len(self.features)}{first}{', truncated' if self.truncated else ''}>"


def find_impacts(
    a: Moving,
    b: Moving | None = None,
    *,
    earliest: bool = False,
    limit: int | None = None,
    end: float = 1.0,
    by_index: bool = False,
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> Impacts:
    """All impacts between two moving meshes, or without `b` of a mesh with itself, exactly: none missed, none added.

    Each mesh is a pair: itself at time 0, and at time 1 with the same faces (`Mesh.deformed`). Every vertex moves on a straight line at
    constant speed, (1 - t) x0 + t x1 in real arithmetic; coordinates, in your unit of length, may be any finite numbers. Touching counts.
    With `earliest` only the first impact is looked for; with `limit` the first so many in order are kept; times up to `end`, 0 to 1, are
    looked at. Of a mesh with itself features that share a vertex are left out; vertices count as one where they are equal at both ends,
    with `by_index` only where their index is.

    Raises
    ------
    MeshError
        No mesh; or the two ends have different faces or numbers of vertices.
    OptionError, Cancelled, OutOfMemoryError

    Examples
    --------
    >>> import impinge
    >>> floor = impinge.Mesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    >>> tip = impinge.Mesh([[1, 1, 3], [1, 2, 4], [2, 1, 4]], [[0, 1, 2]])
    >>> impacts = impinge.find_impacts((tip, tip.deformed(tip.vertices - [0, 0, 4])), (floor, floor))
    >>> impacts.earliest  # the lowest vertex is 3 above the floor and falls by 4
    Interval(lo=0.75, hi=0.75)
    >>> [(impinge.Feature(feature).name, ids.tolist()) for feature, ids in zip(impacts.features, impacts.ids)]
    [('VERTEX_FACE', [0, 0]), ('VERTEX_FACE', [1, 0]), ('VERTEX_FACE', [2, 0])]
    """
    first, second = _moving(a, "a"), None if b is None else _moving(b, "b")
    found = _core.find_impacts(first, second, earliest, end, by_index, _arrays.limit(limit), threads, stop)
    *arrays, time, truncated = found
    features, ids, times, points, normals = (np.asarray(array) for array in arrays)
    return Impacts(features, ids, times, points, normals, None if time is None else Interval(*time), truncated)


class Step(NamedTuple):
    """The part of a motion that leaves everything apart."""

    time: float  #: the end that was asked for, or less where something would meet before that
    ends: list[Mesh]  #: each mesh at that time


def collision_free_step(
    *meshes: Moving, end: float = 1.0, by_index: bool = False, threads: int = 0, stop: _core.Stop | None = None
) -> Step:
    """How far meshes may go together, each a pair as in `find_impacts`, without meeting each other or themselves.

    On the way to the ends, where vertices were rounded to, there is no impact either. Where something would meet, the time is at least
    (1 - 2^-10) of that of the first impact, or if rounding would make things touch there, the first of some smaller parts of which it does
    not: 0 where what meets is nearer than rounding can tell. What stands still is not tested against itself and what else stands still. `by_index` as in `find_impacts`.

    >>> import impinge
    >>> floor = impinge.Mesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    >>> tip = impinge.Mesh([[1, 1, 3], [1, 2, 4], [2, 1, 4]], [[0, 1, 2]])
    >>> time, ends = impinge.collision_free_step((tip, tip.deformed(tip.vertices - [0, 0, 4])), (floor, floor))
    >>> 0.749 < time < 0.75, ends[0].bounds[0, 2] > 0
    (True, True)

    Raises
    ------
    ContactError
        Something touches at the start.
    MeshError, RangeError, OptionError, Cancelled, OutOfMemoryError
    """
    moving = [_moving(mesh, f"meshes[{k}]") for k, mesh in enumerate(meshes)]
    time, ends = _core.collision_free_step(moving, end, by_index, threads, stop)
    return Step(time, [Mesh._wrap(core) for core in ends])


def _moving(mesh: Moving, what: str) -> _core.Moving:
    if not isinstance(mesh, (tuple, list)) or len(mesh) != 2:
        raise MeshError(f"{what} is no pair of meshes: give the mesh at time 0 and the mesh at time 1, (start, end)")
    return _core.Moving(as_core(mesh[0], f"{what}[0]"), as_core(mesh[1], f"{what}[1]"))
