# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Arrays as the library takes them: equal to what the caller gave, or refused."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import ImpingeError, MeshError, OptionError, PoseError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_IDENTITY = np.eye(4)[None]
_F8 = np.dtype(np.float64)


def _array(values: Any, what: str, error: type[ImpingeError]) -> NDArray[Any]:
    try:
        array = np.asarray(values)
    except (ValueError, TypeError, OverflowError, RuntimeError) as problem:  # the last one is of tensors that require gradients
        raise error(f"{what} cannot be an array: {problem}") from None
    if isinstance(values, np.ma.MaskedArray) and np.any(values.mask):
        raise error(f"{what} has masked entries; leave them out")
    return array


def numbers(values: ArrayLike, what: str, error: type[ImpingeError]) -> NDArray[np.float64]:
    """As float64, C-contiguous, without a copy where it is so. Numbers that no double equals are refused."""
    array = _array(values, what, error)
    if array.dtype.kind not in "fiu" and array.size:
        raise error(f"{what} has the type {array.dtype}; give real numbers")
    converted = np.require(array, np.float64, ["C", "A"])
    # All others convert without loss.
    if array.dtype.kind in "iu" and array.itemsize == 8 or array.itemsize > 8:
        if not np.array_equal(converted.astype(array.dtype), array, equal_nan=array.dtype.kind == "f"):
            raise error(f"{what} has numbers of the type {array.dtype} that no double equals; round them first")
    return converted.reshape(array.shape)


def points(values: ArrayLike, what: str, error: type[ImpingeError]) -> NDArray[np.float64]:
    """Of the shape (..., 3)."""
    array = numbers(values, what, error)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise error(f"{what} has the shape {array.shape}, not (..., 3)")
    return array


def vertices(values: ArrayLike) -> NDArray[Any]:
    """As float64, or float32 where they are not wider; of the shape (V, 3), C-contiguous."""
    array = _array(values, "vertices", MeshError)
    if array.size == 0 and array.ndim < 2:
        array = np.empty((0, 3))
    if array.ndim != 2 or array.shape[1] != 3:
        hint = "; transpose it" if array.ndim == 2 and array.shape[0] == 3 else ""
        raise MeshError(f"vertices has the shape {array.shape}, not (V, 3){hint}")
    if array.dtype.kind == "f" and array.itemsize <= 4:
        return np.require(array, np.float32, ["C", "A"])
    return numbers(array, "vertices", MeshError)


def faces(values: ArrayLike, vertex_count: int) -> NDArray[np.uint32]:
    """As uint32 below vertex_count, of the shape (F, 3), C-contiguous."""
    array = _array(values, "faces", MeshError)
    if array.size == 0 and array.ndim < 2:
        array = np.empty((0, 3), np.uint32)
    if array.ndim != 2 or array.shape[1] != 3:
        hint = "; transpose it" if array.ndim == 2 and array.shape[0] == 3 else ""
        raise MeshError(f"faces has the shape {array.shape}, not (F, 3): three vertex indices a triangle{hint}")
    if array.size == 0:
        return np.empty((0, 3), np.uint32)
    if array.dtype.kind not in "iu":
        raise MeshError(f"faces has the type {array.dtype}; give integers, vertex indices counted from 0")
    if int(array.min()) < 0 or int(array.max()) >= vertex_count:
        row = int(np.flatnonzero(((array < 0) | (array >= vertex_count)).any(axis=1))[0])
        raise MeshError(f"faces[{row}] is {array[row].tolist()}, but there are {vertex_count} vertices, counted from 0")
    return np.require(array, np.uint32, ["C", "A"])


def matrix(values: ArrayLike, what: str) -> NDArray[np.float64]:
    """Of the shape (4, 4)."""
    if type(values) is np.ndarray and values.shape == (4, 4) and values.dtype == _F8 and values.flags.carray:
        return values  # most are so, and the checks below take longer than many a query
    array = numbers(values, what, PoseError)
    if array.shape != (4, 4):
        raise PoseError(f"{what} has the shape {array.shape}, not (4, 4)")
    return array


def pose(values: ArrayLike | None, what: str) -> NDArray[np.float64] | None:
    """Of the shape (4, 4); None stands for the identity."""
    return None if values is None else matrix(values, what)


def poses(values: ArrayLike | None, what: str, shape: tuple[str, ...] = ("N",)) -> NDArray[np.float64]:
    """Of the shape (N, 4, 4), or (T, M, 4, 4) with ("T", "M"); None stands for one identity."""
    if values is None:
        return _IDENTITY
    array = numbers(values, what, PoseError)
    if array.ndim != len(shape) + 2 or array.shape[-2:] != (4, 4):
        raise PoseError(f"{what} has the shape {array.shape}, not ({', '.join(shape)}, 4, 4)")
    return array


def limit(value: int | None) -> int:
    """How many at most; None: all."""
    if value is None:
        return 2**64 - 1
    if not 0 <= value < 2**64:
        raise OptionError(f"limit is {value}; choose 0 or more, or None for all")
    return value


def kinds(values: Any) -> int:
    """Kinds as the bits that the library takes; None: all."""
    if values is None:
        return 7
    bits = 0
    for kind in (values,) if isinstance(values, (int, np.integer)) else values:
        if kind not in (0, 1, 2):
            raise OptionError(f"kinds has {kind!r}; give one Kind or several")
        bits |= 1 << int(kind)
    if bits == 0:
        raise OptionError("kinds is empty; give one Kind or several, or None for all")
    return bits
