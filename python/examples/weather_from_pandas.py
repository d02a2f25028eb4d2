"""How much does a cloudy, windy day change a meadow and a road? Weather made in pandas, for a scene and for a column."""

import pathlib
import tempfile

import numpy as np
import pandas

import diurna
from meadow import meadow, plate

# %% Two days of weather; columns are named as in weather files, instants have their time zone
time = pandas.date_range("2026-07-14T00:00", "2026-07-16T06:00", freq="1h", tz="America/New_York")
phase = 2 * np.pi * (time.hour - 15) / 24
clear = pandas.DataFrame(
    {
        "air_temperature_K": 294.0 + 6.0 * np.cos(phase),
        "relative_humidity": 0.6 - 0.25 * np.cos(phase),
        "wind_speed_m_s": 1.5,
        "cloud_fraction": 0.0,
    },
    index=time,
)
cloudy = clear.assign(wind_speed_m_s=6.0, cloud_fraction=0.9)
cloudy.iloc[30, cloudy.columns.get_loc("relative_humidity")] = np.nan  # a value that is missing

# %% The scene, once under each
with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder) / "scene.toml"
    table = meadow(ground=[plate("road", "asphalt", 0.0, 0.0, 10.0)])
    table["time"] = {**table["time"], "frames": ["2026-07-15T14:00:00-04:00"]}
    del table["time"]["frame_every_s"], table["weather"]
    table["weather"] = {"interval": "instant", "wind_height_m": 10.0}
    for name, weather in (("clear", clear), ("cloudy", cloudy)):
        scene = diurna.Scene(table, file=file, overwrite=True, weather=weather)
        run = scene.run(pathlib.Path(folder) / name, threads=2)
        kelvin = next(run.frames())["apparent_temperature.8-12"]
        print(f"{name}: road {kelvin[24, 32]:.1f} K, meadow {kelvin[2, 2]:.1f} K at 14 h")

# %% The same table drives one facet
column = diurna.column(
    {
        "site": {"latitude_deg": 36.32, "longitude_deg": -84.2, "elevation_m": 300.0},
        "material": {"name": "asphalt"},
        "weather": {"interval": "instant", "wind_height_m": 10.0},
        "time": {"start": "2026-07-15T00:00:00-04:00", "end": "2026-07-16T00:00:00-04:00", "step_s": 3600.0},
    },
    weather=clear,
)
print(f"asphalt by itself: {column['surface_temperature_K'].max():.1f} K at the most; {column.note}")
