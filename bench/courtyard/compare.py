#!/usr/bin/env python3
"""Holds a prediction against the station: python3 compare.py SITE OUT.

Hours with the sun's disc in view for part of the hour only are counted apart ("edge"): there a metre of roof
decides. Hours with global light below 5 W/m2 are left out of shortwave. Mean radiant temperature is computed from
the twelve measured fluxes (0.22 each side, 0.06 up and down, 0.7 and 0.97), as the prediction's is.

Some stations' clocks are an hour late against the weather's (at Gustav Adolfs row h of the station is row h - 1 of the
weather file, r 0.997). --late says so; without it, 0 and 1 are tried and the one with the smaller error of shortwave is
taken and named.
"""

import argparse
import csv
import math
import pathlib

from predict import COLUMNS
from scene_of_site import date_of, one_file, read_weather


def radiant(row):
    sides = "nesw"
    shortwave = 0.22 * sum(row["K" + s] for s in sides) + 0.06 * (row["Kdown"] + row["Kup"])
    longwave = 0.22 * sum(row["L" + s] for s in sides) + 0.06 * (row["Ldown"] + row["Lup"])
    return ((0.7 * shortwave + 0.97 * longwave) / 0.97 / 5.670374419e-8) ** 0.25


def measured(site):
    """(date, hour) fluxes, of all files of measurements; dates from the columns or the weather's only day."""
    days = sorted({date_of(row) for row in read_weather(site)})
    found = {}
    for file in sorted(site.glob("meas*.csv")):
        for line in csv.DictReader(file.open()):
            row = {k.strip().lower(): v for k, v in line.items()}
            hour = int(float(row["hour"]))
            day = row.get("date") or next((str(d) for d in days if str(d) in file.name), str(days[0]))
            try:
                values = {name: float(row[name.lower()]) for name in COLUMNS}
            except ValueError:
                continue  # an hour without all of them
            if any(math.isnan(v) or v <= -900 for v in values.values()):
                continue
            found[day, hour] = values
    return found


def line(name, pairs):
    if not pairs:
        return f"{name:24s}      -"
    errors = [p - m for p, m in pairs]
    rms = math.sqrt(sum(e * e for e in errors) / len(errors))
    return f"{name:24s} {len(errors):5d} {rms:8.1f} {sum(errors) / len(errors):+8.1f} {max(errors, key=abs):+8.1f}"


def rows_of(predictions, truth, late):
    """(day and hour of the station, predicted, measured)"""
    rows = []
    for (day, hour), predicted in sorted(predictions.items()):
        if (day, hour + late) in truth:
            rows.append(((day, hour + late), predicted, truth[day, hour + late]))
    return rows


def shortwave_rms(rows):
    errors = [p[n] - m[n] for _, p, m in rows for n in COLUMNS if n[0] == "K" and m["Kdown"] >= 5.0]
    return math.sqrt(sum(e * e for e in errors) / len(errors))


def table(rows):
    print(f"{'':24s} {'hours':>5s} {'rms':>8s} {'bias':>8s} {'worst':>8s}")
    for name in COLUMNS:
        lit = [r for r in rows if name[0] == "L" or r[2]["Kdown"] >= 5.0]
        clean = [(p[name], m[name]) for _, p, m in lit if name[0] == "L" or p["sun"] in (0.0, 1.0)]
        print(line(name + " [W/m2]", clean))
        if name[0] == "K":
            print(line(name + " edge [W/m2]", [(p[name], m[name]) for _, p, m in lit if 0 < p["sun"] < 1]))
    sides = [(p[n], m[n]) for _, p, m in rows for n in COLUMNS if n[0] == "L"]
    print(line("longwave, all [W/m2]", sides))
    clear = [r for r in rows if r[1]["sun"] in (0.0, 1.0)]
    sides = [(p[n], m[n]) for _, p, m in clear for n in COLUMNS if n[0] == "K" and m["Kdown"] >= 5.0]
    print(line("shortwave, all [W/m2]", sides))
    print(line("radiant temperature [K]", [(radiant(p), radiant(m)) for _, p, m in rows]))
    print(line("  without edges [K]", [(radiant(p), radiant(m)) for _, p, m in clear]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("site", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path, help="folder of prediction.csv, or such a file")
    parser.add_argument("--late", type=int, help="hours that the station's clock is late")
    a = parser.parse_args()
    truth = measured(a.site)
    file = a.out if a.out.suffix == ".csv" else a.out / "prediction.csv"
    predictions = {(row["date"], int(row["hour"])): {k: float(v) for k, v in row.items() if k not in ("date", "hour")}
                   for row in csv.DictReader(file.open())}
    late = a.late
    if late is None:
        rms = [shortwave_rms(rows_of(predictions, truth, hours)) for hours in (0, 1)]
        late = int(rms[1] < rms[0])
        print(f"station's clock: {late} h late (shortwave {rms[0]:.1f} W/m2 rms at 0 h, {rms[1]:.1f} at 1 h)")
    rows = rows_of(predictions, truth, late)
    table(rows)
    print("\npredicted/measured; hours of the station")
    print("date hour  sun  " + " ".join(f"{n:>11s}" for n in COLUMNS) + "         Tmrt")
    for (day, hour), p, m in rows:
        cells = " ".join(f"{p[n]:5.0f}/{m[n]:4.0f} " for n in COLUMNS)
        print(f"{day} {hour:2d} {p['sun']:5.2f}  {cells} {radiant(p) - 273.15:5.1f}/{radiant(m) - 273.15:5.1f}")


if __name__ == "__main__":
    main()
