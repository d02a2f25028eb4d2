"""Arguments of the wrong type or out of range are diurna.Error with the argument's name and the remedy."""

import datetime
import math
import os
import tempfile
import unittest

import numpy as np

import diurna
from test_point import plate, weather

os.environ["DIURNA_STAGES"] = "off"
noon = datetime.datetime(2026, 6, 21, 12, tzinfo=datetime.timezone.utc)
naive = datetime.datetime(2026, 6, 21, 12)


class Arguments(unittest.TestCase):
    def refused(self, key, remedy, call, *arguments, **named):
        with self.subTest(key=key, call=call.__name__, arguments=arguments, named=named):
            with self.assertRaises(diurna.Error) as caught:
                call(*arguments, **named)
            self.assertEqual(caught.exception.key, key)
            self.assertRegex(str(caught.exception), remedy)
            self.assertEqual(len(caught.exception.mistakes), 1)

    def test_of_the_sun(self):
        for wrong in ("36", None, [36.0], True, math.nan, math.inf, 91, np.array([1.0, 2.0])):
            self.refused("latitude_deg", "expected a number from -90 to 90", diurna.sun, wrong, 0.0, noon)
        self.refused("longitude_deg", "-360 to 360", diurna.sun, 0.0, -361, noon)
        self.refused("time", "tzinfo", diurna.sun, 0.0, 0.0, naive)
        self.refused("time", "ISO 8601", diurna.sun, 0.0, 0.0, 1.5e9)
        self.refused("time", "ISO 8601", diurna.sun, 0.0, 0.0, noon.date())
        self.refused("time", "offset", diurna.sun, 0.0, 0.0, "2026-06-21T12:00:00")
        self.refused("time", "NaT", diurna.sun, 0.0, 0.0, np.datetime64("NaT"))
        self.refused("pressure_hPa", "0 to 1200", diurna.sun, 0.0, 0.0, noon, pressure_hPa="1013")
        self.assertEqual(diurna.sun(np.float32(36), np.int64(-84), noon), diurna.sun(36, -84, noon))

    def test_of_planck(self):
        for call, key, good in ((diurna.band_radiance, "temperature_K", 300.0), (diurna.apparent_temperature, "radiance", 30.0)):
            self.refused("band", "expected a text", call, 8, good)
            self.refused(key, "expected numbers", call, "8-12", "warm")
            self.refused(key, "expected numbers", call, "8-12", None)
            self.refused(key, "found nan.*isfinite", call, "8-12", [good, math.nan])
        for celsius in (0, 27.0, [15.0, 99.0], np.float32(-12)):
            self.refused("temperature_K", "of degrees Celsius add 273.15", diurna.band_radiance, "8-12", celsius)
        self.refused("radiance", "found -0.5.*negative", diurna.apparent_temperature, "8-12", -0.5)
        self.refused("radiance", "and 1 more.*negative", diurna.apparent_temperature, "8-12", [30.0, -1e-9, -2.0])

    def test_of_a_path(self):
        self.refused("bands", "8-12", diurna.path, 8, to_space=True)
        self.refused("bands", "8-12", diurna.path, ["8-12", 3], to_space=True)
        self.refused("zenith_deg", "0 to 180", diurna.path, "8-12", zenith_deg=181, to_space=True)
        self.refused("range_km", "expected a number", diurna.path, "8-12", range_km="5")
        self.refused("to_space", "True or False", diurna.path, "8-12", to_space="yes")
        self.refused("profile", "MLS", diurna.path, "8-12", "MLSS", to_space=True)
        self.refused("path", "expected one of range_km", diurna.path, "8-12")

    def test_of_a_column(self):
        self.refused("job", "path", diurna.column, 3)
        self.refused("weather", "DataFrame", diurna.column, plate, 3)
        self.refused("settings", "key.path=value", diurna.column, plate, weather(), ["time.step_s"])
        self.refused("settings", "time.step_s=300", diurna.column, plate, weather(), 3)
        self.refused("allow_outside", "True or False", diurna.column, plate, weather(), allow_outside=1)
        self.refused("material.albedo", "0 to 1", diurna.column, plate, weather(), {"material.albedo": 2.0})
        self.of_dictionary("material.albedo", {**plate, "material": {**plate["material"], "albedo": 2.0}})
        self.of_dictionary("material.layers[0].thickness_m", {**plate, "material": {**plate["material"], "layers": [{**plate["material"]["layers"][0], "thickness_m": -1}]}})
        self.of_dictionary("facet.slop_deg", {**plate, "facet": {"slop_deg": 3.0}})
        self.of_dictionary("time", {key: value for key, value in plate.items() if key != "time"})
        self.refused("material.albedo", "0 to 1", diurna.column, plate, weather(), ["material.albedo=light"])
        given = {**plate, "time": {**plate["time"], "start": naive}}
        self.refused("time.start", "tzinfo", diurna.column, given, weather())
        given = {**plate, "site": {"latitude_deg": object()}}
        self.refused("site.latitude_deg", "expected a number, text", diurna.column, given, weather())
        given = {**weather(), "time": [naive] * 25}
        self.refused("weather.time", "tz_localize", diurna.column, plate, given)
        given = weather()
        del given["time"]
        self.refused("weather", "column of instants `time`", diurna.column, plate, given)

    def of_dictionary(self, key, job):
        """The place is the key path: there is no file."""
        with self.subTest(key), self.assertRaises(diurna.Error) as caught:
            diurna.column(job, weather())
        self.assertEqual(caught.exception.key, key)
        self.assertTrue(str(caught.exception).startswith(f"{key}: "), caught.exception)
        self.assertNotIn(".toml", str(caught.exception))
        self.assertIsNone(caught.exception.file)

    def test_of_a_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "scene.toml")
            self.refused("scene", "path", diurna.Scene, 3)
            self.refused("file", 'file="scene.toml"', diurna.Scene, {})
            self.refused("file", "remove file=", diurna.Scene, file, file=file)
            scene = diurna.Scene({}, file=file)
            for key, wrong in (("out", 3), ("resume", 1), ("threads", 1.5), ("threads", -1), ("threads", "2"), ("only", 3)):
                self.refused(key, "expected", scene.run, **{key: wrong})
            self.refused("only", "observer=NAME", scene.run, only="drone")
            self.refused("tolerance_K", "0 to 10", scene.run, tolerance_K="small")
            self.refused("tolerance_K", "0 to 10", scene.run, tolerance_K=-1)
            self.refused("progress", "function", scene.run, progress=3)
            self.refused("temperatures", "path", scene.contrast, temperatures=3)
            with self.assertRaises(diurna.Error) as caught:
                scene.check()
            self.assertEqual(caught.exception.mistakes[0].file, file)
            self.assertTrue(any(one.key == "terrain" for one in caught.exception.mistakes), caught.exception)

    def test_of_files(self):
        self.refused("file", "path", diurna.read_frame, 3)
        self.refused("file", "path", diurna.temperatures, None)
        for call in (diurna.read_frame, diurna.temperatures):
            with self.assertRaises(diurna.Error) as caught:
                call("none.nc")
            self.assertEqual((caught.exception.file, caught.exception.key), ("none.nc", None))

    def test_places_of_mistakes(self):
        def of(where):
            error = diurna.Error([(where, "found 1", "expected 2")])
            return error.file, error.line, error.column, error.key

        self.assertEqual(of("a.toml:3:4: time.step_s"), ("a.toml", 3, 4, "time.step_s"))
        self.assertEqual(of("a.csv:3:4"), ("a.csv", 3, 4, None))
        self.assertEqual(of("a.csv:3"), ("a.csv", 3, None, None))
        self.assertEqual(of("a.toml: weather.file"), ("a.toml", None, None, "weather.file"))
        self.assertEqual(of("a.toml"), ("a.toml", None, None, None))
        self.assertEqual(of("latitude_deg"), (None, None, None, "latitude_deg"))
        self.assertEqual(of("--set time.step_s"), (None, None, None, "time.step_s"))
        self.assertEqual(of("--set time.step_s=3"), (None, None, None, "time.step_s"))
        self.assertEqual(of("--only observer=a"), (None, None, None, "only"))


if __name__ == "__main__":
    unittest.main()
