# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Contact manifolds, for solvers of rigid bodies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Hashable

import numpy as np

from . import _core
from ._queries import rows_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ._queries import Contacts
    from ._scene import Scene


@dataclass(frozen=True, eq=False)
class Manifolds:
    """What a solver of rigid bodies asks of each connected region of contact, a and b being its objects. The arrays own their memory."""

    objects: NDArray[np.int32]  #: (M, 2): indices, as in `Contacts`
    names: tuple[tuple[Hashable, Hashable], ...]  #: M: of a and b
    ids: NDArray[np.int64]  #: (M,): one's stays while the region persists, and is never used again
    middles: NDArray[np.float64]  #: (M, 3): of the contour, by length
    normals: NDArray[np.float64]  #: (M, 3): unit, the way in which b must go to leave a; 0 where contact says none
    depths: NDArray[np.float64]  #: (M,): of the deepest points
    sizes: NDArray[np.int32]  #: (M,): how many points there are, 1 to 4; rows behind them are 0
    points: NDArray[np.float64]  #: (M, 4, 2, 3): one of a and one of b each; along the normal a's is beyond b's by the point's depth
    point_depths: NDArray[np.float64]  #: (M, 4): 0 or more

    def __repr__(self) -> str:
        return f"<impinge.Manifolds: {len(self.ids)} of {len(set(self.names))} pairs of objects>"


class ContactManifolds:
    """Makes manifolds of a scene's contacts, frame by frame, and keeps what the next frame needs: ids and the order of points.

    What they are is said in the C++ header manifolds.hpp. Safe to use from many threads, one frame after the other.

    Examples
    --------
    >>> import impinge, numpy as np
    >>> n = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    >>> down = impinge.Mesh([[0, 0, 0], [4, 0, 4], [0, 4, 4], [-4, -4, 4]], [face[::-1] for face in n])
    >>> floor = impinge.Mesh([[9, 9, 0], [-9, 9, 0], [0, -9, 0], [0, 0, -9]], n)
    >>> scene, manifolds = impinge.Scene(), impinge.ContactManifolds()
    >>> _ = scene.add(floor, name="floor"), scene.add(down, [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -0.25], [0, 0, 0, 1]], name="tip")
    >>> found = manifolds.update(scene, scene.collide())
    >>> found.names, found.depths.tolist(), abs(found.normals).tolist()
    ((('floor', 'tip'),), [0.25], [[0.0, 0.0, 1.0]])
    """

    def __init__(self) -> None:
        self._core = _core.ContactManifolds()

    def update(self, scene: Scene, contacts: Contacts) -> Manifolds:
        """The manifolds of all contacts that `Scene.collide` has found, in the order of their objects; none of an object with itself.

        Raises
        ------
        UnknownObjectError
            Objects or triangles that the scene does not have.
        OptionError
            Contacts that were cut off at a limit, or whose arrays were changed so that they do not fit together.
        OutOfMemoryError
        """
        pairs = np.require(contacts.pairs, np.int32, ["C", "A"])
        with _core.Reading(scene._core):
            found = self._core.update(scene._core, *rows_of(contacts), pairs, contacts.truncated)
            of, ids, middles, normals, depths, sizes, points, point_depths = [np.asarray(array) for array in found]
            names = tuple((scene._name_of[a], scene._name_of[b]) for a, b in of.tolist())
        return Manifolds(of, names, ids, middles, normals, depths, sizes, points, point_depths)
