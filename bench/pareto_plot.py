#!/usr/bin/env python3
"""Draws the file of bench/pareto.py: bench/pareto_plot.py FILE.csv OUT.svg

Processor seconds against the error of pictures [K rms], both logarithmic. Full circles: true error; hollow ones: the error that
the run's own check reports, with its 95 % interval. A line joins a scene's tolerances.
"""
import csv, math, sys

COLOURS = {"jacksboro": "#1b6ca8", "approach": "#7a3b9b", "crossover": "#2f8f4e", "desert": "#c77700", "city": "#b3261e"}
WIDTH, HEIGHT, LEFT, TOP, RIGHT, BOTTOM = 720, 420, 70, 20, 150, 50


def scale(values, low_end, high_end):
    low, high = math.log10(min(values)) - 0.05, math.log10(max(values)) + 0.05
    return lambda v: low_end + (math.log10(v) - low) / (high - low) * (high_end - low_end)


def ticks(values):
    low, high = min(values), max(values)
    return [m * 10**e for e in range(-4, 5) for m in (1, 2, 5) if low * 0.9 <= m * 10**e <= high * 1.1]


def main(source, out):
    rows = [r for r in csv.DictReader(open(source)) if float(r["true_rms_K"]) > 0]
    seconds = [float(r["processor_s"]) for r in rows]
    errors = [float(r[k]) for r in rows for k in ("true_rms_K", "reported_low_K", "reported_high_K") if r[k] and float(r[k]) > 0]
    x, y = scale(seconds, LEFT, WIDTH - RIGHT), scale(errors, HEIGHT - BOTTOM, TOP)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="12">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>']
    for t in ticks(seconds):
        parts.append(f'<line x1="{x(t):.1f}" y1="{TOP}" x2="{x(t):.1f}" y2="{HEIGHT - BOTTOM}" stroke="#ddd"/><text x="{x(t):.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">{t:g}</text>')
    for t in ticks(errors):
        parts.append(f'<line x1="{LEFT}" y1="{y(t):.1f}" x2="{WIDTH - RIGHT}" y2="{y(t):.1f}" stroke="#ddd"/><text x="{LEFT - 6}" y="{y(t) + 4:.1f}" text-anchor="end">{t:g}</text>')
    parts.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 12}" text-anchor="middle">processor seconds, one thread</text>')
    parts.append(f'<text transform="translate(18 {(TOP + HEIGHT - BOTTOM) / 2}) rotate(-90)" text-anchor="middle">error of apparent temperature, K rms</text>')
    for i, name in enumerate(dict.fromkeys(r["scene"] for r in rows)):
        own, colour = [r for r in rows if r["scene"] == name], COLOURS.get(name, "#333")
        line = " ".join(f'{x(float(r["processor_s"])):.1f},{y(float(r["true_rms_K"])):.1f}' for r in own)
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}"/>')
        for r in own:
            at = x(float(r["processor_s"]))
            parts.append(f'<circle cx="{at:.1f}" cy="{y(float(r["true_rms_K"])):.1f}" r="4" fill="{colour}"><title>{name}, tolerance_K = {r["tolerance_K"]}</title></circle>')
            if r["reported_rms_K"] and float(r["reported_low_K"]) > 0:
                low, high = y(float(r["reported_low_K"])), y(float(r["reported_high_K"]))
                parts.append(f'<line x1="{at:.1f}" y1="{low:.1f}" x2="{at:.1f}" y2="{high:.1f}" stroke="{colour}" stroke-opacity="0.5"/>'
                             f'<circle cx="{at:.1f}" cy="{y(float(r["reported_rms_K"])):.1f}" r="3" fill="white" stroke="{colour}"/>')
        parts.append(f'<text x="{WIDTH - RIGHT + 14}" y="{TOP + 18 + 18 * i}" fill="{colour}">{name}</text>')
    at = TOP + 40 + 18 * len({r["scene"] for r in rows})
    parts.append(f'<text x="{WIDTH - RIGHT + 14}" y="{at}">full: true</text><text x="{WIDTH - RIGHT + 14}" y="{at + 18}">hollow: reported</text></svg>')
    open(out, "w").write("\n".join(parts) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
