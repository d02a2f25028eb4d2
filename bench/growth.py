#!/usr/bin/env python3
"""How time and memory of a run grow: bench/growth.py DIURNA [--facets 1e4,1e5,1e6] [--instants ...] [--observers ...] [--out FILE.csv]

The dunes of bench/pareto.py (sand and rock on relief of 5 m posts; without the truck), one thread, processor seconds and peak memory of
- facets: every facet solved (`tolerance_K = 0`), one small picture, edges from coarse to fine (1.1 m), then more ground;
- scene: the same at default settings, which solve what the picture needs;
- instants: `run` with one observer and 1 to 288 pictures;
- observers: `run` with 1 to 16 observers and four pictures each.
For each row the exponent of time against the number, from the row before: 1 is proportional. What does not depend on the number
(start of the program, terrain) makes exponents of small scenes lower. Fails (exit 1) if an exponent exceeds 1.1.
"""
import argparse, csv, math, pathlib, re, shutil, sys, tempfile

from pareto import cost, made_scene

FIELDS = ["grows", "number", "facets", "processor_s", "peak_MB", "exponent"]
HIGHEST = 1.1
LEAST_EDGE = 1.11  # [m]


def scene_of(folder, edge=10.0, observers=1, instants=4, side=400.0):
    """The dunes with a square of ground of this edge, seen by so many observers at so many instants."""
    text = (folder / "scene.toml").read_text()
    text = text.replace("[0.0, 0.0, 400.0, 400.0, 0.0]\nlargest_edge_m = 10.0", f"[0.0, 0.0, {side:.1f}, {side:.1f}, 0.0]\nlargest_edge_m = {edge:.4g}")
    head, eye = text.split("[[observer]]")
    eye = re.sub(r"width = \d+\nheight = \d+", "width = 160\nheight = 128", eye)
    times = ", ".join(f'"2026-07-10T{i * 1440 // instants // 60:02}:{i * 1440 // instants % 60:02}:00Z"' for i in range(instants))
    eye = re.sub(r"frames = \[.*\]", f"frames = [{times}]", eye)
    for o in range(observers):
        turn = 2 * math.pi * o / observers
        place = f"place_m = [{-160 * math.sin(turn):.1f}, {-160 * math.cos(turn):.1f}]"
        head += "[[observer]]" + re.sub(r"place_m = \[.*\]", place, eye.replace('name = "o"', f'name = "o{o}"'))
    head = re.sub(r"\[\[object\]\]\n(?:.+\n)+", "", head)
    file = folder / f"{edge:.4g}_{observers}_{instants}.toml"
    file.write_text(head)
    return file


def facets_of(said):
    return int(re.search(r"(?m)^(\d+) facets,", said)[1])


def rows_of(program, folder, facets, scene, instants, observers):
    alone = ["--threads", "1", "--progress", "none", "--set", "scene.check_points=0"]
    for kind, wanted in [*(("facets", n) for n in facets), *(("scene", n) for n in scene)]:
        # Smaller edges up to a number, then more ground.
        edge = max(LEAST_EDGE, 400 * math.sqrt(4 / math.sqrt(3) / wanted))
        side = max(400.0, edge * math.sqrt(wanted * math.sqrt(3) / 4))
        wide = folder / f"{side:.0f}"
        wide.mkdir(exist_ok=True)
        made_scene("desert", wide, int(side / 4) | 1)
        said, seconds, peak = cost([program, "run", scene_of(wide, edge, instants=1, side=side), "--out", wide / "facets", *(["--set", "tolerance_K=0"] if kind == "facets" else []), *alone])
        shutil.rmtree(wide)
        yield kind, facets_of(said), said, seconds, peak
    for kind, numbers in (("instants", instants), ("observers", observers)):
        for number in numbers:
            file = scene_of(folder, **{kind: number})
            said, seconds, peak = cost([program, "run", file, "--out", folder / f"{kind}{number}", *alone])
            yield kind, number, said, seconds, peak


def numbers(text):
    return [int(float(part)) for part in text.split(",")] if text else []


def main():
    ask = argparse.ArgumentParser(description="how time and memory of a run grow")
    ask.add_argument("program")
    ask.add_argument("--facets", default="1e4,3e4,1e5,3e5,1e6")
    ask.add_argument("--scene", default="3e4,3e5,1e6,6.4e6")
    ask.add_argument("--instants", default="1,4,16,72,288")
    ask.add_argument("--observers", default="1,2,4,8,16")
    ask.add_argument("--out")
    asked = ask.parse_args()
    sink = open(asked.out, "w", newline="") if asked.out else sys.stdout
    table, failed, before = csv.DictWriter(sink, FIELDS), False, None
    table.writeheader()
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        made_scene("desert", folder)
        program = pathlib.Path(asked.program).resolve()
        for kind, number, said, seconds, peak in rows_of(program, folder, *map(numbers, (asked.facets, asked.scene, asked.instants, asked.observers))):
            exponent = ""
            if before and before[0] == kind:
                exponent = f"{math.log(seconds / before[2]) / math.log(number / before[1]):.2f}"
                failed |= float(exponent) > HIGHEST
            table.writerow(dict(zip(FIELDS, [kind, number, facets_of(said), f"{seconds:.2f}", f"{peak:.0f}", exponent])))
            sink.flush()
            before = (kind, number, seconds)
    sys.exit(failed)


if __name__ == "__main__":
    main()
