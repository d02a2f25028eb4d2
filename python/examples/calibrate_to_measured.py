"""Which albedo does a surface have whose temperature was measured? A curve in pandas, with gaps and noise."""

import pathlib

import numpy as np
import pandas

import diurna

sample = pathlib.Path(diurna.data_folder()).parent / "scenes" / "jacksboro"
job = {
    "site": {"latitude_deg": 36.32, "longitude_deg": -84.2, "elevation_m": 323.0},
    "material": {"name": "pavement", "like": "asphalt"},
    "weather": {"file": sample / "weather.csv", "interval": "instant", "wind_height_m": 10.0},
    "time": {"start": "2026-07-15T00:00:00-04:00", "end": "2026-07-16T00:00:00-04:00", "step_s": 1800.0},
}

# %% In place of a thermometer's data: a pavement lighter than the library's, with noise of 0.3 K and a gap
truth = diurna.column(job, settings=["material.albedo=0.17"]).frame()["surface_temperature_K"]
measured = truth + np.random.default_rng(1).normal(0.0, 0.3, len(truth))
measured.iloc[10:14] = np.nan
measured = measured.tz_convert("America/New_York")


# %% Fit the albedo
sought = [{"key": "material.albedo", "low": 0.05, "high": 0.4}]
found = diurna.calibrate({**job, "calibrate": {"sought": sought}}, measured)
print(found)
print(found.frame()[["key", "value", "least_95", "most_95"]].to_string())
curves: pandas.DataFrame = found.curves_frame()
print(f"measured minus fitted, standard deviation: {(curves['measured_K'] - curves['after_K']).std():.2f} K")
