"""Pictures as arrays that a notebook displays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from . import _core, checks
from .figures import curves_svg, grey_png, picture_html
from .optional import imported


class Frame:
    """What an observer sees at an instant.

    `planes`: arrays float32 (row, column) by name, row 0 the upper one: `radiance.BAND` [W m-2 sr-1],
    `apparent_temperature.BAND` [K], truth planes as `temperature` [K], `range` [m], `object`, `material`; BAND is spelled as in
    the scene. frame["range"] is a plane. `units`: of each plane. `instant`: numpy.datetime64 in UTC. `observer`: its name.
    `notes`: approximations of this picture. `attributes`: of the EXR file: camera, sun, field of view.

    A notebook shows the picture of the first apparent temperature and the curve of how often each value occurs.
    """

    def __init__(self, raw: dict[str, Any]) -> None:
        """raw: as the compiled module returns it."""
        self.planes: dict[str, np.ndarray[Any, np.dtype[np.float32]]] = raw["planes"]
        self.units: dict[str, str] = raw["units"]
        self.instant: np.datetime64 = raw["instant"][0]
        self.observer: str = raw["observer"]
        self.notes: list[str] = raw["notes"]
        self.attributes: dict[str, Any] = raw["attributes"]

    def __getitem__(self, name: str) -> np.ndarray[Any, np.dtype[np.float32]]:
        """A plane (row, column) by its name. Raises KeyError with the names there are."""
        try:
            return self.planes[name]
        except KeyError:
            raise KeyError(f"no plane {name!r}, expected one of: {', '.join(self.planes)}") from None

    def __repr__(self) -> str:
        return f"<diurna.Frame {self.observer} {self.instant}Z: {', '.join(self.planes)}>"

    def _shown(self) -> str:
        names = [n for n in self.planes if n.startswith("apparent_temperature")] or list(self.planes)
        return names[0]

    def _limits(self, plane: str) -> tuple[float, float]:
        """1st and 99th percentile of the finite values."""
        values = self[plane]
        finite = values[np.isfinite(values)]
        if finite.size == 0:
            finite = np.zeros(1)
        low, high = np.percentile(finite, [1, 99])
        return float(low), float(high)

    def png(self, plane: str | None = None, least: float | None = None, most: float | None = None) -> bytes:
        """The PNG of a plane in grey.

        plane: its name; None: the first apparent temperature. least, most: the values shown black and white, in the plane's
        unit; None: the 1st and the 99th percentile. Raises KeyError for a plane that is not there, diurna.Error for limits
        that are no numbers.
        """
        name = self._shown() if plane is None else checks.text("plane", plane)
        values = self[name]
        low, high = self._limits(name)
        least = low if least is None else checks.number("least", least)
        most = high if most is None else checks.number("most", most)
        return grey_png(values, least, most)

    def xarray(self) -> Any:
        """The planes as an xarray.Dataset (row, column), with their units. Needs xarray; raises ImportError without it."""
        xarray = imported("xarray")
        variables = {name: (("row", "column"), values, {"units": self.units[name]}) for name, values in self.planes.items()}
        time = np.datetime64(self.instant, "ns")
        return xarray.Dataset(variables, coords={"time": time}, attrs={"observer": self.observer})

    def _repr_png_(self) -> bytes:
        return self.png()

    def _repr_html_(self) -> str:
        name = self._shown()
        low, high = self._limits(name)
        unit = self.units.get(name, "")
        caption = f"{self.observer} {self.instant}Z {name}: black {low:.4g} to white {high:.4g} {unit}"
        values = self[name]
        inside = values[np.isfinite(values) & (values >= low) & (values <= high)]
        if inside.size == 0 or high <= low:
            return picture_html(self.png(), caption)
        count, edge = np.histogram(inside, bins=64, range=(low, high))
        share = {"pixels": 100.0 * count / inside.size}
        ends = (f"{low:.4g} {unit}", f"{high:.4g} {unit}")
        return picture_html(self.png(), caption) + curves_svg(0.5 * (edge[1:] + edge[:-1]), share, "% of pixels", ends, 140)


def read_frame(file: checks.File, planes: Sequence[str] | str | None = None) -> Frame:
    """Reads a picture of a run's folder (EXR).

    planes: names of those to read, spelled as in the file; None: all. Raises diurna.Error for a file that is no picture of
    diurna and for a plane that it does not have.
    """
    wanted = None if planes is None else checks.texts("planes", planes, "the name of a plane")
    return Frame(_core.frame(checks.file("file", file), wanted))
