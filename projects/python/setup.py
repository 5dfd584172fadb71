"""Builds the extension module with CMake, in the build tree of the release; the rest is in pyproject.toml.

In the environment: LOCKSTEP_BUILD, another build tree; LOCKSTEP_MODULE, an extension module that is built already.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("LOCKSTEP_BUILD", ROOT / "build" / "release")).resolve()
WORK = BUILD / "python"  # what setuptools leaves behind


class BuildWithCMake(build_ext):
    def build_extension(self, ext: Extension) -> None:
        to = Path(self.get_ext_fullpath(ext.name))
        to.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(os.environ.get("LOCKSTEP_MODULE") or self.built(), to)

    def built(self) -> Path:
        # Of a virtual environment the interpreter beneath it, which is still there when that is gone.
        interpreter = getattr(sys, "_base_executable", sys.executable)
        options = [f"-DPython_EXECUTABLE={interpreter}", "-DLOCKSTEP_PYTHON=ON"]
        if not (BUILD / "CMakeCache.txt").exists():
            options += ["-DCMAKE_BUILD_TYPE=Release", "-DLOCKSTEP_TESTS=OFF"]
        subprocess.run(["cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", *options], check=True)
        jobs = str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", BUILD, "--parallel", jobs, "--target", "lockstep_python"], check=True)
        return next((BUILD / "projects" / "python" / "lockstep").glob("_lockstep*.so"))


def version() -> str:
    text = (ROOT / "CMakeLists.txt").read_text()
    return re.search(r"^project\(lockstep VERSION ([0-9.]+)", text, re.MULTILINE).group(1)


WORK.mkdir(parents=True, exist_ok=True)
setup(
    version=version(),
    ext_modules=[Extension("lockstep._lockstep", sources=[])],
    cmdclass={"build_ext": BuildWithCMake},
    options={"build": {"build_base": str(WORK)}, "egg_info": {"egg_base": str(WORK)}, "bdist_wheel": {"bdist_dir": str(WORK / "wheel")}},
)
