# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""trimesh's collision managers, by impinge: the same names, arguments and tuples, answers that are exact. It needs no trimesh.

>>> import impinge.trimesh
>>> impinge.trimesh.install()  # doctest: +SKIP

puts them into `trimesh.collision`; or write `impinge.trimesh.CollisionManager` for `trimesh.collision.CollisionManager`.
"""

from __future__ import annotations

import copy
import sys
from typing import TYPE_CHECKING, Any, Callable, Hashable, Iterable, Iterator, Literal, NamedTuple

import numpy as np

from . import _convex, _core
from ._clash import judge
from ._errors import OptionError
from ._mesh import MeshLike
from ._placed import CollisionObject, as_matrix, is_nested, is_within, place
from ._queries import Contacts, Kind, Nearest, collide, distance
from ._scene import Scene
from ._shared_points import shared_points

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_EXTERNAL = "__external"
_MOST_CONTACTS = 100_000  # of one query's data, as in trimesh


class ContactData:
    """Where two objects touch."""

    def __init__(
        self,
        names: tuple[Hashable, Hashable],
        faces: tuple[int, int],
        kind: Kind | None,
        point: NDArray[np.float64],
        normal: NDArray[np.float64],
        depth: float,
    ) -> None:
        self.names = set(names)
        self.kind = kind  #: how the two faces meet; None: one object inside of the other
        self.point = point  #: (3,): of two convex solids half-way between their deepest features; else one that the faces share
        self.normal = normal  #: (3,): unit: of two convex solids the shortest way by which the second leaves the first; else by the faces
        self.depth = depth  #: of two convex solids along the normal; else how deep the objects' boundaries reach into each other
        self._faces = dict(zip(names, faces))

    def index(self, name: Hashable) -> int:
        """The face of the named object."""
        return self._faces[name]


class DistanceData:
    """Where two objects are nearest to each other; of two that overlap, nearest points of their surfaces."""

    def __init__(self, names: tuple[Hashable, Hashable], distance: float, nearest: Nearest) -> None:
        self.names = set(names)
        self.distance = distance  #: minus the depth where they overlap
        self._faces = dict(zip(names, nearest.faces))
        self._points: dict[Hashable, NDArray[np.float64]] = dict(zip(names, nearest.points))

    def index(self, name: Hashable) -> int:
        """The face of the named object."""
        return self._faces[name]

    def point(self, name: Hashable) -> NDArray[np.float64]:
        """(3,): the point of the named object."""
        return self._points[name]


_Distance = tuple[float, tuple[Hashable, Hashable], Nearest]


class _Pair(NamedTuple):
    """Two objects that collide."""

    names: tuple[Hashable, Hashable]
    objects: tuple[CollisionObject, CollisionObject]


class CollisionManager:
    """Placed meshes, by names.

    >>> import impinge
    >>> tetrahedron = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> from impinge.trimesh import CollisionManager
    >>> manager = CollisionManager()
    >>> _ = manager.add_object("base", tetrahedron), manager.add_object("top", tetrahedron, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.5], [0, 0, 0, 1]])
    >>> manager.in_collision_internal(return_names=True)
    (True, {('base', 'top')})

    Parameters
    ----------
    solid : "convex", "closed" or "none"
        Which meshes are solids, with which what lies inside collides: convex ones, as in trimesh; all closed ones; none.
    touching : bool
        Whether objects that only touch collide: flush boxes always do, or never.
    tolerance : float or None
        With touching=False: how deep objects may reach into each other and still only touch. None: what rounding of the
        coordinates leaves, as in `judge`.
    """

    def __init__(
        self, *, solid: Literal["convex", "closed", "none"] = "convex", touching: bool = True, tolerance: float | None = None
    ) -> None:
        if solid not in ("convex", "closed", "none"):
            raise OptionError(f"solid is {solid!r}; choose 'convex', 'closed' or 'none'")
        self._solid, self._touching, self._tolerance = solid, touching, tolerance
        self._objs: dict[Hashable, dict[str, Any]] = {}
        self._scene = Scene()
        self._ignored: dict[frozenset[Hashable], tuple[Hashable, Hashable]] = {}
        self._known_places: tuple[dict[Hashable, int], NDArray[np.float64], NDArray[np.float64]] | None = None
        self._moved: set[Hashable] = set()  # since then
        self._known_solids: bool | None = None

    # --- objects

    def add_object(self, name: Hashable, mesh: MeshLike, transform: ArrayLike | None = None) -> CollisionObject:
        """Adds an object, in place of one of that name, and returns it. `transform`: any affine (4, 4)."""
        placed = place(mesh, transform)
        if name in self._objs:
            self._scene.remove(name)
        self._scene.add(placed._mesh, placed._pose, name=name)
        self._objs[name] = {"obj": placed, "geom": placed._base}
        self._known_places = self._known_solids = None
        for pair in self._ignored.values():
            if name in pair and all(other in self._objs for other in pair):
                self._scene.ignore(*pair)
        return placed

    def remove_object(self, name: Hashable) -> None:
        """Forgets an object. Raises ValueError."""
        self._object(name)
        self._scene.remove(name)
        del self._objs[name]
        self._known_places = self._known_solids = None

    def set_transform(self, name: Hashable, transform: ArrayLike) -> None:
        """Moves an object. Raises ValueError."""
        placed = self._object(name)
        before = placed._mesh
        placed._move(as_matrix(transform))
        if placed._mesh is before:
            self._scene.set_pose(name, placed._pose)
        else:
            self._scene.set_mesh(name, placed._mesh, placed._pose)
            self._known_solids = None
        self._moved.add(name)

    def set_pair_ignored(self, name_a: Hashable, name_b: Hashable, ignored: bool = True) -> None:
        """Leaves a pair, in either order, out of what is asked of the manager itself, or takes it back in."""
        key = frozenset((name_a, name_b))
        if len(key) == 1:
            raise OptionError(f"{name_a!r} cannot be ignored with itself")
        if ignored:
            self._ignored[key] = _sorted((name_a, name_b))
        else:
            self._ignored.pop(key, None)
        if name_a in self._objs and name_b in self._objs:
            self._scene.ignore(name_a, name_b, ignored)

    def is_pair_ignored(self, name_a: Hashable, name_b: Hashable) -> bool:
        """Whether the pair is left out."""
        return frozenset((name_a, name_b)) in self._ignored

    def clear_ignored_pairs(self) -> None:
        """Takes all pairs back in."""
        for pair in list(self._ignored.values()):
            self.set_pair_ignored(*pair, ignored=False)

    @property
    def ignored_pairs(self) -> set[tuple[Hashable, Hashable]]:
        """The pairs that are left out, the names of each sorted."""
        return set(self._ignored.values())

    # --- collisions

    def in_collision_single(
        self, mesh: MeshLike, transform: ArrayLike | None = None, return_names: bool = False, return_data: bool = False
    ) -> Any:
        """Whether a mesh collides with any object: a bool; with the set of their names; with a list of ContactData ("__external" is the mesh)."""
        visitor = place(mesh, transform)
        if not return_names and not return_data and self._touching:
            return self._scene.touches_with(visitor._mesh, visitor._pose) or any(True for _ in self._nested_with(visitor, []))
        return self._answer(self._pairs_with(visitor, _EXTERNAL), lambda names: names[0], return_names, return_data)

    def in_collision_poses(self, mesh: MeshLike, transforms: ArrayLike) -> NDArray[np.bool_]:
        """The same at many transforms, (N, 4, 4), in one call: (N,)."""
        matrices = np.require(transforms, np.float64, ["C", "A"])
        if matrices.ndim != 3 or matrices.shape[1:] != (4, 4):
            raise ValueError("transforms must be (N,4,4)!")
        visitors = [place(mesh, matrices[0])] if len(matrices) else []
        for matrix in matrices[1:]:
            visitors.append(copy.copy(visitors[0]))
            visitors[-1]._move(matrix)
        found = np.zeros(len(matrices), np.bool_)
        together = [k for k, visitor in enumerate(visitors) if self._touching and visitor._mesh is visitor._base]
        if together:
            with _core.Reading(self._scene._core, 0):
                poses = np.array([visitors[k]._pose for k in together])
                found[together] = np.asarray(self._scene._core.touches_with_at(visitors[0]._base._core, poses, None))
        surfaces_known = set(together)
        for k in np.flatnonzero(~found):
            if k in surfaces_known:
                found[k] = any(True for _ in self._nested_with(visitors[k], []))
            else:
                found[k] = any(True for _ in self._pairs_with(visitors[k], _EXTERNAL))
        return found

    def in_collision_internal(self, return_names: bool = False, return_data: bool = False) -> Any:
        """Whether any two objects collide: a bool; with the set of pairs of names, those of each sorted; with a list of ContactData."""
        if not return_names and not return_data and self._touching and self._scene.touches_any():
            return True
        return self._answer(self._pairs_within(), _sorted, return_names, return_data)

    def in_collision_other(self, other_manager: CollisionManager, return_names: bool = False, return_data: bool = False) -> Any:
        """The same of an object of this manager and one of the other; a name of either in each pair, in that order."""
        others = list(other_manager._objs.items())
        pairs = (pair for name, item in others for pair in self._pairs_with(item["obj"], name))
        return self._answer(pairs, lambda names: names, return_names, return_data)

    # --- distances

    def min_distance_single(
        self, mesh: MeshLike, transform: ArrayLike | None = None, return_name: bool = False, return_data: bool = False
    ) -> Any:
        """The distance of a mesh and the nearest object, minus the depth if they overlap; with its name; with DistanceData."""
        visitor = place(mesh, transform)
        least = _least(self._distances_to(visitor, _EXTERNAL))
        return _distances(least, None if least is None else least[1][0], return_name, return_data)

    def min_distance_internal(self, name: Hashable = None, return_names: bool = False, return_data: bool = False) -> Any:
        """The least distance of two objects, or of the named one and another; with their names, sorted; with DistanceData."""
        if name is not None:
            self._object(name)
        least = _least(self._depths(pair for pair in self._pairs_within() if name is None or name in pair.names))
        if least is None:
            found = self._scene.distance(name)
            least = None if found is None else (found.nearest.distance, found.objects, found.nearest)
        return _distances(least, None if least is None else _sorted(least[1]), return_names, return_data)

    def min_distance_other(self, other_manager: CollisionManager, return_names: bool = False, return_data: bool = False) -> Any:
        """The least distance of an object of this manager and one of the other; with a name of either; with DistanceData."""
        others = list(other_manager._objs.items())
        least = _least(found for name, item in others for found in self._distances_to(item["obj"], name))
        return _distances(least, None if least is None else least[1], return_names, return_data)

    # --- within

    def _object(self, name: Hashable) -> CollisionObject:
        if name not in self._objs:
            raise ValueError(f"{name} not in collision manager!")
        placed: CollisionObject = self._objs[name]["obj"]
        return placed

    def _pairs_with(self, visitor: CollisionObject, visitor_name: Hashable) -> Iterator[_Pair]:
        """The objects that collide with one that is not of the manager, which is the second of each pair."""
        met = [name for name, _ in self._scene.collide_with(visitor._mesh, visitor._pose, first=True).names or ()]
        for name in met + list(self._nested_with(visitor, met)):
            pair = _Pair((name, visitor_name), (self._objs[name]["obj"], visitor))
            if self._counts(pair):
                yield pair

    def _nested_with(self, visitor: CollisionObject, met: list[Hashable]) -> Iterator[Hashable]:
        """The objects, but for those whose surfaces it meets, that it lies inside of, or the other way round."""
        if not (visitor._is_solid(self._solid) or self._has_solids()):
            return
        names, boxes, corners = self._places()
        for k in np.flatnonzero(is_within(visitor._corner, boxes) | is_within(corners, visitor._box)):
            if names[k] not in met and is_nested(self._objs[names[k]]["obj"], visitor, self._solid):
                yield names[k]

    def _pairs_within(self) -> Iterator[_Pair]:
        """The objects of the manager that collide, but for ignored pairs."""
        pairs = list(self._scene.collide(first=True).names or ())
        met = set(pairs)
        names, boxes, corners = self._places()
        for i, outer in enumerate(names if self._has_solids() else ()):
            for inner in (names[k] for k in np.flatnonzero(is_within(corners, boxes[:, i])) if k != i):
                if {(outer, inner), (inner, outer)} & met or self.is_pair_ignored(outer, inner):
                    continue
                if is_nested(self._objs[outer]["obj"], self._objs[inner]["obj"], self._solid):
                    met.add((outer, inner))
                    pairs.append((outer, inner))
        for a, b in pairs:
            pair = _Pair((a, b), (self._objs[a]["obj"], self._objs[b]["obj"]))
            if self._counts(pair):
                yield pair

    def _places(self) -> tuple[list[Hashable], NDArray[np.float64], NDArray[np.float64]]:
        """Names, and the boxes, (2, N, 3), and corners, (N, 3), of the objects."""
        if self._known_places is None:
            objects = [item["obj"] for item in self._objs.values()]
            boxes = np.array([placed._box for placed in objects]).reshape(-1, 2, 3).swapaxes(0, 1)
            corners = np.array([placed._corner for placed in objects]).reshape(-1, 3)
            self._known_places = {name: k for k, name in enumerate(self._objs)}, boxes, corners
        else:
            rows, boxes, corners = self._known_places
            for name in self._moved:
                boxes[:, rows[name]], corners[rows[name]] = self._objs[name]["obj"]._bounds()
        self._moved.clear()
        return list(self._objs), boxes, corners

    def _has_solids(self) -> bool:
        """Whether any object may have others inside of it."""
        if self._known_solids is None:
            self._known_solids = any(item["obj"]._is_solid(self._solid) for item in self._objs.values())
        return self._known_solids

    def _counts(self, pair: _Pair) -> bool:
        """Whether what touches or is nested is deep enough to collide."""
        if self._touching:
            return True
        a, b = pair.objects
        return judge(a._mesh, b._mesh, a._pose, b._pose, tolerance=self._tolerance, depth_precision=np.inf).fails

    def _depth(self, pair: _Pair) -> tuple[float, _convex.Penetration | None]:
        """How deep two objects that collide are in each other."""
        a, b = pair.objects
        hulls = (a._placed_hull(), b._placed_hull()) if self._solid != "none" else (None, None)
        if hulls[0] is not None and hulls[1] is not None:
            found = _convex.penetration(hulls[0], hulls[1])
            return max(found.depth, 0.0), found
        clash = judge(a._mesh, b._mesh, a._pose, b._pose)
        if clash.overlap_depth is not None:
            return clash.overlap_depth.depth, None
        if np.isfinite(clash.fails_below):
            return clash.fails_below, None
        overlap = np.minimum(a._box[1], b._box[1]) - np.maximum(a._box[0], b._box[0])  # surfaces that go through each other
        return float(np.linalg.norm(overlap)), None

    def _depths(self, pairs: Iterable[_Pair]) -> Iterator[_Distance]:
        for pair in pairs:
            a, b = pair.objects
            nearest = distance(a._mesh, b._mesh, a._pose, b._pose)
            if nearest is not None:
                yield 0.0 - self._depth(pair)[0], pair.names, nearest

    def _distances_to(self, visitor: CollisionObject, visitor_name: Hashable) -> Iterator[_Distance]:
        """The depths, or if nothing collides distances, each less than those before."""
        deep = list(self._depths(self._pairs_with(visitor, visitor_name)))
        if deep or not len(visitor._mesh.faces):
            yield from deep
            return
        least = np.inf
        names, (low, high), _ = self._places()
        bounds = np.linalg.norm(np.maximum(np.maximum(low - visitor._box[1], visitor._box[0] - high), 0), axis=1)
        for k in np.argsort(bounds):
            placed: CollisionObject = self._objs[names[k]]["obj"]
            if not bounds[k] <= least:  # that of an object without triangles is no number, and comes last
                break
            nearest = distance(placed._mesh, visitor._mesh, placed._pose, visitor._pose, stop_above=least)
            if nearest is not None and nearest.distance < least:
                least = nearest.distance
                yield least, (names[k], visitor_name), nearest

    def _answer(
        self,
        pairs: Iterable[_Pair],
        called: Callable[[tuple[Hashable, Hashable]], Hashable],
        return_names: bool,
        return_data: bool,
    ) -> Any:
        if not return_names and not return_data:
            return any(True for _ in pairs)
        listed = list(pairs)
        answer: list[Any] = [bool(listed)]
        if return_names:
            answer.append({called(pair.names) for pair in listed})
        if return_data:
            answer.append(self._data(listed))
        return tuple(answer)

    def _data(self, pairs: list[_Pair]) -> list[ContactData]:
        data: list[ContactData] = []
        for pair in pairs:
            a, b = pair.objects
            depth, deepest = self._depth(pair)
            room = max(1, _MOST_CONTACTS - len(data))
            found = collide(a._mesh, b._mesh, a._pose, b._pose, limit=room, first=deepest is not None)
            if deepest is not None or not found:
                data.append(self._one_contact(pair, found, depth, deepest))
                continue
            points, normals = shared_points(a._corners(found.pairs[:, 0]), b._corners(found.pairs[:, 1]))
            for (i, j), kind, point, normal in zip(found.pairs.tolist(), found.kinds.tolist(), points, normals):
                data.append(ContactData(pair.names, (i, j), Kind(kind), point, normal, depth))
        return data

    def _one_contact(self, pair: _Pair, found: Contacts, depth: float, deepest: _convex.Penetration | None) -> ContactData:
        """Of two convex solids, or of one object inside of another: by its faces that touch or are nearest."""
        a, b = pair.objects
        if found:
            kind: Kind | None = Kind(int(found.kinds[0]))
            faces: tuple[int, int] = (int(found.pairs[0, 0]), int(found.pairs[0, 1]))
            point = normal = np.zeros(3)  # not asked for: both are convex
        else:
            nearest = distance(a._mesh, b._mesh, a._pose, b._pose)
            assert nearest is not None  # it has triangles, or it would not lie inside
            kind, faces = None, nearest.faces
            point, normal = nearest.points.mean(axis=0), nearest.points[0] - nearest.points[1]
            normal = normal / (np.linalg.norm(normal) or 1)
        if deepest is not None:
            point, normal = deepest.point, deepest.normal
        return ContactData(pair.names, faces, kind, point, normal, depth)


def scene_to_collision(scene: Any) -> tuple[CollisionManager, dict[Hashable, CollisionObject]]:
    """A manager of the geometry nodes of a trimesh.Scene, by their names, and its objects."""
    manager = CollisionManager()
    objects = {}
    for node in scene.graph.nodes_geometry:
        transform, geometry = scene.graph[node]
        objects[node] = manager.add_object(node, scene.geometry[geometry], transform)
    return manager, objects


def install() -> None:
    """Puts these into `trimesh.collision`. Raises ImportError without trimesh."""
    try:
        import trimesh.collision as theirs  # type: ignore[import]
    except ModuleNotFoundError as problem:
        if problem.name not in ("trimesh", "trimesh.collision"):  # something that trimesh needs
            raise
        raise ImportError(
            "trimesh is not here, so there is no trimesh.collision to replace: install trimesh, or use impinge.trimesh.CollisionManager "
            "as it is, which needs no trimesh"
        ) from None

    for name in ("CollisionManager", "ContactData", "DistanceData", "scene_to_collision"):
        setattr(theirs, name, globals()[name])


def _sorted(names: tuple[Hashable, Hashable]) -> tuple[Hashable, Hashable]:
    a, b = names
    try:
        swap = bool(b < a)  # type: ignore[operator]
    except TypeError:
        swap = repr(b) < repr(a)
    return (b, a) if swap else (a, b)


def _least(found: Iterable[_Distance]) -> _Distance | None:
    listed = list(found)
    return min(listed, key=lambda one: one[0]) if listed else None


def _distances(least: _Distance | None, names: Any, return_names: bool, return_data: bool) -> Any:
    answer: list[Any] = [sys.float_info.max if least is None else float(least[0])]
    if return_names:
        answer.append(names)
    if return_data:
        answer.append(None if least is None else DistanceData(least[1], float(least[0]), least[2]))
    return tuple(answer) if len(answer) > 1 else answer[0]
