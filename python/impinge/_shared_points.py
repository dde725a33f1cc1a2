# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Where two triangles that touch do so, in floating point."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def shared_points(a: NDArray[np.float64], b: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(K, 3) each: a point that two triangles share, up to rounding, and the unit way by which the second's leaves the first's.

    Such points are corners, or where edges meet planes, or where edges of both pass each other: the one that is least outside of both.
    """
    normal_a, normal_b = (np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]) for t in (a, b))
    points = [a, b]
    with np.errstate(divide="ignore", invalid="ignore"):
        for s, t, normal in ((a, b, normal_b), (b, a, normal_a)):
            along = np.roll(s, -1, axis=1) - s
            where = np.einsum("kij,kj->ki", t[:, :1] - s, normal) / np.einsum("kij,kj->ki", along, normal)
            points.append(s + np.clip(where, 0, 1)[..., None] * along)
        for i in range(3):
            along_a, along_b = a[:, (i + 1) % 3, None] - a[:, i, None], np.roll(b, -1, axis=1) - b
            across = np.cross(along_a, along_b)
            where = np.einsum("kij,kij->ki", np.cross(b - a[:, i, None], along_b), across) / np.einsum("kij,kij->ki", across, across)
            points.append(a[:, i, None] + np.clip(where, 0, 1)[..., None] * along_a)
        candidates = np.concatenate(points, axis=1)
        outside = sum(_outside(candidates, t, n) for t, n in ((a, normal_a), (b, normal_b)))
        best = np.where(np.isfinite(outside), outside, np.inf).argmin(axis=1)
        away = [n / np.linalg.norm(n, axis=1, keepdims=True) for n in (normal_a, normal_b)]
    normal = np.nan_to_num(away[0]) - np.nan_to_num(away[1])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = np.where(length > 1e-9, normal / np.maximum(length, 1e-9), np.nan_to_num(away[0]))
    return candidates[np.arange(len(a)), best], normal


def _outside(points: NDArray[np.float64], triangles: NDArray[np.float64], normals: NDArray[np.float64]) -> NDArray[np.float64]:
    """(K, N): how far points, (K, N, 3), are outside of triangles, (K, 3, 3): a bound in lengths, 0 inside."""
    unit = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    off: NDArray[np.float64] = np.abs(np.einsum("kij,kj->ki", points - triangles[:, :1], unit))
    for i in range(3):
        p, along = triangles[:, i], triangles[:, (i + 1) % 3] - triangles[:, i]
        inward = np.cross(unit, along)
        inward /= np.maximum(np.linalg.norm(inward, axis=1, keepdims=True), np.finfo(float).tiny)
        off += np.maximum(-np.einsum("kij,kj->ki", points - p[:, None], inward), 0)
    return off
