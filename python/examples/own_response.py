"""What would detectors of other spectral responses see? A cube of 7 to 14 um, weighted afterwards by three responses."""

import pathlib
import tempfile

import numpy as np

import diurna
from meadow import drone, meadow, plate

table = meadow(
    ground=[plate("sand", "sand", 0.0, 0.0, 10.0)],
    observer=[drone(cubes=["lines"], width=32, height=24)],
    cubes=[{"name": "lines", "range_um": [7.0, 14.0], "channels": 28}],
)
table["time"] = {**table["time"], "frames": ["2026-07-15T14:00:00-04:00"]}
del table["time"]["frame_every_s"]
with tempfile.TemporaryDirectory() as folder:
    run = diurna.Scene(table, file=pathlib.Path(folder) / "scene.toml").run(pathlib.Path(folder) / "out", fresh=True)
    cube = next(frame for frame in run.frames() if next(iter(frame.planes)).startswith("S0"))

# %% Channels are named by their wavelength, "S0.009125,000nm", in W m-2 sr-1 nm-1.
wavelength_um = np.array([float(name[3:-2].replace(",", ".")) / 1000 for name in cube.planes])
radiance = np.stack(list(cube.planes.values()))
sand, grass = radiance[:, 12, 16], radiance[:, 2, 2]

# %% Three responses
responses = {
    "flat, 8 to 12 um": ((wavelength_um > 8) & (wavelength_um < 12)).astype(float),
    "bolometer about 10 um": np.exp(-(((wavelength_um - 10.0) / 1.8) ** 2)),
    "quartz's bands, 8.2 to 9.4 um": ((wavelength_um > 8.2) & (wavelength_um < 9.4)).astype(float),
}
for name, response in responses.items():
    here, there = (np.sum(response * spectrum) for spectrum in (sand, grass))
    print(f"{name:30} sand over grass {here / there:.4f}")
