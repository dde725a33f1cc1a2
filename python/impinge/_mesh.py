# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, Union

import numpy as np

from . import _arrays, _core
from ._errors import MeshError, OptionError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class HasVerticesFaces(Protocol):
    """A mesh of another library: trimesh's has faces; open3d's, with triangles instead, is taken too."""

    @property
    def vertices(self) -> Any: ...

    @property
    def faces(self) -> Any: ...


class Mesh:
    """An immutable triangle mesh, with a tree that queries make and keep; safe to use from many threads.

    >>> import impinge
    >>> impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    <impinge.Mesh: 4 vertices, 4 faces>

    Parameters
    ----------
    vertices : (V, 3) array of finite coordinates, in your unit of length; or a mesh of another library, or (vertices, faces)
        Any layout, real type and byte order. Floats not wider than float32 count as single precision, of which automatic
        tolerances (`judge`) take account.
    faces : (F, 3) array of vertex indices, counted from 0
        Any integer type. Degenerate and duplicate triangles are kept and count.
    leaf_size : int
        Most triangles in a leaf of the tree, 1 to 256; 0: what is fastest. It changes no answer.

    Raises
    ------
    MeshError
        Another shape or type, a coordinate that is not finite or no double, an index out of range.
    """

    __slots__ = ("_bounds", "_core", "_leaf_size", "__weakref__")
    _bounds: NDArray[np.float64]

    def __init__(self, vertices: ArrayLike | MeshLike, faces: ArrayLike | None = None, *, leaf_size: int = 0) -> None:
        if faces is None:
            vertices, faces = _parts(vertices)
        points = _arrays.vertices(vertices)  # type: ignore[arg-type]
        self._set(points, _arrays.faces(faces, len(points)), leaf_size, points.dtype == np.float32)

    def _set(self, points: NDArray[Any], triangles: NDArray[np.uint32], leaf_size: int, single: bool) -> None:
        if not 0 <= leaf_size <= 256:
            raise OptionError(f"leaf_size is {leaf_size}; choose 1 to 256, or 0 for what is fastest")
        self._core = _core.Mesh(points, triangles, leaf_size, points.dtype == np.float32, single)
        self._leaf_size = leaf_size

    @property
    def vertices(self) -> NDArray[np.float64]:
        """(V, 3), read-only, without a copy."""
        return np.asarray(self._core.vertices())

    @property
    def faces(self) -> NDArray[np.int32]:
        """(F, 3), read-only, without a copy."""
        return np.asarray(self._core.triangles())

    @property
    def edges(self) -> NDArray[np.int32]:
        """(E, 2), read-only, without a copy: the edges of its faces, (larger, smaller) vertex, ascending, each once. `Impacts` names them by row."""
        return np.asarray(self._core.edges())

    @property
    def bounds(self) -> NDArray[np.float64]:
        """(2, 3), read-only: the lowest and highest coordinates of vertices in use; NaN if none is."""
        if not hasattr(self, "_bounds"):
            used = self.vertices[np.unique(self.faces)]
            bounds = np.array([used.min(axis=0), used.max(axis=0)]) if len(used) else np.full((2, 3), np.nan)
            bounds.flags.writeable = False
            object.__setattr__(self, "_bounds", bounds)
        return self._bounds

    @property
    def nbytes(self) -> int:
        """What it holds in memory now: numbers and tree."""
        return self.vertices.nbytes + self.faces.nbytes + self._core.memory_bytes()

    def transformed(self, matrix: ArrayLike) -> Mesh:
        """With every vertex mapped by an affine (4, 4) matrix: any scale, shear or mirror. Answers are the same bit for bit as
        if a rigid map had been a pose. Mirroring keeps the order of vertices.

        >>> import impinge
        >>> mesh = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> mesh.transformed([[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 2, 5], [0, 0, 0, 1]]).bounds.tolist()
        [[0.0, 0.0, 5.0], [2.0, 2.0, 5.0]]

        Raises
        ------
        PoseError
            Not (4, 4), not finite, or a last row other than 0 0 0 1.
        RangeError
            A vertex is mapped beyond the range of doubles.
        """
        return self._wrap(self._core.transformed(_arrays.matrix(matrix, "matrix")), self._leaf_size)

    def deformed(self, vertices: ArrayLike, *, stop: _core.Stop | None = None) -> Mesh:
        """The same faces with other vertices, (V, 3), as many as there are, in your unit of length.

        Answers are those of a new mesh of these numbers, but where queries or `build_tree` have made a
        third of this one's tree, it is refitted, which is faster. A mesh that was refitted itself passes on
        what it was refitted by, unless more than an eighth of its tree had to be made anew.

        Raises
        ------
        MeshError
            Another shape or type, or a coordinate that is not finite.
        Cancelled
            `stop` and Ctrl-C are heard before the work begins, not during it.

        Examples
        --------
        >>> import impinge
        >>> mesh = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> mesh.deformed(mesh.vertices + [0, 0, 2]).bounds.tolist()
        [[0.0, 0.0, 2.0], [1.0, 1.0, 2.0]]
        """
        points = _arrays.vertices(vertices).astype(np.float64, copy=False)
        return self._wrap(self._core.deformed(points, stop), self._leaf_size)

    def build_tree(self, threads: int = 0) -> Mesh:
        """Makes the whole tree now, on so many threads (0: all), and returns the mesh. Queries else make what they need of it; a child
        process that is forked just then may wait for ever when it asks about the mesh, so make trees before forking."""
        self._core.build_tree(threads)
        return self

    @classmethod
    def _wrap(cls, core: _core.Mesh, leaf_size: int = 0) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._core, mesh._leaf_size = core, leaf_size
        return mesh

    def __setattr__(self, name: str, value: Any) -> None:
        if hasattr(self, "_leaf_size"):
            raise AttributeError(f"a Mesh never changes; make another one instead of setting {name}")
        object.__setattr__(self, name, value)

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self.vertices, self.faces, self._leaf_size, self._core.is_single())

    def __repr__(self) -> str:
        return f"<impinge.Mesh: {len(self.vertices)} vertices, {len(self.faces)} faces>"


MeshLike = Union[Mesh, HasVerticesFaces, "tuple[ArrayLike, ArrayLike]"]


def _unpickled(vertices: NDArray[np.float64], faces: NDArray[np.int32], leaf_size: int, single: bool) -> Mesh:
    mesh = Mesh.__new__(Mesh)
    mesh._set(vertices, _arrays.faces(faces, len(vertices)), leaf_size, single)
    return mesh


def _parts(mesh: Any) -> tuple[Any, Any]:
    """The vertices and faces of what stands for a mesh."""
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return mesh[0], mesh[1]
    faces = getattr(mesh, "faces", None)
    if faces is None:
        faces = getattr(mesh, "triangles", None)
    if not hasattr(mesh, "vertices") or faces is None:
        raise MeshError(f"{type(mesh).__name__} is no mesh: give a Mesh, (vertices, faces), or what has .vertices and .faces")
    return mesh.vertices, faces


def as_mesh(mesh: MeshLike) -> Mesh:
    """The mesh that something stands for."""
    return mesh if isinstance(mesh, Mesh) else Mesh(mesh)


def as_core(mesh: MeshLike, what: str) -> _core.Mesh:
    """The library's mesh of what stands for one; errors name it."""
    try:
        return as_mesh(mesh)._core
    except MeshError as problem:
        raise MeshError(f"{what}: {problem}") from None


def placed(
    a: MeshLike, b: MeshLike, pose_a: ArrayLike | None, pose_b: ArrayLike | None
) -> tuple[_core.Mesh, NDArray[np.float64] | None, _core.Mesh, NDArray[np.float64] | None]:
    """The first arguments of the extension's queries on two meshes."""
    at, bt = _arrays.pose(pose_a, "pose_a"), _arrays.pose(pose_b, "pose_b")
    return as_core(a, "a"), at, as_core(b, "b"), bt
