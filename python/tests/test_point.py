"""What needs no scene, against numbers from outside."""

import datetime
import math
import pathlib
import tempfile
import tomllib
import unittest

import numpy as np

import diurna

try:
    import pandas
except ImportError:
    pandas = None


def planck(from_um, to_um, kelvin):
    """W m-2 sr-1 by Simpson's rule over CODATA's constants."""
    h, c, k = 6.62607015e-34, 299792458.0, 1.380649e-23
    x = np.linspace(from_um, to_um, 4001) * 1e-6
    y = 2 * h * c**2 / x**5 / np.expm1(h * c / (x * k * kelvin))
    return (x[1] - x[0]) / 3 * (y[0] + y[-1] + 4 * y[1:-1:2].sum() + 2 * y[2:-1:2].sum())


class Point(unittest.TestCase):
    def test_sun_of_nrel(self):
        # Reda & Andreas 2004, NREL/TP-560-34302, table A5.1: azimuth 194.34024, zenith 50.11162
        when = datetime.datetime(2003, 10, 17, 12, 30, 30, tzinfo=datetime.timezone(datetime.timedelta(hours=-7)))
        for time in (when, "2003-10-17T12:30:30-07:00", np.datetime64("2003-10-17T19:30:30")):
            sun = diurna.sun(39.742476, -105.1786, time, 1830.14, pressure_hPa=820, temperature_C=11)
            self.assertAlmostEqual(sun.azimuth_deg, 194.34024, delta=3e-4)
            self.assertAlmostEqual(90 - sun.elevation_deg, 50.11162, delta=3e-4)
        with self.assertRaisesRegex(diurna.Error, "time: found 2003-10-17 00:00:00 without an offset.*tzinfo"):
            diurna.sun(0, 0, datetime.datetime(2003, 10, 17))
        with self.assertRaisesRegex(diurna.Error, "latitude_deg: found 91"):
            diurna.sun(91, 0, when)

    def test_planck(self):
        kelvin = np.array([[250.0, 300.0], [320.0, 900.0]])
        found = diurna.band_radiance("8-12", kelvin)
        self.assertEqual(found.shape, (2, 2))
        for row in range(2):
            for column in range(2):
                expected = planck(8, 12, kelvin[row, column])
                self.assertAlmostEqual(found[row, column] / expected, 1, delta=1e-9)
        np.testing.assert_allclose(diurna.apparent_temperature("8-12", found), kelvin, atol=1e-6)

        for name in ("lwir", "LWIR", "8:12"):  # as observers of a scene name it
            self.assertEqual(diurna.band_radiance(name, 300.0), diurna.band_radiance("8-12", 300.0))
        with self.assertRaisesRegex(diurna.Error, "did you mean 'lwir'"):
            diurna.band_radiance("lwr", 300.0)

        self.assertIsInstance(diurna.band_radiance("8-12", 300.0), float)
        for wrong in (-3.0, float("nan")):
            with self.assertRaisesRegex(diurna.Error, "temperature_K: found"):
                diurna.band_radiance("8-12", wrong)

    def test_path_of_modtran(self):
        # MODTRAN 5, tropical, rural haze of 23 km, 5 km level, 330 ppm: 0.2772 (3-5 um), 0.1535 (8-12 um)
        found = diurna.path(["3-5", "8-12"], "TROP", "rural", 23, co2_ppm=360, zenith_deg=90, range_km=5)
        self.assertAlmostEqual(found["3-5"].transmittance / 0.2772, 1, delta=0.01)
        self.assertAlmostEqual(found["8-12"].transmittance / 0.1535, 1, delta=0.01)
        with self.assertRaisesRegex(diurna.Error, "ends of the path"):
            diurna.path("8-12", zenith_deg=90)
        with self.assertRaises(TypeError):
            diurna.path("8-12", range_m=5)


plate = {
    "site": {"latitude_deg": 40.0, "longitude_deg": 0.0},
    "material": {
        "albedo": 0.2,
        "emissivity": 0.9,
        "roughness_length_m": 0.01,
        "heat_roughness_length_m": 0.001,
        "layers": [{"thickness_m": 0.01, "conductivity_W_mK": 1.0, "density_kg_m3": 1000.0, "heat_capacity_J_kgK": 1000.0}],
        "bottom": {"kind": "flux", "value_W_m2": 0.0},
        "convection": {"kind": "constant", "value_W_m2K": 10.0},
    },
    "weather": {"interval": "instant"},
    "time": {"start": "2026-06-21T00:00:00Z", "end": "2026-06-22T00:00:00Z", "step_s": 3600.0},
}


def weather(air=290.0, down=300.0):
    start = np.datetime64("2026-06-21T00:00:00")
    hours = np.arange(25) * np.timedelta64(3600, "s")
    even = np.ones(25)
    return {
        "time": start + hours,
        "air_temperature_K": air * even,
        "relative_humidity": 0.5 * even,
        "wind_speed_m_s": 2.0 * even,
        "pressure_Pa": 1e5 * even,
        "shortwave_down_W_m2": 0.0 * even,
        "longwave_down_W_m2": down * even,
    }


class OneFacet(unittest.TestCase):
    def test_steady_balance(self):
        # 0.9 (300 - sigma T^4) + 10 (290 - T) = 0, by bisection
        low, high = 200.0, 400.0
        for _ in range(60):
            middle = (low + high) / 2
            gain = 0.9 * (300 - 5.670374419e-8 * middle**4) + 10 * (290 - middle)
            low, high = (middle, high) if gain > 0 else (low, middle)
        column = diurna.column(plate, weather())
        np.testing.assert_allclose(column["surface_temperature_K"], low, atol=2e-3)
        self.assertFalse(column["surface_temperature_K"].flags.owndata)  # the program's own array
        self.assertEqual(column["time"].dtype, np.dtype("datetime64[ms]"))
        self.assertIn("<svg", column._repr_svg_())

    @unittest.skipUnless(pandas, "pandas is not here")
    def test_pandas_in_and_out(self):
        given = weather()
        given["time"] = pandas.DatetimeIndex(given["time"]).tz_localize("UTC")
        frame = pandas.DataFrame(given).set_index("time")
        table = diurna.column(plate, frame).frame()
        expected = diurna.column(plate, weather())
        np.testing.assert_array_equal(table["surface_temperature_K"], expected["surface_temperature_K"])
        self.assertEqual(str(table.index[0]), "2026-06-21 00:00:00+00:00")

    def test_mistakes_have_places(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "column.toml"
            file.write_text(diurna.toml_text({**plate, "material": {**plate["material"], "emisivity": 0.9}}))
            with self.assertRaises(diurna.Error) as caught:
                diurna.column(file, weather())
        error = caught.exception
        self.assertEqual(error.file, str(file))
        self.assertEqual(error.key, "material.emisivity")
        self.assertGreater(error.line, 1)
        self.assertIn("did you mean 'emissivity'", str(error))

    def test_bad_weather(self):
        bad = weather()
        bad["air_temperature_K"] = bad["air_temperature_K"] - 273.15
        with self.assertRaises(diurna.Error):
            diurna.column(plate, bad)
        with self.assertRaisesRegex(ValueError, "one length"):
            diurna.column(plate, {**weather(), "wind_speed_m_s": [1.0]})
        with self.assertRaisesRegex(diurna.Error, "DataFrame"):
            diurna.column(plate, 3)
        with self.assertRaisesRegex(diurna.Error, "found the key 1"):
            diurna.toml_text({1: 2})

    def test_toml(self):
        table = {"a b": 1, "t": {"x": [1.5, 2], "deep": {"y": 'q"\\\n\x7f'}}, "list": [{"n": "é"}, {"n": True}], "e": []}
        self.assertEqual(tomllib.loads(diurna.toml_text(table)), table)
        self.assertEqual(tomllib.loads(diurna.toml_text({"v": np.float64(0.1), "w": np.arange(3)})), {"v": 0.1, "w": [0, 1, 2]})
        noon = datetime.datetime(2026, 6, 21, 12, tzinfo=datetime.timezone.utc)
        hours = np.array(["2026-06-21T12:00:00", "2026-06-21T13:00:00"], "datetime64[s]")
        found = tomllib.loads(diurna.toml_text({"time": {"start": "2026-06-21T12:00:00Z", "a": noon, "b": hours[0], "c": hours}}))
        self.assertEqual([found["time"][key] for key in ("start", "a", "b")], [noon] * 3)
        self.assertEqual(found["time"]["c"], [noon, noon + datetime.timedelta(hours=1)])
        self.assertTrue(math.isinf(tomllib.loads(diurna.toml_text({"v": math.inf}))["v"]))


if __name__ == "__main__":
    unittest.main()
