#!/usr/bin/env python3
"""Run time against error of pictures: bench/pareto.py DIURNA [--scenes a,b] [--tolerances 2,0.1] [--out FILE.csv] [--check FILE.csv]

For each scene and `tolerance_K`: processor seconds (user and system, one thread), peak memory, the error that the run itself
measured (`diurna audit`, 1000 places, with its 95 % interval, and with the error of samples that its notes give) and the true one: the difference of apparent
temperature in 8-12 um to a reference run, over pixels that show the same object and material in both. The reference has edges,
mesh tolerance and steps half as large, 4 times the samples in pixels and the rays to the sky, 16 rays to the sun's disc, and
other random numbers; what is left of its own error is about a quarter of the default's. Below 0.1 K rounds (docs/reference/
faster-runs.md) make a run as fine as the reference or finer: compare such runs with one of a larger scene.finer_edges. Seconds are also given as a ratio to a loop that this script times beside each run
(`calibration_s`: roots and exponentials), so that another machine can be compared: --check runs the scenes of a
committed file again and fails where the ratio grew by more than 25 %, or the true error by more than 10 %.

Scenes: the samples `jacksboro` (the default), `approach` and `crossover`, and two made here by formula: `desert` (dunes of sand,
rock, a truck) and `city` (blocks of brick and concrete houses with streets of asphalt).
"""
import argparse, csv, math, os, pathlib, re, shutil, subprocess, sys, tempfile, time

import numpy as np
import OpenImageIO as oiio

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOLERANCES = [2, 1, 0.5, 0.2, 0.1]
FIELDS = ["scene", "tolerance_K", "processor_s", "calibration_s", "ratio", "peak_MB", "facets", "reported_rms_K", "reported_low_K",
          "reported_high_K", "true_rms_K", "true_99_K", "pixels"]
# Pictures that are rendered and compared: those in which `audit` draws its places; of the crossover's instants three.
SAMPLES = {
    "jacksboro": ["--only", "band=8-12"],
    "approach": ["--only", "band=8-12"],
    "crossover": ["--only", "band=8-12", "--only", "frames=08:00..08:00", "--only", "frames=14:00..14:00", "--only", "frames=23:00..23:00"],
}
# Settings of the reference beyond half the edges: where it is affordable, a quarter.
FINER = {name: ["--set", "scene.finer_edges=2"] for name in ("crossover", "desert", "city")}
MADE = '''[site]
latitude_deg = {latitude}
longitude_deg = 10.0
[terrain]
elevation = "ground.asc"
tolerance_m = 0.5
material = "{ground}"
{parts}
[weather]
file = "weather.csv"
[time]
start = 2026-07-10T00:00:00Z
[[observer]]
name = "o"
place_m = [-60.0, -150.0]
height_above_ground_m = 60.0
look_at_m = [0.0, 0.0]
horizontal_fov_deg = 40.0
width = 320
height = 256
bands = ["8-12"]
frames = ["2026-07-10T08:00:00Z", "2026-07-10T14:00:00Z", "2026-07-10T23:00:00Z"]
'''


def made_scene(name, folder, posts=121):
    """A scene by formula: raster of so many posts of 5 m each way, weather, TOML."""
    n, cell = posts, 5.0
    x = (np.arange(n) - (n - 1) / 2) * cell
    east, north = np.meshgrid(x, -x)
    if name == "desert":
        height = 300 + 6 * np.sin(east / 35 + 0.4 * np.sin(north / 60)) + 0.01 * north
        latitude, ground, mean, swing, humidity = 24.0, "sand", 305, 10, 0.15
        parts = ('[[ground]]\nname = "dunes"\nmaterial = "sand"\nrectangle_m = [0.0, 0.0, 400.0, 400.0, 0.0]\nlargest_edge_m = 10.0\n'
                 '[[ground]]\nname = "ledge"\nmaterial = "rock"\nrectangle_m = [60.0, 60.0, 120.0, 40.0, 20.0]\nlargest_edge_m = 6.0\n'
                 '[[object]]\nname = "truck"\nmodel = "truck"\nplace_m = [0.0, 0.0]\nheading_deg = 30.0\n')
    else:
        height = np.full((n, n), 100.0)
        latitude, ground, mean, swing, humidity = 48.0, "asphalt", 294, 6, 0.5
        parts = '[[ground]]\nname = "streets"\nmaterial = "asphalt"\nrectangle_m = [0.0, 0.0, 160.0, 120.0, 0.0]\nlargest_edge_m = 3.0\n' + "".join(
                        f'[[building]]\nname = "house {i} {j}"\nplace_m = [{40.0 * i:.1f}, {30.0 * j:.1f}]\nwidth_m = 26.0\ndepth_m = 12.0\nheight_m = '
                        f'{8.0 + 3 * ((i + 2 * j) % 3):.1f}\nwall = "{("brick", "concrete")[(i + j) % 2]}"\nroof = "{("concrete", "clay_tile")[i % 2]}"\n'
                        for i in range(-1, 2) for j in range(-1, 2))
    rows = "\n".join(" ".join(f"{v:.3f}" for v in row) for row in height)
    corner = x[0] - cell / 2
    (folder / "ground.asc").write_text(f"ncols {n}\nnrows {n}\nxllcorner {corner}\nyllcorner {corner}\ncellsize {cell}\nNODATA_value -9999\n{rows}\n")
    (folder / "ground.prj").write_text(
        'PROJCS["l",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",'
        f'0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",{latitude}],PARAMETER["central_meridian",10],'
        'PARAMETER["scale_factor",1],PARAMETER["false_easting",0],PARAMETER["false_northing",0],UNIT["metre",1]]')
    lines = ["time,air_temperature_K,relative_humidity,wind_speed_m_s,cloud_fraction"]
    for half in range(49):
        stamp = f"2026-07-10T{half // 2:02}:{30 * (half % 2):02}:00Z" if half < 48 else "2026-07-11T00:00:00Z"
        lines.append(f"{stamp},{mean + swing * math.cos((half / 2 - 15) * math.pi / 12):.3f},{humidity},2.5,0.1")
    (folder / "weather.csv").write_text("\n".join(lines) + "\n")
    (folder / "scene.toml").write_text(MADE.format(latitude=latitude, ground=ground, parts=parts))


def finer(text, factor):
    """The scene with every edge, every mesh tolerance and the step divided, and more samples in pixels."""
    text = re.sub(r"(?m)^((?:largest_edge_m|ground_edge_m|tolerance_m|step_s) *= *)([\d.]+)", lambda m: f"{m[1]}{float(m[2]) / factor:.6g}", text)
    text = re.sub(r"(?m)^samples *= *(\d+)", lambda m: f"samples = {int(m[1]) * factor ** 2}", text)
    tables = re.split(r"(?m)^(?=\[)", text)
    for i, table in enumerate(tables):
        if table.startswith("[[object]]") and "largest_edge_m" not in table:
            tables[i] = table.rstrip("\n") + ('\ndetail = "high"\n' if "model =" in table and "detail" not in table else f"\nlargest_edge_m = {0.5 / factor}\n") + "\n"
        if table.startswith("[[observer]]") and not re.search(r"(?m)^samples *=", table):
            tables[i] = table.rstrip("\n") + f"\nsamples = {16 * factor ** 2}\n\n"
        if table.startswith("[time]") and "step_s" not in table:
            tables[i] = table.rstrip("\n") + f"\nstep_s = {600 / factor}\n\n"
    return "".join(tables)


def calibration():
    """Processor seconds of a fixed piece of arithmetic, on one thread and without a library of matrices, which machines differ in."""
    a = np.linspace(0, 1, 8000)  # in the cache, as the time of fresh memory varies
    begin = time.process_time()
    for _ in range(10000):
        a = np.sqrt(np.exp(-a * a) + 0.1 * a)
    return time.process_time() - begin


def cost(command):
    """(output, processor seconds, peak MB) of a command, which must end with 0. By a process of its own, as a child of this one
    would begin with the memory of this one."""
    with tempfile.NamedTemporaryFile("r") as used:
        done = subprocess.run(["/usr/bin/time", "-f", "%U %S %M", "-o", used.name, *command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              env={**os.environ, "DIURNA_STAGES": "off"})
        if done.returncode:
            sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n{done.stdout[-2000:]}")
        user, system, peak = map(float, used.read().split())
    return done.stdout, user + system, peak / 1024


def pictures(out):
    """Planes of each picture of 8-12 um: {name: (apparent temperature, object, material)}."""
    found = {}
    for path in sorted((out / "frames").glob("*8-12*.exr")):
        image = oiio.ImageInput.open(str(path))
        names = image.spec().channelnames
        planes = np.asarray(image.read_image(0, 0, 0, len(names), "float"))
        found[path.name] = [planes[..., names.index(n)] for n in ("apparent_temperature.8-12", "object", "material")]
    return found


def difference(out, reference):
    """rms, 99th percentile [K] and count over pixels that show the same object and material in both runs."""
    mine, other = pictures(out), pictures(reference)
    if not mine or mine.keys() != other.keys():
        sys.exit(f"{out}: not the pictures of the reference")
    d = np.concatenate([(a[0] - b[0])[(a[1] == b[1]) & (a[2] == b[2])] for a, b in ((mine[n], other[n]) for n in mine)])
    d = d[np.isfinite(d)]
    return math.sqrt(np.mean(d ** 2)), np.percentile(np.abs(d), 99), d.size


def rows_of(program, name, tolerances, work):
    folder, select = work / name, SAMPLES.get(name, [])
    if name in SAMPLES:
        for sample in {name, "jacksboro"}:  # whose elevation and weather the others take
            shutil.copytree(ROOT / "scenes" / sample, work / sample, dirs_exist_ok=True)
    else:
        folder.mkdir()
        made_scene(name, folder)
    (folder / "finer.toml").write_text(finer((folder / "scene.toml").read_text(), 2))
    reference = work / f"{name}_reference"
    cost([program, "run", folder / "finer.toml", "--allow-outside", "--out", reference, "--progress", "none", *select, "--set", "tolerance_K=0.01", "--set", "scene.sky_rays=256",
          "--set", "scene.object_sky_rays=1024", "--set", "scene.sun_samples=16", "--set", "scene.seed=7", "--set", "scene.check_points=0", "--set", "rounds=0", *FINER.get(name, [])])
    for tolerance in tolerances:
        out, loop = work / f"{name}_{tolerance}", calibration()
        said, seconds, peak = cost([program, "run", folder / "scene.toml", "--allow-outside", "--out", out, "--threads", "1", *select, "--set", f"tolerance_K={tolerance}"])
        loop = min(loop, calibration())
        told, _, _ = cost([program, "audit", out, "--allow-outside", "--checks", "1000"])
        rms = re.search(r"rms difference +([\d.e-]+) K +95 % interval ([\d.e-]+) to ([\d.e-]+)", told)
        samples = max((float(k) for k in re.findall(r"note: samples: pictures of \S+ differ by ([\d.e-]+) K rms", said)), default=0.0)
        reported = [f"{math.hypot(float(k), samples):.3f}" for k in rms.groups()] if rms else [""] * 3
        true, worst, pixels = difference(out, reference)
        yield dict(zip(FIELDS, [name, tolerance, f"{seconds:.2f}", f"{loop:.3f}", f"{seconds / loop:.2f}", f"{peak:.0f}", re.search(r"(?m)^(\d+) facets,", said)[1],
                                *reported, f"{true:.4f}", f"{worst:.3f}", pixels]))
        shutil.rmtree(out)


def main():
    ask = argparse.ArgumentParser(description="run time against error of pictures")
    ask.add_argument("program")
    ask.add_argument("--scenes", default="jacksboro,approach,crossover,desert,city")
    ask.add_argument("--tolerances", default=",".join(map(str, TOLERANCES)))
    ask.add_argument("--out")
    ask.add_argument("--check")
    asked = ask.parse_args()
    program = pathlib.Path(asked.program).resolve()
    before = {(r["scene"], float(r["tolerance_K"])): r for r in csv.DictReader(open(asked.check))} if asked.check else {}
    sink = open(asked.out, "w", newline="") if asked.out else sys.stdout
    table, failed = csv.DictWriter(sink, FIELDS), False
    table.writeheader()
    with tempfile.TemporaryDirectory() as work:
        for name in asked.scenes.split(","):
            for row in rows_of(program, name, [float(t) for t in asked.tolerances.split(",")], pathlib.Path(work)):
                table.writerow(row)
                sink.flush()
                old = before.get((name, float(row["tolerance_K"])))
                if old and float(row["ratio"]) > 1.25 * float(old["ratio"]):
                    failed = True
                    print(f"{name}, {row['tolerance_K']} K: {row['ratio']} times the calibration loop, {old['ratio']} before: over 25 % more", file=sys.stderr)
                if old and float(row["true_rms_K"]) > 1.1 * float(old["true_rms_K"]):
                    failed = True
                    print(f"{name}, {row['tolerance_K']} K: error {row['true_rms_K']} K, {old['true_rms_K']} before", file=sys.stderr)
    sys.exit(failed)


if __name__ == "__main__":
    main()
