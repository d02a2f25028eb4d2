"""What would a scene cost, and what do its pictures show? The sample scene of plates in a meadow, up to 14 h."""

import pathlib
import tempfile

import numpy as np

import diurna

sample = pathlib.Path(diurna.data_folder()).parent / "scenes" / "crossover" / "scene.toml"
scene = diurna.Scene(sample, settings=["time.duration_h=14", "time.frame_every_s=7200"])

plan = scene.plan()
print(f"{plan['facets']} facets, {plan['pictures']} pictures, {plan['memory_bytes'] / 1e6:.0f} MB")

# %% Run it, and look at each picture
with tempfile.TemporaryDirectory() as folder:
    run = scene.run(pathlib.Path(folder) / "out")
    print(f"{run.frames_rendered} pictures, {len(run.files)} files")
    for frame in run.frames():
        if "apparent_temperature.8-12" not in frame.planes or frame.observer != "drone":
            continue
        kelvin = frame["apparent_temperature.8-12"]
        print(frame.instant, f"{np.nanmin(kelvin):.1f} to {np.nanmax(kelvin):.1f} K")
