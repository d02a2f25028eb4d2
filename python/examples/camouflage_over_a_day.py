"""Which of three paints has the least contrast to a meadow through a day, and when does each have the most?"""

import pathlib
import tempfile

import diurna
from meadow import meadow, samples

paints = ["green_paint", "sand_paint", "low_emissivity_paint"]
sheets = [
    {
        "name": paint,
        "mesh": samples / "crossover" / "plate.obj",
        "up": "z",
        "place_m": [10.0 * (i - 1), 0.0],
        "height_above_ground_m": 0.5,
        "material": paint,
    }
    for i, paint in enumerate(paints)
]

# %% A picture each hour, the contrast of each sheet to its background
with tempfile.TemporaryDirectory() as folder:
    table = meadow(object=sheets, contrast=[{"targets": paints, "name": "paints"}])
    found = diurna.Scene(table, file=pathlib.Path(folder) / "scene.toml").contrast()["paints"]

day = found.frame().pivot(index="time", columns="target", values="rss_K").tz_convert("Etc/GMT+4")
print(day[paints].iloc[::3].round(1).to_string())
for paint in paints:
    print(f"{paint}: {day[paint].mean():.1f} K on average, most at {day[paint].idxmax():%H:%M} with {day[paint].max():.1f} K")
