"""Dictionaries as the TOML of scene and column files."""

from __future__ import annotations

import datetime
import json
import os
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from .checks import described
from .errors import Error
from .tables import instant_text


def toml_key(name: Any, where: str = "") -> str:
    """A key as TOML has it, in quotes where it needs them. Raises diurna.Error for what is no text."""
    if not isinstance(name, str):
        key = f"{where}.{name}" if where else str(name)
        raise Error([(key, f"found the key {described(name)}", "expected a key as text", key)])
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name, ensure_ascii=False)


def toml_value(value: Any, where: str) -> str:
    """A value as TOML has it, in one line. Raises diurna.Error with the key `where` for what TOML cannot hold."""
    if isinstance(value, np.datetime64):
        return instant_text(value, where)
    if isinstance(value, np.ndarray) and value.dtype.kind == "M":
        value = list(value)
    elif hasattr(value, "tolist"):  # numpy scalars and arrays
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, datetime.datetime):
        if value.tzinfo is None:
            raise Error([(where, f"found {value} without an offset from UTC", "give it a tzinfo, as datetime.timezone.utc", where)])
        return value.isoformat()
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(str(os.fspath(value)), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(toml_value(one, where) for one in value) + "]"
    if isinstance(value, Mapping):
        inner = (f"{toml_key(k, where)} = {toml_value(v, f'{where}.{k}')}" for k, v in value.items() if v is not None)
        return "{ " + ", ".join(inner) + " }"
    raise Error([(where, f"found {described(value)}", "expected a number, text, instant, list or dictionary", where)])


_instant = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d(:\d\d(\.\d+)?)?(Z|[+-]\d\d:\d\d)")


def toml_text(table: Mapping[str, Any], path: tuple[str, ...] = ()) -> str:
    """A dictionary as the text of a TOML file.

    table: keys as in scene and column files. Dictionaries become [tables], lists of dictionaries [[tables]]; a value of None
    is skipped; numbers and arrays of numpy count as numbers and lists; datetimes need their tzinfo. Texts that are instants
    with an offset become instants of TOML under [time]. path: keys of the tables around this one.

    Raises diurna.Error with the key for a value that TOML cannot hold and for a key that is no text.
    """
    if not isinstance(table, Mapping):
        raise Error([(".".join(path) or "table", f"found {described(table)}", "expected a dictionary")])
    own: list[str] = []
    below: list[str] = []
    for name, value in table.items():
        key = toml_key(name, ".".join(path))
        here = (*path, name)
        where = ".".join(here)
        if value is None:
            continue
        if isinstance(value, Mapping):
            below.append(f"\n[{'.'.join(map(toml_key, here))}]\n" + toml_text(value, here))
        elif isinstance(value, (list, tuple)) and value and all(isinstance(one, Mapping) for one in value):
            head = f"\n[[{'.'.join(map(toml_key, here))}]]\n"
            below.extend(head + toml_text(one, here) for one in value)
        elif path == ("time",) and isinstance(value, str) and _instant.fullmatch(value):
            own.append(f"{key} = {value}\n")
        else:
            own.append(f"{key} = {toml_value(value, where)}\n")
    return "".join(own + below)
