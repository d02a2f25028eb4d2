"""What a notebook displays: well-formed HTML and SVG with curves and pictures."""

import os
import pathlib
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import numpy as np

import diurna
from diurna.figures import curves_svg
from heated_plate import heated_plate
from test_point import plate, weather

os.environ["DIURNA_STAGES"] = "off"


def tags(html):
    """Counts of the elements of well-formed HTML."""
    count = {}
    for element in ElementTree.fromstring(f"<div>{html}</div>").iter():
        name = element.tag.split("}")[-1]
        count[name] = count.get(name, 0) + 1
    return count


class Displays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hold = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.hold.name)
        study = [{"name": "plates", "first": "plate", "second": "ground", "refined": False}]
        cls.scene = diurna.Scene(heated_plate(folder, crossover=study), file=folder / "scene.toml")
        cls.run_ = cls.scene.run(folder / "out", fresh=True)

    @classmethod
    def tearDownClass(cls):
        cls.hold.cleanup()

    def test_a_frame(self):
        frame = next(self.run_.frames())
        found = tags(frame._repr_html_())
        self.assertEqual((found["img"], found["svg"]), (1, 1))  # the picture, and how often each value occurs
        self.assertGreaterEqual(found["polyline"], 1)
        self.assertIn("apparent_temperature.8-12", frame._repr_html_())

    def test_a_run(self):
        found = tags(self.run_._repr_html_())
        self.assertGreaterEqual(found["img"], 1)
        self.assertEqual(found["polyline"], 3)  # mean, highest, lowest
        self.assertIn("polyline", self.run_.temperatures()._repr_svg_())

    def test_studies(self):
        found = self.scene.crossover(temperatures=self.run_.folder / "temperatures.nc")
        for shown in (found._repr_html_(), found["plates"]._repr_html_()):
            count = tags(shown)
            self.assertGreaterEqual(count["svg"], 1)
            self.assertGreaterEqual(count.get("polyline", 0) + count.get("path", 0), 1)
            self.assertEqual(count["tr"], 1 + len(found["plates"]))
        self.assertIn("<svg", found["plates"]._repr_svg_())

    def test_a_plan(self):
        self.assertGreater(tags(self.scene.plan()._repr_html_())["td"], 0)

    def test_a_column(self):
        self.assertEqual(tags(diurna.column(plate, weather())._repr_svg_())["polyline"], 1)


class Curves(unittest.TestCase):
    def test_ends_of_the_axes(self):
        drawn = curves_svg([0, 1, 2], {"a": [280.0, 290.0, 300.0]}, "K", ("left", "right"))
        self.assertIn("300 K", drawn)
        self.assertIn("280 K", drawn)
        points = ElementTree.fromstring(drawn).find("{*}polyline").get("points").split()
        self.assertEqual([float(p.split(",")[0]) for p in points], [60, 325, 590])
        self.assertEqual([float(p.split(",")[1]) for p in points], [190, 105, 20])

    def test_gaps_and_nothing(self):
        drawn = curves_svg(np.arange(5), {"a": [1, 2, np.nan, 3, 4], "b<": [np.nan] * 5}, "K", ("", ""))
        self.assertEqual(len(ElementTree.fromstring(drawn).findall("{*}polyline")), 2)
        ElementTree.fromstring(curves_svg([], {}, "K", ("", "")))


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # the dark scene has warnings
