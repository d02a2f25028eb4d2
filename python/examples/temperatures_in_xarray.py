"""Where does a meadow stay warm longest after sunset? Temperatures of all facets in xarray, from a fast approximate run."""

import pathlib
import tempfile

import xarray

import diurna
from meadow import meadow, plate

table = meadow(ground=[plate("road", "asphalt", -8.0, 0.0), plate("slab", "concrete", 8.0, 0.0)])
with tempfile.TemporaryDirectory() as folder:
    scene = diurna.Scene(table, file=pathlib.Path(folder) / "scene.toml")
    # Only one picture, and facets that it does not see may share temperatures within 0.1 K.
    run = scene.run(pathlib.Path(folder) / "out", only="frames=12:00", threads=2, tolerance_K=0.1)
    kelvin = run.temperatures().xarray().load()

# %% Means by material, which is a coordinate of the facets
means: xarray.DataArray = kelvin.groupby("material").mean()
evening = means.sel(time=slice("2026-07-16T00:00", "2026-07-16T04:00"))  # 20 h to midnight of the clock there
for material in means["material"].values:
    of_it = evening.sel(material=material)
    print(f"{material:9} {float(means.sel(material=material).max()):.1f} K at the most, {float(of_it[0]):.1f} K at 20 h, {float(of_it[-1]):.1f} K at midnight")
print(f"warmest at midnight: {means['material'].values[int(evening.isel(time=-1).argmax())]}")
