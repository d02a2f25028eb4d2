"""One facet driven by weather, and the calibration of its keys against a measured curve."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np

from . import _core, checks
from .errors import Error, NotConverged
from .figures import time_curves_svg
from .settings import settings_list
from .studies import Calibration, converged
from .tables import as_dataset, as_frame, write_csv
from .toml_text import toml_text


class Column:
    """Curves of one facet.

    `columns`: arrays (instant) by name, as the CSV of `diurna column` has them: `time` (datetime64, UTC),
    `surface_temperature_K`, fluxes [W m-2] positive towards the surface; column["latent_W_m2"] is one. `note`: which weather
    was modelled because it was not measured. `passes`, `converged`: of the spin-up. `depth_m`, `final_profile_K`: (node) of the
    ground at the end. A notebook shows the curve of the surface temperature.
    """

    def __init__(self, raw: dict[str, Any]) -> None:
        """raw: as the compiled module returns it."""
        self.columns: dict[str, np.ndarray[Any, np.dtype[Any]]] = raw["columns"]
        self.note: str = raw["note"]
        self.converged: bool = raw["converged"]
        self.passes: int = raw["passes"]
        self.depth_m: np.ndarray[Any, np.dtype[np.float64]] = raw["depth_m"]
        self.final_profile_K: np.ndarray[Any, np.dtype[np.float64]] = raw["final_profile_K"]

    def __getitem__(self, name: str) -> np.ndarray[Any, np.dtype[Any]]:
        """A curve (instant) by its name. Raises KeyError with the names there are."""
        try:
            return self.columns[name]
        except KeyError:
            raise KeyError(f"no column {name!r}, expected one of: {', '.join(self.columns)}") from None

    def __repr__(self) -> str:
        kelvin = self["surface_temperature_K"]
        return f"<diurna.Column {len(kelvin)} rows, surface {kelvin.min():.2f} to {kelvin.max():.2f} K>"

    def frame(self) -> Any:
        """The curves as a pandas.DataFrame, instants in UTC as its index. Needs pandas."""
        return as_frame(self.columns, "time")

    def xarray(self) -> Any:
        """The curves as an xarray.Dataset over `time` (UTC). Needs xarray."""
        return as_dataset(self.columns)

    def _repr_svg_(self) -> str:
        return time_curves_svg(self["time"], {"surface temperature": self["surface_temperature_K"]}, "K")


@contextmanager
def _column_source(
    job: checks.File | Mapping[str, Any],
    tables: dict[tuple[str, str], Any],
    settings: checks.Settings,
    allow_outside: bool,
) -> Iterator[Any]:
    """The column file or dictionary. Tables, by argument and the key that names their file, are written to a temporary
    folder."""
    checks.flag("allow_outside", allow_outside)
    with tempfile.TemporaryDirectory() as folder:
        given = settings_list(settings)
        text: str | None = None
        if isinstance(job, Mapping):
            text, file = toml_text(job), os.path.abspath("column.toml")
        else:
            file = checks.file("job", job)
        written = [(what, key, one) for (what, key), one in tables.items() if one is not None]
        for what, key, one in written:
            given.append(f'{key}="{write_csv(one, os.path.join(folder, what + ".csv"), what)}"')
        try:
            yield _core.ColumnSource(file, text, given, [folder] if written else [], allow_outside)
        except Error as error:  # places in the temporary files; the rows of a table begin in line 2
            moved = error.mistakes
            if text is not None:  # a dictionary is in no file
                moved = [one.of_dictionary(file, "job") for one in moved]
            raise Error((one.where.replace(folder + os.sep, "given "), one.problem, one.hint, one.key) for one in moved) from None


def column(
    job: checks.File | Mapping[str, Any],
    weather: Any = None,
    settings: checks.Settings = (),
    allow_outside: bool = False,
) -> Column:
    """Solves one facet driven by weather, as `diurna column`.

    job: a column file, or a dictionary with its keys; files that a dictionary names lie in the working folder or below.
    weather: in place of [weather] file: a pandas.DataFrame or a dictionary of columns named as in weather files
    (`air_temperature_K`, `wind_speed_m_s`, ...), with `time` or instants as the index, NaN where a value is missing.
    settings: values in place of the file's: "key.path=value", a list of them, or a dictionary by key path; parts of a library
    material too: {"material.layers.0.thickness_m": 0.1}. allow_outside: files of other folders may be read.

    Returns a diurna.Column. Raises diurna.Error with file, key and remedy, and diurna.NotConverged with the result.
    """
    with _column_source(job, {("weather", "weather.file"): weather}, settings, allow_outside) as source:
        result = Column(_core.column(source))
    if not result.converged:
        raise NotConverged(f"spin-up not converged in {result.passes} passes; set a shorter time.longest_step_s", result)
    return result


def calibrate(
    job: checks.File | Mapping[str, Any],
    measured: Any = None,
    weather: Any = None,
    settings: checks.Settings = (),
    allow_outside: bool = False,
    out: checks.File | None = None,
) -> Calibration:
    """Fits keys of a column to a measured curve, as `diurna calibrate`: those of `sought` in its [calibrate].

    job, weather, settings, allow_outside: as of diurna.column(). measured: in place of [calibrate] measured: a pandas.Series
    [K] with instants as its index, or a table with `time` and one column; NaN where a value is missing. out: a folder for the
    program's files; None: none is written.

    Returns a diurna.Calibration. Raises diurna.Error with file, key and remedy, and diurna.NotConverged with the result.
    """
    tables = {("weather", "weather.file"): weather, ("measured", "calibrate.measured"): measured}
    with _column_source(job, tables, settings, allow_outside) as source:
        raw = _core.calibrate(source, checks.optional_file("out", out))
    return converged(Calibration(raw["findings"][0]), raw)
