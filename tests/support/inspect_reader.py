"""Compares what `diurna inspect --json` tells of files with what other readers find in them.

    inspect_reader.py DIURNA SOURCES FOLDER   FOLDER holds temperatures.nc
"""

import csv
import json
import pathlib
import subprocess
import sys

import netCDF4
import numpy
import OpenImageIO

program, sources, folder = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
place = sources / "scenes" / "jacksboro"


def inspect(file):
    printed = subprocess.run([program, "inspect", str(file), "--json"], stdout=subprocess.PIPE, check=True)
    return json.loads(printed.stdout)


def check(good, what):
    if not good:
        sys.exit("differs: " + what)


def near(printed, value, share=1e-6):
    return abs(printed - value) <= share * max(1.0, abs(value))


def raster():
    printed = inspect(place / "elevation.tif")
    share = OpenImageIO.ImageInput.open(str(place / "elevation.tif")).read_image("float")[..., 0]
    height = numpy.rint(share.astype(numpy.float64) * 32767)  # of the greatest INT16
    band = printed["bands"][0]
    check(printed["kind"] == "elevation raster" and "EPSG:4326" in printed["crs"], "kind")
    check((printed["rows"], printed["columns"]) == height.shape, "size")
    check((band["least"], band["most"]) == (height.min(), height.max()) and near(band["mean"], height.mean()), "heights")
    check(band["no_data"] == "none" and printed["voids"] == 0, "voids")
    # Three arc seconds; metres by degrees of WGS84's meridian and parallel there (NGA: 110.97 and 89.86 km at 36.3).
    check(near(printed["posting_m"][0], 89860 / 1200, 2e-3) and near(printed["posting_m"][1], 110970 / 1200, 2e-3), "posting")
    check(near(printed["centre_latitude_deg"], printed["upper_left"][1] - 344 / 2 / 1200), "latitude")
    check(near(printed["centre_longitude_deg"], printed["upper_left"][0] + 403 / 2 / 1200), "longitude")
    subprocess.run([program, "visibility", str(place / "elevation.tif"), "--azimuths", "4", "--out", str(folder / "sky.tif")],
                   stdout=subprocess.DEVNULL, check=True)
    check(inspect(folder / "sky.tif")["kind"] == "raster", "no elevation")


def weather():
    printed = inspect(place / "weather.csv")
    rows = list(csv.DictReader(line for line in open(place / "weather.csv") if not line.startswith("#")))
    check(printed["kind"] == "weather" and printed["rows"] == len(rows), "rows")
    check(printed["usual_step_s"] == 1800 and printed["gaps_in_time"] == 0, "step")
    for column in printed["columns"]:
        value = numpy.array([float(r[column["column"]]) for r in rows])
        check(column["missing"] == 0 and near(column["least"], value.min()) and near(column["most"], value.max()), "range")
        check(near(column["mean"], value.mean()), "mean")
    check({c["column"] for c in printed["columns"]} == set(rows[0]) - {"time"}, "columns")
    (folder / "gappy.csv").write_text("time,air_temperature_K\n2026-01-01T00:00:00Z,280\n2026-01-01T01:00:00Z,\n"
                                      "2026-01-01T02:00:00Z,282\n2026-01-01T06:00:00Z,283\n2026-01-01T07:00:00Z,284\n")
    printed = inspect(folder / "gappy.csv")
    check(printed["gaps"] == [{"from": "2026-01-01T02:00:00Z", "to": "2026-01-01T06:00:00Z", "seconds": 14400.0}], "gap")
    check(printed["columns"][0]["missing"] == 1, "missing")


def mesh():
    printed = inspect(place / "truck.obj")
    vertex, facets, groups, group = [], 0, {}, ""
    for line in open(place / "truck.obj"):
        words = line.split()
        if words[:1] == ["v"]:
            vertex.append([float(w) for w in words[1:4]])
        elif words[:1] in (["g"], ["o"]):
            group = words[1]
        elif words[:1] == ["f"]:
            groups[group] = groups.get(group, 0) + len(words) - 3
    check(printed["facets"] == sum(groups.values()), "facets")
    check({g["group"]: g["facets"] for g in printed["groups"]} == groups, "groups")
    check(all(near(t, v, 1e-5) for t, v in zip(printed["low"] + printed["high"], [*numpy.min(vertex, 0), *numpy.max(vertex, 0)])), "bounds")


def temperatures():
    printed = inspect(folder / "temperatures.nc")
    data = netCDF4.Dataset(folder / "temperatures.nc")
    kelvin = data["surface_temperature"][:].filled().astype(numpy.float64)
    check((printed["instants"], printed["facets"]) == kelvin.shape, "shape")
    check(printed["first"] == data["local_time"][0] and printed["last"] == data["local_time"][-1], "times")
    for row, at in zip(printed["temperatures"], kelvin):
        check(near(row["least_K"], at.min()) and near(row["most_K"], at.max()), "range")
    for kind in ("material", "object"):
        words, number = data[kind].flag_meanings.split(), data[kind][:].filled()
        check({(m[kind], m["facets"]) for m in printed[kind + "s"]} == {(words[n], (number == n).sum()) for n in set(number)}, kind)


def picture():
    names = ["radiance.8-12", "range"]
    pixels = numpy.random.default_rng(3).uniform(1, 90, (5, 7, 2)).astype(numpy.float32)
    pixels[2, 3, 1] = numpy.nan
    spec = OpenImageIO.ImageSpec(7, 5, 2, "float")
    spec.channelnames = names
    spec["diurna.observer"], spec["diurna.instant"] = "hill", "2026-07-15T16:00:00Z"
    spec["unit.range"], spec["note.moon"] = "m", "none"
    out = OpenImageIO.ImageOutput.create(str(folder / "two.exr"))
    out.open(str(folder / "two.exr"), spec)
    out.write_image(pixels)
    out.close()
    printed = inspect(folder / "two.exr")
    check((printed["width_px"], printed["height_px"], printed["observer"], printed["utc"]) == (7, 5, "hill", "2026-07-15T16:00:00Z"), "head")
    planes = {p["plane"]: p for p in printed["planes"]}
    check(set(planes) == set(names) and planes["range"]["unit"] == "m", "planes")
    for k, name in enumerate(names):
        value = pixels[..., k][numpy.isfinite(pixels[..., k])].astype(numpy.float64)
        check(near(planes[name]["least"], value.min()) and near(planes[name]["most"], value.max()) and near(planes[name]["mean"], value.mean()), name)
        check(planes[name]["finite_px"] == value.size, "finite")
    check({"attribute": "note.moon", "text": "none"} in printed["attributes"], "note")


raster()
weather()
mesh()
temperatures()
picture()
print("as others read it")
