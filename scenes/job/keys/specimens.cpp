#include "scenes/job/keys/specimens.hpp"

namespace diurna {

const std::vector<std::string> scene_specimens{R"(
[site]
latitude_deg = 36.32
longitude_deg = -84.2
[time]
start = 2026-07-15T00:00:00Z
end = 2026-07-17T00:00:00Z
[sky]
sun = "ineichen"
precipitable_water_cm = 1.5
aerosol_380nm = 0.2
aerosol_500nm = 0.15
[terrain]
radius_m = 4000.0
[terrain.land_cover.material]
41 = "forest"
[[terrain.rule]]
[[terrain.detail]]
[[ground]]
name = "runway"
rectangle_m = [0.0, 0.0, 1500.0, 45.0, 45.0]
[[ground]]
name = "pond"
ring_m = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]
[[ground]]
name = "field"
ring = [[36.31, -84.21], [36.31, -84.2], [36.32, -84.2]]
place_crs = "EPSG:4326"
[[ground]]
name = "pad"
rectangle = [36.32, -84.2, 30.0, 30.0, 0.0]
[[building]]
[[building]]
place = [36.32, -84.2]
[[object]]
place = [36.32, -84.2]
height_above_sea_m = 900.0
[[object]]
height_above_ellipsoid_m = 900.0
[[object]]
[object.parts]
wheels = "asphalt"
[[object]]
name = "lot"
copies = [[0.0, 0.0, 90.0]]
[[object]]
name = "car"
trajectory = "approach"
[[object.part]]
name = "hood"
[[object.enclosure]]
name = "cab"
[[object.lump]]
name = "engine"
[[object.link]]
between = ["engine", "hood"]
[[object.stream]]
from = "engine"
to = "cab"
[[object.contact]]
between = ["hood", "ground"]
[[object.jet]]
name = "exhaust"
[[shapes]]  # ground
field = "kind"
[shapes.kinds]
road = "asphalt"
[[shapes]]  # buildings
wall = "brick"
[[texture]]
name = "a random field"
[[texture]]
name = "of two materials"
what = "mixture"
[[texture]]
name = "a picture"
what = "emissivity"
file = "pattern.png"
metres_per_texel = 0.5
[[texture]]
name = "another picture"
file = "pattern.png"
metres_per_texel = 0.5
place = [36.32, -84.2]
[material.paint]
like = "painted_steel"
[[plume]]
absorption_per_m = 0.2
place = [36.32, -84.2]
height_above_sea_m = 320.0
[[plume]]
height_above_ellipsoid_m = 290.0
[[plume]]
absorption = "smoke.csv"
[[radiometer]]
name = "mast"
place = [36.32, -84.2]
height_above_sea_m = 320.0
[[radiometer]]
height_above_ellipsoid_m = 290.0
normal = [0, 0, 1]
[[radiometer]]
place_m = [0.0, 0.0]
[[bands]]
response = "camera.csv"
[[bands]]
range_um = [3.7, 4.9]
[[cubes]]
[weather.columns]
tmpc = "air_temperature degC"
[atmosphere]
table = "air.tp7"
sounding = "sonde.txt"
[[observer]]  # stands, looks at a place
look_at_m = [0.0, 0.0]
[[observer]]  # as a map has it
place = [36.32, -84.2]
height_above_sea_m = 900.0
look_at_place = [36.33, -84.2]
[[observer]]
height_above_ellipsoid_m = 900.0
[[observer]]  # flies, behind a lens
focal_length_mm = 50.0
velocity_m_s = [40.0, 0.0, 0.0]
adaptive = {}
[[trajectory]]  # with a speed
name = "approach"
waypoints_m = [[0.0, 0.0, 100.0], [1000.0, 0.0, 100.0]]
speed_m_s = 100.0
start = 2026-07-15T12:00:00Z
[[trajectory]]
times_s = [0.0, 10.0]
[[trajectory]]
waypoints = [[36.32, -84.2, 900.0], [36.33, -84.2, 900.0]]
times_s = [0.0, 10.0]
[[trajectory]]
name = "log"
file = "flight.csv"
[[observer]]
trajectory = "approach"
mount_deg = [0.0, -20.0, 0.0]
frame_every_s = 0.5
[[observer]]
frames_at_sun = { azimuth_deg = 180.0 }
[[observer]]
frames_at_sun = { elevation_deg = 30.0 }
[[observer]]
on = "car"
mount_m = [0.0, 0.0, 3.0]
mount_deg = [0.0, 0.0, 0.0]
[[observer]]
look_at = "runway"
[[observer]]
around = {}
[[observer]]
projection = "equidistant"
[[observer]]
projection = "equisolid"
[[observer]]
projection = "panorama"
[[observer]]
projection = "orthographic"
[[instrument]]
observer = "nobody"
preset = "cooled_mwir"
electronics = { display = "linear" }
optics = { transmission_curve = [[3.0, 0.8], [5.0, 0.9]] }
detector = { efficiency_curve = [[3.0, 0.8], [5.0, 0.9]] }
[[instrument]]
preset = "uncooled_lwir"
electronics = { display = "plateau" }
[[instrument]]
electronics = { display = "manual" }
[[signature]]
range_m = 500.0
[[signature]]
frame_every_s = 3600.0
[[signature]]
frames_at_sun = { azimuth_deg = 180.0 }
[[signature]]
frames_at_sun = { elevation_deg = 30.0 }
[[detection]]
frame_every_s = 3600.0
[[detection]]
frames_at_sun = { azimuth_deg = 180.0 }
[[detection]]
frames_at_sun = { elevation_deg = 30.0 }
[[crossover]]
uncertain = [{ key = "weather.changed.wind_factor", one_sigma = 1.1 }]
[[crossover]]
first_pixels = [0, 0, 1, 1]
second_pixels = [1, 0, 1, 1]
bands = ["8-12"]
[[contrast]]
[[sensitivity]]
uncertain = [{ key = "weather.changed.wind_factor", low = 0.9, high = 1.1 }]
[[sensitivity.output]]
[[sensitivity.output]]
figure = "contrast"
[[sensitivity.output]]
figure = "crossover"
[[uncertain]]
key = "weather.changed.wind_factor"
one_sigma = 1.1
[sweep]
draw = 1
[[sweep.axis]]
key = "observer.east.height_above_ground_m"
[[sweep.axis]]
keys = ["time.start", "weather.file"]
)",
                                               R"(
[time]
start = 2026-07-15T00:00:00Z
frames_at_sun = { azimuth_deg = 180.0 }
[sky]
aerosol_380nm = 0.2
aerosol_500nm = 0.15
precipitable_water_cm = 1.5
)",
                                               R"(
[time]
start = 2026-07-15T00:00:00Z
frames_at_sun = { elevation_deg = 30.0 }
)"};

const std::vector<std::string> column_specimens{R"(
[time]
start = 2026-07-15T00:00:00Z
end = 2026-07-16T00:00:00Z
initial_profile = [[0.0, 290.0]]
[weather.columns]
tmpc = "air_temperature degC"
[sky]
sun = "bird"
precipitable_water_cm = 1.5
aerosol_380nm = 0.2
aerosol_500nm = 0.15
[material]
name = "asphalt"
[calibrate]
measured = "measured.csv"
sought = [{ key = "material.albedo", low = 0.1, high = 0.2 }]
)",
                                                R"(
[sky]
sun = "ineichen"
precipitable_water_cm = 1.5
aerosol_380nm = 0.2
aerosol_500nm = 0.15
[material]
name = "asphalt"
)"};

const std::vector<std::string> material_specimens{R"(
[flat]  # means alone, every layer
heat_roughness_length_m = 0.001
bottom = { kind = "flux" }
convection = { kind = "louis" }
evaporation = { kind = "none" }
canopy = { kind = "none" }
back = { kind = "none" }
finish = { kind = "lambert" }
[[flat.layers]]
conductivity_W_mK = 1.0
freezing_water_kg_m3 = 100.0
[[flat.layers]]
melts = true
[[flat.layers]]
cubic_K3 = 1e-8
[[flat.layers]]
soil = "loam"
[[flat.layers]]
regolith = true

[pane]
reflectance = "glass.csv"
transmittance = "glass_transmittance.csv"
albedo = 0.1
emissivity = 0.9
finish = { kind = "gloss" }
bottom = { kind = "interior", schedule = [[6.0, 290.0]] }
convection = { kind = "mowitt" }
evaporation = { kind = "resistance" }
store = {}
snow_albedo = {}
canopy = { kind = "big_leaf" }
back = { kind = "exposed" }
internal_schedule = [[6.0, 100.0]]
layers = []

[coat]
like = "flat"
roughness_length_m = 0.01
finish = { kind = "gloss", index_file = "paint.csv", effective_index = true }
bottom = { kind = "temperature" }
convection = { kind = "constant" }
canopy = { kind = "two_source" }

[net]
like = "flat"
cover = 0.7
finish = { kind = "metal", index_file = "zinc.csv", effective_index = true }
convection = { kind = "tarp" }

[table]
like = "flat"
convection = { kind = "plate" }
finish = { kind = "by_angle" }

[measured]
like = "flat"
finish = { kind = "measured" }

[pipe]
like = "flat"
convection = { kind = "cylinder" }

[crate]
like = "flat"
convection = { kind = "box" }
)"};

}  // namespace diurna
