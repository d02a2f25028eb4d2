"""Which materials are there, and how does the thickness of a layer change a surface? Library materials, and parts of them."""

import pathlib

import diurna

materials = diurna.materials()
print(f"{len(materials)} materials, {len(diurna.models())} models, bands {', '.join(diurna.bands())}")
paints = sorted((one for one in materials if "paint" in one), key=lambda one: one.emissivity_8_12_um)
for paint in paints:
    print(f"{paint:22} albedo {paint.albedo:.2f}, emissivity {paint.emissivity_8_12_um:.2f} at 8 to 12 um: {paint.description}")

# %% A layer of a library material is set by its number, from 0 at the surface; the other layers stay
sample = pathlib.Path(diurna.data_folder()).parent / "scenes" / "jacksboro"
job = {
    "site": {"latitude_deg": 36.32, "longitude_deg": -84.2, "elevation_m": 323.0},
    "material": {"name": materials["asphalt"]},
    "weather": {"file": sample / "weather.csv", "interval": "instant", "wind_height_m": 10.0},
    "time": {"start": "2026-07-15T00:00:00-04:00", "end": "2026-07-16T00:00:00-04:00", "step_s": 1800.0},
}
print(f"asphalt has {len(materials['asphalt'].table['layers'])} layers")
for thickness_m in (0.02, 0.05, 0.1, 0.2):
    kelvin = diurna.column(job, settings={"material.layers.0.thickness_m": thickness_m})["surface_temperature_K"]
    print(f"first layer {100 * thickness_m:.0f} cm: {kelvin.min():.1f} to {kelvin.max():.1f} K")
