"""Which number shifts the morning crossover of soil and a pond most: the wind, the soil's albedo or its emissivity?"""

import pathlib
import tempfile

import diurna
from meadow import meadow, plate

study = {
    "trajectories": 0,
    "uncertain": [
        {"key": "weather.changed.wind_factor", "low": 0.7, "high": 1.3},
        {"key": "material.bare_soil.albedo", "low": 0.17, "high": 0.23},
        {"key": "material.bare_soil.emissivity", "low": 0.95, "high": 0.98},
    ],
    "output": [{"first": "soil", "second": "pond", "figure": "crossover", "name": "morning"}],
}
with tempfile.TemporaryDirectory() as folder:
    table = meadow(ground=[plate("soil", "bare_soil", -8.0, 0.0), plate("pond", "water", 8.0, 0.0)], sensitivity=[study])
    found = diurna.Scene(table, file=pathlib.Path(folder) / "scene.toml").sensitivity()[0]


# %% Minutes for each number
numbers = found.frame().set_index("key")
minutes = 60 * (numbers["at_high"] - numbers["at_low"])
print(f"crossover {numbers['at_base'].iloc[0]:.2f} h after midnight")
for key, moved in minutes.sort_values(key=abs, ascending=False).items():
    print(f"{key:32} from {numbers['low'][key]:g} to {numbers['high'][key]:g} shifts it by {moved:+.1f} min")
