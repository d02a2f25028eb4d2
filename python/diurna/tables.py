"""Tables in and out: columns of pandas or numpy as the CSV that the program reads, and its CSV as columns."""

from __future__ import annotations

import csv
import datetime
import io
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from .checks import Instant, described
from .errors import Error
from .optional import imported

_zone_hint = "give the offset: tzinfo=datetime.timezone.utc, or tz_localize(...) in pandas"
_text_hint = "expected a text in ISO 8601 with its offset, a datetime with tzinfo or a numpy.datetime64 (UTC)"


def instant_text(when: Instant, key: str = "time") -> str:
    """ISO 8601 with an offset: of a text as it is, of a datetime with tzinfo, of a numpy.datetime64, which counts as UTC.

    Raises diurna.Error with the key for a datetime without tzinfo, an instant that is missing (NaT), and other types.
    """
    if isinstance(when, str):
        return when
    if isinstance(when, np.datetime64):
        if np.isnat(when):
            raise Error([(key, "an instant is missing (NaT)", "remove the row, or fill in its instant", key)])
        return str(when.astype("datetime64[ms]")) + "Z"
    if not isinstance(when, datetime.datetime):
        if hasattr(when, "isoformat") and when != when:  # pandas.NaT
            raise Error([(key, "an instant is missing (NaT)", "remove the row, or fill in its instant", key)])
        raise Error([(key, f"found {described(when)}", _text_hint, key)])
    if when != when:
        raise Error([(key, "an instant is missing (NaT)", "remove the row, or fill in its instant", key)])
    if when.tzinfo is None:
        raise Error([(key, f"found {when} without an offset from UTC", _zone_hint, key)])
    return when.isoformat(timespec="milliseconds")


def _is_missing(value: Any) -> bool:
    if value is None:
        return True
    try:
        return bool(value != value)
    except TypeError:  # pandas.NA is neither equal nor unequal
        return True


def _number_text(value: Any) -> str:
    return "" if _is_missing(value) else repr(float(value))


def _columns_of(table: Any, what: str) -> dict[str, Any]:
    """By name, of a DataFrame (instants in a column `time` or as its index), a Series or a dictionary."""
    if isinstance(table, Mapping):
        return dict(table)
    if hasattr(table, "to_frame") and hasattr(table, "index"):  # a Series, or a frame of another library
        table = table.to_frame(table.name if table.name is not None else "value")
    if not hasattr(table, "columns"):
        expected = "expected a pandas.DataFrame, a Series or a dictionary of columns"
        raise Error([(what, f"found {type(table).__name__}", expected)])
    if "time" not in table:
        table = table.rename_axis("time").reset_index()
    return {name: table[name] for name in table.columns}


def csv_text(table: Any, what: str) -> str:
    """A table as CSV: instants with their offset, values that are missing (NaN, None) as empty cells.

    table: a DataFrame with a column `time` or instants as its index, a Series likewise, or a dictionary of columns; what:
    the argument it was given as. Raises diurna.Error with that argument, column and row.
    """
    columns = _columns_of(table, what)
    if "time" not in columns:
        hint = "name the column of instants `time`, or make them the index"
        raise Error([(what, f"has no column `time`, found: {', '.join(map(str, columns))}", hint, what)])
    for name, values in columns.items():
        if isinstance(values, str) or not hasattr(values, "__len__"):
            raise Error([(what, f"column {name!r}: found {described(values)}", "expected a list or an array", f"{what}.{name}")])
    length = {name: len(values) for name, values in columns.items()}
    if len(set(length.values())) != 1:
        raise Error([(what, f"expected columns of one length, found {length}", "give each column a value for each instant", what)])
    cells: list[list[str]] = []
    for name, values in columns.items():
        cells.append([])
        for row, value in enumerate(values):
            try:
                cells[-1].append(instant_text(value) if name == "time" else _number_text(value))
            except Error as error:
                one = error.mistakes[0]
                raise Error([(f"{what}: column {name!r}, row {row}", one.problem, one.hint, f"{what}.{name}")]) from None
            except (TypeError, ValueError):
                where = f"{what}: column {name!r}, row {row}"
                hint = "expected a number; NaN or None where a value is missing"
                raise Error([(where, f"found {described(value)}", hint, f"{what}.{name}")]) from None
    out = io.StringIO(newline="")
    writer = csv.writer(out)
    writer.writerow(columns)
    writer.writerows(zip(*cells))
    return out.getvalue()


def write_csv(table: Any, file: str | Path, what: str) -> Path:
    """Writes a table as csv_text() makes it; returns the file."""
    Path(file).write_text(csv_text(table, what), encoding="utf-8", newline="")
    return Path(file)


def _name(cell: str) -> str:
    """A name without the apostrophe that keeps spreadsheets from reading it as a formula."""
    return cell[1:] if cell[:1] == "'" and cell[1:2] in tuple("=+-@") else cell


def _array(name: str, cells: list[str]) -> np.ndarray[Any, np.dtype[Any]]:
    if name == "time":
        return np.array([_utc(cell) for cell in cells], "datetime64[ms]")
    if cells and all(cell in ("true", "false") for cell in cells):
        return np.array([cell == "true" for cell in cells])
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array([_name(cell) for cell in cells], object)


def _utc(text: str) -> np.datetime64:
    when = datetime.datetime.fromisoformat(text).astimezone(datetime.timezone.utc)
    return np.datetime64(when.replace(tzinfo=None), "ms")


def read_csv(text: str) -> dict[str, np.ndarray[Any, np.dtype[Any]]]:
    """Columns of the program's CSV by name, each an array (row).

    `time` as datetime64 in UTC, numbers as float64 (an empty cell: NaN), true and false as bool, names as text.
    """
    header, *rows = csv.reader(io.StringIO(text))
    return {_name(name): _array(name, [row[i] for row in rows]) for i, name in enumerate(header)}


def as_frame(columns: Mapping[str, Any], index: str | None = None) -> Any:
    """Columns as a pandas.DataFrame, instants in UTC; `index`: the column that becomes its index."""
    pandas = imported("pandas")
    frame = pandas.DataFrame(dict(columns))
    if "time" in frame:
        frame["time"] = pandas.to_datetime(frame["time"]).dt.tz_localize("UTC")
    return frame if index is None else frame.set_index(index)


_units = (("_W_m2", "W m-2"), ("_K", "K"), ("_mm", "mm"))


def unit_of(name: str) -> str:
    """The unit that the end of a column's name says, "" for none."""
    return next((unit for ending, unit in _units if name.endswith(ending)), "")


def as_dataset(columns: Mapping[str, Any]) -> Any:
    """Columns as an xarray.Dataset over `time` (UTC). Each variable has its `units`."""
    xarray = imported("xarray")
    time = np.asarray(columns["time"]).astype("datetime64[ns]")
    variables = {
        name: ("time", np.asarray(values), {"units": unit} if (unit := unit_of(name)) else {})
        for name, values in columns.items()
        if name != "time"
    }
    return xarray.Dataset(variables, coords={"time": time})
