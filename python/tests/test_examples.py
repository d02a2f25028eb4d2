"""Every example ends well and prints what it says."""

import pathlib
import subprocess
import sys
import unittest

examples = sorted((pathlib.Path(__file__).parent.parent / "examples").glob("*.py"))


class Examples(unittest.TestCase):
    def test_all(self):
        self.assertTrue(examples)
        for example in examples:
            with self.subTest(example.name):
                ended = subprocess.run([sys.executable, example], capture_output=True, text=True, timeout=300)
                self.assertEqual(ended.returncode, 0, ended.stderr)
                self.assertGreater(len(ended.stdout.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
