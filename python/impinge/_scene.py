# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
from __future__ import annotations

import os
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Hashable, Iterable, Iterator, Literal, NamedTuple, Sequence, overload
from weakref import WeakSet

import numpy as np

from . import _arrays, _core, _show
from ._errors import OptionError, UnknownObjectError
from ._mesh import Mesh, MeshLike, as_core
from ._queries import Contacts, Kind, Nearest, make_contacts, make_nearest, make_options

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class ObjectDistance(NamedTuple):
    """The two objects of a scene that are nearest to each other."""

    objects: tuple[Hashable, Hashable]  #: their names
    nearest: Nearest


@dataclass(frozen=True, eq=False)
class Configurations:
    """What was found of many configurations, with a witness of each that touches; which of several is open."""

    touches: NDArray[np.bool_]  #: (T,)
    names: tuple[tuple[Hashable, Hashable] | None, ...]  #: T: two objects that touch; None: none do
    faces: NDArray[np.int32]  #: (T, 2): a triangle of each of the two that touch; -1: none do


class _Object:
    """What the scene knows of one object; its pose is in the library."""

    __slots__ = ("filter", "group", "id", "mesh", "self_too")

    def __init__(self, id: int, mesh: Mesh, group: int) -> None:
        self.id, self.mesh, self.group = id, mesh, group
        self.filter: tuple[int, int] | None = None
        self.self_too = False


class Scene:
    """Placed meshes that are asked about again and again, by names of yours.

    Safe to use from many threads: queries run side by side, changes wait for them. Pickles, and so copies by `copy.copy`.

    >>> import impinge
    >>> sheet = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> scene = impinge.Scene()
    >>> floor, lid = scene.add(sheet, name="floor"), scene.add(sheet, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]], name="lid")
    >>> scene.touches_any()
    False
    >>> scene.set_pose("lid", None)
    >>> scene.collide().names
    (('floor', 'lid'),)
    """

    def __init__(self) -> None:
        self._core = _core.Scene()
        self._objects: dict[Hashable, _Object] = {}
        self._name_of: dict[int, Hashable] = {}  # by the library's index
        self._ignored: dict[frozenset[Hashable], tuple[Hashable, Hashable]] = {}
        self._next = 0
        self._stale = False
        _scenes.add(self)

    # --- objects

    def add(self, mesh: MeshLike, pose: ArrayLike | None = None, *, name: Hashable = None, group: int = 0) -> Hashable:
        """Adds a mesh and returns its name: the next number that is free if you give none.

        Objects of one group that is not 0 are not tested against each other.

        Raises
        ------
        MeshError, PoseError
        OptionError
            The name is taken, or the group not between 0 and 2^32 - 1.
        """
        mesh, matrix = _as_mesh(mesh), _arrays.pose(pose, "pose")
        if not 0 <= group < 2**32:
            raise OptionError(f"group is {group}; choose 0 to 2^32 - 1")
        with _core.Writing(self._core):
            if name is None:
                while self._next in self._objects:
                    self._next += 1
                name = self._next
            elif name in self._objects:
                raise OptionError(f"the scene has an object {name!r} already; remove it first, or use set_mesh")
            id = self._core.add(mesh._core, matrix, group)
            self._objects[name] = _Object(id, mesh, group)
            self._name_of[id & 0xFFFFFFFF] = name
            self._changed(mesh._core.triangle_count())
        return name

    def set_pose(self, name: Hashable, pose: ArrayLike | None) -> None:
        """Moves an object. With an error it stays where it was.

        Raises
        ------
        UnknownObjectError, PoseError
        """
        matrix = _arrays.pose(pose, "pose")
        with _core.Writing(self._core):
            self._core.set_pose(self._object(name).id, matrix)
            self._changed(0)

    def set_poses(self, names: Sequence[Hashable], poses: ArrayLike) -> None:
        """Moves many, poses (M, 4, 4): all of them, or with an error none.

        Raises
        ------
        UnknownObjectError, PoseError
        OptionError
            Not as many poses as names.
        """
        matrices = _arrays.poses(poses, "poses", ("M",))
        if len(matrices) != len(names):
            raise OptionError(f"there are {len(names)} names, but {len(matrices)} poses")
        with _core.Writing(self._core):
            self._core.set_poses(self._ids(names), matrices)
            self._changed(0)

    def set_mesh(self, name: Hashable, mesh: MeshLike, pose: ArrayLike | None = None) -> None:
        """Gives an object another shape and place; its name and all that was said of it stay.

        Raises
        ------
        UnknownObjectError, MeshError, PoseError
        """
        mesh, matrix = _as_mesh(mesh), _arrays.pose(pose, "pose")
        with _core.Writing(self._core):
            self._set_mesh(self._object(name), mesh, matrix)

    def set_vertices(self, name: Hashable, vertices: ArrayLike) -> None:
        """Deforms an object's mesh where it stands, as `Mesh.deformed`: vertices (V, 3), in the mesh's frame. Others that share the mesh
        keep theirs. With an error it stays as it was.

        Raises
        ------
        UnknownObjectError
        MeshError
            Another shape or type, or a coordinate that is not finite.

        Examples
        --------
        >>> import impinge
        >>> scene, mesh = impinge.Scene(), impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> scene.add(mesh, name="sheet"), scene.add(mesh, name="floor")
        ('sheet', 'floor')
        >>> scene.set_vertices("sheet", [[0, 0, 1], [1, 0, 1], [0, 1, 0.5]])
        >>> scene.distance().nearest.distance
        0.5
        """
        with _core.Writing(self._core):
            found = self._object(name)
            self._set_mesh(found, found.mesh.deformed(vertices), np.asarray(self._core.pose(found.id)))

    def remove(self, name: Hashable) -> None:
        """Forgets an object, and the pairs that ignore it.

        Raises
        ------
        UnknownObjectError
        """
        with _core.Writing(self._core):
            found = self._object(name)
            self._core.remove(found.id)
            del self._objects[name], self._name_of[found.id & 0xFFFFFFFF]
            self._ignored = {key: pair for key, pair in self._ignored.items() if name not in key}
            self._changed(-found.mesh._core.triangle_count())

    def ignore(self, a: Hashable, b: Hashable, ignored: bool = True) -> None:
        """Leaves a pair out of every query from now on, or takes it back in.

        Raises
        ------
        UnknownObjectError
        OptionError
            The two are the same.
        """
        with _core.Writing(self._core):
            self._core.ignore(self._object(a).id, self._object(b).id, ignored)
            if ignored:
                self._ignored[frozenset((a, b))] = (a, b)
            else:
                self._ignored.pop(frozenset((a, b)), None)
            self._changed(0)

    def set_filter(self, name: Hashable, category: int = 1, mask: int = 2**64 - 1) -> None:
        """Two objects are tested against each other if the mask of each has a bit of the other's category, both of 64 bits, besides what
        groups and ignored pairs leave out. A new object has category 1 and every bit in its mask.

        Raises
        ------
        UnknownObjectError
        OptionError
            A number not between 0 and 2^64 - 1.

        Examples
        --------
        >>> import impinge
        >>> scene, mesh = impinge.Scene(), impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> arm, floor = scene.add(mesh, name="arm"), scene.add(mesh, name="floor")
        >>> scene.set_filter("arm", category=2)
        >>> scene.set_filter("floor", mask=~2 & 2**64 - 1)  # all but arms
        >>> scene.touches_any()
        False
        """
        for what, bits in (("category", category), ("mask", mask)):
            if not 0 <= bits < 2**64:
                raise OptionError(f"{what} is {bits}; choose 0 to 2^64 - 1")
        with _core.Writing(self._core):
            found = self._object(name)
            self._core.set_filter(found.id, category, mask)
            found.filter = (category, mask)
            self._changed(0)

    def self(self, name: Hashable, on: bool = True) -> None:
        """Whether `collide` tests this object against itself too, as `self_collide` does, in a row of the object and itself, whatever its
        group and filter. At first it does not.

        Raises
        ------
        UnknownObjectError

        Examples
        --------
        >>> import impinge
        >>> scene, folded = impinge.Scene(), impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0.5, 0]], [[0, 1, 2], [0, 1, 3]])
        >>> cloth = scene.add(folded, name="cloth")
        >>> scene.self("cloth")
        >>> scene.collide().names
        (('cloth', 'cloth'),)
        """
        with _core.Writing(self._core):
            found = self._object(name)
            self._core.self(found.id, on)
            found.self_too = bool(on)
            self._changed(0)

    def pose(self, name: Hashable) -> NDArray[np.float64]:
        """(4, 4). Raises UnknownObjectError."""
        with _core.Reading(self._core):
            return np.asarray(self._core.pose(self._object(name).id))

    def mesh(self, name: Hashable) -> Mesh:
        """The object's mesh. Raises UnknownObjectError."""
        return self._object(name).mesh

    def __len__(self) -> int:
        return len(self._objects)

    def __contains__(self, name: Hashable) -> bool:
        return name in self._objects

    def __iter__(self) -> Iterator[Hashable]:
        """Over the names, in the order in which they were added."""
        return iter(list(self._objects))

    # --- queries

    def collide(
        self,
        *,
        first: bool = False,
        limit: int | None = None,
        kinds: Kind | Iterable[Kind] | None = None,
        threads: int = 0,
        backend: str = "auto",
        device: str = "",
        by_index: bool = False,
        stop: _core.Stop | None = None,
    ) -> Contacts:
        """Every pair of triangles of two different objects that share a point; `names` says whose the rows are.

        With `first` one pair for each two objects that touch; `by_index` as in `self_collide`, of objects that `self` says it of. Options
        and errors as the function `collide`.
        """
        options = make_options(first, limit, kinds, threads, backend, device, by_index)
        with self._reading(threads):
            return make_contacts(self._core.collide(options, stop), self._name_of)

    def collide_with(
        self,
        other: Hashable | Mesh,
        pose: ArrayLike | None = None,
        *,
        first: bool = False,
        limit: int | None = None,
        kinds: Kind | Iterable[Kind] | None = None,
        threads: int = 0,
        backend: str = "auto",
        device: str = "",
        stop: _core.Stop | None = None,
    ) -> Contacts:
        """The same of one object, by its name, and all others; or of a `Mesh` that is not in the scene, at a pose, and all objects.

        A mesh comes second in the rows, as object -1, and its name is None.

        Raises
        ------
        As `collide`; UnknownObjectError.
        """
        options = make_options(first, limit, kinds, threads, backend, device)
        matrix = _arrays.pose(pose, "pose")
        with self._reading(threads):
            if isinstance(other, Mesh):
                return make_contacts(self._core.collide_with_mesh(other._core, matrix, options, stop), self._name_of)
            if matrix is not None:
                raise OptionError("a pose goes with a Mesh; an object of the scene has its own")
            return make_contacts(self._core.collide_with(self._object(other).id, options, stop), self._name_of)

    def touches_with(
        self, mesh: MeshLike, pose: ArrayLike | None = None, *, threads: int = 0, stop: _core.Stop | None = None
    ) -> bool:
        """Whether a mesh that is not in the scene, at a pose (4, 4), touches any object. Errors as `collide`.

        Examples
        --------
        >>> import impinge
        >>> scene, mesh = impinge.Scene(), impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> floor = scene.add(mesh, name="floor")
        >>> [scene.touches_with(mesh, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, z], [0, 0, 0, 1]]) for z in (0, 1e-9)]
        [True, False]
        """
        matrix = _arrays.pose(pose, "pose")
        core = as_core(mesh, "mesh")
        with self._reading(threads):
            return self._core.touches_with(core, matrix, threads, stop)

    def touches_any(self, *, threads: int = 0, stop: _core.Stop | None = None) -> bool:
        """Whether any two objects share a point: the search stops at the first that do. Errors as `collide`."""
        with self._reading(threads):
            return self._core.touches_any(threads, stop)

    @overload
    def collide_configurations(
        self,
        names: Sequence[Hashable],
        poses: ArrayLike,
        *,
        witnesses: Literal[False] = ...,
        threads: int = ...,
        stop: _core.Stop | None = ...,
    ) -> NDArray[np.bool_]:
        ...

    @overload
    def collide_configurations(
        self, names: Sequence[Hashable], poses: ArrayLike, *, witnesses: Literal[True], threads: int = ..., stop: _core.Stop | None = ...
    ) -> Configurations:
        ...

    def collide_configurations(
        self,
        names: Sequence[Hashable],
        poses: ArrayLike,
        *,
        witnesses: bool = False,
        threads: int = 0,
        stop: _core.Stop | None = None,
    ) -> NDArray[np.bool_] | Configurations:
        """For each configuration, a pose for each of these objects, (T, M, 4, 4) in all: whether one of them touches another one or
        any other object of the scene, (T,). The others are not tested against each other. The scene does not change. With `witnesses`
        two triangles that touch are told too.

        >>> import impinge, numpy as np
        >>> sheet = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> scene = impinge.Scene()
        >>> floor, arm = scene.add(sheet, name="floor"), scene.add(sheet, name="arm")
        >>> poses = np.tile(np.eye(4), (3, 1, 1, 1))  # three configurations of one moving object
        >>> poses[:, 0, 2, 3] = [-1, 0, 1]
        >>> scene.collide_configurations(["arm"], poses)
        array([False,  True, False])
        >>> scene.first_touching(["arm"], poses)
        1
        >>> scene.distance_configurations(["arm"], poses)
        array([1., 0., 1.])

        Raises
        ------
        UnknownObjectError, PoseError, RangeError, OptionError, Cancelled, OutOfMemoryError
        """
        matrices = self._path(names, poses)
        with self._reading(threads):
            touches, found = self._core.collide_configurations(self._ids(names), matrices, witnesses, threads, stop)
            if not witnesses:
                return np.asarray(touches)
            rows = np.asarray(found)
            pairs = tuple(None if a < 0 else (self._name_of[a], self._name_of[b]) for a, b in rows[:, :2].tolist())
            return Configurations(np.asarray(touches), pairs, rows[:, 2:].copy())

    def first_touching(
        self, names: Sequence[Hashable], poses: ArrayLike, *, threads: int = 0, stop: _core.Stop | None = None
    ) -> int | None:
        """The index of some configuration that touches, or None. Of a path its ends and its middle are tried first.

        Raises
        ------
        As `collide_configurations`; poses behind the one found may not have been looked at.
        """
        matrices = self._path(names, poses)
        with self._reading(threads):
            return self._core.first_touching(self._ids(names), matrices, threads, stop)

    def distance(
        self,
        name: Hashable = None,
        *,
        stop_above: float = float("inf"),
        enough_below: float = 0.0,
        threads: int = 0,
        stop: _core.Stop | None = None,
    ) -> ObjectDistance | None:
        """The two objects that are nearest to each other, or the one nearest to the named one; of all that are tested against each other.

        None if there are none, or none within `stop_above`; `enough_below` as in the function `distance`.

        Raises
        ------
        UnknownObjectError, RangeError, OptionError, Cancelled, OutOfMemoryError
        """
        with self._reading(threads):
            id = None if name is None else self._object(name).id
            found = self._core.distance(id, _core.DistanceOptions(stop_above, enough_below, threads), stop)
            return None if found is None else self._object_distance(found)

    def closest(
        self,
        count: int,
        *,
        stop_above: float = float("inf"),
        enough_below: float = 0.0,
        threads: int = 0,
        stop: _core.Stop | None = None,
    ) -> list[ObjectDistance]:
        """The so many pairs of objects that are nearest to each other, the nearest first; fewer if there are fewer, or within `stop_above`.

        Which of several that are equally near come is open, and in what order those below `enough_below` do.

        Raises
        ------
        RangeError, OptionError, Cancelled, OutOfMemoryError

        Examples
        --------
        >>> import impinge, numpy as np
        >>> scene, mesh = impinge.Scene(), impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> for name, z in zip("abc", (0, 1, 3)):
        ...     _ = scene.add(mesh.transformed([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, z], [0, 0, 0, 1]]), name=name)
        >>> [(pair.objects, pair.nearest.distance) for pair in scene.closest(2)]
        [(('a', 'b'), 1.0), (('b', 'c'), 2.0)]
        """
        if not 0 <= count < 2**63:
            raise OptionError(f"count is {count}; choose 0 or more")
        options = _core.DistanceOptions(stop_above, enough_below, threads)
        with self._reading(threads):
            return [self._object_distance(found) for found in self._core.closest(count, options, stop)]

    def distance_configurations(
        self,
        names: Sequence[Hashable],
        poses: ArrayLike,
        *,
        stop_above: float = float("inf"),
        enough_below: float = 0.0,
        threads: int = 0,
        stop: _core.Stop | None = None,
    ) -> NDArray[np.float64]:
        """For each configuration, as in `collide_configurations`, the distance of what moves and everything: (T,); infinity above `stop_above`.
        `enough_below` as in the function `distance`.

        Raises
        ------
        As `collide_configurations`.
        """
        matrices, options = self._path(names, poses), _core.DistanceOptions(stop_above, enough_below, threads)
        with self._reading(threads):
            return np.asarray(self._core.distance_configurations(self._ids(names), matrices, options, stop))

    # --- within

    def _reading(self, threads: int) -> AbstractContextManager[None]:
        """Holds the scene for a query, once what is near what is known."""
        if self._stale:
            with _core.Writing(self._core):
                self._core.update(threads)
                self._stale = False
        return _core.Reading(self._core)

    def _set_mesh(self, found: _Object, mesh: Mesh, pose: NDArray[np.float64] | None) -> None:
        self._core.set_mesh(found.id, mesh._core, pose)
        self._changed(mesh._core.triangle_count() - found.mesh._core.triangle_count())
        found.mesh = mesh

    def _object_distance(self, found: tuple[Any, ...]) -> ObjectDistance:
        a, b, nearest = found
        return ObjectDistance((self._name_of[a], self._name_of[b]), make_nearest(nearest))

    def _changed(self, more_triangles: int) -> None:
        self._core.triangles += more_triangles
        self._stale = True

    def _object(self, name: Hashable) -> _Object:
        try:
            return self._objects[name]
        except (KeyError, TypeError):
            shown = " ".join(repr(name).split())
            raise UnknownObjectError(f"the scene has no object {shown if len(shown) < 80 else shown[:76] + ' ...'}") from None

    def _ids(self, names: Sequence[Hashable]) -> list[int]:
        return [self._object(name).id for name in names]

    def _path(self, names: Sequence[Hashable], poses: ArrayLike) -> NDArray[np.float64]:
        matrices = _arrays.poses(poses, "poses", ("T", "M"))
        if matrices.shape[1] != len(names):
            raise OptionError(f"there are {len(names)} names, but {matrices.shape[1]} poses a configuration")
        return matrices

    def __getstate__(self) -> dict[str, Any]:
        with _core.Reading(self._core):
            objects = [
                (name, found.mesh, np.array(self._core.pose(found.id)), found.group, found.filter, found.self_too)
                for name, found in self._objects.items()
            ]
            return {"objects": objects, "ignored": list(self._ignored.values()), "next": self._next}

    def __setstate__(self, state: dict[str, Any]) -> None:
        Scene.__init__(self)
        for name, mesh, pose, group, bits, self_too in state["objects"]:
            self.add(mesh, pose, name=name, group=group)
            if bits is not None:
                self.set_filter(name, *bits)
            if self_too:
                self.self(name)
        for a, b in state["ignored"]:
            self.ignore(a, b)
        self._next = state["next"]

    def _repr_html_(self) -> str:
        return _show.table_of_scene(self)

    def __repr__(self) -> str:
        return f"<impinge.Scene: {len(self)} objects, {self._core.triangles} faces>"


def _after_fork() -> None:
    for scene in _scenes:
        scene._core.forget_threads()


_scenes: WeakSet[Scene] = WeakSet()
os.register_at_fork(after_in_child=_after_fork)


def _as_mesh(mesh: MeshLike) -> Mesh:
    return mesh if isinstance(mesh, Mesh) else Mesh(mesh)
