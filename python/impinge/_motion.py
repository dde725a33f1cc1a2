# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""When moving meshes meet: continuous collision detection."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Hashable, NamedTuple

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
    times: NDArray[np.float64]  #: (K, 2): hold the first time at which they meet, or come within `separation`, between equal or neighbouring doubles
    points: NDArray[np.float64]  #: (K, 3): where, up to rounding
    normals: NDArray[np.float64]  #: (K, 3): unit, up to rounding: of the face or at right angles to both edges, to where the first comes from; with `separation` from the nearest point of the second to that of the first
    earliest: Interval | None  #: the first time of all, those beyond the limit too; (0, 0) if and only if something touches, or is within `separation`, at the start
    truncated: bool  #: there are more than `limit`

    def __bool__(self) -> bool:
        """Whether anything meets."""
        return self.earliest is not None

    def __repr__(self) -> str:
        first = "" if self.earliest is None else f", the first at {self.earliest.lo}"
        return f"<impinge.{type(self).__name__}: {len(self.features)}{first}{', truncated' if self.truncated else ''}>"


@dataclass(frozen=True, eq=False, repr=False)
class SceneImpacts(Impacts):
    """All impacts of a scene's objects, a row a pair of objects that meet, in the order of rows, feature and ids."""

    objects: NDArray[np.int32]  #: (R, 2): indices, as in `Contacts`; in `ids` the first object's feature comes first
    offsets: NDArray[np.int64]  #: (R + 1,): row r holds impacts offsets[r] to offsets[r + 1]
    hash: int  #: 64 bits, of what is here
    names: tuple[tuple[Hashable, Hashable], ...]  #: R: the objects of each row; twice the same of an object with itself

    def rows(self) -> NDArray[np.int64]:
        """(K,): the row of each impact."""
        return np.repeat(np.arange(len(self.objects)), np.diff(self.offsets))


def make_motion_options(
    earliest: bool, end: float, by_index: bool, separation: float, limit: int | None, threads: int
) -> _core.MotionOptions:
    return _core.MotionOptions(earliest, end, by_index, separation, _arrays.limit(limit), threads)


def _fields(found: tuple[Any, ...]) -> tuple[Any, ...]:
    """What `Impacts` is made of."""
    *arrays, time, truncated = found
    return *map(np.asarray, arrays), None if time is None else Interval(*time), truncated


def make_scene_impacts(found: tuple[Any, ...], name_of: dict[int, Hashable]) -> SceneImpacts:
    objects, offsets, hashed, impacts = found
    rows = np.asarray(objects)
    names = tuple((name_of[a], name_of[b]) for a, b in rows.tolist())
    return SceneImpacts(*(*_fields(impacts), rows, np.asarray(offsets), hashed, names))


def find_impacts(
    a: Moving,
    b: Moving | None = None,
    *,
    earliest: bool = False,
    limit: int | None = None,
    end: float = 1.0,
    by_index: bool = False,
    separation: float = 0.0,
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> Impacts:
    """All impacts between two moving meshes, or without `b` of a mesh with itself, exactly without a `separation`: none missed, none added.

    Each mesh is a pair: itself at time 0, and at time 1 with the same faces (`Mesh.deformed`). Every vertex moves on a straight line at
    constant speed, (1 - t) x0 + t x1 in real arithmetic; coordinates, in your unit of length, may be any finite numbers. Touching counts.
    With `earliest` only the first impact is looked for; with `limit` the first so many in order are kept; times up to `end`, 0 to 1, are
    looked at. Of a mesh with itself features that share a vertex are left out; vertices count as one where they are equal at both ends,
    with `by_index` only where their index is.

    With a `separation` above 0, in your unit, features meet where they come within it: none that does is missed, and none found that stays
    farther apart than it and a tolerance of 2^-10 of it (and 2^-32 of the features' size). The numbers of each time are then equal: before it they
    are farther apart than the separation. Of a mesh with itself, features of triangles with a common vertex are tested with 0.

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
    options = make_motion_options(earliest, end, by_index, separation, limit, threads)
    return Impacts(*_fields(_core.find_impacts(first, second, options, stop)))


class Step(NamedTuple):
    """The part of a motion that leaves everything apart."""

    time: float  #: the end that was asked for, or less where something would meet before that
    ends: list[Mesh]  #: each mesh at that time


def collision_free_step(
    *meshes: Moving,
    end: float = 1.0,
    by_index: bool = False,
    separation: float = 0.0,
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> Step:
    """How far meshes may go together, each a pair as in `find_impacts`, without meeting each other or themselves.

    On the way to the ends, where vertices were rounded to, there is no impact either. Where something would meet, the time is at least
    (1 - 2^-10) of that of the first impact, or if rounding would make things touch there, the first of some smaller parts of which it does
    not: 0 where what meets is nearer than rounding can tell. What stands still is not tested against itself and what else stands still. `by_index` and `separation`, which is kept, as in `find_impacts`.

    >>> import impinge
    >>> floor = impinge.Mesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    >>> tip = impinge.Mesh([[1, 1, 3], [1, 2, 4], [2, 1, 4]], [[0, 1, 2]])
    >>> time, ends = impinge.collision_free_step((tip, tip.deformed(tip.vertices - [0, 0, 4])), (floor, floor))
    >>> 0.749 < time < 0.75, float(ends[0].bounds[0, 2]) > 0
    (True, True)

    Raises
    ------
    ContactError
        Something touches at the start, or is within the separation.
    MeshError, RangeError, OptionError, Cancelled, OutOfMemoryError
    """
    moving = [_moving(mesh, f"meshes[{k}]") for k, mesh in enumerate(meshes)]
    time, ends = _core.collision_free_step(moving, make_motion_options(False, end, by_index, separation, None, threads), stop)
    return Step(time, [Mesh._wrap(core) for core in ends])


def _moving(mesh: Moving, what: str) -> _core.Moving:
    if not isinstance(mesh, (tuple, list)) or len(mesh) != 2:
        raise MeshError(f"{what} is no pair of meshes: give the mesh at time 0 and the mesh at time 1, (start, end)")
    return _core.Moving(as_core(mesh[0], f"{what}[0]"), as_core(mesh[1], f"{what}[1]"))
