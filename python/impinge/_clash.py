# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Verdicts on parts, what a part is, and regions of contact."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Hashable, NamedTuple

import numpy as np

from . import _arrays, _core
from ._mesh import MeshLike, as_core, placed
from ._queries import Nearest, OverlapDepth, make_depth, make_nearest

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
    regions: list[Region]

    @property
    def fails(self) -> bool:
        """Whether the parts reach into each other by more than the tolerance."""
        return self.verdict <= Verdict.CROSSING

    def __repr__(self) -> str:
        a, b = self.objects
        return f"<impinge.Clash: {a!r}, {b!r}: {self.verdict.name.lower()}>"


@dataclass(frozen=True, eq=False)
class Clashes:
    """What `find_clashes` found."""

    pairs: list[Clash]  #: by the order of the objects; those that are apart and not nearer than the clearance left out
    parts: dict[Hashable, PartFacts]  #: by name

    def failing(self) -> list[Clash]:
        """The pairs that fail, the largest `fails_below` first."""
        return sorted((pair for pair in self.pairs if pair.fails), key=lambda pair: -pair.fails_below)


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
    _, verdict, inner, note, tolerance, fails_below, contacts, nearest, depth, regions = found
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
    threads: int = 0,
    stop: _core.Stop | None = None,
) -> Clash:
    """The verdict on two parts: do they reach into each other by more than the tolerance, and how deep?

    `tolerance`, in your unit of length, None: what rounding of the coordinates leaves. `clearance`: with parts nearer than it their
    distance. `depth_precision`: how wide intervals of depths may be, relative to the depth; infinity: verdicts alone.

    Raises
    ------
    MeshError, PoseError, RangeError, OptionError, Cancelled, OutOfMemoryError
    """
    options = _core.VerdictOptions(tolerance, clearance, depth_precision, regions, threads)
    return _clash(_core.judge(placed(a, b, pose_a, pose_b), options, stop), (0, 1))


def find_clashes(
    scene: Scene,
    *,
    tolerance: float | None = None,
    clearance: float = 0.0,
    depth_precision: float = 0.05,
    regions: bool = False,
    threads: int = 0,
    memory: _core.ClashMemory | None = None,
    stop: _core.Stop | None = None,
) -> Clashes:
    """The verdict on every pair of a scene's objects that is not apart, or nearer than the clearance; options as in `judge`.

    With a `ClashMemory`, given again and again as objects move, what did not change is not found out again; the answer is the same.

    Raises
    ------
    As `judge`.
    """
    options = _core.VerdictOptions(tolerance, clearance, depth_precision, regions, threads)
    with scene._reading(threads):
        pairs, parts = _core.find_clashes(scene._core, options, memory, stop)
        names = scene._name_of
        return Clashes(
            [_clash(pair, (names[pair[0][0]], names[pair[0][1]])) for pair in pairs],
            {names[i]: _facts(facts) for i, facts in enumerate(parts) if i in names},
        )


def examine(mesh: MeshLike, pose: ArrayLike | None = None, *, threads: int = 0, stop: _core.Stop | None = None) -> PartFacts:
    """What a part is: solid, cracked or a surface, and why it is no better.

    Raises
    ------
    As `judge`.
    """
    options = _core.VerdictOptions(None, 0.0, 0.05, False, threads)
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

    Raises
    ------
    As `judge`; OptionError also for a tolerance that is negative or too large.
    """
    found = _core.contact_regions(placed(a, b, pose_a, pose_b), tolerance, threads, stop)
    return [_region(region) for region in found]
