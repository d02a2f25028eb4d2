#!/usr/bin/env python3
"""Which methods of validation the tests use on which part, counted from their tags; prints Markdown.

Methods are those of Sargent (2013), Verification and validation of simulation models, Journal of
Simulation 7:12-24. A test of several methods counts in each; one of none (refusals, files, the
command line) in none.
"""
import collections
import pathlib
import re

METHODS = [
    ("comparison to other models, closed forms, published tables", "by_comparison"),
    ("degenerate tests: furnaces, vacuum, nothing in the way", "by_degenerate"),
    ("event validity: sunrise, shadow edges, freezing, crossover", "by_events"),
    ("extreme conditions", "by_extreme"),
    ("historical data: measured days, spectra, roughness", "by_history"),
    ("internal validity: seeds, noise, order of threads", "by_replication"),
    ("parameter variability: derivatives, orders, sensitivity", "by_variation"),
    ("traces: balances followed through, pictures redone", "by_trace"),
]
UNTAGGED = [
    ("face validity", "pictures and curves are looked at by persons; no test"),
    ("predictive validation", "none: no measurement was made after a prediction"),
]
PARTS = ["thermal", "terrain", "radiometry", "atmosphere", "instrument", "whole scenes"]
AIR = re.compile(
    r"air_|atmosphere|band_model|moist_air|profile|sun_field|two_stream|tape7|modtran|onward_light|"
    r"scattered_path|sight_line|radiosonde|ground_fluxes|sky_state|sun_course|path_|mie|same_air|plume"
)
INSTRUMENT = re.compile(r"instrument_|detection|motion|display|moving_objects|sensor_|mtf")
CASE = re.compile(r'TEST_CASE\(\s*(?:"(?:[^"\\]|\\.)*"\s*)+,\s*((?:"[^"]*"\s*)+)\)')


def part_of(file):
    room, name = file.parent.name, file.stem
    if room in ("scenes", "whole"):
        return "whole scenes"
    if AIR.match(name):
        return "atmosphere"
    if INSTRUMENT.match(name):
        return "instrument"
    return {"materials": "radiometry", "render": "radiometry"}.get(room, room)


def main():
    tests = pathlib.Path(__file__).resolve().parent.parent / "tests"
    count = collections.Counter()
    for file in sorted(tests.glob("*/*_test.cpp")):
        for tags in CASE.findall(file.read_text()):
            for tag in set(re.findall(r"\[(by_\w+)\]", tags)):
                count[tag, part_of(file)] += 1
    print("| method | " + " | ".join(PARTS) + " |")
    print("|---|" + "---|" * len(PARTS))
    for method, tag in METHODS:
        cells = " | ".join(str(count[tag, part] or "") for part in PARTS)
        print(f"| {method} | {cells} |")
    for method, why in UNTAGGED:
        print(f"| {method} | {why} |" + " |" * (len(PARTS) - 1))


main()
