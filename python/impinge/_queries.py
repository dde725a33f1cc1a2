# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Questions about two meshes.

Poses are (4, 4) matrices that map column vectors, rotations with a translation, last row 0 0 0 1; None is the identity.
`threads` is how many threads at most, 0 for all there are. `stop` is a `Stop` by which any thread ends the query.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Hashable, Iterable, NamedTuple

import numpy as np

from . import _arrays, _core, _show
from ._errors import ImpingeWarning, MeshError
from ._mesh import MeshLike, as_core, as_mesh, placed

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class Kind(IntEnum):
    """How two triangles meet."""

    CROSSING = 0  #: both proper, planes differ, relative interiors meet
    TOUCHING = 1  #: all that is neither of the others
    COPLANAR = 2  #: both proper, in one plane, sharing a point


class Location(IntEnum):
    """Where a point lies to a closed mesh."""

    OUTSIDE = 0
    INSIDE = 1
    BOUNDARY = 2


@dataclass(frozen=True, eq=False)
class Contacts:
    """Every pair of triangles that share a point, a row a pair of objects, in canonical order. The arrays own their memory.

    >>> import impinge
    >>> sheet = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> scene = impinge.Scene()
    >>> below, above = scene.add(sheet, name="below"), scene.add(sheet, name="above")
    >>> contacts = scene.collide()
    >>> for (a, b), begin, end in zip(contacts.names, contacts.offsets, contacts.offsets[1:]):
    ...     print(a, b, contacts.pairs[begin:end].tolist())
    below above [[0, 0]]
    """

    objects: NDArray[np.int32]  #: (R, 2): `collide`: one row 0, 1 or none; `collide_poses`: the indices of the poses; scenes: indices
    offsets: NDArray[np.int64]  #: (R + 1,): row r holds pairs offsets[r] to offsets[r + 1]
    pairs: NDArray[np.int32]  #: (K, 2): a triangle of the row's first object and one of its second
    kinds: NDArray[np.uint8]  #: (K,): `Kind`
    truncated: bool  #: there are more than `limit`
    hash: int  #: 64 bits, of what is here; 0 with `first`
    names: tuple[tuple[Hashable, Hashable], ...] | None = None  #: of scenes: the objects of each row; None: a mesh not in it

    def __bool__(self) -> bool:
        """Whether anything touches."""
        return len(self.kinds) > 0

    def rows(self) -> NDArray[np.int64]:
        """(K,): the row of each pair."""
        return np.repeat(np.arange(len(self.objects)), np.diff(self.offsets))

    def _repr_html_(self) -> str:
        return _show.table_of_contacts(self)

    def __repr__(self) -> str:
        more = ", truncated" if self.truncated else ""
        return f"<impinge.Contacts: {len(self.kinds)} pairs of triangles in {len(self.objects)} rows{more}>"


class Nearest(NamedTuple):
    """Two points that are nearest to each other."""

    distance: float  #: 0 if and only if the meshes share a point
    error: float  #: the exact distance is within so much of it
    points: NDArray[np.float64]  #: (2, 3): one of a, one of b
    faces: tuple[int, int]  #: on which they lie


class Interval(NamedTuple):
    """A number known to lie between two others."""

    lo: float
    hi: float


class OverlapDepth(NamedTuple):
    """How deep the boundary of each solid reaches into the other. Not the shortest way to pull the two apart."""

    a_in_b: Interval
    b_in_a: Interval

    @property
    def depth(self) -> float:
        """What is certain: the larger of both that each reaches at least."""
        return max(self.a_in_b.lo, self.b_in_a.lo)


class OverlapVolume(NamedTuple):
    """The volume that two solids have in common."""

    volume: float
    error: float  #: it is off by no more, but for rounding


def make_options(
    first: bool,
    limit: int | None,
    kinds: Kind | Iterable[Kind] | None,
    threads: int,
    backend: str,
    device: str,
    by_index: bool = False,
) -> _core.Options:
    return _core.Options(first, _arrays.limit(limit), _arrays.kinds(kinds), threads, backend, device, by_index)


def make_contacts(found: tuple[Any, ...], name_of: dict[int, Hashable] | None = None) -> Contacts:
    objects, offsets, pairs, kinds, truncated, hashed, messages = found
    for message in messages:
        warnings.warn(message, ImpingeWarning, stacklevel=3)
    rows = np.asarray(objects)
    names = None if name_of is None else tuple((name_of[a], name_of.get(b)) for a, b in rows.tolist())
    return Contacts(rows, np.asarray(offsets), np.asarray(pairs), np.asarray(kinds), truncated, hashed, names)


def rows_of(found: Any) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
    """The objects and offsets of contacts or impacts, as the extension takes them: somebody may have changed them."""
    return np.require(found.objects, np.int32, ["C", "A"]), np.require(found.offsets, np.int64, ["C", "A"])


def make_nearest(found: tuple[Any, ...]) -> Nearest:
    return Nearest(found[0], found[1], np.asarray(found[2]), found[3])


def make_depth(found: tuple[float, float, float, float]) -> OverlapDepth:
    return OverlapDepth(Interval(*found[:2]), Interval(*found[2:]))


def collide(
    a: MeshLike,
    b: MeshLike,
    pose_a: ArrayLike | None = None,
    pose_b: ArrayLike | None = None,
    *,
    first: bool = False,
    limit: int | None = None,
    kinds: Kind | Iterable[Kind] | None = None,
    threads: int = 0,
    backend: str = "auto",
    device: str = "",
    stop: _core.Stop | None = None,
) -> Contacts:
    """Every pair of triangles of two meshes that share a point, exactly.

    It is about surfaces: a solid wholly inside another touches nothing (`judge`). With `first` at most one pair; with `limit` the
    first so many in canonical order; with `kinds` those alone. Backends, "auto", "simd", "paper", "gpu", "raster" and "hybrid",
    answer the same; `device` is the number of a device (`devices`) or a part of its name.

    >>> import impinge
    >>> sheet = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> contacts = impinge.collide(sheet, sheet, None, [[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])  # corner to corner
    >>> contacts.pairs.tolist(), impinge.Kind(contacts.kinds[0]).name
    ([[0, 0]], 'COPLANAR')

    Raises
    ------
    MeshError, PoseError, OptionError, Cancelled, OutOfMemoryError
    RangeError
        A world coordinate is not below 2^300, or the mesh's largest is neither 0 nor at least 2^-300.
    NoDeviceError
        The backend needs a device, and there is none.
    """
    options = make_options(first, limit, kinds, threads, backend, device)
    return make_contacts(_core.collide(*placed(a, b, pose_a, pose_b), options, stop))


def self_collide(
    mesh: MeshLike,
    pose: ArrayLike | None = None,
    *,
    by_index: bool = False,
    first: bool = False,
    limit: int | None = None,
    kinds: Kind | Iterable[Kind] | None = None,
    threads: int = 0,
    backend: str = "auto",
    device: str = "",
    stop: _core.Stop | None = None,
) -> Contacts:
    """Every pair of triangles i < j of one mesh that share a point beyond the vertices which they have in common, exactly.

    Neighbours are there where they go through each other or are folded flat onto each other, not for being neighbours: pairs that share a
    point outside of the convex hull of their common vertices, or have all three in common. Vertices are common where they are equal;
    with `by_index` only where their index is, so that the two sides of a seam touch. The one row is of objects 0 and 0. Options as `collide`.

    Raises
    ------
    As `collide`.

    Examples
    --------
    >>> import impinge
    >>> fan = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0.5, 0]]  # the second triangle lies on the first
    >>> impinge.self_collide((fan, [[0, 1, 2], [0, 1, 3]])).pairs
    array([[0, 1]], dtype=int32)
    """
    options = make_options(first, limit, kinds, threads, backend, device, by_index)
    return make_contacts(_core.self_collide(as_core(mesh, "mesh"), _arrays.pose(pose, "pose"), options, stop))


def touches(
    a: MeshLike,
    b: MeshLike,
    pose_a: ArrayLike | None = None,
    pose_b: ArrayLike | None = None,
    *,
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> bool:
    """Whether any two triangles of two meshes share a point, exactly; the search stops at the first that do.

    >>> import impinge
    >>> sheet = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> impinge.touches(sheet, sheet, None, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1e-09], [0, 0, 0, 1]])
    False

    Raises
    ------
    As `collide`.
    """
    return _core.touches(*placed(a, b, pose_a, pose_b), threads, stop)


def collide_poses(
    a: MeshLike,
    b: MeshLike,
    poses_a: ArrayLike | None = None,
    poses_b: ArrayLike | None = None,
    *,
    first: bool = False,
    limit: int | None = None,
    kinds: Kind | Iterable[Kind] | None = None,
    threads: int = 0,
    backend: str = "auto",
    device: str = "",
    stop: _core.Stop | None = None,
) -> Contacts:
    """The same at many poses, (N, 4, 4) each, or one for all of the other's: row k is about pose k, touching or not.

    `limit` is for the call as a whole.

    >>> import impinge, numpy as np
    >>> sheet = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> poses = np.tile(np.eye(4), (3, 1, 1))
    >>> poses[:, 0, 3] = [0, 1, 2]
    >>> impinge.collide_poses(sheet, sheet, None, poses).offsets.tolist()  # one pair at each of the first two
    [0, 1, 2, 2]

    Raises
    ------
    As `collide`; OptionError also if the numbers of poses do not match.
    """
    options = make_options(first, limit, kinds, threads, backend, device)
    at, bt = _arrays.poses(poses_a, "poses_a"), _arrays.poses(poses_b, "poses_b")
    return make_contacts(_core.collide_poses(as_core(a, "a"), at, as_core(b, "b"), bt, options, stop))


def touches_poses(
    a: MeshLike,
    b: MeshLike,
    poses_a: ArrayLike | None = None,
    poses_b: ArrayLike | None = None,
    *,
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> NDArray[np.bool_]:
    """(N,): for each pose whether any two triangles share a point.

    >>> import impinge, numpy as np
    >>> sheet = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> poses = np.tile(np.eye(4), (3, 1, 1))
    >>> poses[:, 0, 3] = [0, 1, 2]
    >>> impinge.touches_poses(sheet, sheet, None, poses)
    array([ True,  True, False])

    Raises
    ------
    As `collide_poses`.
    """
    found = collide_poses(a, b, poses_a, poses_b, first=True, threads=threads, stop=stop)
    return np.diff(found.offsets) > 0


def distance(
    a: MeshLike,
    b: MeshLike,
    pose_a: ArrayLike | None = None,
    pose_b: ArrayLike | None = None,
    *,
    stop_above: float = float("inf"),
    enough_below: float = 0.0,
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> Nearest | None:
    """The nearest points of two meshes, as sets of triangles: what closed ones enclose does not count.

    None if they are farther apart than `stop_above`; where the distance is below `enough_below`, any below it may be given, sooner.

    >>> import impinge
    >>> sheet = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> impinge.distance(sheet, sheet, None, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]]).distance
    2.0

    Raises
    ------
    As `collide`; MeshError also for a mesh without triangles.
    """
    options = _core.DistanceOptions(stop_above, enough_below, threads)
    found = _core.distance(*placed(a, b, pose_a, pose_b), options, stop)
    return None if found is None else make_nearest(found)


def closer_than(
    a: MeshLike,
    b: MeshLike,
    limit: float,
    pose_a: ArrayLike | None = None,
    pose_b: ArrayLike | None = None,
    *,
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> bool:
    """Whether some points of two meshes are nearer to each other than `limit`. Much faster than the distance itself.

    >>> import impinge
    >>> sheet = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> impinge.closer_than(sheet, sheet, 1.5, None, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]])
    False

    Raises
    ------
    As `distance`; OptionError also for a limit that is negative or not a number.
    """
    return _core.closer_than(*placed(a, b, pose_a, pose_b), limit, threads, stop)


class PointLocator:
    """A closed mesh at a pose, prepared so that many points are located fast; immutable, safe to use from many threads.

    >>> import impinge
    >>> tetrahedron = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> locator = impinge.PointLocator(tetrahedron)
    >>> [impinge.Location(where).name for where in locator.locate([[0.1, 0.1, 0.1], [0.5, 0.5, 0], [1, 1, 1]])]
    ['INSIDE', 'BOUNDARY', 'OUTSIDE']

    Raises
    ------
    As `collide`; MeshError also for a mesh that is not closed.
    """

    def __init__(
        self, mesh: MeshLike, pose: ArrayLike | None = None, *, threads: int = 0, stop: _core.Stop | None = None
    ) -> None:
        self._mesh, self._pose = as_mesh(mesh), _arrays.pose(pose, "pose")
        self._core = _core.PointLocator(self._mesh._core, self._pose, threads, stop)

    def locate(self, points: ArrayLike, *, threads: int = 0, stop: _core.Stop | None = None) -> NDArray[np.uint8]:
        """Where points, (..., 3), lie, exactly: (...,) of `Location`.

        Raises
        ------
        MeshError
            Another shape or type.
        RangeError
            A coordinate is not below 2^300.
        OptionError, Cancelled, OutOfMemoryError
        """
        array = _arrays.points(points, "points", MeshError)
        return np.asarray(self._core.locate(array, threads, stop)).reshape(array.shape[:-1])

    def __reduce__(self) -> tuple[Any, ...]:
        return PointLocator, (self._mesh, self._pose)


def locate(
    points: ArrayLike, mesh: MeshLike, pose: ArrayLike | None = None, *, threads: int = 0, stop: _core.Stop | None = None
) -> NDArray[np.uint8]:
    """Where points, (..., 3), lie to a closed mesh, exactly: (...,) of `Location`. Ask for many at once, or a `PointLocator` again and again.

    Raises
    ------
    As `PointLocator` and its `locate`.

    Examples
    --------
    >>> import impinge
    >>> tetrahedron = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    >>> impinge.Location(impinge.locate([0.1, 0.1, 0.1], tetrahedron)).name
    'INSIDE'
    """
    return PointLocator(mesh, pose, threads=threads, stop=stop).locate(points, threads=threads, stop=stop)


def overlap_depth(
    a: MeshLike,
    b: MeshLike,
    pose_a: ArrayLike | None = None,
    pose_b: ArrayLike | None = None,
    *,
    precision: float = 0.01,
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> OverlapDepth:
    """How deep the boundary of each closed mesh reaches into the other: intervals that hold it for certain.

    `precision`, in (0, 1], is how wide they may be relative to the depth.

    >>> import impinge
    >>> tetrahedron = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> found = impinge.overlap_depth(tetrahedron, tetrahedron, None, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.75], [0, 0, 0, 1]])
    >>> found.a_in_b.hi >= found.a_in_b.lo > 0
    True

    Raises
    ------
    As `locate`.
    """
    return make_depth(_core.overlap_depth(*placed(a, b, pose_a, pose_b), precision, threads, stop))


def overlap_volume(
    a: MeshLike,
    b: MeshLike,
    pose_a: ArrayLike | None = None,
    pose_b: ArrayLike | None = None,
    *,
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> OverlapVolume:
    """The volume that two closed meshes have in common.

    >>> import impinge
    >>> tetrahedron = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> round(6 * impinge.overlap_volume(tetrahedron, tetrahedron, None, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.5], [0, 0, 0, 1]]).volume, 6)  # halved in size
    0.125

    Raises
    ------
    As `locate`.
    """
    return OverlapVolume(*_core.overlap_volume(*placed(a, b, pose_a, pose_b), threads, stop))
