# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""impinge finds every pair of triangles that touch between meshes, exactly.

>>> import impinge
>>> tetrahedron = impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
>>> moved = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]]  # up by 1: corner on face
>>> impinge.touches(tetrahedron, tetrahedron, None, moved)
True
"""

# Names stand as themselves, which says to type checkers that they are the package's.
from . import _core, _files
from ._clash import (
    Clash as Clash,
    Clashes as Clashes,
    ContactCounts as ContactCounts,
    PartClass as PartClass,
    PartFacts as PartFacts,
    Region as Region,
    Verdict as Verdict,
    contact_regions as contact_regions,
    examine as examine,
    find_clashes as find_clashes,
    judge as judge,
)
from ._convex import Penetration as Penetration
from ._core import ClashMemory as ClashMemory, Stop as Stop
from ._errors import (
    Cancelled as Cancelled,
    ContactError as ContactError,
    FileError as FileError,
    ImpingeError as ImpingeError,
    ImpingeWarning as ImpingeWarning,
    MeshError as MeshError,
    NoDeviceError as NoDeviceError,
    OptionError as OptionError,
    OutOfMemoryError as OutOfMemoryError,
    PoseError as PoseError,
    RangeError as RangeError,
    UnknownObjectError as UnknownObjectError,
)
from ._files import (
    Device as Device,
    Model as Model,
    Object as Object,
    devices as devices,
    read as read,
    set_num_threads as set_num_threads,
)
from ._history import ContactEvent as ContactEvent, ContactHistory as ContactHistory
from ._manifolds import ContactManifolds as ContactManifolds, Manifolds as Manifolds
from ._mesh import HasVerticesFaces as HasVerticesFaces, Mesh as Mesh, MeshLike as MeshLike
from ._motion import (
    Feature as Feature,
    Impacts as Impacts,
    Moving as Moving,
    SceneImpacts as SceneImpacts,
    Step as Step,
    collision_free_step as collision_free_step,
    find_impacts as find_impacts,
)
from ._placed import penetration as penetration
from ._pose import nearest_pose as nearest_pose, pose_from_quaternion as pose_from_quaternion
from ._predicates import (
    edge_edge_impact as edge_edge_impact,
    orient3d as orient3d,
    triangles_meet as triangles_meet,
    vertex_face_impact as vertex_face_impact,
)
from ._queries import (
    Contacts as Contacts,
    Interval as Interval,
    Kind as Kind,
    Location as Location,
    Nearest as Nearest,
    OverlapDepth as OverlapDepth,
    OverlapVolume as OverlapVolume,
    PointLocator as PointLocator,
    closer_than as closer_than,
    collide as collide,
    collide_poses as collide_poses,
    distance as distance,
    locate as locate,
    overlap_depth as overlap_depth,
    overlap_volume as overlap_volume,
    self_collide as self_collide,
    touches as touches,
    touches_poses as touches_poses,
)
from ._scene import Configurations as Configurations, ObjectDistance as ObjectDistance, Scene as Scene
from ._show import draw as draw
from ._sweeps import (
    Sweep as Sweep,
    TimeOfImpact as TimeOfImpact,
    at_rest as at_rest,
    pose_at as pose_at,
    time_of_impact as time_of_impact,
)

__version__ = _core.VERSION
# For `help` and `import *`.
__all__ = [name for name in dir() if not name.startswith("_")] + ["__version__"]
_files.take_environment()
