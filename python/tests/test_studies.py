"""Studies of a scene and of a column: closed forms, and the numbers of the program's files."""

import csv
import json
import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

import diurna
from heated_plate import heated_plate, kelvin

try:
    import pandas
except ImportError:
    pandas = None

os.environ["DIURNA_STAGES"] = "off"
program = os.environ.get("DIURNA_PROGRAM") or shutil.which("diurna")
midnight = np.datetime64("2026-07-15T04:00:00")  # of the scene's clock, UTC - 4 h

studied = {
    "crossover": [
        {
            "name": "plates",
            "first": "plate",
            "second": "ground",
            "uncertain": [{"key": "material.black.internal_heat_W_m2", "one_sigma": 320.0}],
        }
    ],
    "contrast": [{"targets": ["plate"], "threshold_K": 5.0}],
    "sensitivity": [
        {
            "trajectories": 0,
            "uncertain": [{"key": "material.black.internal_heat_W_m2", "low": 299.0, "high": 301.0}],
            "output": [{"first": "ground", "at_h": 12.0}],
        }
    ],
}


def lay_ball(file, rings=24):
    """A sphere of radius 2 m about (0, 0, 2) as OBJ, whose faces look outward."""
    points = [
        (2 * math.sin(a) * math.cos(b), 2 * math.sin(a) * math.sin(b), 2 + 2 * math.cos(a))
        for a in np.linspace(0, math.pi, rings + 1)
        for b in np.linspace(0, 2 * math.pi, 2 * rings, endpoint=False)
    ]
    lines = [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in points]
    for i in range(rings):
        for k in range(2 * rings):
            a, b = i * 2 * rings + k, i * 2 * rings + (k + 1) % (2 * rings)
            c, d = a + 2 * rings, b + 2 * rings
            lines += [f"f {a + 1} {c + 1} {d + 1}"] * (i < rings - 1) + [f"f {a + 1} {d + 1} {b + 1}"] * (i > 0)
    file.write_text("\n".join(lines) + "\n")


class OfPlates(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hold = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.hold.name)
        cls.scene = diurna.Scene(heated_plate(cls.folder, **studied), file=cls.folder / "scene.toml")

    @classmethod
    def tearDownClass(cls):
        cls.hold.cleanup()

    def test_plates_cross_when_their_heat_does(self):
        found = self.scene.crossover()
        self.assertEqual([one.name for one in found], ["plates"])
        plates = found["plates"]
        self.assertIs(plates, found[0])
        self.assertEqual(list(plates["kind"]), ["crosses", "crosses"])
        self.assertEqual(list(plates["warmer_after"]), ["plate", "ground"])
        for when, hour in zip(plates["time"], (9, 15)):
            late = (when - midnight) / np.timedelta64(1, "s") - hour * 3600
            self.assertLess(abs(late), 30)  # of steps of 600 s, as tests/scenes/crossover_test.cpp has it
        # With 320 W/m2 in the plain 36 minutes nearer noon; of T ~ q^1/4 straight lines keep that.
        np.testing.assert_allclose(plates["shift_s material.black.internal_heat_W_m2"], [2160, -2160], atol=30)
        np.testing.assert_allclose(plates["sigma_s"], 2160, atol=30)
        curve = plates.curves
        np.testing.assert_allclose(curve["second_K"], kelvin(300.0), atol=5e-3)
        self.assertEqual(curve["time"].dtype, np.dtype("datetime64[ms]"))
        self.assertAlmostEqual(curve["difference_K"].min(), kelvin(200.0) - kelvin(300.0), delta=0.02)
        self.assertEqual(plates.summary["bands"][0]["crossings"][0]["kind"], "crosses")
        self.assertIn("<svg", plates._repr_svg_())
        self.assertIn("warmer after", repr(found))
        with self.assertRaisesRegex(KeyError, "sigma_s"):
            plates["sigma"]
        with self.assertRaisesRegex(KeyError, "plates"):
            found["plate"]

    @unittest.skipUnless(pandas, "pandas is not here")
    def test_as_frames(self):
        plates = self.scene.crossover()["plates"]
        table = plates.frame()
        self.assertEqual(len(table), 2)
        self.assertEqual(str(table["time"].dtype).split("[")[0], "datetime64")
        self.assertEqual(str(table["time"].dt.tz), "UTC")
        self.assertEqual(table["sigma_s"].dtype, np.dtype(float))
        self.assertEqual(table["warmer_after"].iloc[0], "plate")
        wide = plates.curves_frame().pivot(index="time", columns="band_um", values="difference_K")
        self.assertEqual(list(wide.columns), ["8-12"])

    def test_contrast_is_that_of_the_temperatures(self):
        found = self.scene.contrast()[0]
        # At 00:00 and 18:00 of the clock the plate has 200 W/m2 and something more.
        self.assertEqual(len(found), 4)
        # as close as tests/scenes/contrast_test.cpp has it: pixels at its edge count by their share
        self.assertAlmostEqual(found["difference_K"][0] / (kelvin(200.0) - kelvin(300.0)), 1, delta=0.01)
        self.assertEqual(found["target"][0], "plate")
        # 30 m x 30 m before 48 pixels over 2 tan 30 deg * 60 m
        self.assertAlmostEqual(found["pixels"][0] / (30 * 48 / (2 * math.tan(math.pi / 6) * 60)) ** 2, 1, delta=0.01)

    def test_sensitivity_is_the_derivative(self):
        found = self.scene.sensitivity()["sensitivity"]
        slope = kelvin(300.0) / (4 * 300.0)  # dT/dq of sigma T^4 = q
        self.assertAlmostEqual(found["slope"][0] / slope, 1, delta=2e-3)
        self.assertNotIn("effects", found.columns)  # no screening was asked for

    def test_the_files_are_the_programs(self):
        out = self.folder / "asked"
        found = self.scene.crossover(out=out)["plates"]
        self.assertEqual({file.name for file in out.iterdir()}, {f"plates{end}" for end in found.texts})
        for ending, text in found.texts.items():
            self.assertEqual((out / f"plates{ending}").read_text(), text)
        with open(out / "plates.csv", newline="") as file:  # as another reader has it
            rows = list(csv.DictReader(file))
        np.testing.assert_array_equal(found["sigma_s"], [float(row["sigma_s"]) for row in rows])
        self.assertEqual(found.summary, json.loads((out / "plates.json").read_text()))

    @unittest.skipUnless(program, "the program is not here (DIURNA_PROGRAM)")
    def test_the_program_finds_the_same(self):
        for kind in ("crossover", "contrast", "sensitivity"):
            with self.subTest(kind):
                found = getattr(self.scene, kind)()
                out = self.folder / f"program_{kind}"
                asked = [program, kind, self.scene.file, "--out", out, "--progress", "none"]
                subprocess.run(asked, check=True, capture_output=True)
                for one in found:
                    for ending, text in one.texts.items():
                        self.assertEqual((out / f"{one.name}{ending}").read_text(), text)

    def test_temperatures_of_a_run(self):
        run = self.scene.run(self.folder / "run", fresh=True)
        found = self.scene.contrast(temperatures=run.folder / "temperatures.nc")[0]
        np.testing.assert_array_equal(found["difference_K"], self.scene.contrast()[0]["difference_K"])

    def test_mistakes(self):
        with self.assertRaisesRegex(diurna.Error, r"no table \[\[signature\]\]"):
            self.scene.signature()
        with self.assertRaises(diurna.Error):
            self.scene.contrast(temperatures=self.folder / "none.nc")
        (self.folder / "file").write_text("")
        with self.assertRaisesRegex(diurna.Error, "is not a folder"):
            self.scene.contrast(out=self.folder / "file")


class OfABall(unittest.TestCase):
    def test_a_black_ball_from_straight_above(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            lay_ball(folder / "ball.obj")
            place = {"place_m": [0.0, 0.0], "height_above_ground_m": 3.0}
            table = heated_plate(
                folder,
                object=[{"name": "ball", "mesh": "ball.obj", "up": "z", "material": "black", **place}],
                signature=[{"object": "ball", "bands": ["8-12"], "directions": 42, "frames": ["2026-07-15T00:00:00-04:00"]}],
            )
            del table["ground"]
            found = diurna.Scene(table, file=folder / "scene.toml").signature()["ball"]
        np.testing.assert_allclose(found["projected_area_m2"], math.pi * 2.0**2, rtol=0.02)
        # Its skin leaves 300 W/m2 of its own and what the plain, which leaves 300, sends to one that is tilted by a from
        # the level: sigma T^4 = 300 (1 + (1 - cos a) / 2); the disc seen from above has sin 2a da of each.
        edge = np.linspace(0, math.pi / 2, 201)
        tilt = (edge[1:] + edge[:-1]) / 2
        radiance = diurna.band_radiance("8-12", kelvin(300 * (1 + (1 - np.cos(tilt)) / 2)))
        intensity = math.pi * 2.0**2 * np.sum(radiance * np.diff(np.sin(edge) ** 2))
        above = int(np.argmax(found["elevation_deg"]))
        self.assertAlmostEqual(found["elevation_deg"][above], 90, delta=1e-3)
        self.assertAlmostEqual(found["radiant_intensity_W_sr"][above] / intensity, 1, delta=0.02)


half_space = {
    "site": {"latitude_deg": 40.0, "longitude_deg": 0.0},
    "material": {
        "albedo": 0.0,
        "emissivity": 0.0,
        "roughness_length_m": 0.01,
        "layers": [{"thickness_m": 4.0, "conductivity_W_mK": 0.5, "density_kg_m3": 2000.0, "heat_capacity_J_kgK": 1000.0}],
        "convection": {"kind": "constant", "value_W_m2K": 20.0},
        "bottom": {"kind": "flux", "value_W_m2": 0.0},
    },
    "weather": {"interval": "instant"},
    "time": {"start": "2020-06-01T00:00:00Z", "end": "2020-06-02T00:00:00Z", "step_s": 600.0, "spin_up": "periodic"},
    "calibrate": {
        "sought": [
            {"key": "material.layers.0.conductivity_W_mK", "low": 0.2, "high": 4.0, "start": 0.5},
            {"key": "material.convection.value_W_m2K", "low": 2.0, "high": 40.0},
        ]
    },
}


def skin(t, conductivity, film):
    """Carslaw & Jaeger 2.6: a half-space under 300 + 250 cos wt W/m2 and a film to air of 290 K."""
    omega = 2 * np.pi / 86400
    return 290 + 300 / film + (250 * np.exp(1j * omega * t) / (film + np.sqrt(1j * omega * conductivity * 2e6))).real


class OfAColumn(unittest.TestCase):
    start = np.datetime64("2020-06-01T00:00:00")

    def instants(self, seconds):
        return self.start + np.asarray(seconds * 1000, "timedelta64[ms]")

    def weather(self):
        t = np.arange(0, 86401, 600)
        even = np.ones(len(t))
        return {
            "time": self.instants(t),
            "air_temperature_K": 290 * even,
            "wind_speed_m_s": 2 * even,
            "shortwave_down_W_m2": 300 + 250 * np.cos(2 * np.pi * t / 86400),
            "longwave_down_W_m2": 0 * even,
        }

    def test_a_half_space_is_found_from_its_closed_form(self):
        t = np.arange(300, 86400, 1700)
        measured = {"time": self.instants(t), "skin": skin(t, 1.3, 10.0)}
        with tempfile.TemporaryDirectory() as name:
            found = diurna.calibrate(half_space, measured, self.weather(), out=name)
            self.assertEqual(
                (pathlib.Path(name) / "calibrate_curve.csv").read_text(), found.texts["_curve.csv"]
            )
        self.assertAlmostEqual(found.values["material.layers.0.conductivity_W_mK"], 1.3, delta=0.013)
        self.assertAlmostEqual(found.values["material.convection.value_W_m2K"], 10.0, delta=0.01)
        self.assertFalse(found["at_bound"].any())
        self.assertLess(found.summary["rms_K"], 0.05)
        np.testing.assert_allclose(found.curves["measured_K"], measured["skin"], atol=1e-4)
        # The numbers go into a column again, which then is the measured one.
        again = diurna.column({k: v for k, v in half_space.items() if k != "calibrate"}, self.weather(), found.settings)
        every = np.arange(0, 86401, 600)
        np.testing.assert_allclose(again["surface_temperature_K"], skin(every, 1.3, 10.0), atol=0.1)
        self.assertIn("<svg", found._repr_svg_())

    @unittest.skipUnless(pandas, "pandas is not here")
    def test_a_series_with_gaps_in_another_zone(self):
        t = np.arange(300, 86400, 1700)
        index = pandas.DatetimeIndex(self.instants(t)).tz_localize("UTC").tz_convert("America/Denver")
        series = pandas.Series(skin(t, 1.3, 10.0), index=index, name="skin")
        series.iloc[[3, 7]] = np.nan
        found = diurna.calibrate(half_space, series, self.weather())
        self.assertEqual(found.summary["values"], len(t) - 2)
        self.assertTrue(any("2 measured values are missing" in note for note in found.notes))
        self.assertAlmostEqual(found.values["material.layers.0.conductivity_W_mK"], 1.3, delta=0.013)
        self.assertEqual(str(found.curves_frame().index[0]), "2020-06-01 00:05:00+00:00")
        with self.assertRaisesRegex(ValueError, "measured.*tz_localize"):
            diurna.calibrate(half_space, series.tz_localize(None), self.weather())

    def test_mistakes(self):
        with self.assertRaisesRegex(diurna.Error, "calibrate"):
            diurna.calibrate({k: v for k, v in half_space.items() if k != "calibrate"}, weather=self.weather())


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # the dark scene has warnings
