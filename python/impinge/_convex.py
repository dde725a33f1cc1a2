# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""How deep two convex solids are in each other, by separating axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ._errors import Cancelled

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from . import _core
    from ._mesh import Mesh

    F8 = NDArray[np.float64]

_ROUNDING = 1e-9  # of a length against the solids' size, or of a unit vector: far above what double leaves, and below what is modelled
_FLAT = 1e-5  # of the size: how far a face may lie above its neighbour, so that flat sides in single precision count as convex


class Penetration(NamedTuple):
    """The shortest way out of two convex solids."""

    depth: float  #: negative: they are apart by so much along the normal
    normal: F8  #: (3,): the unit direction in which b leaves a by the depth
    point: F8  #: (3,): half-way between the deepest features of both


class Hull(NamedTuple):
    """A convex mesh: equal vertices are one."""

    vertices: F8  #: (V, 3), in the mesh's order
    normals: F8  #: (F, 3): unit, outwards
    corners: F8  #: (F, 3): one of each face
    starts: F8  #: (E, 3): one end of each edge between faces that are not coplanar
    edges: F8  #: (E, 3): unit directions of these edges
    beside: NDArray[np.int64]  #: (2, E): the two faces at each edge

    def moved(self, pose: F8) -> Hull:
        turn, shift = pose[:3, :3].T, pose[:3, 3]
        vertices, corners, starts = (points @ turn + shift for points in (self.vertices, self.corners, self.starts))
        return Hull(vertices, self.normals @ turn, corners, starts, self.edges @ turn, self.beside)


def hull_of(mesh: Mesh) -> Hull | None:
    """The mesh if it is convex: one closed surface, turned outwards, that bends nowhere inwards; else None.

    A closed connected surface without holes that is convex at each of its edges is convex (Tietze and Nakajima).
    """
    vertices, first, same = np.unique(mesh.vertices + 0.0, axis=0, return_index=True, return_inverse=True)
    faces = same.reshape(-1)[mesh.faces]
    used = np.unique(faces)
    if len(used) < 4:
        return None
    corners = vertices[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    if not (lengths > 0).all():
        return None
    normals = normals / lengths[:, None]

    half = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    owner = np.tile(np.arange(len(faces)), 3)
    opposite = np.concatenate([faces[:, 2], faces[:, 0], faces[:, 1]])
    forth, back = np.lexsort((half[:, 1], half[:, 0])), np.lexsort((half[:, 0], half[:, 1]))
    if not np.array_equal(half[forth], half[back][:, ::-1]) or (np.diff(half[forth], axis=0) == 0).all(axis=1).any():
        return None  # some edge has not one face on either side
    if len(used) - len(half) // 2 + len(faces) != 2:
        return None  # several surfaces, or holes
    size = np.linalg.norm(np.ptp(vertices[used], axis=0))
    across = np.einsum("ij,ij->i", normals[owner[forth]], vertices[opposite[back]] - vertices[half[forth, 0]])
    volume = np.einsum("ij,ij->", corners[:, 0] - vertices[used].mean(axis=0), normals * lengths[:, None])
    if (across > _FLAT * size).any() or volume <= 0:
        return None

    left, right = normals[owner[forth]], normals[owner[back]]
    bends = (half[forth, 0] < half[forth, 1]) & (np.linalg.norm(left - right, axis=1) > _ROUNDING)
    starts = vertices[half[forth, 0]][bends]
    along = vertices[half[forth, 1]][bends] - starts
    along /= np.linalg.norm(along, axis=1)[:, None]
    beside = np.stack([owner[forth][bends], owner[back][bends]])
    return Hull(vertices[used[np.argsort(first[used])]], normals, corners[:, 0], starts, along, beside)


def penetration(a: Hull, b: Hull, stop: _core.Stop | None = None) -> Penetration:
    """Of two placed hulls. Directions are the face normals of both, and the cross products of edges whose arcs on the Gaussian sphere cross
    (Gregorius, "The Separating Axis Test between Convex Polyhedra", 2013). Of equally deep ones the lexicographically smallest."""
    rounding = _ROUNDING * (np.ptp(a.vertices, axis=0).max() + np.ptp(b.vertices, axis=0).max())
    of_a, of_b = a.normals, -b.normals
    far_b, far_a = _farthest(b, -of_a), _farthest(a, of_b)
    depths_a = np.einsum("ij,ij->i", a.corners - far_b, of_a)
    depths_b = np.einsum("ij,ij->i", far_a - b.corners, of_b)
    limit = max(min(depths_a.min(), depths_b.min()), 0.0) + 2 * rounding
    some_a = _shallow(a.starts - far_b[a.beside], of_a[a.beside], limit)
    some_b = _shallow(far_a[b.beside] - b.starts, of_b[b.beside], limit)
    edges_a, beside_a, edges_b, beside_b = a.edges[some_a], of_a[a.beside[:, some_a]], b.edges[some_b], of_b[b.beside[:, some_b]]
    of_edges = _edge_directions(edges_a, beside_a, edges_b, beside_b, stop)

    directions = np.concatenate([of_a[depths_a <= limit], of_b[depths_b <= limit], of_edges])
    directions = np.unique(directions.round(12) + 0.0, axis=0)
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    depths = np.einsum("ij,ij->i", _farthest(a, directions) - _farthest(b, -directions), directions)
    best = np.flatnonzero(depths <= depths.min() + rounding)[0]  # directions are sorted
    normal = directions[best]
    return Penetration(float(depths[best]), normal, _point(a, b, normal, rounding))


def _farthest(hull: Hull, directions: F8) -> F8:
    """(N, 3): the vertices that are farthest in directions, (N, 3)."""
    parts = np.array_split(directions, 1 + len(directions) * len(hull.vertices) // 2**22)
    across = hull.vertices.T.copy()  # in this layout the product takes a fourth of the time
    farthest: F8 = hull.vertices[np.concatenate([(some @ across).argmax(axis=1) for some in parts])]
    return farthest


def _shallow(far: F8, normals: F8, limit: float) -> NDArray[np.bool_]:
    """(E,): for which edges' arcs, between normals (2, E, 3), the depth may somewhere be at most a limit that is above 0.

    far, (2, E, 3), are points of the Minkowski difference that are farthest in these normals. The depth in a direction n is at least far * n
    for both of them: along an arc the greater of two sinusoids, each concave where it is above 0, so that the least is at an end of the
    arc, which is a face's direction, or where both are equal. Where they are the same point, no arc of the other hull crosses this one.
    """
    (p, q), (m, n) = far, normals
    across = np.einsum("ij,ij->i", p - q, m)[:, None] * n - np.einsum("ij,ij->i", p - q, n)[:, None] * m
    lengths = np.linalg.norm(across, axis=1)
    shallow: NDArray[np.bool_] = (np.einsum("ij,ij->i", p, across) <= limit * lengths) & (lengths > 0)
    return shallow


def _edge_directions(edges_a: F8, beside_a: F8, edges_b: F8, beside_b: F8, stop: _core.Stop | None) -> F8:
    """(N, 3): the normals of those faces of the Minkowski difference that two edges span, unit, away from a. beside: (2, E, 3) each, the
    difference's normals at the ends of the edges' arcs."""
    m0, m1 = beside_b
    of_b = np.cross(m0, m1)
    found = [np.empty((0, 3))]
    for part in np.array_split(np.arange(len(edges_a)), 1 + len(edges_a) * len(edges_b) // 2**20):
        if stop is not None and stop.is_set():
            raise Cancelled("the query was stopped before it was complete")
        p0, p1 = beside_a[:, part]
        of_a = np.cross(p0, p1)
        c0, c1 = of_a @ m0.T, of_a @ m1.T  # on which sides of a's arc the ends of b's are
        d0, d1 = p0 @ of_b.T, p1 @ of_b.T
        i, j = np.nonzero((c0 * c1 < 0) & (d0 * d1 < 0) & (c1 * d0 > 0))
        across = np.cross(edges_a[part[i]], edges_b[j])
        lengths = np.linalg.norm(across, axis=1)
        some = lengths > _ROUNDING
        across = across[some] / lengths[some, None]
        outward = np.einsum("ij,ij->i", across, p0[i[some]] + p1[i[some]])
        found.append(across * np.sign(outward)[:, None])
    return np.concatenate(found)


def _point(a: Hull, b: Hull, normal: F8, rounding: float) -> F8:
    """Of a's feature the first vertex over b's, else of b's over a's, else where two of their edges cross; half-way."""
    heights_a, heights_b = a.vertices @ normal, b.vertices @ normal
    top, bottom = heights_a.max(), heights_b.min()
    feature_a, feature_b = a.vertices[heights_a >= top - rounding], b.vertices[heights_b <= bottom + rounding]
    u = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    u /= np.linalg.norm(u)
    flat = np.stack([u, np.cross(normal, u)], axis=1)
    flat_a, flat_b = feature_a @ flat, feature_b @ flat
    outline_a, outline_b = _outline(flat_a), _outline(flat_b)
    for points, outline in ((flat_a, outline_b), (flat_b, outline_a)):
        over = [point for point in points if _is_over(point, outline, rounding)]
        if over:
            break
    place: F8 = flat @ (over[0] if over else _crossing(outline_a, outline_b)) + normal * (top + bottom) / 2
    return place


def _turn(a: F8, b: F8) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def _outline(points: F8) -> F8:
    """The corners of the convex hull in the plane, counter-clockwise (Andrew's monotone chain)."""
    points = np.unique(points, axis=0)
    chains = []
    for some in (points, points[::-1]):
        chain: list[F8] = []
        for p in some:
            while len(chain) > 1 and _turn(chain[-1] - chain[-2], p - chain[-2]) <= 0:
                chain.pop()
            chain.append(p)
        chains += chain[:-1] if len(chain) > 1 else chain
    return np.array(chains if len(points) > 1 else points)


def _is_over(point: F8, outline: F8, rounding: float) -> bool:
    if len(outline) == 1:
        return bool(np.linalg.norm(point - outline[0]) <= rounding)
    for p, q in zip(outline, np.roll(outline, -1, axis=0)):
        if _turn(q - p, point - p) < -rounding * np.linalg.norm(q - p):
            return False
    if len(outline) == 2:  # both ways above: on its line
        along = outline[1] - outline[0]
        return bool(-rounding <= (point - outline[0]) @ along / np.linalg.norm(along) <= np.linalg.norm(along) + rounding)
    return True


def _crossing(a: F8, b: F8) -> F8:
    """Where an edge of one outline crosses one of the other, or else half-way between their middles."""
    for p, q in zip(a, np.roll(a, -1, axis=0)):
        for r, s in zip(b, np.roll(b, -1, axis=0)):
            turn = _turn(q - p, s - r)
            if turn != 0:
                t, v = _turn(r - p, s - r) / turn, _turn(r - p, q - p) / turn
                if 0 <= t <= 1 and 0 <= v <= 1:
                    crossing: F8 = p + t * (q - p)
                    return crossing
    middle: F8 = (a.mean(axis=0) + b.mean(axis=0)) / 2
    return middle
