# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""The objects of `impinge.trimesh`: meshes at any affine transform. And the shortest way out of two convex ones."""

from __future__ import annotations

from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

import numpy as np

from . import _convex, _core
from ._clash import examine
from ._errors import MeshError
from ._mesh import Mesh, MeshLike, as_mesh
from ._queries import Location, locate, touches

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_hulls: WeakKeyDictionary[Mesh, _convex.Hull | None] = WeakKeyDictionary()
_closed: WeakKeyDictionary[Mesh, bool] = WeakKeyDictionary()


class CollisionObject:
    """A placed mesh."""

    def __init__(self, mesh: Mesh, convex: bool | None, transform: NDArray[np.float64]) -> None:
        self._base, self._convex = mesh, convex
        self._move(transform)

    def _move(self, transform: NDArray[np.float64]) -> None:
        """A rotation is a pose; one with rounding errors of single precision is made one; any other map is baked into the mesh."""
        off = _core.off_rotation(transform)
        mesh, pose = self._base, transform
        if not off <= 1e-4:
            pose = np.eye(4)
            pose[:3] = transform[:3]
            mesh, pose = mesh.transformed(pose), np.eye(4)
        elif off > 0.99e-6:  # poses are off by 1e-6 at most, in whatever order that is rounded
            u, _, v = np.linalg.svd(transform[:3, :3])
            pose = transform.copy()
            pose[:3, :3] = u @ v
        self._transform, self._mesh, self._pose = transform, mesh, pose
        self._hull: _convex.Hull | None = None
        self._known_bounds: tuple[NDArray[np.float64], NDArray[np.float64]] | None = None

    def _bounds(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """A box of the world around it, (2, 3), and a point of it, in floating point and so a little larger: they only choose what is looked at."""
        if self._known_bounds is None:
            mesh, turn, shift = self._mesh, self._pose[:3, :3], self._pose[:3, 3]
            low, high = mesh.bounds
            middle, half = turn @ ((low + high) / 2) + shift, np.abs(turn) @ ((high - low) / 2)
            half = half + 1e-9 * (1 + np.abs(middle) + half).max()
            corner = mesh.vertices[mesh.faces[0, 0]] if len(mesh.faces) else np.full(3, np.nan)
            self._known_bounds = np.array([middle - half, middle + half]), turn @ corner + shift
        return self._known_bounds

    @property
    def _box(self) -> NDArray[np.float64]:
        return self._bounds()[0]

    @property
    def _corner(self) -> NDArray[np.float64]:
        return self._bounds()[1]

    def getTranslation(self) -> NDArray[np.float64]:
        """(3,)"""
        return self._transform[:3, 3].copy()

    def getRotation(self) -> NDArray[np.float64]:
        """(3, 3)"""
        return self._transform[:3, :3].copy()

    def _placed_hull(self) -> _convex.Hull | None:
        """The world's hull if the mesh is convex, and trimesh says no else."""
        if self._hull is None and self._is_convex():
            hull = _hulls[self._mesh]
            self._hull = None if hull is None else hull.moved(self._pose)
        return self._hull

    def _is_convex(self) -> bool:
        if self._convex is False:
            return False
        if self._mesh not in _hulls:
            _hulls[self._mesh] = _convex.hull_of(self._mesh)
        return _hulls[self._mesh] is not None

    def _is_solid(self, which: str) -> bool:
        """Whether it is one of those that are solids: "convex", "closed" or "none"."""
        if which == "closed":
            if self._mesh not in _closed:
                _closed[self._mesh] = examine(self._mesh).closed
            return _closed[self._mesh]
        return which == "convex" and self._is_convex()

    def _corners(self, faces: NDArray[np.int32]) -> NDArray[np.float64]:
        """(K, 3, 3): the world corners of some faces."""
        corners = self._mesh.vertices[self._mesh.faces[faces]]
        world: NDArray[np.float64] = corners @ self._pose[:3, :3].T + self._pose[:3, 3]
        return world


def penetration(
    a: MeshLike,
    b: MeshLike,
    pose_a: ArrayLike | None = None,
    pose_b: ArrayLike | None = None,
    *,
    stop: _core.Stop | None = None,
) -> _convex.Penetration | None:
    """The shortest way out of two convex solids that share a point; None where they share none.

    That they do is exact; depth, normal and point, in your unit of length, are up to rounding. Of equally short ways out it is the one with
    the lexicographically smallest normal. Convex is one closed surface, turned outwards, with no edge that bends inwards by more than 1e-5
    of the size.

    Raises
    ------
    MeshError
        One is not convex.
    PoseError, RangeError, Cancelled

    Examples
    --------
    >>> import impinge
    >>> n = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    >>> a, b = impinge.Mesh([[0, 0, 0], [8, 0, 0], [0, 8, 0], [0, 0, 8]], n), impinge.Mesh([[0, 0, 0], [-8, 0, 0], [0, 8, 0], [0, 0, -8]], n)
    >>> found = impinge.penetration(a, b, None, [[1, 0, 0, 0.5], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1]])
    >>> found.depth, found.normal.tolist()
    (0.5, [-1.0, 0.0, 0.0])
    """
    meet = touches(a, b, pose_a, pose_b, stop=stop)
    one, other = place(a, pose_a), place(b, pose_b)
    hull, other_hull = one._placed_hull(), other._placed_hull()
    if hull is None or other_hull is None:
        raise MeshError(f"{'a' if hull is None else 'b'} is not convex; ask overlap_depth or judge")
    if not meet and not is_nested(one, other, "convex"):
        return None
    found = _convex.penetration(hull, other_hull, stop)
    return found._replace(depth=max(found.depth, 0.0))


def is_nested(a: CollisionObject, b: CollisionObject, which: str) -> bool:
    """Whether one of two whose surfaces are apart lies inside the other, which is one of those that are solids."""
    for outer, inner in ((a, b), (b, a)):
        if is_within(inner._corner, outer._box) and outer._is_solid(which):
            if locate(inner._corner, outer._mesh, outer._pose) == Location.INSIDE:
                return True
    return False


def is_within(points: NDArray[np.float64], box: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Of points, (..., 3), and boxes, (2, ..., 3)."""
    inside: NDArray[np.bool_] = ((box[0] <= points) & (points <= box[1])).all(axis=-1)
    return inside


def as_matrix(transform: ArrayLike | None) -> NDArray[np.float64]:
    if transform is None:
        return np.eye(4)
    matrix = np.array(transform, np.float64, order="C")
    if matrix.shape != (4, 4):
        raise ValueError("transform must be (4,4)!")
    return matrix


def place(mesh: MeshLike, transform: ArrayLike | None) -> CollisionObject:
    convex = getattr(mesh, "is_convex", None)
    return CollisionObject(as_mesh(mesh), convex, as_matrix(transform))
