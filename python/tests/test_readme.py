"""The example of README.md runs unchanged, on files with the names it uses."""

import contextlib
import io
import os
import pathlib
import re
import tempfile
import unittest

import diurna
from heated_plate import heated_plate
from test_point import plate, weather

try:
    import pandas
except ImportError:
    pandas = None

os.environ["DIURNA_STAGES"] = "off"
readme = pathlib.Path(__file__).parent.parent / "README.md"


@unittest.skipUnless(pandas, "pandas is not here")
class Readme(unittest.TestCase):
    def test_example(self):
        (example,) = re.findall(r"```python\n(.*?)```", readme.read_text(), re.DOTALL)
        given = weather()
        given["time"] = pandas.DatetimeIndex(given["time"]).tz_localize("UTC")
        data_frame = pandas.DataFrame(given).set_index("time")
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as name:
            os.chdir(name)
            try:
                folder = pathlib.Path(name)
                data_frame.rename(columns=str).to_csv("weather.csv", date_format="%Y-%m-%dT%H:%M:%S+00:00")
                sought = [{"key": "material.convection.value_W_m2K", "low": 2.0, "high": 40.0}]
                job = {**plate, "weather": {**plate["weather"], "file": "weather.csv"}, "calibrate": {"sought": sought}}
                job["calibrate"]["measured"] = "weather.csv"
                (folder / "column.toml").write_text(diurna.toml_text(job))
                truth = {key: value for key, value in job.items() if key != "calibrate"}
                series = diurna.column(truth).frame()["surface_temperature_K"]
                study = [{"name": "plates", "first": "plate", "second": "ground", "refined": False}]
                (folder / "scene.toml").write_text(diurna.toml_text(heated_plate(folder, crossover=study)))
                axis = [{"key": "observer.drone.horizontal_fov_deg", "values": [20.0, 40.0]}]
                (folder / "swept.toml").write_text(diurna.toml_text(heated_plate(folder, sweep={"axis": axis})))
                names = {"data_frame": data_frame, "series": series}
                with contextlib.redirect_stdout(io.StringIO()) as printed:
                    exec(compile(example, readme, "exec"), names)
            finally:
                os.chdir(before)
        self.assertIn("facets", printed.getvalue())
        self.assertIn("terrain 100%", printed.getvalue())
        self.assertAlmostEqual(names["found"]["plates"].summary["threshold_K"], 1.0)


if __name__ == "__main__":
    unittest.main(warnings="ignore")  # the dark scene has warnings
