# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""What a scene is made of: its objects, where they are, and which of them are not tested against each other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Hashable, Iterator, Sequence

import numpy as np

from . import _arrays, _core
from ._errors import OptionError, UnknownObjectError
from ._mesh import Mesh, MeshLike, as_mesh

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


class _Object:
    """What the scene knows of one object; its pose is in the library."""

    __slots__ = ("filter", "group", "id", "mesh", "self_too")

    def __init__(self, id: int, mesh: Mesh, group: int) -> None:
        self.id, self.mesh, self.group = id, mesh, group
        self.filter: tuple[int, int] | None = None
        self.self_too = False


class SceneObjects:
    """The objects of a `Scene`."""

    def __init__(self) -> None:
        self._core = _core.Scene()
        self._objects: dict[Hashable, _Object] = {}
        self._name_of: dict[int, Hashable] = {}  # by the library's index
        self._ignored: dict[frozenset[Hashable], tuple[Hashable, Hashable]] = {}
        self._next = 0

    def add(self, mesh: MeshLike, pose: ArrayLike | None = None, *, name: Hashable = None, group: int = 0) -> Hashable:
        """Adds a mesh and returns its name: the next number that is free if you give none.

        Objects of one group that is not 0 are not tested against each other.

        Raises
        ------
        MeshError, PoseError
        OptionError
            The name is taken, or the group not between 0 and 2^32 - 1.
        """
        mesh, matrix = as_mesh(mesh), _arrays.pose(pose, "pose")
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
            self._core.triangles += mesh._core.triangle_count()
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

    def set_mesh(self, name: Hashable, mesh: MeshLike, pose: ArrayLike | None = None) -> None:
        """Gives an object another shape and place; its name and all that was said of it stay.

        Raises
        ------
        UnknownObjectError, MeshError, PoseError
        """
        mesh, matrix = as_mesh(mesh), _arrays.pose(pose, "pose")
        with _core.Writing(self._core):
            self._set_mesh(self._object(name), mesh, matrix)

    def set_vertices(self, name: Hashable, vertices: ArrayLike, *, stop: _core.Stop | None = None) -> None:
        """Deforms an object's mesh where it stands, as `Mesh.deformed`: vertices (V, 3), in the mesh's frame. Others that share the mesh
        keep theirs. With an error it stays as it was.

        Raises
        ------
        UnknownObjectError
        MeshError
            Another shape or type, or a coordinate that is not finite.
        Cancelled

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
            self._set_mesh(found, found.mesh.deformed(vertices, stop=stop), np.asarray(self._core.pose(found.id)))

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
            self._core.triangles -= found.mesh._core.triangle_count()

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

    # --- within

    def _set_mesh(self, found: _Object, mesh: Mesh, pose: NDArray[np.float64] | None) -> None:
        self._core.set_mesh(found.id, mesh._core, pose)
        self._core.triangles += mesh._core.triangle_count() - found.mesh._core.triangle_count()
        found.mesh = mesh

    def _object(self, name: Hashable) -> _Object:
        try:
            return self._objects[name]
        except (KeyError, TypeError):
            shown = " ".join(repr(name).split())
            raise UnknownObjectError(f"the scene has no object {shown if len(shown) < 80 else shown[:76] + ' ...'}") from None

    def _ids(self, names: Sequence[Hashable]) -> list[int]:
        return [self._object(name).id for name in names]

    def __getstate__(self) -> dict[str, Any]:
        with _core.Reading(self._core):
            objects = [
                (name, found.mesh, np.array(self._core.pose(found.id)), found.group, found.filter, found.self_too)
                for name, found in self._objects.items()
            ]
            return {"objects": objects, "ignored": list(self._ignored.values()), "next": self._next}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__()  # type: ignore[misc]
        for name, mesh, pose, group, bits, self_too in state["objects"]:
            self.add(mesh, pose, name=name, group=group)
            if bits is not None:
                self.set_filter(name, *bits)
            if self_too:
                self.self(name)
        for a, b in state["ignored"]:
            self.ignore(a, b)
        self._next = state["next"]
