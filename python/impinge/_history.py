# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""Events of a scene: what has come to touch, still touches, touches no more, or has met in between."""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Any, Hashable

import numpy as np

from . import _core
from ._motion import SceneImpacts
from ._queries import Contacts, rows_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ._scene import Scene


class ContactEvent(IntEnum):
    """What became of two objects since the last call."""

    ENTER = 0  #: they touch, and did not in the last call
    STAY = 1  #: they touch, as in the last call
    LEAVE = 2  #: they touched in the last call, and do not any more; or one is gone, or they are not tested any more
    PASS = 3  #: they touch neither now nor in the last call, but have met on the way


_EVENT = np.dtype([("kind", "u1"), ("a", "O"), ("b", "O")])


class ContactHistory:
    """Compares the contacts of a scene from call to call, object by object. Each ENTER has one LEAVE, the call after the last one of which the
    contacts hold the pair, also where an object was removed and another one has its name. Safe to use from many threads, one call after
    the other.

    Examples
    --------
    >>> import impinge
    >>> scene, sheet = impinge.Scene(), impinge.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> floor, lid = scene.add(sheet, name="floor"), scene.add(sheet, name="lid")
    >>> history = impinge.ContactHistory()
    >>> for height in (0, 0, 3, -3):
    ...     scene.set_pose("lid", [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, height], [0, 0, 0, 1]])
    ...     events = history.update(scene, scene.collide(first=True), scene.find_impacts())
    ...     scene.step()
    ...     print([(impinge.ContactEvent(kind).name, a, b) for kind, a, b in events])
    [('ENTER', 'floor', 'lid')]
    [('STAY', 'floor', 'lid')]
    [('LEAVE', 'floor', 'lid')]
    [('PASS', 'floor', 'lid')]
    """

    def __init__(self) -> None:
        self._core = _core.ContactHistory()
        self._names: dict[int, Hashable] = {}  # of the objects that touched in the last call, by id

    def update(self, scene: Scene, contacts: Contacts, between: SceneImpacts | None = None) -> NDArray[Any]:
        """(N,): records of `kind` (`ContactEvent`), `a` and `b` (names; twice the same of an object with itself), in the order of objects.

        `contacts` are all that `Scene.collide` finds now, or with `first` one of each pair, of all kinds; `between`, for PASS, all that
        `Scene.find_impacts` has found since the last call. No PASS is told of a pair that touches at the start of the motion. After an error the
        history is as it was.

        Raises
        ------
        UnknownObjectError
            Objects that the scene does not have.
        OptionError
            Contacts or impacts that were cut off at a limit, or whose arrays were changed so that they do not fit together.
        OutOfMemoryError
        """
        with self._core, _core.Reading(scene._core):
            met = None if between is None else (*rows_of(between), np.require(between.times, np.float64, ["C", "A"]), between.truncated)
            found = self._core.update(scene._core, *rows_of(contacts), np.require(contacts.pairs, np.int32, ["C", "A"]), contacts.truncated, met)
            rows = np.asarray(found).tolist()
            # What is not known from the last call is in the scene.
            known = self._names
            names = {id: known[id] if id in known else scene._name_of[id & 0xFFFFFFFF] for _, *ids in rows for id in ids}
            self._names = {id: names[id] for kind, *ids in rows if kind <= ContactEvent.STAY for id in ids}
            return np.array([(kind, names[a], names[b]) for kind, a, b in rows], dtype=_EVENT)
