# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
from __future__ import annotations

from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any, Hashable, Iterable, Iterator, NamedTuple, Sequence

import numpy as np

from . import _arrays, _core, _show
from ._errors import OptionError, UnknownObjectError
from ._mesh import Mesh, MeshLike
from ._queries import Contacts, Kind, Nearest, make_contacts, make_nearest, make_options

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class ObjectDistance(NamedTuple):
    """The two objects of a scene that are nearest to each other."""

    objects: tuple[Hashable, Hashable]  #: their names
    nearest: Nearest


class _Object:
    """What the scene knows of one object; its pose is in the library."""

    __slots__ = ("group", "id", "mesh")

    def __init__(self, id: int, mesh: Mesh, group: int) -> None:
        self.id, self.mesh, self.group = id, mesh, group


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
        """Gives an object another shape and place; its name, group and ignored pairs stay.

        Raises
        ------
        UnknownObjectError, MeshError, PoseError
        """
        mesh, matrix = _as_mesh(mesh), _arrays.pose(pose, "pose")
        with _core.Writing(self._core):
            found = self._object(name)
            self._core.set_mesh(found.id, mesh._core, matrix)
            self._changed(mesh._core.triangle_count() - found.mesh._core.triangle_count())
            found.mesh = mesh

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
        stop: _core.Stop | None = None,
    ) -> Contacts:
        """Every pair of triangles of two different objects that share a point; `names` says whose the rows are.

        With `first` one pair for each two objects that touch. Options and errors as the function `collide`.
        """
        options = make_options(first, limit, kinds, threads, backend, device)
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

    def _touches(self, mesh: Mesh, pose: NDArray[np.float64]) -> bool:
        """Whether a mesh that is not in the scene touches any object: `collide_with`, without the contacts."""
        with self._reading(1):
            return self._core.touches_mesh(mesh._core, pose)

    def touches_any(self, *, threads: int = 0, stop: _core.Stop | None = None) -> bool:
        """Whether any two objects share a point: the search stops at the first that do. Errors as `collide`."""
        with self._reading(threads):
            return self._core.touches_any(threads, stop)

    def collide_configurations(
        self, names: Sequence[Hashable], poses: ArrayLike, *, threads: int = 0, stop: _core.Stop | None = None
    ) -> NDArray[np.bool_]:
        """For each configuration, a pose for each of these objects, (T, M, 4, 4) in all: whether one of them touches another one or
        any other object of the scene, (T,). The others are not tested against each other. The scene does not change.

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
            return np.asarray(self._core.collide_configurations(self._ids(names), matrices, threads, stop))

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
        self, name: Hashable = None, *, stop_above: float = float("inf"), threads: int = 0, stop: _core.Stop | None = None
    ) -> ObjectDistance | None:
        """The two objects that are nearest to each other, or the one nearest to the named one; of all that are tested against each other.

        None if there are none, or none within `stop_above`.

        Raises
        ------
        UnknownObjectError, RangeError, OptionError, Cancelled, OutOfMemoryError
        """
        with self._reading(threads):
            id = None if name is None else self._object(name).id
            found = self._core.distance(id, stop_above, threads, stop)
            if found is None:
                return None
            a, b, nearest = found
            return ObjectDistance((self._name_of[a], self._name_of[b]), make_nearest(nearest))

    def distance_configurations(
        self,
        names: Sequence[Hashable],
        poses: ArrayLike,
        *,
        stop_above: float = float("inf"),
        threads: int = 0,
        stop: _core.Stop | None = None,
    ) -> NDArray[np.float64]:
        """For each configuration, as in `collide_configurations`, the distance of what moves and everything: (T,); infinity above `stop_above`.

        Raises
        ------
        As `collide_configurations`.
        """
        matrices = self._path(names, poses)
        with self._reading(threads):
            return np.asarray(self._core.distance_configurations(self._ids(names), matrices, stop_above, threads, stop))

    # --- within

    def _reading(self, threads: int) -> AbstractContextManager[None]:
        """Holds the scene for a query, once what is near what is known."""
        if self._stale:
            with _core.Writing(self._core):
                self._core.update(threads)
                self._stale = False
        return _core.Reading(self._core)

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
                (name, found.mesh, np.array(self._core.pose(found.id)), found.group) for name, found in self._objects.items()
            ]
            return {"objects": objects, "ignored": list(self._ignored.values()), "next": self._next}

    def __setstate__(self, state: dict[str, Any]) -> None:
        Scene.__init__(self)
        for name, mesh, pose, group in state["objects"]:
            self.add(mesh, pose, name=name, group=group)
        for a, b in state["ignored"]:
            self.ignore(a, b)
        self._next = state["next"]

    def _repr_html_(self) -> str:
        return _show.table_of_scene(self)

    def __repr__(self) -> str:
        return f"<impinge.Scene: {len(self)} objects, {self._core.triangles} faces>"


def _as_mesh(mesh: MeshLike) -> Mesh:
    return mesh if isinstance(mesh, Mesh) else Mesh(mesh)
