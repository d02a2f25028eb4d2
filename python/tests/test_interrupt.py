"""Ctrl-C and progress: long calls end soon, leave whole files only, and report their progress."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import diurna
from heated_plate import heated_plate, samples

os.environ["DIURNA_STAGES"] = "off"
soon_s = 4.0  # well within a second on a machine that is not busy; a run of this scene takes far longer

# Says which stage it is in, and what it was ended by.
child = """
import sys
import diurna

def progress(stage, share):
    print(stage, flush=True)

try:
    {call}
except KeyboardInterrupt:
    print("interrupted", flush=True)
    raise
print("done", flush=True)
"""


def interrupted(call, stage, wait_s=0.3):
    """A process that makes this call, sent Ctrl-C a moment after it is in a stage ("": after `wait_s`); its exit code, its
    last line, and how long it took to end."""
    process = subprocess.Popen(
        [sys.executable, "-c", child.format(call=call)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    if stage:
        for line in process.stdout:
            if line.strip() == stage:
                break
    time.sleep(wait_s)
    process.send_signal(signal.SIGINT)
    began = time.monotonic()
    out, err = process.communicate(timeout=60)
    return process.returncode, out.split("\n")[-2] if "\n" in out else out.strip(), err, time.monotonic() - began


class CtrlC(unittest.TestCase):
    def ends(self, call, stage, wait_s=0.3):
        code, last, err, took = interrupted(call, stage, wait_s)
        self.assertTrue(last.endswith("interrupted"), f"{last}\n{err}")
        self.assertIn("KeyboardInterrupt", err)
        self.assertIn(code, (-signal.SIGINT, 130, 1))
        self.assertLess(took, soon_s)

    def test_a_run_in_each_of_its_stages(self):
        scene = samples / "crossover" / "scene.toml"
        for stage in ("terrain", "sky view", "heat balance", "frames of drone"):
            with self.subTest(stage), tempfile.TemporaryDirectory() as name:
                out = pathlib.Path(name) / "out"
                self.ends(f"diurna.Scene({str(scene)!r}).run({str(out)!r}, fresh=True, progress=progress)", stage)
                files = [file for file in out.rglob("*") if file.is_file()]
                self.assertEqual([file for file in files if file.name.endswith(".part")], [])
                for file in files:
                    if file.suffix == ".exr":
                        diurna.read_frame(file)
                    if file.name == "temperatures.nc":
                        diurna.temperatures(file)

    def test_a_study(self):
        scene = samples / "crossover" / "scene.toml"
        with tempfile.TemporaryDirectory() as name:
            out = pathlib.Path(name) / "out"
            self.ends(f"diurna.Scene({str(scene)!r}).crossover(out={str(out)!r}, progress=progress)", "heat balance")
            self.assertFalse(out.exists())

    def test_a_column(self):
        file = samples / "jacksboro" / "column.toml"
        long = 'settings=["time.step_s=1", "time.end=2026-07-16T00:00:00-04:00"]'
        self.ends(f"print('begins', flush=True); [diurna.column({str(file)!r}, {long}) for _ in range(100)]", "begins")

    def test_a_run_goes_on_from_there(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            scene = diurna.Scene(heated_plate(folder), file=folder / "scene.toml")
            whole = scene.run(folder / "whole", fresh=True)

            def stop(stage, share):
                if stage == "frames of drone":
                    raise KeyboardInterrupt

            with self.assertRaises(KeyboardInterrupt):
                scene.run(folder / "out", fresh=True, progress=stop)
            again = scene.run(folder / "out", resume=True, fresh=True)
            self.assertEqual(len(again.frame_files()), len(whole.frame_files()))
            for one, other in zip(again.frame_files(), whole.frame_files()):
                self.assertEqual(one.read_bytes(), other.read_bytes())
            np.testing.assert_array_equal(again.temperatures().kelvin, whole.temperatures().kelvin)


class Progress(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hold = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.hold.name)
        cls.scene = diurna.Scene(heated_plate(cls.folder), file=cls.folder / "scene.toml")

    @classmethod
    def tearDownClass(cls):
        cls.hold.cleanup()

    def test_every_stage_begins_and_ends(self):
        reported = []
        run = self.scene.run(self.folder / "reported", fresh=True, progress=lambda *one: reported.append((*one, threading.get_ident())))
        self.assertEqual({thread for *_, thread in reported}, {threading.get_ident()})
        stages = list(dict.fromkeys(stage for stage, *_ in reported))
        self.assertEqual([stage for stage in run.stages if stage in stages], stages)
        for stage in stages:
            shares = [share for name, share, _ in reported if name == stage]
            self.assertEqual((shares[0], shares[-1]), (0, 1))
            self.assertEqual(shares, sorted(shares))

    def test_what_it_raises_ends_the_run(self):
        def fail(stage, share):
            raise ArithmeticError(stage)

        with self.assertRaisesRegex(ArithmeticError, "terrain"):
            self.scene.run(self.folder / "failed", fresh=True, progress=fail)
        self.assertEqual(list((self.folder / "failed").rglob("*.exr")), [])
        self.assertFalse((self.folder / "failed" / "report.html").exists())

    def test_one_call_given_up_leaves_another_alone(self):
        def stop(stage, share):
            raise KeyboardInterrupt

        found = []
        other = threading.Thread(target=lambda: found.append(self.scene.run(self.folder / "other", fresh=True)))
        other.start()
        with self.assertRaises(KeyboardInterrupt):
            self.scene.run(self.folder / "stopped", fresh=True, progress=stop)
        other.join()
        self.assertEqual(len(found[0].frame_files()), 4)


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # the dark scene has warnings
