# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Scenes, and what they are asked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Hashable, Iterable, Literal, NamedTuple, Sequence, overload

import numpy as np

from . import _arrays, _core, _show
from ._errors import OptionError
from ._mesh import Mesh, MeshLike, as_core
from ._motion import SceneImpacts, make_motion_options, make_scene_impacts
from ._queries import Contacts, Kind, Nearest, make_contacts, make_nearest, make_options
from ._scene_objects import SceneObjects

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


class Scene(SceneObjects):
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
        with _core.Reading(self._core, threads):
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
        with _core.Reading(self._core, threads):
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
        with _core.Reading(self._core, threads):
            return self._core.touches_with(core, matrix, threads, stop)

    def touches_any(self, *, threads: int = 0, stop: _core.Stop | None = None) -> bool:
        """Whether any two objects share a point: the search stops at the first that do. Errors as `collide`."""
        with _core.Reading(self._core, threads):
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
        with _core.Reading(self._core, threads):
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
        with _core.Reading(self._core, threads):
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
        with _core.Reading(self._core, threads):
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
        with _core.Reading(self._core, threads):
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
        with _core.Reading(self._core, threads):
            return np.asarray(self._core.distance_configurations(self._ids(names), matrices, options, stop))

    def step(self) -> None:
        """Ends a motion: where everything is now is where the next one, of which `find_impacts` tells, starts. (A scene that was copied
        or unpickled starts where it is.)"""
        with _core.Writing(self._core):
            self._core.step()

    def find_impacts(
        self,
        *,
        earliest: bool = False,
        limit: int | None = None,
        end: float = 1.0,
        by_index: bool = False,
        separation: float = 0.0,
        threads: int = 0,
        stop: _core.Stop | None = None,
    ) -> SceneImpacts:
        """What meets between the last `step` and now, exactly: all impacts of pairs that `collide` tests, and of objects with themselves
        of which `self` says it. Options as the function `find_impacts`.

        World vertices move on straight lines from where they were to where they are, those of an object that turned too. An object that was
        added since starts where it was put; one whose mesh has other faces now stands where it is.

        Raises
        ------
        RangeError
            At either end a world coordinate is not below 2^300, or the mesh's largest is neither 0 nor at least 2^-300.
        OptionError, Cancelled, OutOfMemoryError

        Examples
        --------
        >>> import impinge
        >>> scene, sheet = impinge.Scene(), impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        >>> pose = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1]]
        >>> floor, lid = scene.add(sheet, name="floor"), scene.add(sheet, pose, name="lid")
        >>> scene.step()
        >>> pose[2][3] = -1  # 4 down, through the floor
        >>> scene.set_pose("lid", pose)
        >>> impacts = scene.find_impacts()
        >>> impacts.names, impacts.earliest
        ((('floor', 'lid'),), Interval(lo=0.75, hi=0.75))
        """
        options = make_motion_options(earliest, end, by_index, separation, limit, threads)
        with _core.Reading(self._core):
            return make_scene_impacts(_core.impacts_of_scene(self._core, options, stop), self._name_of)

    # --- within

    def _object_distance(self, found: tuple[Any, ...]) -> ObjectDistance:
        a, b, nearest = found
        return ObjectDistance((self._name_of[a], self._name_of[b]), make_nearest(nearest))

    def _path(self, names: Sequence[Hashable], poses: ArrayLike) -> NDArray[np.float64]:
        matrices = _arrays.poses(poses, "poses", ("T", "M"))
        if matrices.shape[1] != len(names):
            raise OptionError(f"there are {len(names)} names, but {matrices.shape[1]} poses a configuration")
        return matrices

    def _repr_html_(self) -> str:
        return _show.table_of_scene(self)

    def __repr__(self) -> str:
        return f"<impinge.Scene: {len(self)} objects, {self._core.triangles} faces>"
