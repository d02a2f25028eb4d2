"""Results of studies: crossovers, contrast, signatures, ranges, sensitivities, calibrations."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from typing import Any, SupportsIndex, TypeVar, overload

import numpy as np

from .errors import NotConverged
from .figures import table_html
from .tables import as_frame, read_csv


class Study:
    """The result of one study of a scene, with the numbers of the files of its name.

    `name`: of the study. `columns`: arrays (row) of NAME.csv by name; study["time"] is one, datetime64 in UTC. `summary`:
    NAME.json as a dictionary. `svg`: the figure. `text`: the lines that the program prints. `notes`: approximations of this
    study. `curves`: arrays of NAME_curves.csv, None for a study that has none. `texts`: the files, by ending.

    A notebook shows the figure with its curves and the first rows, both on the clock of the scene with its offset from UTC.
    """

    def __init__(self, raw: dict[str, Any]) -> None:
        """raw: as the compiled module returns it."""
        self.name: str = raw["name"]
        self.texts: dict[str, str] = raw["texts"]
        self.text: str = raw["text"]
        self.notes: list[str] = raw["notes"]
        self.columns: dict[str, np.ndarray[Any, np.dtype[Any]]] = read_csv(self.texts[".csv"])
        self.summary: dict[str, Any] = json.loads(self.texts[".json"])
        self.svg: str = self.texts[".svg"]
        curves = [text for ending, text in self.texts.items() if ending.startswith("_curve")]
        self.curves: dict[str, np.ndarray[Any, np.dtype[Any]]] | None = read_csv(curves[0]) if curves else None

    def __getitem__(self, name: str) -> np.ndarray[Any, np.dtype[Any]]:
        """A column (row) by its name. Raises KeyError with the names there are."""
        try:
            return self.columns[name]
        except KeyError:
            raise KeyError(f"no column {name!r}, expected one of: {', '.join(self.columns)}") from None

    def __len__(self) -> int:
        """Number of rows."""
        return len(next(iter(self.columns.values())))

    def __repr__(self) -> str:
        return self.text.rstrip("\n")

    def frame(self) -> Any:
        """The columns as a pandas.DataFrame, instants in UTC. Needs pandas."""
        return as_frame(self.columns)

    def curves_frame(self) -> Any:
        """The curves as a pandas.DataFrame: of a crossover by band and instant, of a calibration with instants as the index.

        Needs pandas. Raises ValueError for a study without curves.
        """
        if self.curves is None:
            raise ValueError(f"{self.name}: a study of {self.summary['study']} has no curves")
        return as_frame(self.curves, None if "band_um" in self.curves else "time")

    def _repr_svg_(self) -> str:
        return self.svg

    def _repr_html_(self) -> str:
        header, *rows = csv.reader(io.StringIO(self.texts[".csv"]))  # times on the scene's clock, as in the figure
        return self.svg + table_html(header, rows)


class Studies(list[Study]):
    """Studies of one kind in a scene, by number or by name: studies["plates"]. `notes`: of the scene and its temperatures."""

    def __init__(self, raw: dict[str, Any], kind: Callable[[dict[str, Any]], Study] = Study) -> None:
        """raw: as the compiled module returns it; kind: the class of each."""
        super().__init__(kind(one) for one in raw["findings"])
        self.notes: list[str] = raw["notes"]

    @overload
    def __getitem__(self, which: SupportsIndex) -> Study: ...
    @overload
    def __getitem__(self, which: slice) -> list[Study]: ...
    @overload
    def __getitem__(self, which: str) -> Study: ...
    def __getitem__(self, which: Any) -> Any:
        """By number, slice or name. Raises KeyError with the names there are."""
        if not isinstance(which, str):
            return super().__getitem__(which)
        for one in self:
            if one.name == which:
                return one
        raise KeyError(f"no study {which!r}, expected one of: {', '.join(one.name for one in self)}")

    def __repr__(self) -> str:
        return "\n".join(map(repr, self))

    def _repr_html_(self) -> str:
        return "\n".join(one._repr_html_() for one in self)


class Calibration(Study):
    """The result of a calibration: a row for each key that was fitted. `curves`: measured, before and after [K] by instant."""

    @property
    def values(self) -> dict[str, float]:
        """The fitted numbers by key."""
        return dict(zip(self["key"], map(float, self["value"])))

    @property
    def settings(self) -> list[str]:
        """The fitted numbers as settings of diurna.column()."""
        return [f"{key}={value!r}" for key, value in self.values.items()]


Found = TypeVar("Found")


def converged(found: Found, raw: dict[str, Any]) -> Found:
    """The result itself. Raises diurna.NotConverged with it if a heat balance has not converged."""
    if raw["not_converged"]:
        raise NotConverged(raw["not_converged"], found)
    return found
