"""python3 bench/plan_costs.py DIURNA [--write] : measures what the plan takes work to cost.

Runs small scenes, made here by formula, in each of which one constant of scenes/job/plan/plan_costs.hpp is most of a stage;
prints for each what the stage took (seconds of the processor, one thread) over what `diurna plan` said, and the constant
that would have said it. With --write the constants take those values; build, and measure again until all ratios are near 1
(stages share constants). Several scenes at once, or a busy machine, do not matter: seconds are the processor's.
"""
import math, os, re, shutil, subprocess, sys, tempfile

HEADER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scenes", "job", "plan", "plan_costs.hpp")
# What a run prints of its stages, by the plan's names.
STAGES = {"terrain": "terrain", "sky view": "sky view", "shadows": "heat", "heat balance": "heat", "surface check": "heat",
          "write temperatures": "write",
          "views": "views", "frames": "frames", "labels": "report", "report": "report"}


def kind(stage):
    return "views" if stage.startswith("cast view") else "frames" if stage.startswith("frames of") else STAGES.get(stage, "other")


def place(folder, day, mean_K, swing_K, humidity, rain, rough_m):
    """A raster of 60 x 60 posts of 10 m about 45 N 2 E, and a day of weather."""
    rows = [" ".join(f"{250 + 30 * math.exp(-((x - 300) ** 2 + (y - 450) ** 2) / 1e4) + rough_m * math.sin(12.9898 * x + 78.233 * y):.3f}" for x in range(5, 600, 10))
            for y in range(595, 0, -10)]
    with open(os.path.join(folder, "hill.asc"), "w") as f:
        f.write("ncols 60\nnrows 60\nxllcorner -300\nyllcorner -300\ncellsize 10\nNODATA_value -9999\n" + "\n".join(rows) + "\n")
    with open(os.path.join(folder, "hill.prj"), "w") as f:
        f.write('PROJCS["l",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],'
                'PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",45],PARAMETER["central_meridian",2],PARAMETER["scale_factor",1],'
                'PARAMETER["false_easting",0],PARAMETER["false_northing",0],UNIT["metre",1]]')
    with open(os.path.join(folder, "weather.csv"), "w") as f:
        f.write("time,air_temperature_K,relative_humidity,wind_speed_m_s,cloud_fraction,rain_mm_h\n")
        for half in range(49):
            hour = half / 2
            stamp = f"{day}T{half // 2:02}:{30 * (half % 2):02}:00Z" if half < 48 else f"{day[:-2]}{int(day[-2:]) + 1:02}T00:00:00Z"
            f.write(f"{stamp},{mean_K + swing_K * math.cos((hour - 14) * math.pi / 12):.2f},{humidity},2,0,{rain if 3 <= hour < 6 else 0}\n")


def observer(width=64, height=48, frames='["11:00-13:00 every 2 h"]', bands='["3-5", "8-12"]'):
    return (f'[[observer]]\nname = "o"\nplace_m = [0.0, -80.0]\nheight_above_ground_m = 30.0\nlook_at_m = [0.0, 0.0]\nhorizontal_fov_deg = 40.0\n'
            f'width = {width}\nheight = {height}\nbands = {bands}\nframes = {frames}\n')


TRUCK = '[[object]]\nname = "truck"\nmodel = "truck"\ndetail = "low"\nplace_m = [0.0, 0.0]\nheading_deg = 30.0\n'
HOUSE = '[[building]]\nname = "hall"\nplace_m = [-20.0, 15.0]\nwidth_m = 30.0\ndepth_m = 20.0\nheight_m = 8.0\nwall = "concrete_wall"\nroof = "painted_steel"\n'
POND = '[[ground]]\nname = "pond"\nmaterial = "water"\nrectangle_m = [10.0, 10.0, 30.0, 20.0, 0.0]\nlargest_edge_m = 5.0\n'
YARD = '[[ground]]\nname = "yard"\nmaterial = "concrete"\nrectangle_m = [0.0, 0.0, 80.0, 80.0, 0.0]\nlargest_edge_m = 4.0\n'
SUMMER, WINTER, RAIN = ("2026-07-10", 293, 6, .5, 0, 0.), ("2026-01-10", 272, 4, .8, 0, 0.), ("2026-07-10", 285, 3, .9, 2, 0.)
ROUGH = (*SUMMER[:5], .8)
# (constant, stage, what the scene has, its day, step [s], ground)
PROBES = [
    ("start", "terrain", observer(), SUMMER, 1800, "grass"),
    ("sky_per_facet", "sky view", "tolerance" + observer(), ROUGH, 3600, "dry_grass"),
    ("sky_per_ray", "sky view", TRUCK + observer(), SUMMER, 1800, "grass"),
    ("ground_ray", "sky view", "[scene]\nsky_rays = 1024\n" + HOUSE + YARD + observer(), SUMMER, 1800, "grass"),
    ("wall_ray", "sky view", "[scene]\nobject_sky_rays = 4096\n" + HOUSE + observer(), SUMMER, 1800, "grass"),
    ("patch_ray", "heat", "[scene]\ncheck_points = 4096\n" + YARD + observer(), SUMMER, 1800, "grass"),
    ("heat_per_step", "heat", YARD + observer(), SUMMER, 300, "grass"),
    ("heat_per_coupled_step", "heat", HOUSE + observer(), SUMMER, 600, "grass"),
    ("network_day", "heat", TRUCK + observer(), SUMMER, 1800, "grass"),
    ("network_step", "heat", TRUCK + observer(), SUMMER, 100, "grass"),
    ("lane", "heat", YARD + observer(), RAIN, 1800, "grass"),
    ("freezing_lane", "heat", HOUSE + observer(), WINTER, 1800, "semi_desert"),
    ("cast_per_ray", "views", observer(1280, 1024), SUMMER, 1800, "grass"),
    ("render_per_pixel", "frames", observer(1280, 1024), SUMMER, 1800, "grass"),
    ("air_per_band", "frames", observer(32, 24, '["08:00-17:00 every 1 h"]'), SUMMER, 1800, "grass"),
    ("secondary_per_ray", "views", POND + observer(320, 256), SUMMER, 1800, "grass"),
    ("secondary_per_hit", "frames", POND + observer(320, 256), SUMMER, 1800, "grass"),
    ("annotate_per_pixel", "report", observer(1280, 1024), SUMMER, 1800, "grass"),
]


def scene(parts, day, step, ground):
    fine = "tolerance_m = 0.3\n" if parts.startswith("tolerance") else ""
    return (f'[site]\nlatitude_deg = 45.0\nlongitude_deg = 2.0\n[terrain]\nelevation = "hill.asc"\nmaterial = "{ground}"\n{fine}{parts.removeprefix("tolerance")}'
            f'[weather]\nfile = "weather.csv"\ninterval = "instant"\n[time]\nstart = {day}T00:00:00Z\nduration_h = 24.0\nstep_s = {step}\n')


def planned(program, folder):
    """{stage: s} and bytes."""
    text = subprocess.run([program, "plan", "scene.toml", "--threads", "1"], cwd=folder, check=True, capture_output=True, text=True).stdout
    stages = {}
    for name, seconds in re.findall(r"^  ([a-z][a-z ]*?) +([\d.]+) s\b", text, re.M):
        stages[kind(name)] = stages.get(kind(name), 0) + float(seconds)
    return stages, float(re.search(r"^memory\s+([\d.]+) MB", text, re.M).group(1))


def taken(program, folder):
    """The same of a run: the processor's clock is read as each stage ends."""
    run = subprocess.Popen([program, "run", "scene.toml", "--out", "out", "--threads", "1", "--set", "rounds=0"], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                           env={**os.environ, "DIURNA_STAGES": "off"})
    tick, stages, before = os.sysconf("SC_CLK_TCK"), {}, 0.0
    for line in run.stderr:
        ended = re.match(r"^([a-z][\w ]*?)\s+[\d.]+ s$", line.rstrip())
        if not ended:
            continue
        fields = open(f"/proc/{run.pid}/stat").read().rsplit(")", 1)[1].split()
        now = (int(fields[11]) + int(fields[12])) / tick
        stages[kind(ended.group(1))] = stages.get(kind(ended.group(1)), 0) + now - before
        before = now
    used = os.wait4(run.pid, 0)[2]
    return stages, used.ru_maxrss * 1.024e-3


if __name__ == "__main__":
    program, header = os.path.abspath(sys.argv[1]), open(HEADER).read()
    print("constant,stage,took_s,planned_s,ratio,memory_ratio,value,new")
    for constant, stage, parts, weather, step, ground in PROBES:
        with tempfile.TemporaryDirectory() as folder:
            place(folder, *weather)
            with open(os.path.join(folder, "scene.toml"), "w") as f:
                f.write(scene(parts, weather[0], step, ground))
            said, memory = planned(program, folder)
            took, peak = taken(program, folder)
        value = float(re.search(rf"double {constant} = ([\d.e-]+);", header).group(1))
        ratio = took.get(stage, 0) / max(said.get(stage, 0), .05)
        print(f"{constant},{stage},{took.get(stage, 0):.2f},{said.get(stage, 0):.2f},{ratio:.2f},{peak / memory:.2f},{value:g},{value * ratio:.2g}", flush=True)
        if "--write" in sys.argv:
            header = re.sub(rf"(double {constant} = )[\d.e-]+;", rf"\g<1>{value * ratio:.2g};", header)
    if "--write" in sys.argv:
        open(HEADER, "w").write(header)
