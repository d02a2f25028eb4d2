"""In which direction is a truck's radiant intensity at 8 to 12 um highest, at night and in the afternoon?"""

import pathlib
import tempfile

import diurna
from meadow import meadow, samples

truck = {
    "name": "truck",
    "mesh": samples / "jacksboro" / "truck.obj",
    "place_m": [0.0, 0.0],
    "heading_deg": 0.0,
    "material": "green_paint",
    "parts": {"windows": "glass", "wheels": "rubber"},
}
study = {
    "object": "truck",
    "bands": ["8-12"],
    "directions": 42,
    "pixels": 48,
    "samples": 4,
    "frames": ["2026-07-15T04:00:00-04:00", "2026-07-15T15:00:00-04:00"],
}
with tempfile.TemporaryDirectory() as folder:
    scene = diurna.Scene(meadow(object=[truck], signature=[study]), file=pathlib.Path(folder) / "scene.toml")
    found = scene.signature()["truck"]

# %% The direction of the highest intensity
for when, rows in found.frame().groupby("time"):
    most = rows.loc[rows["radiant_intensity_W_sr"].idxmax()]
    print(
        f"{when.tz_convert('Etc/GMT+4'):%H:%M}: {rows['radiant_intensity_W_sr'].mean():.0f} W/sr on average, most "
        f"{most['radiant_intensity_W_sr']:.0f} at {most['aspect_deg']:.0f} deg from its front, {most['elevation_deg']:.0f} "
        f"deg up; from the background {rows['contrast_intensity_W_sr'].mean():+.1f}"
    )
