"""How warm do asphalt, concrete and grass get on a July day? Curves of three materials under one weather file."""

import pathlib

import diurna

sample = pathlib.Path(diurna.data_folder()).parent / "scenes" / "jacksboro"

for material in ("asphalt", "concrete", "grass"):
    column = diurna.column(
        {
            "site": {"latitude_deg": 36.32, "longitude_deg": -84.2, "elevation_m": 323.0},
            "material": {"name": material},
            "weather": {"file": sample / "weather.csv", "interval": "instant", "wind_height_m": 10.0},
            "time": {"start": "2026-07-15T00:00:00-04:00", "end": "2026-07-16T00:00:00-04:00", "spin_up": "first-day"},
        }
    )
    kelvin = column["surface_temperature_K"]
    print(f"{material:9} {kelvin.min():.1f} to {kelvin.max():.1f} K, warmest at {column['time'][kelvin.argmax()]}Z")
