"""Lets CMake build the wheel: all that the package holds is its install component `python`.

GRIDFEM_LEVELS     for which processors, default "v2 v3 v4" of x86-64; the best of them is taken when
                   the package is imported. "native": for this one alone, in a third of the time
GRIDFEM_BUILD_DIR  a folder where CMake has built the package already
"""
import atexit
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile

import setuptools
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
BUILT = os.environ.get("GRIDFEM_BUILD_DIR")
VERSION = re.search(r"project\(GridFEM VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())
IS_X86 = platform.machine() in ("x86_64", "AMD64")
LEVELS = os.environ.get("GRIDFEM_LEVELS", "v2 v3 v4" if IS_X86 else "native").split()


def cmake(*arguments):
    subprocess.run(["cmake", *map(str, arguments)], check=True)


class Build(build_ext):
    def run(self):
        for build in [BUILT] if BUILT else map(self.compile, LEVELS):
            cmake("--install", build, "--component", "python",
                  "--prefix", pathlib.Path(self.build_lib).resolve())

    def compile(self, level):
        import pybind11  # is there when this runs, not when the metadata are asked for
        build = pathlib.Path(self.build_temp).resolve() / level
        native = level == "native"
        cmake("-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
              "-DGRIDFEM_BUILD_PYTHON=ON", "-DGRIDFEM_BUILD_VTK=OFF", "-DGRIDFEM_CUDA=OFF", "-DGRIDFEM_BUILD_TESTING=OFF",
              f"-DGRIDFEM_NATIVE={'ON' if native else 'OFF'}",
              f"-DCMAKE_CXX_FLAGS={'' if native else '-march=x86-64-' + level}",
              f"-DGRIDFEM_PYTHON_FOLDER={'.' if native else level}",
              f"-DPython3_EXECUTABLE={sys.executable}",
              f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
        cmake("--build", build, "--target", "gridfem_python")
        return build


def base():
    """Returns the folder for what the build makes. It is not build/, which is CMake's."""
    if not BUILT and not os.access(ROOT, os.W_OK):
        folder = tempfile.mkdtemp()
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
        return folder
    folder = pathlib.Path(BUILT) / "wheel" if BUILT else ROOT / "build-wheel"
    folder.mkdir(exist_ok=True)
    return str(folder)


BASE = base()
setuptools.setup(
    version=VERSION.group(1),
    packages=[],
    ext_modules=[setuptools.Extension("gridfem._core", [])],
    cmdclass={"build_ext": Build},
    options={"build": {"build_base": BASE}, "egg_info": {"egg_base": BASE}})
