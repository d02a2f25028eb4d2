"""Every example runs without an error and prints its results; README.md lists all of them."""

import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

examples = sorted((pathlib.Path(__file__).parent.parent / "examples").glob("*.py"))


def missing(example):
    """Packages that it imports and that are not installed."""
    names = re.findall(r"^import (pandas|xarray)", example.read_text(), re.M)
    return [name for name in names if importlib.util.find_spec(name) is None]


class Examples(unittest.TestCase):
    def test_all(self):
        self.assertTrue(examples)
        for example in examples:
            with self.subTest(example.name), tempfile.TemporaryDirectory() as elsewhere:
                if missing(example):
                    continue
                ended = subprocess.run([sys.executable, example], capture_output=True, text=True, timeout=300, cwd=elsewhere)
                self.assertEqual(ended.returncode, 0, ended.stderr)
                self.assertGreater(len(ended.stdout.splitlines()), 1)
                self.assertEqual(os.listdir(elsewhere), [], "left in the working folder")

    def test_readme_lists_them(self):
        listed = re.findall(r"`(\w+\.py)`", (pathlib.Path(__file__).parent.parent / "README.md").read_text().split("## Examples")[1])
        self.assertEqual(sorted(listed), [example.name for example in examples])


if __name__ == "__main__":
    unittest.main()
