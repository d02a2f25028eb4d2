"""What pip checks before it compiles: the list of requirements is complete, and what is missing has its Debian package."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

top = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(top / "python"))
import check_requirements  # noqa: E402

searched = (top / "python" / "requirements" / "CMakeLists.txt").read_text()


class Requirements(unittest.TestCase):
    def test_every_library_of_the_build_is_checked(self):
        build = "".join((top / file).read_text() for file in ("packaging/libraries.cmake", "python/module.cmake"))
        build += re.search(r"find_package\(Catch2.*", (top / "CMakeLists.txt").read_text())[0]
        names = re.findall(r"^find_package\((\w+)", build, re.M)
        names += re.findall(r"^pkg_check_modules\(\w+ (?:REQUIRED )?(?:IMPORTED_TARGET )?([\w-]+)\)", build, re.M)
        names += re.findall(r"(?:version_in\(|find_file\(\w+ )(\S+?\.hpp)", build)
        same = {"openmesh": "OpenMesh", "gmp": "gmp.h", "mpfr": "mpfr.h"}
        names = {same.get(name, name) for name in names} - {"PkgConfig", "Python3"}
        self.assertGreater(len(names), 20)
        self.assertEqual(names - set(check_requirements.LIBRARIES), set())

    def test_every_name_is_searched_and_installed_by_setup(self):
        setup = (top / "setup.sh").read_text()
        for name, package in check_requirements.LIBRARIES.items():
            self.assertRegex(searched, rf"[( \n]{re.escape(name)}[) \n]", name)
            if package not in ("libgmp-dev", "libmpfr-dev"):  # come with libcgal-dev
                self.assertIn(package, setup)

    def test_what_is_missing_is_named_with_its_package(self):
        off = ("CGAL", "pybind11", "GDAL", "TIFF")
        found, failure = check_requirements.missing_libraries(*(f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=TRUE" for name in off))
        self.assertEqual(failure, "")
        self.assertEqual(sorted(name for name, _ in found), sorted(off))

    def test_nothing_is_missing_here(self):
        self.assertEqual(check_requirements.report(), "")

    def test_pip_is_told_before_anything_is_compiled(self):
        hook = f"import sys; sys.path.insert(0, {str(top / 'python')!r}); import build_wheel; build_wheel.get_requires_for_build_wheel()"
        with tempfile.TemporaryDirectory() as empty:
            ended = subprocess.run(
                [sys.executable, "-c", hook], env={**os.environ, "PATH": empty, "CXX": "c++"}, capture_output=True, text=True
            )
        self.assertEqual(ended.returncode, 1)
        self.assertIn("sudo apt-get install g++ cmake ninja-build pkg-config", ended.stderr)
        self.assertNotIn("Traceback", ended.stderr)


if __name__ == "__main__":
    unittest.main()
