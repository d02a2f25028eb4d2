#!/usr/bin/env python3
"""Predicts a station's hours: python3 predict.py SITE OUT --diurna PATH. Writes OUT/prediction.csv.

Opens the site's rasters and weather, not its measurements: compare.py does that.
"""

import argparse
import csv
import datetime
import pathlib
import subprocess

from scene_of_site import write_scenes

COLUMNS = {"Kdown": "shortwave_down", "Kup": "shortwave_up", "Kn": "shortwave_from_north",
           "Ke": "shortwave_from_east", "Ks": "shortwave_from_south", "Kw": "shortwave_from_west",
           "Ldown": "longwave_down", "Lup": "longwave_up", "Ln": "longwave_from_north",
           "Le": "longwave_from_east", "Ls": "longwave_from_south", "Lw": "longwave_from_west"}


def hourly(file):
    """(hour) mean over the hour of every column, rows at its two ends counted half."""
    rows = list(csv.DictReader(file.open()))
    stamps = [datetime.datetime.fromisoformat(row["time"]) for row in rows]
    names = {short: f"{long}_W_m2" for short, long in COLUMNS.items()}
    names.update({"Tmrt": "mean_radiant_temperature_K", "sun": "sun_in_view"})
    means = []
    for hour in range(24):
        sums, weights = dict.fromkeys(names, 0.0), 0.0
        for row, stamp in zip(rows, stamps):
            at = (stamp - stamps[0]).total_seconds() / 3600.0
            weight = 0.5 if at in (hour, hour + 1) else float(hour < at < hour + 1)
            weights += weight
            for short, long in names.items():
                sums[short] += weight * float(row[long])
        means.append({short: total / weights for short, total in sums.items()})
    return means


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("site", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--diurna", default="build/release/diurna")
    a = parser.parse_args()
    table = [["date", "hour", *COLUMNS, "Tmrt", "sun"]]
    for scene in write_scenes(a.site, a.out):
        result = scene.parent / "temperatures.nc"
        subprocess.run([a.diurna, "solve", scene, "--out", result], check=True)
        for hour, mean in enumerate(hourly(scene.parent / "radiometer_station.csv")):
            table.append([scene.parent.name, hour, *(f"{mean[k]:.3f}" for k in table[0][2:])])
    with (a.out / "prediction.csv").open("w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(table)


if __name__ == "__main__":
    main()
