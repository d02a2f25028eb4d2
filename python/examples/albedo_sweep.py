"""How much cooler is a roof for each step of albedo? A loop over dictionaries with the same weather."""

import pathlib

import numpy as np

import diurna

sample = pathlib.Path(diurna.data_folder()).parent / "scenes" / "jacksboro"
shared = {
    "site": {"latitude_deg": 36.32, "longitude_deg": -84.2, "elevation_m": 323.0},
    "weather": {"file": sample / "weather.csv", "interval": "instant", "wind_height_m": 10.0},
    "time": {"start": "2026-07-15T00:00:00-04:00", "end": "2026-07-16T00:00:00-04:00", "step_s": 1800.0},
}

# %% One column for each albedo
albedos = np.linspace(0.1, 0.8, 8)
warmest = []
for albedo in albedos:
    roof = {"name": "roof", "like": "concrete", "albedo": albedo}
    warmest.append(diurna.column({**shared, "material": roof})["surface_temperature_K"].max())
    print(f"albedo {albedo:.1f}: warmest {warmest[-1]:.1f} K")

# %% The slope of a straight line through them
slope, _ = np.polyfit(albedos, warmest, 1)
print(f"{-0.1 * slope:.1f} K cooler for each tenth of albedo")
