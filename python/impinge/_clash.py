# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Verdicts on parts, what a part is, and regions of contact."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Hashable, NamedTuple

import numpy as np

from . import _arrays, _core, _show
from ._mesh import MeshLike, as_core, placed
from ._queries import Nearest, OverlapDepth, OverlapVolume, make_depth, make_nearest

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ._scene import Scene


class Verdict(IntEnum):
    """What two parts are to each other. The first four reach into each other by more than the tolerance."""

    DUPLICATE = 0  #: each lies in the other
    INSIDE = 1  #: one lies in the other
    PENETRATING = 2  #: two parts with an inside reach into each other
    CROSSING = 3  #: the same, but one or both are surfaces
    TOUCHING = 4  #: they are no farther apart than the tolerance
    APART = 5


class PartClass(IntEnum):
    """What a part is, by winding numbers."""

    SOLID = 0  #: closed, with an inside
    CRACKED = 1  #: not closed, but it is clear what is inside
    SURFACE = 2  #: anything else


class ContactCounts(NamedTuple):
    """Pairs of triangles that share a point, by `Kind`."""

    crossing: int
    touching: int
    coplanar: int


@dataclass(frozen=True, eq=False)
class Region:
    """One connected region of contact."""

    pairs: int  #: of triangles
    box: NDArray[np.float64]  #: (2, 3): lowest and highest corner
    area: float
    length: float  #: of the lines
    centroid: NDArray[np.float64]  #: (3,)
    normal: NDArray[np.float64]  #: (3,): the way in which b must go to leave a, unit length; zero where contact says none
    lines: list[NDArray[np.float64]]  #: (n, 3) each; a closed one ends where it begins
    faces_a: NDArray[np.int32]
    faces_b: NDArray[np.int32]


@dataclass(frozen=True)
class PartFacts:
    """What a part is."""

    part_class: PartClass  #: the best of its pieces'
    closed: bool
    pieces: tuple[int, int, int]  #: by `PartClass`
    turned: int  #: triangles that had to be turned to find the classes
    unclear_edges: int  #: open edges beside which it is not clear what is inside
    open_edges: int
    self_crossings: int  #: pairs of its triangles that cross or share an area
    degenerate: int  #: triangles whose vertices are collinear
    volume: float  #: of the solid pieces
    area: float
    radius: float  #: of the largest ball known to fit inside


@dataclass(frozen=True, eq=False)
class Clash:
    """Two parts and what is said of them."""

    objects: tuple[Hashable, Hashable]  #: their names; `judge`: 0 and 1
    verdict: Verdict
    inner: Hashable | None  #: with INSIDE: which of the two lies in the other
    note: str  #: a sentence on what the tolerance did; or empty
    tolerance: float  #: that was applied
    fails_below: float  #: the pair fails at a tolerance if and only if that is below this
    contacts: ContactCounts
    nearest: Nearest | None  #: with a clearance, of pairs that do not touch and are nearer than it
    overlap_depth: OverlapDepth | None  #: None where neither is known to reach in
    overlap_volume: OverlapVolume | None  #: with `volumes`, of two solids that overlap; None of others
    regions: list[Region]

    @property
    def fails(self) -> bool:
        """Whether the parts reach into each other by more than the tolerance."""
        return self.verdict <= Verdict.CROSSING

    def __repr__(self) -> str:
        a, b = self.objects
        return f"<impinge.Clash: {a!r}, {b!r}: {self.verdict.name.lower()}>"


_ROW = np.dtype(
    [("a", "O"), ("b", "O"), ("verdict", "u1"), ("fails_below", "f8"), ("depth", "f8"), ("distance", "f8")]
    + [(kind, "i8") for kind in ContactCounts._fields]
)


@dataclass(frozen=True, eq=False)
class Clashes:
    """What `find_clashes` found. A notebook shows it as a table, worst first.

    Reports are those of the command line (docs/reports.md), of the scene as it was then. They tell regions of contact, so the first one
    judges again. `title` stands for the name of a file; `unit_in_metres`: metres in one of your units of length, which BCF and glTF
    are in; `y_up`: whether Y points up, and not Z. Clashes that were unpickled have no scene and write none.
    """

    pairs: list[Clash]  #: by the order of the objects; those that are apart and not nearer than the clearance left out
    parts: dict[Hashable, PartFacts]  #: by name
    _source: _show.Source | None = field(default=None, repr=False)

    def failing(self) -> list[Clash]:
        """The pairs that fail, the largest `fails_below` first."""
        return sorted((pair for pair in self.pairs if pair.fails), key=lambda pair: -pair.fails_below)

    def table(self) -> NDArray[Any]:
        """(N,), a record for each pair, in the same order: to filter and sort by numpy. `depth` is that of the reports, what neither
        part reaches beyond; it and `distance` are NaN where there is none.

        >>> import impinge
        >>> tetrahedron = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> scene = impinge.Scene()
        >>> names = [scene.add(tetrahedron, [[1, 0, 0, 0.5 * k], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) for k in range(3)]
        >>> table = impinge.find_clashes(scene).table()
        >>> table[table["depth"] > 0][["a", "b"]].tolist()
        [(0, 1), (1, 2)]
        """
        rows = [
            (
                *pair.objects,
                pair.verdict,
                pair.fails_below,
                float("nan") if pair.overlap_depth is None else max(depth.hi for depth in pair.overlap_depth),
                float("nan") if pair.nearest is None else pair.nearest.distance,
                *pair.contacts,
            )
            for pair in self.pairs
        ]
        return np.array(rows, dtype=_ROW)

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        title: str = "scene",
        unit_in_metres: float | None = None,
        y_up: bool = False,
        stop: _core.Stop | None = None,
    ) -> None:
        """Writes a report, in the format that the name ends in: .html (the page to look at), .json, .csv, .bcf, or .glb (the regions of contact).

        Raises
        ------
        OptionError
            The name ends in something else, or the unit is not above 0.
        FileError
            The file cannot be written, or the page's program is not installed.
        RangeError, Cancelled, OutOfMemoryError
        """
        _show.save(self._source, path, title, unit_in_metres, y_up, stop)

    def page(
        self, *, title: str = "scene", unit_in_metres: float | None = None, y_up: bool = False, stop: _core.Stop | None = None
    ) -> str:
        """The page that `save` writes to a .html, as text: one document that needs nothing else. Errors as there."""
        return _show.page(self._source, title=title, unit_in_metres=unit_in_metres, y_up=y_up, stop=stop)

    def show(self, height: int = 600, **settings: Any) -> Any:
        """The page in a notebook's cell, so many pixels high, in a frame that reaches nothing outside; settings are those of `page`. A page
        above 20 MB is written to the working folder, and a link to it shown.

        Raises
        ------
        ImportError
            IPython is not installed.
        As `page`.
        """
        return _show.in_notebook(lambda: self.page(**settings), height)

    def _repr_html_(self) -> str:
        return _show.table_of_clashes(self)

    def __repr__(self) -> str:
        return f"<impinge.Clashes: {len(self.pairs)} pairs, {len(self.failing())} fail, of {len(self.parts)} parts>"


def _region(found: tuple[Any, ...]) -> Region:
    pairs, box, area, length, centroid, normal, lines, faces_a, faces_b = found
    return Region(
        pairs,
        np.asarray(box),
        area,
        length,
        np.array(centroid),
        np.array(normal),
        [np.asarray(line) for line in lines],
        np.asarray(faces_a),
        np.asarray(faces_b),
    )


def _clash(found: tuple[Any, ...], names: tuple[Hashable, Hashable]) -> Clash:
    _, verdict, inner, note, tolerance, fails_below, contacts, nearest, depth, volume, regions = found
    return Clash(
        names,
        Verdict(verdict),
        None if inner < 0 else names[inner],
        note,
        tolerance,
        fails_below,
        ContactCounts(*contacts),
        None if nearest is None else make_nearest(nearest),
        None if depth is None else make_depth(depth),
        None if volume is None else OverlapVolume(*volume),
        [_region(region) for region in regions],
    )


def _facts(found: tuple[Any, ...]) -> PartFacts:
    part_class, closed, (solid, cracked, surface), *rest = found
    return PartFacts(PartClass(part_class), closed, (solid, cracked, surface), *rest)


def judge(
    a: MeshLike,
    b: MeshLike,
    pose_a: ArrayLike | None = None,
    pose_b: ArrayLike | None = None,
    *,
    tolerance: float | None = None,
    clearance: float = 0.0,
    depth_precision: float = 0.05,
    regions: bool = False,
    volumes: bool = False,
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> Clash:
    """The verdict on two parts: do they reach into each other by more than the tolerance, and how deep?

    `tolerance`, in your unit of length, None: what rounding of the coordinates leaves. `clearance`: with parts nearer than it their
    distance. `volumes`: how much space two solids have in common. `depth_precision`: how wide intervals of depths may be, relative to the depth; infinity: verdicts alone.

    >>> import impinge
    >>> tetrahedron = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> impinge.judge(tetrahedron, tetrahedron, None, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]])
    <impinge.Clash: 0, 1: touching>

    Raises
    ------
    MeshError, PoseError, RangeError, OptionError, Cancelled, OutOfMemoryError
    """
    options = _core.VerdictOptions(tolerance, clearance, depth_precision, regions, volumes, threads)
    return _clash(_core.judge(*placed(a, b, pose_a, pose_b), options, stop), (0, 1))


def find_clashes(
    scene: Scene,
    *,
    tolerance: float | None = None,
    clearance: float = 0.0,
    depth_precision: float = 0.05,
    regions: bool = False,
    volumes: bool = False,
    threads: int = 0,
    memory: _core.ClashMemory | None = None,
    stop: _core.Stop | None = None,
) -> Clashes:
    """The verdict on every pair of a scene's objects that is not apart, or nearer than the clearance; options as in `judge`.

    With a `ClashMemory`, given again and again as objects move, what did not change is not found out again; the answer is the same.

    >>> import impinge
    >>> tetrahedron = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> scene = impinge.Scene()
    >>> base, top = scene.add(tetrahedron, name="base"), scene.add(tetrahedron, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.5], [0, 0, 0, 1]], name="top")
    >>> clashes = impinge.find_clashes(scene)
    >>> clashes
    <impinge.Clashes: 1 pairs, 1 fail, of 2 parts>
    >>> clashes.pairs
    [<impinge.Clash: 'base', 'top': penetrating>]

    Raises
    ------
    As `judge`.
    """
    options = _core.VerdictOptions(tolerance, clearance, depth_precision, regions, volumes, threads)
    with _core.Reading(scene._core, threads):
        pairs, parts = _core.find_clashes(scene._core, options, memory, stop)
        names = scene._name_of
        return Clashes(
            [_clash(pair, (names[pair[0][0]], names[pair[0][1]])) for pair in pairs],
            {names[i]: _facts(facts) for i, facts in enumerate(parts) if i in names},
            _show.Source(
                _core.Judged(scene._core, tolerance, clearance, depth_precision),
                {names[i]: (i, scene._objects[names[i]].mesh) for i in sorted(names)},
            ),
        )


def examine(mesh: MeshLike, pose: ArrayLike | None = None, *, threads: int = 0, stop: _core.Stop | None = None) -> PartFacts:
    """What a part is: solid, cracked or a surface, and why it is no better.

    >>> import impinge
    >>> tetrahedron = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> facts = impinge.examine(tetrahedron)
    >>> facts.part_class.name, facts.closed, round(6 * facts.volume, 9)
    ('SOLID', True, 1.0)

    Raises
    ------
    As `judge`.
    """
    options = _core.VerdictOptions(None, 0.0, 0.05, False, False, threads)
    return _facts(_core.examine(as_core(mesh, "mesh"), _arrays.pose(pose, "pose"), options, stop))


def contact_regions(
    a: MeshLike,
    b: MeshLike,
    pose_a: ArrayLike | None = None,
    pose_b: ArrayLike | None = None,
    *,
    tolerance: float = 0.0,
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> list[Region]:
    """The connected regions in which two parts touch, largest first. What comes within `tolerance` is in contact; 0: exactly.

    >>> import impinge
    >>> a = [[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]]
    >>> b = [[1, 1, -1], [1, 1, 1], [3, 1, 0]], [[0, 1, 2]]  # goes through a along y = 1
    >>> (region,) = impinge.contact_regions(a, b)
    >>> region.length, region.centroid.tolist()
    (2.0, [2.0, 1.0, 0.0])

    Raises
    ------
    As `judge`; OptionError also for a tolerance that is negative or too large.
    """
    found = _core.contact_regions(*placed(a, b, pose_a, pose_b), tolerance, threads, stop)
    return [_region(region) for region in found]
