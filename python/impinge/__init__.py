# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""impinge finds every pair of triangles that touch between meshes, exactly.

>>> import impinge
>>> tetrahedron = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> moved = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]]  # up by 1: corner on face
>>> impinge.touches(tetrahedron, tetrahedron, None, moved)
True
"""

from . import _files
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
from ._convex import Penetration
from ._core import VERSION as __version__
from ._core import ClashMemory, Stop
from ._errors import (
    Cancelled,
    ContactError,
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
from ._files import Device, Model, Object, devices, read, set_num_threads
from ._history import ContactEvent, ContactHistory
from ._manifolds import ContactManifolds, Manifolds
from ._mesh import HasVerticesFaces, Mesh, MeshLike
from ._motion import Feature, Impacts, Moving, SceneImpacts, Step, collision_free_step, find_impacts
from ._placed import penetration
from ._pose import nearest_pose, pose_from_quaternion
from ._predicates import edge_edge_impact, orient3d, triangles_meet, vertex_face_impact
from ._queries import (
    Contacts,
    Interval,
    Kind,
    Location,
    Nearest,
    OverlapDepth,
    OverlapVolume,
    PointLocator,
    closer_than,
    collide,
    collide_poses,
    distance,
    locate,
    overlap_depth,
    overlap_volume,
    self_collide,
    touches,
    touches_poses,
)
from ._scene import Configurations, ObjectDistance, Scene
from ._show import draw
from ._sweeps import Sweep, TimeOfImpact, at_rest, pose_at, time_of_impact

__all__ = [
    "Cancelled",
    "Clash",
    "ClashMemory",
    "Clashes",
    "Configurations",
    "ContactCounts",
    "ContactError",
    "ContactEvent",
    "ContactHistory",
    "ContactManifolds",
    "Contacts",
    "Device",
    "Feature",
    "FileError",
    "HasVerticesFaces",
    "Impacts",
    "ImpingeError",
    "ImpingeWarning",
    "Interval",
    "Kind",
    "Location",
    "Manifolds",
    "Mesh",
    "MeshError",
    "MeshLike",
    "Model",
    "Moving",
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
    "Penetration",
    "PointLocator",
    "PoseError",
    "RangeError",
    "Region",
    "Scene",
    "SceneImpacts",
    "Step",
    "Stop",
    "Sweep",
    "TimeOfImpact",
    "UnknownObjectError",
    "Verdict",
    "at_rest",
    "closer_than",
    "collide",
    "collide_poses",
    "collision_free_step",
    "contact_regions",
    "devices",
    "distance",
    "draw",
    "edge_edge_impact",
    "examine",
    "find_clashes",
    "find_impacts",
    "judge",
    "locate",
    "nearest_pose",
    "orient3d",
    "overlap_depth",
    "overlap_volume",
    "penetration",
    "pose_at",
    "pose_from_quaternion",
    "read",
    "self_collide",
    "set_num_threads",
    "time_of_impact",
    "touches",
    "touches_poses",
    "triangles_meet",
    "vertex_face_impact",
    "__version__",
]

_files.take_environment()
