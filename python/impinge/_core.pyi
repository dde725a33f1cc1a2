# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
# The extension module, for the modules beside it alone. Arguments are positional. Arrays that it takes are C-contiguous, of the type and
# shape said here, and were checked there: a pose is float64 (4, 4), or None for the identity; poses are float64 (..., 4, 4). Ids and
# strings are as in the C++ library, structs are tuples of their members. It raises what _errors.py defines.
from types import TracebackType
from typing import Any, Sequence

from numpy import float64, uint32
from numpy.typing import NDArray

VERSION: str

_Numbers = Any  # an _Array: numpy.asarray makes an array of it without a copy
_Pose = NDArray[float64] | None
_Tuple = tuple[Any, ...]

class _Type(type): ...  # pybind11's

class Stop(metaclass=_Type):
    """Ends the queries that are given it; safe to use from every thread."""

    def __init__(self) -> None: ...
    def set(self) -> None:
        """Ends them, those still to come too."""
    def is_set(self) -> bool:
        """Whether `set` was called."""

class Options(metaclass=_Type):
    def __init__(self, first: bool, limit: int, kinds: int, threads: int, backend: str, device: str, /) -> None: ...

class VerdictOptions(metaclass=_Type):
    def __init__(
        self, tolerance: float | None, clearance: float, depth_precision: float, regions: bool, threads: int, /
    ) -> None: ...

class Mesh(metaclass=_Type):
    # vertices: float32 or float64 (V, 3); triangles: (F, 3)
    def __init__(
        self, vertices: NDArray[Any], triangles: NDArray[uint32], leaf_size: int, is_float32: bool, is_single: bool, /
    ) -> None: ...
    def vertices(self) -> _Numbers: ...  # float64 (V, 3)
    def triangles(self) -> _Numbers: ...  # int32 (F, 3)
    def is_single(self) -> bool: ...
    def key(self) -> int: ...  # equal for handles of one mesh, as long as one of them lives
    def triangle_count(self) -> int: ...
    def transformed(self, matrix: NDArray[float64], /) -> Mesh: ...
    def build_tree(self, threads: int, /) -> None: ...
    def memory_bytes(self) -> int: ...

# Answers: (objects, offsets, pairs, kinds, truncated, hash, warnings), and (distance, error, points, (face, face)) or None.
def collide(a: Mesh, pose_a: _Pose, b: Mesh, pose_b: _Pose, options: Options, stop: Stop | None, /) -> _Tuple: ...
def collide_poses(
    a: Mesh, poses_a: NDArray[float64], b: Mesh, poses_b: NDArray[float64], options: Options, stop: Stop | None, /
) -> _Tuple: ...
def touches(a: Mesh, pose_a: _Pose, b: Mesh, pose_b: _Pose, threads: int, stop: Stop | None, /) -> bool: ...
def distance(
    a: Mesh, pose_a: _Pose, b: Mesh, pose_b: _Pose, stop_above: float, threads: int, stop: Stop | None, /
) -> _Tuple | None: ...
def closer_than(
    a: Mesh, pose_a: _Pose, b: Mesh, pose_b: _Pose, limit: float, threads: int, stop: Stop | None, /
) -> bool: ...
def locate(points: NDArray[float64], mesh: Mesh, pose: _Pose, stop: Stop | None, /) -> _Numbers: ...  # uint8 (N,)
def overlap_depth(
    a: Mesh, pose_a: _Pose, b: Mesh, pose_b: _Pose, precision: float, threads: int, stop: Stop | None, /
) -> tuple[float, float, float, float]: ...
def overlap_volume(
    a: Mesh, pose_a: _Pose, b: Mesh, pose_b: _Pose, threads: int, stop: Stop | None, /
) -> tuple[float, float]: ...
def judge(a: Mesh, pose_a: _Pose, b: Mesh, pose_b: _Pose, options: VerdictOptions, stop: Stop | None, /) -> _Tuple: ...
def examine(mesh: Mesh, pose: _Pose, options: VerdictOptions, stop: Stop | None, /) -> _Tuple: ...
def contact_regions(
    a: Mesh, pose_a: _Pose, b: Mesh, pose_b: _Pose, tolerance: float, threads: int, stop: Stop | None, /
) -> list[_Tuple]: ...

class Scene(metaclass=_Type):
    triangles: int
    def __init__(self) -> None: ...
    def add(self, mesh: Mesh, pose: _Pose, group: int, /) -> int: ...
    def set_poses(self, ids: list[int], poses: NDArray[float64], /) -> None: ...
    def set_mesh(self, id: int, mesh: Mesh, pose: _Pose, /) -> None: ...
    def remove(self, id: int, /) -> None: ...
    def ignore(self, a: int, b: int, ignored: bool, /) -> None: ...
    def pose(self, id: int, /) -> _Numbers: ...  # float64 (4, 4)
    def update(self, threads: int, /) -> None: ...
    def collide(self, options: Options, stop: Stop | None, /) -> _Tuple: ...
    def collide_with(self, id: int, options: Options, stop: Stop | None, /) -> _Tuple: ...
    def collide_with_mesh(self, mesh: Mesh, pose: _Pose, options: Options, stop: Stop | None, /) -> _Tuple: ...
    def touches_any(self, threads: int, stop: Stop | None, /) -> bool: ...
    def collide_configurations(
        self, ids: list[int], poses: NDArray[float64], threads: int, stop: Stop | None, /
    ) -> _Numbers: ...  # bool (T,)
    def first_touching(
        self, ids: list[int], poses: NDArray[float64], threads: int, stop: Stop | None, /
    ) -> int | None: ...
    def distance_configurations(
        self, ids: list[int], poses: NDArray[float64], stop_above: float, threads: int, stop: Stop | None, /
    ) -> _Numbers: ...  # float64 (T,)
    # (object, object, nearest)
    def distance(self, id: int | None, stop_above: float, threads: int, stop: Stop | None, /) -> _Tuple | None: ...

class Reading(metaclass=_Type):
    """Holds a scene for queries, beside others."""

    def __init__(self, scene: Scene, /) -> None: ...
    def __enter__(self) -> None: ...
    def __exit__(
        self, type: type[BaseException] | None, value: BaseException | None, traceback: TracebackType | None, /
    ) -> None: ...

class Writing(metaclass=_Type):
    """Holds a scene for a change, alone."""

    def __init__(self, scene: Scene, /) -> None: ...
    def __enter__(self) -> None: ...
    def __exit__(
        self, type: type[BaseException] | None, value: BaseException | None, traceback: TracebackType | None, /
    ) -> None: ...

class ClashMemory(metaclass=_Type):
    """What one call of find_clashes found out, for the next one on the same scene."""

    def __init__(self) -> None: ...
    def known_pairs(self) -> int: ...

def find_clashes(
    scene: Scene, options: VerdictOptions, memory: ClashMemory | None, stop: Stop | None, /
) -> tuple[list[_Tuple], list[_Tuple]]: ...
class Judged(metaclass=_Type):
    """A scene as it was when clashes were found in it, for reports."""

    def __init__(self, scene: Scene, tolerance: float | None, clearance: float, depth_precision: float, /) -> None: ...

def write_report(
    judged: Judged,
    objects: Sequence[tuple[int, str, Mesh]],
    title: str,
    unit_in_metres: float | None,
    y_up: bool | None,
    page_program: str,
    date: str,
    format: str,
    file: str,
    stop: Stop | None,
    /,
) -> None: ...
def read(
    file: str, scale: float, unit_in_metres: float | None, importer: str, stop: Stop | None, /
) -> tuple[list[_Tuple], float | None, list[str], list[str]]: ...
def devices() -> list[_Tuple]: ...
