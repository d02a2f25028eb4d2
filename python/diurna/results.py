"""What a scene returns: its check, its plan, a run's folder and the temperatures in it."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core, checks
from .figures import picture_html, table_html, time_curves_svg
from .optional import imported
from .pictures import Frame, read_frame

_shown_pictures = 6
_largest_shown_bytes = 2e8  # of temperatures that a notebook's display may read


class Check(NamedTuple):
    """What a check has found in a scene without mistakes.

    `facets`, `observers`: their numbers. `warnings`: what is implausible, a line each. `notes`: what was converted or repaired.
    """

    facets: int
    observers: int
    warnings: list[str]
    notes: list[str]


class Plan(dict[str, Any]):
    """What a run would compute.

    A dictionary: `facets`, `views` (an observer at an instant), `pictures` (a view in a band), `seconds` and `memory_bytes` (estimates), `stages` (seconds by name), `frames`
    (datetime64, UTC), `decisions` (dictionaries: what is computed or skipped, why, at which error), `text`.
    """

    def __repr__(self) -> str:
        return str(self["text"])

    def _repr_html_(self) -> str:
        head = f"<p>{self['facets']} facets, {self['views']} views, {self['pictures']} pictures, about {self['seconds']:.0f} s, {self['memory_bytes'] / 1e6:.0f} MB</p>"
        rows = [[one["what"], "yes" if one["computed"] else "no", one["why"]] for one in self["decisions"]]
        return head + table_html(["what", "computed", "why"], rows)


class _TimeAndKelvin(NamedTuple):
    time: npt.NDArray[np.datetime64]
    kelvin: npt.NDArray[np.float32]


class Temperatures(_TimeAndKelvin):
    """Temperatures of all facets. A tuple of `time` and `kelvin`, with two more attributes.

    `time`: (instant) datetime64 in UTC. `kelvin`: (instant, facet) float32 [K]; facets in the order of
    `Stepper.facets()`. `material`, `object`: (facet) names as texts; the ground is the object "ground". A notebook shows the
    mean, lowest and highest curve.
    """

    time: npt.NDArray[np.datetime64]
    kelvin: npt.NDArray[np.float32]
    material: npt.NDArray[np.str_]
    object: npt.NDArray[np.str_]

    def xarray(self) -> Any:
        """The temperatures as an xarray.DataArray (time, facet) in K, without a copy, with the coordinates `time` (UTC),
        `material` and `object` (facet): xarray().groupby("material").mean(). Needs xarray."""
        xarray = imported("xarray")
        coordinates = {
            "time": self.time.astype("datetime64[ns]"),
            "material": ("facet", self.material, {"long_name": "material of the facet"}),
            "object": ("facet", self.object, {"long_name": "object or building that the facet belongs to"}),
        }
        attributes = {"units": "K", "long_name": "surface temperature"}
        return xarray.DataArray(self.kelvin, dims=("time", "facet"), coords=coordinates, name="temperature", attrs=attributes)

    def _repr_svg_(self) -> str:
        return _temperatures_svg(self)

    def __repr__(self) -> str:
        instants, facets = self.kelvin.shape
        return f"<diurna.Temperatures {instants} instants, {facets} facets, {np.nanmin(self.kelvin):.1f} to {np.nanmax(self.kelvin):.1f} K>"


def _temperatures_svg(of: Temperatures) -> str:
    curves = {
        "mean": np.nanmean(of.kelvin, axis=1),
        "highest": np.nanmax(of.kelvin, axis=1),
        "lowest": np.nanmin(of.kelvin, axis=1),
    }
    return time_curves_svg(of.time, curves, "K")


def temperatures(file: checks.File) -> Temperatures:
    """Reads temperatures.nc of a run, or a file of `diurna solve`.

    Returns a diurna.Temperatures: instants (datetime64, UTC), [K] as (instant, facet), and the facets' materials and objects.
    Raises diurna.Error for a file that holds no temperatures.
    """
    time, kelvin, material, material_names, objects, object_names = _core.temperatures(checks.file("file", file))
    found = Temperatures(time, kelvin)
    found.material = np.array(material_names, np.str_)[material]
    found.object = np.array(object_names, np.str_)[objects]
    return found


class Run:
    """A run's folder and what the run has reported.

    `folder`: its path. `facets`, `frames_rendered`: their numbers. `files`: written, relative to the folder. `stages`: seconds
    by name. `notes`: approximations and repairs. `warnings`: implausible input. `start`: how the temperatures at the start
    were found. `not_converged`: "" or which residual is above its limit.

    A notebook shows the curves of temperature and the first pictures.
    """

    def __init__(self, folder: checks.File, raw: dict[str, Any]) -> None:
        """folder: of the results; raw: as the compiled module returns it."""
        self.folder: Path = Path(folder)
        self.facets: int = raw["facets"]
        self.frames_rendered: int = raw["frames_rendered"]
        self.files: list[Any] = raw["files"]
        self.stages: dict[str, float] = raw["stages"]
        self.notes: list[str] = raw["notes"]
        self.warnings: list[str] = raw["warnings"]
        self.start: str = raw["start"]
        self.not_converged: str = raw["not_converged"]

    @property
    def report(self) -> Path:
        """The report, a page of HTML."""
        return self.folder / "report.html"

    @property
    def seconds(self) -> float:
        """Time of all stages [s]."""
        return sum(self.stages.values())

    def frame_files(self) -> list[Path]:
        """Pictures (EXR), sorted by observer, band and instant, as in their names."""
        return sorted((self.folder / "frames").glob("*.exr"))

    def frames(self, planes: Sequence[str] | None = None) -> Iterator[Frame]:
        """Pictures, read one after the other; planes: names of those to read, None: all. Raises diurna.Error."""
        return (read_frame(file, planes) for file in self.frame_files())

    def temperatures(self) -> Temperatures:
        """temperatures.nc: instants (datetime64, UTC) and [K] as (instant, facet). Raises diurna.Error if it is missing."""
        return temperatures(self.folder / "temperatures.nc")

    def manifest(self) -> dict[str, Any]:
        """manifest.json as a dictionary: inputs and outputs with their SHA-256, settings, and the `legend` of the planes `object`
        and `material`: its lists `objects` and `materials` have `id` and `name`."""
        return dict(json.loads((self.folder / "manifest.json").read_text(encoding="utf-8")))

    def annotations(self) -> dict[str, Any]:
        """annotations.json, labels in the form of COCO: `images`, `annotations` (`bbox` [pixel]: left, top, width, height),
        `categories`. Raises FileNotFoundError where no picture shows an object."""
        return dict(json.loads((self.folder / "annotations.json").read_text(encoding="utf-8")))

    def __repr__(self) -> str:
        return f"<diurna.Run {self.folder}: {self.facets} facets, {self.frames_rendered} views, {self.seconds:.1f} s>"

    def _repr_html_(self) -> str:
        shown = f"<p>{self.folder}: {self.facets} facets, {self.frames_rendered} views, {self.seconds:.1f} s</p>"
        stored = self.folder / "temperatures.nc"
        if stored.exists() and stored.stat().st_size < _largest_shown_bytes:
            shown += _temperatures_svg(self.temperatures()) + "<br/>"
        for file in self.frame_files()[:_shown_pictures]:
            frame = read_frame(file)
            shown += picture_html(frame.png(), f"{frame.observer} {frame.instant}Z", 200)
        return shown
