"""Checks of arguments: each returns the value in its proper type or raises diurna.Error with the argument's name."""

from __future__ import annotations

import datetime
import difflib
import math
import numbers
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from .errors import Error

Instant = str | datetime.datetime | np.datetime64
"""ISO 8601 with an offset from UTC, a datetime with tzinfo (pandas.Timestamp too), or a numpy.datetime64 in UTC."""
File = str | os.PathLike[str]
"""Path of a file or folder."""
Settings = str | Sequence[str] | Mapping[str, Any]
"""Values in place of those of a file: "key.path=value", a list of such texts, or a dictionary by key path."""
Progress = Callable[[str, float], Any]
"""Called with the name of a stage and its share: 0 when the stage begins, 1 when it ends."""


def described(value: Any) -> str:
    """A value and its type in a few words, for messages."""
    if value is None:
        return "None"
    text = repr(value)
    return f"{text if len(text) <= 40 else text[:37] + '...'} ({type(value).__name__})"


def number(key: str, value: Any, low: float = -math.inf, high: float = math.inf, unit: str = "") -> float:
    """A finite number from low to high."""
    span = f" from {low:g} to {high:g}" if math.isfinite(low) and math.isfinite(high) else f" of {low:g} or more" if math.isfinite(low) else ""
    expected = f"expected a number{span}{' ' + unit if unit else ''}"
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, numbers.Real):
        raise Error([(key, f"found {described(value)}", expected)])
    given = float(value)
    if not (math.isfinite(given) and low <= given <= high):
        raise Error([(key, f"found {given:g}", expected)])
    return given


def optional_number(key: str, value: Any, low: float = -math.inf, high: float = math.inf, unit: str = "") -> float | None:
    """The same, or None."""
    return None if value is None else number(key, value, low, high, unit)


def whole(key: str, value: Any, low: int, high: int) -> int:
    """A whole number from low to high."""
    expected = f"expected a whole number from {low} to {high}"
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, numbers.Integral):
        raise Error([(key, f"found {described(value)}", expected)])
    if not low <= int(value) <= high:
        raise Error([(key, f"found {value}", expected)])
    return int(value)


def flag(key: str, value: Any) -> bool:
    """True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise Error([(key, f"found {described(value)}", "expected True or False")])
    return bool(value)


def text(key: str, value: Any, what: str = "a text") -> str:
    """A text that is not empty."""
    if not isinstance(value, str):
        raise Error([(key, f"found {described(value)}", f"expected {what}")])
    if not value:
        raise Error([(key, "found an empty text", f"expected {what}")])
    return str(value)


def texts(key: str, value: Any, what: str) -> list[str]:
    """A list of texts; a single text counts as a list of one."""
    if isinstance(value, str):
        return [text(key, value, what)]
    if isinstance(value, Mapping) or not isinstance(value, Iterable):
        raise Error([(key, f"found {described(value)}", f"expected {what}, or a list of such texts")])
    return [text(key, one, what) for one in value]


def file(key: str, value: Any) -> str:
    """Path of a file or folder, as text."""
    if not isinstance(value, (str, os.PathLike)) or isinstance(os.fspath(value), bytes) or not os.fspath(value):
        raise Error([(key, f"found {described(value)}", "expected a path as text or pathlib.Path")])
    return str(os.fspath(value))


def optional_file(key: str, value: Any) -> str:
    """The same; "" for None."""
    return "" if value is None else file(key, value)


def array(key: str, value: Any, low: float, high: float, unit: str, below: str = "") -> Any:
    """A number or an array of numbers from low to high, as float64 of the same shape. below: the remedy for a lower number."""
    expected = f"expected numbers from {low:g} to {high:g} {unit}"
    try:
        numbers_of = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise Error([(key, f"found {described(value)}", expected)]) from None
    if isinstance(value, (str, bool)) or value is None:
        raise Error([(key, f"found {described(value)}", expected)])
    outside = numbers_of[~((numbers_of >= low) & (numbers_of <= high))]
    if not outside.size:
        return numbers_of
    first = outside.flat[0]
    count = f" and {outside.size - 1} more" if outside.size > 1 else ""
    remedy = "; leave NaN out: x[numpy.isfinite(x)]" if math.isnan(first) else f"; {below}" if below and first < low else ""
    raise Error([(key, f"found {first:g}{count}", expected + remedy)])


def kelvin(key: str, value: Any) -> Any:
    """Temperatures [K] of surfaces and the sun, as array() has them."""
    return array(key, value, 100, 20000, "K", "of degrees Celsius add 273.15")


def radiance(key: str, value: Any) -> Any:
    """Radiances [W m-2 sr-1] of bands, as array() has them."""
    return array(key, value, 0, 1e12, "W/m2 sr", "no black body has a negative radiance: subtract less, or use numpy.maximum(x, 0)")


def progress_callable(key: str, value: Any) -> Any:
    """None or something that can be called."""
    if value is not None and not callable(value):
        raise Error([(key, f"found {described(value)}", "expected a function of (stage, share)")])
    return value


def nearest(name: str, known: Sequence[str]) -> str:
    """The nearest of the known names as a remedy, or all of them if none is near."""
    near = difflib.get_close_matches(name, known, 1, 0.5)
    return f"did you mean '{near[0]}'?" if near else f"expected one of: {', '.join(known)}"
