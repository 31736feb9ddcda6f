"""pip install ./python --no-build-isolation: CMake builds the module, and needs no network.

The build is that of the project, in build/release (or $BURIN_BUILD_FOLDER): what is built there is not built again.
"""

import os
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = os.path.dirname(os.path.abspath(__file__))


class BuildWithCMake(build_ext):
    def build_extension(self, extension: Extension) -> None:
        project = os.path.join(os.path.dirname(HERE), "CMakeLists.txt")
        if not os.path.exists(project):
            raise SystemExit(f"{os.path.dirname(HERE)} is not the source of burin; run pip install ./python there")
        source = os.path.dirname(os.path.realpath(project))
        build = os.environ.get("BURIN_BUILD_FOLDER") or os.path.join(source, "build", "release")
        configure = ["cmake", "-S", source, "-B", build, "-DBURIN_PYTHON=ON"]
        if not os.path.exists(os.path.join(build, "CMakeCache.txt")):
            base = os.path.realpath(sys.executable)  # that of an environment may be gone tomorrow
            configure += ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBURIN_TESTS=OFF", f"-DPython_EXECUTABLE={base}"]
        subprocess.check_call(configure)
        try:
            subprocess.check_call(["cmake", "--build", build, "--target", "burin_python", "burin_oiio", "burin_draco"])
        except subprocess.CalledProcessError:
            raise SystemExit("burin: the module could not be built; scripts/install-dependencies installs what it needs")
        module = os.path.join(build, "python", os.path.basename(self.get_ext_filename(extension.name)))
        if not os.path.exists(module):
            raise SystemExit(f"burin: {build} is for another Python; set BURIN_BUILD_FOLDER to a new folder")
        target = os.path.dirname(os.path.abspath(self.get_ext_fullpath(extension.name)))
        os.makedirs(target, exist_ok=True)
        shutil.copy(module, target)
        for module in ("burin_oiio.so", "burin_draco.so"):  # are loaded from beside the library, when TIFF or Draco is
            shutil.copy(os.path.join(build, "bin", module), target)


setup(ext_modules=[Extension("burin._core", [])], cmdclass={"build_ext": BuildWithCMake})
