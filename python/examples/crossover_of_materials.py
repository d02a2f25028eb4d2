"""When do bare soil and a pond have the same apparent temperature at 8 to 12 um, and how far does the wind's error shift it?"""

import pathlib
import tempfile

import diurna
from meadow import meadow, plate

study = {
    "name": "soil",
    "first": "soil",
    "second": "pond",
    "refined": False,
    "uncertain": [{"key": "weather.changed.wind_factor", "one_sigma": 1.2}],
}
with tempfile.TemporaryDirectory() as folder:
    table = meadow(ground=[plate("soil", "bare_soil", -8.0, 0.0), plate("pond", "water", 8.0, 0.0)], crossover=[study])
    found = diurna.Scene(table, file=pathlib.Path(folder) / "scene.toml").crossover()["soil"]


# %% Each crossing with its standard deviation, and the curve of the difference
print(found.frame()[["time", "kind", "warmer_after", "slope_K_per_h", "sigma_s"]].to_string())
difference = found.curves_frame().set_index("time")["difference_K"]
lost = (difference.abs() < 1.0).mean()
print(f"contrast from {difference.min():.1f} to {difference.max():.1f} K, below 1 K in {100 * lost:.0f} % of the day")
