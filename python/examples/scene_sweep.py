"""How do wall material and field of view change a picture of a hut? A scene with [sweep]: variants share temperatures."""

import pathlib
import tempfile

import numpy as np

import diurna
from meadow import drone, meadow

hut = {"name": "hut", "place_m": [0.0, 0.0], "width_m": 4.0, "depth_m": 3.0, "height_m": 2.5, "wall": "brick"}
eye = drone(place_m=[0.0, -40.0], height_above_ground_m=8.0, look_at_m=[0.0, 0.0])
for key in ("azimuth_deg", "elevation_deg"):
    del eye[key]
axes = [
    {"key": "building.hut.wall", "values": ["brick", "wood", "concrete"]},
    {"key": "observer.drone.horizontal_fov_deg", "values": [10.0, 20.0]},
]
table = meadow(building=[hut], observer=[eye], sweep={"axis": axes})
table["time"] = {**table["time"], "frames": ["2026-07-15T05:00:00-04:00"]}
del table["time"]["frame_every_s"]

# %% Six variants, three heat balances: the field of view changes no temperature
with tempfile.TemporaryDirectory() as folder:
    swept = diurna.Scene(table, file=pathlib.Path(folder) / "scene.toml").sweep(pathlib.Path(folder) / "out")
    print(f"{len(swept)} variants, {swept.solved} heat balances")
    for record in swept.records:
        frame = next(swept.frames(record["variant"], ["apparent_temperature.8-12", "object"]))
        on_hut = frame["object"] == np.nanmax(frame["object"])
        kelvin = frame["apparent_temperature.8-12"][on_hut].mean()
        wall, fov = record["building.hut.wall"], record["observer.drone.horizontal_fov_deg"]
        print(f"{wall:9} {fov:.0f} deg: {on_hut.sum()} pixels, {kelvin:.1f} K")
