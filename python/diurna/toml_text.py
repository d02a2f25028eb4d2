"""Dictionaries as the TOML of scene and column files."""

import datetime
import json
import os
import re


def _key(name):
    if not isinstance(name, str):
        raise TypeError(f"{name!r}: found {type(name).__name__}, expected a key as text")
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else json.dumps(name, ensure_ascii=False)


def _value(value, where):
    if hasattr(value, "tolist"):  # of numpy: scalars and arrays
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        text = repr(value)
        return {"inf": "inf", "-inf": "-inf", "nan": "nan"}.get(text, text)
    if isinstance(value, datetime.datetime):
        if value.tzinfo is None:
            raise ValueError(f"{where}: an instant needs its offset from UTC (tzinfo)")
        return value.isoformat()
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(one, where) for one in value) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_key(k)} = {_value(v, f'{where}.{k}')}" for k, v in value.items()) + " }"
    raise TypeError(f"{where}: found {type(value).__name__}, expected a number, text, instant, list or dictionary")


_instant = re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d(:\d\d(\.\d+)?)?(Z|[+-]\d\d:\d\d)")


def toml_text(table, path=()):
    """The TOML of a dictionary: tables as [table], lists of dictionaries as [[table]].

    Texts that are instants with an offset become TOML's instants under `start` and `end` of [time].
    """
    own, below = [], []
    for name, value in table.items():
        here = (*path, str(name))
        where = ".".join(here)
        if value is None:
            continue
        if isinstance(value, dict):
            below.append(f"\n[{'.'.join(map(_key, here))}]\n" + toml_text(value, here))
        elif isinstance(value, (list, tuple)) and value and all(isinstance(one, dict) for one in value):
            head = f"\n[[{'.'.join(map(_key, here))}]]\n"
            below.extend(head + toml_text(one, here) for one in value)
        elif path == ("time",) and isinstance(value, str) and _instant.fullmatch(value):
            own.append(f"{_key(name)} = {value}\n")
        else:
            own.append(f"{_key(name)} = {_value(value, where)}\n")
    return "".join(own + below)
