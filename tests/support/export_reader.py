"""Reads what `diurna export` wrote with xml, csv, struct, zipfile, OpenImageIO and netCDF4, and compares it with temperatures.nc.

    export_reader.py FOLDER   holds run/temperatures.nc, curves.csv, day.pvd, ground.tif, mesh.ply,
                              overlay.kmz
"""

import base64
import csv
import datetime
import pathlib
import struct
import sys
import tempfile
import zipfile
import xml.etree.ElementTree as xml

import netCDF4
import numpy
import OpenImageIO

folder = pathlib.Path(sys.argv[1])
data = netCDF4.Dataset(folder / "run" / "temperatures.nc")
vertex = numpy.stack([data[a][:].filled() for a in ("east", "north", "up")], axis=1).astype(numpy.float64)
corner = data["corner_of_facet"][:].filled()
kelvin = data["surface_temperature"][:].filled()
seconds = data["time"][:].filled()
number = {name: data[name][:].filled() for name in ("material", "object")}
words = {name: data[name].flag_meanings.split() for name in number}
a, b, c = (vertex[corner[:, k]] for k in range(3))
area = 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)


def utc(text):
    return datetime.datetime.fromisoformat(text.replace("Z", "+00:00")).timestamp()


def check(good, what):
    if not good:
        sys.exit("differs: " + what)


def curves():
    rows = list(csv.DictReader(open(folder / "curves.csv", newline="")))
    names = {(r["kind"], r["name"]) for r in rows}
    check(names == {(k, words[k][n]) for k in number for n in set(number[k])}, "names")
    check(len(rows) == len(names) * len(seconds), "rows")
    for r in rows:
        of = number[r["kind"]] == words[r["kind"]].index(r["name"])
        at = kelvin[list(seconds).index(utc(r["utc"]))][of].astype(numpy.float64)
        check(utc(r["utc"]) == utc(r["local_time"]), "clock")
        check(int(r["facets"]) == of.sum(), "facets")
        check(abs(float(r["area_m2"]) / area[of].sum() - 1) < 1e-5, "area")
        check(abs(float(r["mean_K"]) - (at * area[of]).sum() / area[of].sum()) < 2e-4, "mean")
        check(abs(float(r["least_K"]) - at.min()) < 1e-4 and abs(float(r["most_K"]) - at.max()) < 1e-4, "ends")


def meshes():
    collection = xml.parse(folder / "day.pvd").getroot().find("Collection").findall("DataSet")
    check([float(d.get("timestep")) for d in collection] == list(seconds - seconds[0]), "time steps")
    kinds = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "UInt8": "u1"}
    for i, d in enumerate(collection):
        root = xml.parse(folder / d.get("file")).getroot()
        check(root.get("header_type") == "UInt64" and root.get("byte_order") == "LittleEndian", "head")
        arrays = {}
        for array in root.iter("DataArray"):
            raw = base64.b64decode(array.text, validate=True)
            check(struct.unpack("<Q", raw[:8])[0] == len(raw) - 8, "length")
            arrays[array.get("Name")] = numpy.frombuffer(raw[8:], kinds[array.get("type")])
        piece = root.find("UnstructuredGrid/Piece")
        check(int(piece.get("NumberOfPoints")) == len(vertex) and int(piece.get("NumberOfCells")) == len(corner), "size")
        check((arrays["Points"].reshape(-1, 3) == vertex.astype("<f4")).all(), "points")
        check((arrays["connectivity"].reshape(-1, 3) == corner).all(), "corners")
        check((arrays["offsets"] == 3 * numpy.arange(1, len(corner) + 1)).all(), "offsets")
        check((arrays["types"] == 5).all() and len(arrays["types"]) == len(corner), "types")
        check((arrays["temperature_K"] == kelvin[i]).all(), "temperatures")
        check(all((arrays[name] == number[name]).all() for name in number), "numbers")
        check(arrays["TimeValue"][0] == seconds[i], "time")
        for name in ("site_latitude_deg", "site_longitude_deg", "site_height_m"):
            check(arrays[name][0] == data.getncattr(name), name)


def tags(file):
    """Numbers of the first directory of a classic little-endian TIFF."""
    raw = file.read_bytes()
    check(raw[:4] == b"II*\0", "TIFF")
    check(b"LAYOUT=IFDS_BEFORE_DATA" in raw[:400], "layout of a cloud-optimised file")
    at = struct.unpack("<I", raw[4:8])[0]
    found = {}
    for k in range(struct.unpack("<H", raw[at:at + 2])[0]):
        tag, kind, count = struct.unpack("<HHI", raw[at + 2 + 12 * k:at + 10 + 12 * k])
        letter, size = {3: ("H", 2), 4: ("I", 4), 12: ("d", 8)}.get(kind, (None, 1))
        if letter is None:
            continue
        begin = at + 10 + 12 * k
        if count * size > 4:
            begin = struct.unpack("<I", raw[begin:begin + 4])[0]
        found[tag] = struct.unpack("<%d%s" % (count, letter), raw[begin:begin + count * size])
    return found


def earth(latitude, longitude, height):
    """Geocentric place on WGS84."""
    f = 1 / 298.257223563
    square = f * (2 - f)
    n = 6378137.0 / numpy.sqrt(1 - square * numpy.sin(latitude) ** 2)
    return numpy.stack([(n + height) * numpy.cos(latitude) * numpy.cos(longitude),
                        (n + height) * numpy.cos(latitude) * numpy.sin(longitude),
                        (n * (1 - square) + height) * numpy.sin(latitude)], axis=-1)


def ground():
    tag = tags(folder / "ground.tif")
    picture = OpenImageIO.ImageInput.open(str(folder / "ground.tif"))
    spec = picture.spec()
    value = picture.read_image("float")
    hours = [i for i, s in enumerate(seconds) if (s - seconds[0]) % 3600 == 0]
    check(spec.nchannels == len(hours), "hours")
    keys = tag[34735]  # of GeoTIFF: (key, where, count, value)
    check(dict(zip(keys[4::4], keys[7::4]))[2048] == 4326, "CRS")
    dx, dy, _ = tag[33550]
    _, _, _, x0, y0, _ = tag[33922]
    lat0, lon0 = (numpy.radians(data.getncattr(n)) for n in ("site_latitude_deg", "site_longitude_deg"))
    origin = earth(lat0, lon0, data.site_height_m)
    east = numpy.array([-numpy.sin(lon0), numpy.cos(lon0), 0])
    up = numpy.array([numpy.cos(lat0) * numpy.cos(lon0), numpy.cos(lat0) * numpy.sin(lon0), numpy.sin(lat0)])
    north = numpy.cross(up, east)
    ground_facets = numpy.flatnonzero(number["object"] < 2)  # itself and the runway
    inside = 0
    for k in numpy.random.default_rng(7).choice(spec.width * spec.height, 1500, replace=False):
        row, column = divmod(int(k), spec.width)
        place = earth(numpy.radians(y0 - dy * (row + 0.5)), numpy.radians(x0 + dx * (column + 0.5)), data.site_height_m + 150.0)
        p = numpy.array([(place - origin) @ east, (place - origin) @ north])
        corners = [q[ground_facets, :2] for q in (a, b, c)]
        depth = numpy.full(len(ground_facets), numpy.inf)
        turn = numpy.sign(numpy.cross(corners[1] - corners[0], corners[2] - corners[0]))
        for m in range(3):
            along = corners[(m + 1) % 3] - corners[m]
            length = numpy.maximum(numpy.linalg.norm(along, axis=1), 1e-9)
            depth = numpy.minimum(depth, turn * numpy.cross(along, p - corners[m]) / length)
        best = int(numpy.argmax(depth))
        if depth[best] < 3.0:  # [m] no facet's, or too near its edge to tell
            continue
        inside += 1
        check((value[row, column] == kelvin[hours, ground_facets[best]]).all(), "post %d, %d" % (row, column))
    check(inside > 300, "posts within facets: %d" % inside)
    finite = numpy.isfinite(value[..., 0])
    check(finite.mean() > 0.99, "posts with a temperature")
    check(value[finite].min() >= kelvin.min() and value[finite].max() <= kelvin.max(), "range")


def mesh():
    """At 15 minutes after the first instant, midway between two."""
    raw = (folder / "mesh.ply").read_bytes()
    head, body = raw.split(b"end_header\n", 1)
    check(("element vertex %d\n" % len(vertex)).encode() in head and ("element face %d\n" % len(corner)).encode() in head, "counts")
    points = numpy.frombuffer(body[:24 * len(vertex)], "<f8").reshape(-1, 3)
    face = numpy.dtype([("n", "u1"), ("corner", "<u4", 3), ("colour", "u1", 3), ("kelvin", "<f4")])
    faces = numpy.frombuffer(body[24 * len(vertex):], face)
    check(len(faces) == len(corner) and (faces["n"] == 3).all(), "faces")
    check((points == vertex).all() and (faces["corner"] == corner).all(), "triangles")
    half = 0.5 * (kelvin[0].astype(numpy.float64) + kelvin[1])
    check(abs(faces["kelvin"] - half).max() < 1e-4, "temperatures")
    light = faces["colour"].astype(float) @ [0.2126, 0.7152, 0.0722]
    check(light[numpy.argmax(half)] > light[numpy.argmin(half)] + 50, "colours")
    order = numpy.argsort(half)
    check((numpy.diff(light[order]) > -6).all(), "warmer is lighter")


def overlay():
    """Beside the GeoTIFF, whose own test is above: its raster is on latitude and longitude, too."""
    archive = zipfile.ZipFile(folder / "overlay.kmz")
    check(archive.testzip() is None and archive.namelist()[0] == "doc.kml", "archive")
    name = "{http://www.opengis.net/kml/2.2}"
    found = xml.fromstring(archive.read("doc.kml")).iter(name + "GroundOverlay")
    overlays = [{e.tag.replace(name, ""): e.text for e in o.iter()} for o in found]
    begins, ends = ([utc(o[k]) for o in overlays] for k in ("begin", "end"))
    check(begins == [s for s in seconds if (s - seconds[0]) % 3600 == 0], "instants")
    check(ends[:-1] == begins[1:] and ends[-1] == begins[-1] + 3600, "spans")
    value = OpenImageIO.ImageInput.open(str(folder / "ground.tif")).read_image("float")
    tag = tags(folder / "ground.tif")
    (dx, dy, _), (_, _, _, x0, y0, _) = tag[33550], tag[33922]
    for i, o in enumerate(overlays):
        with tempfile.NamedTemporaryFile(suffix=".png") as file:
            file.write(archive.read(o["href"]))
            file.flush()
            picture = OpenImageIO.ImageInput.open(file.name).read_image("uint8")
        north, south, east, west = (float(o[k]) for k in ("north", "south", "east", "west"))
        rows, columns = numpy.indices(picture.shape[:2])
        latitude = north - (north - south) * (rows + 0.5) / picture.shape[0]
        longitude = west + (east - west) * (columns + 0.5) / picture.shape[1]
        row, column = numpy.rint((y0 - latitude) / dy - 0.5).astype(int), numpy.rint((longitude - x0) / dx - 0.5).astype(int)
        check(row.min() >= 0 and column.min() >= 0 and row.max() < value.shape[0] and column.max() < value.shape[1], "box")
        shown = value[row, column, i]
        check(numpy.isfinite(value[..., i]).sum() == numpy.isfinite(shown).sum(), "all ground")
        check(((picture[..., 3] == 255) == numpy.isfinite(shown)).all(), "opacity")
        seen = picture[..., 3] > 0
        light = (picture[seen][:, :3].astype(float) @ [0.2126, 0.7152, 0.0722])[numpy.argsort(shown[seen], kind="stable")]
        check((numpy.diff(light) > -6).all() and light[-1] > light[0] + 10, "warmer is lighter")


curves()
meshes()
ground()
mesh()
overlay()
print("as in temperatures.nc")
