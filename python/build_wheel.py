"""Builds the wheel for pip (PEP 517) by CMake, without anything that would have to be fetched."""

import base64
import hashlib
import os
import pathlib
import subprocess
import sys
import sysconfig
import tempfile
import tomllib
import zipfile

here = pathlib.Path(__file__).resolve().parent
project = tomllib.loads((here.parent / "pyproject.toml").read_text())["project"]
tag = f"cp{sysconfig.get_config_var('py_version_nodot')}"
tags = f"{tag}-{tag}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
info = f"{project['name']}-{project['version']}.dist-info"


def _metadata():
    lines = [
        "Metadata-Version: 2.1",
        f"Name: {project['name']}",
        f"Version: {project['version']}",
        f"Summary: {project['description']}",
        f"License: {project['license']['text']}",
        f"Requires-Python: {project['requires-python']}",
        *(f"Requires-Dist: {one}" for one in project["dependencies"]),
        "Description-Content-Type: text/markdown",
    ]
    return "\n".join(lines) + "\n\n" + (here / "README.md").read_text()


def _built(folder):
    """The module and its data as CMake installs them, in a build folder that is kept for the next time."""
    build = here.parent / "build" / "python"

    def cmake(*arguments):
        subprocess.run(["cmake", *map(str, arguments)], check=True)

    asked = ["-DCMAKE_BUILD_TYPE=Release", "-DDIURNA_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}"]
    cmake("-S", here.parent, "-B", build, "-G", "Ninja", "-Wno-dev", *asked)
    cmake("--build", build, "--target", "_core")
    cmake("--install", build, "--prefix", folder, "--component", "python", "--strip")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"{project['name']}-{project['version']}-{tags}.whl"
    with tempfile.TemporaryDirectory() as hold:
        folder = pathlib.Path(hold)
        _built(folder)
        files = {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}
    for file in sorted((here / "diurna").glob("*.py")):
        files[f"diurna/{file.name}"] = file.read_bytes()
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: diurna\nRoot-Is-Purelib: false\nTag: {tags}\n".encode()
    record = ""
    for path, data in sorted(files.items()):
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{path},sha256={digest},{len(data)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    with zipfile.ZipFile(os.path.join(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in sorted(files.items()):
            wheel.writestr(zipfile.ZipInfo(path, (2026, 1, 1, 0, 0, 0)), data, zipfile.ZIP_DEFLATED)
    return name


def build_sdist(sdist_directory, config_settings=None):
    raise RuntimeError("diurna is built from its checkout: pip install .")
