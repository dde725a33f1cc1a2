# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""What pyproject.toml cannot say: the version is the library's, and CMake builds what is compiled, in the tree of the preset release."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

try:
    from pybind11 import get_cmake_dir
except ImportError:
    get_cmake_dir = None  # CMake finds the system's

source = Path(__file__).parent.resolve()
tree = source / "build" / "release"
version = re.search(r'IMPINGE_VERSION "(.+)"', (source / "include" / "impinge" / "version.hpp").read_text())


class BuildByCMake(build_ext):
    def build_extension(self, extension: Extension) -> None:
        python = Path(sys.executable).resolve()  # what an environment is made of: it outlives the environment
        options = ["-DIMPINGE_BUILD_PYTHON=ON", f"-DPYTHON_EXECUTABLE={python}"]
        if get_cmake_dir is not None:
            options.append(f"-Dpybind11_DIR={get_cmake_dir()}")
        subprocess.run(["cmake", "--preset", "release", *options], cwd=source, check=True)
        subprocess.run(["cmake", "--build", tree, "--target", "impinge_python", "impinge_cli", "impinge-import"], check=True)
        module = Path(self.get_ext_fullpath(extension.name)).resolve()
        module.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(tree / "python" / self.get_ext_filename("_core"), module)
        # Beside the module: the command line, which python/bin/impinge starts, its page, and the importer of both, with its reader of
        # IFC. Page and reader are Node.js's part, which ./dev page builds; without them there is no --html, and no IFC is read.
        programs = [tree / "cli" / "impinge", tree / "bin" / "impinge-import"]
        for file in [*programs, source / "build" / "page" / "report.html", *(source / "build" / "ifc").glob("*")]:
            if file in programs or file.exists():
                shutil.copy2(file, module.parent)


setup(
    version=version[1],
    ext_modules=[Extension("impinge._core", [])],
    cmdclass={"build_ext": BuildByCMake},
    # Away from build/page, which a source distribution has, and sdist leaves out what lies in the folder of builds.
    options={"build": {"build_base": "build/setuptools"}},
)
