"""Lists of names, and settings that change a part of a library material."""

import os
import pathlib
import tempfile
import unittest

import numpy as np

import diurna
from diurna.library import library_table
from test_point import plate
from test_point import weather as constant_weather

os.environ["DIURNA_STAGES"] = "off"
sky = {key: value for key, value in plate.items() if key != "material"}


def weather():
    """Sunlight that varies through the day, so that layers matter."""
    sun = 600.0 * np.maximum(0.0, -np.cos(2 * np.pi * np.arange(25) / 24))
    return {**constant_weather(), "shortwave_down_W_m2": sun}


def surface(material, settings=()):
    return diurna.column({**sky, "material": material}, weather(), settings)["surface_temperature_K"]


class Lists(unittest.TestCase):
    def test_materials(self):
        found = diurna.materials()
        self.assertIn("asphalt", found)
        asphalt = found["asphalt"]
        self.assertEqual(asphalt, "asphalt")
        self.assertTrue(0 < asphalt.albedo < 0.3 < asphalt.emissivity <= 1, vars(asphalt))
        self.assertEqual(len(found), len(set(found)))
        np.testing.assert_array_equal(surface({"name": asphalt}), surface({"name": "asphalt"}))  # a name is a text
        with self.assertRaisesRegex(diurna.Error, "did you mean 'asphalt'"):
            found["asphlt"]
        self.assertIn("<td>asphalt</td>", found._repr_html_())

    def test_the_others(self):
        self.assertIn("truck", diurna.models())
        self.assertTrue(diurna.models()["hangar"].upright)
        lwir = diurna.bands()["lwir"]
        self.assertEqual((lwir.from_um, lwir.to_um), (8.0, 12.0))
        for name in diurna.bands():
            self.assertGreater(diurna.band_radiance(name, 5800.0), 0)
        for profile in diurna.profiles():
            for aerosol in diurna.aerosols():
                with self.subTest(profile, aerosol=aerosol):
                    self.assertLessEqual(diurna.path("8-12", profile, aerosol, to_space=True)["8-12"].transmittance, 1)

    def test_in_pandas(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not here")
        self.assertIn("grass", diurna.materials().frame().index)


class Parts(unittest.TestCase):
    def test_a_layer_of_a_column(self):
        whole = library_table("asphalt")
        thin = [dict(one) for one in whole["layers"]]
        thin[0]["thickness_m"] = 0.02
        expected = surface({"name": "asphalt", "layers": thin})
        self.assertGreater(np.abs(expected - surface({"name": "asphalt"})).max(), 0.1)
        ways = (
            ({"name": "asphalt"}, ["material.layers.0.thickness_m=0.02"]),
            ({"name": "asphalt"}, {"material.layers.0.thickness_m": 0.02}),
            ({"name": "road", "like": "asphalt"}, "material.layers.0.thickness_m=0.02"),
            ({"name": "grass"}, ["material.name=asphalt", "material.layers.0.thickness_m=0.02"]),
        )
        for material, settings in ways:
            with self.subTest(material, settings=settings):
                np.testing.assert_array_equal(surface(material, settings), expected)

    def test_other_tables(self):
        grass = surface({"name": "grass"}, ["material.evaporation.wetness=0"])
        dry = surface({"name": "grass", "evaporation": {**library_table("grass")["evaporation"], "wetness": 0}})
        np.testing.assert_array_equal(grass, dry)

    def test_every_material_takes_its_own_thickness_again(self):
        for name in diurna.materials():
            table = library_table(name)
            self.assertTrue(table["layers"], name)
            job = {**sky, "material": {"name": name}, "time": {**sky["time"], "end": "2026-06-21T02:00:00Z", "spin_up": "none"}}
            whole = diurna.column(job, weather())["surface_temperature_K"]
            again = diurna.column(job, weather(), {"material.layers.0.thickness_m": table["layers"][0]["thickness_m"]})
            np.testing.assert_array_equal(again["surface_temperature_K"], whole, name)

    def test_a_layer_that_is_not_there(self):
        with self.assertRaises(diurna.Error) as caught:
            surface({"name": "asphalt"}, ["material.layers.9.thickness_m=0.1"])
        self.assertIn("9", str(caught.exception))
        self.assertIn("material.layers.9", caught.exception.key)

    def test_a_calibration_of_a_layer(self):
        job = {**sky, "material": {"name": "asphalt"}}
        truth = diurna.column(job, weather(), {"material.layers.0.thickness_m": 0.03}).columns
        measured = {"time": truth["time"], "skin": truth["surface_temperature_K"]}
        job["calibrate"] = {"sought": [{"key": "material.layers.0.thickness_m", "low": 0.01, "high": 0.1}]}
        found = diurna.calibrate(job, measured, weather())
        self.assertAlmostEqual(found.values["material.layers.0.thickness_m"], 0.03, delta=0.003)

    def test_a_misspelt_material_of_a_scene(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = diurna.Scene({}, file=pathlib.Path(folder) / "scene.toml", settings={"material.gras.albedo": 0.2})
            with self.assertRaisesRegex(diurna.Error, "unknown material \"gras\".*did you mean 'grass'") as caught:
                scene.check()
            self.assertEqual(caught.exception.key, "material.gras.albedo")


if __name__ == "__main__":
    unittest.main()
