# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Poses of what is nearly one, or given by a quaternion."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from . import _arrays, _core
from ._errors import PoseError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


def nearest_pose(matrix: ArrayLike) -> NDArray[np.float64]:
    """The rotations nearest to matrices that were rotations before they were rounded, with the same translations: (..., 4, 4) of (..., 4, 4).

    Nearest by the sum of squares of what their entries are off.

    Raises
    ------
    PoseError
        Another shape; not finite; a scale or a shear, off by more than 0.1 of a rotation; a mirror image; a last row other than 0 0 0 1.

    Examples
    --------
    >>> import impinge, numpy as np
    >>> impinge.nearest_pose([[1.0001, 0, 0, 5], [0, 1.0001, 0, 0], [0, 0, 1.0001, 0], [0, 0, 0, 1]])[0]
    array([1., 0., 0., 5.])
    """
    array = _arrays.numbers(matrix, "matrix", PoseError)
    if array.shape[-2:] != (4, 4):
        raise PoseError(f"matrix has the shape {array.shape}, not (..., 4, 4)")
    return np.asarray(_core.nearest_poses(array)).reshape(array.shape)


def pose_from_quaternion(quaternion: ArrayLike, translation: ArrayLike = (0.0, 0.0, 0.0)) -> NDArray[np.float64]:
    """The rotation of a quaternion (w, x, y, z), w being the real part, of any length but 0, and then the translation: (..., 4, 4) of
    (..., 4) and (..., 3), broadcast.

    Raises
    ------
    PoseError
        Another shape, or shapes that cannot be broadcast; not finite; a quaternion of length 0.

    Examples
    --------
    >>> import impinge
    >>> impinge.pose_from_quaternion([1, 0, 0, 1], [5, 6, 7])[:3]  # a quarter turn about z
    array([[ 0., -1.,  0.,  5.],
           [ 1.,  0.,  0.,  6.],
           [ 0.,  0.,  1.,  7.]])
    """
    turns, shifts = _arrays.numbers(quaternion, "quaternion", PoseError), _arrays.numbers(translation, "translation", PoseError)
    for what, array, size in (("quaternion", turns, 4), ("translation", shifts, 3)):
        if array.shape[-1:] != (size,):
            raise PoseError(f"{what} has the shape {array.shape}, not (..., {size})")
    try:
        shape = np.broadcast_shapes(turns.shape[:-1], shifts.shape[:-1])
    except ValueError:
        raise PoseError(f"quaternion {turns.shape} and translation {shifts.shape} cannot be broadcast") from None
    both = (np.ascontiguousarray(np.broadcast_to(array, shape + array.shape[-1:])) for array in (turns, shifts))
    return np.asarray(_core.poses_of_quaternions(*both)).reshape(*shape, 4, 4)
