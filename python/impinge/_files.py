# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Mesh files, and what queries run on."""

from __future__ import annotations

import errno
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from . import _core
from ._errors import OptionError
from ._mesh import Mesh
from ._scene import Scene

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Object:
    """A mesh node of a file: all its triangles together."""

    name: str  #: unique in the file
    path: str  #: for people: the names from the root to the node, '/' between them
    mesh: Mesh  #: nodes that show the same mesh share it
    pose: NDArray[np.float64]  #: (4, 4); the identity where the node's transform was baked into the mesh
    properties: list[tuple[str, str]]  #: names and values, of IFC
    incomplete: str  #: what the reader left out of the shape; empty: nothing known


@dataclass(frozen=True, eq=False)
class Model:
    """What a file holds."""

    objects: list[Object]  #: in the file's order
    unit_in_metres: float | None  #: metres in one of the units of the coordinates, where the file says it
    missing: list[str]  #: sentences: what of the file is not in the objects
    warnings: list[str]  #: sentences: lost precision, turned axes, changed units

    def scene(self) -> Scene:
        """A new scene of the objects, by their names."""
        scene = Scene()
        for found in self.objects:
            scene.add(found.mesh, found.pose, name=found.name)
        return scene


def read(
    path: str | os.PathLike[str],
    *,
    scale: float = 1.0,
    unit_in_metres: float | None = None,
    stop: _core.Stop | None = None,
) -> Model:
    """Reads a mesh file: OBJ, OFF, PLY, STL, glTF, 3MF, COLLADA, FBX and more; IFC where Node.js is.

    `scale` multiplies every coordinate; without it a file whose unit is known is brought to the one of `unit_in_metres`.

    >>> import impinge, os, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = os.path.join(folder, "part.obj")
    ...     with open(file, "w") as text:
    ...         _ = text.write("o plate\\nv 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n")
    ...     model = impinge.read(file)
    >>> [(found.name, len(found.mesh.faces)) for found in model.objects]
    [('plate', 1)]
    >>> model.scene()
    <impinge.Scene: 1 objects, 1 faces>

    Raises
    ------
    FileNotFoundError, FileError, OptionError, Cancelled, OutOfMemoryError
    """
    file = os.fspath(path)
    if not os.path.exists(file):
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), file)
    importer = os.path.join(os.path.dirname(__file__), "impinge-import")
    if "IMPINGE_IMPORTER" in os.environ or not os.path.exists(importer):
        importer = ""
    objects, unit, missing, messages = _core.read(file, scale, unit_in_metres, importer, stop)
    shared: dict[int, Mesh] = {}
    return Model(
        [
            Object(name, way, shared.setdefault(core.key(), Mesh._wrap(core)), np.asarray(pose), properties, incomplete)
            for name, way, core, pose, properties, incomplete in objects
        ],
        unit,
        missing,
        messages,
    )


class Device(NamedTuple):
    """A device that Vulkan knows of, on which the backends "gpu", "raster" and "hybrid" may run."""

    name: str
    driver: str
    type: str  #: discrete, integrated, virtual, cpu or other
    memory_bytes: int
    is_certified: bool  #: its arithmetic was tried out, and every bound that answers rest on holds
    complaint: str  #: why it is not, and is left out


def set_num_threads(threads: int) -> None:
    """Lets all queries of this process together run on at most so many threads from now on, whatever their own `threads` say; 0: no limit.

    The limit is oneTBB's, and so that of everything in the process that uses the same library. The environment's IMPINGE_NUM_THREADS sets
    it when impinge is imported.

    Raises
    ------
    OptionError
        A negative number, or none.

    Examples
    --------
    >>> import impinge
    >>> impinge.set_num_threads(2)
    >>> impinge.set_num_threads(0)
    """
    if not isinstance(threads, int) or not 0 <= threads < 2**31:
        raise OptionError(f"the number of threads is {threads!r}; choose 1 or more, or 0 for no limit")
    _core.set_num_threads(threads)


def take_environment() -> None:
    """Does what the environment says."""
    threads = os.environ.get("IMPINGE_NUM_THREADS") or "0"
    if not threads.isdecimal():
        raise OptionError(f"the environment's IMPINGE_NUM_THREADS is {threads!r}; choose 1 or more, or 0 for no limit")
    set_num_threads(int(threads))


def devices() -> list[Device]:
    """All devices, the likely fastest first. Raises NoDeviceError, with the reason and the mend."""
    types = ("discrete", "integrated", "virtual", "cpu", "other")
    return [Device(name, driver, types[kind], *rest) for name, driver, kind, *rest in _core.devices()]
