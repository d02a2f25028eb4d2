"""How does a single pixel change through a day? One on asphalt and one on grass, from a run's pictures."""

import pathlib
import tempfile

import pandas

import diurna
from meadow import meadow, plate

rows = {}
with tempfile.TemporaryDirectory() as folder:
    scene = diurna.Scene(meadow(ground=[plate("road", "asphalt", 0.0, 0.0, 10.0)]), file=pathlib.Path(folder) / "scene.toml")
    run = scene.run(pathlib.Path(folder) / "out", fresh=True)
    for frame in run.frames(["apparent_temperature.8-12"]):
        kelvin = frame["apparent_temperature.8-12"]
        height, width = kelvin.shape
        rows[frame.instant] = {"asphalt": kelvin[height // 2, width // 2], "grass": kelvin[2, 2]}


# %% A table by local time
series = pandas.DataFrame.from_dict(rows, orient="index").tz_localize("UTC").tz_convert("Etc/GMT+4")
print(series.iloc[::3].round(2).to_string())
swing = series.max() - series.min()
print(f"the range on asphalt is {swing['asphalt']:.1f} K, on grass {swing['grass']:.1f} K")
