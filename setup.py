# SPDX-FileCopyrightText: The impinge authors
# SPDX-License-Identifier: MIT
"""What pyproject.toml cannot say: the extension module and the importer are built by CMake, in the tree of the preset release."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

source = Path(__file__).parent.resolve()
tree = source / "build" / "release"
version = re.search(r"^project\(impinge VERSION (\S+)", (source / "CMakeLists.txt").read_text(), re.MULTILINE)


class BuildByCMake(build_ext):
    def build_extension(self, extension: Extension) -> None:
        python = Path(sys.executable).resolve()  # what an environment is made of: it outlives the environment
        options = ["-DIMPINGE_BUILD_PYTHON=ON", f"-DPYTHON_EXECUTABLE={python}"]
        subprocess.run(["cmake", "--preset", "release", *options], cwd=source, check=True)
        subprocess.run(["cmake", "--build", tree, "--target", "impinge_python", "impinge-import"], check=True)
        module = Path(self.get_ext_fullpath(extension.name)).resolve()
        module.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(tree / "python" / self.get_ext_filename("_core"), module)
        # The readers start it from where the module is. Without what ./dev page builds, no IFC is read and no page written.
        shutil.copy2(tree / "bin" / "impinge-import", module.parent)
        for file in [*(source / "build" / "ifc").glob("*"), *(source / "build" / "page").glob("report.html")]:
            shutil.copy2(file, module.parent)


setup(
    version=version[1],
    ext_modules=[Extension("impinge._core", [])],
    cmdclass={"build_ext": BuildByCMake},
)
