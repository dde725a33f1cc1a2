# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""What is raised, each both an ImpingeError and the built-in exception that a caller may expect."""


class ImpingeError(Exception):
    """What impinge raises. The message is a sentence that names the place and the mend."""

    code: str = ""  #: the C++ library's name of the kind of error


class MeshError(ImpingeError, ValueError):
    """Vertices or faces that cannot be a mesh, or a mesh that the question makes no sense for."""

    code = "bad_mesh"


class PoseError(ImpingeError, ValueError):
    """A pose that is not a rotation and a translation, or an affine map that is not finite."""

    code = "bad_pose"


class RangeError(ImpingeError, ValueError):
    """World coordinates outside the range in which every answer is exact."""

    code = "out_of_range"


class OptionError(ImpingeError, ValueError):
    """An argument with a value that it cannot have."""

    code = "bad_option"


class UnknownObjectError(ImpingeError, KeyError):
    """A name that the scene does not have."""

    code = "unknown_id"

    def __str__(self) -> str:  # KeyError's has quotes
        return str(self.args[0]) if self.args else ""


class FileError(ImpingeError, ValueError):
    """A file that cannot be read, or whose contents are not what its format says. (A missing file: FileNotFoundError.)"""

    code = "bad_file"


class Cancelled(ImpingeError):
    """The caller's Stop ended the query."""

    code = "cancelled"


class NoDeviceError(ImpingeError, RuntimeError):
    """No device that can run the backend asked for."""

    code = "no_device"


class OutOfMemoryError(ImpingeError, MemoryError):
    """Memory ran out. What the call worked on is as it was."""

    code = "out_of_memory"


class ContactError(ImpingeError, ValueError):
    """Meshes touch that must be apart."""

    code = "in_contact"


class ImpingeWarning(UserWarning):
    """The answer is whole, but something was not as asked for: a device was left out."""


#: In the order of the C++ library's enum Code.
BY_CODE = (
    MeshError,
    PoseError,
    RangeError,
    OptionError,
    UnknownObjectError,
    FileError,
    Cancelled,
    NoDeviceError,
    OutOfMemoryError,
    ContactError,
)
