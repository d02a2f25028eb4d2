"""Where are vehicles in the pictures, and how large? Labels of a run, compared with its truth planes."""

import pathlib
import tempfile

import numpy as np

import diurna
from meadow import drone, meadow, samples

def truck(name, east_m, north_m, heading_deg):
    """A vehicle of the sample mesh, labelled by its class."""
    return {
        "name": name,
        "class": "vehicle",
        "mesh": samples / "jacksboro" / "truck.obj",
        "place_m": [east_m, north_m],
        "heading_deg": heading_deg,
        "material": "green_paint",
        "largest_edge_m": 1.0,
    }


vehicles = [truck("first", -8.0, 0.0, 30.0), truck("second", 9.0, 4.0, 100.0)]
table = meadow(object=vehicles, observer=[drone(width=160, height=120, horizontal_fov_deg=40.0)])
table["time"] = {**table["time"], "frames": ["2026-07-15T06:00:00-04:00", "2026-07-15T13:00:00-04:00"]}
del table["time"]["frame_every_s"]

# %% The run writes annotations.json in the form of COCO
with tempfile.TemporaryDirectory() as folder:
    run = diurna.Scene(table, file=pathlib.Path(folder) / "scene.toml").run(pathlib.Path(folder) / "out", only="band=8-12")
    labels, frames = run.annotations(), list(run.frames())
    legend = {one["name"]: one["id"] for one in run.manifest()["legend"]["objects"]}

# %% Boxes, and the same from the plane `object`
classes = {one["id"]: one["name"] for one in labels["categories"]}
for picture in labels["images"]:
    print(picture["file_name"])
    for one in labels["annotations"]:
        if one["image_id"] == picture["id"]:
            left, top, width, height = one["bbox"]
            print(f"  {classes[one['category_id']]}: box {width:.0f} x {height:.0f} pixels at {left:.0f}, {top:.0f}")
for frame in frames:
    kelvin, number = frame["apparent_temperature.8-12"], frame["object"]
    for name in ("first", "second"):
        rows, columns = np.nonzero(number == legend[name])
        contrast = kelvin[rows, columns].mean() - np.nanmedian(kelvin)
        print(f"{frame.instant}Z {name}: {rows.size} pixels, {contrast:+.1f} K against the meadow")
