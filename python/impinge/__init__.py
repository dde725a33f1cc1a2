# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""impinge finds every pair of triangles that touch between meshes, exactly.

>>> import impinge
>>> tetrahedron = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> moved = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]]  # up by 1: corner on face
>>> impinge.touches(tetrahedron, tetrahedron, None, moved)
True
"""

from ._clash import (
    Clash,
    Clashes,
    ContactCounts,
    PartClass,
    PartFacts,
    Region,
    Verdict,
    contact_regions,
    examine,
    find_clashes,
    judge,
)
from ._core import VERSION as __version__
from ._core import ClashMemory, Stop
from ._errors import (
    Cancelled,
    FileError,
    ImpingeError,
    ImpingeWarning,
    MeshError,
    NoDeviceError,
    OptionError,
    OutOfMemoryError,
    PoseError,
    RangeError,
    UnknownObjectError,
)
from ._files import Device, Model, Object, devices, read
from ._mesh import HasVerticesFaces, Mesh, MeshLike
from ._queries import (
    Contacts,
    Interval,
    Kind,
    Location,
    Nearest,
    OverlapDepth,
    OverlapVolume,
    closer_than,
    collide,
    collide_poses,
    distance,
    locate,
    overlap_depth,
    overlap_volume,
    touches,
    touches_poses,
)
from ._scene import ObjectDistance, Scene
from ._show import draw

__all__ = [
    "Cancelled",
    "Clash",
    "ClashMemory",
    "Clashes",
    "ContactCounts",
    "Contacts",
    "Device",
    "FileError",
    "HasVerticesFaces",
    "ImpingeError",
    "ImpingeWarning",
    "Interval",
    "Kind",
    "Location",
    "Mesh",
    "MeshError",
    "MeshLike",
    "Model",
    "Nearest",
    "NoDeviceError",
    "Object",
    "ObjectDistance",
    "OptionError",
    "OutOfMemoryError",
    "OverlapDepth",
    "OverlapVolume",
    "PartClass",
    "PartFacts",
    "PoseError",
    "RangeError",
    "Region",
    "Scene",
    "Stop",
    "UnknownObjectError",
    "Verdict",
    "closer_than",
    "collide",
    "collide_poses",
    "contact_regions",
    "devices",
    "distance",
    "draw",
    "examine",
    "find_clashes",
    "judge",
    "locate",
    "overlap_depth",
    "overlap_volume",
    "read",
    "touches",
    "touches_poses",
    "__version__",
]
