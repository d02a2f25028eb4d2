"""A scene of a measured courtyard, from the rasters of its site.

Reads a folder as those of the six-directional stations in Gothenburg (Lindberg & others 2008): DSM, DEM
(metres above the sea), CDSM (canopy above the ground), land cover (UMEP's classes), hourly weather and the
station's point. Writes a folder that `diurna run` takes. No measurement of the station is opened here.
"""

import datetime
import json
import math
import pathlib

import numpy as np
from osgeo import gdal, ogr, osr

gdal.UseExceptions()

REACH = 110.0  # [m] round the station that is modelled
NEAR = 35.0  # [m] where roofs and ground are finer
PAVED, BUILDING, GRASS, SOIL, WATER = 1, 2, 5, 6, 7


def one_file(site, *patterns):
    """The file of a site that matches, whatever its capitals."""
    for pattern in patterns:
        found = sorted(p for p in site.iterdir() if p.match(pattern) or p.match(pattern.lower()))
        if found:
            return found[0]
    raise SystemExit(f"{site}: no file like {' or '.join(patterns)}")


class Raster:
    def __init__(self, file):
        self.file = file
        data = gdal.Open(str(file))
        self.value = data.ReadAsArray().astype(float)
        self.west, self.cell, _, self.north, _, _ = data.GetGeoTransform()
        self.projection = data.GetProjection()

    def pixel(self, east, north):
        return int((self.north - north) / self.cell), int((east - self.west) / self.cell)

    def places(self):
        """East and north of every pixel's middle."""
        rows, columns = np.indices(self.value.shape)
        return (self.west + (columns + 0.5) * self.cell, self.north - (rows + 0.5) * self.cell)


def smoothed(height, mask):
    """Median of the pixels of `mask` among each one's nine."""
    padded = np.pad(np.where(mask, height, np.nan), 1, constant_values=np.nan)
    shifted = [padded[i : i + height.shape[0], j : j + height.shape[1]] for i in range(3) for j in range(3)]
    median = np.full(height.shape, np.nan)
    median[mask] = np.nanmedian(np.stack(shifted)[:, mask], axis=0)
    return median


def memory_band(like, values):
    data = gdal.GetDriverByName("MEM").Create("", values.shape[1], values.shape[0], 1, gdal.GDT_Int32)
    data.SetGeoTransform((like.west, like.cell, 0, like.north, 0, -like.cell))
    data.GetRasterBand(1).WriteArray(values.astype(np.int32))
    return data


def write_buildings(dsm, dem, cover, station, crs, file):
    """Roofs as terraces: 2 m high near the station, 4 m further away. Returns how many polygons."""
    height = dsm.value - dem.value
    east, north = dsm.places()
    away = np.hypot(east - station[0], north - station[1])
    mask = (cover.value == BUILDING) & (height > 2.0) & (away < REACH)
    roof = smoothed(height, mask)
    step = np.where(away < NEAR, 2.0, 4.0)
    bands = np.where(mask, 1 + np.nan_to_num(roof) // step + np.where(away < NEAR, 0, 1000), 0)
    data = memory_band(dsm, bands)
    band = data.GetRasterBand(1)
    few = max(2, int(6.0 / dsm.cell**2))
    gdal.SieveFilter(band, None, band, few, 4)
    drawn = ogr.GetDriverByName("Memory").CreateDataSource("")
    layer = drawn.CreateLayer("drawn", crs)
    layer.CreateField(ogr.FieldDefn("band", ogr.OFTInteger))
    gdal.Polygonize(band, None, layer, 0, [], None)
    bands = band.ReadAsArray()
    out = ogr.GetDriverByName("GPKG").CreateDataSource(str(file))
    written = out.CreateLayer("buildings", crs, ogr.wkbPolygon)
    written.CreateField(ogr.FieldDefn("height", ogr.OFTReal))
    count = 0
    for feature in layer:
        if feature.GetField("band") == 0:
            continue
        shape = feature.GetGeometryRef()
        single = ogr.GetDriverByName("Memory").CreateDataSource("")
        one = single.CreateLayer("one", crs)
        one.CreateFeature(feature.Clone())
        inside = memory_band(dsm, np.zeros(bands.shape))
        gdal.RasterizeLayer(inside, [1], one, burn_values=[1])
        own = (inside.GetRasterBand(1).ReadAsArray() == 1) & mask
        if not own.any():
            continue
        shape = shape.SimplifyPreserveTopology(0.8 * dsm.cell)
        if shape.GetArea() < few * dsm.cell**2 or shape.GetGeometryType() != ogr.wkbPolygon:
            continue
        made = ogr.Feature(written.GetLayerDefn())
        made.SetGeometry(shape)
        made.SetField("height", float(np.mean(height[own])))
        written.CreateFeature(made)
        count += 1
    out = None
    return count


def crowns(canopy, dem, station):
    """East, north, ground, height and radius [m] of trees: the highest pixels first, each with what is near."""
    east, north = canopy.places()
    left = np.where(np.hypot(east - station[0], north - station[1]) < REACH, canopy.value, 0.0)
    trees = []
    while left.max() > 2.5:
        at = np.unravel_index(np.argmax(left), left.shape)
        height = left[at]
        reach = float(np.clip(0.25 * height, 1.5, 4.5))
        near = np.hypot(east - east[at], north - north[at]) <= reach
        own = near & (left > 1.0)
        covered = own.sum() * canopy.cell**2
        left[near] = 0.0
        if covered < 4.0:
            continue
        radius = math.sqrt(covered / math.pi)
        trees.append((east[own].mean(), north[own].mean(), float(dem.value[at]), float(height), radius))
    return trees


def sphere():
    """Corners and triangles of an icosahedron with the volume of the unit sphere."""
    g = (1 + 5**0.5) / 2
    corner = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
              (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    volume = 2.53615  # of one whose corners are at unit distance; 4/3 pi of the sphere
    size = (4.18879 / volume) ** (1 / 3)
    corner = [size * np.array(c) / np.linalg.norm(c) for c in corner]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
             (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11),
             (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    return np.array(corner), faces


def write_crowns(trees, file):
    """An OBJ of ellipsoids from a quarter of each tree's height up. Returns the middle of its plan and its foot."""
    corner, faces = sphere()
    all_corners, lines, first = [], [], 1
    for east, north, ground, height, radius in trees:
        middle = np.array([east, north, ground + 0.625 * height])
        all_corners.append(middle + corner * [radius, radius, 0.375 * height])
        lines += [f"f {a + first} {b + first} {c + first}" for a, b, c in faces]
        first += len(corner)
    points = np.vstack(all_corners)
    low, high = points.min(axis=0), points.max(axis=0)
    origin = np.array([*(low[:2] + high[:2]) / 2, low[2]])
    text = [f"v {x:.3f} {y:.3f} {z:.3f}" for x, y, z in points - origin]
    file.write_text("\n".join(text + lines) + "\n")
    return origin


def read_weather(site):
    """Rows of the site's weather: (year, day of the year, hour, values by name)."""
    file = one_file(site, "MetFile*.txt", "*met*.txt", "*Met*.txt")
    lines = file.read_text().splitlines()
    names = lines[0].lstrip("% ").split()
    rows = [dict(zip(names, map(float, line.split()))) for line in lines[1:] if line.strip()]
    return [{k.lower(): v for k, v in row.items()} for row in rows]


def date_of(row):
    year = int(row.get("iy", row.get("%iy", 0)))
    return datetime.date(year, 1, 1) + datetime.timedelta(days=int(row["id"]) - 1)


def write_weather(rows, file):
    """Row h is the mean of h to h + 1 on UTC+1 (the sum of its beam and diffuse light closes only so)."""
    offset = {"td": 273.15}  # air temperature, degC

    def cell(row, key):
        if row[key] <= -900:
            return ""
        return f"{row[key] + offset.get(key, 0.0):g}" if key != "rh" else f"{row[key] / 100.0:g}"

    text = ["time,air_temperature_K,relative_humidity,wind_speed_m_s,"
            "shortwave_down_W_m2,diffuse_W_m2,direct_normal_W_m2"]
    for row in rows:
        stamp = f"{date_of(row).isoformat()}T{int(row['it']):02d}:00:00+01:00"
        text.append(",".join([stamp] + [cell(row, k) for k in ("td", "rh", "wind", "kdn", "kdiff", "kdir")]))
    file.write_text("\n".join(text) + "\n")


SCENE = """# Made from the rasters of {site} by bench/courtyard; nothing here was fitted to measurements of the station.
[scene]
name = "{name}_{day}"
sky_rays = 128
object_sky_rays = 128
sun_samples = 8
[site]
place_crs = "{crs}"
[terrain]
elevation = "ground.tif"
material = "cobble"
tolerance_m = 0.3
# Albedo and emissivity as SOLWEIG has them for these sites (walls 0.20, 0.90; paving 0.20, 0.95; grass 0.16, 0.94;
# soil 0.25, 0.94; Lindberg & Grimmond 2011), heat columns of the program's library.
[material.cobble]
like = "concrete"
albedo = 0.20
emissivity = 0.95
[material.lawn]
like = "grass"
albedo = 0.16
emissivity = 0.94
[material.soil]
like = "bare_soil"
albedo = 0.25
emissivity = 0.94
[material.wall]
like = "brick"
albedo = 0.20
emissivity = 0.90
[material.roof]
like = "clay_tile"
albedo = 0.18
emissivity = 0.95
# A crown lets {through} of the sun through (UMEP: 0.03 in leaf, 0.5 without), over the two faces that a ray meets.
[material.crown]
like = "camouflage_net"
cover = {cover:.4f}
[[terrain.land_cover]]
file = "cover.tif"
material = {{ 1 = "cobble", 2 = "cobble", 5 = "lawn", 6 = "soil", 7 = "water" }}
[[ground]]
name = "around"
rectangle = [{east}, {north}, 120.0, 120.0, 0.0]
largest_edge_m = 8.0
[[ground]]
name = "courtyard"
rectangle = [{east}, {north}, 60.0, 60.0, 0.0]
largest_edge_m = 2.0
[[shapes]]
file = "buildings.gpkg"
name = "buildings"
wall = "wall"
roof = "roof"
height_field = "height"
largest_edge_m = 4.0
{trees}[weather]
file = "weather.csv"
interval = "start"
wind_height_m = 10.0
on_gap = "interpolate"
[time]
start = {day}T00:00:00+01:00
step_s = 600.0
spin_up = "periodic"
[[radiometer]]
name = "station"
place = [{east}, {north}]
height_above_ground_m = 1.1
"""

TREES = """[[object]]
name = "crowns"
mesh = "crowns.obj"
up = "z"
stands = "upright"
place = [{0:.3f}, {1:.3f}]
height_above_sea_m = {2:.3f}
material = "crown"
largest_edge_m = 100.0
ground_edge_m = 10.0
"""


def write_scenes(site, out):
    """A folder with one scene for each day of the site's weather. Returns their files."""
    dem = Raster(one_file(site, "DEM*.tif", "DEM*.asc"))
    dsm = Raster(one_file(site, "DSM*.tif", "DSM*.asc"))
    cover = Raster(one_file(site, "landcover*.tif", "*landcover*.tif", "LC*.tif", "landcover*.asc"))
    canopy = Raster(one_file(site, "CDSM*.asc", "CDSM*.tif"))
    canopy.value = np.where(canopy.value < 0, 0.0, canopy.value)
    point = json.loads(one_file(site, "poi*.geojson").read_text())
    point = point["features"][0] if "features" in point else point
    station = point["geometry"]["coordinates"][:2]
    crs = osr.SpatialReference()
    crs.ImportFromEPSG(int(point["properties"].get("crs", "EPSG:3007").split(":")[1]))
    out.mkdir(parents=True, exist_ok=True)
    for name, raster in (("ground.tif", dem), ("cover.tif", cover)):
        gdal.Translate(str(out / name), str(raster.file), outputSRS=crs.ExportToWkt())
    (out / "buildings.gpkg").unlink(missing_ok=True)
    count = write_buildings(dsm, dem, cover, station, crs, out / "buildings.gpkg")
    trees = crowns(canopy, dem, station)
    print(f"{site.name}: {count} roof terraces, {len(trees)} crowns within {REACH:.0f} m of the station")
    text = TREES.format(*write_crowns(trees, out / "crowns.obj")) if trees else ""
    rows = read_weather(site)
    scenes = []
    for day in sorted({date_of(row) for row in rows}):
        folder = out / day.isoformat()
        folder.mkdir(exist_ok=True)
        in_leaf = 97 < day.timetuple().tm_yday < 300
        through = 0.03 if in_leaf else 0.5
        write_weather([row for row in rows if date_of(row) == day], folder / "weather.csv")
        for name in ("ground.tif", "cover.tif", "buildings.gpkg") + (("crowns.obj",) if trees else ()):
            (folder / name).unlink(missing_ok=True)
            (folder / name).hardlink_to(out / name)
        file = folder / "scene.toml"
        file.write_text(SCENE.format(site=site.name, name=site.name, day=day.isoformat(), crs=f"EPSG:{crs.GetAuthorityCode(None)}",
                                     through=through, cover=1.0 - math.sqrt(through), east=station[0],
                                     north=station[1], trees=text))
        scenes.append(file)
    return scenes
