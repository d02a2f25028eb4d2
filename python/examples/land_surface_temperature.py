"""How wrong is a radiometer that assumes an emissivity of 1, through a day?

It receives eps B(T) + (1 - eps) L_sky. The error disappears once emissivity and sky radiance are known.
"""

import pathlib

import numpy as np

import diurna

sample = pathlib.Path(diurna.data_folder()).parent / "scenes" / "jacksboro"
emissivity, band = 0.93, "8-12"
day = diurna.column(
    {
        "site": {"latitude_deg": 36.32, "longitude_deg": -84.2, "elevation_m": 323.0},
        "material": {"name": "sandy", "like": "bare_soil", "emissivity": emissivity},
        "weather": {"file": sample / "weather.csv", "interval": "instant", "wind_height_m": 10.0},
        "time": {"start": "2026-07-15T00:00:00-04:00", "end": "2026-07-16T00:00:00-04:00", "step_s": 3600.0},
    }
)
kelvin = day["surface_temperature_K"]
# %% The sky in the band, from 55 degrees off the zenith, where its radiance is about the mean of the hemisphere
sky = diurna.path(band, "MLS", "rural", 23.0, height_km=0.323, zenith_deg=55.0, to_space=True)[band].thermal_W_m2_sr
received = emissivity * diurna.band_radiance(band, kelvin) + (1 - emissivity) * sky
assumed_black = diurna.apparent_temperature(band, received)
corrected = diurna.apparent_temperature(band, (received - (1 - emissivity) * sky) / emissivity)


# %% Every third hour
for when, true, black, known in list(zip(day["time"], kelvin, assumed_black, corrected))[::3]:
    print(f"{when}Z: {true:.1f} K; assumed black {black - true:+.2f} K, corrected {known - true:+.4f} K")
print(f"on average {np.mean(assumed_black - kelvin):+.2f} K, at the most {np.min(assumed_black - kelvin):+.2f} K")
