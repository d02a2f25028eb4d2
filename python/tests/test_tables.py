"""Tables of pandas and numpy in and out: types, time zones, what is missing."""

import datetime
import os
import unittest

import numpy as np

import diurna
from diurna.tables import read_csv
from test_point import plate, weather

try:
    import pandas
except ImportError:
    pandas = None

os.environ["DIURNA_STAGES"] = "off"


def surface(given):
    return diurna.column(plate, given)["surface_temperature_K"]


def hours(start="2026-06-21T00:00:00", count=25):
    return np.datetime64(start) + np.arange(count) * np.timedelta64(3600, "s")


class OfTheProgram(unittest.TestCase):
    def test_cells_have_their_types(self):
        text = 'time,a,b,name,flag\r\n2026-07-15T14:00:00-04:00,1.5,,"x, ""y""",true\r\n2026-07-15T15:00:00-04:00,,,\'=z,false\r\n'
        found = read_csv(text)
        np.testing.assert_array_equal(
            found["time"], np.array(["2026-07-15T18:00:00", "2026-07-15T19:00:00"], "datetime64[ms]")
        )
        np.testing.assert_array_equal(found["a"], [1.5, np.nan])
        self.assertTrue(np.isnan(found["b"]).all())
        self.assertEqual(list(found["name"]), ['x, "y"', "=z"])
        self.assertEqual(list(found["flag"]), [True, False])

    def test_no_rows(self):
        found = read_csv("time,a\n")
        self.assertEqual(len(found["time"]), 0)
        self.assertEqual(found["time"].dtype, np.dtype("datetime64[ms]"))


class FromPlainPython(unittest.TestCase):
    def test_lists_and_datetimes(self):
        east = datetime.timezone(datetime.timedelta(hours=2))
        begin = datetime.datetime(2026, 6, 21, 2, tzinfo=east)  # 00:00 UTC
        given = {name: list(values) for name, values in weather().items()}
        given["time"] = [begin + datetime.timedelta(hours=h) for h in range(25)]
        np.testing.assert_array_equal(surface(given), surface(weather()))
        given["time"] = [when.replace(tzinfo=None) for when in given["time"]]
        with self.assertRaisesRegex(ValueError, "column 'time', row 0: .*offset from UTC"):
            surface(given)

    def test_none_and_nan_are_missing(self):
        # Humidity that is missing is taken straight between its neighbours, here the same number.
        given = {name: list(values) for name, values in weather().items()}
        given["relative_humidity"][5] = None
        given["relative_humidity"][9] = float("nan")
        np.testing.assert_allclose(surface(given), surface(weather()), atol=1e-9)

    def test_what_is_no_number(self):
        given = {name: list(values) for name, values in weather().items()}
        given["wind_speed_m_s"][3] = "calm"
        with self.assertRaisesRegex(ValueError, "weather: column 'wind_speed_m_s', row 3: .*calm"):
            surface(given)
        given = weather()
        given["air_temperature_K"][2] = 17.0
        with self.assertRaisesRegex(diurna.Error, "given weather.csv:4:"):
            surface(given)
        given = weather()
        given["time"][4] = np.datetime64("NaT")
        with self.assertRaisesRegex(ValueError, "row 4: an instant is missing"):
            surface(given)


@unittest.skipUnless(pandas, "pandas is not here")
class OfPandas(unittest.TestCase):
    def table(self, zone="UTC"):
        given = weather()
        index = pandas.DatetimeIndex(given.pop("time"), name="time").tz_localize("UTC").tz_convert(zone)
        return pandas.DataFrame(given, index=index)

    def test_any_zone_is_the_same_day(self):
        expected = surface(weather())
        for zone in ("UTC", "America/New_York", "Asia/Kathmandu", "Etc/GMT+4"):
            with self.subTest(zone):
                np.testing.assert_array_equal(surface(self.table(zone)), expected)

    def test_through_a_change_of_the_clock(self):
        # 29 March 2026, 01:00 UTC: clocks of Berlin go from 02:00 to 03:00; instants have their own offsets.
        given = weather()
        given["time"] = hours("2026-03-28T12:00:00")
        job = {**plate, "time": {**plate["time"], "start": "2026-03-28T12:00:00Z", "end": "2026-03-29T12:00:00Z"}}
        table = pandas.DataFrame(given)
        table["time"] = table["time"].dt.tz_localize("UTC").dt.tz_convert("Europe/Berlin")
        found, expected = diurna.column(job, table), diurna.column(job, given)
        np.testing.assert_array_equal(found["surface_temperature_K"], expected["surface_temperature_K"])

    def test_naive_times_are_refused(self):
        for table in (self.table().tz_localize(None), self.table().tz_localize(None).reset_index()):
            with self.assertRaisesRegex(ValueError, "weather: column 'time', row 0: .*tz_localize"):
                surface(table)

    def test_types_of_numbers(self):
        expected = surface(weather())
        table = self.table()
        table["air_temperature_K"] = table["air_temperature_K"].astype("int64")
        table["longwave_down_W_m2"] = table["longwave_down_W_m2"].astype("Int32")  # with pandas.NA
        table["wind_speed_m_s"] = table["wind_speed_m_s"].astype("float32")
        np.testing.assert_array_equal(surface(table), expected)
        table["relative_humidity"] = table["relative_humidity"].astype("Float64")
        table.iloc[6, table.columns.get_loc("relative_humidity")] = pandas.NA
        np.testing.assert_allclose(surface(table), expected, atol=1e-9)

    def test_out(self):
        table = diurna.column(plate, self.table("Asia/Tokyo")).frame()
        self.assertEqual(str(table.index.tz), "UTC")
        self.assertEqual(table.index.name, "time")
        self.assertTrue((table.dtypes == np.dtype(float)).all())
        self.assertEqual(table.index[0], pandas.Timestamp("2026-06-21T00:00:00Z"))
        daily = table["surface_temperature_K"].resample("6h").mean()  # as what pandas takes for instants
        self.assertEqual(len(daily), 5)

    def test_what_is_no_table(self):
        with self.assertRaisesRegex(diurna.Error, "weather: found list"):
            surface([1, 2])
        with self.assertRaisesRegex(ValueError, "row 0"):  # an index that is no instants
            surface(self.table().reset_index(drop=True))


if __name__ == "__main__":
    unittest.main()
