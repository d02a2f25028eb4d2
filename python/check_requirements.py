"""Checks that a compiler, CMake and the libraries of the build are there, before anything is compiled (a few seconds).

python3 python/check_requirements.py prints what is missing and how to get it, and ends with 1 if anything is.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent

# Name of the search (requirements/CMakeLists.txt) -> Debian package.
LIBRARIES = {
    "boost/version.hpp": "libboost-dev",
    "gmp.h": "libgmp-dev",
    "mpfr.h": "libmpfr-dev",
    "CGAL": "libcgal-dev",
    "Catch2": "catch2",
    "CLI11": "libcli11-dev",
    "Eigen3": "libeigen3-dev",
    "embree": "libembree-dev",
    "fmt": "libfmt-dev",
    "GDAL": "libgdal-dev",
    "GeographicLib": "libgeographiclib-dev",
    "nlohmann_json": "nlohmann-json3-dev",
    "OpenMesh": "libopenmesh-dev",
    "OpenSSL": "libssl-dev",
    "PNG": "libpng-dev",
    "TIFF": "libtiff-dev",
    "TBB": "libtbb-dev",
    "pybind11": "pybind11-dev",
    "Python.h": "python3-dev",
    "erfa": "liberfa-dev",
    "OpenEXR": "libopenexr-dev",
    "netcdf": "libnetcdf-dev",
    "hdf5-serial": "libhdf5-dev",
    "fftw3": "libfftw3-dev",
    "tomlplusplus": "libtomlplusplus-dev",
}
LEAST_CMAKE, LEAST_GCC = (3, 25), (12, 0)


def _version(*command):
    """(major, minor) that a program prints, None where it does not run."""
    try:
        printed = subprocess.run(command, capture_output=True, text=True, timeout=60).stdout
    except OSError:
        return None
    found = re.search(r"(\d+)\.(\d+)", printed) or re.search(r"()(\d+)", printed)
    return (int(found[1] or found[2]), int(found[2]) if found[1] else 0) if found else None


def missing_tools():
    """Of the programs: (what, Debian package)."""
    missing = []
    compiler = os.environ.get("CXX", "c++").split()[0]
    version = _version(compiler, "-dumpfullversion", "-dumpversion")
    if version is None:
        missing.append((f"C++ compiler ({compiler})", "g++"))
    elif version < LEAST_GCC and "clang" not in compiler:
        missing.append((f"C++ compiler {LEAST_GCC[0]} or later (found {version[0]}.{version[1]})", "g++"))
    version = _version("cmake", "--version")
    if version is None or version < LEAST_CMAKE:
        found = "" if version is None else f" (found {version[0]}.{version[1]})"
        missing.append((f"CMake {LEAST_CMAKE[0]}.{LEAST_CMAKE[1]} or later{found}", "cmake"))
    for program, package in (("ninja", "ninja-build"), ("pkg-config", "pkg-config")):
        if shutil.which(program) is None:
            missing.append((program, package))
    return missing


def missing_libraries(*options):
    """(what, Debian package) of each, as the build's own CMake finds them; and what CMake said if it failed."""
    with tempfile.TemporaryDirectory() as folder:
        result = pathlib.Path(folder) / "missing"
        command = ["cmake", "-S", here / "requirements", "-B", f"{folder}/build", "-G", "Ninja", "-Wno-dev"]
        command += [f"-DDIURNA_MISSING={result}", f"-DPython3_EXECUTABLE={sys.executable}", *options]
        ended = subprocess.run(list(map(str, command)), capture_output=True, text=True)
        if not result.exists():
            return [], ended.stderr[-2000:]
        return [(name, LIBRARIES[name]) for name in result.read_text().split()], ""


def report():
    """What is missing and how to get it, "" if nothing is."""
    missing, failure = missing_tools(), ""
    without = {package for _, package in missing}
    if not without & {"g++", "cmake", "ninja-build"}:
        libraries, failure = missing_libraries()
        missing += libraries
    if failure:
        return f"diurna: CMake could not look for the libraries:\n{failure}\nGet them by: ./setup.sh --python\n"
    if not missing:
        return ""
    width = max(len(what) for what, _ in missing)
    lines = [f"  {what:{width}}  Debian package {package}" for what, package in missing]
    packages = " ".join(dict.fromkeys(package for _, package in missing))
    text = "diurna: the module cannot be built yet, because these are missing:\n" + "\n".join(lines)
    text += f"\nInstall them, then run pip again:\n  sudo apt-get install {packages}\n"
    if without & {"g++", "cmake", "ninja-build"}:
        text += "The libraries are checked once these are there. ./setup.sh --python installs all of them at once.\n"
    return text


if __name__ == "__main__":
    said = report()
    sys.stderr.write(said)
    sys.exit(1 if said else 0)
