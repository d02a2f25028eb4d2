"""Packages that only some methods need."""

from __future__ import annotations

import importlib
from typing import Any


def imported(name: str) -> Any:
    """The package of this name. Raises ImportError that says how to get it."""
    try:
        return importlib.import_module(name)
    except ImportError:
        raise ImportError(f"{name} is not installed: `pip install {name}` or `sudo apt-get install python3-{name}`") from None
