"""Builds the wheel for pip (PEP 517) with CMake. Nothing is downloaded: libraries come from the system's packages."""

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
sys.path.insert(0, str(here))
from check_requirements import report  # noqa: E402

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
        *(f"Provides-Extra: {extra}" for extra in project["optional-dependencies"]),
        *(f'Requires-Dist: {one}; extra == "{extra}"' for extra, all in project["optional-dependencies"].items() for one in all),
        "Description-Content-Type: text/markdown",
    ]
    return "\n".join(lines) + "\n\n" + (here / "README.md").read_text()


def _check():
    """Ends with a list of what is missing, before anything is compiled."""
    missing = report()
    if missing:
        sys.stderr.write(f"\n{missing}\n")
        sys.exit(1)


def get_requires_for_build_wheel(config_settings=None):
    _check()
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    folder = pathlib.Path(metadata_directory) / info
    folder.mkdir()
    (folder / "METADATA").write_text(_metadata())
    (folder / "WHEEL").write_text(_wheel_text())
    return info


def _wheel_text():
    return f"Wheel-Version: 1.0\nGenerator: diurna\nRoot-Is-Purelib: false\nTag: {tags}\n"


def _memory():
    """[bytes] of the machine."""
    return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")


def _build(folder):
    """Builds the module and installs it with its data into a folder. The build folder is kept, so a second build is short."""
    build = here.parent / "build" / "python"

    def cmake(*arguments):
        subprocess.run(["cmake", *map(str, arguments)], check=True)

    options = ["-DCMAKE_BUILD_TYPE=Release", "-DDIURNA_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}"]
    options.append(f"-DCMAKE_CXX_FLAGS={os.environ.get('CXXFLAGS', '')} -w")  # warnings are for who changes the code; looking for them takes 7 %
    cores = os.cpu_count() or 1
    if cores <= 4 and _memory() > 11e9:  # large batches of sources: less time in all, but few of them
        options.append("-DDIURNA_BATCH=120")
    cmake("-S", here.parent, "-B", build, "-G", "Ninja", "-Wno-dev", *options)
    jobs = max(1, min(cores, int(_memory() / 4e9)))  # up to 4 GB each
    cmake("--build", build, "--target", "_core", "--parallel", os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", jobs))
    cmake("--install", build, "--prefix", folder, "--component", "python", "--strip")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"{project['name']}-{project['version']}-{tags}.whl"
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        _build(folder)
        module = next((folder / "diurna").glob("_core*.so"))  # whether all that it needs is in it: else the first import fails
        subprocess.run([sys.executable, "-c", "import ctypes, os, sys; ctypes.CDLL(sys.argv[1], mode=os.RTLD_NOW)", str(module)], check=True)
        files = {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}
    for file in sorted(f for f in (here / "diurna").iterdir() if f.suffix in (".py", ".pyi", ".typed")):
        files[f"diurna/{file.name}"] = file.read_bytes()
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = _wheel_text().encode()
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
