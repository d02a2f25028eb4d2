"""At which range does a cooled camera show a hut at night, in clear and in hazy air, dry and humid?"""

import pathlib
import tempfile

import diurna
from meadow import drone, meadow

hut = {"name": "hut", "place_m": [0.0, 0.0], "width_m": 3.0, "depth_m": 2.5, "height_m": 2.5, "wall": "brick"}
eye = drone(place_m=[0.0, -400.0], height_above_ground_m=40.0, look_at_m=[0.0, 0.0], horizontal_fov_deg=2.0, bands=["3-5"])
for key in ("azimuth_deg", "elevation_deg"):
    del eye[key]
study = {"object": "hut", "range_m": [100.0, 30000.0], "frames": ["2026-07-15T03:00:00-04:00"]}
table = meadow(
    building=[hut],
    observer=[eye],
    instrument=[{"name": "camera", "observer": "drone", "preset": "cooled_mwir"}],
    detection=[study],
)

# %% Temperatures once, then six kinds of air
with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder) / "scene.toml"
    diurna.Scene(table, file=file).run(pathlib.Path(folder) / "out")
    heat = pathlib.Path(folder) / "out" / "temperatures.nc"  # shared by all: only the air on the line of sight changes
    for profile in ("SAW", "MLS", "TROP"):
        for visibility_km in (5.0, 23.0):
            air = [f'atmosphere.profile="{profile}"', f"atmosphere.visibility_km={visibility_km}"]
            found = diurna.Scene(file, settings=air).detection(temperatures=heat)["hut"]
            seen = found.summary["instants"][0]
            ranges = {task: reach["0.5"] for task, reach in seen["ttp_range_m"].items()}
            ranges_text = ", ".join(f"{task} {reach / 1000:.1f} km" for task, reach in ranges.items())
            print(f"{profile} {visibility_km:4.0f} km: {seen['rss_contrast_K']:.1f} K at the camera; {ranges_text}")
