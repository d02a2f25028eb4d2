"""Tables in and out: columns of pandas or numpy as the CSV that the program reads, and its CSV as columns."""

import csv
import datetime
import io
from pathlib import Path

import numpy as np


def instant_text(when):
    """ISO 8601 with an offset of a text, a datetime with tzinfo or a datetime64 of numpy (which is UTC)."""
    if isinstance(when, np.datetime64):
        if np.isnat(when):
            raise ValueError("an instant is missing (NaT)")
        return str(when.astype("datetime64[ms]")) + "Z"
    if hasattr(when, "isoformat"):
        if when != when:
            raise ValueError("an instant is missing (NaT)")
        if when.tzinfo is None:
            raise ValueError(f"{when}: an instant needs its offset from UTC (tzinfo; pandas: tz_localize)")
        return when.isoformat(timespec="milliseconds")
    if not isinstance(when, str):
        raise ValueError(f"found {when!r}, expected an instant")
    return when


def _is_missing(value):
    if value is None:
        return True
    try:
        return bool(value != value)
    except TypeError:  # pandas.NA is neither
        return True


def _number_text(value):
    return "" if _is_missing(value) else repr(float(value))


def _columns_of(table, what):
    """By name, of a DataFrame (instants in a column `time` or as its index), a Series or a dictionary."""
    if isinstance(table, dict):
        return dict(table)
    if hasattr(table, "to_frame") and hasattr(table, "index"):  # a Series, or a frame of another make
        table = table.to_frame(table.name if table.name is not None else "value")
    if not hasattr(table, "columns"):
        raise TypeError(f"{what}: found {type(table).__name__}, expected a DataFrame, a Series or a dictionary of columns")
    if "time" not in table:
        table = table.rename_axis("time").reset_index()
    return {name: table[name] for name in table.columns}


def write_csv(table, file, what):
    """Such a table as CSV: instants with their offset, what is missing (NaN) as an empty cell. Raises ValueError with
    column and row, TypeError for what is no table."""
    columns = _columns_of(table, what)
    length = {name: len(values) for name, values in columns.items()}
    if len(set(length.values())) != 1 or "time" not in columns:
        raise ValueError(f"{what}: expected `time` and columns of one length, found {length}")
    cells = []
    for name, values in columns.items():
        text = instant_text if name == "time" else _number_text
        cells.append([])
        for row, value in enumerate(values):
            try:
                cells[-1].append(text(value))
            except (TypeError, ValueError) as error:
                raise ValueError(f"{what}: column {name!r}, row {row}: {error}") from None
    with open(file, "w", newline="", encoding="utf-8") as out:
        writer = csv.writer(out)
        writer.writerow(columns)
        writer.writerows(zip(*cells))
    return Path(file)


def _name(cell):
    """A name without the apostrophe that keeps tables from taking it for a formula."""
    return cell[1:] if cell[:1] == "'" and cell[1:2] in tuple("=+-@") else cell


def _array(name, cells):
    if name == "time":
        return np.array([_utc(cell) for cell in cells], "datetime64[ms]")
    if cells and all(cell in ("true", "false") for cell in cells):
        return np.array([cell == "true" for cell in cells])
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array([_name(cell) for cell in cells], object)


def _utc(text):
    when = datetime.datetime.fromisoformat(text).astimezone(datetime.timezone.utc)
    return np.datetime64(when.replace(tzinfo=None), "ms")


def read_csv(text):
    """Columns of the program's CSV by name: `time` as datetime64 in UTC, numbers as floats (empty: NaN), true and false
    as bool, names as text."""
    header, *rows = csv.reader(io.StringIO(text))
    return {_name(name): _array(name, [row[i] for row in rows]) for i, name in enumerate(header)}


def as_frame(columns, index=None):
    """As pandas.DataFrame, its instants in UTC; one of the columns as its index."""
    import pandas

    frame = pandas.DataFrame(columns)
    if "time" in frame:
        frame["time"] = pandas.to_datetime(frame["time"]).dt.tz_localize("UTC")
    return frame if index is None else frame.set_index(index)
