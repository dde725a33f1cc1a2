# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Expected answers in rational numbers, and shapes."""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations

import numpy as np

CUBE_FACES = np.array(
    [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7], [0, 1, 5], [0, 5, 4], [1, 2, 6], [1, 6, 5], [2, 3, 7], [2, 7, 6], [3, 0, 4], [3, 4, 7]]
)
CUBE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)  # [0, 1]^3


def moved(*t):
    pose = np.eye(4)
    pose[:3, 3] = t
    return pose


def grid(n, height=lambda x, y: 0 * x):
    """(n^2 vertices, 2 (n - 1)^2 faces) over the unit square."""
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij")
    i = np.arange(n * n).reshape(n, n)
    a, b, c, d = i[:-1, :-1].ravel(), i[1:, :-1].ravel(), i[1:, 1:].ravel(), i[:-1, 1:].ravel()
    return np.stack([x.ravel(), y.ravel(), height(x, y).ravel()], axis=1), np.concatenate(
        [np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]
    )


def world(vertices, pose):
    """The world vertices by the contract's formula: each product and sum rounded once."""
    R, t = pose[:3, :3].tolist(), pose[:3, 3].tolist()
    return [[((R[i][0] * x + R[i][1] * y) + R[i][2] * z) + t[i] for i in range(3)] for x, y, z in np.asarray(vertices, float).tolist()]


def _solve(columns):
    """The unique x with columns x = (0, 0, 0, 1, 1), or None."""
    k = len(columns)
    rows = [[column[i] for column in columns] + [Fraction(int(i > 2))] for i in range(5)]
    for p in range(k):
        pivot = next((i for i in range(p, 5) if rows[i][p]), None)
        if pivot is None:
            return None
        rows[p], rows[pivot] = rows[pivot], rows[p]
        rows[p] = [x / rows[p][p] for x in rows[p]]
        for i in range(5):
            if i != p and rows[i][p]:
                rows[i] = [x - rows[i][p] * y for x, y in zip(rows[i], rows[p])]
    return None if any(row[k] for row in rows[k:]) else [row[k] for row in rows[:k]]


def _det(a, b, c):
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])


def _common(s, t):
    """Corners of the polytope of all (l, m) >= 0 of sum 1 each with sum l_i s_i = sum m_j t_j: the basic solutions. Rational points."""
    for axis in range(3):
        if max(p[axis] for p in s) < min(p[axis] for p in t) or max(p[axis] for p in t) < min(p[axis] for p in s):
            return []
    columns = [p + [Fraction(1), Fraction(0)] for p in s] + [[-x for x in p] + [Fraction(0), Fraction(1)] for p in t]
    corners = []
    for size in range(2, 6):
        for chosen in combinations(range(len(columns)), size):
            x = _solve([columns[i] for i in chosen])
            if x is not None and min(x) >= 0:
                corners.append([x[chosen.index(i)] if i in chosen else 0 for i in range(len(columns))])
    return corners


def _rational(points):
    return [[Fraction(x) for x in p] for p in points]


def impact(s, t, way):
    """The first time in [0, 1] at which the hull of s meets that of t, which stands still, while s moves by `way`; or None.

    At time T a point of s is at sum l_i s_i + T way, which is a sum over the corners of the hull of s at both ends, where T is the weight of
    the second end; it is linear, and so least at a corner of the polytope.
    """
    s, t, way = _rational(s), _rational(t), _rational([way])[0]
    found = _common(s + [[x + y for x, y in zip(p, way)] for p in s], t)
    return min((sum(corner[len(s) : 2 * len(s)]) for corner in found), default=None)


def kind(s, t):
    """How two closed triangles meet: None, or 0 crossing, 1 touching, 2 coplanar.

    The mean of the corners has no zero unless all have it there, so it is positive if and only if relative interiors meet.
    """
    s, t = _rational(s), _rational(t)
    corners = _common(s, t)
    if not corners:
        return None

    def edges(p, origin):
        return [[x - y for x, y in zip(q, origin)] for q in p]

    def proper(p):
        (a, b) = edges(p[1:], p[0])
        return any(a[i] * b[j] - a[j] * b[i] for i, j in ((0, 1), (1, 2), (2, 0)))

    if not proper(s) or not proper(t):
        return 1
    u, v = edges(s[1:], s[0])
    if all(_det(u, v, w) == 0 for w in edges(t, s[0])):
        return 2
    return 0 if all(sum(corner[i] for corner in corners) > 0 for i in range(6)) else 1


def contacts(vertices_a, faces_a, vertices_b, faces_b):
    """[(triangle of a, triangle of b, kind)] by brute force."""
    found = []
    for i, f in enumerate(np.asarray(faces_a).tolist()):
        for j, g in enumerate(np.asarray(faces_b).tolist()):
            how = kind([vertices_a[k] for k in f], [vertices_b[k] for k in g])
            if how is not None:
                found.append((i, j, how))
    return found
