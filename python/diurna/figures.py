"""Pictures and curves as PNG, SVG and HTML for notebooks."""

from __future__ import annotations

import base64
import html
import struct
import zlib
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

_colours = ("#b3541e", "#1f5fa8", "#3b7d3b", "#8a4f9e", "#777777", "#c09000")


def grey_png(values: Any, least: float, most: float) -> bytes:
    """PNG of 8 bits of an array (row, column): `least` is black, `most` white, values that are not finite are black."""
    scaled = (np.nan_to_num(np.asarray(values, float), nan=least) - least) / max(most - least, 1e-30)
    grey = np.clip(255.0 * scaled + 0.5, 0, 255).astype(np.uint8)
    height, width = grey.shape

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + row.tobytes() for row in grey)
    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def picture_html(png: bytes, caption: str, width: int = 320) -> str:
    """A figure of HTML with the picture inside it and a caption below."""
    data = base64.b64encode(png).decode()
    style = f"image-rendering:pixelated;width:{width}px"
    picture = f'<img alt="{html.escape(caption)}" src="data:image/png;base64,{data}" style="{style}"/>'
    return f'<figure style="display:inline-block;margin:4px">{picture}<figcaption>{html.escape(caption)}</figcaption></figure>'


def curves_svg(x: Any, curves: Mapping[str, Any], unit: str, ends: tuple[str, str], height: int = 215) -> str:
    """Curves over one axis as SVG, with the lowest and highest value and the two ends of the axis.

    x: (point), ascending; curves: (point) each, by the name in the legend, NaN where a curve has a gap; unit: of the values;
    ends: what the first and the last point are called.
    """
    place = np.asarray(x, float)
    span = max(float(place[-1] - place[0]), 1e-30) if place.size else 1.0
    values = [np.asarray(curve, float) for curve in curves.values()]
    finite = np.concatenate([one[np.isfinite(one)] for one in values]) if values else np.zeros(0)
    low = float(finite.min()) if finite.size else 0.0
    high = max(float(finite.max()), low + 1e-3) if finite.size else 1.0
    base = height - 25
    lines = []
    for i, (name, curve) in enumerate(zip(curves, values)):
        colour = _colours[i % len(_colours)]
        points: list[str] = []
        for at, value in zip(place, curve):
            if np.isfinite(value):
                points.append(f"{60 + 530 * (at - place[0]) / span:.1f},{base - (base - 20) * (value - low) / (high - low):.1f}")
            elif points and points[-1]:
                points.append("")
        for run in "|".join(points).split("||"):
            joined = run.replace("|", " ").strip()
            if joined:
                lines.append(f'<polyline points="{joined}" fill="none" stroke="{colour}" stroke-width="1.5"/>')
        if len(values) > 1:
            lines.append(f'<text x="{70 + 110 * i}" y="12" fill="{colour}">{html.escape(name)}</text>')
    first, last = html.escape(ends[0]), html.escape(ends[1])
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="600" height="{height}" font-family="sans-serif" font-size="11">'
        + "".join(lines)
        + f'<text x="2" y="24">{high:.4g} {html.escape(unit)}</text><text x="2" y="{base + 4}">{low:.4g} {html.escape(unit)}</text>'
        + f'<text x="60" y="{height - 5}">{first}</text><text x="590" y="{height - 5}" text-anchor="end">{last}</text></svg>'
    )


def time_curves_svg(time: Any, curves: Mapping[str, Any], unit: str) -> str:
    """Curves over instants (datetime64, UTC) as SVG."""
    instants = np.asarray(time)
    if instants.size == 0:
        return curves_svg(np.zeros(0), {}, unit, ("", ""))
    ends = (f"{str(instants[0])[:16]}Z", f"{str(instants[-1])[:16]}Z")
    return curves_svg((instants - instants[0]) / np.timedelta64(1, "s"), curves, unit, ends)


def _cell(value: Any) -> str:
    if isinstance(value, (float, np.floating)):
        return f"{value:.6g}"
    if isinstance(value, np.datetime64):
        return f"{np.datetime_as_string(value)}Z"
    return html.escape(str(value))


def table_html(header: Iterable[str], rows: Sequence[Sequence[Any]], most: int = 20) -> str:
    """A table of HTML with its first rows."""
    head = "".join(f"<th>{html.escape(name)}</th>" for name in header)
    body = "".join("<tr>" + "".join(f"<td>{_cell(value)}</td>" for value in row) + "</tr>" for row in rows[:most])
    more = f"<p>{len(rows) - most} more rows</p>" if len(rows) > most else ""
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"
