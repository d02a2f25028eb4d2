"""A scene from a dictionary, its folder read by other programs, and driven step by step."""

import json
import os
import pathlib
import struct
import tempfile
import threading
import unittest
import zlib

import numpy as np

import diurna

os.environ["DIURNA_STAGES"] = "off"
samples = pathlib.Path(diurna.data_folder()).parent / "scenes"


def small_scene(folder):
    """A level field of grass with a road, a picture an hour for six hours."""
    cells = ("300 " * 6 + "\n") * 6
    head = "ncols 6\nnrows 6\nxllcorner -0.0006\nyllcorner 39.9994\ncellsize 0.0002\n"
    (folder / "level.asc").write_text(head + cells)
    (folder / "level.prj").write_text((samples / "crossover" / "level.prj").read_text())
    rows = ["time,air_temperature_K,wind_speed_m_s,relative_humidity"]
    for hour in range(49):
        day, clock = 20 + (hour + 12) // 24, (hour + 12) % 24
        rows.append(f"2026-06-{day:02}T{clock:02}:00:00Z,{290 + 8 * np.sin((clock - 9) / 24 * 2 * np.pi):.2f},2.0,0.5")
    (folder / "weather.csv").write_text("\n".join(rows) + "\n")
    return {
        "terrain": {"elevation": "level.asc", "material": "grass"},
        "weather": {"file": "weather.csv", "interval": "instant"},
        "time": {"start": "2026-06-21T00:00:00Z", "duration_h": 6, "step_s": 600.0},
        "building": [
            {"name": "crate", "place_m": [0.0, 10.0], "width_m": 3.0, "depth_m": 2.0, "height_m": 2.0, "wall": "brick"}
        ],
        "observer": [
            {
                "name": "eye",
                "place_m": [0.0, -25.0],
                "height_above_ground_m": 10.0,
                "look_at_m": [0.0, 10.0],
                "width": 64,
                "height": 48,
                "bands": ["8-12"],
            }
        ],
    }


class SmallScene(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hold = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.hold.name)
        cls.table = small_scene(cls.folder)
        cls.scene = diurna.Scene(cls.table, file=cls.folder / "scene.toml")
        counted = []
        done = threading.Event()

        def count():  # goes on only if the run lets other threads in
            while not done.wait(0.001):
                counted.append(1)

        other = threading.Thread(target=count)
        other.start()
        cls.run_ = cls.scene.run(cls.folder / "out", fresh=True)
        done.set()
        other.join()
        cls.counted = len(counted)

    @classmethod
    def tearDownClass(cls):
        cls.hold.cleanup()

    def test_check_and_plan(self):
        check = self.scene.check()
        self.assertEqual(check.observers, 1)
        plan = self.scene.plan()
        self.assertEqual(plan["facets"], check.facets)
        self.assertEqual(plan["pictures"], 6)
        self.assertEqual(self.run_.facets, check.facets)
        self.assertIn("facets", repr(plan))

    def test_a_scene_is_not_overwritten(self):
        with self.assertRaises(FileExistsError):
            diurna.Scene(self.table, file=self.folder / "scene.toml")

    def test_mistakes(self):
        wrong = {**self.table, "terrain": {**self.table["terrain"], "material": "gras"}}
        with self.assertRaises(diurna.Error) as caught:
            diurna.Scene(wrong, file=self.folder / "wrong.toml").check()
        self.assertEqual(caught.exception.key, "terrain.material")
        self.assertEqual(caught.exception.file, str(self.folder / "wrong.toml"))
        with self.assertRaises(diurna.Error):
            diurna.Scene(self.folder / "none.toml").check()

    def test_a_sweep_is_many_scenes(self):
        axes = [
            {"key": "observer.eye.horizontal_fov_deg", "values": [20.0, 40.0]},
            {"key": "building.crate.wall", "values": ["brick", "concrete"]},
        ]
        table = {**self.table, "sweep": {"axis": axes}}
        table["time"] = {**table["time"], "frame_every_s": 10800.0}
        swept = diurna.Scene(table, file=self.folder / "swept.toml")
        for call in (swept.stepper, lambda: swept.run(self.folder / "swept")):
            with self.assertRaisesRegex(diurna.Error, r"Scene.sweep\(out\)"):
                call()
        self.assertEqual(swept.check().observers, 1)
        self.assertIn("4 variants", repr(swept.plan()))
        stages = []
        found = swept.sweep(self.folder / "swept", progress=lambda stage, share: stages.append(stage))
        self.assertIn("sky view", stages)
        self.assertEqual((found.rendered, found.kept, found.solved), (4, 0, 2))  # walls are of heat, the view is not
        self.assertEqual(len(found), 4)
        values = {(one["observer.eye.horizontal_fov_deg"], one["building.crate.wall"]) for one in found.records}
        self.assertEqual(values, {(20.0, "brick"), (20.0, "concrete"), (40.0, "brick"), (40.0, "concrete")})
        by_value = {tuple(one[key] for key in found.keys): one["variant"] for one in found.records}
        narrow, wide = (next(found.frames(by_value[(fov, "brick")])) for fov in (20.0, 40.0))
        # The crate fills four times the pixels when the picture is half as wide.
        name = "object"
        counts = [np.sum(frame[name] == np.nanmax(frame[name])) for frame in (narrow, wide)]
        wider = np.tan(np.radians(20.0)) / np.tan(np.radians(10.0))
        self.assertAlmostEqual(counts[0] / counts[1], wider**2, delta=0.6)
        with self.assertRaisesRegex(KeyError, "v9"):
            found.frames("v9")
        again = swept.sweep(self.folder / "swept", resume=True)
        self.assertEqual((again.rendered, again.kept, again.records), (0, 4, found.records))
        try:
            import pandas
        except ImportError:
            return
        frame = found.frame()
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(frame.loc[by_value[(40.0, "brick")], "building.crate.wall"], "brick")
        self.assertEqual(frame["observer.eye.horizontal_fov_deg"].dtype, np.dtype(float))

    def test_threads(self):
        with self.assertRaisesRegex(diurna.Error, "threads: found -3"):
            diurna.set_threads(-3)
        alone = self.scene.run(self.folder / "alone", fresh=True, threads=1)
        np.testing.assert_array_equal(alone.temperatures().kelvin, self.run_.temperatures().kelvin)

        def change(stage, share):  # while a run computes
            diurna.set_threads(1)

        with self.assertRaisesRegex(diurna.Error, "threads: another call of diurna is running"):
            self.scene.run(self.folder / "busy", fresh=True, progress=change)
        diurna.set_threads(0)

    def test_only_some_pictures(self):
        names = ("frames=02:00..03:00", {"observer": "eye", "frames": "02:00..03:00"}, ["band=8:12", "frames=02:00..03:00"])
        for number, only in enumerate(names):
            with self.subTest(only):
                run = self.scene.run(self.folder / f"only{number}", only=only)
                hours = [str(frame.instant)[11:16] for frame in run.frames()]
                self.assertEqual(hours, ["02:00", "03:00"])
                some = run.frame_files()[0]  # the picture of the whole run
                np.testing.assert_array_equal(
                    diurna.read_frame(some)["radiance.8-12"],
                    diurna.read_frame(self.run_.folder / "frames" / some.name)["radiance.8-12"],
                )
        with self.assertRaises(diurna.Error) as caught:
            self.scene.run(self.folder / "none", only="observer=eyes")
        self.assertEqual(caught.exception.key, "only")
        self.assertIn("eye", str(caught.exception))

    def test_tolerance(self):
        run = self.scene.run(self.folder / "tolerant", tolerance_K=0.5)
        self.assertEqual(len(run.frame_files()), 6)
        difference = next(run.frames())["apparent_temperature.8-12"] - next(self.run_.frames())["apparent_temperature.8-12"]
        self.assertLess(np.sqrt(np.mean(difference**2)), 0.5)
        self.assertIn("tolerance_K", json.dumps(run.manifest()))
        with self.assertRaisesRegex(diurna.Error, "tolerance_K: found 20"):
            self.scene.run(self.folder / "tolerant", tolerance_K=20)

    def test_weather_from_a_table(self):
        time = np.datetime64("2026-06-20T12:00:00") + np.arange(49) * np.timedelta64(1, "h")
        table = {"time": time, "air_temperature_K": np.full(49, 270.0), "wind_speed_m_s": 2.0, "relative_humidity": 0.5}
        with self.assertRaisesRegex(diurna.Error, "wind_speed_m_s"):  # a number is no column
            diurna.Scene(self.scene.file, weather=table)
        table.update({name: np.full(49, table[name]) for name in ("wind_speed_m_s", "relative_humidity")})
        cold = diurna.Scene(self.scene.file, weather=table)
        colder = cold.run(self.folder / "cold", only="frames=03:00").temperatures().kelvin
        self.assertLess(colder.mean(), self.run_.temperatures().kelvin.mean() - 5)
        files = sorted(self.folder.glob("scene.weather-*.csv"))
        self.assertEqual(len(files), 1)
        diurna.Scene(self.scene.file, weather=table)  # the same content, the same file
        self.assertEqual(sorted(self.folder.glob("scene.weather-*.csv")), files)
        own = diurna.Scene(small_scene(self.folder), file=self.folder / "own.toml", weather=table)  # its file names the table
        again = diurna.Scene(self.folder / "own.toml").run(self.folder / "of_file", only="frames=03:00")
        self.assertRegex(own.file.read_text(), r'file = "own.weather-\w+.csv"')
        np.testing.assert_array_equal(again.temperatures().kelvin, colder)
        try:
            import pandas
        except ImportError:
            return
        frame = pandas.DataFrame(table).set_index("time").tz_localize("UTC").tz_convert("America/Denver")
        again = diurna.Scene(self.scene.file, weather=frame).run(self.folder / "again", only="frames=03:00")
        np.testing.assert_array_equal(again.temperatures().kelvin, colder)
        with self.assertRaises(diurna.Error) as caught:
            diurna.Scene(self.scene.file, weather=frame.tz_localize(None))
        self.assertEqual(caught.exception.key, "weather.time")
        frame["air_temperature_K"] -= 273.15
        with self.assertRaisesRegex(diurna.Error, r"scene.weather-\w+.csv:2:.*is between 100 and 400"):
            diurna.Scene(self.scene.file, weather=frame).check()

    def test_a_layer_of_a_library_material(self):
        settings = {"material.grass.layers.0.thickness_m": 0.02, "material.brick.layers.0.conductivity_W_mK": 0.7}
        changed = diurna.Scene(self.scene.file, settings=settings)
        changed.check()
        kelvin = changed.run(self.folder / "layers", only="frames=03:00").temperatures().kelvin
        self.assertGreater(np.abs(kelvin - self.run_.temperatures().kelvin).max(), 0.1)
        with self.assertRaises(diurna.Error) as caught:
            diurna.Scene(self.scene.file, settings=["material.grass.layers.0.thickness_m=-1"]).check()
        self.assertIn("thickness_m", caught.exception.key)

    def test_others_ran_meanwhile(self):
        self.assertGreater(self.counted, 20)

    def test_temperatures_as_netcdf_has_them(self):
        try:
            import netCDF4
        except ImportError:
            self.skipTest("netCDF4 is not here")
        found = self.run_.temperatures()
        with netCDF4.Dataset(self.run_.folder / "temperatures.nc") as file:
            name = next(n for n, v in file.variables.items() if v.ndim == 2 and getattr(v, "units", "") == "K")
            np.testing.assert_array_equal(found.kelvin, file[name][:].filled(np.nan))
        self.assertEqual(found.time[0], np.datetime64("2026-06-21T00:00:00"))
        self.assertFalse(found.kelvin.flags.owndata)

    def test_temperatures_in_xarray(self):
        try:
            import xarray
        except ImportError:
            self.skipTest("xarray is not here")
        found = self.run_.temperatures()
        array = found.xarray()
        self.assertIsInstance(array, xarray.DataArray)
        self.assertEqual(array.dims, ("time", "facet"))
        self.assertEqual(array.attrs["units"], "K")
        with self.scene.stepper() as stepper:
            facets, materials, objects = stepper.facets(), stepper.material_names, stepper.object_names
        for name, names in (("material", materials), ("object", objects)):
            np.testing.assert_array_equal(array[name].values, [names[i] for i in facets[name]])
            self.assertEqual(array[name].dims, ("facet",))
            np.testing.assert_array_equal(getattr(found, name), array[name].values)
        np.testing.assert_array_equal(array.sel(time="2026-06-21T03:00:00").values, found.kelvin[list(found.time).index(np.datetime64("2026-06-21T03:00:00"))])
        self.assertIsInstance(next(self.run_.frames()).xarray(), xarray.Dataset)

    def test_frames_as_another_reader_has_them(self):
        frames = list(self.run_.frames())
        self.assertEqual(len(frames), 6)
        frame = frames[3]
        self.assertEqual(frame["radiance.8-12"].shape, (48, 64))
        # radiance and apparent temperature agree by Planck's law
        kelvin = diurna.apparent_temperature("8-12", frame["radiance.8-12"])
        np.testing.assert_allclose(kelvin, frame["apparent_temperature.8-12"], atol=2e-4)
        with self.assertRaises(KeyError):
            frame["radiance.3-5"]
        with self.assertRaisesRegex(diurna.Error, "radiance.8-12"):
            diurna.read_frame(self.run_.frame_files()[0], ["radiance.8-13"])
        try:
            import OpenImageIO as oiio
        except ImportError:
            self.skipTest("OpenImageIO is not here")
        picture = oiio.ImageBuf(str(self.run_.frame_files()[3]))
        place = picture.spec().channelnames.index("apparent_temperature.8-12")
        np.testing.assert_array_equal(picture.get_pixels(oiio.FLOAT)[:, :, place], frame["apparent_temperature.8-12"])

    def test_a_frame_shows_itself(self):
        png = next(self.run_.frames())._repr_png_()
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", png[16:24])
        self.assertEqual((width, height), (64, 48))
        data = png[png.index(b"IDAT") + 4 :]
        self.assertEqual(len(zlib.decompressobj().decompress(data)), 48 * 65)

    def test_stepper_is_the_run(self):
        stepper = self.scene.stepper()
        self.assertTrue(stepper.now.startswith("2026-06-21T00:00:00"))
        stepper.advance("2026-06-21T03:00:00Z")
        found = self.run_.temperatures()
        place = list(found.time).index(np.datetime64("2026-06-21T03:00:00"))
        np.testing.assert_allclose(stepper.temperature(), found.kelvin[place], atol=0.02)
        facets = stepper.facets()
        self.assertEqual(len(facets["area_m2"]), found.kelvin.shape[1])
        corner = facets["vertex_m"][facets["corner"]].astype(float)
        cross = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        np.testing.assert_allclose(np.linalg.norm(cross, axis=1) / 2, facets["area_m2"], rtol=1e-3)
        pose = stepper.observer("eye")
        near = stepper.picture("eye")
        pose.position_m = pose.position_m + np.array([0.0, 0.0, 100.0])
        pose.elevation_deg = -60.0
        far = stepper.picture("eye", pose)
        self.assertGreater(np.nanmedian(far["range"]), np.nanmedian(near["range"]) + 50)
        with self.assertRaises(diurna.Error):
            stepper.advance("2026-06-21T01:00:00Z")
        self.assertEqual(stepper.material_names[facets["material"][0]], "grass")
        self.assertIn("crate", [stepper.object_names[i] for i in set(facets["object"])])
        pose.elevation_deg = 91.0
        with self.assertRaisesRegex(diurna.Error, "pose.elevation_deg: found 91"):
            stepper.picture("eye", pose)

    def test_stepper_closes(self):
        with self.scene.stepper() as stepper:
            stepper.advance(np.datetime64("2026-06-21T00:30:00"))
            self.assertGreater(stepper.steps_solved, 0)
        with self.assertRaisesRegex(diurna.Error, "stepper: found one that is closed"):
            stepper.advance("2026-06-21T01:00:00Z")


if __name__ == "__main__":
    unittest.main()
